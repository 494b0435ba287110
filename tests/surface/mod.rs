//! How it is seen.

mod balls;
mod facet;
mod level_of_detail;
mod light_ggx;
mod light_phong;
mod ray_map;
mod shadow_hard;
mod shadow_none;
mod shadow_pom_soft;
mod shell;
mod sky;
mod trace_exact;
mod trace_normal;
mod trace_pom;
mod traversal;
