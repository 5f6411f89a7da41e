//! The numbers by which a frame enters the machine: its M and K over its coordinates, the displacements that follow from them, the shares of its loads.

use super::bind::Bound;
use super::groups::{groups, on_groups};
use algebra::double::Double;
use mechanics::Model;
use mechanics::structure as file;
use structures::equilibrium::EXACT;
use structures::loads::loading;
use structures::reduced::{Condensation, displacements, reduce};
use structures::substructure::Substructure;
use structures::{Action, Assembly, Frame, Load, dense};
use symbolic::{Expr, Rational};

/// Share of the largest number beside it that is rounding: solutions of the frame carry thirteen digits and more.
const ROUNDING: f64 = 1e-13;

/// Entries of M and K as (i, j, number, exact).
pub(super) type Entry = (usize, usize, f64, Option<Rational>);
/// Shares of coordinates; none where one has no part.
pub(super) type Shares = Vec<Option<Rational>>;

/// The numbers of a frame over its n coordinates.
pub(super) struct Figures {
    /// Named displacements that are no coordinates, over the coordinates.
    pub(super) followers: Vec<Shares>,
    /// What the loads move of each of them at once: formulas of their components, and shares.
    pub(super) lags: Vec<Vec<(Expr, Option<Rational>)>>,
    /// M, pair by pair.
    pub(super) mass: Vec<Entry>,
    /// K alike.
    pub(super) stiffness: Vec<Entry>,
    /// For each load and each of its components that is not zero: the formula of the component and what it gives to each coordinate.
    pub(super) loads: Vec<Vec<(Expr, Shares)>>,
}

impl Figures {
    /// All of them in one order.
    pub(super) fn flat(&self) -> Vec<f64> {
        let number = |share: &Option<Rational>| share.as_ref().map_or(0.0, Rational::to_f64);
        let followers = self.followers.iter().flatten().map(number);
        let lags = self.lags.iter().flatten().map(|(_, share)| number(share));
        let entries = self.mass.iter().chain(&self.stiffness).map(|e| e.2);
        let loads = self.loads.iter().flatten().flat_map(|(_, shares)| shares.iter().map(number));
        followers.chain(lags).chain(entries).chain(loads).collect()
    }
}

/// The numbers of a frame.
pub(super) fn figures(
    model: &Model,
    structure: &file::Structure,
    (bound, found): (&Bound, &Substructure),
    condensation: Condensation,
) -> Figures {
    let assembly = Assembly::of(&bound.frame);
    let n = found.named.len() + found.amplitudes;
    let (mass, stiffness) = entries(bound, found, condensation);
    let load = |(load, numbers): (&file::Load, &Load<f64>)| {
        let parts = components(load, numbers).into_iter().filter(|(value, _)| !model.graph.is_zero(*value));
        parts.map(|(value, unit)| (value, shares(&bound.frame, &assembly, found, unit, n))).collect()
    };
    let loads: Vec<Vec<(Expr, Shares)>> = structure.loads.iter().zip(&bound.frame.loads).map(load).collect();
    let components: Vec<Expr> = loads.iter().flatten().map(|(value, _)| *value).collect();
    let followers = || (0..structure.displacements.len()).filter(|i| !found.named.contains(i));
    let lag = |i: usize| {
        let row = &found.lags[i * components.len()..(i + 1) * components.len()];
        let largest = row.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        components.iter().zip(row).map(|(value, lag)| (*value, simple(*lag, largest).filter(|_| *lag != 0.0))).collect()
    };
    Figures {
        followers: followers().map(|i| follower(bound, found, i)).collect(),
        lags: followers().map(lag).collect(),
        mass,
        stiffness,
        loads,
    }
}

/// A displacement over the coordinates.
fn follower(bound: &Bound, found: &Substructure, i: usize) -> Shares {
    let assembly = Assembly::of(&bound.frame);
    let n = found.named.len() + found.amplitudes;
    let row = displacements(&bound.frame, &assembly).swap_remove(i);
    let shares = dense::product(&row, &found.basis, 1, found.n_q, n);
    let largest = shares.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    shares.iter().map(|s| if s.abs() > ROUNDING * largest { simple(*s, largest) } else { None }).collect()
}

/// M and K, pair by pair of coordinates: those above the diagonal and on it. What is rounding is zero.
fn entries(bound: &Bound, found: &Substructure, condensation: Condensation) -> (Vec<Entry>, Vec<Entry>) {
    let n = found.named.len() + found.amplitudes;
    let exact = bound
        .exact
        .as_ref()
        .filter(|e| found.condensed && found.n_q <= EXACT && found.amplitudes == 0 && n == e.displacements.len() && n <= 8);
    let exact = exact.and_then(|e| reduce(e, &Assembly::of(e), condensation).ok()).filter(|r| r.named);
    let rounded = found.rounded();
    // the springs of a stiff frame lie below the last digit of its rods: the number itself, of twice the digits
    let fine = |v: &Double| -> Option<Rational> {
        let [high, low] = v.parts();
        Some(&Rational::from_f64(high)? + &Rational::from_f64(low)?)
    };
    let double: Option<Vec<Rational>> = found.stiffness.iter().map(fine).collect();
    let group = groups([&found.mass, &rounded], n);
    let exacts = exact.is_some();
    let list = |values: &[f64], exact: Option<&[Rational]>| -> Vec<Entry> {
        let largest: Vec<f64> = (0..n).map(|i| values[i * n + i].abs()).collect();
        let pairs = (0..n).flat_map(|i| (i..n).map(move |j| (i, j)));
        let entry = |(i, j): (usize, usize)| (i, j, values[i * n + j], exact.map(|e| e[i * n + j].clone()));
        let matters = |e: &Entry| match &e.3 {
            Some(exact) if exacts => !exact.is_zero(),
            _ => group[e.0] == group[e.1] && e.2.abs() > ROUNDING * (largest[e.0] * largest[e.1]).sqrt(),
        };
        let zero = |(i, j, _, exact): Entry| (i, j, 0.0, exact.map(|_| Rational::ZERO));
        pairs.map(entry).map(|e| if matters(&e) { e } else { zero(e) }).collect()
    };
    let (mass, stiffness) = (exact.as_ref().map(|e| &e.mass[..]), exact.as_ref().map(|e| &e.stiffness[..]));
    (list(&found.mass, mass), list(&rounded, stiffness.or(double.as_deref())))
}

/// Each component of a load as its formula and the unit load in its place.
pub(super) fn components(load: &file::Load, numbers: &Load<f64>) -> Vec<(Expr, Action<f64>)> {
    match (&load.action, &numbers.action) {
        (file::Action::Point { value, .. }, Action::Point { at, .. }) => {
            let unit = |k: usize| Action::Point { at: at.clone(), value: [0, 1, 2].map(|j| f64::from(u8::from(j == k))) };
            (0..3).map(|k| (value[k], unit(k))).collect()
        }
        (file::Action::Distributed { value, .. }, Action::Distributed { rod, .. }) => {
            let unit =
                |k: usize| Action::Distributed { rod: *rod, value: [0, 1].map(|e| [0, 1].map(|c| f64::from(u8::from(2 * e + c == k)))) };
            (0..4).map(|k| (value[k / 2][k % 2], unit(k))).collect()
        }
        _ => Vec::new(),
    }
}

/// What a unit load gives to each coordinate; simple decimals as such.
fn shares(frame: &Frame<f64>, assembly: &Assembly<f64>, found: &Substructure, unit: Action<f64>, n: usize) -> Vec<Option<Rational>> {
    let load = Load { name: String::new(), action: unit };
    let forces = assembly.elimination.gather(&loading(assembly, frame, &[load]).forces);
    if let Some((k, factor)) = along_named(&displacements(frame, assembly), found, &forces) {
        return (0..n).map(|j| simple(factor, 1.0).filter(|_| j == k)).collect();
    }
    let mut q = dense::product(&dense::transpose(&found.basis, found.n_q, n), &forces, n, found.n_q, 1);
    let stiffness = found.rounded();
    on_groups(&mut q, &groups([&found.mass, &stiffness], n), &stiffness);
    let largest = q.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    q.iter().map(|v| if v.abs() <= ROUNDING * largest { None } else { simple(*v, largest) }).collect()
}

/// The coordinate along which the whole force acts, with its share: the work of such a force is exactly share·displacement, and the other
/// coordinates leave that displacement at rest by their definition.
fn along_named(rows: &[Vec<f64>], found: &Substructure, forces: &[f64]) -> Option<(usize, f64)> {
    let largest = |v: &[f64]| v.iter().copied().fold(0.0_f64, |m: f64, x| if x.abs() > m.abs() { x } else { m });
    let along = |row: &[f64]| {
        let size = largest(row);
        let at = row.iter().position(|x| *x == size).filter(|_| size != 0.0)?;
        let factor = forces.get(at)? / size;
        let near = |(f, r): (&f64, &f64)| (f - factor * r).abs() <= 4.0 * f64::EPSILON * (factor * size).abs();
        (factor != 0.0 && forces.iter().zip(row).all(near)).then_some(factor)
    };
    found.named.iter().enumerate().find_map(|(k, i)| Some((k, along(&rows[*i])?)))
}

/// A short decimal when the number is one within rounding; else the number itself.
fn simple(v: f64, largest: f64) -> Option<Rational> {
    // two units of the last place of what it was computed beside
    let short = format!("{v:.12}").parse::<f64>().ok().filter(|s| (s - v).abs() <= 4e-16 * v.abs().max(largest));
    let text = short.map(|s| format!("{s}"));
    text.and_then(|t| Rational::parse_decimal(&t)).or_else(|| Rational::from_f64(v))
}
