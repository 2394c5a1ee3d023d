//! What operations change, each thing written once however many operations hold it.

use std::{collections::BTreeMap, sync::Arc};

use espalier_growth::Parameters;
use espalier_settings::{Appearance, AppearancePatch, ParameterValues, ParametersPatch};
use serde::{Serialize, de::DeserializeOwned};

use super::{
    DocumentError, damaged,
    fields::{Reader, Writer},
    later,
};
use crate::{
    appearance::AppearanceChange,
    document::{
        futures::Futures,
        history::{History, MAX_SETS, Setting},
        obstacles::{Obstacles, Standings},
    },
    obstacle::{Form, Mesh, Obstacle, Placement, Standing},
    schedule::GrowthSchedule,
};

/// Sets of a kind: one to each change of it, and again where a line of time was left with another one in force.
pub(super) const MOST: usize = 2 * MAX_SETS;

/// All sets of parameters, looks, meshes and sets of obstacles of a document, by number.
#[derive(Debug, Default)]
pub(super) struct Pool {
    schedules: Vec<Arc<GrowthSchedule>>,
    looks: Vec<Arc<Appearance>>,
    meshes: Vec<Arc<Mesh>>,
    sets: Vec<Standings>,
}

impl Pool {
    /// Everything the history and the present hold.
    pub(super) fn of(history: &History, futures: &Futures, present: &Setting) -> Self {
        let mut pool = Self::default();
        let ahead = futures.all.iter().flat_map(|future| &future.operations);
        let settings = history.operations.iter().chain(ahead).map(|operation| &operation.after);
        for setting in std::iter::once(&history.initial).chain(settings) {
            add(&mut pool.schedules, &setting.schedule);
            add(&mut pool.looks, &setting.appearance);
            pool.add_set(&setting.obstacles);
        }
        if present.schedule.programme().is_some() {
            add(&mut pool.schedules, &present.schedule);
        }
        add(&mut pool.looks, &present.appearance);
        pool.add_set(&present.obstacles);
        pool
    }

    fn add_set(&mut self, set: &Standings) {
        if add(&mut self.sets, set) {
            for mesh in set.iter().filter_map(|standing| standing.obstacle.mesh()) {
                add(&mut self.meshes, mesh);
            }
        }
    }

    /// A pool of what was read.
    pub(super) fn new(
        schedules: Vec<Arc<GrowthSchedule>>,
        looks: Vec<Arc<Appearance>>,
        sets: Vec<Standings>,
    ) -> Self {
        Self { schedules, looks, meshes: Vec::new(), sets }
    }

    /// What each schedule sets: all parameters, or those that go before its programme.
    pub(super) fn write_parameters(&self, out: &mut Writer) {
        out.list(&self.schedules, |out, schedule| write_json(out, schedule.by_hand()));
    }

    /// All schedules.
    pub(super) fn schedules(&self) -> &[Arc<GrowthSchedule>] {
        &self.schedules
    }

    pub(super) fn has_programmes(&self) -> bool {
        self.schedules.iter().any(|schedule| schedule.programme().is_some())
    }

    /// The schedule with this number.
    pub(super) fn schedule(&self, number: u32) -> Result<Arc<GrowthSchedule>, DocumentError> {
        numbered(&self.schedules, number, "parameters")
    }

    /// All looks, and the number of the present ones.
    pub(super) fn write_looks(&self, out: &mut Writer, present: &Arc<Appearance>) {
        out.list(&self.looks, |out, looks| write_json(out, &**looks));
        out.u32(number(&self.looks, present));
    }

    /// All meshes and sets of obstacles, the number of the present one, and how many were ever placed.
    pub(super) fn write_obstacles(&self, out: &mut Writer, present: &Obstacles) {
        out.list(&self.meshes, |out, mesh| out.bytes(&mesh.to_bytes()));
        out.list(&self.sets, |out, set| out.list(set, |out, standing| self.write_standing(out, standing)));
        out.u32(number(&self.sets, &present.standing));
        out.u32(present.placed);
    }

    pub(super) fn write_setting(&self, out: &mut Writer, setting: &Setting) {
        out.u32(number(&self.schedules, &setting.schedule));
        out.u32(number(&self.sets, &setting.obstacles));
        out.u32(number(&self.looks, &setting.appearance));
    }

    pub(super) fn read_setting(&self, reader: &mut Reader<'_>) -> Result<Setting, DocumentError> {
        Ok(Setting {
            schedule: self.schedule(reader.u32()?)?,
            obstacles: self.standing(reader.u32()?)?,
            appearance: self.look(reader.u32()?)?,
            // Designs stand in a section of their own.
            design: None,
            let_go: Arc::default(),
        })
    }

    /// The look with this number.
    pub(super) fn look(&self, number: u32) -> Result<Arc<Appearance>, DocumentError> {
        numbered(&self.looks, number, "looks")
    }

    /// The set of obstacles with this number.
    pub(super) fn standing(&self, number: u32) -> Result<Standings, DocumentError> {
        numbered(&self.sets, number, "obstacles")
    }

    fn write_standing(&self, out: &mut Writer, Standing { id, obstacle }: &Standing) {
        out.u32(*id);
        out.vector(obstacle.placement.position);
        out.rotation(obstacle.placement.rotation);
        match &obstacle.form {
            Form::Box { size } => {
                out.u8(0);
                out.vector(*size);
            }
            Form::Sphere { radius } => {
                out.u8(1);
                out.f32(*radius);
            }
            Form::Plane => out.u8(2),
            Form::Mesh { mesh, scale, .. } => {
                out.u8(3);
                out.u32(number(&self.meshes, mesh));
                out.f32(*scale);
            }
        }
    }
}

/// A value as JSON.
pub(super) fn write_json(out: &mut Writer, value: &impl Serialize) {
    // Plain numbers, switches and names always have a JSON form.
    out.text(&serde_json::to_string(value).unwrap_or_default());
}

/// One set of parameters, as JSON: what a document does not name has its default.
pub(super) fn read_set(reader: &mut Reader<'_>) -> Result<Parameters, DocumentError> {
    let patch = read_json(reader)?;
    Parameters::new(ParameterValues::default().patched(&patch)).map_err(|error| damaged(error.to_string()))
}

pub(super) fn read_parameters(reader: &mut Reader<'_>) -> Result<Vec<ParametersPatch>, DocumentError> {
    reader.up_to(1)?;
    reader.list_up_to(MOST, read_json)
}

pub(super) fn read_looks(reader: &mut Reader<'_>) -> Result<Vec<Arc<Appearance>>, DocumentError> {
    reader.up_to(1)?;
    reader.list_up_to(MOST, |r| {
        let patch: AppearancePatch = read_json(r)?;
        let change = AppearanceChange::parse(&patch).map_err(|problem| damaged(problem.message))?;
        Ok(Arc::new(change.applied_to(&Appearance::default())))
    })
}

/// All sets of obstacles.
pub(super) fn read_obstacles(reader: &mut Reader<'_>) -> Result<Vec<Standings>, DocumentError> {
    reader.up_to(1)?;
    let meshes = reader
        .list(|r| Mesh::from_bytes(r.bytes()?).map(Arc::new).map_err(|fault| damaged(fault.to_string())))?;
    // An obstacle that was moved stands in many sets, but its mesh is made once.
    let mut forms = BTreeMap::new();
    reader.list_up_to(MOST, |r| {
        let set = r.list(|r| read_standing(r, &meshes, &mut forms))?;
        if !set.is_sorted_by(|a, b| a.id < b.id) {
            return Err(damaged("obstacles are out of order"));
        }
        Ok(Arc::new(set))
    })
}

fn read_standing(
    r: &mut Reader<'_>,
    meshes: &[Arc<Mesh>],
    forms: &mut BTreeMap<(u32, u32), Form>,
) -> Result<Standing, DocumentError> {
    let (id, position, rotation) = (r.u32()?, r.vector()?, r.rotation()?);
    let form = match r.u8()? {
        0 => Form::Box { size: r.vector()? },
        1 => Form::Sphere { radius: r.f32()? },
        2 => Form::Plane,
        3 => {
            let (number, scale) = (r.u32()?, r.f32()?);
            match forms.get(&(number, scale.to_bits())) {
                Some(form) => form.clone(),
                None => {
                    let mesh = numbered(meshes, number, "meshes")?;
                    let form = Form::mesh(mesh, scale).map_err(|problem| damaged(problem.message))?;
                    forms.insert((number, scale.to_bits()), form.clone());
                    form
                }
            }
        }
        _ => return Err(damaged("an obstacle of unknown shape")),
    };
    let obstacle = Obstacle::new(form, Placement { position, rotation });
    Ok(Standing { id, obstacle: obstacle.map_err(|problem| damaged(problem.message))? })
}

/// A value from JSON. Names that are not known are those of a later version: parameters and looks are added without
/// another version of their section.
pub(super) fn read_json<T: DeserializeOwned>(reader: &mut Reader<'_>) -> Result<T, DocumentError> {
    serde_json::from_str(reader.text()?).map_err(|error| {
        let sentence = error.to_string();
        // What would be known fills a page.
        let fault = sentence.split(", expected").next().unwrap_or_default();
        if fault.starts_with("unknown ") { later(fault) } else { damaged(sentence) }
    })
}

/// Adds a value unless it, the very same, is there; whether it was added.
fn add<T>(pool: &mut Vec<Arc<T>>, value: &Arc<T>) -> bool {
    // What is looked for was mostly put there last.
    let is_new = !pool.iter().rev().any(|there| Arc::ptr_eq(there, value));
    if is_new {
        pool.push(Arc::clone(value));
    }
    is_new
}

/// The number of a value in the pool; everything looked for was put there before.
pub(super) fn number<T>(pool: &[Arc<T>], value: &Arc<T>) -> u32 {
    pool.iter().rposition(|there| Arc::ptr_eq(there, value)).unwrap_or(0) as u32
}

/// The value with a number.
fn numbered<T>(pool: &[Arc<T>], number: u32, name: &str) -> Result<Arc<T>, DocumentError> {
    let value = pool.get(number as usize).cloned();
    value.ok_or_else(|| damaged(format!("{name} of number {number} are missing")))
}
