//! The text of a MaterialX document to its elements, within bounds that its parser does not have.

use lobefit_strict::limits::DEPTH;
use lobefit_strict::{Position, SceneError, plain, refused};
use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::limits::{XML_ATTRIBUTES, XML_NAMESPACES, XML_NODES};

/// The elements of a file. No entity is expanded and no other file is opened.
pub(super) fn parse<'b>(bytes: &'b [u8], file: &str) -> Result<Document<'b>, SceneError> {
    let text = plain(bytes, file, "; a MaterialX document begins with `<materialx`")?;
    bounded(bytes).map_err(|(at, message)| refused(bytes, file, at, message))?;
    let options = ParsingOptions { allow_dtd: false, nodes_limit: XML_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| {
        let at = error.pos();
        let at = Position { line: at.row as usize, column: at.col as usize };
        let text = error.to_string();
        let place = format!(" at {}:{}", at.line, at.column);
        let message = match error {
            Error::DtdDetected => {
                "a document type declaration: its entities are not expanded; delete it".into()
            }
            Error::NodesLimitReached => too_many(),
            _ => text.strip_suffix(&place).unwrap_or(&text).into(),
        };
        SceneError::Field { file: file.into(), at, path: String::new(), message }
    })
}

fn too_many() -> String {
    format!("more than {XML_NODES} elements and texts")
}

/// Follows tags only: how many elements and comments there are, how deep elements stand in one another,
/// how many attributes each has, and how many namespaces are declared. A parser reserves room for these,
/// compares and copies them.
fn bounded(bytes: &[u8]) -> Result<(), (usize, String)> {
    let (mut at, mut depth, mut namespaces, mut nodes) = (0, 0_usize, 0, 0);
    while let Some(start) = find(bytes, at, b"<") {
        nodes += u32::from(!bytes[start..].starts_with(b"</"));
        if nodes > XML_NODES {
            return Err((start, too_many()));
        }
        let skip = |open: &[u8], close: &[u8]| {
            let inner = bytes[start..].starts_with(open).then_some(start + open.len())?;
            Some(find(bytes, inner, close).map_or(bytes.len(), |end| end + close.len()))
        };
        let other =
            skip(b"<!--", b"-->").or_else(|| skip(b"<![CDATA[", b"]]>")).or_else(|| skip(b"<?", b"?>"));
        if let Some(end) = other {
            at = end;
            continue;
        }
        let (end, attributes) = tag(bytes, start);
        namespaces += find_all(&bytes[start..end], b"xmlns");
        if attributes > XML_ATTRIBUTES {
            return Err((start, format!("an element with more than {XML_ATTRIBUTES} attributes")));
        }
        if namespaces > XML_NAMESPACES {
            return Err((start, format!("more than {XML_NAMESPACES} namespaces")));
        }
        if bytes[start..].starts_with(b"</") {
            depth = depth.saturating_sub(1);
        } else if !bytes[..end].ends_with(b"/>") {
            depth += 1;
        }
        if depth > DEPTH {
            return Err((start, format!("nested deeper than {DEPTH} levels")));
        }
        at = end;
    }
    Ok(())
}

/// The end of the tag that begins at `start`, and its attributes.
fn tag(bytes: &[u8], start: usize) -> (usize, usize) {
    let (mut quote, mut attributes) = (None, 0);
    for (i, &byte) in bytes.iter().enumerate().skip(start + 1) {
        match (quote, byte) {
            (None, b'>') => return (i + 1, attributes),
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => attributes += 1,
            (Some(open), byte) if open == byte => quote = None,
            _ => {}
        }
    }
    (bytes.len(), attributes)
}

fn find(bytes: &[u8], from: usize, what: &[u8]) -> Option<usize> {
    let rest = bytes.get(from..)?;
    rest.windows(what.len()).position(|window| window == what).map(|at| from + at)
}

fn find_all(bytes: &[u8], what: &[u8]) -> usize {
    bytes.windows(what.len()).filter(|window| *window == what).count()
}

/// What is said of a field of an element.
pub(super) fn wrong(node: Node, file: &str, path: String, message: String) -> SceneError {
    let at = node.document().text_pos_at(node.range().start);
    let at = Position { line: at.row as usize, column: at.col as usize };
    SceneError::Field { file: file.into(), at, path, message }
}
