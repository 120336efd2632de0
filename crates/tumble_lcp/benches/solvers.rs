//! Time against n for each solver and class. `cargo bench -p tumble_lcp`; growth exponents: `cargo run --release --example growth`.

use divan::Bencher;
use tumble_lcp::families::Family;
use tumble_lcp::{GaussSeidel, InteriorPoint, Lemke, Newton, PrincipalPivoting, ProjectedGradient};

fn main() {
    divan::main();
}

const SIZES: [usize; 3] = [12, 48, 96];

#[divan::bench(args = SIZES)]
fn lemke_definite(bencher: Bencher, n: usize) {
    let problem = Family::PositiveDefinite.sample(n, 1).problem;
    bencher.bench(|| Lemke::default().solve(&problem));
}

#[divan::bench(args = SIZES)]
fn lemke_nonsymmetric(bencher: Bencher, n: usize) {
    let problem = Family::NonsymmetricDefinite.sample(n, 1).problem;
    bencher.bench(|| Lemke::default().solve(&problem));
}

#[divan::bench(args = SIZES)]
fn principal_pivoting_definite(bencher: Bencher, n: usize) {
    let problem = Family::PositiveDefinite.sample(n, 1).problem;
    bencher.bench(|| PrincipalPivoting::default().solve(&problem));
}

#[divan::bench(args = SIZES)]
fn principal_pivoting_friction(bencher: Bencher, n: usize) {
    let problem = Family::FrictionalContact.sample(n, 1).problem;
    bencher.bench(|| PrincipalPivoting::default().solve(&problem));
}

#[divan::bench(args = SIZES)]
fn newton_nonsymmetric(bencher: Bencher, n: usize) {
    let problem = Family::NonsymmetricDefinite.sample(n, 1).problem;
    bencher.bench(|| Newton::default().solve(&problem));
}

#[divan::bench(args = SIZES)]
fn interior_point_contact(bencher: Bencher, n: usize) {
    let problem = Family::Contact.sample(n, 1).problem;
    bencher.bench(|| InteriorPoint::default().solve(&problem));
}

#[divan::bench(args = SIZES)]
fn gauss_seidel_m_matrix(bencher: Bencher, n: usize) {
    let problem = Family::MMatrix.sample(n, 1).problem;
    bencher.bench(|| GaussSeidel::default().solve(&problem));
}

#[divan::bench(args = SIZES)]
fn projected_gradient_contact(bencher: Bencher, n: usize) {
    let problem = Family::Contact.sample(n, 1).problem;
    bencher.bench(|| ProjectedGradient { tolerance: 1e-6, ..ProjectedGradient::default() }.solve(&problem));
}
