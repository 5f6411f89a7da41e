//! Conditions of any form: a formula of coordinates, or one that is linear in rates, vanishes; the reaction is its multiplier.

use super::common::component::Component;
use super::common::faults;
use super::common::keys::table;
use super::common::made::Made;
use super::common::reading::{Space, one_of};
use super::row::Row;
use crate::formula::{Context, Kind};
use crate::keys::{LABEL, TableSpec, Type, may};
use crate::model::{Connection, ConnectionKind, Measure, Part, RequestKind};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::{Given, located};
use crate::scene::requests::Resolver;
use crate::scene::{Found, Scene};
use crate::units::Dimension;
use symbolic::{Expr, SymbolId};
use words::{Notice, Text};

/// `[constraints]`.
pub(super) const ROW: Row =
    Row {
        keys: &KEYS, listed: ("conditions of any form", "связи общего вида"), chapter: "kinematics", within: &[], read, components
    };

/// `[constraints.NAME]`.
const KEYS: TableSpec = table(
    "constraints",
    (
        "Conditions of any form. force is the multiplier of the left side: its generalized force on q is force*d(zero)/dq (of zero_rate: d/dq').",
        "Связи общего вида. force — множитель левой части: обобщённая сила по q равна force*d(zero)/dq (для zero_rate — d/dq').",
    ),
    &[
        may(
            "zero",
            Type::Formula,
            "",
            "",
            ("vanishes at all times: over coordinates and time", "равно нулю всегда: от координат и времени"),
            "\"x(A) - x(B)\"",
        ),
        may(
            "zero_rate",
            Type::Formula,
            "",
            "",
            ("instead: vanishes at all times, linear in rates", "вместо этого: равно нулю всегда, линейно по скоростям"),
            "\"x' - R*phi'\"",
        ),
        LABEL,
    ],
    "[constraints.K]\nzero = \"x^2 + y^2 - l^2\"\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Made> {
    let key = one_of(reader, fields, ["zero", "zero_rate"], "zero = \"x - l*cos(phi)\"")?;
    let on_rates = key == "zero_rate";
    let context = if on_rates { &Context::RATES } else { &Context::PATHWAY };
    let zero = fields.formula(reader, key, context, None)?;
    if !zero.good {
        return None;
    }
    if !zero.depends.is_state() {
        reader.fault(
            Notice::piece(
                "M083",
                fields.span_of(key),
                format!("{} does not depend on the motion", fields.path),
                format!("{} не зависит от движения", fields.path),
            )
            .why("a condition without coordinates holds always or never", "условие без координат выполнено всегда или никогда"),
        );
        return None;
    }
    if on_rates && !is_affine(reader, zero.expr) {
        reader.fault(
            Notice::piece("M083", fields.span_of(key), "this condition is not linear in the rates", "это условие не линейно по скоростям")
                .why(
                    "an ideal connection forbids directions of motion; a product of rates is no such condition",
                    "идеальная связь запрещает направления движения; произведение скоростей такого условия не даёт",
                )
                .help("write it linear in x', vx(A), omega(B)", "запишите его линейно по x', vx(A), omega(B)"),
        );
        return None;
    }
    // position: Q = λ ∂zero/∂q; rates: Q = λ ∂zero/∂q'
    let work = if on_rates { Dimension::POWER } else { Dimension::ENERGY };
    let force = match zero.kind {
        Kind::Known(d) => work.div(&d.without_angle()).map_or(Kind::Unknown, Kind::Known),
        other => other,
    };
    Some(Made::along(ConnectionKind::Constraint { zero: zero.expr, on_rates }, force))
}

/// Whether the second derivatives in rates and velocities vanish, as far as the formula shows.
fn is_affine(reader: &mut Reader, e: Expr) -> bool {
    let moving = |kind: &RequestKind| matches!(kind, RequestKind::Velocity(..) | RequestKind::AngularVelocity(_) | RequestKind::Speed(_));
    let rates: Vec<SymbolId> =
        reader.scope.rates().into_iter().chain(reader.builder.requests.iter().filter(|r| moving(&r.kind)).map(|r| r.symbol)).collect();
    let graph = &mut reader.builder.graph;
    let within = graph.symbols_in(&[e]);
    let used: Vec<SymbolId> = rates.into_iter().filter(|s| within.binary_search(s).is_ok()).collect();
    let speeds = reader.builder.requests.iter().filter(|r| matches!(r.kind, RequestKind::Speed(_)));
    if speeds.into_iter().any(|r| used.contains(&r.symbol)) {
        return false;
    }
    used.iter().all(|s| {
        let slope = graph.derivative(e, *s);
        !graph.contains(slope, |symbol| used.contains(&symbol))
    })
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Constraint { zero, on_rates } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let given = if *on_rates { Given::Rates } else { Given::Pathway(Measure::Other) };
    let acts = located(scene, kinematics, resolver, (&connection.name, *zero), given)?;
    let zero = resolver.resolve(scene, kinematics, *zero)?;
    let (place, rate) = if *on_rates { (None, Some(zero)) } else { (Some(zero), None) };
    let name = &connection.name;
    let label = Text::new(format!("constraint {name}"), format!("связь {name}"));
    Ok(vec![Component { place, rate, ..Component::ideal((Part::Force, "λ", ""), label, acts) }])
}
