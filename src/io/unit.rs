/// A unit of length, as 3MF names them; inside this crate everything is in millimetres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unit {
    Micron,
    #[default]
    Millimeter,
    Centimeter,
    Inch,
    Foot,
    Meter,
}

/// A name that is no [`Unit`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown unit '{0}': micron, millimeter, centimeter, inch, foot and meter are known")]
pub struct UnknownUnit(pub String);

impl Unit {
    /// Length of one unit in millimetres.
    pub fn millimetres(self) -> f64 {
        match self {
            Unit::Micron => 1e-3,
            Unit::Millimeter => 1.0,
            Unit::Centimeter => 10.0,
            Unit::Inch => 25.4,
            Unit::Foot => 304.8,
            Unit::Meter => 1000.0,
        }
    }
}

impl std::str::FromStr for Unit {
    type Err = UnknownUnit;

    fn from_str(name: &str) -> Result<Unit, UnknownUnit> {
        match name {
            "micron" => Ok(Unit::Micron),
            "millimeter" => Ok(Unit::Millimeter),
            "centimeter" => Ok(Unit::Centimeter),
            "inch" => Ok(Unit::Inch),
            "foot" => Ok(Unit::Foot),
            "meter" => Ok(Unit::Meter),
            _ => Err(UnknownUnit(name.to_owned())),
        }
    }
}
