// Views: the picture, or one of the numbers behind it, as a colour. What a number means stands in src/surface/choice.rs.
//
// Composed after surface/shade and a truth.

// What the picture shows.
const SHOW_PICTURE: u32 = 0u;
const SHOW_HEIGHT: u32 = 1u;
const SHOW_NORMAL: u32 = 2u;
const SHOW_VISIBILITY: u32 = 3u;
const SHOW_STEPS: u32 = 4u;
const SHOW_UVOFFSET: u32 = 5u;
const SHOW_LEVEL: u32 = 6u;
const SHOW_ERROR: u32 = 7u;
const SHOW_LEVELCAP: u32 = 8u;
const SHOW_MIPLEVEL: u32 = 16u;
const SHOW_LODTINT: u32 = 17u;

// What the brightest heat stands for.
const VIEWS_STEPS: u32 = 64u;
const VIEWS_LEVELS: u32 = 12u;

// [POM] fig. 12: no blue is the full effect, the deepest is normal mapping alone.
fn views_tint(radiance: vec3f) -> vec3f {
    let coarser = saturate(footprint.level / max(view.detail.threshold - 1.0, 1.0));
    let blue = mix(0.35 * coarser, 1.0, footprint.flattened);
    return mix(radiance, vec3f(0.08, 0.16, 1.0) * (0.12 + dot(radiance, vec3f(0.2126, 0.7152, 0.0722))), 0.85 * blue);
}

// Whether anything but the picture may be shown. Fixed when the pipeline is built: a software adapter would work out every view.
override VIEWS: bool = true;

// The radiance of the picture or of the view that was chosen instead.
fn shown(shaded: Shaded) -> vec3f {
    // A ray that gave up is never silently a hit.
    if shaded.hit.status == CAPPED {
        return vec3f(4.0, 0.0, 4.0);
    }
    if !VIEWS {
        return shaded.radiance;
    }
    switch view.shows {
        case SHOW_HEIGHT: { return vec3f(shaded.height); }
        case SHOW_NORMAL: {
            // As a normal map has it: u to the right, v down.
            let along = vec3f(dot(shaded.normal_world, normalize(frame.along_u)), dot(shaded.normal_world, normalize(frame.along_v)), 0.0);
            return vec3f(along.x, -along.y, dot(shaded.normal_world, frame_normal(shaded.hit.lattice))) * 0.5 + 0.5;
        }
        case SHOW_VISIBILITY: { return vec3f(shaded.visibility); }
        case SHOW_STEPS: { return heat(f32(shaded.hit.steps) / f32(VIEWS_STEPS)); }
        case SHOW_UVOFFSET: {
            let cells = (shaded.hit.lattice - ray_at(shaded.ray, 0.0)) * vec2f(1.0, -1.0);
            let depths = cells * view.texel_metres / view.depth_metres;
            return vec3f(0.5 + 0.5 * depths / (1.0 + abs(depths)), 0.5);
        }
        case SHOW_LEVEL: { return heat(f32(hit_level) / f32(VIEWS_LEVELS)); }
        case SHOW_ERROR: { return heat(truth_error(shaded.ray, shaded.hit) * view.gain); }
        case SHOW_MIPLEVEL: { return heat(footprint.level / f32(VIEWS_LEVELS)); }
        case SHOW_LODTINT: { return views_tint(shaded.radiance); }
        default: { return shaded.radiance; }
    }
}
