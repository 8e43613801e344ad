// What the C++ interface says of buffers that are too small, and batches whose ranges nobody wants.
#include "tess.hpp"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

static int failures = 0;

static void expect(bool is_right, const std::string &what) {
    if (!is_right) {
        std::fprintf(stderr, "%s\n", what.c_str());
        failures++;
    }
}

template <class Call>
static void refused(const char *message, uint32_t buffer, Call call) {
    try {
        call();
        expect(false, std::string("not refused: ") + message);
    } catch (const tess::BufferTooSmall &error) {
        expect(error.status == TESS_BUFFER_TOO_SMALL && error.shortage.buffer == buffer, "the buffer");
        expect(error.what() == std::string(message), error.what());
    }
}

int main() {
    const tess::Config config = {tess::Domain::quad, tess::Partitioning::integer};
    tess::Batch batch(config);
    const std::vector<float> factors(3 * 6, 2.0f); // 9 points and 24 indices each
    std::vector<TessPoint> points(27), few_points(26);
    std::vector<uint32_t> indices(72), few_indices(71), others(72);
    std::vector<TessRange> ranges(3), few_ranges(2), no_ranges;

    refused("the point buffer holds 26 elements, but 27 are needed", TESS_BUFFER_POINTS,
            [&] { batch.run(factors, few_points, indices); });
    refused("the index buffer holds 71 elements, but 72 are needed", TESS_BUFFER_INDICES,
            [&] { batch.run(factors, points, few_indices, ranges); });
    refused("the range buffer holds 2 elements, but 3 are needed", TESS_BUFFER_RANGES,
            [&] { batch.run(factors, points, indices, few_ranges); });
    refused("the range buffer holds 0 elements, but 3 are needed", TESS_BUFFER_RANGES,
            [&] { batch.run(factors, points, indices, no_ranges); });
    const std::array<float, 6> one = {2, 2, 2, 2, 2, 2};
    std::vector<TessPoint> eight(8);
    refused("the point buffer holds 8 elements, but 9 are needed", TESS_BUFFER_POINTS,
            [&] { batch.patch(one, eight, indices); });
    refused("the point buffer holds 8 elements, but 9 are needed", TESS_BUFFER_POINTS,
            [&] { tess::patch(config, one, eight, indices); });

    batch.run(factors, points, indices, ranges, tess::Numbering::per_batch, 5);
    batch.run(factors, points, others, tess::Numbering::per_batch, 5);
    expect(indices == others && indices[0] == 5 && ranges[2].first_index == 48, "without ranges");
    return failures;
}
