//! Statics of the structure of a model.

use crate::frame::bind::{Bound, bind};
use crate::frame::coordinates::{is_bare, moves};
use crate::machine::Machine;
use analysis::studies::structure_statics::{self, StructureStatics};
use mechanics::structure::Structure;
use report::number::significant;
use serde_json::{Map, Value, json};
use structures::statics::Station;
use words::{Notice, Text};

/// The study.
pub const NAME: &str = "statics";

/// What was found, with the numbers it was found from.
#[derive(Clone, Debug)]
pub struct Found {
    /// The structure in numbers.
    pub bound: Bound,
    /// The state.
    pub result: StructureStatics,
}

/// Statics under all loads at t = 0; with a machine on the structure also under what the machine exerts at rest.
///
/// # Errors
/// Mechanisms, loose nodes, forces that statics does not determine; no place of rest of the machine; S104.
pub fn find(machine: &Machine, structure: &Structure) -> Result<Found, Box<Notice>> {
    let model = &machine.model;
    let mut bound = bind(model, structure);
    let trouble = |f| Box::new(Notice::from(f));
    let mut result = structure_statics::statics(&bound.frame, bound.exact.as_ref()).map_err(trouble)?;
    let moving = structure.loads.iter().any(|l| moves(model, l));
    if !is_bare(model) {
        let forces = exerted(machine, structure, &result)?;
        if !forces.is_empty() {
            let list = |language| {
                let one = |(l, v): &(structures::Load<f64>, f64)| format!("{} {}", l.name, significant(*v, 6, language));
                forces.iter().map(one).collect::<Vec<_>>().join("; ")
            };
            let (en, ru) = (list(words::Language::En), list(words::Language::Ru));
            bound.frame.loads.extend(forces.into_iter().map(|(load, value)| scaled(load, value)));
            result = structure_statics::statics(&bound.frame, None).map_err(trouble)?;
            result.dataset.notes.push(Text::new(
                format!("the machine at rest (repeating loads by their means) acts along the named displacements: {en} (N, N m)"),
                format!("механизм в покое (повторяющиеся нагрузки — средними) действует вдоль именованных перемещений: {ru} (Н, Н·м)"),
            ));
        }
    }
    if moving {
        result
            .dataset
            .notes
            .push(Text::new("loads that depend on time are taken at t = 0", "нагрузки, зависящие от времени, взяты при t = 0"));
    }
    Ok(Found { bound, result })
}

/// Forces of the machine at rest along the displacements that it acts on: those which move the loaded structure from where its own loads
/// leave it, D F = u - u₀, to where the whole machine rests.
fn exerted(machine: &Machine, structure: &Structure, bare: &StructureStatics) -> Result<Vec<(structures::Load<f64>, f64)>, Box<Notice>> {
    let frame = &bare.frame;
    let names = |i: &usize| machine.model.coordinates.iter().position(|c| c.name == frame.displacements[*i].name);
    let loaded: Vec<usize> = (0..frame.displacements.len()).filter(|i| frame.displacements[*i].loaded).collect();
    if loaded.is_empty() {
        return Ok(Vec::new());
    }
    let places: Option<Vec<usize>> = loaded.iter().map(names).collect();
    let moving = structure.loads.iter().any(|l| moves(&machine.model, l));
    let (Some(places), Some(flexibility), false) = (places, &bare.flexibility, moving) else { return Err(Box::new(apart())) };
    let small = crate::small::about_rest(machine, &[]).map_err(|f| Box::new(Notice::from(f)))?;
    let all = frame.displacements.len();
    let gaps: Vec<f64> = loaded.iter().zip(&places).map(|(i, q)| small.place.q[*q] - bare.displacements[*i]).collect();
    let d: Vec<f64> = loaded.iter().flat_map(|i| loaded.iter().map(move |j| flexibility.displacements[i * all + j])).collect();
    let forces = structures::dense::solve(&d, loaded.len(), &gaps, 1).ok_or_else(|| Box::new(apart()))?;
    let load = |i: usize| structure_statics::unit(&frame.displacements[i]);
    Ok(loaded.into_iter().zip(forces).filter(|(_, f)| *f != 0.0).map(|(i, f)| (load(i), f)).collect())
}

fn scaled(mut load: structures::Load<f64>, factor: f64) -> structures::Load<f64> {
    if let structures::Action::Point { value, .. } = &mut load.action {
        value.iter_mut().for_each(|v| *v *= factor);
    }
    load
}

/// The machine's forces on the structure are not to be had.
fn apart() -> Notice {
    Notice::new(
        "S104",
        "statics of the structure alone would leave out the machine that stands on it",
        "статика одной конструкции не учла бы стоящего на ней механизма",
    )
    .why(
        "what the machine exerts is found from the displacements of both at rest; here loads depend on time, displacements hang together, \
         or the structure is too large for its flexibility matrix",
        "действие механизма находится по перемещениям в покое; здесь нагрузки зависят от времени, перемещения зависимы или конструкция \
         слишком велика для матрицы податливости",
    )
    .help(
        "`strutt equilibrium` gives the displacements of both; or give the machine's forces as loads of the structure",
        "`strutt equilibrium` даёт перемещения того и другого; либо задайте силы механизма как нагрузки конструкции",
    )
}

/// The study's own fields of JSON.
pub fn fields(found: &Found) -> Map<String, Value> {
    let r = &found.result;
    let mut own = Map::new();
    own.insert("degree_of_indeterminacy".into(), json!(r.standing.degree()));
    own.insert("unknown_forces".into(), json!(r.standing.unknowns));
    own.insert("equations_of_equilibrium".into(), json!(r.standing.equations));
    own.insert("mechanisms".into(), json!(r.standing.motions.len()));
    own.insert("reactions".into(), Value::Object(reactions(r)));
    own.insert("springs".into(), Value::Object(springs(r)));
    let sums = |v: [f64; 3]| json!({"x": v[0], "y": v[1], "turn": v[2]});
    own.insert("balance".into(), json!({"loads": sums(r.balance.loads), "reactions": sums(r.balance.reactions)}));
    let normal = |i: usize| r.statics.normal(&r.assembly, i);
    let forces: Map<String, Value> = r.frame.rods.iter().enumerate().map(|(i, rod)| (rod.name.clone(), json!(normal(i)))).collect();
    own.insert("forces".into(), Value::Object(forces));
    own.insert("rods".into(), Value::Object(r.frame.rods.iter().zip(&r.diagrams).map(|(rod, d)| (rod.name.clone(), diagram(d))).collect()));
    let displacements = r.frame.displacements.iter().zip(&r.displacements);
    own.insert("displacements".into(), Value::Object(displacements.map(|(d, v)| (d.name.clone(), json!(v))).collect()));
    let node =
        |i: usize| json!({"x": r.statics.freedoms[3 * i], "y": r.statics.freedoms[3 * i + 1], "turn": r.statics.freedoms[3 * i + 2]});
    let nodes: Map<String, Value> = r.frame.nodes.iter().enumerate().map(|(i, n)| (n.name.clone(), node(i))).collect();
    own.insert("nodes".into(), Value::Object(nodes));
    if let Some(f) = &r.flexibility {
        let n = r.frame.displacements.len();
        own.insert("flexibility_matrix".into(), f.matrix.chunks(n).map(|row| json!(row)).collect());
    }
    if let Some(f) = &r.exact_flexibility {
        let n = r.frame.displacements.len();
        let rows = f.matrix.chunks(n).map(|row| row.iter().map(|v| json!(v.to_string())).collect::<Value>());
        own.insert("exact_flexibility_matrix".into(), rows.collect());
    }
    if !r.joints.is_empty() {
        let joint = |j: &structures::truss::Joint| {
            let found: Map<String, Value> = j.found.iter().map(|(i, v)| (r.frame.rods[*i].name.clone(), json!(v))).collect();
            json!({"node": r.frame.nodes[j.node].name, "equations": j.equations.iter().map(|e| super::terms::equation(e, words::Language::En)).collect::<Vec<_>>(), "found": found})
        };
        own.insert("joints".into(), r.joints.iter().map(joint).collect());
        let section = |s: &structures::truss::Section| {
            let names: Vec<&str> = s.cut.iter().map(|i| r.frame.rods[*i].name.as_str()).collect();
            json!({"rod": names[0], "cut": names, "about": s.about, "equation": super::terms::equation(&s.equation, words::Language::En), "force": s.value})
        };
        own.insert("sections".into(), r.sections.iter().map(section).collect());
    }
    own
}

/// Reactions along the ground axes and couples, only what a support holds.
fn reactions(r: &StructureStatics) -> Map<String, Value> {
    let one = |(support, f): (&structures::Support<f64>, &[f64; 3])| {
        let [c, s] = support.axis;
        let mut own = Map::new();
        let (x, y) = (c * f[0] - s * f[1], s * f[0] + c * f[1]);
        if support.holds[0] || support.holds[1] {
            own.insert("x".into(), json!(x));
            own.insert("y".into(), json!(y));
        }
        if support.holds[2] {
            own.insert("turn".into(), json!(f[2]));
        }
        (support.name.clone(), Value::Object(own))
    };
    r.frame.supports.iter().zip(&r.statics.reactions).map(one).collect()
}

/// Forces of springs on their nodes.
fn springs(r: &StructureStatics) -> Map<String, Value> {
    let one = |(node, f): (&structures::Node<f64>, &[f64; 3])| {
        let parts = ["x", "y", "turn"].iter().zip(f).zip(&node.springs).filter(|(_, s)| **s != 0.0);
        let own: Map<String, Value> = parts.map(|((key, f), _)| ((*key).to_owned(), json!(f))).collect();
        (!own.is_empty()).then(|| (node.name.clone(), Value::Object(own)))
    };
    r.frame.nodes.iter().zip(&r.statics.springs).filter_map(one).collect()
}

fn diagram(d: &[Station<f64>]) -> Value {
    let list = |f: fn(&Station<f64>) -> f64| d.iter().map(f).collect::<Vec<_>>();
    // the value of greatest magnitude, with its sign
    let most = |f: fn(&Station<f64>) -> f64| d.iter().map(f).fold(0.0, |most: f64, v| if v.abs() > most.abs() { v } else { most });
    json!({"s": list(|s| s.s), "N": list(|s| s.normal), "V": list(|s| s.shear), "M": list(|s| s.moment),
        "N_max": most(|s| s.normal), "V_max": most(|s| s.shear), "M_max": most(|s| s.moment)})
}
