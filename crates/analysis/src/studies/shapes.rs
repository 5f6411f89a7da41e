//! What natural motions are: frequency, ratio, root and shape of each, how shapes are scaled, what is to be said of them all.

use crate::fault::codes;
use algebra::cholesky::{Cholesky, MASSLESS, Weak};
use algebra::elementary;
use words::{Message, Text};

use crate::dataset::Audit;
use crate::{Fault, Quantity};

/// How shapes are scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Normalisation {
    /// The largest entry is 1.
    #[default]
    Largest,
    /// The entry of the first coordinate is 1.
    First,
    /// xᵀ M x = 1.
    Mass,
}

/// What a mode does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Oscillates with a decay, without one, or (negative damping) with growth.
    Oscillation,
    /// Decays without oscillation.
    Aperiodic,
    /// Free motion: nothing restores it.
    RigidBody,
    /// Grows without oscillation.
    Divergence,
}

impl Kind {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Kind::Oscillation => "oscillation",
            Kind::Aperiodic => "aperiodic",
            Kind::RigidBody => "rigid_body",
            Kind::Divergence => "divergence",
        }
    }
}

/// A complex number as (real, imaginary) part.
pub type Complex = (f64, f64);

/// The same as pairs of parts.
pub(super) fn pairs(list: &[algebra::complex::Complex]) -> Vec<Complex> {
    list.iter().map(|z| (z.re, z.im)).collect()
}

/// A mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// What it does.
    pub kind: Kind,
    /// Natural frequency |λ|, rad/s; for classical damping the one of the undamped machine; 0 for a free motion and for divergence.
    pub omega: f64,
    /// Frequency with damping |Im λ|, rad/s.
    pub damped: f64,
    /// ζ; negative for growth, NaN where there is no frequency.
    pub ratio: f64,
    /// λ with the positive imaginary part; of two real roots the slower.
    pub root: Complex,
    /// The shape, a complex number for each coordinate; real without damping.
    pub shape: Vec<Complex>,
}

impl Mode {
    /// Logarithmic decrement ln(x(t)/x(t + T)) = 2π ζ/√(1 - ζ²); none without oscillation.
    pub fn decrement(&self) -> Option<f64> {
        (self.kind == Kind::Oscillation && self.damped > 0.0).then(|| 0.0 - self.root.0 * 2.0 * std::f64::consts::PI / self.damped)
    }
    /// Whether it grows.
    pub fn grows(&self) -> bool {
        self.root.0 > 0.0
    }
}

/// How resistance enters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// There is none, and no gyroscopic or circulatory force.
    None,
    /// The shapes of the undamped machine diagonalise it.
    Classical,
    /// Damping that couples the shapes, gyroscopic or circulatory forces.
    General,
}

/// All modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// By natural frequency, free motions first.
    pub modes: Vec<Mode>,
    /// How resistance enters.
    pub damping: Damping,
    /// Whether gyroscopic forces act.
    pub gyroscopic: bool,
    /// Whether circulatory forces act.
    pub circulatory: bool,
    /// Frequencies of the machine without damping, gyroscopic and circulatory forces; 0 for free motions, NaN where C is negative.
    pub undamped: Vec<f64>,
    /// Orthogonality of the shapes, or the residual of the quadratic problem.
    pub audits: Vec<Audit>,
    /// Remarks.
    pub notes: Vec<Text>,
    /// Roots at zero that are no modes of the list, where conditions on rates restrain no places.
    pub zeros: usize,
}

pub(super) type Remark = Box<dyn Fn(usize) -> Text>;

/// Share of a shape in the metric of the masses below which an entry that is rounding of the largest is none.
const FELT: f64 = 1e-10;

/// Scales a shape; a remark when it cannot be scaled as asked.
pub(super) fn normalise(mode: &mut Mode, mass: &[f64], how: Normalisation) -> Option<Remark> {
    let n = mode.shape.len();
    let size = |z: &Complex| elementary::hypot(z.0, z.1);
    let biggest = mode.shape.iter().map(size).fold(0.0, f64::max);
    // rounding decides no sign: the first of equally large entries is taken
    let peak = *mode.shape.iter().find(|z| size(z) >= biggest * (1.0 - 1e-9))?;
    let mut remark: Option<Remark> = None;
    let divisor = match how {
        Normalisation::Largest => peak,
        // a first entry of rounding normalises nothing
        Normalisation::First if size(&mode.shape[0]) > 1e-9 * biggest => mode.shape[0],
        Normalisation::First => {
            remark = Some(Box::new(|i| {
                Text::new(
                    format!("mode {i}: the first coordinate is at rest, so its largest entry is 1"),
                    format!("форма {i}: первая координата неподвижна, поэтому единице равна наибольшая"),
                )
            }));
            peak
        }
        Normalisation::Mass => {
            let term = |p: usize| {
                let (x, y) = (mode.shape[p / n], mode.shape[p % n]);
                mass[p] * (x.0 * y.0 + x.1 * y.1)
            };
            let root = (0..n * n).map(term).sum::<f64>().sqrt();
            // an entry with digits, by which the phase is turned
            let real = mode.shape.iter().find(|z| size(z) > 1e-3 * biggest).copied().unwrap_or(peak);
            let phase = size(&real);
            (real.0 / phase * root, real.1 / phase * root)
        }
    };
    mode.shape.iter_mut().for_each(|z| *z = divided(*z, divisor));
    // some ten units of the last place of the largest entry, where it is nothing by its energy too: a heavy body beside a light one moves by so little
    let noise = 1e-14 * mode.shape.iter().map(size).fold(0.0, f64::max);
    let heavy = |i: usize| mass[i * n + i].max(0.0).sqrt();
    let felt = FELT * (0..n).map(|i| heavy(i) * size(&mode.shape[i])).fold(0.0, f64::max);
    for (_, z) in mode.shape.iter_mut().enumerate().filter(|(i, z)| heavy(*i) * size(z) <= felt) {
        if z.0.abs() < noise {
            z.0 = 0.0;
        }
        if z.1.abs() < noise {
            z.1 = 0.0;
        }
    }
    remark
}

/// a/b of complex numbers.
pub fn divided(a: Complex, b: Complex) -> Complex {
    let square = b.0 * b.0 + b.1 * b.1;
    if b.1 == 0.0 { (a.0 / b.0, a.1 / b.0) } else { ((a.0 * b.0 + a.1 * b.1) / square, (a.1 * b.0 - a.0 * b.1) / square) }
}

pub(super) fn remarks(list: &[Mode]) -> Vec<Text> {
    let mut notes = Vec::new();
    let free = list.iter().filter(|m| m.kind == Kind::RigidBody).count();
    if free > 0 {
        notes.push(Text::new(
            format!("{free} free motion(s): nothing restores them, their frequency is zero"),
            format!("свободных движений без восстанавливающей силы: {free}; их частота равна нулю"),
        ));
    }
    for (i, mode) in list.iter().enumerate().filter(|(_, m)| m.grows()) {
        let rate = words::digits::rounded(mode.root.0);
        let how = if mode.kind == Kind::Divergence {
            ("without oscillation", "без колебаний")
        } else {
            ("with oscillation", "с колебаниями")
        };
        notes.push(Text::new(
            format!("unstable: mode {} grows {} as exp({} t)", i + 1, how.0, rate.en),
            format!("неустойчиво: движение по форме {} растёт {} как exp({} t)", i + 1, how.1, rate.ru),
        ));
    }
    // equal roots are computed apart by rounding
    let same = |a: &Mode, b: &Mode| a.omega > 0.0 && elementary::hypot(a.root.0 - b.root.0, a.root.1 - b.root.1) <= 1e-9 * a.omega;
    let mut from = 0;
    while from < list.len() {
        let own = &list[from];
        let is_own = |m: &&Mode| m.root == own.root && m.omega > 0.0 && m.shape == own.shape;
        let count = list[from..].iter().take_while(is_own).count().max(1);
        if count > 1 {
            notes.push(defective([from + 1, from + count], own.root));
        }
        from += count;
        if list.get(from).is_some_and(|next| same(&list[from - 1], next)) {
            notes.push(Text::new(
                format!("modes {from} and {} have one frequency: any combination of their shapes is a shape", from + 1),
                format!("у форм {from} и {} общая частота: любая их комбинация тоже форма", from + 1),
            ));
        }
    }
    notes
}

/// What is said of a root of several modes with one shape.
fn defective([first, last]: [usize; 2], root: Complex) -> Text {
    let power = last - first;
    let t = if power == 1 { "t".to_owned() } else { format!("t^{power}") };
    let (en, ru) = if root.0 == 0.0 {
        (format!(": the motion grows as {t}"), format!(": движение растёт как {t}"))
    } else {
        (format!(", the motion has terms up to {t} exp(λ t)"), format!(", в движение входят слагаемые до {t} exp(λ t)"))
    };
    Text::new(
        format!("modes {first} to {last} have one root and one shape but for rounding (a multiple root){en}"),
        format!("у форм с {first} по {last} с точностью до округления общие корень и форма (кратный корень){ru}"),
    )
}

/// Every motion must have inertia.
///
/// *Errors*: S031, with the motion that has none.
pub fn check_mass(mass: &[f64], n: usize, names: &[Quantity]) -> Result<(), Fault> {
    let fault = |weak: Weak| massless(names.get(weak.row).map_or("?", |q| q.name.as_str()), weak.pivot);
    Cholesky::new(mass, n).map(|_| ()).map_err(fault)
}

fn massless(name: &str, pivot: f64) -> Fault {
    let what = if pivot < -MASSLESS { ("negative", "отрицательна") } else { ("zero", "равна нулю") };
    Fault::new(Message {
        code: codes::NO_INERTIA,
        what: Text::new(
            format!("the inertia of a motion with `{name}` is {} here: there are no modes", what.0),
            format!("инерция движения с координатой `{name}` здесь {}: собственных форм нет", what.1),
        ),
        why: Text::new(
            "a body without mass or inertia moves alone along this coordinate, or two coordinates move the same thing here",
            "вдоль этой координаты движется одно тело без массы и момента инерции, либо две координаты задают здесь одно и то же движение",
        ),
        help: Text::new(
            "give that body a mass or an inertia, or remove the coordinate",
            "задайте телу массу или момент инерции либо уберите координату",
        ),
    })
}
