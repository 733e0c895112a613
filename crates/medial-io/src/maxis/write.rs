use super::numbers::{push, push_signed};
use super::walk::Walk;
use super::{
    Anchor, COLUMNS, Column, DEFLATED, DISKS, MAGIC, MOST_TIMES, PLAIN, Record, cells, corners,
    origin,
};
use crate::Json;
use medial::axis::Engine;
use medial::ops::{Compressed, DiskGraph};

/// Shares of the last step that are tried, in quarters.
const QUARTERS: std::ops::RangeInclusive<u8> = 0..=4;

/// How hard deflate tries: as hard as it can.
pub(super) const EFFORT: u8 = 10;

/// The file of these features, which must be in the order of their numbers, and of the reference system
/// of their layer.
#[must_use]
pub fn write(crs: Option<&Json>, records: &[Record]) -> Vec<u8> {
    let body = body(crs, records);
    let deflated = miniz_oxide::deflate::compress_to_vec(&body, EFFORT);
    let mut stored = Vec::new();
    if deflated.len() < body.len() && body.len() / MOST_TIMES < deflated.len() {
        stored.push(DEFLATED);
        stored.extend(deflated);
    } else {
        stored.push(PLAIN);
        stored.extend(body);
    }
    let mut file = MAGIC.to_vec();
    file.extend(crc32fast::hash(&stored).to_le_bytes());
    file.extend(stored);
    file
}

/// The columns of a body that grows.
pub(super) struct Columns {
    columns: [Vec<u8>; COLUMNS],
}

impl Columns {
    pub fn new() -> Self {
        Self { columns: [const { Vec::new() }; COLUMNS] }
    }

    pub fn of(&mut self, column: Column) -> &mut Vec<u8> {
        &mut self.columns[column as usize]
    }

    fn text(&mut self, json: Option<&Json>) {
        let text = json.map_or("", |json| json.get());
        let plan = self.of(Column::Plan);
        push(plan, text.len() as u64);
        plan.extend_from_slice(text.as_bytes());
    }
}

fn body(crs: Option<&Json>, records: &[Record]) -> Vec<u8> {
    let mut columns = Columns::new();
    columns.text(crs);
    push(columns.of(Column::Plan), records.len() as u64);
    let mut next = 0;
    let mut anchor = None;
    for record in records {
        push(columns.of(Column::Plan), (record.feature as u64).wrapping_sub(next));
        next = (record.feature as u64).wrapping_add(1);
        columns.text(record.id.as_ref());
        match &record.shape {
            Compressed::Disks(graph) => disks(&mut columns, graph, &mut anchor),
            Compressed::Corners(shape) => corners::write(&mut columns, shape, &mut anchor),
            Compressed::Mask(mask) => cells::write(&mut columns, mask),
        }
    }
    let mut body = Vec::new();
    for column in &columns.columns {
        push(&mut body, column.len() as u64);
    }
    columns.columns.iter().for_each(|column| body.extend_from_slice(column));
    body
}

/// The number of an engine.
pub(super) fn engine(engine: Engine) -> u8 {
    // Known engines are few.
    Engine::ALL.iter().position(|known| *known == engine).unwrap_or_default() as u8
}

fn disks(columns: &mut Columns, graph: &DiskGraph, anchor: &mut Option<Anchor>) {
    let grid = (DISKS, graph.exponent());
    let start = origin(*anchor, grid);
    let sizes = QUARTERS.map(|quarters| {
        let mut trial = [const { Vec::new() }; 3];
        residuals(graph, start, quarters, &mut trial);
        (trial.iter().map(|column| cost(column)).sum::<u64>(), quarters)
    });
    let quarters = sizes.min().map_or(0, |(_, quarters)| quarters);
    let plan = columns.of(Column::Plan);
    plan.push(DISKS);
    plan.push(engine(graph.engine()));
    push_signed(plan, graph.exponent().into());
    push(plan, graph.error_parts());
    plan.push(quarters);
    push(plan, graph.runs().len() as u64);
    let mut known = 0_u32;
    for run in graph.runs() {
        push(plan, 2 * u64::from(run.len) + u64::from(run.to.is_some()));
        push(plan, run.from.map_or(0, |from| u64::from(known - from)));
        known += run.len;
        if let Some(to) = run.to {
            push(plan, u64::from(known - to));
        }
    }
    let [_, x, y, radius] = &mut columns.columns;
    let mut steps = [const { Vec::new() }; 3];
    residuals(graph, start, quarters, &mut steps);
    for (column, steps) in [x, y, radius].into_iter().zip(steps) {
        steps.into_iter().for_each(|step| push_signed(column, step));
    }
    if let Some(first) = graph.disks().first() {
        *anchor = Some(Anchor { grid, x: first.x, y: first.y });
    }
}

/// About how many bits numbers take.
fn cost(numbers: &[i64]) -> u64 {
    numbers.iter().map(|n| u64::from(64 - n.unsigned_abs().leading_zeros())).sum()
}

/// What has to be said of the disks one after the other, if a share of the last step is expected.
fn residuals(graph: &DiskGraph, start: (i64, i64), quarters: u8, columns: &mut [Vec<i64>; 3]) {
    let mut walk = Walk::new(start);
    let mut disks = graph.disks().iter();
    for run in graph.runs() {
        walk.begin(run.from);
        for disk in disks.by_ref().take(run.len as usize) {
            let guess = walk.guess(quarters);
            let off = [disk.x, disk.y, disk.radius]
                .into_iter()
                .zip(guess)
                .map(|(a, b)| a.wrapping_sub(b));
            for (column, off) in columns.iter_mut().zip(off) {
                column.push(off);
            }
            walk.add(*disk);
        }
    }
}
