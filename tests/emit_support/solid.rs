//! Small tables of three axes whose sizes differ and whose texels tell their place, and points to
//! look them up at.

use lobefit::data::{
    AlphaMap, Arguments, Axis, Certificate, Channel, Decode, Place, Registration, Smith, Surface, Table,
    TexelFormat, Warp,
};
use lobefit::effects::table::Point;
use lobefit::emit::lookup::{Readable, TableNames};
use lobefit_math::ops;

/// Columns, rows and slices: no two alike, so that a transposition shows.
pub const SIZE: [usize; 3] = [5, 4, 3];

/// Texel of a channel at a column, row and slice: in [0, 1), no two of a table alike, in no order.
pub fn texel(channel: usize, [x, y, z]: [usize; 3]) -> f64 {
    // 23 is prime to 61, which exceeds the number of texels.
    let shuffled = (23 * (x + SIZE[0] * (y + SIZE[1] * z)) + 7) % 61;
    (shuffled as f64 + 0.2 * channel as f64) / 61.0
}

fn axis(name: &str, size: usize, registration: Registration, warp: Warp, range: [f64; 2]) -> Axis {
    Axis { name: name.into(), size, registration, warp, min: range[0], max: range[1] }
}

/// A table of the axes given, slices beyond the third axis behind one another, with channels of these names.
fn table(name: &str, format: TexelFormat, axes: Vec<Axis>, channels: &[&str]) -> Table {
    let [columns, rows] = [0, 1].map(|k| axes.get(k).map_or(1, |axis: &Axis| axis.size));
    let slices: usize = axes.iter().skip(2).map(|axis| axis.size).product();
    let place = |i: usize| [i % columns, i / columns % rows, i / columns / rows];
    let channel = |(c, name): (usize, &&str)| Channel {
        name: name.to_string(),
        texels: (0..columns * rows * slices).map(|i| texel(c, place(i))).collect(),
    };
    let table = Table {
        name: name.into(),
        quantity: "ggx-glass".into(),
        smith: Some(Smith::Separable),
        alpha_map: AlphaMap::RoughnessSquared,
        channels: channels.iter().enumerate().map(channel).collect(),
        axes,
        format,
    };
    table.validate().expect("a table");
    table
}

/// Tables of every shape that the formats tell apart: two and three axes, integers, f16 and f32, one to four
/// channels.
pub fn of_all_shapes() -> Vec<Table> {
    let names = ["loss", "second", "a third", "w"];
    let mut tables = Vec::new();
    for format in [TexelFormat::Unorm8, TexelFormat::Unorm16, TexelFormat::F16, TexelFormat::F32] {
        for axes in [2, 3] {
            for channels in 1..=4 {
                let name = format!("solid-{}-{axes}-{channels}", format.name());
                let all = vec![
                    axis("mu", SIZE[0], Registration::Endpoint, Warp::Sqrt, [0.0, 1.0]),
                    axis("roughness", SIZE[1], Registration::Endpoint, Warp::Linear, [0.02, 1.0]),
                    axis("ior", SIZE[2], Registration::Centre, Warp::Linear, [1.0, 2.0]),
                ];
                let all = all.into_iter().take(axes).collect();
                tables.push(table(&name, format, all, &names[..channels]));
            }
        }
    }
    tables
}

/// A table with what its channels mean and the arguments that its lookup must have.
pub struct Solid {
    pub table: Table,
    pub names: TableNames,
    pub decode: Decode,
    pub arguments: &'static [&'static str],
}

impl Solid {
    /// With both arguments for the width of the lobe.
    pub fn readable(&self) -> Readable<'_> {
        readable(&self.table, self.decode, &self.names)
    }

    /// Values that its decoding returns.
    pub fn values(&self) -> usize {
        self.decode.formulas().len()
    }
}

/// Names of the functions of a table that is the only one of its role.
pub fn names_of(table: &Table) -> TableNames {
    TableNames::from(table.name.replace('-', "_").as_str())
}

/// A table whose functions take roughness and alpha.
pub fn readable<'a>(table: &'a Table, decode: Decode, names: &'a TableNames) -> Readable<'a> {
    Readable { table, decode, names, arguments: Arguments::Both, header: &[] }
}

/// Tables of three axes with every decoding, warp and registration.
pub fn to_look_up() -> Vec<Solid> {
    use Registration::{Centre, Endpoint};
    let mu = |registration, warp| axis("mu", SIZE[0], registration, warp, [0.0, 1.0]);
    let roughness = |registration, low| axis("roughness", SIZE[1], registration, Warp::Linear, [low, 1.0]);
    let slices = |name: &str, registration, warp, range| axis(name, SIZE[2], registration, warp, range);
    let ior = |registration| slices("ior", registration, Warp::Linear, [1.0, 2.0]);
    let anisotropy = |registration| slices("anisotropy", registration, Warp::Linear, [0.0, 0.95]);
    let solid = |name: &str, axes: [Axis; 3], decode: Decode, channels: &[&str], arguments| Solid {
        table: table(name, TexelFormat::F16, axes.to_vec(), channels).quantised(),
        names: TableNames::from(name.replace('-', "_").as_str()),
        decode,
        arguments,
    };
    vec![
        solid(
            "solid-loss",
            [mu(Endpoint, Warp::Homogeneous), roughness(Endpoint, 0.02), ior(Endpoint)],
            Decode::Loss,
            &["loss"],
            &["roughness", "alpha", "n_dot_v", "ior"],
        ),
        solid(
            "solid-deficit",
            [
                mu(Endpoint, Warp::Homogeneous),
                roughness(Endpoint, 0.02),
                slices("ior", Endpoint, Warp::Linear, [1.1, 2.5]),
            ],
            Decode::Deficit,
            &["deficit"],
            &["roughness", "alpha", "n_dot_v", "ior"],
        ),
        solid(
            "solid-albedo",
            [mu(Centre, Warp::Sqrt), roughness(Centre, 0.0), anisotropy(Centre)],
            Decode::Albedo,
            &["E"],
            &["roughness", "alpha", "n_dot_v", "anisotropy"],
        ),
        solid(
            "solid-split",
            [mu(Centre, Warp::Linear), roughness(Endpoint, 0.1), anisotropy(Endpoint)],
            Decode::SplitSum,
            &["A", "B"],
            &["roughness", "alpha", "n_dot_v", "anisotropy"],
        ),
        solid(
            "solid-bias",
            // mu is not among the axes' variables: the decoding asks for it.
            [ior(Endpoint), roughness(Centre, 0.0), anisotropy(Centre)],
            Decode::LossBias,
            &["loss", "bias"],
            &["roughness", "alpha", "n_dot_v", "anisotropy", "ior"],
        ),
        solid(
            // Both warps of the index of refraction, from 1 on: they share its root.
            "solid-ior",
            [
                mu(Endpoint, Warp::HomogeneousIor),
                roughness(Endpoint, 0.02),
                slices("ior", Endpoint, Warp::Ior, [1.0, 2.0]),
            ],
            Decode::Loss,
            &["loss"],
            &["roughness", "alpha", "n_dot_v", "ior"],
        ),
        solid(
            // From another minimum they do not.
            "solid-ior-apart",
            [
                mu(Centre, Warp::HomogeneousIor),
                roughness(Centre, 0.02),
                slices("ior", Centre, Warp::Ior, [1.05, 3.0]),
            ],
            Decode::Loss,
            &["loss"],
            &["roughness", "alpha", "n_dot_v", "ior"],
        ),
        solid(
            "solid-square",
            [
                mu(Endpoint, Warp::Linear),
                roughness(Endpoint, 0.0),
                slices("anisotropy", Centre, Warp::Square, [0.0, 1.0]),
            ],
            Decode::Albedo,
            &["E"],
            &["roughness", "alpha", "n_dot_v", "anisotropy"],
        ),
        solid(
            "solid-azimuth",
            [
                mu(Endpoint, Warp::HomogeneousAzimuth),
                roughness(Endpoint, 0.02),
                slices("anisotropy", Endpoint, Warp::Aspect, [0.0, 1.0]),
            ],
            Decode::AzimuthCubic,
            &["c0", "c1", "c2", "c3"],
            &["roughness", "alpha", "n_dot_v", "anisotropy", "cos2_phi"],
        ),
    ]
}

/// A table of the axes of anisotropic glass, which takes four fetches.
pub fn of_five_axes() -> Solid {
    let linear = |name: &str, size, range| axis(name, size, Registration::Endpoint, Warp::Linear, range);
    let axes = vec![
        axis("mu", SIZE[0], Registration::Endpoint, Warp::HomogeneousIor, [0.0, 1.0]),
        linear("cos2_phi", SIZE[1], [0.0, 1.0]),
        linear("roughness", SIZE[2], [0.02, 1.0]),
        axis("anisotropy", 2, Registration::Endpoint, Warp::Aspect, [0.0, 1.0]),
        axis("ior", 4, Registration::Endpoint, Warp::Ior, [1.0, 2.0]),
    ];
    Solid {
        table: table("solid-five", TexelFormat::F16, axes, &["loss"]).quantised(),
        names: TableNames::from("solid_five"),
        decode: Decode::Loss,
        arguments: &["roughness", "alpha", "n_dot_v", "anisotropy", "ior", "cos2_phi"],
    }
}

/// Points in the domain of the tables, their edges and corners, and some beyond, where lookups
/// clamp.
pub fn points() -> Vec<Point> {
    let mut points = Vec::new();
    let point = |[x, y, z, w, v]: [f32; 5]| Point {
        roughness: x,
        alpha: x * x,
        mu: y,
        anisotropy: z,
        ior: 1.0 + w,
        cos2_phi: v,
    };
    let edges = [0.0_f32, 0.02, 0.125, 0.5, 0.999, 1.0];
    for (i, x) in edges.into_iter().enumerate() {
        for (j, y) in edges.into_iter().enumerate() {
            for (k, z) in edges.into_iter().enumerate() {
                // Every cos2_phi with every pair of the others.
                points.push(point([x.max(1e-3), y, z, 1.0 - z, edges[(i + j + k) % edges.len()]]));
            }
        }
    }
    // The additive recurrence of the generalised golden ratio in five dimensions (Roberts 2018).
    let steps = [0.881_271_5_f64, 0.776_639_4, 0.684_430_1, 0.603_168_7, 0.531_555_4];
    for i in 1..20_000 {
        let at = steps.map(|step| (f64::from(i) * step).fract() as f32);
        points.push(point([at[0].max(1e-3), at[1], at[2] * 1.1, at[3] * 1.1, at[4]]));
    }
    points
}

/// roughness, alpha, mu, anisotropy, ior, cos2_phi of every point, one after another.
pub fn bytes(points: &[Point]) -> Vec<u8> {
    let numbers = |p: &Point| [p.roughness, p.alpha, p.mu, p.anisotropy, p.ior, p.cos2_phi];
    points.iter().flat_map(numbers).flat_map(f32::to_le_bytes).collect()
}

/// What warps and decodings use of a point.
pub fn surface(p: &Point) -> Surface<f32> {
    Surface { alpha: p.alpha, ior: p.ior, anisotropy: p.anisotropy, cos2_phi: p.cos2_phi }
}

/// What two machines may make differently of an azimuth's cubic.
#[derive(Clone, Copy, Debug, Default)]
pub struct Differences {
    /// Of a logarithm, relative to it.
    pub relative: f64,
    /// Of a logarithm, besides.
    pub absolute: f64,
    /// Of the channels.
    pub channels: [f64; 4],
}

/// A bound on the difference of E of [`Decode::AzimuthCubic`] between two machines, one of which
/// reads `texel`.
///
/// t = N/L, both logarithms, L no less than 1e-6 on either machine: N and L differ by dN and dL,
/// and t by dt <= (dN + |t| dL)/max(L - dL, 1e-6) and the roundings of two quotients. With
/// T = |t| + dt, the cubic differs by what the channels do, weighted with powers of T, by dt times
/// its largest slope |c1| + 2 |c2| T + 3 |c3| T^2, and by the roundings of seven operations, half a
/// unit on the one machine and one on the other.
pub fn azimuth_bound(texel: [f32; 4], point: &Point, differences: &Differences) -> f64 {
    let surface = surface(point);
    let log2 = |x: f32| ops::log(f64::from(x)) / std::f64::consts::LN_2;
    let (numerator, divisor) = (log2(spread(surface)).abs(), (-log2(squash(surface))).max(1e-6));
    let [dn, dl] = [numerator, divisor].map(|log| differences.relative * log + differences.absolute);
    let (t, ulp) = (numerator / divisor, f64::from(f32::EPSILON));
    let dt = (dn + t * dl) / (divisor - dl).max(1e-6) + 3.5 * ulp * t;
    let (most, [d0, d1, d2, d3]) = (t + dt, differences.channels);
    let [c0, c1, c2, c3] = [0, 1, 2, 3].map(|c| f64::from(texel[c]).abs() + differences.channels[c]);
    let by_channels = d0 + most * (d1 + most * (d2 + most * d3));
    let by_t = dt * (c1 + most * (2.0 * c2 + most * 3.0 * c3));
    let size = 1.0 + c0 + most * (c1 + most * (c2 + most * c3));
    by_channels + by_t + 7.0 * 1.5 * ulp * size
}

/// alpha_y/alpha_x.
pub fn squash(surface: Surface<f32>) -> f32 {
    1.0 - 0.9 * surface.anisotropy
}

/// (alpha_v/alpha)^2, alpha_v being the alpha towards the view.
fn spread(surface: Surface<f32>) -> f32 {
    surface.cos2_phi / squash(surface) + (1.0 - surface.cos2_phi) * squash(surface)
}

/// A certificate as the files bear it.
pub fn certificate() -> Certificate {
    let at: Place = [("mu".to_string(), 0.25), ("ior".to_string(), 1.5)].into_iter().collect();
    Certificate {
        max_abs: 0.0015,
        max_rel: 0.0021,
        rms: 0.0003,
        mean: -0.0001,
        domain: at.keys().map(|name| (name.clone(), [0.001, 2.0])).collect(),
        at,
        precision: "f16 texels, f32 lookup".into(),
        points: 1234,
    }
}
