//! The contract of who has been in which session.

use espalier_proto::access::Role;

use super::{
    super::{
        Comments, Library, NewComment, NewSession, NewSnapshot, SessionLine, SessionQuery, Store, Terms,
        Users, Visits, person_of,
    },
    entries,
    library::tree,
    users::user,
};

const ANN: &str = "login ann";
const BO: &str = "login bo";

async fn begin(store: &impl Store, name: &str, person: &str, tree: Option<(String, u32)>) {
    let (name, person) = (name.to_owned(), Some(person.to_owned()));
    let new = NewSession { name, person, tree, snapshot: Some(b"seed".to_vec()), ..NewSession::default() };
    store.create_session(new).await.unwrap();
}

async fn draw(store: &impl Store, name: &str) {
    let lease = store.acquire(name).await.unwrap();
    store.append(&lease, 0, &entries(1..=1)).await.unwrap();
    store.release(lease).await;
}

async fn listed(store: &impl Visits, query: SessionQuery) -> Vec<SessionLine> {
    store.sessions(&SessionQuery { limit: query.limit.max(1), ..query }).await.unwrap()
}

async fn names(store: &impl Visits, query: SessionQuery) -> Vec<String> {
    let mut names: Vec<String> =
        listed(store, SessionQuery { limit: 99, ..query }).await.into_iter().map(|line| line.name).collect();
    names.sort();
    names
}

fn of(person: &str) -> SessionQuery {
    SessionQuery { person: Some(person.into()), ..SessionQuery::default() }
}

fn unsaved() -> SessionQuery {
    SessionQuery { is_saved: Some(false), ..SessionQuery::default() }
}

pub(super) async fn sessions_are_listed_to_who_was_in_them(store: &(impl Store + Library + Visits)) {
    store.add_tree(tree("ash", "2026")).await.unwrap();
    begin(store, "sketch", ANN, None).await;
    begin(store, "ashen", BO, Some(("ash".into(), 1))).await;
    begin(store, "seedling", BO, None).await;
    draw(store, "sketch").await;

    assert_eq!(names(store, SessionQuery::default()).await, ["ashen", "seedling", "sketch"]);
    assert_eq!(names(store, of(ANN)).await, ["sketch"]);
    assert_eq!(names(store, of(BO)).await, ["ashen", "seedling"]);
    assert_eq!(names(store, of("login cy")).await, [""; 0]);
    assert_eq!(names(store, unsaved()).await, ["sketch"], "to the others nothing was done");
    let of_ash = SessionQuery { tree: Some("ash".into()), ..SessionQuery::default() };
    assert_eq!(names(store, of_ash).await, ["ashen"]);
    let line = listed(store, SessionQuery { tree: Some("ash".into()), ..of(BO) }).await.remove(0);
    let tree = line.tree.unwrap();
    assert_eq!((&*tree.id, tree.version, line.is_saved), ("ash", 1, true));

    store.visit("sketch", BO).await.unwrap();
    store.visit("sketch", BO).await.unwrap();
    store.visit("nowhere", BO).await.unwrap();
    assert_eq!(names(store, of(BO)).await, ["ashen", "seedling", "sketch"]);
    draw(store, "ashen").await;
    assert_eq!(names(store, unsaved()).await, ["ashen", "sketch"]);
}

pub(super) async fn sessions_are_taken_off_lists(store: &(impl Store + Visits)) {
    begin(store, "sketch", ANN, None).await;
    store.visit("sketch", BO).await.unwrap();
    assert!(store.forget_session("sketch", Some(BO)).await.unwrap());
    assert!(!store.forget_session("sketch", Some(BO)).await.unwrap());
    assert_eq!((names(store, of(BO)).await.len(), names(store, of(ANN)).await.len()), (0, 1));
    assert!(store.forget_session("sketch", None).await.unwrap());
    assert!(!store.forget_session("sketch", None).await.unwrap());
    assert!(!store.forget_session("nowhere", None).await.unwrap());
    assert_eq!(names(store, of(ANN)).await.len(), 0);
    assert!(store.has_session("sketch").await.unwrap(), "its link leads to it still");
    store.visit("sketch", ANN).await.unwrap();
    assert_eq!((names(store, of(BO)).await.len(), names(store, of(ANN)).await.len()), (0, 1));
}

pub(super) async fn who_is_removed_was_in_no_session(
    store: &(impl Store + Library + Visits + Users + Comments),
) {
    let [ann, bo] = ["Änn", "Bo"].map(|name| (name, person_of(name)));
    assert_eq!((&*ann.1, &*bo.1), (ANN, BO));
    store.add_tree(tree("ash", "2026")).await.unwrap();
    let said = NewComment { person: BO.into(), ..NewComment::default() };
    store.add_thread("ash", None, said).await.unwrap();
    begin(store, "sketch", ANN, None).await;
    store.visit("sketch", BO).await.unwrap();
    for (name, person) in [&ann, &bo] {
        store.add_user(user(name, Role::Editor)).await.unwrap();
        assert!(store.see_thread("ash", person, 1, 1).await.unwrap());
    }
    assert!(store.remove_user("Änn's key", Terms::default()).await.unwrap());
    // Whoever is called so next begins with nothing; the other keeps what was theirs.
    assert_eq!((names(store, of(ANN)).await, names(store, of(BO)).await), (vec![], vec!["sketch".into()]));
    assert_eq!(store.seen_threads("ash", ANN).await.unwrap(), []);
    assert_eq!(store.seen_threads("ash", BO).await.unwrap(), [(1, 1)]);
    assert!(store.has_session("sketch").await.unwrap());
}

pub(super) async fn pages_hold_each_session_once(store: &(impl Store + Visits)) {
    let all: Vec<String> = (0..7).map(|number| format!("oak-{number}")).collect();
    for name in &all {
        begin(store, name, ANN, None).await;
    }
    let (mut seen, mut after) = (Vec::new(), None);
    loop {
        let page = listed(store, SessionQuery { limit: 3, after, ..of(ANN) }).await;
        let Some(last) = page.last() else { break };
        after = Some(last.place());
        seen.extend(page.into_iter().map(|line| (line.used_at, line.name)));
        begin(store, &format!("new-{}", seen.len()), ANN, None).await;
    }
    assert!(seen.iter().rev().is_sorted(), "{seen:?}");
    // What begins in the same millisecond may come behind; what was there before comes once.
    let mut names: Vec<String> = seen.into_iter().map(|(_, name)| name).collect();
    names.retain(|name| name.starts_with("oak"));
    names.sort();
    assert_eq!(names, all);
}

pub(super) async fn sessions_know_their_size(store: &(impl Store + Visits)) {
    begin(store, "sketch", ANN, None).await;
    let lease = store.acquire("sketch").await.unwrap();
    store.append(&lease, 0, &entries(1..=2)).await.unwrap();
    let snapshot = NewSnapshot { through: 2, simulation_version: 0, bytes: b"grown".to_vec(), metamers: 77 };
    store.keep_snapshot(&lease, snapshot).await.unwrap();
    assert_eq!(listed(store, of(ANN)).await[0].metamers, 77);
}
