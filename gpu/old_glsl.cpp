#include "gpu/old_glsl.hpp"

#include <array>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "gpu/shader_words.hpp"

namespace lockstep {
namespace {

struct Renamed {
    std::string_view old, now;
};

/// GLSL ES 1.00, 8.7; GLSL 1.20, 8.7; with the endings of the extensions that have them first.
constexpr std::array<Renamed, 26> sampling{{{"texture1D", "texture"},
                                            {"texture2D", "texture"},
                                            {"texture3D", "texture"},
                                            {"textureCube", "texture"},
                                            {"texture2DRect", "texture"},
                                            {"texture1DProj", "textureProj"},
                                            {"texture2DProj", "textureProj"},
                                            {"texture3DProj", "textureProj"},
                                            {"texture1DLod", "textureLod"},
                                            {"texture2DLod", "textureLod"},
                                            {"texture3DLod", "textureLod"},
                                            {"textureCubeLod", "textureLod"},
                                            {"texture2DProjLod", "textureProjLod"},
                                            {"texture2DLodEXT", "textureLod"},
                                            {"textureCubeLodEXT", "textureLod"},
                                            {"texture2DProjLodEXT", "textureProjLod"},
                                            {"texture2DLodARB", "textureLod"},
                                            {"textureCubeLodARB", "textureLod"},
                                            {"texture2DGradEXT", "textureGrad"},
                                            {"textureCubeGradEXT", "textureGrad"},
                                            {"texture2DProjGradEXT", "textureProjGrad"},
                                            {"texture2DGradARB", "textureGrad"},
                                            {"texture2DGrad", "textureGrad"},
                                            {"textureCubeGrad", "textureGrad"},
                                            {"gl_FragDepthEXT", "gl_FragDepth"},
                                            {"gl_InstanceIDARB", "gl_InstanceID"}}};

struct Variable {
    std::string_view old, declaration; ///< of "NAME"
};

constexpr std::array<Variable, 8> of_vertex{{{"gl_Vertex", "in vec4 {};"},
                                             {"gl_Normal", "in vec3 {};"},
                                             {"gl_Color", "in vec4 {};"},
                                             {"gl_MultiTexCoord0", "in vec4 {};"},
                                             {"gl_MultiTexCoord1", "in vec4 {};"},
                                             {"gl_FrontColor", "out vec4 {};"},
                                             {"gl_TexCoord", "out vec4 {}[8];"},
                                             {"gl_FogFragCoord", "out float {};"}}};
constexpr std::array<Variable, 5> of_fragment{{{"gl_FragColor", "out mediump vec4 {};"},
                                               {"gl_FragData", "out mediump vec4 {}[4];"},
                                               {"gl_Color", "in vec4 {};"},
                                               {"gl_TexCoord", "in vec4 {}[8];"},
                                               {"gl_FogFragCoord", "in float {};"}}};
constexpr std::array<Variable, 6> of_both{{{"gl_ModelViewProjectionMatrix", "uniform mat4 {};"},
                                           {"gl_ModelViewMatrix", "uniform mat4 {};"},
                                           {"gl_ProjectionMatrix", "uniform mat4 {};"},
                                           {"gl_TextureMatrix", "uniform mat4 {}[8];"},
                                           {"gl_NormalMatrix", "uniform mat3 {};"},
                                           {"gl_MaxTextureCoords", "const int {} = 8;"}}};

} // namespace

std::string old_name(const std::string& name) { return name.starts_with("ls_") ? "gl_" + name.substr(3) : name; }

bool says_old_glsl(const std::string& text) {
    std::set<std::string_view> old{"varying", "attribute", "ftransform"};
    for (const Renamed& one : sampling)
        old.insert(one.old);
    for (const Variable& one : of_vertex)
        old.insert(one.old);
    for (const Variable& one : of_fragment)
        old.insert(one.old);
    for (const Variable& one : of_both)
        old.insert(one.old);
    for (ShaderWords words(text); words.next();)
        if (old.contains(words.token()))
            return true;
    return false;
}

std::string words_of_old_glsl(const std::string& text, Stage stage) {
    std::set<std::string, std::less<>> said;
    for (ShaderWords words(text); words.next();)
        said.emplace(words.token());
    const bool transforms = said.contains("ftransform");
    if (transforms)
        said.insert({"gl_Vertex", "gl_ModelViewProjectionMatrix"});
    std::string definitions =
        stage == Stage::vertex ? "#define attribute in\n#define varying out\n" : "#define varying in\n";
    for (const auto& [old, now] : sampling)
        if (said.contains(old) && !(said.contains("texture") && now == "texture"))
            definitions += fmt::format("#define {} {}\n", old, now);
    std::string declarations;
    const auto declare = [&](const auto& variables) {
        for (const auto& [old, declaration] : variables)
            if (said.contains(old)) {
                const std::string now = fmt::format("ls{}", old.substr(2));
                definitions += fmt::format("#define {} {}\n", old, now);
                declarations += fmt::format(fmt::runtime(declaration), now);
            }
    };
    if (stage == Stage::vertex)
        declare(of_vertex);
    if (stage == Stage::fragment)
        declare(of_fragment);
    declare(of_both);
    if (transforms)
        definitions += "#define ftransform() (ls_ModelViewProjectionMatrix * ls_Vertex)\n";
    // Where the text has a variable of that name, the later function goes by the old name.
    if (said.contains("texture")) {
        if (said.contains("texture2D"))
            declarations += "vec4 texture2D(sampler2D s, highp vec2 at) { return texture(s, at); }";
        if (said.contains("textureCube"))
            declarations += "vec4 textureCube(samplerCube s, highp vec3 at) { return texture(s, at); }";
    }
    return definitions + declarations + "\n";
}

} // namespace lockstep
