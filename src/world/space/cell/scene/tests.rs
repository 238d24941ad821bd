//! Scenes from files: what is read, and what is refused where.

use super::*;

const FLOOR: &str = "[support]\nunder = 'floor'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\n";

fn refusal(text: &str) -> String {
    let floor = if text.contains("[support]") { "" } else { FLOOR };
    let document = Document::new(Path::new("s.toml"), format!("name = 's'\n{text}{floor}"));
    Scene::parse(&document).unwrap_err().to_string()
}

#[test]
fn a_box_of_another_height_stands_where_it_stood() {
    let block = "[[box]]\nname = 'b'\nmin_mm = [0, 0, 100]\nmax_mm = [10, 20, 400]\nyaw_deg = 90\n";
    let text = format!("name = 's'\n{block}{FLOOR}");
    let scene = Scene::parse(&Document::new(Path::new("s.toml"), text)).unwrap();
    let changed = scene.with_height("b", 0.5).unwrap();
    let Some(Solid::Box(higher)) = changed.obstacles().last().map(|o| &o.solid) else { panic!("no box") };
    let z: Vec<f64> = higher.corners().iter().map(|corner| corner.z).collect();
    let [low, high] = [f64::min, f64::max].map(|of| z.iter().copied().reduce(of).unwrap());
    assert!((low - 0.1).abs() < 1e-12 && (high - 0.6).abs() < 1e-12, "{z:?}");
    assert_eq!(scene.with_height("c", 0.5).unwrap_err(), "there is no box `c`; the boxes are b");
    assert!(scene.with_height("b", 0.0).is_err());
}

#[test]
fn every_kind_of_obstacle_is_read_in_metres() {
    let text = "name = 's'\n[support]\nunder = 'pedestal'\nbase_mm = [0, 0, 100]\nyaw_deg = 90\nfloor_mm = -5\n\
                sides_mm = [200, 300]\n[[box]]\nname = 'b'\nmin_mm = [0, 0, 0]\nmax_mm = [100, 200, 300]\n\
                yaw_deg = 90\n[[sphere]]\nname = 'k'\ncenter_mm = [1, 2, 3]\nradius_mm = 50\n[[capsule]]\nname = 'c'\n\
                from_mm = [0, 0, 0]\nto_mm = [0, 0, 10]\nradius_mm = 5\n[[convex]]\nname = 'p'\n\
                vertices_mm = [[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]]\n";
    let scene = Scene::parse(&Document::new(Path::new("s.toml"), text.to_owned())).unwrap();
    let names: Vec<&str> = scene.obstacles().iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["floor", "pedestal", "b", "k", "c", "p"]);
    assert!((scene.base().origin.z - 0.1).abs() < 1e-15 && (scene.base().axis(0).y - 1.0).abs() < 1e-12);
    let turned = scene.obstacles()[2].solid.aabb();
    assert!((turned.max - Vec3::new(0.15, 0.15, 0.3)).norm() < 1e-12, "{turned:?}");
}

#[test]
fn a_scene_that_does_not_say_what_is_under_the_arm_is_refused() {
    let document = Document::new(Path::new("s.toml"), "name = 's'\n".to_owned());
    let refusal = Scene::parse(&document).unwrap_err().to_string();
    let parts = ["s.toml:1:1", "missing key `support`", "what is under it"];
    assert!(parts.iter().all(|part| refusal.contains(part)), "{refusal}");
}

#[test]
fn a_cleared_scene_keeps_what_the_robot_stands_on() {
    let text = format!("name = 's'\n{FLOOR}[[sphere]]\nname = 'k'\ncenter_mm = [1, 2, 3]\nradius_mm = 50\n");
    let scene = Scene::parse(&Document::new(Path::new("s.toml"), text)).unwrap().cleared();
    let names: Vec<&str> = scene.obstacles().iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["floor"]);
}

#[test]
fn a_wrong_scene_says_which_obstacle_where_and_what_is_accepted() {
    for (text, parts) in [
        (
            "[[box]]\nname = 'b'\nmin_mm = [0, 0, 0]\nmax_mm = [1, -2, 3]\n",
            ["s.toml:5:14", "obstacle `b`: `max_mm[1]` is -2; a number above `min_mm[1]`, 0, is", "accepted"],
        ),
        (
            "[[box]]\nname = 'b'\nmin_mm = [0.38, -0.04, 0]\nmax_mm = [0.9, 0.04, 0.55]\n",
            ["s.toml:2:1", "than 0.9 mm from the origin; are lengths in metres?", "(0.9 m is 900 mm)"],
        ),
        (
            "[[box]]\nname = 'b'\nmin_mm = [0, 0, 0]\nmax_mm = [50, 50, 50]\nyaw_deg = 0.7854\n",
            ["s.toml:6:11", "`b`: yaw_deg is 0.7854; is it in radians?", "0.7854 rad is 45.0°"],
        ),
        (
            "[[box]]\nname = 'b'\nmin_mm = [0.1, 0, 0]\nmax_mm = [0.6, 0.3, 0.2]\n\
             [[sphere]]\nname = 'k'\ncenter_mm = [0, 0, 900]\nradius_mm = 100\n",
            [
                "s.toml:5:10",
                "`b`: no side is longer than 0.5 mm; are lengths in metres?",
                "(0.5 m is 500 mm)",
            ],
        ),
        (
            "[[sphere]]\nname = 'k'\ncenter_mm = [0, 0, 900]\nradius_mm = 0.1\n",
            ["s.toml:5:13", "`k`: radius_mm is 0.1; is it in metres?", "(0.1 m is 100 mm)"],
        ),
        (
            "[[capsule]]\nname = 'c'\nfrom_mm = [0, 0, 900]\nto_mm = [0, 0, 100]\nradius_mm = 0.05\n",
            ["s.toml:6:13", "`c`: radius_mm is 0.05; is it in metres?", "(0.05 m is 50 mm)"],
        ),
        (
            "[[capsule]]\nname = 'c'\nfrom_mm = [0.3, 0, 0.9]\nto_mm = [0.3, 0, 0.1]\nradius_mm = 50\n",
            ["s.toml:4:11", "coordinate of from_mm and to_mm is 0.9; is it in metres?", "(0.9 m is 900 mm)"],
        ),
        (
            "[[convex]]\nname = 'p'\nvertices_mm = [[0, 0, 0], [0.3, 0, 0], [0, 0.2, 0], [0, 0, 0.25]]\n\
             [[sphere]]\nname = 'k'\ncenter_mm = [0, 0, 900]\nradius_mm = 100\n",
            [
                "s.toml:4:15",
                "`p`: the greatest extent of vertices_mm is 0.3; is it in metres?",
                "(0.3 m is 300 mm)",
            ],
        ),
        (
            "[support]\nunder = 'floor'\nbase_mm = [0.5, -0.2, 0]\nyaw_deg = 0\n",
            ["s.toml:4:11", "base_mm reaches 0.5 mm from the origin; is it in metres?", "(0.5 m is 500 mm)"],
        ),
        (
            "[support]\nunder = 'floor'\nbase_mm = [0, 0, 0]\nyaw_deg = 1.5708\n",
            ["s.toml:5:11", "yaw_deg is 1.5708; is it in radians?", "1.5708 rad is 90.0°"],
        ),
        (
            "[[sphere]]\nname = 'k'\ncenter_mm = [0, nan, 0]\nradius_mm = 1\n",
            ["s.toml:4:17", "`center_mm[1]`", "finite"],
        ),
        ("[[sphere]]\nname = 'k'\ncenter_mm = [0, 0, 0]\nradius_mm = -1\n", ["s.toml:5:13", "radius", "0"]),
        (
            "[support]\nunder = 'floor'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nfloor_mm = 3\n",
            ["s.toml:6:1", "floor_mm", "base_mm"],
        ),
        (
            "[support]\nunder = 'pedestal'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nfloor_mm = 3\nsides_mm = [1, 1]\n",
            ["s.toml:6:12", "at the base or above it", "a floor below it is accepted"],
        ),
        (
            "[[convex]]\nname = 'p'\nvertices_mm = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]\n",
            ["`p`", "enclose nothing", "plane"],
        ),
        (
            "[[sphere]]\nname = 'k'\ncenter_mm = [0, 0, 0]\nradius_mm = 1\n[[sphere]]\nname = 'k'\n\
             center_mm = [0, 0, 9]\nradius_mm = 1\n",
            ["s.toml:7:8", "twice", "name of its own"],
        ),
    ] {
        let message = refusal(text);
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
}

#[test]
fn a_fault_of_an_obstacle_hides_none_of_another_unless_its_value_is_of_the_wrong_kind() {
    let faults = |least: &str| {
        let message = refusal(&format!(
            "[[box]]\nname = 'b'\nmin_mm = [2, 0, {least}]\nmax_mm = [1, 2, 3]\n\
             [[box]]\nname = 'c'\nmin_mm = [0, 5, 7]\nmax_mm = [300, 2, 3]\n",
        ));
        message.lines().filter(|line| line.starts_with("s.toml:")).map(str::to_owned).collect::<Vec<_>>()
    };
    let parts =
        ["s.toml:5:11: obstacle `b`: `max_mm[0]`", "s.toml:9:16: obstacle `c`: `max_mm[1]`", "s.toml:9:19: "];
    let lines = faults("0");
    assert!(
        lines.len() == 3 && lines.iter().zip(parts).all(|(line, part)| line.starts_with(part)),
        "{lines:?}"
    );
    let lines = faults("'0'");
    assert!(lines.len() == 1 && lines[0].starts_with("s.toml:4:17: `min_mm[2]` is \"0\""), "{lines:?}");
}
