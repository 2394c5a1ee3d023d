//! The one place where a problem becomes the answer to a request (RFC 9457).

use axum::{
    body::Body,
    http::{HeaderValue, StatusCode, header},
    response::Response,
};
use espalier_proto::{HttpProblem, PROBLEM_JSON, Problem};

/// The body of such an answer.
pub fn body(status: StatusCode, problem: Problem) -> Vec<u8> {
    // Plain values always have a JSON form.
    serde_json::to_vec(&HttpProblem::new(problem, status.as_u16())).unwrap_or_default()
}

/// The answer.
pub fn answer(status: StatusCode, problem: Problem) -> Response {
    let mut response = Response::new(Body::from(body(status, problem)));
    *response.status_mut() = status;
    response.headers_mut().insert(header::CONTENT_TYPE, HeaderValue::from_static(PROBLEM_JSON));
    response
}
