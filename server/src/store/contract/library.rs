//! The contract of the library.

use super::{
    super::{
        Contents, Deletion, Library, Missing, NewSession, NewTree, NewVersion, Picture, Saved, SessionTree,
        Store, StoreError, StoredTree, TreeChange, TreeDocument, TreePlace, TreeQuery,
    },
    Breakable, entries, oak,
};

const NOON: &str = "2026-05-01T12:00:00.000Z";

/// A tree that is saved for the first time.
pub fn tree(id: &str, saved_at: &str) -> NewTree {
    tree_of_bytes(id, saved_at, id.as_bytes().to_vec())
}

/// The same with this document.
pub(in super::super) fn tree_of_bytes(id: &str, saved_at: &str, bytes: Vec<u8>) -> NewTree {
    let document = TreeDocument { simulation_version: 3, bytes };
    let (metamers, species) = (4_000_000_000, Some("oak".into()));
    let contents = Contents::New(Box::new(Saved { document, metamers, species, thumbnail: None }));
    NewTree { id: id.into(), name: format!("The {id}"), version: version(saved_at, contents) }
}

fn version(saved_at: &str, contents: Contents) -> NewVersion {
    NewVersion {
        saved_at: saved_at.into(),
        principal: "browser-1".into(),
        author: Some("Ada".into()),
        note: String::new(),
        contents,
        session: None,
    }
}

/// Another version of a tree, with this document.
fn again(bytes: &[u8]) -> NewVersion {
    NewVersion { note: "Again".into(), ..tree_of_bytes("", "2027", bytes.to_vec()).version }
}

fn of(tree: &str, number: u32) -> NewVersion {
    version("2028", Contents::Of { tree: tree.into(), version: number })
}

pub(super) fn page(limit: u32, after: Option<TreePlace>) -> TreeQuery {
    TreeQuery { limit, after, ..TreeQuery::default() }
}

fn place(tree: &StoredTree) -> TreePlace {
    TreePlace { value: tree.head.saved_at.clone(), id: tree.id.clone() }
}

pub(super) async fn ids(store: &impl Library, query: &TreeQuery) -> Vec<String> {
    store.trees(query).await.unwrap().into_iter().map(|tree| tree.id).collect()
}

async fn found(store: &impl Library, id: &str) -> StoredTree {
    store.tree(id).await.unwrap().unwrap()
}

async fn bytes(store: &impl Library, id: &str, version: u32) -> Vec<u8> {
    store.document(id, version).await.unwrap().unwrap().bytes
}

async fn delete(store: &impl Library, id: &str, at: &str) -> Result<(), StoreError> {
    let deletion = Some(Deletion::Deleted(at.into()));
    store.change_tree(id, None, TreeChange { deletion, ..TreeChange::default() }).await
}

fn renamed(name: &str) -> TreeChange {
    TreeChange { name: Some(name.into()), ..TreeChange::default() }
}

pub(super) async fn trees_are_listed_newest_first(store: &impl Library) {
    assert!(store.trees(&page(9, None)).await.unwrap().is_empty());
    for (id, hour) in [("ash", 9), ("birch", 8), ("cedar", 10)] {
        store.add_tree(tree(id, &format!("2026-05-01T{hour:02}:00:00.000Z"))).await.unwrap();
    }
    assert_eq!(ids(store, &page(9, None)).await, ["cedar", "ash", "birch"]);
    let ash = found(store, "ash").await;
    assert_eq!((ash.name.as_str(), ash.head.metamers, ash.revision), ("The ash", 4_000_000_000, 1));
    assert_eq!((ash.head.species.as_deref(), ash.head.author.as_deref()), (Some("oak"), Some("Ada")));
    assert_eq!(
        (ash.head.saved_at.as_str(), ash.created_at.as_str()),
        ("2026-05-01T09:00:00.000Z", "2026-05-01T09:00:00.000Z")
    );
    let behind = page(9, Some(place(&ash)));
    assert_eq!(ids(store, &behind).await, ["birch"]);
    // The tree at which a page ended may be gone by the next.
    delete(store, "ash", NOON).await.unwrap();
    assert_eq!(ids(store, &behind).await, ["birch"]);
    let change = TreeChange { is_template: Some(true), ..TreeChange::default() };
    store.change_tree("birch", None, change).await.unwrap();
    for (is_template, expected) in [(true, "birch"), (false, "cedar")] {
        let query = TreeQuery { is_template: Some(is_template), ..page(9, None) };
        assert_eq!(ids(store, &query).await, [expected]);
    }
}

/// ST5 of the contract: pages over equal times hold each tree once, while others are saved.
pub(super) async fn pages_hold_each_tree_once(store: &impl Library) {
    const TIME: &str = "2026-05-01T09:00:00.000Z";
    for number in 0..100 {
        store.add_tree(tree(&format!("tree-{number:03}"), TIME)).await.unwrap();
    }
    let mut seen: Vec<String> = Vec::new();
    let mut behind = None;
    while let Some(last) = {
        let page = store.trees(&page(7, behind.clone())).await.unwrap();
        seen.extend(page.iter().map(|tree| tree.id.clone()));
        page.last().map(place)
    } {
        behind = Some(last);
        store.add_tree(tree(&format!("young-{}", seen.len()), "2026-05-01T09:00:01.000Z")).await.unwrap();
    }
    let all: Vec<String> = (0..100).rev().map(|number| format!("tree-{number:03}")).collect();
    assert_eq!(seen, all);
}

pub(super) async fn trees_come_back_whole(store: &impl Breakable) {
    let picture = Picture { media_type: "image/png".into(), bytes: vec![1, 2, 3] };
    let mut ash = tree("ash", "2026");
    if let Contents::New(saved) = &mut ash.version.contents {
        saved.thumbnail = Some(picture.clone());
    }
    store.add_tree(ash).await.unwrap();
    store.add_tree(tree("birch", "2026")).await.unwrap();
    let document = TreeDocument { simulation_version: 3, bytes: b"ash".to_vec() };
    assert_eq!(store.document("ash", 1).await.unwrap(), Some(document));
    for (id, version) in [("elm", 1), ("ash", 0), ("ash", 2)] {
        assert_eq!(store.document(id, version).await.unwrap(), None);
        assert_eq!(store.thumbnail(id, version).await.unwrap(), None);
    }
    assert_eq!(store.thumbnail("ash", 1).await.unwrap(), Some(picture));
    assert_eq!(store.thumbnail("birch", 1).await.unwrap(), None);
    let damaged = async |id| matches!(store.document(id, 1).await, Err(StoreError::Damaged(_)));
    store.break_tree("birch").await;
    assert!(damaged("birch").await);
    assert!(!damaged("ash").await, "the others are whole");
    store.add_tree(tree("new", "2026")).await.unwrap();
    store.add_version("new", None, again(b"birch")).await.unwrap();
    assert!(store.document("new", 2).await.is_ok(), "what is saved now is not what was damaged before");
    store.swap_documents("new").await;
    assert!(damaged("new").await, "a version holds what was saved as that version");
    store.change_tree("ash", None, renamed("Old ash")).await.unwrap();
    assert!(!damaged("ash").await, "it is whole under its new name");
    store.break_name("ash").await;
    assert!(damaged("ash").await);
    store.change_tree("ash", None, renamed("Ash")).await.unwrap();
    store.add_version("ash", None, again(b"ash")).await.unwrap();
    assert!(damaged("ash").await, "neither another name nor another version mends anything");
}

pub(super) async fn every_save_is_a_version(store: &impl Library) {
    store.add_tree(tree("ash", "2026")).await.unwrap();
    for (bytes, number) in [(b"a".as_slice(), 2), (b"b", 3)] {
        assert_eq!(store.add_version("ash", None, again(bytes)).await.unwrap(), number);
    }
    assert_eq!(bytes(store, "ash", 1).await, b"ash");
    assert_eq!(bytes(store, "ash", 3).await, b"b");
    let numbers = async |limit, before| {
        let versions = store.versions("ash", limit, before).await.unwrap();
        versions.into_iter().map(|version| version.number).collect::<Vec<_>>()
    };
    assert_eq!(numbers(9, None).await, [3, 2, 1]);
    assert_eq!(numbers(1, Some(3)).await, [2]);
    assert_eq!(numbers(9, Some(1)).await, [0; 0]);
    assert!(store.versions("elm", 9, None).await.unwrap().is_empty());
    let change =
        |number| TreeChange { version_note: Some((number, "Before rain".into())), ..TreeChange::default() };
    store.change_tree("ash", None, change(2)).await.unwrap();
    let notes: Vec<_> = store.versions("ash", 9, None).await.unwrap().into_iter().map(|it| it.note).collect();
    assert_eq!(notes, ["Again", "Before rain", ""]);
    assert!(matches!(
        store.change_tree("ash", None, change(4)).await,
        Err(StoreError::NotFound(Missing::Version))
    ));
    let ash = found(store, "ash").await;
    assert_eq!((ash.head.number, ash.head.saved_at.as_str(), ash.created_at.as_str()), (3, "2027", "2026"));
    assert_eq!(ash.note, "", "what is said of the tree is its own");
}

/// ST4 of the contract: of two who change the same revision one wins.
pub(super) async fn one_of_two_wins(store: &impl Library) {
    store.add_tree(tree("ash", "2026")).await.unwrap();
    let (first, second) = tokio::join!(
        store.add_version("ash", Some(1), again(b"a")),
        store.add_version("ash", Some(1), again(b"b")),
    );
    let stale = |result: &Result<u32, StoreError>| matches!(result, Err(StoreError::Stale));
    assert!(stale(&first) != stale(&second), "{first:?} {second:?}");
    assert_eq!(found(store, "ash").await.revision, 2);
    let late = store.change_tree("ash", Some(1), renamed("Late")).await;
    assert!(matches!(late, Err(StoreError::Stale)));
    store.change_tree("ash", Some(2), renamed("In time")).await.unwrap();
    let ash = found(store, "ash").await;
    assert_eq!((ash.name.as_str(), ash.revision, ash.head.number), ("In time", 3, 2));
    let nowhere = store.change_tree("elm", None, renamed("Elm")).await;
    assert!(matches!(nowhere, Err(StoreError::NotFound(Missing::Tree))));
    let nowhere = store.add_version("elm", None, again(b"c")).await;
    assert!(matches!(nowhere, Err(StoreError::NotFound(Missing::Tree))));
}

pub(super) async fn versions_are_restored_and_copied(store: &impl Library) {
    store.add_tree(tree("ash", "2026")).await.unwrap();
    store.add_version("ash", None, again(b"later")).await.unwrap();
    assert_eq!(store.add_version("ash", None, of("ash", 1)).await.unwrap(), 3);
    assert_eq!(bytes(store, "ash", 3).await, b"ash");
    assert_eq!(bytes(store, "ash", 2).await, b"later", "nothing is lost by going back");
    let versions = store.versions("ash", 9, None).await.unwrap();
    assert_eq!(versions.iter().map(|version| version.restored).collect::<Vec<_>>(), [Some(1), None, None]);
    let copy = |id: &str, number| NewTree { id: id.into(), name: "Copy".into(), version: of("ash", number) };
    store.add_tree(copy("branch", 2)).await.unwrap();
    assert_eq!(bytes(store, "branch", 1).await, b"later");
    let branch = found(store, "branch").await;
    assert_eq!((branch.origin, branch.head.restored), (Some(("ash".into(), 2)), None));
    assert_eq!((branch.head.metamers, branch.head.number), (4_000_000_000, 1));
    let no_version = store.add_tree(copy("none", 7)).await;
    assert!(matches!(no_version, Err(StoreError::NotFound(Missing::Version))));
    assert_eq!(store.tree("none").await.unwrap(), None, "nothing is made by halves");
    store.add_version("branch", None, again(b"other")).await.unwrap();
    assert_eq!(found(store, "ash").await.head.number, 3, "each goes its own way");
}

/// ST7 of the contract.
pub(super) async fn what_is_deleted_comes_back_whole(store: &impl Library) {
    store.add_tree(tree("ash", "2026")).await.unwrap();
    store.add_tree(tree("elm", "2026")).await.unwrap();
    store.add_version("ash", None, again(b"later")).await.unwrap();
    let change = TreeChange { note: Some("Dear".into()), is_template: Some(true), ..renamed("Old ash") };
    store.change_tree("ash", None, change).await.unwrap();
    let before = found(store, "ash").await;
    delete(store, "ash", NOON).await.unwrap();
    let deleted = TreeQuery { is_deleted: true, ..page(9, None) };
    assert_eq!(
        (ids(store, &deleted).await, ids(store, &page(9, None)).await),
        (vec!["ash".into()], vec!["elm".into()])
    );
    assert_eq!(found(store, "ash").await.deleted_at.as_deref(), Some(NOON));
    let gone = |result: Result<(), StoreError>| {
        assert!(matches!(result, Err(StoreError::NotFound(Missing::Tree))), "{result:?}");
    };
    gone(delete(store, "ash", NOON).await);
    gone(store.change_tree("ash", None, renamed("Gone")).await);
    gone(store.add_version("ash", None, again(b"x")).await.map(drop));
    gone(store.add_version("elm", None, of("ash", 1)).await.map(drop));
    let undelete = || TreeChange { deletion: Some(Deletion::Undeleted), ..TreeChange::default() };
    let for_good = TreeChange { deletion: Some(Deletion::ForGood), ..TreeChange::default() };
    for change in [undelete(), for_good] {
        let refused = store.change_tree("elm", None, change).await;
        assert!(matches!(refused, Err(StoreError::NotDeleted)), "{refused:?}");
    }
    store.change_tree("ash", None, undelete()).await.unwrap();
    let after = found(store, "ash").await;
    assert_eq!(StoredTree { revision: before.revision, ..after }, before);
    assert_eq!(bytes(store, "ash", 2).await, b"later");
}

pub(super) async fn what_was_deleted_long_ago_goes(store: &impl Library) {
    for id in ["ash", "birch", "cedar", "elm"] {
        store.add_tree(tree(id, "2026")).await.unwrap();
    }
    let copy = NewTree { id: "copy".into(), name: "Copy".into(), version: of("ash", 1) };
    store.add_tree(copy).await.unwrap();
    for (id, at) in [("ash", "2026-01"), ("birch", "2026-02"), ("cedar", "2026-03")] {
        delete(store, id, at).await.unwrap();
    }
    assert_eq!(store.purge("2026-03", 1).await.unwrap(), 1);
    assert_eq!(store.tree("ash").await.unwrap(), None);
    assert_eq!(store.purge("2026-03", 9).await.unwrap(), 1);
    assert_eq!(store.purge("2026-03", 9).await.unwrap(), 0);
    assert!(store.tree("cedar").await.unwrap().is_some(), "it is not time yet");
    assert_eq!(bytes(store, "copy", 1).await, b"ash", "what others hold stays");
    assert_eq!(bytes(store, "elm", 1).await, b"elm");
}

pub(super) async fn sessions_belong_to_trees(store: &(impl Store + Library)) {
    store.create_session(oak(None)).await.unwrap();
    let lease = store.acquire("oak").await.unwrap();
    assert_eq!(store.tree_of("oak").await.unwrap(), None);
    store.append(&lease, 3, &entries(1..=3)).await.unwrap();
    let from = |mut version: NewVersion, through| {
        version.session = Some(("oak".into(), through));
        version
    };
    let ash = tree("ash", "2026");
    store.add_tree(NewTree { version: from(ash.version.clone(), 2), ..ash }).await.unwrap();
    let of_oak = async || store.tree_of("oak").await.unwrap();
    let belongs = |version, is_saved| Some(SessionTree { id: "ash".into(), version, is_saved });
    assert_eq!(of_oak().await, belongs(1, false), "entry 3 is in no version");
    store.add_version("ash", None, from(again(b"later"), 3)).await.unwrap();
    assert_eq!(of_oak().await, belongs(2, true));
    assert_eq!(found(store, "ash").await.session.as_deref(), Some("oak"));
    store.append(&lease, 3, &entries(4..=4)).await.unwrap();
    assert_eq!(of_oak().await, belongs(2, false));

    let opened = NewSession { name: "opened".into(), tree: Some(("ash".into(), 1)), ..oak(Some(b"ash")) };
    store.create_session(opened).await.unwrap();
    assert_eq!(store.tree_of("opened").await.unwrap(), belongs(1, true), "nothing was done in it yet");
    assert_eq!(found(store, "ash").await.session.as_deref(), Some("oak"), "an old version is not the tree");
    let opened = NewSession { name: "newest".into(), tree: Some(("ash".into(), 2)), ..oak(Some(b"later")) };
    store.create_session(opened).await.unwrap();
    assert_eq!(found(store, "ash").await.session.as_deref(), Some("newest"));
    let beside = NewSession {
        name: "beside".into(),
        tree: Some(("ash".into(), 2)),
        is_beside: true,
        ..oak(Some(b"later"))
    };
    store.create_session(beside).await.unwrap();
    assert_eq!(store.tree_of("beside").await.unwrap(), belongs(2, true));
    assert_eq!(found(store, "ash").await.session.as_deref(), Some("newest"), "people work in that one");
    delete(store, "ash", "2026").await.unwrap();
    store.purge("2027", 9).await.unwrap();
    assert_eq!(store.tree_of("newest").await.unwrap(), None);
    assert!(store.has_session("newest").await.unwrap(), "who is working goes on");
}
