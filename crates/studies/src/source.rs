//! The model file as text with a name.

use std::path::Path;

/// A model file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// As messages name it.
    pub path: String,
    /// Its text.
    pub text: String,
}

impl Source {
    /// A text with a name.
    pub fn new(path: &str, text: &str) -> Source {
        Source { path: path.into(), text: text.into() }
    }

    /// Name of the machine for folders: `gallery/top/model.toml` is top, `wheel.toml` is wheel.
    pub fn name(&self) -> String {
        let path = Path::new(&self.path);
        let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        let folder = path.parent().and_then(Path::file_name).map(|s| s.to_string_lossy().into_owned());
        // the stem of `...toml` is a folder's name for the one above
        let is_name = !stem.chars().all(|c| c == '.');
        match folder {
            Some(folder) if stem == "model" => folder,
            _ if !is_name => "model".into(),
            _ => stem,
        }
    }

    /// Hash of the text and the overrides, the same on every machine: FNV-1a, 64 bits (Fowler, Noll, Vo), in hexadecimal digits.
    pub fn hash(&self, overrides: &[(String, String)]) -> String {
        let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
        let mut feed = |bytes: &[u8]| {
            for byte in bytes {
                hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
        };
        feed(self.text.as_bytes());
        for (name, value) in overrides {
            feed(b"\0");
            feed(name.as_bytes());
            feed(b"=");
            feed(value.as_bytes());
        }
        format!("{hash:016x}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_fnv_1a() {
        // test vectors of the authors, draft-eastlake-fnv
        assert_eq!(Source::new("", "").hash(&[]), "cbf29ce484222325");
        assert_eq!(Source::new("", "foobar").hash(&[]), "85944171f73967e8");
        assert_ne!(Source::new("", "a").hash(&[]), Source::new("", "a").hash(&[("m".into(), "1 kg".into())]));
    }

    #[test]
    fn a_folder_names_its_model() {
        assert_eq!(Source::new("gallery/top/model.toml", "").name(), "top");
        assert_eq!(Source::new("wheel.toml", "").name(), "wheel");
        assert_eq!(Source::new("model.toml", "").name(), "model");
        assert_eq!(Source::new("stdin", "").name(), "stdin");
    }
}
