//! A layer as text, written as it comes.

use std::{
    fmt::Display,
    io::{self, Write},
};

use serde_json::{Map, Value as Json};

use super::{
    ROOT,
    layer::{Done, Head, Layer, Numbers, Prim, Row, Rows, Value, Variability},
};

pub(super) struct Text<'a>(&'a mut dyn Write);

impl<'a> Text<'a> {
    pub(super) fn begin(head: &Head<'_>, out: &'a mut dyn Write) -> io::Result<Self> {
        let doc = head.copyright.map(|said| format!("    doc = {}\n", quoted(said))).unwrap_or_default();
        write!(
            out,
            "#usda 1.0\n(\n{doc}    customLayerData = {{\n        string creator = {}\n        string espalier = {}\n    \
             }}\n    defaultPrim = \"{ROOT}\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n)\n\n",
            quoted(head.program),
            quoted(head.extras),
        )?;
        Ok(Self(out))
    }

    fn data(&mut self, data: &Map<String, Json>) -> io::Result<()> {
        for (name, value) in data {
            match value {
                Json::Object(inner) => {
                    writeln!(self.0, "dictionary {name} = {{")?;
                    self.data(inner)?;
                    writeln!(self.0, "}}")?;
                }
                value => {
                    let kind = if value.is_u64() { "int" } else { "double" };
                    writeln!(self.0, "{kind} {name} = {value}")?;
                }
            }
        }
        Ok(())
    }

    /// A list of what `fill` puts.
    fn list(
        &mut self,
        type_name: &str,
        name: &str,
        suffix: &str,
        fill: impl FnOnce(&mut dyn FnMut(&dyn Display) -> Done) -> Done,
    ) -> Done {
        write!(self.0, "{type_name} {name} = [")?;
        let mut between = "";
        fill(&mut |item| {
            write!(self.0, "{between}{item}")?;
            between = ", ";
            Ok(())
        })?;
        Ok(writeln!(self.0, "]{suffix}")?)
    }
}

impl Layer for Text<'_> {
    fn begin(&mut self, prim: Prim<'_>) -> Done {
        let Prim { type_name, name, is_group, apis, data } = prim;
        write!(self.0, "def {type_name} \"{name}\"")?;
        if is_group || !apis.is_empty() || !data.is_empty() {
            writeln!(self.0, " (")?;
            if is_group {
                writeln!(self.0, "kind = \"group\"")?;
            }
            if !apis.is_empty() {
                writeln!(self.0, "prepend apiSchemas = {apis:?}")?;
            }
            if !data.is_empty() {
                writeln!(self.0, "customData = {{")?;
                self.data(&data)?;
                writeln!(self.0, "}}")?;
            }
            write!(self.0, ")")?;
        }
        Ok(writeln!(self.0, "\n{{")?)
    }

    fn end(&mut self) -> Done {
        Ok(writeln!(self.0, "}}")?)
    }

    fn value(&mut self, variability: Variability, name: &str, value: &Value<'_>) -> Done {
        if variability == Variability::Uniform {
            write!(self.0, "uniform ")?;
        }
        write!(self.0, "{} {name} = ", value.type_name())?;
        match value {
            Value::Bool(is) => write!(self.0, "{}", u8::from(*is)),
            Value::Token(text) | Value::String(text) => write!(self.0, "{}", quoted(text)),
            Value::Tokens(tokens) => write!(self.0, "{tokens:?}"),
            Value::Asset(name) => write!(self.0, "@{name}@"),
            Value::Float(number) => write!(self.0, "{number}"),
            Value::Colour(row) | Value::Double3(row) => write!(self.0, "{}", joined(row)),
            Value::Float4(row) => write!(self.0, "{}", joined(row)),
            Value::Float3s(rows) => {
                let rows: Vec<String> = rows.iter().map(|row| joined(row)).collect();
                write!(self.0, "[{}]", rows.join(", "))
            }
        }?;
        Ok(writeln!(self.0)?)
    }

    fn connected(&mut self, type_name: &'static str, name: &str, target: &str) -> Done {
        Ok(writeln!(self.0, "{type_name} {name}.connect = <{target}>")?)
    }

    fn declared(&mut self, type_name: &'static str, name: &str) -> Done {
        Ok(writeln!(self.0, "{type_name} {name}")?)
    }

    fn related(&mut self, name: &str, targets: &[String], is_list: bool) -> Done {
        let targets: Vec<String> = targets.iter().map(|target| format!("<{target}>")).collect();
        let targets = targets.join(", ");
        Ok(if is_list {
            writeln!(self.0, "rel {name} = [{targets}]")
        } else {
            writeln!(self.0, "rel {name} = {targets}")
        }?)
    }

    fn rows(
        &mut self,
        row: Row,
        name: &str,
        is_vertex: bool,
        fill: &mut dyn FnMut(Rows<'_>) -> Done,
    ) -> Done {
        let suffix = if is_vertex { " (\ninterpolation = \"vertex\"\n)" } else { "" };
        self.list(row.type_name(), name, suffix, |put| fill(&mut |row| put(&joined(row))))
    }

    fn numbers(&mut self, name: &str, fill: &mut dyn FnMut(Numbers<'_>) -> Done) -> Done {
        self.list("int[]", name, "", |put| fill(&mut |number| put(&number)))
    }
}

/// A vector in parentheses.
fn joined(parts: &[f32]) -> String {
    let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
    format!("({})", parts.join(", "))
}

fn quoted(text: &str) -> String {
    Json::from(text.replace(['\n', '\r'], " ")).to_string()
}
