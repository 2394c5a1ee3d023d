//! Whether the nodes and axes of a skeleton fit together, so that a message names the member at fault.

use espalier_plant::Wood;
use glam::Vec3;

use super::member;
use crate::wood::{Fault, Place, malformed, out_of_range};

/// How far the length of a normal, and its cosine to its internode, may be off.
const TOLERANCE: f32 = 1e-3;

/// Checks what has been found to be in range: parents, axes and births.
pub(super) fn check(wood: &Wood) -> Result<(), Fault> {
    check_bearers(wood)?;
    // The last node of each axis so far.
    let mut last: Vec<Option<u32>> = vec![None; wood.axes.len()];
    for (node, at) in wood.nodes.iter().zip(0u32..) {
        let axis = node.axis as usize;
        let bearer = wood.axes[axis].bearer;
        let what = match (node.parent, last[axis]) {
            (None, None) if bearer.is_none() => None,
            (None, None) => {
                let what = "a seed is on this axis, and something bears it";
                return Err(Fault { allowed: Some("null".into()), ..malformed(of_axis(axis), what) });
            }
            (None, Some(_)) => Some("another seed is on this axis"),
            (Some(parent), Some(last)) if parent == last => None,
            (Some(_), Some(_)) => Some("it does not grow from the last metamer of its axis"),
            (Some(parent), None) if bearer == Some(parent) => None,
            (Some(_), None) => Some("it begins its axis, and does not grow from what bears that"),
        };
        if let Some(what) = what {
            return Err(malformed(member(at as usize, "axis"), what));
        }
        last[axis] = Some(at);
        if let (Some(normal), Some(parent)) = (node.normal, node.parent) {
            let heading = (node.end - wood.nodes[parent as usize].end).normalize_or(Vec3::Y);
            let is_unit = (normal.length() - 1.0).abs() < 0.4 * TOLERANCE;
            if !is_unit || normal.dot(heading).abs() >= TOLERANCE {
                let what = format!("it is {normal}");
                let allowed = "a unit vector across the internode";
                return Err(out_of_range(member(at as usize, "normal"), what, allowed));
            }
        }
    }
    Ok(())
}

/// Checks what bears axes, and where their buds point.
fn check_bearers(wood: &Wood) -> Result<(), Fault> {
    for (at, axis) in wood.axes.iter().enumerate() {
        if let Some(bearer) = axis.bearer {
            let is_wood = wood.nodes.get(bearer as usize).is_some_and(|node| node.parent.is_some());
            if !is_wood {
                let allowed = "null, or the number of a metamer that is no seed";
                return Err(out_of_range(of_axis(at), format!("it is {bearer}"), allowed));
            }
        }
        let is_unit = |direction: Vec3| (direction.length() - 1.0).abs() < 0.4 * TOLERANCE;
        if let Some(direction) = axis.direction.filter(|&direction| !is_unit(direction)) {
            let place = Place::Member(format!("axes[{at}].direction"));
            return Err(out_of_range(Some(place), format!("it is {direction}"), "a unit vector"));
        }
    }
    Ok(())
}

fn of_axis(at: usize) -> Option<Place> {
    Some(Place::Member(format!("axes[{at}].bearer")))
}
