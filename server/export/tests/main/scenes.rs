//! OBJ and USD have the triangles that glTF has.

use std::{collections::BTreeMap, io::Read};

use espalier_export::{About, Detail, ExportError, Model, Sink, in_memory};
use espalier_mesh::Style;
use espalier_plant::Plant;
use espalier_settings::{Appearance, ParameterValues};
use flate2::read::DeflateDecoder;

use crate::{METRES, glb, looks, reader, saplings, style};

type Format = fn(&Plant, &Style, &Appearance, &About<'_>, &Model, &mut dyn Sink) -> Result<(), ExportError>;

fn file(format: Format, model: &Model) -> Vec<u8> {
    let parameters = ParameterValues { internode_length: METRES, ..ParameterValues::default() };
    let about = About {
        program: "Espalier",
        simulation: 1,
        species: Some("Sour \"cherry\""),
        seed: Some(7),
        parameters: &parameters,
        obstacles: &[],
        author: Some("Ada\n}"),
        licence: None,
    };
    in_memory(|out| format(&saplings::fork(), &style(), &looks(), &about, model, out)).expect("it exports")
}

/// The members of a ZIP file by its own list, each with where its data begin.
pub fn members(zip: &[u8]) -> BTreeMap<String, (usize, Vec<u8>)> {
    let half = |at: usize| usize::from(u16::from_le_bytes([zip[at], zip[at + 1]]));
    let word = |at: usize| u32::from_le_bytes(zip[at..at + 4].try_into().expect("four bytes")) as usize;
    let end = zip.len() - 22;
    assert_eq!(&zip[end..end + 4], b"PK\x05\x06");
    let mut at = word(end + 16);
    let mut found = BTreeMap::new();
    for _ in 0..half(end + 10) {
        assert_eq!(&zip[at..at + 4], b"PK\x01\x02");
        let (method, sum, kept, size) = (half(at + 10), word(at + 16), word(at + 20), word(at + 24));
        let start = word(at + 42);
        let name = String::from_utf8(zip[at + 46..at + 46 + half(at + 28)].to_vec()).expect("a name");
        assert_eq!(
            (&zip[start..start + 4], half(start + 8), word(start + 14), word(start + 18), word(start + 22)),
            (&b"PK\x03\x04"[..], method, sum, kept, size)
        );
        let begin = start + 30 + half(start + 26) + half(start + 28);
        let mut data = zip[begin..begin + kept].to_vec();
        if method == 8 {
            let packed = std::mem::take(&mut data);
            DeflateDecoder::new(&packed[..]).read_to_end(&mut data).expect("deflated data");
        } else {
            assert_eq!(method, 0, "{name} is stored");
        }
        assert_eq!((data.len(), crc32fast::hash(&data) as usize), (size, sum), "{name}");
        found.insert(name, (begin, data));
        at += 46 + half(at + 28) + half(at + 30) + half(at + 32);
    }
    found
}

#[test]
fn an_obj_file_has_the_triangles_of_the_glb() {
    let members = members(&file(espalier_export::obj, &Model { hull: true, ..Model::default() }));
    let text = |name: &str| String::from_utf8(members[name].1.clone()).expect("text");
    let (obj, mtl) = (text("tree.obj"), text("tree.mtl"));
    let lines = |kind: &str| obj.lines().filter(|line| line.starts_with(kind)).count();
    let meshes = reader::read(&glb(&saplings::fork(), &style(), &looks(), METRES).expect("it exports"));
    let triangles: usize = meshes.iter().map(|mesh| mesh.indices.len() / 3).sum();
    assert_eq!(lines("vt "), meshes.iter().map(|mesh| mesh.positions.len()).sum::<usize>());
    let hull = lines("f ") - triangles;
    assert!(hull >= 8 && lines("v ") - lines("vt ") == 3 * hull, "{hull}");
    for index in obj.lines().filter_map(|line| line.strip_prefix("f ")).flat_map(str::split_whitespace) {
        let place: usize = index.split('/').next().and_then(|place| place.parse().ok()).expect("a number");
        assert!((1..=lines("v ")).contains(&place));
    }
    assert!(obj.contains("mtllib tree.mtl") && obj.contains("usemtl Leaves") && obj.contains("# Ada }"));
    for map in
        mtl.lines().filter(|line| line.starts_with("map_")).filter_map(|line| line.split(' ').next_back())
    {
        assert!(members[map].1.starts_with(b"\x89PNG"), "{map}");
    }
}

#[test]
fn usd_has_the_triangles_of_the_glb_and_its_package_is_aligned() {
    let plain = String::from_utf8(file(espalier_export::usda, &Model::default())).expect("text");
    let packed = members(&file(espalier_export::usdz, &Model::default()));
    assert!(packed.values().all(|(start, _)| start % 64 == 0));
    let text = String::from_utf8(packed["tree.usda"].1.clone()).expect("text");
    let meshes = reader::read(&glb(&saplings::fork(), &style(), &looks(), METRES).expect("it exports"));
    for usd in [&plain, &text] {
        let counts = usd.lines().filter_map(|line| line.strip_prefix("int[] faceVertexCounts = ["));
        let counts: Vec<usize> = counts.map(|list| list.split(", ").count()).collect();
        assert_eq!(counts, meshes.iter().map(|mesh| mesh.indices.len() / 3).collect::<Vec<_>>());
        assert!(usd.contains("def Xform \"Sour__cherry_\""));
    }
    assert!(!plain.contains("primvars:st1"));
    let lit = Model { lightmap: Some(512), ..Model::default() };
    let lit = String::from_utf8(file(espalier_export::usda, &lit)).expect("text");
    let lists = |name: &str| -> Vec<usize> {
        let lines = lit.lines().filter(|line| line.starts_with(name));
        lines.map(|line| line.matches('(').count()).collect()
    };
    // The array of places, and the mark of what it is for each vertex, end with a bracket each.
    let places = lists("texCoord2f[] primvars:st1 = [");
    assert_eq!(places.iter().map(|count| count - 1).collect::<Vec<_>>(), lists("point3f[] points = ["));
    assert_eq!(lit.matches("dictionary lightmap = {").count(), meshes.len());
    assert!(!plain.contains(".png"));
    for name in text.split('@').filter(|name| name.ends_with(".png")) {
        assert!(packed[name].1.starts_with(b"\x89PNG"), "{name}");
    }
    // The same layer and textures as files of their own.
    let unpacked = members(&file(espalier_export::usda_zip, &Model::default()));
    let contents = |of: &BTreeMap<String, (usize, Vec<u8>)>| -> Vec<(String, Vec<u8>)> {
        of.iter().map(|(name, (_, data))| (name.clone(), data.clone())).collect()
    };
    assert!(contents(&unpacked) == contents(&packed));
    let far = Model { detail: Detail::Level(Detail::BILLBOARD), ..Model::default() };
    let far = members(&file(espalier_export::usdz, &far));
    let text = String::from_utf8(far["tree.usda"].1.clone()).expect("text");
    assert!(text.contains("def Shader \"Depth\"") && far.contains_key("billboard_depth.png"));
    let instanced = file(espalier_export::usda, &Model { instanced: true, ..Model::default() });
    let instanced = String::from_utf8(instanced).expect("text");
    assert!(
        instanced.contains("def PointInstancer \"Leaves\"")
            && instanced.matches("def Mesh \"Leaf").count().is_multiple_of(8)
    );
}

#[test]
fn text_in_zip_files_is_deflated_and_pictures_are_stored() {
    for format in [espalier_export::obj as Format, espalier_export::usda_zip] {
        let zip = file(format, &Model::default());
        let members = members(&zip);
        let [pictures, text] = [true, false].map(|is_picture| -> usize {
            let of = members.iter().filter(|(name, _)| name.ends_with(".png") == is_picture);
            of.map(|(_, (_, data))| data.len()).sum()
        });
        assert!(zip.len() > pictures && zip.len() < pictures + text / 2, "{} {pictures} {text}", zip.len());
        for (begin, data) in members.values().filter(|(_, data)| data.starts_with(b"\x89PNG")) {
            assert_eq!(&zip[*begin..begin + data.len()], data);
            assert_eq!(begin % 64, 0);
        }
    }
}
