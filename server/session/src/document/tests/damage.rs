//! Bytes that are no document, not any more, or not yet: a sentence each time, and nothing else.

use std::sync::LazyLock;

use proptest::{prelude::*, sample::Index};

use super::*;
use crate::document::bytes::{Container, Section, sections::Kind};

/// Where the table of sections begins, and how long an entry of it is.
const TABLE: usize = 28;
const ENTRY: usize = 28;

/// A document with something in every section.
static BYTES: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut document = tree();
    apply(&mut document, &plain(Action::SetWidth { row: 3, diameter: Some(Diameter::nearest(0.4)) }));
    apply(&mut document, &plain(Action::Ungrow { steps: Steps::nearest(2) }));
    grow(&mut document, 1, None);
    stroke(&mut document, 1);
    apply(&mut document, &plain(Action::StrokeBegin { stroke: 2, bud: None }));
    document.to_bytes()
});

#[test]
fn a_document_that_is_not_packed_is_the_same() {
    let unpacked = crate::document::plain(BYTES.clone());
    assert!(unpacked.len() > BYTES.len());
    assert_eq!(crate::document::plain(unpacked.clone()), unpacked);
    assert_eq!(Document::from_bytes(&unpacked).expect("a document").to_bytes(), *BYTES);
    for other in [b"".to_vec(), BYTES[..100].to_vec(), vec![7; 100]] {
        assert_eq!(crate::document::plain(other.clone()), other, "what is no document stays as it is");
    }
}

fn container() -> Container {
    Container::from_bytes(&BYTES).expect("our own bytes")
}

fn sentence(bytes: &[u8]) -> String {
    Document::from_bytes(bytes).expect_err("it is refused").to_string()
}

/// The sentence about a document whose sections were changed, with checksums that are right.
fn changed(change: impl FnOnce(&mut Vec<Section>)) -> String {
    let mut container = container();
    change(&mut container.sections);
    sentence(&container.to_bytes())
}

/// The bytes with others at places of the header or the table, and the checksum made to fit.
fn resealed(changes: &[(usize, &[u8])]) -> Vec<u8> {
    let mut bytes = BYTES.clone();
    let count = u32::from_le_bytes(bytes[20..24].try_into().expect("four bytes")) as usize;
    for (at, with) in changes {
        bytes[*at..at + with.len()].copy_from_slice(with);
    }
    let mut sum = flate2::Crc::new();
    sum.update(&bytes[..24]);
    sum.update(&bytes[TABLE..TABLE + count * ENTRY]);
    bytes[24..28].copy_from_slice(&sum.sum().to_le_bytes());
    bytes
}

/// A section that no program knows yet.
fn unknown(flags: u8) -> Section {
    Section { tag: *b"WIND", version: 7, flags, codec: 9, unpacked: 60, packed: b"breeze".to_vec() }
}

#[test]
fn what_is_no_document_is_called_so() {
    for bytes in [&b""[..], b"ESP", b"SQLite format 3\0", b"espalier and more", &[0; 200]] {
        assert_eq!(sentence(bytes), "this is not an Espalier document");
    }
}

#[test]
fn a_document_cut_off_anywhere_is_refused() {
    for len in (0..BYTES.len()).step_by(7).chain(0..TABLE + 13 * ENTRY) {
        assert!(Document::from_bytes(&BYTES[..len]).is_err(), "{len} bytes are not all");
    }
    assert!(sentence(&BYTES[..BYTES.len() - 1]).contains("section writer is cut short"));
    let longer = [&**BYTES, b"x"].concat();
    assert!(sentence(&longer).contains("something follows its end"));
}

#[test]
fn a_section_that_was_changed_is_named() {
    let mut bytes = BYTES.clone();
    let last = bytes.len() - 1;
    bytes[last] ^= 16;
    assert!(sentence(&bytes).contains("section writer differs from its checksum"));
    let mut header = BYTES.clone();
    header[16] ^= 1;
    assert!(sentence(&header).contains("checksum of its table of sections differs"));
}

#[test]
fn sections_may_stand_in_any_order_but_not_twice() {
    let mut reversed = container();
    reversed.sections.reverse();
    let read = Document::from_bytes(&reversed.to_bytes()).expect("the order says nothing");
    assert_eq!(read.to_bytes(), *BYTES);
    for at in 0..reversed.sections.len() {
        assert!(changed(|sections| sections.push(sections[at].clone())).contains("is there twice"));
    }
}

#[test]
fn a_missing_section_is_named_unless_it_stands_for_nothing() {
    for section in container().sections {
        let name = section.tag;
        let mut without = container();
        without.sections.retain(|other| other.tag != name);
        let read = Document::from_bytes(&without.to_bytes());
        if [*b"WIDT", *b"FUTU", *b"GEST", *b"PROG", *b"WRIT"].contains(&name) {
            assert!(read.is_ok(), "{}", name.escape_ascii());
        } else {
            let error = read.expect_err("it cannot do without").to_string();
            assert!(error.contains("is missing"), "{error}");
        }
    }
}

#[test]
fn announced_lengths_cost_nothing() {
    let first = TABLE + 8;
    for length in [1u64 << 63, u64::MAX, 1 << 32] {
        assert!(
            sentence(&resealed(&[(first, &length.to_le_bytes())])).contains("section plant is cut short")
        );
        let error = sentence(&resealed(&[(first + 8, &length.to_le_bytes())]));
        assert!(
            error.contains(&format!("its section plant announces {length} bytes, and at most")),
            "{error}"
        );
    }
    let unpacked = u64::from_le_bytes(BYTES[first + 8..first + 16].try_into().expect("eight bytes"));
    for other in [unpacked - 1, unpacked + 1, 0] {
        assert!(
            sentence(&resealed(&[(first + 8, &other.to_le_bytes())]))
                .contains("section plant, it has another length")
        );
    }
    assert!(sentence(&resealed(&[(20, &257u32.to_le_bytes())])).contains("257 sections"));
    assert!(sentence(&resealed(&[(20, &u32::MAX.to_le_bytes())])).contains("sections"));
    // A list that says it has four billion items.
    let error = changed(|sections| {
        refill(&mut sections[0], vec![0xff; 4]);
    });
    assert!(error.contains("in its section plant, it is cut short"), "{error}");
}

#[test]
fn a_section_of_a_later_program_is_carried_along_or_refused() {
    let mut later = container();
    later.sections.insert(3, unknown(0));
    let mut document = Document::from_bytes(&later.to_bytes()).expect("nobody needs it");
    assert_eq!(document.hash(), Document::from_bytes(&BYTES).expect("our own bytes").hash());
    grow(&mut document, 1, None);
    for bytes in [document.to_bytes(), document.to_saved_bytes()] {
        let written = Container::from_bytes(&bytes).expect("our own bytes");
        assert_eq!(written.sections.iter().filter(|section| **section == unknown(0)).count(), 1);
    }
    let error = changed(|sections| sections.push(unknown(1)));
    assert!(error.starts_with("a later version of Espalier wrote the document"), "{error}");
    assert!(error.contains("section WIND of version 7"), "{error}");
}

#[test]
fn a_later_program_is_named() {
    // The header says which version of the program reads it all: 1.12.3.
    let later = resealed(&[(12, &[3, 0, 12, 1]), (TABLE + 4, &[200])]);
    let error = sentence(&later);
    assert!(
        error.contains("a section plant of version 200, which version 1.12.3 and later ones read"),
        "{error}"
    );
    let later = resealed(&[(12, &[3, 0, 12, 1]), (8, &[6])]);
    assert!(sentence(&later).contains("it has format 6, which version 1.12.3 and later ones read"));
    assert!(sentence(&resealed(&[(8, &[3])])).contains("it has format 3, which no released version wrote"));
}

#[test]
fn each_section_has_a_length_that_it_may_not_pass() {
    for (at, section) in container().sections.iter().enumerate() {
        let kind = Kind::of(section.tag).expect("our own section");
        let field = TABLE + at * ENTRY + 16;
        // Nothing is unpacked that announces too much, and nothing else is wrong with it.
        let over = sentence(&resealed(&[(field, &(kind.most + 1).to_le_bytes())]));
        let expected = format!("its section {} announces {} bytes", kind.name, kind.most + 1);
        assert!(over.contains(&expected), "{over}");
        if section.unpacked < kind.most {
            let most = sentence(&resealed(&[(field, &kind.most.to_le_bytes())]));
            assert!(most.contains("it has another length"), "{most}");
        }
    }
}

/// In memory a set takes hundreds of times the six bytes that say that nothing is set.
#[test]
fn a_list_of_small_sets_is_refused_before_it_is_read() {
    for (tag, name) in [(*b"PARA", "parameters"), (*b"LOOK", "looks")] {
        let sets = 1_000_000u32;
        let contents = [&sets.to_le_bytes()[..], &b"\x02\0\0\0{}".repeat(sets as usize)].concat();
        let error = changed(|sections| {
            let section = sections.iter_mut().find(|section| section.tag == tag).expect("it is there");
            let kind = Kind::of(tag).expect("our own section");
            *section = Section::new(kind, contents);
            section.pack();
            assert!(section.packed.len() < 50_000, "{}", section.packed.len());
        });
        let expected =
            format!("in its section {name}, a list has 1000000 items, and at most 200000 are possible");
        assert!(error.contains(&expected), "{error}");
    }
}

/// Puts other contents into a section.
fn refill(section: &mut Section, contents: Vec<u8>) {
    *section = Section { codec: 0, unpacked: contents.len() as u64, packed: contents, ..section.clone() };
}

/// Says that version 1.12.3 wrote it.
fn written_later(sections: &mut [Section]) {
    let writer =
        sections.iter_mut().find(|section| section.tag == *b"WRIT").expect("documents say who wrote them");
    refill(writer, vec![3, 0, 12, 1]);
}

#[test]
fn names_that_a_later_program_added_name_that_program() {
    for tag in [*b"PARA", *b"LOOK"] {
        let with_name = |sections: &mut Vec<Section>| {
            let section =
                sections.iter_mut().find(|section| section.tag == tag).expect("every document has it");
            let mut contents = section.unpack().expect("our own section").into_owned();
            // The first text becomes an object with one name; its length stands behind the count.
            let length = u32::from_le_bytes(contents[4..8].try_into().expect("four bytes")) as usize;
            let text = br#"{"sap":1}"#;
            contents.splice(4..8 + length, [&(text.len() as u32).to_le_bytes(), &text[..]].concat());
            refill(section, contents);
        };
        let error = changed(|sections| {
            with_name(sections);
            written_later(sections);
        });
        let name = if tag == *b"PARA" { "parameters" } else { "looks" };
        let expected = format!(
            "a later version of Espalier wrote the document: in its section {name}, unknown field `sap`, \
             which version 1.12.3 and later ones read"
        );
        assert_eq!(error, expected);
        let nameless = changed(|sections| {
            with_name(sections);
            sections.retain(|section| section.tag != *b"WRIT");
        });
        assert!(nameless.ends_with("unknown field `sap`"), "{nameless}");
    }
}

#[test]
fn each_reader_refuses_a_later_version_of_its_section() {
    let absent =
        [*b"RADI", *b"SWEP", *b"PROG"].map(|tag| Section { tag, codec: 0, unpacked: 6, ..unknown(1) });
    for section in container().sections.into_iter().chain(absent) {
        // The table of kinds knows the version, the reader does not: as if only the table had been changed.
        let mut later = container();
        later.sections.retain(|other| other.tag != section.tag);
        later.sections.push(Section { version: 4, ..section.clone() });
        let read = Document::from_container(&later).map(drop);
        if section.tag == *b"WRIT" {
            assert_eq!(read, Ok(()), "it was read with the container");
            continue;
        }
        let error = read.expect_err("nobody reads that").to_string();
        let program = env!("CARGO_PKG_VERSION");
        let end = format!("it has version 4, which version {program} and later ones read");
        assert!(error.contains("wrote the document: in its section") && error.ends_with(&end), "{error}");
    }
}

/// The plant fits together in the present; at another step a metamer would have laterals that are not there.
#[test]
fn a_step_that_ends_before_its_buds_is_refused() {
    const FIRST_END: usize = 8;
    let is_timeline = |section: &Section| section.tag == *b"TIME";
    let timeline = container().sections.into_iter().find(is_timeline).expect("every document has one");
    let mut contents = timeline.unpack().expect("our own section").into_owned();
    let number =
        |contents: &[u8], at: usize| u32::from_le_bytes(contents[at..at + 4].try_into().expect("four bytes"));
    let steps = number(&contents, 4) as usize;
    let axes_of = |step: usize| FIRST_END + 16 * step + 4;
    let growing = (1..steps - 1).find(|&step| {
        let [before, axes, after] = [step - 1, step, step + 1].map(|step| number(&contents, axes_of(step)));
        before < axes && axes < after
    });
    let at = axes_of(growing.expect("a step that lays down buds"));
    let fewer = number(&contents, at) - 1;
    contents[at..at + 4].copy_from_slice(&fewer.to_le_bytes());
    let error = changed(|sections| {
        let section =
            sections.iter_mut().find(|section| is_timeline(section)).expect("every document has one");
        refill(section, contents);
    });
    assert!(error.contains("a bud is not laid down with the metamer that bears it"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    /// Whatever a section announces and holds, no more of it is unpacked than it announces.
    #[test]
    fn a_bomb_in_any_section_is_refused(at: Index, announced in 0..1u64 << 22, held in 1usize..1 << 22) {
        prop_assume!(announced != held as u64);
        let mut container = container();
        let section = at.get_mut(&mut container.sections);
        let kind = Kind::of(section.tag).expect("our own section");
        let mut bomb = Section::new(kind, vec![0; held]);
        bomb.pack();
        *section = Section { unpacked: announced, ..bomb };
        let name = kind.name;
        let error = sentence(&container.to_bytes());
        prop_assert!(error.contains(&format!("section {name}")), "{}", error);
    }

    #[test]
    fn flipped_bits_are_noticed(at: Index, bit in 0..8u32, and_at: Index, and: u8) {
        let mut bytes = BYTES.clone();
        bytes[at.index(BYTES.len())] ^= 1 << bit;
        prop_assert!(Document::from_bytes(&bytes).is_err());
        bytes[and_at.index(BYTES.len())] ^= and;
        if let Ok(read) = Document::from_bytes(&bytes) {
            prop_assert_eq!(&read.to_bytes(), &*BYTES);
        }
    }

    #[test]
    fn any_bytes_give_a_document_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..400), has_magic: bool) {
        let bytes = if has_magic { [b"ESPALIER\x05\0\0\0", &*bytes].concat() } else { bytes };
        prop_assert!(Document::from_bytes(&bytes).is_err());
    }

    #[test]
    fn any_contents_give_a_document_or_an_error(at: Index, contents in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut container = container();
        // Any number can be a version of the program.
        let (writer, others): (Vec<Section>, Vec<Section>) =
            std::mem::take(&mut container.sections).into_iter().partition(|section| section.tag == *b"WRIT");
        container.sections = others;
        refill(at.get_mut(&mut container.sections), contents);
        container.sections.extend(writer);
        prop_assert!(Document::from_bytes(&container.to_bytes()).is_err());
    }

    /// Checksums are right here, so that what reads the sections sees what was changed.
    #[test]
    fn changed_contents_never_panic(at: Index, place: Index, with: u8, cut in 0usize..3) {
        let mut container = container();
        let section = at.get_mut(&mut container.sections);
        let mut contents = section.unpack().expect("our own section").into_owned();
        *place.get_mut(&mut contents) ^= with;
        contents.truncate(contents.len() - cut.min(contents.len()));
        refill(section, contents);
        if let Ok(mut read) = Document::from_bytes(&container.to_bytes()) {
            // Whatever it is, it is a document: it can be gone through and grows on.
            while read.apply(&who("ann"), &plain(Action::Undo {})).is_ok() {}
            let _full = read.apply(&who("ann"), &plain(Action::Grow { steps: Steps::nearest(1), until: None, bud: None }));
            prop_assert!(Document::from_bytes(&read.to_bytes()).is_ok());
        }
    }
}
