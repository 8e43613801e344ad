#include "terrain.h"

#include <stdio.h>
#include <stdlib.h>

void must(bool done, const char *what)
{
    if (!done) {
        fprintf(stderr, "%s: %s\n", what, SDL_GetError());
        exit(3);
    }
}

SDL_GPUTexture *texture(SDL_GPUDevice *device, SDL_GPUTextureFormat format,
    SDL_GPUTextureUsageFlags usage, Uint32 width, Uint32 height, const void *texels)
{
    SDL_GPUTextureCreateInfo info = {
        SDL_GPU_TEXTURETYPE_2D, format, usage, width, height, 1, 1, 0, 0};
    SDL_GPUTexture *made = SDL_CreateGPUTexture(device, &info);
    must(made != NULL, "a texture");
    if (texels) {
        SDL_GPUTransferBufferCreateInfo size = {
            SDL_GPU_TRANSFERBUFFERUSAGE_UPLOAD, 4 * width * height, 0};
        SDL_GPUTransferBuffer *from = SDL_CreateGPUTransferBuffer(device, &size);
        SDL_GPUCommandBuffer *commands = SDL_AcquireGPUCommandBuffer(device);
        must(from && commands, "an upload");
        SDL_memcpy(SDL_MapGPUTransferBuffer(device, from, false), texels, size.size);
        SDL_UnmapGPUTransferBuffer(device, from);
        SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
        SDL_UploadToGPUTexture(pass, &(SDL_GPUTextureTransferInfo){.transfer_buffer = from},
            &(SDL_GPUTextureRegion){.texture = made, .w = width, .h = height, .d = 1}, false);
        SDL_EndGPUCopyPass(pass);
        must(SDL_SubmitGPUCommandBuffer(commands), "an upload");
        SDL_ReleaseGPUTransferBuffer(device, from);
    }
    return made;
}

void save(SDL_GPUDevice *device, SDL_GPUTexture *target, const char *file)
{
    SDL_GPUTransferBufferCreateInfo size = {
        SDL_GPU_TRANSFERBUFFERUSAGE_DOWNLOAD, 4 * WIDTH * HEIGHT, 0};
    SDL_GPUTransferBuffer *to = SDL_CreateGPUTransferBuffer(device, &size);
    SDL_GPUCommandBuffer *commands = SDL_AcquireGPUCommandBuffer(device);
    must(to && commands, "a download");
    SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
    SDL_DownloadFromGPUTexture(pass,
        &(SDL_GPUTextureRegion){.texture = target, .w = WIDTH, .h = HEIGHT, .d = 1},
        &(SDL_GPUTextureTransferInfo){.transfer_buffer = to});
    SDL_EndGPUCopyPass(pass);
    SDL_GPUFence *fence = SDL_SubmitGPUCommandBufferAndAcquireFence(commands);
    must(fence && SDL_WaitForGPUFences(device, true, &fence, 1), "a download");
    SDL_ReleaseGPUFence(device, fence);
    void *texels = SDL_MapGPUTransferBuffer(device, to, false);
    SDL_Surface *surface =
        SDL_CreateSurfaceFrom(WIDTH, HEIGHT, SDL_PIXELFORMAT_ABGR8888, texels, 4 * WIDTH);
    must(surface && SDL_SaveBMP(surface, file), file);
    SDL_DestroySurface(surface);
    SDL_ReleaseGPUTransferBuffer(device, to);
}
