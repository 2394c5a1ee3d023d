//! Each request with a number of its own: in every line of the log that it causes, in its answer, and, if that is wanted, in a
//! line about itself.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use axum::{
    extract::{Request, State},
    http::{HeaderName, HeaderValue},
    middleware::Next,
    response::Response,
};
use tracing::Instrument;

use crate::access::{self, Peer};

/// The number of a request, in its answer.
pub(super) const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");

/// How requests were answered.
#[derive(Clone, Debug, Default)]
pub struct Requests(Arc<Counts>);

#[derive(Debug, Default)]
struct Counts {
    begun: AtomicU64,
    /// Answers by the first digit of their status, from 1 to 5.
    answered: [AtomicU64; 5],
    /// Microseconds until answers began.
    micros: AtomicU64,
    is_logged: bool,
}

impl Requests {
    /// Each of them has a line of its own in the log, or none has.
    pub fn logged(is_logged: bool) -> Self {
        Self(Arc::new(Counts { is_logged, ..Counts::default() }))
    }

    /// A socket has ended that was open for so long.
    pub(super) fn socket_ended(&self, open: Duration) {
        if self.0.is_logged {
            tracing::info!(target: "access", seconds = open.as_secs_f64(), "socket ended");
        }
    }

    /// Answers by the first digit of their status, from 1 to 5.
    pub fn answered(&self) -> [u64; 5] {
        [0, 1, 2, 3, 4].map(|digit| self.0.answered[digit].load(Ordering::Relaxed))
    }

    /// Seconds that all answers together took to begin.
    pub fn seconds(&self) -> f64 {
        self.0.micros.load(Ordering::Relaxed) as f64 / 1e6
    }
}

/// Numbers a request, and counts how it was answered.
pub(super) async fn numbered(State(requests): State<Requests>, request: Request, next: Next) -> Response {
    let Requests(counts) = &requests;
    let number = counts.begun.fetch_add(1, Ordering::Relaxed) + 1;
    let begun = Instant::now();
    let said = counts.is_logged.then(|| {
        let from = access::address(request.extensions().get::<Peer>());
        // What stands behind the question mark may be somebody's secret.
        (request.method().clone(), request.uri().path().to_owned(), from)
    });
    let span = tracing::info_span!("request", number);
    let mut response = next.run(request).instrument(span.clone()).await;
    let took = begun.elapsed();
    let status = response.status().as_u16();
    if let Some(count) = counts.answered.get(usize::from(status / 100).wrapping_sub(1)) {
        count.fetch_add(1, Ordering::Relaxed);
    }
    counts.micros.fetch_add(u64::try_from(took.as_micros()).unwrap_or(u64::MAX), Ordering::Relaxed);
    if let Some((method, path, from)) = said {
        let millis = took.as_secs_f64() * 1e3;
        span.in_scope(|| tracing::info!(target: "access", %method, path, status, millis, %from, "answered"));
    }
    if let Ok(value) = HeaderValue::from_str(&number.to_string()) {
        response.headers_mut().insert(REQUEST_ID, value);
    }
    response
}
