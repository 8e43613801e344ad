/* The tessellation stage for C programs over SDL 3's GPU interface: hull and domain functions in
   WGSL, room that grows by itself, factors that are scaled down until everything fits. It runs
   compute passes and an indexed indirect draw.

   `tess shaders --target spirv --layout sdl --stage FILE -o FOLDER` writes the shaders and
   FOLDER/tess_stage.h, which includes this file and has the stage as data, `tess_stage`. README.md
   has a program.

   A function that returns bool or a pointer returns false or NULL after an error; SDL_GetError()
   then has a sentence. A stage is used by one thread at a time. C99 and C++. */
#ifndef TESS_SDL_H
#define TESS_SDL_H

#include <SDL3/SDL.h>

#ifdef __cplusplus
extern "C" {
#endif

struct tess_sdl_stage;
struct tess_sdl_shaders;

/* What a frame needed, some frames later. */
struct tess_sdl_feedback {
    Uint32 frame;              /* its number, from 1; 0: nothing is known yet */
    Uint64 points, primitives; /* that its factors give, unless they are scaled down */
    Uint64 drawn;              /* primitives; 0 if they did not fit */
    float scale;               /* of the factors: 1 unless they were scaled down */
};

/* Zeros, and NULL for the structure, are the defaults. */
struct tess_sdl_options {
    Uint64 budget;         /* bytes for points, vertices and indices; 256 MiB */
    Uint64 largest_buffer; /* bytes; 128 MiB, which every Vulkan device binds */
};

/* The stage for up to `patches` patches, from the files in `folder`. `shaders` is kept, not copied.
 */
struct tess_sdl_stage *tess_sdl_create(SDL_GPUDevice *device,
    const struct tess_sdl_shaders *shaders, const char *folder, Uint32 patches,
    const struct tess_sdl_options *options);
void tess_sdl_destroy(struct tess_sdl_stage *stage);

/* The resources of your WGSL, by their numbers in tess_stage.h, such as TESS_USER_camera. Each has
   to be set once before the first frame. The data of a uniform buffer is copied, and later frames
   use it; other resources stay yours. A buffer needs the usages COMPUTE_STORAGE_READ (or _WRITE)
   and, if draws use it, GRAPHICS_STORAGE_READ. */
bool tess_sdl_set_uniform(
    struct tess_sdl_stage *stage, Uint32 user, const void *data, Uint32 bytes);
bool tess_sdl_set_buffer(
    struct tess_sdl_stage *stage, Uint32 user, SDL_GPUBuffer *buffer, Uint32 bytes);
bool tess_sdl_set_texture(
    struct tess_sdl_stage *stage, Uint32 user, SDL_GPUTexture *texture, SDL_GPUSampler *sampler);

/* For WGSL without a function `hull`: the factors of `patches` patches from the next frame on. */
bool tess_sdl_set_factors(struct tess_sdl_stage *stage, const float *factors, Uint32 patches);

/* The instances of each draw of the next frames; 1 at first. In your WGSL, `tess_instance()` of
   `domain` or of the function of --project is the number of the one that is drawn, from 0. With
   --evaluate, `domain` runs once for all of them. */
void tess_sdl_set_instances(struct tess_sdl_stage *stage, Uint32 instances);

/* Records a frame of `patches` patches, outside of any pass. What it draws is what later calls of
 * tess_sdl_draw draw. */
bool tess_sdl_prepare(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands, Uint32 patches);

/* Prepares a frame, waits, and makes the room that it needs; for loading screens and tests. */
bool tess_sdl_make_room(struct tess_sdl_stage *stage, Uint32 patches);

/* No fragment shader: for shadow maps and depth passes. */
#define TESS_SDL_DEPTH_ONLY (-1)

/* A pipeline for draws: `state` with the shaders, vertices and primitives of the stage. `fragment`
   is a number of tess_stage.h, such as TESS_FRAGMENT_shade. SDL_ReleaseGPUGraphicsPipeline frees
   the pipeline. */
SDL_GPUGraphicsPipeline *tess_sdl_pipeline(
    struct tess_sdl_stage *stage, const SDL_GPUGraphicsPipelineCreateInfo *state, int fragment);

/* Draws the prepared frame with a pipeline for `fragment`; binds the pipeline and all resources of
 * the WGSL. */
bool tess_sdl_draw(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands,
    SDL_GPURenderPass *pass, SDL_GPUGraphicsPipeline *pipeline, int fragment);

/* The latest feedback that has arrived; zeros until the first. */
struct tess_sdl_feedback tess_sdl_last(const struct tess_sdl_stage *stage);

/* Waits, and copies a buffer, such as TESS_SDL_POINTS, of the last frame that was submitted; for
   tests and physics. `bytes` gets its size. SDL_free frees the copy. */
void *tess_sdl_read(struct tess_sdl_stage *stage, int buffer, size_t *bytes);

/* ---- What tess_stage.h is made of. ---- */

/* The batch's buffers, then the stage's. docs/shaders.md says what each has. */
enum tess_sdl_buffer {
    TESS_SDL_JOB,
    TESS_SDL_FACTORS,
    TESS_SDL_TABLES,
    TESS_SDL_TOPOLOGIES,
    TESS_SDL_CONTEXTS,
    TESS_SDL_OFFSETS,
    TESS_SDL_STATUS,
    TESS_SDL_TILES,
    TESS_SDL_ARGUMENTS,
    TESS_SDL_CATALOGUE,
    TESS_SDL_POINTS,
    TESS_SDL_INDICES,
    TESS_SDL_PATCH_COUNT,
    TESS_SDL_GIVEN_FACTORS,
    TESS_SDL_FIT,
    TESS_SDL_TERMS,
    TESS_SDL_FIT_ARGUMENTS,
    TESS_SDL_WINDOW,
    TESS_SDL_VERTICES,
    TESS_SDL_BUFFERS
};

/* The number of a resource of the WGSL among the buffers of a program. */
#define TESS_SDL_OF_USER(user) ((Uint32)TESS_SDL_BUFFERS + (Uint32)(user))

enum tess_sdl_variable {
    TESS_SDL_OF_PATCHES,
    TESS_SDL_OF_POINTS,
    TESS_SDL_OF_PRIMITIVES,
    TESS_SDL_OF_MAX_WORKGROUPS,
    TESS_SDL_VARIABLES
};

/* `constant` and the sum of all `term`, rounded up to a multiple of `multiple`. A term is `times`
   times the quotient of a variable and `per`, rounded up. */
struct tess_sdl_formula {
    Uint64 constant;
    Uint32 multiple, terms;
    struct {
        Uint64 times;
        Uint32 of, per;
    } term[6];
};

struct tess_sdl_size {
    Uint32 buffer;
    struct tess_sdl_formula bytes;
};

/* What the number of a pass's workgroups depends on. */
enum tess_sdl_groups {
    TESS_SDL_GROUPS_ONE,
    TESS_SDL_GROUPS_PATCHES,
    TESS_SDL_GROUPS_POINTS,
    TESS_SDL_GROUPS_FIT_ARGUMENTS
};

/* The uniform buffer after the others: the bytes of each of `sized` (Metal), or the workgroups
 * along x, y and z (HLSL). */
enum tess_sdl_extra {
    TESS_SDL_EXTRA_NOTHING,
    TESS_SDL_EXTRA_SIZES,
    TESS_SDL_EXTRA_WORKGROUPS
};

struct tess_sdl_program {
    const char *file, *entry_point;
    Uint32 groups;
    Uint32 threads[3];
    Uint32 textures, read_only, read_write, uniforms;
    Uint32 extra;
    /* Buffers, or TESS_SDL_OF_USER of a resource: textures, then buffers that
       are read, buffers that are written, and uniform buffers, each from slot 0. */
    Uint32 bound[36];
    Uint32 sizes;
    Uint32 sized[24];
};

struct tess_sdl_dispatch {
    Uint32 program, job;
    /* If so, `workgroups` is the byte in the arguments where x, y and z lie. */
    Uint32 is_indirect;
    struct tess_sdl_formula workgroups;
};

/* How batches of min_patches to max_patches patches run. */
struct tess_sdl_plan {
    Uint32 min_patches, max_patches, max_points, max_primitives;
    const struct tess_sdl_size *sizes;
    Uint32 size_count;
    const struct tess_sdl_formula *jobs; /* job_words for each job */
    Uint32 job_words;
    const struct tess_sdl_dispatch *dispatches;
    Uint32 dispatch_count;
};

enum tess_sdl_kind {
    TESS_SDL_USER_TEXTURE,
    TESS_SDL_USER_BUFFER,
    TESS_SDL_USER_UNIFORM
};

struct tess_sdl_user {
    const char *name;
    Uint32 kind;
    Uint32 bytes; /* of a uniform buffer */
};

/* Points and primitives of one patch whose factors all have this value. */
struct tess_sdl_uniform {
    float factor;
    Uint32 points, primitives;
};

struct tess_sdl_shaders {
    const char *domain, *partitioning, *output, *split; /* as `tess shaders` names them */
    const char *tables;
    SDL_GPUShaderFormat format;
    SDL_GPUPrimitiveType primitive_type;
    Uint32 factors_per_patch, indices_per_primitive;
    /* Threads of a workgroup of the passes over patches and points, and the most workgroups of one
       over points. */
    Uint32 workgroup_size, most_workgroups;
    Uint32 has_hull, is_evaluated;
    const struct tess_sdl_program *batch;
    Uint32 batch_count;
    const struct tess_sdl_program *before;
    Uint32 before_count;
    const struct tess_sdl_program *after;
    Uint32 after_count;
    const struct tess_sdl_program *vertex;
    Uint32 vertex_count;
    const struct tess_sdl_program *fragments;
    Uint32 fragment_count;
    const SDL_GPUVertexAttribute *attributes;
    Uint32 attribute_count, stride;
    const struct tess_sdl_size *sizes;
    Uint32 size_count;
    const struct tess_sdl_user *users;
    Uint32 user_count;
    const struct tess_sdl_uniform *uniform;
    Uint32 uniform_count;
    const Uint32 *ladder; /* bits of binary32 */
    Uint32 ladder_count;
    const struct tess_sdl_plan *plans;
    Uint32 plan_count;
};

#ifdef __cplusplus
}
#endif

#endif
