// Bronze: a cast that has hung outdoors: a dark brown skin, green where water stands, and what stands out rubbed bright.

const BRONZE_METAL = vec3f(0.98, 0.69, 0.33);

// What a mirror of this metal sees: a bright horizon under a dimmer zenith, the earth below.
fn bronze_surroundings(direction: vec3f) -> vec3f {
    let horizon = exp(-5.0 * abs(direction.y - 0.08));
    let above = mix(1.15 * view.sky, 0.55 * view.sky, clamp(direction.y, 0.0, 1.0)) + 0.55 * view.sky * horizon;
    return mix(view.ground, above, smoothstep(-0.12, 0.10, direction.y));
}

fn matter_at(point: SurfacePoint) -> Matter {
    let stamped = stamped_matter(point.lattice);
    let metres = plane_metres(point.lattice);
    let grain = noise_over(metres, 130.0, 81u);
    let weather = noise_over(metres, 7.0, 85u);
    let level = smoothstep(0.55, 0.98, point.level);
    // Rubbed: the faces that stand out, and what a shot laid bare; rough edges of it keep some skin.
    let rubbed = max(smoothstep(0.72, 0.95, point.height + 0.10 * (grain - 0.5)) * mix(0.45, 1.0, level), stamped.g);
    let green = smoothstep(0.50, 0.95, weather + 0.35 * (0.5 - point.height) + 0.25 * (grain - 0.5)) * (1.0 - rubbed);
    let skin = mix(vec3f(0.085, 0.052, 0.030), vec3f(0.060, 0.095, 0.078), green) * mix(0.75, 1.25, grain);

    let normal = point.normal_world;
    let reflected = reflect(-point.toward_eye, normal);
    let halfway = normalize(point.toward_eye + view.light_world);
    let facing = max(dot(normal, view.light_world), 0.0) * point.visibility;
    let lobe = max(dot(normal, halfway), 0.0);
    // A tight lobe and a wide one: brushed metal.
    let shine = 2.2 * pow(lobe, 90.0) + 0.55 * pow(lobe, 10.0);
    let soot = 1.0 - stamped.r;
    let polish = mix(0.10, 0.85, rubbed) * soot;
    let glow = BRONZE_METAL * view.tint * polish * (bronze_surroundings(reflected) * mix(0.45, 1.0, level) + view.light_radiance * facing * shine);
    var matter = sooty(mix(skin, 0.30 * BRONZE_METAL, rubbed), stamped.r);
    matter.specular *= 0.25 * (1.0 - rubbed);
    matter.glow = glow;
    return matter;
}
