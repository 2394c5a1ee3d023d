//! Grammars ask what stands around, and the turtle where it is.

use std::sync::Arc;

use espalier_grammar::{Derivation, Environment, Grammar, Limits, OpenSky, Progress, Stand};
use glam::DVec3;

/// Shade below a height, a ball that may be grown in, and wood on one side.
struct Garden;

impl Environment for Garden {
    fn light(&self, stand: &Stand) -> f64 {
        (stand.place.y / 10.0).clamp(0.0, 1.0)
    }

    fn brighter(&self, stand: &Stand) -> DVec3 {
        if stand.place.y < 10.0 { DVec3::Y } else { DVec3::ZERO }
    }

    fn is_free(&self, stand: &Stand, radius: f64) -> bool {
        stand.branch == 0 || stand.place.x.abs() > radius
    }

    fn is_inside(&self, stand: &Stand, body: u32) -> bool {
        body == 0 && stand.place.length() < 5.0
    }

    fn has_body(&self, body: u32) -> bool {
        body == 0
    }

    fn vigor(&self, stand: &Stand) -> f64 {
        1.0 / f64::from(1 + stand.below)
    }
}

fn word(text: &str, depth: u32, surroundings: &dyn Environment) -> String {
    let grammar = Grammar::read(text).unwrap_or_else(|errors| panic!("{errors:#?}"));
    assert!(grammar.asks_places());
    let program = Arc::new(grammar.program(&[]).expect("no sliders"));
    let mut derivation = Derivation::new(program, 1, Limits::default()).expect("the axiom is small");
    for _ in 0..depth {
        // In small slices, which must not show.
        while derivation.advance(surroundings, 3) != Ok(Progress::Stepped) {}
    }
    derivation.word().text(&grammar)
}

#[test]
fn light_is_asked_where_a_module_stands() {
    let text = "axiom: A\nA --> F(4)[B]A\nB --> C(light())\nC(x) --> C(x)";
    assert_eq!(word(text, 3, &Garden), "F(4)[C(0.4)]F(4)[C(0.8)]F(4)[B]A");
    assert_eq!(word(text, 3, &OpenSky), "F(4)[C(1)]F(4)[C(1)]F(4)[B]A");
    let text = "axiom: A\nA --> F(3)?E A";
    assert_eq!(word(text, 2, &Garden), "F(3)?E(0.3)F(3)?E(0)A");
}

#[test]
fn branches_end_where_the_envelope_does() {
    let text = "axiom: A\nA : inside(0) --> F(1)A\nA : !inside(0) --> %";
    assert_eq!(word(text, 9, &Garden), "F(1)F(1)F(1)F(1)F(1)%");
    assert_eq!(word(text, 3, &OpenSky), "F(1)F(1)F(1)A", "where none was drawn all space is its own");
    let text = "axiom: A\nA --> B(exists(0), exists(1), inside(0), inside(1))\nB(a,b,c,d) --> B(a,b,c,d)";
    assert_eq!(word(text, 1, &Garden), "B(1,0,1,0)");
    assert_eq!(word(text, 1, &OpenSky), "B(0,0,1,0)");
}

#[test]
fn free_space_vigor_order_and_depth_are_known() {
    let text =
        "axiom: FF[+(90)F[D]D]D\nD --> X(free(2), vigor(), order(), below())\nX(a,b,c,d) --> X(a,b,c,d)";
    let found = word(text, 1, &Garden);
    assert_eq!(found, "FF[+(90)F[X(0,0.25,2,3)]X(0,0.25,1,3)]X(1,0.3333333333333333,0,2)");
}

#[test]
fn the_turtle_tells_its_place_and_frame() {
    let text = "scale: 2\naxiom: F(3)+(90)F(1)?P?H?U?L\n?P(x,y,z) --> ?P(x,y,z)";
    let found = word(text, 1, &OpenSky);
    let rounded: Vec<f64> = found
        .split(['(', ')', ',', '?', 'P', 'H', 'U', 'L', 'F', '+'])
        .filter_map(|number| number.parse::<f64>().ok())
        .map(|number| number.round() + 0.0)
        .collect();
    assert_eq!(rounded, [3.0, 90.0, 1.0, -1.0, 3.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0]);
}

#[test]
fn growth_turns_to_where_it_is_brighter() {
    let text = "axiom: +(90)A\nA --> F(1)@R(towards_light_x()-1, towards_light_y(), towards_light_z())A";
    assert!(word(text, 1, &Garden).contains("@R(-1,1,0)"));
}

#[test]
fn grammars_that_ask_nothing_say_so() {
    let grammar = Grammar::read("axiom: F\nF --> FF(sin(step))").expect("it is right");
    assert!(!grammar.asks_places());
}
