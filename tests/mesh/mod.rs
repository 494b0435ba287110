mod files;
mod gltf;
mod obj;
mod shapes;
mod skin;
pub mod write;
