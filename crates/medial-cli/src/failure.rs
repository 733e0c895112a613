use std::io;
use std::process::ExitCode;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Everything is done.
    Done,
    /// There is no usable result.
    NoResult,
    /// The command was used wrongly.
    Usage,
    /// Some features were left out.
    LeftOut,
    /// `check` found defects.
    Defects,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(match status {
            Status::Done => 0,
            Status::NoResult => 1,
            Status::Usage => 2,
            Status::LeftOut => 3,
            Status::Defects => 4,
        })
    }
}

/// Why a command gave up.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The arguments make no sense; the text says what to write instead.
    #[error("{0}")]
    Usage(String),
    /// A file could not be read or written, or is not what it should be.
    #[error("{name}: {why}")]
    File {
        /// The file, as the user named it.
        name: String,
        /// What is wrong.
        why: String,
    },
    /// Help or version was asked for and printed.
    #[error("")]
    Told(Status),
    /// The reader of our standard output has gone: no fault of anybody.
    #[error("")]
    ReaderGone,
}

impl Failure {
    /// A failure of a file or stream with this name.
    pub fn file(name: &str, why: impl ToString) -> Self {
        Self::File { name: name.to_owned(), why: why.to_string() }
    }

    /// A failure to write to this file or stream.
    pub fn write(name: &str, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ReaderGone,
            _ => Self::file(name, format_args!("cannot write: {}", plain(error))),
        }
    }

    /// Prints the failure as one line, unless there is nothing to say; gives the exit status.
    pub fn tell(&self) -> ExitCode {
        let status = match self {
            Self::Usage(_) => Status::Usage,
            Self::File { .. } => Status::NoResult,
            Self::Told(status) => *status,
            Self::ReaderGone => Status::Done,
        };
        if let Self::Usage(_) | Self::File { .. } = self {
            crate::progress::line(&format!("error: {self}"));
        }
        status.into()
    }
}

/// The message of the system in lower case, without its number.
pub fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or(&text);
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}
