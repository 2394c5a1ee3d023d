//! What tells species from one another, measured on whole trees grown by their programmes.

mod form;

use espalier_growth::species;
use espalier_proto::{Action, Steps};
use espalier_session::{Document, Principal, script, wire_species};

use crate::form::Form;

fn form(slug: &str) -> Form {
    let species = species::find(slug).expect("the species exists");
    Form::of(&raised(species))
}

/// A tree at its age.
fn raised(species: &species::Species) -> Document {
    let mut document = Document::new(1);
    for action in script(species) {
        document.apply(&Principal::visitor(), &action.into()).expect("a programme can be done");
    }
    document
}

#[test]
fn every_programme_ends_in_a_tree() {
    for species in species::all() {
        let document = raised(species);
        let metamers = document.metamers();
        assert!((100..60_000).contains(&metamers), "{} has {metamers} metamers", species.slug);
        assert!(document.plant().step() < 500, "{} takes {} steps", species.slug, document.plant().step());
    }
}

/// However it is asked for: at once, step by step as a lever does, or by a document that was put away meanwhile.
#[test]
fn pg2_growth_by_hand_gives_the_tree_of_the_contact_sheet() {
    for species in species::all() {
        let whole = raised(species);
        let programme = wire_species(species).programme;
        let (until, wish) = (Some(programme.age), programme.age.get());
        let mut lever = Document::new(1);
        let step = |steps| Action::Grow { steps: Steps::nearest(steps), until, bud: None };
        let pick = Action::SetProgramme { programme: Some(programme), keep: false };
        lever.apply(&Principal::visitor(), &pick.into()).expect("it can be picked");
        for beat in 0.. {
            if lever.age() == wish {
                break;
            }
            assert!(beat < 1000 && lever.age() < wish, "{} is {} old", species.slug, lever.age());
            lever.apply(&Principal::visitor(), &step(1 + beat % 3).into()).expect("it grows");
            if beat % 20 == 7 {
                lever = Document::from_bytes(&lever.to_bytes()).expect("a document");
            }
        }
        assert_eq!(lever.plant().hash(), whole.plant().hash(), "{}", species.slug);
        assert_eq!((lever.age(), lever.parameters()), (whole.age(), whole.parameters()), "{}", species.slug);
        lever.apply(&Principal::visitor(), &step(9).into()).expect("a command that comes to nothing");
        assert_eq!(lever.plant().hash(), whole.plant().hash(), "{} is grown up", species.slug);
    }
}

#[test]
fn poplar_and_cypress_are_columns() {
    for slug in ["lombardy-poplar", "cypress"] {
        let form = form(slug);
        assert!(form.height() > 3.0 * form.width(), "{slug}: {} by {}", form.height(), form.width());
    }
}

#[test]
fn willow_shoots_hang_nearly_to_the_ground() {
    let (willow, oak) = (form("weeping-willow"), form("oak"));
    assert!(willow.share_of_hanging_twigs() > 0.6, "{}", willow.share_of_hanging_twigs());
    assert!(oak.share_of_hanging_twigs() < 0.3, "{}", oak.share_of_hanging_twigs());
    assert!(willow.foliage_from() < 0.1, "{}", willow.foliage_from());
}

#[test]
fn acacia_is_a_flat_crown_wider_than_high() {
    let acacia = form("umbrella-acacia");
    assert!(acacia.width() > 1.2 * acacia.height(), "{} by {}", acacia.width(), acacia.height());
    assert!(acacia.mean_foliage_height() > 0.65, "{}", acacia.mean_foliage_height());
}

#[test]
fn parasols_stand_on_limbs_that_fan_out() {
    for slug in ["umbrella-acacia", "stone-pine"] {
        let outwards = form(slug).outwardness();
        assert!(outwards > 0.42, "{slug}: {outwards}");
    }
}

#[test]
fn baobab_is_all_trunk() {
    let slenderness = |form: &Form| form.height() / form.trunk_width();
    let (baobab, oak) = (form("baobab"), form("oak"));
    assert!(slenderness(&baobab) < 7.0, "{}", slenderness(&baobab));
    assert!(slenderness(&oak) > 2.0 * slenderness(&baobab), "{}", slenderness(&oak));
}

#[test]
fn pines_have_bare_trunks_and_spruces_skirts() {
    for slug in ["scots-pine", "stone-pine"] {
        let from = form(slug).foliage_from();
        assert!(from > 0.25, "{slug}: {from}");
    }
    assert!(form("spruce").foliage_from() < 0.1);
}

#[test]
fn spruce_and_larch_are_cones_and_oak_is_none() {
    let taper = |form: &Form| form.width_at(0.1, 0.4) / form.width_at(0.6, 0.9);
    for slug in ["spruce", "larch"] {
        let taper = taper(&form(slug));
        assert!(taper > 2.0, "{slug}: {taper}");
    }
    assert!(taper(&form("oak")) < 1.5);
}

#[test]
fn cedar_foliage_lies_in_level_plates() {
    let (cedar, beech) = (form("cedar-of-lebanon"), form("beech"));
    assert!(cedar.share_of_level_twigs() > 0.7, "{}", cedar.share_of_level_twigs());
    assert!(beech.share_of_level_twigs() < 0.4, "{}", beech.share_of_level_twigs());
}

#[test]
fn shrub_has_many_stems_and_beech_one() {
    let (shrub, beech) = (form("shrub"), form("beech"));
    assert!(shrub.stems_at(0.3) >= 8, "{}", shrub.stems_at(0.3));
    assert_eq!(beech.stems_at(0.15), 1);
}

#[test]
fn hedge_fills_its_box() {
    let hedge = form("hedge");
    assert!(hedge.width() > 2.0 * hedge.height());
    assert!(hedge.share_of_box_filled() > 0.85, "{}", hedge.share_of_box_filled());
}

#[test]
fn espalier_is_flat_as_a_wall() {
    let espalier = form("espalier");
    assert!(espalier.depth() < 0.25 * espalier.width(), "{} deep", espalier.depth());
}

#[test]
fn windswept_crowns_stream_to_lee() {
    for slug in ["windswept-hawthorn", "bonsai-windswept"] {
        let form = form(slug);
        assert!(form.lean() > 0.4, "{slug}: {}", form.lean());
    }
    assert!(form("oak").lean().abs() < 0.15);
}

#[test]
fn cascade_ends_far_below_its_bend() {
    let end = form("bonsai-cascade").height_of_outermost();
    assert!(end < 0.35, "the tip is at {end} of the height");
}
