//! An interruption in the middle of a long motion: what is done is written.
#![cfg(unix)]

mod common;

use common::gallery;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// Starts a motion without end in sight, sends the signal; the exit code, the first line of the table, the complaint.
fn interrupted_by(signal: &str) -> (Option<i32>, String, String) {
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("strutt"))
        .args(["simulate", &gallery("double-pendulum"), "--until", "1e7", "--every", "1e3", "--lang", "en"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // long enough to have started, far too short to have ended
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let killed = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let head = BufReader::new(child.stdout.take().unwrap()).lines().next().unwrap().unwrap();
    let output = child.wait_with_output().unwrap();
    (output.status.code(), head, String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn ctrl_c_and_requests_to_end_keep_what_is_done() {
    for signal in ["-INT", "-TERM", "-HUP"] {
        let (code, head, complaint) = interrupted_by(signal);
        assert_eq!(code, Some(130), "{signal}: {complaint}");
        assert!(head.starts_with("t [s],"), "{signal}: {head}");
        assert!(complaint.contains("interrupted"), "{signal}: {complaint}");
    }
}
