//! The sidecar of a file that this tool wrote: `NAME.npy.json` beside `NAME.npy` says what the file
//! has no room for.

use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::Path;

use super::{Options, file_name};
use crate::foreign::{Channel, ForeignTable, Hints, RawFormat, Step};
use lobefit::data::{Container, TexelFormat};
use lobefit::emit::container::SIDECAR;
use lobefit::emit::manifest::Manifest;
use lobefit::emit::sidecar::{SCHEMA_VERSION, Sidecar};
use lobefit::store::{self, MANIFEST, StoreError};

/// Largest sidecar, bytes: those of a bake have some 4 kB.
const BYTES: u64 = 1 << 20;

/// Largest manifest, bytes.
const MANIFEST_BYTES: u64 = 16 << 20;

/// How a file names this tool, and the bytes among which it does.
const WRITER: &[u8] = b"KTXwriter\0lobefit ";
const HEADER: usize = 4096;

/// How a manifest names this tool.
const MAKER: &[u8] = b"\"tool\": \"lobefit";

/// A sidecar with its name.
pub(super) struct Beside {
    pub name: String,
    pub said: Sidecar,
}

/// The sidecar beside the file, if there is one.
///
/// # Errors
/// Why it is not followed, in words.
pub(super) fn beside(options: &Options, length: usize) -> Result<Option<Beside>, String> {
    let Some(container) = container(options) else { return Ok(None) };
    let name = format!("{}{SIDECAR}", file_name(options));
    let parsed = |bytes: Vec<u8>| serde_json::from_slice::<Sidecar>(&bytes).map_err(|e| e.to_string());
    let read = read(path(options).as_ref(), BYTES);
    let said = read.and_then(|bytes| bytes.map(parsed).transpose());
    let said = said.and_then(|said| said.map(|said| checked(said, container, length)).transpose());
    match said {
        Ok(said) => Ok(said.map(|said| Beside { name, said })),
        Err(reason) => Err(refused(options, &name, &reason)),
    }
}

/// The bytes of a file; none where it is not there.
///
/// # Errors
/// Why it is not read, in words that name no folder.
fn read(path: &Path, most: u64) -> Result<Option<Vec<u8>>, String> {
    match store::read(path, most) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(StoreError::Io { source, .. }) if source.kind() == ErrorKind::NotFound => Ok(None),
        Err(StoreError::Io { source, .. }) => Err(source.to_string()),
        Err(StoreError::TooLarge { limit, .. }) => Err(format!("it is larger than {limit} bytes")),
        Err(error) => Err(error.to_string()),
    }
}

/// The format of a file by its ending, if it is one whose files this tool writes with a sidecar.
fn container(options: &Options) -> Option<Container> {
    let extension = options.file.extension()?.to_string_lossy().to_ascii_lowercase();
    Container::ALL.into_iter().find(|c| *c != Container::Exr && c.name() == extension)
}

fn path(options: &Options) -> OsString {
    let mut path = options.file.clone().into_os_string();
    path.push(SIDECAR);
    path
}

/// What to say of a file that is not understood: why its sidecar is not followed; or that the sidecar is not
/// there, where the header of a KTX2 file or a manifest says that this tool wrote the file.
pub(super) fn lacking(options: &Options, bytes: &[u8]) -> Option<String> {
    match beside(options, bytes.len()) {
        Err(refused) => return Some(refused),
        Ok(beside) if beside.is_some() || container(options).is_none() => return None,
        Ok(_) => (),
    }
    let file = file_name(options);
    let listed = if holds(&bytes[..bytes.len().min(HEADER)], WRITER) { Ok(true) } else { is_listed(options) };
    listed.map_or_else(Some, |listed| {
        listed.then(|| {
            format!(
                "its sidecar {file}{SIDECAR} is missing: a table of lobefit is read as what the sidecar beside it says"
            )
        })
    })
}

fn holds(bytes: &[u8], words: &[u8]) -> bool {
    bytes.windows(words.len()).any(|part| part == words)
}

/// Whether a manifest in the file's folder or in the one above lists a table's file of its name.
///
/// # Errors
/// Why a manifest is not understood that may be one of this tool's, in words.
fn is_listed(options: &Options) -> Result<bool, String> {
    let folder = options.file.parent().unwrap_or(Path::new(""));
    let mut odd = None;
    for name in [MANIFEST.to_string(), format!("../{MANIFEST}")] {
        let file = file_name(options);
        let unread = |why: String| {
            format!("{name}: not read ({}); whether it lists {file} is not known", why.escape_debug())
        };
        let manifest = match read(&folder.join(&name), MANIFEST_BYTES) {
            Ok(Some(bytes)) => Manifest::read(&bytes).map_err(|e| (e, bytes)),
            Ok(None) => continue,
            Err(why) => {
                odd = odd.or(Some(unread(why)));
                continue;
            }
        };
        match manifest {
            Ok(manifest) => {
                let mut files = manifest.entries.tables.into_iter().flat_map(|table| table.files);
                if files.any(|file| Path::new(&file).file_name() == options.file.file_name()) {
                    return Ok(true);
                }
            }
            // It is another's, unless it names this tool or is cut short before.
            Err((error, bytes)) if !error.is_eof() && !holds(&bytes, MAKER) => (),
            Err((error, _)) => odd = odd.or(Some(unread(error.to_string()))),
        }
    }
    odd.map_or(Ok(false), Err)
}

/// Why a sidecar is not followed.
pub(super) fn refused(options: &Options, name: &str, reason: &str) -> String {
    let file = file_name(options);
    format!("{name}: not followed ({}); {file} is read without it", reason.escape_debug())
}

/// A sidecar that is of such a file, of that length.
fn checked(said: Sidecar, container: Container, length: usize) -> Result<Sidecar, String> {
    let Sidecar { schema_version, size, channels, padding_channels, stored, offset, axes, .. } = &said;
    if *schema_version != SCHEMA_VERSION {
        return Err(format!("it is of version {schema_version}, {SCHEMA_VERSION} is read"));
    }
    if said.container != container {
        return Err(format!("it is that of a file of {}", said.container.name()));
    }
    let none = axes.is_empty() || channels.is_empty();
    if none || size.get(axes.len()..).is_none_or(|rest| rest.iter().any(|n| *n != 1)) {
        return Err(format!("it names {} axes and {} channels", axes.len(), channels.len()));
    }
    let numbers = channels.len().checked_add(*padding_channels);
    let mut sizes = size.iter().copied().chain([stored.bytes() as usize]);
    let texels = numbers.and_then(|n| sizes.try_fold(n, usize::checked_mul));
    match texels.and_then(|bytes| bytes.checked_add(*offset)) {
        Some(bytes) if bytes == length => Ok(said),
        Some(bytes) if bytes > length => {
            Err(format!("it speaks of {bytes} bytes, and the file ends after {length}: it may be cut short"))
        }
        _ => Err(format!("it does not speak of the {length} bytes that the file has")),
    }
}

impl Beside {
    /// What a file without a header is read by, and integers in one with a header; an option has the last
    /// word.
    pub fn hints(&self, given: Hints) -> Hints {
        let format = match self.said.stored {
            TexelFormat::Unorm8 => RawFormat::Unorm8,
            TexelFormat::Unorm16 => RawFormat::Unorm16,
            TexelFormat::F16 => RawFormat::F16,
            TexelFormat::F32 => RawFormat::F32,
        };
        let given = Hints { format: given.format.or(Some(format)), ..given };
        if self.said.container != Container::Raw {
            return given;
        }
        Hints {
            size: given.size.or(Some(self.size())),
            channels: given.channels.or(Some(self.said.channels.len())),
            ..given
        }
    }

    fn size(&self) -> Vec<usize> {
        self.said.size[..self.said.axes.len()].to_vec()
    }

    /// The table as its sidecar has it: channels by their names, those of padding left out.
    ///
    /// # Errors
    /// Another size than the file's own header states, in words.
    pub fn named(&self, table: &ForeignTable) -> Result<ForeignTable, String> {
        let (own, stored) = (table.channels.len(), self.said.channels.len() + self.said.padding_channels);
        let size = self.size();
        let texels: usize = size.iter().product();
        // An array's last index may be x or the channel; its length alone does not tell.
        let regrouped = self.said.container == Container::Npy && own * table.texels() == texels * stored;
        if (table.size != size || own != stored) && !regrouped {
            return Err(format!(
                "it speaks of {size:?} texels of {stored} channels, the file holds {:?} of {own}",
                table.size
            ));
        }
        let value = |i: usize| table.channels[i % own].values[i / own];
        let named = |(c, name): (usize, &String)| Channel {
            name: name.clone(),
            values: (0..texels).map(|t| value(t * stored + c)).collect::<Vec<_>>().into(),
        };
        let step = match self.said.format {
            TexelFormat::Unorm8 => Step::Unorm(8),
            TexelFormat::Unorm16 => Step::Unorm(16),
            TexelFormat::F16 => Step::Half,
            TexelFormat::F32 => Step::None,
        };
        Ok(ForeignTable {
            channels: self.said.channels.iter().enumerate().map(named).collect(),
            size,
            step,
            note: self.said.header.join("\n"),
            ..table.clone()
        })
    }
}
