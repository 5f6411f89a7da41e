//! A trial: its command, its claims.

use crate::chapter::Trial;
use crate::claim::{Claim, parse};
use crate::command::Command;

/// Checks a trial; the message lists every claim that does not hold.
pub fn check(trial: &Trial) -> Result<(), String> {
    let mut complaints = Vec::new();
    let mut claims = Vec::new();
    if trial.claims.is_empty() {
        complaints.push("the expectation claims nothing".to_owned());
    }
    for (line, text) in &trial.claims {
        match parse(text) {
            Ok(claim) => claims.push((*line, text, claim)),
            Err(e) => complaints.push(format!("line {line}: {e}")),
        }
    }
    let command = Command::parse(&trial.command)?;
    let parsed: Vec<&Claim> = claims.iter().map(|c| &c.2).collect();
    let result = command.run(trial, &parsed)?;
    for (line, text, claim) in &claims {
        if let Err(e) = result.check(claim, &trial.model) {
            complaints.push(format!("line {line}: {text}\n    {e}"));
        }
    }
    if complaints.is_empty() { Ok(()) } else { Err(format!("{}:{}\n{}", trial.file.display(), trial.line, complaints.join("\n"))) }
}
