//! A picture as SVG: three kinds of elements, whose attributes are numbers and colours. A crate
//! that writes any SVG would build a tree of nodes to print these lines.

use super::{Colour, Picture, Position, Shape};
use std::fmt::Write;

pub(crate) fn render(picture: &Picture) -> String {
    let size = picture.size;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{size}\" height=\"{size}\" \
         viewBox=\"0 0 {size} {size}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
         <title>{}</title>\n<rect width=\"{size}\" height=\"{size}\" fill=\"#ffffff\"/>\n",
        escape(&picture.title)
    );
    for shape in &picture.shapes {
        push_shape(&mut text, shape);
    }
    text.push_str("</svg>\n");
    text
}

fn push_shape(text: &mut String, shape: &Shape) {
    // Writing to a String does not fail.
    _ = match shape {
        Shape::Polygon { corners, fill } => {
            writeln!(text, "<polygon points=\"{}\" fill=\"{}\"/>", list(corners), hex(*fill))
        }
        Shape::Line { points, width, stroke } => writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.2}\"/>",
            list(points),
            hex(*stroke)
        ),
        Shape::Disc { centre: [x, y], radius, fill, rim } => writeln!(
            text,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" fill=\"{}\" stroke=\"{}\"/>",
            hex(*fill),
            hex(*rim)
        ),
    };
}

fn list(positions: &[Position]) -> String {
    let pairs: Vec<_> = positions.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
    pairs.join(" ")
}

fn hex(Colour(red, green, blue): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Escapes text between tags.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
