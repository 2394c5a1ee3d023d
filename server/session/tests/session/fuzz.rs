//! Random people doing random things: whatever happens, everybody sees the same tree in the end.

use std::sync::LazyLock;

use espalier_proto::{ClientMessage, Command, Obstacle, Pose, Shape, StrokeSample};
use espalier_session::{Action, ClientId, Document, Input, ReadId, Session};
use espalier_settings::{Appearance, AppearancePatch, LeafLook, ParametersPatch};
use proptest::prelude::*;

use crate::{guiding::lasso, mirror::Mirror, world::World};

const KEYS: [&str; 4] = ["birch-01", "maple-01", "aspen-01", "cedar-01"];

/// One thing someone does; `who` picks one of [`KEYS`].
#[derive(Clone, Debug)]
enum Deed {
    Command(usize, Box<Command>),
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

fn command() -> impl Strategy<Value = Command> {
    let sample = (-5.0f32..5.0, 0.0f32..12.0, -5.0f32..5.0, 0.0f32..4.0)
        .prop_map(|(x, y, z, radius)| StrokeSample { position: [x, y, z], radius });
    prop_oneof![
        3 => (1u32..6, prop::option::of(0u32..3)).prop_map(|(steps, gesture)| Command::Grow { steps, gesture, bud: None }),
        2 => (1u32..8).prop_map(|steps| Command::Ungrow { steps }),
        2 => Just(Command::Undo {}),
        1 => Just(Command::Redo {}),
        2 => (0u32..3).prop_map(|stroke| Command::StrokeBegin { stroke, bud: None }),
        4 => (0u32..3, prop::collection::vec(sample, 0..4))
            .prop_map(|(stroke, samples)| Command::StrokeMove { stroke, samples }),
        2 => (0u32..3).prop_map(|stroke| Command::StrokeEnd { stroke }),
        2 => (0.3f32..0.8, prop::option::of(0u32..2)).prop_map(|(control, gesture)| Command::SetParameters {
            parameters: ParametersPatch { apical_control: Some(control), ..ParametersPatch::default() },
            gesture,
        }),
        2 => (-0.5f32..3.5, prop::option::of(0u32..2)).prop_map(|(season, gesture)| {
            let leaves = LeafLook { season: season.round(), ..Appearance::default().leaves };
            let appearance = AppearancePatch { leaves: Some(leaves.into()), ..AppearancePatch::default() };
            Command::SetAppearance { appearance, gesture }
        }),
        1 => (0u32..20).prop_map(|leaves| Command::SetParameters {
            parameters: ParametersPatch { leaves_per_node: Some(leaves), ..ParametersPatch::default() },
            gesture: None,
        }),
        1 => (-8.0f32..8.0, -8.0f32..8.0).prop_map(|(x, z)| Command::PlantSeed { position: [x, 0.0, z] }),
        2 => Just(Command::Stop { tick: None }),
        1 => (0.5f32..5.0, 0.5f32..8.0, prop::option::of(0u32..40))
            .prop_map(|(width, height, bud)| lasso(width, height, bud)),
        1 => (1u32..6, 0u32..60).prop_map(|(steps, bud)| Command::Grow { steps, gesture: None, bud: Some(bud) }),
        3 => obstacle(),
        10 => shaping(),
    ]
}

fn obstacle() -> impl Strategy<Value = Command> {
    let gesture = || prop::option::of(0u32..2);
    prop_oneof![
        (-6.0f32..6.0, 0.0f32..8.0, 0.0f32..3.0, gesture()).prop_map(|(x, y, radius, gesture)| {
            let obstacle = Obstacle { shape: Shape::Sphere { radius }, pose: pose(x, y) };
            Command::PlaceObstacle { obstacle, gesture }
        }),
        (0u32..4, -6.0f32..6.0, gesture()).prop_map(|(id, x, gesture)| Command::MoveObstacle {
            id,
            pose: pose(x, 1.0),
            gesture
        }),
        (0u32..4, 0.0f32..3.0, gesture()).prop_map(|(id, radius, gesture)| Command::ReshapeObstacle {
            id,
            shape: Shape::Sphere { radius },
            gesture
        }),
        (0u32..4, gesture()).prop_map(|(id, gesture)| Command::RemoveObstacle { id, gesture }),
    ]
}

fn shaping() -> impl Strategy<Value = Command> {
    let row = || 1u32..60;
    let gesture = || prop::option::of(0u32..2);
    let rotation = (-1.0f32..1.0).prop_map(|x| [x, 0.0, 0.0, (1.0 - x * x).sqrt()]).boxed();
    let again = rotation.clone();
    let place = || prop::array::uniform3(-3.0f32..9.0);
    prop_oneof![
        4 => (0u32..2, row(), prop::collection::vec(row(), 1..3), 0.0f32..1.0, gesture()).prop_map(
            |(bend, base, touches, stretch, gesture)| Command::BendBegin { bend, base, touches, stretch, gesture },
        ),
        4 => (0u32..2, prop::collection::vec(place(), 1..3))
            .prop_map(|(bend, targets)| Command::BendMove { bend, targets }),
        2 => (0u32..2).prop_map(|bend| Command::BendEnd { bend }),
        1 => (0u32..2).prop_map(|bend| Command::BendCancel { bend }),
        2 => (row(), prop::option::of(0.05f32..2.0), gesture())
            .prop_map(|(row, diameter, gesture)| Command::SetWidth { row, diameter, gesture }),
        2 => (prop::collection::vec(row(), 1..3), gesture())
            .prop_map(|(rows, gesture)| Command::Prune { rows, gesture }),
        1 => (0.0f32..1.0).prop_map(|exposure| Command::PruneDim { exposure }),
        2 => (row(), rotation, gesture())
            .prop_map(|(row, rotation, gesture)| Command::TurnBranch { row, rotation, gesture }),
        2 => (row(), row(), again, any::<bool>())
            .prop_map(|(row, onto, rotation, keep)| Command::Graft { row, onto, rotation, keep }),
        3 => (0u32..30).prop_map(|step| Command::GoTo { step }),
        3 => (0u32..6).prop_map(|future| Command::TakeFuture { future }),
    ]
}

fn pose(x: f32, y: f32) -> Pose {
    Pose { position: [x, y, 0.0], rotation: [0.0, 0.0, 0.0, 1.0] }
}

fn deed() -> impl Strategy<Value = Deed> {
    let who = || 0..KEYS.len();
    prop_oneof![
        12 => (who(), command()).prop_map(|(who, command)| Deed::Command(who, Box::new(command))),
        1 => who().prop_map(Deed::Again),
        1 => who().prop_map(Deed::Leave),
        2 => who().prop_map(Deed::Resume),
        2 => (who(), any::<bool>()).prop_map(|(who, slow)| Deed::Slow(who, slow)),
        1 => (who(), ".{0,40}").prop_map(|(who, text)| Deed::Garbage(who, text)),
        1 => who().prop_map(Deed::Binary),
        2 => (who(), prop::collection::vec(1u32..60, 0..3), 0u32..8)
            .prop_map(|(who, rows, steps)| Deed::Predict(who, rows, steps)),
        1 => Just(Deed::Read),
        6 => (0u64..40).prop_map(Deed::Pass),
        1 => (0u64..40_000).prop_map(Deed::Pass),
        1 => Just(Deed::Crash),
        1 => (1u64..100).prop_map(Deed::DiskTakes),
    ]
}

/// A tree whose rows fill a window, as the first snapshot of a session.
static LARGE_TREE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut document = Document::new(3);
    document.apply("birch-01", &Action::Grow { steps: 18, gesture: None, bud: None }).unwrap();
    Session::first_snapshot(&document.to_bytes(), 1_000_000).unwrap()
});

/// Changes to a large tree: little ones, and some back and forth in time.
fn upheaval() -> impl Strategy<Value = Deed> {
    let who = || 0..KEYS.len();
    let command = prop_oneof![
        1 => (1u32..3).prop_map(|steps| Command::Ungrow { steps }),
        1 => Just(Command::Undo {}),
        2 => Just(Command::Redo {}),
        4 => (-8.0f32..8.0, -8.0f32..8.0).prop_map(|(x, z)| Command::PlantSeed { position: [x, 0.0, z] }),
    ];
    prop_oneof![
        8 => (who(), command).prop_map(|(who, command)| Deed::Command(who, Box::new(command))),
        3 => (who(), prop::bool::weighted(0.6)).prop_map(|(who, slow)| Deed::Slow(who, slow)),
        1 => who().prop_map(Deed::Resume),
        6 => (0u64..30).prop_map(Deed::Pass),
    ]
}

/// A client as it should be: it keeps its commands until they are acknowledged, and its rows.
#[derive(Default)]
struct Person {
    connection: Option<u64>,
    sent: Vec<Command>,
    mirror: Mirror,
    slow: bool,
}

struct Crowd {
    world: World,
    people: Vec<Person>,
}

impl Crowd {
    fn do_deed(&mut self, deed: Deed) {
        match deed {
            Deed::Command(who, command) => {
                let client = self.arrive(who);
                self.people[who].sent.push(Command::clone(&command));
                let id = self.people[who].sent.len() as u32;
                self.world.command(client, id, *command);
            }
            Deed::Again(who) => {
                let client = self.arrive(who);
                if let Some(command) = self.people[who].sent.last().cloned() {
                    let id = self.people[who].sent.len() as u32;
                    self.world.command(client, id, command);
                }
            }
            Deed::Leave(who) => self.leave(who),
            Deed::Resume(who) => {
                self.leave(who);
                self.arrive(who);
            }
            Deed::Slow(who, slow) => {
                self.people[who].slow = slow;
                let client = self.arrive(who);
                self.world.peer_mut(client).slow = slow;
            }
            Deed::Garbage(who, text) => {
                let client = self.arrive(who);
                self.world.text(client, &text);
            }
            Deed::Predict(who, rows, steps) => {
                let client = self.arrive(who);
                self.world.send(client, &ClientMessage::Predict { rows, steps });
            }
            Deed::Binary(who) => {
                let client = self.arrive(who);
                self.world.handle(Input::Binary(ClientId(client)));
            }
            Deed::Read => self.world.handle(Input::Read(ReadId(1))),
            Deed::Pass(ms) => self.world.pass(ms),
            Deed::Crash => {
                for person in &mut self.people {
                    if let Some(client) = person.connection.take() {
                        person.mirror = self.world.peer(client).mirror.clone();
                    }
                }
                self.world.crash();
            }
            Deed::DiskTakes(ms) => self.world.write_ms = ms,
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
    fn all_see_the_same_tree(deeds in prop::collection::vec(deed(), 1..60)) {
        let mut crowd = Crowd::around(World::new());
        for deed in deeds {
            crowd.do_deed(deed);
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
    fn slow_readers_see_the_same_tree(deeds in prop::collection::vec(upheaval(), 10..30)) {
        let mut crowd = Crowd::around(World::opened_with(Some(LARGE_TREE.clone())));
        for who in 0..KEYS.len() {
            crowd.do_deed(Deed::Slow(who, true));
        }
        for deed in deeds {
            crowd.do_deed(deed);
        }
        crowd.check_in_the_end()?;
    }
}
