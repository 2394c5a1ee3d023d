//! Builds the tablet client with npm and writes it out as a table of files for `src/http/client.rs` to embed.
//!
//! `ESPALIER_CLIENT_DIST=FOLDER` embeds a client built before instead; then Node.js is not needed.

use std::{
    env,
    fmt::Write as _,
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
    process::Command,
};

use flate2::{Compression, Crc, write::GzEncoder};

/// What the client's tools need, as in `client/package.json`.
const OLDEST_NODE: (u32, u32) = (20, 19);
const PREBUILT: &str = "ESPALIER_CLIENT_DIST";

/// What in `client/` the built client does not depend on.
const NOT_SOURCES: [&str; 6] = ["node_modules", "dist", "test", "coverage", "biome.json", "README.md"];

fn main() {
    println!("cargo::rerun-if-env-changed={PREBUILT}");
    if let Err(sentence) = build() {
        println!("cargo::error={}", sentence.replace('\n', " "));
    }
}

fn build() -> Result<(), String> {
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("OUT_DIR is not set; run this through cargo.")?);
    let dist = match env::var_os(PREBUILT).filter(|value| !value.is_empty()) {
        Some(folder) => {
            println!("cargo::rerun-if-changed={}", Path::new(&folder).display());
            PathBuf::from(folder)
        }
        None => build_client(&out)?,
    };
    embed(&dist, &out)
        .map_err(|error| format!("The client in {} cannot be embedded: {error}.", dist.display()))
}

fn build_client(out: &Path) -> Result<PathBuf, String> {
    let manifest =
        env::var_os("CARGO_MANIFEST_DIR").ok_or("CARGO_MANIFEST_DIR is not set; run this through cargo.")?;
    let client = Path::new(&manifest).with_file_name("client");
    watch(&client)
        .map_err(|error| format!("The client's sources in {} cannot be read: {error}.", client.display()))?;
    check_node()?;
    if needs_install(&client) {
        // It keeps to the lock as `npm ci` does, but takes a lock that lists this platform's optional packages only.
        npm(&client, &["install", "--no-save", "--no-audit", "--no-fund"])?;
    }
    let dist = out.join("client");
    npm(&client, &["run", "build", "--", "--emptyOutDir", "--outDir", &dist.to_string_lossy()])?;
    Ok(dist)
}

/// Cargo runs this again when one of these changes; `node_modules` changes by our own doing.
fn watch(client: &Path) -> io::Result<()> {
    for entry in fs::read_dir(client)? {
        let entry = entry?;
        if !NOT_SOURCES.iter().any(|name| entry.file_name() == *name) {
            // From this package, or checkouts that share a target folder would watch each other's.
            println!("cargo::rerun-if-changed=../client/{}", entry.file_name().display());
        }
    }
    Ok(())
}

fn check_node() -> Result<(), String> {
    let (major, minor) = OLDEST_NODE;
    let needed =
        format!("Espalier's client is built with Node.js {major}.{minor} or newer (https://nodejs.org)");
    let output = Command::new("node")
        .arg("--version")
        .output()
        .map_err(|_| format!("{needed}, but there is no `node` here: install it and build again."))?;
    let version = String::from_utf8_lossy(&output.stdout);
    let mut parts =
        version.trim().trim_start_matches('v').split('.').map_while(|part| part.parse::<u32>().ok());
    if (parts.next().unwrap_or(0), parts.next().unwrap_or(0)) < OLDEST_NODE {
        return Err(format!("{needed}, but `node` here is {}: update it and build again.", version.trim()));
    }
    npm_command().arg("--version").output().map_err(|_| {
        format!("{needed} and its npm, but there is no `npm` here: install it and build again.")
    })?;
    Ok(())
}

/// npm leaves a copy of the lock in `node_modules` when it has installed everything.
fn needs_install(client: &Path) -> bool {
    let time = |path: &str| fs::metadata(client.join(path)).and_then(|metadata| metadata.modified());
    match (time("package-lock.json"), time("node_modules/.package-lock.json")) {
        (Ok(lock), Ok(installed)) => installed < lock,
        _ => true,
    }
}

fn npm_command() -> Command {
    Command::new(if cfg!(windows) { "npm.cmd" } else { "npm" })
}

fn npm(client: &Path, arguments: &[&str]) -> Result<(), String> {
    let called = format!(
        "npm {}",
        arguments.iter().take_while(|word| !word.starts_with('-')).copied().collect::<Vec<_>>().join(" ")
    );
    let output = npm_command()
        .args(arguments)
        .current_dir(client)
        .output()
        .map_err(|error| format!("`{called}` in client/ cannot be run: {error}."))?;
    // Cargo shows these with `-vv`, and after a failure.
    io::stdout().write_all(&output.stdout).and_then(|()| io::stderr().write_all(&output.stderr)).ok();
    if output.status.success() {
        return Ok(());
    }
    let (errors, prints) = (String::from_utf8_lossy(&output.stderr), String::from_utf8_lossy(&output.stdout));
    let telling = |line: &&str| line.contains("rror") && !line.contains("error code");
    let cause = prints.lines().chain(errors.lines()).find(telling).unwrap_or("see its output above").trim();
    Err(format!("The client could not be built, `{called}` in client/ failed: {cause}"))
}

/// Writes `client.rs`: a sorted table of all files, each once, packed where that is shorter.
fn embed(dist: &Path, out: &Path) -> io::Result<()> {
    let mut files = Vec::new();
    collect(dist, "", &mut files)?;
    files.sort();
    if !files.iter().any(|(path, _)| path == "/index.html") {
        return Err(io::Error::other("it has no index.html"));
    }
    let packed = out.join("gzip");
    fs::create_dir_all(&packed)?;
    let mut table = String::from("static FILES: &[File] = &[\n");
    for (number, (path, source)) in files.iter().enumerate() {
        let bytes = fs::read(source)?;
        let gzip = compressed(&bytes)?;
        // Already compressed formats gain nothing.
        let is_packed = gzip.len() < bytes.len() * 9 / 10;
        let contents = if is_packed { packed.join(number.to_string()) } else { source.clone() };
        if is_packed {
            fs::write(&contents, gzip)?;
        }
        let mut sum = Crc::new();
        sum.update(&bytes);
        let etag = format!("\"{:08x}-{:x}\"", sum.sum(), bytes.len());
        let (contents, media_type) = (fs::canonicalize(contents)?, media_type(path));
        writeln!(
            table,
            "    File {{ path: {path:?}, media_type: {media_type:?}, etag: {etag:?}, \
             bytes: include_bytes!({contents:?}), is_packed: {is_packed} }},"
        )
        .map_err(io::Error::other)?;
    }
    table.push_str("];\n");
    fs::write(out.join("client.rs"), table)
}

fn collect(folder: &Path, prefix: &str, files: &mut Vec<(String, PathBuf)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = format!("{prefix}/{}", entry.file_name().to_string_lossy());
        if entry.file_type()?.is_dir() {
            collect(&entry.path(), &path, files)?;
        } else {
            files.push((path, entry.path()));
        }
    }
    Ok(())
}

fn compressed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

fn media_type(path: &str) -> &'static str {
    match path.rsplit_once('.').map_or("", |(_, extension)| extension) {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" | "map" => "application/json",
        "webmanifest" => "application/manifest+json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "jpg" | "jpeg" => "image/jpeg",
        "webp" => "image/webp",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "wasm" => "application/wasm",
        "txt" => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}
