//! Atlases: disks without flips or overlaps, cut where it was asked for.
use super::*;

/// The Euler number of each chart, by its own texture coordinates.
fn euler_numbers(atlas: &Atlas) -> Vec<i64> {
    let mut numbers = vec![0; atlas.chart_count];
    let mut vertex_chart = vec![u32::MAX; atlas.uv.len()];
    let mut edges = std::collections::HashSet::new();
    for (corners, chart) in atlas.corners.iter().zip(&atlas.charts) {
        numbers[*chart as usize] += 1;
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            assert!(vertex_chart[a as usize] == u32::MAX || vertex_chart[a as usize] == *chart);
            if vertex_chart[a as usize] == u32::MAX {
                vertex_chart[a as usize] = *chart;
                numbers[*chart as usize] += 1;
            }
            if edges.insert((a.min(b), a.max(b))) {
                numbers[*chart as usize] -= 1;
            }
        }
    }
    numbers
}

/// Texels that the triangles of an atlas cover, and how many of those are covered twice, at centres of a grid.
fn covered(atlas: &Atlas, side: usize) -> (usize, usize) {
    let mut counts = vec![0u8; side * side];
    for t in 0..atlas.corners.len() as u32 {
        let [a, b, c] = atlas.corners_of(t).map(|p| p * side as f64);
        let (low, high) = (a.min(b).min(c).floor(), a.max(b).max(c).ceil());
        for x in low.x as usize..high.x as usize {
            for y in low.y as usize..high.y as usize {
                let p = Vec2::new(x as f64 + 0.5, y as f64 + 0.5);
                if [(a, b), (b, c), (c, a)].iter().all(|(s, t)| (*t - *s).perp_dot(p - *s) > 0.0) {
                    counts[x * side + y] += 1;
                }
            }
        }
    }
    (counts.iter().filter(|c| **c > 0).count(), counts.iter().filter(|c| **c > 1).count())
}

#[test]
fn charts_are_disks_without_flips_or_overlaps() {
    let shapes: [(TriangleSoup, f64); 4] =
        [(gridded_cube(2), 0.1), (sphere(8), 0.1), (torus(2.0, 0.6, 30, 16), 0.2), (genus_five(2), 0.2)];
    for (k, (soup, offset)) in shapes.into_iter().enumerate() {
        let mesh = proxy_of(soup, &ProxyConfig { smoothing: 2, ..at_offset(offset) }).mesh;
        let atlas = Atlas::new(&mesh, &AtlasConfig::default(), &Silent).unwrap();
        assert!(euler_numbers(&atlas).iter().all(|number| *number == 1), "{k}: {:?}", euler_numbers(&atlas));
        assert_eq!((atlas.distortion.flipped, atlas.distortion.flat), (0, 0), "{k}");
        let (used, twice) = covered(&atlas, 512);
        assert_eq!(twice, 0, "{k}");
        assert!((used as f64 / 512f64.powi(2) - atlas.coverage).abs() < 0.02, "{k}");
        assert!(atlas.coverage > 0.3, "{k}: {}", atlas.coverage);
        assert!(
            atlas.distortion.mean_ratio < 1.15 && atlas.distortion.area_spread < 0.12,
            "{k}: {:?}",
            atlas.distortion
        );
        // A cube has a chart for each side.
        assert!(k > 0 || atlas.chart_count == 6, "{}", atlas.chart_count);
    }
}

/// Vertices of a mesh next to places.
fn nearest(mesh: &SurfaceMesh, places: &[Vec3]) -> Vec<u32> {
    let to = |place: &Vec3| {
        let distances = mesh.positions.iter().map(|p| p.distance_squared(*place)).zip(0u32..);
        distances.min_by(|a, b| a.partial_cmp(b).unwrap()).unwrap().1
    };
    places.iter().map(to).collect()
}

#[test]
fn no_chart_reaches_across_a_drawn_seam() {
    let mesh = proxy_of(sphere(8), &at_offset(0.15)).mesh;
    // Once around the equator: two halves, each a disk.
    let corners = [Vec3::X, Vec3::Y, -Vec3::X, -Vec3::Y, Vec3::X];
    let seam =
        seam_through(&mesh, &nearest(&mesh, &corners), &SeamCost { curvature: 0.0, change: 0.0 }).unwrap();
    let config = AtlasConfig { seams: seam.clone(), only_seams: true, ..AtlasConfig::default() };
    let halves = Atlas::new(&mesh, &config, &Silent).unwrap();
    assert_eq!((halves.chart_count, halves.distortion.flipped), (2, 0));
    let length: f64 =
        seam.iter().map(|[a, b]| mesh.positions[*a as usize].distance(mesh.positions[*b as usize])).sum();
    assert!((halves.seam_length - length).abs() < 1e-9 * length);
    let both = Atlas::new(&mesh, &AtlasConfig { only_seams: false, ..config }, &Silent).unwrap();
    let sides: std::collections::HashMap<(u32, u32), u32> = mesh
        .triangles
        .iter()
        .zip(&both.charts)
        .flat_map(|(t, chart)| (0..3).map(|k| ((t[k], t[(k + 1) % 3]), *chart)))
        .collect();
    assert!(seam.iter().all(|[a, b]| sides[&(*a, *b)] != sides[&(*b, *a)]));
}
