//! Tables of the anisotropic reflection lobe against the reference integrator, symmetries, bits and costs.

use lobefit::data::Smith;
use lobefit_truth::integrate::Path;
use lobefit_truth::integrate::aniso::table::{self, Azimuthal, Columns, Grid, Tabulated};
use lobefit_truth::integrate::aniso::{self};
use lobefit_truth::integrate::{IntegrateError, PanelRule, reflection};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const BOTH: [Smith; 2] = [Smith::Separable, Smith::Correlated];

/// The sources' axes with every `step`-th texel.
struct Sources {
    mus: Vec<f64>,
    alphas: Vec<f64>,
    aspects: Vec<f64>,
}

impl Sources {
    fn new(step: usize) -> Sources {
        let unit =
            |low: f64, high: f64| (0..64).step_by(step).map(|i| (i as f64 / 64.0).clamp(low, high)).collect();
        let aspect = |z: usize| (1.0 - 0.9 * (z as f64 / 32.0).sqrt()).sqrt();
        Sources {
            mus: unit(1e-4, 0.9999),
            alphas: unit(1e-4, 1.0),
            aspects: (0..32).step_by(step).map(aspect).collect(),
        }
    }

    fn grid(&self) -> Grid<'_> {
        Grid { columns: Columns::Fixed(&self.mus), alphas: &self.alphas, aspects: &self.aspects, floor: 1e-4 }
    }
}

/// Cosine of a column of our own layout, u = sqrt(mu (1 + alpha)/(mu + alpha)).
fn homogeneous(column: usize, alpha: f64) -> f64 {
    let u = column as f64 / 15.0;
    (alpha * u * u / ((1.0 - u * u) + alpha)).clamp(1e-3, 1.0)
}

fn texel(table: &Tabulated, grid: &Grid, [column, row, slice]: [usize; 3]) -> f64 {
    let [columns, rows, _] = grid.size();
    table.e[(slice * rows + row) * columns + column]
}

/// Random texels and the corners are the reference's within the tolerance.
fn judge(smith: Smith, grid: &Grid, table: &Tabulated, count: usize, tolerance: f64) {
    let size = grid.size();
    let mut random = Pcg64::seed_from_u64(11);
    let mut texels: Vec<[usize; 3]> = (0..count).map(|_| size.map(|n| random.random_range(0..n))).collect();
    for column in [0, 1, size[0] - 1] {
        texels.extend([[column, size[1] - 1, size[2] - 1], [column, 0, size[2] - 1], [column, 1, 0]]);
    }
    for at in texels {
        let (alpha, mu) = grid.texel(at);
        let truth = aniso::aniso(smith, alpha, mu, None, 1e-7).expect("the reference reaches 1e-7");
        let difference = (texel(table, grid, at) - truth.e).abs();
        // Written so that a value that is not a number fails.
        assert!(difference <= tolerance, "{smith:?} {tolerance:e} at {at:?}: {difference:e}");
    }
}

#[test]
fn the_sources_grid_keeps_its_tolerance() {
    let sources = Sources::new(1);
    let grid = sources.grid();
    for smith in BOTH {
        for (tolerance, most, count) in [(1e-4, 1.2e7, 5), (1e-6, 1e8, 40)] {
            let table = table::tabulate(smith, &grid, tolerance).expect("a table");
            assert_eq!(table.e.len(), 64 * 64 * 32);
            assert!(table.checked.worst <= tolerance && table.checked.texels >= 2000, "{:?}", table.checked);
            assert!((table.evaluations as f64) < most, "{} evaluations", table.evaluations);
            judge(smith, &grid, &table, count, tolerance);
        }
    }
}

#[test]
fn columns_that_vary_keep_their_tolerance() {
    let alphas: Vec<f64> = (0..12).map(|i| 0.02 + 0.98 * f64::from(i) / 11.0).map(|r| r * r).collect();
    let aspects: Vec<f64> = (0..5).map(|i| (1.0 - 0.9 * f64::from(i) / 4.0).sqrt()).collect();
    let mu = |column: usize, row: usize, _: f64| homogeneous(column, alphas[row]);
    let columns = Columns::Varying { count: 16, mu: &mu };
    let grid = Grid { columns, alphas: &alphas, aspects: &aspects, floor: 0.0 };
    for smith in BOTH {
        let table = table::tabulate(smith, &grid, 1e-5).expect("a table");
        judge(smith, &grid, &table, 20, 1e-5);
    }
}

#[test]
fn the_isotropic_slice_is_the_isotropic_albedo() {
    let sources = Sources::new(3);
    let grid = Grid { aspects: &[1.0], ..sources.grid() };
    let rule = PanelRule::new(32);
    for smith in BOTH {
        let table = table::tabulate(smith, &grid, 1e-6).expect("a table");
        for (row, alpha) in sources.alphas.iter().enumerate() {
            for (column, mu) in sources.mus.iter().enumerate() {
                let truth = reflection::albedo(smith, *alpha, *mu, &rule);
                let difference = (texel(&table, &grid, [column, row, 0]) - truth).abs();
                assert!(difference <= 1e-6, "{smith:?} alpha {alpha} mu {mu}: {difference:e}");
            }
        }
    }
}

#[test]
fn the_axes_swap() {
    let aspects = [0.4, 0.8, 1.0];
    let swapped = aspects.map(|a| 1.0 / a);
    let (alphas, mus) = ([0.1, 0.4, 0.9], [0.02, 0.3, 1.0]);
    let grid = Grid { columns: Columns::Fixed(&mus), alphas: &alphas, aspects: &aspects, floor: 0.0 };
    for smith in BOTH {
        let a = table::tabulate(smith, &grid, 1e-6).expect("a table");
        let b = table::tabulate(smith, &Grid { aspects: &swapped, ..grid }, 1e-6).expect("a table");
        for (a, b) in a.e.iter().zip(&b.e) {
            assert!((a - b).abs() < 1e-12, "{smith:?}: {a} {b}");
        }
        let at = |alpha, phi| table::at(smith, alpha, 0.2, phi, 1e-7).expect("a value").value;
        assert!((at([0.8, 0.2], 0.3) - at([0.2, 0.8], std::f64::consts::FRAC_PI_2 - 0.3)).abs() < 1e-14);
        assert!((at([0.8, 0.2], 0.3) - at([0.8, 0.2], std::f64::consts::PI + 0.3)).abs() < 1e-14);
    }
}

#[test]
fn points_agree_with_the_reference() {
    let mut random = Pcg64::seed_from_u64(5);
    for smith in BOTH {
        for _ in 0..60 {
            let power = |x: f64, u: f64| lobefit_math::ops::pow(x, u);
            let (alpha, aspect) = (power(0.01, random.random()), power(0.1, 0.5 * random.random::<f64>()));
            let (mu, phi) = (power(0.01, random.random()), 3.0 * random.random::<f64>());
            let alpha = [alpha / aspect, alpha * aspect];
            let truth = aniso::aniso(smith, alpha, mu, Some(phi), 1e-7).expect("the reference").e;
            let value = table::at(smith, alpha, mu, phi, 1e-6).expect("a value").value;
            assert!((value - truth).abs() < 5e-6, "{smith:?} {alpha:?} {mu} {phi}: {:e}", value - truth);
        }
    }
}

#[test]
fn bits_depend_on_neither_threads_nor_instructions() {
    let sources = Sources::new(9);
    let grid = sources.grid();
    for smith in BOTH {
        let bits = |path, threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let table = pool.install(|| table::tabulate_on(path, smith, &grid, 1e-4)).expect("a table");
            let mut bits: Vec<u64> = table.e.iter().map(|e| e.to_bits()).collect();
            bits.extend([table.checked.worst.to_bits(), table.evaluations]);
            bits
        };
        let best = bits(Path::Best, 1);
        assert_eq!(best, bits(Path::Best, 3));
        assert_eq!(best, bits(Path::Avx2, 2));
        assert_eq!(best, bits(Path::Baseline, 2));
    }
}

#[test]
fn what_lies_outside_is_refused() {
    let grid = Grid { columns: Columns::Fixed(&[0.5]), alphas: &[0.5], aspects: &[0.5], floor: 0.0 };
    let refused = |grid: Grid, tolerance| table::tabulate(Smith::Separable, &grid, tolerance).unwrap_err();
    for (grid, input) in [
        (Grid { columns: Columns::Fixed(&[0.0]), ..grid }, "mu"),
        (Grid { alphas: &[f64::NAN], ..grid }, "alpha_x"),
        (Grid { alphas: &[-1.0], floor: 0.1, ..grid }, "alpha"),
        (Grid { alphas: &[3.0], ..grid }, "alpha_x"),
        (Grid { aspects: &[0.01], ..grid }, "aspect"),
    ] {
        let IntegrateError::Domain { input: named, .. } = refused(grid, 1e-4) else { panic!("{input}") };
        assert_eq!(named, input);
    }
    assert!(matches!(refused(Grid { aspects: &[], ..grid }, 1e-4), IntegrateError::Option { .. }));
    assert!(matches!(refused(grid, 1e-12), IntegrateError::Option { option: "tolerance", .. }));
    assert!(table::mean(Smith::Separable, [0.5, 9.0], 0.5, 1e-6).is_err());
    assert!(table::at(Smith::Separable, [0.5, 0.5], 0.5, f64::NAN, 1e-6).is_err());
}

#[test]
fn the_azimuthal_interpolant_keeps_its_tolerance() {
    let (alphas, mus) = ([4e-4, 1.0], [1e-3, 1.0]);
    let mut random = Pcg64::seed_from_u64(23);
    for smith in BOTH {
        let fast = Azimuthal::new(smith, alphas, [0.1_f64.sqrt(), 1.0], mus, 1e-5).expect("an interpolant");
        assert!(fast.worst() <= 1e-5);
        for i in 0..60 {
            let power = |x: f64, u: f64| lobefit_math::ops::pow(x, u);
            let (alpha, mu) = (power(4e-4, random.random()), power(1e-3, random.random()));
            // Aspects and their inverses.
            let aspect = if i == 0 { 1.0 } else { power(0.1, random.random::<f64>() - 0.5) };
            let phi = 6.3 * random.random::<f64>();
            let pair = [alpha / aspect, alpha * aspect];
            let truth = aniso::aniso(smith, pair, mu, Some(phi), 1e-6).expect("the reference").e;
            let value = fast.at(mu, phi, alpha, aspect);
            assert!((value - truth).abs() <= 1e-5, "{smith:?} {alpha} {aspect} {mu} {phi}: {value} {truth}");
            assert_eq!(fast.pinned(alpha, aspect).at(mu, phi).to_bits(), value.to_bits());
        }
        assert!(fast.at(5e-4, 0.0, 0.5, 0.5).is_nan() && fast.at(0.5, 0.0, 0.5, 0.1).is_nan());
    }
    assert!(Azimuthal::new(Smith::Separable, [0.5, 0.1], [0.5, 1.0], mus, 1e-4).is_err());
    assert!(Azimuthal::new(Smith::Separable, alphas, [0.05, 1.0], mus, 1e-4).is_err());
}

/// The ends of a range of aspects are in it as they are given, with their inverses: 1/(1/x) is not x for one number in eight.
#[test]
fn an_interpolant_holds_the_ends_of_its_range_of_aspects() {
    let (alphas, mus) = ([0.5, 0.51], [0.7, 1.0]);
    let aspect = |hundredths: u32| (1.0 - 0.9 * f64::from(hundredths) / 100.0).sqrt();
    for i in 0..=100 {
        for (low, high) in [(aspect(i), aspect(0)), (aspect(100), aspect(i))] {
            let range = format!("aspects {low} to {high}");
            let fast = Azimuthal::new(Smith::Correlated, alphas, [low, high], mus, 1e-2).expect(&range);
            for aspect in [low, high, 1.0 / low, 1.0 / high] {
                for (alpha, mu, phi) in [(alphas[0], mus[0], 0.3), (alphas[1], mus[1], 1.2)] {
                    let pair = [alpha / aspect, alpha * aspect];
                    let truth = table::at(Smith::Correlated, pair, mu, phi, 1e-4).expect("a value").value;
                    let value = fast.at(mu, phi, alpha, aspect);
                    assert!((value - truth).abs() <= 1e-2, "{range}, {aspect}: {value} {truth}");
                }
            }
        }
    }
}

#[test]
fn evaluations_include_those_of_the_check() {
    let (alphas, aspects, mus) = ([0.5, 0.6], [0.9, 1.0], [0.7, 1.0]);
    let fast = Azimuthal::new(Smith::Separable, alphas, aspects, mus, 1e-2).expect("an interpolant");
    // One azimuth of one lobe takes a few dozen at least; the nodes alone are far fewer than the points checked.
    let least = table::at(Smith::Separable, [0.5, 0.5], 0.9, 0.0, 1e-2).expect("a value").evaluations;
    assert!(least > 10 && fast.evaluations() > table::POINTS as u64 * least / 2, "{}", fast.evaluations());
}

#[test]
fn the_isotropic_interpolant_has_no_azimuth() {
    let fast = Azimuthal::new(Smith::Correlated, [0.1, 1.0], [1.0, 1.0], [0.05, 1.0], 1e-5).expect("one");
    let (a, b) = (fast.at(0.3, 0.0, 0.4, 1.0), fast.at(0.3, 1.0, 0.4, 1.0));
    let truth = reflection::albedo(Smith::Correlated, 0.4, 0.3, &PanelRule::new(32));
    assert!((a - truth).abs() < 1e-5 && (a - b).abs() < 1e-6, "{a} {b} {truth}");
}
