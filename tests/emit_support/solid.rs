//! Small tables of three axes whose sizes differ and whose texels tell their place, and points to look them up at.

use lobefit::data::{
    AlphaMap, Axis, Certificate, Channel, Decode, Place, Registration, Smith, Table, TexelFormat, Warp,
};
use lobefit::effects::volume::Point;

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

/// A table of two or three of the axes given, with channels of these names.
fn table(name: &str, format: TexelFormat, axes: Vec<Axis>, channels: &[&str]) -> Table {
    let [columns, rows, slices] = [0, 1, 2].map(|k| axes.get(k).map_or(1, |axis: &Axis| axis.size));
    let place = |i: usize| [i % columns, i / columns % rows, i / columns / rows];
    let channel = |(c, name): (usize, &&str)| Channel {
        name: name.to_string(),
        texels: (0..columns * rows * slices).map(|i| texel(c, place(i))).collect(),
    };
    let table = Table {
        name: name.into(),
        quantity: "ggx-glass".into(),
        smith: Smith::Separable,
        alpha_map: AlphaMap::RoughnessSquared,
        channels: channels.iter().enumerate().map(channel).collect(),
        axes,
        format,
    };
    table.validate().expect("a table");
    table
}

/// Tables of every shape that the formats tell apart: two and three axes, f16 and f32, one to four channels.
pub fn of_all_shapes() -> Vec<Table> {
    let names = ["loss", "second", "a third", "w"];
    let mut tables = Vec::new();
    for format in [TexelFormat::F16, TexelFormat::F32] {
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
    pub decode: Decode,
    pub arguments: &'static [&'static str],
}

/// Tables of three axes with every decoding, warp and registration.
pub fn to_look_up() -> Vec<Solid> {
    use Registration::{Centre, Endpoint};
    let mu = |registration, warp| axis("mu", SIZE[0], registration, warp, [0.0, 1.0]);
    let roughness = |registration, low| axis("roughness", SIZE[1], registration, Warp::Linear, [low, 1.0]);
    let ior = |registration| axis("ior", SIZE[2], registration, Warp::Linear, [1.0, 2.0]);
    let anisotropy = |registration| axis("anisotropy", SIZE[2], registration, Warp::Linear, [0.0, 0.95]);
    let solid = |name: &str, axes: [Axis; 3], decode: Decode, channels: &[&str], arguments| Solid {
        table: table(name, TexelFormat::F16, axes.to_vec(), channels).quantised(),
        decode,
        arguments,
    };
    vec![
        solid(
            "solid-loss",
            [mu(Endpoint, Warp::Homogeneous), roughness(Endpoint, 0.02), ior(Endpoint)],
            Decode::Loss,
            &["loss"],
            &["roughness", "alpha", "mu", "ior"],
        ),
        solid(
            "solid-albedo",
            [mu(Centre, Warp::Sqrt), roughness(Centre, 0.0), anisotropy(Centre)],
            Decode::Albedo,
            &["E"],
            &["roughness", "mu", "anisotropy"],
        ),
        solid(
            "solid-split",
            [mu(Centre, Warp::Linear), roughness(Endpoint, 0.1), anisotropy(Endpoint)],
            Decode::SplitSum,
            &["A", "B"],
            &["roughness", "mu", "anisotropy"],
        ),
        solid(
            "solid-bias",
            // mu is not among the axes' variables: the decoding asks for it.
            [ior(Endpoint), roughness(Centre, 0.0), anisotropy(Centre)],
            Decode::LossBias,
            &["loss", "bias"],
            &["roughness", "mu", "anisotropy", "ior"],
        ),
    ]
}

/// Points in the domain of the tables, their edges and corners, and some beyond, where lookups clamp.
pub fn points() -> Vec<Point> {
    let mut points = Vec::new();
    let point = |[x, y, z, w]: [f32; 4]| Point {
        roughness: x,
        alpha: x * x,
        mu: y,
        anisotropy: z,
        ior: 1.0 + w,
        cos2_phi: 1.0,
    };
    let edges = [0.0_f32, 0.02, 0.125, 0.5, 0.999, 1.0];
    for x in edges {
        for y in edges {
            for z in edges {
                points.push(point([x.max(1e-3), y, z, 1.0 - z]));
            }
        }
    }
    // The additive recurrence of the generalised golden ratio in four dimensions (Roberts 2018).
    let steps = [0.856_674_9_f64, 0.733_891_9, 0.628_706_7, 0.538_597_3];
    for i in 1..20_000 {
        let at = steps.map(|step| (f64::from(i) * step).fract() as f32);
        points.push(point([at[0].max(1e-3), at[1], at[2] * 1.1, at[3] * 1.1]));
    }
    points
}

/// roughness, alpha, mu, anisotropy, ior of every point, one after another.
pub fn bytes(points: &[Point]) -> Vec<u8> {
    let numbers = |p: &Point| [p.roughness, p.alpha, p.mu, p.anisotropy, p.ior];
    points.iter().flat_map(numbers).flat_map(f32::to_le_bytes).collect()
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
