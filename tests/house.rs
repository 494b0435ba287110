//! The house's rules, without a GPU: the stem rule, the contract table, the list of embedded shaders.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use rilievo::field;
use rilievo::gpu::shader::EMBEDDED;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Names of all WGSL parts on disk: paths under `shaders/` without the ending.
fn parts_on_disk() -> BTreeSet<String> {
    let mut parts = BTreeSet::new();
    let mut folders = vec![root().join("shaders")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("the folder of shaders is part of the repository") {
            let path = entry.expect("its entries can be listed").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let below = path.strip_prefix(root().join("shaders")).expect("the walk began there").with_extension("");
                parts.insert(below.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    parts
}

#[test]
fn the_binary_embeds_every_shader() {
    let embedded: BTreeSet<_> = EMBEDDED.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(embedded, parts_on_disk());
}

/// Stems that the rule does not bind wholly: the shader, which of its companions it lacks, and why.
const EXEMPT: &[(&str, &[&str], &str)] = &[
    (
        "field/gas_project_smooth",
        &["src", "reference", "tests"],
        "a part of the projection's pass: its specification and its proof are that one's, reference/gas_project.rs",
    ),
    (
        "field/shallow_water_disturb",
        &["src", "reference", "tests"],
        "a part of the water's pass: tests/field/shallow_water.rs weighs what it adds and takes",
    ),
    (
        "field/shallow_water_flux",
        &["src", "reference", "tests"],
        "a part of the water's pass: its specification and its proof are the step's, reference/shallow_water.rs",
    ),
    (
        "field/shallow_water_plan",
        &["src", "reference", "tests"],
        "a part of the water's pass: its rule is reference/shallow_water.rs's `advance`",
    ),
    (
        "field/shallow_water_publish",
        &["src", "reference", "tests"],
        "a part of the water's pass: a sum, which tests/field/shallow_water.rs reads",
    ),
    (
        "surface/albedo_brick",
        &["src", "reference", "tests"],
        "a colour: the goldens hold it; its layout is field/base/masonry.rs's",
    ),
    (
        "surface/albedo_cobble",
        &["src", "reference", "tests"],
        "a colour: the goldens hold it; its layout is field/base/masonry.rs's",
    ),
    (
        "surface/albedo_facade",
        &["src", "reference", "tests"],
        "a colour: the goldens hold it; its layout is field/base/facade.rs's",
    ),
    ("surface/albedo_snow", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/albedo_fur", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/albedo_gas", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    (
        "surface/albedo_grass",
        &["src", "reference", "tests"],
        "a colour: the goldens hold it; its layout is field/base/strands.rs's",
    ),
    ("surface/albedo_bronze", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/albedo_image", &["reference"], "a picture read where it lies: its test holds it to the picture itself"),
    ("surface/albedo_plain", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/albedo_planet", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/albedo_sand", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/albedo_terrain", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/albedo_water", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/ball", &["src", "reference", "tests"], "draws what surface/balls proves"),
    ("surface/balls", &["src"], "a ball is data of the view: src/surface/view.rs"),
    ("surface/channel", &["src", "reference", "tests"], "a struct and its parts: its twin is the channels'"),
    ("surface/facet", &["reference"], "a box is held against the plane's reference"),
    ("surface/plane", &["src", "reference", "tests"], "calls what others prove; the balls' tests see it"),
    ("surface/raster", &["reference", "tests"], "what the drawn geometries share; their tests see it"),
    (
        "surface/frame",
        &["src", "reference", "tests"],
        "an affine map and its inverse: the captures' proof reads positions through it",
    ),
    ("surface/albedo_glass", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/level_cap", &["src", "reference", "tests"], "the trace of a view: the captures' proof of views reads it"),
    ("surface/light_probe", &["reference", "tests"], "calls what others prove; their proofs run through it"),
    ("surface/matter", &["src", "reference", "tests"], "what albedos share"),
    ("surface/ray", &["src", "reference", "tests"], "two structs: their twins are the probe's"),
    ("surface/shallows", &["src", "reference", "tests"], "a colour: the goldens hold it"),
    ("surface/shade", &["src", "reference", "tests"], "a sum of what others prove: the goldens hold it"),
    ("surface/transparent", &["src", "reference", "tests"], "what albedos share: the goldens hold it"),
    ("surface/truth_exact", &["src", "reference", "tests"], "calls what others prove; the captures' proof of views reads it"),
    ("surface/truth_none", &["src", "reference", "tests"], "nothing"),
    ("surface/views", &["src", "reference", "tests"], "numbers as colours: the captures' proof of views reads them"),
    ("surface/micropolygon", &["reference"], "over a plane its specification is reference/trace_mesh.rs"),
    ("surface/surface", &["reference", "tests"], "calls what others prove; the goldens hold it"),
    ("surface/channels", &["reference", "tests"], "calls what others prove; the captures' proof reads it"),
    ("surface/probe", &["reference", "tests"], "calls what others prove; their proofs run through it"),
];

/// Techniques, shadows and patterns are one WGSL file each and share the passes that run them: they have no Rust of their own.
fn needs_rust(part: &str) -> bool {
    ![
        "field/noise_",
        "surface/trace_",
        "surface/shadow_",
        "surface/traversal",
        "surface/march",
        "surface/light_disc",
        "surface/light_ggx",
        "surface/light_phong",
        "surface/sky",
    ]
    .iter()
    .any(|prefix| part.starts_with(prefix))
}

#[test]
fn one_stem_names_shader_rust_reference_and_test() {
    for part in parts_on_disk().iter().filter(|part| part.starts_with("field/") || part.starts_with("surface/")) {
        let (folder, stem) = part.split_once('/').expect("the filter asks for a folder");
        let companions: [(&str, PathBuf); 3] = [
            ("src", root().join(format!("src/{folder}/{stem}.rs"))),
            ("reference", root().join(format!("src/reference/{stem}.rs"))),
            ("tests", root().join(format!("tests/{folder}/{stem}.rs"))),
        ];
        let lacking = EXEMPT.iter().find(|(exempt, _, _)| exempt == part).map_or(&[][..], |(_, lacking, _)| lacking);
        for (companion, path) in companions {
            let expected = !lacking.contains(&companion) && (companion != "src" || needs_rust(part));
            assert_eq!(path.exists(), expected, "{}: see the stem rule in tests/house.rs", path.display());
        }
    }
}

#[test]
fn every_exemption_is_still_needed() {
    let parts = parts_on_disk();
    for (part, _, reason) in EXEMPT {
        assert!(parts.contains(*part), "{part} is exempt ({reason}) but is gone");
    }
}

#[test]
fn the_field_takes_at_most_forty_bytes_a_texel() {
    let sum = field::bytes_per_texel(field::CONTRACT.iter().chain(field::wave::CONTRACT));
    assert!(sum <= 40.0, "{sum} bytes a texel");
}

/// The table in the module's documentation says what the code says.
#[test]
fn the_contract_table_is_true() {
    let source = fs::read_to_string(root().join("src/field/mod.rs")).expect("the module is part of the repository");
    let of_sources = field::SOURCE_CONTRACTS.iter().flat_map(|(_, contract)| contract.iter());
    for (contract, count) in field::CONTRACT.iter().chain(of_sources) {
        let row = source
            .lines()
            .find(|line| line.split('|').nth(1).is_some_and(|name| name.trim().split(" (").next() == Some(contract.name)))
            .unwrap_or_else(|| panic!("the table lacks {}", contract.name));
        let columns: Vec<_> = row.trim_start_matches("//! |").split('|').map(str::trim).collect();
        let format = format!("{:?}", contract.format).to_lowercase();
        let bytes = contract.bytes_per_texel() * f64::from(*count);
        assert!(columns[1].starts_with(&format), "{row}: the format is {format}");
        assert_eq!(columns[2], in_sixths(bytes), "{row}: bytes a texel");
        assert_eq!(columns[4], contract.writer, "{row}: writer");
        assert_eq!(columns[5], contract.readers, "{row}: readers");
    }
    let sum = field::bytes_per_texel(field::CONTRACT);
    assert!(source.contains(&format!("*{} in every field*", in_sixths(sum))), "the sum is {sum}");
    for (name, contract) in field::SOURCE_CONTRACTS {
        let sum = in_sixths(field::bytes_per_texel(*contract));
        assert!(source.contains(&format!("*{sum} more with {name}*")), "{name} adds {sum}");
    }
}

/// A number of bytes as the table writes it: mips add a third, levels side by side a half.
fn in_sixths(bytes: f64) -> String {
    let sixths = (6.0 * bytes).round() as u32;
    format!("{}{}", sixths / 6, ["", "⅙", "⅓", "½", "⅔", "⅚"][sixths as usize % 6])
}
