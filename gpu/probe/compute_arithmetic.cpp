#include <array>
#include <cmath>
#include <utility>

#include "gpu/probe/compute_stage.hpp"
#include "gpu/probe/constant_divisors.hpp"
#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"

namespace lockstep::probing {
namespace {

constexpr std::size_t compute_inputs = 1024;

/// What the shader makes of x and the operand: u_What.
enum class Made { product, sum, below };

Floats computed(const ComputeStage& stage, const Floats& x, float operand, Made what) {
    stage.program().set("u_Operand", operand);
    stage.program().set("u_What", static_cast<int>(what));
    return stage.run(x, x.size());
}

ProbeRow measure_product(const ComputeStage& stage, const char* name, int exponent, float factor) {
    const Floats x = random_floats(compute_inputs, 35, {exponent, exponent + 1, true});
    Floats kept, flushed, if_unsigned;
    for (const float value : x) {
        kept.push_back(value * factor);
        flushed.push_back(std::copysign(0.0F, value));
        if_unsigned.push_back(0.0F);
    }
    return judge(name, computed(stage, x, factor, Made::product),
                 {{"flushed", flushed}, {"flushed to +0", if_unsigned}, {"kept", kept}});
}

/// Where an operand or the sum is subnormal; `flushed`: what it is then.
template <class Flushed>
ProbeRow measure_sum(const ComputeStage& stage, const char* name, const Floats& x, float addend, Flushed flushed) {
    Floats kept, if_flushed, if_unsigned;
    for (const float value : x) {
        kept.push_back(value + addend);
        if_flushed.push_back(flushed(value));
        if_unsigned.push_back(if_flushed.back() + 0.0F);
    }
    return judge(name, computed(stage, x, addend, Made::sum),
                 {{"flushed", if_flushed}, {"flushed to +0", if_unsigned}, {"kept", kept}});
}

ProbeRow measure_comparison(const ComputeStage& stage, const char* name) {
    const Floats x = random_floats(compute_inputs, 40, {-135, -130, true});
    Floats kept;
    for (const float value : x)
        kept.push_back(value < 0.0F ? 1.0F : 0.0F);
    return judge(name, computed(stage, x, 0.0F, Made::below),
                 {{"flushed", Floats(compute_inputs, 0.0F)}, {"kept", kept}});
}

constexpr std::size_t results_each = 15;

/// What shaders/probe/arithmetic.comp makes of each pair, `results_each` floats.
Floats operations_of(const Vectors& a, const Vectors& b) {
    Floats pairs;
    for (std::size_t i = 0; i < a.size(); ++i)
        pairs.insert(pairs.end(), {a[i].x, a[i].y, a[i].z, b[i].x, b[i].y, b[i].z});
    return ComputeStage("probe/arithmetic").run(pairs, results_each * a.size(), a.size());
}

template <class Read> Floats each_of(const Vectors& vectors, Read read) {
    Floats values;
    for (const glm::vec3& v : vectors)
        values.push_back(read(v));
    return values;
}

/// a.x, a.y, a.z and b.x of each pair, by constants: places 11 to 14.
ProbeRow measure_constant_divisors(const DriverArithmetic& vertex, const Vectors& a, const Vectors& b,
                                   const Floats& made) {
    Floats dividends, values;
    for (std::size_t i = 0; i < a.size(); ++i) {
        dividends.insert(dividends.end(), {a[i].x, a[i].y, a[i].z, b[i].x});
        for (std::size_t k = 0; k < 4; ++k)
            values.push_back(made[results_each * i + 11 + k]);
    }
    return judge_constant_divisors("compute: a/c, c constant", vertex, dividends, values);
}

/// The operations that GLSL leaves open, held against the vertex stage's, whose sequences other rows have.
void measure_operations(const DriverArithmetic& vertex, Rows& rows) {
    const Vectors a = random_vectors(compute_inputs, 38, {}), b = random_vectors(compute_inputs, 39, {});
    const Floats made = operations_of(a, b);
    const auto row = [&](const char* name, std::size_t first, std::size_t count, const Floats& of_vertex) {
        Floats values;
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::size_t k = first; k < first + count; ++k)
                values.push_back(made[results_each * i + k]);
        rows.push_back(judge(name, values, {{"as in the vertex stage", of_vertex}}));
    };
    const auto x = [](glm::vec3 v) { return v.x; };
    row("compute: a/b", 0, 1, vertex.divide(each_of(a, x), each_of(b, x)));
    rows.push_back(measure_constant_divisors(vertex, a, b, made));
    row("compute: 1/b", 1, 1, vertex.reciprocal(each_of(b, [](glm::vec3 v) { return v.y; })));
    row("compute: sqrt", 2, 1, vertex.sqrt(each_of(a, [](glm::vec3 v) { return std::abs(v.y); })));
    row("compute: inversesqrt", 3, 1, vertex.inverse_sqrt(each_of(a, [](glm::vec3 v) { return std::abs(v.z); })));
    row("compute: dot(vec3)", 4, 1, vertex.dot(a, b));
    row("compute: length", 5, 1, vertex.length(b));
    row("compute: normalize", 6, 3, vertex.normalize(a));
    const auto fused = [&](const char* name, std::size_t place, const Floats& rounded, const Floats& once) {
        Floats values;
        for (std::size_t i = 0; i < a.size(); ++i)
            values.push_back(made[results_each * i + place]);
        rows.push_back(judge(name, values, {{"each rounded", rounded}, {"fused", once}}));
    };
    fused("compute: a*b+c, in functions", 9, each_of(a, [](glm::vec3 v) { return v.x * v.y + v.z; }),
          each_of(a, [](glm::vec3 v) { return std::fma(v.x, v.y, v.z); }));
    fused("compute: c-a*b, in functions", 10, each_of(b, [](glm::vec3 v) { return v.z - v.x * v.y; }),
          each_of(b, [](glm::vec3 v) { return std::fma(-v.x, v.y, v.z); }));
}

} // namespace

void measure_compute_arithmetic(const DriverArithmetic& precise, Rows& rows) {
    measure_operations(precise, rows);
    const ComputeStage stage("probe/product");
    rows.push_back(measure_product(stage, "compute: subnormal operand of *", -130, 0x1p60F));
    rows.push_back(measure_product(stage, "compute: subnormal result of *", -100, 0x1p-32F));
    rows.push_back(measure_sum(stage, "compute: subnormal operand of +",
                               random_floats(compute_inputs, 36, {-128, -127, true}), 0x1p-125F,
                               [](float) { return 0x1p-125F; }));
    rows.push_back(measure_sum(stage, "compute: subnormal result of +",
                               random_floats(compute_inputs, 37, {-125, -124, false}), -0x1.8p-125F,
                               [](float x) { return std::copysign(0.0F, x - 0x1.8p-125F); }));
    rows.push_back(measure_comparison(stage, "compute: subnormal < 0"));
}

} // namespace lockstep::probing
