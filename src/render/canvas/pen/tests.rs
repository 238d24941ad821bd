use super::*;
use crate::render::style::{BLUE, ORANGE, Width};
use crate::render::vector::{Figure, Provenance};
use plotters::element::{Circle, PathElement, Polygon, Rectangle};
use plotters::prelude::DrawingArea;
use plotters::style::text_anchor::Pos;

fn page(draw: impl FnOnce(&mut Canvas)) -> Result<Figure, RenderError> {
    let mut canvas = Canvas::new(Width::Single, 100.0);
    draw(&mut canvas);
    let command = String::new();
    let spec_hash = String::new();
    let title = String::new();
    canvas.finish(&Provenance { command, spec_hash, title })
}

#[test]
fn what_plotters_draws_is_what_the_canvas_draws_itself() {
    let stroke = Stroke { opacity: 0.5, ..Stroke::solid(BLUE, 0.35) }.dashed(Dash::DashDot);
    let solid = Stroke { dash: Dash::Solid, ..stroke };
    let fill = Fill::sheer(ORANGE, 0.25);
    let by_plotters = page(|canvas| {
        let area = DrawingArea::from(Pen::new(canvas, Dash::DashDot));
        area.draw(&PathElement::new([(1234, 5678), (2000, 1), (3003, 99)], stroke)).unwrap();
        area.draw(&Polygon::new([(0, 0), (1010, 7), (507, 998)], fill)).unwrap();
        area.draw(&Rectangle::new([(5050, 6060), (4001, 3003)], fill)).unwrap();
        drop(area);
        let area = DrawingArea::from(Pen::new(canvas, Dash::Solid));
        area.draw(&Rectangle::new([(4001, 3003), (5050, 6060)], solid)).unwrap();
        area.draw(&Circle::new((777, 888), 90, fill)).unwrap();
        area.draw(&Circle::new((777, 888), 90, solid)).unwrap();
    });
    let by_canvas = page(|canvas| {
        canvas.polyline(&[[12.34, 56.78], [20.0, 0.01], [30.03, 0.99]], &stroke);
        canvas.polygon(&[[0.0, 0.0], [10.1, 0.07], [5.07, 9.98]], Some(fill), None);
        let rect = Rect { x: 40.01, y: 30.03, w: 10.49, h: 30.57 };
        canvas.rect(rect, Some(fill), None);
        canvas.rect(rect, None, Some(&solid));
        canvas.circle([7.77, 8.88], 0.9, Some(fill), None);
        canvas.circle([7.77, 8.88], 0.9, None, Some(&solid));
    });
    assert_eq!(by_plotters.unwrap().svg, by_canvas.unwrap().svg);
}

#[test]
fn text_of_plotters_is_outlined_and_set_as_the_canvas_sets_it() {
    let anchors = [
        (HPos::Left, Align::Start, VPos::Bottom, Stand::Base, FontTransform::None, 0.0),
        (HPos::Center, Align::Middle, VPos::Top, Stand::Below, FontTransform::Rotate270, -90.0),
        (HPos::Right, Align::End, VPos::Center, Stand::Centre, FontTransform::Rotate90, 90.0),
    ];
    for (index, (h_pos, align, v_pos, stand, transform, turn_deg)) in anchors.into_iter().enumerate() {
        let set = Type::regular(TextSize::LABEL).colored(BLUE);
        let set = if index == 1 { set.bold() } else { set };
        let by_plotters = page(|canvas| {
            let style = text_style(&set).transform(transform).pos(Pos::new(h_pos, v_pos));
            DrawingArea::from(Pen::new(canvas, Dash::Solid))
                .draw_text("θ₁ = −√2", &style, (6050, 5025))
                .unwrap();
        });
        let by_canvas = page(|canvas| {
            canvas.text([60.5, 50.25], "θ₁ = −√2", &Type { turn_deg, ..set.aligned(align, stand) });
        });
        assert_eq!(by_plotters.unwrap().svg, by_canvas.unwrap().svg, "anchor {index}");
    }
}

#[test]
fn text_of_plotters_that_cannot_be_printed_is_refused() {
    for (size, text, expected) in [(300.0, "small", "3 pt is too small"), (700.0, "路", "no glyph for `路`")]
    {
        let refused = page(|canvas| {
            let style = FontDesc::new(FontFamily::Serif, size, FontStyle::Italic).into();
            DrawingArea::from(Pen::new(canvas, Dash::Solid)).draw_text(text, &style, (2000, 2000)).unwrap();
        });
        let message = refused.unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}
