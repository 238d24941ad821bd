use super::*;
#[test]
fn try_numerical() {
    let d = |i: usize| (i as f64).to_radians();
    let _ = d;
    let s = 0.5 / 60f64.to_radians().sin();
    let (d4, d5, d6) = (0.2073 + s * 0.0743, 2.0 * s * 0.0743, s * 0.0743 + 0.1687);
    let jaco = [[90.0, 0.0, 0.2755], [180.0, 0.41, 0.0], [90.0, 0.0, -0.0098], [60.0, 0.0, -d4], [60.0, 0.0, -d5], [180.0, 0.0, -d6]];
    let crx = [[-90.0, 0.0, 0.0], [180.0, 0.54, 0.0], [-90.0, 0.0, 0.0], [90.0, 0.0, -0.54], [-90.0, 0.0, 0.15], [180.0, 0.0, -0.16]];
    let doty = [[90.0, 0.3, 0.0], [1.0, 1.0, 0.0], [90.0, 0.0, 0.2], [1.0, 1.5, 0.0], [90.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    for (name, rows) in [("jaco", jaco), ("crx", crx), ("doty", doty)] {
        let joints = rows.map(|[alpha, a_m, d_m]: [f64; 3]| crate::kinematics::Joint {
            alpha_rad: alpha.to_radians(), a_m, d_m, offset_rad: 0.0, lower_rad: -PI, upper_rad: PI, speed_rad_s: 1.0 });
        let arm = Arm::new(Chain::new(joints, Frame::IDENTITY, Frame::IDENTITY).unwrap(), None).unwrap();
        eprintln!("{name} {}", arm.solver());
        let mut stream = seed::stream(77);
        let (mut lost, mut own, mut count, mut on) = (0, 0, 0, 0);
        let n = 300;
        let started = std::time::Instant::now();
        let cases: Vec<_> = (0..n).map(|_| (draw(&mut stream, arm.chain()), draw(&mut stream, arm.chain()))).collect();
        for (q, reference) in &cases {
            let target = arm.chain().forward(q);
            let all = arm.inverse(&target, reference);
            count += all.iter().count();
            lost += usize::from(all.iter().next().is_none());
            own += usize::from(all.iter().any(|(_, p)| change(p, q) < 1e-5));
        }
        let t1 = started.elapsed() / n;
        let started = std::time::Instant::now();
        for (q, reference) in &cases {
            let target = arm.chain().forward(q);
            on += usize::from(arm.inverse_on(&target, arm.branch_of(q), reference).is_some());
        }
        let t2 = started.elapsed() / n;
        eprintln!("{name}: lost {lost}, own found {own}, solutions {count} of {n}, on branch {on}, all {t1:?}, on {t2:?}");
    }
}
