//! Unknown parameters: the numbers for which the start is a place of rest.

use analysis::Fault;
use analysis::linear::{LinearMachine, Place};
use analysis::rest::mean::Resting;
use std::sync::Arc;
use symbolic::SymbolId;
use symbolic::linear::About;
use words::{Message, Text};

/// Puts the unknowns of the model at the numbers for which the start is a place of rest.
///
/// # Errors
/// Statics do not give them.
pub fn solve(model: &mechanics::Model, equations: &mut symbolic::Equations) -> Result<(), Fault> {
    let index = |s: &SymbolId| equations.parameters.iter().position(|p| p.symbol == *s);
    let wanted: Vec<usize> = model.unknowns.iter().filter_map(index).collect();
    if wanted.is_empty() {
        return Ok(());
    }
    if !analysis::studies::rest::report::is_free(equations) || equations.coordinates.is_empty() {
        return solve_connected(model, equations, &wanted);
    }
    let mut machine = LinearMachine::new(&Arc::new(equations.clone()), About::Rest)?;
    let starts: Vec<symbolic::Expr> = equations.coordinates.iter().map(|c| c.start).collect();
    let q = machine.values_of(&starts, &Place::rest(&vec![0.0; starts.len()]))?;
    analysis::studies::unknowns::unknowns(&mut machine, &wanted, &q)?;
    for (parameter, value) in equations.parameters.iter_mut().zip(machine.numbers()) {
        // numbers of a frame follow from those that were sought
        parameter.value = *value;
    }
    for i in wanted {
        equations.parameters[i].written = format!("{}", equations.parameters[i].value);
    }
    Ok(())
}

/// The same with connections, contacts and friction.
fn solve_connected(model: &mechanics::Model, equations: &mut symbolic::Equations, wanted: &[usize]) -> Result<(), Fault> {
    if let Some(i) = wanted.iter().find(|i| equations.is_mounted_on(equations.parameters[**i].symbol)) {
        return Err(of_frame(&equations.graph.symbol_info(equations.parameters[*i].symbol).name));
    }
    let impending = impending(model, equations);
    let resting = Resting::new(equations)?;
    let found = analysis::rest::unknowns::unknowns(resting.equations(), wanted, &impending)?;
    for (i, value) in wanted.iter().zip(found.values) {
        equations.parameters[*i].value = value;
        equations.parameters[*i].written = format!("{value}");
    }
    Ok(())
}

/// S096: a number of the frame is sought beside connections.
fn of_frame(name: &str) -> Fault {
    Fault::new(Message {
        code: "S096",
        what: Text::new(
            format!("`{name}` of the frame cannot be found from statics here"),
            format!("величину `{name}` рамы здесь нельзя найти из условий равновесия"),
        ),
        why: Text::new(
            "beside connections, contacts or friction unknowns are sought through formulas, and the stiffness of a frame is no formula of its data",
            "при связях, контактах или трении неизвестные находят по формулам, а жёсткость рамы формулой её данных не выражается",
        ),
        help: Text::new(
            "give it a value in [parameters] and let `sweep` show how the place of rest depends on it",
            "задайте ей значение в [parameters] и посмотрите с помощью `sweep`, как от него зависит положение равновесия",
        ),
    })
}

/// The frictions of [impending], by reaction.
pub fn impending(model: &mechanics::Model, equations: &symbolic::Equations) -> Vec<(usize, f64)> {
    let friction = |(name, direction): &(String, f64)| Some((analysis::rest::unknowns::friction_named(equations, name)?, *direction));
    model.impending.iter().filter_map(friction).collect()
}
