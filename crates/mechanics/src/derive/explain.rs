//! Long explanations of the findings of the derivation.

use crate::explain::{Explanation, row};

/// The codes M100 to M199.
pub const EXPLANATIONS: &[Explanation] = &[
    row(
        "M100",
        ("nothing gives inertia to a coordinate", "координате ничто не придаёт инерции"),
        (
            "When this coordinate changes, no mass moves and nothing with a moment of inertia turns, so Newton's law says nothing about its \
             acceleration. Either a body is massless that should not be, or the position of the body does not use the coordinate, or the \
             coordinate is superfluous.",
            "При изменении этой координаты не движется ни одна масса и не поворачивается ни одно тело с моментом инерции, поэтому её \
             ускорение не определено. Либо у тела не задана масса, либо положение тела не зависит от этой координаты, либо координата лишняя.",
        ),
        "[coordinates]\nphi = \"rad\"\n[bodies.arm]\nangle = \"phi\"",
        "[coordinates]\nphi = \"rad\"\n[bodies.arm]\nangle = \"phi\"\nmass = \"2 kg\"\ncenter = [\"0.5 m\", \"0\"]",
    ),
    row(
        "M101",
        ("one moment of inertia is not enough in space", "в пространстве одного момента инерции мало"),
        (
            "A single number for `inertia` (or a radius of gyration) is the moment about the body's z axis. This body also turns about its x or \
             y axis, and its inertia there is unknown. Give the tensor, or a shape, which has all three moments.",
            "Одно число в `inertia` (или радиус инерции) – это момент относительно оси z тела. Это тело поворачивается и вокруг оси x или y, \
             а момент инерции относительно них не задан. Задайте тензор или форму: у неё известны все три момента.",
        ),
        "[coordinates]\na = \"rad\"\n[bodies.b]\nrotate = [\"x: a\"]\ninertia = \"1 kg m^2\"",
        "[coordinates]\na = \"rad\"\n[bodies.b]\nrotate = [\"x: a\"]\ninertia = { xx = \"1 kg m^2\", yy = \"1 kg m^2\", zz = \"1 kg m^2\" }",
    ),
    row(
        "M102",
        ("two bodies have no single relative angle", "у двух тел нет единственного относительного угла"),
        (
            "An element between two bodies acts through their relative angle. In the plane that is the difference of their angles. In space it \
             exists only between a body and the one it stands on, and only if it turns there about one axis. Otherwise write the pathway as a \
             formula: along = \"...\".",
            "Элемент между двумя телами действует через их относительный угол. На плоскости это разность углов. В пространстве он определён \
             только для тела и того, на чём оно стоит, если поворот происходит вокруг одной оси. Иначе задайте координату элемента формулой: along = \"...\".",
        ),
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.B]\nrotate = [\"x: a\", \"y: b\"]\nmass = \"1 kg\"\nshape = \"box(1 [m], 1 [m], 1 [m])\"\n\
         [springs.s]\nbetween = [\"ground\", \"B\"]\nstiffness = \"1 N m\"",
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.B]\nrotate = [\"x: a\", \"y: b\"]\nmass = \"1 kg\"\nshape = \"box(1 [m], 1 [m], 1 [m])\"\n\
         [springs.s]\nalong = \"a\"\nstiffness = \"1 N m\"",
    ),
    row(
        "M103",
        ("a kinematic function is not available", "кинематическая функция недоступна"),
        (
            "`angle(B)` is the angle of a body in the plane; a body that turns in space has none. Forces of elements and energies are known \
             only when the equations are derived, so a force cannot depend on itself through them.",
            "`angle(B)` – угол тела на плоскости; у тела, вращающегося в пространстве, его нет. Силы элементов и энергии известны только после \
             вывода уравнений, поэтому сила не может зависеть через них от самой себя.",
        ),
        "[coordinates]\na = \"rad\"\n[bodies.B]\nrotate = [\"x: a\"]\nmass = \"1 kg\"\nshape = \"sphere(1 [m])\"\n[outputs]\nw = \"angle(B)\"",
        "[coordinates]\na = \"rad\"\n[bodies.B]\nrotate = [\"x: a\"]\nmass = \"1 kg\"\nshape = \"sphere(1 [m])\"\n[outputs]\nw = \"a\"",
    ),
    row(
        "M104",
        ("a connection that no coordinate can satisfy", "связь, на которую не влияет ни одна координата"),
        (
            "The condition of this connection contains no coordinate: all that it joins stands still, or moves as prescribed. It either holds \
             always, and then there is nothing to find, or never. Give one of the partners a coordinate, or ask for the reaction by [supports].",
            "В условие этой связи не входит ни одна координата: всё, что она соединяет, неподвижно или движется заданным образом. Такое \
             условие либо выполнено всегда, и искать нечего, либо никогда. Дайте одному из тел координату или введите реакцию через [supports].",
        ),
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[stops.k]\nalong = \"1[m]*sin(t*1[1/s])\"\nat_least = \"-2 m\"",
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[stops.k]\nalong = \"x - 1[m]*sin(t*1[1/s])\"\nat_least = \"-2 m\"",
    ),
    row(
        "M105",
        ("as many motors as prescribed motions", "двигателей столько же, сколько заданных движений"),
        (
            "Each row of [motions] takes one degree of freedom away, and one unknown force or torque of [motors] must realise it. With fewer \
             motors the motion cannot be realised, with more the forces are not unique.",
            "Каждая строка [motions] отнимает одну степень свободы, и осуществлять её должна одна неизвестная сила или момент из [motors]. \
             Если двигателей меньше, движение неосуществимо, если больше — усилия определены неоднозначно.",
        ),
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[motions.go]\nalong = \"x\"\nvalue = \"1[m/s]*t\"",
        "[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n[motions.go]\nalong = \"x\"\nvalue = \"1[m/s]*t\"\n[motors.push]\nalong = \"x\"",
    ),
];
