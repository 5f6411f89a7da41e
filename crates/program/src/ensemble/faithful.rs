//! Whether the series of a step can be believed, in all lanes: the first look of [`crate::jets`], which passes nearly always. A lane that it does not pass is looked at by the scalar check itself.

use super::layout::{Layout, Row, What};
use super::rows::{LANES, View};
use crate::curve::Curve;
use crate::jets::faithful::{NEAR, NOTHING, RATIO, Watch, Watched};
use crate::jets::steps::Rows;
use algebra::simd::{Lanes, Simd, Work, at_most, dispatch, less, plus, scaled, size, times, way, ways};

/// What is watched.
#[derive(Clone, Debug, Default)]
pub(super) struct Watches {
    /// Operations that can hide something.
    nodes: Vec<Watched>,
    /// Rows of which the way is wanted, and where each is among the ways.
    rows: Vec<Row>,
    places: Vec<u32>,
    ways: Vec<Lanes>,
    /// Of each lane the operations that matter in its modes, and the same by operation: 1 where it does.
    live: [Option<Vec<bool>>; LANES],
    matters: Vec<Lanes>,
    known: bool,
}

impl Watches {
    pub(super) fn forget(&mut self, lane: usize) {
        self.live[lane] = None;
    }

    fn learn(&mut self, ensemble: View<'_>) {
        let layout = ensemble.layout;
        if !self.known {
            self.known = true;
            self.nodes = nodes(ensemble.layout);
            self.rows = self.nodes.iter().flat_map(|node| [node.a, node.b, node.c]).collect();
            // rows of one length beside each other
            self.rows.sort_unstable_by_key(|row| (layout.degrees[*row as usize], *row));
            self.rows.dedup();
            self.places = vec![u32::MAX; layout.count as usize];
            self.rows.iter().zip(0..).for_each(|(row, place)| self.places[*row as usize] = place);
            self.matters = vec![[0.0; LANES]; self.nodes.len()];
        }
        for lane in 0..LANES {
            if self.live[lane].is_none() {
                let modes: Vec<u8> = ensemble.modes.0.iter().map(|sides| sides[lane]).collect();
                let live = layout.live(&modes);
                let live: Vec<bool> = self.nodes.iter().map(|node| live[node.c as usize]).collect();
                self.matters.iter_mut().zip(&live).for_each(|(matters, live)| matters[lane] = f64::from(u8::from(*live)));
                self.live[lane] = Some(live);
            }
        }
    }

    pub(super) fn faithful(&mut self, ensemble: View<'_>, lengths: &Lanes, tolerance: f64) -> [Option<f64>; LANES] {
        self.learn(ensemble);
        let mut ways = std::mem::take(&mut self.ways);
        ways.resize(self.rows.len(), [0.0; LANES]);
        let doubtful = dispatch(Look { watches: self, ensemble, lengths, tolerance, ways: &mut ways });
        self.ways = ways;
        std::array::from_fn(|lane| match doubtful[lane] {
            // an idle lane makes no step
            true if lengths[lane] > 0.0 => self.closely(ensemble, lane, (lengths[lane], tolerance)),
            _ => Some(lengths[lane]),
        })
    }

    /// The scalar check of a lane.
    #[inline(never)]
    fn closely(&self, ensemble: View<'_>, lane: usize, (h, tolerance): (f64, f64)) -> Option<f64> {
        let cells: Vec<f64> = ensemble.cells.iter().map(|lanes| lanes[lane]).collect();
        let live = self.live[lane].as_ref()?;
        let own = |node: &Watched| match node.curve {
            Curve::Power(_) => Watched { curve: Curve::Power(power_of(ensemble, node.c, lane)), ..*node },
            _ => *node,
        };
        let nodes = self.nodes.iter().zip(live).filter(|(_, live)| **live).map(|(node, _)| own(node)).collect();
        let mut watch = Watch::new(nodes, ensemble.layout.count as usize);
        // rates are known up to one order less than states
        let rows = Rows { cells: &cells, stride: ensemble.stride, count: ensemble.stride - 1 };
        let shorter = watch.faithful(rows, h, tolerance, 0.0);
        (!watch.held).then_some(shorter)
    }
}

fn power_of(ensemble: View<'_>, c: Row, lane: usize) -> f64 {
    let step = ensemble.layout.steps.iter().find(|step| step.row == c);
    match step.map(|step| &step.what) {
        Some(What::Power(_, p)) => ensemble.numbers[*p as usize][lane],
        _ => f64::NAN,
    }
}

/// The operations on the way to the rates that can hide something.
fn nodes(layout: &Layout) -> Vec<Watched> {
    let mut list = Vec::new();
    let mut watch = |curve, a, b, c| list.push(Watched { curve, a, b, c });
    for i in &layout.series {
        let step = &layout.steps[*i as usize];
        match &step.what {
            What::Multiply(a, b) => watch(Curve::Product, *a, *b, step.row),
            What::Square(a) => watch(Curve::Square, *a, *a, step.row),
            What::Divide(a, b) => watch(Curve::Quotient, *a, *b, step.row),
            What::Root(a) => watch(Curve::Root, *a, *a, step.row),
            What::Power(a, _) => watch(Curve::Power(f64::NAN), *a, *a, step.row),
            What::Exp(a) => watch(Curve::Exp, *a, *a, step.row),
            What::Log(a) => watch(Curve::Log, *a, *a, step.row),
            What::Tanh(a) => watch(Curve::Tanh, *a, *a, step.row),
            What::SinCos { a, hyperbolic: true } => {
                watch(Curve::Sinh, *a, *a, step.row);
                watch(Curve::Cosh, *a, *a, step.row + 1);
            }
            What::Solve { matrix, right } => {
                if let ([Some(entry)], [right]) = (&matrix[..], &right[..])
                    && layout.degrees[*entry as usize] > 0
                {
                    watch(Curve::Quotient, *right, *entry, step.row);
                }
            }
            _ => {}
        }
    }
    list
}

struct Look<'a> {
    watches: &'a Watches,
    ensemble: View<'a>,
    lengths: &'a Lanes,
    tolerance: f64,
    ways: &'a mut [Lanes],
}

impl Work for Look<'_> {
    type Output = [bool; LANES];

    /// Lanes in which an operation that matters may hide something.
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> [bool; LANES] {
        self.measure(simd);
        let mut doubts = [0.0; LANES];
        for (node, matters) in self.watches.nodes.iter().zip(&self.watches.matters) {
            let doubt = less(simd, &[1.0; LANES], &self.calm(simd, node));
            doubts = plus(simd, &doubts, &times(simd, matters, &doubt));
        }
        doubts.map(|doubt| doubt != 0.0)
    }
}

impl Look<'_> {
    /// Σ_{k>=1} |c_k| h^k of all rows that are watched.
    #[inline(always)]
    fn measure<S: Simd>(&mut self, simd: S) {
        let (ensemble, rows) = (self.ensemble, &self.watches.rows);
        let count = ensemble.stride - 1;
        let terms = |row: Row| &ensemble.row(row)[1..=ensemble.layout.degrees[row as usize].min(count - 1)];
        let mut i = 0;
        while i < rows.len() {
            let first = terms(rows[i]);
            match rows.get(i + 1).map(|row| terms(*row)).filter(|second| second.len() == first.len()) {
                Some(second) => {
                    [self.ways[i], self.ways[i + 1]] = ways(simd, [first, second], self.lengths);
                    i += 2;
                }
                None => {
                    self.ways[i] = way(simd, first, self.lengths);
                    i += 1;
                }
            }
        }
    }

    /// 1 in the lanes in which an operation hides nothing for sure, else 0.
    #[inline(always)]
    fn calm<S: Simd>(&self, simd: S, node: &Watched) -> Lanes {
        let nothing = [0.0; LANES];
        let (a, b, c) = (self.way(node.a), self.way(node.b), self.way(node.c));
        match node.curve {
            Curve::Product => self.seen(simd, node, &times(simd, a, b)),
            // an argument that does not move hides nothing
            Curve::Square => either(simd, &at_most(simd, a, &nothing), &self.seen(simd, node, &times(simd, a, a))),
            Curve::Quotient => at_most(simd, b, &scaled(simd, NEAR, &self.first(simd, node.b))),
            Curve::Root | Curve::Power(_) | Curve::Log => {
                let near = at_most(simd, a, &scaled(simd, NEAR, &self.first(simd, node.a)));
                let inside = times(simd, &above(simd, &self.ensemble.row(node.a)[0], &nothing), &above(simd, c, &nothing));
                either(simd, &at_most(simd, a, &nothing), &times(simd, &near, &inside))
            }
            Curve::Exp | Curve::Tanh | Curve::Sinh | Curve::Cosh => at_most(simd, a, &[1.0; LANES]),
            _ => nothing,
        }
    }

    #[inline(always)]
    fn way(&self, row: Row) -> &Lanes {
        &self.ways[self.watches.places[row as usize] as usize]
    }

    /// |c_0|.
    #[inline(always)]
    fn first<S: Simd>(&self, simd: S, row: Row) -> Lanes {
        size(simd, &self.ensemble.row(row)[0])
    }

    /// 1 where what can be cut off is small beside the result.
    #[inline(always)]
    fn seen<S: Simd>(&self, simd: S, node: &Watched, cross: &Lanes) -> Lanes {
        let (c, first) = (self.way(node.c), self.first(simd, node.c));
        let large = either(simd, &at_most(simd, cross, &scaled(simd, self.tolerance, &first)), &at_most(simd, cross, &[NOTHING; LANES]));
        either(simd, &large, &at_most(simd, cross, &scaled(simd, RATIO, c)))
    }
}

/// 1 where a > b, else 0.
#[inline(always)]
fn above<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    // b < a, and neither equal nor without a number
    times(simd, &at_most(simd, b, a), &less(simd, &[1.0; LANES], &at_most(simd, a, b)))
}

/// 1 where one of both is.
#[inline(always)]
fn either<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    less(simd, &plus(simd, a, b), &times(simd, a, b))
}
