//! Findings as JSON: numbers in nine digits at most, a line for every key, and one line for every
//! object and list that fits.

use std::io;

use serde::Serialize;
use serde_json::Value;
use serde_json::ser::{CompactFormatter, Formatter};

use super::findings::SCHEMA_VERSION;
use super::numbers::rounded;
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
    document
        .serialize(&mut serde_json::Serializer::with_formatter(&mut bytes, Lines::default()))
        .map_err(refused)?;
    // serde_json writes NaN and infinities as null, and nothing else in the findings is ever null.
    let value: Value = serde_json::from_slice(&bytes).map_err(refused)?;
    if let Some(path) = null(&value) {
        return check::finite(name, path.trim_start_matches('.'), f64::NAN).map(|()| bytes);
    }
    let mut bytes = folded(&bytes);
    bytes.push(b'\n');
    Ok(bytes)
}

/// Length of an object or list that takes one line.
const COLUMNS: usize = 220;

/// A document whose objects and lists take one line where they fit.
fn folded(text: &[u8]) -> Vec<u8> {
    let mut folded: Vec<u8> = Vec::with_capacity(text.len());
    let (mut open, mut quoted, mut escaped) = (Vec::new(), false, false);
    for &byte in text {
        folded.push(byte);
        match byte {
            _ if escaped => escaped = false,
            b'\\' if quoted => escaped = true,
            b'"' => quoted = !quoted,
            _ if quoted => {}
            b'{' | b'[' => open.push(folded.len() - 1),
            b'}' | b']' => {
                let start = open.pop().unwrap_or_default();
                let line = unbroken(&folded[start..]);
                if line.len() <= COLUMNS {
                    folded.truncate(start);
                    folded.extend(line);
                }
            }
            _ => {}
        }
    }
    folded
}

/// Without line breaks, none of which is in a string, and what indents the next line.
fn unbroken(text: &[u8]) -> Vec<u8> {
    let mut lines = text.split(|&byte| byte == b'\n');
    let first = lines.next().unwrap_or_default().to_vec();
    lines.fold(first, |mut line, next| {
        line.extend(next.trim_ascii_start());
        line
    })
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

/// Digits of a number: those that tell every f32 from its neighbours.
const DIGITS: usize = 9;

impl Formatter for Lines {
    fn write_f64<W: ?Sized + io::Write>(&mut self, writer: &mut W, value: f64) -> io::Result<()> {
        CompactFormatter.write_f64(writer, rounded(value, DIGITS))
    }

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
        writer.write_all(b":")
    }
}
