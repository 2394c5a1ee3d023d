//! Where the depths of a grammar lie on the line of time.

use std::sync::Arc;

use super::Written;
use crate::document::Document;

impl Document {
    /// How many steps back, and forth, the line of time leads through depths of a grammar one by one.
    pub(super) fn depths_around(&self, written: &Arc<Written>) -> (u32, u32) {
        if written.step != self.plant().step() {
            return (0, 0);
        }
        let noted: Vec<&Arc<Written>> =
            self.history.states.iter().filter_map(|mark| mark.state.written.0.as_ref()).collect();
        let Some(here) = noted.iter().rposition(|of| Arc::ptr_eq(of, written)) else { return (0, 0) };
        let pairs: Vec<_> = noted.iter().zip(&noted[1..]).collect();
        let follows = |&&(one, next): &&(&&Arc<Written>, &&Arc<Written>)| {
            Arc::ptr_eq(&one.source, &next.source) && (next.depth, next.step) == (one.depth + 1, one.step + 1)
        };
        let is_other = |&&(one, next): &&(&&Arc<Written>, &&Arc<Written>)| !Arc::ptr_eq(one, next);
        let (before, after) = pairs.split_at(here);
        let earlier = before.iter().rev().filter(is_other).take_while(follows).count();
        let later = after.iter().filter(is_other).take_while(follows).count();
        (earlier as u32, later as u32)
    }
}
