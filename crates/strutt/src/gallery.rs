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
    "blade-particle",
    "blade-particle-published",
    "double-pendulum",
    "gyroscopic-rotor",
    "n-pendulum",
    "oscillator",
    "oscillator-published",
    "pendulum-on-shaft",
    "rotor",
    "scotch-yoke",
    "scotch-yoke-dry",
    "scotch-yoke-oneway",
    "section-composite",
    "shaft-line",
    "spherical-pendulum",
    "thread-pendulum",
    "top",
];

/// The model with a name.
pub fn find(name: &str) -> Option<&'static Example> {
    EXAMPLES.iter().find(|e| e.name == name)
}

/// All names.
pub fn names() -> impl Iterator<Item = &'static str> {
    EXAMPLES.iter().map(|e| e.name)
}
