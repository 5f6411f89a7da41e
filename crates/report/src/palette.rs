//! What figures and schemes are written with: fonts and greys of lines.

/// Fonts by preference; the first is the one that PNG files carry.
pub(crate) const FONTS: &str = "DejaVu Sans, Verdana, Segoe UI, Arial, sans-serif";
/// Lines and letters.
pub(crate) const INK: &str = "#1a1a1a";
/// Lines behind the curves.
pub(crate) const GRID: &str = "#e2e2e2";
