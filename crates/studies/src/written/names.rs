//! What bodies, points, elements and connections are called in sentences: by their label, else by what they are and a number.

use super::work::Work;
use crate::connections::Teller;
use crate::naming::is_word;
use mechanics::model::{Connection, Element, Frame, FrameId, PointRef};

impl Teller for Work<'_> {
    fn point(&self, point: PointRef) -> String {
        self.point(point)
    }
    fn body(&self, frame: FrameId) -> String {
        self.body(frame)
    }
}

impl Work<'_> {
    /// The letter of the power of a load: N, where no force, parameter or result of the machine has it; of several loads with a number.
    pub(super) fn power_of(&self, path: &str) -> String {
        let equations = self.equations;
        let shown = |name: &str| equations.notation.iter().find(|(n, _)| n == name).map_or(name, |(_, shown)| shown).to_owned();
        let reactions = equations.reactions.iter().map(|r| shown(&equations.graph.symbol_info(r.symbol).name));
        let named = equations
            .outputs
            .iter()
            .map(|o| shown(&o.name))
            .chain(equations.parameters.iter().map(|p| shown(equations.graph.symbol_info(p.symbol).name.as_str())));
        let taken: Vec<String> = reactions.chain(named).collect();
        let is_free = |letter: &&str| !taken.iter().any(|t| t.split('_').next() == Some(*letter));
        let letter = ["N", "P", "W"].into_iter().find(is_free).unwrap_or("N");
        let loads: Vec<&str> = equations.applied.iter().filter(|load| !load.forces.is_empty()).map(|load| load.path.as_str()).collect();
        match loads.iter().position(|p| *p == path) {
            Some(at) if loads.len() > 1 => format!("{letter}_{}", at + 1),
            _ => letter.to_owned(),
        }
    }

    /// "spring 2", or what the file calls it.
    pub(super) fn element_name(&self, element: &Element) -> String {
        let label = self.text(&element.label);
        if !label.is_empty() {
            return label.to_owned();
        }
        let table = element.path.split('.').next().unwrap_or(element.table);
        let alike: Vec<&str> = self.alike(table);
        let (en, ru) = crate::shown::find(table).map_or(("", ""), |row| row.called);
        let kind = self.language.pick(en, ru);
        match alike.iter().position(|path| *path == element.path) {
            Some(at) if alike.len() > 1 => format!("{kind} {}", at + 1),
            _ => kind.to_owned(),
        }
    }

    /// Elements of a table of the file, each once.
    fn alike(&self, table: &str) -> Vec<&str> {
        let mut list: Vec<&str> = Vec::new();
        for element in &self.model.elements {
            if element.path.split('.').next() == Some(table) && !list.contains(&element.path.as_str()) {
                list.push(&element.path);
            }
        }
        list
    }

    /// The element or connection that acts under a path of the file.
    pub(super) fn load_name(&self, path: &str) -> String {
        if let Some(element) = self.model.elements.iter().find(|e| e.path == path) {
            return self.element_name(element);
        }
        let connection = self.model.connections.iter().position(|c| format!("{}.{}", c.table, c.name) == path);
        connection.map_or_else(|| path.rsplit('.').next().unwrap_or(path).to_owned(), |at| self.connection_name(at))
    }

    /// The label of a connection, its letters, or its number where its name is a word.
    pub(super) fn connection_name(&self, at: usize) -> String {
        let Connection { name, label, .. } = &self.model.connections[at];
        let label = self.text(label);
        let word = is_word(name);
        match () {
            () if !label.is_empty() => label.to_owned(),
            () if word => (at + 1).to_string(),
            () => name.clone(),
        }
    }

    /// The label of a body; its name where that is no foreign word, else its number.
    pub(super) fn body_name(&self, frame: FrameId) -> String {
        let Frame { name, label, .. } = &self.model.frames[frame.index()];
        let label = self.text(label);
        let foreign = self.language == words::Language::Ru && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && name.len() > 2;
        match self.number(frame) {
            Some(_) if !label.is_empty() => crate::numbering::bare(label).to_owned(),
            Some(n) if foreign => format!("тело {n}"),
            _ => name.clone(),
        }
    }

    /// "body 2 (crank)", "the ground".
    pub(super) fn body(&self, frame: FrameId) -> String {
        self.titled(frame, [("the ground", "стойка"), ("body", "тело"), ("the frame", "система отсчёта")])
    }

    /// "of body 2 (crank)" behind a noun.
    pub(super) fn of_body(&self, frame: FrameId) -> String {
        self.titled(frame, [("of the ground", "стойки"), ("of body", "тела"), ("of the frame", "системы отсчёта")])
    }

    /// "with body 2 (crank)" behind a verb.
    pub(super) fn with_body(&self, frame: FrameId) -> String {
        self.titled(frame, [("the ground", "стойкой"), ("body", "телом"), ("the frame", "системой отсчёта")])
    }

    fn titled(&self, frame: FrameId, words: [(&'static str, &'static str); 3]) -> String {
        let [ground, body, other] = words.map(|(en, ru)| self.language.pick(en, ru));
        if frame == FrameId::GROUND {
            return ground.to_owned();
        }
        let Frame { name, label, .. } = &self.model.frames[frame.index()];
        let label = self.text(label);
        match self.number(frame) {
            Some(n) if !label.is_empty() => format!("{body} {n} ({})", crate::numbering::bare(label)),
            Some(n) => format!("{body} {n}"),
            None if self.language == words::Language::Ru && is_word(name) => other.to_owned(),
            None => format!("{other} «{name}»"),
        }
    }

    /// "point A of body 2".
    pub(super) fn point(&self, point: PointRef) -> String {
        let of = self.of_body(self.frame_of(point));
        match point {
            PointRef::Point(p) => {
                let name = &self.model.points[p.index()].name;
                if self.language == words::Language::Ru && is_word(name) {
                    return format!("точка {of}");
                }
                self.language.pick(format!("point {name} {of}"), format!("точка {name} {of}"))
            }
            PointRef::Origin(_) => self.language.pick(format!("the origin {of}"), format!("начало осей {of}")),
            PointRef::Center(_) => self.language.pick(format!("the mass centre {of}"), format!("центр масс {of}")),
        }
    }

    /// The frame of a point.
    pub(super) fn frame_of(&self, point: PointRef) -> FrameId {
        match point {
            PointRef::Point(p) => self.model.points[p.index()].on,
            PointRef::Origin(frame) | PointRef::Center(frame) => frame,
        }
    }
}
