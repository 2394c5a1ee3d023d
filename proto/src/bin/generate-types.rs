//! Writes `client/src/wire/generated.ts`, `generated-tables.ts` and `generated-models.ts` beside it, the tables of `PROTOCOL.md` and
//! `protocol.schema.json`; with `--check` only says whether they are current.

use std::{fs, path::Path, process::ExitCode};

use espalier_proto::{protocol_tables, schema, typescript};

fn main() -> ExitCode {
    let is_check = std::env::args().nth(1).as_deref() == Some("--check");
    match bring_up_to_date(Path::new(env!("CARGO_MANIFEST_DIR")), is_check) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn bring_up_to_date(home: &Path, is_check: bool) -> Result<(), String> {
    let wire = home.join("../client/src/wire");
    let types = (wire.join("generated.ts"), typescript::declarations());
    let settings = (wire.join("generated-tables.ts"), typescript::tables());
    let models = (wire.join("generated-models.ts"), typescript::models());
    let document = home.join("PROTOCOL.md");
    let read = |path: &Path| fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()));
    let with_tables = protocol_tables::with_tables(&read(&document)?).map_err(|error| error.to_string())?;
    let schema = (home.join("protocol.schema.json"), schema::document());
    for (path, wanted) in [types, settings, models, (document, with_tables), schema] {
        if read(&path).is_ok_and(|found| found == wanted) {
            continue;
        }
        if is_check {
            let path = path.display();
            return Err(format!(
                "{path} is out of date: run `cargo run -p espalier-proto --bin generate-types`"
            ));
        }
        fs::write(&path, wanted).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}
