//! What an ensemble of motions needs of a machine, where it can go in a lane.

use super::Machine;
use crate::Mode;
use program::ensemble::{Layout, Parts};
use words::Text;

/// A machine in a lane.
pub(crate) struct InLane {
    pub layout: Layout,
    pub numbers: Vec<f64>,
    /// Modes at the start.
    pub modes: Vec<Mode>,
    /// Instants at which formulas of time switch, with the modes behind them.
    pub switches: Vec<(f64, Vec<Mode>)>,
}

impl Machine {
    /// This machine for a lane, from its start to `until`.
    ///
    /// *Errors*: why it cannot go in one.
    pub(crate) fn in_lane(&mut self, start: &[f64], until: f64) -> Result<InLane, Text> {
        let program = self.bound.program();
        if program.conditions + program.contacts + program.frictions + program.solved.len() > 0 {
            return Err(because("connections, contacts or dry friction", "связи, контакты или сухое трение"));
        }
        if !self.places.tape().roots.is_empty() {
            return Err(because("formulas of places that have limits", "формулы положений с ограниченной областью"));
        }
        if self.guards.iter().any(|guard| guard.scheduled.is_none()) {
            return Err(because("switches that the motion itself decides", "переключения, зависящие от самого движения"));
        }
        let parts = Parts {
            dynamics: &program.dynamics,
            levels: self.flows.levels.tape(),
            supply: self.flows.supply.tape(),
            coordinates: program.coordinates,
        };
        let (layout, numbers) =
            Layout::of(&parts).map_err(|name| because(&format!("the operation `{name}`"), &format!("операция `{name}`")))?;
        let mut instants: Vec<f64> = self.guards.iter().filter_map(|guard| guard.scheduled).filter(|t| *t > 0.0 && *t < until).collect();
        instants.sort_by(f64::total_cmp);
        instants.dedup();
        let ends: Vec<f64> = instants.iter().copied().chain([until]).collect();
        let mut between = |from: f64, to: f64| {
            self.bound.modes(0.5 * (from + to), start).map_err(|_| because("a switch without a value", "переключение без значения"))
        };
        let modes = between(0.0, ends[0])?;
        let behind = |(k, t): (usize, &f64)| Ok((*t, between(*t, ends[k + 1])?));
        let switches = instants.iter().enumerate().map(behind).collect::<Result<_, _>>()?;
        Ok(InLane { layout, numbers, modes, switches })
    }
}

fn because(en: &str, ru: &str) -> Text {
    Text::new(en, ru)
}
