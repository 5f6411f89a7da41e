//! What stands beside the row of an element or connection in `mechanics`, which must not know figures and sentences: how it is drawn, its usual letter, what a
//! calculation calls it. A row each, found by the table of the file; a test walks both tables and finds a row without its own here.

use mechanics::asked::Words;

/// How a table of elements or connections is drawn and told.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    /// Its table of the file.
    pub table: &'static str,
    /// What it is to figures and sentences.
    pub role: Role,
    /// All symbols that it may be drawn with.
    pub symbols: &'static [&'static str],
    /// The one between two places or along a direction; empty: drawn in a way of its own.
    pub along: &'static str,
    /// The one about an axis; empty: a moment with its sense.
    pub turning: &'static str,
    /// The one of its wheels.
    pub wheel: &'static str,
    /// Its letter where the file gives none; empty: its name.
    pub letter: &'static str,
    /// What one of them is called; of wheels, one that turns them in one sense.
    pub called: Words,
    /// What wheels that turn in opposite senses are called.
    pub opposite: Words,
    /// What is assumed of all of them.
    pub assumed: Words,
}

/// What an element or connection is to figures and sentences: more than one table may have one role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Role {
    /// It stores energy on a pathway.
    Spring,
    /// It dissipates on a pathway.
    Damper,
    Force,
    Moment,
    /// An energy of any form.
    Energy,
    /// A dissipation function of any form.
    Dissipation,
    Joint,
    Weld,
    Slot,
    Thread,
    Belt,
    Chain,
    Gear,
    Rack,
    Rolling,
    Motion,
    Motor,
    Stop,
    Friction,
    Other,
}

impl Shown {
    const fn new(table: &'static str, role: Role, symbols: &'static [&'static str]) -> Shown {
        let none = ("", "");
        Shown { table, role, symbols, along: "", turning: "", wheel: "", letter: "", called: none, opposite: none, assumed: none }
    }
    const fn along(self, along: &'static str) -> Shown {
        Shown { along, ..self }
    }
    const fn turning(self, turning: &'static str) -> Shown {
        Shown { turning, ..self }
    }
    const fn wheel(self, wheel: &'static str) -> Shown {
        Shown { wheel, ..self }
    }
    const fn letter(self, letter: &'static str) -> Shown {
        Shown { letter, ..self }
    }
    const fn called(self, called: Words) -> Shown {
        Shown { called, ..self }
    }
    const fn wheels(self, called: Words, opposite: Words) -> Shown {
        Shown { called, opposite, ..self }
    }
    const fn assumed(self, assumed: Words) -> Shown {
        Shown { assumed, ..self }
    }
}

/// What is assumed of ropes and threads.
const TAUT: Words = ("ropes are inextensible and massless", "нити нерастяжимые и невесомые");
/// What is assumed of wheels that turn together.
const MESHED: Words = ("belts and gears do not slip", "ремни и колёса передач не проскальзывают");
/// What is assumed of wheels on tracks.
const ROLLING: Words = ("wheels roll without slip", "качение происходит без проскальзывания");

/// Elements and loads in the order of `mechanics::elements::TABLE`, then connections in that of `mechanics::connections::TABLE`.
pub const TABLE: &[Shown] = &[
    Shown::new("springs", Role::Spring, &["spring", "torsion_spring", "backlash"])
        .along("spring")
        .turning("torsion_spring")
        .letter("c")
        .called(("spring", "пружина"))
        .assumed(("springs are massless", "пружины невесомые")),
    Shown::new("dampers", Role::Damper, &["damper", "torsion_damper"])
        .along("damper")
        .turning("torsion_damper")
        .letter("b")
        .called(("damper", "демпфер")),
    Shown::new("torsion_bars", Role::Spring, &["torsion_bar"])
        .along("torsion_bar")
        .turning("torsion_spring")
        .letter("c")
        .called(("torsion bar", "торсион")),
    Shown::new("forces", Role::Force, &["force"]).along("force").letter("F").called(("force", "сила")),
    Shown::new("torques", Role::Moment, &["moment", "moment_negative"]).letter("M").called(("moment", "момент")),
    Shown::new("distributed", Role::Force, &["distributed"]).letter("q").called(("distributed load", "распределённая нагрузка")),
    Shown::new("potentials", Role::Energy, &["field", "spring", "torsion_spring"]).letter("Π").called(("potential", "потенциальная сила")),
    Shown::new("dissipations", Role::Dissipation, &["field", "damper", "torsion_damper", "force"])
        .letter("Φ")
        .called(("damping", "сопротивление")),
    Shown::new("pins", Role::Joint, &["pin", "pin_fixed"]),
    Shown::new("welds", Role::Weld, &["weld", "clamp"]),
    Shown::new("sliders", Role::Joint, &["slider", "guides"]),
    Shown::new("slots", Role::Slot, &["slot", "slider"]),
    Shown::new("rods", Role::Joint, &["rod", "link", "rigid"]),
    Shown::new("ropes", Role::Thread, &["thread", "drum", "pulley", "ring_eye"]).letter("S").assumed(TAUT),
    Shown::new("threads", Role::Thread, &["thread", "drum", "pulley", "ring_eye"]).letter("S").assumed(TAUT),
    Shown::new("belts", Role::Belt, &["belt", "belt_crossed", "pulley"])
        .wheel("pulley")
        .letter("S")
        .wheels(("open belt", "открытая ремённая передача"), ("crossed belt", "перекрёстная ремённая передача"))
        .assumed(MESHED),
    Shown::new("chains", Role::Chain, &["chain", "pulley"])
        .wheel("pulley")
        .letter("S")
        .wheels(("chain", "цепная передача"), ("chain", "цепная передача"))
        .assumed(MESHED),
    Shown::new("gears", Role::Gear, &["gear", "gear_internal", "gear_side"])
        .wheel("gear")
        .wheels(("internal gears", "внутреннее зубчатое зацепление"), ("gears", "внешнее зубчатое зацепление"))
        .assumed(MESHED),
    Shown::new("racks", Role::Rack, &["rack", "gear"]).wheel("gear").assumed(ROLLING),
    Shown::new("rolling", Role::Rolling, &["wall", "track_circle", "disc"]).wheel("disc").assumed(ROLLING),
    Shown::new("constraints", Role::Other, &["condition"]).letter("f"),
    Shown::new("supports", Role::Other, &["pin_fixed", "support_roller", "clamp", "clamp_guided", "bearing"]),
    Shown::new("motions", Role::Motion, &["motion", "motion_turn"]).along("motion").turning("motion_turn"),
    Shown::new("motors", Role::Motor, &["force", "moment"]).along("force").letter("M"),
    Shown::new("stops", Role::Stop, &["stop"]).along("stop").turning("stop"),
    Shown::new("frictions", Role::Friction, &["friction", "slip_mark"]).along("friction").turning("slip_mark").letter("f"),
];

/// The row of a table of the file; none of other tables.
pub fn find(table: &str) -> Option<&'static Shown> {
    TABLE.iter().find(|row| row.table == table)
}

/// The role of a table of the file.
pub fn role(table: &str) -> Role {
    find(table).map_or(Role::Other, |row| row.role)
}

/// The role of what stands under a path of the file.
pub fn role_at(path: &str) -> Role {
    role(path.split('.').next().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_and_connection_is_drawn_and_told() {
        for row in TABLE {
            let of_element = mechanics::elements::TABLE.iter().any(|e| e.keys.name == row.table) || row.table == "distributed";
            let of_connection = mechanics::connections::TABLE.iter().any(|c| c.keys.name == row.table);
            assert!(of_element != of_connection, "[{}] is no table of the file", row.table);
            // what connections are called follows from their data: `connections`
            assert!(!of_element || !row.called.0.is_empty() && !row.letter.is_empty(), "[{}] has no name or no letter", row.table);
            let drawn = [row.along, row.turning, row.wheel];
            assert!(
                drawn.iter().all(|s| s.is_empty() || report::scheme::symbols::find(s).is_some()),
                "[{}] has symbols that do not exist: {drawn:?}",
                row.table
            );
        }
        let elements = mechanics::elements::TABLE.iter().map(|row| row.keys.name);
        for table in elements.chain(mechanics::connections::TABLE.iter().map(|row| row.keys.name)) {
            assert!(find(table).is_some(), "[{table}] has no row");
        }
    }
}
