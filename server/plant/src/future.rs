//! Futures that were gone back from: what lay ahead of the present, kept apart so that another future can be
//! lived, and this one be taken up again.

use glam::Vec3;

use crate::{
    axes::{Axes, stored_order},
    births::Births,
    chains::check_chains,
    deaths::Deaths,
    edits::Edit,
    given::{GivenOrgans, GivenRadii},
    id::{AxisId, MetamerId},
    metamers::{Condition, Metamers},
    parts::{BrokenPlant, from_ends, id_of, to_ends},
    plant::Plant,
    timeline::StepEnd,
};

/// Everything that was recorded beyond one step of a plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Future {
    /// Where it begins.
    pub(crate) from: StepEnd,
    pub(crate) step: u32,
    pub(crate) metamers: Metamers,
    pub(crate) axes: Axes,
    pub(crate) ends: Vec<StepEnd>,
    pub(crate) edits: Vec<Edit>,
    /// Metamers of the present that die in it, and when.
    pub(crate) deaths: Vec<(MetamerId, u32)>,
    /// Axes of the present whose buds die in it, and when.
    pub(crate) axis_deaths: Vec<(AxisId, u32)>,
}

impl Future {
    /// The step it begins after.
    pub fn step(&self) -> u32 {
        self.step
    }

    /// How many steps it has.
    pub fn steps(&self) -> u32 {
        self.ends.len() as u32
    }

    /// Metamers it holds.
    pub fn metamers(&self) -> usize {
        self.metamers.parent.len()
    }

    /// Metamers of before it that die in it, and those that fall and rise.
    pub fn dying(&self) -> usize {
        let resettled = |edit: &Edit| if let Edit::Resettled(edit) = edit { edit.metamers.len() } else { 0 };
        self.deaths.len() + self.edits.iter().map(resettled).sum::<usize>()
    }
}

/// A future as plain columns; `u32::MAX` stands for none and for alive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FutureParts {
    /// The step it begins after.
    pub step: u32,
    /// Metamers, axes, edits and steps of growth where it begins, and at the end of each of its steps.
    pub ends: Vec<[u32; 4]>,
    /// What was done to wood, in order.
    pub edits: Vec<Edit>,
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
    /// The first of the lateral axes that each metamer lays down.
    pub lateral: Vec<u32>,
    /// The metamer that bears each axis.
    pub bearer: Vec<u32>,
    /// Each bud's direction.
    pub direction: Vec<Vec3>,
    /// Each axis' branching order.
    pub order: Vec<u32>,
    /// Each axis' step of death.
    pub axis_death: Vec<u32>,
    /// Rows of metamers that were there before and die in it, and their steps of death.
    pub deaths: Vec<(u32, u32)>,
    /// The same of axes.
    pub axis_deaths: Vec<(u32, u32)>,
}

impl Future {
    /// What was done to wood in it, in order.
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// Takes a copy apart.
    pub fn to_parts(&self) -> FutureParts {
        let (m, a) = (&self.metamers, &self.axes);
        let ends: Vec<StepEnd> = std::iter::once(self.from).chain(self.ends.iter().copied()).collect();
        FutureParts {
            step: self.step,
            ends: to_ends(&ends),
            edits: self.edits.clone(),
            parent: m.parent.iter().map(|id| id.raw()).collect(),
            axis: m.axis.iter().map(|id| id.raw()).collect(),
            death: m.death.to_rows(m.parent.len()),
            end: m.end.clone(),
            normal: m.normal.clone(),
            lateral: m.lateral.iter().map(|id| id.raw()).collect(),
            bearer: a.bearer.iter().map(|id| id.raw()).collect(),
            direction: a.direction.clone(),
            order: a.order.iter().map(|&order| u32::from(order)).collect(),
            axis_death: a.death.to_rows(a.bearer.len()),
            deaths: self.deaths.iter().map(|&(id, step)| (id.raw(), step)).collect(),
            axis_deaths: self.axis_deaths.iter().map(|&(id, step)| (id.raw(), step)).collect(),
        }
    }

    /// Puts a future together. Whether it fits a plant is seen when it is [taken](Plant::take_future).
    pub fn from_parts(parts: FutureParts) -> Result<Self, BrokenPlant> {
        let (metamers, axes) = (parts.parent.len(), parts.bearer.len());
        let columns =
            [parts.axis.len(), parts.death.len(), parts.end.len(), parts.normal.len(), parts.lateral.len()];
        let axis_columns = [parts.direction.len(), parts.order.len(), parts.axis_death.len()];
        if columns.iter().any(|&len| len != metamers) || axis_columns.iter().any(|&len| len != axes) {
            return Err(broken("the columns of a future differ in length"));
        }
        let mut ends = from_ends(&parts.ends).into_iter();
        let from = ends.next().ok_or_else(|| broken("a future begins nowhere"))?;
        let metamer = |raw: u32| id_of(raw, MetamerId::NONE, MetamerId::new);
        let axis = |raw: u32| id_of(raw, AxisId::NONE, AxisId::new);
        Ok(Self {
            from,
            step: parts.step,
            metamers: Metamers {
                parent: parts.parent.into_iter().map(metamer).collect(),
                axis: parts.axis.into_iter().map(axis).collect(),
                death: Deaths::from_rows(parts.death),
                end: parts.end,
                normal: parts.normal,
                tips: vec![0; metamers],
                condition: vec![Condition::NEW; metamers],
                lateral: parts.lateral.into_iter().map(axis).collect(),
                given_radius: GivenRadii::default(),
                given_organs: GivenOrgans::default(),
            },
            axes: Axes {
                bearer: parts.bearer.into_iter().map(metamer).collect(),
                first: vec![MetamerId::NONE; axes],
                last: vec![MetamerId::NONE; axes],
                direction: parts.direction,
                order: parts.order.iter().map(|&order| stored_order(order)).collect(),
                death: Deaths::from_rows(parts.axis_death),
            },
            ends: ends.collect(),
            edits: parts.edits,
            deaths: parts.deaths.into_iter().map(|(row, step)| (metamer(row), step)).collect(),
            axis_deaths: parts.axis_deaths.into_iter().map(|(row, step)| (axis(row), step)).collect(),
        })
    }

    /// Checks that its rows follow those of a plant that stands where it begins.
    fn check(&self, plant: &Plant) -> Result<(), BrokenPlant> {
        if self.step != plant.step() || self.from != plant.timeline.present() {
            return Err(broken("a future begins elsewhere"));
        }
        let (rows, axes) = (self.from.metamers as usize, self.from.axes as usize);
        let all_axes = axes + self.axes.bearer.len();
        let mut before = self.from;
        for &end in &self.ends {
            let columns = |e: StepEnd| [e.metamers, e.axes, e.edits, e.growths];
            if columns(before).iter().zip(columns(end)).any(|(before, end)| *before > end) {
                return Err(broken("a step ends before it begins"));
            }
            before = end;
        }
        let lengths =
            [rows + self.metamers.parent.len(), all_axes, self.from.edits as usize + self.edits.len()];
        if [before.metamers as usize, before.axes as usize, before.edits as usize] != lengths {
            return Err(broken("the last step does not end at the last row"));
        }
        let bearer = |axis: AxisId| match axis.index().checked_sub(axes) {
            Some(at) => self.axes.bearer[at],
            None => plant.axes.bearer[axis.index()],
        };
        let axis_of = |id: MetamerId| match id.index().checked_sub(rows) {
            Some(at) => self.metamers.axis[at],
            None => plant.metamers.axis[id.index()],
        };
        let is_known = |axis: AxisId| axis.index() < all_axes;
        if !self.metamers.axis.iter().all(|&axis| is_known(axis)) {
            return Err(broken("a metamer belongs to no axis"));
        }
        for (at, &bearer) in self.axes.bearer.iter().enumerate() {
            let is_borne = bearer == MetamerId::NONE
                || (bearer.index() < lengths[0] && axis_of(bearer).index() < axes + at);
            if !is_borne {
                return Err(broken("an axis is borne by nothing before it"));
            }
        }
        let is_old = |&(id, _): &(MetamerId, u32)| id.index() < rows;
        if !self.deaths.iter().all(is_old) || !self.axis_deaths.iter().all(|(id, _)| id.index() < axes) {
            return Err(broken("something dies that never was"));
        }
        let ends = to_ends(&std::iter::once(self.from).chain(self.ends.iter().copied()).collect::<Vec<_>>());
        let births = Births {
            ends: &ends,
            edits: &self.edits,
            parent: |row| match (row as usize).checked_sub(rows) {
                Some(at) => self.metamers.parent[at].raw(),
                None => plant.metamers.parent[row as usize].raw(),
            },
            axis: |row| axis_of(MetamerId::new(row as usize)).raw(),
            bearer: |axis| bearer(AxisId::new(axis as usize)).raw(),
        };
        if births.laterals()? != self.metamers.lateral {
            return Err(broken("a metamer has the laterals of another"));
        }
        let ends_of = |axis: usize| [plant.axes.first[axis].raw(), plant.axes.last[axis].raw()];
        let chains = (0..all_axes).map(|axis| if axis < axes { ends_of(axis) } else { [u32::MAX; 2] });
        let Births { parent, axis, bearer, .. } = births;
        check_chains(&ends, &self.edits, chains.collect(), parent, axis, bearer)?;
        Ok(())
    }
}

fn broken(what: &str) -> BrokenPlant {
    BrokenPlant(what.to_owned())
}

impl Plant {
    /// Cuts off everything recorded beyond the present, and returns it.
    ///
    /// # Panics
    /// If a step is being recorded.
    pub fn stash_future(&mut self) -> Future {
        assert!(!self.timeline.recording, "time stands still within a step");
        let now = self.timeline.now;
        let from = self.timeline.present();
        let metamers = self.metamers.split_off(from.metamers as usize);
        let axes = self.axes.split_off(from.axes as usize);
        let edits = self.timeline.edits.split_off(from.edits as usize);
        let loses = edits.iter().any(|edit| matches!(edit, Edit::Shed(_) | Edit::Pruned(_)));
        // Rows of the present that die in this future live on without it.
        let deaths = if loses { self.metamers.death.take_after(now) } else { Vec::new() };
        let axis_deaths = if loses { self.axes.death.take_after(now) } else { Vec::new() };
        Future {
            from,
            step: now,
            metamers,
            axes,
            ends: self.timeline.ends.split_off(now as usize + 1),
            edits,
            deaths: deaths.into_iter().map(|(row, step)| (MetamerId::new(row), step)).collect(),
            axis_deaths: axis_deaths.into_iter().map(|(row, step)| (AxisId::new(row), step)).collect(),
        }
    }

    /// Puts a future back ahead of the present, where it was cut off; the present stays where it is.
    ///
    /// # Panics
    /// If something is recorded beyond the present.
    pub fn take_future(&mut self, future: Future) -> Result<(), BrokenPlant> {
        assert!(!self.timeline.recording, "time stands still within a step");
        assert_eq!(self.timeline.now, self.last_step(), "there is a future already");
        future.check(self)?;
        let Future { metamers, axes, ends, edits, deaths, axis_deaths, .. } = future;
        self.metamers.append(metamers);
        self.axes.append(axes);
        self.timeline.ends.extend(ends);
        self.timeline.edits.extend(edits);
        for (id, step) in deaths {
            self.metamers.death.set(id.index(), step);
        }
        for (id, step) in axis_deaths {
            self.axes.death.set(id.index(), step);
        }
        Ok(())
    }
}
