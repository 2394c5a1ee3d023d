//! What the command line writes: a file in some format, and figures.

use std::{num::NonZeroUsize, path::PathBuf};

use clap::{Args, ValueEnum};

use crate::{
    export_options::ExportOptions,
    formats::{FORMATS, FormatRow},
    output::{STDOUT, Target},
    similar::similar,
};

/// What comes out, and with how many threads.
#[derive(Clone, Debug, Args)]
pub struct Results {
    /// Write the plants to a file.
    #[arg(long, value_name = "OUT", value_parser = parse_export, help = export_help())]
    pub export: Option<Export>,
    /// The format, by its ending, whatever the file is called; needed for `-`.
    #[arg(long, value_name = "ENDING", requires = "export", value_parser = parse_format)]
    pub format: Option<&'static FormatRow>,
    #[command(flatten)]
    pub options: ExportOptions,
    /// Print figures as one JSON object instead of a summary; docs/command-line.md explains them.
    #[arg(long, value_name = "FORMAT")]
    pub stats: Option<Stats>,
    /// Make no mesh deltas: time and memory are those of growth alone.
    #[arg(long)]
    pub no_deltas: bool,
    /// Threads of the simulation; one for each core if not given. The plants do not depend on it.
    #[arg(long)]
    pub threads: Option<NonZeroUsize>,
}

impl Results {
    /// Where the export goes, and as what.
    pub fn target(&self) -> Result<Option<Target>, NoFormat> {
        self.export.as_ref().map(|export| export.target(self.format)).transpose()
    }
}

/// Formats of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Stats {
    /// One JSON object.
    Json,
}

/// A file to write.
#[derive(Clone, Debug)]
pub struct Export {
    /// Where.
    pub path: PathBuf,
    /// As what, by its name.
    row: Option<&'static FormatRow>,
}

/// Standard output has no ending that tells a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("An export to standard output needs its format, as in --format glb.")]
pub struct NoFormat;

impl Export {
    /// The file in the format that was given, or in that of its name.
    pub fn target(&self, format: Option<&'static FormatRow>) -> Result<Target, NoFormat> {
        Ok(Target { path: self.path.clone(), row: format.or(self.row).ok_or(NoFormat)? })
    }
}

pub(super) fn parse_export(path: &str) -> Result<Export, String> {
    if path == STDOUT {
        return Ok(Export { path: path.into(), row: None });
    }
    let path = PathBuf::from(path);
    let name = path.file_name().map(|name| name.to_string_lossy().to_lowercase()).unwrap_or_default();
    let ends = |row: &&FormatRow| {
        name.strip_suffix(row.ending).is_some_and(|stem| stem.len() > 1 && stem.ends_with('.'))
    };
    // Of endings that both fit the longer one is meant.
    let row = FORMATS.iter().filter(ends).max_by_key(|row| row.ending.len()).ok_or_else(|| {
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        format!("{}the name must end in one of: {}", unknown(ending), endings())
    })?;
    Ok(Export { path, row: Some(row) })
}

pub(super) fn parse_format(ending: &str) -> Result<&'static FormatRow, String> {
    let ending = ending.trim_start_matches('.');
    let found = FORMATS.iter().find(|row| row.ending == ending);
    found.ok_or_else(|| format!("{}it must be one of: {}", unknown(ending), endings()))
}

/// Which format may have been meant by another ending.
fn unknown(ending: &str) -> String {
    similar(ending, FormatRow::endings())
        .map(|known| format!("unknown format `{ending}`: did you mean `{known}`? "))
        .unwrap_or_default()
}

fn export_help() -> String {
    let all: Vec<_> = FORMATS.iter().map(|row| format!(".{}", row.ending)).collect();
    let (last, others) = all.split_last().map_or(("", &[][..]), |(last, others)| (last, others));
    format!(
        "Write the plants to a file, in the format of its ending: {} or {last}; docs/formats.md says what is in them, and \
         which options each has. `-` is standard output",
        others.join(", ")
    )
}

fn endings() -> String {
    let all: Vec<_> = FORMATS.iter().map(|row| format!(".{} ({})", row.ending, row.what)).collect();
    all.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::Format;

    #[test]
    fn the_extension_chooses_the_format() {
        let format = |path| parse_export(path).unwrap().target(None).map(|target| target.row.format);
        assert_eq!(format("a/tree.GLB"), Ok(Format::Glb));
        assert_eq!(format("tree.json"), Ok(Format::Skeleton));
        assert_eq!(format("tree.obj.zip"), Ok(Format::Obj));
        assert_eq!(format("tree.png"), Ok(Format::Picture));
        assert_eq!(format("tree.sway.png"), Ok(Format::Sway));
        assert_eq!(format("tree.csv"), Ok(Format::Qsm));
        assert_eq!(format("tree.joints.csv"), Ok(Format::Joints));
        for bad in ["tree", "tree.obj", "glb", ".json"] {
            assert!(parse_export(bad).unwrap_err().contains(".glb"), "{bad}");
        }
    }

    #[test]
    fn help_lists_every_format() {
        let command = Results::augment_args(clap::Command::new("grow"));
        let export = command.get_arguments().find(|argument| argument.get_id() == "export");
        let help = export.and_then(|export| export.get_help()).map(ToString::to_string).unwrap_or_default();
        for row in FORMATS {
            assert!(help.contains(&format!(".{}", row.ending)), "{}: {help}", row.ending);
        }
    }

    #[test]
    fn standard_output_needs_a_format() {
        let stdout = parse_export("-").unwrap();
        assert_eq!(stdout.target(None).map(|target| target.row.format), Err(NoFormat));
        let target = stdout.target(Some(parse_format("mtg").unwrap())).unwrap();
        assert_eq!((target.row.format, target.is_stdout()), (Format::Mtg, true));
        assert!(parse_format("fbx").unwrap_err().starts_with("it must be one of: .glb"));
        let told = "unknown format `gltf`: did you mean `glb`? ";
        assert!(parse_format("gltf").unwrap_err().starts_with(told));
        assert!(parse_export("tree.gltf").unwrap_err().starts_with(told));
    }
}
