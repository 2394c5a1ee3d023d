//! OBJ files as programs write them, and as no program should.

use std::io::{Cursor, Write};

use espalier_import::{ImportError, Limits, Triangles, read_model};
use flate2::{Compression, write::DeflateEncoder};
use glam::Vec3;
use proptest::prelude::*;

const LIMITS: Limits = Limits { vertices: 400, triangles: 400, most_triangles: 60 };

fn read_file(bytes: &[u8]) -> Result<Triangles, ImportError> {
    read_model(&mut Cursor::new(bytes), &LIMITS).map(|model| model.triangles)
}

/// An OBJ file.
fn lines(text: &str) -> Result<Triangles, ImportError> {
    read_file(text.as_bytes())
}

#[test]
fn ob6_an_obj_file_gives_its_faces() {
    let square = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
    let vertices = "v 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 -0\n";
    for faces in [
        "f 1 2 3\nf 1 3 4",
        "f 1 2 3 4\n",
        "f -4 -3 -2 -1",
        "f 1/5 2/6/7 3//8 4\r\n",
        "g a b\nusemtl stone\ns 1\nf 1 \\\n2 3\\\n 4\nl 1 2\np 1\n# f 9 9 9\nunheard of\n",
        "\tf  1\t2 3 4   ",
    ] {
        let mesh = lines(&format!("# by hand\nmtllib a.mtl\n\n{vertices}{faces}")).expect("a mesh");
        assert_eq!(
            (&mesh.vertices[..], &mesh.corners[..]),
            (&square[..], &[[0, 1, 2], [0, 2, 3]][..]),
            "{faces}"
        );
    }
    assert_eq!(lines(&format!("\u{feff}{vertices}f 1 2 3")).map(|mesh| mesh.corners.len()), Ok(1));
    let concave = "v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n";
    assert_eq!(lines(concave).expect("a mesh").corners.len(), 4);
    let levels = format!("{vertices}o A_LOD0\nf 1 2 3\no A_LOD1\nf 2 3 4\no UCX_A\nf 3 4 1\no B\nf 1 3 4\n");
    assert_eq!(lines(&levels).expect("a mesh").corners, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn ob6_an_obj_file_is_refused_with_its_line() {
    for (text, line, allowed) in [
        ("v 0 0\n", 1, "three numbers"),
        ("v 0 0 0\n\nv 0 x 0\n", 3, "three numbers"),
        ("v 0 0 0\nv 0 NaN 0\n", 2, "finite numbers"),
        ("v 0 0 0\nv 0 -inf 0\n", 2, "finite numbers"),
        ("v 0 0 0\nv 0 1e99 0\n", 2, "finite numbers"),
        ("v 0 0 0\nf 1 1\n", 2, "at least three corners"),
        ("v 0 0 0\nf 1 1 2\n", 2, "1 to 1, or -1 to -1"),
        ("v 0 0 0\n# \\\nf 0 1 1\n", 3, "1 to 1, or -1 to -1"),
        ("v 0 0 0\nv 1 \\\n 0 0\nf -3 1 1\n", 4, "1 to 2, or -1 to -2"),
        ("v 0 0 0\nf 99999999999999999999 1 1\n", 2, "1 to 1, or -1 to -1"),
        ("v 0 0 0\nf -9223372036854775808 1 1\n", 2, "1 to 1, or -1 to -1"),
    ] {
        let refused = lines(text);
        let Err(ImportError::Line { line: at, allowed: may, .. }) = &refused else {
            panic!("{text}: {refused:?}")
        };
        assert_eq!((*at, may.as_str()), (line, allowed), "{text}");
    }
    let long = format!("v 0 0 0\nf {}", "1 ".repeat(200_000));
    assert!(matches!(lines(&long), Err(ImportError::Line { line: 2, .. })));
    assert!(matches!(lines(&"x".repeat(1 << 20)), Err(ImportError::NotModel(_))));
    assert_eq!(lines("v 0 0 0\nv 1 0 0\nl 1 2\n"), Err(ImportError::Empty));
    assert_eq!(lines("v 0 0 0\nf 1 1 1\n"), Err(ImportError::Empty));
    let many = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned() + &"f 1 2 3\n".repeat(61);
    assert_eq!(lines(&many), Err(ImportError::TooLarge(LIMITS)));
    assert_eq!(lines(&"v 0 0 0\n".repeat(181)), Err(ImportError::TooLarge(LIMITS)));
}

#[test]
fn ob6_of_zip_files_only_an_obj_that_comes_first_is_read() {
    let zip = |method: u16, name: &str, data: &[u8], size: usize| {
        let mut bytes = b"PK\x03\x04".to_vec();
        [10, 0, method, 0, 0].iter().for_each(|word: &u16| bytes.extend(word.to_le_bytes()));
        [0, data.len() as u32, size as u32].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
        [name.len() as u16, 4].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
        bytes.extend(name.bytes());
        bytes.extend([0; 4]);
        bytes.extend(data);
        bytes.extend(b"PK\x01\x02 and so on");
        bytes
    };
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let mut packed = DeflateEncoder::new(Vec::new(), Compression::best());
    packed.write_all(obj).expect("memory takes it");
    let packed = packed.finish().expect("memory takes it");
    let [whole, small] = [zip(0, "tree.OBJ", obj, obj.len()), zip(8, "tree.obj", &packed, obj.len())];
    assert_eq!(read_file(&whole), lines(str::from_utf8(obj).expect("text")));
    assert_eq!(read_file(&small), read_file(&whole));
    for other in [
        zip(1, "tree.obj", obj, obj.len()),
        zip(0, "tree.fbx", obj, obj.len()),
        zip(0, &"x".repeat(300), obj, obj.len()),
        zip(8, "tree.obj", &packed, 1 << 30),
    ] {
        assert!(matches!(read_file(&other), Err(ImportError::NotModel(_))));
    }
    // Data that are none, and more or fewer than is said.
    for broken in [
        zip(8, "tree.obj", obj, obj.len()),
        zip(8, "tree.obj", &packed, obj.len() - 1),
        zip(8, "tree.obj", &packed, obj.len() + 1),
    ] {
        assert!(matches!(read_file(&broken), Err(ImportError::Damaged(_))));
    }
    for file in [whole, small] {
        for end in 0..file.len() - 20 {
            assert!(read_file(&file[..end]).is_err(), "cut to {end}");
        }
    }
}

proptest! {
    #[test]
    fn any_lines_give_a_mesh_or_an_error(words in prop::collection::vec(
        prop_oneof!["v", "f", "o", "g", "\\n", "\\\\\\n", "-?[0-9]{1,20}", "[0-9.e+-]{1,8}", "nan", "[ -~]{0,6}", "1/2/3"], 0..60,
    )) {
        // What counts is that it returns.
        let _ = read_file(("v 0 0 0\n".to_owned() + &words.join(" ")).as_bytes());
    }
}
