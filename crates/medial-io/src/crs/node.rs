//! Well-known text of reference systems as a tree [OGC 18-010r7, 6].

use std::fmt::{self, Display};

/// Deepest nesting; protects the stack against made-up input.
const MAX_NESTING: usize = 64;

/// `WORD[part, part, …]`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    /// In capitals.
    pub word: String,
    pub parts: Vec<Part>,
}

/// What is between two commas.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    /// What was in quotes.
    Text(String),
    /// A number or a word, as it was written.
    Word(String),
    Node(Node),
}

impl Node {
    pub fn new(word: &str, parts: Vec<Part>) -> Self {
        Self { word: word.to_owned(), parts }
    }

    /// Reads the systems of a text: one, or with ESRI's a vertical one behind it.
    pub fn read_all(text: &str) -> Option<Vec<Self>> {
        let mut scanner = Scanner { rest: text.trim() };
        let mut nodes = Vec::new();
        loop {
            match scanner.part(0)? {
                Part::Node(node) => nodes.push(node),
                _ => return None,
            }
            match scanner.next() {
                None => return Some(nodes),
                Some(',') => scanner.skip(),
                Some(_) => return None,
            }
        }
    }

    /// Takes all nodes with a word out, however deep.
    pub fn remove(&mut self, word: &str) {
        self.parts.retain(|part| !matches!(part, Part::Node(node) if node.word == word));
        for part in &mut self.parts {
            if let Part::Node(node) = part {
                node.remove(word);
            }
        }
    }

    /// The first text, which is the name of most things.
    pub fn name(&self) -> &str {
        match self.parts.first() {
            Some(Part::Text(text)) => text,
            Some(Part::Word(word)) => word,
            _ => "",
        }
    }

    pub fn nodes(&self) -> impl Iterator<Item = &Self> {
        self.parts.iter().filter_map(|part| match part {
            Part::Node(node) => Some(node),
            _ => None,
        })
    }

    /// The first node inside with one of these words.
    pub fn get(&self, words: &[&str]) -> Option<&Self> {
        self.nodes().find(|node| words.contains(&node.word.as_str()))
    }

    /// All nodes inside with one of these words.
    pub fn all<'a>(&'a self, words: &'a [&str]) -> impl Iterator<Item = &'a Self> {
        self.nodes().filter(move |node| words.contains(&node.word.as_str()))
    }

    /// What is said at a place, be it in quotes or not.
    pub fn text(&self, place: usize) -> Option<&str> {
        match self.parts.get(place)? {
            Part::Text(text) | Part::Word(text) => Some(text),
            Part::Node(_) => None,
        }
    }

    /// The number at a place.
    pub fn number(&self, place: usize) -> Option<f64> {
        self.text(place)?.parse().ok().filter(|number: &f64| number.is_finite())
    }
}

impl From<Node> for Part {
    fn from(node: Node) -> Self {
        Self::Node(node)
    }
}

impl Part {
    pub fn text(text: &str) -> Self {
        Self::Text(text.to_owned())
    }

    pub fn word(word: impl Display) -> Self {
        Self::Word(word.to_string())
    }
}

impl Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[", self.word)?;
        for (k, part) in self.parts.iter().enumerate() {
            if k > 0 {
                f.write_str(",")?;
            }
            match part {
                Part::Text(text) => write!(f, "\"{}\"", text.replace('"', "\"\""))?,
                Part::Word(word) => f.write_str(word)?,
                Part::Node(node) => node.fmt(f)?,
            }
        }
        f.write_str("]")
    }
}

struct Scanner<'a> {
    rest: &'a str,
}

impl Scanner<'_> {
    /// What comes next behind white space.
    fn next(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    /// Passes over the character that comes next.
    fn skip(&mut self) {
        let mut rest = self.rest.chars();
        rest.next();
        self.rest = rest.as_str();
    }

    fn part(&mut self, depth: usize) -> Option<Part> {
        if self.next()? == '"' {
            return self.quoted().map(Part::Text);
        }
        let end = self.rest.find(|c: char| "[](),\"".contains(c) || c.is_whitespace());
        let (word, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest;
        if word.is_empty() {
            return None;
        }
        let close = match self.next() {
            Some('[') => ']',
            Some('(') => ')',
            _ => return Some(Part::Word(word.to_owned())),
        };
        if depth == MAX_NESTING {
            return None;
        }
        let mut node = Node::new(&word.to_ascii_uppercase(), Vec::new());
        loop {
            // The bracket that opens, or a comma.
            self.skip();
            node.parts.push(self.part(depth + 1)?);
            match self.next()? {
                ',' => {}
                found if found == close => {
                    self.skip();
                    return Some(Part::Node(node));
                }
                _ => return None,
            }
        }
    }

    /// A text in quotes; two of them stand for one in it.
    fn quoted(&mut self) -> Option<String> {
        let mut text = String::new();
        loop {
            self.skip();
            let end = self.rest.find('"')?;
            text.push_str(&self.rest[..end]);
            self.rest = &self.rest[end + 1..];
            if !self.rest.starts_with('"') {
                return Some(text);
            }
            text.push('"');
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_printed_as_it_was_read() {
        let text = "PROJCS[\"a \"\"b\"\"\",GEOGCS[\"c\",UNIT[\"d\",0.01745]],AXIS[\"E\",EAST]]";
        let nodes = Node::read_all(text).unwrap();
        assert_eq!((nodes.len(), nodes[0].name()), (1, "a \"b\""));
        assert_eq!(nodes[0].to_string(), text);
        let spaced =
            "projcs (\"a \"\"b\"\"\" , GEOGCS[ \"c\",\n UNIT[\"d\", 0.01745]], AXIS[\"E\",EAST])";
        assert_eq!(Node::read_all(spaced).unwrap(), nodes);
    }

    #[test]
    fn broken_texts_are_none() {
        for text in ["", "A[", "A[]", "A[\"b]", "A[1,]", "A[1)", "A[1]]", "A", "\"A\"", "A[1],"] {
            assert_eq!(Node::read_all(text), None, "{text}");
        }
        assert_eq!(Node::read_all(&"A[".repeat(100_000)), None);
    }
}
