//! A plant taken apart into plain columns, and put together again with every invariant checked.

use glam::Vec3;

use crate::{
    axes::Axes,
    checks,
    id::{AxisId, MetamerId},
    metamers::{Appearance, Metamers},
    plant::Plant,
    timeline::{StepEnd, Timeline},
};

/// Everything a plant's other columns follow from but how it looks, which whoever grows it knows. `u32::MAX` stands for none and for alive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlantParts {
    /// The present step.
    pub now: u32,
    /// Metamers, axes and losses at the end of each step recorded.
    pub ends: Vec<[u32; 3]>,
    /// Axes that were lost, in order.
    pub losses: Vec<u32>,
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
            ends: self.timeline.ends.iter().map(|e| [e.metamers, e.axes, e.losses]).collect(),
            losses: self.timeline.losses.iter().map(|id| id.raw()).collect(),
            parent: self.metamers.parent.iter().map(|id| id.raw()).collect(),
            axis: self.metamers.axis.iter().map(|id| id.raw()).collect(),
            death: self.metamers.death.clone(),
            end: self.metamers.end.clone(),
            normal: self.metamers.normal.clone(),
            bearer: self.axes.bearer.iter().map(|id| id.raw()).collect(),
            direction: self.axes.direction.clone(),
            axis_death: self.axes.death.clone(),
        }
    }

    /// Puts a plant together.
    pub fn from_parts(parts: PlantParts) -> Result<Self, BrokenPlant> {
        check_shape(&parts)?;
        let (metamers, axes) = (parts.parent.len(), parts.bearer.len());
        let mut order = Vec::with_capacity(axes);
        for &bearer in &parts.bearer {
            let below = (bearer != u32::MAX).then(|| order[parts.axis[bearer as usize] as usize]);
            order.push(below.map_or(0, |below: u32| below + 1));
        }
        let mut lateral = vec![AxisId::NONE; metamers];
        for (axis, &bearer) in
            parts.bearer.iter().enumerate().rev().filter(|(_, bearer)| **bearer != u32::MAX)
        {
            lateral[bearer as usize] = AxisId::new(axis);
        }
        let mut plant = Self {
            metamers: Metamers {
                parent: parts.parent.iter().map(|&raw| id_of(raw, MetamerId::NONE, MetamerId::new)).collect(),
                axis: parts.axis.iter().map(|&raw| AxisId::new(raw as usize)).collect(),
                death: parts.death,
                end: parts.end,
                normal: parts.normal,
                tips: vec![0; metamers],
                appearance: vec![Appearance::NEW; metamers],
                lateral,
            },
            axes: Axes {
                bearer: parts.bearer.iter().map(|&raw| id_of(raw, MetamerId::NONE, MetamerId::new)).collect(),
                first: vec![MetamerId::NONE; axes],
                last: vec![MetamerId::NONE; axes],
                direction: parts.direction,
                order,
                death: parts.axis_death,
            },
            timeline: Timeline {
                ends: (parts.ends.iter())
                    .map(|&[metamers, axes, losses]| StepEnd { metamers, axes, losses })
                    .collect(),
                losses: parts.losses.iter().map(|&raw| AxisId::new(raw as usize)).collect(),
                now: 0,
                recording: false,
            },
            living: 0,
        };
        plant.replay(parts.now);
        checks::all(&plant).map_err(|failure| BrokenPlant(failure.to_string()))?;
        Ok(plant)
    }
}

fn id_of<T>(raw: u32, none: T, new: impl Fn(usize) -> T) -> T {
    if raw == u32::MAX { none } else { new(raw as usize) }
}

/// Checks that every index points at an earlier row, so that nothing below can go out of bounds.
fn check_shape(parts: &PlantParts) -> Result<(), BrokenPlant> {
    let broken = |what: &str| Err(BrokenPlant(what.to_owned()));
    let (metamers, axes, losses) = (parts.parent.len(), parts.bearer.len(), parts.losses.len());
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
    if parts.ends.windows(2).any(|pair| (0..3).any(|i| pair[0][i] > pair[1][i])) {
        return broken("a step ends before it begins");
    }
    let last = parts.ends.last().map(|end| end.map(|n| n as usize));
    if last != Some([metamers, axes, losses]) {
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
    if parts.losses.iter().any(|&axis| axis as usize >= axes) {
        return broken("an axis was lost that never was");
    }
    // Every metamer grows from the bud of its axis: a seed founds it, others follow its last metamer or bearer.
    let mut last = vec![u32::MAX; axes];
    for (row, (&parent, &axis)) in parts.parent.iter().zip(&parts.axis).enumerate() {
        let tip = &mut last[axis as usize];
        let bearer = parts.bearer[axis as usize];
        let expected = if *tip == u32::MAX { bearer } else { *tip };
        if parent != expected {
            return broken("a metamer does not grow from the bud of its axis");
        }
        *tip = row as u32;
    }
    Ok(())
}
