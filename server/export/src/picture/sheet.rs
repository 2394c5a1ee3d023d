//! A contact sheet: pictures in rows, each with its label.

use super::{canvas::Canvas, lettering::Pen, scene::SKY};
use crate::colour::linear;

/// One picture of a sheet.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The picture; all of one sheet have the same size.
    pub picture: Canvas,
    /// First line of the label.
    pub title: String,
    /// Second line, in italics.
    pub subtitle: String,
}

const LABEL_HEIGHT: usize = 54;
const GAP: usize = 10;

/// Puts pictures in rows of so many. Without pictures the sheet is empty.
pub fn sheet(cells: &[Cell], columns: usize) -> Canvas {
    let Some(first) = cells.first() else { return Canvas::new(0, 0, linear(SKY)) };
    let (width, height) = (first.picture.width(), first.picture.height());
    let columns = columns.clamp(1, cells.len());
    let rows = cells.len().div_ceil(columns);
    let (across, down) = (width + GAP, height + LABEL_HEIGHT);
    let mut canvas = Canvas::new(columns * across + GAP, rows * down + GAP, linear(SKY));
    let title = Pen { scale: 2.1, width: 1.9, colour: linear([52, 56, 46]), slant: 0.0 };
    let subtitle = Pen { scale: 1.6, width: 1.2, colour: linear([112, 116, 102]), slant: 0.22 };
    for (index, cell) in cells.iter().enumerate() {
        let (x, y) = (GAP + index % columns * across, GAP + index / columns * down);
        canvas.paste(&cell.picture, x, y);
        let (middle, below) = (x as f32 + 0.5 * width as f32, (y + height) as f32);
        title.write_centred(&mut canvas, &cell.title, middle, below + 17.0);
        subtitle.write_centred(&mut canvas, &cell.subtitle, middle, below + 36.0);
    }
    canvas
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn pictures_stand_in_rows_with_labels() {
        let cell = |grey: f32| Cell {
            picture: Canvas::new(80, 40, Vec3::splat(grey)),
            title: "Oak".into(),
            subtitle: String::new(),
        };
        let sheet = sheet(&[cell(0.1), cell(0.2), cell(0.3)], 2);
        assert_eq!((sheet.width(), sheet.height()), (2 * 90 + 10, 2 * 94 + 10));
        assert_eq!([(10, 10), (100, 10), (10, 104)].map(|(x, y)| sheet.get(x, y).x), [0.1, 0.2, 0.3]);
        let label = (10..90).flat_map(|x| (50..104).map(move |y| (x, y)));
        assert!(label.clone().any(|(x, y)| sheet.get(x, y).x < 0.2), "the label is written");
    }
}
