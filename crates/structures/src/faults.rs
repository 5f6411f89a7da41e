//! What can be wrong with a structure that was read without errors: codes S050 to S059.

use algebra::arrange::Arrange;
use algebra::elementary;
use words::explain::{Explanation, plain};
use words::{Message, Text};

/// What can be wrong with a structure.
pub type Fault = words::Notice;

/// Long texts of the codes of this folder.
pub const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S050",
        ("mechanism", "механизм"),
        (
            "Some displacements of the structure deform no rod and are held by no support or spring: it moves freely, and neither static \
             displacements nor natural frequencies above zero exist for that motion. The message names the node that moves most and the motion. \
             Add the support, the rod or the rigid connection that is missing.",
            "Некоторые перемещения не деформируют ни одного стержня и не удерживаются ни опорами, ни пружинами: конструкция геометрически \
             изменяема. В сообщении назван узел с наибольшим перемещением и само движение. Добавьте недостающую опору, стержень или жёсткое \
             соединение.",
        ),
    ),
    plain(
        "S051",
        ("loose node or piece", "незакреплённый узел или часть"),
        (
            "A node that no rod touches, or a group of rods that no support and no spring holds. Usually a name was mistyped in `between` or a \
             support is missing. Free frames (free-free beams) are not solved: their stiffness matrix is singular. Hold them by soft springs at a node.",
            "К узлу не подходит ни один стержень, либо группа стержней не имеет ни опор, ни пружин. Обычно опечатка в `between` или забыта опора. \
             Свободные рамы (незакреплённые балки) не рассчитываются: их матрица жёсткости вырождена. Закрепите их мягкими пружинами в узле.",
        ),
    ),
    plain(
        "S052",
        ("no inertia", "нет инерции"),
        (
            "A structure without any mass has no oscillations. Give nodes a `mass` or `inertia`, or rods a `mass`, `density` or \
             `mass_per_length`.",
            "У конструкции без масс нет колебаний. Задайте узлам `mass` или `inertia` либо стержням `mass`, `density` или `mass_per_length`.",
        ),
    ),
    plain(
        "S053",
        ("force not determined by statics", "усилие не определяется статикой"),
        (
            "Rods that neither stretch nor bend share a load in infinitely many ways when there are more of them (or of supports) than equations \
             of equilibrium. Give the rods named in the message a stiffness: EA (or E and A) against stretching, EI against bending.",
            "Нерастяжимые и жёсткие стержни делят нагрузку бесконечным числом способов, если их (или опор) больше, чем уравнений равновесия. \
             Задайте названным стержням жёсткость: EA (или E и A) на растяжение, EI на изгиб.",
        ),
    ),
    plain(
        "S063",
        ("frame of extreme proportions", "рама с крайними соотношениями"),
        (
            "Supports that are 10^-16 of a span apart, or stiffnesses of rods that differ by more than some 10^12, leave a motion of the structure \
             to rounding: its frequencies and displacements would be no numbers. Nodes that were meant as one, a rod of nearly no length, a unit \
             that was mistyped, or a rod that is meant as rigid is the usual cause. The message names the softest and the stiffest rod.",
            "Если опоры отстоят друг от друга на 10^-16 пролёта или жёсткости стержней различаются более чем в 10^12 раз, движение конструкции \
             определяется погрешностью округления, и её частоты и перемещения не имеют смысла. Обычная причина — узлы, которые должны совпадать, \
             стержень почти нулевой длины, ошибка в единице или стержень, который следовало задать жёстким. В сообщении названы самый податливый \
             и самый жёсткий стержни.",
        ),
    ),
    plain(
        "S064",
        ("modes of a frame that are not confirmed", "неподтверждённые формы рамы"),
        (
            "A frame that is part of a machine moves by its lowest shapes. Each shape is checked by its residual, and their number by Sturm's count; \
             with `accuracy` the frequencies are compared with those of a finer division. One of these checks failed, and no motion is computed \
             from such shapes.",
            "Рама в составе машины движется по своим низшим формам. Каждая форма проверяется невязкой, их число — счётом Штурма; при заданном \
             `accuracy` частоты сравниваются с более подробной сеткой. Одна из проверок не пройдена, и движение по таким формам не рассчитывается.",
        ),
    ),
];

fn fault(code: &'static str, what: Text, why: Text, help: Text) -> Fault {
    Fault::from(Message { code, what, why, help })
}

/// A free motion.
pub fn mechanism(node: &str, motion: &Text, count: usize) -> Fault {
    let (en, ru) = if count > 1 {
        (format!(" ({count} independent free motions; this is one)"), format!(" (независимых свободных движений: {count}; одно из них)"))
    } else {
        (String::new(), String::new())
    };
    fault(
        "S050",
        Text::new(
            format!("the structure is a mechanism at node {node}: {}{en}", motion.en),
            format!("конструкция — механизм, узел {node}: {}{ru}", motion.ru),
        ),
        Text::new(
            "this motion deforms no rod and no support or spring holds it",
            "это движение не деформирует ни одного стержня и не удерживается опорами и пружинами",
        ),
        Text::new(
            "add a support, a rod, or make a joint rigid (remove a release)",
            "добавьте опору или стержень либо сделайте узел жёстким (уберите шарнир)",
        ),
    )
}

/// A node without rods.
pub fn lonely(node: &str) -> Fault {
    fault(
        "S051",
        Text::new(format!("no rod touches node {node}"), format!("к узлу {node} не подходит ни один стержень")),
        Text::new("it would move freely along x and y", "он свободно двигался бы вдоль x и y"),
        Text::new("connect it by a rod, or remove it", "соедините его стержнем или удалите"),
    )
}

/// A piece that nothing holds.
pub fn unsupported(node: &str) -> Fault {
    fault(
        "S051",
        Text::new(
            format!("nothing holds the part of the structure with node {node}: it moves freely along x and y and turns"),
            format!("часть конструкции с узлом {node} ничем не удерживается: она свободно движется вдоль x, y и поворачивается"),
        ),
        Text::new(
            "no support and no spring belongs to it, and no rod joins it to the rest",
            "у неё нет опор и пружин, и стержни не связывают её с остальным",
        ),
        Text::new(
            "add a support: [supports.S] at = \"NODE\", directions = [\"x\", \"y\"]; a frame that is meant to be free (free-free) needs springs at a node \
             (spring_x, spring_y, spring_turn), so soft that their frequencies lie far below those of bending",
            "добавьте опору: [supports.S] at = \"УЗЕЛ\", directions = [\"x\", \"y\"]; свободной (незакреплённой) раме нужны пружины в узле (spring_x, spring_y, \
             spring_turn), столь мягкие, что их частоты намного ниже изгибных",
        ),
    )
}

/// No mass.
pub fn massless() -> Fault {
    fault(
        "S052",
        Text::new("the structure has no inertia in any of its motions", "ни одно движение конструкции не имеет инерции"),
        Text::new("no node or rod that can move has a mass", "у подвижных узлов и стержней нет массы"),
        Text::new("give a mass to a node or a rod", "задайте массу узлу или стержню"),
    )
}

/// Stiffnesses beside which others vanish in rounding.
pub fn extreme(frame: &crate::Frame<f64>) -> Fault {
    let stiffness = |r: &crate::Rod<f64>| match &r.kind {
        crate::RodKind::Beam { bending, .. } => Some(bending / elementary::powi(r.length, 3)),
        crate::RodKind::Bar(axial) => axial.map(|ea| ea / r.length),
        crate::RodKind::Rigid => None,
    };
    let mut rods: Vec<(&str, f64)> = frame.rods.iter().filter_map(|r| Some((r.name.as_str(), stiffness(r)?))).collect();
    rods.arrange_by(|a, b| a.1.total_cmp(&b.1));
    let (low, high) = match (rods.first(), rods.last()) {
        (Some(low), Some(high)) => (*low, *high),
        _ => (("-", 0.0), ("-", 0.0)),
    };
    let one = |(name, k): (&str, f64)| Text::new(format!("{name}: {k:.1e} N/m"), format!("{name}: {k:.1e} Н/м").replace('.', ","));
    let (low, high) = (one(low), one(high));
    fault(
        "S063",
        Text::new(
            format!("rounding decides whether the structure stands (softest rod {}, stiffest {})", low.en, high.en),
            format!(
                "неизменяемость конструкции определяется погрешностью округления (самый податливый стержень {}, самый жёсткий {})",
                low.ru, high.ru
            ),
        ),
        Text::new(
            "supports or nodes at nearly one place, or stiffnesses (EI/l³, EA/l) so different that beside one the other vanishes in 16 digits",
            "опоры или узлы почти в одной точке либо столь разные жёсткости (EI/l³, EA/l), что одна теряется рядом с другой в 16 цифрах",
        ),
        Text::new(
            "join nodes that are meant as one, take a very stiff rod as `rigid = true`, check the units",
            "объедините узлы, которые должны совпадать, задайте очень жёсткий стержень как `rigid = true`, проверьте единицы",
        ),
    )
}

/// Frequencies that are not as accurate as wanted.
pub fn not_reached(error: f64, wanted: f64) -> Fault {
    let (e, w) = (words::digits::rounded(error), words::digits::rounded(wanted));
    fault(
        "S064",
        Text::new(
            format!("the frame does not reach the `accuracy` {}: its frequencies are known to {}", w.en, e.en),
            format!("рама не достигает точности `accuracy` {}: её частоты известны до {}", w.ru, e.ru),
        ),
        Text::new(
            "with the finest division of the rods the error of the frequencies is still larger; where rods stretch (EA) it falls only with the square of the parts",
            "при самом подробном делении стержней погрешность частот ещё больше; там, где стержни растягиваются (EA), она убывает лишь как квадрат длины частей",
        ),
        Text::new("ask for a lower `accuracy` or fewer `modes`", "уменьшите требование `accuracy` или число `modes`"),
    )
}

/// Modes that their residuals or Sturm's count do not confirm.
pub fn unconfirmed(residual: f64, missing: f64) -> Fault {
    let n = words::digits::rounded(residual);
    fault(
        "S064",
        Text::new(
            format!("the modes of the frame are not confirmed: residual {}, modes missing {missing}", n.en),
            format!("формы рамы не подтверждены: невязка {}, пропущено форм {missing}", n.ru),
        ),
        Text::new(
            "the frame's own shapes are its coordinates in the machine; unconfirmed ones would make every study wrong",
            "собственные формы рамы служат её координатами в машине; неподтверждённые исказили бы все расчёты",
        ),
        Text::new(
            "check stiffnesses and masses for extreme ratios, ask for a lower `accuracy` or fewer `modes`",
            "проверьте крайние отношения жёсткостей и масс, уменьшите требование `accuracy` или число `modes`",
        ),
    )
}

/// Forces that statics does not give.
pub fn undetermined(names: &str) -> Fault {
    fault(
        "S053",
        Text::new(format!("statics does not determine the forces in {names}"), format!("статика не определяет усилий: {names}")),
        Text::new(
            "these do not deform, and there are more of them than equations of equilibrium",
            "они не деформируются, и их больше, чем уравнений равновесия",
        ),
        Text::new("give these rods EA, or E and A", "задайте этим стержням EA или E и A"),
    )
}
