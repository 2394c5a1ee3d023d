//! Bones, skins and animations: how a plant sways.

use espalier_motion::{Bound, Rig, clips::Clip};
use glam::{DQuat, DVec3, Quat, Vec3};

use super::{keys::Keys, vertex::Attribute, writer::Writer};
use crate::{
    ExportError,
    gltf::{Animation, Channel, FLOAT, Node, Path, Skin, Target},
    swaying::{Local, Rider, Swaying},
};

/// Bytes of JSON for each bone: its node, and what says of both clips where its keys are.
pub(super) const CAPACITY_OF_BONE: usize = 1000;

/// What leaving keys out and writing turns in 16 bits may move anything by for each bone, as a share of how far the plant
/// reaches: where that fills a screen of 2,000 pixels a fifth of one.
const NEAR: f64 = 1e-4;

/// How far leaves reach from their nodes, in internodes.
const LEAF: f32 = 2.0;

/// The bones of the plant whose parts are being written.
pub(super) struct Skeleton<'a> {
    swaying: &'a Swaying,
    rig: Rig,
    /// The node of each bone.
    nodes: Vec<usize>,
    /// How far what each bone carries reaches from it, m.
    arms: Vec<f64>,
    /// By how much each bone may miss where it belongs, m.
    near: f64,
}

impl<'a> Skeleton<'a> {
    /// Adds the bones below the node that is open, and their animations. Where none is played they stand as what lies on
    /// the plant bends it.
    pub(super) fn begin(
        writer: &mut Writer<'_>,
        swaying: &'a Swaying,
        rig: Rig,
    ) -> Result<Self, ExportError> {
        let origin = (writer.origin() * writer.scale).as_dvec3();
        let first = writer.root.nodes.len();
        let nodes: Vec<usize> = (first..first + rig.bones().len()).collect();
        let owner = writer.owner();
        let mut made: Vec<Node> = Vec::with_capacity(nodes.len());
        let rest = swaying.locals(&rig, swaying.rest());
        for (number, (bone, Local { turn, place })) in rig.bones().iter().zip(rest).enumerate() {
            let from = if bone.parent.is_none() { origin } else { DVec3::ZERO };
            if let Some(parent) = bone.parent {
                made[parent as usize].children.push(nodes[number]);
            }
            let name = if number == 0 { format!("{owner} Bones") } else { format!("Bone {number}") };
            let translation = Some((place - from).as_vec3().to_array());
            let turn = turn.as_quat();
            let rotation = (turn != Quat::IDENTITY).then(|| turn.to_array());
            made.push(Node { name, translation, rotation, ..Node::default() });
        }
        let mut made = made.into_iter();
        if let Some(ground) = made.next() {
            writer.adopt(ground, 0);
        }
        writer.root.nodes.extend(made);
        // Leaves reach beyond the nodes they stand on.
        let leaf = f64::from(LEAF * writer.scale);
        let arms = rig.arms(&swaying.joints, &swaying.wood).into_iter().map(|arm| arm + leaf);
        let arms: Vec<f64> = arms.collect();
        // The ground carries the whole plant.
        let near = NEAR * arms[0];
        let skeleton = Self { swaying, rig, nodes, arms, near };
        for clip in &swaying.clips {
            skeleton.animate(writer, clip, &owner)?;
        }
        Ok(skeleton)
    }

    /// Bones and shares of a vertex, as a file has them: the shares add up to 255.
    pub(super) fn bound(&self, rider: Rider) -> ([u16; 4], [u8; 4]) {
        let Bound { bones, share } = self.rig.bound(&self.swaying.joints, rider.row, f64::from(rider.share));
        let second = (share * 255.0).round() as u8;
        let [one, other] = bones.map(|bone| bone as u16);
        match second {
            0 => ([one, 0, 0, 0], [255, 0, 0, 0]),
            255 => ([other, 0, 0, 0], [255, 0, 0, 0]),
            _ => ([one, other, 0, 0], [255 - second, second, 0, 0]),
        }
    }

    /// A skin for vertices that are counted from `origin` in units of so many metres.
    pub(super) fn skin(
        &self,
        writer: &mut Writer<'_>,
        origin: Vec3,
        unit: f32,
    ) -> Result<usize, ExportError> {
        let at = (origin * writer.scale).as_dvec3();
        let matrices = self.rig.bones().iter().flat_map(|bone| {
            let [x, y, z] = (at - bone.rest).as_vec3().to_array();
            [unit, 0.0, 0.0, 0.0, 0.0, unit, 0.0, 0.0, 0.0, 0.0, unit, 0.0, x, y, z, 1.0]
        });
        let bytes: Vec<u8> = matrices.flat_map(f32::to_le_bytes).collect();
        let view = writer.whole_view(&bytes, None)?;
        let count = self.rig.bones().len();
        let inverse_bind_matrices = writer.accessor(
            view,
            Attribute { offset: 0, component_type: FLOAT, shape: "MAT4" },
            false,
            count,
        );
        let joints = self.nodes.clone();
        writer.root.skins.push(Skin { inverse_bind_matrices, joints });
        Ok(writer.root.skins.len() - 1)
    }

    fn animate(&self, writer: &mut Writer<'_>, clip: &Clip, owner: &str) -> Result<(), ExportError> {
        let bones = self.rig.bones();
        let count = clip.keys.len();
        let mut turns: Vec<Vec<DQuat>> = vec![Vec::with_capacity(count); bones.len()];
        let mut places: Vec<Vec<DVec3>> = vec![Vec::with_capacity(count); bones.len()];
        for key in &clip.keys {
            for (number, Local { turn, place }) in self.swaying.locals(&self.rig, key).into_iter().enumerate()
            {
                if !(turn.is_finite() && place.is_finite()) {
                    return Err(ExportError::NotFinite);
                }
                turns[number].push(turn);
                places[number].push(place);
            }
        }
        let mut keys = Keys::of(clip);
        let mut channels = Vec::new();
        // The first is the ground, which stands still.
        for number in 1..bones.len() {
            let node = self.nodes[number];
            keys.turns(&turns[number], self.near / self.arms[number]);
            keys.places(&places[number], self.near);
            for path in [Path::Rotation, Path::Translation] {
                channels.push(Channel { sampler: channels.len(), target: Target { node, path } });
            }
        }
        if !channels.is_empty() {
            let (name, samplers) = (format!("{} {owner}", clip.name), keys.finish(writer)?);
            writer.root.animations.push(Animation { name, channels, samplers });
        }
        Ok(())
    }
}
