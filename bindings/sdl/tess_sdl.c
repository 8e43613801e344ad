#include "tess_sdl.h"

enum {
    MOST_WORKGROUPS = 65535, /* along x; every device has them */
    MOST_READ = 8,
    MOST_TEXTURES = 16,
    HEADER_WORDS = 5, /* of a frame: patches, room for points and primitives, number, instances */
    INSTANCES_AT = 4, /* bytes in the arguments of an indexed indirect draw */
    STATUS_AT = 8,
    FIT_AT = 40, /* bytes in the results; the frame's number is at 0 */
    RESULT_BYTES = 72,
    COPIED = 32,
    PATIENCE = 1024 /* frames that need little before the room shrinks */
};

struct room {
    Uint32 points, primitives;
};

struct user {
    SDL_GPUBuffer *buffer;
    SDL_GPUTexture *texture;
    SDL_GPUSampler *sampler;
    void *data;
    Uint32 bytes;
};

struct tess_sdl_stage {
    SDL_GPUDevice *device;
    const struct tess_sdl_shaders *shaders;
    const struct tess_sdl_plan *plan;
    struct tess_sdl_options options;
    Uint32 patches;
    Uint32 rows[3];                     /* workgroups of a pass over all patches */
    SDL_GPUComputePipeline **pipelines; /* the batch's, those before it, those after it */
    SDL_GPUShader **made;               /* the vertex shader, then the fragment shaders */
    struct user *users;
    SDL_GPUBuffer *buffers[TESS_SDL_BUFFERS];
    Uint32 bytes[TESS_SDL_BUFFERS];
    Uint32 *jobs;
    /* Each frame's numbers, and zeros for the buffer `fit`. */
    SDL_GPUTransferBuffer *header, *downloaded;
    SDL_GPUBuffer *results;
    SDL_GPUFence *fence; /* of a download that is under way */
    struct tess_sdl_feedback last;
    struct room room, most;
    Uint32 since;  /* the frame from which on `most` counts */
    bool is_fixed; /* memory ran out: the room stays */
    Uint32 frames, instances;
};

/* ---- Formulas, and the numbers of workgroups. ---- */

static Uint64 value(
    const struct tess_sdl_formula *formula, const Uint32 variables[TESS_SDL_VARIABLES])
{
    Uint64 sum = formula->constant;
    for (Uint32 i = 0; i < formula->terms; i++) {
        Uint64 variable = variables[formula->term[i].of];
        sum +=
            formula->term[i].times * ((variable + formula->term[i].per - 1) / formula->term[i].per);
    }
    return (sum + formula->multiple - 1) / formula->multiple * formula->multiple;
}

static void rows_of(Uint64 count, Uint32 rows[3])
{
    rows[0] = (Uint32)SDL_min(count, (Uint64)MOST_WORKGROUPS);
    rows[1] = rows[0] ? (Uint32)((count + rows[0] - 1) / rows[0]) : 0;
    rows[2] = 1;
}

/* ---- Room, as tess-wgpu/src/stage/room.rs explains it. ---- */

static Uint64 bytes_of(const struct tess_sdl_stage *stage, struct room room)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    Uint64 point = 8 + (shaders->is_evaluated ? shaders->stride : 0);
    return room.points * point + room.primitives * 4ull * shaders->indices_per_primitive;
}

/* The points and primitives of all patches at one of the factors of the table. */
static struct room uniform(const struct tess_sdl_stage *stage, float factor)
{
    struct room room = {0, 0};
    for (Uint32 i = 0; i < stage->shaders->uniform_count; i++) {
        const struct tess_sdl_uniform *one = &stage->shaders->uniform[i];
        if (one->factor == factor) {
            room.points =
                (Uint32)SDL_min((Uint64)one->points * stage->patches, (Uint64)SDL_MAX_UINT32);
            room.primitives =
                (Uint32)SDL_min((Uint64)one->primitives * stage->patches, (Uint64)SDL_MAX_UINT32);
        }
    }
    return room;
}

/* The part of a room that frames can ever need and that buffers can hold. */
static struct room possible(const struct tess_sdl_stage *stage, Uint64 points, Uint64 primitives)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    Uint64 limit = stage->options.largest_buffer / 8 * 8;
    Uint64 point = shaders->is_evaluated ? SDL_max(8u, shaders->stride) : 8;
    struct room worst = uniform(stage, 64);
    points =
        SDL_min(SDL_min(points, limit / point), SDL_min(worst.points, stage->plan->max_points));
    primitives = SDL_min(SDL_min(primitives, limit / (4 * shaders->indices_per_primitive)),
        SDL_min(worst.primitives, stage->plan->max_primitives));
    return (struct room){(Uint32)points, (Uint32)primitives};
}

/* The whole part of `count` * `part` / `whole`, whose product may have more than 64 bits. `part` is
   at most `whole`, which is at most 2^62. */
static Uint32 share(Uint32 count, Uint64 part, Uint64 whole)
{
    Uint64 quotient = 0, rest = 0;
    for (int bit = 31; bit >= 0; bit--) {
        quotient *= 2;
        rest = 2 * rest + (count >> bit & 1 ? part : 0);
        for (; rest >= whole; rest -= whole)
            quotient++;
    }
    return (Uint32)quotient;
}

/* The greater of both in each dimension, or as much of it as the budget holds. */
static struct room at_most(
    const struct tess_sdl_stage *stage, struct room least, struct room wanted)
{
    Uint64 budget = stage->options.budget;
    struct room whole = {
        SDL_max(least.points, wanted.points), SDL_max(least.primitives, wanted.primitives)};
    if (bytes_of(stage, whole) <= budget)
        return whole;
    /* What the budget leaves is divided in the proportion in which the whole exceeds the least. */
    bool fits = bytes_of(stage, least) <= budget;
    struct room none = {0, 0}, base = fits ? least : none, shape = fits ? whole : least;
    struct room beyond = {shape.points - base.points, shape.primitives - base.primitives};
    Uint64 left = budget - bytes_of(stage, base), all = SDL_max(bytes_of(stage, beyond), 1);
    return possible(stage, (Uint64)base.points + share(beyond.points, left, all),
        (Uint64)base.primitives + share(beyond.primitives, left, all));
}

static struct room first_room(const struct tess_sdl_stage *stage)
{
    struct room wanted = uniform(stage, 4);
    return at_most(stage, uniform(stage, 1), possible(stage, wanted.points, wanted.primitives));
}

/* The room to have after a frame with these needs: two fifths of it are used after a change. */
static struct room next_room(struct tess_sdl_stage *stage, const struct tess_sdl_feedback *frame)
{
    struct room now = stage->room, most = possible(stage, SDL_MAX_UINT32, SDL_MAX_UINT32),
                one = {1, 1};
    Uint64 points = SDL_min(frame->points, (Uint64)SDL_MAX_UINT32);
    Uint64 primitives = SDL_min(frame->primitives, (Uint64)SDL_MAX_UINT32);
    bool is_short = (now.points < most.points && points * 8 > now.points * 7ull) ||
                    (now.primitives < most.primitives && primitives * 8 > now.primitives * 7ull);
    if (is_short && bytes_of(stage, now) + bytes_of(stage, one) <= stage->options.budget) {
        struct room grown =
            at_most(stage, now, possible(stage, points * 5 / 2, primitives * 5 / 2));
        if (grown.points != now.points || grown.primitives != now.primitives)
            return grown;
    }
    stage->most.points = SDL_max(stage->most.points, (Uint32)points);
    stage->most.primitives = SDL_max(stage->most.primitives, (Uint32)primitives);
    bool is_lull =
        stage->most.points * 5ull <= now.points && stage->most.primitives * 5ull <= now.primitives;
    if (is_lull && frame->frame - stage->since < PATIENCE)
        return now;
    struct room needed = stage->most;
    stage->since = frame->frame;
    stage->most = (struct room){0, 0};
    if (!is_lull)
        return now;
    return at_most(stage, first_room(stage),
        possible(stage, needed.points * 5ull / 2, needed.primitives * 5ull / 2));
}

/* ---- Buffers. ---- */

static SDL_GPUBuffer *make_buffer(SDL_GPUDevice *device, int which, Uint32 bytes)
{
    SDL_GPUBufferCreateInfo info = {0};
    info.usage =
        SDL_GPU_BUFFERUSAGE_COMPUTE_STORAGE_READ | SDL_GPU_BUFFERUSAGE_COMPUTE_STORAGE_WRITE;
    if (which == TESS_SDL_POINTS || which == TESS_SDL_VERTICES)
        info.usage |= SDL_GPU_BUFFERUSAGE_VERTEX;
    if (which == TESS_SDL_INDICES)
        info.usage |= SDL_GPU_BUFFERUSAGE_INDEX;
    if (which == TESS_SDL_ARGUMENTS || which == TESS_SDL_FIT_ARGUMENTS)
        info.usage |= SDL_GPU_BUFFERUSAGE_INDIRECT;
    if (which == TESS_SDL_FACTORS)
        info.usage |= SDL_GPU_BUFFERUSAGE_GRAPHICS_STORAGE_READ;
    info.size = bytes;
    return SDL_CreateGPUBuffer(device, &info);
}

static SDL_GPUTransferBuffer *make_transfer(SDL_GPUDevice *device, bool is_upload, Uint32 bytes)
{
    SDL_GPUTransferBufferCreateInfo info = {0};
    info.usage =
        is_upload ? SDL_GPU_TRANSFERBUFFERUSAGE_UPLOAD : SDL_GPU_TRANSFERBUFFERUSAGE_DOWNLOAD;
    info.size = bytes;
    return SDL_CreateGPUTransferBuffer(device, &info);
}

/* Copies from a place of a transfer buffer to one of a buffer. */
static void copy_up(SDL_GPUCopyPass *pass, SDL_GPUTransferBuffer *from, Uint32 from_at,
    SDL_GPUBuffer *to, Uint32 to_at, Uint32 bytes)
{
    SDL_GPUTransferBufferLocation source = {from, from_at};
    SDL_GPUBufferRegion target = {to, to_at, bytes};
    SDL_UploadToGPUBuffer(pass, &source, &target, false);
}

/* Submits an upload of data, or of zeros for NULL. */
static bool upload(
    SDL_GPUDevice *device, SDL_GPUBuffer *to, Uint32 at, const void *data, Uint32 bytes)
{
    SDL_GPUTransferBuffer *from = make_transfer(device, true, bytes);
    void *mapped = from ? SDL_MapGPUTransferBuffer(device, from, false) : NULL;
    SDL_GPUCommandBuffer *commands = mapped ? SDL_AcquireGPUCommandBuffer(device) : NULL;
    bool done = false;
    if (mapped) {
        if (data)
            SDL_memcpy(mapped, data, bytes);
        else
            SDL_memset(mapped, 0, bytes);
        SDL_UnmapGPUTransferBuffer(device, from);
    }
    if (commands) {
        SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
        copy_up(pass, from, 0, to, at, bytes);
        SDL_EndGPUCopyPass(pass);
        done = SDL_SubmitGPUCommandBuffer(commands);
    }
    SDL_ReleaseGPUTransferBuffer(device, from);
    return done;
}

/* Makes the buffers of a list that `buffers` lacks. */
static bool make_buffers(struct tess_sdl_stage *stage, const struct tess_sdl_size *sizes,
    Uint32 count, const Uint32 variables[TESS_SDL_VARIABLES], SDL_GPUBuffer **buffers,
    Uint32 *bytes)
{
    for (Uint32 i = 0; i < count; i++) {
        Uint32 which = sizes[i].buffer;
        Uint64 size = SDL_max(value(&sizes[i].bytes, variables), 16);
        if (buffers[which] || which == TESS_SDL_JOB)
            continue;
        if (size > stage->options.largest_buffer)
            return SDL_SetError("%u patches need a buffer of %llu bytes, and the most is %llu: use "
                                "fewer, in more stages",
                stage->patches, (unsigned long long)size,
                (unsigned long long)stage->options.largest_buffer);
        buffers[which] = make_buffer(stage->device, (int)which, (Uint32)size);
        bytes[which] = (Uint32)size;
        if (!buffers[which])
            return false;
    }
    return true;
}

static bool is_kept(Uint32 which)
{
    return which == TESS_SDL_FACTORS || which == TESS_SDL_TABLES ||
           (which >= TESS_SDL_PATCH_COUNT && which != TESS_SDL_WINDOW &&
               which != TESS_SDL_VERTICES);
}

static void release(struct tess_sdl_stage *stage, SDL_GPUBuffer **buffers, bool is_all)
{
    for (Uint32 i = 0; i < TESS_SDL_BUFFERS; i++)
        if (is_all || !is_kept(i)) {
            SDL_ReleaseGPUBuffer(stage->device, buffers[i]);
            buffers[i] = NULL;
        }
}

/* The jobs of the batch's dispatches for a room. */
static bool make_jobs(struct tess_sdl_stage *stage, const Uint32 variables[TESS_SDL_VARIABLES])
{
    const struct tess_sdl_plan *plan = stage->plan;
    Uint32 jobs = 0;
    for (Uint32 i = 0; i < plan->dispatch_count; i++)
        jobs = SDL_max(jobs, plan->dispatches[i].job + 1);
    Uint32 *words = SDL_realloc(stage->jobs, (size_t)jobs * plan->job_words * 4);
    if (!words)
        return false;
    for (Uint32 i = 0; i < jobs * plan->job_words; i++)
        words[i] = (Uint32)value(&plan->jobs[i], variables);
    stage->jobs = words;
    return true;
}

/* Replaces the output by one with this room. After an error the present one stays. */
static bool make_output(struct tess_sdl_stage *stage, struct room room)
{
    Uint32 variables[TESS_SDL_VARIABLES] = {
        stage->patches, SDL_max(room.points, 1u), SDL_max(room.primitives, 1u), MOST_WORKGROUPS};
    SDL_GPUBuffer *made[TESS_SDL_BUFFERS] = {0};
    Uint32 bytes[TESS_SDL_BUFFERS], window[2] = {0, variables[TESS_SDL_OF_POINTS]};
    SDL_memcpy(bytes, stage->bytes, sizeof bytes);
    for (Uint32 i = 0; i < TESS_SDL_BUFFERS; i++)
        made[i] = is_kept(i) ? stage->buffers[i] : NULL;
    bool done =
        make_buffers(stage, stage->plan->sizes, stage->plan->size_count, variables, made, bytes) &&
        make_buffers(
            stage, stage->shaders->sizes, stage->shaders->size_count, variables, made, bytes) &&
        upload(stage->device, made[TESS_SDL_CATALOGUE], 0, NULL, bytes[TESS_SDL_CATALOGUE]) &&
        upload(stage->device, made[TESS_SDL_WINDOW], 0, window, sizeof window) &&
        make_jobs(stage, variables);
    if (!done && stage->room.points) {
        release(stage, made, false);
        return false;
    }
    release(stage, stage->buffers, false);
    SDL_memcpy(stage->buffers, made, sizeof made);
    SDL_memcpy(stage->bytes, bytes, sizeof bytes);
    stage->room = (struct room){variables[TESS_SDL_OF_POINTS], variables[TESS_SDL_OF_PRIMITIVES]};
    return done;
}

/* ---- Feedback. ---- */

/* Submits a download of the latest frame's numbers, unless one is under way. */
static void ask(struct tess_sdl_stage *stage)
{
    SDL_GPUCommandBuffer *commands =
        stage->fence ? NULL : SDL_AcquireGPUCommandBuffer(stage->device);
    if (!commands)
        return;
    SDL_GPUBufferRegion from = {stage->results, 0, RESULT_BYTES};
    SDL_GPUTransferBufferLocation to = {stage->downloaded, 0};
    SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
    SDL_DownloadFromGPUBuffer(pass, &from, &to);
    SDL_EndGPUCopyPass(pass);
    stage->fence = SDL_SubmitGPUCommandBufferAndAcquireFence(commands);
}

/* Takes the answer, if it is there. */
static void take(struct tess_sdl_stage *stage)
{
    if (!stage->fence || !SDL_QueryGPUFence(stage->device, stage->fence))
        return;
    SDL_ReleaseGPUFence(stage->device, stage->fence);
    stage->fence = NULL;
    const Uint32 *words = SDL_MapGPUTransferBuffer(stage->device, stage->downloaded, false);
    if (!words)
        return;
    const Uint32 *status = words + STATUS_AT / 4, *fit = words + FIT_AT / 4;
    if (words[0] > stage->last.frame) {
        struct tess_sdl_feedback *last = &stage->last;
        last->frame = words[0];
        last->points = fit[4] | (Uint64)fit[5] << 32;
        last->primitives = fit[6] | (Uint64)fit[7] << 32;
        last->drawn = status[4] == 0 ? status[2] | (Uint64)status[3] << 32 : 0;
        Uint32 step = SDL_min(fit[0], stage->shaders->ladder_count - 1);
        SDL_memcpy(&last->scale, &stage->shaders->ladder[step], 4);
    }
    SDL_UnmapGPUTransferBuffer(stage->device, stage->downloaded);
}

/* Another room, if the latest feedback asks for one. If memory runs out, frames stay coarser. */
static void adapt(struct tess_sdl_stage *stage)
{
    if (stage->is_fixed || stage->last.frame == 0)
        return;
    struct room room = next_room(stage, &stage->last);
    if (room.points != stage->room.points || room.primitives != stage->room.primitives)
        stage->is_fixed = !make_output(stage, room);
}

/* ---- Passes. ---- */

/* The buffer of a number in `bound`, and its bytes. */
static SDL_GPUBuffer *bound_buffer(const struct tess_sdl_stage *stage, Uint32 which, Uint32 *bytes)
{
    bool is_own = which < TESS_SDL_BUFFERS;
    const struct user *user = is_own ? NULL : &stage->users[which - TESS_SDL_BUFFERS];
    *bytes = is_own ? stage->bytes[which] : user->bytes;
    return is_own ? stage->buffers[which] : user->buffer;
}

/* What a program binds, in SDL's structures. */
struct bindings {
    SDL_GPUTextureSamplerBinding textures[MOST_TEXTURES];
    SDL_GPUBuffer *read[MOST_READ];
    SDL_GPUStorageBufferReadWriteBinding written[MOST_READ];
    const Uint32 *uniforms;
    Uint32 uniform_count; /* without the extra one */
};

static void gather(const struct tess_sdl_stage *stage, const struct tess_sdl_program *program,
    struct bindings *all)
{
    const Uint32 *bound = program->bound;
    Uint32 bytes;
    SDL_zerop(all);
    for (Uint32 i = 0; i < program->textures; i++) {
        const struct user *user = &stage->users[*bound++ - TESS_SDL_BUFFERS];
        all->textures[i].texture = user->texture;
        all->textures[i].sampler = user->sampler;
    }
    for (Uint32 i = 0; i < program->read_only; i++)
        all->read[i] = bound_buffer(stage, *bound++, &bytes);
    for (Uint32 i = 0; i < program->read_write; i++)
        all->written[i].buffer = bound_buffer(stage, *bound++, &bytes);
    all->uniforms = bound;
    all->uniform_count = program->uniforms - (program->extra != TESS_SDL_EXTRA_NOTHING);
}

/* One of the three functions of SDL that push uniform data. */
typedef void(SDLCALL *push_function)(SDL_GPUCommandBuffer *, Uint32, const void *, Uint32);

static void push(const struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands,
    const struct tess_sdl_program *program, const struct bindings *all, push_function function,
    const Uint32 *job, const Uint32 rows[3])
{
    for (Uint32 i = 0; i < all->uniform_count; i++) {
        bool is_job = all->uniforms[i] == TESS_SDL_JOB;
        const struct user *user =
            is_job ? NULL : &stage->users[all->uniforms[i] - TESS_SDL_BUFFERS];
        function(commands, i, is_job ? job : user->data,
            is_job ? stage->plan->job_words * 4 : user->bytes);
    }
    Uint32 sizes[SDL_arraysize(program->sized)] = {0};
    for (Uint32 i = 0; i < program->sizes; i++)
        bound_buffer(stage, program->sized[i], &sizes[i]);
    if (program->extra == TESS_SDL_EXTRA_SIZES)
        function(commands, all->uniform_count, sizes, 4 * program->sizes);
    if (program->extra == TESS_SDL_EXTRA_WORKGROUPS)
        function(commands, all->uniform_count, rows, 12);
}

/* A pass with one dispatch. SDL orders passes, but not the dispatches of one. */
static bool dispatch(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands,
    const struct tess_sdl_program *program, SDL_GPUComputePipeline *pipeline, const Uint32 *job,
    const Uint32 rows[3], SDL_GPUBuffer *indirect, Uint32 at)
{
    struct bindings all;
    gather(stage, program, &all);
    SDL_GPUComputePass *pass =
        SDL_BeginGPUComputePass(commands, NULL, 0, all.written, program->read_write);
    if (!pass)
        return false;
    SDL_BindGPUComputePipeline(pass, pipeline);
    if (program->textures)
        SDL_BindGPUComputeSamplers(pass, 0, all.textures, program->textures);
    if (program->read_only)
        SDL_BindGPUComputeStorageBuffers(pass, 0, all.read, program->read_only);
    push(stage, commands, program, &all, SDL_PushGPUComputeUniformData, job, rows);
    if (indirect)
        SDL_DispatchGPUComputeIndirect(pass, indirect, at);
    else
        SDL_DispatchGPUCompute(pass, rows[0], rows[1], rows[2]);
    SDL_EndGPUComputePass(pass);
    return true;
}

/* Passes before or after the batch. */
static bool run_passes(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands,
    const struct tess_sdl_program *programs, SDL_GPUComputePipeline **pipelines, Uint32 count)
{
    for (Uint32 i = 0; i < count; i++) {
        Uint32 size = stage->shaders->workgroup_size;
        Uint32 points = (stage->room.points + size - 1) / size;
        Uint32 rows[3] = {1, 1, 1};
        bool is_indirect = programs[i].groups == TESS_SDL_GROUPS_FIT_ARGUMENTS;
        if (programs[i].groups == TESS_SDL_GROUPS_PATCHES || is_indirect)
            SDL_memcpy(rows, stage->rows, sizeof rows);
        if (programs[i].groups == TESS_SDL_GROUPS_POINTS)
            rows[0] = SDL_min(points, stage->shaders->most_workgroups);
        if (!dispatch(stage, commands, &programs[i], pipelines[i], NULL, rows,
                is_indirect ? stage->buffers[TESS_SDL_FIT_ARGUMENTS] : NULL, 0))
            return false;
    }
    return true;
}

static bool run_batch(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands)
{
    const struct tess_sdl_plan *plan = stage->plan;
    Uint32 variables[TESS_SDL_VARIABLES] = {
        stage->patches, stage->room.points, stage->room.primitives, MOST_WORKGROUPS};
    for (Uint32 i = 0; i < plan->dispatch_count; i++) {
        const struct tess_sdl_dispatch *one = &plan->dispatches[i];
        Uint64 count = value(&one->workgroups, variables);
        Uint32 rows[3];
        rows_of(count, rows);
        if (!one->is_indirect && count == 0)
            continue;
        if (!dispatch(stage, commands, &stage->shaders->batch[one->program],
                stage->pipelines[one->program], stage->jobs + (size_t)one->job * plan->job_words,
                rows, one->is_indirect ? stage->buffers[TESS_SDL_ARGUMENTS] : NULL, (Uint32)count))
            return false;
    }
    return true;
}

/* The frame's numbers on their way to the buffers. */
static bool begin_frame(
    struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands, Uint32 patches)
{
    Uint32 *words = SDL_MapGPUTransferBuffer(stage->device, stage->header, true);
    if (!words)
        return false;
    Uint32 numbers[HEADER_WORDS] = {
        patches, stage->room.points, stage->room.primitives, stage->frames, stage->instances};
    SDL_memcpy(words, numbers, sizeof numbers);
    SDL_memset(words + HEADER_WORDS, 0, stage->bytes[TESS_SDL_FIT]);
    SDL_UnmapGPUTransferBuffer(stage->device, stage->header);
    SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
    if (!pass)
        return false;
    copy_up(pass, stage->header, 0, stage->buffers[TESS_SDL_PATCH_COUNT], 0, 4);
    copy_up(pass, stage->header, 4, stage->buffers[TESS_SDL_TERMS], 0, 8);
    copy_up(pass, stage->header, 12, stage->results, 0, 4);
    copy_up(pass, stage->header, sizeof numbers, stage->buffers[TESS_SDL_FIT], 0,
        stage->bytes[TESS_SDL_FIT]);
    SDL_EndGPUCopyPass(pass);
    return true;
}

static bool end_frame(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands)
{
    SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
    if (!pass)
        return false;
    SDL_GPUBufferLocation status = {stage->buffers[TESS_SDL_STATUS], 0},
                          fit = {stage->buffers[TESS_SDL_FIT], 0};
    SDL_GPUBufferLocation status_to = {stage->results, STATUS_AT},
                          fit_to = {stage->results, FIT_AT};
    /* The batch has written 1. */
    copy_up(pass, stage->header, 16, stage->buffers[TESS_SDL_ARGUMENTS], INSTANCES_AT, 4);
    SDL_CopyGPUBufferToBuffer(pass, &status, &status_to, COPIED, false);
    SDL_CopyGPUBufferToBuffer(pass, &fit, &fit_to, COPIED, false);
    SDL_EndGPUCopyPass(pass);
    return true;
}

/* The names of enum tess_sdl_kind, and of the functions that set them. */
static const char *const kinds[] = {"texture", "buffer", "uniform"};

/* Whether the user has set everything that a program binds. */
static bool is_complete(const struct tess_sdl_stage *stage, const struct tess_sdl_program *program)
{
    Uint32 count = program->textures + program->read_only + program->read_write +
                   program->uniforms - (program->extra != TESS_SDL_EXTRA_NOTHING);
    for (Uint32 i = 0; i < count; i++) {
        if (program->bound[i] < TESS_SDL_BUFFERS)
            continue;
        const struct user *user = &stage->users[program->bound[i] - TESS_SDL_BUFFERS];
        const struct tess_sdl_user *named =
            &stage->shaders->users[program->bound[i] - TESS_SDL_BUFFERS];
        if (!user->texture && !user->buffer && !user->data)
            return SDL_SetError("`%s` of the WGSL has no value yet: tess_sdl_set_%s gives it one",
                named->name, kinds[named->kind]);
    }
    return true;
}

static bool are_complete(
    const struct tess_sdl_stage *stage, const struct tess_sdl_program *programs, Uint32 count)
{
    for (Uint32 i = 0; i < count; i++)
        if (!is_complete(stage, &programs[i]))
            return false;
    return true;
}

void tess_sdl_set_instances(struct tess_sdl_stage *stage, Uint32 instances)
{
    stage->instances = instances;
}

bool tess_sdl_prepare(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands, Uint32 patches)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    SDL_GPUComputePipeline **before = stage->pipelines + shaders->batch_count;
    if (patches > stage->patches)
        return SDL_SetError("%u patches: the stage was made for %u", patches, stage->patches);
    if (!are_complete(stage, shaders->before, shaders->before_count) ||
        !are_complete(stage, shaders->after, shaders->after_count))
        return false;
    take(stage);
    adapt(stage);
    if (stage->frames > 0)
        ask(stage);
    stage->frames++;
    return begin_frame(stage, commands, patches) &&
           run_passes(stage, commands, shaders->before, before, shaders->before_count) &&
           run_batch(stage, commands) &&
           run_passes(stage, commands, shaders->after, before + shaders->before_count,
               shaders->after_count) &&
           end_frame(stage, commands);
}

bool tess_sdl_make_room(struct tess_sdl_stage *stage, Uint32 patches)
{
    SDL_GPUCommandBuffer *commands = SDL_AcquireGPUCommandBuffer(stage->device);
    if (!commands)
        return false;
    bool done = tess_sdl_prepare(stage, commands, patches);
    if (!SDL_SubmitGPUCommandBuffer(commands) || !done)
        return false;
    /* An answer that is under way may be one to an earlier question. */
    for (int asked = 0; asked < 2 && stage->last.frame < stage->frames; asked++) {
        ask(stage);
        if (!stage->fence || !SDL_WaitForGPUFences(stage->device, true, &stage->fence, 1))
            return false;
        take(stage);
    }
    adapt(stage);
    return true;
}

struct tess_sdl_feedback tess_sdl_last(const struct tess_sdl_stage *stage)
{
    return stage->last;
}

/* ---- Draws. ---- */

SDL_GPUGraphicsPipeline *tess_sdl_pipeline(
    struct tess_sdl_stage *stage, const SDL_GPUGraphicsPipelineCreateInfo *state, int fragment)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    SDL_GPUGraphicsPipelineCreateInfo info = *state;
    SDL_GPUVertexBufferDescription buffer = {0, shaders->stride, SDL_GPU_VERTEXINPUTRATE_VERTEX, 0};
    if (!shaders->vertex_count || fragment >= (int)shaders->fragment_count) {
        SDL_SetError(shaders->vertex_count
                         ? "the WGSL has no fragment shader of this number"
                         : "the WGSL has no function `domain`, so nothing can be drawn");
        return NULL;
    }
    info.vertex_shader = stage->made[0];
    info.fragment_shader = fragment < 0 ? NULL : stage->made[1 + fragment];
    info.vertex_input_state.vertex_buffer_descriptions = &buffer;
    info.vertex_input_state.num_vertex_buffers = 1;
    info.vertex_input_state.vertex_attributes = shaders->attributes;
    info.vertex_input_state.num_vertex_attributes = shaders->attribute_count;
    info.primitive_type = shaders->primitive_type;
    return SDL_CreateGPUGraphicsPipeline(stage->device, &info);
}

bool tess_sdl_draw(struct tess_sdl_stage *stage, SDL_GPUCommandBuffer *commands,
    SDL_GPURenderPass *pass, SDL_GPUGraphicsPipeline *pipeline, int fragment)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    if (stage->frames == 0)
        return SDL_SetError(
            "no frame has been prepared: call tess_sdl_prepare before the render pass");
    if (!pipeline || fragment >= (int)shaders->fragment_count)
        return SDL_SetError(
            "tess_sdl_draw takes a pipeline of tess_sdl_pipeline and its fragment shader's number");
    const struct tess_sdl_program *program = fragment < 0 ? NULL : &shaders->fragments[fragment];
    if (!is_complete(stage, shaders->vertex) || (program && !is_complete(stage, program)))
        return false;
    struct bindings all;
    SDL_BindGPUGraphicsPipeline(pass, pipeline);
    gather(stage, shaders->vertex, &all);
    if (shaders->vertex->textures)
        SDL_BindGPUVertexSamplers(pass, 0, all.textures, shaders->vertex->textures);
    if (shaders->vertex->read_only)
        SDL_BindGPUVertexStorageBuffers(pass, 0, all.read, shaders->vertex->read_only);
    push(stage, commands, shaders->vertex, &all, SDL_PushGPUVertexUniformData, NULL, NULL);
    if (program) {
        gather(stage, program, &all);
        if (program->textures)
            SDL_BindGPUFragmentSamplers(pass, 0, all.textures, program->textures);
        if (program->read_only)
            SDL_BindGPUFragmentStorageBuffers(pass, 0, all.read, program->read_only);
        push(stage, commands, program, &all, SDL_PushGPUFragmentUniformData, NULL, NULL);
    }
    SDL_GPUBufferBinding vertices = {
        stage->buffers[shaders->is_evaluated ? TESS_SDL_VERTICES : TESS_SDL_POINTS], 0};
    SDL_GPUBufferBinding indices = {stage->buffers[TESS_SDL_INDICES], 0};
    SDL_BindGPUVertexBuffers(pass, 0, &vertices, 1);
    SDL_BindGPUIndexBuffer(pass, &indices, SDL_GPU_INDEXELEMENTSIZE_32BIT);
    SDL_DrawGPUIndexedPrimitivesIndirect(pass, stage->buffers[TESS_SDL_ARGUMENTS], 0, 1);
    return true;
}

/* ---- The user's resources, and reading back. ---- */

static struct user *user_of(struct tess_sdl_stage *stage, Uint32 number, Uint32 kind)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    if (number >= shaders->user_count)
        SDL_SetError("the WGSL has no resource %u; it has %u", number, shaders->user_count);
    else if (shaders->users[number].kind != kind)
        SDL_SetError("`%s` of the WGSL is set by tess_sdl_set_%s", shaders->users[number].name,
            kinds[shaders->users[number].kind]);
    else
        return &stage->users[number];
    return NULL;
}

bool tess_sdl_set_uniform(
    struct tess_sdl_stage *stage, Uint32 number, const void *data, Uint32 bytes)
{
    struct user *user = user_of(stage, number, TESS_SDL_USER_UNIFORM);
    const struct tess_sdl_user *named = user ? &stage->shaders->users[number] : NULL;
    if (!user)
        return false;
    if (bytes != named->bytes)
        return SDL_SetError(
            "`%s` has %u bytes in the WGSL, not %u", named->name, named->bytes, bytes);
    if (!user->data && !(user->data = SDL_malloc(bytes)))
        return false;
    SDL_memcpy(user->data, data, bytes);
    user->bytes = bytes;
    return true;
}

bool tess_sdl_set_buffer(
    struct tess_sdl_stage *stage, Uint32 number, SDL_GPUBuffer *buffer, Uint32 bytes)
{
    struct user *user = user_of(stage, number, TESS_SDL_USER_BUFFER);
    if (!user)
        return false;
    user->buffer = buffer;
    user->bytes = bytes;
    return true;
}

bool tess_sdl_set_texture(
    struct tess_sdl_stage *stage, Uint32 number, SDL_GPUTexture *texture, SDL_GPUSampler *sampler)
{
    struct user *user = user_of(stage, number, TESS_SDL_USER_TEXTURE);
    if (!user)
        return false;
    if (!sampler)
        return SDL_SetError("`%s` needs a sampler: SDL binds textures with one",
            stage->shaders->users[number].name);
    user->texture = texture;
    user->sampler = sampler;
    return true;
}

bool tess_sdl_set_factors(struct tess_sdl_stage *stage, const float *factors, Uint32 patches)
{
    if (stage->shaders->has_hull)
        return SDL_SetError("the WGSL has a function `hull`, which gives the factors");
    if (patches == 0 || patches > stage->patches)
        return SDL_SetError("%u patches: the stage was made for 1 to %u", patches, stage->patches);
    return upload(stage->device, stage->buffers[TESS_SDL_GIVEN_FACTORS], 0, factors,
        4 * patches * stage->shaders->factors_per_patch);
}

void *tess_sdl_read(struct tess_sdl_stage *stage, int buffer, size_t *bytes)
{
    if (buffer < 0 || buffer >= TESS_SDL_BUFFERS || !stage->buffers[buffer]) {
        SDL_SetError("the stage has no buffer %d", buffer);
        return NULL;
    }
    Uint32 size = stage->bytes[buffer];
    SDL_GPUTransferBuffer *transfer = make_transfer(stage->device, false, size);
    SDL_GPUCommandBuffer *commands = transfer ? SDL_AcquireGPUCommandBuffer(stage->device) : NULL;
    SDL_GPUFence *fence = NULL;
    if (commands) {
        SDL_GPUBufferRegion from = {stage->buffers[buffer], 0, size};
        SDL_GPUTransferBufferLocation to = {transfer, 0};
        SDL_GPUCopyPass *pass = SDL_BeginGPUCopyPass(commands);
        SDL_DownloadFromGPUBuffer(pass, &from, &to);
        SDL_EndGPUCopyPass(pass);
        fence = SDL_SubmitGPUCommandBufferAndAcquireFence(commands);
    }
    bool done = fence && SDL_WaitForGPUFences(stage->device, true, &fence, 1);
    const void *mapped = done ? SDL_MapGPUTransferBuffer(stage->device, transfer, false) : NULL;
    void *copy = mapped ? SDL_malloc(size) : NULL;
    if (copy)
        SDL_memcpy(copy, mapped, size);
    if (mapped)
        SDL_UnmapGPUTransferBuffer(stage->device, transfer);
    SDL_ReleaseGPUFence(stage->device, fence);
    SDL_ReleaseGPUTransferBuffer(stage->device, transfer);
    *bytes = copy ? size : 0;
    return copy;
}

/* ---- Beginning and end. ---- */

static void *load(const char *folder, const char *file, size_t *bytes)
{
    char *path = NULL;
    void *content =
        SDL_asprintf(&path, "%s/%s", folder, file) < 0 ? NULL : SDL_LoadFile(path, bytes);
    if (!content && path) {
        char *why = SDL_strdup(SDL_GetError());
        SDL_SetError("%s cannot be read: %s", path, why ? why : "");
        SDL_free(why);
    }
    SDL_free(path);
    return content;
}

static SDL_GPUComputePipeline *make_pass(
    struct tess_sdl_stage *stage, const struct tess_sdl_program *program, const char *folder)
{
    SDL_GPUComputePipelineCreateInfo info = {0};
    void *code = load(folder, program->file, &info.code_size);
    info.code = code;
    info.entrypoint = program->entry_point;
    info.format = stage->shaders->format;
    info.num_samplers = program->textures;
    info.num_readonly_storage_buffers = program->read_only;
    info.num_readwrite_storage_buffers = program->read_write;
    info.num_uniform_buffers = program->uniforms;
    info.threadcount_x = program->threads[0];
    info.threadcount_y = program->threads[1];
    info.threadcount_z = program->threads[2];
    SDL_GPUComputePipeline *made = code ? SDL_CreateGPUComputePipeline(stage->device, &info) : NULL;
    SDL_free(code);
    return made;
}

static SDL_GPUShader *make_shader(struct tess_sdl_stage *stage,
    const struct tess_sdl_program *program, SDL_GPUShaderStage of, const char *folder)
{
    SDL_GPUShaderCreateInfo info = {0};
    void *code = load(folder, program->file, &info.code_size);
    info.code = code;
    info.entrypoint = program->entry_point;
    info.format = stage->shaders->format;
    info.stage = of;
    info.num_samplers = program->textures;
    info.num_storage_buffers = program->read_only;
    info.num_uniform_buffers = program->uniforms;
    SDL_GPUShader *made = code ? SDL_CreateGPUShader(stage->device, &info) : NULL;
    SDL_free(code);
    return made;
}

static bool make_programs(struct tess_sdl_stage *stage, const char *folder)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    const struct tess_sdl_program *lists[3] = {shaders->batch, shaders->before, shaders->after};
    Uint32 counts[3] = {shaders->batch_count, shaders->before_count, shaders->after_count}, at = 0;
    for (int list = 0; list < 3; list++)
        for (Uint32 i = 0; i < counts[list]; i++)
            if (!(stage->pipelines[at++] = make_pass(stage, &lists[list][i], folder)))
                return false;
    for (Uint32 i = 0; i < shaders->vertex_count + shaders->fragment_count; i++) {
        bool is_vertex = i < shaders->vertex_count;
        const struct tess_sdl_program *program =
            is_vertex ? shaders->vertex : &shaders->fragments[i - 1];
        SDL_GPUShaderStage of =
            is_vertex ? SDL_GPU_SHADERSTAGE_VERTEX : SDL_GPU_SHADERSTAGE_FRAGMENT;
        if (!(stage->made[i] = make_shader(stage, program, of, folder)))
            return false;
    }
    return true;
}

/* Writes what stays: the tables, the workgroups of a pass over all patches, and the ladder. */
static bool write_constants(struct tess_sdl_stage *stage, const char *folder)
{
    size_t bytes = 0;
    void *tables = load(folder, stage->shaders->tables, &bytes);
    SDL_GPUBuffer *terms = stage->buffers[TESS_SDL_TERMS];
    bool done =
        tables &&
        upload(stage->device, stage->buffers[TESS_SDL_TABLES], 0, tables, (Uint32)bytes) &&
        upload(stage->device, terms, 8, stage->rows, 8) &&
        upload(stage->device, terms, 16, stage->shaders->ladder, 4 * stage->shaders->ladder_count);
    SDL_free(tables);
    return done;
}

static bool begin(struct tess_sdl_stage *stage, const char *folder)
{
    const struct tess_sdl_shaders *shaders = stage->shaders;
    if (!(SDL_GetGPUShaderFormats(stage->device) & shaders->format))
        return SDL_SetError(
            "the device does not take the format of the shaders in %s: see tess shaders --target",
            folder);
    for (Uint32 i = 0; i < shaders->plan_count; i++)
        if (shaders->plans[i].min_patches <= stage->patches &&
            stage->patches <= shaders->plans[i].max_patches)
            stage->plan = &shaders->plans[i];
    if (!stage->plan)
        return SDL_SetError("there is no stage for %u patches", stage->patches);
    Uint32 size = shaders->workgroup_size;
    rows_of(((Uint64)stage->patches + size - 1) / size, stage->rows);
    stage->pipelines =
        SDL_calloc(shaders->batch_count + shaders->before_count + shaders->after_count,
            sizeof *stage->pipelines);
    stage->made = SDL_calloc(1 + shaders->fragment_count, sizeof *stage->made);
    stage->users = SDL_calloc(1 + shaders->user_count, sizeof *stage->users);
    if (!stage->pipelines || !stage->made || !stage->users || !make_programs(stage, folder) ||
        !make_output(stage, first_room(stage)) || !write_constants(stage, folder))
        return false;
    stage->header =
        make_transfer(stage->device, true, 4 * HEADER_WORDS + stage->bytes[TESS_SDL_FIT]);
    stage->downloaded = make_transfer(stage->device, false, RESULT_BYTES);
    stage->results = make_buffer(stage->device, TESS_SDL_BUFFERS, RESULT_BYTES);
    return stage->header && stage->downloaded && stage->results &&
           upload(stage->device, stage->results, 0, NULL, RESULT_BYTES);
}

struct tess_sdl_stage *tess_sdl_create(SDL_GPUDevice *device,
    const struct tess_sdl_shaders *shaders, const char *folder, Uint32 patches,
    const struct tess_sdl_options *options)
{
    struct tess_sdl_stage *stage = SDL_calloc(1, sizeof *stage);
    if (!stage)
        return NULL;
    stage->device = device;
    stage->shaders = shaders;
    stage->patches = patches;
    stage->instances = 1;
    if (options)
        stage->options = *options;
    if (stage->options.budget == 0)
        stage->options.budget = 256u << 20;
    if (stage->options.largest_buffer == 0)
        stage->options.largest_buffer = 128u << 20;
    if (begin(stage, folder))
        return stage;
    tess_sdl_destroy(stage);
    return NULL;
}

void tess_sdl_destroy(struct tess_sdl_stage *stage)
{
    if (!stage)
        return;
    const struct tess_sdl_shaders *shaders = stage->shaders;
    Uint32 pipelines = shaders->batch_count + shaders->before_count + shaders->after_count;
    for (Uint32 i = 0; stage->pipelines && i < pipelines; i++)
        SDL_ReleaseGPUComputePipeline(stage->device, stage->pipelines[i]);
    for (Uint32 i = 0; stage->made && i < 1 + shaders->fragment_count; i++)
        SDL_ReleaseGPUShader(stage->device, stage->made[i]);
    for (Uint32 i = 0; stage->users && i < shaders->user_count; i++)
        SDL_free(stage->users[i].data);
    if (stage->fence) {
        SDL_WaitForGPUFences(stage->device, true, &stage->fence, 1);
        SDL_ReleaseGPUFence(stage->device, stage->fence);
    }
    release(stage, stage->buffers, true);
    SDL_ReleaseGPUBuffer(stage->device, stage->results);
    SDL_ReleaseGPUTransferBuffer(stage->device, stage->header);
    SDL_ReleaseGPUTransferBuffer(stage->device, stage->downloaded);
    SDL_free(stage->pipelines);
    SDL_free(stage->made);
    SDL_free(stage->users);
    SDL_free(stage->jobs);
    SDL_free(stage);
}
