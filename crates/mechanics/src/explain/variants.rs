//! Long explanations of the codes of variants and answers.

use words::explain::{Explanation, row};

/// The codes of variants and answers.
pub const VARIANTS: &[Explanation] = &[
    row(
        "M370",
        ("numbers of variants", "номера вариантов"),
        (
            "`N` of [variants] is a range of whole numbers, \"1..30\"; `n` is the whole number of a group; `empty` is \"keeps\" or \"absent\".",
            "`N` в [variants] — диапазон целых номеров, \"1..30\"; `n` — целый номер группы; `empty` — \"keeps\" или \"absent\".",
        ),
        "[variants]\nN = \"30\"\nm = \"1 [kg] + 0.1 [kg]*N\"",
        "[variants]\nN = \"1..30\"\nm = \"1 [kg] + 0.1 [kg]*N\"",
    ),
    row(
        "M371",
        ("formulas of variants", "формулы вариантов"),
        (
            "A quantity of a variant has one source. Its formula may use its own column of the table, so that `m = \"m*(1 + 0.01*N)\"` changes what the table gives; a column that the \
             formula does not use would be lost. Formulas may use one another, but not in a circle.",
            "У величины варианта один источник. Формула может использовать собственный столбец таблицы: `m = \"m*(1 + 0.01*N)\"` меняет то, что в таблице; столбец, который формула не \
             использует, пропал бы. Формулы могут использовать друг друга, но не по кругу.",
        ),
        "[variants]\nN = \"1..30\"\nm = \"k*1 [kg m/N]\"\nk = \"m*1 [N/m/kg]\"",
        "[variants]\nN = \"1..30\"\nm = \"1 [kg]*N\"\nk = \"m*1 [N/m/kg]\"",
    ),
    row(
        "M372",
        ("id of an answer", "идентификатор ответа"),
        (
            "The id of an answer is a name: letters, digits and _. It names a column of the file with the answers and stands in formulas of later items, so each id occurs once.",
            "Идентификатор ответа — имя из букв, цифр и _. Он называет столбец в файле ответов и стоит в формулах следующих вопросов, поэтому двух одинаковых быть не может.",
        ),
        "[[answers]]\nid = \"f 1\"\nvalue = \"modes.1.f\"\nunit = \"Hz\"",
        "[[answers]]\nid = \"f1\"\nvalue = \"modes.1.f\"\nunit = \"Hz\"",
    ),
    row(
        "M373",
        ("source of an answer", "источник ответа"),
        (
            "The right number comes either from a study (`value`, with `of` and `at` where they are needed) or from a `formula` of parameters and earlier answers.",
            "Верное число берётся либо из расчёта (`value`, при необходимости с `of` и `at`), либо по формуле (`formula`) от параметров и предыдущих ответов.",
        ),
        "[[answers]]\nid = \"T\"\nunit = \"s\"",
        "[[answers]]\nid = \"T\"\nformula = \"2*pi*sqrt(m/k)\"\nunit = \"s\"",
    ),
    row(
        "M374",
        ("tolerance of an answer", "допуск ответа"),
        (
            "A tolerance is a share of the right value (\"2 %\", 0.02) or a quantity of the dimension of the answer (\"0.5 mm\").",
            "Допуск — доля верного значения (\"2 %\", 0.02) или величина той же размерности, что и ответ (\"0,5 мм\").",
        ),
        "[[answers]]\nid = \"T\"\nformula = \"2*pi*sqrt(m/k)\"\nunit = \"s\"\ntolerance = \"2 kg\"",
        "[[answers]]\nid = \"T\"\nformula = \"2*pi*sqrt(m/k)\"\nunit = \"s\"\ntolerance = \"2 %\"",
    ),
];
