//! A module may import only from strictly lower layers, so the crate has no cycles.
use std::{fs, path::Path};

const LAYERS: &[&[&str]] = &[
    &["math"],
    &["data"],
    &["io", "bvh", "polygon"],
    &["treecode", "levelset", "estimate", "metrics", "distance", "arrangement"],
    &["winding", "charge"],
    &["slice", "solid", "surface", "check", "orient"],
    &["repair", "print"],
    &["texture"],
    &["wasm"],
];

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|names| names.contains(&module))
}

/// Top-level modules named after each `crate::`, both `crate::a::B` and `crate::{a, b::{C, D}}`.
fn imports(source: &str) -> Vec<String> {
    let code: String = source.lines().map(|l| l.split("//").next().unwrap()).collect();
    let mut found = Vec::new();
    for tail in code.split("crate::").skip(1) {
        let (mut depth, mut in_name, mut name) = (0, true, String::new());
        for c in tail.chars() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 1 => {
                    found.push(std::mem::take(&mut name));
                    in_name = true
                }
                c if in_name && (c.is_alphanumeric() || c == '_') => name.push(c),
                c if c.is_whitespace() => in_name = in_name && name.is_empty(),
                _ => in_name = false,
            }
            if depth <= 0 && !in_name || depth < 0 || (c == '}' && depth == 0) {
                break;
            }
        }
        found.push(name);
    }
    found
}

fn check(module: &str, path: &Path, bad: &mut Vec<String>) {
    if path.is_dir() {
        return fs::read_dir(path).unwrap().for_each(|e| check(module, &e.unwrap().path(), bad));
    }
    let mut source = fs::read_to_string(path).unwrap();
    if path
        .file_stem()
        .is_some_and(|stem| stem == module || stem == "mod" && path.parent().unwrap().ends_with(module))
    {
        source = source.replace("super::", "crate::"); // at a module's own root, `super` is the crate
    }
    for used in imports(&source) {
        if used != module && layer(&used).is_some() && layer(&used) >= layer(module) {
            bad.push(format!("{}: {module} -> {used}", path.display()));
        }
    }
    if source.contains("super::super::") {
        bad.push(format!("{}: write crate:: instead of super::super::", path.display()));
    }
}

#[test]
fn imports_point_down() {
    let mut bad = Vec::new();
    for entry in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/src")).unwrap() {
        let path = entry.unwrap().path();
        let module = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if module != "lib" {
            assert!(layer(&module).is_some(), "{module} is not in the layer table");
            check(&module, &path, &mut bad);
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}
