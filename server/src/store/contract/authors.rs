//! The contract of names of authors.

use espalier_proto::access::Role;
use espalier_session::{Named, Principal};

use super::{
    super::{Authors, Terms, Users, identity_of},
    users::user,
};

fn key(text: &str) -> Principal {
    Principal::client(text).unwrap()
}

fn named(author: &str, person: Option<String>, name: &str) -> Named {
    Named { author: key(author), person: person.map(Into::into), name: name.into() }
}

pub(super) async fn authors_are_called_as_they_were_last(store: &(impl Authors + Users)) {
    store.add_user(user("Ann", Role::Editor)).await.unwrap();
    let ann = Some(identity_of("Ann's key"));
    let bo = Some("pass bo".to_owned());
    for (author, person, name, at) in [
        ("browser-1", &ann, "Ann", "2026-01"),
        ("browser-2", &bo, "Bo", "2026-02"),
        ("browser-1", &ann, "Änne", "2026-03"),
    ] {
        store.name_author(&named(author, person.clone(), name), at).await.unwrap();
    }
    let asked = ["browser-1", "browser-9", "browser-2"].map(key);
    let [of_bo, of_ann] = [named("browser-2", bo, "Bo"), named("browser-1", ann, "Änne")];
    assert_eq!(store.named_authors(&asked).await.unwrap(), [of_bo.clone(), of_ann]);
    assert_eq!(store.named_authors(&[]).await.unwrap(), []);
    // Whoever gets the name of a user that was removed is somebody else.
    assert!(store.remove_user("Ann's key", Terms::default()).await.unwrap());
    assert_eq!(store.named_authors(&asked).await.unwrap(), [of_bo, named("browser-1", None, "Änne")]);
}
