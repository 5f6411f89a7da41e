//! Periods and radians: a rate counted in Hz or 1/min where an angular rate in rad/s is meant is off by 2π, and no check of dimensions
//! sees it.
//!
//! The soft exponents of [`Dimension`] follow a count of periods through parameters and formulas; here stand the places where it must
//! have become radians: beside an angle in a sum or comparison, in a sine, in a field that takes an angle or its rate, and in any other
//! field except a time, a number or a frequency. A value in 1/s alone (a decay rate, v/l, sqrt(c/m)) counts nothing and never meets a
//! complaint.

use super::kind::Kind;
use super::parse::{Ast, Formula, NodeId};
use crate::units::{Dimension, Unit, complaint};
use std::f64::consts::PI;
use std::ops::Range;
use symbolic::{Function, Rational};
use words::Notice;

/// How far a decimal such as 6.28 may be from 2π and still be meant as it.
const CLOSE: f64 = 2e-3;

/// The dimension of a pure number: with its factor π when it is written as a decimal (3.14, 6.2832, 39.5).
pub(super) fn of_number(n: &Rational) -> Dimension {
    let value = n.to_f64().abs();
    let is = |wanted: f64| n.to_i64().is_none() && (value / wanted - 1.0).abs() < CLOSE;
    if is(PI) || is(2.0 * PI) {
        Dimension::PI
    } else if is(4.0 * PI * PI) || is(PI * PI) {
        Dimension::PI.mul(&Dimension::PI).unwrap_or(Dimension::PI)
    } else {
        Dimension::NONE
    }
}

/// The period 1/f is a time like any other: omega*T is an angle.
pub(super) fn settled(d: Dimension) -> Dimension {
    if d.is_duration() { d.without_periods() } else { d }
}

/// The complaint about an argument of a sine that counts periods.
pub(super) fn in_argument(function: Function, got: &Dimension, span: Range<usize>) -> Option<Notice> {
    let of_angle = matches!(function, Function::Sin | Function::Cos | Function::Tan);
    (of_angle && got.lacks_radians()).then(|| {
        let name = function.name();
        complaint(
            span,
            (
                format!("the argument of {name} counts periods (Hz, 1/min), not radians"),
                format!("аргумент {name} считает периоды (Гц, 1/мин), а не радианы"),
            ),
        )
    })
}

/// The complaint about a sum or comparison where periods meet radians: `phi' - n`.
pub(super) fn in_sum(items: &[(NodeId, Dimension)], spans: &dyn Fn(NodeId) -> Range<usize>) -> Option<Notice> {
    let counts = items.iter().find(|(_, d)| d.lacks_radians())?;
    items.iter().find(|(_, d)| d.has_radians())?;
    let words = (
        "this counts periods (Hz, 1/min), what it is added to or compared with counts radians".to_owned(),
        "здесь считаются периоды (Гц, 1/мин), а рядом, в сумме или сравнении, — радианы".to_owned(),
    );
    Some(complaint(spans(counts.0), words))
}

/// The complaint about `pi*n/30` and `pi*d*n/60`, where the unit of n has the minute in it already.
pub(super) fn over_sixty(formula: &Formula, factors: &[(bool, NodeId)], kinds: &[Kind], span: &Range<usize>) -> Option<Notice> {
    let of = |id: NodeId| if let Kind::Known(d) = kinds[id] { Some(d) } else { None };
    let number = |id: NodeId| match &formula.nodes[id].0 {
        Ast::Number(n) => n.to_i64(),
        _ => None,
    };
    let above: i64 = factors.iter().filter(|f| !f.0).filter_map(|f| number(f.1)).try_fold(1i64, i64::checked_mul)?;
    let below: i64 = factors.iter().filter(|f| f.0).filter_map(|f| number(f.1)).try_fold(1i64, i64::checked_mul)?;
    let by = |wanted: i64| above != 0 && above.checked_mul(wanted) == Some(below);
    let counted = |f: &&(bool, NodeId)| !f.0 && of(f.1).is_some_and(|d| d.lacks_radians());
    let turned = |f: &&(bool, NodeId)| !f.0 && of(f.1).is_some_and(|d| d.pi() > 0);
    let meant = (by(30) || by(60)) && factors.iter().any(|f| counted(&f)) && factors.iter().any(|f| turned(&f));
    meant.then(|| {
        Notice::piece(
            "M027",
            span.clone(),
            "the minute is divided out twice: the value carries its unit, 1450 1/min is 24.17 Hz here",
            "минута учтена дважды: величина несёт свою единицу, 1450 1/мин здесь — это 24,17 Гц",
        )
        .help("write 2*pi*n instead of pi*n/30", "напишите 2*pi*n вместо pi*n/30")
        .warning()
    })
}

/// The SI value of one unit of display for a value of this dimension: an angular rate shown in Hz or 1/min is divided by 2π, a
/// frequency shown in rpm is multiplied by it. `formula` is what is shown.
///
/// # Errors
/// A warning where it cannot be told whether the value counts periods.
pub(crate) fn display(value: &Dimension, unit: &Unit, formula: Option<&Formula>, plain: Plain) -> (f64, Option<Notice>) {
    let factor = unit.factor.to_f64();
    let turn = 2.0 * PI;
    let divided = value.pi() < 0;
    if unit.dimension.counts_periods() && value.has_radians() && !divided {
        return (factor * turn, None);
    }
    let counts_nothing = !value.counts_periods() && !value.has_radians() && !divided;
    if unit.dimension.counts_periods() && counts_nothing && plain == Plain::Doubtful {
        return (factor, Some(undecided(formula)));
    }
    let turning = unit.dimension.is_angular() && unit.factor.pi != 0;
    if turning && value.lacks_radians() {
        return (factor / turn, None);
    }
    if turning && value.has_radians() && divided {
        return (factor, Some(converted_twice(formula)));
    }
    (factor, None)
}

/// Whether a value in 1/s that counts neither periods nor radians may be taken as periods: 1/T may, v/l and sqrt(c/m) may be either.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Plain {
    Periods,
    Doubtful,
}

fn whole(formula: Option<&Formula>) -> Range<usize> {
    formula.map_or(0..0, |f| f.nodes[f.root()].1.clone())
}

fn undecided(formula: Option<&Formula>) -> Notice {
    Notice::piece(
        "M027",
        whole(formula),
        "a value in 1/s is shown in periods per second, and nothing says that it counts them",
        "величина в 1/с показана в периодах в секунду, но неизвестно, считает ли она периоды",
    )
    .why(
        "sqrt(c/m) or v/r is in rad/s; it is shown as it is, not divided by 2 pi",
        "sqrt(c/m) или v/r — это рад/с; величина показана как есть, без деления на 2 пи",
    )
    .help("divide by 2*pi to show a frequency; or show it in 1/s", "для частоты разделите на 2*pi; иначе показывайте в 1/с")
    .warning()
}

fn converted_twice(formula: Option<&Formula>) -> Notice {
    Notice::piece(
        "M027",
        whole(formula),
        "the rate is divided by pi, and its unit converts it once more",
        "скорость разделена на пи, а единица переводит её ещё раз",
    )
    .help("write the rate itself, phi', and the unit rpm", "напишите саму скорость, phi', и единицу об/мин")
    .warning()
}
