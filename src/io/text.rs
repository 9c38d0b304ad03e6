//! Tokens of text files, with the line they stand in.
use super::error::quote;
use super::{Format, Location, ReadError, decimal};

/// How a format separates its tokens, beside blanks.
pub(super) struct Syntax {
    pub format: Format,
    /// Whether commas and semicolons separate tokens.
    pub commas: Commas,
    /// What begins a comment, which runs to the end of its line.
    pub comments: &'static [&'static [u8]],
    /// Whether a backslash at the end of a line continues it.
    pub continuation: Continuation,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Commas {
    Separate,
    Plain,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Continuation {
    Backslash,
    Never,
}

/// A place in a text file.
#[derive(Clone)]
pub(super) struct Tokens<'a> {
    syntax: &'static Syntax,
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

fn is_line_end(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

/// `bytes` without the byte order mark that some editors put before UTF-8.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}

/// The finite or non-finite number a token spells.
pub(super) fn number(token: &[u8]) -> Option<f64> {
    decimal::parse(token).or_else(|| spells_nan(token).then_some(f64::NAN))
}

/// Whether a C library printed this for NaN or infinity: `-nan(ind)`, `1.#QNAN`, `-1.#INF`.
fn spells_nan(text: &[u8]) -> bool {
    let signs = text.iter().take_while(|byte| matches!(byte, b'-' | b'+')).count();
    text[signs..].starts_with(b"nan(") || text[signs..].starts_with(b"1.#")
}

impl<'a> Tokens<'a> {
    pub fn new(bytes: &'a [u8], syntax: &'static Syntax) -> Tokens<'a> {
        Tokens::starting_at(bytes, bytes.len() - without_mark(bytes).len(), 1, syntax)
    }

    /// Tokens from byte `at`, which is in line `line`.
    pub fn starting_at(bytes: &'a [u8], at: usize, line: usize, syntax: &'static Syntax) -> Tokens<'a> {
        Tokens { syntax, bytes, at, line }
    }

    /// Bytes that are still to be read.
    pub fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Whether the last token was cut off by the end of the file, or may have been.
    pub fn is_at_end(&self) -> bool {
        self.remaining() == 0
    }

    /// The next token of the file.
    #[inline]
    pub fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(token) = self.next_in_line() {
                return Some(token);
            }
            if self.is_at_end() {
                return None;
            }
            self.end_line();
        }
    }

    /// The next token before the end of this line.
    #[inline]
    pub fn next_in_line(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let start = self.at;
        let rest = &self.bytes[start..];
        let length = rest.iter().position(|&b| self.is_blank(b) || is_line_end(b)).unwrap_or(rest.len());
        let is_comment = self.syntax.comments.iter().any(|mark| rest.starts_with(mark));
        if length == 0 || is_comment {
            return None;
        }
        self.at += length;
        Some(&rest[..length])
    }

    /// Moves to the start of the next line.
    pub fn end_line(&mut self) {
        let rest = &self.bytes[self.at..];
        let Some(length) = rest.iter().position(|&b| is_line_end(b)) else {
            self.at = self.bytes.len();
            return;
        };
        self.at += length + if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        self.line += 1;
    }

    fn is_blank(&self, byte: u8) -> bool {
        match byte {
            b' ' | b'\t' | 0x0B | 0x0C => true,
            b',' | b';' => self.syntax.commas == Commas::Separate,
            _ => false,
        }
    }

    fn skip_blanks(&mut self) {
        loop {
            while self.at < self.bytes.len() && self.is_blank(self.bytes[self.at]) {
                self.at += 1;
            }
            let rest = &self.bytes[self.at..];
            let is_continued = self.syntax.continuation == Continuation::Backslash
                && rest.first() == Some(&b'\\')
                && rest.get(1).is_some_and(|&b| is_line_end(b));
            if !is_continued {
                return;
            }
            self.end_line();
        }
    }

    /// The next `N` numbers of the file; `None` when the file ends before or in them.
    pub fn numbers<const N: usize>(&mut self, what: &str) -> Result<Option<[f64; N]>, ReadError> {
        self.collect(what, Tokens::next)
    }

    /// The next `N` numbers of this line; `None` when the file ends before or in them.
    pub fn numbers_in_line<const N: usize>(&mut self, what: &str) -> Result<Option<[f64; N]>, ReadError> {
        self.collect(what, Tokens::next_in_line)
    }

    #[inline]
    fn collect<const N: usize>(
        &mut self,
        what: &str,
        next: impl Fn(&mut Tokens<'a>) -> Option<&'a [u8]>,
    ) -> Result<Option<[f64; N]>, ReadError> {
        let mut values = [0.0; N];
        for value in &mut values {
            let token = next(self);
            match token.and_then(number) {
                Some(number) => *value = number,
                None if self.is_at_end() => return Ok(None),
                None => return Err(self.expected(what, token)),
            }
        }
        Ok(Some(values))
    }

    /// The error that `what` was expected in this line but `found` was there; `None` is the end of the line.
    #[cold]
    pub fn expected(&self, what: &str, found: Option<&[u8]>) -> ReadError {
        let found = match found {
            Some(token) => quote(token),
            None if self.is_at_end() => "the end of the file".to_owned(),
            None => "the end of the line".to_owned(),
        };
        self.error(format!("{what}, found {found}"))
    }

    /// The error in this line that `expected` tells.
    #[cold]
    pub fn error(&self, expected: String) -> ReadError {
        ReadError::Parse { format: self.syntax.format, at: Location::Line(self.line), expected }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    static SYNTAX: Syntax = Syntax {
        format: Format::Xyz,
        commas: Commas::Separate,
        comments: &[b"#", b"//"],
        continuation: Continuation::Backslash,
    };

    #[test]
    fn lines_end_in_any_way_and_are_counted() {
        let text = b"\xEF\xBB\xBFa,b # no\r\nc \\\nd\r\r// no\ne";
        let mut tokens = Tokens::new(text, &SYNTAX);
        let mut seen = Vec::new();
        while let Some(token) = tokens.next() {
            seen.push((std::str::from_utf8(token).unwrap(), tokens.line));
        }
        assert_eq!(seen, [("a", 1), ("b", 1), ("c", 2), ("d", 3), ("e", 6)]);
        assert!(tokens.is_at_end());
    }

    #[test]
    fn numbers_are_read_as_c_libraries_print_them() {
        assert_eq!(number(b"-1.5e+3"), Some(-1500.0));
        assert_eq!(number(b".5"), Some(0.5));
        for spelling in ["nan", "NaN", "-nan(ind)", "1.#QNAN", "-1.#IND000"] {
            assert!(number(spelling.as_bytes()).is_some_and(f64::is_nan), "{spelling}");
        }
        assert_eq!(number(b"1.0.0"), None);
        assert_eq!(number(b"0x10"), None);
    }

    #[test]
    fn missing_number_names_its_line_and_what_stood_there() {
        let mut tokens = Tokens::new(b"1 2\n3 x 4", &SYNTAX);
        assert_eq!(tokens.numbers_in_line("x and y"), Ok(Some([1.0, 2.0])));
        tokens.end_line();
        let error = tokens.numbers_in_line::<3>("a corner").unwrap_err();
        assert_eq!(error.to_string(), "the XYZ file cannot be read in line 2: expected a corner, found 'x'");
    }
}
