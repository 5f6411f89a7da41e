//! Variants for a class: the right answers of each, what speaks against one, and what a wrong answer looks like. Pure functions over machines; files are read
//! and written above.

pub mod cell;
pub mod course;
pub mod diagnose;
pub mod grade;
pub mod guards;
pub mod key;
pub mod overview;
pub mod quiz;
pub mod resting;
pub mod sheet;
pub mod solve;

pub use course::{Class, Member};
pub use overview::{Overview, check};

use words::explain::{Explanation, plain, row};

/// The codes of variants and answers.
pub const EXPLANATIONS: &[Explanation] = &[
    row(
        "M375",
        ("an answer that asks for nothing", "ответ ни о чём"),
        (
            "`value` of an answer is a number of a study: max(x), min(x), amplitude(x), mean(x) or last(x) of an output, coordinate or rate; when_max(x), when_min(x), event(2) for an instant; \
             the name of an output with `at` for its value at an instant; or a number of the study by its path, with lists counted from 1: modes.1.f, period.",
            "`value` ответа — число из расчёта: max(x), min(x), amplitude(x), mean(x) или last(x) от выходной величины, координаты или скорости; when_max(x), when_min(x), event(2) — момент времени; \
             имя выходной величины и `at` — её значение в этот момент; либо число расчёта по его пути, счёт в списках с 1: modes.1.f, period.",
        ),
        "[[answers]]\nid = \"a\"\nvalue = \"max(nothing)\"\nunit = \"m\"",
        "[[answers]]\nid = \"a\"\nvalue = \"max(x)\"\nunit = \"m\"",
    ),
    row(
        "M376",
        ("unit of an answer", "единица ответа"),
        (
            "The unit of an answer has the dimension of its number. Hz and 1/min count periods: an angular rate in Hz is divided by 2π.",
            "Единица ответа имеет размерность самого числа. Гц и 1/мин считают периоды: угловая скорость в Гц делится на 2π.",
        ),
        "[[answers]]\nid = \"a\"\nvalue = \"max(x)\"\nunit = \"kg\"",
        "[[answers]]\nid = \"a\"\nvalue = \"max(x)\"\nunit = \"mm\"",
    ),
    plain(
        "C067",
        ("An answer without a number", "Ответ без числа"),
        (
            "The studies of the file give no number for this question, or the number is in another unit. `max(x)` needs a motion with the column x; a path (modes.1.f) needs a study that has it and a \
             number whose unit is known; the value of an output at a jump needs \"before\" or \"after\".",
            "Расчёты файла не дают числа для этого вопроса, либо число в другой единице. Для `max(x)` нужно движение со столбцом x; для пути (modes.1.f) — расчёт, в котором оно есть, и число с \
             известной единицей; для значения в момент скачка — \"before\" (до) или \"after\" (после).",
        ),
    ),
    plain(
        "C069",
        ("List of students", "Список студентов"),
        (
            "A list of students has one student a line: the name, and in a second column (comma, semicolon or tab) the variant; without that column the first student gets the first variant, and so on, so              there cannot be more students than variants. UTF-8 and Windows-1251 are read. A first line with the word name (ФИО, студент) is a head.",
            "В списке студентов по строке на студента: имя, а во втором столбце (запятая, точка с запятой или табуляция) вариант; без этого столбца первый студент получает первый вариант и так далее,              поэтому студентов не может быть больше, чем вариантов. Кодировки: UTF-8 и Windows-1251. Первая строка со словом ФИО (студент, name) — заголовок.",
        ),
    ),
    plain(
        "C070",
        ("Not a key", "Это не ключ"),
        (
            "`strutt variants grade` takes the file key.json that `strutt variants make` wrote, or its folder. The key holds the model, its hash and the right numbers; one that was changed by hand is refused.",
            "`strutt variants grade` принимает файл key.json, записанный командой `strutt variants make`, или папку с ним. В ключе есть модель, её хеш и верные числа; изменённый вручную ключ не              принимается.",
        ),
    ),
    plain(
        "C071",
        ("Answers to another task", "Ответы на другое задание"),
        (
            "The file with the answers names another model in its first line, no column is the name of a question of the key, or some columns are none while questions of the key have no column. The file answers.csv beside the key has the right columns.",
            "В первой строке файла с ответами указана другая модель, либо ни один столбец не называется как вопрос из ключа, либо есть столбцы с другими названиями, а некоторым вопросам столбца не досталось. Файл answers.csv рядом с ключом имеет нужные столбцы.",
        ),
    ),
    plain(
        "C072",
        ("Unreadable answers", "Ответы не читаются"),
        (
            "A file with answers is CSV: a head, then a row for each student, with the column student or variant and a column for each question. Commas, semicolons or tabs separate; with a comma between the cells,              numbers with decimal commas stand in quotes. UTF-8 and Windows-1251 are read.",
            "Файл с ответами — CSV: заголовок, затем по строке на студента; столбец student (студент) или variant (вариант) и по столбцу на вопрос. Разделители: запятая, точка с запятой или табуляция; если              разделитель — запятая, числа с десятичной запятой берут в кавычки. Кодировки: UTF-8 и Windows-1251.",
        ),
    ),
    plain(
        "C068",
        ("Which group?", "Какая группа?"),
        (
            "Formulas of [variants] use n, the number of the group. Give it with --group, or write n = 3 under [variants].",
            "Формулы в [variants] содержат номер группы n. Задайте его ключом --group или строкой n = 3 в [variants].",
        ),
    ),
];
