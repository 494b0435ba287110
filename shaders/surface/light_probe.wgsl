// Light probe: the light model, and the sky, for surfaces and directions that are listed, not seen: tests.
//
//   lit       storage, 112 bytes an item  read
//   radiance  storage,  16 bytes an item  write  xyz

struct Lit {
    matter: Matter,
    normal: vec3f,
    toward_eye: vec3f,
    toward_light: vec3f,
}

override WORKGROUP: u32;

@group(2) @binding(0) var<storage, read> lit: array<Lit>;
@group(2) @binding(1) var<storage, read_write> radiance: array<vec4f>;

@compute @workgroup_size(WORKGROUP)
fn probe_light(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&lit) {
        let item = lit[id.x];
        radiance[id.x] = vec4f(light(item.matter, item.normal, item.toward_eye, item.toward_light), 0.0);
    }
}

// The sky toward the light.
@compute @workgroup_size(WORKGROUP)
fn probe_sky(@builtin(global_invocation_id) id: vec3u) {
    view = view_buffer;
    if id.x < arrayLength(&lit) {
        let item = lit[id.x];
        radiance[id.x] = vec4f(sky_blurred(item.toward_light, item.matter.roughness), 0.0);
    }
}
