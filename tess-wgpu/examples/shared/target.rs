//! Textures: render targets, their render pass and their pixels, and images that shaders read.

#![allow(dead_code, reason = "each user has its part")]

use tess_wgpu::Gpu;
use wgpu::TextureUsages as Usage;

/// Format of the depth buffer.
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The depth test of all examples.
pub(crate) fn depth() -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

/// A texture to draw into.
pub(crate) fn texture(gpu: &Gpu, format: wgpu::TextureFormat, size: [u32; 2]) -> wgpu::Texture {
    let usage = Usage::RENDER_ATTACHMENT | Usage::COPY_SRC | Usage::TEXTURE_BINDING;
    plain(gpu, format, size, usage)
}

/// A texture with one mip level and one layer.
pub(crate) fn plain(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
    usage: Usage,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// A texture with these texels, which shaders read.
pub(crate) fn image(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    size: [u32; 2],
    texels: &[u8],
) -> wgpu::TextureView {
    let texture = plain(gpu, format, size, Usage::TEXTURE_BINDING | Usage::COPY_DST);
    gpu.queue.write_texture(texture.as_image_copy(), texels, layout(&texture), texture.size());
    view_of(&texture)
}

pub(crate) fn view_of(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Records the copy of a texture's pixels, row by row.
pub(crate) fn copy_pixels(
    encoder: &mut wgpu::CommandEncoder,
    texture: &wgpu::Texture,
    buffer: &wgpu::Buffer,
) {
    let to = wgpu::TexelCopyBufferInfo { buffer, layout: layout(texture) };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
}

/// Rows without gaps.
fn layout(texture: &wgpu::Texture) -> wgpu::TexelCopyBufferLayout {
    let texel = texture.format().block_copy_size(None);
    let bytes_per_row = texel.map(|bytes| bytes * texture.width());
    wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: None }
}

/// Begins the render pass of a frame into a colour and a depth target.
pub(crate) fn begin_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    [color, depth]: [&wgpu::TextureView; 2],
    background: wgpu::Color,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(background),
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Discard,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}
