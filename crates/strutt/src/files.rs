//! Writing files: a file is there whole or not at all.

use crate::failure::Trouble;
use std::fs;
use std::io::Write;
use std::path::Path;

/// Writes a file through a temporary one in the same folder; folders are made.
///
/// # Errors
/// The disk refuses (C005).
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Box<Trouble>> {
    if let Some(folder) = path.parent().filter(|p| !p.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|error| refused(folder, &error))?;
    }
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.part", std::process::id()));
    let temporary = path.with_file_name(name);
    let written = fs::File::create(&temporary).and_then(|mut file| file.write_all(bytes)).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|error| {
        // the refusal is what the user must hear of, not a failure to tidy up after it
        let _ = fs::remove_file(&temporary);
        refused(path, &error)
    })
}

/// Writes a file that must not exist yet.
///
/// # Errors
/// It exists (C006), or the disk refuses (C005).
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Box<Trouble>> {
    let file = fs::OpenOptions::new().write(true).create_new(true).open(path);
    match file {
        Ok(mut file) => file.write_all(bytes).map_err(|error| refused(path, &error)),
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => Err(exists(path)),
        Err(error) => Err(refused(path, &error)),
    }
}

fn refused(path: &Path, error: &std::io::Error) -> Box<Trouble> {
    let path = path.display();
    let trouble = Trouble::new("C005", format!("cannot write `{path}`: {error}"), format!("не удаётся записать `{path}`: {error}")).help(
        "choose another folder with --out, or make room on the disk",
        "укажите другую папку ключом --out или освободите место на диске",
    );
    Box::new(trouble)
}

fn exists(path: &Path) -> Box<Trouble> {
    let path = path.display();
    let trouble = Trouble::new(
        "C006",
        format!("`{path}` exists already; nothing was written"),
        format!("файл `{path}` уже есть; ничего не записано"),
    )
    .help("choose another name, or move the file away", "выберите другое имя или уберите файл");
    Box::new(trouble)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_replaced_whole_and_new_files_never() {
        let folder = std::env::temp_dir().join(format!("strutt-files-{}", std::process::id()));
        let path = folder.join("a/b.txt");
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(folder.join("a")).unwrap().count(), 1);
        assert_eq!(write_new(&path, b"three").unwrap_err().code, "C006");
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(write(&path.join("c"), b"").unwrap_err().code, "C005");
        fs::remove_dir_all(folder).unwrap();
    }
}
