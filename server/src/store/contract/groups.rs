//! The contract of groups of users.

use espalier_proto::access::Role;

use super::{
    super::{
        Group, GroupChange, Groups, Missing, Pass, PassKind, Passes, StoreError, Terms, UserChange, Users,
    },
    passes::{NOW, hash, pass},
    users::{login_of, user},
};

pub(super) fn group(name: &str, role: Role, members: &[&str]) -> Group {
    let members = members.iter().map(|&name| name.to_owned()).collect();
    let (id, created_at) = (format!("key of {name}"), "2026-04-01T12:00:00.000Z".into());
    Group { id, name: name.into(), role, created_at, members, revision: 1 }
}

fn to(role: Role) -> GroupChange {
    GroupChange { role: Some(role), name: None }
}

async fn add_users(store: &impl Users, users: &[(&str, Role)]) {
    for &(name, role) in users {
        store.add_user(user(name, role)).await.unwrap();
    }
}

pub(super) async fn groups_are_listed_with_their_members(store: &(impl Groups + Users)) {
    add_users(store, &[("Ada", Role::Viewer), ("Bö", Role::Viewer)]).await;
    assert_eq!(store.groups().await.unwrap(), []);
    store.add_group(group("Studio Süd", Role::Editor, &[])).await.unwrap();
    store.add_group(group("Class", Role::Viewer, &[])).await.unwrap();
    let taken = store.add_group(group("STUDIO SUD", Role::Viewer, &[])).await;
    assert!(matches!(taken, Err(StoreError::Taken)));
    for user in ["Bö's key", "Ada's key", "Ada's key"] {
        store.join_group("key of Studio Süd", user, None).await.unwrap();
    }
    let missing = |joined| match joined {
        Err(StoreError::NotFound(what)) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(missing(store.join_group("key of Choir", "Ada's key", None).await), Missing::Group);
    assert_eq!(missing(store.join_group("key of Class", "Cy's key", None).await), Missing::User);
    let studio = group("Studio Süd", Role::Editor, &["Ada", "Bö"]);
    let at = |revision, group: Group| Group { revision, ..group };
    let studio = at(3, studio);
    assert_eq!(
        store.groups().await.unwrap(),
        [group("Class", Role::Viewer, &[]), studio],
        "each who joins counts"
    );
    assert!(store.leave_group("key of Studio Süd", "Bö's key", None).await.unwrap());
    assert!(!store.leave_group("key of Studio Süd", "Bö's key", None).await.unwrap());
    assert!(!store.leave_group("key of Choir", "Ada's key", None).await.unwrap());
    assert!(store.remove_user("Ada's key", Terms::default()).await.unwrap());
    assert!(store.remove_group("key of Class", None).await.unwrap());
    assert!(!store.remove_group("key of Class", None).await.unwrap());
    assert_eq!(store.groups().await.unwrap(), [at(4, group("Studio Süd", Role::Editor, &[]))]);
    // Who has the name of somebody who was removed is not in their groups.
    add_users(store, &[("Ada", Role::Viewer)]).await;
    assert_eq!(store.groups().await.unwrap(), [at(4, group("Studio Süd", Role::Editor, &[]))]);
}

pub(super) async fn a_login_may_what_its_users_groups_may(store: &(impl Groups + Passes + Users)) {
    add_users(store, &[("Ada", Role::Viewer), ("Bo", Role::Owner)]).await;
    for (byte, name) in [(1, "Ada"), (2, "Bo")] {
        store.add_pass(hash(byte), login_of(name, name)).await.unwrap();
    }
    // A device may be called as somebody is.
    store.add_pass(hash(3), Pass { name: "Ada".into(), ..pass("device", PassKind::Device) }).await.unwrap();
    let device = store.pass(hash(3), NOW).await.unwrap();
    store.add_group(group("Studio", Role::Editor, &[])).await.unwrap();
    store.add_group(group("Class", Role::Viewer, &[])).await.unwrap();
    for (group, user) in [("Studio", "Ada"), ("Class", "Ada"), ("Studio", "Bo")] {
        store.join_group(&format!("key of {group}"), &format!("{user}'s key"), None).await.unwrap();
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
    assert!(store.change_group("key of Studio", to(Role::Owner), None).await.unwrap());
    assert!(!store.change_group("key of Choir", to(Role::Owner), None).await.unwrap());
    assert_eq!(roles().await, (Role::Owner, Role::Owner));
    assert!(store.change_user("Bo's key", UserChange::role(Role::Admin), Terms::default()).await.unwrap());
    assert!(store.change_user("Ada's key", UserChange::role(Role::Editor), Terms::default()).await.unwrap());
    assert_eq!(roles().await, (Role::Owner, Role::Admin));
    assert!(store.leave_group("key of Studio", "Ada's key", None).await.unwrap());
    assert_eq!(roles().await, (Role::Editor, Role::Admin));
    store.join_group("key of Studio", "Ada's key", None).await.unwrap();
    assert!(store.remove_group("key of Studio", None).await.unwrap());
    assert_eq!(roles().await, (Role::Editor, Role::Admin));
    assert_eq!(store.pass(hash(3), NOW).await.unwrap(), device);
}

pub(super) async fn a_group_changes_at_a_revision(store: &(impl Groups + Users)) {
    add_users(store, &[("Ada", Role::Viewer)]).await;
    store.add_group(group("Studio", Role::Editor, &[])).await.unwrap();
    store.add_group(group("Class", Role::Viewer, &[])).await.unwrap();
    let named = |name: &str| GroupChange { name: Some(name.into()), role: None };
    let stale = |done: Result<bool, StoreError>| matches!(done, Err(StoreError::Stale));
    assert!(stale(store.change_group("key of Studio", named("Nursery"), Some(2)).await));
    assert!(stale(store.remove_group("key of Studio", Some(2)).await));
    assert!(stale(store.leave_group("key of Studio", "Ada's key", Some(2)).await));
    assert!(stale(store.join_group("key of Studio", "Ada's key", Some(2)).await.map(|()| true)));
    assert!(matches!(
        store.change_group("key of Studio", named("CLASS"), None).await,
        Err(StoreError::Taken)
    ));
    store.join_group("key of Studio", "Ada's key", Some(1)).await.unwrap();
    store.join_group("key of Studio", "Ada's key", Some(2)).await.unwrap();
    assert!(store.change_group("key of Studio", named("Nursery"), Some(2)).await.unwrap());
    let nursery =
        Group { id: "key of Studio".into(), revision: 3, ..group("Nursery", Role::Editor, &["Ada"]) };
    assert_eq!(store.groups().await.unwrap(), [group("Class", Role::Viewer, &[]), nursery]);
    assert!(store.change_group("key of Studio", named("NURSERY"), None).await.unwrap(), "it is its own name");
    assert!(store.remove_group("key of Studio", Some(4)).await.unwrap());
}
