//! Render passes and pipelines, with or without tessellation.

use super::{DeviceBuffer, Gpu, Interface, Owned, Sets};
use crate::error::Error;
use ash::prelude::VkResult;
use ash::vk;
use std::sync::Arc;

/// The SPIR-V of a stage.
pub(crate) type Shader<'a> = (vk::ShaderStageFlags, &'a [u32]);

/// The shaders' interface: storage buffers in set 0, numbered from 0, and two words of push
/// constants.
#[derive(Debug)]
pub(crate) struct BoundInterface {
    pub(crate) set: vk::DescriptorSet,
    _sets: Sets,
    interface: Interface,
}

/// The stages that use buffers and constants.
pub(crate) const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::ALL_GRAPHICS;

impl BoundInterface {
    /// An interface with these buffers bound.
    pub(crate) fn new(gpu: &Arc<Gpu>, buffers: &[&DeviceBuffer]) -> Result<Self, Error> {
        let ty = vk::DescriptorType::STORAGE_BUFFER;
        let interface = Interface::new(gpu, STAGES, buffers.iter().map(|_| ty), 8)?;
        let sets = Sets::new(gpu, 1, buffers.len())?;
        let bound = buffers.iter().map(|buffer| (ty, *buffer.handle, 0, vk::WHOLE_SIZE));
        let set = sets.bind(&interface, bound)?;
        Ok(Self { set, _sets: sets, interface })
    }

    pub(crate) fn layout(&self) -> vk::PipelineLayout {
        *self.interface.layout
    }
}

/// A render pass with its framebuffer: without an attachment, or with one of 8-bit RGBA.
#[derive(Debug)]
pub(crate) struct DrawPass {
    gpu: Arc<Gpu>,
    framebuffer: Owned<vk::Framebuffer>,
    pass: Owned<vk::RenderPass>,
    /// The image to which it draws, if it draws.
    image: Option<Image>,
    size: u32,
}

const FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;

/// An image with its memory and a view of it.
#[derive(Debug)]
struct Image {
    view: Owned<vk::ImageView>,
    _image: Owned<vk::Image>,
    _memory: Owned<vk::DeviceMemory>,
}

impl Image {
    /// An image of `size` by `size` pixels.
    fn new(gpu: &Arc<Gpu>, size: u32) -> Result<Self, Error> {
        let device = &gpu.device;
        let create = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(FORMAT)
            .extent(vk::Extent3D { width: size, height: size, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::COLOR_ATTACHMENT);
        let calls = (ash::Device::create_image as _, ash::Device::destroy_image as _);
        // SAFETY: every device can draw to images of this format and usage.
        let image = unsafe { Owned::new(gpu, "vkCreateImage", calls, &create) }?;
        // SAFETY: the image is the device's.
        let needs = unsafe { device.get_image_memory_requirements(*image) };
        let allocate = vk::MemoryAllocateInfo::default()
            .allocation_size(needs.size)
            .memory_type_index(needs.memory_type_bits.trailing_zeros());
        let calls = (ash::Device::allocate_memory as _, ash::Device::free_memory as _);
        // SAFETY: the image accepts memory of this type.
        let memory = unsafe { Owned::new(gpu, "vkAllocateMemory", calls, &allocate) }?;
        // SAFETY: both are new and the memory is large enough.
        unsafe { device.bind_image_memory(*image, *memory, 0) }
            .map_err(Error::of("vkBindImageMemory"))?;
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(vk::ImageAspectFlags::COLOR)
            .level_count(1)
            .layer_count(1);
        let create = vk::ImageViewCreateInfo::default()
            .image(*image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(FORMAT)
            .subresource_range(range);
        let calls = (ash::Device::create_image_view as _, ash::Device::destroy_image_view as _);
        // SAFETY: the image has memory and this format.
        let view = unsafe { Owned::new(gpu, "vkCreateImageView", calls, &create) }?;
        Ok(Self { view, _image: image, _memory: memory })
    }
}

impl DrawPass {
    /// A pass of `size` by `size` pixels; without `draws` it has no image.
    pub(crate) fn new(gpu: &Arc<Gpu>, size: u32, draws: bool) -> Result<Self, Error> {
        let image = draws.then(|| Image::new(gpu, size)).transpose()?;
        let attachments = [vk::AttachmentDescription::default()
            .format(FORMAT)
            .samples(vk::SampleCountFlags::TYPE_1)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .final_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
        let references =
            [vk::AttachmentReference::default().layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
        let used = usize::from(draws);
        let subpasses = [vk::SubpassDescription::default().color_attachments(&references[..used])];
        let create = vk::RenderPassCreateInfo::default()
            .attachments(&attachments[..used])
            .subpasses(&subpasses);
        let calls = (ash::Device::create_render_pass as _, ash::Device::destroy_render_pass as _);
        // SAFETY: the structures live through the call.
        let pass = unsafe { Owned::new(gpu, "vkCreateRenderPass", calls, &create) }?;
        let views: Vec<vk::ImageView> = image.iter().map(|image| *image.view).collect();
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(*pass)
            .attachments(&views)
            .width(size)
            .height(size)
            .layers(1);
        let calls = (ash::Device::create_framebuffer as _, ash::Device::destroy_framebuffer as _);
        // SAFETY: the view has the attachment's format.
        let framebuffer = unsafe { Owned::new(gpu, "vkCreateFramebuffer", calls, &create) }?;
        Ok(Self { gpu: Arc::clone(gpu), framebuffer, pass, image, size })
    }

    fn area(&self) -> vk::Rect2D {
        let extent = vk::Extent2D { width: self.size, height: self.size };
        vk::Rect2D { offset: vk::Offset2D::default(), extent }
    }

    /// Records `draws` inside of the pass.
    pub(crate) fn record(&self, commands: vk::CommandBuffer, draws: impl FnOnce(&ash::Device)) {
        let device = &self.gpu.device;
        let clear = [vk::ClearValue::default()];
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(*self.pass)
            .framebuffer(*self.framebuffer)
            .render_area(self.area())
            .clear_values(&clear[..usize::from(self.image.is_some())]);
        // SAFETY: the command buffer is being recorded, and the pass outlives the recorded
        // commands: they are submitted and waited for while the caller borrows it.
        unsafe { device.cmd_begin_render_pass(commands, &begin, vk::SubpassContents::INLINE) };
        draws(device);
        // SAFETY: the pass was begun above.
        unsafe { device.cmd_end_render_pass(commands) };
    }
}

/// The source of a pipeline's vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vertices {
    /// A tessellator that receives patches of one vertex.
    Patches,
    /// A buffer of points, two words each, as triangles.
    Points,
}

/// A graphics pipeline.
pub(crate) type Pipeline = Owned<vk::Pipeline>;

/// A SPIR-V module. A pipeline needs its modules only during its creation.
pub(super) fn module(gpu: &Arc<Gpu>, words: &[u32]) -> Result<Owned<vk::ShaderModule>, Error> {
    let create = vk::ShaderModuleCreateInfo::default().code(words);
    let calls = (ash::Device::create_shader_module as _, ash::Device::destroy_shader_module as _);
    // SAFETY: the words are from naga, or are SPIR-V that spirv-val accepts, except for the modes
    // that `modes.rs` replaces by others of the same kind.
    unsafe { Owned::new(gpu, "vkCreateShaderModule", calls, &create) }
}

/// A pipeline of these shaders. It rasterises if the pass has pixels.
pub(crate) fn pipeline(
    gpu: &Arc<Gpu>,
    program: &BoundInterface,
    pass: &DrawPass,
    shaders: &[Shader<'_>],
    vertices: Vertices,
) -> Result<Pipeline, Error> {
    let module = |&(stage, words): &Shader<'_>| Ok((stage, module(gpu, words)?));
    let modules: Vec<_> = shaders.iter().map(module).collect::<Result<_, Error>>()?;
    let stage = |(stage, module): &(_, Owned<_>)| {
        vk::PipelineShaderStageCreateInfo::default().stage(*stage).module(**module).name(c"main")
    };
    let stages: Vec<_> = modules.iter().map(stage).collect();
    let bindings = [vk::VertexInputBindingDescription::default().stride(8)];
    let attributes =
        [vk::VertexInputAttributeDescription::default().format(vk::Format::R32G32_UINT)];
    let (used, topology) = match vertices {
        Vertices::Patches => (0, vk::PrimitiveTopology::PATCH_LIST),
        Vertices::Points => (1, vk::PrimitiveTopology::TRIANGLE_LIST),
    };
    let input = vk::PipelineVertexInputStateCreateInfo::default()
        .vertex_binding_descriptions(&bindings[..used])
        .vertex_attribute_descriptions(&attributes[..used]);
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(topology);
    let tessellation = vk::PipelineTessellationStateCreateInfo::default().patch_control_points(1);
    let area = pass.area();
    #[expect(clippy::cast_precision_loss, reason = "a few thousand pixels")]
    let size = pass.size as f32;
    let viewports =
        [vk::Viewport { width: size, height: size, max_depth: 1.0, ..Default::default() }];
    let scissors = [area];
    let viewport =
        vk::PipelineViewportStateCreateInfo::default().viewports(&viewports).scissors(&scissors);
    let raster = vk::PipelineRasterizationStateCreateInfo::default()
        .rasterizer_discard_enable(pass.image.is_none())
        .line_width(1.0);
    let samples = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let blends = [vk::PipelineColorBlendAttachmentState::default()
        .color_write_mask(vk::ColorComponentFlags::RGBA)];
    let blend = vk::PipelineColorBlendStateCreateInfo::default()
        .attachments(&blends[..usize::from(pass.image.is_some())]);
    let mut create = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&samples)
        .color_blend_state(&blend)
        .layout(program.layout())
        .render_pass(*pass.pass);
    if vertices == Vertices::Patches {
        create = create.tessellation_state(&tessellation);
    }
    let calls = (graphics_pipeline as _, ash::Device::destroy_pipeline as _);
    // SAFETY: all handles are the device's, and the structures live through the call.
    unsafe { Owned::new(gpu, "vkCreateGraphicsPipelines", calls, &create) }
}

/// `vkCreateGraphicsPipelines` for one pipeline.
///
/// # Safety
/// As for that function.
unsafe fn graphics_pipeline(
    device: &ash::Device,
    create: &vk::GraphicsPipelineCreateInfo<'_>,
    callbacks: Option<&vk::AllocationCallbacks<'_>>,
) -> VkResult<vk::Pipeline> {
    let (cache, create) = (vk::PipelineCache::null(), [*create]);
    // SAFETY: the caller guarantees it.
    let made = unsafe { device.create_graphics_pipelines(cache, &create, callbacks) };
    made.map(|pipelines| pipelines[0]).map_err(|(_, result)| result)
}
