//! What hands do to designed wood, as edits of its design: so it survives the next time that wood is made.
//!
//! Each is private to the branch that was touched: what it bears follows its shape, and inherits as before.

use espalier_plant::wood::SHORTEST;
use glam::{Quat, Vec3};

use crate::{
    axis::{OUTSIDE, Placed, lay, unturned, waves},
    curve::{Curve, MOST_POINTS},
    design::Design,
    edit::{Edit, Standing},
    envelope::{Envelope, FARTHEST},
    frame::{of_tip, rolled, turn_between, upward},
    function::Function,
    generator::Generated,
    graph::{Owner, Setting, Source},
    key::Key,
    node::NodeId,
    resolution::{Branch, MAX_BRANCHES},
    value::{Held, Value},
};

/// How far a fitted axis may be off the places it was bent to, in internodes.
const EXACT: f32 = 0.1;

/// Why a hand changes nothing of a design.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Untouched {
    /// The branch is no wood.
    #[error("branch {0} is no wood of this design")]
    NoWood(NodeId),
    /// The places are not those of an axis.
    #[error("{found} places were given for an axis of {wanted} nodes")]
    OtherNodes {
        /// Places given.
        found: usize,
        /// Nodes of the axis.
        wanted: usize,
    },
    /// A number that nothing can be made of.
    #[error("{what} is {found}; allowed is {allowed}")]
    NotAllowed {
        /// What it is.
        what: &'static str,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The branch does not sleep.
    #[error("branch {0} does not sleep")]
    Awake(NodeId),
    /// There is no room for it, however many others come.
    #[error("branch {0} cannot wake: its bearer bears no branches, or can bear no more")]
    NoRoom(NodeId),
}

fn private(node: NodeId, key: Key, value: Value) -> Edit {
    let setting = Setting::own(Held::new(value));
    let setting = if node == NodeId::ROOT { setting } else { setting.private() };
    Edit::Set { owner: Owner::Node(node), key, setting }
}

/// Bends the axis of a branch so that its nodes, from the base to the tip, come to lie at these places.
///
/// # Errors
/// Where the branch is no wood, or the places are not those of its nodes.
pub fn bend(
    design: &Design,
    generated: &Generated,
    node: NodeId,
    places: &[Vec3],
) -> Result<Edit, Untouched> {
    let placed = generated.placed(node).ok_or(Untouched::NoWood(node))?;
    let rows: Vec<u32> = generated.rows(node).collect();
    if rows.len() != places.len() || rows.is_empty() {
        return Err(Untouched::OtherNodes { found: places.len(), wanted: rows.len() });
    }
    if let Some(place) = places.iter().find(|place| !place.is_finite()) {
        let allowed = "a place in space";
        return Err(Untouched::NotAllowed { what: "a place", found: place.to_string(), allowed });
    }
    // What was cut off bends as the last internode does, so that the axis keeps its length.
    let mut line = vec![placed.base];
    line.extend_from_slice(places);
    let values = &placed.values;
    let cut = values.scalar(Key::Cut);
    if cut < 1.0 && line.len() > 1 {
        let [before, last] = [line[line.len() - 2], line[line.len() - 1]];
        let rest = placed.length * values.curve(Key::Axis).length() * (1.0 - cut);
        line.push(last + (last - before).normalize_or(placed.frame.y_axis) * rest);
    }
    let chord = line[line.len() - 1] - placed.base;
    if chord.length() < SHORTEST {
        let (found, allowed) = (chord.length().to_string(), "0.01 internodes or more");
        return Err(Untouched::NotAllowed { what: "the way from base to tip", found, allowed });
    }
    let mut edits = towards(design, generated, node, chord)?;
    let direction = chord.normalize();
    // How the frame will stand once the branch goes there.
    let frame = match node.bearer() {
        None => of_tip(&pointing(placed, chord)),
        Some((bearer, _)) => {
            let heading = heading_at(design, generated, bearer, node).ok_or(Untouched::NoWood(node))?;
            rolled(upward(direction, heading), values.scalar(Key::Roll))
        }
    };
    let back = frame.transpose();
    // Chance will have its part in these places again.
    let seed = design.graph().seed();
    let off = |at: usize| {
        let row = at.checked_sub(1).and_then(|row| rows.get(row));
        row.map_or(Vec3::ZERO, |&row| waves(placed, seed, generated.places[row as usize]))
    };
    let own: Vec<Vec3> = (line.iter().enumerate())
        .map(|(at, &place)| back * (place - placed.base) / chord.length() - off(at))
        .collect();
    let curve = fitted(&own, EXACT / chord.length());
    edits.push(private(node, Key::Axis, Value::Curve(curve)));
    Ok(Edit::Batch(edits))
}

/// Turns a branch about its base.
///
/// # Errors
/// Where the branch is no wood.
pub fn turn(design: &Design, generated: &Generated, node: NodeId, by: Quat) -> Result<Edit, Untouched> {
    let placed = generated.placed(node).ok_or(Untouched::NoWood(node))?;
    if !by.is_finite() || by.length_squared() < 1e-6 {
        return Err(Untouched::NotAllowed {
            what: "the turn",
            found: by.to_string(),
            allowed: "a unit quaternion",
        });
    }
    let chord = by.normalize() * (placed.frame.y_axis * placed.length);
    Ok(Edit::Batch(towards(design, generated, node, chord)?))
}

/// How near to 1 a reach must come to be 1: then the branch goes on following its bearer's outline.
const ON_OUTLINE: f32 = 0.04;

/// Turns and stretches a branch about its base until its tip comes to lie at a place, as near as can be. Where that is
/// all but on the bearer's outline, it is on it.
///
/// # Errors
/// Where the branch is no wood, or the place is none or its own base.
pub fn aim(design: &Design, generated: &Generated, node: NodeId, tip: Vec3) -> Result<Edit, Untouched> {
    let placed = generated.placed(node).ok_or(Untouched::NoWood(node))?;
    let chord = tip - placed.base;
    if !(chord.is_finite() && chord.length() >= SHORTEST) {
        let allowed = "a place in space, 0.01 internodes or more from the base";
        return Err(Untouched::NotAllowed { what: "the tip", found: tip.to_string(), allowed });
    }
    let mut edits = towards(design, generated, node, chord)?;
    for edit in &mut edits {
        if let Edit::Set { key: Key::Reach, setting, .. } = edit
            && let Source::Explicit(held) = &setting.source
            && let Value::Scalar(reach) = held.get()
            && (reach - 1.0).abs() < ON_OUTLINE
        {
            *edit = private(node, Key::Reach, Value::Scalar(1.0));
        }
    }
    Ok(Edit::Batch(edits))
}

/// Gives a branch this radius, in internodes, at a place of its axis; above and below it tapers as before.
///
/// # Errors
/// Where the branch is no wood, or the radius is none.
pub fn widen(generated: &Generated, node: NodeId, t: f32, radius: f32) -> Result<Edit, Untouched> {
    let placed = generated.placed(node).ok_or(Untouched::NoWood(node))?;
    if !(radius.is_finite() && radius > 0.0) {
        return Err(Untouched::NotAllowed {
            what: "the radius",
            found: radius.to_string(),
            allowed: "more than 0",
        });
    }
    let share = radius / placed.values.function(Key::Taper).at(t);
    let (key, base) = match node.bearer() {
        None => (Key::Stem, share),
        Some((bearer, _)) => {
            let bearer = generated.placed(bearer).ok_or(Untouched::NoWood(node))?;
            (Key::Girth, share / bearer.radius_at(placed.t))
        }
    };
    let (least, most) = key.row().range;
    Ok(private(node, key, Value::Scalar(base.clamp(least, most))))
}

/// Cuts a branch at a place of its axis; at its base all of it goes.
///
/// # Errors
/// Where the branch is no wood.
pub fn cut(generated: &Generated, node: NodeId, t: f32) -> Result<Edit, Untouched> {
    let placed = generated.placed(node).ok_or(Untouched::NoWood(node))?;
    let first = generated.rows(node).next().map_or(0.0, |row| generated.places[row as usize]);
    // Less than one internode would be none.
    if t < first && node != NodeId::ROOT {
        return Ok(private(node, Key::Shown, Value::Scalar(0.0)));
    }
    let t = t.clamp(0.0, placed.values.scalar(Key::Cut));
    Ok(private(node, Key::Cut, Value::Scalar(t)))
}

/// Wakes a branch that sleeps: gives its bearer as many more laterals as it takes.
///
/// # Errors
/// Where it does not sleep, or cannot wake.
pub fn wake(design: &Design, node: NodeId) -> Result<Edit, Untouched> {
    let no_room = || Untouched::NoRoom(node);
    let (bearer, _) = node.bearer().ok_or(Untouched::Awake(node))?;
    match design.standing(node) {
        Standing::Awake => return Err(Untouched::Awake(node)),
        Standing::Asleep(asleep) if asleep == node => {}
        Standing::Asleep(_) | Standing::Unknown => return Err(no_room()),
    }
    let branch = design.branch(bearer).ok_or_else(no_room)?;
    let density = branch.values().function(Key::Density);
    let (_, most) = Key::Density.row().range;
    let whorl = branch.values().scalar(Key::Whorl);
    let (first, last) = branch.values().span(Key::Zone);
    let asleep =
        design.asleep().filter(|other| other.bearer().map(|(bearer, _)| bearer) == Some(bearer)).count();
    for more in 1..=asleep.max(1) {
        let add = whorl * more as f32 / (last - first).max(0.01);
        let points: Vec<_> =
            density.points().iter().map(|&(t, value)| (t, (value + add).min(most))).collect();
        let Ok(function) = Function::new(&points) else { break };
        let edit = private(bearer, Key::Density, Value::Function(function));
        let mut tried = design.clone();
        if tried.apply(&edit).is_ok() && tried.root().count() <= MAX_BRANCHES && tried.branch(node).is_some()
        {
            return Ok(edit);
        }
    }
    Err(no_room())
}

/// What lets a branch go from its base to its tip by this way.
fn towards(
    design: &Design,
    generated: &Generated,
    node: NodeId,
    chord: Vec3,
) -> Result<Vec<Edit>, Untouched> {
    let placed = generated.placed(node).ok_or(Untouched::NoWood(node))?;
    let Some((bearer, _)) = node.bearer() else {
        let values = &placed.values;
        let envelope = pointing(placed, chord);
        let (least, most) = Key::Height.row().range;
        let height = (chord.length() / values.scalar(Key::Reach).max(1e-3)).clamp(least, most);
        return Ok(vec![
            private(node, Key::Silhouette, Value::Envelope(envelope)),
            private(node, Key::Height, Value::Scalar(height)),
        ]);
    };
    let (branch, of_bearer) = match (design.branch(node), design.branch(bearer), generated.placed(bearer)) {
        (Some(branch), Some(of_bearer), Some(placed)) => (branch, (of_bearer, placed)),
        _ => return Err(Untouched::NoWood(node)),
    };
    let (borne, on) = of_bearer;
    let seed = design.graph().seed();
    let laid = lay(borne, on, seed);
    let at = laid.laterals.iter().find(|(lateral, _)| lateral.id() == node).map(|&(_, at)| laid.nodes[at]);
    let at = at.ok_or(Untouched::NoWood(node))?;
    let direction = chord.normalize();
    let free = unturned(branch, on, &at, seed);
    let turn = on.frame.transpose() * turn_between(free, direction);
    let wanted = on.distance(placed.base, direction).unwrap_or(OUTSIDE);
    let (least, most) = Key::Reach.row().range;
    Ok(vec![
        private(node, Key::Turn, Value::Vector(turn)),
        private(node, Key::Reach, Value::Scalar((chord.length() / wanted).clamp(least, most))),
    ])
}

/// The outline of a stem whose tip goes elsewhere; the rest of the outline stays where it is.
fn pointing(stem: &Placed, chord: Vec3) -> Envelope {
    let (_, scale) = stem.outline();
    let tip = (chord / scale).clamp(Vec3::splat(-FARTHEST), Vec3::splat(FARTHEST));
    Envelope { tip, ..stem.values.envelope(Key::Silhouette).clone() }
}

/// The heading of a bearer where a lateral begins.
fn heading_at(design: &Design, generated: &Generated, bearer: NodeId, lateral: NodeId) -> Option<Vec3> {
    let (branch, placed): (&Branch, _) = (design.branch(bearer)?, generated.placed(bearer)?);
    let laid = lay(branch, placed, design.graph().seed());
    let at = laid.laterals.iter().find(|(found, _)| found.id() == lateral)?.1;
    Some(laid.nodes[at].heading)
}

/// A curve of few points near a polyline from the origin to (0, 1, 0).
pub(crate) fn fitted(line: &[Vec3], exact: f32) -> Curve {
    let mut kept = vec![0, line.len() - 1];
    loop {
        let points: Vec<Vec3> = kept.iter().map(|&at| ends(line, at)).collect();
        let Ok(curve) = Curve::new(&points) else { return Curve::straight() };
        if kept.len() == MOST_POINTS {
            return curve;
        }
        let off = |at: usize| {
            let near = (0..=64).map(|step| curve.at(step as f32 / 64.0).distance(line[at]));
            near.fold(f32::INFINITY, f32::min)
        };
        let farthest = (1..line.len() - 1)
            .filter(|at| !kept.contains(at))
            .map(|at| (off(at), at))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match farthest {
            Some((distance, at)) if distance > exact => {
                let place = kept.partition_point(|&kept| kept < at);
                let is_apart = [kept[place - 1], kept[place]]
                    .into_iter()
                    .all(|other| line[at].distance(line[other]) > 2e-3);
                if !is_apart {
                    return curve;
                }
                kept.insert(place, at);
            }
            _ => return curve,
        }
    }
}

/// A place of a line whose ends are exactly those of a curve.
fn ends(line: &[Vec3], at: usize) -> Vec3 {
    match at {
        0 => Vec3::ZERO,
        at if at + 1 == line.len() => Vec3::Y,
        at => line[at],
    }
}
