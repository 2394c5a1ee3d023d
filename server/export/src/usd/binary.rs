//! A layer in binary, by the crate `openusd`: held in memory until it is whole.

use std::{
    fmt::Display,
    io::{ErrorKind, SeekFrom},
};

use openusd::{
    gf::{Quath, Vec2f, Vec3f, f16},
    sdf::{self, ChildrenKey, Data, Dictionary, FieldKey, ListOp, Path, SpecType, Specifier, Value as Field},
    tf::Token,
    usdc::CrateWriter,
};
use serde_json::{Map, Value as Json};

use super::{
    ROOT,
    layer::{Done, Head, Layer, Numbers, Prim, Row, Rows, Value, Variability},
};
use crate::{ExportError, Sink};

/// What is said of each vertex.
const VERTEX: &str = "vertex";

/// A prim that is open, with the names of what is in it so far.
struct Open {
    path: Path,
    prims: Vec<Token>,
    properties: Vec<Token>,
}

pub(super) struct Binary {
    data: Data,
    /// The root and the prims that are open, the innermost last.
    open: Vec<Open>,
}

impl Binary {
    pub(super) fn begin(head: &Head<'_>) -> Self {
        let mut data = Data::new();
        let root = data.create_spec(Path::abs_root(), SpecType::PseudoRoot);
        root.add(FieldKey::DefaultPrim, Field::Token(ROOT.into()));
        root.add("metersPerUnit", Field::Double(1.0));
        root.add("upAxis", Field::Token("Y".into()));
        if let Some(said) = head.copyright {
            root.add(FieldKey::Documentation, Field::String(said.to_owned()));
        }
        let said = [("creator", head.program), ("espalier", head.extras)];
        let said = said.map(|(name, text)| (name.to_owned(), Field::String(text.to_owned())));
        root.add(FieldKey::CustomLayerData, Field::Dictionary(Dictionary::from(said)));
        let root = Open { path: Path::abs_root(), prims: Vec::new(), properties: Vec::new() };
        Self { data, open: vec![root] }
    }

    /// Writes what has ended, which is all.
    pub(super) fn write(mut self, mut out: &mut dyn Sink) -> Done {
        self.close();
        CrateWriter::write(&self.data, &mut out).map_err(|error| {
            match error.downcast::<std::io::Error>() {
                Ok(error) => error.into(),
                Err(_) => ExportError::TooLarge,
            }
        })?;
        out.seek(SeekFrom::End(0))?;
        Ok(out.flush()?)
    }

    fn innermost(&mut self) -> &mut Open {
        self.open.last_mut().expect("the root is open until the layer is written")
    }

    fn close(&mut self) {
        let Some(Open { path, prims, properties }) = self.open.pop() else { return };
        let Some(spec) = self.data.spec_mut(&path) else { return };
        if !properties.is_empty() {
            spec.add(ChildrenKey::PropertyChildren, Field::TokenVec(properties));
        }
        if !prims.is_empty() {
            spec.add(ChildrenKey::PrimChildren, Field::TokenVec(prims));
        }
    }

    fn property(
        &mut self,
        kind: SpecType,
        name: &str,
        fields: impl IntoIterator<Item = (FieldKey, Field)>,
    ) -> Done {
        let open = self.innermost();
        let path = open.path.append_property(name).map_err(unnamed)?;
        // An attribute that follows another may have been declared before.
        let name = Token::from(name);
        if !open.properties.contains(&name) {
            open.properties.push(name);
        }
        let spec = self.data.create_spec(path, kind);
        spec.add(FieldKey::Custom, Field::Bool(false));
        for (key, field) in fields {
            spec.add(key, field);
        }
        Ok(())
    }

    fn attribute(
        &mut self,
        variability: Variability,
        type_name: &'static str,
        name: &str,
        more: impl IntoIterator<Item = (FieldKey, Field)>,
    ) -> Done {
        let variability = match variability {
            Variability::Varying => sdf::Variability::Varying,
            Variability::Uniform => sdf::Variability::Uniform,
        };
        let known = [
            (FieldKey::TypeName, Field::Token(type_name.into())),
            (FieldKey::Variability, Field::Variability(variability)),
        ];
        self.property(SpecType::Attribute, name, known.into_iter().chain(more))
    }
}

impl Layer for Binary {
    fn begin(&mut self, prim: Prim<'_>) -> Done {
        let Prim { type_name, name, is_group, apis, data } = prim;
        let open = self.innermost();
        let path = open.path.append_path(name).map_err(unnamed)?;
        open.prims.push(name.into());
        let spec = self.data.create_spec(path.clone(), SpecType::Prim);
        spec.add(FieldKey::Specifier, Field::Specifier(Specifier::Def));
        spec.add(FieldKey::TypeName, Field::Token(type_name.into()));
        if is_group {
            spec.add(FieldKey::Kind, Field::Token("group".into()));
        }
        if !apis.is_empty() {
            let apis = apis.iter().map(|&api| Token::from(api));
            spec.add(FieldKey::ApiSchemas, Field::TokenListOp(ListOp::prepended(apis)));
        }
        if !data.is_empty() {
            spec.add(FieldKey::CustomData, Field::Dictionary(dictionary(&data)));
        }
        self.open.push(Open { path, prims: Vec::new(), properties: Vec::new() });
        Ok(())
    }

    fn end(&mut self) -> Done {
        self.close();
        Ok(())
    }

    fn value(&mut self, variability: Variability, name: &str, value: &Value<'_>) -> Done {
        let field = match value {
            Value::Bool(is) => Field::Bool(*is),
            Value::Token(text) => Field::Token((*text).into()),
            Value::Tokens(tokens) => Field::TokenVec(tokens.iter().map(|&token| token.into()).collect()),
            Value::String(text) => Field::String((*text).to_owned()),
            Value::Asset(name) => Field::AssetPath((*name).into()),
            Value::Float(number) => Field::Float(*number),
            Value::Colour(row) => Field::Vec3f((*row).into()),
            Value::Float4(row) => Field::Vec4f((*row).into()),
            Value::Double3(row) => Field::Vec3d(row.map(f64::from).into()),
            Value::Float3s(rows) => Field::Vec3fVec(rows.iter().map(|&row| row.into()).collect()),
        };
        self.attribute(variability, value.type_name(), name, [(FieldKey::Default, field)])
    }

    fn connected(&mut self, type_name: &'static str, name: &str, target: &str) -> Done {
        let target = Path::new(target).map_err(unnamed)?;
        let field = Field::PathListOp(ListOp::explicit([target]));
        self.attribute(Variability::Varying, type_name, name, [(FieldKey::ConnectionPaths, field)])
    }

    fn declared(&mut self, type_name: &'static str, name: &str) -> Done {
        self.attribute(Variability::Varying, type_name, name, [])
    }

    fn related(&mut self, name: &str, targets: &[String], _is_list: bool) -> Done {
        let targets: Result<Vec<Path>, _> = targets.iter().map(|target| Path::new(target)).collect();
        let field = Field::PathListOp(ListOp::explicit(targets.map_err(unnamed)?));
        let known = [
            (FieldKey::Variability, Field::Variability(sdf::Variability::Uniform)),
            (FieldKey::TargetPaths, field),
        ];
        self.property(SpecType::Relationship, name, known)
    }

    fn rows(
        &mut self,
        row: Row,
        name: &str,
        is_vertex: bool,
        fill: &mut dyn FnMut(Rows<'_>) -> Done,
    ) -> Done {
        let field = match row {
            Row::Place => Field::Vec2fVec(collect(fill, |[x, y]: [f32; 2]| Vec2f { x, y })?),
            Row::Rotation => Field::QuathVec(collect(fill, |row: [f32; 4]| {
                let [w, x, y, z] = row.map(f16::from_f32);
                Quath { w, x, y, z }
            })?),
            Row::Point | Row::Normal | Row::Colour | Row::Float3 => {
                Field::Vec3fVec(collect(fill, |[x, y, z]: [f32; 3]| Vec3f { x, y, z })?)
            }
        };
        let known = [(FieldKey::Default, field)];
        self.attribute(Variability::Varying, row.type_name(), name, known)?;
        if is_vertex && let Ok(path) = self.innermost().path.append_property(name) {
            let spec = self.data.spec_mut(&path).expect("it was made just now");
            spec.add("interpolation", Field::Token(VERTEX.into()));
        }
        Ok(())
    }

    fn numbers(&mut self, name: &str, fill: &mut dyn FnMut(Numbers<'_>) -> Done) -> Done {
        let mut numbers: Vec<i32> = Vec::new();
        fill(&mut |number| {
            numbers.push(i32::try_from(number).map_err(|_| ExportError::TooLarge)?);
            Ok(())
        })?;
        self.attribute(Variability::Varying, "int[]", name, [(FieldKey::Default, Field::IntVec(numbers))])
    }
}

/// All rows of a list, as the library has them.
fn collect<const N: usize, T>(
    fill: &mut dyn FnMut(Rows<'_>) -> Done,
    make: impl Fn([f32; N]) -> T,
) -> Result<Vec<T>, ExportError> {
    let mut all = Vec::new();
    fill(&mut |row| {
        let row = row.try_into().map_err(|_| ExportError::NotFinite)?;
        all.push(make(row));
        Ok(())
    })?;
    Ok(all)
}

/// No name that is written here is one that USD does not take.
fn unnamed(_: impl Display) -> ExportError {
    ExportError::Write(ErrorKind::InvalidInput)
}

fn dictionary(data: &Map<String, Json>) -> Dictionary {
    let field = |value: &Json| match value {
        Json::Object(inner) => Field::Dictionary(dictionary(inner)),
        value => match value.as_u64().and_then(|number| i32::try_from(number).ok()) {
            Some(number) => Field::Int(number),
            None => Field::Double(value.as_f64().unwrap_or_default()),
        },
    };
    data.iter().map(|(name, value)| (name.clone(), field(value))).collect()
}
