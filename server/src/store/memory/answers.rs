//! Answers to requests with keys, in the model.

use super::{
    super::{Answer, AnswerKey, Answering, Answers, MostAnswers, StoreError},
    MemoryStore,
};

/// A request with a key.
#[derive(Debug)]
pub(super) struct Begun {
    key: AnswerKey,
    at: String,
    answering: Answering,
}

impl Answers for MemoryStore {
    async fn begin_answer(
        &self,
        key: AnswerKey,
        at: &str,
        since: &str,
        most: MostAnswers,
    ) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        kept.answers.retain(|begun| begun.key != key || *begun.at >= *since);
        if kept.answers.iter().any(|begun| begun.key == key) {
            return Ok(false);
        }
        kept.answers.push(Begun { key, at: at.to_owned(), answering: Answering::UnderWay });
        let of_one = kept.answers.iter().filter(|begun| begun.key.caller == key.caller).count() as u64;
        if of_one > most.of_one {
            let oldest = kept.answers.iter().position(|begun| begun.key.caller == key.caller);
            oldest.map(|oldest| kept.answers.remove(oldest));
        }
        let too_many = kept.answers.len().saturating_sub(most.of_all as usize);
        kept.answers.drain(..too_many);
        Ok(true)
    }

    async fn answer(&self, key: AnswerKey) -> Result<Option<Answering>, StoreError> {
        let kept = self.kept();
        let found = kept.answers.iter().find(|begun| begun.key == key);
        Ok(found.map(|begun| begun.answering.clone()))
    }

    async fn keep_answer(&self, key: AnswerKey, answer: Answer) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        if let Some(begun) = kept.answers.iter_mut().find(|begun| begun.key == key) {
            begun.answering = Answering::Answered(answer);
        }
        Ok(())
    }

    async fn forget_answer(&self, key: AnswerKey) -> Result<(), StoreError> {
        self.writing()?.answers.retain(|begun| begun.key != key);
        Ok(())
    }

    async fn purge_answers(&self, before: &str) -> Result<(), StoreError> {
        self.writing()?.answers.retain(|begun| *begun.at >= *before);
        Ok(())
    }
}
