//! Long explanations of the findings about names and letters.

use words::explain::{Explanation, row};

/// The codes of names that cannot be told apart.
pub const NAMES: &[Explanation] = &[
    row(
        "M140",
        ("names that look alike", "имена, неотличимые на вид"),
        (
            "Letters of different alphabets print alike: Latin c and Cyrillic с, Latin x and Cyrillic х, Greek ο and Latin o. Two names that differ in \
             nothing else are two quantities which no reader can tell apart. Write names in one alphabet.",
            "Буквы разных алфавитов печатаются одинаково: латинская c и русская с, латинская x и русская х, греческая ο и латинская o. Два имени, которые \
             отличаются только этим, — две величины, неразличимые для читателя. Пишите имена в одном алфавите.",
        ),
        "[parameters]\nc = \"1 N/m\"\n\"с\" = \"5 N/m\"\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n",
        "[parameters]\nc = \"1 N/m\"\nc_2 = \"5 N/m\"\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n",
    ),
    row(
        "M141",
        ("quantities printed alike", "величины с одинаковым обозначением"),
        (
            "Two quantities have one printed symbol: m1 and m_1 both print as m with the index 1, phi and φ as φ, and a `symbol` may repeat that of \
             another quantity. The numbers are right; the printed equations do not say which is meant.",
            "У двух величин одно печатное обозначение: m1 и m_1 печатаются как m с индексом 1, phi и φ — как φ, а `symbol` может повторить обозначение \
             другой величины. Числа верны, но по печатным уравнениям не понять, о какой величине речь.",
        ),
        "[parameters]\nm1 = \"1 kg\"\nm_1 = \"2 kg\"\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"m1 + m_1\"\n",
        "[parameters]\nm1 = \"1 kg\"\nm2 = \"2 kg\"\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"m1 + m2\"\n",
    ),
    row(
        "M142",
        ("a comma that may group thousands", "запятая, которая может отделять тысячи"),
        (
            "In a quantity a comma is a decimal mark, as in 12,5 kg: `1,450 rpm` is 1.45 rpm. With exactly three digits behind it, it may have been meant \
             to group thousands.",
            "В величине запятая — десятичный знак, как в 12,5 кг: `1,450 rpm` — это 1,45 об/мин. Если за ней ровно три цифры, возможно, она отделяет тысячи.",
        ),
        "q = \"1,450 rpm\"",
        "q = \"1450 rpm\"",
    ),
    row(
        "M143",
        ("a claim that compares nothing", "результат, который не с чем сравнить"),
        (
            "A claim of [[claims]] is one of five: `equation`; `of` with `formula`; `of` with `value` and, if it is not the start, `at`; `mode` with `value`; `frequency`, an equation in k, with `unknown` where it has another unknown.",
            "Результат в [[claims]] — одно из пяти: `equation`; `of` и `formula`; `of` и `value`, а если это не начало движения, то и `at`; `mode` и `value`; `frequency` — уравнение относительно k, и `unknown`, если неизвестная другая.",
        ),
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[[claims]]\nof = \"x\"\n",
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[[claims]]\nof = \"x\"\nvalue = \"0 m\"\n",
    ),
    row(
        "M144",
        ("not an equation", "не уравнение"),
        (
            "A published equation is written as it stands in its source: a left side, one sign =, a right side.",
            "Опубликованное уравнение записывается так же, как в источнике: левая часть, один знак =, правая часть.",
        ),
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[[claims]]\nequation = \"x''\"\n",
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[[claims]]\nequation = \"x'' = 0\"\n",
    ),
];
