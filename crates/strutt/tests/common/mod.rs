//! What the tests of the binary share.
#![allow(dead_code)]

use assert_cmd::Command;
use std::path::PathBuf;

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
