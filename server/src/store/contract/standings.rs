//! The contract of how people stand with trees.

use super::{
    super::{
        Deletion, Heir, Library, Locks, NewSession, Removal, Removed, Room, Standing, Standings, Store,
        TreeChange,
    },
    library::tree,
};

const NOW: &str = "2026-05-01T12:00:00.000Z";

/// An ash with a session, a yew, and a session of no tree.
async fn planted(store: &(impl Library + Store)) {
    for id in ["ash", "yew"] {
        store.add_tree(tree(id, NOW)).await.unwrap();
    }
    for (name, tree) in [("oak", None), ("ashen", Some(("ash".to_owned(), 1)))] {
        let name = name.to_owned();
        store.create_session(NewSession { name, tree, ..NewSession::default() }).await.unwrap();
    }
}

fn removal(id: &str, room: Room<'_>, until: &str) -> Removal {
    Removal {
        id: id.into(),
        room: room.written(),
        person: "login bo".into(),
        name: "Bo".into(),
        by: "Ann".into(),
        until: until.into(),
        is_revoked: false,
    }
}

pub(super) async fn who_is_kept_out_of_a_tree_is_kept_out_of_its_sessions(
    store: &(impl Standings + Library + Store),
) {
    planted(store).await;
    let (ash, ashen, yew, oak) =
        (Room::Tree("ash"), Room::Session("ashen"), Room::Tree("yew"), Room::Session("oak"));
    let out = async |person: &'static str, now: &'static str| {
        let mut out = Vec::new();
        for room in [ash, ashen, yew, oak, Room::Tree("elm"), Room::Session("gone")] {
            out.push(store.standing(room, person, now).await.unwrap().removed.is_some());
        }
        out
    };
    let nowhere = [false; 6];
    assert_eq!(out("login bo", NOW).await, nowhere);
    store.keep_out(removal("one", ash, "2026-05-01T13"), NOW).await.unwrap();
    assert_eq!(out("login bo", NOW).await, [true, true, false, false, false, false]);
    assert_eq!(out("login cy", NOW).await, nowhere);
    assert_eq!(out("login bo", "2026-05-01T13").await, nowhere, "it has ended");
    let why = store.standing(ashen, "login bo", NOW).await.unwrap().removed;
    assert_eq!(why, Some(Removed { by: "Ann".into(), is_revoked: false }));
    // Of a session of no tree.
    store.keep_out(removal("two", oak, "2026-05-01T14"), NOW).await.unwrap();
    assert_eq!(out("login bo", NOW).await, [true, true, false, true, false, false]);
    // A second time takes the place of the first.
    let longer = removal("three", ash, "2026-05-01T15");
    store.keep_out(longer.clone(), NOW).await.unwrap();
    assert_eq!(store.removals(ash, NOW).await.unwrap(), [longer]);
    assert!(!store.let_back("one").await.unwrap());
    assert!(store.let_back("three").await.unwrap());
    assert_eq!(out("login bo", NOW).await, [false, false, false, true, false, false]);
    assert!(store.removals(oak, "2026-05-01T14").await.unwrap().is_empty());
}

pub(super) async fn a_tree_is_handed_over_with_its_sessions(
    store: &(impl Standings + Library + Locks + Store),
) {
    planted(store).await;
    let heirs = async |person: &'static str| {
        let mut heirs = Vec::new();
        for room in [Room::Tree("ash"), Room::Session("ashen"), Room::Tree("yew"), Room::Session("oak")] {
            heirs.push(store.standing(room, person, NOW).await.unwrap().is_heir);
        }
        heirs
    };
    let heir = |person: &str| Some(Heir { person: person.into(), name: "Bo".into() });
    assert_eq!((heirs("login bo").await, store.heir_of("ash").await.unwrap()), (vec![false; 4], None));
    assert!(store.hand_over("ash", heir("login bo"), None).await.unwrap());
    assert!(!store.hand_over("elm", heir("login bo"), None).await.unwrap(), "there is no such tree");
    assert_eq!(heirs("login bo").await, [true, true, false, false]);
    assert_eq!(store.heir_of("ash").await.unwrap(), heir("login bo"));
    assert!(store.hand_over("ash", heir("login cy"), None).await.unwrap());
    assert_eq!((heirs("login bo").await, heirs("login cy").await[1]), (vec![false; 4], true));
    for to in [heir("login bo"), None] {
        assert!(!store.hand_over("ash", to, Some("login bo")).await.unwrap(), "they have it no longer");
    }
    assert!(store.hand_over("ash", heir("login cy"), Some("login cy")).await.unwrap());
    assert_eq!(store.heir_of("ash").await.unwrap(), heir("login cy"));
    assert!(store.hand_over("ash", None, None).await.unwrap());
    assert_eq!((heirs("login cy").await, store.heir_of("ash").await.unwrap()), (vec![false; 4], None));
    // All of it in one answer.
    store.lock_tree("ash", Some("Ann".into())).await.unwrap();
    let standing = store.standing(Room::Session("ashen"), "login bo", NOW).await.unwrap();
    let locked = Standing { locked_by: Some("Ann".into()), ..Standing::default() };
    assert_eq!(standing, locked);
    let deletion = Some(Deletion::Deleted(NOW.into()));
    store.change_tree("ash", None, TreeChange { deletion, ..TreeChange::default() }).await.unwrap();
    let standing = store.standing(Room::Session("ashen"), "login bo", NOW).await.unwrap();
    assert_eq!(standing, Standing { is_deleted: true, ..locked });
}
