//! Whose turn it is: those who ordered something take turns, and what each ordered is done in its order.

use std::collections::BTreeMap;

/// What was ordered, jobs for short.
#[derive(Debug, Default)]
pub struct Queue {
    /// By whom, and the name of the job, in the order in which they came.
    jobs: Vec<(String, String)>,
    /// When each of those who wait had a turn last, or came: even numbers are turns, odd ones arrivals.
    turns: BTreeMap<String, u64>,
    turn: u64,
}

impl Queue {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.jobs.len()
    }

    /// How many somebody has.
    pub fn of(&self, person: &str) -> usize {
        self.jobs.iter().filter(|(by, _)| by == person).count()
    }

    /// Adds a job of somebody.
    pub fn add(&mut self, person: String, name: String) {
        // Whoever comes anew is before the one who had a turn last, and behind all who have waited longer.
        self.turns.entry(person.clone()).or_insert(self.turn.saturating_sub(1));
        self.jobs.push((person, name));
    }

    /// Takes a job out.
    pub fn remove(&mut self, name: &str) {
        self.jobs.retain(|(_, other)| other != name);
        let Self { jobs, turns, .. } = self;
        turns.retain(|person, _| jobs.iter().any(|(by, _)| by == person));
    }

    /// Whether it is the turn of this job.
    pub fn is_next(&self, name: &str) -> bool {
        first(&self.jobs, &self.turns).is_some_and(|first| self.jobs[first].1 == name)
    }

    /// The job whose turn it is; it stays until it is taken out.
    pub fn next(&mut self) -> Option<String> {
        let (person, name) = self.jobs.get(first(&self.jobs, &self.turns)?)?.clone();
        self.turn += 2;
        self.turns.insert(person, self.turn);
        Some(name)
    }

    /// All jobs in the order in which they begin, where each has so many turns before it is done.
    pub fn in_order(&self, left: impl Fn(&str) -> usize) -> Vec<&str> {
        // Of each person, the turns that they have had before, and the place of their first job.
        let mut had: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
        let mut all = Vec::with_capacity(self.jobs.len());
        for (place, (person, name)) in self.jobs.iter().enumerate() {
            let (turns, first) = had.entry(person).or_insert((0, place));
            all.push(((*turns, self.turns.get(person).copied().unwrap_or(0), *first), name.as_str()));
            *turns += left(name).max(1);
        }
        all.sort_by_key(|(begins, _)| *begins);
        all.into_iter().map(|(_, name)| name).collect()
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
        assert_eq!(queue.in_order(|_| 1), ["a1", "b1", "c1", "a2", "b2", "a3"]);
        let left = |name: &str| if name == "a1" { 2 } else { 1 };
        assert_eq!(
            queue.in_order(left),
            ["a1", "b1", "c1", "b2", "a2", "a3"],
            "a2 waits for both trees of a1"
        );
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

    #[test]
    fn jb6_whoever_comes_anew_does_not_wait_for_all_of_another_s() {
        let mut queue = queue(&[("a", "a1"), ("a", "a2")]);
        assert_eq!(queue.next().as_deref(), Some("a1"));
        queue.remove("a1");
        queue.add("b".into(), "b1".into());
        assert_eq!(queue.in_order(|_| 1), ["b1", "a2"]);
    }
}
