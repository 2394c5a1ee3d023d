//! What belongs to other programs for grammars and is left out here: told by name, so that nobody looks for a slip.

use crate::source::ARROW;

/// A construct of another language.
pub(crate) struct Foreign {
    pub code: &'static str,
    pub message: String,
    pub hint: &'static str,
    /// Bytes of its first word.
    pub length: usize,
}

/// Words that begin such a construct; the hint says what stands for it here.
const WORDS: &[(&str, &str, &str)] = &[
    ("def", "python", "a grammar has no functions of its own; func: defines curves"),
    ("import", "python", "nothing is imported"),
    ("from", "python", "nothing is imported"),
    ("for", "python", "a rule acts on all modules at once; repeat by deriving further"),
    ("while", "python", "a rule acts on all modules at once; repeat by deriving further"),
    ("if", "python", "write conditions into the rule: A(x) : x > 0 --> F"),
    ("elif", "python", "write a rule for each case"),
    ("else", "python", "write a rule for each case"),
    ("return", "python", "a rule is written A --> F"),
    ("class", "python", "a grammar has no classes"),
    ("print", "python", "a grammar prints nothing"),
    ("global", "python", "definitions are numbers: R = 1.5"),
    ("produce", "python", "write the successor behind the arrow: A --> F"),
    ("nproduce", "python", "write the successor behind the arrow: A --> F"),
    ("nsproduce", "python", "write the successor behind the arrow: A --> F"),
    ("context", "python", "contexts stand in rules: A < B > C --> D"),
    ("extern", "python", "definitions are numbers: R = 1.5"),
    ("Start", "cpfg-statements", "a grammar has no statements; definitions are numbers: R = 1.5"),
    ("StartEach", "cpfg-statements", "a grammar has no statements; step is the number of the step"),
    ("End", "cpfg-statements", "a grammar has no statements"),
    ("EndEach", "cpfg-statements", "a grammar has no statements"),
    ("group", "groups", "all rules belong to one group"),
    ("sublsystem", "sub-l-systems", "a file holds one grammar"),
    ("float", "c", "definitions are numbers: R = 1.5"),
    ("double", "c", "definitions are numbers: R = 1.5"),
    ("int", "c", "definitions are numbers: R = 1.5"),
    ("void", "c", "a grammar has no functions of its own; func: defines curves"),
    ("struct", "c", "modules have numbers as parameters: A(1, 2)"),
    ("derivation", "header", "write derivation length: 10"),
];

/// The construct of another language that a line begins with.
pub(crate) fn foreign(line: &str) -> Option<Foreign> {
    let word_length = line.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(line.len());
    let (word, behind) = line.split_at(word_length);
    let found = |code, name: &str, hint, length| {
        let message = match code {
            "python" => format!("`{name}` is Python, which is not run here"),
            "c" | "cpfg-statements" => format!("`{name}` is a statement, and none is run here"),
            "header" => format!("`{name}` begins no header by itself"),
            _ => format!("`{name}` is not supported"),
        };
        Some(Foreign { code, message, hint, length })
    };
    if line.starts_with('#') && !line.starts_with("#define") {
        let length = 1 + line[1..].find(|c: char| !c.is_alphanumeric()).unwrap_or(line.len() - 1);
        let hint = "of C's directives only #define NAME VALUE is read";
        return found("c", &line[..length], hint, length);
    }
    if line.contains(ARROW) && (line.contains("<<") || line.contains(">>")) {
        let at = line.find("<<").or_else(|| line.find(">>")).unwrap_or(0);
        let hint = "contexts look at the word before the step: A < B > C";
        return Some(Foreign {
            code: "new-context",
            message: format!("`{}` looks at what is being made, which is not supported", &line[at..at + 2]),
            hint,
            length: line.len(),
        });
    }
    if line.contains(ARROW) {
        let behind = line.split_once(ARROW).map_or("", |(_, behind)| behind);
        let is_statement = line.split(ARROW).next().is_some_and(|before| before.contains('{'));
        if is_statement || behind.contains(';') && behind.contains('=') {
            let hint = "a rule is predecessor : condition --> successor";
            return Some(Foreign {
                code: "cpfg-statements",
                message: "statements in a rule are not run here".to_owned(),
                hint,
                length: line.len(),
            });
        }
        return None;
    }
    // A line with a word and a colon that is no header, and a call without an arrow, are told apart by the word alone.
    if let Some(&(name, code, hint)) = WORDS.iter().find(|row| row.0 == word) {
        let is_statement = behind.is_empty() || behind.starts_with([' ', '\t', '(', ':', '\n']);
        let is_length =
            name == "derivation" && behind.trim_start().to_ascii_lowercase().starts_with("length");
        if is_statement && !is_length {
            return found(code, name, hint, word_length);
        }
    }
    let is_block =
        line.trim_end().ends_with(':') && line.contains('(') && crate::headers::header(line).is_none();
    if is_block {
        return Some(Foreign {
            code: "python",
            message: "a rule that ends with `:` goes on in Python, which is not run here".to_owned(),
            hint: "write the successor behind the arrow: A(x) --> F(x)",
            length: line.len(),
        });
    }
    None
}
