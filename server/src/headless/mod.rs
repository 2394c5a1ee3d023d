//! Growing without a server: `espalier replay` and `espalier grow`.

mod bench;
mod species;
mod stats;

use std::{
    fs,
    io::{self, BufWriter, Read, Write},
    path::{Path, PathBuf},
    time::Instant,
};

use espalier_export::ExportError;
use espalier_growth::{DEFAULT_METAMER_BUDGET, species::Species};
use espalier_proto::{Action, Command, Problem, Steps};
use espalier_session::{Document, ScriptError, read_commands};

use self::bench::Bench;
pub use self::species::species;
use crate::{
    cli::{self, Export, Grow, Replay, Results, SEED, Seeds, Start},
    document,
    export_options::{ExportOptions, NotOfFormat},
    import as imports,
    pool::SimulationPool,
};

/// Commands of a script and of `grow` are done in this name.
const AUTHOR: &str = "command-line";
/// A tree that adds nothing in so many steps will not add anything any more.
const PATIENCE: u32 = 50;

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
    #[error("The export {} cannot be written: {cause}.", path.display())]
    Write {
        /// Which file.
        path: PathBuf,
        /// Why not.
        cause: io::Error,
    },
    /// The format has no such option.
    #[error("The export cannot be done: {0}.")]
    Options(#[from] NotOfFormat),
    /// The result does not fit its format.
    #[error("The export failed: {0}.")]
    Export(#[from] ExportError),
    /// The tree does not get that large.
    #[error("The tree stopped growing with {alive} of {wanted} metamers.")]
    Stalled {
        /// Living metamers reached.
        alive: u32,
        /// Living metamers asked for.
        wanted: u32,
    },
    /// Many trees would be written to one file.
    #[error("The export of several seeds needs {SEED} in its name, as in oak-{SEED}.glb.")]
    OneName,
    /// The tree cannot grow on.
    #[error("The tree cannot grow on: {0}.")]
    Growth(Problem),
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
            bench.act(AUTHOR, command).map_err(|problem| ScriptError {
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
    let Some(Seeds(seeds)) = &options.seeds else {
        return finish(grown(options, options.seed, &pool)?, options.species, &options.results);
    };
    let name = options.results.export.as_ref().map(|export| export.path.to_string_lossy().into_owned());
    if name.as_ref().is_some_and(|name| !name.contains(SEED)) {
        return Err(HeadlessError::OneName);
    }
    for seed in seeds.clone() {
        let mut results = options.results.clone();
        if let (Some(export), Some(name)) = (&mut results.export, &name) {
            export.path = name.replace(SEED, &seed.to_string()).into();
        }
        finish(grown(options, seed, &pool)?, options.species, &results)?;
    }
    Ok(())
}

/// One tree.
fn grown(options: &Grow, seed: u32, pool: &SimulationPool) -> Result<Bench, HeadlessError> {
    pool.block_on(|| {
        // Dead metamers count as well, and how many will die is not known before.
        let mut bench = match options.species {
            Some(species) => {
                let budget = Start { parameters: Vec::new(), budget: options.start.budget };
                let mut bench = bench(started(seed, &budget, u32::MAX)?, &options.results);
                species::raise(&mut bench, species, &options.start.parameters)?;
                bench
            }
            None => bench(started(seed, &options.start, u32::MAX)?, &options.results),
        };
        let wanted = options.metamers.unwrap_or(0);
        // One operation for undo, however many steps it takes.
        let step = Command {
            gesture: Some(1),
            ..Action::Grow { steps: Steps::LEAST, until: None, bud: None }.into()
        };
        let (mut most, mut idle) = (0, 0);
        while bench.document().metamers() < wanted {
            let alive = bench.document().metamers();
            (most, idle) = if alive > most { (alive, 0) } else { (most, idle + 1) };
            let stalled = HeadlessError::Stalled { alive, wanted };
            if idle == PATIENCE || bench.act(AUTHOR, &step).is_err() {
                return Err(stalled);
            }
        }
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
        unit: options.unit,
        seed: options.seed,
        parameters: options.start.parameters.clone(),
        metamers: budget,
    };
    let bench = SimulationPool::new(options.results.threads)?.block_on(|| {
        let made = imports::document(&bytes, &import);
        let mut document = made.map_err(|cause| HeadlessError::Import { path, cause })?;
        document.set_metamer_budget(budget);
        let mut bench = bench(document, &options.results);
        if let Some(steps) = options.grow.map(Steps::nearest) {
            let grow = Action::Grow { steps, until: None, bud: None }.into();
            bench.act(AUTHOR, &grow).map_err(HeadlessError::Growth)?;
        }
        Ok::<_, HeadlessError>(bench)
    })?;
    finish(bench, None, &options.results)
}

/// Whether the export can be done, before anything grows.
fn check(results: &Results) -> Result<(), NotOfFormat> {
    results.export.as_ref().map_or(Ok(()), |export| results.options.check(export.row.options))
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

/// Writes a file beside its place and moves it there when it is whole.
fn write(
    document: &mut Document,
    species: Option<&'static Species>,
    Export { path, row }: &Export,
    options: &ExportOptions,
) -> Result<(), HeadlessError> {
    let failed = |cause| HeadlessError::Write { path: path.clone(), cause };
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let mut file = tempfile::Builder::new();
    #[cfg(unix)]
    file.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = file.tempfile_in(folder).map_err(failed)?;
    let mut out = BufWriter::new(file);
    match document::write(document, species, row.format, options, &mut out) {
        Err(ExportError::Write(kind)) => return Err(failed(kind.into())),
        written => written?,
    }
    let file = out.into_inner().map_err(|error| failed(error.into_error()))?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
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
    if let Some(export) = &results.export {
        let begun = Instant::now();
        write(bench.document_mut(), species, export, &results.options)?;
        stats.exported(begun.elapsed());
    }
    let text = if results.stats.is_some() { stats.to_json() } else { stats.summary() };
    // A reader that has gone, as `head` may, is no error of ours.
    let _ = writeln!(io::stdout(), "{text}");
    Ok(())
}
