//! The header `Range`: which part of a file is asked for (`RG1`).

use std::ops::Range;

/// What is asked for begins behind the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Beyond;

/// The part of a file of so many bytes that a `Range` asks for. Several parts and other units ask for the whole, which
/// RFC 9110 (14.2) leaves to the server.
///
/// # Errors
///
/// No byte of it is in the file.
pub fn part(range: &str, length: u64) -> Result<Option<Range<u64>>, Beyond> {
    let range = range.split_once('=').filter(|(unit, _)| unit.eq_ignore_ascii_case("bytes"));
    let Some((first, last)) = range.and_then(|(_, range)| range.split_once('-')) else { return Ok(None) };
    // A number of any length is one; no file is as long as the greatest that there is room for.
    let number = |text: &str| {
        let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        is_number.then(|| text.parse::<u64>().unwrap_or(u64::MAX))
    };
    let part = match (first.trim(), last.trim()) {
        ("", last) => number(last).map(|last| length.saturating_sub(last)..length),
        (first, "") => number(first).map(|first| first..length),
        (first, last) => number(first)
            .zip(number(last))
            .filter(|(first, last)| first <= last)
            .map(|(first, last)| first..length.min(last.saturating_add(1))),
    };
    if part.as_ref().is_some_and(Range::is_empty) { Err(Beyond) } else { Ok(part) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rg1_a_part_is_told_by_its_ends_or_by_one_of_them() {
        for (range, wanted) in [
            ("bytes=0-3", Some(0..4)),
            ("bytes=4-", Some(4..10)),
            ("bytes=9-99", Some(9..10)),
            ("bytes=-3", Some(7..10)),
            ("bytes=-30", Some(0..10)),
            ("Bytes=0-3", Some(0..4)),
            ("bytes=5-4", None),
            ("bytes=+1-3", None),
            ("bytes=1-2,4-5", None),
            ("bytes=x-", None),
            ("lines=1-2", None),
            ("bytes", None),
        ] {
            assert_eq!(part(range, 10), Ok(wanted), "{range}");
        }
        for range in ["bytes=10-", "bytes=10-12", "bytes=-0", "bytes=99999999999999999999-"] {
            assert_eq!(part(range, 10), Err(Beyond), "{range}");
        }
    }
}
