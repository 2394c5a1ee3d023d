use std::net::SocketAddr;

use axum::{body::Body, routing::get};
use futures_util::stream;
use tokio::io::{AsyncReadExt, AsyncWriteExt};

use super::*;

/// A server that answers `/endless` without end, with anything else where there is no place.
struct House {
    at: SocketAddr,
    stop: CancellationToken,
    serving: tokio::task::JoinHandle<()>,
}

impl House {
    async fn new(limits: Limits) -> Self {
        let listener = TcpListener::bind(("127.0.0.1", 0)).await.unwrap();
        let at = listener.local_addr().unwrap();
        let endless =
            async || Body::from_stream(stream::repeat_with(|| Ok::<_, std::io::Error>(vec![7; 4096])));
        let all = Router::new().route("/endless", get(endless)).route("/health", get(async || "ok"));
        let crowded = Router::new().route("/health", get(async || "ok")).fallback(async || "no place");
        let stop = CancellationToken::new();
        let serving = serve(vec![listener], Answers { all, crowded }, limits, Vec::new(), stop.clone());
        Self { at, stop, serving: tokio::spawn(serving) }
    }

    /// Opens a connection, asks for this as often as is said, and reads no byte.
    async fn ask(&self, path: &str, times: usize) -> TcpStream {
        let stream = TcpStream::connect(self.at).await.unwrap();
        let request = format!("GET {path} HTTP/1.1\r\nhost: localhost\r\n\r\n").repeat(times);
        stream.writable().await.unwrap();
        assert_eq!(stream.try_write(request.as_bytes()).unwrap(), request.len());
        stream
    }

    /// The body of one answer.
    async fn answer(&self, path: &str) -> String {
        let stream = self.ask(path, 1).await;
        let mut heard = String::new();
        while !heard.contains("\r\n\r\n") || !(heard.ends_with("ok") || heard.ends_with("no place")) {
            let mut bytes = [0; 1024];
            stream.readable().await.unwrap();
            match stream.try_read(&mut bytes) {
                Ok(0) => break,
                Ok(count) => heard.push_str(str::from_utf8(&bytes[..count]).unwrap()),
                Err(error) => assert_eq!(error.kind(), std::io::ErrorKind::WouldBlock),
            }
        }
        heard.split_once("\r\n\r\n").unwrap().1.to_owned()
    }
}

/// Patience that no test outlasts.
const LONG: Duration = Duration::from_hours(1);

#[tokio::test]
async fn lm16_where_all_places_are_taken_health_answers_and_others_are_told() {
    let house = House::new(Limits { connections: 3, of_one: 1, told: 2, patience: LONG, asking: LONG }).await;
    let mut unread = Vec::new();
    for _ in 0..3 {
        unread.push(house.ask("/endless", 20).await);
    }
    assert_eq!(house.answer("/health").await, "ok");
    assert_eq!(house.answer("/endless").await, "no place");
}

#[tokio::test]
async fn lm16_whoever_says_nothing_where_there_is_no_place_holds_up_nobody() {
    let house = House::new(Limits { connections: 2, of_one: 1, told: 2, patience: LONG, asking: LONG }).await;
    let asked = house.ask("/endless", 20).await;
    let mut silent = Vec::new();
    for _ in 0..40 {
        silent.push(house.ask("", 0).await);
        assert_eq!(house.answer("/health").await, "ok");
    }
    // The first of them had the last place, and those who came first of all others made way.
    let mut rest = silent.split_off(3);
    for mut made_way in silent.into_iter().skip(1) {
        assert_eq!(made_way.read(&mut [0]).await.unwrap(), 0, "it is closed");
    }
    drop((asked, rest.pop()));
}

#[tokio::test]
async fn lm15_places_of_those_who_do_not_read_become_free() {
    let patience = Duration::from_millis(50);
    let limits = Limits { connections: 3, of_one: 1, told: 2, patience, ..Limits::default() };
    let house = House::new(limits).await;
    let mut unread = Vec::new();
    for _ in 0..3 {
        unread.push(house.ask("/endless", 20).await);
    }
    let mut answer = house.answer("/anything").await;
    while answer == "no place" {
        answer = house.answer("/anything").await;
    }
    assert_eq!(answer, "", "not found");
}

#[tokio::test]
async fn requests_whose_head_cannot_be_read_are_told_why() {
    let house = House::new(Limits { connections: 3, of_one: 3, told: 2, patience: LONG, asking: LONG }).await;
    let long = "a".repeat(70_000);
    let many = "a: b\r\n".repeat(101);
    for (request, status, field) in [
        (format!("GET / HTTP/1.1\r\na: {long}\r\n\r\n"), 431, "headers"),
        (format!("GET / HTTP/1.1\r\n{many}\r\n"), 431, "headers"),
        ("GET / HTTP/9.1\r\n\r\n".to_owned(), 400, "request"),
        ("GET /a b c HTTP/1.1\r\n\r\n".to_owned(), 400, "request"),
    ] {
        let mut stream = TcpStream::connect(house.at).await.unwrap();
        let mut heard = Vec::new();
        let _ = stream.write_all(request.as_bytes()).await;
        stream.read_to_end(&mut heard).await.unwrap();
        let heard = String::from_utf8(heard).unwrap();
        let (head, body) = heard.split_once("\r\n\r\n").unwrap();
        assert!(head.starts_with(&format!("HTTP/1.1 {status} ")), "{head}");
        assert!(head.contains(&format!("content-length: {}\r\n", body.len())), "{head}");
        assert!(head.contains("content-type: application/problem+json\r\n"), "{head}");
        let problem: espalier_proto::HttpProblem = serde_json::from_str(body).unwrap();
        assert_eq!((problem.status, problem.field.as_deref()), (status, Some(field)));
        assert!(problem.allowed.is_some());
    }
}

#[tokio::test]
async fn a_server_that_stops_does_not_wait_for_those_who_ask_for_nothing() {
    let house = House::new(Limits { connections: 3, of_one: 1, told: 2, patience: LONG, asking: LONG }).await;
    let _silent = [house.ask("", 0).await, house.ask("", 0).await];
    assert_eq!(house.answer("/health").await, "ok");
    house.stop.cancel();
    house.serving.await.unwrap();
}

#[tokio::test]
async fn a_server_that_stops_does_not_wait_for_those_who_do_not_read() {
    let house = House::new(Limits { connections: 3, of_one: 1, told: 2, patience: LONG, asking: LONG }).await;
    let _unread = [house.ask("/endless", 1).await, house.ask("/endless", 20).await];
    assert_eq!(house.answer("/health").await, "ok");
    house.stop.cancel();
    house.serving.await.unwrap();
}
