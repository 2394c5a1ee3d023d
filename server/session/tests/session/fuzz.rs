//! Random people doing random things: whatever happens, everybody sees the same tree in the end.

use std::sync::LazyLock;

use espalier_proto::{Action, ClientMessage, Steps};
use espalier_session::{ClientId, Document, Input, Principal, ReadId, Session};
use espalier_settings::{Appearance, AppearancePatch, LeafLook, ParametersPatch};
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::{guiding::lasso, mirror::Mirror, world::World};

const KEYS: [&str; 5] = ["birch-01", "maple-01", "aspen-01", "cedar-01", "alder-01"];

/// One thing someone does; `who` picks one of [`KEYS`].
#[derive(Clone, Debug)]
enum ClientEvent {
    Command(usize, Box<Value>),
    /// The last command once more.
    Again(usize),
    Leave(usize),
    Resume(usize),
    /// Answers frames from now on, or does not.
    Slow(usize, bool),
    Garbage(usize, String),
    Predict(usize, Vec<u32>, u32),
    Binary(usize),
    Read,
    Pass(u64),
    Crash,
    DiskTakes(u64),
}

pub fn command() -> impl Strategy<Value = Value> {
    let sample = (-5.0f32..5.0, 0.0f32..12.0, -5.0f32..5.0, 0.0f32..4.0)
        .prop_map(|(x, y, z, radius)| json!({ "position": [x, y, z], "radius": radius }));
    prop_oneof![
        3 => (1u32..6, prop::option::of(0u32..3)).prop_map(|(steps, gesture)| json!({ "kind": "grow", "steps": steps, "gesture": gesture })),
        2 => (1u32..8).prop_map(|steps| json!({ "kind": "ungrow", "steps": steps })),
        2 => Just(json!({ "kind": "undo" })),
        1 => Just(json!({ "kind": "redo" })),
        4 => Just(json!({ "kind": "take_back" })),
        2 => Just(json!({ "kind": "bring_back" })),
        2 => (0u32..3).prop_map(|stroke| json!({ "kind": "stroke_begin", "stroke": stroke })),
        4 => (0u32..3, prop::collection::vec(sample, 0..4))
            .prop_map(|(stroke, samples)| json!({ "kind": "stroke_move", "stroke": stroke, "samples": samples })),
        2 => (0u32..3).prop_map(|stroke| json!({ "kind": "stroke_end", "stroke": stroke })),
        2 => (0.3f32..0.8, prop::option::of(0u32..2)).prop_map(|(control, gesture)| json!({ "kind": "set_parameters", "parameters": ParametersPatch { apical_control: Some(control), ..ParametersPatch::default() }, "gesture": gesture })),
        2 => (-0.5f32..3.5, prop::option::of(0u32..2)).prop_map(|(season, gesture)| {
            let leaves = LeafLook { season: season.round(), ..Appearance::default().leaves };
            let appearance = AppearancePatch { leaves: Some(leaves.into()), ..AppearancePatch::default() };
            json!({ "kind": "set_appearance", "appearance": appearance, "gesture": gesture })
        }),
        1 => (0u32..20).prop_map(|leaves| json!({ "kind": "set_parameters", "parameters": ParametersPatch { leaves_per_node: Some(leaves), ..ParametersPatch::default() } })),
        1 => (-8.0f32..8.0, -8.0f32..8.0).prop_map(|(x, z)| json!({ "kind": "plant_seed", "position": [x, 0.0, z] })),
        2 => Just(json!({ "kind": "stop" })),
        1 => (0.5f32..5.0, 0.5f32..8.0, prop::option::of(0u32..40))
            .prop_map(|(width, height, bud)| lasso(width, height, bud)),
        1 => (1u32..6, 0u32..60).prop_map(|(steps, bud)| json!({ "kind": "grow", "steps": steps, "bud": Some(bud) })),
        3 => obstacle(),
        10 => shaping(),
    ]
}

fn obstacle() -> impl Strategy<Value = Value> {
    let gesture = || prop::option::of(0u32..2);
    prop_oneof![
        (-6.0f32..6.0, 0.0f32..8.0, 0.0f32..3.0, gesture()).prop_map(|(x, y, radius, gesture)| {
            let obstacle = json!({ "shape": json!({ "kind": "sphere", "radius": radius }), "pose": pose(x, y) });
            json!({ "kind": "place_obstacle", "obstacle": obstacle, "gesture": gesture })
        }),
        (0u32..4, -6.0f32..6.0, gesture()).prop_map(|(id, x, gesture)| json!({ "kind": "move_obstacle", "id": id, "pose": pose(x, 1.0), "gesture": gesture })),
        (0u32..4, 0.0f32..3.0, gesture()).prop_map(|(id, radius, gesture)| json!({ "kind": "reshape_obstacle", "id": id, "shape": json!({ "kind": "sphere", "radius": radius }), "gesture": gesture })),
        (0u32..4, gesture()).prop_map(|(id, gesture)| json!({ "kind": "remove_obstacle", "id": id, "gesture": gesture })),
    ]
}

fn shaping() -> impl Strategy<Value = Value> {
    let row = || 1u32..60;
    let gesture = || prop::option::of(0u32..2);
    let rotation = (-1.0f32..1.0).prop_map(|x| [x, 0.0, 0.0, (1.0 - x * x).sqrt()]).boxed();
    let again = rotation.clone();
    let place = || prop::array::uniform3(-3.0f32..9.0);
    prop_oneof![
        4 => (0u32..2, row(), prop::collection::vec(row(), 1..3), 0.0f32..1.0, gesture()).prop_map(
            |(bend, base, touches, stretch, gesture)| json!({ "kind": "bend_begin", "bend": bend, "base": base, "touches": touches, "stretch": stretch, "gesture": gesture }),
        ),
        4 => (0u32..2, prop::collection::vec(place(), 1..3))
            .prop_map(|(bend, targets)| json!({ "kind": "bend_move", "bend": bend, "targets": targets })),
        2 => (0u32..2).prop_map(|bend| json!({ "kind": "bend_end", "bend": bend })),
        1 => (0u32..2).prop_map(|bend| json!({ "kind": "bend_cancel", "bend": bend })),
        2 => (row(), prop::option::of(0.05f32..2.0), gesture())
            .prop_map(|(row, diameter, gesture)| json!({ "kind": "set_width", "row": row, "diameter": diameter, "gesture": gesture })),
        2 => (prop::collection::vec(row(), 1..3), gesture())
            .prop_map(|(rows, gesture)| json!({ "kind": "prune", "rows": rows, "gesture": gesture })),
        1 => (0.0f32..1.0).prop_map(|exposure| json!({ "kind": "prune_dim", "exposure": exposure })),
        2 => (-8.0f32..8.0).prop_map(|x| json!({ "kind": "new_design", "position": [x, 0.0, 3.0], "graph": {
            "version": 1,
            "nodes": { "/": { "values": { "height": { "own": 9.0 }, "orders": { "own": 1.0 } } } },
        } })),
        3 => (0u32..9, -90.0f32..90.0).prop_map(|(limb, roll)| json!({ "kind": "edit_design", "edits": [
            { "edit": "set", "of": format!("/{limb}"), "key": "roll", "value": { "own": roll } },
        ] })),
        2 => (row(), rotation, gesture())
            .prop_map(|(row, rotation, gesture)| json!({ "kind": "turn_branch", "row": row, "rotation": rotation, "gesture": gesture })),
        2 => (row(), row(), again, any::<bool>())
            .prop_map(|(row, onto, rotation, keep)| json!({ "kind": "graft", "row": row, "onto": onto, "rotation": rotation, "keep": keep })),
        3 => (0u32..30).prop_map(|step| json!({ "kind": "go_to", "step": step })),
        3 => (0u32..6).prop_map(|future| json!({ "kind": "take_future", "future": future })),
    ]
}

fn pose(x: f32, y: f32) -> Value {
    json!({ "position": [x, y, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0] })
}

fn event() -> impl Strategy<Value = ClientEvent> {
    let who = || 0..KEYS.len();
    prop_oneof![
        12 => (who(), command()).prop_map(|(who, command)| ClientEvent::Command(who, Box::new(command))),
        1 => who().prop_map(ClientEvent::Again),
        1 => who().prop_map(ClientEvent::Leave),
        2 => who().prop_map(ClientEvent::Resume),
        2 => (who(), any::<bool>()).prop_map(|(who, slow)| ClientEvent::Slow(who, slow)),
        1 => (who(), ".{0,40}").prop_map(|(who, text)| ClientEvent::Garbage(who, text)),
        1 => who().prop_map(ClientEvent::Binary),
        2 => (who(), prop::collection::vec(1u32..60, 0..3), 0u32..8)
            .prop_map(|(who, rows, steps)| ClientEvent::Predict(who, rows, steps)),
        1 => Just(ClientEvent::Read),
        6 => (0u64..40).prop_map(ClientEvent::Pass),
        1 => (0u64..40_000).prop_map(ClientEvent::Pass),
        1 => Just(ClientEvent::Crash),
        1 => (1u64..100).prop_map(ClientEvent::DiskTakes),
    ]
}

/// A tree whose rows fill a window, as the first snapshot of a session.
static LARGE_TREE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut document = Document::new(3);
    document
        .apply(
            &Principal::visitor(),
            &Action::Grow { steps: Steps::nearest(18), until: None, bud: None }.into(),
        )
        .unwrap();
    Session::of_tree("tree", 1, &document.to_bytes(), 1_000_000).unwrap().1
});

/// Changes to a large tree: little ones, and some back and forth in time.
fn upheaval() -> impl Strategy<Value = ClientEvent> {
    let who = || 0..KEYS.len();
    let command = prop_oneof![
        1 => (1u32..3).prop_map(|steps| json!({ "kind": "ungrow", "steps": steps })),
        1 => Just(json!({ "kind": "undo" })),
        2 => Just(json!({ "kind": "redo" })),
        4 => (-8.0f32..8.0, -8.0f32..8.0).prop_map(|(x, z)| json!({ "kind": "plant_seed", "position": [x, 0.0, z] })),
    ];
    prop_oneof![
        8 => (who(), command).prop_map(|(who, command)| ClientEvent::Command(who, Box::new(command))),
        3 => (who(), prop::bool::weighted(0.6)).prop_map(|(who, slow)| ClientEvent::Slow(who, slow)),
        1 => who().prop_map(ClientEvent::Resume),
        6 => (0u64..30).prop_map(ClientEvent::Pass),
    ]
}

/// A client as it should be: it keeps its commands until they are acknowledged, and its rows.
#[derive(Default)]
struct Person {
    connection: Option<u64>,
    sent: Vec<Value>,
    mirror: Mirror,
    slow: bool,
}

struct Crowd {
    world: World,
    people: Vec<Person>,
}

impl Crowd {
    fn do_event(&mut self, event: ClientEvent) {
        match event {
            ClientEvent::Command(who, command) => {
                let client = self.arrive(who);
                self.people[who].sent.push(Value::clone(&command));
                let id = self.people[who].sent.len() as u32;
                self.world.command(client, id, *command);
            }
            ClientEvent::Again(who) => {
                let client = self.arrive(who);
                if let Some(command) = self.people[who].sent.last().cloned() {
                    let id = self.people[who].sent.len() as u32;
                    self.world.command(client, id, command);
                }
            }
            ClientEvent::Leave(who) => self.leave(who),
            ClientEvent::Resume(who) => {
                self.leave(who);
                self.arrive(who);
            }
            ClientEvent::Slow(who, slow) => {
                self.people[who].slow = slow;
                let client = self.arrive(who);
                self.world.peer_mut(client).slow = slow;
            }
            ClientEvent::Garbage(who, text) => {
                let client = self.arrive(who);
                self.world.text(client, &text);
            }
            ClientEvent::Predict(who, rows, steps) => {
                let client = self.arrive(who);
                self.world.send(client, &json!({ "type": "predict", "rows": rows, "steps": steps }));
            }
            ClientEvent::Binary(who) => {
                let client = self.arrive(who);
                self.world.handle(Input::Binary(ClientId(client)));
            }
            ClientEvent::Read => self.world.handle(Input::Read(ReadId(1))),
            ClientEvent::Pass(ms) => self.world.pass(ms),
            ClientEvent::Crash => {
                for person in &mut self.people {
                    if let Some(client) = person.connection.take() {
                        person.mirror = self.world.peer(client).mirror.clone();
                    }
                }
                self.world.crash();
            }
            ClientEvent::DiskTakes(ms) => self.world.write_ms = ms,
        }
    }

    fn around(world: World) -> Self {
        Self { world, people: KEYS.map(|_| Person::default()).into() }
    }

    fn leave(&mut self, who: usize) {
        if let Some(client) = self.people[who].connection.take() {
            self.people[who].mirror = self.world.leave(client).mirror;
        }
    }

    /// The connection of someone, made if need be, with everything sent again that is not acknowledged.
    fn arrive(&mut self, who: usize) -> u64 {
        let person = &mut self.people[who];
        if let Some(client) = person.connection {
            return client;
        }
        let mirror = std::mem::take(&mut person.mirror);
        let client = if mirror.rows.is_empty() {
            self.world.join(KEYS[who])
        } else {
            self.world.rejoin(KEYS[who], mirror)
        };
        person.connection = Some(client);
        self.world.peer_mut(client).slow = person.slow;
        let acknowledged = self.world.peer(client).welcome_acknowledged() as usize;
        for (index, command) in person.sent.iter().enumerate().skip(acknowledged) {
            self.world.command(client, index as u32 + 1, command.clone());
        }
        client
    }

    fn check_in_the_end(mut self) -> Result<(), TestCaseError> {
        self.world.write_ms = 5;
        for who in 0..KEYS.len() {
            let client = self.arrive(who);
            self.world.peer_mut(client).slow = false;
        }
        self.world.settle();
        self.world.settle();
        for person in &self.people {
            self.world.assert_mirrored(person.connection.unwrap());
        }
        let hash = self.world.document().hash();
        prop_assert_eq!(self.world.replayed_hash(), hash, "the journal alone gives the same document");
        self.world.crash();
        prop_assert_eq!(self.world.document().hash(), hash, "snapshot and journal give the same document");
        Ok(())
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn all_see_the_same_tree(events in prop::collection::vec(event(), 1..60)) {
        let mut crowd = Crowd::around(World::new());
        for event in events {
            crowd.do_event(event);
        }
        crowd.check_in_the_end()?;
    }

    #[test]
    fn any_text_is_survived(texts in prop::collection::vec(".{0,60}", 0..20), greeted in any::<bool>()) {
        let mut world = World::new();
        let client = if greeted { world.join("birch-01") } else { world.connect() };
        let texts_sent = texts.len();
        for text in texts {
            world.text(client, &text);
            if world.peer(client).closed.is_some() {
                break;
            }
        }
        // Only a hello opens the door, and none of these is one.
        prop_assert_eq!(world.peer(client).closed.is_none(), greeted || texts_sent == 0);
    }

    #[test]
    fn any_json_is_survived(kind in "[a-z_]{1,12}", field in "[a-z_]{1,10}", number in any::<f64>(), id in any::<u32>()) {
        let mut world = World::new();
        let client = world.join("birch-01");
        for kind in [
            kind.as_str(),
            "grow",
            "stroke_move",
            "set_parameters",
            "plant_seed",
            "lasso",
            "place_obstacle",
            "move_obstacle",
            "reshape_obstacle",
            "bend_begin",
            "set_width",
            "graft",
            "take_future",
        ] {
            for field in [field.as_str(), "steps", "touches", "row", "diameter", "rotation", "future", "samples", "position", "parameters", "outline", "plane", "obstacle", "pose"] {
                let command = serde_json::json!({ "kind": kind, field: number });
                world.text(client, &serde_json::json!({"type": "command", "id": id, "command": command}).to_string());
                world.text(client, &serde_json::json!({"type": kind, field: number, "id": id}).to_string());
            }
        }
        world.send(client, &ClientMessage::Ping { nonce: 1 });
        world.settle();
        prop_assert_eq!(world.peer(client).closed, None);
    }
}

proptest! {
    // Each case moves large trees, so there are fewer.
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn slow_readers_see_the_same_tree(events in prop::collection::vec(upheaval(), 10..30)) {
        let mut crowd = Crowd::around(World::opened_with(Some(LARGE_TREE.clone())));
        for who in 0..KEYS.len() {
            crowd.do_event(ClientEvent::Slow(who, true));
        }
        for event in events {
            crowd.do_event(event);
        }
        crowd.check_in_the_end()?;
    }
}
