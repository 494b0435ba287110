//! Every composition of shaders, without a GPU: it parses, it validates, and its structs are laid out as their Rust twins are.

use std::mem::{offset_of, size_of};

use rilievo::field::bins::{Member, Tile};
use rilievo::field::blocks::Blocks;
use rilievo::field::bounds::BoundsParams;
use rilievo::field::compose::{ComposeLayer, ComposeParams};
use rilievo::field::cool::CoolParams;
use rilievo::field::gas::GasParams;
use rilievo::field::gas_emit::{GasBatch, GasPuff};
use rilievo::field::gas_force::GasRow;
use rilievo::field::gas_project::GasLevel;
use rilievo::field::heal::HealParams;
use rilievo::field::noise::{
    NoiseColumns, NoiseDunes, NoiseFractal, NoiseGear, NoiseGears, NoiseLattice, NoiseParams, NoiseScales, PATTERNS,
};
use rilievo::field::normal_mips::NormalMipsParams;
use rilievo::field::normals::NormalsParams;
use rilievo::field::pyramid::PyramidParams;
use rilievo::field::shallow_water::{
    Event, ShallowWaterBatch, ShallowWaterBody, ShallowWaterControl, ShallowWaterParams, ShallowWaterSpell,
};
use rilievo::field::stamp::{Blend, Profile, StampExtra, StampParams, StampRecord, Stamps};
use rilievo::field::wave::{WaveBatch, WaveImpulse, WaveParams};
use rilievo::gpu::Library;
use rilievo::present::{PresentParams, PresentSide};
use rilievo::scene::{Fold, LayerBlend, PomCounts, PyramidLeaf};
use rilievo::surface::channels::Channel;
use rilievo::surface::level_of_detail::ViewDetail;
use rilievo::surface::light_probe::{Lit, Matter};
use rilievo::surface::probe::{Hit, Ray};
use rilievo::surface::raster::{Geometry, RasterVertex};
use rilievo::surface::ray_map::LinearForm;
use rilievo::surface::reliefs::Slab;
use rilievo::surface::shell::ShellTriangle;
use rilievo::surface::view::{Ball, ViewLight};
use rilievo::surface::{self, Albedo, Choice, Shading, Shadow, Shows, Technique, View};
use wgpu::naga;

/// Every composition that the program can ask for.
fn compositions() -> Vec<Vec<String>> {
    let fixed: [&[&str]; 20] = [
        &["common/region", "common/range", "field/bounds"],
        &["common/region", "field/compose"],
        &["common/gas", "field/gas_activity"],
        &["common/gas", "field/gas_advect"],
        &["common/gas", "field/gas_emit"],
        &["common/gas", "field/gas_force"],
        &["field/gas_project_smooth", "field/gas_project"],
        &["common/gas", "field/gas_show"],
        &["common/region", "field/normal_mips"],
        &["common/region", "field/normals"],
        &["common/region", "field/pyramid"],
        &["common/noise", "common/material", "common/profile", "common/marks", "field/stamp"],
        &["common/material", "field/cool"],
        &["common/material", "field/heal"],
        &["field/wave"],
        &["common/shallow_water", "field/shallow_water_flux", "field/shallow_water"],
        &["common/shallow_water", "field/shallow_water_disturb"],
        &["common/shallow_water", "field/shallow_water_plan"],
        &["common/shallow_water", "field/shallow_water_publish"],
        &["common/heat", "common/legend", "present"],
    ];
    let mut all: Vec<Vec<String>> = fixed.iter().map(|parts| parts.iter().map(|&part| part.to_owned()).collect()).collect();
    all.extend(PATTERNS.map(|pattern| ["field/noise", pattern].map(str::to_owned).to_vec()));
    // Parts meet only through the functions that they share by name: each with each of another kind, not all with all.
    let plain = Choice::PLAIN;
    let techniques = Technique::ALL.iter().map(|&technique| Choice { technique, ..plain });
    let shadows = Shadow::ALL.iter().map(|&shadow| Choice { technique: Technique::Exact, shadow, ..plain });
    let albedos = Albedo::ALL.iter().map(|&albedo| Choice { shadow: Shadow::Hard, albedo, ..plain });
    for choice in techniques.chain(shadows).chain(albedos) {
        for filters in [false, true] {
            for entry in ["surface", "channels", "probe"] {
                all.push(surface::parts(filters, choice, &[entry]));
            }
        }
        for geometry in Geometry::ALL {
            all.push(surface::parts(true, choice, geometry.stems()));
        }
    }
    all.push(surface::parts(true, Choice { caps_level: true, ..plain }, &["surface"]));
    for &shading in Shading::ALL {
        all.push(surface::parts(true, Choice { shading, ..plain }, &["light_probe"]));
        for with_truth in [false, true] {
            all.push(surface::parts(true, Choice { shading, with_truth, ..plain }, &["surface"]));
        }
    }
    all
}

fn module(parts: &[String]) -> naga::Module {
    let parts: Vec<_> = parts.iter().map(String::as_str).collect();
    let composition = Library::embedded().compose(&parts).unwrap_or_else(|error| panic!("{parts:?}: {error}"));
    composition.validate().unwrap_or_else(|error| panic!("{parts:?}: {error}"))
}

#[test]
fn every_composition_parses_and_validates() {
    for parts in compositions() {
        module(&parts);
    }
}

#[test]
fn an_error_names_the_part_and_its_own_line() {
    let mut library = Library::embedded();
    library.replace("field/normals", "// one\n// two\nfn broken() -> f32 { return missing; }\n".to_owned());
    let composition = library.compose(&["common/noise", "field/normals"]).expect("both parts exist");
    let error = composition.validate().expect_err("`missing` is nowhere defined").to_string();
    assert!(error.starts_with("shaders/field/normals.wgsl:3: "), "{error}");
    assert!(library.compose(&["field/nonsense"]).is_err());
}

/// A struct's layout: the offset of each field by name, and the size of the whole.
#[derive(Debug, PartialEq)]
struct Layout {
    fields: Vec<(String, usize)>,
    size: usize,
}

/// The layout of a Rust struct. Fields named `pad…` or `spare…` are padding, which WGSL need not name.
macro_rules! layout {
    ($type:ty { $($field:ident),+ $(,)? }) => {
        Layout { fields: vec![$((stringify!($field).to_owned(), offset_of!($type, $field))),+], size: size_of::<$type>() }
    };
}

fn is_padding(name: &str) -> bool {
    name.starts_with("pad") || name.starts_with("spare")
}

fn wgsl_layout(module: &naga::Module, name: &str) -> Option<Layout> {
    module.types.iter().find_map(|(_, candidate)| match &candidate.inner {
        naga::TypeInner::Struct { members, span } if candidate.name.as_deref() == Some(name) => Some(Layout {
            fields: members
                .iter()
                .map(|member| (member.name.clone().unwrap_or_default(), member.offset as usize))
                .filter(|(field, _)| !is_padding(field))
                .collect(),
            size: *span as usize,
        }),
        _ => None,
    })
}

/// Every struct that both sides know: its WGSL name and the layout of its Rust twin.
fn twins() -> Vec<(&'static str, Layout)> {
    vec![
        ("LinearForm", layout!(LinearForm { exact, rest })),
        (
            "View",
            layout!(View {
                lattice_x,
                lattice_y,
                travel_x,
                travel_y,
                denominator,
                field_size,
                wrap,
                step_cap,
                plane_size_metres,
                depth_metres,
                nearest,
                pom_samples_min,
                pom_samples_max,
                shadow_samples,
                shadow_strength,
                pom_counts,
                steep_layers,
                relief_linear_steps,
                relief_binary_steps,
                relief_depth_bias,
                pyramid_leaf,
                u_world,
                first_row,
                v_world,
                displaced_depth,
                up_world,
                mesh_quads,
                origin_world,
                eye_world,
                specular,
                light_world,
                shininess,
                light_radiance,
                rest_height,
                sky,
                texel_metres,
                ground,
                shows,
                tint,
                roughness,
                image_size,
                planar,
                ball_count,
                metallic,
                reflection,
                index,
                gain,
                light_radius,
                area_samples,
                level_cap,
                lights,
                direction_x,
                direction_y,
                direction_z,
                clip_from_eye,
                eye_rest,
                near_metres,
                forward_world,
                balls,
                repeat,
                slab_count,
                own_slab,
                moment,
                glow,
                detail,
                slabs,
                water_absorption,
                slab_penumbra,
                water_scatter,
                core_centre,
                core_radius,
                outline,
            }),
        ),
        ("ViewDetail", layout!(ViewDetail { threshold, traces, filters })),
        ("Slab", layout!(Slab { middle, depth, along_u, half_extent_u, along_v, half_extent_v })),
        ("Ball", layout!(Ball { centre, radius, colour })),
        ("RasterVertex", layout!(RasterVertex { position, u, normal, v, tangent, handedness, inward, metres_per_uv })),
        ("ShellTriangle", layout!(ShellTriangle { vertices, borders })),
        ("ViewLight", layout!(ViewLight { toward, casts_shadow, radiance })),
        ("Matter", layout!(Matter { albedo, specular, shininess, glow, roughness, metallic, reflection })),
        ("Lit", layout!(Lit { matter, normal, toward_eye, toward_light })),
        ("Blocks", layout!(Blocks { first, count })),
        ("ComposeParams", layout!(ComposeParams { blocks, size, tiles_per_row, layers })),
        ("ComposeLayer", layout!(ComposeLayer { amplitude, blend })),
        ("NormalsParams", layout!(NormalsParams { blocks, slope_per_height, size })),
        ("NormalMipsParams", layout!(NormalMipsParams { blocks, source_size, size, last_weight })),
        ("BoundsParams", layout!(BoundsParams { blocks, source_size, source_origin, size, origin, wrap })),
        ("PyramidParams", layout!(PyramidParams { blocks, source_size, size, wrap })),
        ("NoiseParams", layout!(NoiseParams { size, texel_metres, count, salt, wrap, field_metres })),
        ("NoiseLattice", layout!(NoiseLattice { scale, fraction, cell, period, slices, slice_fraction, weight, salt })),
        ("NoiseFractal", layout!(NoiseFractal { contrast, fold })),
        (
            "NoiseColumns",
            layout!(NoiseColumns { pitch, origin, period, turns, phase, disorder, low, high, ground, half_gap, edge, hexagons }),
        ),
        ("NoiseScales", layout!(NoiseScales { pitch, origin, period, turns, phase, disorder, radius, edge, lift, keel })),
        ("NoiseGears", layout!(NoiseGears { half_module, edge, top })),
        ("NoiseGear", layout!(NoiseGear { centre, rotation, teeth, spokes })),
        ("NoiseDunes", layout!(NoiseDunes { turns, phase, crest, meander, variety, ripple_turns, ripple_phase, ripple_height })),
        ("PresentParams", layout!(PresentParams { supersampling, divider, left, right })),
        ("PresentSide", layout!(PresentSide { tone_map, legend })),
        ("Ray", layout!(Ray { lattice, travel, height, rise, cell, t_end, ends })),
        ("Hit", layout!(Hit { lattice, height, t, steps, status })),
        ("Channel", layout!(Channel { position, steps, normal, height, uv, visibility, lod })),
        ("StampParams", layout!(StampParams { size, tile_count, first_tile })),
        ("StampRecord", layout!(StampRecord { height, level, alpha, profile, blend })),
        (
            "StampExtra",
            layout!(StampExtra {
                phase,
                span,
                joins,
                axis,
                half_extent,
                image_origin,
                image_size,
                irregularity,
                soot,
                bare,
                gloss,
                heat,
                moment,
                along,
                tread,
                lugs_per_texel,
            }),
        ),
        ("StampTile", layout!(Tile { tile, first, count })),
        ("StampMember", layout!(Member { centre, radius, disc })),
        (
            "GasParams",
            layout!(GasParams {
                size,
                tiles,
                periodic,
                coarse,
                courant,
                viscosity,
                confinement,
                buoyancy,
                speed_limit,
                confinement_floor,
                stillness,
                turning_per_speed,
            }),
        ),
        ("GasRow", layout!(GasRow { wind, density, dye, wind_pull, calm_pull, gas_pull, turn_cosine, turn_sine })),
        ("GasLevel", layout!(GasLevel { size, periodic, coarse, exchange, courant, tiles_across })),
        ("GasPuff", layout!(GasPuff { velocity, spin, radius, density, dye })),
        ("GasBatch", layout!(GasBatch { first, count })),
        ("GasMember", layout!(Member { centre, radius, disc })),
        ("GasEmitTile", layout!(Tile { tile, first, count })),
        (
            "ShallowWaterParams",
            layout!(ShallowWaterParams {
                size,
                texel_metres,
                depth_metres,
                borders,
                gravity,
                friction,
                dry_metres,
                speed_cap,
                courant,
                rain,
                seepage,
                sea_metres,
                foam_gain,
                foam_loss,
            }),
        ),
        (
            "ShallowWaterControl",
            layout!(ShallowWaterControl { speed, fault, remaining, dt, behind, rise, substeps, current, pending, halted }),
        ),
        ("ShallowWaterSpell", layout!(ShallowWaterSpell { seconds, swell_metres, swell_phase, swell_rate })),
        ("ShallowWaterBatch", layout!(ShallowWaterBatch { first, count })),
        ("ShallowWaterBody", layout!(ShallowWaterBody { low, high, level })),
        ("ShallowWaterEvent", layout!(Event { centre, radius, kind, metres, foam })),
        ("HealParams", layout!(HealParams { size, first_tile, tile_count, kept, closes, soot, gloss })),
        ("CoolParams", layout!(CoolParams { size, moment })),
        ("WaveParams", layout!(WaveParams { size, velocity_kept, pull, courant_squared, damping, sponge_damping, sponge_width })),
        ("WaveImpulse", layout!(WaveImpulse { strength, ring })),
        ("WaveTile", layout!(Tile { tile, first, count })),
        ("WaveMember", layout!(Member { centre, radius, disc })),
        ("WaveBatch", layout!(WaveBatch { first, count })),
    ]
}

#[test]
fn every_struct_is_laid_out_as_its_rust_twin() {
    let modules: Vec<_> = compositions().iter().map(|parts| module(parts)).collect();
    for (name, rust) in twins() {
        let mut seen = 0;
        for wgsl in modules.iter().filter_map(|module| wgsl_layout(module, name)) {
            assert_eq!(wgsl, rust, "{name}: WGSL on the left, Rust on the right");
            seen += 1;
        }
        assert!(seen > 0, "no shader has a struct {name}");
    }
}

/// A uniform or storage struct that has no Rust twin in [`twins`] would be compared with nothing.
#[test]
fn every_struct_that_crosses_the_border_has_a_twin() {
    let twins = twins();
    for parts in compositions() {
        let module = module(&parts);
        for (_, variable) in module.global_variables.iter() {
            if !matches!(variable.space, naga::AddressSpace::Uniform | naga::AddressSpace::Storage { .. }) {
                continue;
            }
            let element = match module.types[variable.ty].inner {
                naga::TypeInner::Array { base, .. } => base,
                _ => variable.ty,
            };
            let crossing = &module.types[element];
            if let (naga::TypeInner::Struct { .. }, Some(name)) = (&crossing.inner, &crossing.name) {
                assert!(twins.iter().any(|(twin, _)| twin == name), "{parts:?}: {name} has no twin in the list");
            }
        }
    }
}

/// What a uniform buffer costs on lavapipe: see `gpu::uniform`.
#[test]
fn no_shader_has_a_uniform_buffer() {
    for parts in compositions() {
        let module = module(&parts);
        let uniform = module.global_variables.iter().find(|(_, variable)| variable.space == naga::AddressSpace::Uniform);
        assert!(uniform.is_none(), "{parts:?}: {uniform:?}");
    }
}

/// The numbers by which Rust names the choices of a stamp are those that its shader compares with.
#[test]
fn the_choices_of_a_stamp_have_the_same_numbers_on_both_sides() {
    let module = module(&Stamps::PARTS.map(str::to_owned));
    let profiles = Profile::ALL.map(|profile| (format!("STAMP_{profile:?}").to_uppercase(), profile as u32));
    let blends = Blend::ALL.map(|blend| (format!("STAMP_{blend:?}").to_uppercase(), blend as u32));
    for (name, number) in profiles.into_iter().chain(blends) {
        assert_eq!(constant(&module, &name), Some(number), "{name}");
    }
}

#[test]
fn the_folds_of_noise_have_the_same_numbers_on_both_sides() {
    let module = module(&["field/noise", "field/noise_fractal"].map(str::to_owned));
    for fold in Fold::ALL {
        assert_eq!(constant(&module, &format!("NOISE_{fold:?}").to_uppercase()), Some(*fold as u32), "{fold:?}");
    }
}

#[test]
fn the_blends_of_layers_have_the_same_numbers_on_both_sides() {
    let module = module(&["common/region".to_owned(), "field/compose".to_owned()]);
    for blend in LayerBlend::ALL {
        let name = format!("COMPOSE_{blend:?}").to_uppercase();
        assert_eq!(constant(&module, &name), Some(blend as u32), "{name}");
    }
}

#[test]
fn what_became_of_a_ray_and_what_is_shown_have_the_same_numbers_on_both_sides() {
    let module = module(&surface::parts(true, Choice::PLAIN, &["surface"]));
    let shown = Shows::ALL.iter().map(|shows| (format!("SHOW_{shows:?}").to_uppercase(), *shows as u32));
    let became =
        [("HIT", Hit::HIT), ("MISS", Hit::MISS), ("CAPPED", Hit::CAPPED)].map(|(name, number)| (name.to_owned(), number));
    let tops = [("VIEWS_STEPS", Shows::STEPS_TOP), ("VIEWS_LEVELS", Shows::LEVELS_TOP)].map(|(name, top)| (name.to_owned(), top));
    let chosen = [("MARCH_BY_TEXELS".to_owned(), PomCounts::Texels as u32)];
    for (name, number) in shown.chain(became).chain(tops).chain(chosen) {
        assert_eq!(constant(&module, &name), Some(number), "{name}");
    }
}

#[test]
fn the_leaf_of_a_pyramid_has_the_same_number_on_both_sides() {
    let module = module(&surface::parts(true, Choice { technique: Technique::Pyramid, ..Choice::PLAIN }, &["surface"]));
    assert_eq!(constant(&module, "TRACE_PYRAMID_REFINED"), Some(PyramidLeaf::Refined as u32));
}

/// A module's constant of this name, where it is a literal.
fn constant(module: &naga::Module, name: &str) -> Option<u32> {
    let (_, constant) = module.constants.iter().find(|(_, constant)| constant.name.as_deref() == Some(name))?;
    match module.global_expressions[constant.init] {
        naga::Expression::Literal(naga::Literal::U32(value)) => Some(value),
        _ => None,
    }
}
