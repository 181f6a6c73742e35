//! Wanted tables: of the lobe of a metal or a dielectric, with or without its anisotropy, and of
//! rough glass.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::limits::{
    AXIS_MAX, AXIS_MIN, SLICED_AXIS_MAX, SLICED_AXIS_MIN, SLICED_CELLS, SLICED_LINES, TABLE_MU, TEXTURE_DEPTH,
};
use super::material::Lobe;
use super::number::{AxisSize, Cosine, ErrorLimit, In, Span, Whole};
use super::value::{List, Maybe, Word, about, distinct, from_file};
use crate::data::{AXES, Engine, TexelFormat};
pub use crate::data::{Layout, Serves};
use lobefit_math::ops;

/// The limit on the lookup error where neither size nor limit is given, which chooses the size of a
/// table of two axes: what 32x32 texels in the homogeneous layout (64x64 for split sum) reach with
/// room to spare. Of three axes the default size is one whatever the error, and nothing is
/// promised.
fn default_limit(layout: Layout, serves: Serves) -> Option<f64> {
    match (layout, serves) {
        (Layout::Homogeneous | Layout::Plain | Layout::PlainSquared, Serves::Albedo) => Some(1e-3),
        (Layout::Homogeneous | Layout::Plain | Layout::PlainSquared, Serves::SplitSum) => Some(3e-3),
        (
            Layout::Optimised
            | Layout::Azimuth
            | Layout::FiveAxis
            | Layout::PathTracer
            | Layout::AreaLights
            | Layout::Dielectric,
            _,
        ) => None,
    }
}

/// Texels along each axis where the scene gives none: open for tables of two axes, fixed for the
/// path tracer's.
fn default_size(lobe: Lobe, layout: Layout) -> Option<Vec<usize>> {
    match (layout, lobe) {
        (Layout::Homogeneous | Layout::Plain | Layout::PlainSquared, _) => None,
        (Layout::Azimuth, _) => Some(vec![64, 16, 16]),
        (Layout::FiveAxis, _) => Some(vec![8, 4, 5, 4, 5]),
        (Layout::Dielectric, _) => Some(vec![32, 32, 16]),
        (Layout::AreaLights, _) => Some(vec![64, 64]),
        (Layout::Optimised | Layout::PathTracer, Lobe::Glass | Lobe::AnisotropicGlass) => {
            Some(vec![128, 128, 32])
        }
        (Layout::Optimised | Layout::PathTracer, Lobe::Isotropic | Lobe::Anisotropic) => {
            Some(vec![64, 64, 32])
        }
    }
}

/// A wanted table; of glass two tables, one for rays from outside and one for rays from inside.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableWant {
    /// Coordinates, and with them the number of axes.
    pub layout: Layout,
    /// Texels along each axis; `None`, of two axes alone: the smallest of 16, 32, 64, 128 squares
    /// that meets the limit.
    pub size: Option<Vec<usize>>,
    /// Whether the scene leaves the slices open.
    #[serde(skip)]
    pub has_open_slices: bool,
    /// How a texel is stored.
    pub format: TexelFormat,
    /// What it is looked up for: with a third axis the albedo.
    pub serves: Serves,
    /// Largest lookup error that the bake may deliver; always given of two axes where `size` is
    /// `None`, never in the path tracer's layout.
    pub max_error: Option<f64>,
    /// Most bytes of a table whose size is open: of three axes the size is then the largest that is
    /// tried. No field of a file: `lobefit cost --max-bytes` states it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_bytes: Option<u64>,
    /// The cosine of the view over which its error is measured.
    // Absent at its default: the hash of a scene without it is that of the versions before it.
    #[serde(skip_serializing_if = "is_usual")]
    pub n_dot_v: [f64; 2],
    /// Engines whose file of a pair of area lights is written too.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub engines: Vec<Engine>,
}

impl TableWant {
    /// A table of two axes without a limit.
    pub fn flat(layout: Layout, size: [usize; 2], format: TexelFormat) -> TableWant {
        let (serves, size) = (Serves::Albedo, Some(size.to_vec()));
        let (max_error, max_bytes, n_dot_v, engines) = (None, None, TABLE_MU, Vec::new());
        TableWant {
            layout,
            size,
            has_open_slices: false,
            format,
            serves,
            max_error,
            max_bytes,
            n_dot_v,
            engines,
        }
    }

    /// Whether the other is the same table, whatever limits there are.
    pub fn is_like(&self, other: &TableWant) -> bool {
        let key = |t: &TableWant| (t.layout, t.size.clone(), t.format, t.serves);
        key(self) == key(other)
    }

    /// Takes no more slices than these, where the scene leaves them open, and of a range asks for no error.
    pub(super) fn settle_slices(&mut self, enough: usize, is_one: bool) {
        let is_open = self.has_open_slices && (is_one || self.max_error.is_none());
        if let (true, Some([_, _, slices])) = (is_open, self.size.as_deref_mut()) {
            *slices = if is_one { 1 } else { enough.min(*slices) };
        }
    }

    /// Whether it has an axis less, as what its slices would span is one value.
    pub fn has_one_slice(&self) -> bool {
        matches!(self.size.as_deref(), Some([_, _, 1]))
    }
}

/// How far in [`distance`] two slices may lie apart.
const SLICE_STEP: f64 = 0.08;

/// Least index of refraction from which [`distance`] says how far the loss bends: below, the onset of total
/// internal reflection crosses the columns.
const SPANNED_IOR: f64 = 1.1;

/// How many slices a table needs between two values of what its slices span, ior or anisotropy. With these
/// the root mean square of the lookup error is at most a half above that with 32 slices; measured over
/// [1.1, 1.2], [1.2, 1.4], [1.3, 1.7], [1.45, 1.55] and [2.37, 2.43] of ior, and over [0.1, 0.3], [0.4, 0.6],
/// [0, 0.5], [0.8, 0.9] and [0.95, 1] of anisotropy.
pub(super) fn enough_slices(lobe: Lobe, range: [f64; 2]) -> usize {
    let steps = distance(lobe, range) / SLICE_STEP;
    let few = [SLICED_AXIS_MIN, 2 * SLICED_AXIS_MIN, 4 * SLICED_AXIS_MIN];
    few.into_iter().find(|n| (n - 1) as f64 >= steps).unwrap_or(SLICED_AXIS_MAX)
}

/// How far apart two values are: ln of the ratio of what bends light, ior - 1, or of that of the squared
/// aspects.
fn distance(lobe: Lobe, [low, high]: [f64; 2]) -> f64 {
    match lobe {
        Lobe::Glass | Lobe::AnisotropicGlass if low < SPANNED_IOR => f64::INFINITY,
        Lobe::Glass | Lobe::AnisotropicGlass => ops::log((high - 1.0) / (low - 1.0)),
        Lobe::Isotropic | Lobe::Anisotropic => ops::log((1.0 - 0.9 * low) / (1.0 - 0.9 * high)),
    }
}

fn is_usual(n_dot_v: &[f64; 2]) -> bool {
    *n_dot_v == TABLE_MU
}

/// A wanted table; what the lobe decides is open.
pub(super) struct OpenTable {
    layout: Option<Layout>,
    size: Option<Vec<usize>>,
    format: TexelFormat,
    serves: Option<Serves>,
    max_error: Option<f64>,
    n_dot_v: [f64; 2],
    engines: Option<List<Word<Engine>, { Engine::ALL.len() }>>,
}

/// A table of the albedo: over mu and roughness; with the anisotropy as a third axis, as the mean
/// over the azimuth of the view or with it; or of rough glass with the index of refraction as a
/// third axis, for rays from outside and from inside. The error of a table is that of its linear
/// lookup after rounding to the texel format.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Table", extend("anyOf" = [
    {
        "properties": {
            "layout": { "enum": ["homogeneous", "plain", "plain-squared", "area-lights"] },
            "size": { "maxItems": 2 },
        },
    },
    {
        "properties": {
            "layout": { "enum": ["optimised", "path-tracer", "azimuth", "dielectric"] },
            "size": { "maxItems": 3, "items": { "minimum": 4, "maximum": 256 } },
            "serves": { "const": "albedo" },
        },
    },
    {
        "properties": {
            "layout": { "const": "five-axis" },
            "size": { "minItems": 5, "items": { "maximum": 256 } },
            "serves": { "const": "albedo" },
        },
    },
]))]
#[serde(deny_unknown_fields, default, expecting = "an object that describes a table")]
struct TableFile {
    /// Coordinates of the texels. Over mu and roughness: `homogeneous` (the default of isotropic
    /// materials), `plain`, `plain-squared`; `area-lights`, over roughness in [0, 1] and sqrt(1 -
    /// mu), for a pair of tables of a linearly transformed cosine, by which polygons light the lobe. With
    /// a third axis, of anisotropic materials and of glass: `optimised` (their default), `path-tracer`,
    /// which takes separable Smith and alpha = roughness whatever the scene says, has its own size and
    /// takes no `max_error`, and `azimuth`, which is for anisotropic materials. In `exact_fresnel`
    /// `dielectric` alone, over mu, roughness and ior. With
    /// five, of glass with anisotropy and its default: `five-axis`, over mu, azimuth, roughness, anisotropy
    /// and ior.
    layout: Maybe<Word<Layout>>,
    /// Texels along mu, roughness and the third axis where there is one: 2 to 1024 along two, 4 to
    /// 256 along three, of these at most 4194304 together, and in the optimised and dielectric layouts
    /// 16384 columns times slices. Default of two axes: the smallest of 16x16, 32x32, 64x64, 128x128 that
    /// meets `max_error`, of `area-lights` 64x64; of three: 64x64x32, with the azimuth 64x16x16, of glass
    /// 128x128x32, `dielectric` 32x32x16, `five-axis` 8x4x5x4x5 (2 to 256 along each, at most 2048 along the
    /// last three together), 4, 8 or 16 slices where the anisotropies or indices of refraction of the
    /// materials lie close together. Where they are one value, an axis less: then two numbers do.
    #[schemars(extend("minItems" = 2))]
    size: Maybe<List<Whole<AxisSize>, AXES>>,
    /// Texel format; default `f16`. `unorm16` has the bytes of a half and a 16th of its rounding near 1,
    /// `unorm8` half the bytes; both hold [0, 1], which layouts of signed texels (`azimuth`, `area-lights`,
    /// and `homogeneous` for `split-sum`) do not keep to.
    format: Maybe<Word<TexelFormat>>,
    /// What the table is looked up for; default `albedo`, the only one with a third axis and of
    /// `area-lights`.
    serves: Maybe<Word<Serves>>,
    /// Limit on the lookup error, of `area-lights` on the share of a square light; the bake fails where it is
    /// exceeded. Default of two axes without `size`, but for `area-lights`: 0.001 for `albedo`, 0.003 for
    /// `split-sum`; else no limit, and the bake says the error.
    max_error: Maybe<In<ErrorLimit>>,
    /// Range [lo, hi] of the cosine of the view over which the error is measured and texels are
    /// optimised; default [0.001, 1]. A plain layout cannot follow the lobe at grazing views.
    n_dot_v: Maybe<Span<Cosine, false>>,
    /// Of `area-lights`: engines that read the pair from one file, which is written beside the `formats`:
    /// `babylon`, `bevy`, `three`. They take 64x64 texels of f16, and alpha = roughness^2.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    engines: Maybe<List<Word<Engine>, { Engine::ALL.len() }>>,
}

impl TryFrom<TableFile> for OpenTable {
    type Error = String;

    fn try_from(file: TableFile) -> Result<Self, String> {
        Ok(OpenTable {
            layout: file.layout.0.map(|w| w.0),
            size: file.size.0.map(|List(size)| size.into_iter().map(|n| n.0 as usize).collect()),
            format: file.format.0.map_or(TexelFormat::F16, |w| w.0),
            serves: file.serves.0.map(|w| w.0),
            max_error: file.max_error.0.map(|e| e.0),
            n_dot_v: file.n_dot_v.0.map_or(TABLE_MU, |s| s.0),
            engines: file.engines.0,
        })
    }
}

/// The tables of a list at a field, as a material wants them, each once.
pub(super) fn different(
    list: Vec<OpenTable>,
    of: impl Fn(OpenTable) -> Result<TableWant, String>,
    field: &str,
) -> Result<Vec<TableWant>, String> {
    let mut tables: Vec<TableWant> = Vec::with_capacity(list.len());
    for (i, open) in list.into_iter().enumerate() {
        let table = of(open).map_err(|e| about(format!("{field}[{i}]"), e))?;
        if let Some(first) = tables.iter().position(|known| known.is_like(&table)) {
            let message = format!("it has the layout, size, format and use of {field}[{first}]");
            return Err(about(format!("{field}[{i}]"), message));
        }
        tables.push(table);
    }
    Ok(tables)
}

impl OpenTable {
    /// The table that a material wants where it does not say.
    pub(super) fn default() -> Result<OpenTable, String> {
        OpenTable::try_from(TableFile::default())
    }

    /// The table as a material with this lobe wants it.
    pub(super) fn of(self, lobe: Lobe) -> Result<TableWant, String> {
        let layout = self.layout.unwrap_or(match lobe {
            Lobe::Isotropic => Layout::Homogeneous,
            Lobe::Anisotropic | Lobe::Glass => Layout::Optimised,
            Lobe::AnisotropicGlass => Layout::FiveAxis,
        });
        fits_lobe(layout, lobe).map_err(|e| about("layout", e))?;
        self.in_layout(layout, lobe)
    }

    /// The table of a dielectric's lobe with the exact Fresnel term.
    pub(super) fn of_exact_fresnel(self) -> Result<TableWant, String> {
        if let Some(layout) = self.layout.filter(|layout| *layout != Layout::Dielectric) {
            let message =
                format!("`{}` is of other lobes; of the exact Fresnel term give `dielectric`", layout.name());
            return Err(about("layout", message));
        }
        self.in_layout(Layout::Dielectric, Lobe::Isotropic)
    }

    fn in_layout(self, layout: Layout, lobe: Lobe) -> Result<TableWant, String> {
        if layout == Layout::PathTracer {
            if self.size.is_some() {
                return Err(about("size", "the path-tracer layout has its own; leave it out"));
            }
            if self.max_error.is_some() {
                let message = "the error of the path-tracer layout is reported, not chosen; leave it out";
                return Err(about("max_error", message));
            }
        }
        let mut size = self.size;
        if let Some(size) = &mut size {
            if layout.axes() == 3 && size.len() == 2 {
                // Whether there is one value alone is the scene's to tell.
                size.push(1);
            }
            check_size(layout, size)?;
        }
        if self.n_dot_v[0] >= self.n_dot_v[1] {
            return Err(about("n_dot_v", "a range of one value; give [lo, hi] with lo below hi"));
        }
        let serves = self.serves.unwrap_or_default();
        if (layout.axes() > 2 || layout == Layout::AreaLights) && serves != Serves::Albedo {
            let message = format!(
                "the {} layout serves the albedo; for `split-sum` give `homogeneous`, `plain` or `plain-squared`",
                layout.name()
            );
            return Err(about("serves", message));
        }
        if self.format.steps().is_some() && !within_unit(layout, serves) {
            let message = format!(
                "`{}` holds [0, 1], and texels of the {} layout{} are signed; give `f16`",
                self.format.name(),
                layout.name(),
                if serves == Serves::SplitSum { " for `split-sum`" } else { "" }
            );
            return Err(about("format", message));
        }
        let default_limit = || if size.is_none() { default_limit(layout, serves) } else { None };
        let max_error = self.max_error.or_else(default_limit);
        let has_open_slices = size.is_none() && layout.axes() == 3 && layout != Layout::PathTracer;
        let size = size.or_else(|| default_size(lobe, layout));
        let (format, n_dot_v) = (self.format, self.n_dot_v);
        let engines = self.engines.map_or(Ok(Vec::new()), |List(words)| {
            let engines = distinct(words.into_iter().map(|Word(engine)| engine), Engine::name)?;
            check_engines(&engines, layout, size.as_deref(), format).map(|()| engines)
        });
        let engines = engines.map_err(|e| about("engines", e))?;
        Ok(TableWant {
            layout,
            size,
            has_open_slices,
            format,
            serves,
            max_error,
            max_bytes: None,
            n_dot_v,
            engines,
        })
    }
}

/// Whether the texels of a layout are in [0, 1]: albedos, losses, scales and biases are, expansions,
/// differences and matrices are not.
fn within_unit(layout: Layout, serves: Serves) -> bool {
    match layout {
        Layout::Azimuth | Layout::AreaLights | Layout::Dielectric => false,
        Layout::Homogeneous => serves == Serves::Albedo,
        Layout::Plain | Layout::PlainSquared | Layout::Optimised | Layout::PathTracer | Layout::FiveAxis => {
            true
        }
    }
}

/// Whether tables of a lobe have the layout; if not, the message.
fn fits_lobe(layout: Layout, lobe: Lobe) -> Result<(), String> {
    let name = layout.name();
    match (lobe, layout) {
        (_, Layout::Dielectric) => {
            Err(format!("`{name}` is of the exact Fresnel term; list it in `wants.exact_fresnel.tables`"))
        }
        (Lobe::AnisotropicGlass, Layout::FiveAxis) => Ok(()),
        (_, Layout::FiveAxis) => Err(format!("`{name}` is for glass with `anisotropy`")),
        (Lobe::AnisotropicGlass, _) => {
            Err(format!("`{name}` does not know the anisotropy of glass; give `five-axis`"))
        }
        (Lobe::Isotropic, Layout::Azimuth) => Err(format!(
            "`{name}` is for anisotropic materials; give `anisotropy`, or one of `homogeneous`, `plain`, `plain-squared`"
        )),
        (Lobe::Isotropic, Layout::Optimised | Layout::PathTracer) => Err(format!(
            "`{name}` is for anisotropic materials and for glass; give `anisotropy`, or one of `homogeneous`, `plain`, \
             `plain-squared`"
        )),
        (Lobe::Glass, Layout::Azimuth) => {
            Err(format!("`{name}` is for anisotropic materials; of glass give `optimised` or `path-tracer`"))
        }
        (Lobe::Glass, Layout::Homogeneous | Layout::Plain | Layout::PlainSquared | Layout::AreaLights) => {
            Err(format!("`{name}` is of lobes that only reflect; of glass give `optimised` or `path-tracer`"))
        }
        (
            Lobe::Isotropic,
            Layout::Homogeneous | Layout::Plain | Layout::PlainSquared | Layout::AreaLights,
        )
        | (Lobe::Glass, Layout::Optimised | Layout::PathTracer)
        | (Lobe::Anisotropic, _) => Ok(()),
    }
}

/// Holds a size to its number of axes and to the limits.
fn check_size(layout: Layout, size: &[usize]) -> Result<(), String> {
    let (axes, name) = (layout.axes(), layout.name());
    if let (Layout::AreaLights, &[columns, rows]) = (layout, size)
        && columns != rows
    {
        return Err(about("size", "engines read square tables of area lights"));
    }
    if size.len() != axes {
        let numbers = if size.len() == 1 { "1 number".into() } else { format!("{} numbers", size.len()) };
        return Err(about("size", format!("{numbers} where the {name} layout has {axes} axes")));
    }
    let [low, high] = match axes {
        2 => [AXIS_MIN, AXIS_MAX],
        3 => [SLICED_AXIS_MIN, SLICED_AXIS_MAX],
        _ => [AXIS_MIN, SLICED_AXIS_MAX],
    };
    let own = size.strip_suffix(&[1]).filter(|_| axes == 3).unwrap_or(size);
    if let Some((i, n)) = own.iter().enumerate().find(|(_, n)| !(low..=high).contains(*n)) {
        return Err(about(format!("size[{i}]"), format!("{n} is outside [{low}, {high}]")));
    }
    if axes == 2 {
        return Ok(());
    }
    if size.iter().product::<usize>() > SLICED_CELLS {
        let size: Vec<String> = size.iter().map(ToString::to_string).collect();
        return Err(about("size", format!("{} is more than {SLICED_CELLS} texels", size.join("x"))));
    }
    let &[columns, _, slices] = size else { return check_depth(size) };
    if matches!(layout, Layout::Optimised | Layout::Dielectric) && columns * slices > SLICED_LINES {
        let message = format!(
            "{columns} columns x {slices} slices of the {name} layout are more than {SLICED_LINES}; rows cost less"
        );
        return Err(about("size", message));
    }
    Ok(())
}

/// Holds the engines of a table to what they read.
fn check_engines(
    engines: &[Engine],
    layout: Layout,
    size: Option<&[usize]>,
    format: TexelFormat,
) -> Result<(), String> {
    if engines.is_empty() {
        return Err("the list is empty; leave the field out".into());
    }
    if layout != Layout::AreaLights {
        return Err(format!(
            "no engine reads a table in the `{}` layout; engines read `area-lights`",
            layout.name()
        ));
    }
    if size != Some(&[64, 64]) || format != TexelFormat::F16 {
        return Err("engines read 64x64 texels of f16; leave `size` and `format` out".into());
    }
    Ok(())
}

/// Holds the axes that a texture has as its slices to what a texture may have.
fn check_depth(size: &[usize]) -> Result<(), String> {
    let depth: usize = size.iter().skip(2).product();
    if depth > TEXTURE_DEPTH {
        return Err(about("size", format!("{depth} slices, where a texture has at most {TEXTURE_DEPTH}")));
    }
    Ok(())
}

from_file!(OpenTable, TableFile);
