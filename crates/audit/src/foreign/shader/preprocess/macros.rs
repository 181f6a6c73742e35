//! Macros and their expansion, by the algorithm of Prosser that the C standard follows: a name is
//! hidden in what its own macro made.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::Bad;
use super::lex::{Kind, Token};
use crate::foreign::limits;

/// A macro.
#[derive(Clone, Debug)]
pub(super) struct Macro {
    /// Names of its arguments, if it has a bracket of them.
    parameters: Option<Vec<String>>,
    body: Vec<Token>,
}

/// The macros by name, and how many tokens they may still make.
pub(super) struct Macros {
    pub known: BTreeMap<String, Macro>,
    left: usize,
}

/// What stands for all the arguments from here on.
const REST: &str = "__VA_ARGS__";

/// A token with the macros that it is hidden from.
#[derive(Clone)]
struct Live {
    token: Token,
    hidden: Rc<BTreeSet<String>>,
}

impl Macros {
    pub fn new() -> Macros {
        Macros { known: BTreeMap::new(), left: limits::MACRO_TOKENS }
    }

    /// Defines a macro by what follows `#define`; false if no name follows.
    pub fn define(&mut self, line: &[Token]) -> bool {
        let Some(first) = line.iter().position(|t| t.kind != Kind::Blank) else { return false };
        if line[first].kind != Kind::Name {
            return false;
        }
        let rest = &line[first + 1..];
        let (parameters, body) = match rest.first() {
            Some(open) if open.is("(") => {
                let Some(end) = rest.iter().position(|t| t.is(")")) else { return false };
                let dots = rest[1..end].iter().any(|t| t.is("."));
                let names = rest[1..end].iter().filter(|t| t.kind == Kind::Name).map(|t| t.text.clone());
                let names = names.chain(dots.then(|| REST.to_string()));
                (Some(names.collect()), &rest[end + 1..])
            }
            _ => (None, rest),
        };
        let blank = |t: &&Token| t.kind == Kind::Blank;
        let (lead, trail) =
            (body.iter().take_while(blank).count(), body.iter().rev().take_while(blank).count());
        let body = if lead == body.len() { Vec::new() } else { body[lead..body.len() - trail].to_vec() };
        self.known.insert(line[first].text.clone(), Macro { parameters, body });
        true
    }

    /// The tokens with all macros expanded.
    pub fn expand(&mut self, tokens: Vec<Token>) -> Result<Vec<Token>, Bad> {
        let hidden = Rc::new(BTreeSet::new());
        let live = tokens.into_iter().map(|token| Live { token, hidden: Rc::clone(&hidden) });
        Ok(self.live(live.collect(), 0)?.into_iter().map(|live| live.token).collect())
    }

    fn live(&mut self, tokens: Vec<Live>, depth: usize) -> Result<Vec<Live>, Bad> {
        let mut stack: Vec<Live> = tokens.into_iter().rev().collect();
        let mut out = Vec::with_capacity(stack.len());
        while let Some(live) = stack.pop() {
            let name = &live.token.text;
            let found = match live.token.kind {
                Kind::Name if !live.hidden.contains(name) => self.known.get(name).cloned(),
                _ => None,
            };
            let Some(found) = found else {
                out.push(live);
                continue;
            };
            if depth > limits::DEPTH {
                return Err(bad(&live.token, "macros inside one another are deeper than the limit"));
            }
            let (body, hidden) = match &found.parameters {
                None => (self.filled(&found, &[], &live.token, depth)?, (*live.hidden).clone()),
                Some(parameters) => {
                    let next = stack.iter().rev().find(|l| l.token.kind != Kind::Blank);
                    if !next.is_some_and(|l| l.token.is("(")) {
                        out.push(live);
                        continue;
                    }
                    let Some((arguments, close)) = arguments(&mut stack, parameters) else {
                        return Err(bad(&live.token, "the bracket of its arguments is not closed"));
                    };
                    if arguments.len() != parameters.len() {
                        let (is, wanted) = (arguments.len(), parameters.len());
                        return Err(bad(&live.token, &format!("{is} arguments, where it has {wanted}")));
                    }
                    let both = live.hidden.intersection(&close).cloned().collect();
                    (self.filled(&found, &arguments, &live.token, depth)?, both)
                }
            };
            self.spend(body.len() + 1, &live.token)?;
            let mut hidden: BTreeSet<String> = hidden;
            hidden.insert(name.clone());
            let hidden = Rc::new(hidden);
            stack.extend(body.into_iter().rev().map(|part| {
                let own = if part.hidden.is_empty() {
                    Rc::clone(&hidden)
                } else {
                    Rc::new(part.hidden.union(&hidden).cloned().collect())
                };
                Live { hidden: own, ..part }
            }));
        }
        Ok(out)
    }

    fn spend(&mut self, tokens: usize, by: &Token) -> Result<(), Bad> {
        let message = format!("with it macros make more than {} tokens, the limit", limits::MACRO_TOKENS);
        self.left = self.left.checked_sub(tokens).ok_or_else(|| bad(by, &message))?;
        Ok(())
    }

    /// The body of a macro with its arguments in place.
    fn filled(
        &mut self,
        found: &Macro,
        arguments: &[Vec<Live>],
        at: &Token,
        depth: usize,
    ) -> Result<Vec<Live>, Bad> {
        let parameters = found.parameters.as_deref().unwrap_or(&[]);
        let none = Rc::new(BTreeSet::new());
        let mut out: Vec<Live> = Vec::new();
        let mut pasted = false;
        let mut made: Vec<Option<Vec<Live>>> = vec![None; arguments.len()];
        for (k, token) in found.body.iter().enumerate() {
            if token.is("##") {
                while out.last().is_some_and(|l| l.token.kind == Kind::Blank) {
                    out.pop();
                }
                pasted = true;
                continue;
            }
            if pasted && token.kind == Kind::Blank {
                continue;
            }
            let beside = pasted
                || found.body[k + 1..].iter().find(|t| t.kind != Kind::Blank).is_some_and(|t| t.is("##"));
            let parts = match parameters.iter().position(|p| token.kind == Kind::Name && token.is(p)) {
                Some(i) if beside => arguments[i].clone(),
                Some(i) => match &made[i] {
                    Some(known) => known.clone(),
                    None => made[i].insert(self.live(arguments[i].clone(), depth + 1)?).clone(),
                },
                None => {
                    let token = Token { from: at.from, copied: false, ..token.clone() };
                    vec![Live { token, hidden: Rc::clone(&none) }]
                }
            };
            self.spend(parts.len(), at)?;
            let mut parts = parts.into_iter();
            if pasted && let (Some(last), Some(first)) = (out.last_mut(), parts.next()) {
                last.token.text.push_str(&first.token.text);
                last.token.copied = false;
            }
            pasted = false;
            out.extend(parts);
        }
        Ok(out)
    }
}

fn bad(token: &Token, message: &str) -> Bad {
    Bad { from: token.from, message: format!("the macro {}: {message}", token.text) }
}

type Hidden = Rc<BTreeSet<String>>;

/// The arguments of a call, whose bracket is next on the stack, and what the closing bracket is
/// hidden from; none if nothing closes it.
fn arguments(stack: &mut Vec<Live>, parameters: &[String]) -> Option<(Vec<Vec<Live>>, Hidden)> {
    while stack.pop()?.token.kind == Kind::Blank {}
    let mut found: Vec<Vec<Live>> = vec![Vec::new()];
    let mut depth = 1;
    while let Some(live) = stack.pop() {
        let rest = parameters.last().is_some_and(|p| p == REST) && found.len() == parameters.len();
        match live.token.text.as_str() {
            "(" => depth += 1,
            ")" => depth -= 1,
            "," if depth == 1 && !rest => {
                found.push(Vec::new());
                continue;
            }
            _ => {}
        }
        if depth == 0 {
            let found: Vec<Vec<Live>> = found.into_iter().map(trimmed).collect();
            let empty = parameters.is_empty() && found.len() == 1 && found[0].is_empty();
            return Some((if empty { Vec::new() } else { found }, live.hidden));
        }
        found.last_mut()?.push(live);
    }
    None
}

fn trimmed(mut list: Vec<Live>) -> Vec<Live> {
    let blank = |l: &Live| l.token.kind == Kind::Blank;
    while list.last().is_some_and(blank) {
        list.pop();
    }
    let lead = list.iter().take_while(|l| blank(l)).count();
    list.split_off(lead)
}
