//! Bones, skins and animations: how a plant sways.

use espalier_motion::{Bound, Rig, clips::Clip};
use glam::{DVec3, Quat, Vec3};

use super::{vertex::Attribute, writer::Writer};
use crate::{
    ExportError,
    gltf::{Animation, Channel, FLOAT, Node, Path, Sampler, Skin, Target},
    swaying::{Local, Rider, Swaying},
};

/// Bytes of JSON for each bone: its node, and what says of both clips where its keys are.
pub(super) const CAPACITY_OF_BONE: usize = 1500;

/// The bones of the plant whose parts are being written.
pub(super) struct Skeleton<'a> {
    swaying: &'a Swaying,
    rig: Rig,
    /// The node of each bone.
    nodes: Vec<usize>,
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
        let skeleton = Self { swaying, rig, nodes };
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
        let mut turns: Vec<Vec<f32>> = vec![Vec::with_capacity(4 * count); bones.len()];
        let mut places: Vec<Vec<f32>> = vec![Vec::with_capacity(3 * count); bones.len()];
        for key in &clip.keys {
            // The first is the ground, which stands still.
            for (number, Local { turn, place }) in
                self.swaying.locals(&self.rig, key).into_iter().enumerate().skip(1)
            {
                turns[number].extend(turn.to_array().map(|part| part as f32));
                places[number].extend(place.as_vec3().to_array());
            }
        }
        let times: Vec<f32> = (0..count).map(|key| clip.time(key) as f32).collect();
        let last = times.last().copied().unwrap_or_default();
        let input = Self::keys(writer, &times, "SCALAR", count)?;
        let timed = &mut writer.root.accessors[input];
        (timed.min, timed.max) = (Some(vec![0.0]), Some(vec![last]));
        let mut animation =
            Animation { name: format!("{} {owner}", clip.name), channels: Vec::new(), samplers: Vec::new() };
        for number in 1..bones.len() {
            for (path, values, shape) in
                [(Path::Rotation, &turns[number], "VEC4"), (Path::Translation, &places[number], "VEC3")]
            {
                let output = Self::keys(writer, values, shape, count)?;
                let sampler = animation.samplers.len();
                animation.samplers.push(Sampler { input, output });
                animation
                    .channels
                    .push(Channel { sampler, target: Target { node: self.nodes[number], path } });
            }
        }
        if !animation.channels.is_empty() {
            writer.root.animations.push(animation);
        }
        Ok(())
    }

    fn keys(
        writer: &mut Writer<'_>,
        values: &[f32],
        shape: &'static str,
        count: usize,
    ) -> Result<usize, ExportError> {
        if values.iter().any(|value| !value.is_finite()) {
            return Err(ExportError::NotFinite);
        }
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let view = writer.whole_view(&bytes, None)?;
        Ok(writer.accessor(view, Attribute { offset: 0, component_type: FLOAT, shape }, false, count))
    }
}
