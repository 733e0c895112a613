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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_differ_in_case_get_numbers() {
        let plain = |name: &str, number: &str| format!("{name}{number}");
        let found = unique(["Name", "name", "fid", "NAME"], &["fid"], plain);
        assert_eq!(found, ["Name", "name_1", "fid_1", "NAME_2"]);
    }
}
