//! Tests of `tess draw`: pictures of the right form, and overlays that show differences.

use crate::support::{digest, directory, tess};
use std::fs;

const PATCH: &str = "quad --outer 3,4,5,6 --inner 4,7";

#[test]
fn svg_has_every_triangle_and_point() {
    let run = tess(&format!("draw {PATCH}"));
    run.exits(0);
    let count = |element: &str| run.stdout.matches(element).count();
    assert_eq!((count("<polygon"), count("<circle")), (52, 36), "triangles and points");
    assert!(run.stdout.starts_with("<svg ") && run.stdout.ends_with("</svg>\n"), "whole");
    assert_eq!(run.stdout, tess(&format!("draw {PATCH}")).stdout, "the same again");
    assert_eq!(run.stdout, tess(&format!("patch {PATCH} --format svg")).stdout, "by tess patch");
}

/// Every number, colour and position of the pictures. Whoever changes how pictures look records the
/// new digests here, after looking at the pictures.
#[test]
fn pictures_are_the_recorded_ones() {
    let patches = [
        "tri --outer 3,4.5,7 --inner 5.5 --partitioning fractional_odd",
        "quad --outer 3,4,5,6 --inner 4,7",
        "isoline --outer 3,4",
        "quad --outer 2,3,4,5 --inner 3,2 --output point",
    ];
    let options = [
        "",
        "--number-points",
        "--number-primitives",
        "--rings",
        "--number-points --rings",
        "--number-points --size 200",
    ];
    let found = patches.map(|patch| {
        options.map(|options| digest(&tess(&format!("draw {patch} {options}")).stdout))
    });
    assert_eq!(found, RECORDED, "patches with {options:?}");
}

/// Digests of the pictures of [`pictures_are_the_recorded_ones`]. Options that are refused draw
/// nothing.
const RECORDED: [[&str; 6]; 4] = [
    [
        "0460f3fa92fd612e",
        "62c0d2924182e4a1",
        "d030bf38c952e289",
        "44a103a451b6cb6d",
        "ef6b81f9c5981a92",
        "07a33c176a65f0f2",
    ],
    [
        "fbd3666c7ce0a9f6",
        "cf1774140484cc76",
        "bcac5cf49565c815",
        "402bb7d66b865e36",
        "08de08df3268cfb6",
        "b2451ae32f50147a",
    ],
    [
        "4097785e48c665b7",
        "047049e1c71d82f5",
        "b54cd48613cac8c9",
        "cbf29ce484222325",
        "cbf29ce484222325",
        "08f59d97fe67e169",
    ],
    [
        "c47546fd71474ff6",
        "70f4e9fa88f5af69",
        "7a336d9a48b29e55",
        "cbf29ce484222325",
        "cbf29ce484222325",
        "4ce6203575053c03",
    ],
];

#[test]
fn png_is_chosen_by_name_and_has_the_size() {
    let directory = directory("png_is_chosen_by_name");
    let file = directory.join("patch.png");
    for options in
        ["", "--number-points", "--number-primitives", "--rings", "--number-points --rings"]
    {
        tess(&format!("draw {PATCH} {options} --size 300 -o {}", file.display())).exits(0);
        let png = fs::read(&file).expect("the picture");
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n", "{options}: signature");
        assert_eq!(&png[16..24], [0, 0, 1, 44, 0, 0, 1, 44], "{options}: 300 x 300");
    }
}

#[test]
fn numbers_left_out_are_reported() {
    let run = tess("draw quad --outer 64,64,64,64 --inner 64,64 --number-points --size 400");
    run.exits(0).says("4225 numbers left out");
}

/// An equal listing shows no difference; one with a moved point and a turned triangle shows both.
#[test]
fn overlays_show_differences() {
    let directory = directory("overlays_show_differences");
    let file = directory.join("device.txt");
    let listing = tess(&format!("patch {PATCH}")).stdout;
    fs::write(&file, &listing).expect("a listing");
    let draw = format!("draw {PATCH} --overlay {}", file.display());
    tess(&draw).exits(0).says(": 0 points and 0 primitives");

    let faulty = listing.replacen("00000 10000", "00100 0fff0", 1).replacen("\n0 1 ", "\n1 0 ", 1);
    fs::write(&file, faulty).expect("a faulty listing");
    let different = tess(&draw);
    different.exits(1).says(": 1 point and 1 primitive\n").prints("#d51f1f"); // something is red
    assert_eq!(digest(&different.stdout), "9c9ee765ecd04b29", "{}", different.stdout);

    tess(&draw.replace("3,4,5,6", "3,4,5,7")).exits(2); // no listing of that patch
    fs::write(&file, &listing[..listing.len() / 2]).expect("half a listing");
    tess(&draw).exits(2); // a truncated listing
}

#[test]
fn two_backends_are_compared() {
    let run = tess(&format!("draw {PATCH} --backend simd --against core"));
    run.exits(0).says("0 points and 0 primitives");
}

/// A capture of coordinates is drawn with the model's numbers, and its correct vertices do not
/// differ.
#[test]
fn overlays_of_coordinates() {
    let directory = directory("overlays_of_coordinates");
    let file = directory.join("capture.txt");
    let capture = "# tess-vectors 1 kind=listings source=capture\n\
        case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000\n\
        coordinates float\n0 1 0\n0 0 1\n1 0 0\nend\n# end\n";
    let draw = format!("draw tri --outer 1,1,1 --inner 1 --overlay {}", file.display());
    fs::write(&file, capture).expect("a capture");
    tess(&draw).exits(0);
    fs::write(&file, capture.replace("0 0 1", "0 0.5 0.5")).expect("a faulty capture");
    tess(&draw).exits(1).says(": 1 point and 1 primitive\n");
}

/// A primitive that cannot be drawn is marked in red and named.
#[test]
fn overlays_mark_what_cannot_be_drawn() {
    let directory = directory("overlays_mark");
    let file = directory.join("device.txt");
    let patch = "tri --outer 4,4,4 --inner 4";
    let listing = tess(&format!("patch {patch}")).stdout;
    let at = listing.find("\nindices ").expect("indices") + 1;
    let (points, indices) = listing.split_at(at);
    let first = indices.lines().nth(1).expect("a triangle");
    for (faulty, words) in [
        (format!("{points}indices 0\nend\n"), "primitive 0 is missing"),
        (listing.replacen(&format!("\n{first}\n"), "\n0 1 99\n", 1), "primitive 0 is `0 1 99`"),
        (listing.replacen(&format!("\n{first}\n"), "\n1 1 1\n", 1), "names a point twice"),
    ] {
        fs::write(&file, &faulty).expect("a faulty listing");
        let run = tess(&format!("draw {patch} --overlay {}", file.display()));
        run.exits(1).says(words).prints("#d51f1f"); // something is red
    }
    fs::write(&file, format!("{points}indices 0\nend\n")).expect("no indices");
    let run = tess(&format!("draw {patch} --overlay {}", file.display()));
    let all = indices.lines().count() - 2;
    assert_eq!(run.stdout.matches("#d51f1f").count(), all, "an outline for each");
    run.says(format!("and {} more", all - 20));
}

/// Primitives that are points are numbered in their order as well.
#[test]
fn order_of_points() {
    let patch = "tri --outer 2,2,2 --inner 2 --output point";
    let [plain, order] =
        ["", "--number-primitives"].map(|option| tess(&format!("draw {patch} {option}")));
    order.exits(0);
    assert_eq!(order.stderr, "", "no number is left out");
    let lines = |text: &str| text.matches("<polyline").count();
    assert!(lines(&order.stdout) > lines(&plain.stdout) + 6, "seven numbers:\n{}", order.stdout);
}
