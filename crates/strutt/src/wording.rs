//! The words of the command line in both languages; what results are called stands in `studies::wording` and `report::wording`.

use words::Language;

words::table! {
    Error: "error", "ошибка";
    Warning: "warning", "предупреждение";
    Why: "why", "причина";
    Help: "help", "что делать";
    Next: "next:", "дальше:";
    Ok: "ok", "модель верна";
    Bodies: "bodies", "тел";
    Coordinates: "coordinates", "координат";
    Parameters: "parameters", "параметров";
    Outputs: "outputs", "выходных величин";
    Studies: "studies", "расчётов";
    Sections: "sections", "сечений";
    Written: "written:", "записано:";
    WrittenPartly: "written what was done so far:", "записано то, что успели вычислить:";
    Interrupted: "interrupted; what was done is kept", "прервано; сделанное сохранено";
    InterruptedDeaf: "interrupted; the calculation under way could not be cut short, nothing of it is kept", "прервано; текущий расчёт нельзя было закончить раньше, его результаты не сохранены";
    AuditFailed: "a check failed:", "проверка не выполнена:";
    MoreAbout: "more:", "подробнее:";
    Table: "table, 17 digits", "таблица, 17 знаков";
    TableRu: "table for Russian spreadsheets", "таблица для Excel";
    AllData: "all data", "все данные";
    Vector: "plot, vector", "график, векторный";
    Picture: "plot, picture", "график, растровый";
    Page: "page", "страница";
    Movie: "moving picture", "движущаяся картинка";
    Thumbnail: "picture of the gallery", "картинка галереи";
    SectionTable: "properties of the sections", "характеристики сечений";
    Task: "task", "задание";
    Solution: "solution", "решение";
    Key: "key", "ключ";
    Quiz: "questions for a learning system", "вопросы для системы обучения";
    AnswerSheet: "empty table for the answers", "пустая таблица для ответов";
    Grades: "what was handed in, graded", "проверка сданных ответов";
    EventTable: "events, 17 digits", "события, 17 знаков";
    TimeRead: "read", "чтение";
    TimeDerive: "derive", "вывод уравнений";
    TimeLower: "lower", "составление программы";
    TimeRun: "run", "счёт";
    TimeWrite: "write", "запись";
    TimeTotal: "total", "всего";
}

/// A word in a language.
pub fn say(language: Language, word: Word) -> &'static str {
    language.word(word)
}
