//! The figures of [JPV], drawn again from values the library returns, as twelve lessons; those of [Lee82];
//! and more pictures.
//!
//! `cargo run -p medial-io --example gallery -- DIR` writes them, and a README, into a folder.
//! Nothing here computes an axis: the shapes are given, all else is asked of `medial`.

mod both_sides;
mod bounds;
mod branches;
mod carving;
mod compress;
mod compress_cells;
mod lake;
mod lee;
mod lee_1_2;
mod lee_5;
mod lee_6;
mod lee_7;
mod lee_8;
mod lee_9_11;
mod lesson;
mod letter;
mod offsets;
mod profile;
mod pruned;
mod shape;
mod sheet;
mod smooth;
mod style;
mod voronoi;
mod vsc_14;

mod fig_01;
mod fig_02;
mod fig_03;
mod fig_04;
mod fig_05;
mod fig_06;
mod fig_07;
mod fig_08;
mod fig_09;
mod fig_10;
mod fig_11;
mod fig_12;

use lesson::Lesson;
use shape::Fallible;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

const LESSONS: [Lesson; 12] = [
    fig_01::LESSON,
    fig_02::LESSON,
    fig_03::LESSON,
    fig_04::LESSON,
    fig_05::LESSON,
    fig_06::LESSON,
    fig_07::LESSON,
    fig_08::LESSON,
    fig_09::LESSON,
    fig_10::LESSON,
    fig_11::LESSON,
    fig_12::LESSON,
];

/// Pictures besides, each in a file of its name.
const PICTURES: [(&str, Lesson); 19] = [
    ("lee-1-2", lee_1_2::LESSON),
    ("voronoi", voronoi::LESSON),
    ("both-sides", both_sides::LESSON),
    ("lee-5", lee_5::LESSON),
    ("lee-6", lee_6::LESSON),
    ("lee-7", lee_7::LESSON),
    ("lee-8", lee_8::LESSON),
    ("lee-9-11", lee_9_11::LESSON),
    ("letter", letter::LESSON),
    ("lake", lake::LESSON),
    ("pruned", pruned::LESSON),
    ("branches", branches::LESSON),
    ("smooth", smooth::LESSON),
    ("compress", compress::LESSON),
    ("compress-cells", compress_cells::LESSON),
    ("vsc-14", vsc_14::LESSON),
    ("offsets", offsets::LESSON),
    ("profile", profile::LESSON),
    ("carving", carving::LESSON),
];

const HEAD: &str = "\
# Gallery

The twelve figures of [JPV] and the eleven of [Lee82] (see [REFERENCES.md](../../REFERENCES.md)), drawn again, and a few real shapes.
Nothing here is drawn by hand: [the example `gallery`](../../crates/medial-io/examples/gallery/main.rs) gives the polygons, or takes those of `fixtures/lee`, and draws what the library returns for them, an axis after `check::defects` has found nothing wrong with it.
`scripts/figures` draws everything anew.

";

const RIVER: &str = "\
## Pictures and maps

[Axes of pictures](../images.md) has lakes, a scanned map, clouds and a coast, with the crust, the Delaunay graph and its dual.

## The river of the README

![A stretch of river with its medial axis](../river.svg)

`medial axis fixtures/river.geojson -o docs/river.svg` draws it.
The axis ends in every convex corner, also in those of a rounded bend, which look like one.
";

fn main() -> Fallible<()> {
    let folder =
        std::env::args_os().nth(1).map_or_else(|| PathBuf::from("docs/gallery"), PathBuf::from);
    fs::create_dir_all(&folder)?;
    let mut readme = HEAD.to_owned();
    for (number, lesson) in (1..).zip(&LESSONS) {
        let heading = format!("{number}. {}", lesson.title);
        draw(&folder, &format!("fig-{number:02}.svg"), &heading, lesson, &mut readme)?;
    }
    for (name, picture) in &PICTURES {
        draw(&folder, &format!("{name}.svg"), picture.title, picture, &mut readme)?;
    }
    fs::write(folder.join("README.md"), readme + RIVER)?;
    Ok(())
}

/// Draws one figure, and adds it to the text.
fn draw(
    folder: &Path,
    file: &str,
    heading: &str,
    lesson: &Lesson,
    text: &mut String,
) -> Fallible<()> {
    fs::write(folder.join(file), (lesson.draw)()?)?;
    // Names with an index are set lower in figures; the text has them in italics.
    let words: Vec<String> = lesson.text.split(' ').map(italic).collect();
    let _ = write!(text, "## {heading}\n\n![{}]({file})\n\n{}\n\n", lesson.title, words.join(" "));
    Ok(())
}

/// A word such as `v_1`, with what follows it, as Markdown.
fn italic(word: &str) -> String {
    match word.split_once('_') {
        Some((letter, rest)) if letter.len() == 1 && !rest.is_empty() => {
            let (low, after) = rest.split_at(1);
            format!("*{letter}*<sub>{low}</sub>{after}")
        }
        _ => word.to_owned(),
    }
}
