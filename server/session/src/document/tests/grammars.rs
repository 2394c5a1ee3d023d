//! Grammars in documents: depth is time, rows go on from depth to depth, and hands may do anything between.

use espalier_grammar::{Derivation, Limits, OpenSky, SHIPPED, WoodOptions};
use espalier_plant::checks;
use espalier_proto::{GrammarValue, Reason};

use super::*;

mod limits;
mod organs;

fn set(text: &str, depth: u32) -> Command {
    plain(Action::SetGrammar {
        text: text.to_owned(),
        values: list(vec![]),
        seed: None,
        position: None,
        depth: (depth > 0).then(|| Steps::nearest(depth)),
        within: None,
    })
}

fn derive(steps: u32) -> Command {
    plain(Action::Derive { steps: Steps::nearest(steps) })
}

fn values(gesture: u32, name: &str, value: f64) -> Command {
    let values = list(vec![GrammarValue { name: name.to_owned(), value }]);
    in_gesture(gesture, Action::SetGrammarValues { values })
}

fn shipped(name: &str) -> &'static str {
    SHIPPED.iter().find(|one| one.name == name).expect("it is shipped").text
}

fn depth(document: &Document) -> u32 {
    document.grammar_depth().expect("a grammar is in force").0
}

fn living(document: &Document) -> Vec<u32> {
    let plant = document.plant();
    let rows = (0..plant.metamer_count()).map(MetamerId::new);
    rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id)).map(MetamerId::raw).collect()
}

#[test]
fn each_depth_is_a_step_that_time_goes_back_to() {
    for name in ["barron-binary", "ternary-wind", "sympodial", "bush-bracketed", "topiary-box"] {
        let text = shipped(name);
        let mut document = Document::new(7);
        apply(&mut document, &set(text, 1));
        let mut hashes = vec![(document.plant().step(), document.plant().hash())];
        for _ in 1..4 {
            apply(&mut document, &derive(1));
            assert_eq!(checks::all(document.plant()), Ok(()), "{name}");
            hashes.push((document.plant().step(), document.plant().hash()));
        }
        assert!(document.metamers() > 3, "{name}");
        for &(step, hash) in hashes.iter().rev() {
            apply(&mut document, &plain(Action::GoTo { step }));
            assert_eq!(document.plant().hash(), hash, "{name} at step {step}");
        }
        // At once it is the same plant as step by step.
        let mut whole = Document::new(7);
        apply(&mut whole, &set(text, 4));
        assert_eq!(hashes.last().map(|last| last.1), Some(whole.plant().hash()), "{name}");
        apply(&mut whole, &plain(Action::Undo {}));
        assert_eq!((whole.metamers(), whole.grammar_depth()), (0, None), "{name}");
        apply(&mut whole, &plain(Action::Redo {}));
        assert_eq!((hashes.last().map(|last| last.1), depth(&whole)), (Some(whole.plant().hash()), 4));
    }
}

/// Whoever goes back to a depth, and whoever derives no further, have the same plant, to the bit; all of them can be
/// taken back.
#[test]
fn every_shipped_grammar_is_at_each_depth_what_it_is_from_scratch() {
    for shipped in SHIPPED {
        let name = shipped.name;
        let grammar = espalier_grammar::Grammar::read(shipped.text).expect("it is right");
        let depth = grammar.program(&[]).expect("its sliders are in range").depth();
        let mut document = Document::new(5);
        let seedling = document.plant().hash();
        apply(&mut document, &set(shipped.text, depth));
        let reached = |document: &Document| document.grammar_depth().map(|(depth, _)| depth);
        assert_eq!(reached(&document), Some(depth), "{name}");
        let end = document.plant().step();
        // The first depths one by one, and some of the later ones.
        let looked_at = (1..depth).filter(|depth| *depth < 5 || depth.is_multiple_of(9));
        for depth in looked_at.chain([depth]).rev() {
            let mut scratch = Document::new(5);
            apply(&mut scratch, &set(shipped.text, depth));
            let step = scratch.plant().step();
            apply(&mut document, &plain(Action::GoTo { step }));
            assert_eq!(checks::all(document.plant()), Ok(()), "{name} at depth {depth}");
            assert_eq!(document.plant().hash(), scratch.plant().hash(), "{name} at depth {depth}");
            // Depths that draw nothing share their step with the one before, and the first ones with the time before
            // the grammar; the last of them is told.
            let Some(told) = reached(&document) else {
                assert_eq!((step, scratch.metamers()), (0, 0), "{name} at depth {depth}");
                continue;
            };
            assert!(told >= depth, "{name}: {told} at depth {depth}");
            for _ in depth..told {
                apply(&mut scratch, &derive(1));
            }
            let state = |document: &Document| (document.plant().step(), reached(document));
            assert_eq!(state(&scratch), state(&document), "{name} at depth {depth}");
        }
        apply(&mut document, &plain(Action::GoTo { step: end }));
        apply(&mut document, &plain(Action::Undo {}));
        assert_eq!((document.metamers(), document.plant().hash()), (0, seedling), "{name}");
    }
}

/// What rules put in the middle of an axis parts what stood there from what bore it.
#[test]
fn step_by_step_a_plant_is_as_large_as_its_word_says() {
    for shipped in SHIPPED {
        let grammar = espalier_grammar::Grammar::read(shipped.text).expect("it is right");
        let program = Arc::new(grammar.program(&[]).expect("its sliders are in range"));
        let depth = program.depth().min(40);
        if grammar.asks_places() {
            continue;
        }
        let mut document = Document::new(1);
        apply(&mut document, &set(shipped.text, depth));
        let options = WoodOptions { nodes: 100_000, extent: 5000, twig_radius: 0.05 };
        let mut derivation = Derivation::new(program, 1, Limits::default()).expect("it is small");
        derivation.derive(depth, &OpenSky).expect("it is small");
        let drawn = derivation.draw(&OpenSky, options).expect("it fits").wood;
        let lines = drawn.nodes.iter().filter(|node| node.parent.is_some()).count();
        // Lines that began short stay parts of others; lines that grow stay as many as they were.
        let found = document.metamers() as usize;
        assert!(found * 10 >= lines * 7, "{}: {found} of {lines}", shipped.name);
        assert_eq!(checks::all(document.plant()), Ok(()), "{}", shipped.name);
    }
}

#[test]
fn texts_may_say_their_seed() {
    let text = |seed: &str| format!("axiom: A\n{seed}\nA --> F(1+ran(1))[+(40)F]A");
    let planted = |document: &mut Document, text: &str, seed: Option<u32>| {
        let Action::SetGrammar { values, depth, .. } = set(text, 5).action else {
            panic!("it sets a grammar")
        };
        let action =
            Action::SetGrammar { text: text.to_owned(), values, seed, position: None, depth, within: None };
        apply(document, &plain(action));
        (document.plant().hash(), document.grammar_told().expect("one is in force").seed)
    };
    let mut document = Document::new(7);
    let (first, seed) = planted(&mut document, &text("seed: 41"), None);
    assert_eq!(seed, 41);
    // Who says one means it, and it stays while the text keeps its own.
    assert_eq!(planted(&mut document, &text("seed: 41"), Some(3)).1, 3);
    assert_eq!(planted(&mut document, &text("seed: 41\nangle: 20"), None).1, 3);
    // Who changes that of the text means the text.
    assert_eq!(planted(&mut document, &text("seed: 42"), None).1, 42);
    let mut other = Document::new(8);
    assert_eq!(
        planted(&mut other, &text("seed: 41"), None),
        (first, 41),
        "whatever the seed of the document"
    );
    assert_eq!(planted(&mut Document::new(8), &text(""), None).1, 8);
}

#[test]
fn wood_that_lengthens_moves_and_is_not_born_again() {
    let mut document = Document::new(1);
    // As deep as a plant that it pays for; 118,098 lines at the end.
    apply(&mut document, &set(shipped("ternary-wind"), 1));
    for depth in 2..=10 {
        let before = living(&document);
        let places: Vec<Vec3> =
            before.iter().map(|&row| document.plant().metamers().end(MetamerId::new(row as usize))).collect();
        apply(&mut document, &derive(1));
        let after = living(&document);
        assert!(after.starts_with(&before), "a row is gone at depth {depth}");
        assert_eq!(document.metamers() as usize + 1, document.plant().metamer_count(), "nothing has died");
        // All that stood has been carried, for all of it lengthens.
        let carried = before.iter().zip(&places).filter(|&(&row, place)| {
            document.plant().metamers().end(MetamerId::new(row as usize)).distance(*place) > 1e-4
        });
        assert_eq!(carried.count(), before.len(), "depth {depth}");
    }
    assert!(document.metamers() > 100_000, "{}", document.metamers());
    assert_eq!(checks::all(document.plant()), Ok(()));
}

#[test]
fn hands_and_grammars_take_turns() {
    let mut document = Document::new(3);
    let text = shipped("monopodial");
    apply(&mut document, &set(text, 5));
    let cut = laterals(&document)[1];
    apply(&mut document, &plain(Action::Prune { rows: list(vec![cut.raw()]) }));
    let turned = laterals(&document)[0].raw();
    let rotation = UnitRotation::nearest(Quat::from_rotation_y(0.7));
    apply(&mut document, &plain(Action::TurnBranch { row: turned, rotation }));
    let heading = document.plant().heading(MetamerId::new(turned as usize));
    let before = document.metamers();
    apply(&mut document, &derive(2));
    assert_eq!(checks::all(document.plant()), Ok(()));
    assert!(document.metamers() > before, "it goes on where its buds stand");
    assert!(!document.plant().is_alive(cut), "what was cut stays away");
    let now = document.plant().heading(MetamerId::new(turned as usize));
    assert!(now.dot(heading) > 0.999, "what was turned stays turned: {heading} {now}");
    stroke(&mut document, 1);
    let drawn = document.metamers();
    apply(&mut document, &derive(1));
    assert!(document.metamers() >= drawn);
    assert_eq!(checks::all(document.plant()), Ok(()));
    // All of it is read again, and goes on alike.
    let mut read = Document::from_bytes(&document.to_bytes()).expect("it was written");
    assert_eq!((read.hash(), read.to_bytes()), (document.hash(), document.to_bytes()));
    apply(&mut document, &derive(1));
    apply(&mut read, &derive(1));
    assert_eq!((read.hash(), read.plant().hash()), (document.hash(), document.plant().hash()));
    while document.figures().can_undo {
        apply(&mut document, &plain(Action::Undo {}));
    }
    assert_eq!(document.metamers(), 0);
    assert!(document.grammar_depth().is_none());
}

/// Grammar, bend, brush, two more depths: the same plants on the way back, forth again, and when it is all done anew.
#[test]
fn a_mixture_of_hands_and_grammar_goes_back_forth_and_anew() {
    let commands = |document: &Document, part: usize| -> Vec<Command> {
        let plant = document.plant();
        let bends = || {
            let path = long_path(document, 4);
            let (base, touched) = (path[3].raw(), path[0]);
            let target = plant.metamers().end(touched) + Vec3::new(0.8, -0.2, 0.5);
            vec![
                plain(Action::BendBegin {
                    bend: 1,
                    base,
                    touches: held(vec![touched.raw()]),
                    stretch: Share::nearest(0.5),
                }),
                plain(Action::BendMove { bend: 1, targets: places(vec![target]) }),
                plain(Action::BendEnd { bend: 1 }),
            ]
        };
        let samples = |from: f32| list(vec![sample(0.5, from, 1.0), sample(2.0, from + 3.0, 2.0)]);
        match part {
            0 => vec![set(shipped("sympodial"), 4)],
            1 => bends(),
            2 => vec![
                plain(Action::StrokeBegin { stroke: 1, bud: None }),
                plain(Action::StrokeMove { stroke: 1, samples: samples(4.0) }),
                plain(Action::StrokeEnd { stroke: 1 }),
            ],
            _ => vec![derive(2)],
        }
    };
    let mut document = Document::new(9);
    let mut journal = Vec::new();
    let mut stops = vec![(document.plant().hash(), document.metamers())];
    for part in 0..4 {
        for command in commands(&document, part) {
            apply(&mut document, &command);
            journal.push(command);
        }
        let stop = (document.plant().hash(), document.metamers());
        assert_ne!(stops.last().map(|last| last.0), Some(stop.0), "part {part} changes the plant");
        assert_eq!(checks::all(document.plant()), Ok(()), "part {part}");
        stops.push(stop);
    }
    assert!(stops[4].1 > stops[3].1, "the grammar goes on beside what hands have done");
    let mut back = vec![stops[4]];
    while document.figures().can_undo {
        apply(&mut document, &plain(Action::Undo {}));
        assert_eq!(checks::all(document.plant()), Ok(()));
        back.push((document.plant().hash(), document.metamers()));
    }
    back.reverse();
    assert_eq!(back, stops, "undo stops where the hands did");
    for stop in &stops[1..] {
        apply(&mut document, &plain(Action::Redo {}));
        assert_eq!((document.plant().hash(), document.metamers()), *stop);
    }
    let mut anew = Document::new(9);
    journal.iter().for_each(|command| apply(&mut anew, command));
    assert_eq!(
        (anew.plant().hash(), anew.grammar_depth()),
        (document.plant().hash(), document.grammar_depth())
    );
}

#[test]
fn surroundings_answer_and_their_answers_are_kept() {
    for name in ["light-seeker", "topiary-box"] {
        let mut document = Document::new(2);
        apply(&mut document, &set(shipped(name), 5));
        let mut read = Document::from_bytes(&document.to_bytes()).expect("it was written");
        apply(&mut document, &derive(2));
        apply(&mut read, &derive(2));
        assert_eq!(read.plant().hash(), document.plant().hash(), "{name}");
    }
}

#[test]
fn a_body_is_filled_and_walls_are_known() {
    let text = "axiom: F(1)A?P\nA > ?P(x,y,z) : inside(0) && !inside(1) --> F[&(60)F]/(137.5)A?P\n";
    let Action::Lasso { outline, plane, depth, .. } = lasso(3.0, 5.0).action else { panic!("it is one") };
    let body = espalier_proto::GrammarBody { outline, plane, depth };
    let command = plain(Action::SetGrammar {
        text: text.to_owned(),
        values: list(vec![]),
        seed: None,
        position: None,
        depth: Some(Steps::nearest(12)),
        within: Some(body),
    });
    let mut document = Document::new(1);
    apply(&mut document, &command);
    let plant = document.plant();
    let heights =
        living(&document).into_iter().map(|row| plant.metamers().end(MetamerId::new(row as usize)).y);
    let highest = heights.fold(0.0, f32::max);
    assert!((3.0..7.0).contains(&highest), "it ends where the body does: {highest}");
}

#[test]
fn gr9_what_a_space_cuts_comes_again_and_what_hands_cut_does_not() {
    let text = "axiom: f(1)Q(-1)\nQ(v) : v < 0 --> Q(inside(0))\nf(l) > Q(v) : v == 1 --> F(l)\n\
                f(l) > Q(v) : v == 0 --> *\nQ(v) : v == 0 --> %\n\
                Q(v) : v == 1 --> [&(60)f(1)Q(-1)]/(137.5)[&(35)f(1)Q(-1)]f(1)Q(-1)\n";
    let space = |half: f64, height: f64| {
        let within = serde_json::from_value(serde_json::json!({
            "outline": [[-half, -1.0], [half, -1.0], [half, height], [-half, height]],
            "plane": { "origin": [0, 0, 0], "right": [1, 0, 0], "up": [0, 1, 0] },
        }));
        plain(Action::SetGrammarBody { within: Some(within.expect("it is a body")) })
    };
    let free = plain(Action::SetGrammarBody { within: None });
    let mut document = Document::new(7);
    apply(&mut document, &set(text, 12));
    let whole = living(&document).len();
    let mut narrow = None;
    // As often as one likes, in a document that was saved in between.
    for _ in 0..3 {
        apply(&mut document, &space(2.5, 4.5));
        let within = living(&document).len();
        assert!(within > 20 && within < whole, "{within} of {whole}");
        assert_eq!(*narrow.get_or_insert(within), within);
        document = Document::from_bytes(&document.to_bytes()).expect("it was written");
        apply(&mut document, &free);
        assert_eq!(living(&document).len(), whole);
        assert_eq!(checks::all(document.plant()), Ok(()));
    }
    // A hand cuts the trunk within the space, right above where a branch goes on.
    let plant = document.plant();
    let trunk = plant.metamers().axis(MetamerId::new(0));
    let on_trunk = |&row: &u32| plant.metamers().axis(MetamerId::new(row as usize)) == trunk;
    let third = living(&document).into_iter().filter(on_trunk).nth(2).expect("it has a trunk");
    apply(&mut document, &plain(Action::Prune { rows: list(vec![third]) }));
    let cut = living(&document).len();
    assert!(cut > 20 && cut < whole, "{cut} of {whole}");
    for _ in 0..2 {
        apply(&mut document, &space(2.5, 4.5));
        document = Document::from_bytes(&document.to_bytes()).expect("it was written");
        apply(&mut document, &free);
        assert_eq!(living(&document).len(), cut, "what was cut stays away, and all else comes again");
    }
}

#[test]
fn a_text_that_went_back_in_depth_comes_to_the_whole_plant_again() {
    for (name, deep) in [("monopodial", 10), ("honda-maple", 9), ("barron-binary", 8)] {
        let text = shipped(name);
        let mut document = Document::new(7);
        apply(&mut document, &set(text, deep));
        let whole = document.metamers();
        apply(&mut document, &set(text, deep / 2));
        let half = document.metamers();
        assert!(half < whole, "{name}: {half} of {whole}");
        apply(&mut document, &derive(deep - deep / 2));
        assert_eq!(document.metamers(), whole, "{name}, derived");
        apply(&mut document, &set(text, deep / 2));
        assert_eq!(document.metamers(), half, "{name}, half again");
        apply(&mut document, &set(text, deep));
        assert_eq!(document.metamers(), whole, "{name}, written");
        assert_eq!(checks::all(document.plant()), Ok(()), "{name}");
    }
}

#[test]
fn sliders_move_the_plant_in_one_step() {
    let mut document = Document::new(1);
    apply(&mut document, &set(shipped("barron-binary"), 5));
    let (before, step) = (living(&document), document.plant().step());
    let hash = document.plant().hash();
    for angle in [20.0, 35.0, 50.0] {
        apply(&mut document, &values(4, "a", angle));
        assert_eq!(document.plant().step(), step + 1, "one step for the whole gesture");
        assert_eq!(living(&document), before, "rows stay");
        assert_eq!(checks::all(document.plant()), Ok(()));
    }
    assert_ne!(document.plant().hash(), hash);
    assert_eq!(problem(&mut document, &values(5, "a", 1000.0)).field.as_deref(), Some("values"));
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().hash(), hash);
}

#[test]
fn a_value_that_cannot_be_leaves_that_of_before() {
    let text = "slider: n 1 10\nn = 2\naxiom: A\nA --> F(1/(5-n))[+(40)F]A\n";
    let mut document = Document::new(1);
    apply(&mut document, &set(text, 3));
    let untouched = document.plant().hash();
    apply(&mut document, &values(4, "n", 3.0));
    let (hash, step) = (document.plant().hash(), document.plant().step());
    let refused = problem(&mut document, &values(4, "n", 5.0));
    assert_eq!(refused.reason, Reason::GrammarEnds);
    assert_eq!((document.plant().hash(), document.plant().step()), (hash, step), "what was set before stays");
    let told = document.grammar_told().expect("it is in force");
    assert_eq!(told.values, [GrammarValue { name: "n".into(), value: 3.0 }]);
    // The gesture goes on, in the very same step.
    apply(&mut document, &values(4, "n", 4.0));
    assert_eq!(document.plant().step(), step);
    assert_ne!(document.plant().hash(), hash);
    // Back where it began, the value is what it was, and so is the plant.
    apply(&mut document, &values(4, "n", 2.0));
    assert_eq!(checks::all(document.plant()), Ok(()));
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(document.plant().hash(), untouched);
    assert!(document.grammar_told().is_some_and(|told| told.values.is_empty()));
}

#[test]
fn another_text_takes_the_place_of_the_one_in_force() {
    let mut document = Document::new(1);
    apply(&mut document, &set("axiom: A\nA --> F[+(30)F]A\n", 4));
    let (hash, step) = (document.plant().hash(), document.plant().step());
    let trunk = living(&document);
    apply(&mut document, &set("axiom: A\nA --> F[+(60)F][-(60)F]A\n", 0));
    assert_eq!(
        (depth(&document), document.plant().step()),
        (4, step + 1),
        "it has the depth of the one before"
    );
    assert_eq!(checks::all(document.plant()), Ok(()));
    assert!(living(&document).iter().filter(|row| trunk.contains(row)).count() >= 4, "what is alike stays");
    assert_eq!(document.metamers(), 12);
    apply(&mut document, &derive(1));
    assert_eq!(document.metamers(), 15);
    apply(&mut document, &plain(Action::Undo {}));
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!((document.plant().hash(), document.plant().step()), (hash, step));
    // Elsewhere it is another plant, and the first one stays.
    let Action::SetGrammar { text, values, seed, depth, within, .. } = set("axiom: F(2)\n", 0).action else {
        panic!("it is one")
    };
    let position = Some(Position::nearest(Vec3::new(4.0, 0.0, 0.0)));
    apply(&mut document, &plain(Action::SetGrammar { text, values, seed, position, depth, within }));
    assert_eq!(document.metamers(), 8 + 2);
}

#[test]
fn what_one_person_planted_is_taken_back_where_another_has_grown_on() {
    let mut document = Document::new(1);
    apply(&mut document, &set("axiom: A\nA --> F[+(30)F]A\n", 3));
    let seed = Action::PlantSeed { position: Position::nearest(Vec3::new(5.0, 0.0, 0.0)) };
    document.apply(&who("bob"), &plain(seed)).expect("there is room");
    apply(&mut document, &derive(2));
    let before = document.metamers();
    apply(&mut document, &plain(take_back_by(&[])));
    assert_eq!((document.metamers(), depth(&document)), (before - 4, 3), "two depths fall");
    apply(&mut document, &plain(bring_back_by(&[])));
    assert_eq!((document.metamers(), depth(&document)), (before, 5));
    apply(&mut document, &plain(take_back_by(&[])));
    apply(&mut document, &derive(1));
    assert_eq!((document.metamers(), depth(&document)), (before - 2, 4), "it goes on from there");
    assert_eq!(checks::all(document.plant()), Ok(()));
    for _ in 0..2 {
        apply(&mut document, &plain(take_back_by(&[])));
    }
    assert!(document.grammar_depth().is_none(), "what was planted is taken back");
    assert_eq!(document.metamers(), 0);
    let read = Document::from_bytes(&document.to_bytes()).expect("it was written");
    assert_eq!(read.hash(), document.hash());
}

#[test]
fn gr8_rules_know_their_rows() {
    let text = "axiom: F(1)A\nA --> I[+(40)B]A\nB --> F(1)F(1)\nhomomorphism:\nI --> F(1)\n";
    let mut document = Document::new(1);
    assert_eq!(document.grammar_origins(), None);
    apply(&mut document, &set(text, 4));
    let cut = laterals(&document)[0];
    apply(&mut document, &plain(Action::Prune { rows: list(vec![cut.raw()]) }));
    let origins = document.grammar_origins().expect("it is in force");
    let lines: Vec<u32> = origins.rules.iter().map(|rule| rule.line).collect();
    assert_eq!(lines, [1, 2, 3], "the axiom, then rules that made something");
    assert_eq!(origins.rows, living(&document));
    let count = |rule: u16| origins.by.iter().filter(|&&by| by == rule).count();
    // One internode of the axiom; four of the trunk, by way of the homomorphism; two of each branch but the one cut.
    assert_eq!((count(0), count(1), count(2)), (1, 4, 4));
    let read = Document::from_bytes(&document.to_bytes()).expect("it was written");
    assert_eq!(read.grammar_origins(), Some(origins));
}

#[test]
fn gr5_depths_that_time_leads_through_are_told() {
    let mut document = Document::new(3);
    apply(&mut document, &set(shipped("barron-binary"), 4));
    let around = |document: &Document| {
        let told = document.grammar_told().expect("a grammar is in force");
        (told.depth, told.earlier, told.later)
    };
    assert_eq!(around(&document), (4, 4, 0));
    let step = document.plant().step();
    apply(&mut document, &plain(Action::GoTo { step: step - 3 }));
    assert_eq!(around(&document), (1, 1, 3));
    apply(&mut document, &plain(Action::GoTo { step }));
    apply(&mut document, &derive(1));
    assert_eq!(around(&document), (5, 5, 0));
    apply(&mut document, &values(4, "a", 40.0));
    assert_eq!(around(&document), (5, 0, 0), "the step before has another angle");
    apply(&mut document, &derive(2));
    assert_eq!(around(&document), (7, 2, 0));
    let opened = Document::from_bytes(&document.to_bytes()).expect("it opens");
    assert_eq!(around(&opened), (7, 2, 0));
}

/// Each tip becomes a stem with four tips, and every line below it doubles: branches turn aside and back, so that some
/// go straight on from what bears them.
const DENSE: &str = "angle: 22.5\nscale: 0.55\naxiom: X\nX --> F-[[X]+X]+F[+FX]-X\nF --> FF";

#[test]
fn branches_that_go_straight_on_have_normals_across_them() {
    let mut document = Document::new(7);
    apply(&mut document, &set(DENSE, 1));
    for depth in 2..6 {
        apply(&mut document, &derive(1));
        assert_eq!(checks::all(document.plant()), Ok(()), "at depth {depth}");
    }
}
