//! Frames and trusses as the file describes them: nodes, rods, supports, loads, with every quantity an expression over constant parameters.
//!
//! Nothing is assembled here: degrees of freedom and matrices are the business of `structures`, which takes numbers, exact ones where
//! these expressions have them.

use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Text;
use words::explain::{Explanation, row};

/// A plane structure.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// Nodes, in the user's order.
    pub nodes: Vec<Node>,
    /// Rods between nodes.
    pub rods: Vec<Rod>,
    /// Supports of nodes.
    pub supports: Vec<Support>,
    /// Named displacements.
    pub displacements: Vec<Displacement>,
    /// Loads on nodes and rods.
    pub loads: Vec<Load>,
    /// Assumed shapes of rods.
    pub rayleigh: Vec<AssumedShape>,
    /// How to compute.
    pub options: Options,
    /// Highest natural frequency of the shapes that stand for the frame in the machine, rad/s, when higher ones are left out.
    pub kept: Option<f64>,
}

/// A shape of a rod assumed for Rayleigh's method.
#[derive(Clone, Debug)]
pub struct AssumedShape {
    /// Name.
    pub name: String,
    /// What it is.
    pub label: Text,
    /// The rod.
    pub rod: usize,
    /// Deflection over the distance from the start, up to a factor.
    pub shape: Expr,
    /// Its first derivative.
    pub slope: Expr,
    /// Its second derivative.
    pub curvature: Expr,
    /// The distance in it.
    pub distance: SymbolId,
    /// Where the mass is reduced to: distance from the start.
    pub at: Expr,
}

/// A node.
#[derive(Clone, Debug)]
pub struct Node {
    /// Name.
    pub name: String,
    /// Place in ground axes.
    pub at: [Expr; 2],
    /// Lumped mass.
    pub mass: Expr,
    /// Lumped moment of inertia.
    pub inertia: Expr,
    /// Stiffness of springs to the ground along x, y, against the turn.
    pub springs: [Expr; 3],
    /// Place in the file.
    pub span: Range<usize>,
}

/// A straight rod.
#[derive(Clone, Debug)]
pub struct Rod {
    /// Name.
    pub name: String,
    /// Indices of its nodes.
    pub ends: [usize; 2],
    /// Length.
    pub length: Expr,
    /// Whether it does not deform.
    pub rigid: bool,
    /// EI; none for a bar of a truss. A rigid rod may have one, for comparison.
    pub bending: Option<Expr>,
    /// EA; none for an inextensible one.
    pub axial: Option<Expr>,
    /// Mass of a unit of length.
    pub mass: Expr,
    /// Inertia of a unit of length when the turning of sections counts, else 0.
    pub rotary: Expr,
    /// The same whether it counts or not, where I and A are known.
    pub section_inertia: Option<Expr>,
    /// The number 0 in the graph of the model.
    pub rotary_of_nothing: Expr,
    /// Hinges at start and end.
    pub hinged: [bool; 2],
    /// Parts; none when the file does not say.
    pub divisions: Option<usize>,
    /// Place in the file.
    pub span: Range<usize>,
}

/// A support.
#[derive(Clone, Debug)]
pub struct Support {
    /// Name.
    pub name: String,
    /// Node.
    pub node: usize,
    /// Whether its first axis, second axis, turn are held.
    pub holds: [bool; 3],
    /// Angle of its first axis from x.
    pub angle: Expr,
    /// Place in the file.
    pub span: Range<usize>,
}

/// A place on a structure.
#[derive(Clone, Copy, Debug)]
pub enum Site {
    /// A node.
    Node(usize),
    /// A rod at a distance from its start.
    Rod(usize, Expr),
}

/// A component of a displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along the vector.
    Along([Expr; 2]),
    /// Turn.
    Turn,
}

/// A named displacement.
#[derive(Clone, Debug)]
pub struct Displacement {
    /// Name.
    pub name: String,
    /// What it is.
    pub label: Text,
    /// Where.
    pub site: Site,
    /// Which.
    pub direction: Direction,
    /// Whether anything but results and studies uses it: bodies, elements, connections, parameters.
    pub loaded: bool,
}

/// A load on a node or rod.
#[derive(Clone, Debug)]
pub struct Load {
    /// Name.
    pub name: String,
    /// Table and name in the file: `forces.f`; of a weight, those of its node or rod.
    pub path: String,
    /// What it is; may be empty.
    pub label: Text,
    /// What it does.
    pub action: Action,
}

impl Load {
    /// The load `name` of a table of the file.
    pub fn of(table: &str, name: &str, action: Action) -> Load {
        Load { name: name.to_owned(), path: format!("{table}.{name}"), label: Text::default(), action }
    }
}

/// What a load does; values may depend on time.
#[derive(Clone, Debug)]
pub enum Action {
    /// Force and couple.
    Point {
        /// Where.
        site: Site,
        /// Components along x and y, couple.
        value: [Expr; 3],
    },
    /// Force per unit of length, from the start to the end of a rod.
    Distributed {
        /// Rod.
        rod: usize,
        /// At the start and at the end.
        value: [[Expr; 2]; 2],
    },
}

/// How a structure is computed.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Whether turns with inertia follow statically; none for the rule.
    pub condense: Option<bool>,
    /// Number of modes.
    pub modes: Option<usize>,
    /// Wanted accuracy of frequencies.
    pub accuracy: Option<f64>,
    /// Whether the exact frequencies of the continuum are wanted.
    pub continuum: bool,
    /// Whether the frequencies at all levels of simplification are wanted.
    pub compare: bool,
}

/// The codes of structures.
pub const EXPLANATIONS: &[Explanation] = &[
    row(
        "M200",
        ("rod without length", "стержень нулевой длины"),
        (
            "Both ends of a rod are at one place. Bending stiffness is EI/l^3, so the length must be positive; for a joint use one node.",
            "Оба конца стержня в одной точке. Изгибная жёсткость равна EI/l^3, поэтому длина должна быть положительной; для соединения возьмите один узел.",
        ),
        "[rods.AB]\nbetween = [\"A\", \"A\"]",
        "[rods.AB]\nbetween = [\"A\", \"B\"]",
    ),
    row(
        "M201",
        ("rod without bending stiffness", "стержень без изгибной жёсткости"),
        (
            "A rod that is fixed to a node bends, and its stiffness EI is needed. A rod of a truss has releases at both ends and needs none; a rod that does not deform is `rigid = true`.",
            "Стержень, жёстко соединённый с узлом, изгибается, и нужна его жёсткость EI. Стержню фермы с шарнирами на обоих концах она не нужна; недеформируемый стержень — `rigid = true`.",
        ),
        "[rods.AB]\nbetween = [\"A\", \"B\"]",
        "[rods.AB]\nbetween = [\"A\", \"B\"]\nEI = \"20 kN m^2\"",
    ),
    row(
        "M106",
        ("a section whose axes are not principal", "сечение с неглавными осями"),
        (
            "A rod takes I_x about the section's central axis x and bends in the plane of the frame. Where I_xy is not zero that needs something that holds it against bending across the plane; a rod that is free to do so \
             bends askew, with I_x - I_xy^2/I_y. Turn the section into its principal axes, or give I or EI of the bending that is meant.",
            "Стержень берёт I_x относительно центральной оси x сечения и изгибается в плоскости рамы. Если I_xy не равен нулю, для этого изгиб из плоскости должен быть стеснён; свободный стержень испытывает косой изгиб, \
             которому отвечает I_x − I_xy²/I_y. Поверните сечение в главные оси либо задайте I или EI того изгиба, который имеется в виду.",
        ),
        "[nodes]\nA = { at = [\"0\", \"0\"] }\nB = { at = [\"1 m\", \"0\"], mass = \"2 kg\" }\n[sections.r]\nrectangle = [\"6 cm\", \"14 cm\"]\nangle = \"30 deg\"\n[rods.AB]\nbetween = [\"A\", \"B\"]\nE = \"210 GPa\"\nsection = \"r\"\n[supports.A]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]",
        "[nodes]\nA = { at = [\"0\", \"0\"] }\nB = { at = [\"1 m\", \"0\"], mass = \"2 kg\" }\n[sections.r]\nrectangle = [\"6 cm\", \"14 cm\"]\n[rods.AB]\nbetween = [\"A\", \"B\"]\nE = \"210 GPa\"\nsection = \"r\"\n[supports.A]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]",
    ),
    row(
        "M202",
        ("no such node or rod", "нет такого узла или стержня"),
        (
            "A rod, support, load or displacement names something that is not in [nodes] or [rods].",
            "Стержень, опора, нагрузка или перемещение называет то, чего нет в [nodes] и [rods].",
        ),
        "[supports.S]\nat = \"Z\"\ndirections = [\"x\", \"y\"]",
        "[supports.S]\nat = \"A\"\ndirections = [\"x\", \"y\"]",
    ),
    row(
        "M203",
        ("negative stiffness or mass of a structure", "отрицательная жёсткость или масса конструкции"),
        (
            "Stiffnesses and masses of rods and nodes are positive; EI and EA may not be zero either. The value of a parameter is probably wrong.",
            "Жёсткости и массы стержней и узлов положительны; EI и EA не могут быть и нулём. Вероятно, неверно значение параметра.",
        ),
        "[rods.AB]\nEI = \"-20 kN m^2\"",
        "[rods.AB]\nEI = \"20 kN m^2\"",
    ),
    row(
        "M204",
        ("place outside a rod", "точка вне стержня"),
        (
            "The distance from the start of a rod must lie between 0 and its length.",
            "Расстояние от начала стержня лежит между 0 и его длиной.",
        ),
        "[displacements.u]\nat = \"AB\"\ndistance = \"3 m\"\ndirection = \"y\"",
        "[displacements.u]\nat = \"AB\"\ndistance = \"1 m\"\ndirection = \"y\"",
    ),
    row(
        "M205",
        ("word that is not one of a list", "слово не из списка"),
        ("Directions are x, y, turn; releases are start, end.", "Направления: x, y, turn; шарниры: start, end."),
        "[supports.S]\nat = \"A\"\ndirections = [\"z\"]",
        "[supports.S]\nat = \"A\"\ndirections = [\"x\", \"y\"]",
    ),
    row(
        "M206",
        ("number of parts of a rod", "число частей стержня"),
        ("`divisions` is a whole number from 1 to 100000.", "`divisions` — целое число от 1 до 100000."),
        "[rods.AB]\ndivisions = 0",
        "[rods.AB]\ndivisions = 16",
    ),
    row(
        "M305",
        ("component out of the plane of a structure", "составляющая вне плоскости конструкции"),
        (
            "Frames and trusses are plane: their nodes lie in the plane x, y, forces and displacements too, couples turn about z. A third coordinate or component that is not zero would be lost, so it is refused.",
            "Рамы и фермы плоские: узлы, силы и перемещения лежат в плоскости x, y, моменты действуют вокруг z. Третья координата или составляющая, не равная нулю, была бы потеряна, поэтому она не принимается.",
        ),
        "[nodes.T]\nat = [\"1 m\", \"1 m\", \"2 m\"]",
        "[nodes.T]\nat = [\"1 m\", \"1 m\"]",
    ),
    row(
        "M306",
        ("coarse division of a frame", "грубое деление рамы"),
        (
            "Rods with mass take the static shapes that their ends give them. Where the wave of a mode is not long beside a rod, its frequency is too high. Rods in twice as many parts gave frequencies that differ by more than 5 %. Ask for an `accuracy` in [structure], or divide the rods.",
            "Стержни с массой принимают статические формы по перемещениям своих концов. Если длина волны формы не велика по сравнению со стержнем, частота завышена. При вдвое большем числе частей частоты изменились более чем на 5 %. Задайте `accuracy` в [structure] или разделите стержни.",
        ),
        "[nodes.A]\nat = [\"0\", \"0\"]\n[nodes.B]\nat = [\"1 m\", \"0\"]\n[rods.AB]\nbetween = [\"A\", \"B\"]\nEI = \"1 N m^2\"\nmass = \"2 kg\"\n[supports.S]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]\n[structure]\ncondense = false\n",
        "[nodes.A]\nat = [\"0\", \"0\"]\n[nodes.B]\nat = [\"1 m\", \"0\"]\n[rods.AB]\nbetween = [\"A\", \"B\"]\nEI = \"1 N m^2\"\nmass = \"2 kg\"\ndivisions = 8\n[supports.S]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]\n[structure]\ncondense = false\nmodes = 2\n",
    ),
    row(
        "M307",
        ("start of a displacement that follows", "начальное значение зависимого перемещения"),
        (
            "A frame has as many coordinates as independent displacements with inertia. Further displacements, and those that a load moves at once because nothing has mass there, follow from the coordinates and the loads: a start of theirs would be lost or contradict the others.",
            "У рамы столько координат, сколько независимых перемещений с инерцией. Прочие перемещения, а также те, которые нагрузка изменяет сразу, потому что масс там нет, следуют из координат и нагрузок: их начальное значение было бы потеряно или противоречило бы остальным.",
        ),
        "[nodes.A]\nat = [\"0\", \"0\"]\n[nodes.B]\nat = [\"1 m\", \"0\"]\nmass = \"2 kg\"\n[rods.AB]\nbetween = [\"A\", \"B\"]\nEI = \"1 N m^2\"\n[supports.S]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]\n[displacements]\nu = { at = \"B\", start = \"1 mm\" }\nv = { at = \"B\", direction = \"turn\", start = \"0.1 rad\" }\n",
        "[nodes.A]\nat = [\"0\", \"0\"]\n[nodes.B]\nat = [\"1 m\", \"0\"]\nmass = \"2 kg\"\n[rods.AB]\nbetween = [\"A\", \"B\"]\nEI = \"1 N m^2\"\n[supports.S]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]\n[displacements]\nu = { at = \"B\", start = \"1 mm\" }\nv = { at = \"B\", direction = \"turn\" }\n",
    ),
];
