//! A running server, asked over HTTP as any other program would ask it.

use std::{str::FromStr, time::Duration};

use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use serde::{Deserialize, de::DeserializeOwned};
use ureq::{
    Agent, Body,
    http::{Method, Request, Response, header},
    tls::{RootCerts, TlsConfig},
};

/// How long a connection may take to come about,
const CONNECTING: Duration = Duration::from_secs(10);
/// and an answer to begin: a large file may be made a tree first.
const ANSWERING: Duration = Duration::from_mins(10);
/// What helps somebody whom a server does not know.
const TOKEN: &str = " Give a token with --token; `espalier token create` makes one.";
/// Where all addresses of the API begin.
const API: &str = "/api/v1";

/// `http://HOST:PORT` or `https://HOST`, as it is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address(String);

impl FromStr for Address {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let trimmed = text.trim_end_matches('/');
        let host = trimmed.strip_prefix("http://").or_else(|| trimmed.strip_prefix("https://"));
        let is_host = |host: &&str| {
            !host.is_empty()
                && host.chars().all(|letter| letter.is_alphanumeric() || "-._~:[]%".contains(letter))
        };
        match host.filter(is_host) {
            Some(_) => Ok(Self(trimmed.to_owned())),
            None => Err("write it as http://HOST:PORT or https://HOST".into()),
        }
    }
}

/// The server did not do it; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum SiteError {
    /// Nothing came back.
    #[error("The server at {address} does not answer ({cause}).")]
    Silent {
        /// Where it should be.
        address: String,
        /// What went wrong.
        cause: ureq::Error,
    },
    /// It refuses.
    #[error("The server at {address} refuses it: {detail}{}", if *is_stranger { TOKEN } else { "" })]
    Refused {
        /// Where it is.
        address: String,
        /// What it says.
        detail: String,
        /// Whether it does not know who asks.
        is_stranger: bool,
    },
    /// Something else answers there.
    #[error("What answers at {address} is no Espalier of this kind ({cause}).")]
    Strange {
        /// Where it is.
        address: String,
        /// What is strange.
        cause: String,
    },
}

/// What is read of a problem, so that one of a later server is understood as well.
#[derive(Deserialize)]
struct Problem {
    detail: String,
}

/// A server, and as whom one comes.
#[derive(Clone, Debug)]
pub struct Site {
    address: String,
    bearer: Option<String>,
    agent: Agent,
}

/// Whether a server is on this machine.
fn is_here(address: &str) -> bool {
    let host = address.split_once("://").map_or(address, |(_, host)| host);
    ["localhost", "127.", "[::1]"].iter().any(|here| host.starts_with(here))
}

/// The name of something as a part of a path.
pub fn part(name: &str) -> String {
    utf8_percent_encode(name, NON_ALPHANUMERIC).to_string()
}

impl Site {
    /// The server at an address.
    pub fn new(Address(address): &Address, token: Option<&str>) -> Self {
        let config = Agent::config_builder()
            .timeout_connect(Some(CONNECTING))
            .timeout_recv_response(Some(ANSWERING))
            // A studio's own authority is one where its machines have been told of it.
            .tls_config(TlsConfig::builder().root_certs(RootCerts::PlatformVerifier).build())
            // What a server refuses has its reasons in the body.
            .http_status_as_error(false)
            .user_agent(concat!("espalier/", env!("CARGO_PKG_VERSION")));
        // No proxy leads to this machine.
        let config = if is_here(address) { config.proxy(None) } else { config }.build();
        let bearer = token.map(|token| format!("Bearer {token}"));
        Self { address: address.clone(), bearer, agent: config.into() }
    }

    /// What is at a path, as JSON.
    pub fn get<T: DeserializeOwned>(&self, path: &str, query: &[(&str, String)]) -> Result<T, SiteError> {
        self.read(self.ask(Method::GET, path, query, None)?)
    }

    /// The same as bytes.
    pub fn file(&self, path: &str, query: &[(&str, String)]) -> Result<Vec<u8>, SiteError> {
        self.whole(self.ask(Method::GET, path, query, None)?)
    }

    /// The same, or nothing where there is no such thing.
    pub fn found<T: DeserializeOwned>(&self, path: &str) -> Result<Option<T>, SiteError> {
        let answer = self.answer(Method::GET, path, &[], None)?;
        if answer.status() == 404 { Ok(None) } else { self.read(self.accepted(answer)?).map(Some) }
    }

    /// Bytes, or nothing where there is no such thing.
    pub fn found_file(&self, path: &str) -> Result<Option<Vec<u8>>, SiteError> {
        let answer = self.answer(Method::GET, path, &[], None)?;
        if answer.status() == 404 { Ok(None) } else { self.whole(self.accepted(answer)?).map(Some) }
    }

    /// Sends a body of this type; the answer as JSON.
    pub fn send<T: DeserializeOwned>(
        &self,
        method: Method,
        path: &str,
        query: &[(&str, String)],
        (kind, body): (&str, Vec<u8>),
    ) -> Result<T, SiteError> {
        self.read(self.ask(method, path, query, Some((kind, body)))?)
    }

    fn ask(
        &self,
        method: Method,
        path: &str,
        query: &[(&str, String)],
        body: Option<(&str, Vec<u8>)>,
    ) -> Result<Response<Body>, SiteError> {
        self.accepted(self.answer(method, path, query, body)?)
    }

    fn answer(
        &self,
        method: Method,
        path: &str,
        query: &[(&str, String)],
        body: Option<(&str, Vec<u8>)>,
    ) -> Result<Response<Body>, SiteError> {
        let mut asked = form_urlencoded::Serializer::new(String::new());
        asked.extend_pairs(query);
        let asked = asked.finish();
        let mark = if asked.is_empty() { "" } else { "?" };
        let request =
            Request::builder().method(method).uri(format!("{}{API}{path}{mark}{asked}", self.address));
        let request =
            self.bearer.iter().fold(request, |all, bearer| all.header(header::AUTHORIZATION, bearer));
        let silent = |cause| SiteError::Silent { address: self.address.clone(), cause };
        let strange = |cause: ureq::http::Error| silent(cause.into());
        match body {
            None => self.agent.run(request.body(()).map_err(strange)?),
            Some((kind, body)) => {
                self.agent.run(request.header(header::CONTENT_TYPE, kind).body(body).map_err(strange)?)
            }
        }
        .map_err(silent)
    }

    fn accepted(&self, mut answer: Response<Body>) -> Result<Response<Body>, SiteError> {
        let status = answer.status();
        if status.is_success() {
            return Ok(answer);
        }
        let body = self.bytes(&mut answer)?;
        match serde_json::from_slice::<Problem>(&body) {
            Ok(problem) => Err(SiteError::Refused {
                address: self.address.clone(),
                detail: problem.detail,
                is_stranger: status == 401,
            }),
            Err(_) => Err(self.strange(format!("it answers {status}"))),
        }
    }

    fn read<T: DeserializeOwned>(&self, mut answer: Response<Body>) -> Result<T, SiteError> {
        let body = self.bytes(&mut answer)?;
        serde_json::from_slice(&body).map_err(|error| self.strange(error.to_string()))
    }

    fn whole(&self, mut answer: Response<Body>) -> Result<Vec<u8>, SiteError> {
        self.bytes(&mut answer)
    }

    fn bytes(&self, answer: &mut Response<Body>) -> Result<Vec<u8>, SiteError> {
        let body = answer.body_mut().with_config().limit(u64::MAX).read_to_vec();
        body.map_err(|cause| SiteError::Silent { address: self.address.clone(), cause })
    }

    fn strange(&self, cause: String) -> SiteError {
        SiteError::Strange { address: self.address.clone(), cause }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_those_of_servers() {
        for text in ["http://localhost:7700/", "https://trees.example", "http://[::1]:7700"] {
            let read: Result<Address, _> = text.parse();
            assert_eq!(read, Ok(Address(text.trim_end_matches('/').into())), "{text}");
        }
        for text in ["localhost:7700", "ftp://a", "http://", "http://a/b", "http://a?b", "http://me:pw@a"] {
            assert!(text.parse::<Address>().is_err(), "{text}");
        }
    }

    #[test]
    fn names_stay_one_part_of_a_path() {
        assert_eq!(part("../a b?c#d/é"), "%2E%2E%2Fa%20b%3Fc%23d%2F%C3%A9");
    }
}
