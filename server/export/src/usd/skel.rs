//! Skeletons, skins and their animation: how a plant sways.

use std::io::{self, Write};

use espalier_motion::{
    Bound, Rig,
    clips::{Clip, KEYS_A_SECOND},
};
use glam::{DMat3, DQuat, DVec3, Vec3};

use super::arrays::{Array, joined};
use crate::{
    ExportError,
    swaying::{Local, Rider, Swaying},
};

/// Parts in which the shares of bones are written; they add up to one.
const PARTS: f64 = 1000.0;

/// The bones of the plant whose parts are being written.
pub(super) struct Skeleton<'s> {
    swaying: &'s Swaying,
    rig: Rig,
    path: String,
    /// Where the plant stands, in internodes: its bones are measured from there.
    pub origin: Vec3,
}

/// What the head of a layer says of time.
pub(super) fn time(swaying: &Swaying) -> String {
    let [sway, _] = &swaying.clips;
    format!(
        "    endTimeCode = {}\n    framesPerSecond = {KEYS_A_SECOND}\n    startTimeCode = 0\n    \
         timeCodesPerSecond = {KEYS_A_SECOND}\n",
        sway.keys.len() - 1
    )
}

impl<'s> Skeleton<'s> {
    /// Writes bones at a path below the prim that is open, with the loop that moves them; `metres` has an internode.
    pub(super) fn begin(
        out: &mut dyn Write,
        swaying: &'s Swaying,
        rig: Rig,
        path: String,
        (origin, metres): (Vec3, f32),
    ) -> Result<Self, ExportError> {
        let from = (origin * metres).as_dvec3();
        let mut names: Vec<String> = Vec::with_capacity(rig.bones().len());
        for (number, bone) in rig.bones().iter().enumerate() {
            names.push(match bone.parent {
                None => "Ground".to_owned(),
                Some(parent) => format!("{}/Bone_{number}", names[parent as usize]),
            });
        }
        let name = path.rsplit('/').next().unwrap_or_default();
        writeln!(out, "def Skeleton \"{name}\" (\nprepend apiSchemas = [\"SkelBindingAPI\"]\n)\n{{")?;
        joints(&names, out)?;
        let mut array = Array::begin(&mut *out, "uniform matrix4d[] bindTransforms")?;
        rig.bones().iter().try_for_each(|bone| array.put(moved(bone.rest - from)))?;
        array.end("")?;
        let mut array = Array::begin(&mut *out, "uniform matrix4d[] restTransforms")?;
        let rest = swaying.locals(&rig, swaying.rest());
        for (bone, Local { turn, place }) in rig.bones().iter().zip(rest) {
            let from = if bone.parent.is_none() { from } else { DVec3::ZERO };
            array.put(turned(turn, place - from))?;
        }
        array.end("")?;
        let [sway, _] = &swaying.clips;
        writeln!(out, "rel skel:animationSource = <{path}/{}>", sway.name)?;
        let skeleton = Self { swaying, rig, path, origin };
        skeleton.animate(sway, &names, from, out)?;
        writeln!(out, "}}")?;
        Ok(skeleton)
    }

    /// Says that a mesh that is measured from a place goes along with the bones.
    pub(super) fn bind(&self, origin: Vec3, metres: f32, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "rel skel:skeleton = <{}>", self.path)?;
        let from = ((origin - self.origin) * metres).as_dvec3();
        writeln!(out, "matrix4d primvars:skel:geomBindTransform = {}", moved(from))
    }

    /// The bones of a vertex and their shares, which add up to one.
    pub(super) fn bound(&self, rider: Rider) -> ([u32; 2], [f32; 2]) {
        let Bound { bones, share } = self.rig.bound(&self.swaying.joints, rider.row, f64::from(rider.share));
        let second = (share * PARTS).round();
        (bones, [PARTS - second, second].map(|parts| (parts / PARTS) as f32))
    }

    fn animate(
        &self,
        clip: &Clip,
        names: &[String],
        from: DVec3,
        out: &mut dyn Write,
    ) -> Result<(), ExportError> {
        writeln!(out, "def SkelAnimation \"{}\"\n{{", clip.name)?;
        joints(names, out)?;
        let stands: Vec<Vec<Local>> =
            clip.keys.iter().map(|key| self.swaying.locals(&self.rig, key)).collect();
        writeln!(out, "float3[] translations.timeSamples = {{")?;
        for (key, stands) in stands.iter().enumerate() {
            let mut array = Array::begin_key(&mut *out, key)?;
            for (stand, bone) in stands.iter().zip(self.rig.bones()) {
                // What stands on nothing else is measured from where the plant does.
                let from = if bone.parent.is_none() { from } else { DVec3::ZERO };
                array.vector(&(stand.place - from).as_vec3().to_array())?;
            }
            array.end(",")?;
        }
        writeln!(out, "}}\nquatf[] rotations.timeSamples = {{")?;
        for (key, stands) in stands.iter().enumerate() {
            let mut array = Array::begin_key(&mut *out, key)?;
            for stand in stands {
                let [x, y, z, w] = stand.turn.to_array().map(|part| part as f32);
                array.vector(&[w, x, y, z])?;
            }
            array.end(",")?;
        }
        writeln!(out, "}}")?;
        let mut array = Array::begin(&mut *out, "half3[] scales")?;
        names.iter().try_for_each(|_| array.vector(&[1.0; 3]))?;
        array.end("")?;
        Ok(writeln!(out, "}}")?)
    }
}

fn joints(names: &[String], out: &mut dyn Write) -> Result<(), ExportError> {
    let mut array = Array::begin(out, "uniform token[] joints")?;
    names.iter().try_for_each(|name| array.put(format_args!("\"{name}\"")))?;
    array.end("")
}

/// The matrix that turns and then moves by so many metres, for vectors that are written as rows.
fn turned(turn: DQuat, by: DVec3) -> String {
    let columns = DMat3::from_quat(turn).to_cols_array_2d();
    let row = |part: [f64; 3]| joined(&DVec3::from_array(part).as_vec3().extend(0.0).to_array());
    let [x, y, z] = columns.map(row);
    format!("({x}, {y}, {z}, {})", joined(&by.as_vec3().extend(1.0).to_array()))
}

/// The matrix that moves by so many metres.
fn moved(by: DVec3) -> String {
    format!("((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), {})", joined(&by.as_vec3().extend(1.0).to_array()))
}
