#include <cmath>

#include "gpu/probe/image_stage.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/probe/sequences.hpp"

namespace lockstep::probing {
namespace {

constexpr int fragment_side = 64;
constexpr std::size_t texels = fragment_side * fragment_side;

/// x, y, z for the sums, w for quotients and roots.
Floats texture_inputs(const Vectors& xyz, const Floats& w) {
    Floats values;
    for (std::size_t i = 0; i < texels; ++i)
        values.insert(values.end(), {xyz[i].x, xyz[i].y, xyz[i].z, w[i]});
    return values;
}

Floats component(const Floats& rgba, std::size_t c) {
    Floats values;
    for (std::size_t i = c; i < rgba.size(); i += 4)
        values.push_back(rgba[i]);
    return values;
}

template <class Function> Floats generate(Function function) {
    Floats values(texels);
    for (std::size_t i = 0; i < texels; ++i)
        values[i] = function(i);
    return values;
}

} // namespace

void measure_fragment_arithmetic(Rows& rows) {
    const Vectors a = random_vectors(texels, 21, {});
    const Vectors b = random_vectors(texels, 22, {});
    const Floats p = random_floats(texels, 23, {-30, 30, true});
    const Floats q = random_floats(texels, 24, {-30, 30, true});
    const GlTexture a_texture = make_texture(rgba32f, fragment_side, fragment_side, texture_inputs(a, p).data());
    const GlTexture b_texture = make_texture(rgba32f, fragment_side, fragment_side, texture_inputs(b, q).data());
    const GlTexture scalars = make_texture(rgba32f, fragment_side, fragment_side, nullptr);
    const GlTexture sums = make_texture(rgba32f, fragment_side, fragment_side, nullptr);
    const GlTexture* sources[] = {&a_texture, &b_texture};
    const GlTexture* targets[] = {&scalars, &sums};
    ImageStage("probe/fragment").run(fragment_side, fragment_side, sources, targets);
    const auto scalar = read_texture<float>(scalars, rgba32f, texels * 4);
    const auto sum = read_texture<float>(sums, rgba32f, texels * 4);

    const Floats r = component(scalar, 3);
    rows.push_back(judge("fragment a/b", component(scalar, 0),
                         {{"rounded", generate([&](std::size_t i) { return p[i] / q[i]; })},
                          {"a*r, r the driver's 1/b", generate([&](std::size_t i) { return p[i] * r[i]; })}}));
    rows.push_back(judge("fragment 1/b", r, {{"rounded", generate([&](std::size_t i) { return 1.0F / q[i]; })}}));
    rows.push_back(judge("fragment sqrt", component(scalar, 1),
                         {{"rounded", generate([&](std::size_t i) { return std::sqrt(std::abs(p[i])); })}}));
    rows.push_back(
        judge("fragment inversesqrt", component(scalar, 2),
              {{"1/sqrt(x), each rounded", generate([&](std::size_t i) { return 1.0F / std::sqrt(std::abs(q[i])); })},
               {"rounded", generate([&](std::size_t i) {
                    return static_cast<float>(1.0 / std::sqrt(std::abs(static_cast<double>(q[i]))));
                })}}));
    rows.push_back(judge("fragment dot(vec3)", component(sum, 0), predict(dot_sequences(), a, b)));
    auto lengths = predict(dot_sequences(), a, a);
    for (auto& prediction : lengths) {
        prediction.name = "sqrt(" + prediction.name + "), rounded";
        for (float& value : prediction.values)
            value = std::sqrt(value);
    }
    rows.push_back(judge("fragment length", component(sum, 1), lengths));
    Vectors plain, precise;
    for (std::size_t i = 0; i < texels; ++i) {
        plain.emplace_back(a[i].y, b[i].z, b[i].x);
        precise.emplace_back(a[i].x, b[i].y, b[i].z);
    }
    rows.push_back(judge("fragment a*b+c", component(sum, 2), predict(multiply_add_sequences(), plain)));
    rows.push_back(judge("fragment a*b+c, precise", component(sum, 3), predict(multiply_add_sequences(), precise)));
}

} // namespace lockstep::probing
