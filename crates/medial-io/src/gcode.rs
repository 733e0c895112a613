//! G-code: a tool path as a plain program for a milling machine or router.
//!
//! # Contract
//! Absolute coordinates in one unit, feeds by the minute, in the plane XY, no cutter compensation, no
//! subroutines and no canned cycles: what LinuxCNC, Grbl and their like all read. Each pass begins and ends at the
//! safe height, above which nothing is cut. Straight moves are `G1`, arcs at one height `G2` and `G3` with `I` and `J`; curves are drawn
//! within a tolerance. If a floor is cleared by a tool of its own, the program pauses for it once. What would
//! not be the same after rounding, a height or a feed of nothing, is refused before.

use medial::geom::{Point, Rect};
use medial::ops::{Carving, Move, Role, Sense, Tip, carving_order};
use std::fmt::Write as _;

/// The unit of all lengths of a program, which is that of the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millimetres.
    Millimetre,
    /// Inches.
    Inch,
}

impl Unit {
    /// Decimals that machines are given.
    const fn decimals(self) -> usize {
        match self {
            Self::Millimetre => 4,
            Self::Inch => 5,
        }
    }
}

/// How a machine is run; lengths are in the unit, feeds in units a minute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Machine {
    /// The unit of all lengths.
    pub unit: Unit,
    /// Feed of cutting moves.
    pub feed: f64,
    /// Feed on the way down into the material.
    pub plunge: f64,
    /// Height over the material at which moves are rapid.
    pub safe_height: f64,
    /// Turns of the spindle a minute; it is not switched if not given.
    pub spindle: Option<f64>,
}

/// Why there is no program.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GCodeError {
    /// A number of the machine is written with few decimals, or digits.
    #[error("the {name} {value} is {rounded} as it is written; give one from {least} to {MOST}")]
    Machine {
        /// Which one.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it becomes.
        rounded: String,
        /// The least that goes.
        least: f64,
    },
    /// A shape is so small that little of it is left by the decimals, or larger than any machine.
    #[error(
        "the tool path is {size} across, for coordinates with {decimals} decimals; scale the shape"
    )]
    Size {
        /// The longer side of its box.
        size: f64,
        /// Decimals of coordinates.
        decimals: usize,
    },
    /// A shape is farther from the origin than any machine reaches.
    #[error("the tool path reaches to ({x}, {y}, {z}); move or scale the shape to within {MOST}")]
    Far {
        /// Where it does.
        x: f64,
        /// Where it does.
        y: f64,
        /// Where it does.
        z: f64,
    },
}

/// The largest number in a program.
const MOST: f64 = 1e7;

/// The least size of a tool path, in steps of the last decimal.
const FINE: f64 = 100.0;

/// Most characters of the comment at the beginning: controllers have short lines.
const COMMENT: usize = 60;

impl Machine {
    /// Whether all numbers are the same to a machine, but for rounding.
    ///
    /// # Errors
    /// If one of them would be nothing, or is too large.
    pub fn check(&self) -> Result<(), GCodeError> {
        let step = |decimals: usize| 0.1_f64.powi(decimals as i32);
        let length = self.unit.decimals();
        let numbers = [
            ("feed", Some(self.feed), FEED),
            ("feed on the way down", Some(self.plunge), FEED),
            ("safe height", Some(self.safe_height), length),
            ("turns of the spindle", self.spindle, 0),
        ];
        for (name, value, decimals) in numbers {
            let Some(value) = value else { continue };
            let least = step(decimals);
            if !(least..=MOST).contains(&value) {
                let rounded = if value < least { "0" } else { "too much" }.to_owned();
                return Err(GCodeError::Machine { name, value, rounded, least });
            }
        }
        Ok(())
    }

    /// Whether a tool path is of a size that a machine has.
    ///
    /// # Errors
    /// If it is too small for the decimals of its coordinates, or reaches too far.
    pub fn check_path(&self, path: &Carving) -> Result<(), GCodeError> {
        let tips = || path.moves.iter().flat_map(|(_, cut)| [cut.from(), cut.to()]);
        let far = |tip: &Tip| tip.point.x.abs().max(tip.point.y.abs()).max(-tip.z);
        let is_far = |tip: &Tip| far(tip).is_nan() || far(tip) > MOST;
        if let Some(Tip { point: Point { x, y }, z }) = tips().find(is_far) {
            return Err(GCodeError::Far { x, y, z });
        }
        let bounds = tips().fold(Rect::EMPTY, |all, tip| all.with(tip.point));
        let deepest = tips().map(|tip| -tip.z).fold(0.0, f64::max);
        let sides = bounds.max - bounds.min;
        // A point to drill has a depth.
        let size = sides.x.max(sides.y).max(deepest);
        let decimals = self.unit.decimals();
        if !path.moves.is_empty() && size < FINE * 0.1_f64.powi(decimals as i32) {
            return Err(GCodeError::Size { size, decimals });
        }
        Ok(())
    }
}

/// Decimals of feeds.
const FEED: usize = 3;

/// Chord of an arc, in steps of the last decimal, up to which it is written as a line: with both ends rounded
/// to one place it would be a full circle.
const SHORT: f64 = 100.0;

/// A program that cuts some tool paths, each with the tolerance within which its curves are drawn, one after
/// another as they are near; its title is a comment at the beginning.
///
/// # Errors
/// If the machine or one of the paths does not pass its check.
pub fn write(
    paths: &[(Carving, f64)],
    machine: &Machine,
    title: &str,
) -> Result<String, GCodeError> {
    machine.check()?;
    paths.iter().try_for_each(|(path, _)| machine.check_path(path))?;
    let order = carving_order(&paths.iter().map(|(path, _)| path).collect::<Vec<_>>());
    let paths: Vec<&(Carving, f64)> = order.iter().map(|&k| &paths[k]).collect();
    let mut program = Program { text: String::new(), machine, at: None, feed: None };
    let comment: String = title
        .chars()
        .filter(|c| (' '..='~').contains(c) && !"()".contains(*c))
        .take(COMMENT)
        .collect();
    let unit = match machine.unit {
        Unit::Millimetre => "G21",
        Unit::Inch => "G20",
    };
    program.line(&format!("({comment})"));
    program.line(&format!("{unit} G90 G94 G17 G40"));
    program.start();
    program.passes(&paths, false);
    if paths.iter().any(|(path, _)| path.passes.iter().any(|pass| by_other_tool(path, pass))) {
        program.stop();
        program.line("M0 (fit the tool that clears the floor)");
        program.start();
        program.passes(&paths, true);
    }
    program.stop();
    program.line("M2");
    Ok(program.text)
}

/// Whether a pass is made by a tool of its own, and not by the bit.
fn by_other_tool(path: &Carving, pass: &[(u32, bool)]) -> bool {
    path.role(pass) == Some(Role::Floor) && path.clearing.is_some_and(|tool| tool.radius > 0.0)
}

struct Program<'a> {
    text: String,
    machine: &'a Machine,
    /// Where the tool is, as written.
    at: Option<[String; 3]>,
    feed: Option<f64>,
}

impl Program<'_> {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn start(&mut self) {
        self.rise();
        if let Some(turns) = self.machine.spindle {
            let turns = plain(turns, 0);
            self.line(&format!("M3 S{turns}"));
        }
    }

    fn stop(&mut self) {
        self.rise();
        if self.machine.spindle.is_some() {
            self.line("M5");
        }
    }

    /// Up to the safe height; from where, it need not be known.
    fn rise(&mut self) {
        let z = self.number(self.machine.safe_height);
        self.line(&format!("G0 Z{z}"));
        self.at = None;
    }

    /// The passes of the bit, or those of the tool that clears the floor.
    fn passes(&mut self, paths: &[&(Carving, f64)], floor: bool) {
        for (path, tolerance) in paths {
            for pass in &path.passes {
                if by_other_tool(path, pass) == floor {
                    self.pass(path.steps(pass).map(|(_, cut)| cut), *tolerance);
                }
            }
        }
    }

    fn pass(&mut self, moves: impl Iterator<Item = Move>, tolerance: f64) {
        for (k, cut) in moves.enumerate() {
            if k == 0 {
                let [x, y, z] = self.place(cut.from());
                self.line(&format!("G0 X{x} Y{y}"));
                let feed = plain(self.machine.plunge, FEED);
                self.line(&format!("G1 Z{z} F{feed}"));
                self.feed = Some(self.machine.plunge);
                self.at = Some([x, y, z]);
            }
            match cut {
                Move::Arc { from, to, centre, sense, .. } if self.is_long(from, to) => {
                    self.arc(from, to, centre, sense);
                }
                _ => cut.polyline(tolerance).into_iter().skip(1).for_each(|tip| self.straight(tip)),
            }
        }
        self.rise();
    }

    fn straight(&mut self, tip: Tip) {
        let place = self.place(tip);
        let Some(at) = &self.at else { return };
        let words: String = ["X", "Y", "Z"]
            .iter()
            .zip(at.iter().zip(&place))
            .filter(|(_, (before, now))| before != now)
            .map(|(word, (_, now))| format!(" {word}{now}"))
            .collect();
        if !words.is_empty() {
            let feed = self.cutting();
            self.line(&format!("G1{words}{feed}"));
            self.at = Some(place);
        }
    }

    fn arc(&mut self, from: Tip, to: Tip, centre: Point, sense: Sense) {
        let word = match sense {
            Sense::Clockwise => "G2",
            Sense::Counterclockwise => "G3",
        };
        let place = self.place(to);
        let [i, j] = [centre.x - from.point.x, centre.y - from.point.y].map(|v| self.number(v));
        let feed = self.cutting();
        self.line(&format!("{word} X{} Y{} I{i} J{j}{feed}", place[0], place[1]));
        self.at = Some(place);
    }

    /// Whether an arc is long enough for its centre to say which it is.
    fn is_long(&self, from: Tip, to: Tip) -> bool {
        let step = 0.1_f64.powi(self.machine.unit.decimals() as i32);
        (to.point - from.point).norm() > SHORT * step
    }

    /// The word for the feed of a cut, if it is another one now.
    fn cutting(&mut self) -> String {
        let feed = self.machine.feed;
        if self.feed.replace(feed) == Some(feed) {
            return String::new();
        }
        format!(" F{}", plain(feed, FEED))
    }

    fn place(&self, tip: Tip) -> [String; 3] {
        [tip.point.x, tip.point.y, tip.z].map(|v| self.number(v))
    }

    fn number(&self, value: f64) -> String {
        plain(value, self.machine.unit.decimals())
    }
}

/// A number with so many decimals at most.
fn plain(value: f64, decimals: usize) -> String {
    let mut text = String::new();
    let _ = write!(text, "{value:.decimals$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    if text == "-0" { "0".to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::domain::{Domain, Options};
    use medial::ops::{CarveOptions, Clearing, carve};

    const MACHINE: Machine = Machine {
        unit: Unit::Millimetre,
        feed: 600.0,
        plunge: 200.0,
        safe_height: 5.0,
        spindle: None,
    };

    fn carved(ring: &[(f64, f64)], options: &CarveOptions) -> Carving {
        let ring = ring.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let domain = Domain::from_polygons(&[vec![ring]], &Options::default()).unwrap();
        carve(&domain, &medial::engine::path_tracing(&domain).unwrap(), options).unwrap()
    }

    /// A machine that does what a program says: how often it plunges, the way it cuts, and the deepest it
    /// gets. It fails on what no machine would do.
    fn run(program: &str) -> (usize, f64, f64) {
        let (mut at, mut mode) = ([0.0_f64; 3], "");
        let (mut plunges, mut way, mut deepest) = (0, 0.0, 0.0_f64);
        for line in program.lines() {
            let line = line.split('(').next().unwrap();
            let mut to = at;
            let mut offset = [0.0; 2];
            for word in line.split_whitespace() {
                let value = || word[1..].parse::<f64>().unwrap();
                match &word[..1] {
                    "G" if ["G0", "G1", "G2", "G3"].contains(&word) => mode = &word[..2],
                    "X" => to[0] = value(),
                    "Y" => to[1] = value(),
                    "Z" => to[2] = value(),
                    "I" => offset[0] = value(),
                    "J" => offset[1] = value(),
                    "G" | "M" | "F" | "S" => {}
                    _ => panic!("{line}"),
                }
            }
            let moved = (0..3).any(|k| at[k] != to[k]);
            if moved {
                let level = (to[0] - at[0]).hypot(to[1] - at[1]);
                match mode {
                    // Rapid moves are made above the material, or straight up.
                    "G0" => assert!(level == 0.0 && to[2] >= at[2] || at[2] >= 5.0, "{line}"),
                    "G1" if at[2] == 5.0 => {
                        assert_eq!(level, 0.0, "{line}");
                        plunges += 1;
                    }
                    "G1" => way += level.hypot(to[2] - at[2]),
                    _ => {
                        let centre = [at[0] + offset[0], at[1] + offset[1]];
                        let r = |p: [f64; 3]| (p[0] - centre[0]).hypot(p[1] - centre[1]);
                        assert!((r(at) - r(to)).abs() < 5e-4, "{line}");
                        way += level;
                    }
                }
                deepest = deepest.min(to[2]);
            }
            at = to;
        }
        assert_eq!(at[2], 5.0, "the tool stays down");
        (plunges, way, deepest)
    }

    #[test]
    fn a_program_cuts_all_passes_from_the_safe_height() {
        let l = [(0., 0.), (20., 0.), (20., 10.), (10., 10.), (10., 20.), (0., 20.)];
        let path = carved(&l, &CarveOptions::with_angle(90.0));
        let (passes, length) = (path.passes.len(), path.length());
        let program = write(&[(path, 1e-3)], &MACHINE, "an (L)\n").unwrap();
        assert!(program.starts_with("(an L)\nG21 G90 G94 G17 G40\nG0 Z5\n"), "{program}");
        assert!(program.ends_with("G0 Z5\nM2\n"), "{program}");
        let (plunges, way, deepest) = run(&program);
        assert_eq!(plunges, passes);
        assert!((way - length).abs() < 0.01 * length, "{way} {length}");
        assert!((deepest + (5.0 + 25.0 / 40.0 - 5.0 / 8.0)).abs() < 1.0, "{deepest}");
    }

    #[test]
    fn the_floor_is_cleared_after_a_pause_and_arcs_are_arcs() {
        let l = [(0., 0.), (20., 0.), (20., 10.), (10., 10.), (10., 20.), (0., 20.)];
        let clearing = Some(Clearing { radius: 1.0, step: 1.0 });
        let options = CarveOptions { depth: Some(2.0), clearing, ..CarveOptions::with_angle(90.0) };
        let machine = Machine { spindle: Some(18000.0), ..MACHINE };
        let program = write(&[(carved(&l, &options), 1e-3)], &machine, "l").unwrap();
        let (before, after) = program.split_once("M0 ").unwrap();
        assert_eq!((before.matches("M3 S18000\n").count(), before.matches("M5\n").count()), (1, 1));
        assert!(after.contains("M3 S18000\n") && after.contains("G2 X") && after.contains(" I"));
        assert_eq!(run(&program).2, -2.0);
        let inch = Machine { unit: Unit::Inch, ..MACHINE };
        let paths = [(carved(&l, &options), 1e-3)];
        assert!(write(&paths, &inch, "l").unwrap().contains("\nG20 "));
        // The bit itself needs no pause.
        let clearing = Some(Clearing { radius: 0.0, step: 1.0 });
        let own = carved(&l, &CarveOptions { clearing, ..options });
        let program = write(&[(own, 1e-3)], &MACHINE, "l").unwrap();
        assert!(!program.contains("M0 ") && program.contains("G2 X"));
    }

    #[test]
    fn what_rounding_would_make_dangerous_is_refused() {
        let square = |side: f64| [(0., 0.), (side, 0.), (side, side), (0., side)];
        let path = |side: f64| [(carved(&square(side), &CarveOptions::with_angle(90.0)), 1e-3)];
        let fails = |machine: Machine| write(&path(9.0), &machine, "").unwrap_err().to_string();
        let low = fails(Machine { safe_height: 1e-5, ..MACHINE });
        assert!(low.starts_with("the safe height 0.00001 is 0 as it is written"), "{low}");
        assert!(fails(Machine { feed: 1e-4, ..MACHINE }).starts_with("the feed 0.0001 is 0"));
        assert!(fails(Machine { plunge: 1e300, ..MACHINE }).contains("too much"));
        assert!(fails(Machine { spindle: Some(0.3), ..MACHINE }).contains("spindle"));
        for (side, why) in [(1e-5, "across"), (1e9, "reaches to")] {
            let error = write(&path(side), &MACHINE, "").unwrap_err().to_string();
            assert!(error.contains(why), "{error}");
        }
        let long = write(&path(9.0), &MACHINE, &"é(x)".repeat(200)).unwrap();
        assert!(long.lines().all(|line| line.is_ascii() && line.len() < 80));
    }
}
