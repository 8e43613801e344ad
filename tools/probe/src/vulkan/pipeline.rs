//! Render passes and pipelines with or without tessellation.

use super::{Buffer, Gpu};
use crate::error::Error;
use ash::vk;
use std::sync::Arc;

/// The SPIR-V of a stage.
pub(crate) type Shader<'a> = (vk::ShaderStageFlags, &'a [u32]);

/// The shaders' interface: storage buffers in set 0, numbered from 0, and two words of push constants.
#[derive(Debug)]
pub(crate) struct Program {
    gpu: Arc<Gpu>,
    set_layout: vk::DescriptorSetLayout,
    pub(crate) layout: vk::PipelineLayout,
    pool: vk::DescriptorPool,
    pub(crate) set: vk::DescriptorSet,
}

/// The stages that see buffers and constants.
pub(crate) const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::ALL_GRAPHICS;

impl Program {
    /// An interface with these buffers bound.
    pub(crate) fn new(gpu: &Arc<Gpu>, buffers: &[&Buffer]) -> Result<Self, Error> {
        let mut program = Self {
            gpu: Arc::clone(gpu),
            set_layout: vk::DescriptorSetLayout::null(),
            layout: vk::PipelineLayout::null(),
            pool: vk::DescriptorPool::null(),
            set: vk::DescriptorSet::null(),
        };
        program.make(buffers)?;
        Ok(program)
    }

    fn make(&mut self, buffers: &[&Buffer]) -> Result<(), Error> {
        let device = &self.gpu.device;
        let ty = vk::DescriptorType::STORAGE_BUFFER;
        let binding = |(number, _)| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(number)
                .descriptor_type(ty)
                .descriptor_count(1)
                .stage_flags(STAGES)
        };
        let bindings: Vec<_> = (0..).zip(buffers).map(binding).collect();
        let create = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the structures live through the call.
        self.set_layout = unsafe { device.create_descriptor_set_layout(&create, None) }
            .map_err(Error::of("vkCreateDescriptorSetLayout"))?;
        let layouts = [self.set_layout];
        let constants = [vk::PushConstantRange::default().stage_flags(STAGES).size(8)];
        let create = vk::PipelineLayoutCreateInfo::default()
            .set_layouts(&layouts)
            .push_constant_ranges(&constants);
        // SAFETY: as above; the layout of the set is the device's.
        self.layout = unsafe { device.create_pipeline_layout(&create, None) }
            .map_err(Error::of("vkCreatePipelineLayout"))?;
        let count = u32::try_from(buffers.len()).unwrap_or(u32::MAX).max(1);
        let sizes = [vk::DescriptorPoolSize::default().ty(ty).descriptor_count(count)];
        let create = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: as above.
        self.pool = unsafe { device.create_descriptor_pool(&create, None) }
            .map_err(Error::of("vkCreateDescriptorPool"))?;
        let allocate = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(self.pool)
            .set_layouts(&layouts);
        // SAFETY: the pool has room for this set.
        let sets = unsafe { device.allocate_descriptor_sets(&allocate) }
            .map_err(Error::of("vkAllocateDescriptorSets"))?;
        self.set = sets[0];
        for (number, buffer) in (0..).zip(buffers) {
            let bound =
                [vk::DescriptorBufferInfo::default().buffer(buffer.handle).range(vk::WHOLE_SIZE)];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(self.set)
                .dst_binding(number)
                .descriptor_type(ty)
                .buffer_info(&bound);
            // SAFETY: nothing runs that uses the set.
            unsafe { device.update_descriptor_sets(&[write], &[]) };
        }
        Ok(())
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let device = &self.gpu.device;
        // SAFETY: nothing runs, as each submission is waited for; null is allowed.
        unsafe {
            device.destroy_descriptor_pool(self.pool, None);
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

/// A render pass with its framebuffer: without an attachment, or with one of 8-bit RGBA.
#[derive(Debug)]
pub(crate) struct Pass {
    gpu: Arc<Gpu>,
    pub(crate) pass: vk::RenderPass,
    framebuffer: vk::Framebuffer,
    image: vk::Image,
    memory: vk::DeviceMemory,
    view: vk::ImageView,
    size: u32,
    draws: bool,
}

const FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;

impl Pass {
    /// A pass of `size` by `size` pixels; without `draws` there are none to write.
    pub(crate) fn new(gpu: &Arc<Gpu>, size: u32, draws: bool) -> Result<Self, Error> {
        let mut pass = Self {
            gpu: Arc::clone(gpu),
            pass: vk::RenderPass::null(),
            framebuffer: vk::Framebuffer::null(),
            image: vk::Image::null(),
            memory: vk::DeviceMemory::null(),
            view: vk::ImageView::null(),
            size,
            draws,
        };
        if draws {
            pass.make_image()?;
        }
        pass.make_pass()?;
        Ok(pass)
    }

    fn make_image(&mut self) -> Result<(), Error> {
        let device = &self.gpu.device;
        let create = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(FORMAT)
            .extent(vk::Extent3D { width: self.size, height: self.size, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::COLOR_ATTACHMENT);
        // SAFETY: every device draws to images of this format and usage.
        self.image =
            unsafe { device.create_image(&create, None) }.map_err(Error::of("vkCreateImage"))?;
        // SAFETY: the image is the device's.
        let needs = unsafe { device.get_image_memory_requirements(self.image) };
        let allocate = vk::MemoryAllocateInfo::default()
            .allocation_size(needs.size)
            .memory_type_index(needs.memory_type_bits.trailing_zeros());
        // SAFETY: the type is one of those that the image takes.
        self.memory = unsafe { device.allocate_memory(&allocate, None) }
            .map_err(Error::of("vkAllocateMemory"))?;
        // SAFETY: both are new and the memory is large enough.
        unsafe { device.bind_image_memory(self.image, self.memory, 0) }
            .map_err(Error::of("vkBindImageMemory"))?;
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(vk::ImageAspectFlags::COLOR)
            .level_count(1)
            .layer_count(1);
        let create = vk::ImageViewCreateInfo::default()
            .image(self.image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(FORMAT)
            .subresource_range(range);
        // SAFETY: the image has memory and this format.
        self.view = unsafe { device.create_image_view(&create, None) }
            .map_err(Error::of("vkCreateImageView"))?;
        Ok(())
    }

    fn make_pass(&mut self) -> Result<(), Error> {
        let device = &self.gpu.device;
        let attachments = [vk::AttachmentDescription::default()
            .format(FORMAT)
            .samples(vk::SampleCountFlags::TYPE_1)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .final_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
        let references =
            [vk::AttachmentReference::default().layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
        let used = usize::from(self.draws);
        let subpasses = [vk::SubpassDescription::default().color_attachments(&references[..used])];
        let create = vk::RenderPassCreateInfo::default()
            .attachments(&attachments[..used])
            .subpasses(&subpasses);
        // SAFETY: the structures live through the call.
        self.pass = unsafe { device.create_render_pass(&create, None) }
            .map_err(Error::of("vkCreateRenderPass"))?;
        let views = [self.view];
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(self.pass)
            .attachments(&views[..used])
            .width(self.size)
            .height(self.size)
            .layers(1);
        // SAFETY: the view has the attachment's format.
        self.framebuffer = unsafe { device.create_framebuffer(&create, None) }
            .map_err(Error::of("vkCreateFramebuffer"))?;
        Ok(())
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
            .render_pass(self.pass)
            .framebuffer(self.framebuffer)
            .render_area(self.area())
            .clear_values(&clear[..usize::from(self.draws)]);
        // SAFETY: the command buffer is being recorded, and the pass outlives what is recorded: it is
        // submitted and waited for while the caller borrows it.
        unsafe { device.cmd_begin_render_pass(commands, &begin, vk::SubpassContents::INLINE) };
        draws(device);
        // SAFETY: the pass was begun above.
        unsafe { device.cmd_end_render_pass(commands) };
    }
}

impl Drop for Pass {
    fn drop(&mut self) {
        let device = &self.gpu.device;
        // SAFETY: nothing runs, as each submission is waited for; null is allowed.
        unsafe {
            device.destroy_framebuffer(self.framebuffer, None);
            device.destroy_render_pass(self.pass, None);
            device.destroy_image_view(self.view, None);
            device.destroy_image(self.image, None);
            device.free_memory(self.memory, None);
        }
    }
}

/// Where the vertices of a pipeline come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vertices {
    /// From a tessellator that is given patches of one vertex.
    Patches,
    /// From a buffer of points, two words each, as triangles.
    Points,
}

/// A graphics pipeline.
#[derive(Debug)]
pub(crate) struct Pipeline {
    gpu: Arc<Gpu>,
    pub(crate) handle: vk::Pipeline,
}

impl Pipeline {
    /// A pipeline of these shaders; it rasterises if the pass has pixels.
    pub(crate) fn new(
        gpu: &Arc<Gpu>,
        program: &Program,
        pass: &Pass,
        shaders: &[Shader<'_>],
        vertices: Vertices,
    ) -> Result<Self, Error> {
        let mut modules = Vec::new();
        let made = modules_of(gpu, shaders, &mut modules)
            .and_then(|()| pipeline(gpu, program, pass, &modules, vertices));
        for (_, module) in modules {
            // SAFETY: a pipeline needs its modules only while it is made.
            unsafe { gpu.device.destroy_shader_module(module, None) };
        }
        made.map(|handle| Self { gpu: Arc::clone(gpu), handle })
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        // SAFETY: nothing runs, as each submission is waited for.
        unsafe { self.gpu.device.destroy_pipeline(self.handle, None) };
    }
}

fn modules_of(
    gpu: &Gpu,
    shaders: &[Shader<'_>],
    modules: &mut Vec<(vk::ShaderStageFlags, vk::ShaderModule)>,
) -> Result<(), Error> {
    for &(stage, words) in shaders {
        let create = vk::ShaderModuleCreateInfo::default().code(words);
        // SAFETY: the words are SPIR-V that spirv-val accepts, but for the modes that `modes.rs`
        // replaces by others of the same kind.
        let module = unsafe { gpu.device.create_shader_module(&create, None) };
        modules.push((stage, module.map_err(Error::of("vkCreateShaderModule"))?));
    }
    Ok(())
}

fn pipeline(
    gpu: &Gpu,
    program: &Program,
    pass: &Pass,
    modules: &[(vk::ShaderStageFlags, vk::ShaderModule)],
    vertices: Vertices,
) -> Result<vk::Pipeline, Error> {
    let stage = |&(stage, module): &_| {
        vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main")
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
        .rasterizer_discard_enable(!pass.draws)
        .line_width(1.0);
    let samples = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let blends = [vk::PipelineColorBlendAttachmentState::default()
        .color_write_mask(vk::ColorComponentFlags::RGBA)];
    let blend = vk::PipelineColorBlendStateCreateInfo::default()
        .attachments(&blends[..usize::from(pass.draws)]);
    let mut create = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&samples)
        .color_blend_state(&blend)
        .layout(program.layout)
        .render_pass(pass.pass);
    if vertices == Vertices::Patches {
        create = create.tessellation_state(&tessellation);
    }
    let cache = vk::PipelineCache::null();
    // SAFETY: all handles are the device's, and the structures live through the call.
    let made = unsafe { gpu.device.create_graphics_pipelines(cache, &[create], None) };
    made.map(|pipelines| pipelines[0])
        .map_err(|(_, result)| Error::of("vkCreateGraphicsPipelines")(result))
}
