//! One triangle: where a ray meets it, and its nearest point.

use glam::{DVec3, Vec3};

/// How far beyond its edges a triangle still blocks, so that nothing slips between two of them.
const SEAM: f64 = 1.0e-6;

/// Three corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle(pub [Vec3; 3]);

/// What becomes of a ray that meets an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Edges {
    /// It is stopped, by both triangles of the edge.
    Belong,
    /// One side of an edge counts, so that passages can be counted.
    Split,
}

impl Triangle {
    /// The multiple of `along` at which a ray meets the triangle, from 0 on.
    pub(super) fn meets(&self, from: Vec3, along: Vec3, edges: Edges) -> Option<f64> {
        let [a, b, c] = self.0.map(|corner| corner.as_dvec3());
        let (from, along) = (from.as_dvec3(), along.as_dvec3());
        let (u_edge, v_edge) = (b - a, c - a);
        let p = along.cross(v_edge);
        let det = u_edge.dot(p);
        if det == 0.0 {
            return None;
        }
        let s = from - a;
        let u = s.dot(p) / det;
        let q = s.cross(u_edge);
        let v = along.dot(q) / det;
        let seam = if edges == Edges::Belong { SEAM } else { 0.0 };
        if u < -seam || v < -seam || u + v > 1.0 + seam {
            return None;
        }
        let t = v_edge.dot(q) / det;
        (t >= 0.0).then_some(t)
    }

    /// Unit normal; which way is up to the order of corners.
    pub(super) fn normal(&self) -> Vec3 {
        let [a, b, c] = self.0.map(|corner| corner.as_dvec3());
        (b - a).cross(c - a).normalize_or(DVec3::Y).as_vec3()
    }

    /// The point of the triangle nearest to a place (Ericson, Real-Time Collision Detection, §5.1.5).
    pub(super) fn nearest(&self, place: Vec3) -> Vec3 {
        let [a, b, c] = self.0;
        let (ab, ac, ap) = (b - a, c - a, place - a);
        let (d1, d2) = (ab.dot(ap), ac.dot(ap));
        if d1 <= 0.0 && d2 <= 0.0 {
            return a;
        }
        let bp = place - b;
        let (d3, d4) = (ab.dot(bp), ac.dot(bp));
        if d3 >= 0.0 && d4 <= d3 {
            return b;
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return a + ab * (d1 / (d1 - d3));
        }
        let cp = place - c;
        let (d5, d6) = (ab.dot(cp), ac.dot(cp));
        if d6 >= 0.0 && d5 <= d6 {
            return c;
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return a + ac * (d2 / (d2 - d6));
        }
        let va = d3 * d6 - d5 * d4;
        if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
            return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
        }
        let scale = 1.0 / (va + vb + vc);
        a + ab * (vb * scale) + ac * (vc * scale)
    }
}
