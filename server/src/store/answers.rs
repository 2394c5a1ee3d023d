//! Answers that are given again when a request comes again with the same key (`IK`).

use super::StoreError;
use crate::access::SecretHash;

/// Answers kept at most; of more, the oldest are forgotten.
#[derive(Clone, Copy, Debug)]
pub struct MostAnswers {
    /// Of one caller.
    pub of_one: u64,
    /// Of all callers.
    pub of_all: u64,
}

impl Default for MostAnswers {
    fn default() -> Self {
        Self { of_one: 5_000, of_all: 50_000 }
    }
}

/// Keeps answers by the keys of their requests.
pub trait Answers {
    /// Notes that a request with a key is under way, unless there is one with that key which began after `since`; whether
    /// there was none.
    async fn begin_answer(
        &self,
        key: AnswerKey,
        at: &str,
        since: &str,
        most: MostAnswers,
    ) -> Result<bool, StoreError>;

    /// What is known of the request with a key.
    async fn answer(&self, key: AnswerKey) -> Result<Option<Answering>, StoreError>;

    /// Keeps the answer to a request that is under way.
    async fn keep_answer(&self, key: AnswerKey, answer: Answer) -> Result<(), StoreError>;

    /// Forgets a request, so that its key is as new.
    async fn forget_answer(&self, key: AnswerKey) -> Result<(), StoreError>;

    /// Forgets what began before a time.
    async fn purge_answers(&self, before: &str) -> Result<(), StoreError>;
}

/// What a request is known by: hashes, for who reads the database need not learn who asks, nor by which keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct AnswerKey {
    /// Of whoever asks.
    pub caller: SecretHash,
    /// Of whoever asks, in whose name, and the key.
    pub key: SecretHash,
}

/// Where a request with a key is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answering {
    /// It has no answer yet.
    UnderWay,
    /// This is its answer.
    Answered(Answer),
}

/// An answer, and to which request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// The hash of the address and the body of the request.
    pub request: SecretHash,
    /// The status.
    pub status: u16,
    /// Headers by their names.
    pub headers: Vec<(String, String)>,
    /// The body.
    pub body: Vec<u8>,
}
