//! Few colours in the place of many, for formats in which a surface has one: median cuts, then k-means.

use glam::Vec3;

use crate::colour::encoded;

/// Steps of a channel in which colours are counted.
const STEPS: usize = 64;
/// Colours that lie nearer together than this along each channel, in steps of 256, are not told apart.
const ALIKE: f32 = 6.0;

/// How often colours are moved to the middle of those that they stand for.
const ROUNDS: usize = 6;

/// Counts colours as they come, in as much room as ever.
pub(crate) struct Tally {
    cells: Vec<Cell>,
}

#[derive(Clone, Copy, Default)]
struct Cell {
    /// Of the colours in it, linear.
    sum: Vec3,
    count: u32,
}

/// Colours that stand for all that were counted.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Palette {
    /// Linear.
    pub colours: Vec<Vec3>,
    /// Which of them each cell has.
    nearest: Vec<u8>,
}

impl Tally {
    pub(crate) fn new() -> Self {
        Self { cells: vec![Cell::default(); STEPS * STEPS * STEPS] }
    }

    pub(crate) fn add(&mut self, colour: Vec3) {
        let cell = &mut self.cells[cell_of(colour)];
        cell.sum += colour;
        cell.count += 1;
    }

    /// At most so many colours, up to 256; none where nothing was counted.
    pub(crate) fn palette(&self, most: usize) -> Palette {
        let all: Vec<usize> = (0..self.cells.len()).filter(|&cell| self.cells[cell].count > 0).collect();
        let mut boxes = Vec::new();
        if !all.is_empty() {
            boxes.push(all);
        }
        while boxes.len() < most {
            let widest = |at: &usize| (self.spread(&boxes[*at]).1, std::cmp::Reverse(*at));
            let by_spread = |a: &usize, b: &usize| {
                let (a, b) = (widest(a), widest(b));
                a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
            };
            let Some(at) = (0..boxes.len()).max_by(by_spread) else { break };
            let (channel, _) = self.spread(&boxes[at]);
            let Some(rest) = self.halve(&mut boxes[at], channel) else { break };
            boxes.push(rest);
        }
        let mut colours: Vec<Vec3> = boxes.iter().map(|cells| self.mean(cells)).collect();
        // Cuts go through what is alike: each cell goes to the colour it is nearest to, and each colour to their middle.
        let all = boxes.concat();
        let mut nearest = vec![0; self.cells.len()];
        for _ in 0..ROUNDS {
            let mut groups = vec![Vec::new(); colours.len()];
            for &cell in &all {
                groups[self.nearest(cell, &colours)].push(cell);
            }
            groups.retain(|cells| !cells.is_empty());
            colours = groups.iter().map(|cells| self.mean(cells)).collect();
        }
        // From dark to bright: where they lie side by side, neighbours are alike.
        colours.sort_by(|a, b| a.element_sum().total_cmp(&b.element_sum()));
        for &cell in &all {
            nearest[cell] = self.nearest(cell, &colours) as u8;
        }
        Palette { colours, nearest }
    }

    /// Which of some colours is nearest to the mean of a cell, as an eye sees them.
    fn nearest(&self, cell: usize, colours: &[Vec3]) -> usize {
        let seen = |colour: Vec3| Vec3::from_array(encoded(colour).map(f32::from));
        let own = seen(self.cells[cell].sum / self.cells[cell].count as f32);
        let away = |at: &usize| own.distance_squared(seen(colours[*at]));
        (0..colours.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }

    /// The mean of the colours of cells.
    fn mean(&self, cells: &[usize]) -> Vec3 {
        let sum: Vec3 = cells.iter().map(|&cell| self.cells[cell].sum).sum();
        let count: u32 = cells.iter().map(|&cell| self.cells[cell].count).sum();
        sum / count as f32
    }

    /// The channel along which the colours of cells lie farthest apart, and how far, weighted by how many there are.
    fn spread(&self, cells: &[usize]) -> (usize, f32) {
        let mut widest = (0, 0.0);
        for channel in 0..3 {
            let places =
                || cells.iter().map(|&cell| (self.place(cell, channel), self.cells[cell].count as f32));
            let count: f32 = places().map(|(_, count)| count).sum();
            let mean = places().map(|(place, count)| place * count).sum::<f32>() / count;
            let squares: f32 = places().map(|(place, count)| count * (place - mean) * (place - mean)).sum();
            let [low, high] = places()
                .fold([f32::MAX, f32::MIN], |[low, high], (place, _)| [low.min(place), high.max(place)]);
            if high - low > ALIKE && squares > widest.1 {
                widest = (channel, squares);
            }
        }
        widest
    }

    /// Takes the cells above the mean of a channel out of a box; none where all are alike.
    fn halve(&self, cells: &mut Vec<usize>, channel: usize) -> Option<Vec<usize>> {
        let count: f32 = cells.iter().map(|&cell| self.cells[cell].count as f32).sum();
        let sum: f32 =
            cells.iter().map(|&cell| self.place(cell, channel) * self.cells[cell].count as f32).sum();
        let (low, high): (Vec<usize>, Vec<usize>) =
            cells.iter().partition(|&&cell| self.place(cell, channel) <= sum / count);
        if self.spread(cells).1 == 0.0 || low.is_empty() || high.is_empty() {
            return None;
        }
        *cells = low;
        Some(high)
    }

    /// The mean of a cell's colours in one channel, in 256 steps as an eye sees them.
    fn place(&self, cell: usize, channel: usize) -> f32 {
        let Cell { sum, count } = self.cells[cell];
        f32::from(encoded(sum / count as f32)[channel])
    }
}

impl Palette {
    /// Which of its colours stands for one that was counted.
    pub(crate) fn of(&self, colour: Vec3) -> usize {
        usize::from(self.nearest[cell_of(colour)])
    }
}

fn cell_of(colour: Vec3) -> usize {
    let [r, g, b] = encoded(colour).map(|channel| usize::from(channel) * STEPS / 256);
    (r * STEPS + g) * STEPS + b
}

#[cfg(test)]
mod tests {
    use super::*;

    fn palette(colours: &[Vec3], most: usize) -> Palette {
        let mut tally = Tally::new();
        colours.iter().for_each(|&colour| tally.add(colour));
        tally.palette(most)
    }

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let colours = [Vec3::new(0.1, 0.3, 0.05), Vec3::new(0.6, 0.2, 0.05), Vec3::new(0.3, 0.3, 0.02)];
        let all: Vec<Vec3> = colours.iter().copied().cycle().take(90).collect();
        let palette = palette(&all, 8);
        assert_eq!(palette.colours.len(), 3);
        for colour in colours {
            assert!(palette.colours[palette.of(colour)].distance(colour) < 1e-5);
        }
    }

    #[test]
    fn colours_that_nobody_tells_apart_are_one() {
        let palette = palette(&[Vec3::new(0.2, 0.4, 0.1), Vec3::new(0.201, 0.4, 0.1)], 8);
        assert_eq!(palette.colours.len(), 1);
    }

    #[test]
    fn many_colours_are_cut_where_they_spread_most() {
        let ramp: Vec<Vec3> = (0..500).map(|i| Vec3::new(0.05, 0.1 + 0.0016 * i as f32, 0.02)).collect();
        let one = palette(&ramp, 1);
        let six = palette(&ramp, 6);
        assert_eq!((one.colours.len(), six.colours.len()), (1, 6));
        let worst = |palette: &Palette| {
            ramp.iter().map(|&c| palette.colours[palette.of(c)].distance(c)).fold(0.0, f32::max)
        };
        assert!(worst(&six) < 0.3 * worst(&one), "{} {}", worst(&six), worst(&one));
    }

    #[test]
    fn nothing_has_no_colours() {
        assert_eq!(palette(&[], 6).colours, []);
    }
}
