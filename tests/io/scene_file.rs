//! Scenes from the program and from files, with what the command line changes in them.

use std::fs;
use std::path::Path;

use glam::Vec3;
use rilievo::camera::Camera;
use rilievo::io::scene_file::{CameraPlacement, EMBEDDED, FieldSize, SceneOverrides, embedded, list, load};
use rilievo::mesh::{MeshSource, Shape};
use rilievo::scene::{Base, Boundary, PomCounts, PyramidLeaf, Scene, Text};
use rilievo::surface::{Albedo, Shadow, Technique};

const PICTURE: [u32; 2] = [640, 480];

fn temporary() -> tempfile::TempDir {
    tempfile::tempdir().expect("there is a temporary directory")
}

fn write(directory: &Path, name: &str, text: &str) -> String {
    let path = directory.join(name);
    fs::write(&path, text).expect("the directory can be written");
    path.to_str().expect("temporary directories have plain names").to_owned()
}

#[track_caller]
fn refusal(which: &str) -> String {
    let sentence = load(which, &SceneOverrides::default(), PICTURE).expect_err("it is unfit").to_string();
    assert!(!sentence.contains('\n'), "{sentence}");
    sentence
}

#[test]
fn a_mesh_is_seen_wherever_its_file_puts_it() {
    let directory = temporary();
    let face = "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    let path = write(directory.path(), "far.obj", &format!("v 500 7 -30\nv 540 7 -30\nv 540 7 -60\n{face}"));
    let mesh = Some(MeshSource::File(path.into()));
    let overrides = SceneOverrides { mesh: mesh.clone(), ..SceneOverrides::default() };
    let camera = load("relief", &overrides, PICTURE).expect("it is sound").scene.camera;
    // Its box's middle, from where half its diagonal of 50 m fits 45°.
    assert_eq!(camera.target, [520.0, 7.0, -45.0]);
    let distance = (0..3).map(|axis| (camera.eye[axis] - camera.target[axis]).powi(2)).sum::<f64>().sqrt();
    assert!((distance * 22.5_f64.to_radians().sin() / 25.0 - 1.0).abs() < 0.03, "{distance} m");
    // A camera that someone chose stays.
    let chosen = CameraPlacement { eye: [0.0, 1.0, 1.0], target: [0.0; 3] };
    let overrides = SceneOverrides { mesh, camera: Some(chosen), ..SceneOverrides::default() };
    assert_eq!(load("relief", &overrides, PICTURE).expect("it is sound").scene.camera.target, chosen.target);
    // The program's own shapes stand where the scenes look.
    let shape = SceneOverrides { mesh: Some(MeshSource::Shape(Shape::Torus)), ..SceneOverrides::default() };
    assert_eq!(load("relief", &shape, PICTURE).expect("it is sound").scene.camera.target, [0.0, -0.04, 0.02]);
}

#[test]
fn a_shape_is_seen_whole() {
    for shape in Shape::ALL {
        for picture in [PICTURE, [64, 40], [300, 900]] {
            let overrides = SceneOverrides { mesh: Some(MeshSource::Shape(shape)), ..SceneOverrides::default() };
            let loaded = load("relief", &overrides, picture).expect("it is sound");
            let camera = Camera::at(&loaded.scene.camera, 0.0);
            let view_from_world = camera.world_from_view.inverse();
            let half_height = (camera.vertical_fov_radians / 2.0).tan();
            let half_width = half_height * f64::from(picture[0]) / f64::from(picture[1]);
            let reach = |point: Vec3| {
                let p = view_from_world.transform_point3(point.as_dvec3());
                if p.z < 0.0 { (p.x.abs() / half_width).max(p.y.abs() / half_height) / -p.z } else { f64::INFINITY }
            };
            let mesh = loaded.mesh.expect("it was asked for");
            let farthest = mesh.vertices.iter().map(|vertex| reach(vertex.position)).fold(0.0, f64::max);
            // Near the picture's border, and within it.
            assert!((0.6..0.99).contains(&farthest), "{shape:?} in {picture:?}: {farthest}");
        }
    }
}

#[test]
fn every_scene_of_the_program_is_sound() {
    for (name, text) in EMBEDDED {
        let scene: Scene = toml::from_str(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(scene.name, name);
        assert_eq!(scene.validate(), Ok(()), "{name}");
        assert!(!scene.description.is_empty(), "{name}");
        assert_eq!(embedded(name), Some(scene));
    }
    assert_eq!(list().len(), EMBEDDED.len());
}

#[test]
fn every_scene_shows_its_whole_plane_by_itself() {
    for (name, _) in EMBEDDED {
        let scene = embedded(name).expect("it is listed");
        // In the default picture and wider ones; narrower ones move it away.
        for aspect in [1.6, 16.0 / 9.0] {
            assert_eq!(scene.framing(aspect), scene.camera, "{name} at {aspect}: move its camera away");
        }
        assert!((scene.camera.vertical_fov_degrees - 45.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn relief_is_what_the_contract_says() {
    let scene = embedded("relief").expect("it is listed");
    assert_eq!((scene.plane.width_metres, scene.plane.depth_metres), (1.0, 0.1));
    assert_eq!(scene.field.addressing, rilievo::scene::Addressing::Clamp);
    assert!(scene.wave.is_none() && scene.shots.is_none());
    assert_eq!((scene.light.turn_degrees_per_second, scene.camera.orbit_degrees_per_second), (0.0, 0.0));
}

#[test]
fn a_written_scene_is_read_back() {
    let directory = temporary();
    for (name, _) in EMBEDDED {
        let scene = embedded(name).expect("it is listed");
        let path = write(directory.path(), "scene.toml", &toml::to_string(&scene).expect("a scene is TOML"));
        assert_eq!(load(&path, &SceneOverrides::default(), PICTURE).expect("it was just written").scene, scene);
    }
}

#[test]
fn overrides_replace_what_they_name_and_nothing_else() {
    let overrides = SceneOverrides {
        field: Some(FieldSize::Width(96)),
        depth_metres: Some(0.5),
        technique: Some(Technique::Pom),
        shadow: Some(Shadow::None),
        samples: Some([3, 30]),
        pom_counts: Some(PomCounts::Texels),
        relief_depth_bias: Some(true),
        pyramid_leaf: Some(PyramidLeaf::Nearest),
        seed: Some(77),
        camera: Some(CameraPlacement { eye: [0.0, 0.2, 3.0], target: [0.0, 0.0, 1.0] }),
        vertical_fov_degrees: Some(20.0),
        ..SceneOverrides::default()
    };
    let directory = temporary();
    let moving = "version = 1\n[camera]\norbit_degrees_per_second = 20.0\nnear_metres = 0.5\n";
    let path = write(directory.path(), "moving.toml", moving);
    let scene = load(&path, &overrides, PICTURE).expect("it is sound").scene;
    let mut expected: Scene = toml::from_str(moving).expect("it is sound");
    expected.name = "moving".to_owned();
    expected.field.size = [96, 96];
    expected.plane.depth_metres = 0.5;
    expected.trace.technique = Technique::Pom;
    expected.trace.shadow = Shadow::None;
    expected.trace.pom_samples_min = 3;
    expected.trace.pom_samples_max = 30;
    expected.trace.steep_layers = 30;
    expected.trace.relief_linear_steps = 30;
    expected.trace.pom_counts = PomCounts::Texels;
    expected.trace.relief_depth_bias = true;
    expected.trace.pyramid_leaf = PyramidLeaf::Nearest;
    expected.seed = 77;
    expected.camera.eye = [0.0, 0.2, 3.0];
    expected.camera.target = [0.0, 0.0, 1.0];
    expected.camera.vertical_fov_degrees = 20.0;
    expected.camera.orbit_degrees_per_second = 0.0;
    assert_eq!(scene, expected);
}

#[test]
fn a_text_replaces_the_base_and_in_a_sign_only_its_words() {
    let overrides = SceneOverrides { text: Some("Two\nlines".to_owned()), ..SceneOverrides::default() };
    let loaded = load("relief", &overrides, PICTURE).expect("it is sound");
    let words = "Two\nlines".to_owned();
    assert_eq!(loaded.scene.base, Base::Text(Text { text: words.clone(), ..Text::default() }));
    assert_eq!(loaded.layers().0.len(), 512 * 512);
    let own = embedded("text").expect("it is listed");
    let Base::Text(own) = own.base else { panic!("the scene is a sign") };
    let loaded = load("text", &overrides, PICTURE).expect("it is sound");
    assert_eq!(loaded.scene.base, Base::Text(Text { text: words, ..own }));

    let directory = temporary();
    let font = write(directory.path(), "font.ttf", "no font");
    let overrides = SceneOverrides { font: Some(font.into()), ..SceneOverrides::default() };
    assert!(load("text", &overrides, PICTURE).expect_err("it is no font").to_string().contains("font.ttf is not a TTF"));
    let sentence = load("relief", &overrides, PICTURE).expect_err("there is no text").to_string();
    assert!(sentence.contains("--text"), "{sentence}");
    // A scene's own font lies beside it.
    let path = write(directory.path(), "sign.toml", "version = 1\n[base]\nkind = \"text\"\nfont = \"font.ttf\"\n");
    assert!(refusal(&path).contains("font.ttf is not a TTF"));
}

#[test]
fn colours_are_loaded_with_the_scene() {
    let directory = temporary();
    let picture = image::RgbImage::from_pixel(3, 2, image::Rgb([1, 2, 3]));
    picture.save(directory.path().join("c.png")).expect("the directory can be written");
    let path = write(directory.path(), "scene.toml", "version = 1\n[material]\nalbedo = \"image\"\nimage = \"c.png\"\n");
    let loaded = load(&path, &SceneOverrides::default(), PICTURE).expect("it is sound");
    assert_eq!(loaded.layers().1.expect("it has some").rgba, [1, 2, 3, 255].repeat(6));
    let overrides = SceneOverrides { albedo: Some(directory.path().join("c.png")), ..SceneOverrides::default() };
    let loaded = load("ripples", &overrides, PICTURE).expect("it is sound");
    assert_eq!((loaded.scene.material.albedo, loaded.layers().1.map(|image| image.size)), (Albedo::Image, Some([3, 2])));
    assert_eq!(load("ripples", &SceneOverrides::default(), PICTURE).expect("it is sound").layers().1, None);
}

#[test]
fn an_image_sets_the_size_unless_the_file_does() {
    let directory = temporary();
    image::GrayImage::from_fn(6, 4, |x, _| image::Luma([x as u8 * 50]))
        .save(directory.path().join("h.png"))
        .expect("the directory can be written");
    let base = "version = 1\n[base]\nkind = \"image\"\npath = \"h.png\"\n";
    // The path of the image is relative to the scene's.
    let path = write(directory.path(), "own.toml", base);
    let loaded = load(&path, &SceneOverrides::default(), PICTURE).expect("it is sound");
    assert_eq!(loaded.scene.field.size, [6, 4]);
    assert_eq!(loaded.image_heights().expect("it starts from an image").heights.len(), 24);
    let path = write(directory.path(), "sized.toml", &format!("{base}[field]\nsize = [3, 8]\n"));
    let loaded = load(&path, &SceneOverrides::default(), PICTURE).expect("it is sound");
    assert_eq!(loaded.scene.field.size, [3, 8]);
    assert_eq!(loaded.image_heights().expect("it starts from an image").size, [3, 8]);

    let image = Some(directory.path().join("h.png"));
    for (field, size) in [
        (None, [6, 4]),
        (Some(FieldSize::Width(3)), [3, 2]),
        (Some(FieldSize::Width(1)), [1, 1]),
        (Some(FieldSize::Width(100)), [100, 67]),
        (Some(FieldSize::Exactly([5, 9])), [5, 9]),
    ] {
        let overrides = SceneOverrides { height: image.clone(), field, ..SceneOverrides::default() };
        let loaded = load("ripples", &overrides, PICTURE).expect("it is sound");
        assert_eq!(loaded.scene.field.size, size);
        assert!(loaded.scene.wave.is_some() && matches!(loaded.scene.base, Base::Image { .. }));
    }
}

#[test]
fn reliefs_beside_the_scenes_own_have_files_and_sizes_of_their_own() {
    let directory = temporary();
    image::GrayImage::from_fn(6, 4, |x, _| image::Luma([x as u8 * 50]))
        .save(directory.path().join("h.png"))
        .expect("the directory can be written");
    let image = "[[reliefs]]\nyaw_degrees = 90.0\n[reliefs.base]\nkind = \"image\"\npath = \"h.png\"\n";
    let sized = format!("{image}[reliefs.field]\nsize = [3, 8]\n");
    let meshed = "[[reliefs]]\n[reliefs.mesh]\nsource = \"torus\"\n[reliefs.base]\nkind = \"text\"\n";
    let path = write(directory.path(), "own.toml", &format!("version = 1\n{image}{sized}{meshed}"));
    // The command line speaks of the scene's own.
    let overrides = SceneOverrides { field: Some(FieldSize::Width(20)), depth_metres: Some(0.3), ..SceneOverrides::default() };
    let loaded = load(&path, &overrides, PICTURE).expect("it is sound");
    let sizes: Vec<_> = loaded.reliefs.iter().map(|relief| relief.scene.field.size).collect();
    assert_eq!(sizes, [[6, 4], [3, 8], [512, 512]]);
    assert_eq!(loaded.scene.reliefs.iter().map(|relief| relief.field.size).collect::<Vec<_>>(), sizes);
    assert_eq!((loaded.scene.field.size, loaded.scene.reliefs[0].plane.depth_metres), ([20, 20], 0.1));
    for (relief, size) in loaded.reliefs.iter().zip(sizes) {
        assert_eq!(relief.layers().0.len(), (size[0] * size[1]) as usize);
    }
    assert!(loaded.reliefs[2].mesh.is_some() && loaded.reliefs[0].mesh.is_none());
}

#[test]
fn a_tall_plane_is_shown_whole_unless_a_camera_was_chosen() {
    let overrides = SceneOverrides { field: Some(FieldSize::Exactly([64, 512])), ..SceneOverrides::default() };
    let own = embedded("relief").expect("it is listed").camera;
    let loaded = load("relief", &overrides, PICTURE).expect("it is sound");
    assert!(loaded.scene.camera.eye[1] > 2.0 * own.eye[1], "{:?}", loaded.scene.camera);
    let directory = temporary();
    let path = write(directory.path(), "close.toml", "version = 1\n[camera]\neye = [0.0, 0.1, 0.0]\n");
    let loaded = load(&path, &overrides, PICTURE).expect("it is sound");
    assert_eq!(loaded.scene.camera.eye, [0.0, 0.1, 0.0]);
}

#[test]
fn unfit_files_are_refused_with_their_line() {
    let directory = temporary();
    for (text, part) in [
        ("", "says no version"),
        ("seed = 1\n", "says no version"),
        ("version = 2\n", "version 2"),
        ("version = \"1\"\n", "says no version"),
        ("version = 1\n\n[wave]\ncourrant = 0.5\n", "line 4: unknown field `courrant`"),
        ("version = 1\n[wave]\ncourrant = 0.5\n", "did you mean `courant`?"),
        ("version = 1\n[trace]\ntechnique = \"exat\"\n", "did you mean `exact`?"),
        ("version = 1\n[field]\nsize = [1, 2, 3]\n", "line 3"),
        ("version = 1\n[field]\nsize = [1, -2]\n", "line 3"),
        ("version = 1\n[field]\nsize = [0, 4]\n", "`field.size` is [0, 4]"),
        ("version = 1\n[plane]\ndepth_metres = nan\n", "`plane.depth_metres` is NaN"),
        ("version = 1\n[wave]\ncourant = 0.71\n", "at most 0.49"),
        ("version = 1\n[base]\nkind = \"bricks\"\nheigth = 1\n", "heigth"),
        ("version = 1\n[camera]\neye = [0.0, 0.0", "line 3"),
        ("version = 1\nversion = 1\n", "line 2"),
        ("version = 1\n[base]\nkind = \"image\"\npath = \"nowhere.png\"\n", "nowhere.png: there is no such file"),
        ("version = 1\n[base]\nkind = \"image\"\npath = \"\"\n", "`base.path` is empty"),
        ("version = 1\n[base]\nkind = \"text\"\ntext = \" \\n\"\n", "no letters"),
        ("version = 1\n[base]\nkind = \"text\"\ntext = \"a\\tb\"\n", "U+0009"),
        ("version = 1\n[base]\nkind = \"text\"\nbold = 1\n", "unknown field `bold`"),
        ("version = 1\n[base]\nkind = \"text\"\nfont = \"\"\n", "`base.font` is empty"),
        ("version = 1\n[base]\nkind = \"text\"\nbevel = -1.0\n", "`base.bevel` is -1"),
        ("version = 1\n[material]\nalbedo = \"image\"\n", "--albedo"),
        ("version = 1\n[material]\nimage = \"\"\n", "`material.image` is empty"),
        ("version = 1\n[material]\nimage = \"nowhere.png\"\n", "nowhere.png: there is no such file"),
        ("version = 1\n[[reliefs]]\nposition_metres = [0.0, 1.0]\n", "2 values where there must be 3"),
        ("version = 1\n[[reliefs]]\nyaw = 1.0\n", "did you mean `yaw_degrees`?"),
        ("version = 1\n[[reliefs]]\npitch_degrees = inf\n", "`reliefs[0].pitch_degrees` is inf"),
        ("version = 1\n[[reliefs]]\n[[reliefs]]\n[reliefs.field]\nsize = [0, 4]\n", "`reliefs[1].field.size` is [0, 4]"),
        ("version = 1\n[[reliefs]]\n[reliefs.wave]\n", "unknown field `wave`"),
        (
            "version = 1\n[[reliefs]]\n[reliefs.base]\nkind = \"image\"\npath = \"nowhere.png\"\n",
            "nowhere.png: there is no such file",
        ),
        ("version = 1\n[[reliefs]]\n[reliefs.mesh]\nsource = \"cubes\"\n", "unknown mesh"),
    ] {
        let path = write(directory.path(), "scene.toml", text);
        let sentence = refusal(&path);
        assert!(sentence.contains(part), "{text:?}: {sentence}");
    }
    let path = directory.path().join("scene.toml");
    let path = path.to_str().expect("temporary directories have plain names");
    fs::write(path, [0x89, b'P', b'N', b'G', 0xff]).expect("the directory can be written");
    assert!(refusal(path).contains("not a text file"));
    fs::write(path, vec![b'#'; 2 << 20]).expect("the directory can be written");
    assert!(refusal(path).contains("2097152 bytes"));
    assert!(refusal("nowhere.toml").contains("no such file"));
    assert!(refusal("./nowhere").contains("no such file"));
    assert!(refusal("riples").contains("did you mean `ripples`, of ripples, bullet-wall, "));
    assert!(refusal("").contains("known are ripples, bullet-wall, relief"));
}

#[test]
fn keys_are_spelt_as_documented() {
    let text = "version = 1\n[wave]\nboundary = \"absorbing\"\n[[wave.obstacles]]\ncentre = [0.5, 0.5]\nhalf_extent_metres = [0.1, 0.2]\n";
    let directory = temporary();
    let path = write(directory.path(), "scene.toml", text);
    let wave = load(&path, &SceneOverrides::default(), PICTURE).expect("it is sound").scene.wave.expect("it has one");
    assert_eq!(wave.boundary, Boundary::Absorbing);
    assert_eq!(wave.obstacles[0].top, 1.0);
}
