//! Writes the seeds of a target into a folder, one file each, for a hunt to start from: `write-seeds TARGET FOLDER`.

use std::{env, fs, path::Path, process::ExitCode};

use espalier_fuzz::TARGETS;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [name, folder] = arguments.as_slice() else {
        return failed("write-seeds needs a target and a folder");
    };
    let Some(target) = TARGETS.iter().find(|target| target.name == name) else {
        return failed(&format!(
            "there is no target {name}; there are: {}",
            TARGETS.map(|target| target.name).join(", ")
        ));
    };
    let write = || -> std::io::Result<()> {
        fs::create_dir_all(folder)?;
        for (number, seed) in (target.seeds)().iter().enumerate() {
            fs::write(Path::new(folder).join(format!("seed-{number}")), seed)?;
        }
        Ok(())
    };
    match write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => failed(&format!("the seeds cannot be written to {folder}: {error}")),
    }
}

fn failed(sentence: &str) -> ExitCode {
    eprintln!("{sentence}");
    ExitCode::from(2)
}
