//! Schematics as they travel.

use espalier_growth::Parameters;
use espalier_mesh::foliage::MOST_TIPS_WITH_LEAVES;
use espalier_plant::{Girth, MetamerId};
use espalier_proto::{Problem, Schematic};
use espalier_settings::ParameterValues;

/// The flat tree that grows by these parameters; a problem names the one that is out of range (`SC1`).
pub fn schematic(wanted: &ParameterValues) -> Result<Schematic, Problem> {
    let parameters = Parameters::new(wanted.clone())?;
    let girth = Girth::new(parameters.girth_exponent, parameters.twig_diameter);
    let leaves_per_node = parameters.leaves_per_node;
    let plant = espalier_growth::schematic(parameters);
    let metamers = plant.metamers();
    let mut drawn = Schematic::default();
    // The place of each metamer in the lists; seeds and the dead have none.
    let mut places: Vec<Option<i32>> = Vec::with_capacity(plant.metamer_count());
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        let Some(parent) = metamers.parent(id).filter(|_| plant.is_alive(id)) else {
            places.push(None);
            continue;
        };
        places.push(Some(drawn.parents.len() as i32));
        let (from, to, tips) = (metamers.end(parent), metamers.end(id), metamers.tips(id));
        drawn.segments.extend([from.x, from.y, to.x, to.y]);
        drawn.parents.push(places[parent.index()].unwrap_or(-1));
        drawn.radii.push(girth.radius(tips));
        drawn.orders.push(plant.axes().order(metamers.axis(id)));
        let seen = metamers.condition(id);
        drawn.vigor.push(f32::from(seen.vigor) / 255.0);
        drawn.light.push(f32::from(seen.light) / 255.0);
        drawn.leaves.push(if tips <= MOST_TIPS_WITH_LEAVES { leaves_per_node } else { 0 });
        drawn.born.push(plant.birth(id));
    }
    Ok(drawn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Document;

    fn defaults() -> ParameterValues {
        Document::new(0).parameters()
    }

    #[test]
    fn sc1_a_schematic_is_a_connected_flat_tree() {
        let drawn = schematic(&defaults()).expect("in range");
        let count = drawn.parents.len();
        assert!((60..=420).contains(&count), "{count} metamers");
        assert_eq!(drawn.segments.len(), 4 * count);
        for lengths in [drawn.orders.len(), drawn.leaves.len(), drawn.born.len(), drawn.radii.len()] {
            assert_eq!(lengths, count);
        }
        assert_eq!(&drawn.segments[..2], [0.0, 0.0]);
        for (place, &parent) in drawn.parents.iter().enumerate() {
            assert!(parent < place as i32);
            if let Ok(parent) = usize::try_from(parent) {
                let begins = &drawn.segments[4 * place..4 * place + 2];
                assert_eq!(begins, &drawn.segments[4 * parent + 2..4 * parent + 4], "{place}");
                assert!(drawn.radii[parent] >= drawn.radii[place] && drawn.born[parent] <= drawn.born[place]);
            }
        }
        assert!(drawn.leaves.contains(&4) && drawn.leaves.contains(&0));
        assert_eq!(drawn, schematic(&defaults()).expect("in range"), "the same again");
    }

    #[test]
    fn sc1_what_is_out_of_range_is_named() {
        for (apical_control, value) in [(2.0, "2"), (f32::NAN, "NaN"), (f32::INFINITY, "inf")] {
            let problem = schematic(&ParameterValues { apical_control, ..defaults() });
            let problem = problem.expect_err("out of range");
            assert_eq!(problem.field.as_deref(), Some("apical_control"));
            assert!(problem.message.contains(value), "{problem}");
        }
    }
}
