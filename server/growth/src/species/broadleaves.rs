//! Broadleaved trees, and ginkgo, which looks like one.

use super::{Species, Stage::Grow, Stand, canopy, changed, flower, fruit, life, pole, turn, weigh, with};
use espalier_settings::{Appearance, BarkKind, FlowerKind, FruitKind, LeafKind, Place};

pub(super) fn all() -> Vec<Species> {
    vec![
        oak(),
        beech(),
        birch(),
        lombardy_poplar(),
        weeping_willow(),
        maple(),
        plane(),
        cherry(),
        apple(),
        olive(),
        umbrella_acacia(),
        baobab(),
        ginkgo(),
    ]
}

fn oak() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.3;
        p.apical_control = 0.487;
        p.branching_angle = 60.0;
        p.deflection_angle = 12.0;
        p.setpoint_angle = 35.0;
        weigh(p, 0.5, 0.15);
        p.shadow_strength = 0.35;
        p.shedding_threshold = 0.2;
        p.girth_exponent = 2.3;
        p.leaves_per_node = 5;
        p.leaf_size = 1.3;
    });
    Species {
        slug: "oak",
        name: "Oak",
        botanical: "Quercus robur",
        sentence: "A short trunk that dissolves early into crooked, far-reaching limbs under a broad dome.",
        appearance: Appearance::default()
            .leafy(LeafKind::Lobed, [88, 116, 48])
            .turned(0.45, 1.0, 0.0)
            .barked(BarkKind::Furrowed, [118, 104, 88])
            .carved(1.4, 1.3, 1.2)
            .fruiting(fruit(FruitKind::Nut, [142, 116, 62], 0.3, 0.06, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 5), [Grow(16)]),
        parameters,
    }
}

fn beech() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.35;
        p.apical_control = 0.512;
        p.branching_angle = 42.0;
        p.phyllotactic_angle = 170.0;
        p.setpoint_angle = 12.0;
        weigh(p, 0.45, 0.25);
        p.shadow_strength = 0.18;
        p.shedding_threshold = 0.15;
        p.leaves_per_node = 6;
        p.leaf_size = 1.2;
    });
    Species {
        slug: "beech",
        name: "Beech",
        botanical: "Fagus sylvatica",
        sentence: "A smooth grey trunk that forks into steep limbs below a tall, dense, rounded crown.",
        appearance: Appearance::default()
            .leafy(LeafKind::Ovate, [84, 130, 52])
            .turned(0.35, 1.0, 0.1)
            .barked(BarkKind::Smooth, [150, 148, 142])
            .carved(0.7, 1.2, 0.9)
            .fruiting(fruit(FruitKind::Nut, [128, 92, 58], 0.22, 0.03, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 7), [Grow(15)]),
        parameters,
    }
}

fn birch() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.25;
        p.apical_control = 0.522;
        p.branching_angle = 38.0;
        p.setpoint_angle = 10.0;
        weigh(p, 0.5, 0.25);
        p.shadow_strength = 0.15;
        p.shedding_threshold = 0.25;
        p.twig_diameter = 0.07;
        p.leaves_per_node = 8;
        p.leaf_size = 0.65;
    });
    let pendulous = turn(&parameters, |p| {
        p.setpoint_angle = 170.0;
        weigh(p, 0.5, 0.4);
        p.max_shoot_length = 7;
        p.apical_control = 0.52;
        p.shedding_threshold = 0.0;
    });
    Species {
        slug: "birch",
        name: "Silver birch",
        botanical: "Betula pendula",
        sentence: "A slender white stem with ascending branches whose fine tips hang.",
        appearance: Appearance::default()
            .leafy(LeafKind::Round, [126, 152, 62])
            .turned(0.5, 1.0, -0.4)
            .barked(BarkKind::Papery, [232, 230, 224])
            .carved(0.8, 0.8, 0.8)
            .flowering(flower(FlowerKind::Catkin, [190, 170, 92], 0.5, 0.12, Place::Tips)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 7), [Grow(13), pendulous, Grow(3)]),
        parameters,
    }
}

fn lombardy_poplar() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.35;
        p.apical_control = 0.545;
        p.branching_angle = 35.0;
        p.deflection_angle = 2.0;
        p.setpoint_angle = 0.0;
        weigh(p, 0.45, 0.35);
        p.occupancy_radius = 1.0;
        p.perception_angle = 90.0;
        p.shadow_strength = 0.03;
        p.leaves_per_node = 6;
        p.leaf_size = 1.2;
    });
    Species {
        slug: "lombardy-poplar",
        name: "Lombardy poplar",
        botanical: "Populus nigra 'Italica'",
        sentence: "A tall narrow column: all branches rise steeply along the trunk from the ground up.",
        appearance: Appearance::default()
            .leafy(LeafKind::Round, [92, 128, 50])
            .turned(0.3, 1.0, 0.2)
            .barked(BarkKind::Furrowed, [120, 112, 98])
            .carved(1.1, 1.1, 0.8),
        stand: Stand::Ground,
        schedule: vec![Grow(25)],
        parameters,
    }
}

fn weeping_willow() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.25;
        p.apical_control = 0.48;
        p.branching_angle = 55.0;
        p.setpoint_angle = 180.0;
        weigh(p, 0.6, 0.3);
        p.max_shoot_length = 6;
        p.shadow_strength = 0.1;
        p.twig_diameter = 0.06;
        p.leaves_per_node = 5;
        p.leaf_size = 1.4;
    });
    let limbs = changed(&parameters, |p| {
        p.setpoint_angle = 40.0;
        weigh(p, 0.6, 0.1);
        p.max_shoot_length = 4;
        p.shadow_strength = 0.3;
        p.shedding_threshold = 0.25;
    });
    let curtain = turn(&parameters, |p| {
        p.apical_control = 0.53;
        weigh(p, 0.5, 0.45);
        p.max_shoot_length = 12;
    });
    Species {
        slug: "weeping-willow",
        name: "Weeping willow",
        botanical: "Salix × sepulcralis",
        sentence: "A stout trunk and arching limbs, from which a curtain of long shoots hangs to the ground.",
        appearance: Appearance::default()
            .leafy(LeafKind::Lanceolate, [142, 164, 70])
            .turned(0.3, 1.0, -0.6)
            .barked(BarkKind::Furrowed, [122, 108, 86])
            .carved(1.3, 1.3, 1.1),
        stand: Stand::Ground,
        schedule: life(pole(&limbs, 8), [Grow(10), curtain, Grow(4)]),
        parameters,
    }
}

fn maple() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.3;
        p.buds_per_node = 2;
        p.phyllotactic_angle = 90.0;
        p.apical_control = 0.507;
        p.branching_angle = 42.0;
        p.setpoint_angle = 20.0;
        weigh(p, 0.45, 0.25);
        p.shadow_strength = 0.25;
        p.shedding_threshold = 0.25;
        p.leaves_per_node = 4;
        p.leaf_size = 1.5;
    });
    Species {
        slug: "maple",
        name: "Sugar maple",
        botanical: "Acer saccharum",
        sentence: "Paired buds build a dense oval crown, here in its autumn colours.",
        appearance: Appearance::default()
            .leafy(LeafKind::Palmate, [104, 136, 50])
            .turned(0.9, 2.0, -0.2)
            .barked(BarkKind::Furrowed, [112, 104, 94])
            .carved(1.1, 1.1, 1.0)
            .fruiting(fruit(FruitKind::Winged, [186, 128, 66], 0.5, 0.05, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 6), [Grow(14)]),
        parameters,
    }
}

fn plane() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.35;
        p.apical_control = 0.495;
        p.branching_angle = 50.0;
        p.deflection_angle = 10.0;
        p.setpoint_angle = 20.0;
        weigh(p, 0.5, 0.15);
        p.light_sensitivity = 1.0;
        p.shadow_strength = 0.3;
        p.shedding_threshold = 0.25;
        p.girth_exponent = 2.3;
        p.leaves_per_node = 4;
        p.leaf_size = 1.6;
    });
    Species {
        slug: "plane",
        name: "London plane",
        botanical: "Platanus × hispanica",
        sentence: "A high camouflage-patterned trunk under a few great limbs and an open, airy dome.",
        appearance: Appearance::default()
            .leafy(LeafKind::Palmate, [116, 144, 62])
            .turned(0.35, 1.0, -0.1)
            .barked(BarkKind::Flaking, [138, 132, 96])
            .carved(0.7, 1.1, 1.1)
            .fruiting(fruit(FruitKind::Round, [150, 128, 72], 0.3, 0.02, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 7), [Grow(14)]),
        parameters,
    }
}

fn cherry() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.2;
        p.apical_control = 0.475;
        p.branching_angle = 45.0;
        p.deflection_angle = 8.0;
        p.setpoint_angle = 45.0;
        weigh(p, 0.6, 0.1);
        p.shadow_strength = 0.35;
        p.shedding_threshold = 0.2;
        p.leaves_per_node = 7;
        p.leaf_size = 1.1;
    });
    Species {
        slug: "cherry",
        name: "Flowering cherry",
        botanical: "Prunus × yedoensis",
        sentence: "Wide-spread limbs on a short trunk, covered with blossom before the leaves come.",
        appearance: Appearance::default()
            .leafy(LeafKind::Ovate, [138, 134, 72])
            .turned(0.4, 0.2, 0.0)
            .barked(BarkKind::Banded, [92, 68, 62])
            .carved(0.9, 1.0, 1.0)
            .flowering(flower(FlowerKind::Rosette, [244, 196, 208], 0.75, 0.95, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 5), [Grow(13)]),
        parameters,
    }
}

fn apple() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.15;
        p.apical_control = 0.48;
        p.branching_angle = 65.0;
        p.deflection_angle = 15.0;
        p.setpoint_angle = 30.0;
        weigh(p, 0.45, 0.12);
        p.max_shoot_length = 3;
        p.shadow_strength = 0.35;
        p.shedding_threshold = 0.23;
        p.leaves_per_node = 5;
        p.leaf_size = 1.3;
    });
    Species {
        slug: "apple",
        name: "Apple",
        botanical: "Malus domestica",
        sentence: "A low round crown, as wide as high, on a short crooked trunk.",
        appearance: Appearance::default()
            .leafy(LeafKind::Ovate, [104, 140, 66])
            .turned(0.35, 1.0, 0.1)
            .barked(BarkKind::Furrowed, [110, 98, 84])
            .carved(1.1, 1.1, 1.3)
            .fruiting(fruit(FruitKind::Round, [200, 42, 34], 0.75, 0.05, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 4), [Grow(15)]),
        parameters,
    }
}

fn olive() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.15;
        p.buds_per_node = 2;
        p.phyllotactic_angle = 90.0;
        p.apical_control = 0.475;
        p.branching_angle = 50.0;
        p.setpoint_angle = 50.0;
        weigh(p, 0.35, 0.05);
        p.light_sensitivity = 1.5;
        p.max_shoot_length = 3;
        p.shadow_strength = 0.3;
        p.shedding_threshold = 0.12;
        p.girth_exponent = 2.05;
        p.twig_diameter = 0.08;
        p.leaves_per_node = 8;
        p.leaf_size = 1.5;
    });
    Species {
        slug: "olive",
        name: "Olive",
        botanical: "Olea europaea",
        sentence: "An old, thick, twisted trunk that carries a loose grey-green crown.",
        appearance: Appearance::default()
            .leafy(LeafKind::Lanceolate, [138, 150, 112])
            .turned(0.15, 1.0, 0.3)
            .barked(BarkKind::Furrowed, [128, 120, 106])
            .carved(1.7, 1.7, 1.5)
            .fruiting(fruit(FruitKind::Round, [62, 54, 64], 0.24, 0.06, Place::Twigs)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 2), [Grow(16)]),
        parameters,
    }
}

fn umbrella_acacia() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.2;
        p.apical_control = 0.455;
        p.branching_angle = 50.0;
        p.deflection_angle = 10.0;
        p.setpoint_angle = 52.0;
        p.light_sensitivity = 2.0;
        p.max_shoot_length = 4;
        weigh(p, 0.4, 0.45);
        p.shadow_strength = 0.4;
        p.shedding_threshold = 0.22;
        p.twig_diameter = 0.08;
        p.leaves_per_node = 9;
        p.leaf_size = 1.1;
        p.trunk_upward = false;
    });
    let level = turn(&parameters, |p| {
        p.marker_density = 0.3;
        p.marker_max_age = 4;
        p.shadow_strength = 0.2;
        p.setpoint_angle = 80.0;
    });
    let cleared = turn(&parameters, |p| {
        p.shedding_threshold = 0.29;
        p.shadow_strength = 0.2;
    });
    Species {
        slug: "umbrella-acacia",
        name: "Umbrella acacia",
        botanical: "Vachellia tortilis",
        sentence: "A wide, flat-topped canopy on limbs that fork low and spread like an umbrella's ribs.",
        appearance: Appearance::default()
            .leafy(LeafKind::Compound, [112, 132, 62])
            .turned(0.3, 1.0, 0.3)
            .barked(BarkKind::Furrowed, [116, 96, 76])
            .carved(1.1, 0.9, 1.0),
        stand: Stand::Ground,
        schedule: life(
            pole(&parameters, 4),
            [vec![Grow(8), level], canopy(14, [29.0, 1.0], 23.0, 4.0), vec![cleared, Grow(1)]].concat(),
        ),
        parameters,
    }
}

fn baobab() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.4;
        p.apical_control = 0.47;
        p.branching_angle = 65.0;
        p.deflection_angle = 4.0;
        p.setpoint_angle = 80.0;
        weigh(p, 0.5, 0.15);
        p.max_shoot_length = 3;
        p.shadow_strength = 0.4;
        p.shedding_threshold = 0.2;
        p.girth_exponent = 2.0;
        p.twig_diameter = 0.28;
        p.leaves_per_node = 3;
        p.leaf_size = 1.1;
    });
    Species {
        slug: "baobab",
        name: "Baobab",
        botanical: "Adansonia digitata",
        sentence: "A barrel of a trunk, out of all proportion to the short, sparse crown on top.",
        appearance: Appearance::default()
            .leafy(LeafKind::Palmate, [110, 134, 64])
            .turned(0.25, 1.0, -0.2)
            .barked(BarkKind::Smooth, [158, 138, 122])
            .carved(1.1, 1.6, 1.5)
            .fruiting(fruit(FruitKind::Nut, [132, 118, 82], 0.7, 0.05, Place::Tips)),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 7), [Grow(7)]),
        parameters,
    }
}

fn ginkgo() -> Species {
    let parameters = with(|p| {
        p.internode_length = 0.3;
        p.apical_control = 0.525;
        p.branching_angle = 55.0;
        p.setpoint_angle = 40.0;
        weigh(p, 0.65, 0.15);
        p.max_shoot_length = 5;
        p.light_sensitivity = 1.5;
        p.shadow_strength = 0.3;
        p.shedding_threshold = 0.2;
        p.leaves_per_node = 6;
        p.leaf_size = 1.0;
    });
    Species {
        slug: "ginkgo",
        name: "Ginkgo",
        botanical: "Ginkgo biloba",
        sentence: "Few stiff ascending limbs on a straight stem, clad in small fans that turn butter-yellow.",
        appearance: Appearance::default()
            .leafy(LeafKind::Fan, [122, 152, 62])
            .turned(0.1, 2.0, 0.0)
            .barked(BarkKind::Furrowed, [116, 104, 90])
            .carved(1.2, 1.0, 0.9),
        stand: Stand::Ground,
        schedule: life(pole(&parameters, 3), [Grow(13)]),
        parameters,
    }
}
