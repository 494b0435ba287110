//! `manifest.json`: what a capture shows, for the scripts that read its files. Written last, so that its presence says "complete".

use std::io::Write as _;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::atomic::{self, WriteError};
use crate::camera::Camera;
use crate::scene::{Addressing, Scene};
use crate::surface::{Shadow, Technique};

/// Its name in the output directory.
pub const FILE_NAME: &str = "manifest.json";

/// Everything that determines the frames beside it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Manifest {
    /// Version of this program.
    pub version: String,
    /// What drew it.
    pub adapter: Adapter,
    /// The scene, complete.
    pub scene: Scene,
    /// Seed of everything random.
    pub seed: u64,
    /// Width and height of the pictures, pixels.
    pub image_size: [u32; 2],
    /// Width and height of the field, texels.
    pub field_size: [u32; 2],
    /// What lies beyond the border of the field.
    pub addressing: Addressing,
    /// Extent of the plane along x and z, metres.
    pub plane_size: [f64; 2],
    /// Depth of h = 0, metres.
    pub depth: f32,
    /// How the surface was traced.
    pub technique: Technique,
    /// The shadow upon it.
    pub shadow: Shadow,
    /// Time from frame to frame, seconds.
    pub dt: f64,
    /// Frames that ran before the first that was written.
    pub warmup: u32,
    /// The frames, in order.
    pub frames: Vec<Frame>,
}

/// The adapter that drew the frames.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Adapter {
    /// Its name.
    pub name: String,
    /// The interface it was reached by: vulkan, metal, dx12 or gl.
    pub backend: String,
    /// Its driver.
    pub driver: String,
}

impl From<&wgpu::AdapterInfo> for Adapter {
    fn from(info: &wgpu::AdapterInfo) -> Self {
        let driver = [info.driver.as_str(), info.driver_info.as_str()].join(" ").trim().to_owned();
        Self { name: info.name.clone(), backend: info.backend.to_string(), driver }
    }
}

/// One frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Frame {
    /// The number in its files' names.
    pub index: u32,
    /// Time since the start of the scene, seconds.
    pub time: f64,
    /// From view space (right-handed, looking down −z) to the world, column by column.
    pub world_from_view: [f64; 16],
    /// Vertical field of view, radians.
    pub vertical_fov: f64,
    /// Nearest visible distance, metres.
    pub near: f64,
    /// Its files' names.
    pub files: Vec<String>,
}

impl Manifest {
    /// What is known before the first frame; `frames` starts empty.
    pub fn new(scene: &Scene, adapter: &wgpu::AdapterInfo, image_size: [u32; 2], dt_seconds: f64, warmup: u32) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            adapter: adapter.into(),
            scene: scene.clone(),
            seed: scene.seed,
            image_size,
            field_size: scene.field.size,
            addressing: scene.field.addressing,
            plane_size: scene.plane_size_metres(),
            depth: scene.plane.depth_metres,
            technique: scene.trace.technique,
            shadow: scene.trace.shadow,
            dt: dt_seconds,
            warmup,
            frames: Vec::new(),
        }
    }

    /// Writes it into a directory.
    ///
    /// # Errors
    ///
    /// The file cannot be written.
    pub fn write(&self, directory: &Path) -> Result<(), WriteError> {
        write_json(&directory.join(FILE_NAME), self)
    }
}

/// Writes a value as indented JSON.
///
/// # Errors
///
/// The file cannot be written.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<(), WriteError> {
    atomic::write(path, |file| {
        serde_json::to_writer_pretty(&mut *file, value)?;
        file.write_all(b"\n")
    })
}

impl Frame {
    /// A frame seen by `camera`.
    pub fn new(index: u32, time: f64, camera: &Camera, files: Vec<String>) -> Self {
        Self {
            index,
            time,
            world_from_view: camera.world_from_view.to_cols_array(),
            vertical_fov: camera.vertical_fov_radians,
            near: camera.near_metres,
            files,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manifest_has_the_keys_of_the_contract() {
        let scene = Scene { seed: u64::MAX, ..Scene::default() };
        let info = wgpu::AdapterInfo {
            name: "a".to_owned(),
            driver: "b".to_owned(),
            ..wgpu::AdapterInfo::new(wgpu::DeviceType::Cpu, wgpu::Backend::Vulkan)
        };
        let mut manifest = Manifest::new(&scene, &info, [64, 48], 1.0 / 60.0, 3);
        let files = vec!["frame_00000.png".to_owned()];
        let frame = Frame { index: 0, time: 0.05, world_from_view: [0.5; 16], vertical_fov: 0.785, near: 0.01, files };
        manifest.frames.push(frame);
        let directory = tempfile::tempdir().unwrap();
        manifest.write(directory.path()).unwrap();
        let text = std::fs::read_to_string(directory.path().join(FILE_NAME)).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let keys = |value: &serde_json::Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
        let expected = [
            "adapter",
            "addressing",
            "depth",
            "dt",
            "field_size",
            "frames",
            "image_size",
            "plane_size",
            "scene",
            "seed",
            "shadow",
            "technique",
            "version",
            "warmup",
        ];
        assert_eq!(keys(&json), expected);
        assert_eq!(keys(&json["adapter"]), ["backend", "driver", "name"]);
        assert_eq!(keys(&json["frames"][0]), ["files", "index", "near", "time", "vertical_fov", "world_from_view"]);
        assert_eq!(json["seed"], u64::MAX);
        assert_eq!(json["addressing"], "clamp");
        assert_eq!(json["technique"], "exact");
        assert_eq!(json["adapter"]["backend"], "vulkan");
        assert_eq!(json["dt"].as_f64(), Some(1.0 / 60.0));
        let whole: Scene = serde_json::from_value(json["scene"].clone()).unwrap();
        assert_eq!(whole, scene);
    }
}
