//! What the arguments of lookups are, for their comments, the manifest and the overview.

/// Most characters of a line of a comment.
const LINE: usize = 112;

/// What an argument is; none of what no lookup takes.
pub fn meaning(argument: &str) -> Option<&'static str> {
    Some(match argument {
        "place" => "the shaded point",
        "ray" => "the reflected ray, of unit length",
        "normal" => "of the surface, of unit length",
        "view" => "towards the viewer, of unit length",
        "alpha" => "the width of the lobe",
        "low" => "the lowest corner of the box",
        "high" => "its highest corner",
        "planes" => "of the proxy",
        "probe" => "where the cubemap was taken",
        "offset" => "from the probe to what the ray hits",
        "distance" => "from the shaded point to what the ray hits",
        _ => return None,
    })
}

/// All of them in one sentence.
pub fn sentence(arguments: &[String]) -> String {
    let named = |argument: &String| match meaning(argument) {
        Some(meaning) => format!("{argument} ({meaning})"),
        None => argument.clone(),
    };
    format!("Arguments: {}.", arguments.iter().map(named).collect::<Vec<_>>().join(", "))
}

/// The sentence as lines of a comment.
pub(super) fn lines(arguments: &[String]) -> Vec<String> {
    let mut lines = vec![String::new()];
    for part in sentence(arguments).split_inclusive("), ") {
        match lines.last_mut() {
            Some(line) if line.len() + part.trim_end().len() <= LINE => line.push_str(part),
            _ => lines.push(format!("  {part}")),
        }
    }
    lines.iter().map(|line| line.trim_end().to_string()).collect()
}
