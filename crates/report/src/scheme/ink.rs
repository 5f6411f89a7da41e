//! Strokes: what symbols draw with. Three weights, three fillings; every stroke knows points along itself, so that labels can keep away from it.

use std::f64::consts::TAU;

/// A point of the picture.
pub type P = [f64; 2];

/// Weight of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// Links and shafts.
    Link,
    /// Parts of symbols.
    Part,
    /// Hatching, axes, pitch circles, dimensions.
    Thin,
}

/// What is inside an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// Nothing: what is behind is seen.
    None,
    /// The colour of the paper: it hides what is behind.
    Paper,
    /// A light grey.
    Tint,
    /// The colour of the lines.
    Ink,
}

/// The outline of a stroke.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Straight pieces.
    Way(Vec<P>),
    /// A closed outline.
    Loop(Vec<P>),
    /// A circle.
    Circle(P, f64),
    /// A part of a circle: centre, radius, from and to, counter-clockwise when `to` is larger.
    Arc(P, f64, [f64; 2]),
}

/// A stroke.
#[derive(Clone, Debug)]
pub struct Stroke {
    /// Its outline.
    pub shape: Shape,
    /// Weight of the line.
    pub weight: Weight,
    /// What is inside.
    pub fill: Fill,
    /// Whether it is a line of dashes and dots.
    pub dashed: bool,
}

/// Strokes of symbols.
#[derive(Clone, Debug, Default)]
pub struct Ink {
    /// In the order in which they are drawn.
    pub strokes: Vec<Stroke>,
}

impl Ink {
    fn stroke(&mut self, shape: Shape, weight: Weight, fill: Fill) -> &mut Stroke {
        let at = self.strokes.len();
        self.strokes.push(Stroke { shape, weight, fill, dashed: false });
        &mut self.strokes[at]
    }

    /// Straight pieces.
    pub fn way(&mut self, weight: Weight, points: &[P]) {
        self.stroke(Shape::Way(points.to_vec()), weight, Fill::None);
    }

    /// The same in dashes and dots.
    pub fn dashes(&mut self, weight: Weight, points: &[P]) {
        self.stroke(Shape::Way(points.to_vec()), weight, Fill::None).dashed = true;
    }

    /// A closed outline.
    pub fn outline(&mut self, weight: Weight, fill: Fill, points: &[P]) {
        self.stroke(Shape::Loop(points.to_vec()), weight, fill);
    }

    /// A circle.
    pub fn circle(&mut self, weight: Weight, fill: Fill, (center, radius): (P, f64)) {
        self.stroke(Shape::Circle(center, radius), weight, fill);
    }

    /// A circle in dashes and dots.
    pub fn pitch_circle(&mut self, (center, radius): (P, f64)) {
        self.stroke(Shape::Circle(center, radius), Weight::Thin, Fill::None).dashed = true;
    }

    /// A part of a circle.
    pub fn arc(&mut self, weight: Weight, (center, radius): (P, f64), angles: [f64; 2]) {
        self.stroke(Shape::Arc(center, radius, angles), weight, Fill::None);
    }

    /// The head of an arrow with its tip there, in a direction.
    pub fn head(&mut self, tip: P, direction: f64, size: f64) {
        let local = Local::new(tip, direction);
        let points = [tip, local.at(-size, size * 0.3), local.at(-size * 0.78, 0.0), local.at(-size, -size * 0.3)];
        self.stroke(Shape::Loop(points.to_vec()), Weight::Thin, Fill::Ink);
    }

    /// A straight line with hatching at 45° on its right side.
    pub fn hatched(&mut self, from: P, to: P) {
        self.way(Weight::Part, &[from, to]);
        self.hatching(from, to);
    }

    /// Hatching alone, on the right side of the line.
    pub fn hatching(&mut self, from: P, to: P) {
        const STEP: f64 = 6.5;
        const DEEP: f64 = 7.5;
        let length = distance(from, to);
        let local = Local::new(from, direction(from, to));
        let n = ((length - 2.0) / STEP).floor().max(1.0) as usize;
        let first = (length - (n - 1) as f64 * STEP) / 2.0;
        for i in 0..n {
            let x = first + i as f64 * STEP;
            self.way(Weight::Thin, &[local.at(x + 2.0, 0.0), local.at(x + 2.0 - DEEP, -DEEP)]);
        }
    }
}

impl Stroke {
    /// The outline as straight pieces, as many for every size, and whether it is closed.
    pub fn polyline(&self) -> (Vec<P>, bool) {
        const PIECES: usize = 28;
        let turned = |center: P, radius: f64, [from, to]: [f64; 2]| {
            (0..=PIECES).map(|i| polar(center, radius, from + (to - from) * i as f64 / PIECES as f64)).collect()
        };
        match &self.shape {
            Shape::Way(points) => (points.clone(), false),
            Shape::Loop(points) => (points.clone(), true),
            Shape::Circle(center, radius) => (turned(*center, *radius, [0.0, TAU]), true),
            Shape::Arc(center, radius, angles) => (turned(*center, *radius, *angles), false),
        }
    }

    /// Points along the stroke, close enough for a label to keep away.
    pub fn points(&self) -> Vec<P> {
        match &self.shape {
            Shape::Way(points) => sampled(points.iter().copied()),
            Shape::Loop(points) => sampled(points.iter().copied().chain(points.first().copied())),
            Shape::Circle(center, radius) => around(*center, *radius, [0.0, TAU]),
            Shape::Arc(center, radius, angles) => around(*center, *radius, *angles),
        }
    }
}

fn sampled(points: impl Iterator<Item = P>) -> Vec<P> {
    const STEP: f64 = 5.0;
    let mut out: Vec<P> = Vec::new();
    for p in points {
        if let Some(&last) = out.last() {
            let n = (distance(last, p) / STEP).ceil().clamp(1.0, 400.0) as usize;
            out.extend((1..n).map(|i| between(last, p, i as f64 / n as f64)));
        }
        out.push(p);
    }
    out
}

fn around(center: P, radius: f64, [from, to]: [f64; 2]) -> Vec<P> {
    let n = ((to - from).abs() * radius / 5.0).ceil().clamp(8.0, 400.0);
    (0..=n as usize).map(|i| polar(center, radius, from + (to - from) * i as f64 / n)).collect()
}

/// The point at a distance from a centre in a direction.
pub fn polar(center: P, radius: f64, angle: f64) -> P {
    [center[0] + radius * angle.cos(), center[1] - radius * angle.sin()]
}

/// Distance of two points.
pub fn distance(a: P, b: P) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// Direction from a to b.
pub fn direction(a: P, b: P) -> f64 {
    if distance(a, b) == 0.0 { 0.0 } else { (a[1] - b[1]).atan2(b[0] - a[0]) }
}

/// The point that divides a and b.
pub fn between(a: P, b: P, share: f64) -> P {
    [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share]
}

/// Where a thread from a point touches a drum that winds it in when it turns counter-clockwise (`sense` 1) or clockwise (-1): the rim nearest to a point inside.
pub fn tangent(center: P, radius: f64, (from, sense): (P, f64)) -> P {
    let d = distance(center, from);
    let off = if d <= radius { 0.0 } else { (radius / d).acos() };
    // the rim goes from the point to the drum there: (turn × (rim - centre)) · (rim - point) > 0
    polar(center, radius, direction(center, from) + sense * off)
}

/// Axes of a symbol: x along its direction, y to the left of it.
#[derive(Clone, Copy, Debug)]
pub struct Local {
    origin: P,
    sine: f64,
    cosine: f64,
}

impl Local {
    /// Axes at a place in a direction.
    pub fn new(origin: P, turn: f64) -> Local {
        Local { origin, sine: turn.sin(), cosine: turn.cos() }
    }

    /// A place given in these axes.
    pub fn at(&self, x: f64, y: f64) -> P {
        [self.origin[0] + x * self.cosine - y * self.sine, self.origin[1] - x * self.sine - y * self.cosine]
    }

    /// A rectangle about the origin.
    pub fn block(&self, half_width: f64, half_height: f64) -> [P; 4] {
        let (w, h) = (half_width, half_height);
        [self.at(-w, -h), self.at(w, -h), self.at(w, h), self.at(-w, h)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_leaves_a_drum_where_its_turn_winds_it_in() {
        for from in [[90.0, 10.0], [-70.0, 40.0], [5.0, -120.0]] {
            for sense in [1.0, -1.0] {
                let (center, radius) = ([3.0, -4.0], 20.0);
                let rim = tangent(center, radius, (from, sense));
                let along = [rim[0] - from[0], rim[1] - from[1]];
                let arm = [rim[0] - center[0], rim[1] - center[1]];
                // y points downwards: counter-clockwise as seen a point of the rim goes along (arm_y, -arm_x)
                let velocity = [sense * arm[1], -sense * arm[0]];
                // rounding of lengths of some hundred
                assert!((arm[0] * along[0] + arm[1] * along[1]).abs() < 1e-9, "no tangent");
                assert!(velocity[0] * along[0] + velocity[1] * along[1] > 0.0, "{from:?} {sense}: it winds off");
            }
        }
    }
}
