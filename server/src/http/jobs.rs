//! Jobs: trees that are grown on request (`JB`).

mod archive;
mod list;
mod notes;

use std::{borrow::Cow, collections::BTreeSet, fmt};

use axum::{
    Json,
    extract::State,
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use espalier_growth::species;
use espalier_proto::{NotAllowed, Problem, Reason, Steps, reading::in_field};
use espalier_reading::{Between, Bounded};
use espalier_session::{Document, DocumentError, LeftOut};
use espalier_settings::{AppearancePatch, ParametersPatch};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, Visitor},
};
use serde_json::Value;

use self::notes::{JobNote, notes_of};
pub(super) use self::{
    archive::archive,
    list::{JobPage, Page, list},
};
use super::{
    Shared, exports,
    failure::{Body, Failure, Path},
    guard::Named,
    ranges, sessions, trees,
};
use crate::{
    access::{Action, Caller},
    export_options::ExportOptions,
    formats::{FORMATS, FormatRow},
    jobs::{self, Job, NotTaken, Order},
    pool::Class,
    recipe::{Recipe, SeedRange},
    similar::{asked_for, similar},
    store::Library,
};

/// Seeds of one job.
const MOST_SEEDS: usize = 1000;

/// What to grow, one tree for each seed.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GrowTrees {
    /// The short name of a species, or the identifier of a saved tree: its programme, parameters and looks, grown to its age.
    /// Without it a seedling grows.
    template: Option<String>,
    /// Parameters to set, at every age.
    #[serde(default)]
    parameters: ParametersPatch,
    /// Looks to set.
    #[serde(default)]
    appearance: AppearancePatch,
    /// Up to 1000 different seeds: a list, or a text as "1-50" or "7"; 1 if left out.
    #[serde(default)]
    seeds: WantedSeeds,
    /// Steps to grow on for.
    steps: Option<Steps>,
    /// Living metamers to grow on to.
    #[schemars(with = "Option<u32>")]
    metamers: Option<Value>,
    /// How the names of files of the format end, as `GET /api/v1/formats` tells them.
    format: Ending,
    /// Options of the format.
    #[serde(default)]
    options: ExportOptions,
}

/// How the names of files of a format end.
#[derive(Debug)]
struct Ending(&'static FormatRow);

impl<'de> Deserialize<'de> for Ending {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;

        impl Visitor<'_> for Reader {
            type Value = Ending;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&endings().join(", "))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Ending, E> {
                let row = FORMATS.iter().find(|row| row.ending == text).map(Ending);
                row.ok_or_else(|| {
                    let found = format!("{text}{}", asked_for(text, endings()));
                    E::custom(NotAllowed::new(found, endings().join(", ")))
                })
            }
        }

        deserializer.deserialize_str(Reader)
    }
}

impl JsonSchema for Ending {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "ExportEnding".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "enum": endings() })
    }
}

fn endings() -> Vec<&'static str> {
    FormatRow::endings().collect()
}

/// Seeds, each once.
#[derive(Debug, PartialEq)]
struct WantedSeeds(Vec<u32>);

impl Default for WantedSeeds {
    fn default() -> Self {
        Self(vec![1])
    }
}

impl WantedSeeds {
    fn allowed() -> String {
        format!("a list of 1 to {MOST_SEEDS} different seeds, or a text as 1-50 or 7")
    }

    fn read(value: &Value) -> Result<Self, NotAllowed> {
        let not_allowed = |found: String| NotAllowed::new(found, Self::allowed());
        let seeds: Vec<u32> = match value {
            Value::String(text) => {
                let SeedRange(seeds) = text.parse().map_err(|_| not_allowed(format!("\"{text}\"")))?;
                seeds.take(MOST_SEEDS + 1).collect()
            }
            Value::Array(list) => {
                list.iter().take(MOST_SEEDS + 1).enumerate().map(read_seed).collect::<Result<_, _>>()?
            }
            other => return Err(not_allowed(other.to_string())),
        };
        match seeds.len() {
            0 => return Err(NotAllowed { kind: Some("too-few"), ..not_allowed("no seed".into()) }),
            1..=MOST_SEEDS => {}
            _ => {
                let found = format!("more than {MOST_SEEDS} seeds");
                return Err(NotAllowed { kind: Some("too-many"), ..not_allowed(found) });
            }
        }
        let mut before = BTreeSet::new();
        match seeds.iter().position(|seed| !before.insert(*seed)) {
            Some(again) => Err(NotAllowed {
                at: format!("[{again}]"),
                ..NotAllowed::new(format!("{}, which stands before it as well", seeds[again]), "another seed")
            }),
            None => Ok(Self(seeds)),
        }
    }
}

fn read_seed((at, seed): (usize, &Value)) -> Result<u32, NotAllowed> {
    let read = seed.as_u64().and_then(|seed| u32::try_from(seed).ok());
    read.ok_or_else(|| NotAllowed {
        at: format!("[{at}]"),
        ..NotAllowed::new(seed.to_string(), Between(0, u32::MAX).to_string())
    })
}

impl<'de> Deserialize<'de> for WantedSeeds {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::read(&Value::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl JsonSchema for WantedSeeds {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Seeds".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [
            { "type": "string", "pattern": "^[0-9]+(-[0-9]+)?$" },
            {
                "type": "array",
                "items": { "type": "integer", "minimum": 0, "maximum": u32::MAX },
                "minItems": 1,
                "maxItems": MOST_SEEDS,
                "uniqueItems": true,
            },
        ] })
    }
}

/// Where a job is.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
enum JobState {
    /// Others come first.
    Waiting,
    /// Its trees are being grown.
    Growing,
    /// Every seed has its file or its problem.
    Done,
    /// It ended before: `problem` says why.
    Failed,
}

/// A job, and how far it is.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct JobNow {
    /// Its name.
    id: String,
    /// Where it is.
    state: JobState,
    /// Jobs that come first.
    ahead: usize,
    /// Seeds that have their file or their problem.
    done: usize,
    /// All seeds.
    all: usize,
    /// The tree under way.
    #[serde(skip_serializing_if = "Option::is_none")]
    growing: Option<UnderWay>,
    /// Files, in the order of the seeds; there from when they are made until an hour after the job has ended.
    results: Vec<GrownTree>,
    /// Trees that could not be made.
    failed: Vec<FailedTree>,
    /// Why it ended before it was done.
    #[serde(skip_serializing_if = "Option::is_none")]
    problem: Option<Problem>,
    /// What is to be known of all its trees (JB10).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    notes: Vec<JobNote>,
}

/// A tree under way.
#[derive(Debug, Serialize, JsonSchema)]
struct UnderWay {
    /// Its seed.
    seed: u32,
    /// Living metamers so far.
    metamers: u32,
    /// Bytes of its file so far.
    bytes: u64,
}

/// A tree that has its file.
#[derive(Debug, Serialize, JsonSchema)]
struct GrownTree {
    /// Its seed.
    seed: u32,
    /// Living metamers.
    metamers: u32,
    /// Bytes of the file.
    bytes: u64,
    /// Where the file is.
    address: String,
}

/// A tree that could not be made.
#[derive(Debug, Serialize, JsonSchema)]
struct FailedTree {
    /// Its seed.
    seed: u32,
    /// Why.
    problem: Problem,
}

impl From<jobs::State> for JobState {
    fn from(state: jobs::State) -> Self {
        match state {
            jobs::State::Waiting => Self::Waiting,
            jobs::State::Growing => Self::Growing,
            jobs::State::Done => Self::Done,
            jobs::State::Failed => Self::Failed,
        }
    }
}

impl JobNow {
    fn of(id: String, job: &Job, ahead: usize) -> Self {
        let jobs::Progress { state, grown, failed, problem, seed, .. } = job.progress();
        let (metamers, bytes) = job.under_way();
        let address = |seed| format!("{}/results/{seed}", address_of(&id));
        let results = grown.iter().map(|&jobs::Grown { seed, metamers, bytes, .. }| GrownTree {
            seed,
            metamers,
            bytes,
            address: address(seed),
        });
        Self {
            state: state.into(),
            ahead,
            done: grown.len() + failed.len(),
            all: job.order.seeds.len(),
            growing: seed.map(|seed| UnderWay { seed, metamers, bytes }),
            results: results.collect(),
            failed: failed.into_iter().map(|(seed, problem)| FailedTree { seed, problem }).collect(),
            problem,
            notes: notes_of(&job.order.left_out),
            id,
        }
    }
}

fn address_of(id: &str) -> String {
    format!("/api/v1/jobs/{id}")
}

/// Begins a job (`JB1`).
pub(super) async fn grow(
    State(shared): State<Shared>,
    caller: Caller,
    Body(wanted): Body<GrowTrees>,
) -> Result<impl IntoResponse, Failure> {
    let GrowTrees { template, parameters, appearance, seeds, steps, metamers, format, options } = wanted;
    let Ending(row) = format;
    exports::checked(row, &options).map_err(|problem| problem.within("options"))?;
    let budget = shared.metamer_budget;
    // Read here, for no type knows how many this server allows.
    let range = Between(1, budget);
    let metamers = metamers.map(|metamers| in_field("metamers", &metamers, Bounded(range, &range)));
    let metamers = metamers.transpose()?;
    let (recipe, species, left_out) = match &template {
        None if steps.is_none() && metamers.is_none() => {
            let message = "There is no template, so that nothing says how far the trees grow.";
            let problem = Problem::new(Reason::Malformed, message);
            return Err(problem.at("metamers", "metamers, steps or a template").into());
        }
        None => (Recipe::default(), None, LeftOut::default()),
        Some(template) => recipe_of(&shared, &caller, template).await?,
    };
    let recipe = Recipe { parameters, appearance, steps, metamers, budget, ..recipe };
    recipe.check()?;
    let WantedSeeds(seeds) = seeds;
    let order = Order { by: caller.clone(), recipe, seeds, species, row, options, left_out };
    let id = shared.jobs.add(order)?;
    let (job, ahead) = shared.jobs.find(&id, &caller).ok_or_else(no_job)?;
    let location = [(header::LOCATION, address_of(&id))];
    Ok((StatusCode::ACCEPTED, location, Json(JobNow::of(id, &job, ahead))))
}

/// How trees like a species or a saved tree grow, and what of it they are without.
async fn recipe_of(
    shared: &Shared,
    caller: &Caller,
    template: &str,
) -> Result<(Recipe, Option<&'static species::Species>, LeftOut), Failure> {
    if let Some(species) = species::find(template) {
        return Ok((Recipe::of(species), Some(species), LeftOut::default()));
    }
    shared.ask(caller, Action::OpenTree, Named::Tree(template)).await?;
    let tree = shared.store.tree(template).await?.filter(|tree| tree.deleted_at.is_none());
    let Some(tree) = tree else { return Err(no_template(shared, template).await?) };
    let saved = sessions::saved_document(shared, template, tree.head.number).await?;
    let read = shared.pool.run(Class::Whole, template.into(), move |_| {
        let document = Document::from_bytes(&saved.bytes)?;
        Ok::<_, DocumentError>((document.variation(), document.species(), document.left_out()))
    });
    let (script, species, left_out) = read.await?.map_err(|error| sessions::unreadable(template, &error))?;
    let species = species.as_deref().and_then(species::find);
    Ok((Recipe { script, ..Recipe::default() }, species, left_out))
}

/// What whoever names no template is told: also which species, or which saved tree by its name, they may have meant.
async fn no_template(shared: &Shared, template: &str) -> Result<Failure, Failure> {
    let trees = trees::mistakable(shared).await?;
    let known = species::all().iter().map(|species| species.slug);
    let known = known.chain(trees.iter().flat_map(|tree| [&*tree.id, &*tree.name]));
    let meant = similar(template, known).map(|found| trees::meant(&trees, found));
    let meant = meant.unwrap_or_else(|| ".".to_owned());
    let problem = Problem::new(Reason::NoTree, format!("There is no such species or saved tree{meant}"));
    Ok(problem.at("template", "the name of a species, or the identifier of a saved tree").into())
}

fn no_job() -> Failure {
    Failure::none_such("job", "job", "the name of a job that you ordered and that is kept")
}

/// How far a job is (`JB2`).
pub(super) async fn find(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
) -> Result<Json<JobNow>, Failure> {
    let (job, ahead) = shared.jobs.find(&id, &caller).ok_or_else(no_job)?;
    Ok(Json(JobNow::of(id, &job, ahead)))
}

/// A file of a job (`JB3`).
pub(super) async fn result(
    State(shared): State<Shared>,
    caller: Caller,
    Path((id, seed)): Path<(String, u32)>,
    asked: HeaderMap,
) -> Result<Response, Failure> {
    let (job, _) = shared.jobs.find(&id, &caller).ok_or_else(no_job)?;
    let found = job.open(seed).map_err(|error| {
        tracing::error!(%error, "a file of a job cannot be read");
        Failure::new(Reason::NotExported, "The file cannot be read.")
    })?;
    let (file, length) =
        found.ok_or_else(|| Failure::none_such("file", "seed", "a seed in the results of the job"))?;
    let tag = ranges::tag(&[id.as_bytes(), &seed.to_le_bytes()]);
    ranges::answer(&asked, exports::headers(job.order.row, &seed.to_string()), &tag, file, length)
}

/// Ends a job and takes its files away (`JB4`).
pub(super) async fn give_up(
    State(shared): State<Shared>,
    caller: Caller,
    Path(id): Path<String>,
) -> Result<StatusCode, Failure> {
    if shared.jobs.give_up(&id, &caller) { Ok(StatusCode::NO_CONTENT) } else { Err(no_job()) }
}

impl From<NotTaken> for Failure {
    fn from(error: NotTaken) -> Self {
        match error {
            NotTaken::Full | NotTaken::Share => {
                Self::new(Reason::JobsFull, format!("{error}; try again when one has ended or was given up."))
            }
            NotTaken::Stopping => Self::new(Reason::Stopping, "The server is stopping."),
            NotTaken::Disk(error) => {
                tracing::error!(%error, "a job has no room on the disk");
                Self::new(Reason::JobsDiskFull, "The server's disk cannot be written.")
            }
        }
    }
}
