//! The list of events in the model.

use super::{
    super::{Audit, Event, MOST_EVENTS, StoreError},
    MemoryStore,
};

impl Audit for MemoryStore {
    async fn note(&self, event: Event) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let number = kept.events.last_key_value().map_or(1, |(number, _)| number + 1);
        kept.events.insert(number, event);
        kept.events.retain(|&other, _| other + MOST_EVENTS > number);
        Ok(())
    }

    async fn events(&self, limit: u32, before: Option<u64>) -> Result<Vec<(u64, Event)>, StoreError> {
        let kept = self.kept();
        let found = kept.events.range(..before.unwrap_or(u64::MAX)).rev().take(limit as usize);
        Ok(found.map(|(number, event)| (*number, event.clone())).collect())
    }

    async fn purge_events(&self, before: &str) -> Result<(), StoreError> {
        self.writing()?.events.retain(|_, event| *event.at >= *before);
        Ok(())
    }
}
