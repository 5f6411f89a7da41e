//! Help in the user's language, and the three commands that it begins with.

use crate::args::Cli;
use clap::builder::PossibleValuesParser;
use clap::error::{ContextKind, ErrorKind};
use clap::{Arg, ArgAction, ArgMatches, Command, CommandFactory};
use report::formats::TABLE;
use words::Language;

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
const CODES_EN: &str =
    "Exit codes: 0 done; 1 the model, a calculation or a check failed; 2 wrong use; 130 interrupted, what was done is kept.";
const CODES_RU: &str =
    "Коды возврата: 0 – сделано; 1 – ошибка модели, расчёта или проверки; 2 – неверный вызов; 130 – прервано, сделанное сохранено.";

/// The whole command line in a language.
pub fn command(language: Language) -> Command {
    let command = with_formats(with_studies(Cli::command(), language), language)
        .before_help(language.pick(FIRST_EN, FIRST_RU))
        .after_help(language.pick(CODES_EN, CODES_RU));
    match language {
        Language::En => command.help_template(TEMPLATE_EN),
        Language::Ru => russian(command.subcommand(Command::new("help").arg(Arg::new("command").value_name("COMMAND"))), ""),
    }
}

/// The commands of studies behind those that read and show a model.
fn with_studies(command: Command, language: Language) -> Command {
    let before = command.get_subcommands().position(|sub| sub.get_name() == "section").unwrap_or(0);
    let order = |i: usize| if i < before { i } else { i + AFTER_STUDIES };
    let mut place = 0..;
    let command = command.mut_subcommands(|sub| {
        let at = order(place.next().unwrap_or(0));
        sub.display_order(at)
    });
    crate::line::commands(language).enumerate().fold(command, |command, (i, sub)| command.subcommand(sub.display_order(before + i)))
}

/// `--format` of the commands that show a calculation, made of the rows of the formats.
fn with_formats(command: Command, language: Language) -> Command {
    let of = |command: &Command| matches!(command.get_name(), "run" | "report" | "equations" | "claims") || is_study(command.get_name());
    command.mut_subcommands(|sub| if of(&sub) { sub.arg(format(language)) } else { sub })
}

fn is_study(name: &str) -> bool {
    studies::find(name).is_some_and(|study| study.has_command())
}

fn format(language: Language) -> Arg {
    let rows: Vec<String> = TABLE.iter().map(|row| format!("{} – {}", row.name, language.pick(row.help.0, row.help.1))).collect();
    let what = language.pick("Format of the page, or of the data", "Формат страницы или данных");
    let names = PossibleValuesParser::new(TABLE.map(|row| row.name));
    Arg::new("format")
        .long("format")
        .value_name("NAME")
        .value_parser(names)
        .hide_possible_values(true)
        .help(format!("{what}: {}", rows.join("; ")))
}

/// More than there are studies.
const AFTER_STUDIES: usize = 100;

fn russian(command: Command, path: &str) -> Command {
    let find = |key: &str| RUSSIAN.iter().find(|row| row.0 == key).map(|row| row.1);
    let above = path.strip_prefix("strutt").map(str::trim_start).unwrap_or_default();
    let here = if path.is_empty() { String::new() } else { format!("{above} {}", command.get_name()).trim_start().to_owned() };
    let mut command = command.help_template(TEMPLATE_RU).subcommand_help_heading("Команды").disable_help_subcommand(true);
    if let Some(about) = find(&here) {
        command = command.about(about);
    }
    let (help, version) = (flag("help", 'h', ArgAction::Help), flag("version", 'V', ArgAction::Version));
    command = command.disable_help_flag(true).disable_version_flag(true).arg(help);
    if path.is_empty() {
        command = command.arg(version);
    }
    command = command.mut_args(|arg| {
        let key = arg.get_id().as_str().to_owned();
        let arg = match find(&format!("{here}.{key}")).or_else(|| find(&format!(".{key}"))) {
            Some(help) => arg.help(help),
            None => arg,
        };
        let name = arg.get_value_names().and_then(|names| names.first()).map(ToString::to_string).unwrap_or_default();
        let arg = match VALUES.iter().find(|row| row.0 == name) {
            Some(row) => arg.value_name(row.1),
            None => arg,
        };
        let heading = if arg.is_positional() { "Аргументы" } else { "Ключи" };
        in_russian(arg.help_heading(heading))
    });
    let usage = usage(&command, path);
    let below = format!("{path} {}", command.get_name()).trim_start().to_owned();
    command.override_usage(usage).mut_subcommands(|sub| russian(sub, &below))
}

/// Possible values and defaults in Russian brackets; clap has them in English only.
fn in_russian(arg: Arg) -> Arg {
    let valued = arg.get_action().takes_values();
    let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
    let possible: Vec<String> = arg.get_possible_values().iter().map(|v| v.get_name().to_owned()).collect();
    let named =
        arg.get_value_names().and_then(|names| names.first()).is_some_and(|name| possible.iter().all(|v| name.contains(v.as_str())));
    let default = arg.get_default_values().first().and_then(|v| v.to_str()).map(str::to_owned);
    let mut added = String::new();
    let told = possible.iter().all(|value| help.contains(value));
    if valued && !possible.is_empty() && !named && !told {
        added.push_str(&format!(" [значения: {}]", possible.join(", ")));
    }
    if let Some(value) = default.filter(|_| valued && !help.contains("[по умолчанию")) {
        added.push_str(&format!(" [по умолчанию: {value}]"));
    }
    let arg = if added.is_empty() { arg } else { arg.help(format!("{help}{added}")) };
    arg.hide_possible_values(valued).hide_default_value(valued)
}

fn flag(name: &'static str, short: char, action: ArgAction) -> Arg {
    Arg::new(name).long(name).short(short).action(action)
}

/// `strutt simulate [КЛЮЧИ] <ФАЙЛ>`.
fn usage(command: &Command, path: &str) -> String {
    let mut words = vec![path, command.get_name(), "[КЛЮЧИ]"].into_iter().map(str::to_owned).collect::<Vec<_>>();
    for arg in command.get_positionals() {
        let name = arg.get_value_names().and_then(|names| names.first()).map_or_else(|| arg.get_id().to_string(), ToString::to_string);
        words.push(if arg.is_required_set() { format!("<{name}>") } else { format!("[{name}]") });
    }
    if command.has_subcommands() {
        words.push("<КОМАНДА>".into());
    }
    words.join(" ").trim_start().to_owned()
}

/// `strutt help [COMMAND]`, which clap itself offers in English only.
pub fn help_asked(matches: &ArgMatches, language: Language) -> Option<String> {
    let asked = matches.subcommand().filter(|(name, _)| *name == "help")?.1;
    let mut command = command(language);
    command.build();
    let name = asked.get_one::<String>("command");
    let sub = name.and_then(|name| command.find_subcommand_mut(name).map(|sub| sub.render_help().to_string()));
    Some(sub.unwrap_or_else(|| command.render_help().to_string()))
}

/// What is wrong with the command line.
pub fn complaint(error: &clap::Error, language: Language) -> String {
    let english = || error.render().to_string();
    if language == Language::En {
        return english();
    }
    let of = |kind| error.get(kind).map(ToString::to_string).unwrap_or_default();
    let (argument, value) = (of(ContextKind::InvalidArg), of(ContextKind::InvalidValue));
    let what = match error.kind() {
        ErrorKind::InvalidSubcommand => format!("нет команды '{}'", of(ContextKind::InvalidSubcommand)),
        ErrorKind::UnknownArgument => format!("нет ключа '{argument}'"),
        ErrorKind::MissingRequiredArgument => format!("не хватает: {argument}"),
        ErrorKind::MissingSubcommand => "не указана команда".into(),
        ErrorKind::InvalidValue if value.is_empty() => format!("у ключа '{argument}' нет значения"),
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => format!("'{value}' не годится для '{argument}'"),
        ErrorKind::ArgumentConflict => format!("'{argument}' и '{}' вместе не применяются", of(ContextKind::PriorArg)),
        _ => return english(),
    };
    let valid = of(ContextKind::ValidValue);
    let valid = if valid.is_empty() { valid } else { format!("\n  возможные значения: {valid}") };
    let near = [ContextKind::SuggestedSubcommand, ContextKind::SuggestedArg, ContextKind::SuggestedValue].map(of).concat();
    let near = if near.is_empty() { near } else { format!("\n  может быть, '{near}'?") };
    format!("ошибка: {what}{valid}{near}\n\nПодробнее: strutt --lang ru --help\n")
}

/// What stands for a value in help.
const VALUES: &[(&str, &str)] = &[
    ("FILE", "ФАЙЛ"),
    ("NAME", "ИМЯ"),
    ("CODE", "КОД"),
    ("SHELL", "ОБОЛОЧКА"),
    ("DIR", "ПАПКА"),
    ("TIME", "ВРЕМЯ"),
    ("NUMBER", "ЧИСЛО"),
    ("KEY", "КЛЮЧ"),
    ("ANSWERS", "ОТВЕТЫ"),
    ("CSV", "CSV"),
    ("COMMAND", "КОМАНДА"),
    ("NAME=QUANTITY", "ИМЯ=ВЕЛИЧИНА"),
    ("EXAMPLE", "ПРИМЕР"),
    ("LANG", "ru|en"),
    ("FORMAT", "full|short"),
    ("FORM", "text|latex|mathml"),
    ("FORMULA", "ФОРМУЛА"),
    ("RANGE", "ЗНАЧЕНИЯ"),
    ("QUANTITY", "ВЕЛИЧИНА"),
    ("STUDY", "РАСЧЁТ"),
    ("FROM,TO", "ОТ,ДО"),
    ("SCALE", "largest|first|mass"),
];

/// `command` or `command.argument` or `.argument` of any command; the Russian text.
const RUSSIAN: &[(&str, &str)] = &[
    ("", "Динамика и колебания машин: из одного текстового файла – уравнения, движения и записанный расчёт."),
    ("run", "Выполнить все расчёты файла модели; таблицы, графики и страница – в out/<имя>/"),
    ("report", "Записать расчёт, который сдают: постановка, вывод, результаты, проверки"),
    ("report.output", "Файл, который записывается [по умолчанию: report.html в папке результатов]"),
    ("report.out", "Папка для расчёта и его рисунков [по умолчанию: out/<имя модели>]"),
    ("report.pdf", "Сделать и PDF: установленным браузером (html), typst или LaTeX"),
    ("check", "Найти все ошибки файла модели"),
    ("equations", "Вывести уравнения движения"),
    ("section", "Показать характеристики сечений файла"),
    ("section.name", "Только одно сечение"),
    ("section.out", "Также записать чертежи и таблицу в эту папку"),
    ("scheme", "Начертить расчётную схему машины (SVG в стандартный вывод)"),
    ("scheme.svg", "Записать её в этот файл SVG"),
    ("scheme.png", "Записать её в этот файл PNG"),
    ("scheme.at", "Положение машины в этот момент движения или в равновесии (rest)"),
    ("scheme.body", "Только это тело, с реакциями отброшенных связей"),
    ("claims", "Сопоставить с машиной опубликованные результаты из файла"),
    ("claims.strict", "Код завершения 1, если какой-либо результат неверен"),
    ("variants", "Просмотреть все варианты файла: величины, ответы, что говорит против варианта"),
    ("variants check", "Рассчитать каждый вариант: ответы, нарушенные условия, двойники, близость резонанса, отказы"),
    ("variants make", "Записать в папку задания, решения и ключ для группы"),
    ("variants make.names", "Список студентов, по одному в строке, во втором столбце вариант; без списка – лист на каждый вариант"),
    ("variants make.pdf", "Также напечатать задания и решения в PDF установленным Chromium"),
    ("variants make.out", "Папка для листов"),
    ("variants grade", "Проверить сданные ответы по ключу"),
    ("variants grade.key", "Ключ, записанный командой `variants make`: key.json или папка с ним"),
    ("variants grade.answers", "Ответы студентов, по строке на каждого"),
    ("variants grade.out", "Также записать в эту папку отчёт для каждого студента и таблицу группы"),
    (".group", "Номер группы n в формулах вариантов"),
    ("examples", "Показать список примеров или один пример"),
    ("gallery", "Записать страницу со всеми примерами и движущимися картинками"),
    ("new", "Записать файл модели, с которого можно начать"),
    ("explain", "Объяснить код сообщения"),
    ("merge", "Объединить части серии расчётов"),
    ("completions", "Напечатать скрипт автодополнения для командной оболочки"),
    (".lang", "Язык вывода; иначе из LC_ALL, LC_MESSAGES, LANG"),
    (".quiet", "Печатать только данные и ошибки"),
    (".json", "Данные в формате JSON в стандартный вывод"),
    (".csv", "Данные в формате CSV в стандартный вывод"),
    (".timings", "Показать время каждого этапа (в стандартный поток ошибок)"),
    (".file", "Файл модели, папка с model.toml или - для стандартного ввода"),
    (".overrides", "Заменить параметр (m=\"10 г\"), начальное значение (phi=0.1) или начальную скорость (\"phi'=30\")"),
    (".variant", "Взять величины из этой строки таблицы вариантов; --set важнее"),
    ("run.halve_tolerance", "Повторить каждый расчёт с вдвое меньшей допустимой погрешностью шага и показать расхождение"),
    ("run.animate", "Также записать движущиеся картинки: SVG, который проигрывается сам, и MP4, если установлен ffmpeg"),
    ("gallery.names", "Только эти примеры"),
    ("gallery.out", "Папка для страницы"),
    ("run.out", "Папка для результатов [по умолчанию: out/<имя модели>]"),
    ("check.format", "Вид замечаний: со строкой файла или по одной строке для редакторов"),
    ("equations.form", "Вид формул"),
    ("equations.steps", "Показать вывод по шагам"),
    ("examples.name", "Пример, который надо напечатать"),
    ("new.name", "Имя файла, с .toml или без него; имя примера копирует этот пример"),
    ("new.from", "Пример, который надо скопировать"),
    ("new.count", "Число маятников для n-pendulum"),
    ("explain.code", "Код, как в ошибка[M021]; без него печатаются все коды"),
    ("merge.parts", "Папки частей, каждая записана командой sweep --shard I/N --out ПАПКА"),
    ("merge.out", "Папка для строк и таблицы всей серии"),
    ("completions.shell", "Оболочка"),
    ("help", "Показать справку о программе или о команде"),
    ("help.command", "Команда"),
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
            for command in sub.get_subcommands().filter(|c| c.get_name() != "help").chain([sub]) {
                assert!(command.get_about().is_some_and(|a| russian(a.to_string())), "{}", command.get_name());
                for arg in command.get_arguments() {
                    assert!(arg.get_help().is_none_or(|h| russian(h.to_string())), "{} {}", command.get_name(), arg.get_id());
                }
            }
        }
    }

    #[test]
    fn values_and_defaults_are_named_in_russian() {
        let mut command = command(Language::Ru);
        command.build();
        let mut help = |name: &str| {
            let text = command.find_subcommand_mut(name).map(|sub| sub.render_help().to_string()).unwrap_or_default();
            text.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        assert!(help("simulate").contains("auto, taylor, stiff"), "{}", help("simulate"));
        assert!(help("completions").contains("bash, elvish, fish"), "{}", help("completions"));
        for name in ["check", "equations", "response", "modes", "kinematics", "periodic"] {
            assert!(!help(name).contains("[default") && !help(name).contains("[possible"), "{}", help(name));
        }
    }
}
