#include <cmath>
#include <string>

#include "gpu/probe/compute_stage.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/probe/vertex_stage.hpp"

namespace lockstep::probing {
namespace {

constexpr std::size_t sine_inputs = 1024;

/// Angles for sin up to 2^15, for cos and tan up to 2^10, where Mesa's reduction still holds.
Floats angles() {
    const Floats far = random_floats(sine_inputs, 51, {-4, 14, true}),
                 near = random_floats(sine_inputs, 52, {-4, 9, true});
    Floats all;
    for (std::size_t i = 0; i < sine_inputs; ++i)
        all.insert(all.end(), {far[i], near[i], near[sine_inputs - 1 - i]});
    return all;
}

/// sin, quarter 0, or cos, quarter 1, as Mesa's llvmpipe makes them: Cody and Waite's reduction to an eighth of a turn,
/// then a polynomial of the Cephes library. `mad`: a * b + c with one or two roundings.
template <class Mad> float polynomial(float x, int quarter, Mad mad) {
    const float size = std::abs(x);
    const int j = (static_cast<int>(size * 1.27323954473516F) + 1) & ~1;
    const auto f = static_cast<float>(j);
    float rest = mad(f, -0.78515625F, size);
    rest = mad(f, -2.4187564849853515625e-4F, rest);
    rest = mad(f, -3.77489497744594108e-8F, rest);
    const float z = rest * rest;
    float even = mad(z, 2.443315711809948e-5F, -1.388731625493765e-3F);
    even = mad(even, z, 4.166664568298827e-2F);
    even = even * z;
    even = even * z;
    even = even - z * 0.5F;
    even = even + 1.0F;
    float odd = mad(z, -1.9515295891e-4F, 8.3321608736e-3F);
    odd = mad(odd, z, -1.6666654611e-1F);
    odd = odd * z;
    odd = mad(odd, rest, rest);
    const int quadrant = (j / 2 + quarter) & 3;
    const float part = (quadrant & 1) != 0 ? even : odd;
    return ((quadrant & 2) != 0) != (quarter == 0 && x < 0.0F) ? -part : part;
}

Floats in_vertex_stage(const Floats& given) {
    const VertexStage stage("probe/sines", {}, {{"a_Angles", 3}}, {{"out_Made", GL_FLOAT_VEC3}});
    return stage.run(sine_inputs, {{"a_Angles", 3, given.data()}}, "out_Made");
}

Floats in_compute_stage(const Floats& given) { return ComputeStage("probe/sines").run(given, sine_inputs); }

void judge_sines(const std::string& stage, const Floats& given, const Floats& made, Rows& rows) {
    const auto once = [](float a, float b, float c) { return std::fma(a, b, c); };
    const auto twice = [](float a, float b, float c) { return a * b + c; };
    const auto row = [&](const char* name, std::size_t place, const auto& fused, const auto& each, const auto& exact) {
        Floats values, if_fused, if_each, if_exact;
        for (std::size_t i = place; i < given.size(); i += 3) {
            values.push_back(made[i]);
            if_fused.push_back(fused(given[i]));
            if_each.push_back(each(given[i]));
            if_exact.push_back(static_cast<float>(exact(double{given[i]})));
        }
        rows.push_back(judge(
            stage + name, values,
            {{"polynomial, fused", if_fused}, {"polynomial, each rounded", if_each}, {"rounded correctly", if_exact}}));
    };
    row(
        "sin, to 32768", 0, [&](float x) { return polynomial(x, 0, once); },
        [&](float x) { return polynomial(x, 0, twice); }, [](double x) { return std::sin(x); });
    row(
        "cos, to 1024", 1, [&](float x) { return polynomial(x, 1, once); },
        [&](float x) { return polynomial(x, 1, twice); }, [](double x) { return std::cos(x); });
    row(
        "tan, to 1024", 2, [&](float x) { return polynomial(x, 0, once) / polynomial(x, 1, once); },
        [&](float x) { return polynomial(x, 0, twice) / polynomial(x, 1, twice); },
        [](double x) { return std::tan(x); });
}

} // namespace

void measure_sines(Rows& rows) {
    const Floats given = angles();
    judge_sines("", given, in_vertex_stage(given), rows);
}

void measure_compute_sines(Rows& rows) {
    const Floats given = angles();
    judge_sines("compute: ", given, in_compute_stage(given), rows);
}

} // namespace lockstep::probing
