//! The contract of what is given to users and groups.

use std::collections::BTreeSet;

use espalier_proto::access::Role;

use super::{
    super::{
        Collection, CollectionChange, Deletion, Finding, Gift, Gifts, Given, Groups, Heir, Library, Missing,
        NewSession, Receiver, Room, SessionQuery, Standings, Store, StoreError, Terms, TreeChange, TreeQuery,
        UserChange, Users, Visits,
    },
    groups::group,
    library::tree,
    users::user,
};

const ADA: &str = "login ada";
const BO: &str = "login bo";

fn named(name: &str) -> Receiver {
    Receiver::User(name.into())
}

/// A wood with a grove, an ash in the grove, a yew in none; Ada, and Bo who is in the studio.
async fn planted(store: &(impl Gifts + Users + Groups + Library + Finding + Store)) {
    for (id, parent) in [("wood", None), ("grove", Some("wood".to_owned())), ("park", None)] {
        store.add_collection(Collection { id: id.into(), name: id.into(), parent, trees: 0 }).await.unwrap();
    }
    for id in ["ash", "yew"] {
        store.add_tree(tree(id, "2026-05-01T12:00:00.000Z")).await.unwrap();
    }
    put(store, "ash", Some("grove")).await;
    for (name, of) in [("ashen", "ash"), ("yewen", "yew")] {
        let (name, tree) = (name.to_owned(), Some((of.to_owned(), 1)));
        store.create_session(NewSession { name, tree, ..NewSession::default() }).await.unwrap();
    }
    for name in ["Ada", "Bo"] {
        store.add_user(user(name, Role::None)).await.unwrap();
    }
    store.add_group(group("Studio", Role::None, &[])).await.unwrap();
    store.join_group("key of Studio", "Bo's key", None).await.unwrap();
}

async fn put(store: &impl Library, tree: &str, collection: Option<&str>) {
    let collection = Some(collection.map(str::to_owned));
    store.change_tree(tree, None, TreeChange { collection, ..TreeChange::default() }).await.unwrap();
}

async fn seen(store: &(impl Library + Visits), person: &str) -> (Vec<String>, Vec<String>) {
    let seen_by = Some(person.to_owned());
    let trees = TreeQuery { seen_by: seen_by.clone(), ..TreeQuery::default() };
    let (person, tree, is_saved, limit, after) = (None, None, None, 9, None);
    let sessions = SessionQuery { person, tree, seen_by, is_saved, limit, after };
    let (trees, sessions) = (store.trees(&trees).await.unwrap(), store.sessions(&sessions).await.unwrap());
    let mut seen = (
        trees.into_iter().map(|tree| tree.id).collect::<Vec<_>>(),
        sessions.into_iter().map(|session| session.name).collect::<Vec<_>>(),
    );
    seen.0.sort();
    seen.1.sort();
    seen
}

pub(super) async fn a_tree_is_given_with_its_sessions(
    store: &(impl Gifts + Users + Groups + Library + Finding + Store + Visits + Standings),
) {
    planted(store).await;
    let ash = Gift::Tree("ash");
    let role = async |room, person| store.role_given(room, person).await.unwrap();
    let nothing = (vec![], vec![]);
    assert_eq!(seen(store, ADA).await, nothing);
    store.give(ash, &named("ada"), Role::Viewer).await.unwrap();
    store.give(ash, &Receiver::Group("studio".into()), Role::Editor).await.unwrap();
    for room in [Room::Tree("ash"), Room::Session("ashen")] {
        assert_eq!((role(room, ADA).await, role(room, BO).await), (Role::Viewer, Role::Editor), "{room:?}");
        assert_eq!((role(room, "machine").await, role(room, "pass x").await), (Role::None, Role::None));
    }
    for room in [Room::Tree("yew"), Room::Session("yewen"), Room::Tree("elm"), Room::Session("elmen")] {
        assert_eq!((role(room, ADA).await, role(room, BO).await), (Role::None, Role::None), "{room:?}");
    }
    let of_ash = (vec!["ash".to_owned()], vec!["ashen".to_owned()]);
    assert_eq!((seen(store, ADA).await, seen(store, BO).await), (of_ash.clone(), of_ash.clone()));
    let found = |q: &str, tag: Option<&str>| TreeQuery {
        seen_by: Some(ADA.into()),
        words: vec![q.to_owned()],
        tags: tag.into_iter().map(str::to_owned).collect(),
        ..TreeQuery::default()
    };
    assert_eq!(store.trees(&found("yew", None)).await.unwrap(), [], "searching finds no other one");
    // Given again it is given otherwise, and the greatest counts.
    store.give(ash, &named("Bo"), Role::Owner).await.unwrap();
    store.give(ash, &named("Ada"), Role::Commenter).await.unwrap();
    assert_eq!(
        (role(Room::Tree("ash"), ADA).await, role(Room::Tree("ash"), BO).await),
        (Role::Commenter, Role::Owner)
    );
    let given = |id: &str, to: Receiver, role| Given { id: id.into(), to, role };
    assert_eq!(
        store.given(ash).await.unwrap(),
        [
            given("key of Studio", Receiver::Group("Studio".into()), Role::Editor),
            given("Ada's key", named("Ada"), Role::Commenter),
            given("Bo's key", named("Bo"), Role::Owner),
        ]
    );
    assert_eq!(store.given(Gift::Tree("yew")).await.unwrap(), []);
    // Under another name she has it as well; what was handed over is seen, too.
    let cy = UserChange { name: Some("Cy".into()), ..UserChange::default() };
    assert!(store.change_user("Ada's key", cy, Terms::default()).await.unwrap());
    assert_eq!(
        (role(Room::Tree("ash"), "login cy").await, role(Room::Tree("ash"), ADA).await),
        (Role::Commenter, Role::None)
    );
    store.hand_over("yew", Some(Heir { person: "login cy".into(), name: "Cy".into() }), None).await.unwrap();
    assert_eq!(seen(store, "login cy").await.0, ["ash", "yew"]);
    // Taken back, gone with the user, with the membership, or deleted with the tree.
    assert!(store.take_back(ash, "Ada's key").await.unwrap());
    assert!(!store.take_back(ash, "Ada's key").await.unwrap());
    assert_eq!(role(Room::Tree("ash"), "login cy").await, Role::None);
    assert!(store.remove_user("Bo's key", Terms::default()).await.unwrap());
    store.add_user(user("Bo", Role::None)).await.unwrap();
    assert_eq!((role(Room::Tree("ash"), BO).await, seen(store, BO).await), (Role::None, nothing));
    let deletion = Some(Deletion::Deleted("2026-06".into()));
    store.change_tree("ash", None, TreeChange { deletion, ..TreeChange::default() }).await.unwrap();
    let missing = |done: Result<(), StoreError>| match done {
        Err(StoreError::NotFound(what)) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(missing(store.give(ash, &named("Bo"), Role::Viewer).await), Missing::Tree);
    assert_eq!(missing(store.give(Gift::Tree("yew"), &named("Di"), Role::Viewer).await), Missing::User);
    let choir = Receiver::Group("Choir".into());
    assert_eq!(missing(store.give(Gift::Tree("yew"), &choir, Role::Viewer).await), Missing::Group);
    assert_eq!(
        missing(store.give(Gift::Collection("elms"), &named("Bo"), Role::Viewer).await),
        Missing::Collection
    );
}

pub(super) async fn a_collection_is_given_with_what_lies_in_it(
    store: &(impl Gifts + Users + Groups + Library + Finding + Store + Visits),
) {
    planted(store).await;
    let role = async |room, person| store.role_given(room, person).await.unwrap();
    let within = async |collection: &str| store.role_in(collection, ADA).await.unwrap();
    let ids = |ids: &[&str]| ids.iter().map(|&id| id.to_owned()).collect::<BTreeSet<_>>();
    store.give(Gift::Collection("wood"), &named("Ada"), Role::Editor).await.unwrap();
    store.give(Gift::Collection("grove"), &named("Ada"), Role::Viewer).await.unwrap();
    store.give(Gift::Collection("park"), &Receiver::Group("Studio".into()), Role::Owner).await.unwrap();
    assert_eq!(
        (role(Room::Tree("ash"), ADA).await, role(Room::Session("ashen"), ADA).await),
        (Role::Editor, Role::Editor)
    );
    assert_eq!(
        (within("wood").await, within("grove").await, within("park").await),
        (Role::Editor, Role::Editor, Role::None)
    );
    assert_eq!(store.collections_of(ADA).await.unwrap(), ids(&["wood", "grove"]));
    assert_eq!(store.collections_of(BO).await.unwrap(), ids(&["park"]));
    assert_eq!(store.collections_of("machine").await.unwrap(), ids(&[]));
    assert_eq!(seen(store, ADA).await, (vec!["ash".into()], vec!["ashen".into()]));
    assert_eq!(role(Room::Tree("ash"), BO).await, Role::None);
    // What comes to lie there is given, and what goes is not.
    put(store, "yew", Some("park")).await;
    assert_eq!(
        (role(Room::Tree("yew"), BO).await, seen(store, BO).await.0),
        (Role::Owner, vec!["yew".to_owned()])
    );
    let parent = Some(Some("park".to_owned()));
    let change = CollectionChange { parent, ..CollectionChange::default() };
    store.change_collection("grove", change).await.unwrap();
    assert_eq!(
        (role(Room::Tree("ash"), ADA).await, role(Room::Tree("ash"), BO).await),
        (Role::Viewer, Role::Owner)
    );
    assert!(store.leave_group("key of Studio", "Bo's key", None).await.unwrap());
    assert_eq!((role(Room::Tree("ash"), BO).await, seen(store, BO).await.0.len()), (Role::None, 0));
    // What was given goes with the collection, not with the trees.
    store.delete_collection("grove").await.unwrap();
    assert_eq!((role(Room::Tree("ash"), ADA).await, seen(store, ADA).await.0.len()), (Role::None, 0));
    assert!(store.take_back(Gift::Collection("wood"), "Ada's key").await.unwrap());
    assert_eq!(store.collections_of(ADA).await.unwrap(), ids(&[]));
}
