#pragma once
#include <string>
#include <utility>

#include "reference/model/lifecycle/host.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::lifecycle {

/// Of a pass that computes as the settings say. `continues`: what a dispatch writes besides its first buffer.
inline ItemPassOptions options_of(const HostPtr& host, std::string name, std::uint8_t resource,
                                  bool continues = false) {
    return {.name = std::move(name),
            .resource = resource,
            .stage = PassStage::compute,
            .arithmetic = host->settings().arithmetic,
            .continues = continues};
}

} // namespace lockstep::lifecycle
