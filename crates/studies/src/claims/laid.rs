//! The machine once more, with the terms of the claims for its outputs.

use crate::machine::build::numbered;
use crate::machine::{Machine, lower};
use analysis::{Fault, System};
use mechanics::derive::{Detail, derive_in};
use mechanics::model::{ClaimKind, Model, OutputDecl};
use symbolic::{Expr, Graph, Node, Rational, Substitution};
use words::{Notice, Text};

/// A formula of more terms is compared as a whole.
const MOST_TERMS: usize = 120;
/// Deepest nesting of sums that is taken apart.
const DEPTH: usize = 24;

/// The machine, and where the terms of each claim stand among its outputs.
pub struct Laid {
    /// With the terms as outputs.
    pub machine: Machine,
    /// By claim.
    pub claims: Vec<Terms>,
}

/// Terms of a claim.
#[derive(Clone, Debug, Default)]
pub struct Terms {
    /// The terms, in the graph of the machine above.
    pub terms: Vec<Expr>,
    /// Numbers of those with accelerations.
    pub anchors: Vec<usize>,
    /// What a formula or value is of.
    pub of: Option<Expr>,
    /// Terms of the machine's own equations, which may be missing.
    pub others: Vec<Expr>,
}

impl Terms {
    /// All expressions, in the order of the outputs.
    pub fn all(&self) -> impl Iterator<Item = Expr> {
        self.terms.iter().chain(&self.of).chain(&self.others).copied()
    }
}

/// Name of an output that belongs to a claim.
pub fn output_name(claim: usize, k: usize) -> String {
    format!("claim({claim},{k})")
}

impl Laid {
    /// Why a claim cannot be judged: a reaction in it has no value, as in a motion that asks for it.
    pub fn refusal(&self, claim: usize) -> Option<Fault> {
        let system = &self.machine.system;
        let place = |k: usize| system.outputs().iter().position(|q| q.name == output_name(claim, k));
        (0..self.claims[claim].all().count()).filter_map(place).find_map(|i| system.refusal(i))
    }
}

/// Derives the machine again with the terms of its claims.
///
/// # Errors
/// A formula of a claim has no meaning for this machine.
pub fn lay(machine: &Machine) -> Result<Laid, Notice> {
    let mut model = machine.model.clone();
    // the derived graph holds all expressions of the model and those of its equations
    model.graph = machine.equations.graph.clone();
    let own = own_terms(machine, &mut model.graph);
    let claims: Vec<Terms> = machine.model.claims.iter().map(|c| terms_of(&mut model, &c.kind, &own)).collect();
    model.outputs.clear();
    model.events.clear();
    model.observed.clear();
    for (i, terms) in claims.iter().enumerate() {
        for (k, formula) in terms.all().enumerate() {
            let name = output_name(i, k);
            let symbol = model.graph.symbol_id(&name, 0);
            let span = machine.model.claims[i].span.clone();
            model.outputs.push(OutputDecl { name, symbol, formula, unit: String::new(), display: None, label: Text::default(), span });
        }
    }
    let equations = derive_in(&model, Detail::Equations).map_err(|list| first(&list))?;
    let equations = numbered(&model, equations).map_err(Notice::from)?;
    let system = lower(&equations).map_err(Notice::from)?;
    let machine = Machine { model, equations, system, ..machine.clone() };
    Ok(Laid { machine, claims })
}

fn first(list: &[Notice]) -> Notice {
    match list.first() {
        Some(d) => Notice::new(d.code, d.what.en.clone(), d.what.ru.clone()).help(d.help.en.clone(), d.help.ru.clone()),
        None => Notice::new("C051", "a claim cannot be compared", "результат не с чем сопоставить"),
    }
}

/// The terms of the printed equations of motion.
fn own_terms(machine: &Machine, graph: &mut Graph) -> Vec<Expr> {
    let Ok(equalities) = &machine.equations.textbook else { return Vec::new() };
    // a published equation without reactions lacks no reaction
    let reactions: Vec<_> = machine.equations.reactions.iter().map(|r| r.symbol).collect();
    // but the friction of what slides has a formula that it may lack
    let mut rubbed = Substitution::new(crate::frictions::sliding(&machine.equations, graph));
    let sides = equalities.iter().flat_map(|e| [e.left, e.right]);
    let mut own: Vec<Expr> = Vec::new();
    for side in sides {
        for term in apart(graph, side) {
            let term = rubbed.apply(graph, term);
            let reacts = graph.symbols_in(&[term]).iter().any(|s| reactions.contains(s));
            if !reacts && !own.contains(&term) {
                own.push(term);
            }
        }
    }
    own.truncate(MOST_TERMS);
    own
}

fn terms_of(model: &mut Model, kind: &ClaimKind, own: &[Expr]) -> Terms {
    match kind {
        ClaimKind::Equation { left, right } => {
            let whole = model.graph.sub(*left, *right);
            let terms = flat(&mut model.graph, whole);
            let anchors = with_accelerations(model, &terms);
            Terms { terms, anchors, of: None, others: own.to_vec() }
        }
        ClaimKind::Formula { of, formula } => {
            let terms = apart(&mut model.graph, *formula);
            Terms { terms, of: Some(*of), ..Terms::default() }
        }
        ClaimKind::Value { of, .. } => Terms { of: Some(*of), ..Terms::default() },
        ClaimKind::Frequency { .. } | ClaimKind::FrequencyEquation { .. } => Terms::default(),
    }
}

/// Numbers of the terms that hold accelerations; of all when none does.
fn with_accelerations(model: &Model, terms: &[Expr]) -> Vec<usize> {
    let accelerations: Vec<_> = model.coordinates.iter().map(|c| c.symbols[2]).collect();
    let holds = |e: Expr| model.graph.symbols_in(&[e]).iter().any(|s| accelerations.contains(s));
    let found: Vec<usize> = (0..terms.len()).filter(|k| holds(terms[*k])).collect();
    if found.is_empty() { (0..terms.len()).collect() } else { found }
}

/// The summands, powers of sums multiplied out: such a power is rounding at its root, and nothing beside it would say of what.
pub(super) fn flat(graph: &mut Graph, whole: Expr) -> Vec<Expr> {
    let terms = apart(graph, whole);
    let is_power = |(base, exponent): &(Expr, Rational)| exponent.to_f64() > 1.0 && matches!(graph.node(*base), Node::Sum { .. });
    let folded = |e: &Expr| matches!(graph.node(*e), Node::Product { factors, .. } if factors.iter().any(is_power));
    if !terms.iter().any(folded) {
        return terms;
    }
    graph.expanded(whole, MOST_TERMS).map_or(terms, |whole| apart(graph, whole))
}

/// The summands of an expression, products of sums multiplied out.
fn apart(graph: &mut Graph, e: Expr) -> Vec<Expr> {
    let mut found = Vec::new();
    if spread(graph, e, DEPTH, &mut found) && !found.is_empty() { found } else { vec![e] }
}

/// Appends the summands; false when there are too many.
fn spread(graph: &mut Graph, e: Expr, depth: usize, found: &mut Vec<Expr>) -> bool {
    if found.len() > MOST_TERMS {
        return false;
    }
    match graph.node(e).clone() {
        Node::Sum { constant, terms } if depth > 0 => {
            if !constant.is_zero() {
                found.push(graph.number(constant));
            }
            terms.iter().all(|(term, factor)| {
                let scaled = graph.scale(*term, factor);
                spread(graph, scaled, depth - 1, found)
            })
        }
        Node::Product { coefficient, factors } if depth > 0 => {
            let is_sum = |(base, exponent): &(Expr, Rational)| exponent.is_one() && matches!(graph.node(*base), Node::Sum { .. });
            let Some(place) = factors.iter().position(is_sum) else {
                found.push(e);
                return true;
            };
            let rest: Vec<(Expr, Rational)> = factors.iter().enumerate().filter(|(i, _)| *i != place).map(|(_, f)| f.clone()).collect();
            let rest = graph.monomial(coefficient, &rest);
            let Node::Sum { constant, terms } = graph.node(factors[place].0).clone() else { return true };
            let mut parts = vec![graph.number(constant)];
            for (term, factor) in &terms {
                parts.push(graph.scale(*term, factor));
            }
            parts.into_iter().all(|part| {
                let product = graph.mul(rest, part);
                graph.is_zero(product) || product == e || spread(graph, product, depth - 1, found)
            })
        }
        _ => {
            if !graph.is_zero(e) {
                found.push(e);
            }
            true
        }
    }
}
