//! The contract of those who log in.

use espalier_proto::access::Role;

use super::{
    super::{
        Authors, Comments, Finding, Gift, Gifts, Group, Groups, Heir, Holder, Library, Missing, NewComment,
        NewSession, NewTree, NewVersion, Pass, PassKind, Passes, Receiver, Removal, Room, Standing,
        Standings, Store, StoreError, Terms, TreeQuery, User, UserChange, Users, Visits, identity_of,
        person_of,
    },
    library::tree,
    passes::{LATER, NOW, hash, pass},
};

pub(super) fn user(name: &str, role: Role) -> User {
    let created_at = "2026-04-01T12:00:00.000Z".into();
    let (id, password) = (format!("{name}'s key"), format!("hash of {name}"));
    User { id, name: name.into(), role, group_role: None, password, created_at, revision: 1 }
}

/// A login of the user that [`user`] makes by a name.
pub(super) fn login_of(name: &str, id: &str) -> Pass {
    let holder = Holder::User { id: format!("{name}'s key"), name: name.into() };
    Pass { name: name.into(), holder: Some(holder), ..pass(id, PassKind::Login) }
}

const FORCE: Terms = Terms { expected: None, force: true };

pub(super) async fn a_name_is_one_person(store: &impl Users) {
    store.add_user(user("Bö", Role::Viewer)).await.unwrap();
    store.add_user(user("Ada", Role::Admin)).await.unwrap();
    let taken = store.add_user(user("bo", Role::Editor)).await;
    assert!(matches!(taken, Err(StoreError::Taken)));
    assert_eq!(store.user("BO").await.unwrap(), Some(user("Bö", Role::Viewer)));
    assert_eq!(store.user("Cy").await.unwrap(), None);
    assert_eq!(store.users().await.unwrap(), [user("Ada", Role::Admin), user("Bö", Role::Viewer)]);
    assert!(store.remove_user("Ada's key", FORCE).await.unwrap());
    assert!(!store.remove_user("Ada's key", FORCE).await.unwrap());
    assert_eq!(store.users().await.unwrap(), [user("Bö", Role::Viewer)]);
}

pub(super) async fn a_login_has_the_role_of_its_user(store: &(impl Passes + Users)) {
    let of = |name: &str| login_of(name, name);
    let missing = store.add_pass(hash(1), of("Ada")).await;
    assert!(matches!(missing, Err(StoreError::NotFound(Missing::User))));
    store.add_user(user("Ada", Role::Viewer)).await.unwrap();
    store.add_user(user("Bo", Role::Viewer)).await.unwrap();
    for (byte, name) in [(1, "Ada"), (2, "Bo")] {
        store.add_pass(hash(byte), of(name)).await.unwrap();
    }
    let role = async |byte| store.pass(hash(byte), NOW).await.unwrap().map(|pass| pass.role);
    assert_eq!((role(1).await, role(2).await), (Some(Role::Viewer), Some(Role::Viewer)));
    assert!(store.change_user("Ada's key", UserChange::role(Role::Owner), Terms::default()).await.unwrap());
    assert_eq!((role(1).await, role(2).await), (Some(Role::Owner), Some(Role::Viewer)));
    assert!(!store.change_user("Cy's key", UserChange::role(Role::Owner), Terms::default()).await.unwrap());

    assert!(
        store
            .change_user("Ada's key", UserChange::password("another".into()), Terms::default())
            .await
            .unwrap()
    );
    assert_eq!(store.user("Ada").await.unwrap().unwrap().password, "another");
    assert_eq!((role(1).await, role(2).await), (None, Some(Role::Viewer)), "a new password ends logins");
    assert!(store.remove_user("Bo's key", Terms::default()).await.unwrap());
    assert_eq!(role(2).await, None);
}

pub(super) async fn the_last_administrator_stays(store: &impl Users) {
    for (name, role) in [("Ada", Role::Admin), ("Bo", Role::Admin), ("Cy", Role::Owner)] {
        store.add_user(user(name, role)).await.unwrap();
    }
    let is_last = |done: Result<bool, StoreError>| matches!(done, Err(StoreError::LastAdmin));
    let (viewer, admin) = (UserChange::role(Role::Viewer), UserChange::role(Role::Admin));
    assert!(store.change_user("Ada's key", viewer.clone(), Terms::default()).await.unwrap());
    for change in [viewer.clone(), UserChange { name: Some("Di".into()), ..viewer.clone() }] {
        assert!(is_last(store.change_user("Bo's key", change, Terms::default()).await));
    }
    assert!(is_last(store.remove_user("Bo's key", Terms::default()).await));
    assert_eq!(store.user("Bo").await.unwrap(), Some(user("Bo", Role::Admin)), "nothing has changed");
    assert!(store.change_user("Bo's key", admin, Terms::default()).await.unwrap());
    assert!(store.change_user("Bo's key", UserChange::password("p".into()), Terms::default()).await.unwrap());
    assert!(store.remove_user("Cy's key", Terms::default()).await.unwrap());
    assert!(store.change_user("Bo's key", viewer, FORCE).await.unwrap());
    assert!(store.users().await.unwrap().iter().all(|user| user.role == Role::Viewer));
}

pub(super) async fn a_user_changes_at_a_revision(store: &impl Users) {
    store.add_user(user("Ada", Role::Viewer)).await.unwrap();
    store.add_user(user("Bo", Role::Viewer)).await.unwrap();
    let at = |expected| Terms { expected: Some(expected), force: false };
    let is_stale = |done: Result<bool, StoreError>| matches!(done, Err(StoreError::Stale));
    let owner = UserChange::role(Role::Owner);
    assert!(is_stale(store.change_user("Ada's key", owner.clone(), at(2)).await));
    assert!(store.change_user("Ada's key", owner.clone(), at(1)).await.unwrap());
    assert!(is_stale(store.change_user("Ada's key", owner, at(1)).await));
    assert!(is_stale(store.remove_user("Ada's key", at(1)).await));
    let revisions: Vec<u64> = store.users().await.unwrap().iter().map(|user| user.revision).collect();
    assert_eq!(revisions, [2, 1]);
    assert!(store.remove_user("Ada's key", at(2)).await.unwrap());
}

/// What somebody has is theirs under another name, and whoever gets the old name has none of it.
pub(super) async fn under_another_name_one_is_the_same(
    store: &(impl Users + Groups + Passes + Visits + Finding + Standings + Comments + Library + Authors + Store),
) {
    for name in ["Ada", "Bo"] {
        store.add_user(user(name, Role::Viewer)).await.unwrap();
    }
    let (ada, cy) = (person_of("Ada"), person_of("Cy"));
    let NewTree { version, .. } = tree("ash", NOW);
    let version = NewVersion { principal: ada.clone(), ..version };
    store.add_tree(NewTree { version, ..tree("ash", NOW) }).await.unwrap();
    store.create_session(NewSession { name: "oak".into(), ..NewSession::default() }).await.unwrap();
    store.visit("oak", &ada).await.unwrap();
    store.set_favourite(&ada, "ash", true).await.unwrap();
    store.hand_over("ash", Some(Heir { person: ada.clone(), name: "Ada".into() }), None).await.unwrap();
    let (id, room) = ("r".into(), Room::Session("oak").written());
    let (person, name, by, until) = (ada.clone(), "Ada".into(), "Bo".into(), "9".into());
    let removal = Removal { id, room, person, name, by, until, is_revoked: false };
    store.keep_out(removal, NOW).await.unwrap();
    let said = r#"{"mentions":[{"name":"Ada","people":["login ada"]}],"text":"login ada"}"#;
    let (person, author, written_at) = (ada.clone(), "Ada".into(), NOW.into());
    let comment = NewComment { person, author, written_at, said: said.into(), picture: None };
    store.add_thread("ash", None, comment).await.unwrap();
    store.see_thread("ash", &ada, 1, 1).await.unwrap();
    let browser = espalier_session::Principal::client("browser-1").unwrap();
    let (author, identity) = (browser.clone(), identity_of("Ada's key"));
    let named = espalier_session::Named { author, person: Some(identity.into()), name: "Ada".into() };
    store.name_author(&named, NOW).await.unwrap();
    store.add_pass(hash(1), login_of("Ada", "login")).await.unwrap();
    let (id, name, created_at, members) = ("g".into(), "Studio".into(), "2026".into(), Vec::new());
    let studio = Group { id, name, role: Role::Editor, created_at, members, revision: 1 };
    store.add_group(studio).await.unwrap();
    store.join_group("g", "Ada's key", None).await.unwrap();

    let called = |name: &str| UserChange { name: Some(name.into()), ..UserChange::default() };
    let taken = store.change_user("Ada's key", called("BO"), Terms::default()).await;
    assert!(matches!(taken, Err(StoreError::Taken)));
    assert!(store.change_user("Ada's key", called("Cy"), Terms::default()).await.unwrap());
    let kept = store.user("Cy").await.unwrap().unwrap();
    assert_eq!((&*kept.id, &*kept.name, kept.allowed()), ("Ada's key", "Cy", Role::Editor));
    assert_eq!(store.user("Ada").await.unwrap(), None);
    assert_eq!(store.groups().await.unwrap()[0].members, ["Cy"]);
    let login = store.pass(hash(1), NOW).await.unwrap().unwrap();
    assert_eq!((&*login.name, login.role), ("Cy", Role::Editor));
    for (person, count) in [(&ada, 0), (&cy, 1)] {
        let mine = TreeQuery { saved_by: Some(person.clone()), ..TreeQuery::default() };
        assert_eq!(store.trees(&mine).await.unwrap().len(), count, "{person}");
        assert_eq!(store.favourites(person).await.unwrap().len(), count, "{person}");
        assert_eq!(store.seen_threads("ash", person).await.unwrap().len(), count, "{person}");
        let standing = store.standing(Room::Tree("ash"), person, NOW).await.unwrap();
        assert_eq!(standing.is_heir, count == 1, "{person}");
        let standing = store.standing(Room::Session("oak"), person, NOW).await.unwrap();
        assert_eq!(standing.removed.is_some(), count == 1, "{person}");
        assert_eq!(store.forget_session("oak", Some(person)).await.unwrap(), count == 1, "{person}");
    }
    let comment = &store.thread("ash", 1).await.unwrap().unwrap().comments[0];
    let expected = r#"{"mentions":[{"name":"Ada","people":["login cy"]}],"text":"login ada"}"#;
    assert_eq!((&*comment.person, &*comment.said), (&*cy, expected), "words stay as they were");
    assert_eq!(store.named_authors(std::slice::from_ref(&browser)).await.unwrap(), [named]);
}

/// Whoever has the name after somebody who was removed finds nothing of theirs.
pub(super) async fn nothing_is_left_to_a_namesake(
    store: &(
         impl Users + Groups + Gifts + Passes + Visits + Finding + Standings + Comments + Library + Authors + Store
     ),
) {
    store.add_user(user("Ada", Role::Viewer)).await.unwrap();
    let ada = person_of("Ada");
    let NewTree { version, .. } = tree("ash", NOW);
    let version = NewVersion { principal: ada.clone(), ..version };
    store.add_tree(NewTree { version, ..tree("ash", NOW) }).await.unwrap();
    store.create_session(NewSession { name: "oak".into(), ..NewSession::default() }).await.unwrap();
    store.visit("oak", &ada).await.unwrap();
    store.set_favourite(&ada, "ash", true).await.unwrap();
    store.hand_over("ash", Some(Heir { person: ada.clone(), name: "Ada".into() }), None).await.unwrap();
    store.give(Gift::Tree("ash"), &Receiver::User("Ada".into()), Role::Editor).await.unwrap();
    let (id, room) = ("r".into(), Room::Session("oak").written());
    let (name, by, until) = ("Ada".into(), "Bo".into(), "9".into());
    let removal = Removal { id, room, person: ada.clone(), name, by, until, is_revoked: false };
    store.keep_out(removal, NOW).await.unwrap();
    let said = r#"{"mentions":[{"name":"Ada","people":["login ada"]}],"text":"login ada"}"#;
    let (person, author, written_at) = (ada.clone(), "Ada".into(), NOW.into());
    let comment = NewComment { person, author, written_at, said: said.into(), picture: None };
    store.add_thread("ash", None, comment).await.unwrap();
    store.see_thread("ash", &ada, 1, 1).await.unwrap();
    let browser = espalier_session::Principal::client("browser-1").unwrap();
    let (author, name) = (browser.clone(), "Ada".into());
    let person = Some(identity_of("Ada's key").into());
    let named = espalier_session::Named { author, person, name };
    store.name_author(&named, NOW).await.unwrap();
    store.add_pass(hash(1), login_of("Ada", "login")).await.unwrap();
    let (id, name, created_at, members) = ("g".into(), "Studio".into(), "2026".into(), Vec::new());
    let studio = Group { id, name, role: Role::Editor, created_at, members, revision: 1 };
    store.add_group(studio).await.unwrap();
    store.join_group("g", "Ada's key", None).await.unwrap();

    assert!(store.remove_user("Ada's key", Terms::default()).await.unwrap());
    let namesake = User { id: "another key".into(), ..user("Ada", Role::Viewer) };
    store.add_user(namesake.clone()).await.unwrap();
    assert!(!store.remove_user("Ada's key", Terms::default()).await.unwrap(), "that is somebody else");
    assert!(!store.change_user("Ada's key", UserChange::role(Role::Admin), FORCE).await.unwrap());
    assert_eq!(store.user("Ada").await.unwrap(), Some(namesake));
    let missing = store.join_group("g", "Ada's key", None).await;
    assert!(matches!(missing, Err(StoreError::NotFound(Missing::User))));
    assert_eq!(store.groups().await.unwrap()[0].members, [""; 0]);
    assert_eq!(store.pass(hash(1), NOW).await.unwrap(), None);
    let mine = TreeQuery { saved_by: Some(ada.clone()), ..TreeQuery::default() };
    assert_eq!(store.trees(&mine).await.unwrap(), []);
    assert!(store.favourites(&ada).await.unwrap().is_empty());
    assert!(store.seen_threads("ash", &ada).await.unwrap().is_empty());
    assert_eq!(store.standing(Room::Tree("ash"), &ada, NOW).await.unwrap(), Standing::default());
    assert_eq!(store.standing(Room::Session("oak"), &ada, NOW).await.unwrap(), Standing::default());
    assert_eq!(store.role_given(Room::Tree("ash"), &ada).await.unwrap(), Role::None);
    assert_eq!(store.given(Gift::Tree("ash")).await.unwrap(), []);
    assert!(!store.forget_session("oak", Some(&ada)).await.unwrap());
    assert_eq!(store.named_authors(&[browser]).await.unwrap()[0].person, None);
    let comment = &store.thread("ash", 1).await.unwrap().unwrap().comments[0];
    let expected = r#"{"mentions":[{"name":"Ada","people":["removed Ada's key"]}],"text":"login ada"}"#;
    assert_eq!((&*comment.person, &*comment.said), ("removed Ada's key", expected));
    assert_eq!(comment.author, "Ada", "what was said stays");
}

pub(super) async fn a_token_may_what_whoever_holds_it_may(store: &(impl Passes + Users + Groups)) {
    store.add_user(user("Ada", Role::Editor)).await.unwrap();
    store.add_pass(hash(1), Pass { role: Role::Owner, ..pass("tablet", PassKind::Device) }).await.unwrap();
    let of_user = |id: &str| Some(Holder::User { id: id.into(), name: "Ada".into() });
    let of_device =
        |id: &str| Some(Holder::Device { id: id.into(), hash: hash(1), name: "Ada's tablet".into() });
    let token = |id: &str, holder| Pass {
        holder,
        ends_at: "9".into(),
        expires_at: "9".into(),
        ..pass(id, PassKind::Token)
    };
    let nobody = store.add_pass(hash(9), token("a", of_user("Bo's key"))).await;
    assert!(matches!(nobody, Err(StoreError::NotFound(Missing::User))));
    let nothing = store.add_pass(hash(9), token("a", of_device("phone"))).await;
    assert!(matches!(nothing, Err(StoreError::NotFound(Missing::Pass))));
    store.add_pass(hash(2), token("script", of_user("Ada's key"))).await.unwrap();
    store.add_pass(hash(3), token("robot", of_device("tablet"))).await.unwrap();
    let found = async |byte, now| store.pass(hash(byte), now).await.unwrap();
    let most = Some(Role::Editor);
    assert_eq!(found(2, NOW).await, Some(Pass { most, ..token("script", of_user("Ada's key")) }));
    assert_eq!(found(3, NOW).await, Some(Pass { most, ..token("robot", of_device("tablet")) }));
    let role = async |byte| found(byte, NOW).await.map(|pass| pass.role);
    // Less than they were made for, and no more.
    let change =
        async |role| store.change_user("Ada's key", UserChange::role(role), Terms::default()).await.unwrap();
    assert!(change(Role::Viewer).await);
    assert_eq!(role(2).await, Some(Role::Viewer));
    assert!(change(Role::Admin).await);
    assert_eq!(role(2).await, Some(Role::Editor));
    assert!(store.change_pass("tablet", Role::Commenter).await.unwrap());
    assert_eq!(role(3).await, Some(Role::Commenter));
    // Another password ends logins; programs are revoked one by one.
    store.add_pass(hash(4), login_of("Ada", "one")).await.unwrap();
    store.add_pass(hash(5), login_of("Ada", "two")).await.unwrap();
    let another = UserChange { stays: Some(hash(5)), ..UserChange::password("another".into()) };
    assert!(store.change_user("Ada's key", another, Terms::default()).await.unwrap());
    assert_eq!((role(4).await, role(5).await, role(2).await), (None, Some(Role::Admin), Some(Role::Editor)));
    // They go with whoever holds them.
    assert_eq!(found(3, LATER).await, None, "the tablet has expired");
    assert_eq!(store.passes(PassKind::Token, LATER).await.unwrap().len(), 1);
    assert!(store.take_pass("tablet").await.unwrap());
    assert_eq!(role(3).await, None);
    assert!(store.remove_user("Ada's key", FORCE).await.unwrap());
    assert_eq!((role(2).await, role(5).await), (None, None));
    assert!(store.passes(PassKind::Token, NOW).await.unwrap().is_empty());
}
