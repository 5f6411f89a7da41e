//! A printer built from `Equations`: classes, ranks, notation, steps, broken lines.

use super::random::{arity_holds, well_formed};
use super::reading::read;
use crate::formula::{Form, Placement, Printer};
use symbolic::equations::{Auxiliary, Coordinate, Definition, Equality, Parameter, StepFormula, StepName};
use symbolic::{Equations, Expr, Graph};
use words::{Language, Text};

fn parameter(graph: &mut Graph, name: &str, unit: &str) -> Parameter {
    Parameter { symbol: graph.symbol_id(name, 0), value: 1.0, rest: 0.0, written: "1".into(), unit: unit.into(), label: Text::default() }
}

fn coordinate(graph: &mut Graph, name: &str) -> Coordinate {
    let symbols = [0, 1, 2].map(|primes| graph.symbol_id(name, primes));
    let (start, rate) = (graph.zero(), graph.zero());
    Coordinate { symbols, unit: "1".into(), label: Text::default(), start, rate, given: [true; 2], guessed: [false; 2] }
}

fn definition(graph: &mut Graph, name: &str, formula: &str, unit: &str) -> Definition {
    let formula = read(graph, formula);
    Definition { formula, symbol: graph.symbol_id(name, 0), unit: unit.into(), label: Text::default(), shown: true }
}

/// A pendulum on a cart with a driven unbalance: every kind of symbol occurs.
fn machine() -> Equations {
    let mut graph = Graph::new();
    let zero = graph.zero();
    let names = [("l", "m"), ("g", "m/s^2"), ("e", "m"), ("mu", "1"), ("mass", "kg"), ("c", "N/m"), ("k", "N m s")];
    let parameters = names.map(|(name, unit)| parameter(&mut graph, name, unit)).to_vec();
    let coordinates = ["x", "phi"].map(|name| coordinate(&mut graph, name)).to_vec();
    let definitions = vec![definition(&mut graph, "omega", "30*t", "rad/s"), definition(&mut graph, "J", "mass*l^2", "kg m^2")];
    let psi = graph.symbol_id("psi", 0);
    let rate = graph.var("omega");
    let auxiliaries = vec![Auxiliary { symbol: psi, unit: "rad".into(), label: Text::default(), rate, start: zero }];
    let notation = vec![("mass".into(), "m".into())];
    Equations {
        coordinates,
        auxiliaries,
        parameters,
        definitions,
        force: vec![zero; 2],
        textbook: Ok(vec![]),
        second: vec![zero; 2],
        notation,
        ..Equations::empty(graph, 2)
    }
}

fn text(equations: &mut Equations, formula: &str) -> String {
    let e = read(&mut equations.graph, formula);
    Printer::of(equations, Language::En).expression(&equations.graph, e, Form::Text)
}

#[test]
fn units_rank_the_constants() {
    let mut m = machine();
    assert_eq!(text(&mut m, "l*g*mass*mu*sin(phi)"), "μ m g l sin φ");
    assert_eq!(text(&mut m, "e*mass*omega^2*cos(psi)"), "m e ω² cos ψ");
    assert_eq!(text(&mut m, "(phi' - omega)*k"), "−k (ω − φ')");
    assert_eq!(text(&mut m, "mass*e^2 + J"), "J + m e²");
    assert_eq!(text(&mut m, "x*c + c*l"), "c l + c x");
}

#[test]
fn the_exponential_avoids_a_parameter_e() {
    let mut m = machine();
    let e = read(&mut m.graph, "exp(-k*t)");
    let latex = |m: &Equations, e: Expr| Printer::of(m, Language::En).expression(&m.graph, e, Form::Latex);
    assert_eq!(latex(&m, e), r"\exp(-k t)");
    m.parameters.retain(|p| m.graph.symbol_info(p.symbol).name != "e");
    assert_eq!(latex(&m, e), r"\mathrm{e}^{-k t}");
}

#[test]
fn steps_of_a_derivation() {
    let mut m = machine();
    let rate = read(&mut m.graph, "phi'");
    let momentum = read(&mut m.graph, "mass*l*x'*cos(phi) + J*phi'");
    let change = read(&mut m.graph, "mass*l*x''*cos(phi) + J*phi'' - mass*l*x'*phi'*sin(phi)");
    let energy = read(&mut m.graph, "J*phi'^2/2 + e*mass*omega*x' + mass*e^2*omega^2/2");
    let of = || "T".to_owned();
    for (left, right, text, latex) in [
        (
            StepName::Quantity { letter: of(), index: "shaft".into() },
            energy,
            "T_shaft = J φ'²/2 + m e ω x' + m e² ω²/2",
            r"T_{\mathrm{shaft}} = \frac{J \dot{\varphi}^2}{2} + m e \omega \dot{x} + \frac{m e^2 \omega^2}{2}",
        ),
        (
            StepName::Partial { of: of(), by: rate },
            momentum,
            "∂T/∂φ' = J φ' + m l x' cos φ",
            r"\frac{\partial T}{\partial \dot{\varphi}} = J \dot{\varphi} + m l \dot{x} \cos \varphi",
        ),
        (
            StepName::TimeDerivativeOfPartial { of: of(), by: rate },
            change,
            "d/dt ∂T/∂φ' = J φ'' + m l x'' cos φ − m l x' φ' sin φ",
            r"\frac{\mathrm{d}}{\mathrm{d}t}\,\frac{\partial T}{\partial \dot{\varphi}} = J \ddot{\varphi} + m l \ddot{x} \cos \varphi - m l \dot{x} \dot{\varphi} \sin \varphi",
        ),
        (StepName::Quantity { letter: "v^2".into(), index: "C".into() }, rate, "v_C² = φ'", r"v_C^2 = \dot{\varphi}"),
        (StepName::Quantity { letter: "Q".into(), index: "phi".into() }, rate, "Q_φ = φ'", r"Q_{\varphi} = \dot{\varphi}"),
        (StepName::Formula(rate), rate, "φ' = φ'", r"\dot{\varphi} = \dot{\varphi}"),
    ] {
        let printer = Printer::of(&m, Language::En);
        let formula = StepFormula { left, right };
        let layout = printer.step(&m.graph, &formula);
        let written = |form| printer.write(&layout, form, Placement::Block);
        assert_eq!(written(Form::Text), text);
        assert_eq!(written(Form::Latex), latex);
        let mathml = written(Form::MathMl);
        well_formed(&mathml);
        arity_holds(&mathml);
    }
}

#[test]
fn long_equations_repeat_the_sign() {
    let mut m = machine();
    let left = read(&mut m.graph, "mass*x'' + mass*l*phi''*cos(phi)");
    let right = read(&mut m.graph, "e*mass*omega^2*cos(psi) + mass*l*phi'^2*sin(phi) - c*x");
    let printer = Printer::of(&m, Language::En).with_width(30);
    let equality = Equality { left, right };
    let text = printer.equality(&m.graph, equality, Some(0), Form::Text);
    assert_eq!(text, "m x'' + m l φ'' cos φ =\n    = m e ω² cos ψ +\n    + m l φ'² sin φ − c x");
    assert!(text.lines().all(|line| line.chars().count() <= 30));
    assert_eq!(
        printer.equality(&m.graph, equality, Some(0), Form::Latex),
        "\\begin{aligned}\nm \\ddot{x} + m l \\ddot{\\varphi} \\cos \\varphi = {} \\\\\n\\quad {}= m e \\omega^2 \\cos \\psi + {} \\\\\n\\quad {}+ m l \\dot{\\varphi}^2 \\sin \\varphi - c x\n\\end{aligned}"
    );
    let mathml = printer.equality(&m.graph, equality, Some(0), Form::MathMl);
    well_formed(&mathml);
    arity_holds(&mathml);
    assert_eq!(mathml.matches("<mtr>").count(), 3);
    assert_eq!(mathml.matches("<mo form=\"infix\">+</mo>").count(), 3, "two signs and the repeated one");
}
