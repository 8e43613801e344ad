// needs: stages/d3d_float, stages/fixed_point, stages/factor_context, layout/setup, layout/topology
// The steps of factor processing (spec section 3) on the bits of raw factors.

const BITS_1 = 0x3f800000u;
const BITS_2 = 0x40000000u;
const BITS_63 = 0x427c0000u;
const BITS_64 = 0x42800000u;
const BITS_1_PLUS_2_POW_MINUS_17 = 0x3f800040u;
const BITS_1_PLUS_2_POW_MINUS_16 = 0x3f800080u;

const LOW = select(BITS_1, BITS_2, PARTITIONING == FRACTIONAL_EVEN);
const HIGH = select(BITS_64, BITS_63, PARTITIONING == FRACTIONAL_ODD);

// A patch after factor processing: 15.16 factors, their parities (1 is odd) and its topology.
// An isoline has density and detail as its first two outer factors, a triangle one inside factor.
struct Processed {
    outer: vec4<u32>,
    outer_odd: vec4<u32>,
    inside: vec2<u32>,
    inside_odd: vec2<u32>,
    topology: vec2<u32>,
}

// Steps 2, 3 and 7: clamped, rounded and converted.
fn fixed_factor(bits: u32, low: u32, high: u32, rounds: bool) -> u32 {
    let clamped = clamp_factor(bits, low, high);
    if rounds {
        return ceil_factor(clamped) << 16u;
    }
    return fixed_from_bits(clamped);
}

// Step 6 for an outer factor.
fn edge_parity(factor: u32, rounds: bool) -> u32 {
    return select(select(0u, 1u, PARTITIONING == FRACTIONAL_ODD), (factor >> 16u) & 1u, rounds);
}

// Step 6 for an inside factor: an integer factor of exactly 1 counts as even.
fn inside_parity(factor: u32) -> u32 {
    return select(edge_parity(factor, IS_INTEGER), 0u, IS_INTEGER && factor == ONE);
}

fn process_edge(bits: u32) -> vec2<u32> {
    let factor = fixed_factor(bits, LOW, HIGH, IS_INTEGER);
    return vec2<u32>(factor, edge_parity(factor, IS_INTEGER));
}

fn process_inside(bits: u32, low: u32) -> vec2<u32> {
    let factor = fixed_factor(bits, low, HIGH, IS_INTEGER);
    return vec2<u32>(factor, inside_parity(factor));
}

// Step 4: the lower bound of the inside factors.
fn inside_low(any_above: bool) -> u32 {
    return select(LOW, BITS_1_PLUS_2_POW_MINUS_16, PARTITIONING == FRACTIONAL_ODD && any_above);
}

fn is_above(bits: u32) -> bool {
    return is_greater(bits, BITS_1_PLUS_2_POW_MINUS_17);
}

fn process_isoline(raw: vec2<u32>) -> Processed {
    var out: Processed;
    let density = fixed_factor(raw.x, BITS_1, BITS_64, true);
    let density_odd = edge_parity(density, true);
    let detail = process_edge(raw.y);
    out.outer = vec4<u32>(density, detail.x, 0u, 0u);
    out.outer_odd = vec4<u32>(density_odd, detail.y, 0u, 0u);
    let is_culled = !(is_greater_than_zero(raw.x) && is_greater_than_zero(raw.y));
    let points = edge_points(density, density_odd) | (edge_points(detail.x, detail.y) << 7u);
    out.topology = vec2<u32>(points | (select(REGULAR, CULLED, is_culled) << 28u), 0u);
    return out;
}

fn process_triangle(raw: vec4<u32>) -> Processed {
    var out: Processed;
    let a = process_edge(raw.x);
    let b = process_edge(raw.y);
    let c = process_edge(raw.z);
    let any_above = is_above(raw.x) || is_above(raw.y) || is_above(raw.z) || is_above(raw.w);
    let i = process_inside(raw.w, inside_low(any_above));
    out.outer = vec4<u32>(a.x, b.x, c.x, 0u);
    out.outer_odd = vec4<u32>(a.y, b.y, c.y, 0u);
    out.inside = vec2<u32>(i.x, i.x);
    out.inside_odd = vec2<u32>(i.y, i.y);
    let is_culled = !(is_greater_than_zero(raw.x) && is_greater_than_zero(raw.y)
        && is_greater_than_zero(raw.z));
    let is_minimum = a.x == ONE && b.x == ONE && c.x == ONE && i.x == ONE;
    out.topology = make_topology(out, is_culled, is_minimum);
    return out;
}

fn process_quad(raw: vec4<u32>, raw_inside: vec2<u32>) -> Processed {
    var out: Processed;
    let a = process_edge(raw.x);
    let b = process_edge(raw.y);
    let c = process_edge(raw.z);
    let d = process_edge(raw.w);
    let any_above = is_above(raw.x) || is_above(raw.y) || is_above(raw.z) || is_above(raw.w)
        || is_above(raw_inside.x) || is_above(raw_inside.y);
    let low = inside_low(any_above);
    let u = process_inside(raw_inside.x, low);
    let v = process_inside(raw_inside.y, low);
    out.outer = vec4<u32>(a.x, b.x, c.x, d.x);
    out.outer_odd = vec4<u32>(a.y, b.y, c.y, d.y);
    out.inside = vec2<u32>(u.x, v.x);
    out.inside_odd = vec2<u32>(u.y, v.y);
    let is_culled = !(is_greater_than_zero(raw.x) && is_greater_than_zero(raw.y)
        && is_greater_than_zero(raw.z) && is_greater_than_zero(raw.w));
    let is_minimum = a.x == ONE && b.x == ONE && c.x == ONE && d.x == ONE && u.x == ONE
        && v.x == ONE;
    out.topology = make_topology(out, is_culled, is_minimum);
    return out;
}

// Step 8, and the numbers of points along all edges and axes. A triangle's fourth edge stays 0.
fn make_topology(processed: Processed, is_culled: bool, is_minimum: bool) -> vec2<u32> {
    let f = processed.outer;
    let odd = processed.outer_odd;
    var outer = edge_points(f.x, odd.x) | (edge_points(f.y, odd.y) << 7u)
        | (edge_points(f.z, odd.z) << 14u);
    if DOMAIN == QUAD {
        outer |= edge_points(f.w, odd.w) << 21u;
    }
    let u = edge_points(processed.inside.x, processed.inside_odd.x);
    let v = edge_points(processed.inside.y, processed.inside_odd.y);
    let state = select(select(REGULAR, MINIMUM, is_minimum), CULLED, is_culled);
    return vec2<u32>(outer | (state << 28u), u | (v << 7u));
}
