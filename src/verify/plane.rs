//! Judges paths of a particle among convex polygons, in sixteenths of a millimetre: in integers, exactly.
//!
//! Coordinates of maps and samples are multiples of a sixteenth, so nothing is rounded. Touching is contact.
use base::text::listed;

/// A point in sixteenths of a millimetre.
type Point = [i64; 2];

/// Convex obstacles, corners counter-clockwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    obstacles: Vec<Vec<Point>>,
}

fn exact(point_mm: &[f64]) -> Option<Point> {
    let [x, y] = point_mm else { return None };
    let scaled = [x * 16.0, y * 16.0];
    let is_exact = scaled.iter().all(|value| value.fract() == 0.0 && value.abs() < 1e9);
    is_exact.then(|| scaled.map(|value| value as i64))
}

/// Twice the area of a triangle, positive if it turns counter-clockwise.
fn turn(a: Point, b: Point, c: Point) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

impl Case {
    /// The case of these polygons.
    ///
    /// # Errors
    /// If a corner is no multiple of a sixteenth of a millimetre.
    pub fn new(polygons_mm: &[Vec<[f64; 2]>]) -> Result<Self, String> {
        let corner = |point: &[f64; 2]| {
            exact(point).ok_or_else(|| {
                format!("corner {point} is no multiple of a sixteenth of a millimetre", point = listed(point))
            })
        };
        let polygon = |corners: &Vec<[f64; 2]>| corners.iter().map(corner).collect::<Result<_, _>>();
        Ok(Self { obstacles: polygons_mm.iter().map(polygon).collect::<Result<_, _>>()? })
    }

    /// The length of `path`, which must go from `start` to `goal` and touch nothing.
    ///
    /// # Errors
    /// Why it does not.
    pub fn length_mm(&self, path: &[Vec<f64>], [start, goal]: [&[f64]; 2]) -> Result<f64, String> {
        if path.first().map(Vec::as_slice) != Some(start) || path.last().map(Vec::as_slice) != Some(goal) {
            return Err("the path does not go from start to goal".to_owned());
        }
        let points: Option<Vec<Point>> = path.iter().map(|point| exact(point)).collect();
        let points = points.ok_or("a point of the path is no multiple of a sixteenth of a millimetre")?;
        for (index, pair) in points.windows(2).enumerate() {
            if let Some(hit) = self.obstacles.iter().position(|o| touches(pair[0], pair[1], o)) {
                return Err(format!("leg {} touches obstacle {}", index + 1, hit + 1));
            }
        }
        let leg = |pair: &[Point]| {
            let [x, y] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]].map(|d| d as f64);
            (x * x + y * y).sqrt() / 16.0
        };
        Ok(points.windows(2).map(leg).sum())
    }
}

/// Whether a segment and a convex polygon share a point: no line along a side or along the segment parts them.
fn touches(a: Point, b: Point, corners: &[Point]) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let outside = sides.into_iter().any(|(p, q)| turn(*p, *q, a) < 0 && turn(*p, *q, b) < 0);
    let turns = || corners.iter().map(|corner| turn(a, b, *corner));
    let one_side = turns().all(|t| t > 0) || turns().all(|t| t < 0);
    let beyond = |axis: usize| {
        let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
        corners.iter().all(|c| c[axis] < low) || corners.iter().all(|c| c[axis] > high)
    };
    !(outside || one_side || beyond(0) || beyond(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_refused_where_it_touches_and_measured_where_it_does_not() {
        let square = vec![[10.0, 10.0], [20.0, 10.0], [20.0, 20.0], [10.0, 20.0]];
        let case = Case::new(&[square]).unwrap();
        let length = |path: &[[f64; 2]]| {
            let path: Vec<Vec<f64>> = path.iter().map(|p| p.to_vec()).collect();
            case.length_mm(&path, [&path[0].clone(), &path[path.len() - 1].clone()])
        };
        assert_eq!(length(&[[0.0, 0.0], [30.0, 0.0], [30.0, 40.0]]).unwrap(), 70.0);
        assert!(length(&[[0.0, 0.0], [30.0, 30.0]]).unwrap_err().contains("leg 1 touches obstacle 1"));
        // Through one corner only, along a side, and just past the corner.
        assert!(length(&[[0.0, 20.0], [20.0, 0.0]]).is_err());
        assert!(length(&[[0.0, 10.0], [30.0, 10.0]]).is_err());
        assert!(length(&[[0.0, 19.9375], [20.0, 0.0]]).is_ok());
        assert!(length(&[[12.0, 12.0], [13.0, 13.0]]).is_err(), "inside without meeting a side");
        assert!(length(&[[0.0, 0.01], [1.0, 0.0]]).unwrap_err().contains("sixteenth"));
    }
}
