//! The words of the options.

use crate::audit::{
    Column, ENCODINGS, Encoding, FORMS, Form, Input, REGISTRATIONS, Registration, SCALES, Scale,
};
use crate::foreign::RawFormat;
use lobefit::cli::options::quantity_column;
use lobefit::cli::word::Words;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::Quantity;

/// Texels along each axis.
#[derive(Clone)]
pub(super) struct Size(pub(super) Vec<usize>);

pub(super) fn setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("NAME=VALUE is called for")?;
    match value.parse::<f64>() {
        Ok(x) if x.is_finite() && !name.is_empty() => Ok((name.into(), x)),
        _ => Err("a name and a finite number are called for".into()),
    }
}

/// What a range is of: an input, or the roughness that alpha is made of.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Ranged {
    Input(Input),
    Roughness,
}

impl Ranged {
    pub fn name(self) -> &'static str {
        match self {
            Ranged::Input(input) => input.name(),
            Ranged::Roughness => Scale::Roughness.name(),
        }
    }
}

/// Ranges of inputs: of roughness that of alpha, by the map of the axis that is stated for it, else
/// alpha = roughness^2.
pub(super) fn domain(given: &[(Ranged, [f64; 2])], axes: &[(Scale, bool)]) -> Vec<(Input, [f64; 2])> {
    let stated = |scale: &Scale| axes.iter().any(|(own, _)| own == scale);
    let powers = [Scale::RoughnessThird, Scale::RoughnessFourth];
    let map = powers.into_iter().find(stated).unwrap_or(Scale::Roughness);
    let of_input = |(ranged, range): &(Ranged, [f64; 2])| match ranged {
        Ranged::Input(input) => (*input, *range),
        Ranged::Roughness => (map.input(), range.map(|x| map.input_at(x))),
    };
    given.iter().map(of_input).collect()
}

/// The range of an input, or of roughness.
pub(super) fn range(text: &str) -> Result<(Ranged, [f64; 2]), String> {
    let called_for = || "INPUT=LOW..HIGH is called for, as mu=0.01..1";
    let (name, range) = text.split_once('=').ok_or_else(called_for)?;
    let (low, high) = range.split_once("..").ok_or_else(called_for)?;
    let inputs = [Input::Alpha, Input::Mu, Input::Ior, Input::Anisotropy].map(Ranged::Input);
    let known = inputs.into_iter().chain([Ranged::Roughness]);
    let names = || known.clone().map(Ranged::name).collect::<Vec<_>>().join(", ");
    let ranged = known.clone().find(|ranged| ranged.name() == name);
    let ranged = ranged.ok_or_else(|| format!("no such input; they are {}", names()))?;
    match (low.parse::<f64>(), high.parse::<f64>()) {
        (Ok(low), Ok(_)) if low < 0.0 && ranged == Ranged::Roughness => {
            Err("a roughness is no negative number".into())
        }
        (Ok(low), Ok(high)) if low < high && high.is_finite() => Ok((ranged, [low, high])),
        _ => Err(called_for().into()),
    }
}

/// The clamp of an input.
pub(super) fn floor(text: &str) -> Result<(Input, f64), String> {
    let (name, value) = setting(text)?;
    let input = [Input::Alpha, Input::Mu, Input::Ior].into_iter().find(|input| input.name() == name);
    let input = input.ok_or("alpha, mu or ior is called for")?;
    if value >= 0.0 { Ok((input, value)) } else { Err("a clamp is no negative number".into()) }
}

/// The input that is the same throughout a slice.
pub(super) fn at(text: &str) -> Result<(Input, f64), String> {
    let (name, value) = setting(text)?;
    let input = [Input::Ior, Input::Anisotropy].into_iter().find(|input| input.name() == name);
    Ok((input.ok_or("ior or anisotropy is called for")?, value))
}

pub(super) fn wanted() -> Words<(&'static dyn Quantity, Option<Column>)> {
    quantity_column(|quantity, of| Ok((quantity, of.map(|c| column(quantity, c)).transpose()?)))
}

pub(super) fn column(quantity: &dyn Quantity, name: &str) -> Result<Column, String> {
    let columns = Column::of(quantity);
    let alias = match name {
        "loss" => "1-E",
        "N" => "1/E",
        "loss_avg" => "1-E_avg",
        other => other,
    };
    let alias = alias.replace("F0", "f0");
    columns.iter().copied().find(|c| c.name() == alias).ok_or_else(|| {
        let names: Vec<&str> = columns.iter().map(|c| c.name()).collect();
        format!(
            "`{name}` is nothing that a channel of {} holds; it may hold {}",
            quantity.name(),
            names.join(", ")
        )
    })
}

pub(super) fn axis(text: &str) -> Result<(Scale, bool), String> {
    let (name, reversed) = match (text, text.strip_prefix("1-")) {
        ("gloss", _) => ("roughness", true),
        (_, Some(rest)) => (rest, true),
        (name, None) => (name, false),
    };
    let name = name.replace("F0", "f0");
    if name.contains('=') {
        let (ranged, ends) = range(&name)?;
        if ends.iter().any(|end| !end.is_finite()) {
            return Err("two finite ends are called for, as ior=1.1..2.2".into());
        }
        let scale = match ranged {
            Ranged::Input(input) => Scale::between(input, ends, true),
            Ranged::Roughness => Scale::between_roughnesses(ends, true),
        };
        return Ok((scale, reversed));
    }
    let found = SCALES.into_iter().find(|s| s.name() == name).map(|s| (s, reversed));
    found.ok_or_else(|| {
        let names: Vec<&str> = SCALES.iter().map(|s| s.name()).collect();
        format!("no such coordinate; they are gloss, {}, and INPUT=LOW..HIGH", names.join(", "))
    })
}

pub(super) fn registration() -> Words<Registration> {
    Words::one_of("registration", REGISTRATIONS.map(|place| (place.name(), place)))
}

pub(super) fn form() -> Words<&'static Form> {
    Words::one_of("shadowing form", FORMS.iter().map(|form| (form.word, form)))
}

pub(super) fn encoding(text: &str) -> Result<&'static Encoding, String> {
    Encoding::find(text).ok_or_else(|| {
        let words: Vec<&str> = ENCODINGS.iter().map(|encoding| encoding.word).collect();
        format!("no such encoding; they are {}, and times=F, as times=1/pi", words.join(", "))
    })
}

pub(super) fn side() -> Words<Side> {
    Words::one_of("side", [Side::Outside, Side::Inside].map(|side| (side.name(), side)))
}

pub(super) fn size(text: &str) -> Result<Size, String> {
    let parts: Result<Vec<usize>, _> = text.split('x').map(str::parse).collect();
    match parts {
        Ok(list) if (1..=3).contains(&list.len()) && !list.contains(&0) => Ok(Size(list)),
        _ => Err("one to three whole numbers above 0 are called for, as 64x64".into()),
    }
}

pub(super) fn raw_format() -> Words<RawFormat> {
    Words::one_of("format", RawFormat::ALL.map(|format| (format.name(), format)))
}
