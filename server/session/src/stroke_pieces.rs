//! A brush's path cut into the pieces that guide single steps (`CM6`).

use espalier_growth::BrushSample;

/// Steps one movement of the brush runs at most.
const MAX_STEPS: u32 = 16;

/// As many pieces as a path is long in shoots of `longest` internodes; the path has a place at least.
pub(crate) fn pieces(path: Vec<BrushSample>, longest: u32) -> Vec<Vec<BrushSample>> {
    let length: f32 = path.windows(2).map(|pair| pair[0].position.distance(pair[1].position)).sum();
    let steps = ((length / longest as f32).ceil() as u32).clamp(1, MAX_STEPS);
    cut(&path, length, steps)
}

/// Cuts a path into `parts` pieces of equal length; each begins where the one before ends.
fn cut(path: &[BrushSample], length: f32, parts: u32) -> Vec<Vec<BrushSample>> {
    let mut pieces = Vec::with_capacity(parts as usize);
    let mut piece = vec![path[0]];
    let mut gone = 0.0;
    for pair in path.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let span = from.position.distance(to.position);
        loop {
            let border = length * (pieces.len() + 1) as f32 / parts as f32;
            if pieces.len() as u32 + 1 >= parts || gone + span < border || span <= 0.0 {
                break;
            }
            let t = ((border - gone) / span).clamp(0.0, 1.0);
            let at = BrushSample {
                position: from.position.lerp(to.position, t),
                radius: from.radius + (to.radius - from.radius) * t,
            };
            piece.push(at);
            pieces.push(std::mem::replace(&mut piece, vec![at]));
        }
        gone += span;
        piece.push(to);
    }
    pieces.push(piece);
    pieces
}
