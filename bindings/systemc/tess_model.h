// The golden model as a SystemC module, with the elements and order of the circuit, one element of each stream per clock.
// Its latency between patches differs from the circuit's. It links libtess_capi and needs nothing of rtl/.
#ifndef TESS_MODEL_H
#define TESS_MODEL_H

#include "tess.h"
#include "tess_ports.h"

#include <cstring>
#include <deque>
#include <vector>

class tess_model : public tess_ports {
  public:
    SC_HAS_PROCESS(tess_model);
    explicit tess_model(const sc_core::sc_module_name &name)
        : tess_ports(name), fixed(TESS_MAX_POINTS), indices(TESS_MAX_INDICES) {
        SC_METHOD(step);
        sensitive << clk.pos();
        dont_initialize();
    }

  private:
    struct primitive_t {
        uint32_t size, i[3];
        bool last;
    };
    struct point_t {
        uint32_t u, v;
        bool last;
    };

    std::vector<TessPoint> fixed; // of the patch that is being tessellated
    std::vector<uint32_t> indices;
    // Elements that are still to be output.
    std::deque<TessCounts> counts;
    std::deque<point_t> points;
    std::deque<primitive_t> primitives;

    // At a rising edge, removes the elements that were taken, and takes the patch that was offered.
    void step() {
        if (rst.read()) {
            counts.clear();
            points.clear();
            primitives.clear();
        } else {
            if (counts_valid.read() && counts_ready.read()) counts.pop_front();
            if (point_valid.read() && point_ready.read()) points.pop_front();
            if (primitive_valid.read() && primitive_ready.read()) primitives.pop_front();
            if (patch_valid.read() && patch_ready.read()) tessellate();
        }
        offer();
    }

    void tessellate() {
        const TessConfig config = {patch_domain.read(), patch_partitioning.read(), patch_out.read(), patch_center.read()};
        static const size_t FACTORS[] = {2, 4, 6};
        float factors[TESS_MAX_FACTORS] = {};
        for (int i = 0; i < TESS_MAX_FACTORS; i++) {
            const uint32_t bits = patch_factors.read().range(32 * i + 31, 32 * i).to_uint();
            std::memcpy(&factors[i], &bits, sizeof bits);
        }
        TessCounts made = {};
        if (config.domain > TESS_DOMAIN_QUAD) { // culled, as in the circuit
            counts.push_back(made);
            return;
        }
        const TessStatus status = tess_patch(&config, factors, FACTORS[config.domain], fixed.data(), fixed.size(),
            indices.data(), indices.size(), &made);
        if (status != TESS_OK) SC_REPORT_FATAL(name(), tess_status_message(status));
        counts.push_back(made);
        for (uint32_t i = 0; i < made.points; i++) points.push_back({fixed[i].u, fixed[i].v, i + 1 == made.points});
        const uint32_t size = made.primitives == 0 ? 0 : made.indices / made.primitives;
        for (uint32_t t = 0; t < made.primitives; t++) {
            primitive_t next = {size, {0, 0, 0}, t + 1 == made.primitives};
            for (uint32_t k = 0; k < size; k++) next.i[k] = indices[size * t + k];
            primitives.push_back(next);
        }
    }

    void offer() {
        // Accepts a patch only if less than one patch's largest output is waiting.
        patch_ready.write(!rst.read() && points.size() < TESS_MAX_POINTS && counts.size() < 2);
        counts_valid.write(!counts.empty());
        point_valid.write(!points.empty());
        primitive_valid.write(!primitives.empty());
        if (!counts.empty()) {
            counts_points.write(counts.front().points);
            counts_primitives.write(counts.front().primitives);
        }
        if (!points.empty()) {
            point_u.write(points.front().u);
            point_v.write(points.front().v);
            point_last.write(points.front().last);
        }
        if (!primitives.empty()) {
            primitive_size.write(primitives.front().size);
            primitive_i0.write(primitives.front().i[0]);
            primitive_i1.write(primitives.front().i[1]);
            primitive_i2.write(primitives.front().i[2]);
            primitive_last.write(primitives.front().last);
        }
    }
};

#endif
