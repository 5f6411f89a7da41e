//! Long explanations of the codes from M060 on: studies, plots, values set by hand, connections and their loads.

use words::explain::{Explanation, row};

/// The codes of the reader from M060 on.
pub const STUDIES: &[Explanation] = &[
    row(
        "M060",
        ("an axis is needed", "нужна ось"),
        ("Axes are x, y and z. A rotation is written \"axis: angle\".", "Оси: x, y и z. Поворот пишут \"ось: угол\"."),
        "rotate = [\"psi\"]",
        "rotate = [\"z: psi\"]",
    ),
    row(
        "M061",
        ("angle and rotate together", "angle и rotate вместе"),
        (
            "`angle` is short for one turn about z; with `rotate` it would be unclear which comes first.",
            "`angle` — сокращение для поворота вокруг z; вместе с `rotate` неясен порядок.",
        ),
        "angle = \"phi\"\nrotate = [\"x: psi\"]",
        "rotate = [\"z: phi\", \"x: psi\"]",
    ),
    row(
        "M062",
        ("a force needs a point or a pathway", "силе нужна точка или координата"),
        (
            "A force is a vector at a point (`at`), or acts along a pathway (`along`, `between`).",
            "Сила — вектор в точке (`at`) либо действует вдоль координаты (`along`, `between`).",
        ),
        "[forces.F]\nvalue = \"5 N\"",
        "[forces.F]\nalong = \"x\"\nvalue = \"5 N\"",
    ),
    row(
        "M063",
        ("both ends on the same thing", "оба конца на одном теле"),
        ("An element or a torque between a thing and itself does nothing.", "Элемент или момент между телом и им самим не действует."),
        "between = [\"A\", \"A\"]",
        "between = [\"A\", \"B\"]",
    ),
    row(
        "M064",
        ("unknown study", "неизвестный расчёт"),
        (
            "`kind` is not the name of a study. docs/model-file/studies.md has all of them with their keys, and `strutt help` lists their commands.",
            "`kind` – не название расчёта. Все расчёты с их ключами перечислены в docs/model-file/studies.ru.md, их команды – в `strutt help`.",
        ),
        "kind = \"simulat\"",
        "kind = \"simulate\"",
    ),
    row(
        "M065",
        ("times, tolerance or method of a study", "времена, точность или метод расчёта"),
        (
            concat!(
                "Durations are positive, times ascend up to the end of the motion, the tolerance lies between ",
                words::finest_tolerance!(),
                " and ",
                words::coarsest_tolerance!(),
                ", and the method is auto, taylor or stiff."
            ),
            concat!(
                "Длительности положительны, моменты времени возрастают до конца движения, допустимая погрешность – от ",
                words::finest_tolerance!(),
                " до ",
                words::coarsest_tolerance!(),
                ", метод — auto, taylor или stiff."
            ),
        ),
        "until = \"-1 s\"",
        "until = \"1 s\"",
    ),
    row(
        "M066",
        ("unknown result", "неизвестный результат"),
        (
            "Results are coordinates, their rates and outputs. A parameter or a formula becomes a result in [outputs].",
            "Результаты — координаты, их скорости и выходные величины. Параметр или формула становится результатом в [outputs].",
        ),
        "plot = [\"omega\"]",
        "[outputs]\nspeed = \"omega\"\n# plot = [\"speed\"]",
    ),
    row(
        "M067",
        ("too many rows", "слишком много строк"),
        (
            "More than ten million rows of results would not fit in memory.",
            "Более десяти миллионов строк результата не поместятся в память.",
        ),
        "every = \"1 ns\"",
        "every = \"1 ms\"",
    ),
    row(
        "M068",
        ("a value set by hand", "значение, заданное вручную"),
        (
            "--set takes name=quantity, where the name is a parameter, a coordinate (its start) or phi' (its rate). Bare numbers are SI; \
             where the file uses another unit (deg, g) the unit must be written.",
            "--set принимает имя=величина, где имя — параметр, координата (начальное значение) или phi' (начальная скорость). \
             Числа без единиц — в СИ; если в файле другая единица (deg, г), её нужно написать.",
        ),
        "--set mas=3",
        "--set m=3kg",
    ),
    row(
        "M069",
        ("the model is too large", "модель слишком велика"),
        (
            "Outputs of outputs are expanded; here they grow beyond five million terms. Parameters are not expanded.",
            "Выходные величины внутри других раскрываются; здесь получается больше пяти миллионов слагаемых. Параметры не раскрываются.",
        ),
        "",
        "",
    ),
    row(
        "M377",
        ("no window of time", "не промежуток времени"),
        (
            "max, min, amplitude and mean of a result may be taken between two instants: mean(x, 20 s, 30 s). The instants count from the start of the motion, the first is the earlier \
             one, and both lie inside the motion. last(x) is the value at the end and takes no instants. With semicolons between the parts commas are decimal marks.",
            "max, min, amplitude и mean можно брать между двумя моментами: mean(x, 20 с, 30 с). Моменты отсчитываются от начала движения, первый — более ранний, оба \
             лежат внутри движения. last(x) — значение в конце, моментов у него нет. Если части разделены точкой с запятой, запятая отделяет дробную часть.",
        ),
        "observe = [\"mean(x, 30 s, 20 s)\"]",
        "observe = [\"mean(x, 20 s, 30 s)\"]",
    ),
    row(
        "M378",
        ("no number in a regime", "в условии режима нет числа движения"),
        (
            "A regime is a condition on numbers of a motion: mean, max, min, amplitude or last of a result, between two instants or over the whole motion. A condition without one holds \\
             always or never.",
            "Режим — условие на числа движения: mean, max, min, amplitude или last от величины, между двумя моментами или за всё движение. Условие без такого числа выполнено \\
             всегда или никогда.",
        ),
        "[regimes]\nfast = \"2 > 1\"",
        "[regimes]\nfast = \"mean(x', 1 s, 2 s) > 1 [m/s]\"",
    ),
    row(
        "M070",
        ("no range of values", "не набор значений"),
        (
            "A range is name=linspace(first, last, number), name=logspace(first, last, number) with positive ends, name=value, value, or drawn values: name=uniform(from, to, number, seed), name=normal(mean, deviation, number, seed), the same for the same seed. With semicolons between the values commas are decimal marks.",
            "Набор значений: имя=linspace(первое, последнее, число), имя=logspace(первое, последнее, число) с положительными концами, имя=значение, значение или случайные значения: имя=uniform(от, до, число, начальное), имя=normal(среднее, отклонение, число, начальное), одни и те же при одном начальном числе датчика. Если значения разделены точкой с запятой, запятая отделяет дробную часть.",
        ),
        "over = \"l=1 m..3 m\"",
        "over = \"l=linspace(1 m, 3 m, 21)\"",
    ),
    row(
        "M071",
        ("keys of a study that do not agree", "несогласованные ключи расчёта"),
        (
            "The study lacks a key, has two that exclude each other, or a number outside its limits: turns belong to angles, ranges are not empty, an irregularity lies between 0 and 2.",
            "В расчёте не хватает ключа, два ключа исключают друг друга или число вне пределов: обороты бывают у углов, промежуток не пуст, неравномерность — от 0 до 2.",
        ),
        "kind = \"periodic\"\nunknown = \"F0\"\nsection = \"phi\"",
        "kind = \"periodic\"\nunknown = \"F0\"\nwanted_period = \"0.2568 s\"\nsection = \"phi\"",
    ),
    row(
        "M072",
        ("no constant parameter of that name", "нет такого постоянного параметра"),
        (
            "What a study looks for is one number: a constant of [parameters]. A value that depends on time or on the motion contains such constants.",
            "Расчёт ищет одно число: постоянную из [parameters]. Величина, зависящая от времени или движения, содержит такие постоянные.",
        ),
        "unknown = \"phi\"",
        "unknown = \"F0\"",
    ),
    row(
        "M073",
        ("points that move as one", "точки, которые движутся как одно целое"),
        (
            "The ends of the connection belong to one body, or to bodies that never move against each other. The connection would hold nothing, and its reaction could have any value.",
            "Концы связи принадлежат одному телу или телам, неподвижным друг относительно друга. Связь ничего не удерживает, а её реакция может быть любой.",
        ),
        "[points]\nA = { on = \"crank\", at = [0, 0] }\nB = { on = \"crank\", at = [\"r\", 0] }\n[pins.P]\nbetween = [\"A\", \"B\"]",
        "[points]\nA = { on = \"crank\", at = [\"r\", 0] }\nB = { on = \"rod\", at = [0, 0] }\n[pins.P]\nbetween = [\"A\", \"B\"]",
    ),
    row(
        "M074",
        ("a radius or length that is not positive", "радиус или длина не положительны"),
        (
            "Radii of wheels and drums and lengths of rods and ropes are positive; a wheel inside a circle is smaller than the circle. Directions of turning are said by words (`crossed`, `internal`, `turns_in`), not by signs.",
            "Радиусы колёс и барабанов, длины стержней и канатов положительны; колесо внутри окружности меньше неё. Направления вращения задаются словами (`crossed`, `internal`, `turns_in`), а не знаками.",
        ),
        "radii = [\"l\", \"-R\"]",
        "radii = [\"l\", \"R\"]\ncrossed = true",
    ),
    row(
        "M075",
        ("a word that is not possible", "недопустимое слово"),
        (
            "The key takes one of a few words: `side` is left or right, `turns_in` is + or -, directions of a support are x, y, z, turn, turn_x, turn_y, turn_z.",
            "Ключ принимает одно из немногих слов: `side` — left или right, `turns_in` — + или -, направления опоры — x, y, z, turn, turn_x, turn_y, turn_z.",
        ),
        "directions = [\"x\", \"rotation\"]",
        "directions = [\"x\", \"turn\"]",
    ),
    row(
        "M076",
        ("a reaction where it cannot be used", "реакция там, где её нельзя использовать"),
        (
            "Reactions are found together with the accelerations. What decides the motion cannot depend on them, with one exception: the normal force of dry friction.",
            "Реакции находятся вместе с ускорениями. То, что определяет движение, не может от них зависеть, за одним исключением: нормальная сила сухого трения.",
        ),
        "[forces.F]\nalong = \"x\"\nvalue = \"-0.2*force(guide)\"",
        "[frictions.F]\nalong = \"x\"\ncoefficient = 0.2\nnormal = \"force(guide)\"",
    ),
    row(
        "M077",
        ("no such component of a reaction", "нет такой компоненты реакции"),
        (
            "Each kind of connection has its own components: pins force_x, force_y, rods and ropes force, rolling contacts normal and tangential, welds and clamps also moment. A prescribed motion has none: its motor has.",
            "У каждого вида связи свои компоненты: у шарниров force_x, force_y, у стержней и канатов force, у катящихся колёс normal и tangential, у заделок ещё moment. У заданного движения их нет: они у двигателя.",
        ),
        "S = \"normal(AB)\"",
        "S = \"force(AB)\"",
    ),
    row(
        "M078",
        ("a point that is not fixed in the frame", "точка не закреплена в системе отсчёта"),
        (
            "The point of a guide, a slot or a track lies on the line, which belongs to the frame under `on`; so does the centre of a circular track.",
            "Точка направляющей, паза или опоры лежит на прямой, а прямая принадлежит системе из `on`; то же для центра круговой опоры.",
        ),
        "[sliders.C]\npoint = \"A\"\non = \"ground\"\nthrough = \"B\"  # on the crank",
        "[sliders.C]\npoint = \"A\"\non = \"crank\"\nthrough = \"B\"",
    ),
    row(
        "M079",
        ("restitution outside 0 ... 1", "коэффициент восстановления вне 0 ... 1"),
        (
            "The restitution is the ratio of the rates after and before an impact: 0 sticks, 1 loses no energy.",
            "Коэффициент восстановления — отношение скоростей после и до удара: 0 — абсолютно неупругий удар, 1 — абсолютно упругий (без потерь энергии).",
        ),
        "restitution = 1.2",
        "restitution = 0.8",
    ),
    row(
        "M080",
        ("keys that exclude each other", "ключи, исключающие друг друга"),
        (
            "Exactly one of two keys is needed: `zero` or `zero_rate`, `value` or `rate`, `at_least` or `at_most`, a line or a circle, friction as a force or by a coefficient with a normal force.",
            "Нужен ровно один из двух ключей: `zero` или `zero_rate`, `value` или `rate`, `at_least` или `at_most`, прямая или окружность, трение силой или коэффициентом с нормальной силой.",
        ),
        "[stops.s]\nalong = \"x\"",
        "[stops.s]\nalong = \"x\"\nat_least = 0",
    ),
    row(
        "M081",
        ("a support that cannot be", "невозможная опора"),
        (
            "A support holds at least one direction, each once, at a point of a body.",
            "Опора удерживает хотя бы одно направление, каждое один раз, в точке тела.",
        ),
        "directions = [\"x\", \"x\"]",
        "directions = [\"x\", \"y\"]",
    ),
    row(
        "M082",
        ("a rope from nowhere to nowhere", "канат из ниоткуда в никуда"),
        (
            "The path of a rope has two points at least. A rope that winds on a drum leaves it at a point, which begins the path. Only a rope between two drums has no path.",
            "В пути каната не меньше двух точек. Канат, наматывающийся на барабан, сходит с него в точке, с которой путь начинается. Без пути — только канат между двумя барабанами.",
        ),
        "[ropes.R]\npath = [\"A\"]",
        "[ropes.R]\npath = [\"edge\", \"A\"]\nwound = [{ on = \"drum\", radius = \"R\" }]",
    ),
    row(
        "M083",
        ("a condition that is none", "условие, которое не является связью"),
        (
            "A constraint depends on coordinates, or linearly on rates. A constant condition holds always or never; a product of rates does not forbid a direction of motion.",
            "Связь зависит от координат или линейно от скоростей. Постоянное условие выполнено всегда или никогда; произведение скоростей не запрещает направления движения.",
        ),
        "zero_rate = \"x'^2 - l^2*phi'^2\"",
        "zero_rate = \"x' - l*phi'\"",
    ),
    row(
        "M084",
        ("u has two meanings", "у u два значения"),
        (
            "In laws of dry friction `u` is the sliding speed. A parameter or coordinate of that name would be hidden.",
            "В законах сухого трения `u` — скорость скольжения. Параметр или координата с этим именем были бы скрыты.",
        ),
        "[parameters]\nu = \"1 m/s\"\n[frictions.F]\nalong = \"x\"\nkinetic = \"F2*(1 + u/v0)\"",
        "[parameters]\nu_1 = \"1 m/s\"",
    ),
    row(
        "M085",
        ("a normal force that is not linear", "нелинейная нормальная сила"),
        (
            "Friction and reactions are found together from linear equations, so that the normal force is linear in the reactions. Its magnitude is taken in any case. \
             The force of a slider is one component in the plane; in space, where the guide holds in two directions, it is a magnitude.",
            "Трение и реакции находятся вместе из линейных уравнений, поэтому нормальная сила линейна по реакциям. Модуль берётся в любом случае. \
             Сила ползуна на плоскости — одна компонента; в пространстве, где направляющая удерживает в двух направлениях, это модуль.",
        ),
        "normal = \"force(A)\"  # a pin: the magnitude of two components",
        "normal = \"force_y(A)\"",
    ),
    row(
        "M086",
        ("impossible limits of friction", "невозможные пределы трения"),
        (
            "Friction is not negative, and the limit at rest is not below the friction while sliding: a body that broke away would be stopped at once.",
            "Трение не отрицательно, а предел трения покоя не меньше трения скольжения: иначе сорвавшееся тело тут же остановилось бы.",
        ),
        "kinetic = \"600 N\"\nstatic = \"200 N\"",
        "kinetic = \"200 N\"\nstatic = \"600 N\"",
    ),
    row(
        "M087",
        ("a load on two bodies", "нагрузка на двух телах"),
        (
            "A distributed load lies on the straight line between two points fixed on one body. Split it at joints.",
            "Распределённая нагрузка лежит на прямой между двумя закреплёнными точками одного тела. У шарниров её делят.",
        ),
        "from = \"A\"  # on the left beam\nto = \"B\"  # on the right beam",
        "from = \"A\"\nto = \"C\"",
    ),
    row(
        "M088",
        ("backlash", "зазор"),
        (
            "A backlash is not negative, and a spring with backlash has no preload: within the play there is no force.",
            "Зазор не отрицателен, и у пружины с зазором нет предварительного усилия: внутри зазора усилия нет.",
        ),
        "backlash = \"2 mm\"\npreload = \"10 N\"",
        "backlash = \"2 mm\"",
    ),
    row(
        "M364",
        ("no such part of the written calculation", "нет такой части записанного расчёта"),
        (
            "`sections` of [report] names chapters of the calculation, `depth` is full or short. The words are the same in both languages.",
            "`sections` в [report] называет главы расчёта, `depth` – full или short. Слова одинаковы в обоих языках.",
        ),
        "[report]\nsections = [\"dynamics\"]",
        "[report]\nsections = [\"equations\"]",
    ),
    row(
        "M089",
        ("a table of variants", "таблица вариантов"),
        (
            "[variants] names one table, either a file (`table`) or a text (`rows`); its columns are parameters and coordinates of the model.",
            "[variants] задаёт одну таблицу: файл (`table`) или текст (`rows`); её столбцы — параметры и координаты модели.",
        ),
        "[variants]\nkey = \"variant\"",
        "[variants]\ntable = \"variants.csv\"",
    ),
    row(
        "M096",
        ("phases out of order", "этапы не по порядку"),
        (
            "Each phase of [[phases]] begins where the one before ends, the first at t = 0; `until` is an instant, not a duration, so it must grow.",
            "Каждый этап [[phases]] начинается там, где кончается предыдущий, первый — при t = 0; `until` — момент, а не длительность, поэтому он должен возрастать.",
        ),
        "[[phases]]\nuntil = \"2 s\"\n[[phases]]\nuntil = \"1 s\"",
        "[[phases]]\nuntil = \"2 s\"\n[[phases]]\nuntil = \"3 s\"",
    ),
    row(
        "M097",
        ("a phase sets what is no parameter", "этап задаёт то, чего нет среди параметров"),
        (
            "A phase changes parameters of [parameters]. Coordinates follow from the motion; they and their rates go through a switch without a jump.",
            "Этап меняет параметры из [parameters]. Координаты следуют из движения; они и их скорости проходят переключение без скачка.",
        ),
        "[[phases]]\nset = { M0 = \"8 N m\" }",
        "[[phases]]\nset = { M_0 = \"8 N m\" }",
    ),
    row(
        "M098",
        ("unknown reading of the forcing's phase", "неизвестное толкование фазы возбуждения"),
        (
            "At a switch a harmonic load either keeps its phase, as a motor that goes on turning does, or restarts it: its time counts from the switch, as \
             some textbooks solve it.",
            "При переключении гармоническая нагрузка либо сохраняет фазу, как двигатель, который продолжает вращаться, либо начинает её заново: время \
             отсчитывается от переключения, как решают в некоторых учебниках.",
        ),
        "[[phases]]\nphase = \"anew\"",
        "[[phases]]\nphase = \"restarts\"",
    ),
];
