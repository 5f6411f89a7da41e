//! PDF by a program that is installed: a browser prints HTML, typst and LaTeX compile their own.

use report::formats::{Format, Press, TABLE};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use words::Notice;

/// Browsers that print without a window.
const BROWSERS: &[&str] = &["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge", "microsoft-edge"];
const TYPST: &[&str] = &["typst"];
const LATEX: &[&str] = &["xelatex", "lualatex", "pdflatex"];
/// Characters of a program's complaint that are shown.
const SHOWN: usize = 400;

/// Prints a page that was written; the path of the PDF.
///
/// # Errors
/// The format is not printed (C061), no program for it is installed (C062), the program fails (C063).
pub fn print(page: &Path, format: &Format) -> Result<PathBuf, Notice> {
    let (press, programs) = printed(format)?;
    let program = programs.iter().find_map(|name| found(name)).ok_or_else(|| not_installed(programs, page))?;
    let pdf = page.with_extension("pdf");
    let before = std::fs::metadata(&pdf).and_then(|m| m.modified()).ok();
    let said = match press {
        Press::Browser => browse(&program, page, &pdf),
        Press::Typst => run(Command::new(&program).arg("compile").arg(page).arg(&pdf)),
        Press::Latex => compile(&program, page).and_then(|_| compile(&program, page)),
    };
    let after = std::fs::metadata(&pdf).and_then(|m| m.modified()).ok();
    match said {
        Ok(_) if after.is_some() && after != before => Ok(pdf),
        Ok(said) | Err(said) => Err(failed(&program, &said)),
    }
}

/// Programs that print a format.
///
/// # Errors
/// There are none (C061).
pub fn printed(format: &Format) -> Result<(Press, &'static [&'static str]), Notice> {
    let press = format.page().and_then(|page| page.press).ok_or_else(|| not_printed(format.name))?;
    let programs = match press {
        Press::Browser => BROWSERS,
        Press::Typst => TYPST,
        Press::Latex => LATEX,
    };
    Ok((press, programs))
}

/// The program of that name on the path.
pub(crate) fn found(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let names = [name.to_owned(), format!("{name}.exe")];
    std::env::split_paths(&folders).flat_map(|folder| names.iter().map(move |n| folder.join(n)).collect::<Vec<_>>()).find(|p| p.is_file())
}

/// A browser prints; where its sandbox is forbidden, it prints our own page without one.
fn browse(program: &Path, page: &Path, pdf: &Path) -> Result<String, String> {
    let page = std::fs::canonicalize(page).unwrap_or_else(|_| page.to_path_buf());
    let mut target = OsString::from("--print-to-pdf=");
    target.push(pdf);
    let command = |more: &[&str]| {
        let mut command = Command::new(program);
        command.args(["--headless", "--disable-gpu", "--no-pdf-header-footer"]).args(more).arg(&target).arg(&page);
        run(&mut command)
    };
    let first = command(&[]);
    if first.is_ok() && pdf.is_file() { first } else { command(&["--no-sandbox"]) }
}

fn compile(program: &Path, page: &Path) -> Result<String, String> {
    let folder = page.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = page.file_name().unwrap_or(page.as_os_str());
    run(Command::new(program).arg("-interaction=nonstopmode").arg("-halt-on-error").arg(name).current_dir(folder))
}

/// What a program says; an error where it does not end well.
fn run(command: &mut Command) -> Result<String, String> {
    let output = command.stdin(Stdio::null()).output().map_err(|error| error.to_string())?;
    let said = if output.stderr.is_empty() { output.stdout } else { output.stderr };
    let said = String::from_utf8_lossy(&said).trim().to_owned();
    if output.status.success() { Ok(said) } else { Err(said) }
}

fn not_printed(format: &str) -> Notice {
    let fit = TABLE.iter().filter(|format| format.page().is_some_and(|page| page.press.is_some())).map(|format| format.name);
    let fit = fit.collect::<Vec<_>>().join(" | ");
    Notice::new("C061", format!("no PDF is made of the format {format}"), format!("из формата {format} PDF не делается"))
        .help(format!("use --format {fit}"), format!("укажите --format {fit}"))
}

fn not_installed(programs: &[&str], page: &Path) -> Notice {
    let (list, page) = (programs.join(", "), page.display());
    Notice::new("C062", "no program that makes a PDF was found", "не найдена программа, которая делает PDF")
        .why(
            format!("none of these is on the path: {list}; the page itself is written: {page}"),
            format!("ни одной из программ нет в PATH: {list}; сама страница записана: {page}"),
        )
        .help(
            "open the page in any browser and print it to a file (Ctrl+P, A4)",
            "откройте страницу в любом браузере и напечатайте её в файл (Ctrl+P, A4)",
        )
}

fn failed(program: &Path, said: &str) -> Notice {
    let program = program.display();
    let end = said.chars().count().saturating_sub(SHOWN);
    let said: String = said.chars().skip(end).collect();
    Notice::new("C063", format!("{program} made no PDF"), format!("программа {program} не сделала PDF"))
        .why(said.clone(), said)
        .help("open the page in a browser and print it to a file", "откройте страницу в браузере и напечатайте её в файл")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_without_pages_is_refused_and_a_missing_program_is_named() {
        assert_eq!(print(Path::new("a.md"), &report::formats::markdown::FORMAT).unwrap_err().code, "C061");
        let notice = not_installed(TYPST, Path::new("a.typ"));
        assert!(notice.why.en.contains("typst") && notice.why.ru.contains("a.typ"));
        assert!(found("no-such-program-of-anybody").is_none());
    }
}
