//! A device for tests: the software adapter that every machine can have, unless wgpu's environment variables say otherwise.

use std::sync::OnceLock;

use rilievo::gpu::{Gpu, Preference, Readback, Recorder, Role, Texture, Timer};

/// The device that tests share. Without an adapter a test fails in CI (where `CI` is set), and elsewhere says loudly that it skips.
pub fn gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    GPU.get_or_init(own_gpu).as_ref()
}

/// A device for one test alone, whose clock does not run for what others submit.
pub fn own_gpu() -> Option<Gpu> {
    let preference = Preference { software_first: true, ..Preference::default() }.with_environment();
    match pollster::block_on(Gpu::new(&preference)) {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var_os("CI").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("SKIPPED, nothing on the GPU is tested: {error}");
            None
        }
    }
}

/// Records, submits and waits.
pub fn run<T>(gpu: &Gpu, record: impl FnOnce(&mut Recorder<'_>) -> T) -> T {
    let mut timer = Timer::new(gpu);
    let mut encoder = gpu.encoder("test");
    let result = record(&mut Recorder { gpu, encoder: &mut encoder, timer: &timer });
    timer.resolve(&mut encoder);
    gpu.queue.submit([encoder.finish()]);
    timer.end_frame();
    wait(gpu);
    result
}

/// The texels of a texture, row by row.
pub fn read<R: Role, T: bytemuck::Pod>(gpu: &Gpu, texture: &Texture<R>) -> Vec<T> {
    let mut encoder = gpu.encoder("test readback");
    let readback = Readback::record_texture(gpu, &mut encoder, &texture.texture, 0);
    gpu.queue.submit([encoder.finish()]);
    readback.start();
    bytemuck::pod_collect_to_vec(&wait_for(gpu, &readback))
}

fn wait(gpu: &Gpu) {
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("waiting without a limit does not time out");
    assert_eq!(gpu.take_error(), None);
}

/// The bytes of a readback that was started.
pub fn wait_for(gpu: &Gpu, readback: &Readback) -> Vec<u8> {
    rilievo::modes::wait_for(gpu, readback).expect("the device is there")
}
