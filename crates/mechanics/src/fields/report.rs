//! `[report]`: the title page of the written calculation, what stands in it, how deep.

use crate::keys::{TableSpec, Type, may};

/// Chapters as `sections` names them, in the order of the calculation.
pub const PARTS: [&str; 14] = [
    "statement",
    "sections",
    "kinematics",
    "equations",
    "free",
    "forced",
    "motion",
    "reactions",
    "regime",
    "verification",
    "conclusions",
    "sources",
    "model",
    "tables",
];

/// `[report]`.
pub const REPORT: TableSpec = TableSpec {
    name: "report",
    about: (
        "The written calculation of `strutt report`: with any key of the title page it has one. `sections` chooses chapters: `statement`, `sections`, `kinematics`, `equations`, `free`, `forced`, `motion`, `reactions`, `regime`, `verification`, `conclusions`, `sources`, `model`, `tables`.",
        "Записанный расчёт `strutt report`: если задан хотя бы один ключ титульного листа, лист есть. `sections` выбирает главы: `statement` – постановка, `sections` – сечения, `kinematics` – кинематика, `equations` – уравнения, `free` – свободные колебания, `forced` – вынужденные, `motion` – движение, `reactions` – реакции, `regime` – режим, `verification` – проверка, `conclusions` – выводы, `sources` – источники, `model` – текст модели, `tables` – таблицы.",
    ),
    short: None,
    fields: &[
        may(
            "organisation",
            Type::Text,
            "",
            "",
            ("university or firm", "вуз или предприятие"),
            "{ en = \"State University\", ru = \"Государственный университет\" }",
        ),
        may(
            "department",
            Type::Text,
            "",
            "",
            ("department", "кафедра"),
            "{ en = \"Department of Mechanics\", ru = \"Кафедра теоретической механики\" }",
        ),
        may(
            "kind",
            Type::Text,
            "",
            "\"Calculation\"",
            ("what the work is", "вид работы"),
            "{ en = \"Term paper\", ru = \"Курсовая работа\" }",
        ),
        may(
            "discipline",
            Type::Text,
            "",
            "",
            ("discipline", "дисциплина"),
            "{ en = \"Theoretical mechanics\", ru = \"Теоретическая механика\" }",
        ),
        may(
            "student",
            Type::Text,
            "",
            "",
            ("who made it; without it a line to write on", "кто выполнил; без ключа – строка для записи"),
            "\"Иванов И. И.\"",
        ),
        may("group", Type::Text, "", "", ("group of the student", "группа студента"), "\"М-21\""),
        may(
            "teacher",
            Type::Text,
            "",
            "",
            ("who checks it; without it a line to sign on", "кто проверяет; без ключа – строка для подписи"),
            "\"Петров П. П.\"",
        ),
        may("city", Type::Text, "", "", ("city", "город"), "{ en = \"Moscow\", ru = \"Москва\" }"),
        may("year", Type::String, "", "", ("year", "год"), "\"2026\""),
        may(
            "sections",
            Type::Names,
            "",
            "all",
            ("chapters that are written", "какие главы записываются"),
            "[\"statement\", \"equations\", \"conclusions\"]",
        ),
        may(
            "depth",
            Type::String,
            "",
            "\"full\"",
            (
                "`full`; `short` leaves out the derivatives on the way to Lagrange's equations and the appendices",
                "`full` – полностью; `short` – без производных на пути к уравнениям Лагранжа и без приложений",
            ),
            "\"short\"",
        ),
    ],
    example: "[report]\ndepartment = \"Department of Mechanics\"\nstudent = \"J. Smith\"\nyear = \"2026\"\n",
};
