//! One list of formulas in the three forms.

use super::book::shaft;
use super::reading::read;
use crate::formula::Form;
use words::Language;

/// Formula, text, LaTeX, both English.
const FORMULAS: [(&str, &str, &str); 27] = [
    ("m*g*l*sin(phi)", "m g l sin φ", r"m g l \sin \varphi"),
    ("-sin(phi)*m*g*l/2", "−(m g l/2) sin φ", r"-\frac{m g l}{2} \sin \varphi"),
    ("sin(phi)/2", "(sin φ)/2", r"\frac{\sin \varphi}{2}"),
    ("phi'^2*m*l^2/2", "m l² φ'²/2", r"\frac{m l^2 \dot{\varphi}^2}{2}"),
    ("k*(omega - phi')", "k (ω − φ')", r"k (\omega - \dot{\varphi})"),
    ("-k*(phi' - omega)", "k (ω − φ')", r"k (\omega - \dot{\varphi})"),
    ("-x - y", "−x − y", "-x - y"),
    ("y - x - M", "y − M − x", "y - M - x"),
    ("2*cos(2*phi)", "2 cos 2φ", r"2 \cos 2 \varphi"),
    ("cos(phi/2)", "cos(φ/2)", r"\cos \frac{\varphi}{2}"),
    ("sin(omega*t)^2", "sin² ωt", r"\sin^2 \omega t"),
    ("cos(phi - pi/6)", "cos(φ − π/6)", r"\cos\left(\varphi - \frac{\pi}{6}\right)"),
    ("1/sin(phi)^2", "1/sin² φ", r"\frac{1}{\sin^2 \varphi}"),
    ("sqrt(c_x/M)", "√(c_x/M)", r"\sqrt{\frac{c_x}{M}}"),
    ("sqrt(2)/2", "√2/2", r"\frac{\sqrt{2}}{2}"),
    ("sqrt(2*(x + l)/M)", "√(2 (l + x)/M)", r"\sqrt{\frac{2 (l + x)}{M}}"),
    ("x^(1/3) + x^(3/2)", "∛x + x^(3/2)", r"\sqrt[3]{x} + x^{3/2}"),
    ("abs(x')*x'", "x' |x'|", r"\dot{x} |\dot{x}|"),
    ("-m*g*sign(x')", "−m g sign x'", r"-m g \operatorname{sign} \dot{x}"),
    ("atan(x/l)", "arctan(x/l)", r"\arctan \frac{x}{l}"),
    ("atan2(y, x)", "atan2(y, x)", r"\operatorname{atan2}(y, x)"),
    ("strict(10 - t, 30*t, 300)", "{30 t, t < 10; 300, t ≥ 10}", r"\begin{cases} 30 t, & t < 10 \\ 300, & t \ge 10 \end{cases}"),
    ("l/(M + m)", "l/(M + m)", r"\frac{l}{M + m}"),
    ("l*cos(phi)/(M + m)", "(l cos φ)/(M + m)", r"\frac{l \cos \varphi}{M + m}"),
    ("9.81*m", "9.81 m", "9.81 m"),
    ("2*3^x", "2·3^x", r"2 \cdot 3^x"),
    ("x/(2*l*m)", "x/(2 m l)", r"\frac{x}{2 m l}"),
];

#[test]
fn text_and_latex() {
    let (mut graph, printer) = shaft();
    for (formula, text, latex) in FORMULAS {
        let e = read(&mut graph, formula);
        assert_eq!(printer.expression(&graph, e, Form::Text), text, "{formula}");
        assert_eq!(printer.expression(&graph, e, Form::Latex), latex, "{formula}");
    }
}

#[test]
fn mathml() {
    let (mut graph, printer) = shaft();
    for (formula, expected) in [
        (
            "phi'^2/2",
            "<math><mfrac><msup><mover accent=\"true\"><mi>φ</mi><mo stretchy=\"false\">˙</mo></mover><mrow><mn>2</mn></mrow></msup><mn>2</mn></mfrac></math>",
        ),
        (
            "-c_x*x",
            "<math><mo form=\"prefix\">−</mo><mrow><msub><mi>c</mi><mrow><mi>x</mi></mrow></msub><mo>\u{2062}</mo><mspace width=\"0.1em\"/><mi>x</mi></mrow></math>",
        ),
        ("cos(phi)", "<math><mrow><mi>cos</mi><mo>\u{2061}</mo><mspace width=\"0.167em\"/><mi>φ</mi></mrow></math>"),
        ("sqrt(2)", "<math><msqrt><mn>2</mn></msqrt></math>"),
    ] {
        let e = read(&mut graph, formula);
        let written = printer.inline(&graph, e, Form::MathMl);
        let bare = written.replacen("<math><mrow>", "<math>", 1).replacen("</mrow></math>", "</math>", 1);
        assert_eq!(bare, expected, "{formula}");
    }
}

#[test]
fn russian_names_and_marks() {
    let (mut graph, printer) = shaft();
    let printer = printer.with_language(Language::Ru);
    for (formula, text) in [
        ("tan(phi) + atan(x/l)", "tg φ + arctg(x/l)"),
        ("9.81*m", "9,81 m"),
        ("min(x, y)", "min(x; y)"),
        ("sinh(x) + cosh(x)*tanh(x)", "sh x + ch x th x"),
        ("switch(x, 1, switch(y, 2, 3))", "{1, x ≥ 0; 2, y ≥ 0; 3, в остальных случаях}"),
    ] {
        let e = read(&mut graph, formula);
        assert_eq!(printer.expression(&graph, e, Form::Text), text, "{formula}");
    }
    let e = read(&mut graph, "phi");
    assert_eq!(printer.inline(&graph, e, Form::MathMl), "<math><mrow><mi mathvariant=\"normal\">φ</mi></mrow></math>");
    let e = read(&mut graph, "0.05*x");
    assert_eq!(printer.expression(&graph, e, Form::Latex), "0{,}05 x");
}

#[test]
fn numbers() {
    let (mut graph, printer) = shaft();
    for (formula, text) in [
        ("1/2", "1/2"),
        ("2/5", "2/5"),
        ("0.1", "0.1"),
        ("12.5", "25/2"),
        ("981/10", "98.1"),
        ("0.0614323679", "0.0614323679"),
        ("0.000012", "1.2·10⁻⁵"),
        ("0.001", "0.001"),
        ("400000", "4·10⁵"),
        ("10000", "10000"),
        ("210000000000", "2.1·10¹¹"),
        ("1/7", "1/7"),
        ("355/113", "355/113"),
        ("1234567890123/9876543210987", "0.124999…"),
        ("123456789012345678901234567890", "1.23456…·10²⁹"),
        ("1/1024", "1/1024"),
        ("1/64", "0.015625"),
        ("1/(3*10^40)", "3.33333…·10⁻⁴¹"),
        ("-3/4", "−3/4"),
        ("0", "0"),
    ] {
        let e = read(&mut graph, formula);
        assert_eq!(printer.expression(&graph, e, Form::Text), text, "{formula}");
    }
}
