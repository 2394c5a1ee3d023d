//! Every refusal of a file names the part at fault and what is allowed there, at every address that takes one.

use axum::{body::Bytes, response::Response};
use serde_json::{Value, json};

use super::{
    ahead::draw_ahead,
    versions::{THUMBNAIL, TURNTABLE},
    *,
};

const OBSTACLES: &str = "POST /api/v1/sessions/{session}/obstacles";
const QSM: &str = "POST /api/v1/trees/import?name=Oak&format=csv";
const MTG: &str = "POST /api/v1/trees/import?name=Oak&format=mtg";
const SKELETON: &str = "POST /api/v1/trees/import?name=Oak&format=json";
const DOCUMENT: &str = "POST /api/v1/trees/import?name=Oak&format=espalier";
const VERSION: &str = "POST /api/v1/trees/{tree}/versions/import?format=csv";

/// A trunk and a branch, as a scanner's program has them.
pub(super) const SCAN: &str = include_str!("../../../../tests/fuzz/seeds/rtwig.csv");
/// A document with a section that no release reads.
const LATER: &[u8] = include_bytes!("../../../session/golden/later.espalier");

/// Files that are refused: where they are sent, what they are, and what the refusal says in `reason`, `field` and
/// `allowed`.
type Refused = (&'static str, Vec<u8>, &'static str, &'static str, &'static str);

fn refused() -> Vec<Refused> {
    let gltf = |rest: Value| {
        let mut file = json!({ "asset": { "version": "2.0" } });
        file.as_object_mut().unwrap().append(&mut rest.as_object().unwrap().clone());
        file.to_string().into_bytes()
    };
    // A file that says it has so many triangles, of which it has none.
    let announced = |triangles: usize| {
        gltf(json!({
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
            "accessors": [{ "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3 * triangles }],
            "bufferViews": [{ "buffer": 0, "byteLength": 36 * triangles }],
            "buffers": [{ "uri": "data:application/octet-stream;base64,", "byteLength": 0 }],
        }))
    };
    let sound = "glTF 2.0 as .glb, or as .gltf with its buffers inside";
    let model = "glTF 2.0 as .glb, or as .gltf with its buffers inside, or .obj";
    let obstacle = |file, reason, allowed| (OBSTACLES, file, reason, "body", allowed);
    let tree = |address, file: &str, field, allowed| {
        (address, file.as_bytes().to_vec(), "not-a-tree-file", field, allowed)
    };
    let later = "a document that this version of Espalier reads";
    vec![
        obstacle(b"a garden gnome".into(), "not-model", model),
        obstacle(Vec::new(), "not-model", model),
        obstacle(b"PK\x03\x04".into(), "not-model", model),
        obstacle(b"{".into(), "not-gltf", sound),
        (OBSTACLES, b"v 0 0 0\nv 1 0 NaN".into(), "obj-damaged", "line 2", "finite numbers"),
        (OBSTACLES, b"v 0 0 0\nf 1 2 3".into(), "obj-damaged", "line 2", "1 to 1, or -1 to -1"),
        obstacle(b"v 0 0 0\n".into(), "empty-mesh", "at least one triangle"),
        obstacle(br#"{"asset":{"version":"1.0"}}"#.into(), "gltf-version", sound),
        obstacle(b"glTF\x01\0\0\0".into(), "gltf-version", sound),
        obstacle(
            gltf(json!({ "buffers": [{ "uri": "gnome.bin", "byteLength": 12 }] })),
            "gltf-buffers",
            sound,
        ),
        obstacle(gltf(json!({ "buffers": [{ "byteLength": 12 }] })), "gltf-damaged", sound),
        obstacle(b"glTF\x02\0\0\0".into(), "gltf-damaged", sound),
        obstacle(
            gltf(json!({ "extensionsRequired": ["KHR_draco_mesh_compression"] })),
            "gltf-needs",
            "glTF 2.0 as .glb, or as .gltf with its buffers inside, without the extension KHR_draco_mesh_compression",
        ),
        obstacle(gltf(json!({})), "empty-mesh", "at least one triangle"),
        obstacle(announced(6_000_001), "large-mesh", "up to 6000000 triangles"),
        tree(QSM, "", "line 1", "cylinders of a QSM (.csv)"),
        tree(QSM, "a,b\n1,2\n", "line 1", "cylinders of a QSM (.csv)"),
        tree(QSM, &SCAN.replace("0.02,0.5", "-0.02,0.5"), "line 3, column 10", "more than 0"),
        tree(
            QSM,
            &SCAN.replace("20,30,6,", "20,30,6e9,"),
            "line 2",
            "up to 1000 m, as far as 1000 internodes of 1 m reach",
        ),
        tree(VERSION, &SCAN.replace("0.02,0.5", "-0.02,0.5"), "line 3, column 10", "more than 0"),
        tree(MTG, "", "body", "a multiscale tree graph (.mtg)"),
        tree(MTG, "CODE:\tFORM-A\nMTG:\n", "body", "a multiscale tree graph (.mtg)"),
        tree(MTG, SCAN, "line 1", "a multiscale tree graph (.mtg)"),
        tree(SKELETON, "", "line 1, column 0", "a skeleton (.json)"),
        tree(SKELETON, "{}", "format", "espalier-skeleton"),
        tree(DOCUMENT, "", "body", "a document (.espalier)"),
        tree(DOCUMENT, "an oak", "body", "a document (.espalier)"),
        (DOCUMENT, LATER[..20].to_vec(), "not-a-tree-file", "body", "a document (.espalier)"),
        (DOCUMENT, LATER.to_vec(), "newer-program", "body", later),
    ]
}

/// Addresses whose files are tried, with their queries.
pub(super) fn queries() -> impl Iterator<Item = &'static str> {
    refused().into_iter().map(|(address, ..)| address)
}

/// The same without them.
pub(super) fn addresses() -> impl Iterator<Item = &'static str> {
    queries().map(|address| address.split('?').next().unwrap())
}

#[tokio::test]
async fn every_refused_file_names_the_part_at_fault_and_what_is_allowed() {
    let (server, _) = server().await;
    for (address, file, reason, field, allowed) in refused() {
        let asked = format!("{address} with {:?}", String::from_utf8_lossy(&file[..file.len().min(60)]));
        let request = request(&method_of(address), &filled(path_of(address)));
        let answer = server.clone().oneshot(request.body(Body::from(file)).unwrap()).await.unwrap();
        let status = answer.status();
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let problem: Value = serde_json::from_slice(&bytes).unwrap_or_default();
        let found = ["reason", "field", "allowed"].map(|name| problem[name].as_str().unwrap_or_default());
        assert_eq!(found, [reason, field, allowed], "{asked}: {problem}");
        let expected =
            if problem["code"] == "refused" { StatusCode::CONFLICT } else { StatusCode::BAD_REQUEST };
        assert_eq!(status, expected, "{asked}: {problem}");
    }
}

async fn send(server: &Router, asked: Builder, body: impl Into<Body>) -> Response {
    server.clone().oneshot(asked.body(body.into()).unwrap()).await.unwrap()
}

async fn bytes(response: Response) -> Bytes {
    axum::body::to_bytes(response.into_body(), usize::MAX).await.unwrap()
}

async fn told(response: Response) -> (StatusCode, Value) {
    let status = response.status();
    (status, serde_json::from_slice(&bytes(response).await).unwrap_or_default())
}

#[tokio::test]
async fn im2_a_file_becomes_the_newest_version_at_the_revision_that_was_seen() {
    let (server, _) = server().await;
    let path = "/api/v1/trees/ash/versions/import?format=csv";
    let post = |query: &str| request(&Method::POST, &format!("{path}{query}"));
    let first = send(&server, post("&note=Scanned&author=Ada").header(header::IF_MATCH, "\"1\""), SCAN).await;
    assert_eq!(first.headers()[header::ETAG], "\"2\"");
    let (status, version) = told(first).await;
    let found = ["number", "metamers", "note", "author"].map(|name| &version[name]);
    assert_eq!(status, StatusCode::CREATED, "{version}");
    assert_eq!(found, [&json!(2), &json!(4), &json!("Scanned"), &json!("Ada")]);

    let (status, problem) = told(send(&server, post("").header(header::IF_MATCH, "\"1\""), SCAN).await).await;
    assert_eq!((status, &problem["reason"]), (StatusCode::PRECONDITION_FAILED, &json!("stale")));
    // Internodes of half the length: twice as many, and one to the branch.
    let (status, version) = told(send(&server, post("&internode_length=0.05"), SCAN).await).await;
    assert_eq!(
        (status, &version["number"], &version["metamers"]),
        (StatusCode::CREATED, &json!(3), &json!(37))
    );
    // In a unit of 10 cm all is ten times smaller than in metres.
    let (status, version) = told(send(&server, post("&unit=0.1"), SCAN).await).await;
    assert_eq!((status, &version["number"]), (StatusCode::CREATED, &json!(4)));
    assert!(version["metamers"].as_u64() < Some(19), "{version}");
    let nobodys = request(&Method::POST, "/api/v1/trees/elm/versions/import?format=csv");
    assert_eq!(send(&server, nobodys, SCAN).await.status(), StatusCode::NOT_FOUND);
}

#[tokio::test]
async fn ex4_a_version_is_taken_in_every_format() {
    let (server, _) = server().await;
    let take = async |path: &str| {
        send(&server, request(&Method::GET, &format!("/api/v1/trees/ash/versions/{path}")), "").await
    };
    for length in ["0.1", "0.05"] {
        let path = format!("/api/v1/trees/ash/versions/import?format=csv&internode_length={length}");
        assert_eq!(send(&server, request(&Method::POST, &path), SCAN).await.status(), StatusCode::CREATED);
    }
    for row in FORMATS {
        let query = match row.ending {
            "ply" => "?points=100",
            "sway.png" => "?size=40x40&frames=2",
            _ => "",
        };
        let file = take(&format!("2/tree.{}{query}", row.ending)).await;
        assert_eq!(file.status(), StatusCode::OK, "{}", row.ending);
        assert_eq!(file.headers()[header::CONTENT_TYPE], row.media_type);
        assert!(!bytes(file).await.is_empty(), "{}", row.ending);
    }
    let lines =
        async |path: &str| bytes(take(path).await).await.iter().filter(|&&byte| byte == b'\n').count();
    assert_eq!([lines("2/tree.csv").await, lines("3/tree.csv").await], [1 + 19, 1 + 37], "each is itself");

    let (status, problem) = told(take("9/tree.csv").await).await;
    assert_eq!((status, &problem["field"]), (StatusCode::NOT_FOUND, &json!("version")));
    let (status, problem) = told(take("2/tree.csv?lod=1").await).await;
    assert_eq!((status, &problem["field"]), (StatusCode::BAD_REQUEST, &json!("lod")));
    // What is kept of the first one is no document.
    let (status, problem) = told(take("1/tree.glb").await).await;
    assert_eq!((status, &problem["reason"]), (StatusCode::CONFLICT, &json!("tree-damaged")));
}

#[tokio::test]
async fn im3_what_is_taken_with_a_doubt_is_said_once() {
    let (server, _) = server().await;
    let send = async |path: &str, file: String| {
        let asked = request(&Method::POST, path).body(Body::from(file)).unwrap();
        let answer = server.clone().oneshot(asked).await.unwrap();
        assert_eq!(answer.status(), StatusCode::CREATED, "{path}");
        let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        serde_json::from_slice::<Value>(&bytes).unwrap()
    };
    let import = "/api/v1/trees/import?name=Oak&format=csv";
    let whole = send(import, SCAN.to_owned()).await;
    assert_eq!(whole.get("import_notes"), None);
    let said = json!([{
        "note": "may-be-cut-off",
        "message": "The last line has no line end; the file may have been cut off there.",
    }]);
    let cut = send(import, SCAN.trim_end().to_owned()).await;
    assert_eq!(cut["import_notes"], said);
    // Diameters in centimetres, taken for metres.
    let thick = send(&format!("{import}&diameter_unit=0.01"), SCAN.to_owned()).await;
    assert_eq!(thick.get("import_notes"), None);
    // A tree is listed as a species where its parameters are all those of one, the length of its internodes included.
    let oak = send(&format!("{import}&species=oak&internode_length=0.3"), SCAN.to_owned()).await;
    assert_eq!((&whole["species"], &oak["species"]), (&Value::Null, &json!("oak")));
    let thick = send(&format!("{import}&diameter_unit=100"), SCAN.to_owned()).await;
    assert_eq!(thick["import_notes"][0]["note"], "thick-trunk");
    let version = send("/api/v1/trees/ash/versions/import?format=csv", SCAN.trim_end().to_owned()).await;
    assert_eq!(version["import_notes"], said);
    let path = format!("/api/v1/trees/{}", cut["id"].as_str().unwrap());
    let asked = request(&Method::GET, &path).body(Body::empty()).unwrap();
    let answer = server.clone().oneshot(asked).await.unwrap();
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    assert_eq!(serde_json::from_slice::<Value>(&bytes).unwrap().get("import_notes"), None);
}

#[tokio::test]
async fn ex5_files_are_called_as_their_tree() {
    let (server, _) = server().await;
    let rename = request(&Method::PATCH, "/api/v1/trees/ash");
    assert_eq!(status(&server, rename, r#"{"name":"Große Esche"}"#).await, StatusCode::OK);
    let import = request(&Method::POST, "/api/v1/trees/ash/versions/import?format=csv");
    assert_eq!(status(&server, import, SCAN).await, StatusCode::CREATED);
    for (path, expected) in [
        (
            "versions/2/tree.csv",
            "attachment; filename=\"Gro_e Esche.csv\"; filename*=UTF-8''Gro%C3%9Fe%20Esche.csv",
        ),
        (
            "versions/2/document",
            "attachment; filename=\"Gro_e Esche.espalier\"; filename*=UTF-8''Gro%C3%9Fe%20Esche.espalier",
        ),
        (
            "review.html",
            "inline; filename=\"Gro_e Esche review.html\"; filename*=UTF-8''Gro%C3%9Fe%20Esche%20review.html",
        ),
    ] {
        let asked = request(&Method::GET, &format!("/api/v1/trees/ash/{path}"));
        let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
        assert_eq!(answer.status(), StatusCode::OK, "{path}");
        assert_eq!(answer.headers()[header::CONTENT_DISPOSITION], expected, "{path}");
    }
}

#[tokio::test]
async fn lb9_pictures_of_what_was_saved_are_there_before_anybody_asks() {
    let shared = shared().await;
    let (server, stop) = (router(shared.clone()), CancellationToken::new());
    let drawing = tokio::spawn(draw_ahead(shared.clone(), stop.clone()));
    let import = request(&Method::POST, "/api/v1/trees/import?name=Scan&format=csv");
    let answer = server.clone().oneshot(import.body(Body::from(SCAN)).unwrap()).await.unwrap();
    assert_eq!(answer.status(), StatusCode::CREATED);
    let bytes = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
    let tree: Value = serde_json::from_slice(&bytes).unwrap();
    let id = tree["id"].as_str().unwrap();

    let drawn = async {
        loop {
            let kept = [THUMBNAIL, TURNTABLE].map(|kind| shared.drawn.kept(id, 1, kind));
            if let [Some(thumbnail), Some(turntable)] = kept {
                return (thumbnail, turntable);
            }
            tokio::time::sleep(Duration::from_millis(5)).await;
        }
    };
    let (thumbnail, turntable) =
        tokio::time::timeout(Duration::from_mins(1), drawn).await.expect("it is drawn");
    for (of, png) in [("thumbnail", thumbnail), ("turntable", turntable)] {
        let asked = request(&Method::GET, &format!("/api/v1/trees/{id}/versions/1/{of}"));
        let answer = server.clone().oneshot(asked.body(Body::empty()).unwrap()).await.unwrap();
        let body = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        assert!(body.starts_with(b"\x89PNG") && *body == *png, "{of}");
    }
    let (_, [_, _, whole, upkeep]) = shared.pool.figures();
    assert_eq!((whole.slices, upkeep.slices), (1, 0), "only the file that was read had a turn on the pool");
    stop.cancel();
    drawing.await.unwrap();
}

/// A document whose table says that its plant unpacks to so many bytes.
fn announcing(bytes: u64) -> Vec<u8> {
    let mut document = b"ESPALIER".to_vec();
    // Format, what it needs, simulation, sections, checksum; of the section version, flags and codec.
    document.extend([5, 0, 1, 1, 0].into_iter().flat_map(u32::to_le_bytes));
    document.extend(b"PLNT");
    document.extend([1, 0, 1, 1]);
    document.extend([0, bytes].into_iter().flat_map(u64::to_le_bytes));
    document.extend(0_u32.to_le_bytes());
    document
}

#[tokio::test]
async fn lm19_a_document_that_says_it_becomes_much_is_not_unpacked_without_memory_for_it() {
    let memory = Memory::with_patience(1 << 30, Duration::from_millis(1));
    let server = router(Shared { memory: memory.clone(), ..shared().await });
    let found = async |bytes| {
        let asked = request(&Method::POST, "/api/v1/trees/import?name=Oak&format=espalier");
        let answer =
            server.clone().oneshot(asked.body(Body::from(announcing(bytes))).unwrap()).await.unwrap();
        answer.status()
    };
    assert_eq!(found(1 << 40).await, StatusCode::SERVICE_UNAVAILABLE);
    assert_eq!(found(1 << 20).await, StatusCode::BAD_REQUEST, "it is damaged");
    assert_eq!((memory.look().refused(), memory.look().taken()), (1, 0));
}

#[tokio::test]
async fn lm18_a_file_is_being_read_until_it_is_read_whoever_waits() {
    let pool = SimulationPool::new(std::num::NonZeroUsize::new(1)).unwrap();
    let shared = Shared { pool: pool.clone(), ..shared().await };
    let memory = shared.memory.clone();
    // Of two workers one does what is large, and has something else to do.
    let (release, mut released) = watch::channel(false);
    let (begin, begun) = tokio::sync::oneshot::channel();
    let other = tokio::spawn({
        let (pool, handle) = (pool.clone(), tokio::runtime::Handle::current());
        let work = move |_: &crate::pool::Turn<'_>| {
            begin.send(()).unwrap();
            handle.block_on(async { released.wait_for(|&is_over| is_over).await.map(drop) }).unwrap();
        };
        async move { pool.run(crate::pool::Class::Whole, "other".into(), work).await.unwrap() }
    });
    begun.await.unwrap();
    let asked = request(&Method::POST, "/api/v1/trees/import?name=Oak&format=csv");
    let mut answer = Box::pin(router(shared).oneshot(asked.body(Body::from(SCAN)).unwrap()));
    while pool.figures().0.iter().sum::<usize>() == 0 {
        assert!(futures_util::poll!(&mut answer).is_pending());
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
    drop(answer);
    let held = memory.look().taken();
    assert_eq!(held, crate::memory::upload(SCAN.len() as u64), "it is read still, as far as anybody knows");
    release.send_replace(true);
    other.await.unwrap();
    while memory.look().taken() > 0 {
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
}

#[tokio::test]
async fn lm14_files_that_become_trees_may_take_as_long_as_models() {
    let limits = |address: &str| {
        routes().into_iter().find(|route| route.address == address).and_then(|route| route.time_limit)
    };
    let model = limits(OBSTACLES).expect("there is one");
    for address in ["POST /api/v1/trees/import", "POST /api/v1/trees/{tree}/versions/import"] {
        assert_eq!(limits(address), Some(model), "{address}");
    }
    assert!(model > limits("GET /api/v1/trees").expect("there is one"));
}

#[tokio::test]
async fn ex2_a_download_that_finds_no_room_on_the_disk_is_refused_with_the_reason() {
    let path = "/api/v1/sessions/oak/tree.mtg";
    for (rooms, expected) in [(rooms(), 200), (Rooms::new(10, 1000), 503), (Rooms::new(1000, 10), 503)] {
        let server = router(Shared { rooms, ..shared().await });
        let answer = server.oneshot(request(&Method::GET, path).body(Body::empty()).unwrap()).await.unwrap();
        let status = answer.status().as_u16();
        let body = axum::body::to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let body = String::from_utf8_lossy(&body);
        assert_eq!(status, expected, "{body}");
        assert!(expected == 200 || body.contains("not-exported") && body.contains("12 GiB"), "{body}");
    }
}
