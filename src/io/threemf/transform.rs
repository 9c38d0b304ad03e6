use crate::io::text::number;
use crate::math::{Mat3, Vec3};

/// An affine map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform {
    linear: Mat3,
    translation: Vec3,
}

impl Transform {
    pub fn scaling(factor: f64) -> Transform {
        Transform { linear: Mat3::from_diagonal(Vec3::splat(factor)), translation: Vec3::ZERO }
    }

    /// Reads twelve numbers, the rows of a matrix that acts on row vectors: its last row is the translation.
    pub fn parse(text: &str) -> Option<Transform> {
        let mut words = text.split_ascii_whitespace();
        let mut row = || {
            let mut next = || number(words.next()?.as_bytes());
            Some(Vec3::new(next()?, next()?, next()?))
        };
        // Rows for row vectors are columns for column vectors.
        let transform = Transform { linear: Mat3::from_cols(row()?, row()?, row()?), translation: row()? };
        words.next().is_none().then_some(transform)
    }

    pub fn apply(&self, p: Vec3) -> Vec3 {
        self.linear * p + self.translation
    }

    /// The map that first applies `inner`, then this.
    pub fn after(&self, inner: &Transform) -> Transform {
        Transform { linear: self.linear * inner.linear, translation: self.apply(inner.translation) }
    }

    /// Whether right hands become left hands.
    pub fn mirrors(&self) -> bool {
        self.linear.determinant() < 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_act_on_row_vectors() {
        let quarter_turn = Transform::parse("0 1 0  -1 0 0  0 0 1  10 20 30").unwrap();
        assert_eq!(quarter_turn.apply(Vec3::new(1.0, 2.0, 3.0)), Vec3::new(8.0, 21.0, 33.0));
        let both = Transform::scaling(2.0).after(&quarter_turn);
        assert_eq!(both.apply(Vec3::new(1.0, 2.0, 3.0)), Vec3::new(16.0, 42.0, 66.0));
        assert!(!both.mirrors() && Transform::scaling(-1.0).mirrors());
    }

    #[test]
    fn other_than_twelve_numbers_are_refused() {
        for text in ["", "1 0 0 0 1 0 0 0 1 0 0", "1 0 0 0 1 0 0 0 1 0 0 0 0", "1 0 0 0 1 0 0 0 1 0 0 x"] {
            assert_eq!(Transform::parse(text), None, "{text}");
        }
    }
}
