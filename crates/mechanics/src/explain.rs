//! Long explanations of the codes of diagnostics: `strutt explain M021`.
//!
//! One row a code; a test checks that every code of the reader has a row and that every row is used. Later stages add a table of their
//! own to [`TABLES`] (`M100` to `M199` belong to `derive`).

mod events;
mod linear;
mod texts;
mod words;

pub use events::EVENTS;
pub use linear::LINEAR;
pub use texts::TEXTS;
pub use words::WORDS;

/// The explanation of a code.
#[derive(Clone, Copy, Debug)]
pub struct Explanation {
    /// Code.
    pub code: &'static str,
    /// Title, English and Russian.
    pub title: (&'static str, &'static str),
    /// What is behind it, English and Russian.
    pub text: (&'static str, &'static str),
    /// How it looks wrong; may be empty.
    pub wrong: &'static str,
    /// How it looks right; may be empty.
    pub right: &'static str,
}

/// Every table of explanations.
pub const TABLES: &[&[Explanation]] = &[
    EXPLANATIONS,
    LINEAR,
    EVENTS,
    TEXTS,
    WORDS,
    crate::derive::EXPLANATIONS,
    crate::structure::EXPLANATIONS,
    crate::section::EXPLANATIONS,
];

/// The explanation of a code; small letters will do.
pub fn find(code: &str) -> Option<&'static Explanation> {
    TABLES.iter().flat_map(|t| t.iter()).find(|e| e.code.eq_ignore_ascii_case(code))
}

pub(crate) const fn row(
    code: &'static str,
    title: (&'static str, &'static str),
    text: (&'static str, &'static str),
    wrong: &'static str,
    right: &'static str,
) -> Explanation {
    Explanation { code, title, text, wrong, right }
}

/// The codes of the reader.
pub const EXPLANATIONS: &[Explanation] = &[
    row(
        "M001",
        ("the file is too large", "файл слишком велик"),
        (
            "A model file may have 4 MiB. A generated file of that size is usually a table of data in the wrong place.",
            "Файл модели может занимать до 4 МиБ. Больше обычно получается, когда в него попала таблица данных.",
        ),
        "",
        "[coordinates]\nphi = \"rad\"",
    ),
    row(
        "M002",
        ("TOML syntax", "синтаксис TOML"),
        (
            "The file does not follow the rules of TOML. Most often a formula or a quantity lacks its quotes, or a bracket is not closed.",
            "Файл нарушает правила TOML. Чаще всего формула или величина записана без кавычек или не закрыта скобка.",
        ),
        "mass = 20 g",
        "mass = \"20 g\"",
    ),
    row(
        "M003",
        ("a key needs quotes", "ключ нужно взять в кавычки"),
        (
            "TOML allows only Latin letters, digits, - and _ in keys without quotes. Greek and Russian names work in quotes; inside formulas they stand as they are.",
            "TOML допускает в ключах без кавычек только латинские буквы, цифры, - и _. Греческие и русские имена пишут в кавычках; в формулах кавычки не нужны.",
        ),
        "φ = \"rad\"",
        "\"φ\" = \"rad\"",
    ),
    row(
        "M004",
        ("a key is given twice", "ключ задан дважды"),
        (
            "One table has the same key twice, or the same header stands twice. Only one of them could count.",
            "В таблице дважды встречается один ключ или дважды стоит один заголовок. Действовать может только одно.",
        ),
        "mass = \"1 kg\"\nmass = \"2 kg\"",
        "mass = \"2 kg\"",
    ),
    row(
        "M005",
        ("unknown key", "неизвестный ключ"),
        (
            "The key is not part of the model file, or belongs to another table or study. Unknown keys are errors, because a misspelt key would silently do nothing.",
            "Такого ключа нет, или он относится к другой таблице или расчёту. Неизвестный ключ — ошибка: иначе описка молча ничего бы не делала.",
        ),
        "mas = \"1 kg\"",
        "mass = \"1 kg\"",
    ),
    row(
        "M006",
        ("a required key is missing", "нет обязательного ключа"),
        ("The table cannot be used without this key.", "Без этого ключа таблица не имеет смысла."),
        "[springs.s]\nalong = \"x\"",
        "[springs.s]\nalong = \"x\"\nstiffness = \"4 kN/m\"",
    ),
    row(
        "M007",
        ("wrong type of value", "значение не того типа"),
        (
            "The key expects another type: a string, a number, an array, a table, or true and false.",
            "Ключ ожидает значение другого типа: строку, число, массив, таблицу или true и false.",
        ),
        "center = \"0, -l\"",
        "center = [\"0\", \"-l\"]",
    ),
    row(
        "M008",
        ("wrong number of components", "неверное число компонент"),
        (
            "A vector has 2 components in the plane and 3 in space; `between` takes two names.",
            "У вектора 2 компоненты на плоскости и 3 в пространстве; в `between` два имени.",
        ),
        "at = [\"r\"]",
        "at = [\"r\", \"0\"]",
    ),
    row(
        "M009",
        ("a key with too many parts", "слишком составной ключ"),
        (
            "A key may have at most 32 parts joined by points; those of the model file have at most four.",
            "В ключе может быть не более 32 частей через точку; ключи файла модели состоят не более чем из четырёх.",
        ),
        "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = 1",
        "[bodies.crank]\nmass = \"1 kg\"",
    ),
    row(
        "M010",
        ("this cannot be a name", "недопустимое имя"),
        (
            "A name begins with a letter and goes on with letters, digits and _. The names pi, t, ground and those of functions are taken. Derivatives need no declaration: phi' exists with phi.",
            "Имя начинается с буквы и продолжается буквами, цифрами и _. Имена pi, t, ground и имена функций заняты. Производные объявлять не нужно: phi' есть вместе с phi.",
        ),
        "[parameters]\nt = \"1 s\"",
        "[parameters]\ntau = \"1 s\"",
    ),
    row(
        "M011",
        ("a name is used twice", "имя использовано дважды"),
        (
            "Parameters, coordinates and outputs share one set of names; frames, bodies and points share another.",
            "У параметров, координат и выходных величин общий список имён; у систем отсчёта, тел и точек — свой.",
        ),
        "[parameters]\nx = \"1 m\"\n[coordinates]\nx = \"m\"",
        "[parameters]\nx_0 = \"1 m\"\n[coordinates]\nx = \"m\"",
    ),
    row(
        "M013",
        ("unknown name in a formula", "неизвестное имя в формуле"),
        (
            "Formulas know parameters, coordinates and their rates, t, pi and, in outputs, other outputs. Units stand in square brackets.",
            "Формулы знают параметры, координаты и их скорости, t, pi, а в outputs — и другие выходные величины. Единицы стоят в квадратных скобках.",
        ),
        "F = \"k*lenght\"",
        "F = \"k*length\"",
    ),
    row(
        "M014",
        ("unknown body, point or element", "неизвестное тело, точка или элемент"),
        (
            "The name stands for no frame, body, point, spring or damper, or for one of the wrong kind.",
            "Имя не обозначает ни системы отсчёта, ни тела, ни точки, ни элемента, либо обозначает не то, что нужно.",
        ),
        "on = \"crnak\"",
        "on = \"crank\"",
    ),
    row(
        "M015",
        ("no coordinates", "нет координат"),
        (
            "Equations of motion need at least one generalized coordinate.",
            "Для уравнений движения нужна хотя бы одна обобщённая координата.",
        ),
        "[coordinates]",
        "[coordinates]\nphi = { unit = \"rad\" }",
    ),
    row(
        "M016",
        ("more findings than are listed", "замечаний больше, чем показано"),
        (
            "Only the first 200 findings are listed. Correct them and check again: many of the others may vanish.",
            "Показаны первые 200 замечаний. Исправьте их и проверьте снова: многие другие, возможно, исчезнут.",
        ),
        "",
        "",
    ),
    row(
        "M020",
        ("not a quantity", "не величина"),
        (
            "A quantity is a number and a unit. The decimal mark is a point or a comma.",
            "Величина — это число и единица. Дробная часть отделяется точкой или запятой.",
        ),
        "kg 5",
        "5 kg",
    ),
    row(
        "M021",
        ("unknown unit", "неизвестная единица"),
        (
            "Units are products: N m s/rad, kg*m^2, кг·м². Names may be Latin or Cyrillic with SI prefixes, but the letters of one name come from one alphabet; capital and small letters differ. Each / divides by the next factor only.",
            "Единица — произведение: Н м с/рад, кг·м², kg*m^2. Имена латинские или русские, с приставками СИ; буквы одного имени из одного алфавита; прописные и строчные различаются. Знак / относится только к следующему множителю.",
        ),
        "\"5 Nm\"",
        "\"5 N m\"",
    ),
    row(
        "M022",
        ("a number out of range", "число вне пределов"),
        (
            "Numbers must be of a size that machine numbers hold: between 1e-307 and 1e308.",
            "Величина числа должна укладываться в машинные пределы: от 1e-307 до 1e308.",
        ),
        "1e999",
        "1e9",
    ),
    row(
        "M023",
        ("a unit is missing", "нет единицы"),
        (
            "Bare numbers have no dimension (0 fits everywhere). A length, a mass or a stiffness needs its unit. On the command line and in ranges a bare \
             number is SI; for a coordinate that the file declares in another unit (deg, mm) it would be misread, and the unit is needed there too.",
            "Число без единицы безразмерно (0 подходит всюду). Длине, массе, жёсткости нужна единица. В командной строке и в наборах значений число \
             без единицы — в СИ; если координата задана в файле в другой единице (deg, mm), его поняли бы неверно, и единица нужна и там.",
        ),
        "mass = 5",
        "mass = \"5 kg\"",
    ),
    row(
        "M024",
        ("wrong dimension", "неверная размерность"),
        (
            "The value has another dimension than the key needs. Angles count as pure numbers, so stiffness of a torsion spring is N m.",
            "Размерность значения не та, что нужна. Углы считаются безразмерными, поэтому жёсткость крутильной пружины — Н м.",
        ),
        "mass = \"5 m\"",
        "mass = \"5 kg\"",
    ),
    row(
        "M025",
        ("dimensions differ inside a formula", "разные размерности внутри формулы"),
        (
            "Only quantities of one dimension can be added, subtracted or compared. Usually a factor is missing or there is one too many.",
            "Складывать, вычитать и сравнивать можно только величины одной размерности. Обычно пропущен множитель или он лишний.",
        ),
        "M0 - k*phi' + F",
        "M0 - k*phi' + F*r",
    ),
    row(
        "M026",
        ("a pure number is needed", "нужно безразмерное число"),
        (
            "Functions such as sin and exp take pure numbers or angles, exponents are pure numbers, and a quantity with a dimension can only be raised to a number.",
            "Функции sin, exp и другие принимают числа и углы, показатели степени безразмерны, а размерную величину можно возвести только в числовую степень.",
        ),
        "sin(x)",
        "sin(x/l)",
    ),
    row(
        "M027",
        ("Hz where rad/s is meant", "Гц вместо рад/с"),
        (
            "Hz and 1/min count periods, an angular rate counts radians: one turn is 2 pi of them. By dimension both are 1/s. A count of periods is followed through parameters and formulas: 2*pi*n is an angular rate, sin(2*pi*n*t) and spin = \"2*pi*n\" are right; a warning comes where n alone stands in a sine, beside a rate in rad/s, or in a value that is no frequency. An output with unit = \"Hz\" shows an angular rate divided by 2 pi, one with unit = \"rpm\" shows a frequency in turns.",
            "Гц и 1/мин считают периоды, а угловая скорость — радианы: в одном обороте их 2 пи. По размерности обе величины 1/с. Счёт периодов прослеживается через параметры и формулы: 2*pi*n — угловая скорость, sin(2*pi*n*t) и spin = \"2*pi*n\" верны; предупреждение выдаётся, если n без множителя стоит под синусом, рядом со скоростью в рад/с или в величине, которая не является частотой. Выходная величина с unit = \"Гц\" показывает угловую скорость, делённую на 2 пи, а с unit = \"об/мин\" — частоту в оборотах.",
        ),
        "spin = \"50 Hz\"",
        "spin = \"50 rev/s\"",
    ),
    row(
        "M030",
        ("syntax of a formula", "синтаксис формулы"),
        (
            "A formula is made of numbers, names, + - * / ^, brackets and functions. Products need their sign.",
            "Формула состоит из чисел, имён, + - * / ^, скобок и функций. Знак умножения обязателен.",
        ),
        "m g",
        "m*g",
    ),
    row(
        "M031",
        ("decimal comma in a formula", "запятая в числе внутри формулы"),
        (
            "In formulas a comma separates arguments, so the decimal mark is a point. In quantity strings both marks work.",
            "В формулах запятая разделяет аргументы, поэтому дробная часть отделяется точкой. В строках-величинах годятся оба знака.",
        ),
        "2,5*x",
        "2.5*x",
    ),
    row(
        "M032",
        ("a formula too long or too deep", "слишком длинная или вложенная формула"),
        (
            "A formula may have 100 000 bytes and 100 levels of brackets. Name its parts as parameters or outputs.",
            "Формула может занимать 100 000 байт и иметь 100 уровней скобок. Вынесите части в параметры или выходные величины.",
        ),
        "((((...))))",
        "a = \"...\"\nb = \"a + ...\"",
    ),
    row(
        "M033",
        ("unknown function", "неизвестная функция"),
        (
            "Known are sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs sign min max if and the kinematic functions. A product needs its sign.",
            "Известны sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs sign min max if и кинематические функции. Знак умножения обязателен.",
        ),
        "tg(phi)",
        "tan(phi)",
    ),
    row(
        "M034",
        ("wrong number of arguments", "неверное число аргументов"),
        (
            "The function takes another number of arguments. A decimal comma looks like two arguments.",
            "Функция принимает другое число аргументов. Запятая в числе выглядит как два аргумента.",
        ),
        "sin(2,5)",
        "sin(2.5)",
    ),
    row(
        "M035",
        ("a unit without brackets in a formula", "единица без скобок в формуле"),
        (
            "Inside a formula a unit stands in square brackets after its number; letters alone are names.",
            "Внутри формулы единица стоит в квадратных скобках после числа; просто буквы — это имена.",
        ),
        "30 rad/s^2 * t",
        "30 [rad/s^2] * t",
    ),
    row(
        "M036",
        ("a forbidden dependence", "недопустимая зависимость"),
        (
            "Start values, masses and inertias are constants; prescribed rates and stiffnesses depend on time at most; positions and potentials on coordinates and time; forces also on rates. Only outputs know accelerations.",
            "Начальные значения, массы и моменты инерции постоянны; заданные скорости и жёсткости зависят самое большее от времени; положения и потенциалы — от координат и времени; силы — ещё и от скоростей. Ускорения известны только в outputs.",
        ),
        "spin = \"phi'\"",
        "angle = \"phi\"",
    ),
    row(
        "M037",
        ("a function or output that cannot be used here", "функция или величина, недопустимая здесь"),
        (
            "Kinematic functions need the finished kinematics, so they stand in outputs, forces, torques, pathways and potentials; outputs are used in outputs only.",
            "Кинематическим функциям нужна готовая кинематика, поэтому они допустимы в outputs, forces, torques, координатах элементов и potentials; выходные величины — только в outputs.",
        ),
        "[parameters]\nh = \"y(A)\"",
        "[outputs]\nh = \"y(A)\"",
    ),
    row(
        "M038",
        ("too many primes", "слишком много штрихов"),
        (
            "Equations of motion are of second order: phi' and phi'' are the most.",
            "Уравнения движения второго порядка: бывают только phi' и phi''.",
        ),
        "phi'''",
        "phi''",
    ),
    row(
        "M039",
        ("derivative of a constant", "производная постоянной"),
        (
            "The name is constant, so its derivative is zero. Perhaps it was meant to depend on time.",
            "Имя обозначает постоянную, её производная равна нулю. Возможно, она должна зависеть от времени.",
        ),
        "omega = \"30 rad/s\"\neps = \"omega'\"",
        "omega = \"3 [rad/s^2]*t\"\neps = \"omega'\"",
    ),
    row(
        "M040",
        ("cyclic definition", "циклическое определение"),
        (
            "Parameters (or outputs) need each other in a circle, so none can be computed first.",
            "Параметры (или выходные величины) нужны друг другу по кругу, и начать вычисление не с чего.",
        ),
        "a = \"b\"\nb = \"2*a\"",
        "a = \"1 m\"\nb = \"2*a\"",
    ),
    row(
        "M041",
        ("frames in a circle", "системы отсчёта по кругу"),
        (
            "Each frame stands on another one (`on`, or the point of its origin); the chain must end at the ground.",
            "Каждая система стоит на другой (`on` или точка начала); цепь должна кончаться неподвижной.",
        ),
        "[bodies.a]\non = \"b\"\n[bodies.b]\non = \"a\"",
        "[bodies.a]\n[bodies.b]\non = \"a\"",
    ),
    row(
        "M042",
        ("no finite value", "нет конечного значения"),
        (
            "A constant divides by zero, takes a root or logarithm of a negative number, or outgrows machine numbers.",
            "Постоянная содержит деление на нуль, корень или логарифм отрицательного числа или превышает машинные пределы.",
        ),
        "k = \"1 [N]/(l - l)\"",
        "k = \"1 [N]/l\"",
    ),
    row(
        "M050",
        ("mass is not positive", "масса не положительна"),
        (
            "The mass of a body is negative, or a parameter makes it zero. A massless body has no `mass` key.",
            "Масса тела отрицательна или обращена в нуль параметром. У невесомого тела ключа `mass` нет.",
        ),
        "mass = \"-2 kg\"",
        "mass = \"2 kg\"",
    ),
    row(
        "M051",
        ("a size is not positive", "размер не положителен"),
        ("Lengths of shapes and radii of gyration are positive.", "Размеры форм и радиусы инерции положительны."),
        "shape = \"disc(0 [m])\"",
        "shape = \"disc(0.1 [m])\"",
    ),
    row(
        "M052",
        ("a shape without mass", "форма без массы"),
        (
            "`shape` and `gyration` turn a mass into an inertia, so the mass is needed. An inertia alone is given by `inertia`.",
            "`shape` и `gyration` превращают массу в момент инерции, поэтому масса нужна. Один момент инерции задают ключом `inertia`.",
        ),
        "shape = \"disc(R)\"",
        "mass = \"m\"\nshape = \"disc(R)\"",
    ),
    row(
        "M053",
        ("inertia given twice", "момент инерции задан дважды"),
        ("Only one of `inertia`, `shape` and `gyration` may be given.", "Задают только одно из `inertia`, `shape` и `gyration`."),
        "shape = \"disc(R)\"\ninertia = \"J\"",
        "inertia = \"J\"",
    ),
    row(
        "M054",
        ("unknown shape", "неизвестная форма"),
        ("Shapes are disc, ring, rod, box, sphere, cylinder, point.", "Формы: disc, ring, rod, box, sphere, cylinder, point."),
        "shape = \"disk(R)\"",
        "shape = \"disc(R)\"",
    ),
    row(
        "M055",
        ("impossible inertia", "невозможный момент инерции"),
        (
            "A moment of inertia is a sum of m r^2. It is not negative, no principal moment exceeds the sum of the other two, and products are bounded by the moments.",
            "Момент инерции — сумма m r². Он не отрицателен, ни один не больше суммы двух других, а центробежные моменты ограничены осевыми.",
        ),
        "inertia = { xx = \"1 kg m^2\", yy = \"1 kg m^2\", zz = \"3 kg m^2\" }",
        "inertia = { xx = \"1 kg m^2\", yy = \"1 kg m^2\", zz = \"2 kg m^2\" }",
    ),
    row(
        "M056",
        ("zero or negative stiffness or damping", "нулевая или отрицательная жёсткость или вязкость"),
        (
            "A zero element does nothing; a negative one feeds energy into the motion. Both are allowed, but seldom meant.",
            "Нулевой элемент не действует, отрицательный раскачивает движение. То и другое допустимо, но редко имеется в виду.",
        ),
        "stiffness = \"-4 kN/m\"",
        "stiffness = \"4 kN/m\"",
    ),
    row(
        "M057",
        ("an element needs one pathway", "элементу нужна одна координата"),
        (
            "Exactly one of `along` (a formula) and `between` (two points or two bodies) says through what the element acts.",
            "Ровно одно из `along` (формула) и `between` (две точки или два тела) говорит, через что действует элемент.",
        ),
        "[springs.s]\nstiffness = \"1 N/m\"",
        "[springs.s]\nalong = \"x\"\nstiffness = \"1 N/m\"",
    ),
    row(
        "M058",
        ("a point and a body", "точка и тело"),
        (
            "Two points give a distance, two bodies an angle; a point and a body give neither.",
            "Две точки дают расстояние, два тела — угол; точка и тело — ни того, ни другого.",
        ),
        "between = [\"A\", \"crank\"]",
        "between = [\"A\", \"B\"]",
    ),
    row(
        "M059",
        ("a spring needs its free length", "пружине нужна свободная длина"),
        (
            "Between two points a spring with no free length would always pull them together.",
            "Пружина между точками без свободной длины всегда стягивала бы их.",
        ),
        "between = [\"A\", \"B\"]",
        "between = [\"A\", \"B\"]\nrest = \"0.1 m\"",
    ),
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
            "Studies are equations, equilibrium, simulate, inverse, statics, kinematics, periodic, cycle and sweep.",
            "Расчёты: equations, equilibrium, simulate, inverse, statics, kinematics, periodic, cycle и sweep.",
        ),
        "kind = \"simulat\"",
        "kind = \"simulate\"",
    ),
    row(
        "M065",
        ("times, tolerance or method of a study", "времена, точность или метод расчёта"),
        (
            "Durations are positive, times ascend up to the end of the motion, the tolerance lies between 1e-16 and 1e-2, and the method is auto, taylor or stiff.",
            "Длительности положительны, моменты времени возрастают до конца движения, точность от 1e-16 до 1e-2, метод — auto, taylor или stiff.",
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
             for a coordinate in another unit (deg, mm) the unit must be written.",
            "--set принимает имя=величина, где имя — параметр, координата (начальное значение) или phi' (начальная скорость). \
             Числа без единиц — в СИ; для координаты в другой единице (deg, mm) её нужно написать.",
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
        "M070",
        ("no range of values", "не набор значений"),
        (
            "A range is name=linspace(first, last, number), name=logspace(first, last, number) with positive ends, or name=value, value. With semicolons between the values commas are decimal marks.",
            "Набор значений: имя=linspace(первое, последнее, число), имя=logspace(первое, последнее, число) с положительными концами или имя=значение, значение. Если значения разделены точкой с запятой, запятая отделяет дробную часть.",
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
            "Коэффициент восстановления — отношение скоростей после и до удара: 0 — прилипание, 1 — без потерь энергии.",
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

#[cfg(test)]
mod tests {
    use super::EXPLANATIONS;
    use std::collections::BTreeSet;
    use std::path::Path;

    fn sources(folder: &Path, text: &mut String) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if path.is_dir() && name != "derive" {
                sources(&path, text);
            } else if name.ends_with(".rs") && name != "explain.rs" && name != "tests.rs" {
                text.push_str(&std::fs::read_to_string(&path).unwrap());
            }
        }
    }

    #[test]
    fn every_code_is_explained_and_every_explanation_is_used() {
        let mut text = String::new();
        sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut text);
        let codes = text.match_indices("\"M0").filter_map(|(i, _)| text.get(i + 1..i + 5)).filter(|c| c[1..].parse::<u16>().is_ok());
        let used: BTreeSet<&str> = codes.collect();
        let rows = || EXPLANATIONS.iter().chain(super::LINEAR);
        let explained: BTreeSet<&str> = rows().map(|e| e.code).collect();
        assert_eq!(explained.len(), rows().count(), "a code has two rows");
        let used: BTreeSet<&str> = used.into_iter().filter(|c| *c < "M100").collect();
        let explained: BTreeSet<&str> = explained.into_iter().filter(|c| *c < "M100").collect();
        assert_eq!(used, explained);
    }
}
