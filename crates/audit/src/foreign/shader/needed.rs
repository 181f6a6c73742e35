//! What a function needs of its source: the functions, constants and structures that it names, and
//! those that they name; nothing else of the file is read.

use std::collections::{BTreeMap, BTreeSet};

use super::items::{Item, Word};

/// The items of a source by name.
pub(super) struct Index<'a> {
    items: &'a [Item],
    /// Items from here on are our own, for names that the source does not declare.
    own: usize,
    named: BTreeMap<&'a str, Vec<usize>>,
}

impl<'a> Index<'a> {
    pub fn new(items: &'a [Item], own: usize) -> Index<'a> {
        let mut named: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (i, item) in items.iter().enumerate() {
            for name in &item.names {
                named.entry(name).or_default().push(i);
            }
        }
        Index { items, own, named }
    }

    /// Functions with a body of a name, of the source itself.
    pub fn functions(&self, name: &str) -> Vec<usize> {
        let all = self.named.get(name).map_or(&[][..], Vec::as_slice);
        all.iter().copied().filter(|i| *i < self.own && self.items[*i].body).collect()
    }

    /// What a word may name: overloads that take as many arguments, or what is no function.
    fn meant(&self, word: &Word) -> Vec<usize> {
        let all = self.named.get(word.text.as_str()).map_or(&[][..], Vec::as_slice);
        let declared = all.iter().any(|i| *i < self.own);
        let all = all.iter().copied().filter(|i| *i < self.own || !declared);
        let (functions, others): (Vec<usize>, Vec<usize>) = all.partition(|i| self.items[*i].function);
        let bodies: Vec<usize> = functions.into_iter().filter(|i| self.items[*i].body).collect();
        let takes = |i: &usize| word.called == Some(self.items[*i].parameters.len());
        let fitting: Vec<usize> = bodies.iter().copied().filter(takes).collect();
        let functions = match word.called {
            Some(_) if fitting.is_empty() => bodies,
            Some(_) => fitting,
            None => Vec::new(),
        };
        [others, functions].concat()
    }

    /// What an item needs, without what is left out, in the order in which it is to be declared:
    /// what is no function as it stands in the source, then functions, each after those that it
    /// calls.
    pub fn needed(&self, entry: usize, out: &BTreeSet<usize>) -> Vec<usize> {
        let mut seen = BTreeSet::from([entry]);
        let (mut functions, mut others) = (Vec::new(), BTreeSet::new());
        let children = |i: usize| -> Vec<usize> {
            self.items[i]
                .words
                .iter()
                .flat_map(|word| self.meant(word))
                .filter(|i| !out.contains(i))
                .collect()
        };
        let mut stack = vec![(entry, children(entry))];
        while let Some((i, rest)) = stack.last_mut() {
            let i = *i;
            match rest.pop() {
                Some(next) if seen.insert(next) => stack.push((next, children(next))),
                Some(_) => {}
                None => {
                    stack.pop();
                    if self.items[i].function {
                        functions.push(i);
                    } else {
                        others.insert(i);
                    }
                }
            }
        }
        others.into_iter().chain(functions).collect()
    }

    /// Functions among some that write variables of others: those outside of functions, by
    /// themselves or by a call, or their caller's.
    pub fn writers(&self, among: &[usize]) -> BTreeSet<&'a str> {
        let variables = among.iter().filter(|i| self.items[**i].variable);
        let mut found: BTreeSet<&str> =
            variables.flat_map(|i| &self.items[*i].names).map(String::as_str).collect();
        // Functions stand after those that they call.
        for item in among.iter().map(|i| &self.items[*i]).filter(|item| item.function) {
            if item.words.iter().any(|w| found.contains(w.text.as_str())) {
                found.insert(item.name());
            }
        }
        found.extend(among.iter().map(|i| &self.items[*i]).filter(|i| i.outs).map(Item::name));
        found
    }
}
