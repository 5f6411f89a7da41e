//! The written derivation, step by step, as it stands in a student's notebook.

use super::connections::Connected;
use super::lagrange::{Kinetic, Quadratic, energy_of};
use super::loads::{Loads, Term};
use super::motion::Motion;
use crate::model::{FrameId, Inertia, Mass, PointRef};
use crate::scene::Scene;
use crate::scene::kinematics::{Kinematics, combine};
use symbolic::equations::{Part, Step, StepFormula, StepName};
use symbolic::{Expr, Rational};
use words::Text;

/// Writes the steps.
pub fn write(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (kinetic, loads, motion): (&Kinetic, &Loads, &Motion),
    connected: &Connected,
) -> Vec<Step> {
    let mut steps = vec![coordinates(scene, connected), kinetic_energy(scene, kinematics, kinetic)];
    let letters = [("Π", &loads.potentials), ("Φ", &loads.dissipations)];
    let titles = [
        Text::new("Potential energy", "Потенциальная энергия"),
        Text::new("Dissipation function (Rayleigh)", "Диссипативная функция Рэлея"),
    ];
    for ((letter, terms), title) in letters.into_iter().zip(titles) {
        if !terms.is_empty() {
            steps.push(energy_step(scene, letter, terms, title));
        }
    }
    steps.extend(conditions(scene, connected));
    steps.extend(generalized_forces(scene, motion));
    steps.push(derivatives(scene, (kinetic, motion), connected));
    steps
}

fn quantity(letter: &str, index: &str) -> StepName {
    StepName::Quantity { letter: letter.to_owned(), index: index.to_owned() }
}

fn step(part: Part, title: Text, words: Text, formulas: Vec<StepFormula>) -> Step {
    Step { part, title, words, formulas }
}

fn coordinates(scene: &Scene, connected: &Connected) -> Step {
    let (n, conditions) = (scene.n(), connected.ideal());
    let free = n.saturating_sub(conditions);
    let words = if conditions == 0 {
        Text::new(format!("Degrees of freedom: {n}."), format!("Число степеней свободы: {n}."))
    } else {
        Text::new(
            format!("Coordinates: {n}; conditions: {conditions}; degrees of freedom: {free}."),
            format!("Координат: {n}; уравнений связей: {conditions}; степеней свободы: {free}."),
        )
    };
    step(Part::Coordinates, Text::new("Generalized coordinates", "Обобщённые координаты"), words, Vec::new())
}

/// T of each body and their sum.
fn kinetic_energy(scene: &mut Scene, kinematics: &mut Kinematics, kinetic: &Kinetic) -> Step {
    let model = scene.model;
    let mut formulas = Vec::new();
    for (i, (frame, quadratic)) in model.frames.iter().zip(&kinetic.bodies).enumerate() {
        let Some(mass) = frame.mass.as_ref().filter(|_| !quadratic.is_empty()) else { continue };
        let tumbles = kinematics.frames[i].turning.values().any(|w| !scene.graph.is_zero(w[0]) || !scene.graph.is_zero(w[1]));
        let right = if tumbles { in_space(scene, kinematics, (FrameId(i), mass)) } else { None };
        let right = right.unwrap_or_else(|| in_plane(scene, quadratic));
        formulas.push(StepFormula { left: quantity("T", &frame.name), right });
    }
    let bodies = formulas.len();
    let total = energy_of(scene, &kinetic.total);
    if bodies != 1 {
        formulas.push(StepFormula { left: quantity("T", ""), right: total });
    } else if let Some(only) = formulas.first_mut() {
        only.left = quantity("T", "");
    }
    step(Part::Kinetic, Text::new("Kinetic energy", "Кинетическая энергия"), Text::default(), formulas)
}

/// From the quadratic form, constants in front.
fn in_plane(scene: &mut Scene, quadratic: &Quadratic) -> Expr {
    let energy = energy_of(scene, quadratic);
    let energy = scene.tidy(energy);
    scene.textbook.factored(&mut scene.graph, energy)
}

/// m v²/2 + Σ J_a ω_a²/2 in principal axes, equal moments together: A (ω_x² + ω_y²)/2 + C ω_z²/2.
fn in_space(scene: &mut Scene, kinematics: &mut Kinematics, (frame, mass): (FrameId, &Mass)) -> Option<Expr> {
    let Inertia::Tensor { xx, yy, zz, xy, yz, xz } = mass.inertia else { return None };
    if ![xy, yz, xz].iter().all(|e| scene.graph.is_zero(*e)) {
        return None;
    }
    let columns = kinematics.jacobian(scene, PointRef::Center(frame));
    let velocity = combine(scene, &columns);
    let square = scene.dot(&velocity, &velocity);
    let square = scene.tidy(square);
    let mut parts = vec![(mass.mass, square)];
    let turning = kinematics.angular_velocity(scene, frame);
    let mut axes: Vec<(Expr, Vec<Expr>)> = Vec::new();
    for (moment, rate) in [xx, yy, zz].into_iter().zip(turning) {
        let rate = scene.tidy(rate);
        let square = scene.graph.square(rate);
        match axes.iter_mut().find(|(m, _)| *m == moment) {
            Some((_, squares)) => squares.push(square),
            None => axes.push((moment, vec![square])),
        }
    }
    for (moment, squares) in axes {
        let sum = scene.graph.sum(&squares);
        // a single square stays a square: (φ' + ψ' cos θ)²
        let sum = if squares.len() > 1 { scene.tidy(sum) } else { sum };
        parts.push((moment, sum));
    }
    let mut terms = Vec::with_capacity(parts.len());
    for (factor, square) in parts {
        let square = scene.textbook.factored(&mut scene.graph, square);
        terms.push(scene.graph.monomial(Rational::HALF, &[(factor, Rational::ONE), (square, Rational::ONE)]));
    }
    Some(scene.graph.sum(&terms))
}

/// Each term, then the sum.
fn energy_step(scene: &mut Scene, letter: &str, terms: &[Term], title: Text) -> Step {
    let mut formulas = Vec::new();
    for term in terms {
        let energy = scene.tidy(term.energy);
        formulas.push(StepFormula { left: quantity(letter, &term.name), right: energy });
    }
    if let [only] = &mut formulas[..] {
        only.left = quantity(letter, "");
    } else {
        let sum: Vec<Expr> = formulas.iter().map(|f| f.right).collect();
        let sum = scene.graph.sum(&sum);
        let right = scene.tidy(sum);
        formulas.push(StepFormula { left: quantity(letter, ""), right });
    }
    step(if letter == "Φ" { Part::Dissipation } else { Part::Potential }, title, Text::default(), formulas)
}

/// What the connections demand: of positions where possible, else of rates.
fn conditions(scene: &mut Scene, connected: &Connected) -> Option<Step> {
    let zero = scene.graph.zero();
    let mut formulas = Vec::new();
    for condition in &connected.conditions {
        let left = condition.place.unwrap_or(condition.rate);
        let left = scene.tidy(left);
        formulas.push(StepFormula { left: StepName::Formula(left), right: zero });
    }
    let words = Text::new(
        "Each condition has a reaction; its generalized forces are its derivatives by the coordinates (rates).",
        "Каждому условию отвечает реакция; её обобщённые силы – производные условия по координатам (скоростям).",
    );
    (!formulas.is_empty()).then(|| step(Part::Conditions, Text::new("Equations of the connections", "Уравнения связей"), words, formulas))
}

/// Q_i of loads without a potential.
fn generalized_forces(scene: &mut Scene, motion: &Motion) -> Option<Step> {
    let mut formulas = Vec::new();
    for (c, force) in scene.model.coordinates.iter().zip(&motion.forces.applied) {
        if !scene.graph.is_zero(*force) {
            formulas.push(StepFormula { left: quantity("Q", &c.name), right: *force });
        }
    }
    let words = Text::new(
        "From the virtual power of the applied forces and torques, δN = Σ Q q'.",
        "Из возможной мощности приложенных сил и моментов, δN = Σ Q q'.",
    );
    (!formulas.is_empty()).then(|| step(Part::Forces, Text::new("Generalized forces", "Обобщённые силы"), words, formulas))
}

/// ∂T/∂q', d/dt ∂T/∂q', ∂T/∂q, ∂Π/∂q, ∂Φ/∂q' for every coordinate.
fn derivatives(scene: &mut Scene, (kinetic, motion): (&Kinetic, &Motion), connected: &Connected) -> Step {
    let reacting = connected.reactions.iter().any(|r| !r.forces.is_empty());
    let acts = |scene: &Scene, forces: &[Expr]| forces.iter().any(|f| !scene.graph.is_zero(*f));
    let potential = acts(scene, &motion.forces.conservative);
    let resisting = acts(scene, &motion.forces.resisting);
    let applied = acts(scene, &motion.forces.applied);
    let energy = energy_of(scene, &kinetic.total);
    let mut formulas = Vec::new();
    for i in 0..scene.n() {
        let [q, qd, _] = scene.q[i];
        let momentum = scene.by_rate(energy, i);
        let momentum = scene.tidy(momentum);
        formulas.push(StepFormula { left: StepName::Partial { of: "T".into(), by: qd }, right: momentum });
        let rate = scene.total(momentum);
        let rate = scene.tidy(rate);
        formulas.push(StepFormula { left: StepName::TimeDerivativeOfPartial { of: "T".into(), by: qd }, right: rate });
        let slope = scene.along(energy, i);
        let slope = scene.tidy(slope);
        formulas.push(StepFormula { left: StepName::Partial { of: "T".into(), by: q }, right: slope });
        let parts = [("Π", motion.forces.conservative[i], q, potential), ("Φ", motion.forces.resisting[i], qd, resisting)];
        for (letter, force, by, exists) in parts {
            if exists {
                let right = scene.graph.neg(force);
                formulas.push(StepFormula { left: StepName::Partial { of: letter.into(), by }, right });
            }
        }
    }
    let terms = [(potential, "− ∂Π/∂q"), (resisting, "− ∂Φ/∂q'"), (applied, "+ Q"), (reacting, "+ R")];
    let law = law(terms.into_iter().filter(|t| t.0).map(|t| t.1));
    let (en, ru) = match reacting {
        true => ("; R are the generalized forces of reactions and drives", "; R – обобщённые силы реакций и приводов"),
        false => ("", ""),
    };
    step(
        Part::Derivatives,
        Text::new("Derivatives", "Производные"),
        Text::new(format!("They go into {law}{en}."), format!("Они подставляются в уравнения {law}{ru}.")),
        formulas,
    )
}

/// Lagrange's equations with the terms that this machine has.
fn law(terms: impl Iterator<Item = &'static str>) -> String {
    let right = terms.collect::<Vec<_>>().join(" ");
    // the first sign stands close, or not at all
    let right = match (right.strip_prefix("− "), right.strip_prefix("+ ")) {
        (Some(rest), _) => format!("−{rest}"),
        (_, Some(rest)) => rest.to_owned(),
        _ => "0".to_owned(),
    };
    format!("d/dt ∂T/∂q' − ∂T/∂q = {right}")
}
