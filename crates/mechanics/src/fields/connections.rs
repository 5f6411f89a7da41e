//! Tables of connections: joints, ties, wheels, conditions, drives, stops, friction; distributed loads.

use crate::keys::{Field, TableSpec, Type, Words, may, must};

const fn table(name: &'static str, about: Words, fields: &'static [Field], example: &'static str) -> TableSpec {
    TableSpec { name, about, fields, short: None, example }
}

const TWO_POINTS: Field = must(
    "between",
    Type::TwoNames,
    "",
    ("two points, or bodies for their origins", "две точки или тела (тогда их начала)"),
    "[\"A\", \"B\"]",
);
const AXES: Field =
    may("axes", Type::Name, "", "\"ground\"", ("axes of the components of the reaction", "оси компонент реакции"), "\"crank\"");
const ALONG: Field =
    may("along", Type::Formula, "", "", ("pathway: a formula of coordinates", "координата: формула от обобщённых координат"), "\"x\"");
const BETWEEN: Field = may(
    "between",
    Type::TwoNames,
    "",
    "",
    (
        "pathway: distance of two points, or angle of the second body minus that of the first",
        "координата: расстояние между двумя точками или угол второго тела минус угол первого",
    ),
    "[\"A\", \"B\"]",
);
const ON_BODY: Field = may(
    "on",
    Type::Name,
    "",
    "",
    ("pathway: angle of this body from the ground", "координата: угол этого тела от неподвижной системы"),
    "\"crank\"",
);
const RESTITUTION: Field = may(
    "restitution",
    Type::Formula,
    "1",
    "0",
    (
        "ratio of the rates after and before the impact, 0 ... 1; over parameters only",
        "отношение скоростей после и до удара, 0 ... 1; только от параметров",
    ),
    "0.5",
);
const LENGTH: Field = may(
    "length",
    Type::Formula,
    "m",
    "\"start\"",
    ("length; \"start\" for that at the start of the motion", "длина; \"start\" — длина в начале движения"),
    "\"l\"",
);
const ON_FRAME: Field =
    may("on", Type::Name, "", "\"ground\"", ("frame or body of the line", "система отсчёта или тело, на котором прямая"), "\"frame\"");
const THROUGH: Field = may(
    "through",
    Type::Name,
    "",
    "the place at the start",
    ("a point of the line, fixed in `on`", "точка прямой, неподвижная в `on`"),
    "\"B\"",
);
const DIRECTION: Field = may(
    "direction",
    Type::Formula,
    "rad",
    "0",
    ("angle of the line from the x axis of `on`", "угол прямой с осью x системы `on`"),
    "\"90 deg\"",
);
const SIDE: Field = may(
    "side",
    Type::String,
    "",
    "\"left\"",
    (
        "side of the line on which the wheel is: left (direction turned by +90 degrees) or right",
        "сторона прямой, на которой колесо: left (направление, повёрнутое на +90 градусов) или right",
    ),
    "\"right\"",
);
const WHEELS: Field = must("between", Type::TwoNames, "", ("two wheels", "два колеса"), "[\"flywheel\", \"pulley\"]");
const RADII: Field = must("radii", Type::Vector, "m", ("their pitch radii", "радиусы их начальных окружностей"), "[\"r1\", \"R4\"]");
const CARRIER: Field = may(
    "carrier",
    Type::Name,
    "",
    "line of the centres",
    (
        "body that carries both axes; turning counts from it. Needed only where both wheels have one origin",
        "тело, несущее обе оси; углы считаются от него. Нужно, только если начала обоих колёс совпадают",
    ),
    "\"arm\"",
);
const RADIUS: Field = must("radius", Type::Formula, "m", ("radius of the rolling circle", "радиус окружности качения"), "\"R5\"");
const CENTER: Field = may("center", Type::Name, "", "origin of the body", ("centre of the wheel, a point", "центр колеса, точка"), "\"C\"");

/// `[pins.NAME]`.
pub const PIN: TableSpec = table(
    "pins",
    (
        "Pins: two points coincide. Reactions force_x, force_y, force_z act on the second body, and opposite on the first; force is the magnitude.",
        "Шарниры: две точки совпадают. Реакции force_x, force_y, force_z действуют на второе тело, противоположные — на первое; force — модуль.",
    ),
    &[TWO_POINTS, AXES],
    "[pins.A]\nbetween = [\"A1\", \"A2\"]\n",
);

/// `[welds.NAME]`.
pub const WELD: TableSpec = table(
    "welds",
    (
        "Welds: two points coincide and their bodies do not turn against each other. Reactions as with pins, and moment (moment_x, moment_y in space).",
        "Жёсткие соединения: две точки совпадают, тела не поворачиваются друг относительно друга. Реакции как у шарниров и moment (в пространстве ещё moment_x, moment_y).",
    ),
    &[TWO_POINTS, AXES],
    "[welds.W]\nbetween = [\"end\", \"begin\"]\n",
);

const SLIDING: &[Field] = &[
    must("point", Type::Name, "", ("point that slides, or a body for its origin", "скользящая точка или тело (тогда его начало)"), "\"C\""),
    ON_FRAME,
    THROUGH,
    DIRECTION,
    may(
        "turns",
        Type::Bool,
        "",
        "true",
        ("whether the body of the point may turn against `on`", "может ли тело точки поворачиваться относительно `on`"),
        "false",
    ),
];

/// `[sliders.NAME]`.
pub const SLIDER: TableSpec = table(
    "sliders",
    (
        "Sliders: a point stays on a straight line. force acts on the body of the point, towards the direction turned by +90 degrees; moment exists when the body may not turn. Where the point could leave the plane x, y of `on` both normal directions are held: force_y towards the direction turned by +90 degrees, force_z along z of `on`, force is the magnitude.",
        "Ползуны: точка остаётся на прямой. force действует на тело точки в сторону направления, повёрнутого на +90 градусов; moment есть, если тело не поворачивается. Если точка могла бы выйти из плоскости x, y системы `on`, удерживаются оба нормальных направления: force_y — в сторону направления, повёрнутого на +90 градусов, force_z — вдоль z системы `on`, force — модуль.",
    ),
    SLIDING,
    "[sliders.C]\npoint = \"C\"\n",
);

/// `[slots.NAME]`.
pub const SLOT: TableSpec = table(
    "slots",
    (
        "Slots: a pin stays in a straight slot of a body. force acts on the body of the pin, towards the direction turned by +90 degrees; in space force_y, force_z as for sliders.",
        "Кулисы: палец остаётся в прямом пазу тела. force действует на тело пальца в сторону направления, повёрнутого на +90 градусов; в пространстве — force_y, force_z, как у ползунов.",
    ),
    &[
        must("pin", Type::Name, "", ("the pin: a point, or a body for its origin", "палец: точка или тело (тогда его начало)"), "\"A\""),
        ON_FRAME,
        THROUGH,
        DIRECTION,
    ],
    "[slots.K]\npin = \"A\"\non = \"yoke\"\n",
);

/// `[rods.NAME]`.
pub const ROD: TableSpec = table(
    "rods",
    (
        "Massless rigid rods: the distance of two points is constant. force is positive in tension.",
        "Невесомые жёсткие стержни: расстояние между двумя точками постоянно. force положительна при растяжении.",
    ),
    &[TWO_POINTS, LENGTH],
    "[rods.AB]\nbetween = [\"A\", \"B\"]\nlength = \"l\"\n",
);

const TIE: &[Field] = &[
    may(
        "path",
        Type::Names,
        "",
        "[]",
        (
            "points in order: ends, rings, axles of small pulleys; two at least, or none when the rope only winds on two drums",
            "точки по порядку: концы, кольца, оси малых блоков; не меньше двух, либо ни одной, если канат только наматывается на два барабана",
        ),
        "[\"A\", \"ring\", \"B\"]",
    ),
    may(
        "wound",
        Type::Array,
        "",
        "[]",
        (
            "drums on which it winds: { on, radius, turns_in, carrier }",
            "барабаны, на которые он наматывается: { on, radius, turns_in, carrier }",
        ),
        "[{ on = \"drum\", radius = \"R\" }]",
    ),
    LENGTH,
    may(
        "slack",
        Type::Bool,
        "",
        "true",
        ("whether it may go slack; false: always held taut", "может ли провисать; false — всегда натянут"),
        "false",
    ),
    RESTITUTION,
];

/// `[ropes.NAME]`.
pub const ROPE: TableSpec = table(
    "ropes",
    (
        "Inextensible ropes: polygon through the points plus what is wound on drums is the length. force is the tension.",
        "Нерастяжимые канаты: длина равна ломаной через точки плюс намотанное на барабаны. force — натяжение.",
    ),
    TIE,
    "[ropes.R]\npath = [\"A\", \"ring\", \"B\"]\nwound = [{ on = \"drum\", radius = \"R\", turns_in = \"+\" }]\n",
);

/// `[threads.NAME]`.
pub const THREAD: TableSpec =
    table("threads", ("Threads: the same as ropes.", "Нити: то же, что канаты."), TIE, "[threads.AB]\npath = [\"A\", \"B\"]\n");

/// `wound = [{ ... }]`.
pub const WOUND: TableSpec = table(
    "wound",
    ("one drum", "один барабан"),
    &[
        must("on", Type::Name, "", ("the drum", "барабан"), "\"drum\""),
        must("radius", Type::Formula, "m", ("its radius", "его радиус"), "\"R\""),
        may(
            "turns_in",
            Type::String,
            "",
            "\"+\"",
            (
                "\"+\": the rope winds on when the drum turns positively; \"-\": it winds off",
                "\"+\": при положительном повороте барабана канат наматывается; \"-\": сматывается",
            ),
            "\"-\"",
        ),
        may(
            "carrier",
            Type::Name,
            "",
            "body that carries its axis",
            (
                "body that carries its axis and the run of the rope to it; its angle counts from it",
                "тело, несущее ось барабана и набегающую на него ветвь; угол барабана считается от него",
            ),
            "\"boom\"",
        ),
    ],
    "",
);

/// `[belts.NAME]`.
pub const BELT: TableSpec = table(
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
    ],
    "[belts.S]\nbetween = [\"flywheel\", \"pulley\"]\nradii = [\"r1\", \"R4\"]\n",
);

/// `[chains.NAME]`.
pub const CHAIN: TableSpec = table(
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
    ],
    "[chains.X]\nbetween = [\"front\", \"rear\"]\nradii = [\"r1\", \"r2\"]\n",
);

/// `[gears.NAME]`.
pub const GEAR: TableSpec = table(
    "gears",
    (
        "Gear pairs. force acts along the pitch circles, positive when it turns the second wheel in the positive direction; in space about the axis x, y or z of the second wheel that is the axis of both.",
        "Зубчатые пары. force действует по касательной к начальным окружностям, положительна, если вращает второе колесо в положительную сторону; в пространстве — вокруг той оси x, y или z второго колеса, которая является общей осью обоих.",
    ),
    &[
        WHEELS,
        RADII,
        may(
            "internal",
            Type::Bool,
            "",
            "false",
            ("whether one has inner teeth: both turn alike", "внутреннее ли зацепление: вращаются в одну сторону"),
            "true",
        ),
        CARRIER,
    ],
    "[gears.G]\nbetween = [\"pinion\", \"wheel\"]\nradii = [\"r1\", \"r2\"]\n",
);

/// `[racks.NAME]`.
pub const RACK: TableSpec = table(
    "racks",
    (
        "Gears on racks: no slip, but the rack does not carry the gear. tangential acts on the gear along the direction.",
        "Зубчатые рейки: без проскальзывания, но рейка не держит колесо. tangential действует на колесо вдоль направления.",
    ),
    &[
        must("gear", Type::Name, "", ("the gear", "зубчатое колесо"), "\"roller\""),
        RADIUS,
        CENTER,
        may("on", Type::Name, "", "\"ground\"", ("frame or body of the rack", "система отсчёта или тело рейки"), "\"rack\""),
        DIRECTION,
        SIDE,
    ],
    "[racks.Z]\ngear = \"roller\"\nradius = \"r4\"\non = \"rack\"\n",
);

/// `[rolling.NAME]`.
pub const ROLLING: TableSpec = table(
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
    ],
    "[rolling.F]\nbody = \"roller\"\nradius = \"R5\"\ndirection = \"alpha\"\n",
);

/// `circle = { ... }`.
pub const CIRCLE: TableSpec = table(
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

/// `[constraints.NAME]`.
pub const CONSTRAINT: TableSpec = table(
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
    ],
    "[constraints.K]\nzero = \"x^2 + y^2 - l^2\"\n",
);

/// `[supports.NAME]`.
pub const SUPPORT: TableSpec = table(
    "supports",
    (
        "Supports: reactions of a body that the coordinates already hold, or hold less than the support. They act on the body and hold it to what it stands on (`on` of the body), which gets the opposite. A body whose `origin` is the name of a point of another body is jointed to it there: at this place forces are those of the joint with that body, unless a pin or a weld of the two stands there; at all other places, and about turning, `on` holds it.",
        "Опоры: реакции, действующие на тело, которое уже удержано выбором координат или удерживается опорой. Опора соединяет тело с тем, на чём оно стоит (`on` тела); туда действует противоположная реакция. Тело, у которого `origin` — имя точки другого тела, соединено с ним в этой точке шарниром: силы в этом месте — силы шарнира между ними, если там нет их общего pin или weld; в остальных местах и от поворота тело удерживает `on`.",
    ),
    &[
        must("at", Type::Name, "", ("point, or body for its origin", "точка или тело (тогда его начало)"), "\"A\""),
        must(
            "directions",
            Type::Names,
            "",
            (
                "what is held: x, y, z, turn (about z), turn_x, turn_y, turn_z",
                "что удерживается: x, y, z, turn (вокруг z), turn_x, turn_y, turn_z",
            ),
            "[\"x\", \"y\"]",
        ),
        AXES,
        may(
            "on",
            Type::Name,
            "",
            "see above",
            ("what holds the body and gets the opposite", "что удерживает тело; туда действует противоположная реакция"),
            "\"cart\"",
        ),
    ],
    "[supports.A]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]\n",
);

/// `[motions.NAME]`.
pub const MOTION: TableSpec = table(
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
    ],
    "[motions.lift]\nalong = \"y(A)\"\nrate = \"v*sin(p*t)\"\n",
);

/// `[motors.NAME]`.
pub const MOTOR: TableSpec = table(
    "motors",
    (
        "Motors: unknown forces or torques that realise the motions. Between two bodies the torque acts on the second and opposite on the first; positive increases the pathway.",
        "Двигатели: неизвестные силы и моменты, реализующие заданные движения. Между двумя телами момент действует на второе, противоположный — на первое; положительный увеличивает координату.",
    ),
    &[ALONG, BETWEEN, ON_BODY],
    "[motors.B]\nbetween = [\"bar2\", \"bar1\"]\n",
);

/// `[stops.NAME]`.
pub const STOP: TableSpec = table(
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
    ],
    "[stops.floor]\nalong = \"y\"\nat_least = 0\nrestitution = 0.8\n",
);

/// `[frictions.NAME]`.
pub const FRICTION: TableSpec = table(
    "frictions",
    (
        "Dry friction: a force (`kinetic`, `static`), or coefficients (`coefficient`, `static_coefficient`) of a `normal` force. `u` is the sliding speed, not negative. It acts on a pathway (`along`, `between`, `on`; torques when that is an angle), at a point between two bodies or at a named contact (`at`), in a pin (`pin`), between a rope and a drum that does not turn (`rope`). force is positive when it resists a growing pathway or positive sliding; at a point it acts so on the point's body. A rope slides positively along its `path`, from the first point to the last: force is the tension behind the drum less that before it.",
        "Сухое трение: сила (`kinetic`, `static`) или коэффициенты (`coefficient`, `static_coefficient`) при силе `normal`. `u` — скорость скольжения, не отрицательная. Действует на координате (`along`, `between`, `on`; для угла это моменты), в точке касания двух тел или в названном контакте (`at`), в шарнире (`pin`), между канатом и неподвижным барабаном (`rope`). force положительна, если сопротивляется росту координаты или положительному скольжению; в точке она так действует на тело этой точки. Положительное скольжение каната — вдоль его `path`, от первой точки к последней: force — это натяжение за барабаном минус натяжение перед ним.",
    ),
    &[
        ALONG,
        BETWEEN,
        ON_BODY,
        may(
            "at",
            Type::NameOrNames,
            "",
            "",
            (
                "where it acts: [point, other body], or the name of a rolling contact (which may then slip) or a stop",
                "где действует: [точка, другое тело] либо имя качения (тогда возможно проскальзывание) или упора",
            ),
            "[\"A\", \"floor\"]",
        ),
        may(
            "direction",
            Type::FormulaOrVector,
            "1",
            "along the track; normal of the stop turned by −90°",
            (
                "direction of positive sliding at a point: x, y, z, -x ..., a vector of any length, or an angle from the x axis of `axes`",
                "направление положительного скольжения в точке: x, y, z, -x ..., вектор любой длины или угол с осью x системы `axes`",
            ),
            "[\"cos(a)\", \"sin(a)\"]",
        ),
        may("axes", Type::Name, "", "\"ground\"", ("axes of `direction`", "оси для `direction`"), "\"wedge\""),
        may(
            "pin",
            Type::Name,
            "",
            "",
            (
                "a pin or support, about which its bodies turn: moment coefficient·radius·force of all its components (plane)",
                "шарнир или опора, вокруг которых поворачиваются тела: момент coefficient·radius·полная реакция (на плоскости)",
            ),
            "\"O\"",
        ),
        may(
            "radius",
            Type::Formula,
            "m",
            "",
            (
                "radius of the pin; with a stop: distance of the contact from the stop's point, towards the surface",
                "радиус цапфы; для упора — расстояние от его точки до контакта, в сторону поверхности",
            ),
            "\"10 mm\"",
        ),
        may("rope", Type::Name, "", "", ("a rope that slides over a drum or ring", "канат, скользящий по барабану или кольцу"), "\"R\""),
        may(
            "over",
            Type::NameOrNames,
            "",
            "",
            (
                "the point of the rope's path on the drum, or the points where it runs on and off",
                "точка пути каната на барабане либо точки набегания и сбегания",
            ),
            "[\"P1\", \"P2\"]",
        ),
        may("wrap", Type::Formula, "rad", "angle by which the rope turns at `over`", ("angle of contact", "угол обхвата"), "\"540 deg\""),
        may(
            "kinetic",
            Type::Formula,
            "",
            "",
            ("friction while sliding, over u and time, not coordinates", "трение при скольжении, функция u и времени, не координат"),
            "\"F2\"",
        ),
        may("curve", Type::Formula, "", "", ("another name of `kinetic`", "другое имя для `kinetic`"), "\"F2/(1 + u/u0)\""),
        may("static", Type::Formula, "", "kinetic at u = 0", ("largest friction at rest", "наибольшее трение покоя"), "\"F1\""),
        may(
            "coefficient",
            Type::Formula,
            "1",
            "",
            (
                "coefficient while sliding, over u and time, not coordinates",
                "коэффициент при скольжении, функция u и времени, не координат",
            ),
            "0.2",
        ),
        may("static_coefficient", Type::Formula, "1", "coefficient at u = 0", ("coefficient at rest", "коэффициент при покое"), "0.3"),
        may(
            "lever",
            Type::Formula,
            "m",
            "",
            (
                "lever of the rolling resistance at a named contact: the moment is lever·normal",
                "плечо трения качения в названном контакте: момент равен lever·normal",
            ),
            "\"0.5 mm\"",
        ),
        may("static_lever", Type::Formula, "m", "lever at u = 0", ("the same at rest", "то же при покое"), "\"0.6 mm\""),
        may(
            "normal",
            Type::Formula,
            "N",
            "force of the named contact, pin or rope",
            ("normal force; its magnitude counts; may contain reactions", "нормальная сила; учитывается модуль; может содержать реакции"),
            "\"force(guide)\"",
        ),
    ],
    "[frictions.rail]\nalong = \"x\"\nkinetic = \"F2\"\nstatic = \"F1\"\n",
);

/// `[distributed.NAME]`.
pub const DISTRIBUTED: TableSpec = table(
    "distributed",
    (
        "Loads distributed along the straight line between two points of one body, uniform or growing linearly; replaced by the equivalent forces.",
        "Нагрузки, распределённые вдоль прямой между двумя точками одного тела, равномерно или по линейному закону; заменяются эквивалентными силами.",
    ),
    &[
        may("on", Type::Name, "", "body of the points", ("body it acts on", "тело, на которое действует"), "\"beam\""),
        must("from", Type::Name, "", ("point where it begins", "точка начала"), "\"A\""),
        must("to", Type::Name, "", ("point where it ends", "точка конца"), "\"B\""),
        must("value", Type::Vector, "N/m", ("force per length at `from`", "сила на единицу длины в `from`"), "[\"0\", \"-q\"]"),
        may("value_end", Type::Vector, "N/m", "value", ("force per length at `to`", "сила на единицу длины в `to`"), "[\"0\", \"0\"]"),
        may("axes", Type::Name, "", "\"ground\"", ("axes of the components", "оси компонент"), "\"beam\""),
    ],
    "[distributed.q]\nfrom = \"A\"\nto = \"B\"\nvalue = [\"0\", \"-q\"]\n",
);
