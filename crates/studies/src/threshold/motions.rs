//! The two motions beside a change, side by side.

use super::follow::Follow;
use crate::Finds;
use crate::simulate::Simulate;
use analysis::Dataset;
use analysis::dataset::Column;
use analysis::studies::threshold::Side;
use mechanics::model::{Plot, Times};
use words::{Notice, Text};

/// Names of the two columns.
const NAMES: [&str; 2] = ["motion_below", "motion_above"];

/// Puts both into the data and plots them; nothing where the repeated study is no motion or no quantity is followed.
pub(super) fn beside(follow: &mut Follow<'_, '_>, (sides, value): ([Side; 2], &Text), data: &mut Dataset) -> Result<Vec<Plot>, Notice> {
    let base = follow.repeated.base.clone();
    let Some(of) = follow.of().map(str::to_owned) else { return Ok(Vec::new()) };
    if follow.at.machine.origin.studies.finds(base.kind) != Finds::Motion {
        return Ok(Vec::new());
    }
    let plain =
        Simulate { outputs: vec![of.clone()], times: Times::Automatic, plots: Vec::new(), windows: Vec::new(), ..Simulate::of(&base) };
    let mut runs = both(follow, sides, &plain)?;
    // both have the rows that the quicker one needs
    if let Some(finer) = runs.iter().filter_map(|run| plain.finer(run)).max_by_key(rows) {
        runs = both(follow, sides, &finer)?;
    }
    data.columns.extend(runs.first().and_then(|run| run.columns.first()).cloned());
    data.axis = Some(0);
    for (run, (name, mark)) in runs.iter().zip(NAMES.iter().zip([1, 2])) {
        let Some(column) = run.column(&of) else { continue };
        let mut quantity = column.quantity.clone();
        quantity.symbol = format!("{}_{mark}", quantity.symbol);
        quantity.label = follow.side(value, mark - 1);
        quantity.name = (*name).into();
        data.columns.push(Column { quantity, values: column.values.clone() });
    }
    Ok(vec![Plot { title: Text::default(), x: None, y: NAMES.iter().map(|name| (*name).to_owned()).collect() }])
}

fn both(follow: &mut Follow<'_, '_>, sides: [Side; 2], study: &Simulate) -> Result<Vec<Dataset>, Notice> {
    sides.iter().map(|side| follow.shown(side.place, study)).collect()
}

fn rows(study: &Simulate) -> u64 {
    if let Times::Every(step) = study.times { (study.until / step) as u64 } else { 0 }
}
