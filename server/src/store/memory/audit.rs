//! The list of events in the model.

use super::{
    super::{Audit, Event, MOST_EVENTS, Noted, StoreError, audit::MOST_REFUSED},
    MemoryStore,
};

impl Audit for MemoryStore {
    async fn note(&self, event: Event) -> Result<(), StoreError> {
        let mut kept = self.writing()?;
        let since = event.counted_since();
        let alike = |noted: &&mut Noted| {
            let Event { at, who, action, outcome, .. } = &noted.event;
            *at >= since && (who, action, outcome) == (&event.who, &event.action, &event.outcome)
        };
        let mut alike: Vec<&mut Noted> = kept.events.values_mut().filter(alike).collect();
        let is_equal = |noted: &&mut Noted| {
            (&noted.event.address, &noted.event.object) == (&event.address, &event.object)
        };
        let equal = alike.iter().rposition(is_equal);
        let last = (event.is_refused() && alike.len() >= MOST_REFUSED as usize).then(|| alike.len() - 1);
        if let Some(index) = equal.or(last).filter(|_| event.may_repeat()) {
            alike[index].times += 1;
            alike[index].last_at = Some(event.at);
            return Ok(());
        }
        kept.last_event += 1;
        let number = kept.last_event;
        kept.events.insert(number, Noted { number, event, times: 1, last_at: None });
        kept.events.retain(|&other, _| other + MOST_EVENTS > number);
        Ok(())
    }

    async fn events(&self, limit: u32, before: Option<u64>) -> Result<Vec<Noted>, StoreError> {
        let kept = self.kept();
        let found = kept.events.range(..before.unwrap_or(u64::MAX)).rev().take(limit as usize);
        Ok(found.map(|(_, noted)| noted.clone()).collect())
    }

    async fn purge_events(&self, before: &str) -> Result<(), StoreError> {
        self.writing()?
            .events
            .retain(|_, noted| **noted.last_at.as_ref().unwrap_or(&noted.event.at) >= *before);
        Ok(())
    }
}
