//! The way for a limb around what stands between two places: the shortest over a lattice, pulled taut.

use std::{cmp::Reverse, collections::BinaryHeap};

use glam::Vec3;

use super::Obstacles;
use crate::{shoot::GROUND_CLEARANCE, world::is_in_world};

/// How far beside the straight way a detour may lead, in internodes; places farther apart have none.
const ASIDE: f32 = 20.0;
const FARTHEST: f32 = 120.0;
/// With so much room around the places of the lattice, all its edges are free; in internodes.
const ROOM: f32 = 0.9;
/// Room around the way once it is pulled taut, so that nodes beside its corners still keep clear.
const TAUT_ROOM: f32 = 0.6;
/// A way pulled taut is tested at places this near to each other, in internodes.
const TESTED: f32 = 0.5;
/// The end lies this near to the last cell of a way at most, in internodes.
const ARRIVES: f32 = 1.5;
/// Costs are whole: an edge along one, two and three axes.
const COSTS: [u32; 3] = [10, 14, 17];

impl Obstacles {
    /// Places from which wood can go straight from one to the next, and in the end to `to`; the way begins at `from`. None if
    /// there is no way, or it leads too far aside.
    pub(crate) fn detour(&self, from: Vec3, to: Vec3) -> Option<Vec<Vec3>> {
        if from.distance(to) > FARTHEST {
            return None;
        }
        let way = Lattice::new(self, from, to).find()?;
        Some(self.pulled_taut(from, &way))
    }

    /// The places of a way that are left when each is reached straight from the farthest before it that can be.
    fn pulled_taut(&self, from: Vec3, way: &[Vec3]) -> Vec<Vec3> {
        let mut taut = Vec::new();
        let mut at = from;
        for pair in way.windows(2) {
            if !self.is_clear(at, pair[1]) {
                taut.push(pair[0]);
                at = pair[0];
            }
        }
        taut.extend(way.last());
        taut
    }

    /// Whether wood can go straight from a place to another, with room from one internode on.
    fn is_clear(&self, from: Vec3, to: Vec3) -> bool {
        let along = to - from;
        let count = (along.length() / TESTED) as u32;
        let has_room = |i: u32| {
            let place = to - along * (i as f32 / count as f32);
            place.distance(from) < 1.0 || !self.blocks(place, place, TAUT_ROOM)
        };
        !self.hides(from, to) && (0..count).all(has_room)
    }
}

/// Places one internode apart, around the straight way.
struct Lattice<'a> {
    obstacles: &'a Obstacles,
    from: Vec3,
    to: Vec3,
    /// The cell of `from`, and how many cells there are along each axis.
    start: [i32; 3],
    size: [i32; 3],
    /// Of the cheapest way to each cell known so far, and the cell before it on that way.
    cost: Vec<u32>,
    before: Vec<u32>,
    /// Whether there is room around a cell, once it is known.
    has_room: Vec<Option<bool>>,
}

impl<'a> Lattice<'a> {
    fn new(obstacles: &'a Obstacles, from: Vec3, to: Vec3) -> Self {
        let start = (from - from.min(to) + ASIDE).to_array().map(|cells| cells as i32);
        let size = ((from - to).abs() + 2.0 * ASIDE).to_array().map(|cells| cells as i32 + 2);
        let count = size.iter().product::<i32>() as usize;
        Self {
            obstacles,
            from,
            to,
            start,
            size,
            cost: vec![u32::MAX; count],
            before: vec![u32::MAX; count],
            has_room: vec![None; count],
        }
    }

    fn number(&self, [x, y, z]: [i32; 3]) -> usize {
        ((y * self.size[2] + z) * self.size[0] + x) as usize
    }

    fn cell(&self, number: usize) -> [i32; 3] {
        let (number, [width, _, depth]) = (number as i32, self.size);
        [number % width, number / (width * depth), number / width % depth]
    }

    fn place(&self, number: usize) -> Vec3 {
        let cell = self.cell(number);
        self.from + Vec3::from(core::array::from_fn(|axis| (cell[axis] - self.start[axis]) as f32))
    }

    /// The cells around a cell, and what the edges to them cost.
    fn around(&self, number: usize) -> impl Iterator<Item = (usize, u32)> + use<'_> {
        let cell = self.cell(number);
        let offsets = (0..27).map(|code| [code % 3 - 1, code / 9 - 1, code / 3 % 3 - 1]);
        offsets.filter_map(move |offset: [i32; 3]| {
            let beside: [i32; 3] = core::array::from_fn(|axis| cell[axis] + offset[axis]);
            let is_inside = beside.iter().zip(&self.size).all(|(at, size)| (0..*size).contains(at));
            let axes = offset.iter().filter(|&&along| along != 0).count();
            (is_inside && axes > 0).then(|| (self.number(beside), COSTS[axes - 1]))
        })
    }

    /// What the way from a cell to the end costs at least.
    fn left(&self, number: usize) -> u32 {
        let mut away = (self.to - self.place(number)).abs().to_array().map(|cells| cells as u32);
        away.sort_unstable();
        let [least, middle, most] = away;
        COSTS[0] * (most - middle) + COSTS[1] * (middle - least) + COSTS[2] * least
    }

    /// The places of the cheapest way.
    fn find(mut self) -> Option<Vec<Vec3>> {
        let start = self.number(self.start);
        self.cost[start] = 0;
        let mut heap = BinaryHeap::from([(Reverse(self.left(start)), Reverse(start))]);
        while let Some((Reverse(expected), Reverse(cell))) = heap.pop() {
            if expected > self.cost[cell] + self.left(cell) {
                continue;
            }
            let place = self.place(cell);
            if place.distance(self.to) < ARRIVES && !self.obstacles.hides(place, self.to) {
                let before = |&cell: &usize| (cell != start).then(|| self.before[cell] as usize);
                let back = core::iter::successors(Some(cell), before);
                let mut way: Vec<Vec3> = back.map(|cell| self.place(cell)).collect();
                way.reverse();
                return Some(way);
            }
            let around: Vec<(usize, u32)> = self.around(cell).collect();
            for (next, edge) in around {
                let cost = self.cost[cell] + edge;
                // There may be less room around the start.
                let is_free =
                    |lattice: &Self| cell != start || !lattice.obstacles.hides(place, lattice.place(next));
                if cost < self.cost[next] && self.has_room(next) && is_free(&self) {
                    (self.cost[next], self.before[next]) = (cost, cell as u32);
                    heap.push((Reverse(cost + self.left(next)), Reverse(next)));
                }
            }
        }
        None
    }

    fn has_room(&mut self, cell: usize) -> bool {
        let (place, obstacles) = (self.place(cell), self.obstacles);
        *self.has_room[cell].get_or_insert_with(|| {
            place.y >= GROUND_CLEARANCE && is_in_world(place) && !obstacles.blocks(place, place, ROOM)
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;
    use crate::obstacles::{CLEARANCE, Obstacle, Shape};

    fn walls(boxes: &[[[f32; 3]; 2]]) -> Obstacles {
        let wall = |&[low, high]: &[[f32; 3]; 2]| {
            let (low, high) = (Vec3::from(low), Vec3::from(high));
            let (centre, half_extents) = (0.5 * (low + high), 0.5 * (high - low));
            Obstacle::new(Shape::Box { centre, half_extents, rotation: Quat::IDENTITY }).expect("a box")
        };
        Obstacles::new(boxes.iter().map(wall).collect())
    }

    /// Length of the way with its end, each piece of which must be free.
    fn length(obstacles: &Obstacles, from: Vec3, to: Vec3) -> Option<f32> {
        let way = obstacles.detour(from, to)?;
        let places: Vec<Vec3> = [&[from], &way[..], &[to]].concat();
        let pieces = places.windows(2).map(|pair| {
            let is_free = (0..=100).map(|i| pair[0].lerp(pair[1], i as f32 / 100.0)).all(|place| {
                place.distance(from) < 1.0
                    || place.distance(to) < 1.0
                    || !obstacles.blocks(place, place, CLEARANCE)
            });
            assert!(is_free && !obstacles.hides(pair[0], pair[1]), "{places:?}");
            pair[0].distance(pair[1])
        });
        Some(pieces.sum())
    }

    const FROM: Vec3 = Vec3::new(0.0, 5.0, 0.0);
    const TO: Vec3 = Vec3::new(12.0, 5.0, 1.0);

    #[test]
    fn the_shorter_side_of_a_wall_is_taken() {
        let wall = walls(&[[[5.0, 0.0, -20.0], [7.0, 40.0, 6.0]]]);
        let length = length(&wall, FROM, TO).expect("a way");
        // Around the edge at z = 6: 8.2 and 7.4 there, 2 along it.
        assert!((17.6..20.0).contains(&length), "{length}");
    }

    #[test]
    fn a_way_leads_through_a_gate_and_out_of_a_dead_end() {
        let gate = walls(&[[[5.0, 0.0, -90.0], [6.0, 90.0, 4.0]], [[5.0, 0.0, 7.5], [6.0, 90.0, 90.0]]]);
        assert!(length(&gate, FROM, TO).expect("a way") < 19.0);
        // A yard that is open towards where nobody wants to go.
        let back = [[5.0, 0.0, -8.0], [6.0, 50.0, 8.0]];
        let sides = [[[-6.0, 0.0, -8.0], [6.0, 50.0, -7.0]], [[-6.0, 0.0, 7.0], [6.0, 50.0, 8.0]]];
        assert!(length(&walls(&[back, sides[0], sides[1]]), FROM, TO).expect("a way") > 30.0);
    }

    #[test]
    fn where_there_is_no_way_none_is_found() {
        let endless = walls(&[[[5.0, -9.0, -300.0], [6.0, 300.0, 300.0]]]);
        assert_eq!(endless.detour(FROM, TO), None);
        let closed = walls(&[[[9.0, 2.0, -2.0], [15.0, 8.0, 4.0]]]);
        assert_eq!(closed.detour(FROM, TO), None, "its end is in a solid");
        assert_eq!(endless.detour(FROM, TO * 20.0), None, "it is far away");
    }
}
