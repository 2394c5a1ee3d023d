//! Going back and forth in time: the cursor moves, the rows stay where they are.

use glam::Vec3;

use crate::{
    edits::{Carried, Edit},
    id::{AxisId, MetamerId},
    plant::Plant,
    timeline::StepEnd,
};

/// What a move in time did on the whole, for whoever keeps structures derived from the plant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimeShift {
    /// Metamers that are alive now and were not before, seeds included.
    pub metamers_in: Vec<MetamerId>,
    /// Metamers that were alive before and are not now, seeds included, and where they were.
    pub metamers_out: Vec<(MetamerId, Vec3)>,
    /// Metamers that were alive before and are now, but elsewhere, and where they were.
    pub moved: Vec<(MetamerId, Vec3)>,
    /// Axes whose bud moved, appeared or vanished; some more than once, some beyond the present.
    pub axes: Vec<AxisId>,
    /// Whether anything but births lies between: wood shed, cut, carried or grafted.
    pub is_edited: bool,
}

/// A move in time as it happens.
#[derive(Default)]
pub(crate) struct Journey {
    pub(crate) came: Vec<MetamerId>,
    pub(crate) went: Vec<MetamerId>,
    /// What moved and where it was, the first move first.
    moved: Vec<(MetamerId, Vec3)>,
    pub(crate) axes: Vec<AxisId>,
    is_edited: bool,
}

impl Journey {
    /// Notes an axis, once for all metamers of a shoot: they follow each other.
    pub(crate) fn note_axis(&mut self, axis: AxisId) {
        if self.axes.last() != Some(&axis) {
            self.axes.push(axis);
        }
    }
}

impl Plant {
    /// Goes to a step that is recorded: back, or forth again.
    ///
    /// # Panics
    /// If the step was never recorded, or one is being recorded.
    pub fn go_to(&mut self, step: u32) -> TimeShift {
        assert!(step <= self.last_step(), "step {step} lies beyond the last recorded one");
        assert!(!self.timeline.recording, "time stands still within a step");
        let mut journey = Journey::default();
        while self.timeline.now > step {
            self.step_back(&mut journey);
        }
        while self.timeline.now < step {
            self.step_forth(&mut journey);
        }
        self.sum_up(journey)
    }

    /// Lives through the recorded steps from a plant whose rows are filled but not linked yet.
    pub(crate) fn replay(&mut self, now: u32) {
        let mut edits = std::mem::take(&mut self.timeline.edits);
        let done = self.timeline.ends[now as usize].edits as usize;
        // The rows stand as they do in the present, and begin where they did in the past.
        for edit in edits[..done].iter_mut().rev() {
            match edit {
                Edit::Carried(carried) => self.swap(carried),
                Edit::Width(id, diameter) => *diameter = self.replace_width(*id, *diameter),
                Edit::Given(given) => self.metamers.given_radius.swap(given),
                Edit::Borne(given) => self.metamers.given_organs.swap(given),
                Edit::Resettled(resettled) => self.forget(resettled),
                Edit::Shed(_) | Edit::Pruned(_) | Edit::Grafted(_) | Edit::Scarred(..) => {}
            }
        }
        self.timeline.edits = edits;
        for index in 0..self.timeline.present().metamers {
            let id = MetamerId::new(index as usize);
            self.link(id);
            self.living += u32::from(!self.is_seed(id));
        }
        self.thicken_from(0, self.metamer_count());
        self.go_to(now);
    }

    fn step_back(&mut self, journey: &mut Journey) {
        let now = self.timeline.now;
        let (before, end) = (self.timeline.before(now), self.timeline.present());
        let range = before.edits as usize..end.edits as usize;
        self.scar(range.clone(), -1);
        for index in (before.metamers..end.metamers).rev() {
            let id = MetamerId::new(index as usize);
            journey.went.push(id);
            if !self.is_seed(id) {
                self.living = self.living.wrapping_sub(1);
            }
            self.unlink(id);
            journey.note_axis(self.metamers.axis(id));
        }
        self.note_axes(before, end, now, journey);
        self.timeline.now = now - 1;
        let lost = self.lost_in(now);
        self.living = self.living.wrapping_add(lost.len() as u32);
        journey.came.extend(lost);
        let mut edits = std::mem::take(&mut self.timeline.edits);
        for edit in edits[range.clone()].iter_mut().rev() {
            journey.is_edited |= !matches!(edit, Edit::Width(..) | Edit::Given(_) | Edit::Borne(_));
            match edit {
                Edit::Shed(_) | Edit::Scarred(..) => {}
                Edit::Pruned(cut) => {
                    let tips = self.tips_lost_with(*cut);
                    self.add_tips(self.metamers.parent[cut.index()], tips);
                }
                Edit::Grafted(axis) => self.ungraft(*axis),
                Edit::Resettled(resettled) => self.resettled(resettled, now, true, journey),
                Edit::Carried(_) | Edit::Width(..) | Edit::Given(_) | Edit::Borne(_) => {
                    self.exchange(edit, journey);
                }
            }
        }
        if resettles(&edits[range.clone()]) {
            self.recount_tips(&edits[..range.start], before.metamers as usize);
        }
        self.timeline.edits = edits;
    }

    fn step_forth(&mut self, journey: &mut Journey) {
        let before = self.timeline.present();
        self.timeline.now += 1;
        let now = self.timeline.now;
        let end = self.timeline.present();
        self.note_axes(before, end, now, journey);
        let lost = self.lost_in(now);
        self.living = self.living.wrapping_sub(lost.len() as u32);
        journey.went.extend(lost);
        let range = before.edits as usize..end.edits as usize;
        let mut edits = std::mem::take(&mut self.timeline.edits);
        for edit in &mut edits[range.clone()] {
            journey.is_edited |= !matches!(edit, Edit::Width(..) | Edit::Given(_) | Edit::Borne(_));
            match edit {
                Edit::Shed(_) | Edit::Scarred(..) => {}
                Edit::Pruned(cut) => {
                    let tips = self.tips_lost_with(*cut);
                    self.add_tips(self.metamers.parent[cut.index()], tips.wrapping_neg());
                }
                Edit::Grafted(axis) => {
                    self.grafts.entry(self.axes.bearer[axis.index()]).or_default().push(*axis);
                }
                Edit::Resettled(resettled) => self.resettled(resettled, now, false, journey),
                Edit::Carried(_) | Edit::Width(..) | Edit::Given(_) | Edit::Borne(_) => {
                    self.exchange(edit, journey);
                }
            }
        }
        if resettles(&edits[range.clone()]) {
            self.recount_tips(&edits[..range.end], before.metamers as usize);
        }
        self.timeline.edits = edits;
        for index in before.metamers..end.metamers {
            let id = MetamerId::new(index as usize);
            self.link(id);
            journey.note_axis(self.metamers.axis(id));
            journey.came.push(id);
            if !self.is_seed(id) {
                self.living = self.living.wrapping_add(1);
            }
        }
        self.thicken_from(before.metamers as usize, end.metamers as usize);
        self.scar(range, 1);
    }

    /// Changes what an edit keeps for what is in force.
    fn exchange(&mut self, edit: &mut Edit, journey: &mut Journey) {
        match edit {
            Edit::Carried(carried) => self.carry_over(carried, journey),
            Edit::Width(id, diameter) => *diameter = self.replace_width(*id, *diameter),
            Edit::Given(given) => self.metamers.given_radius.swap(given),
            Edit::Borne(given) => self.metamers.given_organs.swap(given),
            Edit::Shed(_) | Edit::Pruned(_) | Edit::Grafted(_) | Edit::Scarred(..) | Edit::Resettled(_) => {}
        }
    }

    /// Swaps where wood stands with where it stood, and notes it.
    pub(crate) fn carry_over(&mut self, carried: &mut Carried, journey: &mut Journey) {
        self.swap(carried);
        journey.moved.extend(carried.metamers.iter().copied().zip(carried.ends.iter().copied()));
        journey.axes.extend(&carried.axes);
        journey.axes.extend(carried.metamers.iter().map(|&id| self.metamers.axis(id)));
    }

    fn ungraft(&mut self, axis: AxisId) {
        let bearer = self.axes.bearer[axis.index()];
        if let Some(grafts) = self.grafts.get_mut(&bearer) {
            grafts.retain(|&graft| graft != axis);
            if grafts.is_empty() {
                self.grafts.remove(&bearer);
            }
        }
    }

    /// Notes the axes that were born or died in a step.
    fn note_axes(&self, before: StepEnd, end: StepEnd, step: u32, journey: &mut Journey) {
        journey.axes.extend((before.axes..end.axes).map(|index| AxisId::new(index as usize)));
        if end.edits > before.edits {
            let died = (0..before.axes as usize).filter(|&index| self.axes.death.of(index) == step);
            journey.axes.extend(died.map(AxisId::new));
        }
    }

    /// The metamers that died in a step, in birth order.
    fn lost_in(&self, step: u32) -> Vec<MetamerId> {
        let (before, end) = (self.timeline.before(step), self.timeline.ends[step as usize]);
        // None is older than the first of the branches that were lost.
        let roots = self.timeline.edits[before.edits as usize..end.edits as usize].iter();
        let first = roots.filter_map(|edit| match edit {
            Edit::Shed(axis) => self.axes.first(*axis),
            Edit::Pruned(cut) => Some(*cut),
            _ => None,
        });
        let Some(first) = first.min() else { return Vec::new() };
        let rows = (first.index()..before.metamers as usize).map(MetamerId::new);
        rows.filter(|id| self.metamers.death.of(id.index()) == step).collect()
    }

    /// What a journey comes to: rows that came and went again are left out.
    fn sum_up(&self, journey: Journey) -> TimeShift {
        let Journey { mut came, mut went, mut moved, axes, is_edited } = journey;
        if !came.is_empty() && !went.is_empty() {
            (came, went) = differences(came, went);
        }
        // Of several moves the first tells where something was.
        moved.sort_by_key(|&(id, _)| id);
        moved.dedup_by_key(|&mut (id, _)| id);
        let former = |id: MetamerId| match moved.binary_search_by_key(&id, |&(id, _)| id) {
            Ok(at) => moved[at].1,
            Err(_) => self.metamers.end(id),
        };
        let metamers_out = went.into_iter().map(|id| (id, former(id))).collect();
        let mut arrived = came.clone();
        arrived.sort_unstable();
        let stayed = |id: MetamerId| {
            id.index() < self.metamer_count() && self.is_alive(id) && arrived.binary_search(&id).is_err()
        };
        moved.retain(|&(id, _)| stayed(id));
        TimeShift { metamers_in: came, metamers_out, moved, axes, is_edited }
    }
}

/// Whether one of the edits settles anew which wood stands.
fn resettles(edits: &[Edit]) -> bool {
    edits.iter().any(|edit| matches!(edit, Edit::Resettled(_)))
}

/// Those who came more often than they went, and those who went more often than they came.
fn differences(mut came: Vec<MetamerId>, mut went: Vec<MetamerId>) -> (Vec<MetamerId>, Vec<MetamerId>) {
    came.sort_unstable();
    went.sort_unstable();
    let (mut only_came, mut only_went) = (Vec::new(), Vec::new());
    let (mut came, mut went) = (came.into_iter().peekable(), went.into_iter().peekable());
    loop {
        match (came.peek(), went.peek()) {
            (Some(a), Some(b)) if a == b => {
                came.next();
                went.next();
            }
            (Some(a), Some(b)) if a < b => only_came.extend(came.next()),
            (_, Some(_)) => only_went.extend(went.next()),
            (Some(_), None) => only_came.extend(came.next()),
            (None, None) => return (only_came, only_went),
        }
    }
}
