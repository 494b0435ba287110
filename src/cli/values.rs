//! The text of a value to the value, or else the rest of the sentence "`--flag` cannot be `text`: …".

use super::{Channel, Export, Truth};
use crate::io::scene_file::{CameraPlacement, FieldSize};
use crate::mesh::MeshSource;
use crate::scene::{self, Playback, PomCounts, PyramidLeaf};
use crate::suggest;
use crate::surface::{Shading, Shadow, Technique};

pub(super) fn technique_help() -> String {
    format!("How the surface is traced: {} [default: the scene's]", technique_names("or"))
}

pub(super) fn shadow_help() -> String {
    format!("The shadow upon it: {} [default: the scene's]", shadow_names("or"))
}

pub(super) fn techniques_help() -> String {
    format!("Techniques to compare, of {} [default: all of them, or that of --technique]", technique_names("and"))
}

pub(super) fn shadows_help() -> String {
    format!("Shadows to compare each of them with, of {} [default: the scene's, or that of --shadow]", shadow_names("and"))
}

fn technique_names(conjunction: &str) -> String {
    let names: Vec<_> = Technique::ALL.iter().map(|choice| choice.name()).collect();
    suggest::enumerate(&names, conjunction)
}

fn shadow_names(conjunction: &str) -> String {
    let names: Vec<_> = Shadow::ALL.iter().map(|choice| choice.name()).collect();
    suggest::enumerate(&names, conjunction)
}

pub(super) fn shading_help() -> String {
    let names: Vec<_> = Shading::ALL.iter().map(|choice| choice.name()).collect();
    format!("What light does to it: {} [default: the scene's]", suggest::enumerate(&names, "or"))
}

/// One of a list, by its name.
pub(super) fn one_of<T: Copy>(kind: &str, text: &str, all: &[T], name: impl Fn(T) -> &'static str) -> Result<T, String> {
    let names: Vec<_> = all.iter().map(|&choice| name(choice)).collect();
    all.iter().copied().find(|&choice| name(choice) == text).ok_or_else(|| suggest::unknown(kind, text, &names))
}

pub(super) fn shading(text: &str) -> Result<Shading, String> {
    one_of("shading", text, Shading::ALL, Shading::name)
}

pub(super) fn technique(text: &str) -> Result<Technique, String> {
    let names: Vec<_> = Technique::ALL.iter().map(|choice| choice.name()).collect();
    Technique::from_name(text).ok_or_else(|| suggest::unknown("technique", text, &names))
}

pub(super) fn shadow(text: &str) -> Result<Shadow, String> {
    let names: Vec<_> = Shadow::ALL.iter().map(|choice| choice.name()).collect();
    Shadow::from_name(text).ok_or_else(|| suggest::unknown("shadow", text, &names))
}

pub(super) fn pom_counts_help() -> String {
    let names = PomCounts::ALL.iter().map(|choice| choice.name()).collect::<Vec<_>>();
    format!(
        "How pom and pom-linear choose their counts: {} (one for each that the offset crosses, MIN of --samples at the least) \
         [default: the scene's]",
        suggest::enumerate(&names, "or")
    )
}

pub(super) fn pom_counts(text: &str) -> Result<PomCounts, String> {
    let names: Vec<_> = PomCounts::ALL.iter().map(|choice| choice.name()).collect();
    let found = PomCounts::ALL.iter().copied().find(|choice| choice.name() == text);
    found.ok_or_else(|| suggest::unknown("way to count", text, &names))
}

pub(super) fn pyramid_leaf_help() -> String {
    let names: Vec<_> = PyramidLeaf::ALL.iter().map(|choice| choice.name()).collect();
    format!("What pyramid makes of the texel that a ray meets: {} [default: the scene's]", suggest::enumerate(&names, "or"))
}

pub(super) fn pyramid_leaf(text: &str) -> Result<PyramidLeaf, String> {
    let names: Vec<_> = PyramidLeaf::ALL.iter().map(|choice| choice.name()).collect();
    let found = PyramidLeaf::ALL.iter().copied().find(|choice| choice.name() == text);
    found.ok_or_else(|| suggest::unknown("leaf", text, &names))
}

pub(super) fn playback_help() -> String {
    let names: Vec<_> = Playback::ALL.iter().map(|choice| choice.name()).collect();
    format!("What comes after the series' last image: {} [default: the scene's, or else loop]", suggest::enumerate(&names, "or"))
}

pub(super) fn playback(text: &str) -> Result<Playback, String> {
    one_of("playback", text, Playback::ALL, Playback::name)
}

#[expect(clippy::cast_possible_truncation, reason = "a rate has no use for more digits")]
pub(super) fn sequence_rate(text: &str) -> Result<f32, String> {
    number_within(text, scene::IMAGES_PER_SECOND).map(|number| number as f32)
}

pub(super) fn switch(text: &str) -> Result<bool, String> {
    match text {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(suggest::unknown("switch", text, &["on", "off"])),
    }
}

/// Fewest and most samples of a ray, within what a scene may say.
pub(super) fn sample_range(text: &str) -> Result<[u32; 2], String> {
    let counts = text.split_once(',').map(|(least, most)| (least.trim().parse(), most.trim().parse()));
    match counts {
        Some((Ok(least), Ok(most))) if 1 <= least && least <= most && most <= scene::SAMPLES_MAX => Ok([least, most]),
        _ => Err(format!(
            "it must be two whole numbers from 1 to {}, the first no more than the second, like 8,50",
            scene::SAMPLES_MAX
        )),
    }
}

/// A threshold of the level of detail, or none: off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Detail(pub(super) Option<f32>);

#[expect(clippy::cast_possible_truncation, reason = "a mip level has no use for more digits")]
pub(super) fn lod(text: &str) -> Result<Detail, String> {
    match text {
        "off" => Ok(Detail(None)),
        _ => number_within(text, scene::LOD_THRESHOLD)
            .map(|level| Detail(Some(level as f32)))
            .map_err(|problem| format!("{problem}, or off")),
    }
}

pub(super) fn mesh_triangles(text: &str) -> Result<u32, String> {
    let [fewest, most] = scene::MESH_TRIANGLES;
    let found = text.parse().ok().filter(|count| (fewest..=most).contains(count));
    found.ok_or_else(|| format!("it must be a whole number from {fewest} to {most}"))
}

pub(super) fn mesh(text: &str) -> Result<MeshSource, String> {
    text.parse()
}

pub(super) fn channel(text: &str) -> Result<Channel, String> {
    let names = Channel::ALL.map(Channel::name);
    let found = Channel::ALL.into_iter().find(|channel| channel.name() == text);
    found.ok_or_else(|| suggest::unknown("channel", text, &names))
}

pub(super) fn export_help() -> String {
    let names = Export::ALL.map(Export::name);
    format!(
        "Images of the field itself to write beside each frame, of {}: heights as 16-bit grey (0 is 0, 1 is 65535) or to the bit, \
         normals as 16-bit RGB with green up (gl) or down the image (dx), layers as they are [default: none]",
        suggest::enumerate(&names, "and")
    )
}

pub(super) fn export(text: &str) -> Result<Export, String> {
    one_of("export", text, &Export::ALL, Export::name)
}

pub(super) fn truth(text: &str) -> Result<Truth, String> {
    let names = Truth::ALL.map(Truth::name);
    let found = Truth::ALL.into_iter().find(|truth| truth.name() == text);
    found.ok_or_else(|| suggest::unknown("truth", text, &names))
}

pub(super) fn backend(text: &str) -> Result<wgpu::Backends, String> {
    match text {
        "vulkan" => Ok(wgpu::Backends::VULKAN),
        "metal" => Ok(wgpu::Backends::METAL),
        "dx12" => Ok(wgpu::Backends::DX12),
        "gl" => Ok(wgpu::Backends::GL),
        _ => Err(suggest::unknown("backend", text, &["vulkan", "metal", "dx12", "gl"])),
    }
}

pub(super) fn non_empty(text: &str) -> Result<String, String> {
    if text.is_empty() { Err("it is empty".to_owned()) } else { Ok(text.to_owned()) }
}

pub(super) fn whole_u64(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("it must be a whole number from 0 to {}", u64::MAX))
}

pub(super) fn whole_u32(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("it must be a whole number from 0 to {}", u32::MAX))
}

/// Stamps of a frame. A stamp is 48 bytes before the bins can say that their tiles are too many.
pub(super) fn stamps(text: &str) -> Result<u32, String> {
    const MOST: u32 = 1 << 22;
    whole_u32(text).ok().filter(|count| *count <= MOST).ok_or_else(|| format!("it must be a whole number from 0 to {MOST}"))
}

fn positive_u32(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err(format!("it must be a whole number from 1 to {}", u32::MAX)),
    }
}

/// Samples along a ray.
pub(super) fn samples(text: &str) -> Result<u32, String> {
    let count = positive_u32(text).ok().filter(|count| *count <= scene::SAMPLES_MAX);
    count.ok_or_else(|| format!("each must be a whole number from 1 to {}", scene::SAMPLES_MAX))
}

pub(super) fn field_width(text: &str) -> Result<u32, String> {
    positive_u32(text).map_err(|_| format!("each must be a whole number from 1 to {}", u32::MAX))
}

pub(super) fn frames(text: &str) -> Result<u32, String> {
    positive_u32(text)
}

pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X']).map(|(width, height)| (positive_u32(width), positive_u32(height)));
    match sides {
        Some((Ok(width), Ok(height))) => Ok([width, height]),
        _ => Err("it must be a width and a height of at least 1, like 640x480".to_owned()),
    }
}

pub(super) fn field(text: &str) -> Result<FieldSize, String> {
    if let Ok(width) = positive_u32(text) {
        return Ok(FieldSize::Width(width));
    }
    size(text)
        .map(FieldSize::Exactly)
        .map_err(|_| "it must be a width like 512, or a size like 1024x512, of at least 1".to_owned())
}

/// Finite numbers between commas, exactly `N` of them.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|number: &f64| number.is_finite())).collect();
    numbers?.try_into().ok()
}

/// One finite number within a range that excludes its lower end where that is 0.
fn number_within(text: &str, range: scene::Range) -> Result<f64, String> {
    match numbers::<1>(text) {
        Some([number]) if range.contains(number) => Ok(number),
        _ => Err(format!("it must be {range}")),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "metres and texels are f32 throughout")]
pub(super) fn depth(text: &str) -> Result<f32, String> {
    number_within(text, scene::DEPTH_METRES).map(|number| number as f32)
}

#[expect(clippy::cast_possible_truncation, reason = "metres and texels are f32 throughout")]
pub(super) fn stamp_radius(text: &str) -> Result<f32, String> {
    number_within(text, scene::Range::above(0.0, 65536.0, "texels")).map(|number| number as f32)
}

pub(super) fn fov(text: &str) -> Result<f64, String> {
    number_within(text, scene::VERTICAL_FOV_DEGREES)
}

#[expect(clippy::cast_possible_truncation, reason = "the light is f32 throughout")]
pub(super) fn light_angle(text: &str) -> Result<f32, String> {
    number_within(text, scene::LIGHT_HALF_ANGLE_DEGREES).map(|number| number as f32)
}

pub(super) fn dt(text: &str) -> Result<f64, String> {
    // An hour a frame: beyond it a simulation that keeps its own step would seem to hang.
    number_within(text, scene::Range::above(0.0, 3600.0, "seconds"))
}

pub(super) fn height_range(text: &str) -> Result<[f32; 2], String> {
    #[expect(clippy::cast_possible_truncation, reason = "images are read as f32")]
    let range = numbers::<2>(text).map(|range| range.map(|bound| bound as f32));
    match range {
        Some([low, high]) if low < high && (high - low).is_finite() => Ok([low, high]),
        Some([low, high]) if low < high => Err("the two numbers are too far apart: scale the image down".to_owned()),
        Some(_) => Err("the first number must be less than the second".to_owned()),
        None => Err("it must be two numbers, like 0,1000".to_owned()),
    }
}

/// The words of a sign. A shell's quotes keep `\n` as two characters: here it ends a line, as in a scene.
pub(super) fn sign(text: &str) -> Result<String, String> {
    let text = text.replace("\\n", "\n");
    scene::check_text(&text).map(|()| text)
}

pub(super) fn camera(text: &str) -> Result<CameraPlacement, String> {
    let Some([ex, ey, ez, tx, ty, tz]) = numbers::<6>(text) else {
        return Err("it must be six numbers, eye and target in metres, like 0,1,1,0,0,0".to_owned());
    };
    let camera = CameraPlacement { eye: [ex, ey, ez], target: [tx, ty, tz] };
    scene::check_camera(camera.eye, camera.target).map(|()| camera)
}
