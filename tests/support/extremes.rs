//! The ends of what a scene may say: of every range that validation has, and of every slider of the panel.

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use rilievo::modes::live::panel::Panel;
use rilievo::modes::live::readings::Readings;
use rilievo::scene::Scene;
use rilievo::stroke::{Random, Stream};
use serde_json::Value;

/// A scene at an end of something, and what it is the end of.
pub struct Extreme {
    pub name: String,
    pub scene: Scene,
}

/// The places in a scene's JSON of the numbers in these tables.
pub fn numbers(scene: &Scene, tables: &[&str]) -> Vec<String> {
    fn walk(value: &Value, path: &str, found: &mut Vec<String>) {
        match value {
            Value::Object(map) => map.iter().for_each(|(key, value)| walk(value, &format!("{path}/{key}"), found)),
            Value::Array(list) => list.iter().enumerate().for_each(|(i, value)| walk(value, &format!("{path}/{i}"), found)),
            Value::Number(_) => found.push(path.to_owned()),
            _ => {}
        }
    }
    let whole = serde_json::to_value(scene).expect("a scene is plain data");
    let mut found = Vec::new();
    for table in tables {
        walk(whole.pointer(table).expect("the scene has this table"), table, &mut found);
    }
    found
}

/// The scene with another number there, if it is valid.
fn with(whole: &Value, path: &str, number: Value) -> Option<Scene> {
    let mut whole = whole.clone();
    *whole.pointer_mut(path)? = number;
    let scene: Scene = serde_json::from_value(whole).ok()?;
    scene.validate().is_ok().then_some(scene)
}

/// The farthest number from the present one, down or up, that validation admits: whatever it admits is taken to be one interval.
fn end(whole: &Value, path: &str, up: bool) -> Scene {
    let now = whole.pointer(path).expect("the scene has this number");
    // f32 in their order, and whole numbers as they are.
    let (float, from) = match now.as_u64() {
        Some(integer) => (false, integer),
        None => (true, u64::from(rank(now.as_f64().expect("it is a number") as f32))),
    };
    let number = |key: u64| if float { Value::from(f64::from(unrank(key as u32))) } else { Value::from(key) };
    let admitted = |key: u64| with(whole, path, number(key));
    let farthest = match (float, up) {
        (true, _) => u64::from(rank(if up { f32::MAX } else { f32::MIN })),
        (false, true) => u64::from(u32::MAX),
        (false, false) => 0,
    };
    let mut good = from;
    let mut bad = farthest;
    if let Some(scene) = admitted(farthest) {
        return scene;
    }
    while good.abs_diff(bad) > 1 {
        let middle = good.midpoint(bad);
        *(if admitted(middle).is_some() { &mut good } else { &mut bad }) = middle;
    }
    admitted(good).expect("it was admitted before")
}

/// The place of a float among all of them.
fn rank(value: f32) -> u32 {
    let bits = value.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 0x8000_0000 }
}

fn unrank(rank: u32) -> f32 {
    f32::from_bits(if rank >> 31 == 1 { rank & 0x7fff_ffff } else { !rank })
}

/// The scene with the number there at its lowest, then at its highest, all else as it is.
pub fn ends(scene: &Scene, path: &str) -> [Extreme; 2] {
    let whole = serde_json::to_value(scene).expect("a scene is plain data");
    [false, true].map(|up| {
        let scene = end(&whole, path, up);
        let reached = serde_json::to_value(&scene).expect("a scene is plain data");
        let name = format!("{path} {}", reached.pointer(path).expect("it was just set"));
        Extreme { name, scene }
    })
}

/// The scene with each number in these tables at its lowest or its highest, or left alone, by the seed; ranges that depend on another
/// number are those that it leaves.
pub fn corner(scene: &Scene, paths: &[String], seed: u64) -> Extreme {
    let mut random = Random::new(seed, Stream::Stress, 0);
    let mut paths = paths.to_vec();
    // Whichever comes first has the widest range.
    for last in (1..paths.len()).rev() {
        paths.swap(last, (random.unit() * (last + 1) as f64) as usize);
    }
    let (mut scene, mut name) = (scene.clone(), format!("corner {seed}:"));
    for path in &paths {
        let draw = random.unit();
        if draw < 0.2 {
            continue;
        }
        let whole = serde_json::to_value(&scene).expect("a scene is plain data");
        scene = end(&whole, path, draw < 0.6);
        let reached = serde_json::to_value(&scene).expect("a scene is plain data");
        name += &format!(" {} {}", path.trim_start_matches('/'), reached.pointer(path).expect("it was just set"));
    }
    Extreme { name, scene }
}

/// The scene as the panel leaves it with each of its sliders at either end; of those that change what `counts` looks at.
pub fn slider_ends<T: PartialEq>(scene: &Scene, counts: impl Fn(&Scene) -> T) -> Vec<Extreme> {
    let mut harness = Harness::builder().with_size([900.0, 2700.0]).build_ui_state(
        |ui, panel: &mut Panel| drop(panel.show(ui, &Readings::default())),
        Panel::new(scene.clone(), Vec::new()),
    );
    harness.run();
    let nodes = harness.root().children_recursive().map(|node| node.accesskit_node());
    let sliders: Vec<_> = nodes
        .filter(|node| node.role() == Role::Slider)
        .filter_map(|node| Some((node.label()?, [node.min_numeric_value()?, node.max_numeric_value()?])))
        .collect();
    let mut extremes = Vec::new();
    for (name, both) in sliders {
        for end in both {
            harness.get_by_role_and_label(Role::Slider, &name).set_value_accesskit(end);
            harness.run();
            let moved = std::mem::replace(&mut harness.state_mut().scene, scene.clone());
            if counts(&moved) != counts(scene) {
                extremes.push(Extreme { name: format!("{name} at {end}"), scene: moved });
            }
            harness.run();
        }
    }
    extremes
}
