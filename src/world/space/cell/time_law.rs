//! Positions over time of a tool that goes from rest to rest.

/// A tool's time law: rest to rest with one acceleration and one greatest speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedRule {
    /// The greatest speed of the tool.
    pub speed_m_s: f64,
    /// Its acceleration.
    pub acceleration_m_s2: f64,
}

impl SpeedRule {
    /// When the tool is `way_m` from its start on a path `length_m` long.
    pub(super) fn time_s(&self, way_m: f64, length_m: f64) -> f64 {
        let ramp_m = (self.speed_m_s * self.speed_m_s / (2.0 * self.acceleration_m_s2)).min(length_m / 2.0);
        let peak_m_s = (2.0 * self.acceleration_m_s2 * ramp_m).sqrt();
        let ramp_s = peak_m_s / self.acceleration_m_s2;
        let cruise_s = (length_m - 2.0 * ramp_m) / peak_m_s;
        if way_m <= ramp_m {
            (2.0 * way_m / self.acceleration_m_s2).sqrt()
        } else if way_m <= length_m - ramp_m {
            ramp_s + (way_m - ramp_m) / peak_m_s
        } else {
            let left_m = (length_m - way_m).max(0.0);
            2.0 * ramp_s + cruise_s - (2.0 * left_m / self.acceleration_m_s2).sqrt()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_law_is_rest_to_rest() {
        let law = SpeedRule { speed_m_s: 0.5, acceleration_m_s2: 2.0 };
        // 62.5 mm of ramp at either end, 0.25 s each; 0.875 m at 0.5 m/s between.
        assert!((law.time_s(1.0, 1.0) - (0.5 + 1.75)).abs() < 1e-12);
        assert!((law.time_s(0.0625, 1.0) - 0.25).abs() < 1e-12);
        assert!((law.time_s(0.5, 1.0) * 2.0 - law.time_s(1.0, 1.0)).abs() < 1e-12);
        // Too short to reach the speed: 2 √(length / acceleration).
        assert!((law.time_s(0.02, 0.02) - 0.2).abs() < 1e-12);
    }
}
