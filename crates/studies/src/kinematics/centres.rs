//! Instantaneous centres of bodies as outputs of the machine.

use super::asked::Kinematics;
use crate::machine::Machine;
use crate::source::Source;
use analysis::Dataset;
use analysis::dataset::{Column, Missing};
use mechanics::model::Axis;
use words::Text;

/// Whether a frame turns about z only: a body that turns in space has no instantaneous centre, and its angular velocity is no number.
pub(super) fn turns_in_plane(machine: &Machine, frame: usize) -> bool {
    let mut here = frame;
    while here != 0 {
        let f = &machine.model.frames[here];
        let flat = f.rotations.iter().map(|(axis, _)| axis).chain(f.spin.as_ref().map(|(axis, _)| axis)).all(|axis| *axis == Axis::Z);
        if !flat {
            return false;
        }
        here = f.on.index();
    }
    true
}

/// The machine with what the instantaneous centres of its bodies follow from as outputs, under names that the file does not use.
pub(super) struct Centres {
    /// None when no centre is asked for, or the machine has none (in space).
    pub machine: Option<Machine>,
    /// Body, then the names of the outputs x, y, angular velocity.
    bodies: Vec<(String, [String; 3])>,
}

impl Centres {
    pub fn of(machine: &Machine, study: &Kinematics) -> Centres {
        let file = &machine.origin.source.text;
        let wanted = |body: &str| {
            let own = [format!("P_x_{body}"), format!("P_y_{body}"), format!("omega({body})")];
            let taken = own.iter().any(|name| machine.equations.outputs.iter().any(|o| o.name == *name));
            !taken && (study.outputs.is_empty() || study.outputs.iter().any(|o| own.contains(o)))
        };
        let frames = machine.model.frames.iter().enumerate().skip(1).filter(|(i, _)| turns_in_plane(machine, *i));
        let named = frames.map(|(_, f)| f.name.clone()).filter(|name| wanted(name));
        let mut prefix = "centre_of_".to_owned();
        while file.contains(&prefix) {
            prefix.push('_');
        }
        let bodies: Vec<_> = named.enumerate().map(|(i, body)| (body, ["x", "y", "w"].map(|what| format!("{prefix}{i}_{what}")))).collect();
        let mut text = file.clone();
        for (i, (body, [x, y, w])) in bodies.iter().enumerate() {
            let quoted = serde_json::Value::from(body.as_str()).to_string();
            text += &format!("\n[points.{prefix}{i}]\non = {quoted}\nat = [\"0\", \"0\"]\n");
            text += &format!("[outputs.{x}]\nvalue = \"x({prefix}{i}) - vy({prefix}{i})/omega({body})\"\n");
            text += &format!("[outputs.{y}]\nvalue = \"y({prefix}{i}) + vx({prefix}{i})/omega({body})\"\n");
            text += &format!("[outputs.{w}]\nvalue = \"omega({body})\"\n");
        }
        let source = Source { path: machine.origin.source.path.clone(), text };
        let built = if bodies.is_empty() { None } else { machine.again(source, machine.origin.overrides.clone()).ok() };
        let bodies = if built.is_some() { bodies } else { Vec::new() };
        Centres { machine: built, bodies }
    }

    /// Where a body does not turn its centre is at infinity: such values are none, and columns without any other are left out.
    pub fn state(&self, data: &mut Dataset) {
        for body in self.bodies.iter().map(|(body, _)| body) {
            let own = [format!("P_x_{body}"), format!("P_y_{body}")];
            // 0/0 beside a place at infinity is any number: a centre has both places or none
            let rows = data.columns.first().map_or(0, |c| c.values.len());
            for row in 0..rows {
                let mut pair: Vec<&mut f64> =
                    data.columns.iter_mut().filter(|c| own.contains(&c.quantity.name)).filter_map(|c| c.values.get_mut(row)).collect();
                if pair.iter().any(|value| value.is_nan()) {
                    pair.iter_mut().for_each(|value| **value = f64::NAN);
                }
            }
            let all = |c: &Column| own.contains(&c.quantity.name) && !c.values.is_empty() && c.values.iter().all(|v| v.is_nan());
            if data.columns.iter().any(all) {
                data.keep_columns(|c| !own.contains(&c.quantity.name));
                data.notes.push(Text::new(
                    format!("{} does not turn: its instantaneous centre is at infinity", self.told(body).0),
                    format!("{} движется поступательно: мгновенный центр скоростей бесконечно удалён", self.told(body).1),
                ));
            }
            for name in own {
                let words = Text::new("at infinity: the body does not turn here", "в бесконечности: тело здесь не вращается");
                data.state(&name, Missing::Absent, words);
            }
        }
    }

    /// The symbol of an output that is one of ours with the number of the body, where a label says what the body is.
    pub fn symbol(&self, output: &str) -> Option<String> {
        let (body, names) = self.bodies.iter().find(|(_, names)| names.iter().any(|n| n == output))?;
        let bodies = self.machine.iter().flat_map(|machine| &machine.model.frames).filter(|frame| frame.is_body);
        let (number, frame) = bodies.enumerate().find(|(_, frame)| frame.name == *body)?;
        let letter = ["P_x_", "P_y_", "ω_"][names.iter().position(|n| n == output)?];
        (!frame.label.en.is_empty()).then(|| format!("{letter}{}", number + 1))
    }

    /// What a body is, in both languages; its name where the file does not say.
    fn told(&self, body: &str) -> (String, String) {
        let frames = self.machine.iter().flat_map(|machine| &machine.model.frames);
        let label = frames.into_iter().find(|frame| frame.name == body).map(|frame| frame.label.clone()).unwrap_or_default();
        if label.en.is_empty() { (body.to_owned(), body.to_owned()) } else { (label.en, label.ru) }
    }

    /// Name, label and unit of an output that is one of ours; none for the user's.
    pub fn shown(&self, output: &str) -> Option<(String, Text)> {
        let (body, names) = self.bodies.iter().find(|(_, names)| names.iter().any(|n| n == output))?;
        let (en, ru) = self.told(body);
        let label = |axis: &str| {
            let ru = format!("мгновенный центр скоростей ({ru}), {axis}");
            Text::new(format!("instantaneous centre of velocity of {en}, {axis}"), ru)
        };
        Some(match names.iter().position(|n| n == output)? {
            0 => (format!("P_x_{body}"), label("x")),
            1 => (format!("P_y_{body}"), label("y")),
            _ => (format!("omega({body})"), Text::new(format!("angular velocity of {en}"), format!("угловая скорость ({ru})"))),
        })
    }
}
