//! Files of other programs, and files that are none.

use espalier_growth::{Parameters, transplant};
use espalier_import::{Fault, FaultKind, Place, Units, WoodFormat, WoodNote, WoodOptions, read_wood};
use espalier_plant::{MetamerId, Plant, Wood, checks};
use glam::Vec3;
use serde_json::{Value, json};

fn options() -> WoodOptions {
    WoodOptions {
        internode_length: Some(0.1),
        units: Units::of(1.0),
        shoot: 4,
        nodes: 10_000,
        extent: 1000.0,
    }
}

fn wood(format: WoodFormat, text: &str) -> Wood {
    let file = read_wood(format, text.as_bytes(), &options());
    file.unwrap_or_else(|fault| panic!("{fault}: {text}")).wood
}

fn planted(wood: &Wood) -> Plant {
    let plant = transplant(wood, &Parameters::default()).expect("it fits together");
    assert_eq!(checks::all(&plant), Ok(()));
    plant
}

fn fault(format: WoodFormat, text: &str) -> Fault {
    read_wood(format, text.as_bytes(), &options()).expect_err(text)
}

/// A trunk of 1 m and a branch of 0.5 m that begins half a metre up on its surface, as rTwig has them, from a scanner
/// that stood elsewhere.
const RTWIG: &str = "\
\"\",\"id\",\"parent\",\"start_x\",\"start_y\",\"start_z\",\"end_x\",\"end_y\",\"end_z\",\"radius\",\"length\",\"branch\",\"branch_order\"
\"1\",1,0,20,30,5,20,30,6,0.05,1,1,0
\"2\",2,1,20.1,30,5.5,20.6,30,5.5,0.02,0.5,2,1
\"3\",3,1,20,30,6,20,30.04,6.3,0.03,0.3026,1,0
";

/// With the length along an axis.
const ALONG: &str =
    "start.x,start.y,start.z,axis.x,axis.y,axis.z,length,radius,parent\n0,0,0,0,0,1,0.3,0.02,0\n";

#[test]
fn cylinders_become_internodes_from_the_origin_up() {
    let plant = planted(&wood(WoodFormat::Qsm, RTWIG));
    // The trunk 10 and 3; the branch 5, and the internode to where it begins.
    assert_eq!((plant.living_count(), plant.living_axes_count()), (13 + 6, 2));
    let ends: Vec<Vec3> =
        (0..plant.metamer_count()).map(|row| plant.metamers().end(MetamerId::new(row))).collect();
    assert_eq!(ends[0], Vec3::ZERO);
    for wanted in [[0.0, 10.0, 0.0], [1.0, 5.0, 0.0], [6.0, 5.0, 0.0], [0.0, 13.0, -0.4], [0.0, 5.0, 0.0]] {
        assert!(ends.iter().any(|end| end.distance(Vec3::from_array(wanted)) < 1e-5), "{wanted:?}");
    }
    let thick = |row| plant.given_radius(MetamerId::new(row));
    assert_eq!((thick(0), thick(1)), (None, Some(0.5)));
    // Without births all axes have grown as fast as buds may.
    assert_eq!(plant.step(), 4);
}

#[test]
fn points_may_be_commas_where_these_separate_nothing() {
    for separator in [";", "\t"] {
        let text = RTWIG.replace(',', separator).replace('.', ",");
        let plant = planted(&wood(WoodFormat::Qsm, &text));
        assert_eq!(plant.hash(), planted(&wood(WoodFormat::Qsm, RTWIG)).hash(), "{separator:?}");
    }
}

#[test]
fn internodes_are_as_long_as_the_pieces_of_the_file() {
    let length = |text: &str, options: WoodOptions| {
        let file = read_wood(WoodFormat::Qsm, text.as_bytes(), &options).expect("cylinders");
        (file.parameters.internode_length, planted(&file.wood).living_count())
    };
    let unsaid = WoodOptions { internode_length: None, ..options() };
    // 1 m, 0.5 m and 0.304 m.
    assert_eq!(length(RTWIG, unsaid), (Some(0.5), 4));
    assert_eq!(length(RTWIG, WoodOptions { units: Units::of(0.01), ..unsaid }), (Some(0.005), 4));
    // No longer than the parameter may be, and then cylinders are cut.
    assert_eq!(length(RTWIG, WoodOptions { units: Units::of(4.0), ..unsaid }), (Some(1.0), 4 + 2 + 1));
    // As long as it takes for all of it to lie within reach, and to be no more nodes than may be.
    let near = WoodOptions { extent: 1.0, ..unsaid };
    assert!(
        length(RTWIG, WoodOptions { units: Units::of(0.5), ..near }).0.is_some_and(|length| length > 0.65)
    );
    let fine = RTWIG.replace("20.6", "20.11").replace("20,30.04,6.3", "20,30,6.01");
    assert_eq!(length(&fine, WoodOptions { nodes: 20, ..unsaid }), (Some(0.08), 13 + 2 + 1));
    assert_eq!(length(RTWIG, options()), (Some(0.1), 19));
}

#[test]
fn wood_that_was_not_grown_here_has_buds_where_it_is_young() {
    let plant = planted(&wood(WoodFormat::Qsm, RTWIG));
    let tip = |row: usize| plant.metamers().end(MetamerId::new(row)).y;
    let bears = |row: usize| plant.laterals(MetamerId::new(row)).count();
    let trunk = (1..plant.metamer_count()).filter(|&row| plant.metamers().end(MetamerId::new(row)).x == 0.0);
    // 13 internodes high: on the lowest ones stand more than two steps of 4 grow.
    let (young, old): (Vec<_>, Vec<_>) = trunk.partition(|&row| tip(row) > 5.5);
    assert!(young.len() > 7 && young.into_iter().all(|row| bears(row) == 1));
    assert!(
        old.len() > 4 && old.into_iter().all(|row| bears(row) == usize::from((tip(row) - 5.0).abs() < 0.1))
    );
}

#[test]
fn programs_name_their_columns_each_in_their_own_way() {
    let heads = [
        "radius,length,start.x,start.y,start.z,axis.x,axis.y,axis.z,parent,extension,branch,BranchOrder",
        "radius;length;startX;startY;startZ;axisX;axisY;axisZ;parentID;ID;branchID;branchOrder",
        "radius\tlength\tsx\tsy\tsz\tax\tay\taz\tp2\tp1\tnbranch\tbranch_order",
        "radius_cyl,length,startX,startY,startZ,axisX,axisY,axisZ,parent_ID,cyl_ID,branch_ID,branching_order",
    ];
    let rows = ["0.05,1,0,0,0,0,0,1,0,1,1,0", "0.04,1,0,0,1,0,0,1,1,2,1,0"];
    for head in heads {
        let mark = if head.contains(';') {
            ";"
        } else if head.contains('\t') {
            "\t"
        } else {
            ","
        };
        let text = format!("{head}\r\n{}\r\n{}\r\n", rows[0].replace(',', mark), rows[1].replace(',', mark));
        let plant = planted(&wood(WoodFormat::Qsm, &text));
        assert_eq!((plant.living_count(), plant.living_axes_count()), (20, 1), "{head}");
    }
}

#[test]
fn bad_cylinders_are_named_by_line_and_column() {
    let cases = [
        (
            RTWIG.replace("0.02,0.5", "-0.02,0.5"),
            FaultKind::OutOfRange,
            Place::Cell(3, 10),
            "radius is -0.02",
        ),
        (RTWIG.replace("0.02,0.5", "NaN,0.5"), FaultKind::OutOfRange, Place::Cell(3, 10), "radius is NaN"),
        (RTWIG.replace("0.02,0.5", "wide,0.5"), FaultKind::Malformed, Place::Cell(3, 10), "`wide`"),
        (RTWIG.replace("2,1,20.1", "2,7,20.1"), FaultKind::Malformed, Place::Line(3), "its parent 7"),
        (
            RTWIG.replace("3,1,20,", "2,1,20,"),
            FaultKind::Malformed,
            Place::Line(4),
            "cylinder 2 is there twice",
        ),
        (RTWIG.replace("1,0,20,30,5,", "1,3,20,30,5,"), FaultKind::Malformed, Place::Line(2), "bears itself"),
        (RTWIG.replace("\"1\",1,0", "1,0"), FaultKind::Malformed, Place::Line(2), "12 cells"),
        (RTWIG.replace("20.6", "2e9"), FaultKind::OutOfRange, Place::Line(3), "too far from the first trunk"),
        (
            RTWIG.replace("20.6", "1e300"),
            FaultKind::OutOfRange,
            Place::Line(3),
            "too far from the first trunk",
        ),
        (
            "name,height,dbh\noak,12,0.4\n".into(),
            FaultKind::Malformed,
            Place::Line(1),
            "`name`, `height`, `dbh`",
        ),
        ("../../etc/passwd".into(), FaultKind::Malformed, Place::Line(1), "are not those of a QSM"),
        (String::new(), FaultKind::Malformed, Place::Line(1), "it has no columns"),
        (
            RTWIG.replacen("branch_order", " radius", 1),
            FaultKind::Malformed,
            Place::Cell(1, 13),
            "there are two columns `radius`",
        ),
        (RTWIG.replace("0.02,0.5", "1e30,0.5"), FaultKind::OutOfRange, Place::Cell(3, 10), "up to 100 m"),
        (ALONG.replace("0,0,1,0.3,", "0,0,0,0.3,"), FaultKind::OutOfRange, Place::Cell(2, 4), "axis is 0"),
    ];
    for (text, kind, place, what) in cases {
        let found = fault(WoodFormat::Qsm, &text);
        assert_eq!((found.kind, found.place.as_ref()), (kind, Some(&place)), "{found}");
        assert!(found.to_string().contains(what), "{found}");
    }
    let nothing = fault(WoodFormat::Qsm, &ALONG.replace("1,0.3,", "1,0,"));
    assert!(nothing.place.is_none() && nothing.what.contains("it holds no wood"), "{nothing}");
    assert_eq!(fault(WoodFormat::Qsm, RTWIG.lines().next().expect("a head")).kind, FaultKind::Malformed);
    let few = WoodOptions { nodes: 12, ..options() };
    let found = read_wood(WoodFormat::Qsm, RTWIG.as_bytes(), &few).expect_err("more than 12 internodes");
    assert_eq!((found.kind, found.place), (FaultKind::TooMany, Some(Place::Line(3))));
}

/// In the manner of OpenAlea's own examples: growth units between axes and internodes, values of some only.
const OPENALEA: &str = "\
# A young tree, in millimetres
CODE :\tFORM-A

CLASSES:
SYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION
$ \t0\tFREE\tFREE\tIMPLICIT
P\t1\tCONNECTED\tFREE\tEXPLICIT
U\t2\tFREE\tFREE\tEXPLICIT
E\t3\tNONE\tFREE\tEXPLICIT

DESCRIPTION :
LEFT\tRIGHT\tRELTYPE\tMAX
U\tU\t<\t1
U\tU\t+\t?
E\tE\t<\t1
E\tE\t+\t1

FEATURES:
NAME\tTYPE
XX\tREAL
YY\tREAL
ZZ\tREAL
TopDia\tREAL

MTG:
ENTITY-CODE\t\t\tXX\tYY\tZZ\tTopDia
/P1/U90\t\t\t0\t0\t0\t40\t# the foot
^/E1<<E3\t\t\t0\t0\t300\t30
\t+U91/E1\t\t100\t0\t350\t12
\t^<E2<<E4\t\t250\t0\t400\t8
^<U91/E4\t\t\t0\t0\t500\t20
^<E5\t\t\t0\t50\t700\t10
";

#[test]
fn a_graph_of_growth_units_becomes_a_tree() {
    let options = WoodOptions { units: Units::of(0.001), ..options() };
    let file = read_wood(WoodFormat::Mtg, OPENALEA.as_bytes(), &options).expect("it is a graph");
    let plant = planted(&file.wood);
    // 3, 2 and 2 internodes of the trunk, and a branch of 1 and 2.
    assert_eq!((plant.living_count(), plant.living_axes_count()), (10, 2));
    let ends: Vec<Vec3> =
        (0..plant.metamer_count()).map(|row| plant.metamers().end(MetamerId::new(row))).collect();
    for wanted in [[0.0, 3.0, 0.0], [0.0, 5.0, 0.0], [0.0, 7.0, -0.5], [1.0, 3.5, 0.0], [2.5, 4.0, 0.0]] {
        assert!(
            ends.iter().any(|end| end.distance(Vec3::from_array(wanted)) < 1e-5),
            "{wanted:?} in {ends:?}"
        );
    }
}

/// Lengths in centimetres, diameters in tenths of millimetres: as walnuts were measured.
#[test]
fn diameters_may_be_in_a_unit_of_their_own() {
    let read = |units| {
        let file = read_wood(WoodFormat::Mtg, OPENALEA.as_bytes(), &WoodOptions { units, ..options() });
        let file = file.expect("it is a graph");
        let thickest = file.wood.nodes.iter().filter_map(|node| node.radius).fold(0.0_f32, f32::max);
        (thickest, file.notes)
    };
    let (thick, notes) = read(Units::of(0.001));
    assert_eq!(notes, []);
    let (thin, notes) = read(Units { length: 0.001, diameter: 0.0001 });
    assert!((thick / thin - 10.0).abs() < 1e-3, "{thick} and {thin}");
    assert_eq!(notes, []);
    // At its foot it is 40 across, of 700 in height.
    let (_, notes) = read(Units { length: 0.001, diameter: 0.01 });
    assert_eq!(notes, [WoodNote::Thick { percent: 57 }]);
}

#[test]
fn codes_from_the_whole_lead_to_what_is_there_already() {
    let text = OPENALEA.split("ENTITY").next().expect("a head").to_owned()
        + "TOPO\tXX\tYY\tZZ\tTopDia\n/P1/U1/E1\t0\t0\t0\t1\n/P1/U1/E1<E2\t0\t0\t0.1\t1\n/P1/U1/E1<E2<E3\t0\t0\t0.2\t1\n\
           /P1/U1/E1<E2+U2/E1\t0.1\t0\t0.1\t1\n";
    let plant = planted(&wood(WoodFormat::Mtg, &text));
    assert_eq!((plant.living_count(), plant.living_axes_count()), (3, 2));
}

#[test]
fn bad_graphs_are_named_by_line_and_column() {
    let cases = [
        ("FORM-A", "FORM-B", FaultKind::Malformed, Place::Line(2), "FORM-A"),
        ("U\t2\tFREE", "U\ttwo\tFREE", FaultKind::Malformed, Place::Cell(8, 2), "`two`"),
        ("U\t2\tFREE", "U\t99\tFREE", FaultKind::OutOfRange, Place::Cell(8, 2), "0 to 64"),
        ("ENTITY-CODE", "NAMES", FaultKind::Malformed, Place::Cell(26, 1), "TOPO"),
        ("\t+U91/E1", "\t+X91/E1", FaultKind::Malformed, Place::Cell(29, 2), "no class: `X`"),
        ("\t+U91/E1", "\t\t+U91/E1", FaultKind::Malformed, Place::Cell(29, 3), "nothing stands above"),
        ("\t+U91/E1", "\t=U91/E1", FaultKind::Malformed, Place::Cell(29, 2), "no code"),
        ("\t+U91/E1", "\t+U91/P1", FaultKind::Malformed, Place::Cell(29, 2), "its scale does not fit"),
        ("E1<<E3", "E1<<E999999999", FaultKind::TooMany, Place::Cell(28, 1), "10000 nodes"),
        ("E1<<E3", "E1<<E99999999999999", FaultKind::Malformed, Place::Cell(28, 1), "no code"),
        ("E2<<E4", "E2<<E1", FaultKind::Malformed, Place::Cell(30, 2), "higher number"),
        ("400\t8", "inf\t8", FaultKind::OutOfRange, Place::Cell(30, 6), "ZZ is inf"),
        ("400\t8", "400\t-8", FaultKind::OutOfRange, Place::Cell(30, 7), "allowed: 0 and more"),
        ("400\t8", "high\t8", FaultKind::Malformed, Place::Cell(30, 6), "`high`"),
    ];
    for (from, to, kind, place, what) in cases {
        let found = fault(WoodFormat::Mtg, &OPENALEA.replacen(from, to, 1));
        assert_eq!((found.kind, found.place.as_ref()), (kind, Some(&place)), "{to}: {found}");
        assert!(found.to_string().contains(what), "{found}");
    }
    let thick = OPENALEA.replacen("400\t8", "400\t1e30", 1);
    let found =
        read_wood(WoodFormat::Mtg, thick.as_bytes(), &WoodOptions { units: Units::of(0.001), ..options() });
    let found = found.expect_err("it is thicker than the world");
    assert_eq!((found.kind, &found.place), (FaultKind::OutOfRange, &Some(Place::Cell(30, 7))), "{found}");
    for (text, what) in [
        ("", "no section MTG"),
        ("CODE:\tFORM-A\n", "no section MTG"),
        ("{\"format\":1}\n", "it is no MTG"),
        ("MTG:\nTOPO\tXX\n", "has a place"),
        ("MTG:\n", "is empty"),
    ] {
        let found = fault(WoodFormat::Mtg, text);
        assert!(found.kind == FaultKind::Malformed && found.to_string().contains(what), "{found}");
    }
}

/// As this program writes it.
const OWN: &str = include_str!("../../../tests/fuzz/seeds/own.mtg");

#[test]
fn a_graph_that_is_cut_off_is_refused_or_taken_with_a_note() {
    let whole = read_wood(WoodFormat::Mtg, OWN.as_bytes(), &options()).expect("a graph");
    assert_eq!(whole.notes, []);
    let last = OWN.trim_end_matches('\n').rfind('\n').expect("lines") + 1;
    let cells = OWN[last..].trim_end_matches('\n');
    let cut = cells.find(char::is_numeric).expect("a code") + 1;
    for end in cut..cells.rfind('\t').expect("cells") {
        let found = fault(WoodFormat::Mtg, &OWN[..last + end]);
        assert_eq!(found.kind, FaultKind::Malformed, "{found}");
    }
    let found = fault(WoodFormat::Mtg, &OWN[..last + cells.rfind('\t').expect("cells")]);
    assert!(found.what.contains("cut off"), "{found}");
    // Where nothing tells that something is missing, whoever takes it is told.
    let file = read_wood(WoodFormat::Mtg, OWN.trim_end_matches('\n').as_bytes(), &options());
    assert_eq!(file.map(|file| file.notes), Ok(vec![WoodNote::NoLineEnd]));
    // Other programs leave out empty cells at the end, and the line end of the last line.
    let short = OPENALEA.split("ENTITY").next().expect("a head").to_owned()
        + "TOPO\tXX\tYY\tZZ\tTopDia\n/P1/U1\n^/E1\t0\t0\t0.1\n^<E2\t0\t0\t0.2";
    let file = read_wood(WoodFormat::Mtg, short.as_bytes(), &options());
    assert_eq!(file.map(|file| (file.wood.nodes.len(), file.notes)), Ok((2, vec![WoodNote::NoLineEnd])));
    let (cells, _) = RTWIG.rsplit_once(',').expect("cells");
    assert!(fault(WoodFormat::Qsm, cells).what.contains("12 cells"));
    let file = read_wood(WoodFormat::Qsm, RTWIG.trim_end().as_bytes(), &options());
    assert_eq!(file.map(|file| file.notes), Ok(vec![WoodNote::NoLineEnd]));
}

#[test]
fn a_graph_may_be_in_latin_1() {
    let text = OPENALEA.replace("A young tree", "Abricotier taill\u{e9}");
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).expect("Latin-1")).collect();
    assert!(std::str::from_utf8(&latin).is_err());
    let read = |bytes: &[u8]| read_wood(WoodFormat::Mtg, bytes, &options()).map(|file| file.wood);
    assert_eq!(read(&latin), read(text.as_bytes()));
    assert_eq!(fault(WoodFormat::Mtg, "\u{0}\u{1}").kind, FaultKind::Malformed);
}

#[test]
fn a_graph_says_what_it_grew_by() {
    let about = |line: &str| {
        let text = OPENALEA
            .replace("TopDia\tREAL\n", "TopDia\tREAL\nInternodeLength\tREAL\nSpecies\tALPHA\nSeed\tINT\n")
            .replace(
                "TopDia\n/P1/U90",
                &format!("TopDia\tInternodeLength\tSpecies\tSeed\n/P1\t\t\t\t\t\t\t{line}\n/P1/U90"),
            );
        let options = WoodOptions { internode_length: None, units: Units::of(0.001), ..options() };
        read_wood(WoodFormat::Mtg, text.as_bytes(), &options)
    };
    let file = about("250\toak\t4294967295").expect("a graph");
    assert_eq!(file.parameters.internode_length, Some(0.25));
    assert_eq!((file.species.as_deref(), file.seed), (Some("oak"), Some(u32::MAX)));
    // The median of five components.
    let file = about("NA").expect("a graph");
    assert_eq!((file.parameters.internode_length, file.species, file.seed), (Some(0.2), None, None));
    for (line, column, allowed) in [
        ("0.25", 8, "0.005 m to 1 m"),
        ("250\toak\t-1", 10, "whole numbers from 0 to 4294967295"),
        ("inf", 8, "finite numbers"),
    ] {
        let found = about(line).expect_err(line);
        assert!(matches!(found.place, Some(Place::Cell(_, at)) if at == column), "{found}");
        assert_eq!(found.allowed.as_deref(), Some(allowed));
    }
}

#[test]
fn a_scale_that_was_left_out_is_no_place_to_go_on_from() {
    // E3 is a part of P1 at once, so there is no U that another one could follow.
    let text = OPENALEA.split("ENTITY").next().expect("a head").to_owned()
        + "TOPO\tXX\tYY\tZZ\tTopDia\n/P1/E3\t0\t0\t0\t1\n^<U2\t0\t0\t1\t1\n";
    let found = fault(WoodFormat::Mtg, &text);
    assert_eq!((found.kind, found.place), (FaultKind::Malformed, Some(Place::Cell(28, 1))));
}

const SKELETON: &str = r#"{"format":"espalier-skeleton","version":2,"axes":[{"bearer":null}],
"metamers":[{"parent":null,"axis":0,"position":[0,0,0],"birth":0},
{"parent":0,"axis":0,"position":[0,0.1,0],"radius":0.01,"birth":1}]}"#;

#[test]
fn a_skeleton_needs_no_more_than_its_structure() {
    let plant = planted(&wood(WoodFormat::Skeleton, SKELETON));
    assert_eq!((plant.living_count(), plant.axis_count()), (1, 1));
    assert_eq!(plant.metamers().end(MetamerId::new(1)), Vec3::Y);
}

#[test]
fn bad_skeletons_are_named_by_member_or_place() {
    let at = |name: &str| Place::Member(format!("metamers[1].{name}"));
    let cases = [
        (r#""parent":0"#, r#""parent":1"#, FaultKind::OutOfRange, at("parent"), "stands behind"),
        (
            r#""axis":0,"position":[0,0.1"#,
            r#""axis":3,"position":[0,0.1"#,
            FaultKind::OutOfRange,
            at("axis"),
            "no axis 3",
        ),
        ("0.01", "-0.01", FaultKind::OutOfRange, at("radius"), "0 and more"),
        ("[0,0.1,0]", "[0,1e9,0]", FaultKind::OutOfRange, at("position"), "1000 internodes"),
        ("[0,0.1,0]", "[0,0,0]", FaultKind::Malformed, at("position"), "no length"),
        (r#""birth":1"#, r#""birth":4000000000"#, FaultKind::OutOfRange, at("birth"), "100000"),
        (
            "espalier-skeleton",
            "skeleton",
            FaultKind::Malformed,
            Place::Member("format".into()),
            "espalier-skeleton",
        ),
        (
            r#""version":2"#,
            r#""version":3"#,
            FaultKind::OutOfRange,
            Place::Member("version".into()),
            "allowed: 1 or 2",
        ),
        ("0.01", "NaN", FaultKind::Malformed, Place::Cell(3, 52), "it is no JSON"),
    ];
    for (from, to, kind, place, what) in cases {
        let found = fault(WoodFormat::Skeleton, &SKELETON.replacen(from, to, 1));
        assert_eq!((found.kind, found.place.as_ref()), (kind, Some(&place)), "{to}: {found}");
        assert!(found.to_string().contains(what), "{found}");
    }
}

#[test]
fn what_is_refused_in_a_skeleton_names_its_member_and_what_is_allowed_there() {
    let whole: Value = serde_json::from_str(SKELETON).expect("JSON");
    let metamer = |name: &str| (format!("/metamers/1/{name}"), format!("metamers[1].{name}"));
    let top = |name: &str| (format!("/{name}"), name.to_owned());
    let parent = "null, or the number of a metamer that stands before this one, from 0";
    for ((at, member), value, allowed) in [
        (metamer("parent"), json!(-1), parent),
        (metamer("parent"), json!("x"), parent),
        (metamer("parent"), json!(0.5), parent),
        (metamer("axis"), json!("x"), "the number of an axis, from 0"),
        (metamer("axis"), json!(null), "the number of an axis, from 0"),
        (metamer("position"), json!("x"), "three numbers"),
        (metamer("position"), json!([0, 1]), "three numbers"),
        (metamer("position"), json!([0, 1, 2, 3]), "three numbers"),
        (metamer("radius"), json!("x"), "0 and more"),
        (metamer("radius"), json!(-0.1), "0 and more"),
        (metamer("radius"), json!({}), "0 and more"),
        (metamer("radius"), json!(1e9), "0 to 100"),
        (metamer("normal"), json!([0, 1, 0]), "a unit vector across the internode"),
        (metamer("normal"), json!([2, 0, 0]), "a unit vector across the internode"),
        (metamer("shed"), json!(-1), "0 to 1000000000"),
        (metamer("birth"), json!(-1), "0 to 100000"),
        (metamer("birth"), json!(100_001), "0 to 100000"),
        (metamer("birth"), json!("x"), "0 to 100000"),
        (top("metamers"), json!([]), "a list of 1 metamer or more, seeds first"),
        (top("metamers"), json!({}), "a list of 1 metamer or more, seeds first"),
        (top("axes"), json!(5), "a list of 1 axis or more"),
        (top("version"), json!(3), "1 or 2"),
        (top("version"), json!(0), "1 or 2"),
        (top("version"), json!("2"), "1 or 2"),
        (top("format"), json!(5), "espalier-skeleton"),
        (top("format"), json!("mtg"), "espalier-skeleton"),
        (("/axes/0".into(), "axes[0]".into()), json!([null, null, true]), "an object"),
        (("/metamers/0".into(), "metamers[0]".into()), json!([null, 0, [0, 0, 0], 0]), "an object"),
    ] {
        let mut other = whole.clone();
        match other.pointer_mut(&at) {
            Some(member) => *member = value.clone(),
            None => other["metamers"][1][at.rsplit('/').next().expect("a name")] = value.clone(),
        }
        let found = fault(WoodFormat::Skeleton, &other.to_string());
        let expected = (Some(Place::Member(member)), Some(allowed));
        assert_eq!(
            (found.place, found.allowed.as_deref()),
            expected.clone(),
            "{at} = {value}: {}",
            found.what
        );
        // The same where it is not there at all.
        let (outer, name) = at.rsplit_once('/').expect("a path");
        if let Some(object) = other.pointer_mut(outer).and_then(Value::as_object_mut)
            && !matches!(name, "parent" | "radius" | "normal" | "shed")
        {
            object.remove(name);
            let found = fault(WoodFormat::Skeleton, &other.to_string());
            assert_eq!((found.place, found.allowed.as_deref()), expected, "no {at}");
        }
    }
    let deep = SKELETON.replace("[0,0.1,0]", "[0,\"up\",0]");
    let found = fault(WoodFormat::Skeleton, &deep);
    assert_eq!(found.place, Some(Place::Member("metamers[1].position[1]".into())), "{found}");
    let twice = SKELETON.replace(r#""radius":0.01"#, r#""radius":0.01,"radius":0.02"#);
    let found = fault(WoodFormat::Skeleton, &twice);
    assert_eq!(
        (found.place.as_ref(), found.allowed.as_deref()),
        (Some(&Place::Member("metamers[1].radius".into())), Some("once"))
    );
    for whole in ["[]", "5", "null", "\"x\""] {
        let found = fault(WoodFormat::Skeleton, whole);
        assert_eq!((found.place, found.allowed.as_deref()), (None, Some("an object")), "{whole}");
    }
}

#[test]
fn skeletons_whose_axes_do_not_fit_together_name_the_member() {
    let axis = |bearer: Value| json!({"bearer": bearer});
    let metamer = |parent: Value, axis: u32, y: f32, birth: u32| json!({"parent": parent, "axis": axis, "position": [0, y, 0], "birth": birth});
    let fork = || {
        let metamers =
            [(json!(null), 0, 0.0, 0), (json!(0), 0, 0.1, 1), (json!(1), 0, 0.2, 1), (json!(1), 1, 0.3, 1)];
        json!({"format": "espalier-skeleton", "version": 2, "axes": [axis(json!(null)), axis(json!(1))],
            "metamers": metamers.map(|(parent, axis, y, birth)| metamer(parent, axis, y, birth))})
    };
    planted(&wood(WoodFormat::Skeleton, &fork().to_string()));
    for (at, value, place) in [
        ("/axes/0/bearer", json!(2), "axes[0].bearer"),
        ("/axes/1/bearer", json!(9), "axes[1].bearer"),
        ("/axes/1/bearer", json!(0), "axes[1].bearer"),
        ("/axes/1/bearer", json!(3), "metamers[3].axis"),
        ("/axes/1/bearer", json!(null), "metamers[3].axis"),
        ("/axes/1", json!({"bearer": 1, "direction": [0, 3, 0]}), "axes[1].direction"),
        ("/metamers/2/axis", json!(1), "metamers[3].axis"),
        ("/metamers/3/axis", json!(0), "metamers[3].axis"),
        ("/metamers/3/parent", json!(null), "axes[1].bearer"),
        ("/metamers/0/birth", json!(1), "metamers[0].birth"),
    ] {
        let mut other = fork();
        *other.pointer_mut(at).expect(at) = value.clone();
        let found = fault(WoodFormat::Skeleton, &other.to_string());
        assert_eq!(found.place, Some(Place::Member(place.into())), "{at} = {value}: {found}");
    }
}

#[test]
fn files_cut_short_anywhere_are_wood_or_faults() {
    for (format, text) in
        [(WoodFormat::Qsm, RTWIG), (WoodFormat::Mtg, OPENALEA), (WoodFormat::Skeleton, SKELETON)]
    {
        for end in (0..text.len()).filter(|&end| text.is_char_boundary(end)) {
            if let Ok(file) = read_wood(format, &text.as_bytes()[..end], &options()) {
                planted(&file.wood);
            }
        }
    }
}

#[test]
fn lm14_tables_have_up_to_a_thousand_columns() {
    let beside = |count: usize| (0..count).map(|at| format!(",c{at}")).collect::<String>();
    let qsm = |count| ALONG.replacen('\n', &(beside(count) + "\n"), 1);
    let row =
        |text: &str, count: usize| text.replacen(",0.02,0\n", &format!(",0.02,0{}\n", beside(count)), 1);
    let wide = row(&qsm(991), 991);
    assert_eq!(wood(WoodFormat::Qsm, &wide).nodes.len(), wood(WoodFormat::Qsm, ALONG).nodes.len());
    let wider = row(&qsm(992), 992);
    // A head in quotes over two lines is no narrower.
    let quoted = wider.replacen(",c0,", ",\"c\n0\",", 1);
    let names: String = (0..992).map(|at| format!("F{at}\tREAL\n")).collect();
    let features =
        |more: &str| OPENALEA.replacen("TopDia\tREAL\n", &format!("TopDia\tREAL\n{names}{more}"), 1);
    let head = OPENALEA.replacen("\tTopDia\n", &format!("\tTopDia{}\n", "\tc".repeat(994)), 1);
    let cells = OPENALEA.replacen("400\t8", &format!("400\t8{}", "\t".repeat(994)), 1);
    for (format, text, line) in [
        (WoodFormat::Qsm, &wider, 1),
        (WoodFormat::Qsm, &quoted, 1),
        (WoodFormat::Mtg, &features("A\tREAL\nB\tREAL\nC\tREAL\nD\tREAL\nE\tREAL\n"), 1020),
        (WoodFormat::Mtg, &head, 26),
        (WoodFormat::Mtg, &cells, 30),
    ] {
        let found = fault(format, text);
        assert_eq!(
            (found.kind, found.place.as_ref()),
            (FaultKind::TooMany, Some(&Place::Line(line))),
            "{found}"
        );
        assert!(found.to_string().contains("up to 1000 columns"), "{found}");
    }
    let most = features("A\tREAL\nB\tREAL\nC\tREAL\nD\tREAL\n");
    let millimetres = WoodOptions { units: Units::of(0.001), ..options() };
    let read = |text: &str| read_wood(WoodFormat::Mtg, text.as_bytes(), &millimetres).expect("a graph");
    assert_eq!(read(&most), read(OPENALEA));
}

#[test]
fn lm14_runs_pass_what_is_there_so_often_and_no_more() {
    let head = OPENALEA.split("ENTITY").next().expect("a head").to_owned() + "TOPO\tXX\tYY\tZZ\tTopDia\n";
    let text = |times: usize| {
        let runs = "/P1/U1/E1<<E5000\n".repeat(times);
        format!("{head}/P1/U1/E1\t0\t0\t0\t1\n{runs}/P1/U1/E1<E2\t0\t0\t0.1\t1\n")
    };
    planted(&wood(WoodFormat::Mtg, &text(10)));
    let found = fault(WoodFormat::Mtg, &text(30));
    assert_eq!(
        (found.kind, found.place.as_ref()),
        (FaultKind::TooMany, Some(&Place::Cell(45, 1))),
        "{found}"
    );
}

#[test]
fn branches_begin_at_the_nearest_node_of_a_long_cylinder() {
    let head = RTWIG.lines().next().expect("a head");
    let trunk = "\"1\",1,0,20,30,5,20,30,6,0.05,1,1,0";
    for at in 0..=20 {
        let height = 5.0 + f64::from(at) * 0.05 + 0.01;
        let branch = format!("\"2\",2,1,20.01,30,{height},20.31,30,{height},0.02,0.3,2,1");
        let found = wood(WoodFormat::Qsm, &format!("{head}\n{trunk}\n{branch}\n"));
        let bearer = found.axes[1].bearer.expect("wood bears the branch");
        let end = found.nodes[bearer as usize].end;
        let nearest = ((height - 5.0) * 10.0).round().clamp(1.0, 10.0) as f32;
        assert!((end.y - nearest).abs() < 1e-3, "{height}: {end} is not {nearest}");
    }
}
