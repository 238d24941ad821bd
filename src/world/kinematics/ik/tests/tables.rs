//! Arms by their published tables.

use crate::geometry::Frame;
pub use crate::kinematics::tests::{Rows as Table, joints_of as joints};
use crate::kinematics::{Arm, Chain};

/// Corke's Robotics Toolbox, `models/DH/Puma560.py`, without its base height.
pub const PUMA: Table = [
    [90.0, 0.0, 0.0, 0.0],
    [0.0, 431.8, 0.0, 0.0],
    [-90.0, 20.3, 150.05, 0.0],
    [90.0, 0.0, 431.8, 0.0],
    [-90.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0],
];

/// The same with the shoulder's offset in row 2.
pub const PUMA_D2: Table = moved_d(PUMA, 1, 2, 150.05);

/// The same with the shoulder's offset shared out over rows 2 and 3, as Armstrong's table has it.
pub const PUMA_SHARED: Table = moved_d(PUMA, 1, 2, 243.5);

/// By the modified convention: Armstrong, Khatib & Burdick (1986), as in `mdl_puma560akb.m` of Corke's Robotics Toolbox.
pub const PUMA_MODIFIED: Table = [
    [0.0, 0.0, 0.0, 0.0],
    [-90.0, 0.0, 243.5, 0.0],
    [0.0, 431.8, -93.4, 0.0],
    [90.0, -20.3, 433.1, 0.0],
    [-90.0, 0.0, 0.0, 0.0],
    [90.0, 0.0, 0.0, 0.0],
];

/// Universal Robots, CB3 user manual, appendix "Robot Parameter": UR5 series 3.
pub const UR5: Table = [
    [90.0, 0.0, 89.159, 0.0],
    [0.0, -425.0, 0.0, 0.0],
    [0.0, -392.25, 0.0, 0.0],
    [90.0, 0.0, 109.15, 0.0],
    [-90.0, 0.0, 94.65, 0.0],
    [0.0, 0.0, 82.3, 0.0],
];

/// The same arm by the modified convention.
pub const UR5_MODIFIED: Table = [
    [0.0, 0.0, 89.159, 0.0],
    [90.0, 0.0, 0.0, 0.0],
    [0.0, -425.0, 0.0, 0.0],
    [0.0, -392.25, 109.15, 0.0],
    [90.0, 0.0, 94.65, 0.0],
    [-90.0, 0.0, 82.3, 0.0],
];

/// The same arm with positive lengths, axis 3 turned round, and the shoulder's offset where the shoulder is.
pub const UR5_TURNED: Table = [
    [90.0, 0.0, 89.159, 0.0],
    [180.0, 425.0, 135.85, 90.0],
    [180.0, 392.25, 119.7, 0.0],
    [-90.0, 0.0, 93.0, -90.0],
    [90.0, 0.0, 94.65, 0.0],
    [0.0, 0.0, 82.3, 0.0],
];

/// Half the sum of two wrist sections of Kinova's Jaco, 74.3 mm each at 60°, along an axis: 74.3 sin 30° / sin 60°.
const JACO_SECTION: f64 = 74.3 * 0.577_350_269_189_625_8;

/// Corke's Robotics Toolbox, `models/DH/Jaco.py`, after Kinova's *DH Parameters of Jaco* 1.0.8 (2013): wrist axes at 60°.
pub const JACO: Table = [
    [90.0, 0.0, 275.5, 0.0],
    [180.0, 410.0, 0.0, -90.0],
    [90.0, 0.0, -9.8, 90.0],
    [60.0, 0.0, -207.3 - JACO_SECTION, 0.0],
    [60.0, 0.0, -2.0 * JACO_SECTION, -180.0],
    [180.0, 0.0, -168.7 - JACO_SECTION, 100.0],
];

/// UFACTORY, support article *Kinematic and Dynamic Parameters of xArm 6*, standard rows: axis 6 passes axis 5 at 76 mm.
pub const XARM6: Table = [
    [-90.0, 0.0, 267.0, 0.0],
    [0.0, 289.488_66, 0.0, -79.349_95],
    [-90.0, 77.5, 0.0, 79.349_95],
    [90.0, 0.0, 342.5, 0.0],
    [-90.0, 76.0, 0.0, 0.0],
    [0.0, 0.0, 97.0, 0.0],
];

/// FANUC CRX-10iA: lengths of Abbes & Poisson, *Robotics* 13 (2024) 91: 540, 540, 150 and 160 mm; the rows are ours.
pub const CRX10IA: Table = [
    [-90.0, 0.0, 0.0, 0.0],
    [180.0, 540.0, 0.0, -90.0],
    [-90.0, 0.0, 0.0, 180.0],
    [90.0, 0.0, -540.0, 0.0],
    [-90.0, 0.0, 150.0, 0.0],
    [180.0, 0.0, -160.0, 0.0],
];

/// `table` with `d` of a row at another value and the difference in the row `to`.
const fn moved_d(mut table: Table, row: usize, to: usize, d_mm: f64) -> Table {
    table[to][2] += table[row][2] - d_mm;
    table[row][2] = d_mm;
    table
}

/// The arm with these rows and the solver that fits, on a floor of its own.
pub fn arm(table: &Table) -> Arm {
    Arm::new(Chain::new(joints(table), Frame::IDENTITY, Frame::IDENTITY).unwrap(), None).unwrap()
}

/// The same by the modified convention.
pub fn modified_arm(table: &Table) -> Arm {
    let (chain, _) = Chain::modified(joints(table), Frame::IDENTITY, Frame::IDENTITY).unwrap();
    Arm::new(chain, None).unwrap()
}
