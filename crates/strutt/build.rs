//! The released program is linked to one fixed address on Linux.
//!
//! A program that may be loaded anywhere carries a row of 24 bytes for each of some forty thousand pointers in its tables, a megabyte that the loader works through at each start. What the
//! random address of such a program makes harder is an attack by broken memory; the sources have no `unsafe`, and stack, heap and libraries stay where chance puts them.

use std::env::var;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let is = |name: &str, value: &str| var(name).is_ok_and(|v| v == value);
    if is("PROFILE", "release") && is("CARGO_CFG_TARGET_OS", "linux") && is("CARGO_CFG_TARGET_ENV", "gnu") {
        println!("cargo::rustc-link-arg-bins=-no-pie");
    }
}
