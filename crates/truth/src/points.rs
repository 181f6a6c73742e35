//! Many points of a quantity: named columns of inputs.

/// Inputs by name, a value of each for every point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    columns: Vec<(String, Vec<f64>)>,
    /// The first `uniform` points are spread evenly: RMS and mean are taken over them. The others
    /// crowd where the largest errors hide.
    pub uniform: usize,
}

impl Points {
    /// Columns of one length; all points count as uniform.
    ///
    /// # Panics
    /// If the columns differ in length: they never depend on input.
    pub fn new<S: Into<String>>(columns: impl IntoIterator<Item = (S, Vec<f64>)>) -> Points {
        let columns: Vec<(String, Vec<f64>)> =
            columns.into_iter().map(|(name, column)| (name.into(), column)).collect();
        let uniform = columns.first().map_or(0, |(_, column)| column.len());
        assert!(columns.iter().all(|(_, column)| column.len() == uniform), "columns of one length");
        Points { columns, uniform }
    }

    /// Every combination of the values of axes, the first axis fastest.
    pub fn product(axes: &[(&str, &[f64])]) -> Points {
        let count: usize = axes.iter().map(|(_, values)| values.len()).product();
        let mut step = 1;
        let column = |(name, values): &(&str, &[f64])| {
            let column = (0..count).map(|i| values[i / step % values.len()]).collect();
            step *= values.len();
            (String::from(*name), column)
        };
        Points { columns: axes.iter().map(column).collect(), uniform: count }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Names and values of all columns.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.columns.iter().map(|(name, column)| (name.as_str(), column.as_slice()))
    }

    /// The column of an input.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns().find(|(n, _)| *n == name).map(|(_, column)| column)
    }

    /// The column of an input as a shader has it.
    pub fn column_f32(&self, name: &str) -> Option<Vec<f32>> {
        self.column(name).map(|column| column.iter().map(|x| *x as f32).collect())
    }

    /// The same points with one more input.
    #[must_use]
    pub fn with(mut self, name: &str, column: Vec<f64>) -> Points {
        self.columns.push((name.into(), column));
        self
    }

    /// The same points without an input.
    #[must_use]
    pub fn without(mut self, name: &str) -> Points {
        self.columns.retain(|(n, _)| n != name);
        self
    }

    /// Adds a point, its inputs in the order of the columns; the first point names them.
    pub fn push<const N: usize>(&mut self, point: [(&str, f64); N]) {
        if self.columns.is_empty() {
            self.columns = point.iter().map(|(name, _)| ((*name).into(), Vec::new())).collect();
        }
        for ((_, column), (_, x)) in self.columns.iter_mut().zip(point) {
            column.push(x);
        }
    }

    /// The points with these marks, in order.
    #[must_use]
    pub fn marked(&self, marks: &[bool]) -> Points {
        self.picked(&(0..marks.len()).filter(|i| marks[*i]).collect::<Vec<usize>>())
    }

    /// The points of these numbers, which ascend.
    #[must_use]
    pub fn picked(&self, numbers: &[usize]) -> Points {
        let of = |column: &[f64]| numbers.iter().map(|i| column[*i]).collect();
        let columns = self.columns().map(|(name, column)| (name.to_string(), of(column))).collect();
        Points { columns, uniform: numbers.partition_point(|i| *i < self.uniform) }
    }

    /// The uniform points alone.
    #[must_use]
    pub fn head(&self) -> Points {
        Points::new(self.columns().map(|(name, column)| (name, column[..self.uniform].to_vec())))
    }

    /// Appends points with the same columns; the number of uniform points stays.
    pub fn extend(&mut self, more: Points) {
        for ((_, column), (_, rest)) in self.columns.iter_mut().zip(more.columns) {
            column.extend(rest);
        }
    }
}

/// Smallest and largest of some values.
pub fn hull(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}
