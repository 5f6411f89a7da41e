//! Belts without slip, open or crossed, with a pretension or without.

use super::common::keys::{CARRIER, RADII, WHEELS, table};
use super::common::made::Made;
use super::common::reading::Space;
use super::common::wheels::{self, Senses, components};
use super::row::Row;
use crate::formula::Context;
use crate::keys::{LABEL, TableSpec, Type, may};
use crate::model::Strands;
use crate::reader::{Fields, Reader};
use crate::units::Dimension;
use symbolic::Expr;
use words::Notice;
use words::digits::quantity;

/// `[belts]`.
pub(super) const ROW: Row = Row { keys: &KEYS, listed: ("belts", "ремни"), chapter: "reactions", within: &[], read, components };

/// `[belts.NAME]`.
const KEYS: TableSpec = table(
    "belts",
    (
        "Belts without slip. force is the tension difference, positive when it turns the second wheel in the positive direction.",
        "Ремни без проскальзывания. force — разность натяжений ветвей, положительна, если вращает второе колесо в положительную сторону.",
    ),
    &[
        WHEELS,
        RADII,
        may("crossed", Type::Bool, "", "false", ("whether it is crossed", "перекрёстный ли"), "true"),
        may(
            "pretension",
            Type::Formula,
            "N",
            "not known",
            (
                "half the sum of the tensions, that of each strand when nothing is transmitted; then tight_side and slack_side are pretension ± abs(force)/2, and the axles feel them. Without it what an axle alone is held with has no value",
                "полусумма натяжений ветвей: натяжение каждой ветви без нагрузки; тогда tight_side и slack_side равны pretension ± abs(force)/2, и оси их воспринимают. Без него реакции отдельной оси не определены",
            ),
            "\"300 N\"",
        ),
        CARRIER,
        LABEL,
    ],
    "[belts.S]\nbetween = [\"flywheel\", \"pulley\"]\nradii = [\"r1\", \"R4\"]\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let senses = if fields.flag(reader, "crossed").unwrap_or(false) { Senses::Opposite } else { Senses::Equal };
    let strands = match fields.has("pretension") {
        true => Strands::Pretension(pretension(reader, fields)?),
        false => Strands::Open,
    };
    wheels::read(reader, fields, space, (senses, strands))
}

/// Half the sum of the tensions.
fn pretension<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Expr> {
    let value = fields.formula(reader, "pretension", &Context::CONSTANT, Some(&Dimension::FORCE))?;
    let Some(number) = reader.number(&value).filter(|v| *v < 0.0) else { return value.good.then_some(value.expr) };
    let n = quantity(number, "N");
    reader.fault(
        Notice::piece(
            "M074",
            fields.span_of("pretension"),
            format!("`pretension` is {}; it must not be negative", n.en),
            format!("`pretension` равно {}; отрицательным быть не может", n.ru),
        )
        .why("the strands of a belt pull", "ветви ремня тянут"),
    );
    None
}
