//! The model file: from a path, a folder with model.toml, or standard input.

use crate::gallery;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;
use studies::Source;
use studies::failure::NO_FILE;
use words::{Notice, nearest};

/// Largest model file, bytes; the reader of the model has the same limit.
const LARGEST: u64 = mechanics::MAX_FILE as u64;

/// Reads `path`; a folder stands for the model.toml in it, `-` for standard input.
///
/// # Errors
/// A file that is missing, unreadable, too large or not UTF-8 (C001 ... C004).
pub fn open(path: &str) -> Result<Source, Box<Notice>> {
    if path == "-" {
        return from_reader(std::io::stdin().lock(), "stdin");
    }
    let mut path = path.to_owned();
    if Path::new(&path).is_dir() {
        path = Path::new(&path).join("model.toml").to_string_lossy().into_owned();
    }
    let file = File::open(&path).map_err(|error| Box::new(cannot_open(&path, &error)))?;
    from_reader(file, &path)
}

/// The bytes of a file beside the model: a list, a key, answers.
///
/// # Errors
/// A file that is missing, unreadable or too large (C001 ... C003).
pub fn bytes(path: &str) -> Result<Vec<u8>, Box<Notice>> {
    let file = File::open(path).map_err(|error| Box::new(cannot_open(path, &error)))?;
    limited(file, path, 16 * LARGEST)
}

fn limited(reader: impl Read, path: &str, largest: u64) -> Result<Vec<u8>, Box<Notice>> {
    let mut bytes = Vec::new();
    // one byte more than allowed tells a file at the limit from an endless device
    reader.take(largest + 1).read_to_end(&mut bytes).map_err(|error| Box::new(unreadable(path, &error)))?;
    if bytes.len() as u64 > largest { Err(Box::new(too_large(path))) } else { Ok(bytes) }
}

fn from_reader(reader: impl Read, path: &str) -> Result<Source, Box<Notice>> {
    let bytes = limited(reader, path, LARGEST)?;
    let text = String::from_utf8(bytes).map_err(|error| Box::new(not_utf8(path, error.as_bytes(), error.utf8_error().valid_up_to())))?;
    Ok(Source { path: path.into(), text })
}

fn cannot_open(path: &str, error: &std::io::Error) -> Notice {
    if error.kind() != ErrorKind::NotFound {
        return unreadable(path, error);
    }
    let trouble = Notice::new(NO_FILE, format!("there is no file `{path}`"), format!("нет файла `{path}`"));
    let wanted = Path::new(path);
    let name = wanted.file_name().map_or_else(|| path.into(), |n| n.to_string_lossy().into_owned());
    if let Some(near) = nearest(&name, neighbours(wanted).iter().map(String::as_str)) {
        let near = wanted.with_file_name(near);
        let near = near.display();
        return trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?"));
    }
    let stem = name.strip_suffix(".toml").unwrap_or(&name);
    let folder = wanted.parent().and_then(Path::file_name).map(|f| f.to_string_lossy().into_owned()).unwrap_or_default();
    let example = [stem, &folder].into_iter().find_map(|n| nearest(n, gallery::names()));
    match example {
        Some(example) => trouble.help(
            format!("an example has a name like that: `strutt new {example}` writes it to {example}.toml"),
            format!("есть пример с похожим именем: `strutt new {example}` запишет его в {example}.toml"),
        ),
        None => trouble.help(
            "`strutt examples` lists ready models, `strutt new NAME` writes one",
            "`strutt examples` показывает готовые модели, `strutt new ИМЯ` записывает модель в файл",
        ),
    }
}

/// Model files and folders with a model beside the wanted path, in a fixed order.
fn neighbours(wanted: &Path) -> Vec<String> {
    let folder = wanted.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut names: Vec<String> = entries
        .flatten()
        .filter(|e| e.path().extension().is_some_and(|x| x == "toml") || e.path().join("model.toml").is_file())
        .map(|e| e.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn unreadable(path: &str, error: &std::io::Error) -> Notice {
    let cause = crate::system::cause(error);
    Notice::new("C002", format!("cannot read `{path}`: {}", cause.en), format!("не удаётся прочитать `{path}`: {}", cause.ru)).help(
        "see that the path leads to a text file that you may read",
        "проверьте, что путь ведёт к текстовому файлу, который разрешено читать",
    )
}

fn too_large(path: &str) -> Notice {
    let limit = LARGEST >> 20;
    Notice::new("C003", format!("`{path}` is larger than {limit} MiB"), format!("`{path}` больше {limit} МиБ"))
        .why("a model file is text written by hand or by a script", "файл модели – это текст, написанный вручную или программой")
        .help("give the model file, not data or a picture", "укажите файл модели, а не данные или рисунок")
}

fn not_utf8(path: &str, bytes: &[u8], valid: usize) -> Notice {
    let line = 1 + bytes[..valid].iter().filter(|b| **b == b'\n').count();
    let wide = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    let cyrillic = bytes[valid..].iter().take(64).filter(|b| **b >= 0xc0).count() > 3;
    let trouble =
        Notice::new("C004", format!("`{path}`, line {line}: not UTF-8 text"), format!("`{path}`, строка {line}: текст не в UTF-8"));
    let trouble = match (wide, cyrillic) {
        (true, _) => trouble.why("the file is saved as UTF-16", "файл сохранён в UTF-16"),
        (_, true) => trouble.why("probably saved in the encoding Windows-1251", "вероятно, файл сохранён в кодировке Windows-1251"),
        _ => trouble.why("the file holds bytes that are no text", "в файле есть байты, не являющиеся текстом"),
    };
    trouble.help("save the file with the encoding UTF-8 in your editor", "сохраните файл в редакторе в кодировке UTF-8")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_in_windows_1251_is_named_as_such() {
        let bytes = b"title = \"\xcc\xe0\xff\xf2\xed\xe8\xea\"";
        let trouble = from_reader(&bytes[..], "a.toml").unwrap_err();
        assert_eq!(trouble.code, "C004");
        assert!(trouble.why.en.contains("1251"), "{trouble:?}");
    }

    #[test]
    fn an_endless_device_is_refused() {
        assert_eq!(from_reader(std::io::repeat(b'#'), "zero").unwrap_err().code, "C003");
    }
}
