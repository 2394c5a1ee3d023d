//! Growing without a server: `espalier replay` and `espalier grow`.

mod bench;
mod design;
mod grammar;
mod species;
mod stats;
mod surroundings;

use std::{
    fs,
    io::{self, Read, Write},
    path::{Path, PathBuf},
    time::Instant,
};

use espalier_growth::{DEFAULT_METAMER_BUDGET, species::Species};
use espalier_proto::{Action, Problem, Steps};
use espalier_session::{Document, ScriptError, read_commands};
use espalier_settings::ParametersPatch;

use self::bench::Bench;
pub use self::species::species;
pub use self::stats::resident_memory_bytes;
use crate::{
    cli::{self, Grow, NoFormat, Replay, Results, SEED, Start},
    export_options::NotOfFormat,
    formats,
    import::{self as imports, ImportNote, Imported},
    output::OutputError,
    pool::SimulationPool,
    progress::Bar,
    recipe::{GrowError, Recipe, SeedRange},
};

/// The command could not be done; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum HeadlessError {
    /// The script cannot be done.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The script or file cannot be read.
    #[error("The file {} cannot be read: {cause}.", path.display())]
    Read {
        /// Which file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
    /// The file cannot become a tree.
    #[error("The file {} cannot become a tree: {cause}.", path.display())]
    Import {
        /// Which file.
        path: PathBuf,
        /// Why not.
        cause: imports::ImportError,
    },
    /// The parameters given are out of range.
    #[error("A parameter cannot be set: {0}.")]
    Parameters(Problem),
    /// The result cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Standard output has no ending.
    #[error(transparent)]
    NoFormat(#[from] NoFormat),
    /// The format has no such option.
    #[error("The export cannot be done: {0}.")]
    Options(#[from] NotOfFormat),
    /// The tree cannot be grown.
    #[error(transparent)]
    Grow(#[from] GrowError),
    /// The tree cannot grow on.
    #[error("The tree cannot grow on: {0}.")]
    Growth(Problem),
    /// The text is no grammar.
    #[error("The file {} is no grammar:\n{causes}", path.display())]
    Grammar {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it, a line each.
        causes: String,
    },
    /// The grammar cannot be derived so deep.
    #[error("The grammar ended at depth {reached} of {wanted}: {cause}.")]
    GrammarEnded {
        /// Steps derived.
        reached: u32,
        /// Steps asked for.
        wanted: u32,
        /// Why it ended.
        cause: String,
    },
    /// What is to stand around does not fit.
    #[error("The file {} is no {what}: {cause}.", path.display())]
    Surroundings {
        /// Which file.
        path: PathBuf,
        /// What it should be.
        what: &'static str,
        /// What is wrong with it.
        cause: String,
    },
    /// The file is no design.
    #[error("The file {} is no design: {cause}.", path.display())]
    Design {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        cause: String,
    },
    /// No template, and no file, has the name.
    #[error("There is no template {name:?}{hint}, and no file of that name.")]
    NoDesign {
        /// How it was called.
        name: String,
        /// What may have been meant.
        hint: String,
    },
    /// Many trees would be written to one file.
    #[error("The export of several seeds needs {SEED} in its name, as in oak-{SEED}.glb.")]
    OneName,
    /// The threads cannot be made.
    #[error("The simulation's threads cannot be started: {0}.")]
    Pool(#[from] rayon::ThreadPoolBuildError),
}

/// `espalier replay`.
pub fn replay(options: &Replay) -> Result<(), HeadlessError> {
    check(&options.results)?;
    let bytes =
        read(&options.script).map_err(|cause| HeadlessError::Read { path: options.script.clone(), cause })?;
    let name = options.script.display().to_string();
    // All lines are read before the first is done: a typo at the end should not cost the time of the rest.
    let script = read_commands(&name, &bytes)?;
    let bench = SimulationPool::new(options.results.threads)?.block_on(|| {
        let mut bench =
            bench(started(options.seed, &options.start, DEFAULT_METAMER_BUDGET)?, &options.results);
        for (line, command) in &script {
            bench.apply(command).map_err(|problem| ScriptError {
                name: name.clone(),
                line: *line,
                problem: Box::new(problem),
            })?;
        }
        Ok::<_, HeadlessError>(bench)
    })?;
    finish(bench, None, &options.results)
}

/// `espalier grow`.
pub fn grow(options: &Grow) -> Result<(), HeadlessError> {
    check(&options.results)?;
    let pool = SimulationPool::new(options.results.threads)?;
    // Standard input can be read once only, and what is said of a text is said once.
    let wanted = Wanted::read(options)?;
    let Some(SeedRange(seeds)) = &options.seeds else {
        return finish(grown(options, &wanted, options.seed, &pool)?, options.species, &options.results);
    };
    let name = options.results.export.as_ref().map(|export| export.path.to_string_lossy().into_owned());
    if name.as_ref().is_some_and(|name| !name.contains(SEED)) {
        return Err(HeadlessError::OneName);
    }
    let bar = Bar::of(seeds.clone().count(), "trees");
    for seed in seeds.clone() {
        let mut results = options.results.clone();
        if let (Some(export), Some(name)) = (&mut results.export, &name) {
            export.path = name.replace(SEED, &seed.to_string()).into();
        }
        let bench = grown(options, &wanted, seed, &pool)?;
        bar.aside(|| finish(bench, options.species, &results))?;
        bar.step();
    }
    Ok(())
}

/// What is grown, as the files say.
struct Wanted {
    planted: Option<grammar::Planted>,
    /// What stands around it.
    obstacles: Vec<Action>,
    /// Parameters that are set by hand.
    parameters: ParametersPatch,
}

impl Wanted {
    fn read(options: &Grow) -> Result<Self, HeadlessError> {
        let space = options.space.as_deref().map(surroundings::body).transpose()?;
        let grammar = options.grammar.as_deref();
        let planted = grammar.map(|path| grammar::planted(path, options.depth, space)).transpose()?;
        // All at once: weights that are changed one by one do not sum to 1 in between.
        let patches = options.start.parameters.iter();
        let parameters = patches.fold(ParametersPatch::default(), |all, patch| all.patched(patch));
        let metres = Document::new(0).parameters().patched(&parameters).internode_length;
        let mut obstacles = Vec::new();
        for path in &options.obstacles {
            obstacles.extend(surroundings::obstacles(path, metres)?);
        }
        Ok(Self { planted, obstacles, parameters })
    }
}

/// One tree.
fn grown(options: &Grow, wanted: &Wanted, seed: u32, pool: &SimulationPool) -> Result<Bench, HeadlessError> {
    let depth = wanted.planted.as_ref().map(|planted| planted.depth);
    let of_seed = options.seeds.is_some().then_some(seed);
    let designed = options.design.as_deref().map(|path| design::planted(path, of_seed)).transpose()?;
    let planted = wanted.planted.as_ref().map(|planted| planted.action.clone());
    let base = match planted.or(designed) {
        Some(action) => Recipe { script: vec![action], ..Recipe::default() },
        None => options.species.map(Recipe::of).unwrap_or_default(),
    };
    let is_set = wanted.parameters != ParametersPatch::default();
    // A recipe without a script begins with its parameters.
    let set =
        (is_set && options.species.is_none() && !(base.script.is_empty() && wanted.obstacles.is_empty()))
            .then(|| Action::SetParameters { parameters: wanted.parameters.clone() });
    let script = set.into_iter().chain(wanted.obstacles.iter().cloned()).chain(base.script).collect();
    let recipe = Recipe {
        script,
        parameters: wanted.parameters.clone(),
        steps: options.steps,
        metamers: options.metamers,
        // Dead metamers count as well, and how many will die is not known before.
        budget: options.start.budget.unwrap_or(u32::MAX),
        ..base
    };
    pool.block_on(|| {
        let seedling = recipe.seedling(seed).map_err(HeadlessError::Parameters)?;
        let mut bench = bench(seedling, &options.results);
        let before = recipe.grow(&mut bench)?;
        if let Some(wanted) = recipe.metamers.filter(|&wanted| before > wanted) {
            // A reader that has gone is no error of ours.
            let _ = writeln!(
                io::stderr(),
                "The tree of seed {seed} has {before} metamers before it grows on, so that --metamers {wanted} changes nothing."
            );
        }
        depth.map_or(Ok(()), |depth| grammar::check(bench.document_mut(), depth))?;
        Ok(bench)
    })
}

/// `espalier import`.
pub fn import(options: &cli::Import) -> Result<(), HeadlessError> {
    check(&options.results)?;
    let path = options.file.path.clone();
    let bytes = read(&path).map_err(|cause| HeadlessError::Read { path: path.clone(), cause })?;
    let budget = options.start.budget.unwrap_or(DEFAULT_METAMER_BUDGET);
    let import = imports::Import {
        format: options.file.format,
        units: options.options.units(),
        seed: options.seed,
        species: options.options.species(),
        parameters: [&[options.options.parameters()], &*options.start.parameters].concat(),
        metamers: budget,
    };
    let bar = Bar::turning("making a tree of the file");
    let bench = SimulationPool::new(options.results.threads)?.block_on(|| {
        let made = imports::document(&bytes, &import);
        let Imported { mut document, notes } = made.map_err(|cause| HeadlessError::Import { path, cause })?;
        bar.aside(|| notes.iter().for_each(ImportNote::print));
        document.set_metamer_budget(budget);
        let mut bench = bench(document, &options.results);
        if let Some(steps) = options.grow.map(Steps::nearest) {
            let grow = Action::Grow { steps, until: None, bud: None }.into();
            bench.apply(&grow).map_err(HeadlessError::Growth)?;
        }
        Ok::<_, HeadlessError>(bench)
    })?;
    drop(bar);
    finish(bench, None, &options.results)
}

/// Whether the export can be done, before anything grows.
fn check(results: &Results) -> Result<(), HeadlessError> {
    if let Some(target) = results.target()? {
        results.options.check(target.row.options)?;
        target.check()?;
    }
    Ok(())
}

/// A seedling as the options want it.
fn started(seed: u32, start: &Start, budget: u32) -> Result<Document, HeadlessError> {
    let defaults = Document::new(seed).parameters();
    let wanted = start.parameters.iter().fold(defaults, |all, patch| all.patched(patch));
    let mut document = Document::with_parameters(seed, &wanted).map_err(HeadlessError::Parameters)?;
    document.set_metamer_budget(start.budget.unwrap_or(budget));
    Ok(document)
}

fn bench(document: Document, results: &Results) -> Bench {
    let bench = Bench::new(document);
    if results.no_deltas { bench.unfollowed() } else { bench }
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    if path == Path::new("-") {
        let mut bytes = Vec::new();
        io::stdin().read_to_end(&mut bytes)?;
        return Ok(bytes);
    }
    fs::read(path)
}

fn finish(
    mut bench: Bench,
    species: Option<&'static Species>,
    results: &Results,
) -> Result<(), HeadlessError> {
    let mut stats = bench.stats();
    let target = results.target()?;
    if let Some(target) = &target {
        let begun = Instant::now();
        target.write(|out| {
            formats::write(bench.document_mut(), species, target.row.format, &results.options, out)
        })?;
        stats.exported(begun.elapsed());
    }
    let text = if results.stats.is_some() { stats.to_json() } else { stats.summary() };
    // A reader that has gone, as `head` may, is no error of ours.
    let _ = match target {
        Some(target) if target.is_stdout() => writeln!(io::stderr(), "{text}"),
        _ => writeln!(io::stdout(), "{text}"),
    };
    Ok(())
}
