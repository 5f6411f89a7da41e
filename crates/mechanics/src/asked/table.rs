//! Keys of `[[study]]`.

use crate::keys::{TableSpec, Type, must};

/// `[[study]]`.
pub const STUDY: TableSpec = TableSpec {
    name: "study",
    about: (
        "Studies, carried out in order. Every kind has its own keys, listed below.",
        "Расчёты, выполняются по порядку. У каждого вида свои ключи, они перечислены ниже.",
    ),
    short: None,
    fields: &[must("kind", Type::String, "", ("name of the study", "название расчёта"), "\"simulate\"")],
    example: "[[study]]\nkind = \"simulate\"\nuntil = \"30 s\"\nplot = [\"phi'\"]\n",
};
