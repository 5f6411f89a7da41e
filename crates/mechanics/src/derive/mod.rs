//! From a machine to its equations of motion.
//!
//! ```text
//! Model -> kinematics -> T, Π, Φ, Q -> Lagrange's equations -> Equations
//!                     -> Newton-Euler, projected ----------------^ (second derivation)
//! ```

mod connections;
mod explain;
mod inertial;
mod lagrange;
mod loads;
mod motion;
mod newton_euler;
mod place;
mod steps;

pub use explain::EXPLANATIONS;

use crate::connections::watched;
use crate::model::{Class, ConnectionKind, CoordinateDecl, Inertia, Model, ParameterDecl, Part};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::{EnergyTerms, Resolver};
use crate::scene::{Scene, Turn};
use algebra::elementary;
use connections::Connected;
use lagrange::{EnergyOf, Quadratic};
use loads::Loads;
use motion::Motion;
use symbolic::equations::{Applied, Auxiliary, Coordinate, Definition, Energy, Equality, Output, Parameter, Role, Start, Step};
use symbolic::{Equations, Expr, Matrix, Node, Rational, SymbolId};
use words::notice::sort;
use words::{Notice, Text};

/// Above this number of coordinates, formulas are not written out.
const LARGEST_SHOWN: usize = 12;

/// How much of the derivation is written down.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Detail {
    /// The equations.
    Equations,
    /// The equations and every step towards them.
    Steps,
}

/// Derives the equations of motion of a machine, with the written steps.
///
/// *Errors*: see [`derive_in`].
pub fn derive(model: &Model) -> Result<Equations, Vec<Notice>> {
    derive_in(model, Detail::Steps)
}

/// Derives the equations of motion of a machine.
///
/// *Errors*: a coordinate without inertia (M100), a plane inertia on a body that tumbles in space (M101), an undefined relative angle
/// (M102), a kinematic function that is not available (M103).
pub fn derive_in(model: &Model, detail: Detail) -> Result<Equations, Vec<Notice>> {
    let mut errors = Vec::new();
    derivation(model, detail, &mut errors).map_err(|more| {
        errors.extend(more);
        sort(&mut errors);
        errors
    })
}

/// The same; faults after which it goes on for a while are noted, the one that ends it is given back.
fn derivation(model: &Model, detail: Detail, noted: &mut Vec<Notice>) -> Result<Equations, Vec<Notice>> {
    let mut scene = Scene::new(model);
    let mut kinematics = Kinematics::new(&mut scene);
    noted.extend(plane_inertia_in_space(&mut scene, &kinematics));
    let shown = scene.n() <= LARGEST_SHOWN;
    let written = shown && detail == Detail::Steps;
    let mut resolver = Resolver::default();
    let loads = loads::collect(&mut scene, &mut kinematics, &mut resolver)?;
    let whose = if written || asks_for_bodies(model) { EnergyOf::Bodies } else { EnergyOf::Machine };
    let kinetic = lagrange::kinetic_energy(&mut scene, &mut kinematics, whose);
    let mut connected = connections::connect(&mut scene, &mut kinematics, &mut resolver)?;
    noted.extend(missing_inertia(&scene, &kinetic.total, &connected));
    let motion = Motion::new(&mut scene, &kinetic, &loads, &connected);
    let inertial = inertial::inertial(&mut scene, &mut kinematics);
    connected.balance(&mut scene, &mut kinematics, &loads, &inertial);
    let mut second = newton_euler::project(&mut scene, &mut kinematics, &loads, &connected);
    second.residuals.extend(connected.balance_residuals(&mut scene));
    let energy = energy(&mut scene, &kinetic.total, (&loads, &connected), &second);
    resolver.energies = Some(EnergyTerms { kinetic: energy.kinetic, potential: energy.potential, dissipation: energy.dissipation });
    resolver.kinetic = kinetic.bodies.iter().map(|b| (!b.is_empty()).then(|| lagrange::energy_of(&mut scene, b))).collect();
    let steps = if written { steps::write(&mut scene, &mut kinematics, (&kinetic, &loads, &motion), &connected) } else { Vec::new() };
    let textbook = if shown { motion.textbook(&mut scene) } else { Err(too_many(scene.n())) };
    let applied = loads.by_name(&mut scene, &connected.applied);
    resolver.told = loads.told;
    let outputs = outputs(&mut scene, &mut kinematics, &mut resolver)?;
    if !noted.is_empty() {
        return Err(Vec::new());
    }
    let outputs = outputs.into_iter().chain(connected.motor_powers(&mut scene)).collect();
    let mass = motion.mass_matrix(&mut scene);
    let force = motion.right_sides(&mut scene);
    let derived = Derived { mass, force, second: second.residuals, energy, outputs, textbook, applied };
    Ok(derived.equations(scene, connected, steps))
}

/// What the derivations gave.
struct Derived {
    mass: Matrix,
    force: Vec<Expr>,
    /// Residuals of the second derivation.
    second: Vec<Expr>,
    energy: Energy,
    outputs: Vec<Output>,
    textbook: Result<Vec<Equality>, Text>,
    applied: Vec<Applied>,
}

impl Derived {
    /// Together with the connections and the steps, and with the definitions of what all these formulas use.
    fn equations(self, mut scene: Scene, connected: Connected, steps: Vec<Step>) -> Equations {
        let model = scene.model;
        let roots = self.formulas(&mut scene, &connected);
        let definitions = definitions(&mut scene, &roots);
        let (parameters, starts) = with_starts(&scene, parameters(model));
        let zero = scene.graph.zero();
        let letters = connections::letters(model, &scene.graph, (&connected.reactions, &self.outputs));
        let notation = model.notation.iter().cloned().chain(letters).collect();
        Equations {
            title: model.title.clone(),
            time: model.time,
            coordinates: coordinates(model),
            auxiliaries: scene.turns.iter().map(|t| auxiliary(model, t, zero)).collect(),
            parameters,
            starts,
            definitions,
            mass: self.mass,
            force: self.force,
            reactions: connected.reactions,
            conditions: connected.conditions,
            balances: connected.balances,
            released: connected.free,
            impacts: model.impacts,
            textbook: self.textbook,
            steps,
            second: self.second,
            places: scene.places,
            applied: self.applied,
            energy: self.energy,
            outputs: self.outputs,
            notation,
            premises: scene.premises,
            mounted: None,
            graph: scene.graph,
        }
    }

    /// Every formula of the equations.
    fn formulas(&self, scene: &mut Scene, connected: &Connected) -> Vec<Expr> {
        let energy = &self.energy;
        let mut roots: Vec<Expr> = self.mass.entries().to_vec();
        roots.extend(self.force.iter().chain(&self.second).copied());
        roots.extend([
            energy.kinetic,
            energy.potential,
            energy.dissipation,
            energy.dissipated,
            energy.rate,
            energy.loads,
            energy.drives,
            energy.through,
        ]);
        roots.extend(self.outputs.iter().map(|o| o.formula));
        roots.extend(scene.places.iter().copied());
        if let Ok(equalities) = &self.textbook {
            roots.extend(equalities.iter().flat_map(|e| [e.left, e.right]));
        }
        roots.extend(scene.turns.iter().map(|t| t.rate));
        roots.extend(connected.expressions());
        let zero = scene.graph.zero();
        roots.extend(connected.free.expressions(zero));
        roots.extend(self.applied.iter().flat_map(|a| a.forces.iter().chain(&a.released).map(|f| f.1)));
        roots
    }
}

/// Why the equations of a large machine are not written out.
fn too_many(n: usize) -> Text {
    Text::new(
        format!("{n} equations are not written out: more than {LARGEST_SHOWN} coordinates"),
        format!("уравнения не выписаны: координат {n}, больше {LARGEST_SHOWN}"),
    )
}

/// Whether an output wants the energy of single bodies.
fn asks_for_bodies(model: &Model) -> bool {
    model.requests.iter().any(|r| matches!(r.kind, crate::model::RequestKind::KineticEnergy(Some(_))))
}

/// A plane inertia says nothing about turning about other axes.
fn plane_inertia_in_space(scene: &mut Scene, kinematics: &Kinematics) -> Vec<Notice> {
    let model = scene.model;
    let mut found = Vec::new();
    for (frame, motion) in model.frames.iter().zip(&kinematics.frames) {
        let plane = frame.mass.as_ref().is_some_and(|m| matches!(m.inertia, Inertia::Planar(_)));
        let tumbles = motion.turning.values().any(|w| !scene.graph.is_zero(w[0]) || !scene.graph.is_zero(w[1]));
        if plane && tumbles {
            let name = &frame.name;
            found.push(
                Notice::file(
                    "M101",
                    frame.span.clone(),
                    Text::new(
                        format!("body `{name}` turns in space but has one moment of inertia"),
                        format!("тело `{name}` вращается в пространстве, а момент инерции задан один"),
                    ),
                )
                .why(
                    "it also turns about its x or y axis, where its inertia is not given",
                    "оно поворачивается и вокруг своей оси x или y, для которой момент инерции не задан",
                )
                .help(
                    "give inertia = { xx = \"...\", yy = \"...\", zz = \"...\" } or a shape",
                    "задайте inertia = { xx = \"...\", yy = \"...\", zz = \"...\" } или форму shape",
                ),
            );
        }
    }
    found
}

/// Every coordinate needs inertia; a zero row of M makes its acceleration undefined.
fn missing_inertia(scene: &Scene, mass: &Quadratic, connected: &Connected) -> Vec<Notice> {
    let mut found = Vec::new();
    for (i, coordinate) in scene.model.coordinates.iter().enumerate() {
        let own = mass.get(&(i, i)).copied();
        if own.is_some_and(|e| !is_switched_off(scene, e)) || connected.holds(i) {
            continue;
        }
        let name = &coordinate.name;
        if let Some(e) = own {
            found.push(switched_off(scene, coordinate, e));
            continue;
        }
        found.push(
            Notice::file(
                "M100",
                coordinate.span.clone(),
                Text::new(
                    format!("nothing gives inertia to coordinate `{name}`"),
                    format!("обобщённой координате `{name}` ничто не придаёт инерции"),
                ),
            )
            .why(
                format!("no body with mass or inertia moves when `{name}` changes"),
                format!("при изменении `{name}` не движется ни одно тело с массой или моментом инерции"),
            )
            .help(
                format!("place a body with `mass` or `inertia` so that its origin or angle uses `{name}`, or remove the coordinate"),
                format!("поставьте тело с `mass` или `inertia`, положение которого зависит от `{name}`, или уберите координату"),
            ),
        );
    }
    found
}

/// Whether an inertia is zero because parameters are: at two states that nothing distinguishes.
fn is_switched_off(scene: &Scene, inertia: Expr) -> bool {
    let number = |s: SymbolId| scene.model.parameters.iter().find(|p| p.symbol == s).and_then(|p| p.number);
    let at = |state: f64| scene.graph.evaluate(&[inertia], &|s| number(s).unwrap_or(state + 0.618 * elementary::sin(s.index() as f64)))[0];
    at(0.3) == 0.0 && at(1.7) == 0.0
}

fn switched_off(scene: &Scene, coordinate: &CoordinateDecl, inertia: Expr) -> Notice {
    let symbols = scene.graph.symbols_in(&[inertia]);
    let zero = scene.model.parameters.iter().filter(|p| p.number == Some(0.0) && symbols.binary_search(&p.symbol).is_ok());
    let list = zero.map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
    let name = &coordinate.name;
    Notice::file(
        "M100",
        coordinate.span.clone(),
        Text::new(
            format!("with these values nothing gives inertia to coordinate `{name}`"),
            format!("при этих значениях обобщённой координате `{name}` ничто не придаёт инерции"),
        ),
    )
    .why(format!("its inertia vanishes with {list}"), format!("её инерция обращается в нуль вместе с {list}"))
    .help(
        format!("give what moves with `{name}` a mass, hold `{name}` by a motion, or remove the coordinate"),
        format!("задайте массу тому, что движется вместе с `{name}`, закрепите `{name}` заданным движением или уберите координату"),
    )
}

fn energy(scene: &mut Scene, mass: &Quadratic, (loads, connected): (&Loads, &Connected), second: &newton_euler::Projected) -> Energy {
    let kinetic = lagrange::energy_of(scene, mass);
    let potential = Loads::total(scene, &loads.potentials);
    let potential = scene.shortest(potential);
    let dissipation = Loads::total(scene, &loads.dissipations);
    let (given, rubbed) = connected.powers(scene);
    let dissipated = scene.graph.sum(&loads.dissipated);
    let dissipated = scene.graph.add(dissipated, rubbed);
    let total = scene.graph.add(kinetic, potential);
    let rate = scene.total(total);
    let mut powers = Vec::new();
    for j in 0..=scene.n() {
        let force = Loads::in_direction(scene, &loads.applied, j);
        let rate = scene.rate(j);
        powers.push(scene.graph.mul(force, rate));
    }
    powers.push(given);
    let through = through(scene, loads, connected, &second.sizes);
    let drives = second.drives;
    let loads = scene.graph.sum(&powers);
    Energy { kinetic, potential, dissipation, dissipated, rate, loads, drives, through }
}

/// The powers of single loads and reactions by single coordinates, by size.
fn through(scene: &mut Scene, loads: &Loads, connected: &Connected, inertial: &[Expr]) -> Expr {
    let mut sizes = connected.power_sizes(scene);
    sizes.extend(inertial);
    for columns in [&loads.conservative, &loads.resisting, &loads.applied].into_iter().flatten() {
        for (j, force) in columns {
            let rate = scene.rate(*j);
            let power = scene.graph.mul(*force, rate);
            sizes.push(scene.graph.call(symbolic::Function::Abs, &[power]));
        }
    }
    scene.graph.sum(&sizes)
}

fn coordinates(model: &Model) -> Vec<Coordinate> {
    let coordinate = |c: &crate::model::CoordinateDecl| Coordinate {
        symbols: c.symbols,
        unit: c.units[0].clone(),
        label: c.label.clone(),
        start: c.start,
        rate: c.rate,
        given: c.given,
        guessed: c.guessed,
    };
    model.coordinates.iter().map(coordinate).collect()
}

fn auxiliary(model: &Model, turn: &Turn, zero: Expr) -> Auxiliary {
    let frame = &model.frames[turn.frame].name;
    Auxiliary {
        symbol: turn.symbol,
        unit: "rad".to_owned(),
        label: Text::new(format!("turn angle of {frame}"), format!("угол поворота {frame}")),
        rate: turn.rate,
        start: zero,
    }
}

/// Symbols with a number. Constants given by a formula are definitions.
fn parameters(model: &Model) -> Vec<Parameter> {
    let numbers = model.parameters.iter().filter_map(|p| match (p.value, p.number) {
        (crate::model::ParameterValue::Number { .. }, Some(value)) => Some((p, value)),
        _ => None,
    });
    let rest = |p: &ParameterDecl, value: f64| match (p.value, Rational::from_f64(value)) {
        (crate::model::ParameterValue::Number { si }, Some(near)) => match model.graph.node(si) {
            Node::Number(exact) => (exact - &near).to_f64(),
            _ => 0.0,
        },
        _ => 0.0,
    };
    let one = |(p, value): (&ParameterDecl, f64)| Parameter {
        symbol: p.symbol,
        value,
        rest: rest(p, value),
        written: p.written.clone(),
        unit: p.unit.clone(),
        label: p.label.clone(),
    };
    numbers.map(one).collect()
}

/// The same and the places at the start that are sought; assembly gives them their numbers.
fn with_starts(scene: &Scene, mut parameters: Vec<Parameter>) -> (Vec<Parameter>, Vec<Start>) {
    let mut starts = Vec::new();
    for (coordinate, symbol, user) in &scene.starts {
        let declared = &scene.model.coordinates[*coordinate];
        let parameter = symbol.map(|symbol| {
            let name = &declared.name;
            let label = Text::new(format!("{name} at the start"), format!("{name} в начале движения"));
            parameters.push(Parameter { symbol, value: 0.0, rest: 0.0, written: String::new(), unit: declared.units[0].clone(), label });
            parameters.len() - 1
        });
        starts.push(Start { coordinate: *coordinate, parameter, used_by: user.clone() });
    }
    (parameters, starts)
}

/// Constants and functions of time given by formulas, and the time derivatives that occur.
fn definitions(scene: &mut Scene, roots: &[Expr]) -> Vec<Definition> {
    let model = scene.model;
    let mut list = Vec::new();
    for p in model.parameters.iter().filter(|p| p.class != Class::State) {
        if let crate::model::ParameterValue::Formula(formula) = p.value {
            list.push(Definition { symbol: p.symbol, formula, unit: p.unit.clone(), label: p.label.clone(), shown: true });
        }
    }
    for (symbol, formula, _, _) in scene.time_formulas(roots) {
        list.push(Definition { symbol, formula, unit: String::new(), label: Text::default(), shown: false });
    }
    list
}

/// Coordinates with rates and accelerations, auxiliary states, then the user's outputs.
fn outputs(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver) -> Result<Vec<Output>, Vec<Notice>> {
    let model = scene.model;
    let mut list = Vec::new();
    let roles = [Role::Coordinate, Role::Rate, Role::Acceleration];
    for (c, q) in model.coordinates.iter().zip(scene.q.clone()) {
        for (k, role) in roles.into_iter().enumerate() {
            let name = format!("{}{}", c.name, "'".repeat(k));
            let label = if k == 0 { c.label.clone() } else { Text::default() };
            let unit = c.units[k].clone();
            list.push(Output { name, symbol: c.symbols[k], unit, display: None, label, role, formula: q[k] });
        }
    }
    for turn in scene.turns.clone() {
        let name = scene.graph.symbol_info(turn.symbol).name.clone();
        let formula = scene.graph.symbol(turn.symbol);
        let unit = "rad".to_owned();
        let label = auxiliary(model, &turn, formula).label;
        list.push(Output { name, symbol: turn.symbol, unit, display: None, label, role: Role::Auxiliary, formula });
    }
    let mut errors = Vec::new();
    for output in &model.outputs {
        match resolver.resolve(scene, kinematics, output.formula) {
            Ok(formula) => list.push(Output {
                name: output.name.clone(),
                symbol: output.symbol,
                unit: output.unit.clone(),
                display: output.display.as_ref().map(|d| (d.label.clone(), d.factor)),
                label: output.label.clone(),
                role: Role::Named,
                formula,
            }),
            Err(mut diagnostic) => {
                diagnostic.place = words::Place::File(output.span.clone());
                errors.push(*diagnostic);
            }
        }
    }
    let hidden = model.events.iter().map(|e| (event_output(&e.name), e.symbol, e.zero, &e.unit, &e.span));
    let observed = model.observed.iter().map(|o| (o.name.clone(), o.symbol, o.formula, &o.unit, &o.span));
    for (name, symbol, formula, unit, span) in hidden.chain(observed) {
        let (unit, role) = (unit.clone(), Role::Event);
        match resolver.resolve(scene, kinematics, formula) {
            Ok(formula) => list.push(Output { name, symbol, unit, display: None, label: Text::default(), role, formula }),
            Err(mut diagnostic) => {
                diagnostic.place = words::Place::File(span.clone());
                errors.push(*diagnostic);
            }
        }
    }
    list.extend(pushes(scene, resolver));
    if errors.is_empty() { Ok(list) } else { Err(errors) }
}

/// The normal forces of wheels that their tracks hold both ways: a track only pushes.
fn pushes(scene: &mut Scene, resolver: &Resolver) -> Vec<Output> {
    let held = |kind: &ConnectionKind| matches!(kind, ConnectionKind::Rolling { held: true, leaves: None, .. });
    let mut list = Vec::new();
    for (i, connection) in scene.model.connections.iter().enumerate().filter(|(_, c)| held(&c.kind)) {
        let Some(&formula) = resolver.reactions.get(&(i, Part::Normal)) else { continue };
        let name = &connection.name;
        list.push(Output {
            name: push_output(name),
            symbol: scene.graph.symbol_id(&push_output(name), 0),
            unit: "N".to_owned(),
            display: None,
            label: Text::new(format!("rolling {name}"), format!("качение {name}")),
            role: Role::Event,
            formula,
        });
    }
    for (i, connection) in scene.model.connections.iter().enumerate() {
        for (k, (formula, label)) in watched(scene, resolver, (i, connection)).into_iter().enumerate() {
            let name = strand_output(&connection.name, k);
            let symbol = scene.graph.symbol_id(&name, 0);
            list.push(Output { name, symbol, unit: "N".to_owned(), display: None, label, role: Role::Event, formula });
        }
    }
    list
}

/// Name of the output that holds a normal force which only pushes.
pub fn push_output(name: &str) -> String {
    format!("push({name})")
}

/// Name of the output that holds the tension of a strand, the first or the second.
pub fn strand_output(name: &str, strand: usize) -> String {
    format!("strand({name}, {})", strand + 1)
}

/// Name of the output that holds the formula of a named event; brackets keep it apart from the user's names.
pub fn event_output(name: &str) -> String {
    format!("event({name})")
}
