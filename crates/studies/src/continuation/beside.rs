//! The backbone curve over a frequency response: the free oscillations of the machine without its losses and loads, at the frequencies over which the response is followed.
//!
//! ```text
//! T λ / n = c     the parameter λ is the frequency of the load, n periods of which a motion lasts: c = 2π in rad/s, 1 in Hz
//! λ = c ω / 2π    of a free oscillation of frequency ω
//! ```

use super::asked::{Branched, POINTS_FREE, Wanted};
use crate::failure::in_words;
use crate::machine::{Machine, explained as in_symbols};
use crate::results::{Fact, Results};
use crate::watch::Watch;
use analysis::dataset::Column;
use analysis::studies::continuation::{Diagram, Of, Options, backbone};
use analysis::{Dataset, Quantity};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use words::{Notice, Text};

/// Share to which T λ is the same at all points: periods are formulas of the parameter, and their rounding is far below.
const SAME: f64 = 1e-9;

/// A backbone curve over the parameter of a response.
#[derive(Clone, Debug)]
pub(super) struct Spine {
    mode: usize,
    /// The value at which oscillations are small.
    small: f64,
    pub(super) points: Vec<Free>,
}

/// A free oscillation.
#[derive(Clone, Debug)]
pub(super) struct Free {
    /// Value of the parameter.
    pub(super) parameter: f64,
    /// Least and greatest values of the coordinates.
    pub(super) extremes: Vec<[f64; 2]>,
    energy: f64,
}

/// The curve beside the branches that were found.
///
/// # Errors
/// S170 where the parameter is no frequency of the load; what a backbone curve objects to.
pub(super) fn spine(machine: &Machine, (study, wanted): (&Branched, &Wanted), diagram: &Diagram, watch: &Watch) -> Result<Spine, Notice> {
    let turn = turn(diagram).ok_or_else(|| no_frequency(&study.name))?;
    let values: Vec<(&str, f64)> = wanted.values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let mut free = machine.with_values(&values).map_err(in_words)?;
    let range = [study.from, study.to].map(|end| TAU / turn * end);
    let options = Options {
        from: range[0],
        to: range[1],
        start: range[0],
        points: study.points.min(POINTS_FREE),
        branches: 1,
        second: None,
        interrupt: watch.interrupt,
    };
    let found = free.system.start().and_then(|start| backbone(&mut free.system, &start, (wanted.mode, Some(range)), &options));
    let found = found.map_err(|fault| in_symbols(fault, &free.equations))?;
    let points = found.diagram.curves.iter().take(1).flat_map(|curve| &curve.places).map(|place| {
        let facts = place.facts();
        Free { parameter: turn / TAU * place.parameter(), extremes: facts.extremes.clone(), energy: facts.energy.unwrap_or(f64::NAN) }
    });
    Ok(Spine { mode: wanted.mode, small: turn / TAU * found.small, points: points.collect() })
}

/// T λ / n, where it is the same at all points; none where the parameter is no frequency of a load.
fn turn(diagram: &Diagram) -> Option<f64> {
    let mut known: Option<f64> = None;
    for curve in &diagram.curves {
        let Of::Orbits(periods) = curve.of else { return None };
        for place in &curve.places {
            let own = place.facts().period * place.parameter() / periods as f64;
            let same = known.is_none_or(|turn| (own - turn).abs() <= SAME * turn);
            // no period of a load gives infinity, no motion nothing
            if !own.is_finite() || own <= 0.0 || !same {
                return None;
            }
            known = Some(known.unwrap_or(own));
        }
    }
    known
}

/// S170.
fn no_frequency(name: &str) -> Notice {
    Notice::new(
        "S170",
        format!("`{name}` is not the frequency of a load"),
        format!("`{name}` — не частота нагрузки"),
    )
    .why(
        "a backbone curve is drawn over the frequency at which the machine is driven, and the period of these motions times the parameter is not the same at all of them",
        "скелетная кривая строится по частоте нагрузки, а произведение периода этих движений на параметр не постоянно",
    )
    .help(
        "follow the motions over the frequency w with period = \"2*pi/w\", or leave `backbone` out",
        "прослеживайте движения вдоль частоты w с period = \"2*pi/w\" или уберите `backbone`",
    )
}

impl Spine {
    /// As a fact, a table and in JSON.
    pub(super) fn tell(&self, (parameter, coordinates): (&Quantity, &[Quantity]), results: &mut Results) {
        let label = Text::new(
            format!("backbone curve of mode {}: small free oscillations", self.mode),
            format!("скелетная кривая формы {}: малые свободные колебания", self.mode),
        );
        results.facts.push(Fact::new("small", &parameter.symbol, &parameter.unit, self.small, label));
        let mut columns = vec![Column { quantity: parameter.clone(), values: self.points.iter().map(|p| p.parameter).collect() }];
        let label = Text::new("energy above that at rest", "энергия сверх энергии покоя");
        let energy = Quantity { symbol: "E".into(), label, ..Quantity::new("energy", "J") };
        columns.push(Column { quantity: energy, values: self.points.iter().map(|p| p.energy).collect() });
        for (i, q) in coordinates.iter().enumerate() {
            for (end, word, label) in [
                (1, "max", Text::new("greatest value", "наибольшее значение")),
                (0, "min", Text::new("least value", "наименьшее значение")),
            ] {
                let quantity =
                    Quantity { symbol: format!("{}_{word}", q.symbol), label, ..Quantity::new(&format!("{word}({})", q.name), &q.unit) };
                columns.push(Column { quantity, values: self.points.iter().map(|p| p.extremes[i][end]).collect() });
            }
        }
        results.beside.push(("backbone", Dataset { columns, ..Dataset::default() }));
        let row = |point: &Free| {
            let range: serde_json::Map<String, Value> =
                coordinates.iter().zip(&point.extremes).map(|(q, ends)| (q.name.clone(), json!(ends))).collect();
            json!({"parameter": point.parameter, "energy": point.energy, "range": range})
        };
        let points: Vec<Value> = self.points.iter().map(row).collect();
        results.own.insert("backbone".into(), json!({"mode": self.mode, "small": self.small, "last": points.last(), "points": points}));
    }
}
