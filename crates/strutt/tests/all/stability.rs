//! The verdict of `equilibrium` is that of the roots of `modes`, and no way of writing a machine changes it.
//!
//! Random hanging chains, with springs and with dampers of either sign in their joints, are written three times: with one angle for each bar; with three
//! coordinates for each bar and pins; with angles and a load on the last bar that a support holds, against the same load without a support. The largest real
//! part of a root is the same for all writings, by both studies.

use studies::equilibrium;
use studies::pipeline::{self, Machine};
use studies::small::asked::Modes;
use studies::small::modes::at_place;
use studies::{Results, Source, Watch};

/// Relative to the fastest root.
const CLOSE: f64 = 1e-9;

/// Numbers between 0 and 1 from a linear congruence.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }
}

/// A bar: length, mass, inertia, damping and stiffness of its upper joint.
type Bar = [f64; 5];

fn chain(random: &mut Random) -> Vec<Bar> {
    let bars = 1 + (random.unit() * 3.0) as usize;
    let bar = |_| {
        let length = random.between(0.3, 1.5);
        let damping = random.between(-0.4, 1.0);
        [length, random.between(0.5, 4.0), random.between(0.01, 0.4), damping, random.between(0.0, 5.0)]
    };
    (0..bars).map(bar).collect()
}

/// Joints: springs and dampers between neighbours.
fn joints(bars: &[Bar], text: &mut String) {
    for (i, [.., damping, stiffness]) in bars.iter().enumerate() {
        let pathway = if i == 0 { "along = \"f0\"".to_owned() } else { format!("between = [\"a{}\", \"a{i}\"]", i - 1) };
        text.push_str(&format!("[dampers.d{i}]\n{pathway}\ndamping = \"{damping} N m s\"\n"));
        text.push_str(&format!("[springs.s{i}]\n{pathway}\nstiffness = \"{stiffness} N m\"\n"));
    }
}

/// One angle for each bar; with a load on the last that may be held by a support.
fn angles(bars: &[Bar], load: Option<&str>) -> String {
    let mut text = String::from("[coordinates]\n");
    (0..bars.len()).for_each(|i| text.push_str(&format!("f{i} = \"rad\"\n")));
    let (mut x, mut y) = (String::from("0 [m]"), String::from("0 [m]"));
    for (i, [length, mass, inertia, ..]) in bars.iter().enumerate() {
        let half = 0.5 * length;
        text.push_str(&format!(
            "[bodies.a{i}]\norigin = [\"{x} + {half} [m]*sin(f{i})\", \"{y} - {half} [m]*cos(f{i})\"]\nangle = \"f{i}\"\n"
        ));
        text.push_str(&format!("mass = \"{mass} kg\"\ninertia = \"{inertia} kg m^2\"\n"));
        x.push_str(&format!(" + {length} [m]*sin(f{i})"));
        y.push_str(&format!(" - {length} [m]*cos(f{i})"));
    }
    joints(bars, &mut text);
    if let Some(support) = load {
        text.push_str(&format!(
            "[bodies.load]\non = \"a{}\"\norigin = [\"0.1 m\", \"-0.2 m\"]\nmass = \"0.7 kg\"\n{support}",
            bars.len() - 1
        ));
    }
    text
}

/// Three coordinates for each bar, and pins.
fn pins(bars: &[Bar]) -> String {
    let (mut text, mut points, mut list, mut bodies) =
        (String::from("[coordinates]\n"), String::from("[points]\n"), String::from("[pins]\n"), String::new());
    points.push_str("B0 = { at = [\"0\", \"0\"] }\n");
    let mut top = 0.0;
    for (i, [length, mass, inertia, ..]) in bars.iter().enumerate() {
        let half = 0.5 * length;
        text.push_str(&format!("x{i} = \"m\"\ny{i} = {{ unit = \"m\", start = \"{} m\" }}\nf{i} = \"rad\"\n", top - half));
        bodies.push_str(&format!(
            "[bodies.a{i}]\norigin = [\"x{i}\", \"y{i}\"]\nangle = \"f{i}\"\nmass = \"{mass} kg\"\ninertia = \"{inertia} kg m^2\"\n"
        ));
        points.push_str(&format!("T{i} = {{ on = \"a{i}\", at = [\"0\", \"{half} m\"] }}\n"));
        points.push_str(&format!("B{} = {{ on = \"a{i}\", at = [\"0\", \"{} m\"] }}\n", i + 1, -half));
        list.push_str(&format!("p{i} = {{ between = [\"B{i}\", \"T{i}\"] }}\n"));
        top -= length;
    }
    let mut whole = [text, bodies, points, list].concat();
    joints(bars, &mut whole);
    whole
}

fn built(text: &str) -> Machine {
    pipeline::build(&Source::new("model.toml", text), &[], &mut Watch::default()).unwrap_or_else(|e| panic!("{e:?}\n{text}"))
}

/// Verdict and largest real part by `equilibrium`, largest real part and fastest root by `modes`.
fn judged(text: &str) -> (f64, f64, f64, f64) {
    let Results { data, trouble: None, .. } = equilibrium::places(&mut built(text), &[], None, &mut Watch::default()) else {
        panic!("no equilibrium:\n{text}")
    };
    let first = |name: &str| data.column(name).map_or(f64::NAN, |c| c.values[0]);
    let small = at_place(&built(text), &Modes::default()).unwrap_or_else(|fault| panic!("no modes: {fault:?}\n{text}")).modes;
    let growth = small.modes.iter().map(|m| m.root.0).fold(f64::NEG_INFINITY, f64::max);
    let fastest = small.modes.iter().map(|m| m.root.0.hypot(m.root.1)).fold(0.0, f64::max);
    (first("stable"), first("growth"), growth, fastest)
}

#[test]
fn verdicts_are_those_of_the_roots_however_a_machine_is_written() {
    let mut random = Random(20261);
    let mut seen = [0, 0];
    for _ in 0..24 {
        let bars = chain(&mut random);
        let support = "[supports.H]\nat = \"load\"\ndirections = [\"x\", \"y\"]\n";
        let writings = [vec![angles(&bars, None), pins(&bars)], vec![angles(&bars, Some("")), angles(&bars, Some(support))]];
        for texts in &writings {
            let results: Vec<_> = texts.iter().map(|t| judged(t)).collect();
            let truth = results[0].2;
            for ((stable, growth, root, fastest), text) in results.iter().zip(texts) {
                assert!((growth - truth).abs() <= CLOSE * fastest, "{growth} against {truth}\n{text}");
                assert!((root - truth).abs() <= CLOSE * fastest, "{root} against {truth}\n{text}");
                assert!(*stable == f64::from(u8::from(truth < 0.0)), "verdict {stable}, Re λ = {truth}\n{text}");
            }
            seen[usize::from(truth > 0.0)] += 1;
        }
    }
    assert!(seen.iter().all(|n| *n >= 6), "{seen:?}");
}
