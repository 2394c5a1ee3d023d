//! The contract of those who log in.

use espalier_proto::access::Role;

use super::{
    super::{Missing, Pass, PassKind, Passes, StoreError, User, UserChange, Users},
    passes::{NOW, hash, pass},
};

fn user(name: &str, role: Role) -> User {
    let created_at = "2026-04-01T12:00:00.000Z".into();
    User { name: name.into(), role, group_role: None, password: format!("hash of {name}"), created_at }
}

pub(super) async fn a_name_is_one_person(store: &impl Users) {
    store.add_user(user("Bö", Role::Viewer)).await.unwrap();
    store.add_user(user("Ada", Role::Admin)).await.unwrap();
    let taken = store.add_user(user("bo", Role::Editor)).await;
    assert!(matches!(taken, Err(StoreError::Taken)));
    assert_eq!(store.user("BO").await.unwrap(), Some(user("Bö", Role::Viewer)));
    assert_eq!(store.user("Cy").await.unwrap(), None);
    assert_eq!(store.users().await.unwrap(), [user("Ada", Role::Admin), user("Bö", Role::Viewer)]);
    assert!(store.remove_user("ada").await.unwrap());
    assert!(!store.remove_user("ada").await.unwrap());
    assert_eq!(store.users().await.unwrap(), [user("Bö", Role::Viewer)]);
}

pub(super) async fn a_login_has_the_role_of_its_user(store: &(impl Passes + Users)) {
    let login = |name: &str| pass(name, PassKind::Login);
    let of = |name: &str| Pass { name: name.into(), ..login(name) };
    let missing = store.add_pass(hash(1), of("Ada")).await;
    assert!(matches!(missing, Err(StoreError::NotFound(Missing::User))));
    store.add_user(user("Ada", Role::Viewer)).await.unwrap();
    store.add_user(user("Bo", Role::Viewer)).await.unwrap();
    for (byte, name) in [(1, "Ada"), (2, "Bo")] {
        store.add_pass(hash(byte), of(name)).await.unwrap();
    }
    let role = async |byte| store.pass(hash(byte), NOW).await.unwrap().map(|pass| pass.role);
    assert_eq!((role(1).await, role(2).await), (Some(Role::Viewer), Some(Role::Viewer)));
    assert!(store.change_user("ada", UserChange::Role(Role::Owner)).await.unwrap());
    assert_eq!((role(1).await, role(2).await), (Some(Role::Owner), Some(Role::Viewer)));
    assert!(!store.change_user("Cy", UserChange::Role(Role::Owner)).await.unwrap());

    assert!(store.change_user("ada", UserChange::Password("another".into())).await.unwrap());
    assert_eq!(store.user("Ada").await.unwrap().unwrap().password, "another");
    assert_eq!((role(1).await, role(2).await), (None, Some(Role::Viewer)), "a new password ends logins");
    assert!(store.remove_user("Bo").await.unwrap());
    assert_eq!(role(2).await, None);
}
