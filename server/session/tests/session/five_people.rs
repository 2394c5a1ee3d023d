//! What five people may rely on as each takes back their own (`UD`), from outside and under virtual time: whoever drew
//! something finds it to the bit, whatever the others take back, and whatever the server outlives in between.

use std::collections::{BTreeMap, BTreeSet};

use espalier_proto::{ServerMessage, access::Role};
use espalier_session::Entrant;
use proptest::prelude::*;
use serde_json::{Value, json};

use crate::world::{World, grow, person};

const PEOPLE: usize = 5;
/// The last of them has two.
const DEVICES: usize = PEOPLE + 1;

#[derive(Clone, Copy, Debug)]
enum Deed {
    /// A stroke sidewards from a height.
    Draw(i8, u8),
    /// Growth by itself.
    Grow(u8),
    /// A stroke that goes on for a while, and its end.
    Begin(i8),
    End,
    TakeBack,
    BringBack,
    /// Nobody's deed: the server dies.
    Crash,
}

fn deed() -> impl Strategy<Value = (usize, Deed)> {
    let deed = prop_oneof![
        8 => (-9i8..9, 3u8..8).prop_map(|(x, y)| Deed::Draw(x, y)),
        2 => (1u8..4).prop_map(Deed::Grow),
        2 => (-9i8..9).prop_map(Deed::Begin),
        2 => Just(Deed::End),
        8 => Just(Deed::TakeBack),
        3 => Just(Deed::BringBack),
        1 => Just(Deed::Crash),
    ];
    (0..DEVICES, deed)
}

/// A session with five people in it.
struct Studio {
    world: World,
    /// The connection of each device.
    clients: Vec<u64>,
    /// The number of its next command.
    next: Vec<u32>,
    /// What each person drew and has not taken back since, by rows.
    drawn: Vec<BTreeSet<u32>>,
}

impl Studio {
    fn new() -> Self {
        let mut world = World::new();
        let clients = all_come(&mut world);
        world.settle();
        Self { world, clients, next: vec![1; DEVICES], drawn: vec![BTreeSet::new(); PEOPLE] }
    }

    /// The end of each living metamer, bit by bit.
    fn wood(&self) -> BTreeMap<u32, [u32; 3]> {
        let plant = self.world.document().plant();
        let ids = (0..plant.metamer_count()).map(espalier_plant::MetamerId::new);
        let living = ids.filter(|&id| plant.is_alive(id));
        living.map(|id| (id.raw(), plant.metamers().end(id).to_array().map(f32::to_bits))).collect()
    }

    fn command(&mut self, who: usize, command: Value) {
        let number = self.next[who];
        self.next[who] += 1;
        self.world.command(self.clients[who], number, command);
    }

    /// Somebody does something; all see the same when it is done.
    fn do_it(&mut self, who: usize, deed: Deed) {
        let before = self.world.document().plant().metamer_count();
        match deed {
            Deed::Draw(x, y) => {
                let samples = json!([
                    { "position": [0.0, f32::from(y), 0.0], "radius": 0.8 },
                    { "position": [f32::from(x), f32::from(y) + 3.0, f32::from(x) / 2.0], "radius": 0.8 },
                ]);
                self.command(who, json!({ "kind": "stroke_begin", "stroke": 1 }));
                self.command(who, json!({ "kind": "stroke_move", "stroke": 1, "samples": samples }));
                self.command(who, json!({ "kind": "stroke_end", "stroke": 1 }));
            }
            Deed::Grow(steps) => self.command(who, grow(steps.into())),
            Deed::Begin(x) => {
                let samples = json!([
                    { "position": [0.0, 4.0, 0.0], "radius": 0.8 },
                    { "position": [f32::from(x), 6.0, 2.0], "radius": 0.8 },
                ]);
                self.command(who, json!({ "kind": "stroke_begin", "stroke": 2 }));
                self.command(who, json!({ "kind": "stroke_move", "stroke": 2, "samples": samples }));
            }
            Deed::End => self.command(who, json!({ "kind": "stroke_end", "stroke": 2 })),
            Deed::TakeBack => self.command(who, json!({ "kind": "take_back" })),
            Deed::BringBack => self.command(who, json!({ "kind": "bring_back" })),
            Deed::Crash => {
                self.world.settle();
                self.world.crash();
                self.clients = all_come(&mut self.world);
            }
        }
        self.world.settle();
        // Where strokes of others go on, some of it is theirs.
        let is_alone = self.strokes_but_of(who).iter().all(Vec::is_empty);
        if matches!(deed, Deed::Draw(..)) && is_alone {
            let after = self.world.document().plant().metamer_count();
            self.drawn[person_at(who)].extend((before..after).map(|row| row as u32));
        }
    }

    /// What somebody took back is theirs no longer: what fell of it, and what stays only to hold others' wood.
    fn give_up(&mut self, who: usize, wood: &BTreeMap<u32, [u32; 3]>) {
        let last = self.next[who] - 1;
        let holds = self
            .world
            .peer(self.clients[who])
            .texts
            .iter()
            .any(|text| matches!(text, ServerMessage::Deed { deed } if deed.id == last && deed.held > 0));
        self.drawn[person_at(who)].retain(|row| !holds && wood.contains_key(row));
    }

    /// Whether the last thing that somebody asked for was refused.
    fn was_refused(&self, who: usize) -> bool {
        let last = self.next[who] - 1;
        let texts = &self.world.peer(self.clients[who]).texts;
        texts.iter().any(|text| matches!(text, ServerMessage::Refused { id, .. } if *id == last))
    }

    /// The strokes in progress of everybody else.
    fn strokes_but_of(&self, who: usize) -> Vec<Vec<u32>> {
        let others = (0..DEVICES).filter(|&other| person_at(other) != person_at(who));
        others.map(|other| self.world.document().open_strokes(&person(&key(other)))).collect()
    }
}

/// Who is at a device.
fn person_at(device: usize) -> usize {
    device.min(PEOPLE - 1)
}

fn all_come(world: &mut World) -> Vec<u64> {
    let come = |device| {
        let client = world.connect_as(Entrant::new(format!("person {}", person_at(device)), Role::Editor));
        world.hello(client, &key(device), None);
        client
    };
    (0..DEVICES).map(come).collect()
}

fn key(who: usize) -> String {
    format!("somebody-{who}")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn ud1_nobody_loses_what_they_drew_by_what_others_take_back(
        deeds in prop::collection::vec(deed(), 5..40),
    ) {
        let mut studio = Studio::new();
        studio.do_it(0, Deed::Grow(6));
        for (who, deed) in deeds {
            let (before, open) = (studio.wood(), studio.strokes_but_of(who));
            studio.do_it(who, deed);
            let after = studio.wood();
            for client in &studio.clients {
                studio.world.assert_mirrored(*client);
            }
            if matches!(deed, Deed::TakeBack) {
                studio.give_up(who, &after);
                prop_assert_eq!(studio.strokes_but_of(who), open, "strokes of others go on");
            }
            for (other, drawn) in studio.drawn.iter().enumerate() {
                let is_own = other == person_at(who) && !matches!(deed, Deed::Crash);
                for row in drawn.iter().filter(|row| !is_own && before.contains_key(row)) {
                    prop_assert_eq!(before.get(row), after.get(row), "row {} after {:?}", row, deed);
                }
            }
        }
        // Once everybody has taken back everything there is the seedling. What bears others' wood goes after that has gone.
        for who in 0..DEVICES {
            studio.do_it(who, Deed::End);
        }
        while (0..DEVICES).any(|who| {
            studio.do_it(who, Deed::TakeBack);
            !studio.was_refused(who)
        }) {}
        prop_assert_eq!(studio.wood().into_keys().collect::<Vec<_>>(), [0]);
        prop_assert_eq!(studio.world.replayed_hash(), studio.world.document().hash());
    }
}
