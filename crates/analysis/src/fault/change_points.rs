//! Change points.

use words::{Message, Text};

use super::Fault;
use words::digits::number;

pub(super) const CHANGE_EN: &str = "At a change point the conditions of a linkage depend on each other for an instant: a parallelogram whose cranks and coupler lie in line, a deltoid whose \
    crank covers the frame. Several ways of assembly meet there. A machine that moves passes it along the smooth continuation of its motion. It is refused where its rates vanish there, where \
    a load, contact or friction switches in the position itself, or where the motion really ends (a massless linkage in its dead position). A second crank or linkage, set at \
    another angle, as locomotives have it, keeps the motion unique; so does starting or switching a little beside the position.";
pub(super) const CHANGE_RU: &str = "В положении ветвления условия связей на мгновение становятся зависимыми: параллелограмм, кривошипы и шатун которого вытянулись в линию, дельтоид (четырёхзвенник с двумя парами равных смежных звеньев), кривошип которого \
    лёг на стойку. Здесь встречаются несколько вариантов сборки. Движущаяся машина проходит его по гладкому продолжению движения. Отказ следует, если скорости в нём обращаются в нуль, если \
    нагрузка, контакт или трение переключаются в самом положении или если движение действительно кончается (невесомый механизм в мёртвом положении). Второй кривошип или механизм, \
    поставленный под другим углом, как у паровоза, сохраняет определённость движения; помогает и начало или переключение чуть в стороне.";
pub(super) const BLIND_EN: &str = "At a change point reactions usually grow beyond all bounds: the linkage has no lever there against the loads that it holds elsewhere. An output over such a reaction has \
    no value in the position itself. Everything else is interpolated from both sides.";
pub(super) const BLIND_RU: &str = "В положении ветвления реакции, как правило, неограниченно растут: у механизма нет плеча против нагрузок, которые он несёт рядом. Величина, в которую входит такая \
    реакция, в самом положении не имеет значения. Всё остальное интерполируется с обеих сторон.";
pub(super) const VARIED_EN: &str = "The search for a periodic regime follows small disturbances along the motion. In a change point (parallel cranks in line with their coupler) a disturbance across \
    the way would lead to another way of assembly; the equations of disturbances have a pole there, and neither Newton's correction nor multipliers follow from them. Simulate the motion \
    until it repeats itself, or let one coordinate move the links by formulas.";
pub(super) const VARIED_RU: &str = "Поиск периодического режима прослеживает малые возмущения вдоль движения. В положении ветвления (параллельные кривошипы на одной линии с шатуном) возмущение поперёк \
    пути вело бы к другому варианту сборки; уравнения возмущений имеют там полюс, и ни поправка Ньютона, ни мультипликаторы из них не следуют. Моделируйте движение, пока оно не начнёт \
    повторяться, либо задайте движение звеньев одной координатой с помощью формул.";

impl Fault {
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
}
