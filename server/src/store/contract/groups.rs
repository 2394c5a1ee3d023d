//! The contract of groups of users.

use espalier_proto::access::Role;

use super::{
    super::{Group, Groups, Missing, Pass, PassKind, Passes, StoreError, User, UserChange, Users},
    passes::{NOW, hash, pass},
};

fn group(name: &str, role: Role, members: &[&str]) -> Group {
    let members = members.iter().map(|&name| name.to_owned()).collect();
    Group { name: name.into(), role, created_at: "2026-04-01T12:00:00.000Z".into(), members }
}

async fn add_users(store: &impl Users, users: &[(&str, Role)]) {
    for &(name, role) in users {
        let (password, created_at) = ("hash".into(), "2026-04-01T12:00:00.000Z".into());
        store
            .add_user(User { name: name.into(), role, group_role: None, password, created_at })
            .await
            .unwrap();
    }
}

pub(super) async fn groups_are_listed_with_their_members(store: &(impl Groups + Users)) {
    add_users(store, &[("Ada", Role::Viewer), ("Bö", Role::Viewer)]).await;
    assert_eq!(store.groups().await.unwrap(), []);
    store.add_group(group("Studio Süd", Role::Editor, &[])).await.unwrap();
    store.add_group(group("Class", Role::Viewer, &[])).await.unwrap();
    let taken = store.add_group(group("STUDIO SUD", Role::Viewer, &[])).await;
    assert!(matches!(taken, Err(StoreError::Taken)));
    for user in ["bo", "Ada", "ada"] {
        store.join_group("studio sud", user).await.unwrap();
    }
    let missing = |joined| match joined {
        Err(StoreError::NotFound(what)) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(missing(store.join_group("Choir", "Ada").await), Missing::Group);
    assert_eq!(missing(store.join_group("Class", "Cy").await), Missing::User);
    let studio = group("Studio Süd", Role::Editor, &["Ada", "Bö"]);
    assert_eq!(store.groups().await.unwrap(), [group("Class", Role::Viewer, &[]), studio]);
    assert!(store.leave_group("Studio Süd", "BÖ").await.unwrap());
    assert!(!store.leave_group("Studio Süd", "Bö").await.unwrap());
    assert!(!store.leave_group("Choir", "Ada").await.unwrap());
    assert!(store.remove_user("Ada").await.unwrap());
    assert!(store.remove_group("class").await.unwrap());
    assert!(!store.remove_group("class").await.unwrap());
    assert_eq!(store.groups().await.unwrap(), [group("Studio Süd", Role::Editor, &[])]);
    // Who has the name of somebody who was removed is not in their groups.
    add_users(store, &[("Ada", Role::Viewer)]).await;
    assert_eq!(store.groups().await.unwrap(), [group("Studio Süd", Role::Editor, &[])]);
}

pub(super) async fn a_login_may_what_its_users_groups_may(store: &(impl Groups + Passes + Users)) {
    add_users(store, &[("Ada", Role::Viewer), ("Bo", Role::Owner)]).await;
    for (byte, name) in [(1, "Ada"), (2, "Bo")] {
        store.add_pass(hash(byte), Pass { name: name.into(), ..pass(name, PassKind::Login) }).await.unwrap();
    }
    // A device may be called as somebody is.
    store.add_pass(hash(3), Pass { name: "Ada".into(), ..pass("device", PassKind::Device) }).await.unwrap();
    let device = store.pass(hash(3), NOW).await.unwrap();
    store.add_group(group("Studio", Role::Editor, &[])).await.unwrap();
    store.add_group(group("Class", Role::Viewer, &[])).await.unwrap();
    for (group, user) in [("Studio", "Ada"), ("Class", "Ada"), ("Studio", "Bo")] {
        store.join_group(group, user).await.unwrap();
    }
    let roles = async || {
        let (ada, bo) = (store.pass(hash(1), NOW).await.unwrap(), store.pass(hash(2), NOW).await.unwrap());
        let user = store.user("Ada").await.unwrap().unwrap();
        let listed = store.users().await.unwrap().into_iter().find(|other| other.name == "Ada").unwrap();
        assert_eq!(listed, user);
        assert_eq!(ada.as_ref().map(|pass| pass.role), Some(user.allowed()));
        let mut all = store.passes(PassKind::Login, NOW).await.unwrap().into_iter();
        assert_eq!(all.find(|pass| pass.name == "Ada"), ada);
        (user.allowed(), bo.unwrap().role)
    };
    assert_eq!(roles().await, (Role::Editor, Role::Owner));
    assert!(store.change_group("Studio", Role::Owner).await.unwrap());
    assert!(!store.change_group("Choir", Role::Owner).await.unwrap());
    assert_eq!(roles().await, (Role::Owner, Role::Owner));
    assert!(store.change_user("Bo", UserChange::Role(Role::Admin)).await.unwrap());
    assert!(store.change_user("Ada", UserChange::Role(Role::Editor)).await.unwrap());
    assert_eq!(roles().await, (Role::Owner, Role::Admin));
    assert!(store.leave_group("Studio", "Ada").await.unwrap());
    assert_eq!(roles().await, (Role::Editor, Role::Admin));
    store.join_group("Studio", "Ada").await.unwrap();
    assert!(store.remove_group("Studio").await.unwrap());
    assert_eq!(roles().await, (Role::Editor, Role::Admin));
    assert_eq!(store.pass(hash(3), NOW).await.unwrap(), device);
}
