//! What went wrong, in words a person can act on.

use espalier_settings::OutOfRange;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::reason::Reason;

/// What kind of refusal this is; programs branch on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(rename_all = "snake_case")]
pub enum ProblemCode {
    /// The message is not JSON of a known shape.
    Malformed,
    /// A value lies outside its range.
    OutOfRange,
    /// Too many of something in one message.
    TooMany,
    /// The command is well formed but cannot be done to this document now.
    Refused,
    /// There is no such session, tree or stroke.
    NotFound,
    /// Somebody else has changed it meanwhile (`If-Match`).
    Stale,
    /// The server could not keep its promise (a full disk, say); nothing was changed.
    Unavailable,
}

/// One error, as it is sent to a client and printed by the command line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(deny_unknown_fields)]
pub struct Problem {
    /// The kind of refusal.
    pub code: ProblemCode,
    /// Why, for programs that have words of their own for it.
    pub reason: Reason,
    /// The field at fault, as a path: `samples[3].radius`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub field: Option<String>,
    /// What is allowed there: `0 to 40`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub allowed: Option<String>,
    /// What is wrong with a file, where the reason alone does not say it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub cause: Option<String>,
    /// A sentence that says what was wrong.
    pub message: String,
}

impl Problem {
    /// A problem without a field.
    pub fn new(reason: Reason, message: impl Into<String>) -> Self {
        let (code, message) = (reason.code(), message.into());
        Self { code, reason, field: None, allowed: None, cause: None, message }
    }

    /// A value outside its range.
    pub fn out_of_range(
        field: impl Into<String>,
        value: impl std::fmt::Display,
        allowed: impl Into<String>,
    ) -> Self {
        let (field, allowed) = (field.into(), allowed.into());
        Self::new(Reason::OutOfRange, format!("{field} is {value}; allowed: {allowed}")).at(field, allowed)
    }

    /// The same problem with the field at fault and what is allowed there.
    #[must_use]
    pub fn at(self, field: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self { field: Some(field.into()), allowed: Some(allowed.into()), ..self }
    }

    /// The reason of a close frame: the problem's own and its sentence (`HS6`).
    pub fn in_close(&self) -> String {
        format!("{}: {}", self.reason.name(), self.message)
    }

    /// The same problem with its field inside `outer`: `radius` becomes `samples[3].radius`.
    #[must_use]
    pub fn within(mut self, outer: &str) -> Self {
        if let Some(field) = &mut self.field {
            let inner = field.clone();
            *field = format!("{outer}.{inner}");
            self.message = self.message.replacen(&inner, field, 1);
        } else {
            // It is about all of that part.
            self.message = self.message.replacen("the message", outer, 1);
            self.field = Some(outer.to_owned());
        }
        self
    }
}

impl From<OutOfRange> for Problem {
    fn from(error: OutOfRange) -> Self {
        Self::out_of_range(error.field, error.value, error.allowed)
    }
}

impl std::fmt::Display for Problem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Problem {}
