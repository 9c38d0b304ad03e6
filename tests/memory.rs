//! What the field and the questions to it promise to take of memory. In a test binary of its own, and one test after the
//! other, as the allocator counts for the whole process.
mod common;

use common::{cuboid, joined, torus, without};
use fast_winding::data::{Lattice, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::slice::{LayerPlan, SliceConfig, slice_each};
use fast_winding::solid::{VoxelConfig, VoxelError, VoxelMethod, voxelize, voxelize_bricks};
use fast_winding::winding::{Accuracy, FieldError, Order};
use fast_winding::{WindingField, math::area_vector};
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::SeqCst};
use std::sync::{Mutex, MutexGuard};

struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
static ALONE: Mutex<()> = Mutex::new(());

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let pointer = unsafe { System.alloc(layout) };
        if !pointer.is_null() {
            let held = HELD.fetch_add(layout.size(), SeqCst) + layout.size();
            PEAK.fetch_max(held, SeqCst);
        }
        pointer
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), SeqCst);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Keeps other tests from allocating meanwhile.
fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// What `action` gives, the most bytes held meanwhile and those held after it, beyond those before.
fn measured<R>(action: impl FnOnce() -> R) -> (R, usize, usize) {
    let before = HELD.load(SeqCst);
    PEAK.store(before, SeqCst);
    let result = action();
    (result, PEAK.load(SeqCst) - before, HELD.load(SeqCst).saturating_sub(before))
}

/// 80,000 triangles.
fn closed() -> TriangleSoup {
    torus(30.0, 12.0, 400, 100)
}

/// With 40 holes of a few triangles each.
fn open() -> TriangleSoup {
    without(&closed(), |t| t % 2000 < 6)
}

/// No two triangles share a vertex, so every one of them is an opening.
fn loose() -> TriangleSoup {
    let soup = closed();
    let shrunk = |t: usize| {
        let corners = soup.corners(t);
        let shift = 1e-3 * area_vector(corners).normalize_or_zero();
        corners.map(|p| 0.999 * p + shift)
    };
    let positions = (0..soup.len()).flat_map(shrunk).collect();
    let triangles = (0..soup.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(positions, triangles).unwrap()
}

/// Bytes per triangle that a field prepared for points holds, and the most that it held while it was built.
fn bytes_per_triangle(name: &str, soup: TriangleSoup) -> [f64; 2] {
    let triangles = soup.len() as f64;
    let (field, peak, held) = measured(|| {
        let field = WindingField::new(soup, Default::default());
        field.prepare_points();
        field
    });
    let [held, peak] = [held, peak].map(|bytes| bytes as f64 / triangles);
    println!("{name}: {held:.1} bytes per triangle, at most {peak:.1}; it says {}", field.bytes());
    // The report leaves out what does not grow with the soup.
    let reported = field.bytes() as f64 / triangles;
    assert!(
        reported > 0.8 * held - 1.0 && reported < 1.2 * held + 1.0,
        "{name}: {reported} reported, {held} held"
    );
    [held, peak]
}

/// The promise, per triangle beside the soup.
const MOST_BYTES_PER_TRIANGLE: f64 = 120.0;

#[test]
fn a_field_takes_at_most_120_bytes_per_triangle_beside_the_soup() {
    let _alone = alone();
    for (name, soup) in [("closed", closed()), ("open", open()), ("pieces", joined(&[closed(), closed()]))] {
        let [held, peak] = bytes_per_triangle(name, soup);
        assert!(held <= MOST_BYTES_PER_TRIANGLE, "{name}: {held}");
        assert!(peak <= 1.5 * MOST_BYTES_PER_TRIANGLE, "{name}: {peak} while it is built");
    }
}

#[test]
fn a_field_of_loose_triangles_takes_at_most_120_bytes_per_triangle() {
    let _alone = alone();
    let [held, _] = bytes_per_triangle("loose", loose());
    assert!(held <= MOST_BYTES_PER_TRIANGLE, "{held}");
}

#[test]
fn classifying_a_lattice_of_512_cubed_peaks_below_100_mb() {
    let _alone = alone();
    // More threads than most machines have: each works on a slab of its own.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(16).build().unwrap();
    let soup = torus(30.0, 12.0, 40, 20);
    for (name, soup) in [("open", without(&soup, |t| t % 400 < 6)), ("closed", soup)] {
        let field = WindingField::new(soup, Default::default());
        field.prepare_points();
        let lattice = Lattice::with_counts(field.bounds(), [512; 3]).unwrap();
        let (bits, peak, held) =
            pool.install(|| measured(|| field.classify_lattice(&lattice, 0.5, &Silent).unwrap()));
        println!("{name}: at most {:.1} MB, {:.1} MB left", peak as f64 / 1e6, held as f64 / 1e6);
        assert_eq!(bits.len(), 512usize.pow(3) / 8);
        assert!(peak < 100_000_000, "{name}: {peak}");
    }
}

#[test]
fn slicing_into_100_000_layers_peaks_below_10_mb() {
    let _alone = alone();
    // Walls as tall as the shape meet every layer; each of the torus's triangles meets thousands.
    let walls = cuboid(Aabb { min: Vec3::splat(-50.0), max: Vec3::splat(50.0) });
    let upright = closed().positions().iter().map(|p| Vec3::new(p.x, -p.z, p.y)).collect();
    let upright = TriangleSoup::new(upright, closed().triangles().to_vec()).unwrap();
    for (name, soup) in [("walls", walls), ("80,000 triangles", upright)] {
        let field = WindingField::new(soup, Default::default());
        let layer_height = field.bounds().size().z / 1e5;
        let plan = LayerPlan { layer_height, ..LayerPlan::default() };
        let (mut count, mut points) = (0, 0);
        let (report, peak, held) = measured(|| {
            slice_each(&field, &plan, &SliceConfig::default(), &Silent, &mut |place, layer| {
                assert_eq!(place, count, "layers come from below");
                count += 1;
                points += layer.polygons.iter().map(|p| p.outer.len()).sum::<usize>();
            })
        });
        println!("{name}: at most {:.1} MB for {points} points, {held} bytes left", peak as f64 / 1e6);
        assert_eq!((report.unwrap().layers, count), (100_000, 100_000));
        assert!(points > 100_000 && peak < 10_000_000, "{name}: {peak}");
    }
}

#[test]
fn what_cannot_fit_is_refused_before_anything_is_taken() {
    let _alone = alone();
    let unit = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
    let lattices = [[100_000; 3], [usize::MAX; 3], [1, 1, usize::MAX], [1 << 22, 1 << 21, 1 << 21]]
        .map(|counts| Lattice { origin: unit.min, spacing: Vec3::splat(1e-5), counts });
    let shapes = [torus(30.0, 12.0, 40, 20), open(), loose()];
    for soup in shapes {
        let field = WindingField::new(soup, Default::default());
        for lattice in &lattices {
            let refused = |result: Result<(), FieldError>| match result {
                Err(FieldError::OutOfMemory(error)) => assert!(error.bytes > 1 << 40, "{error}"),
                other => panic!("{:?}: {other:?}", lattice.counts),
            };
            let ((), peak, _) = measured(|| {
                refused(field.classify_lattice(lattice, 0.5, &Silent).map(drop));
                refused(field.evaluate_lattice(lattice, Accuracy::default(), &Silent).map(drop));
                let explicit = Accuracy::of_paper(field.shape());
                refused(field.evaluate_lattice(lattice, explicit, &Silent).map(drop));
                let rays = VoxelMethod::Rays(Default::default());
                let fast = VoxelMethod::Fast { order: Order::Two, beta: 2.0 };
                for method in [VoxelMethod::Lattice, VoxelMethod::Continuation, rays, fast] {
                    let config = VoxelConfig { threshold: 0.5, method };
                    let voxels = voxelize(&field, lattice, &config, &Silent);
                    assert!(matches!(voxels, Err(VoxelError::OutOfMemory(_))), "{voxels:?}");
                    let bricks = voxelize_bricks(&field, lattice, &config, &Silent);
                    assert!(matches!(bricks, Err(VoxelError::OutOfMemory(_))), "{bricks:?}");
                }
            });
            assert!(peak < 10_000, "{:?}: {peak} bytes were taken", lattice.counts);
        }
        let inside = field.contains(&[Vec3::new(30.0, 0.1, 0.2)], &Silent).unwrap();
        assert_eq!(inside, [true]);
    }
}
