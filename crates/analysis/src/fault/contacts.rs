//! Contacts and their impacts.

use crate::fault::codes;
use words::{Message, Notice, Text};

use super::Fault;
use words::digits::{number, rounded};

pub(super) const NO_STATE_EN: &str = "Contacts and frictions of one instant are decided together, and here no combination of closed and open, sticking and sliding agrees with the forces that it \
    leads to. With friction on a computed normal force this is self-locking (a shoe brake whose lever is pressed on by the friction itself), a jam, or Painlevé's paradox: closed, the normal force would be negative, \
    open, the gap would close. It also happens when the static limit is below the kinetic one. Rigid bodies have no motion with finite forces then; give the contact some compliance, or a smaller coefficient.";
pub(super) const NO_STATE_RU: &str = "Контакты и трения одного мгновения определяются совместно, и здесь никакое сочетание замкнутых и разомкнутых контактов, залипания и скольжения не согласуется с силами, к которым \
    оно ведёт. При трении от вычисляемой нормальной реакции это самоторможение (колодочный тормоз, рычаг которого прижимается самим трением), заклинивание или парадокс Пенлеве: в замкнутом контакте нормальная \
    сила была бы отрицательна, разомкнутый сразу бы замкнулся. То же бывает, когда предельное трение покоя меньше трения скольжения. У абсолютно твёрдых тел движения с конечными силами тогда нет; задайте \
    податливость контакта или меньший коэффициент.";
pub(super) const PENETRATES_EN: &str = "The gap of a one-sided contact is negative at the start: the body stands inside the stop, or the rope is longer than its length. Move the start \
    or the contact.";
pub(super) const PENETRATES_RU: &str = "В начале зазор одностороннего контакта отрицателен: тело находится внутри упора или нить длиннее своей длины. Измените начальное положение \
    или контакт.";
pub(super) const APART_EN: &str = "After each step the state is moved back onto the conditions of the connections, by rounding only. Here no near state fulfils them: \
    the linkage has come to the end of its range, or a prescribed motion asks for a position that the lengths do not allow.";
pub(super) const APART_RU: &str = "После каждого шага состояние возвращается на условия связей, в пределах округления. Здесь близкого состояния, удовлетворяющего им, нет: \
    механизм дошёл до конца области своих движений, или заданное движение требует положения, невозможного при данных длинах.";
pub(super) const IMPACT_EN: &str = "Impulses follow from M dq' = F p and the rates after the impact. When two conditions hold the same motion their impulses are not unique; when \
    the body that is hit has no mass the rates are not.";
pub(super) const IMPACT_RU: &str = "Импульсы находятся из M dq' = F p и скоростей после удара. Если два условия удерживают одно и то же движение, импульсы не единственны; если тело, \
    по которому приходится удар, не имеет массы, не единственны скорости.";
pub(super) const JAM_EN: &str = "By Poisson's law an impact closes until the approach has ended. With large friction in an unfavourable geometry the tangential impulse may close the \
    contact faster than the normal one opens it, so that the approach does not end by any impulse of rigid bodies. Lower the friction or make the contact compliant.";
pub(super) const JAM_RU: &str = "По закону Пуассона первая фаза удара длится до конца сближения. При большом трении и неблагоприятной геометрии касательный импульс может \
    замыкать контакт быстрее, чем размыкает нормальный, и тогда для твёрдых тел сближение не прекращается никаким импульсом. Уменьшите трение или сделайте контакт \
    податливым.";
pub(super) const GAIN_EN: &str = "Newton's restitution is a ratio of rates: u+ = -e u-, whatever the friction at the contact does. Where a blow passes the body off its centre, friction that stops \
    or turns the sliding changes the closing rate too, and the ratio asked for may need more energy than there is (Kane's paradox). Contacts with different restitutions that \
    strike together may ask for too much, too. No rigid bodies do that: the motion ends at the impact, with everything before it. Poisson's restitution, a ratio of impulses \
    (`law = \"poisson\"` at the stop), follows the friction through both phases of the impact and never gains.";
pub(super) const GAIN_RU: &str = "Коэффициент восстановления Ньютона – отношение скоростей: u+ = -e u-, что бы ни делало трение в контакте. Если удар проходит мимо центра масс, трение, которое \
    останавливает или обращает скольжение, меняет и скорость сближения, и требуемое отношение может потребовать больше энергии, чем есть (парадокс Кейна). Слишком многого \
    могут требовать и контакты с разными коэффициентами, ударяющие одновременно. Твёрдые тела так не движутся: расчёт кончается на ударе, всё до него сохраняется. Коэффициент \
    Пуассона, отношение импульсов (`law = \"poisson\"` у упора), прослеживает трение через обе фазы удара и энергии не прибавляет.";
pub(super) const ENDLESS_EN: &str = "Several contacts that touch at the time of an impact strike one after another, the fastest first, until none closes. For contacts whose bodies are \
    coupled unfavourably (a heavy body between two light ones, friction that feeds the next blow) the chain may converge too slowly to be followed. Give one of the contacts \
    a compliance (a spring with damping), or a small gap.";
pub(super) const ENDLESS_RU: &str = "Несколько контактов, замкнутых в момент удара, ударяют один за другим, первым – сближающийся быстрее всех, пока сближение не прекратится. При неблагоприятной \
    связи тел (тяжёлое тело между двумя лёгкими, трение, питающее следующий удар) цепочка может сходиться слишком медленно. Задайте одному из контактов податливость (пружину с \
    демпфером) или малый зазор.";

impl Fault {
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

    /// The same of a motion that contacts would determine if they were not open at the time `t`.
    pub(crate) fn while_open(self, contacts: &[&Text], t: f64) -> Fault {
        let list = |name: fn(&Text) -> &str| contacts.iter().map(|c| format!("`{}`", name(c))).collect::<Vec<_>>().join(", ");
        let (en, ru) = (list(|c| &c.en), list(|c| &c.ru));
        let Message { code, what, .. } = *Notice::from(self).message;
        let why = Text::new(
            format!("nothing acts through {en} there, which is slack or open, and nothing else determines it"),
            format!("через {ru} там ничего не передаётся (слабина или зазор), а ничто другое этого не определяет"),
        );
        let help = Text::new(
            "keep it taut or closed (its length, the start, a prescribed motion that does not outrun it), or let the motor act on what the motion prescribes",
            "обеспечьте натяжение или контакт (длина, начальное положение, заданное движение, которое их не обгоняет) или приложите двигатель к тому, чьё движение задано",
        );
        Fault::new(Message { code, what, why, help }).during(t)
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
            code: codes::APART,
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
