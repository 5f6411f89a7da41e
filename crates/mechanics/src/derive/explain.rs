//! Long explanations of what can go wrong in a derivation.

use crate::explain::Explanation;

/// The codes of `derive`.
pub const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "M100",
        title: ("a coordinate without inertia", "координата без инерции"),
        text: (
            "When this coordinate changes, no body with mass or moment of inertia moves, so that nothing determines its acceleration. Often a body has \
             no mass yet, or a point mass sits on the axis about which it turns.",
            "При изменении этой координаты не движется ни одно тело, имеющее массу или момент инерции, и её ускорение ничем не определено. Чаще всего телу \
             ещё не задана масса или точечная масса лежит на оси поворота.",
        ),
        wrong: "[coordinates]\nphi = \"rad\"\n\n[bodies.arm]\nangle = \"phi\"",
        right: "[coordinates]\nphi = \"rad\"\n\n[bodies.arm]\nangle = \"phi\"\ninertia = \"2 kg m^2\"",
    },
    Explanation {
        code: "M101",
        title: ("one moment of inertia for a body that turns in space", "один момент инерции у тела, вращающегося в пространстве"),
        text: (
            "A single moment of inertia describes turning about the z axis only. This body also turns about x or y, so its whole tensor is needed, or a \
             shape from which it follows.",
            "Один момент инерции описывает только поворот вокруг оси z. Это тело поворачивается и вокруг x или y, поэтому нужен весь тензор инерции или форма, \
             по которой он вычисляется.",
        ),
        wrong: "[coordinates]\ntheta = \"rad\"\n\n[bodies.top]\nrotate = [\"x: theta\"]\nmass = \"1 kg\"\ninertia = \"2 kg m^2\"",
        right: "[coordinates]\ntheta = \"rad\"\n\n[bodies.top]\nrotate = [\"x: theta\"]\nmass = \"1 kg\"\nshape = \"disc(0.1 [m])\"",
    },
    Explanation {
        code: "M102",
        title: ("no single angle between two bodies", "между телами нет единственного угла"),
        text: (
            "An element between two bodies acts through their relative angle. In space that angle exists only when one body stands on the other and turns \
             about one axis. Otherwise name the angle by a formula.",
            "Элемент между двумя телами действует через их относительный угол. В пространстве такой угол есть, только если одно тело стоит на другом и \
             поворачивается вокруг одной оси. В остальных случаях угол задают формулой.",
        ),
        wrong: "",
        right: "along = \"psi - theta\"",
    },
    Explanation {
        code: "M103",
        title: ("a quantity that is not known here", "величина, которая здесь неизвестна"),
        text: (
            "Energies and the forces of elements follow from the equations, so only outputs may use them. The function `angle` exists for bodies that turn \
             in the plane.",
            "Энергии и силы в элементах находятся после вывода уравнений, поэтому доступны только в outputs. Функция `angle` определена для тел, которые \
             поворачиваются в плоскости.",
        ),
        wrong: "",
        right: "[outputs]\nE = \"kinetic_energy() + potential_energy()\"",
    },
];
