//! How it is seen.

mod albedo_image;
mod ray_map;
mod shadow_hard;
mod shadow_none;
mod shadow_pom_soft;
mod trace_exact;
mod trace_normal;
mod trace_pom;
mod traversal;
