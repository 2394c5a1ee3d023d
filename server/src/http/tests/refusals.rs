//! Every refusal names the field and what is allowed there, at every address that reads a body or a query.

use std::{borrow::Cow, convert::Infallible};

use axum::{body::Bytes, http::header};
use espalier_settings::ParameterValues;
use futures_util::stream;
use serde_json::{Value, json};

use super::*;
use crate::formats::FORMATS;

/// Each address that reads a body as JSON: the fields that may not be left out, and a body with all fields.
pub(super) fn bodies() -> Vec<(&'static str, Vec<String>, Value)> {
    let said = json!({ "note": "Pruned", "author": "Ada" });
    let with = |more: Value| {
        let mut all = said.clone();
        all.as_object_mut().unwrap().append(&mut more.as_object().unwrap().clone());
        all
    };
    let parameters = json!(ParameterValues::default());
    let every = parameters.as_object().unwrap().keys().cloned().collect();
    let names = |names: &[&str]| names.iter().copied().map(str::to_owned).collect();
    let saved = json!({ "session": "oak", "name": "Oak", "thumbnail": "data:image/png;base64,iVBORw0KGgo=" });
    vec![
        ("POST /api/v1/sessions", vec![], json!({ "tree": "ash", "version": 1, "template": true })),
        ("POST /api/v1/sessions", vec![], json!({ "seed": 1 })),
        ("POST /api/v1/schematic", every, parameters),
        (
            "POST /api/v1/grammars/check",
            names(&["text"]),
            json!({ "text": "axiom: F", "values": [], "seed": 1, "sizes": true }),
        ),
        ("POST /api/v1/redeem", names(&["secret"]), json!({ "secret": "x" })),
        (
            "POST /api/v1/grow",
            names(&["format"]),
            json!({ "template": "oak", "steps": 1, "metamers": 5, "format": "glb" }),
        ),
        (
            "POST /api/v1/login",
            names(&["name", "password"]),
            json!({ "name": "Ada", "password": "correct horse" }),
        ),
        ("POST /api/v1/trees", names(&["session", "name"]), with(saved)),
        (
            "PATCH /api/v1/trees/{tree}",
            vec![],
            json!({ "name": "Oak", "note": "Old", "template": true, "tags": ["old"], "collection": "" }),
        ),
        ("POST /api/v1/collections", names(&["name"]), json!({ "name": "Woods", "parent": "park" })),
        ("PATCH /api/v1/collections/{collection}", vec![], json!({ "name": "Woods", "parent": "" })),
        ("POST /api/v1/trees/{tree}/copies", names(&["name"]), with(json!({ "name": "Oak", "version": 1 }))),
        (
            "POST /api/v1/trees/{tree}/links",
            names(&["role"]),
            json!({ "role": "viewer", "hours": 1, "name": "Ada's tablet" }),
        ),
        (
            "PUT /api/v1/sessions/{session}/design",
            names(&["graph"]),
            json!({ "graph": { "version": 1 }, "position": [0, 0, 0] }),
        ),
        ("PUT /api/v1/sessions/{session}/owner", names(&["person"]), json!({ "person": 1 })),
        ("PATCH /api/v1/trees/{tree}/links/{link}", names(&["role"]), json!({ "role": "editor" })),
        (
            "POST /api/v1/trees/{tree}/versions",
            names(&["session"]),
            with(json!({ "session": "oak", "thumbnail": "data:image/png;base64,iVBORw0KGgo=" })),
        ),
        ("PATCH /api/v1/trees/{tree}/versions/{version}", names(&["note"]), json!({ "note": "Old" })),
        ("POST /api/v1/trees/{tree}/versions/{version}/restore", vec![], said),
        (
            "POST /api/v1/trees/{tree}/threads",
            names(&["comment"]),
            json!({
                "pin": { "session": "ashen", "at": { "row": 1, "along": 0, "offset": [0, 0, 0], "place": [0, 1, 0] } },
                "comment": { "text": "Thinner" },
            }),
        ),
        ("PATCH /api/v1/trees/{tree}/threads/{thread}", names(&["resolved"]), json!({ "resolved": true })),
        ("PUT /api/v1/trees/{tree}/threads/{thread}/seen", names(&["comment"]), json!({ "comment": 1 })),
        (
            "POST /api/v1/trees/{tree}/threads/{thread}/comments",
            names(&["text"]),
            json!({
                "text": "Thicker", "author": "Ada", "mentions": [{ "name": "Bo" }], "sketch": [[[0.5, 0.5]]],
                "bookmark": {
                    "camera": { "target": [0, 5, 0], "yaw": 0, "pitch": 0, "distance": 30 },
                    "step": 4, "line": 0, "mode": "lit",
                },
                "picture": "data:image/png;base64,iVBORw0KGgo=",
            }),
        ),
        (
            "PATCH /api/v1/trees/{tree}/threads/{thread}/comments/{comment}",
            names(&["text"]),
            json!({ "text": "As it is" }),
        ),
        (
            "POST /api/v1/users",
            names(&["name", "role", "password"]),
            json!({ "name": "Ada", "role": "editor", "password": "correct horse" }),
        ),
        (
            "PATCH /api/v1/users/{user}",
            vec![],
            json!({ "name": "Ada", "role": "editor", "password": "correct horse" }),
        ),
        (
            "PUT /api/v1/me/password",
            names(&["old", "new"]),
            json!({ "old": "correct horse", "new": "battery staple" }),
        ),
        (
            "POST /api/v1/trees/{tree}/members",
            names(&["name", "role"]),
            json!({ "name": "Ada", "role": "editor", "group": false }),
        ),
        (
            "POST /api/v1/collections/{collection}/members",
            names(&["name", "role"]),
            json!({ "name": "Studio", "role": "editor", "group": true }),
        ),
        ("POST /api/v1/groups", names(&["name", "role"]), json!({ "name": "Studio", "role": "editor" })),
        ("PATCH /api/v1/groups/{group}", vec![], json!({ "name": "Studio", "role": "editor" })),
        (
            "POST /api/v1/tokens",
            names(&["name", "role"]),
            json!({ "name": "farm", "role": "viewer", "hours": 24 }),
        ),
    ]
}

/// Addresses that take a file, or nothing.
const WITHOUT: [&str; 6] = [
    "POST /api/v1/logout",
    "POST /api/v1/sessions/{session}/resume",
    "POST /api/v1/trees/{tree}/undelete",
    "PUT /api/v1/trees/{tree}/favourite",
    "PUT /api/v1/trees/{tree}/lock",
    "PUT /api/v1/groups/{group}/members/{user}",
];

/// Queries with one field that is wrong, and its name.
fn queries() -> Vec<(String, Cow<'static, str>, &'static str)> {
    let list = "GET /api/v1/trees";
    let sessions = "GET /api/v1/sessions";
    let versions = "GET /api/v1/trees/{tree}/versions";
    let import = "POST /api/v1/trees/import";
    let version = "POST /api/v1/trees/{tree}/versions/import";
    let fixed = [
        (list, "limit=x", "limit"),
        (list, "limit=0", "limit"),
        (list, "limit=5&limit=5", "limit"),
        (list, "after=x", "after"),
        (list, "deleted=maybe", "deleted"),
        (list, "template=5", "template"),
        (list, "favourite=5", "favourite"),
        (list, "mine=maybe", "mine"),
        (list, "min_metamers=x", "min_metamers"),
        (list, "max_metamers=-1", "max_metamers"),
        (list, "q=1+2+3+4+5+6+7+8+9", "q"),
        (list, "tags=1,2,3,4,5,6,7,8,9", "tags"),
        (list, "q=oak%00", "q"),
        (list, "tags=old,%07", "tags"),
        (list, "species=%FF", "species"),
        (list, "species=oka", "species"),
        (list, "author=%00", "author"),
        (list, "author=", "author"),
        (list, "min_metamers=9&max_metamers=1", "max_metamers"),
        (list, "sort=height", "sort"),
        (list, "saved_from=soon", "saved_from"),
        (list, "saved_from=2026-02-31T00:00:00Z", "saved_from"),
        (list, "saved_before=2026", "saved_before"),
        (versions, "limit=201", "limit"),
        (versions, "before=-1", "before"),
        ("GET /api/v1/audit", "limit=0", "limit"),
        ("GET /api/v1/audit", "before=-1", "before"),
        ("GET /api/v1/jobs", "limit=201", "limit"),
        ("GET /api/v1/jobs", "before=-1", "before"),
        ("GET /api/v1/trees/{tree}/threads", "limit=201", "limit"),
        ("GET /api/v1/trees/{tree}/threads", "before=-1", "before"),
        ("GET /api/v1/trees/{tree}/review.html", "language=fr", "language"),
        (import, "format=csv", "name"),
        (import, "name=Oak", "format"),
        (import, "name=%07&format=csv", "name"),
        (import, "name=Oak&format=exe", "format"),
        (import, "name=Oak&format=", "format"),
        (import, "name=Oak&format=5", "format"),
        (import, "name=Oak&format=csv&unit=x", "unit"),
        (import, "name=Oak&format=csv&unit=0", "unit"),
        (import, "name=Oak&format=csv&internode_length=x", "internode_length"),
        (import, "name=Oak&format=csv&internode_length=0", "internode_length"),
        (import, "name=Oak&format=csv&internode_length=1e39", "internode_length"),
        (sessions, "limit=0", "limit"),
        (sessions, "limit=201", "limit"),
        (sessions, "after=x", "after"),
        (sessions, "saved=maybe", "saved"),
        (sessions, "mine=maybe", "mine"),
        (version, "note=Scanned", "format"),
        (version, "format=exe", "format"),
        (version, "format=csv&note=%07", "note"),
        (version, "format=csv&author=", "author"),
        (version, "format=csv&unit=-1", "unit"),
        (version, "format=csv&internode_length=2", "internode_length"),
    ];
    let mut all: Vec<(String, Cow<str>, &str)> =
        fixed.map(|(address, query, field)| (address.to_owned(), query.into(), field)).into();
    // A text longer than any name.
    for field in ["q", "tags", "author"] {
        all.push((list.to_owned(), format!("{field}={}", "x".repeat(3000)).into(), field));
    }
    let of = ["GET /api/v1/sessions/{session}", "GET /api/v1/trees/{tree}/versions/{version}"];
    for (of, row) in of.into_iter().flat_map(|of| FORMATS.iter().map(move |row| (of, row))) {
        let address = format!("{of}/tree.{}", row.ending);
        // Each value is none that its option can have; a format that has no such option says so.
        for (query, field) in [
            ("lod=9", "lod"),
            ("quantised=maybe", "quantised"),
            ("compressed=2", "compressed"),
            ("instanced=maybe", "instanced"),
            ("hull=", "hull"),
            ("by_limb=maybe", "by_limb"),
            ("size=1x1", "size"),
            ("turn=left", "turn"),
            ("rise=90", "rise"),
            ("fov=180", "fov"),
            ("distance=0", "distance"),
            ("target=1,2", "target"),
            ("target=NaN,0,0", "target"),
            ("frames=70000", "frames"),
            ("points=0", "points"),
            ("ticket=short", "ticket"),
            ("author=%00", "author"),
            ("licence=%E2%80%AE", "licence"),
            ("author=%C3", "author"),
        ] {
            all.push((address.clone(), query.into(), field));
        }
        for (query, field) in
            [("lod=1", "lod"), ("hull=true", "hull"), ("size=64x64", "size"), ("author=Ada", "author")]
        {
            if !row.options.contains(&field) {
                all.push((address.clone(), query.into(), field));
            }
        }
        // Each is in its range, and all together would take hours.
        if row.options.contains(&"frames") {
            all.push((address.clone(), "frames=180&size=4000x4000".into(), "frames"));
        }
    }
    all
}

async fn answer(server: &Router, address: &str, query: &str, body: &Value) -> (StatusCode, Value) {
    let body = if body.is_null() { String::new() } else { body.to_string() };
    answer_to_text(server, address, query, body).await
}

async fn answer_to_text(server: &Router, address: &str, query: &str, body: String) -> (StatusCode, Value) {
    let (method, path) = (method_of(address), filled(path_of(address)));
    let request = request(&method, &format!("{path}?{query}"));
    let request = request.header(header::CONTENT_TYPE, "application/json").body(Body::from(body)).unwrap();
    let answer = server.clone().oneshot(request).await.unwrap();
    let status = answer.status();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    (status, serde_json::from_slice(&bytes).unwrap_or_default())
}

/// A refusal of a field says which, and what is allowed.
fn assert_names(field: &str, (status, problem): &(StatusCode, Value), asked: &str) {
    assert_eq!(*status, StatusCode::BAD_REQUEST, "{asked}: {problem}");
    // An entry of a list is named by its place, and a field of an object with that object.
    let named = problem["field"].as_str().unwrap_or_default();
    let outermost = named.split(['[', '.']).next();
    assert!(named == field || outermost == Some(field), "{asked}, not {field}: {problem}");
    let message = problem["detail"].as_str().unwrap();
    let allowed = problem["allowed"].as_str().unwrap_or_else(|| panic!("{asked} names no range: {problem}"));
    assert!(!allowed.is_empty() && message.contains(field), "{asked}: {problem}");
}

#[tokio::test]
async fn every_refused_body_names_the_field_and_what_is_allowed() {
    let (server, _) = server().await;
    for (address, required, body) in bodies() {
        let asked = |what: &str| format!("{address} with {what}");
        let fields: Vec<String> = body.as_object().unwrap().keys().cloned().collect();
        for field in &fields {
            for wrong in [json!({}), json!([5]), json!(-1), json!("\u{7}")] {
                let mut other = body.clone();
                other[field] = wrong.clone();
                let answer = answer(&server, address, "", &other).await;
                // No field is an object or a list of numbers; numbers and texts are allowed in some.
                if wrong.is_object() || wrong.is_array() || answer.0 == StatusCode::BAD_REQUEST {
                    assert_names(field, &answer, &asked(&format!("{field} {wrong}")));
                }
            }
        }
        for field in &required {
            let mut less = body.clone();
            less.as_object_mut().unwrap().remove(field);
            let answer = answer(&server, address, "", &less).await;
            assert_names(field, &answer, &asked(&format!("no {field}")));
        }
        let values: Vec<Value> = body.as_object().unwrap().values().cloned().collect();
        for list in [json!([]), json!(values), json!([null, null, 7])] {
            let (status, problem) = answer(&server, address, "", &list).await;
            let allowed = problem["allowed"].as_str().unwrap_or_default();
            assert_eq!((status, &problem["field"]), (StatusCode::BAD_REQUEST, &json!("body")), "{address}");
            assert!(allowed.starts_with("an object"), "{address} with {list}: {problem}");
        }
        let mut more = body.clone();
        more["sap"] = json!(1);
        assert_names("sap", &answer(&server, address, "", &more).await, &asked("an unknown field"));
    }
    let reading = bodies().into_iter().map(|(address, ..)| address);
    let reading: BTreeSet<&str> = reading.chain(files::addresses()).chain(WITHOUT).collect();
    let all = routes();
    let writing = all.iter().map(|route| &*route.address);
    let writing =
        writing.filter(|address| ["POST", "PUT", "PATCH"].iter().any(|method| address.starts_with(method)));
    assert_eq!(reading, writing.collect(), "every address that a body is sent to is tried");
}

#[tokio::test]
async fn a_body_that_is_too_large_is_told_the_limit() {
    let (server, _) = server().await;
    for (address, _, body) in bodies() {
        let text = "x".repeat(300 * 1024);
        let (status, problem) = answer(&server, address, "", &json!(text)).await;
        assert_eq!((status, &problem["field"]), (StatusCode::PAYLOAD_TOO_LARGE, &json!("body")), "{address}");
        let allowed = problem["allowed"].as_str().unwrap_or_default();
        let limit = allowed.strip_suffix(" KiB").and_then(|limit| limit.parse::<usize>().ok());
        let limit = limit.unwrap_or_else(|| panic!("{address}: {problem}")) * 1024;
        // One that is just as large is read, and refused for what it says.
        let text = "x".repeat(limit - 2);
        let (status, problem) = answer(&server, address, "", &json!(text)).await;
        let allowed = problem["allowed"].as_str().unwrap_or_default();
        assert_eq!((status, &problem["field"]), (StatusCode::BAD_REQUEST, &json!("body")), "{address}");
        assert!(allowed.starts_with("an object"), "{address}: {problem}");
        assert!(body.to_string().len() < limit, "{address}");
    }
}

/// Nobody waits for what is too large before it has come.
#[tokio::test]
async fn a_body_that_is_said_to_be_too_large_is_refused_before_it_comes() {
    let (server, _) = server().await;
    let bodies = bodies().into_iter().map(|(address, ..)| address);
    let files = files::queries().map(|address| (address, "large-file"));
    for (address, reason) in bodies.map(|address| (address, "large-request")).chain(files) {
        for key in [None, Some("one")] {
            let asked = request(&method_of(address), &filled(path_of(address)));
            let asked = key.into_iter().fold(asked, |asked, key| asked.header("idempotency-key", key));
            let asked = asked.header(header::CONTENT_TYPE, "application/json");
            let asked = asked.header(header::CONTENT_LENGTH, 1_u64 << 30);
            let body = Body::from_stream(stream::pending::<Result<Bytes, Infallible>>());
            let answer = server.clone().oneshot(asked.body(body).unwrap()).await.unwrap();
            assert_eq!(answer.status(), StatusCode::PAYLOAD_TOO_LARGE, "{address}");
            let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
            let problem: Value = serde_json::from_slice(&bytes).unwrap();
            assert_eq!(
                (&problem["reason"], &problem["field"]),
                (&json!(reason), &json!("body")),
                "{address}"
            );
        }
    }
}

#[tokio::test]
async fn every_refused_query_names_the_field_and_what_is_allowed() {
    let (server, _) = server().await;
    for (address, query, field) in queries() {
        let answer = answer(&server, &address, &query, &Value::Null).await;
        assert_names(field, &answer, &format!("{address}?{query}"));
    }
    let tried: BTreeSet<String> = queries().into_iter().map(|(address, ..)| address).collect();
    let mut reading = BTreeSet::new();
    for Route { address, about, .. } in routes().into_iter().chain(downloads()) {
        let answer = answer(&server, &address, "sap=1", &Value::Null).await;
        assert_names("sap", &answer, &address);
        if !about.asks_nothing() {
            reading.insert(address.into_owned());
        }
    }
    assert_eq!(tried, reading, "every address that reads a query is tried");
}

/// What is of another type is told the same range as what is out of it.
#[tokio::test]
async fn what_cannot_be_read_is_told_the_range_that_holds() {
    let (server, _) = server().await;
    let list = "GET /api/v1/trees";
    let import = "POST /api/v1/trees/import";
    let long = "x".repeat(65);
    let identifier = "0 to 64 characters";
    for (address, query, field, allowed) in [
        (list, "limit=abc", "limit", "1 to 500"),
        (list, "limit=501", "limit", "1 to 500"),
        ("GET /api/v1/trees/{tree}/versions", "limit=abc", "limit", "1 to 200"),
        ("GET /api/v1/audit", "limit=-1", "limit", "1 to 1000"),
        (list, &format!("species={long}"), "species", identifier),
        (list, &format!("collection={long}"), "collection", identifier),
        (
            list,
            "saved_from=2026-02-01T00:00:00Z&saved_before=2026-01-01T00:00:00Z",
            "saved_before",
            "a time after saved_from, 2026-02-01T00:00:00.000Z",
        ),
        (import, "format=csv", "name", "1 to 80 characters"),
        (import, "name=&format=csv", "name", "1 to 80 characters"),
        (import, "name=Oak&format=csv&unit=abc", "unit", "more than 0"),
        (import, "name=Oak&format=csv&unit=-1", "unit", "more than 0"),
        (import, "name=Oak&format=csv&internode_length=abc", "internode_length", "0.005 to 1"),
        (import, "name=Oak&format=csv&internode_length=2", "internode_length", "0.005 to 1"),
    ] {
        let (status, problem) = answer(&server, address, query, &Value::Null).await;
        let found = (status, problem["field"].as_str(), problem["allowed"].as_str());
        assert_eq!(found, (StatusCode::BAD_REQUEST, Some(field), Some(allowed)), "{address}?{query}");
    }
    let tree = json!({ "session": "oak", "name": "Oak" });
    let grow = json!({ "template": "oak", "format": "glb" });
    let endings: Vec<_> = FORMATS.iter().map(|row| row.ending).collect();
    let (trees, jobs) = ("POST /api/v1/trees", "POST /api/v1/grow");
    let seeds = "a list of 1 to 1000 different seeds, or a text as 1-50 or 7";
    let (links, link) = ("POST /api/v1/trees/{tree}/links", json!({ "role": "viewer" }));
    let roles = "viewer, commenter, editor";
    for (address, body, name, wrong, field, allowed) in [
        (trees, &tree, "name", None, "name", "1 to 80 characters"),
        (trees, &tree, "name", Some(json!(5)), "name", "1 to 80 characters"),
        (trees, &tree, "name", Some(json!("")), "name", "1 to 80 characters"),
        (trees, &tree, "note", Some(json!(5)), "note", "0 to 2000 characters"),
        ("PATCH /api/v1/trees/{tree}", &json!({}), "tags", Some(json!(5)), "tags", "up to 32 tags"),
        ("PATCH /api/v1/trees/{tree}", &json!({}), "tags", Some(json!(["a,b"])), "tags[0]", "no comma"),
        (jobs, &grow, "metamers", Some(json!(-1)), "metamers", "1 to 1000"),
        (jobs, &grow, "metamers", Some(json!("many")), "metamers", "1 to 1000"),
        (jobs, &grow, "metamers", Some(json!(1001)), "metamers", "1 to 1000"),
        (jobs, &grow, "format", None, "format", &endings.join(", ")),
        (jobs, &grow, "format", Some(json!(5)), "format", &endings.join(", ")),
        (jobs, &grow, "format", Some(json!("exe")), "format", &endings.join(", ")),
        (links, &link, "role", None, "role", roles),
        (links, &link, "role", Some(json!(5)), "role", roles),
        (links, &link, "role", Some(json!("owner")), "role", roles),
        (jobs, &grow, "seeds", Some(json!("+1")), "seeds", seeds),
        (jobs, &grow, "seeds", Some(json!("")), "seeds", seeds),
        (jobs, &grow, "seeds", Some(json!(7)), "seeds", seeds),
        (jobs, &grow, "seeds", Some(json!([1, 1])), "seeds[1]", "another seed"),
        (jobs, &grow, "seeds", Some(json!([1, -1])), "seeds[1]", "0 to 4294967295"),
        (jobs, &grow, "seeds", Some(json!([])), "seeds", seeds),
        (jobs, &grow, "seeds", Some(json!("many")), "seeds", seeds),
    ] {
        let mut other = body.clone();
        match &wrong {
            Some(wrong) => other[name] = wrong.clone(),
            None => drop(other.as_object_mut().unwrap().remove(name)),
        }
        let (status, problem) = answer(&server, address, "", &other).await;
        let found = (status, problem["field"].as_str(), problem["allowed"].as_str());
        assert_eq!(
            found,
            (StatusCode::BAD_REQUEST, Some(field), Some(allowed)),
            "{address} {other}: {problem}"
        );
    }
}

/// What a request says is obeyed or refused, and never passed over.
#[tokio::test]
async fn nothing_that_is_said_is_passed_over() {
    let (server, _) = server().await;
    let sessions = "POST /api/v1/sessions";
    for (address, text, field) in [
        (sessions, r#"{"version":1}"#, "version"),
        (sessions, r#"{"template":true}"#, "template"),
        (sessions, r#"{"tree":"ash","seed":1}"#, "seed"),
        (sessions, r#"{"seed":1,"seed":1}"#, "seed"),
        ("PATCH /api/v1/trees/{tree}", r#"{"name":"Oak","note":"","name":"Ash"}"#, "name"),
        ("POST /api/v1/grow", r#"{"format":"glb","options":{"lod":1,"lod":2}}"#, "options.lod"),
    ] {
        let answer = answer_to_text(&server, address, "", text.into()).await;
        assert_names(field, &answer, &format!("{address} {text}"));
    }
}

/// An answer that refuses: its status, its reason and the field that it names.
async fn refusal(request: Builder, body: &'static str) -> (u16, Value, Value) {
    let server = router(shared().await);
    let answer = server.oneshot(request.body(Body::from(body)).unwrap()).await.unwrap();
    let status = answer.status().as_u16();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    let problem: Value = serde_json::from_slice(&bytes).unwrap();
    (status, problem["reason"].clone(), problem["field"].clone())
}

#[tokio::test]
async fn er1_a_packed_body_is_refused_at_every_address_that_takes_one() {
    for (method, path) in [
        (Method::POST, "/api/v1/sessions"),
        (Method::POST, "/api/v1/grow"),
        (Method::POST, "/api/v1/trees/import?name=Oak&format=csv"),
        (Method::POST, "/api/v1/sessions/oak/obstacles"),
    ] {
        let packed = request(&method, path)
            .header(header::CONTENT_TYPE, "application/json")
            .header(header::CONTENT_ENCODING, "gzip");
        let told = refusal(packed, "{}").await;
        assert_eq!(told, (415, json!("packed-request"), json!("content-encoding")), "{path}");
    }
    let plain = request(&Method::POST, "/api/v1/grow")
        .header(header::CONTENT_TYPE, "application/json")
        .header(header::CONTENT_ENCODING, "Identity");
    assert_eq!(refusal(plain, "{}").await.2, json!("format"), "it is read");
}

#[tokio::test]
async fn gu1_a_request_with_two_hosts_is_refused() {
    let twofold = request(&Method::GET, "/api/v1/trees").header(header::HOST, "localhost:7700");
    assert_eq!(refusal(twofold, "").await, (400, json!("malformed"), json!("host")));
    let other = request(&Method::GET, "/health").header(header::HOST, "evil.example");
    assert_eq!(refusal(other, "").await, (400, json!("malformed"), json!("host")));
}
