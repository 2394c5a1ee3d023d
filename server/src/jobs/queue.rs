//! Whose turn it is: those who ordered jobs take turns, and the jobs of each are done in their order.

use std::collections::BTreeMap;

/// Jobs with trees to grow.
#[derive(Debug, Default)]
pub(super) struct Queue {
    /// By whom, and the name of the job, in the order in which they came.
    jobs: Vec<(String, String)>,
    /// When each of those who wait had a turn last, or came.
    turns: BTreeMap<String, u64>,
    turn: u64,
}

impl Queue {
    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.jobs.len()
    }

    /// How many somebody has.
    pub(super) fn of(&self, person: &str) -> usize {
        self.jobs.iter().filter(|(by, _)| by == person).count()
    }

    /// Adds a job of somebody.
    pub(super) fn add(&mut self, person: String, name: String) {
        // Whoever comes anew is behind nobody's second turn, and before nobody's first.
        self.turns.entry(person.clone()).or_insert(self.turn);
        self.jobs.push((person, name));
    }

    /// Takes a job out.
    pub(super) fn remove(&mut self, name: &str) {
        self.jobs.retain(|(_, other)| other != name);
        let Self { jobs, turns, .. } = self;
        turns.retain(|person, _| jobs.iter().any(|(by, _)| by == person));
    }

    /// The job whose turn it is; it stays until it is taken out.
    pub(super) fn next(&mut self) -> Option<String> {
        let (person, name) = self.jobs.get(first(&self.jobs, &self.turns)?)?.clone();
        self.turn += 1;
        self.turns.insert(person, self.turn);
        Some(name)
    }

    /// All jobs in the order in which they begin.
    pub(super) fn in_order(&self) -> Vec<&str> {
        let (mut jobs, mut turns, mut turn) =
            (self.jobs.iter().collect::<Vec<_>>(), self.turns.clone(), self.turn);
        let mut order = Vec::with_capacity(jobs.len());
        while let Some(index) = first(jobs.iter().copied(), &turns) {
            let (person, name) = jobs.remove(index);
            turn += 1;
            turns.insert(person.clone(), turn);
            order.push(name.as_str());
        }
        order
    }
}

/// The place of the first job of whoever has waited for the longest.
fn first<'a>(
    jobs: impl IntoIterator<Item = &'a (String, String)>,
    turns: &BTreeMap<String, u64>,
) -> Option<usize> {
    let had = |(person, _): &(String, String)| turns.get(person).copied().unwrap_or(0);
    let jobs = jobs.into_iter().enumerate();
    jobs.min_by_key(|(_, job)| had(job)).map(|(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn queue(jobs: &[(&str, &str)]) -> Queue {
        let mut queue = Queue::default();
        jobs.iter().for_each(|(person, name)| queue.add((*person).into(), (*name).into()));
        queue
    }

    #[test]
    fn jb6_each_has_a_turn_before_anybody_has_another() {
        let mut queue =
            queue(&[("a", "a1"), ("a", "a2"), ("a", "a3"), ("b", "b1"), ("c", "c1"), ("b", "b2")]);
        assert_eq!(queue.in_order(), ["a1", "b1", "c1", "a2", "b2", "a3"]);
        let turns: Vec<_> = (0..6).filter_map(|_| queue.next()).collect();
        assert_eq!(turns, ["a1", "b1", "c1", "a1", "b1", "c1"], "a job has turns until it is done");
        queue.remove("a1");
        queue.add("d".into(), "d1".into());
        assert_eq!(queue.next().as_deref(), Some("a2"));
        assert_eq!((queue.of("a"), queue.len()), (2, 6));
    }

    #[test]
    fn jb6_whoever_orders_one_at_a_time_is_not_first_each_time() {
        let mut queue = queue(&[("a", "a1"), ("b", "b1")]);
        assert_eq!(queue.next().as_deref(), Some("a1"));
        queue.remove("a1");
        queue.add("a".into(), "a2".into());
        assert_eq!(queue.next().as_deref(), Some("b1"));
    }
}
