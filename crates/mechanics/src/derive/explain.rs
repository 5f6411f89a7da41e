//! Long explanations of the findings of the derivation.

use words::explain::{Explanation, row};

/// The codes from M100 on.
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
             exists only where they turn against each other about one axis: one stands on the other, or the rotations of both are the same up to \
             that axis. Otherwise write the pathway as a formula: along = \"...\".",
            "Элемент между двумя телами действует через их относительный угол. На плоскости это разность углов. В пространстве он определён, \
             только если тела поворачиваются относительно друг друга вокруг одной оси: одно стоит на другом или повороты обоих до этой оси \
             одинаковы. Иначе задайте координату элемента формулой: along = \"...\".",
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
    row(
        "M114",
        ("gears that do not mesh", "колёса не входят в зацепление"),
        (
            "Two gears touch at the pitch point, so their axes are r1 + r2 apart, in an internal pair |r1 - r2|. Other distances leave it open where the \
             tooth force acts. When only the ratio counts, draw both wheels at one origin: then no line of centres is asked.",
            "Два зубчатых колеса касаются в полюсе зацепления, поэтому межосевое расстояние равно r1 + r2, а при внутреннем зацеплении |r1 - r2|. При \
             ином расстоянии неизвестно, где приложено усилие в зубьях. Если важно только передаточное отношение, поместите колёса в одно начало.",
        ),
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\ninertia = \"1 kg m^2\"\n[bodies.B]\norigin = [\"0.5 m\", \"0\"]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[gears.g]\nbetween = [\"A\", \"B\"]\nradii = [\"0.1 m\", \"0.3 m\"]",
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\ninertia = \"1 kg m^2\"\n[bodies.B]\norigin = [\"0.4 m\", \"0\"]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[gears.g]\nbetween = [\"A\", \"B\"]\nradii = [\"0.1 m\", \"0.3 m\"]",
    ),
    row(
        "M116",
        ("a wheel without the axis that its drive needs", "у колеса нет оси, которой требует передача"),
        (
            "Belts, chains and gears join two bodies that turn against each other about one axis, and a wheel rolls in the plane of its track. In space \
             that axis is an own x, y or z axis of each body, and the two stay parallel however the machine moves. Bodies with crossing axes (bevel \
             gears, worms), bodies that tumble, and spheres have no such axis: their condition is written out in [constraints].",
            "Ремни, цепи и зубчатые пары соединяют два тела, которые вращаются друг относительно друга вокруг одной оси, а колесо катится в \
             плоскости своей опоры. В пространстве это собственная ось x, y или z каждого из тел, и при любом движении эти оси остаются \
             параллельными. У тел с пересекающимися осями (конические колёса, червяк), у свободно вращающихся тел и у шаров такой оси нет: \
             условие записывают в [constraints].",
        ),
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nrotate = [\"x: a\"]\nshape = \"disc(1 [m])\"\nmass = \"1 kg\"\n\
         [bodies.B]\nrotate = [\"y: b\"]\nshape = \"disc(1 [m])\"\nmass = \"1 kg\"\n[gears.g]\nbetween = [\"A\", \"B\"]\nradii = [\"1 m\", \"1 m\"]",
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nrotate = [\"x: a\"]\nshape = \"disc(1 [m])\"\nmass = \"1 kg\"\n\
         [bodies.B]\nrotate = [\"y: b\"]\nshape = \"disc(1 [m])\"\nmass = \"1 kg\"\n[constraints.bevel]\nzero_rate = \"1[m]*a' + 1[m]*b'\"",
    ),
    row(
        "M117",
        ("what a wheel or drum counts from is unknown or wrong", "неизвестно или неверно указано, от чего отсчитывать повороты"),
        (
            "Wheels of a drive turn against the line of their centres, and so against the body that carries both axes; a drum turns against the piece of \
             rope that runs to it. Where the model shows that body, nothing need be said. It must be named where the wheels are drawn at one place \
             and one of them stands on a turning body, and where a drum moves but no end of the rope's path moves with what carries it. A body \
             against which the axes move cannot be the carrier.",
            "Колёса передачи поворачиваются относительно линии центров, то есть относительно тела, несущего обе оси; барабан — относительно \
             набегающей ветви каната. Если это тело видно из модели, указывать ничего не нужно. Его нужно назвать, если колёса помещены в одну \
             точку и одно из них стоит на вращающемся теле, и если барабан движется, а ни один конец ломаной не движется с несущим его телом. \
             Тело, относительно которого оси движутся, водилом быть не может.",
        ),
        "[coordinates]\ns = \"rad\"\nc = \"rad\"\np = \"rad\"\n[bodies.sun]\nangle = \"s\"\ninertia = \"1 kg m^2\"\n[bodies.arm]\nangle = \"c\"\n\
         inertia = \"1 kg m^2\"\n[bodies.planet]\non = \"arm\"\nangle = \"p\"\ninertia = \"1 kg m^2\"\n[gears.g]\nbetween = [\"sun\", \"planet\"]\n\
         radii = [\"1 m\", \"2 m\"]",
        "[coordinates]\ns = \"rad\"\nc = \"rad\"\np = \"rad\"\n[bodies.sun]\nangle = \"s\"\ninertia = \"1 kg m^2\"\n[bodies.arm]\nangle = \"c\"\n\
         inertia = \"1 kg m^2\"\n[bodies.planet]\non = \"arm\"\nangle = \"p\"\ninertia = \"1 kg m^2\"\n[gears.g]\nbetween = [\"sun\", \"planet\"]\n\
         radii = [\"1 m\", \"2 m\"]\ncarrier = \"arm\"",
    ),
    row(
        "M118",
        ("what rolls together moves apart", "то, что катится друг по другу, расходится"),
        (
            "Gears, belts and chains need a constant distance of their axes, and a wheel rolls in the plane of its track. A coordinate moves the \
             axes, or the wheel along its axis, and no other connection holds it.",
            "Зубчатым парам, ремням и цепям нужно постоянное межосевое расстояние, а колесо катится в плоскости своей опоры. Одна из координат \
             сдвигает оси или само колесо вдоль его оси, и никакая другая связь этого не запрещает.",
        ),
        "[coordinates]\na = \"rad\"\nb = \"rad\"\nx = \"m\"\n[bodies.A]\nangle = \"a\"\ninertia = \"1 kg m^2\"\n[bodies.B]\norigin = [\"2[m] + x\", \"0\"]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[belts.s]\nbetween = [\"A\", \"B\"]\nradii = [\"1 m\", \"1 m\"]",
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\ninertia = \"1 kg m^2\"\n[bodies.B]\norigin = [\"2 m\", \"0\"]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[belts.s]\nbetween = [\"A\", \"B\"]\nradii = [\"1 m\", \"1 m\"]",
    ),
    row(
        "M119",
        ("what is kept from the start is only guessed", "сохраняется то, что в начале задано лишь приближённо"),
        (
            "A weld or a slider with turns = false keeps the angle of the start, a slider without `through` the line through its place at the start. \
             Coordinates with `guess` are found by closing the connections, so their rough values, and what the \
             closing makes of them, become geometry. Give such coordinates `start`, or say the angle or the point.",
            "Жёсткое соединение и ползун с turns = false сохраняют угол начала движения, ползун без `through` — прямую через место точки в начале. \
             Координаты с `guess` находятся замыканием связей, поэтому их грубые значения и то, что сделает из них \
             замыкание, становятся геометрией. Задайте таким координатам `start` либо укажите угол или точку.",
        ),
        "[coordinates]\na = { unit = \"rad\", guess = \"0.3\" }\nx = \"m\"\n[bodies.A]\norigin = [\"x\", \"0\"]\nangle = \"a\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n\
         [points]\nO = { at = [0, 0] }\n[sliders.s]\npoint = \"A\"\nthrough = \"O\"\nturns = false",
        "[coordinates]\na = { unit = \"rad\", start = \"0.3\" }\nx = \"m\"\n[bodies.A]\norigin = [\"x\", \"0\"]\nangle = \"a\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n\
         [points]\nO = { at = [0, 0] }\n[sliders.s]\npoint = \"A\"\nthrough = \"O\"\nturns = false",
    ),
    row(
        "M129",
        ("tensions without a direction", "натяжения без направления"),
        (
            "A belt with `pretension` and a chain with `tight` pull their axles towards each other along the line of the centres. Wheels that are drawn at one place \
             because only their ratio counts have no such line. Give them their places.",
            "Ремень с ключом `pretension` и цепь с ключом `tight` стягивают оси вдоль линии центров. У колёс, изображённых в одном месте, потому что важно лишь \
             передаточное отношение, такой линии нет. Задайте их положения.",
        ),
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[bodies.B]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[belts.s]\nbetween = [\"A\", \"B\"]\nradii = [\"0.1 m\", \"0.2 m\"]\npretension = \"50 N\"",
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[bodies.B]\norigin = [\"2 m\", \"0\"]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[belts.s]\nbetween = [\"A\", \"B\"]\nradii = [\"0.1 m\", \"0.2 m\"]\npretension = \"50 N\"",
    ),
    row(
        "M130",
        ("circles that no belt fits", "окружности, на которые ремень не надеть"),
        (
            "The strands of a belt or chain touch both wheels: sin β = (r1 − r2)/d, for a crossed belt (r1 + r2)/d, with the distance d of the axes. There is no such line \
             where the distance is not larger than that. Correct a radius or a place.",
            "Ветви ремня или цепи касаются обоих колёс: sin β = (r1 − r2)/d, у перекрёстного ремня (r1 + r2)/d, где d – межосевое расстояние. Если расстояние не больше \
             этой величины, такой прямой нет. Исправьте радиус или положение.",
        ),
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[bodies.B]\norigin = [\"0.25 m\", \"0\"]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[belts.s]\nbetween = [\"A\", \"B\"]\nradii = [\"0.1 m\", \"0.2 m\"]\ncrossed = true\npretension = \"50 N\"",
        "[coordinates]\na = \"rad\"\nb = \"rad\"\n[bodies.A]\nangle = \"a\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[bodies.B]\norigin = [\"0.5 m\", \"0\"]\n\
         angle = \"b\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n[belts.s]\nbetween = [\"A\", \"B\"]\nradii = [\"0.1 m\", \"0.2 m\"]\ncrossed = true\npretension = \"50 N\"",
    ),
    row(
        "M158",
        ("where a rope leaves its drum is not known", "неизвестно, где канат сходит с барабана"),
        (
            "A rope that winds gives its drum the couple of the tension; a support, pin or journal of the drum alone also feels the pull. Its line is known where the path \
             begins on the drum's circle, across the rope, and then the pull acts there. Elsewhere the force of the axle does not follow.",
            "Наматываемый канат передаёт барабану момент натяжения; опора, шарнир или цапфа самого барабана воспринимают и натяжение. Его линия известна, если путь \
             начинается на окружности барабана, поперёк каната: тогда натяжение приложено там. В остальных случаях сила в оси не определяется.",
        ),
        "[coordinates]\nc = \"rad\"\ny = { unit = \"m\", start = \"-1 m\" }\n[bodies.drum]\nangle = \"c\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n\
         [bodies.load]\norigin = [\"0.3 m\", \"y\"]\nmass = \"1 kg\"\n[points]\nP = { at = [\"0.3 m\", \"0\"] }\n\
         [ropes.r]\npath = [\"P\", \"load\"]\nwound = [{ on = \"drum\", radius = \"0.2 m\" }]\n[supports.O]\nat = \"drum\"\ndirections = [\"x\", \"y\"]",
        "[coordinates]\nc = \"rad\"\ny = { unit = \"m\", start = \"-1 m\" }\n[bodies.drum]\nangle = \"c\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n\
         [bodies.load]\norigin = [\"0.2 m\", \"y\"]\nmass = \"1 kg\"\n[points]\nP = { at = [\"0.2 m\", \"0\"] }\n\
         [ropes.r]\npath = [\"P\", \"load\"]\nwound = [{ on = \"drum\", radius = \"0.2 m\" }]\n[supports.O]\nat = \"drum\"\ndirections = [\"x\", \"y\"]",
    ),
    row(
        "M151",
        ("what holds a mounted body is not known", "неизвестно, что удерживает установленное тело"),
        (
            "A body whose `origin` is the name of a point of another body has two partners: the body of the point carries it, `on` gives it its axes. A force at \
             the mount is that of the joint with the first; at other places `on` holds. A support against turning is that of `on`, as the angle counts \
             from there; but where the two partners do not turn against each other the joint at the mount may be a weld, and the moment comes from the \
             other body. The same holds for a frame that is no body and is mounted at a point: it gives no reaction of its own. Say which it is: `on` of the \
             support, or declare the joint by [pins] or [welds].",
            "У тела, у которого `origin` — имя точки другого тела, два партнёра: тело этой точки несёт его, а от `on` отсчитываются оси. Сила в точке установки — \
             сила шарнира с первым; в остальных местах удерживает `on`. От поворота тоже удерживает `on`, потому что угол отсчитывается от него; но если \
             партнёры не поворачиваются друг относительно друга, соединение может быть жёстким, и момент передаёт первое тело. То же относится к системе \
             отсчёта, которая не является телом и помещена в точку тела: своих реакций у неё нет. Укажите, что имеется в виду: ключ `on` опоры \
             либо соединение в [pins] или [welds].",
        ),
        "[coordinates]\nx = \"m\"\n[bodies.cart]\norigin = [\"x\", \"0\"]\nmass = \"2 kg\"\n[points]\nC = { on = \"cart\", at = [\"0\", \"1 m\"] }\n\
         [bodies.bar]\norigin = \"C\"\nmass = \"1 kg\"\ncenter = [\"0.5 m\", \"0\"]\n[supports.s]\nat = \"bar\"\ndirections = [\"x\", \"y\", \"turn\"]",
        "[coordinates]\nx = \"m\"\n[bodies.cart]\norigin = [\"x\", \"0\"]\nmass = \"2 kg\"\n[points]\nC = { on = \"cart\", at = [\"0\", \"1 m\"] }\n\
         [bodies.bar]\norigin = \"C\"\nmass = \"1 kg\"\ncenter = [\"0.5 m\", \"0\"]\n[supports.s]\nat = \"bar\"\ndirections = [\"x\", \"y\", \"turn\"]\non = \"cart\"",
    ),
];
