//! Keys of animations: as few and as short as what they carry allows.

use std::collections::BTreeMap;

use espalier_motion::clips::Clip;
use glam::{DQuat, DVec3, DVec4};

use super::{vertex::Attribute, writer::Writer};
use crate::{
    ExportError,
    gltf::{FLOAT, SHORT, Sampler},
};

/// The largest number of 16 bits, which stands for 1.
const WHOLE: f64 = 32767.0;
/// By so much at most numbers of 16 bits turn what they should not, radians: each is wrong by half a step at most.
const WRONG: f64 = 6e-5;

/// The keys of one clip, of which each channel keeps every so many-th: the largest step that divides the clip, so that its
/// end stays, and between whose keys the even way misses none of those left out.
pub(super) struct Keys<'c> {
    clip: &'c Clip,
    steps: Vec<usize>,
    bytes: Vec<u8>,
    made: Vec<Made>,
    /// The list of times of each step.
    times: BTreeMap<usize, usize>,
    /// Times and values of each channel.
    samplers: Vec<[usize; 2]>,
}

struct Made {
    offset: usize,
    component_type: u32,
    shape: &'static str,
    count: usize,
    /// The last of a list of times.
    last: Option<f32>,
}

impl<'c> Keys<'c> {
    pub(super) fn of(clip: &'c Clip) -> Self {
        let last = clip.keys.len().saturating_sub(1).max(1);
        let steps = (1..=last).rev().filter(|step| last.is_multiple_of(*step)).collect();
        let (bytes, made, times, samplers) = Default::default();
        Self { clip, steps, bytes, made, times, samplers }
    }

    /// A channel of turns, wrong by so many radians at most.
    pub(super) fn turns(&mut self, turns: &[DQuat], near: f64) {
        let is_short = WRONG < 0.5 * near;
        let near = if is_short { near - WRONG } else { near };
        let parts: Vec<DVec4> = turns.iter().map(|&turn| turn.into()).collect();
        // A chord between turns is half as long as the angle.
        let step = self.step(&parts, |from, to, share| from.lerp(to, share).normalize(), 0.5 * near);
        let kept = parts.iter().step_by(step).flat_map(|turn| turn.to_array());
        if is_short {
            let bytes = kept.flat_map(|part| ((part * WHOLE).round() as i16).to_le_bytes()).collect();
            self.channel(step, bytes, SHORT, "VEC4");
        } else {
            let bytes = kept.flat_map(|part| (part as f32).to_le_bytes()).collect();
            self.channel(step, bytes, FLOAT, "VEC4");
        }
    }

    /// A channel of places, wrong by so many metres at most.
    pub(super) fn places(&mut self, places: &[DVec3], near: f64) {
        let step = self.step(places, DVec3::lerp, near);
        let kept = places.iter().step_by(step).flat_map(|place| place.as_vec3().to_array());
        let bytes = kept.flat_map(f32::to_le_bytes).collect();
        self.channel(step, bytes, FLOAT, "VEC3");
    }

    fn step<T: Distance>(&self, values: &[T], between: impl Fn(T, T, f64) -> T, near: f64) -> usize {
        let last = values.len() - 1;
        let restores = |step: usize| {
            values.iter().enumerate().all(|(key, &value)| {
                let from = key / step * step;
                let to = (from + step).min(last);
                let share = (key - from) as f64 / step as f64;
                between(values[from], values[to], share).distance(value) <= near
            })
        };
        self.steps.iter().copied().find(|&step| step == 1 || restores(step)).unwrap_or(1)
    }

    fn channel(&mut self, step: usize, bytes: Vec<u8>, component_type: u32, shape: &'static str) {
        let count = (self.clip.keys.len() - 1) / step + 1;
        let times = self.times.get(&step).copied().unwrap_or_else(|| {
            let times: Vec<f32> = (0..count).map(|key| self.clip.time(key * step) as f32).collect();
            let bytes = times.iter().flat_map(|time| time.to_le_bytes()).collect();
            let made = self.make(bytes, FLOAT, "SCALAR", count);
            self.made[made].last = times.last().copied();
            self.times.insert(step, made);
            made
        });
        let values = self.make(bytes, component_type, shape, count);
        self.samplers.push([times, values]);
    }

    fn make(&mut self, bytes: Vec<u8>, component_type: u32, shape: &'static str, count: usize) -> usize {
        self.made.push(Made { offset: self.bytes.len(), component_type, shape, count, last: None });
        self.bytes.extend(bytes);
        self.made.len() - 1
    }

    /// Writes all of them, one view for all channels.
    pub(super) fn finish(self, writer: &mut Writer<'_>) -> Result<Vec<Sampler>, ExportError> {
        let view = writer.whole_view(&self.bytes, None)?;
        let accessors: Vec<usize> = self
            .made
            .iter()
            .map(|&Made { offset, component_type, shape, count, last }| {
                let attribute = Attribute { offset, component_type, shape };
                let accessor = writer.accessor(view, attribute, component_type == SHORT, count);
                if let Some(last) = last {
                    let timed = &mut writer.root.accessors[accessor];
                    (timed.min, timed.max) = (Some(vec![0.0]), Some(vec![last]));
                }
                accessor
            })
            .collect();
        let sampler =
            |[input, output]: [usize; 2]| Sampler { input: accessors[input], output: accessors[output] };
        Ok(self.samplers.into_iter().map(sampler).collect())
    }
}

trait Distance: Copy {
    fn distance(self, other: Self) -> f64;
}

impl Distance for DVec3 {
    fn distance(self, other: Self) -> f64 {
        self.distance(other)
    }
}

impl Distance for DVec4 {
    fn distance(self, other: Self) -> f64 {
        self.distance(other)
    }
}
