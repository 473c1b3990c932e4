#pragma once
#include <cstdlib>
#include <optional>
#include <string>

#include "gpu/context.hpp"
#include "gpu/shared_library.hpp"
#include "reference/model/error.hpp"
#include "tests/skip.hpp"

namespace lockstep::test {

/// Whether the machine has an OSMesa at all, working or not. Debian has none after release 13;
/// LOCKSTEP_REQUIRE_OSMESA=1 says that there is to be one.
inline bool has_osmesa_library() {
    try {
        const SharedLibrary library("LOCKSTEP_OSMESA_LIBRARY", {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
        return true;
    } catch (const Error&) {
        return std::getenv("LOCKSTEP_OSMESA_LIBRARY") != nullptr;
    }
}

/// Mesa's GL without a display or a GPU: "osmesa", or "egl" where the machine has no OSMesa and need not have one. For
/// tests that are not about the library itself.
inline const std::string& software_gl() {
    static const std::string name =
        has_osmesa_library() || std::getenv("LOCKSTEP_REQUIRE_OSMESA") != nullptr ? "osmesa" : "egl";
    return name;
}

/// The context, or a skip with the reason: `const auto context = open_context("egl"); if (!context) return;`
inline std::optional<Context> open_context(const std::string& name = "auto") {
    try {
        return Context(parse_context_request(name));
    } catch (const Error& error) {
        skip(error.what(),
             name == "osmesa" && !has_osmesa_library() ? "LOCKSTEP_REQUIRE_OSMESA" : "LOCKSTEP_REQUIRE_GL");
        return std::nullopt;
    }
}

} // namespace lockstep::test
