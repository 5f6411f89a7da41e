//! Rows of numbers, one of each lane.

use super::layout::{Layout, Row};
use algebra::simd::Lanes;

/// Motions beside each other.
pub const LANES: usize = 8;

/// Sides that the lanes take, by guard.
#[derive(Clone, Debug, Default)]
pub(super) struct Modes(pub(super) Vec<[u8; LANES]>);

impl Modes {
    /// In each lane what its side gives.
    #[inline(always)]
    pub(super) fn chosen<'a>(&self, guard: u32, sides: &[Row; 3], at: impl Fn(Row) -> &'a Lanes) -> Lanes {
        let modes = &self.0[guard as usize];
        let [a, b, c] = sides.map(at);
        std::array::from_fn(|lane| match modes[lane] {
            0 => a[lane],
            1 => b[lane],
            _ => c[lane],
        })
    }
}

/// The series of all lanes as they stand.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) layout: &'a Layout,
    pub(super) numbers: &'a [Lanes],
    pub(super) modes: &'a Modes,
    pub(super) cells: &'a [Lanes],
    /// Coefficients of a row.
    pub(super) stride: usize,
}

impl<'a> View<'a> {
    /// The coefficients of a row.
    #[inline(always)]
    pub(super) fn row(&self, row: Row) -> &'a [Lanes] {
        &self.cells[row as usize * self.stride..(row as usize + 1) * self.stride]
    }
}
