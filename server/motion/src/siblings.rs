//! Damping of wood, and of limbs that swing in company.

use crate::{Limbs, joints::Joint};

/// Damping of a limb that swings alone, as a share of the critical one, without that of the air: leafless trees have
/// 0.039 (Jackson 2019).
const ALONE: f64 = 0.04;
/// What limbs on one bearer take from each other when they swing nearly alike (James 2003, 2014).
const COMPANY: f64 = 1.3;
/// So many of one bearer within this ratio of frequencies are company.
const MANY: usize = 3;
const ALIKE: f64 = 1.2;

/// Gives each joint its damping.
pub(crate) fn damping_by_company(joints: &mut [Joint], limbs: &Limbs) {
    let keys: Vec<(Option<u32>, f64)> =
        joints.iter().map(|joint| (limbs.all()[joint.limb as usize].bearer, joint.frequency)).collect();
    let mut order: Vec<usize> = (0..joints.len()).collect();
    order.sort_by(|&a, &b| keys[a].0.cmp(&keys[b].0).then(keys[a].1.total_cmp(&keys[b].1)).then(a.cmp(&b)));
    joints.iter_mut().for_each(|joint| joint.damping = ALONE);
    for group in order.chunk_by(|&a, &b| keys[a].0 == keys[b].0) {
        // Trunks stand on the ground, which passes nothing on.
        if keys[group[0]].0.is_none() {
            continue;
        }
        let frequency = |at: usize| keys[group[at]].1;
        let [mut from, mut to] = [0; 2];
        for of in 0..group.len() {
            while ALIKE * frequency(from) < frequency(of) {
                from += 1;
            }
            while to < group.len() && frequency(to) <= ALIKE * frequency(of) {
                to += 1;
            }
            if to - from >= MANY {
                joints[group[of]].damping = ALONE * COMPANY;
            }
        }
    }
}
