//! Files of one calculation: all of them take their places together, or none does.

use crate::files;
use crate::wording::Word;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use words::{Notice, Text};

/// End of the names of files that are not complete yet.
const PART: &str = ".strutt-part";

/// A folder in which a calculation writes. While it lives no other run writes there.
pub struct Shelf<'a> {
    folder: &'a Path,
    inputs: &'a [PathBuf],
    /// Files by name and meaning, in the order in which they were put.
    pub names: Vec<(String, Word)>,
    /// Whole files under names of their own, until they take their places.
    parts: Vec<PathBuf>,
    /// Held until the files are in their places.
    _lock: Option<File>,
}

impl<'a> Shelf<'a> {
    /// Makes the folder and waits until no other run writes into it; what a run that was killed has left half-written goes.
    ///
    /// *inputs*: files that were read and must stay.
    ///
    /// # Errors
    /// The disk refuses (C005).
    pub fn open(folder: &'a Path, inputs: &'a [PathBuf]) -> Result<Shelf<'a>, Box<Notice>> {
        let there = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        fs::create_dir_all(there).map_err(|error| files::refused(folder, &error))?;
        let lock = locked(there);
        if lock.is_some() {
            sweep(there);
        }
        Ok(Shelf { folder, inputs, names: Vec::new(), parts: Vec::new(), _lock: lock })
    }

    /// Adds a file; returns the name that it gets.
    ///
    /// # Errors
    /// It would replace an input (C052), or the disk refuses (C005).
    pub fn put(&mut self, name: &str, what: Word, bytes: &[u8]) -> Result<String, Box<Notice>> {
        self.put_by(name, what, &mut |to| to.write_all(bytes))
    }

    /// The same of a file that is written piece by piece.
    ///
    /// # Errors
    /// As of [`Shelf::put`].
    pub fn put_by(
        &mut self,
        name: &str,
        what: Word,
        write: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
    ) -> Result<String, Box<Notice>> {
        let name = self.free(name);
        let path = self.folder.join(&name);
        if let Some(input) = self.inputs.iter().find(|input| same_file(&path, input)) {
            return Err(Box::new(input_kept(&path, input)));
        }
        let part = self.folder.join(format!("{name}.{}{PART}", std::process::id()));
        self.parts.push(part.clone());
        self.names.push((name.clone(), what));
        File::create(&part).and_then(|mut file| write(&mut file)).map_err(|error| files::refused(&path, &error))?;
        Ok(name)
    }

    /// Gives every file its place; the paths, in the order in which they were put.
    ///
    /// # Errors
    /// The disk refuses (C005).
    pub fn close(mut self) -> Result<Vec<PathBuf>, Box<Notice>> {
        let paths: Vec<PathBuf> = self.names.iter().map(|(name, _)| self.folder.join(name)).collect();
        // a folder in the place of a file is the one refusal that a rename meets when the parts could be written
        if let Some(taken) = paths.iter().find(|path| path.is_dir()) {
            return Err(files::refused(taken, &std::io::ErrorKind::IsADirectory.into()));
        }
        for (part, path) in self.parts.iter().zip(&paths) {
            fs::rename(part, path).map_err(|error| files::refused(path, &error))?;
        }
        self.parts.clear();
        Ok(paths)
    }

    /// A name that no file of this folder has yet: some systems do not tell `X.svg` and `x.svg` apart, and keep `con.svg` for a device.
    fn free(&self, name: &str) -> String {
        let taken = |wanted: &str| is_device(wanted) || self.names.iter().any(|(n, _)| n.to_lowercase() == wanted.to_lowercase());
        let (stem, end) = name.rsplit_once('.').unwrap_or((name, ""));
        let numbered = |i: usize| format!("{stem}~{i}.{end}");
        if taken(name) { (2..).map(numbered).find(|n| !taken(n)).unwrap_or_else(|| name.to_owned()) } else { name.to_owned() }
    }
}

impl Drop for Shelf<'_> {
    fn drop(&mut self) {
        for part in &self.parts {
            // the refusal is what the user must hear of, not a failure to tidy up after it
            let _ = fs::remove_file(part);
        }
    }
}

/// Names that Windows keeps for devices, whatever follows the first point.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().to_ascii_lowercase();
    let numbered = |prefix: &str| stem.strip_prefix(prefix).is_some_and(|n| n.len() == 1 && n.as_bytes()[0].is_ascii_digit());
    matches!(stem.as_str(), "con" | "prn" | "aux" | "nul") || numbered("com") || numbered("lpt")
}

/// The lock of a folder. None where the system has none: then only the moment of the renames is open to another run.
fn locked(folder: &Path) -> Option<File> {
    // folders can be opened and locked except on Windows, where a hidden file stands for them
    let file = File::open(folder).or_else(|_| File::create(folder.join(".strutt-lock"))).ok()?;
    file.lock().ok().map(|()| file)
}

/// Removes half-written files: under the lock their writers are gone.
fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten().filter(|e| e.file_name().to_string_lossy().ends_with(PART)) {
        let _ = fs::remove_file(entry.path());
    }
}

/// Whether writing `output` would replace `input`. A link in the place of an output is replaced itself, what it leads to stays.
fn same_file(output: &Path, input: &Path) -> bool {
    if output.symlink_metadata().is_err() {
        return false;
    }
    let place = |path: &Path| -> Option<PathBuf> {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some(fs::canonicalize(folder).ok()?.join(path.file_name()?))
    };
    let aimed = || !output.is_symlink() && fs::canonicalize(output).is_ok_and(|o| fs::canonicalize(input).is_ok_and(|i| i == o));
    place(output).is_some_and(|o| place(input) == Some(o)) || aimed()
}

/// One file beside others, in place of an older one.
///
/// # Errors
/// It would replace an input (C052), or the disk refuses (C005).
pub fn replace(path: &Path, bytes: &[u8], inputs: &[PathBuf]) -> Result<(), Box<Notice>> {
    match inputs.iter().find(|input| same_file(path, input)) {
        Some(input) => Err(Box::new(input_kept(path, input))),
        None => fs::write(path, bytes).map_err(|error| files::refused(path, &error)),
    }
}

fn input_kept(output: &Path, input: &Path) -> Notice {
    let (output, input) = (output.display(), input.display());
    let elsewhere = Text::new("choose another folder with --out", "укажите другую папку ключом --out");
    Notice::new(
        "C052",
        format!("`{output}` would replace `{input}`, which this calculation has read; nothing was written"),
        format!("файл `{output}` заменил бы `{input}`, из которого взяты данные; ничего не записано"),
    )
    .why("a result has the name of an input in the same folder", "имя результата совпадает с именем исходного файла в той же папке")
    .help(format!("{}, or rename the input", elsewhere.en), format!("{} или переименуйте исходный файл", elsewhere.ru))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("strutt-shelf-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }
    fn listing(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn all_files_take_their_places_or_none() {
        let here = folder("all");
        fs::write(here.join("a.csv"), "old").unwrap();
        fs::write(here.join("model.svg"), "input").unwrap();
        let inputs = [here.join("model.svg")];
        let mut shelf = Shelf::open(&here, &inputs).unwrap();
        shelf.put("a.csv", Word::Table, b"new").unwrap();
        assert_eq!(shelf.put("model.svg", Word::Vector, b"new").unwrap_err().code, "C052");
        drop(shelf);
        assert_eq!(fs::read(here.join("a.csv")).unwrap(), b"old");
        assert_eq!(listing(&here), ["a.csv", "model.svg"]);
        let mut shelf = Shelf::open(&here, &[]).unwrap();
        shelf.put("a.csv", Word::Table, b"new").unwrap();
        assert_eq!(fs::read(here.join("a.csv")).unwrap(), b"old");
        shelf.close().unwrap();
        assert_eq!(fs::read(here.join("a.csv")).unwrap(), b"new");
        fs::remove_dir_all(here).unwrap();
    }

    #[test]
    fn what_a_killed_run_left_goes_and_two_runs_wait_for_each_other() {
        let here = folder("two");
        fs::write(here.join(format!("motion.csv.1{PART}")), "half").unwrap();
        let writers: Vec<_> = (0..8u8)
            .map(|run| {
                let here = here.clone();
                std::thread::spawn(move || {
                    let mut shelf = Shelf::open(&here, &[]).unwrap();
                    for name in ["a.csv", "b.csv", "c.csv"] {
                        shelf.put(name, Word::Table, &[run]).unwrap();
                    }
                    shelf.close().unwrap();
                })
            })
            .collect();
        writers.into_iter().for_each(|w| w.join().unwrap());
        assert_eq!(listing(&here), ["a.csv", "b.csv", "c.csv"]);
        let read = |name: &str| fs::read(here.join(name)).unwrap();
        assert!(read("a.csv") == read("b.csv") && read("b.csv") == read("c.csv"));
        fs::remove_dir_all(here).unwrap();
    }

    #[test]
    fn names_of_devices_and_twins_get_a_number() {
        let here = folder("names");
        let mut shelf = Shelf::open(&here, &[]).unwrap();
        for name in ["con.svg", "X.svg", "x.svg", "COM1.svg", "comet.svg"] {
            shelf.put(name, Word::Vector, b"").unwrap();
        }
        shelf.close().unwrap();
        assert_eq!(listing(&here), ["COM1~2.svg", "X.svg", "comet.svg", "con~2.svg", "x~2.svg"]);
        fs::remove_dir_all(here).unwrap();
    }
}
