//! What can go wrong in a study: each fault says what, why and how to cure it, in both languages.

use std::fmt;

use symbolic::Expr;
use words::digits::{number, rounded};
use words::{Message, Notice, Text};

mod assembly;
pub mod bends;
mod change_points;
pub mod codes;
pub mod connections;
pub mod contacts;
pub mod loads;
pub mod small;

/// A study cannot go on: its notice, and the expression that failed. Results found before the fault are kept beside it. Boxed, so that
/// results stay small.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault(Box<Notice>, Option<Expr>);

impl std::ops::Deref for Fault {
    type Target = Notice;
    fn deref(&self) -> &Notice {
        &self.0
    }
}

impl From<Notice> for Fault {
    fn from(notice: Notice) -> Fault {
        Fault(Box::new(notice), None)
    }
}

impl From<Fault> for Notice {
    fn from(fault: Fault) -> Notice {
        *fault.0
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Fault {}

pub(crate) const CHATTERING_EN: &str = "A formula with sign, if, abs, min or max reached its switching surface, and on both sides of it the motion is driven back: the \
    machine would switch infinitely often. Physically this is sticking (a body held by dry friction) or an ideal relay without hysteresis; sign(v) alone \
    cannot describe it. Use the dry friction element, which has a sticking state with a bounded reaction, or give the relay hysteresis or a delay.";
pub(crate) const CHATTERING_RU: &str = "Формула с sign, if, abs, min или max вышла на поверхность переключения, и с обеих сторон движение направлено обратно к ней: машина \
    переключалась бы бесконечно часто. Физически это залипание (тело удерживается сухим трением) или идеальное реле без гистерезиса; одна функция sign(v) \
    этого не описывает. Примените элемент сухого трения, у которого есть состояние залипания с ограниченной реакцией, либо задайте реле гистерезис или \
    запаздывание.";
pub(crate) const ACCUMULATION_EN: &str = "Switches follow one another at intervals that shrink to nothing (a ball whose rebound is written with if, a relay spiralling into \
    its centre). After the accumulation point the model gives no motion; the impacts of [stops] are followed to their limit. Stop the run before it, or describe the contact by a spring with damping or by an \
    element with a resting state.";
pub(crate) const ACCUMULATION_RU: &str = "Переключения следуют через промежутки, стремящиеся к нулю (шар, отскок которого записан через if, реле, входящее по спирали в центр). После \
    точки сгущения модель не определяет движения; удары упоров [stops] прослеживаются до предела. Остановите расчёт раньше или опишите контакт пружиной с демпфером либо элементом, имеющим состояние покоя.";
pub(crate) const UNDERFLOW_EN: &str = "The step needed for the tolerance is below the resolution of time: the motion runs into a singularity (a force that grows without \
    bound, a distance that becomes zero, a mass matrix that loses rank, a square root at zero).";
pub(crate) const UNDERFLOW_RU: &str = "Шаг, нужный для заданной точности, меньше разрешения времени: движение приходит в особую точку (неограниченно растущая сила, расстояние, \
    обращающееся в нуль, вырождение матрицы масс, корень в нуле).";
pub(crate) const FINITE_EN: &str = "A value of the motion became infinite or undefined.";
pub(crate) const FINITE_RU: &str = "Одна из величин стала бесконечной или неопределённой.";
pub(crate) const MEMORY_EN: &str = "Times asked for x columns x 8 bytes is more than the limit. Ask for fewer times or outputs.";
pub(crate) const MEMORY_RU: &str =
    "Число моментов времени x число столбцов x 8 байт превышает предел. Запросите меньше моментов времени или величин.";
pub(crate) const OPTION_EN: &str = concat!(
    "An option of the study has a value that means nothing: a tolerance outside ",
    words::finest_tolerance!(),
    " ... ",
    words::coarsest_tolerance!(),
    ", an end before the start, a grid step that is not positive."
);
pub(crate) const OPTION_RU: &str = concat!(
    "Параметр расчёта имеет бессмысленное значение: допустимая погрешность вне ",
    words::finest_tolerance!(),
    " ... ",
    words::coarsest_tolerance!(),
    ", конец раньше начала, неположительный шаг сетки."
);
pub(crate) const NEWTON_EN: &str = "From no guess did Newton's method reach a state in which all generalized forces vanish. There may be no equilibrium, or the guesses are far from it.";
pub(crate) const NEWTON_RU: &str = "Ни из одного начального приближения метод Ньютона не пришёл к состоянию, где все обобщённые силы равны нулю. Равновесия может не быть, или приближения далеки от него.";
pub(crate) const NEUTRAL_EN: &str =
    "The stiffness matrix is singular: along some direction the machine moves freely, so equilibria are not isolated.";
pub(crate) const NEUTRAL_RU: &str =
    "Матрица жёсткости вырождена: вдоль некоторого направления машина движется свободно, и положения равновесия не изолированы.";
pub(crate) const OUTPUT_EN: &str =
    "The study asks for an output that the model does not define. Coordinates and rates are always available by name.";
pub(crate) const OUTPUT_RU: &str = "Расчёт запрашивает величину, которой нет в модели. Координаты и скорости всегда доступны по имени.";

pub(crate) const NOT_LINEAR_EN: &str = "The study transient solves M q'' + B q' + C q = f(t) in closed form; the coordinates and rates may enter the forces only to the first \
    power, and M must not depend on the position. The message shows the first term that does. Nothing is linearised silently: write the model for small \
    motions (x = l*phi instead of l*sin(phi)), or use the study simulate.";
pub(crate) const NOT_LINEAR_RU: &str = "Расчёт transient решает M q'' + B q' + C q = f(t) в замкнутой форме; координаты и скорости могут входить в силы только в первой степени, а M не \
    должна зависеть от положения. В сообщении показан первый член, где это не так. Молча ничего не линеаризуется: составьте модель для малых движений \
    (x = l*phi вместо l*sin(phi)) или примените расчёт simulate.";
pub(crate) const VARYING_EN: &str = "A mass, a damping or a stiffness is a formula of time (parametric excitation, a rotating frame with unequal stiffnesses). Such systems have no closed \
    form. A change at the switches of phases is allowed.";
pub(crate) const VARYING_RU: &str = "Масса, сопротивление или жёсткость — функция времени (параметрическое возбуждение, вращающаяся система с неравными жёсткостями). Замкнутого решения у \
    таких систем нет. Изменение при переключении этапов допустимо.";
pub(crate) const NOTHING_EN: &str = "Modes and responses are those of coordinates, and the model has none: its bodies stand where the file places them. Wrong: `strutt modes` of beams on \
    supports. Right: `strutt statics`, or [coordinates] by which the bodies move.";
pub(crate) const NOTHING_RU: &str = "Собственные формы и отклики относятся к координатам, а в модели их нет: тела стоят там, где их поместил файл. Неверно: `strutt modes` для балок на опорах. \
    Верно: `strutt statics` либо [coordinates], через которые тела движутся.";
pub(crate) const OUTSIDE_EN: &str = "Least and greatest values are found along the whole motion, rows are single places of it: a row beyond them means that one of both belongs to another \
    quantity or motion. It is no fault of the model; do not use the numbers, and report the file. Wrong: the result of this run. Right: a version of strutt that gives both alike.";
pub(crate) const OUTSIDE_RU: &str = "Наименьшее и наибольшее значения ищутся вдоль всего движения, строки — отдельные его места: строка вне этих пределов означает, что одно из двух относится \
    к другой величине или движению. Модель в этом не виновата; не пользуйтесь числами и сообщите о файле. Неверно: результат этого запуска. Верно: версия strutt, в которой то и \
    другое согласуется.";
pub(crate) const OVERFLOW_EN: &str = "A result is infinite or undefined where no infinity is meant. Parameters of extreme size overflow: a mass of 1e300 kg beside one of 1e-300 kg, a \
    growing motion followed for too long. Check the units of the parameters. Wrong: m = 1e300 kg. Right: numbers that a machine can have.";
pub(crate) const OVERFLOW_RU: &str = "Результат бесконечен или не определён там, где бесконечности быть не может. Параметры крайней величины вызывают переполнение: масса 1e300 кг \
    рядом с массой 1e-300 кг, слишком долго прослеженное нарастающее движение. Проверьте единицы параметров. Неверно: m = 1e300 kg. Верно: числа, возможные \
    для машины.";
pub(crate) const REACTION_EN: &str = "The study `response` finds the amplitudes of reactions from the equations of motion and the balances of bodies, linear in small motions. Dry friction and \
    contacts that are open at the place of rest have no part in these, and their forces have no amplitude; and a unit load on a coordinate (load = \"x\") acts at no point, so that reactions in \
    directions without a coordinate do not follow. Right: an output over a pin, rod, support; a load that is a force of the file.";
pub(crate) const REACTION_RU: &str = "Расчёт `response` находит амплитуды реакций из уравнений движения и равновесия тел, линейных в малых движениях. Сухое трение и контакты, разомкнутые в положении равновесия, \
    в них не входят, и амплитуды их сил не существуют; единичная нагрузка по координате (load = \"x\") не приложена ни к какой точке, поэтому реакции в направлениях без \
    координаты из неё не следуют. Верно: величина с реакцией шарнира, стержня, опоры; нагрузка – сила из файла.";
pub(crate) const PERIODIC_EN: &str = "The study `response` gives the steady oscillation under periodic loads. Time may stand in sines and cosines of p t + d, also inside sign, abs, \
    min, max, if, roots and powers; the frequencies within one such formula must have whole ratios. Wrong: F*exp(-a*t), F*sin(p*t^2). Right: F*sign(sin(p*t)).";
pub(crate) const PERIODIC_RU: &str = "Расчёт `response` находит установившиеся колебания при периодических нагрузках. Время может входить в синусы и косинусы от p t + d, в том \
    числе внутри sign, abs, min, max, if, корней и степеней; частоты внутри одной такой формулы должны относиться как целые числа. Неверно: F*exp(-a*t), \
    F*sin(p*t^2). Верно: F*sign(sin(p*t)).";
pub(crate) const LOAD_EN: &str = "Closed forms exist for loads made of constants, powers of t, sines and cosines of p t + d, exponentials of t, and products of these. A run-up \
    sin(e*t^2/2), an amplitude like 1/(1 + t), or a switch at instants that follow from a sine are not of this kind. Within a phase the frequency must be \
    constant; another phase may have another one.";
pub(crate) const LOAD_RU: &str = "Замкнутое решение есть для нагрузок из постоянных, степеней t, синусов и косинусов от p t + d, экспонент и их произведений. Разгон sin(e*t^2/2), \
    амплитуда вида 1/(1 + t) и переключения по знаку синуса к ним не относятся. В пределах этапа частота должна быть постоянной; на другом этапе она \
    может быть другой.";
pub(crate) const CONNECTED_EN: &str = "Pins, rods, stops, dry friction and motors keep reactions as unknowns beside the coordinates. The closed form is found for independent coordinates: \
    place the bodies by formulas of these (origin = [\"0\", \"l*phi\"]), or use the study simulate.";
pub(crate) const CONNECTED_RU: &str = "При шарнирах, стержнях, упорах, сухом трении и двигателях неизвестными, кроме координат, остаются реакции. Замкнутое решение находится для независимых \
    координат: задайте через них положения тел (origin = [\"0\", \"l*phi\"]) или примените расчёт simulate.";
pub(crate) const NOWHERE_EN: &str = "Small motions are motions about an equilibrium under the mean loads. From the start of the motion none was found, or the stiffness there is singular \
    (a free direction). The study equilibrium shows what there is.";
pub(crate) const NOWHERE_RU: &str = "Малые движения — это движения около равновесия при средних нагрузках. От начала движения оно не найдено, или матрица жёсткости в нём вырождена \
    (свободное направление). Расчёт equilibrium покажет, какие положения равновесия есть.";
pub(crate) const MASSLESS_EN: &str =
    "Some change of the coordinates moves no mass, so its acceleration is undefined. Give it an inertia or remove the coordinate.";
pub(crate) const MASSLESS_RU: &str =
    "При некотором изменении координат масса не движется, и ускорение не определено. Придайте инерцию или уберите координату.";
pub(crate) const NAME_EN: &str = "A study names a load, a parameter or an output that the model does not have, or a parameter that is given by a formula and cannot be changed by itself.";
pub(crate) const NAME_RU: &str = "В расчёте названа нагрузка, параметр или величина, которых нет в модели, либо параметр, заданный формулой: менять его отдельно нельзя.";
pub(crate) const INERTIA_EN: &str = "The mass matrix is not positive definite at the equilibrium: some motion there moves no mass. Natural frequencies do not exist. Give the body a mass or an inertia, or take the coordinate out.";
pub(crate) const INERTIA_RU: &str = "Матрица масс в положении равновесия не положительно определена: некоторое движение не перемещает массы. Собственных частот нет. Задайте массу или момент инерции либо уберите координату.";
pub(crate) const EXCITES_EN: &str = "A frequency response needs a harmonic load: a force, a torque or a motion of a base of the form A sin(p*t) or A cos(p*t), an unbalance on a shaft of prescribed speed, or a unit load on a coordinate (load = \"x\").";
pub(crate) const EXCITES_RU: &str = "Для частотной характеристики нужна гармоническая нагрузка: сила, момент или движение основания вида A sin(p*t) или A cos(p*t), дебаланс на валу с заданной скоростью либо единичная нагрузка по координате (load = \"x\").";
pub(crate) const FREQUENCY_EN: &str = "The response is taken over the frequency of the load, which one parameter of the model must set, in proportion. Several parameters do, or the one that is named does not. Name it with `over`.";
pub(crate) const FREQUENCY_RU: &str = "Отклик строится по частоте нагрузки; её должен пропорционально задавать один параметр модели. Таких параметров несколько, либо указанный её не задаёт. Укажите его ключом `over`.";
pub(crate) const RANGE_EN: &str = "A range of frequencies ascends and is not negative; with logarithmic axes it begins above zero.";
pub(crate) const RANGE_RU: &str =
    "Границы диапазона частот возрастают и неотрицательны; с логарифмическими осями диапазон начинается выше нуля.";
pub(crate) const DRIVEN_EN: &str = "Natural oscillations are motions about rest. A drive that prescribes the motion of a coordinate leaves no rest to oscillate about; write the prescribed motion as a formula of t in place of the coordinate.";
pub(crate) const DRIVEN_RU: &str = "Собственные колебания происходят около покоя. Привод, задающий движение координаты, покоя не оставляет; запишите заданное движение формулой от t вместо координаты.";
pub(crate) const UNKNOWN_EN: &str = "The parameters in [unknowns] are found so that the start is a place of rest. The equations of statics have no solution for them (a force stays unbalanced that no unknown can balance), or do not decide them (changing them changes no force).";
pub(crate) const UNKNOWN_RU: &str = "Параметры из [unknowns] находятся так, чтобы начальное положение было положением равновесия. Уравнения статики для них несовместны (остаётся сила, которую ни одно неизвестное не уравновешивает) либо их не определяют (их изменение не меняет сил).";

pub(crate) const STEPS_EN: &str = "The step follows the quickest part of the motion, even when that part has died out (a stiff system: the step is bounded by the \
    fastest decay, not by the accuracy). After some ten thousand steps the pace shows that more than 1e10 would be needed, hours to days.";
pub(crate) const STEPS_RU: &str = "Шаг определяется самой быстрой частью движения, даже если она уже затухла (жёсткая система: шаг ограничен самым быстрым \
    затуханием, а не точностью). После десятка тысяч шагов видно, что их потребуется более 1e10, то есть часы и дни.";

impl From<algebra::Trouble> for Fault {
    fn from(trouble: algebra::Trouble) -> Fault {
        structures::matrices::told(trouble).into()
    }
}

impl Fault {
    /// From its words.
    pub fn new(message: Message) -> Fault {
        Fault::from(Notice::from(message))
    }

    /// The same, about an expression of the equations.
    pub fn about(mut self, expression: Option<Expr>) -> Fault {
        self.1 = expression;
        self
    }

    /// The expression of the equations that failed, for printing in the user's symbols, when it is known.
    pub fn expression(&self) -> Option<Expr> {
        self.1
    }

    /// The same, with the configuration in which it happened.
    pub(crate) fn in_configuration(mut self, places: &Text) -> Fault {
        self.0.what = Text::new(format!("{}, at {}", self.0.what.en, places.en), format!("{}, при {}", self.0.what.ru, places.ru));
        self
    }

    /// The same, with the instant at which it happened.
    pub(crate) fn during(mut self, t: f64) -> Fault {
        let n = number(t);
        // some name their instant themselves
        if self.what.en.contains(&format!("at t = {} s", n.en)) {
            return self;
        }
        self.0.what = Text::new(format!("{}, at t = {} s", self.what.en, n.en), format!("{}, при t = {} с", self.what.ru, n.ru));
        self
    }

    /// More steps than anybody waits for; `name` changes fastest.
    pub fn too_many_steps(name: &Text, t: f64, step: f64, needed: f64) -> Fault {
        let (t, step, needed) = (number(t), rounded(step), rounded(needed));
        Fault::new(Message {
            code: "S010",
            what: Text::new(
                format!("at t = {} s the steps are {} s long: the run would take about {} of them", t.en, step.en, needed.en),
                format!("при t = {} с шаг равен {} с: расчёту понадобится около {} шагов", t.ru, step.ru, needed.ru),
            ),
            why: Text::new(
                format!(
                    "a fast oscillation or a strongly damped motion sets the step, `{}` most of all; beside it the run is very long",
                    name.en
                ),
                format!(
                    "шаг задаёт быстрое колебание или сильно задемпфированное движение, прежде всего `{}`; расчёт для него слишком долог",
                    name.ru
                ),
            ),
            help: Text::new(
                "end the run earlier, or leave the fast part out: a rigid connection for a stiff spring, a rate for a strongly damped coordinate",
                "закончите расчёт раньше или исключите быстрое движение: жёсткая связь вместо жёсткой пружины, меньшее демпфирование",
            ),
        })
    }

    /// The number of steps grows exponentially; `name` changes fastest.
    pub fn ever_more_steps(name: &Text, t: f64, took: f64, needed: f64) -> Fault {
        let (t, took, needed) = (number(t), rounded(took), rounded(needed));
        Fault::new(Message {
            code: "S010",
            what: Text::new(
                format!(
                    "at t = {} s the number of steps doubles every {} s: the run would take about {} of them",
                    t.en, took.en, needed.en
                ),
                format!("при t = {} с число шагов удваивается каждые {} с: расчёту понадобится около {} шагов", t.ru, took.ru, needed.ru),
            ),
            why: Text::new(
                format!(
                    "switches follow one another ever faster (a force that follows the sign of a coordinate has no place of rest at its zero), or an oscillation does, `{}` most of all",
                    name.en
                ),
                format!(
                    "переключения следуют друг за другом всё быстрее (сила, зависящая от знака координаты, не имеет положения покоя в её нуле) или ускоряется колебание, прежде всего `{}`",
                    name.ru
                ),
            ),
            help: Text::new(
                "end the run earlier, or use an element with a resting state (dry friction, contact spring with damping)",
                "закончите расчёт раньше или примените элемент с состоянием покоя (сухое трение, контактная пружина с демпфером)",
            ),
        })
    }

    /// The flow on both sides of a switch points back to it.
    pub fn chattering(guard: &Text, t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S001",
            what: Text::new(
                format!("the switch `{}` chatters at t = {} s", guard.en, n.en),
                format!("переключатель `{}` дребезжит при t = {} с", guard.ru, n.ru),
            ),
            why: Text::new(
                "on both sides of the switch the motion is driven back to it: a body held by dry friction, or a relay without hysteresis",
                "с обеих сторон от переключения движение направлено обратно к нему: тело удерживается сухим трением или реле без гистерезиса",
            ),
            help: Text::new(
                "describe friction by a dry friction element, which can stick, instead of sign(velocity); give a relay hysteresis",
                "опишите трение элементом сухого трения (он умеет залипать) вместо sign(скорость); задайте реле гистерезис",
            ),
        })
    }

    /// Switches at intervals that shrink to nothing.
    pub fn accumulation(guard: &Text, t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S002",
            what: Text::new(
                format!("switches of `{}` accumulate at t = {} s", guard.en, n.en),
                format!("переключения `{}` сгущаются при t = {} с", guard.ru, n.ru),
            ),
            why: Text::new(
                "the intervals between switches shrink to nothing, and the model says nothing about the motion after that instant",
                "промежутки между переключениями стремятся к нулю, и модель не определяет движения после этого момента",
            ),
            help: Text::new(
                "end the run before this instant, or use an element with a resting state (dry friction, contact spring with damping)",
                "закончите расчёт раньше или примените элемент с состоянием покоя (сухое трение, контактная пружина с демпфером)",
            ),
        })
    }

    /// Whether coefficients of that order exceed the range of numbers; a lower order may not.
    pub(crate) fn is_overflow(&self) -> bool {
        [program::NOT_FINITE, program::NO_SERIES].contains(&self.code)
    }

    /// The step fell below the resolution of time.
    pub fn underflow(state: &Text, t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: codes::UNDERFLOW,
            what: Text::new(
                format!("the step vanishes at t = {} s; `{}` changes fastest", n.en, state.en),
                format!("шаг стал исчезающе малым при t = {} с; быстрее всего меняется `{}`", n.ru, state.ru),
            ),
            why: Text::new(
                "the motion runs into a singularity: a force grows without bound, a distance or the mass matrix degenerates",
                "движение приходит в особую точку: сила растёт неограниченно, расстояние обращается в нуль или матрица масс вырождается",
            ),
            help: Text::new(
                "check the formulas near this state (division, sqrt, log, a zero length); end the run earlier if the motion really ends here",
                "проверьте формулы вблизи этого состояния (деление, sqrt, log, нулевая длина); если движение здесь действительно кончается, завершите расчёт раньше",
            ),
        })
    }

    /// A value is infinite or undefined.
    pub fn not_finite(name: &Text, t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S004",
            what: Text::new(
                format!("`{}` is not a finite number at t = {} s", name.en, n.en),
                format!("`{}` не является конечным числом при t = {} с", name.ru, n.ru),
            ),
            why: Text::new(
                "a formula was taken outside its domain, or a value overflowed",
                "формула вышла за область определения, или величина переполнилась",
            ),
            help: Text::new(
                "check start values and formulas (division by zero, sqrt or log of a negative number)",
                "проверьте начальные значения и формулы (деление на нуль, sqrt или log отрицательного числа)",
            ),
        })
    }

    /// An option without meaning.
    pub fn option(what: Text, help: Text) -> Fault {
        Fault::new(Message {
            code: "S006",
            what,
            why: Text::new("the study cannot be run with this value", "расчёт с таким значением невозможен"),
            help,
        })
    }

    /// The system offers no statics.
    pub fn no_statics() -> Fault {
        Fault::option(
            Text::new("this system has no equations of rest", "у этой системы нет уравнений покоя"),
            Text::new("run `simulate` instead", "используйте расчёт движения `simulate`"),
        )
    }

    /// An output that does not exist.
    pub fn unknown_output(name: &str, known: &[String]) -> Fault {
        let list = known.join(", ");
        Fault::new(Message {
            code: "S009",
            what: Text::new(format!("there is no output `{name}`"), format!("нет выходной величины `{name}`")),
            why: Text::new(format!("the model offers: {list}"), format!("в модели есть: {list}")),
            help: Text::new("correct the name, or define it in [outputs]", "исправьте имя или определите величину в [outputs]"),
        })
    }

    /// A table larger than the limit; sizes in bytes.
    pub fn memory(rows: f64, columns: usize, limit: f64) -> Fault {
        let need = number((rows * columns as f64 * 8.0 / 1e9 * 10.0).round() / 10.0);
        let limit = number((limit / 1e9 * 10.0).round() / 10.0);
        Fault::new(Message {
            code: "S005",
            what: Text::new(
                format!("the result would take {} GB, the limit is {} GB", need.en, limit.en),
                format!("результат занял бы {} ГБ, предел {} ГБ", need.ru, limit.ru),
            ),
            why: Text::new(
                format!("{rows:.0} times x {columns} columns x 8 bytes"),
                format!("{rows:.0} моментов x {columns} столбцов x 8 байт"),
            ),
            help: Text::new(
                "ask for fewer times (a larger `every`) or fewer outputs",
                "запросите меньше моментов (больший шаг `every`) или меньше величин",
            ),
        })
    }

    /// Statics of a model without reactions.
    pub fn no_reactions() -> Fault {
        Fault::new(Message {
            code: "S060",
            what: Text::new("the model has no reactions to find", "в модели нет искомых реакций"),
            why: Text::new("nothing connects the bodies or holds them", "ничто не соединяет и не удерживает тела"),
            help: Text::new("name supports in [supports] and joints in [pins]", "задайте опоры в [supports] и шарниры в [pins]"),
        })
    }

    /// Equilibrium that needs a rope to push.
    pub fn rope_pushes(name: &str, value: f64, unit: &str) -> Fault {
        Fault::wrong_side((name, value, unit), Text::new("a rope cannot push", "нить не может толкать"))
    }

    /// Equilibrium that needs a contact to pull.
    pub fn contact_pulls(name: &str, value: f64, unit: &str) -> Fault {
        Fault::wrong_side((name, value, unit), Text::new("a contact cannot pull", "контакт не может тянуть"))
    }

    fn wrong_side((name, value, unit): (&str, f64, &str), why: Text) -> Fault {
        let (n, unit) = (rounded(value), Text::unit(unit));
        Fault::new(Message {
            code: "S062",
            what: Text::new(
                format!("equilibrium needs {name} = {} {}", n.en, unit.en),
                format!("для равновесия требуется {name} = {} {}", n.ru, unit.ru),
            ),
            why,
            help: Text::new(
                "the structure does not rest like this: change the loads or the place of the connection, or use a rod, which also pushes",
                "в таком положении конструкция не покоится: измените нагрузки или место связи либо примените стержень, который может и толкать",
            ),
        })
    }

    /// A free motion in which the loads do work.
    pub fn sets_itself_in_motion(free: &Text) -> Fault {
        let list = |words: &str| if words.is_empty() { "-".to_owned() } else { words.to_owned() };
        Fault::new(Message {
            code: "S061",
            what: Text::new("the loads set the structure in motion", "нагрузки приводят конструкцию в движение"),
            why: Text::new(format!("nothing prevents: {}", list(&free.en)), format!("ничто не препятствует: {}", list(&free.ru))),
            help: Text::new("add a support or a balancing load", "добавьте опору или уравновешивающую нагрузку"),
        })
    }
}

pub(crate) const NO_REACTIONS_EN: &str =
    "Statics finds the reactions of supports, pins, rods, ropes and other connections; the model has none. Name what holds the bodies.";
pub(crate) const NO_REACTIONS_RU: &str =
    "Статика определяет реакции опор, шарниров, стержней, нитей и других связей; в модели их нет. Назовите, что удерживает тела.";
pub(crate) const WRONG_SIDE_EN: &str = "The balance of forces asks a rope to push, or a one-sided contact to pull. Neither can: the structure does not rest in this \
     position under these loads. Turn the load, move the connection, or replace the rope by a rod.";
pub(crate) const WRONG_SIDE_RU: &str = "Уравнения равновесия требуют, чтобы нить толкала или односторонний контакт тянул. Этого быть не может: под такими нагрузками \
     конструкция в этом положении не покоится. Измените нагрузку, место связи или замените нить стержнем.";
pub(crate) const UNREST_EN: &str = "Some displacement is prevented by nothing, and the loads do work in it: equilibrium is impossible. The message lists the \
     displacements that belong to it with their shares. Add a support, or a load that balances it.";
pub(crate) const UNREST_RU: &str = "Некоторому перемещению ничто не препятствует, и нагрузки совершают на нём работу: равновесие невозможно. В сообщении \
     перечислены входящие в него перемещения и их доли. Добавьте опору или уравновешивающую нагрузку.";

/// A result, which must be a number.
///
/// *Errors*: S077 when it is infinite or undefined.
pub fn finite(value: f64, name: &str) -> Result<f64, Fault> {
    if value.is_finite() { Ok(value) } else { Err(no_value(name)) }
}

/// S084: modes of what has no coordinates.
pub fn nothing_moves() -> Fault {
    Fault::new(Message {
        code: "S084",
        what: Text::new("nothing can move: the model has no coordinates", "двигаться нечему: в модели нет координат"),
        why: Text::new(
            "modes, responses and motions are those of coordinates",
            "собственные формы, отклики и движения относятся к координатам",
        ),
        help: Text::new(
            "`strutt statics` finds what holds the bodies; for a motion, write [coordinates] and place the bodies by them",
            "`strutt statics` находит, что удерживает тела; для движения задайте [coordinates] и положения тел через них",
        ),
    })
}

/// S083: rows outside the least and greatest values.
pub fn outside_extremes(name: &str) -> Fault {
    Fault::new(Message {
        code: "S083",
        what: Text::new(
            format!("the least and greatest values of {name} leave out a row of its table"),
            format!("наименьшее и наибольшее значения {name} не охватывают строк её таблицы"),
        ),
        why: Text::new(
            "both come from one motion in two ways, so one of them is wrong",
            "то и другое получено из одного движения двумя способами, значит, одно из них неверно",
        ),
        help: Text::new(
            "do not use these numbers; this is a fault of strutt, please report it with the file",
            "не пользуйтесь этими числами; это ошибка strutt, сообщите о ней, приложив файл",
        ),
    })
}

/// S077: a result without a finite value.
pub fn no_value(name: &str) -> Fault {
    Fault::new(Message {
        code: "S077",
        what: Text::new(format!("{name} has no finite value"), format!("у величины {name} нет конечного значения")),
        why: Text::new(
            "numbers of extreme size overflow, or a motion grows beyond all bounds",
            "числа крайней величины вызывают переполнение, либо движение неограниченно нарастает",
        ),
        help: Text::new(
            "check the units and sizes of the parameters, or shorten the time",
            "проверьте единицы и величину параметров или сократите время",
        ),
    })
}
