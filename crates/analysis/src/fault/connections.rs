//! Faults of friction, contacts and connections.

use crate::fault::codes;
use words::{Message, Text};

use super::Fault;
use super::assembly::{
    CONTRADICTION_EN, CONTRADICTION_RU, LOOP_EN, LOOP_RU, MOVED_EN, MOVED_RU, SINGULAR_EN, SINGULAR_RU, START_EN, START_RU,
};
use super::change_points::{BLIND_EN, BLIND_RU, CHANGE_EN, CHANGE_RU, VARIED_EN, VARIED_RU};
use super::contacts::{
    APART_EN, APART_RU, ENDLESS_EN, ENDLESS_RU, GAIN_EN, GAIN_RU, IMPACT_EN, IMPACT_RU, JAM_EN, JAM_RU, NO_STATE_EN, NO_STATE_RU,
    PENETRATES_EN, PENETRATES_RU,
};
use words::digits::ten_digits;
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
            code: codes::STRAND_PUSHES,
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
