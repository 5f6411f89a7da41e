//! The tables of the file by chapters of the reference, in the order in which a reader meets them.

use super::{claims, distributed, events, report, sections, structures as s, tables, variants};
use crate::connections;
use crate::elements::TABLE;
use crate::keys::{TableSpec, Words};

/// A page of the reference.
#[derive(Clone, Copy, Debug)]
pub struct Chapter {
    /// Name of its file, without the ending.
    pub file: &'static str,
    /// Heading.
    pub title: Words,
    /// What it is about, in a sentence.
    pub about: Words,
    /// Its tables.
    pub tables: &'static [&'static TableSpec],
}

/// Every chapter that is made of tables.
pub const CHAPTERS: &[Chapter] = &[
    Chapter {
        file: "file",
        title: ("The file as a whole", "Файл в целом"),
        about: (
            "What stands outside any table; gravity, impacts, titles in two languages.",
            "Что стоит вне таблиц; сила тяжести, удары, тексты на двух языках.",
        ),
        tables: &[&tables::TOP, &crate::keys::TEXT],
    },
    Chapter {
        file: "parameters",
        title: ("Parameters and coordinates", "Параметры и координаты"),
        about: (
            "Named values, generalized coordinates with their start, values that change in phases.",
            "Именованные величины, обобщённые координаты с начальными условиями, величины, меняющиеся по этапам.",
        ),
        tables: &[&tables::PARAMETER, &tables::COORDINATE, &tables::PHASE],
    },
    Chapter {
        file: "bodies",
        title: ("Bodies, frames, points", "Тела, системы отсчёта, точки"),
        about: ("What moves, where it stands and what it weighs.", "Что движется, на чём стоит и какую имеет массу."),
        tables: &[&tables::FRAME, &tables::BODY, &tables::TENSOR, &tables::POINT],
    },
    Chapter {
        file: "elements",
        title: ("Springs, dampers, loads", "Пружины, демпферы, нагрузки"),
        about: (
            "Elements that act by a law: springs, dampers, forces, torques, energies of any form.",
            "Элементы, усилие которых задано законом: пружины, демпферы, силы, моменты, энергии общего вида.",
        ),
        tables: &ELEMENTS,
    },
    Chapter {
        file: "connections",
        title: ("Connections", "Связи"),
        about: (
            "Joints, ropes, wheels, conditions, supports, prescribed motions and their motors; each has reactions.",
            "Шарниры, канаты, колёса, условия связи, опоры, заданные движения и двигатели; у каждой связи есть реакции.",
        ),
        tables: &JOINTS,
    },
    Chapter {
        file: "contacts",
        title: ("Contacts and friction", "Контакты и трение"),
        about: ("One-sided stops with impacts, dry friction that sticks.", "Односторонние упоры с ударами, сухое трение с залипанием."),
        tables: &CONTACTS,
    },
    Chapter {
        file: "structures",
        title: ("Frames, trusses, sections", "Рамы, фермы, сечения"),
        about: (
            "Nodes, rods, their supports and loads, named displacements; sections composed of parts.",
            "Узлы, стержни, их опоры и нагрузки, именованные перемещения; сечения, составленные из частей.",
        ),
        tables: &[
            &s::NODE,
            &s::ROD,
            &s::SUPPORT,
            &s::LINE_LOAD,
            &s::DISPLACEMENT,
            &s::RAYLEIGH,
            &s::STRUCTURE,
            &sections::SECTION,
            &sections::PART,
        ],
    },
    Chapter {
        file: "outputs",
        title: ("Outputs, events, claims", "Результаты, события, опубликованные данные"),
        about: (
            "What is to be told about a motion: named results, named instants, published values laid against the machine.",
            "Что требуется узнать о движении: именованные результаты, именованные моменты времени, опубликованные значения для сопоставления с машиной.",
        ),
        tables: &[&tables::OUTPUT, &events::EVENT, &tables::REGIME, &claims::CLAIM],
    },
    Chapter {
        file: "studies",
        title: ("Studies", "Расчёты"),
        about: ("What is to be computed, and the plots.", "Что рассчитать и какие графики построить."),
        tables: &[&crate::asked::STUDY, &tables::PLOT],
    },
    Chapter {
        file: "variants",
        title: ("Variants and answers", "Варианты и ответы"),
        about: (
            "Data that differ from student to student, conditions that they keep, and what students answer.",
            "Данные, которые у каждого студента свои, требования к ним и вопросы, на которые студент отвечает.",
        ),
        tables: &[&variants::VARIANTS, &variants::ANSWER],
    },
    Chapter {
        file: "report",
        title: ("Written calculation", "Записанный расчёт"),
        about: ("Title page, chapters and depth of `strutt report`.", "Титульный лист, главы и подробность `strutt report`."),
        tables: &[&report::REPORT],
    },
];

/// The tables of elements; distributed loads, which are made of forces, before those of any form.
const ELEMENTS: [&TableSpec; TABLE.len() + 1] = {
    let mut all: [&TableSpec; TABLE.len() + 1] = [&distributed::DISTRIBUTED; TABLE.len() + 1];
    let mut i = 0;
    while i < TABLE.len() {
        let behind = i + FREE_FORMS >= TABLE.len();
        all[i + behind as usize] = TABLE[i].keys;
        i += 1;
    }
    all
};

/// Potentials and dissipation functions, the last rows of the table.
const FREE_FORMS: usize = 2;

/// Stops and frictions, the last rows of the connections, have a chapter of their own.
const RUBBING: usize = 2;

/// How many tables the connections before row `end` have, with those within their rows.
const fn tables_before(end: usize) -> usize {
    let (mut i, mut n) = (0, 0);
    while i < end {
        n += 1 + connections::TABLE[i].within.len();
        i += 1;
    }
    n
}

/// The tables of rows of connections from `begin` on, each followed by those within its rows.
const fn tables_of<const N: usize>(begin: usize) -> [&'static TableSpec; N] {
    let mut all = [connections::TABLE[begin].keys; N];
    let (mut row, mut n) = (begin, 0);
    while n < N {
        all[n] = connections::TABLE[row].keys;
        n += 1;
        let within = connections::TABLE[row].within;
        let mut k = 0;
        while k < within.len() {
            all[n] = within[k];
            (n, k) = (n + 1, k + 1);
        }
        row += 1;
    }
    all
}

/// The tables of joints, ties, wheels, conditions, supports and drives.
const JOINTS: [&TableSpec; tables_before(connections::TABLE.len() - RUBBING)] = tables_of(0);
/// The tables of contacts.
const CONTACTS: [&TableSpec; RUBBING] = tables_of(connections::TABLE.len() - RUBBING);

/// Every table, in the order of the reference.
pub fn all() -> impl Iterator<Item = &'static TableSpec> {
    CHAPTERS.iter().flat_map(|chapter| chapter.tables).copied()
}
