//! Outlines: each turn is expected by those before it.

use super::coder::{Coder, Context};
use super::{Fault, Rows, check};
use medial::raster::{CrackChain, CrackWalk, Grid, Turn};

/// Most turns that the next one is expected by.
pub const MOST_ORDER: u8 = 9;

/// Most cracks, so that no file fills the memory.
const MOST_CRACKS: usize = 1 << 28;

/// Codes closed chains of cracks; given are those to be coded, in the order of the rows in which they start.
pub fn code(
    coder: &mut impl Coder,
    grid: &Grid,
    order: u8,
    chains: &[CrackChain],
) -> Result<Vec<CrackChain>, Fault> {
    let n_contexts = 3_usize.pow(order.into());
    // Whether a turn is one, and whether it is to the left, by the turns before.
    let mut contexts = vec![[Context::default(); 2]; n_contexts];
    let (mut starts, mut goes_on) = (Rows::new(grid.columns, grid.rows), Context::default());
    let (mut found, mut left) = (Vec::new(), MOST_CRACKS);
    let mut next = chains.iter();
    loop {
        let given = next.next();
        if !coder.bit(&mut goes_on, given.is_some()) {
            return Ok(found);
        }
        check(coder)?;
        let start = starts.code(coder, given.map_or([0, 0], |chain| chain.start))?;
        let first = CrackWalk::new(start);
        let (mut walk, mut history, mut turns) = (first, 0, Vec::new());
        loop {
            check(coder)?;
            let given = given.and_then(|chain| chain.turns.get(turns.len())).copied();
            let [bends, is_left] = &mut contexts[history];
            let turn = if !coder.bit(bends, given.is_some_and(|turn| turn != Turn::Straight)) {
                Turn::Straight
            } else if coder.bit(is_left, given == Some(Turn::Left)) {
                Turn::Left
            } else {
                Turn::Right
            };
            left = left.checked_sub(1).ok_or("its outline is too long")?;
            walk = walk.next(turn, grid).ok_or("its outline leaves the cells")?;
            turns.push(turn);
            if walk == first {
                break;
            }
            history = (3 * history + turn as usize) % n_contexts;
        }
        found.push(CrackChain { start, turns });
    }
}
