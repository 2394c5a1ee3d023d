//! What holds of parameters, looks and obstacles, field by field: what the last deed in force says that changed the field
//! (`UD5`).

use std::{collections::BTreeMap, sync::Arc};

use espalier_proto::Problem;
use espalier_settings::{Appearance, ParametersPatch};
use serde::Serialize;
use serde_json::Value;

use super::{
    designing::{fold_design, let_go_after},
    history::{History, Setting},
    obstacles::Standings,
};
use crate::{obstacle::Standing, schedule::GrowthSchedule};

impl History {
    /// The setting that the deeds in force come to. Where that is the present one it is the very same.
    pub(super) fn folded(&self, present: &Setting) -> Result<Setting, Problem> {
        let mut folded = self.initial.clone();
        let mut before = &self.initial;
        let away = self.away();
        for (operation, away) in self.operations[..self.done].iter().zip(away) {
            let after = &operation.after;
            if !away && !operation.kind.is_switch() {
                let design =
                    fold_design(folded.design.clone(), before.design.as_ref(), after.design.as_ref());
                folded = Setting {
                    let_go: let_go_after(&folded.let_go, folded.design.as_ref(), design.as_ref()),
                    design,
                    schedule: fold_schedule(folded.schedule, &before.schedule, &after.schedule)?,
                    obstacles: fold_obstacles(folded.obstacles, &before.obstacles, &after.obstacles),
                    appearance: fold_looks(folded.appearance, &before.appearance, &after.appearance),
                };
            }
            before = after;
        }
        if folded.schedule == present.schedule {
            folded.schedule = Arc::clone(&present.schedule);
        }
        if folded.obstacles == present.obstacles {
            folded.obstacles = Arc::clone(&present.obstacles);
        }
        if folded.appearance == present.appearance {
            folded.appearance = Arc::clone(&present.appearance);
        }
        if folded.design == present.design {
            folded.design.clone_from(&present.design);
        }
        if folded.let_go == present.let_go {
            folded.let_go = Arc::clone(&present.let_go);
        }
        Ok(folded)
    }
}

/// A schedule with what another one changed of that before it.
fn fold_schedule(
    folded: Arc<GrowthSchedule>,
    before: &Arc<GrowthSchedule>,
    after: &Arc<GrowthSchedule>,
) -> Result<Arc<GrowthSchedule>, Problem> {
    if before == after {
        return Ok(folded);
    }
    if folded == *before {
        return Ok(Arc::clone(after));
    }
    let plan = if before.plan() == after.plan() { folded.plan() } else { after.plan() };
    let (was, is) = (before.by_hand(), after.by_hand());
    let names = changed(was, is);
    // Those that sum to 1 are set together.
    let sets_weight = names.iter().any(|name| GrowthSchedule::is_weight(name));
    let is_changed =
        |name: &str| names.iter().any(|one| one == name) || sets_weight && GrowthSchedule::is_weight(name);
    let by_hand = folded.by_hand().only(|name| !is_changed(name)).patched(&is.only(is_changed));
    Ok(Arc::new(GrowthSchedule::new(plan.cloned(), &by_hand)?))
}

/// The names of the parameters that two patches set otherwise.
fn changed(was: &ParametersPatch, is: &ParametersPatch) -> Vec<String> {
    let (Value::Object(was), Value::Object(is)) = (to_value(was), to_value(is)) else { return Vec::new() };
    let names = was.keys().chain(is.keys()).filter(|&name| was.get(name) != is.get(name));
    names.cloned().collect()
}

/// Looks with what others changed of those before them.
fn fold_looks(folded: Arc<Appearance>, before: &Arc<Appearance>, after: &Arc<Appearance>) -> Arc<Appearance> {
    if before == after {
        return folded;
    }
    let mut value = to_value(&*folded);
    fold_value(&mut value, &to_value(&**before), &to_value(&**after));
    // Each field is one of looks that were in range.
    serde_json::from_value(value).map_or(folded, Arc::new)
}

fn to_value(settings: &impl Serialize) -> Value {
    serde_json::to_value(settings).unwrap_or_default()
}

fn fold_value(folded: &mut Value, before: &Value, after: &Value) {
    match (folded, before, after) {
        (Value::Object(folded), Value::Object(before), Value::Object(after)) => {
            for (name, after) in after {
                if let (Some(folded), Some(before)) = (folded.get_mut(name), before.get(name)) {
                    fold_value(folded, before, after);
                }
            }
        }
        (folded, before, after) if before != after => *folded = after.clone(),
        _ => {}
    }
}

/// Obstacles with what others changed of those before them, obstacle by obstacle.
fn fold_obstacles(folded: Standings, before: &Standings, after: &Standings) -> Standings {
    if Arc::ptr_eq(before, after) {
        return folded;
    }
    let by_id = |standings: &Standings| -> BTreeMap<u32, Standing> {
        standings.iter().map(|standing| (standing.id, standing.clone())).collect()
    };
    let (mut all, before, after) = (by_id(&folded), by_id(before), by_id(after));
    for id in before.keys().chain(after.keys()) {
        match after.get(id) {
            is if is == before.get(id) => {}
            Some(is) => drop(all.insert(*id, is.clone())),
            None => drop(all.remove(id)),
        }
    }
    Arc::new(all.into_values().collect())
}
