//! Somebody else's tables of a linearly transformed cosine against its lobe.

use serde::Serialize;

use crate::audit::{AuditError, Grade};
use crate::foreign::{Channel, ForeignTable};
use lobefit::data::Decode;
use lobefit_ltc::{Deviation, Lobe, Pair, Setting, measured};
use lobefit_shade::round_up;

/// Channels of both textures.
const CHANNELS: usize = 4;

/// What was found of a pair.
#[derive(Debug, PartialEq, Serialize)]
pub struct LtcFindings {
    /// The file of the matrices.
    pub file: String,
    /// What it is, in words.
    pub holds: String,
    /// The lobe that it is measured against.
    pub lobe: String,
    /// Range of roughness, where alpha = roughness^2.
    pub roughness: [f64; 2],
    /// Range of the cosine of the view.
    pub mu: [f64; 2],
    /// Squares that were looked at.
    pub squares: usize,
    /// Each error, with what it is of.
    pub errors: Vec<LtcError>,
    /// Largest error that is accepted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    /// PASS, FAIL, or where E and B were not given UNKNOWN, if there is a limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grade: Option<&'static str>,
}

/// One error.
#[derive(Debug, PartialEq, Serialize)]
pub struct LtcError {
    /// What is off.
    pub of: &'static str,
    /// The largest.
    pub max: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// Roughness of the largest.
    pub roughness: f64,
    /// mu of the largest.
    pub mu: f64,
    /// Whether a limit holds for it: what a better table mends.
    pub is_limited: bool,
}

/// The pair of some tables: matrices in the first four channels of the first, E and B in the second, in the
/// second slice of the first or in four more channels of it; none of E where there is no second.
///
/// # Errors
/// Tables that are not square, or of other sizes and channels.
pub fn pair(tables: &[ForeignTable]) -> Result<(Pair, bool), AuditError> {
    let mut layers: Vec<Vec<[f64; CHANNELS]>> = Vec::new();
    let mut side = 0;
    for table in tables {
        let refused = |reason: String| AuditError::refused(&format!("{} {}", table.file, table.name), reason);
        let (size, channels) = (&table.size, &table.channels);
        let [columns, rows] = match size[..] {
            [columns, rows] | [columns, rows, _] => [columns, rows],
            _ => return Err(refused(format!("size {size:?}, where a pair is over two axes; give --size"))),
        };
        if columns != rows || columns < 2 || (side > 0 && columns != side) {
            return Err(refused(format!("size {size:?}: the tables of a pair are square and of one size")));
        }
        let found = channels.len();
        if found != CHANNELS && found != 2 * CHANNELS {
            return Err(refused(format!(
                "{found} channels, where a matrix has m11, m31, m13 and m33, and beside E and B 8; give --channels 4 or 8"
            )));
        }
        side = columns;
        for channels in channels.chunks(CHANNELS) {
            let order = by_name(channels);
            let texel = |i: usize| order.map(|c| channels[c].values.get(i).copied().unwrap_or(f64::NAN));
            let texels: Vec<[f64; CHANNELS]> = (0..table.texels()).map(texel).collect();
            layers.extend(texels.chunks(side * side).map(<[_]>::to_vec));
        }
    }
    if layers.len() > 2 {
        let reason = format!(
            "{} layers and tables, where a pair has two; give --symbol, or leave --scales out",
            layers.len()
        );
        return Err(AuditError::refused(&tables[0].file, reason));
    }
    let has_scales = layers.len() > 1;
    let mut layers = layers.into_iter();
    let matrices = layers.next().ok_or_else(|| AuditError::refused("the file", "holds no table"))?;
    let amplitudes = layers.next().unwrap_or_else(|| vec![[0.0; CHANNELS]; matrices.len()]);
    Ok((Pair { side, matrices, amplitudes }, has_scales))
}

/// The channels in the order of a pair: that of their names, where they have those of our tables, for OpenEXR
/// sorts channels by name; else the file's own.
fn by_name(channels: &[Channel]) -> [usize; CHANNELS] {
    let of = |decode: Decode| -> Option<Vec<usize>> {
        let names = decode.formulas().iter();
        names.map(|(name, _)| channels.iter().position(|channel| channel.name == *name)).collect()
    };
    let named = [Decode::Transform, Decode::Light].into_iter().find_map(of);
    named.and_then(|order| order.try_into().ok()).unwrap_or_else(|| std::array::from_fn(|c| c))
}

impl LtcFindings {
    /// Measures a pair, of which E and B count where it has them.
    ///
    /// # Errors
    /// Values that are no numbers.
    pub fn new(
        (pair, has_scales): &(Pair, bool),
        table: &ForeignTable,
        setting: &Setting,
        limit: Option<f64>,
    ) -> Result<LtcFindings, AuditError> {
        let found = measured(pair, setting, |roughness| roughness * roughness);
        let found = found.map_err(|error| AuditError::refused(&table.file, error.to_string()))?;
        let error = |of: &'static str, d: Deviation, is_limited: bool| LtcError {
            of,
            max: round_up(d.max, 3),
            rms: round_up(d.rms, 3),
            roughness: d.at[0],
            mu: d.at[1],
            is_limited,
        };
        let mut errors = vec![
            error("a square light, share of the lobe's light", found.shape, true),
            error("a light of any shape, at most", found.misplaced, false),
        ];
        if *has_scales {
            errors.push(error("E", found.amplitude, true));
            errors.push(error("B", found.bias, true));
        }
        let kept = |limit: f64| errors.iter().all(|error| !error.is_limited || error.max <= limit);
        let grade = limit.map(|limit| match (kept(limit), has_scales) {
            (true, true) => Grade::Pass,
            (true, false) => Grade::Unknown,
            (false, _) => Grade::Fail,
        });
        let grade = grade.map(Grade::word);
        let lobe = match setting.lobe {
            Lobe::Ggx(smith) => format!("GGX, {} Smith", smith.name()),
            Lobe::Charlie => "Charlie with Neubelt's visibility".into(),
        };
        let (roughness, mu) = (setting.roughness, setting.mu);
        let (file, holds) = (table.file.clone(), table.what.clone());
        Ok(LtcFindings { file, holds, lobe, roughness, mu, squares: found.shape.count, errors, limit, grade })
    }

    /// Whether all of it is within the limit, if there is one.
    pub fn passed(&self) -> bool {
        self.grade.is_none_or(|grade| grade == Grade::Pass.word())
    }

    /// In lines.
    pub fn text(&self) -> String {
        let [r, mu] = [self.roughness, self.mu].map(|[low, high]| format!("{low} to {high}"));
        let limit = self.limit.map_or_else(String::new, |limit| format!(" with --limit {limit}"));
        let grade = self.grade.map_or_else(String::new, |grade| format!("{grade}{limit}: "));
        let mut text = format!(
            "{grade}{}: a linearly transformed cosine of {}; alpha = roughness^2 along x, sqrt(1-mu) along y, both at end points\n\
             over roughness {r}, mu {mu}: {} squares that face the point\n",
            self.file, self.lobe, self.squares
        );
        for LtcError { of, max, rms, roughness, mu, .. } in &self.errors {
            text += &format!("  {of}: {max}, RMS {rms}; worst at roughness {roughness:.4}, mu {mu:.4}\n");
        }
        if !self.errors.iter().any(|error| error.of == "E") {
            text += "  E and B: not judged, the file has none; give their table with --scales\n";
        }
        text
    }
}
