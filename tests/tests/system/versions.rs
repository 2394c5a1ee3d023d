//! `LB`: trees with versions.

use std::collections::BTreeSet;

use espalier_tests::{
    client::Client,
    http::{self, Answer},
};
use serde_json::{Value, json};

use crate::library::Library;

impl Library {
    fn get(&self, path: &str) -> Value {
        let answer = self.ask("GET", path, None);
        assert_eq!(answer.status, 200, "{path}: {}", answer.text());
        answer.json()
    }

    fn post(&self, path: &str, body: Value, status: u16) -> Value {
        let answer = self.ask("POST", path, Some(body));
        assert_eq!(answer.status, status, "{path}: {}", answer.text());
        answer.json()
    }

    async fn grow(&mut self, steps: u32) {
        self.client.send(json!({ "kind": "grow", "steps": steps })).await;
        self.client.until_settled().await;
    }

    fn save_again(&self, tree: &str, note: &str) -> Value {
        let body = json!({ "session": self.client.session, "note": note, "author": "Bo" });
        self.post(&format!("{tree}/versions"), body, 201)
    }

    async fn enter(&self, opened: &Value, key: &str) -> Client {
        Client::connect(self.server.port(), opened["session"].as_str().expect("a name"), key).await
    }
}

fn path_of(tree: &Value) -> String {
    format!("/api/v1/trees/{}", tree["id"].as_str().expect("a tree has an id"))
}

fn numbers(versions: &Value) -> Vec<u64> {
    versions.as_array().expect("a list").iter().filter_map(|version| version["number"].as_u64()).collect()
}

#[tokio::test]
async fn lb1_each_save_is_a_version_that_can_be_had_again() {
    let mut library = Library::new().await;
    let tree = library.save("Pear");
    let path = path_of(&tree);
    let before = library.client.form().await;
    library.grow(3).await;
    let second = library.save_again(&path, "Grown on");
    assert_eq!(
        (&second["number"], &second["note"], &second["author"]),
        (&json!(2), &json!("Grown on"), &json!("Bo"))
    );
    assert_eq!(second["metamers"], json!(library.client.state.metamers));
    let restored =
        library.post(&format!("{path}/versions/1/restore"), json!({ "note": "It was better" }), 201);
    assert_eq!(
        (&restored["number"], &restored["restored"], &restored["metamers"]),
        (&json!(3), &json!(1), &tree["metamers"])
    );
    assert_eq!(numbers(&library.get(&format!("{path}/versions"))), [3, 2, 1]);
    assert_eq!(numbers(&library.get(&format!("{path}/versions?limit=1&before=3"))), [2]);
    let now = library.get(&path);
    assert_eq!(
        (&now["version"], &now["metamers"], &now["revision"]),
        (&json!(3), &tree["metamers"], &json!(3))
    );

    let (first, third) = (
        library.ask("GET", &format!("{path}/versions/1/document"), None),
        library.ask("GET", &format!("{path}/versions/3/document"), None),
    );
    assert!(first.body.starts_with(b"ESPALIER"));
    assert_eq!(first.body, third.body);
    let copy = library.post(&format!("{path}/copies"), json!({ "name": "Branch", "version": 2 }), 201);
    assert_eq!(copy["origin"], json!({ "tree": tree["id"], "version": 2 }));
    assert_eq!((&copy["metamers"], &copy["version"]), (&second["metamers"], &json!(1)));
    let opened = library.post("/api/v1/sessions", json!({ "tree": tree["id"], "version": 1 }), 201);
    let mut visitor = library.enter(&opened, "browser-2").await;
    visitor.until_form(&before).await;
    let noted = library.ask("PATCH", &format!("{path}/versions/2"), Some(json!({ "note": "In leaf" })));
    assert_eq!((noted.status, &noted.json()["note"]), (200, &json!("In leaf")));
    for (method, missing) in
        [("GET", "versions/4/document"), ("POST", "versions/9/restore"), ("PATCH", "versions/9")]
    {
        let body = (method != "GET").then(|| json!({ "note": "?" }));
        assert_eq!(library.ask(method, &format!("{path}/{missing}"), body).status, 404, "{missing}");
    }
}

#[tokio::test]
async fn lb2_of_two_who_change_one_revision_one_is_refused() {
    let library = Library::new().await;
    let path = path_of(&library.save("Pear"));
    let port = library.server.port();
    let tag = |answer: &Answer| answer.header("etag").map(str::to_owned);
    let seen = tag(&library.ask("GET", &path, None)).expect("it has a tag");
    let first = http::send_if(port, "PATCH", &path, &seen, &json!({ "name": "Quince" })).expect("an answer");
    assert_eq!((first.status, tag(&first).as_deref()), (200, Some("\"2\"")));
    let versions = format!("{path}/versions");
    let save = json!({ "session": library.client.session });
    for (method, path, body) in [
        ("PATCH", &path, json!({ "name": "Apple" })),
        ("POST", &versions, save.clone()),
        ("DELETE", &path, json!({})),
    ] {
        let refused = http::send_if(port, method, path, &seen, &body).expect("an answer");
        assert_eq!((refused.status, &refused.json()["code"]), (412, &json!("stale")), "{method} {path}");
    }
    assert_eq!(library.names(), ["Quince"]);
    let saved = http::send_if(port, "POST", &versions, "\"2\"", &save).expect("an answer");
    assert_eq!((saved.status, tag(&saved).as_deref()), (201, Some("\"3\"")));
    let nonsense = http::send_if(port, "PATCH", &path, "2", &json!({ "name": "Apple" })).expect("an answer");
    assert_eq!(nonsense.status, 400, "{}", nonsense.text());
    let any = http::send_if(port, "PATCH", &path, "*", &json!({ "name": "Apple" })).expect("an answer");
    assert_eq!(any.status, 200);
}

#[tokio::test]
async fn lb3_opening_a_tree_in_work_is_joining() {
    let mut library = Library::new().await;
    let tree = library.save("Pear");
    let ours = json!(library.client.session);
    let open = json!({ "tree": tree["id"] });
    assert_eq!(library.get(&path_of(&tree))["people"], json!(1));
    let opened = library.post("/api/v1/sessions", open.clone(), 200);
    let saved = json!({ "id": tree["id"], "version": 1, "saved": true });
    assert_eq!((&opened["session"], &opened["tree"]), (&ours, &saved));
    let mut friend = library.enter(&opened, "browser-2").await;
    library.grow(2).await;
    friend.until_form(&library.client.form().await).await;
    let joined = library.post("/api/v1/sessions", open.clone(), 200);
    assert_eq!(
        (&joined["session"], &joined["tree"]["saved"]),
        (&ours, &json!(false)),
        "there is unsaved work"
    );

    friend.vanish();
    library.client.vanish();
    let alone = || library.get(&path_of(&tree))["people"] == json!(0);
    while !alone() {
        tokio::task::yield_now().await;
    }
    let anew = library.post("/api/v1/sessions", open.clone(), 201);
    assert_ne!(anew["session"], ours, "the tree is what was saved");
    let mut visitor = library.enter(&anew, "browser-3").await;
    visitor.until_settled().await;
    assert_eq!(json!(visitor.state.metamers), tree["metamers"]);
    assert_eq!(
        library.post("/api/v1/sessions", open, 200)["session"],
        anew["session"],
        "two come into one session"
    );
    let left = library.get(&format!("/api/v1/sessions/{}", library.client.session));
    assert_eq!(left["tree"]["saved"], json!(false), "the work of before is there still");
}

/// Whoever opens the tree comes to the people, not to what somebody looks at beside them.
#[tokio::test]
async fn lb3_a_version_opened_beside_people_does_not_lead_others_away() {
    let mut library = Library::new().await;
    let tree = library.save("Pear");
    let ours = json!(library.client.session);
    library.grow(1).await;
    for version in [1, 1] {
        let open = json!({ "tree": tree["id"], "version": version });
        let beside = library.post("/api/v1/sessions", open, 201);
        assert_ne!(beside["session"], ours);
        assert_eq!(beside["tree"], json!({ "id": tree["id"], "version": 1, "saved": true }));
        let joined = library.post("/api/v1/sessions", json!({ "tree": tree["id"] }), 200);
        assert_eq!(joined["session"], ours);
        assert_eq!(library.get(&path_of(&tree))["people"], json!(1));
    }
    library.client.vanish();
}

#[tokio::test]
async fn lb3_those_who_open_a_tree_at_once_come_into_one_session() {
    let mut library = Library::new().await;
    let tree = library.save("Pear");
    library.grow(1).await;
    library.client.vanish();
    while library.get(&path_of(&tree))["people"] != json!(0) {
        tokio::task::yield_now().await;
    }
    let (port, open) = (library.server.port(), json!({ "tree": tree["id"] }));
    let opened: Vec<Answer> = std::thread::scope(|scope| {
        let opening = || http::send(port, "POST", "/api/v1/sessions", Some(&open)).expect("an answer");
        let all: Vec<_> = (0..8).map(|_| scope.spawn(opening)).collect();
        all.into_iter().map(|one| one.join().expect("it ends")).collect()
    });
    assert_eq!(opened.iter().filter(|answer| answer.status == 201).count(), 1, "one begins it");
    assert_eq!(opened.iter().filter(|answer| answer.status == 200).count(), 7);
    let sessions: BTreeSet<String> =
        opened.iter().map(|answer| answer.json()["session"].to_string()).collect();
    assert_eq!(sessions.len(), 1, "{sessions:?}");
}

#[tokio::test]
async fn lb3_people_work_on_the_tree_that_their_session_was_saved_as_last() {
    let mut library = Library::new().await;
    let (pear, apple) = (library.save("Pear"), library.save("Apple"));
    let people = |tree: &Value| library.get(&path_of(tree))["people"].clone();
    assert_eq!((people(&pear), people(&apple)), (json!(0), json!(1)));
    let listed = library.get("/api/v1/trees?sort=name");
    let counts: Vec<&Value> =
        listed["trees"].as_array().expect("a list").iter().map(|tree| &tree["people"]).collect();
    assert_eq!(counts, [&json!(1), &json!(0)]);
    library.client.vanish();
}

#[tokio::test]
async fn lb4_a_template_begins_a_tree_of_its_own() {
    let mut library = Library::new().await;
    let tree = library.save("Pear");
    let path = path_of(&tree);
    assert_eq!(library.ask("PATCH", &path, Some(json!({ "template": true }))).status, 200);
    let listed = |query: &str| library.get(&format!("/api/v1/trees?template={query}"))["trees"].clone();
    assert_eq!((listed("true")[0]["id"].clone(), listed("false")), (tree["id"].clone(), json!([])));
    let begun = library.post("/api/v1/sessions", json!({ "tree": tree["id"], "template": true }), 201);
    assert_eq!(begun["tree"], Value::Null);
    let mut visitor = library.enter(&begun, "browser-2").await;
    visitor.until_form(&library.client.form().await).await;
    visitor.send(json!({ "kind": "grow", "steps": 2 })).await;
    visitor.until_settled().await;
    library.client = visitor;
    let own = library.save("Own");
    assert_ne!(own["id"], tree["id"]);
    assert_eq!(library.get(&path)["version"], json!(1));
}

#[tokio::test]
async fn lb6_a_deleted_tree_is_taken_back_whole() {
    let mut library = Library::new().await;
    let path = path_of(&library.save("Pear"));
    library.grow(2).await;
    library.save_again(&path, "Grown on");
    let before = library.get(&path);
    assert_eq!(library.ask("DELETE", &path, None).status, 204);
    assert_eq!(library.names(), Vec::<String>::new());
    let deleted = library.get("/api/v1/trees?deleted=true");
    assert_eq!(
        (&deleted["trees"][0]["id"], deleted["trees"][0]["deleted_at"].is_string()),
        (&before["id"], true)
    );
    assert_eq!(numbers(&library.get(&format!("{path}/versions"))), [2, 1]);
    let refused =
        library.ask("POST", &format!("{path}/versions"), Some(json!({ "session": library.client.session })));
    assert_eq!(refused.status, 404, "{}", refused.text());
    let refused = library.ask("POST", "/api/v1/sessions", Some(json!({ "tree": before["id"] })));
    assert_eq!(refused.status, 404, "{}", refused.text());
    let back = library.post(&format!("{path}/undelete"), json!({}), 200);
    assert_eq!(
        (&back["version"], &back["name"], &back["deleted_at"]),
        (&json!(2), &json!("Pear"), &Value::Null)
    );
    let refused = library.ask("POST", &format!("{path}/undelete"), Some(json!({})));
    assert_eq!(
        (refused.status, &refused.json()["reason"]),
        (409, &json!("not-deleted")),
        "{}",
        refused.text()
    );
    assert_eq!(library.names(), ["Pear"]);
}

#[tokio::test]
async fn lb6_a_deleted_tree_goes_for_good_when_told() {
    let library = Library::new().await;
    let path = path_of(&library.save("Pear"));
    let for_good = format!("{path}/for-good");
    let refused = library.ask("DELETE", &for_good, None);
    assert_eq!(
        (refused.status, &refused.json()["reason"]),
        (409, &json!("not-deleted")),
        "only one that is deleted"
    );
    assert_eq!(library.ask("DELETE", &path, None).status, 204);
    assert_eq!(library.ask("DELETE", &for_good, None).status, 204);
    assert_eq!(library.ask("POST", &format!("{path}/undelete"), Some(json!({}))).status, 404);
    assert_eq!(library.ask("GET", &path, None).status, 404);
    assert_eq!(library.get("/api/v1/trees?deleted=true")["trees"], json!([]));
}

#[tokio::test]
async fn lb5_what_is_said_is_plain_text() {
    let library = Library::new().await;
    let path = path_of(&library.save("Pear"));
    let session = &library.client.session;
    let hidden = "oak\u{202e}gpj";
    for (method, at, body, field) in [
        ("PATCH", path.clone(), json!({ "name": hidden }), "name"),
        ("PATCH", path.clone(), json!({ "note": "bell\u{7}" }), "note"),
        ("POST", format!("{path}/versions"), json!({ "session": session, "author": "\u{200b}" }), "author"),
        ("POST", format!("{path}/copies"), json!({ "name": "\u{3164}" }), "name"),
        ("POST", "/api/v1/trees".into(), json!({ "session": session, "name": hidden }), "name"),
    ] {
        let refused = library.ask(method, &at, Some(body));
        assert_eq!((refused.status, &refused.json()["field"]), (400, &json!(field)), "{}", refused.text());
    }
    let said = library.ask("PATCH", &path, Some(json!({ "note": " Two\nlines " })));
    assert_eq!(said.json()["note"], json!("Two\nlines"));
}

#[tokio::test]
async fn lb7_trees_are_found_by_what_is_said_of_them() {
    let library = Library::new().await;
    let found = |query: &str| {
        let page = library.get(&format!("/api/v1/trees?{query}"));
        let trees = page["trees"].as_array().expect("a list").clone();
        trees.iter().map(|tree| tree["name"].as_str().expect("a name").to_owned()).collect::<Vec<_>>()
    };
    let [oak, pear, apple] = ["Érable", "Pear", "Äpfel"].map(|name| path_of(&library.save(name)));
    let wood = library.post("/api/v1/collections", json!({ "name": "Wood" }), 201);
    let copse = library.post("/api/v1/collections", json!({ "name": "Copse", "parent": wood["id"] }), 201);
    let said = json!({ "tags": ["old", "Red maple"], "note": "By the lake", "collection": copse["id"] });
    let changed = library.ask("PATCH", &oak, Some(said)).json();
    assert_eq!((&changed["tags"], &changed["collection"]), (&json!(["Red maple", "old"]), &copse["id"]));
    assert_eq!(library.ask("PUT", &format!("{pear}/favourite"), None).status, 204);
    assert_eq!(library.get(&pear)["favourite"], json!(true));
    // Each session that a page opens has a key of its own, and it is still the same person who asks.
    let elsewhere = format!("espalier-client: {}\r\n", "k".repeat(24));
    let asked = "/api/v1/trees?favourite=true&mine=true";
    let answer = http::send_with(library.server.port(), "GET", asked, &elsewhere, b"").expect("an answer");
    assert_eq!(answer.json()["trees"][0]["name"], json!("Pear"), "{}", answer.text());
    let first = library.get("/api/v1/trees?sort=name&limit=1");
    let next = first["next"].as_str().expect("there are more");
    for (query, expected) in [
        ("q=erab", vec!["Érable"]),
        ("q=LAKE%20maple", vec!["Érable"]),
        ("q=%C3%A4pf", vec!["Äpfel"]),
        ("q=e", vec!["Äpfel", "Pear", "Érable"]),
        ("q=%22*%22", vec![]),
        ("tags=old,Red%20maple", vec!["Érable"]),
        (&format!("collection={}", copse["id"].as_str().expect("an id")), vec!["Érable"]),
        ("collection=", vec!["Äpfel", "Pear"]),
        ("favourite=true", vec!["Pear"]),
        ("mine=true&min_metamers=1", vec!["Äpfel", "Pear", "Érable"]),
        ("max_metamers=0", vec![]),
        ("sort=oldest&q=r", vec!["Érable", "Pear"]),
        ("saved_before=2000-01-01T00:00:00Z", vec![]),
        ("saved_from=2000-01-01T00:00:00Z&q=pear", vec!["Pear"]),
        (&format!("sort=name&after={next}"), vec!["Érable", "Pear"]),
    ] {
        assert_eq!(found(query), expected, "{query}");
    }
    assert_eq!(
        library.get("/api/v1/tags"),
        json!([{ "tag": "Red maple", "trees": 1 }, { "tag": "old", "trees": 1 }])
    );
    let ours = json!([{ "author": "Ada", "trees": 1 }]);
    library.post(&format!("{apple}/copies"), json!({ "name": "Apple", "author": "Ada" }), 201);
    assert_eq!(library.get("/api/v1/authors"), ours);
    let under_itself = json!({ "parent": copse["id"] });
    let at =
        |collection: &Value| format!("/api/v1/collections/{}", collection["id"].as_str().expect("an id"));
    assert_eq!(library.ask("PATCH", &at(&wood), Some(under_itself)).status, 409);
    assert_eq!(library.ask("DELETE", &at(&copse), None).status, 204);
    assert_eq!(library.get("/api/v1/collections")[0]["trees"], json!(1), "what lay in it lies in its parent");
    for query in ["q=a+b+c+d+e+f+g+h+i", "sort=best", "after=x", "limit=0", "colour=red"] {
        let refused = library.ask("GET", &format!("/api/v1/trees?{query}"), None);
        assert_eq!(refused.status, 400, "{query}: {}", refused.text());
    }
    for (path, tags) in [(&apple, json!(["a,b"])), (&apple, json!([""])), (&apple, json!(vec!["x"; 33]))] {
        let refused = library.ask("PATCH", path, Some(json!({ "tags": tags })));
        assert_eq!(refused.status, 400, "{}", refused.text());
    }
}
