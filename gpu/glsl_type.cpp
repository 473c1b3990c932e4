#include "gpu/glsl_type.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
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
    {GL_FLOAT_MAT2x3, "mat2x3", 6, true},
    {GL_FLOAT_MAT2x4, "mat2x4", 8, true},
    {GL_FLOAT_MAT3x2, "mat3x2", 6, true},
    {GL_FLOAT_MAT3x4, "mat3x4", 12, true},
    {GL_FLOAT_MAT4x2, "mat4x2", 8, true},
    {GL_FLOAT_MAT4x3, "mat4x3", 12, true},
    {GL_DOUBLE, "double"},
    {GL_DOUBLE_VEC2, "dvec2"},
    {GL_DOUBLE_VEC3, "dvec3"},
    {GL_DOUBLE_VEC4, "dvec4"},
    {GL_DOUBLE_MAT2, "dmat2"},
    {GL_DOUBLE_MAT3, "dmat3"},
    {GL_DOUBLE_MAT4, "dmat4"},
    {GL_BOOL, "bool"},
    {GL_BOOL_VEC2, "bvec2"},
    {GL_BOOL_VEC3, "bvec3"},
    {GL_BOOL_VEC4, "bvec4"},
    {GL_SAMPLER_1D, "sampler1D"},
    {GL_SAMPLER_2D, "sampler2D"},
    {GL_SAMPLER_3D, "sampler3D"},
    {GL_SAMPLER_CUBE, "samplerCube"},
    {GL_SAMPLER_1D_SHADOW, "sampler1DShadow"},
    {GL_SAMPLER_2D_SHADOW, "sampler2DShadow"},
    {GL_SAMPLER_CUBE_SHADOW, "samplerCubeShadow"},
    {GL_SAMPLER_1D_ARRAY, "sampler1DArray"},
    {GL_SAMPLER_2D_ARRAY, "sampler2DArray"},
    {GL_SAMPLER_1D_ARRAY_SHADOW, "sampler1DArrayShadow"},
    {GL_SAMPLER_2D_ARRAY_SHADOW, "sampler2DArrayShadow"},
    {GL_SAMPLER_CUBE_MAP_ARRAY, "samplerCubeArray"},
    {GL_SAMPLER_2D_MULTISAMPLE, "sampler2DMS"},
    {GL_SAMPLER_2D_MULTISAMPLE_ARRAY, "sampler2DMSArray"},
    {GL_SAMPLER_BUFFER, "samplerBuffer"},
    {GL_SAMPLER_2D_RECT, "sampler2DRect"},
    {GL_SAMPLER_2D_RECT_SHADOW, "sampler2DRectShadow"},
    {GL_INT_SAMPLER_1D, "isampler1D"},
    {GL_INT_SAMPLER_2D, "isampler2D"},
    {GL_INT_SAMPLER_3D, "isampler3D"},
    {GL_INT_SAMPLER_CUBE, "isamplerCube"},
    {GL_INT_SAMPLER_2D_ARRAY, "isampler2DArray"},
    {GL_INT_SAMPLER_BUFFER, "isamplerBuffer"},
    {GL_INT_SAMPLER_2D_RECT, "isampler2DRect"},
    {GL_UNSIGNED_INT_SAMPLER_1D, "usampler1D"},
    {GL_UNSIGNED_INT_SAMPLER_2D, "usampler2D"},
    {GL_UNSIGNED_INT_SAMPLER_3D, "usampler3D"},
    {GL_UNSIGNED_INT_SAMPLER_CUBE, "usamplerCube"},
    {GL_UNSIGNED_INT_SAMPLER_2D_ARRAY, "usampler2DArray"},
    {GL_UNSIGNED_INT_SAMPLER_BUFFER, "usamplerBuffer"},
    {GL_UNSIGNED_INT_SAMPLER_2D_RECT, "usampler2DRect"},
    {GL_IMAGE_1D, "image1D"},
    {GL_IMAGE_2D, "image2D"},
    {GL_IMAGE_3D, "image3D"},
    {GL_IMAGE_2D_ARRAY, "image2DArray"},
    {GL_IMAGE_BUFFER, "imageBuffer"},
    {GL_INT_IMAGE_2D, "iimage2D"},
    {GL_UNSIGNED_INT_IMAGE_2D, "uimage2D"},
    {GL_UNSIGNED_INT_ATOMIC_COUNTER, "atomic_uint"},
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

GLenum type_named(std::string_view name) {
    const auto* const found =
        std::find_if(std::begin(types), std::end(types), [&](const GlslType& t) { return t.name == name; });
    return found == std::end(types) ? 0 : found->type;
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

Scalar scalar_of(GLenum type) {
    if (is_float_type(type))
        return Scalar::float32;
    return type == GL_UNSIGNED_INT || type == GL_UNSIGNED_INT_VEC2 || type == GL_UNSIGNED_INT_VEC3 ||
                   type == GL_UNSIGNED_INT_VEC4
               ? Scalar::uint32
               : Scalar::int32;
}

std::optional<std::uint32_t> word_of(double number, GLenum type) {
    const bool whole = number == std::nearbyint(number);
    switch (scalar_of(type)) {
    case Scalar::float32:
        return std::bit_cast<std::uint32_t>(static_cast<float>(number));
    case Scalar::uint32:
        if (!whole || number < 0.0 || number > 4294967295.0)
            return std::nullopt;
        return static_cast<std::uint32_t>(number);
    case Scalar::int32:
        break;
    }
    if (!whole || number < -2147483648.0 || number > 2147483647.0)
        return std::nullopt;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(number));
}

} // namespace lockstep
