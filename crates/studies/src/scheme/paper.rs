//! A sketch as the paper on which connections are drawn, layer by layer.

use super::sketched::Sketch;
use crate::connections::{self, Guide, Layer, Own, Pair, Paper, Rolls, Rope, Support};
use mechanics::model::PointRef;
use report::scheme::{Place, Rides, S};
use symbolic::Expr;

impl Sketch<'_> {
    /// What connections have on a layer.
    pub(super) fn layer(&mut self, layer: Layer) {
        let machine = self.machine;
        for connection in &machine.model.connections {
            connections::of(connection).draw(layer, &Own::of(connection), self);
        }
    }
}

impl Paper for Sketch<'_> {
    fn pin(&mut self, own: &Own, between: [PointRef; 2]) {
        self.pinned(&own.path, between);
    }
    fn weld(&mut self, own: &Own, between: [PointRef; 2]) {
        self.welded(&own.path, between);
    }
    fn guide(&mut self, own: &Own, guide: &Guide) {
        self.slider(&own.path, (guide.point, guide.on), guide.direction);
    }
    fn rod(&mut self, own: &Own, between: [PointRef; 2]) {
        self.bar(&own.path, between);
    }
    fn ends_of_rod(&mut self, own: &Own, between: [PointRef; 2]) {
        self.hinged_ends(&own.path, between);
    }
    fn rope(&mut self, own: &Own, rope: &Rope) {
        self.thread(&own.path, rope.path, rope.wound);
    }
    fn pair(&mut self, own: &Own, pair: &Pair) {
        self.tied_wheels(&own.path, pair);
    }
    fn track(&mut self, own: &Own, rolls: &Rolls) {
        self.rolled_on(&own.path, rolls);
    }
    fn support(&mut self, own: &Own, support: &Support) {
        self.supported(&own.path, support);
    }
    fn rubbed(&mut self, own: &Own, point: PointRef) {
        let at = self.seen(point);
        self.rides = Rides::along(self.group_of(point));
        self.put("slip_mark", &own.path, Place { at, size: 0.5 * S, ..Place::default() });
    }
    fn rubs_in(&mut self, own: &Own, connection: usize) {
        self.rubbing(&own.path, connection);
    }
    fn condition(&mut self, own: &Own, zero: Expr) {
        self.demanded(&own.path, zero);
    }
}
