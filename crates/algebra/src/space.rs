//! Vectors of space.

/// A vector by its components.
pub type Vector = [f64; 3];

/// a × b.
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a - b.
pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a·b.
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Length.
pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_stands_across_both() {
        let (a, b) = ([1.0, 2.0, 3.0], [-2.0, 0.5, 4.0]);
        let c = cross(a, b);
        assert_eq!((dot(a, c), dot(b, c)), (0.0, 0.0));
        assert_eq!(minus([0.0; 3], cross(b, a)), c);
        // |a x b|^2 + (a.b)^2 = |a|^2 |b|^2 in whole numbers and quarters
        assert_eq!(dot(c, c) + dot(a, b) * dot(a, b), dot(a, a) * dot(b, b));
        assert_eq!(norm([2.0, -3.0, 6.0]), 7.0);
    }
}
