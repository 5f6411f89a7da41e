//! Dry friction: a force, or a coefficient of a normal force, on what `places.rs` reads; how it slides there stands in `sliding.rs`.

mod places;
mod sliding;

pub(crate) use places::springing_back;
pub(crate) use sliding::order;

use super::common::component::Component;
use super::common::keys::{ALONG, BETWEEN, ON_BODY, table};
use super::common::made::Made;
use super::common::reading::Space;
use super::row::Row;
use crate::formula::{Context, Depends, Entry, EntryKind, Kind};
use crate::keys::{LABEL, TableSpec, Type, may};
use crate::model::{Connection, ConnectionKind, Part, Pressing, Reliance, RequestKind, Slides};
use crate::reader::{Checked, Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::{Found, Scene};
use crate::units::si_label;
use symbolic::{Expr, Substitution, SymbolId};
use words::Notice;
use words::digits::quantity;

/// `[frictions]`.
pub(super) const ROW: Row =
    Row { keys: &KEYS, listed: ("dry friction", "сухое трение"), chapter: "contact-kinds", within: &[], read, components };

/// `[frictions.NAME]`.
const KEYS: TableSpec = table(
    "frictions",
    (
        "Dry friction: a force (`kinetic`, `static`), or coefficients (`coefficient`, `static_coefficient`) of a `normal` force. `u` is the sliding speed, not negative. It acts on a pathway (`along`, `between`, `on`; torques when that is an angle), at a point between two bodies or at a named contact (`at`), in a pin (`pin`), between a rope and a drum that does not turn (`rope`). force is positive when it resists a growing pathway or positive sliding; at a point it acts so on the point's body. A rope slides positively along its `path`, from the first point to the last: force is the tension behind the drum less that before it.",
        "Сухое трение: сила (`kinetic`, `static`) или коэффициенты (`coefficient`, `static_coefficient`) при силе `normal`. `u` — скорость скольжения, не отрицательная. Действует на координате (`along`, `between`, `on`; для угла это моменты), в точке касания двух тел или в названном контакте (`at`), в шарнире (`pin`), между канатом и неподвижным барабаном (`rope`). force положительна, если сопротивляется росту координаты или положительному скольжению; в точке она так действует на тело этой точки. Положительное скольжение каната — вдоль его `path`, от первой точки к последней: force — это натяжение за барабаном минус натяжение перед ним.",
    ),
    &[
        ALONG,
        BETWEEN,
        ON_BODY,
        may(
            "at",
            Type::NameOrNames,
            "",
            "",
            (
                "where it acts: [point, other body], or the name of a rolling contact (which may then slip) or a stop; with its table where both have that name: \"stops.K\"",
                "где действует: [точка, другое тело] либо имя качения (тогда возможно проскальзывание) или упора; если имя есть в обеих таблицах — с таблицей: \"stops.K\"",
            ),
            "[\"A\", \"floor\"]",
        ),
        may(
            "direction",
            Type::FormulaOrVector,
            "1",
            "along the track; normal of the stop turned by −90°",
            (
                "direction of positive sliding at a point: x, y, z, -x ..., a vector of any length, or an angle from the x axis of `axes`",
                "направление положительного скольжения в точке: x, y, z, -x ..., вектор любой длины или угол с осью x системы `axes`",
            ),
            "[\"cos(a)\", \"sin(a)\"]",
        ),
        may("axes", Type::Name, "", "\"ground\"", ("axes of `direction`", "оси для `direction`"), "\"wedge\""),
        may(
            "pin",
            Type::Name,
            "",
            "",
            (
                "a pin or support, about which its bodies turn: moment coefficient·radius·force of all its components (plane)",
                "шарнир или опора, вокруг которых поворачиваются тела: момент coefficient·radius·полная реакция (на плоскости)",
            ),
            "\"O\"",
        ),
        may(
            "radius",
            Type::Formula,
            "m",
            "",
            (
                "radius of the pin; with a stop: distance of the contact from the stop's point, of two points from the second, towards the surface",
                "радиус цапфы; для упора — расстояние от его точки (из двух точек — от второй) до контакта, в сторону поверхности",
            ),
            "\"10 mm\"",
        ),
        may("rope", Type::Name, "", "", ("a rope that slides over a drum or ring", "канат, скользящий по барабану или кольцу"), "\"R\""),
        may(
            "over",
            Type::NameOrNames,
            "",
            "",
            (
                "the point of the rope's path on the drum, or the points where it runs on and off",
                "точка пути каната на барабане либо точки набегания и сбегания",
            ),
            "[\"P1\", \"P2\"]",
        ),
        may("wrap", Type::Formula, "rad", "angle by which the rope turns at `over`", ("angle of contact", "угол обхвата"), "\"540 deg\""),
        may(
            "kinetic",
            Type::Formula,
            "",
            "",
            ("friction while sliding, over u and time, not coordinates", "трение при скольжении, функция u и времени, не координат"),
            "\"F2\"",
        ),
        may("curve", Type::Formula, "", "", ("another name of `kinetic`", "другое имя для `kinetic`"), "\"F2/(1 + u/u0)\""),
        may("static", Type::Formula, "", "kinetic at u = 0", ("largest friction at rest", "наибольшее трение покоя"), "\"F1\""),
        may(
            "coefficient",
            Type::Formula,
            "1",
            "",
            (
                "coefficient while sliding, over u and time, not coordinates",
                "коэффициент при скольжении, функция u и времени, не координат",
            ),
            "0.2",
        ),
        may("static_coefficient", Type::Formula, "1", "coefficient at u = 0", ("coefficient at rest", "коэффициент при покое"), "0.3"),
        may(
            "lever",
            Type::Formula,
            "m",
            "",
            (
                "lever of the rolling resistance at a named contact: the moment is lever·normal",
                "плечо трения качения в названном контакте: момент равен lever·normal",
            ),
            "\"0.5 mm\"",
        ),
        may("static_lever", Type::Formula, "m", "lever at u = 0", ("the same at rest", "то же при покое"), "\"0.6 mm\""),
        may(
            "normal",
            Type::Formula,
            "N",
            "force of the named contact, pin or rope",
            ("normal force; its magnitude counts; may contain reactions", "нормальная сила; учитывается модуль; может содержать реакции"),
            "\"force(guide)\"",
        ),
        LABEL,
    ],
    "[frictions.rail]\nalong = \"x\"\nkinetic = \"F2\"\nstatic = \"F1\"\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Made> {
    let place = places::slides(reader, fields);
    let length = place.as_ref().map_or(Kind::Unknown, |p| p.1);
    let force = length.conjugate();
    let [law, limit] = keys(reader, fields, place.as_ref().map(|p| &p.0))?;
    let normal = fields.formula(reader, "normal", &Context::NORMAL, None);
    let normal = match normal {
        Some(normal) => Some(linear_normal(reader, fields, normal)?),
        None => None,
    };
    let by_coefficient = matches!(law, "coefficient" | "lever");
    let wanted = match (force, &normal) {
        (Kind::Known(f), Some(Checked { kind: Kind::Known(n), .. })) => f.div(n),
        (_, None) if by_coefficient => place.as_ref().map(|p| places::coefficient(&p.0)),
        (Kind::Known(f), None) => Some(f),
        _ => None,
    };
    let speed = sliding_speed(reader, fields, length, [law, limit])?;
    let kinetic = with_speed(reader, speed, |reader| fields.formula(reader, law, &Context::SLIDING, wanted.as_ref()));
    let fixed = fields.formula(reader, limit, &Context::TIME, wanted.as_ref());
    let kinetic = kinetic?;
    let sound = limits(reader, fields, (law, &kinetic), fixed.as_ref().map(|f| (limit, f)), speed.0);
    let good = sound && kinetic.good && fixed.is_none_or(|f| f.good);
    let pressed = by_coefficient.then_some(());
    let kind = ConnectionKind::Friction {
        slides: place?.0,
        kinetic: kinetic.expr,
        speed: speed.0,
        fixed: fixed.map(|f| f.expr),
        normal: match (pressed, normal) {
            (None, _) => Pressing::Given,
            (_, Some(normal)) => Pressing::Formula(normal.expr),
            (_, None) => Pressing::Contact,
        },
    };
    good.then(|| Made::along(kind, force))
}

/// The keys of the law and of the limit at rest: a force, or coefficients of a normal force.
fn keys<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, slides: Option<&Slides>) -> Option<[&'static str; 2]> {
    let laws: Vec<&'static str> = ["kinetic", "curve", "coefficient", "lever"].into_iter().filter(|key| fields.has(key)).collect();
    let &[law] = laws.as_slice() else {
        reader.fault(one_law(fields, &laws));
        return None;
    };
    let own = match law {
        "coefficient" => "static_coefficient",
        "lever" => "static_lever",
        _ => "static",
    };
    let by_coefficient = own != "static";
    let presses = slides.is_some_and(places::presses);
    // the pin's and the rope's own force, and no other
    let bound = matches!(slides, Some(Slides::Journal { .. } | Slides::Belt { .. }));
    let missing = by_coefficient && !fields.has("normal") && !presses && slides.is_some() || bound && !by_coefficient;
    let foreign = ["static", "static_coefficient", "static_lever"].into_iter().find(|key| *key != own && fields.has(key));
    let surplus = foreign.or_else(|| (fields.has("normal") && (!by_coefficient || bound)).then_some("normal"));
    if missing || surplus.is_some() {
        let span = surplus.map_or(fields.span.clone(), |key| fields.span_of(key));
        let (en, ru) = match surplus {
            None => ("`coefficient` needs `normal`, the force that presses", "к `coefficient` нужно `normal` — прижимающая сила"),
            Some(_) => ("forces and coefficients are mixed", "смешаны силы и коэффициенты"),
        };
        reader.fault(Notice::piece("M080", span, en, ru).help(
            "either kinetic and static, or coefficient, static_coefficient and normal (which a named contact, pin or rope has itself)",
            "либо kinetic и static, либо coefficient, static_coefficient и normal (у названного контакта, шарнира или каната она своя)",
        ));
        return None;
    }
    Some([law, own])
}

/// M080: no law, or several.
fn one_law(fields: &Fields<'_>, laws: &[&'static str]) -> Notice {
    let path = &fields.path;
    let [first, second, ..] = laws else {
        let fault = Notice::piece(
            "M080",
            fields.span.clone(),
            format!("{path} needs one of `kinetic`, `curve`, `coefficient`, `lever`"),
            format!("в {path} нужно одно из `kinetic`, `curve`, `coefficient`, `lever`"),
        );
        return fault.help(
            "kinetic = \"F2\" is a force; coefficient = 0.2 needs normal = \"N\"",
            "kinetic = \"F2\" — сила; к coefficient = 0.2 нужно normal = \"N\"",
        );
    };
    let fault = Notice::piece(
        "M080",
        fields.span_of(second),
        format!("{path} has `{first}` and `{second}`: one friction has one law"),
        format!("в {path} заданы и `{first}`, и `{second}`: у одного трения один закон"),
    );
    fault.help("keep one of them; a second resistance is a friction of its own", "оставьте одно; второе сопротивление — отдельное трение")
}

/// The symbol u and its dimension. A name `u` of the model must not be meant by the same letter.
fn sliding_speed<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, length: Kind, keys: [&'static str; 2]) -> Option<(SymbolId, Kind)> {
    let uses_u =
        keys.into_iter().filter_map(|key| fields.get(key)).filter_map(|v| v.get_ref().as_str()).any(|text| mentions_u(reader, text));
    if uses_u && reader.scope.get("u").is_some() {
        reader.fault(
            Notice::piece(
                "M084",
                fields.span_of(keys[0]),
                "`u` is the sliding speed here, and a name of the model",
                "`u` здесь — скорость скольжения и имя из модели",
            )
            .help("give the parameter or coordinate `u` another name", "переименуйте параметр или координату `u`"),
        );
        return None;
    }
    let rate = match length {
        Kind::Known(d) => Kind::Known(d.per_time(1)),
        other => other,
    };
    Some((reader.letter("u"), rate))
}

fn mentions_u(reader: &Reader, text: &str) -> bool {
    crate::formula::parse(text, &reader.functions).is_ok_and(|f| f.names().any(|(name, _)| name == "u"))
}

/// Reads with the name `u` known.
fn with_speed<'a, T>(reader: &mut Reader<'a>, (symbol, dimension): (SymbolId, Kind), read: impl FnOnce(&mut Reader<'a>) -> T) -> T {
    let entry = Entry { kind: EntryKind::Parameter(symbol), dimension, depends: Depends::SLIDING };
    let hidden = reader.scope.cover("u", entry);
    let result = read(reader);
    reader.scope.uncover("u", hidden);
    result
}

/// A normal force: a magnitude of two components is not linear in them.
fn linear_normal<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, normal: Checked) -> Option<Checked> {
    if !normal.good {
        return None;
    }
    let within = reader.builder.graph.symbols_in(&[normal.expr]);
    let reactions: Vec<(SymbolId, RequestKind)> = reader
        .builder
        .requests
        .iter()
        .filter(|r| matches!(r.kind, RequestKind::Reaction(..)) && within.binary_search(&r.symbol).is_ok())
        .map(|r| (r.symbol, r.kind))
        .collect();
    let magnitude =
        reactions.iter().any(|(_, kind)| matches!(kind, RequestKind::Reaction(i, Part::Force) if reader.scope.is_magnitude(*i)));
    let graph = &mut reader.builder.graph;
    let linear = reactions.iter().all(|(symbol, _)| {
        let slope = graph.derivative(normal.expr, *symbol);
        !graph.contains(slope, |s| reactions.iter().any(|(r, _)| *r == s))
    });
    if magnitude || !linear {
        reader.fault(
            Notice::piece(
                "M085",
                fields.span_of("normal"),
                "the normal force is not linear in the reactions",
                "нормальная сила не линейна по реакциям",
            )
            .why(
                "friction and reactions are found together from linear equations; the magnitude of the normal force is taken anyway",
                "трение и реакции находятся вместе из линейных уравнений; модуль нормальной силы берётся и так",
            )
            .help(
                "use one component: force_x(A), normal(F), force of a slider",
                "используйте одну компоненту: force_x(A), normal(F), force ползуна",
            ),
        );
        return None;
    }
    Some(normal)
}

/// Friction is not negative, and not weaker at rest than at the slowest sliding.
fn limits<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    (law, kinetic): (&'static str, &Checked),
    fixed: Option<(&'static str, &Checked)>,
    speed: SymbolId,
) -> bool {
    let slow = at_rest(reader, kinetic.expr, speed);
    if let Some((_, fixed)) = fixed {
        let excess = reader.builder.graph.sub(fixed.expr, slow);
        let below = reader.number_of_for(excess, Reliance::Sign).is_some_and(|v| v < 0.0);
        // by how much decides
        if below {
            reader.number_of(excess);
        }
    }
    let slow = reader.number_of_for(slow, Reliance::Sign);
    let fixed = fixed.map(|(key, value)| (key, reader.number_for(value, Reliance::Sign)));
    let unit = if let Kind::Known(d) = kinetic.kind { si_label(&d) } else { String::new() };
    let negative = |key: &'static str, value: f64| {
        let value = quantity(value, &unit);
        Notice::piece(
            "M086",
            fields.span_of(key),
            format!("the friction `{key}` is {}", value.en),
            format!("трение `{key}` равно {}", value.ru),
        )
        .why(
            "it would push a body on instead of holding it; the sign comes from the sliding",
            "оно подталкивало бы тело; знак берётся от скольжения",
        )
    };
    if let Some(value) = slow.filter(|v| *v < 0.0) {
        reader.fault(negative(law, value));
        return false;
    }
    let Some((key, Some(limit))) = fixed else { return true };
    if limit < 0.0 {
        reader.fault(negative(key, limit));
        return false;
    }
    // the same number written in two ways differs by its rounding
    if let Some(value) = slow.filter(|v| limit < *v * (1.0 - 1e-12)) {
        let [limit, value] = [limit, value].map(|x| quantity(x, &unit));
        reader.fault(
            Notice::piece(
                "M086",
                fields.span_of(key),
                format!("friction at rest is {}, but {} as soon as it slides", limit.en, value.en),
                format!("трение покоя {}, а при начале скольжения {}", limit.ru, value.ru),
            )
            .why(
                "a body that broke away would be stopped at once: the limit at rest is not below the friction while sliding",
                "сорвавшееся тело тут же остановилось бы: предел трения покоя не меньше трения скольжения",
            )
            .help(format!("raise `{key}`, or leave it out"), format!("увеличьте `{key}` или не задавайте")),
        );
        return false;
    }
    true
}

fn at_rest(reader: &mut Reader, kinetic: Expr, speed: SymbolId) -> Expr {
    let graph = &mut reader.builder.graph;
    let zero = graph.zero();
    Substitution::new([(speed, zero)]).apply(graph, kinetic)
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    Ok(vec![sliding::friction(scene, kinematics, resolver, connection)?])
}
