//! `[constraints]`, `[motions]`, `[motors]`.

use super::Found;
use super::common::{Space, one_of, pathway};
use crate::formula::{Context, Kind};
use crate::model::{ConnectionKind, RequestKind};
use crate::reader::{Fields, Reader};
use crate::units::Dimension;
use symbolic::{Expr, SymbolId};
use words::Notice;

pub(super) fn constraint<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Found> {
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
    Some(Found { kind: ConnectionKind::Constraint { zero: zero.expr, on_rates }, force })
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

pub(super) fn motion<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Found> {
    let path = pathway(reader, fields);
    let key = one_of(reader, fields, ["value", "rate"], "value = \"0.1 [m]*sin(p*t)\"")?;
    let is_rate = key == "rate";
    let wanted = match path {
        Some((_, Kind::Known(d))) => Some(if is_rate { d.per_time(1) } else { d }),
        _ => None,
    };
    let value = fields.formula(reader, key, &Context::TIME, wanted.as_ref())?;
    let pathway = path?.0;
    value.good.then(|| ConnectionKind::Motion { pathway, value: value.expr, is_rate }.into())
}

pub(super) fn motor<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Found> {
    let (pathway, kind) = pathway(reader, fields)?;
    Some(Found { kind: ConnectionKind::Motor { pathway }, force: kind.conjugate() })
}
