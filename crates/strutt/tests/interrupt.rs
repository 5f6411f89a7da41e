//! Ctrl+C in the middle of a long motion: what is done is written.
#![cfg(unix)]

mod common;

use common::gallery;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

#[test]
fn ctrl_c_keeps_what_is_done() {
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("strutt"))
        .args(["simulate", &gallery("double-pendulum"), "--until", "1e7", "--every", "1e3", "--lang", "en"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // long enough to have started, far too short to have ended
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let head = BufReader::new(child.stdout.take().unwrap()).lines().next().unwrap().unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(head.starts_with("t [s],"), "{head}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("interrupted"));
}
