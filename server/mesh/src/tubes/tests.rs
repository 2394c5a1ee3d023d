use espalier_plant::Internode;

use super::*;
use crate::{checks, style::StyleOptions};

/// A straight trunk of some internodes with one lateral to +X at its first node.
fn trunk(internodes: u32, lateral: bool) -> Plant {
    let mut plant = Plant::new(Vec3::ZERO);
    plant.begin_step();
    for height in 1..=internodes {
        let end = Vec3::Y * height as f32;
        plant.extend(AxisId::new(0), &Internode { end, normal: Vec3::X, laterals: &[Vec3::X] });
    }
    if lateral {
        let internode = Internode { end: Vec3::new(1.0, 1.0, 0.0), normal: Vec3::Y, laterals: &[] };
        plant.extend(AxisId::new(1), &internode);
    }
    plant.end_step();
    plant
}

fn courses_of(plant: &Plant) -> Vec<Course> {
    Courses::of(plant, &style(0.1), &BarkLook::default()).all
}

/// A trunk that does not spread at its foot.
fn plain() -> BarkLook {
    BarkLook { root_flare: 0.0, ..BarkLook::default() }
}

/// The wood of the only plant, which is closed.
fn wood_of(plant: &Plant, style: &Style, look: &BarkLook) -> Wood {
    let mut plants = wood(plant, style, look);
    let wood = plants.pop().expect("it has grown");
    assert!(plants.is_empty());
    assert_eq!(checks::wood(&wood), Ok(()));
    wood
}

fn bark_of(plant: &Plant, style: &Style) -> TriangleMesh {
    wood_of(plant, style, &plain()).surface
}

fn style(twig_diameter: f32) -> Style {
    Style::new(StyleOptions { twig_diameter, ..StyleOptions::default() })
}

/// The largest distance from the trunk's middle at a height.
fn girth_at(mesh: &TriangleMesh, height: f32) -> f32 {
    let ring = mesh.positions.iter().filter(|p| (p.y - height).abs() < 1e-5);
    ring.map(|p| Vec3::new(p.x, 0.0, p.z).length()).fold(0.0, f32::max)
}

#[test]
fn seed_alone_has_no_wood() {
    assert!(wood(&Plant::new(Vec3::ZERO), &Style::default(), &BarkLook::default()).is_empty());
}

#[test]
fn sides_keep_the_chord_error() {
    // cos(36°) = 0.809, so a pentagon keeps 0.01 up to a radius of 0.0523.
    assert_eq!(
        [0.004, 0.05, 0.053, 1.0, 100.0].map(|radius| sides(radius, &Grain::default())),
        [3, 5, 6, 23, 24]
    );
}

#[test]
fn trunk_is_round_faces_out_and_tapers() {
    let mesh = wood_of(&trunk(4, false), &style(0.1), &BarkLook::default()).surface;
    // The roots spread by 0.58, half a radius deep; the tip is slim.
    assert!((girth_at(&mesh, -0.025) - 0.05 * 1.58).abs() < 1e-5);
    assert!((girth_at(&mesh, 3.0) - 0.05).abs() < 1e-5);
    assert!((girth_at(&mesh, 4.0) - 0.05 * 0.45).abs() < 1e-5);
}

#[test]
fn lateral_begins_in_its_bearer_with_a_collar() {
    let plant = trunk(3, true);
    let courses = courses_of(&plant);
    assert_eq!(courses.len(), 2);
    let lateral = &courses[1];
    assert_eq!(lateral.nodes[0].place, Vec3::Y);
    assert!(lateral.nodes[0].direction.y > 0.4, "it leaves along its bearer");
    let bearing = 0.05 * libm::powf(2.0, 0.4);
    let first = samples(lateral, 1.0, 0.0)[0].radius;
    assert!((first - 0.95 * bearing).abs() < 1e-5, "the collar is {first} wide on a trunk of {bearing}");
}

#[test]
fn shed_wood_is_not_drawn() {
    let mut plant = trunk(3, true);
    let whole = bark_of(&plant, &style(0.1));
    plant.begin_step();
    plant.shed(&[AxisId::new(1)]);
    plant.end_step();
    let rest = bark_of(&plant, &style(0.1));
    assert!(rest.positions.len() < whole.positions.len());
    assert!(rest.bounds().is_some_and(|[_, high]| high.x < 0.2));
}

#[test]
fn texels_are_square_and_close_at_the_seam() {
    let mesh = bark_of(&trunk(3, false), &style(1.0));
    // From node 1 to node 2 the radius is 0.5 and the flare nearly gone.
    let v_at = |height: f32| {
        let at = mesh.positions.iter().position(|p| (p.y - height).abs() < 1e-5).expect("a node has a ring");
        mesh.uvs[at].y
    };
    let circumference = TAU * 0.5;
    let tiles = squares(0.5);
    assert_eq!(tiles, 1.0);
    assert!((v_at(2.0) - v_at(1.0) - tiles / circumference).abs() < 0.08);
    let (first, last) = (0, sides(0.5, &Grain::default()) as usize);
    assert_eq!(mesh.positions[first], mesh.positions[last]);
    assert_eq!((mesh.uvs[first].x, mesh.uvs[last].x), (0.0, tiles));
}

/// Sets the diameters of rows, then cuts a row off.
fn edit(plant: &mut Plant, widths: &[(usize, f32)], cut: Option<usize>) {
    plant.begin_edit();
    for &(row, diameter) in widths {
        plant.set_width(MetamerId::new(row), Some(diameter));
    }
    if let Some(cut) = cut {
        plant.prune(&[MetamerId::new(cut)]);
    }
    plant.end_step();
}

#[test]
fn stub_keeps_its_width_and_ends_flat() {
    let mut plant = trunk(5, false);
    edit(&mut plant, &[(3, 0.4)], Some(4));
    let wood = wood_of(&plant, &style(0.1), &plain());
    let mesh = &wood.surface;
    assert!(mesh.bounds().is_some_and(|[_, high]| (high.y - 3.0).abs() < 1e-6));
    assert!((girth_at(mesh, 3.0) - 0.2).abs() < 1e-5 && (girth_at(mesh, 2.0) - 0.2).abs() < 1e-4);
    // The face is a whole polygon of upright triangles.
    let mut face = 0.0;
    for corners in wood.cuts.as_chunks::<3>().0 {
        let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
        let area = 0.5 * (b - a).cross(c - a);
        assert!(area.y > 0.0 && area.x.abs() < 1e-6 && area.z.abs() < 1e-6);
        assert!(corners.iter().all(|&corner| mesh.normals[corner as usize].y > 0.999));
        face += area.y;
    }
    let sides = sides(0.2, &Grain::default()) as f32;
    let polygon = 0.5 * sides * 0.04 * libm::sinf(TAU / sides);
    assert!((face - polygon).abs() < 1e-5, "the face has {face}, not {polygon}");
}

#[test]
fn cut_without_a_width_is_a_twig() {
    let mut plant = trunk(5, true);
    edit(&mut plant, &[], Some(3));
    let mesh = bark_of(&plant, &style(0.1));
    // As if nothing had been above, but neither slim nor pointed.
    assert!((girth_at(&mesh, 2.0) - 0.05).abs() < 1e-5);
    assert!(mesh.bounds().is_some_and(|[_, high]| high.y < 2.0 + 1e-5 && high.x > 1.0));
}

#[test]
fn a_thick_end_shows_its_cut_beside_a_twig() {
    let mut plant = trunk(5, true);
    edit(&mut plant, &[(1, 0.4)], Some(2));
    let courses = courses_of(&plant);
    assert_eq!(courses.iter().map(|course| course.end).collect::<Vec<_>>(), [End::Cut, End::Grown]);
    assert_eq!(courses[0].nodes.iter().map(|node| node.place).collect::<Vec<_>>(), [Vec3::ZERO, Vec3::Y]);
    bark_of(&plant, &style(0.1));
}

#[test]
fn a_lateral_as_thick_goes_on_in_the_place_of_a_cut() {
    let mut plant = trunk(5, true);
    edit(&mut plant, &[], Some(2));
    let [course] = &courses_of(&plant)[..] else { panic!("it is one limb") };
    assert_eq!(course.nodes.len(), 3);
    assert_eq!((course.nodes[2].place, course.end), (Vec3::new(1.0, 1.0, 0.0), End::Grown));
    bark_of(&plant, &style(0.1));
}

#[test]
fn roots_show_as_ribs_where_a_tube_is_round_enough() {
    let mesh = wood_of(&trunk(3, false), &style(1.0), &BarkLook::default()).surface;
    let foot: Vec<f32> = mesh
        .positions
        .iter()
        .filter(|place| (place.y + 0.25).abs() < 1e-5)
        .map(|place| Vec3::new(place.x, 0.0, place.z).length())
        .collect();
    let [low, high] = foot
        .iter()
        .filter(|&&far| far > 0.1)
        .fold([f32::MAX, 0.0], |[low, high], &far| [far.min(low), far.max(high)]);
    assert!(high < 0.5 * 1.97 && high > 0.5 * 1.85 && low < 0.5 * 1.4, "{low} to {high}");
}

#[test]
fn constrained_tip_is_not_slim() {
    let mut plant = trunk(3, false);
    edit(&mut plant, &[(1, 0.8), (3, 0.2)], None);
    let mesh = bark_of(&plant, &style(0.1));
    // Halved and halved again.
    // Some of what is lost at a node is lost within a radius or two.
    assert!((0.2..0.215).contains(&girth_at(&mesh, 2.0)));
    assert!((girth_at(&mesh, 3.0) - 0.1).abs() < 1e-3);
}
