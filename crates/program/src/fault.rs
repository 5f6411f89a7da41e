//! What can go wrong between equations and numbers, said in both languages.

use symbolic::Expr;
use words::explain::{Explanation, plain};
use words::{Message, Notice, Text};

/// A clear refusal: its notice, and what the program knows beside it; behind one pointer because results carry it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.notice)]
pub struct Fault(Box<Details>);

/// A notice with the place in the equations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Details {
    /// What happened, the likely cause, the cure.
    pub notice: Notice,
    /// The expression that failed, for printing in the user's symbols, when it is known.
    pub expression: Option<Expr>,
    /// Where equations with connections have no single solution (P013).
    pub singular: Option<Singular>,
}

impl std::ops::Deref for Details {
    type Target = Notice;
    fn deref(&self) -> &Notice {
        &self.notice
    }
}

/// The place at which the equations of motion and conditions cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular {
    /// Index in `Program::rows`: the first equation that follows from those before it, or contradicts them.
    pub row: usize,
    /// Index in `Program::unknowns`: an unknown that the equations leave open.
    pub unknown: usize,
}

impl std::ops::Deref for Fault {
    type Target = Details;
    fn deref(&self) -> &Details {
        &self.0
    }
}

impl Fault {
    /// A fault of that code about `subject`; cause and cure come from the table.
    pub(crate) fn new(code: &'static str, subject: &Text) -> Fault {
        let row = CAUSES.iter().find(|row| row.0 == code).unwrap_or(&CAUSES[0]);
        let fill = |en: &str, ru: &str| Text::new(en.replace("{}", &subject.en), ru.replace("{}", &subject.ru));
        let [what, why, help] = row.1.map(|(en, ru)| fill(en, ru));
        let notice = Notice::from(Message { code: row.0, what, why, help });
        Fault(Box::new(Details { notice, expression: None, singular: None }))
    }

    pub(crate) fn about(code: &'static str, subject: impl Into<String>) -> Fault {
        Fault::new(code, &named(subject.into()))
    }

    pub(crate) fn with(mut self, singular: Singular) -> Fault {
        self.0.singular = Some(singular);
        self
    }

    pub(crate) fn at(mut self, expression: Option<Expr>) -> Fault {
        self.0.expression = expression;
        self
    }
}

/// What comes before the number of a root that only has to exist (`lower::equations::places`).
pub(crate) const POSITION: &str = "position ";

/// The name of a root in both languages: the user's own names stay as they are.
fn named(name: String) -> Text {
    match name.strip_prefix(POSITION) {
        Some(number) => Text::new(name.as_str(), format!("положение {number}")),
        None => Text::same(name),
    }
}

/// Code of a value that is no finite number. This one and the next two are looked for by those who call.
pub const NOT_FINITE: &str = "P006";
/// Code of a state at which there is no Taylor series.
pub const NO_SERIES: &str = "P007";
/// Code of conditions that depend on each other where the machine stands.
pub const DEPENDENT: &str = "P013";

type Wording = (&'static str, &'static str);

/// Code; what, why, help as (en, ru) with `{}` for the subject.
const CAUSES: &[(&str, [Wording; 3])] = &[
    (
        "P006",
        [
            ("{} is not a finite number", "{}: результат не является конечным числом"),
            (
                "a value overflowed: the data differ by too many orders of magnitude, or the motion runs away",
                "произошло переполнение: данные различаются на слишком много порядков или движение неограниченно нарастает",
            ),
            ("check the units of the parameters and the initial data", "проверьте единицы параметров и начальные данные"),
        ],
    ),
    (
        "P001",
        [
            ("division by zero in {}", "деление на нуль: {}"),
            ("a denominator vanishes at this state", "знаменатель обращается в нуль в этом состоянии"),
            ("start elsewhere, or guard the formula with if(...)", "начните из другого состояния или защитите формулу условием if(...)"),
        ],
    ),
    (
        "P002",
        [
            ("root or fractional power of a negative number in {}", "корень или дробная степень отрицательного числа: {}"),
            ("the radicand became negative at this state", "подкоренное выражение стало отрицательным в этом состоянии"),
            ("check signs, or guard the formula with if(...)", "проверьте знаки или защитите формулу условием if(...)"),
        ],
    ),
    (
        "P003",
        [
            ("logarithm of a number that is not positive in {}", "логарифм неположительного числа: {}"),
            ("the argument of log fell to zero or below", "аргумент log стал нулевым или отрицательным"),
            ("check signs, or guard the formula with if(...)", "проверьте знаки или защитите формулу условием if(...)"),
        ],
    ),
    (
        "P004",
        [
            (
                "an inverse function outside the numbers where it has a value (asin and acos from -1 to 1, acosh from 1, atanh between -1 and 1) in {}",
                "обратная функция вне области определения (asin и acos: от -1 до 1; acosh: от 1; atanh: между -1 и 1): {}",
            ),
            (
                "the mechanism cannot be assembled at this state: a ratio of lengths exceeds one",
                "механизм в этом состоянии не собирается: отношение длин превышает единицу",
            ),
            ("check the lengths and the range of motion", "проверьте длины и диапазон движения"),
        ],
    ),
    (
        "P005",
        [
            ("the mass matrix is singular: {}", "матрица масс вырождена: {}"),
            (
                "at this state some combination of accelerations moves no mass",
                "в этом состоянии некоторая комбинация ускорений не приводит в движение никакой массы",
            ),
            (
                "give inertia to the bodies concerned, or start away from the dead position",
                "задайте инерцию этим телам или начните вне мёртвого положения",
            ),
        ],
    ),
    (
        "P009",
        [
            ("the mass matrix is not positive: {}", "матрица масс не положительно определена: {}"),
            (
                "kinetic energy would be negative: a formula of the geometry has left its domain, such as an inverse sine beyond 1 whose rate is imaginary",
                "кинетическая энергия оказалась бы отрицательной: формула геометрии вышла из области определения, например арксинус числа больше 1",
            ),
            (
                "check lengths and the range of motion, and that masses and moments of inertia are positive",
                "проверьте длины и диапазон движения, а также знаки масс и моментов инерции",
            ),
        ],
    ),
    (
        "P007",
        [
            ("{} has no Taylor series at this state", "{}: в этом состоянии нет разложения в ряд Тейлора"),
            (
                "a root, an absolute distance or an inverse sine is taken at the very edge of its domain, where its rate is infinite",
                "корень, расстояние или арксинус берётся на самой границе области определения, где производная бесконечна",
            ),
            (
                "start off the singular point, or write the formula so that it is smooth there",
                "начните вне особой точки или запишите формулу так, чтобы она была там гладкой",
            ),
        ],
    ),
    (
        "P008",
        [
            ("wrong number of values: {}", "неверное количество значений: {}"),
            ("the caller and the program disagree about the model", "вызывающая сторона и программа не согласованы"),
            ("pass one value per parameter, state and guard", "передайте по одному значению на параметр, состояние и переключатель"),
        ],
    ),
    (
        "P010",
        [
            ("nothing defines {}", "не определено: {}"),
            (
                "the formula uses a symbol that is neither time, a state, a parameter nor a definition here",
                "в формуле есть символ, который здесь не является ни временем, ни состоянием, ни параметром, ни определением",
            ),
            (
                "accelerations may only stand in outputs; declare other names in [parameters]",
                "ускорения допустимы только в выходных величинах; остальные имена объявите в [parameters]",
            ),
        ],
    ),
    (
        "P011",
        [
            ("{} is defined through itself", "{} определяется через себя"),
            ("the definitions form a cycle", "определения образуют цикл"),
            ("break the cycle", "разорвите цикл"),
        ],
    ),
    (
        "P012",
        [
            ("the equations have inconsistent sizes: {}", "размеры уравнений не согласованы: {}"),
            ("the derivation handed over incomplete equations", "вывод передал неполные уравнения"),
            ("please report the model", "сообщите об этой модели"),
        ],
    ),
    (
        "P013",
        [
            ("motion and reactions are not determined: {}", "движение и реакции не определяются: {}"),
            (
                "at this configuration the conditions depend on each other (a dead centre, a stretched linkage), or a motion has neither inertia nor a condition",
                "в этом положении условия связей зависимы (мёртвая точка, вытянутый механизм), либо у движения нет ни инерции, ни условия",
            ),
            (
                "start away from the dead position, give inertia to the bodies concerned, or remove a connection that repeats another",
                "начните вне мёртвого положения, задайте инерцию этим телам или уберите повторяющую связь",
            ),
        ],
    ),
    (
        "P014",
        [
            ("a reaction is not unique: {}", "реакция не единственна: {}"),
            (
                "more connections than needed hold the same motion, so that statics of rigid bodies cannot say how they share the load",
                "одно и то же движение удерживают лишние связи, и статика твёрдых тел не может разделить между ними нагрузку",
            ),
            (
                "remove the connections that repeat others, or ask for another quantity",
                "уберите повторяющие связи или запросите другую величину",
            ),
        ],
    ),
    (
        "P020",
        [
            ("the tape breaks a rule: {}", "лента нарушает правило: {}"),
            ("a tape was edited by hand, or a pass is faulty", "лента изменена вручную или ошибочен проход"),
            ("lower the model again; if it stays, please report it", "понизьте модель заново; если не помогло, сообщите об ошибке"),
        ],
    ),
    (
        "P021",
        [
            ("the tape text cannot be read: {}", "текст ленты не читается: {}"),
            ("the text was not written by this version", "текст записан не этой версией"),
            ("print the tape again", "напечатайте ленту заново"),
        ],
    ),
];

/// Code, title and body of every fault, for `strutt explain`.
pub const EXPLANATIONS: &[Explanation] = &[
    plain(
        "P001",
        ("Division by zero", "Деление на нуль"),
        (
            "A denominator is zero at the state that was evaluated. Typical: the length of a spring whose ends meet, a rate used as a divisor at rest. Start elsewhere or write if(...) around the formula.",
            "Знаменатель равен нулю в вычисляемом состоянии. Обычно это длина пружины, концы которой совпали, или скорость в знаменателе в состоянии покоя. Начните из другого состояния или заключите формулу в if(...).",
        ),
    ),
    plain(
        "P002",
        ("Root of a negative number", "Корень из отрицательного числа"),
        (
            "A square root or a fractional power was taken of a negative number.",
            "Квадратный корень или дробная степень взяты от отрицательного числа.",
        ),
    ),
    plain(
        "P003",
        ("Logarithm of a number that is not positive", "Логарифм неположительного числа"),
        ("log(x) needs x > 0.", "log(x) требует x > 0."),
    ),
    plain(
        "P004",
        ("Inverse function out of range", "Обратная функция вне области определения"),
        (
            "asin and acos need an argument between -1 and 1, acosh one from 1 on, atanh one inside -1 and 1. In a mechanism this means that the links are too short to reach.",
            "asin и acos требуют аргумента от -1 до 1, acosh — не меньше 1, atanh — строго между -1 и 1. Для механизма это значит, что звенья слишком коротки.",
        ),
    ),
    plain(
        "P005",
        ("Singular mass matrix", "Вырожденная матрица масс"),
        (
            "M q'' = h has no unique solution: some motion carries no inertia at this state. A coordinate may move only massless bodies, or the mechanism stands in a dead position.",
            "M q'' = h не имеет единственного решения: некоторое движение не обладает инерцией в этом состоянии. Координата двигает только невесомые тела или механизм находится в мёртвом положении.",
        ),
    ),
    plain(
        "P006",
        ("Value that is not finite", "Бесконечное значение"),
        (
            "A result overflowed or is not a number although no single operation was out of its domain.",
            "Результат переполнился или не является числом, хотя ни одна операция не вышла из области определения.",
        ),
    ),
    plain(
        "P007",
        ("No Taylor series", "Нет ряда Тейлора"),
        (
            "The value exists but its rates do not: asin(1), the angle of a point at the origin. The integrator needs a smooth right-hand side between switches; roots and fractional powers that pass zero are integrated.",
            "Значение существует, а производные нет: asin(1), угол точки в начале координат. Интегратору нужна гладкая правая часть между переключениями; корни и дробные степени, проходящие через нуль, интегрируются.",
        ),
    ),
    plain(
        "P008",
        ("Wrong number of values", "Неверное количество значений"),
        (
            "A program was called with too few or too many parameters, states, accelerations or modes.",
            "Программа вызвана с неверным количеством параметров, состояний, ускорений или режимов.",
        ),
    ),
    plain(
        "P009",
        ("Mass matrix that is not positive", "Матрица масс не положительно определена"),
        (
            "T = q'ᵀ M q'/2 cannot be negative. It becomes so when a formula that places a body leaves its domain while its square stays real: the rate of asin(u) is u'/sqrt(1 - u^2), and its square changes sign beyond u = 1. Negative added masses do it too.",
            "T = q'ᵀ M q'/2 не бывает отрицательной. Так получается, когда формула положения тела выходит из области определения, а квадрат остаётся вещественным: производная asin(u) равна u'/sqrt(1 - u^2), и её квадрат меняет знак при u > 1. То же дают отрицательные массы.",
        ),
    ),
    plain(
        "P010",
        ("Undefined symbol", "Неопределённый символ"),
        (
            "A formula that is to be evaluated contains a symbol without a value. Accelerations have values in outputs only.",
            "Вычисляемая формула содержит символ без значения. Ускорения имеют значения только в выходных величинах.",
        ),
    ),
    plain(
        "P011",
        ("Cyclic definition", "Циклическое определение"),
        ("A definition uses itself, directly or through others.", "Определение использует само себя, прямо или через другие."),
    ),
    plain(
        "P012",
        ("Inconsistent equations", "Несогласованные уравнения"),
        ("The mass matrix, the forces and the coordinates differ in number.", "Матрица масс, силы и координаты различаются по количеству."),
    ),
    plain(
        "P013",
        ("Motion not determined", "Движение не определяется"),
        (
            "Accelerations and reactions follow from M q'' = h + Jᵀ λ and J q'' = γ together. At this configuration these equations depend on each other: a linkage is stretched or at a dead centre, a connection repeats another, or a coordinate has neither inertia nor a condition.",
            "Ускорения и реакции находятся из системы M q'' = h + Jᵀ λ, J q'' = γ. В этом положении её уравнения зависимы: механизм вытянут или в мёртвой точке, связь повторяет другую либо у координаты нет ни инерции, ни условия.",
        ),
    ),
    plain(
        "P014",
        ("Reaction not unique", "Реакция не единственна"),
        (
            "The machine moves in a definite way, but this reaction is one of several that hold the same motion twice (a shaft in three bearings, a beam between two pins): rigid bodies leave their shares open. Motion and the other reactions are right.",
            "Движение определено, но эта реакция - одна из нескольких, удерживающих одно и то же (вал на трёх опорах, балка между двумя неподвижными шарнирами): для твёрдых тел их доли неопределимы. Движение и остальные реакции верны.",
        ),
    ),
    plain(
        "P020",
        ("Invalid program of operations (internal)", "Недопустимая программа вычислений (внутренняя ошибка)"),
        (
            "The list of operations made from the equations contradicts itself: an operation uses a number before it is computed, or one that does not exist. This is a mistake of the program, not of the model; nothing was computed. Please report it with the model file.",
            "Список операций, составленный по уравнениям, противоречив: операция берёт число до его вычисления или несуществующее число. Это ошибка программы, а не модели; ничего не вычислено. Сообщите о ней, приложив файл модели.",
        ),
    ),
    plain(
        "P021",
        ("Unreadable text of a program of operations (internal)", "Нечитаемая запись программы вычислений (внутренняя ошибка)"),
        (
            "The text form of a list of operations, used in tests, has a line that is no operation. Model files never lead here.",
            "В текстовой записи списка операций, применяемой в тестах, есть строка, которая не является операцией. Файлы моделей к этой ошибке не приводят.",
        ),
    ),
];
