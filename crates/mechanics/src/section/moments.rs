//! Area, centroid and central moments of single forms and of their sum, as expressions.

use super::profiles::Profile;
use symbolic::{Expr, Function, Graph, Rational};

/// A form in its own axes.
#[derive(Clone, Debug)]
pub enum Form {
    /// Width and height, centre at the origin.
    Rectangle(Expr, Expr),
    /// Radius, centre at the origin.
    Circle(Expr),
    /// Radius; the middle of the diameter is the origin, the disc lies above it.
    HalfDisc(Expr),
    /// Outer and inner radius, centre at the origin.
    Ring(Expr, Expr),
    /// Corners, counter-clockwise.
    Polygon(Vec<[Expr; 2]>),
    /// A rolled profile, centroid at the origin.
    Profile(&'static Profile),
}

/// Area, centroid, and second moments about the centroid: ∫ y², ∫ x², ∫ x y.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub struct Moments {
    pub area: Expr,
    pub x: Expr,
    pub y: Expr,
    pub xx: Expr,
    pub yy: Expr,
    pub xy: Expr,
}

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator, denominator).unwrap_or_else(|| Rational::from(0))
}

fn power(g: &mut Graph, base: Expr, exponent: i64) -> Expr {
    g.pow(base, &Rational::from(exponent))
}

/// The moments of a form in its own axes. *Source*: any table of plane sections; half disc: y_c = 4r/(3π), I_x = r⁴ (π/8 - 8/(9π)).
fn own(g: &mut Graph, form: &Form) -> Moments {
    let zero = g.zero();
    let centred = |area, xx, yy, xy| Moments { area, x: zero, y: zero, xx, yy, xy };
    match form {
        Form::Rectangle(b, h) => {
            let area = g.mul(*b, *h);
            let (h3, b3) = (power(g, *h, 3), power(g, *b, 3));
            let (xx, yy) = (g.mul(*b, h3), g.mul(*h, b3));
            centred(area, g.scale(xx, &ratio(1, 12)), g.scale(yy, &ratio(1, 12)), zero)
        }
        Form::Circle(r) => {
            let (area, moment) = disc(g, *r);
            centred(area, moment, moment, zero)
        }
        Form::Ring(outer, inner) => {
            let ((a, i), (a1, i1)) = (disc(g, *outer), disc(g, *inner));
            let moment = g.sub(i, i1);
            centred(g.sub(a, a1), moment, moment, zero)
        }
        Form::HalfDisc(r) => half_disc(g, *r),
        Form::Polygon(corners) => polygon(g, corners),
        Form::Profile(p) => {
            let [area, xx, yy, xy] = [&p.area, &p.xx, &p.yy, &p.xy].map(|v| g.number(v.clone()));
            centred(area, xx, yy, xy)
        }
    }
}

fn disc(g: &mut Graph, r: Expr) -> (Expr, Expr) {
    let (pi, r2, r4) = (g.pi(), g.square(r), power(g, r, 4));
    let moment = g.mul(pi, r4);
    (g.mul(pi, r2), g.scale(moment, &ratio(1, 4)))
}

fn half_disc(g: &mut Graph, r: Expr) -> Moments {
    let (whole, moment) = disc(g, r);
    let area = g.scale(whole, &ratio(1, 2));
    let pi = g.pi();
    let y = g.div(r, pi);
    let y = g.scale(y, &ratio(4, 3));
    let yy = g.scale(moment, &ratio(1, 2));
    let r4 = power(g, r, 4);
    let shift = g.div(r4, pi);
    let shift = g.scale(shift, &ratio(8, 9));
    Moments { area, x: g.zero(), y, xx: g.sub(yy, shift), yy, xy: g.zero() }
}

/// Sums over triangles from the first corner. *Source*: Green's theorem, as in C. Steger, On the calculation of arbitrary moments of
/// polygons, 1996.
fn polygon(g: &mut Graph, corners: &[[Expr; 2]]) -> Moments {
    let first = corners[0];
    let relative: Vec<[Expr; 2]> = corners.iter().map(|p| [g.sub(p[0], first[0]), g.sub(p[1], first[1])]).collect();
    let (mut area, mut sx, mut sy, mut xx, mut yy, mut xy) = (vec![], vec![], vec![], vec![], vec![], vec![]);
    for pair in relative[1..].windows(2) {
        let ([x0, y0], [x1, y1]) = (pair[0], pair[1]);
        let (left, right) = (g.mul(x0, y1), g.mul(x1, y0));
        let cross = g.sub(left, right);
        let square = |g: &mut Graph, a: Expr, b: Expr| {
            let terms = [g.square(a), g.mul(a, b), g.square(b)];
            g.sum(&terms)
        };
        area.push(cross);
        let (x, y) = (g.add(x0, x1), g.add(y0, y1));
        sx.push(g.mul(cross, y));
        sy.push(g.mul(cross, x));
        let (y2, x2) = (square(g, y0, y1), square(g, x0, x1));
        xx.push(g.mul(cross, y2));
        yy.push(g.mul(cross, x2));
        let own = [g.mul(x0, y0), g.mul(x1, y1)];
        let own = g.sum(&own);
        let own = g.scale(own, &Rational::from(2));
        let (a, b) = (g.mul(x0, y1), g.mul(x1, y0));
        let product = g.sum(&[a, b, own]);
        xy.push(g.mul(cross, product));
    }
    let mut total = |terms: Vec<Expr>, divisor: i64| {
        let sum = g.sum(&terms);
        g.scale(sum, &ratio(1, divisor))
    };
    let (area, sx, sy) = (total(area, 2), total(sx, 6), total(sy, 6));
    let (xx, yy, xy) = (total(xx, 12), total(yy, 12), total(xy, 24));
    let (x, y) = (g.div(sy, area), g.div(sx, area));
    let central = |g: &mut Graph, moment: Expr, a: Expr, b: Expr| {
        let shift = g.product(&[area, a, b]);
        g.sub(moment, shift)
    };
    let (xx, yy, xy) = (central(g, xx, y, y), central(g, yy, x, x), central(g, xy, x, y));
    Moments { area, x: g.add(x, first[0]), y: g.add(y, first[1]), xx, yy, xy }
}

/// The moments of a form turned by an angle and moved.
pub fn of_form(g: &mut Graph, form: &Form, at: [Expr; 2], angle: Expr) -> Moments {
    let m = own(g, form);
    if g.is_zero(angle) {
        return Moments { x: g.add(m.x, at[0]), y: g.add(m.y, at[1]), ..m };
    }
    let (c, s) = (g.call(Function::Cos, &[angle]), g.call(Function::Sin, &[angle]));
    let [cc, ss, cs] = [g.square(c), g.square(s), g.mul(c, s)];
    let combine = |g: &mut Graph, parts: [(Expr, Expr, i64); 3]| {
        let terms = parts.map(|(a, b, k)| {
            let product = g.mul(a, b);
            g.scale(product, &Rational::from(k))
        });
        g.sum(&terms)
    };
    let xx = combine(g, [(m.xx, cc, 1), (m.xy, cs, 2), (m.yy, ss, 1)]);
    let yy = combine(g, [(m.xx, ss, 1), (m.xy, cs, -2), (m.yy, cc, 1)]);
    let difference = g.sub(cc, ss);
    let xy = combine(g, [(m.yy, cs, 1), (m.xy, difference, 1), (m.xx, cs, -1)]);
    let zero = g.zero();
    let x = combine(g, [(m.x, c, 1), (m.y, s, -1), (zero, zero, 1)]);
    let y = combine(g, [(m.x, s, 1), (m.y, c, 1), (zero, zero, 1)]);
    Moments { area: m.area, x: g.add(x, at[0]), y: g.add(y, at[1]), xx, yy, xy }
}

/// The moments of all parts together; those with `true` are taken out.
pub fn together(g: &mut Graph, parts: &[(Moments, bool)]) -> Moments {
    if let [(single, false)] = parts {
        return *single;
    }
    let signed = |g: &mut Graph, value: fn(&mut Graph, &Moments) -> Expr| {
        let terms: Vec<Expr> = parts
            .iter()
            .map(|(m, removed)| {
                let term = value(g, m);
                if *removed { g.neg(term) } else { term }
            })
            .collect();
        g.sum(&terms)
    };
    let area = signed(g, |_, m| m.area);
    let sx = signed(g, |g, m| g.mul(m.area, m.y));
    let sy = signed(g, |g, m| g.mul(m.area, m.x));
    let (x, y) = (g.div(sy, area), g.div(sx, area));
    let moment = |g: &mut Graph, pick: fn(&Moments) -> [Expr; 3], centre: [Expr; 2]| {
        let terms: Vec<Expr> = parts
            .iter()
            .map(|(m, removed)| {
                let [own, a, b] = pick(m);
                let (a, b) = (g.sub(a, centre[0]), g.sub(b, centre[1]));
                let shift = g.product(&[m.area, a, b]);
                let term = g.add(own, shift);
                if *removed { g.neg(term) } else { term }
            })
            .collect();
        g.sum(&terms)
    };
    let xx = moment(g, |m| [m.xx, m.y, m.y], [y, y]);
    let yy = moment(g, |m| [m.yy, m.x, m.x], [x, x]);
    let xy = moment(g, |m| [m.xy, m.x, m.y], [x, y]);
    Moments { area, x, y, xx, yy, xy }
}
