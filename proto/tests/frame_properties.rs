//! Frames survive the journey, and no bytes at all bring the decoder down.

use espalier_proto::{
    BendFrame, ChunkChange, DeviceNews, Frame, FrameError, GhostFrame, PointerNews, PointerPlace,
    PresenceFrame, RowMotion, Rows, Values,
    frame::{CHUNK_ROWS, HEADER_BYTES},
    varint,
};
use proptest::{collection::vec, prelude::*, sample::subsequence};

fn positions(count: usize) -> impl Strategy<Value = Vec<[i32; 3]>> {
    vec(prop_oneof![4 => prop::array::uniform3(-300..300), 1 => any::<[i32; 3]>()], count)
}

fn rows(counts: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = Rows> {
    counts.prop_flat_map(|n| {
        (
            vec(any::<u32>(), n),
            positions(n),
            vec(any::<u16>(), n),
            vec(any::<u8>(), n),
            vec(any::<u8>(), n),
            vec(any::<u32>(), n),
        )
            .prop_map(|(parent, position, radius, foliage, light, born)| Rows {
                parent,
                position,
                radius,
                foliage,
                light,
                born,
            })
    })
}

fn patched() -> impl Strategy<Value = (Vec<u8>, Values)> {
    let all: Vec<u8> = (0..=255).collect();
    subsequence(all, 1..=CHUNK_ROWS).prop_flat_map(|rows| {
        let n = rows.len();
        let values = prop_oneof![
            vec(any::<u32>(), n).prop_map(Values::Parent),
            positions(n).prop_map(Values::Position),
            vec(any::<i32>(), n).prop_map(Values::Radius),
            vec(any::<u8>(), n).prop_map(Values::Foliage),
            vec(-31..=31, n).prop_map(Values::Light),
            vec(any::<u32>(), n).prop_map(Values::Born),
            vec(proptest::option::of(vec(0u32..3 << 30, 0..=15)), n).prop_map(Values::Organs),
        ];
        (Just(rows), values)
    })
}

fn change() -> impl Strategy<Value = ChunkChange> {
    prop_oneof![
        any::<u32>().prop_map(|rows| ChunkChange::Truncate { rows }),
        (any::<u32>(), any::<u32>(), rows(1..=CHUNK_ROWS))
            .prop_map(|(chunk, generation, rows)| ChunkChange::Replace { chunk, generation, rows }),
        (any::<u32>(), any::<u32>(), 0..CHUNK_ROWS as u32)
            .prop_flat_map(|(chunk, generation, start)| {
                (Just((chunk, generation, start)), rows(1..=CHUNK_ROWS - start as usize))
            })
            .prop_map(|((chunk, generation, start), rows)| ChunkChange::Append {
                chunk,
                generation,
                start,
                rows
            }),
        (any::<u32>(), any::<u32>(), patched()).prop_map(|(chunk, generation, (rows, values))| {
            ChunkChange::Patch { chunk, generation, rows, values }
        }),
    ]
}

fn frame() -> impl Strategy<Value = Frame> {
    (any::<u32>(), any::<u32>(), any::<bool>(), vec(change(), 0..6))
        .prop_map(|(epoch, sequence, catch_up, changes)| Frame { epoch, sequence, catch_up, changes })
}

fn finite() -> impl Strategy<Value = f32> {
    use prop::num::f32::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

fn bend_frame() -> impl Strategy<Value = BendFrame> {
    let motion = (any::<u32>(), prop::array::uniform4(finite()), prop::array::uniform3(finite()))
        .prop_map(|(row, rotation, to)| RowMotion { row, rotation, to });
    (any::<u32>(), any::<u32>(), any::<u32>(), vec(motion, 0..40))
        .prop_map(|(epoch, sequence, bend, motions)| BendFrame { epoch, sequence, bend, motions })
}

fn presence_frame() -> impl Strategy<Value = PresenceFrame> {
    let steps = || prop::array::uniform3(any::<i32>());
    let place = prop_oneof![
        Just(PointerPlace::Nowhere),
        (any::<u32>(), any::<u8>(), steps()).prop_map(|(row, along, offset)| PointerPlace::Wood {
            row,
            along,
            offset
        }),
        steps().prop_map(PointerPlace::Space),
    ];
    let pointer = (place, any::<u32>()).prop_map(|(place, radius)| PointerNews { place, radius });
    let camera = (prop::array::uniform3(finite()), prop::array::uniform3(finite()))
        .prop_map(|([a, b, c], [d, e, f])| [a, b, c, d, e, f]);
    let sketch = prop::option::of(vec(steps(), 0..40));
    let news = (any::<u32>(), prop::option::of(pointer), sketch, prop::option::of(camera))
        .prop_map(|(device, pointer, sketch, camera)| DeviceNews { device, pointer, sketch, camera });
    (any::<u32>(), any::<u32>(), vec(news, 0..20)).prop_map(|(epoch, sequence, devices)| PresenceFrame {
        epoch,
        sequence,
        devices,
    })
}

/// A valid header in front of any body at all: what is most likely to reach the depths of the decoder.
fn headed(body: &[u8]) -> Vec<u8> {
    headed_as_long_as(body.len() as u32, body)
}

/// The same in front of what models have packed.
fn packed(body: &[u8]) -> Vec<u8> {
    packed_as(0, body)
}

fn packed_as(sequence: u32, body: &[u8]) -> Vec<u8> {
    let mut bytes = vec![4, 1, 2, 0, 0, 0, 0, 0];
    varint::write(&mut bytes, sequence);
    varint::write(&mut bytes, body.len() as u32);
    bytes.extend_from_slice(body);
    bytes
}

fn headed_as_long_as(length: u32, body: &[u8]) -> Vec<u8> {
    let mut bytes = vec![4, 1, 0, 0, 0, 0, 0, 0, 0];
    varint::write(&mut bytes, length);
    bytes.extend_from_slice(body);
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn decode_undoes_encode(frame in frame()) {
        prop_assert_eq!(Frame::decode(&frame.encode()), Ok(frame));
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in vec(any::<u8>(), 0..600)) {
        // Few random bytes have a valid header; those that do not must say so.
        if bytes.get(..2) != Some(&[4, 1]) {
            prop_assert!(Frame::decode(&bytes).is_err());
        }
        let body = headed(&bytes);
        if let Ok(frame) = Frame::decode(&body) {
            prop_assert_eq!(Frame::decode(&frame.encode()), Ok(frame));
        }
    }

    #[test]
    fn fr9_any_packed_bytes_are_a_frame_or_an_error(bytes in vec(any::<u8>(), 0..600)) {
        if let Ok(frame) = Frame::decode(&packed(&bytes)) {
            prop_assert_eq!(Frame::decode(&frame.encode()), Ok(frame));
        }
    }

    #[test]
    fn fr9_a_packed_body_ends_where_it_says(mut frame in frame(), more in 1u8..) {
        frame.catch_up = false;
        let bytes = frame.encode();
        prop_assume!(bytes[2] == 2);
        let mut rest = &bytes[HEADER_BYTES..];
        prop_assert_eq!(varint::read(&mut rest), Some(frame.sequence));
        varint::read(&mut rest);
        let sequence = frame.sequence;
        let longer = [rest, &[0, 0, 0, 0, more]].concat();
        let longer = Frame::decode(&packed_as(sequence, &longer));
        prop_assert_eq!(longer, Err(FrameError::Length));
    }

    #[test]
    fn bend_frames_and_ghosts_survive_the_journey(frame in bend_frame(), changes in vec(change(), 0..3)) {
        prop_assert_eq!(BendFrame::decode(&frame.encode()), Ok(frame));
        let ghost = GhostFrame { epoch: 1, sequence: 2, changes };
        prop_assert_eq!(GhostFrame::decode(&ghost.encode()), Ok(ghost));
    }

    #[test]
    fn arbitrary_bend_frames_never_panic(bytes in vec(any::<u8>(), 0..80)) {
        let mut frame = headed(&bytes);
        frame[1] = 2;
        if let Ok(frame) = BendFrame::decode(&frame) {
            prop_assert_eq!(BendFrame::decode(&frame.encode()), Ok(frame));
        }
    }

    #[test]
    fn presence_frames_survive_the_journey(frame in presence_frame()) {
        prop_assert_eq!(PresenceFrame::decode(&frame.encode()), Ok(frame));
    }

    #[test]
    fn arbitrary_presence_frames_never_panic(bytes in vec(any::<u8>(), 0..80)) {
        let mut frame = headed(&bytes);
        frame[1] = 4;
        if let Ok(frame) = PresenceFrame::decode(&frame) {
            prop_assert_eq!(PresenceFrame::decode(&frame.encode()), Ok(frame));
        }
    }

    #[test]
    fn a_flipped_bit_is_an_error_or_another_frame(frame in frame(), at: prop::sample::Index, bit in 0..8u8) {
        let mut bytes = frame.encode();
        let at = at.index(bytes.len());
        bytes[at] ^= 1 << bit;
        if at < HEADER_BYTES {
            prop_assert_ne!(Frame::decode(&bytes), Ok(frame));
        } else if let Ok(other) = Frame::decode(&bytes) {
            prop_assert_eq!(Frame::decode(&other.encode()), Ok(other));
        }
    }

    #[test]
    fn a_frame_cut_short_is_an_error(frame in frame(), at: prop::sample::Index) {
        let bytes = frame.encode();
        prop_assert!(Frame::decode(&bytes[..at.index(bytes.len())]).is_err());
    }
}

#[test]
fn fr1_what_is_reserved_is_refused() {
    let valid = headed(&[]);
    let with = |at: usize, value: u8| {
        let mut bytes = valid.clone();
        bytes[at] = value;
        Frame::decode(&bytes)
    };
    assert!(Frame::decode(&valid).is_ok());
    assert_eq!(with(0, 2), Err(FrameError::Version(2)));
    assert_eq!(with(1, 0), Err(FrameError::Kind(0)));
    assert_eq!(with(1, 2), Err(FrameError::Kind(2)), "a bend frame is no mesh delta");
    assert_eq!(with(2, 3), Err(FrameError::Codec(3)));
    assert_eq!(with(3, 3), Err(FrameError::Flags(3)));
    assert_eq!(Frame::decode(&headed(&[9, 0, 0])), Err(FrameError::Body));
    assert_eq!(Frame::decode(&headed(&[4, 0, 0, 7, 1, 0, 0])), Err(FrameError::Body));
    assert_eq!(Frame::decode(&headed(&[4, 0, 0, 6, 1, 0, 17])), Err(FrameError::Body), "16 organs");
    assert_eq!(
        Frame::decode(&headed(&[4, 0, 0, 6, 1, 0, 2, 0, 0, 0, 192])),
        Err(FrameError::Body),
        "of no kind"
    );
}

#[test]
fn fr2_a_body_has_the_stated_length() {
    let mut longer = headed(&[1, 0]);
    longer.push(0);
    assert_eq!(Frame::decode(&longer), Err(FrameError::Length));
    assert_eq!(Frame::decode(&headed_as_long_as(u32::MAX, &[])), Err(FrameError::Length));
}

#[test]
fn fr1_flags_belong_to_mesh_deltas_alone() {
    let mut bytes = GhostFrame { epoch: 0, sequence: 0, changes: Vec::new() }.encode();
    assert!(GhostFrame::decode(&bytes).is_ok());
    bytes[3] = 1;
    assert_eq!(GhostFrame::decode(&bytes), Err(FrameError::Flags(1)));
    bytes[2..4].copy_from_slice(&[2, 0]);
    assert_eq!(GhostFrame::decode(&bytes), Err(FrameError::Codec(2)), "so does packing by models");
}

#[test]
fn fr1_a_bend_frame_holds_finite_numbers() {
    let at = |to| {
        let motions = vec![RowMotion { row: 1, rotation: [0.0, 0.0, 0.0, 1.0], to }];
        BendFrame::decode(&BendFrame { epoch: 0, sequence: 0, bend: 1, motions }.encode())
    };
    assert!(at([0.0; 3]).is_ok());
    assert_eq!(at([0.0, f32::NAN, 0.0]), Err(FrameError::Body));
    assert_eq!(at([f32::INFINITY, 0.0, 0.0]), Err(FrameError::Body));
}
