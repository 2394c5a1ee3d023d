//! One gust from rest to rest: as each joint answers it by itself, and as bodies do that hang together.

use glam::{DQuat, DVec3};

use super::{Clip, Conditions, GUST, KEYS_A_SECOND, LOOP, keys};
use crate::{
    Direction, Joints, Limbs, Rig, Wind, Wood,
    answers::{Answer, Answers, pressure},
    bodies::{AHEAD, Bodies, Gathered, Hinge},
    sway::limited,
    wind::{CONVECTION, profile},
};

/// When the gust comes, when it goes, and from when on what still swings is brought to rest, s.
const COMES: f64 = 0.5;
const GOES: f64 = 4.5;
const CALMS: f64 = 9.5;
/// The seconds in which it comes and goes at one place.
const FRONT: f64 = 1.2;
/// How much stronger its load is than that of the mean wind.
const STRONGER: f64 = 1.6;
/// The longest that its front takes from the first to the last of a scene, s.
const CROSSES: f64 = 1.5;
/// Steps of bodies for each key.
const STEPS: u32 = 4;

/// The load comes and goes at once, and each joint answers by itself as a damped oscillator does.
pub(super) fn alone(answers: &Answers) -> Clip {
    let of = |time: f64| -> Vec<DVec3> {
        let bend = |answer: &Answer| {
            let share = risen(answer, time - COMES) - risen(answer, time - GOES);
            limited(answer.rest + STRONGER * left(time) * share * (answer.mean - answer.rest))
        };
        answers.all().iter().map(bend).collect()
    };
    let keys = (0..keys(GUST)).map(|key| of(f64::from(key) / f64::from(KEYS_A_SECOND))).collect();
    Clip { name: "Gust", length: GUST, keys }
}

/// What is left of swings at a time: all of them until they are brought to rest.
fn left(time: f64) -> f64 {
    smooth((GUST - time) / (GUST - CALMS))
}

fn smooth(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// How far an oscillator has come, of where a load holds it that came so long ago; by and by, as gusts come within a second.
fn risen(answer: &Answer, gone: f64) -> f64 {
    if gone <= 0.0 {
        return 0.0;
    }
    let Answer { rate, damping, .. } = *answer;
    let damped = rate * (1.0 - damping * damping).sqrt();
    let (sin, cos) = libm::sincos(damped * gone);
    let step = 1.0 - libm::exp(-damping * rate * gone) * (cos + damping * rate / damped * sin);
    // Stiff limbs follow the load itself, which takes its time.
    step * smooth(gone / FRONT)
}

/// Steps bodies, one for each piece of all rigs, and replaces what their joints do: all of it beside how they rest, as
/// answers in closed form add up.
pub(super) fn together<E>(
    clip: &mut Clip,
    rigs: &[Rig],
    (joints, limbs, wood): (&Joints, &Limbs, &Wood),
    conditions: &Conditions,
    mut go_on: impl FnMut() -> Result<(), E>,
) -> Result<(), E> {
    let hinges = hinges(rigs, joints, limbs, wood);
    let hinge = |row: u32| hinges.binary_search_by_key(&row, |&(row, _)| row).ok().map(|at| hinges[at].1);
    let mut bodies = Bodies::hinged(wood, AHEAD, hinge);
    let mut air = Air::around(&mut bodies, wood, conditions);
    let step = 1.0 / f64::from(STEPS * KEYS_A_SECOND);
    let tips: Vec<Option<u32>> = (0..joints.all().len() as u32)
        .map(|joint| rigs.iter().find_map(|rig| rig.ends(joint).last()))
        .collect();
    let rest = clip.keys.first().cloned().unwrap_or_default();
    for key in 0..clip.keys.len() {
        go_on()?;
        let time = clip.time(key);
        for (((joint, &tip), &rest), bend) in
            joints.all().iter().zip(&tips).zip(&rest).zip(&mut clip.keys[key])
        {
            if let Some(row) = tip {
                let turn = |row: u32| bodies.turn(row).unwrap_or(DQuat::IDENTITY);
                let own = turn(joint.node).inverse() * turn(row);
                // The shorter way round.
                let own = if own.w < 0.0 { -own } else { own };
                let whole = own.to_scaled_axis() / joints.rides()[row as usize].weight;
                *bend = limited(rest + left(time) * whole);
            }
        }
        for part in 0..STEPS {
            let forces = air.forces(&bodies, time + f64::from(part) * step);
            bodies.step(step, forces);
        }
    }
    Ok(())
}

/// Where the pieces of rigs bend, by row: halfway through the softness of each.
fn hinges(rigs: &[Rig], joints: &Joints, limbs: &Limbs, wood: &Wood) -> Vec<(u32, Hinge)> {
    let mut hinges = Vec::new();
    for (at, joint) in joints.all().iter().enumerate() {
        let ends = rigs.iter().flat_map(|rig| rig.ends(at as u32));
        let mut rows = limbs.rows(joint.limb).iter().copied();
        let rate = std::f64::consts::TAU * joint.frequency;
        for end in ends {
            let mut piece = Vec::new();
            for row in rows.by_ref() {
                piece.push(row);
                if row == end {
                    break;
                }
            }
            let whole: f64 = piece.iter().map(|&row| wood.softness_of(row)).sum();
            let mut gone = 0.0;
            let middle = piece.iter().find(|&&row| {
                gone += wood.softness_of(row);
                gone >= 0.5 * whole
            });
            if let Some(&row) = middle.filter(|_| whole > 0.0) {
                let damping = 2.0 * joint.damping / rate;
                hinges.push((row, Hinge { softness: whole * joint.softness, damping }));
            }
        }
    }
    hinges.sort_unstable_by_key(|&(row, _)| row);
    hinges
}

/// The air around bodies while a gust passes.
struct Air {
    wind: Wind,
    /// How much faster than the mean the gust is.
    faster: f64,
    /// Where its front comes from, m along the wind, and how many seconds it takes for a metre.
    from: f64,
    delay: f64,
    /// For each body where the wind takes hold of it, and (p s)² there: its share of the open wind's pressure.
    sails: Vec<Gathered>,
    forces: Vec<DVec3>,
}

impl Air {
    fn around(bodies: &mut Bodies, wood: &Wood, conditions: &Conditions) -> Self {
        let wind = Wind::new(&conditions.weather, LOOP);
        let along = wind.axis(Direction::Along);
        let squares: Vec<f64> = (0..wood.len())
            .map(|row| {
                let speed = profile(wood.middle(row).y) * conditions.shares[row];
                speed * speed
            })
            .collect();
        let sails = bodies.gather(&wood.drag_area, &squares);
        let ways =
            || (0..wood.len()).filter(|&row| wood.length[row] > 0.0).map(|row| along.dot(wood.middle(row)));
        let [from, to] = [ways().fold(f64::INFINITY, f64::min), ways().fold(f64::NEG_INFINITY, f64::max)];
        let (_, exponent) = pressure(wind.speed());
        let faster = libm::pow(STRONGER, 1.0 / exponent);
        let whole = (to - from).max(1e-9);
        let delay = (1.0 / (CONVECTION * wind.speed() * faster)).min(CROSSES / whole);
        Self { faster, from, delay, forces: vec![DVec3::ZERO; sails.len()], sails, wind }
    }

    /// The pressure on each body at a time, by the air's speed past it, Pa.
    fn forces(&mut self, bodies: &Bodies, time: f64) -> &[DVec3] {
        let along = self.wind.axis(Direction::Along);
        for (body, (sail, force)) in self.sails.iter().zip(&mut self.forces).enumerate() {
            let here = time - self.delay * (along.dot(sail.centre) - self.from);
            let share = smooth((here - COMES) / FRONT) - smooth((here - GOES) / FRONT);
            let open = self.wind.velocity(sail.centre, time) / profile(sail.centre.y);
            let past = share * self.faster * sail.mean.sqrt() * open - bodies.speed(body as u32);
            let speed = past.length();
            *force = if speed > 0.0 { pressure(speed).0 / speed * past } else { DVec3::ZERO };
        }
        &self.forces
    }
}
