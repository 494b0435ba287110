//! What moves a mesh: nodes with keyframes, and the vertices that hang on them.
//!
//! A vertex hangs on up to four joints (linear blend skinning, as glTF defines it). Parts that move as a whole hang on one with weight
//! 1, so that there is one kind of animated mesh. An animation begins anew when it ends.

use glam::{Mat3, Mat4, Quat, Vec3, Vec4};

use super::Vertex;

/// Nodes, joints, keyframes, and what hangs on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Skin {
    /// The nodes, parents before their children.
    pub nodes: Vec<Node>,
    /// The joints that vertices hang on.
    pub joints: Vec<Joint>,
    /// The vertices where nothing moves them: what the joints' matrices apply to.
    pub bind: Vec<Vertex>,
    /// What each of them hangs on.
    pub influences: Vec<Influence>,
    /// The keyframes.
    pub tracks: Vec<Track>,
    /// The time after which the animation begins anew, seconds; 0 where there is none.
    pub duration_seconds: f32,
    /// Where the file's space lies in the mesh's.
    pub mesh_from_file: Mat4,
}

/// A node of the hierarchy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// The place of its parent among the nodes.
    pub parent: Option<usize>,
    /// Where it lies in its parent, at rest.
    pub rest: Placement,
}

/// Where a node lies in its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Placement {
    /// As a whole; nothing animates such a one.
    Matrix(Mat4),
    /// In parts, which keyframes replace.
    Parts {
        /// Metres.
        translation: Vec3,
        /// A unit quaternion.
        rotation: Quat,
        /// Factors along its own axes.
        scale: Vec3,
    },
}

/// A node that vertices hang on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// The node.
    pub node: usize,
    /// From the space of the bound vertices into the node's.
    pub node_from_bind: Mat4,
}

/// The joints that a vertex hangs on, and how much on each: together 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influence {
    /// Places among the joints.
    pub joints: [u32; 4],
    /// Weights.
    pub weights: [f32; 4],
}

/// The keyframes of one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The node.
    pub node: usize,
    /// What of it moves.
    pub property: Property,
    /// How values follow from the keyframes around.
    pub interpolation: Interpolation,
    /// When, seconds, rising.
    pub times: Vec<f32>,
    /// A value for each time; with cubic interpolation three: the slope before, the value, and the slope after.
    pub values: Vec<Vec4>,
}

/// What of a node moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// xyz is the translation.
    Translation,
    /// The quaternion.
    Rotation,
    /// xyz is the scale.
    Scale,
}

/// How values follow from keyframes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The last one holds.
    Step,
    /// Straight from one to the next; rotations at an even pace along the shorter arc.
    Linear,
    /// A cubic Hermite spline with the slopes given.
    Cubic,
}

impl Influence {
    /// Hangs on one joint alone.
    pub fn whole(joint: u32) -> Self {
        Self { joints: [joint, 0, 0, 0], weights: [1.0, 0.0, 0.0, 0.0] }
    }
}

impl Placement {
    /// From the node's own space into its parent's.
    pub fn matrix(self) -> Mat4 {
        match self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => Mat4::from_scale_rotation_translation(scale, rotation, translation),
        }
    }
}

impl Track {
    /// The value at a time; before the first keyframe that one's, after the last that one's.
    pub fn sample(&self, time: f32) -> Vec4 {
        let cubic = self.interpolation == Interpolation::Cubic;
        let value = |key: usize| self.values[if cubic { 3 * key + 1 } else { key }];
        let next = self.times.partition_point(|&at| at <= time);
        if next == 0 {
            return self.unit(value(0));
        }
        let key = next - 1;
        if next == self.times.len() || self.interpolation == Interpolation::Step {
            return self.unit(value(key));
        }
        let span = self.times[next] - self.times[key];
        let s = (time - self.times[key]) / span;
        let blended = if cubic {
            let (slope, next_slope) = (span * self.values[3 * key + 2], span * self.values[3 * next]);
            let (s2, s3) = (s * s, s * s * s);
            (2.0 * s3 - 3.0 * s2 + 1.0) * value(key)
                + (s3 - 2.0 * s2 + s) * slope
                + (3.0 * s2 - 2.0 * s3) * value(next)
                + (s3 - s2) * next_slope
        } else if self.property == Property::Rotation {
            let [from, to] = [key, next].map(|key| Quat::from_vec4(self.unit(value(key))));
            return from.slerp(to, s).into();
        } else {
            value(key).lerp(value(next), s)
        };
        self.unit(blended)
    }

    /// A rotation made a unit quaternion; anything else as it is.
    fn unit(&self, value: Vec4) -> Vec4 {
        if self.property == Property::Rotation { value.try_normalize().unwrap_or(Vec4::W) } else { value }
    }
}

impl Skin {
    /// The time in the animation, seconds.
    fn time(&self, time_seconds: f64) -> f32 {
        let duration = f64::from(self.duration_seconds);
        #[expect(clippy::cast_possible_truncation, reason = "keyframes are f32")]
        let time = if duration > 0.0 { time_seconds.rem_euclid(duration) as f32 } else { 0.0 };
        time
    }

    /// For each joint, the matrix from the bound vertices into the mesh's space at a time, seconds.
    pub fn pose(&self, time_seconds: f64) -> Vec<Mat4> {
        let time = self.time(time_seconds);
        let mut placements: Vec<Placement> = self.nodes.iter().map(|node| node.rest).collect();
        for track in &self.tracks {
            let value = track.sample(time);
            // A node given as a matrix has nothing to be replaced; the reader refuses to animate one.
            if let Placement::Parts { translation, rotation, scale } = &mut placements[track.node] {
                match track.property {
                    Property::Translation => *translation = value.truncate(),
                    Property::Rotation => *rotation = Quat::from_vec4(value),
                    Property::Scale => *scale = value.truncate(),
                }
            }
        }
        let mut file_from_node: Vec<Mat4> = Vec::with_capacity(self.nodes.len());
        for (node, placement) in self.nodes.iter().zip(placements) {
            let own = placement.matrix();
            file_from_node.push(node.parent.map_or(own, |parent| file_from_node[parent] * own));
        }
        self.joints.iter().map(|joint| self.mesh_from_file * file_from_node[joint.node] * joint.node_from_bind).collect()
    }

    /// The vertices at a time, seconds.
    pub fn posed(&self, time_seconds: f64) -> Vec<Vertex> {
        let pose = self.pose(time_seconds);
        let move_one = |(vertex, influence): (&Vertex, &Influence)| {
            let hangs = influence.joints.iter().zip(influence.weights).filter(|(_, weight)| *weight != 0.0);
            let matrix = hangs.fold(Mat4::ZERO, |sum, (&joint, weight)| sum + pose[joint as usize] * weight);
            moved(vertex, matrix)
        };
        self.bind.iter().zip(&self.influences).map(move_one).collect()
    }

    /// Scales the mesh about a point that becomes the origin.
    pub(super) fn place(&mut self, scale: f32, centre: Vec3) {
        self.move_by(Mat4::from_scale(Vec3::splat(scale)) * Mat4::from_translation(-centre));
    }

    /// Moves the mesh.
    pub(super) fn move_by(&mut self, matrix: Mat4) {
        self.mesh_from_file = matrix * self.mesh_from_file;
    }
}

/// A vertex under an affine map: its normal stays at right angles to its surface, and its tangent at right angles to that.
pub(super) fn moved(vertex: &Vertex, matrix: Mat4) -> Vertex {
    let linear = Mat3::from_mat4(matrix);
    // The cofactors are the inverse transpose times the determinant; they exist where the inverse does not.
    let cofactors = Mat3::from_cols(
        linear.y_axis.cross(linear.z_axis),
        linear.z_axis.cross(linear.x_axis),
        linear.x_axis.cross(linear.y_axis),
    );
    let mirrors = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
    let normal = (mirrors * (cofactors * vertex.normal)).try_normalize().unwrap_or(vertex.normal);
    let along_u = linear * vertex.tangent.truncate();
    let tangent = (along_u - along_u.dot(normal) * normal).try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    Vertex {
        tangent: tangent.extend(mirrors * vertex.tangent.w),
        position: matrix.transform_point3(vertex.position),
        normal,
        uv: vertex.uv,
    }
}
