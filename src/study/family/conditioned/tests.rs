use super::*;

const SETTINGS: &str = "
corner_rule = 'allow'
planner = 'astar'
planner_settings = { weight = 1, ties = 'fifo' }
expansions = 10_000
tries = 300
[shared]
size_cells = [12, 12]
start = [1, 2]
goal = [10, 5]
[[families]]
family = 'random_cells'
settings = { blocked_share = 0.3 }
[[families]]
family = 'random_bars'
settings = { count = 12, length_cells = [2, 5] }
[given]
";

fn family(given: &str) -> Result<Box<dyn Family>, String> {
    let table = toml::from_str(&(SETTINGS.to_owned() + given)).unwrap();
    (ENTRY.build)(&Settings::composed("a test", table), &Inputs::default()).map_err(|e| e.to_string())
}

fn tries(preprocessing: &Preprocessing) -> f64 {
    preprocessing.values["tries"].as_f64()
}

#[test]
fn accepted_maps_lie_in_the_band_and_rejection_leaves_the_distribution_alone() {
    // The oracle counts how often plain instances of the mixture fall into the band by the verifier's optimum.
    let any = family("bends = [0, 1e9]").unwrap();
    let band = family("path_cost_cells = [11, 12]").unwrap();
    let optimum = |preprocessing: &Preprocessing| {
        let query = &any.queries()[0];
        crate::verification::truth(&preprocessing.world, query, &crate::verification::Guide::default())
            .optimal()
            .unwrap()
    };
    let mut inside = 0;
    let mut looked_at = 0;
    let mut tried = 0.0;
    for seed in 0..400 {
        let accepted = band.prepare(seed).unwrap();
        assert!((11.0..=12.0).contains(&optimum(&accepted)), "seed {seed}");
        tried += tries(&accepted);
        let plain = any.prepare(seed + 1_000_000).unwrap();
        looked_at += tries(&plain) as usize;
        inside += usize::from((11.0..=12.0).contains(&optimum(&plain)));
    }
    let rate = 400.0 / tried;
    let expected = inside as f64 / looked_at as f64;
    assert!((0.1..0.9).contains(&expected), "the band is no condition: {expected}");
    assert!((rate - expected).abs() < 0.1, "accepted {rate} of the tries, {expected} of plain instances fit");
}

#[test]
fn equal_seeds_give_equal_maps_and_a_hopeless_band_an_invalid_problem() {
    let band = family("path_cost_cells = [11, 12]").unwrap();
    let map = |seed| format!("{:?}", band.prepare(seed).unwrap().traces);
    assert_eq!(map(5), map(5));
    assert_ne!(map(5), map(6));
    let message = family("path_cost_cells = [1, 2]").unwrap().prepare(3).unwrap_err().to_string();
    assert_eq!(message, "none of 300 maps was accepted");
}

#[test]
fn wrong_settings_are_refused_with_what_is_accepted() {
    for (given, message) in [
        ("length = [1, 2]", "`given` names the column `length`; there are path_cost_cells"),
        ("bends = [2, 1]", "`given.bends` is [2, 1]; [least, greatest] is accepted"),
    ] {
        let error = family(given).err().unwrap();
        assert!(error.contains(message), "{error}");
    }
    let with = |from: &str, to: &str| {
        let table = toml::from_str(&(SETTINGS.replace(from, to) + "bends = [0, 9]")).unwrap();
        let built = (ENTRY.build)(&Settings::composed("a test", table), &Inputs::default());
        built.err().unwrap().to_string()
    };
    assert!(with("'random_bars'", "'bars'").contains("there is no problem family `bars`"));
    assert!(with("'astar'", "'delete_inflections'").contains("there is no planner `delete_inflections`"));
    assert!(with("blocked_share = 0.3", "share = 1").contains("`families` random_cells"));
    assert!(with("start = [1, 2]", "start = [12, 2]").contains("start is [12, 2], outside the map"));
}

#[test]
fn a_listed_draw_is_what_a_search_finds() {
    let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let inputs = Inputs::below(vec![root.to_owned()]);
    let study = crate::Study::load(&root.join("experiments/zhang/conditioned.toml"), &inputs).unwrap();
    let point = crate::Interpretation::new(&study.choices, &BTreeMap::new()).unwrap();
    let mut longest = 0.0_f64;
    for group in &study.groups {
        let listed = group.family(&group.points[0], &point, &inputs).unwrap();
        let mut table = group.settings.table().clone();
        let read: Conditioned = group.settings.read().unwrap();
        let list = root.join(read.found.as_deref().unwrap());
        let listed_tries = found::read(&list, &read.fingerprint()).unwrap();
        assert_eq!(
            listed_tries.len(),
            group.instances as usize,
            "{}: its list is of another revision",
            group.label
        );
        table.remove("found");
        let searched = (ENTRY.build)(&Settings::composed("searched", table), &inputs).unwrap();
        for instance in 0..3_u32 {
            let names = ["zhang", "conditioned", "problem", &group.label, &instance.to_string()];
            let seed = seed::derive(study.seed, &names);
            let [ours, truth] = [&listed, &searched].map(|family| family.prepare(seed).unwrap());
            assert_eq!(ours.values, truth.values, "{} {instance}", group.label);
            assert_eq!(ours.traces, truth.traces, "{} {instance}", group.label);
            longest = longest.max(tries(&truth));
        }
    }
    assert!(longest > 100.0, "no long search in the sample: {longest}");
}

#[test]
fn a_list_made_under_other_settings_is_not_used() {
    let folder = tempfile::tempdir().unwrap();
    let wide = "path_cost_cells = [11, 12]";
    let truth = tries(&family(wide).unwrap().prepare(8).unwrap());
    let print = |given: &str| {
        let read: Conditioned = toml::from_str(&(SETTINGS.to_owned() + given)).unwrap();
        read.fingerprint()
    };
    for (made_for, expected) in [(wide, truth + 1.0), ("path_cost_cells = [11, 13]", truth)] {
        let list = format!("for {}\n8 {}\n", print(made_for), truth + 1.0);
        std::fs::write(folder.path().join("list.txt"), list).unwrap();
        let text = format!("found = 'list.txt'\n{SETTINGS}{wide}");
        let inputs = Inputs::below(vec![folder.path().to_owned()]);
        let family =
            (ENTRY.build)(&Settings::composed("a test", toml::from_str(&text).unwrap()), &inputs).unwrap();
        let found = tries(&family.prepare(8).unwrap());
        // The search goes on from a listed try: what is before it is taken on trust.
        assert!(
            found >= expected && (expected > truth || found == truth),
            "{made_for}: {found} of {expected}"
        );
    }
}
