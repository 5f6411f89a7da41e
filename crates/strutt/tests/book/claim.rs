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
    let word = |i: usize| line.split_whitespace().nth(i).unwrap_or_default();
    let rest = |head: &str| line[head.len()..].trim();
    let found = match (word(0), word(1)) {
        ("max", _) => bounded(line),
        ("event", number) if word(2) == "says:" => says(line, number),
        ("event", number) => event(line, number),
        ("impulse", _) => impulse(line),
        ("no", "value") => Some(Ok(absent(rest("no value")))),
        ("no", "impulse") => open_impulse(rest("no impulse")),
        ("no", "note") => Some(Ok(Claim::NoNote(rest("no note").to_owned()))),
        ("note", _) => Some(Ok(Claim::Note(rest("note").to_owned()))),
        ("help", _) => help(rest("help")),
        ("warnings", count) => Some(integer(count).map(Claim::Warnings)),
        ("events", count) => Some(integer(count).map(Claim::Events)),
        ("audits", _) => Some(Ok(Claim::AuditsOk)),
        ("audit", "fails") => Some(Ok(Claim::AuditFails(word(2).to_owned()))),
        ("audit", _) => audit(line),
        ("least" | "greatest", _) => extreme(line),
        ("equation", _) => equation(rest("equation")),
        ("kinetic:" | "potential:" | "dissipation:", _) => energy(line),
        ("inertia", _) => inertia(rest("inertia of")),
        ("error" | "warning", _) => finding(line),
        ("field", _) => field(rest("field")),
        ("phase", _) => phase(line),
        ("mean", "of") => mean(line),
        ("mean", _) => mean_rate(line),
        ("fails", _) => Some(Ok(fails(rest("fails")))),
        _ if line.contains(" constant ") => constant(line),
        _ => value(line),
    };
    found.ok_or_else(|| format!("not a claim: {line}"))?
}

/// A claim, or what is wrong with its numbers; none where the words are no claim.
type Read = Option<Result<Claim, String>>;

/// `max |NAME| < LIMIT`.
fn bounded(line: &str) -> Read {
    let (left, right) = line.split_once('<')?;
    let name = left.split('|').nth(1)?.trim().to_owned();
    Some(number(right).map(|limit| Claim::Bounded { name, limit }))
}

/// `event N at T ± TOL`.
fn event(line: &str, which: &str) -> Read {
    let (left, right) = line.split_once('±')?;
    let at = left.split_whitespace().nth(3)?;
    let claim = || Ok(Claim::Event { number: integer(which)?, at: number(at)?, tolerance: number(right)? });
    Some(claim())
}

/// `event N says: TEXT`.
fn says(line: &str, which: &str) -> Read {
    let (_, text) = line.split_once("says:")?;
    Some(integer(which).map(|event| Claim::Says { event, text: text.trim().to_owned() }))
}

/// `no value NAME` or `no value NAME(T)`.
fn absent(whole: &str) -> Claim {
    let split = whole.strip_suffix(')').and_then(|n| n.rsplit_once('('));
    // `force(R)` is a name
    let timed = split.and_then(|(name, at)| Some((name, number(at).ok()?)));
    timed.map_or(Claim::Open(whole.to_owned()), |(name, at)| Claim::NoValue { name: name.to_owned(), at })
}

/// `no impulse NAME at event N`.
fn open_impulse(rest: &str) -> Read {
    let (name, event) = rest.split_once(" at event ")?;
    Some(integer(event.trim()).map(|event| Claim::OpenImpulse { name: name.trim().to_owned(), event }))
}

/// `help CODE: TEXT`.
fn help(rest: &str) -> Read {
    let (code, text) = rest.split_once(':')?;
    Some(Ok(Claim::Help { code: code.trim().to_owned(), text: text.trim().to_owned() }))
}

/// `audit "NAME" < LIMIT`.
fn audit(line: &str) -> Read {
    let name = line.split('"').nth(1)?.to_owned();
    Some(number(line.split_once('<')?.1).map(|limit| Claim::Audit { name, limit }))
}

/// `equation N: TEXT`.
fn equation(rest: &str) -> Read {
    let (which, text) = rest.split_once(':')?;
    Some(integer(which.trim()).map(|number| Claim::Equation { number, text: text.trim().to_owned() }))
}

/// `kinetic: TEXT`, `potential: TEXT`, `dissipation: TEXT`.
fn energy(line: &str) -> Read {
    let kind = ["kinetic:", "potential:", "dissipation:"].into_iter().find(|kind| line.starts_with(kind))?;
    Some(Ok(Claim::Energy { kind, text: line[kind.len()..].trim().to_owned() }))
}

/// `inertia of NAME = V ± TOL [rel]`.
fn inertia(rest: &str) -> Read {
    Some(equality(rest)?.map(|(name, expected, tolerance)| Claim::Inertia { name, expected, tolerance }))
}

/// `error [only] CODE [line N]`, `warning CODE [line N]`.
fn finding(line: &str) -> Read {
    let rest: Vec<&str> = line.split_whitespace().skip(1).collect();
    let only = rest.first() == Some(&"only");
    let (code, at) = match if only { &rest[1..] } else { &rest[..] } {
        [code] => ((*code).to_owned(), Ok(None)),
        [code, "line", n] => ((*code).to_owned(), integer(n).map(Some)),
        _ => return None,
    };
    let is_error = line.starts_with("error");
    Some(at.map(|line| if is_error { Claim::Error { code, line, only } } else { Claim::Warning { code, line } }))
}

/// `field PATH: TEXT`.
fn field(rest: &str) -> Read {
    let (path, text) = rest.split_once(':')?;
    Some(Ok(Claim::Field { path: path.trim().to_owned(), text: text.trim().to_owned() }))
}

/// `fails CODE[: TEXT]`.
fn fails(rest: &str) -> Claim {
    let (code, text) = rest.split_once(':').unwrap_or((rest, ""));
    Claim::Fails { code: code.trim().to_owned(), text: text.trim().to_owned() }
}

/// `NAME constant ± TOL [rel]`.
fn constant(line: &str) -> Read {
    let (name, rest) = line.split_once(" constant ")?;
    let limit = tolerance(rest.trim().strip_prefix('±')?);
    Some(limit.map(|tolerance| Claim::Constant { name: name.trim().to_owned(), tolerance }))
}

/// `NAME(T) = V ± TOL [rel]` or `NAME = V ± TOL [rel]`.
fn value(line: &str) -> Read {
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
fn impulse(line: &str) -> Read {
    let (words, expected, tolerance) = match equality(line.strip_prefix("impulse of ")?)? {
        Ok(parts) => parts,
        Err(e) => return Some(Err(e)),
    };
    let (name, event) = words.split_once(" at event ")?;
    Some(integer(event.trim()).map(|event| Claim::Impulse { name: name.trim().to_owned(), event, expected, tolerance }))
}

/// `least NAME = V ± TOL [rel]` or `least NAME at T ± TOL`; `greatest` likewise.
fn extreme(line: &str) -> Read {
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
fn mean(line: &str) -> Read {
    let (left, expected, tolerance) = match equality(line)? {
        Ok(parts) => parts,
        Err(e) => return Some(Err(e)),
    };
    let name = left.strip_prefix("mean of")?.trim().to_owned();
    Some(Ok(Claim::Mean { name, expected, tolerance }))
}

/// `mean rate of NAME from A to B = V ± TOL [rel]`.
fn mean_rate(line: &str) -> Read {
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
fn phase(line: &str) -> Read {
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
