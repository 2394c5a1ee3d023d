//! How far touches lead.

use glam::DVec3;

use super::{chain::Chain, energy::Pull};

/// How hard a touch pulls, in units of how hard the whole branch resists being stretched.
const WEIGHT: f64 = 100.0;
/// The most that a stiff branch becomes longer, as a share, however far it is pulled.
const GIVE: f64 = 0.02;
/// The most that any does.
const MOST_GIVE: f64 = 100.0;
/// What counts as no wood between touches, as a share of the length.
const NO_WOOD: f64 = 1e-3;
/// How far beside the finger wood is led, as a share of the finger's way: pushed exactly along itself a straight
/// branch would be crushed, for nothing says to which side it should bend.
const ASIDE: f64 = 1e-6;

/// What pulls at the branch. Each touch is followed as far as the wood between it and the touch before reaches,
/// and a little further, the more the stretchier.
pub(super) fn pulls(chain: &Chain, targets: &[(usize, DVec3)]) -> Vec<Pull> {
    let weight = WEIGHT / (chain.length() * chain.length());
    let stiff = 1.0 - f64::from(chain.stretch()).clamp(0.0, 1.0);
    let hold = stiff * stiff * stiff / GIVE;
    let (mut from, mut along) = (chain.node(1), 0.0);
    let mut pulls = Vec::with_capacity(targets.len());
    for &(internode, target) in targets {
        let node = chain.node(internode + 1);
        let way = target - node;
        let target = target + ASIDE * way.length() * aside(chain, node);
        let wood = (chain.along(internode + 1) - along).max(NO_WOOD * chain.length());
        let away = target - from;
        let distance = away.length();
        let excess = (distance / wood - 1.0).min(MOST_GIVE);
        let target = if excess > 0.0 {
            from + away * (wood * (1.0 + excess / (1.0 + hold * excess)) / distance)
        } else {
            target
        };
        pulls.push(Pull { at: chain.end(internode), node, target, weight });
        (from, along) = (target, chain.along(internode + 1));
    }
    pulls
}

/// A direction across the way from the base to a node.
fn aside(chain: &Chain, node: DVec3) -> DVec3 {
    let along = node - chain.node(0);
    let across = if along.x.abs() < along.z.abs() { along.cross(DVec3::X) } else { along.cross(DVec3::Z) };
    across.try_normalize().unwrap_or(DVec3::X)
}
