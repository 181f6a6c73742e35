//! What a file that this tool wrote says of itself, in its attribute `lobefit` or in its sidecar:
//! the header that every emitted table bears.

use super::formula::Formula;
use crate::audit::Registration;
use lobefit::data::Smith;
use lobefit_truth::integrate::glass::Side;

/// One axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    /// What runs along it: `mu`, `roughness`, ...
    pub name: String,
    /// Texels.
    pub size: usize,
    /// Where they lie.
    pub registration: Registration,
    /// Range of what runs along it.
    pub range: [f64; 2],
    /// Its coordinate, as printed.
    pub text: String,
    /// Its coordinate u in [0, 1], and what the names in it stand for.
    pub coordinate: Vec<(String, Formula)>,
}

/// `(t = 0 at anisotropy 0)`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Exception {
    /// What has the value.
    pub name: String,
    /// The value.
    pub value: f64,
    /// Where: at this input's value.
    pub at: (String, f64),
}

/// What the file says.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Statement {
    pub quantity: String,
    pub smith: Option<Smith>,
    pub side: Option<Side>,
    /// alpha of a roughness.
    pub alpha: Formula,
    pub axes: Vec<Axis>,
    /// Columns from the channels, and what the names in them stand for.
    pub decode: Vec<(String, Formula)>,
    /// Where one of those has a value that its formula does not give.
    pub exceptions: Vec<Exception>,
    /// Whether it depends on the azimuth of the view as well, as `cos2_phi`.
    pub azimuth: bool,
    /// Largest error that the file claims.
    pub claimed: f64,
    /// Ranges of the inputs in which it claims that.
    pub domain: Vec<(String, [f64; 2])>,
}

/// The name of a table and its quantity, from its line `Table`.
///
/// Errors: no such line, in words.
pub(super) fn table(text: &str) -> Result<(&str, &str), String> {
    let line = text.lines().find_map(|line| line.trim().strip_prefix("Table "));
    let (name, of) = line
        .ok_or("it has no line `Table ...`")?
        .split_once(" of ")
        .ok_or("its line `Table` names no quantity")?;
    Ok((name, of.split(',').next().unwrap_or(of).trim()))
}

impl Statement {
    /// Reads the attribute.
    ///
    /// Errors: the line that is missing, or cannot be understood.
    pub fn parse(text: &str) -> Result<Statement, String> {
        let line = |start: &str| {
            let found = text.lines().map(str::trim).find_map(|l| l.strip_prefix(start));
            found.ok_or_else(|| format!("it has no line `{start}...`"))
        };
        let (name, quantity) = table(text)?;
        let side = [("inside", Side::Inside), ("outside", Side::Outside)];
        let side = side.iter().find(|(word, _)| name.split('-').any(|part| part == *word)).map(|s| s.1);
        // Without a shadowing form the line begins with the width.
        let lobe = line("smith: ").or_else(|_| line("alpha = "))?;
        let smith = [Smith::Correlated, Smith::Separable].into_iter().find(|s| lobe.starts_with(s.name()));
        let alpha = text.lines().flat_map(|line| line.split(';'));
        let alpha = alpha.into_iter().find_map(|part| part.trim().strip_prefix("alpha = "));
        let alpha = alpha.ok_or("it does not say what alpha is (`alpha = ...`)")?;
        let axes: Vec<Axis> = ["columns (x)", "rows (y, first row at the top)", "slices (z)"]
            .iter()
            .filter_map(|what| line(&format!("{what}: ")).ok())
            .map(axis)
            .collect::<Result<_, String>>()?;
        let (decode, exceptions) = excepted(line("decode: ")?)?;
        let claim = line("error (")?;
        let claimed = claim.split_once("max ").and_then(|(_, rest)| rest.split(',').next()?.parse().ok());
        Ok(Statement {
            quantity: quantity.to_string(),
            smith,
            side,
            alpha: Formula::parse(alpha)?,
            axes: if axes.is_empty() { return Err("it names no axes".into()) } else { axes },
            decode: definitions(decode)?,
            exceptions,
            azimuth: text.contains("cos2_phi"),
            claimed: claimed
                .filter(|x: &f64| x.is_finite())
                .ok_or("its line `error` states no largest error")?,
            domain: line("domain: ")?.split("], ").map(range).collect::<Result<_, String>>()?,
        })
    }

    /// The range of an input.
    pub fn range(&self, input: &str) -> Option<[f64; 2]> {
        self.domain.iter().find(|(name, _)| name == input).map(|(_, range)| *range)
    }
}

/// `mu in [0, 1], 64 texels, endpoint registration, u = sqrt(mu), ...`.
fn axis(text: &str) -> Result<Axis, String> {
    let odd = || format!("an axis is `{text}`");
    let (name, rest) = text.split_once(" in [").ok_or_else(odd)?;
    let (ends, rest) = rest.split_once("], ").ok_or_else(odd)?;
    let (size, rest) = rest.split_once(" texels, ").ok_or_else(odd)?;
    let (registration, coordinate) = rest.split_once(" registration, ").ok_or_else(odd)?;
    let registration =
        [Registration::Centre, Registration::Endpoint].into_iter().find(|s| s.name() == registration);
    Ok(Axis {
        name: name.to_string(),
        size: size.parse().map_err(|_| odd())?,
        registration: registration.ok_or_else(odd)?,
        range: numbers(ends).filter(|[low, high]| low < high).ok_or_else(odd)?,
        text: coordinate.to_string(),
        coordinate: definitions(coordinate)?,
    })
}

/// Most definitions of a line: tables call for six.
const DEFINITIONS: usize = 16;

/// Definitions, and the exception in brackets that may follow them.
fn excepted(text: &str) -> Result<(&str, Vec<Exception>), String> {
    let Some((rest, told)) = text.rsplit_once(" (").filter(|(_, told)| told.contains(" at ")) else {
        return Ok((text, Vec::new()));
    };
    let odd = || format!("`({told}` is no exception");
    let (what, place) = told.strip_suffix(')').and_then(|t| t.split_once(" at ")).ok_or_else(odd)?;
    let (name, value) = what.split_once(" = ").ok_or_else(odd)?;
    let (input, at) = place.split_once(' ').ok_or_else(odd)?;
    let number = |t: &str| t.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(odd);
    Ok((rest, vec![Exception { name: name.into(), value: number(value)?, at: (input.into(), number(at)?) }]))
}

/// `a = formula, b = formula`.
fn definitions(text: &str) -> Result<Vec<(String, Formula)>, String> {
    let one = |part: &str| {
        let (name, formula) = part.split_once(" = ").ok_or_else(|| format!("`{part}` is no definition"))?;
        Ok((name.trim().to_string(), Formula::parse(formula)?))
    };
    if text.split(", ").nth(DEFINITIONS).is_some() {
        return Err(format!("more than {DEFINITIONS} definitions in one line"));
    }
    text.split(", ").map(one).collect()
}

/// `mu [0.001, 1` with or without its bracket.
fn range(text: &str) -> Result<(String, [f64; 2]), String> {
    let odd = || format!("`{text}` is no range");
    let (name, ends) = text.trim().trim_end_matches(']').split_once(" [").ok_or_else(odd)?;
    let [low, high] = numbers(ends).ok_or_else(odd)?;
    // Of one value a table has no axis.
    (low <= high).then(|| (name.to_string(), [low, high])).ok_or_else(odd)
}

/// `0.001, 1`.
fn numbers(text: &str) -> Option<[f64; 2]> {
    let (low, high) = text.split_once(", ")?;
    let number = |t: &str| t.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    Some([number(low)?, number(high)?])
}
