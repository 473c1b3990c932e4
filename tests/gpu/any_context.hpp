#pragma once
#include <optional>
#include <string>

#include "gpu/context.hpp"
#include "reference/model/error.hpp"
#include "tests/skip.hpp"

namespace lockstep::test {

/// The context, or a skip with the reason: `const auto context = open_context("osmesa"); if (!context) return;`
inline std::optional<Context> open_context(const std::string& name = "auto") {
    try {
        return Context(parse_context_request(name));
    } catch (const Error& error) {
        skip(error.what());
        return std::nullopt;
    }
}

} // namespace lockstep::test
