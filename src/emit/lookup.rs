//! The functions that read a table: coordinates with the remap of its registration, decoding, and
//! the lookup itself, in every [`Language`]. The arithmetic is that in which the table was
//! measured.

use super::header;
use crate::data::{Arguments, Decode, Table, TableCode, TexelFormat};
use lobefit_shade::code::{CodeError, Language, TableLookup, Texels};

/// What the functions of a table are called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableNames {
    /// The lookup: `ggx_glass_albedo_inside`.
    pub lookup: String,
    /// What the names of its coordinates (`_uv`, `_uvw`) and of its decoding (`_decode`) begin
    /// with. Tables that share them have one stem: `ggx_glass_albedo`.
    pub stem: String,
}

impl From<&str> for TableNames {
    /// Those of a table that shares nothing.
    fn from(name: &str) -> TableNames {
        TableNames { lookup: name.into(), stem: name.into() }
    }
}

/// A table with what its channels mean and what its functions are called.
#[derive(Clone, Copy, Debug)]
pub struct Readable<'a> {
    /// The table, with as many channels as its decoding reads.
    pub table: &'a Table,
    /// Meaning of the channels.
    pub decode: Decode,
    /// Names of the functions.
    pub names: &'a TableNames,
    /// How they take the width of the lobe.
    pub arguments: Arguments,
    /// What the comment of the lookup says beside what it returns.
    pub header: &'a [String],
}

impl Readable<'_> {
    /// The functions `STEM_uv` (`STEM_uvw` with slices) and `STEM_decode`, which the lookup calls.
    ///
    /// # Errors
    /// A name that the language has taken; a defect of the library of warps and decodings.
    pub fn print_parts(&self, language: Language) -> Result<String, CodeError> {
        let code = self.code()?;
        let parts = [
            (&code.coordinates, header::coordinates_line(self.table, &self.names.stem)),
            (&code.decoding, header::decoding_line(self.table, self.decode.meaning())),
        ];
        let [coordinates, decoding] = parts.map(|(name, line)| code.source().print(language, name, &[line]));
        Ok(format!("{}\n{}", coordinates?, decoding?))
    }

    /// The lookup, see [`TableLookup::print`].
    ///
    /// # Errors
    /// A defect of the library of warps and decodings.
    pub fn print_lookup(&self, language: Language) -> Result<String, CodeError> {
        Ok(self.lookup()?.print(language))
    }

    /// All three.
    ///
    /// # Errors
    /// As of the parts.
    pub fn print(&self, language: Language) -> Result<String, CodeError> {
        Ok(format!("{}\n{}", self.print_parts(language)?, self.print_lookup(language)?))
    }

    /// Arguments of the lookup in order, after texture and sampler.
    ///
    /// # Errors
    /// A defect of the library of warps and decodings.
    pub fn inputs(&self) -> Result<Vec<&'static str>, CodeError> {
        Ok(self.code()?.inputs)
    }

    fn code(&self) -> Result<TableCode, CodeError> {
        let width = (self.arguments, self.table.alpha_map);
        Ok(TableCode::new(&self.names.stem, &self.table.axes, self.decode, width)?)
    }

    fn lookup(&self) -> Result<TableLookup, CodeError> {
        let code = self.code()?;
        Ok(TableLookup {
            name: self.names.lookup.clone(),
            stem: self.names.stem.clone(),
            about: self.header.to_vec(),
            sizes: self.table.axes.iter().map(|axis| axis.size).collect(),
            channels: self.decode.channels(),
            values: self.decode.count(),
            meaning: self.decode.meaning(),
            arguments: code.inputs,
            coordinates: code.located_by,
            decoding: code.decoded_by,
            texels: match self.table.format {
                TexelFormat::F32 => Texels::Single,
                TexelFormat::Unorm16 => Texels::Norm16,
                TexelFormat::F16 | TexelFormat::Unorm8 => Texels::Common,
            },
        })
    }
}
