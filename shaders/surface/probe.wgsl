// Probe: the trace and the shadow for rays that are listed, not seen: tests, and the pointer of a mouse.
//
//   rays  storage, 40 bytes a ray  read
//   hits  storage, 24 bytes a ray  write
//   seen  storage,  4 bytes a ray  write  visibility of a shadow ray

override WORKGROUP: u32;

@group(2) @binding(0) var<storage, read> rays: array<Ray>;
@group(2) @binding(1) var<storage, read_write> hits: array<Hit>;
@group(2) @binding(2) var<storage, read_write> seen: array<f32>;

// A dispatch has at most 65,535 workgroups an axis: long lists fold into rows.
fn probe_index(id: vec3u, groups: vec3u) -> u32 {
    return id.y * groups.x * WORKGROUP + id.x;
}

@compute @workgroup_size(WORKGROUP)
fn probe_trace(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    view = view_buffer;
    frame = plane_frame();
    let index = probe_index(id, groups);
    if index < arrayLength(&rays) {
        hits[index] = trace(rays[index]);
    }
}

@compute @workgroup_size(WORKGROUP)
fn probe_shadow(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    view = view_buffer;
    frame = plane_frame();
    let index = probe_index(id, groups);
    if index < arrayLength(&rays) {
        seen[index] = shadow(rays[index]);
    }
}
