//! Slow distances by other algorithms than the fast ones.

use crate::geometry::{Segment, Vec3};

/// Ternary search for the least distance from `distance_at(share)`, a convex function of the share.
pub fn least(distance_at: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for _ in 0..100 {
        let third = (high - low) / 3.0;
        if distance_at(low + third) <= distance_at(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    distance_at(0.5 * (low + high)).min(distance_at(0.0)).min(distance_at(1.0))
}

/// The distance between segments by two nested ternary searches' outer one; the inner one is closed.
pub fn segment_segment(p: &Segment, q: &Segment) -> f64 {
    let d = q.b - q.a;
    least(|share| {
        let r = p.at(share) - q.a;
        let t = if d.norm_squared() > 0.0 { r.dot(&d) / d.norm_squared() } else { 0.0 };
        (r - d * t.clamp(0.0, 1.0)).norm()
    })
}

/// The distance between a segment and the solid behind `planes`, as a quadratic program. It solves for the pair with the
/// share at each bound or free, and with every set of at most three active planes, and keeps the best feasible pair. It
/// knows nothing of faces, edges and vertices.
pub fn segment_polyhedron(segment: &Segment, planes: &[(Vec3, f64)]) -> f64 {
    let n = planes.len();
    let mut best = f64::INFINITY;
    let mut try_set = |active: &[usize]| {
        if let Some(found) = with_active(segment, planes, active) {
            best = best.min(found);
        }
    };
    try_set(&[]);
    for i in 0..n {
        try_set(&[i]);
        for j in i + 1..n {
            try_set(&[i, j]);
            for k in j + 1..n {
                try_set(&[i, j, k]);
            }
        }
    }
    best
}

/// The least feasible distance with exactly these planes active.
fn with_active(segment: &Segment, planes: &[(Vec3, f64)], active: &[usize]) -> Option<f64> {
    // An orthonormal basis of the active normals, with the gap along each as a function of the share.
    let a = segment.a;
    let d = segment.b - segment.a;
    let mut basis = [Vec3::zeros(); 3];
    let mut gap = [0.0; 3];
    let mut rate = [0.0; 3];
    for (at, &plane) in active.iter().enumerate() {
        let (normal, offset) = planes[plane];
        let mut e = normal;
        let mut g = offset - normal.dot(&a);
        let mut r = -normal.dot(&d);
        for known in 0..at {
            let along = normal.dot(&basis[known]);
            e -= basis[known] * along;
            g -= along * gap[known];
            r -= along * rate[known];
        }
        let length = e.norm();
        if length < 1e-7 {
            return None;
        }
        (basis[at], gap[at], rate[at]) = (e / length, g / length, r / length);
    }
    let product = |u: &[f64; 3], v: &[f64; 3]| u.iter().zip(v).map(|(x, y)| x * y).sum::<f64>();
    let free = (product(&rate, &rate) > 1e-18).then(|| -product(&gap, &rate) / product(&rate, &rate));
    [Some(0.0), Some(1.0), free]
        .into_iter()
        .flatten()
        .filter(|share| (0.0..=1.0).contains(share))
        .filter_map(|share| {
            let move_: Vec3 = (0..active.len()).map(|i| basis[i] * (gap[i] + rate[i] * share)).sum();
            let nearest = a + d * share + move_;
            planes.iter().all(|(n, offset)| n.dot(&nearest) <= offset + 1e-11).then(|| move_.norm())
        })
        .reduce(f64::min)
}
