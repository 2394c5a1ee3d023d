//! Files in the PNG format (ISO/IEC 15948).

use std::{
    cell::RefCell,
    io::{self, Write},
};

use crate::{ExportError, Sink, picture::Canvas};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};

/// A file of at most 256 colours, and for each pixel which of them.
pub(crate) fn indexed(width: usize, height: usize, colours: &[[u8; 3]], indices: &[u8]) -> Vec<u8> {
    // Filters help smooth tones; indices have none.
    file([width, height], ColorType::Indexed, Filter::NoFilter, Some(colours.as_flattened()), indices)
}

/// A file with a byte for each channel: one is grey, three are red, green, blue; the fourth is cover.
pub(crate) fn picture<const CHANNELS: usize>(size: [usize; 2], pixels: &[[u8; CHANNELS]]) -> Vec<u8> {
    let colours = match CHANNELS {
        1 => ColorType::Grayscale,
        4 => ColorType::Rgba,
        _ => ColorType::Rgb,
    };
    file(size, colours, Filter::Adaptive, None, pixels.as_flattened())
}

/// A file of red, green, blue and cover in a byte each, as they are.
pub(crate) fn rgba(size: [usize; 2], pixels: &[[u8; 4]]) -> Vec<u8> {
    file(size, ColorType::Rgba, Filter::NoFilter, None, pixels.as_flattened())
}

/// A file of pictures that follow one another for ever, `seconds` for all `count` of them. Each is drawn when it is its
/// turn, and asks time and again whether to go on.
pub(crate) fn animated(
    [width, height]: [usize; 2],
    [seconds, count]: [u16; 2],
    mut draw: impl FnMut(u16, &mut dyn FnMut() -> io::Result<()>) -> io::Result<Canvas>,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let out = RefCell::new(out);
    let mut write = || -> Result<(), EncodingError> {
        let mut encoder = Encoder::new(Shared(&out), width as u32, height as u32);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Balanced);
        encoder.set_filter(Filter::Adaptive);
        encoder.set_animated(u32::from(count), 0)?;
        encoder.set_frame_delay(seconds, count)?;
        let mut writer = encoder.write_header()?;
        for number in 0..count {
            // Whoever gives the file up ends it here.
            let picture = draw(number, &mut || out.borrow_mut().flush())?;
            writer.write_image_data(picture.pixels().as_flattened())?;
        }
        writer.finish()
    };
    write().map_err(|error| match error {
        EncodingError::IoError(error) => error.into(),
        _ => ExportError::TooLarge,
    })
}

/// A file that its writer flushes beside the encoder, which has it.
struct Shared<'a, 'b>(&'a RefCell<&'b mut dyn Sink>);

impl Write for Shared<'_, '_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

fn file(
    size: [usize; 2],
    colours: ColorType,
    filter: Filter,
    palette: Option<&[u8]>,
    data: &[u8],
) -> Vec<u8> {
    let write = || -> Result<Vec<u8>, EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, size[0] as u32, size[1] as u32);
        encoder.set_color(colours);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Balanced);
        encoder.set_filter(filter);
        if let Some(palette) = palette {
            encoder.set_palette(palette);
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(data)?;
        writer.finish()?;
        Ok(bytes)
    };
    write().unwrap_or_else(|error| unreachable!("memory takes every byte of a whole picture: {error}"))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use png::Decoder;

    use super::*;

    #[test]
    fn pixels_are_read_back() {
        let pixels: Vec<[u8; 4]> = (0..64u8).map(|i| [i, 255 - i, 3 * i, 7]).collect();
        let file = picture([8, 8], &pixels);
        let mut reader = Decoder::new(Cursor::new(&file)).read_info().expect("it is a PNG file");
        let mut read = vec![0; 256];
        let info = reader.next_frame(&mut read).expect("it is whole");
        assert_eq!((info.width, info.height, info.color_type), (8, 8, ColorType::Rgba));
        assert_eq!(read, pixels.as_flattened());
    }

    #[test]
    fn indices_are_read_back_as_colours() {
        let file = indexed(2, 2, &[[1, 2, 3], [250, 0, 9]], &[0, 1, 1, 0]);
        let mut decoder = Decoder::new(Cursor::new(&file));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("it is a PNG file");
        let mut read = vec![0; 12];
        reader.next_frame(&mut read).expect("it is whole");
        assert_eq!(read, [1, 2, 3, 250, 0, 9, 250, 0, 9, 1, 2, 3]);
    }
}
