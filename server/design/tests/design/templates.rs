//! The six bonsai of the paper (§5) are what their styles say.

use espalier_design::{Design, Generated, Generator, Key, MAX_INTERNODES, NodeId, TEMPLATES, Template};
use espalier_growth::{Parameters, transplant};
use espalier_plant::checks;
use glam::Vec3;

use crate::said::node;

fn named(name: &str) -> (Design, Generated) {
    let design = Template::named(name).expect("there is such a template").design();
    let generated = Generator::default().generate(&design, MAX_INTERNODES);
    (design, generated)
}

fn axis(generated: &Generated, of: NodeId) -> Vec<Vec3> {
    generated.rows(of).map(|row| generated.wood.nodes[row as usize].end).collect()
}

/// Each node of the wood above the stem.
fn crown(generated: &Generated) -> impl Iterator<Item = Vec3> {
    generated.wood.nodes.iter().filter(|row| row.axis > 0).map(|row| row.end)
}

fn top(generated: &Generated) -> f32 {
    generated.wood.nodes.iter().map(|row| row.end.y).fold(f32::MIN, f32::max)
}

/// How far an axis turns in all, in degrees.
fn turning(axis: &[Vec3]) -> f32 {
    let turn = |three: &[Vec3]| (three[1] - three[0]).angle_between(three[2] - three[1]).to_degrees();
    axis.windows(3).map(turn).sum()
}

#[test]
fn each_template_is_an_ordinary_plant_of_few_values() {
    for template in &TEMPLATES {
        let (design, generated) = named(template.name);
        let values = design.graph().values();
        assert!((20..=60).contains(&values), "{}: {values} values", template.name);
        assert!(generated.wood.nodes.len() > 800, "{}: {} nodes", template.name, generated.wood.nodes.len());
        let plant = transplant(&generated.wood, &Parameters::default()).expect("it fits together");
        assert_eq!(checks::all(&plant), Ok(()), "{}", template.name);
        assert_eq!(Design::from_json(&design.to_json()), Ok(design));
        assert!(!template.sentence.trim().is_empty());
    }
    assert!(Template::named("oak").is_none());
}

#[test]
fn chokkan_stands_straight_and_its_limbs_become_shorter() {
    let (_, generated) = named("chokkan");
    assert!(turning(&axis(&generated, NodeId::ROOT)) < 1.0);
    let reach = |part: std::ops::Range<f32>| {
        let limbs =
            generated.placed.iter().filter(|placed| placed.node.order() == 1 && part.contains(&placed.t));
        let (sum, count) = limbs.fold((0.0, 0.0), |(sum, count), limb| (sum + limb.length, count + 1.0));
        sum / count
    };
    assert!(reach(0.2..0.45) > 1.4 * reach(0.45..0.7) && reach(0.45..0.7) > 1.4 * reach(0.7..1.0));
}

#[test]
fn bunjingi_is_bare_but_for_its_top() {
    let (_, generated) = named("bunjingi");
    let top = top(&generated);
    let low = crown(&generated).filter(|place| place.y < 0.55 * top).count();
    assert_eq!(low, 0);
    assert!(turning(&axis(&generated, NodeId::ROOT)) > 90.0, "its stem goes in curves");
}

#[test]
fn fukinagashi_goes_to_one_side() {
    let (_, generated) = named("fukinagashi");
    let all = crown(&generated).count();
    let beyond = crown(&generated).filter(|place| place.x > 0.0).count();
    assert!(beyond * 100 > all * 99, "{beyond} of {all}");
    let headings =
        generated.placed.iter().filter(|placed| placed.node.order() > 0).map(|placed| placed.frame.y_axis.x);
    let (with, of) = headings.fold((0, 0), |(with, of), x| (with + usize::from(x > 0.3), of + 1));
    assert!(with * 10 > of * 9, "{with} of {of}");
}

#[test]
fn nejikan_winds_and_bears_needles() {
    let (_, generated) = named("nejikan");
    let stem = axis(&generated, NodeId::ROOT);
    assert!(turning(&stem) > 270.0, "{}", turning(&stem));
    let leafy = generated.placed.iter().find(|placed| placed.node.order() == 3).expect("it has twigs");
    assert!(leafy.leaves(0.9) > 10.0);
}

#[test]
fn sankan_has_three_stems_from_one_point() {
    let (design, generated) = named("sankan");
    let stems = ["/0", "/1", "/2"].map(|of| generated.placed(node(of)).expect("it stands"));
    assert_eq!(design.root().laterals().len(), 3);
    assert!(stems.windows(2).all(|pair| pair[0].base == pair[1].base));
    assert!(
        stems.windows(2).all(|pair| pair[0].length > 1.2 * pair[1].length && pair[0].radius > pair[1].radius)
    );
    let shared = |key| stems.map(|stem| stem.values.value(key).clone());
    assert!(shared(Key::Axis).windows(2).all(|pair| pair[0] == pair[1]));
    assert_eq!(design.graph().shares().count(), 2);
}

#[test]
fn kengai_falls_below_its_base() {
    let (_, generated) = named("kengai");
    let stem = axis(&generated, NodeId::ROOT);
    assert!(stem.last().is_some_and(|tip| tip.y < -30.0));
    assert!(stem.iter().any(|place| place.y > 5.0), "it rises before it falls");
}
