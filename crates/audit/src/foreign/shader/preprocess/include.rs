//! Where files that a shader includes may lie: in its own folder and inside those that are named, and
//! nowhere else.

use std::fs;
use std::path::{Path, PathBuf};

use crate::foreign::{ForeignError, limits};
use lobefit::store;

/// What stands around a shader file: macros, and files that it may include.
#[derive(Clone, Debug, Default)]
pub struct Surroundings {
    /// `NAME` or `NAME=VALUE`, as on a compiler's command line.
    pub defines: Vec<String>,
    /// Folders that hold include files, and files that stand before the source.
    pub includes: Vec<PathBuf>,
}

/// A module of WGSL: its path, by its own directive or by its file's name.
struct Module {
    path: Vec<String>,
    file: PathBuf,
}

/// The folders, as they lie.
pub(super) struct Folders {
    roots: Vec<PathBuf>,
    modules: Vec<Module>,
}

/// Extensions of modules.
const MODULES: [&str; 2] = ["wgsl", "wesl"];

impl Folders {
    /// The folders, and the files that stand before the source, in order; with the modules in them,
    /// if the source has imports.
    ///
    /// # Errors
    /// A folder or file that is not there; more files than are looked at.
    pub fn open(around: &Surroundings, modules: bool) -> Result<(Folders, Vec<PathBuf>), ForeignError> {
        let (mut roots, mut before) = (Vec::new(), Vec::new());
        for path in &around.includes {
            let real = fs::canonicalize(path)
                .map_err(|e| ForeignError::new("--include", format!("{}: {e}", path.display())))?;
            if real.is_dir() { roots.push(real) } else { before.push(real) }
        }
        let mut folders = Folders { roots, modules: Vec::new() };
        if modules {
            for root in folders.roots.clone() {
                let mut open = vec![(root.clone(), 0)];
                while let Some((folder, depth)) = open.pop() {
                    folders.look(&root, &folder, depth, &mut open)?;
                }
            }
            folders.modules.sort_by(|a, b| a.file.cmp(&b.file));
        }
        Ok((folders, before))
    }

    /// The same with the folder of the source, after those that are named.
    pub fn beside(mut self, source: Option<&Path>) -> Folders {
        let real = source.and_then(|source| fs::canonicalize(source).ok());
        self.roots.extend(real.as_deref().and_then(Path::parent).map(Path::to_path_buf));
        self
    }

    /// Takes note of the modules in a folder, and of the folders in it.
    fn look(
        &mut self,
        root: &Path,
        folder: &Path,
        depth: usize,
        open: &mut Vec<(PathBuf, usize)>,
    ) -> Result<(), ForeignError> {
        let named = |e: std::io::Error| ForeignError::new("--include", format!("{}: {e}", folder.display()));
        for entry in fs::read_dir(folder).map_err(named)? {
            let entry = entry.map_err(named)?;
            let (kind, path) = (entry.file_type().map_err(named)?, entry.path());
            let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
            if kind.is_dir() && depth < limits::INCLUDE_DEPTH {
                open.push((path, depth + 1));
            } else if kind.is_file() && extension.is_some_and(|e| MODULES.contains(&e.as_str())) {
                if self.modules.len() == limits::MODULES {
                    let what = format!("{}: modules in it and below", root.display());
                    return Err(ForeignError::too_large("--include", &what, "more", limits::MODULES));
                }
                let declared = read(&path).ok().and_then(|text| declared(&text));
                self.modules
                    .push(Module { path: declared.unwrap_or_else(|| by_name(root, &path)), file: path });
            }
        }
        Ok(())
    }

    /// The file of an `#include`: beside the file that includes it, if it is quoted, else in the
    /// folders; a name without an extension may leave out that of the file.
    pub fn find(&self, name: &str, quoted: bool, beside: Option<&Path>) -> Option<PathBuf> {
        let own = beside.filter(|_| quoted).and_then(Path::parent);
        let bare = !name.rsplit('/').next().unwrap_or(name).contains('.');
        let endings = beside.and_then(Path::file_name).map(|n| n.to_string_lossy().into_owned());
        let ending = endings.as_deref().and_then(|n| n.find('.').map(|at| &n[at..])).filter(|_| bare);
        let folders = own.into_iter().chain(self.roots.iter().map(PathBuf::as_path));
        folders
            .flat_map(|folder| {
                let ended = ending.map(|ending| folder.join(format!("{name}{ending}")));
                [Some(folder.join(name)), ended].into_iter().flatten()
            })
            .filter_map(|path| fs::canonicalize(path).ok())
            .find(|path| path.is_file() && self.roots.iter().any(|root| path.starts_with(root)))
    }

    /// The module whose path an import begins with; the longest is meant. Names that only lead to
    /// the package are left out.
    pub fn module(&self, import: &[String]) -> Option<PathBuf> {
        let lead = import.iter().take_while(|n| matches!(n.as_str(), "package" | "super" | "self")).count();
        (lead + 1..=import.len()).rev().find_map(|end| {
            let wanted = &import[lead..end];
            let mut found = self.modules.iter().filter(|m| m.path.ends_with(wanted));
            let best = found.next()?;
            // A path that two modules end in is of the one that it is whole.
            let best = found.fold(best, |best, m| if m.path.len() < best.path.len() { m } else { best });
            Some(best.file.clone())
        })
    }
}

/// The text of a file.
pub(super) fn read(path: &Path) -> Result<String, String> {
    let bytes = store::read(path, limits::SHADER as u64).map_err(|e| e.to_string())?;
    let text = String::from_utf8(bytes).map_err(|_| "it is not UTF-8")?;
    Ok(script(&path.to_string_lossy(), &text))
}

/// The path that a module of naga_oil declares.
fn declared(text: &str) -> Option<Vec<String>> {
    let line = text.lines().find_map(|l| l.trim_start().strip_prefix("#define_import_path"))?;
    Some(line.split_whitespace().next()?.split("::").map(String::from).collect())
}

/// The path that a file's place gives its module: folders and name, without `src`.
fn by_name(root: &Path, file: &Path) -> Vec<String> {
    let inside = file.strip_prefix(root).unwrap_or(file).with_extension("");
    let all = root.file_name().into_iter().chain(inside.iter());
    all.map(|n| n.to_string_lossy().into_owned()).filter(|n| n != "src").collect()
}

/// The text of templates in a script, as libraries keep their shaders, byte for byte; other files
/// as they are.
pub(in crate::foreign::shader) fn script(file: &str, text: &str) -> String {
    if ![".js", ".mjs", ".ts"].iter().any(|end| file.ends_with(end)) || !text.contains('`') {
        return text.to_string();
    }
    let mut inside = false;
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        inside ^= c == '`';
        if c == '\n' || inside && c != '`' {
            out.push(c);
        } else {
            out.extend(std::iter::repeat_n(' ', c.len_utf8()));
        }
    }
    out
}
