//! How each vertex goes along with the wind, in four numbers that shaders of engines take: no bones are needed.

use espalier_motion::NONE;
use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use crate::swaying::{Rider, Swaying};

/// How the numbers of a vertex are measured: what a mesh says of them beside them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measures {
    /// Metres by which a vertex with `trunk` 1 moves for each radian by which its trunk bends.
    pub trunk: f64,
    /// The same of limbs.
    pub limb: f64,
    /// Cycles a second of the slowest trunk, undamped.
    pub trunk_frequency: f64,
    /// The same of limbs, in the middle of all.
    pub limb_frequency: f64,
}

impl Measures {
    /// As a mesh says them.
    pub(crate) fn told(&self) -> Value {
        json!({
            "trunk_metres": self.trunk,
            "limb_metres": self.limb,
            "trunk_hertz": self.trunk_frequency,
            "limb_hertz": self.limb_frequency,
        })
    }
}

/// What the wind does to one vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Weights {
    /// How far it goes with the trunk, 0 to 1.
    pub trunk: f32,
    /// How far with its limb besides.
    pub limb: f32,
    /// Where in its cycle its limb is, 0 to 1.
    pub phase: f32,
    /// How much it flutters: 1 at the tips of leaves, 0 where they hang and on wood.
    pub flutter: f32,
}

/// The weights of all vertices of a scene.
pub(crate) struct WindWeights<'a> {
    swaying: &'a Swaying,
    measures: Measures,
}

impl<'a> WindWeights<'a> {
    pub(crate) fn of(swaying: &'a Swaying) -> Self {
        let frequencies = |level: u32| {
            let joints = swaying.joints.all().iter().filter(|joint| joint.level == level);
            let mut all: Vec<f64> = joints.map(|joint| joint.frequency).collect();
            all.sort_by(f64::total_cmp);
            all
        };
        let [trunks, limbs] = [0, 1].map(frequencies);
        let none = Measures { trunk: 0.0, limb: 0.0, trunk_frequency: 0.0, limb_frequency: 0.0 };
        let mut made = Self { swaying, measures: none };
        let rows = 0..swaying.wood.len() as u32;
        let ways = rows.map(|row| made.ways(row, swaying.wood.place(row)).map(DVec3::length));
        let [trunk, limb] = ways.fold([0.0; 2], |[a, b]: [f64; 2], [c, d]| [a.max(c), b.max(d)]);
        let own = |all: &[f64], at: usize| all.get(at).copied().unwrap_or_default();
        made.measures = Measures {
            trunk,
            limb,
            trunk_frequency: own(&trunks, 0),
            limb_frequency: own(&limbs, limbs.len() / 2),
        };
        made
    }

    pub(crate) fn measures(&self) -> Measures {
        self.measures
    }

    /// Of a vertex at a place in metres.
    pub(crate) fn of_vertex(&self, rider: Rider, place: Vec3) -> Weights {
        let [trunk, limb] = self.ways(rider.row, place.as_dvec3()).map(DVec3::length);
        let share = |way: f64, most: f64| if most > 0.0 { (way / most).min(1.0) as f32 } else { 0.0 };
        let phase = self.limb(rider.row).map_or(0.0, phase);
        Weights {
            trunk: share(trunk, self.measures.trunk),
            limb: share(limb, self.measures.limb),
            phase,
            flutter: rider.flutter,
        }
    }

    /// How the trunk's joint and the limb's carry a place that goes along with a row: a joint that turns by a small
    /// angle Θ moves it by Θ × way.
    fn ways(&self, row: u32, place: DVec3) -> [DVec3; 2] {
        let (joints, wood) = (&self.swaying.joints, &self.swaying.wood);
        let mut ways = [DVec3::ZERO; 2];
        // What rides on a joint goes with the node of the row where it leaves that joint.
        let mut leaves = row;
        loop {
            let ride = joints.rides()[leaves as usize];
            if ride.joint == NONE {
                return ways;
            }
            let joint = joints.all()[ride.joint as usize];
            if let Some(way) = ways.get_mut(joint.level as usize) {
                *way = ride.first + ride.weight * (place - wood.place(leaves));
            }
            if joint.parent.is_none() {
                return ways;
            }
            leaves = joint.node;
        }
    }

    /// The limb on the trunk that bears a row, as a joint.
    fn limb(&self, row: u32) -> Option<u32> {
        let joints = &self.swaying.joints;
        let mut at = joints.rides()[row as usize].joint;
        while at != NONE {
            let joint = joints.all()[at as usize];
            match joint.level {
                0 => return None,
                1 => return Some(at),
                _ => at = joint.parent?,
            }
        }
        None
    }
}

/// Neighbours lie far apart in their cycles: multiples of the golden ratio.
fn phase(number: u32) -> f32 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    (f64::from(number + 1) * GOLDEN).fract() as f32
}

#[cfg(test)]
mod tests {
    use espalier_growth::species;
    use espalier_mesh::{Style, StyleOptions};
    use espalier_motion::Pose;
    use espalier_session::{Document, Principal, script};
    use espalier_settings::looks::WindLook;

    use super::*;

    const METRES: f32 = 0.1;

    fn oak() -> Document {
        let species = species::find("oak").unwrap_or_else(|| panic!("there are oaks"));
        let mut document = Document::new(4);
        for action in script(species) {
            let done = document.apply(&Principal::visitor(), &action.into());
            done.unwrap_or_else(|problem| panic!("{problem}"));
        }
        document
    }

    fn swaying(document: &mut Document) -> Swaying {
        let options =
            StyleOptions { girth_exponent: 2.0, twig_diameter: 0.1, leaves_per_node: 2, leaf_size: 0.5 };
        Swaying::of(document.portrait(), &Style::new(options), &WindLook::default(), METRES, &[])
    }

    /// How far the joints of a level carry the node of each row for each radian about all three axes, root mean square.
    fn carried(swaying: &Swaying, level: u32) -> Vec<f64> {
        let Swaying { joints, wood, .. } = swaying;
        let small = 1e-4;
        let mut squares = vec![0.0; wood.len()];
        for axis in DVec3::AXES {
            let bend = |at: u32| if at == level { axis * small } else { DVec3::ZERO };
            let bends: Vec<DVec3> = joints.all().iter().map(|joint| bend(joint.level)).collect();
            let pose = Pose::of(joints, wood, &bends);
            for row in 0..wood.len() as u32 {
                let shift = pose.node(joints, wood, row).place - wood.place(row);
                squares[row as usize] += (shift / small).length_squared();
            }
        }
        // About three axes a way is turned by twice its square in all.
        squares.into_iter().map(|square: f64| (0.5 * square).sqrt()).collect()
    }

    #[test]
    fn a_vertex_moves_as_far_as_its_joints_carry_it() {
        let swaying = swaying(&mut oak());
        let weights = WindWeights::of(&swaying);
        let Measures { trunk, limb, trunk_frequency, limb_frequency } = weights.measures();
        assert!(trunk > 0.0 && limb > 0.0 && limb_frequency > trunk_frequency && trunk_frequency > 0.0);
        let [by_trunk, by_limb] = [0, 1].map(|level| carried(&swaying, level));
        let mut phases = Vec::new();
        for row in 0..swaying.wood.len() as u32 {
            let place = swaying.wood.place(row).as_vec3();
            let own = weights.of_vertex(Rider { row, share: 1.0, flutter: 0.25 }, place);
            let at = row as usize;
            assert!((f64::from(own.trunk) * trunk - by_trunk[at]).abs() < 2e-3 * trunk, "{own:?}");
            assert!((f64::from(own.limb) * limb - by_limb[at]).abs() < 2e-3 * limb, "{own:?}");
            assert!(own.flutter == 0.25 && (0.0..1.0).contains(&own.phase));
            phases.push(own.phase);
        }
        phases.sort_by(f32::total_cmp);
        phases.dedup();
        assert!(phases.len() > 5, "limbs are out of phase");
    }

    /// The shaders in `docs/shaders` move a vertex along the wind by its weights times the angles of trunk and limb. What
    /// they miss of the pose of the same joints is that wide limbs go down and up as well.
    #[test]
    fn the_shift_of_shaders_is_near_that_of_motion() {
        let swaying = swaying(&mut oak());
        let weights = WindWeights::of(&swaying);
        let Measures { trunk, limb, .. } = weights.measures();
        let Swaying { joints, wood, .. } = &swaying;
        for blow in [DVec3::X, DVec3::new(-0.6, 0.0, 0.8)] {
            for angles in [[0.05, 0.0], [0.0, 0.05], [0.03, 0.04]] {
                let about = DVec3::Y.cross(blow);
                let bend =
                    |level: u32| angles.get(level as usize).map_or(DVec3::ZERO, |&angle| angle * about);
                let bends: Vec<DVec3> = joints.all().iter().map(|joint| bend(joint.level)).collect();
                let pose = Pose::of(joints, wood, &bends);
                let [mut missed, mut level, mut moved] = [0.0; 3];
                for row in 0..wood.len() as u32 {
                    let own =
                        weights.of_vertex(Rider { row, share: 1.0, flutter: 0.0 }, wood.place(row).as_vec3());
                    let far =
                        f64::from(own.trunk) * trunk * angles[0] + f64::from(own.limb) * limb * angles[1];
                    let shift = pose.node(joints, wood, row).place - wood.place(row);
                    missed += (far * blow - shift).length_squared();
                    let along = far - shift.dot(blow);
                    level += along * along;
                    moved += shift.length_squared();
                }
                let [missed, level] = [missed, level].map(|square: f64| (square / moved).sqrt());
                println!("{angles:?}: misses {missed:.3}, along the wind {level:.3}");
                assert!(missed < 0.5 && level < 0.25, "{missed} and {level}");
            }
        }
    }

    #[test]
    fn what_is_no_tree_stands_still() {
        let swaying = swaying(&mut Document::new(1));
        let weights = WindWeights::of(&swaying);
        let rider = Rider { row: 0, share: 1.0, flutter: 0.0 };
        assert_eq!(weights.of_vertex(rider, Vec3::Y), Weights::default());
        assert_eq!(weights.measures().trunk, 0.0);
    }
}
