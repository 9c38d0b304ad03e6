use super::clouds::Random;
use super::gcno::gcno;
use fast_winding::data::{PointCloud, Silent};
use fast_winding::math::Vec3;
use fast_winding::orient::{Bounded, ConsistencyConfig, OrientMethod, StochasticConfig, Widths, orient};

/// Gives normals.
pub type Method = Box<dyn Fn(&PointCloud) -> Vec<Vec3>>;

/// Most points that the globally consistent methods take.
const MOST: usize = 3000;

/// All methods for so many points, by name.
pub fn methods(count: usize) -> Vec<(String, Method)> {
    let by = |method: OrientMethod| -> Method {
        Box::new(move |cloud| {
            let (oriented, _) = orient(cloud, &method, &Silent).expect("there are points");
            oriented.normals().to_vec()
        })
    };
    let consistency = |bounded: Bounded, widths: Option<Widths>| {
        by(OrientMethod::Consistency(ConsistencyConfig { bounded, widths, ..Default::default() }))
    };
    let mut methods = vec![("propagation".into(), by(OrientMethod::Propagation))];
    for (name, bounded) in [
        ("{SD, A, G}", Bounded::Nothing),
        ("{SD, A, G_B}", Bounded::Gradients),
        ("{LM, A_B, G_B}", Bounded::Everything),
    ] {
        for (k, widths) in Widths::ALL.into_iter().enumerate().take(2) {
            methods.push((format!("{name} l{k}"), consistency(bounded, Some(widths))));
        }
        methods.push((format!("{name} chosen"), consistency(bounded, None)));
    }
    if count <= MOST {
        methods.push(("sGCNO".into(), by(OrientMethod::Stochastic(StochasticConfig::default()))));
        let draw = |cloud: &PointCloud| {
            let mut random = Random(11);
            gcno(cloud.points(), || random.unit())
        };
        methods.push(("GCNO".into(), Box::new(draw)));
    }
    methods
}
