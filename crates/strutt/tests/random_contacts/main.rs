//! Random scenes with contacts, friction and impacts against an independent code that knows no events: Moreau's time stepping.
//!
//! A scene agrees when the motions differ by no more than the stepping changes with its step, and the stepping has settled. Where it has not (after impacts a small
//! difference may grow), the step is made shorter; scenes that are too sensitive for the shortest step are counted. Every scene must pass every audit.
//!
//! Contacts strike together, where the stepping solves one set of inclusions, or in sequence, where it has blows of its own and friction and restitution mix at eccentric contacts: what
//! strutt refuses as an impact that gains energy must gain energy there.
//!
//! `STRUTT_SCENES=200 cargo test -p strutt --test random_contacts` compares more scenes.

mod scene;
mod stepping;

use mechanics::asked::Value;
use scene::Impacts;
use stepping::End;
use studies::Results;
use studies::pipeline;
use studies::simulate;
use studies::{Source, Watch};

/// Scenes of a usual run.
const SCENES: u64 = 40;
/// Steps of the stepping, s.
const STEPS: [f64; 4] = [4e-4, 1e-4, 2.5e-5, 6.25e-6];
/// Change with the step (m, rad) from which on the stepping has not settled.
const SETTLED: f64 = 0.02;
/// Times the change with the step: first order with a ratio of four leaves a third of it.
const SHARE: f64 = 3.0;
/// An instant of an event is known to the stepping within some steps, m/s or rad/s.
const SPEED: f64 = 20.0;

enum Verdict {
    Agrees,
    Sensitive,
    Differs(String),
}

/// Coordinates at the end by strutt, and audits that failed.
fn motion(scene: &scene::Scene) -> Result<(Vec<f64>, Vec<String>), String> {
    let source = Source::new("random.toml", &scene::write(scene));
    let mut machine = pipeline::build(&source, &[], &mut Watch::default()).map_err(|f| format!("{f:?}"))?;
    let study = simulate::with_values(&machine, &[("at", Value::Numbers(vec![scene.until]))]).map_err(|f| format!("{f:?}"))?;
    let Results { data, trouble, .. } = simulate::motion(&mut machine, &study, &mut Watch::default());
    if let Some(trouble) = trouble {
        return Err(format!("{trouble:?}"));
    }
    let value = |name: String| data.column(&name).and_then(|c| c.values.last().copied()).ok_or(name);
    let row = scene::coordinates(scene).into_iter().map(value).collect::<Result<Vec<f64>, String>>()?;
    let failed = data.audits.iter().filter(|a| !a.ok).map(|a| format!("{} = {:e}", a.key, a.value)).collect();
    Ok((row, failed))
}

fn compare(scene: &scene::Scene) -> Verdict {
    let (row, failed) = match motion(scene) {
        Ok(found) => found,
        Err(trouble) if trouble.contains("S126") => return gained(scene, trouble),
        Err(trouble) => return Verdict::Differs(trouble),
    };
    let verdict = against_stepping(scene, &row);
    match verdict {
        Verdict::Differs(how) => Verdict::Differs(format!("{how}; {}", failed.join(", "))),
        _ if !failed.is_empty() => Verdict::Differs(failed.join(", ")),
        verdict => verdict,
    }
}

/// An impact that gains energy gains it in the stepping too.
fn gained(scene: &scene::Scene, trouble: String) -> Verdict {
    if STEPS.iter().any(|h| stepping::end(scene, *h) == End::Gained) { Verdict::Agrees } else { Verdict::Differs(trouble) }
}

fn against_stepping(scene: &scene::Scene, row: &[f64]) -> Verdict {
    let row = &End::Reached(row.to_vec());
    let distance = |a: &End, b: &End| match (a, b) {
        (End::Reached(a), End::Reached(b)) => a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
        _ => f64::INFINITY,
    };
    let mut last = stepping::end(scene, STEPS[0]);
    let mut story = Vec::new();
    for h in &STEPS[1..] {
        let next = stepping::end(scene, *h);
        let (change, off) = (distance(&last, &next), distance(row, &next));
        story.push(format!("h = {h:e}: changes by {change:.1e}, differs by {off:.1e}"));
        if change < SETTLED && off <= SHARE * change + SPEED * h {
            return Verdict::Agrees;
        }
        last = next;
    }
    let settled = story.iter().any(|_| distance(&last, &stepping::end(scene, 2.0 * STEPS[3])) < 0.1 * SETTLED);
    if settled { Verdict::Differs(story.join("; ")) } else { Verdict::Sensitive }
}

fn all_agree(impacts: Impacts) {
    let scenes = std::env::var("STRUTT_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(SCENES);
    let only = std::env::var("STRUTT_SCENE").ok().and_then(|n| n.parse::<u64>().ok());
    let (mut agree, mut sensitive, mut differ) = (0, Vec::new(), Vec::new());
    for seed in only.map_or(0..scenes, |seed| seed..seed + 1) {
        let scene = scene::scene(seed, impacts);
        if only.is_some() {
            println!("{}", scene::write(&scene));
        }
        match compare(&scene) {
            Verdict::Agrees => agree += 1,
            Verdict::Sensitive => sensitive.push(seed),
            Verdict::Differs(how) => differ.push(format!("scene {seed}: {how}")),
        }
    }
    println!("{agree} agree; too sensitive: {sensitive:?}");
    assert!(differ.is_empty(), "{}", differ.join("\n"));
    assert!(sensitive.len() as u64 <= scenes / 10, "too sensitive for the shortest step: {sensitive:?}");
}

#[test]
fn random_contacts_move_as_time_stepping_has_them() {
    all_agree(Impacts::Together);
}

#[test]
fn random_contacts_in_sequence_move_as_time_stepping_has_them() {
    all_agree(Impacts::InSequence);
}

#[test]
fn the_stepping_tells_the_two_laws_apart() {
    let crossed = |seed: u64| {
        let own = scene::scene(seed, Impacts::InSequence);
        let (row, _) = motion(&own).ok()?;
        Some(matches!(against_stepping(&scene::Scene { impacts: Impacts::Together, ..own }, &row), Verdict::Differs(_)))
    };
    assert!((0..SCENES).any(|seed| crossed(seed) == Some(true)));
}
