//! Machine code of the functions of a record.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// What a compiler made of functions in f32 for one family: the whole shader, which loads what the
/// function takes, and stores it and the result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Listings {
    /// The family, by the driver's name of it.
    pub family: String,
    /// Texts by the names of the functions; in a record a JSON object in zlib in base64.
    #[serde(rename = "packed", with = "packed")]
    pub texts: BTreeMap<String, String>,
}

mod packed {
    use std::collections::BTreeMap;

    use base64::Engine;
    use base64::engine::general_purpose::STANDARD;
    use miniz_oxide::deflate::compress_to_vec_zlib;
    use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer, ser};

    type Texts = BTreeMap<String, String>;

    /// Most bytes of machine code of a record.
    const LIMIT: usize = 8 << 20;

    pub(super) fn serialize<S: Serializer>(texts: &Texts, to: S) -> Result<S::Ok, S::Error> {
        let json = serde_json::to_vec(texts).map_err(ser::Error::custom)?;
        if json.len() > LIMIT {
            return Err(ser::Error::custom(format!("machine code of {} bytes, at most {LIMIT}", json.len())));
        }
        STANDARD.encode(compress_to_vec_zlib(&json, 10)).serialize(to)
    }

    pub(super) fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<Texts, D::Error> {
        fn refused<E: Error>(error: impl std::fmt::Display) -> E {
            E::custom(format!("listings.packed: {error}"))
        }
        let bytes = STANDARD.decode(String::deserialize(from)?).map_err(refused)?;
        let json = decompress_to_vec_zlib_with_limit(&bytes, LIMIT).map_err(refused)?;
        serde_json::from_slice(&json).map_err(refused)
    }
}
