//! Turns under a clock of their own: workers, people and slices are simulated, nothing is timed.

use std::cmp::Reverse;

use super::*;

const SECOND: Duration = Duration::from_secs(1);

fn ms(ms: f64) -> Duration {
    Duration::from_secs_f64(ms / 1e3)
}

/// A person who sends a slice of some length again and again.
#[derive(Clone, Copy)]
struct Sender {
    class: Class,
    person: usize,
    takes: Duration,
    /// The next slice comes so long after the one before; without it, as soon as that is done.
    every: Option<Duration>,
}

/// What became of each sender: how long its slices waited and were worked on, and how long it had a worker.
#[derive(Clone, Default)]
struct Had {
    delays: Vec<Duration>,
    worked: Duration,
}

impl Had {
    fn at(&self, share: f64) -> Duration {
        let mut delays = self.delays.clone();
        delays.sort_unstable();
        delays[((delays.len() - 1) as f64 * share) as usize]
    }
}

/// Lets the senders work on so many workers for so long.
fn run(workers: usize, senders: &[Sender], until: Duration) -> Vec<Had> {
    let mut turns = Turns::new(workers);
    let mut had = vec![Had::default(); senders.len()];
    // What is to happen: at which time, in which order, and what.
    let mut events = std::collections::BinaryHeap::new();
    let mut count = 0;
    let mut at =
        |events: &mut std::collections::BinaryHeap<_>, time: Duration, what: (usize, Option<Duration>)| {
            count += 1;
            events.push(Reverse((time, count, what)));
        };
    for (number, sender) in senders.iter().enumerate() {
        // Those who come regularly do not come at once.
        let first = sender.every.map_or(Duration::ZERO, |every| every * number as u32 / senders.len() as u32);
        at(&mut events, first, (number, None));
    }
    let mut idle = workers;
    while let Some(Reverse((now, _, (number, came)))) = events.pop() {
        if now > until {
            break;
        }
        let sender = senders[number];
        let person: Person = sender.person.to_string().into();
        if let Some(came) = came {
            idle += 1;
            turns.done(sender.class, &person, sender.takes);
            had[number].delays.push(now - came);
            had[number].worked += sender.takes;
        }
        if came.is_none() || sender.every.is_none() {
            turns.push(now, sender.class, person, (number, now));
        }
        if let (None, Some(every)) = (came, sender.every) {
            at(&mut events, now + every, (number, None));
        }
        while idle > 0
            && let Some(given) = turns.take(now)
        {
            idle -= 1;
            let (number, came) = given.slice;
            at(&mut events, now + senders[number].takes, (number, Some(came)));
        }
    }
    had
}

fn drawer(person: usize) -> Sender {
    Sender { class: Class::Drawing, person, takes: ms(1.6), every: Some(ms(100.0)) }
}

fn grower(person: usize, takes: Duration) -> Sender {
    Sender { class: Class::Growing, person, takes, every: None }
}

#[test]
fn twenty_who_draw_do_not_wait_for_six_giants() {
    for step in [12.0, 60.0, 250.0] {
        let growers = (0..6).map(|person| grower(person, ms(step)));
        let senders: Vec<_> = growers.chain((10..30).map(drawer)).collect();
        let had = run(2, &senders, 30 * SECOND);
        let drawn =
            Had { delays: had[6..].iter().flat_map(|had| had.delays.clone()).collect(), ..Had::default() };
        assert!(drawn.delays.len() > 5_000 && drawn.at(0.99) < ms(10.0), "{step} {:?}", drawn.at(0.99));
        let grown: Duration = had[..6].iter().map(|had| had.worked).sum();
        assert!(grown > 25 * SECOND, "one worker of two grows: {grown:?}");
        for one in &had[..6] {
            assert!(one.worked.as_secs_f64() > 0.8 * grown.as_secs_f64() / 6.0, "{:?}", one.worked);
        }
    }
}

#[test]
fn who_offers_ten_times_the_work_gets_no_more_of_it() {
    // Ten sessions of one person, one of another.
    let mut senders: Vec<_> = (0..10).map(|_| grower(0, ms(3.0))).collect();
    senders.push(grower(1, ms(3.0)));
    let had = run(1, &senders, 20 * SECOND);
    let many: Duration = had[..10].iter().map(|had| had.worked).sum();
    let share = had[10].worked.as_secs_f64() / (many + had[10].worked).as_secs_f64();
    assert!((0.45..0.55).contains(&share), "{share}");
    // Longer slices come less often.
    let had = run(1, &[grower(0, ms(12.0)), grower(1, ms(2.0))], 20 * SECOND);
    let share = had[1].worked.as_secs_f64() / (had[0].worked + had[1].worked).as_secs_f64();
    assert!((0.4..0.6).contains(&share), "{share}");
}

#[test]
fn who_plays_giants_in_time_keeps_nobody_from_drawing() {
    // A journey each 100 ms over a million rows, by as many as there are workers and more.
    let player = |class| move |person| Sender { class, person, takes: ms(150.0), every: Some(ms(100.0)) };
    let p99 = |class| {
        let senders: Vec<_> = (0..3).map(player(class)).chain((10..30).map(drawer)).collect();
        let had = run(2, &senders, 30 * SECOND);
        let delays = had[3..].iter().flat_map(|had| had.delays.clone()).collect();
        let played: Duration = had[..3].iter().map(|had| had.worked).sum();
        (Had { delays, ..Had::default() }.at(0.99), played)
    };
    // So it is done: what is long in one piece is not of the class of those who draw.
    let (waited, played) = p99(Class::Growing);
    assert!(waited < ms(10.0), "{waited:?}");
    assert!(played > 25 * SECOND, "one worker of two plays: {played:?}");
    assert!(p99(Class::Drawing).0 > ms(100.0), "in their class it kept them waiting");
}

#[test]
fn no_class_starves() {
    let senders = [
        Sender { class: Class::Drawing, person: 0, takes: ms(2.0), every: None },
        Sender { class: Class::Drawing, person: 1, takes: ms(2.0), every: None },
        Sender { class: Class::Drawing, person: 2, takes: ms(2.0), every: None },
        grower(3, ms(5.0)),
        Sender { class: Class::Whole, person: 4, takes: ms(5.0), every: None },
        Sender { class: Class::Upkeep, person: 5, takes: ms(5.0), every: None },
    ];
    let had = run(2, &senders, 60 * SECOND);
    for one in &had[3..] {
        assert!(one.worked > 3 * SECOND, "a twentieth of a worker at least: {:?}", one.worked);
    }
}

#[test]
fn one_worker_is_kept_while_somebody_draws_and_no_longer() {
    let mut turns = Turns::new(2);
    let person: Person = "oak".into();
    turns.push(Duration::ZERO, Class::Drawing, person.clone(), 0);
    assert!(turns.take(Duration::ZERO).is_some_and(|given| given.is_alone));
    turns.done(Class::Drawing, &person, ms(1.0));
    for slice in 1..3 {
        turns.push(ms(1.0), Class::Growing, person.clone(), slice);
    }
    assert!(turns.take(ms(1.0)).is_some_and(|given| given.slice == 1 && !given.is_alone));
    assert!(turns.take(ms(1.0)).is_none(), "the other worker is kept");
    let again = turns.look_again().unwrap();
    assert_eq!(again, KEPT_FOR);
    assert!(turns.take(again).is_some_and(|given| given.slice == 2));
    assert_eq!((turns.look_again(), turns.is_idle()), (None, false));
}

#[test]
fn whoever_begins_to_draw_finds_a_worker_however_many_trees_are_read() {
    let reading = (0..6).map(|person| Sender { class: Class::Whole, person, takes: ms(400.0), every: None });
    let keeping = Sender { class: Class::Upkeep, person: 6, takes: ms(900.0), every: None };
    // So seldom that no worker is kept for it.
    let seldom = Sender { every: Some(3 * SECOND), ..drawer(7) };
    assert!(seldom.every > Some(KEPT_FOR));
    let senders: Vec<_> = reading.chain([keeping, seldom]).collect();
    for workers in [2, 4] {
        let had = run(workers, &senders, 60 * SECOND);
        assert!(had[7].delays.len() > 15 && had[7].at(1.0) < ms(2.0), "{workers}: {:?}", had[7].at(1.0));
        let read: Duration = had[..7].iter().map(|had| had.worked).sum();
        assert!(read > 58 * (workers as u32 - 1) * SECOND, "{workers}: the others work: {read:?}");
    }
}

#[test]
fn what_is_alone_may_have_all_cores() {
    let mut turns = Turns::new(2);
    let person: Person = "oak".into();
    turns.push(Duration::ZERO, Class::Growing, person.clone(), 0);
    assert!(turns.take(Duration::ZERO).is_some_and(|given| given.is_alone));
    turns.push(Duration::ZERO, Class::Growing, person.clone(), 1);
    assert!(turns.take(Duration::ZERO).is_some_and(|given| !given.is_alone));
    for _ in 0..2 {
        turns.done(Class::Growing, &person, ms(1.0));
    }
    assert!(turns.is_idle());
}
