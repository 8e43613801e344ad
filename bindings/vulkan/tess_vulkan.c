#include "tess_vulkan.h"
#include "tess_shaders.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

struct buffer {
    VkBuffer handle;
    VkDeviceMemory memory;
    VkDeviceSize bytes;
};

struct tess_vulkan {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkPhysicalDeviceProperties properties;
    VkPhysicalDeviceMemoryProperties memory;
    VkDevice device;
    uint32_t family;
    VkQueue queue;
    VkCommandPool commands;
    VkQueryPool clock;
    uint32_t *tables;
    size_t tables_bytes;
    VkDescriptorSetLayout set_layouts[TESS_STAGES];
    VkPipelineLayout layouts[TESS_STAGES];
    VkPipeline pipelines[TESS_STAGES];
};

/* The objects of one batch. */
struct batch {
    struct buffer buffers[TESS_RESOURCES];
    struct buffer staging;
    char *mapped;
    VkDescriptorPool pool;
    VkDescriptorSet sets[TESS_MAX_DISPATCHES];
    VkCommandBuffer recorded;
};

/* Returns -1 from the enclosing function, with a message, if a Vulkan call fails. */
#define TRY(call)                                                                 \
    do {                                                                          \
        VkResult result_ = (call);                                                \
        if (result_ != VK_SUCCESS) {                                              \
            snprintf(message, 256, "%s gave %d", #call, (int)result_);            \
            return -1;                                                            \
        }                                                                         \
    } while (0)

static void *read_file(const char *folder, const char *name, const char *ending, size_t *bytes,
                       char message[256])
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s%s", folder, name, ending);
    FILE *file = fopen(path, "rb");
    if (!file) {
        snprintf(message, 256, "cannot open %.200s", path);
        return NULL;
    }
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    void *content = size > 0 ? malloc((size_t)size) : NULL;
    if (!content || fread(content, 1, (size_t)size, file) != (size_t)size) {
        snprintf(message, 256, "cannot read %.200s", path);
        free(content);
        content = NULL;
    }
    fclose(file);
    *bytes = content ? (size_t)size : 0;
    return content;
}

static int open_device(struct tess_vulkan *host, uint32_t number, char message[256])
{
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                     .apiVersion = VK_API_VERSION_1_1};
    VkInstanceCreateInfo instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                     .pApplicationInfo = &application};
    TRY(vkCreateInstance(&instance, NULL, &host->instance));
    VkPhysicalDevice devices[16];
    uint32_t count = 16;
    VkResult listed = vkEnumeratePhysicalDevices(host->instance, &count, devices);
    if ((listed != VK_SUCCESS && listed != VK_INCOMPLETE) || number >= count) {
        snprintf(message, 256, "there is no Vulkan device %u; there are %u", number, count);
        return -1;
    }
    host->physical = devices[number];
    vkGetPhysicalDeviceProperties(host->physical, &host->properties);
    vkGetPhysicalDeviceMemoryProperties(host->physical, &host->memory);
    VkQueueFamilyProperties families[16];
    uint32_t families_count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(host->physical, &families_count, families);
    for (host->family = 0; host->family < families_count; host->family++)
        if (families[host->family].queueFlags & VK_QUEUE_COMPUTE_BIT)
            break;
    if (host->family == families_count) {
        snprintf(message, 256, "the device has no compute queue");
        return -1;
    }
    float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                     .queueFamilyIndex = host->family,
                                     .queueCount = 1,
                                     .pQueuePriorities = &priority};
    VkDeviceCreateInfo device = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                 .queueCreateInfoCount = 1,
                                 .pQueueCreateInfos = &queue};
    TRY(vkCreateDevice(host->physical, &device, NULL, &host->device));
    vkGetDeviceQueue(host->device, host->family, 0, &host->queue);
    VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                    .queueFamilyIndex = host->family};
    TRY(vkCreateCommandPool(host->device, &pool, NULL, &host->commands));
    VkQueryPoolCreateInfo clock = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                   .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                   .queryCount = 2};
    TRY(vkCreateQueryPool(host->device, &clock, NULL, &host->clock));
    return 0;
}

static VkDescriptorType descriptor_type(const struct tess_binding *binding)
{
    return binding->is_uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                               : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

static int make_pipeline(struct tess_vulkan *host, uint32_t number, const char *folder,
                         char message[256])
{
    const struct tess_stage *stage = &tess_stages[number];
    VkDescriptorSetLayoutBinding bindings[TESS_MAX_BINDINGS];
    for (uint32_t i = 0; i < stage->bindings; i++)
        bindings[i] = (VkDescriptorSetLayoutBinding){.binding = i,
                                                     .descriptorType =
                                                         descriptor_type(&stage->binding[i]),
                                                     .descriptorCount = 1,
                                                     .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = stage->bindings,
        .pBindings = bindings};
    TRY(vkCreateDescriptorSetLayout(host->device, &set, NULL, &host->set_layouts[number]));
    VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                         .setLayoutCount = 1,
                                         .pSetLayouts = &host->set_layouts[number]};
    TRY(vkCreatePipelineLayout(host->device, &layout, NULL, &host->layouts[number]));
    size_t bytes;
    uint32_t *code = read_file(folder, stage->name, ".spv", &bytes, message);
    if (!code)
        return -1;
    VkShaderModuleCreateInfo module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                       .codeSize = bytes,
                                       .pCode = code};
    VkShaderModule shader = VK_NULL_HANDLE;
    VkResult made = vkCreateShaderModule(host->device, &module, NULL, &shader);
    free(code);
    TRY(made);
    VkComputePipelineCreateInfo pipeline = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = shader,
                  .pName = stage->entry_point},
        .layout = host->layouts[number]};
    made = vkCreateComputePipelines(host->device, VK_NULL_HANDLE, 1, &pipeline, NULL,
                                    &host->pipelines[number]);
    vkDestroyShaderModule(host->device, shader, NULL);
    TRY(made);
    return 0;
}

struct tess_vulkan *tess_vulkan_open(const char *folder, uint32_t device, char message[256])
{
    struct tess_vulkan *host = calloc(1, sizeof *host);
    if (!host) {
        snprintf(message, 256, "out of memory");
        return NULL;
    }
    int failed = open_device(host, device, message);
    for (uint32_t i = 0; !failed && i < TESS_STAGES; i++)
        failed = make_pipeline(host, i, folder, message);
    if (!failed) {
        host->tables = read_file(folder, TESS_TABLES_FILE, "", &host->tables_bytes, message);
        failed = !host->tables;
    }
    if (failed) {
        tess_vulkan_close(host);
        return NULL;
    }
    return host;
}

static int make_buffer(struct tess_vulkan *host, VkDeviceSize bytes, VkBufferUsageFlags usage,
                       VkMemoryPropertyFlags wanted, struct buffer *buffer, char message[256])
{
    buffer->bytes = bytes ? bytes : 16;
    VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                               .size = buffer->bytes,
                               .usage = usage};
    TRY(vkCreateBuffer(host->device, &info, NULL, &buffer->handle));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(host->device, buffer->handle, &needs);
    uint32_t type = 0;
    for (; type < host->memory.memoryTypeCount; type++)
        if (needs.memoryTypeBits >> type & 1 &&
            (host->memory.memoryTypes[type].propertyFlags & wanted) == wanted)
            break;
    if (type == host->memory.memoryTypeCount) {
        snprintf(message, 256, "the device has no memory of the kind %u", (unsigned)wanted);
        return -1;
    }
    VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = needs.size,
                                       .memoryTypeIndex = type};
    TRY(vkAllocateMemory(host->device, &allocation, NULL, &buffer->memory));
    TRY(vkBindBufferMemory(host->device, buffer->handle, buffer->memory, 0));
    return 0;
}

static int make_buffers(struct tess_vulkan *host, const struct tess_plan *plan,
                        const uint32_t variables[4], struct batch *batch, char message[256])
{
    VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
        VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
        VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkDeviceSize largest = 0;
    for (uint32_t i = 0; i < TESS_RESOURCES; i++) {
        VkDeviceSize bytes = tess_value(&plan->bytes[i], variables);
        if (bytes > host->properties.limits.maxStorageBufferRange) {
            snprintf(message, 256, "the batch needs a buffer of %llu bytes; cut it into smaller ones",
                     (unsigned long long)bytes);
            return -1;
        }
        if (make_buffer(host, bytes, usage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                        &batch->buffers[i], message))
            return -1;
        if (batch->buffers[i].bytes > largest)
            largest = batch->buffers[i].bytes;
    }
    if (make_buffer(host, largest, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                    &batch->staging, message))
        return -1;
    void *mapped;
    TRY(vkMapMemory(host->device, batch->staging.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    batch->mapped = mapped;
    return 0;
}

static int begin(struct tess_vulkan *host, struct batch *batch, char message[256])
{
    TRY(vkResetCommandPool(host->device, host->commands, 0));
    VkCommandBufferAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                       .commandPool = host->commands,
                                       .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                       .commandBufferCount = 1};
    if (!batch->recorded)
        TRY(vkAllocateCommandBuffers(host->device, &one, &batch->recorded));
    VkCommandBufferBeginInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    TRY(vkBeginCommandBuffer(batch->recorded, &info));
    return 0;
}

static int submit(struct tess_vulkan *host, struct batch *batch, char message[256])
{
    TRY(vkEndCommandBuffer(batch->recorded));
    VkSubmitInfo info = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                         .commandBufferCount = 1,
                         .pCommandBuffers = &batch->recorded};
    TRY(vkQueueSubmit(host->queue, 1, &info, VK_NULL_HANDLE));
    TRY(vkQueueWaitIdle(host->queue));
    return 0;
}

/* Copies from the staging buffer to a resource's buffer, or back. */
static int copy(struct tess_vulkan *host, struct batch *batch, uint32_t resource, size_t bytes,
                int to_device, char message[256])
{
    VkBuffer buffer = batch->buffers[resource].handle, staging = batch->staging.handle;
    VkBufferCopy region = {.size = bytes};
    if (bytes == 0)
        return 0;
    if (begin(host, batch, message))
        return -1;
    vkCmdCopyBuffer(batch->recorded, to_device ? staging : buffer, to_device ? buffer : staging, 1,
                    &region);
    return submit(host, batch, message);
}

/* Writes the resources that the host writes: jobs, factors and tables. */
static int upload(struct tess_vulkan *host, const struct tess_plan *plan,
                  const uint32_t variables[4], const uint32_t *factors, struct batch *batch,
                  char message[256])
{
    for (uint32_t resource = 0; resource < TESS_RESOURCES; resource++) {
        size_t bytes = 0;
        if (tess_hosts[resource] == TESS_HOST_WRITES_JOBS) {
            bytes = (size_t)plan->jobs * TESS_JOB_STRIDE;
            memset(batch->mapped, 0, bytes);
            for (uint32_t job = 0; job < plan->jobs; job++)
                for (uint32_t word = 0; word < TESS_JOB_WORDS; word++) {
                    uint32_t value = (uint32_t)tess_value(&plan->job[job][word], variables);
                    memcpy(batch->mapped + job * TESS_JOB_STRIDE + 4 * word, &value, 4);
                }
        } else if (tess_hosts[resource] == TESS_HOST_WRITES_FACTORS) {
            bytes = (size_t)variables[TESS_OF_PATCHES] * TESS_FACTORS_PER_PATCH * 4;
            memcpy(batch->mapped, factors, bytes);
        } else if (tess_hosts[resource] == TESS_HOST_WRITES_TABLES) {
            bytes = host->tables_bytes;
            memcpy(batch->mapped, host->tables, bytes);
        }
        if (copy(host, batch, resource, bytes, 1, message))
            return -1;
    }
    return 0;
}

static int make_sets(struct tess_vulkan *host, const struct tess_plan *plan,
                     const uint32_t variables[4], struct batch *batch, char message[256])
{
    VkDescriptorPoolSize sizes[2] = {
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, TESS_MAX_DISPATCHES * TESS_MAX_BINDINGS},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, TESS_MAX_DISPATCHES * TESS_MAX_BINDINGS}};
    VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                       .maxSets = TESS_MAX_DISPATCHES,
                                       .poolSizeCount = 2,
                                       .pPoolSizes = sizes};
    TRY(vkCreateDescriptorPool(host->device, &pool, NULL, &batch->pool));
    for (uint32_t i = 0; i < plan->dispatches; i++) {
        const struct tess_dispatch *dispatch = &plan->dispatch[i];
        const struct tess_stage *stage = &tess_stages[dispatch->stage];
        VkDescriptorSetAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = batch->pool,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &host->set_layouts[dispatch->stage]};
        TRY(vkAllocateDescriptorSets(host->device, &one, &batch->sets[i]));
        for (uint32_t b = 0; b < stage->bindings; b++) {
            const struct buffer *buffer = &batch->buffers[stage->binding[b].resource];
            VkDeviceSize bytes = tess_value(&dispatch->binding[b].bytes, variables);
            VkDescriptorBufferInfo bound = {.buffer = buffer->handle,
                                            .offset = tess_value(&dispatch->binding[b].offset, variables),
                                            .range = bytes ? bytes : VK_WHOLE_SIZE};
            VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                          .dstSet = batch->sets[i],
                                          .dstBinding = b,
                                          .descriptorCount = 1,
                                          .descriptorType = descriptor_type(&stage->binding[b]),
                                          .pBufferInfo = &bound};
            vkUpdateDescriptorSets(host->device, 1, &write, 0, NULL);
        }
    }
    return 0;
}

/* Makes the writes of earlier commands visible to later ones, including as indirect arguments. */
static void barrier(VkCommandBuffer recorded)
{
    VkMemoryBarrier all = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                           .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
                           .dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                                            VK_ACCESS_INDIRECT_COMMAND_READ_BIT |
                                            VK_ACCESS_TRANSFER_READ_BIT |
                                            VK_ACCESS_TRANSFER_WRITE_BIT};
    VkPipelineStageFlags stages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    vkCmdPipelineBarrier(recorded, stages, stages | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &all, 0,
                         NULL, 0, NULL);
}

static int dispatch_all(struct tess_vulkan *host, const struct tess_plan *plan,
                        const uint32_t variables[4], int is_first, struct batch *batch,
                        char message[256])
{
    if (begin(host, batch, message))
        return -1;
    for (uint32_t resource = 0; is_first && resource < TESS_RESOURCES; resource++)
        if (tess_hosts[resource] == TESS_HOST_CLEARS)
            vkCmdFillBuffer(batch->recorded, batch->buffers[resource].handle, 0, VK_WHOLE_SIZE, 0);
    barrier(batch->recorded);
    vkCmdResetQueryPool(batch->recorded, host->clock, 0, 2);
    vkCmdWriteTimestamp(batch->recorded, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, host->clock, 0);
    for (uint32_t i = 0; i < plan->dispatches; i++) {
        const struct tess_dispatch *dispatch = &plan->dispatch[i];
        uint64_t workgroups = tess_value(&dispatch->workgroups, variables);
        vkCmdBindPipeline(batch->recorded, VK_PIPELINE_BIND_POINT_COMPUTE,
                          host->pipelines[dispatch->stage]);
        vkCmdBindDescriptorSets(batch->recorded, VK_PIPELINE_BIND_POINT_COMPUTE,
                                host->layouts[dispatch->stage], 0, 1, &batch->sets[i], 0, NULL);
        if (dispatch->is_indirect) {
            vkCmdDispatchIndirect(batch->recorded, batch->buffers[TESS_ARGUMENTS].handle, workgroups);
        } else if (workgroups > 0) {
            uint64_t row = variables[TESS_OF_MAX_WORKGROUPS];
            uint32_t x = (uint32_t)(workgroups < row ? workgroups : row);
            vkCmdDispatch(batch->recorded, x, (uint32_t)((workgroups + x - 1) / x), 1);
        }
        barrier(batch->recorded);
    }
    vkCmdWriteTimestamp(batch->recorded, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, host->clock, 1);
    return submit(host, batch, message);
}

/* Copies the beginning of a resource to the caller's memory. */
static int download(struct tess_vulkan *host, struct batch *batch, uint32_t resource, void *to,
                    size_t bytes, char message[256])
{
    if (copy(host, batch, resource, bytes, 0, message))
        return -1;
    memcpy(to, batch->mapped, bytes);
    return 0;
}

static int read_output(struct tess_vulkan *host, struct batch *batch, struct tess_output *output,
                       char message[256])
{
    struct tess_status status;
    if (download(host, batch, TESS_STATUS, &status, sizeof status, message) ||
        download(host, batch, TESS_ARGUMENTS, output->draw, sizeof output->draw, message))
        return -1;
    output->needed_points = status.points | (uint64_t)status.points_high << 32;
    output->needed_primitives = status.primitives | (uint64_t)status.primitives_high << 32;
    output->overflow = status.overflow;
    if (status.overflow)
        return 0;
    size_t points = (size_t)output->needed_points * TESS_BYTES_PER_POINT;
    size_t indices = (size_t)output->draw[0] * TESS_BYTES_PER_INDEX;
    output->points = malloc(points ? points : 1);
    output->indices = malloc(indices ? indices : 1);
    if (!output->points || !output->indices) {
        snprintf(message, 256, "out of memory");
        return -1;
    }
    return download(host, batch, TESS_POINTS, output->points, points, message) ||
                   download(host, batch, TESS_INDICES, output->indices, indices, message)
               ? -1
               : 0;
}

static int run(struct tess_vulkan *host, const struct tess_plan *plan, const uint32_t variables[4],
               const uint32_t *factors, uint32_t runs, struct batch *batch,
               struct tess_output *output, char message[256])
{
    if (make_buffers(host, plan, variables, batch, message) ||
        upload(host, plan, variables, factors, batch, message) ||
        make_sets(host, plan, variables, batch, message))
        return -1;
    for (uint32_t i = 0; i < runs || i == 0; i++) {
        uint64_t ticks[2];
        if (dispatch_all(host, plan, variables, i == 0, batch, message))
            return -1;
        TRY(vkGetQueryPoolResults(host->device, host->clock, 0, 2, sizeof ticks, ticks, 8,
                                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
        double period = (double)host->properties.limits.timestampPeriod;
        double milliseconds = (double)(ticks[1] - ticks[0]) * period * 1e-6;
        if (i == 0 || milliseconds < output->milliseconds)
            output->milliseconds = milliseconds;
    }
    return read_output(host, batch, output, message);
}

static void free_batch(struct tess_vulkan *host, struct batch *batch)
{
    for (uint32_t i = 0; i <= TESS_RESOURCES; i++) {
        struct buffer *buffer = i < TESS_RESOURCES ? &batch->buffers[i] : &batch->staging;
        vkDestroyBuffer(host->device, buffer->handle, NULL);
        vkFreeMemory(host->device, buffer->memory, NULL);
    }
    vkDestroyDescriptorPool(host->device, batch->pool, NULL);
    if (batch->recorded)
        vkFreeCommandBuffers(host->device, host->commands, 1, &batch->recorded);
}

int tess_vulkan_run(struct tess_vulkan *host, const uint32_t *factors, uint32_t patches,
                    uint32_t points, uint32_t primitives, uint32_t runs,
                    struct tess_output *output, char message[256])
{
    memset(output, 0, sizeof *output);
    if (patches == 0)
        return 0;
    for (uint32_t i = 0; i < TESS_PLANS; i++) {
        const struct tess_plan *plan = &tess_plans[i];
        if (patches < plan->min_patches || patches > plan->max_patches ||
            points > plan->max_points || primitives > plan->max_primitives)
            continue;
        uint32_t variables[4];
        variables[TESS_OF_PATCHES] = patches;
        variables[TESS_OF_POINTS] = points ? points : 1;
        variables[TESS_OF_PRIMITIVES] = primitives ? primitives : 1;
        variables[TESS_OF_MAX_WORKGROUPS] = host->properties.limits.maxComputeWorkGroupCount[0];
        struct batch batch = {0};
        int failed = run(host, plan, variables, factors, runs, &batch, output, message);
        free_batch(host, &batch);
        if (failed)
            tess_output_free(output);
        return failed;
    }
    snprintf(message, 256, "no plan for %u patches with room for %u points and %u primitives", patches,
             points, primitives);
    return -1;
}

void tess_output_free(struct tess_output *output)
{
    free(output->points);
    free(output->indices);
    memset(output, 0, sizeof *output);
}

void tess_vulkan_close(struct tess_vulkan *host)
{
    if (host->device) {
        for (uint32_t i = 0; i < TESS_STAGES; i++) {
            vkDestroyPipeline(host->device, host->pipelines[i], NULL);
            vkDestroyPipelineLayout(host->device, host->layouts[i], NULL);
            vkDestroyDescriptorSetLayout(host->device, host->set_layouts[i], NULL);
        }
        vkDestroyQueryPool(host->device, host->clock, NULL);
        vkDestroyCommandPool(host->device, host->commands, NULL);
        vkDestroyDevice(host->device, NULL);
    }
    if (host->instance)
        vkDestroyInstance(host->instance, NULL);
    free(host->tables);
    free(host);
}
