//! How long things took, and the table that says so.

use std::{fmt::Write, time::Duration};

/// How long something took, each time.
#[derive(Clone, Debug, Default)]
pub struct Delays(Vec<Duration>);

impl Delays {
    /// It took so long.
    pub fn push(&mut self, delay: Duration) {
        self.0.push(delay);
    }

    /// Those of somebody else as well.
    pub fn append(&mut self, mut others: Self) {
        self.0.append(&mut others.0);
    }

    /// The least delay that this share of all does not exceed; nothing where nothing was measured.
    fn within(sorted: &[Duration], share: f64) -> Option<Duration> {
        let place = (sorted.len() as f64 * share).ceil() as usize;
        sorted.get(place.saturating_sub(1)).copied()
    }
}

/// What was measured: delays, and other figures.
#[derive(Debug, Default)]
pub struct Table {
    delays: Vec<(String, Delays)>,
    figures: Vec<(String, String)>,
}

impl Table {
    /// A row of delays.
    pub fn delays(&mut self, name: impl Into<String>, delays: Delays) {
        self.delays.push((name.into(), delays));
    }

    /// A row of any other figure.
    pub fn figure(&mut self, name: impl Into<String>, value: impl ToString) {
        self.figures.push((name.into(), value.to_string()));
    }

    /// For people, and for pasting into a page.
    pub fn text(mut self) -> String {
        let mut text = String::new();
        if !self.delays.is_empty() {
            text.push_str("| milliseconds | p50 | p90 | p99 | most | of |\n|---|---|---|---|---|---|\n");
        }
        for (name, Delays(all)) in &mut self.delays {
            all.sort_unstable();
            let shares =
                [0.5, 0.9, 0.99, 1.0].map(|share| Delays::within(all, share).map_or("–".into(), millis));
            // Writing to a text does not fail.
            let _ = writeln!(text, "| {name} | {} | {} |", shares.join(" | "), all.len());
        }
        if !self.figures.is_empty() {
            let gap = if text.is_empty() { "" } else { "\n" };
            let _ = write!(text, "{gap}| figure | |\n|---|---|\n");
        }
        for (name, value) in &self.figures {
            let _ = writeln!(text, "| {name} | {value} |");
        }
        text
    }
}

fn millis(delay: Duration) -> String {
    format!("{:.1}", delay.as_secs_f64() * 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_tells_the_shares_of_all_delays() {
        let mut delays = Delays::default();
        (1..=100).rev().for_each(|count| delays.push(Duration::from_millis(count)));
        let mut others = Delays::default();
        others.push(Duration::from_micros(250_500));
        let mut table = Table::default();
        table.delays("stroke to delta", delays.clone());
        delays.append(others);
        table.delays("both", delays);
        table.delays("nothing", Delays::default());
        table.figure("sockets", 400);
        assert_eq!(
            table.text(),
            "| milliseconds | p50 | p90 | p99 | most | of |\n|---|---|---|---|---|---|\n\
             | stroke to delta | 50.0 | 90.0 | 99.0 | 100.0 | 100 |\n\
             | both | 51.0 | 91.0 | 100.0 | 250.5 | 101 |\n\
             | nothing | – | – | – | – | 0 |\n\
             \n| figure | |\n|---|---|\n| sockets | 400 |\n"
        );
    }
}
