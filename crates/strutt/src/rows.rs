//! The file in which a study of many runs keeps its rows until it is finished.

use crate::files;
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use studies::Failure;
use studies::failure::Misuse;
use studies::watch::Keeper;
use words::Notice;

/// Its name in the folder of a study: `sweep.rows`, `map.rows`.
pub fn name(study: &str) -> String {
    format!("{study}.rows")
}

/// What becomes of rows of an earlier run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Earlier {
    /// The run goes on behind them.
    Resumed,
    /// There must be none.
    Refused,
}

/// The file, which no other run writes meanwhile.
#[derive(Debug)]
pub struct Rows {
    path: PathBuf,
    file: File,
    lines: Vec<String>,
}

impl Rows {
    /// Opens the file of a folder, which it makes when there is none.
    ///
    /// # Errors
    /// There are rows of an earlier run, and nobody asked to go on with them (C074); another run writes there (C075); the disk refuses (C005).
    pub fn open(folder: &Path, study: &str, earlier: Earlier) -> Result<Rows, Failure> {
        fs::create_dir_all(folder).map_err(|error| files::refused(folder, &error))?;
        let path = folder.join(name(study));
        let refused = |error: &std::io::Error| files::refused(&path, error);
        let mut file =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path).map_err(|error| refused(&error))?;
        if matches!(file.try_lock(), Err(fs::TryLockError::WouldBlock)) {
            return Err(busy(&path).misuse());
        }
        // by the same handle: some systems let no other read what is locked
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(|error| refused(&error))?;
        let lines = lines(&bytes);
        if earlier == Earlier::Refused && !lines.is_empty() {
            return Err(there(&path).misuse());
        }
        Ok(Rows { path, file, lines })
    }

    /// Whether there is anything in it.
    pub fn holds(&self) -> bool {
        self.file.metadata().is_ok_and(|found| found.len() > 0)
    }

    /// Takes the file away: what it held is written elsewhere.
    pub fn remove(self) {
        drop(self.file);
        // a file that stays says again what the tables say
        let _ = fs::remove_file(&self.path);
    }

    fn refused(&self, error: &std::io::Error) -> Notice {
        *files::refused(&self.path, error)
    }
}

/// The lines of a file, the last perhaps torn.
///
/// # Errors
/// It cannot be read.
pub fn read(path: &Path) -> std::io::Result<Vec<String>> {
    fs::read(path).map(|bytes| lines(&bytes))
}

fn lines(bytes: &[u8]) -> Vec<String> {
    let mut lines: Vec<String> = String::from_utf8_lossy(bytes).lines().map(str::to_owned).collect();
    // a line is whole when it has its end
    if !bytes.ends_with(b"\n")
        && let Some(last) = lines.last_mut()
    {
        last.clear();
    }
    lines
}

impl Keeper for Rows {
    fn lines(&self) -> &[String] {
        &self.lines
    }

    fn cut(&mut self, lines: usize) -> Result<(), Notice> {
        // whole lines end with one more byte
        let length: u64 = self.lines.iter().take(lines).map(|line| line.len() as u64 + 1).sum();
        let done = self.file.set_len(length).and_then(|()| self.file.seek(SeekFrom::Start(length)));
        self.lines = Vec::new();
        done.map(|_| ()).map_err(|error| self.refused(&error))
    }

    fn add(&mut self, lines: &str) -> Result<(), Notice> {
        self.file.write_all(lines.as_bytes()).and_then(|()| self.file.sync_data()).map_err(|error| self.refused(&error))
    }
}

fn there(path: &Path) -> Notice {
    let path = path.display();
    Notice::new(
        "C074",
        format!("`{path}` holds rows of an earlier run: one that was not finished, or a part of several (--shard)"),
        format!("в `{path}` лежат строки прежнего запуска: незаконченного или одной из частей (--shard)"),
    )
    .help(
        "go on with --resume, join the parts with `strutt merge`, or choose another folder with --out",
        "продолжите с ключом --resume, соедините части командой `strutt merge` или укажите другую папку ключом --out",
    )
}

fn busy(path: &Path) -> Notice {
    let path = path.display();
    Notice::new("C075", format!("another run writes into `{path}`"), format!("в `{path}` пишет другой запуск"))
        .help("wait for it, or choose another folder with --out", "дождитесь его или укажите другую папку ключом --out")
}
