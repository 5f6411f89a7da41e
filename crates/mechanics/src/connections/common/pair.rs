//! Two wheels on parallel axes and the line of their centres.

use super::axes::{across, common};
use super::component::Doubt;
use super::faults;
use crate::model::{Connection, ConnectionKind, FrameId, PointRef};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::requests::Resolver;
use crate::scene::wrench::Act;
use crate::scene::{Found, Scene, Vector};
use symbolic::Expr;
use words::Text;

/// Two wheels.
pub struct Pair {
    pub a: FrameId,
    pub b: FrameId,
    pub radii: [Expr; 2],
    pub opposite: bool,
    /// Common axis, ground components.
    pub axis: Vector,
}

/// The wheels of a connection, which have a common axis.
pub fn pair(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Option<Pair>> {
    let ConnectionKind::Wheels { between: [a, b], radii, opposite, .. } = &connection.kind else { return Ok(None) };
    let [ra, rb] = [radii[0], radii[1]].map(|e| resolver.resolve(scene, kinematics, e));
    let Some(axis) = common(scene, kinematics, [*a, *b]) else {
        return Err(faults::no_common_axis(scene.model, connection, [*a, *b]));
    };
    Ok(Some(Pair { a: *a, b: *b, radii: [ra?, rb?], opposite: *opposite, axis }))
}

pub fn label(connection: &Connection) -> Text {
    let name = &connection.name;
    match connection.table {
        "gears" => Text::new(format!("gears {name}, tangential force"), format!("зацепление {name}, окружное усилие")),
        "chains" => Text::new(format!("chain {name}, tension"), format!("цепь {name}, усилие")),
        _ => Text::new(format!("belt {name}, tension difference"), format!("ремень {name}, разность натяжений ветвей")),
    }
}

impl Pair {
    /// Factors of the turning of the first wheel, the second, and of what it counts from.
    pub fn factors(&self, scene: &mut Scene) -> [Expr; 3] {
        let [ra, rb] = self.radii;
        let of_a = if self.opposite { ra } else { scene.graph.neg(ra) };
        let sum = scene.graph.add(of_a, rb);
        [of_a, rb, scene.graph.neg(sum)]
    }

    /// The part of a frame's angular velocity about the common axis.
    pub fn turning(&self, scene: &mut Scene, kinematics: &Kinematics, frame: FrameId) -> Expr {
        let columns = kinematics.turning_in_ground_axes(scene, frame);
        let w = combine(scene, &columns);
        scene.dot(&self.axis, &w)
    }
}

/// Distance of pitch circles that counts as rounding of what the file gives, relative to the radii.
const MESH: f64 = 1e-6;

/// To seven digits, as far as a message needs them.
fn rounded(x: f64) -> f64 {
    format!("{x:.6e}").parse().unwrap_or(x)
}

/// The line of centres.
pub struct Line {
    /// The place on the first wheel's axis opposite the second wheel.
    pub foot: Vector,
    /// u.
    pub between: Vector,
    /// u².
    pub square: Expr,
    /// e × u / u².
    pub lever: Vector,
    /// ω_l.
    pub rate: Expr,
}

impl Line {
    /// None when the centres coincide.
    pub fn new(scene: &mut Scene, kinematics: &Kinematics, pair: &Pair) -> Option<Line> {
        let (oa, ob) = (kinematics.frames[pair.a.index()].origin, kinematics.frames[pair.b.index()].origin);
        let between = scene.minus(&ob, &oa);
        let between = across(scene, &between, &pair.axis);
        let square = scene.dot(&between, &between);
        let square = scene.tidy(square);
        if scene.vanishes(square) {
            return None;
        }
        let foot = scene.minus(&ob, &between);
        let lever = scene.cross(&pair.axis, &between).map(|e| scene.graph.div(e, square));
        let speed = scene.total_vector(between);
        let rate = scene.dot(&lever, &speed);
        let rate = scene.tidy(rate);
        Some(Line { foot, between, square, lever, rate })
    }

    /// Whether pitch circles at a constant distance touch, as the numbers of the model are.
    pub fn meshes(&self, scene: &mut Scene, connection: &Connection, pair: &Pair) -> Found<()> {
        let rate = scene.total(self.square);
        let rate = scene.tidy(rate);
        if !scene.vanishes(rate) {
            return Ok(());
        }
        let [square, ra, rb] = scene.at_numbers([self.square, pair.radii[0], pair.radii[1]]);
        let (formula, radii) = if pair.opposite { ("r1 + r2", ra + rb) } else { ("|r1 − r2|", (ra - rb).abs()) };
        let axes = square.sqrt();
        // numbers that are not there, of unknowns for example, decide nothing
        if (axes - radii).abs() > MESH * axes.max(ra + rb) {
            return Err(faults::no_mesh(connection, rounded(axes), (formula, rounded(radii))));
        }
        Ok(())
    }

    /// The doubt that the distance of the axes changes.
    pub fn change(&self, scene: &mut Scene, connection: &Connection) -> Option<Doubt> {
        let rate = scene.total(self.square);
        let rate = scene.tidy(rate);
        (!scene.vanishes(rate)).then(|| Doubt { rate, fault: *faults::axes_part(connection) })
    }

    /// Condition and actions that count from the line.
    pub fn drive(&self, scene: &mut Scene, kinematics: &Kinematics, pair: &Pair) -> (Expr, Vec<Act>) {
        let [of_a, of_b, of_line] = pair.factors(scene);
        let turning = [pair.a, pair.b].map(|f| pair.turning(scene, kinematics, f));
        let terms = [scene.graph.mul(of_a, turning[0]), scene.graph.mul(of_b, turning[1]), scene.graph.mul(of_line, self.rate)];
        (scene.graph.sum(&terms), self.acts(scene, pair))
    }

    /// Moments on the wheels, and the forces across the line of centres that go with them: those of teeth, or of the strands of a belt less what they pull
    /// along the line.
    pub fn acts(&self, scene: &mut Scene, pair: &Pair) -> Vec<Act> {
        let [of_a, of_b, of_line] = pair.factors(scene);
        let force = self.lever.map(|e| scene.graph.mul(of_line, e));
        let against = force.map(|e| scene.graph.neg(e));
        let moments = [of_a, of_b].map(|factor| pair.axis.map(|e| scene.graph.mul(factor, e)));
        vec![
            Act::Turn { on: pair.a, moment: moments[0] },
            Act::Turn { on: pair.b, moment: moments[1] },
            Act::Point { point: PointRef::Origin(pair.b), force },
            Act::Place { on: pair.a, at: self.foot, force: against },
        ]
    }
}
