//! The only module that touches the file system: bounded reads, atomic writes, sets of files whose
//! manifest is written last.
//!
//! A file is written as a temporary file beside its destination, synchronised, renamed over it, and
//! the folder is synchronised: at every moment the destination holds its old bytes or its new ones.
//! Of a set, every temporary file is on the disk before the first is renamed, so that a disk that
//! is full tears no set. The operations go through the trait [`Disk`], so that tests can let each
//! of them fail.

mod beside;
mod bundle;
mod cache;
mod commit;
mod disk;
mod error;
mod key;
mod listed;
mod local;
mod read;
mod write;

pub use beside::{beside, read_part};
pub use bundle::{Files, Folder, Layout, MANIFEST, SUBFOLDERS, Written, inside};
pub use cache::{Cache, Held, VARIABLE as CACHE_VARIABLE};
pub use disk::{Disk, Kind, TEMP_SUFFIX, Temp};
pub use error::{Operation, StoreError};
pub use key::Key;
pub use local::{LocalDisk, LocalTemp};
pub use read::{Entry, is_folder, list, read, read_beginning, read_set, read_stream};
pub use write::{free, temporary, write};
