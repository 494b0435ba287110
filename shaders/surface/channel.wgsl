// What a pixel shows, as exact numbers. Composed after surface/shade.wgsl.

struct Channel {
    position: vec3f,  // world, on the ray
    steps: f32,       // −1 where the pixel shows no surface, −1 − n where its ray gave up after n
    normal: vec3f,    // world, as shaded
    height: f32,      // of the field there
    uv: vec2f,        // not wrapped
    visibility: f32,
    lod: f32,
}

const NO_CHANNEL = Channel(vec3f(0.0), -1.0, vec3f(0.0), 0.0, vec2f(0.0), 0.0, 0.0);

fn channel_of(shaded: Shaded) -> Channel {
    if shaded.hit.status == CAPPED {
        // It found no surface, and says how long it looked.
        return Channel(vec3f(0.0), -1.0 - f32(shaded.hit.steps), vec3f(0.0), 0.0, vec2f(0.0), 0.0, 0.0);
    }
    return Channel(
        world_of(shaded.hit.lattice, shaded.hit.height),
        f32(shaded.hit.steps),
        shaded.normal_world,
        shaded.height,
        uv_of(shaded.hit.lattice),
        shaded.visibility,
        select(0.0, footprint.level, view.detail.traces == 1u),
    );
}

// A render pass may write 32 bytes a pixel by WebGPU's default limits, and a channel has 48: three passes write a part each.
override CHANNEL_PART: u32 = 0u;

fn channel_part(channel: Channel) -> vec4f {
    switch CHANNEL_PART {
        case 0u: { return vec4f(channel.position, channel.steps); }
        case 1u: { return vec4f(channel.normal, channel.height); }
        default: { return vec4f(channel.uv, channel.visibility, channel.lod); }
    }
}
