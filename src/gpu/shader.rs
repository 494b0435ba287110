//! WGSL by concatenation of named parts.
//!
//! A part is a file under `shaders/`. Composition is concatenation and nothing else, so an error's line in the whole is a line
//! in one part, and the error names it.

use std::collections::BTreeMap;

use wgpu::naga;

use super::Gpu;

/// Embeds every part; a test compares the list with the folder.
macro_rules! embed {
    ($($name:literal)+) => {
        &[$(($name, include_str!(concat!("../../shaders/", $name, ".wgsl")))),+]
    };
}

/// The parts that the binary carries, by name: the path under `shaders/` without its ending.
pub const EMBEDDED: &[(&str, &str)] = embed! {
    "common/field"
    "common/gas"
    "common/heat"
    "common/height_filtered"
    "common/height_loaded"
    "common/legend"
    "common/marks"
    "common/material"
    "common/noise"
    "common/profile"
    "common/range"
    "common/region"
    "common/shallow_water"
    "common/view"
    "field/bounds"
    "field/compose"
    "field/gas_activity"
    "field/gas_advect"
    "field/gas_emit"
    "field/gas_force"
    "field/gas_project"
    "field/gas_project_smooth"
    "field/gas_show"
    "field/cool"
    "field/heal"
    "field/noise"
    "field/noise_columns"
    "field/noise_dunes"
    "field/noise_fractal"
    "field/noise_gears"
    "field/noise_scales"
    "field/normal_mips"
    "field/normals"
    "field/pyramid"
    "field/shallow_water"
    "field/shallow_water_disturb"
    "field/shallow_water_flux"
    "field/shallow_water_plan"
    "field/shallow_water_publish"
    "field/stamp"
    "field/wave"
    "present"
    "surface/albedo_brick"
    "surface/albedo_bronze"
    "surface/albedo_cobble"
    "surface/albedo_glass"
    "surface/albedo_facade"
    "surface/albedo_fur"
    "surface/albedo_gas"
    "surface/albedo_grass"
    "surface/albedo_image"
    "surface/albedo_plain"
    "surface/albedo_planet"
    "surface/albedo_snow"
    "surface/albedo_sand"
    "surface/albedo_terrain"
    "surface/albedo_water"
    "surface/ball"
    "surface/balls"
    "surface/channel"
    "surface/channels"
    "surface/facet"
    "surface/frame"
    "surface/level_cap"
    "surface/level_of_detail"
    "surface/light_ggx"
    "surface/light_phong"
    "surface/light_probe"
    "surface/light_disc"
    "surface/march"
    "surface/matter"
    "surface/micropolygon"
    "surface/plane"
    "surface/probe"
    "surface/raster"
    "surface/ray"
    "surface/ray_map"
    "surface/reliefs"
    "surface/shade"
    "surface/shadow_area"
    "surface/shadow_cone"
    "surface/shadow_hard"
    "surface/shadow_none"
    "surface/shadow_pom_soft"
    "surface/shallows"
    "surface/shell"
    "surface/sky"
    "surface/shadow_steep"
    "surface/surface"
    "surface/trace_exact"
    "surface/trace_mesh"
    "surface/trace_normal"
    "surface/trace_parallax"
    "surface/trace_parallax_limited"
    "surface/trace_pom"
    "surface/trace_pom_linear"
    "surface/trace_pyramid"
    "surface/trace_relief"
    "surface/trace_steep"
    "surface/traversal"
    "surface/transparent"
    "surface/truth_exact"
    "surface/truth_none"
    "surface/views"
};

/// Why WGSL did not become a module. The message keeps naga's annotated source.
#[derive(Debug, thiserror::Error)]
pub enum ShaderError {
    /// No part of this name.
    #[error("there is no shader part '{0}'")]
    NoPart(String),
    /// The composition does not parse or validate.
    #[error("shaders/{part}.wgsl:{line}: {message}")]
    Invalid {
        /// The part at fault.
        part: String,
        /// The line in it, from 1.
        line: u32,
        /// naga's message, with the source around it.
        message: String,
    },
    /// It is valid, but does not fit the pipeline that it is for.
    #[error("a shader does not fit its pass: {0}")]
    Unfit(String),
}

/// The WGSL that passes are built from.
#[derive(Clone, Debug)]
pub struct Library {
    parts: BTreeMap<String, String>,
}

impl Library {
    /// The parts that the binary carries.
    pub fn embedded() -> Self {
        Self { parts: EMBEDDED.iter().map(|(name, source)| ((*name).to_owned(), (*source).to_owned())).collect() }
    }

    /// Replaces one part's source: how a reload or a test brings in another.
    pub fn replace(&mut self, name: &str, source: String) {
        self.parts.insert(name.to_owned(), source);
    }

    /// Joins the parts, in order.
    ///
    /// # Errors
    ///
    /// A part has no such name.
    pub fn compose(&self, names: &[&str]) -> Result<Composition, ShaderError> {
        let mut composition = Composition { source: String::new(), starts: Vec::new() };
        let mut line = 1;
        for name in names {
            let source = self.parts.get(*name).ok_or_else(|| ShaderError::NoPart((*name).to_owned()))?;
            composition.starts.push((line, (*name).to_owned()));
            composition.source.push_str(source);
            if !source.ends_with('\n') {
                composition.source.push('\n');
            }
            line += source.lines().count() as u32;
        }
        Ok(composition)
    }

    /// Joins the parts, checks them, and makes a shader module.
    ///
    /// # Errors
    ///
    /// A part is unknown, or the whole does not parse or validate.
    pub fn module(&self, gpu: &Gpu, label: &str, names: &[&str]) -> Result<wgpu::ShaderModule, ShaderError> {
        let composition = self.compose(names)?;
        // wgpu would report the same fault, but by a line of the whole and through an asynchronous error scope.
        composition.validate()?;
        Ok(gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(composition.source.into()),
        }))
    }
}

/// Several parts in one source, which knows where each begins.
#[derive(Clone, Debug)]
pub struct Composition {
    /// The whole source.
    pub source: String,
    /// The first line of each part, from 1.
    starts: Vec<(u32, String)>,
}

impl Composition {
    /// The part and the line in it that a line of the whole is.
    pub fn locate(&self, line: u32) -> (&str, u32) {
        self.starts
            .iter()
            .rev()
            .find(|(start, _)| *start <= line)
            .map_or(("", line), |(start, name)| (name.as_str(), line - start + 1))
    }

    /// Parses and validates the whole with the capabilities that WebGPU's baseline has.
    ///
    /// # Errors
    ///
    /// naga's message, at the part's own line.
    pub fn validate(&self) -> Result<naga::Module, ShaderError> {
        let module = naga::front::wgsl::parse_str(&self.source).map_err(|error| {
            let line = error.location(&self.source).map_or(1, |location| location.line_number);
            self.error(line, error.emit_to_string(&self.source))
        })?;
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::default())
            .validate(&module)
            .map_err(|error| {
                let line = error.location(&self.source).map_or(1, |location| location.line_number);
                self.error(line, error.emit_to_string(&self.source))
            })?;
        Ok(module)
    }

    fn error(&self, line: u32, message: String) -> ShaderError {
        let (part, line) = self.locate(line);
        ShaderError::Invalid { part: part.to_owned(), line, message }
    }
}
