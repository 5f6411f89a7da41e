//! What can go wrong in a study: each fault says what, why and how to cure it, in both languages.

use std::fmt;

use symbolic::{Expr, Text};

use crate::numerics::trouble;

/// A study cannot go on. Results found before the fault are kept beside it. Boxed, so that results stay small.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault(Box<Message>, Option<Expr>);

impl std::ops::Deref for Fault {
    type Target = Message;
    fn deref(&self) -> &Message {
        &self.0
    }
}

/// The words of a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// Code for `strutt explain`, `S001`.
    pub code: &'static str,
    /// What is wrong and where.
    pub what: Text,
    /// The likely physical cause.
    pub why: Text,
    /// The cure.
    pub help: Text,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error[{}]: {}\n  why: {}\n  help: {}", self.code, self.what.en, self.why.en, self.help.en)
    }
}

impl std::error::Error for Fault {}

/// Code, title and explanation of every fault of this crate, for `strutt explain`.
pub const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "S001",
        en: ("switch without a direction (chattering)", CHATTERING_EN),
        ru: ("переключение без направления (дребезг)", CHATTERING_RU),
    },
    Explanation {
        code: "S002", en: ("switches accumulate", ACCUMULATION_EN), ru: ("переключения сгущаются", ACCUMULATION_RU)
    },
    Explanation { code: "S003", en: ("step underflow", UNDERFLOW_EN), ru: ("шаг стал исчезающе малым", UNDERFLOW_RU) },
    Explanation { code: "S004", en: ("not a finite number", FINITE_EN), ru: ("не конечное число", FINITE_RU) },
    Explanation {
        code: "S005", en: ("result larger than memory", MEMORY_EN), ru: ("результат не помещается в память", MEMORY_RU)
    },
    Explanation {
        code: "S006", en: ("unusable option of a study", OPTION_EN), ru: ("недопустимый параметр расчёта", OPTION_RU)
    },
    Explanation {
        code: "S007", en: ("Newton's method found no equilibrium", NEWTON_EN), ru: ("равновесие не найдено", NEWTON_RU)
    },
    Explanation {
        code: "S008",
        en: ("neutral equilibrium or free motion", NEUTRAL_EN),
        ru: ("безразличное равновесие или свободное движение", NEUTRAL_RU),
    },
    Explanation {
        code: "S009", en: ("unknown output", OUTPUT_EN), ru: ("неизвестная выходная величина", OUTPUT_RU)
    },
    Explanation {
        code: "S011",
        en: ("contact or friction without an admissible state", NO_STATE_EN),
        ru: ("контакт или трение без допустимого состояния", NO_STATE_RU),
    },
    Explanation {
        code: "S012", en: ("a contact starts penetrated", PENETRATES_EN), ru: ("контакт начинается с внедрения", PENETRATES_RU)
    },
    Explanation { code: "S013", en: ("connections come apart", APART_EN), ru: ("связи расходятся", APART_RU) },
    Explanation {
        code: "S014", en: ("impact without a single solution", IMPACT_EN), ru: ("удар без однозначного решения", IMPACT_RU)
    },
    Explanation {
        code: "S015",
        en: ("start values that do not fit the connections", START_EN),
        ru: ("начальные значения не согласуются со связями", START_RU),
    },
    Explanation { code: "S016", en: ("loop that cannot close", LOOP_EN), ru: ("незамыкаемый контур", LOOP_RU) },
    Explanation {
        code: "S017", en: ("contradictory conditions", CONTRADICTION_EN), ru: ("противоречивые условия", CONTRADICTION_RU)
    },
    Explanation { code: "S018", en: ("singular configuration", SINGULAR_EN), ru: ("особое положение", SINGULAR_RU) },
    Explanation {
        code: "S019", en: ("reaction that is not unique", OPEN_EN), ru: ("неединственная реакция", OPEN_RU)
    },
    Explanation {
        code: "S010", en: ("more steps than anybody waits for", STEPS_EN), ru: ("слишком много шагов", STEPS_RU)
    },
    crate::studies::explain::NO_RETURN,
    crate::studies::explain::NO_REGIME,
    crate::studies::explain::DRIVEN,
    crate::studies::explain::NO_PASSAGE,
    crate::studies::explain::NOT_AT_REST,
    crate::studies::explain::NO_SUCH_PERIOD,
    crate::studies::explain::NOT_TURNING,
    crate::studies::explain::NO_ENERGY,
    crate::studies::explain::NO_DRIVE,
    crate::studies::explain::DEAD_POINT,
    Explanation {
        code: "S021",
        en: ("mass matrix not positive definite", trouble::MASS_EN),
        ru: ("матрица масс не положительно определена", trouble::MASS_RU),
    },
    Explanation {
        code: "S022",
        en: ("stiffness matrix not positive definite", trouble::SINGULAR_EN),
        ru: ("матрица жёсткости не положительно определена", trouble::SINGULAR_RU),
    },
    Explanation {
        code: "S023",
        en: ("eigenvalues did not converge", trouble::CONVERGENCE_EN),
        ru: ("собственные значения не сошлись", trouble::CONVERGENCE_RU),
    },
    Explanation {
        code: "S024",
        en: ("matrix with an undefined entry", trouble::MALFORMED_EN),
        ru: ("матрица с неопределённым элементом", trouble::MALFORMED_RU),
    },
    Explanation {
        code: "S030",
        en: ("no closed form: not linear", NOT_LINEAR_EN),
        ru: ("нет замкнутого решения: нелинейность", NOT_LINEAR_RU),
    },
    Explanation {
        code: "S031",
        en: ("no closed form: coefficients change with time", VARYING_EN),
        ru: ("нет замкнутого решения: переменные коэффициенты", VARYING_RU),
    },
    Explanation {
        code: "S032", en: ("no closed form: the load", LOAD_EN), ru: ("нет замкнутого решения: вид нагрузки", LOAD_RU)
    },
    Explanation {
        code: "S033", en: ("singular mass matrix", MASSLESS_EN), ru: ("вырожденная матрица масс", MASSLESS_RU)
    },
    Explanation {
        code: "S034", en: ("no closed form: connections", CONNECTED_EN), ru: ("нет замкнутого решения: связи", CONNECTED_RU)
    },
    Explanation {
        code: "S030", en: ("unknown load or parameter", NAME_EN), ru: ("неизвестная нагрузка или параметр", NAME_RU)
    },
    Explanation { code: "S031", en: ("no inertia here", INERTIA_EN), ru: ("нет инерции", INERTIA_RU) },
    Explanation { code: "S032", en: ("nothing excites", EXCITES_EN), ru: ("нет возбуждения", EXCITES_RU) },
    Explanation { code: "S033", en: ("which frequency?", FREQUENCY_EN), ru: ("какая частота?", FREQUENCY_RU) },
    Explanation { code: "S034", en: ("range of frequencies", RANGE_EN), ru: ("диапазон частот", RANGE_RU) },
    Explanation {
        code: "S035", en: ("a drive and small motions", DRIVEN_EN), ru: ("привод и малые движения", DRIVEN_RU)
    },
    Explanation {
        code: "S036",
        en: ("statics do not give the unknown", UNKNOWN_EN),
        ru: ("неизвестное не определяется статикой", UNKNOWN_RU),
    },
];

/// One row of [`EXPLANATIONS`]: (title, body) in both languages.
#[derive(Clone, Copy, Debug)]
pub struct Explanation {
    /// Code, `S001`.
    pub code: &'static str,
    /// English title and body.
    pub en: (&'static str, &'static str),
    /// Russian title and body.
    pub ru: (&'static str, &'static str),
}

const NO_STATE_EN: &str = "Neither sticking nor sliding in any direction (neither closed nor open) agrees with the forces at this state. With friction on a computed \
    normal force this happens at large friction coefficients (Painlevé's paradox), or when the static limit is below the kinetic one. A rigid body has no \
    motion then; give the contact some compliance, or a smaller coefficient.";
const NO_STATE_RU: &str = "Ни залипание, ни скольжение в какую-либо сторону (ни замкнутый, ни разомкнутый контакт) не согласуется с силами в этом состоянии. При трении \
    от вычисляемой нормальной реакции это бывает при больших коэффициентах трения (парадокс Пенлеве) или когда предельное трение покоя меньше трения \
    скольжения. У абсолютно твёрдого тела движения тогда нет; задайте податливость контакта или меньший коэффициент.";
const PENETRATES_EN: &str = "The gap of a one-sided contact is negative at the start: the body stands inside the stop, or the rope is longer than its length. Move the start \
    or the contact.";
const PENETRATES_RU: &str = "В начале зазор одностороннего контакта отрицателен: тело находится внутри упора или нить длиннее своей длины. Измените начальное положение \
    или контакт.";
const APART_EN: &str = "After each step the state is moved back onto the conditions of the connections, by rounding only. Here no near state fulfils them: \
    the linkage has come to the end of its range, or a prescribed motion asks for a position that the lengths do not allow.";
const APART_RU: &str = "После каждого шага состояние возвращается на условия связей, в пределах округления. Здесь близкого состояния, удовлетворяющего им, нет: \
    механизм дошёл до конца области своих движений, или заданное движение требует положения, невозможного при данных длинах.";
const IMPACT_EN: &str = "Impulses follow from M dq' = F p and the rates after the impact. When two conditions hold the same motion their impulses are not unique; when \
    the body that is hit has no mass the rates are not.";
const IMPACT_RU: &str = "Импульсы находятся из M dq' = F p и скоростей после удара. Если два условия удерживают одно и то же движение, импульсы не единственны; если тело, \
    по которому приходится удар, не имеет массы, не единственны скорости.";
const START_EN: &str = "A machine with connections needs as many start values as it has degrees of freedom; the others follow. Values that are given are kept, so \
    redundant ones must agree with the connections to ten digits. The message prints the value that closes the loop when each given value is \
    released alone.";
const START_RU: &str = "Машине со связями нужно столько начальных значений, сколько у неё степеней свободы; остальные вычисляются. Заданные значения сохраняются, поэтому \
    лишние должны согласовываться со связями в десяти знаках. В сообщении указано значение, замыкающее контур, если освободить каждое из заданных \
    по отдельности.";
const LOOP_EN: &str = "From the given start and from guesses around it no configuration was found that fulfils all conditions. The message names the condition \
    that stays open and the smallest gap.";
const LOOP_RU: &str = "Ни из заданного начала, ни из приближений вокруг него не найдено положения, удовлетворяющего всем условиям. В сообщении указано незамкнутое условие \
    и наименьший зазор.";
const CONTRADICTION_EN: &str =
    "Conditions that act on the same motion must agree: a repeated one is left out with a note, a contradictory one is an error.";
const CONTRADICTION_RU: &str = "Условия, действующие на одно и то же движение, должны быть согласованы: повторяющее условие отбрасывается с примечанием, противоречивое - ошибка.";
const SINGULAR_EN: &str = "Conditions that are independent near this position depend on each other in it: a flat parallelogram, a toggle at its dead centre. The equations do \
    not decide which way the motion goes on. A linkage that passes such a position with speed is followed through it.";
const SINGULAR_RU: &str = "Условия, независимые вблизи этого положения, в нём самом зависимы: сложенный параллелограмм, рычаги в мёртвой точке. Уравнения не решают, как \
    продолжится движение. Механизм, проходящий такое положение со скоростью, рассчитывается насквозь.";
const OPEN_EN: &str = "Rigid bodies leave the shares of redundant connections open (a beam between two fixed pins, a shaft in three bearings): any shares with the right sum \
    satisfy all equations. Motion and the other reactions are right.";
const OPEN_RU: &str = "Для твёрдых тел доли лишних связей неопределимы (балка между двумя неподвижными шарнирами, вал на трёх опорах): уравнениям удовлетворяют любые доли с \
    нужной суммой. Движение и остальные реакции верны.";
const CHATTERING_EN: &str = "A formula with sign, if, abs, min or max reached its switching surface, and on both sides of it the motion is driven back: the \
    machine would switch infinitely often. Physically this is sticking (a body held by dry friction) or an ideal relay without hysteresis; sign(v) alone \
    cannot describe it. Use the dry friction element, which has a sticking state with a bounded reaction, or give the relay hysteresis or a delay.";
const CHATTERING_RU: &str = "Формула с sign, if, abs, min или max вышла на поверхность переключения, и с обеих сторон движение направлено обратно к ней: машина \
    переключалась бы бесконечно часто. Физически это залипание (тело удерживается сухим трением) или идеальное реле без гистерезиса; одна функция sign(v) \
    этого не описывает. Примените элемент сухого трения, у которого есть состояние залипания с ограниченной реакцией, либо задайте реле гистерезис или \
    запаздывание.";
const ACCUMULATION_EN: &str = "Switches follow one another at intervals that shrink to nothing (a bouncing ball coming to rest, a relay spiralling into its \
    centre). After the accumulation point the model gives no motion. Stop the run before it, or describe the contact by a spring with damping or by an \
    element with a resting state.";
const ACCUMULATION_RU: &str = "Переключения следуют через промежутки, стремящиеся к нулю (подскакивающий шар, реле, входящее по спирали в центр). После точки \
    сгущения модель не определяет движения. Остановите расчёт раньше или опишите контакт пружиной с демпфером либо элементом, имеющим состояние покоя.";
const UNDERFLOW_EN: &str = "The step needed for the tolerance is below the resolution of time: the motion runs into a singularity (a force that grows without \
    bound, a distance that becomes zero, a mass matrix that loses rank, a square root at zero).";
const UNDERFLOW_RU: &str = "Шаг, нужный для заданной точности, меньше разрешения времени: движение приходит в особую точку (неограниченно растущая сила, расстояние, \
    обращающееся в нуль, вырождение матрицы масс, корень в нуле).";
const FINITE_EN: &str = "A value of the motion became infinite or undefined.";
const FINITE_RU: &str = "Одна из величин стала бесконечной или неопределённой.";
const MEMORY_EN: &str = "Times asked for x columns x 8 bytes is more than the limit. Ask for fewer times or outputs.";
const MEMORY_RU: &str = "Число моментов времени x число столбцов x 8 байт превышает предел. Запросите меньше моментов времени или величин.";
const OPTION_EN: &str = "An option of the study has a value that means nothing: a tolerance outside 1e-15 ... 1e-3, an end before the start, a grid step that is not positive.";
const OPTION_RU: &str =
    "Параметр расчёта имеет бессмысленное значение: точность вне 1e-15 ... 1e-3, конец раньше начала, неположительный шаг сетки.";
const NEWTON_EN: &str = "From no guess did Newton's method reach a state in which all generalized forces vanish. There may be no equilibrium, or the guesses are far from it.";
const NEWTON_RU: &str = "Ни из одного начального приближения метод Ньютона не пришёл к состоянию, где все обобщённые силы равны нулю. Равновесия может не быть, или приближения далеки от него.";
const NEUTRAL_EN: &str = "The stiffness matrix is singular: along some direction the machine moves freely, so equilibria are not isolated.";
const NEUTRAL_RU: &str =
    "Матрица жёсткости вырождена: вдоль некоторого направления машина движется свободно, и положения равновесия не изолированы.";
const OUTPUT_EN: &str = "The study asks for an output that the model does not define. Coordinates and rates are always available by name.";
const OUTPUT_RU: &str = "Расчёт запрашивает величину, которой нет в модели. Координаты и скорости всегда доступны по имени.";

const NOT_LINEAR_EN: &str = "The study transient solves M q'' + B q' + C q = f(t) in closed form; the coordinates and rates may enter the forces only to the first \
    power, and M must not depend on the position. The message shows the first term that does. Nothing is linearised silently: write the model for small \
    motions (x = l*phi instead of l*sin(phi)), or use the study simulate.";
const NOT_LINEAR_RU: &str = "Расчёт transient решает M q'' + B q' + C q = f(t) в замкнутой форме; координаты и скорости могут входить в силы только в первой степени, а M не \
    должна зависеть от положения. В сообщении показан первый член, где это не так. Молча ничего не линеаризуется: составьте модель для малых движений \
    (x = l*phi вместо l*sin(phi)) или примените расчёт simulate.";
const VARYING_EN: &str = "A mass, a damping or a stiffness is a formula of time (parametric excitation, a rotating frame with unequal stiffnesses). Such systems have no closed \
    form. A change at the switches of phases is allowed.";
const VARYING_RU: &str = "Масса, сопротивление или жёсткость — функция времени (параметрическое возбуждение, вращающаяся система с неравными жёсткостями). Замкнутого решения у \
    таких систем нет. Изменение при переключении этапов допустимо.";
const LOAD_EN: &str = "Closed forms exist for loads made of constants, powers of t, sines and cosines of p t + d, exponentials of t, and products of these. A run-up \
    sin(e*t^2/2), an amplitude like 1/(1 + t), or a switch at instants that follow from a sine are not of this kind. Within a phase the frequency must be \
    constant; another phase may have another one.";
const LOAD_RU: &str = "Замкнутое решение есть для нагрузок из постоянных, степеней t, синусов и косинусов от p t + d, экспонент и их произведений. Разгон sin(e*t^2/2), \
    амплитуда вида 1/(1 + t) и переключения по знаку синуса к ним не относятся. В пределах этапа частота должна быть постоянной; на другом этапе она \
    может быть другой.";
const CONNECTED_EN: &str = "Pins, rods, stops, dry friction and motors keep reactions as unknowns beside the coordinates. The closed form is found for independent coordinates: \
    place the bodies by formulas of these (origin = [\"0\", \"l*phi\"]), or use the study simulate.";
const CONNECTED_RU: &str = "При шарнирах, стержнях, упорах, сухом трении и двигателях неизвестными, кроме координат, остаются реакции. Замкнутое решение находится для независимых \
    координат: задайте через них положения тел (origin = [\"0\", \"l*phi\"]) или примените расчёт simulate.";
const MASSLESS_EN: &str =
    "Some change of the coordinates moves no mass, so its acceleration is undefined. Give it an inertia or remove the coordinate.";
const MASSLESS_RU: &str =
    "При некотором изменении координат масса не движется, и ускорение не определено. Придайте инерцию или уберите координату.";
const NAME_EN: &str = "A study names a load, a parameter or an output that the model does not have, or a parameter that is given by a formula and cannot be changed by itself.";
const NAME_RU: &str = "В расчёте названа нагрузка, параметр или величина, которых нет в модели, либо параметр, заданный формулой: менять его отдельно нельзя.";
const INERTIA_EN: &str = "The mass matrix is not positive definite at the equilibrium: some motion there moves no mass. Natural frequencies do not exist. Give the body a mass or an inertia, or take the coordinate out.";
const INERTIA_RU: &str = "Матрица масс в положении равновесия не положительно определена: некоторое движение не перемещает массы. Собственных частот нет. Задайте массу или момент инерции либо уберите координату.";
const EXCITES_EN: &str = "A frequency response needs a harmonic load: a force, a torque or a motion of a base of the form A sin(p*t) or A cos(p*t), an unbalance on a shaft of prescribed speed, or a unit load on a coordinate (load = \"x\").";
const EXCITES_RU: &str = "Для частотной характеристики нужна гармоническая нагрузка: сила, момент или движение основания вида A sin(p*t) или A cos(p*t), дебаланс на валу с заданной скоростью либо единичная нагрузка по координате (load = \"x\").";
const FREQUENCY_EN: &str = "The response is taken over the frequency of the load, which one parameter of the model must set, in proportion. Several parameters do, or the one that is named does not. Name it with `over`.";
const FREQUENCY_RU: &str = "Отклик строится по частоте нагрузки; её должен пропорционально задавать один параметр модели. Таких параметров несколько, либо указанный её не задаёт. Укажите его ключом `over`.";
const RANGE_EN: &str = "A range of frequencies ascends and is not negative; with logarithmic axes it begins above zero.";
const RANGE_RU: &str = "Границы диапазона частот возрастают и неотрицательны; с логарифмическими осями диапазон начинается выше нуля.";
const DRIVEN_EN: &str = "Natural oscillations are motions about rest. A drive that prescribes the motion of a coordinate leaves no rest to oscillate about; write the prescribed motion as a formula of t in place of the coordinate.";
const DRIVEN_RU: &str = "Собственные колебания происходят около покоя. Привод, задающий движение координаты, покоя не оставляет; запишите заданное движение формулой от t вместо координаты.";
const UNKNOWN_EN: &str = "The parameters in [unknowns] are found so that the start is a place of rest. The equations of statics have no solution for them (a force stays unbalanced that no unknown can balance), or do not decide them (changing them changes no force).";
const UNKNOWN_RU: &str = "Параметры из [unknowns] находятся так, чтобы начальное положение было положением равновесия. Уравнения статики для них несовместны (остаётся сила, которую ни одно неизвестное не уравновешивает) либо их не определяют (их изменение не меняет сил).";

const STEPS_EN: &str = "The step follows the quickest part of the motion, even when that part has died out (a stiff system: the step is bounded by the \
    fastest decay, not by the accuracy). After some ten thousand steps the pace shows that more than 1e10 would be needed, hours to days.";
const STEPS_RU: &str = "Шаг определяется самой быстрой частью движения, даже если она уже затухла (жёсткая система: шаг ограничен самым быстрым \
    затуханием, а не точностью). После десятка тысяч шагов видно, что их потребуется более 1e10, то есть часы и дни.";

/// A number in both languages: decimal point and decimal comma.
pub(crate) fn number(value: f64) -> Text {
    let en = if value == 0.0 || (1e-4..1e6).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") };
    Text { ru: en.replace('.', ","), en }
}

/// Three digits, for estimates.
pub(crate) fn rounded(value: f64) -> Text {
    let short: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    number(short)
}

/// Ten digits: enough to type in again.
pub(crate) fn ten_digits(value: f64) -> Text {
    let short: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    number(short)
}

impl Fault {
    /// From its words.
    pub fn new(message: Message) -> Fault {
        Fault(Box::new(message), None)
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

    /// Neither side of a friction or contact agrees with the forces.
    pub fn no_contact_state(guard: &Text, t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S011",
            what: Text::new(
                format!("`{}` can neither stick nor slide, neither close nor open at t = {} s", guard.en, n.en),
                format!("`{}` не может ни залипнуть, ни скользить, ни замкнуться, ни разомкнуться при t = {} с", guard.ru, n.ru),
            ),
            why: Text::new(
                "every choice contradicts the forces that it leads to: too large a friction coefficient, a static limit below the kinetic one",
                "любой выбор противоречит силам, к которым он ведёт: слишком велик коэффициент трения, предел трения покоя ниже трения скольжения",
            ),
            help: Text::new(
                "reduce the coefficient of friction, raise the static limit, or make the contact compliant (spring with damping)",
                "уменьшите коэффициент трения, повысьте предел трения покоя или сделайте контакт податливым (пружина с демпфером)",
            ),
        })
    }

    /// Given start values that contradict the connections. `each` closes the loop alone, or `together` all of them: (name, value, unit).
    pub fn inconsistent_start(condition: &Text, each: &[(String, f64, String)], together: &[(String, f64, String)]) -> Fault {
        let said = |list: &[(String, f64, String)], ru: bool, joint: &str| {
            let one = |(name, value, unit): &(String, f64, String)| {
                let n = ten_digits(*value);
                format!("{name} = {} {unit}", if ru { n.ru } else { n.en })
            };
            list.iter().map(one).collect::<Vec<_>>().join(joint)
        };
        let help = if each.is_empty() {
            Text::new(
                format!("{} close it together; leave out the start values that are to be found", said(together, false, ", ")),
                format!("вместе замыкают её {}; уберите начальные значения, которые нужно найти", said(together, true, ", ")),
            )
        } else {
            Text::new(
                format!("{} closes it; or leave this start value out, and it is found", said(each, false, ", or ")),
                format!("замыкает её {}; или уберите это начальное значение, и оно будет найдено", said(each, true, " или ")),
            )
        };
        Fault::new(Message {
            code: "S015",
            what: Text::new(
                format!("the given start values do not fit the connection `{}`", condition.en),
                format!("заданные начальные значения не согласуются со связью `{}`", condition.ru),
            ),
            why: Text::new(
                "more start values are given than the machine has degrees of freedom, and one of them is inaccurate or wrong",
                "задано больше начальных значений, чем степеней свободы у машины, и одно из них неточно или неверно",
            ),
            help,
        })
    }

    /// Loops that no configuration closes.
    pub fn cannot_close(condition: &Text, gap: f64, places: &Text) -> Fault {
        let n = rounded(gap);
        Fault::new(Message {
            code: "S016",
            what: Text::new(
                format!("the connection `{}` cannot be closed: at best {} is left over, at {}", condition.en, n.en, places.en),
                format!("связь `{}` не замыкается: в лучшем случае остаётся {}, при {}", condition.ru, n.ru, places.ru),
            ),
            why: Text::new(
                "the lengths do not reach, or the bodies would have to overlap",
                "длин не хватает, или тела должны были бы пересечься",
            ),
            help: Text::new(
                "check lengths and positions; give start values nearer to a configuration that exists",
                "проверьте длины и положения; задайте начальные значения ближе к существующей конфигурации",
            ),
        })
    }

    /// Conditions that hold the same motion and disagree.
    pub fn contradiction(conditions: &Text, places: &Text) -> Fault {
        Fault::new(Message {
            code: "S017",
            what: Text::new(
                format!("these conditions contradict each other: {}, at {}", conditions.en, places.en),
                format!("эти условия противоречат друг другу: {}, при {}", conditions.ru, places.ru),
            ),
            why: Text::new("they hold the same motion in different ways", "они удерживают одно и то же движение по-разному"),
            help: Text::new("remove one of them, or make their numbers agree", "уберите одно из них или согласуйте числа"),
        })
    }

    /// A start from which no motion follows.
    pub fn singular_start(conditions: &Text, places: &Text) -> Fault {
        Fault::new(Message {
            code: "S018",
            what: Text::new(
                format!("the machine starts in a singular configuration, {}: {}", places.en, conditions.en),
                format!("машина начинает движение из особого положения, {}: {}", places.ru, conditions.ru),
            ),
            why: Text::new(
                "these conditions depend on each other here and nowhere near: a dead centre, a stretched or flat linkage, from which the motion can go on in two ways",
                "эти условия зависимы здесь и независимы рядом: мёртвая точка, вытянутый или сложенный механизм, из которого движение может продолжиться двояко",
            ),
            help: Text::new("start a little beside this position", "начните немного в стороне от этого положения"),
        })
    }

    /// An output over a reaction that is not unique.
    pub fn open_reaction(output: &str, reaction: &str) -> Fault {
        Fault::new(Message {
            code: "S019",
            what: Text::new(
                format!("the output `{output}` uses the reaction `{reaction}`, which is not unique"),
                format!("величина `{output}` использует реакцию `{reaction}`, которая не единственна"),
            ),
            why: Text::new(
                "several connections hold the same motion of rigid bodies; how they share the load depends on their elasticity",
                "одно и то же движение твёрдых тел удерживают несколько связей; как они делят нагрузку, зависит от их упругости",
            ),
            help: Text::new(
                "remove the redundant connection, replace it by a spring, or ask for other outputs",
                "уберите лишнюю связь, замените её пружиной или запросите другие величины",
            ),
        })
    }

    /// The conditions of connections cannot be met any more.
    pub fn lost_conditions(violation: f64, t: f64) -> Fault {
        let (n, t) = (rounded(violation), number(t));
        Fault::new(Message {
            code: "S013",
            what: Text::new(
                format!("the connections come apart at t = {} s: relative violation {}", t.en, n.en),
                format!("связи расходятся при t = {} с: относительное нарушение {}", t.ru, n.ru),
            ),
            why: Text::new(
                "the linkage runs into a position in which it cannot be assembled (a stretched linkage that a drive pulls on)",
                "механизм приходит в положение, в котором он не собирается (вытянутый механизм, который тянет привод)",
            ),
            help: Text::new("check the lengths and the prescribed motions", "проверьте длины и заданные движения"),
        })
    }

    /// The equations of an impact have no single solution.
    pub fn undetermined_impact(t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S014",
            what: Text::new(
                format!("the impact at t = {} s leaves the rates or the impulses undetermined", n.en),
                format!("удар при t = {} с не определяет скоростей или импульсов", n.ru),
            ),
            why: Text::new(
                "two contacts or connections hold the same motion, or a body without mass is hit",
                "два контакта или две связи удерживают одно движение, или удар приходится на тело без массы",
            ),
            help: Text::new(
                "remove the contact that repeats another, or give the bodies mass",
                "уберите контакт, повторяющий другой, или задайте телам массу",
            ),
        })
    }

    /// A gap that is negative at the start.
    pub fn penetrates(guard: &Text, gap: f64, t: f64) -> Fault {
        let (t, gap) = (number(t), number(gap));
        Fault::new(Message {
            code: "S012",
            what: Text::new(
                format!("`{}` has the gap {} at t = {} s", guard.en, gap.en, t.en),
                format!("`{}`: зазор равен {} при t = {} с", guard.ru, gap.ru, t.ru),
            ),
            why: Text::new(
                "a gap is never negative: one body stands inside the other",
                "зазор не бывает отрицательным: одно тело находится внутри другого",
            ),
            help: Text::new("change the start values or the place of the contact", "измените начальные значения или положение контакта"),
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

    /// The step fell below the resolution of time.
    pub fn underflow(state: &Text, t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S003",
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
}
