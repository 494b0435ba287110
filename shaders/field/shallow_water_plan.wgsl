// Shallow water: how long the next substep is, decided on the GPU by one invocation.
//
//   control   read-write   see common/shallow_water.wgsl
//   grids     write        workgroups of the two dispatches that may follow, from state 0 and from state 1: one of them is empty, and
//                          both are where nothing remains to be done
//
// Composed after common/shallow_water.wgsl.

struct ShallowWaterSpell {
    seconds: f32,              // the step that is owed
    swell_metres: f32,         // amplitude of the swell beyond a sea border
    swell_phase: f32,          // radians, at the step's start
    swell_rate: f32,           // radians a second
}

@group(1) @binding(0) var<storage, read> params: ShallowWaterParams;
@group(1) @binding(1) var<storage, read_write> control: ShallowWaterControl;
@group(1) @binding(2) var<storage, read_write> grids: array<vec3u, 2>;
@group(1) @binding(3) var<storage, read> spell: ShallowWaterSpell;

// Judges the substep that was begun: a result with a number that is none is dropped, and nothing moves any more.
fn judge() {
    if control.pending == 1u {
        if atomicLoad(&control.fault) == 0u {
            control.current = 1u - control.current;
            control.substeps += 1u;
        } else {
            control.halted = 1u;
        }
        control.pending = 0u;
    }
}

// Before a step's first substep.
@compute @workgroup_size(1)
fn shallow_water_begin() {
    control.remaining = spell.seconds;
}

// Before each substep: the longest that is stable, and as many equal ones as that makes of what remains.
@compute @workgroup_size(1)
fn shallow_water_plan() {
    judge();
    if control.halted == 1u || control.remaining <= 0.0 {
        grids[0] = vec3u(0u);
        grids[1] = vec3u(0u);
        return;
    }
    let speed = bitcast<f32>(atomicLoad(&control.speed));
    let longest = params.courant * params.texel_metres / max(speed, 1e-9);
    let count = max(ceil(control.remaining / longest), 1.0);
    let dt = control.remaining / count;
    let elapsed = spell.seconds - control.remaining;
    control.remaining = select(control.remaining - dt, 0.0, count == 1.0);
    control.dt = dt;
    control.rise = spell.swell_metres * sin(spell.swell_phase + spell.swell_rate * (elapsed + 0.5 * dt));
    control.pending = 1u;
    atomicStore(&control.speed, 0u);
    // A tile is longer along the substep's first direction.
    let short = SHALLOW_WATER_SPAN - 2u * SHALLOW_WATER_HALO;
    let turned = (control.substeps & 1u) == 1u;
    let tile = select(vec2u(SHALLOW_WATER_SPAN, short), vec2u(short, SHALLOW_WATER_SPAN), turned);
    let grid = vec3u((params.size + tile - 1u) / tile, 1u);
    grids[0] = select(vec3u(0u), grid, control.current == 0u);
    grids[1] = select(vec3u(0u), grid, control.current == 1u);
}

// After a step's last substep: what remains is given up.
@compute @workgroup_size(1)
fn shallow_water_settle() {
    judge();
    if control.halted == 0u {
        control.behind += control.remaining;
    }
    control.remaining = 0.0;
}
