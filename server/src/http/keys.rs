//! Requests with a key of their sender's own (`IK`): each is done once, and answered again when it comes again.

use std::{
    collections::BTreeSet,
    io::{self, ErrorKind},
    panic::AssertUnwindSafe,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::{Duration, SystemTime},
};

use axum::{
    Extension,
    body::{self, Body, HttpBody},
    extract::{Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};
use espalier_proto::{Problem, Reason};
use espalier_session::Principal;
use futures_util::{FutureExt, StreamExt, TryStreamExt, stream};
use sha2::{Digest, Sha256};
use tokio::time::{Instant, timeout_at};
use tokio_util::{sync::CancellationToken, task::TaskTracker};

use super::{
    Shared,
    failure::{Failure, MostBytes},
};
use crate::{
    access::{Caller, SecretHash, hash},
    store::{Answer, AnswerKey, Answering, Answers, MostAnswers},
    time::written,
};

/// The key, as draft-ietf-httpapi-idempotency-key-header has it.
pub(super) const KEY: HeaderName = HeaderName::from_static("idempotency-key");
/// What a key is.
const KEYS: &str = "1 to 255 visible characters of ASCII, also in quotes";
/// Characters of a key.
pub(super) const LONGEST: usize = 255;
/// How long an answer is kept.
pub const KEPT: Duration = Duration::from_hours(24);
/// Answers with more bytes are not kept.
const MAX_ANSWER: usize = 32 * 1024;
/// The headers that are part of an answer.
const HEADERS: [HeaderName; 3] = [header::CONTENT_TYPE, header::LOCATION, header::ETAG];

/// What becomes of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shown {
    /// It is given again.
    Again,
    /// It has a secret that is kept nowhere.
    Once,
}

/// What is known at an address that takes keys.
#[derive(Clone, Debug)]
pub(super) struct Keyed {
    pub(super) shared: Shared,
    pub(super) shown: Shown,
    /// How long a request may take.
    pub(super) time_limit: Duration,
}

/// Says of a response that it is the answer to an earlier request, so that nothing was done.
#[derive(Clone, Copy, Debug)]
pub(super) struct Repeated;

/// Requests with keys that this server is at.
#[derive(Clone, Debug, Default)]
pub struct UnderWay {
    keys: Arc<Mutex<BTreeSet<AnswerKey>>>,
    work: TaskTracker,
    stop: CancellationToken,
}

/// The only request with its key, until it is dropped.
struct Place(UnderWay, AnswerKey);

impl UnderWay {
    /// None. From `stop` on, bodies that have not come are waited for no longer.
    pub fn new(stop: CancellationToken) -> Self {
        Self { stop, ..Self::default() }
    }

    /// Waits until each of them has its answer, or its key is free. No others may come meanwhile.
    pub async fn ended(&self) {
        self.work.close();
        self.work.wait().await;
    }

    /// None where there is such a request already.
    fn enter(&self, key: AnswerKey) -> Option<Place> {
        let is_first = lock(&self.keys).insert(key);
        is_first.then(|| Place(self.clone(), key))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        lock(&self.0.keys).remove(&self.1);
    }
}

/// Does a request with a key once. It goes on where whoever asked no longer waits, so that they find its answer.
pub(super) async fn once(
    State(Keyed { shared, shown, time_limit }): State<Keyed>,
    Extension(caller): Extension<Caller>,
    Extension(principal): Extension<Principal>,
    request: Request,
    next: Next,
) -> Response {
    let key = match key_of(request.headers()) {
        Ok(None) => return next.run(request).await,
        Ok(Some(key)) => answer_key(&caller, &principal, &key),
        Err(problem) => return Failure::from(problem).into_response(),
    };
    let Some(place) = shared.under_way.enter(key) else {
        return refused(Reason::KeyUnderWay, "The request with this key is under way.").into_response();
    };
    // From here on it is of no matter whether whoever asked still waits.
    let work = shared.under_way.work.clone();
    let answered = work.spawn(async move {
        let response = answer(&shared, key, (shown, time_limit), request, next).await;
        drop(place);
        response
    });
    answered.await.unwrap_or_else(|error| {
        tracing::error!(%error, "a request with a key failed");
        failed().into_response()
    })
}

/// Does a request, unless one with its key has been done.
async fn answer(
    shared: &Shared,
    key: AnswerKey,
    (shown, time_limit): (Shown, Duration),
    request: Request,
    next: Next,
) -> Response {
    let stop = &shared.under_way.stop;
    let (request, seen) = watched(request, time_limit, stop.clone());
    match found(shared, key).await {
        Err(failure) => failure.into_response(),
        Ok(Some(Answering::UnderWay)) => {
            let sentence =
                "The server stopped while the request with this key was under way; look whether it was done.";
            refused(Reason::OutcomeUnknown, sentence).into_response()
        }
        Ok(Some(Answering::Answered(answer))) => match digest(request).await {
            Ok(digest) if digest == answer.request => again(answer),
            Ok(_) => refused(Reason::KeyOfAnother, "Another request had this key.").into_response(),
            Err(failure) => failure.into_response(),
        },
        Ok(None) => {
            // A panic frees the key, as every failure of the server does.
            let done = AssertUnwindSafe(next.run(request)).catch_unwind().await;
            let mut response = done.unwrap_or_else(|_| {
                tracing::error!("a request with a key panicked");
                failed().into_response()
            });
            if stop.is_cancelled() && !response.status().is_success() && !lock(&seen).is_whole {
                response = Failure::new(Reason::Stopping, "The server is stopping.").into_response();
            }
            keep(shared, key, shown, &seen, response).await
        }
    }
}

fn failed() -> Failure {
    Failure::new(Reason::Failed, "The server failed to compute this.")
}

/// What is known of an earlier request with a key; where there is none, this one is under way from now on.
async fn found(shared: &Shared, key: AnswerKey) -> Result<Option<Answering>, Failure> {
    let now = SystemTime::now();
    loop {
        let most = MostAnswers::default();
        if shared.store.begin_answer(key, &written(now), &written(now - KEPT), most).await? {
            return Ok(None);
        }
        // It may have gone in between, for those of one caller are bounded.
        if let Some(answering) = shared.store.answer(key).await? {
            return Ok(Some(answering));
        }
    }
}

/// The key that a request has.
fn key_of(headers: &HeaderMap) -> Result<Option<String>, Problem> {
    let mut all = headers.get_all(KEY).iter();
    let (first, second) = (all.next(), all.next());
    let Some(value) = first else { return Ok(None) };
    let text = value.to_str().unwrap_or_default().trim();
    let text = text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text);
    let is_one = second.is_none() && (1..=LONGEST).contains(&text.len());
    if is_one && text.bytes().all(|byte| byte.is_ascii_graphic() && byte != b'"') {
        return Ok(Some(text.to_owned()));
    }
    Err(Problem::new(Reason::Malformed, "The request cannot be read: its idempotency key is none.")
        .at(KEY.as_str(), KEYS))
}

/// What a key is kept by. Those who act in other names, or as other callers, do not meet.
pub(super) fn answer_key(caller: &Caller, principal: &Principal, key: &str) -> AnswerKey {
    let person = caller.person();
    AnswerKey { caller: hash(&person), key: hash(&format!("{person}\n{principal}\n{key}")) }
}

/// What is seen of a request while it is read.
struct Seen {
    digest: Sha256,
    is_whole: bool,
}

/// Of what a request asks for, without its body: the address, and the revision that it is for. With its key, which is
/// kept nowhere, so that who reads the database finds no password by guessing what was sent.
fn digest_of_head(request: &Request) -> Sha256 {
    let key = key_of(request.headers()).ok().flatten().unwrap_or_default();
    let revision = request.headers().get(header::IF_MATCH).map_or(&b""[..], HeaderValue::as_bytes);
    let (method, address) = (request.method(), request.uri());
    let head = format!("{key}\n{method} {address}\n{}\n", String::from_utf8_lossy(revision));
    Sha256::new_with_prefix(head)
}

/// Has the body looked at while it is read, so that no request is held twice. A body that has not come in this time, or
/// before the server stops, is cut off, as it is where nobody goes on with a request that is given up.
fn watched(request: Request, patience: Duration, stop: CancellationToken) -> (Request, Arc<Mutex<Seen>>) {
    let (digest, is_whole) = (digest_of_head(&request), request.body().is_end_stream());
    let seen = Arc::new(Mutex::new(Seen { digest, is_whole }));
    if is_whole {
        return (request, seen);
    }
    let reading = Arc::clone(&seen);
    let request = request.map(|body| {
        let end = Instant::now() + patience;
        Body::from_stream(stream::try_unfold(body.into_data_stream(), move |mut bytes| {
            let (seen, stop) = (Arc::clone(&reading), stop.clone());
            async move {
                let next = stop.run_until_cancelled(timeout_at(end, bytes.try_next())).await;
                let next = next.ok_or_else(|| io::Error::from(ErrorKind::ConnectionAborted))?;
                let next = next.map_err(io::Error::from)?.map_err(io::Error::other)?;
                match &next {
                    Some(some) => lock(&seen).digest.update(some),
                    None => lock(&seen).is_whole = true,
                }
                Ok::<_, io::Error>(next.map(|some| (some, bytes)))
            }
        }))
    });
    (request, seen)
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The hash of a request that comes again.
async fn digest(request: Request) -> Result<SecretHash, Failure> {
    let mut digest = digest_of_head(&request);
    let most = MostBytes::of(&request);
    if most.are_exceeded(request.headers()) {
        return Err(most.exceeded().into());
    }
    let cut_off = |_| {
        Problem::new(Reason::Malformed, "The request did not arrive whole.").at("body", "a whole request")
    };
    let (mut length, mut bytes) = (0, request.into_body().into_data_stream());
    while let Some(some) = bytes.next().await {
        let some = some.map_err(cut_off)?;
        length += some.len();
        if length > most.bytes() {
            return Err(most.exceeded().into());
        }
        digest.update(some);
    }
    Ok(digest.finalize().into())
}

/// Keeps what a request was answered, unless it is to be tried again.
async fn keep(
    shared: &Shared,
    key: AnswerKey,
    shown: Shown,
    seen: &Mutex<Seen>,
    response: Response,
) -> Response {
    let request =
        Some(lock(seen)).filter(|seen| seen.is_whole).map(|seen| seen.digest.clone().finalize().into());
    let status = response.status();
    let is_kept = !status.is_server_error() && status != StatusCode::TOO_MANY_REQUESTS;
    let (kept, response) = match request.filter(|_| is_kept) {
        None => (shared.store.forget_answer(key).await, response),
        Some(request) => match answer_of(request, response).await {
            Err(failure) => return failure.into_response(),
            Ok((answer, response)) => {
                let is_given_again = shown == Shown::Again || !status.is_success();
                let kept = if is_given_again && answer.body.len() <= MAX_ANSWER {
                    Ok(answer)
                } else {
                    let sentence = "The request with this key was done; its answer is not kept.";
                    let instead = refused(Reason::AnswerNotKept, sentence).into_response();
                    answer_of(request, instead).await.map(|(answer, _)| answer)
                };
                match kept {
                    Err(failure) => return failure.into_response(),
                    Ok(kept) => (shared.store.keep_answer(key, kept).await, response),
                }
            }
        },
    };
    if let Err(error) = kept {
        tracing::error!(%error, "the answer to a request with a key could not be kept");
    }
    response
}

/// What is kept of a response, and the response.
async fn answer_of(request: SecretHash, response: Response) -> Result<(Answer, Response), Failure> {
    let (parts, body) = response.into_parts();
    let body = body::to_bytes(body, usize::MAX).await.map_err(|error| {
        tracing::error!(%error, "an answer cannot be read");
        Failure::new(Reason::Failed, "The server failed to answer this.")
    })?;
    let text = |name: &HeaderName| {
        let value = parts.headers.get(name)?.to_str().ok()?;
        Some((name.to_string(), value.to_owned()))
    };
    let headers = HEADERS.iter().filter_map(text).collect();
    let answer = Answer { request, status: parts.status.as_u16(), headers, body: body.to_vec() };
    Ok((answer, Response::from_parts(parts, Body::from(body))))
}

/// The response that was given before.
fn again(Answer { status, headers, body, .. }: Answer) -> Response {
    let mut response = Response::new(Body::from(body));
    *response.status_mut() = StatusCode::from_u16(status).unwrap_or_default();
    for (name, value) in headers {
        let header = HeaderName::try_from(name).ok().zip(HeaderValue::try_from(value).ok());
        header.map(|(name, value)| response.headers_mut().insert(name, value));
    }
    response.extensions_mut().insert(Repeated);
    response
}

fn refused(reason: Reason, sentence: &str) -> Failure {
    Problem::new(reason, sentence).at(KEY.as_str(), "the key of no other request").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn ik1_a_body_that_does_not_come_is_cut_off() {
        let begun = stream::iter([Ok::<_, io::Error>("a")]).chain(stream::pending());
        for (body, patience, is_whole) in [
            (Body::from("whole"), Duration::from_hours(1), true),
            (Body::from_stream(begun), Duration::ZERO, false),
        ] {
            let (request, seen) = watched(Request::new(body), patience, CancellationToken::new());
            let read = body::to_bytes(request.into_body(), 10).await;
            assert_eq!((read.is_ok(), lock(&seen).is_whole), (is_whole, is_whole));
        }
    }

    #[test]
    fn ik1_a_key_is_written_with_quotes_or_without() {
        let of = |values: &[&str]| {
            let all = values.iter().map(|value| (KEY, HeaderValue::from_str(value).unwrap()));
            key_of(&all.fold(HeaderMap::new(), |mut all, (name, value)| {
                all.append(name, value);
                all
            }))
        };
        assert_eq!(of(&[]), Ok(None));
        for text in ["8e03978e-40d5", "\"8e03978e-40d5\"", " 8e03978e-40d5 "] {
            assert_eq!(of(&[text]), Ok(Some("8e03978e-40d5".to_owned())), "{text}");
        }
        let longest = "k".repeat(LONGEST);
        assert_eq!(of(&[&longest]), Ok(Some(longest.clone())));
        for values in [&["one", "two"][..], &[""], &["\"\""], &["a b"], &["\"a"], &[&format!("{longest}k")]] {
            let problem = of(values).unwrap_err();
            assert_eq!(problem.field.as_deref(), Some("idempotency-key"), "{values:?}");
        }
    }
}
