//! The graph: what somebody said of branches. Where nothing was said, a branch inherits.

use std::{collections::BTreeMap, fmt};

use espalier_reading::NotAllowed;

use crate::{
    key::Key,
    node::{MAX_ORDER, NodeId},
    slots::Slot,
    value::{Held, Op},
};

/// What was said of one plant. It is sparse: branches of which nothing was said are not in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    /// What chance is keyed by.
    pub(crate) seed: u32,
    pub(crate) records: BTreeMap<Owner, Record>,
    pub(crate) shares: BTreeMap<ShareId, Share>,
    /// Laterals of branches of which at least one is personal; those of others follow from their number.
    pub(crate) slots: BTreeMap<NodeId, Vec<Slot>>,
}

/// Who has a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Owner {
    /// All branches of an order that say nothing else themselves.
    Level(Level),
    /// One branch.
    Node(NodeId),
}

/// An order of branching, from limbs (1) to the last (4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Level(u8);

/// The number of a value that several branches share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ShareId(pub u32);

/// What an owner says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Of parameters.
    pub settings: BTreeMap<Key, Setting>,
    /// What it is called.
    pub name: Option<Name>,
}

/// What an owner says of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Where its value comes from.
    pub source: Source,
    /// Who may inherit it.
    pub visibility: Visibility,
    /// Where it inherits from, if it does.
    pub from: From,
}

/// Where a value comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// It is said.
    Explicit(Held),
    /// It is said for several branches at once.
    Shared(ShareId),
    /// It is said relative to the inherited one.
    Relative(Op, Held),
    /// It is inherited.
    Inherited,
}

/// Who may inherit a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Visibility {
    /// Whoever stands above.
    #[default]
    Public,
    /// Nobody: those above inherit from farther below.
    Private,
}

/// Where a branch inherits from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum From {
    /// The branch that bears it.
    #[default]
    Bearer,
    /// The next branch beneath it on the same axis, and the bearer only for the lowest one.
    Below,
}

/// A value that branches of one order share.
#[derive(Clone, Debug, PartialEq)]
pub struct Share {
    /// Of which parameter.
    pub key: Key,
    /// Of which order.
    pub level: Level,
    /// The value.
    pub value: Held,
}

/// A name that somebody gave a branch: 1 to 64 characters without control characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(String);

impl Level {
    /// An order from 1 to 4.
    pub fn new(order: u8) -> Option<Self> {
        (1..=MAX_ORDER).contains(&order).then_some(Self(order))
    }

    /// The order.
    pub fn order(self) -> u8 {
        self.0
    }
}

impl Name {
    /// Most characters of a name.
    pub const LONGEST: usize = 64;

    /// A name.
    ///
    /// # Errors
    /// Where the text is empty, too long, or holds control characters.
    pub fn new(text: &str) -> Result<Self, NotAllowed> {
        let is_name =
            (1..=Self::LONGEST).contains(&text.chars().count()) && !text.chars().any(char::is_control);
        if is_name {
            Ok(Self(text.to_owned()))
        } else {
            Err(NotAllowed::new(format!("`{text}`"), "1 to 64 characters without control characters"))
        }
    }

    /// The name as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl Setting {
    /// A value of one's own, which others may inherit.
    pub fn own(value: Held) -> Self {
        Source::Explicit(value).into()
    }

    /// The same, kept from those above.
    pub fn private(self) -> Self {
        Self { visibility: Visibility::Private, ..self }
    }

    /// The same, inherited from beneath on the same axis.
    pub fn from_below(self) -> Self {
        Self { from: From::Below, ..self }
    }
}

impl std::convert::From<Source> for Setting {
    fn from(source: Source) -> Self {
        Self { source, visibility: Visibility::Public, from: From::Bearer }
    }
}

impl Record {
    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.settings.is_empty() && self.name.is_none()
    }
}

impl fmt::Display for Owner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Level(Level(order)) => write!(f, "level {order}"),
            Self::Node(node) => node.fmt(f),
        }
    }
}

impl Graph {
    /// What chance is keyed by.
    pub fn seed(&self) -> u32 {
        self.seed
    }

    /// All records in order: those of levels, then those of branches, bearers first.
    pub fn records(&self) -> impl Iterator<Item = (Owner, &Record)> {
        self.records.iter().map(|(&owner, record)| (owner, record))
    }

    /// What an owner says.
    pub fn record(&self, owner: Owner) -> Option<&Record> {
        self.records.get(&owner)
    }

    /// All shared values.
    pub fn shares(&self) -> impl Iterator<Item = (ShareId, &Share)> {
        self.shares.iter().map(|(&id, share)| (id, share))
    }

    /// A shared value.
    pub fn share(&self, id: ShareId) -> Option<&Share> {
        self.shares.get(&id)
    }

    /// The branches that share a value, in order.
    pub fn members(&self, id: ShareId) -> impl Iterator<Item = NodeId> {
        self.records.iter().filter_map(move |(&owner, record)| {
            let Owner::Node(node) = owner else { return None };
            let is_member = |setting: &Setting| setting.source == Source::Shared(id);
            record.settings.values().any(is_member).then_some(node)
        })
    }

    /// The laterals of a branch of which at least one is personal, those that sleep included.
    pub fn slots(&self, bearer: NodeId) -> Option<&[Slot]> {
        self.slots.get(&bearer).map(Vec::as_slice)
    }

    /// Values that were said.
    pub fn values(&self) -> usize {
        self.records.values().map(|record| record.settings.len()).sum()
    }

    /// What a branch says of a parameter itself, or its level says for it, and which of the two.
    pub fn setting(&self, node: NodeId, key: Key) -> Option<(Owner, &Setting)> {
        let level = Level::new(node.order()).map(Owner::Level);
        [Some(Owner::Node(node)), level]
            .into_iter()
            .flatten()
            .find_map(|owner| Some((owner, self.records.get(&owner)?.settings.get(&key)?)))
    }

    /// All that a branch says itself, or its level says for it.
    pub(crate) fn said(&self, node: NodeId) -> impl Iterator<Item = (Key, &Setting)> {
        let own = self.records.get(&Owner::Node(node));
        let level = Level::new(node.order()).and_then(|level| self.records.get(&Owner::Level(level)));
        let is_own = move |key: &Key| own.is_some_and(|own| own.settings.contains_key(key));
        let of_level =
            level.into_iter().flat_map(|level| &level.settings).filter(move |(key, _)| !is_own(key));
        own.into_iter().flat_map(|own| &own.settings).chain(of_level).map(|(&key, setting)| (key, setting))
    }

    /// Whether something was said of a branch or of what it bears, so that it must not be lost.
    pub fn is_personal(&self, node: NodeId) -> bool {
        let (from, to) = (*node.subtree().start(), *node.subtree().end());
        let is_anchored = || {
            let (bearer, ordinal) = node.bearer()?;
            let slot = self.slots.get(&bearer)?.iter().find(|slot| slot.ordinal == ordinal)?;
            slot.anchor
        };
        self.records.range(Owner::Node(from)..=Owner::Node(to)).next().is_some()
            || self.slots.range(from..=to).next().is_some()
            || is_anchored().is_some()
    }
}
