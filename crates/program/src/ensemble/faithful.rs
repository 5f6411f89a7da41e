//! Whether the series of a step can be believed, in all lanes: the first look of [`crate::jets`], which passes nearly always. A lane that it does not pass is looked at by the scalar check itself.

use super::layout::{Layout, Row, What};
use super::rows::{LANES, View};
use crate::curve::Curve;
use crate::jets::faithful::{NEAR, NOTHING, RATIO, Watch, Watched};
use crate::jets::steps::Rows;
use algebra::simd::{Lanes, Simd, Work, dispatch, way};

/// What is watched.
#[derive(Clone, Debug, Default)]
pub(super) struct Watches {
    /// Operations that can hide something.
    nodes: Vec<Watched>,
    /// Rows of which the way is wanted, and where each is among the ways.
    rows: Vec<Row>,
    places: Vec<u32>,
    ways: Vec<Lanes>,
    /// Of each lane the operations that matter in its modes.
    live: [Option<Vec<bool>>; LANES],
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
            self.places = vec![u32::MAX; layout.count as usize];
            for node in &self.nodes {
                for row in [node.a, node.b, node.c] {
                    if self.places[row as usize] == u32::MAX {
                        self.places[row as usize] = self.rows.len() as u32;
                        self.rows.push(row);
                    }
                }
            }
        }
        for lane in 0..LANES {
            if self.live[lane].is_none() {
                let modes: Vec<u8> = ensemble.modes.0.iter().map(|sides| sides[lane]).collect();
                let live = layout.live(&modes);
                self.live[lane] = Some(self.nodes.iter().map(|node| live[node.c as usize]).collect());
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
    fn with_simd<S: Simd>(self, simd: S) -> [bool; LANES] {
        let count = self.ensemble.stride - 1;
        for (row, sum) in self.watches.rows.iter().zip(self.ways.iter_mut()) {
            // Σ_{k>=1} |c_k| h^k
            let last = self.ensemble.layout.degrees[*row as usize].min(count - 1);
            *sum = way(simd, &self.ensemble.row(*row)[1..=last], self.lengths);
        }
        let mut doubtful = [false; LANES];
        for (i, node) in self.watches.nodes.iter().enumerate() {
            for (lane, doubtful) in doubtful.iter_mut().enumerate() {
                let live = self.watches.live[lane].as_ref().is_some_and(|live| live[i]);
                *doubtful |= live && !self.is_calm(node, lane);
            }
        }
        doubtful
    }
}

impl Look<'_> {
    #[inline(always)]
    fn is_calm(&self, node: &Watched, lane: usize) -> bool {
        let way = |row: Row| self.ways[self.watches.places[row as usize] as usize][lane];
        let first = |row: Row| self.ensemble.row(row)[0][lane];
        let (a, c) = (way(node.a), way(node.c));
        if a == 0.0 && !node.curve.has_two() {
            return true;
        }
        let seen = |cross: f64| cross <= self.tolerance * first(node.c).abs() || cross <= NOTHING || cross <= RATIO * c;
        match node.curve {
            Curve::Product => seen(a * way(node.b)),
            Curve::Square => seen(a * a),
            Curve::Quotient => way(node.b) <= NEAR * first(node.b).abs(),
            Curve::Root | Curve::Power(_) | Curve::Log => a <= NEAR * first(node.a).abs() && first(node.a) > 0.0 && c > 0.0,
            Curve::Exp | Curve::Tanh | Curve::Sinh | Curve::Cosh => a <= 1.0,
            _ => false,
        }
    }
}
