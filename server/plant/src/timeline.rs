//! The steps of a plant's life, and the cursor among them.

use crate::edits::Edit;

/// Lengths of the plant's columns at the end of one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct StepEnd {
    pub metamers: u32,
    pub axes: u32,
    pub edits: u32,
    /// Steps of growth among those up to here.
    pub growths: u32,
}

/// Every step recorded, and how many of them are in the present.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Timeline {
    /// Ends of steps 0, 1, 2 …
    pub ends: Vec<StepEnd>,
    /// What was done to wood. Within a step edits come before births.
    pub edits: Vec<Edit>,
    /// The step being recorded now, or the last one recorded.
    pub now: u32,
    /// Whether a step is being recorded.
    pub recording: bool,
    /// Whether the step being recorded is one of growth.
    pub grows: bool,
}

impl Timeline {
    /// The lengths in the present.
    pub fn present(&self) -> StepEnd {
        self.ends.get(self.now as usize).copied().unwrap_or_default()
    }

    /// The step in which a column of the present got this row. Rows of one step follow each other, so the ends say
    /// it; the step being recorded has no end yet.
    pub fn step_of(&self, column: impl Fn(&StepEnd) -> u32, row: u32) -> u32 {
        let ended = &self.ends[..self.ends.len().min(self.now as usize + 1)];
        ended.partition_point(|end| column(end) <= row) as u32
    }

    /// Steps of growth up to a step of the present, that being recorded included.
    pub fn growths_at(&self, step: u32) -> u32 {
        let is_recorded = self.recording && step == self.now;
        let of = |step| self.ends.get(step as usize).map_or(0, |end: &StepEnd| end.growths);
        if is_recorded { self.before(step).growths + u32::from(self.grows) } else { of(step) }
    }

    /// The lengths one step earlier.
    pub fn before(&self, step: u32) -> StepEnd {
        step.checked_sub(1).and_then(|s| self.ends.get(s as usize)).copied().unwrap_or_default()
    }
}
