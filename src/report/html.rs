//! The page as HTML. All text is escaped here; only drawings are markup already.

use std::fmt::{self, Display, Formatter, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lobefit_figures::WOFF;
use miniz_oxide::deflate::compress_to_vec_zlib;

use super::page::{Block, Card, Choice, Page, Section, TextTable, figures_of, place_of};
use super::{bar, fold};

/// Widest drawing in pixels that is still read where it is made as small as a narrow screen; a wider one
/// scrolls there.
const SMALL: f64 = 600.0;

/// The page as HTML: one self-contained file without network. What makes it longer than a few
/// screens is folded, and a fold of many bytes is packed. A script sorts and filters its tables,
/// copies its code, says the values under the pointer and unpacks: without it what is packed is not seen.
pub fn html(page: &Page) -> String {
    let mut out = String::new();
    head(&mut out, page);
    bar(&mut out, page);
    put(&mut out, format_args!("<header>\n<h1>{}</h1>\n", Broken(&page.title)));
    let several = page.lead.contains('\n');
    for (i, paragraph) in page.lead.lines().enumerate() {
        let class = if several && i == 0 { " class=\"conclusion\"" } else { "" };
        put(&mut out, format_args!("<p{class}>"));
        linked(&mut out, paragraph, page.origin.figures());
        out.push_str("</p>\n");
    }
    out.push_str("</header>\n");
    contents(&mut out, page);
    out.push_str("<main>\n");
    for (section, blocks) in page.sections.iter().zip(fold::fitted(page)) {
        let (id, title) = (Escaped(&section.id), Broken(&section.title));
        put(&mut out, format_args!("<section id=\"{id}\">\n<h2>{title}</h2>\n"));
        if !section.lead.is_empty() {
            put(&mut out, format_args!("<p>{}</p>\n", Broken(&section.lead)));
        }
        for one in &blocks {
            block(&mut out, one);
        }
        out.push_str("</section>\n");
    }
    out.push_str("</main>\n");
    footer(&mut out, page);
    let script = slim(include_str!("assets/page.js"));
    put(&mut out, format_args!("<script>\n{script}</script>\n</body>\n</html>\n"));
    out
}

/// A script or a style without indentation, empty lines and lines of comment.
fn slim(text: &str) -> String {
    let comment = |line: &str| line.starts_with("//") || line.starts_with("/*") && line.ends_with("*/");
    let lines = text.lines().map(str::trim);
    let kept = lines.filter(|line| !line.is_empty() && !comment(line));
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// A text, with a link where it names the file of the page's figures.
fn linked(out: &mut String, text: &str, figures: Option<&str>) {
    match figures.and_then(|file| Some((file, text.split_once(file)?))) {
        Some((file, (before, after))) => {
            let (before, after, file) = (Broken(before), Broken(after), Escaped(file));
            put(out, format_args!("{before}<a href=\"{file}\">{file}</a>{after}"));
        }
        None => put(out, format_args!("{}", Broken(text))),
    }
}

/// Links to the sections, where there are several and the bar has none.
fn contents(out: &mut String, page: &Page) {
    if page.sections.len() < 2 || is_alone(page) {
        return;
    }
    out.push_str("<nav aria-label=\"Contents\">\n<ol>\n");
    for Section { id, title, .. } in &page.sections {
        put(out, format_args!("<li><a href=\"#{}\">{}</a></li>\n", Escaped(id), Escaped(title)));
    }
    out.push_str("</ol>\n</nav>\n");
}

/// Whether no other page is written with this one.
fn is_alone(page: &Page) -> bool {
    page.origin.pages.iter().all(|(_, file)| Some(file.as_str()) == page.origin.figures())
}

/// Links to the pages that are written with this one; of a page that stands alone, to its sections.
fn bar(out: &mut String, page: &Page) {
    let figures = page.origin.figures();
    let others = page.origin.pages.iter().filter(|(_, file)| Some(file.as_str()) != figures);
    let mut links: Vec<(String, &str)> = others.map(|(shown, file)| (file.clone(), shown.as_str())).collect();
    let label = if links.is_empty() { "Contents of this page" } else { "Pages" };
    if links.is_empty() {
        links.extend(page.sections.iter().map(|of| (format!("#{}", of.id), of.title.as_str())));
    }
    put(out, format_args!("<nav class=\"bar\" aria-label=\"{label}\">\n"));
    for (to, shown) in links {
        put(out, format_args!("<a href=\"{}\">{}</a>\n", Escaped(&to), Escaped(shown)));
    }
    out.push_str(&bar::beside(&page.origin.command));
    if let Some(file) = figures {
        let title = "The figures of this page in full digits";
        put(out, format_args!("<a href=\"{}\" title=\"{title}\">JSON</a>\n", Escaped(file)));
    }
    out.push_str("</nav>\n");
}

fn head(out: &mut String, page: &Page) {
    let origin = &page.origin;
    let (tool, command) = (Escaped(&origin.tool), Escaped(&origin.command));
    let (recipe, title) = (Escaped(&origin.recipe), Escaped(&page.title));
    let css = slim(include_str!("assets/page.css"));
    let font = STANDARD.encode(WOFF);
    put(
        out,
        format_args!(
            r#"<!DOCTYPE html>
<!-- Generated by lobefit {tool}; do not edit.
     Command: {command}
     Recipe:  {recipe} -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{title}</title>
<style>
@font-face {{ font-family: lobefit; src: url(data:font/woff;base64,{font}) format("woff"); }}
{css}</style>
</head>
<body>
"#
        ),
    );
}

fn footer(out: &mut String, page: &Page) {
    let origin = &page.origin;
    out.push_str("<footer>\n<dl class=\"facts\">\n");
    let scene = origin.scene_words();
    if !scene.is_empty() {
        put(out, format_args!("<dt>Scene</dt><dd>{}</dd>\n", Escaped(scene)));
    }
    let (recipe, tool, command) = (Escaped(&origin.recipe), Escaped(&origin.tool), Escaped(&origin.command));
    put(out, format_args!("<dt>Recipe</dt><dd><code>{recipe}</code></dd>\n"));
    put(out, format_args!("<dt>Made by</dt><dd>lobefit {tool}: <code>{command}</code></dd>\n"));
    out.push_str("</dl>\n</footer>\n");
}

fn block(out: &mut String, block: &Block) {
    match block {
        Block::Text { text } => put(out, format_args!("<p>{}</p>\n", Broken(text))),
        Block::Heading { text } => put(out, format_args!("<h3>{}</h3>\n", Broken(text))),
        Block::Approximation { name } => {
            put(out, format_args!("<h3 id=\"{}\">{}</h3>\n", Escaped(&figures_of(name)), Broken(name)));
        }
        Block::Code { text } => put(out, format_args!("<pre><code>{}</code></pre>\n", Escaped(text))),
        Block::Cards(cards) => {
            let class = if fold::is_paired(cards) { "cards paired" } else { "cards" };
            put(out, format_args!("<div class=\"{class}\">\n"));
            cards.iter().for_each(|one| card(out, one));
            out.push_str("</div>\n");
        }
        Block::Switch { name, of } => {
            switch(out, ("switch", name), of, |out, _, own| own.iter().for_each(|one| self::block(out, one)));
        }
        Block::Facts { rows } => {
            out.push_str("<dl class=\"facts\">\n");
            for (name, value) in rows {
                put(out, format_args!("<dt>{}</dt><dd>{}</dd>\n", Broken(name), Broken(value)));
            }
            out.push_str("</dl>\n");
        }
        Block::Links { rows } => {
            out.push_str("<ul>\n");
            for (shown, file) in rows {
                put(out, format_args!("<li><a href=\"{}\">{}</a></li>\n", Escaped(file), Escaped(shown)));
            }
            out.push_str("</ul>\n");
        }
        Block::Figures { svg, caption } => {
            out.push_str("<figure>\n<div class=\"row\">\n");
            for svg in svg {
                let class = if fold::size(svg, "width") <= SMALL { "plate small" } else { "plate" };
                put(out, format_args!("<div class=\"{class}\">{svg}</div>\n"));
            }
            out.push_str("</div>\n");
            captioned(out, caption);
        }
        Block::Table(table) => text_table(out, table),
        Block::Live { data, still } => live(out, data, still),
        Block::Packed(blocks) => {
            let mut text = String::new();
            blocks.iter().for_each(|one| self::block(&mut text, one));
            out.push_str(&packed(&text));
        }
        Block::Fold { summary, blocks } => {
            put(out, format_args!("<details>\n<summary>{}</summary>\n", Broken(summary)));
            let mut text = String::new();
            opened(&mut text, blocks);
            // What a link leads to has to be there before the fold is opened.
            let kept = text.len() < PACKED_FROM || blocks.iter().any(is_linked);
            let packed = (!kept).then(|| packed(&text)).filter(|packed| 2 * packed.len() < text.len());
            out.push_str(packed.as_ref().unwrap_or(&text));
            out.push_str("</details>\n");
        }
    }
}

/// Bytes of a fold from which on it is packed, where that halves it: pictures are packed already.
const PACKED_FROM: usize = 16 << 10;

/// Whether a link may lead into a block.
fn is_linked(block: &Block) -> bool {
    match block {
        Block::Approximation { .. } | Block::Cards(_) => true,
        Block::Fold { blocks, .. } => blocks.iter().any(is_linked),
        Block::Switch { of, .. } => of.iter().flat_map(|(_, blocks)| blocks).any(is_linked),
        _ => false,
    }
}

/// Markup that the script of the page unpacks.
fn packed(text: &str) -> String {
    let data = STANDARD.encode(compress_to_vec_zlib(text.as_bytes(), 10));
    format!("<div data-packed=\"{data}\"><p>A script of this page unpacks what stands here.</p></div>\n")
}

/// Blocks of a fold. What is folded once more is open in it, below its line.
fn opened(out: &mut String, blocks: &[Block]) {
    for inner in blocks {
        match inner {
            Block::Fold { summary, blocks } => {
                put(out, format_args!("<h4>{}</h4>\n", Broken(summary)));
                opened(out, blocks);
            }
            inner => block(out, inner),
        }
    }
}

/// Controls, data, shader and script of a page that draws itself; below them what stands there
/// where it cannot.
fn live(out: &mut String, data: &str, still: &[Block]) {
    let (css, controls) = (include_str!("assets/explore.css"), include_str!("assets/explore.html"));
    let (shader, script) =
        (slim(include_str!("assets/explore.glsl")), slim(include_str!("assets/explore.js")));
    put(out, format_args!("<style>\n{css}</style>\n{controls}<div id=\"still\">\n"));
    for one in still {
        block(out, one);
    }
    put(
        out,
        format_args!(
            "</div>\n{data}<script type=\"x-shader/x-fragment\" id=\"shader\">\n{shader}</script>\n"
        ),
    );
    put(out, format_args!("<script>\n{script}</script>\n"));
}

fn card(out: &mut String, card: &Card) {
    let (id, title, about) = (Escaped(&card.id), Broken(&card.title), Broken(&card.about));
    let (shown, file) = (Escaped(&card.link.0), Escaped(&card.link.1));
    put(out, format_args!("<article class=\"card\" id=\"{id}\">\n<h3>{title}</h3>\n"));
    let several = card.choices.len() > 1;
    let class = if several { "choices tabbed" } else { "choices" };
    put(out, format_args!("<p>{about} <a href=\"{file}\">{shown}</a></p>\n<div class=\"{class}\">\n"));
    if several {
        let drawing = card.svg.as_ref().map(|_| "furnace");
        let labels = card.choices.iter().map(|choice| choice.role.as_str()).chain(drawing);
        buttons(out, &format!("{}-choices", card.id), labels);
    }
    card.choices.iter().for_each(|one| choice(out, card, one));
    if let Some([desk, phone]) = &card.svg {
        put(
            out,
            format_args!(
                "<div class=\"plate phone\">{phone}</div>\n<div class=\"plate desk\">{desk}</div>\n"
            ),
        );
    }
    out.push_str("</div>\n</article>\n");
}

/// A choice of a card, under its role where there are several; in a narrow window a button stands for
/// the role, and one choice or the drawing is seen at a time.
fn choice(out: &mut String, card: &Card, choice: &Choice) {
    let several = card.choices.len() > 1;
    let class = if several && choice.recommended { "choice recommended" } else { "choice" };
    put(out, format_args!("<div class=\"{class}\">\n"));
    if several {
        put(out, format_args!("<h4>{}</h4>\n", Escaped(&choice.role)));
    }
    put(out, format_args!("<p><code>{}</code></p>\n", Broken(&choice.call)));
    block(out, &Block::Facts { rows: choice.facts.clone() });
    if !choice.note.is_empty() {
        put(out, format_args!("<p class=\"note\">{}</p>\n", Broken(&choice.note)));
    }
    let name = format!("{}-{}", card.id, choice.role);
    switch(out, ("switch tabs", &name), &choice.code, |out, language, text| {
        let (language, text) = (Escaped(language), Words(text));
        put(out, format_args!("<pre data-language=\"{language}\"><code>{text}</code></pre>\n"));
    });
    out.push_str("</div>\n");
}

/// Things of which one is seen, by buttons that need no script; a single one has none. The style of the
/// page knows eight of them.
fn switch<T>(
    out: &mut String,
    (class, name): (&str, &str),
    of: &[(String, T)],
    print: impl Fn(&mut String, &str, &T),
) {
    put(out, format_args!("<div class=\"{class}\">\n"));
    if of.len() > 1 {
        buttons(out, name, of.iter().map(|(label, _)| label.as_str()));
    }
    for (label, one) in of {
        let class = if of.len() > 1 { "" } else { " class=\"alone\"" };
        put(out, format_args!("<div{class}>\n"));
        print(out, label, one);
        out.push_str("</div>\n");
    }
    out.push_str("</div>\n");
}

/// Buttons of which one is pressed, at first the first.
fn buttons<'a>(out: &mut String, name: &str, labels: impl Iterator<Item = &'a str>) {
    for (i, label) in labels.enumerate() {
        let (checked, name, label) = (if i == 0 { " checked" } else { "" }, Escaped(name), Escaped(label));
        put(out, format_args!("<input type=\"radio\" name=\"{name}\" id=\"{name}-{i}\"{checked}>"));
        put(out, format_args!("<label for=\"{name}-{i}\">{label}</label>\n"));
    }
}

fn text_table(out: &mut String, table: &TextTable) {
    let class = |figures: &bool| if *figures { " class=\"n\"" } else { "" };
    out.push_str("<figure>\n<div class=\"wide\"><table>\n<thead><tr>");
    for (name, figures) in &table.columns {
        put(out, format_args!("<th{}>{}</th>", class(figures), Broken(name)));
    }
    out.push_str("</tr></thead>\n<tbody>\n");
    for (i, (row, muted)) in table.rows.iter().zip(&table.muted).enumerate() {
        put(out, format_args!("<tr{}>", if *muted { " class=\"muted\"" } else { "" }));
        for (column, (cell, (_, figures))) in row.iter().zip(&table.columns).enumerate() {
            put(out, format_args!("<td{}>", class(figures)));
            match table.names.as_ref().filter(|names| names.column == column) {
                Some(names) => {
                    let is_place = names.places.get(i).is_some_and(|is_place| *is_place);
                    name(out, cell, (is_place, names.links.get(i).and_then(Option::as_deref)));
                }
                None => put(out, format_args!("{}", Broken(cell))),
            }
            out.push_str("</td>");
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>\n</table></div>\n");
    captioned(out, &table.caption);
}

/// A name that links lead to, or that leads on.
fn name(out: &mut String, name: &str, (is_place, link): (bool, Option<&str>)) {
    let place = if is_place { format!(" id=\"{}\"", Escaped(&place_of(name))) } else { String::new() };
    match link {
        Some(link) => put(out, format_args!("<a{place} href=\"{}\">{}</a>", Escaped(link), Broken(name))),
        None if is_place => put(out, format_args!("<span{place}>{}</span>", Broken(name))),
        None => put(out, format_args!("{}", Broken(name))),
    }
}

fn captioned(out: &mut String, caption: &str) {
    if !caption.is_empty() {
        put(out, format_args!("<figcaption>{}</figcaption>\n", Broken(caption)));
    }
    out.push_str("</figure>\n");
}

fn put(out: &mut String, text: fmt::Arguments) {
    // A String takes every write.
    let _ = out.write_fmt(text);
}

/// Text as it stands in an element: words, which do not break between bars, `|E N - 1|`, and code
/// between backticks.
struct Broken<'a>(&'a str);

/// Characters of a name that finds room on a line of the narrowest screen.
const NAME: usize = 14;

impl Display for Broken<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if let Some((before, (code, after))) =
            self.0.split_once('`').and_then(|(before, rest)| Some((before, rest.split_once('`')?)))
        {
            return write!(f, "{}<code>{}</code>{}", Broken(before), Words(code), Broken(after));
        }
        if let Some((before, (size, after))) =
            self.0.split_once('|').and_then(|(before, rest)| Some((before, rest.split_once('|')?)))
        {
            let whole = Escaped(size).to_string().replace(" - ", " − ").replace(' ', "\u{a0}");
            return write!(f, "{}|{whole}|{}", Words(before), Broken(after));
        }
        Words(self.0).fmt(f)
    }
}

/// Text or code, which may break after the underscores of a long name and the bracket of its
/// arguments.
struct Words<'a>(&'a str);

impl Display for Words<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for word in self.0.split_inclusive(|c: char| !c.is_ascii_alphanumeric() && c != '_') {
            let text = Escaped(word).to_string();
            let long = word.len() > NAME && word.contains('_');
            f.write_str(&if long { text.replace('_', "_<wbr>").replace('(', "(<wbr>") } else { text })?;
        }
        Ok(())
    }
}

/// Text as it stands in an element or in a quoted attribute.
struct Escaped<'a>(&'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for piece in self.0.split_inclusive(['&', '<', '>', '"', '\'']) {
            let (plain, mark) = match piece.char_indices().next_back() {
                Some((at, '&')) => (&piece[..at], "&amp;"),
                Some((at, '<')) => (&piece[..at], "&lt;"),
                Some((at, '>')) => (&piece[..at], "&gt;"),
                Some((at, '"')) => (&piece[..at], "&quot;"),
                Some((at, '\'')) => (&piece[..at], "&#x27;"),
                _ => (piece, ""),
            };
            f.write_str(plain)?;
            f.write_str(mark)?;
        }
        Ok(())
    }
}
