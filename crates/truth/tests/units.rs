//! Optics and rules of integrals: tests that stand beside them and see what is private of them. Their
//! files are compiled here once more, and the library is not.
#![allow(dead_code, reason = "what of these files no test calls")]

use lobefit_truth::integrate::reflection::{Effort, reflected, split};
use lobefit_truth::optics::{self, Smith};

#[path = "../src/integrate/aniso/fast/barycentric.rs"]
mod barycentric;
#[path = "../src/optics/diffuse.rs"]
mod diffuse;
#[path = "../src/optics/fresnel.rs"]
mod fresnel;
#[path = "../src/optics/ggx.rs"]
mod ggx;
#[path = "../src/integrate/glass/interface.rs"]
mod interface;
#[path = "../src/optics/multiscatter.rs"]
mod multiscatter;
#[path = "../src/integrate/glass/table/rules.rs"]
mod rules;

#[test]
fn the_form_for_this_processor_gives_the_bits_of_the_plain_one() {
    let effort = &Effort::ladder()[0];
    for smith in [Smith::Correlated, Smith::Separable] {
        for (alpha, mu) in [(1e-4, 1.0), (0.01, 1e-3), (0.2, 0.3), (1.0, 0.9)] {
            let plain = reflected(smith, alpha, mu, effort, &fresnel::schlick_weight);
            assert_eq!(split(smith, alpha, mu, effort).1.to_bits(), plain.to_bits(), "{alpha} {mu}");
        }
    }
}
