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
    pub(super) fn share_out(
        &self,
        nodes: &[Node],
        wood: Slotted<'_>,
        sums: &[Sums],
        vigors: &mut [f64],
        (plants, gain): (&Plants, f64),
        run: &Run<'_>,
    ) {
        let mut starts = self.starts.iter().map(|&start| start as usize).peekable();
        while let Some(start) = starts.next() {
            let end = starts.peek().copied().unwrap_or(nodes.len());
            let (below, wave) = vigors[..end].split_at_mut(start);
            let all = Wave { nodes, wood, sums, plants, gain, below };
            if run.is_shared() && wave.len() >= SHARED_FROM {
                let pieces = all.pieces(wave, start).into_iter();
                run.each(pieces, |(first, vigors)| all.share_out(vigors, first));
            } else {
                all.share_out(wave, start);
            }
        }
    }
}

/// What all shoots of a wave have in common.
#[derive(Clone, Copy)]
struct Wave<'a> {
    nodes: &'a [Node],
    wood: Slotted<'a>,
    sums: &'a [Sums],
    plants: &'a Plants,
    gain: f64,
    /// Vigor of all nodes before the wave.
    below: &'a [f64],
}

impl Wave<'_> {
    /// Parts of the wave, which begins at this slot, each with its first slot. None ends amid a shoot.
    fn pieces<'v>(&self, mut vigors: &'v mut [f64], mut first: usize) -> Vec<(usize, &'v mut [f64])> {
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

    /// Lets vigor flow through a part of the wave that begins with a shoot, in this slot.
    fn share_out(self, vigors: &mut [f64], first: usize) {
        let nodes = &self.nodes[first..first + vigors.len()];
        let sums = &self.sums[first..first + vigors.len()];
        let mut before = 0.0;
        for (at, ((vigor, node), sums)) in vigors.iter_mut().zip(nodes).zip(sums).enumerate() {
            let light = sums.light();
            *vigor = match self.wood.parent(first + at) {
                NOWHERE => self.gain * light as i64 as f64,
                parent => {
                    let enters = self.below.get(parent as usize).copied().unwrap_or(before);
                    let split =
                        Split::new(enters, self.sums[parent as usize], self.plants.lambda(first + at));
                    if node.is_main() { split.to_main() } else { split.to_lateral(light) }
                }
            };
            before = *vigor;
        }
    }
}
