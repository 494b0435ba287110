//! Every tolerance of the tests, once, with its reason.

/// f32 rounds to nearest: half of this, relative.
pub const ULP: f64 = f32::EPSILON as f64;

/// A wave against its f64 reference, in units of its amplitude: some 20 roundings a step, independent, add up to under
/// √(20·100)·2⁻²⁵ ≈ 1.4e-6 over the 100 steps of the test. Twice that.
pub const WAVE_STEPS: f64 = 3e-6;

/// The discrete dispersion relation over 500 steps: the project's bar. An f32 emulation stays within a tenth.
pub const WAVE_DISPERSION: f64 = 1e-4;

/// A glow e^−x, x at most 9, against its f64 reference: WGSL allows its exponential 3 + 2·x and the quotient before it 2.5 units in the
/// last place, 44 in all.
pub const GLOW: f64 = 44.0 * ULP;

/// Relative drift of the energy of an undamped wave over 500 steps: the project's bar.
pub const WAVE_ENERGY: f64 = 1e-5;

/// Relative rise of the energy of a damped wave from step to step: the f32 rounding of u and u⁻, whose difference the energy holds.
pub const WAVE_ENERGY_RISE: f64 = 1e-6;

/// Drift of the mean of a damped wave over 10,000 steps and 1,000 impulses, in amplitudes: the project's bar.
pub const WAVE_MEAN_DAMPED: f64 = 1e-5;

/// The same undamped, where the mean's velocity is a random walk that nothing holds back: the project's bar.
pub const WAVE_MEAN_UNDAMPED: f64 = 1e-4;

/// Cells by which a front may be early or late after 300: the lattice's own dispersion, the project's bar.
pub const WAVE_FRONT_CELLS: f64 = 2.0;

/// Energy that comes back from the sponge at normal incidence: the project's bar.
pub const SPONGE_ENERGY: f64 = 0.01;

/// Net of an impulse over its free texels, in units of its strength and for each texel: the rounding of one f32 sum.
pub const IMPULSE_NET: f64 = 1e-7;

/// One kernel of the gas against its f64 reference, of values about 1: positions within a cell carry a few roundings of numbers below
/// 8 (5e-7 each), which count by the slope of what is sampled, at most 2 a cell; three times that.
pub const GAS_KERNEL: f64 = 1e-5;

/// Five whole steps of it: each step's rounding goes on in the next, and limiters may decide otherwise where two values are as good as
/// equal.
pub const GAS_STEPS: f64 = 1e-4;

/// Divergence that three V-cycles leave, of what there was, root of the mean square: the project's bar.
pub const GAS_DIVERGENCE: f64 = 1e-3;

/// Values beyond the bounds of what is carried, of 1: the limiter's extrema are values that exist, so none at all.
pub const GAS_BOUNDS: f64 = 0.0;

/// What puffs add to the sum of all cells, relative: the project's bar.
pub const GAS_EMITTED: f64 = 1e-3;

/// Kinetic energy of the Taylor–Green vortex at 128² after a second, relative to e^(−4νt): the project's bar.
pub const GAS_DECAY: f64 = 0.03;

/// Relative rise of its energy from step to step: the rounding of the sum of squares, half an ulp of f32 of each velocity. The decay
/// is a thousand times faster.
pub const GAS_ENERGY_RISE: f64 = 1e-7;

/// How far a flow whose still tiles are skipped may be from one that skips none, m/s where the fastest has 1 and stillness is 1e-4:
/// what a tile loses that is put to rest, and what its pressure would have done to it.
pub const GAS_SKIPPING: f64 = 2e-3;

/// What is shown of the gas in a half: 11 bits, of numbers up to 4.
pub const GAS_COVER: f64 = 4.0 / 2048.0;

/// What a projected component may have, of the limit that forces keep: the projection turns others into it, and the leading velocity
/// is half again as far.
pub const GAS_SPEED: f64 = 2.0;

/// A stamp against its f64 reference, in units of the largest height in play: some ten operations at 2⁻²⁴, and one division that
/// WGSL allows 2.5 ulp. "A few ulp."
pub const STAMP_HEIGHT: f64 = 8.0 * ULP;

/// The same for many stamps on top of one another, for each of them.
pub const STAMP_HEIGHT_EACH: f64 = 2.0 * ULP;

/// Soot, bareness, gloss and heat are whole levels: one where the reference meets a half and f32 decides otherwise, which the tests
/// hold to be rare.
pub const STAMP_MATERIAL: f64 = 1.0;

/// A piece of a chain against a single sweep, in heights: the rounding of two profiles and their difference, some ten operations at
/// 2⁻²⁴ of a height of 0.5, and of where the piece begins, 2⁻²⁴ · 128 texels at a slope of a tenth.
pub const STAMP_CHAIN_EACH: f64 = 1.5e-6;

/// What the same stamps may cost more on a field of four times the texels: on the smaller one a few more share a tile.
pub const STAMP_COST_GROWTH: f64 = 1.35;

/// Healing against its reference, in heights: a product and two sums.
pub const HEAL_STEP: f64 = 3.0 * ULP;

/// Volume of smooth profiles, relative: the project's bar.
pub const STAMP_VOLUME: f64 = 1e-3;

/// 4,096 stamps of radius 8 in steps of the wave at 1024²: the project's budget.
pub const STAMP_BUDGET_STEPS: f64 = 2.0;

/// A substep of shallow water in steps of the wave at 1024²: the project's budget on a software adapter.
pub const WATER_BUDGET_STEPS: f64 = 6.0;

/// Levels of 255 by which one colour may differ under fields of different sizes: the filter's 8 bits of fraction move the place by a
/// 256th of a pixel of the image, and two levels are what adapters round differently.
pub const ALBEDO_IMAGE_LEVELS: u8 = 3;

/// Precision that a lattice position has at the least, cells.
pub const LATTICE_FLOOR: f64 = 1e-4;

/// Precision of lattice positions, cells, where the largest coordinate that the ray reaches is `largest`: eight roundings of f32
/// there, and no less than [`LATTICE_FLOOR`].
pub fn lattice_bound(largest: f64) -> f64 {
    LATTICE_FLOOR.max(8.0 * 2f64.powi(-24) * largest)
}

/// Depth of a flat field, metres: a few roundings of heights near ½ times a depth of 0.1, and the filter's 8 bits cannot matter.
pub const FLAT_FIELD: f64 = 1e-7;

/// Height by which the exact traversal may pass through the surface, or stop above it, where a ray grazes it: the rounding of
/// the bilinear in f32 and its slack, some 1e-6, and what the surface rises over the misplacement of the ray.
pub fn hit_height(cells: f64, slope: f64) -> f64 {
    1e-5 + cells * slope
}

/// Share of random rays that may graze so closely that rounding decides: thirty times what was measured, three in a million.
pub const TANGENT_SHARE: f64 = 1e-4;

/// The same of adversarial rays, made to graze: five times what was measured, 14 in a hundred thousand (shadow rays along the
/// diagonal of blocks, mostly).
pub const ADVERSARIAL_TANGENT_SHARE: f64 = 7e-4;

/// Share of a mesh's pixels that may disagree with brute force because a ray grazes or a silhouette passes within a 256th of a pixel of
/// its centre: a shell has its silhouettes besides, lines one pixel wide of which 1/128 can fall either way, and faces seen edge-on. Each
/// such pixel is judged by itself. Measured: 0.0006 of a box drawn flat, 0.0014 of shells.
pub const SHELL_OFF_SHARE: f64 = 5e-3;

/// Composition of relief and wave: one product and one sum in f32 of numbers below 2, fused or not.
pub const COMPOSED_HEIGHT: f64 = 2.0 * ULP;

/// A component of a normal: a half has 11 bits, and the normal's own f32 rounding may decide which half.
pub const NORMAL_COMPONENT: f64 = 1.0 / 2048.0;

/// A component of a mean of normals: each level is stored as a half, whose rounding the levels above it inherit.
pub fn normal_mip(level: usize) -> f64 {
    (1 + level) as f64 * NORMAL_COMPONENT
}

/// Mip level of a pixel: a gradient of f32 coefficients less a position's share of another, and the logarithm of it.
pub const MIP_LEVEL: f64 = 1e-3;

/// Height of the plane that is left of a relief: its mean is stored as a half, once a level.
pub const MEAN_PLANE: f64 = 4e-3;

/// How far a sixtieth of a level may move the height of the coarse surface: the difference of two neighbouring levels of mean
/// heights on a smooth field is some tenths, and a level that popped would move it by all of that.
pub const DETAIL_STEP: f64 = 0.01;

/// A flight with level of detail against the same without, levels of 255 of its pictures: the project's bars.
pub const FLIGHT_MEAN: f64 = 4.0;
/// The 99th percentile of the same.
pub const FLIGHT_P99: u8 = 16;
/// Share of the steps that level of detail saves on it.
pub const FLIGHT_SAVED: f64 = 0.4;
/// The 99th percentile of the differences from frame to frame, in those of the flight without.
pub const FLIGHT_FLICKER: f64 = 1.1;

/// Levels of 255 by which a picture may differ from its golden: software adapters, and one of them between processors, differ by
/// two or three.
pub const GOLDEN_LEVELS: u8 = 3;

/// Share of a golden's values that may differ by more: where a ray grazes or a shadow begins, one rounding decides a whole pixel.
/// Some 24 pixels; turning the light of `bullet-wall` by one degree changes 0.0015.
pub const GOLDEN_OUTLIERS: f64 = 0.001;

/// Heights by which a picture's height may differ between the hardware's bilinear filter, with its 8 bits of fraction, and four
/// loads: a 256th of the difference between two texels, and what that does to where a ray of `pom` meets the surface.
pub const FILTERED_HEIGHT: f64 = 0.02;

/// The surface pass of `exact` in times of that of `normal`: the project's budget on a software adapter.
pub const EXACT_BUDGET: f64 = 4.0;

/// The surface pass with `cone` in times of that with `hard`: the project's budget.
pub const CONE_BUDGET: f64 = 2.0;

/// A still gas planet, in times of a busy one: the project's bar.
pub const STILL_GAS_BUDGET: f64 = 0.25;

/// From the start of the program to its first picture: the project's budget on a software adapter.
pub const FIRST_PICTURE: std::time::Duration = std::time::Duration::from_secs(2);

/// What the hardware's filter may do to a height where the surface has this slope: 8 bits of fraction, cut off on both axes.
pub fn filtered_height(slope: f64) -> f64 {
    std::f64::consts::SQRT_2 * slope / 256.0
}

/// Share of rays of an approximating technique that may end further from their reference than [`lattice_bound`], by loads, on
/// smooth fields: the project's bar. There a sample only just misses the surface by rounding, and the next one hits.
pub const TECHNIQUE_OFF_SHARE: f64 = 1e-4;

/// Mean distance of `pyramid` from the exact hit on waves, cells: with columns, and refined. Half as much again as measured.
pub const PYRAMID_WAVES: [f64; 2] = [0.5, 0.055];

/// The same on an elevation model.
pub const PYRAMID_ELEVATION: [f64; 2] = [0.28, 0.055];

/// How far a hundredth of a sample may move the parameter of a hit on a smooth field. A count that jumped by one would move it
/// by twenty times as much.
pub const POM_JUMP: f64 = 1e-3;

/// Visibility of `pom-soft` against the f64 reference: the rounding of a height over the rise of its place, times the strength.
pub const SOFT_VISIBILITY: f64 = 1e-3;

/// Share of receivers where it may differ by more: two samples that block alike, and rounding decides whose edge is searched.
pub const SOFT_OFF_SHARE: f64 = 2e-3;

/// Mean difference that samples above the stated count make: a quarter of a step of an 8-bit picture.
pub const SOFT_CONVERGED: f64 = 1e-3;

/// Largest step of visibility between receivers a twentieth of a cell apart across a penumbra: less than half of it is the
/// fall itself.
pub const SOFT_STEP: f64 = 1.0 / 64.0;

/// How much visibility may change in all, up and down, across a penumbra: falling alone makes 1.
pub const SOFT_VARIATION: f64 = 1.01;

/// Texels by which 99 in 100 hits of a picture may differ from the reference, where a ray is four degrees above the plane: a hit's
/// own precision, a ten-thousandth of a cell, and that of an f32 position in the world.
pub const COMPARED_P99: f64 = 1e-3;
/// A light model against its f64 reference, relative: some thirty operations at 2⁻²⁴, and above all a power whose base is off by one
/// rounding, 2⁻²³, times an exponent of up to 512, or what a lobe as narrow does to the cosine. Twice what was measured.
pub const LIGHT: f64 = 1.5e-4;

/// Reciprocity of a light model in f64: rounding alone.
pub const RECIPROCITY: f64 = 1e-12;

/// The integral of GGX over the hemisphere, by a quadrature of 4,000 angles that follow the lobe.
pub const DISTRIBUTION_INTEGRAL: f64 = 1e-6;

/// What a directional albedo may exceed 1 by: the error of its quadrature, twice what was measured of a mirror, which reflects 1.
/// Without the constant that the model is divided by it exceeds that by three times as much.
pub const FURNACE: f64 = 1e-3;

/// Single-scatter loss against what the shader's header states: its last digit.
pub const FURNACE_STATED: f64 = 1e-3;

/// The sky against its f64 reference, and its mean against the colours that it is made of: the horizon's soft edge lends each
/// half a ten-thousandth of the other.
pub const SKY: f64 = 1e-6;
/// See [`SKY`].
pub const SKY_MEAN: f64 = 2e-4;
/// Share of receivers where `steep` may differ from its f64 reference: a layer that only just grazes, and the filter's 8 bits.
pub const STEEP_OFF_SHARE: f64 = 2e-3;

/// Share of receivers where 4,096 layers may differ from a hard shadow: blockers that stand up for less than a layer.
pub const STEEP_HARD_SHARE: f64 = 5e-3;

/// Share of the disc's points that a straight cut may have too many or too few, times their number to the power of ¾: 1.11 was
/// measured, for evenly strewn points it tends to a constant.
pub const DISC_POINTS: f64 = 1.3;

/// `area` against its f64 reference, root of the mean square: where a receiver is within some thousandths of a cell of a crest, the
/// lift of a millionth of the height range frees its rays. Lights mirrored or turned are off by 0.04 and more.
pub const AREA_RMS: f64 = 0.02;

/// Mean difference that points of the light's disc above the stated count make: half a step of an 8-bit picture, where half of the
/// receivers are in a penumbra.
pub const AREA_CONVERGED: f64 = 2e-3;

/// `area` with 512 points against the disc's ramp: a cut's too many or too few points, and the ramp of the texel that the
/// bilinear step is wide.
pub const AREA_RAMP: f64 = 0.01;

/// `cone` against its f64 reference, which starts as far above the surface as the shader does: from a tenth of a cell away the rounding
/// of a height is some thousandths of the light's radius. Against the reference from the surface itself up to 1.8 % of receivers differ
/// by more: nearer to a crest that lift is a good part of the light.
pub const CONE_VISIBILITY: f64 = 0.02;

/// Share of receivers where it may differ by more: one of the 2,000 of a light; none was measured.
pub const CONE_OFF_SHARE: f64 = 5e-4;

/// What rounding may add to the visibility of a blocker that grows.
pub const CONE_ROUNDING: f64 = 1e-4;

/// `cone` against the disc's ramp behind a straight step, whose bilinear edge is one texel wide.
pub const CONE_RAMP: f64 = 0.01;

/// Root of the mean square of what `cone` differs from the truth on a wall, a step and smooth terrain: the project's bar.
pub const CONE_RMS: f64 = 0.03;

/// Share of receivers to which a light of a milliradian is a point: the project's bar.
pub const CONE_POINT_SHARE: f64 = 0.999;

/// Length of a unit vector of a mesh, and the cosine of a right angle: a few roundings of its three components, and of the sums of
/// MikkTSpace.
pub const MESH_FRAME: f64 = 1e-5;

/// Metres by which a position of about one metre may be off after a handful of affine maps in f32.
pub const MESH_LENGTH: f64 = 1e-5;

/// The ray's parameter at a hit of the micropolygon mesh: the rounding of a height over the angle between ray and facet.
pub const MESH_PARAMETER: f64 = 1e-5;

/// Share of rays through it that may end elsewhere: a ray that only just passes an edge, by rounding.
pub const MESH_OFF_SHARE: f64 = 2e-3;

/// Cells by which a pixel of rasterised micropolygons may be off: interpolation snaps corners to 1/256 pixel, and a pixel of that
/// test is some 1.5 cells wide, several where the surface turns away.
pub const MESH_PIXEL_CELLS: f64 = 0.05;

/// Share of pixels that may be off by more: where a silhouette passes within that of the pixel's centre.
pub const MESH_PIXEL_SHARE: f64 = 2e-3;

/// Depths of shallow water, of bores and fans, against the closed form, relative sums: the project's bar. Second order measures 0.0006
/// to 0.0035 there.
pub const WATER_DAM: f64 = 0.01;

/// The dam's middle state and shock, against the six figures that they were given to.
pub const WATER_STOKER: f64 = 1e-5;

/// Thacker's paraboloid after one period, relative sum: the project's bar.
pub const WATER_THACKER: f64 = 0.02;

/// The period of a seiche: the project's bar.
pub const WATER_SEICHE: f64 = 0.01;

/// A lake at rest after 1,000 steps, in depths: the project's bar. The surface is stored as a depth, whose rounding is a thousandth of
/// that.
pub const WATER_REST: f64 = 1e-5;

/// Drift of the mass between walls over 2,000 steps: the project's bar.
pub const WATER_MASS: f64 = 1e-5;

/// Drift of the mass between walls over some 500 substeps at an end of a range, with rings that thousands of drops and a plunger make:
/// each of them rounds what it moves.
pub const WATER_MASS_ENDURED: f64 = 1e-4;

/// A swell of a thousandth of the depth against a linear wave, in amplitudes, over three wavelengths of 63 texels each: minmod slopes
/// flatten crests. Half as much again as was measured.
pub const WATER_SWELL: f64 = 0.18;

/// How far the rings of one period of a plunger may be from those of the next, in their height, when the first have passed.
pub const WATER_RING: f64 = 0.1;

/// What covers a field with water, in a half: 11 bits, of numbers below 1.
pub const WATER_COVER: f64 = 1.0 / 2048.0;

/// What a flow may exceed a clamped velocity times its depth by, relative: two roundings of f32.
pub const WATER_CAP: f64 = 5e-7;

/// Net of a dent and its ring, in volumes of the dent: sums of some thousand f32 numbers.
pub const WATER_NET: f64 = 1e-5;

/// Water against its f64 reference after a few steps, in depths: a thin film's velocity is a quotient of small numbers, and limiters
/// have corners, where rounding decides between two slopes. Measured: 2.1e-6.
pub const WATER_STEPS: f64 = 5e-6;

/// Procedural heights against their f64 reference: a place on a lattice of some 30 cells is rounded to 2⁻²⁴ of that, an octave rises
/// by up to 3 a cell, an edge a hundredth of the field wide by 1.5 in that. Twice what was measured of any pattern.
pub const NOISE_HEIGHT: f64 = 5e-5;

/// Mean of plain noise over a thousand cells: each is off by some 0.2 by chance.
pub const NOISE_MEAN: f64 = 0.02;

/// Turns by which a gear's angle, read from the heights of its teeth, may be off: the picture of an edge on texels, over 300 of them.
/// Twice what was measured.
pub const GEAR_TURNS: f64 = 1e-5;

/// Modules by which straight-sided teeth may cut into each other where involutes would roll: 0.095 was measured.
pub const GEAR_INTERFERENCE: f64 = 0.1;

/// Distances from the eye of two reliefs in one pixel, relative, within which either may be seen: the depth buffer's f32, and the
/// precision of a place on a ray, a ten-thousandth of a cell, where it grazes.
pub const RELIEF_TIE: f64 = 1e-5;

/// Share of pixels whose ray only just touches a relief, where rounding decides whether it goes on: as for the positions of captures.
pub const TANGENT_SHARE_SEEN: f64 = 1e-3;

/// Share of pixels in which a relief that is turned and moved together with camera and light may differ: where a ray or a shadow ray
/// grazes, other roundings decide.
pub const SAME_RELIEF_OFF_SHARE: f64 = 5e-3;

/// Visibility behind the soft border of a rectangle against 2,000 directions of the light's disc: half as much again as was measured.
pub const RELIEF_PENUMBRA: f64 = 0.02;

/// The same at its corners, where the shares behind two borders are multiplied: twice what was measured.
pub const RELIEF_CORNER: f64 = 0.045;

/// The same where the light comes far aslant, and the border's place is no longer linear across the disc: half as much again as was measured,
/// and at corners too. Taking one axis for the other is off by 0.13 along a border.
pub const RELIEF_PENUMBRA_ASLANT: f64 = 0.037;
/// At corners.
pub const RELIEF_CORNER_ASLANT: f64 = 0.13;

/// By how much a range of `bounds` may miss the surface, heights: rounding puts a height within half an ulp of a step's product onto that
/// step, 3e-8, and the quotient may be an ulp below it. The traversal allows for five times as much.
pub const BOUND_SLACK: f64 = 1e-7;
