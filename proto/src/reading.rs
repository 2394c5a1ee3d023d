//! JSON and queries of addresses read into types; what cannot be read is a problem that names the field and what is allowed there.

use espalier_reading::{Fault, Kind, NotAllowed, Refusal, Unread, joined, plain, shortened};
use percent_encoding::percent_decode_str;
use serde::{
    Deserialize, Deserializer,
    de::{DeserializeOwned, DeserializeSeed, Error, Unexpected},
};
use serde_json::{Map, Value};

use crate::{problem::Problem, reason::Reason};

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
    while let Err(fault) = espalier_reading::from_value::<T>(&value) {
        let path = fault.path();
        let Some(Value::String(found)) = value.get_mut(path).filter(|_| fault.is_of_text()).map(Value::take)
        else {
            break;
        };
        match serde_json::from_str(&found) {
            Ok(plain @ (Value::Number(_) | Value::Bool(_))) => value[path] = plain,
            _ => {
                value[path] = found.into();
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
/// The text is no JSON, or a name stands twice in an object of it.
pub fn parse(text: &str) -> Result<Value, Problem> {
    let unread = match espalier_reading::value(text) {
        Ok(value) => return Ok(value),
        Err(unread) => unread,
    };
    let told = match unread {
        Unread::Refused(refusal) => return Err(refusal.into()),
        Unread::NotJson { line, column, what } => format!("{what} at line {line} column {column}"),
    };
    match espalier_reading::value(&with_quoted_numbers(text)) {
        Ok(value) => Ok(value),
        Err(Unread::Refused(refusal)) => Err(refusal.into()),
        Err(Unread::NotJson { .. }) => {
            let message = format!("the message is not JSON: {told}");
            Err(Problem { allowed: Some("JSON".into()), ..Problem::new(Reason::Malformed, message) })
        }
    }
}

/// Reads a JSON value.
///
/// # Errors
///
/// A problem names the field and what is allowed there.
pub fn from_value<T: DeserializeOwned>(mut value: Value) -> Result<T, Problem> {
    let fault = match espalier_reading::from_value(&value) {
        Ok(read) => return Ok(read),
        Err(fault) => fault,
    };
    let Some(name) = fault.missing() else { return Err(fault.refusal().into()) };
    let field = joined(fault.path(), name);
    // What may stand in a field that is missing, the type says where the field holds nothing.
    insert_null(&mut value, fault.path(), name);
    let nothing = espalier_reading::from_value::<T>(&value).err().filter(|nothing| nothing.path() == field);
    Err(Refusal::missing(&field, nothing.and_then(|nothing| nothing.refusal().allowed)).into())
}

/// Reads a value that stands in a field, by a visitor that knows more than its type.
///
/// # Errors
///
/// A problem names the field and what is allowed there.
pub fn in_field<'de, S: DeserializeSeed<'de>>(
    field: &str,
    value: &'de Value,
    seed: S,
) -> Result<S::Value, Problem> {
    seed.deserialize(value).map_err(|error| {
        let refusal = Fault::at(field, &error).refusal();
        refusal.into()
    })
}

/// The problem with what a type does not take in a field.
pub(crate) fn told(field: &str, fault: &NotAllowed) -> Problem {
    Fault::at(field, &serde_json::Error::custom(fault)).refusal().into()
}

impl From<Refusal> for Problem {
    fn from(Refusal { field, kind, what, allowed }: Refusal) -> Self {
        let reason = match kind {
            Kind::Malformed => Reason::Malformed,
            Kind::OutOfRange => Reason::OutOfRange,
            Kind::TooFew => Reason::TooFew,
            Kind::TooMany => Reason::TooMany,
            Kind::Named(name) => Reason::deserialize(Value::String(name)).unwrap_or(Reason::OutOfRange),
        };
        let named = if field.is_empty() { "the message" } else { &field };
        let told = allowed.as_deref().map(|allowed| format!("; allowed: {allowed}")).unwrap_or_default();
        let message = format!("{named} {what}{told}");
        let field = Some(field).filter(|field| !field.is_empty());
        Self { field, allowed, ..Self::new(reason, message) }
    }
}

/// A text that stands for no value of the type that serde calls `expected`.
pub fn unexpected(field: &str, found: &str, expected: &str) -> Problem {
    let (found, allowed) = (shortened(found), plain(expected));
    Problem::new(Reason::Malformed, format!("{field} is {found}; allowed: {allowed}")).at(field, allowed)
}

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
    espalier_reading::from_value(value).map_err(|fault| E::custom(fault.within(at)))
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
