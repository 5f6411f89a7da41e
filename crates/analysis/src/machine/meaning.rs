//! What the tapes of a machine mean: its guards, states, outputs and refusals, in the words of the equations.

use program::{Bound, Evaluator, Operation, Program, Tape, passes};
use std::sync::Arc;
use symbolic::Equations;
use symbolic::connections::{Law, Reaction};
use words::Text;

use crate::connections::Undetermined;
use crate::naming::notation;
use crate::system::Layout;
use crate::{Fault, GuardKind, Mode, Quantity};

pub(super) fn kind(equations: &Equations, program: &Program, guard: usize) -> GuardKind {
    use program::Construct as Kind;
    match program.guards[guard].kind {
        Kind::Sliding { limits, .. } => GuardKind::Friction { limits, pressed: pressing(equations, program, guard) },
        Kind::Normal { reaction } => {
            let of = program.switches.get(reaction).copied().flatten().unwrap_or(guard);
            GuardKind::Normal { of, single: is_single(equations, reaction) }
        }
        Kind::Share { of, .. } => GuardKind::Share { of },
        Kind::Side { of, .. } => GuardKind::Side { of },
        Kind::Limit { of, exit, .. } => GuardKind::Bound { of, exit },
        Kind::Gap { force, .. } => GuardKind::Contact { force },
        Kind::ContactForce { of, .. } => GuardKind::Bound { of, exit: Mode::Positive },
        _ => GuardKind::Switch,
    }
}

/// Whether a friction is pressed along one direction, and not by itself.
fn is_single(equations: &Equations, reaction: usize) -> bool {
    let Law::Friction(friction) = &equations.reactions[reaction].law else { return false };
    let own = |normal: &symbolic::connections::Normal| normal.terms.iter().any(|(k, _)| *k == reaction);
    friction.across.is_none() && !friction.normal.as_ref().is_some_and(own)
}

/// The contacts that alone press the frictions of a guard; none where something else presses one of them.
fn pressing(equations: &Equations, program: &Program, guard: usize) -> Vec<usize> {
    let mut contacts = Vec::new();
    let own = (0..equations.reactions.len()).filter(|r| program.switches.get(*r) == Some(&Some(guard)));
    for reaction in own {
        let Law::Friction(friction) = &equations.reactions[reaction].law else { continue };
        let Some(normal) = &friction.normal else { return Vec::new() };
        if !equations.graph.is_zero(normal.constant) || friction.across.is_some() {
            return Vec::new();
        }
        // a rope presses its friction on a drum, and so does the friction itself
        for (k, _) in normal.terms.iter().filter(|(k, _)| *k != reaction) {
            match (&equations.reactions[*k].law, program.switches.get(*k)) {
                (Law::Contact { .. }, Some(Some(gap))) => contacts.push(*gap),
                _ => return Vec::new(),
            }
        }
    }
    contacts
}

/// The guard of each reaction that is a dry friction.
pub(super) fn rubbing(equations: &Equations, program: &Program) -> Vec<Option<usize>> {
    let frictions = equations.reactions.iter().enumerate().filter(|(_, r)| matches!(r.law, Law::Friction(_)));
    frictions.map(|(i, _)| program.switches.get(i).copied().flatten()).collect()
}

pub(super) fn is_tie(equations: &Equations, kind: &program::Construct) -> bool {
    let program::Construct::Gap { reaction, .. } = kind else { return false };
    matches!(equations.reactions[*reaction].law, Law::Contact { tie: true, .. })
}

/// The released bodies without what acts on them.
pub(super) fn placements(equations: &Equations, general: &Bound) -> Result<Evaluator, Fault> {
    let bodies: Vec<usize> = (0..Layout::BODY * equations.released.bodies.len()).collect();
    let tape = passes::specialise(&Arc::new(passes::select(&general.program().released, &bodies)), general.parameters())?;
    Ok(general.evaluator(&Arc::new(tape))?)
}

/// The impulse of a reaction.
pub(super) fn impulse(reaction: &Reaction) -> Quantity {
    Quantity { label: reaction.label.clone(), ..Quantity::new(&reaction.name, &format!("{} s", reaction.unit)) }
}

pub(super) fn layout(equations: &Equations) -> Layout {
    let released = &equations.released;
    let frames = released.frames.iter().map(|f| (f.bodies.clone(), f.ways.len())).collect();
    Layout {
        bodies: released.bodies.len(),
        frames,
        wrenches: released.wrenches.len(),
        along: released.along.len(),
        leaning: leaning(equations),
    }
}

/// Hidden reactions with a contact or a friction in one of their balances.
fn leaning(equations: &Equations) -> Vec<String> {
    let one_sided = |law: &Law| matches!(law, Law::Contact { .. } | Law::Friction(_));
    let touches = |row: usize| equations.reactions.iter().any(|r| one_sided(&r.law) && r.released.iter().any(|(i, _)| *i == row));
    let hidden = equations.reactions.iter().filter(|r| matches!(r.law, Law::Support));
    hidden.filter(|r| r.released.iter().any(|(row, _)| touches(*row))).map(|r| r.name.clone()).collect()
}

/// Why an output has no value.
#[derive(Clone, Debug)]
pub(super) struct Refusal {
    pub(super) reaction: String,
    /// The load whose place is missing, or the coordinate whose transmission is; none where connections share a load.
    pub(super) open: Option<Reaction>,
}

/// For each output the first reaction in it that has no unique value.
pub(super) fn refused(equations: &Equations, program: &Program, undetermined: &Undetermined) -> Vec<Option<Refusal>> {
    let unknown = |r: &usize| undetermined.open.contains(r) || !program.known.contains(r);
    let unknown: Vec<usize> = (0..program.reactions).filter(unknown).collect();
    let mut touched: Vec<Option<Refusal>> = vec![None; equations.outputs.len()];
    for r in unknown {
        let reaction = &equations.reactions[r];
        let mut symbols = vec![reaction.symbol];
        for definition in &equations.definitions {
            if equations.graph.contains(definition.formula, |s| symbols.contains(&s)) {
                symbols.push(definition.symbol);
            }
        }
        for (slot, output) in touched.iter_mut().zip(&equations.outputs) {
            if slot.is_none() && equations.graph.contains(output.formula, |s| symbols.contains(&s)) {
                let open = undetermined.placed.iter().find(|(p, _)| *p == r);
                let open = open.map(|(_, open)| equations.reactions[*open].clone());
                *slot = Some(Refusal { reaction: reaction.name.clone(), open });
            }
        }
    }
    touched
}

pub(super) fn reads_accelerations(tape: &Tape) -> bool {
    tape.body.iter().any(|i| matches!(i.operation, Operation::Acceleration(_)))
}

/// Names as the program has them; units and labels from the equations.
pub(super) fn states(equations: &Equations, program: &Program) -> Vec<Quantity> {
    let rate = |unit: &str| if unit == "1" { "1/s".to_owned() } else { format!("{unit}/s") };
    let coordinates = equations.coordinates.iter();
    let described = coordinates
        .clone()
        .map(|c| (c.unit.clone(), c.label.clone()))
        .chain(coordinates.map(|c| (rate(&c.unit), Text::default())))
        .chain(equations.auxiliaries.iter().map(|a| (a.unit.clone(), a.label.clone())));
    let quantity = |(name, (unit, label)): (&String, (String, Text))| Quantity {
        label,
        symbol: notation(equations, name),
        ..Quantity::new(name, &unit)
    };
    program.states.iter().zip(described).map(quantity).collect()
}

pub(super) fn outputs(equations: &Equations) -> Vec<Quantity> {
    let quantity = |o: &symbolic::equations::Output| {
        let info = equations.graph.symbol_info(o.symbol);
        let symbol = notation(equations, &format!("{}{}", info.name, "'".repeat(usize::from(info.primes))));
        Quantity { name: o.name.clone(), symbol, unit: o.unit.clone(), label: o.label.clone(), display: o.display.clone() }
    };
    equations.outputs.iter().map(quantity).collect()
}
