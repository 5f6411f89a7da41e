//! `[frames]`, `[bodies]`, `[points]` and gravity.

use super::order::topological;
use super::shapes;
use crate::fields;
use crate::formula::{Context, Place};
use crate::model::{Axis, Frame, FrameId, Inertia, Mass, Origin, Point, PointId, Reliance};
use crate::reader::names::frame_named;
use crate::reader::{Fields, Raw, Reader, components, string, wrong_type};
use crate::units::Dimension;
use std::collections::HashMap;
use std::ops::Range;
use symbolic::Expr;
use toml::de::DeValue;
use words::{Notice, Text};

struct RawFrame<'a> {
    name: String,
    is_body: bool,
    fields: Fields<'a>,
}

/// What a name of the space stands for before frames are in order.
#[derive(Clone, Copy)]
enum Named {
    Ground,
    Frame(usize),
    Point(usize),
}

/// Frames (ground first, parents before children) and points.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> (Vec<Frame>, Vec<Point>) {
    let mut raw: Vec<RawFrame> = Vec::new();
    for (key, spec, is_body) in [("frames", &fields::FRAME, false), ("bodies", &fields::BODY, true)] {
        raw.extend(top.entries(reader, key, spec).into_iter().map(|(name, fields)| RawFrame { name, is_body, fields }));
    }
    let mut points = top.entries(reader, "points", &fields::POINT);
    let mut space: HashMap<String, (Named, Range<usize>)> = HashMap::new();
    space.insert("ground".to_owned(), (Named::Ground, 0..0));
    let mut index = 0;
    raw.retain(|f| {
        let fine = claim(reader, &mut space, &f.name, &f.fields.span, Named::Frame(index));
        index += usize::from(fine);
        fine
    });
    index = 0;
    points.retain(|(name, fields)| {
        let fine = claim(reader, &mut space, name, &fields.span, Named::Point(index));
        index += usize::from(fine);
        fine
    });
    let dependencies: Vec<Vec<usize>> = raw.iter().map(|f| parents(f, &points, &space)).collect();
    let (order, cycles) = topological(&dependencies);
    for cycle in &cycles {
        report_cycle(reader, cycle, &raw);
    }
    reader.scope.declare_place("ground", Place::Frame(FrameId::GROUND));
    for (position, i) in order.iter().enumerate() {
        reader.scope.declare_place(&raw[*i].name, Place::Frame(FrameId(position + 1)));
    }
    for (i, (name, _)) in points.iter().enumerate() {
        reader.scope.declare_place(name, Place::Point(PointId(i)));
    }
    let mut frames = vec![ground(reader)];
    for i in order {
        let frame = frame(reader, &raw[i]);
        frames.push(frame);
    }
    let points = points.into_iter().map(|(name, fields)| point(reader, name, &fields)).collect();
    (frames, points)
}

fn claim(reader: &mut Reader, space: &mut HashMap<String, (Named, Range<usize>)>, name: &str, span: &Range<usize>, what: Named) -> bool {
    if !reader.name_is_fine(name, span.clone(), &["ground"]) {
        return false;
    }
    if let Some((_, first)) = space.get(name) {
        let d = Notice::file(
            "M011",
            span.clone(),
            Text::new(format!("the name `{name}` is used twice"), format!("имя `{name}` использовано дважды")),
        )
        .why("frames, bodies and points share one set of names", "у систем отсчёта, тел и точек общий список имён")
        .related(first.clone(), Text::new("first here", "впервые здесь"));
        reader.report(d);
        return false;
    }
    space.insert(name.to_owned(), (what, span.clone()));
    true
}

/// The frames that must come before this one.
fn parents(frame: &RawFrame, points: &[(String, Fields)], space: &HashMap<String, (Named, Range<usize>)>) -> Vec<usize> {
    let name_in = |fields: &Fields, key: &'static str| fields.get(key).and_then(|v| v.get_ref().as_str()).map(str::to_owned);
    let frame_of = |name: Option<String>| match name.and_then(|n| space.get(&n)) {
        Some((Named::Frame(i), _)) => Some(*i),
        _ => None,
    };
    let mut found: Vec<usize> = frame_of(name_in(&frame.fields, "on")).into_iter().collect();
    if let Some((Named::Point(p), _)) = name_in(&frame.fields, "origin").and_then(|n| space.get(&n)) {
        found.extend(frame_of(name_in(&points[*p].1, "on")));
    }
    found
}

fn report_cycle(reader: &mut Reader, cycle: &[usize], raw: &[RawFrame]) {
    let names: Vec<&str> = cycle.iter().chain(cycle.first()).take(12).map(|i| raw[*i].name.as_str()).collect();
    let chain = names.join(" -> ");
    reader.fault(
        Notice::piece(
            "M041",
            raw[cycle[0]].fields.span.clone(),
            format!("frames stand on each other in a circle: {chain}"),
            format!("системы отсчёта опираются друг на друга по кругу: {chain}"),
        )
        .why("the chain of frames must begin at the ground", "цепь систем отсчёта должна начинаться от неподвижной")
        .help("let one of them stand on \"ground\"", "поставьте одну из них на \"ground\""),
    );
}

fn ground(reader: &mut Reader) -> Frame {
    Frame {
        name: "ground".to_owned(),
        label: Text::default(),
        is_body: false,
        on: FrameId::GROUND,
        origin: Origin::Vector([reader.builder.graph.zero(); 3]),
        rotations: Vec::new(),
        spin: None,
        mass: None,
        span: 0..0,
    }
}

fn frame<'a>(reader: &mut Reader<'a>, raw: &RawFrame<'a>) -> Frame {
    let fields = &raw.fields;
    let on = frame_named(reader, fields, "on");
    let origin = origin(reader, fields);
    let rotations = rotations(reader, fields);
    let spin = spin(reader, fields);
    let mass = if raw.is_body { mass(reader, fields) } else { None };
    let label = if raw.is_body { fields.text(reader, "label").unwrap_or_default() } else { Text::default() };
    Frame { name: raw.name.clone(), label, is_body: raw.is_body, on, origin, rotations, spin, mass, span: fields.span.clone() }
}

fn origin<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Origin {
    let Some(value) = fields.get("origin") else { return Origin::Vector([reader.builder.graph.zero(); 3]) };
    let DeValue::String(name) = value.get_ref() else {
        return Origin::Vector(components(reader, value, &Context::GEOMETRY, &Dimension::LENGTH));
    };
    match reader.scope.place(name) {
        Some(Place::Point(p)) => return Origin::Point(p),
        Some(Place::Frame(_)) => reader.fault(
            Notice::piece(
                "M014",
                value.span(),
                format!("`{name}` is a frame; an origin is a vector or a point"),
                format!("`{name}` — система отсчёта; начало задают вектором или точкой"),
            )
            .help(format!("write on = \"{name}\""), format!("напишите on = \"{name}\"")),
        ),
        None => {
            let fault = reader.scope.unknown_place(name, value.span());
            reader.fault(fault);
        }
    }
    Origin::Vector([reader.builder.graph.zero(); 3])
}

fn rotations<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Vec<(Axis, Expr)> {
    if fields.has("angle") && fields.has("rotate") {
        reader.fault(
            Notice::piece("M061", fields.span_of("rotate"), "both `angle` and `rotate` are given", "заданы и `angle`, и `rotate`").help(
                "angle = \"phi\" is short for rotate = [\"z: phi\"]; keep one",
                "angle = \"phi\" — то же, что rotate = [\"z: phi\"]; оставьте одно",
            ),
        );
    }
    if let Some(angle) = fields.formula(reader, "angle", &Context::GEOMETRY, Some(&Dimension::ANGLE)) {
        return vec![(Axis::Z, angle.expr)];
    }
    let Some(value) = fields.get("rotate") else { return Vec::new() };
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(wrong_type(
            value.span(),
            "an array such as [\"z: psi\", \"x: theta\"]",
            "массив вида [\"z: psi\", \"x: theta\"]",
            value.get_ref().type_str(),
        ));
        return Vec::new();
    };
    items.iter().filter_map(|item| turn(reader, item)).collect()
}

fn turn<'a>(reader: &mut Reader<'a>, item: &'a crate::reader::syntax::Value<'a>) -> Option<(Axis, Expr)> {
    string(reader, item, "a string such as \"z: psi\"", "строка вида \"z: psi\"")?;
    let (axis, raw) = axis_prefix(reader, item)?;
    let Some(axis) = axis else {
        reader.fault(
            Notice::piece("M060", item.span(), "a rotation needs its axis", "у поворота должна быть ось")
                .help("write \"z: psi\": the axis x, y or z, a colon, the angle", "напишите \"z: psi\": ось x, y или z, двоеточие, угол"),
        );
        return None;
    };
    Some((axis, reader.value(&raw, &Context::GEOMETRY, Some(&Dimension::ANGLE)).expr))
}

/// `x: formula` or `formula`.
fn axis_prefix<'a>(reader: &mut Reader<'a>, value: &'a crate::reader::syntax::Value<'a>) -> Option<(Option<Axis>, Raw<'a>)> {
    let Some(snippet) = reader.snippet(value) else { return reader.raw(value).map(|raw| (None, raw)) };
    let Some(colon) = snippet.text.find(':') else { return Some((None, reader.raw_text(snippet))) };
    let axis = match snippet.text[..colon].trim() {
        "x" => Axis::X,
        "y" => Axis::Y,
        "z" => Axis::Z,
        _ => {
            let fault = Notice::piece("M060", 0..colon, "an axis is x, y or z", "ось — это x, y или z");
            reader.report(snippet.diagnose(fault));
            return None;
        }
    };
    let rest = snippet.part(colon + 1..snippet.text.len()).trimmed();
    Some((Some(axis), reader.raw_text(rest)))
}

fn spin<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Axis, Expr)> {
    let value = fields.get("spin")?;
    let (axis, raw) = axis_prefix(reader, value)?;
    let rate = reader.value(&raw, &Context::TIME, Some(&Dimension::ANGULAR_RATE));
    (rate.good && !reader.builder.graph.is_zero(rate.expr)).then_some((axis.unwrap_or(Axis::Z), rate.expr))
}

fn mass<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Mass> {
    let mass = fields.formula_or_zero(reader, "mass", &Context::CONSTANT, Some(&Dimension::MASS));
    let center = fields.vector(reader, "center", &Context::CONSTANT, &Dimension::LENGTH);
    let literal_zero = reader.builder.graph.is_zero(mass.expr);
    match reader.number_for(&mass, Reliance::Sign) {
        Some(m) if m < 0.0 => reader.fault(negative_mass(fields, m)),
        Some(0.0) if !literal_zero && !reader.is_set_by_hand(&mass) => reader.fault(no_mass(fields)),
        _ => {}
    }
    let (inertia, shape) = shapes::inertia(reader, fields, &mass);
    let gravity = fields.flag(reader, "gravity").unwrap_or(true);
    let massless = literal_zero && matches!(inertia, Inertia::None);
    (!massless).then_some(Mass { mass: mass.expr, center, inertia, gravity, shape })
}

fn negative_mass(fields: &Fields, m: f64) -> Notice {
    let mass = words::digits::quantity(m, "kg");
    Notice::piece(
        "M050",
        fields.span_of("mass"),
        format!("the mass of {} is {}", fields.path, mass.en),
        format!("масса {} равна {}", fields.path, mass.ru),
    )
    .why(
        "no body has a negative mass; the value of a parameter is probably wrong",
        "масса тела не бывает отрицательной; вероятно, неверно значение параметра",
    )
}

fn no_mass(fields: &Fields) -> Notice {
    Notice::piece(
        "M050",
        fields.span_of("mass"),
        format!("the mass of {} is zero", fields.path),
        format!("масса {} равна нулю", fields.path),
    )
    .why(
        "a parameter makes it so; the body has no weight and no inertia of its own",
        "так следует из значения параметра; у тела нет ни веса, ни инерции",
    )
    .help(
        "for a massless body leave `mass` out; a part is switched off without this remark by --set, a variant or a sweep",
        "для невесомого тела не задавайте `mass`; без этого замечания часть отключают через --set, вариант или sweep",
    )
    .warning()
}

fn point<'a>(reader: &mut Reader<'a>, name: String, fields: &Fields<'a>) -> Point {
    let on = frame_named(reader, fields, "on");
    let at = fields.vector(reader, "at", &Context::GEOMETRY, &Dimension::LENGTH);
    Point { name, on, at, span: fields.span.clone() }
}

/// The acceleration of gravity, where it acts.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gravity {
    /// On bodies; `None` when off or when no body feels it.
    pub bodies: Option<[Expr; 3]>,
    /// On nodes and rods, when the file gives it.
    pub structure: Option<[Expr; 3]>,
}

/// Reads `gravity`; what does not stand in the file acts on bodies only.
pub(super) fn gravity<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, frames: &[Frame]) -> Gravity {
    let felt = frames.iter().filter_map(|f| f.mass.as_ref()).any(|m| m.gravity && !reader.builder.graph.is_zero(m.mass));
    let stands = !reader.structure.nodes.is_empty();
    let zero = reader.builder.graph.zero();
    let down = |reader: &mut Reader, size: Expr| [zero, reader.builder.graph.neg(size), zero];
    let vector = match top.get("gravity").map(|v| (v, v.get_ref())) {
        Some((_, DeValue::Boolean(false))) => return Gravity::default(),
        Some((value, DeValue::Array(_))) => components(reader, value, &Context::CONSTANT, &Dimension::ACCELERATION),
        Some((value, DeValue::String(_) | DeValue::Integer(_) | DeValue::Float(_))) => {
            let Some(raw) = reader.raw(value) else { return Gravity::default() };
            let size = reader.value(&raw, &Context::CONSTANT, Some(&Dimension::ACCELERATION)).expr;
            down(reader, size)
        }
        Some((_, DeValue::Boolean(true))) if felt || stands => {
            let size = default_gravity(reader);
            down(reader, size)
        }
        None if felt => {
            let size = default_gravity(reader);
            down(reader, size)
        }
        None | Some((_, DeValue::Boolean(true))) => return Gravity::default(),
        Some((value, other)) => {
            reader.fault(wrong_type(value.span(), "false, a formula or a vector", "false, формула или вектор", other.type_str()));
            return Gravity::default();
        }
    };
    let acts = vector.iter().any(|e| *e != zero);
    let given = stands && acts && top.has("gravity");
    Gravity { bodies: (felt && acts).then_some(vector), structure: given.then_some(vector) }
}

fn default_gravity<'a>(reader: &mut Reader<'a>) -> Expr {
    use crate::formula::{EntryKind, Kind};
    let is_parameter = reader.scope.get("g").is_some_and(|e| matches!(e.kind, EntryKind::Parameter(_)));
    let text = if is_parameter { "g" } else { "9.81 m/s^2" };
    let span = reader.claimed.get("g").cloned().unwrap_or(0..0);
    let snippet = crate::snippet::Snippet { text: text.into(), site: crate::snippet::Site::Inside(span.clone()) };
    if let Some(Kind::Known(d)) = reader.scope.get("g").filter(|_| is_parameter).map(|e| e.dimension)
        && !d.same(&Dimension::ACCELERATION)
    {
        let (got, got_ru) = (crate::units::si_label(&d), crate::units::si_label_ru(&d));
        reader.fault(
            Notice::piece(
                "M024",
                span,
                format!("`g` is {got}, but gravity needs an acceleration"),
                format!("`g` имеет размерность {got_ru}, а тяжести нужно ускорение"),
            )
            .help(
                "rename this parameter, or set gravity = false or another formula",
                "переименуйте параметр или задайте gravity = false либо другую формулу",
            ),
        );
        return reader.builder.graph.zero();
    }
    let raw = reader.raw_text(snippet);
    reader.value(&raw, &Context::CONSTANT, Some(&Dimension::ACCELERATION)).expr
}
