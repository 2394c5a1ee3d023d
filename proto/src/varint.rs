//! Unsigned LEB128 integers and the zigzag mapping for signed ones, as frames use them (`FR3`).

/// Appends `value` in 1 to 5 bytes.
pub fn write(out: &mut Vec<u8>, mut value: u32) {
    while value >= 0x80 {
        out.push((value as u8 & 0x7f) | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

/// How many bytes [`write()`] appends.
pub fn length(value: u32) -> usize {
    (value | 1).ilog2() as usize / 7 + 1
}

/// Reads one value and advances `bytes`; `None` if it is cut short or larger than 32 bits.
pub fn read(bytes: &mut &[u8]) -> Option<u32> {
    let mut value = 0u32;
    for shift in (0..35).step_by(7) {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        let part = u32::from(byte & 0x7f);
        if shift == 28 && part > 0x0f {
            return None;
        }
        value |= part << shift;
        if byte & 0x80 == 0 {
            return Some(value);
        }
    }
    None
}

/// 0, -1, 1, -2 … to 0, 1, 2, 3 …
pub fn zigzag(value: i32) -> u32 {
    ((value << 1) ^ (value >> 31)) as u32
}

/// The inverse of [`zigzag`].
pub fn unzigzag(value: u32) -> i32 {
    ((value >> 1) as i32) ^ -((value & 1) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn read_undoes_write(value: u32) {
            let mut out = Vec::new();
            write(&mut out, value);
            prop_assert_eq!(read(&mut out.as_slice()), Some(value));
        }

        #[test]
        fn unzigzag_undoes_zigzag(value: i32) {
            prop_assert_eq!(unzigzag(zigzag(value)), value);
        }
    }

    #[test]
    fn cut_short_or_too_large_is_none() {
        assert_eq!(read(&mut [0x80u8].as_slice()), None);
        assert_eq!(read(&mut [0xff, 0xff, 0xff, 0xff, 0x1f].as_slice()), None);
        assert_eq!(read(&mut [0xff, 0xff, 0xff, 0xff, 0x0f].as_slice()), Some(u32::MAX));
    }
}
