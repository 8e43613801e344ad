//! A picture as PNG.

use super::{Colour, Picture, Position, Shape};
use std::io;
use tiny_skia::{FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

pub(crate) fn render(picture: &Picture) -> io::Result<Vec<u8>> {
    let size = picture.size;
    let mut pixels = Pixmap::new(size, size).ok_or_else(|| {
        io::Error::other(format!("a picture of {size} x {size} pixels cannot be made"))
    })?;
    pixels.fill(tiny_skia::Color::WHITE);
    picture.shapes.iter().for_each(|shape| draw(&mut pixels, shape));
    pixels.encode_png().map_err(|error| io::Error::other(format!("cannot write PNG: {error}")))
}

/// Draws a shape; a shape without any extent leaves no mark.
fn draw(pixels: &mut Pixmap, shape: &Shape) {
    match shape {
        Shape::Polygon { corners, fill } => {
            if let Some(path) = path(corners, true) {
                fill_path(pixels, &path, *fill);
            }
        }
        Shape::Line { points, width, stroke } => {
            if let Some(path) = path(points, false) {
                stroke_path(pixels, &path, *stroke, single(*width));
            }
        }
        Shape::Disc { centre: [x, y], radius, fill, rim } => {
            let path = PathBuilder::from_circle(single(*x), single(*y), single(*radius));
            if let Some(path) = path {
                fill_path(pixels, &path, *fill);
                stroke_path(pixels, &path, *rim, 1.0);
            }
        }
    }
}

fn fill_path(pixels: &mut Pixmap, path: &Path, colour: Colour) {
    pixels.fill_path(path, &paint(colour), FillRule::Winding, Transform::identity(), None);
}

fn stroke_path(pixels: &mut Pixmap, path: &Path, colour: Colour, width: f32) {
    let stroke =
        Stroke { width, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
    pixels.stroke_path(path, &paint(colour), &stroke, Transform::identity(), None);
}

fn path(points: &[Position], closed: bool) -> Option<Path> {
    let (first, rest) = points.split_first()?;
    let mut path = PathBuilder::new();
    path.move_to(single(first[0]), single(first[1]));
    rest.iter().for_each(|[x, y]| path.line_to(single(*x), single(*y)));
    if closed {
        path.close();
    }
    path.finish()
}

fn paint(Colour(red, green, blue): Colour) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, 255);
    paint
}

#[expect(clippy::cast_possible_truncation, reason = "the rasteriser works in binary32")]
const fn single(pixels: f64) -> f32 {
    pixels as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Colour = Colour(200, 0, 0);
    const BLUE: Colour = Colour(0, 0, 200);

    /// The pixel at a position of a decoded picture.
    fn pixel(pixels: &Pixmap, [x, y]: [u32; 2]) -> Colour {
        let pixel = pixels.pixel(x, y).expect("within the picture").demultiply();
        Colour(pixel.red(), pixel.green(), pixel.blue())
    }

    #[test]
    fn shapes_are_where_they_are_said_to_be() {
        let shapes = vec![
            Shape::Polygon { corners: vec![[0.0, 0.0], [20.0, 0.0], [0.0, 20.0]], fill: RED },
            Shape::Line {
                points: vec![[30.5, 10.0], [30.5, 40.0], [50.0, 40.0]],
                width: 5.0,
                stroke: BLUE,
            },
            Shape::Disc { centre: [16.0, 48.0], radius: 10.0, fill: RED, rim: BLUE },
            Shape::Polygon { corners: vec![[60.0, 60.0]], fill: BLUE },
        ];
        let picture = Picture { size: 64, title: String::new(), shapes };
        let png = render(&picture).expect("a picture");
        let pixels = Pixmap::decode_png(&png).expect("PNG");
        assert_eq!((pixels.width(), pixels.height()), (64, 64));
        let white = Colour(255, 255, 255);
        for (at, expected) in [
            ([5, 5], RED),
            ([15, 15], white),
            // The line has its full width, and its ends and its bend are round.
            ([28, 20], BLUE),
            ([32, 20], BLUE),
            ([27, 20], white),
            ([34, 20], white),
            ([30, 8], BLUE),
            ([30, 6], white),
            ([28, 42], white),
            ([16, 48], RED),
            ([16, 56], RED),
            ([2, 48], white),
            ([60, 60], white),
        ] {
            assert_eq!(pixel(&pixels, at), expected, "{at:?}");
        }
        assert_ne!(pixel(&pixels, [26, 48]), white, "the rim");
        let edge = pixel(&pixels, [10, 9]);
        assert!(edge != RED && edge != white, "edges are smooth: {edge:?}");
        let error = render(&Picture { size: 0, ..picture }).expect_err("no picture");
        assert!(error.to_string().contains("0 x 0 pixels"), "{error}");
    }
}
