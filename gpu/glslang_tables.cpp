#include "gpu/glslang_tables.hpp"

#include <charconv>
#include <mutex>
#include <set>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>

#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

GlslVersion version_in(const std::string& text) {
    GlslVersion version;
    std::string_view before;
    for (ShaderWords words(text); words.next(); before = words.token())
        if (before == "version") {
            const std::string_view number = words.token();
            std::from_chars(number.data(), number.data() + number.size(), version.number);
            if (words.next())
                for (const std::string_view profile : {"es", "core", "compatibility"})
                    if (words.token() == profile)
                        version.profile = profile;
            break;
        }
    return version;
}

void set_glslang_target(glslang::TShader& shader, EShLanguage language, glslang::EShClient client) {
    constexpr int client_version = 100;
    const bool is_vulkan = client == glslang::EShClientVulkan;
    shader.setEnvInput(glslang::EShSourceGlsl, language, client, client_version);
    shader.setEnvClient(client, is_vulkan ? glslang::EShTargetVulkan_1_1 : glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    if (is_vulkan)
        shader.setEnvInputVulkanRulesRelaxed(); // plain uniforms and atomic counters as in GL
}

void prepare_glslang(glslang::EShClient client, const GlslVersion& version) {
    static const bool is_ready = glslang::InitializeProcess();
    static std::mutex mutex;
    static std::set<std::tuple<glslang::EShClient, int, std::string>> prepared;
    if (!is_ready)
        throw Error("glslang does not start");
    constexpr int first_with_tables = 150; // of a desktop version before, it prints them instead
    if (version.profile != "es" && version.number < first_with_tables)
        return;
    const std::scoped_lock lock(mutex);
    if (!prepared.emplace(client, version.number, version.profile).second)
        return;
    const std::string text = fmt::format("#version {} {}\nvoid main() {{}}\n", version.number, version.profile);
    const char* const one = text.c_str();
    glslang::TShader shader(EShLangVertex); // one stage makes the tables of all
    shader.setStrings(&one, 1);
    set_glslang_target(shader, EShLangVertex, client);
    shader.parse(GetDefaultResources(), version.number, false, EShMsgDefault); // a version that there is not has none
}

} // namespace lockstep
