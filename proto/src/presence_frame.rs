//! Where people point and what they see, as bytes (`PS2`).

use crate::{
    envelope::{self, FrameError, FrameKind, Header},
    varint,
};

/// Steps of places, to the internode.
pub const PLACE_STEPS: f32 = 32.0;
/// Steps of a brush's radius, to the internode.
pub const RADIUS_STEPS: f32 = 64.0;
/// Steps of the way along a metamer.
pub const ALONG_STEPS: f32 = 255.0;

/// What is new of the devices in a session.
#[derive(Clone, Debug, PartialEq)]
pub struct PresenceFrame {
    /// As in mesh deltas.
    pub epoch: u32,
    /// Rises from frame to frame.
    pub sequence: u32,
    /// Those of whom anything is new, by their numbers.
    pub devices: Vec<DeviceNews>,
}

/// What is new of one device; the rest stays as it was.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceNews {
    /// Its number, as in `people`.
    pub device: u32,
    /// Where it points.
    pub pointer: Option<PointerNews>,
    /// What is being drawn there, in steps of 1/32 internode; empty where nothing is.
    pub sketch: Option<Vec<[i32; 3]>>,
    /// What it shows: target, yaw, pitch, distance ([`crate::presence::Camera`]).
    pub camera: Option<[f32; 6]>,
}

/// Where a device points, and with how wide a brush.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PointerNews {
    /// Where.
    pub place: PointerPlace,
    /// The radius of the brush, in steps of 1/64 internode; 0 for none.
    pub radius: u32,
}

/// Where a device points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PointerPlace {
    /// Nowhere.
    #[default]
    Nowhere,
    /// On wood.
    Wood {
        /// The metamer's row.
        row: u32,
        /// How far along it, in steps of 1/255.
        along: u8,
        /// From there along h, u and w (`LF1`), in steps of 1/32 internode.
        offset: [i32; 3],
    },
    /// Anywhere else, in steps of 1/32 internode.
    Space([i32; 3]),
}

const NOWHERE: u8 = 0;
const WOOD: u8 = 1;
const SPACE: u8 = 2;

const POINTER: u8 = 1;
const SKETCH: u8 = 2;
const CAMERA: u8 = 4;

impl PresenceFrame {
    /// The frame as bytes.
    pub fn encode(&self) -> Vec<u8> {
        let mut body = Vec::new();
        varint::write(&mut body, self.devices.len() as u32);
        self.devices.iter().for_each(|device| device.write(&mut body));
        let header = Header { flags: 0, epoch: self.epoch, sequence: self.sequence };
        envelope::seal(FrameKind::Presence, header, &body)
    }

    /// Reads a frame; any bytes at all give a frame of finite numbers or an error.
    pub fn decode(bytes: &[u8]) -> Result<Self, FrameError> {
        let (Header { epoch, sequence, .. }, body) = envelope::open_plain(bytes, FrameKind::Presence)?;
        let mut body = &*body;
        let count = read_varint(&mut body)?;
        let devices = (0..count).map(|_| DeviceNews::read(&mut body)).collect::<Result<_, _>>()?;
        if body.is_empty() { Ok(Self { epoch, sequence, devices }) } else { Err(FrameError::Body) }
    }
}

impl DeviceNews {
    /// Appends the device as it stands in a frame.
    pub fn write(&self, out: &mut Vec<u8>) {
        varint::write(out, self.device);
        let parts = [
            (self.pointer.is_some(), POINTER),
            (self.sketch.is_some(), SKETCH),
            (self.camera.is_some(), CAMERA),
        ];
        out.push(parts.into_iter().filter(|(is_there, _)| *is_there).map(|(_, part)| part).sum());
        if let Some(PointerNews { place, radius }) = self.pointer {
            match place {
                PointerPlace::Nowhere => out.push(NOWHERE),
                PointerPlace::Wood { row, along, offset } => {
                    out.push(WOOD);
                    varint::write(out, row);
                    out.push(along);
                    write_steps(out, offset);
                }
                PointerPlace::Space(position) => {
                    out.push(SPACE);
                    write_steps(out, position);
                }
            }
            varint::write(out, radius);
        }
        if let Some(sketch) = &self.sketch {
            varint::write(out, sketch.len() as u32);
            let mut before = [0; 3];
            for &point in sketch {
                write_steps(out, [0, 1, 2].map(|axis| point[axis].wrapping_sub(before[axis])));
                before = point;
            }
        }
        for number in self.camera.iter().flatten() {
            out.extend_from_slice(&number.to_le_bytes());
        }
    }

    fn read(bytes: &mut &[u8]) -> Result<Self, FrameError> {
        let device = read_varint(bytes)?;
        let parts = read_byte(bytes)?;
        if parts & !(POINTER | SKETCH | CAMERA) != 0 {
            return Err(FrameError::Body);
        }
        let mut news = Self { device, ..Self::default() };
        if parts & POINTER != 0 {
            let place = match read_byte(bytes)? {
                NOWHERE => PointerPlace::Nowhere,
                WOOD => {
                    let (row, along) = (read_varint(bytes)?, read_byte(bytes)?);
                    PointerPlace::Wood { row, along, offset: read_steps(bytes)? }
                }
                SPACE => PointerPlace::Space(read_steps(bytes)?),
                _ => return Err(FrameError::Body),
            };
            news.pointer = Some(PointerNews { place, radius: read_varint(bytes)? });
        }
        if parts & SKETCH != 0 {
            let count = read_varint(bytes)?;
            let mut before = [0i32; 3];
            let mut next = |_| {
                let step = read_steps(bytes)?;
                before = [0, 1, 2].map(|axis| before[axis].wrapping_add(step[axis]));
                Ok(before)
            };
            news.sketch = Some((0..count).map(&mut next).collect::<Result<_, _>>()?);
        }
        if parts & CAMERA != 0 {
            let mut camera = [0.0; 6];
            for number in &mut camera {
                *number = read_float(bytes)?;
            }
            news.camera = Some(camera);
        }
        Ok(news)
    }
}

fn write_steps(out: &mut Vec<u8>, steps: [i32; 3]) {
    steps.into_iter().for_each(|step| varint::write(out, varint::zigzag(step)));
}

fn read_byte(bytes: &mut &[u8]) -> Result<u8, FrameError> {
    let (&byte, rest) = bytes.split_first().ok_or(FrameError::Truncated)?;
    *bytes = rest;
    Ok(byte)
}

fn read_varint(bytes: &mut &[u8]) -> Result<u32, FrameError> {
    varint::read(bytes).ok_or(FrameError::Truncated)
}

fn read_steps(bytes: &mut &[u8]) -> Result<[i32; 3], FrameError> {
    let mut next = || read_varint(bytes).map(varint::unzigzag);
    Ok([next()?, next()?, next()?])
}

fn read_float(bytes: &mut &[u8]) -> Result<f32, FrameError> {
    let (value, rest) = bytes.split_first_chunk().ok_or(FrameError::Truncated)?;
    *bytes = rest;
    let value = f32::from_le_bytes(*value);
    if value.is_finite() { Ok(value) } else { Err(FrameError::Body) }
}
