//! Species as scripts and on the wire: the actions that grow a tree of a species from seed, and what a picker shows.

use espalier_growth::{
    BrushSample, ParameterValues,
    species::{BarkKind, Fruit, LeafKind, Species, Stage},
};
use espalier_proto::{ParametersPatch, species as wire};
use glam::Vec3;

use crate::{
    action::{Action, Sample},
    document::wire_parameters,
};

/// The number of a stroke of a schedule; each ends before the next begins.
const STROKE: u32 = 1;

/// What makes a seedling a tree of this species: its parameters, then its schedule.
pub fn script(species: &Species) -> Vec<Action> {
    let mut actions = vec![choose(&species.parameters)];
    for stage in &species.schedule {
        match stage {
            &Stage::Grow(steps) => actions.push(Action::Grow { steps, gesture: None, bud: None }),
            Stage::Change(values) => actions.push(choose(values)),
            &Stage::Sow(x, z) => actions.push(Action::PlantSeed { position: Vec3::new(x, 0.0, z) }),
            Stage::Brush(places) => {
                actions.push(Action::StrokeBegin { stroke: STROKE, bud: None });
                let moved = |place: &BrushSample| Action::StrokeMove {
                    stroke: STROKE,
                    samples: vec![Sample { position: place.position, radius: place.radius }],
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
    Action::SetParameters(Box::new(ParametersPatch::from(wire_parameters(values))))
}

/// A species as it travels.
pub fn wire_species(species: &Species) -> wire::Species {
    wire::Species {
        slug: species.slug.to_owned(),
        name: species.name.to_owned(),
        botanical: species.botanical.to_owned(),
        sentence: species.sentence.to_owned(),
        leaf: match species.leaf {
            LeafKind::Ovate => wire::LeafKind::Ovate,
            LeafKind::Round => wire::LeafKind::Round,
            LeafKind::Lanceolate => wire::LeafKind::Lanceolate,
            LeafKind::Lobed => wire::LeafKind::Lobed,
            LeafKind::Palmate => wire::LeafKind::Palmate,
            LeafKind::Fan => wire::LeafKind::Fan,
            LeafKind::Compound => wire::LeafKind::Compound,
            LeafKind::Needle => wire::LeafKind::Needle,
            LeafKind::Scale => wire::LeafKind::Scale,
            LeafKind::Blossom => wire::LeafKind::Blossom,
        },
        leaf_tint: species.leaf_tint,
        fruit: species.fruit.map(|Fruit { tint, size, share }| wire::Fruit { tint, size, share }),
        bark: match species.bark {
            BarkKind::Smooth => wire::BarkKind::Smooth,
            BarkKind::Furrowed => wire::BarkKind::Furrowed,
            BarkKind::Plated => wire::BarkKind::Plated,
            BarkKind::Papery => wire::BarkKind::Papery,
            BarkKind::Flaking => wire::BarkKind::Flaking,
            BarkKind::Banded => wire::BarkKind::Banded,
            BarkKind::Stringy => wire::BarkKind::Stringy,
        },
        bark_tint: species.bark_tint,
        parameters: wire_parameters(&species.parameters),
    }
}
