//! Which rows are one limb, by the rule of clients (`client/src/scene/table/limbs.ts`).
//!
//! At each fork the wood goes on into what is thickest, whichever axis that belongs to, and everything else leaves it
//! sideways. Thickness is compared in codes and turns by + − × ÷ and square roots, so that both sides decide alike.

use crate::rows::{NONE, Rows};

/// A lateral so many codes thicker than its axis beyond the node has taken the lead: ⌈ln 1.25 / 0.01⌉.
const LEADS: i32 = 23;
/// One at most so many codes thinner than an end that was cut goes on in its place: ⌈ln 1.6 / 0.01⌉.
const REPLACES: i32 = 48;
/// Cosines of the sharpest turns that wood takes to follow a leader, and a lateral in the place of a cut.
const TURN: f64 = 0.3;
const ELBOW: f64 = -0.2;

/// One limb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limb {
    /// Its lowest row.
    pub first: u32,
    /// The row at whose node it begins: a seed, or one of its bearer's.
    pub node: u32,
    /// The limb that bears it; none for what grows from a seed.
    pub bearer: Option<u32>,
    /// How many limbs lie between it and the ground.
    pub level: u32,
    begin: u32,
    end: u32,
}

/// The limbs of all plants, those that bear before those that are borne.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Limbs {
    /// The row that goes on as the same limb.
    onward: Vec<u32>,
    /// The limb of each row; none for seeds and the dead.
    limb: Vec<u32>,
    /// The rows of each limb, base first.
    rows: Vec<u32>,
    limbs: Vec<Limb>,
}

impl Limbs {
    /// O(rows).
    pub fn of(rows: &Rows) -> Self {
        let onward = heirs(rows);
        let mut limbs: Vec<Limb> = Vec::new();
        let mut limb = vec![NONE; rows.len()];
        for row in 0..rows.len() {
            if !rows.is_wood(row) {
                continue;
            }
            let node = rows.parent[row] as usize;
            let bearer = limb[node];
            // What grows from a seed is a limb of its own even where it goes on from the seed.
            if bearer != NONE && onward[node] == row as u32 {
                limb[row] = bearer;
                limbs[bearer as usize].end += 1;
                continue;
            }
            limb[row] = limbs.len() as u32;
            let level = if bearer == NONE { 0 } else { limbs[bearer as usize].level + 1 };
            let bearer = (bearer != NONE).then_some(bearer);
            limbs.push(Limb { first: row as u32, node: node as u32, bearer, level, begin: 0, end: 1 });
        }
        let mut begin = 0;
        for limb in &mut limbs {
            (limb.begin, begin) = (begin, begin + limb.end);
            limb.end = limb.begin;
        }
        let mut ordered = vec![0; begin as usize];
        for (row, &of) in limb.iter().enumerate().filter(|&(_, &of)| of != NONE) {
            let end = &mut limbs[of as usize].end;
            ordered[*end as usize] = row as u32;
            *end += 1;
        }
        Self { onward, limb, rows: ordered, limbs }
    }

    /// All of them.
    pub fn all(&self) -> &[Limb] {
        &self.limbs
    }

    /// The limb a row belongs to; none for seeds and the dead.
    pub fn limb(&self, row: u32) -> Option<u32> {
        let limb = self.limb[row as usize];
        (limb != NONE).then_some(limb)
    }

    /// The row that goes on as the same limb, as clients know it: of a seed too.
    pub fn onward(&self, row: u32) -> Option<u32> {
        let onward = self.onward[row as usize];
        (onward != NONE).then_some(onward)
    }

    /// The rows of a limb, base first.
    pub fn rows(&self, limb: u32) -> &[u32] {
        let Limb { begin, end, .. } = self.limbs[limb as usize];
        &self.rows[begin as usize..end as usize]
    }
}

/// For each row the one that goes on as the same limb, or [`NONE`].
fn heirs(rows: &Rows) -> Vec<u32> {
    let count = rows.len();
    let mut successor = vec![NONE; count];
    let mut is_lateral = vec![false; count];
    for row in (0..count).filter(|&row| rows.is_wood(row)) {
        let node = rows.parent[row] as usize;
        // A seed has no axis of its own: what grows from it first continues it.
        let is_first = rows.parent[node] == NONE && successor[node] == NONE;
        if !rows.starts_axis[row] || is_first {
            successor[node] = row as u32;
        } else {
            is_lateral[row] = true;
        }
    }
    let mut heir = successor.clone();
    let code = |row: usize| i32::from(rows.radius[row]);
    let mut thickest: Vec<i32> = (0..count)
        .map(|node| match successor[node] {
            NONE => code(node) - REPLACES - 1,
            successor => code(successor as usize) + LEADS - 1,
        })
        .collect();
    for row in (0..count).filter(|&row| is_lateral[row]) {
        let node = rows.parent[row] as usize;
        if rows.parent[node] == NONE {
            continue;
        }
        // Of two that are as thick the lower row leads, and none is above any row.
        let is_later = heir[node] == NONE || row as u32 > heir[node];
        if code(row) < thickest[node] || (code(row) == thickest[node] && is_later) {
            continue;
        }
        if turn(rows, node, row) < if successor[node] == NONE { ELBOW } else { TURN } {
            continue;
        }
        heir[node] = row as u32;
        thickest[node] = code(row);
    }
    heir
}

/// The cosine of the angle by which the way to a row turns at the node below it.
fn turn(rows: &Rows, node: usize, row: usize) -> f64 {
    let before = rows.place(node) - rows.place(rows.parent[node] as usize);
    let after = rows.place(row) - rows.place(node);
    before.dot(after) / (before.length_squared() * after.length_squared()).max(1e-12).sqrt()
}
