//! What a file that leaves is called (RFC 6266).

/// The most characters of a name, without its ending: some file systems take 255 bytes.
const LONGEST: usize = 60;
/// Characters that some system takes for something else than a part of a name.
const MISLEADING: &[char] = &['/', '\\', ':', '*', '?', '"', '<', '>', '|'];
/// What a file is called whose tree has no name, or none that a file could have.
const NAMELESS: &str = "tree";

/// `Content-Disposition` of a file that is kept, called as its tree is.
pub(super) fn attachment(tree: &str, ending: &str) -> String {
    disposition("attachment", tree, ending)
}

/// The same of a page that is shown.
pub(super) fn inline(tree: &str, ending: &str) -> String {
    disposition("inline", tree, ending)
}

fn disposition(kind: &str, tree: &str, ending: &str) -> String {
    let name = format!("{}.{ending}", plain(tree, |c| c));
    let fallback = format!("{}.{ending}", plain(tree, |c| if c.is_ascii() { c } else { '_' }));
    let said = format!("{kind}; filename=\"{fallback}\"");
    if name == fallback { said } else { format!("{said}; filename*=UTF-8''{}", encoded(&name)) }
}

/// A name without what is no part of one: no way to another folder, nothing that cannot be seen.
fn plain(tree: &str, seen_as: impl Fn(char) -> char) -> String {
    let shown = |c: char| if MISLEADING.contains(&c) || !is_seen(c) { ' ' } else { seen_as(c) };
    let words: String = tree.chars().map(shown).collect();
    let name = words.split_whitespace().collect::<Vec<_>>().join(" ");
    let name: String = name.trim_matches(['.', ' ']).chars().take(LONGEST).collect();
    let name = name.trim_matches(['.', ' ']);
    let says_something = name.chars().any(char::is_alphanumeric);
    if says_something { name.to_owned() } else { NAMELESS.to_owned() }
}

/// Whether a character shows, and turns nothing around.
fn is_seen(c: char) -> bool {
    let turns =
        matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
    !c.is_control() && !turns
}

/// As RFC 8187 writes text in a header.
fn encoded(name: &str) -> String {
    let byte = |byte: u8| match byte {
        b'0'..=b'9' | b'A'..=b'Z' | b'a'..=b'z' | b'-' | b'.' | b'_' | b'~' => char::from(byte).to_string(),
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(byte).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ex5_a_file_is_called_as_its_tree() {
        for (tree, expected) in [
            ("Oak", "filename=\"Oak.glb\""),
            ("Old oak, no. 5", "filename=\"Old oak, no. 5.glb\""),
            ("Überhälter", "filename=\"_berh_lter.glb\"; filename*=UTF-8''%C3%9Cberh%C3%A4lter.glb"),
            ("松", "filename=\"tree.glb\"; filename*=UTF-8''%E6%9D%BE.glb"),
            ("a\"; filename=\"b", "filename=\"a ; filename= b.glb\""),
            ("../../etc/passwd", "filename=\"etc passwd.glb\""),
            ("C:\\oak\r\nX-Evil: 1", "filename=\"C oak X-Evil 1.glb\""),
            (".hidden.", "filename=\"hidden.glb\""),
            ("oak\u{202e}bpj", "filename=\"oak bpj.glb\""),
            ("100 % oak", "filename=\"100 % oak.glb\""),
        ] {
            assert_eq!(attachment(tree, "glb"), format!("attachment; {expected}"), "{tree:?}");
        }
        for nameless in ["", " ", "...", "/", "\u{1}", "\u{202e}", "🌳"] {
            let said = attachment(nameless, "csv");
            assert!(said.starts_with("attachment; filename=\"tree.csv\""), "{nameless:?}: {said}");
        }
        let long = attachment(&"oak ".repeat(500), "glb");
        assert!(long.len() < 100, "{long}");
        assert_eq!(inline("Oak", "html"), "inline; filename=\"Oak.html\"");
    }

    #[test]
    fn ex5_nothing_but_a_name_stands_in_the_header() {
        for c in (0..0x3000).filter_map(char::from_u32) {
            let said = attachment(&format!("a{c}b"), "glb");
            assert!(said.bytes().all(|byte| (0x20..0x7f).contains(&byte)), "{c:?}: {said}");
            let name = said.split('"').nth(1).unwrap();
            assert!(!name.contains(['/', '\\']), "{c:?}: {said}");
            assert_eq!(said.matches('"').count(), 2, "{c:?}: {said}");
        }
    }
}
