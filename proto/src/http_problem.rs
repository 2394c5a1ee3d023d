//! A problem as answers over HTTP tell it (RFC 9457).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    problem::{Problem, ProblemCode},
    reason::Reason,
};

/// The media type of every answer that is no success.
pub const PROBLEM_JSON: &str = "application/problem+json";

/// Where one reads about a reason: the page of the API has a paragraph for each.
const READ_ABOUT: &str = "/api#";

/// What is wrong with a request, in the form of RFC 9457.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HttpProblem {
    /// Where one reads about the reason: an address on this server.
    #[serde(rename = "type")]
    #[schemars(extend("format" = "uri-reference"))]
    pub about: String,
    /// What the reason says, the same each time.
    pub title: String,
    /// The status of the answer.
    pub status: u16,
    /// A sentence that says what was wrong this time.
    pub detail: String,
    /// The kind of refusal.
    pub code: ProblemCode,
    /// Why, for programs that have words of their own for it.
    pub reason: Reason,
    /// The field at fault, as a path: `samples[3].radius`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
    /// What is allowed there: `0 to 40`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub allowed: Option<String>,
    /// What is wrong with a file, where the reason alone does not say it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
}

impl HttpProblem {
    /// The problem in an answer with this status.
    pub fn new(problem: Problem, status: u16) -> Self {
        let Problem { code, reason, field, allowed, cause, message: detail } = problem;
        let about = format!("{READ_ABOUT}{}", reason.name());
        let title = reason.sentence().to_owned();
        Self { about, title, status, detail, code, reason, field, allowed, cause }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_rfc_9457_names_stands_beside_what_is_ours() {
        let problem = Problem::new(Reason::NoTree, "There is no such tree.").at("tree", "an identifier");
        let told = serde_json::to_value(HttpProblem::new(problem, 404)).unwrap();
        let expected = json!({
            "type": "/api#no-tree", "title": "There is no such tree in the library.", "status": 404,
            "detail": "There is no such tree.", "code": "not_found", "reason": "no-tree", "field": "tree",
            "allowed": "an identifier",
        });
        assert_eq!(told, expected);
    }
}
