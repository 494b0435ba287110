//! Stage: what the camera sees beside and instead of the bare plane: a mesh that carries the relief, flat or as a shell, and balls, with
//! a depth buffer.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::Range;

use super::micropolygon::{Micropolygons, Plan};
use super::raster::{self, CHANNEL_FORMAT, CHANNEL_PARTS, Geometry, MeshBuffers, Output};
use super::ray_map::Target;
use super::shell;
use super::{Choice, Display, Shows, Technique, View, ViewSet, bind_field, facet, field_layout, view};
use crate::camera::Camera;
use crate::field::Field;
use crate::gpu::{BindingLayout, Gpu, Readback, Recorder, ShaderError};
use crate::mesh::Mesh;
use crate::scene::Scene;

/// What is drawn, and with what.
pub struct Stage {
    view_layout: BindingLayout,
    field_layout: BindingLayout,
    mesh_layout: BindingLayout,
    field_group: wgpu::BindGroup,
    /// Built when they are first needed.
    pipelines: RefCell<HashMap<(Choice, Geometry, Output), wgpu::RenderPipeline>>,
    mesh: Option<Body>,
    micropolygons: Option<Micropolygons>,
    /// The bindings of an empty mesh, for what has none.
    no_mesh: MeshBuffers,
    /// One for each draw at most, on each side of a divider.
    views: [Vec<ViewSet>; 2],
    depth: wgpu::TextureView,
    size: [u32; 2],
}

/// A mesh and its buffers.
struct Body {
    mesh: Mesh,
    buffers: MeshBuffers,
}

/// One draw: what, which triangles, seen through which view.
struct Draw {
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
        !scene.balls.is_empty() || is_rasterised
    }

    /// Makes one for pictures of `size` traced pixels; `mesh` is the scene's, or the plane where its shell is drawn.
    pub fn new(gpu: &Gpu, field: &Field, mesh: Option<Mesh>, size: [u32; 2]) -> Self {
        let (view_layout, field_layout, mesh_layout) = (view::layout(gpu), field_layout(gpu), raster::mesh_layout(gpu));
        let field_group = bind_field(gpu, &field_layout, field);
        let no_mesh = MeshBuffers::new(gpu, &mesh_layout, &[], &[], false);
        let mut stage = Self {
            view_layout,
            field_layout,
            mesh_layout,
            field_group,
            pipelines: RefCell::default(),
            mesh: None,
            micropolygons: None,
            no_mesh,
            views: Default::default(),
            depth: depth_buffer(gpu, size),
            size,
        };
        stage.set_mesh(gpu, mesh);
        stage
    }

    /// Puts another mesh on it.
    pub fn set_mesh(&mut self, gpu: &Gpu, mesh: Option<Mesh>) {
        if self.mesh.as_ref().map(|body| &body.mesh) == mesh.as_ref() {
            return;
        }
        self.micropolygons = None;
        self.mesh = mesh.map(|mesh| {
            let can_be_shell = mesh.triangle_count() <= shell::TRIANGLES_MAX;
            let buffers = MeshBuffers::new(gpu, &self.mesh_layout, &mesh.vertices, &mesh.indices, can_be_shell);
            Body { mesh, buffers }
        });
    }

    /// Takes another size, of traced pixels.
    pub fn resize(&mut self, gpu: &Gpu, size: [u32; 2]) {
        (self.depth, self.size) = (depth_buffer(gpu, size), size);
    }

    /// Gives back the memory of micropolygons.
    pub fn forget_micropolygons(&mut self) {
        self.micropolygons = None;
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
    pub fn prepare(&mut self, gpu: &Gpu, field: &Field, scene: &Scene, shows: Shows, side: usize) -> Result<(), ShaderError> {
        self.prepare_micropolygons(gpu, scene);
        // What is drawn does not depend on the camera.
        let camera = &Camera::at(&scene.camera, 0.0);
        let draws = self.draws(&Seen { scene, camera, time_seconds: 0.0, display: shows.into() }, self.size);
        for draw in &draws {
            self.build(gpu, draw.choice, draw.geometry, Output::Radiance)?;
        }
        while self.views[side].len() < draws.len() {
            self.views[side].push(ViewSet::new(gpu, &self.view_layout, field.addressing));
        }
        Ok(())
    }

    /// Makes the micropolygons that a scene asks for, unless they are there.
    fn prepare_micropolygons(&mut self, gpu: &Gpu, scene: &Scene) {
        let plane = || (scene.plane_size_metres().map(|metres| metres as f32), scene.field.addressing);
        let plan = Plan { triangles: scene.trace.mesh_triangles, bare_plane: self.mesh.is_none().then(plane) };
        let is_asked = scene.trace.technique == Technique::Mesh;
        if is_asked && self.micropolygons.as_ref().is_none_or(|there| there.plan() != plan) {
            let mesh = self.mesh.as_ref().map(|body| (body.mesh.vertices.as_slice(), body.mesh.indices.as_slice()));
            self.micropolygons = Some(Micropolygons::new(gpu, plan, mesh.unwrap_or_default()));
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
        let choice = Choice::of(scene).showing(display.shows);
        let view = View::new(scene, camera, time_seconds, image_size, display);
        let beside = Choice::beside(scene);
        let mut draws = vec![Draw { geometry: Geometry::Backdrop, choice: beside, triangles: 0..1, view }];
        match &self.mesh {
            None if choice.technique == Technique::Mesh => {
                draws.push(Draw { geometry: Geometry::Micropolygons, choice, triangles: 0..2, view: View { planar: 2, ..view } });
            }
            None => draws.push(Draw { geometry: Geometry::Plane, choice, triangles: 0..1, view }),
            Some(body) => {
                let parts = body.mesh.parts.iter();
                draws.extend(parts.flat_map(|part| {
                    let settings = scene.mesh.as_ref().and_then(|mesh| mesh.materials.iter().find(|m| m.name == part.material));
                    let mut view = view;
                    if let Some(settings) = settings {
                        view.depth_metres = settings.depth_metres.unwrap_or(view.depth_metres);
                        if let Some([fewest, most]) = settings.samples {
                            (view.pom_samples_min, view.pom_samples_max) = (fewest as f32, most as f32);
                        }
                    }
                    let mut draws = mesh_draws(&body.mesh, part.triangles.clone(), view, seen, choice);
                    if choice.technique == Technique::Mesh {
                        draws.push(Draw { geometry: Geometry::Walls, choice, triangles: part.triangles.clone(), view });
                    }
                    draws
                }));
            }
        }
        if !scene.balls.is_empty() {
            draws.push(Draw { geometry: Geometry::Balls, choice: beside, triangles: 0..1, view });
        }
        draws
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
        for (draw, set) in draws.iter().zip(&self.views[side]) {
            set.uniform.write(recorder.gpu, &draw.view);
        }
        self.pose(recorder.gpu, seen.time_seconds);
        recorder.render_onto(name, radiance, Some(&self.depth), columns.start > 0, |pass| {
            pass.set_scissor_rect(columns.start, 0, columns.end - columns.start, self.size[1]);
            self.draw(pass, &draws, &self.views[side], Output::Radiance);
        });
    }

    /// Moves an animated mesh to where it is at a time.
    fn pose(&self, gpu: &Gpu, time_seconds: f64) {
        if let Some(Body { mesh, buffers }) = &self.mesh
            && mesh.skin.is_some()
        {
            let vertices = mesh.posed(time_seconds);
            buffers.pose(gpu, &vertices, &mesh.indices);
            if let Some(micropolygons) = &self.micropolygons {
                micropolygons.pose(gpu, (&vertices, &mesh.indices));
            }
        }
    }

    fn draw(&self, pass: &mut wgpu::RenderPass<'_>, draws: &[Draw], views: &[ViewSet], output: Output) {
        let pipelines = self.pipelines.borrow();
        for (draw, view) in draws.iter().zip(views) {
            let Some(pipeline) = pipelines.get(&(draw.choice, draw.geometry, output)) else { continue };
            let buffers = self.mesh.as_ref().map_or(&self.no_mesh, |body| &body.buffers);
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &view.group, &[]);
            pass.set_bind_group(1, &self.field_group, &[]);
            pass.set_bind_group(2, &buffers.group, &[]);
            let Range { start, end } = draw.triangles;
            match draw.geometry {
                Geometry::Backdrop | Geometry::Plane | Geometry::Balls => pass.draw(0..3, 0..1),
                Geometry::Facets(_) => {
                    pass.set_index_buffer(buffers.indices(), wgpu::IndexFormat::Uint32);
                    pass.draw_indexed(3 * start..3 * end, 0, 0..1);
                }
                Geometry::Micropolygons => {
                    // The plane alone goes on beyond its border: over the tiles around it, where the field wraps.
                    let instances = if draw.view.planar == 2 && draw.view.wrap == 1 { 9 } else { 1 };
                    if let Some(micropolygons) = &self.micropolygons {
                        micropolygons.draw(pass, &micropolygons.of(&draw.triangles), instances);
                    }
                }
                Geometry::Walls => {
                    if let Some(micropolygons) = &self.micropolygons {
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
    pub fn request_channels(
        &self,
        gpu: &Gpu,
        field: &Field,
        seen: &Seen<'_>,
        size: [u32; 2],
    ) -> Result<Vec<Readback>, ShaderError> {
        let draws: Vec<_> = self.draws(seen, size).into_iter().filter(|draw| draw.geometry != Geometry::Backdrop).collect();
        let views: Vec<_> = draws.iter().map(|_| ViewSet::new(gpu, &self.view_layout, field.addressing)).collect();
        for (draw, set) in draws.iter().zip(&views) {
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
        let micropolygons = self.micropolygons.as_ref().map_or(0, Micropolygons::memory_bytes);
        self.mesh.as_ref().map_or(0, |body| body.buffers.memory_bytes()) + micropolygons + 4 * width * height
    }
}

/// The draws of one material of a mesh.
fn mesh_draws(mesh: &Mesh, triangles: Range<u32>, view: View, seen: &Seen<'_>, choice: Choice) -> Vec<Draw> {
    let scene = seen.scene;
    let is_micro = choice.technique == Technique::Mesh;
    if scene.trace.shell && !is_micro {
        return vec![Draw { geometry: Geometry::Shell, choice, triangles, view }];
    }
    let geometry = if is_micro { Geometry::Micropolygons } else { Geometry::Facets(scene.trace.displaced_depth) };
    if !mesh.is_planar {
        return vec![Draw { geometry, choice, triangles, view }];
    }
    let draw = |chart: facet::Chart| {
        let target = Target {
            placement: chart.placement,
            field_size: scene.field.size,
            plane_size_metres: chart.tile_metres,
            depth_metres: f64::from(view.depth_metres),
        };
        Draw { geometry, choice, triangles: chart.triangles, view: View { planar: 1, ..view.over(seen.camera, &target) } }
    };
    facet::charts(mesh, triangles).into_iter().map(draw).collect()
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
