//! Documents that follow from the code or from each other stay true.
//!
//! `UPDATE_DOCS=1 cargo test -p strutt --test documents` writes the generated ones anew.

use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// Names of the folders of the gallery.
fn machines() -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(root().join("gallery"))
        .expect("the gallery exists")
        .flatten()
        .filter(|e| e.path().is_dir())
        .map(|e| e.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn model_file_reference_is_the_one_of_the_field_tables() {
    use mechanics::reference::{Language, markdown};
    for (path, language) in [("docs/model-file.md", Language::English), ("docs/model-file.ru.md", Language::Russian)] {
        let generated = markdown(language);
        if std::env::var_os("UPDATE_DOCS").is_some() {
            std::fs::write(root().join(path), &generated).expect("docs can be written");
        }
        let written = std::fs::read_to_string(root().join(path)).unwrap_or_default();
        assert!(written == generated, "{path} is not current: UPDATE_DOCS=1 cargo test -p strutt --test documents");
    }
}

#[test]
fn every_machine_of_the_gallery_has_its_pages() {
    let readme = read("README.md");
    for name in machines() {
        assert!(root().join("gallery").join(&name).join("model.toml").is_file(), "gallery/{name} has no model.toml");
        assert!(root().join("gallery").join(&name).join("README.md").is_file(), "gallery/{name} has no README.md");
        assert!(readme.contains(&format!("(gallery/{name})")), "README.md does not list gallery/{name}");
    }
}

#[test]
fn links_inside_the_repository_lead_somewhere() {
    let mut pages: Vec<PathBuf> = ["README.md", "ARCHITECTURE.md", "STYLE.md", "CHANGELOG.md", "gallery/README.md", "tests/book/README.md"]
        .iter()
        .map(|p| root().join(p))
        .collect();
    pages.extend(machines().iter().map(|m| root().join("gallery").join(m).join("README.md")));
    for folder in ["docs", "tests/book"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("folder exists").flatten().map(|e| e.path());
        pages.extend(entries.filter(|p| p.extension().is_some_and(|x| x == "md")));
    }
    let mut broken = Vec::new();
    for page in pages {
        let text = std::fs::read_to_string(&page).unwrap_or_else(|e| panic!("{}: {e}", page.display()));
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let target = link.split('#').next().unwrap_or_default();
            let outside = target.is_empty() || target.contains("://") || target.contains(' ');
            if !outside && !page.parent().is_some_and(|p| p.join(target).exists()) {
                broken.push(format!("{} -> {target}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn every_code_of_a_diagnostic_is_in_the_book() {
    let errors = read("tests/book/errors.md");
    let missing: Vec<&str> =
        mechanics::explain::TABLES.iter().flat_map(|t| t.iter()).map(|e| e.code).filter(|c| !errors.contains(c)).collect();
    assert!(missing.is_empty(), "tests/book/errors.md shows nothing for {}", missing.join(", "));
}
