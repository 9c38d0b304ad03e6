//! Voxels that thresholding at 1/2 puts on the wrong side: the statistics that section 4 of the paper gives for Thingi10K.
use crate::measured::{affordable, lattice, median, points, print_table, short};
use crate::models::Model;
use fast_winding::data::{Shape, Silent};
use fast_winding::math::Vec3;
use fast_winding::winding::{Accuracy, ExactHierarchy, FieldConfig, RayParity, Rays, WindingField};

const SIDE: usize = 100;
const METHODS: [&str; 4] = ["paper's: order 2, β 2", "ray parity", "parity, best of 3 rays", "fast-winding"];
const BEST_OF: Rays = Rays::Majority { count: 3, seed: 1 };
/// The oracle is asked wherever the paper's evaluator is within so much of the threshold: three times the largest error of
/// order 2 at β 2. Elsewhere the side it is on is the right one.
const IN_DOUBT: f64 = 0.03;
/// Seconds of the oracle for one model, in doubt and for the errors; beyond, it is asked at every k-th voxel.
const DOUBT_BUDGET: f64 = 10.0;
const ERROR_BUDGET: f64 = 0.5;
/// Where w is 1/2 on a whole region, rounding decides: those voxels are left out.
const TIE: f64 = 1e-9;

struct Row {
    name: String,
    triangles: usize,
    /// Share of the voxels, for each of the methods.
    wrong: [f64; 4],
    /// Whether the voxels in doubt were too many to ask the oracle about each.
    is_estimate: bool,
    /// Root mean square error of w: the paper's evaluator, and ours by default.
    rms: [f64; 2],
}

fn measure(model: &Model) -> Row {
    let done = "nothing cancels";
    let shape = Shape::from(model.soup.clone());
    let field = WindingField::new(shape.clone(), FieldConfig::default());
    let hierarchy = ExactHierarchy::new(&model.soup);
    let lattice = lattice(&model.soup, SIDE);
    let points = points(&lattice);
    let paper = field.evaluate_lattice(&lattice, Accuracy::of_paper(&shape), &Silent).expect(done).values;
    let parity = |rays: Rays| RayParity::new(&model.soup, rays).contains_all(&points, &Silent).expect(done);
    let answers = [
        paper.iter().map(|w| *w >= 0.5).collect(),
        parity(Rays::Axis),
        parity(BEST_OF),
        field.contains(&points, &Silent).expect(done),
    ];
    let seconds = |some: &[Vec3]| median(|| hierarchy.evaluate(some, &Silent)).0;

    let certain = |i: usize| (paper[i] - 0.5).abs() >= IN_DOUBT;
    let in_doubt: Vec<usize> = (0..points.len()).filter(|&i| !certain(i)).collect();
    let doubtful: Vec<Vec3> = in_doubt.iter().map(|&i| points[i]).collect();
    let affordable_count = affordable(&doubtful, DOUBT_BUDGET, seconds).len();
    let step = in_doubt.len().div_ceil(affordable_count.max(1)).max(1);
    let asked: Vec<usize> = in_doubt.iter().step_by(step).copied().collect();
    let exact =
        hierarchy.evaluate(&asked.iter().map(|&i| points[i]).collect::<Vec<_>>(), &Silent).expect(done);
    let weight = in_doubt.len() as f64 / asked.len().max(1) as f64;
    let wrong = answers.each_ref().map(|answers: &Vec<bool>| {
        let elsewhere = (0..points.len()).filter(|&i| certain(i) && answers[i] != (paper[i] > 0.5)).count();
        let there =
            asked.iter().zip(&exact).filter(|(i, w)| (*w - 0.5).abs() > TIE && answers[**i] != (**w > 0.5));
        (elsewhere as f64 + weight * there.count() as f64) / points.len() as f64
    });

    let sample = affordable(&points, ERROR_BUDGET, seconds);
    let exact = hierarchy.evaluate(&sample, &Silent).expect(done);
    let rms = [Accuracy::of_paper(&shape), Accuracy::default()].map(|accuracy| {
        let values = field.evaluate(&sample, accuracy, &Silent).expect(done);
        root_mean_square(values.iter().zip(&exact).map(|(a, b)| a - b))
    });
    Row { name: model.name.clone(), triangles: model.soup.len(), wrong, is_estimate: step > 1, rms }
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), x| (sum + x * x, count + 1));
    (sum / f64::from(count.max(1))).sqrt()
}

pub fn report(models: impl Iterator<Item = Model>) {
    let rows: Vec<Row> = models.map(|model| measure(&model)).collect();
    println!("### Misclassified of {SIDE}³ voxels, threshold 1/2\n");
    let voxels = (SIDE * SIDE * SIDE) as f64;
    let header: Vec<&str> = ["model", "triangles"]
        .into_iter()
        .chain(METHODS)
        .chain(["RMS error of w: paper's", "fast-winding"])
        .collect();
    print_table(
        &header,
        rows.iter().map(|row| {
            [row.name.clone(), row.triangles.to_string()]
                .into_iter()
                .chain(
                    row.wrong.map(|share| {
                        format!("{}{:.0}", if row.is_estimate { "≈ " } else { "" }, share * voxels)
                    }),
                )
                .chain(row.rms.map(short))
                .collect()
        }),
    );
    print_table(
        &["method", "models with none", "median", "mean share", "RMS share", "mean RMS error of w"],
        (0..METHODS.len()).map(|k| summary(&rows, k)).chain([vec![
            "paper's, as reported for Thingi10K".into(),
            "over 50 %".into(),
            "0".into(),
            "0.0363 %".into(),
            "not given".into(),
            "8e-3".into(),
        ]]),
    );
    println!(
        "The last row is from Barill et al. 2018, section 4: other models, so only its form compares.\n"
    );
}

fn summary(rows: &[Row], method: usize) -> Vec<String> {
    let mut shares: Vec<f64> = rows.iter().map(|row| row.wrong[method]).collect();
    shares.sort_by(f64::total_cmp);
    let count = shares.len() as f64;
    let none = shares.iter().filter(|s| **s == 0.0).count() as f64 / count;
    let percent = |share: f64| format!("{} %", short(100.0 * share));
    let mean_rms = |k: usize| short(rows.iter().map(|row| row.rms[k]).sum::<f64>() / count);
    vec![
        METHODS[method].into(),
        format!("{:.0} %", 100.0 * none),
        percent(shares[shares.len() / 2]),
        percent(shares.iter().sum::<f64>() / count),
        percent(root_mean_square(shares.iter().copied())),
        match method {
            0 => mean_rms(0),
            3 => mean_rms(1),
            _ => "–".into(),
        },
    ]
}
