#include "gpu/probe/sequences.hpp"

#include <cmath>

namespace lockstep::probing {
namespace {

using glm::vec3;
using glm::vec4;

// clang-format off
constexpr DotSequence dots[] = {
    {"(x+y)+z", [](vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }},
    {"x+(y+z)", [](vec3 a, vec3 b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }},
    {"(x+z)+y", [](vec3 a, vec3 b) { return (a.x * b.x + a.z * b.z) + a.y * b.y; }},
    {"fma(z,fma(y,x))", [](vec3 a, vec3 b) { return std::fma(a.z, b.z, std::fma(a.y, b.y, a.x * b.x)); }},
    {"fma(x,fma(y,z))", [](vec3 a, vec3 b) { return std::fma(a.x, b.x, std::fma(a.y, b.y, a.z * b.z)); }},
    {"fma(z,fma(x,y))", [](vec3 a, vec3 b) { return std::fma(a.z, b.z, std::fma(a.x, b.x, a.y * b.y)); }},
    {"fma(x,fma(z,y))", [](vec3 a, vec3 b) { return std::fma(a.x, b.x, std::fma(a.z, b.z, a.y * b.y)); }},
    {"fma(z,x+y)", [](vec3 a, vec3 b) { return std::fma(a.z, b.z, a.x * b.x + a.y * b.y); }},
    {"fma(x,y+z)", [](vec3 a, vec3 b) { return std::fma(a.x, b.x, a.y * b.y + a.z * b.z); }},
    {"fma(y,x)+z", [](vec3 a, vec3 b) { return std::fma(a.y, b.y, a.x * b.x) + a.z * b.z; }},
    {"x+fma(y,z)", [](vec3 a, vec3 b) { return a.x * b.x + std::fma(a.y, b.y, a.z * b.z); }},
    {"rounded once", [](vec3 a, vec3 b) {
        return static_cast<float>(double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z); }},
};

constexpr RowSequence rows[] = {
    {"((x+y)+z)+w", [](vec4 r, vec3 v) { return ((r.x * v.x + r.y * v.y) + r.z * v.z) + r.w; }},
    {"x+(y+(z+w))", [](vec4 r, vec3 v) { return r.x * v.x + (r.y * v.y + (r.z * v.z + r.w)); }},
    {"(x+y)+(z+w)", [](vec4 r, vec3 v) { return (r.x * v.x + r.y * v.y) + (r.z * v.z + r.w); }},
    {"fma(z,fma(y,x))+w", [](vec4 r, vec3 v) { return std::fma(r.z, v.z, std::fma(r.y, v.y, r.x * v.x)) + r.w; }},
    {"fma(x,fma(y,fma(z,w)))", [](vec4 r, vec3 v) {
        return std::fma(r.x, v.x, std::fma(r.y, v.y, std::fma(r.z, v.z, r.w))); }},
    {"fma(z,fma(y,fma(x,w)))", [](vec4 r, vec3 v) {
        return std::fma(r.z, v.z, std::fma(r.y, v.y, std::fma(r.x, v.x, r.w))); }},
    {"fma(y,x)+fma(z,w)", [](vec4 r, vec3 v) { return std::fma(r.y, v.y, r.x * v.x) + std::fma(r.z, v.z, r.w); }},
};

constexpr TripleSequence multiply_adds[] = {
    {"each rounded", [](float x, float y, float z) { return x * y + z; }},
    {"fused", [](float x, float y, float z) { return std::fma(x, y, z); }},
};

constexpr TripleSequence fmas[] = {
    {"rounded once", [](float x, float y, float z) { return std::fma(x, y, z); }},
    {"rounded twice", [](float x, float y, float z) { return x * y + z; }},
};

constexpr TripleSequence common_factors[] = {
    {"each rounded", [](float x, float y, float z) { return x * y + x * z; }},
    {"x*(a+b)", [](float x, float y, float z) { return x * (y + z); }},
    {"fma(x,a,x*b)", [](float x, float y, float z) { return std::fma(x, y, x * z); }},
    {"fma(x,b,x*a)", [](float x, float y, float z) { return std::fma(x, z, x * y); }},
};
// clang-format on

} // namespace

std::span<const DotSequence> dot_sequences() { return dots; }
std::span<const RowSequence> row_sequences() { return rows; }
std::span<const TripleSequence> multiply_add_sequences() { return multiply_adds; }
std::span<const TripleSequence> common_factor_sequences() { return common_factors; }
std::span<const TripleSequence> fma_sequences() { return fmas; }

std::vector<Prediction<float>> predict(std::span<const DotSequence> sequences, const Vectors& a, const Vectors& b) {
    std::vector<Prediction<float>> predictions;
    for (const DotSequence& sequence : sequences) {
        Floats values(a.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            values[i] = sequence.value(a[i], b[i]);
        predictions.push_back({std::string(sequence.name), std::move(values)});
    }
    return predictions;
}

std::vector<Prediction<float>> predict(std::span<const TripleSequence> sequences, const Vectors& v) {
    std::vector<Prediction<float>> predictions;
    for (const TripleSequence& sequence : sequences) {
        Floats values(v.size());
        for (std::size_t i = 0; i < v.size(); ++i)
            values[i] = sequence.value(v[i].x, v[i].y, v[i].z);
        predictions.push_back({std::string(sequence.name), std::move(values)});
    }
    return predictions;
}

} // namespace lockstep::probing
