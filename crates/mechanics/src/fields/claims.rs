//! Keys of `[[claims]]`.

use crate::keys::{TableSpec, Type, may};

/// `[[claims]]`.
pub const CLAIM: TableSpec = TableSpec {
    name: "claims",
    about: (
        "A published result laid against the machine: an equation of motion, a formula of a quantity, a value, a natural frequency, or a frequency equation. What deviates is shown with its deviation and the term that differs. A claim that fails says something about its source and not about the run: only `strutt claims --strict` makes an error of it.",
        "Опубликованный результат, сопоставляемый с машиной: уравнение движения, формула величины, значение, собственная частота или частотное уравнение. Расхождение показывается с его величиной и с отличающимся слагаемым. Неверный результат говорит об источнике, а не о расчёте: ошибкой его делает только `strutt claims --strict`.",
    ),
    short: None,
    fields: &[
        may("name", Type::Text, "", "claim N", ("name in tables and files", "название в таблицах и файлах"), "\"weight\""),
        may("source", Type::Text, "", "", ("where it is published", "где опубликовано"), "\"Ivanov, Machines, p. 37\""),
        may(
            "equation",
            Type::String,
            "",
            "",
            (
                "an equation that every motion satisfies, left = right; factor, signs and order of terms do not matter",
                "уравнение, которому удовлетворяет всякое движение, левая часть = правая; множитель, знаки и порядок слагаемых не важны",
            ),
            "\"m*x'' + c*x = 0\"",
        ),
        may(
            "of",
            Type::Formula,
            "",
            "",
            (
                "the quantity that the formula or the value is of: an output, a reaction, a parameter, an energy",
                "величина, к которой относится формула или значение: выходная величина, реакция, параметр, энергия",
            ),
            "\"force(A)\"",
        ),
        may("formula", Type::Formula, "", "", ("the published formula of it", "её опубликованная формула"), "\"m*g*cos(phi)\""),
        may(
            "value",
            Type::Formula,
            "",
            "",
            (
                "the published value; it holds when it rounds to the digits that are written",
                "опубликованное значение; оно верно, если отличается не более чем на половину последней записанной цифры",
            ),
            "\"2656 N\"",
        ),
        may(
            "at",
            Type::Formula,
            "time",
            "0",
            ("the instant of the value, or \"equilibrium\"", "момент, к которому относится значение, или \"equilibrium\" (равновесие)"),
            "\"0.16 s\"",
        ),
        may(
            "mode",
            Type::Formula,
            "1",
            "",
            (
                "the value is the natural frequency of this number; Hz count periods",
                "значение — собственная частота с этим номером; в Гц – число периодов в секунду",
            ),
            "1",
        ),
        may(
            "frequency",
            Type::String,
            "",
            "",
            (
                "the frequency equation of small motions, left = right, in k (or omega, where k is the name of something else); factor, signs and order of terms do not matter",
                "частотное уравнение малых колебаний, левая часть = правая, относительно k (или omega, если имя k занято); множитель, знаки и порядок слагаемых не важны",
            ),
            "\"m1*m2*k^4 - (c1*m2 + c2*(m1 + m2))*k^2 + c1*c2 = 0\"",
        ),
        may(
            "unknown",
            Type::String,
            "",
            "k",
            (
                "another name of the frequency, or another unknown and what it is",
                "другое обозначение частоты либо другая неизвестная и её выражение через частоту",
            ),
            "\"z = m*k^2/c\"",
        ),
        may(
            "tolerance",
            Type::Formula,
            "1",
            "",
            (
                "largest deviation, relative to what strutt finds: 1e-6 for equations and formulas; values: half of the last written digit",
                "наибольшее расхождение относительно найденного: 1e-6 для уравнений и формул; для значений – половина последней цифры",
            ),
            "0.001",
        ),
    ],
    example: "[[claims]]\nname     = \"equation of motion\"\nsource   = \"Ivanov, Machines, p. 37\"\nequation = \"m*l^2*phi'' + m*g*l*sin(phi) = 0\"\n",
};
