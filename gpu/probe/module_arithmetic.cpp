#include <cmath>
#include <string>

#include <glm/gtc/type_ptr.hpp>

#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/probe/sequences.hpp"
#include "gpu/probe/vertex_stage.hpp"

namespace lockstep::probing {
namespace {

Floats roots_of(const Floats& squares) {
    return each(squares, [](float x) { return std::sqrt(x); });
}

} // namespace

void measure_module_arithmetic(const DriverArithmetic& precise, std::size_t inputs, Rows& rows) {
    const VertexStage stage("probe/module_arithmetic", {},
                            {{"a_DotA", 3}, {"a_DotB", 3}, {"a_Length", 3}, {"a_Normalize", 3}},
                            {{"out_Dot", GL_FLOAT}, {"out_Length", GL_FLOAT}, {"out_Normalize", GL_FLOAT_VEC3}});
    const Vectors a = random_vectors(inputs, 41, {}), b = random_vectors(inputs, 42, {}),
                  v = random_vectors(inputs, 43, {-8, 8, true});
    const auto data = [](const Vectors& all) { return glm::value_ptr(all.front()); };
    const auto sums = predict(dot_sequences(), v, v);

    std::vector<Prediction<float>> dots{{"as in GLSL", precise.dot(a, b)}};
    for (auto& sum : predict(dot_sequences(), a, b))
        dots.push_back(std::move(sum));
    rows.push_back(judge("module: dot(vec3)",
                         stage.run(inputs, {{"a_DotA", 3, data(a)}, {"a_DotB", 3, data(b)}}, "out_Dot"), dots));

    std::vector<Prediction<float>> lengths{{"as in GLSL", precise.length(v)}};
    for (const auto& sum : sums)
        lengths.push_back({"sqrt(" + sum.name + "), rounded", roots_of(sum.values)});
    rows.push_back(judge("module: length", stage.run(inputs, {{"a_Length", 3, data(v)}}, "out_Length"), lengths));

    std::vector<Prediction<float>> directions{{"as in GLSL", precise.normalize(v)}};
    for (const auto& sum : sums) {
        const Floats roots = roots_of(sum.values);
        directions.push_back(
            {"v/sqrt(" + sum.name + "), rounded", each(v, roots, [](float x, float length) { return x / length; })});
        directions.push_back(
            {"v*(1/sqrt(" + sum.name + ")), rounded", each(v, each(roots, [](float x) { return 1.0F / x; }),
                                                           [](float x, float inverse) { return x * inverse; })});
    }
    rows.push_back(
        judge("module: normalize", stage.run(inputs, {{"a_Normalize", 3, data(v)}}, "out_Normalize"), directions));
}

} // namespace lockstep::probing
