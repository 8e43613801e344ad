//! Keys, and the frame time on the screen.

use bevy::color::palettes::css::{BLACK, WHITE};
use bevy::diagnostic::{DiagnosticsStore, FrameTimeDiagnosticsPlugin};
use bevy::math::{Isometry3d, ops};
use bevy::prelude::*;
use bevy_tess::{LevelOfDetail, TessBackend, TessSettings, TessStats, Tessellated};

pub(crate) fn set_up(mut gizmos: ResMut<GizmoConfigStore>) {
    let (config, _) = gizmos.config_mut::<DefaultGizmoConfigGroup>();
    // Drawn in front of everything.
    config.depth_bias = -1.0;
    config.line.width = 1.5;
}

pub(crate) fn press(
    keys: Res<ButtonInput<KeyCode>>,
    mut settings: ResMut<TessSettings>,
    mut surfaces: Query<&mut Tessellated>,
    mut exit: MessageWriter<AppExit>,
) {
    if keys.just_pressed(KeyCode::KeyW) {
        settings.wireframe = !settings.wireframe;
    }
    if keys.just_pressed(KeyCode::KeyC) {
        settings.backend = match settings.backend {
            TessBackend::Auto => TessBackend::Cpu,
            TessBackend::Cpu => TessBackend::Auto,
        };
    }
    for (key, by) in [
        (KeyCode::Equal, 0.8),
        (KeyCode::NumpadAdd, 0.8),
        (KeyCode::Minus, 1.25),
        (KeyCode::NumpadSubtract, 1.25),
    ] {
        if keys.just_pressed(key) {
            for mut surface in &mut surfaces {
                if let LevelOfDetail::Pixels(pixels) = &mut surface.detail {
                    *pixels = (*pixels * by).clamp(0.25, 1000.0);
                }
            }
        }
    }
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
}

/// Writes the frame time, the number of triangles and the backend onto the screen and into the
/// window's title.
pub(crate) fn write(
    diagnostics: Res<DiagnosticsStore>,
    settings: Res<TessSettings>,
    stats: Res<TessStats>,
    cameras: Query<(&Transform, &Projection), With<Camera3d>>,
    mut windows: Query<&mut Window>,
    mut gizmos: Gizmos,
) {
    let time = diagnostics.get(&FrameTimeDiagnosticsPlugin::FRAME_TIME);
    let milliseconds = time.and_then(|time| time.smoothed()).unwrap_or_default();
    let by = match settings.backend {
        TessBackend::Auto => "GPU",
        TessBackend::Cpu => "CPU",
    };
    let text = format!("{milliseconds:.1} ms, {} triangles, {by}", stats.triangles());
    for mut window in &mut windows {
        window.title.clone_from(&text);
    }
    for (camera, projection) in &cameras {
        let Projection::Perspective(PerspectiveProjection { fov, aspect_ratio, .. }) = projection
        else {
            continue;
        };
        let high = ops::tan(0.5 * fov);
        for (shift, color) in [(0.003, BLACK), (0.0, WHITE)] {
            let corner = Vec3::new(-0.97 * high * aspect_ratio + shift, 0.95 * high - shift, -1.0);
            let at = Isometry3d::new(camera.transform_point(corner), camera.rotation);
            gizmos.text(at, &text, 0.04 * high, Vec2::new(-0.5, 0.5), color);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_tess::BezierPatches;

    const PIXELS: f32 = 8.0;

    /// The example's keys, and one surface.
    fn app() -> App {
        let mut app = App::new();
        app.init_resource::<ButtonInput<KeyCode>>().insert_resource(TessSettings::default());
        app.add_message::<AppExit>().add_systems(Update, press);
        let patch = BezierPatches::new(vec![[[[0.0; 3]; 4]; 4]]).expect("one patch");
        app.world_mut().spawn(Tessellated::new(patch).with_detail(LevelOfDetail::Pixels(PIXELS)));
        app
    }

    /// Presses and releases a key.
    fn strike(app: &mut App, key: KeyCode) {
        app.world_mut().resource_mut::<ButtonInput<KeyCode>>().press(key);
        app.update();
        let mut keys = app.world_mut().resource_mut::<ButtonInput<KeyCode>>();
        keys.release(key);
        keys.clear();
        app.update();
    }

    fn pixels(app: &mut App) -> f32 {
        let mut surfaces = app.world_mut().query::<&Tessellated>();
        let surface = surfaces.single(app.world()).expect("one surface");
        let LevelOfDetail::Pixels(pixels) = surface.detail else { panic!("by pixels") };
        pixels
    }

    #[test]
    fn w_is_the_wireframe_and_c_the_backend() {
        let mut app = app();
        let settings = |app: &App| *app.world().resource::<TessSettings>();
        let before = settings(&app);
        strike(&mut app, KeyCode::KeyW);
        assert_eq!(settings(&app), TessSettings { wireframe: true, ..before }, "w");
        strike(&mut app, KeyCode::KeyC);
        let both = TessSettings { wireframe: true, backend: TessBackend::Cpu };
        assert_eq!(settings(&app), both, "c");
        strike(&mut app, KeyCode::KeyW);
        strike(&mut app, KeyCode::KeyC);
        assert_eq!(settings(&app), before, "both again");
    }

    #[test]
    fn plus_is_finer_and_minus_coarser() {
        for [plus, minus] in
            [[KeyCode::Equal, KeyCode::Minus], [KeyCode::NumpadAdd, KeyCode::NumpadSubtract]]
        {
            let mut app = app();
            strike(&mut app, plus);
            assert!(pixels(&mut app) < PIXELS, "{plus:?}: shorter segments");
            strike(&mut app, minus);
            strike(&mut app, minus);
            assert!(pixels(&mut app) > PIXELS, "{minus:?}: longer segments");
        }
    }

    #[test]
    fn escape_ends_and_other_keys_do_nothing() {
        let mut app = app();
        let ends = |app: &App| app.should_exit().is_some();
        strike(&mut app, KeyCode::KeyQ);
        assert!(!ends(&app) && pixels(&mut app) == PIXELS, "q");
        strike(&mut app, KeyCode::Escape);
        assert!(ends(&app), "Escape");
    }
}
