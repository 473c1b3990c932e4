#pragma once
#include <string>

#include <nlohmann/json.hpp>

namespace lockstep {

/// A JSON file's text: indented, ending in a line break; bytes that are no UTF-8 become U+FFFD.
std::string json_text(const nlohmann::json& json);

} // namespace lockstep
