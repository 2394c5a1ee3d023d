//! What operations change, each thing written once however many operations hold it.

use std::{collections::BTreeMap, sync::Arc};

use espalier_growth::{Parameters, appearance::Appearance};
use glam::Quat;

use super::{DocumentError, Reader, Writer, damaged};
use crate::{
    document::{
        futures::Futures,
        history::{History, Setting},
        obstacles::Standings,
    },
    obstacle::{Form, Mesh, Obstacle, Pose, Standing},
};

/// All sets of parameters, looks, meshes and sets of obstacles of a document, by number.
#[derive(Debug, Default)]
pub(super) struct Shelf {
    parameters: Vec<Arc<Parameters>>,
    looks: Vec<Arc<Appearance>>,
    meshes: Vec<Arc<Mesh>>,
    sets: Vec<Standings>,
}

impl Shelf {
    /// Everything the history and the present hold.
    pub(super) fn of(history: &History, futures: &Futures, present: &Setting) -> Self {
        let mut shelf = Self::default();
        let ahead = futures.all.iter().flat_map(|future| &future.operations);
        let settings = history.operations.iter().chain(ahead).map(|operation| &operation.after);
        for setting in std::iter::once(&history.initial).chain(settings) {
            shelve(&mut shelf.parameters, &setting.parameters);
            shelve(&mut shelf.looks, &setting.appearance);
            shelf.shelve_set(&setting.obstacles);
        }
        shelve(&mut shelf.looks, &present.appearance);
        shelf.shelve_set(&present.obstacles);
        shelf
    }

    fn shelve_set(&mut self, set: &Standings) {
        if shelve(&mut self.sets, set) {
            for mesh in set.iter().filter_map(|standing| standing.obstacle.mesh()) {
                shelve(&mut self.meshes, mesh);
            }
        }
    }

    pub(super) fn write(&self, out: &mut Writer) {
        out.list(&self.parameters, |out, set| out.parameters(set));
        out.list(&self.looks, |out, looks| out.appearance(looks));
        out.list(&self.meshes, |out, mesh| out.list(&mesh.to_bytes(), |out, &byte| out.0.push(byte)));
        out.list(&self.sets, |out, set| out.list(set, |out, standing| self.write_standing(out, standing)));
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, DocumentError> {
        let parameters = reader.list(|r| Ok(Arc::new(r.parameters()?)))?;
        let looks = reader.list(|r| Ok(Arc::new(r.appearance()?)))?;
        let meshes = reader.list(|r| {
            let bytes = r.list(Reader::u8)?;
            Mesh::from_bytes(&bytes).map(Arc::new).map_err(|problem| damaged(problem.message))
        })?;
        let mut shelf = Self { parameters, looks, meshes, sets: Vec::new() };
        // An obstacle that was moved stands in many sets, but its mesh is made once.
        let mut forms = BTreeMap::new();
        shelf.sets = reader.list(|r| {
            let set = r.list(|r| shelf.read_standing(r, &mut forms))?;
            if !set.is_sorted_by(|a, b| a.id < b.id) {
                return Err(damaged("obstacles are out of order"));
            }
            Ok(Arc::new(set))
        })?;
        Ok(shelf)
    }

    pub(super) fn write_setting(&self, out: &mut Writer, setting: &Setting) {
        out.u32(number(&self.parameters, &setting.parameters));
        out.u32(self.set_number(&setting.obstacles));
        out.u32(self.looks_number(&setting.appearance));
    }

    pub(super) fn read_setting(&self, reader: &mut Reader<'_>) -> Result<Setting, DocumentError> {
        let parameters = self.parameters.get(reader.u32()? as usize).cloned();
        let parameters = parameters.ok_or_else(|| damaged("parameters are missing"))?;
        Ok(Setting { parameters, obstacles: self.read_set(reader)?, appearance: self.read_looks(reader)? })
    }

    pub(super) fn looks_number(&self, looks: &Arc<Appearance>) -> u32 {
        number(&self.looks, looks)
    }

    pub(super) fn read_looks(&self, reader: &mut Reader<'_>) -> Result<Arc<Appearance>, DocumentError> {
        self.looks.get(reader.u32()? as usize).cloned().ok_or_else(|| damaged("looks are missing"))
    }

    pub(super) fn set_number(&self, set: &Standings) -> u32 {
        number(&self.sets, set)
    }

    pub(super) fn read_set(&self, reader: &mut Reader<'_>) -> Result<Standings, DocumentError> {
        self.sets.get(reader.u32()? as usize).cloned().ok_or_else(|| damaged("obstacles are missing"))
    }

    fn write_standing(&self, out: &mut Writer, Standing { id, obstacle }: &Standing) {
        out.u32(*id);
        out.vector(obstacle.pose.position);
        obstacle.pose.rotation.to_array().into_iter().for_each(|c| out.f32(c));
        match &obstacle.form {
            Form::Box { size } => {
                out.0.push(0);
                out.vector(*size);
            }
            Form::Sphere { radius } => {
                out.0.push(1);
                out.f32(*radius);
            }
            Form::Plane => out.0.push(2),
            Form::Mesh { mesh, scale, .. } => {
                out.0.push(3);
                out.u32(number(&self.meshes, mesh));
                out.f32(*scale);
            }
        }
    }

    fn read_standing(
        &self,
        r: &mut Reader<'_>,
        forms: &mut BTreeMap<(u32, u32), Form>,
    ) -> Result<Standing, DocumentError> {
        let (id, position) = (r.u32()?, r.vector()?);
        let rotation = Quat::from_array([r.f32()?, r.f32()?, r.f32()?, r.f32()?]);
        let form = match r.u8()? {
            0 => Form::Box { size: r.vector()? },
            1 => Form::Sphere { radius: r.f32()? },
            2 => Form::Plane,
            3 => {
                let (number, scale) = (r.u32()?, r.f32()?);
                match forms.get(&(number, scale.to_bits())) {
                    Some(form) => form.clone(),
                    None => {
                        let mesh = self.meshes.get(number as usize).cloned();
                        let mesh = mesh.ok_or_else(|| damaged("a mesh is missing"))?;
                        let form = Form::mesh(mesh, scale).map_err(|problem| damaged(problem.message))?;
                        forms.insert((number, scale.to_bits()), form.clone());
                        form
                    }
                }
            }
            _ => return Err(damaged("an obstacle of unknown shape")),
        };
        let obstacle = Obstacle::new(form, Pose { position, rotation });
        Ok(Standing { id, obstacle: obstacle.map_err(|problem| damaged(problem.message))? })
    }
}

/// Puts a thing on the shelf unless it, the very same, is there; whether it was put.
fn shelve<T>(shelf: &mut Vec<Arc<T>>, thing: &Arc<T>) -> bool {
    // What is looked for was mostly put there last.
    let is_new = !shelf.iter().rev().any(|there| Arc::ptr_eq(there, thing));
    if is_new {
        shelf.push(Arc::clone(thing));
    }
    is_new
}

/// The number of a thing on the shelf; everything looked for was put there before.
fn number<T>(shelf: &[Arc<T>], thing: &Arc<T>) -> u32 {
    shelf.iter().rposition(|there| Arc::ptr_eq(there, thing)).unwrap_or(0) as u32
}
