//! Whether a structure stands: mechanisms with their free motion, and the degree of statical indeterminacy.

use crate::Fault;
use crate::assembly::{Sparse, name_of};
use crate::freedoms::Freedom;
use crate::{Assembly, Frame, Scalar, dense, faults};
use algebra::Trouble;
use algebra::elementary;

/// Structures with more independent freedoms than this are computed with sparse matrices, and mechanisms are found by their factors.
pub const SEARCHED: usize = 100;

/// Exact numbers grow with every elimination: beyond this many independent freedoms machine numbers are used.
pub const EXACT: usize = 30;

/// How a structure stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// Unknown forces: three in each rod, less its hinges (one in a bar), and one for each held displacement and each spring.
    pub unknowns: usize,
    /// Equations of equilibrium of nodes and hinges.
    pub equations: usize,
    /// Free motions: displacements of all freedoms without any deformation.
    pub motions: Vec<Vec<f64>>,
}

impl Standing {
    /// Degree of statical indeterminacy: unknowns - equations + free motions.
    pub fn degree(&self) -> usize {
        (self.unknowns + self.motions.len()).saturating_sub(self.equations)
    }
}

/// Counts unknown forces, equations and free motions; rods undivided.
///
/// *Errors*: nodes without a rod, parts that hang together with no support.
pub fn standing<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>) -> Result<Standing, Fault> {
    connected(frame)?;
    let of_rods = frame.rods.iter().map(|rod| if rod.is_bar() { 1 } else { 3 }).sum::<usize>();
    let of_supports = frame.supports.iter().map(|s| s.holds.iter().filter(|h| **h).count()).sum::<usize>();
    let of_springs = frame.nodes.iter().flat_map(|n| &n.springs).filter(|s| !s.is_zero()).count();
    let idle = assembly.bonds.iter().filter(|b| **b == crate::assembly::Bond::Idle).count();
    // a hinged end has an own turn, whose equation says that it carries no moment
    // a point inside a rod divides nothing: its three equations meet three unknown forces more
    let inside = assembly.freedoms.meaning.iter().filter(|f| matches!(f, Freedom::Inner(..))).count();
    let equations = assembly.freedoms.meaning.len() - idle - inside;
    let motions = match assembly.n() {
        0 => Vec::new(),
        n if n <= SEARCHED => {
            let null = dense::null_space(&assembly.stiffness(frame).dense(), n);
            null.iter().map(|q| assembly.elimination.expand(q).iter().map(S::value).collect()).collect()
        }
        _ => free_motion(frame, assembly)?.into_iter().collect(),
    };
    Ok(Standing { unknowns: of_rods + of_supports + of_springs, equations, motions })
}

/// The first motion that the sparse factors find free.
fn free_motion<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>) -> Result<Option<Vec<f64>>, Fault> {
    let fine = frame.doubled();
    if let Some(factor) = crate::lowest::twofold(&Assembly::of(&fine).stiffness(&fine)).factor() {
        let expand = |motion: &[f64]| {
            assembly.elimination.transform.iter().map(|row| row.iter().map(|(j, c)| c.value() * motion[*j]).sum()).collect()
        };
        return Ok(factor.defect().map(|pivot| expand(&pivot.motion)));
    }
    let stiffness = assembly.stiffness(frame);
    let entries = stiffness.entries.iter().map(|(i, j, v)| (*i, *j, v.value())).collect();
    let matrix = crate::lowest::compressed(&Sparse { n: stiffness.n, entries })?;
    match matrix.factor() {
        Ok(_) => Ok(None),
        Err(Trouble::Pivot(pivot)) => {
            let expand = |row: &crate::constraints::Row<S>| row.iter().map(|(j, c)| c.value() * pivot.motion[*j]).sum();
            Ok(Some(assembly.elimination.transform.iter().map(expand).collect()))
        }
        Err(trouble) => Err(crate::matrices::told(trouble)),
    }
}

/// Every node has a rod, every connected piece something that holds it.
fn connected<S: Scalar>(frame: &Frame<S>) -> Result<(), Fault> {
    let n = frame.nodes.len();
    let mut piece: Vec<usize> = (0..n).collect();
    fn root(piece: &mut [usize], mut i: usize) -> usize {
        while piece[i] != i {
            piece[i] = piece[piece[i]];
            i = piece[i];
        }
        i
    }
    let mut touched = vec![false; n];
    for rod in &frame.rods {
        let (a, b) = (root(&mut piece, rod.ends[0]), root(&mut piece, rod.ends[1]));
        piece[a.max(b)] = a.min(b);
        rod.ends.iter().for_each(|i| touched[*i] = true);
    }
    let sprung = |i: usize| frame.nodes[i].springs.iter().any(|s| !s.is_zero());
    if let Some(i) = (0..n).find(|i| !touched[*i] && !sprung(*i)) {
        return Err(faults::lonely(&frame.nodes[i].name));
    }
    let mut held = vec![false; n];
    let holding = frame.supports.iter().filter(|s| s.holds.contains(&true)).map(|s| s.node).chain((0..n).filter(|i| sprung(*i)));
    for i in holding.collect::<Vec<_>>() {
        held[root(&mut piece, i)] = true;
    }
    match (0..n).find(|i| !held[root(&mut piece, *i)]) {
        Some(i) => Err(faults::unsupported(&frame.nodes[i].name)),
        None => Ok(()),
    }
}

/// A free motion in words: the node that moves most, how, and who moves with it.
pub fn describe<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, motion: &[f64]) -> (String, words::Text) {
    let nodes = frame.nodes.len();
    let size = |i: usize| (elementary::powi(motion[3 * i], 2) + elementary::powi(motion[3 * i + 1], 2)).sqrt();
    let largest = (0..nodes).fold(0.0_f64, |m, i| m.max(size(i)));
    let turns = (0..motion.len()).filter(|i| assembly.freedoms.used[*i] && name_is_turn(assembly, *i));
    let largest_turn = turns.clone().fold(0.0_f64, |m, i| m.max(motion[i].abs()));
    // places that move by rounding of a turn of the whole frame do not move
    if largest <= 1e-9 * largest_turn * span(frame) || largest == 0.0 {
        let i = turns.max_by(|i, j| motion[*i].abs().total_cmp(&motion[*j].abs())).unwrap_or(0);
        let name = name_of(frame, assembly.freedoms.meaning[i]);
        let node = node_of(frame, assembly, i);
        return (node, words::Text::new(format!("{name} is free"), format!("свободен поворот {name}")));
    }
    // nodes that move equally far differ by rounding: the first one is named
    let first = (0..nodes).find(|i| size(*i) >= (1.0 - 1e-9) * largest).unwrap_or(0);
    let list = |words: [&str; 3], and: &str| {
        // what a node moves by rounding is no movement
        let moving: Vec<usize> = (0..nodes).filter(|i| size(*i) > 1e-9 * largest).collect();
        let one = |i: &usize| {
            let (x, y) = (motion[3 * i] / largest, motion[3 * i + 1] / largest);
            // shares of the largest movement: rounding of the null vector is some 1e-12
            let direction = match (x.abs() > 1e-9, y.abs() > 1e-9) {
                (true, false) => words[0].to_owned(),
                (false, true) => words[1].to_owned(),
                _ => format!("{} ({x:.3}, {y:.3})", words[2]),
            };
            format!("{} {direction}", frame.nodes[*i].name)
        };
        let shown: Vec<String> = moving.iter().take(8).map(one).collect();
        let more = if moving.len() > 8 { format!("; {and} {}", moving.len() - 8) } else { String::new() };
        format!("{}{more}", shown.join("; "))
    };
    let text = words::Text::new(
        list(["moves along x", "moves along y", "moves along"], "more nodes:"),
        list(["движется вдоль x", "движется вдоль y", "движется вдоль"], "и ещё узлов:"),
    );
    (frame.nodes[first].name.clone(), text)
}

fn name_is_turn<S>(assembly: &Assembly<S>, i: usize) -> bool {
    matches!(assembly.freedoms.meaning[i], Freedom::Node(_, 2) | Freedom::Hinge(..) | Freedom::Inner(_, _, 2))
}

fn node_of<S>(frame: &Frame<S>, assembly: &Assembly<S>, i: usize) -> String {
    match assembly.freedoms.meaning[i] {
        Freedom::Node(node, _) => frame.nodes[node].name.clone(),
        Freedom::Hinge(rod, end) => frame.nodes[frame.rods[rod].ends[end]].name.clone(),
        Freedom::Inner(rod, ..) => frame.nodes[frame.rods[rod].ends[0]].name.clone(),
    }
}

/// Longest rod.
fn span<S: Scalar>(frame: &Frame<S>) -> f64 {
    frame.rods.iter().fold(0.0, |m, r| m.max(r.length.value()))
}

/// Stops at the first free motion.
///
/// *Errors*: a mechanism, with the node that moves.
pub fn stands<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>) -> Result<Standing, Fault> {
    let standing = standing(frame, assembly)?;
    match standing.motions.first() {
        Some(motion) => {
            let (node, words) = describe(frame, assembly, motion);
            Err(faults::mechanism(&node, &words, standing.motions.len()))
        }
        None => Ok(standing),
    }
}

/// Stops at the first free motion of an undivided frame: by exact numbers where these are few, else within rounding.
///
/// *Errors*: a mechanism, with the node that moves.
pub fn stands_undivided(frame: &Frame<f64>, exact: Option<&Frame<symbolic::Rational>>) -> Result<Standing, Fault> {
    let simple = frame.divided(1);
    let assembly = Assembly::of(&simple);
    match exact.filter(|_| assembly.n() <= EXACT) {
        Some(exact) => {
            let exact = exact.divided(1);
            stands(&exact, &Assembly::of(&exact))
        }
        None => {
            // springs far softer than the rods hold a frame too
            let fine = simple.doubled();
            stands(&fine, &Assembly::of(&fine))
        }
    }
}
