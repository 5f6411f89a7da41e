//! `[events.NAME]`: formulas whose zeros are instants to be found.

use crate::fields;
use crate::formula::{Context, Kind};
use crate::model::{EventDecl, EventDirection};
use crate::reader::{Fields, Reader, string};
use crate::units::si_label;
use words::Notice;

/// All events, in the user's order; formulas may use what outputs may.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<EventDecl> {
    let entries = top.entries(reader, "events", &fields::events::EVENT);
    entries.into_iter().filter_map(|(name, fields)| event(reader, name, &fields)).collect()
}

fn event<'a>(reader: &mut Reader<'a>, name: String, fields: &Fields<'a>) -> Option<EventDecl> {
    let direction = direction(reader, fields);
    let stop = fields.flag(reader, "stop").unwrap_or(false);
    let label = fields.text(reader, "label").unwrap_or_default();
    let zero = fields.formula(reader, "zero", &Context::OUTPUT, None)?;
    let span = fields.span_of("zero");
    // of a quantity that has an error of its own nothing is known
    let known = !matches!(zero.kind, Kind::Unknown);
    if zero.good && known && zero.depends.is_constant() {
        let fault = Notice::piece(
            "M113",
            span.clone(),
            format!("the event `{name}` waits for a zero of a constant"),
            format!("событие `{name}` ждёт нуля постоянной величины"),
        );
        let (en, ru) = (
            "write a formula that changes with the motion: zero = \"phi - 1 [rad]\"",
            "напишите формулу, меняющуюся при движении: zero = \"phi - 1 [рад]\"",
        );
        reader.fault(fault.help(en, ru));
    }
    let unit = match zero.kind {
        Kind::Known(dimension) => si_label(&dimension),
        _ => String::new(),
    };
    zero.good.then(|| EventDecl {
        symbol: reader.builder.graph.symbol_id(&format!("event_{name}"), 0),
        name,
        label,
        zero: zero.expr,
        unit,
        direction,
        stop,
        span,
    })
}

fn direction<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> EventDirection {
    let Some((word, span)) = fields.get("direction").and_then(|v| string(reader, v, "a word", "слово")) else {
        return EventDirection::Both;
    };
    match word.trim() {
        "rising" => EventDirection::Rising,
        "falling" => EventDirection::Falling,
        "both" => EventDirection::Both,
        other => {
            let fault = Notice::piece(
                "M112",
                span,
                format!("an event has no direction \"{other}\""),
                format!("у события нет направления \"{other}\""),
            );
            reader.fault(fault.help("write \"rising\", \"falling\" or \"both\"", "напишите \"rising\", \"falling\" или \"both\""));
            EventDirection::Both
        }
    }
}
