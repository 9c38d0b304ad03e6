/// Where within its span a layer is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleAt {
    Bottom,
    #[default]
    Middle,
    Top,
}

/// Which layers are wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerPlan {
    /// Millimetres.
    pub layer_height: f64,
    /// As `layer_height` if not given.
    pub first_layer_height: Option<f64>,
    pub sample_at: SampleAt,
    /// Exact z of each sample, in place of a stack; such layers have no thickness.
    pub heights: Option<Vec<f64>>,
}

impl Default for LayerPlan {
    fn default() -> Self {
        LayerPlan { layer_height: 0.2, first_layer_height: None, sample_at: SampleAt::Middle, heights: None }
    }
}

/// Why there is no such stack of layers.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    #[error("a {what} of {value} is not possible: it must be finite and above 0")]
    BadHeight { what: &'static str, value: f64 },
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

impl LayerPlan {
    pub const MAX_LAYERS: usize = 1_000_000;

    /// A single layer at `z`.
    pub fn at(z: f64) -> LayerPlan {
        LayerPlan { heights: Some(vec![z]), ..LayerPlan::default() }
    }

    /// The spans of a shape that reaches from `low` to `high`, bottom to top; the last one covers `high`.
    ///
    /// # Errors
    /// If and only if a height is not finite or not positive, or the layers are more than [`Self::MAX_LAYERS`].
    pub fn spans(&self, low: f64, high: f64) -> Result<Vec<Span>, PlanError> {
        if let Some(heights) = &self.heights {
            if let Some(index) = heights.iter().position(|z| !z.is_finite()) {
                return Err(PlanError::BadSample { index, value: heights[index] });
            }
            return Ok(heights.iter().map(|&z| Span { bottom: z, top: z, sample: z }).collect());
        }
        let first = self.first_layer_height.unwrap_or(self.layer_height);
        for (what, value) in [("layer height", self.layer_height), ("first layer height", first)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(PlanError::BadHeight { what, value });
            }
        }
        // The slack keeps a height of exactly n layers from getting n + 1 by rounding.
        let above_first = ((high - low - first) / self.layer_height - 1e-6).ceil().max(0.0);
        if above_first + 1.0 > LayerPlan::MAX_LAYERS as f64 {
            return Err(PlanError::TooMany(above_first + 1.0));
        }
        let top_of = |layer: usize| low + first + layer as f64 * self.layer_height;
        let span = |layer: usize| {
            let (bottom, top) = (if layer == 0 { low } else { top_of(layer - 1) }, top_of(layer));
            let sample = match self.sample_at {
                SampleAt::Bottom => bottom,
                SampleAt::Middle => 0.5 * (bottom + top),
                SampleAt::Top => top,
            };
            Span { bottom, top, sample }
        };
        Ok((0..=above_first as usize).map(span).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_cover_the_height_without_gaps() {
        let plan = LayerPlan { layer_height: 0.2, first_layer_height: Some(0.3), ..LayerPlan::default() };
        let spans = plan.spans(-1.0, 1.0).unwrap();
        assert_eq!(spans.len(), 10);
        assert!((spans[0].top + 0.7).abs() < 1e-12 && (spans[0].sample + 0.85).abs() < 1e-12);
        assert!(spans.windows(2).all(|w| w[0].top == w[1].bottom));
        assert!(spans[9].top >= 1.0 && spans[9].bottom < 1.0);
        assert_eq!(LayerPlan { layer_height: 0.5, ..plan.clone() }.spans(0.0, 2.3).unwrap().len(), 5);
        assert_eq!(
            LayerPlan { layer_height: 0.1, first_layer_height: None, ..plan }.spans(0.0, 1.0).unwrap().len(),
            10
        );
    }

    #[test]
    fn impossible_heights_are_named() {
        let plan = |h: f64| LayerPlan { layer_height: h, ..LayerPlan::default() };
        assert_eq!(plan(0.0).spans(0.0, 1.0), Err(PlanError::BadHeight { what: "layer height", value: 0.0 }));
        assert!(matches!(plan(1e-9).spans(0.0, 1.0), Err(PlanError::TooMany(_))));
        assert!(matches!(
            LayerPlan::at(f64::NAN).spans(0.0, 1.0),
            Err(PlanError::BadSample { index: 0, .. })
        ));
    }
}
