//! Long explanations of the findings about titles, labels and descriptions.

use words::explain::{Explanation, row};

/// The codes of texts.
pub const TEXTS: &[Explanation] = &[row(
    "M150",
    ("a control character in a text", "управляющий символ в тексте"),
    (
        "Titles, labels and names are shown on terminals and pages as they stand. Control characters (but tabs and ends of lines) would steer the \
         terminal, marks that turn the direction of writing would show another text than is written: neither is taken.",
        "Названия, подписи и имена выводятся на экран и страницы так, как написаны. Управляющие символы (кроме табуляции и конца строки) изменили бы \
         состояние терминала, а знаки, меняющие направление письма, показали бы не тот текст, что записан: ни те, ни другие не принимаются.",
    ),
    "title = \"the \\u001b[31mred machine\"",
    "title = \"the red machine\"",
)];
