//! Columns of neighbouring rows side by side, for whoever reads many at once.

use std::ops::Range;

use glam::Vec3;

use crate::{
    id::{AxisId, MetamerId},
    metamers::Condition,
    plant::Plant,
};

/// What is known of some neighbouring metamers; all columns but deaths have the same length.
#[derive(Clone, Copy, Debug)]
pub struct Columns<'a> {
    /// The metamer each grows from; [`Columns::NO_PARENT`] for a seed.
    pub parent: &'a [MetamerId],
    /// The axis each belongs to.
    pub axis: &'a [AxisId],
    /// Where each one's node is.
    pub end: &'a [Vec3],
    /// Twig tips each carries.
    pub tips: &'a [u32],
    /// How each looks.
    pub condition: &'a [Condition],
    /// Steps of death, as far as any is known; who lives has none, or one that lies beyond the present step.
    pub death: &'a [u32],
}

impl Columns<'_> {
    /// Whether a metamer of these lives in a step.
    #[inline]
    pub fn lives(&self, row: usize, step: u32) -> bool {
        self.death.get(row).is_none_or(|&death| death > step)
    }

    /// Stands in for the parent of a seed.
    pub const NO_PARENT: MetamerId = MetamerId::NONE;
}

impl Plant {
    /// The columns of the metamers in a range, which must not reach beyond [`Plant::metamer_count`].
    pub fn columns(&self, rows: Range<usize>) -> Columns<'_> {
        debug_assert!(rows.end <= self.metamer_count(), "rows of the present");
        let metamers = &self.metamers;
        Columns {
            parent: &metamers.parent[rows.clone()],
            axis: &metamers.axis[rows.clone()],
            end: &metamers.end[rows.clone()],
            tips: &metamers.tips[rows.clone()],
            condition: &metamers.condition[rows.clone()],
            death: metamers.death.within(rows),
        }
    }
}
