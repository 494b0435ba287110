//! A thin layer over wgpu: adapter, shader, layout and kernel, texture, uniform, readback, timer.
//!
//! Nothing here blocks, spawns threads or touches files, so that a browser can run it.

pub mod adapter;
pub mod kernel;
pub mod list;
pub mod readback;
pub mod shader;
pub mod texture;
pub mod timer;
pub mod uniform;

use std::sync::{Arc, Mutex};

pub use adapter::{AdapterError, Preference};
pub use kernel::{Binding, BindingLayout, Kernel};
pub use list::List;
pub use readback::Readback;
pub use shader::{Library, ShaderError};
pub use texture::{Contract, Role, Texture, nearest_sampler};
pub use timer::{PassTime, Recorder, Timer};
pub use uniform::{Uniform, UniformSlots};

/// A device, its queue, and what it can do.
pub struct Gpu {
    /// The entry point, kept for the creation of window surfaces.
    pub instance: wgpu::Instance,
    /// The adapter that was chosen.
    pub adapter: wgpu::Adapter,
    /// The device made from it.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// The WGSL that passes are built from.
    pub shaders: Library,
    errors: Arc<Mutex<Vec<String>>>,
}

impl Gpu {
    /// Whether textures of format r32float may be filtered by a sampler.
    pub fn filters_r32float(&self) -> bool {
        self.device.features().contains(wgpu::Features::FLOAT32_FILTERABLE)
    }

    /// Whether passes can be timed on the GPU.
    pub fn has_timestamps(&self) -> bool {
        self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
    }

    /// Adapter, backend and driver in one line.
    pub fn describe(&self) -> String {
        adapter::describe(&self.adapter.get_info())
    }

    /// The first error that the device reported outside any error scope since the last call, if any.
    pub fn take_error(&self) -> Option<String> {
        let mut errors = match self.errors.lock() {
            Ok(errors) => errors,
            // A panic while the list was locked leaves a list that is still whole.
            Err(poisoned) => poisoned.into_inner(),
        };
        let first = errors.first().cloned();
        errors.clear();
        first
    }

    /// An encoder for one submission.
    pub fn encoder(&self, label: &str) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(label) })
    }
}
