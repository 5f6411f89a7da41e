//! The layout: a small tree of boxes between expressions and the three written forms.
//!
//! Order, signs and the choice between fraction, root and power are settled here. The writers only decide what a form cannot avoid
//! deciding: where plain text needs brackets that a fraction bar makes superfluous, and which space goes where.

/// A formula as boxes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A number: mantissa with the decimal mark of the language (may be `3/2` in an exponent), and a power of ten.
    Number {
        /// Digits.
        mantissa: String,
        /// `n` of `·10ⁿ`.
        exponent: Option<i32>,
    },
    /// A symbol.
    Symbol(Identifier),
    /// Upright words or a single character that is not a variable (∂, d, …).
    Words(String),
    /// Boxes glued without space.
    Row(Vec<Layout>),
    /// Signed terms. A lone negative term is a sum of one.
    Sum(Vec<(Sign, Layout)>),
    /// Factors side by side.
    Product(Vec<Layout>),
    /// Numerator over denominator.
    Fraction(Box<Layout>, Box<Layout>),
    /// Base and exponent.
    Power(Box<Layout>, Box<Layout>),
    /// The natural exponential of the argument.
    Exponential(Box<Layout>),
    /// Root of a degree, 2 for the square root.
    Root {
        /// Degree.
        degree: u32,
        /// What is under it.
        radicand: Box<Layout>,
    },
    /// Brackets.
    Fence(Bracket, Box<Layout>),
    /// A named function.
    Call {
        /// Name in the language of the text.
        name: &'static str,
        /// Power written at the name: `sin² φ`.
        power: Option<String>,
        /// The argument without brackets.
        argument: Box<Layout>,
        /// Whether the argument needs brackets.
        bare: Bare,
    },
    /// Several arguments.
    List(Vec<Layout>, &'static str),
    /// left relation right.
    Related(Box<Layout>, Relation, Box<Layout>),
    /// Values with their conditions.
    Cases(Vec<Row>),
}

/// Where a formula stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// On its own line.
    Block,
    /// Within a sentence or a table cell.
    Inline,
}

/// One row of [`Layout::Cases`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The value.
    pub value: Layout,
    /// Where it holds.
    pub condition: Layout,
}

/// The sign of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Sign {
    Plus,
    Minus,
}

impl Sign {
    /// The other sign.
    pub fn flipped(self) -> Sign {
        match self {
            Sign::Plus => Sign::Minus,
            Sign::Minus => Sign::Plus,
        }
    }
    /// `+` or the true minus.
    pub fn character(self) -> char {
        match self {
            Sign::Plus => '+',
            Sign::Minus => '−',
        }
    }
    /// `+` or the hyphen of a keyboard, which typesetting systems turn into a minus.
    pub fn ascii(self) -> &'static str {
        match self {
            Sign::Plus => "+",
            Sign::Minus => "-",
        }
    }
}

/// Kinds of brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Bracket {
    Round,
    Bar,
}

/// When a function argument stands without brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bare {
    /// `cos φ`, `cos 2φ`.
    Always,
    /// A fraction, which its bar delimits: bare in two dimensions, in brackets on one line.
    Raised,
    /// `cos(φ₁ − φ₂)`.
    Never,
}

/// Relations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Relation {
    Equal,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

impl Relation {
    /// The character.
    pub fn character(self) -> char {
        match self {
            Relation::Equal => '=',
            Relation::Less => '<',
            Relation::LessEqual => '≤',
            Relation::Greater => '>',
            Relation::GreaterEqual => '≥',
        }
    }
    /// The relation with its sides exchanged.
    pub fn mirrored(self) -> Relation {
        match self {
            Relation::Equal => Relation::Equal,
            Relation::Less => Relation::Greater,
            Relation::LessEqual => Relation::GreaterEqual,
            Relation::Greater => Relation::Less,
            Relation::GreaterEqual => Relation::LessEqual,
        }
    }
    /// The relation that holds where this one does not.
    pub fn opposite(self) -> Relation {
        match self {
            Relation::Equal => Relation::Equal,
            Relation::Less => Relation::GreaterEqual,
            Relation::LessEqual => Relation::Greater,
            Relation::Greater => Relation::LessEqual,
            Relation::GreaterEqual => Relation::Less,
        }
    }
}

/// Slope of a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Shape {
    Italic,
    Upright,
}

/// A letter or word with dots and a subscript.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identifier {
    /// Letter or word.
    pub base: String,
    /// Its slope.
    pub shape: Shape,
    /// Number of time derivatives.
    pub primes: u8,
    /// Pieces of the subscript, set without space.
    pub subscript: Vec<Index>,
}

/// A piece of a subscript.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Index {
    /// Letters, digits or a comma.
    pub text: String,
    /// Slope.
    pub shape: Shape,
}

impl Layout {
    /// A whole number or any ready digits.
    pub(super) fn digits(mantissa: impl Into<String>) -> Layout {
        Layout::Number { mantissa: mantissa.into(), exponent: None }
    }
    /// A lone term with its sign.
    pub(super) fn signed(sign: Sign, body: Layout) -> Layout {
        match sign {
            Sign::Plus => body,
            Sign::Minus => Layout::Sum(vec![(sign, body)]),
        }
    }
    /// In round brackets.
    pub(super) fn fenced(self) -> Layout {
        Layout::Fence(Bracket::Round, Box::new(self))
    }
    /// One factor alone, or a product.
    pub(super) fn product(mut factors: Vec<Layout>) -> Layout {
        match factors.len() {
            1 => factors.remove(0),
            _ => Layout::Product(factors),
        }
    }
    /// Whether a factor before it needs a dot between: `2·3ˣ`.
    pub(super) fn starts_with_digit(&self) -> bool {
        match self {
            Layout::Number { .. } => true,
            Layout::Power(base, _) => base.starts_with_digit(),
            _ => false,
        }
    }
    /// Whether a sum occurs that a reader has to take in.
    pub(super) fn has_sum(&self) -> bool {
        match self {
            Layout::Sum(_) => true,
            Layout::Product(items) => items.iter().any(Layout::has_sum),
            Layout::Power(inner, _) | Layout::Fence(_, inner) | Layout::Root { radicand: inner, .. } => inner.has_sum(),
            Layout::Fraction(above, below) => above.has_sum() || below.has_sum(),
            _ => false,
        }
    }
    /// Whether brackets around it must grow.
    pub(super) fn is_tall(&self) -> bool {
        match self {
            Layout::Fraction(..) | Layout::Cases(_) => true,
            Layout::Number { .. } | Layout::Symbol(_) | Layout::Words(_) => false,
            Layout::Row(items) | Layout::Product(items) | Layout::List(items, _) => items.iter().any(Layout::is_tall),
            Layout::Sum(terms) => terms.iter().any(|t| t.1.is_tall()),
            Layout::Power(inner, _) | Layout::Fence(_, inner) => inner.is_tall(),
            Layout::Root { radicand: inner, .. } | Layout::Call { argument: inner, .. } => inner.is_tall(),
            Layout::Exponential(_) => false,
            Layout::Related(left, _, right) => left.is_tall() || right.is_tall(),
        }
    }
}

impl Identifier {
    /// No subscript, or digits only.
    pub(super) fn has_plain_index(&self) -> bool {
        self.subscript.iter().all(|i| i.text.chars().all(|c| c.is_ascii_digit()))
    }
    /// Dots above the letter; words and high derivatives take primes instead.
    pub(crate) fn dots(&self) -> u8 {
        if self.primes <= 3 && self.base.chars().count() == 1 { self.primes } else { 0 }
    }
    /// Prime marks that two-dimensional forms write after the letter.
    pub(super) fn raised_primes(&self) -> usize {
        usize::from(self.primes - self.dots())
    }
}
