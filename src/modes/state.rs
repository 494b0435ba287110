//! States: reading all that a field remembers from the GPU, and writing it back.

use std::path::Path;

use super::capture::read_texture;
use super::{ModeError, wait_for};
use crate::clock::Clock;
use crate::field::source::State;
use crate::frame::{Frame, Start};
use crate::gpu::{Gpu, Readback};
use crate::io::state_file::{self, Part, SavedState, StateFileError};
use crate::scene::Scene;

/// What of a scene only says how its field is seen: two runs that differ in it alone have the same field.
const LOOKS: [&str; 13] = [
    "name",
    "description",
    "trace",
    "lod",
    "light",
    "lights",
    "material",
    "mesh",
    "balls",
    "reliefs",
    "camera",
    // Checked by themselves, with sentences of their own.
    "seed",
    "field",
];

/// Writes all that the field of a frame with this start remembers to a file, with the clock that goes on from there.
///
/// # Errors
///
/// The device was lost, or the file cannot be written.
pub fn save(gpu: &Gpu, frame: &Frame, start: &Start, clock: &Clock, path: &Path) -> Result<(), ModeError> {
    let mut blobs = Vec::new();
    let mut parts = Vec::new();
    for (name, state) in frame.states() {
        parts.push(part(name, &state));
        for texture in &state.textures {
            blobs.push(read_texture(gpu, texture)?);
        }
        for buffer in &state.buffers {
            let mut encoder = gpu.encoder("state");
            let readback = Readback::record_buffer(gpu, &mut encoder, buffer, buffer.size());
            gpu.queue.submit([encoder.finish()]);
            readback.start();
            blobs.push(wait_for(gpu, &readback)?);
        }
    }
    let (scene, clock) = (frame.scene().clone(), clock.clone());
    let state = SavedState { scene, start: start.sums(), clock, parts, blobs };
    Ok(state_file::write(path, &state)?)
}

/// Reads a state and checks that a run with this start may go on from it.
///
/// # Errors
///
/// The file is unfit, or of a scene with another field.
pub fn read(path: &Path, start: &Start) -> Result<SavedState, ModeError> {
    let state = state_file::read(path)?;
    let (saved, scene) = (&state.scene, &start.scene);
    let other = |key: &str| {
        Some(format!(
            "is of the scene {}, whose `{key}` is another than in this run's: name the same scene and settings",
            saved.name
        ))
    };
    // Another scene first: its seed and size are of no use then.
    let problem = if let Some(key) = differing(saved, scene) {
        other(&key)
    } else if saved.field.addressing != scene.field.addressing {
        other("field.addressing")
    } else if saved.field.size != scene.field.size {
        let [width, height] = saved.field.size;
        let [here_width, here_height] = scene.field.size;
        Some(format!(
            "holds a field of {width}×{height}, and this run's has {here_width}×{here_height}: say --field {width}x{height}"
        ))
    } else if saved.seed != scene.seed {
        Some(format!("is of seed {}, and this run's is {}: say --seed {}", saved.seed, scene.seed, saved.seed))
    } else {
        state.start.problem(start.sums()).map(str::to_owned)
    };
    match problem {
        Some(problem) => Err(StateFileError::Unfit { path: path.to_owned(), problem }.into()),
        None => Ok(state),
    }
}

/// Puts the field of a frame into a state, and returns the clock that goes on from there.
///
/// # Errors
///
/// The state has other parts than the field, from another version of this program; then nothing is changed.
pub fn restore(gpu: &Gpu, frame: &mut Frame, state: SavedState, path: &Path) -> Result<Clock, ModeError> {
    let expected: Vec<_> = frame.states().iter().map(|(name, state)| part(name, state)).collect();
    let layout =
        |parts: &[Part]| -> Vec<Part> { parts.iter().map(|part| Part { numbers: Vec::new(), ..part.clone() }).collect() };
    let sizes = frame.states().into_iter().flat_map(|(_, state)| {
        let textures = state.textures.into_iter().map(|texture| {
            let texel = u64::from(texture.format().block_copy_size(None).unwrap_or(0));
            u64::from(texture.width()) * u64::from(texture.height()) * texel
        });
        textures.chain(state.buffers.into_iter().map(wgpu::Buffer::size)).collect::<Vec<_>>()
    });
    let fits = sizes.eq(state.blobs.iter().map(|blob| blob.len() as u64));
    if layout(&expected) != layout(&state.parts) || !fits {
        let problem = "holds other textures than this program's field: save it again with this program".to_owned();
        return Err(StateFileError::Unfit { path: path.to_owned(), problem }.into());
    }
    let mut blobs = state.blobs.iter();
    for (_, of_part) in frame.states() {
        for (texture, bytes) in of_part.textures.iter().zip(&mut blobs) {
            write_texture(gpu, texture, bytes);
        }
        for (buffer, bytes) in of_part.buffers.iter().zip(&mut blobs) {
            gpu.queue.write_buffer(buffer, 0, bytes);
        }
    }
    let numbers: Vec<_> = state.parts.into_iter().map(|part| part.numbers).collect();
    frame.restore(&numbers);
    Ok(state.clock)
}

fn write_texture(gpu: &Gpu, texture: &wgpu::Texture, bytes: &[u8]) {
    let texel = texture.format().block_copy_size(None).unwrap_or(0);
    gpu.queue.write_texture(
        texture.as_image_copy(),
        bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(texture.width() * texel),
            rows_per_image: Some(texture.height()),
        },
        wgpu::Extent3d { width: texture.width(), height: texture.height(), depth_or_array_layers: 1 },
    );
}

fn part(name: &str, state: &State<'_>) -> Part {
    Part {
        name: name.to_owned(),
        textures: state
            .textures
            .iter()
            .map(|texture| (format!("{:?}", texture.format()), texture.width(), texture.height()))
            .collect(),
        buffers: state.buffers.iter().map(|buffer| buffer.size()).collect(),
        numbers: state.numbers.clone(),
    }
}

/// The first key in which two scenes differ that are to have the same field.
fn differing(a: &Scene, b: &Scene) -> Option<String> {
    let keys = |scene: &Scene| match serde_json::to_value(scene) {
        Ok(serde_json::Value::Object(keys)) => keys,
        // A scene is a table of numbers, strings, lists and tables, all of which JSON knows.
        _ => serde_json::Map::new(),
    };
    let (a, b) = (keys(a), keys(b));
    let all = a.keys().chain(b.keys()).filter(|key| !LOOKS.contains(&key.as_str()));
    all.into_iter().find(|key| a.get(*key) != b.get(*key)).cloned()
}
