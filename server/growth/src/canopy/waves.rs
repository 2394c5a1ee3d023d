//! Vigor flows up wave by wave: through many nodes at once.

use super::{NOWHERE, node::Node, plants::Plants, wood::Slotted};
use crate::{
    side_by_side::Run,
    vigor::{Split, Sums},
};

/// Waves smaller than this are not worth handing to other threads.
const SHARED_FROM: usize = if cfg!(test) { 4 } else { 8192 };
/// Nodes that one thread goes through at a time, roughly.
const PIECE: usize = if cfg!(test) { 2 } else { 1024 };

/// The nodes of a canopy in runs: each node's parent stands before its wave, or right before the node itself.
///
/// So shoots of one wave do not depend on each other. Mostly a wave is what has grown in one step.
#[derive(Clone, Debug, Default)]
pub(super) struct Waves {
    /// Slot of each wave's first node.
    starts: Vec<u32>,
}

impl Waves {
    /// Takes in the next node.
    pub(super) fn add(&mut self, slot: u32, parent: u32) {
        let start = self.starts.last().copied();
        let fits = |start| parent == NOWHERE || parent < start || parent + 1 == slot;
        if !start.is_some_and(fits) {
            self.starts.push(slot);
        }
    }

    /// Forgets all nodes from a slot on.
    pub(super) fn truncate(&mut self, slots: u32) {
        self.starts.truncate(self.starts.partition_point(|&start| start < slots));
    }

    /// Forgets all nodes.
    pub(super) fn clear(&mut self) {
        self.starts.clear();
    }

    /// Lets vigor flow up: at the base of each plant `gain` for each unit of light, farther up as nodes split it.
    pub(super) fn share_out(&self, flow: Flow<'_>, vigors: &mut [f64], run: &Run<'_>) {
        if !run.is_shared() {
            // All as long as each other, so that one look at a slot says that it belongs to all of them.
            let count = vigors.len();
            let flow = Flow { nodes: &flow.nodes[..count], sums: &flow.sums[..count], ..flow };
            return (0..count).for_each(|slot| vigors[slot] = flow.into(slot, |parent| vigors[parent]));
        }
        let mut starts = self.starts.iter().map(|&start| start as usize).peekable();
        while let Some(start) = starts.next() {
            let end = starts.peek().copied().unwrap_or(vigors.len());
            let (below, wave) = vigors[..end].split_at_mut(start);
            if wave.len() >= SHARED_FROM {
                let pieces = flow.pieces(wave, start).into_iter();
                run.each(pieces, |(first, vigors)| flow.through(vigors, first, below));
            } else {
                flow.through(wave, start, below);
            }
        }
    }
}

/// What vigor at the nodes of a canopy follows from.
#[derive(Clone, Copy)]
pub(super) struct Flow<'a> {
    pub nodes: &'a [Node],
    pub wood: Slotted<'a>,
    pub sums: &'a [Sums],
    pub plants: &'a Plants,
    /// Vigor of a plant for each unit of light.
    pub gain: f64,
}

impl Flow<'_> {
    /// Parts of a wave, which begins at this slot, each with its first slot. None ends amid a shoot.
    fn pieces(self, mut vigors: &mut [f64], mut first: usize) -> Vec<(usize, &mut [f64])> {
        let mut pieces = Vec::with_capacity(vigors.len() / PIECE + 1);
        while !vigors.is_empty() {
            let begins = |at: &usize| self.wood.parent(first + at) as usize != first + at - 1;
            let end = (PIECE.min(vigors.len())..vigors.len()).find(begins).unwrap_or(vigors.len());
            let (piece, rest) = vigors.split_at_mut(end);
            pieces.push((first, piece));
            (vigors, first) = (rest, first + end);
        }
        pieces
    }

    /// Lets vigor flow through a part of a wave that begins with a shoot, in this slot; `below` is that of all nodes before
    /// the wave.
    fn through(self, vigors: &mut [f64], first: usize, below: &[f64]) {
        let mut before = 0.0;
        for (at, vigor) in vigors.iter_mut().enumerate() {
            *vigor = self.into(first + at, |parent| below.get(parent).copied().unwrap_or(before));
            before = *vigor;
        }
    }

    /// Vigor that flows into a node; `at` says how much has flowed into its parent.
    #[inline(always)]
    fn into(self, slot: usize, at: impl FnOnce(usize) -> f64) -> f64 {
        let light = self.sums[slot].light();
        match self.wood.parent(slot) {
            NOWHERE => self.gain * light as i64 as f64,
            parent => {
                let sums = self.sums[parent as usize];
                let split = Split::new(at(parent as usize), sums, self.plants.lambda(slot));
                if self.nodes[slot].is_main() { split.to_main() } else { split.to_lateral(light) }
            }
        }
    }
}
