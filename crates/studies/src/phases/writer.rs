//! The solution of one oscillator in one phase, written.

use super::setting::{Setting, exponential, fence, fraction, minus, negative, plus, power, product, root, square, whole};
use algebra::complex;
use analysis::studies::transient::Phase;
use analysis::studies::transient::constants::{Clock, Forcing, Listed};
use analysis::studies::transient::load::{Load, Term};
use analysis::studies::transient::oscillator::Case;
use report::Block;
use report::formula::{Layout, Sign};
use symbolic::Equations;

/// How an equation stands on the page.
#[derive(Clone, Copy, PartialEq)]
enum Written {
    Letters,
    Numbers,
}

/// Whether the system is that of the phase before, whose constants were written there.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum System {
    AsBefore,
    New,
}

/// Writes the solution of one oscillator in one phase: that of one degree of freedom, or a principal coordinate.
pub(super) struct Writer<'a> {
    set: &'a Setting,
    listed: &'a Listed<'a>,
    /// q, q', q''.
    q: [Layout; 3],
    units: [String; 2],
    /// Start of the phase.
    start: f64,
    state: [f64; 2],
    /// The load per unit of inertia that is neither constant nor harmonic.
    rest: Load,
}

impl<'a> Writer<'a> {
    pub(super) fn new(set: &'a Setting, equations: &'a Equations, listed: &'a Listed<'a>, phase: &Phase) -> Writer<'a> {
        let coordinate = &equations.coordinates[0];
        let q = coordinate.symbols.map(|s| Layout::Symbol(set.printer.identifier(equations.graph.symbol_info(s))));
        let unit = coordinate.unit.clone();
        let rate = if unit == "1" { "1/s".to_owned() } else { format!("{unit}/s") };
        let state = [phase.state_at_start[0], phase.state_at_start[1]];
        Writer { set, listed, q, units: [unit, rate], start: phase.start, state, rest: rest(listed) }
    }

    /// Of a principal coordinate of this letter.
    pub(super) fn of_mode(set: &'a Setting, letter: &str, listed: &'a Listed<'a>, phase: &Phase) -> Writer<'a> {
        let q = ["", "'", "''"].map(|primes| set.letter(&format!("{letter}{primes}")));
        let o = &listed.mode.oscillator;
        Writer { set, listed, q, units: ["1".into(), "1/s".into()], start: phase.start, state: [o.x0, o.v0], rest: rest(listed) }
    }

    /// Its equation and its motion with their numbers.
    pub(super) fn in_numbers(&self) -> [Block; 2] {
        [self.equation(Written::Numbers), self.line(vec![self.q[0].clone(), self.numeric()])]
    }

    fn line(&self, parts: Vec<Layout>) -> Block {
        Block::Equation { formula: self.set.chain(parts), numbered: false }
    }
    fn letter(&self, name: &str) -> Layout {
        self.set.letter(name)
    }
    fn words(&self, en: &str, ru: &str) -> Block {
        Block::paragraph(self.set.language.pick(en, ru).to_owned())
    }

    pub(super) fn solution(&self, system: System) -> Vec<Block> {
        let mut blocks = vec![self.equation(Written::Letters), self.equation(Written::Numbers)];
        if system == System::New {
            blocks.extend(self.system());
        }
        for (i, forcing) in self.listed.forcing.iter().enumerate() {
            blocks.extend(self.forced(forcing, &self.index(i)));
        }
        blocks.extend(self.statics());
        blocks.extend(self.particular());
        blocks.push(self.words("General solution:", "Общее решение:"));
        blocks.push(self.line(vec![self.q[0].clone(), self.general()]));
        if self.start > 0.0 {
            blocks.push(self.line(vec![self.letter("τ"), minus(self.letter("t"), self.set.size(self.start))]));
        }
        blocks.extend(self.constants());
        blocks.push(self.words("The motion on this phase:", "Движение на этом этапе:"));
        blocks.push(self.line(vec![self.q[0].clone(), self.numeric()]));
        blocks
    }

    /// Index of a harmonic when there are several.
    fn index(&self, i: usize) -> String {
        if self.listed.forcing.len() > 1 { (i + 1).to_string() } else { String::new() }
    }

    /// a q'' + b q' + c q = H sin pt, in letters or in numbers.
    fn equation(&self, written: Written) -> Block {
        let numbers = written == Written::Numbers;
        let o = &self.listed.mode.oscillator;
        let a = self.listed.inertia;
        let coefficients = [("a", a, 2), ("b", 2.0 * o.n * a, 1), ("c", o.k2 * a, 0)];
        let left = coefficients.iter().filter(|(_, x, _)| *x != 0.0).map(|(name, x, order)| {
            let q = self.q[*order].clone();
            if numbers { self.set.term(*x, vec![q]) } else { (Sign::Plus, product(vec![self.letter(name), q])) }
        });
        let mut right = Vec::new();
        for (i, f) in self.listed.forcing.iter().enumerate() {
            let index = self.index(i);
            // the frequency keeps its letter: its number stands in the substitutions below
            let wave = self.wave(f, &index, if f.delta == 0.0 { Written::Letters } else { written }, 0.0);
            let size = a * f.harmonic.h;
            right.push(if numbers {
                self.set.term(size, vec![wave])
            } else {
                (Sign::Plus, product(vec![self.letter(&format!("H{index}")), wave]))
            });
        }
        let constant = a * self.constant();
        if constant != 0.0 {
            right.push(if numbers { self.set.term(constant, vec![]) } else { (Sign::Plus, self.letter("F_0")) });
        }
        if !self.rest.is_zero() {
            let terms = self.load_terms(&self.rest, a);
            right.extend(if numbers { terms } else { vec![(Sign::Plus, self.function("f"))] });
        }
        if right.is_empty() {
            right.push((Sign::Plus, whole(0)));
        }
        self.line(vec![Layout::Sum(left.collect()), Layout::Sum(right)])
    }

    /// Time from the start of the phase, which for the first one is the time of the motion.
    fn clock(&self) -> Layout {
        self.letter(if self.start > 0.0 { "τ" } else { "t" })
    }

    fn function(&self, name: &str) -> Layout {
        Layout::Row(vec![self.letter(name), fence(self.clock())])
    }

    fn constant(&self) -> f64 {
        self.listed.constant()
    }

    /// sin(p t + δ - lag); in numbers the phases are one.
    fn wave(&self, f: &Forcing, index: &str, written: Written, lag: f64) -> Layout {
        let numbers = written == Written::Numbers;
        let clock = self.letter(if f.clock == Clock::Phase { "τ" } else { "t" });
        let p = if numbers { self.set.size(f.harmonic.p) } else { self.letter(&format!("p{index}")) };
        let angle = product(vec![p, clock]);
        let mut terms = vec![(Sign::Plus, angle)];
        if numbers {
            let phase = turned(f.delta - lag);
            terms.extend((phase != 0.0).then(|| self.set.term(phase, vec![])));
        } else {
            let phases = [(f.delta, Sign::Plus, "delta"), (lag, Sign::Minus, "epsilon")];
            terms.extend(phases.into_iter().filter(|p| p.0 != 0.0).map(|(_, sign, name)| (sign, self.letter(&format!("{name}{index}")))));
        }
        let argument = if terms.len() == 1 { terms.remove(0).1 } else { Layout::Sum(terms) };
        self.set.wave("sin", argument)
    }

    /// n, k, the kind of damping, k1 or the roots.
    fn system(&self) -> Vec<Block> {
        let (set, o, c) = (self.set, &self.listed.mode.oscillator, &self.listed.constants);
        let a = self.listed.inertia;
        let mut blocks = vec![self.line(vec![
            self.letter("n"),
            fraction(self.letter("b"), product(vec![whole(2), self.letter("a")])),
            fraction(set.number(2.0 * o.n * a), product(vec![whole(2), set.size(a)])),
            set.result(o.n, "1/s"),
        ])];
        if o.k2 >= 0.0 {
            blocks.push(self.line(vec![
                self.letter("k"),
                root(fraction(self.letter("c"), self.letter("a"))),
                root(fraction(set.size(o.k2 * a), set.size(a))),
                set.result(o.k2.sqrt(), "rad/s"),
            ]));
        } else {
            blocks.push(self.line(vec![
                square(self.letter("k")),
                fraction(self.letter("c"), self.letter("a")),
                fraction(set.number(o.k2 * a), set.size(a)),
                set.result(o.k2, "1/s^2"),
            ]));
        }
        let (en, ru) = match c.case {
            Case::Underdamped if o.n < 0.0 => {
                ("n < 0: negative damping, growing oscillations.", "n < 0: отрицательное сопротивление, нарастающие колебания.")
            }
            Case::Critical | Case::Overdamped if o.n < 0.0 => (
                "n < 0, |n| ≥ k: negative damping, growth without oscillation.",
                "n < 0, |n| ≥ k: отрицательное сопротивление, нарастание без колебаний.",
            ),
            Case::Undamped => ("n = 0: no damping.", "n = 0: сопротивления нет."),
            Case::Underdamped => ("n < k: small damping, decaying oscillations.", "n < k: малое сопротивление, затухающие колебания."),
            Case::Critical => ("n = k: critical damping.", "n = k: критическое (граничное) сопротивление."),
            Case::Overdamped => ("n > k: large damping, aperiodic motion.", "n > k: большое сопротивление, апериодическое движение."),
            Case::Free => ("c = 0: nothing pulls back to the equilibrium.", "c = 0: восстанавливающей силы нет."),
            Case::Unstable => ("c < 0: the equilibrium is unstable.", "c < 0: положение равновесия неустойчиво."),
        };
        blocks.push(self.words(en, ru));
        blocks.extend(self.roots());
        blocks
    }

    /// The decaying oscillation or the roots of the characteristic equation.
    fn roots(&self) -> Vec<Block> {
        let (set, o, c) = (self.set, &self.listed.mode.oscillator, &self.listed.constants);
        let mut blocks = Vec::new();
        let (n2, k2) = (square(self.letter("n")), square(self.letter("k")));
        let k = o.k2.max(0.0).sqrt();
        match c.case {
            Case::Underdamped => {
                let numbers = minus(square(set.size(k)), square(set.factor(o.n)));
                blocks.push(self.line(vec![self.letter("k1"), root(minus(k2, n2)), root(numbers), set.result(c.k1, "rad/s")]));
                let period = std::f64::consts::TAU / c.k1;
                let two_pi = product(vec![whole(2), self.letter("π")]);
                blocks.push(self.line(vec![self.letter("T1"), fraction(two_pi, self.letter("k1")), set.result(period, "s")]));
                let decrement = product(vec![self.letter("n"), self.letter("T1")]);
                blocks.push(self.line(vec![self.letter("Λ"), decrement, set.result(o.n * period, "1")]));
                blocks.push(self.words(
                    "k₁ is the frequency of the decaying oscillations, T₁ their period, Λ their logarithmic decrement (δ in the table of modes).",
                    "k₁ – частота затухающих колебаний, T₁ – их период, Λ – логарифмический декремент (в таблице форм – δ).",
                ));
            }
            Case::Overdamped => {
                let numbers = minus(square(set.factor(o.n)), square(set.size(k)));
                blocks.push(self.line(vec![self.letter("k1"), root(minus(n2, k2)), root(numbers), set.result(c.k1, "1/s")]));
                // the first root is the one nearer to zero: -n + k1 with damping, -n - k1 with growth
                let (near, far) = if o.n < 0.0 { (Sign::Minus, Sign::Plus) } else { (Sign::Plus, Sign::Minus) };
                for (name, sign, root) in [("r1", near, c.roots[0]), ("r2", far, c.roots[1])] {
                    let sum = Layout::Sum(vec![(Sign::Minus, self.letter("n")), (sign, self.letter("k1"))]);
                    blocks.push(self.line(vec![self.letter(name), sum, set.result(root.re, "1/s")]));
                }
            }
            Case::Free | Case::Unstable if c.roots[0] != c.roots[1] => {
                blocks.push(self.line(vec![self.letter("r1"), set.result(c.roots[0].re, "1/s")]));
                blocks.push(self.line(vec![self.letter("r2"), set.result(c.roots[1].re, "1/s")]));
            }
            _ => {}
        }
        blocks
    }

    /// h, D and ε of a harmonic.
    fn forced(&self, f: &Forcing, index: &str) -> Vec<Block> {
        let (set, o, a) = (self.set, &self.listed.mode.oscillator, self.listed.inertia);
        let letter = |name: &str| self.letter(&format!("{name}{index}"));
        let (h, p, k) = (f.harmonic.h, f.harmonic.p, o.k2.max(0.0).sqrt());
        let unit = if self.units[0] == "1" { "1/s^2".to_owned() } else { format!("{}/s^2", self.units[0]) };
        let mut blocks = vec![self.line(vec![
            letter("h"),
            fraction(letter("H"), self.letter("a")),
            fraction(set.size(a * h), set.size(a)),
            set.result(h, &unit),
        ])];
        let Some(amplitude) = f.harmonic.amplitude else {
            blocks.push(self.words(
                "p = k without damping: resonance, the forced motion grows in proportion to time.",
                "p = k без сопротивления: резонанс, вынужденные колебания растут пропорционально времени.",
            ));
            return blocks;
        };
        let difference = minus(square(self.letter("k")), square(letter("p")));
        let damping = product(vec![whole(4), square(self.letter("n")), square(letter("p"))]);
        // of an unstable equilibrium k² is a negative number, and k none
        let stiffness = if o.k2 < 0.0 { set.number(o.k2) } else { square(set.size(k)) };
        let numbers = minus(stiffness, square(set.size(p)));
        let damping_number = product(vec![whole(4), square(set.factor(o.n)), square(set.size(p))]);
        if o.n == 0.0 {
            let bars = |x: Layout| Layout::Fence(report::formula::Bracket::Bar, Box::new(x));
            blocks.push(self.line(vec![
                letter("D"),
                fraction(letter("h"), bars(difference)),
                fraction(set.size(h), bars(numbers)),
                set.result(amplitude, &self.units[0]),
            ]));
            let (en, ru) = if o.k2 < 0.0 {
                (
                    "k² < p²: the forced motion is opposite to the load, ε = π.",
                    "k² < p²: вынужденные колебания в противофазе с нагрузкой, ε = π.",
                )
            } else if p > k {
                (
                    "p > k: the forced motion is opposite to the load, ε = π.",
                    "p > k: вынужденные колебания в противофазе с нагрузкой, ε = π.",
                )
            } else {
                ("p < k: the forced motion follows the load, ε = 0.", "p < k: вынужденные колебания в фазе с нагрузкой, ε = 0.")
            };
            blocks.push(self.words(en, ru));
            return blocks;
        }
        blocks.push(self.line(vec![
            letter("D"),
            fraction(letter("h"), root(plus(vec![square(fence(difference.clone())), damping]))),
            fraction(set.size(h), root(plus(vec![square(fence(numbers.clone())), damping_number]))),
            set.result(amplitude, &self.units[0]),
        ]));
        blocks.extend(self.lag(f, index, (difference, numbers)));
        blocks
    }

    /// tan ε = 2 n p/(k² − p²), and ε.
    fn lag(&self, f: &Forcing, index: &str, (difference, numbers): (Layout, Layout)) -> [Block; 2] {
        let (set, o, p) = (self.set, &self.listed.mode.oscillator, f.harmonic.p);
        let letter = |name: &str| self.letter(&format!("{name}{index}"));
        let tangent = self.line(vec![
            set.wave(set.language.pick("tan", "tg"), letter("epsilon")),
            fraction(product(vec![whole(2), self.letter("n"), letter("p")]), difference),
            fraction(product(vec![whole(2), set.factor(o.n), set.size(p)]), numbers),
            set.result(2.0 * o.n * p / (o.k2 - p * p), ""),
        ]);
        [tangent, self.line(vec![letter("epsilon"), set.result(f.harmonic.lag, "rad")])]
    }

    fn statics(&self) -> Vec<Block> {
        let (set, k2, a) = (self.set, self.listed.mode.oscillator.k2, self.listed.inertia);
        let Some(standing) = self.listed.standing() else { return Vec::new() };
        vec![self.line(vec![
            self.static_letter(),
            fraction(self.letter("F_0"), self.letter("c")),
            fraction(set.number(a * self.constant()), set.number(a * k2)),
            set.result(standing, &self.units[0]),
        ])]
    }

    /// The forced motion that is neither harmonic nor constant.
    fn particular(&self) -> Vec<Block> {
        let further = self.listed.further();
        if further.is_zero() {
            return Vec::new();
        }
        vec![
            self.words("A particular solution for the other parts of the load:", "Частное решение для остальных частей нагрузки:"),
            self.line(vec![self.function("f_*"), Layout::Sum(self.load_terms(&further, 1.0))]),
        ]
    }

    fn static_letter(&self) -> Layout {
        self.letter(self.set.language.pick("q_st", "q_ст"))
    }

    /// The parts of the forced motion, in letters: D sin(pt - ε), the static one, the rest.
    fn forced_terms(&self) -> Vec<(Sign, Layout)> {
        let mut terms = Vec::new();
        for (i, f) in self.listed.forcing.iter().enumerate() {
            let index = self.index(i);
            if f.harmonic.amplitude.is_some() {
                let wave = self.wave(f, &index, Written::Letters, f.harmonic.lag);
                terms.push((Sign::Plus, product(vec![self.letter(&format!("D{index}")), wave])));
            }
        }
        terms.extend(self.listed.standing().map(|_| (Sign::Plus, self.static_letter())));
        terms.extend((!self.listed.further().is_zero()).then(|| (Sign::Plus, self.function("f_*"))));
        terms
    }

    fn general(&self) -> Layout {
        let tau = || self.clock();
        let (c1, c2) = (self.letter("C1"), self.letter("C2"));
        let decay = || exponential(negative(product(vec![self.letter("n"), tau()])));
        let free = match self.listed.constants.case {
            Case::Undamped | Case::Underdamped => {
                let k1 = if self.listed.constants.case == Case::Undamped { "k" } else { "k1" };
                let angle = || product(vec![self.letter(k1), tau()]);
                let waves = vec![
                    (Sign::Plus, product(vec![c1, self.set.wave("cos", angle())])),
                    (Sign::Plus, product(vec![c2, self.set.wave("sin", angle())])),
                ];
                if self.listed.constants.case == Case::Undamped {
                    waves
                } else {
                    vec![(Sign::Plus, product(vec![decay(), fence(Layout::Sum(waves))]))]
                }
            }
            Case::Critical => vec![(Sign::Plus, product(vec![decay(), fence(plus(vec![c1, product(vec![c2, tau()])]))]))],
            _ if self.listed.constants.roots[0] == self.listed.constants.roots[1] => {
                vec![(Sign::Plus, c1), (Sign::Plus, product(vec![c2, tau()]))]
            }
            _ => {
                let e = |r: &str| exponential(product(vec![self.letter(r), tau()]));
                vec![(Sign::Plus, product(vec![c1, e("r1")])), (Sign::Plus, product(vec![c2, e("r2")]))]
            }
        };
        Layout::Sum(free.into_iter().chain(self.forced_terms()).collect())
    }

    /// C1 and C2 from the state at the start of the phase.
    fn constants(&self) -> Vec<Block> {
        let (set, c, o) = (self.set, &self.listed.constants, &self.listed.mode.oscillator);
        let [q0, v0] = self.state;
        let (f0, w0) = (c.forced.at(0.0), c.forced.derivative().at(0.0));
        let zero = if self.start > 0.0 { "τ = 0" } else { "t = 0" };
        let mut blocks = vec![self.words(
            &format!("Constants from the state at {zero}, A and B being displacement and rate of the free motion there, q_f the forced motion:"),
            &format!("Постоянные из состояния при {zero}; A и B – отклонение и скорость свободного движения в этот момент, q_в – вынужденное движение:"),
        )];
        let difference =
            |x: f64, y: f64| Layout::Sum(vec![(if x < 0.0 { Sign::Minus } else { Sign::Plus }, set.size(x)), set.term(-y, vec![])]);
        let at = |name: &str| self.letter(name);
        blocks.push(self.line(vec![
            at("A"),
            minus(self.initial(0), at(set.language.pick("q_f", "q_в"))),
            difference(q0, f0),
            set.result(q0 - f0, &self.units[0]),
        ]));
        blocks.push(self.line(vec![
            at("B"),
            minus(self.initial(1), at(set.language.pick("q_f'", "q_в'"))),
            difference(v0, w0),
            set.result(v0 - w0, &self.units[1]),
        ]));
        let (a, b) = (q0 - f0, v0 - w0);
        let [c1, c2] = c.free;
        let n_a = || product(vec![at("n"), at("A")]);
        let n_a_number = || product(vec![set.factor(o.n), set.factor(a)]);
        let sum_number = || Layout::Sum(vec![(if b < 0.0 { Sign::Minus } else { Sign::Plus }, set.size(b)), (Sign::Plus, n_a_number())]);
        match c.case {
            Case::Undamped | Case::Underdamped => {
                let (top, top_number) = if o.n == 0.0 { (at("B"), set.number(b)) } else { (plus(vec![at("B"), n_a()]), sum_number()) };
                let k1 = if c.case == Case::Undamped { "k" } else { "k1" };
                blocks.push(self.line(vec![at("C1"), at("A"), set.result(c1, &self.units[0])]));
                blocks.push(self.line(vec![
                    at("C2"),
                    fraction(top, at(k1)),
                    fraction(top_number, set.size(c.k1)),
                    set.result(c2, &self.units[0]),
                ]));
            }
            _ if c.roots[0] == c.roots[1] => {
                blocks.push(self.line(vec![at("C1"), at("A"), set.result(c1, &self.units[0])]));
                blocks.push(self.line(vec![at("C2"), plus(vec![at("B"), n_a()]), sum_number(), set.result(c2, &self.units[1])]));
            }
            _ => {
                let (r1, r2) = (c.roots[0].re, c.roots[1].re);
                let top = minus(at("B"), product(vec![at("r2"), at("A")]));
                let top_number = minus(set.number(b), product(vec![set.factor(r2), set.factor(a)]));
                let below = minus(at("r1"), at("r2"));
                blocks.push(self.line(vec![
                    at("C1"),
                    fraction(top, below),
                    fraction(top_number, set.number(r1 - r2)),
                    set.result(c1, &self.units[0]),
                ]));
                blocks.push(self.line(vec![at("C2"), minus(at("A"), at("C1")), set.result(c2, &self.units[0])]));
            }
        }
        blocks
    }

    /// q or q' at the start of the phase, in the time of the motion.
    fn initial(&self, order: usize) -> Layout {
        let start = if self.start > 0.0 { self.set.size(self.start) } else { whole(0) };
        Layout::Row(vec![self.q[order].clone(), fence(start)])
    }

    /// The solution with its numbers.
    fn numeric(&self) -> Layout {
        let (set, c, o) = (self.set, &self.listed.constants, &self.listed.mode.oscillator);
        let tau = || self.clock();
        let [c1, c2] = c.free;
        let decay = |rate: f64| exponential(Layout::Sum(vec![set.term(rate, vec![tau()])]));
        let mut terms = match c.case {
            Case::Undamped | Case::Underdamped => {
                let angle = || product(vec![set.size(c.k1), tau()]);
                let waves = vec![set.term(c1, vec![set.wave("cos", angle())]), set.term(c2, vec![set.wave("sin", angle())])];
                if o.n == 0.0 { waves } else { vec![(Sign::Plus, product(vec![decay(-o.n), fence(Layout::Sum(waves))]))] }
            }
            _ if c.roots[0] == c.roots[1] => {
                let inner = vec![set.term(c1, vec![]), set.term(c2, vec![tau()])];
                if o.n == 0.0 { inner } else { vec![(Sign::Plus, product(vec![decay(-o.n), fence(Layout::Sum(inner))]))] }
            }
            _ => vec![set.term(c1, vec![decay(c.roots[0].re)]), set.term(c2, vec![decay(c.roots[1].re)])],
        };
        for f in &self.listed.forcing {
            if let Some(amplitude) = f.harmonic.amplitude {
                terms.push(set.term(amplitude, vec![self.wave(f, "", Written::Numbers, f.harmonic.lag)]));
            }
        }
        terms.extend(self.listed.standing().map(|x| set.term(x, vec![])));
        terms.extend(self.load_terms(&self.listed.further(), 1.0));
        Layout::Sum(terms)
    }

    /// factor · Σ c τ^k e^(στ) cos(pτ + δ) with numbers.
    fn load_terms(&self, load: &Load, factor: f64) -> Vec<(Sign, Layout)> {
        let set = self.set;
        let tau = || self.clock();
        let mut terms = Vec::new();
        for t in load.0.iter().filter(|t| t.rate.im >= 0.0) {
            let mut parts = match t.power {
                0 => vec![],
                1 => vec![tau()],
                n => vec![power(tau(), n)],
            };
            if t.rate.re != 0.0 {
                parts.push(exponential(Layout::Sum(vec![set.term(t.rate.re, vec![tau()])])));
            }
            let size = if t.rate.im == 0.0 {
                t.factor.re
            } else {
                let angle = product(vec![set.size(t.rate.im), tau()]);
                parts.push(set.wave("cos", set.shifted(angle, complex::arg(t.factor))));
                2.0 * complex::abs(t.factor)
            };
            terms.push(set.term(factor * size, parts));
        }
        terms
    }
}

/// The load per unit of inertia that is neither constant nor harmonic.
fn rest(listed: &Listed) -> Load {
    let plain = |t: &&Term| t.power == 0 && t.rate.re == 0.0;
    Load(listed.mode.oscillator.load.0.iter().filter(|t| !plain(t)).copied().collect())
}

/// An angle within -π..π; a lag that meets its phase leaves nothing.
fn turned(angle: f64) -> f64 {
    use std::f64::consts::TAU;
    let within = angle - TAU * (angle / TAU).round();
    // whole turns taken off leave their rounding
    if within.abs() < 1e-13 { 0.0 } else { within }
}
