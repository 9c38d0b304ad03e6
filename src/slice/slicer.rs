use super::grid::GridTracer;
use super::plane::{Plane, Region, tiny};
use super::section::{BLOCK, Sections, Segment};
use super::{SliceConfig, SliceMode, Span, chains, disjoint, open};
use crate::data::{LatticeError, Layer, Lazy, Polygon, Shape, ascending, map_tasks};
use crate::math::Aabb;
use crate::polygon::{Boolean, Fill, combined, enclosed, simplify, straightened};
use crate::winding::{THRESHOLD, WindingField};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Regions with more overlaps than this are not told apart in even-odd contours of open shapes.
const MOST_OVERLAPS: usize = 64;

/// A field, ready to be cut at many heights.
pub(super) struct Slicer<'a> {
    field: &'a WindingField,
    config: SliceConfig,
    spans: &'a [Span],
    way: Way<'a>,
    /// Layers whose contours came from a grid although the surface is known.
    approximated: AtomicUsize,
}

/// How contours are found.
enum Way<'a> {
    /// The section is the contour, but for what overlaps.
    Closed(Sections<'a>, Vec<u32>),
    /// Parts of the section and arcs between their ends.
    Open {
        sections: Sections<'a>,
        order: Vec<u32>,
        openings: Vec<Aabb>,
        grid: Lazy<GridTracer<'a>>,
    },
    Grid(GridTracer<'a>),
}

impl<'a> Slicer<'a> {
    pub fn new(
        field: &'a WindingField,
        spans: &'a [Span],
        config: &SliceConfig,
    ) -> Result<Slicer<'a>, LatticeError> {
        let order = ascending(spans.iter().map(|span| span.sample));
        let way = match field.shape() {
            // Of many loose triangles each evaluation sums all there are, and each triangle has two ends.
            Shape::Soup(soup) if field.report().loose_components == 0 => {
                GridTracer::check(field, config)?;
                // A field has a single value on faces in the plane: what is half open of a section has to be of the field too.
                let lift = if field.is_closed() { 0.0 } else { tiny(field.bounds()) };
                let heights = order.iter().map(|k| spans[*k as usize].sample + lift).collect();
                let sections = Sections::new(soup, heights);
                if field.is_closed() {
                    Way::Closed(sections, order)
                } else {
                    field.prepare_single_points();
                    Way::Open { sections, order, openings: field.openings(), grid: Lazy::new() }
                }
            }
            _ => {
                field.prepare_single_points();
                Way::Grid(GridTracer::new(field, config)?)
            }
        };
        let by_grid = matches!((&way, field.shape()), (Way::Grid(_), Shape::Soup(_)));
        let approximated = AtomicUsize::new(if by_grid { spans.len() } else { 0 });
        Ok(Slicer { field, config: *config, spans, way, approximated })
    }

    /// Layers of [`Slicer::block`].
    pub fn blocks(&self) -> usize {
        self.spans.len().div_ceil(BLOCK)
    }

    /// Layers of a soup of which the contours are those of a grid.
    pub fn approximated(&self) -> usize {
        self.approximated.load(Relaxed)
    }

    /// Some layers, each with its place in the order that was asked for.
    pub fn block(&self, block: usize) -> Vec<(usize, Layer)> {
        let first = block * BLOCK;
        let places = first..self.spans.len().min(first + BLOCK);
        match &self.way {
            Way::Grid(grid) => map_tasks(places.len(), |k| {
                let place = first + k;
                let polygons = self.by_mode(|region| grid.polygons(self.spans[place].sample, region));
                (place, self.layer(place, polygons))
            }),
            Way::Closed(sections, order) => {
                let of_layer = |(k, segments): (usize, &Vec<Segment>)| {
                    let place = order[first + k] as usize;
                    (place, self.layer(place, self.of_closed(segments)))
                };
                sections.block(block).iter().enumerate().map(of_layer).collect()
            }
            Way::Open { sections, order, openings, grid } => {
                let of_layer = |(k, segments): (usize, &Vec<Segment>)| {
                    let place = order[first + k] as usize;
                    let z = sections.height(first + k);
                    let polygons = self.by_mode(|region| {
                        open::polygons(segments, &Plane::new(self.field, z, region), openings)
                            .unwrap_or_else(|| self.by_grid(grid, z, region))
                    });
                    (place, self.layer(place, polygons))
                };
                sections.block(block).iter().enumerate().map(of_layer).collect()
            }
        }
    }

    fn by_grid(&self, grid: &Lazy<GridTracer<'a>>, z: f64, region: Region) -> Vec<Polygon> {
        self.approximated.fetch_add(1, Relaxed);
        let grid = grid.get_or_try_build(|| GridTracer::new(self.field, &self.config));
        grid.map(|grid| grid.polygons(z, region)).unwrap_or_default()
    }

    fn of_closed(&self, segments: &[Segment]) -> Vec<Polygon> {
        let chains = chains::join(segments);
        match self.config.mode {
            SliceMode::EvenOdd => enclosed(&chains.loops, Fill::EvenOdd),
            SliceMode::Winding | SliceMode::Largest => disjoint::polygons_of(&chains),
        }
    }

    /// What a mode makes of the regions of a field.
    fn by_mode(&self, of_region: impl Fn(Region) -> Vec<Polygon>) -> Vec<Polygon> {
        let mut all = of_region(Region::AtLeast(THRESHOLD));
        if self.config.mode == SliceMode::EvenOdd {
            let upward = (1..MOST_OVERLAPS).map(|k| Region::AtLeast(k as f64 + 0.5));
            let downward = (0..MOST_OVERLAPS).map(|k| Region::Below(-0.5 - k as f64));
            for regions in
                [&mut upward.into_iter() as &mut dyn Iterator<Item = Region>, &mut downward.into_iter()]
            {
                for polygons in regions.map(&of_region).take_while(|polygons| !polygons.is_empty()) {
                    all = combined(&all, &polygons, Boolean::Xor);
                }
            }
        }
        all
    }

    fn layer(&self, place: usize, mut polygons: Vec<Polygon>) -> Layer {
        if self.config.mode == SliceMode::Largest {
            polygons = largest(polygons);
        }
        // Flat walls of many triangles have straight contours.
        for polygon in &mut polygons {
            polygon.outer = straightened(&polygon.outer);
            polygon.holes.iter_mut().for_each(|hole| *hole = straightened(hole));
        }
        if self.config.simplify > 0.0 {
            polygons = simplify(&polygons, self.config.simplify);
        }
        let span = &self.spans[place];
        Layer { z_bottom: span.bottom, z_top: span.top, z_sample: span.sample, polygons }
    }
}

/// The largest outline alone, without its holes.
fn largest(polygons: Vec<Polygon>) -> Vec<Polygon> {
    let outlines = polygons.into_iter().map(|p| Polygon { outer: p.outer, holes: Vec::new() });
    outlines.max_by(|a, b| a.area().total_cmp(&b.area())).into_iter().collect()
}
