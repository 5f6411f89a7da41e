//! Keys of `[variants]` and `[[answers]]`.

use crate::keys::{TableSpec, Type, may, must};

/// `[variants]`.
pub const VARIANTS: TableSpec = TableSpec {
    name: "variants",
    about: (
        "Variants of the data, chosen by --variant NAME; `strutt variants check FILE` looks at all of them. They come from a CSV table or from a range of numbers, `N = \"1..30\"`, with formulas. A header of the table is the name of a parameter, of a coordinate (its start) or phi' (its rate), with a unit in brackets if the numbers are not SI: `m [g]`. Commas, semicolons or tabs separate; with semicolons commas are decimal marks; lines with # are remarks; an empty cell changes nothing; `absent` (`отсутствует`, `нет`) stands for a part that the variant does not have: zero. Any other key is a parameter, a start or a rate and gives its formula over n (number of the group), N (number of the variant), constant parameters and columns of the table: `m1 = \"10 [kg] + 0.5 [kg]*n + 0.1 [kg]*N\"`; the own name stands for the value of the table or file. [variants.require] holds conditions that a variant must keep, over the same names and over the answers: `away = \"abs(p/k - 1) > 0.15\"`.",
        "Варианты исходных данных; вариант выбирают ключом --variant ИМЯ, все варианты просматривает `strutt variants check ФАЙЛ`. Их задаёт таблица CSV или диапазон номеров `N = \"1..30\"` с формулами. Заголовок столбца — имя параметра, координаты (начальное значение) или phi' (начальная скорость), с единицей в скобках, если числа не в СИ: `m [г]`. Разделители: запятая, точка с запятой или табуляция; при точке с запятой запятая — десятичная; строки с # — примечания; пустая клетка ничего не меняет; `отсутствует` (`нет`, `absent`) — детали в этом варианте нет, её величина равна нулю. Любой другой ключ — параметр, начальное значение или скорость; ему задают формулу от n (номер группы), N (номер варианта), постоянных параметров и столбцов таблицы: `m1 = \"10 [кг] + 0.5 [кг]*n + 0.1 [кг]*N\"`; собственное имя обозначает значение из таблицы или файла. В [variants.require] стоят условия, которым вариант должен удовлетворять; в них можно использовать те же имена и ответы: `away = \"abs(p/k - 1) > 0.15\"`.",
    ),
    short: None,
    fields: &[
        may(
            "table",
            Type::String,
            "",
            "",
            ("file with the table, beside the model file", "файл таблицы рядом с файлом модели"),
            "\"variants.csv\"",
        ),
        may("rows", Type::String, "", "", ("the table itself, instead of `table`", "сама таблица вместо `table`"), "\"\"\"...\"\"\""),
        may(
            "N",
            Type::String,
            "",
            "",
            ("the numbers of the variants, where there is no table", "номера вариантов, если таблицы нет"),
            "\"1..30\"",
        ),
        may(
            "n",
            Type::Formula,
            "1",
            "",
            ("number of the group, where --group gives none", "номер группы, если не задан ключ --group"),
            "3",
        ),
        may("key", Type::String, "", "first column", ("column that names the variant", "столбец с названием варианта"), "\"variant\""),
        may(
            "columns",
            Type::Names,
            "",
            "all others",
            (
                "columns that are used; the others are for the reader. A column with a unit in brackets that is no name of the model is a quantity for the formulas: \"I1r [kg m^2]\"",
                "используемые столбцы; остальные — для читателя. Столбец с единицей в скобках, не являющийся именем модели, — величина для формул: \"I1r [кг м^2]\"",
            ),
            "[\"m\", \"c\", \"v\"]",
        ),
        may(
            "empty",
            Type::String,
            "",
            "\"keeps\"",
            (
                "what an empty cell means: \"keeps\", the value of the file; \"absent\", no such part",
                "что значит пустая клетка: \"keeps\" — значение файла, \"absent\" — детали нет",
            ),
            "\"absent\"",
        ),
        may(
            "number",
            Type::Name,
            "",
            "",
            ("parameter that gets the number of the variant", "параметр, получающий номер варианта"),
            "\"N\"",
        ),
        may("group", Type::Name, "", "", ("parameter that gets the number of the group", "параметр, получающий номер группы"), "\"n\""),
        may("require", Type::Table, "", "", ("conditions by name", "условия по именам"), "{ slow = \"omega < 30 [rad/s]\" }"),
    ],
    example: "[variants]\nN = \"1..30\"\nm = \"10 [kg] + 0.5 [kg]*n + 0.1 [kg]*N\"\n\n[variants.require]\nlight = \"m < 20 [kg]\"\n",
};

/// `[[answers]]`.
pub const ANSWER: TableSpec = TableSpec {
    name: "answers",
    about: (
        "An item that a student answers: the number comes from a study of the file or from a formula; `strutt variants make` prints the questions and the key, `strutt variants grade` checks what was handed in.",
        "Вопрос, на который отвечает студент: число берётся из расчёта файла или вычисляется по формуле; `strutt variants make` печатает вопросы и ключ, `strutt variants grade` проверяет сданные ответы.",
    ),
    short: None,
    fields: &[
        must("id", Type::String, "", ("short name, in tables and files", "краткое имя в таблицах и файлах"), "\"f1\""),
        may(
            "ask",
            Type::Text,
            "",
            "the id",
            ("the question", "вопрос"),
            "{ en = \"First natural frequency\", ru = \"Первая собственная частота\" }",
        ),
        may(
            "value",
            Type::String,
            "",
            "",
            (
                "a number of a study: max(x), min(x), amplitude(x), mean(x), last(x) of an output or coordinate, when_max(x), when_min(x) for the instant, event(2) or event(top, 1) for the instant of an event, or a number of the study by its path, lists counted from 1: modes.1.f, period",
                "число из расчёта: max(x), min(x), amplitude(x), mean(x), last(x) от выходной величины или координаты, when_max(x), when_min(x) — момент, event(2) или event(top, 1) — момент события, либо число расчёта по его пути, счёт в списках с 1: modes.1.f, period",
            ),
            "\"modes.1.f\"",
        ),
        may(
            "formula",
            Type::Formula,
            "",
            "",
            (
                "a formula of constant parameters, n, N and answers above, instead of `value`",
                "вместо `value` — формула от постоянных параметров, n, N и предыдущих ответов",
            ),
            "\"2*pi/k\"",
        ),
        may("of", Type::String, "", "first that fits", ("kind of the study", "вид расчёта"), "\"simulate\""),
        may(
            "at",
            Type::String,
            "",
            "",
            (
                "`value` is an output at this instant: a time, when_max(x), when_min(x), event(2); at a jump \"after event(2)\" or \"before event(2)\"",
                "`value` — выходная величина в этот момент: время, when_max(x), when_min(x), event(2); при скачке — \"after event(2)\" или \"before event(2)\"",
            ),
            "\"0.5 s\"",
        ),
        may("unit", Type::Unit, "", "pure number", ("unit of the answer", "единица ответа"), "\"Hz\""),
        may(
            "tolerance",
            Type::String,
            "",
            "\"1 %\"",
            (
                "how far a right answer may be off: a share of the value, or a quantity",
                "допустимое отклонение верного ответа: доля величины или величина с единицей",
            ),
            "\"2 %\"",
        ),
        may(
            "gives",
            Type::Name,
            "",
            "",
            (
                "parameter that the items below are computed with: a student's own value carries on",
                "параметр, с которым вычисляются следующие ответы: собственное значение студента идёт дальше",
            ),
            "\"F0\"",
        ),
    ],
    example: "[[answers]]\nid = \"f1\"\nask = { en = \"First natural frequency\", ru = \"Первая собственная частота\" }\nvalue = \"modes.1.f\"\nunit = \"Hz\"\ntolerance = \"2 %\"\n",
};
