//! Forces in the rods of a truss by hand: method of joints and method of sections (Ritter), as equations with their numbers.
//!
//! Both start from the loads and the reactions; forces of rods are tensions, so a rod pulls its node towards its other end.

use crate::statics::Statics;
use crate::{Action, Assembly, Frame, Place};

/// A term of an equation: coefficient times force, `cos·S`.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// What the force is called: a rod, a support, a load.
    pub name: String,
    /// Its coefficient.
    pub coefficient: f64,
    /// The force itself.
    pub force: f64,
    /// Whether the equation is solved for it.
    pub unknown: bool,
}

/// The equilibrium of a node along x and y.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Node.
    pub node: usize,
    /// Terms of Σx = 0 and of Σy = 0.
    pub equations: [Vec<Term>; 2],
    /// Rods found here: rod, tension.
    pub found: Vec<(usize, f64)>,
}

/// A cut through a truss and the equation that holds one unknown force.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The rod whose force it gives.
    pub rod: usize,
    /// All rods that are cut.
    pub cut: Vec<usize>,
    /// The point about which moments are taken; none for a projection across the other two, parallel rods.
    pub about: Option<[f64; 2]>,
    /// Nodes of the part that is looked at.
    pub nodes: Vec<usize>,
    /// Terms of the equation.
    pub equation: Vec<Term>,
    /// The tension.
    pub value: f64,
}

/// Whether all rods are bars and all loads act on nodes.
pub fn is_truss(frame: &Frame<f64>) -> bool {
    let on_node = |a: &Action<f64>| matches!(a, Action::Point { at: Place::Node(_), .. });
    frame.rods.iter().all(|r| r.is_bar()) && frame.loads.iter().all(|l| on_node(&l.action))
}

/// Forces on a node that are known: loads, springs, reactions, as named terms along x and y.
fn known(frame: &Frame<f64>, statics: &Statics<f64>, node: usize) -> [Vec<Term>; 2] {
    let mut out = [Vec::new(), Vec::new()];
    let largest = statics.ends.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    let mut put = |k: usize, name: &str, force: f64| {
        // a force that is rounding of the largest one is none
        if force.abs() > 1e-13 * largest {
            out[k].push(Term { name: name.to_owned(), coefficient: 1.0, force, unknown: false });
        }
    };
    for load in &frame.loads {
        if let Action::Point { at: Place::Node(i), value } = &load.action
            && *i == node
        {
            (0..2).for_each(|k| put(k, &load.name, value[k]));
        }
    }
    for (support, r) in frame.supports.iter().zip(&statics.reactions).filter(|(s, _)| s.node == node) {
        let [c, s] = support.axis;
        put(0, &format!("R_{}x", support.name), c * r[0] - s * r[1]);
        put(1, &format!("R_{}y", support.name), s * r[0] + c * r[1]);
    }
    (0..2).for_each(|k| put(k, "spring", statics.springs[node][k]));
    out
}

/// Direction of a rod away from a node.
fn away(frame: &Frame<f64>, rod: usize, node: usize) -> [f64; 2] {
    let r = &frame.rods[rod];
    let sign = if r.ends[0] == node { 1.0 } else { -1.0 };
    r.direction.map(|c| sign * c)
}

/// The method of joints: nodes in an order in which at most two rods are unknown at each; nodes that never come to that are left out.
pub fn joints(frame: &Frame<f64>, assembly: &Assembly<f64>, statics: &Statics<f64>) -> Vec<Joint> {
    let tension: Vec<f64> = (0..frame.rods.len()).map(|i| statics.normal(assembly, i)).collect();
    let at: Vec<Vec<usize>> =
        (0..frame.nodes.len()).map(|n| (0..frame.rods.len()).filter(|r| frame.rods[*r].ends.contains(&n)).collect()).collect();
    let mut solved = vec![false; frame.rods.len()];
    let mut visited = vec![false; frame.nodes.len()];
    let mut out = Vec::new();
    loop {
        let open = |n: usize| at[n].iter().filter(|r| !solved[**r]).count();
        let Some(node) = (0..frame.nodes.len()).find(|n| !visited[*n] && open(*n) <= 2) else { break };
        visited[node] = true;
        let mut equations = known(frame, statics, node);
        let found: Vec<(usize, f64)> = at[node].iter().filter(|r| !solved[**r]).map(|r| (*r, tension[*r])).collect();
        for rod in &at[node] {
            let direction = away(frame, *rod, node);
            for k in 0..2 {
                // components of a unit vector across an axis are rounding
                if direction[k].abs() > 1e-14 {
                    let name = frame.rods[*rod].name.clone();
                    equations[k].push(Term { name, coefficient: direction[k], force: tension[*rod], unknown: !solved[*rod] });
                }
            }
        }
        found.iter().for_each(|(rod, _)| solved[*rod] = true);
        out.push(Joint { node, equations, found });
    }
    out
}

/// Trusses with more rods than this are not searched for cuts.
const SEARCHED: usize = 80;

/// The method of sections: for each rod a cut through at most three rods that separates the truss, if there is one.
pub fn sections(frame: &Frame<f64>, statics: &Statics<f64>) -> Vec<Section> {
    let n = frame.rods.len();
    if n > SEARCHED {
        return Vec::new();
    }
    (0..n).filter_map(|rod| section(frame, statics, rod)).collect()
}

fn section(frame: &Frame<f64>, statics: &Statics<f64>, rod: usize) -> Option<Section> {
    let n = frame.rods.len();
    for second in (0..n).filter(|i| *i != rod) {
        for third in (second + 1..n).filter(|i| *i != rod) {
            let cut = [rod, second, third];
            let Some(nodes) = side(frame, &cut) else { continue };
            if nodes.len() < 2 || frame.nodes.len() - nodes.len() < 2 {
                continue;
            }
            let about = meeting(frame, second, third);
            let found = equation(frame, statics, (&cut, &nodes), about);
            if found.is_some() {
                return found;
            }
        }
    }
    None
}

/// The smaller side of a cut that separates the truss in two, each cut rod joining both.
fn side(frame: &Frame<f64>, cut: &[usize]) -> Option<Vec<usize>> {
    let n = frame.nodes.len();
    let mut reached = vec![false; n];
    let mut stack = vec![frame.rods[cut[0]].ends[0]];
    while let Some(node) = stack.pop() {
        if std::mem::replace(&mut reached[node], true) {
            continue;
        }
        let rods = frame.rods.iter().enumerate().filter(|(i, r)| !cut.contains(i) && r.ends.contains(&node));
        stack.extend(rods.map(|(_, r)| r.ends[0] + r.ends[1] - node));
    }
    if !cut.iter().all(|i| reached[frame.rods[*i].ends[0]] != reached[frame.rods[*i].ends[1]]) {
        return None;
    }
    let one: Vec<usize> = (0..n).filter(|i| reached[*i]).collect();
    let other: Vec<usize> = (0..n).filter(|i| !reached[*i]).collect();
    Some(if one.len() <= other.len() { one } else { other })
}

/// Where the lines of two rods meet; none when they are parallel.
fn meeting(frame: &Frame<f64>, a: usize, b: usize) -> Option<[f64; 2]> {
    let (ra, rb) = (&frame.rods[a], &frame.rods[b]);
    let (p, q) = (frame.nodes[ra.ends[0]].at, frame.nodes[rb.ends[0]].at);
    let ([ux, uy], [vx, vy]) = (ra.direction, rb.direction);
    let cross = ux * vy - uy * vx;
    // lines that meet a billion lengths away are parallel
    if cross.abs() < 1e-9 {
        return None;
    }
    let t = ((q[0] - p[0]) * vy - (q[1] - p[1]) * vx) / cross;
    Some([p[0] + t * ux, p[1] + t * uy])
}

fn equation(frame: &Frame<f64>, statics: &Statics<f64>, (cut, nodes): (&[usize; 3], &[usize]), about: Option<[f64; 2]>) -> Option<Section> {
    // coefficient of a force along x (k = 0) or y at a place
    let across = {
        let [c, s] = frame.rods[cut[1]].direction;
        [-s, c]
    };
    let coefficient = |k: usize, at: [f64; 2]| match about {
        Some(p) => [p[1] - at[1], at[0] - p[0]][k],
        None => across[k],
    };
    let mut terms = Vec::new();
    for node in nodes {
        let at = frame.nodes[*node].at;
        for (k, list) in known(frame, statics, *node).into_iter().enumerate() {
            terms.extend(list.into_iter().map(|t| Term { coefficient: coefficient(k, at), ..t }));
        }
    }
    let rod = cut[0];
    let ends = frame.rods[rod].ends;
    let own = if nodes.contains(&ends[0]) { ends[0] } else { ends[1] };
    let direction = away(frame, rod, own);
    let at = frame.nodes[own].at;
    let arm = coefficient(0, at) * direction[0] + coefficient(1, at) * direction[1];
    let size = frame.rods.iter().fold(0.0_f64, |m, r| m.max(r.length));
    // an unknown with this arm has no digits: another section is taken
    if arm.abs() < 1e-9 * if about.is_some() { size } else { 1.0 } {
        return None;
    }
    // arms of what passes through the point are rounding of the size of the truss
    terms.retain(|t| t.coefficient.abs() > 1e-12 * size);
    let sum: f64 = terms.iter().map(|t| t.coefficient * t.force).sum();
    let value = -sum / arm;
    debug_assert!(value.is_finite());
    terms.push(Term { name: frame.rods[rod].name.clone(), coefficient: arm, force: value, unknown: true });
    Some(Section { rod, cut: cut.to_vec(), about, nodes: nodes.to_vec(), equation: terms, value })
}
