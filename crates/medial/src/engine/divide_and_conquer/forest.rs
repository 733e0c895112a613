//! The diagrams of rings, each by a binary merge tree [Lee82, Fig. 8].
//!
//! # Method
//! On one thread chains are merged as soon as they are there, so what is merged was made a moment ago.
//! On several threads groups of small walks, and chains of large rings as long as a power of two, are
//! made apart, each in a diagram of its own; then neighbours are put together and merged, two at a time.
//! Chains and merges are the same either way. Only the numbers of arcs and vertices differ, on which
//! nothing depends.

use std::ops::Range;

use super::diagram::Diagram;
use super::elements::{Ground, Members};
use super::exact::Exacts;
use super::merge::{Joint, Merge};
use super::touches;
use crate::domain::Walk;
use crate::engine::watch::Watch;
use crate::engine::{EngineError, Options, threads};

/// Tasks for each thread.
const SHARE: usize = 2;

/// Edges of a task, at least, unless fewer are to be shared out.
const LEAST: usize = 1024;

/// Which sides of a closed ring are asked for; open chains have both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Asked {
    Left,
    Both,
}

/// Makes the diagram of a walk, with all the simple rings that it consists of.
pub(super) fn close_walk(
    members: Members<'_>,
    diagram: &mut Diagram,
    walk: &Walk,
    asked: Asked,
    watch: &Watch<'_>,
) -> Result<(), EngineError> {
    let rings = touches::simple_rings(members, walk);
    for ring in &rings {
        let middle = first_part(ring.len());
        add_chain(members, diagram, ring, 0..middle, watch)?;
        add_chain(members, diagram, ring, middle..ring.len(), watch)?;
        close(members, diagram, ring, asked, watch)?;
    }
    touches::merge(members, diagram, walk, &rings, watch)
}

/// How many of the edges of a chain, or of a ring, the first of the two parts has that are merged last.
pub(super) fn first_part(len: usize) -> usize {
    len.next_power_of_two() / 2
}

/// The corner of a ring before one of its edges.
fn joint(members: &Members<'_>, ring: &[u32], start: usize) -> Joint {
    Joint::new(members, [ring[start - 1], ring[start]], true)
}

/// Adds the diagram of a chain of a ring, which starts at a multiple of a power of two that is no
/// shorter.
pub(super) fn add_chain(
    members: Members<'_>,
    diagram: &mut Diagram,
    ring: &[u32],
    range: Range<usize>,
    watch: &Watch<'_>,
) -> Result<(), EngineError> {
    for done in range.start + 1..=range.end {
        // The last chain starts with this edge of the ring.
        let mut start = done - 1;
        if (done - range.start).is_multiple_of(2) {
            match joint(&members, ring, start).convex() {
                Some(convex) => {
                    let place = members.domain.edge(ring[start]).start;
                    let broken = EngineError::Internal { stage: "joining two edges", place };
                    let pair = [ring[start - 1], ring[start]];
                    diagram.add_pair(&members, pair, convex).ok_or(broken)?;
                    start -= 1;
                }
                None => [start - 1, start].into_iter().for_each(|k| diagram.add_edge(ring[k])),
            }
        } else if done == range.end {
            diagram.add_edge(ring[start]);
        } else {
            continue;
        }
        while start > range.start {
            // As many edges as the chain before it has.
            let size = 1 << (start - range.start).trailing_zeros();
            if done - start < size && done < range.end {
                break;
            }
            let joint = joint(&members, ring, start);
            Merge::new(members, diagram, &[joint], watch).run()?;
            start -= size;
        }
    }
    Ok(())
}

/// Merges the two chains that are left of a ring in both of their corners.
fn close(
    members: Members<'_>,
    diagram: &mut Diagram,
    ring: &[u32],
    asked: Asked,
    watch: &Watch<'_>,
) -> Result<(), EngineError> {
    let inner = joint(&members, ring, first_part(ring.len()));
    let last = Joint::new(&members, [ring[ring.len() - 1], ring[0]], false);
    Merge { asked, ..Merge::new(members, diagram, &[inner, last], watch) }.run()
}

/// Walks whose diagrams are made together, or a ring that is large enough to be shared out.
enum Part {
    Walks(Range<usize>),
    Ring(Vec<u32>),
}

/// The walks in their order, which is that of their edges, in groups of about so many edges.
fn parts(ground: Ground<'_>, size: usize) -> Vec<Part> {
    let walks = ground.domain.walks();
    let mut parts = Vec::new();
    let mut room = 0;
    for (k, walk) in walks.iter().enumerate() {
        let len = walk.len as usize;
        let ring = (len > size).then(|| single_ring(ground, walk)).flatten();
        match (parts.last_mut(), ring) {
            (_, Some(ring)) => {
                parts.push(Part::Ring(ring));
                room = 0;
            }
            (Some(Part::Walks(walks)), None) if len <= room => {
                walks.end += 1;
                room -= len;
            }
            _ => {
                parts.push(Part::Walks(k..k + 1));
                room = size.saturating_sub(len);
            }
        }
    }
    parts
}

/// The edges of a walk that does not touch itself.
fn single_ring(ground: Ground<'_>, walk: &Walk) -> Option<Vec<u32>> {
    let mut rings = touches::simple_rings(ground.members(&Exacts::new()), walk);
    rings.pop().filter(|_| rings.is_empty())
}

/// The diagram of a part, or of a chain that starts at this edge of a ring.
struct Made {
    part: usize,
    start: usize,
    diagram: Diagram,
}

/// The diagram of all walks, made by several threads.
pub(super) fn of_all(
    ground: Ground<'_>,
    asked: Asked,
    options: &Options<'_>,
    watch: &Watch<'_>,
) -> Result<Diagram, EngineError> {
    let share = ground.domain.edges().len() / (SHARE * threads::number(options));
    let size = share.max(options.alone_below.clamp(2, LEAST)).next_power_of_two();
    let parts = parts(ground, size);
    let leaves = parts.iter().enumerate().flat_map(|(k, part)| {
        let len = if let Part::Ring(ring) = part { ring.len() } else { 1 };
        (0..len).step_by(size).map(move |start| (k, start))
    });
    let make = |(part, start): (usize, usize), watch: &Watch<'_>| {
        let exacts = Exacts::new();
        let members = ground.members(&exacts);
        let diagram = match &parts[part] {
            Part::Walks(walks) => {
                of_walks(members, &ground.domain.walks()[walks.clone()], asked, watch)?
            }
            Part::Ring(ring) => {
                let range = start..ring.len().min(start + size);
                let mut diagram = Diagram::with_room(ring[range.start]..ring[range.end - 1] + 1);
                add_chain(members, &mut diagram, ring, range, watch)?;
                diagram
            }
        };
        Ok(Made { part, start, diagram })
    };
    let mut made = threads::each(options, watch, leaves.collect(), make)?;
    let mut size = size;
    while made.len() > parts.len() {
        // Chains of this length two at a time; the last one of a ring may be left over.
        let mut pairs: Vec<(Made, Option<Made>)> = Vec::with_capacity(made.len());
        for next in made {
            match pairs.last_mut() {
                Some((first, second @ None))
                    if first.part == next.part && next.start == first.start + size =>
                {
                    *second = Some(next);
                }
                _ => pairs.push((next, None)),
            }
        }
        let merge = |(first, second): (Made, Option<Made>), watch: &Watch<'_>| {
            let Made { part, start, mut diagram } = first;
            if let (Some(second), Part::Ring(ring)) = (second, &parts[part]) {
                let exacts = Exacts::new();
                let members = ground.members(&exacts);
                diagram.append(second.diagram);
                if start == 0 && 2 * size >= ring.len() {
                    close(members, &mut diagram, ring, asked, watch)?;
                } else {
                    let joint = joint(&members, ring, second.start);
                    Merge::new(members, &mut diagram, &[joint], watch).run()?;
                }
            }
            Ok(Made { part, start, diagram })
        };
        made = threads::each(options, watch, pairs, merge)?;
        size *= 2;
    }
    let mut made = made.into_iter().map(|made| made.diagram);
    let mut whole = made.next().unwrap_or_else(|| Diagram::with_room(0..0));
    made.for_each(|diagram| whole.append(diagram));
    Ok(whole)
}

/// The diagram of walks that follow one another, none of which is seen from any other yet.
fn of_walks(
    members: Members<'_>,
    walks: &[Walk],
    asked: Asked,
    watch: &Watch<'_>,
) -> Result<Diagram, EngineError> {
    let edges = walks.first().map_or(0, |w| w.first)..walks.last().map_or(0, |w| w.edges().end);
    let mut diagram = Diagram::with_room(edges);
    for walk in walks {
        close_walk(members, &mut diagram, walk, asked, watch)?;
    }
    Ok(diagram)
}
