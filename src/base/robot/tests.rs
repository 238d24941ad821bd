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
    assert_eq!((turn.axis, turn.limits, turn.speed), ([0.0, 0.0, 1.0], [-1.0, 2.0], Some(3.0)));
    assert_eq!(turn.before.point([1.0, 0.0, 0.0]), [0.0, 1.0, 0.1], "1.5708 is a right angle");
    assert_eq!((nod.before.origin_m, nod.kind), ([0.3, 0.0, 0.4], Kind::TurnsOn));
    assert_eq!(
        robot.tip.origin_m,
        [0.1, 0.0, 0.5],
        "the link that the most joints lead to, ahead of the turned hand"
    );
    assert_eq!(robot.files.len(), 1);
}

/// A change of the file, and the message about it.
const WRONG: &[(&str, &str, &str)] = &[
    ("</robot>", "</robo>", "/two.urdf:27:1: this is no XML: expected 'robot' tag, not 'robo' at 27:1"),
    (
        "<robot name=\"two\">",
        "<!DOCTYPE robot [<!ENTITY w \"0.2\">]><robot name=\"two\">",
        "a document type, `<!DOCTYPE`, is given; XML without one is accepted",
    ),
    (
        "size=\"0.2 0.2 0.1\"",
        "size=\"${w} 0.2 0.1\"",
        "/two.urdf:4:47: this is xacro; what `xacro` makes of it is accepted",
    ),
    (
        "<link name=\"plate\"/>",
        "<xacro:plate/>",
        "/two.urdf:10:4: this is xacro; what `xacro` makes of it is accepted",
    ),
    (
        "<robot name=\"two\">",
        "<robot name=\"two\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><xacro:property name=\"w\" value=\"1\"/>",
        "/two.urdf:3:63: this is xacro; what `xacro` makes of it is accepted",
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
        "/two.urdf:5:3: joint `turn` has no `limit`; one is accepted (lower, upper)",
    ),
    (
        "lower=\"-1\" upper=\"2\" ",
        "",
        "/two.urdf:8:5: upper of joint `turn` is 0; more than lower, 0, is accepted",
    ),
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
    ("upper=\"2\"", "upper=\"NaN\"", "/two.urdf:8:23: upper is `NaN`; a finite number is accepted"),
    (
        "velocity=\"3\"",
        "velocity=\"-3\"",
        "/two.urdf:8:44: the velocity of joint `turn` is -3; 0 (unknown) or more is accepted",
    ),
    (
        "type=\"continuous\"",
        "type=\"floating\"",
        "/two.urdf:16:21: joint `nod` is floating; revolute, continuous, prismatic and fixed are accepted",
    ),
    (
        "<axis xyz=\"0 1 0\"/>",
        "<axis xyz=\"0 1 0\"/><mimic joint=\"turn\"/>",
        "/two.urdf:18:47: joint `nod` follows `turn`; joints that move by themselves are accepted (one that need",
    ),
    (
        "type=\"revolute\"",
        "type=\"planar\"",
        "joint `turn` is planar; revolute, continuous, prismatic and fixed are accepted",
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
    ("xyz=\"0.3 0 0\"", "xyz=\"0.3 inf 0\"", "xyz is `0.3 inf 0`; 3 finite numbers are accepted"),
    ("xyz=\"0.3 0 0\"", "xyz=\"0.3 1e400 0\"", "xyz is `0.3 1e400 0`; 3 finite numbers are accepted"),
    (
        "axis xyz=\"0 1 0\"",
        "axis xyz=\"0 0 0\"",
        "/two.urdf:18:28: the axis of joint `nod` is 0 0 0; a direction is accepted",
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
        "rpy=\"0 0 1.5708\"",
        "quat_xyzw=\"0 0 0 1\"",
        "/two.urdf:7:27: `origin`: unknown key `@quat_xyzw`; accepted: @xyz, @rpy",
    ),
    (
        "rpy=\"0 1.5708 0\"",
        "ryp=\"0 1 0\"",
        "`origin`: unknown key `@ryp` (did you mean `@rpy`?); accepted: @xyz",
    ),
    (
        "<origin xyz=\"0.3 0 0\"/>",
        "<orgin/>",
        "`joint`: unknown key `orgin` (did you mean `origin`?); accepted: ",
    ),
    ("<axis xyz=\"0 1 0\"/>", "<axes/>", "`joint`: unknown key `axes` (did you mean `axis`?); accepted: "),
    ("<axis xyz=\"0 1 0\"/>", "<axis frame=\"x\"/>", "`axis`: unknown key `@frame`; accepted: @xyz"),
    (
        "upper=\"2\"",
        "upper=\"2\" soft=\"1\"",
        "`limit`: unknown key `@soft`; accepted: @lower, @upper, @velocity, @effort",
    ),
    (
        "<link name=\"plate\"/>",
        "<link name=\"plate\"><colision/></link>",
        "`link`: unknown key `colision` (did you mean `collision`?); accepted: @name, collision, visual",
    ),
    (
        "<link name=\"plate\"/>",
        "<link name=\"plate\"><capsule/></link>",
        "`link`: unknown key `capsule`; accepted: ",
    ),
    (
        "<sphere radius=\"0.1\"/>",
        "<capsule radius=\"0.1\" length=\"1\"/>",
        "/two.urdf:20:41: a solid is `capsule`; box, cylinder, sphere and mesh are accepted",
    ),
    (
        "<axis xyz=\"0 0 2\"/>",
        "<axle/><axis xyz=\"0 0 2\"/>",
        "accepted: @name, @type, parent, child, origin, axis, limit, mimic, dynamics, safety_controller, calibration",
    ),
    ("<box size", "<box scale=\"2\" size", "`box`: unknown key `@scale`; accepted: @size"),
    (
        "</robot>",
        "<jiont/></robot>",
        "`robot`: unknown key `jiont` (did you mean `joint`?); accepted: @name, @version",
    ),
    (
        "<origin xyz=\"0.3 0 0\"/>",
        "<origin/><origin/>",
        "/two.urdf:11:86: a second origin in `joint`; one is accepted",
    ),
    ("<axis xyz=\"0 1 0\"/>", "<axis/><axis/>", "a second axis in `joint`; one is accepted"),
    (
        "<limit effort=\"1\" velocity=\"1\"/>",
        "<limit/><limit/>",
        "a second limit in `joint`; one is accepted",
    ),
    (
        "<sphere radius=\"0.1\"/>",
        "<sphere radius=\"0.1\"/><cone/>",
        "a second solid in `geometry`; one is accepted",
    ),
    (
        "<robot name=\"two\">",
        "<robot name=\"two\" version=\"1.1\">",
        "/two.urdf:3:19: version is `1.1`; `1.0` is accepted",
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
    for (from, to, expected) in WRONG {
        assert!(ARM.contains(from), "{from}");
        match read(&ARM.replacen(from, to, 1), FOOT.as_bytes()) {
            Ok(_) => missed.push(format!("{to}\nis accepted; should say: {expected}")),
            Err(error) if !error.contains(expected) => {
                missed.push(format!("{to}\nshould say: {expected}\nsays:       {error}"));
            }
            Err(_) => {}
        }
    }
    for (foot, expected) in [
        (
            &b"\x00\x01"[..],
            "/meshes/foot.stl: its 2 bytes are too few for a binary STL file, and its text does not begin with `solid`",
        ),
        (b"solid\nvertex 0 0\n", "/meshes/foot.stl: line 2: found `vertex 0 0`; `vertex x y z` is accepted"),
        (b"solid\nvertex 0 0 0\n", "it has 1 distinct vertices; at least 4 are accepted"),
        (b"solid\nvertex 0 nan 0\n", "it has the vertex 0 NaN 0; finite numbers are accepted"),
    ] {
        let error = read(ARM, foot).unwrap_err();
        if !error.contains(expected) {
            missed.push(format!("should say: {expected}\nsays:       {error}"));
        }
    }
    let bare = read(&ARM.replace("collision>", "visual>"), FOOT.as_bytes()).unwrap_err();
    let expected = "/two.urdf:3:1: no link has a `collision`: nothing could be touched; at least one";
    if !bare.contains(expected) {
        missed.push(format!("should say: {expected}\nsays:       {bare}"));
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
    assert!(
        parse_urdf(&Document::new(Path::new("x.urdf"), "<sdf/>".to_owned()))
            .unwrap_err()
            .to_string()
            .contains("found the element `sdf`")
    );
}

/// A binary mesh of two facets whose head begins with `solid`, as some programs write it.
fn binary_foot() -> Vec<u8> {
    let mut binary = vec![b' '; 80];
    binary[..5].copy_from_slice(b"solid");
    binary.extend(2_u32.to_le_bytes());
    for facet in [
        [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 100.0, 0.0]],
        [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 0.0, 50.0]],
    ] {
        binary.extend([0; 12]);
        binary.extend(facet.iter().flatten().flat_map(|x: &f32| x.to_le_bytes()));
        binary.extend([0; 2]);
    }
    binary
}

#[test]
fn a_mesh_is_read_as_text_and_as_numbers_and_bytes_too_many_are_counted() {
    let binary = binary_foot();
    let [numbers, text] = [&binary[..], FOOT.as_bytes()].map(|foot| read(ARM, foot).unwrap());
    assert_eq!(numbers.solids, text.solids);
    let error = read(ARM, &[&binary[..], &[0; 4]].concat()).unwrap_err();
    let expected = "foot.stl: its head says 2 facets, which take 184 bytes as a binary STL file; it has 188";
    assert!(error.contains(expected), "should say {expected}\nsays {error}");
}

/// Changes of the file that mean nothing, or what the format says of what is left out.
const RIGHT: &[(&str, &str)] = &[
    ("<!-- two joints -->", "<!-- ${x}, $(find two) -->"),
    ("<robot name=\"two\">", "<robot name=\"two\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">"),
    ("<?xml version=\"1.0\"?>\n", "\u{feff}"),
    ("<limit effort=\"1\" velocity=\"1\"/>", ""),
    ("<limit effort=\"1\" velocity=\"1\"/>", "<limit effort=\"1\"/>"),
    ("<limit effort=\"1\" velocity=\"1\"/>", "<limit lower=\"-1\" upper=\"1\" velocity=\"0\"/>"),
    ("package://two/meshes", "model://two/meshes"),
    ("package://two/meshes", "meshes"),
    (
        "<link name=\"base\">",
        "<link name=\"world\"/><joint name=\"stand\" type=\"fixed\"><parent link=\"world\"/><child link=\"base\"/></joint>\
         <link name=\"base\">",
    ),
    (
        "<link name=\"tool\"/>",
        "<link name=\"tool\"><visual><origin ryp=\"0\"/></visual><inertial/></link><transmission name=\"t\"/><gazebo/><material/>",
    ),
    ("<robot name=\"two\">", "<robot name=\"two\" version=\"1.0\">"),
    ("effort=\"1\" velocity=\"3\"", "effort=\"1\" velocity=\"3\" acceleration=\"4\" jerk=\"5\""),
    (
        "<parent link=\"plate\"/>",
        "<axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"0\"/><dynamics damping=\"1\"/><parent link=\"plate\"/>",
    ),
];

#[test]
fn what_the_format_leaves_open_is_read_as_it_says() {
    let plain = read(ARM, FOOT.as_bytes()).unwrap();
    for (from, to) in RIGHT {
        assert!(ARM.contains(from), "{from}");
        let robot = read(&ARM.replacen(from, to, 1), FOOT.as_bytes()).unwrap();
        let without_speed = |robot: &Robot| {
            let joints = robot.joints.iter().map(|joint| Joint { speed: None, ..joint.clone() });
            Robot {
                joints: joints.collect(),
                files: Vec::new(),
                base: String::new(),
                notes: Vec::new(),
                ..robot.clone()
            }
        };
        assert_eq!(without_speed(&robot), without_speed(&plain), "{to}");
    }
    let limits = |limit: &str| {
        let text = ARM.replacen("<limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"3\"/>", limit, 1);
        let joint = read(&text, FOOT.as_bytes()).unwrap().joints[0].clone();
        (joint.limits, joint.speed)
    };
    assert_eq!(
        limits("<limit upper=\"2\" velocity=\"0\"/>"),
        ([0.0, 2.0], None),
        "a lower limit is 0 if it is left out"
    );
    assert_eq!(limits("<limit lower=\"-1\"/>"), ([-1.0, 0.0], None));
}

#[test]
fn keys_that_are_ignored_and_elements_of_the_root_that_are_not_known_are_noted_by_name() {
    let ignored = |keys: &str| format!("ignored keys: {keys}; docs/FILES.md has the reasons");
    let robot = read(ARM, FOOT.as_bytes()).unwrap();
    assert_eq!((robot.base.as_str(), robot.notes), ("base", vec![ignored("`limit/@effort`")]));
    let text = ARM
        .replacen(
            "<link name=\"tool\"/>",
            "<link name=\"tool\"><visual/></link><transmission/><loop/><loop/>",
            1,
        )
        .replacen("<limit effort=\"1\"", "<limit lower=\"-1\" effort=\"1\"", 1)
        .replacen("<joint name=\"cam\" type=\"fixed\">", "<joint name=\"cam\" type=\"fixed\"><axis/>", 1);
    let keys = "`joint/axis`, `limit/@effort`, `limit/@lower`, `link/visual`, `robot/transmission`";
    let unknown = "`robot/loop` is not known and not used (2 times)".to_owned();
    assert_eq!(read(&text, FOOT.as_bytes()).unwrap().notes, [ignored(keys), unknown]);
}

#[test]
fn elements_of_another_namespace_are_no_links() {
    let text = ARM.replacen(
        "<link name=\"tool\"/>",
        "<link name=\"tool\"/><sim:link xmlns:sim=\"x\" name=\"far\"/>",
        1,
    );
    let robot = read(&text, FOOT.as_bytes()).unwrap();
    assert_eq!(robot.notes.last().unwrap(), "`robot/sim:link` is not known and not used");
    let all = ARM.replacen("<robot name", "<robot xmlns=\"http://www.ros.org\" name", 1);
    assert_eq!(read(&all, FOOT.as_bytes()).unwrap().joints, robot.joints);
}

#[test]
fn text_between_elements_is_noted_in_the_root_and_refused_elsewhere() {
    let noted = |from: &str, to: &str| read(&ARM.replacen(from, to, 1), FOOT.as_bytes()).unwrap().notes.pop();
    let stray = "the text `--> <!` in `robot` is not used";
    assert_eq!(noted("<link name=\"tool\"/>", "--&gt; &lt;!<link name=\"tool\"/>").unwrap(), stray);
    let others = noted("<link name=\"tool\"/>", "a<link name=\"tool\"/><![CDATA[b]]><!-- c -->d").unwrap();
    assert_eq!(others, "the text `a` in `robot` is not used, nor are 2 other texts");
    for (from, to, element) in [
        ("<link name=\"tool\"/>", "<link name=\"tool\">lower=\"-1\"</link>", "link"),
        ("<parent", "5<parent", "joint"),
        ("<geometry>", "<geometry>5", "geometry"),
    ] {
        let error = read(&ARM.replacen(from, to, 1), FOOT.as_bytes()).unwrap_err();
        let expected = format!("` stands in `{element}`; elements and attributes are accepted");
        assert!(
            error.contains("the text `") && error.contains(&expected),
            "should say {expected}\nsays {error}"
        );
    }
}

#[test]
fn a_joint_that_slides_has_limits_in_metres() {
    let slide = |limit: &str| {
        let text = ARM.replacen("type=\"revolute\"", "type=\"prismatic\"", 1).replacen(
            "lower=\"-1\" upper=\"2\"",
            limit,
            1,
        );
        read(&text, FOOT.as_bytes())
    };
    let joint = slide("lower=\"0\" upper=\"0.4\"").unwrap().joints[0].clone();
    assert_eq!((joint.kind, joint.limits, joint.change(0.1, 7.0)), (Kind::Slides, [0.0, 0.4], 6.9));
    let error = slide("lower=\"0\" upper=\"400\"").unwrap_err();
    assert!(
        error.contains("upper of joint `turn` is 400; is it in millimetres? metres are accepted"),
        "{error}"
    );
}

#[test]
fn a_joint_that_turns_on_may_be_anywhere_and_goes_the_shorter_way_round() {
    use std::f64::consts::{PI, TAU};
    let nod = read(ARM, FOOT.as_bytes()).unwrap().joints[1].clone();
    for (from, to, change) in
        [(3.0, -3.0, TAU - 6.0), (-3.0, 3.0, 6.0 - TAU), (0.5, 1.0, 0.5), (9.0 * PI, PI, 0.0)]
    {
        assert!((nod.change(from, to) - change).abs() < 1e-12, "{from} to {to}");
        assert!(nod.allows(from) && nod.allows(to));
    }
    assert!(!nod.allows(f64::NAN));
}

#[test]
fn links_that_an_srdf_file_lets_touch_are_read_and_its_other_elements_are_known_or_named() {
    let robot = read(ARM, FOOT.as_bytes()).unwrap();
    let pairs = |text: &str| {
        let document = Document::new(Path::new("two.srdf"), text.to_owned());
        parse_srdf(&document, &robot).map_err(|error| error.to_string())
    };
    let srdf = "<robot name=\"two\"><group name=\"arm\"/>\n\
                <disable_collisions link1=\"mast\" link2=\"base\" reason=\"Adjacent\"/></robot>";
    let read = pairs(srdf).unwrap();
    assert!(read.allows("base", "mast") && read.allows("mast", "base") && !read.allows("base", "arm"));
    let ignored = "ignored keys: `disable_collisions/@reason`, `robot/group`; docs/FILES.md has the reasons";
    assert_eq!(read.notes, [ignored]);
    let lost = pairs(&srdf.replace("\"base\"", "\"finger\"").replace("<group", "<pose")).unwrap();
    let notes = [
        "ignored keys: `disable_collisions/@reason`; docs/FILES.md has the reasons",
        "`robot/pose` is not known and not used",
        "no solid stands for the links `finger` of its pairs",
    ];
    assert_eq!(lost.notes, notes);
    for (from, to, expected) in [
        ("\"two\"", "\"three\"", "two.srdf:1:1: the file is of the robot `three`; `two` is accepted"),
        (
            "disable_coll",
            "enable_coll",
            "two.srdf:2:1: `enable_collisions` is not read; `disable_collisions` is",
        ),
        (
            "link2=\"base\"",
            "",
            "two.srdf:2:1: the element `disable_collisions` has no `link2`; one is accepted",
        ),
        (
            "disable_collisions",
            "disable_collision",
            "`disable_collision` is not read; `disable_collisions` is",
        ),
        (
            "disable_collisions",
            "disable_collisons",
            "two.srdf:2:1: `robot`: unknown key `disable_collisons` (did you mean `disable_collisions`?)",
        ),
        (
            "reason",
            "raeson",
            "`disable_collisions`: unknown key `@raeson` (did you mean `@reason`?); accepted: ",
        ),
        ("\"mast\"", "\"${side}\"", "this is xacro"),
    ] {
        let error = pairs(&srdf.replacen(from, to, 1)).unwrap_err();
        assert!(error.contains(expected), "should say {expected}\nsays {error}");
    }
}
