//! Deletion on the paths that the improved search finds on the two witness maps of the zhang study.

use super::*;
use base::grid::{Sight, read_text_map};
use std::path::Path;

#[test]
fn deletion_gives_the_known_lengths_and_turns_on_the_witness_maps() {
    let path1 = [[22, 15], [23, 16], [24, 17], [25, 18], [25, 19], [26, 20], [26, 21], [25, 22], [24, 23]];
    let path1 = [&path1[..], &[[24, 24], [24, 25], [25, 26], [25, 27], [26, 28]]].concat();
    let path2 = [[28, 19], [27, 18], [26, 18], [25, 17], [24, 17], [23, 17], [22, 17], [21, 18], [20, 17]];
    let path2 =
        [&path2[..], &[[19, 17], [18, 16], [17, 16], [16, 17], [15, 16], [14, 17], [13, 16]]].concat();
    for (map, cells, length_cells, turn_deg) in
        [("zhang_w1.map.txt", path1, 15.6923, 242.0378), ("zhang_w2.map.txt", path2, 17.1626, 309.1427)]
    {
        let grid =
            read_text_map(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/maps").join(map)).unwrap();
        let points: Vec<[f64; 2]> = cells.iter().map(|cell| cell.map(f64::from)).collect();
        let corners = bends(&points);
        let cell = |i: usize| grid.cell(cells[corners[i]][0], cells[corners[i]][1]).unwrap();
        let can_see = |i, j| Sight::ExactInterior.is_clear(&grid, cell(i), cell(j));
        let kept: Vec<[f64; 2]> =
            inflection_deletion(corners.len(), can_see).into_iter().map(|i| points[corners[i]]).collect();
        assert!((path_length(&kept) - length_cells).abs() < 5e-5, "{map}: {kept:?} {}", path_length(&kept));
        let turned = turn_sum_deg(&kept, TurnAngle::Exterior);
        assert!((turned - turn_deg).abs() < 5e-5, "{map}: {kept:?} turns {turned}");
    }
}
