//! Threads: ropes by another name.

use super::common::keys::table;
use super::ropes::{TIE, WOUND, components, read};
use super::row::Row;
use crate::keys::TableSpec;

/// `[threads]`.
pub(super) const ROW: Row =
    Row { keys: &KEYS, listed: ("threads", "нити"), chapter: "equilibrium", within: &[&WOUND], read, components };

/// `[threads.NAME]`.
const KEYS: TableSpec =
    table("threads", ("Threads: the same as ropes.", "Нити: то же, что канаты."), TIE, "[threads.AB]\npath = [\"A\", \"B\"]\n");
