#include "gpu/glsl_type.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace lockstep {
namespace {

struct GlslType {
    GLenum type;
    const char* name;
    int components = 0; ///< as an output
    bool is_float = false;
};

constexpr GlslType types[] = {
    {GL_FLOAT, "float", 1, true},
    {GL_FLOAT_VEC2, "vec2", 2, true},
    {GL_FLOAT_VEC3, "vec3", 3, true},
    {GL_FLOAT_VEC4, "vec4", 4, true},
    {GL_FLOAT_MAT2, "mat2", 4, true},
    {GL_FLOAT_MAT3, "mat3", 9, true},
    {GL_FLOAT_MAT4, "mat4", 16, true},
    {GL_INT, "int", 1},
    {GL_INT_VEC2, "ivec2", 2},
    {GL_INT_VEC3, "ivec3", 3},
    {GL_INT_VEC4, "ivec4", 4},
    {GL_UNSIGNED_INT, "uint", 1},
    {GL_UNSIGNED_INT_VEC2, "uvec2", 2},
    {GL_UNSIGNED_INT_VEC3, "uvec3", 3},
    {GL_UNSIGNED_INT_VEC4, "uvec4", 4},
    {GL_DOUBLE, "double"},
    {GL_BOOL, "bool"},
    {GL_SAMPLER_2D, "sampler2D"},
    {GL_SAMPLER_3D, "sampler3D"},
    {GL_SAMPLER_2D_SHADOW, "sampler2DShadow"},
    {GL_SAMPLER_BUFFER, "samplerBuffer"},
    {GL_INT_SAMPLER_2D, "isampler2D"},
    {GL_UNSIGNED_INT_SAMPLER_2D, "usampler2D"},
    {GL_IMAGE_2D, "image2D"},
};

const GlslType* find(GLenum type) {
    const auto* const found =
        std::find_if(std::begin(types), std::end(types), [&](const GlslType& t) { return t.type == type; });
    return found == std::end(types) ? nullptr : found;
}

} // namespace

std::string type_name(GLenum type) {
    const GlslType* known = find(type);
    return known != nullptr ? known->name : fmt::format("GL type {:#06x}", type);
}

std::string declared_type(GLenum type, GLint size) {
    return size == 1 ? type_name(type) : fmt::format("{}[{}]", type_name(type), size);
}

int output_components(GLenum type) {
    const GlslType* known = find(type);
    return known != nullptr ? known->components : 0;
}

bool is_float_type(GLenum type) {
    const GlslType* known = find(type);
    return known != nullptr && known->is_float;
}

} // namespace lockstep
