//! Labels: letters as strokes of a pen, on a grid three to four wide and eight high.

use glam::{Vec2, Vec3};

use super::canvas::Canvas;

/// A letter's strokes, each a way through places of the grid: column, then row. The baseline is row 2, small
/// letters end at row 6 and capitals at row 8.
fn strokes(letter: char) -> Option<&'static str> {
    Some(match letter {
        'a' => "35 26 16 05 03 12 22 33|36 32",
        'b' => "08 02|05 16 26 35 33 22 12 03",
        'c' => "35 26 16 05 03 12 22 33",
        'd' => "38 32|35 26 16 05 03 12 22 33",
        'e' => "04 34 35 26 16 05 03 12 22 33",
        'f' => "28 18 17 12|06 26",
        'g' => "36 31 20 10 01|35 26 16 05 03 12 22 33",
        'h' => "08 02|05 16 26 35 32",
        'i' => "06 02|08 08",
        'j' => "16 11 00|18 18",
        'k' => "08 02|36 04 32",
        'l' => "08 02",
        'm' => "06 02|05 16 25 22|25 36 45 42",
        'n' => "06 02|05 16 26 35 32",
        'o' => "05 16 26 35 33 22 12 03 05",
        'p' => "06 00|05 16 26 35 33 22 12 03",
        'q' => "36 30|35 26 16 05 03 12 22 33",
        'r' => "06 02|05 16 26",
        's' => "35 26 16 05 14 24 33 22 12 03",
        't' => "18 13 22|06 26",
        'u' => "06 03 12 22 33|36 32",
        'v' => "06 22 46",
        'w' => "06 12 25 32 46",
        'x' => "06 32|36 02",
        'y' => "06 22|46 22 10 00",
        'z' => "06 36 02 32",
        'A' => "02 28 42|14 34",
        'B' => "02 08 28 37 36 25 05|25 34 33 22 02",
        'C' => "37 28 18 07 03 12 22 33",
        'D' => "02 08 28 37 33 22 02",
        'E' => "38 08 02 32|05 25",
        'F' => "38 08 02|05 25",
        'G' => "37 28 18 07 03 12 22 33 35 25",
        'H' => "08 02|38 32|05 35",
        'I' => "08 02",
        'J' => "28 23 12 03",
        'K' => "08 02|38 05 32",
        'L' => "08 02 32",
        'M' => "02 08 25 48 42",
        'N' => "02 08 32 38",
        'O' => "07 18 28 37 33 22 12 03 07",
        'P' => "02 08 28 37 36 25 05",
        'Q' => "07 18 28 37 33 22 12 03 07|24 32",
        'R' => "02 08 28 37 36 25 05|15 32",
        'S' => "37 28 18 07 06 15 25 34 33 22 12 03",
        'T' => "08 48|28 22",
        'U' => "08 03 12 22 33 38",
        'V' => "08 22 48",
        'W' => "08 12 25 32 48",
        'X' => "08 32|38 02",
        'Y' => "08 25 48|25 22",
        'Z' => "08 38 02 32",
        '0' => "07 18 28 37 33 22 12 03 07",
        '1' => "06 18 12",
        '2' => "07 18 28 37 36 02 32",
        '3' => "07 18 28 37 36 25 15|25 34 33 22 12 03",
        '4' => "28 04 34|26 22",
        '5' => "38 08 05 25 34 33 22 02",
        '6' => "28 18 06 03 12 22 33 34 25 15 04",
        '7' => "08 38 12",
        '8' => "15 06 07 18 28 37 36 25 15 04 03 12 22 33 34 25",
        '9' => "36 25 15 06 07 18 28 37 34 22 12",
        '-' => "04 24",
        '.' => "02 02",
        ',' => "02 01",
        '\'' | '’' => "08 07",
        '(' => "18 06 04 12",
        ')' => "08 16 14 02",
        '×' => "05 23|25 03",
        _ => return None,
    })
}

const BASELINE: f32 = 2.0;
const SPACE: f32 = 2.2;
const GAP: f32 = 1.5;

/// How a line of text is written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen {
    /// Pixels to a place of the grid.
    pub(crate) scale: f32,
    /// Pixels from edge to edge of a stroke.
    pub(crate) width: f32,
    pub(crate) colour: Vec3,
    /// Columns that a letter leans to the right for each row.
    pub(crate) slant: f32,
}

impl Pen {
    /// Writes a line whose middle is at `x` and whose baseline is at `y`. What it has no letter for is a gap.
    pub(crate) fn write_centred(&self, canvas: &mut Canvas, text: &str, x: f32, y: f32) {
        let (lines, width) = laid_out(text);
        let start = x - 0.5 * width * self.scale;
        let at = |p: Vec2| {
            let row = p.y - BASELINE;
            Vec2::new(start + self.scale * (p.x + self.slant * row), y - self.scale * row)
        };
        for line in lines {
            let line: Vec<Vec2> = rounded(&line).into_iter().map(at).collect();
            self.draw(canvas, &line);
        }
    }

    fn draw(&self, canvas: &mut Canvas, line: &[Vec2]) {
        let margin = Vec2::splat(self.width + 1.0);
        let (low, high) =
            line.iter().fold((line[0], line[0]), |(low, high), &place| (low.min(place), high.max(place)));
        let (low, high) = (low - margin, high + margin);
        for y in low.y as i32..=high.y as i32 {
            for x in low.x as i32..=high.x as i32 {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let off = line.windows(2).map(|ends| distance(at, ends[0], ends[1])).fold(f32::MAX, f32::min);
                let cover = (0.5 * self.width + 0.5 - off).clamp(0.0, 1.0);
                canvas.blend(x, y, self.colour, cover);
            }
        }
    }
}

/// The strokes of a line of text on one grid, and its width.
fn laid_out(text: &str) -> (Vec<Vec<Vec2>>, f32) {
    let (mut lines, mut x) = (Vec::new(), 0.0);
    for letter in text.chars() {
        let Some(strokes) = strokes(letter) else {
            x += SPACE;
            continue;
        };
        let mut right: f32 = 0.0;
        for stroke in strokes.split('|') {
            let places = stroke.split(' ').map(|place| {
                let digits = place.as_bytes();
                Vec2::new(f32::from(digits[0] - b'0'), f32::from(digits[1] - b'0'))
            });
            let line: Vec<Vec2> = places.collect();
            right = line.iter().fold(right, |right, place| right.max(place.x));
            lines.push(line.into_iter().map(|place| place + Vec2::X * x).collect());
        }
        x += right + GAP;
    }
    (lines, (x - GAP).max(0.0))
}

/// Cuts the corners of gentle turns, which stand for bows; sharp ones are meant.
fn rounded(line: &[Vec2]) -> Vec<Vec2> {
    let mut round = vec![line[0]];
    for corner in line.windows(3) {
        let (into, out) = (corner[1] - corner[0], corner[2] - corner[1]);
        if into.normalize_or_zero().dot(out.normalize_or_zero()) > 0.3 {
            let cut = 0.3 * into.length().min(out.length());
            round.push(corner[1] - into.normalize_or_zero() * cut);
            round.push(corner[1] + out.normalize_or_zero() * cut);
        } else {
            round.push(corner[1]);
        }
    }
    round.push(line[line.len() - 1]);
    round
}

fn distance(at: Vec2, from: Vec2, to: Vec2) -> f32 {
    let along = to - from;
    let t = if along == Vec2::ZERO { 0.0 } else { (at - from).dot(along) / along.length_squared() };
    at.distance(from + along * t.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_keeps_to_the_grid() {
        for letter in ('a'..='z').chain('A'..='Z').chain('0'..='9') {
            let (lines, width) = laid_out(&letter.to_string());
            assert!(!lines.is_empty() && (0.0..=4.0).contains(&width), "{letter}");
            assert!(lines.iter().flatten().all(|p| p.x <= 4.0 && p.y <= 8.0), "{letter}");
        }
    }

    #[test]
    fn text_is_centred_on_its_place() {
        let mut canvas = Canvas::new(60, 24, Vec3::ONE);
        let pen = Pen { scale: 2.0, width: 1.5, colour: Vec3::ZERO, slant: 0.0 };
        pen.write_centred(&mut canvas, "oxo", 30.0, 16.0);
        let inked = |x: usize| (0..24).any(|y| canvas.get(x, y).x < 0.5);
        let columns: Vec<usize> = (0..60).filter(|&x| inked(x)).collect();
        let (first, last) = (columns[0], columns[columns.len() - 1]);
        assert!((58..=60).contains(&(first + last)) && last - first > 20, "{first} to {last}");
    }
}
