/* rooms FILE: compares the rooms that the host decides on with those that the stage in Rust decided on
   for the same demands, which bindings/rooms.txt records. Compiled with -DHOST, the path of
   tess_sdl.c. Exit codes: 0 equal, 1 different. */
#include HOST

#include <stdio.h>

enum { UNIFORM = 4 };

static bool is_room(const char *what, const unsigned long long wanted[2], struct room room)
{
    if (room.points == wanted[0] && room.primitives == wanted[1])
        return true;
    fprintf(stderr, "%s: room for %u points and %u primitives, not %llu and %llu\n", what,
        room.points, room.primitives, wanted[0], wanted[1]);
    return false;
}

int main(int count, char **words)
{
    FILE *file = count == 2 ? fopen(words[1], "r") : NULL;
    struct tess_sdl_plan plan = {0};
    struct tess_sdl_uniform uniform[UNIFORM];
    struct tess_sdl_shaders shaders = {0};
    struct tess_sdl_stage stage = {0};
    unsigned long long number[3 * UNIFORM];
    char line[256];
    int compared = 0;
    plan.max_points = plan.max_primitives = SDL_MAX_UINT32;
    shaders.uniform = uniform;
    shaders.uniform_count = UNIFORM;
    while (file && fgets(line, sizeof line, file)) {
        char what[8] = "";
        int at = 0, read = 0, got = 0;
        sscanf(line, "%7s%n", what, &at);
        while (got < 3 * UNIFORM && sscanf(line + at, "%llu%n", &number[got], &read) == 1) {
            at += read;
            got++;
        }
        if (SDL_strcmp(what, "stage") == 0 && got == 6) {
            SDL_zero(stage);
            stage.shaders = &shaders;
            stage.plan = &plan;
            stage.patches = (Uint32)number[0];
            shaders.stride = (Uint32)number[2];
            shaders.is_evaluated = number[2] > 0;
            shaders.indices_per_primitive = (Uint32)number[3] / 4;
            stage.options.budget = number[4];
            stage.options.largest_buffer = number[5];
        } else if (SDL_strcmp(what, "uniform") == 0 && got == 3 * UNIFORM) {
            for (int i = 0; i < UNIFORM; i++)
                uniform[i] = (struct tess_sdl_uniform){(float)number[3 * i],
                    (Uint32)number[3 * i + 1], (Uint32)number[3 * i + 2]};
        } else if (SDL_strcmp(what, "first") == 0 && got == 2) {
            stage.room = first_room(&stage);
            if (!is_room(line, number, stage.room))
                return 1;
        } else if (SDL_strcmp(what, "frame") == 0 && got == 5) {
            struct tess_sdl_feedback frame = {(Uint32)number[0], number[1], number[2], 0, 1};
            stage.room = next_room(&stage, &frame);
            if (!is_room(line, number + 3, stage.room))
                return 1;
            compared++;
        } else if (what[0] != '#')
            return fprintf(stderr, "not a line of the record: %s", line), 1;
    }
    printf("%d rooms: %s\n", compared, compared >= 100 ? "equal" : "too few");
    return compared >= 100 ? 0 : 1;
}
