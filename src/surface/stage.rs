//! Stage: what the camera sees beside and instead of the bare plane: a mesh that carries the relief, flat or as a shell, further reliefs,
//! and balls, with a depth buffer.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::ops::Range;

use super::micropolygon::{Micropolygons, Plan};
use super::raster::{self, CHANNEL_FORMAT, CHANNEL_PARTS, Geometry, MeshBuffers, Output};
use super::ray_map::{Placement, Target};
use super::shell;
use super::{Choice, Display, Shows, Technique, View, ViewSet, bind_field, facet, field_layout, outline, view};
use crate::camera::Camera;
use crate::field::Field;
use crate::gpu::{BindingLayout, Gpu, Readback, Recorder, ShaderError};
use crate::mesh::Mesh;
use crate::scene::{Addressing, Scene};

/// What is drawn, and with what.
pub struct Stage {
    view_layout: BindingLayout,
    mesh_layout: BindingLayout,
    field_layout: BindingLayout,
    /// Built when they are first needed.
    pipelines: RefCell<HashMap<(Choice, Geometry, Output), wgpu::RenderPipeline>>,
    /// The scene's own relief, and those beside it.
    carriers: Vec<Carrier>,
    /// The bindings of an empty mesh, for what has none.
    no_mesh: MeshBuffers,
    /// One for each draw at most, on each side of a divider, and what its sampler does beyond the border.
    views: [Vec<(Addressing, ViewSet)>; 2],
    depth: wgpu::TextureView,
    size: [u32; 2],
}

/// A field, and what carries it.
struct Carrier {
    field_group: wgpu::BindGroup,
    addressing: Addressing,
    mesh: Option<Body>,
    micropolygons: Option<Micropolygons>,
}

/// A mesh and its buffers.
struct Body {
    mesh: Mesh,
    buffers: MeshBuffers,
    /// What is hidden in its shell, at the depth at which it was last asked for.
    core: Cell<Option<(f32, shell::Core)>>,
}

impl Body {
    /// The core of its shell, `depth_metres` deep; of one that moves, none.
    fn core(&self, depth_metres: f32) -> shell::Core {
        let known = self.core.get().filter(|(depth, _)| *depth == depth_metres);
        let found = || match self.mesh.skin {
            Some(_) => shell::Core::default(),
            None => shell::core(&self.mesh.vertices, &self.mesh.indices, depth_metres),
        };
        let core = known.map_or_else(found, |(_, core)| core);
        self.core.set(Some((depth_metres, core)));
        core
    }
}

/// One draw: what, of which relief, which triangles, seen through which view.
struct Draw {
    carrier: usize,
    geometry: Geometry,
    choice: Choice,
    triangles: Range<u32>,
    view: View,
}

/// What is seen from where.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Where it is seen from.
    pub camera: &'a Camera,
    /// The time that it shows, seconds.
    pub time_seconds: f64,
    /// What is shown of it: what is on the right of a divider is not for here.
    pub display: Display,
}

impl Stage {
    /// Whether a scene without a mesh needs one: else the plane alone is drawn, which antialiases its border.
    pub fn is_needed(scene: &Scene) -> bool {
        let trace = &scene.trace;
        let is_rasterised = trace.shell || trace.displaced_depth || trace.technique == Technique::Mesh;
        !scene.balls.is_empty() || !scene.reliefs.is_empty() || is_rasterised
    }

    /// Makes one for pictures of `size` traced pixels, of these fields: the scene's own, and those of the reliefs beside it. None has a
    /// mesh yet.
    pub fn new(gpu: &Gpu, fields: &[&Field], size: [u32; 2]) -> Self {
        let (view_layout, field_layout, mesh_layout) = (view::layout(gpu), field_layout(gpu), raster::mesh_layout(gpu));
        let carrier = |field: &&Field| Carrier {
            field_group: bind_field(gpu, &field_layout, field),
            addressing: field.addressing,
            mesh: None,
            micropolygons: None,
        };
        let carriers = fields.iter().map(carrier).collect();
        let no_mesh = MeshBuffers::new(gpu, &mesh_layout, &[], &[], false);
        Self {
            view_layout,
            mesh_layout,
            field_layout,
            pipelines: RefCell::default(),
            carriers,
            no_mesh,
            views: Default::default(),
            depth: depth_buffer(gpu, size),
            size,
        }
    }

    /// Puts other meshes on it, one for each field: where they lie in the world. None is the plane, unless its shell is drawn.
    pub fn set_meshes(&mut self, gpu: &Gpu, meshes: impl IntoIterator<Item = Option<Mesh>>) {
        for (carrier, mesh) in self.carriers.iter_mut().zip(meshes) {
            if carrier.mesh.as_ref().map(|body| &body.mesh) == mesh.as_ref() {
                continue;
            }
            carrier.micropolygons = None;
            carrier.mesh = mesh.map(|mesh| {
                let can_be_shell = mesh.triangle_count() <= shell::TRIANGLES_MAX;
                let buffers = MeshBuffers::new(gpu, &self.mesh_layout, &mesh.vertices, &mesh.indices, can_be_shell);
                Body { mesh, buffers, core: Cell::default() }
            });
        }
    }

    /// Takes another size, of traced pixels.
    pub fn resize(&mut self, gpu: &Gpu, size: [u32; 2]) {
        (self.depth, self.size) = (depth_buffer(gpu, size), size);
    }

    /// Gives back the memory of micropolygons.
    pub fn forget_micropolygons(&mut self) {
        self.carriers.iter_mut().for_each(|carrier| carrier.micropolygons = None);
    }

    /// Forgets every pipeline: the device's shaders have changed.
    pub fn forget_pipelines(&mut self) {
        self.pipelines.get_mut().clear();
    }

    /// Builds what a view of a scene needs and is not there yet, on the left or, `side` being 1, the right of a divider.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn prepare(&mut self, gpu: &Gpu, scene: &Scene, shows: Shows, side: usize) -> Result<(), ShaderError> {
        self.prepare_micropolygons(gpu, scene);
        // What is drawn does not depend on the camera.
        let camera = &Camera::at(&scene.camera, 0.0);
        let draws = self.draws(&Seen { scene, camera, time_seconds: 0.0, display: shows.into() }, self.size);
        for (index, draw) in draws.iter().enumerate() {
            self.build(gpu, draw.choice, draw.geometry, Output::Radiance)?;
            let addressing = self.carriers[draw.carrier].addressing;
            let views = &mut self.views[side];
            if views.get(index).is_none_or(|(there, _)| *there != addressing) {
                views.truncate(index);
                views.push((addressing, ViewSet::new(gpu, &self.view_layout, addressing)));
            }
        }
        Ok(())
    }

    /// Makes the micropolygons that a scene asks for, unless they are there.
    fn prepare_micropolygons(&mut self, gpu: &Gpu, scene: &Scene) {
        if scene.trace.technique != Technique::Mesh {
            return;
        }
        for (carrier, (alone, placement)) in self.carriers.iter_mut().zip(reliefs_of(scene)) {
            let plane = || (alone.plane_size_metres().map(|metres| metres as f32), alone.field.addressing);
            let bare_plane = carrier.mesh.is_none().then(plane);
            let plan = Plan { triangles: scene.trace.mesh_triangles, bare_plane, placement };
            if carrier.micropolygons.as_ref().is_none_or(|there| there.plan() != plan) {
                let mesh = carrier.mesh.as_ref().map(|body| (body.mesh.vertices.as_slice(), body.mesh.indices.as_slice()));
                carrier.micropolygons = Some(Micropolygons::new(gpu, plan, mesh.unwrap_or_default()));
            }
        }
    }

    fn build(&self, gpu: &Gpu, choice: Choice, geometry: Geometry, output: Output) -> Result<(), ShaderError> {
        let key = (choice, geometry, output);
        if !self.pipelines.borrow().contains_key(&key) {
            let groups = [&self.view_layout, &self.field_layout, &self.mesh_layout];
            let pipeline = raster::pipeline(gpu, groups, choice, geometry, output)?;
            self.pipelines.borrow_mut().insert(key, pipeline);
        }
        Ok(())
    }

    /// Everything that is drawn, from back to front where that matters.
    fn draws(&self, seen: &Seen<'_>, image_size: [u32; 2]) -> Vec<Draw> {
        let Seen { scene, camera, time_seconds, display } = *seen;
        let view = View::new(scene, camera, time_seconds, image_size, display).among(scene, None);
        let plain = |geometry| Draw { carrier: 0, geometry, choice: Choice::beside(scene), triangles: 0..1, view };
        let mut draws = vec![plain(Geometry::Backdrop)];
        let reliefs = Choice::of(scene).reliefs;
        for (index, (alone, placement)) in reliefs_of(scene).into_iter().enumerate().take(self.carriers.len()) {
            let choice = Choice { reliefs, ..Choice::of(&alone) }.showing(display.shows);
            let target = target(&alone, placement);
            let view =
                View::new(&alone, camera, time_seconds, image_size, display).over(camera, &target).among(scene, Some(index));
            draws.extend(self.carrier_draws(index, &Seen { scene: &alone, ..*seen }, choice, view));
        }
        if !scene.balls.is_empty() {
            draws.push(plain(Geometry::Balls));
        }
        draws
    }

    /// What is drawn of one relief, which `seen` shows by itself.
    fn carrier_draws(&self, carrier: usize, seen: &Seen<'_>, choice: Choice, view: View) -> Vec<Draw> {
        let draw = |geometry, triangles, view| Draw { carrier, geometry, choice, triangles, view };
        let Some(body) = &self.carriers[carrier].mesh else {
            return vec![match choice.technique {
                Technique::Mesh => draw(Geometry::Micropolygons, 0..2, View { planar: 2, ..view }),
                _ => draw(Geometry::Plane, 0..1, view),
            }];
        };
        let settings = seen.scene.mesh.as_ref().map(|mesh| mesh.materials.as_slice()).unwrap_or_default();
        // A floor of several depths has gaps.
        let is_one_floor = settings.iter().all(|settings| settings.depth_metres.is_none());
        let core = if seen.scene.trace.shell && is_one_floor { body.core(view.depth_metres) } else { shell::Core::default() };
        let view = View { core_centre: core.centre.to_array(), core_radius: core.radius, ..view };
        let parts = body.mesh.parts.iter().flat_map(|part| {
            let mut view = view;
            if let Some(settings) = settings.iter().find(|settings| settings.name == part.material) {
                view.depth_metres = settings.depth_metres.unwrap_or(view.depth_metres);
                if let Some([fewest, most]) = settings.samples {
                    (view.pom_samples_min, view.pom_samples_max) = (fewest as f32, most as f32);
                }
            }
            let mut draws = mesh_draws(&body.mesh, part.triangles.clone(), seen, |geometry, triangles, place| match place {
                Some(target) => {
                    let target = Target { depth_metres: f64::from(view.depth_metres), ..target };
                    draw(geometry, triangles, View { planar: 1, ..view.over(seen.camera, &target) })
                }
                None => draw(geometry, triangles, view),
            });
            if choice.technique == Technique::Mesh {
                draws.push(draw(Geometry::Walls, part.triangles.clone(), view));
            }
            draws
        });
        parts.collect()
    }

    /// Records one render pass over these columns of `radiance`, under a name of its own; whoever begins at the first begins the
    /// picture. The pipelines of this side must have been prepared.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        name: &str,
        side: usize,
        seen: &Seen<'_>,
        radiance: &wgpu::TextureView,
        columns: Range<u32>,
    ) {
        let draws = self.draws(seen, self.size);
        for (draw, (_, set)) in draws.iter().zip(&self.views[side]) {
            set.uniform.write(recorder.gpu, &draw.view);
        }
        self.pose(recorder.gpu, seen.time_seconds);
        recorder.render_onto(name, radiance, Some(&self.depth), columns.start > 0, |pass| {
            pass.set_scissor_rect(columns.start, 0, columns.end - columns.start, self.size[1]);
            self.draw(pass, &draws, &self.views[side], Output::Radiance);
        });
    }

    /// Moves animated meshes to where they are at a time.
    fn pose(&self, gpu: &Gpu, time_seconds: f64) {
        for carrier in &self.carriers {
            let Some(Body { mesh, buffers, .. }) = carrier.mesh.as_ref().filter(|body| body.mesh.skin.is_some()) else {
                continue;
            };
            let vertices = mesh.posed(time_seconds);
            buffers.pose(gpu, &vertices, &mesh.indices);
            if let Some(micropolygons) = &carrier.micropolygons {
                micropolygons.pose(gpu, (&vertices, &mesh.indices));
            }
        }
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, draws: &[Draw], views: &[(Addressing, ViewSet)], output: Output) {
        let pipelines = self.pipelines.borrow();
        for (draw, (_, view)) in draws.iter().zip(views) {
            let Some(pipeline) = pipelines.get(&(draw.choice, draw.geometry, output)) else { continue };
            let Carrier { field_group, mesh, micropolygons, .. } = &self.carriers[draw.carrier];
            let buffers = mesh.as_ref().map_or(&self.no_mesh, |body| &body.buffers);
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &view.group, &[]);
            pass.set_bind_group(1, field_group, &[]);
            pass.set_bind_group(2, &buffers.group, &[]);
            let Range { start, end } = draw.triangles;
            match draw.geometry {
                Geometry::Backdrop | Geometry::Balls => pass.draw(0..3, 0..1),
                Geometry::Plane => pass.draw(0..outline::VERTICES, 0..1),
                Geometry::Facets(_) => {
                    pass.set_index_buffer(buffers.indices(), wgpu::IndexFormat::Uint32);
                    pass.draw_indexed(3 * start..3 * end, 0, 0..1);
                }
                Geometry::Micropolygons => {
                    // The plane alone goes on beyond its border: over the tiles around it, where the field wraps.
                    let instances = if draw.view.planar == 2 && draw.view.wrap == 1 { 9 } else { 1 };
                    if let Some(micropolygons) = micropolygons {
                        micropolygons.draw(pass, &micropolygons.of(&draw.triangles), instances);
                    }
                }
                Geometry::Walls => {
                    if let Some(micropolygons) = micropolygons {
                        micropolygons.draw(pass, &micropolygons.walls_of(&draw.triangles), 1);
                    }
                }
                // Three tetrahedra of four sides.
                Geometry::Shell => pass.draw(36 * start..36 * end, 0..1),
            }
        }
    }

    /// Draws the channels at `size`, one ray a pixel, submits the work, and returns their parts on their way: four f32 a pixel each.
    ///
    /// # Errors
    ///
    /// A shader does not compile.
    pub fn request_channels(&self, gpu: &Gpu, seen: &Seen<'_>, size: [u32; 2]) -> Result<Vec<Readback>, ShaderError> {
        let draws: Vec<_> = self.draws(seen, size).into_iter().filter(|draw| draw.geometry != Geometry::Backdrop).collect();
        let addressing = |draw: &Draw| self.carriers[draw.carrier].addressing;
        let views: Vec<_> = draws
            .iter()
            .map(addressing)
            .map(|addressing| (addressing, ViewSet::new(gpu, &self.view_layout, addressing)))
            .collect();
        for (draw, (_, set)) in draws.iter().zip(&views) {
            set.uniform.write(gpu, &draw.view);
        }
        self.pose(gpu, seen.time_seconds);
        let depth = depth_buffer(gpu, size);
        let mut readbacks = Vec::new();
        for part in 0..CHANNEL_PARTS {
            let output = Output::Channels(part);
            for draw in &draws {
                self.build(gpu, draw.choice, draw.geometry, output)?;
            }
            let target = channel_target(gpu, size);
            let mut encoder = gpu.encoder("channels");
            {
                let view = target.create_view(&wgpu::TextureViewDescriptor::default());
                // No surface: no steps, but −1; every other channel 0.
                let clear = wgpu::Color { r: 0.0, g: 0.0, b: 0.0, a: if part == 0 { -1.0 } else { 0.0 } };
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some("channels"),
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store },
                    })],
                    depth_stencil_attachment: Some(crate::gpu::timer::depth_attachment(&depth)),
                    ..Default::default()
                });
                self.draw(&mut pass, &draws, &views, output);
            }
            let readback = Readback::record_texture(gpu, &mut encoder, &target, 0);
            gpu.queue.submit([encoder.finish()]);
            readback.start();
            readbacks.push(readback);
        }
        Ok(readbacks)
    }

    /// Bytes of GPU memory that its buffers take.
    pub fn memory_bytes(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        let carried = self.carriers.iter().map(|carrier| {
            let mesh = carrier.mesh.as_ref().map_or(0, |body| body.buffers.memory_bytes());
            mesh + carrier.micropolygons.as_ref().map_or(0, Micropolygons::memory_bytes)
        });
        carried.sum::<u64>() + 4 * width * height
    }
}

/// The reliefs of a scene, its own first: each as a scene by itself, and where its plane lies.
fn reliefs_of(scene: &Scene) -> Vec<(Scene, Placement)> {
    let own = std::iter::once((scene.clone(), Placement::default()));
    own.chain(scene.reliefs.iter().map(|relief| (relief.alone(scene), relief.placement()))).collect()
}

/// The plane of a scene, where it lies.
fn target(scene: &Scene, placement: Placement) -> Target {
    Target {
        placement,
        field_size: scene.field.size,
        plane_size_metres: scene.plane_size_metres(),
        depth_metres: f64::from(scene.plane.depth_metres),
    }
}

/// The draws of one material of a mesh; where all rays to some triangles come from one flat target, `draw` is told.
fn mesh_draws(
    mesh: &Mesh,
    triangles: Range<u32>,
    seen: &Seen<'_>,
    draw: impl Fn(Geometry, Range<u32>, Option<Target>) -> Draw,
) -> Vec<Draw> {
    let scene = seen.scene;
    let is_micro = scene.trace.technique == Technique::Mesh;
    if scene.trace.shell && !is_micro {
        return vec![draw(Geometry::Shell, triangles, None)];
    }
    let geometry = if is_micro { Geometry::Micropolygons } else { Geometry::Facets(scene.trace.displaced_depth) };
    if !mesh.is_planar {
        return vec![draw(geometry, triangles, None)];
    }
    let chart = |chart: facet::Chart| {
        let tile = Target { plane_size_metres: chart.tile_metres, ..target(scene, chart.placement) };
        draw(geometry, chart.triangles, Some(tile))
    };
    facet::charts(mesh, triangles).into_iter().map(chart).collect()
}

fn depth_buffer(gpu: &Gpu, size: [u32; 2]) -> wgpu::TextureView {
    texture(gpu, "depth", size, raster::DEPTH_FORMAT, wgpu::TextureUsages::RENDER_ATTACHMENT)
        .create_view(&wgpu::TextureViewDescriptor::default())
}

fn channel_target(gpu: &Gpu, size: [u32; 2]) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
    texture(gpu, "channels", size, CHANNEL_FORMAT, usage)
}

fn texture(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
