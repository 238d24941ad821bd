
#[cfg(test)]
impl Exploration {
    /// Makes it that of the paper as it is now.
    pub(super) fn restamp(&mut self, now: &Now) {
        for (name, stamp) in &mut self.studies {
            if let Some(new) = now.studies.get(name) {
                stamp.clone_from(new);
            }
        }
        for (id, claim) in &mut self.claims {
            if let Some(new) = now.asked.get(id) {
                claim.asked.clone_from(new);
            }
        }
    }
}
