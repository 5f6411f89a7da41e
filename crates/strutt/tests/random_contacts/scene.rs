//! Random plane scenes: blocks, wedges, discs, pendulums and sliders with up to six contacts, and the model file of each.

use std::fmt::Write;

/// Numbers between 0 and 1 (splitmix64).
pub struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 53) as f64
    }
    fn within(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.next()
    }
    fn one_of(&mut self, values: &[f64]) -> f64 {
        values[(self.next() * values.len() as f64) as usize % values.len()]
    }
}

/// How a body moves; its coordinates follow in this order.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// x, y, angle.
    Free { mass: f64, inertia: f64 },
    /// x, y.
    Shift { mass: f64 },
    /// Angle about a pivot; the centre is at `center` below it.
    Swing { mass: f64, inertia: f64, pivot: [f64; 2], center: f64 },
}

/// A body with its start and a spring on its first coordinate.
#[derive(Clone, Debug)]
pub struct Body {
    pub kind: Kind,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub spring: f64,
}

/// A disc (or a point, radius 0) of a body against a straight side, n the normal away from the side.
#[derive(Clone, Debug)]
pub struct Contact {
    pub body: usize,
    pub at: [f64; 2],
    pub radius: f64,
    /// Body that carries the side; none is the ground.
    pub on: Option<usize>,
    pub through: [f64; 2],
    pub normal: f64,
    pub restitution: f64,
    pub friction: f64,
    /// Speed of the side's surface along (n_y, -n_x).
    pub belt: f64,
}

/// How several contacts of an instant strike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Impacts {
    Together,
    InSequence,
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene {
    pub bodies: Vec<Body>,
    pub contacts: Vec<Contact>,
    pub until: f64,
    pub impacts: Impacts,
}

pub const GRAVITY: f64 = 9.81;
const UP: f64 = std::f64::consts::FRAC_PI_2;

impl Contact {
    fn ground(body: usize, at: [f64; 2], radius: f64) -> Contact {
        let through = [0.0, 0.0];
        Contact { body, at, radius, on: None, through, normal: UP, restitution: 0.0, friction: 0.0, belt: 0.0 }
    }
}

/// The scene of a number.
pub fn scene(seed: u64, impacts: Impacts) -> Scene {
    let mut r = Random(seed.wrapping_mul(0x0005_deec_e66d).wrapping_add(17));
    let scene = match seed % 5 {
        0 => block(&mut r, impacts),
        1 => disc_and_wedge(&mut r),
        2 => pendulum_and_block(&mut r, impacts),
        3 => discs(&mut r),
        _ => train(&mut r),
    };
    Scene { impacts, ..scene }
}

/// Restitution and friction of an eccentric contact: with both, Newton's rule may give energy, which the stepping notices in blows that follow one another only.
fn eccentric(r: &mut Random, impacts: Impacts) -> (f64, f64) {
    match (impacts, r.next() < 0.4) {
        (Impacts::InSequence, _) => (r.within(0.0, 0.6), r.within(0.0, 0.5)),
        (Impacts::Together, true) => (r.within(0.1, 0.6), 0.0),
        (Impacts::Together, false) => (0.0, r.within(0.1, 0.5)),
    }
}

/// A block thrown on a floor, perhaps a belt, beside a wall: four corners and two.
fn block(r: &mut Random, impacts: Impacts) -> Scene {
    let (a, b, mass) = (r.within(0.1, 0.4), r.within(0.1, 0.4), r.within(0.5, 3.0));
    let angle = r.within(-0.6, 0.6);
    let height = a * f64::abs(angle.sin()) + b * angle.cos() + r.within(0.01, 0.2);
    let kind = Kind::Free { mass, inertia: mass * (a * a + b * b) / 3.0 };
    let body =
        Body { kind, q: vec![0.0, height, angle], v: vec![r.within(-1.0, 2.0), r.within(-1.0, 0.5), r.within(-2.0, 2.0)], spring: 0.0 };
    let (restitution, friction) = eccentric(r, impacts);
    let belt = r.one_of(&[0.0, 0.0, 1.0, -0.7]);
    let corners = [[-a, -b], [a, -b], [a, b], [-a, b]];
    let mut contacts: Vec<Contact> =
        corners.iter().map(|at| Contact { restitution, friction, belt, ..Contact::ground(0, *at, 0.0) }).collect();
    let wall = r.within(0.7, 1.2);
    for at in [corners[1], corners[2]] {
        let side = Contact { through: [wall, 0.0], normal: 2.0 * UP, restitution, ..Contact::ground(0, at, 0.0) };
        contacts.push(side);
    }
    Scene { bodies: vec![body], contacts, until: 0.7, impacts: Impacts::Together }
}

/// A disc falls on the inclined side of a wedge that slides on the floor.
fn disc_and_wedge(r: &mut Random) -> Scene {
    let (radius, mass, slope) = (r.within(0.05, 0.2), r.within(0.5, 2.0), r.within(0.2, 0.8));
    let normal = UP + slope;
    let above = radius / slope.cos() + r.within(0.02, 0.3);
    let disc = Body {
        kind: Kind::Free { mass, inertia: 0.5 * mass * radius * radius },
        q: vec![0.0, 0.8 + above, 0.0],
        v: vec![r.within(-0.5, 0.5), r.within(-1.0, 0.0), r.within(-5.0, 5.0)],
        spring: 0.0,
    };
    let wedge = Body {
        kind: Kind::Shift { mass: r.within(1.0, 4.0) },
        q: vec![0.0, 0.0],
        v: vec![r.within(-0.5, 0.5), 0.0],
        spring: r.one_of(&[0.0, 80.0]),
    };
    let side = Contact {
        on: Some(1),
        through: [0.0, 0.8],
        normal,
        restitution: r.one_of(&[0.0, 0.3, 0.6]),
        friction: r.one_of(&[0.0, 0.2, 0.4]),
        ..Contact::ground(0, [0.0, 0.0], radius)
    };
    let floor = Contact { friction: r.one_of(&[0.0, 0.1, 0.3]), ..Contact::ground(1, [0.0, 0.0], 0.0) };
    let landing = Contact {
        restitution: r.one_of(&[0.0, 0.5]),
        friction: r.one_of(&[0.1, 0.5]),
        through: [0.0, -0.3],
        ..Contact::ground(0, [0.0, 0.0], radius)
    };
    Scene { bodies: vec![disc, wedge], contacts: vec![side, floor, landing], until: 0.6, impacts: Impacts::Together }
}

/// A pendulum swings against the side of a block on a rough floor or a belt.
fn pendulum_and_block(r: &mut Random, impacts: Impacts) -> Scene {
    let (length, mass) = (r.within(0.5, 1.0), r.within(0.5, 2.0));
    let swing = Body {
        kind: Kind::Swing { mass, inertia: mass * length * length / 3.0, pivot: [0.0, 1.3], center: 0.5 * length },
        q: vec![r.within(-1.2, -0.4)],
        v: vec![r.within(0.0, 3.0)],
        spring: r.one_of(&[0.0, 5.0]),
    };
    let (restitution, friction) = eccentric(r, impacts);
    let block = Body {
        kind: Kind::Shift { mass: r.within(0.5, 3.0) },
        q: vec![r.within(0.1, 0.3), 0.0],
        v: vec![r.within(-1.0, 0.5), 0.0],
        spring: r.one_of(&[0.0, 60.0]),
    };
    let touch = Contact { on: Some(1), normal: 2.0 * UP, restitution, friction, ..Contact::ground(0, [0.0, -length], 0.0) };
    let floor = Contact { friction: r.within(0.05, 0.5), belt: r.one_of(&[0.0, -0.8]), ..Contact::ground(1, [0.0, 0.0], 0.0) };
    let stop = Contact { through: [1.0, 0.0], normal: 2.0 * UP, restitution: r.within(0.0, 0.8), ..Contact::ground(1, [0.0, 0.0], 0.0) };
    let back = Contact { through: [-0.9, 0.0], normal: 0.0, restitution: r.within(0.0, 0.8), ..Contact::ground(0, [0.0, -length], 0.0) };
    Scene { bodies: vec![swing, block], contacts: vec![touch, floor, stop, back], until: 0.9, impacts: Impacts::Together }
}

/// Two discs on a rough floor or belt between rough walls, one of them on a spring.
fn discs(r: &mut Random) -> Scene {
    let mut bodies = Vec::new();
    let mut contacts = Vec::new();
    for k in 0..2 {
        let (radius, mass) = (r.within(0.05, 0.15), r.within(0.3, 2.0));
        bodies.push(Body {
            kind: Kind::Free { mass, inertia: r.within(0.3, 0.5) * mass * radius * radius },
            q: vec![1.5 * k as f64, radius + r.within(0.0, 0.4), 0.0],
            v: vec![r.within(-2.0, 2.0), r.within(-2.0, 1.0), r.within(-20.0, 20.0)],
            spring: r.one_of(&[0.0, 30.0]),
        });
        let own = |r: &mut Random| (r.one_of(&[0.0, 0.4, 0.7]), r.one_of(&[0.0, 0.1, 0.3, 0.5]));
        let (restitution, friction) = own(r);
        contacts.push(Contact { restitution, friction, belt: r.one_of(&[0.0, 1.0]), ..Contact::ground(k, [0.0, 0.0], radius) });
        for (normal, x) in [(0.0, -0.6), (2.0 * UP, 0.6)] {
            let (restitution, friction) = own(r);
            let through = [1.5 * k as f64 + x, 0.0];
            contacts.push(Contact { through, normal, restitution, friction, ..Contact::ground(k, [0.0, 0.0], radius) });
        }
    }
    Scene { bodies, contacts, until: 0.8, impacts: Impacts::Together }
}

/// Three sliders on a rough floor, each on a spring, that push each other and are dragged by a belt.
fn train(r: &mut Random) -> Scene {
    let mut bodies = Vec::new();
    let mut contacts = Vec::new();
    for k in 0..3 {
        bodies.push(Body {
            kind: Kind::Shift { mass: r.within(0.5, 2.0) },
            q: vec![0.4 * k as f64, 0.0],
            v: vec![r.within(-1.5, 1.5), 0.0],
            spring: r.within(20.0, 120.0),
        });
        let belt = r.one_of(&[0.0, 0.5, -0.5]);
        contacts.push(Contact { friction: r.within(0.05, 0.6), belt, ..Contact::ground(k, [0.0, 0.0], 0.0) });
        if k > 0 {
            let restitution = r.within(0.0, 0.9);
            contacts.push(Contact {
                on: Some(k - 1),
                through: [r.within(0.1, 0.35), 0.0],
                normal: 0.0,
                restitution,
                ..Contact::ground(k, [0.0, 0.0], 0.0)
            });
        }
    }
    let restitution = r.within(0.0, 0.9);
    contacts.push(Contact { through: [-0.4, 0.0], normal: 0.0, restitution, ..Contact::ground(0, [0.0, 0.0], 0.0) });
    Scene { bodies, contacts, until: 1.2, impacts: Impacts::Together }
}

/// Names of the coordinates of a body.
fn names(k: usize, body: &Body) -> Vec<String> {
    let letters: &[&str] = match body.kind {
        Kind::Free { .. } => &["x", "y", "f"],
        Kind::Shift { .. } => &["x", "y"],
        Kind::Swing { .. } => &["f"],
    };
    letters.iter().map(|letter| format!("{letter}{k}")).collect()
}

/// All coordinates, in the order of the bodies.
pub fn coordinates(scene: &Scene) -> Vec<String> {
    scene.bodies.iter().enumerate().flat_map(|(k, body)| names(k, body)).collect()
}

/// The model file.
pub fn write(scene: &Scene) -> String {
    let law = match scene.impacts {
        Impacts::Together => "together",
        Impacts::InSequence => "in sequence",
    };
    let mut text = format!("impacts = \"{law}\"\n");
    text.push_str("gravity = [0, \"-9.81 m/s^2\"]\n[coordinates]\n");
    for (k, body) in scene.bodies.iter().enumerate() {
        for (i, name) in names(k, body).iter().enumerate() {
            let unit = if name.starts_with('f') { "rad" } else { "m" };
            let _ = writeln!(text, "{name} = {{ unit = \"{unit}\", start = \"{} {unit}\", rate = \"{} {unit}/s\" }}", body.q[i], body.v[i]);
        }
    }
    for (k, body) in scene.bodies.iter().enumerate() {
        write_body(&mut text, k, body);
    }
    text.push_str("[points]\n");
    for (i, contact) in scene.contacts.iter().enumerate() {
        let [a, b] = contact.at;
        let _ = writeln!(text, "P{i} = {{ on = \"b{}\", at = [\"{a} m\", \"{b} m\"] }}", contact.body);
    }
    for (i, contact) in scene.contacts.iter().enumerate() {
        write_contact(&mut text, i, (contact, scene));
    }
    let _ = writeln!(text, "[[study]]\nkind = \"simulate\"\nuntil = \"{} s\"", scene.until);
    text
}

fn write_body(text: &mut String, k: usize, body: &Body) {
    let _ = writeln!(text, "[bodies.b{k}]");
    match body.kind {
        Kind::Free { mass, inertia } => {
            let _ = writeln!(text, "origin = [\"x{k}\", \"y{k}\"]\nangle = \"f{k}\"\nmass = \"{mass} kg\"\ninertia = \"{inertia} kg m^2\"");
        }
        Kind::Shift { mass } => {
            let _ = writeln!(text, "origin = [\"x{k}\", \"y{k}\"]\nmass = \"{mass} kg\"");
        }
        Kind::Swing { mass, inertia, pivot: [x, y], center } => {
            let about = inertia - mass * center * center;
            let _ = writeln!(
                text,
                "origin = [\"{x} m\", \"{y} m\"]\nangle = \"f{k}\"\nmass = \"{mass} kg\"\ncenter = [0, \"{} m\"]\ninertia = \"{about} kg m^2\"",
                -center
            );
        }
    }
    if body.spring > 0.0 {
        let (name, unit) = if matches!(body.kind, Kind::Swing { .. }) { (format!("f{k}"), "N m/rad") } else { (format!("x{k}"), "N/m") };
        let _ = writeln!(text, "[springs.c{k}]\nalong = \"{name}\"\nstiffness = \"{} {unit}\"", body.spring);
    }
}

/// Normal and tangent; a right angle is exact.
pub fn directions(normal: f64) -> ([f64; 2], [f64; 2]) {
    // a cosine of π/2 is rounding, and means zero
    let [c, s] = [normal.cos(), normal.sin()].map(|part| if part.abs() < 1e-12 { 0.0 } else { part });
    ([c, s], [s, -c])
}

/// n·(P - Q) >= radius; sliding along t = (n_y, -n_x), with the turning of the disc.
fn write_contact(text: &mut String, i: usize, (contact, scene): (&Contact, &Scene)) {
    let (n, t) = directions(contact.normal);
    let [px, py] = contact.through;
    let away = match contact.on {
        Some(b) => [format!("(x(P{i}) - x{b} - {px} [m])"), format!("(y(P{i}) - y{b} - {py} [m])")],
        None => [format!("(x(P{i}) - {px} [m])"), format!("(y(P{i}) - {py} [m])")],
    };
    let along = |d: [f64; 2]| format!("{}*({:e}) + {}*({:e})", away[0], d[0], away[1], d[1]);
    let _ = writeln!(
        text,
        "[stops.s{i}]\nalong = \"{}\"\nat_least = \"{} m\"\nrestitution = {}",
        along(n),
        contact.radius,
        contact.restitution
    );
    if contact.friction == 0.0 {
        return;
    }
    let turning = match scene.bodies[contact.body].kind {
        Kind::Free { .. } if contact.radius > 0.0 => format!(" + {} [m]*f{}", contact.radius, contact.body),
        _ => String::new(),
    };
    let belt = if contact.belt == 0.0 { String::new() } else { format!(" - ({} [m/s])*t", contact.belt) };
    let _ = writeln!(
        text,
        "[frictions.r{i}]\nalong = \"{}{turning}{belt}\"\ncoefficient = {}\nnormal = \"force(s{i})\"",
        along(t),
        contact.friction
    );
}
