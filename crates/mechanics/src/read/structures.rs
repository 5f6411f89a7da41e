//! `[nodes]`, `[rods]`, `[supports]`, `[distributed]`, `[displacements]`, `[structure]`, and the forces and torques that act on nodes and rods.
//!
//! The tables `rods` and `supports` also hold connections of bodies: a row whose ends are points of bodies is not touched here.

mod loads;
mod owner;
mod quantities;

pub(super) use loads::takes;
pub(super) use owner::{Owner, rows};

use crate::fields;
use crate::formula::Context;
use crate::reader::names::two_names;
use crate::reader::{Fields, Reader, short, wrong_type};
use crate::section::Section;
use crate::structure::{Node, Options, Rod, Structure, Support};
use crate::units::Dimension;
use loads::{displacements, distributed, rayleigh};
use quantities::{not_negative, plane_vector, positive, unknown_node, words};
use symbolic::Expr;
use toml::de::DeValue;
use words::{Notice, digits};

const BENDING: Dimension = Dimension::of(3, 1, -2);
const PRESSURE: Dimension = Dimension::of(-1, 1, -2);
const SECOND_MOMENT: Dimension = Dimension::of(4, 0, 0);
const AREA: Dimension = Dimension::of(2, 0, 0);
const STIFFNESS: Dimension = Dimension::of(0, 1, -2);
const DENSITY: Dimension = Dimension::of(-3, 1, 0);
const LINE_MASS: Dimension = Dimension::of(-1, 1, 0);

/// Most parts of a rod.
const PARTS: i64 = 100_000;

/// Share of I_x that free skew bending takes away in a section whose axes are not principal.
const SKEW: f64 = 1e-3;

/// `[nodes]`.
pub(super) fn nodes<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, sections: &[Section]) {
    reader.structure.sections = sections.iter().map(|s| (s.name.clone(), (s.area(), s.inertia()))).collect();
    let skew = |s: &&Section| {
        let [xx, yy, xy] = s.properties.central;
        xy * xy > SKEW * xx * yy
    };
    reader.structure.skew = sections.iter().filter(skew).map(|s| (s.name.clone(), s.properties.central)).collect();
    for (name, fields) in top.entries(reader, "nodes", &fields::structures::NODE) {
        if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            continue;
        }
        let at = plane_vector(reader, &fields, "at", &Context::CONSTANT, &Dimension::LENGTH);
        let mass = not_negative(reader, &fields, "mass", &Dimension::MASS);
        let inertia = not_negative(reader, &fields, "inertia", &Dimension::INERTIA);
        let springs = [("spring_x", STIFFNESS), ("spring_y", STIFFNESS), ("spring_turn", Dimension::ENERGY)];
        let springs = springs.map(|(key, dimension)| not_negative(reader, &fields, key, &dimension));
        let zero = reader.builder.graph.zero();
        let [mass, inertia] = [mass, inertia].map(|e| e.unwrap_or(zero));
        let springs = springs.map(|e| e.unwrap_or(zero));
        reader.structure.node_index.insert(name.clone(), reader.structure.nodes.len());
        reader.structure.nodes.push(Node { name, at, mass, inertia, springs, span: fields.span.clone() });
    }
}

/// `[rods]` between nodes.
pub(super) fn rods<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) {
    if reader.structure.nodes.is_empty() {
        return;
    }
    for (name, fields) in rows(reader, top, "rods", &fields::structures::ROD, Owner::Structure) {
        if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            continue;
        }
        let Some(ends) = two_names(reader, &fields, "between") else { continue };
        let known = ends.clone().map(|(name, _)| reader.structure.node_index.get(&name).copied());
        let [Some(a), Some(b)] = known else {
            for ((name, span), _) in ends.iter().zip(&known).filter(|(_, k)| k.is_none()) {
                unknown_node(reader, name, span.clone());
            }
            continue;
        };
        if let Some(rod) = rod(reader, &fields, &name, [a, b]) {
            reader.structure.rod_index.insert(name, reader.structure.rods.len());
            reader.structure.rods.push(rod);
        }
    }
}

fn rod<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, name: &str, ends: [usize; 2]) -> Option<Rod> {
    let length = length(reader, fields, ends)?;
    let rigid = fields.flag(reader, "rigid").unwrap_or(false);
    let hinged = releases(reader, fields);
    let get = |reader: &mut Reader<'a>, key, dimension: &Dimension| positive(reader, fields, key, dimension);
    let (young, second) = (get(reader, "E", &PRESSURE), get(reader, "I", &SECOND_MOMENT));
    let area = get(reader, "A", &AREA);
    let of_section = section(reader, fields);
    if second.is_none() && !rigid && !fields.has("EI") {
        leans(reader, fields);
    }
    let (area, second) = (area.or(of_section.map(|s| s.0)), second.or(of_section.map(|s| s.1)));
    let bending = get(reader, "EI", &BENDING).or_else(|| Some(reader.builder.graph.mul(young?, second?)));
    let stretches = fields.flag(reader, "stretch").unwrap_or(false);
    let axial = get(reader, "EA", &Dimension::FORCE);
    let axial = axial.or_else(|| Some(reader.builder.graph.mul(young?, area?)).filter(|_| stretches));
    let mass = mass(reader, fields, length, area);
    let section_inertia = second.zip(area).map(|(second, area)| {
        let square = reader.builder.graph.div(second, area);
        reader.builder.graph.mul(mass, square)
    });
    let rotary = rotary(reader, fields, section_inertia);
    let rotary_of_nothing = reader.builder.graph.zero();
    let divisions = divisions(reader, fields);
    if bending.is_none() && !rigid && hinged != [true, true] {
        let fault =
            Notice::piece("M201", fields.span.clone(), format!("{} lacks EI", fields.path), format!("в {} не хватает EI", fields.path))
                .why("this rod is fixed to a node and bends", "этот стержень жёстко соединён с узлом и изгибается")
                .help(
                    "add EI (or E and I), or releases = [\"start\", \"end\"] for a rod of a truss, or rigid = true",
                    "добавьте EI (или E и I), либо releases = [\"start\", \"end\"] для стержня фермы, либо rigid = true",
                );
        reader.fault(fault);
    }
    let axial = axial.filter(|_| !rigid);
    let (name, span) = (name.to_owned(), fields.span.clone());
    Some(Rod { name, ends, length, rigid, bending, axial, mass, rotary, section_inertia, rotary_of_nothing, hinged, divisions, span })
}

/// A warning where the axes of the section are not principal: the rod bends in its plane only.
fn leans<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) {
    let Some((name, span)) = fields.name(reader, "section") else { return };
    let Some([xx, yy, xy]) = reader.structure.skew.get(&name).copied() else { return };
    let shown = |v: f64| format!("{:.3e}", v * 1e8).parse::<f64>().unwrap_or(v);
    let [xx, free, xy] = [xx, xx - xy * xy / yy, xy].map(shown);
    let comma = |v: f64| format!("{v}").replace('.', ",");
    reader.fault(
        Notice::piece(
            "M106",
            span,
            format!("the axes x, y of section `{}` are not principal: I_xy = {xy} cm^4", short(&name)),
            format!("оси x, y сечения `{}` не главные: I_xy = {} см⁴", short(&name), comma(xy)),
        )
        .why(
            format!("the rod bends in the plane of the frame with I_x = {xx} cm^4, as if held against skew bending; left to itself it would bend with I_x - I_xy^2/I_y = {free} cm^4"),
            format!(
                "стержень изгибается в плоскости рамы с I_x = {} см⁴, как если бы косой изгиб был стеснён; без стеснения жёсткости отвечало бы I_x − I_xy²/I_y = {} см⁴",
                comma(xx),
                comma(free)
            ),
        )
        .help(
            "turn the section into its principal axes, or give I or EI of the bending that is meant",
            "поверните сечение в главные оси либо задайте I или EI того изгиба, который имеется в виду",
        )
        .warning(),
    );
}

/// Area and second moment of the section named under a key.
fn section<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Expr, Expr)> {
    let (name, span) = fields.name(reader, "section")?;
    let found = reader.structure.sections.get(&name).copied();
    if found.is_none() {
        let fault =
            Notice::piece("M202", span, format!("there is no section `{}`", short(&name)), format!("нет сечения `{}`", short(&name)));
        let fault = match reader
            .scope
            .nearest(&name, reader.structure.sections.keys().map(String::as_str).collect::<std::collections::BTreeSet<_>>())
        {
            Some(near) => fault.meant(&name, near),
            None => fault.help("add it to [sections]", "добавьте его в [sections]"),
        };
        reader.fault(fault);
    }
    found
}

fn length<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, [a, b]: [usize; 2]) -> Option<Expr> {
    let (from, to) = (reader.structure.nodes[a].at, reader.structure.nodes[b].at);
    let graph = &mut reader.builder.graph;
    let (dx, dy) = (graph.sub(to[0], from[0]), graph.sub(to[1], from[1]));
    let (xx, yy) = (graph.square(dx), graph.square(dy));
    let sum = graph.add(xx, yy);
    let length = graph.sqrt(sum);
    let number = reader.values.of(&reader.builder.graph, length);
    if number.is_finite() && number > 0.0 {
        return Some(length);
    }
    let names = [a, b].map(|i| reader.structure.nodes[i].name.clone());
    let fault = Notice::piece(
        "M200",
        fields.span.clone(),
        format!("{} has no length: {} and {} are at one place", fields.path, names[0], names[1]),
        format!("{} нулевой длины: {} и {} в одной точке", fields.path, names[0], names[1]),
    )
    .help("move one of the nodes, or use one node for both", "сдвиньте один из узлов или используйте один узел");
    reader.fault(fault);
    None
}

fn releases<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> [bool; 2] {
    let found = words(reader, fields, "releases", &["start", "end"]);
    [found.contains(&0), found.contains(&1)]
}

/// Mass of a unit of length, from whichever of the three keys is given.
fn mass<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, length: Expr, area: Option<Expr>) -> Expr {
    let total = not_negative(reader, fields, "mass", &Dimension::MASS);
    let density = not_negative(reader, fields, "density", &DENSITY);
    let line = not_negative(reader, fields, "mass_per_length", &LINE_MASS);
    if let Some(line) = line {
        return line;
    }
    if let Some(total) = total {
        return reader.builder.graph.div(total, length);
    }
    match (density, area) {
        (Some(density), Some(area)) => reader.builder.graph.mul(density, area),
        (Some(_), None) => {
            let fault = Notice::piece(
                "M006",
                fields.span_of("density"),
                format!("{} lacks A: the mass is density*A*length", fields.path),
                format!("в {} не хватает A: масса равна density*A*длина", fields.path),
            );
            reader.fault(fault);
            reader.builder.graph.zero()
        }
        (None, _) => reader.builder.graph.zero(),
    }
}

/// Inertia of the turning of a unit of length, mass per length · I/A, when it counts.
fn rotary<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, section_inertia: Option<Expr>) -> Expr {
    if fields.flag(reader, "rotary_inertia").unwrap_or(false) {
        if let Some(inertia) = section_inertia {
            return inertia;
        }
        let fault = Notice::piece(
            "M006",
            fields.span_of("rotary_inertia"),
            format!("{} lacks I or A: the inertia of a section is density*I", fields.path),
            format!("в {} не хватает I или A: инерция сечения равна density*I", fields.path),
        );
        reader.fault(fault);
    }
    reader.builder.graph.zero()
}

fn divisions<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<usize> {
    whole(reader, fields, "divisions").map(|n| n as usize)
}

fn whole<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<i64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::NONE))?;
    let number = reader.number(&value)?;
    if number.fract() == 0.0 && (1.0..=PARTS as f64).contains(&number) {
        return Some(number as i64);
    }
    let given = digits::typed(number);
    let fault = Notice::piece(
        "M206",
        fields.span_of(key),
        format!("{key} is {}; it must be a whole number from 1 to {PARTS}", given.en),
        format!("{key} равно {}; нужно целое число от 1 до {PARTS}", given.ru),
    );
    reader.fault(fault);
    None
}

/// The rest of a structure; none without nodes.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Option<Structure> {
    let has_nodes = !reader.structure.nodes.is_empty();
    for key in ["displacements", "rayleigh", "structure"] {
        if !has_nodes && top.has(key) {
            let fault = Notice::piece("M202", top.span_of(key), format!("[{key}] needs [nodes]"), format!("для [{key}] нужны [nodes]"));
            reader.fault(fault);
        }
    }
    if !has_nodes {
        return None;
    }
    let supports = supports(reader, top);
    distributed(reader, top);
    let displacements = displacements(reader, top);
    let rayleigh = rayleigh(reader, top);
    let options = options(reader, top);
    let draft = std::mem::take(&mut reader.structure);
    Some(Structure { nodes: draft.nodes, rods: draft.rods, supports, displacements, loads: draft.loads, rayleigh, options, kept: None })
}

fn supports<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Support> {
    let mut found = Vec::new();
    for (name, fields) in rows(reader, top, "supports", &fields::structures::SUPPORT, Owner::Structure) {
        let Some((node, span)) = fields.name(reader, "at") else { continue };
        let Some(&node) = reader.structure.node_index.get(&node) else {
            unknown_node(reader, &node, span);
            continue;
        };
        let held = words(reader, &fields, "directions", &["x", "y", "turn"]);
        let angle = fields.formula_or_zero(reader, "angle", &Context::CONSTANT, Some(&Dimension::ANGLE)).expr;
        let holds = [0, 1, 2].map(|k| held.contains(&k));
        found.push(Support { name, node, holds, angle, span: fields.span.clone() });
    }
    found
}

fn options<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Options {
    let Some(value) = top.get("structure") else { return Options::default() };
    let DeValue::Table(table) = value.get_ref() else {
        reader.fault(wrong_type(value.span(), "a table", "таблица", value.get_ref().type_str()));
        return Options::default();
    };
    let fields = Fields::open(reader, &fields::structures::STRUCTURE, table, value.span(), "structure".to_owned());
    let condense = fields.has("condense").then(|| fields.flag(reader, "condense").unwrap_or(false));
    let accuracy = fields.formula(reader, "accuracy", &Context::CONSTANT, Some(&Dimension::NONE));
    // finer than the certificate of modes can show, coarser than a mode is worth
    let accuracy = accuracy.and_then(|value| reader.number(&value)).map(|a| a.clamp(1e-11, 1e-1));
    let modes = whole(reader, &fields, "modes").map(|n| n as usize);
    let [continuum, compare] = ["continuum", "compare"].map(|key| fields.flag(reader, key).unwrap_or(false));
    Options { condense, modes, accuracy, continuum, compare }
}
