//! What is given to users and groups, in the model.

use std::collections::BTreeSet;

use espalier_proto::access::Role;

use super::{
    super::{Gift, Gifts, Given, Missing, Receiver, Room, StoreError, folding::folded, gifts::user_of},
    Kept, MemoryStore,
};

/// A gift as it is kept: users and groups by their identifiers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct KeptGift {
    tree: Option<String>,
    collection: Option<String>,
    is_group: bool,
    to: String,
    role: Role,
}

impl KeptGift {
    pub(super) fn is_to_user(&self, id: &str) -> bool {
        !self.is_group && self.to == id
    }

    pub(super) fn is_to_group(&self, id: &str) -> bool {
        self.is_group && self.to == id
    }

    pub(super) fn is_collection(&self, id: &str) -> bool {
        self.collection.as_deref() == Some(id)
    }

    pub(super) fn is_tree(&self, id: &str) -> bool {
        self.tree.as_deref() == Some(id)
    }
}

impl Gifts for MemoryStore {
    async fn give(&self, what: Gift<'_>, to: &Receiver, role: Role) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let gift = kept.gift(what, to, role)?;
        kept.gifts.retain(|other| !is_same(other, &gift));
        kept.gifts.push(gift);
        Ok(())
    }

    async fn take_back(&self, what: Gift<'_>, from: &str) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let (tree, collection) = kept.what(what)?;
        let before = kept.gifts.len();
        let is_it =
            |gift: &KeptGift| (&gift.tree, &gift.collection) == (&tree, &collection) && gift.to == from;
        kept.gifts.retain(|gift| !is_it(gift));
        Ok(kept.gifts.len() < before)
    }

    async fn given(&self, what: Gift<'_>) -> Result<Vec<Given>, StoreError> {
        let kept = self.kept();
        let is_it = |gift: &&KeptGift| match what {
            Gift::Tree(id) => gift.tree.as_deref() == Some(id),
            Gift::Collection(id) => gift.collection.as_deref() == Some(id),
        };
        let described = |gift: &KeptGift| {
            let to = if gift.is_group {
                Receiver::Group(kept.groups.values().find(|group| group.id == gift.to)?.name.clone())
            } else {
                Receiver::User(kept.users.values().find(|user| user.id == gift.to)?.name.clone())
            };
            Some(Given { id: gift.to.clone(), to, role: gift.role })
        };
        let mut all: Vec<Given> = kept.gifts.iter().filter(is_it).filter_map(described).collect();
        all.sort_by_key(|given| (matches!(given.to, Receiver::User(_)), folded(given.to.name())));
        Ok(all)
    }

    async fn role_given(&self, room: Room<'_>, person: &str) -> Result<Role, StoreError> {
        let kept = self.kept();
        let tree = match room {
            Room::Tree(id) => Some(id.to_owned()),
            Room::Session(name) => kept
                .sessions
                .get(name)
                .and_then(|session| session.tree.as_ref())
                .map(|(tree, _)| tree.clone()),
        };
        let Some(tree) = tree else { return Ok(Role::None) };
        let above = kept.trees.get(&tree).and_then(|tree| tree.collection.clone());
        Ok(kept.greatest(person, Some(&tree), above))
    }

    async fn role_in(&self, collection: &str, person: &str) -> Result<Role, StoreError> {
        Ok(self.kept().greatest(person, None, Some(collection.to_owned())))
    }

    async fn collections_of(&self, person: &str) -> Result<BTreeSet<String>, StoreError> {
        let kept = self.kept();
        let is_theirs = |id: &&String| kept.greatest(person, None, Some((*id).clone())) > Role::None;
        Ok(kept.collections.keys().filter(is_theirs).cloned().collect())
    }
}

fn is_same(one: &KeptGift, other: &KeptGift) -> bool {
    KeptGift { role: other.role, ..one.clone() } == *other
}

impl Kept {
    pub(super) fn forget_gifts(&mut self, goes: impl Fn(&KeptGift) -> bool) {
        self.gifts.retain(|gift| !goes(gift));
    }

    /// The tree or the collection that is given, which must be there.
    fn what(&self, what: Gift<'_>) -> Result<(Option<String>, Option<String>), StoreError> {
        match what {
            Gift::Tree(id) => {
                let tree = self.trees.get(id).filter(|tree| tree.deleted_at.is_none());
                tree.ok_or(StoreError::NotFound(Missing::Tree))?;
                Ok((Some(id.to_owned()), None))
            }
            Gift::Collection(id) => {
                self.collections.get(id).ok_or(StoreError::NotFound(Missing::Collection))?;
                Ok((None, Some(id.to_owned())))
            }
        }
    }

    fn gift(&self, what: Gift<'_>, to: &Receiver, role: Role) -> Result<KeptGift, StoreError> {
        let (tree, collection) = self.what(what)?;
        let (is_group, to) = match to {
            Receiver::User(name) => {
                let user = self.users.get(&folded(name)).ok_or(StoreError::NotFound(Missing::User))?;
                (false, user.id.clone())
            }
            Receiver::Group(name) => {
                let group = self.groups.get(&folded(name)).ok_or(StoreError::NotFound(Missing::Group))?;
                (true, group.id.clone())
            }
        };
        Ok(KeptGift { tree, collection, is_group, to, role })
    }

    /// The greatest role that somebody was given with a tree, or a collection or one above it.
    fn greatest(&self, person: &str, tree: Option<&str>, mut collection: Option<String>) -> Role {
        let Some(user) = user_of(person).and_then(|user| self.users.get(user)) else { return Role::None };
        let mut above = BTreeSet::new();
        while let Some(id) = collection {
            collection = self.collections.get(&id).and_then(|collection| collection.parent.clone());
            above.insert(id);
        }
        let is_theirs = |gift: &&KeptGift| match gift.is_group {
            false => gift.to == user.id,
            true => {
                let group = self.groups.values().find(|group| group.id == gift.to);
                group.is_some_and(|group| group.members.contains(&user.name))
            }
        };
        let is_here = |gift: &&KeptGift| {
            gift.tree.is_some() && gift.tree.as_deref() == tree
                || gift.collection.as_ref().is_some_and(|id| above.contains(id))
        };
        let there = self.gifts.iter().filter(is_theirs).filter(is_here);
        there.map(|gift| gift.role).max().unwrap_or(Role::None)
    }

    /// Whether somebody sees a tree who has no role on the server.
    pub(super) fn is_seen(&self, tree: &str, person: &str) -> bool {
        let collection = self.trees.get(tree).and_then(|tree| tree.collection.clone());
        self.greatest(person, Some(tree), collection) > Role::None
            || self.heirs.get(tree).is_some_and(|heir| heir.person == person)
    }
}
