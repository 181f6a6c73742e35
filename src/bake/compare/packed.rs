//! Tables in containers that keep texels one after another: header against header, then texel
//! against texel.

use super::image::judged;
use super::{Difference, Kind};
use crate::bake::BakedTable;
use crate::data::Table;
use crate::emit::exr::Decoded;
use crate::emit::texels::Packed;

/// How two files of a table differ; `packed` is how the recipe's holds it.
pub fn different(
    baked: &BakedTable,
    (table, packed): (&Table, &Packed),
    file: &str,
    expected: &[u8],
    found: &[u8],
) -> Difference {
    let header = header(packed, found);
    if expected.len() != found.len() {
        let length = format!("{} bytes where the recipe gives {}", found.len(), expected.len());
        let words = header.map_or(length.clone(), |(words, _)| format!("{words}; {length}"));
        return Difference::plain(file, Kind::Different, &words);
    }
    let image = |bytes: &[u8]| {
        let [width, rows, slices] = table.size();
        Decoded { width, height: rows * slices, channels: packed.channels(table, bytes) }
    };
    let mut difference = judged(baked, packed.stored, file, &image(expected), &image(found));
    if let Some((words, bears)) = header {
        difference.detail = format!("{words}; {}", difference.detail);
        // Read by another header the texels are others, however close their bytes.
        difference.max_abs = difference.max_abs.filter(|_| !bears);
    }
    difference
}

/// The first difference of what stands before the texels, and whether it bears on how they are
/// read: provenance alone does not.
fn header(packed: &Packed, found: &[u8]) -> Option<(String, bool)> {
    let at = packed.header.iter().zip(found).position(|(want, have)| want != have)?;
    let (start, fields) = &packed.fields;
    if fields.is_empty() {
        let own = found.get(..packed.header.len()).unwrap_or(found);
        let (have, want) = (dictionary(own), dictionary(&packed.header));
        return Some((format!("header `{have}` where the recipe gives `{want}`"), true));
    }
    let field = at.checked_sub(*start).map(|k| k / 4);
    Some(match field.and_then(|k| Some((k, fields.get(k)?))) {
        Some((k, (name, want))) => {
            let have = found.get(start + 4 * k..).and_then(<[u8]>::first_chunk);
            let have = have.map_or("cut short".into(), |word| u32::from_le_bytes(*word).to_string());
            (format!("header: {name} is {have} where the recipe gives {want}"), true)
        }
        None if at < *start => (format!("byte {at} is not that of such a file"), true),
        None => (format!("header: key/value data, byte {at}"), false),
    })
}

/// The text of a header that is one, without the numbers before it.
fn dictionary(header: &[u8]) -> String {
    let text = String::from_utf8_lossy(header);
    text.find('{').map_or(&*text, |start| &text[start..]).trim_end().to_string()
}
