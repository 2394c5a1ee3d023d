//! What can be done to a design.

use crate::{
    graph::{Graph, Level, Name, Owner, Record, Setting, Share, ShareId, Source, Visibility},
    key::Key,
    node::NodeId,
    patch::Patch,
    refusal::{MAX_SHARES, MAX_VALUES, Place, Refusal},
    resolution::Branch,
    slots::Slot,
    value::{Held, Kind, check},
};

/// An edit of a design. Each is done as a whole or refused, and each can be undone by the patch that it leaves.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Say something of a parameter.
    Set {
        /// Who says it.
        owner: Owner,
        /// The parameter.
        key: Key,
        /// What is said.
        setting: Setting,
    },
    /// Say nothing of a parameter any more, so that it is inherited.
    Clear {
        /// Who said it.
        owner: Owner,
        /// The parameter.
        key: Key,
    },
    /// Name a branch, or take its name away.
    Name {
        /// The branch.
        node: NodeId,
        /// Its name.
        name: Option<Name>,
    },
    /// Give branches of one order a value that they share.
    Share {
        /// The new number of the value.
        share: ShareId,
        /// The parameter.
        key: Key,
        /// The value.
        value: Held,
        /// Who shares it.
        members: Vec<NodeId>,
    },
    /// Change a shared value.
    SetShared {
        /// Which.
        share: ShareId,
        /// The value.
        value: Held,
    },
    /// Let a lateral stand at a place of its bearer whatever stands beside it, or let it go.
    Anchor {
        /// The lateral.
        node: NodeId,
        /// The share of the axis below it.
        at: Option<f32>,
    },
    /// Forget all that was said of a branch and of what it bears.
    Forget {
        /// The branch.
        node: NodeId,
    },
    /// Say of a branch and of what it bears what is said of another.
    Copy {
        /// Which one.
        from: NodeId,
        /// To which one.
        to: NodeId,
    },
    /// Key chance otherwise.
    Seed {
        /// The key.
        seed: u32,
    },
    /// Do several, one after another, or none.
    Batch(Vec<Edit>),
}

/// How a branch stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It has a place.
    Awake,
    /// It, or the branch named, has none.
    Asleep(NodeId),
    /// It is not known.
    Unknown,
}

/// How a branch of a graph stands in the tree of its branches.
pub(crate) fn standing(graph: &Graph, root: &Branch, node: NodeId) -> Standing {
    if root.find(node).is_some() {
        return Standing::Awake;
    }
    for asleep in node.path() {
        let Some((bearer, ordinal)) = asleep.bearer() else { continue };
        let mut slots = graph.slots.get(&bearer).into_iter().flatten();
        let is_known = |slot: &Slot| slot.ordinal == ordinal && slot.place.is_none();
        if slots.any(is_known) {
            return Standing::Asleep(asleep);
        }
    }
    Standing::Unknown
}

/// One edit on its way into a graph.
pub(crate) struct Writing<'a> {
    pub graph: &'a mut Graph,
    pub root: &'a Branch,
    /// What was there before.
    pub undo: &'a mut Patch,
}

impl Writing<'_> {
    /// Does an edit that is no batch.
    pub(crate) fn write(&mut self, edit: &Edit) -> Result<(), Refusal> {
        match edit {
            Edit::Set { owner, key, setting } => self.set(*owner, *key, setting),
            Edit::Clear { owner, key } => self.clear(*owner, *key),
            Edit::Name { node, name } => self.name(*node, name.as_ref()),
            Edit::Share { share, key, value, members } => self.share(*share, *key, value, members),
            Edit::SetShared { share, value } => self.set_shared(*share, value),
            Edit::Anchor { node, at } => self.anchor(*node, *at),
            Edit::Forget { node } => self.forget(*node),
            Edit::Copy { from, to } => self.copy(*from, *to),
            Edit::Seed { seed } => {
                self.undo.seed.get_or_insert(self.graph.seed);
                self.graph.seed = *seed;
                Ok(())
            }
            Edit::Batch(_) => unreachable!("a batch is done edit by edit"),
        }
    }

    fn set(&mut self, owner: Owner, key: Key, setting: &Setting) -> Result<(), Refusal> {
        self.check_awake(owner)?;
        check_setting(owner, key, setting)?;
        if let Source::Shared(share) = setting.source {
            self.check_member(owner, key, share)?;
        }
        if let Owner::Node(node) = owner {
            self.personalise(node);
        }
        self.put(owner, key, Some(setting.clone()));
        self.check_size()
    }

    fn clear(&mut self, owner: Owner, key: Key) -> Result<(), Refusal> {
        self.check_known(owner)?;
        self.put(owner, key, None);
        if let Owner::Node(node) = owner {
            self.settle(node);
        }
        Ok(())
    }

    fn name(&mut self, node: NodeId, name: Option<&Name>) -> Result<(), Refusal> {
        self.check_known(Owner::Node(node))?;
        if name.is_some() {
            self.check_awake(Owner::Node(node))?;
            self.personalise(node);
        }
        self.change(Owner::Node(node), |record| record.name = name.cloned());
        self.settle(node);
        Ok(())
    }

    fn share(&mut self, id: ShareId, key: Key, value: &Held, members: &[NodeId]) -> Result<(), Refusal> {
        if self.graph.shares.contains_key(&id) {
            return Err(Refusal::ShareTaken(id));
        }
        if self.graph.shares.len() >= MAX_SHARES {
            return Err(Refusal::TooManyShares);
        }
        check_value(Place::Share(id), key, value)?;
        let order = members.first().ok_or(Refusal::NobodyShares)?.order();
        let level = Level::new(order).ok_or(Refusal::NothingToInherit(key))?;
        self.undo.shares.entry(id).or_insert(None);
        self.graph.shares.insert(id, Share { key, level, value: value.clone() });
        for &node in members {
            self.set(Owner::Node(node), key, &Source::Shared(id).into())?;
        }
        Ok(())
    }

    fn set_shared(&mut self, id: ShareId, value: &Held) -> Result<(), Refusal> {
        let share = self.graph.shares.get_mut(&id).ok_or(Refusal::NoShare(id))?;
        check_value(Place::Share(id), share.key, value)?;
        let before = share.clone();
        share.value = value.clone();
        self.undo.shares.entry(id).or_insert(Some(before));
        Ok(())
    }

    fn anchor(&mut self, node: NodeId, at: Option<f32>) -> Result<(), Refusal> {
        let (bearer, ordinal) = node.bearer().ok_or(Refusal::RootIsNoLateral)?;
        if let Some(at) = at.filter(|at| !(0.0..=1.0).contains(at)) {
            return Err(Refusal::OffAxis(at.to_string()));
        }
        self.check_awake(Owner::Node(node))?;
        self.personalise(node);
        let home = at.and_then(|at| Some(self.root.find(bearer)?.places().share_at(at)));
        self.change_slot(bearer, ordinal, |slot| {
            slot.anchor = at;
            slot.home = home.unwrap_or(slot.home);
        });
        self.settle(node);
        Ok(())
    }

    fn forget(&mut self, node: NodeId) -> Result<(), Refusal> {
        self.check_known(Owner::Node(node))?;
        self.empty(node);
        if let Some((bearer, ordinal)) = node.bearer() {
            self.change_slot(bearer, ordinal, |slot| slot.anchor = None);
        }
        self.settle(node);
        Ok(())
    }

    fn copy(&mut self, from: NodeId, to: NodeId) -> Result<(), Refusal> {
        if from.holds(to) || to.holds(from) {
            return Err(Refusal::IntoItself { from, to });
        }
        self.check_known(Owner::Node(from))?;
        self.check_awake(Owner::Node(to))?;
        let moved = |node: NodeId| node.moved(from, to).ok_or(Refusal::TooHigh { from, to });
        let within = Owner::Node(*from.subtree().start())..=Owner::Node(*from.subtree().end());
        let mut records = Vec::new();
        for (&owner, record) in self.graph.records.range(within) {
            let Owner::Node(node) = owner else { continue };
            records.push((Owner::Node(moved(node)?), self.unshared(record, from.order() != to.order())));
        }
        let mut slots = Vec::new();
        for (&bearer, list) in self.graph.slots.range(from.subtree()) {
            slots.push((moved(bearer)?, list.clone()));
        }
        self.personalise(to);
        self.empty(to);
        for (owner, record) in records {
            self.replace(owner, Some(record));
        }
        for (bearer, list) in slots {
            self.undo.note_slots(self.graph, bearer);
            self.graph.slots.insert(bearer, list);
        }
        self.settle(to);
        self.check_size()
    }

    /// A record whose shared values are its own, where it changes its order.
    fn unshared(&self, record: &Record, changes_order: bool) -> Record {
        let mut record = record.clone();
        for setting in record.settings.values_mut().filter(|_| changes_order) {
            if let Source::Shared(share) = setting.source
                && let Some(share) = self.graph.share(share)
            {
                setting.source = Source::Explicit(share.value.clone());
            }
        }
        record
    }

    /// Takes away all records and slots of a branch and of what it bears.
    fn empty(&mut self, node: NodeId) {
        let within = Owner::Node(*node.subtree().start())..=Owner::Node(*node.subtree().end());
        let owners: Vec<_> = self.graph.records.range(within).map(|(&owner, _)| owner).collect();
        owners.into_iter().for_each(|owner| self.replace(owner, None));
        let bearers: Vec<_> = self.graph.slots.range(node.subtree()).map(|(&bearer, _)| bearer).collect();
        for bearer in bearers {
            self.undo.note_slots(self.graph, bearer);
            self.graph.slots.remove(&bearer);
        }
    }

    /// Gives a branch and those on the way to it slots of their own, so that what is said of it is not lost.
    fn personalise(&mut self, node: NodeId) {
        for child in node.path() {
            let Some((bearer, ordinal)) = child.bearer() else { continue };
            let stands = self.root.find(bearer);
            if !self.graph.slots.contains_key(&bearer)
                && let Some(stands) = stands
            {
                self.undo.note_slots(self.graph, bearer);
                self.graph.slots.insert(bearer, stands.implied_slots());
            }
            let azimuth = self.root.find(child).map(Branch::azimuth);
            self.change_slot(bearer, ordinal, |slot| slot.azimuth = slot.azimuth.or(azimuth));
        }
    }

    /// Takes slots away that nobody needs any more.
    fn settle(&mut self, node: NodeId) {
        let mut next = node.bearer();
        let mut child = node;
        while let Some((bearer, ordinal)) = next {
            if !self.graph.is_personal(child) {
                self.change_slot(bearer, ordinal, |slot| slot.azimuth = None);
            }
            if let Some(slots) = self.graph.slots.get(&bearer) {
                let is_kept = |slot: &Slot| {
                    let child = bearer.child(slot.ordinal);
                    slot.place.is_some() || child.is_some_and(|child| self.graph.is_personal(child))
                };
                let is_needed = |slot: &Slot| {
                    bearer.child(slot.ordinal).is_some_and(|child| self.graph.is_personal(child))
                };
                let kept: Vec<Slot> = slots.iter().copied().filter(is_kept).collect();
                let kept = slots.iter().any(is_needed).then_some(kept);
                if kept.as_ref() != Some(slots) {
                    self.undo.note_slots(self.graph, bearer);
                    match kept {
                        Some(kept) => self.graph.slots.insert(bearer, kept),
                        None => self.graph.slots.remove(&bearer),
                    };
                }
            }
            (child, next) = (bearer, bearer.bearer());
        }
    }

    fn change_slot(&mut self, bearer: NodeId, ordinal: u16, change: impl FnOnce(&mut Slot)) {
        let Some(slots) = self.graph.slots.get(&bearer) else { return };
        let Some(at) = slots.iter().position(|slot| slot.ordinal == ordinal) else { return };
        let mut slot = slots[at];
        change(&mut slot);
        if slot != slots[at] {
            self.undo.note_slots(self.graph, bearer);
            if let Some(slots) = self.graph.slots.get_mut(&bearer) {
                slots[at] = slot;
            }
        }
    }

    fn put(&mut self, owner: Owner, key: Key, setting: Option<Setting>) {
        self.change(owner, |record| {
            match setting {
                Some(setting) => record.settings.insert(key, setting),
                None => record.settings.remove(&key),
            };
        });
    }

    fn change(&mut self, owner: Owner, change: impl FnOnce(&mut Record)) {
        let mut record = self.graph.records.get(&owner).cloned().unwrap_or_default();
        change(&mut record);
        self.replace(owner, Some(record).filter(|record| !record.is_empty()));
    }

    /// Puts another record in place; shares that nobody shares any more go.
    fn replace(&mut self, owner: Owner, record: Option<Record>) {
        let before = match record {
            Some(record) => self.graph.records.insert(owner, record),
            None => self.graph.records.remove(&owner),
        };
        let left: Vec<ShareId> =
            before.iter().flat_map(|record| record.settings.values()).filter_map(shared).collect();
        self.undo.records.entry(owner).or_insert(before);
        for share in left {
            if self.graph.members(share).next().is_none() {
                let before = self.graph.shares.remove(&share);
                self.undo.shares.entry(share).or_insert(before);
            }
        }
    }

    fn check_awake(&self, owner: Owner) -> Result<(), Refusal> {
        match owner {
            Owner::Level(_) => Ok(()),
            Owner::Node(node) => match standing(self.graph, self.root, node) {
                Standing::Awake => Ok(()),
                Standing::Asleep(asleep) => Err(Refusal::Asleep(asleep)),
                Standing::Unknown => Err(Refusal::Unknown(node)),
            },
        }
    }

    /// What sleeps can still be forgotten.
    fn check_known(&self, owner: Owner) -> Result<(), Refusal> {
        match self.check_awake(owner) {
            Err(Refusal::Asleep(_)) => Ok(()),
            checked => checked,
        }
    }

    fn check_member(&self, owner: Owner, key: Key, id: ShareId) -> Result<(), Refusal> {
        let share = self.graph.share(id).ok_or(Refusal::NoShare(id))?;
        let is_of = matches!(owner, Owner::Node(node) if node.order() == share.level.order());
        if is_of && share.key == key {
            return Ok(());
        }
        Err(Refusal::NotOfShare { node: owner, share: id, key: share.key, order: share.level.order() })
    }

    fn check_size(&self) -> Result<(), Refusal> {
        let found = self.graph.values();
        if found > MAX_VALUES { Err(Refusal::TooManyValues { found }) } else { Ok(()) }
    }
}

fn shared(setting: &Setting) -> Option<ShareId> {
    match setting.source {
        Source::Shared(share) => Some(share),
        _ => None,
    }
}

/// Checks what does not depend on anything else of a graph.
pub(crate) fn check_setting(owner: Owner, key: Key, setting: &Setting) -> Result<(), Refusal> {
    let row = key.row();
    let is_root = owner == Owner::Node(NodeId::ROOT);
    if row.is_of_root && !is_root {
        return Err(Refusal::OfRootOnly { owner, key });
    }
    if is_root && !matches!(setting.source, Source::Explicit(_)) {
        return Err(Refusal::NothingToInherit(key));
    }
    if is_root && setting.visibility == Visibility::Private {
        return Err(Refusal::RootIsPublic(key));
    }
    match &setting.source {
        Source::Explicit(value) => check_value(Place::Owner(owner), key, value),
        Source::Relative(..) if !row.kind.is_relative() => Err(Refusal::NotRelative(key)),
        Source::Relative(op, value) => {
            let refused = |fault| Refusal::NotAllowed { owner: Place::Owner(owner), key, fault };
            check(value.get(), row.kind, relative_range(*op, row.range)).map_err(refused)
        }
        Source::Shared(_) | Source::Inherited => Ok(()),
    }
}

/// How far a relative value may go: what leads from one end of the range to the other, or a tenfold.
pub fn relative_range(op: crate::value::Op, (least, most): (f32, f32)) -> (f32, f32) {
    match op {
        crate::value::Op::Add => (least - most, most - least),
        crate::value::Op::Multiply => (0.0, 10.0),
    }
}

pub(crate) fn check_value(owner: Place, key: Key, value: &Held) -> Result<(), Refusal> {
    let row = key.row();
    let kind: Kind = row.kind;
    check(value.get(), kind, row.range).map_err(|fault| Refusal::NotAllowed { owner, key, fault })
}
