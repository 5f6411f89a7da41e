//! Conclusions: statements with guards over numbers. A statement is written only where its guard holds, and its words say no more than that.

use super::pen::{Pen, lowered};
use super::work::Work;
use crate::results::Results;
use symbolic::equations::Role;
use words::Language;

/// Significant digits of a number in a sentence.
const DIGITS: usize = 4;
/// Extremes that are named.
const MOST: usize = 6;
/// Reactions at rest that are named.
const HELD: usize = 10;
/// How far a sample may lie beyond an extreme that was sought between samples.
const ROUNDING: f64 = 1e-9;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let statements = work.calculation.results.iter().flat_map(|results| of_study(work, results));
    let audits = super::verification::merged(work.calculation.audits());
    let checks = Statement::Checks { all: audits.len(), failed: audits.iter().filter(|a| !a.ok).count() };
    let held = statements.chain([checks]).filter(Statement::holds);
    let symbols = super::sentences::Symbols::of(work);
    for (i, statement) in held.enumerate() {
        let line = format!("{}. {}", i + 1, statement.words(work.language));
        match statement {
            Statement::Held { .. } => pen.tell(symbols.split(&line)),
            _ => pen.say(line),
        }
    }
}

/// What may be said at the end.
#[derive(Clone, Debug, PartialEq)]
enum Statement {
    /// A study did not come to its end.
    Unfinished { heading: words::Text },
    /// The least of the natural frequencies, none of which is left out.
    Lowest { omega: f64, all: Vec<f64> },
    /// Places of rest with what linearisation says of each: stable, unstable, nothing.
    Rest { stable: Vec<Option<bool>> },
    /// The greatest size of a quantity during the motion, its instant, and its values.
    Greatest { label: words::Text, shown: (f64, String), t: f64, beside: Vec<f64>, value: f64 },
    /// A periodic regime with its period and the largest size of the multipliers that are not that of the shift along it.
    Regime { period: f64, stable: bool },
    /// (ω_max − ω_min)/ω_mean.
    Irregular { delta: f64 },
    /// What a cycle needs: names, values with units as they are shown; for a wanted irregularity where there is one.
    Needed { delta: Option<f64>, found: Vec<(String, f64, String)> },
    /// Reactions at rest: symbols, values with units as they are shown.
    Held { found: Vec<(String, f64, String)> },
    /// Published results laid against ours: all, and those that do not hold.
    Published { all: usize, refuted: usize },
    /// The checks of the calculation.
    Checks { all: usize, failed: usize },
}

impl Statement {
    /// The guard.
    fn holds(&self) -> bool {
        match self {
            Statement::Unfinished { heading } => !heading.en.is_empty(),
            Statement::Lowest { omega, all } => {
                *omega > 0.0 && omega.is_finite() && all.iter().all(|w| w.is_nan() || *w <= 0.0 || *w >= *omega)
            }
            Statement::Rest { stable } => !stable.is_empty(),
            Statement::Greatest { t, beside, value, shown, .. } => {
                let bound = value.abs() * (1.0 + ROUNDING) + f64::MIN_POSITIVE;
                value.is_finite()
                    && *value != 0.0
                    && t.is_finite()
                    && shown.0.is_finite()
                    && beside.iter().all(|v| v.is_nan() || v.abs() <= bound)
            }
            Statement::Regime { period, .. } => *period > 0.0 && period.is_finite(),
            Statement::Irregular { delta } => *delta >= 0.0 && delta.is_finite(),
            Statement::Needed { delta, found } => {
                !found.is_empty() && found.iter().all(|(_, value, _)| value.is_finite()) && delta.is_none_or(|d| d > 0.0 && d.is_finite())
            }
            Statement::Held { found } => !found.is_empty() && found.iter().all(|(_, value, _)| value.is_finite()),
            Statement::Checks { all, failed } => *all > 0 && failed <= all,
            Statement::Published { all, refuted } => *all > 0 && refuted <= all,
        }
    }

    fn words(&self, language: Language) -> String {
        let number = |x: f64| report::number::short(x, DIGITS, language);
        match self {
            Statement::Unfinished { heading } => {
                let heading = language.text(heading);
                language.pick(format!("The study “{heading}” was not completed."), format!("Расчёт «{heading}» не завершён."))
            }
            Statement::Lowest { omega, .. } => {
                let pair = report::number::frequency_pair(*omega, DIGITS, language);
                language.pick(
                    format!("The lowest natural frequency that is not zero is {pair}."),
                    format!("Низшая отличная от нуля собственная частота {pair}."),
                )
            }
            Statement::Rest { stable } => rest(stable, language),
            Statement::Greatest { label, shown: (value, unit), t, .. } => {
                let label = lowered(language.text(label));
                let value = report::number::with_unit(&number(*value), unit);
                let t = number(*t);
                language.pick(
                    format!("The largest magnitude of “{label}” is {value}, at t = {t} s."),
                    format!("Наибольшее по модулю значение величины «{label}» равно {value} при t = {t} с."),
                )
            }
            Statement::Regime { period, stable } => {
                let period = number(*period);
                match stable {
                    true => language.pick(
                        format!("The periodic regime with the period {period} s is stable."),
                        format!("Периодический режим с периодом {period} с устойчив."),
                    ),
                    false => language.pick(
                        format!("The periodic regime with the period {period} s is unstable."),
                        format!("Периодический режим с периодом {period} с неустойчив."),
                    ),
                }
            }
            Statement::Irregular { delta } => {
                let delta = number(*delta);
                language
                    .pick(format!("The irregularity of running is {delta}."), format!("Коэффициент неравномерности хода равен {delta}."))
            }
            Statement::Needed { delta, found } => needed(*delta, found, language),
            Statement::Held { found } => {
                let list = listed(found, language);
                language.pick(format!("Reactions at rest: {list}."), format!("Реакции связей в покое: {list}."))
            }
            Statement::Published { all, refuted } => published(*all, *refuted, language),
            Statement::Checks { all, failed: 0 } => {
                language.pick(format!("All checks hold ({all})."), format!("Все проверки выполнены (всего {all})."))
            }
            Statement::Checks { all, failed } => language.pick(
                format!("Of {all} checks {failed} do not hold: the results are not to be used."),
                format!("Не выполнено проверок: {failed} из {all}; результатами пользоваться нельзя."),
            ),
        }
    }
}

/// `F_0 = 8999 N; ...`.
fn listed(found: &[(String, f64, String)], language: Language) -> String {
    let number = |x: f64| report::number::short(x, DIGITS, language);
    let one = |(name, value, unit): &(String, f64, String)| format!("{name} = {}", report::number::with_unit(&number(*value), unit));
    found.iter().map(one).collect::<Vec<_>>().join("; ")
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
fn of_study(work: &Work, results: &Results) -> Vec<Statement> {
    if results.trouble.is_some() {
        return vec![Statement::Unfinished { heading: results.heading.clone() }];
    }
    let column = |name: &str| results.data.column(name).map(|c| c.values.clone());
    let fact = |name: &str| results.facts.iter().find(|f| f.quantity.name == name).map(|f| f.value);
    match results.kind {
        "modes" => column("omega").and_then(|all| Some(Statement::Lowest { omega: lowest(&all)?, all })).into_iter().collect(),
        "equilibrium" => {
            let decided = |v: &f64| (!v.is_nan()).then_some(*v != 0.0);
            column("stable").map(|values| Statement::Rest { stable: values.iter().map(decided).collect() }).into_iter().collect()
        }
        "simulate" | "inverse" => greatest(work, results),
        "periodic" => {
            let stable = results.own.get("stable").and_then(serde_json::Value::as_bool);
            fact("period").zip(stable).map(|(period, stable)| Statement::Regime { period, stable }).into_iter().collect()
        }
        "cycle" => of_cycle(work, results),
        "statics" => {
            let unique = results.facts.iter().filter(|f| f.value.is_finite() && !f.quantity.name.contains(' '));
            vec![Statement::Held { found: unique.take(HELD).map(|f| shown(work, f)).collect() }]
        }
        "claims" => {
            let verdicts = results.own.get("claims").and_then(serde_json::Value::as_array).map(Vec::as_slice).unwrap_or_default();
            let refuted = verdicts.iter().filter(|v| v.get("ok").and_then(serde_json::Value::as_bool) != Some(true)).count();
            vec![Statement::Published { all: verdicts.len(), refuted }]
        }
        _ => Vec::new(),
    }
}

/// Symbol, value and unit of a fact.
fn shown(work: &Work, fact: &crate::results::Fact) -> (String, f64, String) {
    let scale = crate::results::tables::scale(&fact.quantity, fact.value.abs());
    (report::symbol::plain(&fact.quantity.symbol, work.language), fact.value / scale.size, scale.print(work.language))
}

/// What was found of a cycle. A wanted irregularity is no result of the machine of the file, whose flywheel is another one.
fn of_cycle(work: &Work, results: &Results) -> Vec<Statement> {
    let study = work.model.studies.iter().find(|s| s.kind == "cycle");
    let wanted = study.and_then(|s| s.number("irregularity"));
    let sought = ["unknown", "flywheel"].map(|key| study.and_then(|s| s.word(key)));
    let fact = |name: &str| results.facts.iter().find(|f| f.quantity.name == name);
    let found: Vec<_> = sought.into_iter().flatten().filter_map(fact).map(|f| shown(work, f)).collect();
    let needed = (!found.is_empty()).then_some(Statement::Needed { delta: wanted, found });
    let own = fact("irregularity").filter(|_| wanted.is_none()).map(|f| Statement::Irregular { delta: f.value });
    needed.into_iter().chain(own).collect()
}

/// The least positive value.
fn lowest(values: &[f64]) -> Option<f64> {
    values.iter().copied().filter(|w| w.is_finite() && *w > 0.0).reduce(f64::min)
}

/// The greatest sizes of the first named quantities.
fn greatest(work: &Work, results: &Results) -> Vec<Statement> {
    let named = |name: &str| work.equations.outputs.iter().any(|o| o.name == name && o.role == Role::Named);
    // what is plotted is what was asked for
    let plotted: Vec<&str> = results.plots.iter().flat_map(|plot| plot.y.iter().map(String::as_str)).collect();
    let name = |e: &analysis::dataset::Extreme| results.data.columns[e.column].quantity.name.as_str();
    let mut extremes: Vec<_> = results.data.extremes.iter().filter(|e| named(name(e))).collect();
    extremes.sort_by_key(|e| plotted.iter().position(|p| *p == name(e)).unwrap_or(usize::MAX));
    let one = |e: &analysis::dataset::Extreme| {
        let column = &results.data.columns[e.column];
        let (value, t) = if e.max.abs() >= e.min.abs() { (e.max, e.t_max) } else { (e.min, e.t_min) };
        let scale = crate::results::tables::scale(&column.quantity, value.abs());
        let label = column.quantity.label.clone();
        let shown = (value / scale.size, scale.print(work.language));
        let beside = column.values.iter().chain([&e.min, &e.max]).copied().collect();
        (!label.en.is_empty()).then_some(Statement::Greatest { label, shown, t, beside, value })
    };
    extremes.into_iter().filter_map(one).take(MOST).collect()
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
                Statement::Lowest { omega: value, all: all.clone() },
                Statement::Greatest { label: words::Text::same("x"), shown: (value, String::new()), t, beside: all.clone(), value },
                Statement::Regime { period: value, stable: t > 0.0 },
                Statement::Irregular { delta: value },
                Statement::Needed { delta: Some(t), found: vec![("J".into(), value, "kg".into())] },
                Statement::Needed { delta: None, found: all.iter().map(|v| ("x".to_owned(), *v, String::new())).collect() },
                Statement::Rest { stable: decided.clone() },
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
                    Statement::Lowest { omega, all } => assert!(!all.iter().any(|w| *w > 0.0 && *w < *omega), "{statement:?}"),
                    Statement::Greatest { value, beside, .. } => {
                        assert!(!beside.iter().any(|v| v.abs() > value.abs() * (1.0 + 2.0 * ROUNDING)), "{statement:?}");
                    }
                    Statement::Regime { stable, .. } => assert_eq!(words.contains("unstable"), !stable),
                    Statement::Rest { stable } => {
                        let has = |word: &str| words.split(|c: char| !c.is_alphabetic()).any(|w| w == word);
                        assert_eq!(has("stable"), stable.contains(&Some(true)), "{words}");
                        assert_eq!(has("unstable"), stable.contains(&Some(false)), "{words}");
                    }
                    Statement::Needed { delta, found } => {
                        assert!(found.iter().all(|(_, v, _)| v.is_finite()) && !words.contains('–'), "{words}");
                        assert_eq!(words.contains("wanted"), delta.is_some(), "{words}");
                        assert!(delta.is_none_or(|d| d > 0.0), "{statement:?}");
                    }
                    _ => assert!(value >= 0.0),
                }
            }
        }
        assert!(said > 1000 && silent > 1000, "{said} {silent}");
    }

    #[test]
    fn failed_checks_are_never_called_held() {
        for (all, failed) in (0..9).flat_map(|all| (0..=all + 1).map(move |failed| (all, failed))) {
            let published = Statement::Published { all, refuted: failed };
            assert_eq!(published.holds(), all > 0 && failed <= all);
            if published.holds() {
                assert_eq!(published.words(Language::En).contains("not confirmed"), failed > 0);
                assert_eq!(published.words(Language::Ru).contains("Не подтверждено"), failed > 0);
            }
            let statement = Statement::Checks { all, failed };
            assert_eq!(statement.holds(), all > 0 && failed <= all);
            if statement.holds() {
                assert_eq!(statement.words(Language::Ru).starts_with("Все"), failed == 0);
            }
        }
    }
}
