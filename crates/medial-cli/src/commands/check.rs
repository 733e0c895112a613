use crate::args::CheckArgs;
use crate::failure::{Failure, Status};

/// `medial check`.
pub fn run(args: &CheckArgs) -> Result<Status, Failure> {
    let _ = args;
    Err(Failure::Usage(String::new()))
}
