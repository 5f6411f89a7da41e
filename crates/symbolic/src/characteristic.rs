//! The frequency equation det(C - z M) = 0 with exact coefficients.

use crate::{Graph, Matrix, Rational};

/// Larger systems have coefficients that nobody reads.
const LARGEST: usize = 12;

/// The coefficients of (-1)^n det(C - z M), beginning with the constant: primitive whole numbers, the highest positive.
///
/// None when an entry is not a rational number, M is singular, or there are more than twelve rows. Exact: the determinant is taken at
/// z = 0, 1, ... n, and the polynomial through these values is written out by divided differences.
pub fn characteristic(graph: &Graph, stiffness: &Matrix, mass: &Matrix) -> Option<Vec<Rational>> {
    let n = mass.rows();
    if n == 0 || n > LARGEST {
        return None;
    }
    let numbers = |m: &Matrix| m.entries().iter().map(|e| graph.as_number(*e).cloned()).collect::<Option<Vec<Rational>>>();
    let (c, m) = (numbers(stiffness)?, numbers(mass)?);
    let values: Vec<Rational> = (0..=n).map(|k| at(&c, &m, n, &Rational::from(k as i64))).collect();
    let coefficients = through(values);
    if coefficients[n].is_zero() {
        return None;
    }
    Some(primitive(coefficients))
}

/// det(C - z M).
fn at(c: &[Rational], m: &[Rational], n: usize, z: &Rational) -> Rational {
    let matrix = c.iter().zip(m).map(|(c, m)| c - &(m * z)).collect();
    determinant(matrix, n)
}

fn determinant(mut a: Vec<Rational>, n: usize) -> Rational {
    let mut product = Rational::ONE;
    for k in 0..n {
        let Some(pivot) = (k..n).find(|i| !a[i * n + k].is_zero()) else { return Rational::ZERO };
        if pivot != k {
            (0..n).for_each(|j| a.swap(k * n + j, pivot * n + j));
            product = -&product;
        }
        let Some(inverse) = a[k * n + k].recip() else { return Rational::ZERO };
        product = &product * &a[k * n + k];
        for i in k + 1..n {
            if a[i * n + k].is_zero() {
                continue;
            }
            let factor = &a[i * n + k] * &inverse;
            for j in k..n {
                let change = &factor * &a[k * n + j];
                a[i * n + j] = &a[i * n + j] - &change;
            }
        }
    }
    product
}

/// The polynomial with these values at 0, 1, 2, ...: Newton's form, multiplied out.
fn through(mut values: Vec<Rational>) -> Vec<Rational> {
    let n = values.len();
    for level in 1..n {
        for k in (level..n).rev() {
            let difference = &values[k] - &values[k - 1];
            values[k] = Rational::new(1, level as i64).map_or(Rational::ZERO, |share| &difference * &share);
        }
    }
    let mut polynomial = vec![Rational::ZERO; n];
    for k in (0..n).rev() {
        // polynomial = polynomial (z - k) + values[k]
        for j in (0..n).rev() {
            let shifted = if j > 0 { polynomial[j - 1].clone() } else { Rational::ZERO };
            polynomial[j] = &shifted - &(&polynomial[j] * &Rational::from(k as i64));
        }
        polynomial[0] = &polynomial[0] + &values[k];
    }
    polynomial
}

/// Divided by the common factor of all coefficients, the highest positive.
fn primitive(list: Vec<Rational>) -> Vec<Rational> {
    let content = list.iter().filter(|c| !c.is_zero()).fold(Rational::ZERO, |g, c| common(&g, &c.abs()));
    let highest = list.last().is_some_and(Rational::is_negative);
    let Some(factor) = content.recip() else { return list };
    let factor = if highest { -&factor } else { factor };
    list.iter().map(|c| c * &factor).collect()
}

/// The largest rational of which both are whole multiples, by Euclid's algorithm.
fn common(a: &Rational, b: &Rational) -> Rational {
    let (mut a, mut b) = (a.clone(), b.clone());
    while !b.is_zero() {
        let quotient = b.recip().map_or(Rational::ZERO, |inverse| (&a * &inverse).floor());
        let rest = &a - &(&b * &quotient);
        a = b;
        b = rest;
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(g: &mut Graph, n: usize, entries: &[(i64, i64)]) -> Matrix {
        let list: Vec<_> = entries.iter().map(|(a, b)| g.number(Rational::new(*a, *b).unwrap())).collect();
        Matrix::from_rows(&list.chunks(n).map(<[_]>::to_vec).collect::<Vec<_>>())
    }

    /// Three equal masses between four equal springs: (z - 2)(z² - 4 z + 2).
    #[test]
    fn chain_of_three() {
        let mut g = Graph::new();
        let c = matrix(&mut g, 3, &[(2, 1), (-1, 1), (0, 1), (-1, 1), (2, 1), (-1, 1), (0, 1), (-1, 1), (2, 1)]);
        let m = matrix(&mut g, 3, &[(1, 1), (0, 1), (0, 1), (0, 1), (1, 1), (0, 1), (0, 1), (0, 1), (1, 1)]);
        let found: Vec<i64> = characteristic(&g, &c, &m).unwrap().iter().map(|r| r.to_i64().unwrap()).collect();
        assert_eq!(found, [-4, 10, -6, 1]);
    }

    #[test]
    fn common_factor_of_fractions_goes() {
        let mut g = Graph::new();
        let c = matrix(&mut g, 2, &[(3, 7), (0, 1), (0, 1), (9, 5)]);
        let m = matrix(&mut g, 2, &[(6, 7), (0, 1), (0, 1), (3, 5)]);
        // (6 z - 3)(3 z - 9)/35
        let found: Vec<i64> = characteristic(&g, &c, &m).unwrap().iter().map(|r| r.to_i64().unwrap()).collect();
        assert_eq!(found, [3, -7, 2]);
    }
}
