//! Names to symbols.

use crate::formula::{Form, Printer};
use symbolic::Graph;
use words::Language;

#[test]
fn names_become_symbols() {
    let mut graph = Graph::new();
    let printer = Printer::new(Language::En);
    for (name, primes, text, latex, label) in [
        ("phi", 0, "φ", r"\varphi", "φ"),
        ("phi", 1, "φ'", r"\dot{\varphi}", "φ̇"),
        ("phi1", 2, "φ₁''", r"\ddot{\varphi}_1", "φ̈₁"),
        ("varphi", 0, "φ", r"\varphi", "φ"),
        ("omega_p", 0, "ω_p", r"\omega_p", "ωₚ"),
        ("Omega", 0, "Ω", r"\Omega", "Ω"),
        ("l0", 0, "l₀", "l_0", "l₀"),
        ("M_h", 0, "M_h", "M_h", "Mₕ"),
        ("T_max", 0, "T_max", r"T_{\mathrm{max}}", "Tₘₐₓ"),
        ("J_пр", 0, "J_пр", r"J_{\text{пр}}", "J_пр"),
        ("x_C1", 0, "x_C1", "x_{C1}", "x_C1"),
        ("c_1_2", 0, "c_{1,2}", "c_{1,2}", "c_{1,2}"),
        ("J_phi", 0, "J_φ", r"J_{\varphi}", "Jᵩ"),
        ("φ2", 0, "φ₂", r"\varphi_2", "φ₂"),
        ("speed", 1, "speed'", r"\mathrm{speed}^{\prime}", "speed′"),
        ("Fx", 0, "F_x", "F_x", "Fₓ"),
        ("vx(A)", 0, "v_{x,A}", "v_{x,A}", "v_{x,A}"),
        ("omega(crank)", 0, "ω_crank", r"\omega_{\mathrm{crank}}", "ω_crank"),
        ("angle(B1)", 0, "φ_B1", r"\varphi_{B1}", "φ_B1"),
        ("kinetic_energy()", 0, "T", "T", "T"),
        ("potential_energy()", 0, "Π", r"\Pi", "Π"),
        ("force(AB)", 0, "F_AB", r"F_{\mathrm{AB}}", "F_AB"),
        ("x", 4, "x''''", r"x^{\prime\prime\prime\prime}", "x′′′′"),
        ("l_1'", 1, "l₁''", r"\ddot{l}_1", "l̈₁"),
        ("12", 0, "12", "12", "12"),
        ("_", 0, "_", r"\text{\_}", "_"),
    ] {
        let id = graph.symbol_id(name, primes);
        assert_eq!(printer.symbol(&graph, id, Form::Text), text, "{name}");
        assert_eq!(printer.symbol(&graph, id, Form::Latex), latex, "{name}");
        assert_eq!(printer.label(&graph, id), label, "{name}");
    }
}

#[test]
fn notation_comes_first() {
    let mut graph = Graph::new();
    let notation = [("mass", "m"), ("shaft", "ω_в"), ("k1", "κ₁"), ("inertia", "J_{пр}")];
    let printer = Printer::new(Language::Ru).with_notation(notation.map(|(a, b)| (a.into(), b.into())).to_vec());
    for (name, primes, text) in [("mass", 0, "m"), ("shaft", 1, "ω_в'"), ("k1", 0, "κ₁"), ("inertia", 0, "J_пр"), ("other", 0, "other")]
    {
        let id = graph.symbol_id(name, primes);
        assert_eq!(printer.symbol(&graph, id, Form::Text), text);
    }
}
