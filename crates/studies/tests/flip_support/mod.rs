//! Pictures to compare, made of numbers that f32 holds exactly, so that every program gets the same
//! ones.

/// Columns and rows.
pub const SIZE: (usize, usize) = (32, 24);

/// Pixels in linear light, row by row.
pub type Pixels = Vec<[f64; 3]>;

/// The pairs of the comparison by name: reference and test. `lamp` and `dark-half` need a high
/// dynamic range.
pub const NAMES: [&str; 5] = ["noise", "ramps", "discs", "lamp", "dark-half"];

/// A pair.
pub fn pair(name: &str) -> [Pixels; 2] {
    match name {
        "noise" => [0, 3].map(|seed| picture(|x, y| [0, 1, 2].map(|c| noise(y * SIZE.0 + x, seed + c)))),
        "ramps" => [(0, 32), (8, 28)].map(|(shift, blue)| {
            picture(|x, y| [part(8 * x, 256), part(8 * y + shift, 256), part(4 * blue, 256)])
        }),
        "discs" => [64, 81].map(|square| {
            let colours = ([0.75, 0.5, 0.25], [0.25, 0.5, 0.75]);
            picture(|x, y| if inside(x, y, square) { colours.0 } else { colours.1 })
        }),
        "lamp" => [16, 25].map(|square| {
            picture(|x, y| {
                let light = part(1 + x, 64);
                if inside(x, y, square) {
                    [32.0 * light, 16.0 * light, 8.0 * light]
                } else {
                    [light, light, 2.0 * light]
                }
            })
        }),
        "dark-half" => [5, 7].map(|level| {
            picture(|x, y| if x < 17 { [part(1, 4096); 3] } else { [part(level * (y + 1), 8), 0.5, 4.0] })
        }),
        other => panic!("no pair `{other}`"),
    }
}

fn picture(f: impl Fn(usize, usize) -> [f64; 3]) -> Pixels {
    (0..SIZE.0 * SIZE.1).map(|i| f(i % SIZE.0, i / SIZE.0)).collect()
}

fn part(n: usize, of: usize) -> f64 {
    n as f64 / of as f64
}

fn inside(x: usize, y: usize, square: usize) -> bool {
    let (dx, dy) = (x.abs_diff(SIZE.0 / 2), y.abs_diff(SIZE.1 / 2));
    dx * dx + dy * dy < square
}

/// A number of 8 bits from a hash (the finaliser of splitmix64).
fn noise(i: usize, seed: u64) -> f64 {
    let mut x = (i as u64 + (seed << 32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    f64::from(((x ^ (x >> 31)) >> 56) as u8) / 256.0
}
