//! The contract of what lets people in.

use espalier_proto::access::Role;

use super::{
    super::{Deletion, Holder, Library, Missing, Pass, PassKind, Passes, StoreError, TreeChange},
    library::tree,
};
use crate::access::SecretHash;

pub(super) const NOW: &str = "2026-05-01T12:00:00.000Z";
pub(super) const LATER: &str = "2026-05-01T12:00:00.001Z";

pub(super) fn pass(id: &str, kind: PassKind) -> Pass {
    Pass {
        id: id.into(),
        kind,
        name: format!("Ada's {id}"),
        role: Role::Editor,
        holder: None,
        most: None,
        tree: None,
        created_at: format!("2026-04-01T12:00:00.000Z {id}"),
        expires_at: LATER.into(),
        ends_at: "2026-10-01T12:00:00.000Z".into(),
    }
}

pub(super) fn hash(byte: u8) -> SecretHash {
    [byte; 32]
}

pub(super) async fn passes_let_in_until_they_expire(store: &impl Passes) {
    store.add_pass(hash(1), pass("tablet", PassKind::Device)).await.unwrap();
    store.add_pass(hash(2), pass("script", PassKind::Token)).await.unwrap();
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), Some(pass("tablet", PassKind::Device)));
    assert_eq!(store.pass(hash(3), NOW).await.unwrap(), None);
    assert_eq!(store.pass(hash(1), LATER).await.unwrap(), None, "it has expired");
    store.extend_pass("tablet", "2026-06-01T12:00:00.000Z").await.unwrap();
    let longer = store.pass(hash(1), LATER).await.unwrap().unwrap();
    assert_eq!((&*longer.id, &*longer.expires_at), ("tablet", "2026-06-01T12:00:00.000Z"));
    assert_eq!(store.pass(hash(2), LATER).await.unwrap(), None, "the other one has not changed");
    store.purge_passes(LATER).await.unwrap();
    assert_eq!(store.pass(hash(2), NOW).await.unwrap(), None, "it is forgotten");
    assert!(store.pass(hash(1), NOW).await.unwrap().is_some());
}

pub(super) async fn one_of_those_who_take_a_pass_has_it(store: &impl Passes) {
    store.add_pass(hash(1), pass("door", PassKind::Invitation)).await.unwrap();
    let taken = async || store.take_pass("door").await.unwrap();
    let (a, b, c) = tokio::join!(taken(), taken(), taken());
    assert_eq!([a, b, c].iter().filter(|&&it| it).count(), 1);
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), None);
    assert!(!taken().await);
}

pub(super) async fn one_of_those_who_redeem_an_invitation_has_come(store: &(impl Library + Passes)) {
    store.add_tree(tree("ash", "2026")).await.unwrap();
    let tree = Some("ash".to_owned());
    let invitation = Pass { tree: tree.clone(), ..pass("door", PassKind::Invitation) };
    let expires_at = "2026-06-01T12:00:00.000Z".to_owned();
    let device = Pass {
        created_at: NOW.into(),
        expires_at: expires_at.clone(),
        ends_at: expires_at,
        ..Pass { kind: PassKind::Device, ..invitation.clone() }
    };
    store.add_pass(hash(1), invitation.clone()).await.unwrap();
    let change = |deletion| TreeChange { deletion: Some(deletion), ..TreeChange::default() };
    store.change_tree("ash", None, change(Deletion::Deleted(NOW.into()))).await.unwrap();
    assert!(!store.redeem_pass(hash(2), &device).await.unwrap(), "its tree is deleted");
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), Some(invitation), "it waits");
    store.change_tree("ash", None, change(Deletion::Undeleted)).await.unwrap();
    let late = Pass { created_at: LATER.into(), ..device.clone() };
    assert!(!store.redeem_pass(hash(2), &late).await.unwrap(), "it has expired by then");
    let redeem = async |byte: u8| store.redeem_pass(hash(byte), &device).await.unwrap();
    let (a, b, c) = tokio::join!(redeem(3), redeem(4), redeem(5));
    assert_eq!([a, b, c].iter().filter(|&&it| it).count(), 1);
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), None, "its secret is used up");
    let come = [(a, 3), (b, 4), (c, 5)].into_iter().find(|(has_come, _)| *has_come).unwrap().1;
    assert_eq!(store.pass(hash(come), NOW).await.unwrap(), Some(device.clone()));
    assert!(!redeem(6).await, "a device is no invitation");
}

pub(super) async fn as_many_are_made_at_once_as_there_may_be(store: &(impl Library + Passes)) {
    let token = |id: &str| pass(id, PassKind::Token);
    store.add_pass(hash(1), pass("tablet", PassKind::Device)).await.unwrap();
    let of_tablet = |id: &str| {
        let (name, hash) = ("Ada's tablet".into(), hash(1));
        Pass { holder: Some(Holder::Device { id: "tablet".into(), hash, name }), ..token(id) }
    };
    let full = |made: Result<(), StoreError>| match made {
        Ok(()) => false,
        Err(StoreError::Full) => true,
        other => panic!("{other:?}"),
    };
    let add = async |byte: u8, pass| full(store.add_pass_up_to(2, hash(byte), pass).await);
    let (a, b, c) = tokio::join!(add(11, token("a")), add(12, token("b")), add(13, token("c")));
    assert_eq!([a, b, c].iter().filter(|&&full| full).count(), 1);
    let (a, b, c) = tokio::join!(add(21, of_tablet("d")), add(22, of_tablet("e")), add(23, of_tablet("f")));
    assert_eq!([a, b, c].iter().filter(|&&full| full).count(), 1, "those of others count for nothing");
    assert_eq!(store.passes(PassKind::Token, NOW).await.unwrap().len(), 4);
    assert!(
        !add(31, Pass { created_at: LATER.into(), ..token("g") }).await,
        "the others have expired by then"
    );
    // What lets in for one tree, as an invitation and as what came of it.
    store.add_tree(tree("ash", "2026")).await.unwrap();
    let of_ash = |id: &str, kind| Pass { tree: Some("ash".into()), ..pass(id, kind) };
    store.add_pass(hash(41), of_ash("h", PassKind::Device)).await.unwrap();
    assert!(!add(42, of_ash("i", PassKind::Invitation)).await);
    assert!(add(43, of_ash("j", PassKind::Invitation)).await);
}

pub(super) async fn a_pass_may_allow_something_else(store: &impl Passes) {
    store.add_pass(hash(1), pass("tablet", PassKind::Device)).await.unwrap();
    store.add_pass(hash(2), pass("phone", PassKind::Device)).await.unwrap();
    assert!(store.change_pass("tablet", Role::Viewer).await.unwrap());
    assert!(!store.change_pass("watch", Role::Viewer).await.unwrap());
    let changed = Pass { role: Role::Viewer, ..pass("tablet", PassKind::Device) };
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), Some(changed));
    assert_eq!(store.pass(hash(2), NOW).await.unwrap(), Some(pass("phone", PassKind::Device)));
}

pub(super) async fn passes_are_listed_by_kind(store: &impl Passes) {
    for (byte, id, kind) in [
        (1, "a", PassKind::Device),
        (2, "b", PassKind::Token),
        (3, "c", PassKind::Device),
        (4, "d", PassKind::Invitation),
    ] {
        store.add_pass(hash(byte), pass(id, kind)).await.unwrap();
    }
    let ids = async |kind, now| -> Vec<String> {
        store.passes(kind, now).await.unwrap().into_iter().map(|pass| pass.id).collect()
    };
    assert_eq!(ids(PassKind::Device, NOW).await, ["c", "a"]);
    assert_eq!(ids(PassKind::Token, NOW).await, ["b"]);
    assert_eq!(ids(PassKind::Invitation, NOW).await, ["d"]);
    assert!(ids(PassKind::Device, LATER).await.is_empty());
}

pub(super) async fn a_pass_for_a_tree_goes_with_it(store: &(impl Library + Passes)) {
    let of = |tree: &str| Pass { tree: Some(tree.into()), ..pass(tree, PassKind::Device) };
    store.add_tree(tree("ash", "2026")).await.unwrap();
    store.add_pass(hash(1), of("ash")).await.unwrap();
    let missing = store.add_pass(hash(2), of("elm")).await;
    assert!(matches!(missing, Err(StoreError::NotFound(Missing::Tree))));
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), Some(of("ash")));
    let deletion = Some(Deletion::Deleted("2026-01-01".into()));
    let change = TreeChange { deletion, ..TreeChange::default() };
    store.change_tree("ash", None, change).await.unwrap();
    store.purge("2026-02-01", 8).await.unwrap();
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), None);
}
