//! What a plan is made of: rows of coefficients and operations on them. The recurrences themselves stand in `recurrences.rs`.

use crate::Unary;

/// Number of a row.
pub(crate) type Row = u32;

/// One operation on rows.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// c_k = a_k
    Copy { row: Row, a: Row },
    /// c_k = factor a_k (+ constant at order 0)
    Scale { row: Row, constant: f64, factor: f64, a: Row },
    /// c_k = Σ factor a_k (+ constant at order 0)
    Linear { row: Row, constant: f64, start: u32, end: u32 },
    /// c_k = Σ a_j b_{k-j}
    Multiply { row: Row, a: Row, b: Row },
    /// c_k = Σ a_j a_{k-j}
    Square { row: Row, a: Row },
    /// a = c b gives c_k = (a_k - Σ_{j<k} c_j b_{k-j})/b_0
    Divide { row: Row, a: Row, b: Row },
    /// a = c c gives c_k = (a_k - Σ_{0<j<k} c_j c_{k-j})/(2 c_0)
    SquareRoot { row: Row, a: Row },
    /// c' a = p a' c gives k a_0 c_k = p Σ_{j=1}^{k} j a_j c_{k-j} - Σ_{j=1}^{k-1} j c_j a_{k-j}
    Power { row: Row, a: Row, p: f64, weighted: Row },
    /// c' = a' c gives k c_k = Σ_{j=1}^{k} j a_j c_{k-j}
    Exp { row: Row, a: Row, weighted: Row },
    /// s' = a' c, c' = sign a' s: sine and cosine with sign -1, the hyperbolic pair with sign 1
    SinCos { row: Row, a: Row, weighted: Row, sign: f64 },
    /// c' = a' u, u = 1 + sign c²: tangent with sign 1, hyperbolic tangent with sign -1
    Tangent { row: Row, a: Row, helper: Row, sign: f64 },
    /// c' u = ±a' gives k u_0 c_k = ±k a_k - Σ_{j=1}^{k-1} j c_j u_{k-j}, where u = a for log, 1 + a² for atan, √(1 - a²) for asin, acos
    Inverse { row: Row, a: Row, f: Unary, helper: Row },
    /// c' (x² + y²) = x y' - y x'
    Atan2 { row: Row, y: Row, x: Row, helper: Row },
    /// Σ_j (M_j a_{k-j}) = h_k gives M_0 a_k = h_k - Σ_{j=1}^{k} M_j a_{k-j}
    Solve { row: Row, system: u32 },
    /// The same with a matrix of any kind
    System { row: Row, system: u32 },
}

/// Coefficients of rows and the step they are taken over.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'m> {
    pub(crate) cells: &'m [f64],
    /// Distance of the beginnings of rows.
    pub(crate) stride: usize,
    /// Coefficients 0..count are valid in every row.
    pub(crate) count: usize,
}

impl<'m> Rows<'m> {
    pub(super) fn row(self, row: Row) -> &'m [f64] {
        let start = row as usize * self.stride;
        &self.cells[start..start + self.count]
    }
}
