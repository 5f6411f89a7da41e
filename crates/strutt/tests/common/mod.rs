//! What the tests of the binary share.
#![allow(dead_code)]

use assert_cmd::Command;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The binary in English, whatever the locale of the machine.
pub fn strutt() -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("strutt"));
    command.env("LC_ALL", "C").env_remove("NO_COLOR").env_remove("COLUMNS");
    command
}

/// A model of the gallery.
pub fn gallery(name: &str) -> String {
    format!("{}/../../gallery/{name}/model.toml", env!("CARGO_MANIFEST_DIR"))
}

/// An empty folder of its own for a test.
pub fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// stdout of a command that must succeed.
pub fn stdout(command: &mut Command) -> String {
    String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
}

/// stderr of a command that must end with this code.
pub fn stderr(command: &mut Command, code: i32) -> String {
    String::from_utf8(command.assert().code(code).get_output().stderr.clone()).unwrap()
}

/// The head and the rows of a CSV table.
pub fn table(csv: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut lines = csv.lines();
    let head = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let rows = lines.map(|l| l.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    (head, rows)
}

/// Does the work for each of these on two threads.
pub fn in_parallel<T: Sync>(all: &[T], work: impl Fn(&T) + Sync) {
    let next = AtomicUsize::new(0);
    let one = || {
        while let Some(item) = all.get(next.fetch_add(1, Ordering::Relaxed)) {
            work(item);
        }
    };
    std::thread::scope(|scope| (0..2).for_each(|_| drop(scope.spawn(one))));
}

/// Whether a run of a model of the gallery has left its page in this language, with all files whole.
pub fn is_written(name: &str, out: &Path, language: &str) {
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains(&format!("lang=\"{language}\"")), "{name}");
    let files: Vec<String> = std::fs::read_dir(out).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    // a structure or a table of numbers may have nothing to plot
    let moves = files.iter().any(|f| f.starts_with("simulate"));
    let wanted: &[&str] = if moves { &[".csv", ".json", ".svg", ".png", ".html"] } else { &[".html"] };
    for kind in wanted {
        assert!(files.iter().any(|f| f.ends_with(kind)), "{name}: {files:?}");
    }
    assert!(files.iter().all(|f| !f.ends_with(".part")), "{files:?}");
}
