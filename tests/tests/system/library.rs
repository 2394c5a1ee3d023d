use espalier_tests::{client::Client, http, scratch::Scratch, server::Server, strokes::upward};
use serde_json::{Value, json};

/// A PNG of one red pixel.
const PICTURE: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8DwHwAFBQIAX8jx0gAAAABJRU5ErkJggg==";

pub(super) struct Library {
    pub(super) server: Server,
    pub(super) client: Client,
    _scratch: Scratch,
}

impl Library {
    /// A server with one session in which something has grown.
    pub(super) async fn new() -> Self {
        let scratch = Scratch::new();
        let server = Server::start(&scratch.path("trees.db"));
        let session = server.new_session(7);
        let mut client = Client::connect(server.port(), &session, "browser-1").await;
        for command in upward(1, 8.0, 2.0) {
            client.send(command).await;
        }
        client.until_settled().await;
        Self { server, client, _scratch: scratch }
    }

    pub(super) fn ask(&self, method: &str, path: &str, body: Option<Value>) -> http::Answer {
        http::send(self.server.port(), method, path, body.as_ref()).expect("the server answers")
    }

    pub(super) fn save(&self, name: &str) -> Value {
        let body = json!({"session": self.client.session, "name": name, "thumbnail": PICTURE});
        let answer = self.ask("POST", "/api/v1/trees", Some(body));
        assert_eq!(answer.status, 201, "{}", answer.text());
        answer.json()
    }

    pub(super) fn names(&self) -> Vec<String> {
        let list = self.ask("GET", "/api/v1/trees", None).json();
        let trees = list["trees"].as_array().expect("the library is a list");
        trees.iter().map(|tree| tree["name"].as_str().expect("a tree has a name").to_owned()).collect()
    }
}

#[tokio::test]
async fn a_saved_tree_is_listed_renamed_and_deleted() {
    let library = Library::new().await;
    assert_eq!(library.names(), Vec::<String>::new());
    let first = library.save("Pear");
    let second = library.save("Äpfel & Birnen 🌳");
    assert_eq!(library.names(), ["Äpfel & Birnen 🌳", "Pear"], "newest first");
    assert_eq!(first["metamers"], json!(library.client.state.metamers));
    let time = first["saved_at"].as_str().expect("a tree has a time");
    assert!(
        time.len() >= 20 && time.as_bytes()[10] == b'T' && time.ends_with('Z'),
        "RFC 3339 in UTC: {time}"
    );

    let path = format!("/api/v1/trees/{}", first["id"].as_str().expect("a tree has an id"));
    let renamed = library.ask("PATCH", &path, Some(json!({"name": "Quince"})));
    assert_eq!((renamed.status, renamed.json()["name"].clone()), (200, json!("Quince")));
    assert_eq!(library.names(), ["Äpfel & Birnen 🌳", "Quince"]);
    assert_eq!(library.ask("DELETE", &path, None).status, 204);
    assert_eq!(library.names(), ["Äpfel & Birnen 🌳"]);
    for (method, body) in [("DELETE", None), ("PATCH", Some(json!({"name": "Gone"})))] {
        assert_eq!(library.ask(method, &path, body).status, 404, "{method}");
    }
    assert_eq!(second["name"], json!("Äpfel & Birnen 🌳"));
}

#[tokio::test]
async fn a_thumbnail_comes_back_as_it_was() {
    let library = Library::new().await;
    let tree = library.save("Pear");
    let id = tree["id"].as_str().expect("a tree has an id");
    let link = tree["thumbnail"].as_str().expect("a tree with a picture has a link to it");
    assert_eq!(link, format!("/api/v1/trees/{id}/versions/1/thumbnail"));
    let picture = library.ask("GET", link, None);
    assert_eq!((picture.status, picture.header("content-type")), (200, Some("image/png")));
    assert!(picture.body.starts_with(b"\x89PNG\r\n\x1a\n") && picture.body.ends_with(b"IEND\xaeB`\x82"));
}

#[tokio::test]
async fn lb10_a_version_without_a_picture_is_drawn() {
    let library = Library::new().await;
    let body = json!({"session": library.client.session, "name": "Plain"});
    let tree = library.ask("POST", "/api/v1/trees", Some(body)).json();
    let link = tree["thumbnail"].as_str().expect("each tree has a picture");
    let picture = library.ask("GET", link, None);
    assert_eq!((picture.status, picture.header("content-type")), (200, Some("image/png")));
    let number = |at: usize| u32::from_be_bytes(picture.body[at..at + 4].try_into().expect("four bytes"));
    assert!(number(16) >= 256 && number(16) == number(20), "{} by {}", number(16), number(20));
    assert!(picture.body == library.ask("GET", link, None).body, "it is the same again");
    let known = picture.header("etag").expect("a tag").to_owned();
    let headers = format!("if-none-match: {known}\r\n");
    let again = http::send_with(library.server.port(), "GET", link, &headers, &[]).expect("an answer");
    assert_eq!((again.status, again.body.len()), (304, 0));
    assert_eq!(library.ask("GET", &link.replace("versions/1", "versions/7"), None).status, 404);
}

#[tokio::test]
async fn lb9_a_version_is_seen_from_all_around() {
    let library = Library::new().await;
    let tree = library.save("Round");
    let address = format!("/api/v1/trees/{}/versions/1/turntable", tree["id"].as_str().expect("an id"));
    let strip = library.ask("GET", &address, None);
    assert_eq!((strip.status, strip.header("content-type")), (200, Some("image/png")));
    assert!(strip.header("cache-control").is_some_and(|said| said.contains("immutable")));
    let number = |at: usize| u32::from_be_bytes(strip.body[at..at + 4].try_into().expect("four bytes"));
    assert_eq!((number(16), number(20)), (12 * 240, 240));
    assert!(strip.body == library.ask("GET", &address, None).body, "it is the same again");
    let none = library.ask("GET", &address.replace("versions/1", "versions/7"), None);
    assert_eq!((none.status, &none.json()["field"]), (404, &json!("version")));
}

#[tokio::test]
async fn a_reopened_tree_is_the_same_and_another_document() {
    let mut library = Library::new().await;
    let tree = library.save("Pear");
    let answer = library.ask("POST", "/api/v1/sessions", Some(json!({"tree": tree["id"], "template": true})));
    assert_eq!(answer.status, 201, "{}", answer.text());
    let session = answer.json()["session"].as_str().expect("a session has a name").to_owned();
    assert_ne!(session, library.client.session);
    let port = library.server.port();
    let mut reopened = Client::connect(port, &session, "browser-2").await;
    reopened.until_form(&library.client.form().await).await;

    // Both go on alike, each for itself.
    reopened.send(json!({ "kind": "grow", "steps": 3 })).await;
    reopened.until_settled().await;
    assert_ne!(reopened.form().await, library.client.form().await);
    library.client.send(json!({ "kind": "grow", "steps": 3 })).await;
    library.client.until_settled().await;
    reopened.until_form(&library.client.form().await).await;
}

#[tokio::test]
async fn the_library_outlives_a_kill() {
    let mut library = Library::new().await;
    let tree = library.save("Pear");
    library.server = library.server.kill_and_restart();
    assert_eq!(library.names(), ["Pear"]);
    let answer = library.ask("POST", "/api/v1/sessions", Some(json!({"tree": tree["id"]})));
    assert_eq!(answer.status, 200, "{}", answer.text());
    assert_eq!(answer.json()["session"], json!(library.client.session), "it is as it was saved");
}

#[tokio::test]
async fn bad_requests_name_what_is_wrong() {
    let library = Library::new().await;
    let session = library.client.session.clone();
    let long = "x".repeat(81);
    let heavy = format!("data:image/png;base64,{}", "A".repeat(300 * 1024));
    let cases = [
        ("POST", "/api/v1/trees", json!({"session": session, "name": ""}), 400, "name"),
        ("POST", "/api/v1/trees", json!({"session": session, "name": long}), 400, "name"),
        ("POST", "/api/v1/trees", json!({"session": session}), 400, "name"),
        (
            "POST",
            "/api/v1/trees",
            json!({"session": session, "name": "a", "thumbnail": "javascript:1"}),
            400,
            "thumbnail",
        ),
        ("POST", "/api/v1/trees", json!({"session": session, "name": "a", "thumbnail": heavy}), 413, ""),
        ("POST", "/api/v1/trees", json!({"session": "nowhere", "name": "a"}), 404, "session"),
        ("POST", "/api/v1/sessions", json!({"tree": "nothing"}), 404, "tree"),
        ("POST", "/api/v1/sessions", json!({"seed": -1}), 400, "seed"),
        ("POST", "/api/v1/sessions", json!({"sead": 1}), 400, "sead"),
    ];
    for (method, path, body, status, word) in cases {
        let shown: String = body.to_string().chars().take(100).collect();
        let answer = library.ask(method, path, Some(body));
        assert_eq!(answer.status, status, "{path} {shown}: {}", answer.text());
        let problem: espalier_proto::HttpProblem = serde_json::from_slice(&answer.body)
            .unwrap_or_else(|error| panic!("{shown}: {error} in {}", answer.text()));
        let said = format!("{} {}", problem.field.unwrap_or_default(), problem.detail);
        assert!(said.contains(word), "{shown}: {said}");
    }
    assert_eq!(library.ask("GET", "/api/v1/sessions/nowhere", None).status, 404);
    assert_eq!(library.ask("GET", "/api/v1/trees/nothing/versions/1/thumbnail", None).status, 404);
    assert_eq!(library.names(), Vec::<String>::new());
}

#[tokio::test]
async fn tree_glb_is_binary_gltf() {
    let library = Library::new().await;
    let answer = library.ask("GET", &format!("/api/v1/sessions/{}/tree.glb", library.client.session), None);
    assert_eq!((answer.status, answer.header("content-type")), (200, Some("model/gltf-binary")));
    crate::command_line::is_gltf(&answer.body);
    assert_eq!(library.ask("GET", "/api/v1/sessions/nowhere/tree.glb", None).status, 404);
}

#[tokio::test]
async fn tree_json_is_the_skeleton() {
    let library = Library::new().await;
    let answer = library.ask("GET", &format!("/api/v1/sessions/{}/tree.json", library.client.session), None);
    assert_eq!((answer.status, answer.header("content-type")), (200, Some("application/json")));
    let skeleton: Value = serde_json::from_slice(&answer.body).expect("it is JSON");
    assert_eq!(skeleton["format"], "espalier-skeleton");
    assert_eq!(library.ask("GET", "/api/v1/sessions/nowhere/tree.json", None).status, 404);
}

#[tokio::test]
async fn the_page_is_served_at_its_links() {
    let library = Library::new().await;
    for path in ["/".to_owned(), format!("/s/{}", library.client.session)] {
        let page = library.ask("GET", &path, None);
        assert_eq!(page.status, 200, "{path}");
        assert!(
            page.header("content-type").is_some_and(|kind| kind.starts_with("text/html")),
            "{}",
            page.headers
        );
        assert!(page.text().contains("<script"), "{path}");
    }
    let health = library.ask("GET", "/health", None);
    assert_eq!((health.status, health.text().trim().to_owned()), (200, "ok".to_owned()));
}
