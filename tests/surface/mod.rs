//! How it is seen.

mod balls;
mod facet;
mod march;
mod ray_map;
mod shadow_hard;
mod shadow_none;
mod shadow_pom_soft;
mod shell;
mod techniques;
mod trace_exact;
mod trace_normal;
mod trace_parallax;
mod trace_parallax_limited;
mod trace_pom;
mod trace_pom_linear;
mod trace_pyramid;
mod trace_relief;
mod trace_steep;
mod traversal;
