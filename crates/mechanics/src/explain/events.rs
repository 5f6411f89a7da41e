//! Long explanations of the findings about named events.

use words::explain::{Explanation, row};

/// The codes of `[events.NAME]`.
pub const EVENTS: &[Explanation] = &[
    row(
        "M112",
        ("an unknown direction of an event", "неизвестное направление события"),
        (
            "An event is a change of sign of its formula: from minus to plus (`rising`), from plus to minus (`falling`), or either (`both`, which is \
             also meant without the key).",
            "Событие — перемена знака формулы: с минуса на плюс (`rising`), с плюса на минус (`falling`) или любая (`both`, то же без ключа).",
        ),
        "[coordinates]\nphi = \"rad\"\n[bodies.b]\nangle = \"phi\"\ninertia = \"1 kg m^2\"\n[events.top]\nzero = \"phi'\"\ndirection = \"down\"",
        "[coordinates]\nphi = \"rad\"\n[bodies.b]\nangle = \"phi\"\ninertia = \"1 kg m^2\"\n[events.top]\nzero = \"phi'\"\ndirection = \"falling\"",
    ),
    row(
        "M113",
        ("an event that cannot happen", "событие, которое не может произойти"),
        (
            "The formula of the event does not depend on the motion or on time, so its sign never changes. Compare a coordinate, a rate, a reaction or t \
             with the constant.",
            "Формула события не зависит ни от движения, ни от времени, поэтому её знак никогда не меняется. Сравните с постоянной координату, скорость, \
             реакцию или t.",
        ),
        "[parameters]\nl = \"2 m\"\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[events.end]\nzero = \"l - 1 [m]\"",
        "[parameters]\nl = \"2 m\"\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[events.end]\nzero = \"x - l\"",
    ),
];
