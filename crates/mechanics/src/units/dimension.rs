//! Dimensions: rational exponents of the seven SI base quantities, plus soft exponents that no check of dimensions sees; SI labels.
//!
//! Three soft exponents tell the ways apart in which a turning is counted: the radian (`rad/s`), the period (`Hz`, `1/min`) and the
//! factor π. A period of one is 2π radians: where periods and π meet in a product, radians come out (2·π·f is in rad/s).

use symbolic::Rational;

/// An exponent n/d in lowest terms, d > 0.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Exponent {
    n: i32,
    d: i32,
}

/// Exponents beyond this are a slip of the pen, not physics.
const LIMIT: i64 = 1000;

impl Exponent {
    const ZERO: Exponent = Exponent { n: 0, d: 1 };

    const fn whole(n: i32) -> Exponent {
        Exponent { n, d: 1 }
    }
    fn new(n: i64, d: i64) -> Option<Exponent> {
        let (mut a, mut b) = (n.unsigned_abs(), d.unsigned_abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let g = i64::try_from(a.max(1)).ok()?;
        let (n, d) = (n / g, d / g);
        let (n, d) = if d < 0 { (-n, -d) } else { (n, d) };
        let fits = n.abs() <= LIMIT && (1..=LIMIT).contains(&d);
        fits.then_some(Exponent { n: n as i32, d: d as i32 })
    }
    fn add(self, other: Exponent) -> Option<Exponent> {
        let (a, b) = (i64::from(self.n), i64::from(self.d));
        let (c, d) = (i64::from(other.n), i64::from(other.d));
        Exponent::new(a * d + c * b, b * d)
    }
    fn mul(self, other: Exponent) -> Option<Exponent> {
        Exponent::new(i64::from(self.n) * i64::from(other.n), i64::from(self.d) * i64::from(other.d))
    }
    fn from_rational(r: &Rational) -> Option<Exponent> {
        if let Some(n) = r.to_i64() {
            return Exponent::new(n, 1);
        }
        let (n, d) = r.digits();
        Exponent::new(n.parse().ok()?, d.parse().ok()?)
    }
}

/// A dimension: length, mass, time, current, temperature, amount, light, and the soft angle, period and π.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Dimension {
    powers: [Exponent; 7],
    angle: Exponent,
    periods: Exponent,
    pi: Exponent,
}

const BASE: [&str; 7] = ["m", "kg", "s", "A", "K", "mol", "cd"];

impl Dimension {
    /// No dimension.
    pub const NONE: Dimension = Dimension::of(0, 0, 0);
    /// Angle: no dimension, shown as rad.
    pub const ANGLE: Dimension = Dimension { angle: Exponent::whole(1), ..Dimension::NONE };
    /// Angle per time.
    pub const ANGULAR_RATE: Dimension = Dimension { angle: Exponent::whole(1), ..Dimension::of(0, 0, -1) };
    /// Periods per time: hertz.
    pub(crate) const FREQUENCY: Dimension = Dimension { periods: Exponent::whole(1), ..Dimension::of(0, 0, -1) };
    /// No dimension, and a factor π.
    pub(crate) const PI: Dimension = Dimension { pi: Exponent::whole(1), ..Dimension::NONE };
    /// Length.
    pub const LENGTH: Dimension = Dimension::of(1, 0, 0);
    /// Mass.
    pub const MASS: Dimension = Dimension::of(0, 1, 0);
    /// Time.
    pub const TIME: Dimension = Dimension::of(0, 0, 1);
    /// Velocity.
    pub const VELOCITY: Dimension = Dimension::of(1, 0, -1);
    /// Acceleration.
    pub const ACCELERATION: Dimension = Dimension::of(1, 0, -2);
    /// Force.
    pub const FORCE: Dimension = Dimension::of(1, 1, -2);
    /// Energy, also moment of force.
    pub const ENERGY: Dimension = Dimension::of(2, 1, -2);
    /// Power.
    pub const POWER: Dimension = Dimension::of(2, 1, -3);
    /// Moment of inertia.
    pub const INERTIA: Dimension = Dimension::of(2, 1, 0);

    /// length^l · mass^m · time^t.
    pub const fn of(l: i32, m: i32, t: i32) -> Dimension {
        let z = Exponent::ZERO;
        Dimension { powers: [Exponent::whole(l), Exponent::whole(m), Exponent::whole(t), z, z, z, z], angle: z, periods: z, pi: z }
    }
    /// The dimension of one base quantity by its place in m, kg, s, A, K, mol, cd.
    pub(crate) const fn electric(l: i32, m: i32, t: i32, a: i32) -> Dimension {
        let mut d = Dimension::of(l, m, t);
        d.powers[3] = Exponent::whole(a);
        d
    }
    pub(crate) const fn base(index: usize) -> Dimension {
        let mut d = Dimension::NONE;
        d.powers[index] = Exponent::whole(1);
        d
    }
    /// Whether both are the same physically; the soft angle does not count.
    pub fn same(&self, other: &Dimension) -> bool {
        self.powers == other.powers
    }
    /// Whether there is no dimension (angles count as none).
    pub fn is_none(&self) -> bool {
        self.same(&Dimension::NONE)
    }
    /// Whether it is an angle or a power of time times an angle.
    pub fn is_angular(&self) -> bool {
        self.angle == Exponent::whole(1)
    }
    /// Whether periods are counted in it (Hz, 1/min) that no factor π has made radians.
    pub fn counts_periods(&self) -> bool {
        self.periods != Exponent::ZERO
    }
    /// Whether periods are counted where no angle stands beside: 25 Hz, not 2π rad times 25 Hz.
    pub(crate) fn lacks_radians(&self) -> bool {
        self.periods.n > 0 && self.angle.n <= 0
    }
    /// Whether angles are counted in it and no periods.
    pub(crate) fn has_radians(&self) -> bool {
        self.angle.n > 0 && self.periods == Exponent::ZERO
    }
    /// Whether it is a number, a time, or a power of time: what counts periods by right.
    pub(crate) fn is_of_time(&self) -> bool {
        self.angle == Exponent::ZERO && self.powers.iter().enumerate().all(|(i, p)| i == 2 || *p == Exponent::ZERO)
    }
    /// Whether it is a positive power of time.
    pub(crate) fn is_duration(&self) -> bool {
        self.is_of_time() && self.powers[2].n > 0
    }
    /// The exponent of the factor π when it is a whole number.
    pub(crate) fn pi(&self) -> i32 {
        if self.pi.d == 1 { self.pi.n } else { 0 }
    }
    /// The same, counting periods.
    pub(crate) fn in_periods(self) -> Dimension {
        Dimension { periods: Exponent::whole(1), ..self }
    }
    /// The same, counting no periods.
    pub(crate) fn without_periods(self) -> Dimension {
        Dimension { periods: Exponent::ZERO, ..self }
    }
    /// Periods times π are radians: 2·π·f.
    fn settled(self) -> Option<Dimension> {
        let (c, p) = (self.periods, self.pi);
        if c.n.signum() * p.n.signum() <= 0 {
            return Some(self);
        }
        let smaller = if i64::from(c.n.abs()) * i64::from(p.d) <= i64::from(p.n.abs()) * i64::from(c.d) { c } else { p };
        let (angle, rest) = (self.angle.add(smaller)?, invert(smaller));
        Some(Dimension { angle, periods: c.add(rest)?, pi: p.add(rest)?, ..self })
    }
    /// self · other; `None` when an exponent leaves all bounds.
    pub fn mul(&self, other: &Dimension) -> Option<Dimension> {
        let mut powers = self.powers;
        for (p, q) in powers.iter_mut().zip(other.powers) {
            *p = p.add(q)?;
        }
        let (periods, pi) = (self.periods.add(other.periods)?, self.pi.add(other.pi)?);
        Dimension { powers, angle: self.angle.add(other.angle)?, periods, pi }.settled()
    }
    /// self / other; `None` when an exponent leaves all bounds.
    pub fn div(&self, other: &Dimension) -> Option<Dimension> {
        self.mul(&other.pow(&Rational::MINUS_ONE)?)
    }
    /// self^exponent; `None` when an exponent leaves all bounds.
    pub fn pow(&self, exponent: &Rational) -> Option<Dimension> {
        let e = Exponent::from_rational(exponent)?;
        let mut powers = self.powers;
        for p in &mut powers {
            *p = p.mul(e)?;
        }
        Some(Dimension { powers, angle: self.angle.mul(e)?, periods: self.periods.mul(e)?, pi: self.pi.mul(e)? })
    }
    /// self per time^order.
    pub fn per_time(&self, order: u8) -> Dimension {
        let time = Dimension::of(0, 0, -i32::from(order));
        self.mul(&time).unwrap_or(*self)
    }
    /// The dimension of a sum: each soft exponent is that of the first summand that has one.
    pub fn with_angle_of(&self, other: &Dimension) -> Dimension {
        let first = |a: Exponent, b: Exponent| if a == Exponent::ZERO { b } else { a };
        let (angle, periods) = (first(self.angle, other.angle), first(self.periods, other.periods));
        Dimension { angle, periods, pi: first(self.pi, other.pi), ..*self }
    }
    /// Without the soft exponents.
    pub fn without_angle(&self) -> Dimension {
        Dimension { powers: self.powers, ..Dimension::NONE }
    }
}

/// Dimensions that have a customary label other than their product of base units. An energy and a moment of force have the same
/// dimension; `N m` is true of both.
const LABELS: [(Dimension, &str); 17] = [
    (Dimension::FORCE, "N"),
    (Dimension::ENERGY, "N m"),
    (Dimension::POWER, "W"),
    (Dimension::of(-1, 1, -2), "Pa"),
    (Dimension::of(0, 1, -2), "N/m"),
    (Dimension::of(0, 1, -1), "N s/m"),
    (Dimension::of(2, 1, -1), "N m s"),
    (Dimension::of(1, 1, -1), "N s"),
    (Dimension::of(-2, 1, -2), "N/m^3"),
    (Dimension::of(3, 1, -2), "N m^2"),
    (Dimension::of(2, 1, 0), "kg m^2"),
    (Dimension::electric(0, 0, 1, 1), "C"),
    (Dimension::electric(2, 1, -3, -1), "V"),
    (Dimension::electric(2, 1, -3, -2), "Ohm"),
    (Dimension::electric(-2, -1, 4, 2), "F"),
    (Dimension::electric(2, 1, -2, -2), "H"),
    (Dimension::electric(2, 1, -2, -1), "Wb"),
];

/// The label of the SI unit of a dimension: `m`, `rad/s`, `N m`, `kg m^2`, `1`. Latin, ASCII, readable by [`super::parse_unit`].
pub fn si_label(dimension: &Dimension) -> String {
    if dimension.same(&Dimension::FREQUENCY) && dimension.periods == Exponent::whole(1) && dimension.angle == Exponent::ZERO {
        return "Hz".to_owned();
    }
    // an angle divided by π is a number of turns
    let angular = dimension.is_angular() && dimension.pi.n >= 0;
    if angular && dimension.powers.iter().enumerate().all(|(i, p)| i == 2 || *p == Exponent::ZERO) {
        let time = dimension.powers[2];
        return match (time.n, time.d) {
            (0, _) => "rad".to_owned(),
            (n, 1) if n < 0 => format!("rad/{}", power("s", Exponent::whole(-n))),
            _ => format!("rad {}", power("s", time)),
        };
    }
    if let Some((_, label)) = LABELS.iter().find(|(d, _)| d.same(dimension)) {
        return (*label).to_owned();
    }
    // mass first, as in kg m^2
    let order = [1, 0, 2, 3, 4, 5, 6];
    let pick = |sign: i32| order.into_iter().filter(move |i| dimension.powers[*i].n.signum() == sign);
    let above: Vec<String> = pick(1).map(|i| power(BASE[i], dimension.powers[i])).collect();
    let below: String = pick(-1).map(|i| format!("/{}", power(BASE[i], invert(dimension.powers[i])))).collect();
    let above = if above.is_empty() { "1".to_owned() } else { above.join(" ") };
    format!("{above}{below}")
}

/// The same in Russian: `м`, `рад/с`, `Н м`, `кг м^2`.
pub fn si_label_ru(dimension: &Dimension) -> String {
    words::Text::unit(&si_label(dimension)).ru
}

fn invert(e: Exponent) -> Exponent {
    Exponent { n: -e.n, d: e.d }
}

fn power(name: &str, e: Exponent) -> String {
    match (e.n, e.d) {
        (1, 1) => name.to_owned(),
        (n, 1) => format!("{name}^{n}"),
        (n, d) => format!("{name}^({n}/{d})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::parse_unit;

    #[test]
    fn labels_are_customary_and_readable_again() {
        for label in [
            "1",
            "m",
            "kg",
            "s",
            "rad",
            "rad/s",
            "rad/s^2",
            "m/s",
            "m/s^2",
            "N",
            "N m",
            "W",
            "Pa",
            "N/m",
            "N s/m",
            "N m s",
            "N s",
            "kg m^2",
            "kg m",
            "1/s",
            "Hz",
            "1/s^2",
            "m^2",
            "m^4",
            "kg/m^3",
            "kg/m",
            "kg m/s^3/A",
            "K",
            "C",
            "V",
            "m^(1/2)",
            "N m^2",
        ] {
            let unit = parse_unit(label).unwrap();
            assert_eq!(si_label(&unit.dimension), label);
        }
    }

    #[test]
    fn labels_speak_russian_and_are_read_again() {
        for (label, russian) in
            [("kg m^2", "кг м^2"), ("N s/m", "Н с/м"), ("rad/s^2", "рад/с^2"), ("1", "1"), ("1/s", "1/с"), ("m^(1/2)", "м^(1/2)")]
        {
            let dimension = parse_unit(label).unwrap().dimension;
            assert_eq!(si_label_ru(&dimension), russian);
            assert_eq!(parse_unit(russian).unwrap().dimension, dimension);
        }
    }

    #[test]
    fn radius_times_angular_rate_is_a_velocity() {
        let v = Dimension::LENGTH.mul(&Dimension::ANGULAR_RATE).unwrap();
        assert!(v.same(&Dimension::VELOCITY));
        assert_eq!(si_label(&v), "m/s");
    }

    #[test]
    fn periods_times_pi_are_radians() {
        let frequency = parse_unit("Hz").unwrap().dimension;
        let rate = frequency.mul(&Dimension::PI).unwrap();
        assert!(rate.is_angular() && !rate.counts_periods());
        assert_eq!(si_label(&rate), "rad/s");
        let square = frequency.pow(&Rational::from(2)).unwrap().mul(&Dimension::PI).unwrap();
        assert!(square.counts_periods(), "one factor pi makes radians of one period only");
        assert!(!square.mul(&Dimension::PI).unwrap().counts_periods());
        let period = Dimension::NONE.div(&rate).unwrap();
        assert!(!period.counts_periods() && !period.has_radians());
    }

    #[test]
    fn minutes_count_periods_and_seconds_do_not() {
        for (unit, counts) in
            [("1/min", true), ("мин⁻¹", true), ("1/h", true), ("min^-2", true), ("1/s", false), ("s^-2", false), ("rev/min", false)]
        {
            assert_eq!(parse_unit(unit).unwrap().dimension.counts_periods(), counts, "{unit}");
        }
    }

    #[test]
    fn absurd_exponents_are_refused() {
        assert_eq!(Dimension::LENGTH.pow(&Rational::from(1001)), None);
        let huge = Dimension::LENGTH.pow(&Rational::from(1000)).unwrap();
        assert_eq!(huge.mul(&huge), None);
    }
}
