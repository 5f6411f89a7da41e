//! A machine with other values is the one that reading the file with them gives, to the last bit.

use mechanics::asked::{Asked, Value};
use studies::Binding;
use studies::pipeline::{self, Machine};
use studies::{Source, Watch};

fn machine(name: &str) -> Machine {
    let text = strutt::gallery::find(name).expect("an example").text;
    pipeline::build(&Source::new(&format!("{name}.toml"), text), &[], &mut Watch::default()).expect("a machine")
}

/// Everything about a machine that a study sees.
fn whole(machine: &Machine) -> String {
    let numbers: Vec<_> = machine.equations.parameters.iter().map(|p| (p.value.to_bits(), &p.written, &p.unit)).collect();
    let declared: Vec<_> = machine.model.parameters.iter().map(|p| (&p.name, p.number.map(f64::to_bits), &p.written, p.class)).collect();
    let start: Vec<u64> = machine.system.start().expect("a start").iter().map(|x| x.to_bits()).collect();
    format!("{numbers:?}\n{declared:?}\n{start:?}\n{:?}\n{:?}\n{:?}", machine.model.studies, machine.origin.overrides, machine.model_hash)
}

/// The columns of a study, bit by bit.
fn columns(machine: &mut Machine, asked: &Asked) -> Vec<(String, Vec<u64>)> {
    let Some(results) = pipeline::study(machine, asked, &mut Watch::default()) else { return Vec::new() };
    let column = |c: &analysis::dataset::Column| (c.quantity.name.clone(), c.values.iter().map(|v| v.to_bits()).collect());
    results.data.columns.iter().map(column).collect()
}

/// Compares the machine bound to value after value with the machine read anew.
fn same(name: &str, parameter: &str, values: &[f64]) -> usize {
    let base = machine(name);
    let mut bound = base.with_values(&[(parameter, values[0])]).expect("a machine with the first value");
    let mut compared = 0;
    for value in values {
        let read = base.with_values(&[(parameter, *value)]);
        let done = bound.bind(&[(parameter, *value)]).map(|_| ());
        match (read, done) {
            (Ok(mut read), Ok(())) => {
                assert_eq!(whole(&read), whole(&bound), "{name}, {parameter} = {value}");
                for study in read.model.studies.clone() {
                    let mut quick = study.clone();
                    match study.kind {
                        "simulate" => {
                            let until = study.number("until").unwrap_or(0.0).min(1.0);
                            quick.set("until", Value::Number(until));
                            if let Some(times) = study.numbers("at") {
                                quick.set("at", Value::Numbers(times.iter().copied().filter(|t| *t <= until).collect()));
                            }
                        }
                        "equilibrium" | "modes" | "statics" | "kinematics" => {}
                        _ => continue,
                    }
                    assert_eq!(columns(&mut read, &quick), columns(&mut bound.clone(), &quick), "{name}, {parameter} = {value}");
                    compared += 1;
                }
            }
            (Err(read), Err(done)) => assert_eq!(format!("{read:?}"), format!("{done:?}"), "{name}, {parameter} = {value}"),
            (read, done) => panic!("{name}, {parameter} = {value}: read {:?}, bound {:?}", read.is_ok(), done.is_ok()),
        }
    }
    compared
}

#[test]
fn masses_and_stiffnesses_are_numbers() {
    assert!(same("pendulum-on-shaft", "m", &[0.02, 0.003, 0.06]) >= 3);
    assert!(same("double-pendulum", "m1", &[1.0, 2.5, 0.1]) >= 3);
}

/// Lengths move the assembly: closed loops start elsewhere, and where none closes both say so.
#[test]
fn lengths_move_the_assembly() {
    let base = machine("four-bar");
    let lengths: Vec<(String, f64)> = base
        .model
        .parameters
        .iter()
        .filter(|p| p.unit == "m" && matches!(p.value, mechanics::model::ParameterValue::Number { .. }))
        .filter_map(|p| Some((p.name.clone(), p.number?)))
        .collect();
    assert!(!lengths.is_empty());
    for (name, value) in lengths {
        same("four-bar", &name, &[value, 1.05 * value, 0.9 * value, 20.0 * value, value]);
    }
}

/// A zero switches parts of a machine off, a negative mass is refused, and coming back from there is as if it had never been.
#[test]
fn zeros_and_signs_are_read_anew() {
    same("pendulum-on-shaft", "m", &[0.02, 0.0, 0.01, -1.0, 0.03]);
    same("pendulum-on-shaft", "k", &[1e-4, 0.0, 2e-4, -1e-4]);
    same("stick-slip", "v", &[0.1, 0.0, -0.2, 0.3]);
}

/// A third of the parameters of all examples that have a number of their own, each half as large again.
#[test]
fn every_parameter_of_the_gallery() {
    let (mut compared, mut numbers_alone) = (0, 0);
    for (i, example) in strutt::gallery::EXAMPLES.iter().enumerate() {
        let base = machine(example.name);
        let numbers = base.model.parameters.iter().filter(|p| matches!(p.value, mechanics::model::ParameterValue::Number { .. }));
        for p in numbers.skip(i % 3).step_by(3) {
            let Some(value) = p.number else { continue };
            let Ok(mut bound) = base.with_values(&[(&p.name, 1.25 * value)]) else { continue };
            let (read, done) = (base.with_values(&[(&p.name, 1.5 * value)]), bound.bind(&[(&p.name, 1.5 * value)]));
            assert_eq!(read.is_ok(), done.is_ok(), "{} {}", example.name, p.name);
            numbers_alone += usize::from(matches!(done, Ok(Binding::Numbers)));
            if let Ok(read) = read {
                assert_eq!(whole(&read), whole(&bound), "{} {}", example.name, p.name);
                compared += 1;
            }
        }
    }
    assert!(compared > 40 && 3 * numbers_alone > 2 * compared, "{compared}, of them {numbers_alone} without reading");
}

/// What motions share can be shared between threads.
#[test]
fn machines_are_shared_between_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<Machine>();
    shared::<analysis::Machine>();
    shared::<program::Program>();
    shared::<symbolic::Equations>();
    shared::<mechanics::Model>();
}

/// A thousand values are read twice at most: the file, and once with the first value.
#[test]
fn a_sweep_reads_its_file_once() {
    let text = strutt::gallery::find("pendulum-on-shaft").expect("an example").text.replace("until = \"30 s\"", "until = \"0.05 s\"");
    let text = text + "[[study]]\nkind = \"sweep\"\nover = [\"m = linspace(2 g, 60 g, 20)\"]\nobserve = [\"max(phi)\"]\n";
    let mut machine = pipeline::build(&Source::new("sweep.toml", &text), &[], &mut Watch::default()).expect("a machine");
    let sweep = machine.model.studies.iter().rfind(|asked| asked.kind == "sweep").cloned().expect("a sweep");
    let results = pipeline::study(&mut machine, &sweep, &mut Watch::default()).expect("a study");
    assert_eq!(results.data.columns[1].values.len(), 20);
    assert_eq!(results.own["read_anew"], 1);
}
