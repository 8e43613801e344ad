//! A flat drawing: shapes, and the SVG file that they make.

mod digits;
#[cfg(feature = "png")]
pub(super) mod png;
pub(super) mod svg;

pub(super) use digits::width as number_width;

/// A position in pixels, y down.
pub(super) type Position = [f64; 2];

/// A colour, opaque red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Colour(pub(super) u8, pub(super) u8, pub(super) u8);

/// A shape; shapes are drawn in painter's order.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A filled polygon.
    Polygon {
        /// Its corners.
        corners: Vec<Position>,
        /// Its colour.
        fill: Colour,
    },
    /// A line of segments with round joins.
    Line {
        /// Its points.
        points: Vec<Position>,
        /// Width in pixels.
        width: f64,
        /// Its colour.
        stroke: Colour,
    },
    /// A disc with a rim.
    Disc {
        /// Its centre.
        centre: Position,
        /// Radius in pixels.
        radius: f64,
        /// Colour of the inside.
        fill: Colour,
        /// Colour of the rim.
        rim: Colour,
    },
}

/// A square drawing.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    /// Width and height in pixels.
    pub(super) size: u32,
    /// The picture in words, for people who cannot see it.
    pub(super) title: String,
    /// The shapes, back to front.
    pub(super) shapes: Vec<Shape>,
}

impl Picture {
    /// A number, centred at a position; its digits are `height` pixels high.
    pub(super) fn number(&mut self, number: u32, centre: Position, height: f64, stroke: Colour) {
        let strokes = digits::strokes(number, centre, height);
        let width = digits::stroke_width(height);
        let lines = strokes.into_iter().map(|points| Shape::Line { points, width, stroke });
        self.shapes.extend(lines);
    }
}
