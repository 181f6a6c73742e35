//! The same loops compiled for several instruction sets, and the choice among them at run time.
//!
//! The loops are plain arithmetic on `[f64; 8]`: no fused operations, no reassociation, so every
//! path gives the same bits.

use multiversion::multiversion;

use super::lobe::Lobe;
use super::rules::Rules;
use super::stretch::Seen;
use super::tabled::Tabled;
use super::transmit::{self, Sweep};
use super::{reflect, rings};
use crate::integrate::Path;
use lobefit_math::lanes::F8;

/// Three compiled forms of one function, and the choice by [`Path`].
macro_rules! forms {
    ($name:ident$(<$lobe:ident>)? in $forms:ident, $body:path, ($($argument:ident: $kind:ty),*) -> $result:ty) => {
        mod $forms {
            use super::*;

            #[multiversion(targets(
                "x86_64+avx+avx2+bmi1+bmi2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl",
                "x86_64+avx+avx2+bmi1+bmi2"
            ))]
            pub(super) fn best$(<$lobe: Tabled>)?($($argument: $kind),*) -> $result {
                $body($($argument),*)
            }

            #[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2"))]
            pub(super) fn avx2$(<$lobe: Tabled>)?($($argument: $kind),*) -> $result {
                $body($($argument),*)
            }

            pub(super) fn baseline$(<$lobe: Tabled>)?($($argument: $kind),*) -> $result {
                $body($($argument),*)
            }
        }

        impl Path {
            #[inline]
            pub(super) fn $name$(<$lobe: Tabled>)?(self, $($argument: $kind),*) -> $result {
                match self {
                    Path::Best => $forms::best($($argument),*),
                    Path::Avx2 => $forms::avx2($($argument),*),
                    Path::Baseline => $forms::baseline($($argument),*),
                }
            }
        }
    };
}

forms!(transmit<D> in transmit_forms, transmit::transmit, (
    lobe: &Lobe<D>, rules: &Rules, inner: [f64; 2], sweep: &Sweep, values: &mut Vec<f64>
) -> u64);
forms!(rings<D> in rings_forms, rings::rings, (
    lobe: &Lobe<D>, rules: &Rules, nodes: usize, u: &[f64], values: &mut Vec<f64>
) -> u64);
forms!(passed in passed_forms, reflect::passed, (seen: Seen, cosine: &[F8], share: &[F8]) -> f64);
forms!(near<D> in near_forms, reflect::near, (lobe: &Lobe<D>, seen: Seen, series: &[f64], nodes: [&[f64]; 3]) -> f64);
