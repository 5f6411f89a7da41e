//! Outlines of parts: contours as polygons for drawing and for the check of overlaps, and exact reach in a direction.

use super::profiles::{Kind, Profile};
use algebra::elementary;
use std::f64::consts::PI;

/// Closed polygons; what lies inside an odd number of them belongs to the part.
pub type Contours = Vec<Vec<[f64; 2]>>;

/// Sides of the polygon drawn for a circle. Its area is short by 2π²/(3 n²) = 5e-5.
pub const SIDES: usize = 360;

/// The outline of a part.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// Contours; circles as polygons inscribed.
    pub contours: Contours,
    /// Full circles (centre, radius) and half circles with the direction of their middle: the exact curves behind the polygons.
    arcs: Vec<([f64; 2], f64, Option<[f64; 2]>)>,
    /// Corners.
    corners: Vec<[f64; 2]>,
}

fn circle(radius: f64) -> Vec<[f64; 2]> {
    (0..SIDES).map(|k| 2.0 * PI * k as f64 / SIDES as f64).map(|a| [radius * elementary::cos(a), radius * elementary::sin(a)]).collect()
}

impl Outline {
    /// A polygon.
    pub fn polygon(corners: Vec<[f64; 2]>) -> Outline {
        Outline { contours: vec![corners.clone()], arcs: Vec::new(), corners }
    }
    /// A disc with a hole, or without one (radius 0).
    pub fn ring(outer: f64, inner: f64) -> Outline {
        let mut contours = vec![circle(outer)];
        if inner > 0.0 {
            contours.push(circle(inner));
        }
        Outline { contours, arcs: vec![([0.0; 2], outer, None)], corners: Vec::new() }
    }
    /// The upper half of a disc.
    pub fn half_disc(radius: f64) -> Outline {
        let half =
            (0..=SIDES / 2).map(|k| 2.0 * PI * k as f64 / SIDES as f64).map(|a| [radius * elementary::cos(a), radius * elementary::sin(a)]);
        Outline {
            contours: vec![half.collect()],
            arcs: vec![([0.0; 2], radius, Some([0.0, 1.0]))],
            corners: vec![[-radius, 0.0], [radius, 0.0]],
        }
    }
    /// A rolled profile with its centroid at the origin, fillets of `sides` pieces each.
    pub fn profile(p: &Profile, sides: usize) -> Outline {
        let [h, b, s, t, inner, toe] = p.sizes;
        let overhang = if p.kind == Kind::Beam { (b - s) / 2.0 } else { b - s };
        // the flange has its nominal thickness in the middle of the overhang
        let (thick, thin) = (t + p.slope * overhang / 2.0, t - p.slope * overhang / 2.0);
        let top = h / 2.0;
        let mirrored = |half: Vec<([f64; 2], f64)>| -> Vec<([f64; 2], f64)> {
            half.iter().copied().chain(half.iter().rev().map(|&([x, y], r)| ([x, -y], r))).collect()
        };
        let corners = match p.kind {
            Kind::Beam => {
                let right = mirrored(vec![([b / 2.0, top], 0.0), ([b / 2.0, top - thin], toe), ([s / 2.0, top - thick], inner)]);
                right.iter().copied().chain(right.iter().rev().map(|&([x, y], r)| ([-x, y], r))).collect()
            }
            Kind::Channel => {
                mirrored(vec![([-p.z0, top], 0.0), ([b - p.z0, top], 0.0), ([b - p.z0, top - thin], toe), ([s - p.z0, top - thick], inner)])
            }
            Kind::Angle => {
                let (o, e, i) = (-p.z0, b - p.z0, s - p.z0);
                vec![([o, o], 0.0), ([e, o], 0.0), ([e, i], toe), ([i, i], inner), ([i, e], toe), ([o, e], 0.0)]
            }
        };
        Outline::polygon(filleted(&corners, sides))
    }

    /// Whether the outline is curved, so that its polygon is a little smaller.
    pub fn curved(&self) -> bool {
        !self.arcs.is_empty()
    }

    /// Turned, then moved.
    pub fn placed(&self, at: [f64; 2], angle: f64) -> Outline {
        let (s, c) = if angle == 0.0 { (0.0, 1.0) } else { elementary::sin_cos(angle) };
        let turn = |[x, y]: [f64; 2]| [x * c - y * s, x * s + y * c];
        let place = |p: [f64; 2]| {
            let [x, y] = turn(p);
            [x + at[0], y + at[1]]
        };
        Outline {
            contours: self.contours.iter().map(|contour| contour.iter().map(|p| place(*p)).collect()).collect(),
            arcs: self.arcs.iter().map(|(m, r, middle)| (place(*m), *r, middle.map(turn))).collect(),
            corners: self.corners.iter().map(|p| place(*p)).collect(),
        }
    }

    /// Places that can be farthest in a direction (unit vector), measured along it: corners and the tops of arcs.
    pub fn candidates(&self, direction: [f64; 2]) -> impl Iterator<Item = f64> + '_ {
        let dot = move |p: [f64; 2]| p[0] * direction[0] + p[1] * direction[1];
        let tops = self.arcs.iter().flat_map(move |(m, r, middle)| {
            let on = |sign: f64| middle.is_none_or(|d| sign * dot(d) >= 0.0).then_some(dot(*m) + sign * r);
            [on(1.0), on(-1.0)]
        });
        self.corners.iter().map(move |p| dot(*p)).chain(tops.flatten())
    }

    /// How far the outline goes in a direction.
    pub fn reach(&self, direction: [f64; 2]) -> f64 {
        self.candidates(direction).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Area, centroid and central moments of the polygons (the first counted, the others as holes): what is drawn, not what is computed with.
    pub fn polygon_moments(&self) -> (f64, [f64; 2], [f64; 3]) {
        let mut sums = [0.0; 6];
        for (i, contour) in self.contours.iter().enumerate() {
            let own = green(contour);
            let sign = own[0].signum() * if i == 0 { 1.0 } else { -1.0 };
            sums.iter_mut().zip(own).for_each(|(s, v)| *s += sign * v);
        }
        let [area, sx, sy, xx, yy, xy] = sums;
        let (x, y) = (sy / area, sx / area);
        (area, [x, y], [xx - area * y * y, yy - area * x * x, xy - area * x * y])
    }
}

/// Area, ∫ y, ∫ x, ∫ y², ∫ x², ∫ x y, with the sign of the direction.
fn green(contour: &[[f64; 2]]) -> [f64; 6] {
    let mut sums = [0.0; 6];
    for (k, &[x0, y0]) in contour.iter().enumerate() {
        let [x1, y1] = contour[(k + 1) % contour.len()];
        let cross = x0 * y1 - x1 * y0;
        let terms = [
            cross / 2.0,
            cross * (y0 + y1) / 6.0,
            cross * (x0 + x1) / 6.0,
            cross * (y0 * y0 + y0 * y1 + y1 * y1) / 12.0,
            cross * (x0 * x0 + x0 * x1 + x1 * x1) / 12.0,
            cross * (x0 * y1 + 2.0 * x0 * y0 + 2.0 * x1 * y1 + x1 * y0) / 24.0,
        ];
        sums.iter_mut().zip(terms).for_each(|(s, t)| *s += t);
    }
    sums
}

/// Corners rounded by their radii.
fn filleted(corners: &[([f64; 2], f64)], sides: usize) -> Vec<[f64; 2]> {
    let n = corners.len();
    let mut out = Vec::new();
    for (k, &([x, y], radius)) in corners.iter().enumerate() {
        if radius == 0.0 {
            out.push([x, y]);
            continue;
        }
        let unit = |[a, b]: [f64; 2]| {
            let length = elementary::hypot(a - x, b - y);
            [(a - x) / length, (b - y) / length]
        };
        let (u, v) = (unit(corners[(k + n - 1) % n].0), unit(corners[(k + 1) % n].0));
        let half = 0.5 * elementary::acos((u[0] * v[0] + u[1] * v[1]).clamp(-1.0, 1.0));
        let (along, centre) = (radius / elementary::tan(half), radius / elementary::sin(half));
        let length = elementary::hypot(u[0] + v[0], u[1] + v[1]);
        let (cx, cy) = (x + (u[0] + v[0]) / length * centre, y + (u[1] + v[1]) / length * centre);
        let start = elementary::atan2(y + u[1] * along - cy, x + u[0] * along - cx);
        let end = elementary::atan2(y + v[1] * along - cy, x + v[0] * along - cx);
        let turn = (end - start + PI).rem_euclid(2.0 * PI) - PI;
        let point = |i: usize| {
            let a = start + turn * i as f64 / sides as f64;
            [cx + radius * elementary::cos(a), cy + radius * elementary::sin(a)]
        };
        out.extend((0..=sides).map(point));
    }
    out
}
