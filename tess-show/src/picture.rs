//! A flat drawing: shapes, and their SVG file.

mod digits;
#[cfg(feature = "png")]
pub(super) mod png;
pub(super) mod svg;

pub(super) use digits::width as number_width;

/// A position in pixels, with y pointing down.
pub(super) type Position = [f64; 2];

/// An opaque colour: red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Colour(pub(super) u8, pub(super) u8, pub(super) u8);

/// A shape. Later shapes are drawn over earlier ones.
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
        /// The width in pixels.
        width: f64,
        /// Its colour.
        stroke: Colour,
    },
    /// A disc with a rim.
    Disc {
        /// Its centre.
        centre: Position,
        /// The radius in pixels.
        radius: f64,
        /// The colour of the inside.
        fill: Colour,
        /// The colour of the rim.
        rim: Colour,
    },
}

/// A square drawing.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    /// The width and height in pixels.
    pub(super) size: u32,
    /// A description of the picture for people who cannot see it.
    pub(super) title: String,
    /// The shapes, back to front.
    pub(super) shapes: Vec<Shape>,
}

impl Picture {
    /// Draws a number, centred at a position, with digits that are `height` pixels high.
    pub(super) fn number(&mut self, number: u32, centre: Position, height: f64, stroke: Colour) {
        let strokes = digits::strokes(number, centre, height);
        let width = digits::stroke_width(height);
        let lines = strokes.into_iter().map(|points| Shape::Line { points, width, stroke });
        self.shapes.extend(lines);
    }
}
