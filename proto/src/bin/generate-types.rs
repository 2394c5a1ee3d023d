//! Writes `client/src/wire/generated.ts`; with `--check` only says whether it is current.

use std::{path::Path, process::ExitCode};

fn main() -> ExitCode {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../client/src/wire/generated.ts");
    let wanted = espalier_proto::typescript::declarations();
    if std::env::args().nth(1).as_deref() == Some("--check") {
        if std::fs::read_to_string(&path).is_ok_and(|found| found == wanted) {
            return ExitCode::SUCCESS;
        }
        eprintln!(
            "{} is out of date: run `cargo run -p espalier-proto --bin generate-types`",
            path.display()
        );
        return ExitCode::FAILURE;
    }
    match std::fs::write(&path, wanted) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}
