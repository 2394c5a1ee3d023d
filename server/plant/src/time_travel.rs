//! Going back and forth in time: the cursor moves, the rows stay where they are.

use crate::{
    id::{AxisId, MetamerId},
    plant::Plant,
    timeline::StepEnd,
};

/// What a move in time did, for whoever keeps structures derived from the plant.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TimeShift {
    /// Metamers that are alive now and were not before, seeds included.
    pub metamers_in: Vec<MetamerId>,
    /// Metamers that were alive before and are not now, seeds included.
    pub metamers_out: Vec<MetamerId>,
    /// Axes whose bud moved, appeared or vanished; some more than once, some beyond the present.
    pub axes: Vec<AxisId>,
}

impl Plant {
    /// Goes to a step that is recorded: back, or forth again.
    ///
    /// # Panics
    /// If the step was never recorded, or one is being recorded.
    pub fn go_to(&mut self, step: u32) -> TimeShift {
        assert!(step <= self.last_step(), "step {step} lies beyond the last recorded one");
        assert!(!self.timeline.recording, "time stands still within a step");
        let mut shift = TimeShift::default();
        while self.timeline.now > step {
            self.step_back(&mut shift);
        }
        while self.timeline.now < step {
            self.step_forth(&mut shift);
        }
        shift
    }

    /// Lives through the recorded steps from a plant whose rows are filled but not linked yet.
    pub(crate) fn replay(&mut self, now: u32) {
        for index in 0..self.timeline.present().metamers {
            let id = MetamerId::new(index as usize);
            self.link(id);
            self.living += u32::from(!self.is_seed(id));
        }
        self.carry_from(0, self.metamer_count());
        self.go_to(now);
    }

    fn step_back(&mut self, shift: &mut TimeShift) {
        let now = self.timeline.now;
        let (before, end) = (self.timeline.before(now), self.timeline.present());
        for index in (before.metamers..end.metamers).rev() {
            let id = MetamerId::new(index as usize);
            shift.metamers_out.push(id);
            if !self.is_seed(id) {
                self.living = self.living.wrapping_sub(1);
            }
            self.unlink(id);
            shift.axes.push(self.metamers.axis(id));
        }
        self.shift_axes(before, end, now, shift);
        self.timeline.now = now - 1;
        for index in (before.losses..end.losses).rev() {
            for id in self.lost_with(self.timeline.losses[index as usize], now) {
                shift.metamers_in.push(id);
                self.living = self.living.wrapping_add(1);
            }
        }
    }

    fn step_forth(&mut self, shift: &mut TimeShift) {
        let before = self.timeline.present();
        self.timeline.now += 1;
        let end = self.timeline.present();
        self.shift_axes(before, end, self.timeline.now, shift);
        for index in before.losses..end.losses {
            for id in self.lost_with(self.timeline.losses[index as usize], self.timeline.now) {
                shift.metamers_out.push(id);
                self.living = self.living.wrapping_sub(1);
            }
        }
        for index in before.metamers..end.metamers {
            let id = MetamerId::new(index as usize);
            self.link(id);
            shift.axes.push(self.metamers.axis(id));
            shift.metamers_in.push(id);
            if !self.is_seed(id) {
                self.living = self.living.wrapping_add(1);
            }
        }
        self.carry_from(before.metamers as usize, end.metamers as usize);
    }

    /// Notes the axes that were born or died in a step.
    fn shift_axes(&self, before: StepEnd, end: StepEnd, step: u32, shift: &mut TimeShift) {
        shift.axes.extend((before.axes..end.axes).map(|index| AxisId::new(index as usize)));
        if end.losses > before.losses {
            let died = (0..before.axes as usize).filter(|&index| self.axes.death[index] == step);
            shift.axes.extend(died.map(AxisId::new));
        }
    }

    /// The metamers that died with a branch in a step.
    fn lost_with(&self, root: AxisId, step: u32) -> Vec<MetamerId> {
        // A dead axis keeps its links, so its rows can be found again from its first metamer on.
        let Some(first) = self.axes.first(root) else { return Vec::new() };
        let end = self.timeline.before(step).metamers as usize;
        let mut inside = vec![false; end.saturating_sub(first.index())];
        let mut lost = Vec::new();
        for index in first.index()..end {
            let parent = self.metamers.parent[index];
            let within = index == first.index()
                || (parent != MetamerId::NONE && parent >= first && inside[parent.index() - first.index()]);
            if within && self.metamers.death[index] == step {
                inside[index - first.index()] = true;
                lost.push(MetamerId::new(index));
            }
        }
        lost
    }
}
