//! What a scene may say: a range for every number, and the sentence for one outside it.

use std::fmt;

use crate::surface::Albedo;
use crate::surface::view::BALLS_MAX;

use super::stamping::{validate_imprints, validate_tracks};
use super::{
    Ball, Base, Camera, DirectionalLight, Explosions, FieldSettings, Healing, LIGHTS_MAX, LOD_THRESHOLD, Light, Material, Mesh,
    Obstacle, Plane, RELIEFS_MAX, Relief, Scene, Shots, Text, Trace, VERSION, Wave, check_text, noise, sequence,
};

/// Depth of the field below its plane. A thousand kilometres is no field any more, and f32 metres run out.
pub const DEPTH_METRES: Range = Range::above(0.0, 1e6, "metres");
/// Vertical field of view of a camera.
pub const VERTICAL_FOV_DEGREES: Range = Range { low: 0.0, high: 180.0, with_low: false, with_high: false, unit: "degrees" };
/// What shines: a colour, its strength.
const RADIANCE: Range = Range::from_to(0.0, 1e4, "");
/// Half the angle that the light's disc spans. A wider one is no disc that a plane at right angles to its centre could stand for.
pub const LIGHT_HALF_ANGLE_DEGREES: Range = Range::above(0.0, 15.0, "degrees");
/// Samples, or layers, of a ray. More change no picture and stall a frame: these cross a field of 16,384 texels four times a texel.
pub const SAMPLES_MAX: u32 = 65536;
/// C² up to which a wave is stable: at ½ the checkerboard mode grows linearly.
pub const COURANT_SQUARED_MAX: f64 = 0.49;

/// Samples of a search.
const SAMPLES: Range = Range::from_to(1.0, SAMPLES_MAX as f64, "samples");

/// Triangles of a micropolygon mesh: the plane's own two, and as many as fit the buffers that every adapter allows.
pub const MESH_TRIANGLES: [u32; 2] = [2, 8_388_608];

/// The numbers that a key may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    low: f64,
    high: f64,
    with_low: bool,
    with_high: bool,
    unit: &'static str,
}

impl Range {
    /// From `low` to `high`, both included.
    pub const fn from_to(low: f64, high: f64, unit: &'static str) -> Self {
        Self { low, high, with_low: true, with_high: true, unit }
    }

    /// From `low`, which is excluded, to `high`, which is included.
    pub const fn above(low: f64, high: f64, unit: &'static str) -> Self {
        Self { low, high, with_low: false, with_high: true, unit }
    }

    /// Whether this number lies in it. NaN lies nowhere.
    pub fn contains(&self, number: f64) -> bool {
        let above = if self.with_low { number >= self.low } else { number > self.low };
        let below = if self.with_high { number <= self.high } else { number < self.high };
        above && below
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { low, high, with_low, with_high, unit } = *self;
        let low_word = if with_low { "from" } else { "above" };
        let high_word = match (with_low, with_high) {
            (true, true) => "to",
            (false, true) => "and at most",
            (_, false) => "and below",
        };
        let space = if unit.is_empty() { "" } else { " " };
        write!(f, "a number {low_word} {low} {high_word} {high}{space}{unit}")
    }
}

/// What is wrong with a scene, one sentence with the key, its value and what it may be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// Another format.
    #[error("`version` is {found}, and this program reads version {VERSION}: write `version = {VERSION}` and adapt the keys")]
    Version {
        /// The version in the file.
        found: u32,
    },
    /// A value that its key may not have.
    #[error("`{key}` is {value}: it must be {allowed}")]
    Value {
        /// The key, with its tables.
        key: String,
        /// The value.
        value: String,
        /// What it may be, in words.
        allowed: String,
    },
}

impl SceneError {
    /// The same of a key that stands in this table.
    fn within(self, table: &str) -> Self {
        match self {
            Self::Value { key, value, allowed } => Self::Value { key: format!("{table}.{key}"), value, allowed },
            Self::Version { .. } => self,
        }
    }
}

impl Scene {
    /// Checks every value against its range, and the stability of the wave.
    ///
    /// The sizes of textures are checked against an adapter's limits elsewhere: no scene knows those.
    pub fn validate(&self) -> Result<(), SceneError> {
        if self.version != VERSION {
            return Err(SceneError::Version { found: self.version });
        }
        let brings_colours = self.sequence.as_ref().is_some_and(|sequence| sequence.colours.is_some());
        validate_relief(&self.field, &self.plane, &self.base, &self.material, self.mesh.as_ref(), brings_colours)?;
        self.gas.as_ref().map_or(Ok(()), |gas| super::gas::validate(gas, self))?;
        self.wave.as_ref().map_or(Ok(()), validate_wave)?;
        self.shallow_water.as_ref().map_or(Ok(()), |water| water.validate(self))?;
        self.noise.as_ref().map_or(Ok(()), noise::validate)?;
        self.sequence.as_ref().map_or(Ok(()), sequence::validate)?;
        self.shots.as_ref().map_or(Ok(()), Shots::validate)?;
        self.explosions.as_ref().map_or(Ok(()), Explosions::validate)?;
        self.healing.as_ref().map_or(Ok(()), Healing::validate)?;
        validate_tracks(&self.tracks)?;
        validate_imprints(&self.imprints)?;
        validate_trace(&self.trace)?;
        self.lod.threshold.map_or(Ok(()), |threshold| number("lod.threshold", threshold, LOD_THRESHOLD))?;
        validate_light(&self.light)?;
        validate_lights(&self.lights)?;
        validate_balls(&self.balls)?;
        validate_reliefs(&self.reliefs)?;
        validate_camera(&self.camera)
    }
}

/// Whether a camera can look from `eye` to `target`; else what they must be.
pub fn check_camera(eye: [f64; 3], target: [f64; 3]) -> Result<(), String> {
    // The reach of f32 metres with a hundredth of precision, twice over; a nanometre is nothing to look along.
    let reach = Range::from_to(-1e6, 1e6, "metres");
    if let Some(stray) = eye.iter().chain(&target).find(|&&coordinate| !reach.contains(coordinate)) {
        return Err(format!("{stray} is too far away, each coordinate must be {reach}"));
    }
    let squared: f64 = eye.iter().zip(&target).map(|(e, t)| (e - t) * (e - t)).sum();
    if squared.sqrt() < 1e-9 {
        return Err("eye and target are the same point, move one of them".to_owned());
    }
    Ok(())
}

pub(super) fn refuse<T>(key: impl Into<String>, value: impl ToString, allowed: impl ToString) -> Result<T, SceneError> {
    Err(SceneError::Value { key: key.into(), value: value.to_string(), allowed: allowed.to_string() })
}

pub(super) fn number(key: impl Into<String>, value: impl Into<f64> + ToString + Copy, range: Range) -> Result<(), SceneError> {
    if range.contains(value.into()) { Ok(()) } else { refuse(key, value, range) }
}

/// Checks that a simulation's cell of this side, metres, leaves room for what is computed of it: squares, quotients and the thousandth
/// of it that counts as dry are normal numbers of f32 then, with all the ranges of the simulation.
pub(super) fn cell_metres(of: &str, side: f64, width: f32) -> Result<(), SceneError> {
    let range = Range::from_to(1e-6, 1e6, "metres");
    if range.contains(side) {
        return Ok(());
    }
    refuse("plane.width_metres", width, format!("another: with `{of}` a cell, here {side:.3e} metres wide, must be {range}"))
}

pub(super) fn numbers<T: Into<f64> + ToString + Copy>(key: &str, values: &[T], range: Range) -> Result<(), SceneError> {
    values.iter().enumerate().try_for_each(|(i, &value)| number(format!("{key}[{i}]"), value, range))
}

/// What every relief has, the scene's own and those beside it.
fn validate_relief(
    field: &FieldSettings,
    plane: &Plane,
    base: &Base,
    material: &Material,
    mesh: Option<&Mesh>,
    brings_colours: bool,
) -> Result<(), SceneError> {
    if field.size.contains(&0) {
        let [width, height] = field.size;
        return refuse("field.size", format!("[{width}, {height}]"), "at least 1 texel wide and high");
    }
    number("plane.width_metres", plane.width_metres, Range::above(0.0, 1e6, "metres"))?;
    number("plane.depth_metres", plane.depth_metres, DEPTH_METRES)?;
    // A lattice position of 2²⁴ is the last that f32 tells from its neighbours.
    let most = (1 << 24) / field.size[0].max(field.size[1]);
    numbers("plane.repeat", &plane.repeat, Range::from_to(1.0, f64::from(most.max(1)), "times"))?;
    validate_base(base)?;
    validate_material(material, brings_colours || matches!(base, Base::StillLife {}))?;
    mesh.map_or(Ok(()), validate_mesh)
}

fn validate_reliefs(reliefs: &[Relief]) -> Result<(), SceneError> {
    if reliefs.len() > RELIEFS_MAX {
        let allowed = format!("at most {RELIEFS_MAX} beside the scene's own: remove some");
        return refuse("reliefs", format!("a list of {}", reliefs.len()), allowed);
    }
    reliefs.iter().enumerate().try_for_each(|(i, relief)| {
        let own = format!("reliefs[{i}]");
        numbers(&format!("{own}.position_metres"), &relief.position_metres, Range::from_to(-1e6, 1e6, "metres"))?;
        let turn = Range::from_to(-3600.0, 3600.0, "degrees");
        number(format!("{own}.yaw_degrees"), relief.yaw_degrees, turn)?;
        number(format!("{own}.pitch_degrees"), relief.pitch_degrees, turn)?;
        number(format!("{own}.roll_degrees"), relief.roll_degrees, turn)?;
        let Relief { field, plane, base, material, mesh, .. } = relief;
        validate_relief(field, plane, base, material, mesh.as_ref(), false).map_err(|error| error.within(&own))
    })
}

fn validate_base(base: &Base) -> Result<(), SceneError> {
    match base {
        Base::Flat { height } => number("base.height", *height, Range::from_to(0.0, 1.0, "")),
        Base::Bricks {}
        | Base::Cobbles {}
        | Base::Facade {}
        | Base::Snow {}
        | Base::Terrain {}
        | Base::Beach {}
        | Base::Fur {}
        | Base::Grass {} => Ok(()),
        Base::Landscape {} | Base::Planet {} | Base::Ornament {} | Base::StillLife {} => Ok(()),
        Base::Text(text) => validate_text(text),
        Base::Image { path, .. } if path.as_os_str().is_empty() => refuse("base.path", "empty", "the path of a PNG or EXR file"),
        Base::Image { range: Some([low, high]), .. } if !(low < high && (high - low).is_finite()) => {
            refuse("base.range", format!("[{low}, {high}]"), "two finite numbers, the first less than the second")
        }
        Base::Image { .. } => Ok(()),
    }
}

fn validate_text(text: &Text) -> Result<(), SceneError> {
    if let Err(problem) = check_text(&text.text) {
        return refuse("base.text", format!("{:?}", text.text), format!("another: {problem}"));
    }
    if text.font.as_ref().is_some_and(|font| font.as_os_str().is_empty()) {
        return refuse("base.font", "empty", "the path of a TTF or OTF font, or left out");
    }
    number("base.size", text.size, Range::above(0.0, 1.0, ""))?;
    // Wider than any stroke; what is wider still would be no letter.
    number("base.weight", text.weight, Range::from_to(-0.2, 0.2, "em"))?;
    number("base.bevel", text.bevel, Range::from_to(0.0, 1.0, "em"))?;
    // Three of them on either side leave room for the text.
    number("base.frame", text.frame, Range::from_to(0.0, 0.1, "of the shorter side"))?;
    number("base.grain", text.grain, Range::from_to(0.0, 1.0, "of the depth"))
}

fn validate_mesh(mesh: &Mesh) -> Result<(), SceneError> {
    if let Some(radius) = mesh.radius_metres {
        number("mesh.radius_metres", radius, Range::above(0.0, 1e6, "metres"))?;
    }
    numbers("mesh.tiles", &mesh.tiles, Range::above(0.0, 1e4, "tiles"))?;
    for (i, material) in mesh.materials.iter().enumerate() {
        if let Some(depth) = material.depth_metres {
            number(format!("mesh.materials[{i}].depth_metres"), depth, DEPTH_METRES)?;
        }
        if let Some([fewest, most]) = material.samples {
            let key = format!("mesh.materials[{i}].samples");
            numbers(&key, &[fewest, most], SAMPLES)?;
            if fewest > most {
                return refuse(key, format!("[{fewest}, {most}]"), "the fewest samples, then the most");
            }
        }
    }
    Ok(())
}

fn validate_balls(balls: &[Ball]) -> Result<(), SceneError> {
    if balls.len() > BALLS_MAX {
        return refuse("balls", format!("a list of {}", balls.len()), format!("at most {BALLS_MAX} balls"));
    }
    for (i, ball) in balls.iter().enumerate() {
        numbers(&format!("balls[{i}].centre"), &ball.centre, Range::from_to(-1e6, 1e6, "metres"))?;
        number(format!("balls[{i}].radius_metres"), ball.radius_metres, Range::above(0.0, 1e6, "metres"))?;
        numbers(&format!("balls[{i}].colour"), &ball.colour, Range::from_to(0.0, 1.0, ""))?;
    }
    Ok(())
}

fn validate_wave(wave: &Wave) -> Result<(), SceneError> {
    number("wave.speed_metres_per_second", wave.speed_metres_per_second, Range::above(0.0, 1e4, "metres per second"))?;
    let courant = f64::from(wave.courant);
    if !(courant > 0.0 && courant * courant <= COURANT_SQUARED_MAX) {
        let allowed = format!(
            "a number above 0 and at most {} (its square at most {COURANT_SQUARED_MAX}), beyond which waves grow without bound",
            COURANT_SQUARED_MAX.sqrt()
        );
        return refuse("wave.courant", wave.courant, allowed);
    }
    number("wave.damping_per_second", wave.damping_per_second, Range::from_to(0.0, 1000.0, "per second"))?;
    number("wave.sponge_texels", wave.sponge_texels, Range::from_to(1.0, 16384.0, "texels"))?;
    number("wave.amplitude", wave.amplitude, Range::from_to(0.0, 1.0, ""))?;
    if let Some(rain) = &wave.rain {
        number("wave.rain.drops_per_second", rain.drops_per_second, Range::from_to(0.0, 1e5, "per second"))?;
        number("wave.rain.radius_metres", rain.radius_metres, Range::above(0.0, 1e6, "metres"))?;
        number("wave.rain.strength", rain.strength, Range::from_to(0.0, 100.0, ""))?;
    }
    wave.obstacles.iter().enumerate().try_for_each(|(i, obstacle)| validate_obstacle(i, obstacle))
}

fn validate_obstacle(i: usize, obstacle: &Obstacle) -> Result<(), SceneError> {
    let key = |name: &str| format!("wave.obstacles[{i}].{name}");
    numbers(&key("centre"), &obstacle.centre, Range::from_to(0.0, 1.0, ""))?;
    numbers(&key("half_extent_metres"), &obstacle.half_extent_metres, Range::above(0.0, 1e6, "metres"))?;
    number(key("corner_metres"), obstacle.corner_metres, Range::from_to(0.0, 1e6, "metres"))?;
    number(key("top"), obstacle.top, Range::from_to(0.0, 1.0, ""))
}

fn validate_trace(trace: &Trace) -> Result<(), SceneError> {
    number("trace.steep_layers", trace.steep_layers, Range::from_to(1.0, f64::from(SAMPLES_MAX), "layers"))?;
    number("trace.relief_linear_steps", trace.relief_linear_steps, SAMPLES)?;
    // f32 has 24 bits: further halvings find the same place.
    number("trace.relief_binary_steps", trace.relief_binary_steps, Range::from_to(1.0, 24.0, "samples"))?;
    number("trace.pom_samples_min", trace.pom_samples_min, SAMPLES)?;
    number("trace.pom_samples_max", trace.pom_samples_max, SAMPLES)?;
    let [fewest, most] = MESH_TRIANGLES.map(f64::from);
    number("trace.mesh_triangles", trace.mesh_triangles, Range::from_to(fewest, most, "triangles"))?;
    if trace.pom_samples_min > trace.pom_samples_max {
        let allowed = format!("at most `trace.pom_samples_max`, {}", trace.pom_samples_max);
        return refuse("trace.pom_samples_min", trace.pom_samples_min, allowed);
    }
    number("trace.shadow_samples", trace.shadow_samples, SAMPLES)?;
    number("trace.shadow_strength", trace.shadow_strength, Range::from_to(0.0, 1000.0, ""))?;
    // Mesa's software adapter ends every loop of a pixel after 65,536 rounds of all of them: a hundred nodes a ray must fit.
    number("trace.area_samples", trace.area_samples, Range::from_to(1.0, 512.0, "samples"))?;
    number("trace.step_cap", trace.step_cap, Range::from_to(1.0, 16_777_216.0, "steps"))?;
    number("trace.supersampling", trace.supersampling, Range::from_to(1.0, 8.0, "rays along a pixel's side"))
}

fn validate_light(light: &Light) -> Result<(), SceneError> {
    validate_directional("light", &DirectionalLight::of(light))?;
    number("light.half_angle_degrees", light.half_angle_degrees, LIGHT_HALF_ANGLE_DEGREES)?;
    numbers("light.sky", &light.sky, RADIANCE)?;
    numbers("light.ground", &light.ground, RADIANCE)
}

fn validate_lights(lights: &[DirectionalLight]) -> Result<(), SceneError> {
    if lights.len() >= LIGHTS_MAX {
        let allowed = format!("at most {} beside `[light]`: remove some", LIGHTS_MAX - 1);
        return refuse("lights", format!("a list of {}", lights.len()), allowed);
    }
    lights.iter().enumerate().try_for_each(|(i, light)| validate_directional(&format!("lights[{i}]"), light))
}

fn validate_directional(key: &str, light: &DirectionalLight) -> Result<(), SceneError> {
    let key = |name: &str| format!("{key}.{name}");
    number(key("azimuth_degrees"), light.azimuth_degrees, Range::from_to(-3600.0, 3600.0, "degrees"))?;
    number(key("elevation_degrees"), light.elevation_degrees, Range::from_to(-90.0, 90.0, "degrees"))?;
    numbers(&key("colour"), &light.colour, RADIANCE)?;
    number(key("intensity"), light.intensity, RADIANCE)?;
    let turn = Range::from_to(-3600.0, 3600.0, "degrees per second");
    number(key("turn_degrees_per_second"), light.turn_degrees_per_second, turn)
}

fn validate_material(material: &Material, scene_has_colours: bool) -> Result<(), SceneError> {
    match &material.image {
        Some(path) if path.as_os_str().is_empty() => {
            return refuse("material.image", "empty", "the path of a PNG file, or left out");
        }
        None if material.albedo == Albedo::Image && !scene_has_colours => {
            return refuse(
                "material.albedo",
                "image",
                "another, or `material.image` the path of a PNG file (--albedo names one)",
            );
        }
        _ => {}
    }
    numbers("material.tint", &material.tint, Range::from_to(0.0, 10.0, ""))?;
    let share = Range::from_to(0.0, 1.0, "");
    number("material.specular", material.specular, share)?;
    number("material.roughness", material.roughness, share)?;
    number("material.metallic", material.metallic, share)?;
    number("material.reflection", material.reflection, share)?;
    number("material.refractive_index", material.refractive_index, Range::from_to(1.0, 4.0, ""))?;
    number("material.shininess", material.shininess, Range::above(0.0, 1e5, ""))
}

fn validate_camera(camera: &Camera) -> Result<(), SceneError> {
    if let Err(problem) = check_camera(camera.eye, camera.target) {
        return refuse(
            "camera.eye",
            format!("{:?} with `camera.target` {:?}", camera.eye, camera.target),
            format!("another: {problem}"),
        );
    }
    number("camera.vertical_fov_degrees", camera.vertical_fov_degrees, VERTICAL_FOV_DEGREES)?;
    number("camera.near_metres", camera.near_metres, Range::above(0.0, 1e4, "metres"))?;
    number(
        "camera.orbit_degrees_per_second",
        camera.orbit_degrees_per_second,
        Range::from_to(-3600.0, 3600.0, "degrees per second"),
    )?;
    if let Some(swing) = &camera.swing {
        // Beyond a quarter turn it would look at the back of things after all.
        number("camera.swing.degrees", swing.degrees, Range::from_to(-90.0, 90.0, "degrees"))?;
        number("camera.swing.period_seconds", swing.period_seconds, Range::from_to(0.1, 3600.0, "seconds"))?;
    }
    numbers("camera.fly_metres_per_second", &camera.fly_metres_per_second, Range::from_to(-1e4, 1e4, "metres per second"))
}

#[cfg(test)]
mod tests {
    use super::super::{
        Boundary, Columns, Dunes, FractalNoise, Gas, GasBands, GasBorder, GasEmitters, Gears, Imprint, Lod, Noise, NoisePattern,
        Rain, Scales, Sequence, Swing, Track,
    };
    use super::*;

    /// A scene with every optional part, so that every range is reached.
    fn full() -> Scene {
        let obstacle = Obstacle { centre: [0.5, 0.5], half_extent_metres: [0.1, 0.1], corner_metres: 0.0, top: 1.0 };
        let relief = Relief {
            base: Base::Text(Text::default()),
            mesh: Some(Mesh { radius_metres: Some(1.0), tiles: [1.0; 2], ..Mesh::default() }),
            ..Relief::default()
        };
        Scene {
            shallow_water: Some(crate::scene::ShallowWater::full()),
            wave: Some(Wave {
                boundary: Boundary::Absorbing,
                rain: Some(Rain::default()),
                obstacles: vec![obstacle],
                ..Wave::default()
            }),
            sequence: Some(Sequence { heights: "series".into(), ..Sequence::default() }),
            shots: Some(Shots::default()),
            gas: Some(Gas {
                border_u: GasBorder::Closed,
                bands: Some(GasBands::default()),
                emitters: Some(GasEmitters::default()),
                ..Gas::default()
            }),
            explosions: Some(Explosions::default()),
            tracks: vec![Track::default()],
            imprints: vec![Imprint { text: Some("R".to_owned()), ..Imprint::default() }],
            healing: Some(Healing::default()),
            lod: Lod { threshold: Some(4.0), ..Lod::default() },
            lights: vec![DirectionalLight::default(); LIGHTS_MAX - 1],
            reliefs: vec![relief],
            camera: Camera { swing: Some(Swing { degrees: 30.0, period_seconds: 8.0 }), ..Camera::default() },
            ..Scene::default()
        }
    }

    #[test]
    fn a_fifth_light_is_refused() {
        let mut scene = full();
        scene.lights.push(DirectionalLight::default());
        let error = scene.validate().expect_err("five lights").to_string();
        assert!(error.contains("at most 3 beside `[light]`"), "{error}");
    }

    #[test]
    fn an_eighth_relief_is_refused_and_another_says_which_it_is() {
        let mut scene = Scene { reliefs: vec![Relief::default(); RELIEFS_MAX + 1], ..Scene::default() };
        let error = scene.validate().expect_err("eight").to_string();
        assert!(error.contains("`reliefs` is a list of 8") && error.contains("at most 7 beside the scene's own"), "{error}");
        scene.reliefs.pop();
        assert_eq!(scene.validate(), Ok(()));
        scene.reliefs[6].field.size = [0, 8];
        scene.reliefs[6].material.albedo = Albedo::Image;
        let error = scene.validate().expect_err("no texel").to_string();
        assert!(error.starts_with("`reliefs[6].field.size` is [0, 8]"), "{error}");
        scene.reliefs[6].field.size = [8, 8];
        let error = scene.validate().expect_err("no image").to_string();
        assert!(error.starts_with("`reliefs[6].material.albedo` is image"), "{error}");
    }

    #[test]
    fn the_defaults_are_valid() {
        assert_eq!(Scene::default().validate(), Ok(()));
        assert_eq!(full().validate(), Ok(()));
    }

    #[test]
    fn every_number_has_a_range() {
        // Each number of the scene in turn becomes NaN, or 0 texels, or what else no key allows, by way of its JSON.
        fn leaves(value: &serde_json::Value, path: &str, found: &mut Vec<String>) {
            match value {
                serde_json::Value::Object(map) => map.iter().for_each(|(k, v)| leaves(v, &format!("{path}/{k}"), found)),
                serde_json::Value::Array(list) => {
                    list.iter().enumerate().for_each(|(i, v)| leaves(v, &format!("{path}/{i}"), found));
                }
                serde_json::Value::Number(_) => found.push(path.to_owned()),
                _ => {}
            }
        }
        let patterns = [
            NoisePattern::Fractal(FractalNoise::default()),
            NoisePattern::Columns(Columns::default()),
            NoisePattern::Scales(Scales::default()),
            NoisePattern::Gears(Gears::default()),
            NoisePattern::Dunes(Dunes::default()),
        ];
        let scenes = patterns.map(|pattern| Scene { noise: Some(Noise { pattern, ..Noise::default() }), ..full() });
        let wholes = scenes.map(|scene| serde_json::to_value(scene).unwrap());
        let paths = wholes.iter().flat_map(|whole| {
            let mut found = Vec::new();
            leaves(whole, "", &mut found);
            assert!(found.len() > 50, "{found:?}");
            found.into_iter().map(move |path| (whole, path))
        });
        for (whole, path) in paths.filter(|(_, path)| path != "/seed") {
            let path = path.as_str();
            let mut poisoned = whole.clone();
            let slot = poisoned.pointer_mut(path).unwrap();
            // There may be no waves, but not a thousand.
            let none = if path.contains("/waves/") { 1000 } else { 0 };
            *slot = if slot.is_u64() { none.into() } else { serde_json::json!(-1e30) };
            let scene: Scene = serde_json::from_value(poisoned).unwrap();
            let error = scene.validate().expect_err(path).to_string();
            let key = path.split('/').rfind(|part| part.parse::<usize>().is_err()).unwrap();
            assert!(error.contains(key), "{path}: {error}");
            assert!(!error.contains('\n'), "{error}");
        }
    }

    #[test]
    fn a_wave_that_would_grow_is_refused() {
        let mut scene = full();
        for (courant, stable) in [(0.7, true), (0.700_001, false), (0.0, false), (-0.5, false), (f32::NAN, false)] {
            scene.wave.as_mut().unwrap().courant = courant;
            assert_eq!(scene.validate().is_ok(), stable, "{courant}");
        }
    }

    #[test]
    fn nan_lies_in_no_range() {
        assert!(!Range::from_to(0.0, 1.0, "").contains(f64::NAN));
        assert_eq!(Range::above(0.0, 2.0, "metres").to_string(), "a number above 0 and at most 2 metres");
        assert_eq!(VERTICAL_FOV_DEGREES.to_string(), "a number above 0 and below 180 degrees");
    }

    #[test]
    fn a_camera_looks_somewhere() {
        assert!(check_camera([0.0, 1.0, 0.0], [0.0; 3]).is_ok());
        assert!(check_camera([1.0; 3], [1.0; 3]).is_err());
        assert!(check_camera([1e9, 0.0, 0.0], [1.0; 3]).is_err());
    }
}
