//! What holds for a tree of each species.

use espalier_growth::species::{self, Species};
use espalier_mesh::{Bodies, Grain, Style, Wood, checks, wood};
use espalier_session::{Document, Principal, script, style_options};

/// A tree of a species at the end of its schedule.
pub fn raised(species: &Species, seed: u32) -> Document {
    let mut document = Document::new(seed);
    for action in script(species) {
        document.apply(&Principal::visitor(), &action.into()).expect("its schedule can be done");
    }
    document
}

#[test]
fn wood_is_closed_and_faces_outwards() {
    let mut triangles = 0;
    for species in species::all() {
        let mut document = raised(species, 3);
        let (style, look) = (Style::new(style_options(&document.parameters())), document.appearance().bark);
        for wood in wood(document.portrait(), &style, &look) {
            assert_eq!(checks::wood(&wood), Ok(()), "{}", species.slug);
            triangles += wood.triangles().count();
        }
        for grain in Grain::LEVELS {
            for body in Bodies::of(document.portrait(), &style, &look, grain).iter() {
                let mut wood = Wood::of(body.seed());
                body.sweep(&mut wood);
                assert_eq!(checks::wood(&wood), Ok(()), "{} in {grain:?}", species.slug);
            }
        }
    }
    assert!(triangles > 100_000, "{triangles}");
}
