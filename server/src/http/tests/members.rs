//! Trees and collections that are given to users and groups.

use serde_json::{Value, json};

use super::{
    people::{Asking, group, user},
    *,
};
use crate::{
    access::password::Password,
    store::{Groups, Heir, Standings, TreeChange, Users},
};

/// A server with users who have no role there.
async fn with_users(names: &[&str]) -> (Asking, Arc<AnyStore>) {
    let (server, store) = server().await;
    let password = Password::parse("correct horse").unwrap().kept().unwrap();
    for name in names {
        store.add_user(user(name, Role::None, password.clone())).await.unwrap();
    }
    (Asking(server), store)
}

async fn put_in_wood(store: &AnyStore, tree: &str) {
    let collection = Some(Some("wood".to_owned()));
    store.change_tree(tree, None, TreeChange { collection, ..TreeChange::default() }).await.unwrap();
}

fn listed(page: &Value, field: &str, key: &str) -> Vec<String> {
    let all = page[field].as_array().unwrap_or_else(|| panic!("{page}"));
    all.iter().map(|one| one[key].as_str().unwrap().to_owned()).collect()
}

/// At each address that names a tree, a session or a collection, and at the rest.
#[tokio::test]
async fn ac22_who_has_no_role_may_know_of_nothing() {
    let (server, _) = with_users(&["Ada"]).await;
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    for Route { address, action, .. } in routes().into_iter().chain(downloads()) {
        let Some(action) = action else { continue };
        let path = filled(path_of(&address));
        let (status, problem, _) = server.as_user(&ada, method_of(&address), &path, Value::Null).await;
        if address.contains("{tree}") || address.contains("{session}") {
            let named = if address.contains("{session}") { "no-session" } else { "no-tree" };
            assert_eq!((status, &problem["reason"]), (404, &json!(named)), "{address}");
        } else {
            assert_eq!(status == 403, action.reach() == Reach::Library, "{address}: {status}");
        }
    }
    let get = async |path: &str| server.as_user(&ada, Method::GET, path, Value::Null).await.1;
    assert_eq!(listed(&get("/api/v1/trees").await, "trees", "id"), [""; 0]);
    assert_eq!(listed(&get("/api/v1/sessions").await, "sessions", "session"), [""; 0]);
    assert_eq!(get("/api/v1/collections").await, json!([]));
    assert_eq!(get("/api/v1/me").await["role"], "none");
    for body in [json!({ "tree": "ash" }), json!({ "tree": "of-nobody" })] {
        let (status, problem, _) = server.as_user(&ada, Method::POST, "/api/v1/sessions", body).await;
        assert_eq!(
            (status, &problem["detail"]),
            (404, &json!("There is no such tree.")),
            "not to be told apart"
        );
    }
    let begun = server.as_user(&ada, Method::POST, "/api/v1/sessions", json!({})).await;
    assert_eq!(begun.0, 403);
}

#[tokio::test]
async fn ac22_a_tree_is_given_with_each_role_and_taken_back() {
    let (server, store) = with_users(&["Ada"]).await;
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let members = "/api/v1/trees/ash/members";
    for role in [Role::Viewer, Role::Commenter, Role::Editor, Role::Owner] {
        let (status, member, _) =
            server.send(Method::POST, members, json!({ "name": "ada", "role": role })).await;
        let expected = json!({ "id": "key of Ada", "name": "Ada", "group": false, "role": role });
        assert_eq!((status, &member), (201, &expected));
        assert_eq!(server.get(members).await, json!([expected]));
        for Route { address, action, .. } in routes() {
            let (Some(action), true) = (action, address.contains("{tree}")) else { continue };
            if address.starts_with("DELETE /api/v1/trees/{tree}") && !address.contains("members/") {
                // Others are still to ask for the tree.
                continue;
            }
            let path = filled(path_of(&address));
            let (status, ..) = server.as_user(&ada, method_of(&address), &path, Value::Null).await;
            // Copies go into the library.
            let is_for_all = !address.ends_with("/copies");
            assert_eq!(
                status != 403,
                role >= action.least() && is_for_all || !is_for_all && status == 400,
                "{role:?}: {address} {status}"
            );
        }
        let (status, ..) = server.as_user(&ada, Method::GET, "/api/v1/trees/yew", Value::Null).await;
        assert_eq!(status, 404, "of no other tree");
        let (status, found, _) =
            server.as_user(&ada, Method::GET, "/api/v1/sessions/ashen", Value::Null).await;
        assert_eq!((status, &found["session"]), (200, &json!("ashen")), "with its sessions");
        assert_eq!(server.as_user(&ada, Method::GET, "/api/v1/sessions/oak", Value::Null).await.0, 404);
    }
    let trees = async || server.as_user(&ada, Method::GET, "/api/v1/trees", Value::Null).await.1;
    assert_eq!(listed(&trees().await, "trees", "id"), ["ash"]);
    // Who owns one gives it on, and no more of the server.
    store.add_user(user("Bo", Role::None, String::new())).await.unwrap();
    let bo = json!({ "name": "Bo", "role": "viewer" });
    assert_eq!(server.as_user(&ada, Method::POST, members, bo.clone()).await.0, 201);
    assert_eq!(server.as_user(&ada, Method::POST, "/api/v1/trees/yew/members", bo).await.0, 404);
    let missing = json!({ "name": "Cy", "role": "viewer" });
    let (status, problem, _) = server.as_user(&ada, Method::POST, members, missing).await;
    assert_eq!((status, &problem["field"]), (404, &json!("name")));
    let own = format!("{members}/key%20of%20Ada");
    assert_eq!(server.send(Method::DELETE, &own, Value::Null).await.0, 204);
    assert_eq!(server.noted().await[0], "take-back");
    assert_eq!(server.send(Method::DELETE, &own, Value::Null).await.1["field"], "member");
    assert_eq!(server.as_user(&ada, Method::GET, "/api/v1/trees/ash", Value::Null).await.0, 404);
    assert_eq!(listed(&trees().await, "trees", "id"), [""; 0]);
}

#[tokio::test]
async fn ac22_a_collection_is_given_to_a_group_with_what_lies_in_it() {
    let (server, store) = with_users(&["Ada"]).await;
    put_in_wood(&store, "ash").await;
    store.add_group(group("Studio", Role::None)).await.unwrap();
    store.join_group("key of Studio", "key of Ada", None).await.unwrap();
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let members = "/api/v1/collections/wood/members";
    let studio = json!({ "name": "Studio", "group": true, "role": "editor" });
    assert_eq!(server.send(Method::POST, members, studio).await.0, 201);
    let get = async |path: &str| server.as_user(&ada, Method::GET, path, Value::Null).await.1;
    assert_eq!(listed(&get("/api/v1/trees").await, "trees", "id"), ["ash"]);
    let wood = get("/api/v1/collections").await;
    assert_eq!((&wood[0]["id"], &wood[0]["trees"]), (&json!("wood"), &json!(1)), "{wood}");
    let patch = async |tree: &str, change: Value| {
        server.as_user(&ada, Method::PATCH, &format!("/api/v1/trees/{tree}"), change).await
    };
    assert_eq!(patch("ash", json!({ "name": "Ash" })).await.0, 200);
    assert_eq!(patch("yew", json!({ "name": "Yew" })).await.0, 404);
    // Nobody comes to own a tree by putting it where they own.
    let owner = json!({ "name": "Ada", "role": "owner" });
    store
        .add_collection(Collection { id: "park".into(), name: "Park".into(), parent: None, trees: 0 })
        .await
        .unwrap();
    assert_eq!(patch("ash", json!({ "collection": "park" })).await.1["reason"], "no-collection");
    assert_eq!(server.send(Method::POST, "/api/v1/collections/park/members", owner).await.0, 201);
    let (status, problem, _) = patch("ash", json!({ "collection": "park" })).await;
    assert_eq!((status, &problem["field"]), (403, &json!("collection")));
    assert_eq!(
        server.send(Method::DELETE, &format!("{members}/key%20of%20Studio"), Value::Null).await.0,
        204
    );
    assert_eq!(patch("ash", json!({ "name": "Ash" })).await.0, 404);
    assert_eq!(listed(&get("/api/v1/trees").await, "trees", "id"), [""; 0]);
}

/// Else an editor would come to own what others own, by a helper who owns a collection.
#[tokio::test]
async fn ac22_nobody_but_owners_puts_what_is_not_theirs_where_others_own() {
    let (server, store) = with_users(&["Ada", "Bo"]).await;
    let park = Collection { id: "park".into(), name: "Park".into(), parent: None, trees: 0 };
    let pond = Collection { id: "pond".into(), name: "Pond".into(), parent: Some("park".into()), trees: 0 };
    store.add_collection(park).await.unwrap();
    store.add_collection(pond).await.unwrap();
    let editor = json!({ "role": "editor" });
    assert_eq!(server.send(Method::PATCH, "/api/v1/users/key%20of%20Ada", editor).await.0, 200);
    let bo = json!({ "name": "Bo", "role": "owner" });
    assert_eq!(server.send(Method::POST, "/api/v1/collections/park/members", bo).await.0, 201);
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    for path in ["/api/v1/trees/ash", "/api/v1/collections/wood"] {
        let key = if path.contains("trees") { "collection" } else { "parent" };
        for into in ["park", "pond"] {
            let (status, problem, _) = server.as_user(&ada, Method::PATCH, path, json!({ key: into })).await;
            assert_eq!((status, &problem["field"]), (403, &json!("collection")), "{path} into {into}");
        }
    }
    assert_eq!(server.send(Method::PATCH, "/api/v1/trees/ash", json!({ "collection": "pond" })).await.0, 200);
}

#[tokio::test]
async fn ac22_nobody_but_owners_takes_away_what_people_were_given() {
    let (server, store) = with_users(&["Ada", "Bo"]).await;
    for (id, parent) in
        [("park", None), ("pond", Some("park".to_owned())), ("reeds", Some("pond".to_owned()))]
    {
        let collection = Collection { id: id.into(), name: id.into(), parent, trees: 0 };
        store.add_collection(collection).await.unwrap();
    }
    let editor = json!({ "role": "editor" });
    assert_eq!(server.send(Method::PATCH, "/api/v1/users/key%20of%20Ada", editor).await.0, 200);
    let bo = json!({ "name": "Bo", "role": "viewer" });
    assert_eq!(server.send(Method::POST, "/api/v1/collections/pond/members", bo).await.0, 201);
    assert_eq!(server.send(Method::PATCH, "/api/v1/trees/ash", json!({ "collection": "pond" })).await.0, 200);
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let by_ada = async |method, path: &str, body| {
        let (status, problem, _) = server.as_user(&ada, method, path, body).await;
        (status, problem["field"].as_str().map(str::to_owned))
    };
    let refused = (403, Some("collection".to_owned()));
    let patch = async |path: &str, body| by_ada(Method::PATCH, path, body).await;
    for into in ["", "wood"] {
        assert_eq!(patch("/api/v1/trees/ash", json!({ "collection": into })).await, refused, "{into:?}");
        let moved = patch("/api/v1/collections/reeds", json!({ "parent": into })).await;
        assert_eq!(moved, refused, "{into:?}");
    }
    assert_eq!(by_ada(Method::DELETE, "/api/v1/collections/pond", Value::Null).await, refused);
    // Where the same people see it, it may lie; names and what was given to nobody are not in the way.
    assert_eq!(patch("/api/v1/trees/ash", json!({ "collection": "reeds" })).await, (200, None));
    assert_eq!(patch("/api/v1/collections/pond", json!({ "name": "Lake", "parent": "" })).await, (200, None));
    assert_eq!(by_ada(Method::DELETE, "/api/v1/collections/park", Value::Null).await, (204, None));
    assert_eq!(by_ada(Method::DELETE, "/api/v1/collections/reeds", Value::Null).await, (204, None));

    assert_eq!(server.send(Method::PATCH, "/api/v1/trees/ash", json!({ "collection": "" })).await.0, 200);
    assert_eq!(server.send(Method::DELETE, "/api/v1/collections/pond", Value::Null).await.0, 204);
    let events = server.get("/api/v1/audit").await;
    let moves: Vec<&str> = events
        .as_array()
        .unwrap()
        .iter()
        .filter(|event| event["action"] == "move")
        .map(|event| event["object"].as_str().unwrap())
        .collect();
    assert_eq!(moves, ["pond", "ash/", "ash/pond"], "and no move that nobody sees");
}

#[tokio::test]
async fn ac22_the_greatest_role_counts_and_a_program_has_no_more_than_its_token() {
    let (server, store) = with_users(&["Ada"]).await;
    let change = json!({ "role": "viewer" });
    assert_eq!(server.send(Method::PATCH, "/api/v1/users/key%20of%20Ada", change).await.0, 200);
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let give = async |role: &str| {
        let member = json!({ "name": "Ada", "role": role });
        server.send(Method::POST, "/api/v1/trees/ash/members", member).await.0
    };
    let token = json!({ "name": "farm", "role": "viewer" });
    let made = server.as_user(&ada, Method::POST, "/api/v1/tokens", token).await.1;
    let program = format!("Bearer {}", made["token"].as_str().unwrap());
    let lock = "/api/v1/trees/ash/lock";
    let locks = async || {
        let asked = request_of(&program, &Method::PUT, lock);
        let by_program = status(&server.0, asked, "").await.as_u16();
        (server.as_user(&ada, Method::PUT, lock, Value::Null).await.0, by_program)
    };
    assert_eq!(give("viewer").await, 201);
    assert_eq!(locks().await, (403, 403));
    assert_eq!(give("owner").await, 201);
    assert_eq!(locks().await, (200, 403));
    assert_eq!(
        server.as_user(&ada, Method::PUT, "/api/v1/trees/yew/lock", Value::Null).await.0,
        403,
        "she sees it"
    );
    assert_eq!(store.groups().await.unwrap(), []);
}

/// Who gave it can take back all of it: nothing is left to whoever had it, nor to those whom they gave it.
#[tokio::test]
async fn ac22_who_was_given_a_tree_to_own_gives_it_on_to_draw_with() {
    let (server, store) = with_users(&["Ada", "Bo", "Cy"]).await;
    store.add_group(group("Studio", Role::None)).await.unwrap();
    store.join_group("key of Studio", "key of Ada", None).await.unwrap();
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let members = "/api/v1/trees/ash/members";
    let member = |name: &str, group: bool, role: &str| json!({ "name": name, "group": group, "role": role });
    for name in ["Ada", "Cy"] {
        assert_eq!(server.send(Method::POST, members, member(name, false, "owner")).await.0, 201);
    }
    for (name, group, role, field) in [
        ("Bo", false, "owner", "role"),
        ("ADA", false, "editor", "name"),
        ("studio", true, "viewer", "name"),
        ("Cy", false, "viewer", "name"),
    ] {
        let given = member(name, group, role);
        let (status, problem, _) = server.as_user(&ada, Method::POST, members, given).await;
        assert_eq!((status, &problem["field"]), (403, &json!(field)), "{name} {role}: {problem}");
    }
    assert_eq!(server.as_user(&ada, Method::POST, members, member("Bo", false, "editor")).await.0, 201);
    assert_eq!(server.noted().await, [json!("give"), json!("ash/Bo editor")]);
    let delete = async |who: &str, of: &str| {
        let path = format!("{members}/key%20of%20{of}");
        server.as_user(who, Method::DELETE, &path, Value::Null).await
    };
    let (status, problem, _) = delete(&ada, "Cy").await;
    assert_eq!((status, &problem["field"]), (403, &json!("member")));
    assert_eq!(delete(&ada, "Bo").await.0, 204);
    assert_eq!(delete(&ada, "Ada").await.0, 204, "what is one's own can be given up");
    assert_eq!(server.as_user(&ada, Method::GET, "/api/v1/trees/ash", Value::Null).await.0, 404);
    let ids = server.get(members).await;
    assert_eq!((ids.as_array().unwrap().len(), &ids[0]["name"]), (1, &json!("Cy")));
}

#[tokio::test]
async fn ac18_who_was_given_a_tree_does_not_say_to_whom_it_is_handed_over() {
    let (server, store) = with_users(&["Ada", "Cy"]).await;
    let owner = json!({ "name": "Ada", "role": "owner" });
    assert_eq!(server.send(Method::POST, "/api/v1/trees/ash/members", owner).await.0, 201);
    let [ada, cy] = ["Ada", "Cy"].map(|name| server.log_in(name, "correct horse"));
    let (ada, cy) = (ada.await.unwrap(), cy.await.unwrap());
    let heir = Heir { person: "login cy".into(), name: "Cy".into() };
    store.hand_over("ash", Some(heir.clone()), None).await.unwrap();
    let take_back = async |who: &str| {
        server.as_user(who, Method::DELETE, "/api/v1/sessions/ashen/owner", Value::Null).await
    };
    let (status, problem, _) = take_back(&ada).await;
    assert_eq!(
        (status, &problem["reason"], &problem["field"]),
        (403, &json!("forbidden"), &json!("session"))
    );
    assert_eq!(store.heir_of("ash").await.unwrap(), Some(heir));
    assert_eq!(take_back(&cy).await.0, 200);
    assert_eq!(store.heir_of("ash").await.unwrap(), None);
}

/// Else they would have it by the collection when the tree is taken back.
#[tokio::test]
async fn ac22_who_was_given_a_tree_puts_it_into_no_collection_that_others_see() {
    let (server, store) = with_users(&["Ada"]).await;
    for (id, parent) in [("park", None), ("pond", Some("park".to_owned()))] {
        let collection = Collection { id: id.into(), name: id.into(), parent, trees: 0 };
        store.add_collection(collection).await.unwrap();
    }
    let owner = json!({ "name": "Ada", "role": "owner" });
    for path in ["/api/v1/trees/ash/members", "/api/v1/collections/park/members"] {
        assert_eq!(server.send(Method::POST, path, owner.clone()).await.0, 201);
    }
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let put = async |into: &str| {
        let into = json!({ "collection": into });
        server.as_user(&ada, Method::PATCH, "/api/v1/trees/ash", into).await
    };
    let (status, problem, _) = put("pond").await;
    assert_eq!((status, &problem["field"]), (403, &json!("collection")));
    assert_eq!(server.send(Method::PATCH, "/api/v1/trees/ash", json!({ "collection": "park" })).await.0, 200);
    assert_eq!(put("pond").await.0, 200, "whoever sees it there has seen it before");
}

#[tokio::test]
async fn ac22_names_of_users_are_guessed_slowly() {
    let (server, _) = with_users(&["Ada", "Bo", "Cy"]).await;
    let owner = json!({ "name": "Ada", "role": "owner" });
    let members = "/api/v1/trees/ash/members";
    assert_eq!(server.send(Method::POST, members, owner).await.0, 201);
    let admin = json!({ "role": "admin" });
    assert_eq!(server.send(Method::PATCH, "/api/v1/users/key%20of%20Cy", admin).await.0, 200);
    let [ada, cy] = ["Ada", "Cy"].map(|name| server.log_in(name, "correct horse"));
    let (ada, cy) = (ada.await.unwrap(), cy.await.unwrap());
    let give = async |who: &str, name: &str| {
        let member = json!({ "name": name, "group": name == "Choir", "role": "viewer" });
        server.as_user(who, Method::POST, members, member).await
    };
    for _ in 0..25 {
        assert_eq!(give(&ada, "Bo").await.0, 201, "who is somebody counts for nothing");
    }
    for name in ["Di", "Choir"].into_iter().cycle().take(20) {
        assert_eq!(give(&ada, name).await.0, 404);
    }
    for name in ["Bo", "Di"] {
        let (status, problem, _) = give(&ada, name).await;
        let found = (status, &problem["reason"], &problem["field"]);
        assert_eq!(found, (429, &json!("too-often"), &json!("name")), "not to be told apart");
    }
    for _ in 0..25 {
        assert_eq!(give(&cy, "Di").await.0, 404, "who sees all users need not guess");
    }
}

/// Else the people in it would work on the tree of somebody who only looks on.
#[tokio::test]
async fn ac22_who_only_sees_a_session_saves_it_without_taking_it_along() {
    let (server, _) = with_users(&["Ada"]).await;
    let give = async |tree: &str, role: &str| {
        let member = json!({ "name": "Ada", "role": role });
        server.send(Method::POST, &format!("/api/v1/trees/{tree}/members"), member).await.0
    };
    assert_eq!((give("ash", "viewer").await, give("yew", "editor").await), (201, 201));
    let ada = server.log_in("Ada", "correct horse").await.unwrap();
    let save = async || {
        let body = json!({ "session": "ashen" });
        let saved = server.as_user(&ada, Method::POST, "/api/v1/trees/yew/versions", body).await;
        (saved.0, server.get("/api/v1/sessions/ashen").await["tree"]["id"].clone())
    };
    assert_eq!(save().await, (201, json!("ash")));
    assert_eq!(give("ash", "editor").await, 201);
    assert_eq!(save().await, (201, json!("yew")), "who may change it takes it along");
}
