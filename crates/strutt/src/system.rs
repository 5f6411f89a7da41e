//! What the operating system says, in both languages, and what helps.

use std::io::{Error, ErrorKind};
use words::Text;

/// The cause of a refusal: the words of the system in English, ours in Russian.
pub fn cause(error: &Error) -> Text {
    let ru = match error.kind() {
        ErrorKind::NotFound => "нет такого файла или папки",
        ErrorKind::PermissionDenied => "нет прав доступа",
        ErrorKind::AlreadyExists => "это имя занято файлом",
        ErrorKind::NotADirectory => "на этом пути вместо папки стоит файл",
        ErrorKind::IsADirectory => "это папка, а не файл",
        ErrorKind::ReadOnlyFilesystem => "файловая система доступна только для чтения",
        ErrorKind::StorageFull => "на диске нет места",
        ErrorKind::QuotaExceeded => "исчерпана квота диска",
        ErrorKind::FileTooLarge => "файл слишком велик для этой файловой системы",
        ErrorKind::InvalidFilename => "недопустимое имя файла",
        ErrorKind::InvalidInput => "недопустимый путь",
        ErrorKind::ResourceBusy => "файл или устройство занято",
        ErrorKind::TimedOut => "истекло время ожидания",
        ErrorKind::OutOfMemory => "не хватает памяти",
        ErrorKind::BrokenPipe => "канал закрыт на другом конце",
        _ => return Text::new(error.to_string(), other(error)),
    };
    Text::new(error.to_string(), ru)
}

/// Causes without a kind in the standard library, by their numbers (errno.h).
fn other(error: &Error) -> String {
    match error.raw_os_error() {
        Some(5) if cfg!(unix) => "ошибка ввода-вывода".into(),
        Some(40) if cfg!(target_os = "linux") => "слишком много символических ссылок".into(),
        Some(62) if cfg!(target_os = "macos") => "слишком много символических ссылок".into(),
        Some(code) => format!("отказ операционной системы, код {code}"),
        None => "отказ операционной системы".into(),
    }
}

/// What makes room for a file; `elsewhere` says how another place is chosen.
pub fn remedy(error: &Error, elsewhere: &Text) -> Text {
    let (en, ru) = match error.kind() {
        ErrorKind::AlreadyExists | ErrorKind::NotADirectory => {
            ("a file stands where a folder is needed: move it away", "на месте папки стоит файл: уберите его")
        }
        ErrorKind::IsADirectory => ("a folder stands where a file is needed: move it away", "на месте файла стоит папка: уберите её"),
        ErrorKind::NotFound => ("make the folder first", "сначала создайте папку"),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => ("make room on the disk", "освободите место на диске"),
        _ => ("see that you may write there", "проверьте, можно ли туда писать"),
    };
    Text::new(format!("{en}, or {}", elsewhere.en), format!("{ru} или {}", elsewhere.ru))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cause_has_russian_words() {
        for code in 1..134 {
            let text = cause(&Error::from_raw_os_error(code));
            assert!(text.ru.chars().all(|c| !c.is_ascii_alphabetic()) && !text.ru.is_empty(), "{text:?}");
        }
    }
}
