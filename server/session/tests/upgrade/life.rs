//! Random lives of a document, as commands of the journal.

use espalier_plant::MetamerId;
use espalier_session::{Document, Principal, read_command};
use proptest::prelude::*;

/// Something that is done. Rows are any numbers, from which a living metamer is found.
#[derive(Clone, Debug)]
pub enum LifeEvent {
    Grow(u32),
    Stroke(f32, f32, f32),
    Hold(u32, f32),
    Lasso(f32),
    Apical(f32),
    Season(f32),
    Shedding(f32),
    Seed(f32),
    Ball(f32),
    MoveBall(u32, f32),
    Reshape(u32, f32),
    RemoveBall(u32),
    Programme(u32, f32),
    NoProgramme(bool),
    Follow,
    Stop(u32),
    Bend(u32, f32),
    GiveUpBend(u32, f32),
    Width(u32, Option<f32>),
    Prune(u32),
    PruneDim(f32),
    Turn(u32),
    Graft(u32, u32, bool),
    Ungrow(u32),
    Undo,
    Redo,
    GoTo(u32),
    Take(u32),
}

/// A life of some length.
pub fn events() -> impl Strategy<Value = Vec<LifeEvent>> {
    let event = prop_oneof![
        4 => (1u32..4).prop_map(LifeEvent::Grow),
        2 => (-6f32..6.0, 1f32..12.0, 0f32..3.0).prop_map(|(x, y, radius)| LifeEvent::Stroke(x, y, radius)),
        1 => (any::<u32>(), 1f32..9.0).prop_map(|(row, y)| LifeEvent::Hold(row, y)),
        1 => (1f32..4.0).prop_map(LifeEvent::Lasso),
        1 => (0.4f32..0.7).prop_map(LifeEvent::Apical),
        1 => (0f32..3.0).prop_map(LifeEvent::Season),
        1 => (0f32..0.3).prop_map(LifeEvent::Shedding),
        1 => (-9f32..9.0).prop_map(LifeEvent::Seed),
        1 => (-9f32..9.0).prop_map(LifeEvent::Ball),
        1 => (any::<u32>(), -9f32..9.0).prop_map(|(which, x)| LifeEvent::MoveBall(which, x)),
        1 => (any::<u32>(), 0.5f32..2.0).prop_map(|(which, size)| LifeEvent::Reshape(which, size)),
        1 => any::<u32>().prop_map(LifeEvent::RemoveBall),
        2 => (0u32..12, 0.4f32..0.7).prop_map(|(age, value)| LifeEvent::Programme(age, value)),
        1 => any::<bool>().prop_map(LifeEvent::NoProgramme),
        1 => Just(LifeEvent::Follow),
        1 => (0u32..9).prop_map(LifeEvent::Stop),
        2 => (any::<u32>(), -3f32..3.0).prop_map(|(row, x)| LifeEvent::Bend(row, x)),
        1 => (any::<u32>(), -3f32..3.0).prop_map(|(row, x)| LifeEvent::GiveUpBend(row, x)),
        2 => (any::<u32>(), prop::option::weighted(0.8, 0.05f32..2.0)).prop_map(|(row, d)| LifeEvent::Width(row, d)),
        2 => any::<u32>().prop_map(LifeEvent::Prune),
        1 => (0f32..1.0).prop_map(LifeEvent::PruneDim),
        2 => any::<u32>().prop_map(LifeEvent::Turn),
        2 => (any::<u32>(), any::<u32>(), any::<bool>()).prop_map(|(row, onto, keep)| LifeEvent::Graft(row, onto, keep)),
        2 => (1u32..6).prop_map(LifeEvent::Ungrow),
        2 => Just(LifeEvent::Undo),
        1 => Just(LifeEvent::Redo),
        2 => any::<u32>().prop_map(LifeEvent::GoTo),
        2 => any::<u32>().prop_map(LifeEvent::Take),
    ];
    prop::collection::vec(event, 1..24)
}

/// Does it; what the document refuses changes nothing.
pub fn live(document: &mut Document, number: usize, event: &LifeEvent) {
    for command in commands(document, number, event) {
        let read = read_command(&command).unwrap_or_else(|problem| panic!("{command}: {problem}"));
        if let Err(problem) = document.apply(&Principal::visitor(), &read) {
            assert!(problem.field.is_some() && problem.allowed.is_some(), "{command}: {problem:?}");
        }
    }
}

fn commands(document: &Document, number: usize, event: &LifeEvent) -> Vec<String> {
    let row = |any: u32| row(document, any);
    let quarter = "[0.0,0.38268343,0.0,0.9238795]";
    let one = |command: String| vec![command];
    match *event {
        LifeEvent::Grow(steps) => one(format!(r#"{{"kind":"grow","steps":{steps}}}"#)),
        LifeEvent::Stroke(x, y, radius) => {
            let sample = |x: f32, y: f32| format!(r#"{{"position":[{x:?},{y:?},0.5],"radius":{radius:?}}}"#);
            let (from, to) = (sample(0.0, y / 2.0), sample(x, y));
            vec![
                format!(r#"{{"kind":"stroke_begin","stroke":{number}}}"#),
                format!(r#"{{"kind":"stroke_move","stroke":{number},"samples":[{from},{to}]}}"#),
                format!(r#"{{"kind":"stroke_end","stroke":{number}}}"#),
            ]
        }
        // A stroke that goes on while other things are done.
        LifeEvent::Hold(any, y) => vec![
            format!(r#"{{"kind":"stroke_begin","stroke":{number},"bud":{}}}"#, row(any)),
            format!(
                r#"{{"kind":"stroke_move","stroke":{number},"samples":[{{"position":[1.0,{y:?},0.0],"radius":2.0}}]}}"#
            ),
        ],
        LifeEvent::Lasso(size) => one(format!(
            r#"{{"kind":"lasso","outline":[[-{size:?},1.0],[{size:?},1.0],[{size:?},7.0],[-{size:?},7.0]],
                "plane":{{"origin":[0.0,0.0,0.0],"right":[1.0,0.0,0.0],"up":[0.0,1.0,0.0]}},"depth":0.5}}"#
        )),
        LifeEvent::Apical(value) => one(parameter("apical_control", value)),
        LifeEvent::Shedding(value) => one(parameter("shedding_threshold", value)),
        LifeEvent::Season(season) => {
            one(format!(r#"{{"kind":"set_appearance","appearance":{{"leaves":{{"season":{season:?}}}}}}}"#))
        }
        LifeEvent::Seed(x) => one(format!(r#"{{"kind":"plant_seed","position":[{x:?},0.0,1.0]}}"#)),
        LifeEvent::Ball(x) => one(format!(
            r#"{{"kind":"place_obstacle","obstacle":{{"shape":{{"kind":"sphere","radius":1.5}},"pose":{{"position":[{x:?},4.0,0.0]}}}}}}"#
        )),
        LifeEvent::MoveBall(any, x) => of_obstacle(document, any, |id| {
            format!(r#"{{"kind":"move_obstacle","id":{id},"pose":{{"position":[{x:?},3.0,1.0]}}}}"#)
        }),
        LifeEvent::Reshape(any, size) => of_obstacle(document, any, |id| {
            let shape = format!(r#"{{"kind":"box","size":[{size:?},2.0,1.0]}}"#);
            format!(r#"{{"kind":"reshape_obstacle","id":{id},"shape":{shape}}}"#)
        }),
        LifeEvent::RemoveBall(any) => {
            of_obstacle(document, any, |id| format!(r#"{{"kind":"remove_obstacle","id":{id}}}"#))
        }
        // Its stages lie before, at and after the age of the tree.
        LifeEvent::Programme(age, value) => {
            let change =
                format!(r#"{{"kind":"change","age":{age},"parameters":{{"apical_control":{value:?}}}}}"#);
            let seed = format!(r#"{{"kind":"seed","age":{age},"position":[5.0,0.0,{value:?}]}}"#);
            let sample = r#"{"position":[2.0,5.0,0.0],"radius":1.5}"#;
            let stroke = format!(r#"{{"kind":"stroke","age":{},"samples":[{sample}]}}"#, age + 2);
            one(format!(
                r#"{{"kind":"set_programme","programme":{{"species":"oak","parameters":{{"branching_angle":40.0}},
                    "stages":[{change},{seed},{stroke}],"age":20}}}}"#
            ))
        }
        LifeEvent::NoProgramme(keep) => {
            one(format!(r#"{{"kind":"set_programme","programme":null,"keep":{keep}}}"#))
        }
        LifeEvent::Follow => {
            one(r#"{"kind":"follow_programme","parameters":["apical_control","shedding_threshold"]}"#
                .to_owned())
        }
        LifeEvent::Stop(more) => {
            one(format!(r#"{{"kind":"stop","tick":{}}}"#, document.figures().steps_begun + more))
        }
        LifeEvent::Bend(any, x) => bend(document, number, row(any), x, "bend_end"),
        LifeEvent::GiveUpBend(any, x) => bend(document, number, row(any), x, "bend_cancel"),
        LifeEvent::Width(any, diameter) => {
            let diameter = diameter.map_or("null".to_owned(), |diameter| format!("{diameter:?}"));
            one(format!(r#"{{"kind":"set_width","row":{},"diameter":{diameter}}}"#, row(any % 7)))
        }
        LifeEvent::Prune(any) => one(format!(r#"{{"kind":"prune","rows":[{}]}}"#, row(any))),
        LifeEvent::PruneDim(exposure) => one(format!(r#"{{"kind":"prune_dim","exposure":{exposure:?}}}"#)),
        LifeEvent::Turn(any) => {
            one(format!(r#"{{"kind":"turn_branch","row":{},"rotation":{quarter}}}"#, row(any)))
        }
        LifeEvent::Graft(any, onto, keep) => one(format!(
            r#"{{"kind":"graft","row":{},"onto":{},"rotation":{quarter},"keep":{keep}}}"#,
            row(any),
            row(onto)
        )),
        LifeEvent::Ungrow(steps) => one(format!(r#"{{"kind":"ungrow","steps":{steps}}}"#)),
        LifeEvent::Undo => one(r#"{"kind":"undo"}"#.to_owned()),
        LifeEvent::Redo => one(r#"{"kind":"redo"}"#.to_owned()),
        LifeEvent::GoTo(any) => {
            one(format!(r#"{{"kind":"go_to","step":{}}}"#, any % (document.plant().last_step() + 1)))
        }
        LifeEvent::Take(any) => {
            let futures = document.timeline().futures;
            let future = futures.get(any as usize % futures.len().max(1));
            future
                .map(|it| format!(r#"{{"kind":"take_future","future":{}}}"#, it.future))
                .into_iter()
                .collect()
        }
    }
}

fn bend(document: &Document, number: usize, end: u32, x: f32, last: &str) -> Vec<String> {
    let base = below(document, end, 4);
    vec![
        format!(r#"{{"kind":"bend_begin","bend":{number},"base":{base},"touches":[{end}],"stretch":0.3}}"#),
        format!(r#"{{"kind":"bend_move","bend":{number},"targets":[[{x:?},6.0,1.0]]}}"#),
        format!(r#"{{"kind":"{last}","bend":{number}}}"#),
    ]
}

/// A command for one of the obstacles, if there is any.
fn of_obstacle(document: &Document, any: u32, command: impl Fn(u32) -> String) -> Vec<String> {
    let all = document.obstacles();
    all.get(any as usize % all.len().max(1)).map(|one| command(one.id)).into_iter().collect()
}

fn parameter(name: &str, value: f32) -> String {
    format!(r#"{{"kind":"set_parameters","parameters":{{"{name}":{value:?}}}}}"#)
}

/// The row of a living metamer found from any number; 0, a seed, if nothing lives.
fn row(document: &Document, any: u32) -> u32 {
    let plant = document.plant();
    let count = plant.metamer_count();
    let rows = (0..count).map(|index| (index + any as usize) % count).map(MetamerId::new);
    let mut living = rows.filter(|&id| plant.is_alive(id) && !plant.is_seed(id));
    living.next().map_or(0, MetamerId::raw)
}

/// The row so many metamers below another one, or as near to that as there is wood.
fn below(document: &Document, row: u32, count: usize) -> u32 {
    let plant = document.plant();
    let up = MetamerId::new(row as usize);
    let way = std::iter::successors(Some(up), |&id| plant.metamers().parent(id));
    way.take_while(|&id| !plant.is_seed(id)).take(count + 1).last().map_or(row, MetamerId::raw)
}
