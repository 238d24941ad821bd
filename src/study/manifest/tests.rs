use super::*;

#[test]
fn outputs_of_runs_leave_a_tree_clean_and_any_other_change_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let git = |arguments: &[&str]| {
        let name = ["-c", "user.name=n", "-c", "user.email=e"];
        let mut command = Command::new("git");
        let done = command.current_dir(folder.path()).args(name).args(arguments).output().unwrap();
        assert!(done.status.success(), "{arguments:?}: {done:?}");
    };
    let write = |name: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, name).unwrap();
    };
    let clean = || MadeBy::found(folder.path()).clean;
    git(&["init", "--quiet"]);
    write("spec.toml");
    git(&["add", "."]);
    git(&["commit", "--quiet", "-m", "first"]);
    assert_eq!(clean(), Some(true));
    for output in ["data/runs/p/s.manifest.toml", "plots/p/fig1.svg", "paper_repro.md"] {
        write(output);
        assert_eq!(clean(), Some(true), "{output}");
    }
    assert_eq!(MadeBy::found(&folder.path().join("data/runs")).clean, Some(true), "seen from below");
    write("data/robots/r.toml");
    assert_eq!(clean(), Some(false));
    fs::remove_dir_all(folder.path().join("data/robots")).unwrap();
    fs::write(folder.path().join("spec.toml"), "changed").unwrap();
    assert_eq!(clean(), Some(false));
}
