// The program of batch.c in C++17: tessellates the same batch, and compares each patch with the model's.
#include "tess.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

static bool equal(const tess::Config &config, const std::vector<float> &factors) {
    tess::Batch batch(config);
    TessBatchCounts counts = batch.count(factors);
    std::vector<TessPoint> points(counts.points);
    std::vector<uint32_t> indices(counts.indices);
    std::vector<TessRange> ranges(counts.patches);
    batch.run(factors, points, indices, ranges);

    std::vector<TessPoint> model_points(TESS_MAX_POINTS);
    std::vector<uint32_t> model_indices(TESS_MAX_INDICES);
    const auto same = [](const TessPoint &a, const TessPoint &b) { return a.u == b.u && a.v == b.v; };
    for (std::size_t i = 0; i < ranges.size(); i++) {
        const std::vector<float> own(factors.begin() + i * 6, factors.begin() + i * 6 + 6);
        const TessCounts one = tess::patch(config, own, model_points, model_indices);
        const TessRange &range = ranges[i];
        if (range.points != one.points || range.indices != one.indices
            || !std::equal(&model_points[0], &model_points[0] + one.points, &points[0] + range.first_point, same)
            || !std::equal(&model_indices[0], &model_indices[0] + one.indices, &indices[0] + range.first_index)) {
            std::fprintf(stderr, "patch %u differs\n", unsigned(i));
            return false;
        }
    }
    std::printf("%u patches, %u points, %u indices\n", unsigned(counts.patches), unsigned(counts.points),
                unsigned(counts.indices));
    return true;
}

int main() {
    std::vector<float> factors(1000 * 6);
    for (std::size_t i = 0; i < factors.size(); i++) factors[i] = 1 + float(i * 37 % 101) / 16;
    try {
        return equal({tess::Domain::quad, tess::Partitioning::fractional_odd}, factors) ? 0 : 1;
    } catch (const tess::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
