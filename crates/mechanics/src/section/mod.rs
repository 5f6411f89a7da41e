//! Sections of rods: area, centroid and second moments of parts added and removed.
//!
//! Sums over the parts, exact: A = Σ ± A_i, the centroid from the static moments, I_x = Σ ± (I_xi + A_i (y_i - y_c)²) by the theorem of
//! Huygens and Steiner, I_xy = ∫ x y dA likewise. Principal axes: tan 2α = -2 I_xy / (I_x - I_y).

mod coverage;
mod explain;
mod moments;
mod outline;
mod part;
mod profiles;

pub use coverage::{Coverage, cover};
pub use explain::EXPLANATIONS;
pub use moments::{Form, Moments, of_form, together};
pub use outline::{Contours, Outline};
pub use part::Part;
pub use profiles::{Kind, Profile, find as find_profile, names as profile_names};

use algebra::elementary;
use std::ops::Range;
use symbolic::Expr;
use words::Text;

/// A section of the file.
#[derive(Clone, Debug)]
pub struct Section {
    /// Name.
    pub name: String,
    /// What it is; may be empty.
    pub label: Text,
    /// Parts in the order of the file.
    pub parts: Vec<Part>,
    /// Exact sums over the parts, over constant parameters.
    pub moments: Moments,
    /// The same in numbers, SI.
    pub properties: Properties,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

impl Section {
    /// Area as an expression over the parameters; `section = "NAME"` of a rod takes A from here.
    pub fn area(&self) -> Expr {
        self.moments.area
    }
    /// Second moment about the central axis x, for bending in the plane of the section's y.
    pub fn inertia(&self) -> Expr {
        self.moments.xx
    }
}

/// Geometric properties, SI. Second moments in m⁴.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Properties {
    /// Area.
    pub area: f64,
    /// Centroid.
    pub centroid: [f64; 2],
    /// Static moments about the given axes: ∫ y dA, ∫ x dA.
    pub first: [f64; 2],
    /// About the given axes: ∫ y² dA, ∫ x² dA, ∫ x y dA.
    pub given: [f64; 3],
    /// About the central axes parallel to them.
    pub central: [f64; 3],
    /// Principal: the largest and the smallest.
    pub principal: [f64; 2],
    /// Angle from x to the axis of the largest, -90° < α <= 90°, in rad; 0 when all central axes are principal.
    pub angle: f64,
    /// Radii of gyration about central x, y and the principal axes.
    pub radii: [f64; 4],
    /// Least section moduli about the same axes.
    pub moduli: [f64; 4],
    /// Least and largest x, least and largest y of the section.
    pub extents: [f64; 4],
}

/// A difference of the principal moments below this share of them is rounding: all axes are principal.
const ROUND: f64 = 1e-13;

impl Properties {
    /// From area, centroid and central moments; `reach(direction)` is how far the section goes from the origin along a unit vector.
    pub fn new(area: f64, centroid: [f64; 2], central: [f64; 3], reach: &dyn Fn([f64; 2]) -> f64) -> Properties {
        let ([x, y], [xx, yy, xy]) = (centroid, central);
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let radius = elementary::hypot(half, xy);
        let (largest, angle) = if radius <= ROUND * mean { (mean, 0.0) } else { (mean + radius, 0.5 * elementary::atan2(-xy, half)) };
        // the product of both is known without cancellation; shares of the largest keep it within the machine numbers
        let smallest = if radius <= ROUND * mean { mean } else { xx / largest * yy - xy / largest * xy };
        // -0 and -90 degrees are written as 0 and 90
        let angle = if angle <= -0.5 * std::f64::consts::PI { -angle } else { angle + 0.0 };
        // axes that lie in the given ones do so exactly: the cosine of a rounded right angle is not zero, and a long thin section would feel it
        let (s, c) = match xy {
            0.0 if angle == 0.0 => (0.0, 1.0),
            0.0 => (1.0, 0.0),
            _ => elementary::sin_cos(angle),
        };
        // farthest fibre on either side of an axis through the centroid along (a, b)
        let fibre = |[a, b]: [f64; 2]| {
            let side = |n: [f64; 2]| reach(n) - (n[0] * x + n[1] * y);
            side([-b, a]).max(side([b, -a]))
        };
        let moments = [xx, yy, largest, smallest];
        let fibres = [[1.0, 0.0], [0.0, 1.0], [c, s], [-s, c]].map(fibre);
        Properties {
            area,
            centroid,
            first: [area * y, area * x],
            given: [xx + area * y * y, yy + area * x * x, xy + area * x * y],
            central,
            principal: [largest, smallest],
            angle,
            radii: moments.map(|m| (m / area).sqrt()),
            moduli: std::array::from_fn(|k| moments[k] / fibres[k]),
            extents: [-reach([-1.0, 0.0]), reach([1.0, 0.0]), -reach([0.0, -1.0]), reach([0.0, 1.0])],
        }
    }
}
