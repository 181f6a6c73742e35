//! What timed functions are given.

use std::collections::BTreeMap;

use naga::{ArraySize, Scalar, TypeInner, VectorSize};

/// Ranges of a function's arguments by name, as the manifest has them.
pub(super) type Ranges = BTreeMap<String, [f64; 2]>;

/// An argument of an emitted function, or a coordinate of a plain fetch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Variable {
    /// A number in a range, whose ends may be one.
    Scalar(&'static str, f64, f64),
    /// The square of a roughness, in a range.
    Alpha(f64, f64),
    /// A direction, of unit length.
    Ray,
    /// A direction less than a right angle from the ray, of unit length.
    Normal,
    /// A direction less than a right angle from the normal, of unit length.
    View,
    /// A place in the room.
    Place,
    /// What is the same for all pixels.
    Held(Held),
}

/// What is the same for all pixels, and comes from a block of uniforms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Held {
    /// A corner of the room, or the probe.
    Corner(&'static str),
    /// So many planes.
    Planes(u32),
    /// The texture.
    Texture,
    /// The sampler.
    Sampler,
}

/// The numbers that functions take, and their ranges where the manifest has none: those of lookups
/// and levels, which hold for all.
const SCALARS: [(&str, f64, f64); 10] = [
    ("roughness", 0.15, 1.0),
    ("mu", 0.05, 1.0),
    ("n_dot_v", 0.05, 1.0),
    ("f0", 0.04, 1.0),
    ("ior", 1.05, 1.95),
    ("anisotropy", 0.05, 0.95),
    ("cos2_phi", 0.0, 1.0),
    ("rho", 0.1, 4.0),
    ("mip", 0.0, 6.0),
    ("distance", 0.1, 4.0),
];

pub(super) const CORNERS: [&str; 3] = ["low", "high", "probe"];

impl Variable {
    /// The argument of a name and type, in its range; none that this program emits has another.
    pub fn of(name: &str, ty: &TypeInner, ranges: &Ranges) -> Option<Variable> {
        match ty {
            TypeInner::Image { .. } => Some(Variable::Held(Held::Texture)),
            TypeInner::Sampler { .. } => Some(Variable::Held(Held::Sampler)),
            TypeInner::Array { size: ArraySize::Constant(n), .. } if name == "planes" => {
                Some(Variable::Held(Held::Planes(n.get())))
            }
            TypeInner::Scalar(Scalar::F32) if name == "alpha" => {
                let (_, low, high) = SCALARS[0];
                let [low, high] = ranges.get(name).copied().unwrap_or([low * low, high * high]);
                Some(Variable::Alpha(low, high))
            }
            TypeInner::Scalar(Scalar::F32) => {
                let known = SCALARS.into_iter().find(|(known, ..)| *known == name);
                let [low, high] = ranges.get(name).copied().or(known.map(|(_, low, high)| [low, high]))?;
                known.map(|(name, ..)| Variable::Scalar(name, low, high))
            }
            TypeInner::Vector { size: VectorSize::Tri, scalar: Scalar::F32 } => match name {
                "ray" => Some(Variable::Ray),
                "normal" => Some(Variable::Normal),
                "view" => Some(Variable::View),
                "place" | "offset" => Some(Variable::Place),
                _ => CORNERS.into_iter().find(|c| *c == name).map(|c| Variable::Held(Held::Corner(c))),
            },
            _ => None,
        }
    }

    /// Everything that is made to have some inputs, each after what it is made from.
    pub fn made(inputs: &[Variable]) -> Vec<Variable> {
        let mut made: Vec<Variable> = Vec::new();
        for input in inputs {
            let before = match *input {
                Variable::Alpha(low, high) => vec![Variable::Scalar(SCALARS[0].0, low.sqrt(), high.sqrt())],
                Variable::Normal => vec![Variable::Ray],
                Variable::View => vec![Variable::Ray, Variable::Normal],
                _ => Vec::new(),
            };
            for variable in before.into_iter().chain([*input]) {
                // By name: the roughness of an alpha is the roughness that is given beside it.
                if made.iter().all(|known| known.expression() != variable.expression()) {
                    made.push(variable);
                }
            }
        }
        made
    }

    /// What stands for it in a call.
    pub fn expression(&self) -> String {
        match self {
            Variable::Scalar(name, ..) => format!("timed_{name}"),
            Variable::Alpha(..) => "timed_alpha".into(),
            Variable::Ray => "timed_ray".into(),
            Variable::Normal => "timed_normal".into(),
            Variable::View => "timed_view".into(),
            Variable::Place => "timed_place".into(),
            Variable::Held(Held::Corner(name)) => format!("timed.{name}.xyz"),
            Variable::Held(Held::Planes(_)) => "timed_planes".into(),
            Variable::Held(Held::Texture) => "timed_texture".into(),
            Variable::Held(Held::Sampler) => "timed_sampler".into(),
        }
    }

    /// Its start at a pixel; the `index` tells inputs apart.
    pub fn start(&self, index: usize) -> String {
        match self {
            Variable::Scalar(name, low, high) => {
                let spots = ["timed_spot.x", "timed_spot.y", "(1.0 - timed_spot.x)", "(1.0 - timed_spot.y)"];
                let half = half(*low, *high);
                format!("    let timed_start_{name} = {low:?} + {half} * {};\n", spots[index % spots.len()])
            }
            // A sphere over the picture; a drift shorter than its radius leaves no direction
            // without a length.
            Variable::Ray => "    let timed_around = 6.2831855 * timed_spot.x;
    let timed_up = 2.0 * timed_spot.y - 1.0;
    let timed_wide = sqrt(max(1.0 - timed_up * timed_up, 0.0));
    let timed_base = vec3<f32>(timed_wide * cos(timed_around), timed_wide * sin(timed_around), timed_up);
"
            .into(),
            // Shorter than the ray: their sum is less than a right angle from it.
            Variable::Normal => "    let timed_lean = 0.8 * timed_base.yzx;\n".into(),
            Variable::View => "    let timed_rise = 0.8 * timed_base.zxy;\n".into(),
            Variable::Place => {
                "    let timed_from = vec3<f32>(timed_spot - 0.5, 0.5 - timed_spot.x);\n".into()
            }
            Variable::Alpha(..) | Variable::Held(_) => String::new(),
        }
    }

    /// Its value in a turn of the loop.
    pub fn turn(&self) -> String {
        match self {
            Variable::Scalar(name, low, high) => {
                let half = half(*low, *high);
                format!("        let timed_{name} = timed_start_{name} + {half} * timed_turn;\n")
            }
            Variable::Alpha(..) => "        let timed_alpha = timed_roughness * timed_roughness;\n".into(),
            Variable::Ray => {
                "        let timed_ray = normalize(timed_base + timed_turn * vec3<f32>(0.4, -0.3, 0.2));\n"
                    .into()
            }
            Variable::Normal => "        let timed_normal = normalize(timed_ray + timed_lean);\n".into(),
            Variable::View => "        let timed_view = normalize(timed_normal + timed_rise);\n".into(),
            Variable::Place => {
                "        let timed_place = timed_from + timed_turn * vec3<f32>(0.3, -0.2, 0.25);\n".into()
            }
            Variable::Held(_) => String::new(),
        }
    }

    /// What it adds to the sum of the loop; none of what is the same for all.
    pub fn summed(&self) -> Option<String> {
        let name = self.expression();
        match self {
            Variable::Scalar(..) | Variable::Alpha(..) => Some(name),
            Variable::Ray | Variable::Normal | Variable::View | Variable::Place => {
                Some(format!("{name}.x + {name}.y + {name}.z"))
            }
            Variable::Held(_) => None,
        }
    }
}

/// Half of a range as an expression. That of a range of one value is a zero that no compiler knows,
/// so that a function is not specialised to the value.
fn half(low: f64, high: f64) -> String {
    if low < high { format!("{:?}", 0.5 * (high - low)) } else { "timed.zero".into() }
}
