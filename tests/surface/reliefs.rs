//! Reliefs beside the scene's own: they intersect where brute force says so, look as the scene's own does, and cast their shadows.

use glam::{DMat3, DVec2, DVec3};
use rilievo::camera::Camera;
use rilievo::frame::Start;
use rilievo::mesh::{Mesh, MeshSource, Shape};
use rilievo::reference::traversal::Line;
use rilievo::reference::{Addressing, HeightField, reliefs};
use rilievo::scene::{self, Ball, Base, FieldSettings, Plane, Relief, Scene};
use rilievo::surface::channels::Channel;
use rilievo::surface::ray_map::Placement;
use rilievo::surface::{Shadow, Technique, view};

use crate::support::fields::{Kind, Random};
use crate::support::gpu::gpu;
use crate::support::rays;
use crate::support::seen::{scene_of, seen_from_start};
use crate::support::tolerances::{
    RELIEF_CORNER, RELIEF_CORNER_ASLANT, RELIEF_PENUMBRA, RELIEF_PENUMBRA_ASLANT, RELIEF_TIE, SAME_RELIEF_OFF_SHARE,
    TANGENT_SHARE_SEEN, hit_height, lattice_bound,
};

const SIZE: [u32; 2] = [320, 200];

/// One relief, for brute force.
struct Truth<'a> {
    placement: Placement,
    plane: Plane,
    field: &'a HeightField,
}

/// Where a pixel's ray meets a relief.
struct Meeting {
    line: Line,
    t: f64,
    /// From the eye to the surface, and to the polygon.
    distance: f64,
    polygon_distance: f64,
    /// The ray meets the polygon, not merely within rounding of it.
    is_sure: bool,
}

/// Lattice positions so near to a border of the polygon may fall on either side.
const BORDER: f64 = 2e-3;

impl Truth<'_> {
    fn lattice(&self, local: DVec3) -> [f64; 2] {
        let metres = self.plane.size_metres(self.field.size);
        let axis = |axis: usize, at: f64| (at / metres[axis] + 0.5) * f64::from(self.field.size[axis]) - 0.5;
        [axis(0, local.x), axis(1, local.z)]
    }

    fn meeting(&self, eye: DVec3, direction: DVec3) -> Option<Meeting> {
        let (from, way) = (self.placement.local(eye), self.placement.turned(direction));
        let s = -from.y / way.y;
        let start = self.lattice(from + s * way);
        let end = self.lattice(from + (s + f64::from(self.plane.depth_metres) / -way.y) * way);
        let inside = |margin: f64| {
            (0..2).all(|axis| {
                let size = f64::from(self.field.size[axis]);
                let half = 0.5 * size * f64::from(self.plane.repeat[axis]);
                (start[axis] + 0.5 - 0.5 * size).abs() <= half + margin
            })
        };
        if way.y >= 0.0 || s <= 0.0 || !inside(BORDER) {
            return None;
        }
        let line = Line { lattice: start, travel: [end[0] - start[0], end[1] - start[1]], height: 1.0, rise: -1.0 };
        let t = line.meets(self.field, 0.0, 1.0).expect("a view ray always ends");
        let distance = s + t * f64::from(self.plane.depth_metres) / -way.y;
        Some(Meeting { line, t, distance, polygon_distance: s, is_sure: inside(-BORDER) })
    }

    /// Whether a channel shows this meeting: at its place; or, `None`, nearly, as rounding allows where the ray only just touches.
    fn is_shown(&self, meeting: &Meeting, channel: &Channel) -> Option<bool> {
        let local = self.placement.local(DVec3::from(channel.position.map(f64::from)));
        let (line, depth) = (&meeting.line, f64::from(self.plane.depth_metres));
        let cells = lattice_bound(rays::reach(&[line.lattice, line.lattice_at(1.0)]));
        let found = self.lattice(local);
        let by_uv = [0, 1].map(|axis| f64::from(channel.uv[axis]) * f64::from(self.field.size[axis]) - 0.5);
        let (t, bound) = (-local.y / depth, 2.0 * cells);
        // On the ray, and the numbers of this very relief: another's uv are others.
        let on_ray = rays::distance(line.lattice_at(t), found) <= bound && rays::distance(by_uv, found) <= bound;
        if !on_ray {
            return Some(false);
        }
        if rays::distance(line.lattice_at(meeting.t), found) <= cells {
            return Some(true);
        }
        let (lowest, slope) = line.closest(self.field, 0.0, t.clamp(0.0, 1.0));
        let slack = hit_height(cells, slope);
        if lowest >= -slack && line.gap(self.field, t).abs() <= slack { None } else { Some(false) }
    }
}

/// A relief beside the scene's own, of this field.
fn beside(field: &HeightField, plane: Plane, position_metres: [f32; 3], [yaw, pitch, roll]: [f32; 3]) -> Relief {
    Relief {
        position_metres,
        yaw_degrees: yaw,
        pitch_degrees: pitch,
        roll_degrees: roll,
        field: FieldSettings { size: field.size, addressing: field.addressing },
        plane,
        ..Relief::default()
    }
}

fn start_of(scene: &Scene, own: &HeightField, further: &[HeightField]) -> Start {
    let start = |(relief, field): (&Relief, &HeightField)| {
        let alone = relief.alone(scene);
        Start::new(&alone, field.heights.clone(), mesh_of(&alone))
    };
    Start::new(scene, own.heights.clone(), mesh_of(scene)).with_reliefs(scene.reliefs.iter().zip(further).map(start).collect())
}

/// The shape that carries a scene's relief, if one does.
fn mesh_of(scene: &Scene) -> Option<Mesh> {
    let MeshSource::Shape(shape) = scene.mesh.as_ref()?.source else { return None };
    Some(shape.mesh(scene.plane_size_metres().map(|metres| metres as f32)))
}

/// Two tilted planes that cross one another, and a wall that stands in a noisy ground: scene, fields, eye.
fn crossings() -> Vec<(&'static str, Scene, Vec<HeightField>, [f64; 3])> {
    let own = Kind::Elevation.field([256, 192], Addressing::Clamp);
    let tilted = [Kind::Steps.field([128, 96], Addressing::Wrap), Kind::Waves.field([97, 130], Addressing::Clamp)];
    let mut crossed = scene_of(&own);
    let plane = |width_metres, depth_metres, repeat| Plane { width_metres, depth_metres, repeat };
    crossed.reliefs = vec![
        beside(&tilted[0], plane(0.5, 0.15, [2, 1]), [0.05, -0.02, 0.03], [30.0, 25.0, 10.0]),
        beside(&tilted[1], plane(0.6, 0.08, [1, 1]), [-0.1, 0.0, 0.0], [-70.0, 40.0, 200.0]),
    ];
    let ground = Kind::Noise.field([64, 64], Addressing::Wrap);
    let mut standing = scene_of(&ground);
    standing.plane = plane(0.4, 0.06, [5, 5]);
    let wall = Kind::Steps.field([160, 80], Addressing::Wrap);
    standing.reliefs = vec![beside(&wall, plane(0.8, 0.1, [3, 1]), [0.0, 0.1, -0.2], [12.0, 90.0, 0.0])];
    let mut all = vec![
        ("tilted planes", crossed, vec![own, tilted[0].clone(), tilted[1].clone()], [0.5, 0.9, 0.9]),
        ("a wall", standing, vec![ground, wall], [0.6, 0.5, 0.9]),
    ];
    for (_, scene, ..) in &mut all {
        scene.trace.displaced_depth = true;
    }
    all
}

/// From the pixel's own ray the nearest of all exact hits, in f64; and its texture coordinates say which relief it is.
#[test]
fn the_nearest_of_all_reliefs_is_seen() {
    let Some(gpu) = gpu() else { return };
    for (name, scene, fields, eye) in crossings() {
        let camera = Camera::look_at(eye.into(), DVec3::ZERO, 0.9, 0.01);
        let truths = truths(&scene, &fields);
        let by_polygon = {
            let mut scene = scene.clone();
            scene.trace.displaced_depth = false;
            seen_from_start(gpu, &start_of(&scene, &fields[0], &fields[1..]), &camera, SIZE).0
        };
        let by_relief = seen_from_start(gpu, &start_of(&scene, &fields[0], &fields[1..]), &camera, SIZE).0;
        let differ = by_relief.iter().zip(&by_polygon).filter(|(one, other)| one.position != other.position).count();
        assert!(differ > 200, "{name}: the switch changes {differ} pixels");
        for (channels, displaced) in [(&by_relief, true), (&by_polygon, false)] {
            let judged = rays::each(channels.len(), |index| judge(&truths, &camera, index, &channels[index], displaced));
            let mut shown = vec![0_usize; truths.len()];
            let mut tangent = 0;
            for (index, judgement) in judged.into_iter().enumerate() {
                match judgement {
                    Ok(Some((relief, is_exact))) => {
                        shown[relief] += 1;
                        tangent += usize::from(!is_exact);
                    }
                    Ok(None) => {}
                    Err(why) => panic!("{name}, displaced depth {displaced}, pixel {:?}: {why}", pixel(index)),
                }
            }
            println!("{name}, displaced depth {displaced}: {shown:?} pixels, {tangent} tangent");
            assert!(shown.iter().all(|&shown| shown > 2_000), "{name}: {shown:?}");
            let all = shown.iter().sum::<usize>() as f64;
            assert!(f64::from(tangent as u32) <= TANGENT_SHARE_SEEN * all, "{name}: {tangent} of {all}");
        }
    }
}

fn truths<'a>(scene: &Scene, fields: &'a [HeightField]) -> Vec<Truth<'a>> {
    let own = (Placement::default(), scene.plane.clone());
    let further = scene.reliefs.iter().map(|relief| (relief.placement(), relief.plane.clone()));
    let all = std::iter::once(own).chain(further).zip(fields);
    all.map(|((placement, plane), field)| Truth { placement, plane, field }).collect()
}

fn pixel(index: usize) -> DVec2 {
    DVec2::new((index as u32 % SIZE[0]) as f64 + 0.5, (index as u32 / SIZE[0]) as f64 + 0.5)
}

/// Which relief a pixel rightly shows, and whether to the last bit but rounding; or why it is wrong.
fn judge(
    truths: &[Truth<'_>],
    camera: &Camera,
    index: usize,
    channel: &Channel,
    displaced: bool,
) -> Result<Option<(usize, bool)>, String> {
    let (eye, direction) = (camera.eye(), camera.direction(pixel(index), SIZE));
    let meetings: Vec<_> = truths
        .iter()
        .enumerate()
        .filter_map(|(relief, truth)| truth.meeting(eye, direction).map(|meeting| (relief, meeting)))
        .collect();
    let depth = |meeting: &Meeting| if displaced { meeting.distance } else { meeting.polygon_distance };
    let nearest = meetings.iter().filter(|(_, meeting)| meeting.is_sure).map(|(_, meeting)| depth(meeting));
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    if channel.steps < 0.0 {
        return if nearest.is_finite() { Err("it shows nothing".to_owned()) } else { Ok(None) };
    }
    let mut touched = None;
    for (relief, meeting) in &meetings {
        if depth(meeting) > nearest + RELIEF_TIE * depth(meeting) {
            continue;
        }
        match truths[*relief].is_shown(meeting, channel) {
            Some(true) => return Ok(Some((*relief, true))),
            Some(false) => {}
            None => touched = Some((*relief, false)),
        }
    }
    // A ray that only just touches one of them may as well go on to what lies behind.
    let grazes = meetings.iter().find(|(relief, meeting)| {
        let ends = meeting.t;
        let (lowest, slope) = meeting.line.closest(truths[*relief].field, 0.0, (ends + 1e-3).min(1.0));
        let cells = lattice_bound(rays::reach(&[meeting.line.lattice, meeting.line.lattice_at(1.0)]));
        lowest >= -hit_height(cells, slope)
    });
    match (touched, grazes) {
        (Some(touched), _) => Ok(Some(touched)),
        (None, Some((relief, _))) => Ok(Some((*relief, false))),
        (None, None) => {
            let at: Vec<_> = meetings.iter().map(|(relief, meeting)| (relief, depth(meeting), meeting.t)).collect();
            Err(format!("{channel:?}, where the reliefs are at {at:?}"))
        }
    }
}

/// The same field in the scene's own plane, and as a relief beside it that is turned and moved together with camera and light: every
/// technique and every shadow shows the same.
#[test]
fn a_further_relief_looks_as_the_scenes_own() {
    let Some(gpu) = gpu() else { return };
    let field = Kind::Elevation.field([192, 128], Addressing::Wrap);
    let nothing = HeightField::from_fn([1, 1], Addressing::Clamp, |_, _| 1.0);
    let (yaw, moved) = (35.0_f32, DVec3::new(0.4, 0.7, -0.3));
    let turn = DMat3::from_rotation_y(f64::from(yaw).to_radians());
    let (eye, target) = (DVec3::new(0.3, 0.5, 0.8), DVec3::new(0.02, -0.05, 0.0));
    let here = Camera::look_at(eye, target, 0.8, 0.01);
    let there = Camera::look_at(turn * eye + moved, turn * target + moved, 0.8, 0.01);
    let mut kinds: Vec<_> = Technique::ALL.iter().map(|&technique| (technique, Shadow::Hard, false, None)).collect();
    kinds.extend(Shadow::ALL.iter().map(|&shadow| (Technique::Exact, shadow, false, None)));
    kinds.push((Technique::Exact, Shadow::Hard, true, None));
    kinds.extend([false, true].map(|shell| (Technique::Exact, Shadow::Hard, shell, Some(Shape::Box))));
    kinds.push((Technique::Mesh, Shadow::Hard, false, Some(Shape::Box)));
    for (technique, shadow, shell, shape) in kinds {
        let mut own = scene_of(&field);
        own.plane = Plane { width_metres: 0.8, repeat: [1, 1], depth_metres: 0.07 };
        (own.trace.technique, own.trace.shadow, own.trace.shell) = (technique, shadow, shell);
        own.trace.mesh_triangles = 20_000;
        own.mesh = shape.map(|shape| scene::Mesh { source: MeshSource::Shape(shape), tiles: [1.0; 2], ..scene::Mesh::default() });
        let mut further = own.clone();
        // As one turns from +z toward +x, azimuths, counted from +x toward +z, fall.
        further.light.azimuth_degrees -= yaw;
        further.reliefs = vec![beside(&field, own.plane.clone(), moved.as_vec3().to_array(), [yaw, 0.0, 0.0])];
        further.field = FieldSettings { size: [1, 1], addressing: Addressing::Clamp };
        (further.reliefs[0].mesh, further.mesh) = (own.mesh.clone(), None);
        // A speck, where nobody looks.
        further.plane = Plane { width_metres: 1e-3, ..own.plane.clone() };
        let (one, _) = seen_from_start(gpu, &start_of(&own, &field, &[]), &here, SIZE);
        let (other, _) = seen_from_start(gpu, &start_of(&further, &nothing, std::slice::from_ref(&field)), &there, SIZE);
        let (mut shown, mut off) = (0, 0);
        for (one, other) in one.iter().zip(&other) {
            if one.steps < 0.0 && other.steps < 0.0 {
                continue;
            }
            shown += 1;
            let uv = rays::distance(one.uv.map(f64::from), other.uv.map(f64::from)) * 192.0;
            let place = turn * DVec3::from(one.position.map(f64::from)) + moved;
            let apart = place.distance(DVec3::from(other.position.map(f64::from)));
            let normal = (turn * DVec3::from(one.normal.map(f64::from))).distance(DVec3::from(other.normal.map(f64::from)));
            let light = (one.visibility - other.visibility).abs();
            off += usize::from(uv > 2e-3 || apart > 1e-5 || normal > 2e-3 || light > 0.02);
        }
        println!("{}, {}, shell {shell}, {shape:?}: {off} of {shown} differ", technique.name(), shadow.name());
        assert!(shown > 10_000, "{}: {shown}", technique.name());
        let most = SAME_RELIEF_OFF_SHARE * f64::from(shown);
        assert!(f64::from(off as u32) <= most, "{}, {}, shell {shell}: {off} of {shown}", technique.name(), shadow.name());
    }
}

/// A flat floor, a wall upon it and a slanting roof.
fn shelter(shadow: Shadow) -> (Scene, Vec<HeightField>) {
    let level = |height| HeightField::from_fn([16, 16], Addressing::Clamp, move |_, _| height);
    let fields = vec![level(0.5), level(0.75), level(1.0)];
    let mut scene = scene_of(&fields[0]);
    let plane = |width_metres, depth_metres| Plane { width_metres, repeat: [1, 1], depth_metres };
    scene.plane = plane(2.0, 0.1);
    scene.trace.shadow = shadow;
    scene.trace.displaced_depth = true;
    scene.reliefs = vec![
        beside(&fields[1], plane(0.6, 0.04), [0.1, 0.1, -0.2], [20.0, 90.0, 0.0]),
        beside(&fields[2], plane(0.4, 0.02), [-0.3, 0.45, 0.2], [50.0, 30.0, 15.0]),
    ];
    (scene, fields)
}

const LIGHTS: [[f32; 2]; 4] = [[250.0, 35.0], [70.0, 25.0], [150.0, 50.0], [20.0, 12.0]];

#[test]
fn reliefs_hide_the_light_from_one_another() {
    let Some(gpu) = gpu() else { return };
    let before = Camera::look_at(DVec3::new(0.7, 1.3, 1.5), DVec3::ZERO, 0.9, 0.01);
    // A wall so thick that what is seen behind its front stands within its slab.
    let behind = Camera::look_at(DVec3::new(-0.7, 1.3, -1.5), DVec3::ZERO, 0.9, 0.01);
    let views = [(&before, 0.04, 100), (&before, 0.4, 5), (&behind, 0.4, 100)];
    for ([azimuth, elevation], (camera, thickness, least)) in LIGHTS.into_iter().flat_map(|light| views.map(|view| (light, view)))
    {
        let (mut scene, fields) = shelter(Shadow::Hard);
        scene.reliefs[0].plane.depth_metres = thickness;
        (scene.light.azimuth_degrees, scene.light.elevation_degrees) = (azimuth, elevation);
        let toward = view::light_direction(&scene, 0.0);
        let (channels, _) = seen_from_start(gpu, &start_of(&scene, &fields[0], &fields[1..]), camera, SIZE);
        let truths = truths(&scene, &fields);
        let (mut dark, mut lit, mut near) = (0, 0, 0);
        for (index, channel) in channels.iter().enumerate().filter(|(_, channel)| channel.steps >= 0.0) {
            let Ok(Some((own, true))) = judge(&truths, camera, index, channel, true) else { continue };
            let position = DVec3::from(channel.position.map(f64::from));
            if truths[own].placement.up.dot(toward) <= 1e-3 {
                assert_eq!(channel.visibility, 0.0, "it faces away");
                continue;
            }
            let hidden = |margin: f64| {
                truths.iter().enumerate().filter(|(other, _)| *other != own).any(|(_, truth)| {
                    let half = truth.plane.size_metres(truth.field.size).map(|metres| 0.5 * metres + margin);
                    let depth = f64::from(truth.plane.depth_metres) + margin;
                    let moved = position + truth.placement.up * margin;
                    [position, moved].iter().any(|&at| reliefs::hides(&truth.placement, half, depth, at, toward))
                })
            };
            if hidden(1e-5) != hidden(-1e-5) {
                near += 1;
                continue;
            }
            assert_eq!(channel.visibility, if hidden(0.0) { 0.0 } else { 1.0 }, "{azimuth}°, pixel {}", pixel(index));
            dark += usize::from(hidden(0.0));
            lit += usize::from(!hidden(0.0));
        }
        println!("light {azimuth}°, {elevation}°, {thickness} m: {dark} dark, {lit} lit, {near} at a border");
        assert!(dark > least && lit > 5_000 && near < 200, "{dark} {lit} {near}");
    }
}

/// The claim that the rectangle's shadow stands on: light that enters through it ends in the relief, whatever its field.
#[test]
fn what_enters_a_rectangle_ends_in_the_relief() {
    let mut random = Random::new(5);
    let relief = Relief { pitch_degrees: 70.0, yaw_degrees: 33.0, position_metres: [0.2, 0.3, -0.1], ..Relief::default() };
    let placement = relief.placement();
    let field = Kind::Spikes.field([40, 40], Addressing::Wrap);
    let truth = Truth { placement, plane: Plane { width_metres: 0.5, repeat: [1, 1], depth_metres: 0.1 }, field: &field };
    let (mut dark, mut lit) = (0, 0);
    for _ in 0..20_000 {
        let mut anywhere = || f64::from(random.uniform(-0.6, 0.6));
        let position = DVec3::new(anywhere(), anywhere(), anywhere());
        let toward = DVec3::new(anywhere(), anywhere(), anywhere()).normalize();
        let local = placement.local(position);
        if (-0.1..=0.0).contains(&local.y) {
            continue;
        }
        // From the light's side of the rectangle to the point, or from the point through it.
        let down = if placement.turned(toward).y > 0.0 { -toward } else { toward };
        let from = if down == toward { position } else { position + 10.0 * toward };
        let hit = truth.meeting(from, down).filter(|meeting| meeting.is_sure);
        let hidden = hit.is_some_and(|hit| down == toward || hit.distance < 10.0);
        let near = truth.meeting(from, down).is_some_and(|meeting| !meeting.is_sure);
        if !near {
            assert_eq!(reliefs::hides(&placement, [0.25, 0.25], 0.1, position, toward), hidden, "{position} {toward}");
            (dark, lit) = (dark + usize::from(hidden), lit + usize::from(!hidden));
        }
    }
    assert!(dark > 500 && lit > 5_000, "{dark} {lit}");
}

/// A border falls off as the disc of the light sets behind it: against many directions of the disc.
#[test]
fn soft_borders_follow_the_lights_disc() {
    let Some(gpu) = gpu() else { return };
    let camera = Camera::look_at(DVec3::new(0.7, 1.3, 1.5), DVec3::ZERO, 0.9, 0.01);
    let (mut scene, fields) = shelter(Shadow::Cone);
    scene.reliefs.truncate(1);
    scene.light.half_angle_degrees = 4.0;
    let (mut within, mut sides) = (0, 0);
    // From ahead of the wall and from its side, so that both pairs of borders cast a penumbra. Not from 6° off the wall's own plane, where a
    // disc of 4° sets behind all of it at once: there what is linear in the disc is wrong by up to 0.2.
    let lights = [(LIGHTS[0], RELIEF_PENUMBRA, RELIEF_CORNER), ([20.0, 30.0], RELIEF_PENUMBRA_ASLANT, RELIEF_CORNER_ASLANT)];
    for ([azimuth, elevation], border_bound, corner_bound) in lights {
        let (mut worst, mut corner) = (0.0_f64, 0.0_f64);
        (scene.light.azimuth_degrees, scene.light.elevation_degrees) = (azimuth, elevation);
        let toward = view::light_direction(&scene, 0.0);
        let across = toward.cross(DVec3::Y).normalize();
        let raised = across.cross(toward);
        let radius = f64::from(scene.light.half_angle_degrees).to_radians().tan();
        let (channels, _) = seen_from_start(gpu, &start_of(&scene, &fields[0], &fields[1..2]), &camera, SIZE);
        let wall = Truth { placement: scene.reliefs[0].placement(), plane: scene.reliefs[0].plane.clone(), field: &fields[1] };
        let half = wall.plane.size_metres(wall.field.size).map(|metres| 0.5 * metres);
        for channel in channels.iter().filter(|channel| channel.steps >= 0.0 && channel.position[1] < -0.049) {
            let position = DVec3::from(channel.position.map(f64::from));
            let points = 2_000;
            let open = (0..points).filter(|&i| {
                let (distance, angle) = (((f64::from(i) + 0.5) / f64::from(points)).sqrt(), 2.399_963 * f64::from(i));
                let aside = radius * distance * (angle.cos() * across + angle.sin() * raised);
                !reliefs::hides(&wall.placement, half, 0.04, position, (toward + aside).normalize())
            });
            let expected = open.count() as f64 / f64::from(points);
            let error = (f64::from(channel.visibility) - expected).abs();
            // How far along the wall the centre's ray meets it, within a penumbra of a side border: there two borders meet.
            let (here, way) = (wall.placement.local(position), wall.placement.turned(toward));
            let distance = here.y / way.y;
            let at = here - distance * way;
            let soft = radius * (distance / way.y).abs();
            let is_corner = (at.x.abs() - half[0]).abs() < soft && (at.z.abs() - half[1]).abs() < soft;
            if is_corner {
                corner = corner.max(error);
            } else {
                worst = worst.max(error);
            }
            let is_soft = expected > 0.02 && expected < 0.98;
            within += usize::from(is_soft);
            sides += usize::from(is_soft && (at.x.abs() - half[0]).abs() < soft && !is_corner);
        }
        println!("azimuth {azimuth}: off by at most {worst:.4}, at corners {corner:.4}");
        assert!(worst <= border_bound && corner <= corner_bound, "azimuth {azimuth}: {worst} {corner}");
    }
    println!("{within} pixels in the penumbra, {sides} of them at the sides");
    assert!(within > 2_000 && sides > 400, "{within} {sides}");
}

/// Balls are lit as what stands beside them: one in the shadow of a wall is darker.
#[test]
fn a_ball_behind_a_wall_stands_in_its_shadow() {
    let Some(gpu) = gpu() else { return };
    let camera = Camera::look_at(DVec3::new(0.7, 1.3, 1.5), DVec3::ZERO, 0.9, 0.01);
    let brightness = |shadow| {
        let (mut scene, fields) = shelter(shadow);
        (scene.light.azimuth_degrees, scene.light.elevation_degrees) = (250.0, 35.0);
        scene.balls = vec![Ball { centre: [0.15, -0.02, -0.05], radius_metres: 0.05, colour: [0.9, 0.9, 0.9] }];
        let (channels, picture) = seen_from_start(gpu, &start_of(&scene, &fields[0], &fields[1..]), &camera, SIZE);
        // The ball's own pixels: they show no surface, in the middle of what does.
        let is_ball = |index: &usize| {
            let (eye, direction) = (camera.eye(), camera.direction(pixel(*index), SIZE));
            let centre = DVec3::from(scene.balls[0].centre.map(f64::from));
            let hit = rilievo::reference::balls::hit(centre, 0.049, eye, direction);
            hit.is_some() && channels[*index].steps < 0.0
        };
        let own: Vec<_> = (0..channels.len()).filter(is_ball).collect();
        assert!(own.len() > 50, "{}", own.len());
        own.iter().map(|index| f64::from(picture[4 * index])).sum::<f64>() / own.len() as f64
    };
    let (shadowed, lit) = (brightness(Shadow::Hard), brightness(Shadow::None));
    // What is left is the sky's, as the picture's curve lifts it.
    assert!(shadowed < 0.9 * lit, "{shadowed} of {lit}");
}

/// What a scene's reliefs take is counted.
#[test]
fn every_field_is_counted() {
    let Some(gpu) = gpu() else { return };
    let field = HeightField::from_fn([256, 256], Addressing::Wrap, |_, _| 0.5);
    let bytes = |count: usize| {
        let mut scene = scene_of(&field);
        scene.trace.displaced_depth = true;
        scene.reliefs = vec![beside(&field, Plane::default(), [0.0; 3], [0.0; 3]); count];
        scene.reliefs.iter_mut().for_each(|relief| relief.base = Base::Flat { height: 0.5 });
        let start = start_of(&scene, &field, &vec![field.clone(); count]);
        let frame = rilievo::frame::Frame::new(gpu, &start, [64, 64], rilievo::modes::capture::PICTURE_FORMAT);
        frame.expect("it is small").memory_bytes()
    };
    let each = (bytes(3) - bytes(1)) as f64 / 2.0;
    // The textures of a field without waves are 29½ bytes a texel.
    assert!((each / 65_536.0 - 29.5).abs() < 0.2, "{each} bytes for each relief");
}
