//! The frame as part of the machine: its named displacements (and amplitudes of what they leave open) become generalised coordinates of the
//! model, with constant inertias, a potential energy uᵀ K u / 2 and the generalised forces of its loads. From there on Lagrange's equations, small
//! motions, responses and simulations know no difference between a frame and a body, and bodies stand on nodes by formulas of displacements.

use super::bind::bind;
use super::coordinates::{coarse, condensation, coordinates, speaks};
use super::figures::{Entry, Figures, Shares, figures};
use super::renew::{Again, Form, Renewal, Slot};
use mechanics::Model;
use mechanics::elements::{FORCES, Force, POTENTIALS, Potential, element};
use mechanics::model::{self, Class, ConstantInertia, CoordinateDecl, Element, OutputDecl, ParameterDecl, ParameterValue, Pathway};
use mechanics::structure as file;
use std::sync::Arc;
use structures::substructure::Substructure;
use symbolic::{Expr, Mounted, Rational, SymbolId};
use words::{Notice, Text};

/// The model with its frame as part of the machine, and remarks. Frames without inertia, or too large for dense matrices, stay outside.
///
/// # Errors
/// Mechanisms and loose nodes.
pub fn mounted(mut model: Model, (again, form): (&Arc<dyn Again>, Form)) -> Result<Mount, Box<Notice>> {
    let Some(structure) = model.structure.clone() else { return Ok(Mount { model, remarks: Vec::new(), renewal: None }) };
    let before = model.clone();
    let mut slots = Slots { form, list: Vec::new() };
    let (home, remarks) = mount(&mut model, &structure, &mut slots)?;
    let renewal = Renewal::of(before, home, slots.list, again).map(|r| Arc::new(r) as Arc<dyn Mounted>);
    Ok(Mount { model, remarks, renewal })
}

/// A model with its frame as part of the machine.
pub struct Mount {
    /// The model.
    pub model: Model,
    /// Remarks.
    pub remarks: Vec<Notice>,
    /// How the numbers of the frame follow parameters.
    pub renewal: Option<Arc<dyn Mounted>>,
}

/// The numbers of the frame as they enter the model, in the order of [`Figures::flat`].
struct Slots {
    form: Form,
    list: Vec<Slot>,
}

impl Slots {
    /// A share as an expression; none where there is nothing.
    fn share(&mut self, model: &mut Model, share: Option<&Rational>) -> Option<Expr> {
        let value = share.map_or(0.0, Rational::to_f64);
        if self.form == Form::Own {
            self.list.push(Slot { value, symbol: None });
            return share.map(|share| model.graph.number(share.clone()));
        }
        let name = format!("share_frame_{}", self.list.len() + 1);
        let label = Text::new("share of a coordinate of the frame", "доля координаты рамы");
        let (symbol, e) = declare(model, (name, "1"), (value, share), label);
        self.list.push(Slot { value, symbol: Some(symbol) });
        Some(e)
    }

    /// An entry of M or K as an expression; none where there is nothing.
    fn entry(&mut self, model: &mut Model, letter: &str, entry: &Entry, first: usize) -> Option<Expr> {
        let own = (self.form == Form::Followed || entry.2 != 0.0).then(|| parameter(model, (letter, entry), first));
        self.list.push(Slot { value: entry.2, symbol: own.map(|o| o.0) });
        own.map(|o| o.1)
    }
}

type Home = (Option<Substructure>, Vec<Notice>);

fn mount(model: &mut Model, structure: &file::Structure, slots: &mut Slots) -> Result<Home, Box<Notice>> {
    let mut bound = bind(model, structure);
    let found = coordinates(model, structure, &mut bound).map_err(|fault| Box::new(Notice::from(fault)))?;
    let remark = found.as_ref().and_then(|_| coarse(structure, &bound)).filter(|_| speaks(model));
    let warnings = remark.map(|words| Notice::file("M306", 0..0, words).warning()).into_iter().collect();
    let first = model.coordinates.len() - structure.displacements.len().min(model.coordinates.len());
    let Some(found) = found else {
        model.coordinates.truncate(first);
        return Ok((None, warnings));
    };
    if let Some(structure) = &mut model.structure {
        structure.kept = found.kept;
    }
    let all = model.coordinates.split_off(first);
    let (kept, followers): (Vec<_>, Vec<_>) = all.into_iter().enumerate().partition(|(i, _)| found.named.contains(i));
    model.coordinates.extend(kept.into_iter().map(|c| c.1));
    let started = |c: &CoordinateDecl| c.given != [false; 2] && !(model.graph.is_zero(c.start) && model.graph.is_zero(c.rate));
    if let Some((_, coordinate)) = followers.iter().find(|(_, c)| started(c)) {
        let coordinates: Vec<&str> = model.coordinates[first..].iter().map(|c| c.name.as_str()).collect();
        return Err(Box::new(no_start(coordinate, &coordinates)));
    }
    for k in 0..found.amplitudes {
        amplitude(model, k + 1);
    }
    let figures = figures(model, structure, (&bound, &found), condensation(structure));
    // in the order of the flat figures: shares of coordinates first
    let mut terms: Vec<Vec<Expr>> = figures.followers.iter().map(|shares| over_coordinates(model, slots, (first, shares))).collect();
    for (terms, lags) in terms.iter_mut().zip(&figures.lags) {
        terms.extend(at_once(model, slots, lags));
    }
    for ((_, coordinate), terms) in followers.into_iter().zip(terms) {
        follower(model, &terms, coordinate);
    }
    inertias(model, slots, &figures.mass, first);
    potential(model, slots, &figures.stiffness, first);
    loads(model, slots, structure, &figures, first);
    Ok((Some(found), warnings))
}

/// M307: a displacement that follows begins where the coordinates and the loads put it.
fn no_start(displacement: &CoordinateDecl, coordinates: &[&str]) -> Notice {
    let (name, list) = (&displacement.name, coordinates.join(", "));
    let [en, ru] = match coordinates {
        [] => ["give the masses a displacement of their own", "задайте перемещения самих масс"].map(str::to_owned),
        _ => [format!("give the starts of {list}"), format!("задайте начальные значения величин {list}")],
    };
    Notice::piece(
        "M307",
        displacement.span.clone(),
        format!("the displacement `{name}` cannot be given a start"),
        format!("перемещению `{name}` нельзя задать начальное значение"),
    )
    .why(
        "it is no coordinate: other displacements and the loads determine it",
        "оно не является координатой: его определяют другие перемещения и нагрузки",
    )
    .help(en, ru)
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

/// What the coordinates give to a displacement.
fn over_coordinates(model: &mut Model, slots: &mut Slots, (first, shares): (usize, &Shares)) -> Vec<Expr> {
    let mut terms = Vec::new();
    for (k, share) in shares.iter().enumerate() {
        if let Some(share) = slots.share(model, share.as_ref()) {
            let q = model.graph.symbol(model.coordinates[first + k].symbols[0]);
            terms.push(model.graph.mul(share, q));
        }
    }
    terms
}

/// What loads give to it at once, where nothing has inertia.
fn at_once(model: &mut Model, slots: &mut Slots, lags: &[(Expr, Option<Rational>)]) -> Vec<Expr> {
    let mut terms = Vec::new();
    for (value, share) in lags {
        if let Some(share) = slots.share(model, share.as_ref()) {
            terms.push(model.graph.mul(share, *value));
        }
    }
    terms
}

/// A displacement that follows from the coordinates and from the loads: a formula, and a result to look at.
fn follower(model: &mut Model, terms: &[Expr], coordinate: CoordinateDecl) {
    let formula = model.graph.sum(terms);
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
fn parameter(model: &mut Model, (letter, entry): (&str, &Entry), first: usize) -> (SymbolId, Expr) {
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
    let label = match letter {
        "M" => Text::new("inertia of the frame", "инерция рамы"),
        _ => Text::new("stiffness of the frame", "жёсткость рамы"),
    };
    declare(model, (name, unit), (*value, exact.as_ref()), label)
}

/// Longest fraction that is shown as one.
const LONGEST: usize = 40;

/// A constant that the file does not have, exact if possible.
fn declare(model: &mut Model, (name, unit): (String, &str), (value, exact): (f64, Option<&Rational>), label: Text) -> (SymbolId, Expr) {
    let number = exact.cloned().or_else(|| Rational::from_f64(value)).unwrap_or(Rational::ZERO);
    // a fraction of the file's own numbers is short; one of powers of two is what the frame was computed to, and nobody's writing
    let written = exact.map(ToString::to_string).filter(|text| text.len() <= LONGEST).unwrap_or_default();
    let si = model.graph.number(number);
    let symbol = model.graph.symbol_id(&name, 0);
    model.parameters.push(ParameterDecl {
        name,
        symbol,
        value: ParameterValue::Number { si },
        class: Class::Constant,
        number: Some(value),
        unit: unit.to_owned(),
        written,
        label,
        span: None,
    });
    (symbol, model.graph.symbol(symbol))
}

fn inertias(model: &mut Model, slots: &mut Slots, mass: &[Entry], first: usize) {
    for entry in mass {
        if let Some(value) = slots.entry(model, "M", entry, first) {
            model.inertias.push(ConstantInertia { between: [first + entry.0, first + entry.1], value });
        }
    }
}

fn potential(model: &mut Model, slots: &mut Slots, stiffness: &[Entry], first: usize) {
    let mut terms = Vec::new();
    for entry in stiffness {
        let Some(value) = slots.entry(model, "K", entry, first) else { continue };
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
fn loads(model: &mut Model, slots: &mut Slots, structure: &file::Structure, figures: &Figures, first: usize) {
    for (load, parts) in structure.loads.iter().zip(&figures.loads) {
        let mut forces: Vec<Vec<Expr>> = vec![Vec::new(); parts.first().map_or(0, |p| p.1.len())];
        for (value, shares) in parts {
            for (i, share) in shares.iter().enumerate() {
                if let Some(share) = slots.share(model, share.as_ref()) {
                    forces[i].push(model.graph.mul(share, *value));
                }
            }
        }
        for (i, terms) in forces.iter().enumerate().filter(|f| !f.1.is_empty()) {
            let value = model.graph.sum(terms);
            let along = model.graph.symbol(model.coordinates[first + i].symbols[0]);
            let force = Force::OnPathway { pathway: Pathway::Along(along, model::Measure::Other), value };
            let part = element(FORCES, load.name.clone(), force, 0..0);
            model.elements.push(Element { path: load.path.clone(), label: load.label.clone(), ..part });
        }
    }
}
