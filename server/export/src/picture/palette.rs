//! The 256 colours that suit a picture best (Heckbert's median cut).

/// Colours are counted with so many bits of each channel.
const BITS: u32 = 6;
const CELLS: usize = 1 << (3 * BITS);
const MOST_COLOURS: usize = 256;

/// What falls into one cell of the colour cube.
#[derive(Clone, Copy, Default)]
struct Cell {
    sum: [u64; 3],
    count: u64,
}

impl Cell {
    fn mean(&self) -> [u8; 3] {
        self.sum.map(|sum| ((sum + self.count / 2) / self.count.max(1)) as u8)
    }
}

fn cell_of(pixel: [u8; 3]) -> usize {
    pixel.iter().fold(0, |index, &c| index << BITS | usize::from(c >> (8 - BITS)))
}

/// At most 256 colours, and for each pixel of a picture `width` wide which of them. What a pixel loses is handed
/// on to its neighbours (Floyd and Steinberg), so that soft shades stay soft.
pub(crate) fn reduce(width: usize, pixels: &[[u8; 3]]) -> (Vec<[u8; 3]>, Vec<u8>) {
    let mut cells = vec![Cell::default(); CELLS];
    for &pixel in pixels {
        let cell = &mut cells[cell_of(pixel)];
        cell.count += 1;
        for (sum, c) in cell.sum.iter_mut().zip(pixel) {
            *sum += u64::from(c);
        }
    }
    let colours = chosen(&cells);
    // Which colour is nearest is found out once for each cell.
    let mut nearest: Vec<Option<u8>> = vec![None; CELLS];
    let mut indices = Vec::with_capacity(pixels.len());
    let (mut here, mut below) = (vec![[0; 3]; width + 2], vec![[0; 3]; width + 2]);
    for row in pixels.chunks(width.max(1)) {
        for (x, pixel) in row.iter().enumerate() {
            let wanted: [i32; 3] = std::array::from_fn(|c| i32::from(pixel[c]) + here[x + 1][c] / 16);
            let cell = cell_of(wanted.map(|c| c.clamp(0, 255) as u8));
            let index = *nearest[cell].get_or_insert_with(|| index_of_nearest(&colours, wanted));
            indices.push(index);
            for c in 0..3 {
                // Errors that grow beyond a few shades would leave specks.
                let lost = (wanted[c] - i32::from(colours[usize::from(index)][c])).clamp(-12, 12);
                here[x + 2][c] += 7 * lost;
                below[x][c] += 3 * lost;
                below[x + 1][c] += 5 * lost;
                below[x + 2][c] += lost;
            }
        }
        std::mem::swap(&mut here, &mut below);
        below.fill([0; 3]);
    }
    (colours, indices)
}

fn index_of_nearest(colours: &[[u8; 3]], wanted: [i32; 3]) -> u8 {
    let distance = |colour: &[u8; 3]| (0..3).map(|c| (wanted[c] - i32::from(colour[c])).pow(2)).sum::<i32>();
    (0..colours.len()).min_by_key(|&index| distance(&colours[index])).unwrap_or(0) as u8
}

/// The means of the boxes that the median cut ends with.
fn chosen(cells: &[Cell]) -> Vec<[u8; 3]> {
    let mut boxes = vec![(0..CELLS).filter(|&cell| cells[cell].count > 0).collect::<Vec<_>>()];
    while boxes.len() < MOST_COLOURS {
        // Ties go to the later box; which one it is must only be the same every time.
        let widest = (0..boxes.len()).map(|i| (spread(&boxes[i], cells), i)).max();
        let Some(((_, channel), index)) = widest.filter(|&((gain, _), _)| gain > 0) else { break };
        let upper = split(&mut boxes[index], cells, channel);
        boxes.push(upper);
    }
    let mean = |members: &Vec<usize>| {
        let mut all = Cell::default();
        for &member in members {
            all.count += cells[member].count;
            for (sum, part) in all.sum.iter_mut().zip(cells[member].sum) {
                *sum += part;
            }
        }
        all.mean()
    };
    boxes.iter().map(mean).collect()
}

/// How much a box would gain from a cut, and across which channel.
fn spread(members: &[usize], cells: &[Cell]) -> (u64, usize) {
    let count: u64 = members.iter().map(|&member| cells[member].count).sum();
    let range = |channel: usize| {
        let values = || members.iter().map(|&member| cells[member].mean()[channel]);
        u64::from(values().max().unwrap_or(0) - values().min().unwrap_or(0))
    };
    let (range, channel) = (0..3).map(|channel| (range(channel), channel)).max().unwrap_or((0, 0));
    // The root keeps a large plain background from taking all the colours.
    (if members.len() > 1 { range * range * (count.isqrt() + 1) } else { 0 }, channel)
}

/// Takes the upper half of a box out of it.
fn split(members: &mut Vec<usize>, cells: &[Cell], channel: usize) -> Vec<usize> {
    members.sort_by_key(|&member| (cells[member].mean()[channel], member));
    let total: u64 = members.iter().map(|&member| cells[member].count).sum();
    let mut below = 0;
    let middle = members.iter().position(|&member| {
        below += cells[member].count;
        2 * below >= total
    });
    let middle = (middle.unwrap_or(0) + 1).clamp(1, members.len() - 1);
    members.split_off(middle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let pixels = [[255, 0, 0], [0, 0, 255], [255, 0, 0], [250, 250, 250]];
        let (colours, indices) = reduce(2, &pixels);
        assert_eq!(colours.len(), 3);
        for (pixel, index) in pixels.iter().zip(indices) {
            assert_eq!(colours[usize::from(index)], *pixel);
        }
    }

    #[test]
    fn many_colours_become_near_ones() {
        let pixels: Vec<[u8; 3]> =
            (0..40_000u32).map(|i| [(i % 200) as u8, (i / 200) as u8, (i * 7 % 256) as u8]).collect();
        let (colours, indices) = reduce(200, &pixels);
        assert_eq!(colours.len(), 256);
        let worst = pixels.iter().zip(indices).map(|(pixel, index)| {
            let near = colours[usize::from(index)];
            (0..3).map(|c| pixel[c].abs_diff(near[c])).max().unwrap()
        });
        assert!(worst.max().unwrap() < 64);
    }
}
