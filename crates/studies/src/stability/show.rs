//! The reduction as formulas, the three verdicts side by side, and what is said in words.

use super::point::Point;
use super::reduction::Reduction;
use crate::results::{Results, Show, View};
use analysis::studies::stability::{Criterion, Resonance, Scalar, Tongue, Verdict};
use report::document::Formula;
use report::formula::{Bracket, Layout, Printer, Relation};
use report::table::Column;
use report::{Block, Cell, Table};
use words::{Language, Text};

/// Digits of numbers in the table of verdicts.
const DIGITS: usize = 8;
/// A formula with more nodes than this is not read by anybody.
const LONGEST: usize = 220;
/// A harmonic that exceeds the first by this factor makes another tongue the main one.
const PREVAILS: f64 = 1.5;

/// A multiplier nearer to the unit circle than this does not tell dying disturbances from lasting ones.
const DIES: f64 = 1e-9;

/// What stands above the numbers.
#[derive(Debug)]
pub(super) struct Shown {
    pub(super) reduction: Option<Reduction>,
    pub(super) scalar: Option<Scalar>,
}

impl Show for Shown {
    fn blocks(&self, _: &Results, view: &View) -> Vec<Block> {
        let mut blocks = Vec::new();
        if let Some(reduction) = &self.reduction {
            blocks.extend(formulas(reduction, view));
        }
        if let Some(scalar) = &self.scalar {
            blocks.extend(mathieu(view));
            blocks.push(Block::Table(verdicts(scalar, view.language)));
        }
        blocks
    }
}

fn words(text: &str) -> Layout {
    Layout::Words(text.into())
}

fn equal(left: Layout, right: Layout) -> Layout {
    Layout::Related(Box::new(left), Relation::Equal, Box::new(right))
}

fn fraction(above: Layout, below: Layout) -> Layout {
    Layout::Fraction(Box::new(above), Box::new(below))
}

fn number(digits: &str) -> Layout {
    Layout::Number { mantissa: digits.into(), exponent: None }
}

fn square(base: Layout) -> Layout {
    Layout::Power(Box::new(base), Box::new(number("2")))
}

/// J(φ), K(φ), B(φ) and ψ.
fn formulas(reduction: &Reduction, view: &View) -> Vec<Block> {
    let language = view.language;
    let printer = Printer::of(view.equations, language).with_width(view.width().saturating_sub(8));
    let angle = || printer.symbol_layout(&reduction.graph, reduction.angle);
    let symbol = |name: &str| Layout::Symbol(printer.named(name));
    let of_angle = |name: &str| Layout::Row(vec![symbol(name), Layout::Fence(Bracket::Round, Box::new(angle()))]);
    let block = |layout: Layout| Block::Equation { formula: printer.block(layout), numbered: true };
    let about = language.pick(
        "Small deviations q from the position φ, in which the machine is held in equilibrium, obey",
        "Малые отклонения q от положения φ, в котором машина удерживается в равновесии, подчиняются уравнению",
    );
    let mut terms = vec![fraction(Layout::Row(vec![square(words("d")), symbol("q")]), Layout::Row(vec![words("d"), square(symbol("t"))]))];
    terms[0] = Layout::Product(vec![of_angle("J"), terms[0].clone()]);
    if !reduction.is_undamped() {
        let rate = fraction(Layout::Row(vec![words("d"), symbol("q")]), Layout::Row(vec![words("d"), symbol("t")]));
        terms.push(Layout::Product(vec![of_angle("B"), rate]));
    }
    terms.push(Layout::Product(vec![of_angle("K"), symbol("q")]));
    let sum = Layout::Sum(terms.into_iter().map(|t| (report::formula::Sign::Plus, t)).collect());
    let mut blocks = vec![Block::paragraph(about), block(equal(sum, number("0")))];
    for (name, formula) in ["J", "K", "B"].into_iter().zip(reduction.formulas) {
        let shown = (name != "B" || !reduction.is_undamped()) && reduction.graph.reachable(&[formula]).len() <= LONGEST;
        if shown {
            blocks.push(block(equal(of_angle(name), printer.layout(&reduction.graph, formula))));
        }
    }
    let running = language.pick(
        "The position runs uniformly, φ = φ₀ + ωt, so that the square of the natural frequency becomes a function of time. \
         The acceleration of the machine's own turning is left out with it (J′ does not occur): this is the reduction of the textbooks.",
        "Положение равномерно меняется, φ = φ₀ + ωt, и квадрат собственной частоты становится функцией времени. \
         Ускорения самого вращения машины при этом не учитываются (J′ не входит): это приведение, принятое в учебниках.",
    );
    blocks.push(Block::paragraph(running));
    blocks.push(block(equal(of_angle("psi"), fraction(of_angle("K"), of_angle("J")))));
    blocks
}

/// d and e from ψ.
fn mathieu(view: &View) -> Vec<Block> {
    let language = view.language;
    let printer = Printer::of(view.equations, language).with_width(view.width().saturating_sub(8));
    let symbol = |name: &str| Layout::Symbol(printer.named(name));
    let signed = |sign| Layout::Sum(vec![(report::formula::Sign::Plus, symbol("psi_max")), (sign, symbol("psi_min"))]);
    let fenced = |layout| Layout::Fence(Bracket::Round, Box::new(layout));
    let d = Layout::Product(vec![number("2"), fenced(signed(report::formula::Sign::Plus))]);
    let lines = [
        equal(symbol("d"), fraction(d, square(symbol("omega")))),
        equal(symbol("e"), fraction(signed(report::formula::Sign::Minus), square(symbol("omega")))),
    ];
    let said = language.pick(
        "Mathieu's equation y″ + (d − 2e cos 2τ) y = 0, τ = ωt/2, takes the middle and the depth of ψ; Hill's equation y″ + ψ(t) y = 0 takes ψ as it is (damping is taken out of both by \
         y = q exp ∫h dt):",
        "Уравнение Матьё y″ + (d − 2e cos 2τ) y = 0, τ = ωt/2, использует среднее из крайних значений и глубину изменения ψ; уравнение Хилла y″ + ψ(t) y = 0 — саму функцию ψ \
         (сопротивление исключено из обоих подстановкой y = q exp ∫h dt):",
    );
    let block = |layout| Block::Equation { formula: Formula::inline(layout), numbered: false };
    std::iter::once(Block::paragraph(said)).chain(lines.map(block)).collect()
}

/// The three verdicts.
fn verdicts(scalar: &Scalar, language: Language) -> Table {
    let heads =
        language.pick(["Criterion", "unstable where positive", "Verdict"], ["Критерий", "неустойчиво, если больше нуля", "Вердикт"]);
    let mut table = Table::new(heads.map(Column::new).into());
    for by in Criterion::ALL {
        let damped = scalar.decay != 0.0;
        let name = match (by, damped) {
            (Criterion::Classical, false) => language.pick("classical, e² − (1 − d)²", "классический, e² − (1 − d)²"),
            (Criterion::Classical, true) => language.pick("classical, e² − (1 − d)² − 4η²", "классический, e² − (1 − d)² − 4η²"),
            (Criterion::Mathieu, false) => language.pick("Mathieu, |tr M| − 2", "Матьё, |tr M| − 2"),
            (Criterion::Mathieu, true) => language.pick("Mathieu, |tr M| − 2 cosh πη", "Матьё, |tr M| − 2 ch πη"),
            (Criterion::Hill, false) => language.pick("Hill, |tr M| − 2", "Хилл, |tr M| − 2"),
            (Criterion::Hill, true) => language.pick("Hill, |tr M| − 2 cosh πη", "Хилл, |tr M| − 2 ch πη"),
        };
        let falls = by == Criterion::Classical && scalar.d() < 0.0;
        let name = if falls { language.pick("classical, −d − e²/2", "классический, −d − e²/2") } else { name };
        let name = match by {
            _ if scalar.decay >= 0.0 => name,
            Criterion::Classical => language.pick("classical, −η (negative damping)", "классический, −η (отрицательное сопротивление)"),
            Criterion::Mathieu => language.pick("Mathieu, −η (negative damping)", "Матьё, −η (отрицательное сопротивление)"),
            Criterion::Hill => language.pick("Hill, −η (negative damping)", "Хилл, −η (отрицательное сопротивление)"),
        };
        let said = word(scalar.verdict(by));
        table.row(vec![Cell::words(name), Cell::number(scalar.excess(by), DIGITS, language), Cell::words(language.text(&said))]);
    }
    table
}

/// A verdict as a word.
pub(super) fn word(verdict: Verdict) -> Text {
    match verdict {
        Verdict::Stable => Text::new("stable", "устойчиво"),
        Verdict::Unstable => Text::new("unstable", "неустойчиво"),
        Verdict::Limit => Text::new("limit", "граница"),
    }
}

/// Sentences about a point.
pub(super) struct Words<'a>(pub(super) &'a Point);

impl Words<'_> {
    pub(super) fn verdict(&self) -> Text {
        let damped = self.0.multipliers.iter().filter(|m| !m.trivial).all(|m| m.abs() < 1.0 - DIES);
        match self.0.verdict {
            Verdict::Stable if damped => Text::new("Stable: small disturbances die out.", "Устойчиво: малые возмущения затухают."),
            Verdict::Stable => Text::new(
                "Stable: small disturbances neither grow nor die out, as far as the linear equations say.",
                "Устойчиво: по линейным уравнениям малые возмущения не растут и не затухают.",
            ),
            Verdict::Unstable => Text::new("Unstable: small disturbances grow.", "Неустойчиво: малые возмущения растут."),
            Verdict::Limit => Text::new(
                "A limiting case: the linear equations do not decide, multipliers lie on the unit circle and are not simple or not known well enough.",
                "Граничный случай: линейные уравнения вопрос не решают, мультипликаторы лежат на единичной окружности и кратны либо известны недостаточно точно.",
            ),
        }
    }

    /// Which frequencies the excitation couples.
    pub(super) fn resonance(&self) -> Option<Text> {
        let Resonance { tongue, order, frequencies: [a, b], forcing, .. } = self.0.resonance?;
        let both = |en: String, ru: String| Text::new(en, format!("{}.", ru.replace('.', ",")));
        let short = |x: f64| report::number::short(x, 5, Language::En);
        let (a, b, w) = (short(a), short(b), short(forcing));
        let k = if order == 1 { String::new() } else { format!("{order}·") };
        Some(match tongue {
            Tongue::Averaged => Text::new(
                "The equations averaged over the period are unstable themselves; it is not the variation of the coefficients that makes disturbances grow.",
                "Неустойчивы уже осреднённые за период уравнения; возмущения растут не из-за изменения коэффициентов.",
            ),
            Tongue::Principal => both(
                format!(
                    "Principal parametric resonance: 2·{b} ≈ {w} rad/s, twice the averaged natural frequency is that of the coefficients."
                ),
                format!(
                    "Главный параметрический резонанс: 2·{b} ≈ {w} рад/с — удвоенная средняя собственная частота близка к частоте коэффициентов"
                ),
            ),
            Tongue::Parametric => both(
                format!("Parametric resonance of order {order}: 2·{b} ≈ {k}{w} rad/s."),
                format!("Параметрический резонанс порядка {order}: 2·{b} ≈ {k}{w} рад/с"),
            ),
            Tongue::Sum => both(
                format!("Combination resonance of sum type: {a} + {b} ≈ {k}{w} rad/s."),
                format!("Комбинационный резонанс суммарного типа: {a} + {b} ≈ {k}{w} рад/с"),
            ),
            Tongue::Difference => both(
                format!("Combination resonance of difference type: {b} − {a} ≈ {k}{w} rad/s."),
                format!("Комбинационный резонанс разностного типа: {b} − {a} ≈ {k}{w} рад/с"),
            ),
        })
    }

    /// Which tongue of the diagram of Ince and Strutt.
    pub(super) fn tongue(&self) -> Option<Text> {
        let n = self.0.scalar.as_ref()?.tongue()?;
        Some(Text::new(
            format!("Tongue {n} of the Ince-Strutt diagram: number of zeros of the growing solution in a period of the coefficients."),
            format!(
                "Область неустойчивости номер {n} диаграммы Айнса — Стретта: номер — число нулей растущего решения за период коэффициентов."
            ),
        ))
    }

    /// What Mathieu's form leaves out.
    pub(super) fn harmonics(&self) -> Option<Text> {
        let list = self.0.scalar.as_ref()?.harmonics();
        let first = *list.first()?;
        let (k, largest) = list.iter().enumerate().skip(1).max_by(|a, b| a.1.total_cmp(b.1))?;
        if *largest <= PREVAILS * first {
            return None;
        }
        let short = |x: f64| report::number::short(x, 4, Language::En);
        let (one, other, k) = (short(first), short(*largest), k + 1);
        let ru = format!(
            "В ψ преобладает гармоника {k} ({other} от средней из крайних значений, первая — {one}); уравнение Матьё приписывает всю глубину первой гармонике, поэтому его области \
             неустойчивости не те, что у машины: верить следует уравнению Хилла"
        );
        Some(Text::new(
            format!(
                "Harmonic {k} of ψ prevails ({other} of the middle value, the first is {one}); Mathieu's equation ascribes the whole depth to the first, so its regions of \
                 instability are not those of the machine: Hill's equation is to be believed."
            ),
            format!("{}.", ru.replace('.', ",")),
        ))
    }
}
