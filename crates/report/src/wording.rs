//! The words of pages, tables and figures in both languages.

words::table! {
    Figure: "Figure", "Рисунок";
    Table: "Table", "Таблица";
    Contents: "Contents", "Содержание";
    DegreesOfFreedom: "Degrees of freedom", "Число степеней свободы";
    Coordinates: "Generalized coordinates", "Обобщённые координаты";
    Equations: "Equations of motion", "Уравнения движения";
    Derivation: "Derivation, step by step", "Вывод по шагам";
    Parameters: "Parameters", "Параметры";
    Definitions: "Definitions", "Обозначения";
    Results: "Results", "Результаты";
    Simulation: "Motion", "Движение";
    Equilibrium: "Equilibrium", "Положение равновесия";
    Checks: "Checks", "Проверки";
    Events: "Events", "События";
    Counters: "Work done", "Объём вычислений";
    Downloads: "Files", "Файлы";
    Symbol: "Symbol", "Обозначение";
    Written: "As written", "Задано";
    Value: "Value", "Значение";
    ValueSi: "Value in SI", "Значение в СИ";
    Unit: "Unit", "Единица";
    Description: "Description", "Описание";
    Check: "Check", "Проверка";
    Limit: "Limit", "Допуск";
    Verdict: "Verdict", "Вывод";
    Passed: "passed", "выполнено";
    Failed: "failed", "не выполнено";
    Time: "Time", "Время";
    Event: "Event", "Событие";
    Counter: "Counter", "Показатель";
    Number: "Number", "Количество";
    Minimum: "min", "мин.";
    Maximum: "max", "макс.";
    Final: "at the end", "в конце";
    Series: "Curve", "Кривая";
    ShowData: "Show data", "Показать данные";
    RowsOf: "rows shown of", "строк показано из";
    Version: "version", "версия";
    ModelHash: "model", "модель";
    PlotHelp: "Drag: zoom. Double click or 0: whole range. Arrow keys: cursor. L: logarithmic axis.",
        "Протяните мышью – увеличить. Двойной щелчок или 0 – весь диапазон. Стрелки – курсор. L – логарифмическая ось.";
    ResetZoom: "Whole range", "Весь диапазон";
    LogAxis: "Log axis", "Лог. ось";
    Against: "against", "от";
    From: "from", "от";
    To: "to", "до";
    Points: "points", "точек";
    NoPositive: "no positive values: a logarithmic axis is not possible", "нет положительных значений: логарифмическая ось невозможна";
    NoData: "no finite values to draw", "нет конечных значений для построения";
    Contacts: "Contacts and frictions", "Контакты и трение";
    Contact: "Contact", "Контакт";
    Before: "Before", "До";
    After: "After", "После";
    Impulse: "Impulse, SI", "Импульс, СИ";
    Impacts: "impacts", "ударов";
    StateClosed: "closed, taut", "замкнут, натянут";
    StateOpen: "open, slack", "разомкнут, провисает";
    StateSticks: "sticks", "залипание";
    StateForward: "slides forward", "скольжение вперёд";
    StateBackward: "slides back", "скольжение назад";
    StateImpact: "impact", "удар";
    Omitted: "omitted", "опущено";
    Continuation: "continued", "продолжение";
    Continued: "the table is cut to the width of the terminal; all columns are in the files",
        "таблица обрезана по ширине терминала; все столбцы есть в файлах";
}
