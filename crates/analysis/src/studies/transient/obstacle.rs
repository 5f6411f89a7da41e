//! Why a system has no closed form, and the expression that shows it.

use crate::Fault;
use symbolic::Expr;
use words::{Message, Text};

/// Why an expression has no place in a linear system, and the expression.
#[derive(Clone, Copy, Debug)]
pub struct Obstacle(pub Reason, pub Expr);

/// What an expression is that has no place in a linear system.
#[derive(Clone, Copy, Debug)]
pub enum Reason {
    /// A product or a function of motions.
    NotLinear,
    /// A coefficient that changes with time.
    Varying,
    /// A load that is no exponential polynomial.
    NoClosedForm,
}

/// A value or the obstacle.
pub type Result<T> = std::result::Result<T, Obstacle>;

impl Obstacle {
    /// As a fault of the study; `start` is the start of the phase.
    pub fn fault(self, start: f64) -> Fault {
        let Obstacle(reason, e) = self;
        let at = words::digits::number(start);
        let message = match reason {
            Reason::NotLinear => Message {
                code: "S070",
                what: Text::new("the system is not linear, so it has no closed form", "система нелинейна, и замкнутого решения у неё нет"),
                why: Text::new(
                    "this term contains a product or a function of coordinates or rates",
                    "этот член содержит произведение или функцию координат или скоростей",
                ),
                help: Text::new(
                    "use the study simulate, or ask for small motions about the equilibrium: linearise = true, --linearise",
                    "примените расчёт simulate или запросите малые движения около равновесия: linearise = true, --linearise",
                ),
            },
            Reason::Varying => Message {
                code: "S071",
                what: Text::new("a coefficient of the system changes with time", "коэффициент системы меняется со временем"),
                why: Text::new(
                    "mass, damping or stiffness may change at switches only, not within a phase",
                    "масса, сопротивление и жёсткость могут меняться только при переключениях, но не внутри этапа",
                ),
                help: Text::new("use the study simulate", "примените расчёт simulate"),
            },
            Reason::NoClosedForm => Message {
                code: "S072",
                what: Text::new(
                    format!("a load has no closed form within the phase from {} s", at.en),
                    format!("нагрузка на этапе с {} с не имеет замкнутого решения", at.ru),
                ),
                why: Text::new(
                    "loads are sums of constants, powers of t, sin(p t + d) with a constant frequency p, exp(-a t), and their products",
                    "нагрузки — это суммы постоянных, степеней t, sin(p t + d) с постоянной частотой p, exp(-a t) и их произведений",
                ),
                help: Text::new(
                    "keep the frequency constant within a phase (phases may change it), or use the study simulate",
                    "задайте на каждом этапе постоянную частоту (её может сменить следующий этап) или примените расчёт simulate",
                ),
            },
        };
        Fault::new(message).about(Some(e))
    }
}

/// The fault of a machine with connections.
pub fn connected() -> Fault {
    Fault::new(Message {
        code: "S074",
        what: Text::new("the machine has connections", "в машине есть связи"),
        why: Text::new(
            "the closed form needs independent coordinates; connections, stops and friction keep reactions as unknowns",
            "замкнутое решение требует независимых координат; связи, упоры и трение оставляют реакции неизвестными",
        ),
        help: Text::new(
            "place the bodies by formulas of independent coordinates, or use the study simulate",
            "задайте положения тел формулами независимых координат или примените расчёт simulate",
        ),
    })
}
