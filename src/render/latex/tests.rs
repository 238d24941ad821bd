use super::*;

fn table() -> Table {
    let mut table = Table::new(
        "table2",
        "Path length & turns, A* against improved (100 % of maps)",
        &[Column::Left, Column::Right, Column::Right, Column::Centre],
    );
    table.head(vec!["".into(), Cell::Across(2, "cost / cells".into()), "verdict".into()]);
    table.head(vec!["algorithm".into(), "printed".into(), "ours".into(), "".into()]);
    table.group("map_1");
    table.row(vec!["A*".into(), "13.40".into(), Cell::Math("13.49 \\pm 0.02".into()), "impossible".into()]);
    table.row(vec!["[improved]".into(), "−8.5 %".into(), Cell::Bold("∞".into()), "x < y_1".into()]);
    table.group("map 2");
    table.row(vec!["ρ ≤ 45°".into(), "10\u{2009}000".into(), "a\\b{c}".into(), "#3 ~ ^".into()]);
    table.note("Interval: 95 %, bootstrap over maps.");
    table
}

fn numbers() -> Numbers {
    let mut numbers = Numbers::default();
    numbers.add("map_2.opened share", "8.5 %").unwrap();
    numbers.add("A* cost", "13.49").unwrap();
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
    let message = numbers.add("A cost", "1").unwrap_err().to_string();
    assert!(
        message.contains("`A* cost`") && message.contains("`A cost`") && message.contains("\\ACost"),
        "{message}"
    );
}

#[test]
fn a_row_that_does_not_fill_the_columns_is_refused() {
    let mut table = table();
    table.row(vec![Cell::Across(3, "wide".into())]);
    let message = table.latex("x").unwrap_err().to_string();
    assert!(message.contains("fills 3 columns; 4 are declared") && message.contains("table2"), "{message}");
}

#[test]
fn macros_of_a_paper_with_digits_in_its_name_hold_letters_only() {
    let mut numbers = numbers();
    numbers.add("t2.improved.800.low", "80").unwrap();
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
    let message = numbers.add("a* cost", "1").unwrap_err().to_string();
    assert!(message.contains("`A* cost`") && message.contains("`a* cost`"), "{message}");
}

#[test]
fn cells_of_a_wide_table_are_broken_at_spaces_until_it_fits_and_lose_no_word() {
    let words = "one interval [27.0, 30.1] after another, *starred";
    let mut table = Table::new("wide", "Wide", &[Column::Left; 6]);
    table.head(vec!["a head of several words".into(); 6]);
    table.row(vec![words.into(); 6]);
    let latex = table.latex("x").unwrap();
    assert!(is_balanced(&latex), "{latex}");
    let row = latex.lines().find(|line| line.contains("27.0")).unwrap();
    assert!(row.starts_with("\\begin{tabular}[t]{@{}l@{}}one interval\\\\{}[27.0, 30.1]\\\\"), "{row}");
    assert_eq!(row.matches("\\\\{}*starred").count(), 6, "{row}");
    let mut narrow = Table::new("narrow", "Narrow", &[Column::Left; 2]);
    narrow.row(vec!["a head of several words".into(); 2]);
    assert!(!narrow.latex("x").unwrap().contains("{tabular}[t]"), "what fits is not broken");
}
