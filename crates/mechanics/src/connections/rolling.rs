//! Rolling on a line or a circle: the contact point of the wheel has the velocity of the track there, the centre keeps its distance.

use super::common::keys::{CENTER, DIRECTION, ON_FRAME, RADIUS, SIDE, THROUGH, table};
use super::common::made::Made;
use super::common::reading::{Space, direction, fixed_in, restitution, size, word};
use super::common::tracks::{Wheel, components, wheel};
use super::row::Row;
use crate::formula::Context;
use crate::keys::{LABEL, TableSpec, Type, may, must};
use crate::model::{ConnectionKind, FrameId, Part, Track};
use crate::reader::{Fields, Reader, wrong_type};
use toml::de::DeValue;
use words::{Notice, digits};

/// `[rolling]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("rolling without slip", "качение без проскальзывания"),
    chapter: "reactions",
    within: &[&CIRCLE],
    read,
    components,
};

/// `[rolling.NAME]`.
const KEYS: TableSpec = table(
    "rolling",
    (
        "Rolling without slip on a line or a circle. normal acts on the wheel away from the track, tangential along the line's direction; on a circle along the normal turned by -90 degrees.",
        "Качение без проскальзывания по прямой или окружности. normal действует на колесо от опоры, tangential — вдоль направления прямой; на окружности — вдоль нормали, повёрнутой на −90°.",
    ),
    &[
        must("body", Type::Name, "", ("the wheel", "колесо"), "\"roller\""),
        RADIUS,
        CENTER,
        ON_FRAME,
        THROUGH,
        DIRECTION,
        SIDE,
        may(
            "circle",
            Type::Table,
            "",
            "",
            ("a circle instead of a line: { center, radius, inside }", "окружность вместо прямой: { center, radius, inside }"),
            "{ center = \"O\", radius = \"R\", inside = true }",
        ),
        may(
            "held",
            Type::Bool,
            "",
            "true",
            (
                "whether the track keeps the wheel at its distance; false when the coordinates do that and no normal reaction is wanted",
                "удерживает ли опора колесо на расстоянии; false, если это делают координаты и нормальная реакция не нужна",
            ),
            "false",
        ),
        may(
            "leaves",
            Type::Bool,
            "",
            "false",
            (
                "whether the track only pushes: the wheel leaves it when the normal force vanishes, and may land again; without it a normal force that would have to pull is an event and a note",
                "только ли давит опора: колесо отрывается, когда нормальная реакция обращается в нуль, и может снова опуститься; без этого реакция, которой пришлось бы тянуть, отмечается событием и примечанием",
            ),
            "true",
        ),
        may(
            "restitution",
            Type::Formula,
            "1",
            "0",
            ("of a landing, 0 ... 1; with `leaves`", "при падении на опору, 0 ... 1; вместе с `leaves`"),
            "0.3",
        ),
        LABEL,
    ],
    "[rolling.F]\nbody = \"roller\"\nradius = \"R5\"\ndirection = \"alpha\"\n",
);

/// `circle = { ... }`.
const CIRCLE: TableSpec = table(
    "circle",
    ("a circular track", "круговая опора"),
    &[
        must(
            "center",
            Type::Name,
            "",
            (
                "its centre, a point fixed in `on`, or a body for its origin",
                "её центр: точка, неподвижная в `on`, или тело (тогда его начало)",
            ),
            "\"O\"",
        ),
        must("radius", Type::Formula, "m", ("its radius", "её радиус"), "\"R\""),
        may("inside", Type::Bool, "", "false", ("whether the wheel is inside", "внутри ли колесо"), "true"),
    ],
    "",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let wheel = wheel(reader, fields, space, "body");
    let held = fields.flag(reader, "held").unwrap_or(true);
    let leaves = fields.flag(reader, "leaves").unwrap_or(false);
    let restitution = restitution(reader, fields);
    let idle = match leaves {
        true => (!held).then_some("leaves"),
        false => fields.has("restitution").then_some("restitution"),
    };
    if let Some(key) = idle {
        reader.fault(cannot_leave(fields, key));
        return None;
    }
    let on = wheel.as_ref().map_or(FrameId::GROUND, |w| w.on);
    let track = match fields.get("circle") {
        None => line(reader, fields, space, on),
        Some(_) => circle(reader, fields, space, wheel.as_ref()),
    };
    let (wheel, track) = (wheel?, track?);
    let Wheel { frame: wheel, center, radius, on, .. } = wheel;
    let kind = ConnectionKind::Rolling { wheel, center, radius, on, track, held, leaves: leaves.then_some(restitution) };
    let parts: &[Part] = if held { &[Part::Force, Part::Normal, Part::Tangential] } else { &[Part::Force, Part::Tangential] };
    Some(Made::of(kind).forces(parts))
}

/// Only a wheel that is held by its track alone can leave it, and land again.
fn cannot_leave(fields: &Fields, key: &'static str) -> Notice {
    Notice::piece(
        "M080",
        fields.span_of(key),
        format!("`{key}` has no meaning for a wheel that cannot leave its track"),
        format!("`{key}` не имеет смысла: колесо не может оторваться от опоры"),
    )
    .help(
        "leaves = true needs coordinates that let the wheel leave, and no held = false; restitution needs leaves = true",
        "для leaves = true нужны координаты, допускающие отрыв, и не нужно held = false; restitution — только вместе с leaves = true",
    )
}

fn line<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, on: FrameId) -> Option<Track> {
    let (direction, side) = (direction(reader, fields), word(reader, fields, "side", &["left", "right"]));
    let through = fixed_in(reader, fields, "through", space, on)?;
    Some(Track::Line { through, direction, left: side? == 0 })
}

fn circle<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, wheel: Option<&Wheel>) -> Option<Track> {
    let value = fields.get("circle")?;
    if let Some(key) = ["through", "direction", "side"].into_iter().find(|key| fields.has(key)) {
        reader.fault(
            Notice::piece(
                "M080",
                fields.span_of(key),
                format!("`{key}` belongs to a line, but there is a circle"),
                format!("`{key}` относится к прямой, а задана окружность"),
            )
            .help("keep either the line or the circle", "оставьте либо прямую, либо окружность"),
        );
        return None;
    }
    let DeValue::Table(table) = value.get_ref() else {
        reader.fault(wrong_type(
            value.span(),
            "a table { center, radius, inside }",
            "таблица { center, radius, inside }",
            value.get_ref().type_str(),
        ));
        return None;
    };
    let track = Fields::open(reader, &CIRCLE, table, value.span(), fields.path_of("circle"));
    let inside = track.flag(reader, "inside").unwrap_or(false);
    let radius = size(reader, &track, "radius", &Context::CONSTANT);
    let center = fixed_in(reader, &track, "center", space, wheel.map_or(FrameId::GROUND, |w| w.on))?;
    let (center, radius) = (center?, radius?);
    let sizes = wheel.and_then(|w| w.size).zip(reader.number_of(radius));
    if let Some((small, large)) = sizes.filter(|(small, large)| inside && small >= large) {
        let [small, large] = [small, large].map(|r| digits::quantity(r, "m"));
        reader.fault(
            Notice::piece(
                "M074",
                track.span_of("radius"),
                format!("a wheel of radius {} does not fit into a circle of radius {}", small.en, large.en),
                format!("колесо радиуса {} не помещается в окружности радиуса {}", small.ru, large.ru),
            )
            .why("inside a circle the wheel is the smaller one", "внутри окружности колесо меньше неё"),
        );
        return None;
    }
    Some(Track::Circle { center, radius, inside })
}
