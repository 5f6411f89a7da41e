//! Long explanations of the findings about frictions at contacts, pins and ropes, and about the law of a stop.

use words::explain::{Explanation, row};

/// The codes of `[frictions]` at places, and of `law`.
pub const RUBBING: &[Explanation] = &[
    row(
        "M120",
        ("what a friction acts between", "место трения"),
        (
            "A friction acts on a pathway (along, between, on), at a point or a named contact (at), in a pin (pin, radius) or between a rope and a drum \
             (rope, over): one of these, each with its own keys. direction and axes belong to a point, lever to a named contact, wrap to a rope.",
            "Трение действует на координате (along, between, on), в точке или названном контакте (at), в шарнире (pin, radius) либо между канатом и барабаном \
             (rope, over): одно из этого, у каждого свои ключи. direction и axes относятся к точке, lever — к названному контакту, wrap — к канату.",
        ),
        "[pins.O]\nbetween = [\"A\", \"ground\"]\n[frictions.j]\npin = \"O\"\ncoefficient = 0.1",
        "[pins.O]\nbetween = [\"A\", \"ground\"]\n[frictions.j]\npin = \"O\"\nradius = \"10 mm\"\ncoefficient = 0.1",
    ),
    row(
        "M121",
        ("a friction at something that is not there", "трение в отсутствующей связи"),
        (
            "at names a connection of [rolling] or [stops], pin one of [pins] or [supports], rope one of [ropes] or [threads].",
            "at называет связь из [rolling] или [stops], pin — из [pins] или [supports], rope — из [ropes] или [threads].",
        ),
        "[frictions.f]\nat = \"K\"\ncoefficient = 0.2",
        "[stops.K]\nalong = \"y(A)\"\nat_least = 0\n[frictions.f]\nat = \"K\"\ncoefficient = 0.2",
    ),
    row(
        "M122",
        ("a friction without a direction", "трение без направления"),
        (
            "The force at a point acts along one direction: an axis by its name (x, y, z, -x ...), a vector that is not zero, or an angle from the x axis of `axes`.",
            "Сила в точке действует вдоль одного направления: ось по имени (x, y, z, -x ...), ненулевой вектор или угол с осью x системы `axes`.",
        ),
        "[frictions.f]\nat = [\"A\", \"ground\"]\nkinetic = \"F\"",
        "[frictions.f]\nat = [\"A\", \"ground\"]\ndirection = \"x\"\nkinetic = \"F\"",
    ),
    row(
        "M123",
        ("the place of a contact is not known", "неизвестно место контакта"),
        (
            "A friction at a stop acts where the body touches. That follows from a stop written by points, along = \"y(A)\"; not from a formula of coordinates. \
             Where the limit of the stop is not zero, radius says whether the point itself touches (0) or a surface at that distance from it.",
            "Трение в упоре приложено там, где тело касается. Это следует из упора, заданного через точки, along = \"y(A)\", но не из формулы координат. \
             Если предел упора не нуль, radius указывает, касается ли сама точка (0) или поверхность на этом расстоянии от неё.",
        ),
        "[stops.K]\nalong = \"x\"\nat_least = 0\n[frictions.f]\nat = \"K\"\ncoefficient = 0.2",
        "[stops.K]\nalong = \"y(A)\"\nat_least = 0\n[frictions.f]\nat = \"K\"\ncoefficient = 0.2",
    ),
    row(
        "M124",
        ("a friction that nothing presses", "трение без прижимающей силы"),
        (
            "The named contact, pin or rope must have the force that presses: a wheel that its track holds, a pin, or a support with directions x and y.",
            "У названного контакта, шарнира или каната должна быть прижимающая сила: колесо, удерживаемое опорой, шарнир или опора с направлениями x и y.",
        ),
        "[supports.O]\nat = \"b\"\ndirections = [\"y\"]\n[frictions.j]\npin = \"O\"\nradius = \"10 mm\"\ncoefficient = 0.1",
        "[supports.O]\nat = \"b\"\ndirections = [\"x\", \"y\"]\n[frictions.j]\npin = \"O\"\nradius = \"10 mm\"\ncoefficient = 0.1",
    ),
    row(
        "M125",
        ("a friction beside its rope", "трение не на канате"),
        (
            "over names one inner point of the rope's path, or two, where it runs on and off, in the order of the path; the rope itself winds on no drum.",
            "over называет одну внутреннюю точку пути каната или две — набегания и сбегания — в порядке пути; сам канат не наматывается на барабаны.",
        ),
        "[ropes.R]\npath = [\"A\", \"ground\"]\n[frictions.f]\nrope = \"R\"\nover = \"ground\"\ncoefficient = 0.2",
        "[points]\nP = { on = \"ground\", at = [\"0\", \"2 m\"] }\n[ropes.R]\npath = [\"A\", \"P\", \"ground\"]\n[frictions.f]\nrope = \"R\"\nover = \"P\"\ncoefficient = 0.2",
    ),
    row(
        "M126",
        ("a friction in space without a direction", "трение в пространстве без направления"),
        (
            "One friction acts along one direction. In space a contact has two of them, a pin's force three components, a rope no plane: direction, wrap or a \
             pathway must say what is meant. Two frictions along two directions have a square of friction instead of a circle.",
            "Одно трение действует вдоль одного направления. В пространстве у контакта их два, у реакции шарнира три составляющие, у каната нет плоскости: \
             нужны direction, wrap или координата. Два трения по двум направлениям дают квадрат трения вместо круга.",
        ),
        "[coordinates]\nz = \"m\"\n[bodies.p]\norigin = [\"0\", \"0\", \"z\"]\nmass = \"1 kg\"\n[stops.K]\nalong = \"z(p)\"\nat_least = 0\n[frictions.f]\nat = \"K\"\ncoefficient = 0.2",
        "[coordinates]\nz = \"m\"\n[bodies.p]\norigin = [\"0\", \"0\", \"z\"]\nmass = \"1 kg\"\n[stops.K]\nalong = \"z(p)\"\nat_least = 0\n[frictions.f]\nat = \"K\"\ndirection = \"x\"\ncoefficient = 0.2",
    ),
    row(
        "M127",
        ("tangential restitution by Poisson's law", "касательное восстановление по закону Пуассона"),
        (
            "tangential_restitution is a ratio of sliding speeds and goes with Newton's law of restitution. By Poisson's law the friction obeys Coulomb's law \
             through both phases of the impact.",
            "tangential_restitution — отношение скоростей скольжения, оно относится к закону Ньютона. По закону Пуассона трение в обеих фазах удара подчиняется \
             закону Кулона.",
        ),
        "[stops.K]\nalong = \"x\"\nat_least = 0\nlaw = \"poisson\"\ntangential_restitution = 0.5",
        "[stops.K]\nalong = \"x\"\nat_least = 0\ntangential_restitution = 0.5",
    ),
    row(
        "M128",
        ("two frictions at one wheel", "два трения у одного колеса"),
        (
            "A friction that names a rolling contact is the tangential force of the wheel there: one friction a wheel. A moment against the rolling is another \
             one, with lever.",
            "Трение, называющее качение, — это сила сцепления колеса в этом контакте: одно трение на колесо. Момент против качения — другое трение, с lever.",
        ),
        "[rolling.R]\nbody = \"b\"\nradius = \"R\"\n[frictions.f]\nat = \"R\"\ncoefficient = 0.1\n[frictions.g]\nat = \"R\"\ncoefficient = 0.2",
        "[rolling.R]\nbody = \"b\"\nradius = \"R\"\n[frictions.f]\nat = \"R\"\ncoefficient = 0.1\n[frictions.g]\nat = \"R\"\nlever = \"1 mm\"",
    ),
    row(
        "M145",
        ("a rope that springs back over a rough drum", "отскакивающий канат на шероховатом барабане"),
        (
            "A rope that tightens with a blow and springs back (restitution above 0) leaves the strands before and behind the drum with different speeds. How the \
             rebound is shared depends on how each strand stretches, which a rope without mass and stretch does not know; the friction would be that of one strand \
             or the other, by the order of the path. Without rebound both strands have one speed.",
            "Канат, который натягивается рывком и отскакивает (restitution больше 0), оставляет ветвям до и после барабана разные скорости. Доли отскока зависят от \
             растяжимости ветвей, которой у невесомого нерастяжимого каната нет; трение определялось бы той или другой ветвью — порядком точек пути. Без отскока \
             у обеих ветвей одна скорость.",
        ),
        "[coordinates]\nx = \"m\"\ny = \"m\"\n[bodies.a]\norigin = [\"0\", \"x\"]\nmass = \"1 kg\"\n[bodies.b]\norigin = [\"1 m\", \"y\"]\nmass = \"1 kg\"\n[points]\nL = { at = [\"0\", \"3 m\"] }\nP = { at = [\"1 m\", \"3 m\"] }\n[ropes.R]\npath = [\"a\", \"L\", \"P\", \"b\"]\nrestitution = 0.5\n[frictions.f]\nrope = \"R\"\nover = \"P\"\ncoefficient = 0.2",
        "[coordinates]\nx = \"m\"\ny = \"m\"\n[bodies.a]\norigin = [\"0\", \"x\"]\nmass = \"1 kg\"\n[bodies.b]\norigin = [\"1 m\", \"y\"]\nmass = \"1 kg\"\n[points]\nL = { at = [\"0\", \"3 m\"] }\nP = { at = [\"1 m\", \"3 m\"] }\n[ropes.R]\npath = [\"a\", \"L\", \"P\", \"b\"]\n[frictions.f]\nrope = \"R\"\nover = \"P\"\ncoefficient = 0.2",
    ),
];
