//! The same commands give the same plant, bit for bit: in debug and release, on any number of threads.
//!
//! A change of these hashes is a change of the simulation: raise `SIMULATION_VERSION` with it. The summaries beside them,
//! in `snapshots`, say what the change does; `INSTA_UPDATE=always` on the test's command keeps new ones.

use super::{summary::summary, *};

/// A life with everything in it: brush, pencil, autonomous growth, shedding, time travel, a second seed.
fn life(seed: u32) -> Simulation {
    let mut simulation = simulation(seed);
    brush(
        &mut simulation,
        1,
        &[(Vec3::ZERO, 0.3), (Vec3::new(1.0, 9.0, 0.0), 0.3), (Vec3::new(4.0, 18.0, 2.0), 5.0)],
    );
    grow(&mut simulation, 7);
    simulation.go_to(simulation.plant().step() - 3);
    let mut values = simulation.parameters().values().clone();
    (values.apical_control, values.shedding_threshold, values.light_sensitivity) = (0.53, 0.05, 1.7);
    (values.setpoint_angle, values.gravimorphism_shift) = (60.0, 0.4);
    simulation.set_parameters(Parameters::new(values).expect("in range"));
    simulation.sow(Vec3::new(20.0, 0.0, 5.0));
    grow(&mut simulation, 14);
    assert!(simulation.plant().living_count() > 5000, "{}", simulation.plant().living_count());
    simulation
}

fn hash(simulation: &Simulation) -> u64 {
    simulation.plant().hash()
}

#[test]
fn lives_give_their_golden_hashes() {
    let lives = [1, 2, 3].map(life);
    let hashes = lives.each_ref().map(hash);
    // Shown with whatever fails first.
    eprintln!("hashes {hashes:#x?}");
    for (seed, life) in (1..).zip(&lives) {
        insta::assert_snapshot!(format!("life_{seed}"), summary(life));
    }
    assert_eq!(hashes, [0xb8cf_fb02_a116_6248, 0xc67a_62f2_88d8_215a, 0x2082_361e_ff8a_3df3], "{hashes:#x?}");
}

#[test]
fn threads_do_not_change_the_plant() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| hash(&life(1)))
    };
    assert_eq!([on(1), on(2), on(8)], [hash(&life(1)); 3]);
}
