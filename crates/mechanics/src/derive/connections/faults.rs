//! Faults of wheels, tracks and drums.

use crate::diagnostic::Diagnostic;
use crate::model::{Connection, FrameId, Model};
use symbolic::Text;

/// Two wheels without parallel axes.
pub fn no_common_axis(model: &Model, connection: &Connection, wheels: [FrameId; 2]) -> Box<Diagnostic> {
    let [a, b] = wheels.map(|f| &model.frames[f.index()].name);
    let fault = Diagnostic::error(
        "M116",
        connection.span.clone(),
        Text::new(format!("`{a}` and `{b}` have no common axis"), format!("у `{a}` и `{b}` нет общей оси вращения")),
    )
    .why(Text::new(
        "belts, chains and gears join bodies that turn against each other about one axis: an own x, y or z axis of each stays parallel to it",
        "ремни, цепи и зубчатые пары соединяют тела, которые вращаются друг относительно друга вокруг одной оси: собственная ось x, y или z каждого остаётся ей параллельна",
    ))
    .help(Text::new(
        "give both the same axis, rotate = [\"x: a\"] and [\"x: b\"], or write the condition out: [constraints] zero_rate = \"r1*a' + r2*b'\"",
        "задайте обоим одну ось, rotate = [\"x: a\"] и [\"x: b\"], или запишите условие сами: [constraints] zero_rate = \"r1*a' + r2*b'\"",
    ));
    Box::new(fault)
}

/// A wheel that does not lie in the plane of its track.
pub fn wheel_not_in_plane(model: &Model, connection: &Connection, wheel: FrameId, on: FrameId) -> Box<Diagnostic> {
    let [wheel, on] = [wheel, on].map(|f| &model.frames[f.index()].name);
    let fault = Diagnostic::error(
        "M116",
        connection.span.clone(),
        Text::new(
            format!("no axis of `{wheel}` stays parallel to z of `{on}`"),
            format!("ни одна ось тела `{wheel}` не остаётся параллельной оси z системы `{on}`"),
        ),
    )
    .why(Text::new(
        "the track lies in the plane x, y of its frame, and the wheel turns about the normal of that plane",
        "опора лежит в плоскости x, y своей системы, и колесо вращается вокруг нормали к этой плоскости",
    ))
    .help(Text::new(
        "name under `on` a frame whose z axis is the axis of the wheel, or write the condition out: [constraints] zero_rate = \"vx(C) - r*a'\"",
        "укажите в `on` систему, ось z которой — ось колеса, или запишите условие сами: [constraints] zero_rate = \"vx(C) - r*a'\"",
    ));
    Box::new(fault)
}

/// A wheel that moves along its axis.
pub fn leaves_plane(model: &Model, connection: &Connection, wheel: FrameId, on: FrameId) -> Box<Diagnostic> {
    let [wheel, on] = [wheel, on].map(|f| &model.frames[f.index()].name);
    let fault = Diagnostic::error(
        "M118",
        connection.span.clone(),
        Text::new(
            format!("the centre of `{wheel}` moves along z of `{on}`, out of the plane of its track"),
            format!("центр колеса `{wheel}` движется вдоль оси z системы `{on}`, то есть выходит из плоскости опоры"),
        ),
    )
    .why(Text::new(
        "rolling holds the wheel in the plane x, y of the track's frame, not along its axis",
        "качение удерживает колесо в плоскости x, y системы опоры, но не вдоль его оси",
    ))
    .help(Text::new("let the coordinates keep the centre in the plane", "выберите координаты так, чтобы центр оставался в плоскости"));
    Box::new(fault)
}

/// Wheels whose distance changes.
pub fn axes_part(connection: &Connection) -> Box<Diagnostic> {
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Diagnostic::error(
        "M118",
        connection.span.clone(),
        Text::new(
            format!("the axes of `{of}` move apart: nothing keeps their distance"),
            format!("оси колёс `{of}` сближаются и расходятся: межосевое расстояние ничем не удержано"),
        ),
    )
    .why(Text::new(
        "teeth would leave their mesh, and a belt or chain would change its length",
        "зубья вышли бы из зацепления, а длина ремня или цепи изменилась бы",
    ))
    .help(Text::new(
        "put both wheels on one body, hold the distance by a pin or rod, or write the condition out in [constraints]",
        "поставьте оба колеса на одно тело, удержите расстояние шарниром или стержнем либо запишите условие в [constraints]",
    ));
    Box::new(fault)
}

/// A carrier that does not carry the axes.
pub fn not_the_carrier(model: &Model, connection: &Connection, frame: FrameId) -> Box<Diagnostic> {
    let name = &model.frames[frame.index()].name;
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Diagnostic::error(
        "M117",
        connection.span.clone(),
        Text::new(
            format!("the axes of `{of}` move against the carrier `{name}`"),
            format!("оси колёс `{of}` движутся относительно водила `{name}`"),
        ),
    )
    .why(Text::new(
        "turning counts from the body that carries both axes; counted from another body it does not tell what slips",
        "повороты отсчитывают от тела, несущего обе оси; отсчёт от другого тела не выражает отсутствия проскальзывания",
    ))
    .help(Text::new(
        "name the body on which the axes stand, or drop `carrier`: it then follows from the line of centres",
        "укажите тело, на котором стоят оси, или уберите `carrier`: тогда отсчёт ведётся от линии центров",
    ));
    Box::new(fault)
}

/// Wheels at one place, one of them on a turning body.
pub fn no_carrier(model: &Model, connection: &Connection, arm: FrameId) -> Box<Diagnostic> {
    let arm = &model.frames[arm.index()].name;
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Diagnostic::error(
        "M117",
        connection.span.clone(),
        Text::new(
            format!("`{of}`: a wheel stands on `{arm}`, which turns, and the centres coincide"),
            format!("`{of}`: одно из колёс стоит на `{arm}`, которое вращается, а центры колёс совпадают"),
        ),
    )
    .why(Text::new(
        "turning counts from the line of centres; without a line it must be said which body carries both axes",
        "повороты отсчитывают от линии центров; если её нет, нужно указать тело, несущее обе оси",
    ))
    .help(Text::new(
        format!("add carrier = \"{arm}\", or give the wheels the places of their centres"),
        format!("добавьте carrier = \"{arm}\" или задайте положения центров колёс"),
    ));
    Box::new(fault)
}

/// A drum whose carrier is unknown.
pub fn no_drum_carrier(model: &Model, connection: &Connection, drum: FrameId) -> Box<Diagnostic> {
    let drum = &model.frames[drum.index()].name;
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Diagnostic::error(
        "M117",
        connection.span.clone(),
        Text::new(
            format!("`{of}`: it is unknown from what the angle of the drum `{drum}` counts"),
            format!("`{of}`: неизвестно, от чего отсчитывать угол барабана `{drum}`"),
        ),
    )
    .why(Text::new(
        "the rope winds by what the drum turns against the piece of rope that runs to it, and no end of the path moves with the body that carries the drum",
        "канат наматывается настолько, насколько барабан повернулся относительно набегающей ветви, а ни один конец ломаной не движется с телом, несущим барабан",
    ))
    .help(Text::new(
        "begin the path with a point of that body where the rope leaves the drum, or name what it counts from: wound = [{ on = \"drum\", radius = \"R\", carrier = \"boom\" }]",
        "начните ломаную точкой этого тела, где канат сходит с барабана, или укажите, от чего вести отсчёт: wound = [{ on = \"drum\", radius = \"R\", carrier = \"boom\" }]",
    ));
    Box::new(fault)
}

/// A friction by the magnitude of two reactions.
pub fn curved_normal(connection: &Connection) -> Box<Diagnostic> {
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Diagnostic::error(
        "M085",
        connection.span.clone(),
        Text::new(format!("`{of}`: the normal force is not linear in the reactions"), format!("`{of}`: нормальная сила не линейна по реакциям")),
    )
    .why(Text::new(
        "friction and reactions are found together from linear equations; in space the guide holds in two directions, and `force` is their magnitude",
        "трение и реакции находятся вместе из линейных уравнений; в пространстве направляющая удерживает в двух направлениях, и `force` — модуль",
    ))
    .help(Text::new(
        "use one component: force_y(S) or force_z(S)",
        "используйте одну компоненту: force_y(S) или force_z(S)",
    ));
    Box::new(fault)
}
