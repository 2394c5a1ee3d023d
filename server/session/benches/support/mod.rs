//! A document with a client in step, timed part by part; and percentiles of what was timed.

use std::{
    fmt,
    sync::LazyLock,
    time::{Duration, Instant},
};

use espalier_mesh::{RingTable, Style};
use espalier_proto::{Action, BrushRadius, Command, Position, Steps, StrokeSample};
use espalier_session::{Document, Principal, delta, style_options};
use glam::Vec3;

/// Runs a bench where the server simulates: on a thread of the pool. From outside, each task would first have to wake
/// one. The simulation has a clock, as there.
pub fn on_the_pool(bench: impl FnOnce() + Send) {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    espalier_growth::use_clock(|| BEGUN.elapsed());
    rayon::scope(|_| bench());
}

/// A document whose every change a client is told.
#[derive(Clone, Debug)]
pub struct Followed {
    pub document: Document,
    table: RingTable,
    style: Style,
    sequence: u32,
}

/// What one action cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    /// The document does it.
    pub act: Duration,
    /// Looks are written, and the table finds what changed.
    pub sync: Duration,
    /// The frame is made and deflated.
    pub encode: Duration,
    /// The frame's length.
    pub bytes: usize,
}

impl Followed {
    /// A tree that has grown on its own to so many living metamers, one operation for each step.
    pub fn tree(metamers: u32) -> Self {
        let mut document = Document::new(1);
        document.set_metamer_budget(u32::MAX);
        let style = Style::new(style_options(&document.parameters()));
        let mut followed = Self { document, table: RingTable::new(), style, sequence: 0 };
        while followed.document.metamers() < metamers {
            followed.act(&Action::Grow { steps: Steps::nearest(1), until: None, bud: None });
        }
        followed
    }

    /// Does an action with all its steps, and tells the client once.
    pub fn act(&mut self, action: &Action) -> Cost {
        self.command(&action.clone().into())
    }

    /// The same of an action in a gesture.
    pub fn command(&mut self, command: &Command) -> Cost {
        let begun = Instant::now();
        self.document.apply(&Principal::visitor(), command).expect("the action can be done");
        let acted = Instant::now();
        self.sequence += 1;
        let changes = self.table.sync(self.document.portrait(), &self.style, self.sequence);
        let synced = Instant::now();
        let bytes = delta(&self.table, &changes, 0, self.sequence).encode().len();
        Cost { act: acted - begun, sync: synced - acted, encode: synced.elapsed(), bytes }
    }
}

/// One place of the brush.
#[allow(dead_code, reason = "not every bench draws")]
pub fn sample(position: Vec3, radius: f32) -> StrokeSample {
    StrokeSample { position: Position::nearest(position), radius: BrushRadius::nearest(radius) }
}

impl Cost {
    /// All of it.
    pub fn total(&self) -> Duration {
        self.act + self.sync + self.encode
    }
}

/// The spread of a quantity.
#[derive(Clone, Copy, Debug)]
pub struct Percentiles {
    p50: f64,
    p99: f64,
    most: f64,
}

impl Percentiles {
    /// Of at least one value.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = values.collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let at = |share: f64| sorted[((share * sorted.len() as f64).ceil() as usize).max(1) - 1];
        Self { p50: at(0.5), p99: at(0.99), most: at(1.0) }
    }

    /// Of durations, in milliseconds.
    pub fn of_milliseconds(values: impl Iterator<Item = Duration>) -> Self {
        Self::of(values.map(|value| 1e3 * value.as_secs_f64()))
    }
}

impl fmt::Display for Percentiles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { p50, p99, most } = self;
        write!(f, "{p50:>9.2} {p99:>9.2} {most:>9.2}")
    }
}

/// Prints what the same actions cost in several rounds: all of them, and for each action the cheapest round, which
/// says what the action costs rather than what else the machine was doing.
#[allow(dead_code, reason = "not every bench has rounds")]
pub fn report(title: &str, rounds: &[Vec<Cost>], added: &[u32]) {
    let all: Vec<Cost> = rounds.concat();
    let least: Vec<Cost> = (0..added.len())
        .filter_map(|i| rounds.iter().map(|costs| costs[i]).min_by_key(Cost::total))
        .collect();
    println!("{title}, {} times in {} rounds         median       p99      most", added.len(), rounds.len());
    let milliseconds = |costs: &[Cost], part: fn(&Cost) -> Duration| {
        Percentiles::of_milliseconds(costs.iter().map(part)).to_string()
    };
    println!("  every time, ms               {}", milliseconds(&all, Cost::total));
    println!("  each in its best round, ms   {}", milliseconds(&least, Cost::total));
    println!("    document                   {}", milliseconds(&least, |cost| cost.act));
    println!("    looks and table            {}", milliseconds(&least, |cost| cost.sync));
    println!("    frame                      {}", milliseconds(&least, |cost| cost.encode));
    println!("  metamers                     {}", Percentiles::of(added.iter().map(|&n| f64::from(n))));
    println!(
        "  frame, bytes                 {}",
        Percentiles::of(least.iter().map(|cost| cost.bytes as f64))
    );
}
