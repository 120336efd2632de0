//! Every example of the course runs, and its closing check holds.

use std::collections::BTreeSet;
use std::error::Error;
use std::fs;
use std::path::Path;

macro_rules! course {
    ($($name:ident: $file:literal),* $(,)?) => {
        $(
            #[path = $file]
            mod $name;

            #[test]
            fn $name() -> Result<(), Box<dyn Error>> {
                $name::main()
            }
        )*

        /// Files of the course.
        const COURSE: &[&str] = &[$($file),*];
    };
}

course! {
    falling_rod: "../../examples/01_falling_rod.rs",
    bouncing_ball: "../../examples/02_bouncing_ball.rs",
    homework_rods: "../../examples/03_homework_rods.rs",
    friction_quiz: "../../examples/04_friction_quiz.rs",
    wind: "../../examples/05_wind.rs",
    springs_and_convergence: "../../examples/06_springs_and_convergence.rs",
    contact_models: "../../examples/07_contact_models.rs",
    l4_limit: "../../examples/08_l4_limit.rs",
    scenes_in_code: "../../examples/09_scenes_in_code.rs",
    recording_and_plots: "../../examples/10_recording_and_plots.rs",
    test_your_scene: "../../examples/11_test_your_scene.rs",
    mechanism: "../../examples/12_mechanism.rs",
}

#[test]
fn no_example_is_left_out() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut files = BTreeSet::new();
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if name.ends_with(".rs") {
            files.insert(format!("../../examples/{name}"));
        }
    }
    assert_eq!(files, COURSE.iter().map(|file| (*file).to_owned()).collect());
    Ok(())
}
