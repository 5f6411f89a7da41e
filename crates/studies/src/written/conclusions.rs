//! Conclusions: statements with guards over numbers. A statement is written only where its guard holds, and its words say no more than that.

use super::pen::{Pen, lowered};
use super::work::Work;
use crate::results::{Conclusion, Results};
use words::Language;

/// Significant digits of a number in a sentence.
const DIGITS: usize = 4;
/// A growth that is zero but for rounding, 1/s: multipliers on the unit circle are found to ten digits.
const STEADY: f64 = 1e-6;
/// How far a sample may lie beyond an extreme that was sought between samples.
const ROUNDING: f64 = 1e-9;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let statements = work.calculation.results.iter().flat_map(|results| of_study(work, results));
    let audits = super::verification::merged(work.calculation.audits());
    let checks = Conclusion::Checks { all: audits.len(), failed: audits.iter().filter(|a| !a.ok).count() };
    let held = statements.chain([checks]).filter(Conclusion::holds);
    let symbols = super::sentences::Symbols::of(work);
    // two ways to one motion say the same of it
    let mut told: Vec<String> = Vec::new();
    for statement in held {
        let words = statement.words(work.language);
        if told.contains(&words) {
            continue;
        }
        let line = format!("{}. {words}", told.len() + 1);
        told.push(words);
        match statement {
            Conclusion::Held { .. }
            | Conclusion::Irregular { .. }
            | Conclusion::Greatest { .. }
            | Conclusion::Number { .. }
            | Conclusion::Disturbed { .. } => {
                pen.tell(symbols.split(&line));
            }
            _ => pen.say(line),
        }
    }
}

impl Conclusion {
    /// The guard.
    fn holds(&self) -> bool {
        match self {
            Conclusion::Unfinished { heading } => !heading.en.is_empty(),
            Conclusion::Lowest { omega, all } => {
                *omega > 0.0 && omega.is_finite() && all.iter().all(|w| w.is_nan() || *w <= 0.0 || *w >= *omega)
            }
            Conclusion::Rest { stable } => !stable.is_empty(),
            Conclusion::Greatest { t, beside, value, shown, .. } => {
                let bound = value.abs() * (1.0 + ROUNDING) + f64::MIN_POSITIVE;
                value.is_finite()
                    && *value != 0.0
                    && t.is_finite()
                    && shown.0.is_finite()
                    && beside.iter().all(|v| v.is_nan() || v.abs() <= bound)
            }
            Conclusion::Forced { omega, amplitude, .. } => {
                *omega > 0.0 && omega.is_finite() && amplitude.0 >= 0.0 && amplitude.0.is_finite()
            }
            Conclusion::Antiresonance { omega, exact, .. } => *exact && *omega > 0.0 && omega.is_finite(),
            Conclusion::Regime { period, .. } => *period > 0.0 && period.is_finite(),
            // a verdict and a growth that speak against one another are told by neither
            Conclusion::Disturbed { stable, growth, verdict } => {
                !verdict.en.is_empty() && growth.is_none_or(|g| g.is_finite() && stable.is_none_or(|stable| stable == (g <= STEADY)))
            }
            Conclusion::Number { label, value, .. } => !label.en.is_empty() && value.is_finite(),
            Conclusion::Irregular { delta } => *delta >= 0.0 && delta.is_finite(),
            Conclusion::Needed { delta, found } => {
                !found.is_empty() && found.iter().all(|(_, value, _)| value.is_finite()) && delta.is_none_or(|d| d > 0.0 && d.is_finite())
            }
            Conclusion::Held { found } => !found.is_empty() && found.iter().all(|(_, value, _)| value.is_finite()),
            Conclusion::Checks { all, failed } => *all > 0 && failed <= all,
            Conclusion::Published { all, refuted } => *all > 0 && refuted <= all,
        }
    }

    fn words(&self, language: Language) -> String {
        let number = |x: f64| report::number::short(x, DIGITS, language);
        match self {
            Conclusion::Unfinished { heading } => {
                let heading = language.text(heading);
                language.pick(format!("The study “{heading}” was not completed."), format!("Расчёт «{heading}» не завершён."))
            }
            Conclusion::Lowest { omega, .. } => {
                let pair = report::number::frequency_pair(*omega, DIGITS, language);
                language.pick(
                    format!("The lowest natural frequency that is not zero is {pair}."),
                    format!("Низшая отличная от нуля собственная частота {pair}."),
                )
            }
            Conclusion::Rest { stable } => rest(stable, language),
            Conclusion::Greatest { label, shown: (value, unit), t, .. } => {
                let label = lowered(language.text(label));
                let value = report::number::with_unit(&number(*value), unit);
                let t = number(*t);
                language.pick(
                    format!("The largest magnitude of “{label}” is {value}, at t\u{a0}=\u{a0}{t}\u{a0}s."),
                    format!("Наибольшее по модулю значение величины «{label}» равно {value} при t\u{a0}=\u{a0}{t}\u{a0}с."),
                )
            }
            Conclusion::Forced { label, omega, amplitude: (value, unit), gain } => {
                forced(&lowered(language.text(label)), (*omega, *gain), &report::number::with_unit(&number(*value), unit), language)
            }
            Conclusion::Antiresonance { label, omega, .. } => {
                let (label, omega) = (lowered(language.text(label)), number(*omega));
                language.pick(
                    format!("Antiresonance of “{label}”: it rests at ω\u{a0}=\u{a0}{omega}\u{a0}rad/s."),
                    format!("Антирезонанс величины «{label}»: при ω\u{a0}=\u{a0}{omega}\u{a0}рад/с её амплитуда равна нулю."),
                )
            }
            Conclusion::Regime { period, stable } => {
                let [holds, fails] = regimes(&number(*period), language);
                if *stable { holds } else { fails }
            }
            Conclusion::Disturbed { verdict, .. } => ended(language.text(verdict)),
            Conclusion::Number { label, symbol, value, unit } => found(language.text(label), (symbol, &number(*value), unit)),
            Conclusion::Irregular { delta } => {
                let delta = number(*delta);
                language.pick(
                    format!("The irregularity of running (ω_max − ω_min)/ω_m is {delta}."),
                    format!("Коэффициент неравномерности хода (ω_max − ω_min)/ω_m равен {delta}."),
                )
            }
            Conclusion::Needed { delta, found } => needed(*delta, found, language),
            Conclusion::Held { found } => {
                let list = listed(found, language);
                language.pick(format!("Reactions at rest: {list}."), format!("Реакции связей в покое: {list}."))
            }
            Conclusion::Published { all, refuted } => published(*all, *refuted, language),
            Conclusion::Checks { all, failed: 0 } => {
                language.pick(format!("All checks hold ({all})."), format!("Все проверки выполнены (всего {all})."))
            }
            Conclusion::Checks { all, failed } => language.pick(
                format!("Of {all} checks {failed} do not hold: the results are not to be used."),
                format!("Не выполнено проверок: {failed} из {all}; результатами пользоваться нельзя."),
            ),
        }
    }
}

/// A number that a study found.
fn found(label: &str, (symbol, value, unit): (&str, &str, &str)) -> String {
    let value = report::number::with_unit(value, unit);
    format!("{}: {symbol}\u{a0}=\u{a0}{value}.", words::capital(label))
}

/// A sentence, with its full stop.
fn ended(text: &str) -> String {
    let text = words::capital(text.trim());
    if text.ends_with('.') { text } else { format!("{text}.") }
}

/// `F_0 = 8999 N; ...`.
fn listed(found: &[(String, f64, String)], language: Language) -> String {
    let number = |x: f64| report::number::short(x, DIGITS, language);
    let one = |(name, value, unit): &(String, f64, String)| format!("{name} = {}", report::number::with_unit(&number(*value), unit));
    found.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// The amplitude of forced oscillations.
fn forced(label: &str, (omega, gain): (f64, Option<f64>), amplitude: &str, language: Language) -> String {
    let number = |x: f64| report::number::short(x, DIGITS, language);
    let omega = number(omega);
    let gain = gain.filter(|g| g.is_finite()).map(number);
    let gain =
        gain.map_or_else(String::new, |g| language.pick(format!(", {g} times the static one"), format!(", коэффициент динамичности {g}")));
    language.pick(
        format!("The amplitude of “{label}” at ω\u{a0}=\u{a0}{omega}\u{a0}rad/s is {amplitude}{gain}."),
        format!("Амплитуда вынужденных колебаний величины «{label}» при ω\u{a0}=\u{a0}{omega}\u{a0}рад/с равна {amplitude}{gain}."),
    )
}

/// A periodic regime that is stable, and one that is not.
fn regimes(period: &str, language: Language) -> [String; 2] {
    [
        language.pick(
            format!("The periodic regime with the period {period} s is stable."),
            format!("Периодический режим с периодом {period} с устойчив."),
        ),
        language.pick(
            format!("The periodic regime with the period {period} s is unstable."),
            format!("Периодический режим с периодом {period} с неустойчив."),
        ),
    ]
}

/// What a cycle needs.
fn needed(delta: Option<f64>, found: &[(String, f64, String)], language: Language) -> String {
    let number = |x: f64| report::number::short(x, DIGITS, language);
    let list = listed(found, language);
    match delta.map(number) {
        Some(delta) => language.pick(
            format!("The wanted irregularity {delta} needs {list}."),
            format!("Для заданного коэффициента неравномерности {delta} требуется: {list}."),
        ),
        None => {
            language.pick(format!("The balance of work over the cycle gives {list}."), format!("Из баланса работ за цикл найдено: {list}."))
        }
    }
}

/// Published results beside ours.
fn published(all: usize, refuted: usize, language: Language) -> String {
    match refuted {
        0 => language.pick(
            format!("The published results are confirmed ({all})."),
            format!("Опубликованные результаты подтверждены (всего {all})."),
        ),
        _ => language.pick(
            format!("Of {all} published results {refuted} are not confirmed: see the verification."),
            format!("Не подтверждено опубликованных результатов: {refuted} из {all}, см. проверку результатов."),
        ),
    }
}

/// Places of rest: how many are stable, unstable, undecided.
fn rest(stable: &[Option<bool>], language: Language) -> String {
    let count = |wanted: Option<bool>| stable.iter().filter(|s| **s == wanted).count();
    let (yes, no, open) = (count(Some(true)), count(Some(false)), count(None));
    let parts = [
        (yes, language.pick("stable", "устойчивых")),
        (no, language.pick("unstable", "неустойчивых")),
        (open, language.pick("not decided by linearisation", "не решаемых линейным приближением")),
    ];
    if let [only] = stable {
        return match only {
            Some(true) => {
                language.pick("The position of equilibrium that was found is stable.", "Найденное положение равновесия устойчиво.")
            }
            Some(false) => {
                language.pick("The position of equilibrium that was found is unstable.", "Найденное положение равновесия неустойчиво.")
            }
            None => language.pick(
                "Linearisation does not decide the stability of the equilibrium.",
                "Устойчивость положения равновесия по линейному приближению не определяется.",
            ),
        }
        .to_owned();
    }
    let list: Vec<String> = parts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{what}: {n}")).collect();
    let n = stable.len();
    language.pick(
        format!("{n} positions of equilibrium were found ({}).", list.join(", ")),
        format!("Найдено положений равновесия: {n} ({}).", list.join(", ")),
    )
}

/// What a study allows to say.
fn of_study(work: &Work, results: &Results) -> Vec<Conclusion> {
    if results.trouble.is_some() {
        return vec![Conclusion::Unfinished { heading: results.heading.clone() }];
    }
    let machine = &work.calculation.machine;
    match machine.origin.studies.find(results.kind) {
        Some(study) => study.concludes(machine, results, work.language),
        None => crate::claims::concludes(results),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plain congruential numbers, also zeros, infinities and none.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            match self.0 >> 61 {
                0 => f64::NAN,
                1 => 0.0,
                2 => f64::INFINITY,
                _ => f64::from((self.0 >> 32) as u32) / 1e9 - 2.0,
            }
        }
        fn list(&mut self) -> Vec<f64> {
            (0..5).map(|_| self.next()).collect()
        }
    }

    #[test]
    fn what_is_said_holds_for_all_numbers() {
        let mut numbers = Numbers(7);
        let (mut said, mut silent) = (0, 0);
        for _ in 0..4000 {
            let (value, all, t) = (numbers.next(), numbers.list(), numbers.next());
            let decided = all.iter().map(|v| (!v.is_nan()).then_some(*v > 0.0)).collect::<Vec<_>>();
            let statements = [
                Conclusion::Lowest { omega: value, all: all.clone() },
                Conclusion::Greatest { label: words::Text::same("x"), shown: (value, String::new()), t, beside: all.clone(), value },
                Conclusion::Regime { period: value, stable: t > 0.0 },
                Conclusion::Irregular { delta: value },
                Conclusion::Disturbed {
                    stable: Some(t > 0.0),
                    growth: Some(value),
                    verdict: words::Text::same(if t > 0.0 { "stable" } else { "grows" }),
                },
                Conclusion::Number { label: words::Text::same("x"), symbol: "x".into(), value, unit: String::new() },
                Conclusion::Needed { delta: Some(t), found: vec![("J".into(), value, "kg".into())] },
                Conclusion::Needed { delta: None, found: all.iter().map(|v| ("x".to_owned(), *v, String::new())).collect() },
                Conclusion::Rest { stable: decided.clone() },
                Conclusion::Forced { label: words::Text::same("x"), omega: t, amplitude: (value, "m".into()), gain: Some(all[0]) },
                Conclusion::Antiresonance { label: words::Text::same("x"), omega: value, exact: t > 0.0 },
            ];
            for statement in statements {
                if !statement.holds() {
                    silent += 1;
                    continue;
                }
                said += 1;
                let words = statement.words(Language::En);
                assert!(!words.contains('∞') && !words.contains("– s"), "{words}");
                match &statement {
                    Conclusion::Lowest { omega, all } => assert!(!all.iter().any(|w| *w > 0.0 && *w < *omega), "{statement:?}"),
                    Conclusion::Greatest { value, beside, .. } => {
                        assert!(!beside.iter().any(|v| v.abs() > value.abs() * (1.0 + 2.0 * ROUNDING)), "{statement:?}");
                    }
                    Conclusion::Disturbed { growth, .. } => {
                        assert_eq!(words.contains("Stable"), growth.is_some_and(|g| g <= STEADY), "{statement:?}");
                    }
                    Conclusion::Regime { stable, .. } => assert_eq!(words.contains("unstable"), !stable),
                    Conclusion::Rest { stable } => {
                        let has = |word: &str| words.split(|c: char| !c.is_alphabetic()).any(|w| w == word);
                        assert_eq!(has("stable"), stable.contains(&Some(true)), "{words}");
                        assert_eq!(has("unstable"), stable.contains(&Some(false)), "{words}");
                    }
                    Conclusion::Needed { delta, found } => {
                        assert!(found.iter().all(|(_, v, _)| v.is_finite()) && !words.contains('–'), "{words}");
                        assert_eq!(words.contains("wanted"), delta.is_some(), "{words}");
                        assert!(delta.is_none_or(|d| d > 0.0), "{statement:?}");
                    }
                    Conclusion::Forced { omega, gain, .. } => {
                        assert!(*omega > 0.0 && value >= 0.0, "{statement:?}");
                        assert_eq!(words.contains("static"), gain.is_some_and(f64::is_finite), "{words}");
                    }
                    Conclusion::Antiresonance { exact, .. } => assert!(*exact && value > 0.0, "{statement:?}"),
                    Conclusion::Number { value, .. } => assert!(value.is_finite() && !words.contains('–'), "{statement:?}"),
                    _ => assert!(value >= 0.0),
                }
            }
        }
        assert!(said > 1000 && silent > 1000, "{said} {silent}");
    }

    #[test]
    fn failed_checks_are_never_called_held() {
        for (all, failed) in (0..9).flat_map(|all| (0..=all + 1).map(move |failed| (all, failed))) {
            let published = Conclusion::Published { all, refuted: failed };
            assert_eq!(published.holds(), all > 0 && failed <= all);
            if published.holds() {
                assert_eq!(published.words(Language::En).contains("not confirmed"), failed > 0);
                assert_eq!(published.words(Language::Ru).contains("Не подтверждено"), failed > 0);
            }
            let statement = Conclusion::Checks { all, failed };
            assert_eq!(statement.holds(), all > 0 && failed <= all);
            if statement.holds() {
                assert_eq!(statement.words(Language::Ru).starts_with("Все"), failed == 0);
            }
        }
    }
}
