use super::*;
use crate::space::World;
use std::path::Path as FilePath;

fn settings(over: &str) -> Settings {
    let text = r#"
robot = "data/robots/motoman_up6.toml"
scene = "data/scenes/fu2018_cell.toml"
queries = "data/scenes/fu2018_groups.toml"
obstacles = true
self_collision = true
samples = 60
counted = "accepted"
region = "full"
radius_mm = 500
path = "tool"
step_mm = 20
step_deg = 4
jump_deg = 20
turn_deg = 180
end = "own"
"#;
    let mut table: toml::Table = toml::from_str(text).unwrap();
    table.extend(toml::from_str::<toml::Table>(over).unwrap());
    Settings::composed("a test", table)
}

fn inputs() -> Inputs {
    Inputs { roots: vec![PathBuf::from(env!("CARGO_MANIFEST_DIR"))] }
}

fn refusal(over: &str) -> String {
    Posed::new(&settings(over), &inputs()).err().expect("refused").to_string()
}

#[test]
fn probe() {
    let posed = Posed::new(&settings("samples = 1500"), &inputs()).unwrap();
    for seed in 0..3 {
        let (ns, prepared) = crate::study::clock::timed(|| posed.prepare(seed).unwrap());
        println!("{} ms {:?}", ns / 1_000_000, prepared.values);
    }
}
