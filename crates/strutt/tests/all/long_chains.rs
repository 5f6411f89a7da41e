//! Long chains: what a step costs that is taken back, and that the checks of a motion grow no faster than the motion.

use mechanics::asked::Value;
use studies::pipeline;
use studies::{Source, Watch};

/// A chain let go with all rods level, for so long: its series have runs of small coefficients, so that many steps are taken back.
fn let_go(n: usize, (until, tolerance): (f64, f64)) -> analysis::Dataset {
    let text = strutt::chain::model(n).replace("30 deg", "90 deg");
    let mut machine = pipeline::build(&Source::new("chain.toml", &text), &[], &mut Watch::default()).expect("a chain");
    let mut study = machine.model.studies.iter().find(|study| study.kind == "simulate").expect("a motion").clone();
    study.set("until", Value::Number(until));
    study.set("tolerance", Value::Number(tolerance));
    study.set("outputs", Value::Words(vec!["phi_1".into()]));
    study.unset("plot");
    pipeline::study(&mut machine, &study, &mut Watch::default()).expect("a motion").data
}

/// A step that is taken back is made shorter on the series that it has; only rates were computed at its end.
#[test]
fn steps_taken_back_cost_no_expansion() {
    let data = let_go(30, (1.0, 1e-8));
    let of = |key: &str| data.counter(key).unwrap_or(f64::NAN);
    let (steps, rejected, expansions) = (of("steps"), of("rejected"), of("evaluations"));
    assert!(rejected > 0.2 * steps, "{rejected} of {steps}: another motion is needed for this test");
    // one at the start, few at trials of the implicit method
    assert!(expansions <= 1.1 * steps, "{expansions} expansions for {steps} steps");
    assert!(data.audits.iter().all(|audit| audit.ok));
}
