//! Files of a class: the list of students, the sheets, the key, what was handed in and what came of it.

use crate::letters::decoded;
use crate::shelf::Shelf;
use crate::wording::Word;
use mechanics::Model;
use mechanics::variants::cells;
use report::Document;
use report::formats::{Sheet, html};
use std::path::{Path, PathBuf};
use studies::pipeline::{self, Calculation};
use studies::variants::cell::{self, Written};
use studies::variants::grade::{Graded, Pupil, grade};
use studies::variants::key::{Entry, Key, quoted};
use studies::variants::solve::reason;
use studies::variants::{Class, Member, guards, quiz, sheet, solve};
use studies::{Failure, Source, Watch};
use words::{Language, Notice, Text};

/// Files: name, what they are, bytes.
type Sheets = Vec<(String, Word, Vec<u8>)>;

/// A row of answers: student, variant, what stands under each item.
type Student = (String, String, Vec<(String, Written)>);

/// Longest part of a file name that is made of a student's name.
const LONGEST: usize = 40;
/// Heads of a column of students, and of one of variants.
const STUDENT: [&str; 8] = ["student", "name", "студент", "фио", "ф.и.о.", "имя", "фамилия", "фамилия имя"];
const VARIANT: [&str; 4] = ["variant", "вариант", "вар.", "№ варианта"];

/// A variant by name: what it replaces, or why it cannot be made.
pub type Members = Vec<(String, Result<Member, Notice>)>;

/// Students with their variants, in the order of the list; every variant once where there is no list.
///
/// # Errors
/// The list cannot be read (C001 ... C003), names a variant that does not exist, or has more students than there are variants (C069).
pub fn students(list: Option<&str>, members: &Members) -> Result<Vec<(String, usize)>, Failure> {
    let Some(path) = list else { return Ok((0..members.len()).map(|i| (String::new(), i)).collect()) };
    let text = decoded(&crate::source::bytes(path)?);
    let mut lines = text.lines().filter(|l| !l.trim().is_empty() && !l.trim_start().starts_with('#')).peekable();
    let separator = separator(lines.peek().copied().unwrap_or_default());
    let mut found = Vec::new();
    for (i, line) in lines.enumerate() {
        let row = cells(line, separator);
        let name = row[0].clone();
        if i == 0 && STUDENT.contains(&name.to_lowercase().as_str()) {
            continue;
        }
        let place = match row.get(1).map(|v| v.trim()).filter(|v| !v.is_empty()) {
            Some(variant) => members.iter().position(|(n, _)| same(n, variant)),
            None => Some(found.len()).filter(|k| *k < members.len()),
        };
        let place = place.ok_or_else(|| misplaced(path, &name, members.len()))?;
        found.push((name, place));
    }
    if found.is_empty() { Err(nobody(path)) } else { Ok(found) }
}

fn separator(line: &str) -> char {
    [';', '\t'].into_iter().find(|c| line.contains(*c)).unwrap_or(',')
}

/// `3`, `03` are one variant.
fn same(a: &str, b: &str) -> bool {
    let number = |t: &str| t.trim().parse::<f64>().ok();
    a.trim() == b.trim() || number(a).is_some_and(|n| number(b) == Some(n))
}

fn misplaced(path: &str, student: &str, count: usize) -> Failure {
    Notice::new(
        "C069",
        format!("{path}: there is no variant for `{student}`; the file has {count}"),
        format!("{path}: для «{student}» нет варианта; всего вариантов {count}"),
    )
    .help("write the variant in a second column: Ivanov; 7", "укажите вариант во втором столбце: Иванов; 7")
    .into()
}

fn nobody(path: &str) -> Failure {
    Notice::new("C069", format!("{path}: there are no students"), format!("{path}: студентов нет"))
        .help("write one student a line", "запишите по студенту в строке")
        .into()
}

/// What is made of a class: tasks and solutions by file name, the key.
pub struct Course {
    /// Name of the file, what it is, its content.
    files: Vec<(String, Word, Vec<u8>)>,
    /// The key.
    pub key: Key,
    /// How often the file was read.
    pub readings: usize,
}

/// Makes every sheet; a variant that fails gets one that says so.
pub fn made(
    class: &mut Class,
    model: &Model,
    (source, members): (&Source, &Members),
    students: &[(String, usize)],
    pass: (&mut Watch, Language),
) -> Course {
    let (watch, language) = pass;
    let mut given = Vec::new();
    let mut course = Course { files: Vec::new(), key: Key::new(source.clone(), Vec::new()), readings: 0 };
    for (i, (student, place)) in students.iter().enumerate() {
        let stem = stem(i, student, &members[*place].0, students.len());
        let (entry, data) = one(class, model, (source, &members[*place]), (student, &stem), (&mut course.files, language));
        course.key.entries.push(entry);
        given.push(data);
        if let Some(progress) = &mut watch.progress {
            progress((i + 1) as f64 / students.len() as f64);
        }
    }
    let (key, title) = (&course.key, Word::Key);
    let page = page(&sheet::key(key, model, language));
    let mut last = vec![
        ("moodle.xml".to_owned(), Word::Quiz, quiz::moodle((key, &given), model, language).into_bytes()),
        ("questions.gift".to_owned(), Word::Quiz, quiz::gift((key, &given), model, language).into_bytes()),
        ("answers.csv".to_owned(), Word::AnswerSheet, key.answers_csv(model).into_bytes()),
        ("key.csv".to_owned(), title, key.to_csv(model).into_bytes()),
        ("key.json".to_owned(), title, format!("{:#}\n", key.to_json(model)).into_bytes()),
        ("key.html".to_owned(), title, page),
    ];
    course.files.append(&mut last);
    course.readings = class.readings;
    course
}

/// The sheets of one student; what the variant is given, in a line.
fn one(
    class: &mut Class,
    model: &Model,
    (source, (name, member)): (&Source, &(String, Result<Member, Notice>)),
    (student, stem): (&str, &str),
    (files, language): (&mut Sheets, Language),
) -> (Entry, String) {
    let mut entry = Entry { student: student.to_owned(), member: Member { name: name.clone(), ..Member::default() }, ..Entry::default() };
    entry.truths = vec![None; model.answers.len()];
    let say = |notice: &Notice| format!("{} [{}]", language.text(&notice.what), notice.code);
    let machine = match member {
        Err(notice) => Err(say(notice)),
        Ok(member) => {
            entry.member = member.clone();
            class.machine(member).map_err(|failure| say(&reason(failure)))
        }
    };
    let (task, solution, given) = match machine {
        Err(why) => {
            entry.failure = why;
            let task = sheet::task(model, None, (source, &entry), language);
            (task, sheet::no_solution(model, (source, &entry), language), String::new())
        }
        Ok(machine) => {
            let solved = solve::solve(machine, &entry.member.given, &mut Watch::default());
            entry.sizes.clone_from(&solved.sizes);
            entry.truths = solved.truths.iter().map(|t| t.as_ref().ok().copied()).collect();
            entry.failure = why(machine, &solved, language);
            let given = sheet::given(machine, language);
            let calculation = Calculation { machine: machine.clone(), results: solved.results, files: Vec::new() };
            let task = sheet::task(model, Some(&calculation), (source, &entry), language);
            (task, sheet::solution(pipeline::report(&calculation, language), model, (source, &entry), language), given)
        }
    };
    files.push((format!("tasks/{stem}.html"), Word::Task, page(&task)));
    files.push((format!("solutions/{stem}.html"), Word::Solution, page(&solution)));
    (entry, given)
}

/// Why a variant cannot be given out; empty where it can.
fn why(machine: &studies::Machine, solved: &solve::Solved, language: Language) -> String {
    let trouble = solved.results.iter().find_map(|r| r.trouble.as_ref());
    let absent = solved.truths.iter().find_map(|t| t.as_ref().err());
    if let Some(notice) = trouble.or(absent) {
        return format!("{} [{}]", language.text(&notice.what), notice.code);
    }
    let broken = guards::broken(machine, solved);
    broken.first().map_or(String::new(), |(name, text)| {
        language.pick(format!("condition `{name}` does not hold: {text}"), format!("не выполнено условие `{name}`: {text}"))
    })
}

/// A safe name of a file: a number, then letters and digits of the student's name, or the variant.
fn stem(place: usize, student: &str, variant: &str, count: usize) -> String {
    let width = count.to_string().len().max(2);
    let named = if student.is_empty() { format!("variant-{variant}") } else { student.to_owned() };
    let mut out = String::new();
    for c in named.chars().take(LONGEST) {
        match c {
            c if c.is_alphanumeric() || c == '_' => out.push(c),
            _ if !out.is_empty() && !out.ends_with('-') => out.push('-'),
            _ => {}
        }
    }
    let out = out.trim_end_matches('-');
    let number = format!("{:0width$}", place + 1);
    if out.is_empty() { number } else { format!("{number}-{out}") }
}

fn page(document: &Document) -> Vec<u8> {
    let page = html::FORMAT.page();
    page.map_or_else(Vec::new, |page| (page.write)(document, &Sheet { width: 0, pictures: &[] }).into_bytes())
}

/// Writes a class into a folder, all files or none; the paths, the key last.
///
/// # Errors
/// A file would replace an input (C052), or the disk refuses (C005).
/// Or the table of answers has been filled in since (C052).
pub fn write(course: &Course, folder: &Path, inputs: &[PathBuf]) -> Result<Vec<PathBuf>, Box<Notice>> {
    let filled = |(name, what, _): &&(String, Word, Vec<u8>)| *what == Word::AnswerSheet && is_filled(&folder.join(name));
    if let Some((name, ..)) = course.files.iter().find(filled) {
        return Err(Box::new(answers_kept(&folder.join(name))));
    }
    put(&course.files, folder, inputs)
}

/// Whether a table of answers holds any: something stands in a row behind the name and the variant.
fn is_filled(path: &Path) -> bool {
    let Ok(bytes) = std::fs::read(path) else { return false };
    let text = decoded(&bytes);
    let mut rows = text.lines().filter(|line| !line.trim_start_matches('\u{feff}').starts_with('#'));
    let separator = if rows.next().is_some_and(|heads| heads.contains(';')) { ';' } else { ',' };
    rows.any(|row| cells(row, separator).iter().skip(2).any(|cell| !cell.trim().is_empty()))
}

fn answers_kept(path: &Path) -> Notice {
    let path = path.display();
    Notice::new(
        "C052",
        format!("`{path}` has been filled in; nothing was written"),
        format!("таблица `{path}` уже заполнена; ничего не записано"),
    )
    .why("an empty one would take its place", "её заменила бы пустая таблица")
    .help("choose another folder with --out, or move the table", "укажите другую папку ключом --out или переместите таблицу")
}

fn put(files: &[(String, Word, Vec<u8>)], folder: &Path, inputs: &[PathBuf]) -> Result<Vec<PathBuf>, Box<Notice>> {
    let mut shelf = Shelf::open(folder, inputs)?;
    for below in ["tasks", "solutions", "reports"] {
        if files.iter().any(|f| f.0.starts_with(below)) {
            let path = folder.join(below);
            std::fs::create_dir_all(&path).map_err(|error| crate::files::refused(&path, &error))?;
        }
    }
    for (name, what, bytes) in files {
        shelf.put(name, *what, bytes)?;
    }
    shelf.close()
}

/// A key and the model that it was made of.
///
/// # Errors
/// The file cannot be read (C001 ... C003) or is no key (C070).
pub fn key(path: &str) -> Result<(Key, Model), Failure> {
    let place = Path::new(path);
    let file = match place.is_dir() {
        true => place.join("key.json"),
        // the table of the key stands beside the key itself
        false if place.extension().is_some_and(|e| e == "csv") => place.with_extension("json"),
        false => place.to_path_buf(),
    };
    let file = file.to_string_lossy().into_owned();
    let value: serde_json::Value = serde_json::from_slice(&crate::source::bytes(&file)?).map_err(|_| no_key(&file))?;
    let source = Key::source_of(&value).ok_or_else(|| no_key(&file))?;
    let model = studies::read(&source, &[]).map_err(|_| no_key(&file))?.model;
    let key = Key::from_json(&value, source, &model).ok_or_else(|| no_key(&file))?;
    Ok((key, model))
}

fn no_key(path: &str) -> Failure {
    Notice::new("C070", format!("`{path}` is no key of strutt, or was changed"), format!("`{path}` — не ключ strutt или он изменён"))
        .help("give the key.json that `strutt variants make` wrote", "укажите key.json, записанный командой `strutt variants make`")
        .into()
}

/// What was handed in: a row for each student.
pub struct Handed {
    /// Name, variant, cells in the order of the questions.
    rows: Vec<Student>,
    /// What is to be said of the file.
    remarks: Vec<Text>,
}

/// Reads a file with answers.
///
/// # Errors
/// It cannot be read (C001 ... C003, C072), or belongs to another model (C071).
pub fn handed(path: &str, (key, model): (&Key, &Model)) -> Result<Handed, Failure> {
    let text = decoded(&crate::source::bytes(path)?);
    if let Some(other) = text.lines().take_while(|l| l.starts_with('#')).find_map(|l| l.rsplit_once("model ")).map(|(_, h)| h.trim())
        && other.trim_end_matches([';', ',']) != key.hash()
    {
        return Err(another(path, &format!("{other}, {}", key.hash())));
    }
    let mut lines = text.lines().filter(|l| !l.trim().is_empty() && !l.trim_start().starts_with('#'));
    let head = lines.next().ok_or_else(|| unreadable(path, "there is nothing in it", "файл пуст"))?;
    let separator = separator(head);
    let heads = cells(head, separator);
    let plain: Vec<String> = heads.iter().map(|h| h.to_lowercase()).collect();
    let find = |names: &[&str]| plain.iter().position(|h| names.contains(&h.as_str()));
    let (student, variant) = (find(&STUDENT), find(&VARIANT));
    if student.is_none() && variant.is_none() {
        return Err(unreadable(path, "no column is called student or variant", "нет столбца student (студент) или variant (вариант)"));
    }
    let split: Vec<(String, Option<String>)> = heads.iter().map(|h| named(h)).collect();
    let columns: Vec<Option<usize>> =
        model.answers.iter().map(|a| split.iter().position(|(n, _)| n.to_lowercase() == a.id.to_lowercase())).collect();
    // some columns that are no questions are a teacher's own; with questions that nobody answers they are another task
    let missing = columns.iter().any(Option::is_none);
    if columns.iter().all(Option::is_none) || missing && !foreign(&split, &columns, [student, variant]).is_empty() {
        return Err(another(path, &heads.join(", ")));
    }
    let mut handed = Handed { rows: Vec::new(), remarks: strangers(&split, &columns, [student, variant]) };
    for line in lines {
        let row = cells(line, separator);
        let cell = |i: Option<usize>| i.and_then(|i| row.get(i)).cloned().unwrap_or_default();
        if row.len() > heads.len() {
            let (n, m) = (row.len(), heads.len());
            handed.remarks.push(Text::new(
                format!("the row `{line}` has {n} cells and the head {m}: decimal commas between commas stand in quotes; the row is left ungraded"),
                format!("в строке «{line}» клеток {n}, а в заголовке {m}: при разделителе-запятой числа с десятичной запятой берут в кавычки; строка не проверена"),
            ));
            continue;
        }
        let answer = |(a, column): (&mechanics::model::AnswerDecl, &Option<usize>)| {
            let text = cell(*column);
            let unit = column.and_then(|i| split[i].1.as_deref());
            let written = cell::read(&text, unit, &a.unit);
            (text, written)
        };
        handed.rows.push((cell(student), cell(variant), model.answers.iter().zip(&columns).map(answer).collect()));
    }
    Ok(handed)
}

/// `f1 [Hz]`, `f1, Гц`.
fn named(head: &str) -> (String, Option<String>) {
    let unit = |u: &str| Some(u.trim().to_owned()).filter(|u| !u.is_empty());
    match head.strip_suffix(']').and_then(|h| h.split_once('[')).or_else(|| head.split_once(',')) {
        Some((name, label)) => (name.trim().to_owned(), unit(label)),
        None => (head.trim().to_owned(), None),
    }
}

/// Columns that are neither questions nor known.
fn foreign<'h>(heads: &'h [(String, Option<String>)], columns: &[Option<usize>], known: [Option<usize>; 2]) -> Vec<&'h str> {
    (0..heads.len())
        .filter(|i| !columns.contains(&Some(*i)) && !known.contains(&Some(*i)) && !heads[*i].0.is_empty())
        .map(|i| heads[i].0.as_str())
        .collect()
}

/// What is said of columns that nobody asked for.
fn strangers(heads: &[(String, Option<String>)], columns: &[Option<usize>], known: [Option<usize>; 2]) -> Vec<Text> {
    let foreign = foreign(heads, columns, known);
    let list = foreign.join(", ");
    let one = || {
        Text::new(format!("columns that are no questions of the key: {list}"), format!("столбцы, которых нет среди вопросов ключа: {list}"))
    };
    if foreign.is_empty() { Vec::new() } else { vec![one()] }
}

fn another(path: &str, what: &str) -> Failure {
    Notice::new(
        "C071",
        format!("`{path}` does not answer the questions of this key ({what})"),
        format!("`{path}` отвечает не на вопросы этого ключа ({what})"),
    )
    .help(
        "take the key of the same task; answers.csv beside it has the right columns",
        "возьмите ключ того же задания; нужные столбцы есть в answers.csv рядом с ним",
    )
    .into()
}

fn unreadable(path: &str, en: &str, ru: &str) -> Failure {
    Notice::new("C072", format!("`{path}`: {en}"), format!("`{path}`: {ru}")).into()
}

/// A class with what came of it, and what is to be said.
pub struct Graduation {
    /// Students of the key, in its order; none for those who handed in nothing. Of a key without names: who handed in, in their order.
    pub rows: Vec<(Entry, Option<Vec<Graded>>)>,
    /// Rows without a student, other remarks.
    pub remarks: Vec<Text>,
}

/// Grades what was handed in.
pub fn graded((key, model): (&Key, &Model), handed: &Handed, watch: &mut Watch) -> Graduation {
    let mut class = Class::new(key.source.clone(), mechanics::derive::Detail::Equations);
    let named = key.entries.iter().any(|e| !e.student.is_empty());
    let rows = if named { key.entries.iter().map(|e| (e.clone(), None)).collect() } else { Vec::new() };
    let mut graduation = Graduation { rows, remarks: handed.remarks.clone() };
    for (k, (student, variant, cells)) in handed.rows.iter().enumerate() {
        if let Some(i) = place(key, student, variant) {
            // whoever takes a variant of a key without names is a student of the class
            let of = if named { i } else { graduation.seat(&key.entries[i], student) };
            let row = &mut graduation.rows[of];
            if row.1.is_some() {
                graduation.remarks.push(Text::new(
                    format!("handed in twice, the first counts: {}", row.0.name()),
                    format!("сдано дважды, засчитана первая строка: {}", row.0.name()),
                ));
            } else {
                let neighbours = neighbours(key, i);
                let pupil = Pupil {
                    member: &key.entries[i].member,
                    truths: &key.entries[i].truths,
                    sizes: &key.entries[i].sizes,
                    neighbours: &neighbours,
                };
                row.1 = Some(grade(&mut class, &model.answers, &pupil, cells));
            }
        } else {
            let remark = Text::new(format!("not in the key: {student} {variant}"), format!("нет в ключе: {student} {variant}"));
            graduation.remarks.push(remark);
        }
        if let Some(progress) = &mut watch.progress {
            progress((k + 1) as f64 / handed.rows.len() as f64);
        }
    }
    graduation
}

impl Graduation {
    /// The row of a student who took a variant; a new one where there is none.
    fn seat(&mut self, entry: &Entry, student: &str) -> usize {
        let same = |(e, _): &(Entry, _)| plain(&e.student) == plain(student) && e.member.name == entry.member.name;
        self.rows.iter().position(same).unwrap_or_else(|| {
            self.rows.push((Entry { student: student.trim().to_owned(), ..entry.clone() }, None));
            self.rows.len() - 1
        })
    }
}

/// A name as it is compared: case, spaces, marks and ё do not matter.
fn plain(name: &str) -> String {
    let letters: String = name.to_lowercase().replace('ё', "е").chars().map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    let words = letters.split_whitespace().collect::<Vec<_>>().join(" ");
    if words.is_empty() { name.trim().to_owned() } else { words }
}

/// The student of a row: by name, else by variant where only one student has it.
fn place(key: &Key, student: &str, variant: &str) -> Option<usize> {
    let mut by_name = (0..key.entries.len()).filter(|i| !student.trim().is_empty() && plain(&key.entries[*i].student) == plain(student));
    let mut of_variant = (0..key.entries.len()).filter(|i| !variant.is_empty() && same(&key.entries[*i].member.name, variant));
    match (by_name.next(), by_name.next()) {
        (Some(i), None) => Some(i),
        // two students of one name are told apart by their variants
        (Some(_), Some(_)) => of_variant.find(|i| plain(&key.entries[*i].student) == plain(student)),
        (None, _) => of_variant
            .next()
            .filter(|_| of_variant.next().is_none() && (student.trim().is_empty() || key.entries.iter().all(|e| e.student.is_empty()))),
    }
}

/// Right numbers of the variants before and behind one.
fn neighbours(key: &Key, i: usize) -> Vec<(String, Vec<Option<f64>>)> {
    let own = &key.entries[i].member;
    let beside = |e: &&Entry| (e.member.given.number - own.given.number).abs() == 1.0;
    key.entries.iter().filter(beside).map(|e| (e.member.name.clone(), e.truths.clone())).collect()
}

/// The table of a class as CSV: a verdict and a remark for each item.
pub fn to_csv(model: &Model, graduation: &Graduation, language: Language) -> String {
    let heads: String = model.answers.iter().map(|a| format!(",{0},{0}_verdict,{0}_remark", a.id)).collect();
    let mut out = format!("student,variant{heads},right\n");
    for (entry, graded) in &graduation.rows {
        out.push_str(&format!("{},{}", quoted(&entry.student), quoted(&entry.member.name)));
        for i in 0..model.answers.len() {
            let item = graded.as_ref().and_then(|g| g.get(i));
            let words = item.and_then(|g| g.likeness.as_ref()).map(|l| l.words());
            let (given, verdict) = item.map_or(("", "missing"), |g| (g.given.as_str(), g.verdict.key()));
            out.push_str(&format!(",{},{verdict},{}", quoted(given), quoted(words.as_ref().map_or("", |w| language.text(w)))));
        }
        let counted = graded.as_ref().map_or(String::new(), |g| g.iter().filter(|g| g.verdict.counts()).count().to_string());
        out.push_str(&format!(",{counted}\n"));
    }
    out
}

/// The same as JSON.
pub fn to_json(model: &Model, graduation: &Graduation, language: Language) -> serde_json::Value {
    use serde_json::json;
    let item = |(a, g): (&mechanics::model::AnswerDecl, &Graded)| {
        let wrong = if let studies::variants::grade::Verdict::Wrong(share) = g.verdict { json!(share) } else { serde_json::Value::Null };
        json!({"id": a.id, "given": g.given, "verdict": g.verdict.key(), "off": wrong,
            "likeness": g.likeness.as_ref().map(|l| language.text(&l.words()).to_owned())})
    };
    let row = |(entry, graded): &(Entry, Option<Vec<Graded>>)| {
        let items: Vec<serde_json::Value> = model.answers.iter().zip(graded.iter().flatten()).map(item).collect();
        let right = graded.as_ref().map(|g| g.iter().filter(|g| g.verdict.counts()).count());
        json!({"student": entry.student, "variant": entry.member.name, "right": right, "items": items})
    };
    let remarks: Vec<&str> = graduation.remarks.iter().map(|r| language.text(r)).collect();
    json!({"students": graduation.rows.iter().map(row).collect::<Vec<_>>(), "remarks": remarks})
}

/// Writes a report for each student and the table of the class.
///
/// # Errors
/// A file would replace an input (C052), or the disk refuses (C005).
pub fn reports(
    (key, model): (&Key, &Model),
    graduation: &Graduation,
    (folder, inputs): (&Path, &[PathBuf]),
    language: Language,
) -> Result<Vec<PathBuf>, Box<Notice>> {
    let mut files = Vec::new();
    for (i, (entry, graded)) in graduation.rows.iter().enumerate() {
        if let Some(graded) = graded {
            let stem = stem(i, &entry.student, &entry.member.name, graduation.rows.len());
            let document = sheet::report(model, (&key.source, entry), graded, (&[], language));
            files.push((format!("reports/{stem}.html"), Word::Grades, page(&document)));
        }
    }
    let document = sheet::class(key, model, &graduation.rows, (&graduation.remarks, language));
    files.push(("class.csv".to_owned(), Word::Grades, to_csv(model, graduation, language).into_bytes()));
    files.push(("class.html".to_owned(), Word::Grades, page(&document)));
    put(&files, folder, inputs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_safe_and_tell_students_apart() {
        assert_eq!(stem(0, "Иванова Анна", "1", 30), "01-Иванова-Анна");
        assert_eq!(stem(1, "../../etc/passwd", "1", 30), "02-etc-passwd");
        assert_eq!(stem(2, "\u{202e}\"<>|?*\n", "1", 300), "003");
        assert_eq!(stem(3, "", "7", 5), "04-variant-7");
        assert!(stem(4, &"я".repeat(500), "1", 5).chars().count() <= LONGEST + 3);
    }

    #[test]
    fn heads_carry_units() {
        assert_eq!(named("f1 [Hz]"), ("f1".into(), Some("Hz".into())));
        assert_eq!(named("f1, Гц"), ("f1".into(), Some("Гц".into())));
        assert_eq!(named(" f1 "), ("f1".into(), None));
    }
}
