//! Bones stand where joints have their rows, and clips close.

use espalier_motion::{
    Pose, Rig, Weather,
    clips::{Clip, Conditions, LOOP, blow, clips, reaches},
};
use glam::DVec3;

use crate::trees::{Tree, grown, unlike};

const STRONG: Weather = Weather { velocity: DVec3::new(14.0, 0.0, 6.0), turbulence: 0.8, seed: 7 };

fn rig_of(tree: &Tree, clips: &[Clip], most: usize) -> Rig {
    let reach = reaches(clips, tree.joints.all().len());
    Rig::of(&tree.joints, &tree.limbs, &tree.wood, 0, &reach, most)
}

#[test]
fn each_bone_stands_after_the_one_below_it_and_there_are_no_more_than_allowed() {
    for tree in unlike() {
        let clips = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, STRONG));
        for most in [0, 1, 2, 3, 17, 64, 256, 1024] {
            let rig = rig_of(&tree, &clips, most);
            let bones = rig.bones();
            assert!(bones.len() <= most.max(1), "{}: {} of {most}", tree.name, bones.len());
            assert_eq!(bones[0].parent, None);
            for (at, bone) in bones.iter().enumerate().skip(1) {
                assert!(bone.parent.is_some_and(|parent| (parent as usize) < at), "{}", tree.name);
            }
            for row in 0..tree.rows.len() as u32 {
                for share in [0.0, 0.4, 1.0] {
                    let bound = rig.bound(&tree.joints, row, share);
                    assert!((0.0..=1.0).contains(&bound.share));
                    assert!(bound.bones.iter().all(|&bone| (bone as usize) < bones.len()));
                }
            }
        }
    }
}

#[test]
fn bones_move_as_the_rows_they_stand_on() {
    for tree in unlike() {
        let clips = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, STRONG));
        let rig = rig_of(&tree, &clips, 256);
        for clip in &clips {
            for key in [0, 31, 77, 150] {
                // Joints that have no bones are left out of both.
                let shown = |(joint, &bend): (usize, &DVec3)| match rig.shows(joint as u32) {
                    true => bend,
                    false => DVec3::ZERO,
                };
                let bends: Vec<DVec3> = clip.keys[key].iter().enumerate().map(shown).collect();
                let pose = Pose::of(&tree.joints, &tree.wood, &bends);
                let stands = rig.stand(&tree.joints, &tree.wood, &clip.keys[key]);
                for (bone, stand) in rig.bones().iter().zip(&stands).skip(1) {
                    let node = pose.node(&tree.joints, &tree.wood, bone.row);
                    assert!(stand.place.distance(node.place) < 1e-3, "{}", tree.name);
                    assert!(stand.turn.angle_between(node.turn) < 1e-6);
                }
            }
        }
    }
}

/// Blended between two bones, rows are nearly where they belong: as far as the wind moves them, they miss little.
#[test]
fn what_is_blended_between_bones_is_near_what_bends() {
    for tree in unlike() {
        let clips = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, STRONG));
        let rig = rig_of(&tree, &clips, 1024);
        let [mut missed, mut moved] = [0.0f64; 2];
        for key in [10, 60, 100] {
            let pose = Pose::of(&tree.joints, &tree.wood, &clips[0].keys[key]);
            let stands = rig.stand(&tree.joints, &tree.wood, &clips[0].keys[key]);
            for row in (0..tree.rows.len() as u32).step_by(7) {
                let rest = tree.wood.place(row);
                let bound = rig.bound(&tree.joints, row, 1.0);
                let at = |bone: u32| {
                    let (stand, bone) = (stands[bone as usize], rig.bones()[bone as usize]);
                    stand.place + stand.turn * (rest - bone.rest)
                };
                let [one, other] = bound.bones.map(at);
                let node = pose.node(&tree.joints, &tree.wood, row).place;
                missed += one.lerp(other, bound.share).distance_squared(node);
                moved += rest.distance_squared(node);
            }
        }
        let share = (missed / moved).sqrt();
        assert!(share < 0.15, "{}: rows miss {share} of how far they move", tree.name);
    }
}

/// How far what is blended between bones misses the pose all through a clip, root mean square and at most, as shares of how
/// far the tip moves that moves furthest: of places at and around the nodes of all rows.
fn missed(tree: &Tree, clip: &Clip, rig: &Rig) -> [f64; 2] {
    let [mut squares, mut count, mut furthest, mut moved] = [0.0f64; 4];
    for key in (0..clip.keys.len()).step_by(16) {
        let pose = Pose::of(&tree.joints, &tree.wood, &clip.keys[key]);
        let stands = rig.stand(&tree.joints, &tree.wood, &clip.keys[key]);
        for row in 0..tree.rows.len() as u32 {
            let node = pose.node(&tree.joints, &tree.wood, row);
            let bound = rig.bound(&tree.joints, row, 1.0);
            for aside in [DVec3::ZERO, DVec3::new(0.02, 0.0, 0.01), DVec3::new(-0.01, 0.01, -0.02)] {
                let rest = tree.wood.place(row) + aside;
                let at = |bone: u32| {
                    let (stand, bone) = (stands[bone as usize], rig.bones()[bone as usize]);
                    stand.place + stand.turn * (rest - bone.rest)
                };
                let [one, other] = bound.bones.map(at);
                let wanted = node.place + node.turn * aside;
                let missed = one.lerp(other, bound.share).distance(wanted);
                squares += missed * missed;
                count += 1.0;
                furthest = furthest.max(missed);
                moved = moved.max(wanted.distance(rest));
            }
        }
    }
    [(squares / count).sqrt() / moved, furthest / moved]
}

/// `cargo test -p espalier-motion --test motion with_256_bones -- --nocapture` prints what fewer bones miss.
#[test]
fn with_256_bones_the_surface_is_near_the_pose_beside_how_far_tips_move() {
    for tree in unlike() {
        let clips = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, STRONG));
        let shares = [1024, 256, 64].map(|most| {
            let rig = rig_of(&tree, &clips, most);
            (rig.bones().len(), missed(&tree, &clips[0], &rig))
        });
        for (bones, [mean, most]) in shares {
            let [mean, most] = [100.0 * mean, 100.0 * most];
            println!("{}: {bones} bones miss {mean:.1} %, {most:.1} % at most", tree.name);
        }
        let [all, enough, few] = shares.map(|(_, [mean, _])| mean);
        assert!(all < 0.005 && enough < 0.02 && few < 0.08, "{}: {shares:?}", tree.name);
        let [most_of_all, most, _] = shares.map(|(_, [_, most])| most);
        assert!(most_of_all < 0.1 && most < 0.2, "{}: {shares:?}", tree.name);
    }
}

/// Vertices of one metamer do not part where one limb ends and another begins.
#[test]
fn a_limb_begins_where_its_bearer_carries_it() {
    let tree = grown("oak", 3000);
    let clips = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, STRONG));
    let rig = rig_of(&tree, &clips, 256);
    for joint in (0..tree.joints.all().len() as u32).filter(|&joint| rig.shows(joint)) {
        let first = tree.joints.all()[joint as usize].first;
        let bound = rig.bound(&tree.joints, first, 0.0);
        let base = rig.bones()[bound.bones[0] as usize];
        assert_eq!((bound.share, base.weight), (0.0, 0.0));
        assert_eq!(base.row, tree.joints.all()[joint as usize].node);
    }
}

#[test]
fn loops_close_to_the_bit_and_gusts_begin_and_end_at_rest() {
    for tree in unlike() {
        let [sway, gust] = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, STRONG));
        assert_eq!(sway.keys.first(), sway.keys.last());
        assert_eq!(sway.time(sway.keys.len() - 1), LOOP);
        for end in [gust.keys.first(), gust.keys.last()] {
            assert!(end.is_some_and(|key| key.iter().all(|bend| *bend == DVec3::ZERO)));
        }
        assert_eq!(gust.time(gust.keys.len() - 1), gust.length);
        let most = |key: &Vec<DVec3>| key.iter().map(|bend| bend.length()).fold(0.0, f64::max);
        for clip in [&sway, &gust] {
            let strongest = clip.keys.iter().map(most).fold(0.0, f64::max);
            assert!((0.05..1.2).contains(&strongest), "{}, {}: {strongest}", tree.name, clip.name);
            // The slowest joint, which is a trunk or a bough, makes no leap.
            let slow = (0..tree.joints.all().len())
                .min_by(|&a, &b| tree.joints.all()[a].frequency.total_cmp(&tree.joints.all()[b].frequency));
            let slow = slow.expect("there are joints");
            let leap =
                clip.keys.windows(2).map(|two| two[0][slow].distance(two[1][slow])).fold(0.0, f64::max);
            assert!(leap < 0.12, "{}, {}: {leap}", tree.name, clip.name);
        }
    }
}

#[test]
fn what_hardly_is_a_tree_has_its_ground() {
    for tree in [crate::trees::pole(1, [0, 256, 0], |_| 0.05), grown("oak", 60)] {
        let clips = clips(&tree.joints, &tree.wood, &Conditions::open(&tree.wood, STRONG));
        let rig = rig_of(&tree, &clips, 256);
        assert!(!rig.bones().is_empty());
        let stands = rig.stand(&tree.joints, &tree.wood, &clips[1].keys[90]);
        assert!(stands.iter().all(|stand| stand.place.is_finite() && stand.turn.is_finite()));
    }
}

/// A gust as each joint answers it alone, as bodies do together, and the bones that show both.
fn blown(tree: &Tree, weather: &Weather) -> (Clip, Clip, Rig) {
    let conditions = Conditions::open(&tree.wood, *weather);
    let [sway, alone] = clips(&tree.joints, &tree.wood, &conditions);
    let rig = rig_of(tree, &[sway, alone.clone()], 256);
    let mut gust = alone.clone();
    let plants = (&tree.joints, &tree.limbs, &tree.wood);
    let done = blow(&mut gust, std::slice::from_ref(&rig), plants, &conditions, || Ok::<(), ()>(()));
    assert_eq!(done, Ok(()));
    (alone, gust, rig)
}

#[test]
fn bodies_in_a_gust_begin_and_end_at_rest_and_lean_with_it() {
    for tree in unlike() {
        let (alone, gust, rig) = blown(&tree, &STRONG);
        for end in [gust.keys.first(), gust.keys.last()] {
            assert!(end.is_some_and(|key| key.iter().all(|bend| *bend == DVec3::ZERO)), "{}", tree.name);
        }
        assert!(gust.keys.iter().flatten().all(|bend| bend.is_finite() && bend.length() < 1.2));
        // How far the tips of all limbs with bones go on average while it blows.
        let lean = |clip: &Clip| {
            let at = |key: usize| {
                let stands = rig.stand(&tree.joints, &tree.wood, &clip.keys[key]);
                let away =
                    |(stand, bone): (&espalier_motion::Node, &espalier_motion::Bone)| stand.place - bone.rest;
                stands.iter().zip(rig.bones()).map(away).sum::<DVec3>() / stands.len() as f64
            };
            (60..=130).step_by(10).map(at).sum::<DVec3>() / 8.0
        };
        let [closed, bodies] = [lean(&alone), lean(&gust)];
        let along = STRONG.velocity.normalize();
        assert!(bodies.dot(along) > 0.4 * closed.dot(along), "{}: {bodies} beside {closed}", tree.name);
        assert!(bodies.dot(along) < 2.0 * closed.dot(along), "{}: {bodies} beside {closed}", tree.name);
    }
}

#[test]
fn a_gust_reaches_what_stands_behind_later() {
    // Two plants, one 20 m behind the other, each with its bones.
    let one = grown("default", 400);
    let count = one.rows.len() as u32;
    let aside = (20.0 / one.scale.internode_length * 256.0) as i32;
    let rows = (0..2 * count).map(|row| {
        let own = one.rows.row(row % count);
        let parent = own.parent.map(|parent| parent + row / count * count);
        let [x, y, z] = own.position;
        espalier_motion::Row { parent, position: [x + (row / count) as i32 * aside, y, z], ..own }
    });
    let rows = espalier_motion::Rows::new(rows.collect::<Vec<_>>()).expect("parents stand below");
    let two = Tree::of("two", rows, one.scale);
    let weather = Weather { velocity: DVec3::X * 6.0, turbulence: 0.0, seed: 1 };
    let conditions = Conditions::open(&two.wood, weather);
    let [sway, mut gust] = clips(&two.joints, &two.wood, &conditions);
    let reach = reaches(&[sway, gust.clone()], two.joints.all().len());
    let rigs = [0, count].map(|seed| Rig::of(&two.joints, &two.limbs, &two.wood, seed, &reach, 64));
    let plants = (&two.joints, &two.limbs, &two.wood);
    blow(&mut gust, &rigs, plants, &conditions, || Ok::<(), ()>(())).expect("nothing ends it");
    let trunk = |seed: u32| two.joints.all().iter().position(|joint| joint.node == seed);
    let comes = |seed: u32| {
        let trunk = trunk(seed).expect("it has one");
        gust.keys.iter().position(|key| key[trunk].length() > 0.01).expect("it bends")
    };
    let [first, second] = [0, count].map(comes);
    assert!(second > first + 15, "at keys {first} and {second}");
}
