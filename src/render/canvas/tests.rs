use super::*;
use crate::render::style::{BLUE, Dash, ORANGE};

fn provenance() -> Provenance {
    Provenance {
        command: "cargo run -- render demo --only \"fig1\"".to_owned(),
        spec_hash: "3f2a".to_owned(),
        title: "θ₁ & θ₂ along the path".to_owned(),
    }
}

fn drawn() -> Figure {
    let mut canvas = Canvas::new(Width::Single, 100.0);
    canvas.clipped(Rect { x: 20.0, y: 20.0, w: 60.0, h: 60.0 }, |canvas| {
        canvas.rect(Rect { x: 0.0, y: 0.0, w: 200.0, h: 50.0 }, Some(Fill::solid(ORANGE)), None);
    });
    canvas.polyline(&[[100.0, 50.0], [230.0, 50.0]], &Stroke::solid(BLUE, 2.0).dashed(Dash::Dashed));
    canvas.text([100.0, 40.0], "θ₁ = −√2 / °", &Type::regular(TextSize::TICK));
    canvas.finish(&provenance()).unwrap()
}

fn pixels(png: &[u8]) -> (Vec<[u8; 3]>, usize) {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(png));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    (bytes.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(), reader.info().width as usize)
}

fn at(png: &[u8], [x, y]: [f64; 2]) -> [u8; 3] {
    let (pixels, width) = pixels(png);
    let px = |pt: f64| (pt / 72.0 * vector::DPI) as usize;
    pixels[px(y) * width + px(x)]
}

#[test]
fn the_same_drawing_gives_the_same_bytes() {
    assert_eq!(drawn(), drawn());
}

#[test]
fn text_is_outlined_and_needs_no_font() {
    let svg = drawn().svg;
    assert!(!svg.contains("<text") && !svg.contains("font-family"), "{svg}");
    assert!(svg.contains("aria-label=\"θ₁ = −√2 / °\""), "{svg}");
    assert!(svg.matches("<use ").count() >= 8, "{svg}");
}

#[test]
fn both_files_tell_command_and_spec() {
    let figure = drawn();
    let xml = resvg::usvg::roxmltree::Document::parse(&figure.svg).unwrap();
    let note = xml.descendants().find(|node| node.has_tag_name(("urn:replan", "replan"))).unwrap();
    assert_eq!(note.attribute("command"), Some(provenance().command.as_str()));
    assert_eq!(note.attribute("spec-hash"), Some("3f2a"));
    let reader = png::Decoder::new(std::io::Cursor::new(&figure.png)).read_info().unwrap();
    let texts: Vec<(String, String)> =
        reader.info().utf8_text.iter().map(|t| (t.keyword.clone(), t.get_text().unwrap())).collect();
    let given = provenance();
    let expected = [("Title", given.title), ("Software", given.command), ("Spec-Hash", given.spec_hash)];
    assert_eq!(texts, expected.map(|(key, text)| (key.to_owned(), text)));
}

#[test]
fn a_single_column_is_85_mm_wide_and_736_pixels() {
    let figure = drawn();
    assert!(figure.svg.contains("width=\"85mm\""), "{}", &figure.svg[..300]);
    let (pixels, width) = pixels(&figure.png);
    assert_eq!((width, pixels.len() / width), (736, 306));
}

#[test]
fn ink_falls_where_it_was_put_within_clips_and_dashes() {
    let png = drawn().png;
    assert_eq!(at(&png, [50.0, 30.0]), [230, 159, 0]);
    assert_eq!(at(&png, [10.0, 30.0]), [255; 3], "left of the clip");
    assert_eq!(at(&png, [120.0, 30.0]), [255; 3], "right of the clip");
    // Dashes of 8 pt and gaps of 5 pt from x = 100.
    assert_eq!(at(&png, [104.0, 50.0]), [0, 114, 178]);
    assert_eq!(at(&png, [110.5, 50.0]), [255; 3]);
    assert_eq!(at(&png, [117.0, 50.0]), [0, 114, 178]);
}

#[test]
fn discs_say_how_they_are_painted_once_until_another_paint_or_shape_comes() {
    let mut canvas = Canvas::new(Width::Single, 100.0);
    let disc =
        |canvas: &mut Canvas, x: f64, color| canvas.circle([x, 50.0], 8.0, Some(Fill::solid(color)), None);
    for (x, color) in [(20.0, BLUE), (50.0, BLUE), (80.0, ORANGE)] {
        disc(&mut canvas, x, color);
    }
    canvas.polyline(&[[100.0, 20.0], [230.0, 20.0]], &Stroke::solid(BLUE, 1.0));
    disc(&mut canvas, 110.0, ORANGE);
    let figure = canvas.finish(&provenance()).unwrap();
    let groups = |color: Rgb| figure.svg.matches(&format!("<g fill=\"{}\"", color.hex())).count();
    assert_eq!(
        [groups(BLUE), groups(ORANGE), figure.svg.matches("<circle").count()],
        [1, 2, 4],
        "{}",
        figure.svg
    );
    for (x, color) in [(20.0, BLUE), (50.0, BLUE), (80.0, ORANGE), (110.0, ORANGE)] {
        assert_eq!(at(&figure.png, [x, 50.0]), color.0, "at {x} pt");
    }
}

#[test]
fn overlapping_and_escaping_labels_are_named() {
    let mut canvas = Canvas::new(Width::Single, 50.0);
    let set = Type::regular(TextSize::TICK);
    canvas.text([10.0, 20.0], "first", &set);
    canvas.text([15.0, 22.0], "second", &set);
    canvas.text([230.0, 40.0], "outside", &set);
    canvas.text([100.0, 20.0], "alone", &set);
    let flaws = canvas.finish(&provenance()).unwrap().flaws;
    assert_eq!(flaws, ["`second` overlaps `first`", "`outside` leaves the page"]);
    assert!(drawn().flaws.is_empty());
}

#[test]
fn a_turned_text_takes_the_room_of_its_turned_box() {
    let upright = turned(Rect { x: 0.0, y: -7.0, w: 30.0, h: 10.0 }, [50.0, 60.0], -90.0);
    let expected = [[43.0, 60.0], [43.0, 30.0], [53.0, 30.0], [53.0, 60.0]];
    for (found, expected) in upright.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-9, "{upright:?}");
    }
}

#[test]
fn boxes_overlap_only_if_no_side_parts_them() {
    let bar = Rect { x: 0.0, y: 0.0, w: 40.0, h: 6.0 };
    let tilted = |x: f64| turned(bar, [x, 0.0], 45.0);
    let cases = [(tilted(5.0), true), (tilted(9.0), false), (turned(bar, [39.0, 5.0], 0.0), true)];
    for (other, expected) in cases {
        let base = if expected && other[0][0] > 30.0 { turned(bar, [0.0; 2], 0.0) } else { tilted(0.0) };
        assert_eq!((overlap(&base, &other), overlap(&other, &base)), (expected, expected), "{other:?}");
    }
}

#[test]
fn a_side_of_either_box_may_part_the_two() {
    // The corner (40, 0) of the level bar lies 2.5 pt off the tilted one; their upright hulls overlap.
    let bar = Rect { x: 0.0, y: 0.0, w: 40.0, h: 6.0 };
    let level = turned(bar, [0.0; 2], 0.0);
    let tilted = turned(bar, [40.0, -12.0], 45.0);
    assert!(!overlap(&level, &tilted) && !overlap(&tilted, &level));
    let closer = turned(bar, [38.0, -6.0], 45.0);
    assert!(overlap(&level, &closer) && overlap(&closer, &level));
}

#[test]
fn an_undrawable_character_is_refused_by_name() {
    let mut canvas = Canvas::new(Width::Single, 50.0);
    canvas.text([10.0, 20.0], "路径", &Type::regular(TextSize::TICK));
    let given = canvas.finish(&provenance()).unwrap_err().to_string();
    assert!(given.contains("`路`") && given.contains("`路径`"), "{given}");
}
