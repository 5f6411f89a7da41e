//! `[stops]`, `[frictions]`.

use super::common::{Space, choose, one_of, pathway, restitution, restitution_by, word};
use super::{Found, rubbing};
use crate::formula::{Context, Depends, Entry, EntryKind, Kind};
use crate::model::{ConnectionKind, Part, Pressing, Reliance, RequestKind, Slides};
use crate::reader::{Checked, Fields, Reader};
use crate::units::si_label;
use symbolic::connections::{Impacts, Rebound};
use symbolic::{Expr, Substitution, SymbolId};
use words::Notice;
use words::digits::quantity;

pub(super) fn stop<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Found> {
    let path = pathway(reader, fields);
    let restitution = restitution(reader, fields);
    let tangential = restitution_by(reader, fields, "tangential_restitution");
    let rebound = rebound(reader, fields)?;
    let key = one_of(reader, fields, ["at_least", "at_most"], "at_least = \"0 m\"")?;
    let wanted = match path {
        Some((_, Kind::Known(d))) => Some(d),
        _ => None,
    };
    let clearance = fields.formula(reader, key, &Context::TIME, wanted.as_ref())?;
    let (gap, kind) = path?;
    let found = ConnectionKind::Stop { gap, clearance: clearance.expr, above: key == "at_least", restitution, tangential, rebound };
    clearance.good.then(|| Found { kind: found, force: kind.conjugate() })
}

/// `law`: what the restitution is the ratio of.
fn rebound<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Rebound> {
    let law = [Rebound::Newton, Rebound::Poisson][word(reader, fields, "law", &["newton", "poisson"])?];
    if law == Rebound::Poisson && fields.has("tangential_restitution") {
        let fault = Notice::piece(
            "M127",
            fields.span_of("tangential_restitution"),
            "`tangential_restitution` belongs to Newton's law",
            "`tangential_restitution` относится к закону Ньютона",
        )
        .why(
            "by Poisson's law the friction follows Coulomb's law through both phases of the impact and gives nothing back",
            "по закону Пуассона трение в обеих фазах удара подчиняется закону Кулона и ничего не возвращает",
        )
        .help("keep one of them", "оставьте одно из двух");
        reader.fault(fault);
        return None;
    }
    Some(law)
}

/// `impacts`, at the top of the file.
pub fn impacts<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Impacts {
    let Some((text, span)) = top.get("impacts").and_then(|v| Some((v.get_ref().as_str()?, v.span()))) else { return Impacts::default() };
    match choose(reader, text, span, &["in sequence", "together"]) {
        Some(1) => Impacts::Together,
        _ => Impacts::InSequence,
    }
}

pub(super) fn friction<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Found> {
    let place = rubbing::slides(reader, fields);
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
        (_, None) if by_coefficient => place.as_ref().map(|p| rubbing::coefficient(&p.0)),
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
    good.then_some(Found { kind, force })
}

/// The keys of the law and of the limit at rest: a force, or coefficients of a normal force.
fn keys<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, slides: Option<&Slides>) -> Option<[&'static str; 2]> {
    let laws: Vec<&'static str> = ["kinetic", "curve", "coefficient", "lever"].into_iter().filter(|key| fields.has(key)).collect();
    let &[law] = laws.as_slice() else {
        let path = &fields.path;
        let fault = Notice::piece(
            "M080",
            laws.get(1).map_or(fields.span.clone(), |key| fields.span_of(key)),
            format!("{path} needs one of `kinetic`, `curve`, `coefficient`"),
            format!("в {path} нужно одно из `kinetic`, `curve`, `coefficient`"),
        );
        reader.fault(fault.help(
            "kinetic = \"F2\" is a force; coefficient = 0.2 needs normal = \"N\"",
            "kinetic = \"F2\" — сила; к coefficient = 0.2 нужно normal = \"N\"",
        ));
        return None;
    };
    let own = match law {
        "coefficient" => "static_coefficient",
        "lever" => "static_lever",
        _ => "static",
    };
    let by_coefficient = own != "static";
    let presses = slides.is_some_and(rubbing::presses);
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
    Some((reader.builder.graph.symbol_id("u", 0), rate))
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
