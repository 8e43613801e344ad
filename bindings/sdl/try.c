/* try FOLDER: what terrain.c does not reach: factors of the host, a triangle's domain, every kind
   of resource, and refusals with their sentences. Exit codes: 0 as it should be, 1 not, 3 no
   device. */
#include "tess_stage.h"
#include "terrain.h"

#include <stdio.h>
#include <stdlib.h>

enum { PATCHES = 4 };

static void should(bool is, const char *what)
{
    if (!is) {
        fprintf(stderr, "try: %s; SDL says: %s\n", what, SDL_GetError());
        exit(1);
    }
}

/* A call that must fail with this sentence. */
static void refused(bool done, const char *says)
{
    should(!done && SDL_strstr(SDL_GetError(), says) != NULL, says);
    printf("refused: %s\n", SDL_GetError());
    SDL_ClearError();
}

static void stages_are_refused(SDL_GPUDevice *device, const char *folder)
{
    struct tess_sdl_options small = {0, 1000};
    refused(tess_sdl_create(device, &tess_stage, "nowhere", PATCHES, NULL), "nowhere/");
    refused(tess_sdl_create(device, &tess_stage, folder, 0, NULL), "no stage for 0 patches");
    refused(tess_sdl_create(device, &tess_stage, folder, PATCHES, &small), "need a buffer of");
}

static void calls_are_refused(struct tess_sdl_stage *stage, SDL_GPUTexture *texel)
{
    static const float many[4 * (PATCHES + 1)];
    SDL_GPUGraphicsPipelineCreateInfo state = {0};
    size_t bytes;
    refused(tess_sdl_set_uniform(stage, TESS_USER_offset, many, 4), "has 16 bytes in the WGSL");
    refused(tess_sdl_set_buffer(stage, TESS_USER_offset, NULL, 4), "by tess_sdl_set_uniform");
    refused(tess_sdl_set_uniform(stage, TESS_USERS, many, 4), "no resource 3; it has 3");
    refused(tess_sdl_set_texture(stage, TESS_USER_colours, texel, NULL), "needs a sampler");
    refused(tess_sdl_set_factors(stage, many, PATCHES + 1), "made for 1 to 4");
    refused(tess_sdl_prepare(stage, NULL, PATCHES + 1), "made for 4");
    refused(tess_sdl_pipeline(stage, &state, TESS_FRAGMENTS), "no fragment shader");
    refused(tess_sdl_draw(stage, NULL, NULL, NULL, TESS_FRAGMENT_colour), "call tess_sdl_prepare");
    refused(tess_sdl_read(stage, TESS_SDL_VERTICES, &bytes), "has no buffer");
}

/* Draws the prepared patches onto black. */
static bool draw(SDL_GPUDevice *device, struct tess_sdl_stage *stage,
    SDL_GPUGraphicsPipeline *pipeline, SDL_GPUTexture *target)
{
    SDL_GPUCommandBuffer *commands = SDL_AcquireGPUCommandBuffer(device);
    must(commands && tess_sdl_prepare(stage, commands, PATCHES), "tess_sdl_prepare");
    SDL_GPUColorTargetInfo onto = {
        .texture = target, .load_op = SDL_GPU_LOADOP_CLEAR, .store_op = SDL_GPU_STOREOP_STORE};
    SDL_GPURenderPass *pass = SDL_BeginGPURenderPass(commands, &onto, 1, NULL);
    bool done = tess_sdl_draw(stage, commands, pass, pipeline, TESS_FRAGMENT_colour);
    SDL_EndGPURenderPass(pass);
    must(SDL_SubmitGPUCommandBuffer(commands) && SDL_WaitForGPUIdle(device), "a frame");
    return done;
}

/* A buffer of the shades of all patches. */
static SDL_GPUBuffer *shades_of(SDL_GPUDevice *device)
{
    const float shades[PATCHES] = {0.5f, 0.5f, 0.5f, 0.5f};
    SDL_GPUBufferCreateInfo info = {SDL_GPU_BUFFERUSAGE_GRAPHICS_STORAGE_READ, sizeof shades, 0};
    SDL_GPUTransferBufferCreateInfo size = {SDL_GPU_TRANSFERBUFFERUSAGE_UPLOAD, sizeof shades, 0};
    SDL_GPUBuffer *made = SDL_CreateGPUBuffer(device, &info);
    SDL_GPUTransferBuffer *from = SDL_CreateGPUTransferBuffer(device, &size);
    SDL_GPUCommandBuffer *commands = SDL_AcquireGPUCommandBuffer(device);
    must(made && from && commands, "a buffer");
    SDL_memcpy(SDL_MapGPUTransferBuffer(device, from, false), shades, sizeof shades);
    SDL_UnmapGPUTransferBuffer(device, from);
    SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
    SDL_UploadToGPUBuffer(pass, &(SDL_GPUTransferBufferLocation){from, 0},
        &(SDL_GPUBufferRegion){made, 0, sizeof shades}, false);
    SDL_EndGPUCopyPass(pass);
    must(SDL_SubmitGPUCommandBuffer(commands), "a buffer");
    SDL_ReleaseGPUTransferBuffer(device, from);
    return made;
}

/* Whether a picture has one colour, that of the texel at so many halves of its brightness. */
static bool is_drawn(const char *picture, Uint8 halves)
{
    SDL_Surface *surface = SDL_LoadBMP(picture);
    bool is = surface != NULL;
    for (int y = 0; is && y < HEIGHT; y++)
        for (int x = 0; is && x < WIDTH; x++) {
            Uint8 r, g, b, a;
            is = SDL_ReadSurfacePixel(surface, x, y, &r, &g, &b, &a) && r == 100 * halves &&
                 g == 50 * halves && b == 20 * halves;
        }
    SDL_DestroySurface(surface);
    return is;
}

/* Two instances, of which the second one covers the first. */
static void instances_are_drawn(SDL_GPUDevice *device, struct tess_sdl_stage *stage,
    SDL_GPUGraphicsPipeline *pipeline, SDL_GPUTexture *target, const char *picture)
{
    size_t bytes;
    tess_sdl_set_instances(stage, 2);
    should(draw(device, stage, pipeline, target), "instances are drawn");
    Uint32 *arguments = tess_sdl_read(stage, TESS_SDL_ARGUMENTS, &bytes);
    should(arguments != NULL && arguments[1] == 2, "the draw has two instances");
    SDL_free(arguments);
    should(equals_the_model(stage, &tess_stage), "the frame differs from the model");
    save(device, target, picture);
    should(is_drawn(picture, 2), "the second instance has another colour");
}

int main(int count, char **words)
{
    const char *folder = count == 3 ? words[1] : "", *picture = count == 3 ? words[2] : "";
    SDL_SetHint(SDL_HINT_VIDEO_DRIVER, "offscreen");
    must(SDL_Init(SDL_INIT_VIDEO), "SDL");
    SDL_GPUDevice *device = SDL_CreateGPUDevice(tess_stage.format, true, NULL);
    must(device != NULL, "no device");
    stages_are_refused(device, folder);
    struct tess_sdl_stage *stage = tess_sdl_create(device, &tess_stage, folder, PATCHES, NULL);
    must(stage != NULL, folder);
    const Uint8 rgba[4] = {200, 100, 40, 255};
    SDL_GPUTexture *texel = texture(
        device, SDL_GPU_TEXTUREFORMAT_R8G8B8A8_UNORM, SDL_GPU_TEXTUREUSAGE_SAMPLER, 1, 1, rgba);
    SDL_GPUTexture *target = texture(device, SDL_GPU_TEXTUREFORMAT_R8G8B8A8_UNORM,
        SDL_GPU_TEXTUREUSAGE_COLOR_TARGET, WIDTH, HEIGHT, NULL);
    calls_are_refused(stage, texel);

    SDL_GPUColorTargetDescription onto = {.format = SDL_GPU_TEXTUREFORMAT_R8G8B8A8_UNORM};
    SDL_GPUGraphicsPipelineCreateInfo state = {
        .target_info = {.color_target_descriptions = &onto, .num_color_targets = 1}};
    SDL_GPUGraphicsPipeline *pipeline = tess_sdl_pipeline(stage, &state, TESS_FRAGMENT_colour);
    must(pipeline != NULL, "a pipeline");
    /* The second patch is culled, and the last one does not fit at first. */
    const float factors[4 * PATCHES] = {
        2.5f, 3, 1, 3.25f, 0, 1, 1, 1, 1, 1, 1, 1, 64, 63.5f, 17, 64};
    must(tess_sdl_set_factors(stage, factors, PATCHES), "tess_sdl_set_factors");
    refused(draw(device, stage, pipeline, target), "`shades` of the WGSL has no value yet");
    should(equals_the_model(stage, &tess_stage), "a coarser frame differs from the model");
    SDL_GPUSampler *sampler = SDL_CreateGPUSampler(device, &(SDL_GPUSamplerCreateInfo){0});
    const float offset[4] = {0, 0, 0, 0};
    must(tess_sdl_set_buffer(stage, TESS_USER_shades, shades_of(device), 4 * PATCHES) &&
             tess_sdl_set_texture(stage, TESS_USER_colours, texel, sampler) &&
             tess_sdl_set_uniform(stage, TESS_USER_offset, offset, sizeof offset),
        "the resources");
    must(tess_sdl_make_room(stage, PATCHES), "tess_sdl_make_room");
    should(tess_sdl_last(stage).scale < 1, "the first frames are coarser");
    should(draw(device, stage, pipeline, target), "nothing is refused");
    should(equals_the_model(stage, &tess_stage), "the frame differs from the model");
    must(tess_sdl_make_room(stage, PATCHES), "tess_sdl_make_room");
    should(tess_sdl_last(stage).scale >= 1, "there is room");
    save(device, target, picture);
    should(is_drawn(picture, 1), "the picture has another colour");
    instances_are_drawn(device, stage, pipeline, target, picture);
    tess_sdl_destroy(stage);
    return 0;
}
