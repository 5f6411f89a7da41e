//! Moving pictures as files: SVG that plays by itself; MP4 where ffmpeg is installed.

use crate::folder::{inputs, pixels};
use crate::pdf::found;
use crate::shelf::Shelf;
use crate::wording::Word;
use report::scheme::Moving;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use studies::pipeline::Calculation;
use words::{Language, Notice, Text};

/// Pictures a second of a film.
const RATE: f64 = 25.0;
/// Seconds of a film at most.
const LONGEST: f64 = 20.0;
/// Pictures of an SVG.
const FRAMES: [f64; 2] = [60.0, 400.0];

/// What was written.
#[derive(Debug, Default)]
pub struct Films {
    /// Files.
    pub paths: Vec<PathBuf>,
    /// Why there is nothing, or no MP4.
    pub without: Option<Text>,
}

/// Writes the moving pictures of all studies.
///
/// # Errors
/// A file would replace an input (C052), the disk refuses (C005), ffmpeg fails (C080).
pub fn write(calculation: &Calculation, folder: &Path, language: Language) -> Result<Films, Box<Notice>> {
    let machine = &calculation.machine;
    let mut movies: Vec<(String, Moving)> = Vec::new();
    for (i, results) in calculation.results.iter().enumerate() {
        let number = if calculation.results.len() > 1 { format!("-{}", i + 1) } else { String::new() };
        let played = studies::scheme::played(machine, results, language);
        movies.extend(played.into_iter().map(|m| (format!("{}-{}{number}", results.stem(), m.scheme.name), m)));
    }
    if movies.is_empty() {
        let without = Text::new(
            "no moving picture: no study of the file has a motion that is drawn",
            "движущихся картинок нет: ни один расчёт файла не даёт движения, которое можно нарисовать",
        );
        return Ok(Films { without: Some(without), ..Films::default() });
    }
    let inputs = inputs(&machine.origin.source, &machine.model);
    let mut shelf = Shelf::open(folder, &inputs)?;
    for (name, moving) in &movies {
        shelf.put(&format!("{name}.svg"), Word::Movie, moving.animated(frames(moving), language).as_bytes())?;
    }
    let mut films = Films { paths: shelf.close()?, without: None };
    let Some(program) = found("ffmpeg") else {
        films.without = Some(Text::new(
            "no MP4: ffmpeg is not on the path; the moving SVG plays in any browser",
            "MP4 не записан: программы ffmpeg нет в PATH; движущийся SVG проигрывается в любом браузере",
        ));
        return Ok(films);
    };
    for (name, moving) in &movies {
        let target = folder.join(format!("{name}.mp4"));
        film(&program, (moving, language), &target)?;
        films.paths.push(target);
    }
    Ok(films)
}

/// As many pictures as a film of it has, within bounds.
fn frames(moving: &Moving) -> usize {
    (moving.span() / moving.pace() * RATE).clamp(FRAMES[0], FRAMES[1]) as usize
}

/// Hands the pictures to ffmpeg one by one.
fn film(program: &Path, (moving, language): (&Moving, Language), target: &Path) -> Result<(), Box<Notice>> {
    let seconds = (moving.span() / moving.pace()).min(LONGEST);
    let moving = moving.even((seconds * RATE).max(2.0) as usize);
    let mut command = Command::new(program);
    // the codec wants even numbers of pixels
    command.args(["-y", "-loglevel", "error", "-f", "image2pipe", "-framerate", "25", "-c:v", "png", "-i", "-"]);
    command.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]).arg(target);
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().map_err(|e| failed(&e.to_string()))?;
    if let Some(mut pipe) = child.stdin.take() {
        for k in 0..moving.times.len() {
            let picture = pixels(&moving.frame(k, language), "frame")?;
            if pipe.write_all(&picture).is_err() {
                // what it says tells why it hears no more
                break;
            }
        }
    }
    let output = child.wait_with_output().map_err(|e| failed(&e.to_string()))?;
    match output.status.success() && target.is_file() {
        true => Ok(()),
        false => Err(failed(String::from_utf8_lossy(&output.stderr).trim())),
    }
}

fn failed(said: &str) -> Box<Notice> {
    let said: String = said.chars().take(400).collect();
    let notice = Notice::new("C080", "ffmpeg made no film", "ffmpeg не сделал фильм")
        .why(said.clone(), said)
        .help("the moving SVG beside it plays in any browser", "движущийся SVG рядом проигрывается в любом браузере");
    Box::new(notice)
}
