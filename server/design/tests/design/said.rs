//! Short ways to say things.

use espalier_design::{
    Curve, Design, Edit, Envelope, Function, Held, Key, Level, NodeId, Op, Owner, Setting, ShareId, Source,
    Value,
};
use glam::Vec3;

pub(crate) fn node(text: &str) -> NodeId {
    text.parse().expect("it is a way")
}

pub(crate) fn on(text: &str) -> Owner {
    Owner::Node(node(text))
}

pub(crate) fn level(order: u8) -> Owner {
    Owner::Level(Level::new(order).expect("there is such an order"))
}

pub(crate) fn scalar(value: f32) -> Held {
    Held::new(Value::Scalar(value))
}

pub(crate) fn constant(value: f32) -> Held {
    Held::new(Value::Function(Function::constant(value)))
}

pub(crate) fn span(first: f32, last: f32) -> Held {
    Held::new(Value::Span(first, last))
}

pub(crate) fn vector(x: f32, y: f32, z: f32) -> Held {
    Held::new(Value::Vector(Vec3::new(x, y, z)))
}

pub(crate) fn envelope(envelope: Envelope) -> Held {
    Held::new(Value::Envelope(envelope))
}

/// An axis that goes out to one side and comes back.
pub(crate) fn curved() -> Held {
    let curve = Curve::new(&[Vec3::ZERO, Vec3::new(0.4, 0.5, 0.0), Vec3::Y]).expect("it is one");
    Held::new(Value::Curve(curve))
}

pub(crate) fn set(owner: Owner, key: Key, value: Held) -> Edit {
    Edit::Set { owner, key, setting: Setting::own(value) }
}

pub(crate) fn relative(owner: Owner, key: Key, op: Op, value: Held) -> Edit {
    Edit::Set { owner, key, setting: Source::Relative(op, value).into() }
}

pub(crate) fn shared(share: u32, key: Key, value: Held, members: &[&str]) -> Edit {
    Edit::Share {
        share: ShareId(share),
        key,
        value,
        members: members.iter().map(|text| node(text)).collect(),
    }
}

/// A design after these edits.
pub(crate) fn designed(edits: &[Edit]) -> Design {
    let mut design = Design::default();
    for edit in edits {
        design.apply(edit).unwrap_or_else(|refusal| panic!("{edit:?}: {refusal}"));
    }
    design
}

pub(crate) fn number(design: &Design, of: &str, key: Key) -> f32 {
    design.branch(node(of)).unwrap_or_else(|| panic!("{of} does not stand")).values().scalar(key)
}

/// As many laterals as the figures of the paper have, evenly along the whole axis, and no branches on them.
pub(crate) fn plain(laterals: u16) -> Vec<Edit> {
    vec![
        set(on("/"), Key::Zone, span(0.0, 1.0)),
        set(on("/"), Key::Orders, scalar(1.0)),
        set(on("/"), Key::Density, constant(laterals.into())),
    ]
}
