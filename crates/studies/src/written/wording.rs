//! The words of the written calculation in both languages; sentences with numbers in them stand beside what they say.

words::table! {
    Statement: "Problem and data", "Постановка задачи и исходные данные";
    Sections: "Properties of the sections", "Геометрические характеристики сечений";
    Kinematics: "Kinematics", "Кинематика";
    Dynamics: "Equations of motion", "Уравнения движения";
    Free: "Free oscillations", "Свободные колебания";
    Forced: "Forced oscillations", "Вынужденные колебания";
    Motion: "Motion", "Движение";
    Reactions: "Reactions and internal forces", "Реакции связей и внутренние усилия";
    Regime: "Working regime", "Режим работы";
    Verification: "Verification", "Проверка результатов";
    Conclusions: "Conclusions", "Выводы";
    Sources: "Sources", "Список использованных источников";
    Appendix: "Appendix", "Приложение";
    ModelText: "The model file", "Текст модели";
    Tables: "Tables", "Таблицы";
    Given: "Given", "Дано";
    Wanted: "Wanted", "Требуется";
    Assumptions: "Model and assumptions", "Расчётная схема и допущения";
    Data: "Data", "Исходные данные";
    Freedoms: "Degrees of freedom and coordinates", "Число степеней свободы и координаты";
    Conditions: "Equations of the connections", "Уравнения связей";
    Kinetic: "Kinetic energy", "Кинетическая энергия";
    Potential: "Potential energy", "Потенциальная энергия";
    Dissipation: "Dissipation function", "Диссипативная функция";
    Forces: "Generalized forces", "Обобщённые силы";
    Lagrange: "Lagrange's equations", "Уравнения Лагранжа второго рода";
    Second: "Check by a second method", "Проверка другим способом";
    Where: "where", "где";
    Body: "Body", "Тело";
    MovesHow: "Motion", "Движение";
    Mass: "Mass", "Масса";
    Inertia: "Central moment of inertia", "Центральный момент инерции";
    Bodies: "bodies of the machine", "тела механизма";
    Number: "No.", "№";
    Connection: "Connection", "Связь";
    What: "What it does", "Что она задаёт";
    Connected: "connections", "связи";
    Element: "Element or load", "Элемент или нагрузка";
    Law: "Energy or virtual power", "Энергия или возможная мощность";
    Elements: "springs, dampers and loads", "упругие и демпфирующие элементы, нагрузки";
    Coordinate: "Coordinate", "Координата";
    Start: "At the start", "В начале";
    Rate: "Rate at the start", "Скорость в начале";
    Coordinates: "coordinates of the machine", "координаты механизма";
    Greatest: "Greatest", "Наибольшее";
    Least: "Least", "Наименьшее";
    At: "at t, s", "при t, с";
    Quantity: "Quantity", "Величина";
    Extremes: "extremes of reactions and forces", "наибольшие и наименьшие значения реакций и усилий";
    Before: "before", "до";
    After: "after", "после";
    Jumps: "reactions on both sides of the switches", "реакции до и после переключений";
    Found: "Found", "Получено";
    Expected: "Expected", "Ожидается";
    Checks: "checks of the calculation", "проверки расчёта";
    Free0: "neglected", "не учитывается";
}

impl Word {
    /// The name in `[report]` of the chapter with this title; none of other words.
    pub fn chapter(self) -> &'static str {
        match self {
            Word::Statement => "statement",
            Word::Sections => "sections",
            Word::Kinematics => "kinematics",
            Word::Dynamics => "equations",
            Word::Free => "free",
            Word::Forced => "forced",
            Word::Motion => "motion",
            Word::Reactions => "reactions",
            Word::Regime => "regime",
            Word::Verification => "verification",
            Word::Conclusions => "conclusions",
            Word::Sources => "sources",
            Word::ModelText => "model",
            Word::Tables => "tables",
            _ => "",
        }
    }
}
