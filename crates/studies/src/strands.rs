//! Strands of belts and chains at rest: they only pull.

use crate::machine::Machine;
use analysis::Fault;
use analysis::fault::connections::Since;
use mechanics::derive::strand_output;
use symbolic::SymbolId;

/// Share of the force below which a tension of the wrong sign is rounding.
pub(crate) const ROUNDING: f64 = 1e-9;

/// The same relative to the largest reaction of the machine, and in newtons.
const NOISE: f64 = 1e-13;
// newtons: no machine has such a force, and none is divided by it
const NOUGHT: f64 = 1e-30;

/// A strand that would have to push, when the reactions have these values, one for each place of rest.
pub fn pushing(machine: &Machine, values: impl Fn(&str) -> Vec<f64>) -> Option<Fault> {
    let equations = &machine.equations;
    let number = |s: SymbolId| {
        let own = equations.parameters.iter().find(|p| p.symbol == s).map(|p| p.value);
        own.or_else(|| machine.model.parameters.iter().find(|p| p.symbol == s).and_then(|p| p.number))
    };
    let all = equations.reactions.iter().flat_map(|r| values(&r.name));
    let nothing = all.fold(0.0_f64, |m, v| m.max(v.abs())).mul_add(NOISE, NOUGHT);
    for connection in &machine.model.connections {
        let reaction = format!("force({})", connection.name);
        let Some(force) = equations.reactions.iter().find(|r| r.name == reaction) else { continue };
        let strands = (0..2).filter_map(|k| equations.outputs.iter().find(|o| o.name == strand_output(&connection.name, k)));
        for output in strands {
            let tension = |value: f64| {
                let of = |s: SymbolId| if s == force.symbol { value } else { number(s).unwrap_or(f64::NAN) };
                equations.graph.evaluate(&[output.formula], &of)[0]
            };
            if values(&reaction).into_iter().any(|value| tension(value) < -(ROUNDING * value.abs()).max(nothing)) {
                return Some(Fault::strand_pushes(&output.label, Since::Rest));
            }
        }
    }
    None
}
