#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lockstep {

/// A captured output, bit for bit.
struct CapturedOutput {
    std::string name;
    std::string type;                 ///< as GLSL names it
    bool is_float = true;             ///< else integers
    std::vector<std::uint32_t> words; ///< its components

    [[nodiscard]] float number(std::size_t component) const;
    [[nodiscard]] std::int32_t integer(std::size_t component) const;
};

/// Captured outputs of one vertex.
class CapturedVertex {
  public:
    std::vector<CapturedOutput> outputs;

    /// Null where there is none of that name and type.
    [[nodiscard]] const CapturedOutput* find(std::string_view name, std::string_view type) const;
    [[nodiscard]] std::optional<float> real(std::string_view name) const;
    [[nodiscard]] std::optional<std::int32_t> integer(std::string_view name) const;
    [[nodiscard]] std::optional<glm::ivec2> integers(std::string_view name) const;
    [[nodiscard]] std::optional<glm::vec2> vec2(std::string_view name) const;
    [[nodiscard]] std::optional<glm::vec3> vec3(std::string_view name) const;
    [[nodiscard]] std::optional<glm::vec4> vec4(std::string_view name) const;
};

} // namespace lockstep
