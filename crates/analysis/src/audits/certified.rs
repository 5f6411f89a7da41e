//! Modes that are solutions, and none missing below them.

use algebra::certify::{Certificate, RESIDUAL};
use words::Text;

use crate::dataset::Audit;

/// The two checks of a certificate.
pub fn audits(certificate: &Certificate) -> [Audit; 2] {
    [
        Audit::at_most(
            "residual",
            Text::new("residuals of the modes, relative", "невязки собственных форм, относительные"),
            certificate.worst(),
            RESIDUAL,
        ),
        Audit::at_most(
            "sturm",
            Text::new("modes missing by Sturm's count", "пропущено частот по счёту Штурма"),
            certificate.missing() as f64,
            0.0,
        ),
    ]
}
