//! Species as programmes and on the wire: what a picker shows and sets, and the actions that grow a tree from seed.

use espalier_growth::{
    BrushSample,
    species::{self, Species},
};
use espalier_proto::{
    Action, Age, BrushRadius, List, Position, Programme, Slug, Stage, Steps, StrokeSample, species as wire,
};
use glam::Vec3;

use crate::{appearance::AppearanceChange, schedule::Plan};

/// What a picker does, and growth from seed until the tree is grown up.
pub fn script(species: &Species) -> Vec<Action> {
    let programme = programme_of(species);
    let until = programme.age;
    vec![
        Action::SetProgramme { programme: Some(programme), keep: false },
        Action::SetAppearance { appearance: AppearanceChange::of_tree(&species.appearance) },
        Action::Grow { steps: Steps::nearest(until.get()), until: Some(until), bud: None },
    ]
}

/// The life of a species by age.
pub(crate) fn programme_of(species: &Species) -> Programme {
    let mut age = 0;
    let mut values = &species.parameters;
    let mut stages = Vec::new();
    for stage in &species.schedule {
        match stage {
            species::Stage::Grow(steps) => age += steps,
            species::Stage::Change(now) => {
                values = now;
                let parameters = species.parameters.change_to(now);
                stages.push(Stage::Change { age: Age::nearest(age), parameters });
            }
            &species::Stage::Sow(x, z) => {
                let position = Position::nearest(Vec3::new(x, 0.0, z));
                stages.push(Stage::Seed { age: Age::nearest(age), position });
            }
            species::Stage::Brush(places) => {
                stages.extend(stroke(age, places));
                age += Plan::span_of(places, values);
            }
        }
    }
    Programme {
        species: Slug::try_from(species.slug.to_owned()).ok(),
        parameters: species.parameters.clone().into(),
        stages: List::try_from(stages).unwrap_or_default(),
        age: Age::nearest(age),
    }
}

fn stroke(age: u32, places: &[BrushSample]) -> Option<Stage> {
    let sample = |place: &BrushSample| StrokeSample {
        position: Position::nearest(place.position),
        radius: BrushRadius::nearest(place.radius),
    };
    let samples = List::try_from(places.iter().map(sample).collect::<Vec<_>>()).ok()?;
    Some(Stage::Stroke { age: Age::nearest(age), samples })
}

/// A species as it travels.
pub fn wire_species(species: &Species) -> wire::Species {
    wire::Species {
        slug: species.slug.to_owned(),
        name: species.name.to_owned(),
        botanical: species.botanical.to_owned(),
        sentence: species.sentence.to_owned(),
        programme: programme_of(species),
        appearance: species.appearance,
    }
}
