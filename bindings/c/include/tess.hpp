// The functions of tess.h for C++17, with enumerations instead of numbers, containers instead of pointers and sizes,
// exceptions instead of statuses, and a batch that frees itself. Everything is inline: link the library as for C.
//
//   tess::Batch batch({tess::Domain::quad, tess::Partitioning::integer});
//   std::vector<float> factors(6 * patches, 4.0f);
//   TessBatchCounts counts = batch.count(factors);
//   std::vector<TessPoint> points(counts.points);
//   std::vector<uint32_t> indices(counts.indices);
//   std::vector<TessRange> ranges(counts.patches);
//   batch.run(factors, points, indices, ranges);

#ifndef TESS_HPP
#define TESS_HPP

#include "tess.h"

#include <cstddef>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace tess {

enum class Domain : uint32_t {
    isoline = TESS_DOMAIN_ISOLINE,
    triangle = TESS_DOMAIN_TRIANGLE,
    quad = TESS_DOMAIN_QUAD
};
enum class Partitioning : uint32_t {
    integer = TESS_PARTITIONING_INTEGER,
    pow2 = TESS_PARTITIONING_POW2,
    fractional_odd = TESS_PARTITIONING_FRACTIONAL_ODD,
    fractional_even = TESS_PARTITIONING_FRACTIONAL_EVEN
};
enum class Output : uint32_t {
    point = TESS_OUTPUT_POINT,
    line = TESS_OUTPUT_LINE,
    triangle_cw = TESS_OUTPUT_TRIANGLE_CW,
    triangle_ccw = TESS_OUTPUT_TRIANGLE_CCW
};
enum class Split : uint32_t { ruler = TESS_SPLIT_RULER, center = TESS_SPLIT_CENTER };
enum class Level : uint32_t {
    detect = TESS_LEVEL_DETECT,
    baseline = TESS_LEVEL_BASELINE,
    avx2 = TESS_LEVEL_AVX2,
    avx512 = TESS_LEVEL_AVX512
};
enum class Triangles : uint32_t { specified = TESS_TRIANGLES_SPECIFIED, vertex_cache = TESS_TRIANGLES_VERTEX_CACHE };
enum class Numbering : uint32_t { per_patch = TESS_NUMBERING_PER_PATCH, per_batch = TESS_NUMBERING_PER_BATCH };

/// A status other than TESS_OK.
class Error : public std::runtime_error {
public:
    explicit Error(TessStatus status) : Error(status, tess_status_message(status)) {}
    TessStatus status;

protected:
    Error(TessStatus status, const std::string &message) : std::runtime_error(message), status(status) {}
};

/// TESS_BUFFER_TOO_SMALL, with the buffer and the number of elements that it needs.
class BufferTooSmall : public Error {
public:
    explicit BufferTooSmall(const TessShortage &shortage)
        : Error(TESS_BUFFER_TOO_SMALL, message(shortage)), shortage(shortage) {}
    TessShortage shortage;

private:
    static std::string message(const TessShortage &shortage) {
        const char *const names[] = {"point", "index", "range"};
        return std::string("the ") + names[shortage.buffer] + " buffer holds " + std::to_string(shortage.got)
            + " elements, but " + std::to_string(shortage.needed) + " are needed";
    }
};

inline void check(TessStatus status) {
    TessShortage shortage;
    if (status == TESS_BUFFER_TOO_SMALL && tess_shortage(&shortage) == TESS_OK) throw BufferTooSmall(shortage);
    if (status != TESS_OK) throw Error(status);
}

/// The configuration of a tessellator.
struct Config {
    Domain domain = Domain::triangle;
    Partitioning partitioning = Partitioning::integer;
    Output output = Output::triangle_cw;
    Split split = Split::ruler;

    operator TessConfig() const {
        return {uint32_t(domain), uint32_t(partitioning), uint32_t(output), uint32_t(split)};
    }
};

/// A point as a pair of binary32 numbers, for TESS_POINT_F32.
struct PointF32 {
    float u, v;
};

/// Counts the output of one patch. `Factors` is any contiguous container of float, such as std::array.
template <class Factors>
TessCounts count(const Config &config, const Factors &factors) {
    const TessConfig c = config;
    TessCounts counts;
    check(tess_count(&c, std::data(factors), std::size(factors), &counts));
    return counts;
}

/// Tessellates one patch by the model, into contiguous containers of TessPoint and uint32_t.
template <class Factors, class Points, class Indices>
TessCounts patch(const Config &config, const Factors &factors, Points &points, Indices &indices) {
    const TessConfig c = config;
    TessCounts counts;
    check(tess_patch(&c, std::data(factors), std::size(factors), std::data(points), std::size(points),
                     std::data(indices), std::size(indices), &counts));
    return counts;
}

/// A tessellator for many patches of one configuration, at the speed of tess-simd. Keep it: it learns from patches.
class Batch {
public:
    explicit Batch(const Config &config, Level level = Level::detect)
        : factors_of_a_patch(2 + 2 * std::size_t(config.domain)) {
        const TessConfig c = config;
        TessBatch *made = nullptr;
        check(tess_batch_create(&c, uint32_t(level), &made));
        batch.reset(made);
    }

    Level level() const {
        uint32_t number;
        check(tess_batch_level(batch.get(), &number));
        return Level(number);
    }

    /// Allocates all memory that later calls can need.
    void reserve() { check(tess_batch_reserve(batch.get())); }

    void set_triangles(Triangles order) { check(tess_batch_set_triangles(batch.get(), uint32_t(order))); }
    void set_threads(uint32_t threads) { check(tess_batch_set_threads(batch.get(), threads)); }

    template <class Factors>
    TessBatchCounts count(const Factors &factors) {
        TessBatchCounts counts;
        check(tess_batch_count(batch.get(), std::data(factors), std::size(factors), &counts));
        return counts;
    }

    /// Tessellates all patches. Points are TessPoint or PointF32, indices uint32_t or uint16_t.
    template <class Factors, class Points, class Indices, class Ranges,
              class = decltype(std::data(std::declval<Ranges &>()))>
    TessBatchCounts run(const Factors &factors, Points &points, Indices &indices, Ranges &ranges,
                        Numbering numbering = Numbering::per_patch, uint32_t base_vertex = 0) {
        TessBatchOutput output = described(points, indices, numbering, base_vertex);
        TessRange none; // The data of an empty container may be null, which would ask for no ranges.
        output.ranges = std::data(ranges) ? std::data(ranges) : &none;
        output.range_capacity = std::size(ranges);
        return run(factors, output);
    }

    /// Tessellates all patches, without ranges.
    template <class Factors, class Points, class Indices>
    TessBatchCounts run(const Factors &factors, Points &points, Indices &indices,
                        Numbering numbering = Numbering::per_patch, uint32_t base_vertex = 0) {
        return run(factors, described(points, indices, numbering, base_vertex));
    }

    /// Tessellates one patch. Up to 64 elements past its output may be overwritten.
    template <class Factors, class Points, class Indices>
    TessCounts patch(const Factors &factors, Points &points, Indices &indices) {
        if (std::size(factors) != factors_of_a_patch) throw Error(TESS_WRONG_FACTOR_COUNT);
        const TessBatchOutput output = described(points, indices, Numbering::per_patch, 0);
        TessCounts counts;
        check(tess_batch_patch(batch.get(), std::data(factors), &output, &counts));
        return counts;
    }

    TessBatch *get() const { return batch.get(); }

private:
    template <class Factors>
    TessBatchCounts run(const Factors &factors, const TessBatchOutput &output) {
        TessBatchCounts counts;
        check(tess_batch_run(batch.get(), std::data(factors), std::size(factors), &output, &counts));
        return counts;
    }

    /// The elements of C++ containers are initialised, so TESS_MEMORY_INITIALISED holds.
    template <class Points, class Indices>
    static TessBatchOutput described(Points &points, Indices &indices, Numbering numbering, uint32_t base_vertex) {
        using Point = std::remove_reference_t<decltype(*std::data(points))>;
        using Index = std::remove_reference_t<decltype(*std::data(indices))>;
        static_assert(std::is_same_v<Point, TessPoint> || std::is_same_v<Point, PointF32>,
                      "points are of TessPoint or tess::PointF32");
        static_assert(std::is_same_v<Index, uint32_t> || std::is_same_v<Index, uint16_t>,
                      "indices are of uint32_t or uint16_t");
        TessBatchOutput output = {};
        output.points = std::data(points);
        output.point_capacity = std::size(points);
        output.indices = std::data(indices);
        output.index_capacity = std::size(indices);
        output.point_format = std::is_same_v<Point, TessPoint> ? TESS_POINT_FIXED : TESS_POINT_F32;
        output.index_type = sizeof(Index) == 2 ? TESS_INDEX_U16 : TESS_INDEX_U32;
        output.numbering = uint32_t(numbering);
        output.base_vertex = base_vertex;
        output.memory = TESS_MEMORY_INITIALISED;
        return output;
    }

    struct Free {
        void operator()(TessBatch *batch) const { tess_batch_free(batch); }
    };
    std::size_t factors_of_a_patch;
    std::unique_ptr<TessBatch, Free> batch;
};

}  // namespace tess

#endif
