//! Grammars that are looked at before they are planted (`GR6`), and those that come with the program (`GR7`).

use std::{collections::BTreeMap, sync::Arc};

use espalier_grammar::{
    Derivation, Diagnostic, Grammar, Limits, OpenSky, Program, SHIPPED, Severity, Shipped, Stop, WoodOptions,
};
use espalier_growth::WORLD_EXTENT;
use espalier_proto::{
    Action, CheckGrammar, GrammarDiagnostic, GrammarEnd, GrammarReport, GrammarSeverity, GrammarSize, List,
    Problem, ShippedGrammar, Steps,
};

use crate::document::{bad_value, sliders_of};

/// What looking at sizes may take.
const LIMITS: Limits = Limits { modules: 400_000, parameters: 800_000, nesting: 512, work: 8_000_000 };
/// Internodes that are counted in one plant.
const MOST_INTERNODES: usize = 400_000;
/// What looking may cost in all: modules taken, made and read, and steps of computing. It ends with the depth that goes
/// beyond.
const MOST_IN_ALL: u64 = 6_000_000;
/// The deepest that is looked at.
const DEEPEST: u32 = 64;

/// What there is to say of a text.
///
/// # Errors
/// Where values are set that it does not allow.
pub fn check_grammar(wanted: &CheckGrammar) -> Result<GrammarReport, Problem> {
    let checked = Grammar::check(&wanted.text);
    let mut report = GrammarReport {
        diagnostics: checked.diagnostics.iter().map(wire).collect(),
        title: None,
        about: None,
        author: None,
        depth: None,
        sliders: Vec::new(),
        sizes: Vec::new(),
        ends: None,
    };
    let Some(grammar) = checked.grammar else { return Ok(report) };
    let set: Vec<_> = wanted.values.iter().map(|value| (value.name.as_str(), value.value)).collect();
    let program = grammar.program(&set).map_err(|error| bad_value(&grammar, &error))?;
    report.title = grammar.title().map(str::to_owned);
    report.about = grammar.about().map(str::to_owned);
    report.author = grammar.author().map(str::to_owned);
    report.depth = Some(program.depth());
    report.sliders = sliders_of(&grammar);
    if wanted.sizes {
        let seed = wanted.seed.or(program.seed()).unwrap_or(1);
        let mut measured = Measured::default();
        let deepest = program.depth().max(DEEPEST);
        let ends = measured.look(&grammar, program, seed, deepest).err();
        report.sizes = measured.sizes;
        report.diagnostics.extend(measured.losses.iter().map(wire));
        report.ends = ends.map(|stop| match stop {
            Stop::Modules(_) | Stop::Parameters(_) | Stop::Work(_) | Stop::Nodes(_) => {
                wire_end(&Stop::Counted)
            }
            stop => wire_end(&stop),
        });
    }
    Ok(report)
}

/// What is found out by deriving a grammar.
#[derive(Default)]
struct Measured {
    sizes: Vec<GrammarSize>,
    /// What drawing loses at the depth of its text.
    losses: Vec<Diagnostic>,
    /// What looking has cost.
    cost: u64,
}

impl Measured {
    /// Notes how large a plant is at each depth, as far as that can be found out.
    fn look(&mut self, grammar: &Grammar, program: Program, seed: u32, deepest: u32) -> Result<(), Stop> {
        let depth = program.depth();
        let options = WoodOptions { nodes: MOST_INTERNODES, extent: WORLD_EXTENT as u32, twig_radius: 0.05 };
        let mut derivation = Derivation::new(Arc::new(program), seed, LIMITS)?;
        let mut drawn_for = 0;
        loop {
            let mut drawing = derivation.drawing(options);
            let ended = loop {
                match drawing.advance(&derivation, &OpenSky, usize::MAX) {
                    Ok(true) => break Ok(()),
                    Ok(false) => {}
                    Err(stop) => break Err(stop),
                }
            };
            drawn_for += drawing.work();
            self.cost = derivation.work() + drawn_for;
            ended?;
            let drawn = drawing.finish()?;
            if derivation.depth() <= depth {
                let tiny = grammar.tiny_pieces(&derivation, &drawn);
                self.losses = tiny.into_iter().chain(grammar.lost_organs(&derivation, &drawn)).collect();
            }
            let internodes = drawn.wood.nodes.iter().filter(|node| node.parent.is_some()).count();
            let modules = derivation.word().len();
            self.sizes.push(GrammarSize { modules: modules as u32, internodes: internodes as u32 });
            if derivation.depth() >= deepest {
                return Ok(());
            }
            if self.cost > MOST_IN_ALL {
                return Err(Stop::Counted);
            }
            let derived = derivation.step(&OpenSky);
            self.cost = derivation.work() + drawn_for;
            derived?;
        }
    }
}

/// Why a grammar ends, as it travels.
pub(crate) fn wire_end(stop: &Stop) -> GrammarEnd {
    let (wording, values) = stop.sentence();
    GrammarEnd { id: wording.id.to_owned(), values: wire_values(&values), message: stop.to_string() }
}

fn wire_values(values: &[(&'static str, String)]) -> BTreeMap<String, String> {
    values.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect()
}

fn wire(found: &Diagnostic) -> GrammarDiagnostic {
    let severity = match found.severity {
        Severity::Error => GrammarSeverity::Error,
        Severity::Warning => GrammarSeverity::Warning,
    };
    GrammarDiagnostic {
        severity,
        line: found.line,
        column: found.column,
        length: found.length,
        code: found.code.to_owned(),
        id: found.id.to_owned(),
        values: wire_values(&found.values),
        message: found.message.clone(),
        hint: found.hint.clone(),
    }
}

/// A grammar that comes with the program, as lists have it; its picture is found at an address.
pub fn wire_grammar(shipped: &Shipped, picture: String) -> ShippedGrammar {
    let grammar = Grammar::check(shipped.text).grammar;
    let program = grammar.as_ref().and_then(|grammar| grammar.program(&[]).ok());
    ShippedGrammar {
        name: shipped.name.to_owned(),
        title: grammar.as_ref().and_then(Grammar::title).unwrap_or(shipped.name).to_owned(),
        about: grammar.as_ref().and_then(Grammar::about).unwrap_or_default().to_owned(),
        depth: program.as_ref().map_or(0, Program::depth),
        sliders: grammar.as_ref().map(sliders_of).unwrap_or_default(),
        text: shipped.text.to_owned(),
        picture,
    }
}

/// The grammar with a name that comes with the program.
pub fn shipped_grammar(name: &str) -> Option<&'static Shipped> {
    SHIPPED.iter().find(|shipped| shipped.name == name)
}

/// What plants a text, derived as deep as it says or as is wanted.
///
/// # Errors
/// What is wrong with it.
pub fn grammar_script(text: &str, depth: Option<Steps>) -> Result<Action, Vec<Diagnostic>> {
    let grammar = Grammar::read(text)?;
    let own = grammar.program(&[]).ok().and_then(|program| Steps::try_from(program.depth()).ok());
    Ok(Action::SetGrammar {
        text: text.to_owned(),
        values: List::default(),
        seed: None,
        position: None,
        depth: depth.or(own),
        within: None,
    })
}

/// What there is to say of a text that is planted: its warnings, and whether it is drawn too small.
pub fn grammar_notes(text: &str) -> Vec<Diagnostic> {
    let checked = Grammar::check(text);
    let mut notes = checked.diagnostics;
    if let Some((grammar, program)) =
        checked.grammar.and_then(|grammar| grammar.program(&[]).ok().map(|program| (grammar, program)))
    {
        let (seed, depth) = (program.seed().unwrap_or(1), program.depth());
        let mut measured = Measured::default();
        // Where it ends is told when it is planted.
        let _ended = measured.look(&grammar, program, seed, depth);
        notes.extend(measured.losses);
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(text: &str) -> GrammarReport {
        let wanted = CheckGrammar { text: text.to_owned(), values: List::default(), seed: None, sizes: true };
        check_grammar(&wanted).unwrap_or_else(|problem| panic!("{problem}"))
    }

    #[test]
    fn gr6_sentences_have_names_and_values() {
        let report = checked("axiom: F(sni(1))\nspike --> F\n");
        let found: Vec<_> = report.diagnostics.iter().map(|one| (&*one.id, one.values.len())).collect();
        assert_eq!(found, [("unknown-function.near", 2), ("predecessor.name", 2)]);
        assert_eq!(report.diagnostics[1].values["name"], "spike");
        let tiny = checked("axiom: A\nderivation length: 200\nA --> F(0.1)[+(30)F(0.1)F(0.1)]A\n");
        let last = tiny.diagnostics.last().expect("it is told");
        assert_eq!((&*last.code, &*last.values["scale"]), ("tiny-pieces", "10"));
        let lost = checked("axiom: ~l~fF~k\n");
        let last = lost.diagnostics.last().expect("it is told");
        assert_eq!((&*last.code, &*last.values["count"]), ("lost-organs", "2"));
    }

    #[test]
    fn gr6_a_text_is_looked_at() {
        let report = checked("title: Fork\nslider: a 10 60\na = 30\naxiom: A\nA --> F[+(a)A][-(a)A]\n");
        assert_eq!((report.title.as_deref(), report.diagnostics.len()), (Some("Fork"), 0));
        let slider = &report.sliders[0];
        assert_eq!((slider.name.as_str(), slider.from, slider.value, slider.to), ("a", 10.0, 30.0, 60.0));
        let internodes: Vec<u32> = report.sizes.iter().take(5).map(|size| size.internodes).collect();
        assert_eq!(internodes, [0, 1, 3, 7, 15]);
        assert!(report.sizes.len() > 10 && report.sizes.len() < 30, "a tree that doubles is soon too large");
        assert_eq!(report.ends.map(|why| why.id).as_deref(), Some("ends.counted"));

        let report = checked("axiom: A\nA --> F[+A\nB --> sni(3)\n");
        let found = &report.diagnostics[0];
        assert_eq!((found.severity, found.line), (GrammarSeverity::Error, 2));
        assert!(!found.code.is_empty() && report.sizes.is_empty() && report.depth.is_none());

        let report = checked("axiom: A(3)\nA(n) --> F(1/n)A(n-1)\n");
        assert_eq!(report.sizes.len(), 4);
        let why = report.ends.expect("a division by zero ends it");
        assert_eq!((&*why.id, &*why.values["line"]), ("ends.no-number", "2"));
        assert!(why.message.starts_with("line 2, column 1:"), "{}", why.message);

        let values = vec![espalier_proto::GrammarValue { name: "b".into(), value: 1.0 }];
        let values = List::try_from(values).unwrap_or_else(|_| panic!("not too many"));
        let wanted = CheckGrammar { text: "axiom: F\n".into(), values, seed: None, sizes: false };
        assert_eq!(check_grammar(&wanted).err().and_then(|problem| problem.field).as_deref(), Some("values"));
    }

    #[test]
    fn gr6_looking_ends_before_it_costs() {
        // Whatever grows, computes, looks for contexts in vain, or is read as very many: what it costs until it ends.
        let (many, far) = ("A".repeat(5000), "F".repeat(9000));
        let bombs = [
            "axiom: F\nF --> FFFFFFFF".to_owned(),
            format!("axiom: A\nignore: F\nA --> {far}\nB < F --> G"),
            "axiom: A\nhomomorphism: maximum depth: 100\nA --> AA".to_owned(),
            format!("axiom: {many}\nhomomorphism: maximum depth: 100\nA --> BB\nB --> CC\nC --> DD\nD --> {}", "+".repeat(2000)),
            "axiom: A(90)\ndecomposition: maximum depth: 100\nA(n) : n > 0 --> A(n-1)A(n-1)\nA(n) --> *".to_owned(),
            "axiom: A\nA --> B(40)\ndecomposition: maximum depth: 50\nB(n) : n > 0 --> B(n-1)B(n-1)\nB(n) --> *".to_owned(),
            "axiom: A(2)\nA(x) --> A(x^x)".to_owned(),
        ];
        for text in bombs {
            let grammar = Grammar::read(&text).expect("it is right");
            let program = grammar.program(&[]).expect("no sliders");
            let mut measured = Measured::default();
            let deepest = program.depth().max(DEEPEST);
            let ended = measured.look(&grammar, program, 1, deepest);
            let begin: String = text.chars().take(60).collect();
            assert!(ended.is_err(), "{begin}");
            // The work of one step, which is bounded, may be on top.
            assert!(measured.cost <= MOST_IN_ALL + LIMITS.work, "{begin}: {}", measured.cost);
        }
    }

    #[test]
    fn gr7_what_is_shipped_says_what_it_is() {
        for shipped in SHIPPED {
            let listed = wire_grammar(shipped, String::new());
            assert!(listed.title != shipped.name && listed.about.ends_with('.'), "{}", shipped.name);
            assert!(listed.depth > 0 && !listed.sliders.is_empty(), "{}", shipped.name);
            assert!(grammar_script(shipped.text, None).is_ok());
        }
    }
}
