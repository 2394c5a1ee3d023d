//! Forms that someone, or the wind, has made: strokes of the brush guide them.

use super::{
    Species,
    Stage::{self, Grow, Sow},
    Stand, changed, flower, fruit, stroke, weigh, with,
};
use espalier_settings::{Appearance, BarkKind, FlowerKind, FruitKind, LeafKind, Place};

pub(super) fn all() -> Vec<Species> {
    vec![
        windswept_hawthorn(),
        bonsai_formal(),
        bonsai_cascade(),
        bonsai_windswept(),
        bonsai_literati(),
        shrub(),
        hedge(),
        espalier(),
    ]
}

fn windswept_hawthorn() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.12;
        p.apical_control = 0.49;
        p.branching_angle = 50.0;
        p.deflection_angle = 12.0;
        p.setpoint_angle = 75.0;
        weigh(p, 0.5, 0.1);
        p.max_shoot_length = 3;
        p.shadow_strength = 0.3;
        p.trunk_upward = false;
        p.tropism_from_stroke = true;
        p.marker_density = 0.3;
        p.girth_exponent = 2.1;
        p.leaves_per_node = 7;
        p.leaf_size = 1.1;
    });
    let mut schedule = vec![stroke(&[
        (0.0, 0.0, 0.0, 0.0),
        (0.6, 3.0, 0.0, 0.0),
        (2.0, 6.0, 0.3, 0.0),
        (4.5, 8.5, 0.0, 0.0),
        (7.5, 10.0, 0.0, 0.0),
    ])];
    for z in [0.0, -3.0, 3.0] {
        let z2 = 1.6 * z;
        schedule.push(stroke(&sweep((2.5, 8.0, 0.5 * z, 2.5), (21.0, 11.5, z2, 3.6), 14)));
        schedule.push(stroke(&sweep((4.0, 10.0, 0.5 * z, 2.5), (25.0, 16.5, z2, 3.0), 14)));
    }
    schedule.push(stroke(&sweep((3.0, 9.0, 0.0, 2.5), (22.0, 15.0, 0.0, 4.5), 16)));
    Species {
        slug: "windswept-hawthorn",
        name: "Windswept hawthorn",
        botanical: "Crataegus monogyna",
        sentence: "Bent by years of wind from one side: the trunk leans and the whole crown streams to lee.",
        appearance: Appearance::default()
            .leafy(LeafKind::Lobed, [92, 118, 58])
            .turned(0.4, 0.5, 0.0)
            .barked(BarkKind::Furrowed, [118, 106, 94])
            .carved(1.3, 1.1, 1.1)
            .flowering(flower(FlowerKind::Rosette, [248, 244, 238], 0.75, 0.55, Place::Twigs)),
        stand: Stand::Ground,
        schedule,
        parameters,
    }
}

/// A brush that goes from one place to another in so many moves.
fn sweep(from: (f32, f32, f32, f32), to: (f32, f32, f32, f32), moves: u32) -> Vec<(f32, f32, f32, f32)> {
    (0..=moves)
        .map(|i| {
            let t = i as f32 / moves as f32;
            let mix = |a: f32, b: f32| a + (b - a) * t;
            (mix(from.0, to.0), mix(from.1, to.1), mix(from.2, to.2), mix(from.3, to.3))
        })
        .collect()
}

/// A brush that rests on a place: a pad of foliage.
fn pad(x: f32, y: f32, z: f32, radius: f32, moves: usize) -> Stage {
    stroke(&vec![(x, y, z, radius); moves])
}

/// Small leaves on short internodes, and a trunk that looks old.
fn bonsai() -> super::ParameterValues {
    with(|p| {
        p.internode_length = 0.02;
        p.occupancy_radius = 0.9;
        p.perception_depth = 2.5;
        p.apical_control = 0.49;
        p.branching_angle = 55.0;
        p.deflection_angle = 8.0;
        p.setpoint_angle = 80.0;
        weigh(p, 0.5, 0.1);
        p.max_shoot_length = 2;
        p.marker_density = 0.5;
        p.shadow_strength = 0.05;
        p.girth_exponent = 2.0;
        p.twig_diameter = 0.1;
        p.leaves_per_node = 8;
        p.leaf_size = 1.1;
        p.trunk_upward = false;
    })
}

/// A limb drawn with the pencil from the trunk, and a flat pad of foliage at its end.
fn limb(from: (f32, f32), to: (f32, f32), half_width: f32, radius: f32) -> [Stage; 2] {
    let middle = (from.0 + 0.6 * (to.0 - from.0), from.1 + 0.75 * (to.1 - from.1));
    let (left, right) = (to.0 - half_width, to.0 + half_width);
    let there = sweep((left, to.1, 0.0, radius), (right, to.1, 0.0, radius), 5);
    let back = sweep((right, to.1, 0.8 * radius, radius), (left, to.1, -0.8 * radius, radius), 5);
    [
        stroke(&[(from.0, from.1, 0.0, 0.0), (middle.0, middle.1, 0.0, 0.0), (to.0, to.1, 0.0, 0.0)]),
        stroke(&[there.clone(), back.clone(), there, back].concat()),
    ]
}

fn bonsai_formal() -> Species {
    let parameters = bonsai();
    let mut schedule = vec![stroke(&sweep((0.0, 0.0, 0.0, 0.0), (0.0, 22.0, 0.0, 0.0), 11))];
    for (side, y, reach, width) in [
        (-1.0, 7.0, 8.5, 3.4),
        (1.0, 9.5, 7.5, 3.0),
        (-1.0, 12.0, 6.5, 2.6),
        (1.0, 14.5, 5.5, 2.2),
        (-1.0, 17.0, 4.0, 1.8),
        (1.0, 19.0, 3.0, 1.4),
    ] {
        schedule.extend(limb((0.0, y), (side * reach, y + 0.2), width, 1.5));
    }
    schedule.push(pad(0.0, 22.0, 0.0, 2.4, 12));
    Species {
        slug: "bonsai-formal-upright",
        name: "Bonsai, formal upright",
        botanical: "Chokkan",
        sentence: "A straight tapering trunk with level pads of foliage in turn to the left and to the right.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [70, 112, 66])
            .barked(BarkKind::Furrowed, [122, 98, 80])
            .carved(1.3, 1.6, 1.0),
        stand: Stand::Tray,
        schedule,
        parameters,
    }
}

fn bonsai_cascade() -> Species {
    let parameters = bonsai();
    let mut schedule = vec![stroke(&[
        (0.0, 0.0, 0.0, 0.0),
        (-0.6, 2.0, 0.0, 0.0),
        (0.0, 4.5, 0.0, 0.0),
        (2.0, 6.2, 0.0, 0.0),
        (4.6, 6.4, 0.0, 0.0),
        (7.0, 5.0, 0.0, 0.0),
        (9.0, 3.2, 0.0, 0.0),
        (11.5, 2.2, 0.0, 0.0),
        (14.0, 1.2, 0.0, 0.0),
    ])];
    for (from, to, width) in [
        ((0.0, 4.5), (-1.6, 7.4), 1.6),
        ((2.0, 6.2), (2.4, 9.4), 1.8),
        ((4.6, 6.4), (6.4, 8.2), 1.6),
        ((7.0, 5.0), (9.4, 5.8), 1.6),
        ((9.0, 3.2), (12.2, 3.8), 1.5),
        ((11.5, 2.2), (15.4, 1.6), 1.5),
    ] {
        schedule.extend(limb(from, to, width, 1.3));
    }
    Species {
        slug: "bonsai-cascade",
        name: "Bonsai, semi-cascade",
        botanical: "Han-kengai",
        sentence: "The trunk rises from a tall pot, turns over its rim and falls to the side.",
        appearance: Appearance::default()
            .leafy(LeafKind::Scale, [84, 124, 78])
            .barked(BarkKind::Stringy, [130, 100, 80])
            .carved(1.3, 1.2, 1.0),
        stand: Stand::Pot,
        schedule,
        parameters,
    }
}

fn bonsai_windswept() -> Species {
    let parameters = bonsai();
    let mut schedule = vec![stroke(&[
        (0.0, 0.0, 0.0, 0.0),
        (0.8, 2.0, 0.0, 0.0),
        (2.4, 4.6, 0.0, 0.0),
        (4.6, 7.4, 0.0, 0.0),
        (7.4, 9.8, 0.0, 0.0),
        (10.8, 11.6, 0.0, 0.0),
    ])];
    for (from, to) in [
        ((0.8, 2.0), (8.5, 3.6)),
        ((2.4, 4.6), (12.0, 7.0)),
        ((4.6, 7.4), (15.0, 10.2)),
        ((7.4, 9.8), (18.0, 13.2)),
        ((10.8, 11.6), (16.0, 16.0)),
    ] {
        schedule.extend(limb(from, to, 3.0, 1.4));
    }
    Species {
        slug: "bonsai-windswept",
        name: "Bonsai, windswept",
        botanical: "Fukinagashi",
        sentence: "Trunk and every branch lean one way, as on a cliff above the sea.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [78, 116, 84])
            .barked(BarkKind::Plated, [124, 98, 80])
            .carved(1.4, 1.4, 1.1),
        stand: Stand::Tray,
        schedule,
        parameters,
    }
}

fn bonsai_literati() -> Species {
    let parameters = changed(&bonsai(), |p| p.twig_diameter = 0.08);
    let mut schedule = vec![stroke(&[
        (0.0, 0.0, 0.0, 0.0),
        (1.2, 3.0, 0.0, 0.0),
        (2.6, 6.0, 0.0, 0.0),
        (2.6, 9.0, 0.0, 0.0),
        (0.8, 12.0, 0.0, 0.0),
        (-0.4, 15.0, 0.0, 0.0),
        (0.6, 18.0, 0.0, 0.0),
        (2.8, 20.5, 0.0, 0.0),
    ])];
    for (from, to, width) in [
        ((-0.4, 15.0), (-5.4, 15.2), 2.0),
        ((0.6, 18.0), (6.4, 17.0), 1.8),
        ((2.0, 20.0), (-1.0, 20.6), 1.4),
        ((2.8, 20.5), (4.0, 22.4), 2.2),
    ] {
        schedule.extend(limb(from, to, width, 1.3));
    }
    Species {
        slug: "bonsai-literati",
        name: "Bonsai, literati",
        botanical: "Bunjin-gi",
        sentence: "A long thin trunk in free curves, bare but for a few small pads near the top.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [74, 116, 72])
            .barked(BarkKind::Plated, [130, 100, 80])
            .carved(1.3, 1.2, 1.0),
        stand: Stand::Tray,
        schedule,
        parameters,
    }
}

fn shrub() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.08;
        p.buds_per_node = 2;
        p.phyllotactic_angle = 90.0;
        p.apical_control = 0.45;
        p.branching_angle = 50.0;
        p.setpoint_angle = 40.0;
        weigh(p, 0.6, 0.1);
        p.shadow_strength = 0.25;
        p.shedding_threshold = 0.1;
        p.leaves_per_node = 5;
        p.leaf_size = 1.4;
        p.trunk_upward = false;
    });
    Species {
        slug: "shrub",
        name: "Shrub",
        botanical: "Viburnum opulus",
        sentence: "Many stems from one root, arching outwards, none of them a trunk.",
        appearance: Appearance::default()
            .leafy(LeafKind::Palmate, [112, 146, 66])
            .turned(0.5, 1.0, 0.1)
            .barked(BarkKind::Smooth, [128, 112, 94])
            .carved(0.8, 0.5, 0.8)
            .fruiting(fruit(FruitKind::Round, [196, 40, 36], 0.36, 0.12, Place::Twigs)),
        stand: Stand::Ground,
        schedule: vec![Grow(9)],
        parameters,
    }
}

fn hedge() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.08;
        p.occupancy_radius = 0.8;
        p.perception_depth = 2.5;
        p.perception_angle = 150.0;
        p.apical_control = 0.49;
        p.branching_angle = 60.0;
        p.setpoint_angle = 30.0;
        weigh(p, 0.3, 0.05);
        p.max_shoot_length = 3;
        p.marker_density = 0.9;
        p.shadow_strength = 0.02;
        p.leaves_per_node = 6;
        p.leaf_size = 0.85;
    });
    let mut schedule: Vec<Stage> = [-12.0, -6.0, 6.0, 12.0].into_iter().map(|x| Sow(x, 0.0)).collect();
    for level in 0..8 {
        let y = 1.5 + 1.4 * level as f32;
        for z in [-3.0, 0.0, 3.0] {
            schedule.push(stroke(&sweep((-15.0, y, z, 1.6), (15.0, y, z, 1.6), 12)));
        }
    }
    Species {
        slug: "hedge",
        name: "Hedge",
        botanical: "Carpinus betulus",
        sentence: "A row of plants brushed into one clipped block with straight faces.",
        appearance: Appearance::default()
            .leafy(LeafKind::Ovate, [90, 130, 54])
            .turned(0.3, 1.0, 0.2)
            .barked(BarkKind::Smooth, [130, 120, 108])
            .carved(0.8, 0.5, 0.8),
        stand: Stand::Ground,
        schedule,
        parameters,
    }
}

fn espalier() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.1;
        p.occupancy_radius = 1.0;
        p.apical_control = 0.49;
        p.branching_angle = 60.0;
        p.setpoint_angle = 40.0;
        weigh(p, 0.5, 0.1);
        p.max_shoot_length = 3;
        p.marker_density = 0.3;
        p.shadow_strength = 0.05;
        p.girth_exponent = 2.2;
        p.leaves_per_node = 6;
        p.leaf_size = 1.2;
        p.trunk_upward = false;
    });
    let mut schedule = vec![stroke(&sweep((0.0, 0.0, 0.0, 0.0), (0.0, 21.0, 0.0, 0.0), 7))];
    for y in [6.0, 11.0, 16.0, 21.0] {
        for side in [-1.0, 1.0] {
            schedule.push(stroke(&sweep((0.4 * side, y, 0.0, 0.0), (16.0 * side, y, 0.0, 0.0), 6)));
        }
    }
    for y in [6.0, 11.0, 16.0, 21.0] {
        for side in [-1.0, 1.0] {
            schedule.push(stroke(&sweep(
                (1.5 * side, y + 0.8, 0.0, 1.2),
                (16.0 * side, y + 0.8, 0.0, 1.2),
                8,
            )));
        }
    }
    Species {
        slug: "espalier",
        name: "Espalier",
        botanical: "Pyrus communis",
        sentence: "A pear trained flat against a wall: level arms in pairs on one straight stem.",
        appearance: Appearance::default()
            .leafy(LeafKind::Ovate, [108, 144, 62])
            .turned(0.3, 1.0, 0.1)
            .barked(BarkKind::Furrowed, [116, 102, 88])
            .carved(1.1, 0.9, 1.1)
            .fruiting(fruit(FruitKind::Round, [214, 190, 84], 0.7, 0.05, Place::Twigs)),
        stand: Stand::Ground,
        schedule,
        parameters,
    }
}
