//! Elements whose forces are no straight lines over places and rates: what small motions leave out, by name.

use crate::connections::{self, Own};
use mechanics::Model;
use mechanics::model::{Class, ParameterValue, RequestKind};
use symbolic::{Expr, Function, Graph, Node, Substitution, SymbolId};
use words::Text;

/// The elements, in the order of the tables: springs with backlash, loads by formulas with |v| v or x³, frictions, stops.
pub fn elements(model: &Model) -> Vec<String> {
    let mut graph = model.graph.clone();
    let coordinates = model.coordinates.iter().flat_map(|c| c.symbols);
    let asked = model.requests.iter().filter(|r| !matches!(r.kind, RequestKind::Reaction(..))).map(|r| r.symbol);
    let states: Vec<SymbolId> = coordinates.chain(asked).collect();
    let opened = of_states(model, &mut graph);
    let mut curved = |list: &[Expr], degree: usize| {
        list.iter().any(|e| {
            let whole = Substitution::new(opened.iter().copied()).apply(&mut graph, *e);
            bends(&mut graph, whole, &states, degree)
        })
    };
    let mut names: Vec<String> = Vec::new();
    for (_, element) in model.acting() {
        let own = element.law.straight();
        // a load of the file may act in several parts
        if (own.switches || curved(&own.formulas, own.degree)) && !names.contains(&element.path) {
            names.push(element.path.clone());
        }
    }
    names.extend(model.connections.iter().filter(|c| connections::of(c).is_bent()).map(|c| Own::of(c).path));
    names
}

/// Parameters that depend on the motion, with their formulas over states.
fn of_states(model: &Model, graph: &mut Graph) -> Vec<(SymbolId, Expr)> {
    let mut opened: Vec<(SymbolId, Expr)> = Vec::new();
    for p in model.parameters.iter().filter(|p| p.class == Class::State) {
        if let ParameterValue::Formula(formula) = p.value {
            let whole = Substitution::new(opened.iter().copied()).apply(graph, formula);
            opened.push((p.symbol, whole));
        }
    }
    opened
}

/// The remark; none where every element is linear.
pub fn remark(model: &Model) -> Option<Text> {
    let list = elements(model).join(", ");
    (!list.is_empty()).then(|| {
        Text::new(
            format!("not linear in places and rates: {list}; small motions have their straight lines only, and the amplitudes hold as far as these; `periodic` has them whole"),
            format!("нелинейны по положениям и скоростям: {list}; в малых движениях от них остаются лишь касательные, и амплитуды верны, пока те годятся; `periodic` учитывает их полностью"),
        )
    })
}

/// Whether an expression is of higher degree in the states, or switches with them.
fn bends(graph: &mut Graph, e: Expr, states: &[SymbolId], degree: usize) -> bool {
    let is_state = |s: SymbolId| states.contains(&s);
    if !graph.contains(e, is_state) {
        return false;
    }
    if degree == 0 || graph.reachable(&[e]).into_iter().any(|part| switches(graph, part, &is_state)) {
        return true;
    }
    let own: Vec<SymbolId> = graph.symbols_in(&[e]).into_iter().filter(|s| is_state(*s)).collect();
    own.into_iter().any(|s| {
        let d = graph.derivative(e, s);
        bends(graph, d, states, degree - 1)
    })
}

fn switches(graph: &Graph, e: Expr, is_state: &dyn Fn(SymbolId) -> bool) -> bool {
    match graph.node(e) {
        Node::Switch { guard, .. } => graph.contains(*guard, is_state),
        Node::Call { function: Function::Abs | Function::Sign | Function::Min | Function::Max, arguments } => {
            arguments.iter().any(|a| graph.contains(*a, is_state))
        }
        _ => false,
    }
}
