//! The figures of a run. `docs/command-line.md` explains each of them.

use std::time::Duration;

use serde::Serialize;

/// The object that `--stats json` prints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stats {
    /// Living metamers at the end.
    pub metamers_alive: u32,
    /// Metamers that came with a file, the dead of a document included.
    pub metamers_taken: u32,
    /// Metamers born since then up to the present, the dead included.
    pub metamers_grown: u32,
    /// Living axes with wood.
    pub axes: u32,
    /// Leaves at the end.
    pub leaves: u32,
    /// Simulation steps run.
    pub steps: u32,
    /// From the first command to the last, without the export.
    pub seconds_total: f64,
    /// The last step with its delta.
    pub seconds_last_step: f64,
    /// All steps by phase.
    pub seconds: PhaseSeconds,
    /// Bytes of all mesh deltas, as they would travel.
    pub delta_bytes: u64,
    /// Bytes of the whole tree, as somebody gets it who joins.
    pub join_bytes: u64,
    /// The most memory the process held, where the system tells.
    pub peak_memory_bytes: Option<u64>,
    /// Memory held at the end beyond what was held before anything grew, where the system tells.
    pub tree_memory_bytes: Option<u64>,
    /// The same for each living metamer.
    pub bytes_per_metamer: Option<f64>,
    /// Making and writing the export, if there is one.
    pub seconds_export: Option<f64>,
    /// A hash of the plants, in hexadecimal; equal plants have equal hashes.
    pub plant_hash: String,
}

/// Seconds spent in each phase.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PhaseSeconds {
    /// Markers are sown, removed, and associated with buds.
    pub space: f64,
    /// Light is read at every node.
    pub light: f64,
    /// Vigor is distributed.
    pub vigor: f64,
    /// Shoots grow and cast their shadows.
    pub growth: f64,
    /// Branches that do not pay are shed.
    pub shedding: f64,
    /// Girth follows.
    pub girth: f64,
    /// Mesh deltas are made and compressed.
    pub delta: f64,
}

impl Stats {
    /// Adds how long the export took.
    pub fn exported(&mut self, time: Duration) {
        self.seconds_export = Some(time.as_secs_f64());
        self.peak_memory_bytes = peak_memory_bytes();
    }

    /// One line of JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("figures are always JSON")
    }

    /// A few lines for people.
    pub fn summary(&self) -> String {
        let Self { metamers_alive, metamers_taken, metamers_grown, axes, leaves, steps, .. } = self;
        let of = match (metamers_taken, steps) {
            (0, _) => format!(" of {metamers_grown} grown"),
            (_, 0) => String::new(),
            _ => format!(" of {metamers_taken} taken and {metamers_grown} grown"),
        };
        let growth = if *metamers_taken > 0 && *steps == 0 {
            String::new()
        } else {
            let seconds = self.seconds_total;
            let rate = f64::from(*metamers_grown) / seconds.max(f64::MIN_POSITIVE);
            format!("{steps} steps in {seconds:.2} s, {rate:.0} metamers per second\n")
        };
        format!(
            "{metamers_alive} metamers alive{of}, on {axes} axes with {leaves} leaves\n{growth}plant {}",
            self.plant_hash
        )
    }
}

/// The most memory this process has held.
pub fn peak_memory_bytes() -> Option<u64> {
    memory_bytes("VmHWM:")
}

/// The memory this process holds now.
pub fn resident_memory_bytes() -> Option<u64> {
    memory_bytes("VmRSS:")
}

/// Linux tells it without a system call of its own.
fn memory_bytes(name: &str) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kibibytes: u64 = status
        .lines()
        .find_map(|line| line.strip_prefix(name))?
        .trim()
        .strip_suffix("kB")?
        .trim()
        .parse()
        .ok()?;
    Some(kibibytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn memory_is_counted_in_bytes() {
        let before = peak_memory_bytes().unwrap();
        assert!(before > 1024 * 1024);
        let block = vec![1u8; 64 * 1024 * 1024];
        assert!(block.iter().map(|&byte| u64::from(byte)).sum::<u64>() > 0);
        assert!(peak_memory_bytes().unwrap() > before);
        let resident = resident_memory_bytes().unwrap();
        assert!((block.len() as u64..=peak_memory_bytes().unwrap()).contains(&resident));
    }

    fn example() -> Stats {
        let seconds = PhaseSeconds {
            space: 0.5,
            light: 0.0,
            vigor: 0.0,
            growth: 0.0,
            shedding: 0.0,
            girth: 0.0,
            delta: 0.0,
        };
        Stats {
            metamers_alive: 3,
            metamers_taken: 0,
            metamers_grown: 4,
            axes: 1,
            leaves: 9,
            steps: 2,
            seconds_total: 1.0,
            seconds_last_step: 0.25,
            seconds,
            delta_bytes: 99,
            join_bytes: 44,
            peak_memory_bytes: None,
            tree_memory_bytes: Some(600),
            bytes_per_metamer: Some(200.0),
            seconds_export: None,
            plant_hash: "00ff".into(),
        }
    }

    #[test]
    fn what_came_with_a_file_has_not_grown() {
        let grown = example();
        let (first, rest) = ("3 metamers alive", "on 1 axes with 9 leaves\n");
        let growth = "2 steps in 1.00 s, 4 metamers per second\nplant 00ff";
        assert_eq!(grown.summary(), format!("{first} of 4 grown, {rest}{growth}"));
        let taken = Stats { metamers_taken: 2, ..grown.clone() };
        assert_eq!(taken.summary(), format!("{first} of 2 taken and 4 grown, {rest}{growth}"));
        let still = Stats { metamers_taken: 3, metamers_grown: 0, steps: 0, ..grown };
        assert_eq!(still.summary(), format!("{first}, {rest}plant 00ff"));
    }

    #[test]
    fn the_object_has_the_documented_fields() {
        assert_eq!(
            example().to_json(),
            "{\"metamers_alive\":3,\"metamers_taken\":0,\"metamers_grown\":4,\"axes\":1,\"leaves\":9,\"steps\":2,\"seconds_total\":1.0,\
             \"seconds_last_step\":0.25,\"seconds\":{\"space\":0.5,\"light\":0.0,\"vigor\":0.0,\"growth\":0.0,\
             \"shedding\":0.0,\"girth\":0.0,\"delta\":0.0},\"delta_bytes\":99,\"join_bytes\":44,\"peak_memory_bytes\":null,\
             \"tree_memory_bytes\":600,\"bytes_per_metamer\":200.0,\"seconds_export\":null,\
             \"plant_hash\":\"00ff\"}"
        );
    }
}
