//! How it is seen.

mod micropolygon;
mod ray_map;
mod shadow_hard;
mod shadow_none;
mod shadow_pom_soft;
mod trace_exact;
mod trace_mesh;
mod trace_normal;
mod trace_pom;
mod traversal;
