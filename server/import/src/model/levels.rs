//! Parts that show the same thing more coarsely, or stand for it in collisions. As programs name them (`Oak_LOD1`,
//! `UCX_Oak_01`), they are told by their names.

/// The level of detail that a name says, 0 the finest.
pub(super) fn level(name: &str) -> Option<u32> {
    name.match_indices("_LOD").find_map(|(at, mark)| {
        let rest = &name[at + mark.len()..];
        let end = rest.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(rest.len());
        rest[..end].parse().ok()
    })
}

/// Whether it is a hull for collisions.
pub(super) fn is_hull(name: &str) -> bool {
    ["UCX_", "UBX_", "USP_", "UCP_"].iter().any(|mark| name.starts_with(mark))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_levels() {
        assert_eq!(level("Oak_LOD2"), Some(2));
        assert_eq!(level("Oak_LOD0_Leaves"), Some(0));
        assert_eq!(level("Oak_LOD10"), Some(10));
        for plain in ["Oak", "Oak_LOD", "LOD1", "Oak_LODX", "Oak_LOD99999999999"] {
            assert_eq!(level(plain), None, "{plain}");
        }
        assert!(is_hull("UCX_Oak_01") && !is_hull("Oak_UCX_01"));
    }
}
