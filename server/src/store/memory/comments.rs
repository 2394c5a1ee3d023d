//! Comments in the model.

use std::collections::BTreeMap;

use super::{
    super::{
        CommentBytes, CommentChange, Comments, MOST_COMMENTS, MOST_THREADS, Missing, NewComment, Picture,
        StoreError, StoredComment, StoredThread,
    },
    Kept, MemoryStore,
};

/// A thread, and who has seen how much of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Thread {
    pin: Option<String>,
    resolved: Option<(String, String)>,
    /// From 1 on; nothing of those that were deleted.
    comments: Vec<Option<(StoredComment, Option<Picture>)>>,
    seen: BTreeMap<String, u32>,
}

impl Thread {
    fn stored(&self, number: u32) -> Option<StoredThread> {
        let comments: Vec<_> = self.comments.iter().flatten().map(|(comment, _)| comment.clone()).collect();
        let (pin, resolved) = (self.pin.clone(), self.resolved.clone());
        (!comments.is_empty()).then_some(StoredThread { number, pin, resolved, comments })
    }

    fn add_to(&self, held: &mut CommentBytes) {
        for (comment, picture) in self.comments.iter().flatten() {
            held.said += comment.said.len() as u64;
            held.pictures += picture.as_ref().map_or(0, |picture| picture.bytes.len() as u64);
        }
    }

    pub(super) fn forget_reader(&mut self, person: &str) {
        self.seen.remove(person);
    }

    pub(super) fn rename(&mut self, old: &str, new: &str, saying: impl Fn(&str) -> String) {
        if let Some(seen) = self.seen.remove(old) {
            self.seen.insert(new.to_owned(), seen);
        }
        for (comment, _) in self.comments.iter_mut().flatten() {
            comment.said = saying(&comment.said);
            if comment.person == old {
                new.clone_into(&mut comment.person);
            }
        }
    }

    fn add(&mut self, new: NewComment) -> u32 {
        let NewComment { person, author, written_at, said, picture } = new;
        let number = self.comments.len() as u32 + 1;
        let has_picture = picture.is_some();
        let comment =
            StoredComment { number, person, author, written_at, edited_at: None, said, has_picture };
        self.comments.push(Some((comment, picture)));
        number
    }
}

impl Kept {
    /// The threads of a tree that is there, if they have room for another comment.
    fn threads_for(
        &mut self,
        tree: &str,
        new: &NewComment,
    ) -> Result<&mut BTreeMap<u32, Thread>, StoreError> {
        if !self.trees.contains_key(tree) {
            return Err(StoreError::NotFound(Missing::Tree));
        }
        self.held_by(tree).require_room(new.bytes())?;
        Ok(self.threads.entry(tree.to_owned()).or_default())
    }

    fn held_by(&self, tree: &str) -> CommentBytes {
        let mut held = CommentBytes::default();
        let threads = self.threads.get(tree).into_iter().flatten();
        threads.for_each(|(_, thread)| thread.add_to(&mut held));
        held
    }

    fn there(&mut self, tree: &str, thread: u32) -> Option<&mut Thread> {
        let found = self.threads.get_mut(tree)?.get_mut(&thread)?;
        found.comments.iter().any(Option::is_some).then_some(found)
    }
}

impl Comments for MemoryStore {
    async fn add_thread(
        &self,
        tree: &str,
        pin: Option<String>,
        first: NewComment,
    ) -> Result<u32, StoreError> {
        let mut kept = self.writing()?;
        let threads = kept.threads_for(tree, &first)?;
        let number = threads.len() as u32 + 1;
        if number > MOST_THREADS {
            return Err(StoreError::Full);
        }
        let mut thread = Thread { pin, ..Thread::default() };
        thread.add(first);
        threads.insert(number, thread);
        Ok(number)
    }

    async fn add_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: NewComment,
    ) -> Result<Option<u32>, StoreError> {
        let mut kept = self.writing()?;
        kept.threads_for(tree, &comment)?;
        match kept.there(tree, thread) {
            None => Ok(None),
            Some(found) if found.comments.len() as u32 >= MOST_COMMENTS => Err(StoreError::Full),
            Some(found) => Ok(Some(found.add(comment))),
        }
    }

    async fn change_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
        change: CommentChange,
    ) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let held = kept.held_by(tree);
        let found = kept.there(tree, thread).and_then(|found| {
            found.comments.get_mut((comment as usize).checked_sub(1)?).filter(|one| one.is_some())
        });
        let Some(found) = found else { return Ok(false) };
        match (change, found) {
            (CommentChange::Edited { said, at }, Some((one, _))) => {
                let more = said.len().saturating_sub(one.said.len()) as u64;
                held.require_room(CommentBytes { said: more, pictures: 0 })?;
                (one.said, one.edited_at) = (said, Some(at));
            }
            (CommentChange::Deleted, found) => *found = None,
            (CommentChange::Edited { .. }, None) => {}
        }
        Ok(true)
    }

    async fn resolve_thread(
        &self,
        tree: &str,
        thread: u32,
        resolved: Option<(String, String)>,
    ) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        Ok(kept.there(tree, thread).map(|found| found.resolved = resolved).is_some())
    }

    async fn threads(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredThread>, StoreError> {
        let kept = self.kept();
        let Some(threads) = kept.threads.get(tree) else { return Ok(Vec::new()) };
        let earlier = threads.range(..before.unwrap_or(u32::MAX)).rev();
        Ok(earlier.filter_map(|(number, thread)| thread.stored(*number)).take(limit as usize).collect())
    }

    async fn thread(&self, tree: &str, thread: u32) -> Result<Option<StoredThread>, StoreError> {
        Ok(self.kept().there(tree, thread).and_then(|found| found.stored(thread)))
    }

    async fn comment_bytes(&self, tree: &str) -> Result<CommentBytes, StoreError> {
        Ok(self.kept().held_by(tree))
    }

    async fn pins(&self, tree: &str) -> Result<Vec<(u32, String)>, StoreError> {
        let kept = self.kept();
        let threads = kept.threads.get(tree).into_iter().flatten();
        let there = threads.filter(|(number, thread)| thread.stored(**number).is_some());
        Ok(there.filter_map(|(number, thread)| Some((*number, thread.pin.clone()?))).collect())
    }

    async fn comment_picture(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
    ) -> Result<Option<Picture>, StoreError> {
        let mut kept = self.kept();
        let found = kept.there(tree, thread).and_then(|found| {
            let (_, picture) = found.comments.get((comment as usize).checked_sub(1)?)?.as_ref()?;
            picture.clone()
        });
        Ok(found)
    }

    async fn see_thread(
        &self,
        tree: &str,
        person: &str,
        thread: u32,
        comment: u32,
    ) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(found) = kept.there(tree, thread) else { return Ok(false) };
        let most = found.comments.len() as u32;
        let seen = found.seen.entry(person.to_owned()).or_default();
        *seen = (*seen).max(comment.min(most));
        Ok(true)
    }

    async fn seen_threads(&self, tree: &str, person: &str) -> Result<Vec<(u32, u32)>, StoreError> {
        let kept = self.kept();
        let threads = kept.threads.get(tree).into_iter().flatten();
        Ok(threads.filter_map(|(number, thread)| Some((*number, *thread.seen.get(person)?))).collect())
    }
}
