//! Bones stand where joints have their rows, and clips close.

use espalier_motion::{
    Pose, Rig, Weather,
    clips::{Clip, LOOP, clips, reaches},
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
        let clips = clips(&tree.joints, &tree.wood, &STRONG);
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
        let clips = clips(&tree.joints, &tree.wood, &STRONG);
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
        let clips = clips(&tree.joints, &tree.wood, &STRONG);
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

/// Vertices of one metamer do not part where one limb ends and another begins.
#[test]
fn a_limb_begins_where_its_bearer_carries_it() {
    let tree = grown("oak", 3000);
    let clips = clips(&tree.joints, &tree.wood, &STRONG);
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
        let [sway, gust] = clips(&tree.joints, &tree.wood, &STRONG);
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
        let clips = clips(&tree.joints, &tree.wood, &STRONG);
        let rig = rig_of(&tree, &clips, 256);
        assert!(!rig.bones().is_empty());
        let stands = rig.stand(&tree.joints, &tree.wood, &clips[1].keys[90]);
        assert!(stands.iter().all(|stand| stand.place.is_finite() && stand.turn.is_finite()));
    }
}
