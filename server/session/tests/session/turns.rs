//! What slices of work are for, so that nobody who draws waits for what is long.

use espalier_plant::{Wood, WoodAxis, WoodNode};
use espalier_proto::{access::Role, version::PROTOCOL_VERSION};
use espalier_session::{ClientId, Document, Entrant, Input, Output, Session, Urgency, Work};
use glam::Vec3;
use serde_json::{Value, json};

const CLIENT: ClientId = ClientId(1);

/// A session of a tree of so many metamers, which grew in a hundred steps.
struct Tree {
    session: Session,
    number: u32,
}

impl Tree {
    fn of(metamers: u32) -> Self {
        let node = |row: u32| WoodNode {
            parent: row.checked_sub(1),
            axis: 0,
            end: Vec3::Y * (row as f32 * 0.04),
            normal: None,
            radius: (row > 0).then_some(0.2),
            birth: row.min(1) + row * 99 / metamers,
        };
        let trunk = WoodAxis { bearer: None, direction: None, has_bud: true };
        let wood = Wood { nodes: (0..metamers).map(node).collect(), axes: vec![trunk], ..Wood::default() };
        let like = Document::new(7);
        let document = Document::transplanted(&wood, 7, &like.parameters(), *like.appearance());
        let bytes = document.expect("the wood fits together").to_saved_bytes();
        let (session, _) = Session::of_tree("oak", 1, &bytes, 100_000).expect("it is a tree");
        Self { session, number: 0 }
    }

    /// Somebody comes; the work of showing them the tree.
    fn enter(&mut self) -> Box<Work> {
        self.session.handle(0, Input::Connected(CLIENT, Entrant::new("Ann", Role::Editor)));
        let hello = json!({ "type": "hello", "protocol": PROTOCOL_VERSION, "client": "ann-tablet" });
        self.session.handle(0, Input::Text(CLIENT, hello.to_string()));
        self.work().expect("there is something to show")
    }

    fn entered(metamers: u32) -> Self {
        let mut tree = Self::of(metamers);
        let work = tree.enter();
        assert!(tree.done(work).is_none());
        tree
    }

    /// What is away now goes on the pool.
    fn work(&mut self) -> Option<Box<Work>> {
        let mut outputs = std::iter::from_fn(|| self.session.poll_output());
        outputs.find_map(|output| if let Output::Work(work) = output { Some(work) } else { None })
    }

    /// Does a slice; what is to be done next.
    fn done(&mut self, mut work: Box<Work>) -> Option<Box<Work>> {
        work.run(|| false);
        self.session.handle(0, Input::Worked(work));
        self.work()
    }

    fn order(&mut self, command: Value) -> Option<Box<Work>> {
        self.number += 1;
        let message = json!({ "type": "command", "id": self.number, "command": command });
        self.session.handle(0, Input::Text(CLIENT, message.to_string()));
        self.work()
    }
}

fn width() -> Value {
    json!({ "kind": "set_width", "row": 1, "diameter": 2.0 })
}

fn journey(step: u32) -> Value {
    json!({ "kind": "go_to", "step": step })
}

#[test]
fn what_is_long_in_one_piece_is_not_drawing() {
    for (metamers, expected) in [(2_000, Urgency::Drawing), (20_100, Urgency::Growing)] {
        let mut tree = Tree::of(metamers);
        let shown = tree.enter();
        assert_eq!(shown.urgency(), expected, "who comes is shown {metamers}");
        assert!(tree.done(shown).is_none());
        for command in [
            journey(50),
            json!({ "kind": "take_back" }),
            json!({ "kind": "undo" }),
            json!({ "kind": "take_future", "future": 1 }),
            json!({ "kind": "set_grammar_values", "values": [] }),
        ] {
            let work = tree.order(command.clone()).expect("it is to be done");
            assert_eq!(work.urgency(), expected, "{command} of {metamers}");
            let mut next = tree.done(work);
            while let Some(work) = next {
                next = tree.done(work);
            }
        }
        let work = tree.order(width()).expect("it is to be done");
        assert_eq!(work.urgency(), Urgency::Drawing, "a touch of {metamers}");
    }
}

#[test]
fn what_is_long_does_not_go_along_with_what_is_drawn() {
    let mut tree = Tree::entered(20_100);
    let away = tree.order(width()).expect("it is to be done");
    // Both wait until the document is back.
    assert!(tree.order(width()).is_none() && tree.order(journey(50)).is_none());
    let drawn = tree.done(away).expect("more is to be done");
    assert_eq!(drawn.urgency(), Urgency::Drawing);
    let long = tree.done(drawn).expect("the journey is still to be done");
    assert_eq!(long.urgency(), Urgency::Growing);
    tree.done(long);
    assert_eq!(tree.session.document().map(|document| document.figures().step), Some(50));
}
