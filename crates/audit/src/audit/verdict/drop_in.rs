//! The table of this program to put in the place of one that is to be made again.

use crate::audit::{Audit, Column, Fit, Form, Input};
use lobefit_truth::quantity::find;

/// Texels a side beyond which a table gains nothing in halves.
const LARGEST: usize = 128;

/// The scene that bakes it, for a table of two axes of a lobe that scenes have.
pub(super) fn drop_in(audit: &Audit) -> Option<String> {
    let [mut x, mut y] = audit.size[..] else { return None };
    // What fits nothing is of no lobe, unless one is said, and has the usual axes.
    let is_known = audit.fit != Fit::None;
    if is_known && audit.best().axes[0].scale.input() != Input::Mu {
        (x, y) = (y, x);
    }
    let [x, y] = [x, y].map(|side| side.clamp(2, LARGEST));
    let form = match audit.form.or(is_known.then_some(audit.best().lobe.form)) {
        Some(form) => form,
        None => Form::of(find(audit.quantity)?)[0],
    };
    let held: Vec<Column> = audit.channels.iter().filter_map(|c| c.column).collect();
    let table = format!(r#""layout": "plain", "size": [{x}, {y}]"#);
    let (fields, material) = match (audit.quantity, form.smith) {
        ("ggx-reflection", Some(smith)) => {
            let smith = format!(r#""smith": "{}", "#, smith.name());
            let (kind, serves) = match held[..] {
                [Column::E] => (r#""kind": "metal", "f0": 1"#, ""),
                [Column::A, Column::B] | [Column::B, Column::A] => {
                    (r#""kind": "dielectric", "f0": 0.04"#, r#""serves": "split-sum", "#)
                }
                _ => return None,
            };
            let wants =
                format!(r#"{kind}, "roughness": [0, 1], "wants": {{ "tables": [{{ {serves}{table} }}] }}"#);
            (smith, wants)
        }
        ("sheen-charlie", _) if form.word == "neubelt" && held == [Column::E] => {
            let sheen =
                format!(r#"{{ "roughness": [0.1, 1], "tables": [{{ {table}, "n_dot_v": [0.05, 1] }}] }}"#);
            (String::new(), format!(r#""kind": "dielectric", "f0": 0.04, "roughness": 1, "sheen": {sheen}"#))
        }
        _ => return None,
    };
    Some(format!(
        "or bake one of {x} x {y} in its place, n_dot_v along x and roughness along y: lobefit bake of the scene \
         {{ \"schema_version\": 1, {fields}\"materials\": [{{ \"name\": \"m\", {material} }}] }}"
    ))
}
