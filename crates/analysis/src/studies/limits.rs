//! How far the equations of small motions hold for an amplitude that they give.
//!
//! Two things are left out: what oscillates in the coefficients (M₁ cos νt beside M, which turns a motion at ω into forces at ω ± ν), and what
//! M(q) q'' - h(q, q') does beyond its straight line M δq'' + B δq' + C δq. The first is measured on the amplitudes X, relative to the terms of the equations,
//! the second by the amplitudes of the whole equations themselves, from harmonic balance.

use algebra::elementary;
use words::{Message, Text};

use crate::linear::{LinearMachine, Matrices, Place, Seen, Values};
use crate::studies::balance::{self, Balance, Found, Wave, counting};
use crate::studies::modes::Complex;
use crate::studies::response::{Forced, Point, magnitude};
use crate::{Fault, Quantity};
use words::digits::rounded;
use words::explain::{Explanation, plain};

/// Forces from oscillating coefficients that may be left out without a word, relative to the terms: tables show six digits.
const FED_BACK: f64 = 1e-6;
/// The same with a word; beyond it a study of small motions has no answer that two digits could be given of.
const TOLD: f64 = 1e-2;
/// Distance of amplitudes, motions and outputs from their straight lines that is worth a word.
const BENT: f64 = 1e-2;
/// Distance of the forces from their straight line, as a share of their terms, that is looked into.
const STRAIGHT: f64 = 1e-6;

/// S108.
pub const PULSATING: Explanation =
    plain("S108", ("coefficients that oscillate in time", "коэффициенты, колеблющиеся во времени"), (PULSATING_EN, PULSATING_RU));
const PULSATING_EN: &str = "Inertia, damping or stiffness oscillate in time (a rotor with unequal moments of inertia in axes at rest, a pulsating spring), so that one \
    frequency of the load is answered at many, and these act back on the first. The amplitudes of `response` are those of the means. Where \
    inertia and damping act back by more than a hundredth of the forces they are refused; below that a note says by how much the amplitudes are uncertain. An output that follows the motion by a factor that oscillates, as x*cos(w*t) or the moment of a guide under swinging masses, is refused where the oscillating part makes more than a fifth of its amplitude, and told below. Wrong: response of a rotor with xx and yy that differ, its angles counted at rest. Right: count its angles in the turning frame, where the coefficients are \
    constant, or find the regime with `periodic`.";
const PULSATING_RU: &str = "Инерция, сопротивление или жёсткость колеблются во времени (ротор с неравными моментами инерции в неподвижных осях, пульсирующая жёсткость), \
    поэтому на одну частоту нагрузки приходится много частот отклика, влияющих на первую. Амплитуды `response` получены по средним. Если \
    колебания инерции и сопротивления дают более сотой доли сил, в амплитудах отказано; ниже этого примечание сообщает их погрешность. В амплитуде величины, зависящей от движения через колеблющийся множитель (x*cos(w*t), момент в направляющей под качающимися массами), отказано, если колеблющаяся часть составляет более пятой её доли; ниже этого – примечание. Неверно: response ротора с разными xx и yy, углы которого отсчитаны от неподвижных осей. Верно: отсчитывайте углы во вращающихся осях, где \
    коэффициенты постоянны, или найдите режим с помощью `periodic`.";

impl Forced<'_> {
    /// Whether the amplitudes of a point can be believed: remarks where coefficients oscillate, and where the whole equations give others.
    ///
    /// *Errors*: S108 where coefficients that oscillate in time act back on them.
    pub fn limits(&mut self, point: &Point) -> Result<Vec<Text>, Fault> {
        let order = self.components.get(self.current).map_or(1.0, |c| c.order);
        self.matrices(point.omega / order)?;
        let pulsing = steady(self.machine, &self.place, point.omega, &point.coordinates)?;
        let bent = bent(self, point.omega / order)?;
        Ok(pulsing.into_iter().chain(bent).collect())
    }

    /// Outputs that leave their straight line within the amplitudes of a point, and by which share; from then on superposed motions take their values
    /// from the formulas themselves.
    ///
    /// *Errors*: an output has no finite value at the place.
    pub fn curved(&mut self, point: &Point) -> Result<Vec<(usize, f64)>, Fault> {
        let order = self.components.get(self.current).map_or(1.0, |c| c.order);
        self.matrices(point.omega / order)?;
        let Some(formulas) = &self.formulas else { return Ok(Vec::new()) };
        let seen = self.machine.observe(&self.observer, &self.place)?;
        let shares = curved(self.machine, &self.place, formulas, &seen, (point.omega, &point.coordinates));
        let found: Vec<(usize, f64)> = shares.into_iter().enumerate().filter(|(_, s)| *s > 0.0).collect();
        self.bent = found.iter().map(|f| f.0).collect();
        Ok(found)
    }
}

/// A remark where coefficients oscillate: of a spring that pulsates, or of a load that depends on the place, which is small of second order; of the inertia of
/// an unbalanced body on a support that turns.
///
/// *Errors*: S108 where oscillating inertia or damping acts back on the amplitudes X at ω by more than a hundredth.
pub fn steady(machine: &LinearMachine, place: &Place, omega: f64, x: &[Complex]) -> Result<Option<Text>, Fault> {
    if !machine.timing().varying || x.iter().any(|z| !magnitude(*z).is_finite()) {
        return Ok(None);
    }
    let [mass, damping, stiffness] = machine.pulsation(place)?;
    let (n, none) = (x.len(), vec![0.0; x.len() * x.len()]);
    let whole = terms(&machine.clone().at(place)?, omega, x);
    let share = |m: Matrices| -> f64 {
        let fed = terms(&m, omega, x);
        fed.iter().zip(&whole).filter(|(_, w)| **w > 0.0).map(|(f, w)| f / w).fold(0.0, f64::max)
    };
    let own = share(Matrices { n, mass, damping, stiffness: none.clone(), ..Matrices::default() });
    let of_places = share(Matrices { n, mass: none.clone(), damping: none, stiffness, ..Matrices::default() });
    if own > TOLD {
        return Err(pulsating(own, omega));
    }
    if own > FED_BACK.max(of_places) {
        return Ok(Some(little(own, omega)));
    }
    Ok((of_places > FED_BACK).then(|| {
        let (share, omega) = (rounded(of_places), rounded(omega));
        Text::new(
            format!(
                "stiffnesses oscillate in time (a load that depends on the place, a spring that pulsates): at ω = {} rad/s they act with {} of the forces of the \
                 means, and the amplitudes are uncertain by as much; `periodic` gives them exactly",
                omega.en, share.en
            ),
            format!(
                "жёсткости колеблются во времени (нагрузка, зависящая от положения, пульсирующая жёсткость): при ω = {} рад/с они дают {} от сил, вычисленных по средним, \
                 и настолько же неточны амплитуды; точные даёт `periodic`",
                omega.ru, share.ru
            ),
        )
    }))
}

fn little(share: f64, omega: f64) -> Text {
    let (share, omega) = (rounded(share), rounded(omega));
    Text::new(
        format!(
            "inertia or damping oscillates in time (an unbalanced body on a support that turns, say): at ω = {} rad/s the oscillating parts act with {} of the forces of \
             the means, and the amplitudes are uncertain by as much; `periodic` gives them exactly",
            omega.en, share.en
        ),
        format!(
            "инерция или сопротивление колеблется во времени (например, неуравновешенное тело на поворачивающейся опоре): при ω = {} рад/с колеблющиеся части дают {} от \
             сил, вычисленных по средним, и настолько же неточны амплитуды; точные даёт `periodic`",
            omega.ru, share.ru
        ),
    )
}

/// S108 of an output.
pub(super) fn unsteady(name: &str, share: f64) -> Fault {
    let size = match share.is_finite() {
        false => Text::new("its mean is zero", "его среднее равно нулю"),
        true => {
            let share = rounded(share);
            Text::new(
                format!("the oscillating part makes up to {} of the amplitude by the mean", share.en),
                format!("колеблющаяся часть даёт до {} от амплитуды, найденной по среднему", share.ru),
            )
        }
    };
    Fault::new(Message {
        code: "S108",
        what: Text::new(
            format!("`{name}` follows the small motion by a factor that oscillates in time: it has no amplitude by the mean"),
            format!(
                "величина `{name}` зависит от малого движения через множитель, колеблющийся во времени: амплитуды по среднему у неё нет"
            ),
        ),
        why: size,
        help: Text::new(
            "leave it out of `outputs`, or take it from `periodic` or `simulate`",
            "уберите её из `outputs` или возьмите из `periodic` либо `simulate`",
        ),
    })
}

/// S108 of an output that depends on time in another way than by harmonics.
pub fn unrepeated(name: &str) -> Fault {
    Fault::new(Message {
        code: "S108",
        what: Text::new(
            format!("`{name}` depends on time directly, and not by a sum of harmonics: it has no amplitude"),
            format!("величина `{name}` непосредственно зависит от времени, и не как сумма гармоник: амплитуды у неё нет"),
        ),
        why: Text::new(
            "time in its formula repeats in no known period, or stands under a root or another function together with the motion",
            "время входит в её формулу без известного периода либо стоит вместе с движением под корнем или другой функцией",
        ),
        help: Text::new(
            "leave it out of `outputs`, or take it from `periodic` or `simulate`",
            "уберите её из `outputs` или возьмите из `periodic` либо `simulate`",
        ),
    })
}

fn pulsating(share: f64, omega: f64) -> Fault {
    let (share, omega) = (rounded(share), rounded(omega));
    Fault::new(Message {
        code: "S108",
        what: Text::new(
            "the coefficients oscillate in time: amplitudes by their means are wrong",
            "коэффициенты колеблются во времени: амплитуды по средним неверны",
        ),
        why: Text::new(
            format!("at ω = {} rad/s their oscillating parts act with {} of the forces of the means", omega.en, share.en),
            format!("при ω = {} рад/с колеблющиеся части дают {} от сил, вычисленных по средним", omega.ru, share.ru),
        ),
        help: Text::new(
            "use `periodic`, or coordinates in which the coefficients are constant",
            "примените `periodic` или координаты, в которых коэффициенты постоянны",
        ),
    })
}

/// Σ_j (ω² |M_ij| + ω |B_ij| + |C_ij|) |X_j|.
fn terms(m: &Matrices, omega: f64, x: &[Complex]) -> Vec<f64> {
    let entry = |p: usize| omega * omega * m.mass[p].abs() + omega * m.damping[p].abs() + m.stiffness[p].abs();
    (0..m.n).map(|i| (0..m.n).map(|j| entry(i * m.n + j) * magnitude(x[j])).sum()).collect()
}

/// A remark where the whole equations give other amplitudes than small motions at ω do, and by how much.
///
/// *Errors*: formulas without a value at this frequency.
pub(super) fn bent(forced: &mut Forced, omega: f64) -> Result<Option<Text>, Fault> {
    forced.matrices(omega)?;
    if !forced.machine.bends() {
        return Ok(None);
    }
    let Some((rate, waves)) = balance::waves(forced, omega)? else { return Ok(None) };
    let place = forced.place.clone();
    let share = leaves(forced.machine, &place, (rate, &waves));
    if share <= STRAIGHT {
        return Ok(None);
    }
    let Some(mut balance) = Balance::new(forced.machine, &place, (rate, waves.clone()), BENT)? else {
        return Ok((share > BENT).then(|| by_forces(omega, share)));
    };
    let counts = counting(&forced.machine.at(&place)?, &waves, rate);
    Ok(match balance.solve() {
        Found::Lost { share, good } => Some(lost(omega, share, good)),
        Found::Motion { series, harmonics, good } => {
            let names = forced.machine.coordinates();
            measured(names, (&counts, &waves), &series).map(|found| by_amplitudes(omega, (harmonics, good), &found))
        }
    })
}

/// Share of the terms by which the forces leave their straight line along the small motion.
fn leaves(machine: &mut LinearMachine, place: &Place, (rate, waves): (f64, &[Wave])) -> f64 {
    let Ok(matrices) = machine.at(place) else { return f64::INFINITY };
    let n = matrices.n;
    let mut whole = vec![0.0; n];
    for wave in waves {
        let more = terms(&matrices, wave.multiple as f64 * rate, &wave.small);
        whole.iter_mut().zip(more).for_each(|(w, m)| *w += m);
    }
    let Ok(motion) = machine.prepare(&machine.linear().bent) else { return f64::INFINITY };
    let Ok(rest) = machine.values(&motion, place) else { return f64::INFINITY };
    let mut worst = 0.0_f64;
    for turn in 0..INSTANTS {
        let phase = std::f64::consts::TAU * f64::from(turn) / f64::from(INSTANTS);
        let (mut away, mut rates, mut accelerations) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        for wave in waves {
            let nu = wave.multiple as f64 * rate;
            let (sin, cos) = elementary::sin_cos(wave.multiple as f64 * phase);
            for (i, z) in wave.small.iter().enumerate() {
                let (x, v) = (z.0 * cos - z.1 * sin, -nu * (z.0 * sin + z.1 * cos));
                (away[i], rates[i], accelerations[i]) = (away[i] + x, rates[i] + v, accelerations[i] - nu * nu * x);
            }
        }
        let q = place.q.iter().zip(&away).map(|(q, d)| q + d).collect();
        let at = Place {
            q,
            rates: rates.clone(),
            accelerations: accelerations.clone(),
            multipliers: place.multipliers.clone(),
            ..Place::default()
        };
        // beyond the domain of a formula nothing holds
        let Ok(there) = machine.values(&motion, &at) else { return f64::INFINITY };
        for (i, size) in whole.iter().enumerate().filter(|(_, size)| **size > 0.0) {
            let row = |a: &[f64], v: &[f64]| (0..n).map(|j| a[i * n + j] * v[j]).sum::<f64>();
            let line = row(&matrices.mass, &accelerations) + row(&matrices.damping, &rates) + row(&matrices.stiffness, &away);
            worst = worst.max((there[i] - rest[i] - line).abs() / size);
        }
    }
    worst
}

/// How far small motions are off.
struct Off {
    /// Name and unit of the coordinate that is off most, its order, its amplitude by small motions and by the whole equations.
    amplitude: (String, String, usize, [f64; 2]),
    /// The coordinate whose motion over a period is off most, and by which share of its largest distance from rest.
    period: (String, f64),
}

/// The coordinates that are off most; none where amplitudes and motions are near.
fn measured(names: &[Quantity], (counts, waves): (&[bool], &[Wave]), series: &[Vec<f64>]) -> Option<Off> {
    let mut worst = (0.0_f64, None);
    let mut period = (0, 0.0_f64);
    for i in (0..names.len()).filter(|i| counts[*i]) {
        for wave in waves {
            let k = wave.multiple;
            let whole = elementary::hypot(series[2 * k - 1][i], series[2 * k][i]);
            let small = magnitude(wave.small[i]);
            let off = balance::away(small, whole);
            if off > worst.0 && small.max(whole) > balance::TRACE * largest_of(waves, i) {
                worst = (off, Some((i, k, [small, whole])));
            }
        }
        let off = over_a_period(waves, series, i);
        if off > period.1 {
            period = (i, off);
        }
    }
    let (i, k, pair) = worst.1?;
    let of = |i: usize| (names[i].name.clone(), names[i].unit.clone());
    let (name, unit) = of(i);
    (worst.0 > BENT || period.1 > BENT).then(|| Off { amplitude: (name, unit, k, pair), period: (of(period.0).0, period.1) })
}

fn largest_of(waves: &[Wave], i: usize) -> f64 {
    waves.iter().map(|w| magnitude(w.small[i])).fold(0.0, f64::max)
}

/// Largest distance of the two motions of a coordinate over a period, as a share of the largest distance from rest.
fn over_a_period(waves: &[Wave], series: &[Vec<f64>], i: usize) -> f64 {
    let instants = 8 * series.len();
    let (mut apart, mut size) = (0.0_f64, 0.0_f64);
    for j in 0..instants {
        let phase = std::f64::consts::TAU * j as f64 / instants as f64;
        let phi = balance::functions(series.len(), phase, 1.0);
        let whole: f64 = series.iter().zip(&phi).map(|(c, f)| c[i] * f[0]).sum();
        let small = |w: &Wave| w.small[i].0 * phi[2 * w.multiple - 1][0] - w.small[i].1 * phi[2 * w.multiple][0];
        let small: f64 = waves.iter().map(small).sum();
        (apart, size) = (apart.max((whole - small).abs()), size.max(whole.abs()));
    }
    if size > 0.0 { apart / size } else { 0.0 }
}

fn by_amplitudes(omega: f64, (harmonics, good): (usize, f64), off: &Off) -> Text {
    let (name, unit, order, [small, whole]) = &off.amplitude;
    let (omega, share) = (rounded(omega), rounded(100.0 * balance::away(*small, *whole)));
    let (small, whole) = (rounded(*small), rounded(*whole));
    let (moved, period, up) = (&off.period.0, rounded(100.0 * off.period.1), rounded(100.0 * good));
    let unit = Text::unit(unit);
    let of = |nth: &str| if *order == 1 { String::new() } else { format!(" ({order}{nth})") };
    Text::new(
        format!(
            "the equations are not linear: at ω = {} rad/s the amplitude of `{name}`{} is {} {} by small motions and {} {} by harmonic balance of the whole equations ({harmonics} harmonics), so it is off by {} %; over a period the motion of `{moved}` is up to {} % of its largest value away from the small motion; amplitudes are within 1 % up to {} % of the load; use `periodic` or `simulate` beyond that",
            omega.en,
            of("Ω"),
            small.en,
            unit.en,
            whole.en,
            unit.en,
            share.en,
            period.en,
            up.en
        ),
        format!(
            "уравнения нелинейны: при ω = {} рад/с амплитуда `{name}`{} по малым движениям {} {}, а по гармоническому балансу полных уравнений (гармоник: {harmonics}) {} {}: ошибка {} %; за период движение `{moved}` отходит от малого на величину до {} % своего наибольшего значения; амплитуды верны до 1 % при нагрузке до {} % заданной; дальше применяйте `periodic` или `simulate`",
            omega.ru,
            of("Ω"),
            small.ru,
            unit.ru,
            whole.ru,
            unit.ru,
            share.ru,
            period.ru,
            up.ru
        ),
    )
}

fn lost(omega: f64, share: f64, good: f64) -> Text {
    let (omega, share, up) = (rounded(omega), rounded(100.0 * share), rounded(100.0 * good));
    Text::new(
        format!(
            "the equations are not linear, and the amplitudes do not hold: at ω = {} rad/s harmonic balance of the whole equations loses the motion that joins the small ones at {} % of the load (it jumps to another amplitude, drifts away, or a formula has no value); amplitudes are within 1 % up to {} % of the load; use `periodic` or `simulate` beyond that",
            omega.en, share.en, up.en
        ),
        format!(
            "уравнения нелинейны, и амплитуды неверны: при ω = {} рад/с по гармоническому балансу полных уравнений движение, продолжающее малые, теряется при {} % нагрузки (скачок к другой амплитуде, уход или формула без значения); амплитуды верны до 1 % при нагрузке до {} % заданной; дальше применяйте `periodic` или `simulate`",
            omega.ru, share.ru, up.ru
        ),
    )
}

/// Where amplitudes of the whole equations are not computed.
fn by_forces(omega: f64, share: f64) -> Text {
    let (omega, percent) = (rounded(omega), rounded(100.0 * share));
    Text::new(
        format!(
            "the equations are not linear: at ω = {} rad/s the forces (of inertia, resistance and places) leave their straight line by {} % within the amplitudes found, which near a resonance may change these far more; use `periodic` or `simulate`",
            omega.en, percent.en
        ),
        format!(
            "уравнения нелинейны: при ω = {} рад/с силы (инерции, сопротивления и зависящие от положения) в пределах найденных амплитуд отклоняются от линейных на {} %, что вблизи резонанса может изменить амплитуды гораздо сильнее; примените `periodic` или `simulate`",
            omega.ru, percent.ru
        ),
    )
}

/// How far each output leaves its straight line within the amplitudes X at ω, as a share of what the line does; zero where the line holds to
/// `BENT`. `whole` are the formulas of the outputs, `seen` their lines.
///
/// *Errors*: none; a formula without a value within the amplitudes counts as infinitely far.
pub fn curved(machine: &LinearMachine, place: &Place, whole: &Values, seen: &[Seen], (omega, x): (f64, &[Complex])) -> Vec<f64> {
    let mut off = vec![0.0_f64; seen.len()];
    if x.iter().any(|z| !magnitude(*z).is_finite()) {
        return off;
    }
    let (mut reach, mut size, mut terms) = (off.clone(), off.clone(), off.clone());
    let reaches = |g: &[f64], v: &[f64]| g.iter().zip(v).map(|(g, v)| (g * v).abs()).sum::<f64>();
    let sum = |g: &[f64], v: &[f64]| g.iter().zip(v).map(|(g, v)| g * v).sum::<f64>();
    let Ok(rest) = machine.values(whole, place) else { return off };
    for turn in 0..INSTANTS {
        let (sin, cos) = elementary::sin_cos(std::f64::consts::TAU * f64::from(turn) / f64::from(INSTANTS));
        let away: Vec<f64> = x.iter().map(|z| z.0 * cos - z.1 * sin).collect();
        let rates: Vec<f64> = x.iter().map(|z| -omega * (z.0 * sin + z.1 * cos)).collect();
        let accelerations: Vec<f64> = away.iter().map(|v| -omega * omega * v).collect();
        let at = Place {
            q: place.q.iter().zip(&away).map(|(q, d)| q + d).collect(),
            rates: rates.clone(),
            accelerations: accelerations.clone(),
            ..place.clone()
        };
        let Ok(there) = machine.values(whole, &at) else { return vec![f64::INFINITY; seen.len()] };
        for (k, s) in seen.iter().enumerate() {
            let line = sum(&s.by_place, &away) + sum(&s.by_rate, &rates) + sum(&s.by_acceleration, &accelerations);
            let long = reaches(&s.by_place, &away) + reaches(&s.by_rate, &rates) + reaches(&s.by_acceleration, &accelerations);
            terms[k] = terms[k].max(long + there[k].abs());
            reach[k] = reach[k].max(line.abs());
            size[k] = size[k].max(there[k].abs());
            off[k] = off[k].max((there[k] - rest[k] - line).abs());
        }
    }
    // formulas over reactions are zero here and have no measure
    let share = |k: usize| match () {
        // rounding of the terms that meet
        () if size[k] == 0.0 || off[k] <= BENT * reach[k] || off[k] <= 1e-12 * terms[k] => 0.0,
        () if reach[k] == 0.0 => f64::INFINITY,
        () => off[k] / reach[k],
    };
    (0..seen.len()).map(share).collect()
}

/// Instants of a period at which outputs are looked at.
const INSTANTS: u32 = 16;
