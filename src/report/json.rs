//! Findings as JSON: shortest digits that read back to the same number, objects on lines, lists of
//! numbers on one.

use std::io;

use serde::Serialize;
use serde_json::ser::Formatter;
use serde_json::{Serializer, Value};

use super::findings::SCHEMA_VERSION;
use super::{ReportError, check};

#[derive(Serialize)]
struct Document<'a, T> {
    schema_version: u32,
    #[serde(flatten)]
    data: &'a T,
}

/// The bytes of a JSON document.
///
/// # Errors
/// A number that is not finite, with its path.
pub fn document<T: Serialize>(name: &str, data: &T) -> Result<Vec<u8>, ReportError> {
    let document = Document { schema_version: SCHEMA_VERSION, data };
    let refused = |e: serde_json::Error| ReportError::Drawing { section: name.into(), reason: e.to_string() };
    let mut bytes = Vec::new();
    document.serialize(&mut Serializer::with_formatter(&mut bytes, Lines::default())).map_err(refused)?;
    // serde_json writes NaN and infinities as null, and nothing else in the findings is ever null.
    let value: Value = serde_json::from_slice(&bytes).map_err(refused)?;
    if let Some(path) = null(&value) {
        return check::finite(name, path.trim_start_matches('.'), f64::NAN).map(|()| bytes);
    }
    bytes.push(b'\n');
    Ok(bytes)
}

/// Path of the first null.
fn null(value: &Value) -> Option<String> {
    match value {
        Value::Null => Some(String::new()),
        Value::Array(list) => {
            list.iter().enumerate().find_map(|(i, v)| null(v).map(|rest| format!("[{i}]{rest}")))
        }
        Value::Object(map) => map.iter().find_map(|(k, v)| null(v).map(|rest| format!(".{k}{rest}"))),
        _ => None,
    }
}

/// Line breaks before every key and before every list or object within a list.
#[derive(Default)]
struct Lines {
    /// For every open list or object, whether it is a list.
    open: Vec<bool>,
}

impl Lines {
    fn line<W: ?Sized + io::Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.open.len()).try_for_each(|_| writer.write_all(b" "))
    }

    fn begin<W: ?Sized + io::Write>(&mut self, writer: &mut W, list: bool) -> io::Result<()> {
        if self.open.last() == Some(&true) {
            self.line(writer)?;
        }
        self.open.push(list);
        writer.write_all(if list { b"[" } else { b"{" })
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, true)
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open.pop();
        writer.write_all(b"]")
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, false)
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open.pop();
        self.line(writer)?;
        writer.write_all(b"}")
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        self.line(writer)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
