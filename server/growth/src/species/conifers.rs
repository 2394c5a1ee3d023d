//! Conifers.

use super::{Species, Stage::Grow, Stand, canopy, fruit, life, pole, turn, weigh, with};
use espalier_settings::{Appearance, BarkKind, FruitKind, LeafKind, Place};

pub(super) fn all() -> Vec<Species> {
    vec![spruce(), scots_pine(), stone_pine(), larch(), cedar_of_lebanon(), cypress(), juniper()]
}

fn spruce() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.35;
        p.apical_control = 0.535;
        p.branching_angle = 75.0;
        p.deflection_angle = 0.0;
        p.setpoint_angle = 112.0;
        weigh(p, 0.45, 0.35);
        p.shadow_strength = 0.06;
        p.gravimorphism_vertical = 0.6;
        p.gravimorphism_horizontal = 1.3;
        p.leaves_per_node = 6;
        p.leaf_size = 1.3;
    });
    Species {
        slug: "spruce",
        name: "Norway spruce",
        botanical: "Picea abies",
        sentence: "A dark cone to the ground, its limbs drooping and rising again at their ends.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [58, 92, 58])
            .barked(BarkKind::Furrowed, [112, 86, 68])
            .carved(0.8, 1.0, 0.7)
            .fruiting(fruit(FruitKind::Cone, [146, 98, 60], 0.6, 0.12, Place::Tips)),
        stand: Stand::Ground,
        schedule: vec![Grow(22)],
        parameters,
    }
}

fn scots_pine() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.3;
        p.apical_control = 0.485;
        p.branching_angle = 60.0;
        p.deflection_angle = 15.0;
        p.setpoint_angle = 70.0;
        weigh(p, 0.45, 0.2);
        p.light_sensitivity = 1.0;
        p.max_shoot_length = 3;
        p.shadow_strength = 0.4;
        p.shedding_threshold = 0.25;
        p.girth_exponent = 2.3;
        p.leaves_per_node = 8;
        p.leaf_size = 1.5;
        p.trunk_upward = false;
    });
    Species {
        slug: "scots-pine",
        name: "Scots pine",
        botanical: "Pinus sylvestris",
        sentence: "A long bare trunk, fox-red above, with flat clouds of needles on a few crooked limbs.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [92, 124, 92])
            .barked(BarkKind::Plated, [128, 102, 84])
            .carved(1.2, 0.9, 1.0)
            .fruiting(fruit(FruitKind::Cone, [124, 96, 66], 0.4, 0.1, Place::Tips)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 10), [Grow(13)]),
        parameters,
    }
}

fn stone_pine() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.3;
        p.apical_control = 0.465;
        p.branching_angle = 45.0;
        p.setpoint_angle = 45.0;
        p.light_sensitivity = 1.0;
        p.twig_diameter = 0.09;
        weigh(p, 0.5, 0.25);
        p.shadow_strength = 0.4;
        p.shedding_threshold = 0.4;
        p.girth_exponent = 2.3;
        p.leaves_per_node = 6;
        p.leaf_size = 1.4;
        p.trunk_upward = false;
    });
    let dome = turn(&parameters, |p| {
        p.marker_density = 0.3;
        p.marker_max_age = 4;
        p.shadow_strength = 0.2;
    });
    let cleared = turn(&parameters, |p| {
        p.shedding_threshold = 0.33;
        p.shadow_strength = 0.2;
    });
    Species {
        slug: "stone-pine",
        name: "Stone pine",
        botanical: "Pinus pinea",
        sentence: "A parasol: limbs that fan out from the top of a bare trunk into one smooth dome.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [84, 122, 58])
            .barked(BarkKind::Plated, [136, 106, 84])
            .carved(1.4, 0.9, 1.0)
            .fruiting(fruit(FruitKind::Cone, [132, 98, 62], 0.6, 0.08, Place::Tips)),
        stand: Stand::Ground,
        schedule: life(
            pole(&parameters, 15),
            [vec![Grow(3), dome], canopy(10, [54.0, 7.0], 20.0, 7.0), vec![cleared, Grow(1)]].concat(),
        ),
        parameters,
    }
}

fn larch() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.35;
        p.apical_control = 0.535;
        p.branching_angle = 80.0;
        p.deflection_angle = 0.0;
        p.setpoint_angle = 85.0;
        weigh(p, 0.5, 0.25);
        p.shadow_strength = 0.2;
        p.shedding_threshold = 0.2;
        p.leaves_per_node = 6;
        p.leaf_size = 0.9;
    });
    let hanging = turn(&parameters, |p| {
        p.setpoint_angle = 180.0;
        weigh(p, 0.4, 0.5);
        p.shedding_threshold = 0.0;
    });
    Species {
        slug: "larch",
        name: "European larch",
        botanical: "Larix decidua",
        sentence: "A light open cone with level limbs, thin hanging twigs, and needles that turn gold.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [206, 164, 62])
            .barked(BarkKind::Plated, [120, 98, 82])
            .carved(1.0, 0.9, 0.8)
            .fruiting(fruit(FruitKind::Cone, [128, 96, 66], 0.35, 0.02, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 3), [Grow(15), hanging, Grow(2)]),
        parameters,
    }
}

fn cedar_of_lebanon() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.35;
        p.apical_control = 0.52;
        p.branching_angle = 80.0;
        p.deflection_angle = 4.0;
        p.setpoint_angle = 90.0;
        weigh(p, 0.4, 0.5);
        p.shadow_strength = 0.3;
        p.shedding_threshold = 0.2;
        p.girth_exponent = 2.2;
        p.gravimorphism_vertical = 0.3;
        p.gravimorphism_horizontal = 1.5;
        p.leaves_per_node = 7;
        p.leaf_size = 1.3;
    });
    let old = turn(&parameters, |p| {
        p.trunk_upward = false;
        p.phyllotactic_angle = 180.0;
        p.apical_control = 0.49;
    });
    Species {
        slug: "cedar-of-lebanon",
        name: "Cedar of Lebanon",
        botanical: "Cedrus libani",
        sentence: "Broad level tiers of foliage, plate above plate, up to a flat top.",
        appearance: Appearance::default()
            .leafy(LeafKind::Needle, [74, 108, 84])
            .barked(BarkKind::Furrowed, [104, 90, 78])
            .carved(1.2, 1.3, 1.1)
            .fruiting(fruit(FruitKind::Cone, [146, 122, 90], 0.5, 0.01, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 7), [Grow(11), old, Grow(8)]),
        parameters,
    }
}

fn cypress() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.25;
        p.apical_control = 0.54;
        p.branching_angle = 35.0;
        p.deflection_angle = 2.0;
        p.setpoint_angle = 0.0;
        p.occupancy_radius = 0.8;
        p.perception_angle = 90.0;
        weigh(p, 0.45, 0.36);
        p.shadow_strength = 0.03;
        p.leaves_per_node = 9;
        p.leaf_size = 1.1;
    });
    Species {
        slug: "cypress",
        name: "Italian cypress",
        botanical: "Cupressus sempervirens",
        sentence: "A dense dark flame, closed from the ground to the pointed tip.",
        appearance: Appearance::default()
            .leafy(LeafKind::Scale, [52, 82, 48])
            .barked(BarkKind::Stringy, [120, 104, 90])
            .carved(0.9, 1.0, 0.8)
            .fruiting(fruit(FruitKind::Cone, [126, 110, 90], 0.3, 0.01, Place::Twigs)),
        stand: Stand::Ground,
        schedule: vec![Grow(21)],
        parameters,
    }
}

fn juniper() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.08;
        p.apical_control = 0.525;
        p.branching_angle = 38.0;
        p.deflection_angle = 10.0;
        p.setpoint_angle = 8.0;
        p.occupancy_radius = 0.9;
        weigh(p, 0.45, 0.35);
        p.max_shoot_length = 3;
        p.shadow_strength = 0.05;
        p.shedding_threshold = 0.0;
        p.leaves_per_node = 7;
        p.leaf_size = 1.0;
    });
    Species {
        slug: "juniper",
        name: "Juniper",
        botanical: "Juniperus communis",
        sentence: "Many steep stems from one foot in an uneven, blue-green, pointed bush.",
        appearance: Appearance::default()
            .leafy(LeafKind::Scale, [96, 128, 112])
            .barked(BarkKind::Stringy, [122, 96, 78])
            .carved(1.2, 0.8, 1.0)
            .fruiting(fruit(FruitKind::Round, [70, 82, 112], 0.2, 0.05, Place::Twigs)),
        stand: Stand::Ground,
        schedule: vec![Grow(16)],
        parameters,
    }
}
