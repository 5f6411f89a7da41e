//! Reading chapters of the verification book (format: tests/book/README.md).

use std::path::{Path, PathBuf};

/// One expectation: a command on a model, and claims about the result.
#[derive(Clone, Debug)]
pub struct Trial {
    /// `chapter / heading (line)`.
    pub name: String,
    /// The chapter.
    pub file: PathBuf,
    /// Line of the command, from 1.
    pub line: usize,
    /// Text of the model.
    pub model: String,
    /// The command.
    pub command: Vec<String>,
    /// Claims with their lines.
    pub claims: Vec<(usize, String)>,
}

/// All trials of a chapter.
pub fn read(root: &Path, file: &Path) -> Vec<Trial> {
    let text = std::fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let chapter = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut reader = Reader { heading: String::new(), model: None, trials: Vec::new(), root, file, chapter };
    let mut fence: Option<(String, usize, String)> = None;
    for (i, line) in text.lines().enumerate() {
        match &mut fence {
            Some(_) if line.trim() == "```" => {
                let (kind, start, body) = fence.take().unwrap_or_default();
                reader.block(&kind, start, body);
            }
            Some((_, _, body)) => {
                body.push_str(line);
                body.push('\n');
            }
            None => match line.trim_start().strip_prefix("```") {
                Some(kind) => fence = Some((kind.trim().to_owned(), i + 2, String::new())),
                None => reader.prose(line),
            },
        }
    }
    assert!(fence.is_none(), "{}: a fenced block is not closed", file.display());
    reader.trials
}

struct Reader<'a> {
    heading: String,
    model: Option<String>,
    trials: Vec<Trial>,
    root: &'a Path,
    file: &'a Path,
    chapter: String,
}

impl Reader<'_> {
    fn prose(&mut self, line: &str) {
        if line.starts_with('#') {
            self.heading = line.trim_start_matches('#').trim().to_owned();
        } else if let Some(path) = line.strip_prefix("model:") {
            let path = self.root.join(path.trim().trim_matches('`'));
            self.model = Some(std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())));
        }
    }

    fn block(&mut self, kind: &str, start: usize, body: String) {
        match kind {
            "toml" if body.starts_with("# patch") => {
                let model = self.model.as_mut().unwrap_or_else(|| panic!("{}:{start}: a patch without a model", self.file.display()));
                model.push('\n');
                model.push_str(&body);
            }
            "toml" => self.model = Some(body),
            "replace" => self.replace(start, &body),
            "expect" => self.expectation(start, &body),
            _ => {}
        }
    }

    /// Lines `OLD => NEW`; OLD must stand exactly once in the model in force.
    fn replace(&mut self, start: usize, body: &str) {
        let place = format!("{}:{start}", self.file.display());
        let model = self.model.as_mut().unwrap_or_else(|| panic!("{place}: a replacement without a model"));
        for line in body.lines().filter(|l| !l.trim().is_empty()) {
            let (old, new) = line.split_once(" => ").unwrap_or_else(|| panic!("{place}: not OLD => NEW: {line}"));
            assert_eq!(model.matches(old.trim()).count(), 1, "{place}: `{old}` must stand once in the model");
            *model = model.replace(old.trim(), new.trim());
        }
    }

    fn expectation(&mut self, start: usize, body: &str) {
        let mut lines =
            body.lines().enumerate().map(|(i, l)| (start + i, l.trim().to_owned())).filter(|(_, l)| !l.is_empty() && !l.starts_with('#'));
        let place = format!("{}:{start}", self.file.display());
        let (line, command) = lines.next().unwrap_or_else(|| panic!("{place}: an empty expectation"));
        self.trials.push(Trial {
            name: format!("{} / {} (line {line})", self.chapter, self.heading),
            file: self.file.to_owned(),
            line,
            model: self.model.clone().unwrap_or_else(|| panic!("{place}: no model")),
            command: words(&command),
            claims: lines.collect(),
        });
    }
}

/// Words at spaces; a part in double quotes is one word without the quotes.
fn words(line: &str) -> Vec<String> {
    let (mut out, mut word, mut quoted, mut any) = (Vec::new(), String::new(), false, false);
    for c in line.chars() {
        match c {
            '"' => {
                quoted = !quoted;
                any = true;
            }
            ' ' if !quoted => {
                if any {
                    out.push(std::mem::take(&mut word));
                }
                any = false;
            }
            c => {
                word.push(c);
                any = true;
            }
        }
    }
    if any {
        out.push(word);
    }
    out
}
