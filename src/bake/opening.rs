//! What the include files say first of all: of the effects that they hold, and of no others.

use crate::effects::context::Context;
use crate::effects::{Note, PATH_TRACER, Part};
use crate::emit::manifest::{Entries, TableEntry};

/// The lines, of the parts that a bake has.
pub(super) fn opening(parts: &[Part], context: &Context) -> Vec<String> {
    let names: Vec<&str> = parts.iter().map(|part| part.by.name()).collect();
    let mut out = vec![String::new(), format!("Effects: {}", names.join(", "))];
    for part in parts {
        let lobe = (part.by.profile().lobe)(context.scene);
        let Entries { tables, fits, .. } = &part.entries;
        let is_own = |table: &TableEntry| table.function.starts_with(PATH_TRACER);
        let all_own = fits.is_empty() && !tables.is_empty() && tables.iter().all(is_own);
        if !all_own && !out.contains(&lobe) {
            out.push(lobe);
        }
    }
    if parts.iter().any(|part| part.finding.ranges.contains_key("mu")) {
        out.push("Inputs: alpha is the width of the lobe, roughness the parameter it is made from, n_dot_v (mu) the cosine between".into());
        out.push("normal and view. Errors are measured over the domains that the functions state. Pass max(n_dot_v, 1e-4): a negative".into());
        out.push("cosine may meet a pole, and with roughness 0 a cosine of 0 makes 0/0, a NaN.".into());
    } else if parts.iter().any(|part| !part.finding.ranges.is_empty()) {
        out.push("Inputs: alpha is the width of the lobe, roughness the parameter it is made from.".into());
    }
    out.push("A function of numbers with a NaN among them returns a NaN, or where its min and max drop the NaN a finite number.".into());
    let mut known: Vec<Note> = Vec::new();
    for note in parts.iter().flat_map(|part| part.by.profile().notes) {
        if !known.contains(note) {
            known.push(*note);
        }
    }
    let holds = |text: &&str| parts.iter().flat_map(|p| p.code.values()).any(|code| code.contains(*text));
    let said = known.iter().filter(|(of, _)| of.iter().any(&holds));
    out.extend(said.flat_map(|(_, lines)| lines.iter().map(ToString::to_string)));
    out.push("Operations: add, mul, fma, min, max, compare, select 1; rcp, sqrt, exp2 4; division rcp + mul; exp 5, pow 9;".into());
    out.push("sin, cos, log2 4; log 5. alpha and roughness count as given.".into());
    out
}
