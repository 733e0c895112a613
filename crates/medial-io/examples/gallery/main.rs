//! The figures of [JPV], drawn again from values the library returns, as twelve lessons.
//!
//! `cargo run -p medial-io --example gallery -- DIR` writes them, and a README, into a folder.
//! Nothing here computes an axis: the shapes are given, all else is asked of `medial`.

mod bounds;
mod lesson;
mod shape;
mod sheet;
mod style;

mod fig_01;
mod fig_02;
mod fig_03;
mod fig_04;
mod fig_05;
mod fig_06;
mod fig_07;
mod fig_08;
mod fig_09;

use lesson::Lesson;
use shape::Fallible;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

const LESSONS: [Lesson; 9] = [
    fig_01::LESSON,
    fig_02::LESSON,
    fig_03::LESSON,
    fig_04::LESSON,
    fig_05::LESSON,
    fig_06::LESSON,
    fig_07::LESSON,
    fig_08::LESSON,
    fig_09::LESSON,
];

fn main() -> Fallible<()> {
    let folder =
        std::env::args_os().nth(1).map_or_else(|| PathBuf::from("docs/gallery"), PathBuf::from);
    fs::create_dir_all(&folder)?;
    let mut readme = "# Gallery\n\n".to_owned();
    for (number, lesson) in (1..).zip(&LESSONS) {
        let name = format!("fig-{number:02}.svg");
        fs::write(folder.join(&name), (lesson.draw)()?)?;
        let Lesson { title, text, .. } = lesson;
        let _ = write!(readme, "## {number}. {title}\n\n![{title}]({name})\n\n{text}\n\n");
    }
    fs::write(folder.join("README.md"), readme)?;
    Ok(())
}
