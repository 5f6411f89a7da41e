//! What a key of the model file is: its type, its dimension, what it defaults to, what it means; a table is a list of keys. Keys that stand in several
//! tables stand here.

/// A pair of wordings, English and Russian.
pub type Words = (&'static str, &'static str);

/// What a value is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Type {
    /// A string, or `{ en = "...", ru = "..." }`.
    Text,
    /// A plain string.
    String,
    /// A formula, a quantity or a number.
    Formula,
    /// Two or three formulas.
    Vector,
    /// A formula or two or three of them.
    FormulaOrVector,
    /// A unit.
    Unit,
    /// A name from the file.
    Name,
    /// Two names.
    TwoNames,
    /// A vector or the name of a point.
    VectorOrPoint,
    /// true or false.
    Bool,
    /// `["z: psi", "x: alpha"]`.
    Rotations,
    /// `disc(R)` and so on.
    Shape,
    /// A formula or a table of six.
    Inertia,
    /// false, a formula or a vector.
    Gravity,
    /// A list of names.
    Names,
    /// A name or a list of names.
    NameOrNames,
    /// A list of quantities.
    Quantities,
    /// A list of formulas.
    Formulas,
    /// Values of parameters.
    Ranges,
    /// A list of plots.
    Plots,
    /// A table of quantities by name.
    Guess,
    /// A list of corners.
    Corners,
    /// Two lengths, or three corners.
    LegsOrCorners,
    /// A list of parts of a section.
    Parts,
    /// A table of tables or values by name.
    Table,
    /// An array of tables.
    Array,
}

impl Type {
    /// In words.
    pub fn words(self) -> Words {
        match self {
            Type::Text => ("text or { en, ru }", "текст или { en, ru }"),
            Type::String => ("string", "строка"),
            Type::Formula => ("formula, quantity or number", "формула, величина или число"),
            Type::Vector => ("array of 2 or 3 formulas", "массив из 2 или 3 формул"),
            Type::FormulaOrVector => ("formula, or array of 2 or 3 formulas", "формула или массив из 2 или 3 формул"),
            Type::Unit => ("unit", "единица"),
            Type::Name => ("name", "имя"),
            Type::TwoNames => ("array of 2 names", "массив из 2 имён"),
            Type::VectorOrPoint => ("array of 2 or 3 formulas, or the name of a point", "массив из 2 или 3 формул или имя точки"),
            Type::Bool => ("true or false", "true или false"),
            Type::Rotations => ("array of \"axis: angle\"", "массив строк \"ось: угол\""),
            Type::Shape => ("shape", "форма"),
            Type::Inertia => ("formula, or table { xx, yy, zz, xy, yz, xz }", "формула или таблица { xx, yy, zz, xy, yz, xz }"),
            Type::Gravity => ("false, formula, or array of 2 or 3 formulas", "false, формула или массив из 2 или 3 формул"),
            Type::Names => ("array of names", "массив имён"),
            Type::NameOrNames => ("name, or array of names", "имя или массив имён"),
            Type::Quantities => ("array of quantities", "массив величин"),
            Type::Formulas => ("array of formulas", "массив формул"),
            Type::Ranges => ("string, or array of strings", "строка или массив строк"),
            Type::Plots => ("array of names, arrays of names or { x, y, title }", "массив имён, массивов имён или { x, y, title }"),
            Type::Guess => ("table of quantities by coordinate", "таблица величин по координатам"),
            Type::Corners => ("array of corners [x, y]", "массив вершин [x, y]"),
            Type::LegsOrCorners => ("array of 2 lengths, or of 3 corners [x, y]", "массив из 2 длин или из 3 вершин [x, y]"),
            Type::Parts => ("array of parts", "массив частей"),
            Type::Table => ("table", "таблица"),
            Type::Array => ("array of tables", "массив таблиц"),
        }
    }
}

/// A key.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Key.
    pub key: &'static str,
    /// What its value is.
    pub ty: Type,
    /// SI label of the dimension; empty when there is none to speak of.
    pub dimension: &'static str,
    /// Whether it must be there.
    pub required: bool,
    /// What holds without it; empty when nothing.
    pub default: &'static str,
    /// Meaning.
    pub about: Words,
    /// An example, as written after `=`.
    pub example: &'static str,
}

/// A table of the file.
#[derive(Clone, Copy, Debug)]
pub struct TableSpec {
    /// Name as in headers: `bodies`; entries are `[bodies.NAME]`.
    pub name: &'static str,
    /// Meaning.
    pub about: Words,
    /// Keys.
    pub fields: &'static [Field],
    /// A short form, when there is one.
    pub short: Option<Words>,
    /// A running example.
    pub example: &'static str,
}

impl TableSpec {
    /// The key of that name.
    pub fn field(&self, key: &str) -> Option<&'static Field> {
        self.fields.iter().find(|f| f.key == key)
    }
}

pub(crate) const fn must(key: &'static str, ty: Type, dimension: &'static str, about: Words, example: &'static str) -> Field {
    Field { key, ty, dimension, required: true, default: "", about, example }
}
#[expect(clippy::too_many_arguments, reason = "a row of a table, column by column")]
pub(crate) const fn may(
    key: &'static str,
    ty: Type,
    dimension: &'static str,
    default: &'static str,
    about: Words,
    example: &'static str,
) -> Field {
    Field { key, ty, dimension, required: false, default, about, example }
}

pub(crate) const SYMBOL: Field = may("symbol", Type::String, "", "", ("printed symbol", "обозначение для печати"), "\"ω_p\"");
pub(crate) const LABEL: Field = may("label", Type::Text, "", "", ("what it is", "что это"), "{ en = \"mass\", ru = \"масса\" }");
pub(crate) const ALONG: Field = may(
    "along",
    Type::Formula,
    "",
    "",
    ("pathway: a formula of coordinates", "координата элемента: формула от обобщённых координат"),
    "\"x\"",
);
pub(crate) const BETWEEN: Field = may(
    "between",
    Type::TwoNames,
    "",
    "",
    (
        "pathway: distance of two points, or angle of the second body minus that of the first",
        "координата элемента: расстояние между двумя точками или угол второго тела минус угол первого",
    ),
    "[\"A\", \"B\"]",
);
pub(crate) const ON: Field =
    may("on", Type::Name, "", "\"ground\"", ("frame or body it stands on", "система отсчёта или тело, на котором стоит"), "\"crank\"");
pub(crate) const ORIGIN: Field = may(
    "origin",
    Type::VectorOrPoint,
    "m",
    "[0, 0]",
    ("origin in the axes of `on`, or a point", "начало в осях `on` или точка"),
    "[\"x\", \"y\"]",
);
pub(crate) const ANGLE: Field =
    may("angle", Type::Formula, "rad", "0", ("turn about z from `on`", "поворот вокруг z относительно `on`"), "\"phi\"");
pub(crate) const ROTATE: Field = may(
    "rotate",
    Type::Rotations,
    "rad",
    "",
    (
        "successive turns, each about an own, already turned axis",
        "последовательные повороты, каждый вокруг собственной, уже повёрнутой оси",
    ),
    "[\"z: psi\", \"x: theta\"]",
);
pub(crate) const SPIN: Field = may(
    "spin",
    Type::Formula,
    "rad/s",
    "0",
    (
        "prescribed rate of turning about the own z (or \"x: rate\") after all other turns; constant or a formula of time",
        "заданная угловая скорость вокруг собственной z (или \"x: скорость\") после всех поворотов; постоянная или функция времени",
    ),
    "\"1450 rpm\"",
);

pub(crate) const DISTANCE: Field =
    may("distance", Type::Formula, "m", "0", ("distance from the start of the rod", "расстояние от начала стержня"), "\"l/2\"");

/// `{ en = ..., ru = ... }`.
pub const TEXT: TableSpec = TableSpec {
    name: "text",
    about: ("text in two languages", "текст на двух языках"),
    short: None,
    fields: &[
        may("en", Type::String, "", "the other", ("English", "по-английски"), "\"mass\""),
        may("ru", Type::String, "", "the other", ("Russian", "по-русски"), "\"масса\""),
    ],
    example: "",
};
