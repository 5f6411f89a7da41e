//! Tables of frames and trusses: nodes, the rods between them, their supports and loads, named displacements, how to compute.

use crate::keys::{DISTANCE, LABEL, SYMBOL, TableSpec, Type, may, must};

/// `[nodes.NAME]`.
pub const NODE: TableSpec = TableSpec {
    name: "nodes",
    about: (
        "Nodes of a plane frame or truss. A file with nodes needs no coordinates.",
        "Узлы плоской рамы или фермы. Файлу с узлами координаты не нужны.",
    ),
    short: None,
    fields: &[
        must("at", Type::Vector, "m", ("place in ground axes", "положение в неподвижных осях"), "[\"l\", \"0\"]"),
        may("mass", Type::Formula, "kg", "0", ("lumped mass", "сосредоточенная масса"), "\"m\""),
        may("inertia", Type::Formula, "kg m^2", "0", ("lumped moment of inertia", "сосредоточенный момент инерции"), "\"J\""),
        may("spring_x", Type::Formula, "N/m", "0", ("spring to the ground along x", "пружина к основанию вдоль x"), "\"c\""),
        may("spring_y", Type::Formula, "N/m", "0", ("spring to the ground along y", "пружина к основанию вдоль y"), "\"c\""),
        may(
            "spring_turn",
            Type::Formula,
            "N m",
            "0",
            ("torsion spring to the ground, per radian", "крутильная пружина к основанию, на радиан"),
            "\"c_t\"",
        ),
    ],
    example: "[nodes.A]\nat = [\"0\", \"0\"]\n",
};

/// `[rods.NAME]`.
pub const ROD: TableSpec = TableSpec {
    name: "rods",
    about: (
        "Straight rods between two nodes: Euler-Bernoulli bending, inextensible unless EA is given, massless unless a mass is given.",
        "Прямые стержни между двумя узлами: изгиб по Эйлеру — Бернулли, нерастяжимые без EA, невесомые без массы.",
    ),
    short: None,
    fields: &[
        must("between", Type::TwoNames, "", ("start and end", "начало и конец"), "[\"A\", \"B\"]"),
        may("rigid", Type::Bool, "", "false", ("whether it does not deform", "недеформируем ли"), "true"),
        may("EI", Type::Formula, "N m^2", "E*I", ("bending stiffness", "жёсткость на изгиб"), "\"EI\""),
        may("EA", Type::Formula, "N", "E*A", ("stiffness against stretching", "жёсткость на растяжение"), "\"20 MN\""),
        may("E", Type::Formula, "Pa", "", ("Young's modulus", "модуль упругости"), "\"2e11 Pa\""),
        may("I", Type::Formula, "m^4", "", ("second moment of the section", "момент инерции сечения"), "\"0.5677 cm^4\""),
        may("A", Type::Formula, "m^2", "", ("area of the section", "площадь сечения"), "\"4 cm^2\""),
        may(
            "section",
            Type::Name,
            "",
            "",
            (
                "section that gives A, and as I its I_x about the central axis x",
                "сечение, из которого берутся A и, в качестве I, его I_x относительно центральной оси x",
            ),
            "\"girder\"",
        ),
        may(
            "stretch",
            Type::Bool,
            "",
            "false",
            ("whether it stretches with E*A when EA is not given", "растягивается ли с жёсткостью E*A, если EA не задано"),
            "true",
        ),
        may("mass", Type::Formula, "kg", "0", ("mass", "масса"), "\"m\""),
        may(
            "density",
            Type::Formula,
            "kg/m^3",
            "",
            ("density; the mass is density*A*length", "плотность; масса равна density*A*длина"),
            "\"7800 kg/m^3\"",
        ),
        may("mass_per_length", Type::Formula, "kg/m", "", ("mass of a unit of length", "погонная масса"), "\"3 kg/m\""),
        may(
            "rotary_inertia",
            Type::Bool,
            "",
            "false",
            (
                "whether the turning of sections counts; needs density and I, or mass, I and A",
                "учитывать ли поворот сечений; нужны density и I либо масса, I и A",
            ),
            "true",
        ),
        may(
            "releases",
            Type::Names,
            "",
            "[]",
            ("hinges: \"start\", \"end\"", "шарниры: \"start\" (начало), \"end\" (конец)"),
            "[\"start\", \"end\"]",
        ),
        may(
            "divisions",
            Type::Formula,
            "1",
            "1",
            ("number of equal parts for distributed mass", "число равных частей для распределённой массы"),
            "16",
        ),
    ],
    example: "[rods.AB]\nbetween = [\"A\", \"B\"]\nEI = \"20 kN m^2\"\n",
};

/// `[supports.NAME]`.
pub const SUPPORT: TableSpec = TableSpec {
    name: "supports",
    about: ("Supports of nodes.", "Опоры узлов."),
    short: None,
    fields: &[
        must("at", Type::Name, "", ("node", "узел"), "\"A\""),
        must(
            "directions",
            Type::Names,
            "",
            ("what is held: \"x\", \"y\", \"turn\"", "что закреплено: \"x\", \"y\", \"turn\" (поворот)"),
            "[\"x\", \"y\"]",
        ),
        may("angle", Type::Formula, "rad", "0", ("angle of its x axis", "угол её оси x"), "\"30 deg\""),
    ],
    example: "[supports.A]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]\n",
};

/// `[distributed.NAME]`.
pub const LINE_LOAD: TableSpec = TableSpec {
    name: "distributed",
    about: ("Loads along a rod, per unit of its length.", "Нагрузки вдоль стержня на единицу его длины."),
    short: None,
    fields: &[
        must("on", Type::Name, "", ("rod", "стержень"), "\"AB\""),
        must("value", Type::Vector, "N/m", ("components in ground axes", "компоненты в неподвижных осях"), "[\"0\", \"-2 kN/m\"]"),
        may(
            "value_end",
            Type::Vector,
            "N/m",
            "value",
            ("components at the end; between them the load is linear", "компоненты в конце; между ними нагрузка линейна"),
            "[\"0\", \"0\"]",
        ),
    ],
    example: "[distributed.q]\non = \"AB\"\nvalue = [\"0\", \"-2 kN/m\"]\n",
};

/// `[displacements.NAME]`.
pub const DISPLACEMENT: TableSpec = TableSpec {
    name: "displacements",
    about: (
        "Named displacements of nodes and of places on rods. As many of them as there are degrees of freedom with inertia are the coordinates of the structure.",
        "Именованные перемещения узлов и точек стержней. Если их столько, сколько степеней свободы с инерцией, они служат координатами конструкции.",
    ),
    short: None,
    fields: &[
        must("at", Type::Name, "", ("node or rod", "узел или стержень"), "\"CD\""),
        DISTANCE,
        may(
            "direction",
            Type::String,
            "",
            "\"y\"",
            ("\"x\", \"y\", \"turn\", or a vector", "\"x\", \"y\", \"turn\" (поворот) или вектор"),
            "\"turn\"",
        ),
        may("start", Type::Formula, "", "0", ("value at t = 0, a constant", "значение при t = 0, постоянная"), "\"2 mm\""),
        may("rate", Type::Formula, "", "0", ("rate at t = 0, a constant", "скорость при t = 0, постоянная"), "\"0.1 m/s\""),
        SYMBOL,
        LABEL,
    ],
    example: "[displacements.u1]\nat = \"CD\"\ndistance = \"l/2\"\ndirection = \"x\"\n",
};

/// `[rayleigh.NAME]`.
pub const RAYLEIGH: TableSpec = TableSpec {
    name: "rayleigh",
    about: (
        "Rayleigh's method: an assumed shape of a rod gives its reduced mass and stiffness; `s` in the formula is the distance from its start.",
        "Метод Рэлея: принятая форма изгиба стержня даёт его приведённые массу и жёсткость; `s` в формуле — расстояние от начала стержня.",
    ),
    short: None,
    fields: &[
        must("on", Type::Name, "", ("rod", "стержень"), "\"AB\""),
        must("shape", Type::Formula, "", ("deflection up to a factor", "прогиб с точностью до множителя"), "\"3*l*s^2 - s^3\""),
        may("distance", Type::Formula, "m", "length", ("where the mass is reduced to", "точка приведения"), "\"l\""),
        LABEL,
    ],
    example: "[rayleigh.static]\non = \"AB\"\nshape = \"3*l*s^2 - s^3\"\n",
};

/// `[structure]`.
pub const STRUCTURE: TableSpec = TableSpec {
    name: "structure",
    about: ("How the structure is computed.", "Как рассчитывать конструкцию."),
    short: None,
    fields: &[
        may(
            "condense",
            Type::Bool,
            "",
            "true for undivided rods of frames with at most 100 independent displacements",
            (
                "whether turns of nodes that carry inertia follow the other displacements statically",
                "следуют ли повороты узлов, несущие инерцию, за остальными перемещениями статически",
            ),
            "false",
        ),
        may("modes", Type::Formula, "1", "10", ("largest number of modes", "наибольшее число форм"), "4"),
        may(
            "accuracy",
            Type::Formula,
            "1",
            "",
            (
                "wanted relative accuracy of the frequencies: rods are divided until it is reached, in every study",
                "нужная относительная точность частот: стержни делятся, пока она не достигнута, в любом расчёте",
            ),
            "1e-8",
        ),
        may(
            "compare",
            Type::Bool,
            "",
            "false",
            (
                "whether the frequencies at all levels of simplification stand in one table",
                "показать ли частоты при всех упрощениях в одной таблице",
            ),
            "true",
        ),
        may(
            "continuum",
            Type::Bool,
            "",
            "false",
            ("whether the exact frequencies of the distributed mass stand beside", "показать ли рядом точные частоты распределённой массы"),
            "true",
        ),
    ],
    example: "[structure]\naccuracy = 1e-8\nmodes = 4\n",
};
