/* terrain FOLDER [--compare] [--ready] [--budget BYTES] [PICTURE.bmp]

   Flies over a lit terrain for twelve frames, without a window, and saves the last one. Compiled
   with -DTESS_MODEL, compare.c and bindings/c, --compare compares the points and indices of every
   frame with the model's, bit for bit. --ready makes room before the first frame. Exit codes: 0
   done or equal, 1 different, 2 bad usage, 3 no device, or one that failed. */
#include "tess_stage.h"
#include "terrain.h"

#include <math.h>
#include <stdio.h>

enum { GRID = 24, MAP = 257, FRAMES = 12 };

struct frame { /* as in terrain.wgsl */
    float clip_from_world[16], eye[3], pixels_per_unit, segment;
    Uint32 grid, padding[2];
};

static float ground(float x, float y)
{
    float height = 0, size = 0.5f;
    for (int octave = 0; octave < 6; octave++, size *= 0.5f) {
        float turned = 0.8f * x - 0.6f * y;
        y = 2.03f * (0.6f * x + 0.8f * y) + 1.7f;
        x = 2.03f * turned + 0.4f;
        height += size * (0.5f + 0.5f * sinf(x) * sinf(y));
    }
    return height;
}

/* A camera above the terrain that looks north and down a little; the matrix is by columns, z from 0
 * to 1. */
static struct frame camera(float at)
{
    const float focal = 1.5f, near = 0.1f, far = 200, down = 0.22f, height = 14;
    float c = cosf(down), s = sinf(down), x = 32, y = -6 + 8 * at, depth = far / (far - near);
    struct frame frame = {
        {focal * HEIGHT / WIDTH, 0, 0, 0, 0, focal * s, depth * c, c, 0, focal * c, -depth * s, -s,
            -focal * HEIGHT / WIDTH * x, focal * (-s * y - c * height),
            depth * (-c * y + s * height - near), -c * y + s * height},
        {x, y, height}, focal * HEIGHT / 2, 6, GRID, {0, 0}};
    return frame;
}

int main(int count, char **words)
{
    const char *folder = count > 1 ? words[1] : NULL, *picture = NULL;
    struct tess_sdl_options options = {0, 0};
    bool is_compared = false, is_ready = false;
    for (int i = 2; i < count; i++) {
        if (SDL_strcmp(words[i], "--compare") == 0)
            is_compared = true;
        else if (SDL_strcmp(words[i], "--ready") == 0)
            is_ready = true;
        else if (SDL_strcmp(words[i], "--budget") == 0 && i + 1 < count)
            options.budget = SDL_strtoull(words[++i], NULL, 10);
        else
            picture = words[i];
    }
    if (!folder || folder[0] == '-' || (picture && picture[0] == '-')) {
        fprintf(
            stderr, "usage: terrain FOLDER [--compare] [--ready] [--budget BYTES] [PICTURE.bmp]\n");
        return 2;
    }
    SDL_SetHint(SDL_HINT_VIDEO_DRIVER, "offscreen");
    must(SDL_Init(SDL_INIT_VIDEO), "SDL");
    SDL_GPUDevice *device = SDL_CreateGPUDevice(tess_stage.format, true, NULL);
    must(device != NULL, "no device");
    struct tess_sdl_stage *stage =
        tess_sdl_create(device, &tess_stage, folder, GRID * GRID, &options);
    must(stage != NULL, folder);

    static float map[MAP * MAP];
    for (int i = 0; i < MAP * MAP; i++)
        map[i] = ground(0.03f * (float)(i % MAP), 0.03f * (float)(i / MAP));
    SDL_GPUTexture *heights = texture(
        device, SDL_GPU_TEXTUREFORMAT_R32_FLOAT, SDL_GPU_TEXTUREUSAGE_SAMPLER, MAP, MAP, map);
    SDL_GPUSampler *sampler = SDL_CreateGPUSampler(device, &(SDL_GPUSamplerCreateInfo){0});
    must(tess_sdl_set_texture(stage, TESS_USER_heights, heights, sampler), "heights");
    SDL_GPUTexture *target = texture(device, SDL_GPU_TEXTUREFORMAT_R8G8B8A8_UNORM,
        SDL_GPU_TEXTUREUSAGE_COLOR_TARGET, WIDTH, HEIGHT, NULL);
    SDL_GPUTexture *depths = texture(device, SDL_GPU_TEXTUREFORMAT_D16_UNORM,
        SDL_GPU_TEXTUREUSAGE_DEPTH_STENCIL_TARGET, WIDTH, HEIGHT, NULL);
    SDL_GPUColorTargetDescription colour = {.format = SDL_GPU_TEXTUREFORMAT_R8G8B8A8_UNORM};
    SDL_GPUGraphicsPipelineCreateInfo state = {
        .depth_stencil_state = {.compare_op = SDL_GPU_COMPAREOP_LESS,
            .enable_depth_test = true,
            .enable_depth_write = true},
        .target_info = {&colour, 1, SDL_GPU_TEXTUREFORMAT_D16_UNORM, true, 0, 0, 0}};
    SDL_GPUGraphicsPipeline *pipeline = tess_sdl_pipeline(stage, &state, TESS_FRAGMENT_shade);
    must(pipeline != NULL, "a pipeline");

    bool is_equal = true;
    for (int number = 0; number < FRAMES; number++) {
        struct frame frame = camera((float)number / FRAMES);
        SDL_GPUCommandBuffer *commands = SDL_AcquireGPUCommandBuffer(device);
        must(commands && tess_sdl_set_uniform(stage, TESS_USER_frame, &frame, sizeof frame),
            "frame");
        must(!is_ready || number > 0 || tess_sdl_make_room(stage, GRID * GRID), "room");
        must(tess_sdl_prepare(stage, commands, GRID * GRID), "tess_sdl_prepare");
        SDL_GPUColorTargetInfo onto = {.texture = target,
            .clear_color = {0.62f, 0.72f, 0.82f, 1},
            .load_op = SDL_GPU_LOADOP_CLEAR,
            .store_op = SDL_GPU_STOREOP_STORE};
        SDL_GPUDepthStencilTargetInfo depth = {
            .texture = depths, .clear_depth = 1, .load_op = SDL_GPU_LOADOP_CLEAR};
        SDL_GPURenderPass *pass = SDL_BeginGPURenderPass(commands, &onto, 1, &depth);
        must(tess_sdl_draw(stage, commands, pass, pipeline, TESS_FRAGMENT_shade), "tess_sdl_draw");
        SDL_EndGPURenderPass(pass);
        must(SDL_SubmitGPUCommandBuffer(commands) && SDL_WaitForGPUIdle(device), "a frame");
        is_equal = (!is_compared || equals_the_model(stage, &tess_stage)) && is_equal;
        struct tess_sdl_feedback last = tess_sdl_last(stage);
        printf("frame %d; of frame %u: %llu triangles needed, %llu drawn, scale %.3f\n", number + 1,
            last.frame, (unsigned long long)last.primitives, (unsigned long long)last.drawn,
            last.scale);
    }
    if (picture)
        save(device, target, picture);
    tess_sdl_destroy(stage);
    return is_equal ? 0 : 1;
}
