//! Dimensions and dependence of a formula, node by node.
//!
//! A literal 0 fits every dimension. A name that is faulty itself has an unknown dimension, which fits everything: one slip gives one
//! message.

use super::kind::{Depends, Kind};
use super::kinematic::{KinematicFunction, Where};
use super::parse::{Ast, Formula, NodeId};
use super::scope::{Entry, EntryKind, Scope};
use super::turns;
use crate::requests::RequestKind;
use crate::units::{Dimension, si_label, si_label_ru};
use std::ops::Range;
use symbolic::{Function, Rational};
use words::Notice;

/// What may stand in a formula.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Context {
    pub depends: Depends,
    /// Kinematic functions up to this level; `None` for none.
    pub kinematic: Option<Where>,
    pub outputs: bool,
    /// What the field is, for messages: "a start value must be a constant".
    pub en: &'static str,
    pub ru: &'static str,
}

impl Context {
    const fn new(depends: Depends, kinematic: Option<Where>, en: &'static str, ru: &'static str) -> Context {
        Context { depends, kinematic, outputs: false, en, ru }
    }
    pub(crate) const CONSTANT: Context = Context::new(
        Depends::NOTHING,
        None,
        "this value must be a constant: only numbers and constant parameters",
        "эта величина должна быть постоянной: только числа и постоянные параметры",
    );
    pub(crate) const TIME: Context = Context::new(
        Depends::TIME,
        None,
        "this value may depend on time only: it is prescribed",
        "эта величина может зависеть только от времени: она задана",
    );
    pub(crate) const GEOMETRY: Context = Context::new(
        Depends::POSITION,
        None,
        "a position may depend on coordinates and time, not on rates",
        "положение может зависеть от координат и времени, но не от скоростей",
    );
    pub(crate) const PATHWAY: Context = Context::new(
        Depends::POSITION,
        Some(Where::Pathways),
        "this value may depend on coordinates and time, not on rates",
        "эта величина может зависеть от координат и времени, но не от скоростей",
    );
    pub(crate) const SECTION: Context = Context::new(
        Depends::MOTION,
        None,
        "a section depends on coordinates, rates and time",
        "сечение зависит от координат, скоростей и времени",
    );
    pub(crate) const MOTION: Context = Context::new(
        Depends::MOTION,
        None,
        "this value may depend on coordinates, rates and time",
        "эта величина может зависеть от координат, скоростей и времени",
    );
    pub(crate) const PARAMETER: Context = Context::new(
        Depends::MOTION,
        None,
        "a parameter may depend on time, coordinates and rates",
        "параметр может зависеть от времени, координат и скоростей",
    );
    pub(crate) const FORCE: Context = Context::new(
        Depends::MOTION,
        Some(Where::Forces),
        "a force may depend on time, coordinates and rates, not on accelerations",
        "сила может зависеть от времени, координат и скоростей, но не от ускорений",
    );
    pub(crate) const RATES: Context = Context::new(
        Depends::MOTION,
        Some(Where::Forces),
        "a condition may depend on time, coordinates and rates, not on accelerations",
        "условие может зависеть от времени, координат и скоростей, но не от ускорений",
    );
    pub(crate) const SLIDING: Context = Context::new(
        Depends(33),
        None,
        "a friction law depends on time and on the sliding speed u only",
        "закон трения зависит только от времени и скорости скольжения u",
    );
    pub(crate) const NORMAL: Context = Context::new(
        Depends::REACTION,
        Some(Where::Reactions),
        "a normal force may depend on time, coordinates, rates and reactions",
        "нормальная сила может зависеть от времени, координат, скоростей и реакций",
    );
    pub(crate) const OUTPUT: Context = Context {
        depends: Depends(31),
        kinematic: Some(Where::Outputs),
        outputs: true,
        en: "an output may depend on everything",
        ru: "выходная величина может зависеть от всего",
    };
}

/// The result of a check.
pub(crate) struct Checked {
    pub kind: Kind,
    pub depends: Depends,
    pub faults: Vec<Notice>,
}

/// Checks a formula.
pub(crate) fn check(formula: &Formula, scope: &Scope, context: &Context) -> Checked {
    let mut pass = Pass { formula, scope, context, faults: Vec::new(), kinds: Vec::new(), rationals: Vec::new(), depends: Depends(0) };
    for (node, span) in &formula.nodes {
        let kind = pass.node(node, span);
        pass.kinds.push(kind);
        let rational = pass.rational(node);
        pass.rationals.push(rational);
    }
    let kind = if pass.faults.iter().any(|f| f.severity == words::Severity::Error) { Kind::Unknown } else { pass.kinds[formula.root()] };
    Checked { kind, depends: pass.depends, faults: pass.faults }
}

struct Pass<'a> {
    formula: &'a Formula,
    scope: &'a Scope,
    context: &'a Context,
    faults: Vec<Notice>,
    kinds: Vec<Kind>,
    /// exact values of nodes that are small numbers, for exponents
    rationals: Vec<Option<Rational>>,
    depends: Depends,
}

impl Pass<'_> {
    fn span(&self, id: NodeId) -> Range<usize> {
        self.formula.nodes[id].1.clone()
    }
    fn fail(&mut self, fault: Notice) -> Kind {
        self.faults.push(fault);
        Kind::Unknown
    }

    fn node(&mut self, node: &Ast, span: &Range<usize>) -> Kind {
        match node {
            Ast::Number(n) if n.is_zero() => Kind::Any,
            Ast::Number(n) => Kind::Known(turns::of_number(n)),
            Ast::Quantity(q) => Kind::Known(q.unit.dimension),
            Ast::Name { name, primes } => self.name(name, *primes, span),
            Ast::Sum(terms) => self.alike(terms.iter().map(|t| t.1), "terms of a sum", "слагаемые"),
            Ast::Product(factors) => self.product(factors, span),
            Ast::Power(base, exponent) => self.power(*base, *exponent, span),
            Ast::Sqrt(x) => self.raise(self.kinds[*x], &Rational::HALF, span),
            Ast::Call(function, arguments) => self.call(*function, arguments),
            Ast::Kinematic { function, arguments } => self.kinematic(function, arguments, span),
            Ast::If { left, right, then, otherwise, .. } => {
                self.alike([*left, *right].into_iter(), "sides of a condition", "части условия");
                self.alike([*then, *otherwise].into_iter(), "branches of if", "ветви if")
            }
        }
    }

    fn name(&mut self, name: &str, primes: u8, span: &Range<usize>) -> Kind {
        match (name, primes) {
            ("pi" | "π", 0) => return Kind::Known(Dimension::PI),
            ("t", 0) => {
                self.use_of(Depends::TIME, "t", span);
                return Kind::Known(Dimension::TIME);
            }
            ("pi" | "π" | "t", _) => {
                let what = (format!("`{name}` has no derivative to speak of"), format!("у `{name}` нет смысла брать производную"));
                return self.fail(Notice::piece("M038", span.clone(), what.0, what.1));
            }
            _ => {}
        }
        let Some(entry) = self.scope.get(name) else {
            let fault = unknown_name(name, span.clone(), self.scope);
            return self.fail(fault);
        };
        let entry = entry.clone();
        if primes > 2 {
            return self.fail(
                Notice::piece(
                    "M038",
                    span.clone(),
                    format!("`{name}` has {primes} primes; two derivatives are the most"),
                    format!("у `{name}` штрихов: {primes}; допустимо не больше двух"),
                )
                .why("equations of motion are of second order", "уравнения движения второго порядка"),
            );
        }
        if matches!(entry.kind, EntryKind::Output(_)) && !self.context.outputs {
            let fault = Notice::piece(
                "M037",
                span.clone(),
                format!("`{name}` is an output; outputs can be used in outputs only"),
                format!("`{name}` — выходная величина; её можно использовать только в [outputs]"),
            );
            return self.fail(match entry.depends.is_constant() {
                true => fault.help(format!("move `{name}` to [parameters]"), format!("перенесите `{name}` в [parameters]")),
                // parameters know nothing of the motion
                false => {
                    fault.help(format!("write the formula of `{name}` here"), format!("запишите здесь саму формулу величины `{name}`"))
                }
            });
        }
        self.derived(name, &entry, primes, span)
    }

    fn derived(&mut self, name: &str, entry: &Entry, primes: u8, span: &Range<usize>) -> Kind {
        let mut depends = entry.depends;
        for _ in 0..primes {
            match depends.derivative() {
                Some(d) => depends = d,
                None => {
                    return self.fail(Notice::piece(
                        "M038",
                        span.clone(),
                        format!("the derivative of `{name}` contains third derivatives of coordinates"),
                        format!("производная `{name}` содержит третьи производные координат"),
                    ));
                }
            }
        }
        if let EntryKind::Coordinate(_) = entry.kind {
            depends = Depends::coordinate(primes);
        } else if primes > 0 && depends.is_constant() && entry.dimension != Kind::Unknown {
            self.faults.push(
                Notice::piece(
                    "M039",
                    span.clone(),
                    format!("`{name}` is constant: its time derivative is zero"),
                    format!("`{name}` постоянна: её производная по времени равна нулю"),
                )
                .warning(),
            );
        }
        self.use_of(depends, name, span);
        match entry.dimension {
            Kind::Known(d) => Kind::Known(d.per_time(primes)),
            other => other,
        }
    }

    /// Notes a dependence and complains when the context forbids it.
    fn use_of(&mut self, depends: Depends, name: &str, span: &Range<usize>) {
        self.depends = self.depends | depends;
        if depends.within(self.context.depends) {
            return;
        }
        let (en, ru) = match depends.0 {
            32.. => ("the sliding speed", "скорости скольжения"),
            16.. => ("reactions", "реакций"),
            8.. => ("accelerations", "ускорений"),
            4.. => ("rates", "скоростей"),
            2.. => ("coordinates", "координат"),
            _ => ("time", "времени"),
        };
        let written = &self.formula.nodes.iter().find(|n| n.1 == *span).map_or(name, |_| name);
        self.faults.push(
            Notice::piece("M036", span.clone(), format!("`{written}` depends on {en}"), format!("`{written}` зависит от {ru}"))
                .why(self.context.en, self.context.ru),
        );
    }

    /// All of the nodes must have one dimension.
    fn alike(&mut self, ids: impl Iterator<Item = NodeId>, en: &str, ru: &str) -> Kind {
        let mut result: Option<(Dimension, NodeId)> = None;
        let mut unknown = false;
        let mut known: Vec<(NodeId, Dimension)> = Vec::new();
        for id in ids {
            known.extend(if let Kind::Known(d) = self.kinds[id] { Some((id, d)) } else { None });
            match (self.kinds[id], &mut result) {
                (Kind::Unknown, _) => unknown = true,
                (Kind::Any, _) => {}
                (Kind::Known(d), None) => result = Some((d, id)),
                (Kind::Known(d), Some((first, from))) if !first.same(&d) => {
                    let (from, first) = (*from, *first);
                    let fault = mismatch_inside(self, [(from, &first), (id, &d)], (en, ru));
                    return self.fail(fault);
                }
                (Kind::Known(d), Some((first, _))) => *first = first.with_angle_of(&d),
            }
        }
        let fault = turns::in_sum(&known, &|id| self.span(id));
        // one complaint is enough
        let settle = |d: Dimension| if fault.is_some() { d.without_periods() } else { d };
        let kind = match result {
            _ if unknown => Kind::Unknown,
            Some((d, _)) => Kind::Known(settle(d)),
            None => Kind::Any,
        };
        self.faults.extend(fault);
        kind
    }

    fn product(&mut self, factors: &[(bool, NodeId)], span: &Range<usize>) -> Kind {
        let mut result = Dimension::NONE;
        let (mut any, mut unknown) = (false, false);
        for (inverse, id) in factors {
            if *inverse && self.rationals[*id].as_ref().is_some_and(Rational::is_zero) {
                let at = self.span(*id);
                return self.fail(
                    Notice::piece("M042", at, "division by zero", "деление на нуль")
                        .why("no number comes out of it", "результат не является числом"),
                );
            }
            match self.kinds[*id] {
                Kind::Unknown => unknown = true,
                Kind::Any => any = true,
                Kind::Known(d) => match if *inverse { result.div(&d) } else { result.mul(&d) } {
                    Some(d) => result = d,
                    None => return self.fail(wild_exponent(span.clone())),
                },
            }
        }
        self.faults.extend(turns::over_sixty(self.formula, factors, &self.kinds, span));
        match (unknown, any) {
            (true, _) => Kind::Unknown,
            (_, true) => Kind::Any,
            _ => Kind::Known(turns::settled(result)),
        }
    }

    fn raise(&mut self, base: Kind, exponent: &Rational, span: &Range<usize>) -> Kind {
        match base {
            Kind::Known(d) => match d.pow(exponent) {
                Some(d) => Kind::Known(turns::settled(d)),
                None if d.is_none() => Kind::Known(Dimension::NONE),
                None => self.fail(wild_exponent(span.clone())),
            },
            other => other,
        }
    }

    fn power(&mut self, base: NodeId, exponent: NodeId, span: &Range<usize>) -> Kind {
        if let Kind::Known(d) = self.kinds[exponent]
            && !d.is_none()
        {
            let fault = Notice::piece(
                "M026",
                self.span(exponent),
                format!("an exponent must be a pure number, this is {}", si_label(&d)),
                format!("показатель степени должен быть числом, а это {}", si_label_ru(&d)),
            );
            return self.fail(fault);
        }
        let value = self.rationals[exponent].clone();
        match (value, self.kinds[base]) {
            (Some(e), Kind::Any) if e.is_negative() => {
                self.fail(Notice::piece("M042", span.clone(), "a negative power of zero", "отрицательная степень нуля"))
            }
            (Some(e), Kind::Any) if e.is_zero() => Kind::Known(Dimension::NONE),
            (Some(e), base) => self.raise(base, &e, span),
            (None, Kind::Known(d)) if !d.is_none() => {
                let fault = Notice::piece(
                    "M026",
                    self.span(exponent),
                    format!("the base is {}: its exponent must be a plain number, not a formula", si_label(&d)),
                    format!("основание имеет размерность {}: показатель должен быть числом, а не формулой", si_label_ru(&d)),
                )
                .help(
                    "divide the base by a quantity of its own dimension first",
                    "сначала разделите основание на величину той же размерности",
                );
                self.fail(fault)
            }
            (None, Kind::Unknown) => Kind::Unknown,
            (None, _) => Kind::Known(Dimension::NONE),
        }
    }

    fn call(&mut self, function: Function, arguments: &[NodeId]) -> Kind {
        use Function::{Abs, Acos, Asin, Atan, Atan2, Max, Min, Sign};
        let first = self.kinds[arguments[0]];
        match function {
            Abs => first,
            Sign => Kind::Known(Dimension::NONE),
            Min | Max => self.alike(arguments.iter().copied(), "arguments", "аргументы"),
            Atan2 => {
                self.alike(arguments.iter().copied(), "arguments", "аргументы");
                Kind::Known(Dimension::ANGLE)
            }
            _ => {
                if let Kind::Known(d) = first
                    && !d.is_none()
                {
                    let (name, got, got_ru) = (function.name(), si_label(&d), si_label_ru(&d));
                    let fault = Notice::piece(
                        "M026",
                        self.span(arguments[0]),
                        format!("{name} takes an angle or a pure number, this is {got}"),
                        format!("аргумент {name} — угол или число, а здесь {got_ru}"),
                    )
                    .why("a factor or a divisor is missing", "вероятно, пропущен множитель или делитель");
                    return self.fail(fault);
                }
                if let Kind::Known(d) = first {
                    self.faults.extend(turns::in_argument(function, &d, self.span(arguments[0])));
                }
                Kind::Known(if matches!(function, Asin | Acos | Atan) { Dimension::ANGLE } else { Dimension::NONE })
            }
        }
    }

    fn kinematic(
        &mut self,
        function: &KinematicFunction,
        arguments: &[(Option<String>, String, Range<usize>)],
        span: &Range<usize>,
    ) -> Kind {
        let request = self.scope.request(function, arguments, span);
        let reaction = matches!(request, Ok((RequestKind::Reaction(..), _)));
        let needed = if reaction { Where::Reactions } else { function.allowed };
        if self.context.kinematic.is_none_or(|level| needed > level) {
            let fault = if reaction { misplaced_reaction(function.name, span) } else { misplaced(function.name, span) };
            return self.fail(fault.why(self.context.en, self.context.ru));
        }
        match request {
            Ok((_, kind)) => {
                self.use_of(if reaction { Depends::REACTION } else { function.depends }, function.name, span);
                kind
            }
            Err(fault) => self.fail(fault),
        }
    }

    /// The exact value of a node made of small numbers.
    fn rational(&self, node: &Ast) -> Option<Rational> {
        let small = |r: Rational| {
            let (n, d) = r.digits();
            (n.len() + d.len() <= 30).then_some(r)
        };
        match node {
            Ast::Number(n) => small(n.clone()),
            Ast::Sum(terms) => terms.iter().try_fold(Rational::ZERO, |sum, (negative, id)| {
                let term = self.rationals[*id].as_ref()?;
                small(if *negative { &sum - term } else { &sum + term })
            }),
            Ast::Product(factors) => factors.iter().try_fold(Rational::ONE, |product, (inverse, id)| {
                let factor = self.rationals[*id].as_ref()?;
                small(if *inverse { &product / &factor.recip().map(|_| factor.clone())? } else { &product * factor })
            }),
            _ => None,
        }
    }
}

fn misplaced(name: &str, span: &Range<usize>) -> Notice {
    Notice::piece(
        "M037",
        span.clone(),
        format!("{name}(...) cannot be used here"),
        format!("функцию {name}(...) здесь использовать нельзя"),
    )
    .help(
        "kinematic functions stand in outputs, forces, torques, pathways and potentials; energies and accelerations in outputs only",
        "кинематические функции допустимы в outputs, forces, torques, координатах элементов и potentials; энергии и ускорения — только в outputs",
    )
}

/// A reaction follows from the motion; what decides the motion may not depend on it, except dry friction, which knows how.
fn misplaced_reaction(name: &str, span: &Range<usize>) -> Notice {
    Notice::piece(
        "M076",
        span.clone(),
        format!("the reaction {name}(...) cannot be used here"),
        format!("реакцию {name}(...) здесь использовать нельзя"),
    )
    .help(
        "a reaction follows from the motion: it stands in [outputs] and in `normal` of [frictions]",
        "реакция следует из движения: она допустима в [outputs] и в `normal` таблиц [frictions]",
    )
}

fn mismatch_inside(pass: &Pass, [(from, first), (id, second)]: [(NodeId, &Dimension); 2], (en, ru): (&str, &str)) -> Notice {
    let (left, right) = (si_label(first), si_label(second));
    let (left_ru, right_ru) = (si_label_ru(first), si_label_ru(second));
    let (a, b) = (pass.span(from), pass.span(id));
    Notice::piece(
        "M025",
        a.start.min(b.start)..b.end.max(a.end),
        format!("{en} differ in dimension: left is {left}, right is {right}"),
        format!("{ru} разной размерности: слева {left_ru}, справа {right_ru}"),
    )
    .why("a factor (a length, a time, a mass) is missing or one too many", "пропущен или лишний множитель (длина, время, масса)")
}

fn wild_exponent(span: Range<usize>) -> Notice {
    Notice::piece("M026", span, "the dimension of this power is out of bounds", "размерность этой степени недопустима")
}

fn unknown_name(name: &str, span: Range<usize>, scope: &Scope) -> Notice {
    let fault = Notice::piece("M013", span, format!("unknown name `{name}`"), format!("неизвестное имя `{name}`"));
    if scope.place(name).is_some() {
        return fault.help(
            format!("`{name}` is a point or a body; its coordinates are x({name}), y({name})"),
            format!("`{name}` — точка или тело; её координаты: x({name}), y({name})"),
        );
    }
    if let Some(near) = scope.nearest(name, scope.names()) {
        return fault.meant(name, near);
    }
    if name == "e" {
        return fault.help("the exponential is written exp(x)", "экспонента записывается exp(x)");
    }
    if crate::units::parse_unit(name).is_ok() {
        return fault.help(
            format!("a unit stands in square brackets after a number: `1 [{name}]`; or declare {name} in [parameters]"),
            format!("единица стоит в квадратных скобках после числа: `1 [{name}]`; или объявите {name} в [parameters]"),
        );
    }
    fault.help(format!("declare {name} in [parameters]"), format!("объявите {name} в [parameters]"))
}
