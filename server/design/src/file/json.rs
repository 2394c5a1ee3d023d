//! JSON values that know where they stand.

use espalier_reading::{Kind, NotAllowed, Refusal, joined, shortened};
use serde_json::{Map, Value};

/// A value and the path to it.
#[derive(Clone, Debug)]
pub(super) struct Json<'a> {
    pub value: &'a Value,
    pub path: String,
}

/// An object whose fields are asked for one by one.
pub(super) struct Object<'a> {
    fields: &'a Map<String, Value>,
    path: String,
}

impl<'a> Json<'a> {
    pub(super) fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    /// What is wrong here, and what is allowed.
    pub(super) fn refused(&self, kind: Kind, what: impl Into<String>, allowed: impl Into<String>) -> Refusal {
        Refusal { field: shortened(&self.path), kind, what: what.into(), allowed: Some(allowed.into()) }
    }

    /// What is wrong with a value that was read from here.
    pub(super) fn not_allowed(&self, fault: &NotAllowed) -> Refusal {
        Refusal {
            field: shortened(&joined(&self.path, &fault.at)),
            kind: Kind::OutOfRange,
            what: format!("is {}", shortened(&fault.found)),
            allowed: Some(fault.allowed.clone()),
        }
    }

    fn of_another_kind(&self, allowed: &str) -> Refusal {
        self.refused(Kind::Malformed, format!("is {}", shortened(&self.value.to_string())), allowed)
    }

    /// An object with fields among these.
    pub(super) fn object(&self, known: &[&str]) -> Result<Object<'a>, Refusal> {
        let object = self.any_object()?;
        match object.fields.keys().find(|name| !known.contains(&name.as_str())) {
            Some(name) => {
                let field = Self { value: self.value, path: joined(&self.path, name) };
                Err(field.refused(Kind::Malformed, "is no known field", known.join(", ")))
            }
            None => Ok(object),
        }
    }

    /// An object with any fields.
    pub(super) fn any_object(&self) -> Result<Object<'a>, Refusal> {
        let fields = self.value.as_object().ok_or_else(|| self.of_another_kind("an object"))?;
        Ok(Object { fields, path: self.path.clone() })
    }

    /// The entries of a list.
    pub(super) fn list(&self, allowed: &str) -> Result<Vec<Self>, Refusal> {
        let list = self.value.as_array().ok_or_else(|| self.of_another_kind(allowed))?;
        let entry = |(at, value)| Self { value, path: format!("{}[{at}]", self.path) };
        Ok(list.iter().enumerate().map(entry).collect())
    }

    /// So many numbers.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f32; N], Refusal> {
        let allowed = format!("a list of {N} numbers");
        let list = self.list(&allowed)?;
        let numbers = list.iter().map(Self::number).collect::<Result<Vec<f32>, _>>()?;
        numbers
            .try_into()
            .map_err(|_| self.refused(Kind::Malformed, format!("has {} entries", list.len()), allowed))
    }

    pub(super) fn number(&self) -> Result<f32, Refusal> {
        self.value.as_f64().map(|number| number as f32).ok_or_else(|| self.of_another_kind("a number"))
    }

    /// A whole number up to a bound.
    pub(super) fn whole(&self, most: u32) -> Result<u32, Refusal> {
        let whole = self.value.as_u64().and_then(|number| u32::try_from(number).ok());
        let allowed = || format!("a whole number from 0 to {most}");
        let whole = whole.ok_or_else(|| self.of_another_kind(&allowed()))?;
        if whole > most {
            Err(self.refused(Kind::OutOfRange, format!("is {whole}"), allowed()))
        } else {
            Ok(whole)
        }
    }

    pub(super) fn text(&self) -> Result<&'a str, Refusal> {
        self.value.as_str().ok_or_else(|| self.of_another_kind("a text"))
    }

    /// A mark that stands only where it is true.
    pub(super) fn mark(&self) -> Result<(), Refusal> {
        if self.value == &Value::Bool(true) {
            Ok(())
        } else {
            Err(self.of_another_kind("true, or no such field"))
        }
    }
}

impl<'a> Object<'a> {
    /// A field that may be missing.
    pub(super) fn field(&self, name: &str) -> Option<Json<'a>> {
        self.fields.get(name).map(|value| Json { value, path: joined(&self.path, name) })
    }

    /// A field that may be missing, or null.
    pub(super) fn given(&self, name: &str) -> Option<Json<'a>> {
        self.field(name).filter(|json| !json.value.is_null())
    }

    /// A field that must be there.
    pub(super) fn needed(&self, name: &str, allowed: &str) -> Result<Json<'a>, Refusal> {
        let missing = || Refusal::missing(&joined(&self.path, name), Some(allowed.to_owned()));
        self.field(name).ok_or_else(missing)
    }

    /// All fields.
    pub(super) fn fields(&self) -> impl Iterator<Item = (&'a str, Json<'a>)> {
        self.fields
            .iter()
            .map(|(name, value)| (name.as_str(), Json { value, path: joined(&self.path, name) }))
    }

    pub(super) fn len(&self) -> usize {
        self.fields.len()
    }
}
