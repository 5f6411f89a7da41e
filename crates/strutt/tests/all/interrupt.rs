//! An interruption in the middle of a long motion: what is done is written.
#![cfg(unix)]

use crate::common;

use common::gallery;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// Starts a motion without end in sight, sends the signal so many times; the exit code, the first line of the table, the complaint.
fn interrupted_by(signal: &str, times: usize) -> (Option<i32>, String, String) {
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("strutt"))
        .args(["simulate", &gallery("double-pendulum"), "--until", "1e7", "--every", "1e3", "--lang", "en"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // long enough to have started, far too short to have ended
    std::thread::sleep(std::time::Duration::from_millis(1500));
    // one after the other, each seen by itself; the last may find nobody
    let send = format!("kill {signal} {}; sleep 0.001; ", child.id()).repeat(times);
    Command::new("sh").args(["-c", &send]).stderr(Stdio::null()).status().unwrap();
    let head = BufReader::new(child.stdout.take().unwrap()).lines().next().unwrap().unwrap();
    let output = child.wait_with_output().unwrap();
    (output.status.code(), head, String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn ctrl_c_and_requests_to_end_keep_what_is_done() {
    // `timeout` sends its signal to the program and to the group of both
    for (signal, times) in [("-INT", 1), ("-TERM", 1), ("-HUP", 1), ("-INT", 2), ("-TERM", 3)] {
        let (code, head, complaint) = interrupted_by(signal, times);
        assert_eq!(code, Some(130), "{signal}: {complaint}");
        assert!(head.starts_with("t [s],"), "{signal}: {head}");
        assert!(complaint.contains("interrupted"), "{signal}: {complaint}");
    }
}

/// A study of a million points that listens to nobody is not waited for.
#[test]
fn a_calculation_that_does_not_listen_is_left() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("deaf");
    std::fs::create_dir_all(&folder).unwrap();
    let text = std::fs::read_to_string(gallery("gyroscopic-rotor")).unwrap();
    let model = folder.join("model.toml");
    std::fs::write(&model, text.replace("points = 121", "points = 1000000")).unwrap();
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("strutt"))
        .arg("run")
        .arg(&model)
        .arg("--out")
        .arg(folder.join("out"))
        .args(["--lang", "en"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    assert!(child.try_wait().unwrap().is_none());
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    // 1.5 s, and room for a busy computer
    let ended = (0..1000).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(10));
        child.try_wait().unwrap().is_some()
    });
    if !ended {
        child.kill().unwrap();
    }
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(String::from_utf8_lossy(&output.stderr).contains("could not be cut short"));
}
