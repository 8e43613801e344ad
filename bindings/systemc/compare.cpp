// Compares the circuit with the model in SystemC: sends the same patches through both, each with its own back-pressure,
// and compares every element of the three streams in order.
//
//   compare [--patches N] [--seed N] [--fault]      --fault: the model gets the other split order, which must be found
//
// Exit status: 0 equal, 1 different, 2 bad usage.
#include "tess_model.h"
#include "tess_rtl.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string>

struct patch_t {
    uint32_t domain, partitioning, out;
    bool center;
    std::array<uint32_t, 6> factors;
};

// The fields of one transferred element; unused ones are 0.
struct element_t {
    std::array<uint32_t, 5> field;
    bool operator!=(const element_t &other) const { return field != other.field; }
};
using stream_t = std::vector<element_t>;

static uint32_t next(uint32_t &state) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

// Mostly 1 to 8 in steps of 1/16, sometimes up to 64, sometimes any bits.
static uint32_t random_factor(uint32_t &state) {
    const uint32_t kind = next(state) % 16;
    if (kind == 0) return next(state);
    const float factor = kind == 1 ? 1.0f + static_cast<float>(next(state) % 1009) / 16.0f
                                   : 1.0f + static_cast<float>(next(state) % 113) / 16.0f;
    uint32_t bits;
    std::memcpy(&bits, &factor, sizeof bits);
    return bits;
}

static std::vector<patch_t> random_patches(uint32_t count, uint32_t seed) {
    uint32_t state = seed == 0 ? 1 : seed;
    std::vector<patch_t> patches(count);
    for (patch_t &patch : patches) {
        const uint32_t domain = next(state) % 16 == 0 ? 3 : next(state) % 3; // 3 is not a domain
        patch = {domain, next(state) % 4, next(state) % 4, next(state) % 2 == 1, {}};
        for (uint32_t &factor : patch.factors) factor = random_factor(state);
    }
    return patches;
}

// Drives one device at falling edges and records what is transferred at rising edges.
struct harness : sc_core::sc_module {
    SC_HAS_PROCESS(harness);
    sc_core::sc_in<bool> clk{"clk"};
    std::array<stream_t, 3> streams;
    bool is_done = false;

    harness(const sc_core::sc_module_name &name, tess_ports &dut, const std::vector<patch_t> &patches, uint32_t seed,
        bool flips_split)
        : sc_module(name), patches(patches), state(seed), flips_split(flips_split) {
        dut.clk(clk);
        dut.rst(rst);
        dut.patch_valid(patch_valid), dut.patch_ready(patch_ready), dut.patch_domain(patch_domain);
        dut.patch_partitioning(patch_partitioning), dut.patch_out(patch_out), dut.patch_center(patch_center);
        dut.patch_factors(patch_factors);
        dut.counts_valid(valid[0]), dut.counts_ready(ready[0]);
        dut.counts_points(data[0][0]), dut.counts_primitives(data[0][1]);
        dut.point_valid(valid[1]), dut.point_ready(ready[1]);
        dut.point_u(data[1][0]), dut.point_v(data[1][1]), dut.point_last(last[1]);
        dut.primitive_valid(valid[2]), dut.primitive_ready(ready[2]), dut.primitive_size(data[2][0]);
        dut.primitive_i0(data[2][1]), dut.primitive_i1(data[2][2]), dut.primitive_i2(data[2][3]);
        dut.primitive_last(last[2]);
        SC_METHOD(note);
        sensitive << clk.pos();
        dont_initialize();
        SC_METHOD(drive);
        sensitive << clk.neg();
        dont_initialize();
    }

  private:
    const std::vector<patch_t> &patches;
    uint32_t state;
    bool flips_split;
    size_t accepted = 0;
    uint32_t clocks = 0, quiet = 0;

    sc_core::sc_signal<bool> rst, patch_valid, patch_ready, patch_center, valid[3], ready[3], last[3];
    sc_core::sc_signal<uint32_t> patch_domain, patch_partitioning, patch_out, data[3][4];
    sc_core::sc_signal<sc_dt::sc_bv<192>> patch_factors;

    void note() {
        if (rst.read() || clocks < 4) return;
        quiet++;
        if (patch_valid.read() && patch_ready.read()) accepted++, quiet = 0;
        for (int s = 0; s < 3; s++) {
            if (!valid[s].read() || !ready[s].read()) continue;
            element_t element{};
            for (int k = 0; k < (s == 2 ? 4 : 2); k++) element.field[k] = data[s][k].read();
            element.field[4] = last[s].read();
            streams[s].push_back(element);
            quiet = 0;
        }
        is_done = accepted == patches.size() && quiet > 100;
    }

    void drive() {
        clocks++;
        rst.write(clocks < 4);
        const uint32_t bits = next(state);
        for (int s = 0; s < 3; s++) ready[s].write((bits >> (2 * s) & 3) != 0);
        const bool has_patch = clocks >= 4 && accepted < patches.size();
        patch_valid.write(has_patch);
        if (!has_patch) return;
        const patch_t &patch = patches[accepted];
        patch_domain.write(patch.domain);
        patch_partitioning.write(patch.partitioning);
        patch_out.write(patch.out);
        patch_center.write(patch.center != flips_split);
        sc_dt::sc_bv<192> factors;
        for (int i = 0; i < 6; i++) factors.range(32 * i + 31, 32 * i) = patch.factors[i];
        patch_factors.write(factors);
    }
};

static bool differ(const char *name, const stream_t &rtl, const stream_t &model) {
    for (size_t i = 0; i < rtl.size() && i < model.size(); i++) {
        if (!(rtl[i] != model[i])) continue;
        std::printf("MISMATCH stream=%s element=%zu rtl=", name, i);
        for (uint32_t field : rtl[i].field) std::printf("%" PRIx32 " ", field);
        std::printf("model=");
        for (uint32_t field : model[i].field) std::printf("%" PRIx32 " ", field);
        std::printf("\n");
        return true;
    }
    if (rtl.size() == model.size()) return false;
    std::printf("MISMATCH stream=%s elements: rtl %zu, model %zu\n", name, rtl.size(), model.size());
    return true;
}

int sc_main(int argc, char **argv) {
    uint32_t count = 300, seed = 1;
    bool has_fault = false;
    for (int i = 1; i < argc; i++) {
        const std::string word = argv[i];
        char *end = nullptr;
        uint32_t *number = word == "--patches" ? &count : word == "--seed" ? &seed : nullptr;
        if (number != nullptr && i + 1 < argc) *number = static_cast<uint32_t>(std::strtoul(argv[++i], &end, 10));
        if (word == "--fault") has_fault = true;
        else if (end == nullptr || *end != '\0' || count == 0) {
            std::fprintf(stderr, "`%s`: usage: compare [--patches N] [--seed N] [--fault], N from 1\n", word.c_str());
            return 2;
        }
    }
    const std::vector<patch_t> patches = random_patches(count, seed);
    sc_core::sc_clock clk("clk", 10, sc_core::SC_NS);
    tess_rtl rtl("rtl");
    tess_model model("model");
    harness of_rtl("of_rtl", rtl, patches, seed + 1, false);
    harness of_model("of_model", model, patches, seed + 2, has_fault);
    of_rtl.clk(clk);
    of_model.clk(clk);
    while (!of_rtl.is_done || !of_model.is_done) {
        sc_core::sc_start(10, sc_core::SC_US);
        if (sc_core::sc_time_stamp() > sc_core::sc_time(count * 1000.0, sc_core::SC_US)) {
            std::printf("FAIL: a device does not come to its end\n");
            return 1;
        }
    }
    static const char *const NAMES[] = {"counts", "points", "primitives"};
    bool is_different = false;
    for (int s = 0; s < 3; s++) is_different |= differ(NAMES[s], of_rtl.streams[s], of_model.streams[s]);
    const auto &streams = of_rtl.streams;
    if (is_different || streams[0].size() != count || streams[1].empty() || streams[2].empty()) return 1;
    const auto culled = std::count_if(patches.begin(), patches.end(), [](const patch_t &patch) { return patch.domain == 3; });
    std::printf("%zu patches, %zu of domain 3, %zu points, %zu primitives equal\n", streams[0].size(),
        static_cast<size_t>(culled), streams[1].size(), streams[2].size());
    return 0;
}
