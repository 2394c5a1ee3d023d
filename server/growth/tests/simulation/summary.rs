//! A plant in a few lines of text, so that a change of its hash shows what became of it.

use std::fmt::Write as _;

use espalier_growth::Simulation;
use espalier_plant::{AxisId, MetamerId};
use glam::Vec3;

/// How many metamers are listed, evenly over all rows.
const LISTED: usize = 12;

/// Counts, wood by the order of its axes, extent, and some metamers; lengths in internodes, rounded.
pub fn summary(simulation: &Simulation) -> String {
    let plant = simulation.plant();
    let (metamers, rows) = (plant.metamers(), (0..plant.metamer_count()).map(MetamerId::new));
    let mut text = String::new();
    let mut line = |words: std::fmt::Arguments<'_>| writeln!(text, "{words}").expect("a string takes text");
    line(format_args!("plant"));
    line(format_args!("  step {}", plant.step()));
    line(format_args!("  metamers {}, living {}", plant.metamer_count(), plant.living_count()));
    line(format_args!("  axes {}, living {}", plant.axis_count(), plant.living_axes_count()));
    line(format_args!("orders"));
    let living: Vec<MetamerId> = rows.clone().filter(|&id| plant.is_alive(id)).collect();
    let order = |id: MetamerId| plant.axes().order(metamers.axis(id));
    let mut with_wood: Vec<AxisId> = living.iter().map(|&id| metamers.axis(id)).collect();
    with_wood.sort_unstable();
    with_wood.dedup();
    for number in 0..=living.iter().map(|&id| order(id)).max().unwrap_or(0) {
        let axes = with_wood.iter().filter(|&&axis| plant.axes().order(axis) == number).count();
        let wood = living.iter().filter(|&&id| order(id) == number).count();
        line(format_args!("  {number}: {axes} axes of {wood} metamers"));
    }
    let ends = || living.iter().map(|&id| metamers.end(id));
    line(format_args!("extent"));
    line(format_args!("  from {}", place(ends().fold(Vec3::INFINITY, Vec3::min))));
    line(format_args!("  to   {}", place(ends().fold(Vec3::NEG_INFINITY, Vec3::max))));
    line(format_args!("rows"));
    for id in rows.step_by(plant.metamer_count().div_ceil(LISTED)) {
        let parent = metamers.parent(id).map_or("none".into(), |parent| parent.raw().to_string());
        let state = if plant.is_alive(id) { "living" } else { "dead" };
        let (born, tips) = (plant.birth(id), metamers.tips(id));
        let (order, end) = (order(id), place(metamers.end(id)));
        line(format_args!(
            "  {}: {state}, order {order}, on {parent}, born {born}, tips {tips}, end {end}",
            id.raw()
        ));
    }
    text
}

/// Rounded to a tenth; what rounds to zero has no sign.
fn place(position: Vec3) -> String {
    let round = |value: f32| (value * 10.0).round() / 10.0 + 0.0;
    format!("({:.1}, {:.1}, {:.1})", round(position.x), round(position.y), round(position.z))
}
