//! Keys of `[sections.NAME]`.

use crate::keys::{Field, LABEL, TableSpec, Type, may};

const RECTANGLE: Field = may(
    "rectangle",
    Type::Vector,
    "m",
    "",
    ("width and height; `at` is its centre", "ширина и высота; `at` — центр"),
    "[\"12 cm\", \"20 cm\"]",
);
const TRIANGLE: Field = may(
    "triangle",
    Type::LegsOrCorners,
    "m",
    "",
    (
        "legs along x and y from the right angle, which is `at`; or three corners",
        "катеты вдоль x и y от прямого угла, он в `at`; или три вершины",
    ),
    "[\"6 cm\", \"4 cm\"]",
);
const CIRCLE: Field = may("circle", Type::Formula, "m", "", ("radius; `at` is the centre", "радиус; `at` — центр"), "\"3 cm\"");
const HALF_DISC: Field = may(
    "half_disc",
    Type::Formula,
    "m",
    "",
    (
        "radius; `at` is the middle of the diameter, the half disc lies above it (turn it by `angle`)",
        "радиус; `at` — середина диаметра, полукруг лежит над ним (поворот — `angle`)",
    ),
    "\"3 cm\"",
);
const RING: Field = may(
    "ring",
    Type::Vector,
    "m",
    "",
    ("outer and inner radius; `at` is the centre", "наружный и внутренний радиусы; `at` — центр"),
    "[\"5 cm\", \"4 cm\"]",
);
const POLYGON: Field = may(
    "polygon",
    Type::Corners,
    "m",
    "",
    ("corners in order; `at` is their origin", "вершины по порядку обхода; `at` — их начало отсчёта"),
    "[[\"0\", \"0\"], [\"6 cm\", \"0\"], [\"4 cm\", \"5 cm\"]]",
);
const PROFILE: Field = may(
    "profile",
    Type::String,
    "",
    "",
    (
        "rolled-steel profile; `at` is its centroid: I10 ... I60 (GOST 8239), channels C5U ... C40U, C5P ... C40P (GOST 8240), equal angles L20x3 ... L250x20 (GOST 8509)",
        "прокатный профиль; `at` — центр тяжести: двутавры I10 ... I60 (ГОСТ 8239), швеллеры 5У ... 40У, 5П ... 40П (ГОСТ 8240), уголки L20x3 ... L250x20 (ГОСТ 8509)",
    ),
    "\"I20\"",
);
const PART_AT: Field = may("at", Type::Vector, "m", "[0, 0]", ("place of the part", "место части"), "[\"0\", \"10 cm\"]");
const PART_ANGLE: Field =
    may("angle", Type::Formula, "rad", "0", ("turn of the part about `at`", "поворот части вокруг `at`"), "\"90 deg\"");

/// `[sections.NAME]`.
pub const SECTION: TableSpec = TableSpec {
    name: "sections",
    about: (
        "Sections of rods: parts added and removed, or one form. A file of sections alone needs nothing else.",
        "Сечения стержней: части добавляются и вычитаются; либо одна фигура. Файлу, где есть только сечения, больше ничего не нужно.",
    ),
    short: None,
    fields: &[
        may(
            "parts",
            Type::Parts,
            "",
            "",
            ("parts; without it the section is the one form below", "части; без ключа сечение — одна из фигур ниже"),
            "[{ circle = \"3 cm\" }]",
        ),
        RECTANGLE,
        TRIANGLE,
        CIRCLE,
        HALF_DISC,
        RING,
        POLYGON,
        PROFILE,
        PART_AT,
        PART_ANGLE,
        LABEL,
    ],
    example: "[sections.girder]\nparts = [\n  { profile = \"I20\" },\n  { rectangle = [\"12 cm\", \"1 cm\"], at = [\"0\", \"10,5 cm\"] },\n  { circle = \"4 mm\", at = [\"0\", \"10,5 cm\"], remove = true },\n]\n",
};

/// `parts = [{ ... }]`.
pub const PART: TableSpec = TableSpec {
    name: "parts",
    about: ("one part of a section", "одна часть сечения"),
    short: None,
    fields: &[
        RECTANGLE,
        TRIANGLE,
        CIRCLE,
        HALF_DISC,
        RING,
        POLYGON,
        PROFILE,
        PART_AT,
        PART_ANGLE,
        may("remove", Type::Bool, "", "false", ("whether the part is taken out", "вычитается ли часть"), "true"),
    ],
    example: "",
};
