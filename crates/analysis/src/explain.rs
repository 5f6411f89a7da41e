//! Every table of explanations of this crate: what `strutt explain` says of its codes.

use structures::matrices;
use words::explain::{Explanation, plain};

use crate::fault::{
    ACCUMULATION_EN, ACCUMULATION_RU, CHATTERING_EN, CHATTERING_RU, CONNECTED_EN, CONNECTED_RU, DRIVEN_EN, DRIVEN_RU, EXCITES_EN,
    EXCITES_RU, FINITE_EN, FINITE_RU, FREQUENCY_EN, FREQUENCY_RU, INERTIA_EN, INERTIA_RU, LOAD_EN, LOAD_RU, MASSLESS_EN, MASSLESS_RU,
    MEMORY_EN, MEMORY_RU, NAME_EN, NAME_RU, NEUTRAL_EN, NEUTRAL_RU, NEWTON_EN, NEWTON_RU, NO_REACTIONS_EN, NO_REACTIONS_RU, NOT_LINEAR_EN,
    NOT_LINEAR_RU, NOTHING_EN, NOTHING_RU, NOWHERE_EN, NOWHERE_RU, OPTION_EN, OPTION_RU, OUTPUT_EN, OUTPUT_RU, OUTSIDE_EN, OUTSIDE_RU,
    OVERFLOW_EN, OVERFLOW_RU, PERIODIC_EN, PERIODIC_RU, RANGE_EN, RANGE_RU, REACTION_EN, REACTION_RU, STEPS_EN, STEPS_RU, UNDERFLOW_EN,
    UNDERFLOW_RU, UNKNOWN_EN, UNKNOWN_RU, UNREST_EN, UNREST_RU, VARYING_EN, VARYING_RU, WRONG_SIDE_EN, WRONG_SIDE_RU, bends, connections,
    loads,
};
use crate::rest::faults as rest;
use crate::studies::explain as studies;

/// Every table of explanations of this crate.
pub const TABLES: &[&[Explanation]] =
    &[EXPLANATIONS, bends::EXPLANATIONS, connections::EXPLANATIONS, loads::EXPLANATIONS, structures::faults::EXPLANATIONS];

const EXPLANATIONS: &[Explanation] = &[
    plain("S001", ("switch without a direction (chattering)", "переключение без направления (дребезг)"), (CHATTERING_EN, CHATTERING_RU)),
    plain("S002", ("switches accumulate", "переключения сгущаются"), (ACCUMULATION_EN, ACCUMULATION_RU)),
    plain("S003", ("step underflow", "шаг стал исчезающе малым"), (UNDERFLOW_EN, UNDERFLOW_RU)),
    plain("S004", ("not a finite number", "не конечное число"), (FINITE_EN, FINITE_RU)),
    plain("S005", ("result larger than memory", "результат не помещается в память"), (MEMORY_EN, MEMORY_RU)),
    plain("S006", ("unusable option of a study", "недопустимый параметр расчёта"), (OPTION_EN, OPTION_RU)),
    plain("S007", ("Newton's method found no equilibrium", "равновесие не найдено"), (NEWTON_EN, NEWTON_RU)),
    plain("S008", ("neutral equilibrium or free motion", "безразличное равновесие или свободное движение"), (NEUTRAL_EN, NEUTRAL_RU)),
    plain("S009", ("unknown output", "неизвестная выходная величина"), (OUTPUT_EN, OUTPUT_RU)),
    plain("S010", ("more steps than anybody waits for", "слишком много шагов"), (STEPS_EN, STEPS_RU)),
    plain("S060", ("no reactions", "нет реакций"), (NO_REACTIONS_EN, NO_REACTIONS_RU)),
    plain("S062", ("a rope that would have to push", "нить, которая должна была бы толкать"), (WRONG_SIDE_EN, WRONG_SIDE_RU)),
    plain("S061", ("a mechanism that does not rest", "механизм не находится в равновесии"), (UNREST_EN, UNREST_RU)),
    rest::WANDERING,
    rest::JOURNAL,
    crate::studies::response::ROUNDED,
    crate::studies::rolling::REFUSED,
    crate::studies::limits::PULSATING,
    rest::SLIPS,
    rest::OPEN,
    rest::NO_LIMIT,
    studies::NO_RETURN,
    studies::NO_REGIME,
    studies::DRIVEN,
    studies::NO_PASSAGE,
    studies::NO_DERIVATIVE,
    studies::TOO_QUICK,
    studies::NOTHING_MOVES,
    studies::SECTION_OF_FORCED,
    studies::ROWS_ONLY,
    studies::NO_NUMBER,
    crate::studies::transient::phase_error::PHASE,
    studies::LONG_WAY,
    studies::NOT_AT_REST,
    studies::NO_SUCH_PERIOD,
    studies::NOT_TURNING,
    studies::NO_ENERGY,
    studies::NO_DRIVE,
    studies::DEAD_POINT,
    studies::ENTERED,
    studies::UNDETERMINED,
    studies::OVERDRIVEN,
    studies::BRANCHES,
    plain("S021", ("mass matrix not positive definite", "матрица масс не положительно определена"), (matrices::MASS_EN, matrices::MASS_RU)),
    plain(
        "S022",
        ("stiffness matrix not positive definite", "матрица жёсткости не положительно определена"),
        (matrices::SINGULAR_EN, matrices::SINGULAR_RU),
    ),
    plain(
        "S023",
        ("eigenvalues did not converge", "собственные значения не сошлись"),
        (matrices::CONVERGENCE_EN, matrices::CONVERGENCE_RU),
    ),
    plain(
        "S024",
        ("matrix with an undefined entry", "матрица с неопределённым элементом"),
        (matrices::MALFORMED_EN, matrices::MALFORMED_RU),
    ),
    plain("S070", ("no closed form: not linear", "нет замкнутого решения: нелинейность"), (NOT_LINEAR_EN, NOT_LINEAR_RU)),
    plain(
        "S071",
        ("no closed form: coefficients change with time", "нет замкнутого решения: переменные коэффициенты"),
        (VARYING_EN, VARYING_RU),
    ),
    plain("S072", ("no closed form: the load", "нет замкнутого решения: вид нагрузки"), (LOAD_EN, LOAD_RU)),
    plain("S073", ("singular mass matrix", "вырожденная матрица масс"), (MASSLESS_EN, MASSLESS_RU)),
    plain("S074", ("no closed form: connections", "нет замкнутого решения: связи"), (CONNECTED_EN, CONNECTED_RU)),
    plain("S075", ("no equilibrium to linearise about", "нет равновесия для линеаризации"), (NOWHERE_EN, NOWHERE_RU)),
    plain("S084", ("nothing can move", "двигаться нечему"), (NOTHING_EN, NOTHING_RU)),
    plain("S083", ("extremes leave out a row", "крайние значения не охватывают строк"), (OUTSIDE_EN, OUTSIDE_RU)),
    plain("S077", ("a number without a value", "число без значения"), (OVERFLOW_EN, OVERFLOW_RU)),
    plain("S089", ("amplitude of a reaction", "амплитуда реакции"), (REACTION_EN, REACTION_RU)),
    plain("S076", ("the load is not periodic", "нагрузка непериодична"), (PERIODIC_EN, PERIODIC_RU)),
    plain("S030", ("unknown load or parameter", "неизвестная нагрузка или параметр"), (NAME_EN, NAME_RU)),
    plain("S031", ("no inertia here", "нет инерции"), (INERTIA_EN, INERTIA_RU)),
    plain("S032", ("nothing excites", "нет возбуждения"), (EXCITES_EN, EXCITES_RU)),
    plain("S033", ("which frequency?", "какая частота?"), (FREQUENCY_EN, FREQUENCY_RU)),
    plain("S034", ("range of frequencies", "диапазон частот"), (RANGE_EN, RANGE_RU)),
    plain("S035", ("a drive and small motions", "привод и малые движения"), (DRIVEN_EN, DRIVEN_RU)),
    plain("S036", ("statics do not give the unknown", "неизвестное не определяется статикой"), (UNKNOWN_EN, UNKNOWN_RU)),
];
