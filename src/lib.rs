//! Rilievo: a GPU laboratory for height fields that move.
//!
//! Every frame a simulation and stamps make a height field, a Sobel pass derives its normals, a pyramid pass rebuilds its
//! bounds, and a fragment shader traces it per pixel, with shadows. [`frame::Frame::record`] is the table of contents: whoever
//! wants to know what happens in a frame reads it first.
//!
//! ```text
//!              scene, clock, camera, strokes              plain data, CPU
//!                  │
//!    steps ×  ┌────▼────┐ heights┌─────────┐ height ┌─────────┐ normal
//!             │ sources ├───────►│ compose ├───┬───►│ normals ├────────┐
//!             └────▲────┘        └────▲────┘   │    └─────────┘        ▼
//!             ┌────┴────┐ relief      │        │    ┌─────────┐ bounds ┌─────────┐ radiance ┌─────────┐
//!             │  stamp  ├─────────────┘        └───►│ bounds  ├───────►│ surface ├─────────►│ present ├─► window, files, numbers
//!             └─────────┘                           └─────────┘        └─────────┘          └─────────┘
//! ```
//!
//! The same frame runs in three ways, which differ in who owns the clock and where the picture goes, and in nothing else:
//! [`modes::live`] (a window), [`modes::capture`] (files) and [`modes::stress`] (numbers).
//!
//! # Conventions
//!
//! - **Height.** `h` is an f32 and white is high: 1 is the reference surface (the polygon), 0 the deepest valley. Displacement
//!   goes inward. Papers that speak of *displacement* or *depth* mean `1 − h`.
//! - **Range.** Composition clamps the field to \[0, 1\], turns NaN into 0 and ±Inf into the bound that it exceeds, and counts the
//!   texels that it touched. So a ray that enters the slab always ends in it. The layers beneath (simulation state, stamps)
//!   keep their unclamped values.
//! - **The surface** is the bilinear interpolant of texel centres, addressed with wrap or clamp. Lattice coordinates are
//!   `uv · size − 0.5`. Cell `(i, j)` spans the four centres `(i..i+1, j..j+1)`. With wrap there are as many cells as texels. With
//!   clamp there is one more a row: the half cell −1 along the border, which reads the bounds of cell 0. Every technique
//!   approximates this one surface, and exactness is measured against it.
//! - **A flat base polygon clips nothing sideways**: a ray that leaves the plane before it hits goes on over the wrapped or
//!   clamped field.
//! - **A plane may repeat its field** (`plane.repeat`): copies surround the one in the middle, which stays where it is. Its size is
//!   still that of one copy; uv leaves 0 to 1, world positions follow from it as before.
//! - **Field space**: `u` right, `v` down the image (row 0 on top), height out of the surface: left-handed.
//! - **World**: right-handed, metres, +y up. The plane lies in y = 0, centred on the origin, `u` along +x, `v` along +z; a point
//!   of the surface is `((u − ½)·size.x, (h − 1)·depth, (v − ½)·size.y)`, with `depth` in metres.
//! - **Rays** come from the pixel centre and the matrices, not from interpolated varyings ([`surface::ray_map`]).
//! - **Time**: seconds. A simulation steps by its own fixed `dt`; the clock says how many steps a frame owes.
//! - **Names carry spaces and units**: `world_from_view`, `depth_metres`, `dt_seconds`.
//! - **Determinism**: the same scene, seed, size and adapter give the same bytes. Random numbers come from
//!   [Xoshiro256++](rand::rngs::Xoshiro256PlusPlus), whose sequence is guaranteed. No wall-clock time reaches a simulation.
//!
//! # The stack
//!
//! From the ground up: the base with every stamp pressed into it (the relief), then the sources of the scene
//! ([`field::source::Source`]), each a layer that meets what lies beneath it by a blend and an amplitude ([`field::stack`]). A source
//! that stands on a bed gets what lies beneath it composed there before it moves.
//!
//! # Literature
//!
//! - **\[POM\]** N. Tatarchuk, *Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows*, I3D 2006; **\[POM slides\]**,
//!   its talk.
//! - **\[PDM\]** K. Oh, H. Ki, C.-H. Lee, *Pyramidal Displacement Mapping*, VRST 2006, revised 2007.
//! - **\[Zink\]** J. Zink, *A Closer Look at Parallax Occlusion Mapping*, GameDev.net 2006, revised 2008.
//! - **\[Steep\]** M. McGuire, M. McGuire, *Steep Parallax Mapping*, I3D 2005 (poster).
//! - **\[Kaneko\]** T. Kaneko et al., *Detailed Shape Representation with Parallax Mapping*, ICAT 2001.
//! - **\[Welsh\]** T. Welsh, *Parallax Mapping with Offset Limiting: A Per-Pixel Approximation of Uneven Surfaces*, 2004.
//! - **\[Policarpo\]** F. Policarpo, M. Oliveira, J. Comba, *Real-Time Relief Mapping on Arbitrary Polygonal Surfaces*, I3D 2005;
//!   its depth bias as in F. Policarpo, M. Oliveira, *Relaxed Cone Stepping for Relief Mapping*, GPU Gems 3, 2007.
//! - **\[Selle\]** A. Selle et al., *An Unconditionally Stable MacCormack Method*, Journal of Scientific Computing 35, 2008.
//! - **\[Fedkiw\]** R. Fedkiw, J. Stam, H. W. Jensen, *Visual Simulation of Smoke*, SIGGRAPH 2001.
//! - **\[Moore\]** D. W. Moore, P. G. Saffman, *Structure of a Line Vortex in an Imposed Strain*, in: Aircraft Wake Turbulence and Its
//!   Detection, 1971.
//! - **\[Zehnder\]** J. Zehnder, R. Narain, B. Thomaszewski, *An Advection-Reflection Solver for Detail-Preserving Fluid
//!   Simulation*, SIGGRAPH 2018.
//! - **\[Audusse\]** E. Audusse et al., *A Fast and Stable Well-Balanced Scheme with Hydrostatic Reconstruction for Shallow Water Flows*,
//!   SIAM J. Sci. Comput. 25, 2004.
//! - **\[KP\]** A. Kurganov, G. Petrova, *A Second-Order Well-Balanced Positivity Preserving Central-Upwind Scheme for the
//!   Saint-Venant System*, Commun. Math. Sci. 5, 2007.
//! - **\[Pope\]** R. Pope, E. Fry, *Absorption Spectrum (380–700 nm) of Pure Water*, Applied Optics 36, 1997.
//! - **\[Toro\]** E. F. Toro, *Shock-Capturing Methods for Free-Surface Shallow Flows*, 2001.
//! - **\[Kennedy\]** A. Kennedy et al., *Boussinesq Modeling of Wave Transformation, Breaking, and Runup*, J. Waterway 126, 2000.

pub mod camera;
pub mod cli;
pub mod clock;
pub mod field;
pub mod frame;
pub mod gpu;
pub mod interruption;
pub mod io;
pub mod mesh;
pub mod modes;
pub mod present;
pub mod reference;
pub mod scene;
pub mod stroke;
pub mod suggest;
pub mod surface;
