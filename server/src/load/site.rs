//! The server that is measured, over HTTP: one request, one connection.

use std::{net::SocketAddr, str::FromStr, time::Duration};

use serde_json::Value;
use tokio::{
    io::{AsyncReadExt, AsyncWriteExt},
    net::{TcpStream, lookup_host},
    time::timeout,
};

use super::LoadError;

/// Longer than any answer takes; it keeps the driver from waiting for ever.
pub(super) const GUARD: Duration = Duration::from_mins(2);

/// Where a server is, and as whom one comes.
#[derive(Clone, Debug)]
pub struct Site {
    host: String,
    address: SocketAddr,
    token: Option<String>,
}

/// `http://HOST:PORT`, as it is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Url(String);

impl FromStr for Url {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let host = text.strip_prefix("http://").map(|rest| rest.trim_end_matches('/'));
        let host = host.filter(|host| !host.is_empty() && !host.contains('/'));
        host.map(|host| Self(host.to_owned())).ok_or_else(|| {
            "write it as http://HOST:PORT; the driver speaks to the server itself, not to a proxy with TLS".into()
        })
    }
}

impl Site {
    /// Finds it.
    ///
    /// # Errors
    /// Where there is no such machine.
    pub async fn find(Url(host): &Url, token: Option<String>) -> Result<Self, LoadError> {
        let with_port = if host.contains(':') { host.clone() } else { format!("{host}:80") };
        let found = lookup_host(&with_port).await.ok().and_then(|mut found| found.next());
        let address = found.ok_or_else(|| LoadError::NotThere(host.clone()))?;
        Ok(Self { host: host.clone(), address, token })
    }

    /// A bare connection.
    pub async fn connect(&self) -> Result<TcpStream, LoadError> {
        let stream = TcpStream::connect(self.address).await;
        let stream = stream.map_err(|error| LoadError::Silent(format!("{}: {error}", self.host)))?;
        // Like a browser: what is small goes out at once.
        let _ = stream.set_nodelay(true);
        Ok(stream)
    }

    /// The address of the socket of a session.
    pub fn socket(&self, session: &str) -> String {
        format!("ws://{}/api/v1/sessions/{session}/socket", self.host)
    }

    /// What stands in the header `Authorization`.
    pub fn bearer(&self) -> Option<String> {
        self.token.as_ref().map(|token| format!("Bearer {token}"))
    }

    /// The text of an answer.
    pub async fn ask(&self, method: &str, path: &str, body: Option<&Value>) -> Result<String, LoadError> {
        let body = body.map(Value::to_string).unwrap_or_default();
        let bearer = self.bearer().map(|bearer| format!("Authorization: {bearer}\r\n")).unwrap_or_default();
        let request = format!(
            "{method} {path} HTTP/1.1\r\nHost: {}\r\n{bearer}Content-Type: application/json\r\n\
             Content-Length: {}\r\nConnection: close\r\n\r\n{body}",
            self.host,
            body.len()
        );
        let mut stream = self.connect().await?;
        let mut answer = Vec::new();
        let asked = async {
            stream.write_all(request.as_bytes()).await?;
            stream.read_to_end(&mut answer).await
        };
        let silent = |why: String| LoadError::Silent(format!("{method} {path}: {why}"));
        timeout(GUARD, asked)
            .await
            .map_err(|_| silent("no answer".into()))?
            .map_err(|error| silent(error.to_string()))?;
        let text = String::from_utf8_lossy(&answer);
        let (head, body) = text.split_once("\r\n\r\n").ok_or_else(|| silent("no answer".into()))?;
        let status: u16 = head.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or_default();
        if !(200..300).contains(&status) {
            return Err(LoadError::Refused { path: path.into(), status, body: body.trim().into() });
        }
        Ok(body.to_owned())
    }

    /// The same as JSON.
    pub async fn ask_json(&self, method: &str, path: &str, body: &Value) -> Result<Value, LoadError> {
        let text = self.ask(method, path, Some(body)).await?;
        serde_json::from_str(&text).map_err(|error| LoadError::Silent(format!("{method} {path}: {error}")))
    }

    /// A new session; its name.
    pub async fn begin_session(&self, body: &Value) -> Result<String, LoadError> {
        let made = self.ask_json("POST", "/api/v1/sessions", body).await?;
        Ok(made["session"].as_str().unwrap_or_default().to_owned())
    }

    /// Resident memory of the server, as its figures tell; nothing where its system does not.
    pub async fn memory(&self) -> Result<Option<u64>, LoadError> {
        let figures = self.ask("GET", "/metrics", None).await?;
        Ok(figure(&figures, "process_resident_memory_bytes"))
    }
}

/// A figure without labels.
fn figure(text: &str, name: &str) -> Option<u64> {
    text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(' ')?.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_those_of_servers() {
        assert_eq!("http://localhost:7700/".parse(), Ok(Url("localhost:7700".into())));
        for text in ["localhost:7700", "https://trees.example", "http://", "http://a/b"] {
            assert!(text.parse::<Url>().is_err(), "{text}");
        }
    }

    #[test]
    fn figures_are_found_by_their_whole_name() {
        let text = "# TYPE a gauge\na_more 3\na{of=\"x\"} 4\na 5\n";
        assert_eq!(figure(text, "a"), Some(5));
        assert_eq!(figure(text, "b"), None);
    }
}
