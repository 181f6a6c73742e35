//! The functions that read a table: coordinates with the remap of its registration, decoding, and
//! the lookup itself, in every [`Language`]. The arithmetic is that in which the table was
//! measured.

use crate::data::{ARGUMENTS, Decode, Table, TableCode, TexelFormat};
use lobefit_shade::code::{CodeError, Language, TableLookup};

/// A table with what its channels mean.
#[derive(Clone, Copy, Debug)]
pub struct Readable<'a> {
    /// The table, with as many channels as its decoding reads.
    pub table: &'a Table,
    /// Meaning of the channels.
    pub decode: Decode,
    /// Header lines.
    pub header: &'a [String],
}

impl Readable<'_> {
    /// The table's name as an identifier.
    pub fn identifier(&self) -> String {
        self.table.name.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
    }

    /// The functions `<name>_uv` (`<name>_uvw` with slices), `<name>_decode` and `<name>_lookup`,
    /// see [`TableLookup::print`].
    ///
    /// # Errors
    /// A name that the language has taken; a defect of the library of warps and decodings.
    pub fn print(&self, language: Language) -> Result<String, CodeError> {
        let (code, lookup) = (self.code()?, self.lookup()?);
        let coordinates = code.source().print(language, &code.coordinates, self.header)?;
        let what = format!("{} from a texel of the table above.", lookup.meaning);
        let decoding = code.source().print(language, &code.decoding, &[what])?;
        Ok(format!("{coordinates}\n{decoding}\n{}", lookup.print(language)))
    }

    /// Arguments of `<name>_lookup` in order.
    ///
    /// # Errors
    /// A defect of the library of warps and decodings.
    pub fn arguments(&self) -> Result<Vec<&'static str>, CodeError> {
        Ok(self.lookup()?.arguments)
    }

    /// The functions of a table of three axes have the arguments that they read; those of a table
    /// of two have `roughness`, `alpha` and `mu` whether they use them or not, so that one layout
    /// can stand in for another.
    fn code(&self) -> Result<TableCode, CodeError> {
        let habitual: [&[&str]; 2] =
            if self.table.axes.len() == 2 { [&ARGUMENTS[..3], &["mu"]] } else { [&[], &[]] };
        Ok(TableCode::new(&self.identifier(), &self.table.axes, self.decode, habitual)?)
    }

    fn lookup(&self) -> Result<TableLookup, CodeError> {
        let [coordinates, decoding] = self.code()?.arguments()?;
        let values = self.decode.count();
        let used = |name: &&str| coordinates.contains(name) || decoding.contains(name);
        Ok(TableLookup {
            name: self.identifier(),
            sizes: self.table.axes.iter().map(|axis| axis.size).collect(),
            channels: self.decode.channels(),
            values,
            meaning: if values == 1 { "E" } else { "E, A and B" },
            arguments: ARGUMENTS.into_iter().filter(used).collect(),
            coordinates,
            decoding,
            is_wide: self.table.format == TexelFormat::F32,
        })
    }
}
