
/* `constant` and the sum of all `terms`, rounded up to a multiple of `multiple`. A term is `times`
   times the quotient of a variable and `per`, rounded up. */
struct tess_term {
    uint64_t times;
    uint32_t of; /* enum tess_variable */
    uint32_t per;
};

struct tess_formula {
    uint64_t constant;
    uint32_t multiple;
    uint32_t terms;
    struct tess_term term[6];
};

struct tess_binding { /* its number is its place; all are in set 0 */
    uint32_t resource; /* enum tess_resource */
    uint32_t is_uniform;
    uint32_t is_written;
};

struct tess_stage {
    const char *name, *file, *entry_point;
    uint32_t workgroup_size[3];
    uint32_t bindings;
    struct tess_binding binding[TESS_MAX_BINDINGS];
};

struct tess_span {
    struct tess_formula offset, bytes;
};

struct tess_dispatch {
    uint32_t stage;
    /* If not, `workgroups` are laid out in rows: x = min(workgroups, max_workgroups),
       y = ceil(workgroups / x), z = 1. If so, it is the byte in the arguments where x, y and z lie. */
    uint32_t is_indirect;
    struct tess_formula workgroups;
    struct tess_span binding[TESS_MAX_BINDINGS];
};

/* How a run of min_patches to max_patches patches is made. */
struct tess_plan {
    uint32_t min_patches, max_patches, max_points, max_primitives;
    uint32_t jobs, dispatches;
    struct tess_formula bytes[TESS_RESOURCES];
    struct tess_formula job[TESS_MAX_JOBS][TESS_JOB_WORDS];
    struct tess_dispatch dispatch[TESS_MAX_DISPATCHES];
};

/* The value of a formula; `variables` in the order of enum tess_variable. */
static inline uint64_t tess_value(const struct tess_formula *formula, const uint32_t variables[4])
{
    uint64_t sum = formula->constant;
    for (uint32_t i = 0; i < formula->terms; i++) {
        const struct tess_term *term = &formula->term[i];
        uint64_t variable = variables[term->of];
        sum += term->times * ((variable + term->per - 1) / term->per);
    }
    return (sum + formula->multiple - 1) / formula->multiple * formula->multiple;
}
