//! Features that arrive one after the other.

mod common;

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Command, Stdio};

use common::medial_with;

/// Features go in until the first results come out, which they must do before the input ends.
fn answers_while_it_reads(from: &str, feature: &str) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_medial"))
        .args(["axis", "-", "--from", from, "--to", "wkt", "--threads", "1"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let output = BufReader::new(child.stdout.take().unwrap());
    let (send, receive) = std::sync::mpsc::channel();
    let reader = std::thread::spawn(move || {
        let mut n = 0;
        for line in output.lines() {
            assert!(line.unwrap().starts_with("MULTILINESTRING"));
            n += 1;
            let _ = send.send(());
        }
        n
    });
    let mut written = 0;
    while receive.try_recv().is_err() {
        assert!(written < 100_000, "nothing comes before the end");
        writeln!(input, "{feature}").unwrap();
        written += 1;
    }
    drop(input);
    assert_eq!(reader.join().unwrap(), written);
    assert!(child.wait().unwrap().success());
}

#[test]
fn results_come_while_features_arrive() {
    answers_while_it_reads("wkt", "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))");
    let feature = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[6,0],[6,2],[0,2],[0,0]]]}";
    answers_while_it_reads("geojsonl", feature);
}

#[test]
fn the_format_of_a_stream_is_told_by_its_beginning() {
    let wkt = medial_with(&["axis", "-", "--to", "wkt"], "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))\n");
    assert_eq!(wkt.status, Some(0));
    let polygon = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[6,0],[6,2],[0,2],[0,0]]]}";
    let one = medial_with(&["axis", "-", "--to", "wkt"], polygon);
    let two = medial_with(&["axis", "-", "--to", "wkt"], &format!("\n{polygon}\n\n{polygon}\n"));
    assert_eq!(one.text(), wkt.text());
    assert_eq!(two.text(), wkt.text().repeat(2));
    let bad = medial_with(
        &["axis", "-", "--to", "wkt"],
        &format!("{polygon}\n{polygon}\nfoo\n{polygon}"),
    );
    assert_eq!((bad.status, bad.text()), (Some(3), wkt.text().repeat(3).as_str()));
    assert!(bad.errors.contains("<stdin>: feature 2: line 3, column"), "{}", bad.errors);
}
