/// Numbers sorted into groups, within each in the order in which they came.
pub(super) struct Groups {
    /// Where each group starts among the members; the last one ends at the last number.
    first: Vec<u32>,
    members: Vec<u32>,
}

impl Groups {
    /// So many groups, from pairs of a group and a member, which are asked for twice.
    pub fn new<I: Iterator<Item = (u32, u32)>>(groups: usize, pairs: impl Fn() -> I) -> Self {
        let mut first = vec![0_u32; groups + 1];
        pairs().for_each(|(group, _)| first[group as usize + 1] += 1);
        for k in 1..first.len() {
            first[k] += first[k - 1];
        }
        let mut place = first.clone();
        let mut members = vec![0; first[groups] as usize];
        for (group, member) in pairs() {
            members[place[group as usize] as usize] = member;
            place[group as usize] += 1;
        }
        Self { first, members }
    }

    pub fn of(&self, group: u32) -> &[u32] {
        let k = group as usize;
        &self.members[self.first[k] as usize..self.first[k + 1] as usize]
    }
}
