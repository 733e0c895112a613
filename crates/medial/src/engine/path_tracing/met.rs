use std::collections::HashSet;
use std::ops::Deref;

use crate::domain::Site;

/// Sites in the order in which they were met, each one once.
#[derive(Clone, Debug, Default)]
pub(super) struct Met {
    list: Vec<Site>,
    /// The same, once there are many.
    set: HashSet<Site>,
}

/// Sites up to which the list is searched.
const FEW: usize = 16;

impl Met {
    /// Adds a site unless it is there; tells whether it was not.
    pub fn insert(&mut self, site: Site) -> bool {
        let is_new = if self.list.len() < FEW {
            !self.list.contains(&site)
        } else {
            if self.set.is_empty() {
                self.set.extend(&self.list);
            }
            self.set.insert(site)
        };
        if is_new {
            self.list.push(site);
        }
        is_new
    }

    /// Takes a site out.
    pub fn remove(&mut self, site: Site) {
        self.list.retain(|&s| s != site);
        self.set.remove(&site);
        if self.list.len() < FEW {
            self.set.clear();
        }
    }
}

impl From<Vec<Site>> for Met {
    /// Of a list that holds each site once.
    fn from(list: Vec<Site>) -> Self {
        Self { list, set: HashSet::new() }
    }
}

impl Deref for Met {
    type Target = [Site];

    fn deref(&self) -> &[Site] {
        &self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sites_are_kept_once_in_the_order_they_came() {
        let mut met = Met::default();
        for k in (0..100).chain(0..100) {
            met.insert(Site::edge(k));
        }
        let all: Vec<Site> = (0..100).map(Site::edge).collect();
        assert_eq!(met[..], all[..]);
        for k in 3..100 {
            met.remove(Site::edge(k));
        }
        met.insert(Site::edge(1));
        met.insert(Site::edge(50));
        assert_eq!(met[..], [0, 1, 2, 50].map(Site::edge));
    }
}
