//! Values of a shader at one point.

/// A value of a shader.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// An f32.
    Number(f32),
    /// A bool: 1 or 0, or NaN where it compares what is not a number.
    Truth(f32),
    /// An integer.
    Integer(i64),
    /// A vector, an array, a structure, or a matrix as the list of its columns.
    List(Vec<Value>),
    /// Where a variable, or a part of it, is.
    Pointer(Pointer),
    /// Part of a variable that nothing has been written to.
    Unset,
}

/// A variable by its slot, and indices into it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pointer {
    pub slot: usize,
    pub path: Vec<usize>,
}

impl Pointer {
    /// The pointer to an entry.
    pub fn entry(&self, index: usize) -> Pointer {
        let mut path = self.path.clone();
        path.push(index);
        Pointer { slot: self.slot, path }
    }

    /// What it points to.
    pub fn of<'a>(&self, memory: &'a mut [Value]) -> Option<&'a mut Value> {
        let mut value = memory.get_mut(self.slot)?;
        for &index in &self.path {
            value = match value {
                Value::List(list) => list.get_mut(index)?,
                _ => return None,
            };
        }
        Some(value)
    }
}

impl Value {
    /// 1 or 0.
    pub fn truth(holds: bool) -> Value {
        Value::Truth(f32::from(u8::from(holds)))
    }

    /// A list of what there is of every entry.
    pub fn list(entries: impl Iterator<Item = Option<Value>>) -> Option<Value> {
        entries.collect::<Option<Vec<Value>>>().map(Value::List)
    }

    /// Its entries, if it has any.
    pub fn entries(&self) -> Option<&[Value]> {
        if let Value::List(list) = self { Some(list) } else { None }
    }

    /// Its scalars, depth first, if all are numbers.
    pub fn numbers(&self) -> Option<Vec<f32>> {
        if let Value::Truth(_) | Value::Integer(_) = self { None } else { self.scalars(Value::numbers) }
    }

    /// Its scalars, depth first, whole numbers and truth values as numbers.
    pub fn all_numbers(&self) -> Option<Vec<f32>> {
        self.scalars(Value::all_numbers)
    }

    /// Its scalars, of the entries of a list what `of` has.
    fn scalars(&self, of: fn(&Value) -> Option<Vec<f32>>) -> Option<Vec<f32>> {
        match self {
            Value::Number(x) | Value::Truth(x) => Some(vec![*x]),
            Value::Integer(n) => Some(vec![*n as f32]),
            Value::List(list) => Some(list.iter().map(of).collect::<Option<Vec<Vec<f32>>>>()?.concat()),
            _ => None,
        }
    }

    /// Whether it is a matrix: a list of lists.
    pub fn is_matrix(&self) -> bool {
        matches!(self, Value::List(list) if matches!(list.first(), Some(Value::List(_))))
    }

    /// Whether something in it was never written.
    pub fn has_gaps(&self) -> bool {
        match self {
            Value::Unset => true,
            Value::List(list) => list.iter().any(Value::has_gaps),
            _ => false,
        }
    }
}
