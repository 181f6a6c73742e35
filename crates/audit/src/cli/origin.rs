//! The command that makes a report again.

use super::{Options, Wanted};
use lobefit::report::Origin;

/// What made the report, of the file's bytes and the words of a command, which name every option that
/// bears on it.
pub(super) fn origin(bytes: &[u8], words: &[String]) -> Origin {
    Origin {
        scene: String::new(),
        recipe: blake3::hash(bytes).to_hex().to_string(),
        tool: env!("CARGO_PKG_VERSION").into(),
        command: words.join(" "),
        pages: Vec::new(),
    }
}

/// The command of an audit.
pub(super) fn audit(options: &Options, (quantity, column): Wanted) -> Vec<String> {
    let column = column.map_or(String::new(), |c| format!(":{}", c.name()));
    let list = |words: Vec<String>| Some(words.join(",")).filter(|w| !w.is_empty());
    let axis = |(scale, falls): &(crate::audit::Scale, bool)| {
        format!("{}{}", if *falls { "1-" } else { "" }, scale.name())
    };
    let size = |s: &super::Size| s.0.iter().map(usize::to_string).collect::<Vec<_>>().join("x");
    let given = [
        ("--as", Some(format!("{}{column}", quantity.name()))),
        ("--axes", list(options.axes.iter().map(axis).collect())),
        ("--registration", list(options.registration.iter().map(|s| s.name().into()).collect())),
        ("--smith", options.smith.map(|form| form.word.into())),
        ("--side", options.side.map(|s| s.name().into())),
        ("--meaning", list(options.meaning.clone())),
        ("--clamp", list(options.clamp.iter().map(|(input, x)| format!("{}={x}", input.name())).collect())),
        ("--encoding", options.encoding.map(|e| e.word.into())),
        ("--samples", options.samples.map(|n| n.to_string())),
        ("--points", Some(options.points).filter(|n| *n > 0).map(|n| n.to_string())),
        ("--size", options.size.as_ref().map(size)),
        ("--channels", options.channels.map(|n| n.to_string())),
        ("--raw-format", options.raw_format.map(|f| f.name().into())),
        ("--symbol", options.symbol.clone()),
        ("--layer", options.layer.clone()),
        ("--at", options.at.map(|(input, x)| format!("{}={x}", input.name()))),
    ];
    let mut words = vec!["lobefit audit".to_string(), quoted(&super::file_name(options))];
    for (option, value) in given {
        words.extend(value.map(|v| named(option, &v)));
    }
    words.extend(options.source.words());
    let range = |(of, [low, high]): &(super::Ranged, [f64; 2])| format!("{}={low}..{high}", of.name());
    words.extend(options.domain.iter().map(|d| named("--domain", &range(d))));
    words.extend(options.isa.then(|| "--isa".to_owned()));
    words.extend(options.limit.map(|l| format!("--limit {l}")));
    words
}

/// An option and its value as they are typed.
pub(super) fn named(option: &str, value: &str) -> String {
    format!("{option} {}", quoted(value))
}

/// A word as a shell takes it: in single quotes where it holds anything but letters, digits and
/// harmless signs.
pub(super) fn quoted(word: &str) -> String {
    let harmless = |c: char| c.is_alphanumeric() || "-_./:,=+%@".contains(c);
    if !word.is_empty() && word.chars().all(harmless) {
        word.into()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}
