//! A vertex in bytes: in 32-bit floats, or quantised (`KHR_mesh_quantization`) to less than half as many bytes.

use glam::{Vec2, Vec3, Vec4};

use crate::gltf::{BYTE, FLOAT, SHORT, UNSIGNED_BYTE, UNSIGNED_SHORT};
use crate::wind_weights::Weights;

/// The most bytes that a vertex has.
const MOST: usize = 88;

/// One vertex, lengths in internodes.
pub(super) struct Vertex {
    pub place: Vec3,
    pub normal: Vec3,
    pub tangent: Vec4,
    /// Upwards.
    pub uv: Vec2,
    /// Linear.
    pub colour: Vec3,
    /// Its place in a light map, upwards, where there is one.
    pub lit: Vec2,
    /// The bones it goes along with, and by which shares of 255, where there are any.
    pub bound: ([u16; 4], [u8; 4]),
    /// How it moves in the wind, where that is asked for.
    pub wind: Weights,
}

/// Where one attribute stands in the bytes of a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attribute {
    pub offset: usize,
    pub component_type: u32,
    pub shape: &'static str,
}

/// What lies where in the bytes of a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub place: Attribute,
    pub normal: Attribute,
    pub tangent: Attribute,
    pub uv: Attribute,
    pub colour: Attribute,
    pub lit: Option<Attribute>,
    /// Bones and their shares.
    pub bound: Option<[Attribute; 2]>,
    /// How far it goes with trunk and limb; its phase and how it flutters.
    pub wind: Option<[Attribute; 2]>,
    pub stride: usize,
}

const fn at(offset: usize, component_type: u32, shape: &'static str) -> Attribute {
    Attribute { offset, component_type, shape }
}

const PLAIN: Layout = Layout {
    place: at(0, FLOAT, "VEC3"),
    normal: at(12, FLOAT, "VEC3"),
    tangent: at(24, FLOAT, "VEC4"),
    uv: at(40, FLOAT, "VEC2"),
    colour: at(48, UNSIGNED_BYTE, "VEC4"),
    lit: None,
    bound: None,
    wind: None,
    stride: 52,
};
/// For places in an atlas, which are between 0 and 1.
const SMALL: Layout = Layout {
    place: at(0, SHORT, "VEC3"),
    normal: at(8, BYTE, "VEC3"),
    tangent: at(12, BYTE, "VEC4"),
    uv: at(16, UNSIGNED_SHORT, "VEC2"),
    colour: at(20, UNSIGNED_BYTE, "VEC4"),
    lit: None,
    bound: None,
    wind: None,
    stride: 24,
};
/// For bark, which repeats itself along a limb.
const SMALL_REPEATING: Layout =
    Layout { uv: at(16, FLOAT, "VEC2"), colour: at(24, UNSIGNED_BYTE, "VEC4"), stride: 28, ..SMALL };

impl Layout {
    pub(super) fn new(is_quantised: bool, repeats: bool) -> Self {
        match (is_quantised, repeats) {
            (false, _) => PLAIN,
            (true, false) => SMALL,
            (true, true) => SMALL_REPEATING,
        }
    }

    /// The same with places in a light map behind all others.
    pub(super) fn with_lightmap(self) -> Self {
        let is_small = self.place.component_type != FLOAT;
        let (component_type, bytes) = if is_small { (UNSIGNED_SHORT, 4) } else { (FLOAT, 8) };
        let lit = Some(at(self.stride, component_type, "VEC2"));
        Self { lit, stride: self.stride + bytes, ..self }
    }

    /// The same with bones behind all others.
    pub(super) fn with_bones(self) -> Self {
        let bones = at(self.stride, UNSIGNED_SHORT, "VEC4");
        let shares = at(self.stride + 8, UNSIGNED_BYTE, "VEC4");
        Self { bound: Some([bones, shares]), stride: self.stride + 12, ..self }
    }

    /// The same with how it moves in the wind behind all others.
    pub(super) fn with_wind(self) -> Self {
        let is_small = self.place.component_type != FLOAT;
        let (component_type, bytes) = if is_small { (UNSIGNED_SHORT, 4) } else { (FLOAT, 8) };
        let pair = [0, bytes].map(|beyond| at(self.stride + beyond, component_type, "VEC2"));
        Self { wind: Some(pair), stride: self.stride + 2 * bytes, ..self }
    }

    /// The bytes of a vertex whose `place` is in the units of its node, and the place as its accessor counts it.
    pub(super) fn encode(&self, vertex: &Vertex, place: Vec3) -> ([u8; MOST], Vec3) {
        let Vertex { normal, tangent, uv, colour, lit, .. } = vertex;
        let mut bytes = [0; MOST];
        let mut put = |attribute: Attribute, values: &[f32]| {
            let to = &mut bytes[attribute.offset..];
            for (i, &value) in values.iter().enumerate() {
                match attribute.component_type {
                    FLOAT => to[4 * i..4 * i + 4].copy_from_slice(&value.to_le_bytes()),
                    SHORT => {
                        to[2 * i..2 * i + 2].copy_from_slice(&(whole(value, i16::MAX) as i16).to_le_bytes())
                    }
                    UNSIGNED_SHORT => {
                        to[2 * i..2 * i + 2].copy_from_slice(&(whole(value, u16::MAX) as u16).to_le_bytes());
                    }
                    BYTE => to[i] = (whole(value, i8::MAX) as i8).cast_unsigned(),
                    _ => to[i] = whole(value, u8::MAX) as u8,
                }
            }
        };
        put(self.place, &place.to_array());
        put(self.normal, &normal.to_array());
        put(self.tangent, &tangent.to_array());
        put(self.uv, &[uv.x, 1.0 - uv.y]);
        if let Some(attribute) = self.lit {
            put(attribute, &[lit.x, 1.0 - lit.y]);
        }
        if let Some([far, flutter]) = self.wind {
            put(far, &[vertex.wind.trunk, vertex.wind.limb]);
            put(flutter, &[vertex.wind.phase, vertex.wind.flutter]);
        }
        put(self.colour, &colour.clamp(Vec3::ZERO, Vec3::ONE).extend(1.0).to_array());
        if let Some([bones, shares]) = self.bound {
            let (numbers, parts) = vertex.bound;
            for (i, number) in numbers.into_iter().enumerate() {
                bytes[bones.offset + 2 * i..][..2].copy_from_slice(&number.to_le_bytes());
            }
            bytes[shares.offset..][..4].copy_from_slice(&parts);
        }
        let counted =
            if self.place.component_type == FLOAT { place } else { place.map(|part| whole(part, i16::MAX)) };
        (bytes, counted)
    }
}

/// A number from -1 to 1 in steps of the largest one.
fn whole(value: f32, largest: impl Into<f32>) -> f32 {
    let largest = largest.into();
    (value.clamp(-1.0, 1.0) * largest).round()
}
