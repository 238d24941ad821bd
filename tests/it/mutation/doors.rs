//! Files of other programs and lines of planners, damaged, each read by its own reader: problem sets, robots, meshes, maps, scenarios,
//! tables of results, and messages with the answers to their questions. What is refused names its file and a place, in a message that is not long.

use super::damage::{flipped, misshapen};
use super::subject::validate;
use super::{cases, count, fault, is_located};
use crate::external::law;
use crate::import::SNAPPY;
use crate::paper::Bench;
use base::grid::{parse_movingai_map, parse_scenarios, parse_text_map, read_map};
use base::problem::{Expected, ProblemFile};
use base::robot::{Robot, parse_srdf, parse_urdf, read_urdf};
use base::seed::{self, Stream};
use base::settings::Document;
use base::text::decoded;
use engine::space::World;
use external::message::FromPlanner;
use external::{Space, read_message};
use rand::RngExt as _;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use study::Inputs;
use study::elsewhere::Table;
use study::paper::Paper;

/// No message of one fault is longer, in bytes.
const LONGEST_MESSAGE: usize = 8_000;

/// Specs are refused with so many faults at most.
const MOST_FAULTS: usize = 51;

const ROBOMETRICS: &str = "shelf:\n  - obstacles:\n      cuboid:\n        table: {dims: [0.7, 1.6, 0.06], pose: [0.55, 0, -0.03, 1, 0, 0, 0]}\n      \
    cylinder:\n        can: {radius: 0.05, height: 0.2, pose: [0.45, -0.2, 0.1, 0.7071, 0, 0, 0.7071]}\n      sphere:\n        \
    lamp: {radius: 0.1, position: [0.35, 0.25, 0.9]}\n    start: [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]\n    goal_ik:\n      \
    - [1.2, 0.3, 0.0, -1.9, 0.0, 2.2, 0.785]\n    world_frame: base\n";

const MESHED: &str = r#"<robot name="m"><link name="a"><collision><geometry><mesh filename="mesh.stl" scale="0.1 0.1 0.1"/></geometry></collision></link>
<link name="b"/><joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1"/></joint></robot>"#;

const MESH: &str = "solid m\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
    facet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 0.5\nvertex 0 1 0\nendloop\nendfacet\nendsolid m\n";

const SRDF: &str = "<robot name=\"ur5\">\n<group name=\"arm\"><chain base_link=\"base\" tip_link=\"link_6\"/></group>\n\
    <disable_collisions link1=\"base\" link2=\"link_1\" reason=\"Adjacent\"/>\n\
    <disable_collisions link1=\"link_1\" link2=\"link_3\" reason=\"Never\"/>\n</robot>\n";

const HEAD: &str = "image: room.png\nresolution: 0.05\norigin: [-1.0, -2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// Messages of planners; `W` stands for a configuration of the world in hand.
const LINES: [&str; 8] = [
    r#"{"type":"hello","protocol":1,"name":"t","version":"1","worlds":["grid","cell"],"seeding":"query","deterministic":true,"anytime":false}"#,
    r#"{"type":"ask","id":1,"valid":[W,W],"motion":[[W,W]],"fractions":true}"#,
    r#"{"type":"ask","id":2,"valid":[W]}"#,
    r#"{"type":"ask","id":3,"motion":[[W,W],[W,W]]}"#,
    r#"{"type":"ask","id":4,"fk":[W],"valid":[]}"#,
    r#"{"type":"ask","id":5,"ik":[{"position":[0.4,0.1,0.5],"rotation":[[1,0,0],[0,1,0],[0,0,1]]}]}"#,
    r#"{"type":"incumbent","id":6,"cost":2.5,"path":[W,W]}"#,
    r#"{"type":"result","id":7,"status":"solved","path":[W,W],"cost":1.5,"counters":{"expansions":12,"own_wall_ns":15}}"#,
];

/// A file as it is whole, how it is damaged and how it is read.
struct Door<'a> {
    name: &'static str,
    bytes: Vec<u8>,
    damage: fn(&mut Stream, &[u8]) -> Vec<u8>,
    read: Box<dyn Fn(&[u8]) -> Result<(), String> + 'a>,
}

fn door<'a>(
    name: &'static str,
    bytes: impl Into<Vec<u8>>,
    read: impl Fn(&[u8]) -> Result<(), String> + 'a,
) -> Door<'a> {
    Door { name, bytes: bytes.into(), damage: misshapen, read: Box::new(read) }
}

/// Whether a file's name ends so.
fn ends(name: &str, ending: &str) -> bool {
    Path::new(name).extension().is_some_and(|end| end == ending)
}

/// A door whose file is a document.
fn document<'a>(
    name: &'static str,
    bytes: impl Into<Vec<u8>>,
    read: impl Fn(&Arc<Document>) -> Result<(), String> + 'a,
) -> Door<'a> {
    door(name, bytes, move |bytes| {
        let text = decoded(bytes.to_vec()).map_err(|error| format!("{name}: {error}"))?;
        let document: Arc<Document> = Document::new(Path::new(name), text);
        read(&document)
    })
}

/// A door whose file is text that names no file.
fn text<'a, E: Display, T>(
    name: &'static str,
    bytes: impl Into<Vec<u8>>,
    read: impl Fn(&str) -> Result<T, E> + 'a,
) -> Door<'a> {
    door(name, bytes, move |bytes| {
        let named = |error: &dyn Display| format!("{name}: {error}");
        read(&decoded(bytes.to_vec()).map_err(|error| named(&error))?)
            .map(drop)
            .map_err(|error| named(&error))
    })
}

/// A door whose file lies in `folder`, where others that belong to it lie.
fn file<'a>(
    folder: &'a Path,
    name: &'static str,
    bytes: impl Into<Vec<u8>>,
    read: impl Fn(&Path) -> Result<(), String> + 'a,
) -> Door<'a> {
    let bytes = bytes.into();
    fs::write(folder.join(name), &bytes).unwrap();
    let whole = bytes.clone();
    door(name, bytes, move |damaged| {
        fs::write(folder.join(name), damaged).unwrap();
        let outcome = read(&folder.join(name));
        fs::write(folder.join(name), &whole).unwrap();
        outcome
    })
}

/// A PNG of 6 × 4 pixels.
fn png(color: png::ColorType, samples: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 6, 4);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    let pixels: Vec<u8> = (0..24 * samples).map(|at| (at * 37 % 256) as u8).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    bytes
}

/// A PNG image damaged inside a chunk whose checksum fits again, or anywhere.
fn damaged_png(stream: &mut Stream, bytes: &[u8]) -> Vec<u8> {
    if stream.random_range(0..3) == 0 {
        return misshapen(stream, bytes);
    }
    let mut bytes = bytes.to_vec();
    let chunk = stream.random_range(0..2);
    let mut at = 8;
    for _ in 0..chunk {
        at += 12 + u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    }
    let length = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let inside = at + 8..at + 8 + length;
    let new = if chunk == 0 && stream.random_range(0..2) == 0 {
        let mut head = bytes[inside.clone()].to_vec();
        for side in [0, 4] {
            let size: u32 = [0, 1, 7, 70_000, 30_000, 0x7fff_ffff, u32::MAX][stream.random_range(0..7)];
            head[side..side + 4].copy_from_slice(&size.to_be_bytes());
        }
        head
    } else {
        flipped(stream, bytes[inside.clone()].to_vec())
    };
    bytes[inside.clone()].copy_from_slice(&new);
    let mut sum = flate2::Crc::new();
    sum.update(&bytes[at + 4..inside.end]);
    bytes[inside.end..inside.end + 4].copy_from_slice(&sum.sum().to_be_bytes());
    bytes
}

/// What happens to a line of a planner that plans in `world`.
fn answered(world: &World, line: &[u8], answers: &Cell<u32>) -> Result<(), String> {
    match read_message(line)? {
        FromPlanner::Ask(ask) => {
            Space::new(world, false).answer(&ask).map(|_| answers.set(answers.get() + 1))
        }
        _ => Ok(()),
    }
}

/// Every line in every world.
fn lines<'a>(worlds: &'a [World], answers: &'a Cell<u32>) -> Vec<Door<'a>> {
    let mut doors = Vec::new();
    for world in worlds {
        let width = Space::new(world, false).width();
        let configuration: Vec<String> = (0..width).map(|k| format!("{}.25", k % 3)).collect();
        for line in LINES {
            let whole = line.replace('W', &format!("[{}]", configuration.join(",")));
            doors.push(door("planner", whole, move |line| answered(world, line, answers)));
        }
    }
    doors
}

/// Every file.
fn files<'a>(folder: &'a Path, robots: &'a [Robot; 2]) -> Vec<Door<'a>> {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let stored = |name: &str| fs::read(home.join(name)).unwrap();
    let shown = |error: &dyn Display| error.to_string();
    let [ur5, panda] = robots;
    let problem = move |document: &Arc<Document>| {
        let joints = panda.joints.iter().map(|joint| joint.name.as_str()).collect();
        let expected = Expected { robot: &panda.name, base: &panda.base, joints };
        let file = ProblemFile::parse(document.clone()).map_err(|error| shown(&error))?;
        file.problem(None, 0, Some(&expected)).map(drop).map_err(|error| shown(&error))
    };
    let robot = move |document: &Arc<Document>| parse_urdf(document).map(drop).map_err(|error| shown(&error));
    let map = move |path: &Path| read_map(path).map(drop).map_err(|error| shown(&error));
    let joints: Vec<String> = panda.joints.iter().map(|joint| format!("\"{}\"", joint.name)).collect();
    let named = String::from_utf8(stored("scenes/shelf_panda.json")).unwrap();
    let head = format!("{{\"robot\": \"{}\", \"joints\": [{}],", panda.name, joints.join(", "));
    let grid = parse_movingai_map(&String::from_utf8(stored("maps/movingai_sample.map")).unwrap()).unwrap();
    let mesh =
        move |_: &Path| read_urdf(&folder.join("meshed.urdf")).map(drop).map_err(|error| shown(&error));
    let table = |path: &Path| Table::read_parquet(path).map(drop).map_err(|error| error.to_string());
    fs::write(folder.join("mesh.stl"), MESH).unwrap();
    let mut doors = vec![
        document("problems.json", named.replacen('{', &head, 1), problem),
        document("problems.json", stored("scenes/shelf_panda.json"), problem),
        document("problems.yaml", ROBOMETRICS, problem),
        document("robot.urdf", stored("robots/ur5.urdf"), robot),
        document("robot.urdf", stored("robots/panda.urdf"), robot),
        document("robot.srdf", SRDF, move |document| {
            parse_srdf(document, ur5).map(drop).map_err(|error| shown(&error))
        }),
        file(folder, "meshed.urdf", MESHED, mesh),
        file(folder, "mesh.stl", MESH, mesh),
        text("grid.map", stored("maps/movingai_sample.map"), parse_movingai_map),
        text("grid.scen", stored("maps/movingai_sample.scen"), move |text| parse_scenarios(text, &grid)),
        text("grid.map.txt", stored("maps/zhang_w1.map.txt"), parse_text_map),
        file(folder, "text.pgm", "P2\n# by hand\n3 2\n255\n0 255 51\n102 7 9\n", map),
        file(folder, "bytes.pgm", b"P5 3 2 255\n\x00\xff\x33\x66\x07\x09", map),
        file(folder, "room.png", png(png::ColorType::Grayscale, 1), map),
        file(folder, "clear.png", png(png::ColorType::Rgba, 4), map),
        file(folder, "room.yaml", HEAD, map),
        file(folder, "results.parquet", SNAPPY, table),
    ];
    for door in &mut doors {
        if ends(door.name, "png") {
            door.damage = damaged_png;
        } else if ends(door.name, "parquet") {
            door.damage = |stream, bytes| flipped(stream, bytes.to_vec());
        }
    }
    doors
}

/// The specs of a small paper, which is read whole.
fn specs(paper: &Path) -> Vec<Door<'_>> {
    let inputs = move || Inputs::below(vec![paper.to_owned()]);
    let load = move |_: &Path| {
        let loaded = Paper::load(paper, &inputs()).map_err(|error| error.to_string())?;
        validate(&loaded)
    };
    let spec = |name| file(paper, name, fs::read(paper.join(name)).unwrap(), load);
    ["paper.toml", "draws.toml", "room.toml"].map(spec).into()
}

/// What was wrong with a case beside what [`fault`] finds: a refusal without a place, or a long one.
fn reported(door: &Door<'_>, message: &str) -> Result<(), String> {
    let most = if ends(door.name, "toml") { MOST_FAULTS * LONGEST_MESSAGE } else { LONGEST_MESSAGE };
    let is_file = door.name != "planner";
    // An image has no lines, and a part of a map's head is missing nowhere.
    let is_reported =
        if is_file { message.contains(door.name) || is_located(message) } else { message.len() > 10 };
    match () {
        () if message.len() > most => Err(format!("it was refused in {} bytes", message.len())),
        () if !is_reported => Err(format!("it was refused without a place: {message}")),
        () => Ok(()),
    }
}

#[test]
fn no_damaged_file_of_another_program_or_line_of_a_planner_panics_hangs_or_is_refused_at_length() {
    let bench = Bench::new();
    let folder = bench.at("files");
    let paper = bench.at("mini");
    fs::create_dir(&folder).unwrap();
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/robots");
    let robots = ["ur5.urdf", "panda.urdf"].map(|name| read_urdf(&home.join(name)).unwrap());
    let worlds = law::worlds();
    let answers = Cell::new(0);
    let doors = [files(&folder, &robots), lines(&worlds, &answers), specs(&paper)];
    for door in doors.iter().flatten() {
        let outcome = (door.read)(&door.bytes);
        let is_sound = outcome.is_ok() || door.name == "planner";
        assert!(is_sound, "{}: {outcome:?}", door.name);
    }
    let cases = cases(|all| all - all / super::SPECS_OF);
    let all = count(&cases);
    let mut tally: BTreeMap<&str, [u64; 2]> = BTreeMap::new();
    let mut faults = Vec::new();
    answers.set(0);
    for case in cases {
        let mut stream = seed::stream(seed::derive(2027, &["doors", &case.to_string()]));
        let kind = &doors[[0, 0, 0, 0, 0, 0, 1, 1, 1, 2][stream.random_range(0..10)]];
        let door = &kind[stream.random_range(0..kind.len())];
        let bytes = (door.damage)(&mut stream, &door.bytes);
        let wrong = Cell::new(None);
        let work = || match (door.read)(&bytes) {
            Ok(()) => Ok(()),
            Err(message) => {
                wrong.set(reported(door, &message).err());
                Err("file.toml:1: judged by `told`".to_owned())
            }
        };
        let found = fault(work).and_then(|is_accepted| wrong.take().map_or(Ok(is_accepted), Err));
        let [read, accepted] = tally.entry(door.name).or_default();
        *read += 1;
        match found {
            Ok(is_accepted) => *accepted += u64::from(is_accepted),
            Err(what) => faults.push(format!("case {case}, {}: {what}", door.name)),
        }
    }
    let accepted: u64 = tally.values().map(|[_, accepted]| accepted).sum();
    println!(
        "{all} cases, {accepted} accepted, {} answered, by door [read, accepted]: {tally:?}",
        answers.get()
    );
    assert!(faults.is_empty(), "{} of {all} cases:\n{}", faults.len(), faults.join("\n"));
    assert!((all / 10..all * 9 / 10).contains(&accepted), "{accepted} of {all} were accepted");
    assert!(u64::from(answers.get()) > all / 100, "{} of {all} lines were answered", answers.get());
}
