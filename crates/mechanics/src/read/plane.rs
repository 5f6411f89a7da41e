//! Frames and trusses are plane: what a file says about the third axis must be zero. And their own weight, as loads.

use crate::reader::syntax::Value;
use crate::reader::{Fields, Reader};
use crate::structure::{Action, Load, Site};
use symbolic::Expr;
use words::Notice;

/// The components along x and y of a vector of a plane structure.
///
/// *Errors*: M305 when the third one is not zero; one that depends on time must be zero as it is written.
pub(super) fn along<'a>(reader: &mut Reader<'a>, value: &Value<'a>, [x, y, z]: [Expr; 3]) -> [Expr; 2] {
    flat(reader, value, z);
    [x, y]
}

/// The component about z of a couple: the other two must be zero.
pub(super) fn about<'a>(reader: &mut Reader<'a>, value: &Value<'a>, [x, y, z]: [Expr; 3]) -> Expr {
    flat(reader, value, x);
    flat(reader, value, y);
    z
}

fn flat<'a>(reader: &mut Reader<'a>, value: &Value<'a>, component: Expr) {
    let graph = &reader.builder.graph;
    if graph.is_zero(component) {
        return;
    }
    let moves = graph.symbols_in(&[component]).contains(&reader.builder.time);
    if !moves && reader.values.of(graph, component) == 0.0 {
        return;
    }
    let fault = Notice::piece(
        "M305",
        value.span(),
        "frames and trusses are plane: this component out of the plane x, y is not zero",
        "рамы и фермы плоские: эта составляющая вне плоскости x, y не равна нулю",
    )
    .why(
        "nodes, forces and displacements of a structure lie in the plane x, y, couples turn about z",
        "узлы, силы и перемещения конструкции лежат в плоскости x, y, моменты действуют вокруг z",
    )
    .help(
        "leave the component out, or split the structure into plane frames",
        "уберите эту составляющую или разбейте конструкцию на плоские рамы",
    );
    reader.fault(fault);
}

/// The weight of nodes and rods under an acceleration of gravity: m g at nodes, m g of a unit of length along rods.
pub(super) fn weight<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, gravity: [Expr; 3]) {
    let heavy = |reader: &Reader, mass: Expr| !reader.builder.graph.is_zero(mass);
    let nodes: Vec<(String, Expr)> = reader.structure.nodes.iter().map(|n| (n.name.clone(), n.mass)).collect();
    let rods: Vec<(String, Expr)> = reader.structure.rods.iter().map(|r| (r.name.clone(), r.mass)).collect();
    if !nodes.iter().chain(&rods).any(|(_, mass)| heavy(reader, *mass)) {
        return;
    }
    let g = match top.get("gravity") {
        Some(value) => along(reader, value, gravity),
        None => [gravity[0], gravity[1]],
    };
    let zero = reader.builder.graph.zero();
    let force = |reader: &mut Reader, mass: Expr| g.map(|a| reader.builder.graph.mul(mass, a));
    for (i, (name, mass)) in nodes.into_iter().enumerate().filter(|(_, n)| !reader.builder.graph.is_zero(n.1)).collect::<Vec<_>>() {
        let [x, y] = force(reader, mass);
        let action = Action::Point { site: Site::Node(i), value: [x, y, zero] };
        reader.structure.loads.push(Load::of("nodes", &format!("weight_{name}"), action));
    }
    for (rod, (name, mass)) in rods.into_iter().enumerate().filter(|(_, r)| !reader.builder.graph.is_zero(r.1)).collect::<Vec<_>>() {
        let value = force(reader, mass);
        let action = Action::Distributed { rod, value: [value, value] };
        reader.structure.loads.push(Load::of("rods", &format!("weight_{name}"), action));
    }
}
