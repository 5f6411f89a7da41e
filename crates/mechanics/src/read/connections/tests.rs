//! Claims about connections, right and wrong.

use crate::model::{ConnectionKind, Model, Part, PointRef, Pressing, RequestKind, Rest, SupportDirection, Track};
use crate::read::read;

const CONNECTIONS: &str = include_str!("../../../tests/connections.toml");
const BASE: &str = r#"
[parameters]
r = "0.1 m"
R = "0.3 m"
F = "10 N"

[coordinates]
phi = "rad"
psi = "rad"
x = "m"

[bodies.crank]
angle = "phi"
inertia = "1 kg m^2"

[bodies.drum]
angle = "psi"
inertia = "1 kg m^2"

[bodies.block]
origin = ["x", 0]
mass = "1 kg"

[frames.plate]
on = "crank"
origin = ["r", 0]

[points]
A = { on = "crank", at = ["r", 0] }
A2 = { on = "crank", at = [0, "r"] }
P = { on = "plate", at = [0, 0] }
B = { on = "block", at = [0, 0] }
M = { on = "block", at = ["0.1*x", 0] }
O = { at = [0, 0] }
"#;

fn model(text: &str) -> Model {
    read(text, "", &[])
        .map(|r| r.model)
        .unwrap_or_else(|d| panic!("{text}\n{:#?}", d.iter().map(|d| (d.code, &d.what.en)).collect::<Vec<_>>()))
}
fn kind<'m>(model: &'m Model, table: &str, name: &str) -> &'m ConnectionKind {
    &model.connections.iter().find(|c| c.table == table && c.name == name).unwrap().kind
}
/// Codes and underlined text of the findings of the base with something added.
fn faults(added: &str) -> Vec<(&'static str, String)> {
    let text = format!("{BASE}\n{added}\n");
    let found = match read(&text, "", &[]) {
        Ok(reading) => reading.warnings,
        Err(found) => found,
    };
    found.into_iter().map(|d| (d.code, d.span().map_or(String::new(), |s| text[s].to_owned()))).collect()
}

#[test]
fn every_table_keeps_its_meaning() {
    let model = model(CONNECTIONS);
    let name = |f: crate::model::FrameId| model.frames[f.index()].name.clone();
    assert!(matches!(kind(&model, "pins", "A"), ConnectionKind::Pin { axes, .. } if name(*axes) == "crank"));
    let ConnectionKind::Weld { between: [PointRef::Origin(a), PointRef::Origin(b)], .. } = kind(&model, "welds", "W") else { panic!() };
    assert_eq!([name(*a), name(*b)], ["bar", "drum"]);
    assert!(matches!(kind(&model, "sliders", "B"), ConnectionKind::Slider { turns: false, through: Some(_), .. }));
    assert!(matches!(kind(&model, "sliders", "free"), ConnectionKind::Slider { turns: true, through: None, .. }));
    assert!(matches!(kind(&model, "slots", "K"), ConnectionKind::Slider { turns: true, on, .. } if name(*on) == "bar"));
    assert!(matches!(kind(&model, "rods", "AB"), ConnectionKind::Rod { length: Rest::Value(_), .. }));
    assert!(matches!(kind(&model, "rods", "held"), ConnectionKind::Rod { length: Rest::Start, .. }));
    let ConnectionKind::Rope { path, wound, slack: true, .. } = kind(&model, "ropes", "R") else { panic!() };
    assert_eq!((path.len(), wound[0].positive, wound[1].positive), (3, false, true));
    assert!(matches!(kind(&model, "ropes", "drums"), ConnectionKind::Rope { path, slack: false, .. } if path.is_empty()));
    let opposite = |table, name| matches!(kind(&model, table, name), ConnectionKind::Wheels { opposite: true, .. });
    assert!(opposite("belts", "S") && !opposite("chains", "X") && !opposite("gears", "G"));
    assert!(matches!(
        kind(&model, "racks", "Z"),
        ConnectionKind::Rolling { held: false, track: Track::Line { through: None, left: false, .. }, .. }
    ));
    assert!(matches!(
        kind(&model, "rolling", "F"),
        ConnectionKind::Rolling { held: true, track: Track::Line { through: Some(_), left: true, .. }, .. }
    ));
    assert!(matches!(kind(&model, "rolling", "C"), ConnectionKind::Rolling { held: false, track: Track::Circle { inside: true, .. }, .. }));
    assert!(matches!(kind(&model, "constraints", "K"), ConnectionKind::Constraint { on_rates: false, .. }));
    assert!(matches!(kind(&model, "constraints", "N"), ConnectionKind::Constraint { on_rates: true, .. }));
    let ConnectionKind::Support { directions, .. } = kind(&model, "supports", "B") else { panic!() };
    assert_eq!(directions, &[SupportDirection::TurnZ, SupportDirection::Y]);
    assert!(matches!(kind(&model, "motions", "lift"), ConnectionKind::Motion { is_rate: true, .. }));
    assert!(matches!(kind(&model, "stops", "wall"), ConnectionKind::Stop { above: false, .. }));
    assert!(matches!(kind(&model, "frictions", "rail"), ConnectionKind::Friction { fixed: Some(_), normal: Pressing::Given, .. }));
    assert!(matches!(kind(&model, "frictions", "block"), ConnectionKind::Friction { fixed: Some(_), normal: Pressing::Formula(_), .. }));
}

#[test]
fn reactions_have_names_units_and_components() {
    let model = model(CONNECTIONS);
    let request =
        |name: &str| model.requests.iter().find(|r| model.graph.symbol_info(r.symbol).name == name).unwrap_or_else(|| panic!("{name}"));
    for (name, part, unit) in [
        ("force(pins.A)", Part::Force, "N"),
        ("force_x(pins.A)", Part::ForceX, "N"),
        ("moment(W)", Part::Moment, "N m"),
        ("torque(W)", Part::Moment, "N m"),
        ("moment(sliders.B)", Part::Moment, "N m"),
        ("normal(F)", Part::Normal, "N"),
        ("torque(motors.B)", Part::Force, "N m"),
        ("force(base)", Part::Force, "N m"),
        ("force(constraints.K)", Part::Force, "N"),
        ("force(N)", Part::Force, "N"),
        ("moment_x(supports.A)", Part::MomentX, "N m"),
    ] {
        let found = request(name);
        assert!(matches!(found.kind, RequestKind::Reaction(_, p) if p == part), "{name}: {found:?}");
        assert_eq!(found.unit, unit, "{name}");
    }
    let RequestKind::Reaction(i, _) = request("force(slots.K)").kind else { panic!() };
    assert_eq!((model.connections[i].table, model.connections[i].name.as_str()), ("slots", "K"));
}

#[test]
fn a_line_load_has_the_resultant_and_moment_of_its_trapezoid() {
    let model = model(&format!(
        "{BASE}\nC = {{ on = \"block\", at = [\"2 m\", 0] }}\nD = {{ on = \"block\", at = [\"5 m\", \"4 m\"] }}\n\
         [distributed.q]\nfrom = \"C\"\nto = \"D\"\nvalue = [\"1 N/m\", \"2 N/m\"]\nvalue_end = [\"4 N/m\", \"-6 N/m\"]\n"
    ));
    let number = |e| model.graph.as_number(e).map(|r| r.to_f64());
    let (mut force, mut moment) = ([0.0; 2], 0.0);
    let mut parts = 0;
    for f in model.elements.iter().filter(|f| f.path == "distributed.q") {
        let at = model.points.iter().find(|p| p.name == f.name).unwrap().at.map(|e| number(e).unwrap());
        let value: Vec<f64> = f.law.straight().formulas.into_iter().map(|e| number(e).unwrap()).collect();
        parts += 1;
        force = [force[0] + value[0], force[1] + value[1]];
        moment += at[0] * value[1] - at[1] * value[0];
    }
    assert_eq!(parts, 2);
    // L = 5; ∫ q ds = L (q0 + q1)/2; ∫ (r × q) ds by Simpson's rule, exact for quadratics
    assert!((force[0] - 12.5).abs() < 1e-12 && (force[1] + 10.0).abs() < 1e-12, "{force:?}");
    let cross = |s: f64| {
        let (x, y) = (2.0 + 3.0 * s, 4.0 * s);
        x * (2.0 - 8.0 * s) - y * (1.0 + 3.0 * s)
    };
    let exact = 5.0 * (cross(0.0) + 4.0 * cross(0.5) + cross(1.0)) / 6.0;
    // sums of resultants with terms of some tens
    assert!((moment - exact).abs() < 1e-12, "{moment} {exact}");
}

#[test]
fn a_slip_gives_one_finding_at_its_place() {
    for (added, code, place) in [
        ("[pins.a]\nbetween = [\"A\", \"B\"]", "", ""),
        ("[pins.a]\nbetween = [\"A\", \"A\"]", "M063", "[\"A\""),
        ("[pins.a]\nbetween = [\"A\", \"A2\"]", "M073", "[\"A\""),
        ("[pins.a]\nbetween = [\"A\", \"P\"]", "M073", "[\"A\""),
        ("[pins.a]\nbetween = [\"O\", \"ground\"]", "M073", "[\"O\""),
        ("[pins.a]\nbetween = [\"M\", \"B\"]", "", ""),
        ("[pins.a]\nbetween = [\"A\", \"Q\"]", "M014", "\"Q\""),
        ("[pins.a]\nbetween = [\"A\", \"B\"]\naxes = \"A\"", "M014", "\"A\""),
        ("[pins.a]\nbetween = [\"A\"]", "M008", "[\"A\"]"),
        ("[pins.a]\nbetwen = [\"A\", \"B\"]", "M006 M005", ""),
        ("[welds.a]\nbetween = [\"crank\", \"plate\"]", "M073", "["),
        ("[sliders.a]\npoint = \"A\"\non = \"crank\"", "M073", "\"A\""),
        ("[sliders.a]\npoint = \"O\"", "M073", "\"O\""),
        ("[sliders.a]\npoint = \"A\"\nthrough = \"B\"", "M078", "\"B\""),
        ("[sliders.a]\npoint = \"A\"\nturns = \"no\"", "M007", "\"no\""),
        ("[sliders.a]\npoint = \"A\"\ndirection = \"phi\"", "M036", "phi"),
        ("[slots.a]\npin = \"A\"\non = \"block\"\ndirection = \"1 m\"", "M024", "1 m"),
        ("[rods.a]\nbetween = [\"A\", \"B\"]\nlength = \"-r\"", "M074", "\"-r\""),
        ("[rods.a]\nbetween = [\"A\", \"B\"]\nlength = \"0 m\"", "M074", "\"0 m\""),
        ("[rods.a]\nbetween = [\"A\", \"A2\"]", "M073", "["),
        ("[ropes.a]\npath = [\"A\"]", "M082", "a"),
        ("[ropes.a]", "M082", "a"),
        ("[ropes.a]\npath = [\"A\", \"A\", \"B\"]", "M063", "\"A\""),
        ("[ropes.a]\npath = [\"A\", \"P\"]", "M073", "a"),
        ("[ropes.a]\npath = [\"A\", \"B\"]\nwound = [{ on = \"drum\", radius = \"-R\" }]", "M074", "\"-R\""),
        ("[ropes.a]\npath = [\"A\", \"B\"]\nwound = [{ on = \"drum\", radius = \"R\", turns_in = \"left\" }]", "M075", "\"left\""),
        ("[ropes.a]\npath = [\"A\", \"B\"]\nwound = { on = \"drum\", radius = \"R\" }", "M007", "{"),
        ("[threads.a]\npath = [\"A\", \"B\"]\nrestitution = 1.5", "M079", "1.5"),
        ("[threads.a]\npath = [\"A\", \"B\"]\nrestitution = 0\nslack = false", "M080", "0"),
        ("[belts.a]\nbetween = [\"crank\", \"drum\"]\nradii = [\"r\", \"-R\"]", "M074", "\"-R\""),
        ("[belts.a]\nbetween = [\"crank\", \"drum\"]\nradii = [\"r\"]", "M008", "[\"r\"]"),
        ("[belts.a]\nbetween = [\"crank\", \"A\"]\nradii = [\"r\", \"R\"]", "M014", "\"A\""),
        ("[gears.a]\nbetween = [\"crank\", \"crank\"]\nradii = [\"r\", \"R\"]", "M063", "["),
        ("[gears.a]\nbetween = [\"crank\", \"plate\"]\nradii = [\"r\", \"R\"]", "M073", "["),
        ("[gears.a]\nbetween = [\"crank\", \"drum\"]\nradii = [\"r\", \"R\"]\ncarrier = \"drum\"", "M063", "\"drum\""),
        ("[chains.a]\nbetween = [\"crank\", \"drum\"]\nradii = [\"r\", \"R\"]\ncrossed = true", "M005", "crossed"),
        ("[racks.a]\ngear = \"drum\"\nradius = \"0 m\"", "M074", "\"0 m\""),
        ("[racks.a]\ngear = \"drum\"\nradius = \"R\"\nside = \"lef\"", "M075", "\"lef\""),
        ("[racks.a]\ngear = \"drum\"\nradius = \"R\"\non = \"drum\"", "M073", "\"drum\""),
        ("[rolling.a]\nbody = \"block\"\nradius = \"R\"\nthrough = \"A\"", "M078", "\"A\""),
        ("[rolling.a]\nbody = \"block\"\nradius = \"R\"\ncircle = { center = \"O\", radius = \"r\", inside = true }", "M074", "\"r\""),
        ("[rolling.a]\nbody = \"block\"\nradius = \"R\"\nside = \"left\"\ncircle = { center = \"O\", radius = \"r\" }", "M080", "\"left\""),
        ("[constraints.a]\nzero = \"x - r\"\nzero_rate = \"x'\"", "M080", "\"x'\""),
        ("[constraints.a]", "M080", "a"),
        ("[constraints.a]\nzero = \"x' - 1 [m/s]\"", "M036", "x'"),
        ("[constraints.a]\nzero = \"r - R\"", "M083", "\"r - R\""),
        ("[constraints.a]\nzero_rate = \"x'^2 - r^2*phi'^2\"", "M083", "\""),
        ("[constraints.a]\nzero_rate = \"vx(A)*omega(drum)\"", "M083", "\""),
        ("[constraints.a]\nzero_rate = \"speed(A) - r*phi'\"", "M083", "\""),
        ("[constraints.a]\nzero_rate = \"vx(A)*sin(phi) - x' + phi*x\"", "M025", ""),
        ("[supports.a]\nat = \"A\"\ndirections = [\"x\", \"w\"]", "M075", "\"w\""),
        ("[supports.a]\nat = \"A\"\ndirections = [\"turn\", \"turn_z\"]", "M081", "\"turn_z\""),
        ("[supports.a]\nat = \"A\"\ndirections = []", "M081", "[]"),
        ("[supports.a]\nat = \"O\"\ndirections = [\"x\"]", "M081", "\"O\""),
        ("[motions.a]\nalong = \"x\"", "M080", "a"),
        ("[motions.a]\nalong = \"x\"\nrate = \"1 m\"", "M024", "1 m"),
        ("[motions.a]\nalong = \"x\"\nvalue = \"r*phi\"", "M036", "phi"),
        ("[motions.a]\nvalue = \"r\"", "M057", "a"),
        ("[motors.a]\non = \"ground\"", "M063", "\"ground\""),
        ("[motors.a]\non = \"crank\"\nalong = \"phi\"", "M057", "a"),
        ("[stops.a]\nalong = \"x\"\nat_least = 0\nat_most = \"R\"", "M080", "\"R\""),
        ("[stops.a]\nalong = \"x\"\nat_least = 0\nrestitution = -1", "M079", "-1"),
        ("[stops.a]\nalong = \"x\"\nat_least = \"1 kg\"", "M024", "1 kg"),
        ("[frictions.a]\nalong = \"x\"", "M080", "a"),
        ("[frictions.a]\nalong = \"x\"\nkinetic = \"F\"\nstatic = \"F/2\"", "M086", "\"F/2\""),
        ("[frictions.a]\nalong = \"x\"\nkinetic = \"-F\"", "M086", "\"-F\""),
        ("[frictions.a]\nalong = \"x\"\nkinetic = \"F*(1 + u)\"", "M025", "1 + u"),
        ("[frictions.a]\nalong = \"x\"\nkinetic = \"F*x'/1 [m/s]\"", "M036", "x'"),
        ("[frictions.a]\nalong = \"x\"\nkinetic = \"F\"\nnormal = \"F\"", "M080", "\"F\""),
        ("[frictions.a]\nalong = \"x\"\ncoefficient = 0.2", "M080", "a"),
        ("[frictions.a]\nalong = \"x\"\ncoefficient = 0.2\nnormal = \"F\"\nstatic = \"F\"", "M080", "\"F\""),
        ("[frictions.a]\nalong = \"phi\"\ncoefficient = 0.2\nnormal = \"F\"", "M023", "0.2"),
        ("[frictions.a]\nalong = \"phi\"\ncoefficient = \"0.2*r\"\nnormal = \"F\"", "", ""),
        (
            "[pins.p]\nbetween = [\"A\", \"B\"]\n[frictions.a]\nalong = \"x\"\ncoefficient = 0.2\nnormal = \"force(p)\"",
            "M085",
            "\"force(p)\"",
        ),
        ("[pins.p]\nbetween = [\"A\", \"B\"]\n[frictions.a]\nalong = \"x\"\ncoefficient = 0.2\nnormal = \"force_y(p) + F\"", "", ""),
        ("[pins.p]\nbetween = [\"A\", \"B\"]\n[frictions.a]\nalong = \"x\"\ncoefficient = 0.2\nnormal = \"force_y(p)^2/F\"", "M085", "\""),
        ("[springs.s]\nalong = \"x\"\nstiffness = \"1 N/m\"\nbacklash = \"-1 mm\"", "M088", "\"-1 mm\""),
        ("[springs.s]\nalong = \"x\"\nstiffness = \"1 N/m\"\nbacklash = \"1 mm\"\npreload = \"F\"", "M088", "\"1 mm\""),
        ("[distributed.q]\nfrom = \"A\"\nto = \"B\"\nvalue = [0, \"1 N/m\"]", "M087", "\"B\""),
        ("[distributed.q]\nfrom = \"A\"\nto = \"A2\"\nvalue = [0, \"1 N\"]", "M024", "1 N"),
        ("[distributed.q]\nfrom = \"A\"\nto = \"A2\"\non = \"block\"\nvalue = [0, \"1 N/m\"]", "M087", "\"block\""),
        ("[distributed.q]\nfrom = \"A\"\nto = \"A\"\nvalue = [0, \"1 N/m\"]", "M063", "\"A\""),
        ("[distributed.q]\nfrom = \"M\"\nto = \"B\"\nvalue = [0, \"1 N/m\"]", "M087", "\"B\""),
    ] {
        let found = faults(added);
        let codes: Vec<&str> = found.iter().map(|f| f.0).collect();
        let wanted: Vec<&str> = code.split_whitespace().collect();
        assert!(codes == wanted, "{added}: {found:?}");
        assert!(found.first().is_none_or(|f| f.1.starts_with(place)), "{added}: {found:?}");
    }
}

#[test]
fn reactions_stand_where_they_may_and_have_the_parts_they_have() {
    let joints = "[pins.p]\nbetween = [\"A\", \"B\"]\n[rods.p]\nbetween = [\"A2\", \"B\"]\n[rods.r]\nbetween = [\"A2\", \"O\"]\n[motions.m]\nalong = \"x\"\nvalue = 0\n";
    for (added, code, place) in [
        ("[outputs]\na = \"force(r)\"", "", ""),
        ("[outputs]\na = \"force_x(p)\"", "M014", "p"),
        ("[outputs]\na = \"force_x(pins.p) + force(rods.p)\"", "", ""),
        ("[outputs]\na = \"normal(r)\"", "M077", "r"),
        ("[outputs]\na = \"moment(pins.p)\"", "M077", "p"),
        ("[outputs]\na = \"force(m)\"", "M077", "m"),
        ("[outputs]\na = \"force(q)\"", "M014", "q"),
        ("[outputs]\na = \"force(r)*1 [m]\"\nb = \"a'\"", "M038", "a'"),
        ("[outputs]\na = \"extension(r)\"", "M014", "r"),
        ("[forces.f]\nalong = \"x\"\nvalue = \"0.1*force(r)\"", "M076", "force(r)"),
        ("[springs.f]\nalong = \"x\"\nstiffness = \"force(r)/1 [m]\"", "M076", "force(r)"),
        ("[potentials.f]\nenergy = \"force(r)*r\"", "M076", "force(r)"),
        ("[constraints.f]\nzero_rate = \"x'*force(r)\"", "M076", "force(r)"),
        ("[pins.f]\nbetween = [\"A\", \"Q\"]\n[outputs]\na = \"force(f) + force_x(f)\"", "M014", "\"Q\""),
        ("[springs.f]\nalong = \"phi\"\nstiffness = \"1 N m\"\n[outputs]\na = \"torque(f)\"", "", ""),
        ("[springs.f]\nalong = \"x\"\nstiffness = \"1 N/m\"\n[outputs]\na = \"torque(f)\"", "M077", "f"),
    ] {
        let found = faults(&format!("{joints}{added}"));
        let codes: Vec<&str> = found.iter().map(|f| f.0).collect();
        let wanted: Vec<&str> = code.split_whitespace().collect();
        assert!(codes == wanted && found.first().is_none_or(|f| f.1.starts_with(place)), "{added}: {found:?}");
    }
}

#[test]
fn the_letter_u_is_free_elsewhere() {
    let renamed = BASE.replace("F = \"10 N\"", "F = \"10 N\"\nu = \"1 m/s\"");
    let codes = |added: &str| match read(&format!("{renamed}\n{added}"), "", &[]) {
        Ok(_) => Vec::new(),
        Err(found) => found.iter().map(|d| d.code).collect::<Vec<_>>(),
    };
    assert_eq!(codes("[frictions.a]\nalong = \"x\"\nkinetic = \"F\"\n[outputs]\nb = \"2*u\""), [""; 0]);
    assert_eq!(codes("[frictions.a]\nalong = \"x\"\nkinetic = \"F/(1 + u/1 [m/s])\""), ["M084"]);
}

#[test]
fn a_rod_of_a_frame_is_no_connection() {
    let text = format!(
        "{BASE}\n[nodes]\nN1 = {{ at = [0, 0] }}\nN2 = {{ at = [\"1 m\", 0] }}\n[rods.frame]\nbetween = [\"N1\", \"N2\"]\n[rods.tie]\nbetween = [\"A\", \"B\"]\n\
         [outputs]\na = \"force(frame)\"\nb = \"force(tie)\"\n"
    );
    let found = match read(&text, "", &[]) {
        Ok(_) => Vec::new(),
        Err(found) => found,
    };
    let words: Vec<String> = found.iter().map(|d| d.span().map_or(String::new(), |s| text[s].to_owned())).collect();
    assert!(words.iter().any(|w| w == "frame") && words.iter().all(|w| w != "tie"), "{words:?}");
}
