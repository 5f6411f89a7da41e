//! Rows of a study of many runs as lines of a text, so that it goes on after a kill at any moment, and shards of it are put together.
//!
//! The first line says of which sweep they are. Each line begins with the checksum of the rest: a last line that does not fit was being written when the process ended and is
//! left out, any other is damage. Numbers stand as their bits.

use super::gathered::Row;
use super::stands::Stand;
use super::wanted::Noted;
use analysis::Quantity;
use analysis::dataset::{Audit, Column};
use serde_json::{Value, json};
use words::{Notice, Text};

/// A sweep that is not divided.
pub(crate) const WHOLE: [usize; 2] = [1, 1];

/// What the first line says.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    /// Version of strutt, model with its values, and what is asked: the same rows come from the same.
    pub same: String,
    /// Number of rows of the whole sweep, and of a block.
    pub count: [usize; 2],
    /// Which part of how many, counted from 1.
    pub shard: [usize; 2],
    /// Names and units of the columns; the first so many are the values.
    pub columns: (usize, Vec<[String; 2]>),
    /// Names of the regimes, where they are noted.
    pub regimes: Vec<String>,
}

impl Head {
    /// Of a sweep with these columns.
    pub fn new(same: String, count: [usize; 2], shard: [usize; 2], (own, columns): (usize, &[Column])) -> Head {
        let columns = columns.iter().map(|c| [c.quantity.name.clone(), c.quantity.unit.clone()]).collect();
        Head { same, count, shard, columns: (own, columns), regimes: Vec::new() }
    }

    /// With the names of regimes.
    pub fn with_regimes(self, regimes: Vec<String>) -> Head {
        Head { regimes, ..self }
    }

    /// The rows of its part: whole blocks, so that a part is the same as within the whole.
    pub fn rows(&self) -> std::ops::Range<usize> {
        let [count, block] = self.count;
        let [part, parts] = self.shard;
        let blocks = count.div_ceil(block.max(1));
        let end = |part: usize| (blocks * part / parts.max(1) * block).min(count);
        end(part - 1)..end(part)
    }

    /// As a line.
    pub fn line(&self) -> String {
        let (own, columns) = &self.columns;
        summed(
            &json!({"same": self.same, "count": self.count, "shard": self.shard, "own": own, "columns": columns, "regimes": self.regimes}),
        )
    }

    /// From a line.
    pub fn read(line: &str) -> Option<Head> {
        let value = unsummed(line)?;
        let pair = |key: &str| Some([value.get(key)?.get(0)?.as_u64()? as usize, value.get(key)?.get(1)?.as_u64()? as usize]);
        let text = |v: &Value| v.as_str().map(str::to_owned);
        let column = |v: &Value| Some([text(v.get(0)?)?, text(v.get(1)?)?]);
        let columns = value.get("columns")?.as_array()?.iter().map(column).collect::<Option<Vec<_>>>()?;
        let regimes = value.get("regimes")?.as_array()?.iter().map(text).collect::<Option<Vec<_>>>()?;
        let found = Head {
            regimes,
            same: text(value.get("same")?)?,
            count: pair("count")?,
            shard: pair("shard")?,
            columns: (value.get("own")?.as_u64()? as usize, columns),
        };
        (found.count[1] > 0 && (1..=found.shard[1]).contains(&found.shard[0])).then_some(found)
    }
}

/// A line with its checksum.
fn summed(value: &Value) -> String {
    let text = value.to_string();
    format!("{:016x} {text}\n", checksum(&text))
}

/// What a line says, when its checksum fits.
fn unsummed(line: &str) -> Option<Value> {
    let (sum, text) = line.split_once(' ')?;
    (u64::from_str_radix(sum, 16).ok()? == checksum(text)).then(|| serde_json::from_str(text).ok()).flatten()
}

/// FNV-1a.
pub(crate) fn checksum(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn bits(value: f64) -> Value {
    json!(format!("{:x}", value.to_bits()))
}

fn number(value: &Value) -> Option<f64> {
    Some(f64::from_bits(u64::from_str_radix(value.as_str()?, 16).ok()?))
}

fn both(text: &Text) -> Value {
    json!([text.en, text.ru])
}

fn text(value: &Value) -> Option<Text> {
    Some(Text::new(value.get(0)?.as_str()?, value.get(1)?.as_str()?))
}

/// A row as a line.
pub(crate) fn line(place: usize, row: &Row) -> String {
    let quantity = |q: &Quantity| json!([q.name, q.symbol, q.unit, both(&q.label)]);
    let numbers = match &row.numbers {
        Ok(list) => json!({"found": list.iter().map(|(v, q)| json!([bits(*v), q.as_ref().map(quantity)])).collect::<Vec<_>>()}),
        Err(n) => json!({"code": n.code, "what": both(&n.what), "why": both(&n.why), "help": both(&n.help)}),
    };
    let audit = row.audit.as_ref().map(|failed| {
        failed.as_ref().map(|a| json!({"key": a.key, "name": both(&a.name), "value": bits(a.value), "limit": bits(a.limit)}))
    });
    let stands = row.stands.as_ref().map(|list| list.iter().map(|s| json!([s.closed, s.stable])).collect::<Vec<_>>());
    let values: Vec<Value> = row.values.iter().map(|(name, value)| json!([name, bits(*value)])).collect();
    let checked = row.audit.is_some();
    summed(
        &json!({"row": place, "values": values, "numbers": numbers, "checked": checked, "audit": audit.flatten(), "stands": stands, "anew": row.anew, "regime": row.regime, "stable": row.stable, "resonance": row.resonance, "other": row.other}),
    )
}

/// A row from a line, with its place.
pub(crate) fn row(line: &str) -> Option<(usize, Row)> {
    let value = unsummed(line)?;
    let place = value.get("row")?.as_u64()? as usize;
    let pair = |v: &Value| Some((v.get(0)?.as_str()?.to_owned(), number(v.get(1)?)?));
    let values = value.get("values")?.as_array()?.iter().map(pair).collect::<Option<Vec<_>>>()?;
    let numbers = value.get("numbers")?;
    let numbers = match numbers.get("found").and_then(Value::as_array) {
        Some(list) => Ok(list.iter().map(found).collect::<Option<Vec<_>>>()?),
        None => Err(trouble(numbers)?),
    };
    let audit = match value.get("audit")? {
        Value::Null => None,
        a => Some(Audit {
            key: a.get("key")?.as_str()?.to_owned(),
            name: text(a.get("name")?)?,
            value: number(a.get("value")?)?,
            limit: number(a.get("limit")?)?,
            ok: false,
        }),
    };
    let stand = |v: &Value| {
        let closed = v.get(0)?.as_array()?.iter().map(|c| c.as_str().map(str::to_owned)).collect::<Option<Vec<_>>>()?;
        Some(Stand { closed, stable: v.get(1)?.as_bool() })
    };
    let stands = match value.get("stands")? {
        Value::Array(list) => Some(list.iter().map(stand).collect::<Option<Vec<_>>>()?),
        _ => None,
    };
    let audit = value.get("checked")?.as_bool()?.then_some(audit);
    let anew = value.get("anew")?.as_u64()? as usize;
    let regime = value.get("regime")?.as_u64().map(|n| n as usize);
    let stable = value.get("stable")?.as_bool();
    let resonance = value.get("resonance")?.as_str().map(str::to_owned);
    let other = value.get("other")?.as_bool()?;
    Some((place, Row { values, numbers, audit, stands, anew, regime, stable, resonance, other }))
}

fn found(value: &Value) -> Option<(f64, Option<Quantity>)> {
    let quantity = match value.get(1)? {
        Value::Null => None,
        q => {
            let part = |i: usize| q.get(i)?.as_str();
            Some(Quantity { symbol: part(1)?.to_owned(), label: text(q.get(3)?)?, ..Quantity::new(part(0)?, part(2)?) })
        }
    };
    Some((number(value.get(0)?)?, quantity))
}

/// A trouble that was told before; its code lives as long as the program, as all codes do.
fn trouble(value: &Value) -> Option<Notice> {
    let code: &'static str = Box::leak(value.get("code")?.as_str()?.to_owned().into_boxed_str());
    let what = text(value.get("what")?)?;
    Some(Notice::new(code, what.en, what.ru).because(text(value.get("why")?)?).cure(text(value.get("help")?)?))
}

/// The rows of an earlier run in their order, as many as fill whole blocks or all of its part; and how many lines stay.
///
/// # Errors
/// The lines are of another sweep (S148), or damaged (S149).
pub(crate) fn earlier(lines: &[String], head: &Head) -> Result<(Vec<Row>, usize), Notice> {
    let Some(first) = lines.first() else { return Ok((Vec::new(), 0)) };
    let found = match Head::read(first) {
        Some(found) => found,
        // nothing but a torn first line
        None if lines.len() == 1 => return Ok((Vec::new(), 0)),
        None => return Err(damaged(1)),
    };
    if found != *head {
        return Err(foreign());
    }
    let range = head.rows();
    let mut rows = Vec::new();
    for (k, line) in lines.iter().enumerate().skip(1) {
        match row(line) {
            Some((place, row)) if place == range.start + rows.len() && range.contains(&place) => rows.push(row),
            None if k + 1 == lines.len() => {}
            _ => return Err(damaged(k + 1)),
        }
    }
    if rows.len() < range.len() {
        rows.truncate(rows.len() / head.count[1] * head.count[1]);
    }
    let kept = rows.len() + 1;
    Ok((rows, kept))
}

pub(crate) fn foreign() -> Notice {
    Notice::new("S148", "the rows that are kept there are of another sweep", "сохранённые там строки относятся к другой серии")
        .why(
            "the model, its values, what is asked, the shard or the version of strutt differs",
            "отличаются модель, её значения, то, что задано, часть серии или версия strutt",
        )
        .help(
            "give the same command as before, or another folder; the rows there are left as they are",
            "задайте ту же команду, что и прежде, или другую папку; имеющиеся строки не тронуты",
        )
}

/// A line that is neither whole nor the last.
pub(crate) fn damaged(line: usize) -> Notice {
    Notice::new(
        "S149",
        format!("line {line} of the rows that are kept there is damaged"),
        format!("строка {line} сохранённых данных повреждена"),
    )
    .why("its checksum does not fit, or a row is missing before it", "её контрольная сумма не сходится, или перед ней пропущена строка")
    .help(
        "cut the file before that line to go on from there, or take another folder; the file is left as it is",
        "обрежьте файл перед этой строкой, чтобы продолжить с неё, или возьмите другую папку; файл не изменён",
    )
}

/// The rows of all parts of a sweep as the lines of the whole.
///
/// # Errors
/// A part is missing or not finished (S160), of another sweep (S148), damaged (S149).
pub fn merged(parts: &[Vec<String>]) -> Result<(Head, Vec<String>), Notice> {
    let heads = parts.iter().map(|lines| lines.first().and_then(|line| Head::read(line)).ok_or_else(|| damaged(1)));
    let heads = heads.collect::<Result<Vec<Head>, Notice>>()?;
    let first = heads.first().ok_or_else(|| lacking(1))?;
    let whole = Head { shard: WHOLE, ..first.clone() };
    let mut lines = vec![whole.line().trim_end().to_owned()];
    for part in 1..=first.shard[1] {
        let k = heads.iter().position(|head| head.shard[0] == part).ok_or_else(|| lacking(part))?;
        if heads[k] != (Head { shard: [part, first.shard[1]], ..whole.clone() }) {
            return Err(foreign());
        }
        let (rows, _) = earlier(&parts[k], &heads[k])?;
        if rows.len() < heads[k].rows().len() {
            return Err(lacking(part));
        }
        lines.extend(rows.iter().zip(heads[k].rows()).map(|(row, place)| line(place, row).trim_end().to_owned()));
    }
    Ok((whole, lines))
}

fn lacking(part: usize) -> Notice {
    Notice::new(
        "S160",
        format!("part {part} of the sweep is missing or not finished"),
        format!("часть {part} серии отсутствует или не закончена"),
    )
    .help(
        format!("run it with --shard {part}/n --resume, and name its folder too"),
        format!("выполните её с ключами --shard {part}/n --resume и укажите и её папку"),
    )
}

/// The table of finished rows.
pub(crate) fn columns(head: &Head) -> (usize, Vec<Column>, Vec<Noted>) {
    let (own, names) = &head.columns;
    let quantity = |[name, unit]: &[String; 2]| Quantity::new(name, unit);
    let columns: Vec<Column> = names.iter().map(|c| Column { quantity: quantity(c), values: Vec::new() }).collect();
    let noted = names[*own..].iter().map(|c| (quantity(c), crate::observable::Observable::field(&c[0]))).collect();
    (*own, columns, noted)
}
