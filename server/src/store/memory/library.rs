//! The library of the model.

use std::collections::BTreeMap;

use super::{
    super::{
        Contents, Deletion, LONG_AGO, Library, Missing, NewTree, NewVersion, Picture, Saved, SessionTree,
        StoreError, StoredTree, StoredVersion, TreeChange, TreeDocument, TreeQuery,
        folding::uncased,
        seal::{document_hash, tree_sum, version_sum},
    },
    Kept, MemoryStore, finding,
};

/// A tree as it is kept.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub(super) name: String,
    note: String,
    is_template: bool,
    pub(super) tags: Vec<String>,
    pub(super) collection: Option<String>,
    origin: Option<(String, u32)>,
    pub(super) deleted_at: Option<String>,
    pub(super) session: Option<String>,
    revision: u64,
    checksum: u32,
    /// In order of their numbers, from 1 on.
    pub(super) versions: Vec<Version>,
}

/// A version as it is kept.
#[derive(Clone, Debug)]
pub(super) struct Version {
    new: NewVersion,
    restored: Option<u32>,
    pub(super) saved: Saved,
    pub(super) hash: Vec<u8>,
    checksum: u32,
}

impl Tree {
    /// Who has saved each version.
    pub(super) fn savers(&mut self) -> impl Iterator<Item = &mut String> {
        self.versions.iter_mut().map(|version| &mut version.new.principal)
    }

    fn head(&self) -> u32 {
        self.versions.len() as u32
    }

    fn version(&self, number: u32) -> Option<&Version> {
        self.versions.get(number.checked_sub(1)? as usize)
    }

    fn stored_version(&self, number: u32) -> Option<StoredVersion> {
        let Version { new, restored, saved, .. } = self.version(number)?;
        Some(StoredVersion {
            number,
            saved_at: new.saved_at.clone(),
            author: new.author.clone(),
            note: new.note.clone(),
            metamers: saved.metamers,
            species: saved.species.clone(),
            restored: *restored,
        })
    }

    fn stored(&self, id: &str) -> StoredTree {
        let head = self.stored_version(self.head()).expect("a tree has a version");
        StoredTree {
            id: id.to_owned(),
            name: self.name.clone(),
            note: self.note.clone(),
            is_template: self.is_template,
            tags: self.tags.clone(),
            collection: self.collection.clone(),
            origin: self.origin.clone(),
            created_at: self.versions[0].new.saved_at.clone(),
            deleted_at: self.deleted_at.clone(),
            head,
            session: self.session.clone(),
            revision: self.revision,
        }
    }

    fn add(&mut self, id: &str, new: NewVersion, saved: Saved) {
        let is_whole = self.checksum == tree_sum(id, &self.name, self.head());
        let number = self.head() + 1;
        let hash = document_hash(&saved.document);
        let restored = match &new.contents {
            Contents::Of { tree, version } if tree == id => Some(*version),
            _ => None,
        };
        let checksum = version_sum(id, number, Some(&hash));
        if let Some((session, _)) = &new.session {
            self.session = Some(session.clone());
        }
        self.versions.push(Version { new, restored, saved, hash, checksum });
        self.revision += 1;
        if is_whole {
            self.checksum = tree_sum(id, &self.name, number);
        }
    }
}

impl Kept {
    /// A tree that is not deleted, at this revision.
    fn tree(&mut self, id: &str, expected: Option<u64>) -> Result<&mut Tree, StoreError> {
        let tree = self.trees.get_mut(id).ok_or(StoreError::NotFound(Missing::Tree))?;
        let is_expected = expected.is_none_or(|revision| revision == tree.revision);
        if is_expected { Ok(tree) } else { Err(StoreError::Stale) }
    }

    fn saved(&self, contents: &Contents) -> Result<Saved, StoreError> {
        match contents {
            Contents::New(saved) => Ok((**saved).clone()),
            Contents::Of { tree, version } => {
                let tree = self.trees.get(tree).filter(|tree| tree.deleted_at.is_none());
                let version = tree.ok_or(StoreError::NotFound(Missing::Tree))?.version(*version);
                version.map(|version| version.saved.clone()).ok_or(StoreError::NotFound(Missing::Version))
            }
        }
    }

    fn link(&mut self, session: Option<(String, u64)>, tree: &str, version: u32) {
        if let Some((name, through)) = session
            && let Some(session) = self.sessions.get_mut(&name)
        {
            (session.tree, session.saved_through) = (Some((tree.to_owned(), version)), through);
        }
    }
}

impl Library for MemoryStore {
    async fn add_tree(&self, tree: NewTree) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let NewTree { id, name, version } = tree;
        let saved = kept.saved(&version.contents)?;
        let origin = match &version.contents {
            Contents::Of { tree, version } => Some((tree.clone(), *version)),
            Contents::New(_) => None,
        };
        let mut tree = Tree {
            checksum: tree_sum(&id, &name, 0),
            name,
            note: String::new(),
            is_template: false,
            tags: Vec::new(),
            collection: None,
            origin,
            deleted_at: None,
            session: None,
            revision: 0,
            versions: Vec::new(),
        };
        let session = version.session.clone();
        tree.add(&id, version, saved);
        kept.link(session, &id, 1);
        kept.trees.insert(id, tree);
        Ok(())
    }

    async fn add_version(
        &self,
        tree: &str,
        expected: Option<u64>,
        version: NewVersion,
    ) -> Result<u32, StoreError> {
        let mut kept = self.writing()?;
        if kept.tree(tree, expected)?.deleted_at.is_some() {
            return Err(StoreError::NotFound(Missing::Tree));
        }
        let (saved, session) = (kept.saved(&version.contents)?, version.session.clone());
        let changed = kept.tree(tree, expected)?;
        changed.add(tree, version, saved);
        let number = changed.head();
        kept.link(session, tree, number);
        Ok(number)
    }

    async fn change_tree(
        &self,
        id: &str,
        expected: Option<u64>,
        change: TreeChange,
    ) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let is_known = |collection: &String| kept.collections.contains_key(collection);
        let has_collection = change.collection.iter().flatten().all(is_known);
        let others = kept.trees.iter().filter(|(other, _)| *other != id);
        let spellings: BTreeMap<String, String> =
            others.flat_map(|(_, tree)| &tree.tags).map(|tag| (uncased(tag), tag.clone())).collect();
        let tree = kept.tree(id, expected)?;
        let TreeChange { name, note, is_template, version_note, tags, collection, deletion } = change;
        match (tree.deleted_at.is_some(), deletion.as_ref().is_some_and(Deletion::is_of_deleted)) {
            (true, false) => return Err(StoreError::NotFound(Missing::Tree)),
            (false, true) => return Err(StoreError::NotDeleted),
            _ => {}
        }
        if !has_collection {
            return Err(StoreError::NotFound(Missing::Collection));
        }
        if let Some((number, note)) = version_note {
            let version = number.checked_sub(1).and_then(|at| tree.versions.get_mut(at as usize));
            version.ok_or(StoreError::NotFound(Missing::Version))?.new.note = note;
        }
        let is_whole = tree.checksum == tree_sum(id, &tree.name, tree.head());
        tree.name = name.unwrap_or_else(|| tree.name.clone());
        if is_whole {
            tree.checksum = tree_sum(id, &tree.name, tree.head());
        }
        tree.note = note.unwrap_or_else(|| tree.note.clone());
        tree.is_template = is_template.unwrap_or(tree.is_template);
        tree.collection = collection.unwrap_or_else(|| tree.collection.clone());
        if let Some(tags) = tags {
            let mut once = BTreeMap::new();
            for tag in tags {
                let spelt = spellings.get(&uncased(&tag)).cloned();
                once.entry(uncased(&tag)).or_insert(spelt.unwrap_or(tag));
            }
            tree.tags = once.into_values().collect();
            tree.tags.sort();
        }
        tree.deleted_at = match deletion {
            Some(Deletion::Deleted(at)) => Some(at),
            Some(Deletion::ForGood) => Some(LONG_AGO.into()),
            Some(Deletion::Undeleted) | None => None,
        };
        tree.revision += 1;
        Ok(())
    }

    async fn trees(&self, query: &TreeQuery) -> Result<Vec<StoredTree>, StoreError> {
        let kept = self.kept();
        let mut trees: Vec<StoredTree> = kept.trees.iter().map(|(id, tree)| tree.stored(id)).collect();
        trees.retain(|tree| {
            let by = kept.trees[&tree.id].versions.last().map_or("", |version| &version.new.principal);
            finding::is_wanted(tree, query, by, &kept.favourites)
                && query.seen_by.as_ref().is_none_or(|person| kept.is_seen(&tree.id, person))
        });
        trees.sort_by_key(|tree| query.place_of(tree));
        if !query.is_ascending() {
            trees.reverse();
        }
        let behind = |place| if query.is_ascending() { place } else { std::cmp::Ordering::reverse(place) };
        trees.retain(|tree| {
            query.after.as_ref().is_none_or(|after| behind(query.place_of(tree).cmp(after)).is_gt())
        });
        trees.truncate(query.limit as usize);
        Ok(trees)
    }

    async fn tree(&self, id: &str) -> Result<Option<StoredTree>, StoreError> {
        Ok(self.kept().trees.get(id).map(|tree| tree.stored(id)))
    }

    async fn versions(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredVersion>, StoreError> {
        let kept = self.kept();
        let Some(tree) = kept.trees.get(tree) else { return Ok(Vec::new()) };
        let numbers = (1..=tree.head()).rev().filter(|number| before.is_none_or(|before| *number < before));
        Ok(numbers.filter_map(|number| tree.stored_version(number)).take(limit as usize).collect())
    }

    async fn document(&self, id: &str, number: u32) -> Result<Option<TreeDocument>, StoreError> {
        let kept = self.kept();
        let Some(tree) = kept.trees.get(id) else { return Ok(None) };
        let Some(version) = tree.version(number) else { return Ok(None) };
        let is_whole = tree.checksum == tree_sum(id, &tree.name, tree.head())
            && version.checksum == version_sum(id, number, Some(&version.hash))
            && version.hash == document_hash(&version.saved.document);
        if is_whole {
            Ok(Some(version.saved.document.clone()))
        } else {
            Err(StoreError::Damaged(format!("version {number} of the tree {id} is damaged")))
        }
    }

    async fn thumbnail(&self, tree: &str, version: u32) -> Result<Option<Picture>, StoreError> {
        let kept = self.kept();
        let version = kept.trees.get(tree).and_then(|tree| tree.version(version));
        Ok(version.and_then(|version| version.saved.thumbnail.clone()))
    }

    async fn tree_of(&self, session: &str) -> Result<Option<SessionTree>, StoreError> {
        let kept = self.kept();
        let Some(session) = kept.sessions.get(session) else { return Ok(None) };
        let tree = session.tree.clone().filter(|(tree, _)| kept.trees.contains_key(tree));
        let is_saved = session.row.last_entry <= session.saved_through;
        Ok(tree.map(|(id, version)| SessionTree { id, version, is_saved }))
    }

    async fn purge(&self, before: &str, limit: u32) -> Result<u64, StoreError> {
        let mut kept = self.writing()?;
        let deleted = |tree: &Tree| tree.deleted_at.clone().filter(|at| at.as_str() < before);
        let mut gone: Vec<_> =
            kept.trees.iter().filter_map(|(id, tree)| Some((deleted(tree)?, id.clone()))).collect();
        gone.sort();
        gone.truncate(limit as usize);
        for (_, id) in &gone {
            kept.trees.remove(id);
            kept.threads.remove(id);
            kept.locks.remove(id);
            kept.heirs.remove(id);
            kept.forget_gifts(|gift| gift.is_tree(id));
            kept.favourites.retain(|(_, tree)| tree != id);
            kept.passes.retain(|(_, pass)| pass.tree.as_ref() != Some(id));
        }
        Ok(gone.len() as u64)
    }
}
