//! `[sections.NAME]`: parts of a section, their checks, and what they make together.

use crate::fields::{self, TableSpec};
use crate::formula::Context;
use crate::reader::{Fields, Reader, components, short, wrong_type};
use crate::section::{self, Form, Moments, Outline, Part, Properties, Section};
use crate::units::Dimension;
use std::ops::Range;
use symbolic::Expr;
use toml::de::DeValue;
use words::Notice;
use words::digits::quantity;

/// Keys that say what a part is.
const SHAPES: [&str; 7] = ["rectangle", "triangle", "circle", "half_disc", "ring", "polygon", "profile"];

/// More parts or corners than this are no section.
const LIMIT: usize = 400;

/// Least and greatest length in a section, m.
const LEAST: f64 = 1e-30;
const GREATEST: f64 = 1e30;

/// A part while it is read.
struct Draft {
    part: Part,
    moments: Moments,
}

pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Section> {
    let mut sections = Vec::new();
    for (name, fields) in top.entries(reader, "sections", &fields::SECTION) {
        let label = fields.text(reader, "label").unwrap_or_default();
        let found = drafts(reader, &fields).and_then(|drafts| together(reader, (name.clone(), label.clone()), &fields, drafts));
        // what is wrong is said; rods that name the section have no fault of their own
        sections.extend(found.or_else(|| {
            let disc = disc(reader, &fields);
            together(reader, (name, label), &fields, vec![disc])
        }));
    }
    sections
}

/// Stands for a section that is wrong.
fn disc(reader: &mut Reader, fields: &Fields) -> Draft {
    let graph = &mut reader.builder.graph;
    let (form, zero) = (Form::Circle(graph.one()), graph.zero());
    let moments = section::of_form(graph, &form, [zero, zero], zero);
    let mut number = |e: Expr| reader.values.of(&reader.builder.graph, e);
    let (outline, area) = (outline(&form, &mut number), number(moments.area));
    Draft { part: Part { kind: "circle", outline, area, centroid: [0.0; 2], removed: false, span: fields.span.clone() }, moments }
}

/// The parts; none when one of them is faulty.
fn drafts<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Vec<Draft>> {
    let Some(value) = fields.get("parts") else { return Some(vec![draft(reader, fields, &fields::SECTION, &fields.path)?]) };
    if let Some(key) = SHAPES.into_iter().find(|k| fields.has(k)) {
        reader.fault(
            Notice::piece(
                "M300",
                fields.span_of(key),
                format!("{} has both `parts` and `{key}`", fields.path),
                format!("в {} заданы и `parts`, и `{key}`", fields.path),
            )
            .help("put it among the parts", "перенесите её в список parts"),
        );
        return None;
    }
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(wrong_type(value.span(), "an array of parts", "массив частей", value.get_ref().type_str()));
        return None;
    };
    if items.is_empty() || items.len() > LIMIT {
        reader.fault(Notice::piece(
            "M300",
            value.span(),
            format!("a section has 1 to {LIMIT} parts, {} given", items.len()),
            format!("в сечении от 1 до {LIMIT} частей, дано: {}", items.len()),
        ));
        return None;
    }
    let mut parts = Vec::new();
    for (i, item) in items.iter().enumerate() {
        let path = format!("{}.parts[{}]", fields.path, i + 1);
        match item.get_ref() {
            DeValue::Table(table) => {
                let own = Fields::open(reader, &fields::PART, table, item.span(), path.clone());
                parts.push(draft(reader, &own, &fields::PART, &path));
            }
            other => {
                reader.fault(wrong_type(
                    item.span(),
                    "a part such as { circle = \"2 cm\" }",
                    "часть вида { circle = \"2 см\" }",
                    other.type_str(),
                ));
                parts.push(None);
            }
        }
    }
    parts.into_iter().collect()
}

fn draft<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, spec: &'static TableSpec, path: &str) -> Option<Draft> {
    let given: Vec<&'static str> = SHAPES.into_iter().filter(|k| fields.has(k)).collect();
    let [kind] = given[..] else {
        let (en, ru) = if given.is_empty() {
            ("does not say what it is".to_owned(), "не сказано, что это".to_owned())
        } else {
            (format!("is several things: {}", given.join(", ")), format!("заданы сразу: {}", given.join(", ")))
        };
        reader.fault(
            Notice::piece("M300", fields.span.clone(), format!("{path} {en}"), format!("{path}: {ru}"))
                .help(format!("give one of {}", SHAPES.join(", ")), format!("задайте одно из: {}", SHAPES.join(", "))),
        );
        return None;
    };
    let form = form(reader, fields, kind)?;
    let before = reader.errors();
    let at = fields.vector(reader, "at", &Context::CONSTANT, &Dimension::LENGTH);
    let angle = fields.formula_or_zero(reader, "angle", &Context::CONSTANT, Some(&Dimension::ANGLE));
    let removed = spec.field("remove").is_some() && fields.get("remove").is_some_and(|v| removal(reader, v));
    if reader.errors() > before {
        return None;
    }
    let moments = section::of_form(&mut reader.builder.graph, &form, [at[0], at[1]], angle.expr);
    let mut number = |e: Expr| reader.values.of(&reader.builder.graph, e);
    let (place, turn) = ([number(at[0]), number(at[1])], number(angle.expr));
    let outline = outline(&form, &mut number).placed(place, turn);
    let (area, centroid) = (number(moments.area), [number(moments.x), number(moments.y)]);
    let span = if spec.name == fields::PART.name { fields.span.clone() } else { fields.span_of(kind) };
    for number in place {
        if number.is_finite() && !measurable(reader, fields, number, fields.span_of("at")) {
            return None;
        }
    }
    if !(angle.good && area.is_finite() && centroid.iter().chain(&place).all(|v| v.is_finite())) {
        return None;
    }
    Some(Draft { part: Part { kind, outline, area, centroid, removed, span }, moments })
}

fn removal<'a>(reader: &mut Reader<'a>, value: &'a crate::reader::syntax::Value<'a>) -> bool {
    value.get_ref().as_bool().unwrap_or_else(|| {
        reader.fault(wrong_type(value.span(), "true or false", "true или false", value.get_ref().type_str()));
        false
    })
}

/// The form of a part; none with a finding when its sizes are none.
fn form<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, kind: &'static str) -> Option<Form> {
    match kind {
        "rectangle" => lengths(reader, fields, kind).map(|[b, h]| Form::Rectangle(b, h)),
        "circle" => length(reader, fields, kind).map(Form::Circle),
        "half_disc" => length(reader, fields, kind).map(Form::HalfDisc),
        "ring" => ring(reader, fields),
        "triangle" => triangle(reader, fields),
        "polygon" => corners(reader, fields, kind),
        _ => profile(reader, fields),
    }
}

fn length<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, kind: &'static str) -> Option<Expr> {
    let value = fields.formula(reader, kind, &Context::CONSTANT, Some(&Dimension::LENGTH))?;
    let number = reader.number(&value)?;
    size(reader, fields, kind, (number, fields.span_of(kind))).then_some(value.expr)
}

/// Whether a size is positive and of a size that can be reckoned with.
fn size(reader: &mut Reader, fields: &Fields, kind: &str, (number, span): (f64, Range<usize>)) -> bool {
    positive(reader, fields, kind, number, span.clone()) && measurable(reader, fields, number, span)
}

/// Refuses lengths whose fourth powers leave the machine numbers.
fn measurable(reader: &mut Reader, fields: &Fields, number: f64, span: Range<usize>) -> bool {
    if number == 0.0 || (LEAST..=GREATEST).contains(&number.abs()) {
        return true;
    }
    reader.fault(
        Notice::piece(
            "M022",
            span,
            format!("a length of {number:e} m in {}", fields.path),
            format!("длина {number:e} м в {}", fields.path),
        )
        .why(
            "second moments take fourth powers: lengths of a section lie between 1e-30 m and 1e30 m",
            "в моменты инерции входят четвёртые степени: длины сечения — от 1e-30 м до 1e30 м",
        )
        .help("check the exponent and the unit", "проверьте показатель степени и единицу"),
    );
    false
}

fn positive(reader: &mut Reader, fields: &Fields, kind: &str, number: f64, span: Range<usize>) -> bool {
    if number > 0.0 {
        return true;
    }
    let size = words::digits::quantity(number, "m");
    reader.fault(
        Notice::piece(
            "M051",
            span,
            format!("a length of {kind} in {} is {}", fields.path, size.en),
            format!("длина в {kind} ({}) равна {}", fields.path, size.ru),
        )
        .why("sizes are positive", "размеры положительны")
        .help(
            "a part is taken out by remove = true, not by a negative size",
            "часть вычитают ключом remove = true, а не отрицательным размером",
        ),
    );
    false
}

fn lengths<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, kind: &'static str) -> Option<[Expr; 2]> {
    let value = fields.get(kind)?;
    let items = value.get_ref().as_array().filter(|items| items.len() == 2);
    let Some(items) = items else {
        reader.fault(
            wrong_type(value.span(), "an array of 2 lengths", "массив из 2 длин", value.get_ref().type_str())
                .help(format!("write {kind} = [\"10 cm\", \"20 cm\"]"), format!("напишите {kind} = [\"10 см\", \"20 см\"]")),
        );
        return None;
    };
    let mut found = Vec::new();
    for item in items.iter() {
        let raw = reader.raw(item)?;
        let value = reader.value(&raw, &Context::CONSTANT, Some(&Dimension::LENGTH));
        let number = reader.number(&value)?;
        if size(reader, fields, kind, (number, item.span())) {
            found.push(value.expr);
        }
    }
    found.try_into().ok()
}

fn ring<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Form> {
    let [outer, inner] = lengths(reader, fields, "ring")?;
    let [a, b] = [outer, inner].map(|e| reader.values.of(&reader.builder.graph, e));
    if a <= b {
        let [outside, inside] = [a, b].map(|radius| quantity(radius, "m"));
        reader.fault(
            Notice::piece(
                "M300",
                fields.span_of("ring"),
                format!("the ring in {} has the outer radius {} and the inner one {}", fields.path, outside.en, inside.en),
                format!("у кольца в {} наружный радиус {}, внутренний {}", fields.path, outside.ru, inside.ru),
            )
            .help("write the outer radius first: ring = [\"5 cm\", \"4 cm\"]", "наружный радиус пишут первым: ring = [\"5 см\", \"4 см\"]"),
        );
        return None;
    }
    Some(Form::Ring(outer, inner))
}

/// Two legs from the right angle, or three corners.
fn triangle<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Form> {
    let items = fields.get("triangle")?.get_ref().as_array();
    if items.is_some_and(|items| items.iter().any(|i| i.get_ref().is_array())) {
        return corners(reader, fields, "triangle");
    }
    let [b, h] = lengths(reader, fields, "triangle")?;
    let zero = reader.builder.graph.zero();
    Some(Form::Polygon(vec![[zero, zero], [b, zero], [zero, h]]))
}

fn corners<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, kind: &'static str) -> Option<Form> {
    let value = fields.get(kind)?;
    let allowed = if kind == "triangle" { 3..=3 } else { 3..=LIMIT };
    let items = value.get_ref().as_array().filter(|items| allowed.contains(&items.len()));
    let Some(items) = items else {
        reader.fault(
            Notice::piece(
                "M300",
                value.span(),
                format!("{kind} in {} needs corners: 3 or more arrays of 2 lengths", fields.path),
                format!("для {kind} в {} нужны вершины: не менее 3 массивов из 2 длин", fields.path),
            )
            .help(
                format!("write {kind} = [[\"0\", \"0\"], [\"6 cm\", \"0\"], [\"0\", \"4 cm\"]]"),
                format!("напишите {kind} = [[\"0\", \"0\"], [\"6 см\", \"0\"], [\"0\", \"4 см\"]]"),
            ),
        );
        return None;
    };
    let mut found: Vec<[Expr; 2]> = Vec::new();
    for item in items.iter() {
        let [x, y, _] = components(reader, item, &Context::CONSTANT, &Dimension::LENGTH);
        found.push([x, y]);
    }
    let places: Vec<[f64; 2]> = found.iter().map(|p| p.map(|e| reader.values.of(&reader.builder.graph, e))).collect();
    if places.iter().flatten().any(|v| !v.is_finite()) {
        return None;
    }
    for number in places.iter().flatten() {
        if !measurable(reader, fields, *number, fields.span_of(kind)) {
            return None;
        }
    }
    let outline = Outline::polygon(places.clone());
    let (area, ..) = outline.polygon_moments();
    let size = places.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    if let Some((a, b)) = crossing(&places) {
        crossed(reader, fields, kind, a, b);
        return None;
    }
    // corners on one line leave the rounding of products of their coordinates
    if area.abs() <= 1e-12 * size * size {
        empty(reader, &fields.path, fields.span_of(kind));
        return None;
    }
    let signed: f64 = (0..places.len()).map(|k| (places[k], places[(k + 1) % places.len()])).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum();
    if signed < 0.0 {
        found.reverse();
    }
    Some(Form::Polygon(found))
}

/// Two sides of a polygon that cross, by their numbers.
fn crossing(places: &[[f64; 2]]) -> Option<(usize, usize)> {
    let n = places.len();
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let side = |k: usize| (places[k], places[(k + 1) % n]);
    for i in 0..n {
        for j in i + 2..n {
            let ((a, b), (c, d)) = (side(i), side(j));
            if turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0 {
                return Some((i + 1, j + 1));
            }
        }
    }
    None
}

fn crossed(reader: &mut Reader, fields: &Fields, kind: &str, a: usize, b: usize) {
    reader.fault(
        Notice::piece(
            "M300",
            fields.span_of("polygon"),
            format!("sides {a} and {b} of the {kind} in {} cross", fields.path),
            format!("стороны {a} и {b} ({kind} в {}) пересекаются", fields.path),
        )
        .help("list the corners in order round the outline", "перечислите вершины по порядку обхода контура"),
    );
}

fn profile<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Form> {
    let (name, span) = fields.name(reader, "profile")?;
    if let Some(found) = section::find_profile(&name) {
        return Some(Form::Profile(found));
    }
    let fault = Notice::piece("M301", span, format!("there is no profile `{}`", short(&name)), format!("нет профиля `{}`", short(&name)));
    let first = name.trim().chars().next().map(|c| c.to_ascii_uppercase());
    let family: Vec<&str> = section::profile_names().filter(|n| n.chars().next() == first).collect();
    let fault = match &family[..] {
        [_, ..] => fault.help(format!("there are {}", family.join(", ")), format!("есть {}", family.join(", "))),
        [] => fault.help(
            "I-beams are called I10 ... I60, channels C5U ... C40U and C5P ... C40P, equal angles L20x3 ... L250x20",
            "двутавры: I10 ... I60 (двутавр 10), швеллеры: 5У ... 40У и 5П ... 40П, равнополочные уголки: L20x3 ... L250x20",
        ),
    };
    reader.fault(fault);
    None
}

fn outline(form: &Form, number: &mut dyn FnMut(Expr) -> f64) -> Outline {
    match form {
        Form::Rectangle(b, h) => {
            let (b, h) = (number(*b) / 2.0, number(*h) / 2.0);
            Outline::polygon(vec![[-b, -h], [b, -h], [b, h], [-b, h]])
        }
        Form::Circle(r) => Outline::ring(number(*r), 0.0),
        Form::HalfDisc(r) => Outline::half_disc(number(*r)),
        Form::Ring(outer, inner) => Outline::ring(number(*outer), number(*inner)),
        Form::Polygon(corners) => Outline::polygon(corners.iter().map(|p| p.map(&mut *number)).collect()),
        Form::Profile(p) => Outline::profile(p, 12),
    }
}

fn empty(reader: &mut Reader, path: &str, span: Range<usize>) {
    reader.fault(
        Notice::piece("M304", span, format!("{path} has no area"), format!("площадь {path} равна нулю"))
            .why("corners lie on one line, or all material is taken out", "вершины лежат на одной прямой, или весь материал вычтен"),
    );
}

/// Checks what covers what and sums up.
fn together(reader: &mut Reader, (name, label): (String, words::Text), fields: &Fields, drafts: Vec<Draft>) -> Option<Section> {
    let moments: Vec<(Moments, bool)> = drafts.iter().map(|d| (d.moments, d.part.removed)).collect();
    let parts: Vec<Part> = drafts.into_iter().map(|d| d.part).collect();
    let coverage = section::cover(&parts);
    if !fits(reader, fields, &parts, &coverage) {
        return None;
    }
    let area: f64 = parts.iter().map(|p| if p.removed { -p.area } else { p.area }).sum();
    let added: f64 = parts.iter().filter(|p| !p.removed).map(|p| p.area).sum();
    // openings that take all leave the rounding of the areas they take
    if area.is_nan() || area <= 1e-9 * added {
        empty(reader, &fields.path, fields.span.clone());
        return None;
    }
    let moments = section::together(&mut reader.builder.graph, &moments);
    let mut number = |e: Expr| reader.values.of(&reader.builder.graph, e);
    let [area, x, y, xx, yy, xy] = [moments.area, moments.x, moments.y, moments.xx, moments.yy, moments.xy].map(&mut number);
    let reach = |direction: [f64; 2]| reach(&parts, &coverage, direction);
    let properties = Properties::new(area, [x, y], [xx, yy, xy], &reach);
    Some(Section { name, label, parts, moments, properties, span: fields.span.clone() })
}

/// How far the section goes in a direction: the farthest corner or arc of a part, or, where that was cut off, what is left.
fn reach(parts: &[Part], coverage: &section::Coverage, direction: [f64; 2]) -> f64 {
    let whole = parts.iter().filter(|p| !p.removed).map(|p| p.outline.reach(direction)).fold(f64::NEG_INFINITY, f64::max);
    if parts.iter().all(|p| !p.removed) {
        return whole;
    }
    let along = coverage.corners.iter().map(|p| p[0] * direction[0] + p[1] * direction[1]);
    let (low, seen) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    // polygons stand for arcs within 4e-5 of the radius: the exact place is the nearest one that can be farthest
    let near = 1e-4 * (seen - low);
    let candidates = parts.iter().flat_map(|p| p.outline.candidates(direction));
    let exact = candidates.filter(|c| (c - seen).abs() <= near).fold(None, |best: Option<f64>, c| match best {
        Some(b) if (b - seen).abs() <= (c - seen).abs() => Some(b),
        _ => Some(c),
    });
    exact.unwrap_or(seen)
}

/// Share of an area that a polygon in place of an arc may pretend.
const CURVED: f64 = 2e-4;
/// The same where all sides are straight: rounding of products of coordinates, far below what anybody covers by mistake.
const STRAIGHT: f64 = 1e-9;

/// A share in per cent, in both notations.
fn percent(share: f64) -> [String; 2] {
    let percent = 100.0 * share;
    let digits = if percent < 1.0 { 3 } else { 1 };
    // polygons in place of arcs are a little small
    let text = if percent > 99.9 { "100".to_owned() } else { format!("{percent:.digits$}") };
    let russian = text.replace('.', ",");
    [text, russian]
}

/// What a part is called in Russian.
fn russian(kind: &str) -> &'static str {
    match kind {
        "rectangle" => "прямоугольник",
        "triangle" => "треугольник",
        "circle" => "круг",
        "half_disc" => "полукруг",
        "ring" => "кольцо",
        "polygon" => "многоугольник",
        _ => "профиль",
    }
}

/// Whether nothing is taken out where nothing is, and nothing counts twice.
fn fits(reader: &mut Reader, fields: &Fields, parts: &[Part], coverage: &section::Coverage) -> bool {
    let share = if parts.iter().any(|p| p.outline.curved()) { CURVED } else { STRAIGHT };
    let mut good = true;
    let title = |i: usize| {
        (
            format!("part {} ({}) of {}", i + 1, parts[i].kind, fields.path),
            format!("часть {} ({}) в {}", i + 1, russian(parts[i].kind), fields.path),
        )
    };
    for &(i, area) in coverage.missing.iter().filter(|(i, area)| *area > share * parts[*i].area) {
        let [percent, percent_ru] = percent(area / parts[i].area);
        let (en, ru) = title(i);
        good = false;
        reader.fault(
            Notice::piece(
                "M302",
                parts[i].span.clone(),
                format!("{en} takes out material that is not there: {percent} % of it"),
                format!("{ru} вычитается там, где материала нет: {percent_ru} % её площади"),
            )
            .why(
                "a removed part lies outside the solid, or overlaps another removed part",
                "вычитаемая часть выходит за контур тела или перекрывает другую вычитаемую часть",
            )
            .help(
                "check its `at` and sizes; cut it so that each place is removed once",
                "проверьте её `at` и размеры; каждое место вычитают один раз",
            ),
        );
    }
    let smaller = |i: usize, j: usize| parts[i].area.min(parts[j].area);
    for &(i, j, area) in coverage.doubled.iter().filter(|(i, j, area)| *area > share * smaller(*i, *j)) {
        let [percent, percent_ru] = percent(area / smaller(i, j));
        let (en, ru) = title(i);
        good = false;
        reader.fault(
            Notice::piece(
                "M303",
                parts[i].span.clone(),
                format!("{en} overlaps part {} ({}): {percent} % of the smaller one", j + 1, parts[j].kind),
                format!("{ru} перекрывает часть {} ({}): {percent_ru} % меньшей из них", j + 1, russian(parts[j].kind)),
            )
            .why("material would count twice", "материал был бы учтён дважды")
            .help(
                "move or cut one of them, or remove the common piece once with remove = true",
                "сдвиньте или урежьте одну из них либо вычтите общий кусок один раз (remove = true)",
            ),
        );
    }
    good
}
