#include "crosscheck/files/json_text.hpp"

namespace lockstep {

std::string json_text(const nlohmann::json& json) {
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace lockstep
