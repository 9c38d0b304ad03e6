//! Build and evaluation of the field on shapes of growing size: `cargo bench`.
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fast_winding::data::{Lattice, Shape, Silent};
use fast_winding::winding::{Accuracy, FieldConfig, WindingField};

#[path = "../common/mod.rs"]
mod common;

fn shapes() -> Vec<(String, Shape)> {
    let soups = [(100, 40), (400, 160)].map(|(nu, nv)| common::torus(1.0, 0.4, nu, nv));
    let named = |kind: &str, shape: Shape| (format!("{kind} {}", shape.len()), shape);
    soups
        .into_iter()
        .flat_map(|s| [named("cloud", common::barycentre_cloud(&s, 1).into()), named("soup", s.into())])
        .collect()
}

fn build(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("build");
    for (name, shape) in shapes() {
        group.throughput(Throughput::Elements(shape.len() as u64));
        group.bench_with_input(BenchmarkId::from_parameter(name), &shape, |b, shape| {
            b.iter(|| WindingField::new(shape.clone(), FieldConfig::default()));
        });
    }
}

fn evaluate(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("evaluate a lattice");
    group.sample_size(10);
    for (name, shape) in shapes() {
        let field = WindingField::new(shape.clone(), FieldConfig::default());
        let lattice = Lattice::with_resolution(field.bounds(), 50).expect("a torus has a size");
        group.throughput(Throughput::Elements(lattice.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| field.evaluate_lattice(&lattice, Accuracy::of_paper(&shape), &Silent));
        });
    }
}

criterion_group!(benches, build, evaluate);
criterion_main!(benches);
