//! Single files that must not exist yet, and refusals of the disk.

use crate::system;
use std::fs;
use std::io::Write;
use std::path::Path;
use words::{Notice, Text};

/// Writes a file that must not exist yet; it is there whole or not at all.
///
/// # Errors
/// It exists (C006), or the disk refuses (C005).
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Box<Notice>> {
    let elsewhere = Text::new("choose another place", "выберите другое место");
    let refused = |error: &std::io::Error| cannot_write(path, error, &elsewhere);
    match fs::OpenOptions::new().write(true).create_new(true).open(path) {
        Ok(mut file) => file.write_all(bytes).map_err(|error| {
            // an empty file would stand in the way of the next attempt
            let _ = fs::remove_file(path);
            refused(&error)
        }),
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => Err(exists(path)),
        Err(error) => Err(refused(&error)),
    }
}

/// C005 for a folder of results.
pub fn refused(path: &Path, error: &std::io::Error) -> Box<Notice> {
    cannot_write(path, error, &Text::new("choose another folder with --out", "укажите другую папку ключом --out"))
}

fn cannot_write(path: &Path, error: &std::io::Error, elsewhere: &Text) -> Box<Notice> {
    let (path, cause, help) = (path.display(), system::cause(error), system::remedy(error, elsewhere));
    let what = (format!("cannot write `{path}`: {}", cause.en), format!("не удаётся записать `{path}`: {}", cause.ru));
    Box::new(Notice::new("C005", what.0, what.1).help(help.en, help.ru))
}

fn exists(path: &Path) -> Box<Notice> {
    let path = path.display();
    let trouble =
        Notice::new("C006", format!("`{path}` exists already; nothing was written"), format!("файл `{path}` уже есть; ничего не записано"))
            .help("choose another name, or move the file away", "выберите другое имя или уберите файл");
    Box::new(trouble)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn new_files_never_replace_others() {
        let folder = std::env::temp_dir().join(format!("strutt-files-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("b.txt");
        write_new(&path, b"two").unwrap();
        assert_eq!(write_new(&path, b"three").unwrap_err().code, "C006");
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(write_new(&path.join("c"), b"").unwrap_err().code, "C005");
        fs::remove_dir_all(folder).unwrap();
    }
}
