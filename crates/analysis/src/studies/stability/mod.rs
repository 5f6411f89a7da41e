//! Stability of linear equations with periodic coefficients: exponents, verdict, resonances; Hill's equation where there is one degree of freedom.
//!
//! ```text
//! x' = A(t) x, A(t + T) = A(t)      x(T) = M x(0), multipliers μ = eigenvalues of M, exponents s = ln μ / T
//! q'' + 2 h(t) q' + k(t) q = 0      q = y exp(-∫h dt):  y'' + ψ y = 0,  ψ = k - h² - h'
//! ```
//!
//! *Source*: V. A. Yakubovich, V. M. Starzhinskii, Linear Differential Equations with Periodic Coefficients, 1975, ch. II, IV, VI.

mod collocation;
mod diagram;
mod floquet;
mod lyapunov;
mod resonance;
mod scalar;
mod sheeted;
mod standing;
mod tongues;

pub use collocation::by_collocation;
pub use diagram::{Damped, Diagram, Equations, Family, TRACE};
pub use floquet::{Exponent, Verdict, exponents, growth, verdict, without_clocks};
pub use lyapunov::{Fate, Lyapunov, Options, Rate, lyapunov};
pub use resonance::{Resonance, Tongue, resonance};
pub use scalar::{Criterion, Scalar};
pub use sheeted::Sheeted;
pub use standing::standing;
pub use tongues::{Along, Curve, Edge, curves};
