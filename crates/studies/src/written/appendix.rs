//! Sources, and the file as it is.

use super::Work;
use super::pen::Pen;
use report::Block;

/// What the methods come from.
const SOURCES: [(&str, &str); 3] = [
    (
        "Loitsyanskii L. G., Lurie A. I. A Course of Theoretical Mechanics. Vol. 2: Dynamics.",
        "Лойцянский Л. Г., Лурье А. И. Курс теоретической механики. Т. 2: Динамика.",
    ),
    ("Yablonskii A. A., Noreiko S. S. A Course of the Theory of Oscillations.", "Яблонский А. А., Норейко С. С. Курс теории колебаний."),
    (
        "GOST 7.32-2017. Research report. Structure and rules of presentation.",
        "ГОСТ 7.32–2017. Отчёт о научно-исследовательской работе. Структура и правила оформления.",
    ),
];

pub(super) fn sources(work: &Work, pen: &mut Pen) {
    for (i, (en, ru)) in SOURCES.into_iter().enumerate() {
        pen.say(format!("{}. {}", i + 1, work.language.pick(en, ru)));
    }
}

pub(super) fn model(work: &Work, pen: &mut Pen) {
    let source = &work.calculation.machine.origin.source;
    if !source.text.trim().is_empty() {
        pen.blocks.push(Block::Verbatim(source.text.clone()));
    }
}
