//! Formulas as the cards and textbooks print them.

use super::reading::read;
use crate::formula::{Form, Printer, SymbolClass};
use symbolic::Graph;
use symbolic::equations::Equality;
use words::Language;

/// A graph whose symbols are created in the given order, and a printer that knows them.
pub fn machine(parameters: &str, times: &str, coordinates: &str) -> (Graph, Printer) {
    let mut graph = Graph::new();
    let mut printer = Printer::new(Language::En);
    for name in parameters.split_whitespace() {
        let (name, rank) = match name.strip_suffix('!') {
            Some(mass) => (mass, 1),
            None => (name, if name == "g" { 2 } else { 3 }),
        };
        let id = graph.symbol_id(name, 0);
        printer = printer.with_class(id, SymbolClass::Constant, rank);
    }
    for name in times.split_whitespace() {
        let class = match name {
            "t" => SymbolClass::Time,
            "psi" => SymbolClass::Auxiliary,
            _ => SymbolClass::TimeFunction,
        };
        for primes in 0..2 {
            let id = graph.symbol_id(name, primes);
            printer = printer.with_class(id, class, 0);
        }
    }
    for (i, name) in coordinates.split_whitespace().enumerate() {
        for (primes, class) in [(0, SymbolClass::Coordinate), (1, SymbolClass::Rate), (2, SymbolClass::Acceleration)] {
            let id = graph.symbol_id(name, primes);
            printer = printer.with_class(id, class, i as u32);
        }
    }
    (graph, printer)
}

pub fn shaft() -> (Graph, Printer) {
    machine("g M! M_h! M_r! m! l e c_x! c_y! b_x! b_y! k!", "t omega psi", "x y phi")
}

/// Reads `left = right` and prints it as the equation of coordinate `own`.
fn equation(graph: &mut Graph, printer: &Printer, text: &str, own: usize) -> String {
    let (left, right) = text.split_once('=').unwrap();
    let right = read(graph, right);
    let left = read(graph, left);
    printer.equality(graph, Equality { left, right }, Some(own), Form::Text)
}

#[test]
fn card_p3_term_for_term() {
    let (mut graph, printer) = shaft();
    let scrambled = "m*l*cos(phi)*phi'' + M*x'' = -b_x*x' - c_x*x + m*l*sin(phi)*phi'^2 + M_r*e*sin(psi)*omega' + M_r*omega^2*e*cos(psi)";
    assert_eq!(
        equation(&mut graph, &printer, scrambled, 0),
        "M x'' + m l φ'' cos φ = M_r e ω² cos ψ + M_r e ω' sin ψ + m l φ'² sin φ − c_x x − b_x x'"
    );
    let scrambled = "m*l*sin(phi)*phi'' + M*y'' = -b_y*y' - c_y*y - m*l*cos(phi)*phi'^2 - M_r*e*cos(psi)*omega' + M_r*omega^2*e*sin(psi)";
    assert_eq!(
        equation(&mut graph, &printer, scrambled, 1),
        "M y'' + m l φ'' sin φ = M_r e ω² sin ψ − M_r e ω' cos ψ − m l φ'² cos φ − c_y y − b_y y'"
    );
    let scrambled = "m*l*sin(phi)*y'' + m*l*cos(phi)*x'' + m*l^2*phi'' = -m*g*l*sin(phi) - k*(phi' - omega)";
    assert_eq!(equation(&mut graph, &printer, scrambled, 2), "m l² φ'' + m l x'' cos φ + m l y'' sin φ = k (ω − φ') − m g l sin φ");
}

#[test]
fn card_d7_kinetic_energy() {
    let (mut graph, printer) = machine("m_x! m1! l0 lambda", "t", "phi x");
    let e = read(&mut graph, "m1*(lambda*x - l0)^2*phi'^2/2 + m_x*x'^2/2");
    assert_eq!(printer.expression(&graph, e, Form::Text), "m_x x'²/2 + m₁ (l₀ − λ x)² φ'²/2");
    assert_eq!(printer.expression(&graph, e, Form::Latex), r"\frac{m_x \dot{x}^2}{2} + \frac{m_1 (l_0 - \lambda x)^2 \dot{\varphi}^2}{2}");
}

#[test]
fn double_pendulum() {
    let (mut graph, printer) = machine("g m1! m2! l1 l2", "t", "phi1 phi2");
    let text = "m2*l1*l2*cos(phi2-phi1)*phi2'' + (m1+m2)*l1^2*phi1'' = -(m1+m2)*g*l1*sin(phi1) + m2*l1*l2*phi2'^2*sin(phi2-phi1)";
    assert_eq!(
        equation(&mut graph, &printer, text, 0),
        "(m₁ + m₂) l₁² φ₁'' + m₂ l₁ l₂ φ₂'' cos(φ₁ − φ₂) = −m₂ l₁ l₂ φ₂'² sin(φ₁ − φ₂) − (m₁ + m₂) g l₁ sin φ₁"
    );
    let text = "m2*l2^2*phi2'' + m2*l1*l2*cos(phi1-phi2)*phi1'' = m2*l1*l2*phi1'^2*sin(phi1-phi2) - m2*g*l2*sin(phi2)";
    assert_eq!(
        equation(&mut graph, &printer, text, 1),
        "m₂ l₂² φ₂'' + m₂ l₁ l₂ φ₁'' cos(φ₁ − φ₂) = m₂ l₁ l₂ φ₁'² sin(φ₁ − φ₂) − m₂ g l₂ sin φ₂"
    );
}
