//! Lyapunov's exponents of the motion from the start of the file.

use crate::machine::{Machine, explained};
use crate::provenance;
use crate::results::{Fact, Results, Rows};
use crate::watch::Watch;
use analysis::dataset::{Audit, Column};
use analysis::studies::periodic::{Listener, Stage};
use analysis::studies::stability::{Fate, Lyapunov, Options};
use analysis::{Dataset, Quantity};
use mechanics::asked::Asked;
use mechanics::model::Plot;
use serde_json::json;
use std::cell::RefCell;
use words::{Notice, Text};

/// Liouville's formula in a piece of the motion: determinant and divergence are integrated apart from one another to nine digits.
const LIOUVILLE: f64 = 1e-8;

/// Which motion; SI.
#[derive(Clone, Debug)]
pub(super) struct Long {
    settle: f64,
    duration: f64,
    tolerance: f64,
}

impl Long {
    /// None where exponents are not asked for.
    pub(super) fn of(asked: &Asked) -> Option<Long> {
        let duration = asked.number("lyapunov")?;
        let tolerance = asked.number("tolerance").unwrap_or(crate::simulate::TOLERANCE);
        Some(Long { settle: asked.number("settle").unwrap_or(0.0), duration, tolerance })
    }
}

/// Fills in the results.
pub(super) fn long(machine: &mut Machine, study: &Long, results: &mut Results, watch: &mut Watch) -> Result<(), Notice> {
    let start = machine.system.start().map_err(|fault| explained(fault, &machine.equations))?;
    let interrupt = watch.interrupt;
    let progress = RefCell::new(watch.progress.as_mut());
    let told = |stage: Stage| {
        if let (Stage::Settling(t, of), Some(progress)) = (stage, &mut *progress.borrow_mut()) {
            progress(t / of);
        }
    };
    let listener = Listener { interrupt, told: Some(&told) };
    let options = Options { settle: study.settle, duration: study.duration, tolerance: study.tolerance, listener };
    let found = (analysis::made::LYAPUNOV)(&mut machine.system, &start, &options);
    let (found, states) = found.map_err(|fault| explained(fault, &machine.equations))?;
    results.data = provenance::stamp(dataset(&found), &machine.equations, &machine.model_hash);
    results.rows = Rows::Hidden;
    results.data.partial = found.partial;
    if !found.history.is_empty() {
        results.plots = vec![Plot { title: Text::default(), x: None, y: vec!["exponent".into()] }];
    }
    tell(results, &found, states);
    Ok(())
}

fn dataset(found: &Lyapunov) -> Dataset {
    let column = |name: &str, (symbol, unit): (&str, &str), label: Text, place: usize| Column {
        quantity: Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) },
        values: found.history.iter().map(|row| row[place]).collect(),
    };
    let label = Text::new("mean growth of a disturbance up to then", "средний показатель роста возмущения к этому моменту");
    let columns = vec![column("t", ("t", "s"), Text::new("time", "время"), 0), column("exponent", ("lambda_1", "1/s"), label, 1)];
    let name = Text::new(
        "Liouville's formula: determinant of the variations against the divergence, in a piece of the motion",
        "формула Лиувилля: определитель решений в вариациях против дивергенции на отрезке движения",
    );
    let audits = vec![Audit::at_most("liouville", name, found.liouville, LIOUVILLE)];
    Dataset { axis: Some(0), columns, audits, ..Dataset::default() }
}

fn tell(results: &mut Results, found: &Lyapunov, states: usize) {
    for (k, rate) in found.exponents.iter().enumerate() {
        let error = report::number::short(rate.error, 2, words::Language::En);
        let label = Text::new(format!("Lyapunov exponent {}", k + 1), format!("показатель Ляпунова {}", k + 1));
        let words = Text::new(format!("± {error}"), format!("± {}", error.replace('.', ",")));
        let fact = Fact::new(&format!("lambda_{}", k + 1), &format!("lambda_{}", k + 1), "1/s", rate.value, label);
        results.facts.push(fact.with_words(words));
    }
    let fate = found.fate();
    let dimension = found.dimension(states);
    if let Some(dimension) = dimension {
        let label = Text::new("dimension of Kaplan and Yorke", "размерность по Каплану — Йорке");
        results.facts.push(Fact::new("dimension", "D", "1", dimension, label));
    }
    results.words.push(match fate {
        Fate::Grow => Text::new(
            "Small disturbances grow like exp(λ₁t) on average: the motion depends sensitively on its start; where it stays bounded it is chaotic.",
            "Малые возмущения в среднем растут как exp(λ₁t): движение чувствительно к начальным условиям; если оно ограничено, оно хаотическое.",
        ),
        Fate::Die => Text::new("Small disturbances die out.", "Малые возмущения затухают."),
        Fate::Neither => Text::new(
            "Within its error the largest exponent is 0: in this time disturbances neither grow like an exponential nor die out.",
            "В пределах погрешности наибольший показатель равен 0: за это время возмущения не растут экспоненциально и не затухают.",
        ),
    });
    if let Some(t) = found.opened {
        let t = words::digits::rounded(t);
        results.words.push(Text::new(
            format!(
                "A contact that was closed, or a friction that stuck, took a direction away while the exponents were counted, and gave it back at t = {} s: nothing is known of it. Give a later `settle`.",
                t.en
            ),
            format!(
                "Закрытый контакт или трение покоя уничтожили одно из направлений во время счёта показателей, а при t = {} с оно появилось снова: о нём ничего не известно. Увеличьте `settle`.",
                t.ru
            ),
        ));
    }
    if found.exponents.len() < states {
        results.words.push(Text::new(
            format!("{} of {states} exponents are known: a switch takes a direction away, or it dies too quickly to be followed.", found.exponents.len()),
            format!(
                "Известны показатели: {} из {states}; переключение уничтожает направление, либо возмущение по нему затухает слишком быстро.",
                found.exponents.len()
            ),
        ));
    }
    let exponents: Vec<_> = found.exponents.iter().map(|rate| json!({"value": rate.value, "error": rate.error})).collect();
    results.own.insert("lyapunov".into(), json!({"exponents": exponents, "counted": found.counted, "dimension": dimension}));
    results.own.insert("verdict".into(), json!(fate.key()));
}
