//! Tables of the file that stand in no room of their own: the top level, parameters, coordinates, bodies, outputs.

use crate::connections;
use crate::elements;
use crate::keys::{ANGLE, Field, LABEL, ON, ORIGIN, ROTATE, SPIN, SYMBOL, TableSpec, Type, may, must};

/// Top level.
pub const TOP: TableSpec =
    TableSpec { name: "", about: ("Keys outside any table.", "Ключи вне таблиц."), short: None, example: "", fields: &ALL };

/// What stands before the elements.
const HEAD: &[Field] = &[
    may("title", Type::Text, "", "", ("title", "название"), "\"Pendulum\""),
    may("description", Type::Text, "", "", ("description", "описание"), "\"A weight on a rod\""),
    may(
        "gravity",
        Type::Gravity,
        "m/s^2",
        "\"g\"",
        (
            "gravity: false for none; a formula acts along -y of the ground; or a vector. Without this key it acts on bodies only; given, also on nodes and rods with mass",
            "сила тяжести: false — нет; формула действует вдоль -y; или вектор. Без этого ключа действует только на тела; заданная — и на узлы и стержни с массой",
        ),
        "[\"0\", \"0\", \"-g\"]",
    ),
    may(
        "impacts",
        Type::Text,
        "",
        "\"in sequence\"",
        (
            "several contacts that touch at an impact strike `in sequence` (the fastest first, equal ones at once) or `together`",
            "несколько контактов, замкнутых при ударе, ударяют последовательно, `in sequence` (первым – быстрейший, равные вместе), или одновременно, `together`",
        ),
        "\"together\"",
    ),
    may("parameters", Type::Table, "", "", ("named values", "именованные величины"), ""),
    may(
        "unknowns",
        Type::Table,
        "",
        "",
        (
            "parameters found from statics so that the start is a place of rest; the values are guesses",
            "параметры, которые находятся из условий равновесия в начальном положении; значения — приближения",
        ),
        "",
    ),
    may(
        "impending",
        Type::Table,
        "",
        "",
        (
            "dry frictions at their limit in the place of rest that [unknowns] are found for, or that the study `equilibrium` seeks in a range of a coordinate: name = \"+\" when about to slide forward along their path, \"-\" backward",
            "силы сухого трения, достигшие предельных значений в том положении равновесия, для которого ищутся [unknowns] или которое расчёт `equilibrium` ищет в диапазоне координаты: имя = \"+\", если готово начаться скольжение вперёд по их пути, \"-\" — назад",
        ),
        "",
    ),
    may("coordinates", Type::Table, "", "", ("generalized coordinates", "обобщённые координаты"), ""),
    may("frames", Type::Table, "", "", ("frames without mass", "системы отсчёта без массы"), ""),
    may("bodies", Type::Table, "", "", ("bodies", "тела"), ""),
    may("points", Type::Table, "", "", ("named points", "именованные точки"), ""),
];

/// What stands behind them.
const TAIL: &[Field] = &[
    may("distributed", Type::Table, "", "", ("distributed loads", "распределённые нагрузки"), ""),
    may("outputs", Type::Table, "", "", ("named results", "именованные результаты"), ""),
    may("events", Type::Table, "", "", ("named events", "именованные события"), ""),
    may("regimes", Type::Table, "", "", ("regimes of the motion by conditions", "режимы движения, заданные условиями"), ""),
    may("nodes", Type::Table, "", "", ("nodes of a frame or truss", "узлы рамы или фермы"), ""),
    may("displacements", Type::Table, "", "", ("named displacements of a structure", "именованные перемещения конструкции"), ""),
    may("rayleigh", Type::Table, "", "", ("assumed shapes of rods", "принятые формы изгиба стержней"), ""),
    may("structure", Type::Table, "", "", ("how the structure is computed", "как рассчитывать конструкцию"), ""),
    may("sections", Type::Table, "", "", ("sections of rods", "сечения стержней"), ""),
    may("variants", Type::Table, "", "", ("variants of the data", "варианты исходных данных"), ""),
    may(
        "answers",
        Type::Array,
        "",
        "",
        ("items that students answer, one [[answers]] each", "вопросы к заданию, по одному [[answers]]"),
        "",
    ),
    may("report", Type::Table, "", "", ("the written calculation", "записанный расчёт"), ""),
    may("study", Type::Array, "", "", ("studies, one [[study]] each", "расчёты, по одному [[study]]"), ""),
    may("claims", Type::Array, "", "", ("published results, one [[claims]] each", "опубликованные результаты, по одному [[claims]]"), ""),
    may("phases", Type::Array, "", "", ("phases of the loads, one [[phases]] each", "этапы нагружения, по одному [[phases]]"), ""),
];

/// All of the top level: elements and connections by their tables.
const ALL: [Field; HEAD.len() + elements::TABLE.len() + connections::TABLE.len() + TAIL.len()] = {
    let mut all = [HEAD[0]; HEAD.len() + elements::TABLE.len() + connections::TABLE.len() + TAIL.len()];
    let ends = [HEAD.len(), HEAD.len() + elements::TABLE.len(), HEAD.len() + elements::TABLE.len() + connections::TABLE.len()];
    let mut i = 0;
    while i < all.len() {
        all[i] = if i < ends[0] {
            HEAD[i]
        } else if i < ends[1] {
            elements::TABLE[i - ends[0]].top()
        } else if i < ends[2] {
            connections::TABLE[i - ends[1]].top()
        } else {
            TAIL[i - ends[2]]
        };
        i += 1;
    }
    all
};

/// `[parameters]`.
pub const PARAMETER: TableSpec = TableSpec {
    name: "parameters",
    about: (
        "Named values. A formula may use other parameters, `t`, coordinates and rates; `g` is 9.81 m/s^2 unless declared.",
        "Именованные величины. Формула может содержать другие параметры, `t`, координаты и скорости; `g` равно 9,81 м/с², если не объявлено.",
    ),
    short: Some(("name = value", "имя = значение")),
    fields: &[
        must("value", Type::Formula, "", ("value", "значение"), "\"20 g\""),
        may(
            "unit",
            Type::Unit,
            "",
            "",
            ("unit of a bare number; otherwise a check", "единица числа без единицы; иначе проверка"),
            "\"kg\"",
        ),
        SYMBOL,
        LABEL,
    ],
    example: "[parameters]\nm = { value = \"20 g\", symbol = \"m\", label = { en = \"mass\", ru = \"масса\" } }\nl = \"50 mm\"\nJ = \"m*l^2\"\nomega = \"min(30 [rad/s^2]*t, 300 [rad/s])\"\n",
};

/// `[coordinates]`.
pub const COORDINATE: TableSpec = TableSpec {
    name: "coordinates",
    about: ("Generalized coordinates; `phi'` and `phi''` are the derivatives.", "Обобщённые координаты; `phi'` и `phi''` — производные."),
    short: Some(("name = \"unit\"", "имя = \"единица\"")),
    fields: &[
        must(
            "unit",
            Type::Unit,
            "",
            ("unit of the numbers in this file; results are shown in SI", "единица чисел в этом файле; результаты показываются в СИ"),
            "\"rad\"",
        ),
        may(
            "start",
            Type::Formula,
            "",
            "0",
            (
                "value at t = 0, a constant; one that is not given stays 0 wherever the connections allow it, else the coordinates listed last move",
                "значение при t = 0, постоянная; незаданное остаётся нулём, если это допускают связи, иначе меняются последние в списке координаты",
            ),
            "\"15 deg\"",
        ),
        may(
            "rate",
            Type::Formula,
            "",
            "0",
            (
                "rate at t = 0, a constant; not given: as for `start`; a stop that opens or strikes and a rope that slackens allow 0",
                "скорость при t = 0, постоянная; если не задана — как для `start`; упор, который размыкается или ударяет, и провисающий канат допускают 0",
            ),
            "\"2 rad/s\"",
        ),
        may(
            "guess",
            Type::Formula,
            "",
            "0",
            (
                "instead of `start`: where the search for the value that closes the connections begins; the nearest configuration is taken",
                "вместо `start`: откуда начинать поиск значения, при котором связи замкнуты; берётся ближайшее положение",
            ),
            "\"1.7 rad\"",
        ),
        may("rate_guess", Type::Formula, "", "0", ("the same for `rate`", "то же для `rate`"), "\"0\""),
        SYMBOL,
        LABEL,
    ],
    example: "[coordinates]\nphi = { unit = \"rad\", start = \"15 deg\" }\nx = \"m\"\n",
};

/// `[frames.NAME]`.
pub const FRAME: TableSpec = TableSpec {
    name: "frames",
    about: ("Frames without mass. `ground` exists always.", "Системы отсчёта без массы. `ground` (неподвижная) есть всегда."),
    short: None,
    fields: &[ON, ORIGIN, ANGLE, ROTATE, SPIN],
    example: "[frames.blade]\norigin = [\"0\", \"0\"]\nspin = \"omega\"\n",
};

/// `[bodies.NAME]`.
pub const BODY: TableSpec = TableSpec {
    name: "bodies",
    about: (
        "Bodies: frames with mass. Without `mass` and `inertia` a body is massless.",
        "Тела: системы отсчёта с массой. Без `mass` и `inertia` тело невесомо.",
    ),
    short: None,
    fields: &[
        ON,
        ORIGIN,
        ANGLE,
        ROTATE,
        SPIN,
        LABEL,
        may("mass", Type::Formula, "kg", "0", ("mass", "масса"), "\"m\""),
        may("center", Type::Vector, "m", "[0, 0]", ("mass centre in body axes", "центр масс в осях тела"), "[\"0\", \"-l\"]"),
        may(
            "inertia",
            Type::Inertia,
            "kg m^2",
            "0",
            (
                "inertia about the mass centre: about z, or the tensor; products are sums of m x y (minus signs stand in the tensor)",
                "момент инерции относительно центральной оси z или тензор инерции относительно центра масс; центробежные моменты — суммы m x y (в тензоре они со знаком минус)",
            ),
            "\"m*l^2/12\"",
        ),
        may(
            "shape",
            Type::Shape,
            "",
            "",
            (
                "homogeneous body of the given mass: disc(R), ring(R), ring(R1, R2), rod(L), rod(L, y), box(a, b), box(a, b, c), sphere(R), cylinder(R, H), point; axes of revolution along z, rod along x",
                "однородное тело заданной массы: disc(R), ring(R), ring(R1, R2), rod(L), rod(L, y), box(a, b), box(a, b, c), sphere(R), cylinder(R, H), point; ось вращения — z, стержень — вдоль x",
            ),
            "\"disc(R)\"",
        ),
        may(
            "gyration",
            Type::Formula,
            "m",
            "",
            ("radius of gyration about z: inertia = mass*gyration^2", "радиус инерции относительно z: inertia = mass*gyration^2"),
            "\"rho\"",
        ),
        may("gravity", Type::Bool, "", "true", ("whether gravity acts on it", "действует ли сила тяжести"), "false"),
    ],
    example: "[bodies.pendulum]\nangle = \"phi\"\nmass = \"m\"\ncenter = [\"0\", \"-l\"]\n",
};

/// `inertia = { ... }`.
pub const TENSOR: TableSpec = TableSpec {
    name: "inertia",
    about: ("inertia tensor about the mass centre, body axes", "тензор инерции относительно центра масс, оси тела"),
    short: None,
    fields: &[
        must("xx", Type::Formula, "kg m^2", ("moment about x", "момент относительно x"), "\"J_x\""),
        must("yy", Type::Formula, "kg m^2", ("moment about y", "момент относительно y"), "\"J_y\""),
        must("zz", Type::Formula, "kg m^2", ("moment about z", "момент относительно z"), "\"J_z\""),
        may("xy", Type::Formula, "kg m^2", "0", ("sum of m x y", "сумма m x y"), "\"J_xy\""),
        may("yz", Type::Formula, "kg m^2", "0", ("sum of m y z", "сумма m y z"), "0"),
        may("xz", Type::Formula, "kg m^2", "0", ("sum of m x z", "сумма m x z"), "0"),
    ],
    example: "",
};

/// `[points]`.
pub const POINT: TableSpec = TableSpec {
    name: "points",
    about: ("Named points of frames and bodies.", "Именованные точки тел и систем отсчёта."),
    short: None,
    fields: &[ON, must("at", Type::Vector, "m", ("coordinates in that frame", "координаты в этой системе"), "[\"r\", \"0\"]")],
    example: "[points]\nA = { on = \"crank\", at = [\"r\", \"0\"] }\n",
};

/// `[outputs]`.
pub const OUTPUT: TableSpec = TableSpec {
    name: "outputs",
    about: (
        "Named results. Formulas may use everything, `phi''`, kinematic functions and other outputs. Coordinates and rates are results without being listed.",
        "Именованные результаты. Формулы могут использовать всё, `phi''`, кинематические функции и другие выходные величины. Координаты и скорости выводятся и так.",
    ),
    short: Some(("name = formula", "имя = формула")),
    fields: &[
        must("value", Type::Formula, "", ("formula", "формула"), "\"phi'\""),
        may("unit", Type::Unit, "", "SI", ("unit for showing; files stay in SI", "единица для показа; файлы остаются в СИ"), "\"rpm\""),
        SYMBOL,
        LABEL,
    ],
    example: "[outputs]\nomega_p = { value = \"phi'\", unit = \"rpm\" }\n",
};

/// `[regimes]`.
pub const REGIME: TableSpec = TableSpec {
    name: "regimes",
    about: (
        "Regimes of a motion: name = condition over its numbers, as `sweep` observes them, and constant parameters. The first that holds is meant. `threshold` with `regimes = true` finds where one gives way to another.",
        "Режимы движения: имя = условие на его числа, как их записывает `sweep`, и постоянные параметры. Имеется в виду первый режим, условие которого выполнено. Расчёт `threshold` с `regimes = true` находит, где один режим сменяется другим.",
    ),
    short: Some(("name = condition", "имя = условие")),
    fields: &[must(
        "NAME",
        Type::Formula,
        "",
        ("condition: comparisons, joined by `and`, `or`, `not`", "условие: сравнения, соединённые `and`, `or`, `not`"),
        "\"abs(mean(phi', 20 s, 30 s) - 200 [rad/s]) < 5 [rad/s]\"",
    )],
    example: "[regimes]\ncaptured_x = \"abs(mean(phi', 20 s, 30 s) - 200 [rad/s]) < 5 [rad/s]\"\nhangs = \"max(abs(phi'), 20 s, 30 s) < 1 [rad/s]\"\n",
};

/// `[[phases]]`.
pub const PHASE: TableSpec = TableSpec {
    name: "phases",
    about: (
        "A schedule of parameters: each phase begins where the one before ends (the first at t = 0) and sets parameters. A value holds until another phase sets it. The switches are hit exactly. `--set phases=restarts` (or `keeps`) chooses the reading for all phases.",
        "Расписание параметров: каждый этап начинается там, где кончается предыдущий (первый — при t = 0), и задаёт параметры. Значение действует, пока его не сменит другой этап. Моменты переключения выдерживаются точно. `--set phases=restarts` (или `keeps`) выбирает толкование для всех этапов.",
    ),
    short: None,
    fields: &[
        may(
            "until",
            Type::Formula,
            "s",
            "",
            ("instant at which the phase ends; the last phase may do without", "момент окончания этапа; у последнего может отсутствовать"),
            "\"2*t_s\"",
        ),
        may(
            "set",
            Type::Table,
            "",
            "",
            (
                "values of parameters from the start of the phase; the parameter's own name stands for its value in [parameters]",
                "значения параметров с начала этапа; собственное имя параметра обозначает его значение в [parameters]",
            ),
            "{ M_0 = \"8 N m\" }",
        ),
        may(
            "phase",
            Type::String,
            "",
            "\"keeps\"",
            (
                "\"keeps\": forces and torques go on; \"restarts\": the time in forces and torques counts from the start of the phase; holds for later phases too",
                "\"keeps\": силы и моменты продолжаются; \"restarts\": время в силах и моментах отсчитывается от начала этапа; действует и для следующих этапов",
            ),
            "\"restarts\"",
        ),
    ],
    example: "[[phases]]\nuntil = \"t_s\"\n\n[[phases]]\nuntil = \"2*t_s\"\nset = { M_0 = \"8 N m\" }\n\n[[phases]]\nset = { M_0 = \"0 N m\" }\n",
};

/// `plot = [{ ... }]`.
pub const PLOT: TableSpec = TableSpec {
    name: "plot",
    about: ("one plot", "один график"),
    short: None,
    fields: &[
        may("x", Type::Name, "", "\"t\"", ("horizontal axis", "горизонтальная ось"), "\"x\""),
        must("y", Type::Names, "", ("vertical axis", "вертикальная ось"), "[\"y\"]"),
        may("title", Type::Text, "", "", ("title", "заголовок"), "\"path\""),
    ],
    example: "",
};
