//! Long explanations of the findings about sections.

use words::explain::{Explanation, row};

/// The codes from M300 on.
pub const EXPLANATIONS: &[Explanation] = &[
    row(
        "M300",
        ("no form of a part", "не задана форма части"),
        (
            "A part of a section is one thing: a rectangle, triangle, circle, half disc, ring, polygon or rolled profile. A polygon needs three or more corners in \
             order, and its sides may not cross; of a ring the outer radius comes first.",
            "Часть сечения — одна фигура: прямоугольник, треугольник, круг, полукруг, кольцо, многоугольник или прокатный профиль. Многоугольнику нужны не менее трёх \
             вершин по порядку обхода, его стороны не пересекаются; у кольца первым пишут наружный радиус.",
        ),
        "parts = [{ ring = [\"4 cm\", \"5 cm\"] }]",
        "parts = [{ ring = [\"5 cm\", \"4 cm\"] }]",
    ),
    row(
        "M301",
        ("unknown rolled profile", "неизвестный прокатный профиль"),
        (
            "The table of profiles holds I-beams of GOST 8239 (I10 ... I60), channels of GOST 8240 (C5U ... C40U with slope, C5P ... C40P with parallel flanges; also \
             written 20У, 20П) and equal angles of GOST 8509 (L20x3 ... L250x20).",
            "В таблице есть двутавры ГОСТ 8239 (I10 ... I60), швеллеры ГОСТ 8240 (5У ... 40У с уклоном полок, 5П ... 40П с параллельными гранями; также C20U, C20P) и \
             равнополочные уголки ГОСТ 8509 (L20x3 ... L250x20).",
        ),
        "profile = \"I21\"",
        "profile = \"I20\"",
    ),
    row(
        "M302",
        ("material is taken out where there is none", "вычитается несуществующий материал"),
        (
            "A part with remove = true must lie inside what was added, and no place may be removed twice: otherwise area and moments would be too small, or negative.",
            "Часть с remove = true должна лежать внутри добавленного, и одно место нельзя вычитать дважды: иначе площадь и моменты получились бы заниженными или \
             отрицательными.",
        ),
        "parts = [{ rectangle = [\"4 cm\", \"4 cm\"] }, { circle = \"3 cm\", remove = true }]",
        "parts = [{ rectangle = [\"4 cm\", \"4 cm\"] }, { circle = \"1 cm\", remove = true }]",
    ),
    row(
        "M303",
        ("parts overlap", "части перекрываются"),
        (
            "Where two added parts overlap, the material would count twice. Move or cut one of them, or remove the common piece once.",
            "Там, где две добавленные части перекрываются, материал был бы учтён дважды. Сдвиньте или урежьте одну из них либо вычтите общий кусок один раз.",
        ),
        "parts = [{ circle = \"2 cm\" }, { circle = \"2 cm\", at = [\"3 cm\", \"0\"] }]",
        "parts = [{ circle = \"2 cm\" }, { circle = \"2 cm\", at = [\"4 cm\", \"0\"] }]",
    ),
    row(
        "M304",
        ("no area", "нет площади"),
        (
            "The corners lie on one line, or everything that was added is taken out again.",
            "Вершины лежат на одной прямой, или всё добавленное вычтено.",
        ),
        "polygon = [[\"0\", \"0\"], [\"1 cm\", \"1 cm\"], [\"2 cm\", \"2 cm\"]]",
        "polygon = [[\"0\", \"0\"], [\"1 cm\", \"1 cm\"], [\"2 cm\", \"0\"]]",
    ),
];
