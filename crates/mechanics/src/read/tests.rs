//! Claims about reading whole files.

use super::{Reading, read_with};
use crate::asked::{Asked, Choice, Key, Kind, Kinds, Like, Limits, Objection, Takes, Value};
use crate::fields;
use crate::model::{Class, Inertia, ParameterValue, RequestKind, Times};
use crate::units::Dimension;
use words::Notice;

const FULL: &str = include_str!("../../tests/full.toml");
const STUDIES: &str = include_str!("../../tests/studies.toml");
const CONNECTIONS: &str = include_str!("../../tests/connections.toml");
const STRUCTURES: &str = include_str!("../../tests/structures.toml");
const PENDULUM: &str = r#"
[parameters]
m = "2 kg"
l = "0.5 m"

[coordinates]
phi = { unit = "rad", start = "15 deg" }

[bodies.bob]
angle = "phi"
mass = "m"
center = ["0", "-l"]
"#;

const CLAIMS: &str = r#"
[outputs]
E = "m*g*l"
[[claims]]
name = "equation"
source = "a textbook"
equation = "phi'' = -(g/l)*sin(phi)"
tolerance = 1e-6
[[claims]]
of = "E"
value = "9.81 J"
at = "0 s"
[[claims]]
of = "E"
formula = "m*g*l"
[[claims]]
mode = 1
value = "4 rad/s"
[variants]
N = "1..3"
m = "1 [kg] + 0.1 [kg]*N"
[variants.require]
light = "m < 2 [kg]"
[[answers]]
id = "T"
formula = "2*pi*sqrt(l/g)"
unit = "s"
"#;

const fn key(name: &'static str, takes: Takes) -> Key {
    Key::new(name, takes, ("", ""), "\"1 s\"")
}

/// A study with a key of every sort.
static EVERYTHING: Kind = Kind::new("everything", ("", ""))
    .keys(&[
        key("until", Takes::End).required(),
        key("every", Takes::Step),
        key("at", Takes::Moments).not_with("every", "M065"),
        key("tolerance", Takes::Tolerance),
        key("period", Takes::Duration),
        key("settle", Takes::Wait),
        key("turns", Takes::Number(Limits::NotZero)),
        key("points", Takes::Count("M071", 2)),
        key("over", Takes::Coordinate),
        key("rate", Takes::Quantity(Like::RateOf("over"), Limits::NotZero)),
        key("speed", Takes::Quantity(Like::Is(Dimension::ANGULAR_RATE, "rad/s"), Limits::None)),
        key("range", Takes::RangeOf("over")),
        key("band", Takes::FrequencyRange),
        key("shapes", Takes::Frequencies),
        key("log", Takes::Flag),
        key("about", Takes::Word(&ABOUT)),
        key("unknown", Takes::Sought),
        key("along", Takes::Varied),
        key("load", Takes::Name),
        key("outputs", Takes::Results),
        key("observe", Takes::Observed),
        key("plot", Takes::Plots),
        key("guess", Takes::Guess),
        key("with", Takes::Driven("over")),
        key("section", Takes::Section),
        key("formulas", Takes::Formulas),
        key("frequency_variable", Takes::FrequencyVariable),
        key("values", Takes::Ranges),
        key("of", Takes::Repeatable),
    ])
    .check(|asked| match (asked.number("turns"), asked.number("settle")) {
        (Some(turns), Some(settle)) if settle < turns => vec![Objection::at("settle", "M071", "too short", "мало")],
        _ => Vec::new(),
    });
static NOTHING: Kind = Kind::new("nothing", ("", ""));
static ABOUT: Choice = Choice {
    words: &["rest", "start"],
    metavar: "WHAT",
    code: "M095",
    unknown: ("not `{}`", "не `{}`"),
    help: ("rest or start", "rest или start"),
};

fn read(text: &str, file: &str, overrides: &[(String, String)]) -> Result<Reading, Vec<Notice>> {
    read_with(text, file, overrides, &Kinds::new(vec![&EVERYTHING, &NOTHING], vec!["nothing"]))
}

fn good(text: &str) -> Reading {
    read(text, "gallery/top/model.toml", &[]).unwrap_or_else(|d| {
        panic!("{:#?}", d.iter().map(|d| (d.code, &d.what.en, d.span().map(|s| text[s].to_owned()))).collect::<Vec<_>>())
    })
}
fn set(text: &str, overrides: &[(&str, &str)]) -> Result<Reading, Vec<Notice>> {
    let overrides: Vec<_> = overrides.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
    read(text, "", &overrides)
}
/// The findings of a pendulum with some text replaced, as (code, underlined text).
fn faults(from: &str, to: &str) -> Vec<(&'static str, String)> {
    assert!(PENDULUM.contains(from), "{from}");
    findings(&PENDULUM.replace(from, to))
}
fn findings(text: &str) -> Vec<(&'static str, String)> {
    let found = match read(text, "", &[]) {
        Ok(reading) => reading.warnings,
        Err(found) => found,
    };
    found.into_iter().map(|d| (d.code, d.span().map_or(String::new(), |s| text[s].to_owned()))).collect()
}

#[test]
fn every_key_of_the_tables_is_read_and_only_those() {
    let claims = format!("{PENDULUM}{CLAIMS}");
    for text in [FULL, STUDIES, CONNECTIONS, STRUCTURES, &claims] {
        // a guess stands where connections keep the start
        let warnings: Vec<Notice> = good(text).warnings.into_iter().filter(|d| d.code != "M119").collect();
        assert_eq!(warnings, []);
    }
    let asked = crate::reader::asked();
    for table in fields::all() {
        // names of the user's own are no keys: the rows are read whatever they are called
        for field in table.fields.iter().filter(|field| field.key != "NAME") {
            assert!(asked.contains(&(table.name, field.key)), "the reader never asks for {}.{}", table.name, field.key);
        }
    }
}

#[test]
fn a_pendulum_becomes_a_model() {
    let model = good(PENDULUM).model;
    assert_eq!(model.title.en, "top");
    let names: Vec<_> = model.parameters.iter().map(|p| (p.name.as_str(), p.number.unwrap(), p.unit.as_str())).collect();
    assert_eq!(names, [("m", 2.0, "kg"), ("l", 0.5, "m"), ("g", 9.81, "m/s^2")]);
    assert_eq!(model.coordinates[0].units, ["rad", "rad/s", "rad/s^2"]);
    assert_eq!(model.frames.len(), 2);
    assert!(model.gravity.is_some());
    assert!(matches!(model.frames[1].mass.as_ref().unwrap().inertia, Inertia::None));
}

#[test]
fn the_full_file_keeps_its_meaning() {
    let model = good(FULL).model;
    let omega = model.parameters.iter().find(|p| p.name == "omega").unwrap();
    assert_eq!((omega.class, omega.unit.as_str()), (Class::Time, "rad/s"));
    assert!(matches!(omega.value, ParameterValue::Formula(_)));
    assert!(model.requests.iter().any(|r| matches!(r.kind, RequestKind::TimeDerivative { order: 1, .. })));
    let law = |table: &str, i: usize| {
        let (_, element) = model.acting().into_iter().filter(|(_, e)| e.table == table).nth(i).unwrap();
        format!("{:?}", element.law)
    };
    assert!(law("springs", 1).contains("Distance(") && law("dampers", 1).contains("RelativeAngle("));
    let n = model.parameters.iter().find(|p| p.name == "n").unwrap();
    // the product in another order: the last place
    assert!((n.number.unwrap() - 5.0 * std::f64::consts::TAU / 60.0).abs() < 1e-15);
    let parent = |name: &str| model.frames.iter().position(|f| f.name == name).unwrap();
    assert!(parent("housing") < parent("blade"), "a frame follows the frame of the point it stands on");
    assert_eq!(model.studies[1].times(), Times::At(vec![1.0, 2.5]));
    assert_eq!(
        model.notation,
        [("x", "x_1"), ("m", "m_p"), ("omega_p", "\\omega_p"), ("t_phase", "τ")].map(|(name, symbol)| (name.to_owned(), symbol.to_owned()))
    );
    assert_eq!(model.outputs[0].unit, "rad/s");
}

#[test]
fn one_slip_gives_one_finding_at_its_place() {
    for (from, to, code, place) in [
        ("mass =", "mas =", "M005", "mas"),
        ("\"2 kg\"", "\"2 kq\"", "M021", "kq"),
        ("\"2 kg\"", "\"2 m\"", "M024", "m"),
        ("\"0.5 m\"", "\"1e999 m\"", "M022", "1e999"),
        ("\"0.5 m\"", "1e999", "M022", "1e999"),
        ("\"phi\"\nmass", "\"psi\"\nmass", "M013", "psi"),
        ("\"-l\"", "\"-l*(1 + l)\"", "M025", "1 + l"),
        ("\"-l\"", "\"-2,5*l\"", "M031", "2,5"),
        ("\"-l\"", "\"-l)\"", "M030", ")"),
        ("\"-l\"", "\"-5 m\"", "", ""),
        ("\"-l\"", "\"-2 m * 2\"", "", ""),
        ("\"-l\"", "-5", "M023", "-5"),
        ("\"-l\"", "\"-l/0\"", "M042", "0"),
        ("\"-l\"", "\"-l*l/(l-l)\"", "M042", "-l*l/(l-l)"),
        ("\"-l\"", "\"x(bob)\"", "M037", "x(bob)"),
        ("\"-l\"", "\"-l*t/1 [s]\"", "M036", "t"),
        ("\"-l\"", "\"sinn(l)\"", "M033", "sinn"),
        ("\"-l\"", "\"sin(l)*l\"", "M026", "l"),
        ("\"2 kg\"", "\"l*1 [kg/m] + J\"\nJ = \"m\"", "M040", "l*1"),
        ("\"2 kg\"", "\"-2 kg\"", "M050", "\"m\""),
        ("\"2 kg\"", "\"0 kg\"", "M050", "\"m\""),
        ("mass = \"m\"", "shape = \"disc(l)\"", "M052", "\"disc(l)\""),
        ("mass = \"m\"", "mass = \"m\"\nshape = \"disk(l)\"", "M054", "disk"),
        ("mass = \"m\"", "mass = \"m\"\nshape = \"disc(l-l)\"", "M051", "\"disc(l-l)\""),
        ("mass = \"m\"", "mass = \"m\"\ninertia = { xx = \"1 kg m^2\", yy = \"1 kg m^2\", zz = \"3 kg m^2\" }", "M055", "{"),
        ("mass = \"m\"", "mass = \"m\"\nspin = \"phi'\"", "M036", "phi'"),
        ("mass = \"m\"", "mass = \"m\"\nspin = \"50 Hz\"", "M027", "50 Hz"),
        ("mass = \"m\"", "mass = \"m\"\non = \"bob\"", "M041", "bob"),
        ("mass = \"m\"", "mass = \"m\"\non = \"pob\"", "M014", "\"pob\""),
        ("mass = \"m\"", "mass = \"m\"\nmass = \"m\"", "M004", "mass"),
        ("mass = \"m\"", "mass = m", "M002", "m"),
        ("[parameters]", "[parameters]\nμ = 1", "M003", "μ"),
        ("[parameters]", "[parameters]\nphi = 1", "M011", "phi"),
        ("[parameters]", "[parameters]\npi = 1", "M010", "pi"),
        ("{ unit = \"rad\", start = \"15 deg\" }", "{ start = \"15 deg\" }", "M006", "phi"),
        ("{ unit = \"rad\", start = \"15 deg\" }", "{ unit = \"deg\", start = 15 }", "M023", "15"),
        ("[bodies.bob]", "[springs.s]\nalong = \"phi\"\nstiffness = \"1 N/m\"\n[bodies.bob]", "M024", "1 N/m"),
        ("[bodies.bob]", "[springs.s]\nstiffness = \"1 N/m\"\n[bodies.bob]", "M057", "s"),
        ("[bodies.bob]", "[[study]]\nkind = \"simulat\"\n[bodies.bob]", "M064", "\"simulat\""),
        ("[bodies.bob]", "[[study]]\nkind = \"everything\"\nuntil = \"1 s\"\nevery = \"1e-9 s\"\n[bodies.bob]", "M067", "\"1e-9 s\""),
        ("[bodies.bob]", "[outputs]\na = \"phi'''\"\n[bodies.bob]", "M038", "phi'''"),
        ("[bodies.bob]", "[outputs]\na = \"m'\"\n[bodies.bob]", "M039", "m'"),
        ("[bodies.bob]", "[outputs]\na = \"max(phi)\"\n[bodies.bob]", "M034", "max(phi)"),
        ("[bodies.bob]", "[outputs]\na = \"2 phi*t\"\n[bodies.bob]", "M035", "2 phi"),
    ] {
        let found = faults(from, to);
        let codes: Vec<_> = found.iter().map(|f| f.0).collect();
        if code.is_empty() {
            continue;
        }
        assert!(codes == [code], "{to}: {found:?}");
        assert!(found[0].1.starts_with(place), "{to}: {found:?}");
    }
}

#[test]
fn all_errors_come_at_once_in_order() {
    let text = PENDULUM.replace("\"2 kg\"", "\"2 kq\"").replace("\"-l\"", "\"-k\"").replace("angle", "angel");
    let codes: Vec<_> = findings(&text).into_iter().map(|f| f.0).collect();
    assert_eq!(codes, ["M021", "M005", "M013"]);
}

#[test]
fn deep_and_long_input_is_bounded() {
    let formula = |f: String| PENDULUM.replace("\"-l\"", &format!("\"{f}\""));
    for (text, code) in [
        (formula(format!("{}l{}", "(".repeat(5000), ")".repeat(5000))), "M032"),
        (formula(format!("{}l", "-".repeat(5000))), "M032"),
        (formula(format!("l{}", "+l".repeat(100_000))), "M032"),
        (formula(format!("l*9{}", "*9.123456789e200".repeat(2000))), "M022"),
        (formula("l*2^99999999".to_owned()), "M042"),
        (formula("l*(1/3)^9999".to_owned()), "M022"),
        (format!("a{} = 1", ".a".repeat(100_000)), "M009"),
        (format!("a = {}", "[".repeat(100_000)), "M002"),
        ("#".repeat(super::MAX_FILE + 1), "M001"),
    ] {
        let codes: Vec<_> = findings(&text).into_iter().map(|f| f.0).collect();
        assert!(codes.contains(&code), "{code}: {:?}, {}", codes, &text[..40]);
    }
    let chain: String = (0..20_000).map(|i| format!("a{i} = \"a{}\"\n", i + 1)).collect();
    good(&PENDULUM.replace("[parameters]", &format!("[parameters]\n{chain}a20000 = 1")));
}

#[test]
fn values_set_by_hand_replace_numbers_formulas_and_starts() {
    let text = PENDULUM.replace("[parameters]", "[parameters]\nJ = \"m*l^2\"");
    let model = set(&text, &[("J", "3"), ("m", "500 g"), ("phi", "0.1"), ("phi'", "1450 rpm"), ("g", "1,62 m/s^2")]).unwrap().model;
    let number = |name: &str| model.parameters.iter().find(|p| p.name == name).unwrap().number.unwrap();
    assert_eq!((number("J"), number("m"), number("g")), (3.0, 0.5, 1.62));
    assert_eq!(model.graph.as_number(model.coordinates[0].start).unwrap().to_f64(), 0.1);
    for (name, value, code) in [("M", "3", "M068"), ("m", "3 m", "M024"), ("m", "3 kq", "M021"), ("phi", "1 m", "M024"), ("m", "t", "M024")]
    {
        let found = set(&text, &[(name, value)]).unwrap_err();
        assert_eq!(found[0].code, code, "{name}={value}");
        assert!(found[0].span().is_none());
    }
}

#[test]
fn a_machine_without_gravity_does_not_list_g() {
    let model = good(&PENDULUM.replace("[parameters]", "gravity = false\n[parameters]")).model;
    assert!(model.gravity.is_none() && model.parameters.iter().all(|p| p.name != "g"));
}

#[test]
fn shapes_give_the_moments_of_the_handbook() {
    for (shape, expected) in [
        ("disc(l)", [0.125, 0.125, 0.25]),
        ("ring(l)", [0.25, 0.25, 0.5]),
        ("rod(l)", [0.0, 1.0 / 24.0, 1.0 / 24.0]),
        ("sphere(l)", [0.2; 3]),
        ("box(l, 2*l, l)", [5.0 / 24.0, 2.0 / 24.0, 5.0 / 24.0]),
    ] {
        let model = good(&PENDULUM.replace("mass = \"m\"", &format!("mass = \"m\"\nshape = \"{shape}\""))).model;
        let Inertia::Tensor { xx, yy, zz, .. } = model.frames[1].mass.as_ref().unwrap().inertia else { panic!() };
        let mut values = crate::reader::evaluate::Values::default();
        let mut graph = model.graph.clone();
        for p in &model.parameters {
            values.set(&mut graph, p.symbol, p.number.unwrap());
        }
        let got = [xx, yy, zz].map(|e| values.of(&graph, e));
        // formulas of shapes in another order
        assert!(got.iter().zip(expected).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-14), "{shape}: {got:?}");
    }
}

#[test]
fn studies_keep_their_meaning() {
    let model = good(STUDIES).model;
    let phi = model.coordinates[0].symbols[0];
    let [first, second] = &model.studies[..] else { panic!() };
    let numbers = |asked: &Asked, keys: &[&str]| keys.iter().map(|k| asked.number(k).unwrap()).collect::<Vec<_>>();
    let keys = ["until", "period", "settle", "turns", "points", "rate", "speed", "tolerance"];
    assert_eq!(numbers(first, &keys), [1.0, 8.0, 5.0, 2.0, 73.0, 10.0, 40.0 * std::f64::consts::PI / 60.0, 1e-10]);
    assert_eq!((first.coordinate("over").unwrap().symbol, first.times()), (phi, Times::Every(0.01)));
    assert_eq!(first.numbers("range").unwrap(), [-1.0, 1.0]);
    assert_eq!(first.numbers("band").unwrap(), [1.0, 2.0].map(|f| f * std::f64::consts::TAU));
    assert_eq!((first.words("observe"), first.words("outputs")), (&["period".to_owned()][..], &["twice".to_owned()][..]));
    let Some(Value::Formulas(list)) = first.get("formulas") else { panic!() };
    assert_eq!(list.iter().map(|f| (f.text.as_str(), f.unit.as_str())).collect::<Vec<_>>(), [("x + 1 [m]", "m"), ("phi'", "rad/s")]);
    assert!(matches!(first.get("section"), Some(Value::Formula(_))));
    assert!(matches!(second.get("section"), Some(Value::Coordinate(named)) if named.is_angle()));
    let range = crate::sweep_range(&model, "v=linspace(1 m/s, 3 m/s, 21)").unwrap();
    assert_eq!(range.values.len(), 21);
    assert_eq!(crate::sweep_range(&model, "v=1 m").unwrap_err().code, "M024");
    assert_eq!(crate::sweep_range(&model, "w=1 m").unwrap_err().code, "M068");
}

#[test]
fn values_of_studies_that_do_not_fit_are_refused() {
    for (study, code) in [
        ("every = 0", "M065"),
        ("every = \"1 ns\"", "M067"),
        ("every = \"1 ms\"\nat = [0]", "M065"),
        ("at = [\"2 s\"]", "M065"),
        ("settle = \"-1 s\"", "M065"),
        ("tolerance = 1", "M065"),
        ("turns = 0", "M071"),
        ("turns = 2\nsettle = \"1 s\"", "M071"),
        ("points = 1.5", "M071"),
        ("over = \"m\"", "M013"),
        ("over = \"phi\"\nrate = \"1 m\"", "M024"),
        ("over = \"phi\"\nwith = { phi = \"phi\" }", "M071"),
        ("over = \"phi\"\nrange = [1, 0]", "M093"),
        ("about = \"it\"", "M095"),
        ("log = 1", "M007"),
        ("unknown = \"M\"", "M072"),
        ("along = \"M\"", "M092"),
        ("section = \"m\"", "M071"),
        ("outputs = [\"q\"]", "M066"),
        ("values = \"m\"", "M070"),
        ("values = \"m=1 m\"", "M024"),
        ("values = \"q=1 m\"", "M068"),
        ("of = \"sweep\"", "M064"),
        ("frequency_variable = { z = \"m\" }", "M091"),
        ("[variants]", "M089"),
        ("[variants]\ntable = \"a\"\nrows = \"b\"", "M089"),
        ("[variants]\ntable = \"a\"\ncolumns = [\"m\", \"q\"]", "M089"),
        ("[variants]\ntable = \"a\"\nnumber = \"phi\"", "M089"),
    ] {
        let found = findings(&format!("{PENDULUM}\n[[study]]\nkind = \"everything\"\nuntil = \"1 s\"\n{study}\n"));
        let codes: Vec<_> = found.iter().map(|f| f.0).collect();
        assert_eq!(codes, [code], "{study}: {found:?}");
    }
    for (study, code) in
        [("kind = \"nothing\"\nuntil = \"1 s\"", "M005"), ("kind = \"everything\"", "M006"), ("kind = \"anything\"", "M064")]
    {
        let found = findings(&format!("{PENDULUM}\n[[study]]\n{study}\n"));
        assert_eq!(found.iter().map(|f| f.0).collect::<Vec<_>>(), [code], "{study}: {found:?}");
    }
}
