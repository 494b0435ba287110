//! How it is seen.

mod ray_map;
