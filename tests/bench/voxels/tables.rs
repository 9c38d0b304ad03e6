//! The tables of Pimentel, Scrivener & To 2022, *Winding Number Computation for Triangle Soups and Point Clouds*: their times on an
//! Apple M1 Pro, quoted, and ours here. Their bunnies of 1,000 and 10,000 triangles, their bust of Max and their armadillo are not
//! at hand: surfaces of the bunny remeshed to about as many triangles, and models of other names, stand for them.
use crate::{median, milliseconds, models, read_soup, with_commas};
use fast_winding::data::{OrientedCloud, Silent};
use fast_winding::math::{Vec3, area_vector};
use fast_winding::solid::{VoxelConfig, VoxelMethod, Voxels, difference, voxelize, voxelize_by_rays};
use fast_winding::surface::{SurfaceConfig, extract};
use fast_winding::winding::{Order, StabCount, Stabbing, WindingField};
use fast_winding::{Lattice, TriangleSoup};
use std::f64::consts::TAU;
use std::sync::Arc;

struct Row {
    name: &'static str,
    soup: Arc<TriangleSoup>,
    resolution: usize,
    /// Milliseconds; of the same model, or of one about as large.
    theirs: Option<usize>,
}

pub fn print() {
    let bunny = Arc::new(read_soup(&models("bunny")));
    let [thousand, ten_thousand] = [1000, 10_000].map(|count| Arc::new(remeshed(&bunny, count)));
    let soup = |name: &str| Arc::new(read_soup(&models(name)));
    let (teapot, knot, dragon) = (soup("teapot"), soup("knot124k"), soup("dragon202k"));
    let row = |name, soup: &Arc<TriangleSoup>, resolution, theirs| Row {
        name,
        soup: soup.clone(),
        resolution,
        theirs,
    };
    println!("{} threads; n³ samples of the bounds; milliseconds.\n", rayon::current_num_threads());
    rays(&[
        row("Icosahedron", &Arc::new(icosahedron()), 32, Some(139)),
        row("Sphere", &Arc::new(globe(32, 16)), 32, Some(7123)),
        row("Teapot", &teapot, 32, Some(17_659)),
        row("Bunny, remeshed", &thousand, 32, Some(7279)),
        row("Bunny, remeshed", &ten_thousand, 32, Some(71_963)),
        row("Bunny", &bunny, 32, Some(506_532)),
        row("Bunny", &bunny, 64, None),
        row("Bunny", &bunny, 128, None),
    ]);
    let of_bunny = |theirs: [Option<usize>; 3], name, soup: &Arc<TriangleSoup>| {
        [32, 64, 128].into_iter().zip(theirs).map(|(n, t)| row(name, soup, n, t)).collect::<Vec<_>>()
    };
    let small = of_bunny([Some(7370), Some(59_277), Some(471_976)], "Bunny, remeshed", &thousand);
    triangles(
        &[
            small,
            vec![
                row("Teapot", &teapot, 32, Some(17_660)),
                row("Bunny, remeshed (theirs: Max, 20,196)", &ten_thousand, 32, Some(143_033)),
                row("Dragon (theirs: Armadillo, 345,944)", &dragon, 32, Some(2_698_200)),
            ],
            of_bunny([None; 3], "Bunny", &bunny),
            of_bunny([None; 3], "Knot", &knot),
        ]
        .concat(),
    );
    points(
        &[
            of_bunny([Some(444), Some(3462), Some(27_852)], "Bunny, remeshed", &thousand),
            vec![
                row("Bunny", &bunny, 32, Some(30_016)),
                row("Teapot", &teapot, 32, Some(1115)),
                row("Bunny, remeshed (theirs: Max, 10,227 points)", &ten_thousand, 32, Some(8777)),
                row("Dragon (theirs: Armadillo, 172,974 points)", &dragon, 32, Some(150_593)),
            ],
        ]
        .concat(),
    );
    zero(&of_bunny([None; 3], "Bunny", &bunny));
    zero(&of_bunny([None; 3], "Bunny, remeshed and closed", &thousand));
}

impl Clone for Row {
    fn clone(&self) -> Row {
        Row { soup: self.soup.clone(), ..*self }
    }
}

impl Row {
    fn lattice(&self) -> Lattice {
        Lattice::with_counts(self.soup.bounds(), [self.resolution; 3]).expect("the model has a size")
    }

    fn exact(&self) -> Voxels {
        voxels(
            &WindingField::new(self.soup.clone(), Default::default()),
            &self.lattice(),
            VoxelMethod::Lattice,
        )
    }

    fn theirs(&self) -> String {
        self.theirs.map_or("–".into(), with_commas)
    }
}

fn voxels(field: &WindingField, lattice: &Lattice, method: VoxelMethod) -> Voxels {
    voxelize(field, lattice, &VoxelConfig { method, threshold: 0.5 }, &Silent).expect("the voxels fit")
}

/// Voxels that are wrong, and how many of those inside they are.
fn wrong(exact: &Voxels, found: &Voxels) -> String {
    let change = difference(exact, found).expect("they are of one lattice");
    let share = 100.0 * change.count() as f64 / exact.count().max(1) as f64;
    format!("{} − {} + ({share:.2} %)", with_commas(change.lost.len()), with_commas(change.gained.len()))
}

fn rays(rows: &[Row]) {
    println!(
        "### Ray casting\n\nTheirs casts a ray for each voxel. Wrong: inside that was missed −, outside that was taken +.\n"
    );
    println!("| mesh | triangles | n | theirs | rays | wrong | vote of 3 | wrong | exact | inside |");
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    for row in rows {
        let lattice = row.lattice();
        let exact = row.exact();
        let by = |majority| {
            let stabbing = Stabbing { count: StabCount::Parity, majority };
            median(|| voxelize_by_rays(&row.soup, &lattice, stabbing, 0.5, &Silent).expect("the voxels fit"))
        };
        let ([one, three], [a, b]) = {
            let ((one, a), (three, b)) = (by(false), by(true));
            ([one, three], [a, b])
        };
        let (time, _) = median(|| row.exact());
        println!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.name,
            with_commas(row.soup.len()),
            row.resolution,
            row.theirs(),
            milliseconds(one),
            wrong(&exact, &a),
            milliseconds(three),
            wrong(&exact, &b),
            milliseconds(time),
            with_commas(exact.count())
        );
    }
}

fn triangles(rows: &[Row]) {
    println!(
        "\n### Winding numbers of triangles\n\nTheirs sums all solid angles. Fast: the tree of Barill et al. 2018, order 2, β = 2.\n"
    );
    println!("| mesh | triangles | n | theirs | exact: build | query | fast: build | query | wrong |");
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    for row in rows {
        let lattice = row.lattice();
        let new = || WindingField::new(row.soup.clone(), Default::default());
        let (build, field) = median(new);
        let (query, exact) = median(|| voxels(&field, &lattice, VoxelMethod::Lattice));
        let fast = VoxelMethod::Fast { order: Order::Two, beta: 2.0 };
        let one = Lattice { counts: [1; 3], ..lattice };
        // Its tree is built by the first question.
        let (with_tree, _) = median(|| voxels(&new(), &one, fast));
        voxels(&field, &one, fast);
        let (fast_query, found) = median(|| voxels(&field, &lattice, fast));
        println!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.name,
            with_commas(row.soup.len()),
            row.resolution,
            row.theirs(),
            milliseconds(build),
            milliseconds(query),
            milliseconds(with_tree - build),
            milliseconds(fast_query),
            wrong(&exact, &found)
        );
    }
}

fn points(rows: &[Row]) {
    println!(
        "\n### Winding numbers of points\n\nThe vertices, as theirs; wrong beside the exact field of the triangles. Theirs gives all points one area.\n"
    );
    println!(
        "| mesh | points | n | theirs | build | query | wrong | all areas equal: wrong | barycentres: wrong |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    for row in rows {
        let (lattice, exact) = (row.lattice(), row.exact());
        let cloud = Arc::new(row.soup.vertex_cloud().0);
        let (build, field) = median(|| WindingField::new(cloud.clone(), Default::default()));
        let of = |field: &WindingField| voxels(field, &lattice, VoxelMethod::Lattice);
        let (query, found) = median(|| of(&field));
        let others = [with_one_area(&cloud), row.soup.barycentre_cloud().0];
        let [equal, barycentres] = others.map(|c| of(&WindingField::new(c, Default::default())));
        println!(
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.name,
            with_commas(cloud.len()),
            row.resolution,
            row.theirs(),
            milliseconds(build),
            milliseconds(query),
            wrong(&exact, &found),
            wrong(&exact, &equal),
            wrong(&exact, &barycentres)
        );
    }
}

fn with_one_area(cloud: &OrientedCloud) -> OrientedCloud {
    let mean = cloud.areas().iter().sum::<f64>() / cloud.len() as f64;
    OrientedCloud::new(cloud.points().to_vec(), cloud.normals().to_vec(), vec![mean; cloud.len()])
        .expect("only areas differ")
}

/// Their Fig. 5: what a threshold of 0 takes for inside.
fn zero(rows: &[Row]) {
    println!("\n### Threshold 0: {}\n\nVoxels taken for inside, of all.\n", rows[0].name);
    println!("| n | exact ≥ 0.5 | exact ≥ 0 | exact > 10⁻⁹ | exact ≥ 0.01 | fast ≥ 0 | fast ≥ 0.01 |");
    println!("|--:|--:|--:|--:|--:|--:|--:|");
    for row in rows {
        let lattice = row.lattice();
        let field = WindingField::new(row.soup.clone(), Default::default());
        let fast = VoxelMethod::Fast { order: Order::Two, beta: 2.0 };
        let count = |method, threshold| {
            let config = VoxelConfig { method, threshold };
            let found = voxelize(&field, &lattice, &config, &Silent).expect("the voxels fit");
            format!("{:.2} %", 100.0 * found.count() as f64 / lattice.len() as f64)
        };
        let exact = [0.5, 0.0, 1e-9, 0.01].map(|t| count(VoxelMethod::Lattice, t));
        let fast = [0.0, 0.01].map(|t| count(fast, t));
        println!("| {} | {} | {} |", row.resolution, exact.join(" | "), fast.join(" | "));
    }
}

/// A closed surface of about so many triangles.
fn remeshed(soup: &Arc<TriangleSoup>, count: usize) -> TriangleSoup {
    let field = WindingField::new(soup.clone(), Default::default());
    let area: f64 = (0..soup.len()).map(|t| area_vector(soup.corners(t)).length()).sum();
    let longest = soup.bounds().size().max_element();
    // Two triangles to a face of a cell, and a little more.
    let resolution = longest * (count as f64 / (2.6 * area)).sqrt();
    let config = SurfaceConfig { resolution: Some(resolution as usize), ..SurfaceConfig::default() };
    extract(&field, &config, &Silent).expect("the bunny has a surface").into()
}

fn icosahedron() -> TriangleSoup {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let corners: Vec<Vec3> = (0..12)
        .map(|k| {
            let (a, b) = (if k & 1 == 0 { 1.0 } else { -1.0 }, if k & 2 == 0 { golden } else { -golden });
            [Vec3::new(0.0, a, b), Vec3::new(a, b, 0.0), Vec3::new(b, 0.0, a)][k / 4]
        })
        .collect();
    let mut triangles = Vec::new();
    for (a, b, c) in (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| (a, b, c))))
    {
        let [p, q, r] = [a, b, c].map(|k: usize| corners[k]);
        let are_near = |p: Vec3, q: Vec3| (p.distance(q) - 2.0).abs() < 1e-9;
        if are_near(p, q) && are_near(q, r) && are_near(r, p) {
            let is_outward = p.dot(q.cross(r)) > 0.0;
            triangles.push(if is_outward { [a, b, c] } else { [a, c, b] }.map(|k| k as u32));
        }
    }
    TriangleSoup::new(corners, triangles).expect("the indices are those of the corners")
}

/// A sphere of meridians and parallels.
fn globe(meridians: u32, parallels: u32) -> TriangleSoup {
    let mut positions = vec![-Vec3::Z];
    for k in 1..parallels {
        let height = 0.5 * TAU * (f64::from(k) / f64::from(parallels) - 0.5);
        for m in 0..meridians {
            let angle = TAU * f64::from(m) / f64::from(meridians);
            let radius = height.cos();
            positions.push(Vec3::new(radius * angle.cos(), radius * angle.sin(), height.sin()));
        }
    }
    positions.push(Vec3::Z);
    let last = positions.len() as u32 - 1;
    let at = |k: u32, m: u32| 1 + (k - 1) * meridians + m % meridians;
    let mut triangles = Vec::new();
    for m in 0..meridians {
        triangles.push([0, at(1, m + 1), at(1, m)]);
        triangles.push([last, at(parallels - 1, m), at(parallels - 1, m + 1)]);
        for k in 1..parallels - 1 {
            let [a, b, c, d] = [at(k, m), at(k, m + 1), at(k + 1, m + 1), at(k + 1, m)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleSoup::new(positions, triangles).expect("the indices are those of the positions")
}
