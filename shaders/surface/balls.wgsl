// Balls: other objects than the relief, whose shadows fall upon it and whose images it reflects ([POM] fig. 13).
//
// Specification: src/reference/balls.rs. Composed after common/view.wgsl, surface/sky.wgsl and surface/reliefs.wgsl. The balls are read where they lie: an
// index that varies would keep the whole of the private `view` in memory.

// Whether there are any. Fixed when the pipeline is built: a software adapter runs a loop's body once, whatever its condition.
override BALLS: bool = true;

// Where a ray first meets a ball's surface from outside, in units of its direction; −1 where it does not. The half chord comes from
// the closest point, not from the difference of squared distances, which would cancel far away.
fn ball_hit(ball: Ball, origin: vec3f, direction: vec3f) -> f32 {
    let per_length = inverseSqrt(dot(direction, direction));
    let unit = direction * per_length;
    let toward = ball.centre - origin;
    let along = dot(toward, unit);
    let aside = toward - along * unit;
    let half_squared = ball.radius * ball.radius - dot(aside, aside);
    let t = along - sqrt(max(half_squared, 0.0));
    return select(-1.0, t * per_length, half_squared > 0.0 && t > 0.0);
}

// Share of a directional light that the balls let through.
fn balls_visibility(position: vec3f, toward_light: vec3f) -> f32 {
    if !BALLS {
        return 1.0;
    }
    for (var i = 0u; i < view.ball_count; i++) {
        // A point within a ball, of a relief that it is sunk in, is dark.
        let from_centre = position - view_buffer.balls[i].centre;
        let inside = dot(from_centre, from_centre) < view_buffer.balls[i].radius * view_buffer.balls[i].radius;
        if inside || ball_hit(view_buffer.balls[i], position, toward_light) > 0.0 {
            return 0.0;
        }
    }
    return 1.0;
}

// Radiance of a ball at a point of its surface.
fn ball_radiance(ball: Ball, position: vec3f, toward_eye: vec3f) -> vec3f {
    let normal = (position - ball.centre) / ball.radius;
    var radiance = ball.colour * sky_mean(normal);
    for (var i = 0u; i < LIGHTS; i++) {
        let source = view_light(i);
        var arrives = 1.0;
        if source.casts_shadow == 1u {
            arrives = reliefs_visibility(position, source.toward);
        }
        let halfway = normalize(toward_eye + source.toward);
        let highlight = 1.6 * pow(max(dot(normal, halfway), 0.0), 90.0) * step(0.0, dot(normal, source.toward));
        radiance += arrives * source.radiance * (ball.colour * max(dot(normal, source.toward), 0.0) + highlight);
    }
    return radiance;
}

// What a glossy surface mirrors of the balls, by Schlick's Fresnel term for a dielectric, scaled by the strength of its highlight.
fn balls_mirrored(position: vec3f, normal: vec3f, toward_eye: vec3f, strength: f32) -> vec3f {
    if !BALLS || strength <= 0.0 {
        return vec3f(0.0);
    }
    let direction = reflect(-toward_eye, normal);
    var nearest = -1.0;
    var mirrored = vec3f(0.0);
    for (var i = 0u; i < view.ball_count; i++) {
        let t = ball_hit(view_buffer.balls[i], position, direction);
        if t > 0.0 && (nearest < 0.0 || t < nearest) {
            nearest = t;
            mirrored = ball_radiance(view_buffer.balls[i], position + t * direction, -direction);
        }
    }
    let fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(normal, toward_eye), 0.0), 5.0);
    return strength * fresnel * mirrored;
}
