//! Export: the field and its layers as images for other programs, beside each captured frame.

use std::collections::BTreeMap;

use super::ModeError;
use super::capture::read_texture;
use crate::cli::Export;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::io::exr_file;
use crate::io::field_image::{self, NormalMap};
use crate::io::output_dir::OutputDir;
use crate::reference::{HeightField, normals};

/// Checks that a frame has all that is to be exported.
///
/// # Errors
///
/// It lacks a source or a bed.
pub fn check(frame: &Frame, exports: &[Export]) -> Result<(), ModeError> {
    for export in exports {
        if matches!(export, Export::BedExr | Export::SourceExr(_)) && layer(frame, *export).is_none() {
            return Err(ModeError::NoLayer { export: export.name() });
        }
    }
    Ok(())
}

/// The texture of a layer, if the frame has it.
fn layer(frame: &Frame, export: Export) -> Option<wgpu::Texture> {
    match export {
        Export::ReliefExr => Some(frame.field.relief.texture.clone()),
        Export::BedExr => frame.bed().map(|view| view.texture().clone()),
        Export::SourceExr(name) => {
            let heights = frame.source(name)?.heights();
            Some(heights.views[heights.current].texture().clone())
        }
        _ => Some(frame.field.height.texture.clone()),
    }
}

/// Writes what is asked for and returns the files' names.
///
/// # Errors
///
/// The device was lost, or a file cannot be written.
pub fn write(gpu: &Gpu, frame: &Frame, exports: &[Export], directory: &OutputDir, index: u32) -> Result<Vec<String>, ModeError> {
    let size = frame.field.size;
    let mut names = Vec::new();
    let mut normals = None;
    for export in exports {
        let Some(texture) = layer(frame, *export) else { continue };
        let heights: Vec<f32> = bytemuck::pod_collect_to_vec(&read_texture(gpu, &texture)?);
        let name = export.file(index);
        let path = directory.file(&name);
        match export {
            Export::HeightPng => field_image::write_heights(&path, size, &heights)?,
            Export::NormalGlPng | Export::NormalDxPng => {
                let normals: &Vec<[f64; 3]> = normals.get_or_insert_with(|| normals_of(frame, heights));
                let convention = if *export == Export::NormalGlPng { NormalMap::OpenGl } else { NormalMap::DirectX };
                field_image::write_normals(&path, size, normals, convention)?;
            }
            _ => exr_file::write(&path, size, BTreeMap::from([("H".to_owned(), heights)]))?,
        }
        names.push(name);
    }
    Ok(names)
}

/// The normals of the height field in f64: the frame's own are halves, of eleven bits.
fn normals_of(frame: &Frame, heights: Vec<f32>) -> Vec<[f64; 3]> {
    let field = HeightField::new(frame.field.size, frame.field.addressing, heights);
    let slope = frame.slope_per_height().map(f64::from);
    let [width, height] = field.size;
    (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).map(|[x, y]| normals::normal(&field, x, y, slope)).collect()
}
