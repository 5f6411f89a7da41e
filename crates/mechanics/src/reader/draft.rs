//! What is read of a frame or truss so far: its tables refer to one another, and forces of the machine act on it too.

use crate::structure::{Load, Node, Rod};
use std::collections::HashMap;
use symbolic::Expr;

/// Nodes, rods and loads.
#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) nodes: Vec<Node>,
    pub(crate) node_index: HashMap<String, usize>,
    pub(crate) rods: Vec<Rod>,
    pub(crate) rod_index: HashMap<String, usize>,
    pub(crate) loads: Vec<Load>,
    /// Area and second moment by name.
    pub(crate) sections: HashMap<String, (Expr, Expr)>,
    /// I_x, I_y and I_xy about central axes, m⁴, of sections whose axes x, y are not principal.
    pub(crate) skew: HashMap<String, [f64; 3]>,
}
