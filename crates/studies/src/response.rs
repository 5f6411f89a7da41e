//! The study `response`: forced oscillations over the frequency of periodic loads.

use super::keys::{GUESS, OUTPUTS};
use super::{Conclusion, Finds, Found, Results, Study};
use crate::machine::Machine;
use crate::results::finite::checked;
use crate::small::asked::Response;
use crate::watch::{Lap, Watch};
use mechanics::asked::{Asked, Key, Kind, Takes, Words};
use words::Language;

/// The study.
pub struct Forced;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    crate::small::response::NAME,
    ("Find forced oscillations over the frequency of a load", "Рассчитать вынужденные колебания в зависимости от частоты нагрузки"),
)
.keys(&[
    GUESS,
    Key::new(
        "load",
        Takes::Name,
        (
            "load of the response: a force, torque or distributed load, or a coordinate for a unit load, with its table where the name has two meanings (`forces.f`); the harmonic loads of the file without it",
            "нагрузка: сила, момент, распределённая нагрузка или координата (единичная нагрузка), при двух значениях имени – вместе с таблицей (`forces.f`); без ключа — гармонические нагрузки файла",
        ),
        "\"drive\"",
    )
    .option(
        "The load: a force, torque or distributed load, or a coordinate for a unit load (f, or forces.f); otherwise the harmonic loads of the file",
        "Нагрузка: сила, момент, распределённая нагрузка или координата (единичная нагрузка), f или forces.f; иначе гармонические нагрузки файла",
    ),
    Key::new("over", Takes::Varied, ("the parameter that is the frequency", "параметр, задающий частоту"), "\"Omega\"")
        .option("The parameter that is the frequency", "Параметр, задающий частоту"),
    Key::new(
        "range",
        Takes::FrequencyRange,
        ("frequencies from and to; Hz count periods", "частоты от и до; Гц — число периодов"),
        "[\"1 rad/s\", \"100 rad/s\"]",
    )
    .option("Frequencies from and to: 1,100 (rad/s) or \"1 Hz,20 Hz\"", "Частоты от и до: 1,100 (рад/с) или \"1 Гц;20 Гц\""),
    Key::new("points", Takes::Count("M093", 2), ("number of frequencies", "число частот"), "201")
        .default("401", "401")
        .option("Number of frequencies", "Число частот"),
    Key::new("log", Takes::Flag, ("logarithmic axes", "логарифмические оси"), "true")
        .default("false", "false")
        .option("Logarithmic axes", "Логарифмические оси"),
    Key {
        about: ("results wanted; the coordinates without it", "нужные результаты; без ключа — координаты"),
        ..OUTPUTS.option("Quantities by name, in this order: phi,phi',omega_p", "Величины по именам, в этом порядке: phi,phi',omega_p")
    },
    Key::new(
        "shapes",
        Takes::Frequencies,
        ("frequencies at which the forced shape is shown", "частоты, при которых показывается форма вынужденных колебаний"),
        "[\"3 Hz\", \"20 rad/s\"]",
    )
    .option(
        "Frequencies at which the shape of the motion is shown: 10,20 (rad/s) or \"3 Hz\"",
        "Частоты, при которых показать форму движения: 10,20 (рад/с) или \"3 Гц\"",
    ),
]);

impl Study for Forced {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        (
            "find the amplitudes and phases of the forced oscillations over the frequency",
            "построить амплитудно-частотные и фазочастотные характеристики вынужденных колебаний",
        )
    }
    fn chapter(&self) -> &'static str {
        "forced"
    }
    fn finds(&self) -> Finds {
        Finds::Amplitudes
    }
    fn concludes(&self, machine: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        let size = |z: f64| z.is_finite().then_some(z);
        let at = results.own.get("at_frequency");
        let omega = at.and_then(|at| size(at.get("omega")?.as_f64()?));
        let label = |name: &str| {
            let label = machine.equations.outputs.iter().find(|o| o.name == name).map(|o| o.label.clone())?;
            (!label.en.is_empty()).then_some(label)
        };
        let forced = at.and_then(|at| at.get("outputs")?.as_object()).into_iter().flatten().filter_map(|(name, found)| {
            let column = results.data.column(&format!("{name}_amplitude"))?;
            let value = size(found.get("amplitude")?.as_f64()?)?;
            let (_, value, unit) = crate::results::shown(&column.quantity, value, language);
            let gain = found.get("dynamic_coefficient").and_then(serde_json::Value::as_f64);
            Some(Conclusion::Forced { label: label(name)?, omega: omega?, amplitude: (value, unit), gain })
        });
        let rests = results.own.get("antiresonances").and_then(|list| list.as_array()).into_iter().flatten().filter_map(|found| {
            let exact = found.get("zero")?.as_bool()?;
            let omega = found.get("omega")?.as_f64()?;
            Some(Conclusion::Antiresonance { label: label(found.get("output")?.as_str()?)?, omega, exact })
        });
        forced.chain(rests).collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let found = crate::small::response::find(machine, &Response::of(asked), crate::structure::drawing::forced);
        watch.lap(Lap::Run);
        Some(checked(found))
    }
}
