//! Statics of a frame or truss: reactions, forces in rods with their diagrams, displacements, degree of indeterminacy; the flexibility matrix
//! by unit forces.

use crate::audits::worst;
use crate::dataset::{Audit, Column, Counter, Dataset};
use crate::{Fault, Quantity};
use algebra::arrange::Arrange;
use structures::equilibrium::{EXACT, SEARCHED, Standing, stands};
use structures::statics::{Solver, Statics, Station, dense_solver, product, solve, sparse_solver};
use structures::truss::{Joint, Section, is_truss, joints, sections};
use structures::{Action, Assembly, Component, Displacement, Frame, Load, Scalar};
use symbolic::Rational;
use words::Text;

/// Places between the ends of a part where a curved diagram is shown.
const BETWEEN: usize = 15;

/// Largest number of independent freedoms of a frame whose flexibility matrix is shown.
const FLEXIBLE: usize = 400;

/// What the study finds.
#[derive(Clone, Debug)]
pub struct StructureStatics {
    /// Stations of all rods, one after another.
    pub dataset: Dataset,
    /// Sums of loads and reactions.
    pub balance: Balance,
    /// How the structure stands.
    pub standing: Standing,
    /// The state.
    pub statics: Statics<f64>,
    /// The same in exact numbers when all data are rational.
    pub exact: Option<Statics<Rational>>,
    /// The undivided frame.
    pub frame: Frame<f64>,
    /// Its freedoms.
    pub assembly: Assembly<f64>,
    /// Diagrams by rod.
    pub diagrams: Vec<Vec<Station<f64>>>,
    /// Values of the named displacements.
    pub displacements: Vec<f64>,
    /// Method of joints, for a truss.
    pub joints: Vec<Joint>,
    /// Method of sections, for a truss.
    pub sections: Vec<Section>,
    /// Flexibility by unit forces along the named displacements.
    pub flexibility: Option<Flexibility<f64>>,
    /// The same, exact.
    pub exact_flexibility: Option<Flexibility<Rational>>,
}

/// A flexibility matrix by unit forces.
#[derive(Clone, Debug)]
pub struct Flexibility<S> {
    /// Diagrams: unit force, rod, stations.
    pub diagrams: Vec<Vec<Vec<Station<S>>>>,
    /// Springs of nodes that give way: node and component (x, y, turn).
    pub springs: Vec<(usize, usize)>,
    /// Products of diagrams: unit force i, unit force j, rod; then S_i S_j/c of each spring.
    pub products: Vec<Vec<Vec<S>>>,
    /// D, row by row: sums of products.
    pub matrix: Vec<S>,
    /// The displacements themselves, row by row: must be D.
    pub displacements: Vec<S>,
}

/// Statics under all loads; `exact` is the same frame in exact numbers when it has them.
///
/// *Errors*: mechanisms, loose nodes, forces that statics does not determine.
pub fn statics(frame: &Frame<f64>, exact: Option<&Frame<Rational>>) -> Result<StructureStatics, Fault> {
    let frame = frame.divided(1);
    let assembly = Assembly::of(&frame);
    let exact = exact.map(|e| e.divided(1)).filter(|_| assembly.n() <= EXACT);
    let exact_assembly = exact.as_ref().map(Assembly::of);
    let standing = match (&exact, &exact_assembly) {
        (Some(exact), Some(assembly)) => stands(exact, assembly)?,
        _ => stands(&frame, &assembly)?,
    };
    let exact_state = exact.as_ref().zip(exact_assembly.as_ref()).filter(|(e, _)| e.loads.len() == frame.loads.len());
    let exact_state = exact_state.map(|(e, a)| solve(e, a, &e.loads, &dense_solver(e, a))).transpose()?;
    let solver: Box<Solver<f64>> = match assembly.n() > SEARCHED {
        true => Box::new(sparse_solver(&frame, &assembly)?),
        false => Box::new(dense_solver(&frame, &assembly)),
    };
    let state = match &exact_state {
        Some(state) => state.machine(),
        None => solve(&frame, &assembly, &frame.loads, &*solver)?,
    };
    let diagrams: Vec<Vec<Station<f64>>> = (0..frame.rods.len()).map(|i| state.diagram(&assembly, i, BETWEEN)).collect();
    let small = assembly.n() <= FLEXIBLE && frame.displacements.len() <= 12;
    let flexibility = small.then(|| flexibility(&frame, &assembly, &*solver)).transpose()?;
    let exact_flexibility = exact.as_ref().zip(exact_assembly.as_ref()).filter(|_| small);
    let exact_flexibility = exact_flexibility.and_then(|(e, a)| self::flexibility(e, a, &dense_solver(e, a)).ok());
    drop(solver);
    let value = |d: &Displacement<f64>| {
        let row = assembly.functional(&frame, &d.place, &d.component);
        row.iter().map(|(i, c)| c * state.freedoms[*i]).sum()
    };
    let displacements = frame.displacements.iter().map(value).collect();
    let truss = is_truss(&frame);
    let (joints, sections) = if truss { (joints(&frame, &assembly, &state), sections(&frame, &state)) } else { (Vec::new(), Vec::new()) };
    let mut dataset = dataset(&diagrams, &standing);
    let balance = balance(&frame, &state);
    dataset.audits.extend(balance.audits());
    dataset.audits.extend(sections_agree(&sections, &state, &assembly));
    dataset.audits.extend(flexibility.as_ref().filter(|f| !f.matrix.is_empty()).map(products_agree));
    Ok(StructureStatics {
        dataset,
        balance,
        standing,
        exact: exact_state,
        diagrams,
        displacements,
        joints,
        sections,
        flexibility: flexibility.filter(|f| !f.matrix.is_empty()),
        exact_flexibility: exact_flexibility.filter(|f| !f.matrix.is_empty()),
        statics: state,
        frame,
        assembly,
    })
}

/// The flexibility matrix by unit forces along the named displacements.
///
/// *Errors*: as the statics.
pub fn flexibility<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, solver: &Solver<S>) -> Result<Flexibility<S>, Fault> {
    let n = frame.displacements.len();
    let springs: Vec<(usize, usize)> =
        (0..3 * frame.nodes.len()).map(|i| (i / 3, i % 3)).filter(|(i, k)| !frame.nodes[*i].springs[*k].is_zero()).collect();
    let (mut diagrams, mut held) = (Vec::new(), Vec::new());
    let mut displacements = vec![S::zero(); n * n];
    for (j, d) in frame.displacements.iter().enumerate() {
        let state = solve(frame, assembly, &[unit(d)], solver)?;
        diagrams.push((0..frame.rods.len()).map(|rod| state.stations(assembly, rod, 0)).collect::<Vec<_>>());
        held.push(springs.iter().map(|(i, k)| state.springs[*i][*k].clone()).collect::<Vec<S>>());
        for (i, other) in frame.displacements.iter().enumerate() {
            let row = assembly.functional(frame, &other.place, &other.component);
            displacements[i * n + j] = row.iter().fold(S::zero(), |sum, (k, c)| sum.add(&c.mul(&state.freedoms[*k])));
        }
    }
    common(&mut diagrams);
    let products: Vec<Vec<Vec<S>>> = (0..n)
        .map(|i| {
            let rods = |j: usize| (0..frame.rods.len()).map(move |r| (r, j));
            let bent = |(r, j): (usize, usize)| product(&frame.rods[r].kind, &diagrams[i][r], &diagrams[j][r]);
            // the spring's share of the work of the unit force: S_i S_j/c
            let sprung = |(s, j): (usize, usize)| {
                let (node, k) = springs[s];
                held[i][s].mul(&held[j][s]).div(&frame.nodes[node].springs[k])
            };
            (0..n).map(|j| rods(j).map(bent).chain((0..springs.len()).map(|s| sprung((s, j)))).collect()).collect()
        })
        .collect();
    let total = |k: usize| products[k / n][k % n].iter().fold(S::zero(), |sum, p| sum.add(p));
    let matrix = (0..n * n).map(total).collect();
    Ok(Flexibility { diagrams, springs, products, matrix, displacements })
}

/// A unit force along a displacement.
pub fn unit<S: Scalar>(d: &Displacement<S>) -> Load<S> {
    let value = match &d.component {
        Component::Along([c, s]) => [c.clone(), s.clone(), S::zero()],
        Component::Turn => [S::zero(), S::zero(), S::one()],
    };
    Load { name: d.name.clone(), action: Action::Point { at: d.place.clone(), value } }
}

/// Gives all diagrams of a rod the same stations: those with a concentrated force between nodes have more than the others.
fn common<S: Scalar>(diagrams: &mut [Vec<Vec<Station<S>>>]) {
    let rods = diagrams.first().map_or(0, Vec::len);
    for rod in 0..rods {
        let mut cuts: Vec<S> = diagrams.iter().flat_map(|d| d[rod].iter().map(|s| s.s.clone())).collect();
        cuts.arrange_by(|a, b| a.value().total_cmp(&b.value()));
        cuts.dedup();
        for diagram in diagrams.iter_mut() {
            diagram[rod] = resampled(&diagram[rod], &cuts);
        }
    }
}

/// The diagram at both sides of every cut.
fn resampled<S: Scalar>(diagram: &[Station<S>], cuts: &[S]) -> Vec<Station<S>> {
    let mut out = Vec::new();
    for pair in cuts.windows(2) {
        let middle = pair[0].add(&pair[1]).mul(&S::ratio(1, 2)).value();
        let piece = diagram.windows(2).find(|w| w[0].s.value() <= middle && middle <= w[1].s.value());
        let Some([a, b]) = piece else { continue };
        for s in pair {
            let share = s.sub(&a.s).div(&b.s.sub(&a.s));
            let mix = |x: &S, y: &S| x.add(&y.sub(x).mul(&share));
            let (normal, shear, moment) = (mix(&a.normal, &b.normal), mix(&a.shear, &b.shear), mix(&a.moment, &b.moment));
            out.push(Station { s: s.clone(), normal, shear, moment });
        }
    }
    out
}

/// Sums along x and y and of moments about the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// Of all loads.
    pub loads: [f64; 3],
    /// Of all supports and springs.
    pub reactions: [f64; 3],
    /// Of the absolute values of all terms.
    pub sizes: [f64; 3],
}

impl Balance {
    /// What is left of each sum, relative to its terms, each with its own size.
    fn audits(&self) -> [Audit; 2] {
        let left = |k: usize| (self.loads[k] + self.reactions[k]).abs();
        let over = |rest: f64, size: f64| if size > 0.0 { rest / size } else { rest };
        let forces = over(left(0).max(left(1)), self.sizes[0].max(self.sizes[1]));
        [
            // rounding of a frame is 1e-13 of its terms, a forgotten load the whole
            Audit::at_most("balance", Text::new("balance of loads and reactions", "равновесие нагрузок и реакций"), forces, 1e-9),
            Audit::at_most(
                "balance_moments",
                Text::new("balance of moments of loads and reactions", "равновесие моментов нагрузок и реакций"),
                over(left(2), self.sizes[2]),
                // as above
                1e-9,
            ),
        ]
    }
}

/// Sum of all loads and reactions, forces and moments about the origin.
fn balance(frame: &Frame<f64>, state: &Statics<f64>) -> Balance {
    let mut balance = Balance::default();
    let mut sizes = [0.0_f64; 3];
    let mut sums = [0.0_f64; 3];
    let mut add = |at: [f64; 2], f: [f64; 3]| {
        let terms = [[f[0], 0.0, 0.0], [f[1], 0.0, 0.0], [f[2], at[0] * f[1], -at[1] * f[0]]];
        for k in 0..3 {
            sums[k] += terms[k].iter().sum::<f64>();
            sizes[k] += terms[k].iter().map(|t| t.abs()).sum::<f64>();
        }
        sums
    };
    for load in &frame.loads {
        match &load.action {
            Action::Point { at, value } => {
                add(point(frame, at), *value);
            }
            Action::Distributed { rod, value } => {
                let r = &frame.rods[*rod];
                let start = frame.nodes[r.ends[0]].at;
                // two trapezium halves: q0 acts like q0 l/2 at l/3, q1 like q1 l/2 at 2l/3
                for (share, q) in [(1.0 / 3.0, value[0]), (2.0 / 3.0, value[1])] {
                    let at = [0, 1].map(|k| start[k] + share * r.length * r.direction[k]);
                    add(at, [q[0] * r.length / 2.0, q[1] * r.length / 2.0, 0.0]);
                }
            }
        }
    }
    balance.loads = add([0.0; 2], [0.0; 3]);
    let mut sums = balance.loads;
    for (support, r) in frame.supports.iter().zip(&state.reactions) {
        let [c, s] = support.axis;
        sums = add(frame.nodes[support.node].at, [c * r[0] - s * r[1], s * r[0] + c * r[1], r[2]]);
    }
    for (node, f) in frame.nodes.iter().zip(&state.springs) {
        sums = add(node.at, *f);
    }
    balance.reactions = [0, 1, 2].map(|k| sums[k] - balance.loads[k]);
    balance.sizes = sizes;
    balance
}

fn point(frame: &Frame<f64>, place: &structures::Place<f64>) -> [f64; 2] {
    match place {
        structures::Place::Node(i) => frame.nodes[*i].at,
        structures::Place::Rod(i, s) => {
            let r = &frame.rods[*i];
            [0, 1].map(|k| frame.nodes[r.ends[0]].at[k] + s * r.direction[k])
        }
    }
}

fn sections_agree(sections: &[Section], state: &Statics<f64>, assembly: &Assembly<f64>) -> Option<Audit> {
    let largest = sections.iter().map(|s| s.value.abs()).fold(0.0, f64::max);
    let worst = worst(sections.iter().map(|s| (s.value - state.normal(assembly, s.rod)).abs()));
    let name = Text::new("method of sections against the others", "метод сечений в сравнении с методом вырезания узлов");
    // as above, two ways to one force
    (!sections.is_empty() && largest > 0.0).then(|| Audit::at_most("sections", name, worst / largest, 1e-9))
}

fn products_agree(flexibility: &Flexibility<f64>) -> Audit {
    let largest = flexibility.matrix.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let pairs = flexibility.matrix.iter().zip(&flexibility.displacements);
    let worst = worst(pairs.map(|(a, b)| (a - b).abs()));
    let name = Text::new("products of diagrams against displacements", "перемножение эпюр в сравнении с перемещениями");
    // as above, two ways to one displacement
    Audit::at_most("flexibility", name, if largest > 0.0 { worst / largest } else { worst }, 1e-9)
}

fn dataset(diagrams: &[Vec<Station<f64>>], standing: &Standing) -> Dataset {
    let labelled = |name: &str, unit: &str, en: &str, ru: &str| Quantity { label: Text::new(en, ru), ..Quantity::new(name, unit) };
    let all = || diagrams.iter().enumerate().flat_map(|(i, d)| d.iter().map(move |s| (i, s)));
    let column = |quantity: Quantity, value: &dyn Fn(usize, &Station<f64>) -> f64| Column {
        quantity,
        values: all().map(|(i, s)| value(i, s)).collect(),
    };
    let columns = vec![
        column(labelled("rod", "1", "number of the rod", "номер стержня"), &|i, _| (i + 1) as f64),
        column(labelled("s", "m", "distance from the start of the rod", "расстояние от начала стержня"), &|_, s| s.s),
        column(labelled("N", "N", "normal force", "продольная сила"), &|_, s| s.normal),
        column(labelled("V", "N", "shear force", "поперечная сила"), &|_, s| s.shear),
        column(labelled("M", "N m", "bending moment", "изгибающий момент"), &|_, s| s.moment),
    ];
    let counters = vec![Counter {
        key: "indeterminacy",
        name: Text::new("degree of statical indeterminacy", "степень статической неопределимости"),
        value: standing.degree() as f64,
    }];
    Dataset { columns, counters, ..Dataset::default() }
}
