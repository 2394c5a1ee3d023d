//! The name that was meant where one is mistyped.

use espalier_growth::species;

use crate::store::folded;

/// Names less alike than this are no slip; 1 is the same name.
const ALIKE: f64 = 0.75;
/// Characters of a name that is looked at; nobody mistypes a longer one.
const LONGEST: usize = 100;

/// The name most like another one, unless they could hardly be mixed up.
pub fn similar<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = folded(name);
    let length = name.chars().count();
    if length > LONGEST {
        return None;
    }
    let most = if length > 4 { 2 } else { 1 };
    let likeness = |known: &str| {
        let known = folded(known);
        let alike = strsim::jaro_winkler(&name, &known);
        // Letters left out, added, changed or exchanged with their neighbours count before a common beginning.
        let slips = strsim::osa_distance(&name, &known);
        if slips <= most && slips < length { (1 + most - slips) as f64 + alike } else { alike }
    };
    let likely = names.into_iter().map(|known| (likeness(known), known)).filter(|(alike, _)| *alike > ALIKE);
    likely.max_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, known)| known)
}

/// What is said of a name that is none: the one that may have been meant.
pub fn asked_for<'a>(name: &str, names: impl IntoIterator<Item = &'a str>) -> String {
    similar(name, names).map(|known| format!(" (did you mean {known}?)")).unwrap_or_default()
}

/// What is said where no species has this short name.
pub fn no_species(slug: &str) -> Option<String> {
    let known = || species::all().iter().map(|species| species.slug);
    (!known().any(|other| other == slug))
        .then(|| format!("There is no species {slug:?}{}.", asked_for(slug, known())))
}

#[cfg(test)]
mod tests {
    use espalier_settings::ParameterValues;

    use super::*;
    use crate::formats::FORMATS;

    #[test]
    fn a_species_that_is_none_is_answered_with_the_nearest() {
        assert_eq!(no_species("oak"), None);
        assert_eq!(no_species("oka").as_deref(), Some("There is no species \"oka\" (did you mean oak?)."));
        assert_eq!(no_species("triffid").as_deref(), Some("There is no species \"triffid\"."));
    }

    #[test]
    fn what_was_mistyped_is_known_and_what_is_another_word_is_not() {
        let formats = || FORMATS.iter().map(|row| row.ending);
        for (name, expected) in [
            ("gltf", Some("glb")),
            ("GLB", Some("glb")),
            ("gbl", Some("glb")),
            ("mgt", Some("mtg")),
            ("cvs", Some("csv")),
            ("obj", Some("obj.zip")),
            ("fbx", None),
            ("exe", None),
            ("x", None),
            ("", None),
        ] {
            assert_eq!(similar(name, formats()), expected, "{name}");
        }
        let names = ["sapling", "sampling", "Old oak", "Old ash", "oak"];
        for (name, expected) in [
            ("sapilng", Some("sapling")),
            ("old oka", Some("Old oak")),
            ("oka", Some("oak")),
            ("Öld ash", Some("Old ash")),
            ("willow", None),
        ] {
            assert_eq!(similar(name, names), expected, "{name}");
        }
        assert_eq!(similar(&"oak".repeat(99), names), None);
        assert_eq!(similar("triffid", species::all().iter().map(|species| species.slug)), None);
        assert_eq!(similar("sap", ParameterValues::NAMES.iter().copied()), None);
    }
}
