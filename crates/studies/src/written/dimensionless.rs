//! Forced oscillations of one degree of freedom over the ratio of the frequencies z = p/k.
//!
//! ```text
//! λ(z) = 1/√((1 − z²)² + 4 ζ² z²),   ζ = n/k,   D = λ h/k²
//! ```
//!
//! *Source*: A. A. Yablonskii, S. S. Noreiko, Course of the theory of vibrations.

use super::pen::{Coefficients, Pen, inline, words};
use super::quantity::{chain, with_unit};
use super::work::Work;
use crate::Finds;
use report::Block;
use report::document::Rich;
use report::figure::{Axis, Figure, Kind, Mark, Pen as Line, Series};
use report::formula::{Layout, Sign};
use report::unit::Scale;

/// Largest ratio of the frequencies that is drawn, at least.
const WIDTH: f64 = 3.0;
/// Points of the curve.
const POINTS: usize = 301;

/// Ratio of the amplitude to the static deflection.
pub(super) fn magnification(z: f64, zeta: f64) -> f64 {
    let (a, b) = (1.0 - z * z, 2.0 * zeta * z);
    1.0 / (a * a + b * b).sqrt()
}

/// Where λ has its maximum, if it has one: z² = 1 − 2 ζ².
pub(super) fn peak(zeta: f64) -> Option<(f64, f64)> {
    let square = 1.0 - 2.0 * zeta * zeta;
    (square > 0.0 && zeta > 0.0).then(|| (square.sqrt(), 1.0 / (2.0 * zeta * (1.0 - zeta * zeta).sqrt())))
}

pub(super) fn write(work: &Work, found: &Coefficients, pen: &mut Pen) {
    let responses = work.model.studies.iter().any(|s| work.finds(s.kind) == Finds::Amplitudes);
    let oscillates = found.a > 0.0 && found.c > 0.0 && found.b >= 0.0;
    if !(responses && oscillates) {
        return;
    }
    let (n, k) = (found.b / (2.0 * found.a), (found.c / found.a).sqrt());
    let zeta = n / k;
    let title = work.language.pick("Dimensionless characteristic", "Безразмерная амплитудно-частотная характеристика");
    pen.section(title, |pen| told(work, ([n, k, zeta], found.p.as_ref()), pen));
}

fn told(work: &Work, ([n, k, zeta], working): ([f64; 3], Option<&(f64, Layout)>), pen: &mut Pen) {
    let language = work.language;
    let letter = |name: &str| Layout::Symbol(work.printer.named(name));
    let digit = |text: &str| Layout::Number { mantissa: text.into(), exponent: None };
    let square = |of: Layout| Layout::Power(Box::new(of), Box::new(digit("2")));
    let over = |a: Layout, b: Layout| Layout::Fraction(Box::new(a), Box::new(b));
    let size = |x: f64| report::formula::value(x, 6, language);
    let own = |name: &str, value: f64| Layout::Symbol(work.printer.named(&super::coefficients::free(work, name, value)));
    let load = working.map_or_else(|| letter("p"), |(_, symbol)| symbol.clone());
    pen.tell(vec![
        words(language.pick("With the ratio of the frequencies z = ", "С отношением частот z = ")),
        inline(Layout::Row(vec![load.clone(), Layout::Words("/".into()), own("k", k)])),
        words(language.pick(
            " and the damping ratio ζ the amplitude of the forced oscillations is λ times the static deflection under the greatest load:",
            " и относительным затуханием ζ амплитуда вынужденных колебаний в λ раз больше статического отклонения под наибольшей нагрузкой:",
        )),
    ]);
    pen.numbered(chain(&work.printer, vec![letter("ζ"), over(own("n", n), own("k", k)), over(size(n), size(k)), size(zeta)]));
    let bracket = Layout::Fence(
        report::formula::Bracket::Round,
        Box::new(Layout::Sum(vec![(Sign::Plus, digit("1")), (Sign::Minus, square(letter("z")))])),
    );
    let damped = Layout::Product(vec![digit("4"), square(letter("ζ")), square(letter("z"))]);
    let radicand = Layout::Sum(vec![(Sign::Plus, square(bracket)), (Sign::Plus, damped)]);
    let root = Layout::Root { degree: 2, radicand: Box::new(radicand) };
    let argument = Layout::Fence(report::formula::Bracket::Round, Box::new(letter("z")));
    pen.numbered(chain(&work.printer, vec![Layout::Row(vec![letter("λ"), argument]), over(digit("1"), root)]));
    if let Some((p, _)) = working {
        let z = p / k;
        pen.numbered(chain(&work.printer, vec![letter("z"), over(load, own("k", k)), over(size(*p), size(k)), size(z)]));
        pen.numbered(chain(&work.printer, vec![letter("λ"), with_unit(magnification(z, zeta), "1", language)]));
    }
    if zeta > 0.0 {
        let half = Layout::Product(vec![digit("2"), letter("ζ")]);
        pen.say(language.pick("The quality factor is", "Добротность"));
        pen.numbered(chain(&work.printer, vec![letter("Q"), over(digit("1"), half), size(1.0 / (2.0 * zeta))]));
    }
    let number = |x: f64| report::number::short(x, 4, language);
    pen.say(match peak(zeta) {
        Some((z, top)) => language.pick(
            format!("The greatest value λ = {} is taken at z = √(1 − 2ζ²) = {}.", number(top), number(z)),
            format!("Наибольшее значение λ = {} достигается при z = √(1 − 2ζ²) = {}.", number(top), number(z)),
        ),
        None if zeta == 0.0 => language
            .pick("Without damping λ grows beyond all bounds as z → 1.", "Без затухания λ неограниченно возрастает при z → 1.")
            .to_owned(),
        None => language
            .pick(
                "As 2ζ² ≥ 1, λ falls with growing z: there is no resonance.",
                "Так как 2ζ² ≥ 1, λ с ростом z убывает: резонансного максимума нет.",
            )
            .to_owned(),
    });
    pen.pictures(vec![Block::Figure(curve(work, (k, zeta), working.map(|(p, _)| *p)))]);
}

fn curve(work: &Work, (k, zeta): (f64, f64), working: Option<f64>) -> Figure {
    let language = work.language;
    let right = working.map_or(WIDTH, |p| WIDTH.max(1.2 * p / k));
    let x: Vec<f64> = (0..POINTS).map(|i| right * i as f64 / (POINTS - 1) as f64).collect();
    // without damping the curve leaves the picture at z = 1
    let y = x.iter().map(|z| Some(magnification(*z, zeta)).filter(|v| *v < 20.0).unwrap_or(f64::NAN)).collect();
    let axis = |name: &str| Axis { symbols: vec![name.into()], units: Vec::new(), scale: Scale::plain("1"), log: false };
    let point = working.map(|p| Mark::Point {
        x: p / k,
        y: magnification(p / k, zeta),
        label: language.pick("working point", "рабочая точка").into(),
    });
    Figure {
        name: "magnification".into(),
        title: Rich::from(language.pick("Dynamic coefficient λ(z)", "Коэффициент динамичности λ(z)")),
        kind: Kind::Curves,
        x: axis("z"),
        y: axis("λ"),
        series: vec![Series { name: "λ".into(), label: String::new(), x, y, pen: Line::Line }],
        marks: point.into_iter().collect(),
        along: None,
        strip: Vec::new(),
        field: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_is_the_greatest_value_and_there_is_none_beyond_its_bound() {
        for zeta in [0.01, 0.1, 0.3, 0.7, 0.71, 1.0, 3.0] {
            let greatest = (0..40_000).map(|i| magnification(f64::from(i) * 1e-4, zeta)).fold(0.0_f64, f64::max);
            let Some((z, top)) = peak(zeta) else {
                assert!(greatest == 1.0 && zeta > 0.7, "{zeta}");
                continue;
            };
            // half the step 1e-4 of the samples beside the peak costs at most (0.5e-4/ζ)² of the height
            let missed = 0.25e-8 / (zeta * zeta);
            assert!(greatest <= top * (1.0 + f64::EPSILON * 8.0) && greatest >= top * (1.0 - missed), "{zeta}");
            // rounding of a difference of order ζ² beside 1
            let rounding = 8.0 * f64::EPSILON / (zeta * zeta);
            assert!((magnification(z, zeta) - top).abs() <= rounding * top, "{zeta}");
        }
    }
}
