//! The order of the layers, read from the sources.
//!
//! Each module uses only those before it, engines never use one another, and the crates point one
//! way. Comments and strings are not looked at: a document may link to anything.

use medial::axis::Engine;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules of `medial`, each using only those before it.
const LAYERS: [&str; 7] = ["geom", "domain", "axis", "raster", "engine", "check", "ops"];

/// The crates of the workspace, each using only those before it.
const CRATES: [&str; 3] = ["medial", "medial-io", "medial-cli"];

#[test]
fn each_module_uses_only_those_before_it() {
    let files = sources(&source_folder());
    // All but the root, which names every module.
    assert!(files.len() > 50, "{} files are not the whole crate", files.len());
    let exports = engine_exports();
    let faults: Vec<String> = files
        .iter()
        .flat_map(|file| {
            let module = module_of(file);
            let text = fs::read_to_string(file).unwrap();
            faults(&module, &text, &exports)
                .into_iter()
                .map(|fault| format!("{}: {fault}", file.display()))
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_top_module_has_its_layer() {
    let root = code(&fs::read_to_string(source_folder().join("lib.rs")).unwrap());
    let words = words(&root);
    let declared: Vec<&str> =
        words.windows(2).filter(|w| w[0].1 == "mod").map(|w| w[1].1.as_str()).collect();
    assert!(declared.len() >= 5, "{declared:?}");
    for (k, module) in declared.iter().enumerate() {
        assert_eq!(*module, LAYERS[k], "lib.rs declares the modules in the order of the layers");
    }
}

#[test]
fn the_crates_point_one_way() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned();
    for (k, name) in CRATES.iter().enumerate() {
        let manifest = fs::read_to_string(folder.join(name).join("Cargo.toml")).unwrap();
        for later in &CRATES[k..] {
            assert!(!depends_on(&manifest, later), "{name} depends on {later}");
        }
        for file in sources(&folder.join(name).join("src")) {
            let text = code(&fs::read_to_string(&file).unwrap());
            for later in &CRATES[k + 1..] {
                let later = later.replace('-', "_");
                let used = words(&text).iter().any(|(_, word)| *word == later);
                assert!(!used, "{}: uses {later}", file.display());
            }
        }
    }
    let manifest = fs::read_to_string(folder.join("medial-cli").join("Cargo.toml")).unwrap();
    assert!(depends_on(&manifest, "medial-io"), "the reader of manifests sees no dependency");
}

#[test]
fn planted_arrows_are_found() {
    let exports = [("path_tracing".to_owned(), vec!["Steps".to_owned()])];
    let found = |module: &str, text: &str| {
        let module: Vec<String> = module.split("::").map(str::to_owned).collect();
        faults(&module, text, &exports).len()
    };
    // A later module, by each way there is to write it.
    assert_eq!(found("geom::point", "use crate::domain::Domain;"), 1);
    assert_eq!(found("domain", "fn f(a: &crate::axis::MedialAxis) {}"), 1);
    assert_eq!(found("domain", "use crate::{geom::Point, axis::{Site, Path}, check};"), 3);
    assert_eq!(found("geom::point", "use super::super::axis::Path;"), 1);
    assert_eq!(found("geom", "mod tests { use super::super::axis::Path; }"), 1);
    // Something at the root.
    assert_eq!(found("axis", "use crate::Domain;"), 1);
    assert_eq!(found("axis", "use crate::*;"), 1);
    // Another engine, by its module and by what is exported for it.
    assert_eq!(found("engine::brushfire", "use crate::engine::path_tracing;"), 1);
    assert_eq!(found("engine::brushfire", "use super::path_tracing::x;"), 1);
    assert_eq!(found("engine::brushfire::front", "use super::super::Steps;"), 1);
    assert_eq!(found("engine::brushfire", "use super::*;"), 1);
    // Nothing wrong.
    assert_eq!(found("axis::curve", "use crate::geom::Point;\nuse super::{Path, Site};"), 0);
    assert_eq!(found("axis", "mod tests { use super::*; }"), 0);
    assert_eq!(found("engine::path_tracing", "use super::EngineError;"), 0);
    assert_eq!(found("engine::path_tracing::search", "use super::Steps;"), 0);
    assert_eq!(found("geom", "// crate::domain\nconst A: &str = \"crate::axis\";"), 0);
    assert_eq!(
        found("geom", "/* crate::domain /* nested */ crate::axis */ const C: char = '\"';"),
        0
    );
}

/// Everything a file of this module names that it must not.
fn faults(module: &[String], text: &str, exports: &[(String, Vec<String>)]) -> Vec<String> {
    let layer = |name: &str| LAYERS.iter().position(|l| *l == name);
    let Some(own) = layer(&module[0]) else { return vec![format!("{} has no layer", module[0])] };
    let mut faults = Vec::new();
    for path in paths(module, text) {
        let first = path.first().map_or("*", String::as_str);
        match layer(first) {
            None => faults.push(format!("names {first} of the root")),
            Some(k) if k > own => faults.push(format!("uses {}", path.join("::"))),
            Some(_) => {}
        }
        if module[0] == "engine" && first == "engine" && module.len() > 1 {
            let second = path.get(1).map_or("*", String::as_str);
            let foreign = |(engine, names): &(String, Vec<String>)| {
                *engine != module[1]
                    && (second == engine || second == "*" || names.iter().any(|n| n == second))
            };
            if is_engine(&module[1]) && exports.iter().any(foreign) {
                faults.push(format!("uses another engine's {}", path.join("::")));
            }
        }
    }
    faults
}

/// Whether a module is one of the engines, planned ones included.
fn is_engine(module: &str) -> bool {
    const PLANNED: [&str; 5] =
        ["divide_and_conquer", "delaunay_dual", "ridge_following", "brushfire", "raster_transform"];
    PLANNED.contains(&module) || Engine::ALL.iter().any(|e| e.name() == module)
}

/// The engines there are, each with the names that `engine` exports for it.
fn engine_exports() -> Vec<(String, Vec<String>)> {
    let text = fs::read_to_string(source_folder().join("engine/mod.rs")).unwrap();
    let mut exports: Vec<(String, Vec<String>)> = Vec::new();
    for engine in Engine::ALL {
        let prefix = format!("use {}::", engine.name());
        let lists = text.split(';').filter_map(|item| item.split_once(prefix.as_str()));
        let names = lists.flat_map(|(_, list)| words(list)).map(|(_, word)| word).collect();
        exports.push((engine.name().to_owned(), names));
    }
    assert!(exports.iter().all(|(_, names)| !names.is_empty()), "{exports:?}");
    exports
}

fn source_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// All Rust files under a folder but the roots of crates, in order.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("src/lib.rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The path of the module in a file: `engine/path_tracing/mod.rs` is `engine::path_tracing`.
fn module_of(file: &Path) -> Vec<String> {
    let inner = file.strip_prefix(source_folder()).unwrap().with_extension("");
    let mut module: Vec<String> =
        inner.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    module.pop_if(|last| last == "mod");
    module
}

/// Whether a manifest lists a package among its dependencies, of whatever kind.
fn depends_on(manifest: &str, package: &str) -> bool {
    let mut listing = false;
    manifest.lines().map(str::trim).any(|line| {
        if let Some(section) = line.strip_prefix('[') {
            listing = section.contains("dependencies");
            return section.trim_end_matches(']').ends_with(&format!("dependencies.{package}"));
        }
        let name = line.split(['.', '=', ' ']).next().unwrap_or_default();
        listing && name == package
    })
}

/// All paths from `crate`, and from as many `super` as lead to its root or to `engine`, as seen
/// from the root. A group counts once for each of its members.
fn paths(module: &[String], text: &str) -> Vec<Vec<String>> {
    let text = code(text);
    let words = words(&text);
    let mut found = Vec::new();
    let mut inline: Vec<usize> = Vec::new(); // depths of braces that open modules
    let mut depth = 0;
    let mut last = 0;
    let mut k = 0;
    while k < words.len() {
        let (at, word) = (&words[k].0, words[k].1.as_str());
        for brace in text[last..*at].chars() {
            match brace {
                '{' => depth += 1,
                '}' => {
                    inline.pop_if(|d| *d == depth);
                    depth -= 1;
                }
                _ => {}
            }
        }
        last = *at;
        if word == "mod"
            && let Some((name, _)) = words.get(k + 1).map(|(at, name)| (at + name.len(), name))
            && text[name..].trim_start().starts_with('{')
        {
            inline.push(depth + 1);
        }
        let mut after = at + word.len();
        let base: Option<Vec<String>> = match word {
            "crate" => Some(Vec::new()),
            "super" => {
                let mut up = 1;
                while text[after..].starts_with("::super") {
                    up += 1;
                    k += 1;
                    after += "::super".len();
                }
                let full = module.len() + inline.len();
                let left = full.saturating_sub(up);
                (left < module.len()).then(|| module[..left].to_vec())
            }
            _ => None,
        };
        if let Some(base) = base
            && let Some(rest) = text[after..].strip_prefix("::")
        {
            for tail in tails(rest) {
                found.push(base.iter().cloned().chain(tail).collect());
            }
        }
        k += 1;
    }
    found
}

/// The first two parts of each path that continues here, groups taken apart.
fn tails(text: &str) -> Vec<Vec<String>> {
    let text = text.trim_start();
    if let Some(group) = text.strip_prefix('{') {
        return members(group).iter().flat_map(|member| tails(member)).collect();
    }
    let end = text.find(|c: char| !is_word(c)).unwrap_or(text.len());
    let (word, rest) = text.split_at(end);
    if word.is_empty() {
        return vec![Vec::new()];
    }
    match rest.strip_prefix("::") {
        Some(rest) => tails(rest)
            .into_iter()
            .map(|tail| std::iter::once(word.to_owned()).chain(tail).collect())
            .collect(),
        None => vec![vec![word.to_owned()]],
    }
}

/// The members of a group whose brace has just opened.
fn members(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut members) = (0, 0, Vec::new());
    for (at, letter) in text.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                members.push(text[start..at].trim());
                start = at + 1;
                if letter == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    members.retain(|m| !m.is_empty());
    members
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The words of a text, each with its place.
fn words(text: &str) -> Vec<(usize, String)> {
    let mut words = Vec::new();
    let mut start = None;
    for (at, letter) in text.char_indices().chain([(text.len(), ' ')]) {
        match (start, is_word(letter)) {
            (None, true) => start = Some(at),
            (Some(from), false) => {
                words.push((from, text[from..at].to_owned()));
                start = None;
            }
            _ => {}
        }
    }
    words
}

/// The text without comments and without what is written in strings and characters.
fn code(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let at = |k: usize| letters.get(k).copied().unwrap_or('\n');
    let mut code = String::new();
    let mut k = 0;
    while k < letters.len() {
        match (at(k), at(k + 1)) {
            ('/', '/') => {
                while k < letters.len() && at(k) != '\n' {
                    k += 1;
                }
            }
            ('/', '*') => {
                let mut depth = 0;
                loop {
                    match (at(k), at(k + 1)) {
                        ('/', '*') => (depth, k) = (depth + 1, k + 2),
                        ('*', '/') => (depth, k) = (depth - 1, k + 2),
                        _ => k += 1,
                    }
                    if depth == 0 || k >= letters.len() {
                        break;
                    }
                }
            }
            ('r', '"' | '#') if !is_word(code.chars().last().unwrap_or(' ')) => {
                let hashes = (1..).take_while(|&n| at(k + n) == '#').count();
                if at(k + 1 + hashes) != '"' {
                    code.push('r');
                    k += 1;
                    continue;
                }
                k += 2 + hashes;
                while k < letters.len() && !(at(k) == '"' && (1..=hashes).all(|n| at(k + n) == '#'))
                {
                    k += 1;
                }
                k += 1 + hashes;
                code.push_str("\"\"");
            }
            ('"', _) => {
                k += 1;
                while k < letters.len() && at(k) != '"' {
                    k += if at(k) == '\\' { 2 } else { 1 };
                }
                k += 1;
                code.push_str("\"\"");
            }
            // A character, told from a lifetime by its closing quote.
            ('\'', '\\') => {
                k += 3;
                while k < letters.len() && at(k) != '\'' {
                    k += 1;
                }
                k += 1;
            }
            ('\'', _) if at(k + 2) == '\'' => k += 3,
            (letter, _) => {
                code.push(letter);
                k += 1;
            }
        }
    }
    code
}
