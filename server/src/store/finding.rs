//! What trees are found by: collections, tags, favourites, and what a list asks for.

use std::{collections::BTreeSet, ops::RangeInclusive};

use super::{StoreError, StoredTree};

/// Keeps what trees are found by. Where there is no such tree or collection it is [`StoreError::NotFound`].
pub trait Finding {
    /// All collections, by name.
    async fn collections(&self) -> Result<Vec<Collection>, StoreError>;

    /// Makes a collection.
    async fn add_collection(&self, new: Collection) -> Result<(), StoreError>;

    /// Changes one. It never comes to lie in itself: that is [`StoreError::Cycle`].
    async fn change_collection(&self, id: &str, change: CollectionChange) -> Result<(), StoreError>;

    /// Deletes one; what lies in it lies in its parent then.
    async fn delete_collection(&self, id: &str) -> Result<(), StoreError>;

    /// All tags that trees have, with how many have them.
    async fn tags(&self) -> Result<Vec<(String, u32)>, StoreError>;

    /// All who saved a tree last and said their name, with how many trees they did.
    async fn authors(&self) -> Result<Vec<(String, u32)>, StoreError>;

    /// The trees that somebody likes best.
    async fn favourites(&self, principal: &str) -> Result<BTreeSet<String>, StoreError>;

    /// Adds a tree to those, or takes it out.
    async fn set_favourite(&self, principal: &str, tree: &str, is_one: bool) -> Result<(), StoreError>;
}

/// A folder of trees and other collections.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Collection {
    /// Its identifier, made by the caller.
    pub id: String,
    /// Its name.
    pub name: String,
    /// The collection it lies in.
    pub parent: Option<String>,
    /// How many trees lie in it itself; nothing to say where it is made.
    pub trees: u32,
}

/// What of a collection is to be changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CollectionChange {
    /// Its name.
    pub name: Option<String>,
    /// The collection it lies in, or none.
    pub parent: Option<Option<String>>,
}

/// Which trees are wanted; all conditions hold at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreeQuery {
    /// Those that were deleted, or those that were not.
    pub is_deleted: bool,
    /// Those that are templates, or those that are not.
    pub is_template: Option<bool>,
    /// What names, tags, notes and species have, each anywhere in one of them; of a word with bars, any part of it.
    pub words: Vec<String>,
    /// Tags they have.
    pub tags: Vec<String>,
    /// Those that lie in this collection itself, or in none.
    pub collection: Option<Option<String>>,
    /// Those that somebody likes best.
    pub favourites_of: Option<String>,
    /// This one alone.
    pub only: Option<String>,
    /// Those that this person was given, or that were handed over to them.
    pub seen_by: Option<String>,
    /// The short name of their species.
    pub species: Option<String>,
    /// How whoever saved them last wanted to be called.
    pub author: Option<String>,
    /// Who saved them last.
    pub saved_by: Option<String>,
    /// Living metamers.
    pub metamers: RangeInclusive<u32>,
    /// Saved at this time or later.
    pub saved_from: Option<String>,
    /// Saved before this time.
    pub saved_before: Option<String>,
    /// Their order; those that were deleted are in order of when they were, the last first.
    pub sort: Sort,
    /// So many at most.
    pub limit: u32,
    /// Those behind this place, where a tree was that may be gone by now.
    pub after: Option<TreePlace>,
}

impl Default for TreeQuery {
    fn default() -> Self {
        Self {
            is_deleted: false,
            is_template: None,
            words: Vec::new(),
            tags: Vec::new(),
            collection: None,
            favourites_of: None,
            only: None,
            seen_by: None,
            species: None,
            author: None,
            saved_by: None,
            metamers: 0..=u32::MAX,
            saved_from: None,
            saved_before: None,
            sort: Sort::Newest,
            limit: u32::MAX,
            after: None,
        }
    }
}

/// An order of trees; those that are equal are in order of their identifiers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sort {
    /// The one saved last first.
    #[default]
    Newest,
    /// The one saved last last.
    Oldest,
    /// By name.
    Name,
    /// The one with the most metamers first.
    Largest,
    /// The one with the fewest metamers first.
    Smallest,
}

impl Sort {
    /// Whether small values come first.
    pub(super) fn is_ascending(self) -> bool {
        matches!(self, Self::Oldest | Self::Name | Self::Smallest)
    }
}

/// A tree's place in a list.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TreePlace {
    /// What the list goes by, so that texts are in the order of what they mean.
    pub value: String,
    /// The tree's identifier.
    pub id: String,
}

impl TreeQuery {
    /// The place of a tree in this list.
    pub fn place_of(&self, tree: &StoredTree) -> TreePlace {
        let value = match (self.is_deleted, self.sort) {
            (true, _) => tree.deleted_at.clone().unwrap_or_default(),
            (false, Sort::Newest | Sort::Oldest) => tree.head.saved_at.clone(),
            (false, Sort::Name) => super::folding::folded(&tree.name),
            (false, Sort::Largest | Sort::Smallest) => format!("{:010}", tree.head.metamers),
        };
        TreePlace { value, id: tree.id.clone() }
    }

    /// Whether small values come first.
    pub(super) fn is_ascending(&self) -> bool {
        !self.is_deleted && self.sort.is_ascending()
    }
}
