//! The values of all parameters of a branch.

use std::sync::Arc;

use espalier_plant::hash::StableHash;
use glam::Vec3;

use crate::{
    curve::Curve,
    envelope::Envelope,
    function::Function,
    graph::{From, Graph, Source, Visibility},
    key::{COUNT, Key},
    node::NodeId,
    value::{Held, Material, Value, combined},
};

/// A value for each parameter.
#[derive(Clone, Debug)]
pub struct Table {
    values: [Held; COUNT],
    hash: u64,
}

impl PartialEq for Table {
    fn eq(&self, other: &Self) -> bool {
        self.hash == other.hash && self.values == other.values
    }
}

impl Default for Table {
    /// The values of a plant of which nothing was said.
    fn default() -> Self {
        Self::new(std::array::from_fn(|at| crate::key::ROWS[at].key.default().clone()))
    }
}

macro_rules! read {
    ($(#[doc = $about:literal] $name:ident: $variant:ident -> $type:ty;)+) => { $(
        #[doc = $about]
        ///
        /// # Panics
        /// Where the parameter is of another kind.
        pub fn $name(&self, key: Key) -> $type {
            match self.value(key).get() {
                Value::$variant(value) => value,
                _ => unreachable!("{key} is of another kind"),
            }
        }
    )+ };
}

impl Table {
    fn new(values: [Held; COUNT]) -> Self {
        let mut hash = StableHash::default();
        values.iter().for_each(|value| hash.word(value.hash()));
        Self { values, hash: hash.finish() }
    }

    /// The value of a parameter.
    pub fn value(&self, key: Key) -> &Held {
        &self.values[key as usize]
    }

    /// A hash of all values.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    read! {
        /// A number.
        scalar_ref: Scalar -> &f32;
        /// A vector.
        vector_ref: Vector -> &Vec3;
        /// A function.
        function: Function -> &Function;
        /// A curve.
        curve: Curve -> &Curve;
        /// An envelope.
        envelope: Envelope -> &Envelope;
        /// A material.
        material: Material -> &Material;
    }

    /// A number.
    ///
    /// # Panics
    /// Where the parameter is of another kind.
    pub fn scalar(&self, key: Key) -> f32 {
        *self.scalar_ref(key)
    }

    /// A vector.
    ///
    /// # Panics
    /// Where the parameter is of another kind.
    pub fn vector(&self, key: Key) -> Vec3 {
        *self.vector_ref(key)
    }

    /// First and last.
    ///
    /// # Panics
    /// Where the parameter is of another kind.
    pub fn span(&self, key: Key) -> (f32, f32) {
        match self.value(key).get() {
            &Value::Span(first, last) => (first, last),
            _ => unreachable!("{key} is of another kind"),
        }
    }
}

/// What a branch has, and what those who inherit from it get.
#[derive(Clone, Debug)]
pub(crate) struct Tables {
    pub mine: Arc<Table>,
    pub pass: Arc<Table>,
    /// What the next branch above on the same axis gets, if it asks for it.
    pub along: Arc<Table>,
}

/// The tables of a branch, from what its bearer passes on and what comes from beneath on the same axis.
pub(crate) fn tables(graph: &Graph, node: NodeId, bearer: &Arc<Table>, along: &Arc<Table>) -> Tables {
    let mut said = graph.said(node).peekable();
    if said.peek().is_none() {
        return Tables { mine: bearer.clone(), pass: bearer.clone(), along: bearer.clone() };
    }
    let (mut mine, mut pass, mut next) =
        (bearer.values.clone(), bearer.values.clone(), bearer.values.clone());
    for (key, setting) in said {
        let at = key as usize;
        let inherited = match setting.from {
            From::Bearer => &bearer.values[at],
            From::Below => &along.values[at],
        };
        let value = match &setting.source {
            Source::Explicit(value) => value.clone(),
            Source::Shared(share) => match graph.share(*share) {
                Some(share) => share.value.clone(),
                None => inherited.clone(),
            },
            Source::Relative(op, with) => {
                combined(inherited, *op, with, key.row().range).unwrap_or_else(|| inherited.clone())
            }
            Source::Inherited => inherited.clone(),
        };
        match setting.visibility {
            Visibility::Public => {
                pass[at] = value.clone();
                next[at] = value.clone();
            }
            Visibility::Private => next[at] = along.values[at].clone(),
        }
        mine[at] = value;
    }
    let mine = Arc::new(Table::new(mine));
    let same = |values: &[Held; COUNT]| *values == mine.values;
    let pass = if same(&pass) { mine.clone() } else { Arc::new(Table::new(pass)) };
    let along = if same(&next) { mine.clone() } else { Arc::new(Table::new(next)) };
    Tables { mine, pass, along }
}
