#pragma once
/// What bindings.json says beside a shader (docs/own_shader.md), said by a test:
///
///     ShaderNames names;
///     names.uniforms = {{"history", "u_CDTexture"}, {"size", {"u_ClientWidth", "u_ClientHeight"}}, {"gain", 0.5}};
///     names.uniform_blocks["Frame"] = {{"dt", "u_Tick"}};
///     const NamedShaders bound("my_shaders", names);
///     UserShaders gpu(gl, scene, "my_shaders");
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace lockstep {

/// A name here, or a number.
struct NameOrNumber {
    NameOrNumber(const char* name) : value(std::string(name)) {}
    NameOrNumber(std::string name) : value(std::move(name)) {}
    NameOrNumber(double number) : value(number) {}
    NameOrNumber(int number) : value(static_cast<double>(number)) {}

    std::variant<std::string, double> value;
};

/// One of them, or a list: one after the other in a vector.
struct ShaderValue {
    template <class One>
    requires std::is_constructible_v<NameOrNumber, One> ShaderValue(One one) : values{NameOrNumber(std::move(one))} {}
    ShaderValue(std::initializer_list<NameOrNumber> all) : values(all), is_list(true) {}

    std::vector<NameOrNumber> values;
    bool is_list = false;
};

/// By the shader's names.
struct ShaderNames {
    using Names = std::map<std::string, ShaderValue>;
    Names uniforms = {};
    std::map<std::string, Names> uniform_blocks = {};
    std::map<std::string, std::variant<Names, std::string>> storage_blocks = {}; ///< by member, or all of one here
    std::map<std::string, std::string> attributes = {}, outputs = {};

    [[nodiscard]] std::string json() const; ///< the text of bindings.json
};

/// While it lives, the shaders of a folder have these names, whatever bindings.json lies there. Programs that are made
/// meanwhile keep them. One at a time a folder.
class NamedShaders {
  public:
    /// Throws Error for a second one of the folder. What is wrong with the names is told where a program is made.
    NamedShaders(const std::filesystem::path& folder, const ShaderNames& names);
    ~NamedShaders();
    NamedShaders(const NamedShaders&) = delete;
    NamedShaders& operator=(const NamedShaders&) = delete;

  private:
    std::filesystem::path folder_;
};

} // namespace lockstep
