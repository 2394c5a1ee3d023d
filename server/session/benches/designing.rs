//! A hand on a design: each move of a drag is one command, new wood and one frame.

mod support;

use espalier_proto::{Action, Command, DesignEdit, DesignSetting, List, Position};
use glam::Vec3;
use serde_json::{Value, json};
use support::{Cost, Followed, report};

const ROUNDS: u32 = 5;
const MOVES: u32 = 24;

fn main() {
    support::on_the_pool(bench);
}

fn bench() {
    for (what, graph) in [("bonsai of the template chokkan", None), ("tree of 10 k internodes", Some(tree()))]
    {
        let mut planted = Followed::tree(0);
        planted.act(&Action::NewDesign {
            position: Some(Position::nearest(Vec3::ZERO)),
            template: graph.is_none().then(|| "chokkan".to_owned().try_into().expect("it is a name")),
            graph: graph.clone().map(Into::into),
        });
        println!("{what}: {} metamers", planted.document.metamers());
        drag(&planted, "  its lowest limb aimed", |at| set("/0", "turn", json!([0.0, 3.0 * at, 2.0 * at])));
        drag(&planted, "  its lowest limb bent", |at| set("/0", "axis", bend(at)));
        drag(&planted, "  its outline widened", |at| {
            let side = 0.3 + 0.004 * at;
            let outline = json!({
                "top": [0, 1.02, 0], "bottom": [0, 0.16, 0], "radii": [side, side, side, side],
                "heights": [0.3, 0.3, 0.3, 0.3], "upper": 1.2, "lower": 2.5, "tip": [0, 1, 0],
            });
            set("/", "silhouette", outline)
        });
    }
}

/// About 10,000 internodes.
fn tree() -> Value {
    json!({ "version": 1, "nodes": { "/": { "values": {
        "height": { "own": 90 },
        "density": { "own": [[0, 19], [1, 19]] },
    } } } })
}

fn bend(at: f32) -> Value {
    json!([[0, 0, 0], [0.01 * at, 0.4, 0.1], [0, 1, 0]])
}

fn set(of: &str, key: &str, value: Value) -> DesignEdit {
    let value = DesignSetting { own: Some(value.into()), ..DesignSetting::default() };
    DesignEdit::Set { of: of.to_owned(), key: key.to_owned(), value }
}

/// Drags all of which are taken back, so that each begins with the same tree.
fn drag(planted: &Followed, what: &str, edit: impl Fn(f32) -> DesignEdit) {
    let mut rounds = Vec::new();
    let mut rows = Vec::new();
    for _ in 0..ROUNDS {
        let mut tree = planted.clone();
        let costs: Vec<Cost> = (1..=MOVES)
            .map(|at| {
                let action = Action::EditDesign { edits: List::of(edit(at as f32)) };
                tree.command(&Command { gesture: Some(1), ..action.into() })
            })
            .collect();
        rows = vec![tree.document.metamers(); MOVES as usize];
        rounds.push(costs);
    }
    report(what, &rounds, &rows);
}
