// Shallow water, what passes between the cells of a line: the fluxes through its faces, and the midpoint rule that a walk along it makes
// of them, three cells behind the one that comes.
//
// The midpoint rule: a first-order half step, then minmod slopes of what it gives. HLLC fluxes [Toro] of hydrostatically reconstructed
// states [Audusse]: a lake at rest stays so to the bit. The half step of MUSCL-Hancock, from limited slopes alone, costs half as much,
// and lost: over a bed of white noise the slopes are 0, what remains is Euler's rule, and ripples of 1e-7 grew to a tenth of the depth
// in 500 substeps. So did steeper limiters. These stay as small as they were.
//
// Specification: src/reference/shallow_water.rs. Composed after common/shallow_water.wgsl, into field/shallow_water, whose copy of the
// parameters it reads.

// One side of a face: the state there, its surface, and half of the pull of the cell's own bed.
struct ShallowWaterSide {
    state: vec4f,              // depth, velocity along and across the line, foam
    surface: f32,
    pull: f32,
}

// What passes a face, and what presses on the cells before and behind it.
struct ShallowWaterFace {
    mass: f32,
    pressed: vec2f,
    across: f32,
    foam: f32,
}

fn minmod(before: vec4f, after: vec4f) -> vec4f {
    return max(vec4f(0.0), min(before, after)) + min(vec4f(0.0), max(before, after));
}

// How fast the fastest wave of a face is, and what passes it.
struct ShallowWaterPassed {
    face: ShallowWaterFace,
    speed: f32,
}

fn pass_between(before: ShallowWaterSide, behind: ShallowWaterSide, stock: vec2f, drift: vec2f, closed: bool,
    ratio: f32) -> ShallowWaterPassed {
    let left = before.state;
    let right = behind.state;
    let g = params.gravity;
    let sill = max(before.surface - left.x, behind.surface - right.x);
    let hl = max(before.surface - sill, 0.0);
    let hr = max(behind.surface - sill, 0.0);
    let ul = left.y;
    let ur = right.y;
    let cl = sqrt(g * hl);
    let cr = sqrt(g * hr);
    // Two rarefactions bound the waves, and the exact speeds of a front where a side is dry ([Toro] §10.5.1, 10.8); waves beside a sill
    // are those of the water beside it, not those of the little that is above.
    let middle = 0.5 * (ul + ur) + cl - cr;
    let celerity = max(0.5 * (cl + cr) + 0.25 * (ul - ur), 0.0);
    var lowest = min(ul - sqrt(g * left.x), middle - celerity);
    var highest = max(ur + sqrt(g * right.x), middle + celerity);
    if hl <= 0.0 {
        lowest = ur - 2.0 * cr;
        highest = ur + cr;
    } else if hr <= 0.0 {
        lowest = ul - cl;
        highest = ul + 2.0 * cl;
    }
    let speed = select(0.0, max(abs(lowest), abs(highest)), hl + hr > 0.0);
    lowest = min(lowest, 0.0);
    highest = max(highest, 0.0);
    // Written from the left state on: what presses on a side is then exactly 0 in a lake at rest.
    let share = select(0.0, lowest / max(highest - lowest, 1e-30), highest > lowest);
    let ml = hl * ul;
    let mr = hr * ur;
    let mass = ml + share * ((ml - mr) + highest * (hr - hl));
    let pressure = 0.5 * g * (hl - hr) * (hl + hr);
    let carried = ml * ul + share * ((ml * ul - mr * ur + pressure) + highest * (mr - ml));
    // No face takes more than its share of what there is: the shares of a cell's two faces are 1 together.
    let shares = 0.5 + 0.5 * clamp(vec2f(drift.x, -drift.y) * ratio, vec2f(-1.0), vec2f(1.0));
    let most = shares * stock / ratio;
    let allowed = select(clamp(mass, -most.y, most.x), 0.0, closed);
    let scale = select(allowed / mass, 1.0, closed || mass == allowed);
    let upwind = select(right.zw, left.zw, allowed >= 0.0);
    let pressed = scale * carried + (1.0 - scale) * select(0.0, -pressure, mass < 0.0);
    let pressed_on = vec2f(pressed + before.pull, pressed + pressure - behind.pull);
    return ShallowWaterPassed(ShallowWaterFace(allowed, pressed_on, allowed * upwind.x, allowed * upwind.y), speed);
}

// A cell after what passed its two faces; its foam keeps to the water that carries it.
struct ShallowWaterMoved {
    cell: vec4f,
    is_number: bool,
}

fn moved(cell: vec4f, before: ShallowWaterFace, behind: ShallowWaterFace, ratio: f32) -> ShallowWaterMoved {
    let depth = cell.x - ratio * (behind.mass - before.mass);
    let flow = cell.x * cell.yz - ratio * vec2f(behind.pressed.x - before.pressed.y, behind.across - before.across);
    let foam = cell.x * cell.w - ratio * (behind.foam - before.foam);
    let is_number = shallow_water_is_number(depth) && shallow_water_is_number(flow.x + flow.y) && shallow_water_is_number(foam);
    let kept = max(depth, 0.0);
    let velocity = shallow_water_velocity(flow, kept, params.dry_metres, params.speed_cap);
    let share = select(cell.w, saturate(foam / max(kept, params.dry_metres)), kept > params.dry_metres);
    return ShallowWaterMoved(vec4f(kept, velocity, share), is_number);
}

// A cell of a line before its sweep.
struct ShallowWaterCell {
    state: vec4f,              // depth, velocity along and across the line, foam
    bed_metres: f32,
}

// What a walk along a line remembers: of the cells one, two and three before the one that comes next. A line begins beside dry ground
// at height 0: a state like any other, whose traces do not reach the texels behind the halo.
struct ShallowWaterWalk {
    one: ShallowWaterCell,
    two: ShallowWaterCell,
    three: ShallowWaterCell,
    passed_first: ShallowWaterFace,    // before cell one, in first order
    ahead_two: vec4f,                  // half a step on
    ahead_three: vec4f,
    behind_three: ShallowWaterSide,    // that end of cell three
    passed: ShallowWaterFace,          // before cell three
}

// What became of the cell three before the one that came.
struct ShallowWaterSwept {
    before: vec4f,
    after: vec4f,
    is_number: bool,
    speed: f32,                // of the fastest wave at its farther face
}

// Goes on to the next cell: the midpoint rule of three cells at once, each as far as what lies before it allows. `closed` says of the
// faces before that cell, and before the second before it, whether nothing passes.
fn walk_on(walk: ptr<function, ShallowWaterWalk>, cell: ShallowWaterCell, closed: vec2<bool>, ratio: f32) -> ShallowWaterSwept {
    let one = (*walk).one;
    let two = (*walk).two;
    let three = (*walk).three;
    // Half a step of cell one, in first order.
    let near = ShallowWaterSide(one.state, one.state.x + one.bed_metres, 0.0);
    let far = ShallowWaterSide(cell.state, cell.state.x + cell.bed_metres, 0.0);
    let first = pass_between(near, far, vec2f(one.state.x, cell.state.x), vec2f(one.state.y, cell.state.y), closed.x, 0.5 * ratio);
    let ahead = moved(one.state, (*walk).passed_first, first.face, 0.5 * ratio);
    // The ends of cell two, from the slopes of what that gave.
    let ahead_two = (*walk).ahead_two;
    let ahead_three = (*walk).ahead_three;
    let slope = minmod(ahead_two - ahead_three, ahead.cell - ahead_two);
    let surface = ahead_two.x + two.bed_metres;
    let rises = vec2f(surface - (ahead_three.x + three.bed_metres), (ahead.cell.x + one.bed_metres) - surface);
    let half_rise = 0.5 * (max(0.0, min(rises.x, rises.y)) + min(0.0, max(rises.x, rises.y)));
    let depth_ends = vec2f(ahead_two.x - 0.5 * slope.x, ahead_two.x + 0.5 * slope.x);
    let lacks = max(-depth_ends, vec2f(0.0));
    let surfaces = vec2f(surface - half_rise, surface + half_rise) + lacks;
    let pull = 0.25 * params.gravity * (depth_ends.x + lacks.x + depth_ends.y + lacks.y) * (surfaces.y - surfaces.x);
    let low = vec4f(max(depth_ends.x, 0.0), ahead_two.yzw - 0.5 * slope.yzw);
    let high = vec4f(max(depth_ends.y, 0.0), ahead_two.yzw + 0.5 * slope.yzw);
    // What passes between cells three and two, in second order, and with it cell three's whole step.
    let stock = vec2f(three.state.x, two.state.x);
    let drift = vec2f(ahead_three.y, ahead_two.y);
    let second = pass_between((*walk).behind_three, ShallowWaterSide(low, surfaces.x, pull), stock, drift, closed.y, ratio);
    let result = moved(three.state, (*walk).passed, second.face, ratio);
    *walk = ShallowWaterWalk(cell, one, two, first.face, ahead.cell, ahead_two, ShallowWaterSide(high, surfaces.y, pull), second.face);
    return ShallowWaterSwept(three.state, result.cell, ahead.is_number && result.is_number, second.speed);
}
