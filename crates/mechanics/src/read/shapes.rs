//! Inertia of bodies: given, by radius of gyration, or from the shape of a homogeneous body.
//!
//! Moments about the mass centre (Beer and Johnston, Vector Mechanics for Engineers: Dynamics, table of mass moments of inertia).

use crate::fields;
use crate::formula::Context;
use crate::model::{Axis, Inertia, Reliance, Solid};
use crate::reader::{Checked, Fields, Reader};
use crate::snippet::Snippet;
use crate::units::Dimension;
use symbolic::{Expr, Rational};
use toml::de::DeValue;
use words::Notice;

/// Homogeneous bodies: name, least and greatest number of lengths.
pub const SHAPES: [(&str, usize, usize); 7] =
    [("disc", 1, 1), ("ring", 1, 2), ("rod", 1, 2), ("box", 2, 3), ("sphere", 1, 1), ("cylinder", 2, 2), ("point", 0, 0)];

/// The inertia of a body of this mass.
pub(super) fn inertia<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, mass: &Checked) -> (Inertia, Option<Solid>) {
    let massless = mass.good && reader.builder.graph.is_zero(mass.expr);
    let given: Vec<&str> = ["inertia", "shape", "gyration"].into_iter().filter(|k| fields.has(k)).collect();
    if given.len() > 1 {
        reader.fault(
            Notice::piece(
                "M053",
                fields.span_of(given[1]),
                format!("{} are given together", given.join(" and ")),
                format!("заданы одновременно: {}", given.join(", ")),
            )
            .why("each of them alone says what the inertia is", "каждое из них само задаёт момент инерции")
            .help("keep one", "оставьте одно"),
        );
    }
    if massless && (fields.has("shape") || fields.has("gyration")) {
        let key = if fields.has("shape") { "shape" } else { "gyration" };
        reader.fault(
            Notice::piece(
                "M052",
                fields.span_of(key),
                format!("{} has a {key} but no mass", fields.path),
                format!("у {} задано {key}, но нет массы", fields.path),
            )
            .help("add mass = \"...\"", "добавьте mass = \"...\""),
        );
    }
    if fields.has("inertia") {
        return (given_inertia(reader, fields), None);
    }
    if let Some(radius) = fields.formula(reader, "gyration", &Context::CONSTANT, Some(&Dimension::LENGTH)) {
        positive(reader, fields, "gyration", &radius);
        let square = reader.builder.graph.square(radius.expr);
        return (Inertia::Planar(reader.builder.graph.mul(mass.expr, square)), None);
    }
    match shape(reader, fields, mass.expr) {
        Some((inertia, solid)) => (inertia, Some(solid)),
        None => (Inertia::None, None),
    }
}

fn given_inertia<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Inertia {
    let Some(value) = fields.get("inertia") else { return Inertia::None };
    let DeValue::Table(table) = value.get_ref() else {
        let Some(inertia) = fields.formula(reader, "inertia", &Context::CONSTANT, Some(&Dimension::INERTIA)) else { return Inertia::None };
        negative(reader, fields, "inertia", &inertia);
        if reader.builder.graph.is_zero(inertia.expr) && inertia.good {
            return Inertia::None;
        }
        return Inertia::Planar(inertia.expr);
    };
    let tensor = Fields::open(reader, &fields::TENSOR, table, value.span(), fields.path_of("inertia"));
    let keys = ["xx", "yy", "zz", "xy", "yz", "xz"];
    let values = keys.map(|key| tensor.formula_or_zero(reader, key, &Context::CONSTANT, Some(&Dimension::INERTIA)));
    let numbers: Vec<f64> = values.iter().filter_map(|v| reader.number(v)).collect();
    if let [xx, yy, zz, xy, yz, xz] = numbers[..] {
        possible(reader, &tensor, [xx, yy, zz], [xy, yz, xz]);
    }
    let [xx, yy, zz, xy, yz, xz] = values.map(|v| v.expr);
    Inertia::Tensor { xx, yy, zz, xy, yz, xz }
}

/// A tensor of a real body: no negative moment, and no moment larger than the sum of the other two (x² + y² >= 0), which in all axes
/// means that the matrix of Σ m r rᵀ has no negative minor.
fn possible(reader: &mut Reader, tensor: &Fields, [xx, yy, zz]: [f64; 3], [xy, yz, xz]: [f64; 3]) {
    let trace = (xx + yy + zz) / 2.0;
    let (a, b, c) = (trace - xx, trace - yy, trace - zz);
    let size = xx.abs().max(yy.abs()).max(zz.abs()).max(xy.abs()).max(yz.abs()).max(xz.abs());
    // moments of inertia written with nine digits may miss the limit of a flat body by their last one
    let slack = 1e-9 * size;
    let minors = [a * b - xy * xy, b * c - yz * yz, a * c - xz * xz];
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    let real = [a, b, c].iter().all(|v| *v >= -slack) && minors.iter().all(|m| *m >= -slack * size) && determinant >= -slack * size * size;
    if !real {
        reader.fault(
            Notice::piece("M055", tensor.span.clone(), "no body has this inertia tensor", "такого тензора инерции не бывает")
                .why(
                    "no moment may be negative or larger than the sum of the other two, and the products are bounded by the moments",
                    "момент инерции не бывает отрицательным или больше суммы двух других, а центробежные моменты ограничены осевыми",
                )
                .help(
                    "check the units and the axes; a thin plate in xy has zz = xx + yy",
                    "проверьте единицы и оси; у тонкой пластины в плоскости xy zz = xx + yy",
                ),
        );
    }
}

fn negative(reader: &mut Reader, fields: &Fields, key: &'static str, value: &crate::reader::Checked) {
    if let Some(v) = reader.number_for(value, Reliance::Sign)
        && v < 0.0
    {
        let moment = words::digits::typed(v);
        reader.fault(
            Notice::piece(
                "M055",
                fields.span_of(key),
                format!("the moment of inertia is {} kg m^2", moment.en),
                format!("момент инерции равен {} кг м²", moment.ru),
            )
            .why("a moment of inertia is a sum of m r^2", "момент инерции — это сумма m r²"),
        );
    }
}

/// Reports a length that is not positive.
fn positive(reader: &mut Reader, fields: &Fields, key: &'static str, value: &crate::reader::Checked) {
    if let Some(v) = reader.number_for(value, Reliance::Sign)
        && v <= 0.0
    {
        let size = words::digits::quantity(v, "m");
        reader.fault(
            Notice::piece(
                "M051",
                fields.span_of(key),
                format!("a length of {key} in {} is {}", fields.path, size.en),
                format!("длина в {key} ({}) равна {}", fields.path, size.ru),
            )
            .why("sizes are positive", "размеры положительны"),
        );
    }
}

fn shape<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, mass: Expr) -> Option<(Inertia, Solid)> {
    let value = fields.get("shape")?;
    let Some(snippet) = reader.snippet(value) else {
        reader.fault(crate::reader::wrong_type(
            value.span(),
            "a shape such as \"disc(R)\"",
            "форма, например \"disc(R)\"",
            value.get_ref().type_str(),
        ));
        return None;
    };
    let snippet = snippet.trimmed();
    let (name, arguments) = match split(&snippet) {
        Ok(parts) => parts,
        Err(fault) => {
            reader.report(snippet.diagnose(fault));
            return None;
        }
    };
    let mut axis = Axis::X;
    let mut lengths: Vec<Expr> = Vec::new();
    for (i, argument) in arguments.iter().enumerate() {
        if name == "rod" && i == 1 {
            axis = match &*argument.text {
                "x" => Axis::X,
                "y" => Axis::Y,
                "z" => Axis::Z,
                _ => {
                    let fault = Notice::piece("M060", argument.all(), "an axis is x, y or z", "ось — это x, y или z");
                    reader.report(argument.diagnose(fault));
                    Axis::X
                }
            };
            continue;
        }
        let raw = reader.raw_text(argument.clone());
        let length = reader.value(&raw, &Context::CONSTANT, Some(&Dimension::LENGTH));
        positive(reader, fields, "shape", &length);
        lengths.push(length.expr);
    }
    let inertia = moments(reader, name, mass, &lengths, axis.index());
    Some((inertia, Solid { name, lengths, axis }))
}

/// The name of a shape and its arguments.
fn split<'a>(snippet: &Snippet<'a>) -> Result<(&'static str, Vec<Snippet<'a>>), Notice> {
    let text = &*snippet.text;
    let open = text.find('(').unwrap_or(text.len());
    let name = text[..open].trim();
    let Some((name, least, most)) = SHAPES.iter().find(|s| s.0 == name) else {
        let known = SHAPES.map(|s| s.0);
        let fault = Notice::piece(
            "M054",
            0..open,
            format!("unknown shape `{}`", crate::reader::short(name)),
            format!("неизвестная форма `{}`", crate::reader::short(name)),
        );
        let near = words::nearest(name, known).map_or_else(|| known.join(", "), str::to_owned);
        return Err(fault.help(format!("did you mean {near}?"), format!("может быть, {near}?")));
    };
    let mut arguments = Vec::new();
    if open < text.len() {
        let inner = text[open + 1..]
            .strip_suffix(')')
            .ok_or_else(|| Notice::piece("M030", snippet.all(), "`)` is missing at the end of the shape", "в конце формы нет `)`"))?;
        let (mut depth, mut from) = (0, 0);
        for (i, c) in inner.char_indices().chain([(inner.len(), ',')]) {
            match c {
                '(' => depth += 1,
                ')' => depth -= 1,
                ',' if depth == 0 || i == inner.len() => {
                    arguments.push(snippet.part(open + 1 + from..open + 1 + i).trimmed());
                    from = i + 1;
                }
                _ => {}
            }
            if arguments.len() > 10 {
                break;
            }
        }
    }
    if !(*least..=*most).contains(&arguments.len()) {
        let count = arguments.len();
        return Err(Notice::piece(
            "M034",
            snippet.all(),
            format!("{name} takes {least} to {most} lengths, {count} given"),
            format!("форме {name} нужно размеров от {least} до {most}, дано: {count}"),
        )
        .help(
            "sizes are separated by commas; the decimal mark inside is a point",
            "размеры разделяют запятыми; дробная часть отделяется точкой",
        ));
    }
    Ok((name, arguments))
}

fn moments(reader: &mut Reader, name: &str, mass: Expr, lengths: &[Expr], axis: usize) -> Inertia {
    let graph = &mut reader.builder.graph;
    let zero = graph.zero();
    let squares: Vec<Expr> = lengths.iter().map(|l| graph.square(*l)).collect();
    // Σ (n/d) · mass · square
    let mut of = |parts: &[(usize, i64, i64)]| {
        let items: Vec<(Expr, Rational)> =
            parts.iter().map(|(i, n, d)| (squares.get(*i).copied().unwrap_or(zero), Rational::new(*n, *d).unwrap_or_default())).collect();
        let sum = graph.linear(Rational::ZERO, &items);
        graph.mul(mass, sum)
    };
    let diagonal = match (name, lengths.len()) {
        ("disc", _) => [of(&[(0, 1, 4)]), of(&[(0, 1, 4)]), of(&[(0, 1, 2)])],
        ("ring", 1) => [of(&[(0, 1, 2)]), of(&[(0, 1, 2)]), of(&[(0, 1, 1)])],
        ("ring", _) => [of(&[(0, 1, 4), (1, 1, 4)]), of(&[(0, 1, 4), (1, 1, 4)]), of(&[(0, 1, 2), (1, 1, 2)])],
        ("rod", _) => {
            let across = of(&[(0, 1, 12)]);
            let mut diagonal = [across; 3];
            diagonal[axis] = zero;
            diagonal
        }
        ("box", _) => [of(&[(1, 1, 12), (2, 1, 12)]), of(&[(0, 1, 12), (2, 1, 12)]), of(&[(0, 1, 12), (1, 1, 12)])],
        ("sphere", _) => [of(&[(0, 2, 5)]); 3],
        ("cylinder", _) => {
            let across = of(&[(0, 1, 4), (1, 1, 12)]);
            [across, across, of(&[(0, 1, 2)])]
        }
        _ => return Inertia::None,
    };
    let [xx, yy, zz] = diagonal;
    Inertia::Tensor { xx, yy, zz, xy: zero, yz: zero, xz: zero }
}
