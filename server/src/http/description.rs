//! The description of the API: OpenAPI 3.1, made from the list of its addresses.

use std::{borrow::Cow, sync::LazyLock};

use axum::{http::header, response::IntoResponse};
use espalier_proto::{HttpProblem, PROBLEM_JSON};
use schemars::{JsonSchema, SchemaGenerator, generate::SchemaSettings};
use serde_json::{Map, Value, json};

use super::{
    addresses::{OF_SOCKETS, downloads, routes, sockets},
    keys,
};
use crate::access::{Action, cookie};

/// Writes a type's schema into a generator.
type SchemaOf = fn(&mut SchemaGenerator) -> Value;

/// What is taken or given.
#[derive(Clone, Copy)]
enum Content {
    Json(SchemaOf),
    File(&'static str),
    Nothing,
}

/// What the description says of an address.
pub(super) struct About {
    does: Cow<'static, str>,
    asks: Option<SchemaOf>,
    /// Those of the options that there are.
    among: Option<&'static [&'static str]>,
    takes: Option<Content>,
    gives: Vec<(u16, Content)>,
    is_revised: bool,
    takes_keys: bool,
}

fn schema_of<T: JsonSchema>(generator: &mut SchemaGenerator) -> Value {
    generator.subschema_for::<T>().to_value()
}

impl About {
    /// Says in a sentence what is done there.
    pub fn new(does: impl Into<Cow<'static, str>>) -> Self {
        let (does, gives) = (does.into(), Vec::new());
        Self { does, asks: None, among: None, takes: None, gives, is_revised: false, takes_keys: false }
    }

    /// What may stand behind the question mark.
    pub fn asks<T: JsonSchema>(self) -> Self {
        Self { asks: Some(schema_of::<T>), ..self }
    }

    /// Whether nothing may.
    pub fn asks_nothing(&self) -> bool {
        self.asks.is_none()
    }

    /// Whether what is asked for has revisions.
    pub fn has_revisions(&self) -> bool {
        self.is_revised
    }

    /// Only these of the options.
    pub fn among(self, options: &'static [&'static str]) -> Self {
        Self { among: Some(options), ..self }
    }

    /// The body of the request.
    pub fn takes<T: JsonSchema>(self) -> Self {
        Self { takes: Some(Content::Json(schema_of::<T>)), ..self }
    }

    /// The body of the request is a file.
    pub fn takes_file(self, media_type: &'static str) -> Self {
        Self { takes: Some(Content::File(media_type)), ..self }
    }

    /// The body of an answer with this status.
    pub fn gives<T: JsonSchema>(self, status: u16) -> Self {
        self.answers(status, Content::Json(schema_of::<T>))
    }

    /// The answer is a file.
    pub fn gives_file(self, media_type: &'static str) -> Self {
        self.answers(200, Content::File(media_type))
    }

    /// The answer is a file, or a part of it (`RG1`).
    pub fn gives_parts(self, media_type: &'static str) -> Self {
        self.gives_file(media_type).answers(206, Content::File(media_type))
    }

    /// The answer has no body.
    pub fn gives_nothing(self) -> Self {
        self.answers(204, Content::Nothing)
    }

    /// The connection becomes a WebSocket.
    pub fn switches(self) -> Self {
        self.answers(101, Content::Nothing)
    }

    /// It may be asked for with `If-Match` (`LB2`).
    pub fn revised(self) -> Self {
        Self { is_revised: true, ..self }
    }

    fn answers(mut self, status: u16, content: Content) -> Self {
        self.gives.push((status, content));
        self
    }

    /// The options that may stand behind the question mark, each with its schema and whether it must be there.
    fn options(&self, generator: &mut SchemaGenerator) -> Vec<(String, Value, bool)> {
        let Some(asks) = self.asks else { return Vec::new() };
        let schema = asks(generator);
        let required = schema["required"].as_array().cloned().unwrap_or_default();
        let options = schema["properties"].as_object().into_iter().flatten();
        let options =
            options.filter(|(name, _)| self.among.is_none_or(|among| among.contains(&name.as_str())));
        options
            .map(|(name, schema)| (name.clone(), without_null(schema), required.contains(&json!(name))))
            .collect()
    }
}

/// All addresses in the order of the list, each with what is said of it.
fn all() -> Vec<(String, Option<Action>, About)> {
    let listed = routes().into_iter().chain(downloads());
    let listed = listed.map(|route| {
        let about = About { takes_keys: route.takes_keys(), ..route.about };
        (route.address.into_owned(), route.action, about)
    });
    let sockets = sockets().map(|socket| (socket.address.to_owned(), Some(OF_SOCKETS), socket.about));
    listed.chain(sockets).collect()
}

/// The description's text.
fn document() -> String {
    let mut settings = SchemaSettings::draft2020_12();
    settings.definitions_path = "/components/schemas".into();
    let mut generator = settings.into_generator();
    let problem = schema_of::<HttpProblem>(&mut generator);
    let mut paths = Map::new();
    for (address, _, about) in all() {
        let (method, path) = address.split_once(' ').unwrap_or(("GET", &address));
        let operation = operation(method, path, &about, &mut generator);
        let at = paths.entry(path).or_insert_with(|| json!({}));
        at[method.to_lowercase()] = operation;
    }
    let description = "Everything the page does without a socket. PROTOCOL.md has the rules that the descriptions \
                       name (LB3, EX1).";
    let document = json!({
        "openapi": "3.1.0",
        "info": { "title": "Espalier", "version": env!("CARGO_PKG_VERSION"), "description": description },
        "servers": [{ "url": "/" }],
        "security": [{}, { "device": [] }, { "token": [] }],
        "paths": paths,
        "components": {
            "schemas": generator.take_definitions(true),
            "responses": { "Problem": {
                "description": "What is wrong, as RFC 9457 has it, with code, reason, field and what is allowed there (ER1).",
                "content": { PROBLEM_JSON: { "schema": problem } },
            } },
            "securitySchemes": {
                "device": {
                    "type": "apiKey",
                    "in": "cookie",
                    "name": cookie::NAME,
                    "description": "A device that was invited (AC3); behind the name stand `-` and the port of the address, if it has one. Nothing is needed at the machine itself (AC1).",
                },
                "token": { "type": "http", "scheme": "bearer", "description": "A token of a program (AC6)." },
            },
        },
    });
    // Plain values always have a JSON form.
    serde_json::to_string_pretty(&document).unwrap_or_default() + "\n"
}

fn operation(method: &str, path: &str, about: &About, generator: &mut SchemaGenerator) -> Value {
    let parts =
        path.split(['/', '.', '{', '}']).filter(|part| !part.is_empty() && !["api", "v1"].contains(part));
    let name = parts.clone().fold(method.to_lowercase(), |name, part| format!("{name}_{part}"));
    let mut content = |content: Content| match content {
        Content::Json(schema) => json!({ "application/json": { "schema": schema(generator) } }),
        Content::File(media_type) => json!({ media_type: {} }),
        Content::Nothing => json!({}),
    };
    let mut responses = Map::new();
    responses.insert("default".into(), json!({ "$ref": "#/components/responses/Problem" }));
    for &(status, given) in &about.gives {
        let mut response = json!({ "description": about.does, "content": content(given) });
        if about.is_revised && status != 204 {
            let schema = json!({ "type": "string" });
            response["headers"]["ETag"] =
                json!({ "description": "The tree's revision (LB2).", "schema": schema });
        }
        responses.insert(status.to_string(), response);
    }
    let taken = about.takes.map(|taken| json!({ "required": true, "content": content(taken) }));
    let mut parameters: Vec<Value> = path
        .split(['{', '}'])
        .skip(1)
        .step_by(2)
        .map(|name| {
            let kind = if ["version", "obstacle", "seed"].contains(&name) { "integer" } else { "string" };
            json!({ "name": name, "in": "path", "required": true, "schema": { "type": kind } })
        })
        .collect();
    if about.is_revised {
        let description = "The revision that is changed; another one is refused with 412 (LB2).";
        let schema = json!({ "type": "string" });
        parameters.push(
            json!({ "name": "If-Match", "in": "header", "description": description, "schema": schema }),
        );
    }
    if about.takes_keys {
        let schema = json!({ "type": "string", "minLength": 1, "maxLength": keys::LONGEST });
        let description = "The same request with the same key is answered again and not done again (IK1).";
        let name = "Idempotency-Key";
        parameters
            .push(json!({ "name": name, "in": "header", "description": description, "schema": schema }));
    }
    if about.gives.iter().any(|(status, _)| *status == 206) {
        let schema = json!({ "type": "string" });
        let description = "A part of the file, as bytes=FROM-TO (RG1).";
        parameters
            .push(json!({ "name": "Range", "in": "header", "description": description, "schema": schema }));
    }
    for (name, mut schema, is_required) in about.options(generator) {
        let description = schema.as_object_mut().and_then(|schema| schema.remove("description"));
        parameters.push(json!({
            "name": name,
            "in": "query",
            "required": is_required,
            "description": description.unwrap_or_else(|| name.clone().into()),
            "schema": schema,
        }));
    }
    let tag = parts.clone().next().unwrap_or_default();
    let mut operation = json!({
        "operationId": name,
        "tags": [tag],
        "summary": about.does,
        "parameters": parameters,
        "responses": responses,
    });
    if let Some(taken) = taken {
        operation["requestBody"] = taken;
    }
    operation
}

/// What is not asked for is left out, and never null.
fn without_null(schema: &Value) -> Value {
    let mut schema = schema.clone();
    if schema["default"].is_null() {
        schema.as_object_mut().map(|schema| schema.remove("default"));
    }
    if let Some(of_value) = schema["type"].as_array().and_then(|types| types.first()).cloned() {
        schema["type"] = of_value;
    }
    match schema.get_mut("anyOf").and_then(Value::as_array_mut) {
        Some(either) if !either.is_empty() => either.swap_remove(0),
        _ => schema,
    }
}

/// `GET /api/v1/openapi.json`.
pub(super) async fn show() -> impl IntoResponse {
    static DOCUMENT: LazyLock<String> = LazyLock::new(document);
    ([(header::CONTENT_TYPE, "application/json")], DOCUMENT.as_str())
}

#[cfg(test)]
mod tests {
    use std::{fs, path::Path};

    use super::*;

    const BEGIN: &str = "<!-- addresses -->\n";
    const END: &str = "<!-- /addresses -->\n";

    /// How the table names what is taken or given.
    fn named(content: Content, generator: &mut SchemaGenerator) -> String {
        let schema = match content {
            Content::Json(schema) => schema(generator),
            Content::File(media_type) => return media_type.to_owned(),
            Content::Nothing => return String::new(),
        };
        let (reference, list) = match &schema["$ref"] {
            Value::Null => (&schema["items"]["$ref"], "[]"),
            reference => (reference, ""),
        };
        let name = reference.as_str().and_then(|path| path.rsplit('/').next()).unwrap_or("JSON");
        format!("`{name}{list}`")
    }

    /// The table of `PROTOCOL.md`: what each address does, takes and gives.
    fn table() -> String {
        let mut generator = SchemaGenerator::default();
        let mut table =
            "| address | does | least role | body; query | answer |\n|---|---|---|---|---|\n".to_owned();
        for (address, action, about) in all() {
            let given = about.gives.iter().map(|&(status, content)| match (status, content) {
                (status, Content::Nothing) => status.to_string(),
                (200, content) => named(content, &mut generator),
                (status, content) => format!("{} ({status})", named(content, &mut generator)),
            });
            let given = given.collect::<Vec<_>>().join(" or ");
            let options = about.options(&mut generator).into_iter().map(|(name, ..)| format!("`{name}`"));
            let options = options.collect::<Vec<_>>().join(", ");
            let taken = about.takes.map(|taken| named(taken, &mut generator));
            let taken = taken.into_iter().chain(Some(options).filter(|all| !all.is_empty()));
            let taken = taken.collect::<Vec<_>>().join("; ");
            let role = action.map_or("anybody", |action| action.least().name());
            table += &format!("| `{address}` | {} | {role} | {taken} | {given} |\n", about.does);
        }
        table
    }

    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier description`.
    #[test]
    fn the_description_is_kept_beside_the_protocol() {
        let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("../proto");
        let protocol = fs::read_to_string(home.join("PROTOCOL.md")).unwrap();
        let (before, rest) = protocol.split_once(BEGIN).unwrap();
        let (_, after) = rest.split_once(END).unwrap();
        for (name, wanted) in
            [("openapi.json", document()), ("PROTOCOL.md", format!("{before}{BEGIN}{}{END}{after}", table()))]
        {
            if std::env::var_os("UPDATE_GOLDEN").is_some() {
                fs::write(home.join(name), &wanted).unwrap();
            }
            let found = fs::read_to_string(home.join(name)).unwrap_or_default();
            assert!(found == wanted, "{name} is out of date: run this test with UPDATE_GOLDEN=1");
        }
    }

    #[test]
    fn every_reference_leads_somewhere() {
        let document: Value = serde_json::from_str(&document()).unwrap();
        let text = document.to_string();
        for part in text.split("\"$ref\":\"#").skip(1) {
            let pointer = part.split('"').next().unwrap();
            assert!(document.pointer(pointer).is_some(), "{pointer}");
        }
        let mut names: Vec<&str> =
            text.split("\"operationId\":\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "each operation has a name of its own");
    }
}
