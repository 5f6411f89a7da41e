//! Chains: open belts whose slack strand carries nothing.

use super::common::keys::{CARRIER, RADII, WHEELS, table};
use super::common::made::Made;
use super::common::reading::{Space, choose};
use super::common::wheels::{self, components};
use super::row::Row;
use crate::keys::{LABEL, TableSpec, Type, may};
use crate::model::Strands;
use crate::reader::{Fields, Reader};

/// `[chains]`.
pub(super) const ROW: Row =
    Row { keys: &KEYS, listed: ("chains", "цепи"), chapter: "space-connections", within: &[], read, components };

/// `[chains.NAME]`.
const KEYS: TableSpec = table(
    "chains",
    ("Chains: as open belts, with a slack side that carries nothing.", "Цепи: как открытые ремни; ведомая ветвь не нагружена."),
    &[
        WHEELS,
        RADII,
        may(
            "tight",
            Type::String,
            "",
            "not known",
            (
                "sign of force: \"+\" or \"-\"; then tight_side is abs(force), slack_side 0, and the axles feel it. The motion ends where force has the other sign. Without it what an axle alone is held with has no value",
                "знак force: \"+\" или \"-\"; тогда tight_side равно abs(force), slack_side — 0, и оси это воспринимают. Движение кончается там, где знак force другой. Без него реакции отдельной оси не определены",
            ),
            "\"+\"",
        ),
        CARRIER,
        LABEL,
    ],
    "[chains.X]\nbetween = [\"front\", \"rear\"]\nradii = [\"r1\", \"r2\"]\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let strands = match fields.name(reader, "tight") {
        Some((word, span)) => Strands::Slack { positive: choose(reader, &word, span, &["+", "-"])? == 0 },
        None => Strands::Open,
    };
    wheels::read(reader, fields, space, (wheels::Senses::Equal, strands))
}
