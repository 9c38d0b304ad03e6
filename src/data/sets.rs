/// Sets that grow together (Galler & Fisher 1964); the least member of each stands for it.
pub struct Sets(Vec<u32>);

impl Sets {
    pub fn new(count: usize) -> Sets {
        Sets((0..count as u32).collect())
    }

    /// Sets of which another member is known of each, no greater than itself; of the least it is the least itself.
    pub fn of(parents: Vec<u32>) -> Sets {
        Sets(parents)
    }

    pub fn find(&mut self, mut member: u32) -> u32 {
        while self.0[member as usize] != member {
            // Half the path, for the next time.
            let above = self.0[self.0[member as usize] as usize];
            self.0[member as usize] = above;
            member = above;
        }
        member
    }

    pub fn join(&mut self, a: u32, b: u32) {
        self.join_all([a, b]);
    }

    #[inline]
    pub fn join_all<const N: usize>(&mut self, members: [u32; N]) {
        let least = members.map(|member| self.find(member));
        let lowest = least.into_iter().min().unwrap_or_default();
        least.into_iter().for_each(|member| self.0[member as usize] = lowest);
    }

    /// The least member of the set of each.
    pub fn into_least(mut self) -> Vec<u32> {
        (0..self.0.len() as u32).map(|member| self.find(member)).collect()
    }
}

/// Sets whose members are of one of two kinds each, known relative to each other.
pub struct TwoKinds {
    parents: Vec<u32>,
    /// Whether a member is of another kind than its parent.
    differs: Vec<bool>,
}

impl TwoKinds {
    pub fn new(count: usize) -> TwoKinds {
        TwoKinds { parents: (0..count as u32).collect(), differs: vec![false; count] }
    }

    /// The least member of the set, and whether `member` is of another kind than that.
    pub fn find(&mut self, member: u32) -> (u32, bool) {
        let (mut root, mut differs) = (member, false);
        while self.parents[root as usize] != root {
            differs ^= self.differs[root as usize];
            root = self.parents[root as usize];
        }
        // All on the way hang on the root from now on.
        let (mut at, mut rest) = (member, differs);
        while self.parents[at as usize] != root {
            let next = std::mem::replace(&mut self.parents[at as usize], root);
            rest ^= std::mem::replace(&mut self.differs[at as usize], rest);
            at = next;
        }
        (root, differs)
    }

    /// Joins two sets; answers whether that agrees with what was known.
    pub fn join(&mut self, a: u32, b: u32, differ: bool) -> bool {
        let ((a, of_a), (b, of_b)) = (self.find(a), self.find(b));
        let roots_differ = of_a ^ of_b ^ differ;
        if a == b {
            return !roots_differ;
        }
        self.parents[a.max(b) as usize] = a.min(b);
        self.differs[a.max(b) as usize] = roots_differ;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_member_stands_for_a_set() {
        let mut sets = Sets::new(6);
        [(5, 3), (1, 4), (3, 4)].into_iter().for_each(|(a, b)| sets.join(a, b));
        assert_eq!([0, 1, 2, 3, 4, 5].map(|m| sets.find(m)), [0, 1, 2, 1, 1, 1]);
    }

    #[test]
    fn kinds_follow_from_what_was_said_and_contradictions_are_told() {
        // Against kinds given to each member at first.
        let kinds: Vec<bool> = (0..200u32).map(|i| i * i % 7 < 3).collect();
        let mut sets = TwoKinds::new(200);
        // All neighbours on a ring of the even members, out of order.
        for i in 0..100u32 {
            let (a, b) = (i * 37 % 100 * 2, (i * 37 + 1) % 100 * 2);
            assert!(sets.join(a, b, kinds[a as usize] != kinds[b as usize]));
        }
        for i in (0..200).step_by(2) {
            let (root, differs) = sets.find(i);
            assert_eq!((root, differs), (0, kinds[i as usize] != kinds[0]));
            assert_eq!(sets.find(i + 1), (i + 1, false));
        }
        assert!(!sets.join(4, 8, kinds[4] == kinds[8]));
    }
}
