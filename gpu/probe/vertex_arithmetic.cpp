#include <cmath>

#include "gpu/probe/constant_divisors.hpp"
#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/probe/sequences.hpp"

namespace lockstep::probing {
namespace {

using Predictions = std::vector<Prediction<float>>;

float product(float a, float b) { return a * b; }
float quotient(float a, float b) { return a / b; }
float reciprocal(float x) { return 1.0F / x; }
float square_root(float x) { return std::sqrt(x); }
float reciprocal_of_root(float x) { return 1.0F / std::sqrt(x); }
float rounded_inverse_sqrt(float x) { return static_cast<float>(1.0 / std::sqrt(static_cast<double>(x))); }

Predictions predict_cross(const Vectors& a, const Vectors& b) {
    using Minor = float (*)(float, float, float, float);
    const std::pair<const char*, Minor> minors[] = {
        {"each rounded", [](float p, float q, float r, float s) { return p * q - r * s; }},
        {"fma(p,q,-r*s)", [](float p, float q, float r, float s) { return std::fma(p, q, -(r * s)); }},
        {"fma(-r,s,p*q)", [](float p, float q, float r, float s) { return std::fma(-r, s, p * q); }},
    };
    Predictions predictions;
    for (const auto& [name, minor] : minors) {
        Floats values;
        for (std::size_t i = 0; i < a.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const int next = (c + 1) % 3;
                const int last = (c + 2) % 3;
                values.push_back(minor(a[i][next], b[i][last], b[i][next], a[i][last]));
            }
        predictions.push_back({name, std::move(values)});
    }
    return predictions;
}

Predictions predict_transform(const glm::mat4& m, const Vectors& v) {
    Predictions predictions;
    for (const RowSequence& sequence : row_sequences()) {
        Floats values;
        for (const glm::vec3& position : v)
            for (int r = 0; r < 4; ++r)
                values.push_back(sequence.value({m[0][r], m[1][r], m[2][r], m[3][r]}, position));
        predictions.push_back({std::string(sequence.name), std::move(values)});
    }
    return predictions;
}

void measure_sums(const DriverArithmetic& gl, const std::string& qualifier, std::size_t inputs, Rows& rows) {
    const Vectors a = random_vectors(inputs, 1, {});
    const Vectors b = random_vectors(inputs, 2, {});
    const Floats m = random_floats(16, 3, {});
    glm::mat4 matrix;
    for (int i = 0; i < 16; ++i)
        matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
    const auto row = [&](const std::string& name, const Floats& measured, const Predictions& predictions) {
        rows.push_back(judge(name + qualifier, measured, predictions));
    };
    row("dot(vec3)", gl.dot(a, b), predict(dot_sequences(), a, b));
    row("x*x+y*y+z*z", gl.squares(a), predict(dot_sequences(), a, a));
    row("mat4*vec4", gl.transform(matrix, a), predict_transform(matrix, a));
    row("mat4*vec4 written out", gl.transform_written(matrix, a), predict_transform(matrix, a));
    row("a*b+c", gl.multiply_add(a), predict(multiply_add_sequences(), a));
    row("x*a+x*b", gl.common_factor(a), predict(common_factor_sequences(), a));
    row("cross", gl.cross(a, b), predict_cross(a, b));
    row("fma", gl.fma(a), predict(fma_sequences(), a));
}

/// q = a * r, once corrected by its remainder: q + (a - b * q) * r.
Floats corrected_quotient(const Floats& a, const Floats& b, const Floats& r) {
    Floats values(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const float q = a[i] * r[i];
        values[i] = std::fma(std::fma(-b[i], q, a[i]), r[i], q);
    }
    return values;
}

/// r, once refined: r + (1 - b * r) * r.
Floats refined_reciprocal(const Floats& b, const Floats& r) {
    return each(b, r, [](float x, float y) { return std::fma(std::fma(-x, y, 1.0F), y, y); });
}

/// s = x * y, once corrected by its remainder: s + (x - s * s) * (y / 2).
Floats corrected_root(const Floats& x, const Floats& y) {
    return each(x, y, [](float radicand, float inverse) {
        const float s = radicand * inverse;
        return std::fma(std::fma(-s, s, radicand), 0.5F * inverse, s);
    });
}

void measure_division(const DriverArithmetic& gl, const std::string& name, const Floats& a, const Floats& b,
                      Rows& rows) {
    const Floats r = gl.reciprocal(b);
    const Floats refined = refined_reciprocal(b, r);
    rows.push_back(judge(name, gl.divide(a, b),
                         {{"rounded", each(a, b, quotient)},
                          {"a*(1/b), rounded", each(a, each(b, reciprocal), product)},
                          {"a*r, r the driver's 1/b", each(a, r, product)},
                          {"a*r corrected", corrected_quotient(a, b, r)},
                          {"a*r, r refined", each(a, refined, product)},
                          {"a*r corrected, r refined", corrected_quotient(a, b, refined)}}));
}

void measure_roots(const DriverArithmetic& gl, const std::string& qualifier, std::size_t inputs, Rows& rows) {
    const Floats a = random_floats(inputs, 4, {-30, 30, true});
    const Floats b = random_floats(inputs, 5, {-30, 30, true});
    measure_division(gl, "a/b" + qualifier, a, b, rows);
    const Floats dividends = random_floats(inputs, 38, {-30, 30, true});
    rows.push_back(judge_constant_divisors("a/c, c constant" + qualifier, gl, dividends, gl.by_constants(dividends)));
    // 1/b is subnormal there: a driver that multiplies by it loses the quotient.
    measure_division(gl, "a/b, b from 2^126" + qualifier, random_floats(inputs / 4, 6, {100, 127, true}),
                     random_floats(inputs / 4, 7, {126, 127, true}), rows);
    rows.push_back(judge("1/b" + qualifier, gl.reciprocal(b), {{"rounded", each(b, reciprocal)}}));

    const Floats x = random_floats(inputs, 8, {-60, 60, false});
    const Floats y = gl.inverse_sqrt(x);
    rows.push_back(judge("sqrt" + qualifier, gl.sqrt(x),
                         {{"rounded", each(x, square_root)},
                          {"1/y, y the driver's inversesqrt", gl.reciprocal(y)},
                          {"1/y, rounded", each(y, reciprocal)},
                          {"x*y", each(x, y, product)},
                          {"x*y corrected", corrected_root(x, y)}}));
    rows.push_back(judge("inversesqrt" + qualifier, y,
                         {{"1/sqrt(x), each rounded", each(x, reciprocal_of_root)},
                          {"rounded", each(x, rounded_inverse_sqrt)},
                          {"1/s, s the driver's sqrt", gl.reciprocal(gl.sqrt(x))}}));
}

/// Held against `first`, and against what `others` gives as well where none of those fits: that asks the driver often.
template <class Others>
ProbeRow judge_in_turn(const std::string& name, const Floats& measured, Predictions first, const Others& others) {
    ProbeRow row = judge(name, measured, first);
    if (row.matched == row.total)
        return row;
    for (Prediction<float>& other : others())
        first.push_back(std::move(other));
    return judge(name, measured, first);
}

void measure_directions(const DriverArithmetic& gl, const std::string& qualifier, std::size_t inputs, Rows& rows) {
    const Vectors v = random_vectors(inputs, 9, {-8, 8, true});
    const Floats squared = gl.dot(v, v);
    const Floats length = gl.length(v);
    // "dot" is the driver's own; a length may sum otherwise.
    const Predictions sums = predict(dot_sequences(), v, v);
    const auto other_lengths = [&] {
        const Floats inverse = gl.inverse_sqrt(squared);
        Predictions others{{"sqrt(dot)", gl.sqrt(squared)},
                           {"1/y, y inversesqrt(dot)", gl.reciprocal(inverse)},
                           {"dot*y", each(squared, inverse, product)}};
        for (const auto& sum : sums)
            others.push_back({"sqrt(" + sum.name + "), rounded", each(sum.values, square_root)});
        for (const auto& sum : sums)
            others.push_back({"1/y, y inversesqrt(" + sum.name + ")", gl.reciprocal(gl.inverse_sqrt(sum.values))});
        return others;
    };
    rows.push_back(judge_in_turn("length" + qualifier, length, {{"sqrt(dot), rounded", each(squared, square_root)}},
                                 other_lengths));

    const auto other_directions = [&] {
        Predictions others{{"v/sqrt(dot), rounded", each(v, each(squared, square_root), quotient)},
                           {"v*inversesqrt(dot)", each(v, gl.inverse_sqrt(squared), product)},
                           {"v*(1/sqrt(dot))", each(v, gl.reciprocal(gl.sqrt(squared)), product)},
                           {"v*(1/length)", each(v, gl.reciprocal(length), product)}};
        Floats lengths;
        for (const float l : length)
            lengths.insert(lengths.end(), {l, l, l});
        others.push_back({"v/length", gl.divide(flat(v), lengths)});
        for (const auto& sum : sums)
            others.push_back({"v*inversesqrt(" + sum.name + ")", each(v, gl.inverse_sqrt(sum.values), product)});
        for (const auto& sum : sums)
            others.push_back(
                {"v*(1/sqrt(" + sum.name + ")), rounded", each(v, each(sum.values, reciprocal_of_root), product)});
        return others;
    };
    rows.push_back(judge_in_turn("normalize" + qualifier, gl.normalize(v),
                                 {{"v*(1/sqrt(dot)), rounded", each(v, each(squared, reciprocal_of_root), product)}},
                                 other_directions));
}

void measure_transcendental(const DriverArithmetic& gl, std::size_t inputs, Rows& rows) {
    const Vectors v = random_vectors(inputs, 10, {-6, 2, false});
    const Floats all = gl.transcendental(v);
    const auto row = [&](const char* name, int component, double (*rounded)(double)) {
        Floats measured, expected;
        for (std::size_t i = 0; i < v.size(); ++i) {
            measured.push_back(all[3 * i + static_cast<std::size_t>(component)]);
            expected.push_back(static_cast<float>(rounded(static_cast<double>(v[i][component]))));
        }
        rows.push_back(judge(name, measured, {{"rounded", expected}}));
    };
    row("sin", 0, [](double x) { return std::sin(x); });
    row("exp2", 1, [](double x) { return std::exp2(x); });
    row("pow(x,2.2)", 2, [](double x) { return std::pow(x, static_cast<double>(2.2F)); });
}

/// x * y + z with one subnormal on the way; the sum with -0 keeps a zero's sign.
void measure_subnormals(const DriverArithmetic& gl, Rows& rows) {
    constexpr std::size_t inputs = 1024;
    const Floats m = random_floats(inputs, 11, {0, 1, true});
    const auto row = [&](const char* name, auto triple, auto kept, auto flushed) {
        Vectors v;
        Floats if_kept, if_flushed, if_unsigned;
        for (const float x : m) {
            v.push_back(triple(x));
            if_kept.push_back(kept(v.back()));
            if_flushed.push_back(flushed(v.back()));
            if_unsigned.push_back(if_flushed.back() + 0.0F);
        }
        rows.push_back(judge(name, gl.multiply_add(v),
                             {{"flushed", if_flushed}, {"flushed to +0", if_unsigned}, {"kept", if_kept}}));
    };
    const auto exact = [](glm::vec3 v) { return v.x * v.y + v.z; };
    const auto zero = [](glm::vec3 v) { return std::copysign(0.0F, v.x); };
    row(
        "subnormal operand of *", [](float x) { return glm::vec3(x * 0x1p-130F, 0x1p60F, -0.0F); }, exact, zero);
    row(
        "subnormal result of *", [](float x) { return glm::vec3(x * 0x1p-100F, 0x1p-32F, -0.0F); }, exact, zero);
    row(
        "subnormal operand of +", [](float x) { return glm::vec3(0x1p-125F, 1.0F, x * 0x1p-128F); }, exact,
        [](glm::vec3 v) { return v.x; });
    row(
        "subnormal result of +", [](float x) { return glm::vec3(x * 0x1p-125F, 1.0F, x * -0x1.8p-126F); }, exact, zero);

    const Floats tiny = each(m, [](float x) { return x * 0x1p-130F; });
    const Floats zeros = each(m, [](float x) { return std::copysign(0.0F, x); });
    rows.push_back(judge("subnormal passed on", gl.copy(tiny), {{"kept", tiny}, {"flushed", zeros}}));
    rows.push_back(judge(
        "subnormal > 0", gl.positive(tiny),
        {{"flushed", Floats(inputs, 0.0F)}, {"kept", each(tiny, [](float x) { return x > 0.0F ? 1.0F : 0.0F; })}}));
}

} // namespace

void measure_vertex_arithmetic(const DriverArithmetic& plain, const DriverArithmetic& precise, std::size_t inputs,
                               Rows& rows) {
    const auto measure = [&](const DriverArithmetic& gl, const std::string& qualifier) {
        measure_sums(gl, qualifier, inputs, rows);
        measure_roots(gl, qualifier, inputs, rows);
        measure_directions(gl, qualifier, inputs, rows);
    };
    measure(plain, "");
    measure_transcendental(plain, inputs, rows);
    measure(precise, ", precise");
    measure_subnormals(precise, rows);
}

} // namespace lockstep::probing
