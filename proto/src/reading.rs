//! JSON and queries of addresses read into types; what cannot be read is a problem that names the field and what is allowed there.
//!
//! Every type says in its `expecting` text, or in the `allowed` of a [`NotAllowed`], what it takes. A path-tracking
//! deserialiser says where. Nothing else knows the fields, so there is no second schema to keep.

mod by_name;

use std::fmt;

use percent_encoding::percent_decode_str;
use serde::{
    Deserialize, Deserializer,
    de::{DeserializeOwned, Error, Unexpected},
};
use serde_json::{Map, Value};

use self::by_name::ByName;
use crate::{problem::Problem, reason::Reason};

/// Characters of what was found that a problem tells again.
const LONGEST: usize = 120;

/// Reads JSON text.
///
/// # Errors
///
/// A problem names the field and what is allowed there, or says that the text is no JSON.
pub fn from_json<T: DeserializeOwned>(text: &str) -> Result<T, Problem> {
    from_value(parse(text)?)
}

/// Reads the query of an address, as in `limit=5&after=x`: each name stands once, and a value is a text, or a number or
/// a truth value where the type takes one.
///
/// # Errors
///
/// A problem names the field and what is allowed there.
pub fn from_query<T: DeserializeOwned>(query: &str) -> Result<T, Problem> {
    check_text(query)?;
    let mut fields = Map::new();
    for (name, value) in form_urlencoded::parse(query.as_bytes()) {
        if fields.insert(name.clone().into_owned(), value.into_owned().into()).is_some() {
            let field = shortened(&name);
            let message = format!("{field} stands twice; allowed: once");
            return Err(Problem::new(Reason::Malformed, message).at(field, "once"));
        }
    }
    // A text that a field does not take may be the text of a number. Each field changes once at most.
    let mut value = Value::Object(fields);
    while let Err(Fault { path, text }) = read::<T>(&value) {
        let is_text = text.starts_with("invalid type: string ");
        let Some(Value::String(found)) = value.get_mut(&path).filter(|_| is_text).map(Value::take) else {
            break;
        };
        match serde_json::from_str(&found) {
            Ok(plain @ (Value::Number(_) | Value::Bool(_))) => value[&path] = plain,
            _ => {
                value[&path] = found.into();
                break;
            }
        }
    }
    from_value(value)
}

/// What may stand for the characters of a text in an address.
pub const ENCODED: &str = "UTF-8 with % and two digits for each byte";

/// Refuses bytes that are no text, which would be taken for other characters.
fn check_text(query: &str) -> Result<(), Problem> {
    let is_text = |part: &&str| percent_decode_str(part).decode_utf8().is_ok();
    let Some(part) = query.split('&').find(|part| !is_text(part)) else { return Ok(()) };
    let name = part.split_once('=').map_or(part, |(name, _)| name);
    let name = percent_decode_str(name).decode_utf8_lossy();
    Err(unexpected(&shortened(&name), "no text", ENCODED))
}

/// The text as a JSON value. Numbers that JSON does not have, such as NaN or 1e999, stand in it as texts, so that
/// the field that holds one can be named.
///
/// # Errors
///
/// The text is no JSON.
pub fn parse(text: &str) -> Result<Value, Problem> {
    serde_json::from_str(text).or_else(|error| {
        serde_json::from_str(&with_quoted_numbers(text)).map_err(|_| {
            let message = format!("the message is not JSON: {error}");
            Problem { allowed: Some("JSON".into()), ..Problem::new(Reason::Malformed, message) }
        })
    })
}

/// Reads a JSON value.
///
/// # Errors
///
/// A problem names the field and what is allowed there.
pub fn from_value<T: DeserializeOwned>(mut value: Value) -> Result<T, Problem> {
    let fault = match read(&value) {
        Ok(read) => return Ok(read),
        Err(fault) => fault,
    };
    let Some(name) = quoted(&fault.text, "missing field `") else { return Err(fault.problem()) };
    let field = joined(&fault.path, name);
    // What may stand in a field that is missing, the type says where the field holds nothing.
    insert_null(&mut value, &fault.path, name);
    let allowed = read::<T>(&value).err().filter(|nothing| nothing.path == field);
    let allowed = allowed.and_then(|nothing| nothing.problem().allowed);
    let message = format!("{field} is missing{}", and_allowed(allowed.as_deref()));
    Err(Problem { field: Some(field), allowed, ..Problem::new(Reason::Malformed, message) })
}

/// A text that stands for no value of the type that serde calls `expected`.
pub fn unexpected(field: &str, found: &str, expected: &str) -> Problem {
    let (found, allowed) = (shortened(found), plain(expected));
    Problem::new(Reason::Malformed, format!("{field} is {found}; allowed: {allowed}")).at(field, allowed)
}

/// A value that a type does not take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotAllowed {
    /// The field at fault inside the value; empty for the value itself.
    pub at: String,
    /// What stands there.
    pub found: String,
    /// What may.
    pub allowed: String,
}

impl NotAllowed {
    /// A value as a whole.
    pub fn new(found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self { at: String::new(), found: found.into(), allowed: allowed.into() }
    }
}

impl fmt::Display for NotAllowed {
    /// In the words of serde, for [`from_value`] to take apart.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.at.is_empty() {
            write!(f, "at `{}`: ", self.at)?;
        }
        write!(f, "invalid value: {}, expected {}", self.found, self.allowed)
    }
}

impl std::error::Error for NotAllowed {}

/// The fields of an object that is read in parts.
pub(crate) fn object<'de, D: Deserializer<'de>>(
    deserializer: D,
    allowed: &str,
) -> Result<Map<String, Value>, D::Error> {
    let found = match Value::deserialize(deserializer)? {
        Value::Object(fields) => return Ok(fields),
        Value::Null => Unexpected::Unit,
        Value::Bool(value) => Unexpected::Bool(value),
        Value::Number(_) => Unexpected::Other("number"),
        Value::String(_) => Unexpected::Other("string"),
        Value::Array(_) => Unexpected::Seq,
    };
    Err(D::Error::invalid_type(found, &allowed))
}

/// Reads a part of an object; an error keeps its path.
pub(crate) fn part<T: DeserializeOwned, E: Error>(at: &str, value: &Value) -> Result<T, E> {
    read(value).map_err(|fault| E::custom(format!("at `{}`: {}", joined(at, &fault.path), fault.text)))
}

/// The variant that an object names under `tag`, and its other fields.
pub(crate) fn tagged<'de, K: DeserializeOwned, D: Deserializer<'de>>(
    deserializer: D,
    tag: &'static str,
) -> Result<(K, Value), D::Error> {
    let mut fields = object(deserializer, &format!("an object with {tag}"))?;
    let name = match fields.remove(tag).ok_or_else(|| D::Error::missing_field(tag))? {
        Value::String(name) => name,
        other => other.to_string(),
    };
    Ok((part(tag, &Value::String(name))?, Value::Object(fields)))
}

/// Declares an enum whose variant stands under a key of its own beside the variant's fields.
///
/// Serde's own way to read such an enum forgets the path of an error.
macro_rules! tagged_enum {
    (
        $tag:literal,
        $(#[doc = $outer:expr])+
        pub enum $name:ident { $(
            $(#[doc = $doc:expr])+
            $variant:ident { $(
                $(#[doc = $about:expr])+
                $(#[serde($($serde:tt)+)])?
                $(#[schemars($($schemars:tt)+)])?
                $(#[ts($($ts:tt)+)])?
                $field:ident: $type:ty,
            )* },
        )+ }
    ) => {
        $(#[doc = $outer])+
        #[derive(Clone, Debug, PartialEq, serde::Serialize, schemars::JsonSchema, ts_rs::TS)]
        #[allow(
            clippy::large_enum_variant,
            reason = "the large variants are rare, and a box in every message would be in everyone's way"
        )]
        #[serde(tag = $tag, rename_all = "snake_case")]
        #[schemars(deny_unknown_fields)]
        pub enum $name { $(
            $(#[doc = $doc])+
            $variant { $(
                $(#[doc = $about])+
                $(#[serde($($serde)+)])?
                $(#[schemars($($schemars)+)])?
                $(#[ts($($ts)+)])?
                $field: $type,
            )* },
        )+ }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                #[derive(serde::Deserialize)]
                #[serde(rename_all = "snake_case")]
                enum Kind { $($variant),+ }
                let (kind, fields) = $crate::reading::tagged(deserializer, $tag)?;
                match kind { $(
                    Kind::$variant => {
                        #[derive(serde::Deserialize)]
                        #[serde(deny_unknown_fields)]
                        struct Fields { $($(#[serde($($serde)+)])? $field: $type,)* }
                        let Fields { $($field),* } = $crate::reading::part("", &fields)?;
                        Ok(Self::$variant { $($field),* })
                    }
                )+ }
            }
        }
    };
}
pub(crate) use tagged_enum;

/// What serde said, and where.
struct Fault {
    path: String,
    text: String,
}

fn read<T: DeserializeOwned>(value: &Value) -> Result<T, Fault> {
    serde_path_to_error::deserialize(ByName(value)).map_err(|error| {
        let path = error.path().iter().next().map(|_| error.path().to_string()).unwrap_or_default();
        let text = error.inner().to_string();
        // What was read in parts names the rest of the path.
        match text.strip_prefix("at `").and_then(|rest| rest.split_once("`: ")) {
            Some((inner, text)) => Fault { path: joined(&path, inner), text: text.to_owned() },
            None => Fault { path, text },
        }
    })
}

impl Fault {
    fn problem(self) -> Problem {
        let Self { path, text } = self;
        let field = shortened(&path);
        if text.starts_with("unknown field `") {
            let allowed =
                text.rsplit_once(", expected ").map_or_else(|| "no field".into(), |(_, e)| plain(e));
            let message = format!("{field} is no known field; allowed: {allowed}");
            return Problem::new(Reason::Malformed, message).at(field, allowed);
        }
        let (said, allowed) = match text.rsplit_once(", expected ") {
            Some((said, expected)) => (said, Some(plain(expected))),
            None => (text.as_str(), None),
        };
        let said = &*shortened(said);
        let named = if field.is_empty() { "the message" } else { &field };
        let (reason, sentence) = if let Some(found) = said.strip_prefix("invalid value: ") {
            let number = ["integer `", "floating point `"].into_iter().find_map(|kind| quoted(found, kind));
            let found = number.unwrap_or(found);
            (Reason::OutOfRange, format!("{named} is {found}"))
        } else if let Some(count) = said.strip_prefix("too few: ") {
            (Reason::TooFew, format!("{named} has {count}"))
        } else if let Some(count) = said.strip_prefix("too many: ") {
            (Reason::TooMany, format!("{named} has {count}"))
        } else if let Some(variant) =
            quoted(said, "unknown variant `").or_else(|| quoted(said, "unknown name `"))
        {
            (Reason::Malformed, format!("{named} is {variant}"))
        } else {
            (Reason::Malformed, format!("{named} cannot be read: {said}"))
        };
        let message = format!("{sentence}{}", and_allowed(allowed.as_deref()));
        let field = Some(field).filter(|field| !field.is_empty());
        Problem { field, allowed, ..Problem::new(reason, message) }
    }
}

fn and_allowed(allowed: Option<&str>) -> String {
    allowed.map(|allowed| format!("; allowed: {allowed}")).unwrap_or_default()
}

/// The beginning of a text that came from outside; a whole message need not be sent back.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} …", &text[..end]),
        None => text.to_owned(),
    }
}

/// What serde expects, in words for people.
fn plain(expected: &str) -> String {
    match expected {
        "u8" => "a whole number from 0 to 255".into(),
        "u32" => format!("a whole number from 0 to {}", u32::MAX),
        "u64" => "a whole number, 0 or more".into(),
        "f32" | "f64" => "a number".into(),
        "a boolean" => "true, false".into(),
        "a string" => "a text".into(),
        "a sequence" => "a list".into(),
        "string or map" => "a name".into(),
        other if other.starts_with("struct ") => "an object".into(),
        other => other.trim_start_matches("one of ").replace("` or `", ", ").replace('`', ""),
    }
}

/// What stands in backticks behind a beginning that ends with one.
fn quoted<'a>(text: &'a str, beginning: &str) -> Option<&'a str> {
    text.strip_prefix(beginning)?.split_once('`').map(|(name, _)| name)
}

/// `radius` inside `samples[3]` is `samples[3].radius`.
fn joined(outer: &str, inner: &str) -> String {
    let dot = if outer.is_empty() || inner.is_empty() || inner.starts_with('[') { "" } else { "." };
    format!("{outer}{dot}{inner}")
}

/// Puts a field that holds nothing into the object at a path.
fn insert_null(value: &mut Value, path: &str, name: &str) {
    let pointer: String = path
        .replace('[', ".")
        .replace(']', "")
        .split('.')
        .fold(String::new(), |way, key| if key.is_empty() { way } else { format!("{way}/{key}") });
    if let Some(Value::Object(fields)) = value.pointer_mut(&pointer) {
        fields.insert(name.to_owned(), Value::Null);
    }
}

fn with_quoted_numbers(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.');
        let end = match first {
            '"' => string_end(rest),
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at(end);
        let is_number = token.parse::<f64>().is_ok();
        if first != '"' && is_number && serde_json::from_str::<f64>(token).is_err() {
            out.push('"');
            out.push_str(token);
            out.push('"');
        } else {
            out.push_str(token);
        }
        rest = after;
    }
    out
}

/// Where the JSON string that `text` begins with ends.
fn string_end(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    text.len()
}
