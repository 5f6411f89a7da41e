//! Whether a value of one dimension may stand where another one is wanted.

use super::{Dimension, si_label, si_label_ru};
use std::ops::Range;
use words::Notice;

/// The fault of a formula whose dimension is not the wanted one.
pub(crate) fn mismatch(span: Range<usize>, got: &Dimension, wanted: &Dimension) -> Notice {
    let fault = differs(span, got, wanted);
    match wanted.without_angle().div(&got.without_angle()) {
        Some(factor) => fault.help(
            format!("look for a factor in {} that is missing", si_label(&factor)),
            format!("проверьте, не пропущен ли множитель размерности {}", si_label_ru(&factor)),
        ),
        None => fault,
    }
}

/// The fault of a number whose unit is not of the wanted dimension, or is missing.
pub(crate) fn mismatch_of_number(span: Range<usize>, got: &Dimension, wanted: &Dimension) -> Notice {
    let (w, w_ru) = (si_label(wanted), si_label_ru(wanted));
    if got.is_none() {
        return Notice::piece("M023", span, format!("the unit is missing: {w} is needed"), format!("нет единицы: нужна {w_ru}")).help(
            format!("write the number with its unit, for example \"5 {w}\""),
            format!("напишите число с единицей, например \"5 {w_ru}\""),
        );
    }
    differs(span, got, wanted)
        .help(format!("give it in {w} or a unit of the same kind"), format!("задайте величину в {w_ru} или в единицах того же рода"))
}

fn differs(span: Range<usize>, got: &Dimension, wanted: &Dimension) -> Notice {
    let (g, w) = (si_label(got), si_label(wanted));
    let (g_ru, w_ru) = (si_label_ru(got), si_label_ru(wanted));
    Notice::piece("M024", span, format!("this is {g}, but {w} is needed"), format!("размерность {g_ru}, а нужна {w_ru}"))
}

/// The complaint about a value that stands where `wanted` is wanted.
pub(crate) fn in_field(got: &Dimension, wanted: &Dimension, span: Range<usize>) -> Option<Notice> {
    if wanted.counts_periods() {
        let words = (
            "this is in rad/s, but the quantity counts periods (Hz, 1/min)".to_owned(),
            "это рад/с, а величина считает периоды (Гц, 1/мин)".to_owned(),
        );
        let fault = Notice::piece("M027", span, words.0, words.1);
        return got.has_radians().then(|| {
            fault
                .why("the number is taken as periods per second", "число принято за периоды в секунду")
                .help("divide by 2*pi or give it in Hz", "разделите на 2*pi или задайте в Гц")
                .warning()
        });
    }
    if !got.counts_periods() {
        return None;
    }
    if wanted.is_angular() {
        let words = (
            "this counts periods (Hz, 1/min), but an angular rate or angle in radians is meant".to_owned(),
            "это счёт периодов (Гц, 1/мин), а нужны угол или угловая скорость в радианах".to_owned(),
        );
        return got.lacks_radians().then(|| complaint(span, words));
    }
    (!wanted.is_of_time()).then(|| {
        Notice::piece(
            "M027",
            span,
            "a frequency in Hz or 1/min enters this value without 2 pi",
            "частота в Гц или 1/мин входит в эту величину без множителя 2 пи",
        )
        .why(
            "where an angular rate is meant, the value is off by 2 pi for each power of the frequency",
            "если нужна угловая скорость, значение неверно в 2 пи раз на каждую степень частоты",
        )
        .help(
            "write 2*pi*n for n; if periods are meant indeed, give n in 1/s",
            "напишите 2*pi*n вместо n; если нужны именно периоды, задайте n в 1/с",
        )
        .warning()
    })
}

/// The complaint about a count of periods where radians are meant.
pub(crate) fn complaint(span: Range<usize>, (en, ru): (String, String)) -> Notice {
    Notice::piece("M027", span, en, ru)
        .why(
            "one period is 2 pi radians; without this factor the number is taken as rad/s: 25 Hz as 25 rad/s, 1450 1/min as 24.17 rad/s",
            "один период — это 2 пи радиан; без множителя число принимается за рад/с: 25 Гц за 25 рад/с, 1450 1/мин за 24,17 рад/с",
        )
        .help(
            "give the rate in rpm, rev/min, rev/s or rad/s, or write 2*pi*n in the formula",
            "задайте частоту вращения в об/мин, об/с или рад/с или напишите в формуле 2*pi*n",
        )
        .warning()
}
