//! The Espalier server and command line: a thin shell around the session's state machine.

mod access;
mod announce;
mod care;
mod cli;
mod document;
mod drawn;
mod export_options;
mod figures;
mod formats;
mod headless;
mod hosts;
mod http;
mod import;
mod import_options;
mod jobs;
mod library;
mod listener;
mod live;
mod load;
mod logging;
mod maintenance;
mod manual;
mod memory;
mod name;
mod output;
mod people;
mod places;
mod pool;
mod portrait;
mod problem_json;
mod progress;
mod queue;
mod recipe;
mod review;
mod serve;
mod similar;
mod spool;
mod store;
mod text;
mod time;

use std::{
    fmt::Display,
    io::{self, Write},
    process::ExitCode,
};

use clap::Parser;

use crate::{
    care::CareError,
    cli::{Cli, Command},
    headless::HeadlessError,
    library::LibraryError,
    load::LoadError,
    output::OutputError,
    people::PeopleError,
    recipe::GrowError,
    serve::ServeError,
};

pub use espalier_growth::SIMULATION_VERSION;

/// A script that cannot be done is the caller's mistake, like a wrong option (which clap ends with 2 as well).
const USAGE: u8 = 2;

fn main() -> ExitCode {
    let cli = Cli::parse();
    match cli.command {
        None => served(serve::run(&cli.serve)),
        Some(Command::Serve(options)) => served(serve::run(&options)),
        Some(Command::Replay(options)) => done(headless::replay(&options)),
        Some(Command::Grow(options)) => done(headless::grow(&options)),
        Some(Command::Import(options)) => done(headless::import(&options)),
        Some(Command::Species(options)) => done(headless::species(&options)),
        Some(Command::Invite(options)) => let_in(people::invite(options)),
        Some(Command::User(command)) => let_in(people::user(&command)),
        Some(Command::Group(command)) => let_in(people::group(&command)),
        Some(Command::Member(command)) => let_in(people::member(&command)),
        Some(Command::Audit(options)) => let_in(people::audit(&options)),
        Some(Command::Device(command)) => let_in(people::device(&command)),
        Some(Command::Token(command)) => let_in(people::token(&command)),
        Some(Command::Library(options)) => in_library(library::run(&options.command)),
        Some(Command::Backup(options)) => cared(care::backup(&options)),
        Some(Command::Restore(options)) => cared(care::restore(&options)),
        Some(Command::Check(options)) => cared(care::check(&options)),
        Some(Command::Load(options)) => measured(load::run(&options)),
        Some(Command::Completions(options)) => written(manual::completions(options.shell)),
        Some(Command::Man(options)) => written(manual::pages(&options.folder)),
    }
}

/// Says why it ends, to whoever may read it.
fn say(why: &dyn Display) {
    let _ = writeln!(io::stderr(), "{why}");
}

fn served(result: Result<(), ServeError>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    say(&error);
    ExitCode::FAILURE
}

fn written(result: io::Result<()>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    say(&format_args!("It cannot be written: {error}."));
    ExitCode::FAILURE
}

fn let_in(result: Result<(), PeopleError>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    say(&error);
    ExitCode::FAILURE
}

fn measured(result: Result<(), LoadError>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    say(&error);
    ExitCode::FAILURE
}

fn cared(result: Result<(), CareError>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    say(&error);
    ExitCode::FAILURE
}

fn in_library(result: Result<(), LibraryError>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    say(&error);
    if error.is_usage() { ExitCode::from(USAGE) } else { ExitCode::FAILURE }
}

fn done(result: Result<(), HeadlessError>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    say(&error);
    match error {
        HeadlessError::Script(_)
        | HeadlessError::Read { .. }
        | HeadlessError::Import { .. }
        | HeadlessError::Options(_)
        | HeadlessError::Design { .. }
        | HeadlessError::NoDesign { .. }
        | HeadlessError::Grammar { .. }
        | HeadlessError::Surroundings { .. }
        | HeadlessError::OneName
        | HeadlessError::NoFormat(_)
        | HeadlessError::Output(OutputError::Terminal(_))
        | HeadlessError::Parameters(_)
        | HeadlessError::Grow(GrowError::Refused(_)) => ExitCode::from(USAGE),
        _ => ExitCode::FAILURE,
    }
}
