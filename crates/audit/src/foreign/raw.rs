//! Little-endian numbers without a header.

use super::shape::{self, Values};
use super::{ForeignError, ForeignTable, Hints, RawFormat, Spot};

/// The table of headerless bytes; singles, if the caller does not say otherwise.
pub(super) fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let format = hints.format.unwrap_or(RawFormat::F32);
    let left = bytes.len() % format.bytes();
    if left != 0 {
        let at = Spot::Byte((bytes.len() - left) as u64);
        let (name, width) = (format.name(), format.bytes());
        let message = format!(
            "the last {left} bytes are no {name} of {width}: the file is cut short, or state another format"
        );
        return Err(ForeignError::at(file, at, message));
    }
    let list = Values {
        name: String::new(),
        kind: format!("raw {}", format.name()),
        values: format.values(bytes),
        size: None,
        channels: None,
        lines: None,
        names: Vec::new(),
        step: format.step(),
    };
    Ok(vec![shape::table(file, list, hints)?])
}
