//! Tests that options are refused if they have no effect, or contradict each other or the name of a
//! file.

use crate::support::{directory, tess, tess_with_input};

const PATCH: &str = "quad --outer 3,4,5,6 --inner 4,7";

#[test]
fn options_without_effect_are_refused() {
    let folder = directory("options_without_effect");
    let out = |name: &str| folder.join(name).display().to_string();
    let (jpg, png, obj, glb) = (out("a.jpg"), out("a.png"), out("a.obj"), out("a.glb"));
    for (words, why) in [
        (format!("draw {PATCH} --against core"), "with itself"),
        (format!("draw {PATCH} --backend simd --against simd"), "with itself"),
        (format!("draw {PATCH} -o {jpg}"), ".svg, .png"),
        (format!("draw {PATCH} -o {png} --format svg"), "does not go with the name"),
        (format!("patch {PATCH} -o {jpg}"), "cannot tell what to write"),
        (format!("patch {PATCH} -o {obj} --format json"), "does not go with the name"),
        (format!("draw {PATCH} --rings --output point"), "this one has none"),
        ("draw isoline --outer 2,2 --rings".to_owned(), "this one has none"),
        (format!("mesh --factor 1 --indices 16 -o {png}"), "--indices is for .gltf and .glb"),
        (format!("mesh --factor 1 --indices 32 -o {obj}"), "--indices is for .gltf and .glb"),
        (format!("mesh --factor 1 --wireframe -o {obj}"), "--wireframe is for pictures"),
        (format!("mesh --factor 1 --eye 1,2,3 -o {glb}"), "--eye"),
        (format!("mesh --factor 65 -o {obj}"), "1 to 64"),
        (format!("mesh --factor 64 --partitioning fractional_odd -o {obj}"), "1 to 63"),
        (format!("mesh --factor 1 --partitioning fractional_even -o {obj}"), "2 to 64"),
        (format!("mesh --size 8192x8192 -o {png}"), "at most 16777216 pixels"),
        ("gen --level 1 --coverage --format csv".to_owned(), "cannot be used with"),
    ] {
        tess(&words).exits(2).prints_nothing().says(why);
    }
    assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 0, "nothing is written");
}

/// The same options are accepted where they have an effect.
#[test]
fn options_with_an_effect_are_taken() {
    let folder = directory("options_with_an_effect");
    let out = |name: &str| folder.join(name).display().to_string();
    for words in [
        "verify --backend core --backend simd --cpu-level baseline --random 1".to_owned(),
        format!("draw {PATCH} --against simd --cpu-level baseline -o {}", out("a.svg")),
        format!("draw {PATCH} --backend simd --index-type u16 --against core -o {}", out("a.png")),
        format!("patch {PATCH} --format csv -o {}", out("a.txt")),
        format!("mesh --pixels 50 --size 80x60 -o {}", out("a.obj")),
        format!("mesh --factor 63 --partitioning fractional_odd -o {}", out("b.obj")),
    ] {
        tess(&words).exits(0);
    }
}

/// `tess patch` takes its format from the name of the file.
#[test]
fn forms_by_name() {
    let folder = directory("forms_by_name");
    for (name, begins) in [("a.json", "{"), ("a.obj", "# "), ("a.SVG", "<svg "), ("a", "# tess-")] {
        let path = folder.join(name);
        tess(&format!("patch {PATCH} -o {}", path.display())).exits(0);
        let text = std::fs::read_to_string(&path).expect("the file");
        assert!(text.starts_with(begins), "{name}: {text}");
    }
}

/// A factor above the largest is valid, and a note states as what it counts.
#[test]
fn large_factors_are_noted() {
    for command in ["patch", "draw"] {
        let words = "quad --outer 65,64,1,inf --inner 3,70 --partitioning fractional_odd";
        let run = tess(&format!("{command} {words}"));
        run.exits(0);
        let notes = "tess: note: u0 is 65 and counts as 63, the largest factor\n\
                     tess: note: v0 is 64 and counts as 63, the largest factor\n\
                     tess: note: v1 is inf and counts as 63, the largest factor\n\
                     tess: note: inside_v is 70 and counts as 63, the largest factor\n";
        assert_eq!(run.stderr, notes, "{command}");
        let run = tess(&format!("{command} {PATCH}"));
        assert_eq!(run.stderr, "", "{command}: none is too large");
    }
}

/// A negative number is a wrong value, not an option that could be written in another way.
#[test]
fn negative_numbers_are_values() {
    for words in [
        "gen --count -1",
        "explain tri --outer 1,1,1 --inner 1 --point -1",
        "draw tri --outer 1,1,1 --inner 1 --size -1",
        "bench --samples -3",
        "mesh --factor -1 -o a.obj",
        "patch -1",
    ] {
        let run = tess_with_input(words, "");
        run.exits(2).says("invalid value '-");
        assert!(!run.stderr.contains("'-- "), "{words}: {}", run.stderr);
    }
}
