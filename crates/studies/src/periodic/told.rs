//! What is said of a periodic regime: how it was found, whether it is stable, what its multipliers are.

use analysis::studies::periodic::{Multiplier, Regime};
use words::Text;

/// Distance from 1 at which a multiplier is 1, where its own error is smaller: half of the digits of a double root.
const FAMILY: f64 = 1e-8;

/// What is to be said where the period is not the least one, or not that of the forces.
pub(super) fn least(regime: &Regime) -> Option<Text> {
    let (parts, forces) = (regime.parts.max(1), regime.forces.max(1));
    let print = |k: usize| {
        let en = report::number::short(regime.period / k as f64, 10, words::Language::En);
        (en.clone(), en.replace('.', ","))
    };
    if parts > 1 {
        let (en, ru) = print(parts);
        return Some(Text::new(
            format!("The motion repeats already after {en} s: this period holds the least one {parts} times."),
            format!("Движение повторяется уже через {ru} с: этот период содержит наименьший {parts} раз(а)."),
        ));
    }
    (forces > 1).then(|| {
        let (en, ru) = print(forces);
        Text::new(
            format!("Subharmonic regime: the forces repeat after {en} s, the motion only after {forces} such times."),
            format!("Субгармонический режим: силы повторяются через {ru} с, движение — лишь через {forces} таких промежутков."),
        )
    })
}

/// How a motion was found that no start leads back to.
pub(super) fn in_parts(regime: &Regime) -> Option<Text> {
    let n = regime.pieces;
    (n > 1).then(|| {
        Text::new(
            format!("A period magnifies small changes of the start beyond all digits, so that no start alone leads back to itself (shooting): the motion was found in {n} parts, whose starts were sought together (multiple shooting)."),
            format!("За период малые изменения начала вырастают больше, чем позволяет разрядность чисел, и одно начальное состояние к себе не возвращается (стрельба невозможна): движение найдено по участкам, начала которых ищутся совместно (параллельная стрельба); участков: {n}."),
        )
    })
}

/// A multiplier 1 besides the shift along the motion: neighbouring motions close as well, and nothing singles this one out.
pub(super) fn one_of_a_family(regime: &Regime) -> Option<Text> {
    let is_one = |m: &&Multiplier| !m.trivial && algebra::elementary::hypot(m.re - 1.0, m.im) <= m.error.max(FAMILY);
    let found = regime.multipliers.iter().any(|m| is_one(&m));
    if regime.own {
        return found.then(|| {
            Text::new(
                "A multiplier 1 besides the shift: the regime is one of a family, as the motions of a machine without damping are. It is the motion from the given start, which returns by itself.",
                "Кроме сдвига есть ещё мультипликатор 1: режим принадлежит семейству, как движения машины без сопротивления. Это движение из заданного начала: оно возвращается само.",
            )
        });
    }
    found.then(|| {
        Text::new(
            "A multiplier 1 besides the shift: the regime is one of a family, as the motions of a machine without damping are, or those with a friction that sticks \
             all along at one place or another. The search gives the member that it met; its size and its period may differ from those of the motion from the given start, for which `simulate` with a named event is the answer.",
            "Кроме сдвига есть ещё мультипликатор 1: режим принадлежит семейству, как движения машины без сопротивления или движения, в которых трение всё время удерживает тело в том или ином месте. Найден тот из них, к которому привёл поиск; \
             его размах и период могут отличаться от размаха и периода движения из заданного начала — для него служит `simulate` с именованным событием.",
        )
    })
}

pub(super) fn verdict(regime: &Regime) -> Text {
    let text = |en: &str, ru: &str| Text::new(en, ru);
    let own = || regime.multipliers.iter().filter(|m| !m.trivial);
    match regime.stable {
        Some(true) if own().next().is_none() => text(
            "The regime is stable: nothing but the shift along it can be disturbed.",
            "Режим устойчив: кроме сдвига вдоль него, возмущать нечего.",
        ),
        Some(true) if regime.multipliers.iter().any(|m| m.trivial) => text(
            "The regime is stable: every multiplier but the 1 of the shift along the motion lies inside the unit circle.",
            "Режим устойчив: все мультипликаторы, кроме равного 1 (сдвиг вдоль движения), лежат внутри единичной окружности.",
        ),
        Some(true) => text(
            "The regime is stable: every multiplier lies inside the unit circle.",
            "Режим устойчив: все мультипликаторы лежат внутри единичной окружности.",
        ),
        Some(false) => text(
            "The regime is unstable: a multiplier lies outside the unit circle.",
            "Режим неустойчив: есть мультипликатор вне единичной окружности.",
        ),
        None if regime.multipliers.is_empty() => {
            text("Without multipliers nothing is said of stability.", "Без мультипликаторов об устойчивости ничего не сказано.")
        }
        None => {
            let nearest = own().min_by(|a, b| (a.abs() - 1.0).abs().total_cmp(&(b.abs() - 1.0).abs()));
            let (off, error) = nearest.map_or((0.0, 0.0), |m| ((m.abs() - 1.0).abs(), m.error));
            let short = |x: f64| report::number::short(x, 2, words::Language::En);
            let (off, error) = (short(off), short(error));
            text(
                &format!(
                    "The multipliers do not decide the stability: one is {off} away from the unit circle, and is known to {error} (neutral)."
                ),
                &format!(
                    "Мультипликаторы не решают вопрос об устойчивости: один из них отстоит от единичной окружности на {} при погрешности {} (нейтральный случай).",
                    off.replace('.', ","),
                    error.replace('.', ",")
                ),
            )
        }
    }
}

/// What the number in the table leaves out: argument, error, or why it is 1.
pub(crate) fn multiplier_words(m: &Multiplier) -> Text {
    let short = |x: f64, digits: usize| report::number::short(x, digits, words::Language::En);
    let same = |words: String| Text::new(words.clone(), words.replace('.', ","));
    match m.log_abs {
        _ if m.trivial => Text::new("of the shift along the motion", "сдвиг вдоль движения"),
        Some(log) => same(format!("±{}", power_of_ten(log / std::f64::consts::LN_10))),
        None if m.re == 0.0 && m.im == 0.0 && m.error == 0.0 => Text::default(),
        None if m.re == 0.0 && m.im == 0.0 => same(format!("0 ± {}", short(m.error, 1))),
        None if m.im == 0.0 => Text::default(),
        None => same(format!("{} {} {} i", short(m.re, 6), if m.im < 0.0 { "−" } else { "+" }, short(m.im.abs(), 6))),
    }
}

/// A number by its common logarithm, however small: 3.2·10⁻¹²³⁵.
fn power_of_ten(log: f64) -> String {
    let whole = log.floor();
    let mantissa = report::number::short(algebra::elementary::pow(10.0, log - whole), 3, words::Language::En);
    format!("{mantissa}·10{}", report::number::superscript(&format!("{whole:.0}")))
}
