//! stub
/// x
pub struct M {
    /// l
    pub length: f64,
    /// a
    pub turn_exterior_deg: f64,
    /// b
    pub turn_interior_deg: f64,
    /// c
    pub bends: u64,
}
/// m
pub fn measures(_p: &[Vec<f64>]) -> M {
    M { length: 0., turn_exterior_deg: 0., turn_interior_deg: 0., bends: 0 }
}
