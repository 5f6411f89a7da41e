//! The words of results and of the written calculation in both languages; those of tables and figures stand in `report::wording`.

use words::Language;

words::table! {
    Modes: "Natural oscillations", "Собственные колебания";
    Response: "Forced oscillations", "Вынужденные колебания";
    Stability: "Stability", "Устойчивость";
    Stable: "stable", "устойчиво";
    Unstable: "unstable", "неустойчиво";
    Undecided: "not decided by linearisation", "по линейному приближению не определяется";
    KineticEnergy: "Kinetic energy", "Кинетическая энергия";
    PotentialEnergy: "Potential energy", "Потенциальная энергия";
    DissipationFunction: "Dissipation function", "Диссипативная функция";
    WhereText: "where", "где";
    Connections: "Equations of the connections", "Уравнения связей";
    Reactions: "Reactions", "Реакции";
    OtherReactions: "Other reactions, from the balances of the released bodies", "Прочие реакции, из уравнений освобождённых тел";
    ReactionsReleased: "Reactions, from the balances of the released bodies", "Реакции, из уравнений освобождённых тел";
    FrictionLaws: "Dry friction: the force while it slides, its limit while it sticks", "Сухое трение: сила при скольжении и предел при покое";
    ClosedForm: "Motion in closed form", "Движение в замкнутой форме";
    AtStart: "at the start", "в начале";
    WhenTaken: "at t", "при t";
    NamedEvents: "Named events", "Именованные события";
}

/// A word in a language.
pub fn say(language: Language, word: Word) -> &'static str {
    language.word(word)
}
