//! Draws the templates, or designs in files, as pictures to look at: `portraits FOLDER [FILE…]`.
//!
//! Each picture has the front and the side of the tree, wood by its radii and leaves as dots.
#![allow(
    clippy::disallowed_methods,
    reason = "a picture need not be the same to the last bit on every machine"
)]

use std::{error::Error, fs, io::BufWriter, path::Path};

use espalier_design::{Design, Generated, Generator, Key, MAX_INTERNODES, TEMPLATES};
use glam::{Vec2, Vec3};

const SIDE: usize = 900;
const PAPER: [u8; 3] = [246, 242, 232];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("a folder is needed")?;
    let mut designs = Vec::new();
    for file in arguments {
        let design =
            Design::from_json(&fs::read_to_string(&file)?).map_err(|unread| format!("{file}: {unread:?}"))?;
        let name = Path::new(&file).file_stem().map(|name| name.to_string_lossy().into_owned());
        designs.push((name.unwrap_or_default(), design));
    }
    if designs.is_empty() {
        designs.extend(TEMPLATES.iter().map(|template| (template.name.to_owned(), template.design())));
    }
    for (name, design) in designs {
        let generated = Generator::default().generate(&design, MAX_INTERNODES);
        println!(
            "{name}: {} values, {} branches, {} axes and {} internodes; {:?}, {} outside",
            design.graph().values(),
            design.root().count(),
            generated.placed.len(),
            generated.wood.nodes.len() - 1,
            generated.missing,
            generated.placed.iter().filter(|placed| placed.is_outside).count(),
        );
        picture(&generated, &Path::new(&folder).join(format!("{name}.png")))?;
    }
    Ok(())
}

struct Canvas(Vec<u8>);

impl Canvas {
    fn dot(&mut self, at: Vec2, radius: f32, colour: [f32; 3], cover: f32) {
        let radius = radius.max(0.6);
        let (low, high) = (at - Vec2::splat(radius + 1.0), at + Vec2::splat(radius + 1.0));
        for y in low.y.max(0.0) as usize..=(high.y.max(0.0) as usize).min(SIDE - 1) {
            for x in low.x.max(0.0) as usize..=(high.x.max(0.0) as usize).min(2 * SIDE - 1) {
                let off = Vec2::new(x as f32 + 0.5, y as f32 + 0.5).distance(at);
                let share = (radius + 0.5 - off).clamp(0.0, 1.0) * cover;
                for (part, &of) in colour.iter().enumerate() {
                    let byte = &mut self.0[(y * 2 * SIDE + x) * 3 + part];
                    *byte = (f32::from(*byte) * (1.0 - share) + of * share) as u8;
                }
            }
        }
    }
}

fn picture(generated: &Generated, file: &Path) -> Result<(), Box<dyn Error>> {
    let nodes = &generated.wood.nodes;
    let (mut low, mut high) = (Vec3::splat(f32::MAX), Vec3::splat(f32::MIN));
    for node in nodes {
        (low, high) = (low.min(node.end), high.max(node.end));
    }
    let size = (high - low).max_element() * 1.1 + 4.0;
    let scale = SIDE as f32 / size;
    let middle = (low + high) * 0.5;
    let mut canvas = Canvas(PAPER.repeat(2 * SIDE * SIDE));
    for (view, across, depth) in [(0, Vec3::X, Vec3::Z), (1, Vec3::NEG_Z, Vec3::X)] {
        let place = |at: Vec3| {
            let off = at - middle;
            Vec2::new(
                (view as f32 + 0.5) * SIDE as f32 + off.dot(across) * scale,
                (0.5 * SIDE as f32) - off.y * scale,
            )
        };
        let mut order: Vec<usize> = (0..nodes.len()).collect();
        order.sort_by(|&a, &b| nodes[a].end.dot(depth).total_cmp(&nodes[b].end.dot(depth)));
        for row in order {
            let node = &nodes[row];
            let Some(parent) = node.parent else { continue };
            let (from, to) = (nodes[parent as usize].end, node.end);
            let near = 0.5 + 0.5 * ((to - middle).dot(depth) / size + 0.5);
            let bark = [92.0 * near, 70.0 * near, 54.0 * near];
            let radius = node.radius.unwrap_or(0.05) * scale;
            let steps = (place(from).distance(place(to)) / radius.clamp(0.5, 3.0)).ceil().max(1.0) as usize;
            for step in 0..=steps {
                canvas.dot(place(from.lerp(to, step as f32 / steps as f32)), radius, bark, 1.0);
            }
            let placed = &generated.placed[node.axis as usize];
            let tint = placed.values.material(Key::Material).leaves;
            for leaf in 0..placed.leaves(generated.places[row]) as usize {
                // Leaves stand around the wood, each at an angle of its own.
                let angle = 2.4 * (leaf as f32 + row as f32);
                let aside =
                    Vec3::new(angle.cos(), 0.6, angle.sin()) * 0.7 * placed.values.scalar(Key::LeafSize);
                let at = from.lerp(to, (leaf as f32 + 0.5) / 8.0 % 1.0) + aside;
                let green = [70.0 * near * tint[0], 128.0 * near * tint[1], 58.0 * near * tint[2]];
                let size = 0.32 * scale * placed.values.scalar(Key::LeafSize);
                canvas.dot(place(at), size, green.map(|part| part.min(255.0)), 0.8);
            }
        }
    }
    let file = BufWriter::new(fs::File::create(file)?);
    let mut encoder = png::Encoder::new(file, 2 * SIDE as u32, SIDE as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&canvas.0)?;
    Ok(())
}
