//! Keys, and the frame time on the screen.

use bevy::color::palettes::css::{BLACK, WHITE};
use bevy::diagnostic::{DiagnosticsStore, FrameTimeDiagnosticsPlugin};
use bevy::math::{Isometry3d, ops};
use bevy::prelude::*;
use bevy_tess::{Backend, FactorRule, TessSettings, TessStats, Tessellated};

pub(crate) fn set_up(mut gizmos: ResMut<GizmoConfigStore>) {
    let (config, _) = gizmos.config_mut::<DefaultGizmoConfigGroup>();
    // In front of everything.
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
            Backend::Auto => Backend::Cpu,
            Backend::Cpu => Backend::Auto,
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
                if let FactorRule::Pixels(pixels) = &mut surface.factors {
                    *pixels = (*pixels * by).clamp(0.25, 1000.0);
                }
            }
        }
    }
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
}

/// Writes the frame time, the triangles and who tessellates onto the screen and into the window's title.
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
        Backend::Auto => "GPU",
        Backend::Cpu => "CPU",
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
