//! The environment variable of CPU levels is parsed as documented.

use tess_level::Level;
use tess_testkit::levels::required_levels;

#[test]
fn the_variable_names_levels() {
    let of = required_levels;
    assert_eq!(of(""), Ok(vec![]), "not set");
    assert_eq!(of("all"), Ok(Level::ALL.to_vec()), "all");
    assert_eq!(of("avx2, baseline"), Ok(vec![Level::Avx2, Level::Baseline]), "names");
    let error = of("avx2,neon").expect_err("no such level");
    assert!(error.contains("neon") && error.contains("avx512"), "{error}");
}
