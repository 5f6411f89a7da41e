//! Long texts of the faults of the studies of machines.

use crate::fault::Explanation;

pub(crate) const NO_RETURN: Explanation = Explanation {
    code: "S041",
    en: (
        "the motion does not come back",
        "The study `periodic` follows the motion until the coordinate of the section has made its turn, or has returned to its value in the same direction. \
         It did not happen: the machine comes to rest, runs away, or swings about another value. Begin nearer to the regime, choose another section, or give \
         a forced machine its period.",
    ),
    ru: (
        "движение не возвращается",
        "Расчёт `periodic` следит за движением, пока координата сечения не совершит оборот или не вернётся к своему значению в том же направлении. Этого не \
         произошло: машина останавливается, уходит неограниченно далеко или колеблется около другого значения. Начните ближе к режиму, выберите другое \
         сечение или, для вынужденного движения, задайте период.",
    ),
};

pub(crate) const NO_REGIME: Explanation = Explanation {
    code: "S042",
    en: (
        "no periodic regime was found",
        "Neither following the motion nor Newton's method led to a start that the motion comes back to. The regime may be far from the given start (let the \
         motion settle), repeat only after several returns (give their number), or not exist: beats of two frequencies and chaos are not periodic.",
    ),
    ru: (
        "периодический режим не найден",
        "Ни продолжение движения, ни метод Ньютона не привели к началу, в которое движение возвращается. Режим может быть далеко от заданного начала (дайте \
         движению установиться), повторяться лишь через несколько возвращений (задайте их число) или не существовать: биения двух частот и хаос не \
         периодичны.",
    ),
};

pub(crate) const DRIVEN: Explanation = Explanation {
    code: "S043",
    en: (
        "a forced motion needs the period of its forcing",
        "Time occurs in the equations, and not only as a uniform motion of the whole. A forced motion can repeat only after whole periods of its forcing, so \
         the study `periodic` needs `period`; after that time the forces must be what they were.",
    ),
    ru: (
        "вынужденному движению нужен период возмущения",
        "Время входит в уравнения явно, и не только через равномерное движение целого. Вынужденное движение может повторяться только через целое число периодов \
         возмущения, поэтому расчёту `periodic` нужен ключ `period`; через это время силы должны повторяться.",
    ),
};

pub(crate) const NO_PASSAGE: Explanation = Explanation {
    code: "S044",
    en: (
        "the section is never passed",
        "The formula in `section` says where a period begins: where it passes zero from below. Along the periodic motion that was found it keeps its sign.",
    ),
    ru: (
        "движение не проходит сечение",
        "Формула в `section` определяет начало периода: переход через нуль снизу вверх. Вдоль найденного периодического движения она сохраняет знак.",
    ),
};
