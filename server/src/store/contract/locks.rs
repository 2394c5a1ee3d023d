//! The contract of locks.

use super::{
    super::{Library, Locks, NewSession, Room, Standings, Store},
    library::tree,
};

pub(super) async fn a_tree_is_locked_with_its_sessions(store: &(impl Locks + Standings + Library + Store)) {
    for id in ["ash", "yew"] {
        store.add_tree(tree(id, "2026-05-01T12:00:00.000Z")).await.unwrap();
    }
    for (name, tree) in [("oak", None), ("ashen", Some(("ash".to_owned(), 1)))] {
        let name = name.to_owned();
        store.create_session(NewSession { name, tree, ..NewSession::default() }).await.unwrap();
    }
    let locks = async || {
        let [ash, yew] = [store.lock_of("ash").await.unwrap(), store.lock_of("yew").await.unwrap()];
        let of = async |name| store.standing(Room::Session(name), "machine", "2026").await.unwrap().locked_by;
        let [oak, ashen] = [of("oak").await, of("ashen").await];
        [ash, yew, oak, ashen]
    };
    assert_eq!(locks().await, [None, None, None, None]);
    let ann = Some("Ann".to_owned());
    assert!(store.lock_tree("ash", ann.clone()).await.unwrap());
    assert!(!store.lock_tree("elm", ann.clone()).await.unwrap());
    assert_eq!(locks().await, [ann.clone(), None, None, ann]);
    assert!(store.lock_tree("ash", None).await.unwrap());
    assert_eq!(locks().await, [None, None, None, None]);
}
