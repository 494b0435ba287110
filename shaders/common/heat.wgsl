// Heat: a colour for a number between 0 and 1: black, violet, orange, pale yellow, ever brighter.

fn heat(value: f32) -> vec3f {
    let x = clamp(value, 0.0, 1.0);
    return vec3f(
        smoothstep(0.05, 0.62, x),
        0.9 * smoothstep(0.38, 1.0, x),
        0.45 * smoothstep(0.0, 0.28, x) * (1.0 - smoothstep(0.34, 0.66, x)) + 0.62 * smoothstep(0.72, 1.0, x),
    );
}
