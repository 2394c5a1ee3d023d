//! The samples in `golden/` are what the encoder writes; the client's tests read the same files.
//!
//! After a deliberate change of the format: `UPDATE_GOLDEN=1 cargo test -p espalier-proto --test golden`.

use std::{fs, path::PathBuf};

use espalier_proto::{
    BendFrame, ChunkChange, DeviceNews, Frame, GhostFrame, PointerNews, PointerPlace, PresenceFrame,
    RowMotion, Rows, Values,
    frame::{CHUNK_ROWS, direction},
    presence_frame::{ALONG_STEPS, PLACE_STEPS, RADIUS_STEPS},
};
use serde_json::{Value, json};

/// A seed, a trunk of three metamers and a lateral, in so few bytes that they travel raw.
fn sapling() -> Rows {
    Rows {
        parent: vec![0, 2, 2, 2, 5],
        position: vec![[0, 0, 0], [3, 256, -2], [-4, 255, 0], [0, 256, 1], [180, 181, -128]],
        radius: vec![0, 460, 440, 392, 392],
        foliage: vec![0x00, 0x00, 0x73, 0xf3, 0x93],
        light: vec![0, 120, 180, 255, 210],
        born: vec![0, 1, 1, 2, 4],
    }
}

fn raw() -> Frame {
    Frame { catch_up: true, ..packed() }
}

/// The same where somebody draws, packed by models.
fn packed() -> Frame {
    let rows = sapling();
    Frame {
        epoch: 7,
        sequence: 1,
        catch_up: false,
        changes: vec![ChunkChange::Append { chunk: 0, generation: 1, start: 0, rows }],
    }
}

/// One change of each kind, with gaps and numbers of all lengths, packed by models.
fn packed_all() -> Frame {
    let rows: Vec<u8> = (0..=255).filter(|row| row % 7 < 3 && row % 11 != 5).collect();
    let patch =
        |chunk, values: Values| ChunkChange::Patch { chunk, generation: 4, rows: rows.clone(), values };
    let waves = |count: usize| (0..count as u32).map(|i| (i * i * 37 % 251) as u8).collect::<Vec<_>>();
    let mut farthest = sapling();
    farthest.position[2] = [i32::MIN, i32::MAX, 1 << 20];
    farthest.position[3] = [i32::MAX, i32::MIN, -1];
    farthest.born[4] = u32::MAX;
    Frame {
        epoch: 7,
        sequence: 4,
        catch_up: false,
        changes: vec![
            ChunkChange::Truncate { rows: u32::MAX },
            ChunkChange::Replace { chunk: 9, generation: u32::MAX, rows: farthest },
            ChunkChange::Append { chunk: 3, generation: 4, start: 17, rows: sapling() },
            patch(2, Values::Radius((0..rows.len() as i32).map(|i| i * i % 97 - 40).collect())),
            patch(2, Values::Foliage(waves(rows.len()))),
            patch(u32::MAX, Values::Light((0..rows.len() as i32).map(|i| i * i % 63 - 31).collect())),
        ],
    }
}

/// A full chunk, and the first rows of the next; long enough to be deflated.
fn catch_up() -> Frame {
    let zigzag_of_the_axis = |i: usize| if i.is_multiple_of(2) { 9 } else { -9 };
    let full = Rows {
        parent: (0..CHUNK_ROWS).map(|i| if i == 0 { 0 } else { 2 + u32::from(i % 16 == 0) }).collect(),
        position: (0..CHUNK_ROWS)
            .map(|i| if i == 0 { [0; 3] } else { [zigzag_of_the_axis(i), 250, i as i32 - 128] })
            .collect(),
        radius: (0..CHUNK_ROWS).map(|i| if i == 0 { 0 } else { 700 - i as u16 }).collect(),
        foliage: (0..CHUNK_ROWS).map(|i| (i % 256) as u8).collect(),
        light: (0..CHUNK_ROWS).map(|i| (255 - i) as u8).collect(),
        born: (0..CHUNK_ROWS).map(|i| (i as u32).div_ceil(9)).collect(),
    };
    let next = Rows {
        parent: vec![2, 513],
        position: vec![[i32::from(i16::MAX), -1, 1], [i32::MIN, i32::MAX, 0]],
        radius: vec![u16::MAX, 1],
        foliage: vec![0xff, 0x0f],
        light: vec![255, 1],
        // They rise along a plant; the format holds any.
        born: vec![u32::MAX, 300],
    };
    Frame {
        epoch: u32::MAX,
        sequence: 4_000_000_000,
        catch_up: true,
        changes: vec![
            ChunkChange::Replace { chunk: 0, generation: 3_999_999_999, rows: full },
            ChunkChange::Replace { chunk: 1, generation: 4_000_000_000, rows: next },
        ],
    }
}

fn truncate() -> Frame {
    Frame {
        epoch: 7,
        sequence: 9,
        catch_up: false,
        changes: vec![
            ChunkChange::Truncate { rows: 3 },
            ChunkChange::Append {
                chunk: 0,
                generation: 9,
                start: 3,
                rows: Rows {
                    parent: vec![2],
                    position: vec![[-12, 240, 60]],
                    radius: vec![392],
                    foliage: vec![0x83],
                    light: vec![200],
                    born: vec![5],
                },
            },
        ],
    }
}

/// One patch of each column.
fn patches() -> Frame {
    let patch = |rows: Vec<u8>, values| ChunkChange::Patch { chunk: 2, generation: 130, rows, values };
    Frame {
        epoch: 1,
        sequence: 130,
        catch_up: false,
        changes: vec![
            patch(vec![0, 255], Values::Parent(vec![0, 513])),
            patch(vec![4, 5, 9], Values::Position(vec![[0, -1, 1], [64, -64, 128], [-100_000, 100_000, 0]])),
            patch((0..=255).collect(), Values::Radius((0..256).map(|i| i % 7 - 300).collect())),
            patch(vec![17], Values::Foliage(vec![0x40])),
            patch(vec![100, 200], Values::Light(vec![-31, 2])),
            patch(vec![0, 1, 7], Values::Born(vec![129, 129, 4000])),
            patch(
                vec![3, 4, 9],
                Values::Organs(vec![Some(vec![0x0003_ff80, 0x8000_0000]), None, Some(vec![])]),
            ),
        ],
    }
}

fn empty() -> Frame {
    Frame { epoch: 0, sequence: 0, catch_up: true, changes: Vec::new() }
}

fn described(frame: &Frame) -> Value {
    json!({
        "epoch": frame.epoch,
        "sequence": frame.sequence,
        "catch_up": frame.catch_up,
        "changes": frame.changes.iter().map(described_change).collect::<Vec<_>>(),
    })
}

fn described_change(change: &ChunkChange) -> Value {
    match change {
        ChunkChange::Truncate { rows } => json!({ "change": "truncate", "rows": rows }),
        ChunkChange::Replace { chunk, generation, rows } => {
            json!({ "change": "replace", "chunk": chunk, "generation": generation, "rows": described_rows(rows) })
        }
        ChunkChange::Append { chunk, generation, start, rows } => json!({
            "change": "append", "chunk": chunk, "generation": generation, "start": start, "rows": described_rows(rows),
        }),
        ChunkChange::Patch { chunk, generation, rows, values } => {
            let (column, values) = match values {
                Values::Parent(v) => ("parent", json!(v)),
                Values::Position(v) => ("position", json!(v)),
                Values::Radius(v) => ("radius", json!(v)),
                Values::Foliage(v) => ("foliage", json!(v)),
                Values::Light(v) => ("light", json!(v)),
                Values::Born(v) => ("born", json!(v)),
                Values::Organs(v) => ("organs", json!(v)),
            };
            json!({
                "change": "patch", "chunk": chunk, "generation": generation, "rows": rows,
                "column": column, "values": values,
            })
        }
    }
}

fn described_rows(rows: &Rows) -> Value {
    json!({
        "parent": rows.parent,
        "position": rows.position,
        "radius": rows.radius,
        "foliage": rows.foliage,
        "light": rows.light,
        "born": rows.born,
    })
}

fn described_bend(frame: &BendFrame) -> Value {
    let motion = |m: &RowMotion| json!({ "row": m.row, "rotation": m.rotation, "to": m.to });
    json!({
        "epoch": frame.epoch,
        "sequence": frame.sequence,
        "bend": frame.bend,
        "motions": frame.motions.iter().map(motion).collect::<Vec<_>>(),
    })
}

fn described_ghost(ghost: &GhostFrame) -> Value {
    json!({
        "epoch": ghost.epoch,
        "sequence": ghost.sequence,
        "changes": ghost.changes.iter().map(described_change).collect::<Vec<_>>(),
    })
}

/// In internode lengths, as clients have it.
fn described_place(steps: &[i32; 3]) -> Value {
    json!(steps.map(|step| f64::from(step) / f64::from(PLACE_STEPS)))
}

fn described_presence(frame: &PresenceFrame) -> Value {
    let devices = frame.devices.iter().map(|news| {
        let mut device = json!({ "device": news.device });
        if let Some(PointerNews { place, radius }) = &news.pointer {
            let place = match place {
                PointerPlace::Nowhere => json!({ "kind": "nowhere" }),
                PointerPlace::Wood { row, along, offset } => json!({
                    "kind": "wood",
                    "row": row,
                    "along": f64::from(*along) / f64::from(ALONG_STEPS),
                    "offset": described_place(offset),
                }),
                PointerPlace::Space(position) => {
                    json!({ "kind": "space", "position": described_place(position) })
                }
            };
            let radius = f64::from(*radius) / f64::from(RADIUS_STEPS);
            device["pointer"] = json!({ "place": place, "radius": radius });
        }
        if let Some(sketch) = &news.sketch {
            device["sketch"] = sketch.iter().map(described_place).collect();
        }
        if let Some(camera) = &news.camera {
            device["camera"] = json!(camera);
        }
        device
    });
    json!({ "epoch": frame.epoch, "sequence": frame.sequence, "devices": devices.collect::<Vec<_>>() })
}

/// The stored bytes are what the encoder writes, and the stored description what they mean.
fn check_sample(name: &str, encoded: &[u8], description: &Value) {
    let file = |extension: &str| {
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.{extension}"))
    };
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(file("bin"), encoded).expect("the sample can be written");
        fs::write(file("json"), format!("{description}\n")).expect("the description can be written");
    }
    let bytes = fs::read(file("bin")).expect("the sample can be read");
    assert_eq!(bytes, encoded, "{name}.bin is what the encoder writes");
    let stored = fs::read_to_string(file("json")).expect("the description can be read");
    let stored: Value = serde_json::from_str(&stored).expect("the description is JSON");
    let written: Value = serde_json::from_str(&description.to_string()).expect("so is this one");
    assert_eq!(stored, written, "{name}.json");
}

fn check(name: &str, frame: &Frame) {
    assert_eq!(Frame::decode(&frame.encode()).as_ref(), Ok(frame), "{name}");
    check_sample(name, &frame.encode(), &described(frame));
}

fn check_bend(name: &str, frame: &BendFrame) {
    assert_eq!(BendFrame::decode(&frame.encode()).as_ref(), Ok(frame), "{name}");
    check_sample(name, &frame.encode(), &described_bend(frame));
}

fn check_ghost(name: &str, ghost: &GhostFrame) {
    assert_eq!(GhostFrame::decode(&ghost.encode()).as_ref(), Ok(ghost), "{name}");
    check_sample(name, &ghost.encode(), &described_ghost(ghost));
}

fn check_presence(name: &str, frame: &PresenceFrame) {
    assert_eq!(PresenceFrame::decode(&frame.encode()).as_ref(), Ok(frame), "{name}");
    check_sample(name, &frame.encode(), &described_presence(frame));
}

#[test]
fn a_short_body_travels_raw() {
    assert_eq!(raw().encode()[2], 0);
    check("raw", &raw());
}

#[test]
fn fr9_a_short_change_is_packed_by_models() {
    assert_eq!(packed().encode()[2], 2);
    check("packed", &packed());
    assert_eq!(packed_all().encode()[2], 2);
    check("packed-all", &packed_all());
}

#[test]
fn a_full_chunk_is_deflated_for_catching_up() {
    assert_eq!(catch_up().encode()[2..4], [1, 1]);
    check("catch-up", &catch_up());
}

#[test]
fn growth_goes_on_behind_a_truncation() {
    check("truncate", &truncate());
}

#[test]
fn every_column_can_be_patched() {
    check("patches", &patches());
}

/// Ways of metamers, straight on, aside, shorter, longer and back, by what is told of them.
#[test]
fn fr10_what_is_told_leads_where_a_metamer_ends() {
    let parents =
        [[0; 3], [0, 256, 0], [3, -255, 20], [148, 148, 148], [-200, 90, -131], [0, 30, -40], [900, 2, 1]];
    let ways = [
        [0, 256, 0],
        [0, -256, 1],
        [181, 181, 0],
        [-148, 147, 149],
        [12, 70, -3],
        [700, 40, -900],
        [5, 0, 0],
    ];
    let cases = parents.iter().flat_map(|parents| ways.iter().map(move |way| (parents, way)));
    let described = cases.flat_map(|(&parents, &way)| {
        [false, true].map(|goes_on| {
            let told = direction::tell(way, parents, goes_on);
            assert_eq!(direction::follow(told, parents, goes_on), way);
            json!({ "parents": parents, "goes_on": goes_on, "told": told, "way": way })
        })
    });
    let described = Value::Array(described.collect());
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/ways.json");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&file, format!("{described}\n")).expect("the examples can be written");
    }
    let stored = fs::read_to_string(file).expect("the examples can be read");
    assert_eq!(serde_json::from_str::<Value>(&stored).expect("they are JSON"), described);
}

#[test]
fn a_frame_may_change_nothing() {
    check("empty", &empty());
}

#[test]
fn be5_a_bend_frame_is_a_path_of_motions() {
    let motions = vec![
        RowMotion { row: 3, rotation: [0.0, 0.0, 0.0, 1.0], to: [0.5, 4.0, -0.25] },
        RowMotion { row: 300, rotation: [0.5, -0.5, 0.5, 0.5], to: [-1000.0, 1.0e-6, 3.5] },
    ];
    check_bend("bend", &BendFrame { epoch: 7, sequence: 12, bend: 130, motions });
}

#[test]
fn be5_a_bend_frame_without_motions_is_over() {
    check_bend("bend-over", &BendFrame { epoch: 7, sequence: 13, bend: 1, motions: Vec::new() });
}

#[test]
fn pd2_a_ghost_has_a_table_of_its_own() {
    let changes = vec![ChunkChange::Replace { chunk: 0, generation: 1, rows: sapling() }];
    check_ghost("ghost", &GhostFrame { epoch: 7, sequence: 1, changes });
}

#[test]
fn pd2_an_empty_ghost_is_none_any_more() {
    check_ghost("ghost-over", &GhostFrame { epoch: 7, sequence: 2, changes: Vec::new() });
}

#[test]
fn ps2_a_presence_frame_tells_what_is_new_of_each_device() {
    let brush = DeviceNews {
        device: 1,
        pointer: Some(PointerNews {
            place: PointerPlace::Wood { row: 1234, along: 128, offset: [3, -40, 511] },
            radius: 160,
        }),
        ..DeviceNews::default()
    };
    let lasso = DeviceNews {
        device: 2,
        pointer: Some(PointerNews { place: PointerPlace::Space([-32_000, 64, 0]), radius: 0 }),
        sketch: Some(vec![[-32, 64, 0], [0, 96, 1], [32_000, -320, -1]]),
        ..DeviceNews::default()
    };
    let camera = DeviceNews {
        device: 300,
        pointer: Some(PointerNews::default()),
        sketch: Some(Vec::new()),
        camera: Some([0.5, 12.25, -3.0, -90.0, 12.5, 60.0]),
    };
    let still = DeviceNews { device: 301, ..DeviceNews::default() };
    let devices = vec![brush.clone(), lasso, camera, still];
    check_presence("presence", &PresenceFrame { epoch: 7, sequence: 90, devices });
    let mut bytes = Vec::new();
    brush.write(&mut bytes);
    assert!(bytes.len() <= 15, "a pointer with its brush has {} bytes", bytes.len());
}
