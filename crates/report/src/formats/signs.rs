//! What LaTeX needs to be told about signs that its text fonts do not have: Greek, indices, relations.

use crate::formula::greek;

/// How a sign is set.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Sign {
    /// So by every engine.
    Set(String),
    /// So by engines of eight bits; the fonts of the others have it, or nothing has.
    EightBits(String),
}

/// How a sign is set in text and in formulas; none for those that the fonts have.
pub(super) fn sign(c: char) -> Option<Sign> {
    let known = matches!(c, '\u{400}'..='\u{45f}' | '«' | '»' | '–' | '—' | '“' | '”' | '„' | '‘' | '’' | '№' | '…' | '§');
    if c.is_ascii() || known {
        return None;
    }
    let math = |text: &str| Some(Sign::Set(format!("\\ensuremath{{{text}}}")));
    if let Some((_, text)) = MATH.iter().find(|(sign, _)| *sign == c) {
        return math(text);
    }
    if let Some((base, script)) = raised(c) {
        return Some(Sign::Set(format!("\\{script}{{{base}}}")));
    }
    if let Some((letter, dots)) = DOTTED.iter().find(|(sign, _)| *sign == c).map(|(_, set)| set) {
        return math(&format!("\\{dots}{{{letter}}}"));
    }
    let is_greek = matches!(c, 'Α'..='ω' | 'ϑ');
    match c {
        _ if is_greek => math(&greek(c)),
        // the letters of Western Europe have the same places in T1
        'À'..='Ö' | 'Ø'..='Þ' | 'à'..='ö' | 'ø'..='þ' => {
            Some(Sign::EightBits(format!("{{\\fontencoding{{T1}}\\selectfont\\char{}}}", c as u32)))
        }
        _ => Some(Sign::EightBits(format!("\\texttt{{U+{:04X}}}", c as u32))),
    }
}

/// Signs of formulas.
const MATH: [(char, &str); 47] = [
    ('−', "-"),
    ('·', "\\cdot"),
    ('×', "\\times"),
    ('÷', "\\div"),
    ('±', "\\pm"),
    ('∓', "\\mp"),
    ('≤', "\\le"),
    ('≥', "\\ge"),
    ('≠', "\\ne"),
    ('≈', "\\approx"),
    ('≡', "\\equiv"),
    ('∼', "\\sim"),
    ('∝', "\\propto"),
    ('→', "\\to"),
    ('←', "\\leftarrow"),
    ('↔', "\\leftrightarrow"),
    ('⇒', "\\Rightarrow"),
    ('√', "\\surd"),
    ('∛', "\\sqrt[3]{}"),
    ('∂', "\\partial"),
    ('∇', "\\nabla"),
    ('∆', "\\Delta"),
    ('∫', "\\int"),
    ('∮', "\\oint"),
    ('∑', "\\sum"),
    ('∏', "\\prod"),
    ('∞', "\\infty"),
    ('∈', "\\in"),
    ('∠', "\\angle"),
    ('⊥', "\\perp"),
    ('∥', "\\parallel"),
    ('‖', "\\Vert"),
    ('°', "^\\circ"),
    ('′', "'"),
    ('″', "''"),
    ('‴', "'''"),
    ('✓', "\\checkmark"),
    ('✗', "\\times"),
    ('⌀', "\\varnothing"),
    ('½', "\\tfrac12"),
    ('µ', "\\mu"),
    ('ϕ', "\\phi"),
    ('ϵ', "\\epsilon"),
    ('ℓ', "\\ell"),
    ('\u{2061}', ""),
    ('\u{2062}', ""),
    ('│', "|"),
];

/// Letters with dots.
const DOTTED: [(char, (&str, &str)); 6] =
    [('ẋ', ("x", "dot")), ('ẏ', ("y", "dot")), ('ż', ("z", "dot")), ('ẍ', ("x", "ddot")), ('ÿ', ("y", "ddot")), ('ė', ("e", "dot"))];

/// Raised and lowered signs as what they are on the line.
fn raised(c: char) -> Option<(&'static str, &'static str)> {
    const RAISED: [(char, &str); 15] = [
        ('⁰', "0"),
        ('¹', "1"),
        ('²', "2"),
        ('³', "3"),
        ('⁴', "4"),
        ('⁵', "5"),
        ('⁶', "6"),
        ('⁷', "7"),
        ('⁸', "8"),
        ('⁹', "9"),
        ('⁺', "+"),
        ('⁻', "\\ensuremath{-}"),
        ('ⁿ', "n"),
        ('ᵀ', "T"),
        ('ⁱ', "i"),
    ];
    const LOWERED: [(char, &str); 28] = [
        ('₀', "0"),
        ('₁', "1"),
        ('₂', "2"),
        ('₃', "3"),
        ('₄', "4"),
        ('₅', "5"),
        ('₆', "6"),
        ('₇', "7"),
        ('₈', "8"),
        ('₉', "9"),
        ('ₐ', "a"),
        ('ₑ', "e"),
        ('ₕ', "h"),
        ('ᵢ', "i"),
        ('ⱼ', "j"),
        ('ₖ', "k"),
        ('ₗ', "l"),
        ('ₘ', "m"),
        ('ₙ', "n"),
        ('ₒ', "o"),
        ('ₚ', "p"),
        ('ᵣ', "r"),
        ('ₛ', "s"),
        ('ₜ', "t"),
        ('ᵤ', "u"),
        ('ᵥ', "v"),
        ('ₓ', "x"),
        ('ᵩ', "\\ensuremath{\\varphi}"),
    ];
    let of = |table: &[(char, &'static str)]| table.iter().find(|(sign, _)| *sign == c).map(|(_, base)| *base);
    of(&RAISED).map(|base| (base, "textsuperscript")).or_else(|| of(&LOWERED).map(|base| (base, "textsubscript")))
}
