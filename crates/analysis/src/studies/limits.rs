//! How far the equations of small motions hold for an amplitude that they give.
//!
//! Two things are left out: what oscillates in the coefficients (M₁ cos νt beside M, which turns a motion at ω into forces at ω ± ν), and what
//! M(q) q'' - h(q, q') does beyond its straight line M δq'' + B δq' + C δq. Both are measured on the amplitudes X, relative to the terms of the equations.

use algebra::elementary;
use words::{Message, Text};

use crate::Fault;
use crate::linear::{LinearMachine, Matrices, Place, Seen, Values};
use crate::studies::modes::Complex;
use crate::studies::response::magnitude;
use words::digits::rounded;
use words::explain::{Explanation, plain};

/// Forces from oscillating coefficients that may be left out, relative to the terms: without a word, and with one.
const FED_BACK: f64 = 1e-6;
const TOLD: f64 = 1e-2;
/// Distance of the forces from a straight line that is worth a word.
const BENT: f64 = 1e-2;

/// S108.
pub const PULSATING: Explanation =
    plain("S108", ("coefficients that oscillate in time", "коэффициенты, колеблющиеся во времени"), (PULSATING_EN, PULSATING_RU));
const PULSATING_EN: &str = "Inertia, damping or stiffness oscillate in time (a rotor with unequal moments of inertia in axes at rest, a pulsating spring), so that one \
    frequency of the load is answered at many, and these act back on the first. The amplitudes of `response` are those of the means. Where \
    inertia and damping act back by more than a hundredth of the forces they are refused; below that a note says by how much the amplitudes are uncertain. Wrong: response of a rotor with xx and yy that differ, its angles counted at rest. Right: count its angles in the turning frame, where the coefficients are \
    constant, or find the regime with `periodic`.";
const PULSATING_RU: &str = "Инерция, сопротивление или жёсткость колеблются во времени (ротор с неравными моментами инерции в неподвижных осях, пульсирующая жёсткость), \
    поэтому на одну частоту нагрузки приходится много частот отклика, влияющих на первую. Амплитуды `response` получены по средним. Если \
    колебания инерции и сопротивления дают более сотой доли сил, в амплитудах отказано; ниже этого примечание сообщает их погрешность. Неверно: response ротора с разными xx и yy, углы которого отсчитаны от неподвижных осей. Верно: отсчитывайте углы во вращающихся осях, где \
    коэффициенты постоянны, или найдите режим с помощью `periodic`.";

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

/// A remark where inertia, resistance and forces of places leave their straight line along the motion of the amplitudes X at ω.
pub fn bent(machine: &mut LinearMachine, place: &Place, omega: f64, x: &[Complex]) -> Option<Text> {
    if x.iter().any(|z| !magnitude(*z).is_finite()) {
        return None;
    }
    if !machine.bends() {
        return None;
    }
    let matrices = machine.at(place).ok()?;
    let whole = terms(&matrices, omega, x);
    let n = matrices.n;
    let motion = machine.prepare(&machine.linear().bent).ok()?;
    let rest = machine.values(&motion, place).ok()?;
    let share = |s: f64| -> f64 {
        let mut worst = 0.0_f64;
        for turn in 0..INSTANTS {
            let (sin, cos) = elementary::sin_cos(std::f64::consts::TAU * f64::from(turn) / f64::from(INSTANTS));
            let away: Vec<f64> = x.iter().map(|z| s * (z.0 * cos - z.1 * sin)).collect();
            let rates: Vec<f64> = x.iter().map(|z| -s * omega * (z.0 * sin + z.1 * cos)).collect();
            let accelerations: Vec<f64> = away.iter().map(|v| -omega * omega * v).collect();
            let q = place.q.iter().zip(&away).map(|(q, d)| q + d).collect();
            let at = Place { q, rates: rates.clone(), accelerations: accelerations.clone(), multipliers: place.multipliers.clone() };
            // beyond the domain of a formula nothing holds
            let Ok(there) = machine.values(&motion, &at) else { return f64::INFINITY };
            for (i, size) in whole.iter().enumerate().filter(|(_, size)| **size > 0.0) {
                let row = |a: &[f64], v: &[f64]| (0..n).map(|j| a[i * n + j] * v[j]).sum::<f64>();
                let line = row(&matrices.mass, &accelerations) + row(&matrices.damping, &rates) + row(&matrices.stiffness, &away);
                worst = worst.max((there[i] - rest[i] - line).abs() / (s * size));
            }
        }
        worst
    };
    let found = share(1.0);
    if found <= BENT {
        return None;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if share(middle) <= BENT { low = middle } else { high = middle }
    }
    let (omega, percent, up) = (rounded(omega), rounded(100.0 * found), rounded(100.0 * low));
    Some(Text::new(
        format!(
            "the equations are not linear: at ω = {} rad/s the forces (of inertia, resistance and places) leave their straight line by {} % within the amplitudes found, and by less than 1 % only up to {} % of \
             these; use `periodic` or `simulate` beyond that",
            omega.en, percent.en, up.en
        ),
        format!(
            "уравнения нелинейны: при ω = {} рад/с силы (инерции, сопротивления и зависящие от положения) в пределах найденных амплитуд отклоняются от линейных на {} %, а менее чем на 1 % – лишь до {} % от них; дальше \
             применяйте `periodic` или `simulate`",
            omega.ru, percent.ru, up.ru
        ),
    ))
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
        () if size[k] == 0.0 || off[k] <= BENT * reach[k] || off[k] <= 1e-12 * terms[k] => 0.0,
        () if reach[k] == 0.0 => f64::INFINITY,
        () => off[k] / reach[k],
    };
    (0..seen.len()).map(share).collect()
}

/// Instants of a period at which outputs are looked at.
const INSTANTS: u32 = 16;
