//! What moves besides joints: twigs that are too stiff for joints shiver, and leaves flutter about their bases and stream
//! to lee. Clients draw it in shaders, by the same formulas.

use std::f64::consts::TAU;

use espalier_mesh::leaves::hash;
use glam::{DQuat, DVec3};

use crate::{
    Limbs, NONE, exposure::Exposure, joints::Joints, pose::Node, pose::Pose, wind::Direction, wind::Wind,
    wood::Wood,
};

/// Cells of noise that go by in a second, or as many as nearly do where a loop has a whole number of them.
const CELLS_A_SECOND: f64 = 256.0 * 10.0 / 600.0;
/// Cells after which the noise repeats, where a loop does not end it sooner; and its lines.
const SIDE: u32 = 256;
/// Which of the lattices of clients the noise is.
const LATTICE: u32 = 2 << 24;
/// Metres of snow that hide what they lie on.
const COVERED: f64 = 0.04;

/// How far snow of a depth in metres covers what it lies on, 0 to 1.
pub fn covered(snow: f64) -> f64 {
    (snow / COVERED).min(1.0)
}

/// Between −1 and 1, smooth along a line and another on each: leaves of different `seed`, 0 to 1, take different lines.
pub fn noise(along: f64, seed: f64, wrap: u32) -> f64 {
    let cell = along.floor();
    let f = along - cell;
    let line = (seed * f64::from(SIDE - 1)).floor() as u32 * SIDE;
    let of =
        |cell: f64| f64::from(hash(LATTICE + line + cell.rem_euclid(f64::from(wrap)) as u32) >> 24) / 255.0;
    let share = f * f * (3.0 - 2.0 * f);
    2.0 * (of(cell) + share * (of(cell + 1.0) - of(cell))) - 1.0
}

/// Between −1 and 1, `least` times in a second or up to three more, by a number of 0 to 1; the same after a period.
pub fn quiver(number: f64, least: f64, time: f64, period: f64) -> f64 {
    let times = ((least + 3.0 * (number * 57.31).fract()) * period).floor() / period;
    libm::sin(TAU * ((times * time).fract() + (number * 131.7).fract()))
}

/// How leaves are moved by air, and what lies on them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stirring {
    /// Level, where the wind blows to.
    pub lee: DVec3,
    /// How much blades flutter, 1 as most do.
    pub much: f64,
    /// How far snow covers them, and how wet they are, 0 to 1 each.
    pub covered: f64,
    /// The same of rain.
    pub wet: f64,
}

/// A leaf as its twig has carried it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blade {
    /// Where it hangs, in internodes.
    pub base: DVec3,
    /// Unit vector along it.
    pub direction: DVec3,
    /// Unit vector across it.
    pub side: DVec3,
    /// Three numbers of its own, 0 to 1.
    pub own: [f64; 3],
}

/// How a blade has turned about its base in air of some speed in m/s, at a time of a wind of some period.
pub fn turn(stirring: &Stirring, blade: &Blade, air: f64, time: f64, period: f64) -> DQuat {
    let Stirring { lee, much, covered, wet } = *stirring;
    let Blade { base, direction, side, own: [x, y, z] } = *blade;
    let cells = (CELLS_A_SECOND * period).round();
    let wrap = if cells < f64::from(SIDE) { cells as u32 } else { SIDE };
    let gone = cells * (time / period).fract() - 0.45 * base.dot(lee) + 13.0 * z;
    let by = direction.cross(lee) * ((0.06 * air).min(0.9) * much.min(1.0))
        + direction.cross(-DVec3::Y) * (0.35 * wet + 0.5 * covered).min(0.7)
        + side * (0.25 * much * (air / 8.0).min(1.0) * noise(gone, x, wrap))
        + direction * (0.5 * much * (air / 6.0).min(1.0) * noise(gone + 57.3, y, wrap));
    let half = 0.5 * by;
    DQuat::from_xyzw(half.x, half.y, half.z, 1.0).normalize()
}

/// The air around rows, and the twigs that shiver in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Air {
    wind: Wind,
    exposure: Exposure,
    /// For each row where its twig stands, and the twig's number; none where it does not shiver.
    twigs: Vec<Option<(DVec3, f64)>>,
}

impl Air {
    /// Of a wind of which each joint gets a share.
    pub fn new(wind: Wind, exposure: Exposure, (joints, limbs, wood): (&Joints, &Limbs, &Wood)) -> Self {
        let mut twigs: Vec<Option<(DVec3, f64)>> = vec![None; wood.len()];
        for row in 0..wood.len() {
            let Some(limb) = limbs.limb(row as u32) else { continue };
            let joint = joints.rides()[row].joint;
            let below = wood.parent[row];
            if joint == NONE || below == NONE {
                continue;
            }
            let begins = limbs.all()[limb as usize].first == row as u32
                && joints.all()[joint as usize].first != row as u32;
            let own = begins
                .then(|| (wood.place[below as usize], f64::from(hash(row as u32)) / (1u64 << 32) as f64));
            twigs[row] = twigs[below as usize].or(own);
        }
        Self { wind, exposure, twigs }
    }

    /// Where it blows to, level.
    pub fn lee(&self) -> DVec3 {
        self.wind.axis(Direction::Along).with_y(0.0)
    }

    /// Seconds after which all comes again.
    pub fn period(&self) -> f64 {
        self.wind.period()
    }

    /// Its speed around a row at a time, m/s.
    pub fn speed(&self, joints: &Joints, wood: &Wood, row: u32, time: f64) -> f64 {
        let open = self.wind.speed_along(wood.place(row), time);
        match joints.rides()[row as usize].joint {
            NONE => open,
            joint => open * self.exposure.shares()[joint as usize],
        }
    }

    /// How a row's node stands in a pose when its twig shivers as well.
    pub fn node(&self, pose: &Pose, joints: &Joints, wood: &Wood, row: u32, time: f64) -> Node {
        let node = pose.node(joints, wood, row);
        let Some((pivot, number)) = self.twigs[row as usize] else { return node };
        let quiver = |number: f64, least| quiver(number.fract(), least, time, self.period());
        let far = 0.02 * (self.speed(joints, wood, row, time) / 5.0).sqrt();
        let by =
            far * DVec3::new(quiver(number, 3.0), 0.6 * quiver(7.7 * number, 4.0), quiver(3.3 * number, 3.5));
        let carried = pose.stands()[joints.rides()[row as usize].joint as usize].turn;
        Node {
            place: node.place + carried * by.cross(wood.place(row) - pivot),
            turn: node.turn * DQuat::from_scaled_axis(by),
        }
    }
}
