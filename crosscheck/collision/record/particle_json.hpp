#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include <glm/ext/vector_float1.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/record/capsule_parts.hpp"
#include "reference/model/collision/particles.hpp"

namespace lockstep {

/// What capsules of the collision system are made of. Readers throw Error naming the key and what it may be.

/// The bits of each float.
template <int Count> std::string vector_text(const glm::vec<Count, float>& v) {
    std::uint32_t words[Count];
    for (int i = 0; i < Count; ++i)
        words[i] = std::bit_cast<std::uint32_t>(v[i]);
    return words_text(words);
}

template <int Count> glm::vec<Count, float> read_vector(const JsonValue& value) {
    const auto words = read_words(value, Count);
    glm::vec<Count, float> v;
    for (int i = 0; i < Count; ++i)
        v[i] = std::bit_cast<float>(words[static_cast<std::size_t>(i)]);
    return v;
}

inline std::string word_text(float value) { return vector_text(glm::vec<1, float>(value)); }
inline float read_float(const JsonValue& value) { return read_vector<1>(value)[0]; }

/// The words of each field.
nlohmann::json state_json(const ParticleState& state);
ParticleState read_state(const JsonValue& value);

/// As a JSON file gives it back: what is no UTF-8, in a file's name, is replaced.
std::string as_utf8(const std::string& text);

} // namespace lockstep
