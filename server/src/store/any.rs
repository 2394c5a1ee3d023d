//! The store that the server was started with: each call goes on to it.

use std::collections::BTreeSet;

use espalier_proto::{Notice, access::Role};
use espalier_session::{JournalEntry, Named, Principal};

#[cfg(test)]
use super::MemoryStore;
use super::{
    Answer, AnswerKey, Answering, Answers, Audit, Authors, Collection, CollectionChange, CommentBytes,
    CommentChange, Comments, Commits, Damage, Event, Finding, Gift, Gifts, Given, Group, GroupChange, Groups,
    Heir, Lease, Library, Locks, MostAnswers, NewComment, NewSession, NewSnapshot, NewTree, NewVersion,
    Noted, Pass, PassKind, Passes, Picture, Receiver, Removal, Room, SessionLine, SessionQuery, SessionTree,
    SqliteStore, Standing, Standings, Store, StoreError, StoredSession, StoredThread, StoredTree,
    StoredVersion, Terms, TreeChange, TreeDocument, TreeQuery, User, UserChange, Users, Visits,
};
use crate::access::SecretHash;

/// The store that the server was started with.
#[derive(Debug)]
pub enum AnyStore {
    /// A file of SQLite.
    Sqlite(SqliteStore),
    /// The model, for tests.
    #[cfg(test)]
    Memory(Box<MemoryStore>),
}

/// Hands a call on to the store there is.
macro_rules! delegate {
    ($self:ident.$method:ident($($argument:expr),*)) => {
        match $self {
            Self::Sqlite(store) => store.$method($($argument),*).await,
            #[cfg(test)]
            Self::Memory(store) => store.$method($($argument),*).await,
        }
    };
}

impl AnyStore {
    /// What was committed since it was opened; the model keeps no count.
    pub fn commits(&self) -> Commits {
        match self {
            Self::Sqlite(store) => store.commits(),
            #[cfg(test)]
            Self::Memory(_) => Commits::default(),
        }
    }
}

impl Store for AnyStore {
    async fn create_session(&self, new: NewSession) -> Result<(), StoreError> {
        delegate!(self.create_session(new))
    }

    async fn count_try(&self, lease: &Lease) -> Result<u32, StoreError> {
        delegate!(self.count_try(lease))
    }

    async fn forget_tries(&self, lease: &Lease) -> Result<(), StoreError> {
        delegate!(self.forget_tries(lease))
    }

    async fn has_session(&self, name: &str) -> Result<bool, StoreError> {
        delegate!(self.has_session(name))
    }

    async fn acquire(&self, session: &str) -> Result<Lease, StoreError> {
        delegate!(self.acquire(session))
    }

    async fn release(&self, lease: Lease) {
        delegate!(self.release(lease));
    }

    async fn load_session(
        &self,
        name: &str,
        before: Option<u64>,
    ) -> Result<Option<StoredSession>, StoreError> {
        delegate!(self.load_session(name, before))
    }

    async fn set_aside(
        &self,
        lease: &Lease,
        damage: &[Damage],
        notices: &[Notice],
    ) -> Result<(), StoreError> {
        delegate!(self.set_aside(lease, damage, notices))
    }

    async fn forget_notices(&self, lease: &Lease) -> Result<(), StoreError> {
        delegate!(self.forget_notices(lease))
    }

    async fn append(
        &self,
        lease: &Lease,
        simulation_version: u32,
        entries: &[JournalEntry],
    ) -> Result<(), StoreError> {
        delegate!(self.append(lease, simulation_version, entries))
    }

    async fn keep_snapshot(&self, lease: &Lease, snapshot: NewSnapshot) -> Result<(), StoreError> {
        delegate!(self.keep_snapshot(lease, snapshot))
    }

    async fn purge_sessions(&self, saved: &str, unsaved: &str, limit: u32) -> Result<u64, StoreError> {
        delegate!(self.purge_sessions(saved, unsaved, limit))
    }

    async fn shrink(&self) -> Result<bool, StoreError> {
        delegate!(self.shrink())
    }

    async fn check_place(&self) -> Result<(), StoreError> {
        delegate!(self.check_place())
    }

    async fn close(&self) {
        delegate!(self.close());
    }
}

impl Library for AnyStore {
    async fn add_tree(&self, tree: NewTree) -> Result<(), StoreError> {
        delegate!(self.add_tree(tree))
    }

    async fn add_version(
        &self,
        tree: &str,
        expected: Option<u64>,
        version: NewVersion,
    ) -> Result<u32, StoreError> {
        delegate!(self.add_version(tree, expected, version))
    }

    async fn change_tree(
        &self,
        tree: &str,
        expected: Option<u64>,
        change: TreeChange,
    ) -> Result<(), StoreError> {
        delegate!(self.change_tree(tree, expected, change))
    }

    async fn trees(&self, query: &TreeQuery) -> Result<Vec<StoredTree>, StoreError> {
        delegate!(self.trees(query))
    }

    async fn tree(&self, id: &str) -> Result<Option<StoredTree>, StoreError> {
        delegate!(self.tree(id))
    }

    async fn versions(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredVersion>, StoreError> {
        delegate!(self.versions(tree, limit, before))
    }

    async fn document(&self, tree: &str, version: u32) -> Result<Option<TreeDocument>, StoreError> {
        delegate!(self.document(tree, version))
    }

    async fn thumbnail(&self, tree: &str, version: u32) -> Result<Option<Picture>, StoreError> {
        delegate!(self.thumbnail(tree, version))
    }

    async fn tree_of(&self, session: &str) -> Result<Option<SessionTree>, StoreError> {
        delegate!(self.tree_of(session))
    }

    async fn purge(&self, before: &str, limit: u32) -> Result<u64, StoreError> {
        delegate!(self.purge(before, limit))
    }
}

impl Finding for AnyStore {
    async fn collections(&self) -> Result<Vec<Collection>, StoreError> {
        delegate!(self.collections())
    }

    async fn add_collection(&self, new: Collection) -> Result<(), StoreError> {
        delegate!(self.add_collection(new))
    }

    async fn change_collection(&self, id: &str, change: CollectionChange) -> Result<(), StoreError> {
        delegate!(self.change_collection(id, change))
    }

    async fn delete_collection(&self, id: &str) -> Result<(), StoreError> {
        delegate!(self.delete_collection(id))
    }

    async fn tags(&self) -> Result<Vec<(String, u32)>, StoreError> {
        delegate!(self.tags())
    }

    async fn authors(&self) -> Result<Vec<(String, u32)>, StoreError> {
        delegate!(self.authors())
    }

    async fn favourites(&self, principal: &str) -> Result<BTreeSet<String>, StoreError> {
        delegate!(self.favourites(principal))
    }

    async fn set_favourite(&self, principal: &str, tree: &str, is_one: bool) -> Result<(), StoreError> {
        delegate!(self.set_favourite(principal, tree, is_one))
    }
}

impl Passes for AnyStore {
    async fn add_pass(&self, hash: SecretHash, pass: Pass) -> Result<(), StoreError> {
        delegate!(self.add_pass(hash, pass))
    }

    async fn add_pass_up_to(&self, most: u32, hash: SecretHash, pass: Pass) -> Result<(), StoreError> {
        delegate!(self.add_pass_up_to(most, hash, pass))
    }

    async fn pass(&self, hash: SecretHash, now: &str) -> Result<Option<Pass>, StoreError> {
        delegate!(self.pass(hash, now))
    }

    async fn passes(&self, kind: PassKind, now: &str) -> Result<Vec<Pass>, StoreError> {
        delegate!(self.passes(kind, now))
    }

    async fn extend_pass(&self, id: &str, expires_at: &str) -> Result<(), StoreError> {
        delegate!(self.extend_pass(id, expires_at))
    }

    async fn change_pass(&self, id: &str, role: Role) -> Result<bool, StoreError> {
        delegate!(self.change_pass(id, role))
    }

    async fn redeem_pass(&self, hash: SecretHash, device: &Pass) -> Result<bool, StoreError> {
        delegate!(self.redeem_pass(hash, device))
    }

    async fn take_pass(&self, id: &str) -> Result<bool, StoreError> {
        delegate!(self.take_pass(id))
    }

    async fn purge_passes(&self, now: &str) -> Result<(), StoreError> {
        delegate!(self.purge_passes(now))
    }
}

impl Comments for AnyStore {
    async fn add_thread(
        &self,
        tree: &str,
        pin: Option<String>,
        first: NewComment,
    ) -> Result<u32, StoreError> {
        delegate!(self.add_thread(tree, pin, first))
    }

    async fn add_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: NewComment,
    ) -> Result<Option<u32>, StoreError> {
        delegate!(self.add_comment(tree, thread, comment))
    }

    async fn change_comment(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
        change: CommentChange,
    ) -> Result<bool, StoreError> {
        delegate!(self.change_comment(tree, thread, comment, change))
    }

    async fn resolve_thread(
        &self,
        tree: &str,
        thread: u32,
        resolved: Option<(String, String)>,
    ) -> Result<bool, StoreError> {
        delegate!(self.resolve_thread(tree, thread, resolved))
    }

    async fn threads(
        &self,
        tree: &str,
        limit: u32,
        before: Option<u32>,
    ) -> Result<Vec<StoredThread>, StoreError> {
        delegate!(self.threads(tree, limit, before))
    }

    async fn thread(&self, tree: &str, thread: u32) -> Result<Option<StoredThread>, StoreError> {
        delegate!(self.thread(tree, thread))
    }

    async fn comment_bytes(&self, tree: &str) -> Result<CommentBytes, StoreError> {
        delegate!(self.comment_bytes(tree))
    }

    async fn pins(&self, tree: &str) -> Result<Vec<(u32, String)>, StoreError> {
        delegate!(self.pins(tree))
    }

    async fn comment_picture(
        &self,
        tree: &str,
        thread: u32,
        comment: u32,
    ) -> Result<Option<Picture>, StoreError> {
        delegate!(self.comment_picture(tree, thread, comment))
    }

    async fn see_thread(
        &self,
        tree: &str,
        person: &str,
        thread: u32,
        comment: u32,
    ) -> Result<bool, StoreError> {
        delegate!(self.see_thread(tree, person, thread, comment))
    }

    async fn seen_threads(&self, tree: &str, person: &str) -> Result<Vec<(u32, u32)>, StoreError> {
        delegate!(self.seen_threads(tree, person))
    }
}

impl Locks for AnyStore {
    async fn lock_tree(&self, tree: &str, by: Option<String>) -> Result<bool, StoreError> {
        delegate!(self.lock_tree(tree, by))
    }

    async fn lock_of(&self, tree: &str) -> Result<Option<String>, StoreError> {
        delegate!(self.lock_of(tree))
    }
}

impl Standings for AnyStore {
    async fn keep_out(&self, removal: Removal, now: &str) -> Result<(), StoreError> {
        delegate!(self.keep_out(removal, now))
    }

    async fn removals(&self, room: Room<'_>, now: &str) -> Result<Vec<Removal>, StoreError> {
        delegate!(self.removals(room, now))
    }

    async fn let_back(&self, id: &str) -> Result<bool, StoreError> {
        delegate!(self.let_back(id))
    }

    async fn hand_over(&self, tree: &str, to: Option<Heir>, by: Option<&str>) -> Result<bool, StoreError> {
        delegate!(self.hand_over(tree, to, by))
    }

    async fn heir_of(&self, tree: &str) -> Result<Option<Heir>, StoreError> {
        delegate!(self.heir_of(tree))
    }

    async fn standing(&self, room: Room<'_>, person: &str, now: &str) -> Result<Standing, StoreError> {
        delegate!(self.standing(room, person, now))
    }
}

impl Visits for AnyStore {
    async fn visit(&self, session: &str, person: &str) -> Result<(), StoreError> {
        delegate!(self.visit(session, person))
    }

    async fn sessions(&self, query: &SessionQuery) -> Result<Vec<SessionLine>, StoreError> {
        delegate!(self.sessions(query))
    }

    async fn forget_session(&self, session: &str, person: Option<&str>) -> Result<bool, StoreError> {
        delegate!(self.forget_session(session, person))
    }
}

impl Authors for AnyStore {
    async fn name_author(&self, named: &Named, at: &str) -> Result<(), StoreError> {
        delegate!(self.name_author(named, at))
    }

    async fn named_authors(&self, authors: &[Principal]) -> Result<Vec<Named>, StoreError> {
        delegate!(self.named_authors(authors))
    }
}

impl Users for AnyStore {
    async fn add_user(&self, user: User) -> Result<(), StoreError> {
        delegate!(self.add_user(user))
    }

    async fn user(&self, name: &str) -> Result<Option<User>, StoreError> {
        delegate!(self.user(name))
    }

    async fn users(&self) -> Result<Vec<User>, StoreError> {
        delegate!(self.users())
    }

    async fn change_user(&self, id: &str, change: UserChange, terms: Terms) -> Result<bool, StoreError> {
        delegate!(self.change_user(id, change, terms))
    }

    async fn remove_user(&self, id: &str, terms: Terms) -> Result<bool, StoreError> {
        delegate!(self.remove_user(id, terms))
    }
}

impl Groups for AnyStore {
    async fn add_group(&self, group: Group) -> Result<(), StoreError> {
        delegate!(self.add_group(group))
    }

    async fn groups(&self) -> Result<Vec<Group>, StoreError> {
        delegate!(self.groups())
    }

    async fn change_group(
        &self,
        id: &str,
        change: GroupChange,
        expected: Option<u64>,
    ) -> Result<bool, StoreError> {
        delegate!(self.change_group(id, change, expected))
    }

    async fn remove_group(&self, id: &str, expected: Option<u64>) -> Result<bool, StoreError> {
        delegate!(self.remove_group(id, expected))
    }

    async fn join_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<(), StoreError> {
        delegate!(self.join_group(id, user, expected))
    }

    async fn leave_group(&self, id: &str, user: &str, expected: Option<u64>) -> Result<bool, StoreError> {
        delegate!(self.leave_group(id, user, expected))
    }
}

impl Gifts for AnyStore {
    async fn give(&self, what: Gift<'_>, to: &Receiver, role: Role) -> Result<(), StoreError> {
        delegate!(self.give(what, to, role))
    }

    async fn take_back(&self, what: Gift<'_>, from: &str) -> Result<bool, StoreError> {
        delegate!(self.take_back(what, from))
    }

    async fn given(&self, what: Gift<'_>) -> Result<Vec<Given>, StoreError> {
        delegate!(self.given(what))
    }

    async fn role_given(&self, room: Room<'_>, person: &str) -> Result<Role, StoreError> {
        delegate!(self.role_given(room, person))
    }

    async fn role_in(&self, collection: &str, person: &str) -> Result<Role, StoreError> {
        delegate!(self.role_in(collection, person))
    }

    async fn collections_of(&self, person: &str) -> Result<BTreeSet<String>, StoreError> {
        delegate!(self.collections_of(person))
    }
}

impl Audit for AnyStore {
    async fn note(&self, event: Event) -> Result<(), StoreError> {
        delegate!(self.note(event))
    }

    async fn events(&self, limit: u32, before: Option<u64>) -> Result<Vec<Noted>, StoreError> {
        delegate!(self.events(limit, before))
    }

    async fn purge_events(&self, before: &str) -> Result<(), StoreError> {
        delegate!(self.purge_events(before))
    }
}

impl Answers for AnyStore {
    async fn begin_answer(
        &self,
        key: AnswerKey,
        at: &str,
        since: &str,
        most: MostAnswers,
    ) -> Result<bool, StoreError> {
        delegate!(self.begin_answer(key, at, since, most))
    }

    async fn answer(&self, key: AnswerKey) -> Result<Option<Answering>, StoreError> {
        delegate!(self.answer(key))
    }

    async fn keep_answer(&self, key: AnswerKey, answer: Answer) -> Result<(), StoreError> {
        delegate!(self.keep_answer(key, answer))
    }

    async fn forget_answer(&self, key: AnswerKey) -> Result<(), StoreError> {
        delegate!(self.forget_answer(key))
    }

    async fn purge_answers(&self, before: &str) -> Result<(), StoreError> {
        delegate!(self.purge_answers(before))
    }
}
