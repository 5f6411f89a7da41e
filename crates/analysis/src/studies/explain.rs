//! Long texts of the faults of the studies of machines.

use words::explain::{Explanation, plain};

pub(crate) const NO_RETURN: Explanation = plain(
    "S041",
    ("the motion does not come back", "движение не возвращается"),
    (
        "The study `periodic` follows the motion until the coordinate of the section has made its turn, or has returned to its value in the same direction. \
         It did not happen: the machine comes to rest, runs away, or swings about another value. Begin nearer to the regime, choose another section, or give \
         a forced machine its period.",
        "Расчёт `periodic` следит за движением, пока координата сечения не совершит оборот или не вернётся к своему значению в том же направлении. Этого не \
         произошло: машина останавливается, уходит неограниченно далеко или колеблется около другого значения. Начните ближе к режиму, выберите другое \
         сечение или, для вынужденного движения, задайте период.",
    ),
);

pub(crate) const NO_REGIME: Explanation = plain(
    "S042",
    ("no periodic regime was found", "периодический режим не найден"),
    (
        "Neither following the motion nor Newton's method led to a start that the motion comes back to. The regime may be far from the given start (let the \
         motion settle), repeat only after several returns (give their number), or not exist: beats of two frequencies and chaos are not periodic.",
        "Ни продолжение движения, ни метод Ньютона не привели к началу, в которое движение возвращается. Режим может быть далеко от заданного начала (дайте \
         движению установиться), повторяться лишь через несколько возвращений (задайте их число) или не существовать: биения двух частот и хаос не \
         периодичны.",
    ),
);

pub(crate) const DRIVEN: Explanation = plain(
    "S043",
    ("a forced motion needs the period of its forcing", "вынужденному движению нужен период возмущения"),
    (
        "Time occurs in the equations, and not only as a uniform motion of the whole. A forced motion can repeat only after whole periods of its forcing, so \
         the study `periodic` needs `period`; after that time the forces must be what they were.",
        "Время входит в уравнения явно, и не только через равномерное движение целого. Вынужденное движение может повторяться только через целое число периодов \
         возмущения, поэтому расчёту `periodic` нужен ключ `period`; через это время силы должны повторяться.",
    ),
);

pub(crate) const NO_PASSAGE: Explanation = plain(
    "S044",
    ("the section is never passed", "движение не проходит сечение"),
    (
        "The formula in `section` says where a period begins: where it passes zero from below. Along the periodic motion that was found it keeps its sign.",
        "Формула в `section` определяет начало периода: переход через нуль снизу вверх. Вдоль найденного периодического движения она сохраняет знак.",
    ),
);

pub(crate) const NO_SUCH_PERIOD: Explanation = plain(
    "S045",
    ("no value gives the wanted period", "нужный период недостижим"),
    (
        "The study `periodic` changes one parameter until the period is the wanted one. The period does not depend on that parameter, or the search left the range in which there is a regime.",
        "Расчёт `periodic` меняет один параметр, пока период не станет нужным. Период от этого параметра не зависит, или поиск вышел из области, где режим существует.",
    ),
);

pub(crate) const NOT_TURNING: Explanation = plain(
    "S046",
    ("the shaft does not turn through the cycle", "вал не проходит весь цикл"),
    (
        "The study `cycle` needs one motion through the whole cycle: the angle must run monotonously through it from the start. A dead point, a wrong sign of `turns` or a shaft at rest prevent it.",
        "Расчёту `cycle` нужно одно движение через весь цикл: угол должен монотонно пройти его от начала. Этому мешают мёртвое положение, неверный знак `turns` или неподвижный вал.",
    ),
);

pub(crate) const PARTS: Explanation = plain(
    "S168",
    ("a contact changes in the cycle", "контакт меняет состояние в цикле"),
    (
        "The study `cycle` reduces the machine to its main shaft: all places follow from the angle, at any rate. A contact that opens, closes or is struck within the cycle gives the machine a freedom of its own for a part of it. A follower that leaves its cam flies by its own weight and strikes when it comes down; what that takes depends on the rate, and whether the turn repeats is another question. Hold the shaft with `[motions]`, let the machine run until its turns repeat, and take the work of one turn from `inverse`.",
        "Расчёт `cycle` приводит машину к главному валу: все положения следуют из угла при любой скорости. Контакт, который в цикле размыкается, замыкается или испытывает удар, на части цикла даёт машине собственную степень свободы. Толкатель, оторвавшийся от кулачка, летит под действием веса и при падении ударяет; потери при этом зависят от скорости, а повторяется ли оборот – отдельный вопрос. Задайте движение вала в `[motions]`, дайте машине поработать, пока обороты не станут повторяться, и возьмите работу за один оборот из `inverse`.",
    ),
);

pub(crate) const NO_ENERGY: Explanation = plain(
    "S047",
    ("no energies at a place of the cycle", "энергии в некотором положении не определены"),
    (
        "A formula of a load or an energy has no value somewhere in the cycle, so the balance cannot be drawn up.",
        "Формула нагрузки или энергии где-то в цикле не имеет значения, и баланс составить нельзя.",
    ),
);

pub(crate) const NO_DRIVE: Explanation = plain(
    "S048",
    ("the parameter does not decide the cycle", "параметр не влияет на цикл"),
    (
        "The unknown of the study `cycle` does no work over the cycle, or no value of the flywheel's inertia gives the wanted irregularity. Choose a drive force or torque, or the inertia of a body on the main shaft.",
        "Неизвестная расчёта `cycle` не совершает работы за цикл, или ни при каком моменте инерции маховика неравномерность не равна заданной. Выберите движущую силу или момент либо момент инерции тела на главном валу.",
    ),
);

pub(crate) const DEAD_POINT: Explanation = plain(
    "S049",
    ("dead point of a linkage", "мёртвое положение механизма"),
    (
        "The study `kinematics` cannot drive the coordinate further: levers stand in line, or the range leaves what the linkage can reach. The message names the position, located to ten digits.",
        "Расчёт `kinematics` не может вести координату дальше: звенья вытянулись в линию или промежуток выходит за достижимые положения. Положение, найденное с десятью знаками, названо в сообщении.",
    ),
);

pub(crate) const ENTERED: Explanation = plain(
    "S025",
    ("kinematics through a contact", "кинематика сквозь контакт"),
    (
        "Along the range of the study `kinematics` the gap of a stop or a contact becomes negative. Connections are followed by geometry alone; whether a contact stops the linkage, or opens, is decided by forces. End the range before it, or ask for the motion with `simulate`.",
        "На промежутке расчёта `kinematics` зазор упора или контакта становится отрицательным. Кинематика следует геометрии связей; останавливает ли упор механизм, решают силы. Закончите промежуток раньше или рассчитайте движение в `simulate`.",
    ),
);

pub(crate) const UNDETERMINED: Explanation = plain(
    "S026",
    ("driven coordinates that do not determine the motion", "ведущие координаты не определяют движение"),
    (
        "The linkage has more degrees of freedom than driven coordinates: some coordinates are free, and no number for them would follow from the file. Give as many further driven coordinates as formulas of the first in `with`.",
        "Степеней свободы у механизма больше, чем ведущих координат: некоторые координаты свободны, и значения для них из файла не следуют. Задайте недостающие ведущие координаты формулами от первой в `with`.",
    ),
);

pub(crate) const OVERDRIVEN: Explanation = plain(
    "S027",
    ("driven coordinates that contradict the connections", "ведущие координаты противоречат связям"),
    (
        "More coordinates are driven than the linkage has degrees of freedom, and the formulas in `with` do not agree with the connections. Leave the coordinates that follow from the connections out of `with`.",
        "Ведущих координат больше, чем степеней свободы, и формулы в `with` не согласуются со связями. Уберите из `with` координаты, которые следуют из связей.",
    ),
);

pub(crate) const BRANCHES: Explanation = plain(
    "S028",
    ("position in which a linkage branches", "положение, в котором движение механизма разветвляется"),
    (
        "In a change point (all links of a parallelogram in line) the driven coordinates do not determine where the links go next. Inside a range the study `kinematics` passes such a point along the smooth way, and interpolates the values in it; it cannot begin there, nor continue where no smooth way is found. Begin elsewhere, or drive a further coordinate through it.",
        "В особом положении (все звенья параллелограмма на одной прямой) ведущие координаты не определяют дальнейшего движения звеньев. Внутри промежутка расчёт `kinematics` проходит такое положение по гладкому продолжению пути и интерполирует значения в нём; начать в нём или продолжить там, где гладкого пути нет, нельзя. Начните в другом положении или ведите ещё одну координату.",
    ),
);

pub(crate) const NO_DERIVATIVE: Explanation = plain(
    "S054",
    ("the equations have no derivative there", "уравнения не имеют там производной"),
    (
        "Multipliers say how a small change of the start grows over a period; they are solutions of the variational equations, whose coefficients are the \
         derivatives of the equations by the state. A square root or a fractional power at its zero has none. Period, start and motion do not need it and \
         are given.",
        "Мультипликаторы показывают, как малое изменение начала растёт за период; это решения уравнений в вариациях, коэффициенты которых — производные \
         уравнений по состоянию. У квадратного корня или дробной степени в нуле их нет. Период, начало и движение в них не нуждаются и приведены.",
    ),
);

pub(crate) const TOO_QUICK: Explanation = plain(
    "S055",
    ("the variations cannot be followed", "решения в вариациях не удаётся продолжить"),
    (
        "The variational equations are integrated with a step of their own, which became too small or was taken too often: a disturbance oscillates millions \
         of times in a period, or the equations are singular at that instant. No multiplier is given then.",
        "Уравнения в вариациях интегрируются со своим шагом, а он стал слишком мал или понадобился слишком часто: возмущение колеблется миллионы раз за \
         период, или в этот момент уравнения вырождены. Мультипликаторы тогда не приводятся.",
    ),
);

pub(crate) const NOTHING_MOVES: Explanation = plain(
    "S056",
    ("nothing can move", "двигаться нечему"),
    (
        "The study `periodic` looks for a motion that repeats. A truss, a frame or any model without coordinates has none.",
        "Расчёт `periodic` ищет повторяющееся движение. У фермы, рамы и любой модели без координат его нет.",
    ),
);

pub(crate) const SECTION_OF_FORCED: Explanation = plain(
    "S057",
    ("a section for a forced motion", "сечение для вынужденного движения"),
    (
        "`section` chooses where the period of a free motion begins. Where time occurs in the equations the period begins at t = 0 and lasts `period`; a start \
         elsewhere would be another motion under the same forces.",
        "`section` выбирает, где начинается период свободного движения. Если время входит в уравнения, период начинается при t = 0 и длится `period`; начало в \
         другом месте было бы другим движением под теми же силами.",
    ),
);

pub(crate) const NO_NUMBER: Explanation = plain(
    "S085",
    ("no such number in the study", "в расчёте нет такого числа"),
    (
        "A sweep may note a number of the repeated study's JSON by its path, such as `multipliers.1.abs`: names and, in lists, numbers that count from 0. The study \
         has nothing at this path. `strutt STUDY FILE --json` shows what it has. Wrong: modes.2.omega of a machine with two modes. Right: modes.1.omega.",
        "Серия может записывать число из JSON повторяемого расчёта по его пути, например `multipliers.1.abs`: имена, а в списках номера, считая с 0. По этому пути в \
         расчёте ничего нет. Что в нём есть, показывает `strutt РАСЧЁТ ФАЙЛ --json`. Неверно: modes.2.omega для машины с двумя формами. Верно: modes.1.omega.",
    ),
);

pub(crate) const ROWS_ONLY: Explanation = plain(
    "S100",
    ("a quantity is known at its rows only", "величина известна лишь в строках таблицы"),
    (
        "A sweep notes the least, greatest, mean or last value of the motion, not of the rows of a table. The repeated study gives this quantity at \
         single places only (over a frequency, say), or does not give it at all. Repeat a study of a motion (simulate, periodic, inverse, transient), or name a number \
         of the study itself.",
        "Серия записывает наименьшее, наибольшее, среднее или последнее значение движения, а не строк таблицы. Повторяемый расчёт даёт эту величину лишь в \
         отдельных точках (например, по частоте) или не даёт вовсе. Повторяйте расчёт движения (simulate, periodic, inverse, transient) или назовите число самого \
         расчёта.",
    ),
);

pub(crate) const LONG_WAY: Explanation = plain(
    "S079",
    ("a range too long for a linkage", "слишком длинный промежуток для механизма"),
    (
        "`kinematics` closes the linkage place by place along its whole range. A range of more than 10⁵ radians (or as many arms of the linkage), or a rate whose \
         square no number holds, is refused before anything is computed. Wrong: turns = 1e6. Right: turns = 1, for every turn of a cyclic machine is like the first.",
        "Расчёт `kinematics` замыкает механизм положение за положением на всём промежутке. Промежуток более 10⁵ радиан (или стольких же плеч механизма), а также \
         скорость, квадрат которой не представить числом, отклоняются до начала счёта. Неверно: turns = 1e6. Верно: turns = 1, все обороты цикловой машины одинаковы.",
    ),
);
