//! Faults of names of loads.

use words::{Message, Text};

use super::Fault;
use words::explain::{Explanation, plain};

/// Rows of loads.
pub const EXPLANATIONS: &[Explanation] = &[plain("S095", ("a name with two meanings", "имя с двумя значениями"), (SHARED_EN, SHARED_RU))];

const SHARED_EN: &str = "Names are free in each table of the file: a force, a torque and a coordinate may share one. Where one of them is to be the load of a \
    response, the name alone does not say which: forces.f is the force with its own size and direction, coordinates.f a unit load on the coordinate. \
    Write the name with its table.";
const SHARED_RU: &str = "В каждой таблице файла имена свои: сила, момент и координата могут называться одинаково. Если одна из этих величин служит нагрузкой \
    при вынужденных колебаниях, одного имени мало: forces.f – сила со своей величиной и направлением, coordinates.f – единичная нагрузка по координате. \
    Укажите имя вместе с таблицей.";

/// S095: several loads and coordinates have a name; `paths` are they with their tables.
pub fn shared(name: &str, paths: &[String]) -> Fault {
    let list = paths.join(", ");
    Fault::new(Message {
        code: "S095",
        what: Text::new(format!("the load `{name}` may be {list}"), format!("нагрузка `{name}` может означать {list}")),
        why: Text::new(
            "a force, a torque and a coordinate (a unit load on it) of one name are different loads",
            "сила, момент и координата (единичная нагрузка по ней) с одним именем – разные нагрузки",
        ),
        help: Text::new(
            format!("write it with its table: load = \"{}\"", paths.first().map_or(name, String::as_str)),
            format!("укажите её вместе с таблицей: load = \"{}\"", paths.first().map_or(name, String::as_str)),
        ),
    })
}
