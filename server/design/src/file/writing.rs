//! Designs into JSON.

use serde_json::{Map, Value as Text, json};

use super::{
    VERSION,
    values::{number, written},
};
use crate::{
    design::Design,
    graph::{From, Owner, Record, Setting, Source, Visibility},
    slots::Slot,
    value::Op,
};

impl Design {
    /// All that was said, as JSON of [version 1](VERSION): numbers in the fewest digits that mean them.
    pub fn to_json(&self) -> String {
        let graph = self.graph();
        let (mut nodes, mut levels) = (Map::new(), Map::new());
        for (owner, record) in graph.records() {
            match owner {
                Owner::Node(node) => nodes.insert(node.to_string(), record_of(record)),
                Owner::Level(level) => levels.insert(level.order().to_string(), record_of(record)),
            };
        }
        let mut shares = Map::new();
        for (id, share) in graph.shares() {
            let share = json!({ "key": share.key.row().name, "level": share.level.order(), "value": written(share.value.get()) });
            shares.insert(id.0.to_string(), share);
        }
        let mut laterals = Map::new();
        for (bearer, slots) in &graph.slots {
            laterals.insert(bearer.to_string(), slots.iter().map(slot).collect());
        }
        let whole = json!({
            "version": VERSION,
            "seed": graph.seed(),
            "nodes": nodes,
            "levels": levels,
            "shares": shares,
            "laterals": laterals,
        });
        whole.to_string()
    }
}

fn record_of(record: &Record) -> Text {
    let values: Map<_, _> =
        record.settings.iter().map(|(key, said)| (key.row().name.to_owned(), setting(said))).collect();
    let mut object = Map::new();
    if let Some(name) = &record.name {
        object.insert("name".into(), name.as_str().into());
    }
    object.insert("values".into(), values.into());
    object.into()
}

fn setting(setting: &Setting) -> Text {
    let mut object = Map::new();
    let (name, value) = match &setting.source {
        Source::Explicit(value) => ("own", written(value.get())),
        Source::Shared(share) => ("shared", share.0.into()),
        Source::Relative(Op::Add, value) => ("add", written(value.get())),
        Source::Relative(Op::Multiply, value) => ("multiply", written(value.get())),
        Source::Inherited => ("inherited", true.into()),
    };
    object.insert(name.into(), value);
    if setting.visibility == Visibility::Private {
        object.insert("private".into(), true.into());
    }
    if setting.from == From::Below {
        object.insert("below".into(), true.into());
    }
    object.into()
}

fn slot(slot: &Slot) -> Text {
    let mut object = Map::new();
    object.insert("number".into(), slot.ordinal.into());
    object.insert("home".into(), number(slot.home));
    for (name, value) in [("azimuth", slot.azimuth), ("anchor", slot.anchor)] {
        object.extend(value.map(|value| (name.to_owned(), number(value))));
    }
    object.extend(slot.place.map(|place| ("place".to_owned(), place.into())));
    object.into()
}
