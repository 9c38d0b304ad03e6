//! The tables of Schier et al. 2018 with ours beside them, and the goals that were set by them.
//!
//! ```text
//! charges [TABLE …]     2 potentials, 3 convergence of the charges, 4 charges in n, 5 field lines in n, 6 order of the integrators,
//!                       12 another proxy and the dipole field, 15 (a figure) lines through the walls of a pipe; all by default
//! ```
//! The paper's machine: Intel Core i7-3740QM, 4 cores.
mod lines;
mod pipe;
mod proxies;
mod shapes;
mod solving;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let tables: [(&str, fn()); 7] = [
        ("2", lines::potentials),
        ("3", solving::convergence),
        ("4", solving::rate),
        ("5", lines::rate),
        ("6", lines::order),
        ("12", proxies::proxies),
        ("15", pipe::through_walls),
    ];
    for (_, table) in tables.iter().filter(|(name, _)| wanted.is_empty() || wanted.iter().any(|w| w == name))
    {
        table();
    }
}
