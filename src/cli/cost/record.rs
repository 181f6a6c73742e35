//! Records as files: the JSON and, of times on a graphics processor, its page beside it.

use std::path::{Path, PathBuf};

use super::super::CliError;
use super::super::output::{Outcome, files, print};
use super::{Options, device};
use crate::bake::BakeError;
use crate::report::{GpuRecord, offline_record};
use crate::store::{self, Files, Folder};
use crate::timing::{offline, record};

/// Largest record that is read, bytes.
pub const RECORD_BYTES: u64 = 16 << 20;

/// A record and its page, where it has one: the folder they lie in, and their names there.
pub struct RecordPlace {
    folder: PathBuf,
    names: [String; 2],
}

impl RecordPlace {
    /// Of the file that an option names.
    ///
    /// # Errors
    /// A name that does not end with .json.
    pub fn of(option: &str, record: &Path) -> Result<RecordPlace, CliError> {
        let shown = record.display().to_string();
        let stem = record.file_stem().and_then(|stem| stem.to_str());
        match stem {
            Some(stem) if record.extension().is_some_and(|e| e == "json") => Ok(RecordPlace {
                folder: record.parent().map(Path::to_path_buf).unwrap_or_default(),
                names: [format!("{stem}.json"), format!("{stem}.html")],
            }),
            _ => Err(CliError::Usage(format!(
                "{option} {}: a name that ends with .json is called for",
                crate::scene::escape::visible(&shown)
            ))),
        }
    }

    /// Opens the folder that they are written to.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn open(&self) -> Result<Folder, CliError> {
        Ok(Folder::open_flat(&self.folder)?)
    }

    /// Writes a record and its page, and says so unless told to be quiet.
    ///
    /// # Errors
    /// Data that is not finite, files that cannot be written.
    pub fn write(&self, folder: &mut Folder, record: &GpuRecord, quiet: bool) -> Result<(), CliError> {
        let shown = self.folder.join(&self.names[0]).display().to_string();
        let (page, figures) =
            record::page(record).map_err(|source| CliError::Record { file: shown, source })?;
        self.write_bytes(folder, figures, Some(page.into_bytes()), quiet)
    }

    /// Writes a record, with or without a page, and says so unless told to be quiet.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write_bytes(
        &self,
        folder: &mut Folder,
        record: Vec<u8>,
        page: Option<Vec<u8>>,
        quiet: bool,
    ) -> Result<(), CliError> {
        let named = self.names.iter().cloned().zip([Some(record), page]);
        let all: Files = named.filter_map(|(name, bytes)| Some((name, bytes?))).collect();
        let names = all.keys().cloned().collect::<Vec<_>>().join(", ");
        let written = folder.write(&all)?;
        if !quiet {
            print(format!("{names}: {}\n", files(&written)).as_bytes())?;
        }
        Ok(())
    }
}

/// Measures what accuracy costs offline, and writes the record.
pub(super) fn offline(options: &Options, path: &Path) -> Result<Outcome, CliError> {
    let place = RecordPlace::of("--record", path)?;
    let mut folder = place.open()?;
    let say = |text: &str| {
        if !options.quiet {
            eprintln!("{text}");
        }
    };
    let record = offline::offline(device(1), offline::MOST, say)?;
    let bytes = offline_record(&record).map_err(BakeError::from)?;
    place.write_bytes(&mut folder, bytes, None, options.quiet)?;
    Ok(Outcome::Done)
}

/// Writes the page of a record again, and the record as this version writes it.
pub(super) fn page(options: &Options, path: &Path) -> Result<Outcome, CliError> {
    if options.scene.scene.is_some() {
        let text = "--page: a record is of the scene that it names; leave the scene out, or give a name that ends with .html";
        return Err(CliError::Usage(text.into()));
    }
    let place = RecordPlace::of("--page", path)?;
    let bytes = store::read(path, RECORD_BYTES)?;
    let record = record::read(&bytes)
        .map_err(|source| CliError::Record { file: path.display().to_string(), source })?;
    let mut folder = place.open()?;
    place.write(&mut folder, &record, options.quiet)?;
    Ok(Outcome::Done)
}
