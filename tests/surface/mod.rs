//! How it is seen.

mod light_ggx;
mod light_phong;
mod ray_map;
mod shadow_hard;
mod shadow_none;
mod shadow_pom_soft;
mod sky;
mod trace_exact;
mod trace_normal;
mod trace_pom;
mod traversal;
