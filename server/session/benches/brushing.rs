//! A finger on a tree of 100k metamers: each move of the brush is one step and one frame.

mod support;

use espalier_plant::MetamerId;
use espalier_proto::{Action, List};
use espalier_session::Document;
use glam::Vec3;
use support::{Cost, Followed, report, sample};

const METAMERS: u32 = 100_000;
const ROUNDS: u32 = 5;
const STROKES: u32 = 40;
const MOVES: u32 = 10;
/// Shorter than a shoot, so that each move is one step.
const MOVE_LENGTH: f32 = 2.0;
/// A brush step is meant to add no more than this; wider steps are not counted.
const MOST_ADDED: u32 = 500;

fn main() {
    support::on_the_pool(bench);
}

fn bench() {
    let tree = Followed::tree(METAMERS);
    for radius in [3.0, 6.0, 10.0, 12.0] {
        let (mut rounds, mut added, mut kept) = (Vec::new(), Vec::new(), 0);
        let (mut undo_rounds, mut undone) = (Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            let brushing = brush(tree.clone(), radius);
            rounds.push(brushing.costs);
            undo_rounds.push(brushing.undos);
            (added, undone, kept) = (brushing.added, brushing.undone, brushing.kept_bytes);
        }
        report(&format!("brush step of radius {radius}"), &rounds, &added);
        report(&format!("undo of a stroke of {MOVES} such steps"), &undo_rounds, &undone);
        println!("  memory kept for each step, bytes: {kept}");
    }
}

/// What many steps of one brush cost.
#[derive(Debug, Default)]
struct Brushing {
    costs: Vec<Cost>,
    /// Metamers each step added.
    added: Vec<u32>,
    /// What it cost to undo each stroke, and how many metamers went.
    undos: Vec<Cost>,
    undone: Vec<u32>,
    /// Memory that a step took on average.
    kept_bytes: u64,
}

/// Strokes outwards from all sides of the crown; each is undone, so that the tree stays as large as it is.
fn brush(mut tree: Followed, radius: f32) -> Brushing {
    let (mut brushing, mut kept, mut steps) = (Brushing::default(), 0, 0);
    for stroke in 0..STROKES {
        let outwards = direction(stroke);
        let from = outermost(&tree.document, outwards);
        let held = resident_bytes();
        tree.act(&Action::StrokeBegin { stroke, bud: None });
        for i in 0..MOVES {
            let (before, step) = (tree.document.metamers(), tree.document.plant().step());
            let position = from + outwards * (MOVE_LENGTH * i as f32);
            let samples = List::of(sample(position, radius));
            let cost = tree.act(&Action::StrokeMove { stroke, samples });
            steps += tree.document.plant().step() - step;
            let grown = tree.document.metamers().saturating_sub(before);
            if grown <= MOST_ADDED {
                brushing.costs.push(cost);
                brushing.added.push(grown);
            }
        }
        kept += resident_bytes().unwrap_or(0).saturating_sub(held.unwrap_or(0));
        tree.act(&Action::StrokeEnd { stroke });
        let before = tree.document.metamers();
        brushing.undos.push(tree.act(&Action::Undo {}));
        brushing.undone.push(before.abs_diff(tree.document.metamers()));
    }
    brushing.kept_bytes = kept / u64::from(steps.max(1));
    brushing
}

/// The k-th of directions spread over the upper half of a sphere by the golden angle.
fn direction(k: u32) -> Vec3 {
    let y = (k as f32 + 0.5) / STROKES as f32;
    let (sin, cos) = libm::sincosf(2.399_963_2 * k as f32);
    let across = (1.0 - y * y).sqrt();
    Vec3::new(across * cos, y, across * sin)
}

/// The living node farthest in a direction.
fn outermost(document: &Document, direction: Vec3) -> Vec3 {
    let plant = document.plant();
    (0..plant.metamer_count())
        .map(MetamerId::new)
        .filter(|&id| plant.is_alive(id))
        .map(|id| plant.metamers().end(id))
        .max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))
        .expect("a tree has nodes")
}

/// Bytes of memory this process holds, where the system tells.
fn resident_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kibibytes = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(1024 * kibibytes.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?)
}
