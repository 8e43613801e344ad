//! A patch as a picture: what `tess draw` and the picture formats of `tess patch` show.

mod colours;
mod labels;
mod layout;
mod overlay;
mod rings;

use crate::failure::Failure;
use crate::formats::OnePatch;
use crate::picture::{Colour, Picture, Position, Shape};
use colours::{GRID, INK, PAPER, POINT};
use layout::Layout;
pub(crate) use overlay::overlay;
use tess_core::{Domain, OutputPrimitive};
use tess_verify::vectors::primitive_size;

/// What a picture shows beside the primitives and points themselves.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(crate) struct DrawOptions {
    /// Number the points
    #[arg(long)]
    pub(crate) indices: bool,
    /// Colour the primitives by their order and number them
    #[arg(long)]
    pub(crate) order: bool,
    /// Colour the triangles by the ring that they are stitched to
    #[arg(long, conflicts_with = "order")]
    pub(crate) rings: bool,
    /// Width and height in pixels, 64 to 8192
    #[arg(long, value_name = "PIXELS", default_value_t = 800)]
    #[arg(value_parser = clap::value_parser!(u32).range(64..=8192))]
    pub(crate) size: u32,
}

/// A picture and how many numbers it had no room for.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    /// The picture.
    pub(crate) picture: Picture,
    /// Numbers asked for that would have been too small to read.
    pub(crate) labels_left_out: usize,
}

/// Draws a patch.
#[must_use]
pub(crate) fn draw(patch: &OnePatch, options: &DrawOptions) -> Drawing {
    let layout = Layout::new(patch.case().domain(), options.size);
    let points = layout.place_all(&patch.output().points);
    let mut drawing = Drawing::new(patch, options, &layout);
    drawing.primitives(patch, options, &points);
    // Primitives that are points have their numbers where the points have theirs.
    let are_points = options.order && primitive_size(patch.case()) == 1;
    if are_points {
        drawing.ordered_points(patch, options, &points);
    } else if options.order {
        drawing.primitive_numbers(patch, &points);
    }
    match (are_points, options.indices) {
        (true, _) => {}
        (false, true) => drawing.point_numbers(&points),
        (false, false) => drawing.dots(&points),
    }
    drawing
}

impl DrawOptions {
    /// Refuses to show what a patch does not have.
    ///
    /// # Errors
    /// Rings without triangles.
    pub(crate) fn fit(&self, domain: Domain, output: OutputPrimitive) -> Result<(), Failure> {
        let is_triangles =
            matches!(output, OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw);
        if self.rings && (domain == Domain::Isoline || !is_triangles) {
            return Err(Failure::bad_input(
                "--rings colours the triangles of a tri or quad patch; this one has none",
            ));
        }
        Ok(())
    }
}

impl Drawing {
    /// An empty picture with the outline of the domain.
    fn new(patch: &OnePatch, options: &DrawOptions, layout: &Layout) -> Self {
        let mut outline = layout.corners();
        outline.extend(outline.first().copied());
        let shapes = vec![Shape::Line { points: outline, width: 1.0, stroke: GRID }];
        let picture = Picture { size: options.size, title: patch.case().command(), shapes };
        Self { picture, labels_left_out: 0 }
    }

    /// Fills first, edges over all of them.
    fn primitives(&mut self, patch: &OnePatch, options: &DrawOptions, points: &[Position]) {
        let fills = fills(patch, options);
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
                let (width, stroke) =
                    if is_segment && options.order { (3.0, fill) } else { (edge_width, INK) };
                shapes.push(Shape::Line { points: line, width, stroke });
            }
        }
    }

    fn primitive_numbers(&mut self, patch: &OnePatch, points: &[Position]) {
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

    /// The points in the order of the primitives that they are.
    fn ordered_points(&mut self, patch: &OnePatch, options: &DrawOptions, points: &[Position]) {
        let (mut places, mut colours) = (Vec::new(), Vec::new());
        for (primitive, fill) in patch.primitives().zip(fills(patch, options)) {
            if let Some([place]) = corners(primitive, points).as_deref() {
                places.push(*place);
                colours.push(fill);
            }
        }
        self.discs(&places, &colours, INK);
    }

    /// Numbered discs, as large as their neighbours allow; dots with a rim where there is no room.
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
fn fills(patch: &OnePatch, options: &DrawOptions) -> Vec<Colour> {
    let count = patch.primitives().count();
    if options.order {
        (0..count).map(|t| colours::along_scale(t, count)).collect()
    } else if options.rings {
        rings::rings(&patch.case().patch(), count).into_iter().map(colours::of_ring).collect()
    } else {
        vec![colours::PLAIN; count]
    }
}

/// The positions of a primitive's vertices; `None` if one of its indices is out of range.
fn corners(primitive: &[u32], points: &[Position]) -> Option<Vec<Position>> {
    primitive.iter().map(|&index| points.get(index as usize).copied()).collect()
}
