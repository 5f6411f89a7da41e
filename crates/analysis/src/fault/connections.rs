//! Faults of friction, contacts and connections.

use words::{Message, Text};

use super::Fault;
use words::digits::{number, rounded, ten_digits};
use words::explain::{Explanation, plain};

/// Rows of friction, contacts and connections.
pub const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S011",
        ("contact or friction without an admissible state", "контакт или трение без допустимого состояния"),
        (NO_STATE_EN, NO_STATE_RU),
    ),
    plain("S012", ("a contact starts penetrated", "контакт начинается с внедрения"), (PENETRATES_EN, PENETRATES_RU)),
    plain("S013", ("connections come apart", "связи расходятся"), (APART_EN, APART_RU)),
    plain("S014", ("impact without a single solution", "удар без однозначного решения"), (IMPACT_EN, IMPACT_RU)),
    plain("S081", ("an impact that jams", "удар с заклиниванием"), (JAM_EN, JAM_RU)),
    plain("S126", ("an impact that gains energy", "удар, увеличивающий энергию"), (GAIN_EN, GAIN_RU)),
    plain("S110", ("impacts without an end", "удары без конца"), (ENDLESS_EN, ENDLESS_RU)),
    plain("S015", ("start values that do not fit the connections", "начальные значения не согласуются со связями"), (START_EN, START_RU)),
    plain("S016", ("loop that cannot close", "незамыкаемый контур"), (LOOP_EN, LOOP_RU)),
    plain("S017", ("contradictory conditions", "противоречивые условия"), (CONTRADICTION_EN, CONTRADICTION_RU)),
    plain("S018", ("singular configuration", "особое положение"), (SINGULAR_EN, SINGULAR_RU)),
    plain("S019", ("reaction that is not unique", "неединственная реакция"), (OPEN_EN, OPEN_RU)),
    plain("S058", ("change point that is not passed", "непройденное положение ветвления"), (CHANGE_EN, CHANGE_RU)),
    plain("S059", ("no value at a change point", "нет значения в положении ветвления"), (BLIND_EN, BLIND_RU)),
    plain(
        "S087",
        ("reaction that depends on the place of a load", "реакция, зависящая от места приложения нагрузки"),
        (PLACE_EN, PLACE_RU),
    ),
    plain(
        "S088",
        ("friction pressed by a reaction without a value", "трение от неопределённой нормальной реакции"),
        (PRESSURE_EN, PRESSURE_RU),
    ),
    plain(
        "S114",
        ("reaction that depends on the tension of a belt or chain", "реакция, зависящая от натяжения ремня или цепи"),
        (TENSION_EN, TENSION_RU),
    ),
    plain(
        "S115",
        (
            "friction pressed by a reaction that depends on the tension of a belt or chain",
            "трение от реакции, зависящей от натяжения ремня или цепи",
        ),
        (TAUT_EN, TAUT_RU),
    ),
    plain(
        "S116",
        ("a strand of a belt or chain that would have to push", "ветвь ремня или цепи, которая должна была бы толкать"),
        (STRAND_EN, STRAND_RU),
    ),
    plain("S121", ("length measured at another start", "длина, измеренная в другом начальном положении"), (MOVED_EN, MOVED_RU)),
    plain("S122", ("periodic regime over a change point", "периодический режим через положение ветвления"), (VARIED_EN, VARIED_RU)),
    plain("S120", ("friction pressed by a reaction that is not unique", "трение от неединственной реакции"), (SHARED_EN, SHARED_RU)),
    plain(
        "S090",
        ("reaction that depends on an undeclared transmission", "реакция, зависящая от незаданной передачи"),
        (TRANSMISSION_EN, TRANSMISSION_RU),
    ),
    plain(
        "S091",
        (
            "friction pressed by a reaction that depends on an undeclared transmission",
            "трение от реакции, зависящей от незаданной передачи",
        ),
        (DRIVEN_EN, DRIVEN_RU),
    ),
];

const CHANGE_EN: &str = "At a change point the conditions of a linkage depend on each other for an instant: a parallelogram whose cranks and coupler lie in line, a deltoid whose \
    crank covers the frame. Several ways of assembly meet there. A machine that moves passes it along the smooth continuation of its motion. It is refused where its rates vanish there, where \
    a load, contact or friction switches in the position itself, or where the motion really ends (a massless linkage in its dead position). A second crank or linkage, set at \
    another angle, as locomotives have it, keeps the motion unique; so does starting or switching a little beside the position.";
const CHANGE_RU: &str = "В положении ветвления условия связей на мгновение становятся зависимыми: параллелограмм, кривошипы и шатун которого вытянулись в линию, дельтоид (четырёхзвенник с двумя парами равных смежных звеньев), кривошип которого \
    лёг на стойку. Здесь встречаются несколько вариантов сборки. Движущаяся машина проходит его по гладкому продолжению движения. Отказ следует, если скорости в нём обращаются в нуль, если \
    нагрузка, контакт или трение переключаются в самом положении или если движение действительно кончается (невесомый механизм в мёртвом положении). Второй кривошип или механизм, \
    поставленный под другим углом, как у паровоза, сохраняет определённость движения; помогает и начало или переключение чуть в стороне.";
const BLIND_EN: &str = "At a change point reactions usually grow beyond all bounds: the linkage has no lever there against the loads that it holds elsewhere. An output over such a reaction has \
    no value in the position itself. Everything else is interpolated from both sides.";
const BLIND_RU: &str = "В положении ветвления реакции, как правило, неограниченно растут: у механизма нет плеча против нагрузок, которые он несёт рядом. Величина, в которую входит такая \
    реакция, в самом положении не имеет значения. Всё остальное интерполируется с обеих сторон.";
const NO_STATE_EN: &str = "Contacts and frictions of one instant are decided together, and here no combination of closed and open, sticking and sliding agrees with the forces that it \
    leads to. With friction on a computed normal force this is self-locking (a shoe brake whose lever is pressed on by the friction itself), a jam, or Painlevé's paradox: closed, the normal force would be negative, \
    open, the gap would close. It also happens when the static limit is below the kinetic one. Rigid bodies have no motion with finite forces then; give the contact some compliance, or a smaller coefficient.";
const NO_STATE_RU: &str = "Контакты и трения одного мгновения определяются совместно, и здесь никакое сочетание замкнутых и разомкнутых контактов, залипания и скольжения не согласуется с силами, к которым \
    оно ведёт. При трении от вычисляемой нормальной реакции это самоторможение (колодочный тормоз, рычаг которого прижимается самим трением), заклинивание или парадокс Пенлеве: в замкнутом контакте нормальная \
    сила была бы отрицательна, разомкнутый сразу бы замкнулся. То же бывает, когда предельное трение покоя меньше трения скольжения. У абсолютно твёрдых тел движения с конечными силами тогда нет; задайте \
    податливость контакта или меньший коэффициент.";
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
const JAM_EN: &str = "By Poisson's law an impact closes until the approach has ended. With large friction in an unfavourable geometry the tangential impulse may close the \
    contact faster than the normal one opens it, so that the approach does not end by any impulse of rigid bodies. Lower the friction or make the contact compliant.";
const JAM_RU: &str = "По закону Пуассона первая фаза удара длится до конца сближения. При большом трении и неблагоприятной геометрии касательный импульс может \
    замыкать контакт быстрее, чем размыкает нормальный, и тогда для твёрдых тел сближение не прекращается никаким импульсом. Уменьшите трение или сделайте контакт \
    податливым.";
const GAIN_EN: &str = "Newton's restitution is a ratio of rates: u+ = -e u-, whatever the friction at the contact does. Where a blow passes the body off its centre, friction that stops \
    or turns the sliding changes the closing rate too, and the ratio asked for may need more energy than there is (Kane's paradox). Contacts with different restitutions that \
    strike together may ask for too much, too. No rigid bodies do that: the motion ends at the impact, with everything before it. Poisson's restitution, a ratio of impulses \
    (`law = \"poisson\"` at the stop), follows the friction through both phases of the impact and never gains.";
const GAIN_RU: &str = "Коэффициент восстановления Ньютона – отношение скоростей: u+ = -e u-, что бы ни делало трение в контакте. Если удар проходит мимо центра масс, трение, которое \
    останавливает или обращает скольжение, меняет и скорость сближения, и требуемое отношение может потребовать больше энергии, чем есть (парадокс Кейна). Слишком многого \
    могут требовать и контакты с разными коэффициентами, ударяющие одновременно. Твёрдые тела так не движутся: расчёт кончается на ударе, всё до него сохраняется. Коэффициент \
    Пуассона, отношение импульсов (`law = \"poisson\"` у упора), прослеживает трение через обе фазы удара и энергии не прибавляет.";
const ENDLESS_EN: &str = "Several contacts that touch at the time of an impact strike one after another, the fastest first, until none closes. For contacts whose bodies are \
    coupled unfavourably (a heavy body between two light ones, friction that feeds the next blow) the chain may converge too slowly to be followed. Give one of the contacts \
    a compliance (a spring with damping), or a small gap.";
const ENDLESS_RU: &str = "Несколько контактов, замкнутых в момент удара, ударяют один за другим, первым – сближающийся быстрее всех, пока сближение не прекратится. При неблагоприятной \
    связи тел (тяжёлое тело между двумя лёгкими, трение, питающее следующий удар) цепочка может сходиться слишком медленно. Задайте одному из контактов податливость (пружину с \
    демпфером) или малый зазор.";
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

const PLACE_EN: &str = "A load given `along` a formula (or a potential, a dissipation function) says what work it does when coordinates change, not at which point of \
    which body it acts. It is taken to act along the body's own displacement; its arm, or the body that takes it where a coordinate moves several, stays open. \
    Reactions that do not depend on this have their values, this one does. Put the load between points or bodies (`between`, `at`, `on`), or write its formula \
    with places of points: along = \"x(P)\".";
const PLACE_RU: &str = "Нагрузка, заданная формулой `along` (а также потенциал или функция рассеяния), говорит, какую работу она совершает при изменении координат, но не в какой \
    точке и на какое тело она действует. Считается, что она направлена по собственному перемещению тела; её плечо, а если координата движет несколько тел, то и само \
    тело остаются неизвестными. Реакции, которые от этого не зависят, определены, эта – нет. Приложите нагрузку к точкам или телам (`between`, `at`, `on`) или \
    запишите её формулу через положения точек: along = \"x(P)\".";
const TENSION_EN: &str = "A belt or chain turns its wheels by the difference of its tensions, which the motion gives. The axles feel the sum of both, too, and that follows from no law: \
    a belt is stretched over its wheels with a pretension, the slack side of a chain carries nothing. Give the belt `pretension` (half the sum of the tensions: that of each \
    strand when nothing is transmitted), or the chain `tight`, the sign of its force. What carries both axles does not feel the tensions and has its reactions without them.";
const TENSION_RU: &str = "Ремень или цепь вращает колёса разностью натяжений ветвей, которая следует из движения. Но оси воспринимают и их сумму, а она ни из какого закона не следует: \
    ремень надет с предварительным натяжением, ведомая ветвь цепи не нагружена. Задайте ремню `pretension` (полусумму натяжений: натяжение каждой ветви без нагрузки) \
    или цепи `tight`, знак её усилия. Тело, несущее обе оси, натяжений не чувствует, и его реакции определены без них.";
const TAUT_EN: &str = "The normal force of this friction is a reaction that depends on the sum of the tensions of a belt or chain. The friction, and with it the motion, would be arbitrary. \
    Give the belt `pretension`, or the chain `tight`, or the friction a law of its own.";
const TAUT_RU: &str = "Нормальная сила этого трения – реакция, зависящая от суммы натяжений ветвей ремня или цепи. Трение, а с ним и движение, было бы произвольным. \
    Задайте ремню `pretension` или цепи `tight`, либо задайте трение собственным законом.";
const STRAND_EN: &str = "With T1 - T2 = F and T1 + T2 = 2 F0 the slack side of a belt carries F0 - |F|/2: a force of more than twice the pretension would need a strand that pushes; \
    a belt slips or leaves its wheel before. A chain with `tight` pulls one way only; where its force changes sign the other strand becomes the tight one. Forces of axles would be wrong \
    from there on, so the motion ends.";
const STRAND_RU: &str = "При T1 - T2 = F и T1 + T2 = 2 F0 ведомая ветвь ремня несёт F0 - |F|/2: усилие больше удвоенного предварительного натяжения потребовало бы толкающей ветви; \
    раньше этого ремень проскальзывает или сходит. Цепь с ключом `tight` тянет только в одну сторону; если её усилие меняет знак, ведущей становится другая ветвь. Силы в осях \
    с этого мгновения были бы неверны, поэтому расчёт кончается.";
const PRESSURE_EN: &str = "The normal force of this friction is a reaction that depends on where a load acts, and the load is given by a formula that does not say it. The friction, \
    and with it the motion, would be arbitrary. Give the load a place, or the friction another normal force.";
const PRESSURE_RU: &str = "Нормальная сила этого трения – реакция, зависящая от места приложения нагрузки, а нагрузка задана формулой, из которой место не следует. Трение, а с ним \
    и движение, было бы произвольным. Задайте место приложения нагрузки или другую нормальную силу.";

const MOVED_EN: &str = "`rest = \"start\"` of a spring and the default lengths of rods and ropes are those of the start. A coordinate with a `guess` has its place there after the \
    connections have closed; one with neither `start` nor `guess` has 0. Here connections move it all the same, and the length would belong to another configuration. Give the coordinate \
    a start or a guess, or the length a number.";
const MOVED_RU: &str = "`rest = \"start\"` пружины и длины стержней и канатов по умолчанию относятся к началу движения. Координата с `guess` имеет там значение, найденное при замыкании связей; \
    координата без `start` и `guess` – нуль. Здесь связи всё же сдвигают её, и длина относилась бы к другому положению. Задайте координате `start` или `guess` или длину числом.";

const VARIED_EN: &str = "The search for a periodic regime follows small disturbances along the motion. In a change point (parallel cranks in line with their coupler) a disturbance across \
    the way would lead to another way of assembly; the equations of disturbances have a pole there, and neither Newton's correction nor multipliers follow from them. Simulate the motion \
    until it repeats itself, or let one coordinate move the links by formulas.";
const VARIED_RU: &str = "Поиск периодического режима прослеживает малые возмущения вдоль движения. В положении ветвления (параллельные кривошипы на одной линии с шатуном) возмущение поперёк \
    пути вело бы к другому варианту сборки; уравнения возмущений имеют там полюс, и ни поправка Ньютона, ни мультипликаторы из них не следуют. Моделируйте движение, пока оно не начнёт \
    повторяться, либо задайте движение звеньев одной координатой с помощью формул.";

const SHARED_EN: &str = "The normal force of this friction is one of several reactions that hold the same motion of rigid bodies (a second side rod, a bearing too many). How they \
    share the load is open, and with the normal force the friction and the motion would be arbitrary. Take the redundant connection away, make one of the parts elastic \
    (a spring), or give the friction by a law that needs no reaction.";
const SHARED_RU: &str = "Нормальная сила этого трения – одна из нескольких реакций, удерживающих одно и то же движение твёрдых тел (второе сцепное дышло, лишняя опора). Распределение \
    нагрузки между ними неопределимо, и вместе с нормальной силой произвольными были бы трение и движение. Уберите лишнюю связь, сделайте одну из частей упругой (пружина) или задайте \
    трение законом, не зависящим от реакций.";

const TRANSMISSION_EN: &str = "One coordinate moves several bodies: a piston placed by a formula of the crank's angle, a load whose height is the drum's angle times \
    its radius. Motion and energy follow from the coordinate alone. But whatever carries the motion from one body to the other (rod, rope, gear, slot) pulls or presses \
    on both, and supports feel the parts of this force in their direction; they depend on its line of action. Declare it: [rods] between crank and piston, [ropes], \
    [pins], [rolling], or give each body its own coordinate and connect them. A support that the transmission cannot load keeps its value.";
const TRANSMISSION_RU: &str = "Одна координата движет несколько тел: ползун, положение которого задано формулой через угол кривошипа, груз, высота которого равна углу барабана, \
    умноженному на радиус. Движение и энергия следуют из одной координаты. Но то, что передаёт движение от тела к телу (шатун, нить, зацепление, кулиса), нагружает оба тела, \
    и опоры воспринимают составляющие этой силы; они зависят от её линии действия. Задайте связь: [rods] между кривошипом и ползуном, [ropes], [pins], [rolling], или дайте \
    каждому телу свою координату и соедините тела. Реакция опоры, которую передача нагрузить не может, определена.";
const DRIVEN_EN: &str = "The normal force of this friction is a reaction that depends on how one coordinate moves several bodies, and no connection says it. The friction, and with \
    it the motion, would be arbitrary. Declare what carries the motion from one body to the other (a rod, a rope, a pin), or give each body its own coordinate.";
const DRIVEN_RU: &str = "Нормальная сила этого трения – реакция, зависящая от того, чем одна координата приводит в движение несколько тел, а такая связь не задана. Трение, а с ним и \
    движение, было бы произвольным. Задайте то, что передаёт движение от тела к телу (шатун, нить, шарнир), или дайте каждому телу свою координату.";

/// From where on a force has the wrong sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Since<'n> {
    /// At a place of rest.
    Rest,
    /// From an instant, s.
    Time(f64),
    /// From a place of the coordinate that describes a cycle, rad.
    Angle(&'n str, f64),
}

impl Since<'_> {
    pub(crate) fn words(self) -> Text {
        match self {
            Since::Rest => Text::new("at rest", "в покое"),
            Since::Time(t) => {
                let n = ten_digits(t);
                Text::new(format!("from t = {} s on", n.en), format!("начиная с t = {} с", n.ru))
            }
            Since::Angle(name, value) => {
                let n = ten_digits(value);
                Text::new(format!("from {name} = {} rad on", n.en), format!("начиная с {name} = {} рад", n.ru))
            }
        }
    }
}

impl Fault {
    /// An output over a reaction that depends on how a coordinate moves several bodies.
    pub fn reaction_without_transmission(output: &str, reaction: &str, (coordinate, bodies): (&str, &Text)) -> Fault {
        Fault::new(Message {
            code: "S090",
            what: Text::new(
                format!(
                    "the output `{output}` uses the reaction `{reaction}`, which depends on what makes {} follow `{coordinate}`",
                    bodies.en
                ),
                format!(
                    "величина `{output}` использует реакцию `{reaction}`, которая зависит от того, чем `{coordinate}` движет тела {}",
                    bodies.ru
                ),
            ),
            why: undeclared(coordinate),
            help: declare(bodies),
        })
    }

    /// A friction pressed by such a reaction.
    pub fn pressure_without_transmission(friction: &str, reaction: &str, (coordinate, bodies): (&str, &Text)) -> Fault {
        Fault::new(Message {
            code: "S091",
            what: Text::new(
                format!(
                    "`{friction}` is pressed by the reaction `{reaction}`, which depends on what makes {} follow `{coordinate}`",
                    bodies.en
                ),
                format!(
                    "`{friction}` прижимается реакцией `{reaction}`, которая зависит от того, чем `{coordinate}` движет тела {}",
                    bodies.ru
                ),
            ),
            why: undeclared(coordinate),
            help: declare(bodies),
        })
    }

    /// An output over a reaction that depends on the sum of the tensions of a belt or chain.
    pub fn reaction_without_tension(output: &str, reaction: &str, (drive, _): (&str, &Text)) -> Fault {
        Fault::new(Message {
            code: "S114",
            what: Text::new(
                format!("the output `{output}` uses the reaction `{reaction}`, which depends on the sum of the tensions of `{drive}`"),
                format!("величина `{output}` использует реакцию `{reaction}`, которая зависит от суммы натяжений ветвей `{drive}`"),
            ),
            why: of_the_tensions(),
            help: give_the_tension(drive),
        })
    }

    /// A friction pressed by such a reaction.
    pub fn pressure_without_tension(friction: &str, reaction: &str, (drive, _): (&str, &Text)) -> Fault {
        Fault::new(Message {
            code: "S115",
            what: Text::new(
                format!("`{friction}` is pressed by the reaction `{reaction}`, which depends on the sum of the tensions of `{drive}`"),
                format!("`{friction}` прижимается реакцией `{reaction}`, которая зависит от суммы натяжений ветвей `{drive}`"),
            ),
            why: of_the_tensions(),
            help: give_the_tension(drive),
        })
    }

    /// A strand that would have to push.
    pub fn strand_pushes(drive: &Text, since: Since<'_>) -> Fault {
        let Text { en: from, ru: since } = since.words();
        Fault::new(Message {
            code: "S116",
            what: Text::new(
                format!("{}: {from} a strand would have to push", drive.en),
                format!("{}: {since} одна из ветвей должна была бы толкать", drive.ru),
            ),
            why: Text::new(
                "the force is more than twice the pretension of the belt, or it has the other sign than the `tight` of the chain",
                "усилие больше удвоенного предварительного натяжения ремня или противоположно по знаку ключу `tight` цепи",
            ),
            help: Text::new(
                "give the belt a larger `pretension`; give the chain the other `tight`, or take the reactions of its axles out where it changes its side",
                "увеличьте `pretension` ремня; задайте цепи другой знак `tight` или уберите ключ и реакции осей, если ведущая ветвь меняется",
            ),
        })
    }

    /// An output over a reaction that depends on where a load acts.
    pub fn reaction_without_place(output: &str, reaction: &str, load: &str) -> Fault {
        Fault::new(Message {
            code: "S087",
            what: Text::new(
                format!("the output `{output}` uses the reaction `{reaction}`, which depends on where the load `{load}` acts"),
                format!("величина `{output}` использует реакцию `{reaction}`, которая зависит от места приложения нагрузки `{load}`"),
            ),
            why: Text::new(
                "a formula of coordinates gives the work of a load; the point, and with it the moment on the body, stays open",
                "формула через координаты задаёт работу нагрузки; точка приложения, а с ней и момент на теле, остаётся неизвестной",
            ),
            help: give_a_place(load),
        })
    }

    /// A friction pressed by such a reaction.
    pub fn pressure_without_place(friction: &str, reaction: &str, load: &str) -> Fault {
        Fault::new(Message {
            code: "S088",
            what: Text::new(
                format!("`{friction}` is pressed by the reaction `{reaction}`, which depends on where the load `{load}` acts"),
                format!("`{friction}` прижимается реакцией `{reaction}`, которая зависит от места приложения нагрузки `{load}`"),
            ),
            why: Text::new(
                "a formula of coordinates gives the work of a load and not its place; friction and motion would be arbitrary",
                "формула через координаты задаёт работу нагрузки, но не её место; трение и движение были бы произвольными",
            ),
            help: give_a_place(load),
        })
    }

    /// A friction pressed by one of several reactions that share a load.
    pub fn pressure_not_unique(friction: &str, reaction: &str) -> Fault {
        Fault::new(Message {
            code: "S120",
            what: Text::new(
                format!("`{friction}` is pressed by the reaction `{reaction}`, which is not unique"),
                format!("`{friction}` прижимается реакцией `{reaction}`, которая не единственна"),
            ),
            why: Text::new(
                "rigid bodies are held here more than once, and how they share the load is open: friction and motion would be arbitrary",
                "твёрдые тела удержаны здесь неоднократно, и распределение нагрузки между связями неопределимо: трение и движение были бы произвольными",
            ),
            help: Text::new(
                "remove the redundant connection, replace it by a spring, or give the friction by a law of its own (`damping`, a torque by formula); of a body whose `origin` is a formula of another body's angle or way: give the name of the point that carries it as `origin`",
                "уберите лишнюю связь, замените её пружиной или задайте трение собственным законом (`damping`, момент по формуле); если `origin` тела – формула от угла или перемещения другого тела, укажите в `origin` имя несущей его точки",
            ),
        })
    }

    /// A length that is measured at the start, where a coordinate has moved since.
    pub fn moved_start(user: &str, coordinate: &str, [measured, found]: [f64; 2], unit: &str) -> Fault {
        let (old, new, unit) = (rounded(measured), rounded(found), Text::unit(unit));
        Fault::new(Message {
            code: "S121",
            what: Text::new(
                format!(
                    "`{user}` is measured at the start with {coordinate} = {} {}, but the machine starts with {} {}",
                    old.en, unit.en, new.en, unit.en
                ),
                format!(
                    "`{user}` измеряется в начале движения при {coordinate} = {} {}, но машина начинает движение при {} {}",
                    old.ru, unit.ru, new.ru, unit.ru
                ),
            ),
            why: Text::new(
                "other connections have moved this coordinate from its value, and the length would be that of another configuration",
                "другие связи сдвинули эту координату с её значения, и длина относилась бы к другому положению",
            ),
            help: Text::new(
                format!("give `{coordinate}` its `start`, a `guess` nearer to the closed configuration, or give the length as a number"),
                format!("задайте для `{coordinate}` значение `start`, более близкое приближение `guess` или саму длину числом"),
            ),
        })
    }

    /// No state of the contacts and frictions of an instant agrees with the forces.
    pub fn no_contact_state(contacts: &[&Text], t: f64) -> Fault {
        let n = number(t);
        let list = |name: fn(&Text) -> &str| contacts.iter().map(|c| format!("`{}`", name(c))).collect::<Vec<_>>().join(", ");
        let (en, ru) = (list(|c| &c.en), list(|c| &c.ru));
        Fault::new(Message {
            code: "S011",
            what: Text::new(
                format!("no state of the contacts agrees with the forces at t = {} s: {en}", n.en),
                format!("при t = {} с никакое состояние контактов не согласуется с силами: {ru}", n.ru),
            ),
            why: Text::new(
                "closed, a contact would have to pull, open, it would penetrate; or a friction can neither stick nor slide: friction presses the contact on (self-locking, a jam, \
                 Painlevé's paradox), or a static limit lies below the kinetic one",
                "замкнутый контакт должен был бы тянуть, разомкнутый – внедряться, либо трение не может ни удержать, ни скользить: трение само прижимает контакт (самоторможение, \
                 заклинивание, парадокс Пенлеве) или предел трения покоя ниже трения скольжения",
            ),
            help: Text::new(
                "reduce the coefficient of friction, raise the static limit, turn the motion round, start at rest, or make the contact compliant (spring with damping)",
                "уменьшите коэффициент трения, повысьте предел трения покоя, измените направление движения, начните с покоя или сделайте контакт податливым (пружина с демпфером)",
            ),
        })
    }

    /// A rope whose length is missing at the start.
    pub fn too_short(guard: &Text, gap: f64, t: f64) -> Fault {
        let (t, gap) = (number(t), number(gap));
        Fault::new(Message {
            code: "S012",
            what: Text::new(
                format!("`{}` is too short at t = {} s: length less distance is {} m", guard.en, t.en, gap.en),
                format!("`{}` коротка при t = {} с: длина минус расстояние равна {} м", guard.ru, t.ru, gap.ru),
            ),
            why: Text::new("a rope is never longer than its length", "нить не бывает длиннее своей длины"),
            help: Text::new("change the start values or the length", "измените начальные значения или длину"),
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

    /// A blow at these contacts that gives energy, J.
    pub(crate) fn energetic_impact(contacts: &[&Text], gain: f64, cause: Gaining) -> Fault {
        let n = rounded(gain);
        let [en, ru] =
            [|n: &Text| n.en.clone(), |n: &Text| n.ru.clone()].map(|of| contacts.iter().map(|n| of(n)).collect::<Vec<_>>().join(", "));
        let (why, help) = cause.words();
        Fault::new(Message {
            code: "S126",
            what: Text::new(
                format!("the impact of {en} gains {} J of energy", n.en),
                format!("удар ({ru}) увеличивает энергию на {} Дж", n.ru),
            ),
            why,
            help,
        })
    }

    /// Impacts in sequence that do not end.
    pub fn endless_impacts(t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S110",
            what: Text::new(
                format!("the impacts in sequence at t = {} s do not end", n.en),
                format!("последовательные удары при t = {} с не кончаются", n.ru),
            ),
            why: Text::new(
                "20 000 blows, one after another in one instant, left contacts that still close",
                "после 20 000 ударов, следующих друг за другом в одно мгновение, контакты всё ещё сближаются",
            ),
            help: Text::new(
                "make one of the contacts compliant, or part the bodies a little at the start",
                "сделайте один из контактов податливым или слегка разведите тела в начале",
            ),
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

    /// An impact by Poisson's law whose approach never ends.
    pub fn jammed_impact(t: f64) -> Fault {
        let n = number(t);
        Fault::new(Message {
            code: "S081",
            what: Text::new(
                format!("the impact at t = {} s jams: while it sticks or slides on, no impulse ends the approach", n.en),
                format!("удар при t = {} с заклинивает: при залипании или скольжении никакой импульс не прекращает сближения", n.ru),
            ),
            why: Text::new(
                "the friction presses the contact more than the normal impulse opens it; it is too large for this geometry",
                "трение прижимает контакт сильнее, чем его размыкает нормальный импульс; для этой геометрии оно слишком велико",
            ),
            help: Text::new(
                "lower the coefficient of friction, or make the contact compliant",
                "уменьшите коэффициент трения или сделайте контакт податливым",
            ),
        })
    }

    /// Given start values that contradict the connections. `each` closes the loop alone, or `together` all of them: (name, value, unit).
    pub fn inconsistent_start(condition: &Text, each: &[(String, f64, String)], together: &[(String, f64, String)]) -> Fault {
        let said = |list: &[(String, f64, String)], ru: bool, joint: &str| {
            let one = |(name, value, unit): &(String, f64, String)| {
                let (n, unit) = (ten_digits(*value), Text::unit(unit));
                if ru { format!("{name} = {} {}", n.ru, unit.ru) } else { format!("{name} = {} {}", n.en, unit.en) }
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

    /// A position in which several ways of assembly meet and the motion chooses none.
    pub fn change_point(places: &Text, t: f64) -> Fault {
        let t = number(t);
        Fault::new(Message {
            code: "S058",
            what: Text::new(
                format!("the motion cannot be followed past the change point at t = {} s, {}", t.en, places.en),
                format!("движение нельзя проследить за положение ветвления при t = {} с, {}", t.ru, places.ru),
            ),
            why: Text::new(
                "the conditions of the connections depend on each other here for an instant, several ways of assembly meet, and neither the rates nor the loads decide between them",
                "условия связей здесь на мгновение зависимы, встречаются несколько вариантов сборки, и ни скорости, ни нагрузки не выбирают один из них",
            ),
            help: Text::new(
                "let the machine pass it with a rate that is not zero, switch loads a little beside it, or add a crank at another angle",
                "пройдите его с ненулевой скоростью, переключайте нагрузки чуть в стороне или добавьте кривошип под другим углом",
            ),
        })
    }

    /// A periodic regime that passes a change point.
    pub fn varied_over_change_point(places: &Text, t: f64) -> Fault {
        let t = number(t);
        Fault::new(Message {
            code: "S122",
            what: Text::new(
                format!("the regime passes a change point at t = {} s, {}", t.en, places.en),
                format!("режим проходит положение ветвления при t = {} с, {}", t.ru, places.ru),
            ),
            why: Text::new(
                "the equations of small disturbances, from which the regime is corrected and its multipliers follow, have a pole where several ways of assembly meet",
                "уравнения малых возмущений, по которым уточняется режим и находятся мультипликаторы, имеют полюс там, где встречаются несколько вариантов сборки",
            ),
            help: Text::new(
                "simulate until the motion repeats itself, or join the links by one coordinate (`angle` and `origin` by formulas) instead of pins",
                "моделируйте движение, пока оно не начнёт повторяться, либо свяжите звенья одной координатой (формулы в `angle` и `origin`) вместо шарниров",
            ),
        })
    }

    /// An output that grows beyond bounds at a change point.
    pub fn blind(output: &str, t: f64) -> Fault {
        let t = number(t);
        Fault::new(Message {
            code: "S059",
            what: Text::new(
                format!("the output `{output}` has no value at t = {} s: a change point", t.en),
                format!("величина `{output}` не имеет значения при t = {} с: положение ветвления", t.ru),
            ),
            why: Text::new(
                "it does not approach the same value from both sides: in this position the linkage has no lever against its loads and reactions grow beyond bounds",
                "с двух сторон она не стремится к одному значению: в этом положении у механизма нет плеча против нагрузок и реакции неограниченно растут",
            ),
            help: Text::new(
                "ask for other instants, or leave this output out",
                "запросите другие моменты времени или не выводите эту величину",
            ),
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
                "rigid bodies are held here more than once: by several connections, or by a connection and by joints that the coordinates imply and nothing declares; the shares are open",
                "твёрдые тела удержаны здесь неоднократно: несколькими связями либо связью и соединениями, которые подразумевает выбор координат, но которые не заданы; доли неопределимы",
            ),
            help: Text::new(
                "remove the redundant connection, replace it by a spring, declare the joints of the body ([pins], [supports]), or ask for other outputs; of a body whose `origin` is a formula of another body's angle or way: give the name of the point that carries it as `origin`, then its joint is known",
                "уберите лишнюю связь, замените её пружиной, задайте соединения тела ([pins], [supports]) или запросите другие величины; если `origin` тела – формула от угла или перемещения другого тела, укажите в `origin` имя несущей его точки: тогда шарнир известен",
            ),
        })
    }
}

/// Why a blow gains energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Gaining {
    /// Newton's ratio of rates with friction.
    Friction,
    /// Several ratios at once.
    Several,
    /// Neither.
    Otherwise,
}

impl Gaining {
    fn words(self) -> (Text, Text) {
        match self {
            Gaining::Friction => (
                Text::new(
                    "the friction changes the closing rate too, and Newton's ratio of rates asks for more than the bodies have (Kane's paradox)",
                    "трение меняет и скорость сближения, и отношение скоростей по Ньютону требует больше энергии, чем есть у тел (парадокс Кейна)",
                ),
                Text::new(
                    "give the stop law = \"poisson\": its restitution is a ratio of impulses and never gains",
                    "задайте упору law = \"poisson\": это отношение импульсов, энергия при нём не растёт",
                ),
            ),
            Gaining::Several => (
                Text::new(
                    "contacts that strike together with different restitutions ask for more than the bodies have",
                    "контакты с разными коэффициентами восстановления, ударяющие одновременно, требуют больше энергии, чем есть у тел",
                ),
                Text::new(
                    "let them strike one after another (impacts = \"in sequence\"), give them one restitution, or law = \"poisson\"",
                    "пусть они ударяют по очереди (impacts = \"in sequence\"), имеют один коэффициент или law = \"poisson\"",
                ),
            ),
            Gaining::Otherwise => (
                Text::new(
                    "the impulses that the law of impact asks for do more work than the bodies lose",
                    "работа импульсов, которых требует закон удара, больше теряемой телами энергии",
                ),
                Text::new(
                    "lower the restitution, or make the contact compliant (a spring with damping)",
                    "уменьшите коэффициент восстановления или сделайте контакт податливым (пружина с демпфером)",
                ),
            ),
        }
    }
}

fn undeclared(coordinate: &str) -> Text {
    Text::new(
        format!(
            "`{coordinate}` moves several bodies; the force between them is known by its work only, and its line of action stands nowhere"
        ),
        format!("`{coordinate}` движет несколько тел; сила между ними известна лишь по своей работе, её линия действия не задана"),
    )
}

fn declare(bodies: &Text) -> Text {
    Text::new(
        format!("declare what connects {} (a rod, rope, pin, rolling), or give each its own coordinate", bodies.en),
        format!("задайте, чем соединены {} (rods, ropes, pins, rolling), или дайте каждому телу свою координату", bodies.ru),
    )
}

fn of_the_tensions() -> Text {
    Text::new(
        "the motion gives the difference of the tensions; their sum presses the axles and follows from no law of the machine",
        "из движения следует разность натяжений ветвей; их сумма нагружает оси и ни из какого закона механизма не следует",
    )
}

/// `drive` is the heading of the connection: `belts.S`.
fn give_the_tension(drive: &str) -> Text {
    if drive.starts_with("chains.") {
        return Text::new(
            format!("give [{drive}] the sign of its force: tight = \"+\" or \"-\"; or support the body that carries both axles"),
            format!("задайте в [{drive}] знак усилия: tight = \"+\" или \"-\"; либо опирайте тело, несущее обе оси"),
        );
    }
    Text::new(
        format!("give [{drive}] pretension = \"...\", half the sum of its tensions; or support the body that carries both axles"),
        format!("задайте в [{drive}] pretension = \"...\", полусумму натяжений ветвей; либо опирайте тело, несущее обе оси"),
    )
}

fn give_a_place(load: &str) -> Text {
    Text::new(
        format!("put `{load}` between points or bodies (`between`, `at`, `on`), or write its formula with places of points, such as x(P)"),
        format!("приложите `{load}` к точкам или телам (`between`, `at`, `on`) или запишите формулу через положения точек, например x(P)"),
    )
}
