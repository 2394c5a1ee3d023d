//! What is made of the command line's definition: completions of shells, and the manual's pages.

use std::{fs, io, path::Path};

use clap::CommandFactory;
use clap_complete::Shell;

use crate::{cli::Cli, output};

/// The program's name, as one types it.
const NAME: &str = "espalier";

/// Prints what a shell completes options and names by.
pub fn completions(shell: Shell) -> io::Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), NAME, &mut script);
    output::print(&script)
}

/// Writes the pages `espalier.1`, `espalier-grow.1` and so on.
pub fn pages(folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    clap_mangen::generate_to(Cli::command(), folder)
}
