//! Rows that a thread of its own reads ahead, for libraries whose cursors stay on one thread.

use crate::{Error, Part};
use std::io;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};

/// Rows that are handed over together.
const BATCH: usize = 64;

/// Bytes of rows at which they are handed over, be they few.
const BATCH_BYTES: usize = 1 << 18;

/// Batches that may wait.
const AHEAD: usize = 2;

/// Takes rows, and says whether more are wanted.
pub(crate) struct Rows {
    batch: Vec<Part<'static>>,
    bytes: usize,
    sender: SyncSender<Vec<Part<'static>>>,
}

impl Rows {
    /// Adds a row; false if nobody wants more.
    pub(crate) fn push(&mut self, row: Part<'static>) -> bool {
        self.bytes += row.size();
        self.batch.push(row);
        if self.batch.len() < BATCH && self.bytes < BATCH_BYTES {
            return true;
        }
        self.bytes = 0;
        self.sender.send(std::mem::take(&mut self.batch)).is_ok()
    }
}

/// The rows that `find` hands over. If it fails, the last one tells that reading broke off.
pub(crate) fn read_apart(
    find: impl FnOnce(&mut Rows) -> Result<(), String> + Send + 'static,
) -> io::Result<impl Iterator<Item = Part<'static>> + Send> {
    let (sender, receiver) = sync_channel(AHEAD);
    let thread = thread::Builder::new().name("reader".to_owned()).spawn(move || {
        let mut rows = Rows { batch: Vec::new(), bytes: 0, sender };
        let found = find(&mut rows);
        let _ = rows.sender.send(rows.batch);
        found
    })?;
    Ok(Ahead { receiver, thread: Some(thread), n: 0 }.flatten())
}

/// What the thread has handed over.
struct Ahead {
    receiver: Receiver<Vec<Part<'static>>>,
    thread: Option<JoinHandle<Result<(), String>>>,
    /// Rows so far.
    n: usize,
}

impl Iterator for Ahead {
    type Item = Vec<Part<'static>>;

    fn next(&mut self) -> Option<Self::Item> {
        if let Ok(batch) = self.receiver.recv() {
            self.n += batch.len();
            return Some(batch);
        }
        let why = match self.thread.take()?.join() {
            Ok(Ok(())) => return None,
            Ok(Err(why)) => why,
            Err(_) => "the file is damaged, and its reader gave up".to_owned(),
        };
        let source = io::Error::other(why);
        Some(vec![Part::broken(self.n, Error::Interrupted { source })])
    }
}
