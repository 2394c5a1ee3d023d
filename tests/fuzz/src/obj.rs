//! Models of lines of text that become obstacles.

use crate::gltf::read_within_limits;

/// Reads an OBJ file; what it gives is within the limits, and every corner is there.
pub fn read(bytes: &[u8]) -> bool {
    read_within_limits(bytes)
}

/// A small file with all that is read, and one that must be simplified.
pub fn seeds() -> Vec<Vec<u8>> {
    let small = "# A model\nmtllib a.mtl\no House_LOD0\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1e-1 0\n\
        vn 0 0 1\nvt 0 0\nusemtl wall\ns off\nf 1/1/1 2/1/1 3//1 4\ng roof\nv 0 0 2.5\nf -1 1 2 \\\n 3 4\n\
        o House_LOD1\nf 1 2 3\no UCX_House\nf 1 2 3\nl 1 2\n";
    let mut large = String::new();
    for i in 0..200 {
        large += &format!("v {i} 0 0\nv {i} 1 0\nv {i} 0 1\nf -3 -2 -1\n");
    }
    vec![small.into(), large.into()]
}
