//! A disk that is full for one program, without a disk or rights of one's own.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::scratch::Scratch;

const SHIM: &str = include_str!("full_disk.c");

/// A folder on a disk that can be filled.
#[derive(Debug)]
pub struct FullDisk {
    scratch: Scratch,
}

impl FullDisk {
    /// A disk with room for all.
    pub fn new() -> Self {
        let scratch = Scratch::new();
        fs::create_dir(scratch.path("disk")).expect("the temporary folder can be written");
        fs::write(scratch.path("full_disk.c"), SHIM).expect("the temporary folder can be written");
        let compiler = env::var_os("CC").unwrap_or_else(|| "cc".into());
        let built = Command::new(compiler)
            .args(["-shared", "-fPIC", "-O1", "-o", "full_disk.so", "full_disk.c", "-ldl"])
            .current_dir(scratch.folder())
            .status();
        assert!(built.is_ok_and(|status| status.success()), "there is a C compiler, as for SQLite");
        Self { scratch }
    }

    /// A path on it.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    /// What a program needs in its environment to have this disk.
    pub fn environment(&self) -> [(&'static str, PathBuf); 3] {
        [
            ("LD_PRELOAD", self.scratch.path("full_disk.so")),
            ("FULL_DISK", self.folder()),
            ("FULL_DISK_SIZE", self.scratch.path("size")),
        ]
    }

    /// From now on it has no more room than is taken and so many bytes.
    pub fn fill_up_to(&self, bytes: u64) {
        // Whoever reads the size meanwhile reads the old one or the new one.
        let size = self.scratch.path("size");
        fs::write(size.with_extension("new"), (self.used() + bytes).to_string()).expect("it can be written");
        fs::rename(size.with_extension("new"), &size).expect("it can be written");
    }

    /// Bytes that are taken.
    pub fn used(&self) -> u64 {
        let files = fs::read_dir(self.folder()).expect("it can be read");
        // One that goes meanwhile takes nothing.
        files.flatten().filter_map(|file| file.metadata().ok()).map(|file| file.len()).sum()
    }

    fn folder(&self) -> PathBuf {
        fs::canonicalize(self.scratch.folder())
            .map_or_else(|_| self.scratch.path("disk"), |folder| folder.join("disk"))
    }

    /// Whether a file is there.
    pub fn has(&self, name: &str) -> bool {
        Path::exists(&self.path(name))
    }
}

impl Default for FullDisk {
    fn default() -> Self {
        Self::new()
    }
}
