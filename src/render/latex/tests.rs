use super::*;

fn table() -> Table {
    let mut table = Table::new(
        "table2",
        "Path length & turns, A* against improved (100 % of maps)",
        &[Column::Left, Column::Right, Column::Right, Column::Right],
    );
    table.head(["", "printed", "ours", ""].map(Cell::from).to_vec());
    table.group("map_1");
    let mut cells = ["A*", "13.40", "13.49", "impossible"].map(Cell::from).to_vec();
    table.footnote(&mut cells[3], "13.40 is shorter than the straight line.".to_owned());
    table.row(cells);
    table.row(["[improved]", "−8.5 %", "∞", "x < y_1"].map(Cell::from).to_vec());
    table.group("map 2");
    table.row(["ρ ≤ 45°", "10\u{2009}000", "a\\b{c}", "#3 ~ ^"].map(Cell::from).to_vec());
    table.note("Interval: 95 %, bootstrap over maps.");
    table
}

fn numbers() -> Numbers {
    let mut numbers = Numbers::default();
    numbers.add("map_2.opened share", "8.5 %", "as printed, %; Table 1").unwrap();
    numbers.add("A* cost", "13.49", "median").unwrap();
    numbers
}

/// Whether braces pair up and every `\begin` meets its `\end`, escaped braces aside.
fn is_balanced(source: &str) -> bool {
    let bare = source.replace("\\{", "").replace("\\}", "");
    let mut depth = 0_i32;
    for character in bare.chars() {
        depth += i32::from(character == '{') - i32::from(character == '}');
        if depth < 0 {
            return false;
        }
    }
    depth == 0 && source.matches("\\begin{").count() == source.matches("\\end{").count()
}

#[test]
fn a_table_is_written_as_seen_here() {
    let latex = table().latex("cargo run -- render zhang\nspec 3f2a").unwrap();
    assert!(is_balanced(&latex), "{latex}");
    insta::assert_snapshot!(latex);
}

#[test]
fn numbers_are_written_as_seen_here() {
    let latex = numbers().latex("zhang", "cargo run -- render zhang").unwrap();
    assert!(is_balanced(&latex), "{latex}");
    insta::assert_snapshot!(latex);
}

#[test]
fn no_special_character_is_left_bare() {
    let special = "a{b}$c$&d#e%f_g^h~i\\j";
    let safe = escaped(special);
    assert_eq!(
        safe,
        "a\\{b\\}\\$c\\$\\&d\\#e\\%f\\_g\\textasciicircum{}h\\textasciitilde{}i\\textbackslash{}j"
    );
    assert!(is_balanced(&safe));
}

#[test]
fn macro_names_hold_letters_only() {
    let cases = [
        ("opened", "opened"),
        ("map_2.opened share", "mapTwoOpenedShare"),
        ("N=800", "NEightZeroZero"),
        ("24-neighbours", "TwoFourNeighbours"),
        ("größe", "grE"),
    ];
    for (key, expected) in cases {
        let name = macro_name(key).unwrap();
        assert_eq!(name, expected);
        assert!(name.bytes().all(|byte| byte.is_ascii_alphabetic()));
    }
    assert!(macro_name("*+").unwrap_err().to_string().contains("`*+`"));
}

#[test]
fn two_keys_of_one_macro_are_refused_and_both_are_named() {
    let mut numbers = numbers();
    let message = numbers.add("A cost", "1", "").unwrap_err().to_string();
    assert!(
        message.contains("`A* cost`") && message.contains("`A cost`") && message.contains("\\ACost"),
        "{message}"
    );
}

#[test]
fn a_row_that_does_not_fill_the_columns_is_refused() {
    let mut table = table();
    table.row(vec!["".into(); 3]);
    let message = table.latex("x").unwrap_err().to_string();
    assert!(message.contains("fills 3 columns; 4 are declared") && message.contains("table2"), "{message}");
}

#[test]
fn macros_of_a_paper_with_digits_in_its_name_hold_letters_only() {
    let mut numbers = numbers();
    numbers.add("t2.improved.800.low", "80", "").unwrap();
    for prefix in ["fu2018", "movingai_sample", "zhang"] {
        let latex = numbers.latex(prefix, "x").unwrap();
        let names = latex.lines().filter_map(|line| line.strip_prefix("\\newcommand{\\")?.split('}').next());
        let names: Vec<&str> = names.collect();
        assert_eq!(names.len(), 3, "{latex}");
        for name in names {
            assert!(name.bytes().all(|byte| byte.is_ascii_alphabetic()), "{name}\n{latex}");
        }
    }
    assert!(numbers.latex("2018", "x").unwrap().contains("{\\TwoZeroOneEightACost}"), "a name of digits");
    let message = numbers.add("a* cost", "1", "").unwrap_err().to_string();
    assert!(message.contains("`A* cost`") && message.contains("`a* cost`"), "{message}");
}

#[test]
fn cells_with_one_reason_share_a_footnote_and_no_other_cell_has_one() {
    let mut table = Table::new("t", "T", &[Column::Left; 3]);
    let mut cells = ["a", "b", "c"].map(Cell::from).to_vec();
    for (at, why) in [(0, "one"), (2, "two")] {
        table.footnote(&mut cells[at], why.to_owned());
    }
    table.row(cells);
    let mut cells = ["d", "e", "f"].map(Cell::from).to_vec();
    table.footnote(&mut cells[1], "one".to_owned());
    table.row(cells);
    let latex = table.latex("x").unwrap();
    let mark = |text: &str, letter: char| format!("{text}\\textsuperscript{{{letter}}}");
    assert!(latex.contains(&format!("{} & b & {} \\\\", mark("a", 'a'), mark("c", 'b'))), "{latex}");
    assert!(latex.contains(&format!("d & {} & f \\\\", mark("e", 'a'))), "{latex}");
    assert_eq!(latex.matches("\\par\\smallskip").count(), 2, "{latex}");
}

#[test]
fn columns_share_the_width_by_their_words() {
    let mut table = Table::new("t", "T", &[Column::Left, Column::Right]);
    table.row(vec!["untestable".into(), "1".into()]);
    let latex = table.latex("x").unwrap();
    assert!(latex.contains("\\hsize=1.818\\hsize") && latex.contains("\\hsize=0.182\\hsize"), "{latex}");
}
