//! Forward kinematics against printed poses, another chain of frames, and finite differences.

use super::{AXES, Chain, Joint, Joints, Robot};
use crate::geometry::{Frame, Vec3};
use base::seed::{self, Stream};
use nalgebra::{Isometry3, Matrix4, Translation3, UnitQuaternion, Vector3};
use rand::RngExt as _;
use std::{f64::consts::FRAC_PI_2, f64::consts::PI, path::Path};

/// The robot file that is committed under this name.
pub fn robot(name: &str) -> Robot {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots").join(format!("{name}.toml"));
    Robot::load(&file).unwrap()
}

/// A configuration within limits, drawn joint by joint.
pub fn draw(stream: &mut Stream, chain: &Chain) -> Joints {
    chain.joints().map(|joint| stream.random_range(joint.lower_rad..joint.upper_rad))
}

/// A configuration printed in a table, and where it puts the arm.
pub struct Printed {
    pub name: &'static str,
    pub degrees: [f64; 6],
    /// Without a tool.
    pub flange_mm: [f64; 3],
    /// With 150 mm of tool.
    pub tip_mm: [f64; 3],
    pub approach: [f64; 3],
}

const fn printed(
    name: &'static str,
    degrees: [f64; 6],
    flange_mm: [f64; 3],
    tip_mm: [f64; 3],
    approach: [f64; 3],
) -> Printed {
    Printed { name, degrees, flange_mm, tip_mm, approach }
}

/// The six distinct poses of Fu et al. (2018), Table 1 (names are ours), with positions and approach as another
/// program computed them from the same rows.
#[rustfmt::skip]
pub const UP6_POSES: [Printed; 6] = [
    printed("H", [0.0, -90.0, 0.0, 0.0, 90.0, 0.0], [790.0, 0.0, 1055.0], [790.0, 0.0, 905.0], [0.0, 0.0, -1.0]),
    printed("P1", [-41.0, -49.0, 2.0, -7.0, 47.0, -41.0], [810.3, -715.6, 444.2], [802.0, -726.1, 294.8], [-0.056, -0.070, -0.996]),
    printed("P2", [56.0, -78.0, 45.0, -7.0, 33.0, 56.0], [411.4, 598.7, 446.8], [420.0, 593.6, 297.1], [0.057, -0.034, -0.998]),
    printed("P3", [7.0, -43.0, -24.0, 92.0, 83.0, -22.0], [1198.2, 242.1, 706.8], [1198.7, 392.0, 704.5], [0.004, 1.000, -0.016]),
    printed("P5", [-16.0, -38.0, -34.0, -100.0, 61.0, -23.0], [1223.5, -436.0, 726.3], [1261.1, -581.2, 725.5], [0.251, -0.968, -0.005]),
    printed("P6", [10.0, -49.0, -53.0, -7.0, 102.0, 10.0], [1107.7, 183.8, 1046.1], [1110.6, 166.2, 897.2], [0.019, -0.118, -0.993]),
];

pub fn radians(degrees: [f64; 6]) -> Joints {
    degrees.map(f64::to_radians)
}

#[test]
fn the_up6_is_where_its_table_of_poses_says() {
    let up6 = robot("motoman_up6");
    let chain = up6.arm().chain();
    for Printed { name, degrees, flange_mm, tip_mm, approach } in UP6_POSES {
        let q = radians(degrees);
        let flange = chain.flange(&q);
        let tip = chain.forward(&q);
        let off = |found: Vec3, printed: [f64; 3]| (found - Vec3::from(printed)).abs().max();
        assert!(off(flange.origin * 1e3, flange_mm) <= 0.0501, "{name}: flange {:?}", flange.origin);
        assert!(off(tip.origin * 1e3, tip_mm) <= 0.0501, "{name}: tip {:?}", tip.origin);
        assert!(off(tip.axis(2), approach) <= 0.000_501, "{name}: approach {:?}", tip.axis(2));
        assert!(chain.allows(&q), "{name} is outside the limits");
        if ["H", "P1", "P2", "P6"].contains(&name) {
            assert_eq!(degrees[1] + degrees[2] + degrees[4], 0.0, "{name}");
            assert_eq!(degrees[5], degrees[0], "{name}");
        }
    }
}

#[test]
fn the_aubo_at_zero_stands_upright_with_its_flange_beside_it() {
    let flange = robot("aubo_i10").arm().chain().flange(&[0.0; AXES]);
    assert!((flange.origin - Vec3::new(0.0, -0.2953, 1.5132)).norm() < 1e-12, "{flange:?}");
    assert!((flange.axis(2) + Vec3::y()).norm() < 1e-12, "{flange:?}");
}

#[test]
fn the_ur5_and_the_puma_at_zero_are_where_their_tables_add_up_to() {
    let ur5 = robot("ur5").arm().chain().flange(&[0.0; AXES]);
    assert!((ur5.origin - Vec3::new(-0.817_25, -0.191_45, -0.005_491)).norm() < 1e-12, "{ur5:?}");
    assert!((ur5.axis(2) + Vec3::y()).norm() < 1e-12, "{ur5:?}");
    let puma = robot("puma560").arm().chain().flange(&[0.0; AXES]);
    assert!((puma.origin - Vec3::new(0.4521, -0.150_05, 0.672 + 0.4318)).norm() < 1e-12, "{puma:?}");
    assert!((puma.axis(2) - Vec3::z()).norm() < 1e-12, "{puma:?}");
}

/// Rows of an arm in degrees and millimetres: alpha, a, d, offset.
pub type Rows = [[f64; 4]; AXES];

/// Source: "DH Parameters for calculations of kinematics and dynamics", Universal Robots.
const UR10E: Rows = [
    [90.0, 0.0, 180.7, 0.0],
    [0.0, -612.7, 0.0, 0.0],
    [0.0, -571.55, 0.0, 0.0],
    [90.0, 0.0, 174.15, 0.0],
    [-90.0, 0.0, 119.85, 0.0],
    [0.0, 0.0, 116.55, 0.0],
];

/// Source: lengths of the product specification IRB 120, ABB: 290, 270, 70, 302 and 72 mm.
const IRB120: Rows = [
    [-90.0, 0.0, 290.0, 0.0],
    [0.0, 270.0, 0.0, -90.0],
    [-90.0, 70.0, 0.0, 0.0],
    [90.0, 0.0, 302.0, 0.0],
    [-90.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 72.0, 180.0],
];

/// The joints of these rows, each free to turn half a turn either way.
pub fn joints_of(rows: &Rows) -> [Joint; AXES] {
    rows.map(|[alpha_deg, a_mm, d_mm, offset_deg]| Joint {
        alpha_rad: alpha_deg.to_radians(),
        a_m: a_mm * 1e-3,
        d_m: d_mm * 1e-3,
        offset_rad: offset_deg.to_radians(),
        lower_rad: -PI,
        upper_rad: PI,
        speed_rad_s: 1.0,
    })
}

#[test]
fn arms_by_their_makers_rows_stand_at_zero_where_their_lengths_add_up_to() {
    let zero = |chain: &Chain| chain.flange(&[0.0; AXES]);
    let chain = |rows| Chain::new(joints_of(rows), Frame::IDENTITY, Frame::IDENTITY).unwrap();
    let ur10e = zero(&chain(&UR10E)).origin;
    let out = -0.6127 - 0.57155;
    assert!((ur10e - Vec3::new(out, -0.17415 - 0.11655, 0.1807 - 0.11985)).norm() < 1e-12, "{ur10e:?}");
    let irb120 = zero(&chain(&IRB120));
    let wrist = Vec3::new(0.302 + 0.072, 0.0, 0.29 + 0.27 + 0.07);
    assert!(
        (irb120.origin - wrist).norm() < 1e-12 && (irb120.axis(2) - Vec3::x()).norm() < 1e-12,
        "{irb120:?}"
    );
    // By the modified convention twists and lengths stand one row later.
    let mut later = IRB120;
    for (row, before) in later.iter_mut().skip(1).zip(&IRB120) {
        row[..2].copy_from_slice(&before[..2]);
    }
    later[0][..2].fill(0.0);
    let (modified, _) = Chain::modified(joints_of(&later), Frame::IDENTITY, Frame::IDENTITY).unwrap();
    let q = [0.3, -0.4, 0.5, 0.6, -0.7, 0.8];
    let apart = |q: &Joints| (modified.flange(q).origin - chain(&IRB120).flange(q).origin).norm();
    assert!(apart(&[0.0; AXES]) < 1e-12 && apart(&q) < 1e-12);
}

/// One row of the modified convention, entry by entry.
fn modified_row(joint: &Joint, angle_rad: f64) -> Matrix4<f64> {
    let (s, c) = libm::sincos(angle_rad + joint.offset_rad);
    let ((sa, ca), d) = (libm::sincos(joint.alpha_rad), joint.d_m);
    #[rustfmt::skip]
    let row = Matrix4::new(
        c, -s, 0.0, joint.a_m,
        s * ca, c * ca, -sa, -sa * d,
        s * sa, c * sa, ca, ca * d,
        0.0, 0.0, 0.0, 1.0,
    );
    row
}

#[test]
fn modified_rows_put_every_frame_of_the_link_where_craig_does() {
    let seed = 714;
    let mut worst = 0.0_f64;
    let mut stream = seed::stream(seed);
    for _ in 0..1_000 {
        let rows: [Joint; AXES] = std::array::from_fn(|_| Joint {
            alpha_rad: stream.random_range(-PI..PI),
            a_m: stream.random_range(-0.5..0.5),
            d_m: stream.random_range(-0.5..0.5),
            offset_rad: stream.random_range(-PI..PI),
            lower_rad: -PI,
            upper_rad: PI,
            speed_rad_s: 1.0,
        });
        let (chain, near) = Chain::modified(rows, Frame::IDENTITY, Frame::IDENTITY).unwrap();
        let q = draw(&mut stream, &chain);
        let frames = chain.frames(&q);
        let mut craig = Matrix4::identity();
        for link in 0..=AXES {
            let ours = frames[link] * near[link];
            worst = worst.max((ours.rotation - craig.fixed_view::<3, 3>(0, 0)).abs().max());
            worst = worst.max((ours.origin - craig.fixed_view::<3, 1>(0, 3)).abs().max());
            if link < AXES {
                craig *= modified_row(&rows[link], q[link]);
            }
        }
    }
    assert!(worst < 1e-13, "seed {seed}: off by {worst}");
}

/// The maker's chain of joint frames, each `(xyz; rpy)` before its joint.
fn urdf_flange(q: &Joints) -> Isometry3<f64> {
    let joints = [
        ([0.0, 0.0, 0.1632], [0.0, 0.0, PI]),
        ([0.0, 0.2013, 0.0], [-FRAC_PI_2, -FRAC_PI_2, 0.0]),
        ([0.647, 0.0, 0.0], [PI, 0.0, 0.0]),
        ([0.6005, 0.0, 0.0], [PI, 0.0, FRAC_PI_2]),
        ([0.0, 0.1025, 0.0], [-FRAC_PI_2, 0.0, 0.0]),
        ([0.0, -0.094, 0.0], [FRAC_PI_2, 0.0, 0.0]),
    ];
    joints.iter().zip(q).fold(Isometry3::identity(), |pose, (([x, y, z], [roll, pitch, yaw]), angle)| {
        let fixed = UnitQuaternion::from_euler_angles(*roll, *pitch, *yaw);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), *angle);
        pose * Isometry3::from_parts(Translation3::new(*x, *y, *z), fixed * turn)
    })
}

#[test]
fn the_aubo_rows_and_the_makers_chain_of_frames_are_one_robot() {
    let seed = 710;
    let aubo = robot("aubo_i10");
    let mut stream = seed::stream(seed);
    for index in 0..10_000 {
        let q = draw(&mut stream, aubo.arm().chain());
        let (ours, theirs) = (aubo.arm().chain().flange(&q), urdf_flange(&q));
        let off = (ours.origin - theirs.translation.vector).norm();
        let turned = (ours.rotation - theirs.rotation.to_rotation_matrix().into_inner()).abs().max();
        assert!(off < 1e-12 && turned < 1e-12, "seed {seed} case {index}: off {off} m, turned {turned}");
    }
}

#[test]
fn the_base_stands_before_the_chain_and_the_tool_after_it() {
    let seed = 711;
    let up6 = robot("motoman_up6");
    let chain = up6.arm().chain();
    let base = Frame::at(Vec3::new(1.0, 2.0, 3.0)) * Frame::turned(&Vec3::z(), 0.4);
    let tool = Frame::at(Vec3::new(0.1, 0.0, 0.2)) * Frame::turned(&Vec3::x(), 0.7);
    let moved = Chain::new(*chain.joints(), base, tool).unwrap();
    let q = draw(&mut seed::stream(seed), chain);
    let expected = base * chain.flange(&q) * tool;
    let found = moved.forward(&q);
    assert!((expected.rotation - found.rotation).norm() < 1e-14, "{expected:?} {found:?}");
    assert!((expected.origin - found.origin).norm() < 1e-14, "{expected:?} {found:?}");
    let frames = moved.frames(&q);
    assert_eq!((frames[0], frames[6]), (base, moved.flange(&q)));
}

/// The rotation vector of a small rotation.
fn small_turn(from: &Frame, to: &Frame) -> Vec3 {
    let r = to.rotation * from.rotation.transpose();
    Vec3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) * 0.5
}

#[test]
fn the_jacobian_is_what_finite_differences_say_for_any_point_of_any_link() {
    let step = 1e-6;
    for (seed, name) in [(712, "motoman_up6"), (713, "aubo_i10")] {
        let robot = robot(name);
        let chain = robot.arm().chain();
        let mut stream = seed::stream(seed);
        for case in 0..1_000 {
            let q = draw(&mut stream, chain);
            let link = case % 7;
            let local = Vec3::from_fn(|_, _| stream.random_range(-0.5..0.5));
            let frames = chain.frames(&q);
            let jacobian = Chain::jacobian(&frames, link, &frames[link].point(&local));
            for joint in 0..AXES {
                let moved = |by: f64| {
                    let mut q = q;
                    q[joint] += by;
                    chain.frames(&q)[link]
                };
                let (before, after) = (moved(-step), moved(step));
                let velocity = (after.point(&local) - before.point(&local)) / (2.0 * step);
                let turn = small_turn(&before, &after) / (2.0 * step);
                let column = jacobian.column(joint);
                let off = (column.fixed_rows::<3>(0) - velocity).norm();
                let turned = (column.fixed_rows::<3>(3) - turn).norm();
                let place = format!("seed {seed} case {case} link {link} joint {joint}");
                assert!(off < 1e-8 && turned < 1e-8, "{place}: {off} m, {turned} rad a radian");
            }
        }
    }
}
