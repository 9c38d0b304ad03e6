use super::slopes::Slopes;
use crate::data::Shape;

/// Where within its span a layer is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleAt {
    Bottom,
    #[default]
    Middle,
    Top,
}

impl SampleAt {
    fn span(self, bottom: f64, top: f64) -> Span {
        let sample = match self {
            SampleAt::Bottom => bottom,
            SampleAt::Middle => 0.5 * (bottom + top),
            SampleAt::Top => top,
        };
        Span { bottom, top, sample }
    }
}

/// Which layers are wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerPlan {
    /// Millimetres.
    pub layer_height: f64,
    /// As the others if not given.
    pub first_layer_height: Option<f64>,
    pub sample_at: SampleAt,
    /// Layers as thick as the shape's slopes allow, in place of `layer_height`; horizontal faces become boundaries of layers, unless
    /// that took one thinner than `least` or thicker than slopes beside them allow.
    pub adaptive: Option<AdaptiveHeights>,
    /// Exact z of each sample, in place of a stack; such layers have no thickness.
    pub heights: Option<Vec<f64>>,
}

impl Default for LayerPlan {
    fn default() -> Self {
        LayerPlan {
            layer_height: 0.2,
            first_layer_height: None,
            sample_at: SampleAt::Middle,
            adaptive: None,
            heights: None,
        }
    }
}

/// Layers thick at steep walls and thin at gentle slopes. All in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdaptiveHeights {
    /// No layer is thinner, whatever the slopes.
    pub least: f64,
    /// No layer is thicker.
    pub most: f64,
    /// How far the steps of layers may stand off the surface, measured along its normal: a layer of height h passes
    /// faces with h |n_z| of at most this, unless `least` is in the way.
    pub deviation: f64,
}

/// Why there is no such stack of layers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    #[error("a {what} of {value} is not possible: it must be finite and above 0")]
    BadHeight { what: &'static str, value: f64 },
    #[error("a least layer height of {least} is above the most, {most}")]
    LeastAboveMost { least: f64, most: f64 },
    #[error("a {what} of {value} is above the shape, which is {height} high: no layer would be of it")]
    AboveShape { what: &'static str, value: f64, height: f64 },
    #[error("height {index} is {value}: it must be a finite number")]
    BadSample { index: usize, value: f64 },
    #[error("{0} layers are too many: at most {max} are made", max = LayerPlan::MAX_LAYERS)]
    TooMany(f64),
}

/// A layer's extent, and where it is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    pub bottom: f64,
    pub top: f64,
    pub sample: f64,
}

/// Of a height, what rounding may make of it: n layers of it are not to become n + 1.
pub(super) const SLACK: f64 = 1e-6;

impl LayerPlan {
    pub const MAX_LAYERS: usize = 1_000_000;

    /// A single layer at `z`.
    pub fn at(z: f64) -> LayerPlan {
        LayerPlan { heights: Some(vec![z]), ..LayerPlan::default() }
    }

    /// The spans of a shape, bottom to top, each beginning where the one before ends; the last one reaches the shape's top, or
    /// above it.
    ///
    /// # Errors
    /// If and only if a height is not finite or not positive, one that every layer has (the first's, `layer_height`, `least`) is above
    /// the height of the shape, `least` is above `most`, or the layers are more than [`Self::MAX_LAYERS`].
    #[inline(never)]
    pub fn spans_of(&self, shape: &Shape) -> Result<Vec<Span>, PlanError> {
        if let Some(heights) = &self.heights {
            if let Some(index) = heights.iter().position(|z| !z.is_finite()) {
                return Err(PlanError::BadSample { index, value: heights[index] });
            }
            return Ok(heights.iter().map(|&z| Span { bottom: z, top: z, sample: z }).collect());
        }
        let bounds = shape.bounds();
        self.check(bounds.size().z, shape.is_empty())?;
        let (low, high) = (bounds.min.z, bounds.max.z);
        if shape.is_empty() {
            return Ok(Vec::new());
        }
        match &self.adaptive {
            None => self.uniform(low, high),
            Some(adaptive) => {
                let slopes = Slopes::of(shape, adaptive);
                let tops = slopes.tops(low, high, self.first_layer_height, adaptive)?;
                let bottoms = std::iter::once(low).chain(tops.iter().copied());
                Ok(bottoms.zip(&tops).map(|(bottom, top)| self.sample_at.span(bottom, *top)).collect())
            }
        }
    }

    fn check(&self, height: f64, is_empty: bool) -> Result<(), PlanError> {
        let first = self.first_layer_height.map(|first| ("first layer height", first));
        let others = match &self.adaptive {
            None => ("layer height", self.layer_height),
            Some(adaptive) => ("least layer height", adaptive.least),
        };
        let positive = |what, value: f64| {
            let is_possible = value.is_finite() && value > 0.0;
            if is_possible { Ok(()) } else { Err(PlanError::BadHeight { what, value }) }
        };
        for (what, value) in std::iter::once(others).chain(first) {
            positive(what, value)?;
            if !is_empty && value > height * (1.0 + SLACK) {
                return Err(PlanError::AboveShape { what, value, height });
            }
        }
        let Some(AdaptiveHeights { least, most, deviation }) = self.adaptive else { return Ok(()) };
        positive("greatest layer height", most)?;
        positive("deviation", deviation)?;
        if least > most { Err(PlanError::LeastAboveMost { least, most }) } else { Ok(()) }
    }

    /// Layers of one height but for the first.
    fn uniform(&self, low: f64, high: f64) -> Result<Vec<Span>, PlanError> {
        let first = self.first_layer_height.unwrap_or(self.layer_height);
        let above_first = ((high - low - first) / self.layer_height - SLACK).ceil().max(0.0);
        if above_first + 1.0 > LayerPlan::MAX_LAYERS as f64 {
            return Err(PlanError::TooMany(above_first + 1.0));
        }
        let top_of = |layer: usize| low + first + layer as f64 * self.layer_height;
        let bottom_of = |layer: usize| if layer == 0 { low } else { top_of(layer - 1) };
        let span = |layer: usize| self.sample_at.span(bottom_of(layer), top_of(layer));
        Ok((0..=above_first as usize).map(span).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::TriangleSoup;
    use crate::math::Vec3;

    /// A triangle from `low` to `high`: what lies between does not matter here.
    fn spans(plan: &LayerPlan, low: f64, high: f64) -> Result<Vec<Span>, PlanError> {
        let corners = vec![Vec3::new(0.0, 0.0, low), Vec3::new(1.0, 0.0, low), Vec3::new(0.0, 0.0, high)];
        plan.spans_of(&TriangleSoup::new(corners, vec![[0, 1, 2]]).unwrap().into())
    }

    #[test]
    fn layers_cover_the_height_without_gaps() {
        let plan = LayerPlan { layer_height: 0.2, first_layer_height: Some(0.3), ..LayerPlan::default() };
        let found = spans(&plan, -1.0, 1.0).unwrap();
        assert_eq!(found.len(), 10);
        assert!((found[0].top + 0.7).abs() < 1e-12 && (found[0].sample + 0.85).abs() < 1e-12);
        assert!(found.windows(2).all(|w| w[0].top == w[1].bottom));
        assert!(found[9].top >= 1.0 && found[9].bottom < 1.0);
        assert_eq!(spans(&LayerPlan { layer_height: 0.5, ..plan.clone() }, 0.0, 2.3).unwrap().len(), 5);
        let tenths = LayerPlan { layer_height: 0.1, first_layer_height: None, ..plan };
        assert_eq!(spans(&tenths, 0.0, 1.0).unwrap().len(), 10);
    }

    #[test]
    fn impossible_heights_are_named() {
        let plan = |h: f64| LayerPlan { layer_height: h, ..LayerPlan::default() };
        let error = |plan: &LayerPlan| spans(plan, 0.0, 1.0).unwrap_err();
        for value in [0.0, -0.2, f64::INFINITY] {
            assert_eq!(error(&plan(value)), PlanError::BadHeight { what: "layer height", value });
        }
        assert!(matches!(error(&plan(f64::NAN)), PlanError::BadHeight { .. }));
        assert!(matches!(error(&plan(1e-9)), PlanError::TooMany(_)));
        assert!(matches!(error(&LayerPlan::at(f64::NAN)), PlanError::BadSample { index: 0, .. }));
    }

    #[test]
    fn heights_above_the_shape_are_refused_and_its_own_is_one_layer() {
        let plan = |h: f64| LayerPlan { layer_height: h, ..LayerPlan::default() };
        let above = PlanError::AboveShape { what: "layer height", value: 1.5, height: 1.0 };
        assert_eq!(spans(&plan(1.5), 0.0, 1.0), Err(above));
        assert_eq!(spans(&plan(0.3), 7.1, 7.4).unwrap().len(), 1, "rounding makes no difference");
        let first = LayerPlan { first_layer_height: Some(2.0), ..plan(0.5) };
        assert!(matches!(
            spans(&first, 0.0, 1.0),
            Err(PlanError::AboveShape { what: "first layer height", .. })
        ));
        // There is nothing to be above.
        assert_eq!(plan(1.5).spans_of(&TriangleSoup::default().into()), Ok(vec![]));
    }

    #[test]
    fn impossible_adaptive_heights_are_named() {
        let error = |least: f64, most: f64, deviation: f64| {
            let adaptive = Some(AdaptiveHeights { least, most, deviation });
            spans(&LayerPlan { adaptive, ..LayerPlan::default() }, 0.0, 1.0).unwrap_err()
        };
        assert_eq!(error(0.3, 0.2, 0.1), PlanError::LeastAboveMost { least: 0.3, most: 0.2 });
        let bad = |what, value| PlanError::BadHeight { what, value };
        assert_eq!(error(0.0, 0.2, 0.1), bad("least layer height", 0.0));
        assert_eq!(error(0.1, f64::INFINITY, 0.1), bad("greatest layer height", f64::INFINITY));
        assert_eq!(error(0.1, 0.2, -1.0), bad("deviation", -1.0));
        for [least, most, deviation] in [[f64::NAN, 0.2, 0.1], [0.1, f64::NAN, 0.1], [0.1, 0.2, f64::NAN]] {
            assert!(matches!(error(least, most, deviation), PlanError::BadHeight { .. }));
        }
        assert!(matches!(error(2.0, 3.0, 0.1), PlanError::AboveShape { .. }));
        assert!(matches!(error(1e-8, 1e-7, 1e-9), PlanError::TooMany(_)));
    }
}
