//! Whole motions after loading: a machine with connections, reactions and switches, oscillators with dry friction, many contacts, many impacts.
//!
//! `cargo bench -p strutt --bench machines` prints medians and what was counted in one run; `-- crank 1` takes the cases whose names hold `crank`, one run each (to
//! count instructions by valgrind, for one). Targets: crank-hoist, one cycle with all reactions and outputs, 2 ms; belt oscillator, 100 s, 5 ms;
//! ten blocks that stick and slip in one model at most ten times one; wheels that rattle in their play, 1e5 impacts in 2 s; a sweep of short motions at most
//! 1.15 times the motions; a sweep over 30 s of the pendulum on a shaft (card P3), whose goal is the 1.3 ms of a compiled batch integrator; a drive and a flywheel found for crank-hoist in 50 ms.

use analysis::integrate::taylor::{Flow, Options, Work};
use mechanics::asked::{Asked, Value};
use std::path::Path;
use std::time::Instant;
use studies::pipeline::{self, Machine};
use studies::simulate;
use studies::{Results, Source, Watch};

/// Medians over this many runs.
const RUNS: usize = 101;

/// Which cases, and how many runs of each.
struct Wish {
    part: String,
    runs: usize,
}

impl Wish {
    fn read() -> Wish {
        let mut words = std::env::args().skip(1).filter(|word| !word.starts_with('-'));
        let part = words.next().unwrap_or_default();
        Wish { part, runs: words.next().and_then(|runs| runs.parse().ok()).unwrap_or(RUNS) }
    }
    fn holds(&self, name: &str) -> bool {
        name.contains(&self.part)
    }
}

fn main() {
    let wish = Wish::read();
    // name, end, rows of the table: the 25 of the published one, or as many as a plot needs
    let gallery =
        [("crank-hoist", 0.2568, 24), ("crank-hoist", 0.2568, 1000), ("belt-oscillator", 100.0, 1000), ("stick-slip", 20.0, 1000)];
    for (name, until, rows) in gallery.into_iter().filter(|case| wish.holds(case.0)) {
        let (time, work) = motion(machine(name), (until, rows), wish.runs);
        println!("{name:>16}  {until:>7} s  {:>5} rows  {:>8.3} ms  {work}", rows + 1, 1e3 * time);
    }
    for pressed in ["weight", "stop"].into_iter().filter(|pressed| wish.holds(&format!("blocks-{pressed}"))) {
        let [(one, _), (ten, work)] = [1, 10].map(|n| motion(written(&blocks(n, pressed)), (20.0, 100), wish.runs));
        println!("blocks pressed by {pressed:>6}: one {:.3} ms, ten {:.3} ms, ratio {:.1}  {work}", 1e3 * one, 1e3 * ten, ten / one);
    }
    if wish.holds("rattling") {
        let until = 360.0;
        let (time, work) = motion(written(GEARS), (until, 1), wish.runs.min(3));
        println!("rattling wheels: {time:.2} s  {work}");
    }
    if wish.holds("sweep") {
        let (motions, sweep) = swept(1000.min(10 * wish.runs));
        println!("sweep of motions: {:.3} ms each, motions alone {:.3} ms, ratio {:.2}", 1e3 * sweep, 1e3 * motions, sweep / motions);
    }
    if wish.holds("shaft") {
        let (alone, sweep, work) = captured(1000.min(10 * wish.runs));
        println!(
            "sweep over 30 s of the pendulum on a shaft: {:.2} ms each, motions alone {:.2} ms, ratio {:.2}  {work}",
            1e3 * sweep,
            1e3 * alone,
            sweep / alone
        );
    }
    if wish.holds("flywheel") {
        println!("drive and flywheel of crank-hoist: {:.1} ms", 1e3 * flywheel(wish.runs.min(21)));
    }
}

/// Seconds for a motion of 0.1 s of the pendulum on a shaft: alone, and in a sweep over the pendulum's mass.
fn swept(count: usize) -> (f64, f64) {
    let text =
        strutt::gallery::find("pendulum-on-shaft").map(|e| e.text.replace("until = \"30 s\"", "until = \"0.1 s\"")).unwrap_or_default();
    let asked = format!("\n[[study]]\nkind = \"sweep\"\nover = [\"m = linspace(2 g, 60 g, {count})\"]\nobserve = [\"max(phi)\"]\n");
    let mut machine = written(&(text + &asked));
    let timed = |machine: &mut Machine, asked: &Asked| {
        let start = Instant::now();
        std::hint::black_box(pipeline::study(machine, asked, &mut Watch::default()));
        start.elapsed().as_secs_f64()
    };
    let (mut alone, mut sweep) = (0.0, 0.0);
    for asked in machine.model.studies.clone() {
        match asked.kind {
            "simulate" => {
                let mut study = asked.with("outputs", Value::Words(vec!["phi".into()]));
                study.unset("plot");
                // the same motions: those of another mass take other steps
                let mut own = machine.clone();
                for k in 0..count {
                    let mass = 2e-3 + 58e-3 * k as f64 / (count - 1) as f64;
                    assert!(own.bind(&[("m", mass)]).is_ok());
                    alone += timed(&mut own, &study) / count as f64;
                }
            }
            "sweep" => sweep = timed(&mut machine, &asked) / count as f64,
            _ => {}
        }
    }
    (alone, sweep)
}

/// Seconds for a motion of 30 s of the pendulum on a shaft at 1e-9 (card P3): the integrator alone, and a row of a sweep over the pendulum's mass with its checks; the work of
/// the integrator in one.
fn captured(count: usize) -> (f64, f64, String) {
    let tolerance = 1e-9;
    let text = strutt::gallery::find("pendulum-on-shaft").map(|e| e.text).unwrap_or_default();
    let asked =
        format!("\n[[study]]\nkind = \"sweep\"\nover = [\"m = linspace(2 g, 60 g, {count})\"]\nobserve = [\"mean(phi', 20 s, 30 s)\"]\n");
    let mut machine = written(&(text.replace("until = \"30 s\"", "until = \"30 s\"\ntolerance = 1e-9") + &asked));
    let mut own = machine.clone();
    let (mut alone, mut total) = (0.0, Work::default());
    for k in 0..count {
        let mass = 2e-3 + 58e-3 * k as f64 / (count - 1).max(1) as f64;
        assert!(own.bind(&[("m", mass)]).is_ok());
        let clock = Instant::now();
        let options = Options { tolerance, span: 30.0, ..Options::default() };
        let Ok(start) = own.system.start() else { panic!("no start") };
        let Ok(mut flow) = Flow::start(&mut own.system, 0.0, &start, &options) else { panic!("no motion") };
        while !flow.reached(30.0) {
            assert!(flow.advance(30.0).is_ok());
        }
        alone += clock.elapsed().as_secs_f64() / count as f64;
        let work = flow.work();
        (total.steps, total.expansions, total.orders) =
            (total.steps + work.steps, total.expansions + work.expansions, total.orders + work.orders);
    }
    let Some(sweep) = machine.model.studies.iter().rfind(|asked| asked.kind == "sweep").cloned() else { panic!("no sweep") };
    let clock = Instant::now();
    std::hint::black_box(pipeline::study(&mut machine, &sweep, &mut Watch::default()));
    let each = |n: u64| n as f64 / count as f64;
    let work = format!("{:.0} steps, {:.0} expansions of order {:.1}", each(total.steps), each(total.expansions), total.mean_order());
    (alone, clock.elapsed().as_secs_f64() / count as f64, work)
}

/// Median seconds of the search for the drive and the flywheel of crank-hoist.
fn flywheel(runs: usize) -> f64 {
    let text = strutt::gallery::find("crank-hoist").map(|e| e.text).unwrap_or_default();
    let asked = "\n[[study]]\nkind = \"cycle\"\nangle = \"phi1\"\nunknown = \"F0\"\nflywheel = \"I1\"\nirregularity = 0.02\n";
    let machine = written(&(text.to_owned() + asked));
    let Some(cycle) = machine.model.studies.iter().rfind(|asked| asked.kind == "cycle") else { panic!("no cycle") };
    let mut times: Vec<f64> = (0..runs)
        .map(|_| {
            let mut machine = machine.clone();
            let start = Instant::now();
            std::hint::black_box(pipeline::study(&mut machine, cycle, &mut Watch::default()));
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[runs / 2]
}

/// Blocks on springs and a belt, pressed by their weight or on a floor.
fn blocks(n: usize, pressed: &str) -> String {
    let (mut coordinates, mut rest) = (String::from("[coordinates]\n"), String::new());
    for k in 0..n {
        let (y, normal) = if pressed == "stop" { (format!("y{k}"), format!("force(s{k})")) } else { ("0".into(), "1 [kg]*g".into()) };
        coordinates += &format!("x{k} = {{ unit = \"m\", start = 0 }}\n");
        if pressed == "stop" {
            coordinates += &format!("y{k} = {{ unit = \"m\", start = 0 }}\n");
            rest += &format!("[stops.s{k}]\nalong = \"y{k}\"\nat_least = 0\n");
        }
        rest += &format!("[bodies.b{k}]\norigin = [\"x{k}\", \"{y}\"]\nmass = \"1 kg\"\n");
        rest += &format!("[springs.c{k}]\nalong = \"x{k}\"\nstiffness = \"40 N/m\"\n");
        rest += &format!(
            "[frictions.r{k}]\nalong = \"x{k} - 0.2 [m/s]*t\"\ncoefficient = 0.3\nstatic_coefficient = 0.4\nnormal = \"{normal}\"\n"
        );
    }
    coordinates + &rest
}

/// A wheel between two flanks of a wheel whose speed pulsates, under a small load.
const GEARS: &str = r#"
[coordinates]
psi = { unit = "rad", start = 0, rate = 0 }
[bodies.wheel]
angle = "psi"
inertia = "0.02 kg m^2"
[torques.load]
on = "wheel"
value = "-0.5 [N m] - 0.002 [N m s]*psi'"
[stops.drive]
along = "psi - 5e-3 [rad]*sin(200 [rad/s]*t)"
at_least = "-1e-3 rad"
restitution = 0.6
[stops.back]
along = "psi - 5e-3 [rad]*sin(200 [rad/s]*t)"
at_most = "1e-3 rad"
restitution = 0.6
"#;

fn written(text: &str) -> Machine {
    let source = Source::new("bench.toml", text);
    pipeline::build(&source, &[], &mut Watch::default()).unwrap_or_else(|_| panic!("{text}"))
}

fn machine(name: &str) -> Machine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery").join(name).join("model.toml");
    let source = strutt::source::open(&path.to_string_lossy()).unwrap_or_else(|_| panic!("{name}"));
    pipeline::build(&source, &[], &mut Watch::default()).unwrap_or_else(|_| panic!("{name}"))
}

/// Median time in seconds, and what was counted.
fn motion(mut machine: Machine, (until, rows): (f64, usize), runs: usize) -> (f64, String) {
    let times = (0..=rows).map(|k| until * k as f64 / rows as f64).collect();
    let values = [("until", Value::Number(until)), ("at", Value::Numbers(times))];
    let study = simulate::with_values(&machine, &values).unwrap_or_else(|_| panic!("no study"));
    let mut work = String::new();
    let mut times: Vec<f64> = (0..runs)
        .map(|_| {
            let start = Instant::now();
            let finding = std::hint::black_box(simulate::motion(&mut machine, &study, &mut Watch::default()));
            let time = start.elapsed().as_secs_f64();
            work = counted(&finding);
            time
        })
        .collect();
    times.sort_by(f64::total_cmp);
    (times[runs / 2], work)
}

fn counted(results: &Results) -> String {
    let data = &results.data;
    let of = |key: &str| data.counter(key).unwrap_or(0.0);
    format!("{} steps, {} back, {} expansions, {} switches", of("steps"), of("rejected"), of("evaluations"), of("events"))
}
