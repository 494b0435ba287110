//! Nodes, skins and the animation of a file.

use std::collections::{HashMap, HashSet};

use ::gltf as format;
use format::scene::Transform;
use glam::{Mat4, Quat, Vec3};

use super::accessor::Buffers;
use crate::mesh::Unfit;
use crate::mesh::skin::{Interpolation, Joint, Node, Placement, Property, Skin, Track};

/// The hierarchy, and what hangs on it so far.
pub(super) struct Rig {
    nodes: Vec<Node>,
    /// The file's index of each.
    indices: Vec<usize>,
    /// Where each lies in the file's space, at rest.
    file_from_node: Vec<Mat4>,
    joints: Vec<Joint>,
    /// The first joint of each skin, by the file's index of it.
    skins: HashMap<usize, u32>,
    /// The joint of each node that moves as a whole.
    rigid: HashMap<usize, u32>,
    tracks: Vec<Track>,
    has_skins: bool,
}

impl Rig {
    /// Reads nodes and the first animation.
    pub fn new(file: &format::Gltf, buffers: &Buffers) -> Result<Self, Unfit> {
        let all: Vec<format::Node> = file.nodes().collect();
        let mut parents = vec![None; all.len()];
        for node in &all {
            for child in node.children() {
                if parents[child.index()].replace(node.index()).is_some() {
                    return Err(Unfit(format!("has a node {} with two parents: save it anew", child.index())));
                }
            }
        }
        let mut rig = Self {
            nodes: Vec::new(),
            indices: Vec::new(),
            file_from_node: Vec::new(),
            joints: Vec::new(),
            skins: HashMap::new(),
            rigid: HashMap::new(),
            tracks: Vec::new(),
            has_skins: file.skins().len() > 0,
        };
        // From the roots down, in the file's order: parents come before their children.
        let mut open: Vec<(usize, Option<usize>)> =
            (0..all.len()).rev().filter(|&i| parents[i].is_none()).map(|i| (i, None)).collect();
        while let Some((index, parent)) = open.pop() {
            let place = rig.nodes.len();
            let rest = placement(&all[index].transform());
            let own = rest.matrix();
            rig.file_from_node.push(parent.map_or(own, |parent| rig.file_from_node[parent] * own));
            rig.nodes.push(Node { parent, rest });
            rig.indices.push(index);
            let children: Vec<_> = all[index].children().map(|child| (child.index(), Some(place))).collect();
            open.extend(children.into_iter().rev());
        }
        if rig.nodes.len() < all.len() {
            return Err(Unfit("has nodes that are their own ancestors: save it anew".to_owned()));
        }
        rig.read_animation(file, buffers)?;
        Ok(rig)
    }

    /// The nodes of the default scene, or the first, or of no scene at all, that have meshes; each with its place here.
    pub fn nodes_with_meshes<'a>(&self, file: &'a format::Gltf) -> Vec<(usize, format::Node<'a>)> {
        let all: Vec<format::Node> = file.nodes().collect();
        let shown: Option<HashSet<usize>> =
            file.default_scene().or_else(|| file.scenes().next()).map(|scene| scene.nodes().map(|node| node.index()).collect());
        let mut is_shown = vec![shown.is_none(); self.nodes.len()];
        for (place, node) in self.nodes.iter().enumerate() {
            let listed = shown.as_ref().is_some_and(|shown| shown.contains(&self.indices[place]));
            is_shown[place] |= listed || node.parent.is_some_and(|parent| is_shown[parent]);
        }
        let with_mesh = |place: usize| all[self.indices[place]].mesh().is_some() && is_shown[place];
        (0..self.nodes.len()).filter(|&place| with_mesh(place)).map(|place| (place, all[self.indices[place]].clone())).collect()
    }

    /// Whether anything may move.
    pub fn is_animated(&self) -> bool {
        self.has_skins || !self.tracks.is_empty()
    }

    /// Where a node lies in the file's space, at rest.
    pub fn file_from_node(&self, place: usize) -> Mat4 {
        self.file_from_node[place]
    }

    /// The joint of what hangs on a node as a whole.
    pub fn rigid_joint(&mut self, node: usize) -> u32 {
        let joints = &mut self.joints;
        *self.rigid.entry(node).or_insert_with(|| push(joints, Joint { node, node_from_bind: Mat4::IDENTITY }))
    }

    /// The first joint of a skin, and how many there are.
    pub fn joints_of(&mut self, skin: &format::Skin, buffers: &Buffers) -> Result<(u32, usize), Unfit> {
        let places: HashMap<usize, usize> = self.indices.iter().enumerate().map(|(place, &index)| (index, place)).collect();
        let nodes: Vec<usize> = skin.joints().map(|joint| places[&joint.index()]).collect();
        let matrices = match skin.inverse_bind_matrices() {
            Some(accessor) => buffers.matrices(&accessor)?,
            None => vec![Mat4::IDENTITY; nodes.len()],
        };
        if nodes.is_empty() || matrices.len() < nodes.len() {
            let (index, joints, matrices) = (skin.index(), nodes.len(), matrices.len());
            return Err(Unfit(format!("has a skin {index} of {joints} joints with {matrices} bind matrices: save it anew")));
        }
        let count = nodes.len();
        if let Some(&first) = self.skins.get(&skin.index()) {
            return Ok((first, count));
        }
        let first = u32::try_from(self.joints.len()).unwrap_or(u32::MAX);
        self.joints.extend(nodes.into_iter().zip(matrices).map(|(node, node_from_bind)| Joint { node, node_from_bind }));
        self.skins.insert(skin.index(), first);
        Ok((first, count))
    }

    /// What moves the mesh, still without vertices; `None` if nothing does.
    pub fn finish(self) -> Option<Skin> {
        let duration_seconds = self.tracks.iter().filter_map(|track| track.times.last()).copied().fold(0.0, f32::max);
        self.is_animated().then(|| Skin {
            nodes: self.nodes,
            joints: self.joints,
            bind: Vec::new(),
            influences: Vec::new(),
            tracks: self.tracks,
            duration_seconds,
            mesh_from_file: Mat4::IDENTITY,
        })
    }

    fn read_animation(&mut self, file: &format::Gltf, buffers: &Buffers) -> Result<(), Unfit> {
        let Some(animation) = file.animations().next() else { return Ok(()) };
        if file.animations().len() > 1 {
            log::info!("of {} animations the first is played", file.animations().len());
        }
        let places: HashMap<usize, usize> = self.indices.iter().enumerate().map(|(place, &index)| (index, place)).collect();
        for (number, channel) in animation.channels().enumerate() {
            use format::animation::{Interpolation as Theirs, Property as Moves};
            let (property, width) = match channel.target().property() {
                Moves::Translation => (Property::Translation, 3),
                Moves::Rotation => (Property::Rotation, 4),
                Moves::Scale => (Property::Scale, 3),
                Moves::MorphTargetWeights => {
                    log::warn!("the animation of morph targets is left out");
                    continue;
                }
            };
            let node = places[&channel.target().node().index()];
            if matches!(self.nodes[node].rest, Placement::Matrix(_)) {
                return Err(Unfit(format!("animates a node {} that is given as a matrix: save it anew", self.indices[node])));
            }
            let sampler = channel.sampler();
            let interpolation = match sampler.interpolation() {
                Theirs::Step => Interpolation::Step,
                Theirs::Linear => Interpolation::Linear,
                Theirs::CubicSpline => Interpolation::Cubic,
            };
            let times: Vec<f32> = buffers.vectors(&sampler.input(), 1)?.into_iter().map(|time| time.x).collect();
            let values = buffers.vectors(&sampler.output(), width)?;
            let expected = times.len() * if interpolation == Interpolation::Cubic { 3 } else { 1 };
            let rises = times.iter().all(|time| time.is_finite()) && times.windows(2).all(|pair| pair[0] < pair[1]);
            if times.is_empty() || !rises || values.len() != expected || values.iter().any(|value| !value.is_finite()) {
                return Err(Unfit(format!(
                    "has keyframes in channel {number} of its animation that make no motion: save it anew"
                )));
            }
            self.tracks.push(Track { node, property, interpolation, times, values });
        }
        Ok(())
    }
}

fn push(joints: &mut Vec<Joint>, joint: Joint) -> u32 {
    joints.push(joint);
    u32::try_from(joints.len() - 1).unwrap_or(u32::MAX)
}

fn placement(transform: &Transform) -> Placement {
    match transform {
        Transform::Matrix { matrix } => Placement::Matrix(Mat4::from_cols_array_2d(matrix)),
        Transform::Decomposed { translation, rotation, scale } => Placement::Parts {
            translation: Vec3::from_array(*translation),
            rotation: Quat::from_array(*rotation).normalize(),
            scale: Vec3::from_array(*scale),
        },
    }
}
