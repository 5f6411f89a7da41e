//! Faults of wheels, tracks, drums and supports.

use crate::model::{Connection, FrameId, Model};
use words::digits::typed;
use words::{Notice, Text};

/// A connection whose data are those of another table: one that no file makes.
pub fn of_another_kind(connection: &Connection) -> Box<Notice> {
    no_place(connection, &connection.name)
}

/// Two wheels without parallel axes.
pub fn no_common_axis(model: &Model, connection: &Connection, wheels: [FrameId; 2]) -> Box<Notice> {
    let [a, b] = wheels.map(|f| &model.frames[f.index()].name);
    let fault = Notice::file(
        "M116",
        connection.span.clone(),
        Text::new(format!("`{a}` and `{b}` have no common axis"), format!("у `{a}` и `{b}` нет общей оси вращения")),
    )
    .why(
        "belts, chains and gears join bodies that turn against each other about one axis: an own x, y or z axis of each stays parallel to it",
        "ремни, цепи и зубчатые пары соединяют тела, которые вращаются друг относительно друга вокруг одной оси: собственная ось x, y или z каждого остаётся ей параллельна",
    )
    .help(
        "give both the same axis, rotate = [\"x: a\"] and [\"x: b\"], or write the condition out: [constraints] zero_rate = \"r1*a' + r2*b'\"",
        "задайте обоим одну ось, rotate = [\"x: a\"] и [\"x: b\"], или запишите условие сами: [constraints] zero_rate = \"r1*a' + r2*b'\"",
    );
    Box::new(fault)
}

/// A wheel that does not lie in the plane of its track.
pub fn wheel_not_in_plane(model: &Model, connection: &Connection, wheel: FrameId, on: FrameId) -> Box<Notice> {
    let [wheel, on] = [wheel, on].map(|f| &model.frames[f.index()].name);
    let fault = Notice::file(
        "M116",
        connection.span.clone(),
        Text::new(
            format!("no axis of `{wheel}` stays parallel to z of `{on}`"),
            format!("ни одна ось тела `{wheel}` не остаётся параллельной оси z системы `{on}`"),
        ),
    )
    .why(
        "the track lies in the plane x, y of its frame, and the wheel turns about the normal of that plane",
        "опора лежит в плоскости x, y своей системы, и колесо вращается вокруг нормали к этой плоскости",
    )
    .help(
        "name under `on` a frame whose z axis is the axis of the wheel, or write the condition out: [constraints] zero_rate = \"vx(C) - r*a'\"",
        "укажите в `on` систему, ось z которой — ось колеса, или запишите условие сами: [constraints] zero_rate = \"vx(C) - r*a'\"",
    );
    Box::new(fault)
}

/// A wheel that moves along its axis.
pub fn leaves_plane(model: &Model, connection: &Connection, wheel: FrameId, on: FrameId) -> Box<Notice> {
    let [wheel, on] = [wheel, on].map(|f| &model.frames[f.index()].name);
    let fault = Notice::file(
        "M118",
        connection.span.clone(),
        Text::new(
            format!("the centre of `{wheel}` moves along z of `{on}`, out of the plane of its track"),
            format!("центр колеса `{wheel}` движется вдоль оси z системы `{on}`, то есть выходит из плоскости опоры"),
        ),
    )
    .why(
        "rolling holds the wheel in the plane x, y of the track's frame, not along its axis",
        "качение удерживает колесо в плоскости x, y системы опоры, но не вдоль его оси",
    )
    .help("let the coordinates keep the centre in the plane", "выберите координаты так, чтобы центр оставался в плоскости");
    Box::new(fault)
}

/// Wheels whose distance changes.
pub fn axes_part(connection: &Connection) -> Box<Notice> {
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M118",
        connection.span.clone(),
        Text::new(
            format!("the axes of `{of}` move apart: nothing keeps their distance"),
            format!("оси колёс `{of}` сближаются и расходятся: межосевое расстояние ничем не удержано"),
        ),
    )
    .why(
        "teeth would leave their mesh, and a belt or chain would change its length",
        "зубья вышли бы из зацепления, а длина ремня или цепи изменилась бы",
    )
    .help(
        "put both wheels on one body, hold the distance by a pin or rod, or write the condition out in [constraints]",
        "поставьте оба колеса на одно тело, удержите расстояние шарниром или стержнем либо запишите условие в [constraints]",
    );
    Box::new(fault)
}

/// Pitch circles that do not touch: distance of the axes, m, and what the radii give, as a formula and a number.
pub fn no_mesh(connection: &Connection, axes: f64, (formula, radii): (&str, f64)) -> Box<Notice> {
    let name = &connection.name;
    let (axes, radii) = (typed(axes), typed(radii));
    let what = Text::new(
        format!("the pitch circles of `gears.{name}` do not touch: the axes are {} m apart, the radii give {} m", axes.en, radii.en),
        format!("начальные окружности пары `gears.{name}` не касаются: межосевое расстояние {} м, а радиусы дают {} м", axes.ru, radii.ru),
    );
    let fault = Notice::file("M114", connection.span.clone(), what)
        .why(
            format!("the teeth meet at one point of both circles, so the distance of the axes is {formula}"),
            format!("зубья встречаются в общей точке обеих окружностей, поэтому межосевое расстояние равно {formula}"),
        )
        .help(
            "correct a radius or the place of a wheel; where only the ratio counts, put both wheels at one origin",
            "исправьте радиус или положение колеса; если важно только передаточное отношение, поместите оба колеса в одно начало",
        );
    Box::new(fault)
}

/// The pull of a belt or chain whose wheels are drawn at one place.
pub fn no_way_of_pull(connection: &Connection) -> Box<Notice> {
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M129",
        connection.span.clone(),
        Text::new(
            format!("the tensions of `{of}` have no direction: its wheels are drawn at one place"),
            format!("натяжения `{of}` не имеют направления: его колёса изображены в одном месте"),
        ),
    )
    .why("both strands pull the axles towards each other along the line of the centres", "обе ветви стягивают оси вдоль линии центров")
    .help(
        "give the wheels their places (`origin`), or drop `pretension` or `tight`",
        "задайте положения колёс (`origin`) или уберите ключ `pretension` или `tight`",
    );
    Box::new(fault)
}

/// Circles that no belt fits, at the distance of their centres.
pub fn no_belt(connection: &Connection, [axes, least]: [f64; 2]) -> Box<Notice> {
    let of = format!("{}.{}", connection.table, connection.name);
    let number = |x: f64| {
        let x: f64 = format!("{x:.6e}").parse().unwrap_or(x);
        Text::new(format!("{x}"), format!("{x}").replace('.', ","))
    };
    let (axes, least) = (number(axes), number(least));
    let fault = Notice::file(
        "M130",
        connection.span.clone(),
        Text::new(
            format!(
                "the strands of `{of}` have no straight part: the axes are {} m apart, the radii need more than {} m",
                axes.en, least.en
            ),
            format!("у ветвей `{of}` нет прямого участка: межосевое расстояние {} м, а радиусам нужно больше {} м", axes.ru, least.ru),
        ),
    )
    .why(
        "a strand touches both circles, which needs a distance of more than |r1 − r2|, of a crossed belt more than r1 + r2",
        "ветвь касается обеих окружностей: для этого расстояние должно быть больше |r1 − r2|, у перекрёстного ремня – больше r1 + r2",
    )
    .help("correct a radius or the place of a wheel", "исправьте радиус или положение колеса");
    Box::new(fault)
}

/// A carrier that does not carry the axes.
pub fn not_the_carrier(model: &Model, connection: &Connection, frame: FrameId) -> Box<Notice> {
    let name = &model.frames[frame.index()].name;
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M117",
        connection.span.clone(),
        Text::new(
            format!("the axes of `{of}` move against the carrier `{name}`"),
            format!("оси колёс `{of}` движутся относительно водила `{name}`"),
        ),
    )
    .why(
        "turning counts from the body that carries both axes; counted from another body it does not tell what slips",
        "повороты отсчитывают от тела, несущего обе оси; отсчёт от другого тела не выражает отсутствия проскальзывания",
    )
    .help(
        "name the body on which the axes stand, or drop `carrier`: it then follows from the line of centres",
        "укажите тело, на котором стоят оси, или уберите `carrier`: тогда отсчёт ведётся от линии центров",
    );
    Box::new(fault)
}

/// Wheels at one place, one of them on a turning body.
pub fn no_carrier(model: &Model, connection: &Connection, arm: FrameId) -> Box<Notice> {
    let arm = &model.frames[arm.index()].name;
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M117",
        connection.span.clone(),
        Text::new(
            format!("`{of}`: a wheel stands on `{arm}`, which turns, and the centres coincide"),
            format!("`{of}`: одно из колёс стоит на `{arm}`, которое вращается, а центры колёс совпадают"),
        ),
    )
    .why(
        "turning counts from the line of centres; without a line it must be said which body carries both axes",
        "повороты отсчитывают от линии центров; если её нет, нужно указать тело, несущее обе оси",
    )
    .help(
        format!("add carrier = \"{arm}\", or give the wheels the places of their centres"),
        format!("добавьте carrier = \"{arm}\" или задайте положения центров колёс"),
    );
    Box::new(fault)
}

/// A drum held by a connection of its own, and a rope of which it is not known where it leaves the drum.
pub fn pull_unknown(model: &Model, connection: &Connection, drum: FrameId) -> Box<Notice> {
    let drum = &model.frames[drum.index()].name;
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M158",
        connection.span.clone(),
        Text::new(
            format!("`{of}`: where the rope leaves the drum `{drum}` is not known, and a support or pin holds the drum alone"),
            format!("`{of}`: неизвестно, где канат сходит с барабана `{drum}`, а опора или шарнир удерживает один барабан"),
        ),
    )
    .why(
        "the drum's turning needs the couple of the tension only, the force of its axle also the line of the pull",
        "для вращения барабана достаточно момента натяжения, для силы в его оси нужна и линия натяжения",
    )
    .help(
        "begin the path where the rope leaves the drum, at the drum's radius from its centre and across the rope; or support what carries the axle and the path",
        "начните путь там, где канат сходит с барабана: на расстоянии радиуса от его оси, поперёк каната; либо опирайте то, что несёт и ось, и точки пути",
    );
    Box::new(fault)
}

/// Drums that move apart with no path between them.
pub fn run_unknown(connection: &Connection) -> Box<Notice> {
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M158",
        connection.span.clone(),
        Text::new(
            format!("`{of}`: the distance of its drums changes, and the run of the rope between them is not drawn"),
            format!("`{of}`: расстояние между барабанами меняется, а ветвь каната между ними не задана"),
        ),
    )
    .why(
        "without `path` the rope is what is wound alone: the free run would not count",
        "без `path` канат состоит только из намотанного: свободная ветвь не учитывалась бы",
    )
    .help(
        "give `path` from where the rope leaves one drum to where it meets the other",
        "задайте `path` от места схода каната с одного барабана до места набегания на другой",
    );
    Box::new(fault)
}

/// A drum whose carrier is unknown.
pub fn no_drum_carrier(model: &Model, connection: &Connection, drum: FrameId) -> Box<Notice> {
    let drum = &model.frames[drum.index()].name;
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M117",
        connection.span.clone(),
        Text::new(
            format!("`{of}`: it is unknown from what the angle of the drum `{drum}` counts"),
            format!("`{of}`: неизвестно, от чего отсчитывать угол барабана `{drum}`"),
        ),
    )
    .why(
        "the rope winds by what the drum turns against the piece of rope that runs to it, and no end of the path moves with the body that carries the drum",
        "канат наматывается настолько, насколько барабан повернулся относительно набегающей ветви, а ни один конец ломаной не движется с телом, несущим барабан",
    )
    .help(
        "begin the path with a point of that body where the rope leaves the drum, or name what it counts from: wound = [{ on = \"drum\", radius = \"R\", carrier = \"boom\" }]",
        "начните ломаную точкой этого тела, где канат сходит с барабана, или укажите, от чего вести отсчёт: wound = [{ on = \"drum\", radius = \"R\", carrier = \"boom\" }]",
    );
    Box::new(fault)
}

/// A friction by the magnitude of two reactions.
pub fn curved_normal(connection: &Connection) -> Box<Notice> {
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M085",
        connection.span.clone(),
        Text::new(format!("`{of}`: the normal force is not linear in the reactions"), format!("`{of}`: нормальная сила не линейна по реакциям")),
    )
    .why(
        "friction and reactions are found together from linear equations; in space the guide holds in two directions, and `force` is their magnitude",
        "трение и реакции находятся вместе из линейных уравнений; в пространстве направляющая удерживает в двух направлениях, и `force` — модуль",
    )
    .help(
        "use one component: force_y(S) or force_z(S)",
        "используйте одну компоненту: force_y(S) или force_z(S)",
    );
    Box::new(fault)
}

fn of_friction(connection: &Connection, code: &'static str, en: String, ru: String) -> Notice {
    Notice::file(code, connection.span.clone(), Text::new(en, ru))
}

/// A friction at a contact whose place does not follow from points.
pub fn no_place(connection: &Connection, contact: &str) -> Box<Notice> {
    let name = &connection.name;
    let fault = of_friction(
        connection,
        "M123",
        format!("`frictions.{name}`: the place of the contact `{contact}` does not follow from the model"),
        format!("`frictions.{name}`: место контакта `{contact}` не следует из модели"),
    )
    .why(
        "a friction acts at a point of a body; the pathway of this stop is a formula of coordinates, or moves several points",
        "трение приложено в точке тела; координата этого упора — формула обобщённых координат или движет несколько точек",
    )
    .help(
        "write the stop by points, along = \"y(A)\", or give the place yourself: at = [\"A\", \"floor\"], direction, normal = \"force(K)\"",
        "задайте упор через точки, along = \"y(A)\", или место сами: at = [\"A\", \"floor\"], direction, normal = \"force(K)\"",
    );
    Box::new(fault)
}

/// A stop whose limit may be the radius of a ball or the height of the floor.
pub fn where_it_touches(connection: &Connection, contact: &str) -> Box<Notice> {
    let name = &connection.name;
    let fault = of_friction(
        connection,
        "M123",
        format!("`frictions.{name}`: it is not said where the body touches at the stop `{contact}`"),
        format!("`frictions.{name}`: не сказано, где тело касается упора `{contact}`"),
    )
    .why(
        "the limit of the stop is not zero: the centre of a ball keeps its radius, a corner keeps nothing from a floor at that height",
        "предел упора не равен нулю: центр шара остаётся на расстоянии радиуса, а угол тела касается опоры на этой высоте",
    )
    .help(
        "add radius = \"r\", the distance of the contact from the stop's point, of two points from the second, towards the surface; radius = 0 where the point itself touches",
        "добавьте radius = \"r\" — расстояние от точки упора (из двух точек — от второй) до контакта в сторону поверхности; radius = 0, если касается сама точка",
    );
    Box::new(fault)
}

/// A friction whose contact has no normal force.
pub fn unpressed(connection: &Connection) -> Box<Notice> {
    let name = &connection.name;
    let fault = of_friction(
        connection,
        "M124",
        format!("`frictions.{name}`: what it names has no force that could press"),
        format!("`frictions.{name}`: у названной связи нет прижимающей силы"),
    )
    .why(
        "a wheel with held = false has no normal force; a journal needs both components, x and y, of its pin or support",
        "у колеса с held = false нет нормальной реакции; для цапфы нужны обе составляющие, x и y, реакции шарнира или опоры",
    )
    .help(
        "let the track hold the wheel, or name a support with directions = [\"x\", \"y\"]; a wheel may also have normal = \"...\"",
        "пусть опора удерживает колесо, или назовите опору с directions = [\"x\", \"y\"]; для колеса можно задать и normal = \"...\"",
    );
    Box::new(fault)
}

/// Points that a belt friction cannot lie on.
pub fn not_on_the_rope(connection: &Connection, rope: &str) -> Box<Notice> {
    let name = &connection.name;
    let fault = of_friction(
        connection,
        "M125",
        format!("`frictions.{name}`: `over` names no inner points of the path of `{rope}`, in its order, or the rope winds on drums"),
        format!("`frictions.{name}`: `over` — не внутренние точки пути каната `{rope}` по порядку, либо канат наматывается на барабаны"),
    )
    .why(
        "the rope runs onto a drum that does not turn and off it: each side has its own tension",
        "канат набегает на неподвижный барабан и сбегает с него: натяжения с двух сторон разные",
    )
    .help(
        "path = [\"A\", \"P\", \"B\"] with over = \"P\", or path = [\"A\", \"P1\", \"P2\", \"B\"] with over = [\"P1\", \"P2\"]",
        "path = [\"A\", \"P\", \"B\"] и over = \"P\" либо path = [\"A\", \"P1\", \"P2\", \"B\"] и over = [\"P1\", \"P2\"]",
    );
    Box::new(fault)
}

/// M125: one friction at a point that the rope passes more than once.
pub fn passed_twice(connection: &Connection, rope: &str) -> Box<Notice> {
    let name = &connection.name;
    let fault = of_friction(
        connection,
        "M125",
        format!("`frictions.{name}`: the path of `{rope}` passes a point of `over` more than once"),
        format!("`frictions.{name}`: путь каната `{rope}` проходит точку из `over` несколько раз"),
    )
    .why(
        "each passage has tensions of its own before and behind it, one friction has one pair",
        "у каждого прохода свои натяжения до и после, а у одного трения только одна пара",
    )
    .help(
        "give each passage a point of its own at the same place, and a friction over each",
        "задайте для каждого прохода свою точку в том же месте и трение на каждой",
    );
    Box::new(fault)
}

/// What a plane gives and space does not.
pub fn directions_in_space(connection: &Connection) -> Box<Notice> {
    let name = &connection.name;
    let fault = of_friction(
        connection,
        "M126",
        format!("`frictions.{name}`: in space this does not say in which direction the friction acts"),
        format!("`frictions.{name}`: в пространстве этим не задано направление трения"),
    )
    .why(
        "one friction acts along one direction; a contact in space has two, a pin a third component of its force, a rope no plane in which it turns",
        "одно трение действует вдоль одного направления; у контакта в пространстве их два, у шарнира есть третья составляющая реакции, у каната нет плоскости изгиба",
    )
    .help(
        "give `direction`, or `wrap` for a rope; for a journal write between = [\"a\", \"b\"] with coefficient = \"mu*r\" and a linear normal",
        "задайте `direction`, для каната — `wrap`; для цапфы: between = [\"a\", \"b\"], coefficient = \"mu*r\" и линейная normal",
    );
    Box::new(fault)
}

/// A support of a body with two partners, either of which may hold it.
pub fn unknown_holder(model: &Model, connection: &Connection, [body, mount, below]: [FrameId; 3]) -> Box<Notice> {
    let [body, mount, below] = [body, mount, below].map(|f| &model.frames[f.index()].name);
    let of = format!("{}.{}", connection.table, connection.name);
    let fault = Notice::file(
        "M151",
        connection.span.clone(),
        Text::new(format!("`{of}`: what holds `{body}` is not known"), format!("`{of}`: неизвестно, что удерживает тело `{body}`")),
    )
    .why(
        format!("a point of `{mount}` carries it, `{below}` gives it its axes; the reaction may act between it and either"),
        format!(
            "оно установлено в точке тела `{mount}`, а оси отсчитываются от `{below}`; реакция может действовать между ним и любым из них"
        ),
    )
    .help(
        format!("add on = \"{mount}\" or on = \"{below}\" to the support"),
        format!("добавьте в опору on = \"{mount}\" или on = \"{below}\""),
    );
    Box::new(fault)
}

/// A second friction at one wheel.
pub fn two_frictions(connection: &Connection, contact: &str) -> Box<Notice> {
    let name = &connection.name;
    let fault = of_friction(
        connection,
        "M128",
        format!("`frictions.{name}` is the second friction at the wheel of `{contact}`"),
        format!("`frictions.{name}` — второе трение у колеса `{contact}`"),
    )
    .why("the friction at a wheel is its tangential force, and there is one", "трение у колеса — это его сила сцепления, она одна")
    .help(
        "keep one with the sum of the coefficients; rolling resistance is a friction with `lever`",
        "оставьте одно с суммой коэффициентов; трение качения задаётся ключом `lever`",
    );
    Box::new(fault)
}
