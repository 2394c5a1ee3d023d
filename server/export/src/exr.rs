//! Files in the OpenEXR format, as plain as they can be: red, green, blue and alpha in 16-bit floats, rows from the top,
//! nothing packed. Crates for the format bring a dozen others along, for all that is not done here.

/// What a file begins with, and its version.
const MAGIC: u32 = 20_000_630;
const VERSION: u32 = 2;
/// The type of 16-bit floats.
const HALF: u32 = 1;
const CHANNELS: usize = 4;

/// A file of pixels, row by row, each as the bits of its four numbers.
pub(crate) fn halves(width: usize, pixels: &[[u16; CHANNELS]]) -> Vec<u8> {
    let rows = pixels.chunks(width.max(1));
    let (right, below) = (width as u32 - 1, rows.len() as u32 - 1);
    let mut out = Vec::new();
    words(&mut out, &[MAGIC, VERSION]);
    // Channels stand in the order of their names, here and in each row.
    let mut channels = Vec::new();
    for name in *b"ABGR" {
        channels.extend([name, 0]);
        words(&mut channels, &[HALF, 0, 1, 1]);
    }
    channels.push(0);
    let window: Vec<u8> = [0, 0, right, below].into_iter().flat_map(u32::to_le_bytes).collect();
    attribute(&mut out, "channels", "chlist", &channels);
    attribute(&mut out, "compression", "compression", &[0]);
    attribute(&mut out, "dataWindow", "box2i", &window);
    attribute(&mut out, "displayWindow", "box2i", &window);
    attribute(&mut out, "lineOrder", "lineOrder", &[0]);
    attribute(&mut out, "pixelAspectRatio", "float", &1f32.to_le_bytes());
    attribute(&mut out, "screenWindowCenter", "v2f", &[0; 8]);
    attribute(&mut out, "screenWindowWidth", "float", &1f32.to_le_bytes());
    out.push(0);
    // Where each row begins: its number and its bytes stand before it.
    let size = width * CHANNELS * size_of::<u16>();
    let first = out.len() + rows.len() * size_of::<u64>();
    for row in 0..rows.len() {
        out.extend(((first + row * (size + 8)) as u64).to_le_bytes());
    }
    for (row, pixels) in rows.enumerate() {
        words(&mut out, &[row as u32, size as u32]);
        for channel in (0..CHANNELS).rev() {
            out.extend(pixels.iter().flat_map(|pixel| pixel[channel].to_le_bytes()));
        }
    }
    out
}

fn words(out: &mut Vec<u8>, words: &[u32]) {
    out.extend(words.iter().flat_map(|word| word.to_le_bytes()));
}

fn attribute(out: &mut Vec<u8>, name: &str, kind: &str, value: &[u8]) {
    for text in [name, kind] {
        out.extend(text.bytes());
        out.push(0);
    }
    words(out, &[value.len() as u32]);
    out.extend(value);
}
