//! Whose turn it is on the simulation pool, as a pure function of what waits and what was charged.
//!
//! Slices of a more urgent class go first. Within a class people take turns by deficit round robin (Shreedhar and
//! Varghese 1995): each round gives everybody the same time, and whoever used more of it waits the longer. While
//! anybody draws, one worker is kept free of everything else, for a slice that was begun cannot be interrupted; and one
//! is always kept free of what is long in one piece, so that whoever begins to draw finds it.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::Arc,
    time::Duration,
};

/// What a slice of work is for; the most urgent first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Somebody's hand is on the tree: strokes, bends, edits, what a client is shown.
    Drawing,
    /// A tree grows alone, is predicted, or is read while people are in it.
    Growing,
    /// Somebody waits for something whole: a session restored, a file read, a picture.
    Whole,
    /// Nobody waits at this moment: jobs.
    Upkeep,
}

impl Class {
    const COUNT: usize = 4;

    /// All of them, each with its name.
    pub const ALL: [(Self, &'static str); Self::COUNT] = [
        (Self::Drawing, "drawing"),
        (Self::Growing, "growing"),
        (Self::Whole, "whole"),
        (Self::Upkeep, "upkeep"),
    ];
}

/// Of these a slice may take as long as a whole tree does.
const LONG: [Class; 2] = [Class::Whole, Class::Upkeep];

/// Who a slice is for. Whose name is not known shares one turn with all such.
pub type Person = Arc<str>;

/// Time of work that a round gives each person.
const QUANTUM: Micros = 4_000;
/// No person owes more rounds than this, however long their slice was.
const MOST_OWED: Micros = 4 * QUANTUM;
/// A class that waits while others work gets at least one part in this many.
const LEAST_SHARE: Micros = 20;
/// So long after something was drawn a worker is kept for more of it.
pub const KEPT_FOR: Duration = Duration::from_secs(2);

type Micros = i64;

/// What waits, and what is at work.
#[derive(Debug)]
pub struct Turns<T> {
    workers: usize,
    queues: [Queue<T>; Class::COUNT],
    /// Slices at work, by their class.
    at_work: [usize; Class::COUNT],
    /// Until when one worker is kept for drawing.
    kept_until: Duration,
}

/// A slice that is given to a worker.
#[derive(Debug)]
pub struct Given<T> {
    pub class: Class,
    pub person: Person,
    pub slice: T,
    /// Nothing else waits or works, and nobody draws: it may have all cores.
    pub is_alone: bool,
}

#[derive(Debug)]
struct Queue<T> {
    people: BTreeMap<Person, Lane<T>>,
    /// The order in which people have their turns.
    round: VecDeque<Person>,
    waiting: usize,
    /// Time that is owed to the class, for it waited while others worked.
    owed: Micros,
}

#[derive(Debug)]
struct Lane<T> {
    slices: VecDeque<T>,
    at_work: usize,
    /// What is left of the person's time, or below zero what they used beyond it.
    left: Micros,
}

impl<T> Turns<T> {
    /// Nothing waits for so many workers.
    pub fn new(workers: usize) -> Self {
        Self {
            workers,
            queues: std::array::from_fn(|_| Queue::default()),
            at_work: [0; Class::COUNT],
            kept_until: Duration::ZERO,
        }
    }

    /// Something is to be done. Times count from any moment and never go back.
    pub fn push(&mut self, now: Duration, class: Class, person: Person, slice: T) {
        if class == Class::Drawing {
            self.kept_until = now + KEPT_FOR;
        }
        self.queues[class as usize].push(person, slice);
    }

    /// The next slice for a worker that is free. Whoever takes it calls [`Turns::done`].
    pub fn take(&mut self, now: Duration) -> Option<Given<T>> {
        let class = self.next_class(now)?;
        let queue = &mut self.queues[class as usize];
        let (person, slice) = queue.take()?;
        let is_alone = self.is_idle() && (class == Class::Drawing || now >= self.kept_until);
        self.at_work[class as usize] += 1;
        Some(Given { class, person, slice, is_alone })
    }

    /// A slice has taken so long.
    pub fn done(&mut self, class: Class, person: &Person, took: Duration) {
        self.at_work[class as usize] -= 1;
        let took = Micros::try_from(took.as_micros()).unwrap_or(Micros::MAX);
        for (of, queue) in self.queues.iter_mut().enumerate() {
            if of == class as usize {
                queue.charge(person, took);
            } else if queue.waiting > 0 {
                queue.owed = queue.owed.saturating_add(took / LEAST_SHARE);
            }
        }
    }

    /// Slices that wait for a worker.
    pub fn waiting(&self) -> usize {
        self.queues.iter().map(|queue| queue.waiting).sum()
    }

    /// The same by their class.
    pub fn waiting_by_class(&self) -> [usize; Class::COUNT] {
        std::array::from_fn(|class| self.queues[class].waiting)
    }

    /// Whether there is nothing to do, and nothing being done.
    pub fn is_idle(&self) -> bool {
        self.at_work == [0; Class::COUNT] && self.waiting() == 0
    }

    /// The same of all that somebody waits for.
    pub fn keeps_nobody(&self) -> bool {
        let of = |class: Class| self.at_work[class as usize] + self.queues[class as usize].waiting;
        [Class::Drawing, Class::Growing, Class::Whole].into_iter().all(|class| of(class) == 0)
    }

    /// When a worker that found nothing may find something, though nothing was pushed or done since.
    pub fn look_again(&self) -> Option<Duration> {
        (self.waiting() > 0).then_some(self.kept_until)
    }

    fn next_class(&self, now: Duration) -> Option<Class> {
        // What is long may have all workers but one.
        let long: usize = LONG.iter().map(|&class| self.at_work[class as usize]).sum();
        let may_long = long + 1 < self.workers.max(2);
        let waits =
            |class: Class| self.queues[class as usize].waiting > 0 && (may_long || !LONG.contains(&class));
        let others = self.at_work.iter().sum::<usize>() - self.at_work[Class::Drawing as usize];
        let may_others = now >= self.kept_until || others + 1 < self.workers;
        if !may_others {
            return waits(Class::Drawing).then_some(Class::Drawing);
        }
        let starved = [Class::Upkeep, Class::Whole, Class::Growing];
        let mut starved = starved.into_iter().filter(|&class| self.queues[class as usize].owed >= QUANTUM);
        let all = [Class::Drawing, Class::Growing, Class::Whole, Class::Upkeep];
        starved.find(|&class| waits(class)).or_else(|| all.into_iter().find(|&class| waits(class)))
    }
}

impl<T> Default for Queue<T> {
    fn default() -> Self {
        Self { people: BTreeMap::new(), round: VecDeque::new(), waiting: 0, owed: 0 }
    }
}

impl<T> Queue<T> {
    fn push(&mut self, person: Person, slice: T) {
        let lane = self.people.entry(Arc::clone(&person)).or_insert_with(|| {
            self.round.push_back(person);
            Lane { slices: VecDeque::new(), at_work: 0, left: 0 }
        });
        lane.slices.push_back(slice);
        self.waiting += 1;
    }

    /// The next slice of whose turn it is.
    fn take(&mut self) -> Option<(Person, T)> {
        if self.waiting == 0 {
            return None;
        }
        // Each round adds to what everybody has left, and nobody owes without bound: this ends.
        loop {
            let person = self.round.front()?.clone();
            let lane = self.people.get_mut(&person)?;
            if lane.left > 0
                && let Some(slice) = lane.slices.pop_front()
            {
                lane.at_work += 1;
                self.waiting -= 1;
                return Some((person, slice));
            }
            lane.left = (lane.left + QUANTUM).min(QUANTUM);
            self.round.rotate_left(1);
            // Who waits for nothing and owes nothing is not of the round any more.
            if lane.slices.is_empty() && lane.at_work == 0 && lane.left > 0 {
                self.people.remove(&person);
                self.round.pop_back();
            }
        }
    }

    fn charge(&mut self, person: &Person, took: Micros) {
        self.owed = (self.owed - took).max(0);
        if self.waiting == 0 {
            // Nobody waited for them.
            self.people.clear();
            self.round.clear();
        } else if let Some(lane) = self.people.get_mut(person) {
            lane.at_work = lane.at_work.saturating_sub(1);
            lane.left = (lane.left - took).max(-MOST_OWED);
        }
    }
}

#[cfg(test)]
mod tests;
