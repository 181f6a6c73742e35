//! Points in and values out: a CSV whose rows are kept byte for byte and gain columns.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::scene::escape::visible;
use lobefit_truth::quantity::{Choice, Input, Quantity, Variant};

/// Largest file of points, bytes: some ten million points.
pub const FILE_BYTES: u64 = 512 << 20;

/// A file of points that is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointsError {
    /// The header or a row is wrong.
    #[error("{}:{line}: {}", visible(file), visible(message))]
    Row {
        /// File as the user named it.
        file: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong, with the column's name.
        message: String,
    },
    /// A computed value that is not finite, or a row without values: a defect of the computation,
    /// never printed.
    #[error("{}: row {row}: the computed {column} is not a finite number", visible(file))]
    Value {
        /// File as the user named it.
        file: String,
        /// Row, from 1, the header not counted.
        row: usize,
        /// Output column.
        column: &'static str,
    },
}

/// What a row asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The inputs, in the quantity's order; NaN where an optional one has no column.
    pub inputs: Vec<f64>,
    /// The choices of the row's words.
    pub variant: Variant,
}

/// The rows of a CSV file, and what they ask of a quantity.
#[derive(Clone, Debug)]
pub struct Points {
    file: String,
    bytes: Vec<u8>,
    header: Range<usize>,
    records: Vec<Range<usize>>,
    rows: Vec<Row>,
}

impl Points {
    /// Reads a CSV (comma, double quotes, any line end, UTF-8 byte order mark allowed) with a
    /// header that names the quantity's inputs among its columns. Empty lines are skipped, and the
    /// byte order mark is not kept.
    pub fn parse(bytes: Vec<u8>, file: &str, quantity: &dyn Quantity) -> Result<Points, PointsError> {
        let mut points =
            Points { file: file.into(), bytes, header: 0..0, records: Vec::new(), rows: Vec::new() };
        let mut lines = Lines::new(&points.bytes);
        let Some(header) = lines.next(file)? else {
            let message = format!("the file is empty; a header with {} is called for", wanted(quantity));
            return Err(PointsError::Row { file: file.into(), line: 1, message });
        };
        let columns = columns(&header, quantity).map_err(|message| PointsError::Row {
            file: file.into(),
            line: header.line,
            message,
        })?;
        points.header = header.range.clone();
        let width = header.fields.len();
        let mut records = Vec::new();
        let mut rows = Vec::new();
        while let Some(record) = lines.next(file)? {
            let row = row(&record, width, &columns, quantity).map_err(|message| PointsError::Row {
                file: file.into(),
                line: record.line,
                message: format!("row {}: {message}", rows.len() + 1),
            })?;
            records.push(record.range);
            rows.push(row);
        }
        points.records = records;
        points.rows = rows;
        Ok(points)
    }

    /// What every row asks for.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The variants of all rows, to be completed by options.
    pub fn variants(&mut self) -> impl Iterator<Item = &mut Variant> {
        self.rows.iter_mut().map(|row| &mut row.variant)
    }

    /// The error that a row (from 0) cannot be computed, with its line.
    pub fn refuse(&self, row: usize, message: &str) -> PointsError {
        let before = &self.bytes[..self.records.get(row).map_or(0, |range| range.start)];
        let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
        PointsError::Row { file: self.file.clone(), line, message: format!("row {}: {message}", row + 1) }
    }

    /// The file with the quantity's outputs appended: the bytes of every row as they were, line
    /// ends LF, empty lines left out; numbers in the shortest digits that read back to the same
    /// f64.
    pub fn with_columns(&self, quantity: &dyn Quantity, values: &[Vec<f64>]) -> Result<Vec<u8>, PointsError> {
        let mut out = Vec::with_capacity(self.bytes.len() + 32 * values.len() * quantity.outputs().len());
        out.extend(&self.bytes[self.header.clone()]);
        for column in quantity.outputs() {
            out.push(b',');
            out.extend(column.as_bytes());
        }
        out.push(b'\n');
        for (i, record) in self.records.iter().enumerate() {
            out.extend(&self.bytes[record.clone()]);
            for (j, &column) in quantity.outputs().iter().enumerate() {
                let value = values.get(i).and_then(|row| row.get(j)).filter(|x| x.is_finite());
                let value = value.ok_or_else(|| PointsError::Value {
                    file: self.file.clone(),
                    row: i + 1,
                    column,
                })?;
                out.push(b',');
                out.extend(shortest(*value).as_bytes());
            }
            out.push(b'\n');
        }
        Ok(out)
    }
}

/// The shortest digits that read back to the same f64: positional from 1e-5 to 1e16, else with an
/// exponent; whole numbers without a point.
pub fn shortest(x: f64) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// One record: its bytes without line ends, the line it begins on, its fields.
struct Record {
    range: Range<usize>,
    line: usize,
    fields: csv::ByteRecord,
}

impl Record {
    /// A field for a message and for reading: its text without surrounding blanks.
    fn text(&self, i: usize) -> String {
        String::from_utf8_lossy(self.fields.get(i).unwrap_or_default()).trim().to_owned()
    }
}

/// The records of a file one by one, with the place of each.
struct Lines<'a> {
    bytes: &'a [u8],
    reader: csv::Reader<&'a [u8]>,
    /// Byte up to which lines are counted, and their number.
    counted: (usize, usize),
    /// Bytes of the byte order mark, which the reader does not see.
    start: usize,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        let reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(&bytes[start..]);
        Lines { bytes, reader, counted: (0, 1), start }
    }

    fn next(&mut self, file: &str) -> Result<Option<Record>, PointsError> {
        let mut fields = csv::ByteRecord::new();
        let from = self.start + self.reader.position().byte() as usize;
        let more = self.reader.read_byte_record(&mut fields);
        let to = self.start + self.reader.position().byte() as usize;
        let fail = |line, message: String| PointsError::Row { file: file.into(), line, message };
        if !more.map_err(|e| fail(self.counted.1, e.to_string()))? {
            return Ok(None);
        }
        let ends = |b: &u8| matches!(b, b'\r' | b'\n');
        let raw = &self.bytes[from..to];
        let skip = raw.iter().take_while(|b| ends(b)).count();
        let tail = raw[skip..].iter().rev().take_while(|b| ends(b)).count();
        let range = from + skip..to - tail;
        let (at, line) = self.counted;
        let line = line + self.bytes[at..range.start].iter().filter(|&&b| b == b'\n').count();
        self.counted = (range.start, line);
        if self.bytes[range.clone()].iter().filter(|&&b| b == b'"').count() % 2 == 1 {
            return Err(fail(line, "a double quote is not closed".into()));
        }
        Ok(Some(Record { range, line, fields }))
    }
}

/// Indices of the columns of inputs and of choices; none for an optional one that is not there.
struct Columns {
    inputs: Vec<Option<usize>>,
    choices: Vec<(Choice, usize)>,
}

/// The choices that are made by words in columns: the shadowing is one of all rows.
fn choices(quantity: &dyn Quantity) -> impl Iterator<Item = Choice> {
    quantity.choices().iter().copied().filter(|choice| *choice != Choice::Smith)
}

fn columns(header: &Record, quantity: &dyn Quantity) -> Result<Columns, String> {
    let mut found = BTreeMap::new();
    for i in 0..header.fields.len() {
        let name = header.text(i);
        if quantity.outputs().contains(&name.as_str()) {
            return Err(format!("column `{name}` is one that {} appends; rename it", quantity.name()));
        }
        if found.insert(name.clone(), i).is_some() {
            return Err(format!("column `{name}` is there twice"));
        }
    }
    let needed = quantity.inputs().iter().filter(|input| !input.optional).map(|input| input.name);
    let needed = needed.chain(choices(quantity).filter(|choice| !choice.is_optional()).map(Choice::name));
    let missing: Vec<&str> = needed.filter(|name| !found.contains_key(*name)).collect();
    if !missing.is_empty() {
        let names: Vec<String> = (0..header.fields.len()).map(|i| header.text(i)).collect();
        let (quantity, names) = (quantity.name(), names.join("`, `"));
        let (s, are) = if missing.len() == 1 { ("", "is") } else { ("s", "are") };
        let missing = missing.join("`, `");
        return Err(format!(
            "column{s} `{missing}` {are} missing, which {quantity} needs; the header has `{names}`"
        ));
    }
    let index = |name: &str| found.get(name).copied();
    let inputs = quantity.inputs().iter().map(|input| index(input.name)).collect();
    let chosen = choices(quantity).filter_map(|choice| Some((choice, index(choice.name())?))).collect();
    Ok(Columns { inputs, choices: chosen })
}

/// The inputs and choices of one record.
fn row(record: &Record, width: usize, columns: &Columns, quantity: &dyn Quantity) -> Result<Row, String> {
    let found = record.fields.len();
    if found != width {
        return Err(format!("{found} fields where the header has {width}"));
    }
    let number = |(&column, input): (&Option<usize>, &Input)| {
        let Some(i) = column else { return Ok(f64::NAN) };
        value(&record.text(i), input).map_err(|what| format!("column `{}`: {what}", input.name))
    };
    let inputs = columns.inputs.iter().zip(quantity.inputs()).map(number).collect::<Result<_, _>>()?;
    let mut variant = Variant::default();
    for (choice, i) in &columns.choices {
        let (name, word) = (choice.name(), record.text(*i));
        if word.is_empty() {
            return Err(format!("column `{name}`: the field is empty"));
        }
        if !variant.choose(*choice, &word) {
            let known = choice.words().join(", ");
            return Err(format!("column `{name}`: `{word}` is not one of {known}"));
        }
    }
    Ok(Row { inputs, variant })
}

/// A finite number in its domain. Negative zero is read as zero.
fn value(text: &str, input: &Input) -> Result<f64, String> {
    if text.is_empty() {
        return Err("the field is empty".into());
    }
    let [min, max] = input.domain;
    let x: f64 = text.parse().map_err(|_| format!("`{text}` is not a number"))?;
    if !x.is_finite() {
        return Err(format!("`{text}` is not a finite number"));
    }
    if x < min || x > max {
        return Err(format!("{text} is outside [{min}, {max}]"));
    }
    Ok(x + 0.0)
}

fn wanted(quantity: &dyn Quantity) -> String {
    let inputs = quantity.inputs().iter().map(|input| input.name);
    let names = inputs.chain(choices(quantity).map(Choice::name)).map(|name| format!("`{name}`"));
    names.collect::<Vec<_>>().join(" and ")
}
