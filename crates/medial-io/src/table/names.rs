use std::collections::HashSet;

/// Names that differ from one another and from those taken, also where letter case does not matter: as
/// they are, or with a number behind.
pub(crate) fn unique<'a>(
    names: impl IntoIterator<Item = &'a str>,
    taken: &[&str],
    fit: impl Fn(&str, &str) -> String,
) -> Vec<String> {
    let mut used: HashSet<String> = taken.iter().map(|name| name.to_lowercase()).collect();
    names
        .into_iter()
        .map(|name| {
            let mut found = fit(name, "");
            let mut number = 0;
            while !used.insert(found.to_lowercase()) {
                number += 1;
                found = fit(name, &format!("_{number}"));
            }
            found
        })
        .collect()
}

/// Names of columns that are read, where several have the same one with a number behind all but the first;
/// with a warning then.
pub(crate) fn told_apart(names: Vec<String>, warnings: &mut Vec<String>) -> Vec<String> {
    let mut used: HashSet<String> = names.iter().cloned().collect();
    if used.len() == names.len() {
        return names;
    }
    let mut seen = HashSet::new();
    let mut renamed = Vec::new();
    let found = names
        .into_iter()
        .map(|name| {
            if seen.insert(name.clone()) {
                return name;
            }
            let numbered = (1..).map(|number| format!("{name}_{number}"));
            let other = { numbered }.find(|other| used.insert(other.clone()));
            let other = other.unwrap_or_else(|| name.clone());
            renamed.push(format!("`{name}` as `{other}`"));
            other
        })
        .collect();
    warnings.push(format!("several columns have one name; read are {}", renamed.join(", ")));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_the_same_are_told_apart() {
        let of = |names: &[&str]| {
            let mut warnings = Vec::new();
            let names = names.iter().map(|name| (*name).to_owned()).collect();
            (told_apart(names, &mut warnings), warnings)
        };
        assert!(of(&["a", "A"]).1.is_empty());
        let (found, warnings) = of(&["a", "a", "b", "a_1", "a"]);
        assert_eq!(found, ["a", "a_2", "b", "a_1", "a_3"]);
        let warning = "several columns have one name; read are `a` as `a_2`, `a` as `a_3`";
        assert_eq!(warnings, [warning]);
    }

    #[test]
    fn names_that_differ_in_case_get_numbers() {
        let plain = |name: &str, number: &str| format!("{name}{number}");
        let found = unique(["Name", "name", "fid", "NAME"], &["fid"], plain);
        assert_eq!(found, ["Name", "name_1", "fid_1", "NAME_2"]);
    }
}
