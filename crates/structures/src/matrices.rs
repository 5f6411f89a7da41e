//! What can be wrong with the matrices of a linear problem, in words. Who knows what the rows mean names the node and the free motion instead.

use algebra::Trouble;
use algebra::trouble::{Defect, Pivot};
use words::{Message, Text};

use crate::Fault;

/// A trouble in words that name rows alone.
pub fn told(trouble: Trouble) -> Fault {
    match trouble {
        Trouble::Pivot(pivot) => singular(&pivot),
        Trouble::Massless(row) => massless(row),
        Trouble::Malformed(name) => malformed(name),
        Trouble::Unconverged { found, wanted } => unconverged(found, wanted),
        Trouble::Memory => memory(),
    }
}

fn singular(pivot: &Pivot) -> Fault {
    let row = pivot.row + 1;
    let what = match pivot.defect {
        Defect::Singular => {
            Text::new(format!("the stiffness matrix is singular at row {row}"), format!("матрица жёсткости вырождена в строке {row}"))
        }
        Defect::Negative => Text::new(
            format!("the stiffness matrix has a negative pivot at row {row}"),
            format!("матрица жёсткости имеет отрицательный ведущий элемент в строке {row}"),
        ),
    };
    Fault::from(Message {
        code: "S022",
        what,
        why: Text::new(
            "the structure can move without elastic resistance: it is a mechanism, a part is not supported, or a stiffness is negative",
            "конструкция может двигаться без упругого сопротивления: это механизм, часть не закреплена или жёсткость отрицательна",
        ),
        help: Text::new(
            "add a support or a rod that stops the free motion, check releases and the signs of stiffnesses",
            "добавьте опору или стержень, препятствующий свободному движению, проверьте шарниры и знаки жёсткостей",
        ),
    })
}

/// The mass matrix is not positive definite; `row` is the first coordinate without inertia of its own.
fn massless(row: usize) -> Fault {
    let row = row + 1;
    Fault::from(Message {
        code: "S021",
        what: Text::new(
            format!("the mass matrix is not positive definite: row {row}"),
            format!("матрица масс не положительно определена: строка {row}"),
        ),
        why: Text::new("a coordinate has no inertia, or a mass is negative", "координата не обладает инерцией, или масса отрицательна"),
        help: Text::new(
            "give the part a mass or a moment of inertia, or take the coordinate out (condense it, connect it rigidly)",
            "задайте массу или момент инерции части либо исключите координату (конденсацией, жёсткой связью)",
        ),
    })
}

/// An entry is infinite or undefined, or the matrix has the wrong size.
fn malformed(name: &str) -> Fault {
    Fault::from(Message {
        code: "S024",
        what: Text::new(
            format!("the matrix {name} has an entry that is not a finite number, or a wrong size"),
            format!("в матрице {name} есть не конечное число, или её размер неверен"),
        ),
        why: Text::new(
            "a formula was taken outside its domain, or a datum is missing or overflows",
            "формула вышла за область определения, или данные отсутствуют либо переполняются",
        ),
        help: Text::new("check the data of the parts (lengths, masses, stiffnesses)", "проверьте данные частей (длины, массы, жёсткости)"),
    })
}

/// The iteration for eigenvalues did not end.
fn unconverged(found: usize, wanted: usize) -> Fault {
    Fault::from(Message {
        code: "S023",
        what: Text::new(
            format!("only {found} of {wanted} eigenvalues converged"),
            format!("сошлись только {found} из {wanted} собственных значений"),
        ),
        why: Text::new(
            "the matrices are nearly singular or very badly scaled, or the structure has fewer oscillations than were asked for",
            "матрицы почти вырождены или очень плохо масштабированы, либо у конструкции меньше колебаний, чем запрошено",
        ),
        help: Text::new(
            "ask for fewer modes; check for parts whose stiffnesses or masses differ by many orders of magnitude",
            "запросите меньше форм; проверьте, нет ли частей, жёсткости или массы которых различаются на много порядков",
        ),
    })
}

/// Not enough memory for a factor.
fn memory() -> Fault {
    Fault::from(Message {
        code: "S005",
        what: Text::new("the factor of the matrix does not fit into memory", "разложение матрицы не помещается в память"),
        why: Text::new("the structure is very large", "конструкция очень велика"),
        help: Text::new("take fewer divisions of the rods", "уменьшите число делений стержней"),
    })
}

/// Explanation of S021.
pub const MASS_EN: &str = "The kinetic energy must be positive for every motion. A coordinate without mass or moment of inertia has no equation of motion: \
    its acceleration is not determined. Give the part an inertia, or remove the coordinate by static condensation or a rigid connection.";
/// The same in Russian.
pub const MASS_RU: &str = "Кинетическая энергия должна быть положительна при любом движении. Для координаты без массы и момента инерции уравнение движения \
    не определяет ускорения. Задайте инерцию или исключите координату статической конденсацией либо жёсткой связью.";
/// Explanation of S022.
pub const SINGULAR_EN: &str = "Static displacements need a positive definite stiffness matrix. When a pivot of its elimination vanishes, the structure can move \
    without elastic resistance: a mechanism, an unsupported part, too many releases. When it is negative, a stiffness has the wrong sign or the structure has \
    lost its stability.";
/// The same in Russian.
pub const SINGULAR_RU: &str = "Для статических перемещений матрица жёсткости должна быть положительно определена. Если ведущий элемент исключения обращается в \
    нуль, конструкция может двигаться без упругого сопротивления: механизм, незакреплённая часть, лишние шарниры. Если он отрицателен, жёсткость имеет неверный \
    знак или конструкция потеряла устойчивость.";
/// Explanation of S023.
pub const CONVERGENCE_EN: &str = "The search for eigenvalues stopped at its cap of steps. Usually stiffnesses or masses of the parts differ by more orders of \
    magnitude than double numbers hold, or more modes are asked for than the structure has masses.";
/// The same in Russian.
pub const CONVERGENCE_RU: &str = "Поиск собственных значений остановлен по пределу числа шагов. Обычно жёсткости или массы частей различаются на большее число \
    порядков, чем позволяют числа двойной точности, либо запрошено больше форм, чем в конструкции масс.";
/// Explanation of S024.
pub const MALFORMED_EN: &str = "An entry of a matrix is infinite or undefined: a length of zero in a denominator, a datum that overflows.";
/// The same in Russian.
pub const MALFORMED_RU: &str = "Элемент матрицы бесконечен или не определён: нулевая длина в знаменателе, переполнение данных.";
