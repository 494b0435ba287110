//! How it is seen.

mod albedo_image;
mod balls;
mod facet;
mod light_disc;
mod light_ggx;
mod light_phong;
mod micropolygon;
mod ray_map;
mod shadow_area;
mod shadow_cone;
mod shadow_hard;
mod shadow_none;
mod shadow_pom_soft;
mod shadow_steep;
mod shell;
mod sky;
mod trace_exact;
mod trace_mesh;
mod trace_normal;
mod trace_pom;
mod traversal;
