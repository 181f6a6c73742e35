//! The furnace: a lobe compensated by the emitted code reflects, or passes, all light that falls on
//! it.
//!
//! Lookup and compensation are the emitted Rust, compiled by rustc and run as a program of its own.
//! The lobe is that of the textbooks, integrated over all directions by a plain product rule
//! (`furnace_support::textbook`): the program's integrators make the texels and the certificate,
//! and have no part in the energy.
//!
//! With the lobe's true albedo E and the table's e, the compensated energy of a white surface is
//! E/e. So it is off 1 by |E - e|/e, which is at most the table's certificate over e; the error of
//! the test's own [`Rule`] is added. The certificate is measured as a bake measures it, at the
//! points of the program's judges in [`region`]: none of those judged here is among them.

use crate::emit_support;
use crate::furnace_support;

use emit_support::say;
use furnace_support::tables::{of_azimuth, of_glass, of_mean};
use furnace_support::textbook::{Facets, Hemisphere, direction, fresnel, schlick};
use furnace_support::{Emitted, F0, Returned, include, returned};
use lobefit::data::{AlphaMap, Decode, Smith, Table};
use lobefit::effects::anisotropy;
use lobefit::effects::glass::truths;
use lobefit::effects::table::{self, LookupPoints, Point, Region, SliceAxis, Slices, aspect, measure};
use lobefit::emit::compensation::Compensation;
use lobefit_math::ops;
use lobefit_truth::integrate::aniso::aniso;
use lobefit_truth::integrate::glass::{Side, glass};
use lobefit_truth::quantity::GGX_GLASS;
use rayon::prelude::*;

const SMITHS: [Smith; 2] = [Smith::Correlated, Smith::Separable];

/// Bound on the error of the textbook integrals. Each is taken twice, with the nodes given and with
/// three quarters of them, and may not differ by more; nor from the truth. From inside glass the
/// reflected lobe has a root's edge at the critical angle, which a rule that does not know of it
/// resolves slowly.
struct Rule {
    cosines: usize,
    azimuths: usize,
    error: f64,
}

const METAL: Rule = Rule { cosines: 72, azimuths: 480, error: 1e-5 };
const OUTSIDE: Rule = Rule { cosines: 96, azimuths: 480, error: 1e-5 };
const INSIDE: Rule = Rule { cosines: 240, azimuths: 480, error: 2e-4 };

impl Rule {
    fn pair(&self) -> [Hemisphere; 2] {
        [3, 4].map(|k| Hemisphere::new(self.cosines * k / 4, self.azimuths * k / 4))
    }

    /// The finer value of a pair.
    fn settled<const N: usize>(
        &self,
        rules: &[Hemisphere; 2],
        at: &Point,
        f: impl Fn(&Hemisphere) -> [f64; N],
    ) -> [f64; N] {
        let [coarse, fine] = rules.each_ref().map(f);
        for (a, b) in coarse.iter().zip(&fine) {
            assert!((a - b).abs() <= self.error, "the rule at {at:?}: {coarse:?} {fine:?}");
        }
        fine
    }
}

/// A certificate so large that the furnace would say nothing: a thirtieth of what uncompensated
/// lobes lose.
const USELESS: f64 = 4e-3;

/// Losses that uncompensated lobes of these points reach, at least.
const DARK: f64 = 0.1;

/// What is computed at a point for the judgement.
struct Lit {
    /// Energy of the lobe without compensation, F = 1, by the textbook.
    energy: f64,
    /// The truth that tables are certified against.
    truth: f64,
}

/// Where the small tables are certified: the hull of the points, in which their few texels suffice.
fn region(axis: SliceAxis, range: [f64; 2]) -> Region {
    Region {
        roughness: [0.52, 0.97],
        mu: [0.21, 0.93],
        slices: Some(Slices { axis, range }),
        anisotropy: None,
        alpha_map: AlphaMap::RoughnessSquared,
    }
}

/// Largest error of a table's lookup at points of the region, as a certificate states it: of the
/// reference lookup, not of the emitted code.
fn certificate(table: &Table, decode: Decode, judged: &LookupPoints, truth: &[f64]) -> f64 {
    let errors =
        measure(table, decode, judged, table::Truth { e: truth, b: None }, 0.0).expect("a table of E");
    assert!(judged.len() > 10_000 && judged.len() == truth.len(), "{}", judged.len());
    let worst = errors.lookup.max;
    assert!(worst < USELESS, "{}: {worst:e}", table.name);
    worst
}

/// The certificate of a table of the anisotropic lobe.
fn of_metal(table: &Table, decode: Decode) -> f64 {
    let azimuth = decode == Decode::AzimuthCubic;
    let points = anisotropy::judged(&region(SliceAxis::Anisotropy, [0.1, 0.77]), azimuth).expect("a range");
    let (truth, ..) =
        anisotropy::truths(table.smith.expect("a form"), &points).expect("the truths of a judge");
    certificate(table, decode, &points, &truth)
}

/// How far the energy of a white surface may lie from 1, f32 included.
fn allowed(certificate: f64, rule: &Rule, e: f64) -> f64 {
    (certificate + rule.error) / e + 4.0 * f64::from(f32::EPSILON)
}

/// Judges a table at all its points: compensated it is white, and without compensation the same
/// judgement finds it dark.
fn judge(table: &Table, certificate: f64, rule: &Rule, points: &[Point], lit: &[Lit], returned: &[Returned]) {
    let (mut worst, mut darkest, mut share) = (0.0_f64, 0.0_f64, 0.0_f64);
    assert_eq!([points.len(); 2], [lit.len(), returned.len()]);
    for ((point, lit), returned) in points.iter().zip(lit).zip(returned) {
        let place = format!("{} at {point:?}: energy {}, {returned:?}", table.name, lit.energy);
        assert!((lit.energy - lit.truth).abs() <= rule.error, "{place}, truth {}", lit.truth);
        let allowed = allowed(certificate, rule, returned.e);
        let off = (lit.energy * returned.factors[0] - 1.0).abs();
        // Written so that a value that is not a number fails.
        assert!(off <= allowed, "{place}: off {off:e}, allowed {allowed:e}");
        assert!(1.0 - lit.energy > allowed, "{place}: white without compensation");
        worst = worst.max(off);
        darkest = darkest.max(1.0 - lit.energy);
        share = share.max(off / allowed);
    }
    assert!(darkest > DARK, "{}: {darkest}", table.name);
    say(&format!(
        "{}: {} points, energy within {worst:.1e} of 1 ({:.0}% of what the certificate of {certificate:.1e} allows), uncompensated {darkest:.2} short",
        table.name,
        points.len(),
        100.0 * share
    ));
}

/// Roughness, cosine and slice input of the points: alpha from 0.27 to 0.94, off the texels.
fn combinations(thirds: &[f32], mut point: impl FnMut(f32) -> Point) -> Vec<Point> {
    let mut points = Vec::new();
    for slice in thirds {
        for roughness in [0.52_f32, 0.74, 0.97] {
            for mu in [0.21_f32, 0.55, 0.93] {
                points.push(Point { roughness, alpha: roughness * roughness, mu, ..point(*slice) });
            }
        }
    }
    points
}

const ANISOTROPIES: [f32; 3] = [0.1, 0.45, 0.77];

fn alphas(point: &Point) -> [f64; 2] {
    let (alpha, aspect) = (f64::from(point.alpha), aspect(f64::from(point.anisotropy)));
    [alpha / aspect, alpha * aspect]
}

/// E and Schlick's part of it, int f (1 - v.h)^5, at an azimuth of the view.
fn metal(smith: Smith, point: &Point, phi: f64, hemisphere: &Hemisphere) -> [f64; 2] {
    let (facets, view) = (Facets { smith, alpha: alphas(point) }, direction(f64::from(point.mu), phi));
    hemisphere.integrate([0.0, 1.0], |l| {
        let (lobe, cosine) = facets.reflected(view, l);
        [lobe, lobe * schlick(cosine)]
    })
}

/// Azimuths of the view for its mean: the midpoints of a quadrant, to which the lobe's two mirror
/// symmetries reduce it.
const VIEWS: usize = 10;

/// A metal of F0 = 1 is white. One with F0 < 1 on every facet has the energy F0 (E + F0 (1 - E)):
/// of the light that single scattering loses, F0^2 comes back. With Schlick's Fresnel it has more,
/// and less than 1.
#[test]
fn a_compensated_metal_is_white_in_the_mean_over_the_azimuth() {
    let points = combinations(&ANISOTROPIES, |anisotropy| Point {
        anisotropy,
        ior: 1.0,
        cos2_phi: 1.0,
        ..Point::default()
    });
    let tables = SMITHS.map(of_mean);
    let decode = Decode::Loss;
    let emitted = tables.each_ref().map(|table| Emitted::new(table, decode));
    let text = include(&emitted, Compensation::Reflection);
    let found = returned(&text, Compensation::Reflection, &emitted.each_ref().map(|e| (e, &points[..])));
    let (rule, rules) = (&METAL, METAL.pair());
    for ((smith, table), found) in SMITHS.into_iter().zip(&tables).zip(&found) {
        let mean = |point: &Point, hemisphere: &Hemisphere| {
            let view = |k: usize| (k as f64 + 0.5) * std::f64::consts::FRAC_PI_2 / VIEWS as f64;
            let views = (0..VIEWS).map(|k| metal(smith, point, view(k), hemisphere));
            views.fold([0.0; 2], |sum, v| [0, 1].map(|i| sum[i] + v[i] / VIEWS as f64))
        };
        let energies: Vec<[f64; 2]> =
            points.par_iter().map(|point| rule.settled(&rules, point, |h| mean(point, h))).collect();
        let lit: Vec<Lit> = points
            .par_iter()
            .zip(&energies)
            .map(|(point, energy)| {
                let truth = aniso(smith, alphas(point), f64::from(point.mu), None, 1e-7).expect("E");
                Lit { energy: energy[0], truth: truth.e }
            })
            .collect();
        let certificate = of_metal(table, decode);
        judge(table, certificate, rule, &points, &lit, found);
        for (((point, lit), [energy, beyond]), found) in points.iter().zip(&lit).zip(&energies).zip(found) {
            let allowed = allowed(certificate, rule, found.e);
            for (f0, factor) in F0.into_iter().zip(found.factors) {
                let constant = f0 * energy * factor;
                let expected = f0 * (lit.truth + f0 * (1.0 - lit.truth));
                assert!(
                    (constant - expected).abs() <= allowed,
                    "F0 {f0} at {point:?}: {constant} {expected}"
                );
                let schlick = (f0 * energy + (1.0 - f0) * beyond) * factor;
                assert!(schlick >= constant && schlick <= 1.0 + allowed, "F0 {f0} at {point:?}: {schlick}");
            }
        }
    }
}

/// With the azimuth among its coordinates the table makes every view white, not only their mean.
#[test]
fn a_compensated_metal_is_white_at_every_azimuth() {
    let azimuths = [0.0, 0.4, 0.8, 1.2, std::f64::consts::FRAC_PI_2];
    let (mut points, mut phis) = (Vec::new(), Vec::new());
    for phi in azimuths {
        let cosine = ops::cos(phi);
        let cos2_phi = (cosine * cosine) as f32;
        let more = combinations(&ANISOTROPIES, |anisotropy| Point {
            anisotropy,
            ior: 1.0,
            cos2_phi,
            ..Point::default()
        });
        phis.extend(more.iter().map(|_| phi));
        points.extend(more);
    }
    let tables = SMITHS.map(of_azimuth);
    let decode = Decode::AzimuthCubic;
    let emitted = tables.each_ref().map(|table| Emitted::new(table, decode));
    let text = include(&emitted, Compensation::Reflection);
    let found = returned(&text, Compensation::Reflection, &emitted.each_ref().map(|e| (e, &points[..])));
    let (rule, rules) = (&METAL, METAL.pair());
    for ((smith, table), found) in SMITHS.into_iter().zip(&tables).zip(&found) {
        let lit: Vec<Lit> = points
            .par_iter()
            .zip(&phis)
            .map(|(point, phi)| {
                let [energy, _] = rule.settled(&rules, point, |h| metal(smith, point, *phi, h));
                let truth = aniso(smith, alphas(point), f64::from(point.mu), Some(*phi), 1e-7).expect("E");
                Lit { energy, truth: truth.e }
            })
            .collect();
        let certificate = of_metal(table, decode);
        judge(table, certificate, rule, &points, &lit, found);
    }
}

/// R and T of rough glass.
fn through(smith: Smith, point: &Point, side: Side, hemisphere: &Hemisphere) -> [f64; 2] {
    let alpha = f64::from(point.alpha);
    let (facets, view) = (Facets { smith, alpha: [alpha; 2] }, direction(f64::from(point.mu), 0.0));
    let ior = f64::from(point.ior);
    let [from, to] = match side {
        Side::Outside => [1.0, ior],
        Side::Inside => [ior, 1.0],
    };
    let [r] = hemisphere.integrate([0.0, 1.0], |l| {
        let (lobe, cosine) = facets.reflected(view, l);
        [lobe * fresnel(cosine, to / from)]
    });
    let [t] = hemisphere.integrate(Facets::below(view, [from, to]), |l| {
        [facets.transmitted(view, [l[0], l[1], -l[2]], [from, to])]
    });
    [r, t]
}

/// (R + T)/E is 1 from either side, and both lobes keep their shares.
#[test]
fn compensated_glass_is_white_from_both_sides() {
    let points = combinations(&[1.25, 1.5, 1.9], |ior| Point { ior, cos2_phi: 1.0, ..Point::default() });
    let sides = [Side::Outside, Side::Inside];
    let cases: Vec<(Smith, Side)> =
        SMITHS.into_iter().flat_map(|smith| sides.map(|side| (smith, side))).collect();
    let tables: Vec<Table> = SMITHS.into_iter().flat_map(of_glass).collect();
    let decode = Decode::Loss;
    let emitted: Vec<Emitted> = tables.iter().map(|table| Emitted::new(table, decode)).collect();
    let text = include(&emitted, Compensation::Glass);
    let inputs: Vec<(&Emitted, &[Point])> = emitted.iter().map(|e| (e, &points[..])).collect();
    let found = returned(&text, Compensation::Glass, &inputs);
    let (outside, inside) = (OUTSIDE.pair(), INSIDE.pair());
    let judged = LookupPoints::certification(&region(SliceAxis::Ior, [1.25, 1.9]), 11);
    let truths = SMITHS.map(|smith| truths(GGX_GLASS, smith, &judged).expect("the truths of a judge").0);
    for (((smith, side), table), found) in cases.into_iter().zip(&tables).zip(&found) {
        let (rule, rules) = match side {
            Side::Outside => (&OUTSIDE, &outside),
            Side::Inside => (&INSIDE, &inside),
        };
        let lit: Vec<(Lit, [f64; 2])> = points
            .par_iter()
            .map(|point| {
                let shares = rule.settled(rules, point, |h| through(smith, point, side, h));
                let [alpha, mu, ior] = [point.alpha, point.mu, point.ior].map(f64::from);
                let truth = glass(smith, alpha, mu, ior, side, 1e-7).expect("R and T");
                for (share, truth) in shares.iter().zip([truth.r, truth.t]) {
                    assert!((share - truth).abs() <= rule.error, "{side:?} {point:?}: {shares:?} {truth}");
                }
                (Lit { energy: shares[0] + shares[1], truth: truth.e }, shares)
            })
            .collect();
        let (lit, shares): (Vec<Lit>, Vec<[f64; 2]>) = lit.into_iter().unzip();
        assert!(shares.iter().all(|[r, t]| *r > 0.0 && *t > 0.0));
        let certificate = certificate(
            table,
            decode,
            &judged,
            &truths[usize::from(smith == SMITHS[1])][usize::from(side == Side::Inside)],
        );
        judge(table, certificate, rule, &points, &lit, found);
        assert!(found.iter().all(|f| f.factors == [f.factors[0]; 3]), "glass has no colour: {found:?}");
    }
}
