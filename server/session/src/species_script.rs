//! Species as scripts and on the wire: the actions that grow a tree of a species from seed, and what a picker shows.

use espalier_growth::{
    BrushSample,
    species::{Species, Stage},
};
use espalier_proto::{Action, BrushRadius, List, Position, Steps, StrokeSample, species as wire};
use espalier_settings::{Appearance, ParameterValues};
use glam::Vec3;

use crate::appearance::AppearanceChange;

/// The number of a stroke of a schedule; each ends before the next begins.
const STROKE: u32 = 1;

/// What makes a seedling a tree of this species: its parameters and looks, then its schedule.
pub fn script(species: &Species) -> Vec<Action> {
    let mut actions = vec![choose(&species.parameters), set_looks(&species.appearance)];
    for stage in &species.schedule {
        match stage {
            &Stage::Grow(steps) => actions.push(Action::Grow { steps: Steps::nearest(steps), bud: None }),
            Stage::Change(values) => actions.push(choose(values)),
            &Stage::Sow(x, z) => {
                actions.push(Action::PlantSeed { position: Position::nearest(Vec3::new(x, 0.0, z)) })
            }
            Stage::Brush(places) => {
                actions.push(Action::StrokeBegin { stroke: STROKE, bud: None });
                let moved = |place: &BrushSample| Action::StrokeMove {
                    stroke: STROKE,
                    samples: List::of(StrokeSample {
                        position: Position::nearest(place.position),
                        radius: BrushRadius::nearest(place.radius),
                    }),
                };
                actions.extend(places.iter().map(moved));
                actions.push(Action::StrokeEnd { stroke: STROKE });
            }
        }
    }
    actions
}

/// What a picker does: sets all parameters at once.
fn choose(values: &ParameterValues) -> Action {
    Action::SetParameters { parameters: values.clone().into() }
}

/// The looks of a species; what surrounds it stays.
fn set_looks(looks: &Appearance) -> Action {
    Action::SetAppearance { appearance: AppearanceChange::of_tree(looks) }
}

/// A species as it travels.
pub fn wire_species(species: &Species) -> wire::Species {
    wire::Species {
        slug: species.slug.to_owned(),
        name: species.name.to_owned(),
        botanical: species.botanical.to_owned(),
        sentence: species.sentence.to_owned(),
        parameters: species.parameters.clone(),
        appearance: species.appearance,
    }
}
