//! GLSL without what the front end cannot read: functions of combined samplers, and what depends on
//! them, are blanked out, byte for byte, so that places stay where they are.

use std::collections::BTreeSet;

use super::items::{Item, eager, items};
use super::source::Source;
use crate::foreign::ForeignError;

/// A source of which parts are left out.
pub(super) struct Cut {
    items: Vec<Item>,
    /// Items that are left out.
    gone: BTreeSet<usize>,
    /// Items that the function asked for needs; empty if no function is asked for.
    needed: BTreeSet<usize>,
}

/// What the front end would make always, though GLSL makes it only where the left side asks for it.
const EAGER: &str = "write it as an if";

impl Cut {
    /// Leaves out what reads textures, and what is made of it.
    ///
    /// # Errors
    /// The function asked for reads a texture, or the right side of one of its `&&` or `||` changes
    /// variables.
    pub fn new(source: &Source, entry: Option<&str>) -> Result<Cut, ForeignError> {
        let items = items(&source.text);
        let mut cut = Cut { needed: needed(&items, entry), items, gone: BTreeSet::new() };
        for i in 0..cut.items.len() {
            if cut.items[i].reads_texture() {
                cut.gone.insert(i);
            }
        }
        cut.spread();
        let lost = |i: &&usize| cut.gone.contains(i) && Some(cut.items[**i].name.as_str()) == entry;
        if let Some(i) = cut.needed.iter().find(lost) {
            let advice = "audit the texture's own file as a table";
            return Err(source.lacking(cut.items[*i].range[0], "a function that reads a texture", advice));
        }
        let written = cut.writers();
        let changed = |i: &Item| eager(&source.text, i.range, &|name| written.contains(name));
        for i in 0..cut.items.len() {
            let item = &cut.items[i];
            let Some((at, what)) = changed(item).filter(|_| item.function && !cut.gone.contains(&i)) else {
                continue;
            };
            let only = cut.items.iter().filter(|i| i.function && i.name != "main").count() == 1;
            if cut.needed.contains(&i) || only {
                let what = format!("{what} on the right of && or ||");
                return Err(source.lacking(at, what, EAGER));
            }
            cut.gone.insert(i);
        }
        cut.spread();
        Ok(cut)
    }

    /// Leaves out the function at a byte, that the front end stumbles over; false if it is needed,
    /// or there is none.
    pub fn drop_at(&mut self, at: usize) -> bool {
        let here = |i: &usize| {
            let item = &self.items[*i];
            item.function && (item.range[0]..item.range[1]).contains(&at)
        };
        match (0..self.items.len()).find(here) {
            Some(i) if !self.needed.contains(&i) && self.gone.insert(i) => {
                self.spread();
                true
            }
            _ => false,
        }
    }

    /// Whether a function is left that is no entry point.
    pub fn holds_any(&self) -> bool {
        let plain = |i: &usize| self.items[*i].function && self.items[*i].name != "main";
        (0..self.items.len()).any(|i| plain(&i) && !self.gone.contains(&i))
    }

    /// Names of the functions left out, in order.
    pub fn left_out(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for i in &self.gone {
            let item = &self.items[*i];
            if item.function && item.name != "main" && !names.contains(&item.name) {
                names.push(item.name.clone());
            }
        }
        names
    }

    /// The text with blanks for what is left out; directives stay.
    pub fn text(&self, text: &str) -> String {
        let mut out = String::with_capacity(text.len());
        let mut from = 0;
        for i in &self.gone {
            let [start, end] = self.items[*i].range;
            out.push_str(&text[from..start]);
            let mut joined = false;
            for line in text[start..end].split_inclusive('\n') {
                let kept = joined || line.trim_start().starts_with('#');
                joined = kept && line.trim_end().ends_with('\\');
                if kept {
                    out.push_str(line);
                } else {
                    out.extend(line.bytes().map(|b| if b == b'\n' { '\n' } else { ' ' }));
                }
            }
            from = end;
        }
        out + &text[from..]
    }

    /// Leaves out all that names something left out of which no other definition stays.
    fn spread(&mut self) {
        loop {
            let here = |name: &str| {
                let same = (0..self.items.len()).filter(|i| self.items[*i].name == name);
                same.fold((false, false), |(gone, left), i| {
                    let out = self.gone.contains(&i);
                    (gone || out, left || !out)
                })
            };
            let lost: BTreeSet<String> = self.gone.iter().map(|i| self.items[*i].name.clone()).collect();
            let lost: Vec<&String> =
                lost.iter().filter(|n| !n.is_empty() && here(n) == (true, false)).collect();
            let hit =
                |i: &usize| !self.gone.contains(i) && lost.iter().any(|name| self.items[*i].names(name));
            let more: Vec<usize> = (0..self.items.len()).filter(hit).collect();
            if more.is_empty() {
                return;
            }
            self.gone.extend(more);
        }
    }

    /// Functions that write variables of others: those outside of functions, by themselves or by a
    /// call, or their caller's.
    fn writers(&self) -> BTreeSet<String> {
        let variables =
            self.items.iter().filter(|i| i.variable && !i.name.is_empty()).map(|i| i.name.clone());
        let mut found: BTreeSet<String> = variables.collect();
        loop {
            let hit = |i: &&Item| i.function && !found.contains(&i.name) && found.iter().any(|f| i.names(f));
            let more: Vec<String> = self.items.iter().filter(hit).map(|i| i.name.clone()).collect();
            if more.is_empty() {
                break;
            }
            found.extend(more);
        }
        found.extend(self.items.iter().filter(|i| i.outs).map(|i| i.name.clone()));
        found
    }
}

/// The items of a name, and those that they name.
fn needed(items: &[Item], entry: Option<&str>) -> BTreeSet<usize> {
    let named = |name: &str| (0..items.len()).filter(|i| items[*i].name == name).collect::<Vec<_>>();
    let mut open = entry.map_or(Vec::new(), named);
    let mut found = BTreeSet::new();
    while let Some(i) = open.pop() {
        if found.insert(i) {
            open.extend(items[i].words.iter().flat_map(|(_, word, _)| named(word)));
        }
    }
    found
}
