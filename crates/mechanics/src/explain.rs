//! Long explanations of the codes of diagnostics: `strutt explain M021`.
//!
//! One row a code; a test checks that every code of the reader has a row and that every row is used. Later stages add a table of their
//! own to [`TABLES`] (those of `derive` begin with M1).

mod axes;
mod events;
mod linear;
mod names;
mod rubbing;
mod studies;
mod texts;
mod variants;

pub use axes::AXES;
pub use events::EVENTS;
pub use linear::LINEAR;
pub use names::NAMES;
pub use rubbing::RUBBING;
pub use studies::STUDIES;
pub use texts::TEXTS;
pub use variants::VARIANTS;

use crate::elements::TABLE;
use words::explain::{Explanation, row};

/// Every table of explanations.
pub const TABLES: &[&[Explanation]] = &ALL;

/// Those that belong to no single element.
const ROOMS: &[&[Explanation]] = &[
    EXPLANATIONS,
    STUDIES,
    LINEAR,
    EVENTS,
    RUBBING,
    TEXTS,
    NAMES,
    VARIANTS,
    AXES,
    crate::derive::EXPLANATIONS,
    crate::structure::EXPLANATIONS,
    crate::section::EXPLANATIONS,
];

/// The rooms, then the elements.
const ALL: [&[Explanation]; ROOMS.len() + TABLE.len()] = {
    let mut all: [&[Explanation]; ROOMS.len() + TABLE.len()] = [&[]; ROOMS.len() + TABLE.len()];
    let mut i = 0;
    while i < all.len() {
        all[i] = if i < ROOMS.len() { ROOMS[i] } else { TABLE[i - ROOMS.len()].explanations };
        i += 1;
    }
    all
};

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
             number is SI; where the file gives the value in another unit (deg, mm, g) it would be misread, and the unit is needed there too.",
            "Число без единицы безразмерно (0 подходит всюду). Длине, массе, жёсткости нужна единица. В командной строке и в наборах значений число \
             без единицы — в СИ; если в файле величина задана в другой единице (deg, mm, г), его поняли бы неверно, и единица нужна и там.",
        ),
        "mass = 5",
        "mass = \"5 kg\"",
    ),
    row(
        "M024",
        ("wrong dimension", "неверная размерность"),
        (
            "The value has another dimension than the key needs. The radian is a pure number, so the stiffness of a torsion spring may stand in N m/rad or in N m.",
            "Размерность значения не та, что нужна. Радиан безразмерен, поэтому жёсткость крутильной пружины можно задать и в Н·м/рад, и в Н·м.",
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
            "Hz and 1/min count periods, an angular rate counts radians: one turn is 2 pi of them. By dimension both are 1/s. A count of periods is followed through parameters and formulas: 2*pi*n is an angular rate, sin(2*pi*n*t) and spin = \"2*pi*n\" are right; a warning comes where n alone stands in a sine, beside a rate in rad/s, or in a value that is no frequency. Each value of a range and each end of `between` is judged by its own unit, and is refused. An output with unit = \"Hz\" shows an angular rate divided by 2 pi, one with unit = \"rpm\" shows a frequency in turns.",
            "Гц и 1/мин считают периоды, а угловая скорость — радианы: в одном обороте их 2 пи. По размерности обе величины 1/с. Счёт периодов прослеживается через параметры и формулы: 2*pi*n — угловая скорость, sin(2*pi*n*t) и spin = \"2*pi*n\" верны; предупреждение выдаётся, если n без множителя стоит под синусом, рядом со скоростью в рад/с или в величине, которая не является частотой. О каждом значении набора и о каждой границе `between` судят по их собственной единице; несоответствие там — ошибка. Выходная величина с unit = \"Гц\" показывает угловую скорость, делённую на 2 пи, а с unit = \"об/мин\" — частоту в оборотах.",
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
            "Known are sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log (= ln) lg (= log10) sqrt cbrt abs sign min max if and the kinematic functions. A product needs its sign.",
            "Известны sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log (= ln) lg (= log10) sqrt cbrt abs sign min max if и кинематические функции. Знак умножения обязателен.",
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
        ("a number and what follows without a sign", "число и следующее за ним без знака"),
        (
            "Inside a formula a unit stands in square brackets after its number, and a product has its sign: 2*phi. Letters alone are names. Powers of ten are written 1e3.",
            "Внутри формулы единица стоит в квадратных скобках после числа, а произведение записывают со знаком: 2*phi. Просто буквы — это имена. Степени десяти пишут так: 1e3.",
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
        ("a mass that is negative or zero", "масса отрицательна или равна нулю"),
        (
            "The mass of a body is negative (an error), or a parameter of the file makes it zero (a warning: a massless body has no `mass` key). Set to zero by --set, a variant or a sweep, the body is switched off; coordinates that lose their inertia with it are named by M100.",
            "Масса тела отрицательна (ошибка) или обращена в нуль параметром файла (предупреждение: у невесомого тела ключа `mass` нет). Нуль, заданный через --set, вариант или sweep, отключает тело; координаты, которые теряют с ним инерцию, называет M100.",
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
        ("zero or negative stiffness or damping", "нулевая или отрицательная жёсткость либо коэффициент сопротивления"),
        (
            "A zero element does nothing. A negative stiffness pushes away from the place where its force vanishes; a negative damping feeds energy into the motion. All this is allowed, but seldom meant.",
            "Нулевой элемент не действует. При отрицательной жёсткости усилие направлено от положения, где оно равно нулю; отрицательный коэффициент сопротивления подводит к движению энергию. Всё это допустимо, но редко имеется в виду.",
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
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    fn sources(folder: &Path, text: &mut String) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if path.is_dir() && name != "derive" && name != "explain" {
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
        let rows = || super::TABLES.iter().flat_map(|table| table.iter());
        let explained: BTreeSet<&str> = rows().map(|e| e.code).collect();
        assert_eq!(explained.len(), rows().count(), "a code has two rows");
        let used: BTreeSet<&str> = used.into_iter().filter(|c| *c < "M100").collect();
        let explained: BTreeSet<&str> = explained.into_iter().filter(|c| *c < "M100").collect();
        assert_eq!(used, explained);
    }
}
