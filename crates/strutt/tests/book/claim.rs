//! The language of claims (format: tests/book/README.md).

/// A tolerance.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Size.
    pub size: f64,
    /// Whether it is relative.
    pub relative: bool,
}

/// When a column is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    At(f64),
    End,
}

/// What of an extreme is claimed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Which {
    Least,
    LeastAt,
    Greatest,
    GreatestAt,
}

/// A claim about a result.
#[derive(Clone, Debug)]
pub enum Claim {
    Value {
        name: String,
        when: When,
        expected: f64,
        tolerance: Tolerance,
    },
    Bounded {
        name: String,
        limit: f64,
    },
    Constant {
        name: String,
        tolerance: Tolerance,
    },
    Mean {
        name: String,
        expected: f64,
        tolerance: Tolerance,
    },
    MeanRate {
        name: String,
        from: f64,
        to: f64,
        expected: f64,
        tolerance: Tolerance,
    },
    Event {
        number: usize,
        at: f64,
        tolerance: f64,
    },
    /// The words of an event, whole.
    Says {
        event: usize,
        text: String,
    },
    Events(usize),
    /// The impulse of a reaction.
    Impulse {
        name: String,
        event: usize,
        expected: f64,
        tolerance: Tolerance,
    },
    /// The impulse of a reaction is not unique in that event.
    OpenImpulse {
        name: String,
        event: usize,
    },
    /// The column says why it is empty there.
    NoValue {
        name: String,
        at: f64,
    },
    /// No place of rest has a value of it, and the column says why.
    Open(String),
    /// Least or greatest value of the motion, or its instant.
    Extreme {
        name: String,
        which: Which,
        expected: f64,
        tolerance: Tolerance,
    },
    Audit {
        name: String,
        limit: f64,
    },
    AuditFails(String),
    AuditsOk,
    Rest {
        name: String,
        expected: f64,
        tolerance: Tolerance,
    },
    Equation {
        number: usize,
        text: String,
    },
    Energy {
        kind: &'static str,
        text: String,
    },
    Inertia {
        name: String,
        expected: f64,
        tolerance: Tolerance,
    },
    Error {
        code: String,
        line: Option<usize>,
        only: bool,
    },
    Warning {
        code: String,
        line: Option<usize>,
    },
    /// The help of a finding.
    Help {
        code: String,
        text: String,
    },
    /// A note of the result contains this.
    Note(String),
    /// No note of the result contains this.
    NoNote(String),
    /// Number of warnings.
    Warnings(usize),
    Fails {
        code: String,
        text: String,
    },
    Field {
        path: String,
        text: String,
    },
    PhaseConstant {
        phase: usize,
        key: String,
        expected: f64,
        tolerance: Tolerance,
    },
    PhaseCase {
        phase: usize,
        case: String,
    },
}

/// Reads a claim.
pub fn parse(line: &str) -> Result<Claim, String> {
    let unknown = || format!("not a claim: {line}");
    let word = |i: usize| line.split_whitespace().nth(i).unwrap_or_default();
    match word(0) {
        "max" => {
            let (left, right) = line.split_once('<').ok_or_else(unknown)?;
            let name = left.split('|').nth(1).ok_or_else(unknown)?.trim().to_owned();
            Ok(Claim::Bounded { name, limit: number(right)? })
        }
        "event" if word(2) == "says:" => {
            let (_, text) = line.split_once("says:").ok_or_else(unknown)?;
            Ok(Claim::Says { event: integer(word(1))?, text: text.trim().to_owned() })
        }
        "event" => {
            let (left, right) = line.split_once('±').ok_or_else(unknown)?;
            let at = left.split_whitespace().nth(3).ok_or_else(unknown)?;
            Ok(Claim::Event { number: integer(word(1))?, at: number(at)?, tolerance: number(right)? })
        }
        "impulse" => impulse(line).ok_or_else(unknown)?,
        "no" if word(1) == "value" => {
            let whole = line["no value".len()..].trim();
            let split = whole.strip_suffix(')').and_then(|n| n.rsplit_once('('));
            // `force(R)` is a name
            let timed = split.and_then(|(name, at)| Some((name, number(at).ok()?)));
            Ok(timed.map_or(Claim::Open(whole.to_owned()), |(name, at)| Claim::NoValue { name: name.to_owned(), at }))
        }
        "no" if word(1) == "impulse" => {
            let (name, event) = line["no impulse".len()..].split_once(" at event ").ok_or_else(unknown)?;
            Ok(Claim::OpenImpulse { name: name.trim().to_owned(), event: integer(event.trim())? })
        }
        "note" => Ok(Claim::Note(line["note".len()..].trim().to_owned())),
        "no" if word(1) == "note" => Ok(Claim::NoNote(line["no note".len()..].trim().to_owned())),
        "help" => {
            let (code, text) = line["help".len()..].split_once(':').ok_or_else(unknown)?;
            Ok(Claim::Help { code: code.trim().to_owned(), text: text.trim().to_owned() })
        }
        "warnings" => Ok(Claim::Warnings(integer(word(1))?)),
        "events" => Ok(Claim::Events(integer(word(1))?)),
        "audits" => Ok(Claim::AuditsOk),
        "audit" if word(1) == "fails" => Ok(Claim::AuditFails(word(2).to_owned())),
        "least" | "greatest" => extreme(line).ok_or_else(unknown)?,
        "audit" => {
            let name = line.split('"').nth(1).ok_or_else(unknown)?.to_owned();
            let limit = line.split_once('<').ok_or_else(unknown)?.1;
            Ok(Claim::Audit { name, limit: number(limit)? })
        }
        "equation" => {
            let (number, text) = line["equation".len()..].split_once(':').ok_or_else(unknown)?;
            Ok(Claim::Equation { number: integer(number.trim())?, text: text.trim().to_owned() })
        }
        kind @ ("kinetic:" | "potential:" | "dissipation:") => {
            let kinds = ["kinetic:", "potential:", "dissipation:"];
            let known = kinds.into_iter().find(|k| *k == kind).ok_or_else(unknown)?;
            Ok(Claim::Energy { kind: known, text: line[kind.len()..].trim().to_owned() })
        }
        "inertia" => {
            let (name, expected, tolerance) = equality(&line["inertia of".len()..]).ok_or_else(unknown)??;
            Ok(Claim::Inertia { name, expected, tolerance })
        }
        kind @ ("error" | "warning") => {
            let rest: Vec<&str> = line.split_whitespace().skip(1).collect();
            let only = rest.first() == Some(&"only");
            let (code, line) = match if only { &rest[1..] } else { &rest[..] } {
                [code] => ((*code).to_owned(), None),
                [code, "line", n] => ((*code).to_owned(), Some(integer(n)?)),
                _ => return Err(unknown()),
            };
            Ok(if kind == "error" { Claim::Error { code, line, only } } else { Claim::Warning { code, line } })
        }
        "field" => {
            let (path, text) = line["field".len()..].split_once(':').ok_or_else(unknown)?;
            Ok(Claim::Field { path: path.trim().to_owned(), text: text.trim().to_owned() })
        }
        "phase" => phase(line).ok_or_else(unknown)?,
        "mean" if word(1) == "of" => mean(line).ok_or_else(unknown)?,
        "mean" => mean_rate(line).ok_or_else(unknown)?,
        "fails" => {
            let rest = line["fails".len()..].trim();
            let (code, text) = rest.split_once(':').unwrap_or((rest, ""));
            Ok(Claim::Fails { code: code.trim().to_owned(), text: text.trim().to_owned() })
        }
        _ if line.contains(" constant ") => {
            let (name, rest) = line.split_once(" constant ").ok_or_else(unknown)?;
            let tolerance = tolerance(rest.trim().strip_prefix('±').ok_or_else(unknown)?)?;
            Ok(Claim::Constant { name: name.trim().to_owned(), tolerance })
        }
        _ => value(line).ok_or_else(unknown)?,
    }
}

/// `NAME(T) = V ± TOL [rel]` or `NAME = V ± TOL [rel]`.
fn value(line: &str) -> Option<Result<Claim, String>> {
    let (name, expected, tolerance) = match equality(line)? {
        Ok(parts) => parts,
        Err(e) => return Some(Err(e)),
    };
    let Some((column, when)) = name.strip_suffix(')').and_then(|n| n.rsplit_once('(')) else {
        return Some(Ok(Claim::Rest { name, expected, tolerance }));
    };
    let when = match when {
        "end" => Ok(When::End),
        // `force(AB)` is a name
        t if number(t).is_err() && t.starts_with(|c: char| c.is_alphabetic()) => {
            return Some(Ok(Claim::Rest { name, expected, tolerance }));
        }
        t => number(t).map(When::At),
    };
    Some(when.map(|when| Claim::Value { name: column.to_owned(), when, expected, tolerance }))
}

/// `impulse of NAME at event N = V ± TOL [rel]`.
fn impulse(line: &str) -> Option<Result<Claim, String>> {
    let (words, expected, tolerance) = match equality(line.strip_prefix("impulse of ")?)? {
        Ok(parts) => parts,
        Err(e) => return Some(Err(e)),
    };
    let (name, event) = words.split_once(" at event ")?;
    Some(integer(event.trim()).map(|event| Claim::Impulse { name: name.trim().to_owned(), event, expected, tolerance }))
}

/// `least NAME = V ± TOL [rel]` or `least NAME at T ± TOL`; `greatest` likewise.
fn extreme(line: &str) -> Option<Result<Claim, String>> {
    let (word, rest) = line.split_once(' ')?;
    let least = word == "least";
    let (timed, written) = match rest.split_once(" at ") {
        Some((name, value)) => (true, format!("{name} = {value}")),
        None => (false, rest.to_owned()),
    };
    let which = match (least, timed) {
        (true, false) => Which::Least,
        (true, true) => Which::LeastAt,
        (false, false) => Which::Greatest,
        (false, true) => Which::GreatestAt,
    };
    Some(equality(&written)?.map(|(name, expected, tolerance)| Claim::Extreme { name, which, expected, tolerance }))
}

/// `mean of NAME = V ± TOL [rel]`.
fn mean(line: &str) -> Option<Result<Claim, String>> {
    let (left, expected, tolerance) = match equality(line)? {
        Ok(parts) => parts,
        Err(e) => return Some(Err(e)),
    };
    let name = left.strip_prefix("mean of")?.trim().to_owned();
    Some(Ok(Claim::Mean { name, expected, tolerance }))
}

/// `mean rate of NAME from A to B = V ± TOL [rel]`.
fn mean_rate(line: &str) -> Option<Result<Claim, String>> {
    let (left, expected, tolerance) = match equality(line)? {
        Ok(parts) => parts,
        Err(e) => return Some(Err(e)),
    };
    let words: Vec<&str> = left.split_whitespace().collect();
    let ["mean", "rate", "of", name, "from", a, "to", b] = words[..] else { return None };
    let claim = |from, to| Claim::MeanRate { name: name.to_owned(), from, to, expected, tolerance };
    Some(number(a).and_then(|from| Ok(claim(from, number(b)?))))
}

/// `phase N case NAME` or `phase N KEY = V ± TOL [rel]`.
fn phase(line: &str) -> Option<Result<Claim, String>> {
    let words: Vec<&str> = line.split_whitespace().collect();
    if let ["phase", n, "case", case] = words[..] {
        return Some(integer(n).map(|phase| Claim::PhaseCase { phase, case: case.to_owned() }));
    }
    let (left, expected, tolerance) = match equality(line)? {
        Ok(parts) => parts,
        Err(e) => return Some(Err(e)),
    };
    let words: Vec<&str> = left.split_whitespace().collect();
    let ["phase", n, key] = words[..] else { return None };
    Some(integer(n).map(|phase| Claim::PhaseConstant { phase, key: key.to_owned(), expected, tolerance }))
}

type Equality = Result<(String, f64, Tolerance), String>;

fn equality(text: &str) -> Option<Equality> {
    let (name, rest) = text.split_once('=')?;
    let (expected, limit) = rest.split_once('±')?;
    let parts = || Ok((name.trim().to_owned(), number(expected)?, tolerance(limit)?));
    Some(parts())
}

fn tolerance(text: &str) -> Result<Tolerance, String> {
    let text = text.trim();
    match text.strip_suffix("rel") {
        Some(size) => Ok(Tolerance { size: number(size)?, relative: true }),
        None => Ok(Tolerance { size: number(text)?, relative: false }),
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("not a number: `{}`", text.trim()))
}

fn integer(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| format!("not a whole number: `{text}`"))
}

impl Tolerance {
    /// Whether `found` is near enough to `expected`; the message when not.
    pub fn check(&self, what: &str, found: f64, expected: f64) -> Result<(), String> {
        let allowed = if self.relative { self.size * expected.abs() } else { self.size };
        let difference = (found - expected).abs();
        // written so that not-a-number fails
        if difference <= allowed {
            return Ok(());
        }
        Err(format!("{what} = {found:.16e}, expected {expected:.16e}: off by {difference:.2e}, allowed {allowed:.2e}"))
    }
}
