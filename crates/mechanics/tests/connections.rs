//! Connections derived in two ways: conditions differentiated, and forces on bodies projected. Both must agree at any state, whether the
//! connections are closed there or not, and in time with d/dt of the conditions.

use mechanics::derive::{Detail, derive_in};
use mechanics::model::{Connection, ConnectionKind, FrameId, Model, PointId, PointRef, Rest, Strands, SupportDirection, Track, Wound};
use symbolic::connections::Law;
use symbolic::{Equations, Expr, SymbolId};
use words::Text;

/// Two derivations at a random state: rounding of hundreds of operations on numbers about 1.
const DERIVED: f64 = 1e-12;
/// Central differences with the step 1e-5: step² = 1e-10 times third derivatives, rounding over step.
const DIFFERENCE: f64 = 1e-8;
/// The same on circles, whose third derivatives are larger.
const CURVED: f64 = 1e-7;

const BODIES: &str = r#"
[parameters]
m = "2 kg"
[coordinates]
x = "m"
y = "m"
a = "rad"
u = "m"
b = "rad"
[bodies.one]
origin = ["x", "y"]
angle = "a"
mass = "m"
inertia = "0.3 kg m^2"
center = ["0.1 m", "0.2 m"]
[bodies.two]
origin = ["u", "2*u - 1[m]"]
angle = "b"
mass = "1.5 kg"
inertia = "0.7 kg m^2"
[points]
P = { on = "one", at = ["0.4 m", "-0.1 m"] }
Q = { on = "two", at = ["-0.3 m", "0.6 m"] }
F = { at = ["0.2 m", "1.7 m"] }
[springs.s]
between = ["P", "Q"]
stiffness = "10 N/m"
rest = "0.5 m"
"#;

const P: PointRef = PointRef::Point(PointId(0));
const Q: PointRef = PointRef::Point(PointId(1));
const F: PointRef = PointRef::Point(PointId(2));
const ONE: FrameId = FrameId(1);
const TWO: FrameId = FrameId(2);

fn read(text: &str) -> Model {
    mechanics::read(text, "test.toml", &[]).unwrap().model
}

fn with(mut model: Model, table: &'static str, kind: ConnectionKind) -> Equations {
    model.connections.push(Connection { name: "K".into(), table, label: Text::default(), kind, unit: String::new(), span: 0..0 });
    derive_in(&model, Detail::Equations).unwrap_or_else(|e| panic!("{e:?}"))
}

/// A value for every symbol, spread over -1.3 ... 1.3; parameters have their own.
fn value(equations: &Equations, seed: f64) -> impl Fn(SymbolId) -> f64 + '_ {
    move |s| match equations.parameters.iter().find(|p| p.symbol == s) {
        Some(parameter) => parameter.value,
        None => 1.3 * (seed * 12.9898 + s.index() as f64 * 78.233).sin(),
    }
}

/// The largest difference between the two derivations: second_i against M q'' - h - Σ forces λ.
fn disagreement(equations: &Equations, seed: f64) -> f64 {
    let n = equations.coordinates.len();
    let mut graph = equations.graph.clone();
    let mut roots: Vec<Expr> = Vec::new();
    for i in 0..n {
        let mut terms = vec![graph.neg(equations.force[i])];
        for j in 0..n {
            let q = graph.symbol(equations.coordinates[j].symbols[2]);
            terms.push(graph.mul(equations.mass.get(i, j), q));
        }
        for reaction in &equations.reactions {
            for (_, e) in reaction.forces.iter().filter(|(j, _)| *j == i) {
                let symbol = graph.symbol(reaction.symbol);
                let product = graph.mul(*e, symbol);
                terms.push(graph.neg(product));
            }
        }
        let first = graph.sum(&terms);
        roots.push(graph.sub(first, equations.second[i]));
    }
    graph.evaluate(&roots, &value(equations, seed)).into_iter().fold(0.0, |m: f64, r| m.max(r.abs()))
}

/// The largest difference between J, remainder of a condition and finite differences of its rate along a motion.
fn wrong_derivatives(equations: &Equations, seed: f64) -> f64 {
    let mut worst: f64 = 0.0;
    let at = value(equations, seed);
    let along = |h: f64| {
        let at = &at;
        let place = |s: SymbolId| {
            let (q, qd, qdd) = match equations.coordinates.iter().find(|c| c.symbols.contains(&s)) {
                Some(c) => (at(c.symbols[0]), at(c.symbols[1]), at(c.symbols[2])),
                None => return if s == equations.time { at(s) + h } else { at(s) },
            };
            let which = equations.coordinates.iter().find_map(|c| c.symbols.iter().position(|k| *k == s)).unwrap();
            [q + h * qd + 0.5 * h * h * qdd, qd + h * qdd, qdd][which]
        };
        let roots: Vec<Expr> = equations.conditions.iter().flat_map(|c| [c.place.unwrap_or(c.rate), c.rate]).collect();
        equations.graph.evaluate(&roots, &place)
    };
    let h = 1e-5;
    let (plus, minus, here) = (along(h), along(-h), along(0.0));
    for (k, condition) in equations.conditions.iter().enumerate() {
        if condition.place.is_some() {
            worst = worst.max((here[2 * k + 1] - (plus[2 * k] - minus[2 * k]) / (2.0 * h)).abs());
        }
        let mut roots = vec![condition.remainder];
        roots.extend(condition.columns.iter().map(|(_, e)| *e));
        let values = equations.graph.evaluate(&roots, &at);
        let mut sum = values[0];
        for ((j, _), v) in condition.columns.iter().zip(&values[1..]) {
            sum += v * at(equations.coordinates[*j].symbols[2]);
        }
        worst = worst.max((sum - (plus[2 * k + 1] - minus[2 * k + 1]) / (2.0 * h)).abs());
    }
    worst
}

fn agrees(table: &'static str, kind: ConnectionKind, components: usize) {
    let equations = with(read(BODIES), table, kind);
    assert_eq!(equations.reactions.len(), components, "{table}");
    for seed in [0.3, 1.1, 2.7] {
        assert!(disagreement(&equations, seed) < DERIVED, "{table}: {}", disagreement(&equations, seed));
        assert!(wrong_derivatives(&equations, seed) < DIFFERENCE, "{table}: {}", wrong_derivatives(&equations, seed));
    }
}

fn number(model: &mut Model, value: &str) -> Expr {
    model.graph.number(symbolic::Rational::parse_decimal(value).unwrap())
}

#[test]
fn pins_and_welds_agree_in_both_derivations() {
    agrees("pins", ConnectionKind::Pin { between: [P, Q], axes: FrameId::GROUND }, 2);
    agrees("pins", ConnectionKind::Pin { between: [F, Q], axes: FrameId::GROUND }, 2);
    agrees("welds", ConnectionKind::Weld { between: [P, Q], axes: FrameId::GROUND }, 3);
}

#[test]
fn sliders_agree_also_on_moving_lines() {
    let mut model = read(BODIES);
    let direction = number(&mut model, "0.4");
    for (point, on, through) in [(P, FrameId::GROUND, Some(F)), (P, TWO, Some(Q)), (Q, ONE, None)] {
        for turns in [true, false] {
            let kind = ConnectionKind::Slider { point, on, through, direction, turns };
            let equations = with(model.clone(), "sliders", kind);
            assert_eq!(equations.reactions.len(), if turns { 1 } else { 2 });
            for seed in [0.3, 1.1, 2.7] {
                assert!(disagreement(&equations, seed) < DERIVED);
                assert!(wrong_derivatives(&equations, seed) < DIFFERENCE);
            }
        }
    }
}

#[test]
fn rods_ropes_and_wheels_agree() {
    agrees("rods", ConnectionKind::Rod { between: [P, Q], length: Rest::Start }, 1);
    let mut model = read(BODIES);
    let [r, s, e] = ["0.3", "0.2", "0.5"].map(|v| number(&mut model, v));
    for slack in [true, false] {
        let wound = vec![Wound { on: TWO, radius: r, carrier: Some(FrameId::GROUND), positive: false }];
        let kind = ConnectionKind::Rope { path: vec![P, F, Q], wound, length: Rest::Start, slack, restitution: e };
        let equations = with(model.clone(), "ropes", kind);
        assert_eq!(matches!(equations.reactions[0].law, Law::Contact { .. }), slack);
        assert!(disagreement(&equations, 0.7) < DERIVED && wrong_derivatives(&equations, 0.7) < DIFFERENCE);
    }
    // wheels whose axes a rod keeps at their distance; the line of centres turns
    let ends = [PointRef::Origin(ONE), PointRef::Origin(TWO)];
    let kind = ConnectionKind::Rod { between: ends, length: Rest::Start };
    model.connections.push(Connection { name: "R".into(), table: "rods", label: Text::default(), kind, unit: String::new(), span: 0..0 });
    for (table, opposite) in [("belts", false), ("belts", true), ("gears", true), ("gears", false)] {
        for carrier in [None, Some(FrameId::GROUND)] {
            let strands = if table == "gears" { Strands::Teeth } else { Strands::Slack { positive: opposite } };
            let kind = ConnectionKind::Wheels { between: [ONE, TWO], radii: [r, s], opposite, carrier, strands };
            let equations = with(model.clone(), table, kind);
            assert!(wrong_derivatives(&equations, 0.7) < DIFFERENCE);
            assert!(disagreement(&equations, 0.7) < DERIVED, "{table}");
        }
    }
}

/// Without the rod the wheels leave each other.
#[test]
fn wheels_whose_axes_part_are_refused() {
    let mut model = read(BODIES);
    let r = number(&mut model, "0.3");
    let kind = ConnectionKind::Wheels { between: [ONE, TWO], radii: [r, r], opposite: true, carrier: None, strands: Strands::Teeth };
    model.connections.push(Connection { name: "K".into(), table: "gears", label: Text::default(), kind, unit: String::new(), span: 0..0 });
    let codes: Vec<&str> = derive_in(&model, Detail::Equations).unwrap_err().iter().map(|d| d.code).collect();
    assert_eq!(codes, ["M118"]);
}

/// Components in turning axes: the second derivation agrees at states that the pin does not close.
#[test]
fn pins_agree_in_turning_axes() {
    for (table, axes, seed) in [("pins", ONE, 0.3), ("pins", TWO, 1.1), ("welds", TWO, 2.7)] {
        let kind = match table {
            "pins" => ConnectionKind::Pin { between: [P, Q], axes },
            _ => ConnectionKind::Weld { between: [P, Q], axes },
        };
        let equations = with(read(BODIES), table, kind);
        assert!(disagreement(&equations, seed) < DERIVED);
    }
}

#[test]
fn rolling_agrees_on_lines_and_circles() {
    let mut model = read(BODIES);
    let [r, large, direction] = ["0.3", "0.8", "0.4"].map(|v| number(&mut model, v));
    let tracks = [
        Track::Line { through: Some(F), direction, left: true },
        Track::Line { through: None, direction, left: false },
        Track::Circle { center: F, radius: large, inside: false },
        Track::Circle { center: F, radius: large, inside: true },
    ];
    for track in tracks {
        for held in [true, false] {
            let kind = ConnectionKind::Rolling {
                wheel: ONE,
                center: PointRef::Origin(ONE),
                radius: r,
                on: FrameId::GROUND,
                track,
                held,
                leaves: None,
            };
            let equations = with(model.clone(), "rolling", kind);
            assert_eq!(equations.reactions.len(), if held { 2 } else { 1 });
            assert!(disagreement(&equations, 0.7) < DERIVED);
            assert!(wrong_derivatives(&equations, 0.7) < CURVED);
        }
    }
}

const PENDULUM: &str = r#"
[parameters]
m = "2 kg"
l = "0.5 m"
[coordinates]
phi = "rad"
[bodies.rod]
angle = "phi"
mass = "m"
center = ["0", "-l"]
inertia = "0.1 kg m^2"
"#;

/// A bearing on a coordinate's own axle: m (x'', y'' + g) of the centre, by hand.
#[test]
fn a_support_on_the_axle_carries_the_pendulum() {
    let directions = vec![SupportDirection::X, SupportDirection::Y];
    let kind = ConnectionKind::Support { at: PointRef::Origin(ONE), directions, axes: FrameId::GROUND, on: None };
    let equations = with(read(PENDULUM), "supports", kind);
    assert!(equations.conditions.is_empty() && equations.balances.len() >= 2);
    let (phi, w, e) = (0.7, -1.9, 3.1);
    let c = &equations.coordinates[0];
    let at = |s: SymbolId| match equations.parameters.iter().find(|p| p.symbol == s) {
        Some(p) => p.value,
        None if s == c.symbols[0] => phi,
        None if s == c.symbols[1] => w,
        None if s == c.symbols[2] => e,
        None => f64::NAN,
    };
    let (m, l, g) = (2.0, 0.5, 9.81);
    let wanted = [m * l * (e * f64::cos(phi) - w * w * f64::sin(phi)), m * l * (e * f64::sin(phi) + w * w * f64::cos(phi)) + m * g];
    // every balance without what nobody declared holds with the forces known by hand
    let meets =
        |row: usize| equations.reactions.iter().enumerate().filter(move |(_, r)| r.released.iter().any(|own| own.0 == row)).map(|(i, _)| i);
    let known_alone = |row: &usize| meets(*row).count() > 0 && meets(*row).all(|i| i < 2);
    let rows: Vec<usize> = (0..equations.balances.len()).filter(known_alone).collect();
    assert!(rows.len() >= 2);
    for row in rows {
        let balance = &equations.balances[row];
        let known = |roots: &[symbolic::Expr]| equations.graph.evaluate(roots, &at);
        let inertia: f64 = balance.columns.iter().map(|(_, mass)| known(&[*mass])[0] * e).sum();
        let parts = equations.reactions.iter().zip(wanted);
        let forces: f64 = parts
            .flat_map(|(r, f)| r.released.iter().filter(|own| own.0 == row).map(move |own| (own.1, f)))
            .map(|(c, f)| known(&[c])[0] * f)
            .sum();
        let rest = known(&[balance.rest])[0];
        assert!((inertia - rest - forces).abs() < DERIVED, "{row}: {inertia} - {rest} {forces}");
    }
    assert!(equations.reactions.iter().all(|r| !r.released.is_empty()));
}

/// Two bodies that stand still: the pin between them releases the one that the support holds.
#[test]
fn joints_of_a_resting_structure_have_balances_only() {
    let text = "[bodies.left]\nmass = \"1 kg\"\ncenter = [\"1 m\", \"0\"]\n[bodies.right]\norigin = [\"2 m\", \"0\"]\nmass = \"1 kg\"\n";
    let mut model = read(&format!(
        "{text}[points]\nC = {{ on = \"left\", at = [\"2 m\", \"0\"] }}\n[coordinates]\nq = \"m\"\n[bodies.cart]\norigin = [\"q\", \"0\"]\nmass = \"1 kg\"\n"
    ));
    let directions = vec![SupportDirection::X, SupportDirection::Y];
    let kind = ConnectionKind::Support { at: PointRef::Origin(ONE), directions, axes: FrameId::GROUND, on: None };
    model.connections.push(Connection {
        name: "A".into(),
        table: "supports",
        label: Text::default(),
        kind,
        unit: String::new(),
        span: 0..0,
    });
    let kind = ConnectionKind::Pin { between: [PointRef::Point(PointId(0)), PointRef::Origin(TWO)], axes: FrameId::GROUND };
    let equations = with(model, "pins", kind);
    assert_eq!(equations.balances.len(), 6);
    assert!(equations.reactions.iter().all(|r| matches!(r.law, Law::Support)));
    // on the left beam, which they share, the pin's force on the right one acts with the other sign
    let acting = |reaction: usize, row: usize| {
        let own = equations.reactions[reaction].released.iter().find(|own| own.0 == row);
        own.map_or(0.0, |own| equations.graph.evaluate(&[own.1], &|_| 0.0)[0])
    };
    for row in 0..6 {
        let found: Vec<f64> = (0..4).map(|reaction| acting(reaction, row)).collect();
        assert_eq!(found.iter().map(|c| c.abs()).sum::<f64>(), 2.0, "{row}: {found:?}");
        assert_eq!([found[0] + found[2], found[1] + found[3]], [0.0; 2], "{row}: {found:?}");
    }
}
