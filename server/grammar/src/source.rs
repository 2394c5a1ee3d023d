//! A text with its comments blanked out, cut into lines that belong together.

use crate::headers::begins_header;

/// A stretch of the text, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Span {
    pub start: u32,
    pub end: u32,
}

impl Span {
    pub fn new(start: usize, end: usize) -> Self {
        Self { start: start as u32, end: end.max(start) as u32 }
    }

    /// A place between two characters.
    pub fn at(place: usize) -> Self {
        Self::new(place, place)
    }
}

/// What separates a rule's predecessor from its successor.
pub(crate) const ARROW: &str = "-->";

/// A text whose comments are blanks; every byte stands where it stood.
#[derive(Debug)]
pub(crate) struct Source {
    pub text: String,
    lines: Vec<u32>,
}

impl Source {
    pub fn new(text: &str) -> Self {
        let starts = text.bytes().enumerate().filter(|&(_, byte)| byte == b'\n').map(|(at, _)| at as u32 + 1);
        Self { lines: std::iter::once(0).chain(starts).collect(), text: without_comments(text) }
    }

    /// Line and column of a place, counted from 1 in characters, and the characters of it on its first line.
    pub fn place(&self, span: Span) -> (u32, u32, u32) {
        // What is wrong with a text as a whole may be told of a byte within a character.
        let floor = |at: u32| self.text.floor_char_boundary(at as usize) as u32;
        let span = Span { start: floor(span.start), end: floor(span.end) };
        let line = self.lines.partition_point(|&start| start <= span.start) - 1;
        let chars = |from: u32, to: u32| self.text[from as usize..to as usize].chars().count() as u32;
        let line_end = self.lines.get(line + 1).map_or(self.text.len() as u32, |next| next - 1);
        let end = span.end.min(line_end).max(span.start);
        (line as u32 + 1, chars(self.lines[line], span.start) + 1, chars(span.start, end))
    }

    /// Lines that belong together: a line that is indented goes on with the one before, unless it is a rule, a header
    /// or a definition of its own; one that begins with the arrow or a brace, with the predecessor before it.
    pub fn logical_lines(&self) -> Vec<Span> {
        let mut found: Vec<Span> = Vec::new();
        let mut open = false;
        let mut may_go_on = false;
        let mut start = 0;
        for line in self.text.split_inclusive('\n') {
            let span = Span::new(start, start + line.trim_end().len());
            start += line.len();
            let content = line.trim();
            if content.is_empty() {
                may_go_on &= open;
                continue;
            }
            let is_indented = line.starts_with([' ', '\t']);
            let stands_alone = content.contains(ARROW) || begins_header(content) || is_definition(content);
            let goes_on = open || (may_go_on && is_indented && !stands_alone);
            let is_rest = is_rest_of_rule(content, found.last().map_or("", |last| self.slice(*last)));
            match found.last_mut().filter(|_| goes_on || is_rest) {
                Some(last) => last.end = span.end,
                None => {
                    let indent = line.len() - line.trim_start().len();
                    found.push(Span::new(span.start as usize + indent, span.end as usize));
                }
            }
            let whole = found.last().map_or("", |last| self.slice(*last));
            // Definitions may stand in braces over several lines; nothing else has any there.
            open = whole.starts_with("define") && whole.contains('{') && !whole.contains('}');
            may_go_on = true;
        }
        found
    }

    pub fn slice(&self, span: Span) -> &str {
        &self.text[span.start as usize..span.end as usize]
    }
}

/// Whether a line is the rest of a rule whose predecessor is the line before.
fn is_rest_of_rule(content: &str, before: &str) -> bool {
    let is_predecessor =
        !before.is_empty() && !before.contains(ARROW) && !begins_header(before) && !is_definition(before);
    is_predecessor && (content.starts_with(ARROW) || (content.starts_with('{') && content.contains(ARROW)))
}

/// `name = …`, as Python and this language define a number.
pub(crate) fn is_definition(line: &str) -> bool {
    let Some((name, rest)) = line.split_once('=') else { return false };
    let name = name.trim_end();
    let is_name = name.starts_with(|c: char| c.is_alphabetic())
        && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    is_name && !rest.starts_with('=')
}

/// Puts blanks in place of `/* */`, and of what follows `//` or `#` where these stand for no symbols of the turtle:
/// where a line or, behind a blank, a comment begins with them and a blank follows.
fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    // Some editors write a mark before the first line.
    if let Some(after) = text.strip_prefix('\u{feff}') {
        out.extend(std::iter::repeat_n(' ', text.len() - after.len()));
        rest = after;
    }
    let mut is_line_start = true;
    let mut before = '\n';
    while let Some(c) = rest.chars().next() {
        let comment = if rest.starts_with("/*") {
            Some(rest.find("*/").map_or(rest.len(), |end| end + 2))
        } else if before.is_whitespace() && is_line_comment(rest, is_line_start) {
            Some(rest.find('\n').unwrap_or(rest.len()))
        } else {
            None
        };
        let taken = comment.unwrap_or(c.len_utf8());
        match comment {
            Some(_) => rest[..taken].chars().for_each(|c| match c {
                '\n' => out.push('\n'),
                c => out.extend(std::iter::repeat_n(' ', c.len_utf8())),
            }),
            None => {
                out.push(c);
                before = c;
                is_line_start = c == '\n' || (is_line_start && c.is_whitespace());
            }
        }
        rest = &rest[taken..];
    }
    out
}

fn is_line_comment(rest: &str, is_line_start: bool) -> bool {
    let is_blank = |rest: &str| rest.is_empty() || rest.starts_with(char::is_whitespace);
    let is_word = |rest: &str| is_line_start && rest.starts_with(|c: char| !matches!(c, '/' | '(' | '['));
    if let Some(behind) = rest.strip_prefix("//") {
        return is_blank(behind) || is_word(behind);
    }
    match rest.strip_prefix('#') {
        Some(behind) => is_blank(behind) || (is_word(behind) && !is_directive(behind)),
        None => false,
    }
}

/// `#define` is read; other directives of C are told from comments by name.
fn is_directive(rest: &str) -> bool {
    ["define", "include", "if", "ifdef", "ifndef", "else", "endif", "undef"].iter().any(|name| {
        rest.strip_prefix(name).is_some_and(|behind| !behind.starts_with(|c: char| c.is_alphanumeric()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_blanked_and_symbols_stay() {
        let text = "A --> F//F # end\n# note\n/* a\nb */B --> /////F#(2) // more\n#define X 2\n//c\n";
        let wanted = "A --> F//F      \n      \n    \n    B --> /////F#(2)        \n#define X 2\n   \n";
        assert_eq!(Source::new(text).text, wanted);
    }

    #[test]
    fn indented_lines_go_on() {
        let source = Source::new("A --> F\n  [+A]\n\n  B\ndefine: { a = 1\nb = 2 }\n  C --> D\n x = 3\n");
        let lines: Vec<_> =
            source.logical_lines().iter().map(|&span| source.slice(span).to_owned()).collect();
        assert_eq!(lines, ["A --> F\n  [+A]", "B", "define: { a = 1\nb = 2 }", "C --> D", "x = 3"]);
    }

    #[test]
    fn arrows_go_on_with_their_predecessors() {
        let source =
            Source::new("A(t) : t > 1\n\n--> F\nB : 1\n {x = 2;} --> G\naxiom: A\n--> F\nA --> B\n--> C");
        let lines: Vec<_> =
            source.logical_lines().iter().map(|&span| source.slice(span).to_owned()).collect();
        let wanted =
            ["A(t) : t > 1\n\n--> F", "B : 1\n {x = 2;} --> G", "axiom: A", "--> F", "A --> B", "--> C"];
        assert_eq!(lines, wanted);
    }

    #[test]
    fn places_count_characters() {
        let source = Source::new("äb\ncd");
        assert_eq!(source.place(Span::new(2, 3)), (1, 2, 1));
        assert_eq!(source.place(Span::new(4, 6)), (2, 1, 2));
        assert_eq!(source.place(Span::new(0, 6)), (1, 1, 2));
    }
}
