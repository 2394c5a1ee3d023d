//! Clients draw wood by themselves: both must find the places, directions and lengths in `golden/course.json`.
//!
//! After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-mesh drawn`.

use std::{f64::consts::TAU, fs, path::PathBuf};

use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use super::{Drawn, Shape, limb_curve::LimbCurve};
use crate::{Limbs, Row, Rows, leaves::hash, radius_code};

/// What is written down is in steps of so much of an internode.
const STEPS: f64 = 1024.0;

/// Numbers from 0 to 1, always the same.
struct Randoms(u32);

impl Randoms {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        f64::from(hash(self.0)) / 4_294_967_296.0
    }
}

fn rounded(place: DVec3) -> DVec3 {
    (place * STEPS).round() / STEPS
}

fn steps(place: DVec3) -> [i64; 3] {
    place.to_array().map(|part| (part * STEPS).round() as i64)
}

/// Nodes of wood that turns at each of them by up to so much, in any direction.
fn wandering(random: &mut Randoms, count: usize, turn: f64) -> Vec<DVec3> {
    let mut nodes = vec![DVec3::ZERO];
    let mut heading = DVec3::Y;
    for _ in 0..count {
        nodes.push(rounded(nodes[nodes.len() - 1] + (0.7 + 0.6 * random.next()) * heading));
        let side = heading.cross(if heading.y.abs() < 0.9 { DVec3::Y } else { DVec3::X }).normalize();
        let (around, by) = (TAU * random.next(), turn * random.next());
        let out = libm::cos(around) * side + libm::sin(around) * heading.cross(side);
        heading = (libm::cos(by) * heading + libm::sin(by) * out).normalize();
    }
    nodes
}

/// A limb to be fitted.
struct Case {
    name: String,
    nodes: Vec<DVec3>,
    radii: Vec<f64>,
    offset: DVec3,
    bearer: f64,
    rises: bool,
    is_rounded: bool,
}

impl Case {
    fn new(name: impl Into<String>, nodes: Vec<DVec3>, radius: impl Fn(usize) -> f64) -> Self {
        let radii = (0..nodes.len()).map(|i| (radius(i) * STEPS).round() / STEPS).collect();
        let name = name.into();
        Self { name, nodes, radii, offset: DVec3::ZERO, bearer: 0.0, rises: false, is_rounded: true }
    }

    fn fitted(&self) -> Value {
        let mut curve = LimbCurve::default();
        for (&node, &radius) in self.nodes.iter().zip(&self.radii) {
            curve.push(node, radius);
        }
        curve.fit(self.offset, self.bearer, self.rises, self.is_rounded);
        let all = |of: &[DVec3]| of.iter().map(|&place| steps(place)).collect::<Vec<_>>();
        json!({
            "name": self.name,
            "nodes": all(&self.nodes),
            "radii": self.radii.iter().map(|radius| (radius * STEPS).round() as i64).collect::<Vec<_>>(),
            "offset": steps(self.offset),
            "bearer": (self.bearer * STEPS).round() as i64,
            "rises": self.rises,
            "rounded": self.is_rounded,
            "places": all(&curve.places),
            "directions": all(&curve.directions),
        })
    }
}

fn cases() -> Vec<Case> {
    let mut random = Randoms(7);
    let line = |heights: &[f64]| heights.iter().map(|&y| rounded(DVec3::new(0.2 * y, y, -0.1 * y))).collect();
    let mut cases = vec![Case::new("straight", line(&[0.0, 1.0, 1.3, 2.6, 3.0, 4.4, 5.0, 6.0]), |_| 2.0)];
    let arc = |bend: f64| (0..20).map(move |i| f64::from(i) / bend).map(move |turn| (bend, turn));
    let bent = |bend: f64| {
        let place = |(bend, turn)| bend * DVec3::new(1.0 - libm::cos(turn), libm::sin(turn), 0.0);
        arc(bend).map(place).map(rounded).collect()
    };
    cases.push(Case::new("bent evenly", bent(6.0), |_| 2.0));
    for radius in [0.6, 1.0, 2.0, 4.0] {
        let up = (0..=12).map(|i| DVec3::Y * f64::from(i));
        let aside = (1..=12).map(|i| DVec3::new(f64::from(i), 12.0, 0.0));
        cases.push(Case::new(format!("corner, {radius} thick"), up.chain(aside).collect(), |_| radius));
    }
    for i in 0..8 {
        let radius = 0.3 + 0.45 * f64::from(i);
        let nodes = wandering(&mut random, 16, (1.1 / radius).min(1.4));
        cases.push(Case::new(format!("crooked, {radius:.2} thick"), nodes, |_| radius));
    }
    cases.push(Case::new("thin", wandering(&mut random, 12, 2.0), |_| 0.2));
    cases.push(Case::new("tapering", wandering(&mut random, 20, 0.8), |i| 1.5 - 0.07 * i as f64));
    let hairpin = [[0.0, 0.0], [0.0, 1.0], [0.0, 2.0], [0.3, 2.9], [0.5, 2.0], [0.6, 1.0], [0.7, 0.0]];
    let hairpin = hairpin.map(|[x, y]| rounded(DVec3::new(x, y, 0.0))).to_vec();
    cases.push(Case::new("hairpin", hairpin, |_| 0.7));
    let mut twice = wandering(&mut random, 6, 0.5);
    twice[3] = twice[2];
    cases.push(Case::new("two nodes in one place", twice, |_| 0.5));
    let mut carried = Case::new("carried", wandering(&mut random, 10, 0.6), |_| 0.25);
    (carried.offset, carried.bearer) = (DVec3::new(0.25, 0.0, -0.5), 1.25);
    cases.push(carried);
    let mut stout =
        Case::new("carried and stout", wandering(&mut random, 10, 0.9), |i| 1.0 - 0.05 * i as f64);
    (stout.offset, stout.bearer) = (DVec3::new(-0.125, 0.25, 0.0), 1.5);
    cases.push(stout);
    let mut trunk = Case::new("leaning trunk", wandering(&mut random, 14, 0.5), |i| 2.0 - 0.1 * i as f64);
    trunk
        .nodes
        .iter_mut()
        .for_each(|node| *node = rounded(DVec3::new(node.x + 0.6 * node.y, node.y, node.z)));
    trunk.rises = true;
    cases.push(trunk);
    let mut cornered = Case::new("with its corners", wandering(&mut random, 8, 1.2), |_| 1.0);
    cornered.is_rounded = false;
    cases.push(cornered);
    cases
}

/// A metamer of a tree: its parent, its place in internodes, its radius, and whether it begins an axis.
type Twig = (Option<u32>, DVec3, f64, bool);

/// Trunks and limbs that fold, follow leaders and take over girth.
fn trees() -> Vec<(&'static str, Vec<Twig>)> {
    let seed: Twig = (None, DVec3::ZERO, 0.0, false);
    let mut cornered = vec![seed];
    for i in 0..12 {
        let place = DVec3::new(f64::from(i % 3) * 0.75, f64::from(i) + 1.0, 0.0);
        cornered.push((Some(i), place, 1.2, false));
    }
    for i in 0..8u32 {
        let parent = if i == 0 { 4 } else { 12 + i };
        let place = DVec3::new(0.25, 4.0 + 0.25 * f64::from(i), f64::from(i) + 1.0);
        cornered.push((Some(parent), place, 0.3, i == 0));
    }
    // The trunk is thin above its third node, where a thick lateral leads on; further up the trunk was cut, and a lateral
    // goes on in its place.
    let mut led = vec![seed];
    for i in 0..6u32 {
        let radius = if i < 3 { 1.0 } else { 0.3 };
        led.push((Some(i), DVec3::new(0.0, f64::from(i) + 1.0, 0.125 * f64::from(i)), radius, false));
    }
    for i in 0..8u32 {
        let parent = if i == 0 { 3 } else { 6 + i };
        let place = DVec3::new(0.7 + 0.7 * f64::from(i), 3.7 + 0.5 * f64::from(i), 0.0);
        led.push((Some(parent), rounded(place), 0.9 - 0.05 * f64::from(i), i == 0));
    }
    led.push((Some(14), rounded(DVec3::new(6.0, 8.0, 0.5)), 0.5, true));
    led.push((Some(6), rounded(DVec3::new(0.5, 6.5, 0.75)), 0.29, true));
    vec![("cornered", cornered), ("led", led), ("grown", grown(&mut Randoms(400)))]
}

/// Wood that grows here and there.
fn grown(random: &mut Randoms) -> Vec<Twig> {
    let mut twigs: Vec<Twig> = vec![(None, DVec3::new(1.0, 0.0, -2.0), 0.0, false)];
    let mut tips: Vec<(u32, DVec3)> = vec![(0, DVec3::Y)];
    while twigs.len() < 90 {
        let at = (random.next() * tips.len() as f64) as usize;
        let (tip, heading) = tips[at];
        let aside = DVec3::new(random.next() - 0.5, random.next() - 0.4, random.next() - 0.5);
        let (_, from, _, _) = twigs[tip as usize];
        let (ahead, lateral) = ((heading + aside).normalize(), (0.3 * heading + 2.0 * aside).normalize());
        let row = twigs.len() as u32;
        twigs.push((Some(tip), from + ahead, 0.0, false));
        tips[at] = (row, ahead);
        if tip > 0 && random.next() < 0.4 {
            twigs.push((Some(tip), from + lateral, 0.0, true));
            tips.push((row + 1, lateral));
        }
    }
    // As thick as all that stands on it, so that some of it is stout.
    let mut squares = vec![0.0; twigs.len()];
    for row in (1..twigs.len()).rev() {
        if squares[row] == 0.0 {
            squares[row] = 0.06;
        }
        if let Some(parent) = twigs[row].0 {
            squares[parent as usize] += squares[row];
        }
    }
    let square = |(twig, square): (Twig, f64)| (twig.0, twig.1, f64::sqrt(square), twig.3);
    twigs.into_iter().zip(squares).map(square).collect()
}

/// How a tree is drawn, by the rows that clients would have of it.
fn drawn(twigs: &[Twig]) -> (Rows, Drawn) {
    let rows = twigs.iter().map(|&(parent, place, radius, starts_axis)| Row {
        parent,
        starts_axis,
        position: place.to_array().map(|part| (part * 256.0).round() as i32),
        radius: if parent.is_some() { radius_code::encode(radius as f32) } else { 0 },
        leaves: 0,
    });
    let rows = Rows::new(rows).expect("parents stand below");
    let places: Vec<Vec3> = (0..rows.len()).map(|row| rows.place(row).as_vec3()).collect();
    let radii: Vec<f32> = rows.radius.iter().map(|&code| radius_code::decode(code)).collect();
    let shape = Shape { root_flare: 1.0, is_rounded: true };
    let drawn = Drawn::of(&rows, &Limbs::of(&rows), &places, &radii, shape);
    (rows, drawn)
}

fn tree((name, twigs): &(&str, Vec<Twig>)) -> Value {
    let (rows, drawn) = drawn(twigs);
    let all = (0..rows.len()).map(|row| {
        let of = rows.row(row as u32);
        let [place, direction] = [drawn.places[row], drawn.directions[row]].map(|at| steps(at.as_dvec3()));
        let measures = [drawn.arc[row], drawn.radii[row]].map(|at| (f64::from(at) * STEPS).round() as i64);
        json!([of.parent, of.starts_axis, of.position, of.radius, place, direction, measures])
    });
    json!({ "name": name, "rows": all.collect::<Vec<_>>() })
}

fn lines(all: impl Iterator<Item = Value>) -> String {
    all.map(|one| one.to_string()).collect::<Vec<_>>().join(",\n")
}

#[test]
fn wood_is_drawn_where_it_was_written_down() {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/course.json");
    let (limbs, trees) = (lines(cases().iter().map(Case::fitted)), lines(trees().iter().map(tree)));
    let written = format!("{{\"limbs\":[\n{limbs}\n],\"trees\":[\n{trees}\n]}}\n");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, &written).expect("the sample can be written");
    }
    let stored = fs::read_to_string(&file).expect("the sample can be read");
    assert!(stored == written, "wood is drawn elsewhere than golden/course.json has it");
}

#[test]
fn the_sample_folds_leads_and_stays() {
    let far = |twigs: &[Twig]| {
        let (rows, drawn) = drawn(twigs);
        (0..rows.len()).filter(|&row| drawn.places[row].as_dvec3().distance(rows.place(row)) > 0.02).count()
    };
    let all = trees();
    let [cornered, led, grown] = [0, 1, 2].map(|tree: usize| far(&all[tree].1));
    assert!(cornered > 6 && led > 2 && (1..60).contains(&grown), "{cornered} {led} {grown}");
    let (rows, _) = drawn(&all[1].1);
    let limbs = Limbs::of(&rows);
    assert_eq!(limbs.onward(3), Some(7), "the thick lateral leads");
}
