//! Help in the user's language, and the three commands that it begins with.

use crate::args::Cli;
use clap::{Command, CommandFactory};
use report::Language;

const FIRST_EN: &str = "Three commands to begin with:
  strutt examples                             see the ready models
  strutt new pendulum-on-shaft                copy one into this folder
  strutt run pendulum-on-shaft.toml           equations, motion, plots, a page
";
const FIRST_RU: &str = "Три команды для начала:
  strutt examples                             посмотреть готовые модели
  strutt new pendulum-on-shaft                скопировать одну из них в эту папку
  strutt run pendulum-on-shaft.toml           уравнения, движение, графики, страница
";
const TEMPLATE_EN: &str = "{before-help}{about}\n\nUsage: {usage}\n\n{all-args}{after-help}";
const TEMPLATE_RU: &str = "{before-help}{about}\n\nВызов: {usage}\n\n{all-args}{after-help}";
const CODES_EN: &str = "Exit codes: 0 done; 1 the model, a calculation or a check failed; 2 wrong use; 130 interrupted, what was done is kept.";
const CODES_RU: &str =
    "Коды возврата: 0 – сделано; 1 – ошибка модели, расчёта или проверки; 2 – неверный вызов; 130 – прервано, сделанное сохранено.";

/// The whole command line in a language.
pub fn command(language: Language) -> Command {
    let command = Cli::command().before_help(language.pick(FIRST_EN, FIRST_RU)).after_help(language.pick(CODES_EN, CODES_RU));
    match language {
        Language::En => command.help_template(TEMPLATE_EN),
        Language::Ru => russian(command, ""),
    }
}

fn russian(command: Command, path: &str) -> Command {
    let find = |key: &str| RUSSIAN.iter().find(|row| row.0 == key).map(|row| row.1);
    let name = command.get_name().to_owned();
    let here = if path.is_empty() { String::new() } else { name };
    let mut command = command.help_template(TEMPLATE_RU).subcommand_help_heading("Команды").subcommand_value_name("КОМАНДА");
    if let Some(about) = find(&here) {
        command = command.about(about).long_about(about);
    }
    command = command.mut_args(|arg| {
        let heading = if arg.is_positional() { "Аргументы" } else { "Ключи" };
        let id = arg.get_id().as_str().to_owned();
        let help = find(&format!("{here}.{id}")).or_else(|| find(&format!(".{id}")));
        let arg = arg.help_heading(heading);
        match help {
            Some(help) => arg.help(help),
            None => arg,
        }
    });
    command.mut_subcommands(|sub| russian(sub, "sub"))
}

/// `command` or `command.argument` or `.argument` of any command; the Russian text.
const RUSSIAN: &[(&str, &str)] = &[
    ("", "Динамика и колебания машин: из одного текстового файла – уравнения, движения и записанный расчёт."),
    ("run", "Выполнить все расчёты файла модели; таблицы, графики и страница – в out/<имя>/"),
    ("check", "Найти все ошибки файла модели"),
    ("equations", "Вывести уравнения движения"),
    ("simulate", "Рассчитать движение"),
    ("equilibrium", "Найти положения равновесия"),
    ("examples", "Показать список примеров или один пример"),
    ("new", "Записать файл модели, с которого можно начать"),
    ("explain", "Объяснить код сообщения"),
    ("completions", "Напечатать скрипт автодополнения для командной оболочки"),
    (".lang", "Язык вывода; иначе из LC_ALL, LC_MESSAGES, LANG"),
    (".quiet", "Печатать только данные и ошибки"),
    (".json", "Данные в формате JSON в стандартный вывод"),
    (".csv", "Данные в формате CSV в стандартный вывод"),
    (".timings", "Показать время каждого этапа (в стандартный поток ошибок)"),
    (".file", "Файл модели, папка с model.toml или - для стандартного ввода"),
    (".overrides", "Заменить параметр (m=\"10 г\"), начальное значение (phi=0.1) или начальную скорость (\"phi'=30\")"),
    ("run.out", "Папка для результатов [по умолчанию: out/<имя модели>]"),
    ("check.format", "Вид замечаний: со строкой файла или по одной строке для редакторов"),
    ("equations.form", "Вид формул"),
    ("equations.steps", "Показать вывод по шагам"),
    ("simulate.until", "Конец движения: 30, 30с, \"2 мин\""),
    ("simulate.tolerance", "Относительная точность шага, 1e-15 ... 1e-3 [по умолчанию: 1e-12]"),
    ("simulate.at", "Результаты точно в эти моменты: 0,0.5,10 (или \"0;0,5;10\")"),
    ("simulate.every", "Результаты через равные промежутки времени"),
    ("simulate.outputs", "Столбцы по именам, в этом порядке: phi,phi',omega_p"),
    ("simulate.out", "Записать также таблицы, графики и страницу в эту папку"),
    ("examples.name", "Пример, который надо напечатать"),
    ("new.name", "Имя файла, с .toml или без него; имя примера копирует этот пример"),
    ("new.from", "Пример, который надо скопировать"),
    ("new.count", "Число маятников для n-pendulum"),
    ("explain.code", "Код, как в ошибка[M012]; без него печатаются все коды"),
    ("completions.shell", "Оболочка"),
    (".help", "Показать справку"),
    (".version", "Показать версию"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        command(Language::En).debug_assert();
        command(Language::Ru).debug_assert();
    }

    #[test]
    fn every_help_text_has_a_russian_one() {
        let command = command(Language::Ru);
        let russian = |text: String| text.chars().any(|c| ('а'..='я').contains(&c));
        for sub in command.get_subcommands() {
            assert!(sub.get_about().is_some_and(|a| russian(a.to_string())), "{}", sub.get_name());
            for arg in sub.get_arguments() {
                assert!(arg.get_help().is_none_or(|h| russian(h.to_string())), "{} {}", sub.get_name(), arg.get_id());
            }
        }
    }
}
