//! Which symbols each table of the file has, beside elements and connections ([`crate::shown`]): a table without one is a gap that a test finds.

/// Tables of the file with their symbols, beside those of elements and connections.
pub const VOCABULARY: &[(&str, &[&str])] = &[
    // bodies
    ("bodies", &["link", "plate", "block", "cart", "ball", "disc", "outline"]),
    ("frames", &["axes"]),
    ("points", &["point"]),
    ("coordinates", &["coordinate", "angle"]),
    // structures
    ("nodes", &["pin", "ball", "point"]),
    ("displacements", &["coordinate"]),
];

/// Homogeneous bodies with their symbols.
pub const SHAPES: &[(&str, &str)] =
    &[("disc", "disc"), ("ring", "ring"), ("rod", "link"), ("box", "outline"), ("sphere", "disc"), ("cylinder", "disc"), ("point", "ball")];

/// Tables that nothing is drawn of: values, results, ways of computing.
pub const UNDRAWN: &[&str] = &[
    "title",
    "description",
    "gravity",
    "impacts",
    "parameters",
    "unknowns",
    "impending",
    "outputs",
    "events",
    "regimes",
    "rayleigh",
    "structure",
    "sections",
    "variants",
    "answers",
    "report",
    "study",
    "claims",
    "phases",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_of_the_file_has_symbols_that_exist() {
        for field in mechanics::fields::TOP.fields {
            let drawn = VOCABULARY.iter().any(|row| row.0 == field.key) || crate::shown::find(field.key).is_some();
            assert!(drawn != UNDRAWN.contains(&field.key), "[{}] has no symbol, or is both drawn and not", field.key);
        }
        let acting = crate::shown::TABLE.iter().map(|row| (row.table, row.symbols));
        for (table, symbols) in VOCABULARY.iter().copied().chain(acting) {
            assert!(!symbols.is_empty(), "{table}");
            assert!(symbols.iter().all(|s| report::scheme::symbols::find(s).is_some()), "{table}: {symbols:?}");
        }
    }

    #[test]
    fn every_shape_has_a_symbol() {
        for (shape, ..) in mechanics::SHAPES {
            let symbol = SHAPES.iter().find(|row| row.0 == shape).map(|row| row.1);
            assert!(symbol.is_some_and(|s| report::scheme::symbols::find(s).is_some()), "{shape}");
        }
    }
}
