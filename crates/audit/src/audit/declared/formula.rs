//! Formulas of a file's own statement: `sqrt(mu * (1 + l) / (mu + l))`, with `+ - * / ^`, brackets, `sqrt` and `log2`.

use lobefit_math::ops;

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Formula {
    Number(f64),
    Name(String),
    Negative(Box<Formula>),
    Binary(char, Box<Formula>, Box<Formula>),
    Call(String, Box<Formula>),
}

/// Deepest brackets.
const DEPTH: usize = 64;

/// Longest text: a chain of sums is as deep as it is long.
const LENGTH: usize = 1024;

impl Formula {
    /// Reads a whole text.
    ///
    /// Errors: what stands where something else is called for.
    pub fn parse(text: &str) -> Result<Formula, String> {
        if text.len() > LENGTH {
            return Err(format!("a formula of {} letters, the most is {LENGTH}", text.len()));
        }
        let mut reader = Reader { text, at: 0, depth: 0 };
        let formula = reader.sum()?;
        match reader.peek() {
            None => Ok(formula),
            Some(c) => Err(format!("`{c}` in `{text}`")),
        }
    }

    /// Its value, names given by `of`; none where a name has no value.
    pub fn value(&self, of: &dyn Fn(&str) -> Option<f64>) -> Option<f64> {
        Some(match self {
            Formula::Number(x) => *x,
            Formula::Name(name) => of(name)?,
            Formula::Negative(a) => -a.value(of)?,
            Formula::Call(name, a) => {
                let a = a.value(of)?;
                if name == "sqrt" { a.sqrt() } else { ops::log(a) / std::f64::consts::LN_2 }
            }
            Formula::Binary(op, a, b) => {
                let (a, b) = (a.value(of)?, b.value(of)?);
                match op {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    '/' => a / b,
                    _ => ops::pow(a, b),
                }
            }
        })
    }
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    fn take(&mut self, wanted: &[char]) -> Option<char> {
        let found = self.peek().filter(|c| wanted.contains(c))?;
        self.at += found.len_utf8();
        Some(found)
    }

    /// The longest piece of such characters from here.
    fn run(&mut self, keep: impl Fn(char) -> bool) -> &'a str {
        let rest = &self.text[self.at..];
        let end = rest.find(|c| !keep(c)).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    fn sum(&mut self) -> Result<Formula, String> {
        let mut left = self.product()?;
        while let Some(op) = self.take(&['+', '-']) {
            left = Formula::Binary(op, Box::new(left), Box::new(self.product()?));
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Formula, String> {
        let mut left = self.power()?;
        while let Some(op) = self.take(&['*', '/']) {
            left = Formula::Binary(op, Box::new(left), Box::new(self.power()?));
        }
        Ok(left)
    }

    fn power(&mut self) -> Result<Formula, String> {
        if self.take(&['-']).is_some() {
            return Ok(Formula::Negative(Box::new(self.nested(Self::power)?)));
        }
        let base = self.term()?;
        match self.take(&['^']) {
            Some(op) => Ok(Formula::Binary(op, Box::new(base), Box::new(self.nested(Self::power)?))),
            None => Ok(base),
        }
    }

    fn term(&mut self) -> Result<Formula, String> {
        if self.take(&['(']).is_some() {
            return self.bracket();
        }
        match self.peek() {
            Some(c) if c.is_ascii_digit() => {
                let digits = self.run(|c| c.is_ascii_digit() || c == '.');
                digits.parse().map(Formula::Number).map_err(|_| format!("`{digits}` is no number"))
            }
            Some(c) if c.is_ascii_alphabetic() => {
                let name = self.run(|c| c.is_ascii_alphanumeric() || c == '_').to_string();
                if self.take(&['(']).is_none() {
                    return Ok(Formula::Name(name));
                }
                if !["sqrt", "log2"].contains(&name.as_str()) {
                    return Err(format!("no function `{name}` is known"));
                }
                Ok(Formula::Call(name, Box::new(self.bracket()?)))
            }
            Some(c) => Err(format!("`{c}` in `{}`", self.text)),
            None => Err(format!("`{}` ends too soon", self.text)),
        }
    }

    /// What stands up to the bracket that closes.
    fn bracket(&mut self) -> Result<Formula, String> {
        let inside = self.nested(Self::sum)?;
        let closed = self.take(&[')']);
        closed.map(|_| inside).ok_or_else(|| format!("a bracket of `{}` is not closed", self.text))
    }

    fn nested(&mut self, read: fn(&mut Self) -> Result<Formula, String>) -> Result<Formula, String> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(format!("more than {DEPTH} brackets inside one another"));
        }
        let formula = read(self)?;
        self.depth -= 1;
        Ok(formula)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_have_their_values() {
        let at = |text: &str| {
            let of = |name: &str| [("mu", 0.25), ("l", 3.0)].iter().find(|v| v.0 == name).map(|v| v.1);
            Formula::parse(text).unwrap().value(&of)
        };
        assert_eq!(at("sqrt(mu * (1 + l) / (mu + l) * 13) - 2 * -1"), Some(4.0));
        assert_eq!(at("2^3^2 / 2^-1"), Some(1024.0));
        assert_eq!(at("-log2(mu) - l"), Some(-1.0));
        assert_eq!(at("mu + nothing"), None);
        for bad in [
            "",
            "mu +",
            "(mu",
            "mu)",
            "exp(mu)",
            "1.2.3",
            "mu $ l",
            &"(".repeat(200),
            &"-".repeat(200),
            &"1+".repeat(900),
        ] {
            assert!(Formula::parse(bad).is_err(), "{bad}");
        }
    }
}
