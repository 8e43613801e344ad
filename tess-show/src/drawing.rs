//! A patch as a picture, for `tess draw` and for the picture formats of `tess patch`.
//!
//! [`draw`] turns a listing into shapes; [`Drawing::to_svg`] writes them.

mod colours;
mod labels;
mod layout;
mod overlay;

#[cfg(feature = "png")]
use crate::picture::png;
use crate::picture::{Colour, Picture, Position, Shape, svg};
use colours::{GRID, INK, PAPER, POINT};
use layout::Layout;
pub use overlay::{Differences, differing, overlay};
use tess_core::{Domain, OutputPrimitive};
use tess_verify::vectors::Listing;

/// What a picture shows besides primitives and points, and its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawOptions {
    /// Whether points are numbered.
    pub indices: bool,
    /// The meaning of the primitives' colours.
    pub colours: Colours,
    /// The width and height, in pixels.
    pub size: u32,
}

/// The meaning of the primitives' colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colours {
    /// No meaning: one colour.
    #[default]
    Plain,
    /// The order of the primitives, which are also numbered.
    Order,
    /// The ring to which a triangle is stitched; one colour if [`has_rings`] is false.
    Rings,
}

impl Default for DrawOptions {
    /// Only primitives and points, on 800 x 800 pixels.
    fn default() -> Self {
        Self { indices: false, colours: Colours::Plain, size: 800 }
    }
}

/// Whether a patch's triangles can be coloured by ring. Isolines, points and lines cannot.
#[must_use]
pub const fn has_rings(domain: Domain, output: OutputPrimitive) -> bool {
    matches!(output, OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw)
        && !matches!(domain, Domain::Isoline)
}

/// A picture, and the number of labels for which it had no room.
#[derive(Clone, Debug)]
pub struct Drawing {
    picture: Picture,
    /// The colour of each primitive: red, green and blue.
    pub fills: Vec<[u8; 3]>,
    /// The number of requested labels that would have been too small to read.
    pub labels_left_out: usize,
}

/// Draws a patch.
#[must_use]
pub fn draw(patch: &Listing, options: &DrawOptions) -> Drawing {
    let layout = Layout::new(patch.case.domain(), options.size);
    let points = layout.place_all(&patch.output.points);
    let mut drawing = Drawing::new(patch, options, &layout);
    drawing.primitives(patch, options, &points);
    // Primitives that are points have their numbers where the points would have theirs.
    let are_points = options.colours == Colours::Order && patch.case.primitive_size() == 1;
    if are_points {
        drawing.ordered_points(patch, options, &points);
    } else if options.colours == Colours::Order {
        drawing.primitive_numbers(patch, &points);
    }
    match (are_points, options.indices) {
        (true, _) => {}
        (false, true) => drawing.point_numbers(&points),
        (false, false) => drawing.dots(&points),
    }
    drawing
}

impl Drawing {
    /// The picture as an SVG file.
    #[must_use]
    pub fn to_svg(&self) -> String {
        svg::render(&self.picture)
    }

    /// The picture as a PNG file.
    ///
    /// # Errors
    /// The size is 0, or the picture does not fit into memory.
    #[cfg(feature = "png")]
    pub fn to_png(&self) -> std::io::Result<Vec<u8>> {
        png::render(&self.picture)
    }

    /// An empty picture with the outline of the domain.
    fn new(patch: &Listing, options: &DrawOptions, layout: &Layout) -> Self {
        let mut outline = layout.corners();
        outline.extend(outline.first().copied());
        let shapes = vec![Shape::Line { points: outline, width: 1.0, stroke: GRID }];
        let picture = Picture { size: options.size, title: patch.case.command(), shapes };
        let fills = colours_of(patch, options.colours);
        let fills = fills.into_iter().map(|Colour(red, green, blue)| [red, green, blue]).collect();
        Self { picture, fills, labels_left_out: 0 }
    }

    /// Draws the fills first, then all edges over them.
    fn primitives(&mut self, patch: &Listing, options: &DrawOptions, points: &[Position]) {
        let fills = colours_of(patch, options.colours);
        let shapes = &mut self.picture.shapes;
        let edge_width = layout::edge_width(points.len());
        for (primitive, &fill) in patch.primitives().zip(&fills) {
            if let Some(corners @ [_, _, _]) = corners(primitive, points).as_deref() {
                shapes.push(Shape::Polygon { corners: corners.to_vec(), fill });
            }
        }
        for (primitive, &fill) in patch.primitives().zip(&fills) {
            if let Some(mut line) = corners(primitive, points).filter(|line| line.len() > 1) {
                let is_segment = line.len() == 2;
                line.extend(line.first().copied().filter(|_| !is_segment));
                let (width, stroke) = if is_segment && options.colours == Colours::Order {
                    (3.0, fill)
                } else {
                    (edge_width, INK)
                };
                shapes.push(Shape::Line { points: line, width, stroke });
            }
        }
    }

    fn primitive_numbers(&mut self, patch: &Listing, points: &[Position]) {
        for (number, primitive) in (0..).zip(patch.primitives()) {
            let corners = corners(primitive, points).unwrap_or_default();
            match labels::in_primitive(number, &corners) {
                Some((centre, height)) => {
                    if corners.len() == 2 {
                        self.plate(number, centre, height);
                    }
                    self.picture.number(number, centre, height, INK);
                }
                None => self.labels_left_out += 1,
            }
        }
    }

    fn plate(&mut self, number: u32, centre: Position, height: f64) {
        let corners = labels::plate(number, centre, height);
        self.picture.shapes.push(Shape::Polygon { corners, fill: PAPER });
    }

    fn dots(&mut self, points: &[Position]) {
        let radius = layout::dot_radius(points.len());
        let dot = |&centre| Shape::Disc { centre, radius, fill: POINT, rim: POINT };
        self.picture.shapes.extend(points.iter().map(dot));
    }

    fn point_numbers(&mut self, points: &[Position]) {
        self.discs(points, &vec![PAPER; points.len()], POINT);
    }

    /// Draws the points in the order of the primitives that they are.
    fn ordered_points(&mut self, patch: &Listing, options: &DrawOptions, points: &[Position]) {
        let (mut places, mut colours) = (Vec::new(), Vec::new());
        for (primitive, fill) in patch.primitives().zip(colours_of(patch, options.colours)) {
            if let Some([place]) = corners(primitive, points).as_deref() {
                places.push(*place);
                colours.push(fill);
            }
        }
        self.discs(&places, &colours, INK);
    }

    /// Draws numbered discs, as large as their neighbours allow, and rimmed dots where there is no
    /// room.
    fn discs(&mut self, places: &[Position], fills: &[Colour], rim: Colour) {
        let dot = layout::dot_radius(places.len());
        let labels: Vec<_> = (0..)
            .zip(labels::disc_radii(places))
            .map(|(number, room)| labels::in_disc(number, room))
            .collect();
        for (k, &centre) in places.iter().enumerate().filter(|(k, _)| labels[*k].is_none()) {
            self.labels_left_out += 1;
            let fill = if fills[k] == PAPER { rim } else { fills[k] };
            self.picture.shapes.push(Shape::Disc { centre, radius: dot, fill, rim });
        }
        for (number, (k, &centre)) in (0..).zip(places.iter().enumerate()) {
            if let Some((radius, height)) = labels[k] {
                let fill = fills[k];
                self.picture.shapes.push(Shape::Disc { centre, radius, fill, rim: INK });
                self.picture.number(number, centre, height, INK);
            }
        }
    }
}

/// A colour for each primitive.
fn colours_of(patch: &Listing, colours: Colours) -> Vec<Colour> {
    let count = patch.primitives().count();
    match colours {
        Colours::Plain => vec![colours::PLAIN; count],
        Colours::Order => (0..count).map(|t| colours::along_scale(t, count)).collect(),
        Colours::Rings => {
            let model = patch.case.patch();
            (0..).map(|t| colours::of_ring(model.locate_primitive(t))).take(count).collect()
        }
    }
}

/// The positions of a primitive's vertices; `None` if one of its indices is out of range.
fn corners(primitive: &[u32], points: &[Position]) -> Option<Vec<Position>> {
    primitive.iter().map(|&index| points.get(index as usize).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles without room for their numbers are counted.
    #[test]
    fn numbers_without_room_are_counted() {
        let left_out = |factor: f32, colours| {
            let bits = format!(" {:08x}", factor.to_bits()).repeat(6);
            let line = format!("case quad integer triangle_cw ruler{bits}");
            let patch = Listing::of_model(line.parse().expect("a case"));
            draw(&patch, &DrawOptions { colours, ..DrawOptions::default() }).labels_left_out
        };
        assert_eq!(left_out(4.0, Colours::Order), 0, "room for all");
        assert_eq!(left_out(64.0, Colours::Plain), 0, "none are asked for");
        assert_eq!(left_out(64.0, Colours::Order), 8192 - 10, "room for single digits");
    }
}
