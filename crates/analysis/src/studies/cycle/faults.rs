//! What a cycle is refused for, and what is said beside its numbers.

use crate::Fault;
use crate::fault::codes;
use words::digits::rounded;
use words::{Message, Text};

pub(super) fn uneven() -> Text {
    Text::new(
        "the shaft does not turn uniformly in the motion that led through the cycle: the work is not checked by its powers",
        "в движении, которое провело машину через цикл, вал вращается неравномерно: работа по его мощностям не проверена",
    )
}

pub(super) fn pressed() -> Text {
    Text::new(
        "the shaft cannot be held to the uniform rate: normal forces of dry frictions are those of the machine's own motion",
        "вал нельзя удержать на постоянной скорости: нормальные силы сухого трения взяты из собственного движения машины",
    )
}

pub(super) fn no_energies() -> Fault {
    Fault::new(Message {
        code: "S047",
        what: Text::new("the machine has no energies at this place", "в этом положении энергии машины не определены"),
        why: Text::new("a formula of a load or an energy has no value there", "формула нагрузки или энергии там не имеет значения"),
        help: Text::new("check the formulas of loads over the whole turn", "проверьте формулы нагрузок на всём обороте"),
    })
}

/// S168: what a contact holds only for a part of the turn follows from the angle only there.
pub(super) fn parts(contact: &Text, (name, angle): (&str, f64)) -> Fault {
    let angle = rounded(angle);
    Fault::new(Message {
        code: "S168",
        what: Text::new(
            format!("{} does not stay as it is through the cycle: it changes at {name} = {} rad", contact.en, angle.en),
            format!("{}: состояние меняется в цикле при {name} = {} рад", contact.ru, angle.ru),
        ),
        why: Text::new(
            "while a contact is open the machine has one freedom more: its places do not follow from the angle, and what a blow takes is no moment of the shaft",
            "при открытом контакте у машины на одну степень свободы больше: положения не следуют из угла, а потери при ударе не сводятся к моменту на валу",
        ),
        help: Text::new(
            "choose a rate at which the contact stays closed; or hold the shaft with [motions] and take the work of a turn that repeats from `inverse`, divided by its angle",
            "выберите скорость, при которой контакт остаётся замкнутым; либо задайте движение вала в [motions] и разделите на угол работу повторяющегося оборота из `inverse`",
        ),
    })
}

pub(super) fn not_turning(name: &str) -> Fault {
    Fault::new(Message {
        code: codes::STANDS,
        what: Text::new(format!("`{name}` does not turn through the cycle"), format!("`{name}` не проходит весь цикл")),
        why: Text::new(
            "the shaft has a dead point, turns the other way, or the machine has more degrees of freedom",
            "у вала есть мёртвое положение, он вращается в другую сторону или у машины больше степеней свободы",
        ),
        help: Text::new(
            "check the sign of `turns` and of the starting rate; the other coordinates must follow from the angle",
            "проверьте знак `turns` и начальной скорости; остальные координаты должны следовать из угла",
        ),
    })
}

pub(super) fn rough() -> Text {
    Text::new(
        "the reduced moment is too rough to be followed everywhere: the work is that of a polynomial through samples",
        "приведённый момент изменяется слишком нерегулярно: работа найдена по отдельным значениям",
    )
}
