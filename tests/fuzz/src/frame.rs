//! Binary frames, as a client reads them.

use espalier_proto::{BendFrame, ChunkChange, Frame, GhostFrame, RowMotion, Rows, Values, frame::CHUNK_ROWS};

/// Reads a mesh delta, a bend frame or a ghost; what can be read is the same when it is written and read again.
pub fn read(bytes: &[u8]) -> bool {
    let frame = Frame::decode(bytes);
    let bend = BendFrame::decode(bytes);
    let ghost = GhostFrame::decode(bytes);
    let taken = frame.is_ok() || bend.is_ok() || ghost.is_ok();
    if let Ok(frame) = frame {
        assert_eq!(Frame::decode(&frame.encode()), Ok(frame));
    }
    if let Ok(bend) = bend {
        assert_eq!(BendFrame::decode(&bend.encode()), Ok(bend));
    }
    if let Ok(ghost) = ghost {
        assert_eq!(GhostFrame::decode(&ghost.encode()), Ok(ghost));
    }
    taken
}

/// A few of each kind, packed and plain.
pub fn seeds() -> Vec<Vec<u8>> {
    let rows = |count: usize| Rows {
        parent: (0..count as u32).map(|row| 2 * row.min(1)).collect(),
        position: (0..count as i32).map(|row| [row % 7 - 3, 256, row]).collect(),
        radius: (0..count as u16).map(|row| 400 - row).collect(),
        foliage: (0..count).map(|row| row as u8).collect(),
        light: (0..count).map(|row| 255 - row as u8).collect(),
        born: (0..count as u32).map(|row| row / 3).collect(),
    };
    let changes = vec![
        ChunkChange::Truncate { rows: 300 },
        ChunkChange::Replace { chunk: 0, generation: 3, rows: rows(CHUNK_ROWS) },
        ChunkChange::Append { chunk: 1, generation: 4, start: 3, rows: rows(5) },
        ChunkChange::Patch { chunk: 0, generation: 4, rows: vec![1, 9], values: Values::Light(vec![8, -20]) },
        ChunkChange::Patch {
            chunk: 0,
            generation: 4,
            rows: vec![2],
            values: Values::Position(vec![[1, -2, 3]]),
        },
        ChunkChange::Patch { chunk: 0, generation: 4, rows: vec![0], values: Values::Radius(vec![300]) },
    ];
    let motion = RowMotion { row: 4, rotation: [0.0, 0.0, 0.0, 1.0], to: [1.0, 2.5, -0.25] };
    let frame = |catch_up, changes: &[ChunkChange]| {
        Frame { epoch: 7, sequence: 4, catch_up, changes: changes.to_vec() }.encode()
    };
    let few = vec![ChunkChange::Append { chunk: 0, generation: 4, start: 0, rows: rows(3) }];
    let ghost = GhostFrame { epoch: 7, sequence: 2, changes: few.clone() };
    vec![
        frame(false, &[]),
        frame(false, &few),
        frame(true, &changes),
        frame(false, &changes[3..]),
        BendFrame { epoch: 7, sequence: 1, bend: 3, motions: vec![motion; 2] }.encode(),
        BendFrame { epoch: 7, sequence: 2, bend: 3, motions: Vec::new() }.encode(),
        ghost.encode(),
    ]
}
