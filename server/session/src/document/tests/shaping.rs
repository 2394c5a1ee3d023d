//! Bends, widths, cuts and grafts, and what of them is refused.

use espalier_proto::frame::POSITION_STEPS;

use super::*;

const NO_TURN: Quat = Quat::IDENTITY;

fn begin(bend: u32, base: MetamerId, touches: &[MetamerId]) -> Command {
    let touches = touches.iter().map(|id| id.raw()).collect();
    plain(Action::BendBegin { bend, base: base.raw(), touches: held(touches), stretch: Share::nearest(0.2) })
}

fn end(document: &Document, id: MetamerId) -> Vec3 {
    document.plant().metamers().end(id)
}

#[test]
fn be1_a_bend_is_one_operation_for_undo() {
    let mut document = tree();
    let path = long_path(&document, 8);
    let (top, base) = (path[0], path[7]);
    let (before, place, foot) = (document.plant().hash(), end(&document, top), end(&document, base));
    apply(&mut document, &begin(1, base, &[top]));
    for part in 1..=4 {
        let targets = vec![place + Vec3::X * 0.5 * part as f32];
        apply(&mut document, &plain(Action::BendMove { bend: 1, targets: places(targets) }));
        assert_eq!(document.plant().hash(), before, "BE5: the wood stays until it is let go");
        assert_eq!(document.bend_motions().len(), 1);
    }
    apply(&mut document, &plain(Action::BendEnd { bend: 1 }));
    assert!(end(&document, top).x > place.x + 0.5, "it followed the finger");
    assert_eq!(end(&document, base), foot, "the base never moves");
    assert_eq!(document.timeline().operations.len(), 2);
    let after = document.plant().hash();
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().hash(), before);
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(document.plant().hash(), after);
}

#[test]
fn be1_bends_of_one_gesture_are_one_operation() {
    let mut document = tree();
    let path = long_path(&document, 8);
    let (top, between, base) = (path[0], path[3], path[7]);
    let before = document.plant().hash();
    let bend = |document: &mut Document, bend, touches: &[MetamerId], gesture| {
        let rows = touches.iter().map(|id| id.raw()).collect();
        let base = base.raw();
        apply(
            document,
            &in_gesture(
                gesture,
                Action::BendBegin { bend, base, touches: held(rows), stretch: Share::nearest(0.2) },
            ),
        );
        let targets = touches.iter().map(|&id| end(document, id) + Vec3::new(0.8, -0.2, 0.1)).collect();
        apply(document, &plain(Action::BendMove { bend, targets: places(targets) }));
        apply(document, &plain(Action::BendEnd { bend }));
    };
    bend(&mut document, 1, &[top], Some(5));
    bend(&mut document, 2, &[top, between], Some(5));
    assert_eq!(
        document.timeline().operations.len(),
        2,
        "a finger that joins in makes no operation of its own"
    );
    let after = document.plant().hash();
    bend(&mut document, 3, &[top], Some(6));
    bend(&mut document, 4, &[top], None);
    assert_eq!(document.timeline().operations.len(), 4);
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().hash(), after);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().hash(), before, "both rounds of the gesture went with one undo");
}

#[test]
fn wi1_a_width_dragged_back_leaves_redo_as_it_was() {
    let mut document = tree();
    let row = long_path(&document, 4)[3].raw();
    grow(&mut document, 2, None);
    apply(&mut document, &plain(Action::Undo {}));
    let timeline = document.timeline();
    let width = |diameter: Option<f32>| {
        in_gesture(Some(3), Action::SetWidth { row, diameter: diameter.map(Diameter::nearest) })
    };
    apply(&mut document, &width(Some(0.8)));
    assert_eq!(document.timeline().futures.len(), 1, "TT3: the growth undone is another future");
    apply(&mut document, &width(None));
    assert_eq!(document.timeline(), timeline);
    assert!(document.figures().can_redo);
}

#[test]
fn be4_a_bend_given_up_is_no_operation() {
    let mut document = tree();
    let path = long_path(&document, 6);
    let timeline = document.timeline();
    apply(&mut document, &begin(1, path[5], &[path[0]]));
    apply(
        &mut document,
        &plain(Action::BendMove { bend: 1, targets: places(vec![Vec3::new(3.0, 4.0, 0.0)]) }),
    );
    apply(&mut document, &plain(Action::BendCancel { bend: 1 }));
    apply(&mut document, &begin(2, path[5], &[path[0]]));
    apply(&mut document, &plain(Action::BendEnd { bend: 2 }));
    assert_eq!(document.timeline(), timeline, "one was given up, the other moved nothing");
    for travel in [
        plain(Action::Undo {}),
        plain(Action::Ungrow { steps: Steps::nearest(1) }),
        plain(Action::GoTo { step: 7 }),
    ] {
        apply(&mut document, &begin(3, path[5], &[path[0]]));
        apply(&mut document, &travel);
        assert_eq!(document.open_bends(&who("ann")), [] as [u32; 0], "{travel:?} gives it up");
        apply(&mut document, &plain(Action::GoTo { step: 9 }));
    }
}

#[test]
fn be4_a_bend_brought_back_is_no_operation() {
    let mut document = tree();
    let path = long_path(&document, 6);
    let (before, timeline) = (document.plant().hash(), document.timeline());
    // A client knows where wood is as finely as frames tell it.
    let told = |place: Vec3| (place * POSITION_STEPS).round() / POSITION_STEPS;
    let bent = |document: &mut Document, bend, last: &dyn Fn(Vec3) -> Vec3| {
        let start = [path[0], path[2]].map(|id| end(document, id));
        apply(document, &begin(bend, path[5], &[path[0], path[2]]));
        for targets in [start.map(|place| place + Vec3::X), start.map(last)] {
            apply(document, &plain(Action::BendMove { bend, targets: places(targets.to_vec()) }));
        }
        apply(document, &plain(Action::BendEnd { bend }));
    };
    bent(&mut document, 1, &told);
    assert_eq!((document.plant().hash(), document.timeline()), (before, timeline), "nothing has moved");
    assert!(document.bend_motions().is_empty());
    bent(&mut document, 2, &|place| told(place) + Vec3::Y * 3.0 / POSITION_STEPS);
    assert_eq!(document.timeline().operations.len(), 2, "a bend that moves wood a little is one");
}

#[test]
fn be1_impossible_bends_name_what_is_wrong() {
    use ProblemCode::{NotFound, OutOfRange, Refused};
    let mut document = tree();
    let path = long_path(&document, 6);
    let (top, base) = (path[0], path[5]);
    let elsewhere = *laterals(&document).iter().find(|id| !path.contains(id)).expect("there are many");
    let far = MetamerId::new(1_000_000);
    for (action, code, field) in [
        (begin(1, far, &[top]), NotFound, "base"),
        (begin(1, MetamerId::new(0), &[top]), NotFound, "base"),
        (begin(1, base, &[top, far]), NotFound, "touches[1]"),
        (begin(1, top, &[base]), OutOfRange, "touches[0]"),
        (begin(1, base, &[base]), OutOfRange, "touches[0]"),
        (begin(1, base, &[top, base]), OutOfRange, "touches[1]"),
        (plain(Action::BendMove { bend: 1, targets: places(vec![Vec3::ONE]) }), NotFound, "bend"),
        (plain(Action::BendEnd { bend: 1 }), NotFound, "bend"),
        (plain(Action::BendCancel { bend: 1 }), NotFound, "bend"),
    ] {
        assert_eq!(refusal(&mut document, &action), (code, field.to_owned()), "{action:?}");
    }
    let (code, field) = refusal(&mut document, &begin(1, path[2], &[top, elsewhere]));
    assert!(
        code == OutOfRange && field.starts_with("touches"),
        "base and end on different branches: {field}"
    );
    apply(&mut document, &begin(1, base, &[top, path[2]]));
    assert_eq!(refusal(&mut document, &begin(1, base, &[top])), (Refused, "bend".into()), "begun already");
    let one = plain(Action::BendMove { bend: 1, targets: places(vec![Vec3::ONE]) });
    assert_eq!(refusal(&mut document, &one), (OutOfRange, "targets".into()));
    // BE2: wood that moves is in one pair of hands.
    for (base, top) in [(base, top), (path[3], path[1]), (path[5], path[3])] {
        assert_eq!(refusal(&mut document, &begin(2, base, &[top])), (Refused, "base".into()));
    }
    let turn = plain(Action::TurnBranch { row: path[4].raw(), rotation: UnitRotation::nearest(NO_TURN) });
    assert_eq!(refusal(&mut document, &turn), (Refused, "row".into()));
}

#[test]
fn be4_a_branch_that_is_cut_takes_its_bend_along() {
    let mut document = tree();
    let path = long_path(&document, 6);
    apply(&mut document, &begin(1, path[5], &[path[0]]));
    apply(
        &mut document,
        &plain(Action::BendMove { bend: 1, targets: places(vec![Vec3::new(3.0, 4.0, 0.0)]) }),
    );
    document.apply(&who("bob"), &plain(Action::Prune { rows: list(vec![path[0].raw()]) })).expect("a branch");
    assert!(document.bend_motions().is_empty());
    let over = plain(Action::BendMove { bend: 1, targets: places(vec![Vec3::ONE]) });
    assert_eq!(refusal(&mut document, &over), (ProblemCode::NotFound, "bend".into()));
    assert_eq!(
        refusal(&mut document, &plain(Action::BendEnd { bend: 1 })),
        (ProblemCode::NotFound, "bend".into())
    );
    let begun = begin(1, path[5], &[path[0]]);
    assert_eq!(refusal(&mut document, &begun), (ProblemCode::NotFound, "touches[0]".into()));
    let width = plain(Action::SetWidth { row: path[0].raw(), diameter: Some(Diameter::nearest(1.0)) });
    assert_eq!(refusal(&mut document, &width), (ProblemCode::NotFound, "row".into()));
}

#[test]
fn wi1_widths_of_one_gesture_are_one_operation() {
    let mut document = tree();
    let row = long_path(&document, 4)[2].raw();
    let set = |diameter: Option<f32>, gesture: Option<u32>| {
        in_gesture(gesture, Action::SetWidth { row, diameter: diameter.map(Diameter::nearest) })
    };
    let before = document.plant().hash();
    for diameter in [0.5, 0.6, 0.7] {
        apply(&mut document, &set(Some(diameter), Some(1)));
    }
    assert_eq!(document.plant().step(), 10, "each takes the place of the one before");
    assert_eq!(
        document.widths().iter().map(|width| (width.row, width.diameter)).collect::<Vec<_>>(),
        [(row, 0.7)]
    );
    apply(&mut document, &set(None, Some(2)));
    assert_eq!((document.timeline().operations.len(), document.widths().len()), (3, 0));
    apply(&mut document, &set(None, Some(2)));
    assert_eq!(document.timeline().operations.len(), 3, "removing none does nothing");
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.widths().len(), 1);
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().hash(), before);
    // A gesture that ends where it began has done nothing.
    apply(&mut document, &plain(Action::Redo {}));
    let timeline = document.timeline();
    apply(&mut document, &plain(Action::Redo {}));
    apply(&mut document, &set(Some(0.9), Some(3)));
    apply(&mut document, &set(None, Some(3)));
    assert_eq!(document.timeline().operations.len(), timeline.operations.len());
}

#[test]
fn pr1_a_branch_is_cut_at_its_branching_point() {
    let mut document = tree();
    let lateral = laterals(&document)[0];
    let plant = document.plant();
    let above = plant.above(lateral);
    // The highest row before which nothing branches off.
    let mut row = lateral;
    while let Some(next) =
        (plant.above(row).into_iter().skip(1)).find(|&id| plant.metamers().parent(id) == Some(row)).filter(
            |_| plant.above(row).iter().filter(|&&id| plant.metamers().parent(id) == Some(row)).count() == 1,
        )
    {
        row = next;
    }
    let (living, bearer) = (document.metamers(), plant.metamers().parent(lateral).expect("it is borne"));
    let tips = plant.metamers().tips(bearer);
    let prune = plain(Action::Prune { rows: list(vec![row.raw()]) });
    let mut stub = document.clone();
    apply(&mut document, &prune);
    assert_eq!(document.metamers() as usize, living as usize - above.len());
    assert!(document.plant().is_alive(bearer) && !document.plant().is_alive(lateral));
    assert!(document.plant().metamers().tips(bearer) < tips, "PR2: the wood below gets thinner");
    // With a constraint on the way a stub stays.
    apply(&mut stub, &plain(Action::SetWidth { row: lateral.raw(), diameter: Some(Diameter::nearest(0.4)) }));
    if row == lateral {
        stub.apply(&who("ann"), &prune).expect_err("nothing stands above the constraint");
    } else {
        apply(&mut stub, &prune);
    }
    assert!(stub.plant().is_alive(lateral));
}

#[test]
fn pr1_the_trunk_is_not_cut() {
    let mut document = tree();
    let path = long_path(&document, 4);
    let foot = path[path.len() - 1].raw();
    let lateral = laterals(&document)[0].raw();
    let prune = |rows: &[u32]| plain(Action::Prune { rows: list(rows.to_vec()) });
    assert_eq!(refusal(&mut document, &prune(&[foot])), (ProblemCode::Refused, "rows[0]".into()));
    assert_eq!(refusal(&mut document, &prune(&[lateral, foot])), (ProblemCode::Refused, "rows[1]".into()));
    assert_eq!(refusal(&mut document, &prune(&[lateral, 0])), (ProblemCode::NotFound, "rows[1]".into()));
    assert_eq!(refusal(&mut document, &prune(&[u32::MAX])), (ProblemCode::NotFound, "rows[0]".into()));
    // Above a constraint even the trunk can be cut, and its stub stays.
    apply(&mut document, &plain(Action::SetWidth { row: foot, diameter: Some(Diameter::nearest(0.5)) }));
    apply(&mut document, &prune(&[foot]));
    assert_eq!(document.metamers(), 1);
    assert_eq!(refusal(&mut document, &prune(&[foot])), (ProblemCode::Refused, "rows[0]".into()));
}

#[test]
fn pr3_branches_in_the_dark_are_cut() {
    let mut document = tree();
    let living = document.metamers();
    let dim = |exposure| plain(Action::PruneDim { exposure: Share::nearest(exposure) });
    assert_eq!(refusal(&mut document, &dim(0.0)).0, ProblemCode::Refused);
    let mut light = document.clone();
    apply(&mut light, &dim(1.0));
    assert!(laterals(&light).is_empty(), "none gets more than full light");
    let darkest = laterals(&document);
    assert!(!darkest.is_empty() && light.metamers() < living);
    apply(&mut light, &plain(Action::Undo {}));
    assert_eq!(light.plant().hash(), document.plant().hash());
}

#[test]
fn br1_turns_of_one_gesture_replace_each_other() {
    let mut document = tree();
    let branch =
        *laterals(&document).iter().max_by_key(|&&id| document.plant().above(id).len()).expect("some");
    let turn = |angle: f32, gesture| {
        in_gesture(
            gesture,
            Action::TurnBranch {
                row: branch.raw(),
                rotation: UnitRotation::nearest(Quat::from_xyzw(
                    0.0,
                    libm::sinf(angle),
                    0.0,
                    libm::cosf(angle),
                )),
            },
        )
    };
    let mut once = document.clone();
    apply(&mut once, &turn(0.6, None));
    for angle in [0.1, 0.4, -1.0, 0.6] {
        apply(&mut document, &turn(angle, Some(4)));
    }
    assert_eq!(document.plant().hash(), once.plant().hash());
    assert_eq!(document.timeline().operations.len(), 2);
    let foot = document.plant().metamers().parent(branch).expect("it is borne");
    let trunk = long_path(&document, 3).pop().expect("a path");
    let row = trunk.raw();
    let felled = plain(Action::TurnBranch { row, rotation: UnitRotation::nearest(NO_TURN) });
    assert_eq!(refusal(&mut document, &felled), (ProblemCode::Refused, "row".into()));
    assert_eq!(end(&document, foot), end(&once, foot));
}

#[test]
fn br2_a_graft_is_a_copy_or_moves() {
    let mut document = tree();
    let branches = laterals(&document);
    let plant = document.plant();
    let (branch, size) =
        branches.iter().map(|&id| (id, plant.above(id).len())).max_by_key(|&(_, size)| size).expect("some");
    let inside = plant.above(branch)[size - 1];
    let onto = long_path(&document, 3).pop().expect("a path");
    let living = document.metamers() as usize;
    let graft = |onto: MetamerId, keep| {
        plain(Action::Graft {
            row: branch.raw(),
            onto: onto.raw(),
            rotation: UnitRotation::nearest(NO_TURN),
            keep,
        })
    };
    for (onto, keep) in [(branch, true), (inside, false)] {
        assert_eq!(refusal(&mut document, &graft(onto, keep)), (ProblemCode::Refused, "onto".into()));
    }
    let far = graft(MetamerId::new(999_999), true);
    assert_eq!(refusal(&mut document, &far), (ProblemCode::NotFound, "onto".into()));
    let trunk = plain(Action::Graft {
        row: onto.raw(),
        onto: inside.raw(),
        rotation: UnitRotation::nearest(NO_TURN),
        keep: false,
    });
    assert_eq!(refusal(&mut document, &trunk), (ProblemCode::Refused, "onto".into()));
    let mut moved = document.clone();
    apply(&mut moved, &graft(onto, false));
    assert_eq!(moved.metamers() as usize, living);
    assert!(!moved.plant().is_alive(branch));
    apply(&mut document, &graft(onto, true));
    assert_eq!(document.metamers() as usize, living + size);
    document.set_metamer_budget(document.plant().metamer_count() as u32 + 1);
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &plain(Action::Redo {}));
    assert_eq!(refusal(&mut document, &graft(onto, true)).0, ProblemCode::Refused, "LM4: copies count");
}

#[test]
fn lm12_width_constraints_are_limited() {
    let mut document = tree();
    let rows: Vec<u32> = (1..document.plant().metamer_count() as u32)
        .filter(|&row| document.plant().is_alive(MetamerId::new(row as usize)))
        .collect();
    let width = |row: u32| plain(Action::SetWidth { row, diameter: Some(Diameter::nearest(0.3)) });
    while document.plant().living_count() < 300 {
        grow(&mut document, 1, None);
    }
    let more = (1..document.plant().metamer_count() as u32)
        .filter(|row| !rows.contains(row) && document.plant().is_alive(MetamerId::new(*row as usize)));
    let all: Vec<u32> = rows.iter().copied().chain(more).collect();
    for &row in &all[..256] {
        apply(&mut document, &width(row));
    }
    let hash = document.hash();
    assert_eq!(refusal(&mut document, &width(all[256])).0, ProblemCode::Refused);
    assert_eq!(document.hash(), hash);
    apply(&mut document, &plain(Action::SetWidth { row: all[0], diameter: Some(Diameter::nearest(0.4)) }));
}
