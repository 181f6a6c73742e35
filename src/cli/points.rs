//! Points in and values out: a CSV whose rows are kept byte for byte and gain columns.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use crate::scene::escape::visible;
use lobefit_truth::quantity::{Choice, Input, Quantity, Variant};

/// Largest file of points, bytes: some ten million points.
pub const FILE_BYTES: u64 = 512 << 20;

/// Most columns of a file.
const COLUMNS: usize = 4096;

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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'a> {
    /// The inputs, in the quantity's order; NaN where an optional one has no column.
    pub inputs: &'a [f64],
    /// The choices of the row's words.
    pub variant: &'a Variant,
}

/// The rows of a CSV file, and what they ask of a quantity: of a file of 16 MiB some four million.
#[derive(Clone, Debug)]
pub struct Points {
    file: String,
    bytes: Vec<u8>,
    header: Range<usize>,
    /// First byte of each record, and the one after its last: [`FILE_BYTES`] fit.
    records: Vec<[u32; 2]>,
    /// Of all rows one after another.
    inputs: Vec<f64>,
    /// The different variants, and which of them each row has.
    variants: Vec<Variant>,
    chosen: Vec<u16>,
}

impl Points {
    /// Reads a CSV (comma, double quotes, any line end, UTF-8 byte order mark allowed) with a
    /// header that names the quantity's inputs among its columns. Empty lines are skipped, and the
    /// byte order mark is not kept.
    pub fn parse(bytes: Vec<u8>, file: &str, quantity: &dyn Quantity) -> Result<Points, PointsError> {
        let mut lines = Lines::new(&bytes);
        let fail = |line, message| PointsError::Row { file: file.into(), line, message };
        let Some(header) = lines.next(file)? else {
            let message = format!("the file is empty; a header with {} is called for", wanted(quantity));
            return Err(fail(1, message));
        };
        let columns = columns(&header, quantity).map_err(|message| fail(header.line, message))?;
        let width = header.fields.len();
        let mut rows = Rows::default();
        while let Some(record) = lines.next(file)? {
            let place = |message| fail(record.line, format!("row {}: {message}", rows.records.len() + 1));
            let variant = row(&record, width, &columns, quantity, &mut rows.inputs).map_err(place)?;
            rows.add(&record.range, variant);
        }
        let (header, Rows { records, inputs, variants, chosen }) = (header.range, rows);
        Ok(Points { file: file.into(), bytes, header, records, inputs, variants, chosen })
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether there is a header alone.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// What a row (from 0) asks for.
    pub fn row(&self, row: usize) -> Row<'_> {
        let width = self.inputs.len() / self.len();
        let inputs = &self.inputs[row * width..][..width];
        Row { inputs, variant: &self.variants[usize::from(self.chosen[row])] }
    }

    /// The variants of all rows, to be completed by options.
    pub fn variants(&mut self) -> impl Iterator<Item = &mut Variant> {
        self.variants.iter_mut()
    }

    /// The error that a row (from 0) cannot be computed, with its line.
    pub fn refuse(&self, row: usize, message: &str) -> PointsError {
        let before = &self.bytes[..self.records.get(row).map_or(0, |[start, _]| *start as usize)];
        let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
        PointsError::Row { file: self.file.clone(), line, message: format!("row {}: {message}", row + 1) }
    }

    /// The file with the quantity's outputs appended: the bytes of every row as they were, line
    /// ends LF, empty lines left out; numbers in the shortest digits that read back to the same
    /// f64.
    ///
    /// # Errors
    /// A value that is missing or not finite.
    pub fn with_columns(&self, quantity: &dyn Quantity, values: &[f64]) -> Result<Vec<u8>, PointsError> {
        let columns = quantity.outputs();
        let mut out = Vec::with_capacity(self.bytes.len() + 16 * values.len());
        out.extend(&self.bytes[self.header.clone()]);
        for column in columns {
            out.push(b',');
            out.extend(column.as_bytes());
        }
        out.push(b'\n');
        for (i, &[start, end]) in self.records.iter().enumerate() {
            out.extend(&self.bytes[start as usize..end as usize]);
            for (j, &column) in columns.iter().enumerate() {
                let value = values.get(i * columns.len() + j).filter(|x| x.is_finite());
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

/// The rows that were read so far.
#[derive(Default)]
struct Rows {
    records: Vec<[u32; 2]>,
    inputs: Vec<f64>,
    variants: Vec<Variant>,
    chosen: Vec<u16>,
}

impl Rows {
    /// Adds a row, whose inputs are there: words of choices make few variants.
    fn add(&mut self, range: &Range<usize>, variant: Variant) {
        let known = self.variants.iter().position(|known| *known == variant);
        let chosen = known.unwrap_or_else(|| {
            self.variants.push(variant);
            self.variants.len() - 1
        });
        self.records.push([range.start as u32, range.end as u32]);
        self.chosen.push(chosen as u16);
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
    fn text(&self, i: usize) -> Cow<'_, str> {
        let field = self.fields.get(i).unwrap_or_default();
        match std::str::from_utf8(field) {
            Ok(text) => Cow::Borrowed(text.trim()),
            Err(_) => Cow::Owned(String::from_utf8_lossy(field).trim().to_owned()),
        }
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
    if header.fields.len() > COLUMNS {
        return Err(format!("more than {COLUMNS} columns"));
    }
    for i in 0..header.fields.len() {
        let name = header.text(i);
        if quantity.outputs().contains(&&*name) {
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
        let names: Vec<Cow<'_, str>> = (0..header.fields.len()).map(|i| header.text(i)).collect();
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

/// The choices of one record, whose inputs are added to those of others.
fn row(
    record: &Record,
    width: usize,
    columns: &Columns,
    quantity: &dyn Quantity,
    inputs: &mut Vec<f64>,
) -> Result<Variant, String> {
    let found = record.fields.len();
    if found != width {
        return Err(format!("{found} fields where the header has {width}"));
    }
    let number = |(&column, input): (&Option<usize>, &Input)| {
        let Some(i) = column else { return Ok(f64::NAN) };
        value(&record.text(i), input).map_err(|what| format!("column `{}`: {what}", input.name))
    };
    for input in columns.inputs.iter().zip(quantity.inputs()).map(number) {
        inputs.push(input?);
    }
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
    Ok(variant)
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
