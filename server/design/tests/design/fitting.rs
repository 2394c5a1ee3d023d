//! Designs are fitted to plants that grew.

use espalier_design::{
    Design, Fitted, Fitting, Generator, Limits, MAX_INTERNODES, MOST_ORDERS, NodeId, Owner, Source,
    TEMPLATES, Unfit, fit,
};
use espalier_growth::{NoObserver, Parameters, Simulation, StepInput, species, transplant};
use espalier_plant::{AxisId, Girth, MetamerId, Plant};
use glam::Vec3;

use crate::said::{designed, node, plain};

fn seed() -> MetamerId {
    MetamerId::new(0)
}

/// Templates, how many values fitted designs of them have at most, which is no more than twice as many as they have
/// themselves, and how much of their crowns is the same.
const FOUND: [(&str, usize, f32); 6] = [
    ("bunjingi", 60, 0.92),
    ("nejikan", 80, 0.90),
    ("fukinagashi", 52, 0.93),
    ("chokkan", 52, 0.93),
    ("sankan", 60, 0.90),
    ("kengai", 50, 0.91),
];

/// Grown species, and how much of their crowns is the same in their designs.
const SPECIES: [(&str, f32); 6] = [
    ("oak", 0.89),
    ("birch", 0.90),
    ("lombardy-poplar", 0.90),
    ("olive", 0.87),
    ("spruce", 0.91),
    ("scots-pine", 0.87),
];

fn girth() -> Girth {
    Girth::new(2.5, 0.07)
}

fn planted(design: &Design) -> Plant {
    let wood = Generator::default().generate(design, MAX_INTERNODES).wood;
    transplant(&wood, &Parameters::default()).expect("it fits together")
}

fn fitted(plant: &Plant) -> Fitted {
    fit(plant, &girth(), seed(), MOST_ORDERS).expect("it has wood")
}

/// A tree of a species, of at least so many metamers.
fn grown(slug: &str, metamers: u32) -> Plant {
    let species = species::find(slug).expect("there is such a species");
    let parameters = Parameters::new(species.parameters.clone()).expect("they are in range");
    let mut simulation = Simulation::new(3, parameters);
    let alone = StepInput { autonomous: true, ..StepInput::default() };
    while simulation.plant().living_count() < metamers {
        simulation.step(&alone, &mut NoObserver);
    }
    simulation.plant().clone()
}

#[test]
fn fitting_finds_templates_again_in_few_values() {
    assert_eq!(FOUND.map(|(name, ..)| name), TEMPLATES.map(|template| template.name));
    let all = TEMPLATES.iter().zip(FOUND).map(|(template, (name, most, least))| {
        let design = template.design();
        let Fitted { records, overlap, .. } = fitted(&planted(&design));
        assert!(most <= 2 * design.graph().values(), "{name}");
        (format!("{name}: {records} values, overlap {overlap}"), records <= most && overlap >= least)
    });
    let all: Vec<_> = all.collect();
    assert!(all.iter().all(|(_, is_met)| *is_met), "{all:#?}");
}

#[test]
fn fitting_keeps_the_crowns_of_species() {
    let all = SPECIES.map(|(slug, least)| {
        let Fitted { records, overlap, .. } = fitted(&grown(slug, 3_000));
        (format!("{slug}: {records} values, overlap {overlap}"), overlap >= least)
    });
    assert!(all.iter().all(|(_, is_met)| *is_met), "{all:#?}");
}

#[test]
fn fitting_places_limbs_where_they_stand() {
    let design = designed(&plain(5));
    let generated = Generator::default().generate(&design, MAX_INTERNODES);
    let fitted = fitted(&planted(&design));
    assert_eq!(fitted.design.root().laterals().len(), 5);
    let again = Generator::default().generate(&fitted.design, MAX_INTERNODES);
    for of in ["/0", "/1", "/2", "/3", "/4"].map(node) {
        let [was, is] = [&generated, &again].map(|wood| wood.placed(of).expect("it stands"));
        assert!(was.base.distance(is.base) < 0.2, "{of}: {} and {}", was.base, is.base);
        assert!(was.frame.y_axis.dot(is.frame.y_axis) > 0.99, "{of}");
        assert!((was.length / is.length - 1.0).abs() < 0.12, "{of}: {} and {}", was.length, is.length);
    }
}

#[test]
fn what_was_fitted_is_a_design_like_any_other() {
    let fitted = fitted(&grown("oak", 1_500));
    let graph = fitted.design.graph();
    assert_eq!(Design::from_json(&fitted.design.to_json()).as_ref(), Ok(&fitted.design));
    assert_eq!((fitted.records, fitted.shares), (graph.values(), graph.shares().count()));
    for (share, _) in graph.shares() {
        assert!(graph.members(share).count() > 1, "siblings share a value, not one alone");
    }
    // What limbs say of themselves is for themselves.
    for (owner, record) in graph.records() {
        let is_limb = matches!(owner, Owner::Node(node) if node != NodeId::ROOT);
        for (key, setting) in record.settings.iter().filter(|_| is_limb) {
            assert!(setting.clone().private() == *setting, "{owner}: {key}");
            assert!(matches!(setting.source, Source::Explicit(_) | Source::Shared(_)), "{owner}: {key}");
        }
    }
}

#[test]
fn fewer_orders_are_fewer_branches() {
    let plant = grown("oak", 1_500);
    let highest = |orders| {
        let fitted = fit(&plant, &girth(), seed(), orders).expect("it has wood");
        let mut highest = 0;
        fitted.design.root().walk(&mut |branch| highest = highest.max(branch.id().order()));
        highest
    };
    assert_eq!([1, 2, 3].map(highest), [1, 2, 3]);
}

#[test]
fn what_no_design_fits_is_refused() {
    let mut plant = grown("oak", 300);
    for orders in [0, MOST_ORDERS + 1] {
        assert_eq!(fit(&plant, &girth(), seed(), orders), Err(Unfit::Orders { found: orders }));
    }
    for row in [5, plant.metamer_count()] {
        let refused = Err(Unfit::NoSeed(row as u32));
        assert_eq!(fit(&plant, &girth(), MetamerId::new(row), 2), refused);
    }
    let empty = Plant::new(Vec3::ZERO);
    assert_eq!(fit(&empty, &girth(), seed(), 2), Err(Unfit::NoWood(0)));
    plant.begin_step();
    plant.shed(&[AxisId::new(0)]);
    plant.end_step();
    assert_eq!(fit(&plant, &girth(), seed(), 2), Err(Unfit::Dead(0)));
}

#[test]
fn fitted_designs_keep_to_limits() {
    let plant = grown("oak", 1_500);
    let fitting =
        |internodes, bytes| Fitting::new(&plant, &girth(), seed(), MOST_ORDERS, Limits { internodes, bytes });
    assert!(matches!(fitting(100, usize::MAX), Err(Unfit::NoRoom { allowed: 100, .. })));
    assert!(matches!(fitting(MAX_INTERNODES, 500), Err(Unfit::TooLong { allowed: 500, .. })));
    let least = fitting(MAX_INTERNODES, usize::MAX).expect("it has wood").best().design.to_json().len();
    let bytes = least + 2_000;
    let mut fitting = fitting(MAX_INTERNODES, bytes).expect("the first design is no larger");
    while fitting.step() {}
    assert!((least..=bytes).contains(&fitting.found().design.to_json().len()));
}

#[test]
fn fitting_is_done_one_trial_at_a_time() {
    let plant = planted(&designed(&plain(5)));
    let mut fitting =
        Fitting::new(&plant, &girth(), seed(), MOST_ORDERS, Limits::default()).expect("it has wood");
    let (mut left, mut trials) = (fitting.left(), 0);
    let first = fitting.clone().found();
    while fitting.step() {
        trials += 1;
        assert!((1..=left).contains(&fitting.left()), "{} after {left}", fitting.left());
        left = fitting.left();
    }
    assert!(trials > 2 && fitting.left() == 0 && !fitting.step());
    let found = fitting.found();
    assert!(found.overlap >= first.overlap);
    assert_eq!(found, fitted(&plant));
}
