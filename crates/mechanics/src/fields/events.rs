//! Keys of `[events.NAME]`.

use crate::keys::{LABEL, TableSpec, Type, may, must};

/// `[events.NAME]`.
pub const EVENT: TableSpec = TableSpec {
    name: "events",
    about: (
        "Instants at which a formula passes zero: a change of its sign, found to rounding like the switches of the equations, without changing the motion. A touch from one side is none; a jump across zero is one at the instant of the jump. A formula that is zero at the start gives an event there when it leaves in the direction asked for.",
        "Моменты, в которые формула проходит нуль: перемена её знака, найденная с машинной точностью, как переключения уравнений; движение от этого не меняется. Касание с одной стороны событием не считается; скачок через нуль считается, в момент скачка. Если формула равна нулю в начале, событие есть и там, когда она уходит от нуля в нужную сторону.",
    ),
    short: None,
    fields: &[
        must(
            "zero",
            Type::Formula,
            "",
            (
                "formula; coordinates, rates, `phi''`, t, parameters, outputs, reactions",
                "формула; координаты, скорости, `phi''`, t, параметры, выходные величины, реакции",
            ),
            "\"phi\"",
        ),
        may(
            "direction",
            Type::String,
            "",
            "both",
            ("which changes count: rising, falling, both", "какие перемены считаются: rising (с минуса на плюс), falling, both"),
            "\"rising\"",
        ),
        may(
            "stop",
            Type::Bool,
            "",
            "false",
            (
                "the motion ends at the first event after the start; the last row of the table is that instant",
                "движение кончается при первом событии после начала; последняя строка таблицы — этот момент",
            ),
            "true",
        ),
        LABEL,
    ],
    example: "[events.return]\nzero = \"phi\"\ndirection = \"rising\"\n",
};
