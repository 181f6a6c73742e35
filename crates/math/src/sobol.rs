//! Owen-scrambled Sobol points in up to three dimensions.
//!
//! Direction numbers: Joe and Kuo 2008 (dimension 1 is van der Corput; dimensions 2 and 3 have the
//! primitive polynomials x + 1 and x^2 + x + 1). Scrambling: the hash of Laine and Karras 2011 with
//! Vegdahl's constants as given by Burley 2020, applied to the bit-reversed index: nested uniform
//! scrambling up to the quality of the hash.

/// Most dimensions.
pub const DIMENSIONS: usize = 3;

/// A scrambled sequence; every seed gives an independent randomisation.
#[derive(Clone, Debug)]
pub struct Sobol {
    seeds: [u32; DIMENSIONS],
    shuffle: Option<u32>,
}

impl Sobol {
    /// The sequence scrambled by one seed per dimension.
    pub fn new(seeds: [u32; DIMENSIONS]) -> Sobol {
        Sobol { seeds, shuffle: None }
    }

    /// The same points in another order: for coordinates beyond the dimensions of one sequence. Two
    /// sequences in the same order are functions of one another whatever their seeds, one
    /// elementary interval of the one goes with one of the other; in orders of different `seed`
    /// they are independent (Burley 2020, "padding"). An aligned block of 2^m indices stays a net.
    pub fn padded(mut self, seed: u32) -> Sobol {
        self.shuffle = Some(seed);
        self
    }

    /// Coordinate of point `index` along `dimension`, in (0, 1): the centre of its 2^-32 cell.
    pub fn coordinate(&self, index: u32, dimension: usize) -> f64 {
        let shuffled = |seed| scramble(index.reverse_bits(), seed).reverse_bits();
        let [a, b, c, d] = self.shuffle.map_or(index, shuffled).to_le_bytes().map(usize::from);
        let [of_a, of_b, of_c, of_d] = &BY_BYTE[dimension];
        let bits = of_a[a] ^ of_b[b] ^ of_c[c] ^ of_d[d];
        let scrambled = scramble(bits.reverse_bits(), self.seeds[dimension]).reverse_bits();
        (f64::from(scrambled) + 0.5) / 4_294_967_296.0
    }
}

/// By dimension and byte of the index, what the bits of that byte add.
static BY_BYTE: [[[u32; 256]; 4]; DIMENSIONS] =
    [by_byte(directions(&[], 0)), by_byte(directions(&[1], 0)), by_byte(directions(&[1, 3], 1))];

const fn by_byte(directions: [u32; 32]) -> [[u32; 256]; 4] {
    let mut sums = [[0; 256]; 4];
    let mut i = 0_usize;
    while i < 4 * 256 {
        let (byte, value) = (i / 256, i % 256);
        if value > 0 {
            // The highest bit, and what is known of the others.
            let bit = value.ilog2() as usize;
            sums[byte][value] = sums[byte][value - (1 << bit)] ^ directions[8 * byte + bit];
        }
        i += 1;
    }
    sums
}

/// Direction numbers from the initial odd numbers `m` and the inner coefficients of the primitive
/// polynomial.
const fn directions(m: &[u32], inner: u32) -> [u32; 32] {
    let mut v = [0_u32; 32];
    let degree = m.len();
    let mut i = 0;
    while i < 32 {
        v[i] = if degree == 0 {
            1 << (31 - i)
        } else if i < degree {
            m[i] << (31 - i)
        } else {
            let mut value = v[i - degree] ^ (v[i - degree] >> degree);
            let mut k = 1;
            while k < degree {
                if (inner >> (degree - 1 - k)) & 1 == 1 {
                    value ^= v[i - k];
                }
                k += 1;
            }
            value
        };
        i += 1;
    }
    v
}

/// Laine-Karras permutation: a bit of the result depends on the lower bits of the input alone.
fn scramble(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every elementary interval of a (0, m, s)-net base 2 holds one point; scrambling keeps that.
    #[test]
    fn scrambled_points_stay_a_net() {
        for seed in 0..8_u32 {
            let sobol = Sobol::new([seed, seed.wrapping_mul(77) + 5, 9 - seed]);
            for log_x in 0..=8 {
                let (nx, ny) = (1_usize << log_x, 1_usize << (8 - log_x));
                let mut counts = vec![0; nx * ny];
                for i in 0..256 {
                    let x = (sobol.coordinate(i, 0) * nx as f64) as usize;
                    let y = (sobol.coordinate(i, 1) * ny as f64) as usize;
                    counts[y * nx + x] += 1;
                }
                assert!(counts.iter().all(|c| *c == 1), "seed {seed}, {nx} x {ny}");
            }
        }
    }

    /// Pairs of coordinates of two padded sequences fill the square, and each is a net by itself.
    #[test]
    fn padded_points_are_independent() {
        for seed in 0..8_u32 {
            let sets =
                [1, 2].map(|k: u32| Sobol::new([seed + k, seed ^ k, seed]).padded(mixed(seed + 77 * k)));
            for (a, b) in [(0, 0), (0, 1), (1, 1), (2, 0)] {
                let mut counts = [0; 16];
                for i in 0..256 {
                    let [x, y] = [sets[0].coordinate(i, a), sets[1].coordinate(i, b)];
                    counts[(4.0 * x) as usize * 4 + (4.0 * y) as usize] += 1;
                }
                assert!(counts.iter().all(|c| (4..=32).contains(c)), "seed {seed}: {counts:?}");
            }
            let mut counts = [0; 256];
            for i in 0..256 {
                let [x, y] = [0, 1].map(|d| (16.0 * sets[0].coordinate(i, d)) as usize);
                counts[16 * x + y] += 1;
            }
            assert!(counts.iter().all(|c| *c == 1), "seed {seed}: a net");
        }
    }

    /// A number that looks random.
    fn mixed(x: u32) -> u32 {
        let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
        x ^ (x >> 15)
    }

    #[test]
    fn each_dimension_is_stratified() {
        let sobol = Sobol::new([1, 2, 3]);
        for dimension in 0..DIMENSIONS {
            let mut counts = vec![0; 1024];
            for i in 0..1024 {
                counts[(sobol.coordinate(i, dimension) * 1024.0) as usize] += 1;
            }
            assert!(counts.iter().all(|c| *c == 1), "dimension {dimension}");
        }
    }
}
