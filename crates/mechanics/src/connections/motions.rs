//! Prescribed motions: a pathway, or its rate, is a formula of time. Motors give the forces.

use super::common::component::{Component, Nature, path};
use super::common::faults;
use super::common::keys::{ALONG, BETWEEN, ON_BODY, table};
use super::common::made::Made;
use super::common::reading::{Space, one_of, pathway};
use super::row::Row;
use crate::formula::{Context, Kind};
use crate::keys::{LABEL, TableSpec, Type, may};
use crate::model::{Connection, ConnectionKind};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::Path;
use crate::scene::requests::Resolver;
use crate::scene::{Columns, Found, Scene};
use symbolic::Expr;
use words::Text;

/// `[motions]`.
pub(super) const ROW: Row =
    Row {
        keys: &KEYS, listed: ("prescribed motions", "заданные движения"), chapter: "inverse", within: &[], read, components
    };

/// `[motions.NAME]`.
const KEYS: TableSpec = table(
    "motions",
    (
        "Prescribed motions: the pathway, or its rate, is a formula of time. Motors realise them.",
        "Заданные движения: координата или её скорость — функция времени. Их создают двигатели.",
    ),
    &[
        ALONG,
        BETWEEN,
        ON_BODY,
        may("value", Type::Formula, "", "", ("value of the pathway", "значение координаты"), "\"0.1 [m]*sin(p*t)\""),
        may("rate", Type::Formula, "", "", ("instead: its rate", "вместо него: скорость"), "\"v*sin(p*t)\""),
        LABEL,
    ],
    "[motions.lift]\nalong = \"y(A)\"\nrate = \"v*sin(p*t)\"\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Made> {
    let path = pathway(reader, fields);
    let key = one_of(reader, fields, ["value", "rate"], "value = \"0.1 [m]*sin(p*t)\"")?;
    let is_rate = key == "rate";
    let wanted = match path {
        Some((_, Kind::Known(d))) => Some(if is_rate { d.per_time(1) } else { d }),
        _ => None,
    };
    let value = fields.formula(reader, key, &Context::TIME, wanted.as_ref())?;
    let pathway = path?.0;
    value.good.then(|| Made::of(ConnectionKind::Motion { pathway, value: value.expr, is_rate }))
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Motion { pathway, value, is_rate } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let path = path(scene, kinematics, resolver, connection, *pathway)?;
    let value = resolver.resolve(scene, kinematics, *value)?;
    let name = &connection.name;
    Ok(vec![if *is_rate { motion_by_rate(scene, name, &path, value) } else { motion(scene, name, &path, value) }])
}

/// pathway - value(t)
fn motion(scene: &mut Scene, name: &str, path: &Path, value: Expr) -> Component {
    Component { place: Some(scene.graph.sub(path.value, value)), ..prescribed(name) }
}

/// Rate of the pathway - value(t).
fn motion_by_rate(scene: &mut Scene, name: &str, path: &Path, value: Expr) -> Component {
    let rate = scene.rate_of(&path.gradient);
    Component { rate: Some(scene.graph.sub(rate, value)), ..prescribed(name) }
}

/// A motion without its condition.
fn prescribed(name: &str) -> Component {
    Component {
        part: None,
        letter: "",
        unit: "",
        label: Text::new(format!("prescribed motion {name}"), format!("заданное движение {name}")),
        place: None,
        rate: None,
        negative: false,
        acts: Vec::new(),
        nature: Nature::Motion,
        doubts: Vec::new(),
        beside: Columns::new(),
        open: Vec::new(),
    }
}
