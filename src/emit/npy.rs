//! NumPy arrays, format version 1.0 (numpy.lib.format): a magic number, a Python dictionary padded
//! to 64 bytes, the texels.

use super::texels::Packed;
use crate::data::{Table, TexelFormat};

/// Magic number, and the version 1.0.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";

/// The data begin at a multiple of this.
const ALIGNMENT: usize = 64;

/// How a file holds a validated table: an array of `<f2` or `<f4` in C order, of integers `|u1` or
/// `<u2` that stand for themselves / 255 or 65535, of shape (slices,
/// rows, columns), or (rows, columns) for two axes; with a last axis of channels if there are
/// several.
pub fn packed(table: &Table) -> Packed {
    Packed {
        header: header(table),
        fields: (0, Vec::new()),
        stored: table.format,
        channels: table.channels.len(),
    }
}

/// Everything before the texels.
fn header(table: &Table) -> Vec<u8> {
    let kind = match table.format {
        TexelFormat::Unorm8 => "|u1",
        TexelFormat::Unorm16 => "<u2",
        TexelFormat::F16 => "<f2",
        TexelFormat::F32 => "<f4",
    };
    let mut shape: Vec<String> = table.axes.iter().rev().map(|axis| axis.size.to_string()).collect();
    if table.channels.len() > 1 {
        shape.push(table.channels.len().to_string());
    }
    let mut dictionary =
        format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", shape.join(", "));
    // Two bytes say how long the dictionary is: at most four numbers of 20 digits are far
    // below 65536.
    let prefix = MAGIC.len() + 2;
    let total = (prefix + dictionary.len() + 1).next_multiple_of(ALIGNMENT);
    dictionary.push_str(&" ".repeat(total - prefix - dictionary.len() - 1));
    dictionary.push('\n');
    let mut bytes = MAGIC.to_vec();
    bytes.extend((dictionary.len() as u16).to_le_bytes());
    bytes.extend(dictionary.bytes());
    bytes
}
