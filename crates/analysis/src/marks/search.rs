//! The signs of a quantity along a step, and the instants at which they change.
//!
//! The polynomials through its samples are off by a share of their range: around a root of higher order, beside values many decades larger, or where it has
//! died out, they say nothing. Such a part is sampled anew by itself, with a range of its own, until its signs are clear, or until it is an instant, or what the
//! quantity is there may as well be rounding of what meets in it: then it rests at zero. A change between clear places is followed on the quantity itself.

use super::crossings::{self, Stretch};
use super::{Line, bracketed};
use crate::proxies::proxy::{ERROR, Piece, Proxies, ROUNDING, Window};

/// Values below this share of the largest so far are zero, where their rounding is not known or does not die out: a ball lies where its first impacts left it.
const ZERO: f64 = 16.0 * f64::EPSILON;
/// Parts of a step that are looked at anew: a root of the hundredth order takes some thirty.
const PATIENCE: u32 = 256;
/// Pieces of such a part that may fail: where rounding has no polynomial they all do.
const FAILING: i64 = 24;
/// Share of a step up to which a part in which the quantity rests at zero is rounding of one instant.
const INSTANT: f64 = 1e-9;
/// Share of a step up to which the ends of a part that cannot be followed say enough of it.
const SHORT: f64 = 1e-6;
/// Share of the first step within which a quantity that is zero at the start leaves it there: t⁶ is rounding for so long.
const BEGINS: f64 = 1e-2;
/// First stride on the way back through a part, as a share of it.
const STRIDE: f64 = 1e-6;
/// Where a part is cut: a root in its middle is at no end of both.
const CUT: f64 = 0.41;

/// Changes of sign in a step.
#[derive(Clone, Debug, Default)]
pub(super) struct Turns {
    /// Instants after its start, and the signs behind them.
    pub(super) list: Vec<(f64, f64)>,
    /// The first sign that is clear, 0 when none is.
    pub(super) first: f64,
    /// Whether the quantity leaves zero at the very start.
    pub(super) begins: bool,
}

/// One quantity along a step.
pub(super) struct Search<'a, L: Line> {
    line: &'a mut L,
    output: usize,
    /// The last sign that was clear, 0 when none was.
    pub(super) sign: f64,
    /// Largest value so far.
    pub(super) largest: f64,
    /// Where it was clear last.
    known: f64,
    /// Where it began to rest since then, and did so last.
    rested: [f64; 2],
    /// Parts that may still be looked at anew.
    patience: u32,
    /// Whether a part could not be followed.
    pub(super) lost: bool,
    pub(super) turns: Turns,
}

impl<'a, L: Line> Search<'a, L> {
    /// Begins with the sign and the largest value before the step.
    pub(super) fn new(line: &'a mut L, output: usize, (sign, largest): (f64, f64)) -> Search<'a, L> {
        Search { line, output, sign, largest, known: 0.0, rested: [0.0; 2], patience: PATIENCE, lost: false, turns: Turns::default() }
    }

    /// Looks at the step by the polynomials of its samples.
    pub(super) fn whole(&mut self, pieces: &[&Piece]) {
        // what has no value at the start does not leave zero there
        let begins = self.sign == 0.0 && !self.line.output(0.0, self.output).is_nan() && self.rests(0.0);
        let largest = |piece: &&Piece| piece.row.iter().fold(0.0, |m: f64, b| m.max(b.abs()));
        self.largest = pieces.iter().map(largest).fold(self.largest, f64::max);
        for piece in pieces {
            self.piece(piece, self.largest);
        }
        self.turns.begins &= begins;
    }

    fn piece(&mut self, piece: &Piece, largest: f64) {
        let [low, high] = piece.row.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], b| [low.min(*b), high.max(*b)]);
        let error = if piece.row.len() > 2 { (ERROR * (high - low)).max(ROUNDING * largest) } else { 0.0 };
        let place = |u: f64| piece.from + (piece.to - piece.from) * u;
        for stretch in crossings::stretches(&piece.row, error) {
            let ends = [place(stretch.from), place(stretch.to)];
            match stretch.signs {
                Some(signs) => self.clear(ends, signs, (piece, stretch)),
                None => self.closer(ends),
            }
        }
    }

    /// A part whose ends have these signs. Where they tell of a change, those of the quantity itself count.
    fn clear(&mut self, [from, to]: [f64; 2], signs: [f64; 2], (piece, stretch): (&Piece, Stretch)) {
        let changes = signs[0] != self.sign || signs[0] != signs[1];
        let [first, last] = if changes { [from, to].map(|tau| self.sign_at(tau)) } else { signs };
        if first != 0.0 {
            self.turn([self.known, from], first);
            self.stand(from, first);
        }
        match last {
            0.0 => self.rest(to),
            _ if first == 0.0 || first == last => self.turn([self.known, to], last),
            _ => {
                let tau = self.passed([from, to], last, (piece, stretch));
                self.turns.list.push((tau, last));
            }
        }
        if last != 0.0 {
            self.stand(to, last);
        }
    }

    /// The sign of the quantity, 0 where it may be rounding.
    fn sign_at(&mut self, tau: f64) -> f64 {
        if self.rests(tau) { 0.0 } else { self.line.output(tau, self.output).signum() }
    }

    /// Tells of a change to this sign in a part at whose end the quantity has it, if it had the other before.
    fn turn(&mut self, part: [f64; 2], sign: f64) {
        if self.sign == 0.0 {
            self.turns.first = sign;
            self.turns.begins = self.rested[1] <= BEGINS * self.line.length();
        } else if sign != self.sign {
            let [from, to] = self.rested;
            let tau = if to - from > INSTANT * self.line.length() { self.left([from, part[1]], sign) } else { self.taken(part, sign) };
            self.turns.list.push((tau, sign));
        }
    }

    /// The instant from which on the quantity has the sign that it has at the end of a part in which it rests: it may leave zero flat, and is followed back through its
    /// rounding while it keeps the sign.
    fn left(&mut self, [from, to]: [f64; 2], sign: f64) -> f64 {
        let (mut at, mut stride) = (to, STRIDE * (to - from));
        while at > from {
            let before = (at - stride).max(from);
            if self.line.output(before, self.output) * sign <= 0.0 {
                return self.taken([before, at], sign);
            }
            (at, stride) = (before, 2.0 * stride);
        }
        from
    }

    /// The quantity has this sign, more than rounding of it.
    fn stand(&mut self, at: f64, sign: f64) {
        (self.sign, self.known, self.rested) = (sign, at, [at; 2]);
    }

    /// The quantity has been zero to rounding up to there.
    fn rest(&mut self, to: f64) {
        self.rested[1] = to;
    }

    /// A part in which the polynomial says nothing.
    fn closer(&mut self, [from, to]: [f64; 2]) {
        let middle = from + CUT * (to - from);
        let short = to - from <= 4.0 * self.line.resolution() || middle <= from || middle >= to;
        if short || self.patience == 0 || [from, middle, to].into_iter().all(|tau| self.rests(tau)) {
            return self.by_its_end([from, to]);
        }
        for [a, b] in [[from, middle], [middle, to]] {
            self.patience = self.patience.saturating_sub(1);
            let mut proxies = Proxies::sparing(FAILING, self.output + 1);
            let mut pieces = proxies.pieces(&mut Window::new(self.line, a), &[self.output], b - a);
            if proxies.lost().contains(&self.output) {
                self.by_its_end([a, b]);
                continue;
            }
            let largest = pieces.iter().flat_map(|piece| &piece.row).fold(0.0, |m: f64, b| m.max(b.abs()));
            for piece in &mut pieces {
                (piece.from, piece.to) = (a + piece.from, a + piece.to);
                self.piece(piece, largest);
            }
        }
    }

    /// A part that no polynomial says anything of: an instant, or values that are not smooth for their rounding.
    fn by_its_end(&mut self, [from, to]: [f64; 2]) {
        let sign = self.sign_at(to);
        self.lost |= to - from > SHORT * self.line.length() && (sign != 0.0 || !self.rests(from));
        if sign == 0.0 {
            return self.rest(to);
        }
        self.turn([self.known, to], sign);
        self.stand(to, sign);
    }

    /// Whether the quantity may be zero at an instant but for rounding.
    fn rests(&mut self, tau: f64) -> bool {
        let value = self.line.output(tau, self.output).abs();
        let known = self.line.doubt(tau).get(self.output).copied().filter(|off| off.is_finite());
        let once = if known.is_none() || self.line.has_contacts() { ZERO * self.largest } else { 0.0 };
        value.is_nan() || value <= known.unwrap_or(0.0).max(once)
    }

    /// The first instant of a part at which the quantity has the sign, which it has at its end.
    fn taken(&mut self, [mut a, mut b]: [f64; 2], sign: f64) -> f64 {
        if self.line.output(a, self.output) * sign > 0.0 {
            return a;
        }
        loop {
            let middle = 0.5 * (a + b);
            if middle <= a || middle >= b {
                return b;
            }
            if self.line.output(middle, self.output) * sign > 0.0 { b = middle } else { a = middle }
        }
    }

    /// The instant in a part at which the quantity takes its last sign: that of the polynomial first, then its own.
    fn passed(&mut self, [from, to]: [f64; 2], sign: f64, (piece, stretch): (&Piece, Stretch)) -> f64 {
        if piece.row.len() == 2 {
            return self.taken([from, to], sign);
        }
        let width = piece.to - piece.from;
        let mut polynomial = |u: f64| crossings::value(&piece.row, u);
        let ends = [polynomial(stretch.from), polynomial(stretch.to)];
        let rough = piece.from + width * bracketed(&mut polynomial, (stretch.from, ends[0]), (stretch.to, ends[1]));
        let mut exact = |tau: f64| self.line.output(tau, self.output);
        // shares of the piece: the polynomial is true to nine digits at least where the step was taken
        for near in [1e-9 * width, width] {
            let (a, b) = ((rough - near).max(from), (rough + near).min(to));
            let (fa, fb) = (exact(a), exact(b));
            if fa * sign < 0.0 && fb * sign > 0.0 {
                let root = bracketed(&mut exact, (a, fa), (b, fb));
                let [before, after] = [root - 4.0 * f64::EPSILON * root.abs(), root + 4.0 * f64::EPSILON * root.abs()];
                // a flat root is closed in by its sign alone
                let sharp = exact(before) * sign <= 0.0 && exact(after) * sign >= 0.0;
                return if sharp { root } else { self.taken([a, b], sign) };
            }
        }
        rough
    }
}
