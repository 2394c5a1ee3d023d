//! JSON values in which each name stands once in its object.

use std::fmt;

use serde::{
    Deserializer,
    de::{DeserializeSeed, Error, MapAccess, SeqAccess, Visitor},
};
use serde_json::{Map, Number, Value};

use crate::{Fault, Unread, fault::without_place};

/// Reads text as a JSON value.
///
/// # Errors
///
/// It is no JSON, or a name stands twice in one object, so that nobody can tell which of the two values is meant.
pub fn value(text: &str) -> Result<Value, Unread> {
    let mut json = serde_json::Deserializer::from_str(text);
    let mut track = serde_path_to_error::Track::new();
    let read = Once.deserialize(serde_path_to_error::Deserializer::new(&mut json, &mut track));
    let error = match read.and_then(|value| json.end().map(|()| value)) {
        Ok(value) => return Ok(value),
        Err(error) => error,
    };
    if error.is_data() {
        let fault = Fault::from(serde_path_to_error::Error::new(track.path(), error));
        return Err(Unread::Refused(fault.refusal()));
    }
    Err(Unread::NotJson {
        line: error.line() as u64,
        column: error.column() as u64,
        what: without_place(&error.to_string()).to_owned(),
    })
}

struct Once;

impl<'de> DeserializeSeed<'de> for Once {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, format: D) -> Result<Value, D::Error> {
        format.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Once {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Value, E> {
        Ok(Number::from_f64(value).map_or(Value::Null, Value::Number))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_string<E: Error>(self, value: String) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_unit<E: Error>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(entry) = entries.next_element_seed(Self)? {
            list.push(entry);
        }
        Ok(list.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(name) = fields.next_key::<String>()? {
            if object.contains_key(&name) {
                return Err(A::Error::custom(format_args!("duplicate field `{name}`")));
            }
            let value = fields.next_value_seed(Self)?;
            object.insert(name, value);
        }
        Ok(object.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_as_serde_json_reads_them() {
        for text in ["null", "[1, -2, 2.5, 1e300, true, \"a\\u00e4\"]", r#"{"a": {"b": []}, "c": {}}"#] {
            assert_eq!(value(text).ok(), serde_json::from_str(text).ok(), "{text}");
        }
        for text in ["", "{", "[1,]", "1 2", "NaN", "\u{1}"] {
            assert!(matches!(value(text), Err(Unread::NotJson { .. })), "{text}");
        }
        let deep = "[".repeat(100_000);
        assert!(matches!(value(&deep), Err(Unread::NotJson { .. })));
    }

    #[test]
    fn a_name_that_stands_twice_is_refused_with_its_path() {
        for (text, field) in [
            (r#"{"seed":1,"seed":1}"#, "seed"),
            (r#"{"command":{"kind":"grow","steps":1,"steps":2}}"#, "command.steps"),
            (r#"[0,{"a":{"b":1,"c":2,"b":null}}]"#, "[1].a.b"),
            (r#"{"a":[{"x":1,"\u0078":2}]}"#, "a[0].x"),
        ] {
            let Err(Unread::Refused(refusal)) = value(text) else { panic!("{text} is taken") };
            assert_eq!((refusal.field.as_str(), refusal.allowed.as_deref()), (field, Some("once")), "{text}");
        }
    }
}
