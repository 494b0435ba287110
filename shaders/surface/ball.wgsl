// Ball: the balls themselves, by one ray a pixel. Needs surface/surface, surface/raster and surface/balls.
//
//   radiance  rgba16float   write
//   depth     depth32float  write

struct BallSeen {
    index: u32,
    position: vec3f,
    is_seen: bool,
}

fn ball_seen(position: vec2f) -> BallSeen {
    let direction = raster_direction(position);
    var seen = BallSeen(0u, vec3f(0.0), false);
    var nearest = 3e38;
    for (var i = 0u; i < view.ball_count; i++) {
        let t = ball_hit(view_buffer.balls[i], view.eye_world, direction);
        // The direction has unit length along the view axis: t is the distance along it.
        if t > view.near_metres && t < nearest {
            nearest = t;
            seen = BallSeen(i, view.eye_world + t * direction, true);
        }
    }
    return seen;
}

@fragment
fn ball(@builtin(position) position: vec4f) -> ColourAndDepth {
    view = view_buffer;
    let seen = ball_seen(position.xy);
    if !seen.is_seen {
        discard;
    }
    let toward_eye = normalize(view.eye_world - seen.position);
    let colour = ball_radiance(view_buffer.balls[seen.index], seen.position, toward_eye);
    return ColourAndDepth(vec4f(colour, 1.0), raster_depth(seen.position));
}

// A ball is no surface of the relief: what it hides shows none.
@fragment
fn ball_channel(@builtin(position) position: vec4f) -> ColourAndDepth {
    view = view_buffer;
    let seen = ball_seen(position.xy);
    if !seen.is_seen {
        discard;
    }
    return ColourAndDepth(channel_part(NO_CHANNEL), raster_depth(seen.position));
}
