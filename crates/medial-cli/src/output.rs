use crate::failure::{Failure, plain};
use crate::interrupt;
use crate::parallel::lock;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use tempfile::NamedTempFile;

/// Bytes gathered before they are handed to the system.
const BUFFER: usize = 1 << 16;

/// Where results go: standard output, or a file that appears when it is complete.
pub enum Output {
    Stream(io::BufWriter<io::Stdout>),
    /// A pipe or a device, written as it is.
    Direct(io::BufWriter<fs::File>, String),
    File {
        text: io::BufWriter<NamedTempFile>,
        path: PathBuf,
    },
}

/// The files that a run is going to write.
static TAKEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The files that are read, and those beside the results that were there before.
static INPUTS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
static SIDE_FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Takes note of an input; fails if a report or a table of numbers would take its place.
pub fn reads(path: &Path) -> Result<(), Failure> {
    let Ok(place) = fs::canonicalize(path) else { return Ok(()) };
    if lock(&SIDE_FILES).contains(&place) {
        return Err(is_input(path));
    }
    lock(&INPUTS).push(place);
    Ok(())
}

fn is_input(path: &Path) -> Failure {
    Failure::Usage(format!("{} is the input; name another file for what is told", path.display()))
}

/// Extensions of the files that are written beside a shapefile.
const BESIDE: [&str; 4] = ["shx", "dbf", "cpg", "prj"];

/// Fails if two outputs are to be one file, of which the last would be all that is left.
fn take(folder: &Path, path: &Path, name: &str) -> Result<(), Failure> {
    let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    let place = folder.join(path.file_name().unwrap_or_default());
    let is_shapefile = place.extension().is_some_and(|e| e.eq_ignore_ascii_case("shp"));
    let beside = BESIDE.iter().filter(|_| is_shapefile).map(|e| place.with_extension(e));
    let places: Vec<PathBuf> = std::iter::once(place.clone()).chain(beside).collect();
    let mut taken = lock(&TAKEN);
    if places.iter().any(|place| taken.contains(place)) {
        let why = format!("{name} is named for two outputs; give each a file of its own");
        return Err(Failure::Usage(why));
    }
    taken.extend(places);
    Ok(())
}

/// The file that a link names, also where there is none yet.
fn followed(path: &Path) -> PathBuf {
    /// Links of links.
    const MOST: usize = 40;
    let mut place = path.to_owned();
    for _ in 0..MOST {
        let Ok(next) = fs::read_link(&place) else { break };
        place = place.parent().unwrap_or(Path::new("")).join(next);
    }
    fs::canonicalize(&place).unwrap_or(place)
}

impl Output {
    /// Standard output for `None` and `-`.
    pub fn create(path: Option<&Path>) -> Result<Self, Failure> {
        let Some(path) = path.filter(|path| path.as_os_str() != "-") else {
            return Ok(Self::Stream(io::BufWriter::with_capacity(BUFFER, io::stdout())));
        };
        let name = path.display().to_string();
        let failed = |error: io::Error| {
            Failure::file(&name, format_args!("cannot create: {}", plain(&error)))
        };
        // Follow links, so that the file they name is replaced and not the link.
        let path = followed(path);
        if let Ok(found) = fs::metadata(&path)
            && !found.is_file()
        {
            let file = fs::OpenOptions::new().write(true).open(&path).map_err(failed)?;
            return Ok(Self::Direct(io::BufWriter::with_capacity(BUFFER, file), name));
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        take(folder, &path, &name)?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(".medial-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            // As for any new file: the umask takes off what it should.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = interrupt::unfinished(|| builder.tempfile_in(folder)).map_err(failed)?;
        Ok(Self::File { text: io::BufWriter::with_capacity(BUFFER, file), path })
    }

    /// A file beside the results, which is not to take the place of an input.
    pub fn beside(path: &Path) -> Result<Self, Failure> {
        if let Ok(place) = fs::canonicalize(path) {
            lock(&SIDE_FILES).push(place.clone());
            if lock(&INPUTS).contains(&place) {
                return Err(is_input(path));
            }
        }
        Self::create(Some(path))
    }

    /// Where a file is while it is not complete, for who writes it by its path.
    pub fn place(&self) -> Option<&Path> {
        match self {
            Self::File { text, .. } => Some(text.get_ref().path()),
            _ => None,
        }
    }

    /// Where a file is going to be.
    pub fn target(&self) -> Option<&Path> {
        match self {
            Self::File { path, .. } => Some(path),
            _ => None,
        }
    }

    /// Adds to the results; on standard output they are there for whoever reads it.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let result = match self {
            Self::Stream(out) => out.write_all(bytes).and_then(|()| out.flush()),
            Self::Direct(out, _) => out.write_all(bytes),
            Self::File { text, .. } => text.write_all(bytes),
        };
        result.map_err(|error| Failure::write(&self.name(), &error))
    }

    /// Flushes, and lets the file appear. Without this call no file appears.
    pub fn finish(self) -> Result<(), Failure> {
        let name = self.name();
        let failed = |error: &io::Error| Failure::write(&name, error);
        match self {
            Self::Stream(mut out) => out.flush().map_err(|e| failed(&e)),
            Self::Direct(mut out, _) => out.flush().map_err(|e| failed(&e)),
            Self::File { text, path } => {
                let file = text.into_inner().map_err(|e| failed(e.error()))?;
                file.persist(&path).map(drop).map_err(|e| failed(&e.error))
            }
        }
    }

    /// Writes all there is to write.
    pub fn whole(mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.write(bytes)?;
        self.finish()
    }

    pub fn name(&self) -> String {
        match self {
            Self::Stream(_) => "<stdout>".to_owned(),
            Self::Direct(_, name) => name.clone(),
            Self::File { path, .. } => path.display().to_string(),
        }
    }
}
