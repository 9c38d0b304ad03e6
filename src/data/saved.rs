//! Arrays to bytes and back, for fields that are saved: little endian, each array after its length. What is read may be any bytes:
//! no length makes a reader take more memory than the bytes that are left could fill.
use super::OutOfMemory;
use crate::math::Vec3;

/// Saved bytes break their format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SavedError {
    #[error("{what} end early: {needed} bytes are needed, {left} are left")]
    Truncated { what: &'static str, needed: u64, left: usize },
    #[error("{0}")]
    Inconsistent(&'static str),
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}

/// Numbers of a fixed size in bytes.
pub(crate) trait Number: Copy {
    type Bytes: AsRef<[u8]> + for<'a> TryFrom<&'a [u8]>;
    const SIZE: usize = size_of::<Self::Bytes>();
    fn to_bytes(self) -> Self::Bytes;
    fn from_bytes(bytes: Self::Bytes) -> Self;
}

macro_rules! number {
    ($($type:ty),*) => {$(
        impl Number for $type {
            type Bytes = [u8; size_of::<$type>()];
            fn to_bytes(self) -> Self::Bytes {
                self.to_le_bytes()
            }
            fn from_bytes(bytes: Self::Bytes) -> $type {
                <$type>::from_le_bytes(bytes)
            }
        }
    )*};
}
number!(u8, i8, u32, u64, f32, f64);

/// Bytes that grow by arrays.
#[derive(Default)]
pub(crate) struct Saver {
    pub bytes: Vec<u8>,
}

impl Saver {
    pub fn number<T: Number>(&mut self, value: T) {
        self.bytes.extend_from_slice(value.to_bytes().as_ref());
    }

    /// Groups of numbers after their count.
    pub fn groups<T: Number, const N: usize>(&mut self, groups: &[[T; N]]) {
        self.number(groups.len() as u64);
        self.bytes.reserve(groups.len() * N * T::SIZE);
        for value in groups.as_flattened() {
            self.bytes.extend_from_slice(value.to_bytes().as_ref());
        }
    }

    pub fn numbers<T: Number>(&mut self, values: &[T]) {
        self.groups(values.as_chunks::<1>().0);
    }

    pub fn vectors(&mut self, vectors: &[Vec3]) {
        self.number(vectors.len() as u64);
        self.bytes.reserve(vectors.len() * 24);
        for v in vectors {
            let [x, y, z] = v.to_array().map(f64::to_le_bytes);
            self.bytes.extend_from_slice([x, y, z].as_flattened());
        }
    }
}

/// What is left of saved bytes.
pub(crate) struct Loader<'a> {
    pub rest: &'a [u8],
}

impl<'a> Loader<'a> {
    fn take(&mut self, what: &'static str, count: u64, size: usize) -> Result<&'a [u8], SavedError> {
        let needed = count.saturating_mul(size as u64);
        let left = self.rest.len();
        if needed > left as u64 {
            return Err(SavedError::Truncated { what, needed, left });
        }
        let (taken, rest) = self.rest.split_at(needed as usize);
        self.rest = rest;
        Ok(taken)
    }

    pub fn number<T: Number>(&mut self, what: &'static str) -> Result<T, SavedError> {
        Ok(value_of(self.take(what, 1, T::SIZE)?))
    }

    /// A number of things, each of at least a byte, that is not more than the bytes that are left.
    pub fn count(&mut self, what: &'static str) -> Result<usize, SavedError> {
        let (needed, left) = (self.number::<u64>(what)?, self.rest.len());
        if needed > left as u64 {
            return Err(SavedError::Truncated { what, needed, left });
        }
        Ok(needed as usize)
    }

    /// Groups of `N` numbers, each made by `make`.
    fn collect<R>(
        &mut self,
        what: &'static str,
        size: usize,
        make: impl Fn(&[u8]) -> R,
    ) -> Result<Vec<R>, SavedError> {
        let count = self.number(what)?;
        let bytes = self.take(what, count, size)?;
        let mut all = Vec::new();
        let needed = (count as usize).saturating_mul(size_of::<R>());
        all.try_reserve_exact(count as usize).map_err(|_| OutOfMemory { bytes: needed })?;
        all.extend(bytes.chunks_exact(size).map(make));
        Ok(all)
    }

    pub fn groups<T: Number, const N: usize>(
        &mut self,
        what: &'static str,
    ) -> Result<Vec<[T; N]>, SavedError> {
        self.collect(what, N * T::SIZE, |group| {
            std::array::from_fn(|k| value_of(&group[k * T::SIZE..(k + 1) * T::SIZE]))
        })
    }

    pub fn numbers<T: Number>(&mut self, what: &'static str) -> Result<Vec<T>, SavedError> {
        self.collect(what, T::SIZE, value_of)
    }

    pub fn vectors(&mut self, what: &'static str) -> Result<Vec<Vec3>, SavedError> {
        self.collect(what, 24, |group| {
            Vec3::from_array(std::array::from_fn(|k| value_of(&group[8 * k..8 * k + 8])))
        })
    }
}

/// The number that as many bytes as it has are.
fn value_of<T: Number>(bytes: &[u8]) -> T {
    match T::Bytes::try_from(bytes) {
        Ok(bytes) => T::from_bytes(bytes),
        Err(_) => unreachable!("a number was given as many bytes as it has"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_come_back_and_lengths_are_held_against_the_bytes() {
        let mut saver = Saver::default();
        saver.number(7u64);
        saver.groups(&[[1u32, 2, 3], [4, 5, u32::MAX]]);
        saver.numbers(&[0.5f32, f32::NAN]);
        saver.vectors(&[Vec3::new(-0.0, 1e300, f64::MIN_POSITIVE)]);
        let mut loader = Loader { rest: &saver.bytes };
        assert_eq!(loader.number::<u64>("sevens"), Ok(7));
        assert_eq!(loader.groups::<u32, 3>("triples"), Ok(vec![[1, 2, 3], [4, 5, u32::MAX]]));
        let floats: Vec<f32> = loader.numbers("floats").unwrap();
        assert!(floats[0] == 0.5 && floats[1].is_nan());
        assert_eq!(loader.vectors("vectors"), Ok(vec![Vec3::new(-0.0, 1e300, f64::MIN_POSITIVE)]));
        assert!(loader.rest.is_empty());
        for end in 0..saver.bytes.len() {
            let mut loader = Loader { rest: &saver.bytes[..end] };
            let all = loader
                .number::<u64>("")
                .and_then(|_| loader.groups::<u32, 3>(""))
                .and_then(|_| loader.numbers::<f32>(""))
                .and_then(|_| loader.vectors(""));
            assert!(matches!(all, Err(SavedError::Truncated { .. })), "{end}");
        }
        let endless = u64::MAX.to_le_bytes();
        let mut loader = Loader { rest: &endless };
        let error = SavedError::Truncated { what: "vectors", needed: u64::MAX, left: 0 };
        assert_eq!(loader.vectors("vectors"), Err(error));
    }
}
