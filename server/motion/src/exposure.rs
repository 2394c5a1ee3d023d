//! How much of the wind reaches what each joint bears.

use crate::{NONE, joints::Joints, wind::profile, wood::Wood};

/// For each joint its wind as a share of the open wind's speed at 10 m.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposure(Vec<f64>);

impl Exposure {
    /// The same wind everywhere.
    pub fn even(joints: &Joints) -> Self {
        Self(vec![1.0; joints.all().len()])
    }

    /// By height above the ground and by the shares that rows get behind what shelters them: the mean of (p s)², weighted
    /// by the drag area of what a joint bears. One number a joint keeps its answer the same matrix for every wind; with
    /// weights by row the matrix would depend on the wind's direction.
    pub fn of(joints: &Joints, wood: &Wood, shares: &[f64]) -> Self {
        let mut area = wood.drag_area.clone();
        let mut pressed: Vec<f64> = (0..wood.len())
            .map(|row| {
                let speed = profile(wood.middle(row).y) * shares[row];
                area[row] * speed * speed
            })
            .collect();
        for row in (0..wood.len()).rev() {
            let node = wood.parent[row];
            if node != NONE {
                area[node as usize] += area[row];
                pressed[node as usize] += pressed[row];
            }
        }
        let of = |first: u32| (pressed[first as usize] / area[first as usize]).sqrt();
        Self(joints.all().iter().map(|joint| of(joint.first)).collect())
    }

    /// By joint.
    pub fn shares(&self) -> &[f64] {
        &self.0
    }
}
