//! How much work a value takes: rules for the outer and the inner integral, and a count of what
//! they evaluate.

use std::sync::LazyLock;

use crate::integrate::estimate::PanelRule;
use crate::optics::distribution::Distribution;
use lobefit_math::lanes::LANES;

/// Most inner nodes, in blocks of lanes.
const INNER_BLOCKS: usize = 32;

/// Inner rules of 8, 16, ... nodes, made once.
static INNER: LazyLock<Vec<PanelRule>> =
    LazyLock::new(|| (1..=INNER_BLOCKS).map(|blocks| PanelRule::new(blocks * LANES)).collect());

/// A pair of rules: nodes per panel of the polar integral, and digits asked of the azimuth
/// integral.
#[derive(Clone, Debug)]
pub struct Effort {
    /// Rule of each panel over the polar angle.
    pub outer: PanelRule,
    digits: f64,
}

impl Effort {
    /// `nodes` (a multiple of eight) per polar panel and `digits` of the azimuth integral.
    pub fn new(nodes: usize, digits: f64) -> Effort {
        Effort { outer: PanelRule::new(nodes), digits }
    }

    /// The azimuth rule for an interval of `length` of a distribution, see `inner` and `across`.
    pub(super) fn azimuth<D: Distribution>(&self, length: f64) -> &'static PanelRule {
        if D::REACH.is_finite() { self.across() } else { self.inner(length) }
    }

    /// The ladder that a tolerance climbs: each step has twice the nodes of the one before.
    pub fn ladder() -> &'static [Effort] {
        static LADDER: LazyLock<Vec<Effort>> = LazyLock::new(|| {
            vec![Effort::new(8, 10.0), Effort::new(16, 16.0), Effort::new(32, 32.0), Effort::new(64, 64.0)]
        });
        &LADDER
    }

    /// Azimuth rule for an interval of `length` in the variable whose singularities are +-i pi/2
    /// from its start: n nodes leave rho^-2n, and 2n ln(rho)/ln(10) = digits is met by n = digits
    /// (9 + 2.2 length)/15 (fitted to rho(2) = 3.85, rho(5) = 2.29, rho(10) = 1.78).
    pub(super) fn inner(&self, length: f64) -> &'static PanelRule {
        let nodes = self.digits * (9.0 + 2.2 * length) / 15.0;
        let blocks = (nodes / LANES as f64).ceil().clamp(1.0, INNER_BLOCKS as f64);
        &INNER[blocks as usize - 1]
    }

    /// The azimuth rule of twice the nodes of the outer rule: of a distribution whose tail is
    /// exp(-sinh^2 v) in the variable of the azimuth, an entire function on an interval that is never
    /// longer than [`GAUSSIAN_END`](super::schlick::GAUSSIAN_END).
    fn across(&self) -> &'static PanelRule {
        let blocks = (2 * self.outer.nodes() / LANES).min(INNER_BLOCKS);
        &INNER[blocks - 1]
    }
}
