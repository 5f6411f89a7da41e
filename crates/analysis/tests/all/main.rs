//! All tests of the room in one program: it is linked once, and what is generic is compiled once.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/linkage.rs"]
mod linkage;
#[path = "../common/shaft.rs"]
mod shaft;

mod assembly;
mod audits;
mod contact_audits;
mod contacts;
mod equilibrium;
mod events;
mod friction;
mod integrator;
mod linkages;
mod machine;
mod periodic;
mod simulate;
mod stiff;
mod structure;
