//! The first coefficients of a guard or a bound, and what they say.

use crate::Mode;

/// Share of a guard's own scale below which it counts as standing still on its surface.
pub(in crate::integrate) const STILL: f64 = 1e-11;

/// The same for a guard that leaves `Zero`: the instant of the crossed limit is rounded, and what vanishes there (the acceleration of a break-away
/// with equal limits, of a contact that opens) is left over as rounding of the time times the next coefficient.
pub(in crate::integrate) const SIGNIFICANT_LEAVING: f64 = 1e-10;

/// Share of the limits of a friction, or of the size of a contact force, below which a limit counts as just reached: the reaction comes from a
/// linear solve in which larger forces may meet.
pub(in crate::integrate) const REACHED: f64 = 1e-12;

/// sum |g_k| h^k.
pub(in crate::integrate) fn size(g: &[f64], h: f64) -> f64 {
    g.iter().rev().fold(0.0, |sum, g_k| sum * h + g_k.abs())
}

/// Order and sign of the first coefficient, after the constant one, whose term exceeds `share` of the change.
pub(in crate::integrate) fn leading_term(g: &[f64], h: f64, share: f64) -> Option<(usize, Mode)> {
    let change = size(g.get(1..)?, h) * h;
    let mut power = 1.0;
    for (k, &g_k) in g.iter().enumerate().skip(1) {
        power *= h;
        if g_k.abs() * power > share * change {
            return Some((k, Mode::of(g_k)));
        }
    }
    None
}

/// What a bound does from here on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::integrate) enum BoundState {
    /// Positive, away from zero.
    Kept,
    /// Just reached, but it rises with the coefficient of this order.
    Rises(usize),
    /// Just reached, and it stays there.
    Rests,
    /// Negative, or about to become so.
    Crossed,
}

/// Judges a bound by its coefficients over a step h; `scale` is the size of what it bounds.
pub(in crate::integrate) fn judge_bound(g: &[f64], h: f64, scale: f64) -> BoundState {
    let Some(&value) = g.first() else { return BoundState::Rests };
    if value > REACHED * scale {
        return BoundState::Kept;
    }
    if value < -REACHED * scale {
        return BoundState::Crossed;
    }
    if size(&g[1..], h) * h <= REACHED * scale {
        return BoundState::Rests;
    }
    match leading_term(g, h, SIGNIFICANT_LEAVING) {
        Some((k, Mode::Positive)) => BoundState::Rises(k),
        Some((_, Mode::Negative)) => BoundState::Crossed,
        _ => BoundState::Rests,
    }
}
