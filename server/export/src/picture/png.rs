//! The PNG format, as much of it as pictures with a palette need (ISO/IEC 15948).

use std::io::Write;

use flate2::{Compression, Crc, write::ZlibEncoder};

const SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];
/// Eight bits a pixel, each an index into the palette; deflated, not interlaced.
const INDEXED: [u8; 5] = [8, 3, 0, 0, 0];

/// A PNG file of at most 256 colours.
pub(crate) fn indexed(width: usize, height: usize, colours: &[[u8; 3]], indices: &[u8]) -> Vec<u8> {
    let mut file = SIGNATURE.to_vec();
    let mut header = Vec::from((width as u32).to_be_bytes());
    header.extend((height as u32).to_be_bytes());
    header.extend(INDEXED);
    chunk(&mut file, *b"IHDR", &header);
    chunk(&mut file, *b"PLTE", colours.as_flattened());
    let mut rows = Vec::with_capacity(indices.len() + height);
    for row in indices.chunks_exact(width) {
        // Filters help smooth tones; indices have none.
        rows.push(0);
        rows.extend(row);
    }
    chunk(&mut file, *b"IDAT", &deflated(&rows));
    chunk(&mut file, *b"IEND", &[]);
    file
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    let written = encoder.write_all(bytes).and_then(|()| encoder.finish());
    written.unwrap_or_else(|error| unreachable!("memory takes every byte: {error}"))
}

fn chunk(file: &mut Vec<u8>, kind: [u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    file.extend(kind);
    file.extend(data);
    let mut crc = Crc::new();
    crc.update(&kind);
    crc.update(data);
    file.extend(crc.sum().to_be_bytes());
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::ZlibDecoder;

    use super::*;

    #[test]
    fn file_is_laid_out_as_the_standard_says() {
        let file = indexed(2, 2, &[[1, 2, 3], [250, 0, 9]], &[0, 1, 1, 0]);
        assert_eq!(&file[..16], b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR");
        assert_eq!(&file[16..29], [0, 0, 0, 2, 0, 0, 0, 2, 8, 3, 0, 0, 0]);
        assert_eq!(&file[33..47], b"\0\0\0\x06PLTE\x01\x02\x03\xfa\0\x09");
        // The check sum of an empty IEND is known from every PNG file there is.
        assert_eq!(&file[file.len() - 12..], b"\0\0\0\0IEND\xae\x42\x60\x82");
        let length = u32::from_be_bytes(file[51..55].try_into().unwrap()) as usize;
        let mut rows = Vec::new();
        ZlibDecoder::new(&file[59..59 + length]).read_to_end(&mut rows).unwrap();
        assert_eq!(rows, [0, 0, 1, 0, 1, 0]);
    }
}
