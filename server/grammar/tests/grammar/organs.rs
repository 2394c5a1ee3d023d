//! Leaves, flowers and fruits stand where the grammar says.

use espalier_grammar::Drawn;
use espalier_plant::{
    MetamerId, Organ, OrganKind,
    organs::{MOST_ORGANS, shortest_sides},
};
use glam::Vec3;

use crate::trees::{drawn, planted};

/// The organs of each node that bears any, or none where others bear some.
fn organs(drawn: &Drawn) -> Vec<(u32, Vec<Organ>)> {
    drawn.wood.organs.iter().map(|(node, organs)| (*node, organs.to_vec())).collect()
}

fn heading(drawn: &Drawn, node: u32) -> Vec3 {
    let of = |node: u32| &drawn.wood.nodes[node as usize];
    (of(node).end - of(of(node).parent.expect("no seed")).end).normalize()
}

/// The kind, direction, upper side and length of each organ.
fn stances(drawn: &Drawn) -> Vec<(u32, OrganKind, Vec3, Vec3, Option<f32>)> {
    let all = organs(drawn).into_iter().flat_map(|(node, organs)| {
        let heading = heading(drawn, node);
        organs.into_iter().map(move |organ| {
            let stance = organ.stance(heading, shortest_sides(heading));
            (node, organ.kind, stance.direction, stance.normal, organ.length())
        })
    });
    all.collect()
}

#[test]
fn organs_stand_as_the_turtle_does() {
    let found = drawn("axiom: F[+(60)~l(0.5)]F&(90)~f[/(90)@O(0.2)]~k(1)", 0);
    let wanted = [
        (1, OrganKind::Leaf, Vec3::new(-0.866, 0.5, 0.0), Vec3::Z, Some(0.5)),
        (2, OrganKind::Flower, Vec3::NEG_Z, Vec3::Y, None),
        (2, OrganKind::Fruit, Vec3::NEG_Z, Vec3::X, Some(0.4)),
        (2, OrganKind::Fruit, Vec3::NEG_Z, Vec3::Y, Some(1.0)),
    ];
    let found = stances(&found);
    assert_eq!(found.len(), wanted.len(), "{found:?}");
    for (found, wanted) in found.iter().zip(&wanted) {
        assert_eq!((found.0, found.1), (wanted.0, wanted.1));
        assert!(
            found.2.dot(wanted.2) > 0.999 && found.3.dot(wanted.3) > 0.995,
            "{found:?} is not {wanted:?}"
        );
        let lengths = found.4.zip(wanted.4).map_or(1.0, |(found, wanted)| found / wanted);
        assert!((lengths - 1.0).abs() < 0.02 && found.4.is_some() == wanted.4.is_some());
    }
}

#[test]
fn a_surface_is_a_leaf_to_its_farthest_vertex() {
    let found = drawn("scale: 0.5\naxiom: F(2)[+(90){.-(30)G(2).+(30)G(2).+(30)G(2).}]F(2)", 0);
    let [(1, OrganKind::Leaf, direction, normal, Some(length))] = stances(&found)[..] else {
        panic!("one leaf: {:?}", stances(&found))
    };
    // Lines of 1 that lean 30 degrees up, level, and 30 degrees down.
    assert!(direction.dot(Vec3::NEG_X) > 0.999 && normal.dot(Vec3::Z) > 0.995, "{direction} {normal}");
    assert!((length / 2.732 - 1.0).abs() < 0.02, "{length}");
    assert_eq!(found.wood.nodes.len(), 3, "a surface is no wood");
}

#[test]
fn every_node_of_a_grammar_with_organs_is_given_its_own() {
    let leafless: Vec<_> = drawn("axiom: FF[+F]F", 0).wood.organs;
    assert_eq!(leafless, [], "leaves grow where Appearance has them");
    let found = drawn("axiom: FF[+F]F\nhomomorphism:\nQ --> ~l", 0);
    assert_eq!(organs(&found), [(1, vec![]), (2, vec![]), (3, vec![]), (4, vec![])]);
    let plant = planted(&drawn("axiom: F[+F~l]F~x~k", 0));
    let counts = |row| plant.given_organs(MetamerId::new(row)).map(|organs| organs.len());
    assert_eq!([0, 1, 2, 3].map(counts), [None, Some(0), Some(1), Some(2)]);
}

#[test]
fn organs_come_and_go_with_their_modules() {
    // A bud bears two leaves until it has grown.
    let text = "axiom: A\nA --> F[+(50)~l][-(50)~l]A\n~l --> *";
    let count = |depth| -> Vec<usize> {
        organs(&drawn(text, depth)).iter().map(|(_, organs)| organs.len()).collect()
    };
    assert_eq!(count(1), [2]);
    assert_eq!(count(2), [0, 2]);
    assert_eq!(count(3), [0, 0, 2]);
}

#[test]
fn what_stands_on_no_wood_or_is_too_much_is_counted() {
    let crowd = "~l".repeat(MOST_ORGANS + 2);
    let found = drawn(&format!("axiom: ~l~fF{crowd}"), 0);
    assert_eq!((found.unborne, organs(&found)[0].1.len()), (4, MOST_ORGANS));
}

#[test]
fn a_surface_ends_with_the_branch_in_which_it_began() {
    let found = drawn("axiom: F(2)[{.f(1).]F(3)[+F(2)]", 0);
    let whole = drawn("axiom: F(2)F(3)[+F(2)]", 0);
    assert_eq!(found.wood.nodes.len(), whole.wood.nodes.len());
    assert_eq!(stances(&found), [], "a surface that does not end is none");
    let within = drawn("axiom: F[&(90){.[+(30)f(1).]f(2).}]F", 0);
    assert_eq!((stances(&within).len(), within.wood.nodes.len()), (1, 3), "branches lie within surfaces");
}
