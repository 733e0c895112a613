//! Points that somebody chose, each with what it is to do.
//!
//! # Contract
//! Values between commas, semicolons or tabs with a first row that names the columns `action`, `x` and `y` in any order,
//! others being passed over; without a column `action` each point is to `add`. Or JSON lines, each an object with `x`
//! and `y` and, if it is not `add`, an `action`. Blank lines, and lines that start with `#`, are passed over.

use crate::{Error, text};
use medial::geom::Point;
use serde::Deserialize;

/// One of the points.
#[derive(Clone, Debug, PartialEq)]
pub struct ClickRow {
    /// Its line, from 1.
    pub line: usize,
    /// The word for what it does.
    pub action: String,
    /// Where it is.
    pub at: Point,
}

#[derive(Deserialize)]
struct JsonRow {
    #[serde(default = "add")]
    action: String,
    x: f64,
    y: f64,
}

fn add() -> String {
    "add".to_owned()
}

/// Reads the points of a file, in their order.
///
/// ```
/// use medial_io::clicks;
/// let rows = clicks::read(b"action,x,y\nadd,3.5,-2\nremove,7,-1\n")?;
/// assert_eq!((rows[1].line, rows[1].action.as_str(), rows[1].at.x), (3, "remove", 7.0));
/// assert_eq!(clicks::read(br#"{"x": 3.5, "y": -2}"#)?[0].at, rows[0].at);
/// # Ok::<(), medial_io::Error>(())
/// ```
///
/// # Errors
/// If there is no point, a column is missing, or a row has no two finite coordinates.
pub fn read(bytes: &[u8]) -> Result<Vec<ClickRow>, Error> {
    let lines = (1..).zip(text(bytes)?.lines().map(str::trim));
    let is_said = |line: &(usize, &str)| !line.1.is_empty() && !line.1.starts_with('#');
    let lines: Vec<(usize, &str)> = lines.filter(is_said).collect();
    let rows = match lines.first() {
        None => return Err(Error::Empty),
        Some((_, first)) if first.starts_with('{') => {
            lines.iter().map(|&(line, text)| of_json(line, text)).collect::<Result<Vec<_>, _>>()?
        }
        Some(_) => of_table(&lines)?,
    };
    if rows.is_empty() { Err(Error::Empty) } else { Ok(rows) }
}

fn of_json(line: usize, text: &str) -> Result<ClickRow, Error> {
    let row: JsonRow = serde_json::from_str(text).map_err(|error| {
        let why = error.to_string();
        let why = why.split(" at line ").next().unwrap_or_default();
        let why =
            format!(r#"{why}; a line is an object such as {{"action": "add", "x": 3, "y": -2}}"#);
        Error::Syntax { line, column: error.column(), why }
    })?;
    // Numbers of JSON are finite.
    Ok(ClickRow { line, action: row.action, at: Point::new(row.x, row.y) })
}

fn of_table(lines: &[(usize, &str)]) -> Result<Vec<ClickRow>, Error> {
    let separator = [',', ';', '\t'].into_iter().find(|&c| lines[0].1.contains(c)).unwrap_or(',');
    let values = |text: &str| -> Vec<String> {
        text.split(separator).map(|value| value.trim().trim_matches('"').to_owned()).collect()
    };
    let wrong = |line: usize, why: String| Error::Syntax { line, column: 1, why };
    let (first, head) = (lines[0].0, values(lines[0].1));
    let column = |name: &str| head.iter().position(|value| value.eq_ignore_ascii_case(name));
    let [Some(x), Some(y)] = ["x", "y"].map(column) else {
        let why = "the first row has to name the columns x and y, as action,x,y".to_owned();
        return Err(wrong(first, why));
    };
    let action = column("action");
    let row = |&(line, text): &(usize, &str)| {
        let values = values(text);
        let number = |column: usize, name: &str| {
            let value = values.get(column).and_then(|value| value.parse::<f64>().ok());
            value
                .filter(|value| value.is_finite())
                .ok_or_else(|| wrong(line, format!("there is no finite number for {name}")))
        };
        let at = Point::new(number(x, "x")?, number(y, "y")?);
        let action =
            action.map_or_else(add, |column| values.get(column).cloned().unwrap_or_default());
        Ok(ClickRow { line, action, at })
    };
    lines[1..].iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_come_in_any_order_and_comments_are_passed_over() {
        let rows = read(b"# clicks\ny,x,action\n\n-2, 1 ,combine\n").unwrap();
        let expected =
            ClickRow { line: 4, action: "combine".to_owned(), at: Point::new(1.0, -2.0) };
        assert_eq!(rows, [expected]);
        assert_eq!(read(b"x,y\n1,2\n").unwrap()[0].action, "add");
        for text in ["action;x;y\nadd;1;-2\n", "x\ty\n1\t-2\n"] {
            let [row] = &read(text.as_bytes()).unwrap()[..] else { panic!("{text}") };
            assert_eq!((row.action.as_str(), row.at), ("add", Point::new(1.0, -2.0)), "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, why) in [
            (
                "1,2\n3,4\n",
                "line 1, column 1: the first row has to name the columns x and y, as action,x,y",
            ),
            ("x,y\n1,two\n", "line 2, column 1: there is no finite number for y"),
            ("x,y\n1\n", "line 2, column 1: there is no finite number for y"),
            ("x,y\n", "the input is empty"),
            ("\n", "the input is empty"),
        ] {
            assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), why, "{text}");
        }
        let error = read(b"{\"x\": 1, \"y\": 2}\n{\"x\": 1}").unwrap_err().to_string();
        assert!(error.starts_with("line 2, column 8: missing field `y`; a line is"), "{error}");
    }
}
