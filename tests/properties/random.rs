//! Random scenes under random hands. `PROPTEST_CASES` says how many; what fails is shrunk and kept under `tests/cases`.

use super::{case::Case, hands, rules, scenes};
use proptest::{
    prelude::*,
    test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner},
};

/// Cases of a run that nobody asked more of.
const CASES: u32 = if cfg!(debug_assertions) { 48 } else { 256 };
/// Work of a case, passes over a particle.
const WORK: f64 = if cfg!(debug_assertions) { 4e6 } else { 4e7 };
/// Ticks of a case: at least, at most.
const TICKS: (f64, f64) = (2.0, 90.0);

fn case() -> impl Strategy<Value = Case> {
    scenes::scene().prop_flat_map(|scene| {
        let ticks = (WORK / scene.work).clamp(TICKS.0, TICKS.1) as u32;
        hands::input(scene.size, ticks).prop_map(move |input| Case { scene: scene.text.clone(), input, ticks })
    })
}

#[test]
fn no_scene_and_no_hand_breaks_a_rule() {
    let asked = std::env::var_os("PROPTEST_CASES").is_some();
    let config = Config {
        cases: if asked { Config::default().cases } else { CASES },
        // What is found is kept as a scene, and not as a seed.
        failure_persistence: None,
        max_shrink_iters: 400,
        ..Config::default()
    };
    // A run that nobody asked for has the same cases everywhere; one that somebody did is new each time.
    let mut runner = if asked {
        TestRunner::new(config)
    } else {
        TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
    };
    let (mut built, mut refused) = (0_u32, 0_u32);
    let counts = std::cell::RefCell::new((&mut built, &mut refused));
    let result = runner.run(&case(), |case| match rules::judge(&case) {
        Ok(true) => {
            *counts.borrow_mut().0 += 1;
            Ok(())
        }
        Ok(false) => {
            *counts.borrow_mut().1 += 1;
            Ok(())
        }
        Err(fault) => Err(TestCaseError::fail(fault)),
    });
    match result {
        Ok(()) => {
            assert!(refused < built / 4 + 2, "{refused} of {} scenes were refused: not valid ones", built + refused);
        }
        Err(TestError::Fail(fault, case)) => {
            let kept = case.keep().map_or_else(|error| error.to_string(), |path| path.display().to_string());
            panic!("{fault}\nkept as {kept}\n{}\n{:?}", case.scene, case.input);
        }
        Err(TestError::Abort(why)) => panic!("{why}"),
    }
}
