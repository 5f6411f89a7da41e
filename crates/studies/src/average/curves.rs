//! Speeds of steady turning over a parameter joined to curves: from value to value, and over folds.

/// A speed at a value, and whether it is stable.
pub(super) type Speed = (f64, bool);

/// A speed on a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knot {
    pub(super) value: f64,
    pub(super) speed: f64,
    /// None at a fold.
    pub(super) stable: Option<bool>,
}

/// What is stable, or what is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Stable,
    Unstable,
}

impl Knot {
    fn part(&self) -> Option<Part> {
        self.stable.map(|stable| if stable { Part::Stable } else { Part::Unstable })
    }
}

/// On which side of a fold its two speeds are, in the order of the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Before,
    Behind,
}

/// A fold between two values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bend {
    /// Position of the value before it.
    pub(super) behind: usize,
    pub(super) value: f64,
    pub(super) speed: f64,
    pub(super) side: Side,
}

/// Knots with their neighbours on a curve.
struct Net {
    knots: Vec<Knot>,
    links: Vec<Vec<usize>>,
}

impl Net {
    fn link(&mut self, a: usize, b: usize) {
        self.links[a].push(b);
        self.links[b].push(a);
    }

    /// Takes the knot of a part that is nearest to a speed out of a list.
    fn nearest(&self, list: &mut Vec<usize>, (speed, part): (f64, Part)) -> Option<usize> {
        let off = |k: usize| (self.knots[k].speed - speed).abs();
        let own = (0..list.len()).filter(|i| self.knots[list[*i]].part() == Some(part));
        let best = own.min_by(|a, b| off(list[*a]).total_cmp(&off(list[*b])))?;
        Some(list.remove(best))
    }

    /// What is left at two neighbouring values goes on with the same stability, in the order of the speeds; where one has more, those nearest to the other's.
    fn go_on(&mut self, old: &mut Vec<usize>, new: &mut Vec<usize>, part: Part) {
        let count = |net: &Net, list: &[usize]| list.iter().filter(|k| net.knots[**k].part() == Some(part)).count();
        let (few, many) = if count(self, old) <= count(self, new) { (old, new) } else { (new, old) };
        let own: Vec<usize> = few.iter().copied().filter(|k| self.knots[*k].part() == Some(part)).collect();
        let mut rest: Vec<usize> = Vec::new();
        if count(self, many) == own.len() {
            rest.extend(many.iter().copied().filter(|k| self.knots[*k].part() == Some(part)));
        } else {
            rest.extend(own.iter().filter_map(|k| self.nearest(many, (self.knots[*k].speed, part))));
        }
        own.into_iter().zip(rest).for_each(|(a, b)| self.link(a, b));
    }
}

/// The curves of the speeds at ascending or descending values, those of each value in the order of the speeds, and of the folds between them.
pub(super) fn joined(rows: &[(f64, Vec<Speed>)], bends: &[Bend]) -> Vec<Vec<Knot>> {
    let mut net = Net { knots: Vec::new(), links: Vec::new() };
    let mut ids: Vec<Vec<usize>> = Vec::with_capacity(rows.len());
    for (value, list) in rows {
        let first = net.knots.len();
        net.knots.extend(list.iter().map(|(speed, stable)| Knot { value: *value, speed: *speed, stable: Some(*stable) }));
        ids.push((first..net.knots.len()).collect());
    }
    let folds = net.knots.len();
    net.knots.extend(bends.iter().map(|bend| Knot { value: bend.value, speed: bend.speed, stable: None }));
    net.links = vec![Vec::new(); net.knots.len()];
    for k in 1..ids.len() {
        let (mut old, mut new) = (ids[k - 1].clone(), ids[k].clone());
        for (i, bend) in bends.iter().enumerate().filter(|(_, bend)| bend.behind + 1 == k) {
            for part in [Part::Stable, Part::Unstable] {
                let side = if bend.side == Side::Before { &mut old } else { &mut new };
                if let Some(end) = net.nearest(side, (bend.speed, part)) {
                    net.link(end, folds + i);
                }
            }
        }
        [Part::Stable, Part::Unstable].into_iter().for_each(|part| net.go_on(&mut old, &mut new, part));
    }
    traced(&net)
}

/// The knots along each curve; closed ones end where they begin.
fn traced(net: &Net) -> Vec<Vec<Knot>> {
    let mut seen = vec![false; net.knots.len()];
    let mut curves = Vec::new();
    let ends = (0..net.knots.len()).filter(|k| net.links[*k].len() < 2);
    for start in ends.chain(0..net.knots.len()) {
        if seen[start] {
            continue;
        }
        let (mut here, mut curve) = (Some(start), Vec::new());
        let mut last = start;
        while let Some(k) = here {
            seen[k] = true;
            curve.push(net.knots[k]);
            last = k;
            here = net.links[k].iter().copied().find(|next| !seen[*next]);
        }
        if curve.len() > 2 && net.links[last].contains(&start) && net.links[start].len() == 2 {
            curve.push(net.knots[start]);
        }
        curves.push(curve);
    }
    curves
}

/// Points between a fold and the speed next to it.
const BETWEEN: usize = 12;

/// What is drawn of one part of the curves: lines between their speeds, at folds the parabola through both ends whose tangent stands upright at the fold. NaN parts them.
pub(super) fn drawn(curves: &[Vec<Knot>], part: Part) -> [Vec<f64>; 2] {
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for curve in curves {
        let mut open = false;
        for pair in curve.windows(2) {
            let own = pair[0].part().or(pair[1].part()) == Some(part);
            if own && !open {
                x.push(pair[0].value);
                y.push(pair[0].speed);
            }
            if own {
                arc(pair[0], pair[1]).for_each(|[value, speed]| {
                    x.push(value);
                    y.push(speed);
                });
            } else if open {
                x.push(f64::NAN);
                y.push(f64::NAN);
            }
            open = own;
        }
        x.push(f64::NAN);
        y.push(f64::NAN);
    }
    [x, y]
}

/// From one knot to the next, without the first.
fn arc(from: Knot, to: Knot) -> impl Iterator<Item = [f64; 2]> {
    let parts = if from.stable.is_none() || to.stable.is_none() { BETWEEN } else { 1 };
    (1..=parts).map(move |j| {
        let share = j as f64 / parts as f64;
        let between = |a: f64, b: f64, share: f64| if share >= 1.0 { b } else { a + share * (b - a) };
        // v - v_f is as the square of s - s_f
        let bent = match (from.stable, to.stable) {
            (None, Some(_)) => share * share,
            (Some(_), None) => 1.0 - (1.0 - share) * (1.0 - share),
            _ => share,
        };
        [between(from.value, to.value, bent), between(from.speed, to.speed, share)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// v = s³ - 3s: three speeds for |v| < 2, folds at v = 2, s = -1 and v = -2, s = 1. One curve over both, whichever way the values go.
    #[test]
    fn an_s_is_one_curve_over_both_folds() {
        let speeds = |v: f64| -> Vec<Speed> {
            let f = |s: f64| s * s * s - 3.0 * s - v;
            let ends = [-4.0, -1.0, 1.0, 4.0];
            let parts = ends.windows(2).enumerate().filter(|(_, p)| (f(p[0]) > 0.0) != (f(p[1]) > 0.0));
            let root = |(k, p): (usize, &[f64])| {
                let (mut a, mut b) = (p[0], p[1]);
                for _ in 0..60 {
                    let c = 0.5 * (a + b);
                    if (f(c) > 0.0) == (f(a) > 0.0) { a = c } else { b = c }
                }
                (a, k != 1)
            };
            parts.map(root).collect()
        };
        for sense in [1.0, -1.0] {
            let rows: Vec<(f64, Vec<Speed>)> = (0..12).map(|k| sense * (f64::from(k) - 5.3)).map(|v| (v, speeds(v))).collect();
            let bend = |value: f64, speed: f64, side: Side| {
                let behind = rows.iter().rposition(|(v, _)| (v - value) * sense < 0.0).unwrap();
                Bend { behind, value, speed, side }
            };
            let bends = [bend(-2.0 * sense, sense, Side::Behind), bend(2.0 * sense, -sense, Side::Before)];
            let curves = joined(&rows, &bends);
            assert_eq!(curves.len(), 1, "{curves:?}");
            // along it the speed goes one way: no jump from one part to another
            let up = curves[0].last().unwrap().speed > curves[0][0].speed;
            assert!(curves[0].windows(2).all(|p| (p[1].speed > p[0].speed) == up), "{curves:?}");
            assert_eq!(curves[0].iter().filter(|knot| knot.stable.is_none()).count(), 2);
            // what is drawn lies near v = s³ - 3s: chords and parabolas over values one apart
            for part in [Part::Stable, Part::Unstable] {
                let [x, y] = drawn(&curves, part);
                let off = x.iter().zip(&y).filter(|(x, _)| x.is_finite()).map(|(x, y)| (y * y * y - 3.0 * y - x).abs());
                assert!(off.fold(0.0, f64::max) < 0.3);
                let beyond = |y: &f64| if part == Part::Stable { y.abs() >= 1.0 } else { y.abs() <= 1.0 };
                assert!(y.iter().filter(|y| y.is_finite()).all(beyond));
            }
        }
    }

    /// Where a speed leaves the range, the others go on with those nearest to them.
    #[test]
    fn a_speed_that_leaves_ends_its_curve() {
        let rows = [(0.0, vec![(1.0, true), (5.0, true)]), (1.0, vec![(1.2, true)]), (2.0, vec![(1.4, true)])];
        let curves = joined(&rows, &[]);
        let lengths: Vec<usize> = curves.iter().map(Vec::len).collect();
        assert_eq!(lengths, [3, 1]);
    }
}
