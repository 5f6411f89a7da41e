//! One-sided stops: the gap, pathway less limit or limit less pathway, is never negative; the force pushes it open.

use super::common::component::{Component, Nature, effort, path};
use super::common::faults;
use super::common::keys::{ALONG, BETWEEN, ON_BODY, RESTITUTION, table};
use super::common::made::Made;
use super::common::reading::{Space, one_of, pathway, restitution, restitution_by, word};
use super::row::Row;
use crate::formula::{Context, Kind};
use crate::keys::{LABEL, TableSpec, Type, may};
use crate::model::{Connection, ConnectionKind, Part, Pathway};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::Path;
use crate::scene::requests::Resolver;
use crate::scene::{Found, Scene};
use symbolic::Expr;
use symbolic::connections::Rebound;
use words::{Notice, Text};

/// `[stops]`.
pub(super) const ROW: Row =
    Row {
        keys: &KEYS, listed: ("one-sided stops", "односторонние упоры"), chapter: "switching", within: &[], read, components
    };

/// `[stops.NAME]`.
const KEYS: TableSpec = table(
    "stops",
    (
        "One-sided stops: the pathway does not pass the limit. force is positive and pushes it back.",
        "Односторонние упоры: координата не переходит предел. force положительна и отталкивает от него.",
    ),
    &[
        ALONG,
        BETWEEN,
        ON_BODY,
        may(
            "at_least",
            Type::Formula,
            "",
            "",
            (
                "least value of the pathway; over parameters and time, not coordinates",
                "наименьшее значение координаты; от параметров и времени, не от координат",
            ),
            "\"0 m\"",
        ),
        may(
            "at_most",
            Type::Formula,
            "",
            "",
            ("instead: greatest value, likewise", "вместо него: наибольшее значение, так же"),
            "\"0.2 m\"",
        ),
        RESTITUTION,
        may(
            "tangential_restitution",
            Type::Formula,
            "1",
            "0",
            (
                "ratio of the sliding speeds after and before the impact, reversed, of a friction that the stop presses, as far as the friction can; 0 ... 1",
                "отношение скоростей скольжения после и до удара, с обратным знаком, у трения, которое прижимает упор, насколько хватает трения; 0 ... 1",
            ),
            "0.4",
        ),
        may(
            "law",
            Type::String,
            "",
            "\"newton\"",
            (
                "what the restitution is the ratio of: \"newton\" of rates, \"poisson\" of impulses (the one of opening to the one of closing, with Coulomb's friction through both phases)",
                "отношение чего задаёт restitution: \"newton\" — скоростей, \"poisson\" — импульсов (фазы восстановления к фазе сближения, с кулоновым трением в обеих)",
            ),
            "\"poisson\"",
        ),
        LABEL,
    ],
    "[stops.floor]\nalong = \"y\"\nat_least = 0\nrestitution = 0.8\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Made> {
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
    clearance.good.then(|| Made::along(found, kind.conjugate()))
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

fn components(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Stop { gap, clearance, above, restitution, tangential, rebound } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let path = path(scene, kinematics, resolver, connection, *gap)?;
    let clearance = resolver.resolve(scene, kinematics, *clearance)?;
    let normal = resolver.resolve(scene, kinematics, *restitution)?;
    let restitution = [normal, resolver.resolve(scene, kinematics, *tangential)?];
    let way = if *above { Way::Above } else { Way::Below };
    Ok(vec![stop(scene, (&connection.name, *gap), &path, (clearance, way, restitution, *rebound))])
}

/// Where the pathway stays.
enum Way {
    Above,
    Below,
}

/// gap = pathway - clearance, or clearance - pathway.
fn stop(
    scene: &mut Scene,
    (name, pathway): (&str, Pathway),
    path: &Path,
    (clearance, way, restitution, rebound): (Expr, Way, [Expr; 2], Rebound),
) -> Component {
    let (gap, acts) = match way {
        Way::Above => (scene.graph.sub(path.value, clearance), path.acts.clone()),
        Way::Below => {
            let gap = scene.graph.sub(clearance, path.value);
            let minus = scene.graph.int(-1);
            (gap, path.acts.iter().map(|act| act.times(scene, minus)).collect())
        }
    };
    let (letter, unit) = effort(pathway, "M", "N");
    let label = Text::new(format!("stop {name}"), format!("упор {name}"));
    Component {
        place: Some(gap),
        nature: Nature::Contact { gap, restitution, tie: false, rebound },
        ..Component::ideal((Part::Force, letter, unit), label, acts)
    }
}
