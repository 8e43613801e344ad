//! A window that shows an example frame after frame.

use crate::app::{Args, DEPTH, Frame, Show, draw, texture, view_of};
use std::error::Error;
use std::sync::Arc;
use std::time::Instant;
use tess_wgpu::Gpu;
use winit::application::ApplicationHandler;
use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

/// Opens a window and returns when it is closed.
pub(crate) fn run<S: Show>(args: Args) -> Result<(), Box<dyn Error>> {
    let frames = args.number("frames", u64::MAX)?;
    let mut app = App::<S> { args, frames, open: None, failure: None };
    EventLoop::new()?.run_app(&mut app)?;
    app.failure.map_or(Ok(()), Err)
}

struct App<S> {
    args: Args,
    /// The number of frames that are left.
    frames: u64,
    open: Option<Open<S>>,
    failure: Option<Box<dyn Error>>,
}

/// The objects of an open window.
struct Open<S> {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    gpu: Gpu,
    depth: wgpu::TextureView,
    show: S,
    begin: Instant,
    last: Instant,
}

impl<S: Show> ApplicationHandler for App<S> {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        match Open::new(events, &self.args) {
            Ok(open) => self.open = Some(open),
            Err(error) => self.fail(events, error),
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else { return };
        let done = match event {
            WindowEvent::CloseRequested => {
                events.exit();
                Ok(())
            }
            WindowEvent::Resized(_) => {
                open.resize();
                Ok(())
            }
            WindowEvent::KeyboardInput {
                event: KeyEvent { logical_key, state: ElementState::Pressed, .. },
                ..
            } => match logical_key {
                Key::Named(NamedKey::Escape) => {
                    events.exit();
                    Ok(())
                }
                Key::Character(key) => open.show.press(&open.gpu, &key),
                _ => Ok(()),
            },
            WindowEvent::RedrawRequested => {
                self.frames -= 1;
                if self.frames == 0 {
                    events.exit();
                }
                open.frame()
            }
            _ => Ok(()),
        };
        if let Err(error) = done {
            self.fail(events, error);
        }
    }
}

impl<S> App<S> {
    fn fail(&mut self, events: &ActiveEventLoop, error: Box<dyn Error>) {
        self.failure = Some(error);
        events.exit();
    }
}

impl<S: Show> Open<S> {
    fn new(events: &ActiveEventLoop, args: &Args) -> Result<Self, Box<dyn Error>> {
        let window = Arc::new(events.create_window(Window::default_attributes())?);
        let display = Box::new(events.owned_display_handle());
        let descriptor = wgpu::InstanceDescriptor::new_with_display_handle(display);
        let instance = wgpu::Instance::new(descriptor.with_env());
        let surface = instance.create_surface(Arc::clone(&window))?;
        let options = wgpu::RequestAdapterOptions {
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))?;
        let wanted = wgpu::DeviceDescriptor {
            required_features: adapter.features() & wgpu::Features::POLYGON_MODE_LINE,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&wanted))?;
        let gpu = Gpu { device, queue, info: adapter.get_info() };
        let size = window.inner_size();
        let config = surface
            .get_default_config(&adapter, size.width.max(1), size.height.max(1))
            .ok_or("the window cannot be drawn into")?;
        let format = config.format.remove_srgb_suffix();
        let config = wgpu::SurfaceConfiguration { format, ..config };
        surface.configure(&gpu.device, &config);
        let depth = view_of(&texture(&gpu, DEPTH, [config.width, config.height]));
        let show = S::new(&gpu, format, args)?;
        window.request_redraw();
        let begin = Instant::now();
        Ok(Self { window, surface, config, gpu, depth, show, begin, last: begin })
    }

    fn resize(&mut self) {
        let size = self.window.inner_size();
        self.config.width = size.width.max(1);
        self.config.height = size.height.max(1);
        self.surface.configure(&self.gpu.device, &self.config);
        let size = [self.config.width, self.config.height];
        self.depth = view_of(&texture(&self.gpu, DEPTH, size));
    }

    fn frame(&mut self) -> Result<(), Box<dyn Error>> {
        use wgpu::CurrentSurfaceTexture as Current;
        self.window.request_redraw();
        let target = match self.surface.get_current_texture() {
            Current::Success(target) | Current::Suboptimal(target) => target,
            Current::Timeout | Current::Occluded => return Ok(()),
            Current::Outdated => {
                self.resize();
                return Ok(());
            }
            Current::Lost => return Err("the window's surface was lost".into()),
            Current::Validation => return Err("the window's surface is not valid".into()),
        };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let seconds = self.begin.elapsed().as_secs_f32();
        let size = [self.config.width, self.config.height];
        self.show.prepare(Frame { gpu: &self.gpu, encoder: &mut encoder, seconds, size })?;
        draw(&self.show, &mut encoder, [view_of(&target.texture), self.depth.clone()])?;
        self.gpu.queue.submit([encoder.finish()]);
        self.window.pre_present_notify();
        self.gpu.queue.present(target);
        let took = self.last.elapsed();
        self.last = Instant::now();
        let milliseconds = took.as_millis();
        self.window.set_title(&format!("{} - {milliseconds} ms", self.show.title()));
        Ok(())
    }
}
