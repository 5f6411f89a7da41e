//! What the tables of connections share: places, pathways, positive sizes, words from a list.

use crate::elements::pathway_of;
use crate::formula::{Context, Kind, Place};
use crate::model::{Class, Frame, FrameId, Origin, ParameterDecl, Pathway, Point, PointRef, Reliance, Rest};
use crate::reader::names::frame_by_name;
use crate::reader::{Checked, Fields, Reader, short, string};
use crate::units::Dimension;
use std::collections::HashSet;
use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Notice;

/// Frames and points, and which of them move as one.
pub struct Space<'m> {
    points: &'m [Point],
    /// Symbols whose value never changes.
    constants: HashSet<SymbolId>,
    /// For each frame the frame that it moves with.
    roots: Vec<FrameId>,
}

impl<'m> Space<'m> {
    pub fn new(reader: &Reader, frames: &'m [Frame], points: &'m [Point], parameters: &[ParameterDecl]) -> Space<'m> {
        let constants = parameters.iter().filter(|p| p.class == Class::Constant).map(|p| p.symbol).collect();
        let mut space = Space { points, constants, roots: vec![FrameId::GROUND] };
        for (i, frame) in frames.iter().enumerate().skip(1) {
            let stands = match &frame.origin {
                Origin::Vector(v) => v.iter().all(|e| space.is_fixed(reader, *e)),
                Origin::Point(p) => {
                    let point = &points[p.index()];
                    let same = space.roots.get(point.on.index()) == space.roots.get(frame.on.index());
                    same && point.at.iter().all(|e| space.is_fixed(reader, *e))
                }
            };
            let turned = frame.spin.is_some() || frame.rotations.iter().any(|(_, angle)| !space.is_fixed(reader, *angle));
            // a body is always its own: what joins it to another may be a named joint of a structure at rest
            let root = space.roots.get(frame.on.index()).copied().filter(|_| stands && !turned && !frame.is_body);
            space.roots.push(root.unwrap_or(FrameId(i)));
        }
        space
    }

    /// Whether a value never changes.
    pub fn is_fixed(&self, reader: &Reader, e: Expr) -> bool {
        reader.builder.graph.symbols_in(&[e]).iter().all(|s| self.constants.contains(s))
    }

    /// The frame that a frame moves with.
    pub fn root(&self, frame: FrameId) -> FrameId {
        self.roots.get(frame.index()).copied().unwrap_or(frame)
    }

    /// The frame that a point moves with; `None` when it moves in its frame.
    pub fn carrier(&self, reader: &Reader, point: PointRef) -> Option<FrameId> {
        match point {
            PointRef::Point(p) => {
                let point = &self.points[p.index()];
                point.at.iter().all(|e| self.is_fixed(reader, *e)).then(|| self.root(point.on))
            }
            PointRef::Origin(f) | PointRef::Center(f) => Some(self.root(f)),
        }
    }

    /// The frame of a point and its place there.
    pub fn place_in(&self, reader: &mut Reader, point: PointRef) -> (FrameId, [Expr; 3]) {
        match point {
            PointRef::Point(p) => (self.points[p.index()].on, self.points[p.index()].at),
            PointRef::Origin(f) | PointRef::Center(f) => (f, [reader.builder.graph.zero(); 3]),
        }
    }
}

/// The point of that name; a frame or body stands for its origin.
pub fn point_named(reader: &mut Reader, name: &str, span: Range<usize>) -> Option<PointRef> {
    match reader.scope.place(name) {
        Some(Place::Point(p)) => Some(PointRef::Point(p)),
        Some(Place::Frame(f)) => Some(PointRef::Origin(f)),
        None => {
            let fault = reader.scope.unknown_place(name, span);
            reader.fault(fault);
            None
        }
    }
}

/// The point under a key.
pub fn point<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<PointRef> {
    let (name, span) = fields.name(reader, key)?;
    point_named(reader, &name, span)
}

/// A frame under a key; the ground without it, nothing after a fault.
pub fn frame<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<FrameId> {
    match fields.has(key) {
        true => fields.name(reader, key).and_then(|(name, span)| frame_by_name(reader, &name, span)),
        false => Some(FrameId::GROUND),
    }
}

/// Two different points that can move against each other.
pub fn two_points<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<[PointRef; 2]> {
    let names = crate::reader::names::two_names(reader, fields, "between")?;
    let [a, b] = names.clone().map(|(name, span)| point_named(reader, &name, span));
    let (a, b) = (a?, b?);
    if a == b {
        reader.fault(same_thing(fields.span_of("between"), &names[0].0));
        return None;
    }
    if space.carrier(reader, a).is_some_and(|root| space.carrier(reader, b) == Some(root)) {
        reader.fault(rigid(fields.span_of("between"), [&names[0].0, &names[1].0]));
        return None;
    }
    Some([a, b])
}

/// The fault of a connection between a thing and itself.
pub fn same_thing(span: Range<usize>, name: &str) -> Notice {
    Notice::piece("M063", span, format!("both ends are `{name}`"), format!("оба конца — `{name}`"))
        .why("a connection of a thing with itself does nothing", "связь тела с самим собой ничего не даёт")
}

/// The fault of a connection between things that move as one.
pub fn rigid(span: Range<usize>, [a, b]: [&str; 2]) -> Notice {
    Notice::piece("M073", span, format!("`{a}` and `{b}` move as one"), format!("`{a}` и `{b}` движутся как одно целое"))
        .why(
            "they belong to the same body, or to bodies that never move against each other",
            "они принадлежат одному телу или телам, неподвижным друг относительно друга",
        )
        .help(
            "let one body have coordinates of its own, or name its reactions by [supports]",
            "дайте одному из тел собственные координаты или введите реакции через [supports]",
        )
}

/// A size under a key that must be positive.
pub fn size<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str, context: &Context) -> Option<Expr> {
    let value = fields.formula(reader, key, context, Some(&Dimension::LENGTH))?;
    positive(reader, &value, key, fields.span_of(key)).then_some(value.expr)
}

/// Whether a size is good; reports one that is zero or negative.
pub fn positive(reader: &mut Reader, value: &Checked, key: &str, span: Range<usize>) -> bool {
    let Some(number) = reader.number_for(value, Reliance::Sign).filter(|v| *v <= 0.0) else { return value.good };
    let size = words::digits::quantity(number, "m");
    reader.fault(
        Notice::piece(
            "M074",
            span,
            format!("`{key}` is {}; it must be positive", size.en),
            format!("`{key}` равно {}; должно быть положительным", size.ru),
        )
        .why("the value of a parameter is probably wrong, or a sign", "вероятно, неверно значение параметра или знак"),
    );
    false
}

/// `length`: a formula or "start".
pub fn length<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Rest> {
    match fields.get("length") {
        None => Some(Rest::Start),
        Some(value) if value.get_ref().as_str() == Some("start") => Some(Rest::Start),
        Some(_) => size(reader, fields, "length", &Context::TIME).map(Rest::Value),
    }
}

/// The number of a word in a list; the first without the key.
pub fn word<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str, choices: &[&str]) -> Option<usize> {
    let Some(value) = fields.get(key) else { return Some(0) };
    let (text, span) = string(reader, value, "a string", "строка")?;
    choose(reader, &text, span, choices)
}

/// The number of a word in a list.
pub fn choose(reader: &mut Reader, text: &str, span: Range<usize>, choices: &[&str]) -> Option<usize> {
    let found = choices.iter().position(|c| *c == text.trim());
    if found.is_none() {
        let shown = short(text);
        let fault = Notice::piece("M075", span, format!("`{shown}` is not possible here"), format!("здесь невозможно `{shown}`"));
        let list = choices.join(", ");
        let fault = match reader.scope.nearest(text, choices.iter().copied()) {
            Some(near) => fault.meant(text, near),
            None => fault.help(format!("one of {list}"), format!("одно из: {list}")),
        };
        reader.fault(fault);
    }
    found
}

/// Angle of a line.
pub fn direction<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Expr {
    fields.formula_or_zero(reader, "direction", &Context::CONSTANT, Some(&Dimension::ANGLE)).expr
}

/// A point of a line, which must be fixed in the frame of the line.
pub fn fixed_in<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    key: &'static str,
    space: &Space,
    on: FrameId,
) -> Option<Option<PointRef>> {
    if !fields.has(key) {
        return Some(None);
    }
    let found = point(reader, fields, key)?;
    if space.carrier(reader, found) != Some(space.root(on)) {
        reader.fault(
            Notice::piece(
                "M078",
                fields.span_of(key),
                format!("the point under `{key}` is not fixed in `on`"),
                format!("точка в `{key}` не закреплена в `on`"),
            )
            .why("a straight line or a circle belongs to one frame", "прямая или окружность принадлежит одной системе отсчёта")
            .help("name the frame of the point under `on`, or another point", "укажите в `on` систему этой точки либо другую точку"),
        );
        return None;
    }
    Some(Some(found))
}

/// Restitution, 0 ... 1.
pub fn restitution<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Expr {
    restitution_by(reader, fields, "restitution")
}

/// The same by another key.
pub fn restitution_by<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Expr {
    let value = fields.formula_or_zero(reader, key, &Context::CONSTANT, Some(&Dimension::NONE));
    if let Some(number) = reader.number_for(&value, Reliance::Share).filter(|v| !(0.0..=1.0).contains(v)) {
        let number = words::digits::typed(number);
        reader.fault(
            Notice::piece(
                "M079",
                fields.span_of(key),
                format!("the restitution is {}; it lies between 0 and 1", number.en),
                format!("коэффициент восстановления {}; он от 0 до 1", number.ru),
            )
            .why("above 1 an impact would create energy", "при значении больше 1 удар создавал бы энергию"),
        );
    }
    value.expr
}

/// `along`, `between` or `on`: what a drive, a stop or a friction acts through.
pub fn pathway<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Pathway, Kind)> {
    if !fields.has("on") {
        return pathway_of(reader, fields);
    }
    if fields.has("along") || fields.has("between") {
        reader.fault(
            Notice::piece(
                "M057",
                fields.span.clone(),
                format!("{} has more than one pathway", fields.path),
                format!("в {} больше одной координаты", fields.path),
            )
            .help("keep one of `along`, `between`, `on`", "оставьте одно из `along`, `between`, `on`"),
        );
        return None;
    }
    let body = frame(reader, fields, "on")?;
    if body == FrameId::GROUND {
        reader.fault(same_thing(fields.span_of("on"), "ground"));
        return None;
    }
    Some((Pathway::RelativeAngle(FrameId::GROUND, body), Kind::Known(Dimension::ANGLE)))
}

/// Exactly one of two keys.
pub fn one_of<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, [a, b]: [&'static str; 2], example: &str) -> Option<&'static str> {
    match (fields.has(a), fields.has(b)) {
        (true, false) => Some(a),
        (false, true) => Some(b),
        (both, _) => {
            let path = &fields.path;
            let (en, ru) = if both {
                (format!("{path} has both `{a}` and `{b}`"), format!("в {path} заданы и `{a}`, и `{b}`"))
            } else {
                (format!("{path} needs `{a}` or `{b}`"), format!("в {path} нужно `{a}` или `{b}`"))
            };
            let fault = Notice::piece("M080", if both { fields.span_of(b) } else { fields.span.clone() }, en, ru);
            reader.fault(if both {
                fault.help("keep one", "оставьте одно")
            } else {
                fault.help(format!("add {example}"), format!("добавьте {example}"))
            });
            None
        }
    }
}
