//! How people stand with trees, in the model.

use super::{
    super::{Heir, Removal, Removed, Room, Standing, Standings, StoreError},
    MemoryStore,
};

impl Standings for MemoryStore {
    async fn keep_out(&self, removal: Removal, now: &str) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let is_same = |other: &Removal| (&other.room, &other.person) == (&removal.room, &removal.person);
        kept.removals.retain(|other| *other.until > *now && !is_same(other));
        kept.removals.push(removal);
        Ok(())
    }

    async fn removals(&self, room: Room<'_>, now: &str) -> Result<Vec<Removal>, StoreError> {
        let (kept, room) = (self.kept(), room.written());
        let there = kept.removals.iter().filter(|removal| removal.room == room && *removal.until > *now);
        let mut found: Vec<Removal> = there.cloned().collect();
        found.sort_by(|a, b| (&a.until, &a.id).cmp(&(&b.until, &b.id)));
        Ok(found)
    }

    async fn let_back(&self, id: &str) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let before = kept.removals.len();
        kept.removals.retain(|removal| removal.id != id);
        Ok(kept.removals.len() < before)
    }

    async fn hand_over(&self, tree: &str, to: Option<Heir>, by: Option<&str>) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let has_it = |by| kept.heirs.get(tree).is_some_and(|heir| heir.person == by);
        if !kept.trees.contains_key(tree) || !by.is_none_or(has_it) {
            return Ok(false);
        }
        match to {
            Some(heir) => drop(kept.heirs.insert(tree.to_owned(), heir)),
            None => drop(kept.heirs.remove(tree)),
        }
        Ok(true)
    }

    async fn heir_of(&self, tree: &str) -> Result<Option<Heir>, StoreError> {
        Ok(self.kept().heirs.get(tree).cloned())
    }

    async fn standing(&self, room: Room<'_>, person: &str, now: &str) -> Result<Standing, StoreError> {
        let kept = self.kept();
        let (tree, session) = match room {
            Room::Tree(id) => (Some(id), None),
            Room::Session(name) => {
                let of = kept.sessions.get(name).and_then(|session| session.tree.as_ref());
                (of.map(|(tree, _)| tree.as_str()), Some(name))
            }
        };
        let rooms =
            [tree.map(|id| Room::Tree(id).written()), session.map(|name| Room::Session(name).written())];
        let removed = kept.removals.iter().find(|removal| {
            let is_here = rooms.iter().flatten().any(|room| *room == removal.room);
            is_here && removal.person == person && *removal.until > *now
        });
        let removed =
            removed.map(|removal| Removed { by: removal.by.clone(), is_revoked: removal.is_revoked });
        Ok(Standing {
            locked_by: tree.and_then(|tree| kept.locks.get(tree)).cloned(),
            removed,
            is_heir: tree.and_then(|tree| kept.heirs.get(tree)).is_some_and(|heir| heir.person == person),
            is_deleted: tree
                .and_then(|tree| kept.trees.get(tree))
                .is_some_and(|tree| tree.deleted_at.is_some()),
        })
    }
}
