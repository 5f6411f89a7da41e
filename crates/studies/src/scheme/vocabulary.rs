//! Which symbols each table of the file has: a table without one is a gap that a test finds.

/// Tables of the file with their symbols.
pub const VOCABULARY: &[(&str, &[&str])] = &[
    // bodies
    ("bodies", &["link", "plate", "block", "cart", "ball", "disc", "outline"]),
    ("frames", &["axes"]),
    ("points", &["point"]),
    ("coordinates", &["coordinate", "angle"]),
    // elements
    ("springs", &["spring", "torsion_spring", "backlash"]),
    ("dampers", &["damper", "torsion_damper"]),
    ("torsion_bars", &["torsion_bar"]),
    ("forces", &["force"]),
    ("torques", &["moment", "moment_negative"]),
    ("potentials", &["field"]),
    ("dissipations", &["field", "damper"]),
    // connections
    ("pins", &["pin", "pin_fixed"]),
    ("welds", &["weld", "clamp"]),
    ("sliders", &["slider", "guides"]),
    ("slots", &["slot", "slider"]),
    ("rods", &["rod", "link"]),
    ("ropes", &["thread", "drum", "pulley", "ring_eye"]),
    ("threads", &["thread", "drum", "pulley", "ring_eye"]),
    ("belts", &["belt", "belt_crossed", "pulley"]),
    ("chains", &["chain", "pulley"]),
    ("gears", &["gear", "gear_internal", "gear_side"]),
    ("racks", &["rack", "gear"]),
    ("rolling", &["wall", "track_circle", "disc"]),
    ("constraints", &["condition"]),
    ("supports", &["pin_fixed", "support_roller", "clamp", "clamp_guided", "bearing"]),
    ("motions", &["motion", "motion_turn"]),
    ("motors", &["force", "moment"]),
    ("stops", &["stop"]),
    ("frictions", &["friction", "slip_mark"]),
    ("distributed", &["distributed"]),
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
            let drawn = VOCABULARY.iter().find(|row| row.0 == field.key);
            assert!(drawn.is_some() != UNDRAWN.contains(&field.key), "[{}] has no symbol, or is both drawn and not", field.key);
        }
        for (table, symbols) in VOCABULARY {
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
