//! `espalier backup`, `restore` and `check`: the care of a database.

use std::{
    io::{self, Write},
    path::PathBuf,
};

use crate::{cli, progress::Bar, store};

/// It could not be done; each message is one sentence.
#[derive(Debug, thiserror::Error)]
pub enum CareError {
    /// The database or a copy of it cannot be used.
    #[error(transparent)]
    Store(#[from] store::CareError),
    /// Some of what was read is damaged; what was printed names it.
    #[error("The database {} is damaged in {count} {places}; the rest is whole. A backup may have what is missing.", database.display(), places = if *count == 1 { "place" } else { "places" })]
    Damaged {
        /// Which database.
        database: PathBuf,
        /// How many parts of it.
        count: usize,
    },
    /// The runtime cannot be made.
    #[error("The program's threads cannot be started: {0}.")]
    Threads(#[from] io::Error),
}

/// `espalier backup`.
pub fn backup(options: &cli::Backup) -> Result<(), CareError> {
    let database = &options.database.path;
    let copied =
        run(store::backup(database, &options.file, options.replace, reports(Bar::of_bytes("copied"))))?;
    let bytes = copied?;
    print(&format!(
        "{} is backed up in {}: {} KiB.",
        database.display(),
        options.file.display(),
        bytes.div_ceil(1024)
    ));
    Ok(())
}

/// `espalier restore`.
pub fn restore(options: &cli::Restore) -> Result<(), CareError> {
    let database = &options.database.path;
    let restored = run(store::restore(&options.file, database, reports(Bar::of_bytes("copied"))))?;
    let kept = restored?;
    print(&format!("{} is as it was in {}.", database.display(), options.file.display()));
    if let Some(kept) = kept {
        print(&format!("What was there before is in {}.", kept.display()));
    }
    Ok(())
}

/// `espalier check`.
pub fn check(options: &cli::Check) -> Result<(), CareError> {
    let database = &options.database.path;
    let report = run(store::check(database, reports(Bar::of(0, "sessions and versions read"))))??;
    for part in &report.damage {
        print(part);
    }
    let store::Report { sessions, trees, versions, damage } = report;
    if !damage.is_empty() {
        return Err(CareError::Damaged { database: database.clone(), count: damage.len() });
    }
    print(&format!(
        "{} is whole: sessions {sessions}, trees {trees}, versions of them {versions}.",
        database.display()
    ));
    Ok(())
}

fn run<T>(work: impl Future<Output = T>) -> io::Result<T> {
    Ok(tokio::runtime::Builder::new_current_thread().enable_all().build()?.block_on(work))
}

fn reports(bar: Bar) -> impl FnMut(u64, u64) {
    move |now, all| bar.report(now, all)
}

fn print(line: &str) {
    // A reader that has gone is no error of ours.
    let _ = writeln!(io::stdout(), "{line}");
}
