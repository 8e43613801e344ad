/* What terrain.c and try.c need beside the stage: textures and pictures without a window, and the
 * model. */
#ifndef TERRAIN_H
#define TERRAIN_H

#include "tess_sdl.h"

enum { WIDTH = 960, HEIGHT = 540 }; /* of the picture */

/* Ends the program with SDL's message unless this was done. */
void must(bool done, const char *what);

/* A texture of 4 bytes a texel, with contents if there are any. */
SDL_GPUTexture *texture(SDL_GPUDevice *device, SDL_GPUTextureFormat format,
    SDL_GPUTextureUsageFlags usage, Uint32 width, Uint32 height, const void *texels);

/* Saves a texture of the picture's size and of the format R8G8B8A8 as a BMP. */
void save(SDL_GPUDevice *device, SDL_GPUTexture *texture, const char *file);

/* Whether the last frame's points and indices are those that bindings/c gives for its factors. */
#ifdef TESS_MODEL
bool equals_the_model(struct tess_sdl_stage *stage, const struct tess_sdl_shaders *shaders);
#else
static inline bool equals_the_model(
    struct tess_sdl_stage *stage, const struct tess_sdl_shaders *shaders)
{
    (void)stage, (void)shaders;
    must(SDL_SetError("compile with -DTESS_MODEL, compare.c and bindings/c"), "--compare");
    return false;
}
#endif

#endif
