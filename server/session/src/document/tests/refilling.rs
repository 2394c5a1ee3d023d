//! Limbs that fill another outline: cut back, grown into what is free, undone, kept and replayed.

use std::collections::BTreeSet;

use espalier_design::Envelope;
use espalier_plant::{AxisId, checks};
use espalier_proto::{DesignValue, HintReason, LimbLength, LimbOutline, OperationKind};
use serde_json::{Value, json};

use super::*;

/// A tree with limbs.
fn grown(seed: u32) -> Document {
    let mut document = Document::new(seed);
    grow(&mut document, 14, None);
    document
}

/// Limbs that leave the trunk, the largest first.
fn limbs(document: &mut Document) -> Vec<LimbOutline> {
    let plant = document.plant();
    let axes = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.axes().order(axis) == 1);
    let first = axes.filter_map(|axis| plant.axes().first(axis)).filter(|&first| plant.is_alive(first));
    let mut rows: Vec<(usize, u32)> = first.map(|first| (plant.above(first).len(), first.raw())).collect();
    rows.sort_by(|a, b| b.cmp(a));
    let limbs = rows.into_iter().take(6).filter_map(|(_, row)| document.limb_at(row));
    limbs.filter(|limb| limb.bearer.is_some()).collect()
}

fn outline(limb: &LimbOutline) -> Envelope {
    Envelope::from_json(limb.envelope.get()).expect("it checks")
}

fn refill(limb: &LimbOutline, envelope: &Envelope, anew: bool) -> Command {
    plain(Action::Refill {
        row: limb.row,
        envelope: DesignValue::from(envelope.to_json()),
        rotation: UnitRotation::nearest(Quat::from_array(limb.frame)),
        length: LimbLength::nearest(limb.length),
        anew,
    })
}

/// The outline of a limb, wider and longer.
fn larger(limb: &LimbOutline) -> Envelope {
    let outline = outline(limb);
    Envelope { top: outline.top + Vec3::Y * 0.3, radii: outline.radii.map(|radius| 1.3 * radius), ..outline }
}

fn inward(limb: &LimbOutline, envelope: &Envelope, place: Vec3) -> Vec3 {
    let scale = limb.length / envelope.tip.length();
    Quat::from_array(limb.frame).inverse() * (place - Vec3::from_array(limb.base)) / scale
}

/// Living rows of a limb, and where they stand.
fn wood_of(document: &Document, row: u32) -> Vec<(MetamerId, Vec3)> {
    let plant = document.plant();
    let above = plant.above(MetamerId::new(row as usize));
    above.into_iter().map(|id| (id, plant.metamers().end(id))).collect()
}

fn wood(document: &Document) -> Vec<(u32, [u32; 3])> {
    let plant = document.plant();
    let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
    living.map(|id| (id.raw(), plant.metamers().end(id).to_array().map(f32::to_bits))).collect()
}

/// Rows from the first of a limb up to its first fork.
fn stem(document: &Document, row: u32) -> Vec<MetamerId> {
    let plant = document.plant();
    let mut stem = vec![MetamerId::new(row as usize)];
    loop {
        let end = stem[stem.len() - 1];
        let living = (end.index() + 1..plant.metamer_count()).map(MetamerId::new);
        let mut children =
            living.filter(|&id| plant.is_alive(id) && plant.metamers().parent(id) == Some(end));
        match (children.next(), children.next()) {
            (Some(only), None) => stem.push(only),
            _ => return stem,
        }
    }
}

/// The silhouettes of a limb's nodes and of an outline, seen along X and along Z: the area in both over that of the
/// outline and over that in either. Leaves cover 0.75 internodes around a node (docs/fidelity.md).
fn cover(limb: &LimbOutline, envelope: &Envelope, nodes: &[Vec3]) -> [f32; 2] {
    const LEAVES: f32 = 0.75;
    const PIXEL: f32 = 0.25;
    let scale = limb.length / envelope.tip.length();
    let turn = Quat::from_array(limb.frame);
    let (low, high) = envelope.bounds();
    let corners = (0..8u8).map(|corner| {
        let pick = |axis: usize| if corner >> axis & 1 > 0 { high[axis] } else { low[axis] };
        Vec3::from_array(limb.base) + turn * Vec3::new(pick(0), pick(1), pick(2)) * scale
    });
    let all: Vec<Vec3> = corners.chain(nodes.iter().copied()).collect();
    let bound = |of: fn(Vec3, Vec3) -> Vec3| all.iter().copied().reduce(of).unwrap_or_default();
    let (low, high) = (bound(Vec3::min) - LEAVES, bound(Vec3::max) + LEAVES);
    let (mut both, mut drawn, mut either) = (0u32, 0u32, 0u32);
    for along in [Vec3::X, Vec3::Z] {
        let across = Vec3::X + Vec3::Z - along;
        let steps = |from: f32, to: f32| 0..((to - from) / PIXEL) as u32;
        for x in steps(low.dot(across), high.dot(across)) {
            for y in steps(low.y, high.y) {
                let at = across * (low.dot(across) + x as f32 * PIXEL) + Vec3::Y * (low.y + y as f32 * PIXEL);
                let is_drawn = steps(low.dot(along), high.dot(along)).any(|z| {
                    let place = at + along * (low.dot(along) + z as f32 * PIXEL);
                    envelope.contains(inward(limb, envelope, place))
                });
                let off = |node: &Vec3| (*node - at) * (Vec3::ONE - along);
                let is_grown = nodes.iter().any(|node| off(node).length_squared() < LEAVES * LEAVES);
                both += u32::from(is_drawn && is_grown);
                drawn += u32::from(is_drawn);
                either += u32::from(is_drawn || is_grown);
            }
        }
    }
    [both as f32 / drawn as f32, both as f32 / either as f32]
}

#[test]
fn ds12_a_limb_fills_a_larger_outline_and_keeps_what_is_below_its_fork() {
    for seed in [1, 2, 3] {
        for anew in [false, true] {
            let mut document = grown(seed);
            let limb = limbs(&mut document).remove(0);
            let envelope = larger(&limb);
            let (before, stem) = (wood(&document), stem(&document, limb.row));
            let elsewhere: BTreeSet<u32> =
                wood_of(&document, limb.row).into_iter().map(|(id, _)| id.raw()).collect();
            let old = document.plant().metamer_count();
            apply(&mut document, &refill(&limb, &envelope, anew));
            let after = wood(&document);
            // What is below the fork, and what is no part of the limb, is the same to the bit.
            let is_kept = |(row, _): &&(u32, [u32; 3])| {
                !elsewhere.contains(row) || stem.iter().any(|id| id.raw() == *row)
            };
            assert!(before.iter().filter(is_kept).all(|row| after.contains(row)), "seed {seed}");
            let nodes = wood_of(&document, limb.row);
            for (id, place) in nodes.iter().filter(|(id, _)| !stem.contains(id) && id.index() < old) {
                assert!(!anew, "row {} stands above the fork", id.raw());
                assert!(envelope.contains(inward(&limb, &envelope, *place)), "{place} is outside");
            }
            let grown: Vec<Vec3> = nodes.iter().map(|(_, place)| *place).collect();
            let [filled, overlap] = cover(&limb, &envelope, &grown);
            assert!(filled >= 0.85 && overlap >= 0.85, "seed {seed}: {filled} filled, overlap {overlap}");
        }
    }
}

fn kinds(document: &Document) -> Vec<OperationKind> {
    document.timeline().operations.iter().map(|operation| operation.kind).collect()
}

#[test]
fn ds12_a_smaller_outline_cuts_what_lies_outside_and_nothing_else() {
    let mut document = grown(2);
    let limb = limbs(&mut document).remove(0);
    let envelope = outline(&limb);
    let half = Envelope {
        top: envelope.top * Vec3::new(1.0, 0.6, 1.0),
        heights: envelope.heights.map(|height| 0.5 * height),
        radii: envelope.radii.map(|radius| 0.6 * radius),
        ..envelope
    };
    assert_eq!(half.check(), Ok(()));
    let (before, stem) = (wood_of(&document, limb.row), stem(&document, limb.row));
    apply(&mut document, &refill(&limb, &half, false));
    let is_inside = |place: Vec3| half.contains(inward(&limb, &half, place));
    for (id, place) in &before {
        let parent = document.plant().metamers().parent(*id).filter(|_| id.raw() != limb.row);
        let stands = stem.contains(id)
            || is_inside(*place) && parent.is_none_or(|parent| document.plant().is_alive(parent));
        assert_eq!(document.plant().is_alive(*id), stands, "row {}", id.raw());
    }
    assert!(before.iter().any(|(id, _)| !document.plant().is_alive(*id)), "something is cut");
    assert_eq!(checks::all(document.plant()), Ok(()));
}

#[test]
fn ds12_a_refill_is_one_operation_that_is_undone_redone_kept_and_replayed() {
    for anew in [false, true] {
        let mut document = grown(3);
        let limb = limbs(&mut document).remove(0);
        let before = wood(&document);
        let command = refill(&limb, &larger(&limb), anew);
        apply(&mut document, &command);
        let filled = wood(&document);
        assert_ne!(filled, before);
        assert_eq!(kinds(&document), [OperationKind::Growth, OperationKind::Refill]);
        assert_eq!(checks::all(document.plant()), Ok(()));
        let kept = Document::from_bytes(&document.to_bytes()).expect("it is whole");
        assert_eq!((kept.hash(), wood(&kept)), (document.hash(), filled.clone()));
        // On however many threads it comes to the same.
        for threads in [1, 8] {
            let pool =
                rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("there are threads");
            let again = pool.install(|| {
                let mut again = grown(3);
                apply(&mut again, &command);
                wood(&again)
            });
            assert!(again == filled, "other wood on {threads} threads");
        }
        apply(&mut document, &plain(Action::Undo {}));
        assert_eq!(wood(&document), before);
        apply(&mut document, &plain(Action::Redo {}));
        assert_eq!(wood(&document), filled);
        // Growth goes on from there.
        let mut later = document.clone();
        grow(&mut later, 2, None);
        assert_eq!(checks::all(later.plant()), Ok(()));
    }
}

#[test]
fn ds12_a_limb_that_is_cut_to_its_fork_gets_a_bud_there() {
    for seed in 1..=4 {
        let mut document = grown(seed);
        for limb in limbs(&mut document).into_iter().take(3) {
            let axes = document.plant().axis_count();
            let stem = stem(&document, limb.row);
            let fork = stem[stem.len() - 1];
            apply(&mut document, &refill(&limb, &outline(&limb), true));
            let plant = document.plant();
            let above = wood_of(&document, limb.row);
            assert!(above.len() > 2 * stem.len(), "seed {seed}: {} rows", above.len());
            let sprout = plant.laterals(fork).find(|axis| axis.index() >= axes);
            assert!(sprout.is_some_and(|axis| plant.has_grown(axis)), "seed {seed}: it goes on at the fork");
            assert_eq!(checks::all(plant), Ok(()));
        }
    }
}

#[test]
fn ds12_a_refill_is_a_deed_of_its_author() {
    let mut document = grown(3);
    let limb = limbs(&mut document).remove(0);
    let before = wood(&document);
    document.apply(&who("bo"), &refill(&limb, &larger(&limb), false)).expect("there is room");
    let seed = Action::PlantSeed { position: Position::nearest(Vec3::X * 60.0) };
    document.apply(&who("cy"), &plain(seed)).expect("it is free");
    document.apply(&who("bo"), &plain(take_back_by(&[]))).expect("nobody has built on it");
    let now = wood(&document);
    assert!(before.iter().all(|row| now.contains(row)), "what was cut stands again");
    assert_eq!(now.len(), before.len() + 1, "and the seed of somebody else stays");
    document.apply(&who("bo"), &plain(bring_back_by(&[]))).expect("it was the last");
    assert_eq!(checks::all(document.plant()), Ok(()));
    assert!(wood(&document).len() > before.len() + 1);
}

#[test]
fn ds12_a_stop_ends_it_and_keeps_what_has_grown() {
    let mut document = grown(1);
    let limb = limbs(&mut document).remove(0);
    let command = refill(&limb, &larger(&limb), true);
    let mut whole = document.clone();
    apply(&mut whole, &command);
    document.begin(&who("ann"), &command).expect("there is room");
    assert!(document.figures().pending_steps >= 1);
    assert!(document.advance());
    document.stop_at(Some(document.steps_begun() + 1));
    while document.advance() {}
    assert_eq!(document.take_outcome(), Ok(()));
    assert!(document.plant().step() < whole.plant().step());
    assert_eq!(kinds(&document).last(), Some(&OperationKind::Refill));
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(wood(&document), wood(&grown(1)));
}

#[test]
fn ds12_what_cannot_be_filled_is_refused() {
    let mut document = grown(2);
    let limb = limbs(&mut document).remove(0);
    let ovoid = outline(&limb);
    let with = |change: &dyn Fn(&mut Value)| {
        let mut envelope = ovoid.to_json();
        change(&mut envelope);
        plain(Action::Refill {
            row: limb.row,
            envelope: DesignValue::from(envelope),
            rotation: UnitRotation::IDENTITY,
            length: LimbLength::nearest(8.0),
            anew: false,
        })
    };
    let mut expect = |command: &Command, reason: Reason, field: &str| {
        let found = problem(&mut document, command);
        assert_eq!((found.reason, found.field.as_deref()), (reason, Some(field)), "{found}");
    };
    let row = |row: u32| refill(&LimbOutline { row, ..limb.clone() }, &ovoid, false);
    expect(&row(99_999), Reason::BranchGone, "row");
    expect(&row(0), Reason::BranchGone, "row");
    expect(&with(&|it| it["radii"] = json!([1, 1, 1, 9])), Reason::OutOfRange, "envelope.radii[3]");
    expect(&with(&|it| it["heights"][1] = json!(-3)), Reason::OutOfRange, "envelope.heights[1]");
    expect(&with(&|it| it["bottom"] = json!([0, 3, 0])), Reason::OutOfRange, "envelope.top");
    expect(&with(&|it| it["more"] = json!(1)), Reason::Malformed, "envelope.more");
    expect(&with(&|it| *it = json!(7)), Reason::Malformed, "envelope");
    let wide = Envelope { radii: [4.0; 4], ..ovoid.clone() };
    let far = LimbOutline { length: 400.0, ..limb.clone() };
    expect(&refill(&far, &wide, false), Reason::NoRoom, "envelope");
    let large = LimbOutline { length: 100.0, ..limb.clone() };
    expect(&refill(&large, &wide, false), Reason::TreeFull, "envelope");
    let beside = Envelope {
        top: Vec3::Y * 4.0,
        bottom: Vec3::Y * 3.6,
        heights: [3.8; 4],
        radii: [0.1; 4],
        ..ovoid.clone()
    };
    let away = LimbOutline { length: 12.0, ..limb.clone() };
    expect(&refill(&away, &beside, false), Reason::NoRoom, "envelope");
    let dead = {
        let rows = list(vec![limb.row]);
        apply(&mut document, &plain(Action::Prune { rows }));
        row(limb.row)
    };
    assert_eq!(problem(&mut document, &dead).reason, Reason::BranchGone);
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &plain(Action::StrokeBegin { stroke: 1, bud: None }));
    assert_eq!(problem(&mut document, &row(limb.row)).reason, Reason::BeingDrawn);
}

#[test]
fn ds12_designed_wood_is_shaped_by_its_design_until_something_grows_on_it() {
    let mut document = Document::new(5);
    apply(&mut document, &designing::begin(8.0));
    let row = document.plant().metamer_count() as u32 - 1;
    assert_eq!(document.limb_at(row), None);
    let ovoid = DesignValue::from(Envelope::default().to_json());
    let (rotation, length) = (UnitRotation::IDENTITY, LimbLength::nearest(8.0));
    let command = plain(Action::Refill { row, envelope: ovoid, rotation, length, anew: false });
    let refused = problem(&mut document, &command);
    assert_eq!((refused.reason, refused.field.as_deref()), (Reason::DesignRefused, Some("row")));
    grow(&mut document, 1, None);
    let limb = document.limb_at(row).expect("it is wood like any other");
    apply(&mut document, &refill(&limb, &larger(&limb), false));
    assert_eq!(kinds(&document).last(), Some(&OperationKind::Refill));
}

#[test]
fn sg2_a_refill_in_which_nothing_grows_is_said_and_is_no_operation() {
    let mut document = grown(2);
    let limb = limbs(&mut document).pop().expect("there are limbs");
    let command = refill(&limb, &larger(&limb), false);
    apply(&mut document, &command);
    assert_eq!(document.take_drawn_in_vain(), []);
    apply(&mut document, &plain(Action::Undo {}));
    // All of it lies in a box, where nothing grows.
    let obstacle = json!({
        "shape": { "kind": "box", "size": [400, 400, 400] },
        "pose": { "position": [0, 0, 0], "rotation": [0, 0, 0, 1] },
    });
    let obstacle = serde_json::from_value(obstacle).expect("it is one");
    apply(&mut document, &plain(Action::PlaceObstacle { obstacle }));
    let (operations, before) = (kinds(&document), wood(&document));
    let ovoid = outline(&limb);
    let roomy = Envelope {
        top: ovoid.top + Vec3::Y,
        bottom: ovoid.bottom - Vec3::Y,
        radii: [1.5; 4],
        upper: 8.0,
        lower: 8.0,
        ..ovoid
    };
    apply(&mut document, &refill(&limb, &roomy, false));
    assert_eq!((kinds(&document), wood(&document)), (operations, before));
    let said = document.take_drawn_in_vain();
    assert_eq!(said.iter().map(|said| said.reason).collect::<Vec<_>>(), [HintReason::NothingGrew]);
}

#[test]
fn ds13_the_limb_of_a_row_begins_where_it_leaves_its_bearer() {
    let mut document = grown(1);
    let trunk = document.limb_at(1).expect("there is a trunk");
    assert_eq!((trunk.row, trunk.bearer, trunk.base, trunk.heading), (1, None, [0.0; 3], [0.0, 1.0, 0.0]));
    for limb in limbs(&mut document) {
        let plant = document.plant();
        let bearer = limb.bearer.map(|bearer| MetamerId::new(bearer as usize)).expect("it is no trunk");
        let first = MetamerId::new(limb.row as usize);
        assert_eq!(plant.metamers().parent(first), Some(bearer));
        assert!(Vec3::from_array(limb.base).distance(plant.metamers().end(bearer)) < 1e-3);
        let envelope = outline(&limb);
        let stem = stem(&document, limb.row);
        let nodes = wood_of(&document, limb.row);
        let crown: Vec<_> = nodes.iter().filter(|(id, _)| !stem.contains(id)).collect();
        let outside =
            crown.iter().filter(|(_, place)| !envelope.contains(inward(&limb, &envelope, *place))).count();
        assert!(outside * 20 <= crown.len(), "{outside} of {} lie outside", crown.len());
        // Whichever row of its own axis is asked for.
        let end = stem[stem.len() - 1].raw();
        assert_eq!(document.limb_at(end), Some(limb));
    }
    assert_eq!((document.limb_at(0), document.limb_at(99_999)), (None, None));
}
