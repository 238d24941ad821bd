//! URDF files, right and wrong.

use super::*;
use crate::settings::Document;
use crate::solid::Form;
use std::fs;
use std::path::Path;

/// Two joints, a mast between them that is welded to a plate, and a tool of two fixed links.
const ARM: &str = r#"<?xml version="1.0"?>
<!-- two joints -->
<robot name="two">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="plate"/>
    <origin xyz="0 0 0.1" rpy="0 0 1.5708"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="2" effort="1" velocity="3"/>
  </joint>
  <link name="plate"/>
  <joint name="weld" type="fixed"><parent link="plate"/><child link="mast"/><origin xyz="0.3 0 0"/></joint>
  <link name="mast">
    <collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.05" length="0.4"/></geometry></collision>
    <collision><geometry><mesh filename="package://two/meshes/foot.stl" scale="0.001 0.001 0.001"/></geometry></collision>
  </link>
  <joint name="nod" type="continuous">
    <parent link="mast"/><child link="arm"/>
    <origin xyz="0 0 0.4"/><axis xyz="0 1 0"/><limit effort="1" velocity="1"/>
  </joint>
  <link name="arm"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="flange" type="fixed"><parent link="arm"/><child link="hand"/><origin xyz="0 0 0.5" rpy="0 1.5708 0"/></joint>
  <link name="hand"/>
  <joint name="cam" type="fixed"><parent link="arm"/><child link="camera"/></joint>
  <link name="camera"/>
  <joint name="tip" type="fixed"><parent link="hand"/><child link="tool"/><origin xyz="0 0 0.1"/></joint>
  <link name="tool"/>
</robot>
"#;

const FOOT: &str = "solid foot\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 100 0 0\nvertex 0 100 0\nendloop\nendfacet\n\
                    facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 100 0 0\nvertex 0 0 50\nendloop\nendfacet\nendsolid\n";

/// What is read of the file, with the mesh beside it.
fn read(text: &str, foot: &[u8]) -> Result<Robot, String> {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    fs::write(folder.path().join("meshes/foot.stl"), foot).unwrap();
    let path = folder.path().join("two.urdf");
    fs::write(&path, text).unwrap();
    read_urdf(&path).map_err(|error| error.to_string().replace(&folder.path().display().to_string(), ""))
}

#[test]
fn welded_links_are_one_and_everything_is_placed_in_the_frame_of_its_joint() {
    let robot = read(ARM, FOOT.as_bytes()).unwrap();
    let names: Vec<(usize, &str)> =
        robot.solids.iter().map(|(link, solid)| (*link, solid.name.as_str())).collect();
    assert_eq!(names, [(0, "base"), (1, "mast"), (1, "mast 2"), (2, "arm")]);
    assert_eq!(robot.solids[0].1.form, Form::Box([0.1, 0.1, 0.05]), "half of its sides");
    assert_eq!(robot.solids[1].1.pose.origin_m, [0.3, 0.0, 0.2]);
    assert_eq!(robot.solids[1].1.form, Form::Cylinder(0.05, 0.4));
    assert!(
        matches!(&robot.solids[2].1.form, Form::Hull(points) if points.len() == 4 && points[3] == [0.1, 0.0, 0.0])
    );
    let [turn, nod] = &robot.joints[..] else { panic!("{:?}", robot.joints) };
    assert_eq!((turn.axis, turn.limits_rad, turn.speed_rad_s), ([0.0, 0.0, 1.0], [-1.0, 2.0], 3.0));
    assert_eq!(turn.before.point([1.0, 0.0, 0.0]), [0.0, 1.0, 0.1], "1.5708 is a right angle");
    assert_eq!((nod.before.origin_m, nod.limits_rad[1]), ([0.3, 0.0, 0.4], std::f64::consts::PI));
    assert_eq!(
        robot.tip.origin_m,
        [0.1, 0.0, 0.5],
        "the link that the most joints lead to, ahead of the turned hand"
    );
    assert_eq!(robot.files.len(), 1);
}

#[test]
fn a_mesh_is_read_as_text_and_as_numbers() {
    let mut binary = vec![0; 80];
    binary.extend(2_u32.to_le_bytes());
    for facet in [
        [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 100.0, 0.0]],
        [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 0.0, 50.0]],
    ] {
        binary.extend([0; 12]);
        binary.extend(facet.iter().flatten().flat_map(|x: &f32| x.to_le_bytes()));
        binary.extend([0; 2]);
    }
    let [numbers, text] = [&binary[..], FOOT.as_bytes()].map(|foot| read(ARM, foot).unwrap());
    assert_eq!(numbers.solids, text.solids);
}

/// A change of the file, and what must be said of it.
const WRONG: &[(&str, &str, &str)] = &[
    ("</robot>", "</robo>", "/two.urdf:27:1: this is no XML: expected 'robot' tag, not 'robo' at 27:1"),
    (
        "<robot name=\"two\">",
        "<robot name=\"two\"> <!-- ${x} -->",
        "this is xacro; what `xacro` makes of it is accepted",
    ),
    (
        "<joint name=\"tip\" type=\"fixed\">",
        "<joint name=\"f\" type=\"revolute\"><parent link=\"arm\"/><child link=\"finger\"/><axis xyz=\"0 0 1\"/>\
         <limit lower=\"0\" upper=\"1\" velocity=\"1\"/></joint><link name=\"finger\"/><joint name=\"g\" type=\"revolute\">\
         <parent link=\"arm\"/><child link=\"thumb\"/></joint><link name=\"thumb\"/><joint name=\"tip\" type=\"fixed\">",
        "/two.urdf:25:166: the tree branches at link `arm`: joints `f` and `g` both move; one chain is accepted",
    ),
    (
        "<limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"3\"/>",
        "",
        "/two.urdf:5:3: a revolute joint needs a limit (lower, upper and velocity; continuous: velocity): joint `turn` has no `limit`",
    ),
    ("upper=\"2\" ", "", "/two.urdf:8:5: the element `limit` has no `upper`; one is accepted"),
    (
        "upper=\"2\"",
        "upper=\"-2\"",
        "/two.urdf:8:23: upper of joint `turn` is -2; more than lower, -1, is accepted",
    ),
    (
        "upper=\"2\"",
        "upper=\"170\"",
        "/two.urdf:8:23: upper of joint `turn` is 170; is it in degrees? radians are accepted",
    ),
    ("upper=\"2\"", "upper=\"NaN\"", "/two.urdf:8:23: upper has the number NaN; finite numbers are accepted"),
    (
        "velocity=\"3\"",
        "velocity=\"0\"",
        "/two.urdf:8:44: the velocity of joint `turn` is 0; a number above 0 is accepted",
    ),
    (
        "type=\"continuous\"",
        "type=\"prismatic\"",
        "/two.urdf:16:21: joint `nod` is prismatic; revolute, continuous and fixed are accepted",
    ),
    (
        "foot.stl",
        "boot.stl",
        "/two.urdf:14:32: there is no mesh `package://two/meshes/boot.stl`; looked for /meshes/boot.stl, ",
    ),
    (
        "foot.stl",
        "foot.dae",
        "/two.urdf:14:32: the mesh `package://two/meshes/foot.dae` is no STL file; STL files are accepted",
    ),
    (
        " scale=\"0.001 0.001 0.001\"",
        "",
        "/two.urdf:14:32: a mesh in millimetres wants scale=\"0.001 0.001 0.001\": the mesh has the length 50 m; is it in",
    ),
    (
        "xyz=\"0.3 0 0\"",
        "xyz=\"300 0 0\"",
        "/two.urdf:11:85: xyz has the length 300 m; is it in millimetres? lengths in metres are accepted, up to",
    ),
    ("rpy=\"0 1.5708 0\"", "rpy=\"0 90 0\"", "rpy has the angle 90; is it in degrees? radians are accepted"),
    ("xyz=\"0.3 0 0\"", "xyz=\"0.3 0\"", "/two.urdf:11:85: xyz is `0.3 0`; 3 numbers are accepted"),
    ("xyz=\"0.3 0 0\"", "xyz=\"0.3 inf 0\"", "xyz has the number inf; finite numbers are accepted"),
    (
        "axis xyz=\"0 1 0\"",
        "axis xyz=\"0 0 0\"",
        "/two.urdf:18:28: the axis of joint `nod` is [0.0, 0.0, 0.0]; a direction is accepted",
    ),
    (
        "radius=\"0.05\"",
        "radius=\"-1\"",
        "/two.urdf:13:59: radius has the size -1; sizes above 0 are accepted",
    ),
    (
        "joint name=\"weld\"",
        "joint name=\"nod\"",
        "/two.urdf:16:3: joint `nod` is given twice; accepted: a name of its own",
    ),
    ("<sphere radius=\"0.1\"/>", "<cone/>", "a solid is `cone`; box, cylinder, sphere and mesh are accepted"),
    (
        "<child link=\"arm\"/>",
        "<child link=\"leg\"/>",
        "/two.urdf:17:33: there is no link `leg`; the links are arm, base, camera, hand",
    ),
    (
        "<parent link=\"plate\"/>",
        "<parent link=\"tool\"/>",
        "/two.urdf:20:3: no joints lead from the base to link `arm`; one chain is accepted",
    ),
    (
        "<link name=\"plate\"/>",
        "<link name=\"plate\"/><link name=\"lost\"/>",
        "no joint leads to link `lost`, nor to `base`; one base is accepted",
    ),
];

#[test]
fn every_bad_input_is_refused_at_its_place() {
    let mut missed = Vec::new();
    for (from, to, said) in WRONG {
        assert!(ARM.contains(from), "{from}");
        match read(&ARM.replacen(from, to, 1), FOOT.as_bytes()) {
            Ok(_) => missed.push(format!("{to}\nis accepted; should say: {said}")),
            Err(error) if !error.contains(said) => {
                missed.push(format!("{to}\nshould say: {said}\nsays:       {error}"));
            }
            Err(_) => {}
        }
    }
    for (foot, said) in [
        (
            &b"\x00\x01"[..],
            "/meshes/foot.stl: its 2 bytes are neither a binary STL file (84 bytes and 50 a facet) nor a text",
        ),
        (b"solid\nvertex 0 0\n", "/meshes/foot.stl: line 2: found `vertex 0 0`; `vertex x y z` is accepted"),
        (b"solid\nvertex 0 0 0\n", "it has 1 distinct vertices; at least 4 are accepted"),
        (b"solid\nvertex 0 nan 0\n", "it has the vertex [0.0, NaN, 0.0]; finite numbers are accepted"),
    ] {
        let error = read(ARM, foot).unwrap_err();
        if !error.contains(said) {
            missed.push(format!("should say: {said}\nsays:       {error}"));
        }
    }
    let bare = read(&ARM.replace("collision>", "visual>"), FOOT.as_bytes()).unwrap_err();
    let said = "/two.urdf:3:1: no link has a `collision`: nothing could be touched; at least one";
    if !bare.contains(said) {
        missed.push(format!("should say: {said}\nsays:       {bare}"));
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
    assert!(
        parse_urdf(&Document::new(Path::new("x.urdf"), "<sdf/>".to_owned()))
            .unwrap_err()
            .to_string()
            .contains("found the element `sdf`")
    );
}
