//! A hash of source files: their paths below a root, and their bytes. It depends neither on the
//! host, nor on where the root lies, nor on the order in which a file system lists a folder.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// The folder of formulas, which are data to the code.
pub const FORMULAS: &str = "fits/hypotheses";

/// What a package consists of beside the packages of the workspace that it depends on.
const OWN: [&str; 6] = ["Cargo.lock", "Cargo.toml", "build", FORMULAS, "reports/gpu/nvidia-h200.json", "src"];

/// The files and folders that the package in a folder is built from. Of the packages that its
/// `[dependencies]` name `lobefit-NAME`, these are the folders `crates/NAME`: what depends on this
/// package is no part of it.
pub fn places(root: &Path) -> io::Result<Vec<String>> {
    let manifest = std::fs::read_to_string(root.join("Cargo.toml"))?;
    let dependencies = manifest.lines().skip_while(|line| *line != "[dependencies]").skip(1);
    let dependencies = dependencies.take_while(|line| !line.starts_with('['));
    let crates = dependencies.filter_map(|line| line.strip_prefix("lobefit-"));
    let crates = crates.filter_map(|line| line.split(['.', ' ', '=']).next());
    Ok(OWN.into_iter().map(String::from).chain(crates.map(|name| format!("crates/{name}"))).collect())
}

/// The hash of every file at and below places in a folder, as hexadecimal digits; of a file what
/// `part` takes of its bytes.
pub fn hash(root: &Path, places: &[String], part: impl Fn(Vec<u8>) -> Vec<u8>) -> io::Result<String> {
    let mut files = BTreeMap::new();
    for place in places {
        collect(root, place, &mut files)?;
    }
    let mut hash = Fnv::default();
    for (path, bytes) in files {
        hash.add(path.as_bytes());
        hash.add(&part(bytes));
    }
    Ok(format!("{:032x}", hash.0))
}

/// Reads the files at and below a place.
fn collect(root: &Path, place: &str, files: &mut BTreeMap<String, Vec<u8>>) -> io::Result<()> {
    let path = root.join(place);
    if !path.is_dir() {
        files.insert(place.into(), std::fs::read(path)?);
        return Ok(());
    }
    for entry in std::fs::read_dir(path)? {
        let name = entry?.file_name();
        let name = name.to_str().ok_or_else(|| io::Error::other(format!("{place}: a name is not UTF-8")))?;
        collect(root, &format!("{place}/{name}"), files)?;
    }
    Ok(())
}

/// FNV-1a of 128 bits (draft-eastlake-fnv): enough against accidents, and no dependency of a build
/// script.
struct Fnv(u128);

impl Default for Fnv {
    fn default() -> Fnv {
        Fnv(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Fnv {
    /// Adds a text after its length, so that no two lists of texts run into each other.
    fn add(&mut self, text: &[u8]) {
        const PRIME: u128 = (1 << 88) + 0x13b;
        for &byte in (text.len() as u64).to_le_bytes().iter().chain(text) {
            self.0 = (self.0 ^ u128::from(byte)).wrapping_mul(PRIME);
        }
    }
}

/// The lines of a source that are code: comments, blank lines and indentation are none.
#[allow(dead_code, reason = "the packages of studies call it")]
pub fn code(bytes: Vec<u8>) -> Vec<u8> {
    let text = String::from_utf8_lossy(&bytes);
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
    lines.flat_map(|line| [line.as_bytes(), b"\n"].concat()).collect()
}
