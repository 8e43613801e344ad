//! Heights from images that are loaded and change.

use super::{app, run};
use crate::{HeightField, HeightFieldError, TessStats, Tessellated};
use bevy::asset::RenderAssetUsages;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};

/// An image of 2 x 3 pixels.
fn image(format: TextureFormat, bytes: Vec<u8>) -> Image {
    let size = Extent3d { width: 2, height: 3, depth_or_array_layers: 1 };
    Image::new(size, TextureDimension::D2, bytes, format, RenderAssetUsages::MAIN_WORLD)
}

/// The words of a field of this size with these heights.
fn words(texels: UVec2, heights: &[f32]) -> Vec<u32> {
    use crate::Shape;
    let field = HeightField::new(texels, heights.to_vec()).expect("as many");
    field.with_size(Vec3::new(1.0, 0.2, 1.0)).words()
}

#[test]
fn a_field_follows_its_image() {
    let mut app = app();
    let texels = UVec2::new(2, 3);
    let bytes = [0, 51, 102, 153, 204, 255];
    let mut heights = bytes.map(|byte| f32::from(byte) / 255.0);
    let level = HeightField::new(UVec2::ONE, vec![0.0]).expect("one texel");
    let level = level.with_size(Vec3::new(1.0, 0.2, 1.0));
    let images = app.world().resource::<Assets<Image>>();
    let handle = images.reserve_handle();
    let surface = Tessellated::new(level.with_image(handle.clone()));
    let entities = [surface.clone(), surface].map(|surface| app.world_mut().spawn(surface).id());
    let observed = |app: &mut App| {
        run(app);
        let [one, other] =
            entities.map(|entity| app.world().get::<Tessellated>(entity).expect("it is there"));
        assert!(std::sync::Arc::ptr_eq(&one.shape, &other.shape), "they share it");
        one.shape.words()
    };
    assert_eq!(observed(&mut app), words(UVec2::ONE, &[0.0]), "it is not loaded");
    let change = |app: &mut App, image: Image| {
        let mut images = app.world_mut().resource_mut::<Assets<Image>>();
        images.insert(&handle, image).expect("the handle is there");
    };
    change(&mut app, image(TextureFormat::R8Unorm, bytes.to_vec()));
    assert_eq!(observed(&mut app), words(texels, &heights), "it is loaded");
    let red = [9, 8, 8, 255].repeat(6);
    change(&mut app, image(TextureFormat::Rgba8UnormSrgb, red));
    assert_eq!(observed(&mut app), words(texels, &heights), "what is not grey changes nothing");
    // Two words differ; the others and all patches stay.
    heights[3] = 0.25;
    heights[4] = 0.5;
    let floats = heights.map(f32::to_le_bytes).concat();
    change(&mut app, image(TextureFormat::R32Float, floats));
    let mut most = 0;
    for _ in 0..4 {
        app.update();
        most = most.max(app.world().resource::<TessStats>().uploaded());
    }
    assert_eq!(most, 8, "the words that changed");
    assert_eq!(observed(&mut app), words(texels, &heights), "floats are heights");
}

#[test]
fn formats_are_read_or_refused() {
    use crate::Shape;
    let level = HeightField::new(UVec2::ONE, vec![0.0]).expect("one texel");
    let made = |image: Image| level.of_image(&image).map(|shape| shape.words());
    let sixths = [0_u16, 13107, 26214, 39321, 52428, 65535];
    let expected =
        HeightField::new(UVec2::new(2, 3), sixths.map(|word| f32::from(word) / 65535.0).to_vec());
    let expected = expected.expect("6 texels").words();
    for format in [TextureFormat::R16Unorm, TextureFormat::R16Uint] {
        let read = made(image(format, sixths.map(u16::to_le_bytes).concat()));
        assert_eq!(read.expect("it is grey"), expected, "{format:?}");
    }
    let grey = sixths.map(|word| [(word / 257) as u8; 4]).concat();
    let read = made(image(TextureFormat::Rgba8UnormSrgb, grey));
    assert_eq!(read.expect("it is grey"), expected, "not decoded");
    let told = |image: Image| made(image).expect_err("it is refused").to_string();
    let reddish = told(image(TextureFormat::Rgba8Unorm, [9, 8, 8, 255].repeat(6)));
    let expected = HeightFieldError::NotGrey { at: UVec2::ZERO }.to_string();
    assert!(reddish.contains(&expected), "{reddish}");
    let mut gone = image(TextureFormat::R8Unorm, vec![0; 6]);
    gone.data = None;
    assert!(told(gone).contains("MAIN_WORLD"), "it says where pixels must be");
    let nan = [0.0, 1.0, f32::NAN, 0.0, 0.0, 0.0].map(f32::to_le_bytes).concat();
    let nan = told(image(TextureFormat::R32Float, nan));
    assert!(nan.contains("not an image"), "{nan}");
}
