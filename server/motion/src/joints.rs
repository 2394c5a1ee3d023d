//! Which limbs are joints, how they answer a push, and how rows ride on them.

use glam::{DMat3, DVec3};

use crate::{
    Limbs,
    frequency::{Mode, Modes, Station},
    rides::{Ride, rides},
    shapes::Shape,
    siblings::damping_by_company,
    statics::Borne,
    whole::whole_rates,
    wood::{Scale, Wood},
    {NONE, Rows},
};

/// The most joints of a table, slowest first.
pub const MAX_JOINTS: usize = 4096;
/// Limbs slower than this are joints, in Hz and as a multiple of their trunk's frequency, before calibration.
const SLOW: f64 = 2.5;
const SLOW_BESIDE_TRUNK: f64 = 4.0;
/// Whole trees swing at about 2.4 Hz / √(height in metres) (Jackson 2021).
const OBSERVED: f64 = 2.4;
/// The most by which wood is made softer to swing as observed, and stiffer: as stiff as the stiffest green wood, of 11 GPa.
const SOFTEST: f64 = 1.0 / 9.0;
const STIFFEST: f64 = 11.0 / 7.0;
/// The share of its polar inertia with which what is borne turns about an axis across it.
const ACROSS: f64 = 2.0 / 3.0;
const TAU: f64 = std::f64::consts::TAU;

/// One limb that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// The limb.
    pub limb: u32,
    /// Its lowest row.
    pub first: u32,
    /// The row at whose node it turns.
    pub node: u32,
    /// The joint that carries that node; none where it is the ground or stiff wood. It stands before this one.
    pub parent: Option<u32>,
    /// How many joints lie between it and the ground.
    pub level: u32,
    /// Undamped frequency after calibration, Hz.
    pub frequency: f64,
    /// Damping of wood and company as a share of the critical one.
    pub damping: f64,
    /// Σ A y² / Σ m y², m²/kg: times dq/dU / 2ω it is the damping by air.
    pub drag: f64,
    /// How much softer its wood is than uncalibrated; less than 1 where it is stiffer.
    pub softness: f64,
    /// By how much it turns where it turns most, in radians for each Pa of wind pressure along x, y and z.
    pub compliance: DMat3,
    /// Where the drag of all it bears acts on average, m.
    pub centre: DVec3,
    /// Drag area of all it bears, m².
    pub area: f64,
    /// The lowest row that rides on it at rest.
    pub lowest: u32,
}

/// The joints of all plants, those that bear before those that are borne, and what rides on them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joints {
    joints: Vec<Joint>,
    rides: Vec<Ride>,
    /// The row below each; [`NONE`] for seeds.
    below: Vec<u32>,
}

impl Joints {
    /// O(rows), apart from ordering the limbs by frequency. `suppleness` is the user's: wood that much softer than
    /// calibrated; it changes which limbs move as little as calibration does.
    pub fn of(rows: &Rows, limbs: &Limbs, wood: &Wood, suppleness: f64) -> Self {
        let drag = Borne::of(wood, &wood.drag_area);
        let mass = Borne::of(wood, &wood.mass);
        let modes = modes(limbs, wood, &mass, &drag);
        let plants = plants(rows, limbs, wood, &modes, &mass);
        let of_plant = |limb: usize| &plants[plant_of(limbs, limb)];
        let mut chosen = chosen(limbs, &modes, of_plant);
        let mut joint_of_limb = vec![NONE; limbs.all().len()];
        chosen.sort_unstable();
        chosen.iter().enumerate().for_each(|(joint, &limb)| joint_of_limb[limb] = joint as u32);
        let carriers = carriers(limbs, &joint_of_limb);
        let mut joints = Vec::with_capacity(chosen.len());
        let mut shapes = Vec::with_capacity(chosen.len());
        for &limb in &chosen {
            let Plant { softer, whole, .. } = *of_plant(limb);
            let (at, mode) = (limbs.all()[limb], modes[limb]);
            // A trunk swings with all that it bears.
            let rate = if is_trunk(limbs, limb) { mode.rate.min(whole) } else { mode.rate };
            let first = at.first as usize;
            let parent = at.bearer.map_or(NONE, |bearer| carriers[bearer as usize]);
            let softness = suppleness / softer;
            let shape = Shape::of(wood, &drag, limbs.rows(limb as u32));
            joints.push(Joint {
                limb: limb as u32,
                first: at.first,
                node: at.node,
                parent: (parent != NONE).then_some(parent),
                level: if parent == NONE { 0 } else { level(&joints, parent) + 1 },
                frequency: (rate / softness).sqrt() / TAU,
                damping: 0.0,
                drag: mode.drag,
                softness,
                compliance: shape.compliance * softness,
                centre: drag.moment[first] / drag.weight[first],
                area: drag.weight[first],
                lowest: at.first,
            });
            shapes.push(shape);
        }
        damping_by_company(&mut joints, limbs);
        let rides = rides(limbs, wood, &joint_of_limb, &shapes);
        find_lowest(&mut joints, wood, &rides);
        Self { joints, rides, below: wood.parent.clone() }
    }

    /// From rows to joints in one go, with the wood they are made of.
    pub fn grown(rows: &Rows, scale: &Scale, suppleness: f64) -> (Limbs, Wood, Self) {
        let limbs = Limbs::of(rows);
        let wood = Wood::of(rows, &limbs, scale);
        let joints = Self::of(rows, &limbs, &wood, suppleness);
        (limbs, wood, joints)
    }

    /// All of them.
    pub fn all(&self) -> &[Joint] {
        &self.joints
    }

    /// The same with so many times the damping of wood and company.
    #[must_use]
    pub fn damped(mut self, times: f64) -> Self {
        self.joints.iter_mut().for_each(|joint| joint.damping *= times);
        self
    }

    /// The row below another; none below a seed.
    pub fn below(&self, row: u32) -> Option<u32> {
        Some(self.below[row as usize]).filter(|&below| below != NONE)
    }

    /// How each row rides, by row.
    pub fn rides(&self) -> &[Ride] {
        &self.rides
    }
}

fn level(joints: &[Joint], joint: u32) -> u32 {
    joints[joint as usize].level
}

/// Makes the lowest row that rides on a joint known to it; of two as low the first.
fn find_lowest(joints: &mut [Joint], wood: &Wood, rides: &[Ride]) {
    for (row, ride) in rides.iter().enumerate() {
        if let Some(joint) = joints.get_mut(ride.joint as usize)
            && wood.place[row].y < wood.place[joint.lowest as usize].y
        {
            joint.lowest = row as u32;
        }
    }
}

/// In place of the mode of a twig of one row, which is never a joint.
const RIGID: Mode = Mode { rate: f64::INFINITY, drag: 0.0 };

/// How each limb swings by itself, uncalibrated.
fn modes(limbs: &Limbs, wood: &Wood, mass: &Borne, drag: &Borne) -> Vec<Mode> {
    let mass_spread = spread(wood, &wood.mass);
    let drag_spread = spread(wood, &wood.drag_area);
    let mut modes = Modes::default();
    let mut stations = Vec::new();
    let of_limb = |limb: usize| {
        stations.clear();
        let rows = limbs.rows(limb as u32);
        if rows.len() == 1 && limbs.all()[limb].bearer.is_some() {
            return RIGID;
        }
        for (at, &row) in rows.iter().enumerate() {
            let onward = rows.get(at + 1).map(|&row| row as usize);
            let row = row as usize;
            let borne = |of: &Borne, weights: &[f64], spread: &[f64]| {
                let rest = |all: f64, own: f64, onward: f64| (all - own - onward).max(0.0);
                let middle = wood.middle(row);
                let beyond = |column: &[f64]| onward.map_or(0.0, |onward| column[onward]);
                let weight = rest(of.weight[row], weights[row], beyond(&of.weight));
                let moment = of.moment[row]
                    - weights[row] * middle
                    - onward.map_or(DVec3::ZERO, |onward| of.moment[onward]);
                let own = weights[row] * middle.length_squared();
                let about_origin = rest(spread[row], own, beyond(spread));
                // Steiner, from the origin to the node.
                let node = wood.place[row];
                let about_node = about_origin - 2.0 * node.dot(moment) + weight * node.length_squared();
                (weight, ACROSS * about_node.max(0.0))
            };
            let (borne_mass, borne_inertia) = borne(mass, &wood.mass, &mass_spread);
            let (borne_area, borne_spread) = borne(drag, &wood.drag_area, &drag_spread);
            stations.push(Station {
                length: wood.length[row],
                softness: wood.softness(row),
                mass: wood.mass[row],
                drag_area: wood.drag_area[row],
                borne_mass,
                borne_inertia,
                borne_area,
                borne_spread,
            });
        }
        modes.slowest(&stations)
    };
    (0..limbs.all().len()).map(of_limb).collect()
}

/// Σ w |x|² over what each row bears, itself included.
fn spread(wood: &Wood, weights: &[f64]) -> Vec<f64> {
    let mut spread: Vec<f64> =
        (0..wood.len()).map(|row| weights[row] * wood.middle(row).length_squared()).collect();
    for row in (0..wood.len()).rev() {
        let node = wood.parent[row];
        if node != NONE {
            spread[node as usize] += spread[row];
        }
    }
    spread
}

/// What holds for all that grows from one seed.
#[derive(Clone, Copy, Debug)]
struct Plant {
    /// ω² below which a limb is a joint, before calibration.
    slow: f64,
    /// Factor of the modulus that makes it swing as observed.
    softer: f64,
    /// ω² of the whole, before calibration.
    whole: f64,
}

/// By row of a seed; others are not asked for.
fn plants(rows: &Rows, limbs: &Limbs, wood: &Wood, modes: &[Mode], mass: &Borne) -> Vec<Plant> {
    let mut plants = vec![Plant { slow: 0.0, softer: 1.0, whole: f64::INFINITY }; rows.len()];
    let mut seed = vec![NONE; rows.len()];
    let mut top: Vec<f64> = wood.place.iter().map(|place| place.y).collect();
    for row in 0..rows.len() {
        seed[row] = if rows.parent[row] == NONE { row as u32 } else { seed[rows.parent[row] as usize] };
        if rows.is_wood(row) {
            let top = &mut top[seed[row] as usize];
            *top = top.max(wood.place[row].y);
        }
    }
    let whole = whole_rates(wood, mass, &seed);
    for row in (0..rows.len()).filter(|&row| rows.parent[row] == NONE) {
        let Some(trunk) = limbs.onward(row as u32).and_then(|first| limbs.limb(first)) else { continue };
        let rate = modes[trunk as usize].rate;
        let height = top[row] - wood.place[row].y;
        let observed = OBSERVED * OBSERVED * TAU * TAU / height.max(1e-3);
        let slow = (SLOW * SLOW * TAU * TAU).max(SLOW_BESIDE_TRUNK * SLOW_BESIDE_TRUNK * rate);
        // A trunk without length swings in no way, and says nothing of what stands beside it.
        let swings = rate.is_finite() && whole[row].is_finite();
        let softer = if swings { (observed / whole[row]).clamp(SOFTEST, STIFFEST) } else { 1.0 };
        plants[row] = Plant { slow, softer, whole: whole[row] };
    }
    plants
}

/// The seed of a limb's plant.
fn plant_of(limbs: &Limbs, limb: usize) -> usize {
    let mut at = &limbs.all()[limb];
    while let Some(bearer) = at.bearer {
        at = &limbs.all()[bearer as usize];
    }
    at.node as usize
}

/// Whether a limb goes on from the seed.
fn is_trunk(limbs: &Limbs, limb: usize) -> bool {
    let at = limbs.all()[limb];
    at.bearer.is_none() && limbs.onward(at.node) == Some(at.first)
}

/// The limbs that move: trunks, and slow limbs of two rows at least; no more than there may be.
fn chosen<'a>(limbs: &Limbs, modes: &[Mode], of_plant: impl Fn(usize) -> &'a Plant) -> Vec<usize> {
    let is_trunk = |limb: usize| is_trunk(limbs, limb);
    let moves = |&limb: &usize| {
        let is_slow = modes[limb].rate < of_plant(limb).slow && limbs.rows(limb as u32).len() >= 2;
        is_trunk(limb) && modes[limb].rate.is_finite() || is_slow
    };
    let mut chosen: Vec<usize> = (0..limbs.all().len()).filter(moves).collect();
    if chosen.len() > MAX_JOINTS {
        // Trunks first, then the slowest; of two alike the lower row.
        chosen.sort_by(|&a, &b| {
            is_trunk(b).cmp(&is_trunk(a)).then(modes[a].rate.total_cmp(&modes[b].rate)).then(a.cmp(&b))
        });
        chosen.truncate(MAX_JOINTS);
    }
    chosen
}

/// The joint that each limb moves with: its own, or the nearest below.
fn carriers(limbs: &Limbs, joint_of_limb: &[u32]) -> Vec<u32> {
    let mut carriers: Vec<u32> = joint_of_limb.to_vec();
    for (limb, at) in limbs.all().iter().enumerate() {
        if let (NONE, Some(bearer)) = (carriers[limb], at.bearer) {
            carriers[limb] = carriers[bearer as usize];
        }
    }
    carriers
}
