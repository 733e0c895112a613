//! What help says, done.

#![cfg(unix)]

mod common;

use common::{fixtures, medial};
use std::path::Path;
use std::process::Command;

#[test]
fn the_examples_of_every_command_work() {
    for command in [
        "axis",
        "prune",
        "centerline",
        "offset",
        "clearance",
        "carve",
        "walls",
        "voronoi",
        "locate",
        "check",
        "compare",
        "compress",
        "segment",
        "image",
    ] {
        let help = medial(&[command, "--help"]);
        assert_eq!((help.status, help.errors.as_str()), (Some(0), ""));
        let text = help.text().to_owned();
        let after = text.split("Examples:\n").nth(1).unwrap();
        let examples: Vec<&str> = after.lines().take_while(|line| line.starts_with("  ")).collect();
        assert!(examples.len() >= 2, "{text}");
        let folder = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink(fixtures(), folder.path().join("fixtures")).unwrap();
        let program = Path::new(env!("CARGO_BIN_EXE_medial")).parent().unwrap();
        let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
        for example in examples {
            let output = Command::new("bash")
                .args(["-o", "pipefail", "-c", example])
                .current_dir(folder.path())
                .env("PATH", &path)
                .output()
                .unwrap();
            let errors = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!((output.status.code(), errors.as_str()), (Some(0), ""), "{example}");
        }
    }
}

#[test]
fn help_and_version_go_to_standard_output() {
    let version = medial(&["--version"]);
    assert_eq!(version.status, Some(0));
    assert!(version.text().starts_with("medial "));
    let help = medial(&["--help"]);
    assert_eq!(help.status, Some(0));
    for word in [
        "axis",
        "prune",
        "centerline",
        "voronoi",
        "locate",
        "check",
        "compare",
        "compress",
        "Exit status",
    ] {
        assert!(help.text().contains(word), "{word}");
    }
}
