//! The released program is linked to one fixed address on Linux, and functions with the same instructions are one where the linker can fold them.
//!
//! A program that may be loaded anywhere carries a row of 24 bytes for each of some forty thousand pointers in its tables, a megabyte that the loader works through at each start. What the
//! random address of such a program makes harder is an attack by broken memory; the sources have no `unsafe`, and stack, heap and libraries stay where chance puts them.
//!
//! Generic code has many functions that differ in their types alone. Which linker is used depends on the platform, on who built the compiler and on the settings of whoever builds, so no name is
//! asked for: a program of one line is linked with the option, and where that fails the program is made without it.

use std::env::var;
use std::fs::write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Equal functions are folded; no two of the program are told apart by their addresses.
const FOLDED: &str = "-Wl,--icf=all";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let is = |name: &str, value: &str| var(name).is_ok_and(|v| v == value);
    if is("PROFILE", "release") && is("CARGO_CFG_TARGET_OS", "linux") && is("CARGO_CFG_TARGET_ENV", "gnu") {
        println!("cargo::rustc-link-arg-bins=-no-pie");
        if links(FOLDED) == Some(true) {
            println!("cargo::rustc-link-arg-bins={FOLDED}");
        }
    }
}

/// Whether the linker that the program will be linked by takes an option; none where that cannot be tried.
fn links(option: &str) -> Option<bool> {
    let folder = var("OUT_DIR").ok()?;
    let (source, program) = (Path::new(&folder).join("trial.rs"), Path::new(&folder).join("trial"));
    write(&source, "fn main() {}\n").ok()?;
    let mut compiler = Command::new(var("RUSTC").ok()?);
    compiler
        .args(["--edition", "2024", "--target", &var("TARGET").ok()?, "-C", &format!("link-arg={option}"), "-o"])
        .arg(program)
        .arg(source);
    if let Ok(linker) = var("RUSTC_LINKER") {
        compiler.args(["-C", &format!("linker={linker}")]);
    }
    // flags of whoever builds may name another linker; they are parted by this sign
    let flags = var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
    compiler.args(flags.split('\u{1f}').filter(|flag| !flag.is_empty()));
    Some(compiler.stdout(Stdio::null()).stderr(Stdio::null()).status().ok()?.success())
}
