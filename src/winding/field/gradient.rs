use super::{Accuracy, Engine, FieldError, WindingField};
use crate::data::{Monitor, fill_in_blocks, zeroed};
use crate::math::Vec3;
use crate::treecode::Scratch;

impl WindingField {
    /// The gradient of the winding number at `q`, per millimetre: it points to where w grows, inward. NaN where `q` is not
    /// finite.
    ///
    /// It is summed as w is with the same `accuracy`, from the boundary edges of a soup where w takes them exactly, and so 0
    /// for a closed one; [`crate::winding::winding_gradient`] says what it is on the surface. Between clusters it is less
    /// accurate than w, by their number of terms over the distance.
    pub fn gradient(&self, q: Vec3, accuracy: Accuracy) -> Vec3 {
        self.gradient_with(q, accuracy, &mut Scratch::default())
    }

    /// Gradients of the winding number at `points`, in their order.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the gradients do not fit in memory.
    pub fn gradients(
        &self,
        points: &[Vec3],
        accuracy: Accuracy,
        monitor: &dyn Monitor,
    ) -> Result<Vec<Vec3>, FieldError> {
        let mut gradients = zeroed(points.len())?;
        if let (Accuracy::Explicit { .. }, Engine::Soup(_)) = (accuracy, &self.engine) {
            self.of_paper();
        }
        let value = |i: usize, scratch: &mut Scratch| self.gradient_with(points[i], accuracy, scratch);
        fill_in_blocks(&mut gradients, value, "gradients", monitor)?;
        Ok(gradients)
    }

    fn gradient_with(&self, q: Vec3, accuracy: Accuracy, scratch: &mut Scratch) -> Vec3 {
        let expansion = self.expansion_for(accuracy);
        match (&self.engine, expansion, accuracy) {
            (Engine::Soup(_), Some((order, beta)), Accuracy::Explicit { .. }) => {
                self.of_paper().gradient(q, order, beta, scratch)
            }
            (Engine::Soup(soup), _, _) => soup.gradient(q, soup.fraction_by(expansion), scratch),
            (Engine::Cloud(tree), Some((order, beta)), _) => tree.gradient(q, order, beta, scratch),
            (Engine::Cloud(tree), None, _) => tree.direct_gradient(q),
        }
    }
}
