//! The place in which a machine is drawn: at a time of its motion, at rest.

use super::numbers::{Instant, STILL};
use crate::equilibrium;
use crate::machine::Machine;
use crate::shown::{Role, role};
use crate::simulate::{self, Simulate, TOLERANCE};
use crate::watch::Watch;
use analysis::Dataset;
use mechanics::model::Times;
use words::Notice;

/// The machine at a time of its motion.
///
/// # Errors
/// The motion ends before (C057), or cannot be computed.
pub fn at_time(machine: &mut Machine, time: f64, watch: &mut Watch) -> Result<Instant, Notice> {
    let start = Instant::start(machine);
    if time == 0.0 {
        return Ok(start);
    }
    let study = Simulate {
        until: time,
        times: Times::At(vec![time]),
        tolerance: TOLERANCE,
        method: analysis::integrate::stiff::Method::default(),
        outputs: machine.system_states(),
        plots: Vec::new(),
        windows: Vec::new(),
    };
    let results = simulate::motion(machine, &study, watch);
    let rows = results.data.columns.first().map_or(0, |c| c.values.len());
    let reached = results.data.axis.and_then(|i| results.data.columns.get(i)).and_then(|c| c.values.last()).copied();
    if rows == 0 || reached.is_none_or(|t| (t - time).abs() > STILL * time) {
        return Err(results.trouble.unwrap_or_else(|| unreached(time, reached.unwrap_or(0.0))));
    }
    Ok(Instant { t: time, ..row(machine, &results.data, (rows - 1, &start)) })
}

/// The machine at rest: the equilibrium nearest to the start.
///
/// # Errors
/// There is none.
pub fn at_rest(machine: &mut Machine, watch: &mut Watch) -> Result<Instant, Notice> {
    let start = Instant::start(machine);
    let results = equilibrium::places(machine, &[], None, watch);
    if results.data.columns.first().is_none_or(|c| c.values.is_empty()) {
        return Err(results.trouble.unwrap_or_else(|| unreached(f64::NAN, 0.0)));
    }
    let mut found = row(machine, &results.data, (0, &start));
    found.rates = vec![0.0; found.rates.len()];
    Ok(found)
}

/// Coordinates, rates and turn angles of a row; what has no column stays as it was.
fn row(machine: &Machine, data: &Dataset, (row, start): (usize, &Instant)) -> Instant {
    let value =
        |name: &str, known: f64| data.column(name).and_then(|c| c.values.get(row)).copied().filter(|v| v.is_finite()).unwrap_or(known);
    let names = machine.model.coordinates.iter().map(|c| c.name.as_str());
    let turned = machine
        .equations
        .auxiliaries
        .iter()
        .zip(&start.turned)
        .map(|(a, known)| value(&machine.equations.graph.symbol_info(a.symbol).name, *known));
    Instant {
        q: names.clone().zip(&start.q).map(|(name, known)| value(name, *known)).collect(),
        rates: names.zip(&start.rates).map(|(name, known)| value(&format!("{name}'"), *known)).collect(),
        turned: turned.collect(),
        t: start.t,
    }
}

fn unreached(time: f64, reached: f64) -> Notice {
    let (asked, there) = (words::digits::quantity(time, "s"), words::digits::quantity(reached, "s"));
    Notice::new("C057", format!("the motion does not reach {}", asked.en), format!("движение не доходит до {}", asked.ru))
        .why(format!("it ends at {}", there.en), format!("оно заканчивается при {}", there.ru))
        .help("take an earlier time, or --at rest", "возьмите более раннее время или --at rest")
}

/// A closed mechanism that begins stretched, with its first given angle moved to where the figure is clear.
pub(crate) fn bent(machine: &Machine) -> Option<Instant> {
    let closed = machine.model.connections.iter().any(|c| matches!(role(c.table), Role::Joint | Role::Slot));
    let angle = machine.model.coordinates.iter().position(|c| c.given[0] && c.units[0] == "rad").filter(|_| closed)?;
    let start = Instant::start(machine);
    let turned = machine.with_values(&[(&machine.model.coordinates[angle].name, start.q[angle] + 0.8)]).ok()?;
    turned.system.start().ok()?;
    Some(Instant::start(&turned))
}
