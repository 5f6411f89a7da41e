//! Long explanations of findings about small motions.

use words::explain::{Explanation, row};

/// The codes of the studies of small motions.
pub const LINEAR: &[Explanation] = &[
    row(
        "M091",
        ("unknown of the frequency equation", "неизвестное частотного уравнения"),
        (
            "The frequency equation is written in a variable of your choice, which must be a factor times the squared frequency. The frequency \
             itself is written k, or omega where the model uses k for something else; the factor may use constant parameters.",
            "Частотное уравнение записывается относительно выбранной величины: квадрата частоты с множителем. Сама частота обозначается k, а если \
             имя k занято — omega; множитель составляется из постоянных параметров.",
        ),
        "frequency_variable = { z = \"m*k/c\" }",
        "frequency_variable = { z = \"m*k^2/c\" }",
    ),
    row(
        "M092",
        ("not a constant parameter", "не постоянный параметр"),
        (
            "A study that goes through values of something (`over`) needs a row of [parameters] that is constant: not a coordinate, not a formula of \
             time.",
            "Расчёту, который проходит по значениям величины (`over`), нужна постоянная из [parameters]: не координата и не формула времени.",
        ),
        "over = \"phi\"",
        "over = \"Omega\"",
    ),
    row(
        "M093",
        ("range of a study", "диапазон расчёта"),
        (
            "A range has two ends, the first smaller than the second; frequencies are not negative. The number of points is whole, from 2 to a million.",
            "У диапазона две границы, первая меньше второй; частоты неотрицательны. Число точек — целое от 2 до миллиона.",
        ),
        "range = [\"100 rad/s\", \"1 rad/s\"]",
        "range = [\"1 rad/s\", \"100 rad/s\"]",
    ),
    row(
        "M094",
        ("an unknown with a formula", "неизвестное с формулой"),
        (
            "The parameters in [unknowns] are found from statics so that the start is a place of rest. Their values are guesses, plain quantities.",
            "Параметры из [unknowns] находятся из условий равновесия в начальном положении. Их значения — начальные приближения, простые величины.",
        ),
        "[unknowns]\nM = \"m*g*l\"",
        "[unknowns]\nM = \"2 N m\"",
    ),
    row(
        "M109",
        ("no such friction", "нет такого трения"),
        (
            "[impending] lists dry frictions of [frictions] that are at their limit in the place of rest; a name there must be one of these.",
            "В [impending] перечислены силы сухого трения из [frictions], достигшие предельных значений в положении покоя; имя должно быть одним из них.",
        ),
        "[impending]\nflor = \"+\"",
        "[impending]\nfloor = \"+\"",
    ),
    row(
        "M110",
        ("direction of impending sliding", "направление готового начаться скольжения"),
        (
            "At its limit a friction resists the sliding that is about to begin: forward along its path (`+`) or backward (`-`).",
            "На пределе трение противится скольжению, готовому начаться: вперёд по пути (`+`) или назад (`-`).",
        ),
        "[unknowns]\nP = \"100 N\"\n[impending]\nfloor = \"down\"",
        "[unknowns]\nP = \"100 N\"\n[impending]\nfloor = \"-\"",
    ),
    row(
        "M111",
        ("friction at its limit without an unknown", "трение на пределе без неизвестного"),
        (
            "A friction at its limit is an equation F = ±μN for the place of rest; a load, an angle or a length in [unknowns] makes it come true, or a coordinate that the study `equilibrium` seeks in a range (`over`, `range`).",
            "Трение на пределе — уравнение F = ±μN для положения покоя; оно выполняется за счёт нагрузки, угла или длины из [unknowns] либо координаты, которую расчёт `equilibrium` ищет в диапазоне (`over`, `range`).",
        ),
        "[impending]\nfloor = \"+\"",
        "[unknowns]\nP = \"100 N\"\n[impending]\nfloor = \"+\"",
    ),
];
