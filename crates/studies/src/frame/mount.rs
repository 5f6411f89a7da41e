//! The frame as part of the machine: its named displacements (and amplitudes of what they leave open) become generalised coordinates of the
//! model, with constant inertias, a potential energy uᵀ K u / 2 and the generalised forces of its loads. From there on Lagrange's equations, small
//! motions, responses and simulations know no difference between a frame and a body, and bodies stand on nodes by formulas of displacements.

use super::bind::{Bound, bind};
use super::groups::{groups, on_groups};
use analysis::studies::structure_modes::{self, Modes};
use mechanics::Model;
use mechanics::elements::{FORCES, Force, POTENTIALS, Potential, element};
use mechanics::model::{self, Class, ConstantInertia, CoordinateDecl, Element, OutputDecl, ParameterDecl, ParameterValue, Pathway};
use mechanics::structure as file;
use structures::equilibrium::{EXACT, stands_undivided};
use structures::loads::loading;
use structures::reduced::{Condensation, displacements, reduce};
use structures::substructure::{Substructure, Wish, substructure};
use structures::{Action, Assembly, Frame, Load, dense};
use symbolic::{Expr, Rational};
use words::{Notice, Text};

/// Share of the largest number beside it that is rounding: solutions of the frame carry thirteen digits and more.
const ROUNDING: f64 = 1e-13;

/// Entries of M and K as (i, j, number, exact).
type Entry = (usize, usize, f64, Option<Rational>);
/// Largest number of freedoms of a frame without named displacements that becomes part of the machine.
const NAMELESS: usize = 100;
/// Largest number of freedoms of a frame that becomes part of the machine.
const MOUNTED: usize = 20_000;
/// Amplitudes without another wish.
const AMPLITUDES: usize = 8;

/// The model with its frame as part of the machine, and remarks. Frames without inertia, or too large for dense matrices, stay outside.
///
/// # Errors
/// Mechanisms and loose nodes.
pub fn mounted(mut model: Model) -> Result<(Model, Vec<Notice>), Box<Notice>> {
    let remarks = match model.structure.clone() {
        Some(structure) => mount(&mut model, &structure)?,
        None => Vec::new(),
    };
    Ok((model, remarks))
}

fn mount(model: &mut Model, structure: &file::Structure) -> Result<Vec<Notice>, Box<Notice>> {
    let mut bound = bind(model, structure);
    let (found, remark) = coordinates(model, structure, &mut bound).map_err(|fault| Box::new(Notice::from(fault)))?;
    let warnings = remark.filter(|_| speaks(model)).map(|words| Notice::file("M306", 0..0, words).warning()).into_iter().collect();
    let first = model.coordinates.len() - structure.displacements.len().min(model.coordinates.len());
    let Some(found) = found else {
        model.coordinates.truncate(first);
        return Ok(warnings);
    };
    if let Some(structure) = &mut model.structure {
        structure.kept = found.kept;
    }
    let all = model.coordinates.split_off(first);
    let (kept, followers): (Vec<_>, Vec<_>) = all.into_iter().enumerate().partition(|(i, _)| found.named.contains(i));
    model.coordinates.extend(kept.into_iter().map(|c| c.1));
    for k in 0..found.amplitudes {
        amplitude(model, k + 1);
    }
    for (i, coordinate) in followers {
        follower(model, (&bound, &found), first, i, coordinate);
    }
    let (mass, stiffness) = entries(&bound, structure, &found);
    inertias(model, &mass, first);
    potential(model, &stiffness, first);
    loads(model, structure, &bound, &found, first);
    Ok(warnings)
}

/// Whether the coordinates of the frame are used by a study that says nothing about their division itself.
fn speaks(model: &Model) -> bool {
    let quiet = |asked: &mechanics::asked::Asked| matches!(asked.kind, "modes" | "statics");
    !is_bare(model) || model.studies.is_empty() || !model.studies.iter().all(quiet)
}

/// Whether the model is a frame and nothing else.
pub fn is_bare(model: &Model) -> bool {
    let bodies = model.frames.iter().any(|f| f.mass.is_some());
    let coupled = !model.connections.is_empty() || model.elements.iter().any(|e| e.law.couples());
    let own = |c: &CoordinateDecl| !is_of_frame(model, &c.name);
    model.structure.is_some() && !bodies && !coupled && !model.coordinates.iter().any(own)
}

fn is_of_frame(model: &Model, name: &str) -> bool {
    let named = model.structure.as_ref().is_some_and(|s| s.displacements.iter().any(|d| d.name == name));
    named || name.strip_prefix("eta_").is_some_and(|n| n.chars().all(|c| c.is_ascii_digit()))
}

fn condensation(structure: &file::Structure) -> Condensation {
    match structure.options.condense {
        None => Condensation::Automatic,
        Some(true) => Condensation::Turns,
        Some(false) => Condensation::Massless,
    }
}

/// The coordinates of the frame, divided as its wanted accuracy needs, and what a finer division says about a frame without such a wish.
fn coordinates(
    model: &Model,
    structure: &file::Structure,
    bound: &mut Bound,
) -> Result<(Option<Substructure>, Option<Text>), analysis::Fault> {
    stands_undivided(&bound.frame, bound.exact.as_ref())?;
    let assembly = Assembly::of(&bound.frame);
    // nobody can speak of the displacements of a large frame without their names
    let nameless = structure.displacements.is_empty() && assembly.n() > NAMELESS;
    if nameless || assembly.n() == 0 || assembly.n() > MOUNTED {
        return Ok((None, None));
    }
    let light = assembly.mass(&bound.frame).entries.iter().all(|e| e.2 == 0.0);
    if light && !structure.displacements.iter().any(|d| d.loaded) {
        return Ok((None, None));
    }
    let count = structure.options.modes.unwrap_or(AMPLITUDES);
    let options = Modes { count, condensation: condensation(structure), accuracy: structure.options.accuracy, ..Modes::default() };
    let wish = Wish { condensation: options.condensation, count, loads: changing(model, structure, bound) };
    if light || options.accuracy.is_none() {
        let found = substructure(&bound.frame, &assembly, &wish)?;
        let modes = structure_modes::modes_alone(&bound.frame, &options);
        return Ok((Some(found), modes.and_then(|modes| structure_modes::coarse(&bound.frame, &options, &modes))));
    }
    let refined = structure_modes::modes(&bound.frame, None, &options)?;
    let failed = |refinement: bool| refined.dataset.audits.iter().find(|a| !a.ok && (a.key == "refinement") == refinement);
    if let Some(audit) = failed(true).filter(|_| speaks(model)) {
        return Err(structures::faults::not_reached(audit.value, audit.limit).into());
    }
    if let Some(audit) = failed(false) {
        return Err(structures::faults::unconfirmed(audit.value, 0.0).into());
    }
    *bound = Bound { frame: refined.frame, exact: None };
    let found = substructure(&bound.frame, &refined.assembly, &wish)?;
    Ok((Some(found), None))
}

/// Unit loads in the places of loads that change with time.
fn changing(model: &Model, structure: &file::Structure, bound: &Bound) -> Vec<Load<f64>> {
    let loads = structure.loads.iter().zip(&bound.frame.loads).filter(|(load, _)| moves(model, load));
    let units = loads.flat_map(|(load, numbers)| components(load, numbers).into_iter().filter(|c| !model.graph.is_zero(c.0)));
    units.map(|(_, action)| Load { name: String::new(), action }).collect()
}

fn entries(bound: &Bound, structure: &file::Structure, found: &Substructure) -> (Vec<Entry>, Vec<Entry>) {
    let n = found.named.len() + found.amplitudes;
    let exact = bound
        .exact
        .as_ref()
        .filter(|e| found.condensed && found.n_q <= EXACT && found.amplitudes == 0 && n == e.displacements.len() && n <= 8);
    let exact = exact.and_then(|e| reduce(e, &Assembly::of(e), condensation(structure)).ok()).filter(|r| r.named);
    let group = groups([&found.mass, &found.stiffness], n);
    let list = |values: &[f64], exact: Option<&[Rational]>| -> Vec<Entry> {
        let largest: Vec<f64> = (0..n).map(|i| values[i * n + i].abs()).collect();
        let pairs = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
        let entry = |(i, j): (usize, usize)| (i, j, values[i * n + j], exact.map(|e| e[i * n + j].clone()));
        let matters = |e: &Entry| match &e.3 {
            Some(exact) => !exact.is_zero(),
            None => group[e.0] == group[e.1] && e.2.abs() > ROUNDING * (largest[e.0] * largest[e.1]).sqrt(),
        };
        pairs.map(entry).filter(matters).collect()
    };
    let (mass, stiffness) = (exact.as_ref().map(|e| &e.mass[..]), exact.as_ref().map(|e| &e.stiffness[..]));
    (list(&found.mass, mass), list(&found.stiffness, stiffness))
}

/// The coordinate η of a shape in which the named displacements rest.
fn amplitude(model: &mut Model, number: usize) {
    let name = format!("eta_{number}");
    let symbols = [0, 1, 2].map(|primes| model.graph.symbol_id(&name, primes));
    let zero = model.graph.zero();
    let label = Text::new(
        format!("amplitude {number} of the frame with its named displacements at rest"),
        format!("амплитуда {number} рамы при неподвижных именованных перемещениях"),
    );
    let units = ["m", "m/s", "m/s^2"].map(str::to_owned);
    model.coordinates.push(CoordinateDecl {
        name,
        symbols,
        units,
        start: zero,
        rate: zero,
        given: [true, true],
        guessed: [false, false],
        label,
        span: 0..0,
    });
}

/// A displacement that follows from the coordinates: a formula, and a result to look at.
fn follower(model: &mut Model, (bound, found): (&Bound, &Substructure), first: usize, i: usize, coordinate: CoordinateDecl) {
    let assembly = Assembly::of(&bound.frame);
    let n = found.named.len() + found.amplitudes;
    let row = displacements(&bound.frame, &assembly).swap_remove(i);
    let shares = dense::product(&row, &found.basis, 1, found.n_q, n);
    let largest = shares.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let mut terms = Vec::new();
    for (k, share) in shares.iter().enumerate().filter(|s| s.1.abs() > ROUNDING * largest) {
        let q = model.graph.symbol(model.coordinates[first + k].symbols[0]);
        if let Some(share) = simple(*share, largest) {
            terms.push(model.graph.scale(q, &share));
        }
    }
    let formula = model.graph.sum(&terms);
    let [unit, _, _] = coordinate.units;
    let (name, label, span) = (coordinate.name, coordinate.label, coordinate.span);
    let output = model.graph.symbol_id(&name, 0);
    model.parameters.push(ParameterDecl {
        name: name.clone(),
        symbol: coordinate.symbols[0],
        value: ParameterValue::Formula(formula),
        class: Class::State,
        number: None,
        unit: unit.clone(),
        written: String::new(),
        label: label.clone(),
        span: None,
    });
    model.outputs.push(OutputDecl { name, symbol: output, formula, unit, display: None, label, span });
}

/// A number of the frame as a parameter with a name that is free.
fn parameter(model: &mut Model, (letter, entry): (&str, &Entry), first: usize, label: Text) -> Expr {
    let (i, j, value, exact) = entry;
    let plain = format!("{letter}_{}{}", i + 1, j + 1);
    let taken = |name: &str| {
        model.parameters.iter().any(|p| p.name == name)
            || model.coordinates.iter().any(|c| c.name == name)
            || model.outputs.iter().any(|o| o.name == name)
    };
    let name = if taken(&plain) { format!("{letter}_frame_{}_{}", i + 1, j + 1) } else { plain };
    let turns = [*i, *j].iter().filter(|k| model.coordinates[first + **k].units[0] == "rad").count();
    let unit = match (letter, turns) {
        ("M", 0) => "kg",
        ("M", 1) => "kg m",
        ("M", _) => "kg m^2",
        (_, 0) => "N/m",
        (_, 1) => "N",
        _ => "N m",
    };
    let number = exact.clone().or_else(|| Rational::from_f64(*value)).unwrap_or(Rational::ZERO);
    let written = exact.as_ref().map_or_else(String::new, ToString::to_string);
    let si = model.graph.number(number);
    let symbol = model.graph.symbol_id(&name, 0);
    model.parameters.push(ParameterDecl {
        name,
        symbol,
        value: ParameterValue::Number { si },
        class: Class::Constant,
        number: Some(*value),
        unit: unit.to_owned(),
        written,
        label,
        span: None,
    });
    model.graph.symbol(symbol)
}

fn inertias(model: &mut Model, mass: &[Entry], first: usize) {
    for entry in mass {
        let label = Text::new("inertia of the frame", "инерция рамы");
        let value = parameter(model, ("M", entry), first, label);
        model.inertias.push(ConstantInertia { between: [first + entry.0, first + entry.1], value });
    }
}

fn potential(model: &mut Model, stiffness: &[Entry], first: usize) {
    let mut terms = Vec::new();
    for entry in stiffness {
        let label = Text::new("stiffness of the frame", "жёсткость рамы");
        let value = parameter(model, ("K", entry), first, label);
        let factor = if entry.0 == entry.1 { Rational::HALF } else { Rational::ONE };
        let [a, b] = [entry.0, entry.1].map(|k| model.coordinates[first + k].symbols[0]);
        let (a, b) = (model.graph.symbol(a), model.graph.symbol(b));
        let product = model.graph.product(&[value, a, b]);
        terms.push(model.graph.scale(product, &factor));
    }
    let energy = model.graph.sum(&terms);
    model.elements.push(element(POTENTIALS, "frame".into(), Potential { energy }, 0..0));
}

/// Generalised forces of the loads on the coordinates.
fn loads(model: &mut Model, structure: &file::Structure, bound: &Bound, found: &Substructure, first: usize) {
    let assembly = Assembly::of(&bound.frame);
    let n = found.named.len() + found.amplitudes;
    for (load, numbers) in structure.loads.iter().zip(&bound.frame.loads) {
        let mut forces: Vec<Vec<Expr>> = vec![Vec::new(); n];
        for (value, unit) in components(load, numbers) {
            if model.graph.is_zero(value) {
                continue;
            }
            for (i, share) in shares(&bound.frame, &assembly, found, unit, n).into_iter().enumerate() {
                if let Some(share) = share {
                    let share = model.graph.number(share);
                    forces[i].push(model.graph.mul(share, value));
                }
            }
        }
        for (i, terms) in forces.iter().enumerate().filter(|f| !f.1.is_empty()) {
            let value = model.graph.sum(terms);
            let along = model.graph.symbol(model.coordinates[first + i].symbols[0]);
            let force = Force::OnPathway { pathway: Pathway::Along(along, model::Measure::Other), value };
            let part = element(FORCES, load.name.clone(), force, 0..0);
            model.elements.push(Element { path: load.path.clone(), ..part });
        }
    }
}

/// Each component of a load as its formula and the unit load in its place.
fn components(load: &file::Load, numbers: &Load<f64>) -> Vec<(Expr, Action<f64>)> {
    match (&load.action, &numbers.action) {
        (file::Action::Point { value, .. }, Action::Point { at, .. }) => {
            let unit = |k: usize| Action::Point { at: at.clone(), value: [0, 1, 2].map(|j| f64::from(u8::from(j == k))) };
            (0..3).map(|k| (value[k], unit(k))).collect()
        }
        (file::Action::Distributed { value, .. }, Action::Distributed { rod, .. }) => {
            let unit =
                |k: usize| Action::Distributed { rod: *rod, value: [0, 1].map(|e| [0, 1].map(|c| f64::from(u8::from(2 * e + c == k)))) };
            (0..4).map(|k| (value[k / 2][k % 2], unit(k))).collect()
        }
        _ => Vec::new(),
    }
}

/// What a unit load gives to each coordinate; simple decimals as such.
fn shares(frame: &Frame<f64>, assembly: &Assembly<f64>, found: &Substructure, unit: Action<f64>, n: usize) -> Vec<Option<Rational>> {
    let load = Load { name: String::new(), action: unit };
    let forces = assembly.elimination.gather(&loading(assembly, frame, &[load]).forces);
    if let Some((k, factor)) = along_named(&displacements(frame, assembly), found, &forces) {
        return (0..n).map(|j| simple(factor, 1.0).filter(|_| j == k)).collect();
    }
    let mut q = dense::product(&dense::transpose(&found.basis, found.n_q, n), &forces, n, found.n_q, 1);
    on_groups(&mut q, &groups([&found.mass, &found.stiffness], n), &found.stiffness);
    let largest = q.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    q.iter().map(|v| if v.abs() <= ROUNDING * largest { None } else { simple(*v, largest) }).collect()
}

/// The coordinate along which the whole force acts, with its share: the work of such a force is exactly share·displacement, and the other
/// coordinates leave that displacement at rest by their definition.
fn along_named(rows: &[Vec<f64>], found: &Substructure, forces: &[f64]) -> Option<(usize, f64)> {
    let largest = |v: &[f64]| v.iter().copied().fold(0.0_f64, |m: f64, x| if x.abs() > m.abs() { x } else { m });
    let along = |row: &[f64]| {
        let size = largest(row);
        let at = row.iter().position(|x| *x == size).filter(|_| size != 0.0)?;
        let factor = forces.get(at)? / size;
        let near = |(f, r): (&f64, &f64)| (f - factor * r).abs() <= 4.0 * f64::EPSILON * (factor * size).abs();
        (factor != 0.0 && forces.iter().zip(row).all(near)).then_some(factor)
    };
    found.named.iter().enumerate().find_map(|(k, i)| Some((k, along(&rows[*i])?)))
}

/// A short decimal when the number is one within rounding; else the number itself.
fn simple(v: f64, largest: f64) -> Option<Rational> {
    // two units of the last place of what it was computed beside
    let short = format!("{v:.12}").parse::<f64>().ok().filter(|s| (s - v).abs() <= 4e-16 * v.abs().max(largest));
    let text = short.map(|s| format!("{s}"));
    text.and_then(|t| Rational::parse_decimal(&t)).or_else(|| Rational::from_f64(v))
}

/// Whether a load depends on time.
pub fn moves(model: &Model, load: &file::Load) -> bool {
    let values: Vec<symbolic::Expr> = match &load.action {
        file::Action::Point { value, .. } => value.to_vec(),
        file::Action::Distributed { value, .. } => value.concat(),
    };
    let mut symbols = model.graph.symbols_in(&values);
    // parameters may be formulas of time
    let formulas = model.parameters.iter().filter(|p| symbols.contains(&p.symbol) && p.class == Class::Time);
    symbols.extend(formulas.map(|_| model.time).collect::<Vec<_>>());
    symbols.contains(&model.time)
}
