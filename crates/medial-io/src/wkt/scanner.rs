use crate::Error;
use crate::text::syntax_at;

/// Words, numbers and punctuation of a text, with the place of each.
pub(super) struct Scanner<'a> {
    text: &'a str,
    byte: usize,
}

/// A piece of well-known text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'a> {
    Open,
    Close,
    Comma,
    /// Letters, or what looks like a number; told apart when it is used.
    Word(&'a str),
    End,
}

impl<'a> Scanner<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, byte: 0 }
    }

    /// Skips white space and stray separators between geometries; false at the end of the text.
    pub fn at_geometry(&mut self) -> bool {
        let rest = &self.text[self.byte..];
        let skipped = rest.trim_start_matches(|c: char| c.is_whitespace() || c == ';');
        self.byte = self.text.len() - skipped.len();
        !skipped.is_empty()
    }

    /// Skips `SRID=…;` if it stands here.
    pub fn skip_srid(&mut self) {
        let rest = &self.text[self.byte..];
        if rest.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("srid=")) {
            let number = &rest[5..];
            let after = number.trim_start_matches(|c: char| c.is_ascii_digit());
            if let Some(after) = after.strip_prefix(';') {
                self.byte = self.text.len() - after.len();
            }
        }
    }

    pub fn peek(&mut self) -> Token<'a> {
        let rest = self.text[self.byte..].trim_start();
        self.byte = self.text.len() - rest.len();
        match rest.as_bytes().first() {
            None => Token::End,
            Some(b'(') => Token::Open,
            Some(b')') => Token::Close,
            Some(b',') => Token::Comma,
            Some(_) => {
                let ends = |c: char| c.is_whitespace() || "(),;".contains(c);
                Token::Word(&rest[..rest.find(ends).unwrap_or(rest.len()).max(1)])
            }
        }
    }

    pub fn take(&mut self) -> Token<'a> {
        let token = self.peek();
        self.byte += match token {
            Token::Open | Token::Close | Token::Comma => 1,
            Token::Word(word) => word.len(),
            Token::End => 0,
        };
        token
    }

    /// The error that something else was expected at the next token.
    pub fn expected(&mut self, what: &str) -> Error {
        let found = match self.peek() {
            Token::Open => "`(`".to_owned(),
            Token::Close => "`)`".to_owned(),
            Token::Comma => "`,`".to_owned(),
            Token::Word(word) => format!("`{}`", word.chars().take(40).collect::<String>()),
            Token::End => "the end of the text".to_owned(),
        };
        syntax_at(self.text, self.byte, format!("expected {what}, found {found}"))
    }

    pub fn expect(&mut self, token: Token, what: &str) -> Result<(), Error> {
        if self.peek() == token {
            self.take();
            Ok(())
        } else {
            Err(self.expected(what))
        }
    }

    /// The next token as a number.
    pub fn number(&mut self) -> Result<f64, Error> {
        if let Token::Word(word) = self.peek() {
            // Not every text Rust reads is a number in WKT, but NaN and infinities are written
            // by some; the domain refuses them with their place.
            if let Ok(value) = word.parse() {
                self.take();
                return Ok(value);
            }
        }
        Err(self.expected("a number"))
    }

    /// The next token as a number that is finite.
    pub fn finite(&mut self) -> Result<f64, Error> {
        match self.peek() {
            Token::Word(word) if word.parse().is_ok_and(|value: f64| !value.is_finite()) => {
                Err(self.expected("a finite number"))
            }
            _ => self.number(),
        }
    }

    /// The byte at which it is.
    pub fn place(&self) -> usize {
        self.byte
    }

    /// After an error in the geometry that begins at this byte: goes on to the next line that begins with
    /// a letter, which may be where it is.
    pub fn skip_to_next_geometry(&mut self, start: usize) {
        let line = self.text[..self.byte].rfind('\n').map_or(0, |at| at + 1);
        let is_blank = self.text[line..self.byte].trim_start_matches([' ', '\t']).is_empty();
        let rest = &self.text[self.byte..];
        if line > start && is_blank && rest.starts_with(char::is_alphabetic) {
            return;
        }
        let next = rest.match_indices('\n').map(|(at, _)| at + 1).find(|&at| {
            rest[at..].trim_start_matches([' ', '\t']).starts_with(|c: char| c.is_alphabetic())
        });
        self.byte = next.map_or(self.text.len(), |at| self.byte + at);
    }
}
