//! A plant taken apart into plain columns, and put together again with every invariant checked.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::{
    axes::Axes,
    births::Births,
    chains::check_chains,
    checks,
    deaths::Deaths,
    edits::Edit,
    given::{GivenColumn, GivenValue, is_radius},
    id::{AxisId, MetamerId},
    metamers::{Condition, Metamers},
    organs::Organs,
    plant::Plant,
    timeline::{StepEnd, Timeline},
};

/// Everything a plant's other columns follow from but how it looks, which whoever grows it knows. `u32::MAX` stands for none and for alive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlantParts {
    /// The present step.
    pub now: u32,
    /// Metamers, axes, edits and steps of growth at the end of each step recorded.
    pub ends: Vec<[u32; 4]>,
    /// What was done to wood, in order.
    pub edits: Vec<Edit>,
    /// Width constraints of the present, those on dead metamers included: metamers and diameters.
    pub widths: Vec<(u32, f32)>,
    /// Radii given in the present, those of dead metamers included: rows in birth order, and radii.
    pub given_radii: Vec<(u32, f32)>,
    /// Organs given in the present, those of dead metamers included: rows in birth order, and organs.
    pub given_organs: Vec<(u32, Organs)>,
    /// Each metamer's parent.
    pub parent: Vec<u32>,
    /// Each metamer's axis.
    pub axis: Vec<u32>,
    /// Each metamer's step of death.
    pub death: Vec<u32>,
    /// Each metamer's node.
    pub end: Vec<Vec3>,
    /// Each metamer's normal.
    pub normal: Vec<Vec3>,
    /// The metamer that bears each axis.
    pub bearer: Vec<u32>,
    /// Each bud's direction.
    pub direction: Vec<Vec3>,
    /// Each axis' step of death.
    pub axis_death: Vec<u32>,
}

/// Parts do not fit together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the plant is broken: {0}")]
pub struct BrokenPlant(pub String);

impl Plant {
    /// Takes a copy apart.
    pub fn to_parts(&self) -> PlantParts {
        PlantParts {
            now: self.timeline.now,
            ends: to_ends(&self.timeline.ends),
            edits: self.timeline.edits.clone(),
            widths: self.widths.iter().map(|(id, &diameter)| (id.raw(), diameter)).collect(),
            given_radii: (self.metamers.given_radius.rows())
                .map(|(row, &radius)| (row as u32, radius))
                .collect(),
            given_organs: (self.metamers.given_organs.rows())
                .filter_map(|(row, organs)| Some((row as u32, organs.clone()?)))
                .collect(),
            parent: self.metamers.parent.iter().map(|id| id.raw()).collect(),
            axis: self.metamers.axis.iter().map(|id| id.raw()).collect(),
            death: self.metamers.death.to_rows(self.metamers.parent.len()),
            end: self.metamers.end.clone(),
            normal: self.metamers.normal.clone(),
            bearer: self.axes.bearer.iter().map(|id| id.raw()).collect(),
            direction: self.axes.direction.clone(),
            axis_death: self.axes.death.to_rows(self.axes.bearer.len()),
        }
    }

    /// Puts a plant together.
    pub fn from_parts(parts: PlantParts) -> Result<Self, BrokenPlant> {
        let lateral = check_shape(&parts)?;
        let (metamers, axes) = (parts.parent.len(), parts.bearer.len());
        let mut order = Vec::with_capacity(axes);
        for &bearer in &parts.bearer {
            let below = (bearer != u32::MAX).then(|| order[parts.axis[bearer as usize] as usize]);
            order.push(below.map_or(0, |below: u16| below.saturating_add(1)));
        }
        let mut plant = Self {
            metamers: Metamers {
                parent: parts.parent.iter().map(|&raw| id_of(raw, MetamerId::NONE, MetamerId::new)).collect(),
                axis: parts.axis.iter().map(|&raw| AxisId::new(raw as usize)).collect(),
                death: Deaths::from_rows(parts.death),
                end: parts.end,
                normal: parts.normal,
                tips: vec![0; metamers],
                condition: vec![Condition::NEW; metamers],
                lateral,
                given_radius: GivenColumn::from_rows(parts.given_radii),
                given_organs: GivenColumn::from_rows(
                    parts.given_organs.into_iter().map(|(row, organs)| (row, Some(organs))),
                ),
            },
            axes: Axes {
                bearer: parts.bearer.iter().map(|&raw| id_of(raw, MetamerId::NONE, MetamerId::new)).collect(),
                first: vec![MetamerId::NONE; axes],
                last: vec![MetamerId::NONE; axes],
                direction: parts.direction,
                order,
                death: Deaths::from_rows(parts.axis_death),
            },
            timeline: Timeline {
                ends: from_ends(&parts.ends),
                edits: parts.edits,
                now: 0,
                recording: false,
                grows: false,
            },
            grafts: BTreeMap::new(),
            widths: (parts.widths.iter())
                .map(|&(raw, diameter)| (MetamerId::new(raw as usize), diameter))
                .collect(),
            living: 0,
        };
        plant.replay(parts.now);
        checks::all(&plant).map_err(|failure| BrokenPlant(failure.to_string()))?;
        Ok(plant)
    }
}

pub(crate) fn id_of<T>(raw: u32, none: T, new: impl Fn(usize) -> T) -> T {
    if raw == u32::MAX { none } else { new(raw as usize) }
}

pub(crate) fn to_ends(ends: &[StepEnd]) -> Vec<[u32; 4]> {
    ends.iter().map(|e| [e.metamers, e.axes, e.edits, e.growths]).collect()
}

pub(crate) fn from_ends(ends: &[[u32; 4]]) -> Vec<StepEnd> {
    let end = |&[metamers, axes, edits, growths]: &[u32; 4]| StepEnd { metamers, axes, edits, growths };
    ends.iter().map(end).collect()
}

/// Checks that every index points at an earlier row, so that nothing below can go out of bounds. Returns the first
/// lateral axis of each metamer.
fn check_shape(parts: &PlantParts) -> Result<Vec<AxisId>, BrokenPlant> {
    let broken = |what: &str| Err(BrokenPlant(what.to_owned()));
    let (metamers, axes, edits) = (parts.parent.len(), parts.bearer.len(), parts.edits.len());
    let columns = [
        (parts.axis.len(), metamers),
        (parts.death.len(), metamers),
        (parts.end.len(), metamers),
        (parts.normal.len(), metamers),
        (parts.direction.len(), axes),
        (parts.axis_death.len(), axes),
    ];
    if columns.iter().any(|(len, wanted)| len != wanted) {
        return broken("columns differ in length");
    }
    if parts.now as usize >= parts.ends.len() {
        return broken("the present step is not recorded");
    }
    if parts.ends.windows(2).any(|pair| (0..4).any(|i| pair[0][i] > pair[1][i])) {
        return broken("a step ends before it begins");
    }
    let last = parts.ends.last().map(|end| end.map(|n| n as usize));
    if last.map(|end| [end[0], end[1], end[2]]) != Some([metamers, axes, edits]) {
        return broken("the last step does not end at the last row");
    }
    if parts.parent.iter().enumerate().any(|(row, &parent)| parent != u32::MAX && parent as usize >= row) {
        return broken("a metamer stands before its parent");
    }
    if parts.axis.iter().any(|&axis| axis as usize >= axes) {
        return broken("a metamer belongs to no axis");
    }
    // A bud's bearer must belong to an axis before it, or the order of branching has no beginning.
    let bearer_is_bad = |(axis, &bearer): (usize, &u32)| {
        bearer != u32::MAX && (bearer as usize >= metamers || parts.axis[bearer as usize] as usize >= axis)
    };
    if parts.bearer.iter().enumerate().any(bearer_is_bad) {
        return broken("an axis is borne by nothing before it");
    }
    if parts.widths.iter().any(|&(row, diameter)| row as usize >= metamers || !is_radius(diameter)) {
        return broken("a width constraint is on nothing");
    }
    let is_held = |&(row, radius): &(u32, f32)| row < parts.ends[parts.now as usize][0] && is_radius(radius);
    if !parts.given_radii.is_sorted_by(|a, b| a.0 < b.0) || !parts.given_radii.iter().all(is_held) {
        return broken("a radius is given to nothing");
    }
    let bears = |(row, organs): &(u32, Organs)| {
        *row < parts.ends[parts.now as usize][0] && Some(organs.clone()).is_sound()
    };
    if !parts.given_organs.is_sorted_by(|a, b| a.0 < b.0) || !parts.given_organs.iter().all(bears) {
        return broken("organs are given to nothing");
    }
    let ends: Vec<[u32; 4]> = std::iter::once([0; 4]).chain(parts.ends.iter().copied()).collect();
    let births = Births {
        ends: &ends,
        edits: &parts.edits,
        parent: |row| parts.parent[row as usize],
        axis: |row| parts.axis[row as usize],
        bearer: |axis| parts.bearer[axis as usize],
    };
    let laterals = births.laterals()?;
    let Births { parent, axis, bearer, .. } = births;
    check_chains(&ends, &parts.edits, vec![[u32::MAX; 2]; axes], parent, axis, bearer)?;
    Ok(laterals)
}

/// Checks that an edit of a step concerns what is there by then; `parent`, `axis` and `bearer` give raw rows.
pub(crate) fn check_edit(
    edit: &Edit,
    before: [u32; 4],
    end: [u32; 4],
    parent: impl Fn(MetamerId) -> u32,
    axis: impl Fn(MetamerId) -> u32,
    bearer: impl Fn(AxisId) -> u32,
) -> Result<(), BrokenPlant> {
    let is_wood = |id: MetamerId| id.raw() < before[0];
    let holds = match edit {
        Edit::Shed(axis) => axis.raw() < before[1],
        Edit::Pruned(cut) => is_wood(*cut) && parent(*cut) != u32::MAX,
        Edit::Grafted(axis) => {
            let is_new = (before[1]..end[1]).contains(&axis.raw());
            is_new && bearer(*axis) != u32::MAX
        }
        Edit::Carried(carried) => carried.is_sound([before[0], before[1]]),
        // A graft brings scars and constraints along.
        Edit::Scarred(id, _) => (before[0]..end[0]).contains(&id.raw()),
        Edit::Width(id, diameter) => id.raw() < end[0] && diameter.is_none_or(is_radius),
        Edit::Given(given) => given.is_sound(end[0]),
        Edit::Borne(given) => given.is_sound(end[0]),
        Edit::Resettled(resettled) => {
            let is_alone = [end[0], end[1], end[2]] == [before[0], before[1], before[2] + 1];
            is_alone && resettled.is_sound([before[0], before[1]], parent, axis)
        }
    };
    if holds { Ok(()) } else { Err(BrokenPlant("an edit concerns what is not there".to_owned())) }
}
