/* A Vulkan layer that loses the device, as a driver does after a hang: once TESS_LOSE_AFTER submissions have gone
 * through, TESS_LOSE_AT says which calls return VK_ERROR_DEVICE_LOST: `submit`, or `wait` (asking for progress). */

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

static PFN_vkGetInstanceProcAddr of_instance;
static PFN_vkGetDeviceProcAddr of_device;
static VkInstance instance;
static atomic_long submissions_left;
static atomic_bool loses_submit, loses_wait;

#define NEXT(device, name) ((PFN_##name)of_device(device, #name))

/* The one device: a queue does not say whose it is. */
static VkDevice device;

static bool is_over(void) { return atomic_load(&submissions_left) <= 0; }

static VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo *infos, VkFence fence) {
    if (atomic_load(&loses_submit) && is_over())
        return VK_ERROR_DEVICE_LOST;
    atomic_fetch_sub(&submissions_left, 1);
    return NEXT(device, vkQueueSubmit)(queue, count, infos, fence);
}

static bool is_lost(void) { return atomic_load(&loses_wait) && is_over(); }

static VKAPI_ATTR VkResult VKAPI_CALL wait_fences(VkDevice on, uint32_t count, const VkFence *fences, VkBool32 all,
                                                  uint64_t timeout) {
    return is_lost() ? VK_ERROR_DEVICE_LOST : NEXT(on, vkWaitForFences)(on, count, fences, all, timeout);
}

static VKAPI_ATTR VkResult VKAPI_CALL fence_status(VkDevice on, VkFence fence) {
    return is_lost() ? VK_ERROR_DEVICE_LOST : NEXT(on, vkGetFenceStatus)(on, fence);
}

static VKAPI_ATTR VkResult VKAPI_CALL wait_semaphores(VkDevice on, const VkSemaphoreWaitInfo *info, uint64_t timeout) {
    return is_lost() ? VK_ERROR_DEVICE_LOST : NEXT(on, vkWaitSemaphores)(on, info, timeout);
}

static VKAPI_ATTR VkResult VKAPI_CALL semaphore_value(VkDevice on, VkSemaphore semaphore, uint64_t *value) {
    return is_lost() ? VK_ERROR_DEVICE_LOST : NEXT(on, vkGetSemaphoreCounterValue)(on, semaphore, value);
}

static VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo *info,
                                                      const VkAllocationCallbacks *allocator, VkInstance *created) {
    VkLayerInstanceCreateInfo *link = (VkLayerInstanceCreateInfo *)info->pNext;
    while (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
        link = (VkLayerInstanceCreateInfo *)link->pNext;
    of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    return ((PFN_vkCreateInstance)of_instance(NULL, "vkCreateInstance"))(info, allocator, created);
}

static VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo *info,
                                                    const VkAllocationCallbacks *allocator, VkDevice *created) {
    VkLayerDeviceCreateInfo *link = (VkLayerDeviceCreateInfo *)info->pNext;
    while (link->sType != VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)
        link = (VkLayerDeviceCreateInfo *)link->pNext;
    PFN_vkCreateDevice create =
        (PFN_vkCreateDevice)link->u.pLayerInfo->pfnNextGetInstanceProcAddr(instance, "vkCreateDevice");
    of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    VkResult result = create(physical, info, allocator, created);
    device = *created;
    atomic_store(&submissions_left, atol(getenv("TESS_LOSE_AFTER")));
    atomic_store(&loses_submit, strcmp(getenv("TESS_LOSE_AT"), "submit") == 0);
    atomic_store(&loses_wait, strcmp(getenv("TESS_LOSE_AT"), "wait") == 0);
    return result;
}

static PFN_vkVoidFunction VKAPI_CALL get_device(VkDevice on, const char *name);

static PFN_vkVoidFunction own(const char *name) {
    static const struct {
        const char *name;
        PFN_vkVoidFunction function;
    } all[] = {
        {"vkGetDeviceProcAddr", (PFN_vkVoidFunction)get_device},
        {"vkQueueSubmit", (PFN_vkVoidFunction)submit},
        {"vkWaitForFences", (PFN_vkVoidFunction)wait_fences},
        {"vkGetFenceStatus", (PFN_vkVoidFunction)fence_status},
        {"vkWaitSemaphores", (PFN_vkVoidFunction)wait_semaphores},
        {"vkGetSemaphoreCounterValue", (PFN_vkVoidFunction)semaphore_value},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (strcmp(name, all[i].name) == 0)
            return all[i].function;
    return NULL;
}

static PFN_vkVoidFunction VKAPI_CALL get_device(VkDevice on, const char *name) {
    PFN_vkVoidFunction function = own(name);
    return function ? function : of_device(on, name);
}

static PFN_vkVoidFunction VKAPI_CALL get_instance(VkInstance of, const char *name) {
    if (of)
        instance = of;
    if (strcmp(name, "vkGetInstanceProcAddr") == 0)
        return (PFN_vkVoidFunction)get_instance;
    if (strcmp(name, "vkCreateInstance") == 0)
        return (PFN_vkVoidFunction)create_instance;
    if (strcmp(name, "vkCreateDevice") == 0)
        return (PFN_vkVoidFunction)create_device;
    PFN_vkVoidFunction function = own(name);
    return function ? function : of_instance(of, name);
}

VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface *interface) {
    interface->loaderLayerInterfaceVersion = 2;
    interface->pfnGetInstanceProcAddr = get_instance;
    interface->pfnGetDeviceProcAddr = get_device;
    interface->pfnGetPhysicalDeviceProcAddr = NULL;
    return VK_SUCCESS;
}
