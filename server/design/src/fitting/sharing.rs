//! When values are the same, and what siblings share.

use std::collections::BTreeMap;

use super::{course::difference, outline};
use crate::{
    graph::{Graph, Level, Owner, Share, ShareId, Source},
    key::Key,
    node::NodeId,
    refusal::MAX_SHARES,
    value::{Held, Value},
};

/// Numbers that differ by a smaller share are the same, and so are functions.
pub(super) const SAME: f32 = 0.1;
/// So are outlines of which a smaller share differs.
pub(super) const SAME_OUTLINE: f32 = 0.08;

/// Whether siblings agree on a value: what says where their tips are must be the nearer, for wood stands on them.
fn agrees(key: Key, a: &Held, b: &Held) -> bool {
    match (a.get(), b.get()) {
        (Value::Vector(a), Value::Vector(b)) => a.distance(*b) <= 0.25 * SAME.to_degrees(),
        (&Value::Scalar(a), &Value::Scalar(b)) if key == Key::Reach => {
            (a - b).abs() <= 0.25 * SAME * a.max(b)
        }
        _ => is_same(key, a, b),
    }
}

/// Whether two values are so near to each other that one can stand for the other.
pub(super) fn is_same(key: Key, a: &Held, b: &Held) -> bool {
    let near = |a: f32, b: f32, same: f32| (a - b).abs() <= same * a.abs().max(b.abs());
    match (a.get(), b.get()) {
        (&Value::Scalar(a), &Value::Scalar(b)) if matches!(key, Key::Orders | Key::Cut) => a == b,
        // All of a plant stands on its stem.
        (&Value::Scalar(a), &Value::Scalar(b)) if key == Key::Height => near(a, b, 0.1 * SAME),
        (&Value::Scalar(a), &Value::Scalar(b)) => near(a, b, SAME),
        (&Value::Span(a, b), &Value::Span(c, d)) => {
            (a - c).abs() <= 0.5 * SAME && (b - d).abs() <= 0.5 * SAME
        }
        (Value::Vector(a), Value::Vector(b)) if key == Key::Pull => a.distance(*b) <= SAME,
        (Value::Vector(a), Value::Vector(b)) => a.distance(*b) <= SAME.to_degrees(),
        (Value::Function(a), Value::Function(b)) => difference(a, b) <= SAME,
        (Value::Envelope(a), Value::Envelope(b)) => {
            a.tip == b.tip && outline::difference(a, b) <= SAME_OUTLINE
        }
        (Value::Curve(a), Value::Curve(b)) => {
            (0..=16u8).map(|step| f32::from(step) / 16.0).all(|t| a.at(t).distance(b.at(t)) <= 0.2 * SAME)
        }
        (a, b) => a == b,
    }
}

/// Values of branches of one order that agree become shared ones.
pub(super) fn share(graph: &mut Graph) {
    let mut kinds: BTreeMap<(u8, Key), Vec<(NodeId, Held)>> = BTreeMap::new();
    for (&owner, record) in &graph.records {
        let Owner::Node(node) = owner else { continue };
        for (&key, setting) in &record.settings {
            if let Source::Explicit(value) = &setting.source
                && node != NodeId::ROOT
            {
                kinds.entry((node.order(), key)).or_default().push((node, value.clone()));
            }
        }
    }
    for ((order, key), mut all) in kinds {
        let Some(level) = Level::new(order) else { continue };
        while !all.is_empty() && graph.shares.len() < MAX_SHARES {
            let value = all[0].1.clone();
            let (same, others): (Vec<_>, Vec<_>) =
                all.into_iter().partition(|(_, other)| agrees(key, &value, other));
            all = others;
            if same.len() < 2 {
                continue;
            }
            let id = ShareId(graph.shares.len() as u32 + 1);
            graph.shares.insert(id, Share { key, level, value });
            for (node, _) in same {
                let setting = graph.records.get_mut(&Owner::Node(node));
                if let Some(setting) = setting.and_then(|record| record.settings.get_mut(&key)) {
                    setting.source = Source::Shared(id);
                }
            }
        }
    }
}
