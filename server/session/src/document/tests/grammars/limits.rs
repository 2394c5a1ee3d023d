//! What grammars may take, and how long steps are written in slices between which others have their turn.

use super::*;

#[test]
fn limits_refuse_before_they_cost() {
    let mut document = Document::new(1);
    let error = problem(&mut document, &set("axiom: A\nA --> F[+A\n", 1));
    assert_eq!((error.reason, error.field.as_deref()), (Reason::NotAGrammar, Some("text")));
    assert!(error.cause.is_some_and(|cause| cause.starts_with("line 2")), "it says where");
    assert_eq!(problem(&mut document, &derive(1)).reason, Reason::NoGrammar);
    assert_eq!(problem(&mut document, &values(1, "a", 1.0)).reason, Reason::NoGrammar);
    // Eight times as much with each step: what was derived before stays.
    apply(&mut document, &set("axiom: F\nscale: 0.3\nF --> F[+F][-F][&F]F[^F]FF\n", 9));
    let (reached, why) = document.grammar_depth().expect("it is in force");
    assert!((5..9).contains(&reached) && why.is_some(), "{reached} {why:?}");
    let stopped = problem(&mut document, &derive(1));
    assert_eq!(stopped.reason, Reason::GrammarEnds);
    apply(&mut document, &set("axiom: A(1)\nA(x) --> F(1/(3-x))A(x+1)\n", 1));
    apply(&mut document, &derive(3));
    let (reached, why) = document.grammar_depth().expect("it is in force");
    assert_eq!(reached, 2, "it goes as far as it can");
    assert!(why.is_some_and(|why| why.contains("line 2, column 1")), "a division by zero has its place");
    assert_eq!(problem(&mut document, &derive(3)).reason, Reason::GrammarEnds);
}

#[test]
fn bombs_are_refused_and_leave_the_document_as_it_was() {
    let texts = [
        // More modules than a step may have, in one step.
        "axiom: A\nA --> BBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBBB\nB --> AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\n",
        // Rules that go on within a step.
        "axiom: A\nA --> B\ndecomposition:\nB --> BB\n",
        // Brackets within brackets.
        "axiom: A\nA --> [A]\n",
        // Wood that leaves the world.
        "axiom: F(1)A\nA --> F(100)A\n",
        // More internodes than the document may hold.
        "axiom: A\nA --> F(1)[+A][-A][&A][^A]A\n",
        // Numbers that grow beyond all.
        "axiom: A(2)\nA(x) --> A(x^x)\n",
    ];
    for text in texts {
        let mut document = Document::new(1);
        document.set_metamer_budget(50_000);
        // What was derived before stays, where anything could be.
        if document.apply(&who("ann"), &set(text, 1000)).is_ok() {
            let (reached, why) = document.grammar_depth().expect("it is in force");
            assert!(reached < 1000 && why.is_some(), "{text}: {reached} {why:?}");
        }
        assert!(document.plant().metamer_count() <= 50_000, "{text}");
        assert_eq!(checks::all(document.plant()), Ok(()), "{text}");
        let mut again = Document::from_bytes(&document.to_bytes()).expect("it was written");
        if document.grammar_depth().is_some() {
            let reasons = [&mut document, &mut again].map(|one| problem(one, &derive(1)).reason);
            assert!(
                reasons.iter().all(|reason| matches!(reason, Reason::GrammarEnds | Reason::TreeFull)),
                "{text}"
            );
        }
    }
}

/// A million modules at depth 20, none of which draws, beside a trunk that says how deep it is.
const LARGE: &str = "slider: a 1 9\na = 1\naxiom: F(a)B\nB --> BB\n";

/// A document with a small grammar in force, that takes no more than a slice.
fn small() -> Document {
    let mut document = Document::new(3);
    apply(&mut document, &set("axiom: F(2)A\nA --> F\n", 1));
    document
}

/// How high the wood stands.
fn height(document: &Document) -> f32 {
    let ends =
        living(document).into_iter().map(|row| document.plant().metamers().end(MetamerId::new(row as usize)));
    ends.map(|end| end.y).fold(0.0, f32::max)
}

/// Does a command slice by slice; how many there were. Nothing shows before the last of them.
fn in_slices(document: &mut Document, command: &Command) -> u32 {
    let before = (document.plant().hash(), document.plant().step(), document.grammar_depth());
    document.begin(&who("ann"), command).expect("it can be begun");
    let mut slices = 1;
    while document.is_undecided() {
        assert!(document.is_between() || before.0 == document.plant().hash(), "nothing half done stands");
        if !document.is_between() {
            assert_eq!((before.1, &before.2), (document.plant().step(), &document.grammar_depth()));
        }
        assert_eq!(document.pending_steps(), 1);
        assert!(document.advance(), "it goes on");
        slices += 1;
    }
    slices
}

#[test]
fn long_steps_are_written_in_slices() {
    let mut document = small();
    let begun = document.steps_begun();
    let slices = in_slices(&mut document, &set(LARGE, 20));
    assert_eq!(document.take_outcome(), Ok(()));
    assert!((3..20).contains(&slices), "{slices}");
    assert_eq!(document.steps_begun() - begun, slices, "each counts as a step begun");
    assert_eq!((depth(&document), height(&document)), (20, 1.0));
    // A drag: what stood last is set aside until the next stands.
    for value in [2.0, 3.0] {
        assert!(in_slices(&mut document, &values(5, "a", value)) > 2);
        assert_eq!(document.take_outcome(), Ok(()));
    }
    assert_eq!((height(&document), document.plant().step()), (3.0, 4));
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!((height(&document), depth(&document)), (1.0, 20));
}

/// The same, which asks how light it is at its foot, so that it is written anew in surroundings of its own.
const ASKS: &str = "slider: a 1 9\na = 1\naxiom: F(a)CB\nB --> BB\nC : light() > 2 --> *\n";

#[test]
fn what_asks_for_light_is_written_anew_in_slices() {
    let mut document = Document::new(3);
    apply(&mut document, &set(ASKS, 20));
    let planted = document.clone();
    let stands = |document: &Document| (document.plant().hash(), document.plant().step(), depth(document));
    let before = stands(&document);
    // Stopped after any slice it leaves nothing.
    for taken in 1..4 {
        let mut stopped = document.clone();
        stopped.begin(&who("ann"), &values(5, "a", 2.0)).expect("it can be begun");
        for _ in 1..taken {
            assert!(stopped.is_undecided() && stopped.advance(), "it takes more than {taken} slices");
            assert_eq!(stands(&stopped), before);
        }
        stopped.stop_at(Some(stopped.steps_begun()));
        while stopped.advance() {}
        assert_eq!((stopped.take_outcome(), stands(&stopped)), (Ok(()), before));
    }
    let slices = in_slices(&mut document, &values(5, "a", 2.0));
    assert!(slices > 3, "{slices}");
    assert_eq!((height(&document), depth(&document)), (2.0, 20));
    assert_eq!(checks::all(document.plant()), Ok(()));
    apply(&mut document, &plain(Action::Undo {}));
    assert_eq!(stands(&document), stands(&planted));
}

#[test]
fn st1_a_long_step_ends_between_slices_and_leaves_nothing() {
    for drags in [false, true] {
        let mut document = small();
        if drags {
            apply(&mut document, &set(LARGE, 19));
            apply(&mut document, &values(5, "a", 2.0));
        }
        let command = if drags { values(5, "a", 3.0) } else { set(LARGE, 19) };
        let stands = |document: &Document| {
            let told = document.grammar_told().expect("it is in force");
            (document.plant().hash(), document.plant().step(), told.text, told.values, told.depth)
        };
        let before = stands(&document);
        let mut stopped = document.clone();
        stopped.begin(&who("ann"), &command).expect("it can be begun");
        assert!(stopped.is_undecided() && stopped.is_between() == drags);
        stopped.stop_at(Some(stopped.steps_begun()));
        assert!(stopped.advance() && !stopped.advance(), "it ends at once");
        assert_eq!(stopped.take_outcome(), Ok(()));
        assert_eq!(stands(&stopped), before);
        assert_eq!(checks::all(stopped.plant()), Ok(()));
        // What comes later is as if it had not been begun.
        stopped.stop_at(None);
        let mut again = stopped.clone();
        for one in [&mut document, &mut again] {
            apply(one, &command);
        }
        assert_eq!(stands(&again), stands(&document));
        // A document that was read has no word at hand: what is derived again counts as nothing.
        let mut read = Document::from_bytes(&stopped.to_bytes()).expect("it was written");
        for one in [&mut stopped, &mut read] {
            apply(one, &derive(1));
        }
        assert_eq!(read.hash(), stopped.hash());
    }
}

#[test]
fn long_steps_of_a_command_end_between_slices() {
    let mut document = Document::new(3);
    document.begin(&who("ann"), &set(LARGE, 40)).expect("the axiom is small");
    // The first twenty depths double what there is.
    while depth(&document) < 19 {
        assert!(document.advance());
    }
    let before = document.plant().hash();
    assert!(document.advance(), "depth 20 takes longer than a slice");
    assert_eq!(depth(&document), 19);
    document.stop_at(Some(document.steps_begun()));
    while document.advance() {}
    assert_eq!((depth(&document), document.plant().hash()), (19, before));
    document.stop_at(None);
    apply(&mut document, &derive(1));
    assert_eq!(depth(&document), 20);
}

#[test]
fn what_cannot_stand_is_refused_in_a_later_slice() {
    let mut document = small();
    let before = document.plant().hash();
    // Two million modules are too many; a million can be derived, and are read as too many.
    let read = "axiom: F(3)B(0)\nB(n) --> B(n+1)B(n+1)\nhomomorphism:\nB(n) : n > 19 --> ++++++++++++\n";
    for (text, depth_wanted) in [("axiom: F(3)B\nB --> BB\n", 25), (read, 20)] {
        in_slices(&mut document, &set(text, depth_wanted));
        let refused = document.take_outcome().expect_err("it is too much");
        assert_eq!(refused.reason, Reason::GrammarEnds, "{text}");
        assert_eq!((document.plant().hash(), depth(&document)), (before, 1), "{text}");
    }
    // The bombs that no slice is long enough for.
    for text in [
        "axiom: F(3)A\nhomomorphism: maximum depth: 100\nA --> AA\n",
        "axiom: F(3)A\nA --> B(90)\ndecomposition: maximum depth: 100\nB(n) : n > 0 --> B(n-1)B(n-1)\nB(n) --> *\n",
    ] {
        let refused = problem(&mut document, &set(text, 3));
        assert!(refused.cause.is_some_and(|cause| cause.contains("200000")), "{text}");
        assert_eq!((document.plant().hash(), depth(&document)), (before, 1), "{text}");
    }
}
