//! The panel, driven as a user and a screen reader would, without a GPU: every control has a name, a unit where it has one, a
//! reset, and does what it says. The harness itself fails on a control without a name.

use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

use egui::accesskit::Role;
use rilievo::modes::live::hand::BrushKind;
use rilievo::modes::live::input::Action;
use rilievo::modes::live::panel::{Panel, set_style};
use rilievo::modes::live::readings::Readings;
use rilievo::scene::DirectionalLight;
use rilievo::scene::{Boundary, Rain, Relief, Scene, Shots, Wave};
use rilievo::surface::{Albedo, Display, Shading, Shadow, Shows, Split, Technique};

struct State {
    panel: Panel,
    actions: Vec<Action>,
    readings: Readings,
}

type Panels = Harness<'static, State>;

fn harness(scene: Scene) -> Panels {
    let scenes = ["ripples", "bullet-wall", "relief"].map(|name| (name.to_owned(), format!("What {name} shows.")));
    let state = State { panel: Panel::new(scene, scenes.to_vec()), actions: Vec::new(), readings: Readings::default() };
    // High enough to show all without scrolling: what is out of sight cannot be clicked.
    let mut harness = Harness::builder().with_size([900.0, 2700.0]).build_ui_state(
        |ui, state: &mut State| {
            let actions = state.panel.show(ui, &state.readings);
            state.actions.extend(actions);
        },
        state,
    );
    set_style(&harness.ctx);
    harness.run();
    for name in ["Material", "Camera", "Reliefs beside it"] {
        if let Some(heading) = harness.query_by_label(name) {
            heading.click();
            harness.run();
        }
    }
    harness
}

/// A scene in which every control is there.
fn everything() -> Scene {
    let mut scene = Scene {
        name: "ripples".to_owned(),
        wave: Some(Wave { boundary: Boundary::Absorbing, rain: Some(Rain::default()), ..Wave::default() }),
        shots: Some(Shots::default()),
        reliefs: vec![Relief { name: "wall".to_owned(), ..Relief::default() }; 2],
        ..Scene::default()
    };
    scene.trace.technique = Technique::Pom;
    scene.trace.shadow = Shadow::PomSoft;
    scene
}

fn names(harness: &Panels, role: Role) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    nodes.map(|node| node.accesskit_node()).filter(|node| node.role() == role).filter_map(|node| node.label()).collect()
}

#[test]
fn every_slider_moves_its_value_and_its_reset_brings_it_back() {
    for technique in [Technique::Pom, Technique::Exact, Technique::Relief, Technique::Steep] {
        let mut scene = everything();
        scene.trace.technique = technique;
        if technique == Technique::Exact {
            scene.material.model = Shading::Ggx;
            scene.material.albedo = Albedo::Glass;
        }
        let mut harness = harness(scene);
        let split = Split { technique, shadow: Shadow::Hard, shows: Shows::Picture, fraction: Split::MIDDLE };
        harness.state_mut().panel.display = Display { shows: Shows::Error, split: Some(split), ..Display::default() };
        harness.run();
        let sliders = names(&harness, Role::Slider);
        assert!(sliders.len() > 24, "{sliders:?}");
        for name in sliders {
            let before = harness.state().panel.clone();
            let slider = harness.get_by_role_and_label(Role::Slider, &name);
            let node = slider.accesskit_node();
            let (least, most) = (node.min_numeric_value(), node.max_numeric_value());
            let (Some(least), Some(most), Some(value)) = (least, most, node.numeric_value()) else {
                panic!("{name} has no range or no value");
            };
            let ends = if value > 0.5 * (least + most) { [most, least] } else { [least, most] };
            for end in ends {
                harness.get_by_role_and_label(Role::Slider, &name).set_value_accesskit(end);
                harness.run();
                let valid = harness.state().panel.scene.validate();
                assert!(valid.is_ok(), "{name} at {end}: {valid:?}");
            }
            assert_ne!(harness.state().panel, before, "{name} changes nothing");
            harness.get_by_role_and_label(Role::Button, &format!("Reset {name}")).click();
            harness.run();
            // Two bounds of one range push each other: the other one is reset by its own button.
            for other in ["Samples, grazing", "Largest crater"] {
                let label = format!("Reset {other}");
                let reset = harness.query_by_role_and_label(Role::Button, &label);
                if let Some(reset) = reset.filter(|reset| !reset.accesskit_node().is_disabled()) {
                    reset.click();
                    harness.run();
                }
            }
            assert_eq!(harness.state().panel, before, "{name} is not reset");
        }
    }
}

#[test]
fn numbers_carry_their_units() {
    let harness = harness(everything());
    let units = [
        ("Depth", "mm"),
        ("Relief depth", "mm"),
        ("Pitch", "°"),
        ("Azimuth", "°"),
        ("Elevation", "°"),
        ("Turn", "°/s"),
        ("Wave speed", "m/s"),
        ("Damping", "/s"),
        ("Sponge", "texels"),
        ("Drops", "/s"),
        ("Drop radius", "mm"),
        ("Shots", "/s"),
        ("Smallest crater", "mm"),
        ("Largest crater", "mm"),
        ("Crater depth", "mm"),
        ("Radius", "mm"),
        ("Rate", "/s"),
        ("Field of view", "°"),
        ("Supersampling", "×"),
        ("Intensity", "×"),
    ];
    for (name, unit) in units {
        let number = harness.get_by_role_and_label(Role::SpinButton, name);
        let shown = number.value().unwrap_or_default();
        assert!(shown.ends_with(unit), "{name} shows '{shown}' without '{unit}'");
    }
}

#[test]
fn choices_are_made_and_reset() {
    let mut harness = harness(everything());
    harness.get_by_role_and_label(Role::ComboBox, "Technique").click();
    harness.run();
    harness.get_by_label(Technique::Exact.label()).click();
    harness.run();
    assert_eq!(harness.state().panel.scene.trace.technique, Technique::Exact);
    assert!(harness.query_by_role_and_label(Role::Slider, "Step cap").is_some(), "a technique brings its own controls");
    assert!(harness.query_by_role_and_label(Role::Slider, "Samples, grazing").is_none());
    harness.get_by_label("Reset Technique").click();
    harness.run();
    assert_eq!(harness.state().panel.scene.trace.technique, Technique::Pom);

    harness.get_by_role_and_label(Role::ComboBox, "Border").click();
    harness.run();
    harness.get_by_label("A wall").click();
    harness.run();
    assert_eq!(harness.state().panel.scene.wave.as_ref().map(|wave| wave.boundary), Some(Boundary::Reflecting));

    harness.get_by_role_and_label(Role::ComboBox, "Kind").click();
    harness.run();
    harness.get_by_label("Shot").click();
    harness.run();
    assert_eq!(harness.state().panel.brush.kind, BrushKind::Shot);
}

#[test]
fn every_choice_and_colour_has_a_name_and_a_reset() {
    for &technique in Technique::ALL {
        let mut scene = everything();
        scene.trace.technique = technique;
        let harness = harness(scene);
        let mut controls = names(&harness, Role::ComboBox);
        controls.retain(|name| name != "Scene");
        controls.extend(names(&harness, Role::ColorWell));
        assert!(controls.len() >= 9, "{controls:?}");
        for name in controls {
            harness.get_by_role_and_label(Role::Button, &format!("Reset {name}"));
        }
    }
}

#[test]
fn a_group_is_reset_at_once() {
    let mut harness = harness(everything());
    let original = harness.state().panel.clone();
    let scene = &mut harness.state_mut().panel.scene;
    scene.light.azimuth_degrees = 10.0;
    scene.light.sky = [0.0; 3];
    scene.trace.technique = Technique::Normal;
    scene.plane.depth_metres = 0.3;
    scene.material.shininess = 3.0;
    scene.wave = Some(Wave::default());
    scene.shots = Some(Shots { scorch: 0.1, ..Shots::default() });
    harness.state_mut().panel.scene.lights.push(DirectionalLight::default());
    harness.state_mut().panel.display.shows = Shows::Steps;
    harness.state_mut().panel.brush.grow(5.0);
    harness.run();
    for name in ["View", "Surface", "Light", "Material", "Simulation", "Brush"] {
        harness.get_by_label(&format!("Reset all of {name}")).click();
        harness.run();
    }
    assert_eq!(harness.state().panel, original);
}

#[test]
fn lights_are_added_chosen_moved_and_removed() {
    let mut harness = harness(everything());
    let click = |harness: &mut Panels, label: &str| {
        harness.get_by_label(label).click();
        harness.run();
    };
    let lights = |harness: &Panels| harness.state().panel.scene.lights.clone();
    assert!(harness.query_by_role_and_label(Role::ComboBox, "Which").is_none(), "one light leaves no choice");
    click(&mut harness, "Add a light");
    click(&mut harness, "Add a light");
    assert_eq!(lights(&harness), vec![DirectionalLight::default(); 2]);
    // The one that was added is the one that the rows move.
    let own = harness.state().panel.scene.light.clone();
    harness.get_by_role_and_label(Role::Slider, "Azimuth").set_value_accesskit(123.0);
    harness.run();
    click(&mut harness, "Casts shadows");
    let moved = DirectionalLight { azimuth_degrees: 123.0, casts_shadow: false, ..DirectionalLight::default() };
    assert_eq!(lights(&harness), [DirectionalLight::default(), moved.clone()]);
    assert_eq!(harness.state().panel.scene.light, own);
    harness.get_by_role_and_label(Role::ComboBox, "Which").click();
    harness.run();
    click(&mut harness, "Second");
    click(&mut harness, "Remove this one");
    assert_eq!(lights(&harness), [moved]);
    assert!(harness.query_by_label("Remove this one").is_none(), "the scene's own light stays");
    click(&mut harness, "Add a light");
    click(&mut harness, "Add a light");
    let add = harness.get_by_label("Add a light");
    assert!(add.accesskit_node().is_disabled(), "four are the most");
    assert!(harness.state().panel.scene.validate().is_ok());
}

#[test]
fn the_screen_is_split_and_its_divider_dragged() {
    let mut harness = harness(everything());
    assert_eq!(harness.state().panel.display.split, None);
    harness.get_by_role_and_label(Role::CheckBox, "Split screen").click();
    harness.run();
    let split = harness.state().panel.display.split.expect("it was split");
    assert_ne!(split.technique, harness.state().panel.scene.trace.technique, "both sides alike would show nothing");
    harness.get_by_role_and_label(Role::ComboBox, "Its shadow").click();
    harness.run();
    harness.get_by_label("Hard (exact)").click();
    harness.run();
    assert_eq!(harness.state().panel.display.split.map(|split| split.shadow), Some(Shadow::Hard));
    // The harness is 900 points wide: 90 of them are a tenth.
    let from = harness.get_by_label("Drag the divider").rect().center();
    assert!((from.x - 450.0).abs() < 1.0);
    let to = from + egui::vec2(90.0, 5.0);
    harness.drag_at(from);
    harness.run();
    harness.hover_at(to);
    harness.run();
    harness.drop_at(to);
    harness.run();
    let fraction = harness.state().panel.display.split.map_or(0.0, |split| split.fraction);
    assert!((fraction - 0.6).abs() < 1e-3, "{fraction}");
    // Each side says what it is.
    harness.get_by_label_contains("Shadow: Hard (exact)");
    harness.get_by_role_and_label(Role::CheckBox, "Split screen").click();
    harness.run();
    assert_eq!(harness.state().panel.display.split, None);
}

#[test]
fn a_view_says_what_its_colours_mean() {
    let mut harness = harness(everything());
    harness.state_mut().panel.show_view(Shows::Error);
    harness.state_mut().panel.display.gain = 4.0;
    harness.run();
    harness.get_by_label("Black is 0, the brightest 0.25 texels");
    harness.state_mut().panel.show_view(Shows::Steps);
    harness.run();
    harness.get_by_label("Black is 0, the brightest 64 height samples or nodes");
}

#[test]
fn buttons_ask_for_what_they_say() {
    let mut harness = harness(everything());
    let buttons = [
        ("⏸ Pause", Action::TogglePause),
        ("⏭ Step", Action::Step),
        ("⟲ Reset", Action::Reset),
        ("❓ Keys", Action::ToggleKeys),
        ("New seed", Action::NewSeed),
        ("Fly", Action::ToggleFly),
        ("Reset camera", Action::ResetCamera),
    ];
    for (label, action) in buttons {
        harness.get_by_label(label).click();
        harness.run();
        assert_eq!(std::mem::take(&mut harness.state_mut().actions), [action], "{label}");
    }
    harness.get_by_role_and_label(Role::ComboBox, "Scene").click();
    harness.run();
    harness.get_by_label("bullet-wall").click();
    harness.run();
    assert_eq!(harness.state().actions, [Action::Scene(1)]);
}

#[test]
fn rain_starts_and_stops() {
    let mut harness = harness(everything());
    let rains = |harness: &Panels| harness.state().panel.scene.wave.as_ref().is_some_and(|wave| wave.rain.is_some());
    for expected in [false, true] {
        harness.get_by_role_and_label(Role::CheckBox, "Rain").click();
        harness.run();
        assert_eq!(rains(&harness), expected);
    }
}

#[test]
fn a_still_scene_says_so_and_offers_no_drops() {
    let mut harness = harness(Scene::default());
    harness.get_by_label("Nothing moves by itself in this scene.");
    harness.get_by_role_and_label(Role::ComboBox, "Kind").click();
    harness.run();
    assert!(harness.query_by_label("Drop on water").is_none());
}

#[test]
fn untouched_it_changes_nothing() {
    let mut scene = everything();
    // Values that neither the sliders' ranges nor their decimals hold.
    scene.light.azimuth_degrees = -33.333;
    scene.plane.depth_metres = 0.123_456_7;
    scene.trace.step_cap = 100_000;
    let before = Panel::new(scene.clone(), Vec::new());
    let mut harness = harness(scene);
    harness.run_steps(5);
    assert_eq!(harness.state().panel.scene, before.scene);
    assert_eq!(harness.state().panel.brush, before.brush);
}

#[test]
fn hides_and_explains_itself() {
    let mut harness = harness(everything());
    harness.state_mut().panel.shown = false;
    harness.state_mut().panel.keys_shown = true;
    harness.run();
    assert!(harness.query_by_role(Role::Slider).is_none());
    for text in ["Shift+R", "F11", "Left mouse", "Ctrl+wheel"] {
        harness.get_by_label(text);
    }
}
