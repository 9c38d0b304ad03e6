//! Puts the objects of the build where transforms and components say.
use super::model::{Instance, Model, Object};
use super::transform::Transform;
use super::{Part, error};
use crate::data::WarningKind;
use crate::io::ReadError;
use crate::io::parsed::Parsed;
use rustc_hash::FxHashSet;

/// How deep components may nest. Files from CAD systems nest as their assemblies do, some ten deep; a cycle
/// nests without end.
const DEEPEST: usize = 64;

/// Bytes of placed geometry for each byte of the archive: a hundred copies of a part, whose text shrank to a
/// fifth, need about 200.
const PLACED_PER_BYTE: usize = 256;
/// What may be placed in any case.
const PLACED_ANYWAY: usize = 16 << 20;
/// What an instance costs if it holds nothing, so that empty ones come to an end too.
const INSTANCE_COST: usize = 64;

struct Builder<'p> {
    parts: &'p [Part],
    parsed: Parsed,
    triangles: Vec<[u32; 3]>,
    /// Bytes that may still be placed.
    left: usize,
}

/// Places the build of the first of `parts`; without a build, every object that is not part of another.
pub(super) fn build(parts: &[Part], archive_bytes: usize) -> Result<Parsed, ReadError> {
    let left = PLACED_PER_BYTE.saturating_mul(archive_bytes).saturating_add(PLACED_ANYWAY);
    let mut builder = Builder { parts, parsed: Parsed::default(), triangles: Vec::new(), left };
    let root = &parts[0].model;
    let to_millimetres = Transform::scaling(root.unit.millimetres());
    if root.items.is_empty() {
        outermost(root).iter().try_for_each(|item| builder.place(0, item, &to_millimetres, 0))?;
    } else {
        root.items.iter().try_for_each(|item| builder.place(0, item, &to_millimetres, 0))?;
    }
    builder.parsed.triangles = Some(builder.triangles);
    Ok(builder.parsed)
}

fn outermost(model: &Model) -> Vec<Instance> {
    let inner: FxHashSet<u32> = model.components.iter().map(|component| component.object).collect();
    let mut ids: Vec<u32> = model.objects.keys().filter(|id| !inner.contains(id)).copied().collect();
    ids.sort_unstable();
    ids.into_iter().map(|object| Instance { object, path: None, transform: None }).collect()
}

impl Builder<'_> {
    fn place(
        &mut self,
        part: usize,
        instance: &Instance,
        outer: &Transform,
        depth: usize,
    ) -> Result<(), ReadError> {
        if depth > DEEPEST {
            return Err(error(0, format!("components nested at most {DEEPEST} deep, found more or a cycle")));
        }
        self.spend(INSTANCE_COST)?;
        let Part { model, links } = &self.parts[part];
        let part = instance.path.map_or(part, |path| links[path as usize]);
        let transform = instance.transform.map(|index| &model.transforms[index as usize]);
        let transform = transform.map_or(*outer, |inner| outer.after(inner));
        let model = &self.parts[part].model;
        let Some(object) = model.objects.get(&instance.object) else {
            self.parsed.tally.add(WarningKind::SkippedElements, 1);
            return Ok(());
        };
        self.place_mesh(model, object, &transform)?;
        let components = &model.components[object.components.clone()];
        components.iter().try_for_each(|component| self.place(part, component, &transform, depth + 1))
    }

    fn place_mesh(&mut self, model: &Model, object: &Object, transform: &Transform) -> Result<(), ReadError> {
        let vertices = &model.vertices[object.vertices.clone()];
        let triangles = &model.triangles[object.triangles.clone()];
        if triangles.is_empty() {
            return Ok(());
        }
        self.spend(size_of_val(vertices) + size_of_val(triangles))?;
        let first = self.parsed.positions.len();
        self.parsed.positions.extend(vertices.iter().map(|p| transform.apply(*p)));
        let moved = |index: u32| {
            let is_inside = (index as usize) < vertices.len();
            if is_inside { (first + index as usize).min(u32::MAX as usize) as u32 } else { u32::MAX }
        };
        let turned = |[a, b, c]: [u32; 3]| if transform.mirrors() { [a, c, b] } else { [a, b, c] };
        self.triangles.extend(triangles.iter().map(|corners| turned(corners.map(moved))));
        Ok(())
    }

    fn spend(&mut self, bytes: usize) -> Result<(), ReadError> {
        let left = self.left.checked_sub(bytes);
        self.left = left.ok_or_else(|| {
            error(
                0,
                format!("objects that come to at most {PLACED_PER_BYTE} bytes for each byte of the archive"),
            )
        })?;
        Ok(())
    }
}
