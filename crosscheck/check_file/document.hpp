#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/files/json_reader.hpp"
#include "gpu/gl_system.hpp"
#include "gpu/shader_source.hpp"
#include "reference/model/state_view.hpp"

/// A check of any algorithm of passes over a state, as a JSON file (docs/check_files.md).
namespace lockstep::check_file {

/// A buffer or an image of the state. JsonValues refer to the document.
struct StateEntry {
    std::string name;
    JsonValue place;         ///< of the entry
    Extent extent;           ///< items, or texels
    int dimensions = 1;      ///< 1: a buffer
    std::string format = {}; ///< of an image
    std::optional<GlFilter> filter = {};
    std::optional<JsonValue> start = {};
};

/// A run of one shader.
struct PassEntry {
    std::string name; ///< its file's, without the ending
    Stage stage = Stage::compute;
    JsonValue place;
    std::map<std::string, JsonValue> bind = {}; ///< entries of the state, by the shader's names
    std::optional<std::array<std::uint32_t, 3>> groups = {};
    std::optional<std::size_t> invocations = {};
    std::optional<JsonValue> uniforms = {};
    std::map<std::string, JsonValue> inputs = {}; ///< of a fragment stage, by their names
};

struct Document {
    std::vector<StateEntry> state;
    std::vector<PassEntry> passes;
    std::optional<JsonValue> uniforms = {}; ///< of all passes that have them
};

/// Reads all but values, which are of types that shaders say. Throws Error: `FILE: /json/pointer: what is wrong`.
Document read_document(const JsonValue& document);

} // namespace lockstep::check_file
