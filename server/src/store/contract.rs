//! What every store must do, as tests: `contract::all(make)` runs them on stores that `make` gives, each empty.

mod answers;
mod audit;
mod authors;
mod comments;
mod finding;
mod gifts;
mod groups;
mod library;
mod locks;
mod passes;
mod standings;
mod users;
mod visits;

use std::{collections::BTreeSet, ops::RangeInclusive};

use espalier_proto::Notice;
use espalier_session::{JournalEntry, Principal};

use self::answers::{
    an_answer_is_kept_for_one_request, answers_of_all_callers_are_bounded, answers_of_one_caller_are_bounded,
};
use self::audit::{events_are_listed_newest_first, events_that_come_again_are_counted};
use self::authors::authors_are_called_as_they_were_last;
use self::comments::{
    comments_are_bounded, comments_change_and_go, comments_go_with_their_tree,
    threads_are_listed_newest_first, what_is_seen_of_threads_only_grows,
};
use self::finding::{
    collections_lie_in_each_other, every_order_goes_page_by_page, filters_hold_at_once,
    searching_is_looking_into_every_text, tags_and_favourites_find_trees,
};
use self::gifts::{a_collection_is_given_with_what_lies_in_it, a_tree_is_given_with_its_sessions};
use self::groups::{
    a_group_changes_at_a_revision, a_login_may_what_its_users_groups_may,
    groups_are_listed_with_their_members,
};
pub use self::library::tree;
pub(super) use self::library::tree_of_bytes;
use self::library::{
    every_save_is_a_version, one_of_two_wins, pages_hold_each_tree_once, sessions_belong_to_trees,
    trees_are_listed_newest_first, trees_come_back_whole, versions_are_restored_and_copied,
    what_is_deleted_comes_back_whole, what_was_deleted_long_ago_goes,
};
use self::locks::a_tree_is_locked_with_its_sessions;
use self::passes::{
    a_pass_for_a_tree_goes_with_it, a_pass_may_allow_something_else,
    as_many_are_made_at_once_as_there_may_be, one_of_those_who_redeem_an_invitation_has_come,
    one_of_those_who_take_a_pass_has_it, passes_are_listed_by_kind, passes_let_in_until_they_expire,
};
use self::standings::{
    a_tree_is_handed_over_with_its_sessions, who_is_kept_out_of_a_tree_is_kept_out_of_its_sessions,
};
use self::users::{
    a_login_has_the_role_of_its_user, a_name_is_one_person, a_token_may_what_whoever_holds_it_may,
    a_user_changes_at_a_revision, nothing_is_left_to_a_namesake, the_last_administrator_stays,
    under_another_name_one_is_the_same,
};
use self::visits::{
    pages_hold_each_session_once, sessions_are_listed_to_who_was_in_them, sessions_are_taken_off_lists,
    sessions_know_their_size, who_is_removed_was_in_no_session,
};
use super::{
    Answers, Audit, Authors, Comments, Damage, Finding, Gifts, Groups, Lease, Library, Locks, NewSession,
    NewSnapshot, Passes, Standings, Store, StoreError, StoredSession, Users, Visits,
};

/// A store whose rows a test can damage.
pub trait Breakable:
    Store
    + Library
    + Finding
    + Passes
    + Users
    + Groups
    + Gifts
    + Audit
    + Answers
    + Comments
    + Locks
    + Standings
    + Visits
    + Authors
{
    /// Changes a command in the row of the journal that begins with an entry.
    async fn break_journal(&self, session: &str, first: u64);
    /// Deletes the row of the journal that begins with an entry.
    async fn lose_journal(&self, session: &str, first: u64);
    /// Changes the version of the simulation that a row of the journal was made by.
    async fn break_version(&self, session: &str, first: u64);
    /// Changes the seed of a session.
    async fn break_session(&self, session: &str);
    /// Deletes a snapshot.
    async fn lose_snapshot(&self, session: &str, through: u64);
    /// Changes a byte of a snapshot.
    async fn break_snapshot(&self, session: &str, through: u64);

    /// Changes what all snapshots of a session have in common.
    async fn break_all_snapshots(&self, session: &str);
    /// Changes a byte of each document of a tree.
    async fn break_tree(&self, id: &str);
    /// Changes the name of a tree.
    async fn break_name(&self, id: &str);
    /// Has the two versions of a tree hold each other's documents.
    async fn swap_documents(&self, id: &str);
    /// How many parts of a session are kept aside.
    async fn set_aside_parts(&self, session: &str) -> usize;
}

/// Runs the whole contract, each test on a store of its own; beside it comes what the store needs while it lives.
pub(super) async fn all<S: Breakable, G>(make: impl AsyncFn() -> (S, G)) {
    macro_rules! run {
        ($($test:ident),* $(,)?) => {$({
            let (store, _guard) = make().await;
            $test(&store).await;
        })*};
    }
    run!(
        sessions_begin_empty,
        entries_come_back,
        entries_follow_one_another,
        snapshots_shorten_the_replay,
        two_snapshots_are_kept,
        versions_are_known,
        leases_end_when_another_begins,
        damaged_entries_are_named_and_kept,
        damaged_snapshots_are_passed_over,
        lost_entries_are_noticed,
        entries_lost_between_others_are_noticed,
        lost_snapshots_are_noticed,
        damage_that_snapshots_share_is_named,
        versions_are_covered,
        a_session_row_is_covered,
        notices_are_kept_until_somebody_has_had_them,
        tries_to_open_are_counted_until_one_lives,
        sessions_go_that_nobody_enters,
        trees_are_listed_newest_first,
        pages_hold_each_tree_once,
        trees_come_back_whole,
        every_save_is_a_version,
        one_of_two_wins,
        versions_are_restored_and_copied,
        what_is_deleted_comes_back_whole,
        what_was_deleted_long_ago_goes,
        sessions_belong_to_trees,
        collections_lie_in_each_other,
        tags_and_favourites_find_trees,
        searching_is_looking_into_every_text,
        every_order_goes_page_by_page,
        filters_hold_at_once,
        passes_let_in_until_they_expire,
        one_of_those_who_take_a_pass_has_it,
        one_of_those_who_redeem_an_invitation_has_come,
        passes_are_listed_by_kind,
        a_pass_may_allow_something_else,
        as_many_are_made_at_once_as_there_may_be,
        a_pass_for_a_tree_goes_with_it,
        a_name_is_one_person,
        a_login_has_the_role_of_its_user,
        the_last_administrator_stays,
        a_user_changes_at_a_revision,
        nothing_is_left_to_a_namesake,
        under_another_name_one_is_the_same,
        a_token_may_what_whoever_holds_it_may,
        groups_are_listed_with_their_members,
        a_login_may_what_its_users_groups_may,
        a_group_changes_at_a_revision,
        a_tree_is_given_with_its_sessions,
        a_collection_is_given_with_what_lies_in_it,
        events_are_listed_newest_first,
        events_that_come_again_are_counted,
        an_answer_is_kept_for_one_request,
        answers_of_one_caller_are_bounded,
        answers_of_all_callers_are_bounded,
        threads_are_listed_newest_first,
        comments_change_and_go,
        what_is_seen_of_threads_only_grows,
        comments_are_bounded,
        comments_go_with_their_tree,
        a_tree_is_locked_with_its_sessions,
        authors_are_called_as_they_were_last,
        sessions_are_listed_to_who_was_in_them,
        sessions_are_taken_off_lists,
        pages_hold_each_session_once,
        sessions_know_their_size,
        who_is_removed_was_in_no_session,
        who_is_kept_out_of_a_tree_is_kept_out_of_its_sessions,
        a_tree_is_handed_over_with_its_sessions,
        a_closed_store_takes_nothing,
    );
}

pub(super) fn entries(numbers: RangeInclusive<u64>) -> Vec<JournalEntry> {
    numbers
        .map(|number| JournalEntry {
            number,
            principal: Principal::parse("browser-1").unwrap(),
            id: number as u32,
            command: format!(r#"{{"kind":"grow","steps":{number}}}"#),
        })
        .collect()
}

pub(super) fn oak(snapshot: Option<&[u8]>) -> NewSession {
    NewSession {
        name: "oak".into(),
        seed: u32::MAX,
        simulation_version: 3,
        snapshot: snapshot.map(<[u8]>::to_vec),
        ..NewSession::default()
    }
}

pub(super) async fn with_oak(store: &impl Store) -> Lease {
    store.create_session(oak(None)).await.unwrap();
    store.acquire("oak").await.unwrap()
}

async fn load(store: &impl Store) -> StoredSession {
    store.load_session("oak", None).await.unwrap().unwrap()
}

async fn snapshot(store: &impl Store, lease: &Lease, through: u64) {
    let snapshot = NewSnapshot { through, simulation_version: 3, bytes: vec![through as u8], metamers: 1 };
    store.keep_snapshot(lease, snapshot).await.unwrap();
}

async fn sessions_begin_empty(store: &impl Store) {
    with_oak(store).await;
    let written_by = Some(env!("CARGO_PKG_VERSION").into());
    let expected = StoredSession { seed: u32::MAX, written_by, ..StoredSession::default() };
    assert_eq!(load(store).await, expected);
    assert!(store.has_session("oak").await.unwrap());
    assert!(!store.has_session("elm").await.unwrap());
    assert_eq!(store.load_session("elm", None).await.unwrap(), None);
    assert!(store.create_session(oak(None)).await.is_err(), "a name is given only once");
}

async fn entries_come_back(store: &impl Store) {
    let lease = with_oak(store).await;
    for numbers in [1..=3, 4..=4] {
        store.append(&lease, 3, &entries(numbers)).await.unwrap();
    }
    store.append(&lease, 3, &[]).await.unwrap();
    assert_eq!(load(store).await.entries, entries(1..=4));
}

/// ST1 of the contract: gaps and doubles are refused, and leave no trace.
async fn entries_follow_one_another(store: &impl Store) {
    let lease = with_oak(store).await;
    store.append(&lease, 3, &entries(1..=2)).await.unwrap();
    for (numbers, found) in [(4..=5, 4), (2..=3, 2), (1..=2, 1)] {
        let error = store.append(&lease, 3, &entries(numbers)).await.unwrap_err();
        assert!(
            matches!(error, StoreError::OutOfOrder { last: 2, found: refused } if refused == found),
            "{error}"
        );
    }
    store.append(&lease, 3, &entries(3..=3)).await.unwrap();
    assert_eq!(load(store).await.entries, entries(1..=3));
}

async fn snapshots_shorten_the_replay(store: &impl Store) {
    store.create_session(oak(Some(b"start"))).await.unwrap();
    let lease = store.acquire("oak").await.unwrap();
    assert_eq!(load(store).await.snapshot.as_deref(), Some(b"start".as_slice()));
    store.append(&lease, 3, &entries(1..=4)).await.unwrap();
    store.append(&lease, 3, &entries(5..=6)).await.unwrap();
    snapshot(store, &lease, 3).await;
    let stored = load(store).await;
    assert_eq!((stored.through, stored.snapshot, stored.entries), (3, Some(vec![3]), entries(4..=6)));
    snapshot(store, &lease, 6).await;
    store.append(&lease, 3, &entries(7..=7)).await.unwrap();
    let stored = load(store).await;
    assert_eq!((stored.through, stored.entries), (6, entries(7..=7)));
}

async fn two_snapshots_are_kept(store: &impl Store) {
    let lease = with_oak(store).await;
    for numbers in [1..=2, 3..=4, 5..=6] {
        let through = *numbers.end();
        store.append(&lease, 3, &entries(numbers)).await.unwrap();
        snapshot(store, &lease, through).await;
    }
    let newest = load(store).await;
    assert_eq!((newest.snapshot, newest.entries), (Some(vec![6]), vec![]));
    let older = store.load_session("oak", Some(6)).await.unwrap().unwrap();
    assert_eq!((older.snapshot, older.entries), (Some(vec![4]), entries(5..=6)));
    assert!(matches!(store.load_session("oak", Some(4)).await, Err(StoreError::Damaged(_))));
}

async fn versions_are_known(store: &impl Store) {
    let lease = with_oak(store).await;
    store.append(&lease, 3, &entries(1..=1)).await.unwrap();
    store.append(&lease, 5, &entries(2..=2)).await.unwrap();
    assert_eq!(load(store).await.simulations, BTreeSet::from([3, 5]));
    let through = NewSnapshot { through: 2, simulation_version: 5, bytes: vec![2], metamers: 1 };
    store.keep_snapshot(&lease, through).await.unwrap();
    assert_eq!(load(store).await.simulations, BTreeSet::new());
}

/// ST3 of the contract: who was fenced off writes nothing.
async fn leases_end_when_another_begins(store: &impl Store) {
    let first = with_oak(store).await;
    store.append(&first, 3, &entries(1..=1)).await.unwrap();
    let second = store.acquire("oak").await.unwrap();
    let fenced = |result: Result<(), StoreError>| assert!(matches!(result, Err(StoreError::Fenced)));
    fenced(store.append(&first, 3, &entries(2..=2)).await);
    let late = NewSnapshot { through: 1, simulation_version: 3, bytes: vec![1], metamers: 1 };
    fenced(store.keep_snapshot(&first, late).await);
    fenced(store.set_aside(&first, &[Damage::Journal(1)], &[]).await);
    // Releasing a lost lease does not release that of the present holder.
    store.release(first).await;
    store.append(&second, 3, &entries(2..=2)).await.unwrap();
    let stored = load(store).await;
    assert_eq!((stored.snapshot, stored.entries), (None, entries(1..=2)));
    let given_back = second.clone();
    store.release(second).await;
    fenced(store.append(&given_back, 3, &entries(3..=3)).await);
}

async fn damaged_entries_are_named_and_kept(store: &impl Breakable) {
    let lease = with_oak(store).await;
    for numbers in [1..=2, 3..=4, 5..=5] {
        store.append(&lease, 3, &entries(numbers)).await.unwrap();
    }
    store.break_journal("oak", 3).await;
    let stored = load(store).await;
    assert_eq!((&stored.entries, &stored.damage), (&entries(1..=2), &vec![Damage::Journal(3)]));
    assert_eq!(load(store).await, stored, "looking changes nothing");
    store.set_aside(&lease, &stored.damage, &[]).await.unwrap();
    assert_eq!(store.set_aside_parts("oak").await, 2);
    store.append(&lease, 3, &entries(3..=3)).await.unwrap();
    let stored = load(store).await;
    assert_eq!((stored.entries, stored.damage), (entries(1..=3), vec![]));
}

async fn damaged_snapshots_are_passed_over(store: &impl Breakable) {
    let lease = with_oak(store).await;
    for through in [1, 2] {
        store.append(&lease, 3, &entries(through..=through)).await.unwrap();
        snapshot(store, &lease, through).await;
    }
    store.break_snapshot("oak", 2).await;
    let stored = load(store).await;
    assert_eq!((&stored.snapshot, &stored.entries), (&Some(vec![1]), &entries(2..=2)));
    assert_eq!(stored.damage, [Damage::Snapshot(2)]);
    store.set_aside(&lease, &stored.damage, &[]).await.unwrap();
    assert_eq!(load(store).await.damage, []);
    // A snapshot of the same moment takes its place again.
    snapshot(store, &lease, 2).await;
    assert_eq!(load(store).await.snapshot, Some(vec![2]));
    store.break_snapshot("oak", 1).await;
    store.break_snapshot("oak", 2).await;
    let refused = store.load_session("oak", None).await;
    assert!(matches!(refused, Err(StoreError::Damaged(_))), "nothing is made up");
}

async fn lost_entries_are_noticed(store: &impl Breakable) {
    let lease = with_oak(store).await;
    for numbers in [1..=2, 3..=4, 5..=5] {
        store.append(&lease, 3, &entries(numbers)).await.unwrap();
    }
    store.lose_journal("oak", 5).await;
    let stored = load(store).await;
    assert_eq!((&stored.entries, &stored.damage), (&entries(1..=4), &vec![Damage::Journal(5)]));
    store.lose_journal("oak", 3).await;
    snapshot(store, &lease, 2).await;
    let stored = load(store).await;
    assert_eq!((stored.through, &stored.damage), (2, &vec![Damage::Journal(3)]));
    store.set_aside(&lease, &stored.damage, &[]).await.unwrap();
    assert_eq!(load(store).await.damage, [], "it is noticed once");
    store.append(&lease, 3, &entries(3..=3)).await.unwrap();
    assert_eq!(load(store).await.entries, entries(3..=3));
}

async fn entries_lost_between_others_are_noticed(store: &impl Breakable) {
    let lease = with_oak(store).await;
    for numbers in [1..=2, 3..=3, 4..=5] {
        store.append(&lease, 3, &entries(numbers)).await.unwrap();
    }
    store.lose_journal("oak", 3).await;
    let stored = load(store).await;
    assert_eq!((&stored.entries, &stored.damage), (&entries(1..=2), &vec![Damage::Journal(3)]));
    store.set_aside(&lease, &stored.damage, &[]).await.unwrap();
    let stored = load(store).await;
    assert_eq!((&stored.entries, &stored.damage), (&entries(1..=2), &Vec::new()), "it is noticed once");
    store.append(&lease, 3, &entries(3..=3)).await.unwrap();
    assert_eq!(load(store).await.entries, entries(1..=3));
}

async fn lost_snapshots_are_noticed(store: &impl Breakable) {
    store.create_session(oak(Some(b"start"))).await.unwrap();
    let lease = store.acquire("oak").await.unwrap();
    store.append(&lease, 3, &entries(1..=1)).await.unwrap();
    snapshot(store, &lease, 1).await;
    store.lose_snapshot("oak", 1).await;
    let stored = load(store).await;
    assert_eq!((&stored.snapshot, &stored.entries), (&Some(b"start".to_vec()), &entries(1..=1)));
    assert_eq!(stored.damage, [Damage::Snapshot(1)]);
    store.set_aside(&lease, &stored.damage, &[]).await.unwrap();
    assert_eq!(load(store).await.damage, []);
    store.lose_snapshot("oak", 0).await;
    let refused = store.load_session("oak", None).await;
    assert!(matches!(refused, Err(StoreError::Damaged(_))), "no other tree grows in its place");
}

async fn damage_that_snapshots_share_is_named(store: &impl Breakable) {
    store.create_session(oak(Some(b"start"))).await.unwrap();
    let lease = store.acquire("oak").await.unwrap();
    store.append(&lease, 3, &entries(1..=1)).await.unwrap();
    let same = NewSnapshot { through: 1, simulation_version: 3, bytes: b"start".to_vec(), metamers: 1 };
    store.keep_snapshot(&lease, same).await.unwrap();
    store.break_all_snapshots("oak").await;
    let Err(StoreError::Damaged(what)) = store.load_session("oak", None).await else {
        panic!("OP4: no other tree opens in its place")
    };
    assert!(what.contains("oak") && what.contains("entry 1, ") && what.contains("entry 0"), "{what}");
}

async fn versions_are_covered(store: &impl Breakable) {
    let lease = with_oak(store).await;
    store.append(&lease, 3, &entries(1..=1)).await.unwrap();
    store.break_version("oak", 1).await;
    let stored = load(store).await;
    assert_eq!((stored.simulations, stored.damage), (BTreeSet::new(), vec![Damage::Journal(1)]));
}

async fn a_session_row_is_covered(store: &impl Breakable) {
    let lease = with_oak(store).await;
    store.append(&lease, 3, &entries(1..=2)).await.unwrap();
    store.break_session("oak").await;
    let refused = store.load_session("oak", None).await;
    assert!(matches!(refused, Err(StoreError::Damaged(_))), "another seed grows another tree");
    let unsure = store.append(&lease, 3, &entries(3..=3)).await;
    assert!(matches!(unsure, Err(StoreError::Damaged(_))));

    store.create_session(NewSession { name: "elm".into(), ..oak(Some(b"start")) }).await.unwrap();
    let lease = store.acquire("elm").await.unwrap();
    store.append(&lease, 3, &entries(1..=2)).await.unwrap();
    store.break_session("elm").await;
    let stored = store.load_session("elm", None).await.unwrap().unwrap();
    assert_eq!(stored.entries, entries(1..=2), "a snapshot needs no seed");
    assert_eq!(stored.damage, [Damage::Journal(3)], "but nobody knows what else there was");
    store.set_aside(&lease, &stored.damage, &[]).await.unwrap();
    store.append(&lease, 3, &entries(3..=3)).await.unwrap();
    let stored = store.load_session("elm", None).await.unwrap().unwrap();
    assert_eq!((stored.entries, stored.damage), (entries(1..=3), vec![]));
}

async fn notices_are_kept_until_somebody_has_had_them(store: &impl Store) {
    let lease = with_oak(store).await;
    let (damaged, regrown) = (Notice::Damaged { entry: 4 }, Notice::Regrown { from: 1, to: 2 });
    store.set_aside(&lease, &[], std::slice::from_ref(&damaged)).await.unwrap();
    store.set_aside(&lease, &[], &[damaged.clone(), regrown.clone()]).await.unwrap();
    store.append(&lease, 3, &entries(1..=1)).await.unwrap();
    assert_eq!(load(store).await.notices, [damaged, regrown]);
    store.forget_notices(&lease).await.unwrap();
    assert_eq!(load(store).await.notices, []);
}

async fn tries_to_open_are_counted_until_one_lives(store: &impl Store) {
    let lease = with_oak(store).await;
    assert_eq!(store.count_try(&lease).await.unwrap(), 1);
    assert_eq!(store.count_try(&lease).await.unwrap(), 2);
    // What is drawn meanwhile changes nothing of it, and nobody who has lost the session counts.
    store.append(&lease, 3, &entries(1..=2)).await.unwrap();
    let later = store.acquire("oak").await.unwrap();
    assert!(matches!(store.count_try(&lease).await, Err(StoreError::Fenced)));
    assert!(matches!(store.forget_tries(&lease).await, Err(StoreError::Fenced)));
    assert_eq!(store.count_try(&later).await.unwrap(), 3);
    store.forget_tries(&later).await.unwrap();
    assert_eq!(store.count_try(&later).await.unwrap(), 1);
    assert_eq!(load(store).await.entries, entries(1..=2));
}

async fn sessions_go_that_nobody_enters(store: &(impl Store + Library)) {
    const LONG_AGO: &str = "2000";
    const LATER: &str = "9999";
    let named = |name: &str, snapshot| NewSession { name: name.into(), ..oak(snapshot) };
    let lease = with_oak(store).await;
    store.append(&lease, 3, &entries(1..=2)).await.unwrap();
    let mut ash = tree("ash", "2026");
    ash.version.session = Some(("oak".into(), 2));
    store.add_tree(ash).await.unwrap();
    for (name, snapshot) in [("unsaved", None), ("imported", Some(b"scan".as_slice())), ("seedling", None)] {
        store.create_session(named(name, snapshot)).await.unwrap();
    }
    let unsaved = store.acquire("unsaved").await.unwrap();
    store.append(&unsaved, 3, &entries(1..=1)).await.unwrap();
    store.release(unsaved).await;
    let is_there = async |name| store.has_session(name).await.unwrap();

    assert_eq!(store.purge_sessions(LONG_AGO, LONG_AGO, 9).await.unwrap(), 0, "all were entered since");
    assert_eq!(store.purge_sessions(LATER, LONG_AGO, 9).await.unwrap(), 1);
    assert!(!is_there("seedling").await, "nothing was ever done to it");
    assert!(is_there("oak").await, "somebody is in it");
    store.release(lease).await;
    assert_eq!(store.purge_sessions(LATER, LONG_AGO, 9).await.unwrap(), 1);
    assert!(!is_there("oak").await);
    assert_eq!(store.tree("ash").await.unwrap().unwrap().session, None, "the tree stays, in no session");
    assert!(is_there("unsaved").await && is_there("imported").await, "they are in no version");
    assert_eq!(store.purge_sessions(LATER, LATER, 1).await.unwrap(), 1, "so many at most");
    assert_eq!(store.purge_sessions(LATER, LATER, 9).await.unwrap(), 1);
    while store.shrink().await.unwrap() {}
}

async fn a_closed_store_takes_nothing(store: &impl Store) {
    let lease = with_oak(store).await;
    store.append(&lease, 3, &entries(1..=1)).await.unwrap();
    store.close().await;
    let error = store.append(&lease, 3, &entries(2..=2)).await.unwrap_err();
    assert!(matches!(error, StoreError::Closed), "{error}");
}
