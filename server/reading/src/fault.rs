//! What serde says of a value that a type does not take, in words for people.

use std::fmt;

/// Characters of what was found that a refusal tells again.
const LONGEST: usize = 120;

/// A value that a type does not take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotAllowed {
    /// The field at fault inside the value; empty for the value itself.
    pub at: String,
    /// What stands there.
    pub found: String,
    /// What may.
    pub allowed: String,
    /// What kind of refusal it is, where it has a name of its own.
    pub kind: Option<&'static str>,
}

impl NotAllowed {
    /// A value as a whole.
    pub fn new(found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self { at: String::new(), found: found.into(), allowed: allowed.into(), kind: None }
    }
}

impl fmt::Display for NotAllowed {
    /// In the words of serde, for [`Fault::refusal`] to take apart.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.at.is_empty() {
            write!(f, "at `{}`: ", self.at)?;
        }
        match self.kind {
            Some(kind) => write!(f, "kind `{kind}`: {}, expected {}", self.found, self.allowed),
            None => write!(f, "invalid value: {}, expected {}", self.found, self.allowed),
        }
    }
}

impl std::error::Error for NotAllowed {}

/// What serde said, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    path: String,
    text: String,
}

impl From<serde_path_to_error::Error<serde_json::Error>> for Fault {
    fn from(error: serde_path_to_error::Error<serde_json::Error>) -> Self {
        let path = error.path().iter().next().map(|_| error.path().to_string()).unwrap_or_default();
        Self::at(&path, error.inner())
    }
}

impl Fault {
    /// What serde said of a field.
    pub fn at(path: &str, error: &serde_json::Error) -> Self {
        let text = error.to_string();
        let text = without_place(&text);
        // What was read in parts names the rest of the path.
        let (path, text) = match text.strip_prefix("at `").and_then(|rest| rest.split_once("`: ")) {
            Some((inner, text)) => (joined(path, inner), text),
            None => (path.to_owned(), text),
        };
        Self { path, text: text.to_owned() }
    }

    /// The field at fault; empty for the whole.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Whether a text stands where the type takes none.
    pub fn is_of_text(&self) -> bool {
        self.text.starts_with("invalid type: string ")
    }

    /// The field that is missing at the path.
    pub fn missing(&self) -> Option<&str> {
        quoted(&self.text, "missing field `")
    }

    /// The same inside a field, in the words of serde.
    pub fn within(&self, outer: &str) -> String {
        format!("at `{}`: {}", joined(outer, &self.path), self.text)
    }

    /// The same in words for people.
    pub fn refusal(self) -> Refusal {
        let Self { path, text } = self;
        let field = shortened(&path);
        if text.starts_with("unknown field `") {
            let allowed =
                text.rsplit_once(", expected ").map_or_else(|| "no field".into(), |(_, e)| plain(e));
            return Refusal::new(field, Kind::Malformed, "is no known field", Some(allowed));
        }
        if let Some(name) = quoted(&text, "duplicate field `") {
            let field = shortened(&joined(&path, name));
            return Refusal::new(field, Kind::Malformed, "stands twice", Some("once".into()));
        }
        let (said, allowed) = match text.rsplit_once(", expected ") {
            Some((said, expected)) => (said, Some(plain(expected))),
            None => (text.as_str(), None),
        };
        let said = &*shortened(said);
        let named = said.strip_prefix("kind `").and_then(|rest| rest.split_once("`: "));
        let (kind, what) = if let Some((kind, found)) = named {
            (Kind::Named(kind.to_owned()), format!("is {found}"))
        } else if let Some(found) = said.strip_prefix("invalid value: ") {
            let number = ["integer `", "floating point `"].into_iter().find_map(|kind| quoted(found, kind));
            (Kind::OutOfRange, format!("is {}", number.unwrap_or(found)))
        } else if let Some(count) = said.strip_prefix("too few: ") {
            (Kind::TooFew, format!("has {count}"))
        } else if let Some(count) = said.strip_prefix("too many: ") {
            (Kind::TooMany, format!("has {count}"))
        } else if let Some(variant) =
            quoted(said, "unknown variant `").or_else(|| quoted(said, "unknown name `"))
        {
            (Kind::Malformed, format!("is {variant}"))
        } else {
            (Kind::Malformed, format!("cannot be read: {said}"))
        };
        Refusal::new(field, kind, what, allowed)
    }
}

/// What kind of refusal it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It is nothing that the type knows.
    Malformed,
    /// It lies outside its range.
    OutOfRange,
    /// A list is too short.
    TooFew,
    /// A list is too long.
    TooMany,
    /// The type has a name of its own for it.
    Named(String),
}

/// A value that is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The field at fault, as a path: `samples[3].radius`; empty for the whole.
    pub field: String,
    /// What kind of refusal it is.
    pub kind: Kind,
    /// What is wrong with the field, as what is said of it: `is -1`.
    pub what: String,
    /// What is allowed there.
    pub allowed: Option<String>,
}

impl Refusal {
    fn new(field: String, kind: Kind, what: impl Into<String>, allowed: Option<String>) -> Self {
        Self { field, kind, what: what.into(), allowed }
    }

    /// A field that is not there.
    pub fn missing(field: &str, allowed: Option<String>) -> Self {
        Self::new(shortened(field), Kind::Malformed, "is missing", allowed)
    }
}

/// The beginning of a text that came from outside; a whole message need not be sent back.
pub fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} …", &text[..end]),
        None => text.to_owned(),
    }
}

/// What serde expects, in words for people.
pub fn plain(expected: &str) -> String {
    let count = ["an array of length ", "a tuple of size "]
        .into_iter()
        .find_map(|beginning| expected.strip_prefix(beginning));
    if let Some(count) = count {
        return format!("a list of {count} entries");
    }
    match expected {
        "u8" => "a whole number from 0 to 255".into(),
        "u32" => format!("a whole number from 0 to {}", u32::MAX),
        "u64" | "usize" => "a whole number, 0 or more".into(),
        "f32" | "f64" => "a number".into(),
        "a boolean" => "true, false".into(),
        "a string" => "a text".into(),
        "a sequence" => "a list".into(),
        other if other.starts_with("struct ") => "an object".into(),
        other => other.trim_start_matches("one of ").replace("` or `", ", ").replace('`', ""),
    }
}

/// `radius` inside `samples[3]` is `samples[3].radius`.
pub fn joined(outer: &str, inner: &str) -> String {
    let dot = if outer.is_empty() || inner.is_empty() || inner.starts_with('[') { "" } else { "." };
    format!("{outer}{dot}{inner}")
}

/// A part of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step<'a> {
    Field(&'a str),
    /// Any entry of a list.
    Entry,
}

/// The parts of a path.
pub(crate) fn steps(path: &str) -> Vec<Step<'_>> {
    let parts = path.split(['.', '[']).filter(|part| !part.is_empty());
    parts.map(|part| if part.ends_with(']') { Step::Entry } else { Step::Field(part) }).collect()
}

/// What serde said without the line and the column, which stand behind it where the text was read as it came.
pub(crate) fn without_place(text: &str) -> &str {
    let Some((said, place)) = text.rsplit_once(" at line ") else { return text };
    let is_place = place
        .split_once(" column ")
        .is_some_and(|(line, column)| [line, column].iter().all(|number| number.parse::<u64>().is_ok()));
    if is_place { said } else { text }
}

/// What stands in backticks behind a beginning that ends with one.
fn quoted<'a>(text: &'a str, beginning: &str) -> Option<&'a str> {
    text.strip_prefix(beginning)?.split_once('`').map(|(name, _)| name)
}
