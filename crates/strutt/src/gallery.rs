//! The example models, inside the program so that it needs no files of its own. One line per model.

/// A model of the gallery.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// Name: its folder under gallery/.
    pub name: &'static str,
    /// The text of its model.toml.
    pub text: &'static str,
}

macro_rules! examples {
    ($($name:literal),* $(,)?) => {
        /// Every model of the gallery.
        pub const EXAMPLES: &[Example] =
            &[$(Example { name: $name, text: include_str!(concat!("../../../gallery/", $name, "/model.toml")) }),*];
    };
}

examples![
    "absorber",
    "atwood",
    "basic-oscillator",
    "belt-oscillator",
    "blade-particle",
    "blade-particle-published",
    "bouncing-ball",
    "cantilever-tip-mass",
    "composite-beam",
    "crank-hoist",
    "crank-hoist-double",
    "differential-pulley",
    "double-pendulum",
    "duffing",
    "five-bar",
    "four-bar",
    "friction-onset",
    "froude-pendulum",
    "gyroscopic-rotor",
    "impact-oscillator",
    "kapitza",
    "limited-motor",
    "manipulator",
    "mathieu",
    "n-pendulum",
    "oscillator",
    "oscillator-linkage",
    "oscillator-published",
    "parametric-pendulum",
    "pendulum-on-shaft",
    "portal-frame",
    "portal-frame-massive",
    "portal-frame-refined",
    "rattling",
    "rotor",
    "scotch-yoke",
    "scotch-yoke-dry",
    "scotch-yoke-oneway",
    "section-composite",
    "shaft-line",
    "slider-crank",
    "slider-crank-spring",
    "spherical-pendulum",
    "stick-slip",
    "thread-pendulum",
    "three-hinged-arch",
    "three-rod-frame",
    "three-rod-frame-massive",
    "three-rod-frame-refined",
    "top",
    "truss",
    "truss-bridge",
    "van-der-pol",
];

/// Tables that examples read: example, file beside the model, text.
const TABLES: &[(&str, &str, &str)] = &[("stick-slip", "variants.csv", include_str!("../../../gallery/stick-slip/variants.csv"))];

/// The tables of an example: file and text.
pub fn tables(name: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    TABLES.iter().filter(move |table| table.0 == name && find(name).is_some()).map(|table| (table.1, table.2))
}

/// The model with a name.
pub fn find(name: &str) -> Option<&'static Example> {
    EXAMPLES.iter().find(|e| e.name == name)
}

/// All names.
pub fn names() -> impl Iterator<Item = &'static str> {
    EXAMPLES.iter().map(|e| e.name)
}
