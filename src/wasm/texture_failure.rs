//! Errors of textures as JavaScript hears of them.
use super::failure::Failure;
use crate::charge::{ChargeError, LineError};
use crate::texture::{AtlasError, ProxyError, SeamError, SoupLinesError, TextureError};

impl From<TextureError> for Failure {
    fn from(error: TextureError) -> Failure {
        match error {
            TextureError::Proxy(proxy) => proxy.into(),
            TextureError::Atlas(atlas) => atlas.into(),
            TextureError::Lines(SoupLinesError::Charge(charge)) => charge.into(),
            TextureError::Lines(SoupLinesError::Line(line)) => line.into(),
            TextureError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<ProxyError> for Failure {
    fn from(error: ProxyError) -> Failure {
        match error {
            ProxyError::Surface(surface) => surface.into(),
            ProxyError::Field(field) => field.into(),
            ProxyError::NoTriangles => Failure::new("EmptyInput", &error),
            ProxyError::BadOffset(_) | ProxyError::TooFewSamples(_) => Failure::invalid(&error),
        }
    }
}

impl From<AtlasError> for Failure {
    fn from(error: AtlasError) -> Failure {
        match error {
            AtlasError::Cancelled(cancelled) => cancelled.into(),
            AtlasError::Seam(seam) => seam.into(),
            AtlasError::NoTriangles => Failure::new("EmptyInput", &error),
            AtlasError::DoesNotFit { charts, side, margin } => Failure::new("DoesNotFit", &error).with([
                ("charts", charts.into()),
                ("texels", side.into()),
                ("margin", margin.into()),
            ]),
            AtlasError::BadCone(_) | AtlasError::BadTexels(_) => Failure::invalid(&error),
        }
    }
}

impl From<SeamError> for Failure {
    fn from(error: SeamError) -> Failure {
        Failure::invalid(error)
    }
}

impl From<ChargeError> for Failure {
    fn from(error: ChargeError) -> Failure {
        match error {
            ChargeError::NoArea { .. } => Failure::new("EmptyInput", &error),
            ChargeError::BadNumber { .. } => Failure::invalid(&error),
            ChargeError::OutOfMemory(out_of_memory) => out_of_memory.into(),
            ChargeError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}

impl From<LineError> for Failure {
    fn from(error: LineError) -> Failure {
        match error {
            LineError::Cancelled(cancelled) => cancelled.into(),
            LineError::OutOfMemory(out_of_memory) => out_of_memory.into(),
            _ => Failure::invalid(&error),
        }
    }
}
