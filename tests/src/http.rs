//! The few lines of HTTP/1.1 the tests speak: one request, one answer, one connection.

use std::{
    io::{self, Read, Write},
    net::TcpStream,
};

use espalier_proto::{HttpProblem, PROBLEM_JSON};
use serde_json::Value;

use crate::server::GUARD;

/// What came back.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The status.
    pub status: u16,
    /// The headers, one a line, as they came.
    pub headers: String,
    /// The body.
    pub body: Vec<u8>,
}

impl Answer {
    /// The body as text.
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    /// The body as JSON.
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }

    /// Whatever is refused comes with a problem that says why (`ER1`).
    fn assert_explains_itself(&self, method: &str, path: &str) {
        if self.status >= 400 && method != "HEAD" {
            let kind = self.header("content-type");
            assert_eq!(kind, Some(PROBLEM_JSON), "{method} {path}: {}", self.text());
            let problem: HttpProblem = serde_json::from_slice(&self.body)
                .unwrap_or_else(|error| panic!("{method} {path}: {error} in {}", self.text()));
            assert_eq!(problem.status, self.status, "{method} {path}");
        }
    }

    /// The first header of this name.
    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.lines().find_map(|line| {
            let (found, value) = line.split_once(':')?;
            found.eq_ignore_ascii_case(name).then(|| value.trim())
        })
    }
}

/// `GET path`.
pub fn get(port: u16, path: &str) -> io::Result<Answer> {
    send(port, "GET", path, None)
}

/// Any request, with or without a JSON body.
pub fn send(port: u16, method: &str, path: &str, body: Option<&Value>) -> io::Result<Answer> {
    let body = body.map(Value::to_string).unwrap_or_default();
    send_bytes(port, method, path, "application/json", body.as_bytes())
}

/// Any request that changes one revision only.
pub fn send_if(port: u16, method: &str, path: &str, revision: &str, body: &Value) -> io::Result<Answer> {
    let headers = format!("content-type: application/json\r\nif-match: {revision}\r\n");
    send_with(port, method, path, &headers, body.to_string().as_bytes())
}

/// Any request with a body of any type; an empty one is none.
pub fn send_bytes(port: u16, method: &str, path: &str, kind: &str, body: &[u8]) -> io::Result<Answer> {
    let headers = if body.is_empty() { String::new() } else { format!("content-type: {kind}\r\n") };
    send_with(port, method, path, &headers, body)
}

/// Any request with more headers, one a line.
pub fn send_with(port: u16, method: &str, path: &str, headers: &str, body: &[u8]) -> io::Result<Answer> {
    let mut request = format!("{method} {path} HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\nconnection: close\r\n");
    request += headers;
    if !body.is_empty() {
        request += &format!("content-length: {}\r\n", body.len());
    }
    request += "\r\n";
    let mut request = request.into_bytes();
    request.extend_from_slice(body);
    let mut stream = TcpStream::connect(("127.0.0.1", port))?;
    stream.set_read_timeout(Some(GUARD))?;
    stream.write_all(&request)?;
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes)?;
    let answer = parse(&bytes).ok_or_else(|| io::Error::other("the answer is not HTTP"))?;
    answer.assert_explains_itself(method, path);
    Ok(answer)
}

fn parse(bytes: &[u8]) -> Option<Answer> {
    let end = bytes.windows(4).position(|window| window == b"\r\n\r\n")?;
    let head = std::str::from_utf8(&bytes[..end]).ok()?;
    let (first, headers) = head.split_once("\r\n").unwrap_or((head, ""));
    let status = first.split(' ').nth(1)?.parse().ok()?;
    let mut answer = Answer { status, headers: headers.to_owned(), body: bytes[end + 4..].to_vec() };
    if answer.header("transfer-encoding").is_some_and(|coding| coding.contains("chunked")) {
        answer.body = unchunked(&answer.body)?;
    }
    Some(answer)
}

fn unchunked(mut bytes: &[u8]) -> Option<Vec<u8>> {
    let mut out = Vec::new();
    loop {
        let end = bytes.windows(2).position(|window| window == b"\r\n")?;
        let length = usize::from_str_radix(std::str::from_utf8(&bytes[..end]).ok()?.trim(), 16).ok()?;
        if length == 0 {
            return Some(out);
        }
        out.extend_from_slice(bytes.get(end + 2..end + 2 + length)?);
        bytes = bytes.get(end + 4 + length..)?;
    }
}
